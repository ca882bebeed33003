/* The periodic orbit of the word near a guess, with its multiplier, in double precision.

   For a caller who knows roughly where the orbit is: Newton's iteration on (t_b, t_c), r being what t_b makes it, and
   outputs formed once in twice the precision, a microsecond or two.  Nothing is searched.  What the answer claims is
   checked, and where double precision cannot tell the status or `unsure` says so; the search of dynamics.h then
   decides.

   Errors of dyn_orbit_warm, with u = 2^-53 and kappa the condition number of the output, the sum over the parameters of
   |d ln output / d ln parameter|: at most 8 (1 + kappa) u in every output.  Measured, not proved: tests/check_warm.c
   asserts it over random sets and extreme ones, and that the error is at most 2 u whatever kappa is. */
#ifndef STICKSLIP_MOTION_WARM_H
#define STICKSLIP_MOTION_WARM_H

#include "dynamics.h"

/* Period and times in order of the word; trace: the multiplier, the slope of the return map of r; u1, u2: u_r1_min and
   u_r2_min of struct dyn_orbit. */
enum dyn_output {
  DYN_OUT_Z10,
  DYN_OUT_Z20,
  DYN_OUT_TA,
  DYN_OUT_TB,
  DYN_OUT_TC,
  DYN_OUT_TD,
  DYN_OUT_PERIOD,
  DYN_OUT_TRACE,
  DYN_OUT_U1,
  DYN_OUT_U2,
  N_DYN_OUT
};

/* The orbit near guess = (t_b, t_c).  Bit i of *violations is set when condition i of dyn_condition_id is surely
   broken; of *unsure when double precision cannot tell.  Both zero: the orbit is admissible; both may be NULL.  SS_OK:
   out is an orbit of the word, t_b, t_c and t_d proved to be first roots up to rounding. SS_DOMAIN: outside the domain
   of dynamics.h. SS_UNABLE: no convergence near the guess (a time moved by half of itself); t_b or t_c is not a first
   root; too near a grazing event, a fold or another double zero; t_b later than the first crest of the rise, where m1
   outruns the belt in phase Gamma.  Such an orbit can exist all the same. */
int dyn_orbit_warm(double out[N_DYN_OUT], unsigned *violations, unsigned *unsure, const double params[N_PARAMS],
                   const double guess[2]);

/* The same without conditions, u1 and u2, without the proof of first roots and in double precision throughout, a few
   hundred nanoseconds: what a solver of equations gives.  out[DYN_OUT_U1] and after are not set.  Errors: within 8 (1 +
   kappa) u in 97 outputs of 100, and beyond that the worst seen being a few hundred of them: the trace and t_d near a
   fold after a long phase H, and positions where 1 - chi is small.  Where more than about 8 bits would be lost the
   answer is SS_UNABLE. */
int dyn_orbit_bare(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]);

/* Near which an orbit is looked for. */
struct dyn_place {
  double tb, tc;
  bool up; /* phase C ends above (z_20 > z_10), else below */
};
/* The orbit near a place enclosed, each of its numbers to prec relative bits where its conditioning allows, and
   everything about it decided, as dyn_orbits_find does; some tens of microseconds.  *first: whether t_b and t_c are
   proved to be first roots and phase C to go that way.  SS_UNABLE: no single solution is proved near there.  The orbit
   is to be cleared whatever the status is.  first and lim may be NULL. */
int dyn_orbit_near(struct dyn_orbit *o, truth *first, const fmpq *params, struct dyn_place at, slong prec,
                   const struct dyn_limits *lim);
void dyn_orbit_clear(struct dyn_orbit *o);
arb_srcptr dyn_orbit_output(const struct dyn_orbit *o, enum dyn_output i);

#endif
