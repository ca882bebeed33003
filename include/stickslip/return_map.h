/* The return map of the word D-Gamma-H-C in double precision, for speed: from r = z_2 - z_1 at the end of the global stick
   phase (w = z_1 - chi z_2 = e1, both velocities V) to r at the end of phase C, a few hundred nanoseconds.

   Every event is the first positive root of its switching function: t_b by the shape of the rise, t_c by polynomials whose
   error has a bound for all time, t_d by the circle that phase C turns on.  Where that is not plain - an event that grazes,
   close roots, a very long phase - the parabolas of dyn_first_event_d decide, slower, and grazing says so.

   Errors are a few times those that rounding the parameters and r would make: within 8 (1 + kappa) 2^-53 in 99 outputs of 100,
   as tests/check_return_map.c asserts; a search for the worst (stickslip stability dyn_return_map) found 90 (1 + kappa) 2^-53.
   Where they would be larger still - chi within 1/16 of 0 or 1, eta beyond 8 or 1/8, a force or r 32 times V, V 32 times a force,
   what the parabolas found - the numbers come from balls near the events, in some tens of microseconds, rounded once; what a
   double cannot hold is SS_UNABLE. */
#ifndef STICKSLIP_RETURN_MAP_H
#define STICKSLIP_RETURN_MAP_H

#include "stickslip/dynamics.h"

struct dyn_return {
  double t[N_PHASES]; /* by phase; that of D, of any sign, is the one of the next stick phase */
  double r_end;
  double slope;  /* d r_end / d r; infinite or meaningless where an event grazes */
  bool grazing;  /* as dyn_first_event_d */
  bool searched; /* the slow way was taken */
};

/* SS_DOMAIN: outside the domain of dynamics.h; r not below e2/chi; or proved that some event never comes.  SS_UNABLE:
   NaN or infinite r; a phase longer than lim->t_max, or a search longer than lim->max_steps.  lim may be NULL. */
int dyn_return_map(struct dyn_return *out, const double params[N_PARAMS], double r, const struct dyn_limits *lim);

/* The same over balls, near the times of guess (that of D is not read); they are not proved to be first. */
enum { RETURN_TA, RETURN_TB, RETURN_TC, RETURN_TD, RETURN_R, RETURN_SLOPE, N_RETURN };
int dyn_return_near(struct num_vec *out, const struct num_vec *params, const void *r, const double guess[N_PHASES]);

#endif
