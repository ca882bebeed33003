/* The straight-line sine and cosine of src/motion/sincos.h: proofs of their error bounds, and measurements.

   Proof.  With x = k pi/2 + r + tail the error is that of the reduction (the comment at its bound), that of the
   polynomials (their difference from the series, as a polynomial with small coefficients, enclosed on pieces of z in
   centred form) and that of rounding (each operation of the header is repeated here on an enclosure of its exact value
   with a bound of its error, piece by piece).  That the repeated operations are the header's is seen from equal bits.

   Measurements against MPFR: random arguments of every size, the doubles next to multiples of pi/2, the edges. */
#include "every.h"
#include "motion/sincos.h"
#include "num/flint_compat.h"
#include "num/flint_more.h"
#include "rng.h"
#include "test.h"

enum { BITS = 160, TERMS = 30, PIECES = 1024 };
static const double unit = 0x1p-53;

/* --- The rounding of one polynomial piece. --- */

/* A quantity: the double that the header has at the piece's middle, an enclosure of what exact arithmetic would have on
   the whole piece, and a bound of the difference between computed and exact. */
struct traced {
  double at;
  arb_t exact;
  double error;
};

static double magnitude(const arb_t x) {
  NUMBERS(arf, bound);
  arb_get_abs_ubound_arf(bound, x, 64);
  return arf_get_d(bound, ARF_RND_CEIL);
}

/* Half a unit in the last place of anything up to size. */
static double rounding(double size) {
  int e;
  frexp(size * (1 + 1e-12), &e);
  return ldexp(1, e - 54);
}

static const double slack = 1 + 1e-12; /* for the few operations on error bounds themselves */

static void traced_set(struct traced *z, double at, double low, double high) {
  NUMBERS(arb, end);
  arb_init(z->exact);
  z->at = at;
  z->error = 0;
  arb_set_d(z->exact, low);
  arb_set_d(end, high);
  arb_union(z->exact, z->exact, end, BITS);
}

static void traced_clear(struct traced *z) {
  arb_clear(z->exact);
}

static void traced_add(struct traced *z, const struct traced *x, const struct traced *y) {
  double error = x->error + y->error;
  z->at = x->at + y->at;
  arb_add(z->exact, x->exact, y->exact, BITS);
  z->error = (error + rounding(magnitude(z->exact) + error)) * slack;
}

static void traced_mul(struct traced *z, const struct traced *x, const struct traced *y) {
  double error = (x->error * magnitude(y->exact) + y->error * magnitude(x->exact) + x->error * y->error) * slack;
  z->at = x->at * y->at;
  arb_mul(z->exact, x->exact, y->exact, BITS);
  z->error = (error + rounding(magnitude(z->exact) + error)) * slack;
}

static void traced_scale(struct traced *z, double power_of_two) {
  NUMBERS(arb, factor);
  arb_set_d(factor, power_of_two);
  z->at *= power_of_two;
  arb_mul(z->exact, z->exact, factor, BITS);
  z->error *= fabs(power_of_two);
}

static const double sine_part[] = {-0x1.5555555555555p-3, 0x1.1111111111067p-7,   -0x1.a01a019ffdba2p-13,
                                   0x1.71de3a32a93f8p-19, -0x1.ae642ad5e63d4p-26, 0x1.6108b3a86cfc9p-33,
                                   -0x1.9f70e4a638736p-41};
static const double cosine_part[] = {0x1.5555555555555p-5,  -0x1.6c16c16c16664p-10, 0x1.a01a019ec32bdp-16,
                                     -0x1.27e4f9898328p-22, 0x1.1eeaefa8f1c23p-29,  -0x1.9034073fa6881p-37};
enum { SINE_PART = COUNT(sine_part), COSINE_PART = COUNT(cosine_part) };

