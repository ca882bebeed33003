/* What the files of this module share.

   trig_sum  a motion seen through one switching function: constant, drift and two oscillations
   return_map_double  the one-dimensional return map in double precision, with the modes of phase H worked out once
   search  the zeros of the return map's defect, in double precision
   flow    the closed form of each phase, as four 2x2 blocks */
#ifndef STICKSLIP_DYN_IMPL_H
#define STICKSLIP_DYN_IMPL_H

#include <stdbool.h>

#include "num/calc.h"
#include "stickslip/given.h"
#include "stickslip/warm.h"

#define PI 3.14159265358979323846 /* POSIX alone does not promise M_PI */

/* --- trig_sum.c: f(t) = start + drift t + sum over i of cs[i] (cos(om[i] t) - 1) + sn[i] sin(om[i] t). --- */

struct trig_sum {
  double start, drift, om[2], cs[2], sn[2];
};
/* How a wave changes with a parameter: its derivative, and bounds of that and of the second derivative. */
struct trig_sum_shift {
  struct trig_sum rate;
  double most, bend;
};
struct trig_sum_root {
  double t, rate; /* the first positive root and f' there */
  double safe;    /* the parameter can move about this far before the first root can jump: no maximum that stays below
                     zero before the root comes up to it, and the one right after the root does not sink to it */
  bool grazing;
  long steps;
};
/* Work (work.h) that only odd parameters cause is counted where it arises, in whole blocks, so that the last digits of a
   walk change no count at ordinary ones: there a search or a proof is counted once, by whoever asks for it. */
enum { WORK_BLOCK = 4096, UNITS_OF_STEP = 10 }; /* of a root's search */
/* value[0..2] = f, f', f'' at t. */
void trig_sum_at(double value[3], const struct trig_sum *w, double t);
/* Its first positive root, as dyn_first_event_d words it.  shift may be NULL when safe is not wanted.  When there is
   no root, safe and steps are still set. */
int trig_sum_first_root(struct trig_sum_root *root, const struct trig_sum *w, const struct trig_sum_shift *shift,
                        const struct dyn_limits *lim);
/* x - sin x without cancellation. */
double x_minus_sin(double x);

/* --- return_map_double.c: phases Gamma, H and C of the word in double precision, started by t_b alone. --- */

struct return_map_double {
  double chi, eta, V, e1, e2;
  double a;          /* (1 - chi) V, the speed of w while both stick */
  double rho;        /* hypot(a, e1) */
  double fall;       /* t*: the first time at which m1 would reach the belt's speed in phase Gamma */
  double rise;       /* a record of chi r that falls into a later period begins this long after its start */
  double om[2], omc; /* frequencies of phases H and C */
  double x, y;       /* the slow mode is (x, y), the fast one (y, -x), in (sqrt(eta) z_1, z_2) */
  double root_eta;
};
/* One pass from t_b: the defect is r at the end minus the r at the stick phase that leads to this t_b. */
struct pass {
  int status; /* SS_OK, or that of the search for t_c */
  double tb, tc;
  double r, r_end;        /* at the stick phase; at the end */
  double defect, slope;   /* slope: d defect / d t_b */
  double wc, rc, qc, dqc; /* state at the end of phase H, and d q_c / d t_b */
  double pb;              /* z_1' - V at t_b: d r / d t_b */
  double safe;            /* t_c does not jump while t_b moves by less than about this */
  bool grazing;
  long steps;
};
/* SS_DOMAIN outside the domain of dynamics.h.  rise is left to return_map_double_records: few need it, and it takes an iteration. */
int return_map_double_init(struct return_map_double *k, const double params[N_PARAMS]);
void return_map_double_records(struct return_map_double *k);
/* How far chi r / chi has risen t after the start of phase Gamma. */
double return_map_double_rise(const struct return_map_double *k, double t);
/* The first time at which it has risen by g > 0. */
double return_map_double_time(const struct return_map_double *k, double g);
/* The largest |r| that phase C can end with. */
double return_map_double_reach(const struct return_map_double *k);
/* z_1' - V along phase H from velocities v1, v2, w and pull = chi eta r; start is its first value. */
struct trig_sum return_map_double_wave(const struct return_map_double *k, double v1, double v2, double w, double pull,
                                       double start);
void return_map_double_pass(struct pass *s, const struct return_map_double *k, double tb, const struct dyn_limits *lim);
/* The last phase and the next stick phase: t_d and t_a. */
void return_map_double_times(double *ta, double *td, const struct return_map_double *k, const struct pass *s);

/* --- search.c: zeros of the defect. --- */

struct zero {
  double tb, tc;
  double low, high; /* of t_b: the zero lies between them */
  bool up;          /* phase C ends at +radius */
  bool fold;        /* too close to an extremum of the defect to be told: none, one or two zeros near tb */
  bool grazing;
};
struct search {
  struct return_map_double k;
  struct dyn_limits lim;
  struct zero *zeros;
  size_t n, cap;
  long evaluations, steps;
  long allowed; /* steps after which the interval at hand is left */
  bool cut;     /* an interval was left before it was done with */
};
int search_run(struct search *s, const double params[N_PARAMS], const struct dyn_limits *lim);
void search_clear(struct search *s);

