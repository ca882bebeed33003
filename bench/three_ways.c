/* Newton's iteration in double on the paper's equations, on six and on the return map, from the orbit itself: what
   stays is what rounding does. */
#include "bench/three_ways.h"

#include <math.h>

#include "bench/jobs.h"
#include "motion/paper_route.h"

static double digits_lost(const double x[N_ROUTE], const struct dyn_orbit *o) {
  OWNED(num_vec) known;
  num_vec_init(&known, N_ROUTE, num_ctx_mpfr(THREE_WAYS_BITS));
  for (int i = 0; i < N_ROUTE; i++)
    arf_get_mpfr(num_vec_at(&known, i), arb_midref(i < ROUTE_Z ? o->t[i] : i == ROUTE_Z ? o->z10 : o->z20), MPFR_RNDN);
  return paper_digits_lost(x, &known);
}

/* Of the six equations' Jacobian. */
static double condition_six(const double *params, const double x[SIX]) {
  double f[SIX], j[SIX * SIX], k;
  bench_six(f, j, params, x);
  const struct num_vec a = {num_ctx_double(), SIX * SIX, (char *)j};
  return paper_condition_number(&k, &a, SIX) ? INFINITY : k;
}

/* Newton's iteration on the six equations from x; its last steps stay at the level of rounding. */
static void solve_six(double x[SIX], const double *params) {
  enum { STEPS = 8 };
  for (int n = 0; n < STEPS; n++) {
    double f[SIX], j[SIX * SIX];
    bench_six(f, j, params, x);
    struct num_vec a = {num_ctx_double(), SIX * SIX, (char *)j}, b = {num_ctx_double(), SIX, (char *)f};
    int status = num_mat_solve(&b, &a, &b, SIX, 1);
    for (int i = 0; i < SIX; i++) x[i] -= f[i]; /* NaN where it is singular */
    if (status) return;
  }
}

static void six_of(double x[SIX], const struct dyn_orbit *o) {
  x[0] = num_arb.get_d(o->z10);
  x[1] = num_arb.get_d(o->z20);
  for (int i = 0; i < N_PHASES; i++) x[2 + i] = num_arb.get_d(o->t[i]);
}

static double lost_by_six(const double *params, const struct dyn_orbit *o) {
  double x[SIX];
  six_of(x, o);
  solve_six(x, params);
  const double y[N_ROUTE] = {x[2], x[3], x[4], x[5], x[0], x[1]};
  return digits_lost(y, o);
}

static double lost_by_map(const double *params, const struct dyn_orbit *o) {
  double x[N_ROUTE + 1], r = num_arb.get_d(o->z20) - num_arb.get_d(o->z10);
  long steps;
  return bench_orbit_by_map(x, &steps, params, r) ? (double)NAN : digits_lost(x, o);
}

void three_ways(struct three_ways *l, const double *params, const fmpq *exact, const struct dyn_orbit *o) {
  OWNED(paper_route) route;
  double x[SIX];
  six_of(x, o);
  paper_route_init(&route, THREE_WAYS_BITS);
  paper_route_run(&route, exact, o->guess);
  *l = (struct three_ways){.paper = route.digits_lost,
                           .six = lost_by_six(params, o),
                           .map = lost_by_map(params, o),
                           .k_paper = route.condition.jacobian,
                           .k_n1 = route.condition.n1,
                           .k_n3 = route.condition.n3,
                           .k_six = condition_six(params, x),
                           .k_map = 1 / fabs(1 - num_arb.get_d(o->trace))};
}
