/* Doubles as decimals, the same bytes as printf's %g, ten times as fast for the sizes that rows have.

   A product by a power of ten up to 10^22 is known exactly as the rounded product and a fused remainder; of their sum
   the nearest integer holds the digits. */
#include "decimal.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { POWERS = 23 };
static const double power[POWERS] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                     1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* x 10^k to the nearest integer, ties to even, for a product below 2^52. */
static double scaled(double x, int k) {
  double p = x * power[k], rest = fma(x, power[k], -p), n = rint(p), off = p - n;
  /* p - n is a multiple of p's last bit, and the remainder at most half of that */
  if (off == 0.5 && rest > 0) return n + 1;
  if (off == -0.5 && rest < 0) return n - 1;
  return n;
}

/* Positive x below 10^15 and not below 10^-5: digits (as an integer) and the power of ten of the last one; false
   outside. */
static bool decompose(double *n, int *k, double x, int digits) {
  if (!(x >= 1e-5 && x < 1e15)) return false;
  int e = -5; /* 10^e <= x < 10^(e+1), or one off: decided below */
  while (e < 14 && x >= (e < -1 ? 1 / power[-e - 1] : power[e + 1])) e++;
  *k = digits - 1 - e;
  if (*k < 0 || *k >= POWERS) return false;
  *n = scaled(x, *k);
  if (*n < power[digits - 1] || *n > power[digits]) return false;
  if (*n == power[digits]) {
    *n = power[digits - 1];
    --*k;
  }
  return true;
}

/* n 10^-k without the zeros behind its last digit. */
static int put(char *out, bool negative, double n, int k) {
  char digit[DECIMAL_DIGITS + 8];
  unsigned long long v = (unsigned long long)n;
  int len = 0, count = 0;
  while (k > 0 && v % 10 == 0) {
    v /= 10;
    k--;
  }
  do {
    digit[count++] = (char)('0' + v % 10);
    v /= 10;
  } while (v > 0 || count <= k);
  if (negative) out[len++] = '-';
  while (count > 0) {
    if (count == k) out[len++] = '.';
    out[len++] = digit[--count];
  }
  for (; k < 0; k++) out[len++] = '0';
  out[len] = '\0';
  return len;
}

int decimal_digits(char out[DECIMAL_MAX], double x, int digits) {
  double n;
  int k;
  bool plain = fabs(x) >= 1e-4 && fabs(x) < power[digits] / 2; /* where %g has no exponent */
  if (plain && decompose(&n, &k, fabs(x), digits)) return put(out, x < 0, n, k);
  return snprintf(out, DECIMAL_MAX, "%.*g", digits, x);
}

int decimal_whole(char out[DECIMAL_MAX], double x) {
  double n;
  int k, len = 0;
  bool plain = fabs(x) >= 1e-4 && fabs(x) < 1e14;
  /* a quotient of two exact doubles is what the decimal reads as */
  if (plain && decompose(&n, &k, fabs(x), DECIMAL_DIGITS) && k >= 0 && n / power[k] == fabs(x))
    return put(out, x < 0, n, k);
  for (int digits = DECIMAL_DIGITS; digits <= 17; digits++) {
    len = snprintf(out, DECIMAL_MAX, "%.*g", digits, x);
    if (strtod(out, NULL) == x) break;
  }
  return len;
}