/* --- turn.c --- */

/* The sine and cosine of a kept angle. */
struct turn {
  val sine, cosine;
};
/* sin x and 1 - cos x; by Taylor's series when |x| <= 1/4. */
void turn_small(val *sine, val *versine, struct calc *c, val x);
/* The sine and cosine of the kept angle plus x. */
void turn_by(val *sine, val *cosine, struct calc *c, const struct turn *from, val x);

/* --- flow.c --- */

/* z(t) = c z + s z', z'(t) = n z + c z' (2x2, row-major). */
struct blocks {
  val c[4], s[4], n[4];
};
/* Phase H: matrix functions of K = [1, -chi; -chi eta, chi eta] are
   f(K) = [above f1 + below f2, chi (f1 - f2); chi eta (f1 - f2), below f1 + above f2] / gap,
   f1 and f2 at the squares of the frequencies om[0] < om[1]. */
struct spectrum {
  val om[2], above, below, couple, back; /* the last four divided by the gap; couple = chi, back = chi eta */
};
struct spectrum flow_spectrum(struct calc *c, const val p[N_PARAMS]);
void flow_function(val out[4], struct calc *c, const struct spectrum *s, val f1, val f2);
struct blocks flow_blocks(struct calc *c, enum phase ph, const val p[N_PARAMS], val t);
void flow_apply(val out[N_STATE], struct calc *c, const struct blocks *b, const val in[N_STATE]);
val flow_switching(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]);
val flow_switching_rate(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]);
/* Pointers to the elements of a vector from the given index on. */
void flow_vals(val *out, const struct num_vec *v, slong from, slong n);

/* --- rounded.c --- */

/* Results of one phase from the parameters, a state and a time (both may be NULL where the function reads none). */
typedef int (*phase_function)(struct num_vec *out, enum phase ph, const struct num_vec *params,
                              const struct num_vec *in, const void *t);
/* The function; in double precision by way of balls, so that each result is within 2^-53 of itself: SS_UNABLE where one is
   beyond the range of normal doubles or not known at 4096 bits.  out may alias in. */
int rounded_run(struct num_vec *out, phase_function run, enum phase ph, const struct num_vec *params,
                const struct num_vec *in, const void *t);

/* --- map_balls.c: the return map's equations in balls (the calc is one of num_arb). --- */

struct ball_params {
  val p[N_PARAMS];
  val a, zero, one, two, stiff, omega; /* a = (1 - chi) V, stiff = chi eta, omega its root */
  struct spectrum spectrum;
  bool kept; /* passes near (near_tb, near_tc), which are exact, turn the sines and cosines there */
  val near_tb, near_tc;
  struct turn turn_b, turn_c[2];
};
/* A motion of phase H: velocity of mass m = sum over i of a[m][i] cos(om[i] t) - b[m][i] sin(om[i] t). */
struct ball_modes {
  val a[2][2], b[2][2];
};
/* Everything about a pair (t_b, t_c); names as in struct pass. */
struct ball_pass {
  val tb, tc, pb, wb, rise, r;
  val wc, rc, pc, qc, r_end, defect;
  val pc_tb, qc_tb, pull_tb; /* derivatives by t_b; pull = chi eta r_c.  That of pc by t_c is -wc */
  val defect_tb, defect_tc;
  struct ball_modes modes;
};
void ball_params_init(struct ball_params *m, struct calc *c, const fmpq *params);
/* The same from elements, which must outlive m. */
void ball_params_make(struct ball_params *m, struct calc *c, const val p[N_PARAMS]);
/* Keeps the sines and cosines at (tb, tc) for passes with the same calc.  Without this each pass makes its own. */
void ball_params_keep(struct ball_params *m, struct calc *c, val tb, val tc);
void ball_pass_make(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc, bool up);
/* The part of it up to phase H at the time tc, whether or not phase C can follow: r_end and the defect are not set. */
void ball_pass_slip(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc);
/* Whether t_b > 0 is the first root of phase Gamma, and whether it comes before the first crest of the rise. */
truth ball_first_rise(struct calc *c, const struct ball_params *m, const struct ball_pass *s, truth *before_crest);
/* Whether z'_mass < V for 0 < t < end, from phase H's start with z'_mass - V = start (at most 0), and at end too unless
   it is a root.  At most max_steps. */
truth ball_slower(struct calc *c, const struct ball_params *m, const struct ball_modes *modes, int mass, val start,
                  val end, bool root_at_end, long max_steps);
/* A time near the first root of z'_mass - V, from the same start, found by the same steps; false where none is up to t_max. */
bool ball_first_root(double *t, struct calc *c, const struct ball_params *m, const struct ball_modes *modes, int mass,
                     val start, double t_max, long max_steps);

/* --- orbit.c: what is known about an orbit once its (t_b, t_c) are; m may hold balls. --- */

