/* Decimal strings to numbers and back, exactly or not at all.

   A printed digit string is a claim about every point of the ball.  Both ends of the ball are rounded to the wanted
   digits on their own, each exactly (a binary fraction times a power of ten is computed in balls whose precision
   grows until a tie is told from a near miss), and the string is printed only when they agree: rounding is monotone, so
   the points between them round to it too. */
#include "base/arena.h"
#include "num.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PARSE_MAX = 100000, PLAIN_MIN = -6, PLAIN_MAX = 21 };

/* Telling a tie from a near miss is given up at this precision; only exponents of millions lead there.  Numbers
   whose binary exponent has more than EXPONENT_BITS_MAX bits are not printed at all. */
#define TIE_BITS_MAX      (WORD(1) << 24)
#define EXPONENT_BITS_MAX 40

/* The exponent after e or E; saturates beyond PARSE_MAX.  false when it is malformed. */
static bool parse_exponent(long *e, const char *s, const char *end) {
  bool negative = s < end && *s == '-';
  if (s < end && (*s == '-' || *s == '+')) s++;
  if (s == end) return false;
  for (*e = 0; s < end; s++) {
    if (!char_is_digit(*s)) return false;
    if (*e <= PARSE_MAX) *e = 10 * *e + (*s - '0');
  }
  if (negative) *e = -*e;
  return true;
}

/* Its digits without the point, at most len of them, how many stand behind the point, and its exponent. */
static int split_decimal(char *digits, long *places, long *exponent, const char *s, size_t len) {
  const char *end = s + len;
  size_t n = 0;
  *exponent = *places = 0;
  for (; s < end && char_is_digit(*s); s++) digits[n++] = *s;
  if (s < end && *s == '.') {
    for (s++; s < end && char_is_digit(*s); s++, ++*places) digits[n++] = *s;
    if (*places == 0) n = 0; /* "5." is not of the form */
  }
  digits[n] = '\0';
  bool ok = n > 0;
  if (s < end) ok = ok && (*s == 'e' || *s == 'E') && parse_exponent(exponent, s + 1, end);
  return !ok ? SS_DOMAIN : labs(*exponent) > PARSE_MAX ? SS_UNABLE : SS_OK;
}

int num_parse_decimal(fmpq *q, const char *s, size_t len) {
  long places, exponent;
  if (len > PARSE_MAX) return SS_UNABLE;
  FREED char *digits = ss_malloc(len + 1);
  int status = split_decimal(digits, &places, &exponent, s, len);
  if (status == SS_OK && q) {
    NUMBERS(fmpz, ten);
    fmpz_set_ui(ten, 10);
    exponent -= places;
    fmpz_pow_ui(ten, ten, (ulong)labs(exponent));
    fmpz_set_str(fmpq_numref(q), digits, 10);
    fmpz_one(fmpq_denref(q));
    if (exponent >= 0)
      fmpz_mul(fmpq_numref(q), fmpq_numref(q), ten);
    else
      fmpz_swap(fmpq_denref(q), ten);
    fmpq_canonicalise(q);
  }
  return status;
}

/* n = v rounded to an integer with ties to even, or rounded down.  false when the ball does not tell. */
static bool round_even(fmpz_t n, const arb_t v, slong prec) {
  NUMBERS(arb, t);
  arb_set_d(t, 0.5);
  arb_add(t, v, t, prec);
  bool tie = arb_is_int(t);
  arb_floor(t, t, prec);
  bool ok = arb_get_unique_fmpz(n, t);
  if (ok && tie && fmpz_is_odd(n)) fmpz_sub_ui(n, n, 1);
  return ok;
}

/* A positive number as n * 10^(exponent - digits + 1), n of exactly `digits` digits. */
struct decimal {
  fmpz_t n;
  slong exponent;
};
static void decimal_clear(struct decimal *d) {
  fmpz_clear(d->n);
}

/* What is rounded: x, or the rational q. */
struct positive {
  const arf_struct *x;
  const fmpq *q;
};

