/* The return map in double precision, held against arcs in balls, whose formulas and search for first events are
   others: every output of dyn_return_map, and those of dyn_return_map_d relative to the condition number.  Traps:
   starts on both sides of a jump, where a hump of z_1' almost reaches V and a later root lies in wait. */
#include "motion/return_map.h"

#include "accuracy.h"
#include "every.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { N_IN = N_PARAMS + 1, MOVE = 60, MOST_STEPS = 20000 };

/* chi near 0 or 1 too; r a little or far below e2/chi. */
static void random_input(double x[N_IN], struct rng *r) {
  static const struct param_ranges wide = {{0.1, 0.9}, {0.05, 20}, {0.135, 7.4}, {0.018, 7.4}, {0.018, 7.4}};
  double edge = 0.5 * exp(-7 * rng_unit(r)), kind = rng_unit(r);
  params_draw(x, r, &wide);
  if (kind < 0.4) x[P_CHI] = kind < 0.2 ? edge : 1 - edge;
  x[N_PARAMS] = x[P_E2] / x[P_CHI] - x[P_V] * exp(10 * rng_unit(r) - 8);
}

/* From inputs of which one is moved, near times that are found and proved to be first ones when nothing is. */
static bool truth_at(struct num_vec *out, const double *x, int moved, void *times) {
  double *t = times;
  NUMBERS(arb, r, step);
  OWNED(num_vec) params = vec_new(N_PARAMS, num_ctx_arb(ACCURACY_BITS));
  for (int i = 0; i < N_IN; i++) {
    arb_ptr to = i < N_PARAMS ? num_vec_at(&params, i) : r;
    arb_set_d(to, x[i]);
    arb_mul_2exp_si(step, to, -MOVE);
    if (i == moved) arb_add(to, to, step, ACCURACY_BITS);
  }
  int status = moved < 0 ? dyn_return_first(out, &params, r, MOST_STEPS) : dyn_return_near(out, &params, r, t);
  for (int i = 0; i < N_PHASES && !status && moved < 0; i++) t[i] = num_arb.get_d(num_vec_at(out, RETURN_TA + i));
  return status == SS_OK;
}

static const struct method map_method = {N_IN, N_RETURN, truth_at};

static bool errors_of(double error[N_RETURN], double *condition, const double x[N_IN], const double got[N_RETURN]) {
  double t[N_PHASES];
  return accuracy_of(error, condition, &map_method, x, got, t);
}

static bool map_of(double out[N_RETURN], const double x[N_IN], bool *searched) {
  struct dyn_return y;
  if (dyn_return_map(&y, x, x[N_PARAMS]) || y.grazing) return false;
  for (int i = 0; i < N_PHASES; i++) out[RETURN_TA + i] = y.t[i];
  out[RETURN_R] = y.r_end;
  out[RETURN_SLOPE] = y.slope;
  *searched = y.searched;
  return true;
}

/* Rounded once from twice the precision, or from balls. */
static void check_last_place(const double x[N_IN], const double got[N_RETURN], const double error[N_RETURN]) {
  for (int i = 0; i < N_RETURN; i++)
    ck_assert_msg(error[i] < 2 || got[i] == 0, "output %d errs by %g; %s r %.17g", i, error[i], params_shown(x),
                  x[N_PARAMS]);
}

/* Near 1 in size, where no number goes through balls for its parameters' sake. */
static void ordinary_input(double x[N_IN], struct rng *r) {
  static const struct param_ranges ordinary = {{0.0625, 0.9375}, {0.125, 8}, {0.25, 4}, {0.03125, 32}, {0.03125, 32}};
  params_draw(x, r, &ordinary);
  double top = x[P_E2] / x[P_CHI],
         far = rng_unit(r) < 0.3 ? top * exp2(-20 * rng_unit(r)) : x[P_V] * exp2(15 * rng_unit(r) - 10);
  x[N_PARAMS] = rng_unit(r) < 0.5 ? top - far : -far;
}

/* chi = k 2^-j or 1 - k 2^-j down to the last place, on both sides of every jump: r a little below e2/chi, or near a
   crest. */
static void edge_input(double x[N_IN], struct rng *r) {
  static const struct param_ranges wide = {{0, 1}, {0.015625, 64}, {0.125, 8}, {0.03125, 32}, {0.03125, 32}};
  double k = rng_unit(r) < 0.5 ? 1 + (double)rng_between(r, 0, 7) / 8 : 1 + rng_unit(r);
  double edge = ldexp(k, -(int)rng_between(r, 2, 53));
  params_draw(x, r, &wide);
  x[P_CHI] = rng_unit(r) < 0.7 ? 1 - edge : edge;
  double top = x[P_E2] / x[P_CHI], kind = rng_unit(r);
  x[N_PARAMS] = kind < 0.6   ? top - 2 * x[P_E1] * rng_unit(r)
                : kind < 0.8 ? top - x[P_V] * exp2(12 * rng_unit(r) - 8)
                             : -x[P_V];
}