/* The end of the word: phase C turns by the angle in (0, pi) whose tangent is |q|/(omega r); meanwhile w drifts to wf,
   and the stick phase makes up the rest.  Also of a pass that does not close. */
struct ball_ending {
  val turn, td, wf, ta;
};
void ball_ending_make(struct ball_ending *e, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                      bool up);

void dyn_orbit_init(struct dyn_orbit *o);
/* The fewest relative bits of any of its numbers that is not zero; at least 0. */
slong dyn_orbit_accuracy(const struct dyn_orbit *o);
/* Every number; up: q > 0 in phase C. */
int dyn_orbit_describe(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, val tb, val tc, bool up);
/* The first working precision for prec bits of every number of an orbit.  How many bits the worst of them loses is the
   orbit's own (its condition) and hardly depends on the precision, so that a pilot tells, of which `left` bits are left; 0:
   none was run, since up to DYN_PLANNED_FROM bits a failed attempt costs less than one, or it told nothing. */
enum { DYN_GUARD = 40, DYN_PLANNED_FROM = 512, DYN_PILOT = 192 };
slong dyn_planned_bits(slong prec, slong left);
/* The conditions.  Returns whether t_b and t_c are proved to be first roots, and up the direction of phase C. */
truth dyn_orbit_judge(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, val tb, val tc, bool up,
                      long max_steps);

int dyn_orbits_by_z10(const void *x, const void *y);

/* --- orbit_equations.c: the four equations of given.h in the six quantities, over any number type. --- */

enum { WORD_FREE = 4 };
/* chi, eta, V and the two known quantities exactly, and the other four. */
struct word_data {
  const fmpq *model, *value;
  const enum dyn_quantity *which;
  int unknown[WORD_FREE];
};
/* Their left sides, zero on an orbit, and derivatives by the quantities. */
struct word {
  val e[WORD_FREE], j[WORD_FREE][N_QUANTITIES];
  val end; /* r at the stick phase */
};
/* Of the model; e1 and e2 are among the quantities and stand for nothing here. */
void word_params(struct ball_params *m, struct calc *c, const fmpq *model);
void word_make(struct word *w, struct calc *c, const struct ball_params *m, const val x[N_QUANTITIES]);
/* The equations as a system of num/solve.h in the unknown quantities; self is a struct word_system. */
struct word_system {
  struct calc *c;
  const struct ball_params *m;
  const int *unknown;
  slong mark;              /* what lies above it in the calc belongs to one evaluation */
  val known[N_QUANTITIES]; /* those of the unknown ones are not read */
};
int word_values(const void **f, const void **j, const struct num_vec *x, void *self);
/* Whether each part of a step is at most 2^-bits of all times together, or of both limits. */
bool word_step_is_small(const struct num_vec *x, const struct num_vec *step, const struct word_system *s, slong bits);
/* Newton's iteration in mpfr from x, the precision doubling up to that of x; the known ones are rounded once. */
int word_refine(struct num_vec *x, const struct word_data *q);

/* A solution: the enclosures x, and the boxes in which it is the only one. */
struct word_root {
  arb_t x[N_QUANTITIES], box[N_QUANTITIES];
};
void word_root_init(struct word_root *s);
void word_root_clear(struct word_root *s);
/* Proves one solution near x (of mpfr) by Krawczyk's operator. */
int word_enclose(struct word_root *s, const struct num_vec *x, const struct word_data *q);

/* --- event.c --- */

/* What events depend on in a state.  Positions near chi = 1 are so large that w would be lost in them. */
struct event_view {
  double w, r, dw, rise; /* dw: w'; rise: chi r - e2 */
  double v[2], over[2];  /* velocities; over V */
  double slip;           /* z_2' - z_1' */
};
/* As dyn_first_event_d. */
int event_first_d(double *t, bool *grazing, enum phase ph, const double params[N_PARAMS], const struct event_view *z,
                  const struct dyn_limits *lim);
/* Newton's iteration in the calc from start, until a step shows that half of the bits are settled. */
val event_newton(struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val start);

/* --- differences.c --- */

/* A map of n_in to n_out doubles, at most N_STATE, smooth but for its noise. */
struct double_map {
  int (*run)(double *out, const double *x, const void *self);
  const void *self;
  int n_in, n_out;
  double scale;  /* of the arguments; the longest step is a part of it */
  double floor;  /* the error of a value, relative to it and to the scale, is taken to be this at least */
  double jitter; /* and this, absolute */
};
/* The derivative along dir at x, extrapolated from central differences, and a bound of its worst component's error, from
   the change between steps and the measured noise.  The status of the map where it has no value nearby. */
int differences_along(double *out, double *err, const struct double_map *map, const double *x, const double *dir);

/* --- map.c --- */

/* dyn_arc_run from times that are near the events to an eighth at least, in mpfr or in balls: those of near (elements of
   the arc's type), of guess, or, when both are NULL, first ones of the return map in double precision.  SS_UNABLE also
   where a longer way may find the arc. */
int map_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]);

/* --- arc.c --- */

/* The arc whose events lie near the four given times, which are elements of the arc's own type. */
int arc_run_near(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near);

#endif
