/* A chain of n masses on a belt moving at V: mass 1 is tied to the ground, each further mass to the one before.

     x_i'' = a_i (u_i - f_i)      f = K x, K tridiagonal from the springs
     |f_i| <= u_ri while mass i sticks (x_i' = V), else u_i = u_si sign(V - x_i')

   With n = 2, springs 1 - chi and chi, a = (1, eta) it is the system of coulomb.h.  Two routes: solutions of the
   successive configurations patched together, each by the matrix exponential of its affine system, and direct numerical
   integration.  They share the law and the search for events.

   Domain: 1 <= n <= CHAIN_MOST, springs, a, V > 0, 0 <= u_si < u_ri; generic starts: simultaneous events and contacts
   that are flat within rounding are not resolved. */
#ifndef STICKSLIP_MOTION_CHAIN_H
#define STICKSLIP_MOTION_CHAIN_H

#include "coulomb.h"

enum { CHAIN_MOST = 6, CHAIN_EVENTS = 256 };

struct chain {
  int n;
  double spring[CHAIN_MOST], mobility[CHAIN_MOST], V, us[CHAIN_MOST], ur[CHAIN_MOST];
};
struct chain_event {
  double t;
  int mass;
  enum coulomb_mode to;
};
struct chain_motion {
  double z[2 * CHAIN_MOST]; /* x_1 ... x_n, x_1' ... x_n' at the end */
  struct chain_event event[CHAIN_EVENTS];
  int n_events;
};
enum chain_route { CHAIN_PATCHED, CHAIN_INTEGRATED, N_CHAIN_ROUTES };

/* start: n positions, n velocities.  SS_DOMAIN outside the domain, SS_UNABLE when CHAIN_EVENTS are not enough or the
   integrator fails. */
int chain_simulate(struct chain_motion *m, enum chain_route route, const struct chain *c, const double *start,
                   double duration);

#endif
