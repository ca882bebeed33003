/* In which record a node is written.  Scalars carry no place, but equal scalars of one elaboration are one pointer:
   every subexpression of every definition and statement is elaborated by itself, and its scalars are noted with the
   record that it stands in.  A function's body is noted at every time that the paper names. */
#include <string.h>

#include "stability_impl.h"
#include "value/names.h"

static void note(struct digits_set *s, const struct expr *scalar, const char *id) {
  if (scalar->kind == EXPR_NUM) return;
  *SS_PUSH(s->place, s->n_places, s->cap_places) = (struct digits_source){scalar, id};
}

static void note_at_times(struct digits_set *s, const struct expr *scalar, const char *param, const char *id) {
  struct expr_pool *p = &s->el.pool;
  for (int i = 0; i < N_PHASES; i++) note(s, expr_subst(p, scalar, param, expr_sym(p, name_time[i])), id);
}

/* A subexpression that has no meaning by itself, as a literal 0 for a block, is passed over. */
static void note_tree(struct digits_set *s, const struct expr *e, const struct source *src, const char *section,
                      const char *id, const char *param) {
  struct matrix m;
  struct diag ignored = {0};
  bool called = e->kind == EXPR_CALL && e->order == 0; /* what it stands for is written elsewhere */
  if (e->kind == EXPR_NUM || e->kind == EXPR_SYM || e->kind == EXPR_FIRST_ORDER) return;
  if (!called && elaborate(&m, &s->el, e, src, section, &ignored))
    for (int k = 0; k < m.rows * m.cols; k++) {
      if (m.e[k]->n_args == 0) continue;
      note(s, m.e[k], id);
      if (param) note_at_times(s, m.e[k], param, id);
    }
  for (int k = 0; k < e->n_args; k++) note_tree(s, e->args[k], src, section, id, param);
}

void digits_note_definition(struct digits_set *s, const struct definition *def) {
  const struct stmt *st = def->stmt;
  struct matrix m;
  struct diag ignored = {0};
  if (st->kind == STMT_ROOT && elaborate_text(&m, &s->el, def->name, def->name, def->section, &ignored))
    note(s, m.e[0], def->record->id_name);
  note_tree(s, st->sides[0], def->src, def->section, def->record->id_name, st->param);
}

void digits_note_record(struct digits_set *s, const struct statement_record *r) {
  for (int i = 0; i < r->n_stmts; i++)
    for (int k = 0; r->stmts[i]->kind == STMT_RELATION && k < r->stmts[i]->n_sides; k++)
      note_tree(s, r->stmts[i]->sides[k], r->src, r->section, r->record->id_name, NULL);
}

static const struct digits_source *find(const struct digits_set *s, const struct expr *e) {
  for (size_t i = 0; i < s->n_places; i++)
    if (s->place[i].e == e) return &s->place[i];
  return NULL;
}

static bool uses(const struct tape *t, slong i, slong node) {
  for (slong k = 0; k < tape_operands(t, i); k++)
    if (tape_operand(t, i, k) == node) return true;
  return false;
}

const char *digits_record_of(const struct digits_set *s, const struct digits_formula *f, slong node) {
  if (f->kernel || node < 0) return NULL;
  const struct digits_source *p = find(s, f->node[node]);
  for (slong i = node + 1; !p && i < f->tape.n;
       i++) /* made by a product of matrices: the record of what it is part of */
    if (uses(&f->tape, i, node)) {
      node = i;
      p = find(s, f->node[i]);
    }
  return p ? p->id : NULL;
}
