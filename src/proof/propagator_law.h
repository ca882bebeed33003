/* What makes a matrix function of time the propagator of a phase: P' = A P and P(0) = I.  Stated once, for every number
   type: the exact proofs hold the model's own propagators against it, the route `ode` the paper's matrices at
   points. */
#ifndef STICKSLIP_PROPAGATOR_LAW_H
#define STICKSLIP_PROPAGATOR_LAW_H

#include "num/num.h"

enum { PROPAGATOR_LAW = 32 };

/* The 16 entries of P' - A P, then those of P(0) - I, from 4x4 matrices; all are zero where the law holds. */
int propagator_law(struct num_vec *out, const struct num_vec *p, const struct num_vec *rate,
                   const struct num_vec *start, const struct num_vec *a);

#endif
