/* Job 4: the periodic orbit beside the paper's example, from the numbers that the paper prints for it.

   The parameters are moved a little from input to input, the guess is the same for all: t_a, z_10 and z_20 are printed
   wrong by much (see the audit), which makes it a fair guess.  Wanted are the six unknowns and the trace of the return
   map's Jacobian; the solvers of six equations get the trace from the same hand-written formula. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "bench/yardstick.h"
#include "motion/dynamics.h"
#include "motion/paper_route.h"
#include "motion/warm.h"

enum { OUT_TA, OUT_TB, OUT_TC, OUT_TD, OUT_Z10, OUT_Z20, OUT_TRACE, N_ORBIT_OUT };
static const int groups[N_ORBIT_OUT] = {0, 0, 0, 0, 1, 1, 2};

/* The example's data and what is printed of its solution, as in verify/scenes/paper.scene. */
const double bench_example[N_PARAMS] = {0.8, 1, 1, 2.7844, 0.8587};
static const double printed[SIX] = {0.8921, -2.1958, 0.6784, 2, 1.5, 2.34}; /* z_10, z_20, t_a, t_b, t_c, t_d */
enum { PR_Z10, PR_Z20, PR_TA, PR_TB, PR_TC };

static void place(double *x, const double *u) {
  for (int i = 0; i < N_PARAMS; i++) x[i] = bench_example[i] * (1 + 0.02 * (u[i] - 0.5));
}

/* --- Truth, and the suite's search for every orbit. --- */

/* The orbit whose z10 is nearest to the printed one. */
static const struct dyn_orbit *nearest(const struct dyn_orbits *list) {
  const struct dyn_orbit *best = NULL;
  double least = INFINITY;
  for (slong i = 0; i < list->n; i++) {
    double d = fabs(num_arb.get_d(list->orbit[i].z10) - printed[PR_Z10]);
    if (d >= least) continue;
    least = d;
    best = &list->orbit[i];
  }
  return best;
}

static void take_orbit(struct num_vec *out, const struct dyn_orbit *o) {
  for (int i = 0; i < N_PHASES; i++) arb_set(num_vec_at(out, OUT_TA + i), o->t[i]);
  arb_set(num_vec_at(out, OUT_Z10), o->z10);
  arb_set(num_vec_at(out, OUT_Z20), o->z20);
  arb_set(num_vec_at(out, OUT_TRACE), o->trace);
}

static int find_orbit(struct num_vec *out, long *steps, const fmpq *params, slong prec) {
  OWNED(dyn_orbits) list;
  int status = dyn_orbits_find(&list, params, prec, NULL);
  const struct dyn_orbit *o = nearest(&list);
  *steps = list.evaluations;
  if (!o) status |= SS_DOMAIN;
  if (o) take_orbit(out, o);
  return status;
}

static fmpq *exact_params(const struct num_vec *in) {
  fmpq *params = _fmpq_vec_init(N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++) arf_get_fmpq(&params[i], arb_midref((arb_srcptr)num_vec_at(in, i)));
  return params;
}

static int find_at(struct num_vec *out, long *steps, const struct num_vec *in) {
  fmpq *params = exact_params(in);
  int status = find_orbit(out, steps, params, out->ctx.prec);
  _fmpq_vec_clear(params, N_PARAMS);
  return status;
}

static int truth_of(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                    const double *near) {
  long steps;
  (void)given, (void)hint, (void)near;
  return find_at(out, &steps, in);
}

static int run_find(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return find_at(out, steps, &c->in);
}

/* --- In one unknown: Newton's iteration on the return map. --- */

