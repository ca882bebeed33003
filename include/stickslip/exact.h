/* Tapes over rational functions with rational coefficients: to prove that two tapes compute the same.

   The field is Q(g1, g2, ...) with a generator for each free symbol and for each sine, cosine, square root and root of a
   polynomial, known again when its argument (its coefficients) is equal as a rational function; sin(-u) = -sin(u),
   cos(-u) = cos(u), cot = cos/sin.  Symbols may be defined by facts.  Other relations between generators (sin^2 + cos^2 = 1, sqrt(u)^2 = u) are not used.  So
   equal elements are equal functions wherever both are defined; unequal elements say nothing.

   A computation that would hold more than EXACT_TERMS terms in a numerator or denominator, or need more than
   EXACT_GENERATORS generators, is given up: SS_UNABLE. */
#ifndef STICKSLIP_EXACT_H
#define STICKSLIP_EXACT_H

#include "stickslip/flint_compat.h"
#include "stickslip/tape.h"

enum { EXACT_GENERATORS = 64, EXACT_TERMS = 256 };

/* A symbol that is not free: what it equals, as a tape of one output.  Facts may use each other, not in a circle. */
struct exact_fact {
  const char *name;
  struct tape tape;
};

struct exact_field;
/* The facts are borrowed. */
struct exact_field *exact_field_new(const struct exact_fact *fact, int n_facts);
void exact_field_free(struct exact_field *f);

/* The outputs of a tape as elements of a field. */
struct exact_vec {
  struct exact_field *field;
  slong len;
  fmpz_mpoly_q_struct *x;
};
/* SS_OK, SS_DOMAIN (a division by zero) or SS_UNABLE; then the values mean nothing, but must be cleared all the same. */
int exact_eval(struct exact_vec *out, struct exact_field *f, const struct tape *t);
void exact_vec_clear(struct exact_vec *v);

/* The sign of k when x = k y with k a nonzero rational times powers of the named symbols, which must be positive
   wherever the answer is used (none: x = y up to a rational factor); 0 when there is none, or it cannot be told.  Two
   zeros give 1. */
int exact_ratio_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y,
                     const char *const *positive, int n_positive);
bool exact_is_zero(const struct exact_field *f, const fmpz_mpoly_q_struct *x);
bool exact_equal(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y);
/* z = x - y; false when it grows too large. */
bool exact_sub(fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
               const fmpz_mpoly_q_struct *y);
void exact_init(fmpz_mpoly_q_struct *x, const struct exact_field *f);
void exact_clear(fmpz_mpoly_q_struct *x, const struct exact_field *f);

#endif
