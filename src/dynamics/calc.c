/* Formulas over any number type, written as nested calls.

   Each operation takes a fresh element from a pool, so that a formula needs no names for its temporaries, and ORs its
   status into the calc, so that it is looked at once.  Loops release the pool to a mark. */
#include <stdlib.h>

#include "dyn_impl.h"
#include "stickslip/arena.h"

enum { CALC_CHUNK = 32 };

static void *element(const struct calc *c, slong i) {
  return c->pool[i / CALC_CHUNK] + (size_t)(i % CALC_CHUNK) * c->ctx.type->size;
}

void calc_init(struct calc *c, struct num_ctx ctx) {
  *c = (struct calc){.ctx = ctx};
}

void calc_clear(struct calc *c) {
  for (slong i = 0; i < c->made && !c->ctx.type->plain; i++) c->ctx.type->clear(element(c, i));
  for (slong i = 0; i < c->cap; i++) free(c->pool[i]);
  free(c->pool);
}

slong calc_mark(const struct calc *c) {
  return c->used;
}

void calc_release(struct calc *c, slong mark) {
  c->used = mark;
}

void *calc_new(struct calc *c) {
  if (c->used == c->cap * CALC_CHUNK) {
    c->pool = ss_realloc(c->pool, (size_t)(c->cap + 1) * sizeof *c->pool);
    c->pool[c->cap++] = ss_malloc(CALC_CHUNK * c->ctx.type->size);
  }
  void *x = element(c, c->used++);
  if (c->used > c->made) {
    c->ctx.type->init(x, c->ctx.prec);
    c->made++;
  }
  return x;
}

val calc_d(struct calc *c, double x) {
  void *z = calc_new(c);
  c->status |= c->ctx.type->set_d(z, x, c->ctx.prec);
  return z;
}

val calc_q(struct calc *c, const fmpq *x) {
  void *z = calc_new(c);
  c->status |= c->ctx.type->set_q(z, x, c->ctx.prec);
  return z;
}

val calc_two_to(struct calc *c, slong n) {
  void *z = calc_new(c);
  c->status |= c->ctx.type->pow_si(z, calc_d(c, 2), n, c->ctx.prec);
  return z;
}

static val unary(struct calc *c, num_unary f, val x) {
  void *z = calc_new(c);
  c->status |= f(z, x, c->ctx.prec);
  return z;
}

static val binary(struct calc *c, num_binary f, val x, val y) {
  void *z = calc_new(c);
  c->status |= f(z, x, y, c->ctx.prec);
  return z;
}

val calc_neg(struct calc *c, val x) {
  return unary(c, c->ctx.type->neg, x);
}
val calc_abs(struct calc *c, val x) {
  return unary(c, c->ctx.type->abs, x);
}
val calc_sqrt(struct calc *c, val x) {
  return unary(c, c->ctx.type->sqrt, x);
}
val calc_add(struct calc *c, val x, val y) {
  return binary(c, c->ctx.type->add, x, y);
}
val calc_sub(struct calc *c, val x, val y) {
  return binary(c, c->ctx.type->sub, x, y);
}
val calc_mul(struct calc *c, val x, val y) {
  return binary(c, c->ctx.type->mul, x, y);
}
val calc_div(struct calc *c, val x, val y) {
  return binary(c, c->ctx.type->div, x, y);
}
val calc_atan2(struct calc *c, val y, val x) {
  return binary(c, c->ctx.type->atan2, y, x);
}

val calc_dot(struct calc *c, val a, val x, val b, val y) {
  return calc_add(c, calc_mul(c, a, x), calc_mul(c, b, y));
}

void calc_sin_cos(struct calc *c, val *sine, val *cosine, val x) {
  void *s = calc_new(c), *co = calc_new(c);
  c->status |= c->ctx.type->sin_cos(s, co, x, c->ctx.prec);
  *sine = s;
  *cosine = co;
}

bool calc_lt(const struct calc *c, val x, val y) {
  return c->ctx.type->lt(x, y) == TRUTH_TRUE;
}
