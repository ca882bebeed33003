/* Numbers as decimals, printed and read: against the C library's conversion and MPFR's, and by hand. */
#include "num/flint_more.h"
#include "num/num.h"
#include "rng.h"
#include "test.h"

/* What num_print must give for a double: glibc's printf converts exactly, rounding ties to even, in the same layouts
   but for integers with more places than digits and for the exponent's form. */
static void expected_text(struct text *out, double x, int digits) {
  char *e;
  const char *scientific = formatted("%.*e", digits - 1, x);
  e = strchr(scientific, 'e');
  int exponent = atoi(e + 1), limit = digits > 21 ? digits : 21;
  *e = '\0';
  if (exponent < -6 || exponent >= limit) {
    text_printf(out, "%se%c%d", scientific, exponent < 0 ? '-' : '+', abs(exponent));
  } else if (digits - 1 - exponent >= 0) {
    text_printf(out, "%.*f", digits - 1 - exponent, x);
  } else {
    for (const char *p = scientific; *p; p++)
      if (*p != '.') text_add_char(out, *p);
    for (int i = digits - 1; i < exponent; i++) text_add_char(out, '0');
  }
}

/* Doubles of every size, decimal ties (multiples of small powers of two), and neighbours of powers of ten. */
static double random_double(struct rng *r) {
  double x;
  switch (rng_between(r, 0, 4)) {
  case 0:
    x = ldexp((double)rng_between(r, 1, 9999), (int)rng_between(r, -12, 3));
    break;
  case 1:
    x = pow(10, (double)rng_between(r, -25, 25)) * (1 + (double)rng_between(r, -3, 3) * 0x1p-52);
    break;
  case 2:
    x = (double)rng_between(r, 1, 20000) / 2;
    break;
  case 3:
    x = 10 - (double)rng_between(r, 1, 80) / 64 / pow(2, (double)rng_between(r, 0, 20));
    break;
  default:
    x = ldexp((double)rng_between(r, 1, WORD(1) << 53), (int)rng_between(r, -300, 250));
  }
  return rng_next(r) % 2 ? -x : x;
}

TEST(digits_of_doubles) {
  LOCAL(text, got, want, rational);
  NUMBERS(arb, x);
  NUMBERS(fmpq, q);
  for (uint64_t seed = 1; seed <= 20000; seed++) {
    struct rng r = {seed};
    double d = random_double(&r);
    int digits = (int)rng_between(&r, 1, seed % 8 == 0 ? 60 : 8);
    arb_set_d(x, d);
    text_reset(&got);
    text_reset(&want);
    expected_text(&want, d, digits);
    int status = num_print(&got, x, digits);
    arf_get_fmpq(q, arb_midref(x));
    text_reset(&rational);
    num_print_rational(&rational, q, digits);
    if (status != SS_OK || strcmp(text_str(&got), text_str(&want)) != 0 ||
        strcmp(text_str(&rational), text_str(&want)) != 0)
      ck_abort_msg("%a to %d digits, seed %d: got %s and %s, expected %s", d, digits, (int)seed, text_str(&got),
                   text_str(&rational), text_str(&want));
  }
}

/* A ball prints exactly when its two ends do, and alike. */
TEST(digits_of_balls) {
  LOCAL(text, got, low, high);
  NUMBERS(arb, x);
  int printed = 0, refused = 0;
  for (uint64_t seed = 1; seed <= 10000; seed++) {
    struct rng r = {seed};
    double d = ldexp((double)rng_between(&r, 1, 4000), (int)rng_between(&r, -9, 0));
    slong unit = rng_between(&r, 1, 3), size = rng_between(&r, -30, 1);
    double radius = ldexp((double)unit, (int)size); /* d +- radius are exact */
    int digits = (int)rng_between(&r, 1, 6);
    if (rng_next(&r) % 2) d = -d;
    arb_set_d(x, d);
    mag_set_ui_2exp_si(arb_radref(x), (ulong)unit, size);
    text_reset(&got);
    text_reset(&low);
    text_reset(&high);
    expected_text(&low, d - radius, digits);
    expected_text(&high, d + radius, digits);
    bool agree = (d - radius) * (d + radius) > 0 && strcmp(text_str(&low), text_str(&high)) == 0;
    int status = num_print(&got, x, digits);
    bool ok =
        agree ? status == SS_OK && strcmp(text_str(&got), text_str(&low)) == 0 : status == SS_UNABLE && got.len == 0;
    if (!ok)
      ck_abort_msg("%a +- %a to %d digits, seed %d: got %s, ends are %s and %s", d, radius, digits, (int)seed,
                   text_str(&got), text_str(&low), text_str(&high));
    printed += agree;
    refused += !agree;
  }
  ck_assert(printed > 1000 && refused > 1000);
}

