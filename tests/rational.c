#include "rational.h"

#include <check.h>
#include <string.h>

#include "local.h"

void rational_set(fmpq *q, const char *text) {
  const bool negative = *text == '-';
  const char *size = text + negative;
  if (strchr(text, '/'))
    ck_assert_msg(fmpq_set_str(q, size, 10) == 0, "%s", text);
  else
    ck_assert_msg(num_parse_decimal(q, size, strlen(size)) == SS_OK, "%s", text);
  fmpq_canonicalise(q);
  if (negative) fmpq_neg(q, q);
}

fmpq *rationals(const char *const *text, slong n) {
  fmpq *q = _fmpq_vec_init(n);
  for (slong i = 0; i < n; i++) rational_set(q + i, text[i]);
  return q;
}

fmpq *rationals_d(const double *x, slong n) {
  fmpq *q = _fmpq_vec_init(n);
  for (slong i = 0; i < n; i++) num_q_set_d(q + i, x[i]);
  return q;
}

fmpq *rationals_of(const fmpq *x, slong n) {
  fmpq *q = _fmpq_vec_init(n);
  for (slong i = 0; i < n; i++) fmpq_set(q + i, x + i);
  return q;
}

void is_rational(const fmpq *x, const char *want) {
  NUMBERS(fmpq, w);
  rational_set(w, want);
  ck_assert_msg(fmpq_equal(x, w), "not %s", want);
}

void ball_of_decimal(arb_t x, const char *decimal, slong bits) {
  NUMBERS(mag, unit);
  ck_assert_msg(arb_set_str(x, decimal, 4000) == 0, "%s", decimal);
  arb_get_mag(unit, x);
  mag_mul_2exp_si(unit, unit, -bits);
  arb_add_error_mag(x, unit);
}

bool decimal_within(const char *decimal, arb_srcptr x, slong bits) {
  NUMBERS(arb, y);
  ball_of_decimal(y, decimal, bits);
  return arb_overlaps(x, y);
}

struct num_vec vec_new(slong n, struct num_ctx ctx) {
  struct num_vec v;
  num_vec_init(&v, n, ctx);
  return v;
}

struct num_vec vec_of(const double *x, slong n, struct num_ctx ctx) {
  struct num_vec v = vec_new(n, ctx);
  for (slong i = 0; i < n; i++) ctx.type->set_d(num_vec_at(&v, i), x[i], ctx.prec);
  return v;
}

double vec_d(const struct num_vec *v, slong i) {
  return v->ctx.type->get_d(num_vec_at(v, i));
}

double mid(arb_srcptr x) {
  return num_arb.get_d(x);
}

void vecs_clear_all(struct num_vec *const *v) {
  for (; *v; v++) num_vec_clear(*v);
}
