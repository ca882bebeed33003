/* The two masses on the belt under Coulomb's law, simulated from the equations (1)-(2) alone, in the coordinates x.

     x_1'' = u_1 - f_1          f_1 = x_1 - chi x_2          restoring force of m1
     x_2'' = eta (u_2 - f_2)    f_2 = chi (x_2 - x_1)        restoring force of m2

   Each mass is in one of three modes, so the system in one of nine:

     MODE_STICK   x_i' = V    u_i = f_i, |f_i| at most u_ri
     MODE_BELOW   x_i' < V    u_i = +u_si
     MODE_ABOVE   x_i' > V    u_i = -u_si         (the mass overruns the belt)

   The law at an instant has no memory: it follows from f and x' alone.  Away from V the sign of x_i' - V decides.  At
   x_i' = V the mass sticks where |f_i| < u_ri and slips where |f_i| > u_ri, to the side that its acceleration points to
   (below for f_i > 0, above for f_i < 0).  Exactly at |f_i| = u_ri it slips if |f_i| is about to exceed the limit, that
   is if the first non-zero derivative of |f_i| while it sticks is positive, and else sticks.  Hence
   - a slipping mass whose speed touches V sticks, however it touches: there f_i = +-u_si, below the static limit;
   - a slipping mass whose speed reaches V transversally sticks, or with |f_i| > u_ri crosses to the other slip mode;
   - a sticking mass whose force touches the limit and turns back goes on sticking;
   - simultaneous changes need no iteration: m1 never waits for the mode of a sticking m2, and m2 looks at m1's result.
   A mass that breaks loose leaves V with the acceleration u_ri - u_si > 0, so events cannot accumulate.

   Two routes follow the same law: a numerical integration by GSL that knows of no closed form, and closed forms over
   the number types double and mpfr.  They share the law, the bookkeeping of events, and nothing else.

   Domain: 0 < chi < 1, eta > 0, V > 0, 0 <= u_si < u_ri, all finite. */
#ifndef STICKSLIP_MOTION_COULOMB_H
#define STICKSLIP_MOTION_COULOMB_H

#include "dynamics.h"

/* Parameters, in this order.  A state is x_1, x_2, x_1', x_2'. */
enum { COULOMB_CHI, COULOMB_ETA, COULOMB_V, COULOMB_US1, COULOMB_US2, COULOMB_UR1, COULOMB_UR2, N_COULOMB };
/* f_1 and f_2 at the positions x; at velocities, their rates. */
static inline void coulomb_forces(double f[2], const double params[N_COULOMB], const double x[2]) {
  f[0] = x[0] - params[COULOMB_CHI] * x[1];
  f[1] = params[COULOMB_CHI] * (x[1] - x[0]);
}
/* |x_1| + |x_2| + V */
double coulomb_scale(const double params[N_COULOMB], const double state[N_STATE]);

enum coulomb_mode { MODE_STICK, MODE_BELOW, MODE_ABOVE, N_MODES };
extern const char coulomb_mode_letter[N_MODES]; /* 's', '-', '+', as in the phases of any system (mech/mech.h) */

/* The letter of a pair of modes (rows m1, columns m2); D G H C are the paper's phases (G for Gamma), a small letter is
   the same phase with the slipping masses faster than the belt, X and x have one mass on each side.

              stick  below  above
       stick    D      C      c
       below    G      H      X
       above    g      x      h          */
char coulomb_letter(const enum coulomb_mode mode[2]);
/* What the letters of a word stand for, in words. */
const char *coulomb_letters_said(const char *word);

/* What the law says of a state in double precision, by exact comparisons of the rounded forces. */
void coulomb_law_d(enum coulomb_mode mode[2], const double params[N_COULOMB], const double state[N_STATE]);

