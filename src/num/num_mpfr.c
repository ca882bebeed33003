/* MPFR numbers behind the method table.

   Every result is correctly rounded to nearest at the precision of the element that receives it, which init fixed;
   the precision argument is the context's, and says the same.  The exponent range is MPFR's own, so overflow is rare
   but still turned into a status flag in one place (held).  Zeros have no sign: what MPFR does with -0 is undone. */
#include "num.h"

/* Reducing an argument modulo pi costs as many bits as its exponent has units: beyond this many it is refused. */
#define ARGUMENT_BITS 100000

static int held(mpfr_ptr z) {
  if (mpfr_number_p(z)) return SS_OK;
  mpfr_set_nan(z);
  return SS_UNABLE;
}

static int failed(mpfr_ptr z, int status) {
  mpfr_set_nan(z);
  return status;
}

static void m_init(void *x, slong prec) {
  mpfr_init2(x, prec);
  mpfr_set_zero(x, 1);
}

static void m_clear(void *x) {
  mpfr_clear(x);
}

static void m_set(void *z, const void *x) {
  mpfr_set(z, x, MPFR_RNDN);
}

static void m_swap(void *x, void *y) {
  mpfr_swap(x, y);
}

static int m_set_q(void *z, const fmpq_t q, slong prec) {
  (void)prec;
  fmpq_get_mpfr(z, q, MPFR_RNDN);
  return held(z);
}

static int m_set_d(void *z, double x, slong prec) {
  (void)prec;
  mpfr_set_d(z, x, MPFR_RNDN);
  return held(z);
}

static int m_set_arb(void *z, const arb_t x, slong prec) {
  (void)prec;
  if (!arb_is_finite(x)) return failed(z, SS_UNABLE);
  arf_get_mpfr(z, arb_midref(x), MPFR_RNDN);
  return held(z);
}

static void m_get_arb(arb_t z, const void *x) {
  if (!mpfr_number_p((mpfr_srcptr)x)) {
    arb_indeterminate(z);
    return;
  }
  arf_set_mpfr(arb_midref(z), x);
  mag_zero(arb_radref(z));
}

static double m_get_d(const void *x) {
  return mpfr_get_d(x, MPFR_RNDN);
}

/* SS_UNABLE from 2^bits on, in size. */
static int beyond(mpfr_srcptr x, mpfr_exp_t bits) {
  return mpfr_regular_p(x) && mpfr_get_exp(x) > bits ? SS_UNABLE : SS_OK;
}

/* Operations that are MPFR's own, each with the status for which it is refused. */
#define UNARY(op, refusal)                                                                                             \
  static int m_##op(void *z, const void *a, slong prec) {                                                              \
    mpfr_srcptr x = a;                                                                                                 \
    int refused = mpfr_nan_p(x) ? SS_OK : (refusal);                                                                   \
    (void)prec;                                                                                                        \
    if (refused) return failed(z, refused);                                                                            \
    mpfr_##op(z, x, MPFR_RNDN);                                                                                        \
    return held(z);                                                                                                    \
  }
#define BINARY(op, refusal)                                                                                            \
  static int m_##op(void *z, const void *a, const void *b, slong prec) {                                               \
    mpfr_srcptr x = a, y = b;                                                                                          \
    int refused = refusal;                                                                                             \
    (void)prec;                                                                                                        \
    if (refused) return failed(z, refused);                                                                            \
    mpfr_##op(z, x, y, MPFR_RNDN);                                                                                     \
    return held(z);                                                                                                    \
  }
UNARY(neg, SS_OK)
UNARY(abs, SS_OK)
UNARY(sqrt, mpfr_sgn(x) < 0 ? SS_DOMAIN : SS_OK)
UNARY(exp, beyond(x, NUM_EXP_BITS))
UNARY(sin, beyond(x, ARGUMENT_BITS))
UNARY(cos, beyond(x, ARGUMENT_BITS))
UNARY(cot, mpfr_zero_p(x) ? SS_DOMAIN : beyond(x, ARGUMENT_BITS))
BINARY(add, SS_OK)
BINARY(sub, SS_OK)
BINARY(mul, SS_OK)
BINARY(div, !mpfr_zero_p(y) ? SS_OK : mpfr_nan_p(x) ? SS_UNABLE : SS_DOMAIN)
BINARY(hypot, mpfr_nan_p(x) || mpfr_nan_p(y) ? SS_UNABLE : SS_OK)
#undef UNARY
#undef BINARY

/* A function of Arb's, correctly rounded: at a number other than 0 its value is transcendental, so that some precision
   separates it from every rounding boundary. */
