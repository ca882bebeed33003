/* One pass through the word at many digits, all phases at once. */
#ifndef STICKSLIP_MAP_H
#define STICKSLIP_MAP_H

#include "dynamics.h"
#include "num/calc.h"

/* Whether there is such a way for the number type: for mpfr and for balls. */
bool map_serves(struct num_ctx ctx);
/* The arc whose events lie near times that are right to an eighth of their bits at least: those of near (elements of
   the arc's type) or, when it is NULL, those of guess.  SS_UNABLE also where a longer way may find the arc, and for
   other types. */
int map_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]);

#endif
