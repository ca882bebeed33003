/* What a formula of the stable layer is made of: the records of stable.eq that are met on the way to it, as the
   look-ups of one elaboration tell, and whether each was proved equal to what it replaces. */
#include <string.h>

#include "stability_impl.h"

static const struct definition *definition_of(const struct view *v, const struct digits_formula *f) {
  const struct model *m = v->model;
  size_t len = strcspn(f->id, "[@");
  for (size_t i = 0; i < m->n_defs; i++)
    if (word_is(f->id, len, m->defs[i].name) && strcmp(m->defs[i].section, f->section) == 0 &&
        view_lookup(v, m->defs[i].name, f->section, NULL) == &m->defs[i])
      return &m->defs[i];
  return NULL;
}

/* Elaborates the formula, so that the model notes what is looked up. */
static void look_up(const struct view *v, const struct digits_formula *f) {
  OWNED(elaboration) el;
  struct diag d = {0};
  struct matrix left, right;
  elaboration_init(&el, *v, NULL, 0);
  const struct definition *def = definition_of(v, f);
  const struct statement_record *r = def ? NULL : view_record(v, f->record);
  if (def) elaborate(&left, &el, def->stmt->sides[0], def->src, def->section, &d);
  for (int k = 0; r && k < r->n_stmts; k++)
    for (int i = 0; i + 1 < r->stmts[k]->n_sides; i++)
      elaborate_sides(&left, &right, &el, r->stmts[k], i, r->src, r->section, &d);
}

/* Of the proofs of a record: none at all, or each of them. */
static bool has_proofs(bool *all, const struct stable_proofs *p, const struct statement_record *r) {
  bool any = false;
  *all = true;
  for (size_t i = 0; i < p->n; i++) {
    if (p->item[i].record != r) continue;
    any = true;
    *all = *all && !p->item[i].why_not;
  }
  return any;
}

bool digits_replacement(struct text *out, const struct model *m, const struct stable_proofs *p,
                        const struct digits_formula *f) {
  OWNED(model_use) use;
  const struct model noting = model_noting(&use, m);
  look_up(&(struct view){.model = &noting, .layer = LAYER_STABLE}, f);
  bool proved = true, all;
  for (size_t i = 0; i < m->n_records; i++) {
    if (m->records[i].rank != RANK_STABLE || !model_use_has(&use, m, i) || !has_proofs(&all, p, &m->records[i]))
      continue;
    text_printf(out, "%s%s", out->len ? ", " : "", m->records[i].id);
    proved = proved && all;
  }
  return proved && out->len > 0;
}
