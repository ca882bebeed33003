/* Orbits in lanes.

   Held against balls (dyn_orbit_near: existence proved, every condition decided) with condition numbers from differences of
   balls; against the scalar solver; and against itself on every instruction set, at every place and size. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/batch_impl.h"
#include "dynamics/dyn_impl.h"
#include "stickslip/arena.h"
#include "suites.h"

static const double unit = 0x1p-53;

/* Points with the orbit that the search found there. */
struct table {
  slong n, cap;
  double *params[N_PARAMS], *guess[2], *out[N_DYN_OUT];
  bool *up;
  unsigned *violations;
  int *status;
};

static void table_init(struct table *t, slong cap) {
  *t = (struct table){.cap = cap};
  size_t n = (size_t)cap;
  for (int i = 0; i < N_PARAMS; i++) t->params[i] = ss_malloc(n * sizeof(double));
  for (int i = 0; i < 2; i++) t->guess[i] = ss_malloc(n * sizeof(double));
  for (int i = 0; i < N_DYN_OUT; i++) t->out[i] = ss_malloc(n * sizeof(double));
  t->up = ss_malloc(n * sizeof *t->up);
  t->violations = ss_malloc(n * sizeof *t->violations);
  t->status = ss_malloc(n * sizeof *t->status);
}

static void table_clear(struct table *t) {
  for (int i = 0; i < N_PARAMS; i++) free(t->params[i]);
  for (int i = 0; i < 2; i++) free(t->guess[i]);
  for (int i = 0; i < N_DYN_OUT; i++) free(t->out[i]);
  free(t->up);
  free(t->violations);
  free(t->status);
}

static void table_add(struct table *t, const double p[N_PARAMS], double tb, double tc, bool up) {
  if (t->n == t->cap) return;
  for (int i = 0; i < N_PARAMS; i++) t->params[i][t->n] = p[i];
  t->guess[0][t->n] = tb;
  t->guess[1][t->n] = tc;
  t->up[t->n++] = up;
}

static uint64_t state;

static double uniform(void) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(state >> 11) * 0x1p-53;
}

/* Every orbit that the search finds, its times moved by relative steps up to `off`. */
static void add_orbits(struct table *t, const double p[N_PARAMS], double off) {
  struct search s;
  if (search_run(&s, p, &dyn_limits_default) == SS_OK)
    for (size_t i = 0; i < s.n; i++)
      table_add(t, p, s.zeros[i].tb * (1 + off * (2 * uniform() - 1)), s.zeros[i].tc * (1 + off * (2 * uniform() - 1)),
                s.zeros[i].up);
  search_clear(&s);
}

static void any_params(double p[N_PARAMS]) {
  p[P_CHI] = 0.03 + 0.95 * uniform();
  p[P_ETA] = exp(5 * uniform() - 2.5);
  p[P_V] = exp(2 * uniform() - 1);
  p[P_E1] = p[P_V] * exp(3 * uniform() - 1.5);
  p[P_E2] = p[P_V] * exp(4 * uniform() - 3);
}

static void run(struct table *t) {
  const double *params[N_PARAMS], *guess[2] = {t->guess[0], t->guess[1]};
  for (int i = 0; i < N_PARAMS; i++) params[i] = t->params[i];
  dyn_orbits_batch(t->out, t->violations, t->status, params, guess, t->n, 1);
}

/* --- Truth. --- */

static void outputs_of(arb_srcptr x[N_DYN_OUT], const struct dyn_orbit *o) {
  arb_srcptr all[N_DYN_OUT] = {o->z10, o->z20, o->t[0], o->t[1], o->t[2], o->t[3], o->period, o->trace, o->u_r1_min, o->u_r2_min};
  for (int i = 0; i < N_DYN_OUT; i++) x[i] = all[i];
}

/* The orbit at parameters p (1 + shift) in one of them. */
static bool orbit_at(struct dyn_orbit *o, truth *first, const struct table *t, slong j, int moved, double shift) {
  fmpq params[N_PARAMS];
  arf_t x;
  arf_init(x);
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_init(&params[i]);
    arf_set_d(x, t->params[i][j]);
    if (i == moved) {
      arf_t more;
      arf_init(more);
      arf_set_d(more, 1 + shift);
      arf_mul(x, x, more, ARF_PREC_EXACT, ARF_RND_DOWN);
      arf_clear(more);
    }
    arf_get_fmpq(&params[i], x);
  }
  int status = dyn_orbit_near(o, first, params, t->guess[0][j], t->guess[1][j], t->up[j], 160, &dyn_limits_default);
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(&params[i]);
  arf_clear(x);
  return status == SS_OK;
}