int bench_orbit_by_map(double *o, long *steps, const double *p, double r) {
  double end, slope, step = INFINITY;
  int status = SS_OK;
  *steps = 0;
  do {
    status = dyn_return_map_d(&end, &slope, &o[OUT_TA], p, r);
    step = (end - r) / (1 - slope);
    if (fabs(step) > 1e-15 * fabs(r)) r += step;
    ++*steps;
  } while (!status && fabs(step) > 1e-12 * fabs(r) && *steps < 50);
  if (!status && fabs(step) > 1e-15 * fabs(r)) status = dyn_return_map_d(&end, &slope, &o[OUT_TA], p, r);
  double w = p[P_E1] - (1 - p[P_CHI]) * p[P_V] * o[OUT_TA];
  o[OUT_Z10] = (w + p[P_CHI] * end) / (1 - p[P_CHI]);
  o[OUT_Z20] = (w + end) / (1 - p[P_CHI]);
  o[OUT_TRACE] = slope;
  return *steps < 50 ? status : SS_UNABLE;
}

static int run_return_map(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return bench_orbit_by_map((double *)(void *)out->data, steps, c->x, printed[PR_Z20] - printed[PR_Z10]);
}

/* --- In (t_b, t_c), r being what t_b makes it. --- */

typedef int (*warm_solver)(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]);

static int run_warm(warm_solver solve_near, double *o, long *steps, const double *params) {
  static const enum dyn_output wanted[N_ORBIT_OUT] = {DYN_OUT_TA,  DYN_OUT_TB,  DYN_OUT_TC,   DYN_OUT_TD,
                                                      DYN_OUT_Z10, DYN_OUT_Z20, DYN_OUT_TRACE};
  double out[N_DYN_OUT];
  const double guess[2] = {printed[PR_TB], printed[PR_TC]};
  int status = solve_near(out, params, guess);
  *steps = 1;
  for (int i = 0; i < N_ORBIT_OUT && !status; i++) o[i] = out[wanted[i]];
  return status;
}

static int run_bare(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return run_warm(dyn_orbit_bare, (double *)(void *)out->data, steps, c->x);
}

static int warm_admissible(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]) {
  unsigned violations, unsure;
  int status = dyn_orbit_warm(out, &violations, &unsure, params, guess);
  return status ? status : violations | unsure ? SS_UNABLE : SS_OK;
}

static int run_judged(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  return run_warm(warm_admissible, (double *)(void *)out->data, steps, c->x);
}

static void from_pass(double *o, const struct yardstick_pass *s, const struct yardstick *k) {
  double wf = s->wc + k->a * s->td - k->chi * (s->r_end - s->rc);
  o[OUT_TA] = (k->e1 - wf) / k->a;
  o[OUT_TB] = s->tb;
  o[OUT_TC] = s->tc;
  o[OUT_TD] = s->td;
  o[OUT_Z10] = (wf + k->chi * s->r_end) / (1 - k->chi);
  o[OUT_Z20] = (wf + s->r_end) / (1 - k->chi);
  o[OUT_TRACE] = yardstick_trace(s, k);
}

/* The steps of Newton's iteration from the printed numbers; 0 when it fails. */
static int pass_near_printed(struct yardstick_pass *s, struct yardstick *k, const double *params) {
  yardstick_init(k, params);
  return yardstick_orbit(s, k, printed[PR_TB], printed[PR_TC]);
}

static int run_hand(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct yardstick k;
  struct yardstick_pass s;
  (void)self;
  *steps = pass_near_printed(&s, &k, c->x);
  from_pass((double *)(void *)out->data, &s, &k);
  return *steps > 0 ? SS_OK : SS_UNABLE;
}

static int run_newton_mpfr(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct yardstick k;
  struct yardstick_pass s;
  long refined;
  (void)self;
  *steps = pass_near_printed(&s, &k, c->x);
  if (*steps == 0) return SS_UNABLE;
  int status = bench_newton_mpfr(out, &refined, c->x, s.tb, s.tc, s.r_end > 0);
  *steps += refined;
  return status;
}

