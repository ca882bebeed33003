/* Numbers of twice the precision: unrounded sums of two doubles, high + low with |low| at most half a unit of high.

   After Dekker and Knuth.  One operation errs by a few 2^-104 of the larger of its operands and its result.
   Straight-line code of +, -, *, / and sqrt alone, for scalars and for lanes of vectors; infinite or NaN where a
   product leaves about 1e-280 to 1e300, which the caller asks for. */
#ifndef STICKSLIP_DOUBLE_DOUBLE_H
#define STICKSLIP_DOUBLE_DOUBLE_H

#include <math.h>
#include <stdbool.h>

#include "sincos.h"

struct dd {
  double high, low;
};

SINCOS_INLINE struct dd dd_of(double x) {
  return (struct dd){x, 0};
}

/* |x| >= |y| */
SINCOS_INLINE struct dd dd_fast_sum(double x, double y) {
  double s = x + y;
  return (struct dd){s, y - (s - x)};
}

SINCOS_INLINE struct dd dd_sum(double x, double y) {
  double s = x + y, of_y = s - x;
  return (struct dd){s, (x - (s - of_y)) + (y - of_y)};
}

/* x y - fl(x y) for x, y far from overflow and underflow, by Veltkamp's and Dekker's splitting. */
SINCOS_INLINE double product_rest(double x, double y) {
  const double split = 0x1p27 + 1;
  double bx = split * x, hx = bx - (bx - x), lx = x - hx, by = split * y, hy = by - (by - y), ly = y - hy;
  return ((hx * hy - x * y) + hx * ly + lx * hy) + lx * ly;
}

SINCOS_INLINE struct dd dd_neg(struct dd x) {
  return (struct dd){-x.high, -x.low};
}

SINCOS_INLINE struct dd dd_add(struct dd x, struct dd y) {
  struct dd s = dd_sum(x.high, y.high);
  return dd_fast_sum(s.high, s.low + (x.low + y.low));
}

SINCOS_INLINE struct dd dd_sub(struct dd x, struct dd y) {
  return dd_add(x, dd_neg(y));
}

SINCOS_INLINE struct dd dd_mul(struct dd x, struct dd y) {
  double p = x.high * y.high;
  return dd_fast_sum(p, product_rest(x.high, y.high) + (x.high * y.low + x.low * y.high));
}

/* By a power of two. */
SINCOS_INLINE struct dd dd_scale(struct dd x, double power) {
  return (struct dd){power * x.high, power * x.low};
}

SINCOS_INLINE struct dd dd_div(struct dd x, struct dd y) {
  double q = x.high / y.high;
  struct dd rest = dd_sub(x, dd_mul(dd_of(q), y));
  return dd_fast_sum(q, rest.high / y.high);
}

SINCOS_INLINE struct dd dd_sqrt(struct dd x) {
  double s = sqrt(x.high);
  struct dd rest = dd_sub(x, (struct dd){s * s, product_rest(s, s)});
  return dd_fast_sum(s, rest.high / (s + s));
}

/* all ones: x, all zeros: y. */
SINCOS_INLINE struct dd dd_select(uint64_t mask, struct dd x, struct dd y) {
  return (struct dd){sincos_choose(mask, x.high, y.high), sincos_choose(mask, x.low, y.low)};
}

SINCOS_INLINE struct dd dd_choose(bool first, struct dd x, struct dd y) {
  return (struct dd){first ? x.high : y.high, first ? x.low : y.low};
}

/* Sine and cosine, within 2^-85 relatively and 2^-100, for |x| <= SINCOS_REACH. */
struct dd_turn {
  struct dd sine, cosine;
  struct dd versine, excess; /* 1 - cosine and x - sine; relatively so for |x| < pi/4 */
};

/* 1/3!, 1/5!, ... and 1/4!, 1/6!, ... with alternating signs: those that need both halves. */
static const struct dd dd_sine_part[] = {{-0x1.5555555555555p-3, -0x1.5555555555555p-57},
                                         {0x1.1111111111111p-7, 0x1.1111111111111p-63},
                                         {-0x1.a01a01a01a01ap-13, -0x1.a01a01a01a01ap-73},
                                         {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},
                                         {-0x1.ae64567f544e4p-26, 0x1.c062e06d1f209p-80}};
