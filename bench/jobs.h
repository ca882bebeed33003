/* What the files of jobs and peers share. */
#ifndef STICKSLIP_BENCH_JOBS_H
#define STICKSLIP_BENCH_JOBS_H

#include <gsl/gsl_odeiv2.h>

#include "base/arena.h"
#include "bench/bench.h"
#include "motion/dynamics.h"

extern const struct bench_job bench_propagator, bench_map, bench_jacobian, bench_orbit;

extern const struct study study_stiff, study_smooth, study_procedure, study_scenes, study_systems;

/* --- formula.c: a formula of the paper as corrected, as a tape in double precision. --- */

struct bench_formula {
  const char *text, *section;
  const char *const *symbol; /* values of the formula's free names are given in this order */
  int n_symbols, n_out;
  bool roots;  /* let the tape find quantities defined as roots; else they are symbols */
  bool stable; /* in its stable form; else as corrected */
};
/* open and close of a method whose data is the formula. */
void *bench_formula_open(const struct bench_method *m, double setting, const struct bench_env *env);
void bench_formula_close(void *self);
/* The two positive roots of (48), from the quadratic. */
void bench_frequencies(double *slow, double *fast, double chi, double eta);
int bench_formula_run(void *self, struct num_vec *out, const double *value);
/* A method in double precision on a formula. */
#define FORMULA(formula, call)                                                                                         \
  .type = &num_double, .data = &(formula), .open = bench_formula_open, .close = bench_formula_close, .run = (call)

/* --- methods.c: what the methods of the jobs share. --- */

/* A method at the first n of the usual precisions, of which quick runs take the first few. */
extern const double bench_precisions[7];
#define BITS(most, few)                                                                                                \
  .kind = SET_BITS, .settings = bench_precisions, .n = (most), .quick = bench_precisions, .n_quick = (few)
/* A method with an arc of its own for all calls. */
#define ARC(call) .open = bench_arc_open, .close = bench_arc_close, .run = (call)
/* A time a 64th off: of itself, or of the unit of time when it is long. */
double bench_hint(double t);
/* chi, eta, V, e1, e2 from five numbers in (0, 1): a domain in which arcs and orbits are common. */
void bench_place_params(double *x, const double *u);
/* The first five elements. */
struct num_vec bench_params_of(const struct num_vec *in);
/* The parameters as they are in double, exact: N_PARAMS of _fmpq_vec_init. */
fmpq *bench_exact(const double *params);
/* An arc and positions in a method's arithmetic, with its setting: open and close of methods that need no more. */
struct bench_arc {
  struct dyn_arc arc;
  struct num_vec start, end; /* two positions each */
  double setting;
};
void *bench_arc_open(const struct bench_method *m, double setting, const struct bench_env *env);
void bench_arc_close(void *self);

/* --- six.c: the periodic orbit as six equations in z_10, z_20, t_a, t_b, t_c, t_d. --- */

enum { SIX = 6 };
/* The residuals at x, and unless NULL their derivatives by rows. */
void bench_six(double f[SIX], double j[SIX * SIX], const double *params, const double x[SIX]);

/* The example's parameters in double, job_orbit.c. */
extern const double bench_example[];
/* The orbit by Newton's iteration on the return map of r, in double: t_a, t_b, t_c, t_d, z_10, z_20, trace. */
int bench_orbit_by_map(double *out, long *steps, const double *params, double r);

/* --- sides.c: both sides of a claim's sentence at one of its points, to a number of digits. --- */

struct bench_sides;
/* NULL: the claim has no sentence, or no point at which both sides have values. */
struct bench_sides *bench_sides_new(const struct bench_env *env, const struct claim *c);
void bench_sides_free(struct bench_sides *b);
/* false when they could not be enclosed so closely. */
bool bench_sides_run(struct bench_sides *b, long digits);
/* The largest radius, relative to what is above 1, is at most 10^-digits. */
bool bench_close_enough(const struct num_vec *balls, long digits);

/* --- newton_mpfr.c --- */

/* The orbit near (t_b, t_c) by Newton's iteration at a precision that doubles, in MPFR: t_a, t_b, t_c, t_d, z_10, z_20,
   trace.  up: z_2' > V in phase C.  The number of steps goes to *steps. */
int bench_newton_mpfr(struct num_vec *out, long *steps, const double *params, double tb, double tc, bool up);

/* --- motion.c: the system as an integrator sees it, in w, r, z_1', z_2'. --- */

enum { Y_W, Y_R, Y_V1, Y_V2, N_Y };
/* How an integrator is used.  Careful, which zero bytes mean: no step is longer than a quarter of the shortest period,
   so that no event hides within one, and a phase ends by the time 1000.  Unbound: as long as its error estimate
   allows. */
struct bench_limits {
  bool unbound;
  long steps; /* of a phase; 0: 200000 */
};
struct bench_motion {
  double chi, V, e2, stiff; /* stiff = chi eta */
  double longest;           /* a quarter of the shortest period */
  enum phase phase;
  struct bench_limits limits;
};
double bench_motion_stride(const struct bench_motion *m);  /* the longest step */
double bench_motion_horizon(const struct bench_motion *m); /* a phase without event by then has failed */
long bench_motion_steps(const struct bench_motion *m);
void bench_motion_field(double f[N_Y], const struct bench_motion *m, const double y[N_Y]);
void bench_motion_jacobian(double j[N_Y * N_Y], const struct bench_motion *m);
/* The switching function of the phase, and its derivative. */
double bench_motion_switch(double *rate, const struct bench_motion *m, const double y[N_Y]);
/* A map of the word: x are the parameters and r, out is t_b, t_c, t_d and r at the end. */
enum { MAP_R = 3, N_MAP };
/* Goes through the phases; run, whose self begins with the motion, takes y to the event of the phase and returns a
   status. */
typedef int (*bench_phase_run)(double *t, void *self, double y[N_Y], long *steps);
int bench_motion_pass(struct num_vec *out, long *steps, void *self, const double *x, bench_phase_run run);

/* --- lanes.c: a sweep by the scalar solver and in lanes. --- */

enum { MOST_SETS = 4 };
struct bench_lanes {
  int n;
  const char *set[MOST_SETS]; /* instruction sets that the machine has, the widest first; on one core, */
  double gain[MOST_SETS];     /* the scalar solver's time over the lanes' */
  double bare;                /* dyn_orbit_bare, which has no digits to spare and judges nothing, over the widest */
};
void bench_lanes(struct bench_lanes *b, bool quick);

/* --- cvode.c: SUNDIALS' CVODE with its own rootfinding; the method's data is "adams" or "bdf". --- */

#ifdef STICKSLIP_SUNDIALS
enum { HAS_CVODE = 1 };
const char *bench_cvode_version(void);
void *bench_cvode_open(const struct bench_method *m, double tolerance, const struct bench_env *env);
void bench_cvode_close(void *self);
int bench_cvode_run(void *self, struct num_vec *out, long *steps, const struct bench_case *c);
#else /* its methods are absent */
enum { HAS_CVODE = 0 };
#define bench_cvode_version() "not installed"
#define bench_cvode_open      NULL
#define bench_cvode_close     NULL
#define bench_cvode_run       NULL
#endif

/* --- ode.c: GSL's integrators; the method's data is the name. --- */

/* Of that name; NULL without one. */
const gsl_odeiv2_step_type *bench_gsl_step(const char *name);
void *bench_ode_open(const struct bench_method *m, double tolerance, const struct bench_env *env);
void bench_ode_close(void *self);
int bench_ode_run(void *self, struct num_vec *out, long *steps, const struct bench_case *c);

#endif
