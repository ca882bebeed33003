/* Formulas over any number type (num.h), written as nested calls: calc_add(c, x, calc_mul(c, y, z)).

   Every operation gives a new element and ORs its status (SS_OK, SS_DOMAIN, SS_UNABLE) into the calc, so that the
   status is looked at once, at the end.  Elements live until the calc is released to an earlier mark or cleared, its
   vectors until it is cleared; an operation never changes its operands.  Operands may have another precision (mpfr)
   than the calc; results have that of the calc.  A calc belongs to one thread. */
#ifndef STICKSLIP_CALC_H
#define STICKSLIP_CALC_H

#include <stdbool.h>

#include "num.h"

/* An element of the calc's number type: one of its own, or one that the caller keeps alive. */
typedef const void *val;

struct calc {
  struct num_ctx ctx;
  int status;
  slong used, made, cap; /* elements in use, initialised ones, chunks */
  size_t stride;         /* from element to element: an mpfr number has its limbs behind it */
  char **pool;           /* chunks of CALC_CHUNK elements, each initialised when it is first used */
  struct num_vec *vec;   /* those of calc_vec */
  size_t n_vecs, cap_vecs;
  /* Exact algebra: what rewrites a result by the relations of a field; where it is set, no operation is begun once one
     has failed. */
  int (*reduce)(void *z, const void *field);
  const void *field;
};
struct calc calc_begin(struct num_ctx ctx);
void calc_clear(struct calc *c);
/* n zeros in the calc's context. */
struct num_vec calc_vec(struct calc *c, slong n);
/* n elements, or doubles, in the calc's context. */
struct num_vec calc_vec_of(struct calc *c, const val *x, slong n);
struct num_vec calc_vec_d(struct calc *c, const double *x, slong n);
slong calc_mark(const struct calc *c);
void calc_release(struct calc *c, slong mark);
void *calc_new(struct calc *c);
val calc_d(struct calc *c, double x);
val calc_q(struct calc *c, const fmpq *x);
val calc_two_to(struct calc *c, slong n);
val calc_pi(struct calc *c);
val calc_neg(struct calc *c, val x);
val calc_abs(struct calc *c, val x);
val calc_sqrt(struct calc *c, val x);
val calc_stumpff(struct calc *c, val x); /* (x - sin x)/x^3 */
val calc_add(struct calc *c, val x, val y);
val calc_sub(struct calc *c, val x, val y);
val calc_mul(struct calc *c, val x, val y);
val calc_div(struct calc *c, val x, val y);
val calc_atan2(struct calc *c, val y, val x);
val calc_dot(struct calc *c, val a, val x, val b, val y); /* a x + b y */
/* start + a x + b y, or start + a x - b y; start may be NULL for 0. */
val calc_dot_from(struct calc *c, val start, val a, val x, bool minus, val b, val y);
void calc_store(const struct calc *c, void *z, val x); /* z = x */
val calc_round(struct calc *c, val x);                 /* to the calc's precision */
void calc_sin_cos(struct calc *c, val *sine, val *cosine, val x);
/* sin x and 1 - cos x, from the half angle: neither loses digits near 0. */
void calc_sin_versine(struct calc *c, val *sine, val *versine, val x);
bool calc_lt(const struct calc *c, val x, val y); /* surely */
val calc_div_ui(struct calc *c, val x, ulong n);
val calc_middle(struct calc *c, val x); /* of a ball, as an exact one; else x */
/* About log2 |x|, for a ball of its largest point: |x| < 2^(e+1), and 2^(e-2) <= |x|; CALC_TINY of zero, -CALC_TINY of
   what is not finite. */
enum { CALC_TINY = -(1 << 28) };
slong calc_exponent(const struct calc *c, val x);
val calc_within(struct calc *c, val x, val bound); /* in balls: every point within |bound| of x; else x */

#endif