/* Times 10^k at prec bits; of a rational exactly where that is a binary fraction, as every tie is. */
static void scale(arb_t z, const struct positive *of, slong k, slong prec) {
  NUMBERS(arb, power);
  NUMBERS(fmpz, e);
  if (of->q) {
    NUMBERS(fmpq, product);
    fmpz_ui_pow_ui(e, 10, (ulong)labs(k));
    (k < 0 ? fmpq_div_fmpz : fmpq_mul_fmpz)(product, of->q, e);
    arb_set_fmpq(z, product, prec);
    return;
  }
  fmpz_set_si(e, labs(k));
  arb_set_ui(power, 10);
  arb_pow_fmpz(power, power, e, prec);
  arb_set_arf(z, of->x);
  (k < 0 ? arb_div : arb_mul)(z, z, power, prec);
}

/* floor(log10 x) to within one. */
static slong guess_exponent(const arf_t x) {
  slong e = fmpz_get_si(ARF_EXPREF(x));
  NUMBERS(arf, m);
  arf_mul_2exp_si(m, x, -e);
  double guess = floor(((double)e + log2(arf_get_d(m, ARF_RND_DOWN))) * 0.30102999566398120);
  return (slong)guess;
}

/* One attempt at d = the number rounded to the digits, d->exponent a guess on entry.  false when prec bits do not
   decide, or when the guess had to be corrected; low and high are 10^(digits-1) and 10^digits. */
static bool try_round(struct decimal *d, const struct positive *of, slong digits, const arb_t low, const arb_t high,
                      slong prec) {
  bool decided = false;
  NUMBERS(arb, v);
  scale(v, of, digits - 1 - d->exponent, prec);
  if (arb_lt(v, low))
    d->exponent--;
  else if (arb_ge(v, high))
    d->exponent++;
  else if (arb_ge(v, low) && arb_lt(v, high))
    decided = round_even(d->n, v, prec);
  return decided;
}

/* d = the number rounded to the digits.  With growing precision the scaled number becomes exact, or far enough from a
   tie to tell. */
static bool round_decimal(struct decimal *d, const struct positive *of, slong digits) {
  NUMBERS(arb, near);
  if (of->q) arb_set_fmpq(near, of->q, 64);
  const arf_struct *x = of->q ? arb_midref(near) : of->x;
  if (fmpz_bits(ARF_EXPREF(x)) > EXPONENT_BITS_MAX) return false;
  slong first = 4 * digits + 128, last = FLINT_MAX(TIE_BITS_MAX, 2 * first);
  bool decided = false;
  NUMBERS(arb, low, high);
  NUMBERS(fmpz, carry);
  fmpz_ui_pow_ui(carry, 10, (ulong)digits - 1);
  arb_set_fmpz(low, carry);
  fmpz_mul_ui(carry, carry, 10);
  arb_set_fmpz(high, carry);
  d->exponent = guess_exponent(x);
  for (slong prec = first; !decided && prec <= last; prec *= 2) decided = try_round(d, of, digits, low, high, prec);
  if (decided && fmpz_equal(d->n, carry)) { /* 9.9995 to four digits is 10.00 */
    fmpz_divexact_ui(d->n, d->n, 10);
    d->exponent++;
  }
  return decided;
}

/* Both ends of a ball that does not contain zero, rounded; true when they agree. */
static bool round_ball(struct decimal *d, const arb_t x, slong digits) {
  OWNED(decimal) other = {.exponent = 0};
  NUMBERS(arf, end);
  const struct positive at_end = {end, NULL};
  arb_get_abs_lbound_arf(end, x, TIE_BITS_MAX);
  bool same = round_decimal(d, &at_end, digits);
  if (same && !arb_is_exact(x)) {
    arb_get_abs_ubound_arf(end, x, TIE_BITS_MAX);
    same = round_decimal(&other, &at_end, digits) && d->exponent == other.exponent && fmpz_equal(d->n, other.n);
  }
  return same;
}

