/* The orbit from a guess: none that the certified list of the search does not have, whatever the guess, and a status
   for whatever is no guess or no parameter.  Its numbers and conditions are held against balls in check_batch.c. */
#include "motion/warm.h"

#include "accuracy.h"
#include "explore/family.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { PREC = 100 };

static const struct param_ranges ordinary = {{0.05, 0.97}, {0.135, 7.4}, {0.135, 7.4}, {0.135, 7.4}, {0.05, 2.7}};

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
