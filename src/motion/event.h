/* Where a phase ends: the first root of its switching function. */
#ifndef STICKSLIP_EVENT_H
#define STICKSLIP_EVENT_H

#include "flow.h"

/* As dyn_first_event_d, from the state in its own type. */
int event_first(double *t, bool *grazing, enum phase ph, const struct num_vec *params, const struct num_vec *in,
                const struct dyn_limits *lim);
/* The end of phase D, in which w has a constant speed. */
val event_stick(struct calc *c, const val p[N_PARAMS], const val in[N_STATE]);
/* Newton's iteration in the calc from start, until a step shows that half of the bits are settled. */
val event_newton(struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val start);

#endif
