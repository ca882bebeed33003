/* The motion of a system in double precision, by two routes: solutions of the successive phases patched together, each by
   the series of its affine system's exponential, and GSL's integration of the equations of motion.  They share the law
   and the search for events, each in steps of its own length, so that an excursion between two looks that one of them
   misses shows as a disagreement.  Generic starts: simultaneous events and contacts that are flat within rounding are
   not resolved. */
#ifndef STICKSLIP_MECH_WALK_H
#define STICKSLIP_MECH_WALK_H

#include "mech.h"

enum mech_route { MECH_PATCHED, MECH_INTEGRATED, N_MECH_ROUTES };

/* The moment just after an event; before any, the start. */
struct mech_moment {
  double t;
  int mass; /* that has changed; -1 at the start */
  char phase[MECH_PHASE + 1];
  double z[MECH_STATES]; /* y without its last element, see mech.h */
};
struct mech_motion {
  struct mech_moment *moment; /* the start, then the events */
  int n_moments, most;
  double z[MECH_STATES]; /* at the end */
};
/* start: n positions, n velocities, with loads the cosine and sine of their angle; finite.  Ends at the time `duration`
   or after the event that makes `most` moments.  SS_DOMAIN for a duration above 10^6, a number that is not finite, or a
   start beyond an obstacle; SS_UNABLE when the integrator fails, a state is too large for a double, or 200000 steps of
   1/16 of the fastest motion do not reach the end. */
int mech_simulate(struct mech_motion *out, enum mech_route route, const struct mech *m, const double *start,
                  double duration, int most);
void mech_motion_clear(struct mech_motion *out);

#endif
