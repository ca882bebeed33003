/* One pass through the word at many digits, all phases at once. */
#ifndef STICKSLIP_MAP_H
#define STICKSLIP_MAP_H

#include "num/calc.h"
#include "stickslip/dynamics.h"

/* dyn_arc_run from times that are near the events to an eighth at least, in mpfr or in balls: those of near (elements of
   the arc's type), of guess, or, when both are NULL, first ones of the return map in double precision.  SS_UNABLE also
   where a longer way may find the arc. */
int map_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]);

#endif
