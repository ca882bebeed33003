/* Job 3: the Jacobian of the return map of the positions (z_10, z_20).

   The analytic methods start from the arc, whose times and states they are given correctly rounded; differences go
   through the map and have to find the events again.  Where both are one method, its title says so. */
#include <gsl/gsl_deriv.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "bench/yardstick.h"
#include "motion/dynamics.h"

enum { IN_Z10 = N_PARAMS, IN_Z20, N_JACOBIAN_IN };
enum { GIVEN_T, GIVEN_Z = N_PHASES, N_GIVEN = GIVEN_Z + (N_PHASES + 1) * N_STATE };
static const int one_group[4] = {0};
static const double longest_phase = 60;

static void place(double *x, const double *u) {
  bench_place_params(x, u);
  double V = x[P_V], chi = x[P_CHI], r = x[P_E2] / chi - V * (0.2 + 4 * u[5]);
  double w = x[P_E1] - V * (1 - chi) * (0.1 + 3 * u[6]);
  x[IN_Z20] = (w + r) / (1 - chi);
  x[IN_Z10] = x[IN_Z20] - r;
}

static int truth_of(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                    const double *near) {
  OWNED(dyn_arc) arc;
  struct num_vec params = bench_params_of(in);
  dyn_arc_init(&arc, out->ctx);
  int status = dyn_arc_run(&arc, &params, num_vec_at(in, IN_Z10), num_vec_at(in, IN_Z20), near);
  if (!status) status = dyn_return_jacobian(out, &params, &arc);
  for (int i = 0; i < N_PHASES && !status; i++) {
    double t = num_arb.get_d(num_vec_at(&arc.t, i));
    hint[i] = bench_hint(t);
    if (!(t < longest_phase)) status = SS_UNABLE;
    arb_set(num_vec_at(given, GIVEN_T + i), num_vec_at(&arc.t, i));
  }
  for (int i = 0; i < N_GIVEN - GIVEN_Z; i++) arb_set(num_vec_at(given, GIVEN_Z + i), num_vec_at(&arc.z, i));
  return status;
}

/* --- From the arc that is given. --- */

static struct dyn_arc arc_of(const struct bench_case *c) {
  const struct num_vec *g = &c->given;
  return (struct dyn_arc){{g->ctx, N_PHASES, num_vec_at(g, GIVEN_T)},
                          {g->ctx, N_GIVEN - GIVEN_Z, num_vec_at(g, GIVEN_Z)}};
}

static int run_implicit(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct dyn_arc arc = arc_of(c);
  struct num_vec params = bench_params_of(&c->in);
  (void)self;
  *steps = 1;
  return dyn_return_jacobian(out, &params, &arc);
}

static int run_saltation(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct dyn_arc arc = arc_of(c);
  struct num_vec params = bench_params_of(&c->in);
  (void)self;
  *steps = 1;
  return dyn_return_jacobian_saltation(out, &params, &arc);
}

static int run_hand(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct yardstick k;
  struct yardstick_pass p;
  const double *t = (const double *)(const void *)c->given.data;
  (void)self;
  *steps = 1;
  yardstick_init(&k, c->x);
  yardstick_at(&p, &k, t[PHASE_GAMMA], t[PHASE_H]);
  yardstick_jacobian((double *)(void *)out->data, &p, &k);
  return SS_OK;
}

