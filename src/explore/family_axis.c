/* Values on a line: one common denominator, so that a value is an integer over it and needs one rounding. */
#include "family.h"

static bool exact_in_double(const fmpz_t x) {
  return fmpz_bits(x) <= 53;
}

void dyn_axis_init(struct dyn_axis *a, int vary, const fmpq_t from, const fmpq_t to, slong n) {
  NUMBERS(fmpq, step);
  NUMBERS(fmpz, end);
  *a = (struct dyn_axis){.vary = vary, .n = n};
  if (n > 1) {
    fmpq_sub(step, to, from);
    fmpq_div_fmpz(step, step, (fmpz_set_si(end, n - 1), end));
  }
  fmpz_lcm(a->den, fmpq_denref(from), fmpq_denref(step));
  fmpz_divexact(end, a->den, fmpq_denref(from));
  fmpz_mul(a->start, fmpq_numref(from), end);
  fmpz_divexact(end, a->den, fmpq_denref(step));
  fmpz_mul(a->step, fmpq_numref(step), end);
  fmpz_mul_si(end, a->step, n - 1);
  fmpz_add(end, a->start, end);
  a->small = exact_in_double(a->start) && exact_in_double(end) && exact_in_double(a->den);
  if (a->small) {
    a->begin = fmpz_get_d(a->start);
    a->by = fmpz_get_d(a->step);
    a->over = fmpz_get_d(a->den);
  }
}

void dyn_axis_clear(struct dyn_axis *a) {
  fmpz_clear(a->start);
  fmpz_clear(a->step);
  fmpz_clear(a->den);
}

void dyn_axis_q(fmpq_t x, const struct dyn_axis *a, slong i) {
  fmpz_set(fmpq_numref(x), a->start);
  fmpz_addmul_si(fmpq_numref(x), a->step, i);
  fmpz_set(fmpq_denref(x), a->den);
  fmpq_canonicalise(x);
}

double dyn_axis_d(const struct dyn_axis *a, slong i) {
  /* a product and a sum of integers that doubles hold are exact, and their quotient is rounded once */
  if (a->small) return (a->begin + a->by * (double)i) / a->over;
  NUMBERS(fmpq, x);
  double d;
  dyn_axis_q(x, a, i);
  num_double.set_q(&d, x, 53);
  return d;
}

slong dyn_axis_usual_every(slong n) {
  enum { USUAL = 4096, SEARCHES = 128 };
  slong part = (n - 1) / SEARCHES;
  return part < 1 ? 1 : part < USUAL ? part : USUAL;
}

slong dyn_axis_stretch(slong every) {
  enum { POINTS = 1024 };
  return every < POINTS ? POINTS / every * every : every;
}
