/* The return map of the word D-Gamma-H-C in double precision, for speed: from r = z_2 - z_1 at the end of the global
   stick phase (w = z_1 - chi z_2 = e1, both velocities V) to r at the end of phase C, a few hundred nanoseconds.

   Every event is the first positive root of its switching function: t_b by the shape of the rise, t_c by polynomials
   whose error has a bound for all time, t_d by the circle that phase C turns on.  Where that is not plain - an event
   that grazes, close roots, a very long phase - the parabolas of event_first decide, slower, and grazing says so.

   dyn_return_map forms its outputs once the events are known in twice the precision, or in balls, and rounds each once:
   about a microsecond more than dyn_return_map_d of dynamics.h, which gives what plain double precision does.
   Measured, not proved (tests/check_return_map.c), over all of the domain with chi = k 2^-j and 1 - k 2^-j down to the
   last place: t_b and t_c are first events and each output is within 2^-52 of itself, whatever its condition number,
   unless `grazing` is set; what a double cannot hold is SS_UNABLE.

   Of dyn_return_map_d, with u = 2^-53 and kappa the condition number: within 8 (1 + kappa) u at 98 inputs of 100 of the
   ordinary ones, in t_b everywhere; the worst of 300000 were 7900 (the slope), 6600 (t_d), 5500 (t_c), 190 (t_a) and 70
   (r) times (1 + kappa) u, near a grazing t_c or where phase C hardly turns.  Its use is to be near: a guess, a
   picture, a fate after many passes.

   Where either would err by more than that - chi within 1/16 of 0 or 1, eta beyond 8 or 1/8, a force or r 32 times V, V
   32 times a force, what the parabolas found - both take their numbers from balls near the events, in some tens of
   microseconds. */
#ifndef STICKSLIP_MOTION_RETURN_MAP_H
#define STICKSLIP_MOTION_RETURN_MAP_H

#include "dynamics.h"

struct dyn_return {
  double t[N_PHASES]; /* by phase; that of D, of any sign, is the one of the next stick phase */
  double r_end;
  double slope;  /* d r_end / d r; infinite or meaningless where an event grazes */
  bool grazing;  /* as event_first; the numbers are rough */
  bool searched; /* the slow way was taken */
};

/* SS_DOMAIN: outside the domain of dynamics.h; r not below e2/chi; or proved that some event never comes.  SS_UNABLE:
   NaN or infinite r; a phase or a search longer than dyn_limits_default allows. */
int dyn_return_map(struct dyn_return *out, const double params[N_PARAMS], double r);

/* The same over balls, near the times of guess (that of D is not read); they are not proved to be first. */
enum { RETURN_TA, RETURN_TB, RETURN_TC, RETURN_TD, RETURN_R, RETURN_SLOPE, N_RETURN };
int dyn_return_near(struct num_vec *out, const struct num_vec *params, const void *r, const double guess[N_PHASES]);
/* The same, its t_b and t_c found and proved to be first events in balls: what dyn_return_map is held against.
   SS_UNABLE: not in max_steps steps along phase H, or an event that is double within the balls. */
int dyn_return_first(struct num_vec *out, const struct num_vec *params, const void *r, long max_steps);

#endif
