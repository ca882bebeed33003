/* Elimination over a field in which every symbol is free.  What holds of free symbols holds of those of a motion, so
   the rank is the number of pivots wherever the entries are defined if each pivot is a number other than zero times
   powers of symbols that are positive on the whole domain, and zeros are all that is left.  Of other pivots nothing is
   concluded: they may be zero somewhere. */
#include "exact_rank.h"

#include <stdlib.h>

#include "claim/claim.h"
#include "num/num_exact.h"
#include "record/result.h"

struct elimination {
  struct exact_field *field;
  struct calc c, apart; /* of the entries, of the residuals: these may outgrow the budget alone */
  struct num_vec value; /* residuals, then entries */
  int rows, cols, rank;
  bool used[RANK_NAMES]; /* the row has had its pivot */
  struct text pivots;
};

static element *entry(const struct elimination *e, int row, int col) {
  return num_vec_at(&e->value, e->rows + row * e->cols + col);
}

int exact_unit_sign(struct exact_field *f, const element *x) {
  OWNED(calc) c = exact_calc(f);
  return exact_ratio_sign(f, x, calc_d(&c, 1), name_param, P_V + 1);
}

static bool find_pivot(int *row, int *col, const struct elimination *e) {
  for (*row = 0; *row < e->rows; ++*row)
    for (*col = 0; !e->used[*row] && *col < e->cols; ++*col)
      if (exact_unit_sign(e->field, entry(e, *row, *col)) != 0) return true;
  return false;
}

/* row -= (its entry below the pivot / the pivot) times the pivot's row; of the residuals likewise. */
static void clear_row(struct elimination *e, int row, int pivot, int col) {
  struct calc *c = &e->c;
  val factor = calc_div(c, entry(e, row, col), entry(e, pivot, col));
  void *residual = num_vec_at(&e->value, row);
  val term = calc_mul(&e->apart, factor, num_vec_at(&e->value, pivot));
  calc_store(&e->apart, residual, calc_sub(&e->apart, residual, term));
  for (int k = 0; k < e->cols; k++)
    calc_store(c, entry(e, row, k), calc_sub(c, entry(e, row, k), calc_mul(c, factor, entry(e, pivot, k))));
}

static void eliminate(struct elimination *e) {
  int row, col;
  while (e->c.status == SS_OK && find_pivot(&row, &col, e)) {
    e->used[row] = true;
    text_add(&e->pivots, e->rank++ ? ", " : "");
    exact_print(&e->pivots, e->field, entry(e, row, col));
    for (int i = 0; i < e->rows; i++)
      if (!e->used[i]) clear_row(e, i, row, col);
  }
}

/* An entry that is not known to be zero, in a row without a pivot; NULL: there is none. */
static const element *left_over(const struct elimination *e) {
  for (int i = 0; i < e->rows; i++)
    for (int k = 0; !e->used[i] && k < e->cols; k++)
      if (!exact_is_zero(entry(e, i, k))) return entry(e, i, k);
  return NULL;
}

/* A combination of the equations that says that a number which is not zero is zero. */
static bool contradict(const struct elimination *e) {
  bool any = false;
  for (int i = 0; e->apart.status == SS_OK && i < e->rows; i++)
    any = any || (!e->used[i] && exact_unit_sign(e->field, num_vec_at(&e->value, i)) != 0);
  return any;
}

static struct exact_rank conclude(struct audit_result *out, const struct elimination *e) {
  enum { LONG = 4 };
  const element *rest = left_over(e);
  struct exact_rank r = {rest ? -1 : e->rank, e->rank + (rest != NULL), contradict(e), NULL};
  struct text t = {0};
  if (rest) {
    text_printf(&t, "beyond %d pivot%s (%s) every entry left might be zero somewhere on the domain", e->rank,
                plural_s(e->rank), e->rank ? text_str(&e->pivots) : "none");
    if (num_exact_terms(rest) <= LONG) text_add(&t, ", as ");
    if (num_exact_terms(rest) <= LONG) exact_print(&t, e->field, rest);
  } else {
    text_printf(
        &t, "for all values of the other symbols elimination meets %s%s%s and leaves zeros: the rank is %d everywhere",
        e->rank == 0   ? "no pivot"
        : e->rank == 1 ? "the pivot "
                       : "the pivots ",
        text_str(&e->pivots),
        e->rank == 0   ? ""
        : e->rank == 1 ? ", which is nowhere zero,"
                       : ", which are nowhere zero,",
        e->rank);
    if (r.contradict)
      text_add(&t, "; the equations contradict each other: a combination of them says that a number other than zero is "
                   "zero");
  }
  r.note = result_take(out, &t);
  return r;
}

