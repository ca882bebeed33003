/* Long runs: the two routes of coulomb.h in double precision, from one start, beside the same closed forms in MPFR.

   Rounding puts the routes on neighbouring motions.  On an orbit with multiplier m (the eigenvalue of the return
   Jacobian that is not 0, which is its trace) what separates two motions is multiplied by m from one return to the
   next: routes part where |m| > 1, by 1e-6 after about log(1e-6/2^-52)/log|m| returns, and never where |m| < 1.  A run
   records how far apart they are at every return to the global stick phase, and measures that growth.

   Where |m| is so near to 1 that (|m| - 1) times a few units in the last place rounds away, a route in double precision
   can stay on an unstable orbit for good; it then parts from MPFR all the same, which goes.

   MPFR may be relied on as long as its precision exceeds 53 bits by log2|m| a return; its caller chooses. */
#ifndef STICKSLIP_MOTION_LONG_RUN_H
#define STICKSLIP_MOTION_LONG_RUN_H

#include "coulomb.h"

enum long_route { LONG_ODE, LONG_CLOSED, LONG_MPFR, N_LONG_ROUTES };
extern const char *const long_route_name[N_LONG_ROUTES]; /* "ode", "closed", "mpfr" */

/* Both masses have come to stick. */
struct long_return {
  double t, x[2];
  double off;    /* largest difference of x from MPFR's return of the same number; 0 in MPFR's own */
  double late;   /* the same of t */
  size_t events; /* how many of the log's events lie up to here */
};

struct long_run {
  struct coulomb_log log[N_LONG_ROUTES];
  struct long_return *at[N_LONG_ROUTES];
  long n[N_LONG_ROUTES];
  enum coulomb_end end[N_LONG_ROUTES];
  double from[2], scale; /* x_1 and x_2 of the start, and |x_1| + |x_2| + V */
  double displaced;      /* how much further in x_1 the ODE route starts */
  double
      reach; /* how far from the start's positions the start's own multiplier holds; infinite until the caller knows */
};

/* The start of an orbit: displaced by V t_a = (u_r1 - f_1)/(1 - chi) the masses would not stick, and its derivative
   tells of displacements that are small against that: a hundredth. */
double long_run_reach(const double params[N_COULOMB], const double start[N_STATE]);
/* Whether that leaves a growth four decades above rounding.  Positions have the size 1/(1 - chi), and their rounding
   with them: near chi = 1 it does not. */
bool long_run_has_room(const double params[N_COULOMB], const double start[N_STATE]);

/* Runs the three routes over the given number of returns, or for the given time (finite) where they do not come; with
   prec 0 MPFR is left out.  SS_DOMAIN outside the domain of coulomb.h; what became of each route stands in end.  The
   run is valid in every case and is to be cleared. */
int long_run_make(struct long_run *run, const double params[N_COULOMB], const double start[N_STATE], long returns,
                  double duration, slong prec);
void long_run_clear(struct long_run *run);

/* Two of the routes. */
struct long_pair {
  enum long_route a, b;
};
/* The returns that both have. */
long long_run_length(const struct long_run *run, struct long_pair p);
/* How far apart their positions are at most.  (Of times, the errors of every period add up, even on a stable orbit.) */
double long_run_most(const struct long_run *run, struct long_pair p);
/* The first return, from 1, at which a position or the time differs by more than `by`; 0 when none does. */
long long_run_parting(const struct long_run *run, struct long_pair p, double by);

/* The growth of that distance from one return to the next: the slope of its logarithm, by least squares over the first
   stretch of at least three returns on which it keeps between 1e-11 and 1e-6 of the scale, above rounding and below
   saturation, and on which it and the second route's distance from the start keep within reach.  false when there is no
   such stretch. */
struct long_growth {
  long first, last; /* returns, from 1 */
  double log;
};
bool long_run_growth(struct long_growth *growth, const struct long_run *run, struct long_pair p);

/* The growth of a displacement of the ODE route from the closed one, made at the start, of the size that the stretch
   wants for an orbit of the given multiplier. */
bool long_run_displaced(struct long_growth *growth, const double params[N_COULOMB], const double start[N_STATE],
                        double multiplier, double duration);

#endif
