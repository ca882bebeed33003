/* Arb's balls behind the method table.

   A result encloses the value of the operation at every point of its operands.  Where the operation is undefined at
   all points the answer is SS_DOMAIN, where at some points (a divisor that contains zero) SS_UNABLE: then it cannot be
   told whether there is a value to enclose.  No ball without finite bounds is handed on with SS_OK. */
#include "num.h"

static int held(arb_ptr z) {
  if (arb_is_finite(z)) return SS_OK;
  arb_indeterminate(z);
  return SS_UNABLE;
}

static int failed(arb_ptr z, int status) {
  arb_indeterminate(z);
  return status;
}

static void b_init(void *x, slong prec) {
  (void)prec;
  arb_init(x);
}

static void b_clear(void *x) {
  arb_clear(x);
}

static void b_set(void *z, const void *x) {
  arb_set(z, x);
}

static void b_swap(void *x, void *y) {
  arb_swap(x, y);
}

static int b_set_q(void *z, const fmpq_t q, slong prec) {
  arb_set_fmpq(z, q, prec);
  return held(z);
}

static int b_set_d(void *z, double x, slong prec) {
  (void)prec;
  arb_set_d(z, x);
  return held(z);
}

static int b_set_arb(void *z, const arb_t x, slong prec) {
  (void)prec;
  arb_set(z, x);
  return held(z);
}

static void b_get_arb(arb_t z, const void *x) {
  arb_set(z, x);
}

static double b_get_d(const void *x) {
  return arf_get_d(arb_midref((arb_srcptr)x), ARF_RND_NEAR);
}

static int b_neg(void *z, const void *x, slong prec) {
  (void)prec;
  arb_neg(z, x);
  return held(z);
}

/* Arb's own absolute value of a ball around zero keeps the negative part; here it is cut at zero. */
static int b_abs(void *z, const void *x, slong prec) {
  if (!arb_is_finite(x)) return failed(z, SS_UNABLE);
  if (arb_is_exact(x) || !arb_contains_zero(x)) {
    arb_abs(z, x);
    return SS_OK;
  }
  NUMBERS(arf, zero, top);
  arb_get_abs_ubound_arf(top, x, prec);
  arb_set_interval_arf(z, zero, top, prec);
  return held(z);
}

static int b_exp(void *z, const void *x, slong prec) {
  NUMBERS(mag, size);
  arb_get_mag(size, x);
  bool large = mag_cmp_2exp_si(size, NUM_EXP_BITS) >= 0;
  if (!arb_is_finite(x) || large) return failed(z, SS_UNABLE);
  arb_exp(z, x, prec);
  return held(z);
}

/* Operations that are Arb's own, each with the status for which it is refused.  Zero is the only pole of the cotangent
   that is a floating-point number, so the only one that a ball can be equal to.  Balls across the cut of atan2 give an
   enclosure of [-pi, pi]; balls around the origin hold a point without an angle. */
#define UNARY(op, refusal)                                                                                             \
  static int b_##op(void *z, const void *x, slong prec) {                                                              \
    int refused = !arb_is_finite(x) ? SS_UNABLE : (refusal);                                                           \
    if (refused) return failed(z, refused);                                                                            \
    arb_##op(z, x, prec);                                                                                              \
    return held(z);                                                                                                    \
  }
#define BINARY(op, refusal)                                                                                            \
  static int b_##op(void *z, const void *x, const void *y, slong prec) {                                               \
    int refused = refusal;                                                                                             \
    if (refused) return failed(z, refused);                                                                            \
    arb_##op(z, x, y, prec);                                                                                           \
    return held(z);                                                                                                    \
  }
#define BOTH(is, x, y) (is(x) && is(y))
UNARY(sqrt, arb_is_negative(x) ? SS_DOMAIN : arb_contains_negative(x) ? SS_UNABLE : SS_OK)
UNARY(sin, SS_OK)
UNARY(cos, SS_OK)
UNARY(cot, arb_is_zero(x) ? SS_DOMAIN : SS_OK)
UNARY(sinc, SS_OK)
BINARY(add, SS_OK)
BINARY(sub, SS_OK)
BINARY(mul, SS_OK)
BINARY(div, !arb_is_finite(x) ? SS_UNABLE : arb_is_zero(y) ? SS_DOMAIN : arb_contains_zero(y) ? SS_UNABLE : SS_OK)
BINARY(atan2, !BOTH(arb_is_finite, x, y)      ? SS_UNABLE
              : BOTH(arb_is_zero, x, y)       ? SS_DOMAIN
              : BOTH(arb_contains_zero, x, y) ? SS_UNABLE
                                              : SS_OK)
BINARY(hypot, BOTH(arb_is_finite, x, y) ? SS_OK : SS_UNABLE)
#undef UNARY
#undef BINARY
#undef BOTH

