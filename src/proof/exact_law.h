/* What Coulomb's law (2) asks of an exact motion, and what follows from it. */
#ifndef STICKSLIP_EXACT_LAW_H
#define STICKSLIP_EXACT_LAW_H

#include "exact_motion.h"

/* An admissible orbit at a time of the phase, with what u_r1 and u_r2 must exceed (friction) or without; every state
   that a condition may name is there. */
void exact_orbit_init(struct exact_motion *m, enum phase ph, int anchor, enum exact_time time, bool friction);

/* At most as many conditions as one phase has. */
enum { EXACT_CONDITIONS = 8 };

/* Of which mass a margin is; of the force on it, as it sticks, where the phase begins or at the time t, and of u_ri +
   f_i (lower) or u_ri - f_i; else of its velocity. */
struct exact_bound {
  int mass;
  bool force, start, lower;
};

/* The margins of (2) in the motion's phase, at the time t and, where a mass sticks, where the phase begins too: V -
   z_i' of a mass that slips, u_ri - f_i of one that sticks under the force f_i, and where the friction is known
   (realistic) u_ri + f_i.  On an admissible motion they are positive.  Returns how many were made, at most
   EXACT_CONDITIONS; 0 where the motion is not said to be admissible.  bound (or NULL): what each is. */
int exact_law_margins(struct num_vec *out, struct exact_bound *bound, struct exact_motion *m);

/* Is the element shown to be positive: a product of what is positive on the whole domain, one of the facts, which are
   positive, times 1, 2, 1/2, chi, or the sum of two such?  Positive factors of it and of the facts may be left out. */
bool exact_follows(struct exact_motion *m, const fmpz_mpoly_q_struct *x, const struct num_vec *facts, int n);

#endif