/* From the three kinds of inputs by turns, those of the edges at more points: half of them have phases beyond the
   limits. */
TEST_EACH(every_output_is_right_to_the_last_place, 2) {
  enum { TRIALS = 800 };
  struct rng r = {(uint64_t)_i};
  int n = 0, searched = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    double x[N_IN], error[N_RETURN], got[N_RETURN];
    bool slow;
    if (trial % 4 == 0)
      random_input(x, &r);
    else if (trial % 4 == 1)
      ordinary_input(x, &r);
    else
      edge_input(x, &r);
    if (!map_of(got, x, &slow) || !errors_of(error, NULL, x, got)) continue;
    searched += slow;
    n++;
    check_last_place(x, got, error);
  }
  ck_assert_int_gt(n, TRIALS / 2);
  ck_assert_int_lt(searched, TRIALS / 10);
}

TABLE(lost, "tests/cases/returns_lost.tsv", N_IN + 1);

TEST(points_that_were_lost_once) {
  double worst = 0;
  for (int row = 0; row < lost.n; row++) {
    double x[N_IN], got[N_RETURN], error[N_RETURN], condition[N_RETURN], t[N_PHASES];
    bool slow;
    for (int i = 0; i < N_IN; i++) x[i] = strtod(lost.row[row][i], NULL);
    ck_assert(map_of(got, x, &slow) && errors_of(error, NULL, x, got));
    check_last_place(x, got, error);
    if (!is_yes(lost.row[row][N_IN])) continue;
    ck_assert_int_eq(dyn_return_map_d(&got[RETURN_R], &got[RETURN_SLOPE], t, x, x[N_PARAMS]), SS_OK);
    for (int i = 0; i < N_PHASES; i++) got[RETURN_TA + i] = t[i];
    ck_assert(errors_of(error, condition, x, got));
    for (int i = 0; i < N_RETURN; i++) worst = fmax(worst, error[i] / (1 + condition[i]));
  }
  ck_assert_double_gt(worst, 8); /* else nothing was tried here */
}

static int by_size(const void *x, const void *y) {
  double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

/* dyn_return_map_d, but for t_a and the slope. */
TEST_EACH(errors_are_those_of_the_inputs, 2) {
  enum { TRIALS = 500, N_MAP = 4 };
  static const int checked[N_MAP] = {RETURN_TB, RETURN_TC, RETURN_TD, RETURN_R};
  struct rng r = {(uint64_t)_i};
  double all[TRIALS * N_MAP];
  size_t n = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    double x[N_IN], error[N_RETURN], condition[N_RETURN], got[N_RETURN], exact[N_RETURN];
    bool slow;
    random_input(x, &r);
    if (!map_of(exact, x, &slow)) continue;
    ck_assert_int_eq(dyn_return_map_d(&got[RETURN_R], &got[RETURN_SLOPE], got, x, x[N_PARAMS]), SS_OK);
    if (!errors_of(error, condition, x, got)) continue;
    for (int i = 0; i < N_MAP; i++) {
      double e = error[checked[i]] / (1 + condition[checked[i]]);
      ck_assert_msg(e < 1024, "output %d: %g; %s r %.17g", checked[i], e, params_shown(x), x[N_PARAMS]);
      all[n++] = e;
    }
  }
  ck_assert_uint_gt(n, 2 * TRIALS);
  qsort(all, n, sizeof *all, by_size);
  ck_assert_double_lt(all[n / 2], 1);
  ck_assert_double_lt(all[n - n / 100], 8);
}

/* Closes in on a jump of t_c between two starts; false when there is none. */
static bool find_jump(double *low, double *high, double x[N_IN]) {
  struct dyn_return a, b, m;
  x[N_PARAMS] = *low;
  if (dyn_return_map(&a, x, *low) || dyn_return_map(&b, x, *high)) return false;
  if (fabs(a.t[PHASE_H] - b.t[PHASE_H]) < 0.5) return false;
  for (int i = 0; i < 50; i++) {
    double mid = 0.5 * (*low + *high);
    if (dyn_return_map(&m, x, mid)) return false;
    if (fabs(m.t[PHASE_H] - a.t[PHASE_H]) < fabs(m.t[PHASE_H] - b.t[PHASE_H]))
      *low = mid, a = m;
    else
      *high = mid, b = m;
  }
  return fabs(a.t[PHASE_H] - b.t[PHASE_H]) > 0.3;
}

CASE("jumps", .tags = "long");