static int rounded_by_balls(mpfr_ptr z, mpfr_srcptr x, num_unary f) {
  slong prec = mpfr_get_prec(z);
  if (mpfr_nan_p(x) || beyond(x, ARGUMENT_BITS)) return failed(z, SS_UNABLE);
  NUMBERS(arb, at, y);
  arf_set_mpfr(arb_midref(at), x);
  int s = SS_UNABLE;
  for (slong guard = 32; guard <= ARGUMENT_BITS; guard *= 4) {
    s = f(y, at, prec + guard);
    if (s != SS_OK || arb_can_round_mpfr(y, prec, MPFR_RNDN)) break;
  }
  if (s == SS_OK) arf_get_mpfr(z, arb_midref(y), MPFR_RNDN);
  return s == SS_OK ? held(z) : failed(z, s);
}

static int m_sinc(void *z, const void *x, slong prec) {
  (void)prec;
  return rounded_by_balls(z, x, num_arb.sinc);
}

static int m_stumpff(void *z, const void *x, slong prec) {
  (void)prec;
  return rounded_by_balls(z, x, num_arb.stumpff);
}

static int m_atan2(void *z, const void *y, const void *x, slong prec) {
  (void)prec;
  if (!mpfr_zero_p((mpfr_srcptr)y))
    mpfr_atan2(z, y, x, MPFR_RNDN);
  else if (mpfr_zero_p((mpfr_srcptr)x))
    return failed(z, SS_DOMAIN);
  else if (mpfr_nan_p((mpfr_srcptr)x))
    mpfr_set_nan(z);
  else if (mpfr_sgn((mpfr_srcptr)x) > 0)
    mpfr_set_zero(z, 1);
  else
    mpfr_const_pi(z, MPFR_RNDN); /* also when y is -0 */
  return held(z);
}

/* Arb's sine and cosine take a third of MPFR's time at a few hundred bits.  The middle of a ball that lies on one side
   of every rounding boundary rounds as the exact value does, so that the result is MPFR's own; false when it does
   not. */
static bool sin_cos_by_balls(mpfr_ptr s, mpfr_ptr c, mpfr_srcptr x) {
  enum { GUARD = 32 };
  slong prec_s = mpfr_get_prec(s), prec_c = mpfr_get_prec(c);
  if (!mpfr_regular_p(x)) return false;
  NUMBERS(arb, at, sine, cosine);
  arf_set_mpfr(arb_midref(at), x);
  arb_sin_cos(sine, cosine, at, FLINT_MAX(prec_s, prec_c) + GUARD);
  bool ok = arb_can_round_mpfr(sine, prec_s, MPFR_RNDN) && arb_can_round_mpfr(cosine, prec_c, MPFR_RNDN);
  if (ok) {
    arf_get_mpfr(s, arb_midref(sine), MPFR_RNDN);
    arf_get_mpfr(c, arb_midref(cosine), MPFR_RNDN);
  }
  return ok;
}

static int m_sin_cos(void *s, void *c, const void *x, slong prec) {
  (void)prec;
  if (beyond(x, ARGUMENT_BITS)) return failed(s, SS_UNABLE) | failed(c, SS_UNABLE);
  if (!sin_cos_by_balls(s, c, x)) mpfr_sin_cos(s, c, x, MPFR_RNDN);
  return held(s) | held(c);
}

static int m_pow_si(void *z, const void *x, slong n, slong prec) {
  (void)prec;
  if (mpfr_nan_p((mpfr_srcptr)x)) return failed(z, SS_UNABLE); /* MPFR has NaN^0 = 1 */
  if (mpfr_zero_p((mpfr_srcptr)x) && n < 0) return failed(z, SS_DOMAIN);
  mpfr_pow_si(z, x, n, MPFR_RNDN);
  return held(z);
}

static int m_pi(void *z, slong prec) {
  (void)prec;
  mpfr_const_pi(z, MPFR_RNDN);
  return held(z);
}

static truth m_is_zero(const void *x) {
  if (mpfr_nan_p((mpfr_srcptr)x)) return TRUTH_UNKNOWN;
  return mpfr_zero_p((mpfr_srcptr)x) ? TRUTH_TRUE : TRUTH_FALSE;
}

static truth m_lt(const void *x, const void *y) {
  if (mpfr_unordered_p(x, y)) return TRUTH_UNKNOWN;
  return mpfr_less_p(x, y) ? TRUTH_TRUE : TRUTH_FALSE;
}

const struct num_type num_mpfr = {
    .name = "mpfr",
    .size = sizeof(mpfr_t),
    .rigorous = false,
    .zeroed = false,
    .plain = false,
#define NUM_UNARY(op)  .op = m_##op,
#define NUM_BINARY(op) .op = m_##op,
#include "ops.def"
    .pow_si = m_pow_si,
#define NUM_METHOD(name) m_##name
#include "methods.def"
};
