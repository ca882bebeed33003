/* Number types behind one method table.

   Formulas know no numbers and numbers know no formulas; they meet in tape.h.  A number type is a table of functions
   over untyped elements; an algorithm is one loop over the table.  The types:

     num_double   IEEE binary64.  Rounded to nearest; the precision argument is ignored.
     num_mpfr     MPFR, rounded to nearest at prec bits (element precision is fixed by init).
     num_arb      Arb balls.  Every operation returns an enclosure of the exact result on the exact inputs.
     num_exact    rational functions over Q in generators that are given a meaning elsewhere (exact.h).  Exact; what is
                  not rational (sines, roots, pi, balls) is SS_UNABLE, and so is what could grow beyond
                  NUM_EXACT_PRODUCT terms; after a failure the output means nothing, it has no NaN.  get_d only tells
                  zero from the rest.

   Conventions.  Output first, then inputs, then the precision in bits.  An output may alias any input.  Elements are
   initialised by init and released by clear; init leaves the value 0.  Every arithmetic method returns status flags
   (status.h): SS_DOMAIN when the exact operation is undefined for the operands (all points of a ball), SS_UNABLE when
   it cannot be told (a ball containing zero as divisor) or the result cannot be held (overflow: no infinity or NaN is
   ever returned with SS_OK).  After a failure the output is NaN (an indeterminate ball for arb), and NaN as an operand
   gives SS_UNABLE again. */
#ifndef STICKSLIP_NUM_NUM_H
#define STICKSLIP_NUM_NUM_H

#include <stdlib.h>

#include "base/status.h"
#include "base/text.h"
#include "flint_compat.h"

/* The arithmetic every type has; ops.def lists it once for the table, the tapes and the law suite. */
typedef int (*num_unary)(void *z, const void *x, slong prec);
typedef int (*num_binary)(void *z, const void *x, const void *y, slong prec);

struct num_type {
  const char *name;
  size_t size;   /* bytes of an element */
  bool rigorous; /* elements are enclosures */
  bool zeroed;   /* zero bytes are an initialised element of value 0 */
  bool plain;    /* elements own no memory, and need no clear */

  void (*init)(void *x, slong prec);
  void (*clear)(void *x);
  void (*set)(void *z, const void *x);
  void (*swap)(void *x, void *y);

  /* Conversions.  set_q rounds once (arb: encloses); a number that would round to 0 cannot be held.  get_arb is exact
     for double and mpfr.  set_arb takes the midpoint, rounded (arb: the ball itself).  get_d rounds the value or the
     midpoint to nearest. */
  int (*set_q)(void *z, const fmpq_t q, slong prec);
  int (*set_d)(void *z, double x, slong prec);
  int (*set_arb)(void *z, const arb_t x, slong prec);
  void (*get_arb)(arb_t z, const void *x);
  double (*get_d)(const void *x);

#define NUM_UNARY(name)  num_unary name;
#define NUM_BINARY(name) num_binary name;
#include "ops.def"

  int (*sin_cos)(void *s, void *c, const void *x, slong prec); /* s and c distinct */
  int (*pow_si)(void *z, const void *x, slong n, slong prec);  /* 0^0 = 1; negative n of zero is SS_DOMAIN */
  int (*pi)(void *z, slong prec);
#define NUM_EXP_BITS 29 /* exp is SS_UNABLE, in every type, where its argument is 2^29 or more in size */

  /* Comparisons of the represented values; for balls TRUTH_TRUE and TRUTH_FALSE are proofs.  NaN: TRUTH_UNKNOWN. */
  truth (*is_zero)(const void *x);
  truth (*lt)(const void *x, const void *y);
};

extern const struct num_type num_double, num_mpfr, num_arb, num_exact;
/* Whether a ball is positive: at all of its points, at none. */
truth num_ball_positive(const arb_t x);

/* A number type with a precision in bits (double: 53). */
struct num_ctx {
  const struct num_type *type;
  slong prec;
};