struct tape rank_system_residuals(const struct rank_system *y) {
  struct tape t = y->s.tape;
  t.n_outputs = y->rows;
  t.n = 0;
  for (int i = 0; i < y->rows; i++) t.n = FLINT_MAX(t.n, t.outputs[i] + 1);
  return t;
}

/* Of the entries alone, of which none more is computed once one has failed. */
static int entries_status(const struct rank_system *y) {
  struct tape entries = y->s.tape;
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = exact_calc(f);
  struct num_vec v;
  entries.outputs += y->rows;
  entries.n_outputs -= y->rows;
  return exact_eval(&v, &c, f, &entries);
}

struct exact_rank exact_rank_of(struct audit_result *out, const struct rank_system *y) {
  const struct tape *t = &y->s.tape;
  struct elimination e = {.field = exact_field_new(NULL, 0), .rows = y->rows, .cols = y->cols};
  FREED int *status = ss_malloc((size_t)t->n_outputs * sizeof *status);
  e.c = exact_calc(e.field);
  e.apart = exact_calc(e.field);
  e.c.status = entries_status(y);
  if (e.c.status == SS_OK) {
    exact_eval_each(&e.value, status, &e.c, e.field, t, NULL);
    for (slong i = 0; i < t->n_outputs; i++) (i < y->rows ? &e.apart : &e.c)->status |= status[i];
  }
  eliminate(&e);
  const char *why = e.c.status & SS_DOMAIN
                        ? "a divisor in the matrix of derivatives is zero for all parameters"
                        : "the matrix of derivatives outgrew the budget of exact algebra; besides, its pivots "
                          "would have to be shown zero nowhere on the domain";
  struct exact_rank r = e.c.status == SS_OK ? conclude(out, &e) : (struct exact_rank){-1, 0, false, why};
  text_clear(&e.pivots);
  calc_clear(&e.apart);
  calc_clear(&e.c);
  exact_field_free(e.field);
  return r;
}

bool rank_residuals(const struct expr **out, int *rows, struct elaboration *el, struct judge *j, const struct claim *c,
                    const struct statement_record *r) {
  *rows = 0;
  for (int i = 0; i < r->n_stmts; i++)
    for (int k = 0; r->stmts[i]->kind == STMT_RELATION && k + 1 < r->stmts[i]->n_sides; k++) {
      struct matrix a, b;
      if (r->stmts[i]->ops[k] != REL_EQ) continue; /* it determines nothing */
      if (!elaborate_sides(&a, &b, el, r->stmts[i], k, r->src, r->section, j->d)) return false;
      for (int e = 0; e < a.rows * a.cols; e++) {
        if (*rows == RANK_NAMES) return claim_error(j, c, "statement", "too many equations");
        out[(*rows)++] = expr_op2(&el->pool, EXPR_SUB, a.e[e], b.e[e]);
      }
    }
  return true;
}

bool rank_system_build(struct rank_system *y, struct judge *j, const struct claim *c, struct view view) {
  const char *id = claim_get(c, "statement");
  const struct statement_record *r = id ? view_record(&view, id) : NULL;
  *y = (struct rank_system){.rows = 0};
  y->cols = claim_names_listed(y->unknown, RANK_NAMES, claim_get(c, "unknowns"));
  elaboration_init(&y->s.el, view, NULL, 0);
  if (!r || y->cols == 0) return claim_error(j, c, "statement", "a record and its unknowns are needed");
  const struct expr *out[RANK_NAMES * (RANK_NAMES + 1)];
  if (!rank_residuals(out, &y->rows, &y->s.el, j, c, r)) return false;
  for (int i = 0; i < y->rows; i++)
    for (int k = 0; k < y->cols; k++) out[y->rows + i * y->cols + k] = expr_diff(&y->s.el.pool, out[i], y->unknown[k]);
  if (!elaboration_tape(&y->s.tape, &y->s.el, out, y->rows * (1 + y->cols), j->d)) return false;
  for (int k = 0; k < y->cols; k++) {
    y->input[k] = tape_input(&y->s.tape, y->unknown[k]);
    if (y->input[k] < 0 && !model_is_symbol(view.model, y->unknown[k]))
      return claim_error(j, c, "unknowns", "an unknown that the equations do not contain, and no symbol either");
  }
  return true;
}
