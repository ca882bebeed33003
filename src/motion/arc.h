/* One pass through the word (struct dyn_arc of dynamics.h), its events being known or searched phase by phase. */
#ifndef STICKSLIP_ARC_H
#define STICKSLIP_ARC_H

#include "dynamics.h"
#include "num/calc.h"

/* The arc whose events lie near the four given times, which are elements of the arc's own type. */
int arc_run_near(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near);
/* The same from times in double precision. */
int arc_run_from(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const double guess[N_PHASES]);
/* The arc of first events, each searched in double precision from the state in which its phase begins. */
int arc_run_first(struct dyn_arc *a, const struct num_vec *params, val z10, val z20);

#endif