struct num_ctx num_ctx_double(void);
struct num_ctx num_ctx_mpfr(slong prec);
struct num_ctx num_ctx_arb(slong prec);
struct num_ctx num_ctx_exact(void);

/* An array of elements with the context they were made in. */
struct num_vec {
  struct num_ctx ctx;
  slong len;
  char *data;
};

void num_vec_init(struct num_vec *v, slong len, struct num_ctx ctx); /* zeros */
void num_vec_clear(struct num_vec *v);
/* The element; aborts when i is out of range.  Here, since every access to a number goes through it. */
static inline void *num_vec_at(const struct num_vec *v, slong i) {
  if (i < 0 || i >= v->len) abort();
  return v->data + (size_t)i * v->ctx.type->size;
}
void num_vec_set(struct num_vec *z, const struct num_vec *x); /* same length, same type */
/* Whether two numbers of one type are equal; balls, whether their midpoints and radii are. */
bool num_same(const struct num_type *t, const void *x, const void *y);

/* Dense matrices as vectors in row-major order.  mul: z = x y with x m by n and y n by p; z may alias x or y.
   solve: a x = b for b n by p by Gaussian elimination with partial pivoting by magnitude (get_d of abs; for balls a
   pivot must exclude zero); x may alias b.  SS_DOMAIN when a is exactly singular, SS_UNABLE when no pivot can be told
   from zero.  det likewise, but an exactly singular matrix has the determinant 0. */
int num_mat_mul(struct num_vec *z, const struct num_vec *x, const struct num_vec *y, slong m, slong n, slong p);
int num_mat_solve(struct num_vec *x, const struct num_vec *a, const struct num_vec *b, slong n, slong p);
int num_mat_det(void *z, const struct num_vec *a, slong n);

/* The real positive roots of the polynomial with the given coefficients (ascending), counted with no multiplicity:
   z becomes the k-th smallest (k >= 1) or the |k|-th largest (k <= -1).  Isolated and refined in balls for every type
   and rounded once.  SS_DOMAIN when there are fewer, SS_UNABLE when roots cannot be separated within 20 times the
   working precision. */
int num_poly_root(void *z, const struct num_vec *coeffs, slong k);

/* An exact rational from a decimal such as 12, 0.8, .5, 1e-12 or 2.5E+3 (no sign), of any length.
   SS_DOMAIN when it is not of that form, SS_UNABLE when it has over 100000 characters or an exponent beyond 100000.
   q may be NULL, where the status alone is wanted. */
int num_parse_decimal(fmpq *q, const char *s, size_t len);

/* Appends x to `digits` significant decimal digits, rounded to nearest with ties to even, only if every point of the
   ball rounds to the same string; otherwise SS_UNABLE and nothing is appended.  Plain notation when the decimal
   exponent lies in [-6, max(digits, 21)), else d.ddde-N / d.ddde+N.  Trailing zeros are kept; exact zero is "0". */
int num_print(struct text *out, const arb_t x, slong digits);
/* Whether each of n numbers has its digits so. */
bool num_has_digits(arb_srcptr x, slong n, slong digits);
/* The same of an exact number, which always has its digits, a tie too; digits at least 1. */
void num_print_rational(struct text *out, const fmpq_t q, slong digits);
/* The bits that hold so many decimal digits. */
static inline slong num_bits(slong digits) {
  return (slong)((double)digits * 3.33);
}
/* The ball in a form for people, "1.2345 +/- 3.1e-40", with at most `digits` digits of the midpoint; any ball. */
void num_print_ball(struct text *out, const arb_t x, slong digits);
/* k / 10^decimals in plain notation. */
void num_print_fixed(struct text *out, const fmpz_t k, slong decimals);
/* An exact rational as p or p/q. */
void num_print_q(struct text *out, const fmpq_t q);
/* q = x exactly; x is finite. */
void num_q_set_d(fmpq_t q, double x);

#endif
