/* The return map and the periodic orbit near a guess in double precision: what a loop of millions calls.

   params are chi, eta, V, e1, e2 in this order (SS_PARAMS); 0 < chi < 1, the others positive, else SS_DOMAIN.  r = z_2
   - z_1 at the end of the global stick phase fixes the state there (w = z_1 - chi z_2 = e1, both velocities V).
   Nothing is allocated but where the slow way is taken; ss_error() is set by wrong arguments alone, so that a loop over
   SS_UNABLE stays fast.

   Errors are measured, not proved: with u = 2^-53, each output of ss_return_map, ss_orbit_warm and ss_orbits_batch was
   within 2^-52 of itself over all of the domain that the tests try, unless grazing is set. */
#ifndef SS_MAP_H
#define SS_MAP_H

#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum ss_param { SS_PARAM_CHI, SS_PARAM_ETA, SS_PARAM_V, SS_PARAM_E1, SS_PARAM_E2, SS_PARAMS };
/* Outputs about an orbit: as in orbit.h. */
enum ss_output {
  SS_OUT_Z10,
  SS_OUT_Z20,
  SS_OUT_T_A,
  SS_OUT_T_B,
  SS_OUT_T_C,
  SS_OUT_T_D,
  SS_OUT_PERIOD,
  SS_OUT_TRACE,
  SS_OUT_U_R1_MIN,
  SS_OUT_U_R2_MIN,
  SS_OUTPUTS
};
/* Bits of violations and unsure; the name of a bit: ss_orbit_violation's, NULL beyond. */
enum ss_condition {
  SS_COND_T_A,
  SS_COND_GAMMA_V1,
  SS_COND_H_V1,
  SS_COND_H_V2,
  SS_COND_C_V2,
  SS_COND_C_W,
  SS_COND_D_R,
  SS_COND_GAMMA_R,
  SS_COND_U_R1, /* of sweep.h alone */
  SS_COND_U_R2,
  SS_CONDITIONS
};
SS_API const char *ss_condition_name(int condition);

/* One pass: r at the end of phase C, the slope d r_end / d r, and the times t_a, t_b, t_c, t_d (t_a being that of the
   next stick phase, of any sign), each event the first of its phase.  About a microsecond.  *grazing: 1 when an event
   is double within rounding; the numbers are rough then.  Outputs but r_end may be NULL.  SS_DOMAIN also: r not below
   e2/chi, or proved that some event never comes.  SS_UNABLE: a phase longer than 1000, or r not finite. */
SS_API int ss_return_map(double *r_end, double *slope, double t[4], int *grazing, const double params[SS_PARAMS],
                         double r);
/* The same in plain double precision, a few hundred nanoseconds; near a grazing event it errs by thousands of units. */
SS_API int ss_return_map_plain(double *r_end, double *slope, double t[4], const double params[SS_PARAMS], double r);

/* The orbit near guess = (t_b, t_c), with its multiplier; a microsecond or two.  Bit i of *violations is set when
   condition i is surely broken, of *unsure when double precision cannot tell; both 0: admissible.  Both may be NULL.
   SS_UNABLE: no convergence near the guess, or too near a grazing event or a fold; an orbit can exist all the same
   (ss_orbits_near, ss_orbits_find). */
SS_API int ss_orbit_warm(double out[SS_OUTPUTS], unsigned *violations, unsigned *unsure, const double params[SS_PARAMS],
                         const double guess[2]);
/* The same without conditions, without the proof that the roots are the first, and in plain double precision: what a
   solver of equations gives, in a few hundred nanoseconds.  The last two of out are NaN. */
SS_API int ss_orbit_bare(double out[SS_OUTPUTS], const double params[SS_PARAMS], const double guess[2]);
/* ss_orbit_warm for n points at once, in lanes of vectors.  Arrays of structure: row i of params,
   guess and out holds quantity i of all points.  status[j] = SS_OK: the point is as ss_orbit_warm gives it with nothing
   unsure. SS_UNABLE: ask ss_orbit_warm; out[.][j] is NaN.  A point's bits depend on its own row alone.  Returns the
   statuses OR-ed. */
SS_API int ss_orbits_batch(double *const out[SS_OUTPUTS], unsigned *violations, int *status,
                           const double *const params[SS_PARAMS], const double *const guess[2], size_t n);

/* The 2x2 Jacobian, row by row, of (z10, z20) -> one pass of the word, by implicit differentiation in balls around the
   numbers given: each entry is within 2^-53 of itself; some tens of microseconds.  guess: times t_a, t_b, t_c, t_d near
   which the events are taken, or NULL for the first ones. *err (or NULL): a bound of the worst entry's error. */
SS_API int ss_return_jacobian(double j[4], double *err, const double params[SS_PARAMS], const double start[2],
                              const double guess[4]);

#ifdef __cplusplus
}
#endif

#endif
