/* Where a node is written.  Scalars carry no place, but equal scalars of one elaboration are one pointer: every
   subexpression of every definition and statement is elaborated by itself, and its scalars are noted with the place of
   its text.  A function's body is noted at every time that the paper names. */
#include <stdlib.h>
#include <string.h>

#include "stability.h"
#include "value/names.h"

static void note(struct digits_set *s, const struct expr *scalar, const struct source *src, size_t at) {
  if (scalar->kind == EXPR_NUM) return;
  s->place = ss_grow(s->place, s->n_places, &s->cap_places, sizeof *s->place);
  s->place[s->n_places++] = (struct digits_source){scalar, src, at};
}

static void note_at_times(struct digits_set *s, const struct expr *scalar, const char *param, const struct source *src,
                          size_t at) {
  struct expr_pool *p = &s->el.pool;
  for (int i = 0; i < N_PHASES; i++) note(s, expr_subst(p, scalar, param, expr_sym(p, name_time[i])), src, at);
}

/* A subexpression that has no meaning by itself, as a literal 0 for a block, is passed over. */
static void note_tree(struct digits_set *s, const struct expr *e, const struct source *src, const char *section,
                      const char *param) {
  struct matrix m;
  struct diag ignored = {0};
  if (e->kind == EXPR_NUM || e->kind == EXPR_SYM || e->kind == EXPR_FIRST_ORDER) return;
  if (elaborate(&m, &s->el, e, src, section, &ignored))
    for (int k = 0; k < m.rows * m.cols; k++) {
      if (m.e[k]->n_args == 0) continue;
      note(s, m.e[k], src, e->span.begin);
      if (param) note_at_times(s, m.e[k], param, src, e->span.begin);
    }
  for (int k = 0; k < e->n_args; k++) note_tree(s, e->args[k], src, section, param);
}

void digits_note_definition(struct digits_set *s, const struct definition *def) {
  const struct stmt *st = def->stmt;
  struct matrix m;
  struct diag ignored = {0};
  if (st->kind == STMT_ROOT && elaborate_name(&m, &s->el, def->name, def->section, &ignored))
    note(s, m.e[0], def->src, st->span.begin);
  note_tree(s, st->sides[0], def->src, def->section, st->param);
}

void digits_note_record(struct digits_set *s, const struct statement_record *r) {
  for (int i = 0; i < r->n_stmts; i++)
    for (int k = 0; r->stmts[i]->kind == STMT_RELATION && k < r->stmts[i]->n_sides; k++)
      note_tree(s, r->stmts[i]->sides[k], r->src, r->section, NULL);
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

/* The folder and the name of a file. */
static const char *short_name(const char *path) {
  const char *name = path;
  int slashes = 0;
  for (const char *p = path + strlen(path); p > path && slashes < 2; p--)
    if (p[-1] == '/' && ++slashes <= 2) name = p;
  return slashes < 2 ? path : name;
}

bool digits_print_place(struct text *out, const struct digits_set *s, const struct digits_formula *f, slong node) {
  if (f->kernel || node < 0) return false;
  const struct digits_source *p = find(s, f->node[node]);
  for (slong i = node + 1; !p && i < f->tape.n;
       i++) /* made by a product of matrices: the place of what it is part of */
    if (uses(&f->tape, i, node)) {
      node = i;
      p = find(s, f->node[i]);
    }
  if (!p) return false;
  size_t line, column;
  source_place(&line, &column, p->src, p->at);
  text_printf(out, "%s:%zu", short_name(p->src->name), line);
  return true;
}