/* 1/3! - y/5! + y^2/7! - ... for an exact y = x^2 in [0, 4]: each term is smaller than the one before it, so that the
   first one left out bounds the rest. */
static void stumpff_series(arb_t z, const arb_t y, slong prec) {
  NUMBERS(arb, term);
  arb_one(term);
  arb_div_ui(term, term, 6, prec);
  arb_set(z, term);
  NUMBERS(mag, size);
  bool small = false;
  for (ulong k = 4; !small; k += 2) {
    arb_mul(term, term, y, prec);
    arb_div_ui(term, term, k * (k + 1), prec);
    arb_neg(term, term);
    arb_get_mag(size, term);
    small = mag_cmp_2exp_si(size, -prec - 4) < 0;
    if (small)
      arb_add_error_mag(z, size);
    else
      arb_add(z, z, term, prec);
  }
}

/* stumpff x is the integral of (1 - s)^2 cos(x s) / 2 for s from 0 to 1, so that its slope is at most |x|/60, and
   1/24. */
static void stumpff_near_zero(arb_t z, const arb_t x, slong prec) {
  NUMBERS(mag, slope, most);
  NUMBERS(arb, y);
  arb_get_mag(slope, x);
  mag_div_ui(slope, slope, 60);
  mag_set_ui(most, 24);
  mag_inv(most, most);
  mag_min(slope, slope, most);
  mag_mul(slope, slope, arb_radref(x));
  arf_mul(arb_midref(y), arb_midref(x), arb_midref(x), ARF_PREC_EXACT, ARF_RND_DOWN);
  stumpff_series(z, y, prec + 10);
  arb_add_error_mag(z, slope);
  arb_set_round(z, z, prec);
}

/* Beyond 2 the quotient loses nothing.  Balls that reach across are wide: all of (0, 1/6] holds any value. */
static int b_stumpff(void *z, const void *x, slong prec) {
  if (!arb_is_finite(x)) return failed(z, SS_UNABLE);
  NUMBERS(arb, two, size);
  arb_set_ui(two, 2);
  b_abs(size, x, prec);
  if (arb_le(size, two)) {
    stumpff_near_zero(z, x, prec);
  } else if (arb_gt(size, two)) {
    arb_sinc(size, x, prec + 10);
    arb_sub_ui(size, size, 1, prec + 10);
    arb_neg(size, size);
    arb_div(size, size, x, prec + 10);
    arb_div(z, size, x, prec);
  } else {
    arb_set_d(two, 0.125);
    mag_set_d(arb_radref(two), 0.125);
    arb_set(z, two);
  }
  return held(z);
}

static int b_sin_cos(void *s, void *c, const void *x, slong prec) {
  if (!arb_is_finite(x)) return failed(s, SS_UNABLE) | failed(c, SS_UNABLE);
  arb_sin_cos(s, c, x, prec);
  return held(s) | held(c);
}

static int b_pow_si(void *z, const void *x, slong n, slong prec) {
  if (!arb_is_finite(x)) return failed(z, SS_UNABLE);
  if (n < 0 && arb_is_zero(x)) return failed(z, SS_DOMAIN);
  if (n < 0 && arb_contains_zero(x)) return failed(z, SS_UNABLE);
  NUMBERS(fmpz, e);
  fmpz_set_si(e, n);
  arb_pow_fmpz(z, x, e, prec);
  return held(z);
}

static int b_pi(void *z, slong prec) {
  arb_const_pi(z, prec);
  return SS_OK;
}

static truth b_is_zero(const void *x) {
  if (arb_is_zero(x)) return TRUTH_TRUE;
  return arb_contains_zero(x) ? TRUTH_UNKNOWN : TRUTH_FALSE;
}

truth num_ball_positive(const arb_t x) {
  return arb_is_positive(x) ? TRUTH_TRUE : arb_is_nonpositive(x) ? TRUTH_FALSE : TRUTH_UNKNOWN;
}

static truth b_lt(const void *x, const void *y) {
  if (arb_is_zero(x)) return num_ball_positive(y);
  if (arb_is_zero(y)) return arb_is_negative(x) ? TRUTH_TRUE : arb_is_nonnegative(x) ? TRUTH_FALSE : TRUTH_UNKNOWN;
  if (arb_lt(x, y)) return TRUTH_TRUE;
  return arb_ge(x, y) ? TRUTH_FALSE : TRUTH_UNKNOWN;
}

const struct num_type num_arb = {
    .name = "arb",
    .size = sizeof(arb_struct),
    .rigorous = true,
    .zeroed = true,
    .plain = false,
#define NUM_UNARY(op)  .op = b_##op,
#define NUM_BINARY(op) .op = b_##op,
#include "ops.def"
    .pow_si = b_pow_si,
#define NUM_METHOD(name) b_##name
#include "methods.def"
};