TEST_EVERY(no_root_is_passed_by_at_a_jump, 2, 4) {
  struct rng r = {(uint64_t)_i};
  int jumps = 0, proved = 0;
  for (int trial = 0; trial < 400 && jumps < 6; trial++) {
    double x[N_IN];
    random_input(x, &r);
    double top = x[P_E2] / x[P_CHI], low = top - 3 * x[P_V] * rng_unit(&r), high = low + 0.25 * (top - low);
    if (!find_jump(&low, &high, x)) continue;
    jumps++;
    for (int k = 0; k < 40; k++) {
      double away = ldexp(fabs(low) + x[P_V], -k - 4), got[N_RETURN], error[N_RETURN];
      bool slow;
      x[N_PARAMS] = k % 2 == 0 ? low - away : high + away;
      if (!(x[N_PARAMS] < top) || !map_of(got, x, &slow) || !errors_of(error, NULL, x, got)) continue;
      check_last_place(x, got, error);
      proved++;
    }
  }
  ck_assert(jumps >= 4 && proved > 30 * jumps);
}

CASE("return_map");

/* At a crest of the rise the first root is double: told, or taken on the right side. */
TEST(crests_of_the_rise) {
  const double *p = example;
  double a = 0.2, fall = acos(-1) + 2 * atan2(a, p[P_E1]), crest = a * fall + 2 * p[P_E1], top = p[P_E2] / p[P_CHI];
  for (int k = 2; k < 52; k++)
    for (int side = -1; side <= 1; side += 2) {
      struct dyn_return got;
      double g = crest * (1 + side * ldexp(1, -k));
      if (dyn_return_map(&got, p, top - g)) continue; /* phase H from there can be beyond every limit */
      if (k > 45) ck_assert(got.grazing);
      if (got.grazing) continue;
      if (side < 0) ck_assert_double_le(got.t[PHASE_GAMMA], fall * (1 + 1e-7));
      if (side > 0) ck_assert_double_gt(got.t[PHASE_GAMMA], 2 * acos(-1));
    }
}

TEST_EACH(slope_is_the_derivative, 2) {
  struct rng r = {(uint64_t)_i};
  int n = 0;
  for (int trial = 0; trial < 200; trial++) {
    double x[N_IN];
    struct dyn_return at, up, down;
    random_input(x, &r);
    double h = 1e-6 * x[P_V];
    if (dyn_return_map(&at, x, x[N_PARAMS]) || dyn_return_map(&up, x, x[N_PARAMS] + h) ||
        dyn_return_map(&down, x, x[N_PARAMS] - h))
      continue;
    double slope = (up.r_end - down.r_end) / (2 * h), bend = fabs(up.r_end - 2 * at.r_end + down.r_end) / h;
    double noise = 1e-9 * (fabs(at.r_end) / x[P_V] + 1) / fmax(1 - x[P_CHI], 0.01);
    if (bend > 1e-4 * fabs(slope) || fabs(at.t[2] - up.t[2]) > 1e-3 || fabs(at.t[2] - down.t[2]) > 1e-3) continue;
    n++;
    ck_assert_msg(fabs(slope - at.slope) < 1e-3 * fabs(slope) + noise, "%.17g, differences %.17g", at.slope, slope);
  }
  ck_assert_int_gt(n, 40);
}

TEST(outside_the_domain) {
  struct dyn_return got;
  double r = -1.3, p[N_PARAMS];
  ck_assert_int_eq(dyn_return_map(&got, example, r), SS_OK);
  for (int k = 0; params_outside(p, k); k++) ck_assert_int_eq(dyn_return_map(&got, p, r), SS_DOMAIN);
  ck_assert_int_eq(dyn_return_map(&got, example, 0.8587 / 0.8), SS_DOMAIN);
  ck_assert_int_eq(dyn_return_map(&got, example, 5), SS_DOMAIN);
  ck_assert_int_eq(dyn_return_map(&got, example, NAN), SS_UNABLE);
  ck_assert_int_eq(dyn_return_map(&got, example, -INFINITY), SS_UNABLE);
  ck_assert_int_eq(dyn_return_map(&got, example, -1e300), SS_UNABLE); /* t_b beyond every limit */
}

/* Numbers at the ends of the exponents: any status, no trap, no endless loop. */
TEST(huge_and_tiny) {
  struct rng r = {1};
  for (int trial = 0; trial < 1500 / every(2); trial++) {
    double p[N_PARAMS], start = (rng_unit(&r) - 0.5) * size_draw(&r);
    struct dyn_return got;
    params_draw_sizes(p, &r);
    if (dyn_return_map(&got, p, start) == SS_OK)
      for (int i = 1; i < N_PHASES; i++) ck_assert(got.t[i] > 0 && isfinite(got.t[i]));
  }
}
