/* Where a phase ends: the first root of its switching function. */
#ifndef STICKSLIP_EVENT_H
#define STICKSLIP_EVENT_H

#include "flow.h"

/* The first positive root of the phase's switching function from the state in, found in double precision (trig_sum.h)
   from forces and velocities formed in the state's own type; *grazing is set when the root found is double within
   rounding, or when a touching that could not be told from a crossing lies before it.  PHASE_D: t of any sign.  Returns
   SS_OK, SS_DOMAIN (proved by periodicity that there is none) or SS_UNABLE (none up to the limits, or up to a time at
   which the rounding of t leaves nothing of an angle).  grazing and lim may be NULL. */
int event_first(double *t, bool *grazing, enum phase ph, const struct num_vec *params, const struct num_vec *in,
                const struct dyn_limits *lim);
/* The end of phase D, in which w has a constant speed. */
val event_stick(struct calc *c, const val p[N_PARAMS], const val in[N_STATE]);
/* Newton's iteration in the calc from start, until a step shows that half of the bits are settled. */
val event_newton(struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val start);

#endif
