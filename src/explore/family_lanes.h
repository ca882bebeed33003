/* Many orbits of a family solved at once from guesses of (t_b, t_c): one lane for each orbit at each point of a
   level. */
#ifndef STICKSLIP_FAMILY_LANES_H
#define STICKSLIP_FAMILY_LANES_H

#include "motion/warm.h"

/* Columns as dyn_orbits_batch reads and writes them, of cap lanes each; zeros: no lanes. */
struct family_lanes {
  slong cap;
  double *params[N_PARAMS], *guess[2], *out[N_DYN_OUT];
  unsigned *violations;
  int *status;
};
/* Room for n lanes at least.  Where it has to grow, every lane gets these parameters; the caller sets the one that
   varies from lane to lane, and guess. */
void family_lanes_room(struct family_lanes *a, slong n, const double params[N_PARAMS]);
/* The first n lanes. */
void family_lanes_solve(struct family_lanes *a, slong n);
void family_lanes_clear(struct family_lanes *a);

#endif