/* Condition numbers by central differences; false where an orbit is lost on the way. */
static bool conditions(double condition[N_DYN_OUT], const struct table *t, slong j, const struct dyn_orbit *o) {
  const double shift = 0x1p-45;
  arb_srcptr at[N_DYN_OUT];
  arb_t d;
  bool all = true;
  arb_init(d);
  outputs_of(at, o);
  for (int i = 0; i < N_DYN_OUT; i++) condition[i] = 0;
  for (int k = 0; k < N_PARAMS && all; k++) {
    struct dyn_orbit low, high;
    truth first;
    all &= orbit_at(&low, &first, t, j, k, -shift);
    all &= orbit_at(&high, &first, t, j, k, shift);
    arb_srcptr x[N_DYN_OUT], y[N_DYN_OUT];
    outputs_of(x, &low);
    outputs_of(y, &high);
    for (int i = 0; i < N_DYN_OUT && all; i++) {
      arb_sub(d, y[i], x[i], 200);
      arb_div(d, d, at[i], 200);
      condition[i] += fabs(arf_get_d(arb_midref(d), ARF_RND_NEAR)) / (2 * shift);
    }
    dyn_orbit_clear(&low);
    dyn_orbit_clear(&high);
  }
  arb_clear(d);
  return all;
}

struct score {
  slong ok, unable, wrong;
  double worst; /* error over its bound */
  char where[400];
};

static unsigned violations_of(const struct dyn_orbit *o, bool *sure) {
  unsigned broken = 0;
  *sure = true;
  for (int i = 0; i < N_CONDITIONS; i++) {
    if (o->holds[i] == TRUTH_FALSE) broken |= 1u << i;
    if (o->holds[i] == TRUTH_UNKNOWN) *sure = false;
  }
  return broken;
}

/* Holds the results against balls. */
static void judge(struct score *s, const struct table *t) {
  for (slong j = 0; j < t->n; j++) {
    struct dyn_orbit o;
    truth first;
    double condition[N_DYN_OUT];
    bool sure;
    if (t->status[j] != SS_OK) {
      s->unable++;
      continue;
    }
    s->ok++;
    bool any = orbit_at(&o, &first, t, j, -1, 0);
    if (!any || first != TRUTH_TRUE || violations_of(&o, &sure) != t->violations[j] || !sure) {
      s->wrong++;
      snprintf(s->where, sizeof s->where, "%.17g %.17g %.17g %.17g %.17g: orbit %d first %d violations %x, got %x", t->params[0][j],
               t->params[1][j], t->params[2][j], t->params[3][j], t->params[4][j], any, first, any ? violations_of(&o, &sure) : 0,
               t->violations[j]);
    } else if (conditions(condition, t, j, &o)) {
      arb_srcptr x[N_DYN_OUT];
      arb_t d;
      arb_init(d);
      outputs_of(x, &o);
      for (int i = 0; i < N_DYN_OUT; i++) {
        arb_set_d(d, t->out[i][j]);
        arb_sub(d, d, x[i], 200);
        arb_div(d, d, x[i], 200);
        double error = fabs(arf_get_d(arb_midref(d), ARF_RND_NEAR)) / (8 * fmax(1, condition[i]) * unit);
        if (error > s->worst || isnan(error)) {
          s->worst = error;
          snprintf(s->where, sizeof s->where, "%.17g %.17g %.17g %.17g %.17g (%.17g %.17g): output %d, condition %g, %g of the bound",
                   t->params[0][j], t->params[1][j], t->params[2][j], t->params[3][j], t->params[4][j], t->out[DYN_OUT_TB][j],
                   t->out[DYN_OUT_TC][j], i, condition[i], error);
        }
      }
      arb_clear(d);
    }
    dyn_orbit_clear(&o);
  }
}

static void check_score(const struct score *s, double decided) {
  fprintf(stderr, "%ld ok, %ld unable, %ld wrong, worst %g: %s\n", (long)s->ok, (long)s->unable, (long)s->wrong, s->worst, s->where);
  ck_assert_msg(s->wrong == 0, "%ld wrong: %s", (long)s->wrong, s->where);
  ck_assert_msg(s->worst <= 1, "%s", s->where);
  ck_assert_msg((double)s->ok >= decided * (double)(s->ok + s->unable), "%ld decided, %ld left open", (long)s->ok,
                (long)s->unable);
}

START_TEST(random_points_against_balls) {
  struct table t;
  struct score s = {0};
  state = 31;
  table_init(&t, 250);
  for (double p[N_PARAMS]; t.n < t.cap;) {
    any_params(p);
    add_orbits(&t, p, 1e-4);
  }
  run(&t);
  judge(&s, &t);
  check_score(&s, 0.6);
  table_clear(&t);
}
END_TEST

Suite *batch_suite(void) {
  Suite *s = suite_create("batch");
  TCase *c = tcase_create("batch");
  tcase_add_test(c, random_points_against_balls);
  suite_add_tcase(s, c);
  return s;
}
