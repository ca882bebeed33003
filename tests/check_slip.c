/* First roots in phase H by nodes, asked directly: each answer is held against the motion by Taylor series in long
   double (plain.h), sampled.  What follows in the map, the orbit from a guess and the lanes can mend a wrong one. */
#include "motion/slip.h"

#include "params.h"
#include "plain.h"
#include "rng.h"
#include "test.h"

/* A phase H, and where it starts. */
struct phase_h {
  struct slip k;
  struct slip_motion motion;
  struct plain plain;
  real start[N_STATE];
};

static void begin(struct phase_h *h, const double p[N_PARAMS], double tb) {
  slip_set(&h->k, p);
  h->motion = (struct slip_motion){.k = &h->k, .g = gamma_at(&h->k, tb, half_angle(tb))};
  h->motion.m = slip_modes(&h->k, &h->motion.g);
  h->plain = (struct plain){p[P_CHI], p[P_ETA], p[P_V], p[P_E1], p[P_E2]};
  const real w = h->motion.g.w, r = h->plain.e2 / h->plain.chi;
  h->start[Z_1] = (w + h->plain.chi * r) / (1 - h->plain.chi);
  h->start[Z_2] = h->start[Z_1] + r;
  h->start[DZ_1] = h->plain.v + h->motion.g.p;
  h->start[DZ_2] = h->plain.v;
}

/* From a time in the slip-stick phase before z_1' has come back to V. */
static void draw(struct phase_h *h, struct rng *r) {
  static const struct param_ranges wide = {{0.05, 0.95}, {0.1, 10}, {0.5, 2}, {0.05, 5}, {0.05, 5}};
  double p[N_PARAMS];
  params_draw(p, r, &wide);
  double a = (1 - p[P_CHI]) * p[P_V];
  begin(h, p, rng_unit(r) * (acos(-1) + 2 * atan2(a, p[P_E1])));
}

/* How far a velocity is above the belt's, at the greatest of what is looked at before t. */
static double highest(const struct phase_h *h, int mass, double t) {
  enum { LOOKS = 200 };
  double most = -HUGE_VAL;
  real z[N_STATE];
  for (int i = 1; i < LOOKS; i++) {
    plain_flow(z, &h->plain, PHASE_H, h->start, t * i / LOOKS);
    most = fmax(most, (double)(z[DZ_1 + mass] - h->plain.v));
  }
  return most;
}

static struct stop stop_of(const struct phase_h *h, double t) {
  struct stop x = {.t = t};
  slip_turn(x.x, &h->k, t);
  x.n = slip_node(&h->k, &h->motion.m, &h->motion.g, x.x);
  return x;
}

/* What is said of a velocity up to a stop; what is plain must be told. */
static truth check_below(const struct phase_h *h, int mass, const struct stop *last) {
  double most = highest(h, mass, last->t);
  truth below = slip_stays_below(&h->motion, mass, last);
  ck_assert_msg(below != TRUTH_TRUE || most < 1e-12, "mass %d until %.17g: %g", mass, last->t, most);
  ck_assert_msg(below != TRUTH_FALSE || most > -1e-3, "mass %d until %.17g: %g", mass, last->t, most);
  ck_assert_msg(below == TRUTH_FALSE || most < 1e-3, "mass %d until %.17g: %g is not told", mass, last->t, most);
  return below;
}

TEST(answers_are_those_of_the_motion) {
  enum { TRIALS = 300 };
  struct rng r = {1};
  int roots = 0, later = 0, answers[2][3] = {{0}};
  for (int trial = 0; trial < TRIALS; trial++) {
    struct phase_h h;
    struct stop first, other;
    draw(&h, &r);
    const struct stop at = stop_of(&h, 12 * rng_unit(&r));
    answers[1][check_below(&h, 1, &at)]++;
    if (slip_first_root(&first, &h.motion) != SS_OK) continue;
    roots++;
    ck_assert_msg(highest(&h, 0, first.t) < 0, "root %.17g", first.t);
    real z[N_STATE];
    plain_flow(z, &h.plain, PHASE_H, h.start, first.t);
    ck_assert_double_lt(fabs((double)(z[DZ_1] - h.plain.v)), 1e-13 * (1 + first.t));
    ck_assert_int_eq(check_below(&h, 0, &first), TRUTH_TRUE);
    if (!slip_root_near(&other, &h.motion, first.t + 8 * rng_unit(&r)) || other.t < first.t * 1.01) continue;
    later++;
    answers[0][check_below(&h, 0, &other)]++;
  }
  for (int mass = 0; mass < 2; mass++) ck_assert_int_eq(answers[mass][TRUTH_UNKNOWN], 0);
  ck_assert(roots > 250 && later > 15 && answers[1][TRUTH_FALSE] > 50 && answers[1][TRUTH_TRUE] > 150);
}

/* A node lies just above zero after the root: the step back from it is short, and was taken for a converged one.  The
   first root to eleven digits is from a dense search in mpmath on the closed form of phase H. */
TEST(a_short_step_is_no_root) {
  static const double p[N_PARAMS] = {0.9675374192474498, 0.7669073880795517, 4.668603296278052, 0.6575528774251659,
                                     3.085043097852551};
  struct phase_h h;
  struct stop x;
  begin(&h, p, 72.205426320514476); /* r = -9.061022262877927 at the start of the slip-stick phase */
  ck_assert_int_eq(slip_first_root(&x, &h.motion), SS_OK);
  ck_assert_double_eq_tol(x.t, 0.74747991519, 1e-10);
}