static void traced_polynomial(struct traced *p, const double *coefficient, int n, const struct traced *z) {
  struct traced c;
  traced_set(p, coefficient[n - 1], coefficient[n - 1], coefficient[n - 1]);
  for (int i = n - 2; i >= 0; i--) {
    traced_set(&c, coefficient[i], coefficient[i], coefficient[i]);
    traced_mul(p, z, p);
    traced_add(p, &c, p);
    traced_clear(&c);
  }
}

enum { R, TAIL, Z, BOW, SINE, COSINE, N_TRACED };

static void traced_copy(struct traced *z, const struct traced *x) {
  z->at = x->at;
  z->error = x->error;
  arb_set(z->exact, x->exact);
}

/* The parts of 1 - cos, and the cosine.  high = 1 - half loses what (1 - high) - half recovers without a rounding, 1 -
   high being exact for high in [1/2, 1]: only its sum with the small part and the last sum round. */
static void trace_cosine(struct traced q[N_TRACED]) {
  OWNED(traced) half, small, turn, sum;
  traced_polynomial(&small, cosine_part, COSINE_PART, &q[Z]);
  traced_set(&half, 0, 0, 0);
  traced_set(&turn, 0, 0, 0);
  traced_set(&sum, 1, 1, 1);
  traced_mul(&half, &q[Z], &q[Z]);
  traced_mul(&small, &half, &small);
  traced_mul(&turn, &q[R], &q[TAIL]);
  traced_scale(&turn, -1);
  traced_add(&small, &small, &turn);
  traced_copy(&half, &q[Z]);
  traced_scale(&half, 0.5);

  double high = 1 - half.at, lost = (1 - high) - half.at;
  double flat = small.error + rounding(magnitude(small.exact) + small.error + unit);
  q[COSINE].at = high + (lost + small.at);
  arb_sub(sum.exact, sum.exact, half.exact, BITS);
  arb_add(q[COSINE].exact, sum.exact, small.exact, BITS);
  q[COSINE].error = (half.error + flat + rounding(magnitude(q[COSINE].exact) + half.error + flat)) * slack;
}

/* The header's operations for r in [low, high]; tail may be anything up to half a unit in r's last place. */
static void trace(struct traced q[N_TRACED], double low, double high) {
  OWNED(traced) p;
  double mid = low + 0.5 * (high - low), most = rounding(high);
  traced_set(&q[R], mid, low, high);
  traced_set(&q[TAIL], 0, -most, most);
  for (int i = Z; i < N_TRACED; i++) traced_set(&q[i], 0, 0, 0);
  traced_mul(&q[Z], &q[R], &q[R]);

  traced_polynomial(&p, sine_part, SINE_PART, &q[Z]);
  traced_mul(&q[BOW], &q[R], &q[Z]);
  traced_mul(&q[BOW], &q[BOW], &p);
  traced_add(&q[SINE], &q[BOW], &q[TAIL]);
  traced_add(&q[SINE], &q[R], &q[SINE]);
  trace_cosine(q);
}

/* --- The truncation. --- */

/* A bound over 0 <= z <= most of |z^first (P(z) - series(z))|, P the part and the series that of (sin r - r)/r^3 (first
   1, odd 1) or (cos r - 1 + r^2/2)/r^4 (first 2, odd 0) by z = r^2: (-1)^(i + first) z^i / (2 (i + first) + odd)!. */
static double truncation(const double *part, int n, int first, int odd, double most) {
  arb_poly_t difference;
  NUMBERS(arb, z, mid, value, slope, off);
  double worst = 0;
  arb_poly_init(difference);
  for (int i = TERMS - 1; i >= 0; i--) {
    arb_fac_ui(value, (ulong)(2 * (i + first) + odd), BITS);
    arb_inv(value, value, BITS);
    if ((i + first) % 2 == 0) arb_neg(value, value);
    arb_set_d(off, i < n ? part[i] : 0);
    arb_add(value, value, off, BITS);
    arb_poly_set_coeff_arb(difference, i, value);
  }
  arb_poly_shift_left(difference, difference, first);
  for (int k = 0; k < PIECES; k++) { /* value(mid) + slope(piece) (piece - mid) */
    arb_set_d(mid, most * (k + 0.5) / PIECES);
    arb_set(z, mid);
    mag_set_d(arb_radref(z), most / PIECES * 0.5001);
    arb_sub(off, z, mid, BITS);
    arb_poly_evaluate2(value, slope, difference, z, BITS);
    arb_mul(slope, slope, off, BITS);
    arb_poly_evaluate(value, difference, mid, BITS);
    arb_add(value, value, slope, BITS);
    worst = fmax(worst, magnitude(value));
  }
  arb_poly_clear(difference);
  return worst * slack + 0x1p-200; /* the terms that are left out: below 1/60! */
}

