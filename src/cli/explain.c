/* stickslip explain: a claim with its evidence, or what else an id is: a root, a control, a statement of the paper, or
   the number of an equation. */
#include <string.h>

#include "claim/near.h"
#include "cli.h"
#include "judge/receipt.h"
#include "value/title.h"

static bool print_receipt(struct text *out, const struct model *m, const struct claims *c, const struct scene *s,
                          const char *id, const char *data, struct diag *d) {
  enum { MAX_SCRIPT = 1 << 20 };
  OWNED(source) src = {.name = NULL};
  if (!m->system)
    return diag_set(
        d, "error: receipts are of claims about two masses on a belt, and no file of this paper says that it is "
           "about them");
  return read_in(&src, data, receipt_file(c, id), MAX_SCRIPT, d) && audit_receipt(out, m, c, s, id, src.text, d);
}

/* --- What is no claim --- */

/* The wrong formulas of a control. */
static void add_formulas(struct text *out, const struct model *m, const char *id) {
  for (size_t i = 0; i < m->n_records; i++)
    for (int k = 0; m->records[i].rank == RANK_CONTROL && k < m->records[i].n_stmts; k++) {
      if (strcmp(m->records[i].id, id) != 0) continue;
      text_printf(out, "%-11s ", k ? "" : "reads");
      stmt_print(out, m->records[i].stmts[k]);
      text_add_char(out, '\n');
    }
}

/* Every attribute, and of claims their titles. */
static bool add_record(struct text *out, const struct inputs *e, const struct claim *c, struct diag *d) {
  static const char *const of_claims[] = {"claim", "claims", "checks"};
  char id[CLAIM_NAME];
  bool ok = true;
  for (size_t k = 0; k < c->record->n_fields; k++) {
    const struct field *f = &c->record->fields[k];
    if (word_find(f->key_name, of_claims, 3) == 3) {
      text_printf(out, "%-11s %s\n", f->key_name, f->text);
      continue;
    }
    const char *label = f->key_name;
    for (const char *p = f->text; ok && (p = claim_next_item(id, sizeof id, p)) != NULL; label = "") {
      const struct claim *of = claim_named(&e->files.claims, id);
      text_printf(out, "%-11s %s%s", label, id, of ? ": " : "");
      ok = !of || claim_title(out, &e->files.model, of, NULL, d);
      text_add_char(out, '\n');
    }
  }
  return ok;
}

/* A control of the program's own, which a whole audit has. */
static bool explain_own_control(struct text *out, const char *id) {
  static const struct {
    const char *id, *of, *says;
  } own[] = {{"routes-later", "routes", "the propagator of a moment 2^-150 later passes for that of the time itself"},
             {"long-runs-multiplier", "long runs", "a displacement passes for one whose rate is a quarter greater"}};
  for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
    if (strcmp(own[i].id, id) != 0) continue;
    text_printf(out, "%s, a control, wrong on purpose, which must be refuted in every whole audit\n", id);
    text_printf(out, "claim       %s\nreads       %s\n", own[i].of, own[i].says);
    return true;
  }
  return false;
}

/* false, with d not set, where the id is of none of these. */
static bool explain_record(struct text *out, const struct inputs *e, const char *id, struct diag *d) {
  const struct {
    const struct claims *of;
    const char *what;
  } kinds[] = {{&e->files.roots, "what is wrong in the paper, and the claims that fail for it"},
               {&e->files.controls, "a control, wrong on purpose, which must be refuted whenever its claim is judged"},
               {&e->files.statements, "a statement of the paper, and the claims that answer it"}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    const struct claim *c = claim_named(kinds[i].of, id);
    if (!c) continue;
    text_printf(out, "%s, %s\n", id, kinds[i].what);
    add_formulas(out, &e->files.model, id);
    return add_record(out, e, c, d);
  }
  return explain_own_control(out, id);
}

/* --- Equations --- */

/* "40" or "(40)" without what stands around it, into number; false where it is another word. */
static bool is_number(char number[8], const char *word) {
  size_t open = *word == '(', n = strspn(word + open, "0123456789");
  if (n == 0 || n > 6 || strcmp(word + open + n, open ? ")" : "") != 0) return false;
  memcpy(number, word + open, n);
  number[n] = '\0';
  return true;
}

/* The claims on the equation of that number, in rows; *only: the one there is, or NULL.  false, with d not set, without
   any. */
static bool explain_equation(struct text *out, const struct claim **only, const struct inputs *e, const char *number,
                             struct diag *d) {
  int n = 0;
  bool ok = true;
  text_printf(out, "(%s): one of these claims can be explained, as in stickslip explain eq-%s\n", number, number);
  for (size_t i = 0; ok && i < e->files.claims.n; i++) {
    const struct claim *c = &e->files.claims.claim[i];
    const char *equation = claim_get(c, "equation");
    if (!equation || strcmp(equation, number) != 0) continue;
    ok = list_claim(out, &e->files.model, c, d);
    *only = n++ ? NULL : c;
  }
  return ok && n > 0;
}

/* --- The command --- */

static bool explain_claim(struct text *out, const struct inputs *e, const char *id, const struct options *o,
                          const char *data, struct diag *d) {
  if (option(o, OPT_RECEIPT)) return print_receipt(out, &e->files.model, &e->files.claims, &e->scene, id, data, d);
  return audit_explain(out, &e->files.model, &e->files.claims, &e->scene, id, option(o, OPT_AT), option(o, OPT_TAPE),
                       d);
}

/* What the word is, in the order in which it is asked. */
static bool explain(struct text *out, const struct inputs *e, const char *word, const struct options *o,
                    const char *data, struct diag *d) {
  const struct claim *only = NULL;
  char number[8];
  if (claim_answering(&e->files.claims, word)) return explain_claim(out, e, word, o, data, d);
  bool of_claim = option(o, OPT_AT) || option(o, OPT_TAPE) || option(o, OPT_RECEIPT);
  bool found = is_number(number, word) ? explain_equation(out, &only, e, number, d) : explain_record(out, e, word, d);
  if (only) {
    text_reset(out);
    return explain_claim(out, e, only->id, o, data, d);
  }
  if (!found && !d->set) claims_unknown(&e->files.claims, word, d);
  if (found && of_claim) diag_set(d, "error: --at, --tape and --receipt are of a claim, and %.200s is none", word);
  return !d->set;
}

int run_explain(const struct options *o, const char *data, struct diag *d) {
  bool receipt = option(o, OPT_RECEIPT);
  OWNED(inputs) e;
  OWNED(text) out = {0};
  bool ok = inputs_load(&e, data, o, d) && near_controls_add(&e.files.model, &e.files.claims, &e.files.controls, d) &&
            explain(&out, &e, o->operands.word[0], o, data, d);
  if (ok && receipt)
    fputs(text_str(&out), stdout);
  else if (ok)
    terminal_print_marked(text_str(&out));
  return EXIT_AS_RECORDED;
}
