/* One number for what is audited.  Formulas count as they are read, so that comments and blanks do not; the hash is for
   telling what stands beside each other by honest mistake, not for defence. */
#include "base/random.h"

#include "fingerprint.h"
#include <inttypes.h>

static void add_word(struct text *out, const char *word) {
  text_printf(out, "%s\n", word);
}

static void add_formulas(struct text *out, const struct model *m) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (r->rank > RANK_USER) continue;
    add_word(out, r->rank == RANK_USER ? "overlay" : "paper");
    add_word(out, r->record->kind_name);
    add_word(out, r->id);
    add_word(out, r->section);
    add_word(out, r->equation);
    for (int k = 0; k < r->n_stmts; k++) {
      stmt_print(out, r->stmts[k]);
      text_add_char(out, '\n');
    }
  }
}

static void add_number(struct text *out, const char *name, const fmpq_t x) {
  char *s = fmpq_get_str(NULL, 10, x);
  text_printf(out, "%s %s\n", name, s);
  flint_free(s);
}

static void add_scene(struct text *out, const struct scene *s) {
  for (int k = 0; k < N_KEYS; k++) {
    if (!s->given[k]) continue;
    add_number(out, scene_key_name[k], &s->value[k]);
    if (s->interval[k]) add_number(out, "to", &s->high[k]);
  }
  for (size_t i = 0; i < s->n_printed; i++) text_printf(out, "%s: %s\n", s->printed[i].name, s->printed[i].decimal);
  phase_word_print(out, &s->word);
}

void audit_fingerprint(struct text *out, const struct model *m, const struct scene *s) {
  OWNED(text) all = {0};
  add_formulas(&all, m);
  add_scene(&all, s);
  text_printf(out, "%016" PRIx64, random_seed(text_str(&all)));
}
