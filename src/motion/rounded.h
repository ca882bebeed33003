/* Results in double precision that are right to the last bit or so, whatever the formula loses on the way: the formula
   is worked out in balls, whose precision rises until the result is known, and the result is rounded once. */
#ifndef STICKSLIP_ROUNDED_H
#define STICKSLIP_ROUNDED_H

#include "dynamics.h"

/* Results of one phase from the parameters, a state and a time (both may be NULL where the function reads none). */
typedef int (*phase_function)(struct num_vec *out, enum phase ph, const struct num_vec *params,
                              const struct num_vec *in, const void *t);
/* The function; in double precision by way of balls, so that each result is within 2^-53 of itself: SS_UNABLE where one
   is beyond the range of normal doubles or not known at 4096 bits.  out may alias in. */
int rounded_run(struct num_vec *out, phase_function run, enum phase ph, const struct num_vec *params,
                const struct num_vec *in, const void *t);

#endif
