/* Enclosed numbers. */
#include <math.h>

#include "library.h"

static bool is_there(const struct ss_number *x) {
  return x && (x->ball || x->exact);
}

static int print(struct text *t, const struct ss_number *x, slong digits) {
  if (!x->exact) return num_print(t, x->ball, digits);
  num_print_rational(t, x->exact, digits);
  return SS_OK;
}

int ss_number_text(char **out, const ss_number *x, size_t digits) {
  if (!out) return library_argument(__func__, "no place for the text");
  *out = NULL;
  if (!is_there(x)) return library_argument(__func__, "no number");
  int status = library_digits(__func__, digits, LIBRARY_DIGITS);
  if (status) return status;
  OWNED(text) t = {0};
  status = print(&t, x, (slong)digits);
  if (status == SS_OK)
    *out = library_take(&t);
  else
    library_fail(status, "%s: %zu digits are not known; ss_number_digits says how many are", __func__, digits);
  return status;
}

size_t ss_number_digits(const ss_number *x) {
  if (!is_there(x)) return 0;
  if (x->exact || arb_is_exact(x->ball)) return LIBRARY_DIGITS;
  double most = (double)arb_rel_accuracy_bits(x->ball) * 0.30103 + 1;
  slong n = most < 0 ? 0 : most > LIBRARY_DIGITS ? LIBRARY_DIGITS : (slong)most;
  OWNED(text) t = {0};
  while (n > 0 && num_print(&t, x->ball, n) != SS_OK) n--;
  return (size_t)n;
}

double ss_number_double(const ss_number *x) {
  if (!is_there(x)) return NAN;
  if (!x->exact) return num_arb.get_d(x->ball);
  MPFR_NUMBERS(53, z);
  fmpq_get_mpfr(z, x->exact, MPFR_RNDN);
  return mpfr_get_d(z, MPFR_RNDN);
}

int ss_number_mpfr(mpfr_t out, const ss_number *x) {
  if (!out) return library_argument(__func__, "no place for the number");
  if (!is_there(x)) return library_argument(__func__, "no number");
  if (x->exact)
    fmpq_get_mpfr(out, x->exact, MPFR_RNDN);
  else
    arf_get_mpfr(out, arb_midref(x->ball), MPFR_RNDN);
  return SS_OK;
}

double ss_number_radius(const ss_number *x) {
  if (!is_there(x)) return INFINITY;
  return x->exact ? 0 : mag_get_d(arb_radref(x->ball));
}