/* The same orbit enclosed, its events proved the first ones. */
static int run_near(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct yardstick k;
  struct yardstick_pass s;
  truth first;
  (void)self;
  *steps = pass_near_printed(&s, &k, c->x);
  if (*steps == 0) return SS_UNABLE;
  fmpq *params = exact_params(&c->in);
  OWNED(dyn_orbit) o;
  int status = dyn_orbit_near(&o, &first, params, (struct dyn_place){s.tb, s.tc, s.r_end > 0}, out->ctx.prec, NULL);
  if (!status) take_orbit(out, &o);
  if (first != TRUTH_TRUE) status |= SS_UNABLE;
  _fmpq_vec_clear(params, N_PARAMS);
  return status;
}

/* --- Six unknowns by GSL's solvers. --- */

static int six_f(const gsl_vector *x, void *params, gsl_vector *f) {
  bench_six(f->data, NULL, params, x->data);
  return GSL_SUCCESS;
}

static int six_fdf(const gsl_vector *x, void *params, gsl_vector *f, gsl_matrix *j) {
  bench_six(f->data, j->data, params, x->data);
  return GSL_SUCCESS;
}

static int six_df(const gsl_vector *x, void *params, gsl_matrix *j) {
  double f[SIX];
  bench_six(f, j->data, params, x->data);
  return GSL_SUCCESS;
}

struct solver {
  gsl_multiroot_fdfsolver *with; /* derivatives; or */
  gsl_multiroot_fsolver *without;
  gsl_vector *start;
};

static void *open_solver(const struct bench_method *m, double setting, const struct bench_env *env) {
  const char *name = m->data;
  struct solver *s = ss_malloc(sizeof *s);
  (void)setting, (void)env;
  *s = (struct solver){.start = gsl_vector_alloc(SIX)};
  memcpy(s->start->data, printed, sizeof printed);
  if (strcmp(name, "hybrids") == 0)
    s->without = gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, SIX);
  else
    s->with = gsl_multiroot_fdfsolver_alloc(
        strcmp(name, "newton") == 0 ? gsl_multiroot_fdfsolver_newton : gsl_multiroot_fdfsolver_hybridsj, SIX);
  return s;
}

static void close_solver(void *self) {
  struct solver *s = self;
  if (s->with) gsl_multiroot_fdfsolver_free(s->with);
  if (s->without) gsl_multiroot_fsolver_free(s->without);
  gsl_vector_free(s->start);
  free(s);
}

/* Iterates until a step is below rounding.  A solver that sees no more progress there has done what it can. */
static long solve(struct solver *s, const double *x) {
  gsl_multiroot_function f = {six_f, SIX, (void *)(size_t)x};
  gsl_multiroot_function_fdf fdf = {six_f, six_df, six_fdf, SIX, (void *)(size_t)x};
  long n = 0;
  if (s->with ? gsl_multiroot_fdfsolver_set(s->with, &fdf, s->start)
              : gsl_multiroot_fsolver_set(s->without, &f, s->start))
    return 0;
  const gsl_vector *dx = s->with ? s->with->dx : s->without->dx, *at = s->with ? s->with->x : s->without->x;
  for (bool going = true; going && n < 200; n++)
    going = !(s->with ? gsl_multiroot_fdfsolver_iterate(s->with) : gsl_multiroot_fsolver_iterate(s->without)) &&
            gsl_multiroot_test_delta(dx, at, 1e-14, 1e-14) == GSL_CONTINUE;
  return n < 200 ? n : 0;
}

static int run_solver(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct solver *s = self;
  struct yardstick k;
  struct yardstick_pass pass;
  double *o = (double *)(void *)out->data;
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  *steps = solve(s, c->x);
  gsl_set_error_handler(old);
  const double *x = s->with ? s->with->x->data : s->without->x->data;
  for (int i = 0; i < N_PHASES; i++) o[OUT_TA + i] = x[PR_TA + i];
  o[OUT_Z10] = x[PR_Z10];
  o[OUT_Z20] = x[PR_Z20];
  yardstick_init(&k, c->x);
  yardstick_at(&pass, &k, o[OUT_TB], o[OUT_TC]);
  o[OUT_TRACE] = yardstick_trace(&pass, &k);
  return *steps > 0 ? SS_OK : SS_UNABLE;
}

