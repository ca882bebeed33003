/* The orbit from a guess, held against the certified list of the search: numbers relative to their condition, every
   condition that is told, and no orbit that the list does not have, whatever the guess. */
#include "motion/warm.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy.h"
#include "every.h"
#include "explore/family.h"
#include "rational.h"
#include "rng.h"
#include "suites.h"

enum { PREC = 100 };

static void random_params(double p[N_PARAMS], struct rng *r) {
  p[P_CHI] = 0.05 + 0.92 * rng_unit(r);
  p[P_ETA] = exp(4 * rng_unit(r) - 2);
  p[P_V] = exp(4 * rng_unit(r) - 2);
  p[P_E1] = p[P_V] * exp(4 * rng_unit(r) - 2);
  p[P_E2] = p[P_V] * exp(4 * rng_unit(r) - 3);
}

struct tally {
  int orbits, outputs, admissible, refused, refused_admissible;
};

static void check_conditions(const truth holds[N_CONDITIONS], unsigned violations, unsigned unsure) {
  ck_assert_uint_eq(violations & unsure, 0);
  for (int i = 0; i < N_CONDITIONS; i++) {
    if ((unsure >> i & 1) || holds[i] == TRUTH_UNKNOWN) continue;
    ck_assert_msg(holds[i] == (violations >> i & 1 ? TRUTH_FALSE : TRUTH_TRUE), "%s", dyn_condition_id[i]);
  }
}

/* What is found from near an orbit of the list is an orbit, that one or another, to its digits. */
static void check_orbit(struct tally *y, const struct dyn_orbit *o, const double p[N_PARAMS], struct rng *r) {
  double out[N_DYN_OUT], bare[N_DYN_OUT], error[N_DYN_OUT], condition[N_DYN_OUT], guess[2];
  unsigned violations, unsure;
  for (int i = 0; i < 2; i++) guess[i] = o->guess[PHASE_GAMMA + i] * (1 + 1e-3 * (rng_unit(r) - 0.5));
  int status = dyn_orbit_warm(out, &violations, &unsure, p, guess);
  y->orbits++;
  y->admissible += o->admissible == TRUTH_TRUE;
  y->refused += status != SS_OK;
  y->refused_admissible += status != SS_OK && o->admissible == TRUTH_TRUE;
  if (status) return;
  struct orbit_truth t = {.tb = out[DYN_OUT_TB], .tc = out[DYN_OUT_TC], .up = out[DYN_OUT_Z20] > out[DYN_OUT_Z10]};
  bool steep = accuracy_of(error, condition, &orbit_method, p, out, &t);
  ck_assert_msg(t.found, "no orbit at t_b %.17g t_c %.17g; chi %.17g eta %.17g V %.17g e1 %.17g e2 %.17g", t.tb, t.tc,
                p[0], p[1], p[2], p[3], p[4]);
  if (!steep) return;
  check_conditions(t.holds, violations, unsure);
  bool has_bare = dyn_orbit_bare(bare, p, guess) == SS_OK; /* it may refuse positions */
  for (int i = 0; i < N_DYN_OUT; i++) {
    ck_assert_msg(error[i] <= 8 * (1 + condition[i]) && error[i] <= 2,
                  "output %d: %g; chi %.17g eta %.17g V %.17g e1 %.17g e2 %.17g t_b %.17g t_c %.17g", i, error[i], p[0],
                  p[1], p[2], p[3], p[4], guess[0], guess[1]);
    y->outputs++;
    if (has_bare && i < DYN_OUT_U1)
      ck_assert_double_le(fabs(bare[i] - out[i]), 1024 * 0x1p-53 * (1 + condition[i]) * fabs(out[i]));
  }
}

/* Every orbit of the list at one set of parameters. */
static void check_set(struct tally *y, const double p[N_PARAMS], struct rng *r) {
  enum { MOST = 16 };
  struct dyn_orbits list;
  fmpq *q = rationals_d(p, N_PARAMS);
  dyn_orbits_find(&list, q, PREC, NULL);
  for (slong k = 0; k < list.n && k < MOST; k++) check_orbit(y, &list.orbit[k], p, r);
  dyn_orbits_clear(&list);
  _fmpq_vec_clear(q, N_PARAMS);
}

START_TEST(numbers_and_conditions) {
  enum { SETS = 150 };
  struct rng r = {(uint64_t)_i};
  struct tally y = {0};
  for (int trial = 0; trial < SETS; trial++) {
    double p[N_PARAMS];
    random_params(p, &r);
    check_set(&y, p, &r);
  }
  ck_assert_int_gt(y.outputs, 5 * SETS);
  ck_assert_int_gt(y.admissible, SETS / 20);
  ck_assert_int_le(20 * y.refused_admissible, y.admissible);
}
END_TEST

