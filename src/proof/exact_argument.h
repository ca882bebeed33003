/* Arguments about admissible orbits by exact algebra: what the premises, Coulomb's law (2) along the phase and the
   orbit's own first-order systems say together. */
#ifndef STICKSLIP_EXACT_ARGUMENT_H
#define STICKSLIP_EXACT_ARGUMENT_H

#include "condition.h"
#include "exact_law.h"

/* Does the condition hold on every admissible orbit, for all u_s1, u_s2 > 0 with which the premises hold?  Its margin
   follows (exact_law.h) at every time of the phase, or it does where the phase begins and its rate does after. */
bool exact_argument(const struct condition *goal, const struct conditions *premises);

/* Is the margin zero on every orbit, admissible or not, at every time of the phase or at that end of it? */
bool exact_vanishes(const struct condition *c, enum exact_time time);

/* How the margin changes with u_s1 (i = 0) or u_s2, e_1 and e_2 being what they are: 1 where it grows, 0 where it does
   not change, on every orbit; -1 where that is not known. */
int exact_friction_slope(const struct condition *c, int i);

/* --- For proofs of the same sort --- */

/* The tape's one value there. */
bool exact_margin(fmpz_mpoly_q_struct *z, struct exact_motion *m, const struct tape *t);
/* The margins of the premises that speak of the motion's time, or of none, from the n-th fact on; how many facts there
   are then. */
int exact_premises(struct num_vec *facts, int n, struct exact_motion *m, const struct conditions *premises);

#endif
