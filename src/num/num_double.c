/* IEEE binary64 behind the method table.

   The basic operations and the square root are correctly rounded by the hardware, the others are the C library's.
   C's infinities and NaNs are turned into status flags at once, in one place (held), so that no algorithm above ever
   sees an infinity.  Zeros have no sign here: what C does with -0 (atan2) is undone. */
#include "num.h"

#include <math.h>

static double value(const void *x) {
  return *(const double *)x;
}

/* Stores a result; a value that cannot be held, or that came from a NaN, is SS_UNABLE. */
static int held(void *z, double v) {
  bool ok = isfinite(v);
  *(double *)z = ok ? v : NAN;
  return ok ? SS_OK : SS_UNABLE;
}

static int undefined(void *z) {
  *(double *)z = NAN;
  return SS_DOMAIN;
}

static void d_init(void *x, slong prec) {
  (void)prec;
  *(double *)x = 0;
}

static void d_clear(void *x) {
  (void)x;
}

static void d_set(void *z, const void *x) {
  *(double *)z = value(x);
}

static void d_swap(void *x, void *y) {
  double t = value(x);
  d_set(x, y);
  *(double *)y = t;
}

/* The quotient is truncated to more bits than a double has, with its last bit set when anything was lost ("rounding
   to odd").  The second rounding, to 53 bits or to fewer for a subnormal number, is then that of the exact value. */
static int d_set_q(void *z, const fmpq_t q, slong prec) {
  MPFR_NUMBERS(64, t);
  (void)prec;
  if (fmpq_get_mpfr(t, q, MPFR_RNDZ) != 0) {
    MPFR_NUMBERS(65, odd);
    mpfr_set(odd, t, MPFR_RNDN);
    if (mpfr_sgn(t) > 0)
      mpfr_nextabove(odd);
    else
      mpfr_nextbelow(odd);
    mpfr_swap(t, odd);
  }
  double v = mpfr_get_d(t, MPFR_RNDN);
  return held(z, v == 0 && !fmpq_is_zero(q) ? (double)NAN : v); /* what vanishes must not divide as a zero */
}

static int d_set_d(void *z, double x, slong prec) {
  (void)prec;
  return held(z, x);
}

static int d_set_arb(void *z, const arb_t x, slong prec) {
  (void)prec;
  return held(z, arb_is_finite(x) ? arf_get_d(arb_midref(x), ARF_RND_NEAR) : (double)NAN);
}

static void d_get_arb(arb_t z, const void *x) {
  if (isfinite(value(x)))
    arb_set_d(z, value(x));
  else
    arb_indeterminate(z);
}

static double d_get_d(const void *x) {
  return value(x);
}

/* Operations that are one expression, which is NaN where the result cannot be held; where they are undefined, after
   what tells so.  -0 + 0 is +0, and the angle of a negative number is +pi. */
#define UNARY(op, nowhere, result)                                                                                     \
  static int d_##op(void *z, const void *a, slong prec) {                                                              \
    double x = value(a);                                                                                               \
    (void)prec;                                                                                                        \
    return (nowhere) ? undefined(z) : held(z, result);                                                                 \
  }
#define BINARY(op, nowhere, result)                                                                                    \
  static int d_##op(void *z, const void *a, const void *b, slong prec) {                                               \
    double x = value(a), y = value(b);                                                                                 \
    (void)prec;                                                                                                        \
    return (nowhere) ? undefined(z) : held(z, result);                                                                 \
  }
UNARY(neg, false, -x)
UNARY(abs, false, fabs(x))
UNARY(sqrt, x < 0, sqrt(x))
UNARY(exp, false, fabs(x) < ldexp(1, NUM_EXP_BITS) ? exp(x) : (double)NAN)
UNARY(sin, false, sin(x))
UNARY(cos, false, cos(x))
UNARY(cot, x == 0, 1 / tan(x))
UNARY(sinc, false, x == 0 ? 1 : sin(x) / x)
BINARY(add, false, x + y)
BINARY(sub, false, x - y)
BINARY(mul, false, x *y)
BINARY(div, y == 0 && !isnan(x), x / y)
BINARY(atan2, x == 0 && y == 0, atan2(x + 0.0, y))
BINARY(hypot, false, isnan(x) || isnan(y) ? (double)NAN : hypot(x, y))
#undef UNARY
#undef BINARY

/* Up to 2 by the series, whose terms beyond the first are smaller than it; above, x - sin x keeps its digits. */
static int d_stumpff(void *z, const void *x, slong prec) {
  double t = value(x), sum = 0;
  (void)prec;
  if (fabs(t) > 2) return held(z, (1 - sin(t) / t) / t / t);
  if (isnan(t)) return held(z, t);
  for (int k = 23; k > 0; k -= 2) sum = (1 - t * t * sum) / ((k + 1) * (k + 2));
  return held(z, sum);
}

static int d_sin_cos(void *s, void *c, const void *x, slong prec) {
  double t = value(x);
  (void)prec;
  return held(s, sin(t)) | held(c, cos(t));
}

/* The sign comes from n itself: beyond 2^53 (double)n loses the parity, and some hundred ulps of the size. */
static int d_pow_si(void *z, const void *x, slong n, slong prec) {
  double t = value(x);
  (void)prec;
  if (t == 0 && n < 0) return undefined(z);
  if (isnan(t)) return held(z, t); /* C has NaN^0 = 1 */
  double v = pow(fabs(t), (double)n);
  return held(z, t < 0 && n % 2 != 0 ? -v : v);
}

static int d_pi(void *z, slong prec) {
  (void)prec;
  return held(z, 0x1.921fb54442d18p+1);
}

static truth d_is_zero(const void *x) {
  if (isnan(value(x))) return TRUTH_UNKNOWN;
  return value(x) == 0 ? TRUTH_TRUE : TRUTH_FALSE;
}

static truth d_lt(const void *x, const void *y) {
  if (isnan(value(x)) || isnan(value(y))) return TRUTH_UNKNOWN;
  return value(x) < value(y) ? TRUTH_TRUE : TRUTH_FALSE;
}

const struct num_type num_double = {
    .name = "double",
    .size = sizeof(double),
    .rigorous = false,
    .zeroed = true,
    .plain = true,
#define NUM_UNARY(op)  .op = d_##op,
#define NUM_BINARY(op) .op = d_##op,
#include "ops.def"
    .pow_si = d_pow_si,
#define NUM_METHOD(name) d_##name
#include "methods.def"
};