static const struct dd dd_cosine_part[] = {{-0x1.5555555555555p-5, -0x1.5555555555555p-59},
                                           {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
                                           {-0x1.a01a01a01a01ap-16, -0x1.a01a01a01a01ap-76},
                                           {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
                                           {-0x1.1eed8eff8d898p-29, 0x1.2aec959e14c06p-83}};

SINCOS_INLINE struct dd dd_horner(const struct dd c[5], struct dd z, double tail) {
  struct dd sum = dd_add(c[4], dd_mul(z, dd_of(tail)));
  sum = dd_add(c[3], dd_mul(z, sum));
  sum = dd_add(c[2], dd_mul(z, sum));
  sum = dd_add(c[1], dd_mul(z, sum));
  return dd_add(c[0], dd_mul(z, sum));
}

SINCOS_INLINE struct dd_turn dd_turn(struct dd x) {
  const double round = 0x1.8p52;
  double shifted = x.high * 0x1.45f306dc9c883p-1 + round, k = shifted - round;
  /* pi/2 in four pieces, of which k times the first three is exact */
  struct dd r = dd_add(dd_sum(x.high, k * -0x1.921fb544p+0), dd_of(x.low));
  r = dd_add(r, dd_of(k * -0x1.0b4611a6p-34));
  r = dd_add(r, dd_of(k * -0x1.3198a2ep-69));
  r = dd_add(r, dd_of(k * -0x1.b839a252049c1p-104));

  struct dd z = dd_mul(r, r);
  double y = z.high;
  double odd_tail =
      0x1.6124613a86d09p-33 +
      y * (-0x1.ae7f3e733b81fp-41 +
           y * (0x1.952c77030ad4ap-49 +
                y * (-0x1.2f49b46814157p-57 +
                     y * (0x1.71b8ef6dcf572p-66 + y * (-0x1.761b41316381ap-75 + y * 0x1.3f3ccdd165fa9p-84)))));
  double even_tail = 0x1.93974a8c07c9dp-37 +
                     y * (-0x1.ae7f3e733b81fp-45 +
                          y * (0x1.6827863b97d97p-53 + y * (-0x1.e542ba4020225p-62 +
                                                            y * (0x1.0ce396db7f853p-70 + y * -0x1.f2cf01972f578p-80))));
  struct dd bow = dd_mul(dd_mul(r, z), dd_horner(dd_sine_part, z, odd_tail)); /* sin r - r */
  struct dd sagitta = dd_add(dd_scale(z, 0.5), dd_mul(dd_mul(z, z), dd_horner(dd_cosine_part, z, even_tail)));
  struct dd sine = dd_add(r, bow), cosine = dd_sub(dd_of(1), sagitta);

  uint64_t quadrant = sincos_bits(shifted), odd = -(quadrant & 1);
  uint64_t one = sincos_bits(1), sine_sign = (quadrant & 2) << 62, cosine_sign = ((quadrant + 1) & 2) << 62;
  struct dd_turn t;
  t.sine = dd_scale(dd_select(odd, cosine, sine), sincos_number(one ^ sine_sign));
  t.cosine = dd_scale(dd_select(odd, sine, cosine), sincos_number(one ^ cosine_sign));
  t.versine = dd_choose(k == 0, sagitta, dd_sub(dd_of(1), t.cosine));
  t.excess = dd_choose(k == 0, dd_neg(bow), dd_sub(x, t.sine));
  return t;
}

/* The angle in [0, pi] of the point (x, y), y >= 0, not both zero. */
SINCOS_INLINE struct dd dd_angle(struct dd y, struct dd x) {
  double rough = sincos_angle(y.high, x.high);
  struct dd_turn t = dd_turn(dd_of(rough));
  struct dd across = dd_sub(dd_mul(y, t.cosine), dd_mul(x, t.sine));
  struct dd along = dd_add(dd_mul(x, t.cosine), dd_mul(y, t.sine));
  return dd_fast_sum(rough, across.high / along.high);
}

#endif
