/* The derivatives of a formula by its inputs, as a tape of their own. */
#include <stdlib.h>

#include "stability_impl.h"

/* a + b, where zeros leave no trace. */
static const struct expr *plus(struct expr_pool *p, const struct expr *a, const struct expr *b) {
  return expr_is_zero(a) ? b : expr_is_zero(b) ? a : expr_op2(p, EXPR_ADD, a, b);
}

static const struct expr *times(struct expr_pool *p, const struct expr *a, const struct expr *b) {
  return expr_is_zero(a) ? a : expr_is_zero(b) ? b : expr_op2(p, EXPR_MUL, a, b);
}

static const struct expr *slope(struct digits_set *s, const struct expr *e, const char *sym);

/* A root w of sum c_k w^k: w' = -(sum c_k' w^k)/(sum k c_k w^(k-1)). */
static const struct expr *root_slope(struct digits_set *s, const struct tape_root *r, const char *sym) {
  struct expr_pool *p = &s->el.pool;
  const struct expr *w = expr_sym(p, r->name), *above = expr_int(p, 0), *below = expr_int(p, 0);
  for (int k = 0; k < r->n_coeff; k++) {
    above = plus(p, above, times(p, slope(s, r->coeff[k], sym), expr_pow(p, w, k)));
    if (k == 0) continue;
    below = plus(p, below, times(p, expr_op2(p, EXPR_MUL, expr_int(p, k), r->coeff[k]), expr_pow(p, w, k - 1)));
  }
  return expr_is_zero(above) ? above : expr_op1(p, EXPR_NEG, expr_op2(p, EXPR_DIV, above, below));
}

/* The total derivative: roots depend on the inputs too. */
static const struct expr *slope(struct digits_set *s, const struct expr *e, const char *sym) {
  struct expr_pool *p = &s->el.pool;
  const struct expr *sum = expr_diff(p, e, sym);
  for (size_t i = 0; i < s->el.n_roots; i++) {
    const struct expr *by = expr_diff(p, e, s->el.roots[i].name);
    if (!expr_is_zero(by)) sum = plus(p, sum, times(p, by, root_slope(s, &s->el.roots[i], sym)));
  }
  return sum;
}

bool digits_slopes(struct digits_formula *f, struct digits_set *s, struct diag *d) {
  if (f->have_slopes) return true;
  slong n = f->tape.n_inputs;
  FREED const struct expr **e = ss_malloc((size_t)(f->n * n) * sizeof *e);
  for (slong i = 0; i < f->n; i++)
    for (slong k = 0; k < n; k++) e[i * n + k] = slope(s, f->entry[i], f->tape.inputs[k]);
  f->have_slopes = elaboration_tape(&f->slopes, &s->el, e, f->n * n, d);
  return f->have_slopes;
}
