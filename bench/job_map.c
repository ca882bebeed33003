/* Job 2: one event-located Poincare map, from the end of the stick phase to the end of the stick-slip phase.

   There the state is r alone (w = e1, both velocities V), so r is given exactly and every method starts from exact
   data, the integrators too: they work in w, r and the velocities.  The suite's methods search the first event of each
   phase; the hand-written map is told t_b and t_c roughly and trusts them. */

#include "bench/jobs.h"
#include "bench/yardstick.h"
#include "motion/dynamics.h"

enum { IN_R = N_PARAMS, N_MAP_IN };
enum { OUT_TB, OUT_TC, OUT_TD, OUT_R = MAP_R, N_MAP_OUT };
static const int groups[N_MAP_OUT] = {0, 1, 2, 3};
static const double longest_phase = 60;

static void place(double *x, const double *u) {
  bench_place_params(x, u);
  x[IN_R] = x[P_E2] / x[P_CHI] - x[P_V] * (0.2 + 4 * u[5]);
}

/* The start as positions: z_1 = (w + chi r)/(1 - chi), z_2 = z_1 + r. */
static int start_positions(struct num_vec *z, const struct num_vec *in) {
  const struct num_type *type = z->ctx.type;
  slong prec = z->ctx.prec;
  void *z1 = num_vec_at(z, 0), *z2 = num_vec_at(z, 1);
  const void *chi = num_vec_at(in, P_CHI), *r = num_vec_at(in, IN_R);
  int status = type->set_d(z2, 1, prec) | type->sub(z2, z2, chi, prec) | type->mul(z1, chi, r, prec);
  status |= type->add(z1, z1, num_vec_at(in, P_E1), prec) | type->div(z1, z1, z2, prec);
  return status | type->add(z2, z1, r, prec);
}

/* The arc from r, its events near the guess or, without one, first ones. */
static int run_arc(struct num_vec *out, struct dyn_arc *arc, struct num_vec *z, const struct num_vec *in,
                   const double *guess) {
  const struct num_type *type = out->ctx.type;
  struct num_vec params = bench_params_of(in);
  int status = start_positions(z, in);
  if (!status) status = dyn_arc_run(arc, &params, num_vec_at(z, 0), num_vec_at(z, 1), guess);
  if (status) return status;
  for (int i = OUT_TB; i <= OUT_TD; i++) type->set(num_vec_at(out, i), num_vec_at(&arc->t, PHASE_GAMMA + i));
  const struct num_vec *s = &arc->z;
  enum { END = N_PHASES * N_STATE };
  return type->sub(num_vec_at(out, OUT_R), num_vec_at(s, END + Z_2), num_vec_at(s, END + Z_1), out->ctx.prec);
}

static int truth_of(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                    const double *near) {
  OWNED(dyn_arc) arc;
  OWNED(num_vec) z;
  (void)given;
  dyn_arc_init(&arc, out->ctx);
  num_vec_init(&z, 2, out->ctx);
  double guess[N_PHASES] = {0};
  for (int i = 0; i < 3 && near; i++) guess[1 + i] = near[i];
  int status = run_arc(out, &arc, &z, in, near ? guess : NULL);
  for (int i = 0; i < 3 && !status; i++) {
    hint[i] = bench_hint(num_arb.get_d(num_vec_at(out, i)));
    if (!(hint[i] < longest_phase)) status = SS_UNABLE;
  }
  return status;
}

/* --- The suite. --- */

static int run_return_map(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  double t[N_PHASES], *o = (double *)(void *)out->data;
  (void)self;
  int status = dyn_return_map_d(&o[OUT_R], NULL, t, c->x, c->x[IN_R]);
  for (int i = OUT_TB; i <= OUT_TD; i++) o[i] = t[1 + i];
  *steps = 1;
  return status;
}

static int run_word(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct bench_arc *a = self;
  *steps = 1;
  return run_arc(out, &a->arc, &a->start, &c->in, NULL);
}

/* --- By hand. --- */

static int run_yardstick(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct yardstick k;
  struct yardstick_pass p;
  double *o = (double *)(void *)out->data;
  (void)self;
  yardstick_init(&k, c->x);
  *steps = yardstick_map(&p, &k, c->x[IN_R], c->hint);
  o[OUT_TB] = p.tb;
  o[OUT_TC] = p.tc;
  o[OUT_TD] = p.td;
  o[OUT_R] = p.r_end;
  return *steps > 0 ? SS_OK : SS_UNABLE;
}

/* --- The table. --- */

static const double tolerances[] = {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
static const double few_tolerances[] = {1e-6, 1e-8, 1e-10, 1e-13};
#define TOLERANCES                                                                                                     \
  .type = &num_double, .kind = SET_TOLERANCE, .settings = tolerances, .n = COUNT(tolerances), .quick = few_tolerances, \
  .n_quick = COUNT(few_tolerances)
#define ODE(name)                                                                                                      \
  {                                                                                                                    \
    "gsl-" #name, "GSL's " #name ", event located by Newton's iteration on the length of a step", TOLERANCES,          \
        .data = #name, .open = bench_ode_open, .close = bench_ode_close, .run = bench_ode_run                          \
  }

static const struct bench_method methods[] = {
    {"hand-written", "C by hand: Newton's iteration from rough t_b and t_c, no search", .type = &num_double,
     .bare = true, .run = run_yardstick},
    {"closed-double", "the suite's return map in double, first roots searched", .type = &num_double,
     .run = run_return_map},
    {"arc-double", "the suite's arc over any number type, in double", .type = &num_double, ARC(run_word)},
    {"closed-mpfr", "the suite's arc in MPFR, first roots searched in double", .type = &num_mpfr, BITS(7, 4),
     ARC(run_word)},
    {"closed-arb", "the suite's arc in balls", .type = &num_arb, BITS(7, 4), ARC(run_word)},
    ODE(rk8pd),
    ODE(rkck),
    ODE(rkf45),
    ODE(msadams),
    ODE(bsimp),
    ODE(msbdf),
    {"cvode-adams", "SUNDIALS' CVODE, Adams formulas, with its rootfinding", TOLERANCES, .data = "adams",
     .absent = !HAS_CVODE, .open = bench_cvode_open, .close = bench_cvode_close, .run = bench_cvode_run},
    {"cvode-bdf", "SUNDIALS' CVODE, BDF formulas, with its rootfinding", TOLERANCES, .data = "bdf",
     .absent = !HAS_CVODE, .open = bench_cvode_open, .close = bench_cvode_close, .run = bench_cvode_run},
};

const struct bench_job bench_map = {
    .id = "map",
    .title = "One Poincare map with its events",
    .inputs = "chi, eta, V, e1, e2 and r = z_2 - z_1 at the end of the stick phase",
    .outputs = "t_b, t_c, t_d and r at the end of the stick-slip phase; errors relative",
    .n_in = N_MAP_IN,
    .n_out = N_MAP_OUT,
    .n_cases = 64,
    .n_quick = 16,
    .worst_condition = 1e3,
    .group = groups,
    .place = place,
    .truth = truth_of,
    .methods = methods,
    .n_methods = COUNT(methods),
};
