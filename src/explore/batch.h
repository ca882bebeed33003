/* Many periodic orbits with their multipliers at once: dyn_orbit_warm of warm.h on lanes of vectors.

   Arrays of structure: row i of params, guess and out holds one quantity of all n points.  A fixed number of Newton's
   steps goes from the guess, every output is formed after the last one, and what cannot be decided in straight-line
   code is left open with a status.  A point's result depends on its own row alone, and its bits neither on the
   machine's vectors nor on n or its place. */
#ifndef STICKSLIP_EXPLORE_BATCH_H
#define STICKSLIP_EXPLORE_BATCH_H

#include "motion/warm.h"

/* The orbits near guess[0][j] = t_b, guess[1][j] = t_c; three steps of Newton's iteration go from there, so that a
   guess within some ten-thousandths is good enough.  For each point j < n: status[j] = SS_OK: out[...][j] and
   violations[j] are what dyn_orbit_warm gives with nothing unsure, but for rounding. SS_DOMAIN: outside the domain of
   dynamics.h. SS_UNABLE: ask dyn_orbit_warm; this alone says nothing about the point (the guess was too far off for the
   steps, or a condition needs a closer look). Without SS_OK the outputs are NaN and violations[j] = 0. Returns the
   statuses OR-ed.

   Error of an output: that of dyn_orbit_warm, and like it measured, not proved (check_batch.c). */
int dyn_orbits_batch(double *const out[N_DYN_OUT], unsigned *violations, int *status,
                     const double *const params[N_PARAMS], const double *const guess[2], slong n);

#endif