static void check_print(const arb_t x, slong digits, int status, const char *expected) {
  LOCAL(text, out);
  text_add(&out, "<");
  ck_assert_int_eq(num_print(&out, x, digits), status);
  ck_assert_str_eq(text_str(&out) + 1, expected);
}

TABLE(digits_of, "tests/cases/rational_digits.tsv", 3);
enum { RATIONAL, DIGITS, PRINTED }; /* its columns */

/* By hand: ties go to the even digit, a carry makes a digit more; the layout is as num.h states it.  A ball around the
   number prints alike, or does not tell the digits of a tie. */
TEST_EACH(rationals_have_all_their_digits, digits_of.n) {
  char *const *row = digits_of.row[_i];
  LOCAL(text, got, ball);
  NUMBERS(fmpq, q);
  NUMBERS(arb, x);
  ck_assert_int_eq(fmpq_set_str(q, row[RATIONAL], 10), 0);
  num_print_rational(&got, q, atoi(row[DIGITS]));
  ck_assert_msg(strcmp(text_str(&got), row[PRINTED]) == 0, "%s to %s digits: %s", row[RATIONAL], row[DIGITS],
                text_str(&got));
  arb_set_fmpq(x, q, 400);
  int status = num_print(&ball, x, atoi(row[DIGITS]));
  if (status == SS_OK || arb_is_exact(x)) ck_assert_str_eq(text_str(&ball), row[PRINTED]);
}

/* Numbers no double can be, and balls that have no digit. */
TEST(balls_without_digits) {
  NUMBERS(arb, x);
  arb_one(
      x); /* log10 2 = 0.30102999566398119521373889472449302676818988146210854131...: 2^(10^9) = 4.61...e+301029995 */
  check_print(x, 0, SS_UNABLE, "");
  arb_mul_2exp_si(x, x, 1000000000);
  check_print(x, 3, SS_OK, "4.61e+301029995");
  arb_inv(x, x, 30);
  check_print(x, 3, SS_OK, "2.17e-301029996");
  void (*const none[])(arb_t) = {arb_indeterminate, arb_zero_pm_inf, arb_zero_pm_one};
  for (size_t i = 0; i < COUNT(none); i++) {
    none[i](x);
    check_print(x, 3, SS_UNABLE, "");
  }
}

/* Many digits of pi against MPFR's own pi and own conversion; a hundred thousand must not take long. */
TEST(many_digits) {
  const slong counts[] = {50, 1000, 100000};
  for (size_t i = 0; i < COUNT(counts); i++) {
    slong digits = counts[i], bits = 10 * digits / 3 + 100;
    LOCAL(text, out);
    mpfr_exp_t exponent;
    NUMBERS(arb, x);
    MPFR_NUMBERS(bits, pi);
    mpfr_const_pi(pi, MPFR_RNDN);
    char *expected = mpfr_get_str(NULL, &exponent, 10, (size_t)digits, pi, MPFR_RNDN);
    arb_const_pi(x, bits);
    ck_assert_int_eq(num_print(&out, x, digits), SS_OK);
    ck_assert(strncmp(text_str(&out), "3.", 2) == 0 && strcmp(text_str(&out) + 2, expected + 1) == 0);
    mpfr_free_str(expected);
  }
}

