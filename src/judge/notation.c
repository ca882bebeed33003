/* Sentences about symbols.

   A printed text that cannot be right as it stands is read by the parser in the paper's own definitions; the diagnostic
   is the certificate.  A letter is right when it and its meaning determine each other: each use names the symbol, what
   the paper lets it stand for there, and the place, in whose text the symbol must be found. */
#include "judge.h"
#include "value/title.h"
#include <string.h>

/* --- Reading --- */

/* Parses an equation, an inequality, a definition or an expression and elaborates it; false with d set. */
static bool read_text(const char *text, const char *name, const char *section, struct view view, struct diag *d) {
  OWNED(source) src;
  LOCAL(arena, a);
  OWNED(elaboration) el;
  struct matrix body;
  source_from_string(&src, name, text);
  struct diag unread = {0};
  const struct stmt *s = stmt_parse(&a, &src, (struct span){0, src.len}, d);
  const struct expr *alone = s ? NULL : expr_parse(&a, &src, (struct span){0, src.len}, &unread);
  bool ok = s != NULL, defines = ok && s->kind == STMT_DEFINE;
  const struct override argument = {defines ? s->param : NULL, 1, 1};
  elaboration_init(&el, view, &argument, argument.name != NULL);
  if (alone) diag_init(d);
  if (alone || defines)
    ok = elaborate(&body, &el, alone ? alone : s->sides[0], &src, section, d);
  else if (ok && s->kind == STMT_RELATION)
    ok = relation_check(&el, s, &src, section, d);
  else if (ok)
    diag_at(d, &src, s->span.begin, "an equation, an inequality or a definition is needed");
  return ok && !d->set;
}

/* --- Uses of symbols --- */

enum { MAX_USES = 8 };
struct use {
  char symbol[64], meaning[128], place[64];
};

/* The n-th item of a list separated by ";", trimmed. */
static bool item(char *out, size_t size, const char *list, int n) {
  for (; list && n > 0; n--) {
    list = strchr(list, ';');
    if (list) list++;
  }
  if (!list) return false;
  while (*list == ' ') list++;
  size_t len = strcspn(list, ";");
  while (len && list[len - 1] == ' ') len--;
  snprintf(out, size, "%.*s", (int)(len < size ? len : size - 1), list);
  return len > 0;
}

/* How many; 0 where a list is longer than another, or than can be read. */
static int read_uses(struct use u[MAX_USES], const struct claim *c, const char *symbols) {
  int n = 0;
  const char *meanings = claim_get(c, "stands-for"), *places = claim_get(c, "found-in");
  while (n < MAX_USES && item(u[n].symbol, sizeof u[n].symbol, symbols, n) &&
         item(u[n].meaning, sizeof u[n].meaning, meanings, n) &&
         item(u[n].place, sizeof u[n].place, places ? places : "quote", places ? n : 0))
    n++;
  struct use rest;
  bool more = item(rest.symbol, sizeof rest.symbol, symbols, n) ||
              item(rest.meaning, sizeof rest.meaning, meanings, n) || item(rest.place, sizeof rest.place, places, n);
  return more ? 0 : n;
}

/* The symbol as a token of the text: where it ends in a letter no other follows, nor an index, which makes another
   symbol of it. */
static bool occurs(const char *text, const char *symbol) {
  size_t n = strlen(symbol);
  for (const char *p = text ? strstr(text, symbol) : NULL; p; p = strstr(p + 1, symbol)) {
    bool goes_on = char_is_letter(symbol[n - 1]) && (char_is_letter(p[n]) || p[n] == '_');
    bool began = p > text && char_is_letter(symbol[0]) && (char_is_letter(p[-1]) || p[-1] == '\\');
    if (!goes_on && !began) return true;
  }
  return false;
}

/* Whether the place, the claim's quotation or a record of the equation files, prints the symbol. */
static bool found_in_place(const struct use *u, const struct claim *c, const struct view *view) {
  if (strcmp(u->place, "quote") == 0) return occurs(claim_get(c, "quote"), u->symbol);
  const struct statement_record *r = view_record(view, u->place);
  return r && occurs(r->tex, u->symbol);
}

/* Appends each pair of uses that contradicts the rule. */
static void clashes(struct text *out, const struct use *u, int n) {
  for (int i = 0; i < n; i++)
    for (int k = i + 1; k < n; k++) {
      bool same_symbol = strcmp(u[i].symbol, u[k].symbol) == 0, same_meaning = strcmp(u[i].meaning, u[k].meaning) == 0;
      if (same_symbol == same_meaning) continue;
      const char *sep = out->len ? "; " : "";
      if (same_symbol)
        text_printf(out, "%s$%s$ stands for %s and for %s", sep, u[i].symbol, u[i].meaning, u[k].meaning);
      else
        text_printf(out, "%s%s is written $%s$ and $%s$", sep, u[i].meaning, u[i].symbol, u[k].symbol);
    }
}

/* Whether the symbol has the same meaning in one of those uses. */
static bool is_among(const struct use *u, int n, const struct use *one) {
  bool among = false;
  for (int k = 0; k < n; k++)
    among = among || (strcmp(u[k].symbol, one->symbol) == 0 && strcmp(u[k].meaning, one->meaning) == 0);
  return among;
}