/* One moment of a motion; at an event the modes and friction forces are those just after it. */
struct coulomb_row {
  double t, x[2], v[2], u[2];
  enum coulomb_mode mode[2];
  const struct num_vec *exact; /* t, x_1, x_2, x_1', x_2' in the route's own number type; NULL from the ODE route */
};
/* One mass changes its mode.  Changes at one instant are reported one after the other, with the same row. */
struct coulomb_event {
  struct coulomb_row at;
  int mass; /* 0 or 1 */
  enum coulomb_mode from, to;
  bool simultaneous; /* the other mass changes too */
  bool returns;      /* both masses stick from here on: of two changes at once the second */
  bool grazing;      /* the speed touched V, or crossed it so flatly that rounding decides */
};

/* Who is told.  Functions may be NULL; one that returns false ends the simulation.  Rows live during the call. */
struct coulomb_sink {
  void *self;
  bool (*event)(void *self, const struct coulomb_event *e);
  bool (*sample)(void *self, const struct coulomb_row *row);
};

/* How far to go.  Ends at the first of these that is reached. */
struct coulomb_plan {
  double duration;  /* may be INFINITY; a finite duration is reached exactly */
  long returns;     /* how often the masses have come to stick both, after the start; 0: any number */
  double sample;    /* distance of samples, which lie at 0, sample, 2 sample, ... up to the duration; 0: none */
  long max_events;  /* default 1000000 */
  long max_steps;   /* integration steps, or steps of the root searches; default 1000000 */
  double tolerance; /* ODE route: local error per step relative to the state, 1e-13 (the default) to 1e-3 */
};
/* No duration, no returns, no samples, default limits. */
extern const struct coulomb_plan coulomb_plan_default;

enum coulomb_end {
  COULOMB_DONE,    /* the duration or the number of returns is reached */
  COULOMB_STOPPED, /* a sink said so */
  COULOMB_QUIET,   /* duration infinite, and no event will ever come */
  COULOMB_EVENTS,  /* max_events */
  COULOMB_STEPS,   /* max_steps */
  COULOMB_STUCK,   /* more than 16 instants without progress of time, or 1000 at which no mode changes; a guard, no
                      known motion does it */
  COULOMB_BLURRED, /* |f_i| of a mass at V is within tol of u_ri, which is within tol of u_si */
  COULOMB_FAILED   /* the integrator, or a number that cannot be held */
};
extern const char *const coulomb_end_name[COULOMB_FAILED + 1]; /* "done", or why it ended early */

struct coulomb_result {
  enum coulomb_end end;
  struct coulomb_row at; /* where it ended; exact is NULL */
  long events, returns, steps;
  long touches; /* flat contacts of a speed with V or of a force with its limit that rounding could have turned */
};

/* Both routes answer SS_OK for DONE and STOPPED, SS_DOMAIN for parameters or a plan outside the domain (a plan without
   end included; then nothing is simulated), else SS_UNABLE; the result is valid in every case but SS_DOMAIN.

   What counts as equal.  A speed or force within tol of its limit is at it, so that events closer than rounding are one
   instant: tol is (2^(4-prec) by closed forms, 4 tolerance by the ODE route) times the size of the starting state,
   |x_1| + |x_2| + |x_1'| + |x_2'| + V + u_r1 + u_r2.  Where that covers the step from u_si to u_ri, as on a belt
   1e12 times as fast as forces are large, the law of a mass that comes to rest on the belt cannot be told: BLURRED.  An
   event within tol of the duration falls on either side of it.

   Measured on the paper's orbit over 200 periods, against mpfr: events within 7e-12 (ODE route) and 1e-11 (double),
   half of it the rounding of t itself; 10 ms and 5 ms, mpfr at 256 bits 40 ms, at 3400 bits 1 s.

   sink may be NULL. */

/* Runge-Kutta-Prince-Dormand 8(7) with adaptive steps; a step is at most half of the shortest time of the free system,
   1/(2 sqrt(1 + chi eta)), and while both masses stick, when all is straight, at most as long as they have stuck if
   that is longer.  Events are located by repeating the last step with other lengths; bounds on the second and
   third derivatives, from the state and the equations, show that none is stepped over. */