/* The paper's names, and where their values stand: in the inputs, or in what is given. */
enum origin { FROM_INPUT, FROM_GIVEN };
static const struct {
  enum origin from;
  int at;
} places[] = {{FROM_INPUT, P_CHI},
              {FROM_INPUT, P_ETA},
              {FROM_INPUT, P_V},
              {FROM_GIVEN, GIVEN_T + PHASE_GAMMA},
              {FROM_GIVEN, GIVEN_T + PHASE_H},
              {FROM_GIVEN, GIVEN_T + PHASE_C},
              {FROM_GIVEN, GIVEN_Z + 2 * N_STATE + Z_1},
              {FROM_GIVEN, GIVEN_Z + 2 * N_STATE + Z_2},
              {FROM_GIVEN, GIVEN_Z + 2 * N_STATE + DZ_1},
              {FROM_GIVEN, GIVEN_Z + 3 * N_STATE + Z_1},
              {FROM_GIVEN, GIVEN_Z + 3 * N_STATE + Z_2},
              {FROM_GIVEN, GIVEN_Z + 3 * N_STATE + DZ_2},
              {FROM_GIVEN, GIVEN_Z + 4 * N_STATE + Z_1},
              {FROM_GIVEN, GIVEN_Z + 4 * N_STATE + Z_2}};
enum { N_PLACES = COUNT(places), SLOW = N_PLACES, FAST, N_NAMES };
static const char *const names[N_NAMES] = {"chi",   "eta",  "V",    "t_b",   "t_c",   "t_d",   "z_1b",    "z_2b",
                                           "z'_1b", "z_1c", "z_2c", "z'_2c", "z_100", "z_200", "omega_1", "omega_2"};
static const struct bench_formula chain = {"J", "stability", names, N_NAMES, 4, false, false};

static int run_chain(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  const double *given = (const double *)(const void *)c->given.data;
  double v[N_NAMES];
  for (int i = 0; i < N_PLACES; i++) v[i] = places[i].from == FROM_INPUT ? c->x[places[i].at] : given[places[i].at];
  bench_frequencies(&v[SLOW], &v[FAST], c->x[P_CHI], c->x[P_ETA]);
  *steps = 1;
  return bench_formula_run(self, out, v);
}

/* --- Arc and derivative together. --- */

static int run_arc_implicit(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct dyn_arc *arc = &((struct bench_arc *)self)->arc;
  struct num_vec params = bench_params_of(&c->in);
  *steps = 1;
  int status = dyn_arc_run(arc, &params, num_vec_at(&c->in, IN_Z10), num_vec_at(&c->in, IN_Z20), NULL);
  return status ? status : dyn_return_jacobian(out, &params, arc);
}

/* --- Differences in double. --- */

/* The positions at the end, from those at the start by the suite's return map in double. */
static int positions(double out[2], const double *params, const double z[2], long *steps) {
  double r, t[N_PHASES], chi = params[P_CHI];
  ++*steps;
  int status = dyn_return_map_d(&r, NULL, t, params, z[1] - z[0]);
  double w = params[P_E1] - (1 - chi) * params[P_V] * t[PHASE_D];
  out[0] = (w + chi * r) / (1 - chi);
  out[1] = (w + r) / (1 - chi);
  return status;
}

/* f' = sum of weight (f(x + offset h) - f(x - offset h)) / h, or for one-sided ones of weight f(x + offset h) / h. */
struct stencil {
  bool central;
  int n;
  double offset[3], weight[3];
};
static const struct stencil forward = {false, 2, {1, 0}, {1, -1}};
static const struct stencil central = {true, 1, {1}, {0.5}};
static const struct stencil fourth = {true, 2, {1, 2}, {8.0 / 12, -1.0 / 12}};
static const struct stencil richardson = {true, 3, {1, 0.5, 0.25}, {1.0 / 90, -20.0 / 45, 128.0 / 45}};

static double scale_of(const double *x) {
  return fabs(x[IN_Z10]) + fabs(x[IN_Z20]) + x[P_V];
}

struct steps_method {
  const struct stencil *stencil;
  double h; /* in units of the scale */
};

static void *open_stencil(const struct bench_method *m, double setting, const struct bench_env *env) {
  struct steps_method *s = ss_malloc(sizeof *s);
  (void)env;
  *s = (struct steps_method){m->data, setting};
  return s;
}

