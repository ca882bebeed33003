/* Dual balls: the value by Arb's operations, derivatives by the chain rule.

   Most directions of most elements are exact zeros, which cost next to nothing.  A value of which the type says that it
   fails makes the whole element indeterminate; a derivative without finite bounds (the square root at 0) does so
   too. */
#include "dual.h"

enum { PARTS = 1 + N_DIRECTIONS }; /* balls of an element, the value first */

static struct dual *at(void *x) {
  return x;
}

static const struct dual *in(const void *x) {
  return x;
}

static void d_init(void *x, slong prec) {
  (void)prec;
  for (int i = 0; i < PARTS; i++) arb_init((arb_ptr)x + i);
}

static void d_clear(void *x) {
  for (int i = 0; i < PARTS; i++) arb_clear((arb_ptr)x + i);
}

static void d_set(void *z, const void *x) {
  _arb_vec_set(z, x, PARTS);
}

static void d_swap(void *x, void *y) {
  struct dual t = *at(x);
  *at(x) = *at(y);
  *at(y) = t;
}

static int d_set_q(void *z, const fmpq_t q, slong prec) {
  _arb_vec_zero(at(z)->d, N_DIRECTIONS);
  return num_arb.set_q(&at(z)->v, q, prec);
}

static int d_set_d(void *z, double x, slong prec) {
  _arb_vec_zero(at(z)->d, N_DIRECTIONS);
  return num_arb.set_d(&at(z)->v, x, prec);
}

static int d_set_arb(void *z, const arb_t x, slong prec) {
  _arb_vec_zero(at(z)->d, N_DIRECTIONS);
  return num_arb.set_arb(&at(z)->v, x, prec);
}

static void d_get_arb(arb_t z, const void *x) {
  arb_set(z, &in(x)->v);
}

static double d_get_d(const void *x) {
  return num_arb.get_d(&in(x)->v);
}

/* The status of a finished element. */
static int held(struct dual *z, int status) {
  if (!status && !_arb_vec_is_finite((arb_srcptr)z, PARTS)) status = SS_UNABLE;
  for (int i = 0; i < PARTS && status; i++) arb_indeterminate((arb_ptr)z + i);
  return status;
}

/* z' = slope x', for a value that stands in z already. */
static int chain(struct dual *z, const struct dual *x, const arb_t slope, int status, slong prec) {
  for (int i = 0; i < N_DIRECTIONS && !status; i++)
    if (!arb_is_zero(&x->d[i]))
      arb_mul(&z->d[i], &x->d[i], slope, prec);
    else
      arb_zero(&z->d[i]);
  return held(z, status);
}

/* z' = by_x x' + by_y y', for a value that stands in z already; the slopes are none of the operands. */
static int chain2(struct dual *z, const struct dual *x, const struct dual *y, const arb_t by_x, const arb_t by_y,
                  int status, slong prec) {
  NUMBERS(arb, part);
  for (int i = 0; i < N_DIRECTIONS && !status; i++) {
    bool of_y = !arb_is_zero(&y->d[i]);
    if (of_y) arb_mul(part, &y->d[i], by_y, prec);
    if (arb_is_zero(&x->d[i]))
      arb_zero(&z->d[i]);
    else
      arb_mul(&z->d[i], &x->d[i], by_x, prec);
    if (of_y) arb_add(&z->d[i], &z->d[i], part, prec);
  }
  return held(z, status);
}

static int d_neg(void *z, const void *x, slong prec) {
  (void)prec;
  _arb_vec_neg(z, x, PARTS);
  return held(z, SS_OK);
}

static int d_sqrt(void *z, const void *x, slong prec) {
  NUMBERS(arb, slope);
  int status = num_arb.sqrt(&at(z)->v, &in(x)->v, prec);
  if (!status) {
    arb_mul_2exp_si(slope, &at(z)->v, 1);
    arb_inv(slope, slope, prec);
  }
  return chain(z, x, slope, status, prec);
}

static int d_sin_cos(void *s, void *c, const void *x, slong prec) {
  NUMBERS(arb, minus);
  struct dual *sine = s, *cosine = c;
  int status = num_arb.sin_cos(&sine->v, &cosine->v, &in(x)->v, prec);
  arb_neg(minus, &sine->v);
  if (x == s) { /* the cosine first: x' is still needed */
    status = chain(cosine, x, minus, status, prec);
    status |= chain(sine, x, &cosine->v, status, prec);
  } else {
    int first = chain(sine, x, &cosine->v, status, prec);
    status = first | chain(cosine, x, minus, first, prec);
  }
  return status;
}

static int d_add(void *z, const void *x, const void *y, slong prec) {
  _arb_vec_add(z, x, y, PARTS, prec);
  return held(z, SS_OK);
}

static int d_sub(void *z, const void *x, const void *y, slong prec) {
  _arb_vec_sub(z, x, y, PARTS, prec);
  return held(z, SS_OK);
}

static int d_mul(void *z, const void *x, const void *y, slong prec) {
  NUMBERS(arb, by_x, by_y);
  arb_set(by_x, &in(y)->v);
  arb_set(by_y, &in(x)->v);
  int status = num_arb.mul(&at(z)->v, by_y, by_x, prec);
  return chain2(z, x, y, by_x, by_y, status, prec);
}

/* (x' - (x/y) y')/y */
static int d_div(void *z, const void *x, const void *y, slong prec) {
  NUMBERS(arb, by_x, by_y);
  arb_set(by_x, &in(y)->v);
  int status = num_arb.div(&at(z)->v, &in(x)->v, by_x, prec);
  if (!status) {
    arb_inv(by_x, by_x, prec);
    arb_mul(by_y, &at(z)->v, by_x, prec);
    arb_neg(by_y, by_y);
  }
  return chain2(z, x, y, by_x, by_y, status, prec);
}

/* (x y' - y x')/(x^2 + y^2) */
static int d_atan2(void *z, const void *y, const void *x, slong prec) {
  NUMBERS(arb, square, by_y, by_x);
  arb_set(by_y, &in(x)->v);
  arb_neg(by_x, &in(y)->v);
  arb_mul(square, by_y, by_y, prec);
  arb_addmul(square, by_x, by_x, prec);
  int status = num_arb.atan2(&at(z)->v, &in(y)->v, by_y, prec);
  if (!status) {
    arb_div(by_y, by_y, square, prec);
    arb_div(by_x, by_x, square, prec);
  }
  return chain2(z, y, x, by_y, by_x, status, prec);
}

static int d_pi(void *z, slong prec) {
  _arb_vec_zero(at(z)->d, N_DIRECTIONS);
  return num_arb.pi(&at(z)->v, prec);
}

static truth d_is_zero(const void *x) {
  return num_arb.is_zero(&in(x)->v);
}

static truth d_lt(const void *x, const void *y) {
  return num_arb.lt(&in(x)->v, &in(y)->v);
}

const struct num_type num_dual = {
    .name = "dual",
    .size = sizeof(struct dual),
    .rigorous = true,
    .neg = d_neg,
    .sqrt = d_sqrt,
    .add = d_add,
    .sub = d_sub,
    .mul = d_mul,
    .div = d_div,
    .atan2 = d_atan2,
#define NUM_METHOD(name) d_##name
#include "num/methods.def"
};

struct num_ctx dual_ctx(slong prec) {
  return (struct num_ctx){&num_dual, prec};
}

val dual_variable(struct calc *c, const arb_t x, int direction) {
  struct dual *z = calc_new(c);
  d_set_arb(z, x, c->ctx.prec);
  if (direction >= 0) arb_one(&z->d[direction]);
  return z;
}
