/* The derivative of an element by a free symbol: the chain rule over the generators.  The symbol's own generator has
   the rate 1, sin u has cos u u', cos u has -sin u u' and exp u has exp u u'.  A root that depends on the symbol is
   refused. */
#include <string.h>

#include "exact_impl.h"

/* d(num/den)/dx_var = (num' den - num den')/den^2. */
static void partial(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong var) {
  NUMBERS(polynomial, a, b);
  fmpz_mpoly_derivative(a, &x->num, var, ring());
  fmpz_mpoly_mul(a, a, &x->den, ring());
  fmpz_mpoly_derivative(b, &x->den, var, ring());
  fmpz_mpoly_mul(b, b, &x->num, ring());
  fmpz_mpoly_sub(&z->num, a, b, ring());
  fmpz_mpoly_mul(&z->den, &x->den, &x->den, ring());
  fmpz_mpoly_q_canonicalise(z, ring());
}

/* How generator i changes with the symbol: cos u u', -sin u u' and exp u u'. */
static val generator_rate(struct calc *c, struct exact_field *f, slong i, const char *name) {
  const struct generator *g = &f->gen[i];
  if (g->op == TAPE_INPUT) return calc_d(c, strcmp(g->name, name) == 0);
  fmpz_mpoly_q_struct *rate = calc_new(c), *sine = calc_new(c), *cosine = calc_new(c);
  bool smooth = g->op == TAPE_sin || g->op == TAPE_cos || g->op == TAPE_exp;
  for (slong k = 0; c->status == SS_OK && k < g->n_args; k++) {
    c->status = exact_derivative(rate, f, &g->args[k], name);
    if (c->status == SS_OK && !exact_is_zero(rate) && !smooth) c->status = SS_UNABLE;
  }
  if (c->status != SS_OK || exact_is_zero(rate)) return rate;
  if (g->op == TAPE_exp) {
    fmpz_mpoly_q_gen(sine, variable(i), ring());
    return calc_mul(c, rate, sine);
  }
  c->status = exact_sin_cos(sine, cosine, f, &g->args[0]);
  return g->op == TAPE_sin ? calc_mul(c, rate, cosine) : calc_neg(c, calc_mul(c, rate, sine));
}

int exact_derivative(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name) {
  int used[EXACT_GENERATORS];
  struct calc c = exact_calc(f);
  val sum = calc_d(&c, 0);
  fmpz_mpoly_q_used_vars(used, x, ring());
  for (slong i = 0; c.status == SS_OK && i < f->n; i++) {
    if (!used[variable(i)]) continue;
    val rate = generator_rate(&c, f, i, name);
    if (c.status != SS_OK || exact_is_zero(rate)) continue;
    fmpz_mpoly_q_struct *slope = calc_new(&c);
    partial(slope, x, variable(i));
    c.status = exact_reduce(slope, f);
    sum = calc_add(&c, sum, calc_mul(&c, slope, rate));
  }
  return exact_finish(z, &c, sum);
}