/* "$m_1$ for the first mass", each use once. */
static const char *uses_text(struct judge *j, const struct use *u, int n) {
  struct text t = {0};
  for (int i = 0; i < n; i++)
    if (!is_among(u, i, &u[i])) text_printf(&t, "%s$%s$ for %s", t.len ? ", " : "", u[i].symbol, u[i].meaning);
  return result_take(j->out, &t);
}

/* --- Corrected symbols --- */

/* Whether a record of the paper or a quotation prints the symbol. */
static bool is_printed(const struct judge *j, const char *symbol) {
  for (size_t i = 0; i < j->model->n_records; i++)
    if (j->model->records[i].rank == RANK_PAPER && occurs(j->model->records[i].tex, symbol)) return true;
  for (size_t i = 0; i < j->claims->n; i++)
    if (occurs(claim_get(&j->claims->claim[i], "quote"), symbol)) return true;
  return false;
}

/* A corrected symbol is one that the paper prints for this meaning among the uses, or is new to the paper: else it
   stands for something else already. */
static void borrowed(struct text *out, const struct judge *j, const struct use *now, int m, const struct use *printed,
                     int n) {
  for (int i = 0; i < m; i++)
    if (!is_among(printed, n, &now[i]) && is_printed(j, now[i].symbol))
      text_printf(out, "%s$%s$ is printed elsewhere, and not for %s", out->len ? "; " : "", now[i].symbol,
                  now[i].meaning);
}

/* --- The kind --- */

static void settle(struct finding *f, struct judge *j, const char *fault, long trials) {
  struct route_result w = {"diagnostic", fault ? ROUTE_DIFFERS : ROUTE_AGREES, true, trials};
  finding_add_route(f, j->out, w, "printed", -1, NULL, fault);
  f->verdict = verdict_of(&w, 1, true);
}

static bool judge_symbols(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct use u[MAX_USES], now[MAX_USES];
  OWNED(text) found = {0};
  const char *repaired = claim_get(c, "repaired");
  int n = read_uses(u, c, claim_get(c, "symbols")), m = repaired ? read_uses(now, c, repaired) : 0;
  if (n < 2)
    return claim_error(j, c, "symbols",
                       "symbols, stands-for and found-in list the same uses, two to eight, with \";\"");
  for (int i = 0; i < n; i++)
    if (!found_in_place(&u[i], c, &view)) return claim_error(j, c, "found-in", "a symbol is not printed at its place");
  if (repaired && m == 0) return claim_error(j, c, "repaired", "as many symbols as are printed are needed, with \";\"");
  clashes(&found, u, n);
  settle(f, j, found.len ? result_copy(j->out, text_str(&found)) : NULL, n);
  bool ok = true;
  if (found.len && repaired && !view.control) {
    text_reset(&found);
    clashes(&found, now, m);
    if (!claim_get(c, "repaired-as")) borrowed(&found, j, now, m, u, n);
    f->correction = uses_text(j, now, m);
    struct route_result w = {"diagnostic", m < n || found.len ? ROUTE_DIFFERS : ROUTE_AGREES, true, m};
    f->correction_verdict = verdict_of(&w, 1, true);
    if (found.len)
      finding_state(f, j->out, "diagnostic", layer_name[LAYER_CORRECTED], -1, m, NULL,
                    result_str(j->out, "the correction: %s", text_str(&found)));
    else if (claim_get(c, "repaired-as") && j->effort != EFFORT_REFUTE)
      ok = judge_repaired(f, j, c, repaired);
  }
  return ok;
}

/* Without the advice that follows what is wrong: "undefined symbol x_i; define it ...". */
static const char *what_is_wrong(struct judge *j, const char *reads, const struct diag *d) {
  char index = strncmp(d->what, "undefined ", 10) == 0 ? title_index(d->what) : 0;
  if (index) return result_str(j->out, "nothing says which value the index %c has there", index);
  return result_str(j->out, "%s cannot be read as a formula: %.*s", reads, (int)strcspn(d->what, ";"), d->what);
}

static bool judge_reading(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *reads = claim_get(c, "reads"), *repaired = claim_get(c, "repaired");
  struct diag d = {0};
  bool ok = read_text(reads, c->id, claim_section(c), view, &d);
  if (d.beyond) {
    f->verdict = VERDICT_UNKNOWN;
    finding_state(f, j->out, "diagnostic", "printed", -1, 0, NULL, result_copy(j->out, d.what));
    return true;
  }
  settle(f, j, ok ? NULL : what_is_wrong(j, reads, &d), 1);
  if (!ok && repaired && !view.control) {
    diag_init(&d);
    bool again = read_text(repaired, c->id, claim_section(c), view, &d);
    f->correction = result_copy(j->out, repaired);
    f->correction_verdict = again || d.beyond ? VERDICT_UNKNOWN : VERDICT_REFUTED;
    if (again && j->effort != EFFORT_REFUTE) return judge_repaired(f, j, c, repaired);
  }
  return true;
}

bool judge_notation(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  if (claim_get(c, "reads")) return judge_reading(f, j, c, view);
  return judge_symbols(f, j, c, view);
}