/* chi near 0 and 1, eta from 1e-3 to 1e3. */
START_TEST(numbers_at_extremes) {
  enum { SETS = 100 };
  struct rng r = {(uint64_t)_i};
  struct tally y = {0};
  for (int trial = 0; trial < SETS; trial++) {
    double p[N_PARAMS];
    random_params(p, &r);
    p[P_CHI] = trial % 2 == 0 ? pow(10, -4 * rng_unit(&r)) / 2 : 1 - pow(10, -5 * rng_unit(&r)) / 2;
    p[P_ETA] = pow(10, 6 * rng_unit(&r) - 3);
    check_set(&y, p, &r);
  }
  ck_assert_int_gt(y.outputs, SETS);
}
END_TEST

/* From guesses anywhere: what is returned is in the list. */
START_TEST(no_orbit_is_invented) {
  enum { SETS = 60, GUESSES = 200 };
  struct rng r = {(uint64_t)_i};
  int found = 0;
  for (int trial = 0; trial < SETS; trial++) {
    double p[N_PARAMS];
    struct dyn_orbits list;
    random_params(p, &r);
    fmpq *q = rationals_d(p, N_PARAMS);
    int status = dyn_orbits_find(&list, q, PREC, NULL);
    for (int k = 0; k < GUESSES && status == SS_OK; k++) {
      double guess[2] = {6.2 * rng_unit(&r), 30 * rng_unit(&r) * rng_unit(&r)}, out[N_DYN_OUT];
      unsigned violations, unsure;
      if (dyn_orbit_warm(out, &violations, &unsure, p, guess)) continue;
      bool known = false;
      for (slong i = 0; i < list.n; i++) {
        const double *t = list.orbit[i].guess;
        if (fabs(t[PHASE_GAMMA] - out[DYN_OUT_TB]) > 1e-8 || fabs(t[PHASE_H] - out[DYN_OUT_TC]) > 1e-8) continue;
        known = true;
        check_conditions(list.orbit[i].holds, violations, unsure);
      }
      ck_assert_msg(known, "t_b %.17g t_c %.17g; chi %.17g eta %.17g V %.17g e1 %.17g e2 %.17g", out[DYN_OUT_TB],
                    out[DYN_OUT_TC], p[0], p[1], p[2], p[3], p[4]);
      found++;
    }
    dyn_orbits_clear(&list);
    _fmpq_vec_clear(q, N_PARAMS);
  }
  ck_assert_int_gt(found, SETS);
}
END_TEST

static const double example[N_PARAMS] = {0.8, 1, 1, 2.7844, 0.8587};

START_TEST(hostile) {
  const double bad[] = {0, -1, NAN, INFINITY, -INFINITY, 1e300, 1e-300}, good[2] = {2, 1.5};
  double out[N_DYN_OUT];
  unsigned violations, unsure;
  ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, example, good), SS_OK);
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    for (int k = 0; k < 2; k++) {
      double guess[2] = {good[0], good[1]};
      guess[k] = bad[i];
      ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, example, guess), SS_UNABLE);
    }
    for (int k = 0; k < N_PARAMS; k++) {
      double p[N_PARAMS];
      memcpy(p, example, sizeof p);
      p[k] = bad[i];
      int status = dyn_orbit_warm(out, &violations, &unsure, p, good);
      if (i < 5) ck_assert_int_eq(status, SS_DOMAIN);
      for (int l = 0; l < N_DYN_OUT && status == SS_OK; l++) ck_assert(isfinite(out[l]));
    }
  }
  const double one[N_PARAMS] = {1, 1, 1, 2.7844, 0.8587};
  ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, one, good), SS_DOMAIN);
}
END_TEST

/* Every number at the ends of the exponents: a status, no trap, and no number that is none. */
START_TEST(huge_and_tiny) {
  static const double size[] = {1e-310, 1e-160, 1e-8, 1, 1e8, 1e160, 1e308};
  enum { N = sizeof size / sizeof *size };
  struct rng r = {1};
  for (int trial = 0; trial < 20000; trial++) {
    double p[N_PARAMS], out[N_DYN_OUT], guess[2];
    unsigned violations, unsure;
    for (int i = 0; i < N_PARAMS; i++) p[i] = size[rng_between(&r, 0, i == P_CHI ? 2 : N - 1)];
    for (int i = 0; i < 2; i++) guess[i] = 6 * rng_unit(&r) * size[rng_between(&r, 2, 4)];
    if (dyn_orbit_warm(out, &violations, &unsure, p, guess)) continue;
    for (int i = 0; i < N_DYN_OUT; i++) ck_assert(isfinite(out[i]));
  }
}
END_TEST

Suite *warm_suite(void) {
  Suite *s = suite_create("warm");
  TCase *t = tcase_create("warm");
  tcase_set_timeout(t, 120);
  add_every(t, numbers_and_conditions, 3, 3);
  add_every(t, numbers_at_extremes, 2, 2);
  add_every(t, no_orbit_is_invented, 3, 3);
  tcase_add_test(t, hostile);
  tcase_add_test(t, huge_and_tiny);
  suite_add_tcase(s, t);
  return s;
}
