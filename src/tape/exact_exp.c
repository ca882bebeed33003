/* Exponentials in a field.  That of a sum is a product, with a generator exp(m/q) for each of its terms p m/q: so
   exp(a + b) = exp(a) exp(b) and exp(-a) = 1/exp(a) hold by themselves.  exp(t/2) and exp(t) are two generators; that
   one is the square of the other is not known here. */
#include <stdlib.h>

#include "exact_impl.h"

enum { MOST_FACTORS = 16 };

/* z times exp(p u); a large p stays in the argument. */
static val multiply(val z, struct calc *c, struct exact_field *f, const fmpz_mpoly_q_struct *u, const fmpz_t p) {
  fmpz_mpoly_q_struct *factor = calc_new(c), *all = calc_new(c);
  slong n = fmpz_cmpabs(p, (const fmpz[]){MOST_FACTORS}) <= 0 ? labs(fmpz_get_si(p)) : 1;
  fmpz_mpoly_q_set(all, u, ring());
  if (n == 1 && !fmpz_is_pm1(p)) {
    fmpz_mpoly_q_mul_fmpz(all, all, p, ring());
    if (fmpz_sgn(p) < 0) fmpz_mpoly_q_neg(all, all, ring());
  }
  c->status |= exact_set_generator(factor, exact_generator(f, TAPE_exp, NULL, all, 1, 0));
  for (slong i = 0; i < n; i++) z = fmpz_sgn(p) < 0 ? calc_div(c, z, factor) : calc_mul(c, z, factor);
  return z;
}

int exact_exp(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *term = calc_new(&c);
  val product = calc_d(&c, 1);
  NUMBERS(fmpz, p);
  for (slong i = 0; c.status == SS_OK && i < fmpz_mpoly_length(&x->num, ring()); i++) {
    exact_term(term, x, i);
    if (fmpz_mpoly_length(&term->num, ring()) != 1) abort(); /* a monomial over what it has no factor of */
    fmpz_mpoly_get_term_coeff_fmpz(p, &term->num, 0, ring());
    fmpz_mpoly_scalar_divexact_fmpz(&term->num, &term->num, p, ring());
    product = multiply(product, &c, f, term, p);
  }
  return exact_finish(z, &c, product);
}