static void add_zeros(struct text *out, slong n) {
  for (slong i = 0; i < n; i++) text_add_char(out, '0');
}

/* The digits s of a number with the decimal exponent e, laid out as num.h says. */
static void lay_out(struct text *out, const char *s, slong digits, slong e) {
  bool plain = e >= PLAIN_MIN && e < FLINT_MAX(digits, PLAIN_MAX);
  slong whole = plain ? e + 1 : 1; /* digits before the point; none or fewer for 0.00ddd */
  if (whole <= 0) {
    text_add(out, "0.");
    add_zeros(out, -whole);
    text_add(out, s);
  } else {
    text_add_n(out, s, (size_t)FLINT_MIN(whole, digits));
    add_zeros(out, whole - digits);
    if (whole < digits) {
      text_add_char(out, '.');
      text_add(out, s + whole);
    }
  }
  if (!plain) text_printf(out, "e%+ld", (long)e);
}

static void add_decimal(struct text *out, bool negative, const struct decimal *d, slong digits) {
  char *s = fmpz_get_str(NULL, 10, d->n);
  if (negative) text_add_char(out, '-');
  lay_out(out, s, digits, d->exponent);
  flint_free(s);
}

int num_print(struct text *out, const arb_t x, slong digits) {
  if (arb_is_zero(x)) {
    text_add(out, "0");
    return SS_OK;
  }
  if (digits < 1 || !arb_is_finite(x) || arb_contains_zero(x)) return SS_UNABLE;
  OWNED(decimal) d = {.exponent = 0};
  if (!round_ball(&d, x, digits)) return SS_UNABLE;
  add_decimal(out, arb_is_negative(x), &d, digits);
  return SS_OK;
}

bool num_has_digits(arb_srcptr x, slong n, slong digits) {
  OWNED(text) t = {0};
  bool all = true;
  for (slong i = 0; all && i < n; i++) all = num_print(&t, x + i, digits) == SS_OK;
  return all;
}

void num_print_rational(struct text *out, const fmpq_t q, slong digits) {
  if (fmpq_is_zero(q)) {
    text_add(out, "0");
    return;
  }
  OWNED(decimal) d = {.exponent = 0};
  NUMBERS(fmpq, size);
  fmpq_abs(size, q);
  round_decimal(&d, &(struct positive){NULL, size}, digits);
  add_decimal(out, fmpq_sgn(q) < 0, &d, digits);
}

void num_print_fixed(struct text *out, const fmpz_t k, slong decimals) {
  char *s = fmpz_get_str(NULL, 10, k);
  const char *digits = s + (*s == '-');
  slong len = (slong)strlen(digits), whole = len > decimals ? len - decimals : 0;
  if (*s == '-') text_add_char(out, '-');
  if (whole == 0) text_add_char(out, '0');
  text_add_n(out, digits, (size_t)whole);
  if (decimals > 0) text_add_char(out, '.');
  add_zeros(out, decimals - len);
  text_add(out, digits + whole);
  flint_free(s);
}

/* Arb writes [m +/- r], [+/- r] when no digit of the middle is known, and a bare number when it is exact. */
void num_print_ball(struct text *out, const arb_t x, slong digits) {
  char *s = arb_get_str(x, FLINT_MAX(digits, 1), 0);
  size_t len = strlen(s);
  if (s[0] != '[') {
    text_add(out, s);
  } else {
    if (s[1] == '+') text_add(out, "0 ");
    text_add_n(out, s + 1, len - 2);
  }
  flint_free(s);
}

void num_print_q(struct text *out, const fmpq_t q) {
  char *s = fmpq_get_str(NULL, 10, q);
  text_add(out, s);
  flint_free(s);
}

void num_q_set_d(fmpq_t q, double x) {
  NUMBERS(arf, a);
  arf_set_d(a, x);
  arf_get_fmpq(q, a);
}