int coulomb_simulate_ode(struct coulomb_result *result, const double params[N_COULOMB], const double start[N_STATE],
                         const struct coulomb_plan *plan, const struct coulomb_sink *sink);

/* Closed forms in each mode, in the context of params and start (double or mpfr; aborts on another), with first events
   searched in double precision without stepping over any and refined by Newton's iteration.  In mpfr an event that is
   flat in double precision is decided at full precision, but whether there is one at all is decided in double outside
   of its rounding. */
int coulomb_simulate_exact(struct coulomb_result *result, const struct num_vec *params, const struct num_vec *start,
                           const struct coulomb_plan *plan, const struct coulomb_sink *sink);

/* The same closed forms in double, from arrays. */
int coulomb_simulate_d(struct coulomb_result *result, const double params[N_COULOMB], const double start[N_STATE],
                       const struct coulomb_plan *plan, const struct coulomb_sink *sink);

/* From the parameters chi, eta, V, e1, e2 of dynamics.h and static limits u_r1, u_r2 (elements 0 and 1 of limits):
   u_si = u_ri - e_i.  SS_DOMAIN outside the domain. */
int coulomb_params_set(struct num_vec *params, const struct num_vec *model, const struct num_vec *limits);
/* The state with x = z + d, d the equilibrium under both sliding forces, and both speeds V. */
int coulomb_start_set(struct num_vec *start, const struct num_vec *params, const void *z10, const void *z20);

/* The same in double, from arrays and to one. */
int coulomb_start_set_d(double start[N_STATE], const double params[N_COULOMB], double z10, double z20);

/* The 2x2 derivative of the positions at which both masses come to stick with respect to those of the start (both
   sticking), for motions of the word G H C D: central differences of the ODE route, extrapolated, at the step that
   promises the least error.  err: an estimate of the worst entry's error, truncation and noise.  SS_DOMAIN when nearby
   motions do not follow the word. */
int coulomb_return_jacobian(double j[4], double *err, const double params[N_COULOMB], const double start[N_STATE]);
/* What counts as equal to the ODE route, over the rate at which the force on m1 rises while both masses stick: how well
   the end of that phase can be told. */
double coulomb_event_floor(const double params[N_COULOMB], const double start[N_STATE]);
/* The relative error of that derivative at least: rounding over the longest displacement of one position that leaves
   the forces at the start below their limits.  Near chi = 1 positions grow as 1/(1 - chi), and that displacement
   shrinks. */
double coulomb_return_jacobian_floor(const double params[N_COULOMB], const double start[N_STATE]);
/* The same for one phase of that word: the derivatives of the state
   at the event that ends it along n_dir directions (N_STATE numbers each; velocities that the belt imposes must not be
   moved), and the accuracy of each.  SS_DOMAIN when nearby motions have another first event. */
int coulomb_local_differences(double *out, double *err, const double params[N_COULOMB], const struct dyn_stretch *of,
                              const double (*dir)[N_STATE], int n_dir);

/* --- Ready-made sinks. --- */

/* Keeps events, in memory bounded by the plan's max_events; exact is not kept.  All zero: empty. */
struct coulomb_log {
  struct coulomb_event *event;
  size_t n, cap;
};
void coulomb_log_clear(struct coulomb_log *log);
struct coulomb_sink coulomb_log_sink(struct coulomb_log *log);
/* The letters of the phases of positive length that begin with an event, in order. */
void coulomb_log_word(struct text *word, const struct coulomb_log *log);
/* A word cut after each D, equal pieces in a row counted: (GHCD)^4 (GHCHGHCD)^2. */
void coulomb_word_fold(struct text *out, const char *word);
/* How many events from the first on are the same change of the same mass, and the largest difference of their times,
   positions and velocities. */
double coulomb_log_compare(size_t *shared, const struct coulomb_log *a, const struct coulomb_log *b);

#endif
