/* What num_exact has beyond the table of a number type: its ring, how large an element is, its value at a point. */
#ifndef STICKSLIP_NUM_EXACT_H
#define STICKSLIP_NUM_EXACT_H

#include "num/flint_more.h"
#include "num/num.h"

/* Elements of num_exact are fmpz_mpoly_q_struct in this ring, ordered lexicographically. */
enum { NUM_EXACT_GENERATORS = 40, NUM_EXACT_PRODUCT = 1 << 17 };
const fmpz_mpoly_ctx_struct *num_exact_ctx(void);
/* Polynomials in it, and quotients of two; for NUMBERS. */
typedef fmpz_mpoly_t polynomial_t;
typedef fmpz_mpoly_q_t quotient_t;
#define polynomial_init(x)  fmpz_mpoly_init(x, num_exact_ctx())
#define polynomial_clear(x) fmpz_mpoly_clear(x, num_exact_ctx())
#define quotient_init(x)    fmpz_mpoly_q_init(x, num_exact_ctx())
#define quotient_clear(x)   fmpz_mpoly_q_clear(x, num_exact_ctx())
OWNED_CLEARING(polynomial)
OWNED_CLEARING(quotient)
/* The larger of the numbers of terms of numerator and denominator. */
slong num_exact_terms(const fmpz_mpoly_q_struct *x);
/* How many terms their product, quotient or (sum) sum or difference can have. */
slong num_exact_work(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y, bool sum);
/* The value where the generators have those NUM_EXACT_GENERATORS values; of a quotient SS_DOMAIN where its denominator
   is zero. */
void num_exact_polynomial_at(fmpq_t z, const fmpz_mpoly_struct *p, const fmpq *value);
int num_exact_at(fmpq_t z, const fmpz_mpoly_q_struct *x, const fmpq *value);

#endif
