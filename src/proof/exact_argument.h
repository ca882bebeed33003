/* Arguments about admissible orbits by exact algebra: what the premises, Coulomb's law (2) along the phase and the
   orbit's own first-order systems say together. */
#ifndef STICKSLIP_EXACT_ARGUMENT_H
#define STICKSLIP_EXACT_ARGUMENT_H

#include "condition.h"

/* Does the condition hold on every admissible orbit, for all u_s1, u_s2 > 0 with which the premises hold?  Its margin
   follows (exact_law.h) at every time of the phase, or it does where the phase begins and its rate does after. */
bool exact_argument(const struct condition *goal, const struct conditions *premises);

/* How the margin changes with u_s1 (i = 0) or u_s2, e_1 and e_2 being what they are: 1 where it grows, 0 where it does
   not change, on every orbit; -1 where that is not known. */
int exact_friction_slope(const struct condition *c, int i);

#endif
