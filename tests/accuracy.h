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

/* An orbit: from five parameters the numbers of enum dyn_output; arg says near which times, and keeps what is proved of
   the orbit of the parameters themselves. */
struct orbit_truth {
  double tb, tc;
  bool up;     /* z_20 > z_10 */
  bool found;  /* then: */
  truth first; /* the events are first ones */
  truth holds[N_CONDITIONS];
};
extern const struct method orbit_method;

#endif
