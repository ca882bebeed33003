/* The derivative of an element by a free symbol: the chain rule over the generators.  The symbol's own generator has
   the rate 1, sin u has cos u u', cos u has -sin u u' and exp u has exp u u'.  A root that depends on the symbol is
   refused. */
#include <string.h>

#include "exact_impl.h"

/* d(num/den)/dx_var = (num' den - num den')/den^2. */
static void partial(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong var) {
  fmpz_mpoly_t a, b;
  fmpz_mpoly_init(a, ring());
  fmpz_mpoly_init(b, ring());
  fmpz_mpoly_derivative(a, &x->num, var, ring());
  fmpz_mpoly_mul(a, a, &x->den, ring());
  fmpz_mpoly_derivative(b, &x->den, var, ring());
  fmpz_mpoly_mul(b, b, &x->num, ring());
  fmpz_mpoly_sub(&z->num, a, b, ring());
  fmpz_mpoly_mul(&z->den, &x->den, &x->den, ring());
  fmpz_mpoly_q_canonicalise(z, ring());
  fmpz_mpoly_clear(b, ring());
  fmpz_mpoly_clear(a, ring());
}

/* How generator i changes with the symbol: cos u u', -sin u u' and exp u u'. */
static int generator_rate(fmpz_mpoly_q_struct *z, struct exact_field *f, slong i, const char *name) {
  const struct generator *g = &f->gen[i];
  fmpz_mpoly_q_zero(z, ring());
  if (g->op == TAPE_INPUT) {
    if (strcmp(g->name, name) == 0) fmpz_mpoly_q_set_si(z, 1, ring());
    return SS_OK;
  }
  int s = SS_OK;
  for (slong k = 0; s == SS_OK && k < g->n_args; k++) {
    s = exact_derivative(z, f, &g->args[k], name);
    if (s == SS_OK && !exact_is_zero(f, z) && g->op != TAPE_sin && g->op != TAPE_cos && g->op != TAPE_exp)
      s = SS_UNABLE;
  }
  if (s != SS_OK || exact_is_zero(f, z)) return s;
  if (g->op == TAPE_exp) {
    fmpz_mpoly_q_struct itself;
    exact_init(&itself, f);
    s = exact_set_generator(&itself, i);
    if (s == SS_OK) s = exact_apply(num_exact.mul, z, f, z, &itself);
    exact_clear(&itself, f);
    return s;
  }
  fmpz_mpoly_q_struct sine, cosine;
  exact_init(&sine, f);
  exact_init(&cosine, f);
  s = exact_sin_cos(&sine, &cosine, f, &g->args[0]);
  if (s == SS_OK) s = exact_apply(num_exact.mul, z, f, z, g->op == TAPE_sin ? &cosine : &sine);
  if (g->op == TAPE_cos) fmpz_mpoly_q_neg(z, z, ring());
  exact_clear(&cosine, f);
  exact_clear(&sine, f);
  return s;
}

int exact_derivative(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name) {
  fmpz_mpoly_q_struct sum, rate, slope;
  int used[EXACT_GENERATORS], s = SS_OK;
  exact_init(&sum, f);
  exact_init(&rate, f);
  exact_init(&slope, f);
  fmpz_mpoly_q_used_vars(used, x, ring());
  for (slong i = 0; s == SS_OK && i < f->n; i++) {
    if (!used[variable(i)]) continue;
    s = generator_rate(&rate, f, i, name);
    if (s != SS_OK || exact_is_zero(f, &rate)) continue;
    partial(&slope, x, variable(i));
    s = exact_reduce(&slope, f);
    if (s == SS_OK) s = exact_apply(num_exact.mul, &slope, f, &slope, &rate);
    if (s == SS_OK) s = exact_apply(num_exact.add, &sum, f, &sum, &slope);
  }
  fmpz_mpoly_q_swap(z, &sum, ring());
  exact_clear(&slope, f);
  exact_clear(&rate, f);
  exact_clear(&sum, f);
  return s;
}
