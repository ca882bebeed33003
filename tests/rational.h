/* Exact numbers as the tests write them, and vectors of doubles over any number type. */
#ifndef STICKSLIP_TESTS_RATIONAL_H
#define STICKSLIP_TESTS_RATIONAL_H

#include "num/num.h"

/* From a decimal or a fraction, perhaps negative; fails the test where it is neither. */
void rational_set(fmpq *q, const char *text);

/* n of them, from texts, from doubles, from others; to be cleared with _fmpq_vec_clear. */
fmpq *rationals(const char *const *text, slong n);
fmpq *rationals_d(const double *x, slong n);
fmpq *rationals_of(const fmpq *x, slong n);

/* Fails the test where x is not that number. */
void is_rational(const fmpq *x, const char *want);

/* The decimal and all within 2^-bits of its size; whether such a ball can be a number. */
void ball_of_decimal(arb_t x, const char *decimal, slong bits);
bool decimal_within(const char *decimal, arb_srcptr x, slong bits);

/* To be cleared: from doubles; zeros. */
struct num_vec vec_new(slong n, struct num_ctx ctx);
struct num_vec vec_of(const double *x, slong n, struct num_ctx ctx);

/* The i-th as a double; the middle of a ball as one. */
double vec_d(const struct num_vec *v, slong i);
double mid(arb_srcptr x);

/* vecs_clear(&v, &w, ...): each of them. */
void vecs_clear_all(struct num_vec *const *v);
#define vecs_clear(...) vecs_clear_all((struct num_vec *const[]){__VA_ARGS__, NULL})

#endif