/* --- The bounds of sincos.h. --- */

static const double widest = 0x1.921fb54442d19p-1 * (1 + 0x1p-30); /* |r| is less */

/* The largest of each bound over all r, in units of 2^-53: relative ones. */
struct bounds {
  double sine, cosine;
};

/* The truncations for r below some limit. */
struct truncations {
  double limit, sine, cosine;
};

static struct truncations truncations_to(double r) {
  double z = r * r * slack;
  return (struct truncations){r, truncation(sine_part, SINE_PART, 1, 1, z),
                              truncation(cosine_part, COSINE_PART, 2, 0, z)};
}

static void widen(struct bounds *b, const struct truncations *cut, double low, double high) {
  struct traced q[N_TRACED];
  const double z = high * high, least = low * low, tail = rounding(high), lost = tail * z; /* tail (1 - cos r) */
  trace(q, low, high);
  double sine = q[SINE].error + high * cut->sine + lost;
  double cosine = q[COSINE].error + cut->cosine + lost + tail * tail;
  b->sine = fmax(b->sine, sine / (low * (1 - least / 6)));
  b->cosine = fmax(b->cosine, cosine / (1 - z / 2));
  for (int i = 0; i < N_TRACED; i++) traced_clear(&q[i]);
}

/* Below the last piece z is under 2^-80: sine = r and cosine = 1 but for one rounding, and the parts are their first
   coefficients. */
TEST(errors_are_proved) {
  struct bounds b = {0};
  struct truncations cut = truncations_to(widest);
  for (double high = widest; high > 0x1p-40; high *= 1 - 1.0 / 128) {
    if (high < cut.limit / 4) cut = truncations_to(high);
    widen(&b, &cut, high * (1 - 1.0 / 128), high);
  }
  ck_assert_msg(b.sine < 1.6 * unit && b.cosine < 1.7 * unit, "units: sine %g cosine %g", b.sine / unit,
                b.cosine / unit);
}

/* The operations that are bounded are those that run. */
TEST(the_proof_is_about_the_code) {
  for (double high = 0.78; high > 0x1p-30; high *= 0.97) {
    struct traced q[N_TRACED];
    double low = high * 0.98;
    trace(q, low, high);
    struct sine_cosine t = sincos_of(q[R].at);
    ck_assert(t.sine == q[SINE].at && t.cosine == q[COSINE].at);
    for (int i = 0; i < N_TRACED; i++) traced_clear(&q[i]);
  }
}

/* --- Measured. --- */

struct worst {
  double sine, cosine;
};

/* |got - want| in units of 2^-53 of want, less what the reduction may add. */
static double miss(double got, mpfr_srcptr want, double of) {
  MPFR_NUMBERS(64, d);
  mpfr_d_sub(d, got, want, MPFR_RNDA);
  double e = fabs(mpfr_get_d(d, MPFR_RNDA));
  return fmax(e - 0x1p-97, 0) / (of * unit);
}

static void measure(struct worst *w, double x) {
  struct sine_cosine t = sincos_of(x);
  MPFR_NUMBERS(300, s, c);
  mpfr_set_d(s, x, MPFR_RNDN);
  mpfr_sin_cos(s, c, s, MPFR_RNDN);
  w->sine = fmax(w->sine, miss(t.sine, s, fabs(mpfr_get_d(s, MPFR_RNDA))));
  w->cosine = fmax(w->cosine, miss(t.cosine, c, fabs(mpfr_get_d(c, MPFR_RNDA))));
}