static int run_stencil(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  const struct steps_method *m = self;
  const struct stencil *s = m->stencil;
  double *j = (double *)(void *)out->data, h = m->h * scale_of(c->x);
  int status = SS_OK;
  *steps = 0;
  for (int col = 0; col < 2; col++) {
    double sum[2] = {0};
    for (int k = 0; k < s->n; k++)
      for (int side = 1; side >= (s->central ? -1 : 1); side -= 2) {
        double z[2] = {c->x[IN_Z10], c->x[IN_Z20]}, end[2];
        z[col] += side * s->offset[k] * h;
        status |= positions(end, c->x, z, steps);
        for (int row = 0; row < 2; row++) sum[row] += side * s->weight[k] * end[row];
      }
    for (int row = 0; row < 2; row++) j[2 * row + col] = sum[row] / h;
  }
  return status;
}

static int run_automatic(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  double err;
  (void)self;
  *steps = 1;
  return dyn_return_jacobian_d((double *)(void *)out->data, &err, c->x, &c->x[IN_Z10],
                               (const double *)(const void *)c->given.data);
}

/* --- GSL's numerical differentiation. --- */

typedef int (*gsl_rule)(const gsl_function *f, double x, double h, double *result, double *error);
struct gsl_method {
  gsl_rule rule;
  double h;
};
static const gsl_rule gsl_rules[] = {gsl_deriv_central, gsl_deriv_forward};

static void *open_gsl(const struct bench_method *m, double setting, const struct bench_env *env) {
  struct gsl_method *g = ss_malloc(sizeof *g);
  (void)env;
  *g = (struct gsl_method){*(const gsl_rule *)m->data, setting};
  return g;
}

struct one_entry {
  const double *x;
  int row, col, status;
  long steps;
};

static double entry_at(double value, void *self) {
  struct one_entry *e = self;
  double z[2] = {e->x[IN_Z10], e->x[IN_Z20]}, end[2];
  z[e->col] = value;
  e->status |= positions(end, e->x, z, &e->steps);
  return end[e->row];
}

static int run_gsl(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  const struct gsl_method *g = self;
  struct one_entry e = {.x = c->x};
  gsl_function f = {entry_at, &e};
  double error, *j = (double *)(void *)out->data;
  for (int i = 0; i < 4; i++) {
    e.row = i / 2;
    e.col = i % 2;
    if (g->rule(&f, c->x[IN_Z10 + e.col], g->h * scale_of(c->x), &j[i], &error)) e.status |= SS_UNABLE;
  }
  *steps = e.steps;
  return e.status;
}

/* --- Differences in MPFR. --- */

static int run_fd_mpfr(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct num_vec params = bench_params_of(&c->in);
  (void)self;
  *steps = 1;
  return dyn_return_jacobian_fd(out, NULL, &params, num_vec_at(&c->in, IN_Z10), num_vec_at(&c->in, IN_Z20), c->hint);
}

enum { STEP_BITS = 256 };
/* One column of central differences. */
static int mpfr_column(struct bench_arc *s, struct num_vec *out, int col, const struct bench_case *c, double h) {
  struct num_vec params = bench_params_of(&c->in);
  int status = SS_OK;
  for (int side = 1; side >= -1 && !status; side -= 2) {
    for (int i = 0; i < 2; i++) mpfr_set(num_vec_at(&s->start, i), num_vec_at(&c->in, IN_Z10 + i), MPFR_RNDN);
    mpfr_ptr moved = num_vec_at(&s->start, col);
    mpfr_add_d(moved, moved, side * h, MPFR_RNDN);
    status = dyn_arc_run(&s->arc, &params, num_vec_at(&s->start, 0), num_vec_at(&s->start, 1), c->hint);
    for (int row = 0; row < 2 && !status; row++) {
      mpfr_ptr end = num_vec_at(&s->arc.z, N_PHASES * N_STATE + row), j = num_vec_at(out, 2 * row + col);
      if (side > 0) {
        mpfr_set(num_vec_at(&s->end, row), end, MPFR_RNDN);
      } else {
        mpfr_sub(j, num_vec_at(&s->end, row), end, MPFR_RNDN);
        mpfr_div_d(j, j, 2 * h, MPFR_RNDN);
      }
    }
  }
  return status;
}

