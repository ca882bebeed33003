/* The orbit from a guess, held against the certified list of the search: numbers relative to their condition, every
   condition that is told, and no orbit that the list does not have, whatever the guess. */
#include "motion/warm.h"

#include "accuracy.h"
#include "explore/family.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { PREC = 100 };

static const struct param_ranges ordinary = {{0.05, 0.97}, {0.135, 7.4}, {0.135, 7.4}, {0.135, 7.4}, {0.05, 2.7}};

struct tally {
  int orbits, outputs, admissible, refused, refused_admissible;
};

/* What is found from near an orbit of the list is an orbit, that one or another, to its digits. */
static void check_orbit(struct tally *y, const struct dyn_orbit *o, const double p[N_PARAMS], struct rng *r) {
  double out[N_DYN_OUT], bare[N_DYN_OUT], condition[N_DYN_OUT], guess[2];
  unsigned violations, unsure;
  for (int i = 0; i < 2; i++) guess[i] = o->guess[PHASE_GAMMA + i] * (1 + 1e-3 * (rng_unit(r) - 0.5));
  int status = dyn_orbit_warm(out, &violations, &unsure, p, guess);
  y->orbits++;
  y->admissible += o->admissible == TRUTH_TRUE;
  y->refused += status != SS_OK;
  y->refused_admissible += status != SS_OK && o->admissible == TRUTH_TRUE;
  if (status || !check_orbit_found(condition, p, out, violations, unsure)) return;
  bool has_bare = dyn_orbit_bare(bare, p, guess) == SS_OK; /* it may refuse positions */
  for (int i = 0; i < DYN_OUT_U1 && has_bare; i++)
    ck_assert_double_le(fabs(bare[i] - out[i]), 1024 * 0x1p-53 * (1 + condition[i]) * fabs(out[i]));
  y->outputs += N_DYN_OUT;
}

/* Every orbit of the list at one set of parameters. */
static void check_set(struct tally *y, const double p[N_PARAMS], struct rng *r) {
  enum { MOST = 16 };
  OWNED(dyn_orbits) list;
  FREED_PARAMS fmpq *q = rationals_d(p, N_PARAMS);
  dyn_orbits_find(&list, q, PREC, NULL);
  for (slong k = 0; k < list.n && k < MOST; k++) check_orbit(y, &list.orbit[k], p, r);
}

/* edges: chi near 0 and 1, eta from 1e-3 to 1e3. */
static struct tally tally_of(int seed, int sets, bool edges) {
  struct rng r = {(uint64_t)seed};
  struct tally y = {0};
  for (int trial = 0; trial < sets; trial++) {
    double p[N_PARAMS];
    params_draw(p, &r, &ordinary);
    if (edges) params_to_edges(p, &r, trial % 2 == 0);
    check_set(&y, p, &r);
  }
  return y;
}

TEST_EVERY(numbers_and_conditions, 3, 3) {
  enum { SETS = 150 };
  struct tally y = tally_of(_i, SETS, false);
  ck_assert_int_gt(y.outputs, 5 * SETS);
  ck_assert_int_gt(y.admissible, SETS / 20);
  ck_assert_int_le(20 * y.refused_admissible, y.admissible);
}

TEST_EVERY(numbers_at_extremes, 2, 2) {
  enum { SETS = 100 };
  ck_assert_int_gt(tally_of(_i, SETS, true).outputs, SETS);
}

/* From guesses anywhere: what is returned is in the list. */
TEST_EVERY(no_orbit_is_invented, 3, 3) {
  enum { SETS = 60, GUESSES = 200 };
  struct rng r = {(uint64_t)_i};
  int found = 0;
  for (int trial = 0; trial < SETS; trial++) {
    double p[N_PARAMS];
    OWNED(dyn_orbits) list;
    params_draw(p, &r, &ordinary);
    FREED_PARAMS fmpq *q = rationals_d(p, N_PARAMS);
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
      ck_assert_msg(known, "%s: t_b %.17g t_c %.17g", params_shown(p), out[DYN_OUT_TB], out[DYN_OUT_TC]);
      found++;
    }
  }
  ck_assert_int_gt(found, SETS);
}

TEST(hostile) {
  const double wild[] = {0, -1, NAN, INFINITY, -INFINITY, 1e300, 1e-300}, good[2] = {2, 1.5};
  double out[N_DYN_OUT], p[N_PARAMS];
  unsigned violations, unsure;
  ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, example, good), SS_OK);
  for (int k = 0; params_outside(p, k); k++)
    ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, p, good), SS_DOMAIN);
  for (size_t i = 0; i < COUNT(wild); i++)
    for (int k = 0; k < 2; k++) {
      double guess[2] = {good[0], good[1]};
      guess[k] = wild[i];
      ck_assert_int_eq(dyn_orbit_warm(out, &violations, &unsure, example, guess), SS_UNABLE);
    }
  for (int k = 0; k < 2 * N_PARAMS; k++) { /* any status, and no number that is none */
    memcpy(p, example, sizeof p);
    p[k / 2] = k % 2 ? 1e300 : 1e-300;
    int status = dyn_orbit_warm(out, &violations, &unsure, p, good);
    for (int i = 0; i < N_DYN_OUT && status == SS_OK; i++) ck_assert(isfinite(out[i]));
  }
}

/* Every number at the ends of the exponents: a status, no trap, and no number that is none. */
TEST(huge_and_tiny) {
  struct rng r = {1};
  for (int trial = 0; trial < 20000; trial++) {
    double p[N_PARAMS], out[N_DYN_OUT], guess[2];
    unsigned violations, unsure;
    params_draw_sizes(p, &r);
    for (int i = 0; i < 2; i++) guess[i] = 6 * rng_unit(&r) * pow(1e8, (double)rng_between(&r, -1, 1));
    if (dyn_orbit_warm(out, &violations, &unsure, p, guess)) continue;
    for (int i = 0; i < N_DYN_OUT; i++) ck_assert(isfinite(out[i]));
  }
}
