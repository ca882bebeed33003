/* One pass through the word (struct dyn_arc of dynamics.h), its events being known or searched phase by phase. */
#ifndef STICKSLIP_ARC_H
#define STICKSLIP_ARC_H

#include "dynamics.h"
#include "num/calc.h"

/* The arc whose events lie near the times of near (elements of the arc's own type) or of guess; where both are NULL,
   that of first events, each searched in double precision from the state in which its phase begins. */
int arc_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]);

/* --- map.c: all phases at once --- */

/* The arc whose events lie near times that are right to an eighth of their bits at least: those of near or, when it is
   NULL, those of guess; of mpfr or of balls.  SS_UNABLE also where a longer way may find the arc. */
int map_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]);

#endif
