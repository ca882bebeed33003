/* Sine and cosine in straight-line code that a compiler can vectorise: no call, no branch, nothing that depends on
   data.

   x = k pi/2 + r + tail with |r| <= pi/4 (1 + 2^-30): k is rounded by adding 1.5 * 2^52, whose last bits then hold k
   modulo 4; pi/2 is taken off in three pieces, of which k times the first two is exact.  Polynomials (minimax, leading
   coefficients rounded first) give sin and cos of r; k chooses, swaps and changes signs through bits.

   For |x| <= SINCOS_REACH sine and cosine are within 1.7 2^-53 |their value| + 2^-97 (that of the reduction: three
   roundings of at most 2^-101, and what pi/2 has beyond its pieces, 2^-102.9).  check_sincos.c proves it: truncation in
   balls, rounding operation by operation.  For other x, NaN and infinities too, the results have no meaning, and
   nothing traps: the caller asks |x| <= SINCOS_REACH.

   Only +, -, *, bit operations and, of comparisons, one: the bits of the results are the same at any width of vectors
   as long as the compiler fuses nothing (-ffp-contract=off).  Fused operations would save 15 of about 65. */
#ifndef STICKSLIP_SINCOS_H
#define STICKSLIP_SINCOS_H

#include <stdint.h>
#include <string.h>

#include "base/text.h"

#define SINCOS_INLINE static inline __attribute__((always_inline))

#define SINCOS_REACH 0x1p20

struct sine_cosine {
  double sine, cosine;
};

SINCOS_INLINE uint64_t sincos_bits(double x) {
  uint64_t b;
  memcpy(&b, &x, sizeof b);
  return b;
}

SINCOS_INLINE double sincos_number(uint64_t b) {
  double x;
  memcpy(&x, &b, sizeof x);
  return x;
}

/* all ones: x, all zeros: y. */
SINCOS_INLINE double sincos_choose(uint64_t mask, double x, double y) {
  return sincos_number((sincos_bits(x) & mask) | (sincos_bits(y) & ~mask));
}

/* (sin r - r)/r^3, and (cos r - 1 + r^2/2)/r^4, by z = r^2. */
SINCOS_INLINE double sincos_sine_part(double z) {
  return -0x1.5555555555555p-3 +
         z * (0x1.1111111111067p-7 +
              z * (-0x1.a01a019ffdba2p-13 +
                   z * (0x1.71de3a32a93f8p-19 +
                        z * (-0x1.ae642ad5e63d4p-26 + z * (0x1.6108b3a86cfc9p-33 + z * -0x1.9f70e4a638736p-41)))));
}

SINCOS_INLINE double sincos_cosine_part(double z) {
  return 0x1.5555555555555p-5 +
         z * (-0x1.6c16c16c16664p-10 +
              z * (0x1.a01a019ec32bdp-16 +
                   z * (-0x1.27e4f9898328p-22 + z * (0x1.1eeaefa8f1c23p-29 + z * -0x1.9034073fa6881p-37))));
}

SINCOS_INLINE struct sine_cosine sincos_of(double x) {
  const double round = 0x1.8p52;
  double shifted = x * 0x1.45f306dc9c883p-1 + round, k = shifted - round;
  double near = x - k * 0x1.921fb544p+0; /* exact */
  double piece = k * 0x1.0b4611a6p-34;   /* exact */
  double rough = near - piece, rest = ((near - rough) - piece) - k * 0x1.3198a2e037073p-69;
  double r = rough + rest, tail = (rough - r) + rest;

  double z = r * r;
  double bow = r * z * sincos_sine_part(z); /* sin r - r */
  double half = 0.5 * z, small = z * z * sincos_cosine_part(z) - r * tail, high = 1 - half;
  double sine = r + (bow + tail), cosine = high + (((1 - high) - half) + small);

  uint64_t quadrant = sincos_bits(shifted), odd = -(quadrant & 1);
  uint64_t sine_sign = (quadrant & 2) << 62, cosine_sign = ((quadrant + 1) & 2) << 62;
  struct sine_cosine t;
  t.sine = sincos_number(sincos_bits(sincos_choose(odd, cosine, sine)) ^ sine_sign);
  t.cosine = sincos_number(sincos_bits(sincos_choose(odd, sine, cosine)) ^ cosine_sign);
  return t;
}

/* (atan x - x)/x^3 by z = x^2, z < 0.172. */
SINCOS_INLINE double sincos_angle_part(double z) {
  return -0x1.5555555555555p-2 +
         z * (0x1.99999999982d4p-3 +
              z * (-0x1.249249238c278p-3 +
                   z * (0x1.c71c71317322cp-4 +
                        z * (-0x1.745d006143d6bp-4 +
                             z * (0x1.3b1191efcab8ep-4 +
                                  z * (-0x1.10f0a118f1698p-4 +
                                       z * (0x1.df51536cc5d54p-5 +
                                            z * (-0x1.9de7ea2105a92p-5 +
                                                 z * (0x1.3a69f27493c39p-5 + z * -0x1.2abdade2ebe2cp-6)))))))));
}

/* The angle in [0, pi] of the point (x, y), y >= 0, not both zero: within 4 u of its value, where neither is so large
   or small that sums overflow or quotients underflow.  The tangent is brought to |q| <= tan(pi/8) by turning the point
   by a multiple of pi/4, which costs one division. */
SINCOS_INLINE double sincos_angle(double y, double x) {
  const double eighth = 0x1.921fb54442d18p-1, lost = 0x1.1a62633145c07p-55; /* pi/4, and what it lacks */
  double across = x < 0 ? -x : x;
  double low = y < across ? y : across, high = y < across ? across : y;
  double wide = low > 0.41421356237309503 * high ? 1 : 0;
  double q = (low - wide * high) / (high + wide * low), z = q * q;
  double bow = q * z * sincos_angle_part(z);
  /* +-q and a multiple of pi/4: low/high, then its complement if y is high, then that to pi if x < 0 */
  double sign = y < across ? 1 : -1, steps = y < across ? wide : 2 - wide;
  sign = x < 0 ? -sign : sign;
  steps = x < 0 ? 4 - steps : steps;
  return steps * eighth + (sign * q + (sign * bow + steps * lost));
}

#endif