static int run_mpfr_steps(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct bench_arc *s = self;
  double h = ldexp(1, ilogb(s->setting * scale_of(c->x)));
  *steps = 4;
  return mpfr_column(s, out, 0, c, h) | mpfr_column(s, out, 1, c, h);
}

/* --- The table. --- */

static const double steps_double[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
static const double few_steps[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
static const double steps_mpfr[] = {1e-5, 1e-10, 1e-15, 1e-20, 1e-25, 1e-30, 1e-40, 1e-50, 1e-60, 1e-70};
static const double few_steps_mpfr[] = {1e-10, 1e-25, 1e-40};
#define STEPS                                                                                                          \
  .type = &num_double, .kind = SET_STEP, .settings = steps_double, .n = COUNT(steps_double), .quick = few_steps,       \
  .n_quick = COUNT(few_steps), .close = free
#define STENCIL(s) STEPS, .data = &(s), .open = open_stencil, .run = run_stencil

static const struct bench_method methods[] = {
    {"hand-written", "C by hand from t_b and t_c; arc given", .type = &num_double, .bare = true, .run = run_hand},
    {"paper-chain", "the paper's chain J_f J_c J_b J_a as corrected; arc given", .bare = true,
     FORMULA(chain, run_chain)},
    {"implicit", "implicit differentiation at the events, in double; arc given", .type = &num_double, .bare = true,
     .run = run_implicit},
    {"saltation", "saltation matrices with GSL's exponentials; arc given", .type = &num_double, .bare = true,
     .run = run_saltation},
    {"arc-implicit", "the arc and implicit differentiation, in double", .type = &num_double, ARC(run_arc_implicit)},
    {"forward", "forward differences of the return map in double", STENCIL(forward)},
    {"central", "central differences", STENCIL(central)},
    {"fourth", "central differences of the fourth order", STENCIL(fourth)},
    {"richardson", "central differences extrapolated twice from h, h/2, h/4", STENCIL(richardson)},
    {"automatic", "the suite's differences in double, which choose their step", .type = &num_double,
     .run = run_automatic},
    {"gsl-central", "gsl_deriv_central, entry by entry", STEPS, .data = &gsl_rules[0], .open = open_gsl,
     .run = run_gsl},
    {"gsl-forward", "gsl_deriv_forward, entry by entry", STEPS, .data = &gsl_rules[1], .open = open_gsl,
     .run = run_gsl},
    {"implicit-mpfr", "the arc and implicit differentiation in MPFR", .type = &num_mpfr, BITS(6, 3),
     ARC(run_arc_implicit)},
    {"implicit-arb", "the arc and implicit differentiation in balls", .type = &num_arb, BITS(6, 3),
     ARC(run_arc_implicit)},
    {"fd-mpfr", "central differences in MPFR at the step 2^(-bits/3)", .type = &num_mpfr, BITS(6, 3),
     .run = run_fd_mpfr},
    {"fd-mpfr-256", "central differences in MPFR at 256 bits", .type = &num_mpfr, .bits = STEP_BITS, .kind = SET_STEP,
     .settings = steps_mpfr, .n = COUNT(steps_mpfr), .quick = few_steps_mpfr, .n_quick = COUNT(few_steps_mpfr),
     ARC(run_mpfr_steps)},
};

const struct bench_job bench_jacobian = {
    .id = "jacobian",
    .title = "The Jacobian of the return map",
    .inputs = "chi, eta, V, e1, e2, z_10, z_20; steps are in units of |z_10| + |z_20| + V",
    .outputs = "the 2x2 derivative of the positions after one pass; errors in units of the largest entry",
    .n_in = N_JACOBIAN_IN,
    .n_out = 4,
    .n_given = N_GIVEN,
    .n_cases = 48,
    .n_quick = 12,
    .worst_condition = 1e3,
    .group = one_group,
    .place = place,
    .truth = truth_of,
    .methods = methods,
    .n_methods = COUNT(methods),
};