/* --- The paper's own four equations (44)-(46) in the times. --- */

static int trace_of(void *trace, const struct num_vec *params, const struct num_vec *x) {
  OWNED(dyn_arc) arc;
  OWNED(num_vec) j;
  const struct num_type *type = x->ctx.type;
  double near[N_PHASES];
  for (int i = 0; i < N_PHASES; i++) near[i] = type->get_d(num_vec_at(x, i));
  dyn_arc_init(&arc, x->ctx);
  num_vec_init(&j, 4, x->ctx);
  int status = dyn_arc_run(&arc, params, num_vec_at(x, ROUTE_Z), num_vec_at(x, ROUTE_Z + 1), near);
  if (!status) status = dyn_return_jacobian(&j, params, &arc);
  if (!status) status = type->add(trace, num_vec_at(&j, 0), num_vec_at(&j, 3), x->ctx.prec);
  return status;
}

static int run_paper(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct num_vec params = bench_params_of(&c->in), x = {out->ctx, N_ROUTE, out->data};
  int n, status = SS_OK;
  (void)self;
  for (int i = 0; i < N_PHASES; i++)
    status |= out->ctx.type->set_d(num_vec_at(&x, i), printed[PR_TA + i], out->ctx.prec);
  status |= paper_route_newton(&x, &n, &params);
  *steps = n;
  return status ? status : trace_of(num_vec_at(out, OUT_TRACE), &params, &x);
}

/* --- The table. --- */

#define SOLVER(name)                                                                                                   \
  .type = &num_double, .bare = true, .data = name, .open = open_solver, .close = close_solver, .run = run_solver

static const struct bench_method methods[] = {
    {"hand-written", "C by hand: Newton's iteration on (r, t_b, t_c), r eliminated", .type = &num_double, .bare = true,
     .run = run_hand},
    {"from-guess", "the suite's orbit from a guess of t_b and t_c in double", .type = &num_double, .bare = true,
     .run = run_bare},
    {"from-guess-judged", "the same with its first roots proved and every condition checked", .type = &num_double,
     .run = run_judged},
    {"return-map", "Newton's iteration on the suite's return map of r in double", .type = &num_double,
     .run = run_return_map},
    {"gsl-newton", "GSL's newton on six unknowns, derivatives given", SOLVER("newton")},
    {"gsl-hybridsj", "GSL's hybridsj on six unknowns, derivatives given", SOLVER("hybridsj")},
    {"gsl-hybrids", "GSL's hybrids on six unknowns", SOLVER("hybrids")},
    {"paper-double", "the paper's equations (44)-(46) by Newton's iteration in double", .type = &num_double,
     .bare = true, .run = run_paper},
    {"paper-mpfr", "the same in MPFR", .type = &num_mpfr, .bare = true, BITS(7, 3), .run = run_paper},
    {"newton-mpfr", "Newton's iteration on (r, t_b, t_c) in MPFR at doubling precision", .type = &num_mpfr,
     .bare = true, BITS(7, 3), .run = run_newton_mpfr},
    {"near-arb", "the same orbit in balls, its events proved first and every condition judged", .type = &num_arb,
     BITS(7, 3), .run = run_near},
    {"find-arb", "the suite's search for every orbit, each proved, in balls", .type = &num_arb, BITS(7, 3),
     .run = run_find},
};

const struct bench_job bench_orbit = {
    .id = "orbit",
    .title = "The periodic orbit from the printed guess",
    .inputs = "chi, eta, V, e1, e2 near those of the example",
    .outputs =
        "t_a, t_b, t_c, t_d, z_10, z_20 and the trace; errors in units of the longest time, the larger position, "
        "the trace",
    .n_in = N_PARAMS,
    .n_out = N_ORBIT_OUT,
    .n_cases = 24,
    .n_quick = 6,
    .worst_condition = 1e4,
    .group = groups,
    .place = place,
    .truth = truth_of,
    .methods = methods,
    .n_methods = COUNT(methods),
};
