/* Both forms of one quantity, read from their layers onto tapes and compared entry by entry in the field.  Quantities
   that both forms are made of may be held as unknowns: forms that are equal whatever these are need no expansion of
   them. */
#include <stdlib.h>
#include <string.h>

#include "stable_impl.h"

/* Quantities that long forms are made of in both layers alike.  Where forms are equal whatever these are, they are
   equal if each of these is the same in both layers.  Of the first that is proved directly; g_1 = 1 - omega_1^2 has a
   name in the stable layer alone.  Of the others it follows from what is proved before, or is. */
const struct override stable_held[N_HELD] = {{"J_b", 2, 1},      {"ktilde_1", 1, 1}, {"H_13", 1, 1},     {"H_23", 1, 1},
                                             {"ktilde_3", 1, 1}, {"ktilde_4", 1, 1}, {"ktilde_5", 1, 1}, {"g_1", 1, 1},
                                             {"N_1", 2, 2},      {"N_2", 2, 2},      {"N_3", 2, 2},      {"N_4", 2, 2},
                                             {"S_c", 4, 1},      {"J_c", 3, 2}};

void reading_init(struct reading *r, const struct model *m, enum layer layer, const struct unknowns *u) {
  *r = (struct reading){.n = 0};
  elaboration_init(&r->el, (struct view){m, layer, NULL, NULL}, u->name, u->n);
}

void reading_clear(struct reading *r) {
  tape_clear(&r->tape);
  text_clear(&r->shapes);
  free(r->e);
  elaboration_clear(&r->el);
}

static void add_entries(struct reading *r, const struct matrix *m) {
  text_printf(&r->shapes, "%dx%d ", m->rows, m->cols);
  for (int i = 0; i < m->rows * m->cols; i++) *SS_PUSH(r->e, r->n, r->cap) = m->e[i];
}

bool reading_value(struct reading *r, const char *value, const char *section, struct diag *d) {
  struct matrix m;
  bool ok = elaborate_text(&m, &r->el, value, value, section, d);
  if (ok) add_entries(r, &m);
  return ok;
}

bool reading_record(struct reading *r, const struct statement_record *of, struct diag *d) {
  bool ok = true;
  for (int k = 0; ok && k < of->n_stmts; k++)
    for (int i = 0; ok && i + 1 < of->stmts[k]->n_sides; i++) {
      struct matrix left, right;
      ok = elaborate_sides(&left, &right, &r->el, of->stmts[k], i, of->src, of->section, d);
      if (!ok) break;
      add_entries(r, &left);
      add_entries(r, &right);
    }
  return ok;
}

/* What the parts that a tape uses are equal to, in a field. */
static bool value_parts(struct stable_field *s, struct part_value v[MOST_PARTS], const struct tape *used,
                        const struct model *m, const struct unknowns *u, struct diag *d) {
  bool ok = true;
  s->part = v;
  for (int i = 0; ok && u->n > 0 && i < u->n_parts; i++) {
    if (!tape_reads_matrix(used, u->part[i].name)) continue;
    OWNED(reading) r;
    reading_init(&r, m, LAYER_CORRECTED, u);
    ok = reading_value(&r, u->part[i].equals, u->part[i].section, d) && elaboration_tape(&r.tape, &r.el, r.e, r.n, d);
    if (ok) {
      v[s->n_parts] = (struct part_value){.part = &u->part[i]};
      s->status |= exact_eval(&v[s->n_parts++].value, &s->c, s->field, &r.tape);
    }
  }
  return ok;
}

/* Sets p->why_not to the reason for which entries are not shown equal in a field with angles over that unit, or to
   NULL. */
static bool compare_in(struct stable_proof *p, struct reading r[2], slong unit, const struct model *m,
                       const struct unknowns *u, struct diag *d) {
  OWNED(stable_field) s;
  struct num_vec v[2];
  struct part_value part[MOST_PARTS];
  stable_field_make(&s, unit);
  bool ok = value_parts(&s, part, &r[1].tape, m, u, d);
  int status = s.status;
  for (int i = 0; i < 2; i++) status |= exact_eval(&v[i], &s.c, s.field, &r[i].tape);
  p->why_not = status & SS_DOMAIN   ? "a divisor is zero for all parameters"
               : status & SS_UNABLE ? "an expression outgrew the budget of exact algebra"
                                    : NULL;
  for (slong i = 0; !p->why_not && i < v[0].len; i++)
    if (!exact_equal(s.field, num_vec_at(&v[0], i), num_vec_at(&v[1], i)))
      p->why_not = "an entry differs, as far as exact algebra knows";
  p->entries = (int)r[0].n;
  p->largest = exact_largest(s.field);
  return ok;
}

bool readings_same_shapes(const struct reading r[2]) {
  return strcmp(text_str(&r[0].shapes), text_str(&r[1].shapes)) == 0;
}

static int times_in(const struct tape *t) {
  int n = tape_input(t, "t") >= 0;
  for (int ph = 0; ph < N_PHASES; ph++) n += tape_input(t, name_time[ph]) >= 0;
  return n;
}

/* Where there is one time, half of the angles that others have are affordable. */
bool readings_compare(struct stable_proof *p, struct reading r[2], const struct model *m, const struct unknowns *u,
                      struct diag *d) {
  enum { UNIT = 4 };
  p->why_not = "the forms have different shapes";
  if (!readings_same_shapes(r)) return true;
  bool ok = compare_in(p, r, UNIT, m, u, d);
  if (ok && p->why_not && times_in(&r[1].tape) == 1) ok = compare_in(p, r, 2 * UNIT, m, u, d);
  return ok;
}
