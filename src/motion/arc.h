/* One pass through the word (struct dyn_arc) whose events are known to lie near given times. */
#ifndef STICKSLIP_ARC_H
#define STICKSLIP_ARC_H

#include "num/calc.h"
#include "stickslip/dynamics.h"

/* The arc whose events lie near the four given times, which are elements of the arc's own type. */
int arc_run_near(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near);

#endif
