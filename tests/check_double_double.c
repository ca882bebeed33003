/* Arithmetic, sines and angles in twice the precision, held against balls on random operands of every size that the
   orbits have. */
#include "motion/double_double.h"
#include "num/flint_compat.h"
#include "rng.h"
#include "test.h"

enum { BITS = 300, TRIALS = 20000 };

/* Of either sign, from 2^-least to 2^most, with a low half of any size. */
static struct dd any(struct rng *r, int least, int most) {
  double x = ldexp(1 + rng_unit(r), (int)rng_between(r, -least, most)) * (rng_between(r, 0, 1) ? 1 : -1);
  return dd_fast_sum(x, x * ldexp(rng_unit(r) - 0.5, -(int)rng_between(r, 53, 80)));
}

static void set(arb_t x, struct dd y) {
  NUMBERS(arb, low);
  arb_set_d(x, y.high);
  arb_set_d(low, y.low);
  arb_add(x, x, low, BITS);
}

/* |x - want| in units of 2^-100 of size, or of |want| where size is 0. */
static double off(struct dd x, const arb_t want, double size) {
  NUMBERS(arb, d, s);
  set(d, x);
  arb_sub(d, d, want, BITS);
  arb_set_d(s, size);
  arb_div(d, d, size > 0 ? s : want, BITS);
  return ldexp(fabs(num_arb.get_d(d)), 100);
}

TEST(arithmetic) {
  struct rng r = {1};
  NUMBERS(arb, x, y, want);
  for (int i = 0; i < TRIALS; i++) {
    struct dd a = any(&r, 40, 40), b = any(&r, 40, 40);
    if (i % 4 == 0) b = dd_fast_sum(-a.high * (1 + ldexp(rng_unit(&r), -(int)rng_between(&r, 0, 50))), a.low);
    double larger = fmax(fabs(a.high), fabs(b.high));
    set(x, a), set(y, b);
    arb_add(want, x, y, BITS);
    ck_assert_double_lt(off(dd_add(a, b), want, larger), 1);
    arb_sub(want, x, y, BITS);
    ck_assert_double_lt(off(dd_sub(a, b), want, larger), 1);
    arb_mul(want, x, y, BITS);
    ck_assert_double_lt(off(dd_mul(a, b), want, 0), 1);
    arb_div(want, x, y, BITS);
    ck_assert_double_lt(off(dd_div(a, b), want, 0), 1);
    if (a.high < 0) a = dd_neg(a);
    set(x, a);
    arb_sqrt(want, x, BITS);
    ck_assert_double_lt(off(dd_sqrt(a), want, 0), 1);
  }
}

static const double part = 0x1p15; /* 2^-85, in units of 2^-100 */

TEST(sines) {
  struct rng r = {2};
  NUMBERS(arb, x, s, c, want);
  for (int i = 0; i < TRIALS; i++) {
    struct dd a = any(&r, 30, 18);
    if (i % 4 == 0) { /* beside a multiple of pi/2 */
      arb_const_pi(x, BITS);
      arb_mul_si(x, x, rng_between(&r, -100000, 100000), BITS);
      arb_mul_2exp_si(x, x, -1);
      a = dd_sum(num_arb.get_d(x), rng_unit(&r) * 0x1p-30);
    }
    set(x, a);
    arb_sin_cos(s, c, x, BITS);
    struct dd_turn t = dd_turn(a);
    double size_s = fabs(num_arb.get_d(s)), size_c = fabs(num_arb.get_d(c));
    ck_assert_double_lt(off(t.sine, s, 1), part * size_s + 1);
    ck_assert_double_lt(off(t.cosine, c, 1), part * size_c + 1);
    bool small = fabs(a.high) < 0.78;
    arb_sub_ui(want, c, 1, BITS);
    arb_neg(want, want);
    ck_assert_double_lt(off(t.versine, want, small ? 0 : 1), part);
    arb_sub(want, x, s, BITS);
    ck_assert_double_lt(off(t.excess, want, small ? 0 : 1 + fabs(a.high)), part);
  }
}

TEST(angles) {
  struct rng r = {3};
  NUMBERS(arb, x, y, want);
  for (int i = 0; i < TRIALS; i++) {
    struct dd a = any(&r, 30, 30), b = any(&r, 30, 30);
    if (b.high < 0) b = dd_neg(b);
    set(x, a), set(y, b);
    arb_atan2(want, y, x, BITS);
    ck_assert_double_lt(off(dd_angle(b, a), want, 0), part);
  }
}
