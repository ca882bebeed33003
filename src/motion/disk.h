/* Balls with midpoint and radius in double precision.

   For searches that look at many thousands of cells: an operation costs a few nanoseconds.  The midpoint is rounded to
   nearest as IEEE 754 says, which is the same on every machine; the radius takes in that rounding error (2^-53 of the
   result, 2^-52 is added) and is enlarged for the few roundings of its own.  Nothing here calls the mathematical
   library but sqrt and fabs, which IEEE 754 defines exactly; sines and cosines come from Arb.  NaN spreads, and every
   question about a disk is put so that NaN means "not proved". */
#ifndef STICKSLIP_DISK_H
#define STICKSLIP_DISK_H

#include <math.h>
#include <stdbool.h>

#include "num/num.h"

struct disk {
  double mid, rad;
};

/* A bound above x, which is the result of adding and multiplying at most a thousand numbers that are not negative. */
static inline double disk_up(double x) {
  return x * (1 + 0x1p-40) + 1e-290;
}

static inline struct disk disk_about(double mid, double rad) {
  return (struct disk){mid, (rad + fabs(mid) * 0x1p-52) * (1 + 0x1p-48) + 1e-290};
}

static inline struct disk disk_add(struct disk x, struct disk y) {
  return disk_about(x.mid + y.mid, x.rad + y.rad);
}

static inline struct disk disk_sub(struct disk x, struct disk y) {
  return disk_about(x.mid - y.mid, x.rad + y.rad);
}

static inline struct disk disk_mul(struct disk x, struct disk y) {
  return disk_about(x.mid * y.mid, fabs(x.mid) * y.rad + x.rad * (fabs(y.mid) + y.rad));
}

/* a x + b y and a x - b y */
static inline struct disk disk_dot(struct disk a, struct disk x, struct disk b, struct disk y) {
  return disk_add(disk_mul(a, x), disk_mul(b, y));
}

static inline struct disk disk_cross(struct disk a, struct disk x, struct disk b, struct disk y) {
  return disk_sub(disk_mul(a, x), disk_mul(b, y));
}

/* By a power of two: exact. */
static inline struct disk disk_scale(struct disk x, double power) {
  return (struct disk){x.mid * power, x.rad * fabs(power)};
}

/* x with its radius enlarged. */
static inline struct disk disk_widen(struct disk x, double by) {
  return (struct disk){x.mid, disk_up(x.rad + by)};
}

/* The largest absolute value. */
static inline double disk_mag(struct disk x) {
  return disk_up(fabs(x.mid) + x.rad);
}

/* Surely so.  A rounded sum has the sign of the sum. */
static inline bool disk_positive(struct disk x) {
  return x.mid - x.rad > 0;
}

static inline bool disk_negative(struct disk x) {
  return x.mid + x.rad < 0;
}

static inline bool disk_nonzero(struct disk x) {
  return fabs(x.mid) > x.rad;
}

static inline double disk_high(struct disk x) {
  double high = x.mid + x.rad;
  return high + fabs(high) * 0x1p-52 + 1e-290;
}

static inline double disk_low(struct disk x) {
  double low = x.mid - x.rad;
  return low - fabs(low) * 0x1p-52 - 1e-290;
}

/* All numbers from low to high. */
static inline struct disk disk_between(double low, double high) {
  double mid = 0.5 * (low + high);
  return (struct disk){mid, disk_up(fmax(high - mid, mid - low) + fabs(mid) * 0x1p-52)};
}

/* The square roots of the part of x that is not negative; zero when there is none. */
static inline struct disk disk_sqrt(struct disk x) {
  double low = disk_low(x), high = disk_high(x); /* NaN stays */
  return disk_between(sqrt(low < 0 ? 0 : low) * (1 - 0x1p-50), sqrt(high < 0 ? 0 : high) * (1 + 0x1p-50));
}

static inline struct disk disk_arb(arb_srcptr x) {
  double mid = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  return (struct disk){mid, disk_up(mag_get_d(arb_radref(x)) + fabs(mid) * 0x1p-52)};
}

#endif
