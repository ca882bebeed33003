/* Lists of constraints by exact algebra: which of them make an orbit admissible, and what they ask of u_r1 and u_r2. */
#ifndef STICKSLIP_EXACT_CONSTRAINTS_H
#define STICKSLIP_EXACT_CONSTRAINTS_H

#include "condition.h"

/* Do the constraints hold together on the orbits that are admissible, and on no others?  Each follows from t_a > 0 and
   (2) along the phases, and each of these from them. */
bool exact_constraints(const struct conditions *list);

/* Is the least u_r1 (mass 0) or u_r2 with which an admissible orbit is realistic the tape's value?  u_ri + f_i is twice
   u_ri less that value where the mass begins to stick, and does not decrease while it sticks. */
bool exact_least_friction(const struct tape *least, int mass);

#endif
