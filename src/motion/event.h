/* Where a phase ends: the first root of its switching function. */
#ifndef STICKSLIP_EVENT_H
#define STICKSLIP_EVENT_H

#include "flow.h"

/* What events depend on in a state.  Positions near chi = 1 are so large that w would be lost in them. */
struct event_view {
  double w, r, dw, rise; /* dw: w'; rise: chi r - e2 */
  double v[2], over[2];  /* velocities; over V */
  double slip;           /* z_2' - z_1' */
};
/* As dyn_first_event_d. */
int event_first_d(double *t, bool *grazing, enum phase ph, const double params[N_PARAMS], const struct event_view *z,
                  const struct dyn_limits *lim);
/* The end of phase D, in which w has a constant speed. */
val event_stick(struct calc *c, const val p[N_PARAMS], const val in[N_STATE]);
/* Newton's iteration in the calc from start, until a step shows that half of the bits are settled. */
val event_newton(struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val start);

#endif