/* "m +/- r" read back by Arb must hold the ball it was printed from. */
TEST(balls_for_people) {
  LOCAL(text, out, bracketed);
  NUMBERS(arb, x, back);
  for (uint64_t seed = 1; seed <= 2000; seed++) {
    struct rng r = {seed};
    rng_edge(arb_midref(x), &r, 100, 300);
    mag_zero(arb_radref(x));
    if (seed % 3) mag_set_ui_2exp_si(arb_radref(x), (ulong)rng_between(&r, 0, 5), rng_between(&r, -120, 20));
    text_reset(&out);
    text_reset(&bracketed);
    num_print_ball(&out, x, rng_between(&r, 1, 30));
    text_printf(&bracketed, "[%s]", text_str(&out));
    ck_assert_msg(arb_set_str(back, text_str(&bracketed), 2000) == 0, "%s", text_str(&out));
    ck_assert_msg(arb_contains(back, x) && strchr(text_str(&out), '[') == NULL, "%s", text_str(&out));
  }
  text_reset(&out);
  arb_zero(x);
  num_print_ball(&out, x, 10);
  ck_assert_str_eq(text_str(&out), "0");
  text_reset(&out);
  arb_zero_pm_one(x);
  num_print_ball(&out, x, 10);
  ck_assert_int_eq(strncmp(text_str(&out), "0 +/- 1", 7), 0);
  arb_indeterminate(x);
  num_print_ball(&out, x, 10);
  ck_assert(out.len > 1);
}

TABLE(decimals_of, "tests/cases/decimals.tsv", 2);
enum { DECIMAL, FRACTION }; /* its columns */

/* A decimal as a fraction in words: numerator and denominator written out by hand. */
TEST(decimals) {
  NUMBERS(fmpq, q);
  for (int i = 0; i < decimals_of.n; i++) {
    char *const *row = decimals_of.row[i];
    LOCAL(text, out);
    int status = num_parse_decimal(q, row[DECIMAL], strlen(row[DECIMAL]));
    ck_assert_msg(status == (strcmp(row[FRACTION], "none") == 0 ? SS_DOMAIN : SS_OK), "%s", row[DECIMAL]);
    if (status == SS_OK) num_print_q(&out, q);
    ck_assert_str_eq(status == SS_OK ? text_str(&out) : "none", row[FRACTION]);
    if (status != SS_OK || fmpq_is_zero(q)) continue;
    text_reset(&out);
    fmpq_neg(q, q);
    num_print_q(&out, q);
    ck_assert(*text_str(&out) == '-' && strcmp(text_str(&out) + 1, row[FRACTION]) == 0);
  }
  ck_assert_int_eq(num_parse_decimal(q, "12.5e3", 4), SS_OK); /* only the first four characters */
  ck_assert(fmpq_cmp_si(q, 12) > 0 && fmpq_cmp_si(q, 13) < 0);
  ck_assert_int_eq(num_parse_decimal(q, "1\0002", 3), SS_DOMAIN);
  ck_assert_int_eq(num_parse_decimal(q, "1e100000", 8), SS_OK);
  ck_assert_int_eq(num_parse_decimal(q, "1e-100001", 9), SS_UNABLE);
  ck_assert_int_eq(num_parse_decimal(q, "1e18446744073709551617", 22), SS_UNABLE); /* 2^64 + 1 */
}

/* A hundred thousand digits: 9...9 + 1 = 10^100000; one digit more is refused. */
TEST(long_decimals) {
  size_t n = 100000;
  FREED char *s = malloc(n + 1);
  NUMBERS(fmpq, q);
  NUMBERS(fmpz, ten);
  memset(s, '9', n + 1);
  ck_assert_int_eq(num_parse_decimal(q, s, n), SS_OK);
  fmpz_ui_pow_ui(ten, 10, n);
  fmpz_sub(ten, ten, fmpq_numref(q));
  ck_assert(fmpz_is_one(ten) && fmpz_is_one(fmpq_denref(q)));
  ck_assert_int_eq(num_parse_decimal(q, s, n + 1), SS_UNABLE);
  s[0] = '.';
  ck_assert_int_eq(num_parse_decimal(q, s, n), SS_OK);
  fmpz_ui_pow_ui(ten, 10, n - 1);
  ck_assert(fmpz_equal(ten, fmpq_denref(q)));
}
