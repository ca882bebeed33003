/* How near a formula is to returning no value, from the true values of its nodes, so that a search can climb towards
   failures instead of meeting them by chance: the largest node against the largest double, the smallest that still
   matters against the smallest normal one, and for each quotient how many of the 53 bits of its divisor's operands
   cancel. */
#include <math.h>

#include "stability_impl.h"

static const double MOST_NUMBER = 1024, LEAST_NORMAL = -1022, BITS = 53;

static slong largest_entry(const struct digits_bench *w) {
  slong best = 0;
  for (slong k = 1; k < w->f->n; k++)
    if (digits_log2(num_vec_at(&w->b, w->f->out[k])) > digits_log2(num_vec_at(&w->b, w->f->out[best]))) best = k;
  return best;
}

/* Below the normal numbers it matters as far as its rounding moves the result. */
static void nearness_under(double *strain, struct digits_bench *w) {
  const struct tape *t = &w->f->tape;
  bool known = false;
  for (slong i = 0; i < t->n; i++) {
    arb_srcptr v = num_vec_at(&w->b, i);
    if (!tape_operands(t, i) || tape_only_under_rounded(t, i) || arb_contains_zero(v)) continue;
    double bits = -digits_log2(v);
    if (bits / -LEAST_NORMAL <= *strain) continue;
    if (bits > -LEAST_NORMAL) {
      slong which = largest_entry(w);
      double size = digits_log2(num_vec_at(&w->b, w->f->out[which]));
      if (!known) digits_adjoint(w, which, size);
      known = true;
      arb_srcptr a = num_vec_at(&w->adjoint, i);
      bits += arb_is_zero(a) ? -INFINITY : fmin(0, digits_log2(a) - bits - size);
    }
    *strain = fmax(*strain, bits / -LEAST_NORMAL);
  }
}

static double cancelled(const struct digits_bench *w, slong i) {
  const struct tape *t = &w->f->tape;
  const struct tape_instr *in = &t->code[i];
  bool sum = in->op == TAPE_add || in->op == TAPE_sub;
  if (!sum || (!tape_operands(t, in->a) && !tape_operands(t, in->b)))
    return -INFINITY; /* exact operands: never a wrong zero */
  double most = fmax(digits_log2(num_vec_at(&w->b, in->a)), digits_log2(num_vec_at(&w->b, in->b)));
  return (most - digits_log2(num_vec_at(&w->b, i))) / BITS;
}

void digits_nearness(double strain[N_NEARNESSES], struct digits_bench *w) {
  const struct tape *t = &w->f->tape;
  for (int k = 0; k < N_NEARNESSES; k++) strain[k] = -INFINITY;
  if (w->f->kernel) return;
  for (slong i = 0; i < t->n; i++) {
    if (w->b_flags[i] || tape_only_under_rounded(t, i)) continue;
    if (tape_operands(t, i))
      strain[NEARNESS_OVER] = fmax(strain[NEARNESS_OVER], digits_log2(num_vec_at(&w->b, i)) / MOST_NUMBER);
    if (t->code[i].op == TAPE_div)
      strain[NEARNESS_DIVISOR] = fmax(strain[NEARNESS_DIVISOR], cancelled(w, t->code[i].b));
  }
  nearness_under(&strain[NEARNESS_UNDER], w);
}

double digits_extreme(const struct digits_formula *f, const double *x) {
  double most = 0;
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    if (x[k] != 0) most = fmax(most, fabs(log2(fabs(x[k]))));
    if (f->input[k] == INPUT_CHI && x[k] < 1) most = fmax(most, -log2(1 - x[k]));
  }
  return most;
}
