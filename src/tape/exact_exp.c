/* Exponentials in a field.  That of a sum is a product, with a generator exp(m/q) for each of its terms p m/q: so
   exp(a + b) = exp(a) exp(b) and exp(-a) = 1/exp(a) hold by themselves.  exp(t/2) and exp(t) are two generators; that one
   is the square of the other is not known here. */
#include <stdlib.h>

#include "exact_impl.h"

enum { MOST_FACTORS = 16 };

/* The generator of exp(x). */
static int own_exponential(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  return exact_set_generator(z, exact_generator(f, TAPE_exp, NULL, x, 1, 0));
}

/* z times exp(p u); a large p stays in the argument. */
static int multiply(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *u, const fmpz_t p) {
  fmpz_mpoly_q_struct factor, all;
  exact_init(&factor, f);
  exact_init(&all, f);
  slong n = fmpz_cmpabs(p, (const fmpz[]){MOST_FACTORS}) <= 0 ? labs(fmpz_get_si(p)) : 1;
  fmpz_mpoly_q_set(&all, u, ring());
  if (n == 1 && !fmpz_is_pm1(p)) {
    fmpz_mpoly_q_mul_fmpz(&all, &all, p, ring());
    if (fmpz_sgn(p) < 0) fmpz_mpoly_q_neg(&all, &all, ring());
  }
  int s = own_exponential(&factor, f, &all);
  for (slong i = 0; s == SS_OK && i < n; i++)
    s = exact_apply(fmpz_sgn(p) < 0 ? num_exact.div : num_exact.mul, z, f, z, &factor);
  exact_clear(&all, f);
  exact_clear(&factor, f);
  return s;
}

int exact_exp(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct product, term;
  fmpz_t p;
  fmpz_init(p);
  exact_init(&product, f);
  exact_init(&term, f);
  fmpz_mpoly_q_set_si(&product, 1, ring());
  int s = SS_OK;
  for (slong i = 0; s == SS_OK && i < fmpz_mpoly_length(&x->num, ring()); i++) {
    fmpz_mpoly_get_term(&term.num, &x->num, i, ring());
    fmpz_mpoly_set(&term.den, &x->den, ring());
    fmpz_mpoly_q_canonicalise(&term, ring());
    if (fmpz_mpoly_length(&term.num, ring()) != 1) abort(); /* a monomial over what it has no factor of */
    fmpz_mpoly_get_term_coeff_fmpz(p, &term.num, 0, ring());
    fmpz_mpoly_scalar_divexact_fmpz(&term.num, &term.num, p, ring());
    s = multiply(&product, f, &term, p);
  }
  fmpz_mpoly_q_swap(z, &product, ring());
  exact_clear(&term, f);
  exact_clear(&product, f);
  fmpz_clear(p);
  return s;
}
