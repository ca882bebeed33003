/* Outputs in double precision held against the truth in balls, relative to how steep the truth is. */
#ifndef STICKSLIP_TESTS_ACCURACY_H
#define STICKSLIP_TESTS_ACCURACY_H

#include "motion/warm.h"

/* What a function computes: its numbers, and what they are in balls of ACCURACY_BITS at inputs of which one (none: -1)
   is larger by 2^-60 of itself; false where that cannot be had. */
enum { ACCURACY_BITS = 160 };
struct method {
  int n_in, n_out;
  bool (*truth)(struct num_vec *out, const double *in, int moved, void *arg);
};

/* The error of each output in units of 2^-53 of itself, and its condition number (NULL: not wanted), the sum over the
   inputs of |d ln output / d ln input|; false where there is no truth. */
bool accuracy_of(double *error, double *condition, const struct method *m, const double *in, const double *got,
                 void *arg);

/* event_first of the program from plain doubles, of whose positions the forces are formed at 128 bits. */
int first_event_d(double *t, bool *grazing, enum phase ph, const double params[N_PARAMS], const double in[N_STATE],
                  const struct dyn_limits *lim);

/* The four switching conditions and Z(period) = Z_0, by matrix exponentials from the orbit's balls alone, in the
   context of params, which are balls; start, unless NULL: the states in which the phases begin. */
void check_six_equations(double (*start)[N_STATE], const struct dyn_orbit *o, const struct num_vec *params,
                         const char *what);

/* Conditions said to be broken are, the others hold, but for those left open. */
void check_conditions(const truth holds[N_CONDITIONS], unsigned violations, unsigned unsure);

/* Holds what was found of an orbit against balls: there is one at its times, of first events; no number errs by more
   than 8 (1 + its condition number) units of 2^-53 of itself, nor by two of them; the conditions are those proved,
   but for the ones left open.  False where the numbers have no condition numbers, since a neighbour has no orbit. */
bool check_orbit_found(double condition[N_DYN_OUT], const double p[N_PARAMS], const double out[N_DYN_OUT],
                       unsigned violations, unsigned unsure);

#endif
