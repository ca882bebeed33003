/* The motion of a system in double precision, by two routes: solutions of the successive phases patched together, each
   by the series of its affine system's exponential, and GSL's integration of the equations of motion.  They share the
   law and the search for events, each in looks of its own length.  An excursion between two looks is searched for where
   the tangents at both allow one.  Generic starts: simultaneous events and contacts that are flat within rounding are
   not resolved. */
#ifndef STICKSLIP_MECH_WALK_H
#define STICKSLIP_MECH_WALK_H

#include "mech.h"

enum mech_route { MECH_PATCHED, MECH_INTEGRATED, N_MECH_ROUTES };

/* The moment just after an event, or at a sample; before any, the start. */
struct mech_moment {
  double t;
  int mass; /* that has changed; -1 at the start and at a sample */
  char phase[MECH_PHASE + 1];
  double z[MECH_STATES], u[MECH_MASSES]; /* y without its last element, see mech.h; the friction forces */
};
/* How far, and who is told.  All but the first two may be zero. */
struct mech_plan {
  double duration;   /* 0 to 10^6 */
  int most;          /* moments that are kept, the start among them; the event that is the last of them ends it */
  long looks;        /* steps of 1/16 of the fastest motion, or while all stick; an event counts as 16; 0: 200000 */
  const char *phase; /* of the start, where it is an orbit's entry, whose rounding changes nothing; NULL: by the law */
  double sample;     /* distance of samples, at 0, sample, 2 sample, ...; a step that ends at one is not counted */
  void *self;
  bool (*told)(void *self, const struct mech_moment *at); /* each event and sample, in order; false: enough */
};
enum mech_outcome {
  MECH_DONE,    /* the time or the last moment is reached, or told has enough */
  MECH_LOOKS,   /* so many steps do not reach the end */
  MECH_RESTING, /* a mass rebounds from an obstacle in hops too short to be followed */
  MECH_LOST     /* the integrator fails, or a state is too large for a double */
};
extern const char *const mech_outcome_name[MECH_LOST + 1];

struct mech_motion {
  struct mech_moment *moment; /* the start, then the events */
  int n_moments;
  enum mech_outcome end;
  double t, z[MECH_STATES]; /* at the end */
};
/* start: n positions, n velocities, with loads what mech_at_angle makes of their angle.  SS_DOMAIN for a duration out
   of its range, a number of the start or of the system that no double holds, or a start beyond an obstacle; SS_UNABLE
   for an end that is not MECH_DONE. */
int mech_simulate(struct mech_motion *out, enum mech_route route, const struct mech *m, const double *start,
                  const struct mech_plan *plan);
void mech_motion_clear(struct mech_motion *out);

#endif