static void check_worst(const struct worst *w) {
  ck_assert_msg(w->sine < 1.7 && w->cosine < 1.7, "sine %g, cosine %g units of 2^-53", w->sine, w->cosine);
}

TEST(random_arguments) {
  struct worst w = {0};
  struct rng r = {20};
  for (int i = 0; i < 60000 / every(4); i++) {
    double size = ldexp(1, (int)(rng_unit(&r) * 60) - 40); /* to 2^20 */
    measure(&w, (2 * rng_unit(&r) - 1) * size);
  }
  for (int i = 0; i < 60000 / every(4); i++) measure(&w, 40 * rng_unit(&r));
  check_worst(&w);
}

/* Next to k pi/2, where what is left is smallest, and next to odd multiples of pi/4, where k changes. */
TEST(worst_arguments) {
  struct worst w = {0};
  struct rng r = {21};
  MPFR_NUMBERS(200, x);
  for (int i = 1; i < 24000; i += every(3)) {
    long k = i < 12000 ? i : (long)(rng_unit(&r) * 0x1p20 * 4 / 3.15);
    mpfr_const_pi(x, MPFR_RNDN);
    mpfr_mul_si(x, x, k, MPFR_RNDN);
    mpfr_div_2ui(x, x, 2, MPFR_RNDN);
    double at = mpfr_get_d(x, MPFR_RNDN);
    measure(&w, at);
    measure(&w, -nextafter(at, 0));
    measure(&w, nextafter(at, 2 * at));
  }
  measure(&w, SINCOS_REACH);
  measure(&w, -SINCOS_REACH);
  check_worst(&w);
}

/* The angle of a point: measured, in all octants and next to the multiples of pi/8, where its parts change. */
TEST(angles) {
  double worst = 0;
  struct rng r = {22};
  MPFR_NUMBERS(200, x, y);
  for (int i = 0; i < 60000 / every(4); i++) {
    double angle = i % 2 == 0 ? 3.14159 * rng_unit(&r) : (double)(i % 18 / 2) * 0.39269908169872414;
    double size = ldexp(1, (int)(rng_unit(&r) * 40) - 20), near = i % 3 == 0 ? 0 : ldexp(rng_unit(&r) - 0.5, -(i % 50));
    double across = size * cos(angle + near), up = fabs(size * sin(angle + near));
    mpfr_set_d(x, across, MPFR_RNDN);
    mpfr_set_d(y, up, MPFR_RNDN);
    mpfr_atan2(y, y, x, MPFR_RNDN);
    if (up > 0) worst = fmax(worst, miss(sincos_angle(up, across), y, mpfr_get_d(y, MPFR_RNDA)));
  }
  ck_assert_msg(worst < 4, "%g units", worst);
  ck_assert(sincos_angle(0, 1) == 0 && sincos_angle(1, 0) == 0x1.921fb54442d18p+0 &&
            sincos_angle(0, -1) == 0x1.921fb54442d18p+1);
}

TEST(edges) {
  struct sine_cosine zero = sincos_of(0), less = sincos_of(-0.0);
  ck_assert(zero.sine == 0 && zero.cosine == 1);
  ck_assert(less.sine == 0 && less.cosine == 1);
  ck_assert(sincos_of(0x1p-1074).sine == 0x1p-1074 && sincos_of(-0x1p-600).sine == -0x1p-600);
  ck_assert(isnan(sincos_of(NAN).sine) && isnan(sincos_of(NAN).cosine) && isnan(sincos_of(INFINITY).sine));
  for (double x = 0x1p-20; x < 0x1p20; x *= 1.7) {
    struct sine_cosine t = sincos_of(x), back = sincos_of(-x);
    ck_assert(back.sine == -t.sine && back.cosine == t.cosine);
  }
}
