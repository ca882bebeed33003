/* Results in double precision that are right to the last bit or so, whatever the formula loses on the way: the formula
   is worked out in balls, whose precision rises until the result is known, and the result is rounded once. */
#ifndef STICKSLIP_ROUNDED_H
#define STICKSLIP_ROUNDED_H

#include "flow.h"

/* A formula of a phase from the parameters, a state (or other numbers) and a time; it need not read all of them. */
typedef void phase_formula(val *out, struct calc *c, enum phase ph, const val p[N_PARAMS], const val *in, val t);
/* Its results; in double precision by way of balls, so that each is within 2^-53 of itself: SS_UNABLE where one is
   beyond the range of normal doubles or not known at 4096 bits.  in and t may be NULL.  out may alias in. */
int rounded_run(struct num_vec *out, phase_formula *f, enum phase ph, const struct num_vec *params,
                const struct num_vec *in, const void *t);
/* What a formula answers that goes from a guess and did not get there: from ROUNDED_NEAR bits on the guess is not near,
   and no precision helps. */
enum { ROUNDED_NEAR = 256 };
static inline int rounded_from_guess(int status, const struct calc *c) {
  return status && c->ctx.prec >= ROUNDED_NEAR ? SS_DOMAIN : status;
}

#endif
