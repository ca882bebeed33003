/* Formulas over any number type: the pool of elements that the temporaries of a formula come from.

   Each operation takes the next element of the pool, which grows by chunks, so that a formula needs no names for its
   temporaries; a loop releases the pool to a mark, and its elements are used again. */
#include "calc.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"

enum { CALC_CHUNK = 32, KEPT_CALCS = 4, KEPT_CHUNKS = 32, KEPT_BITS = 2048 };

/* Balls of more than two words own memory, and a pass takes hundreds of them: the elements of the last few calcs wait
   for the next ones.  flint_cleanup, which each thread calls at its end, frees them. */
static _Thread_local struct kept {
  char **pool;
  slong made, cap;
} kept[KEPT_CALCS];
static _Thread_local int n_kept;
static _Thread_local bool registered;

static void *element(const struct calc *c, slong i) {
  size_t at = (size_t)i;
  return c->pool[at / CALC_CHUNK] + at % CALC_CHUNK * c->stride;
}

static void free_elements(struct calc *c) {
  bool own = !c->ctx.type->plain && c->ctx.type != &num_mpfr;
  for (slong i = 0; i < c->made && own; i++) c->ctx.type->clear(element(c, i));
  for (slong i = 0; i < c->cap; i++) free(c->pool[i]);
  free(c->pool);
}

static void free_kept(void) {
  while (n_kept > 0) {
    const struct kept *k = &kept[--n_kept];
    free_elements(&(struct calc){
        .ctx = num_ctx_arb(53), .stride = sizeof(arb_struct), .pool = k->pool, .made = k->made, .cap = k->cap});
  }
  registered = false;
}

struct calc calc_begin(struct num_ctx ctx) {
  struct calc c = {.ctx = ctx, .stride = ctx.type->size};
  if (ctx.type == &num_mpfr) c.stride += mpfr_custom_get_size(ctx.prec);
  if (ctx.type == &num_arb && n_kept > 0) {
    const struct kept *k = &kept[--n_kept];
    c.pool = k->pool;
    c.made = k->made;
    c.cap = k->cap;
  }
  return c;
}

void calc_clear(struct calc *c) {
  for (size_t i = 0; i < c->n_vecs; i++) num_vec_clear(&c->vec[i]);
  free(c->vec);
  if (c->ctx.type != &num_arb || n_kept == KEPT_CALCS || c->cap > KEPT_CHUNKS || c->ctx.prec > KEPT_BITS) {
    free_elements(c);
    return;
  }
  if (!registered) flint_register_cleanup_function(free_kept);
  registered = true;
  kept[n_kept++] = (struct kept){c->pool, c->made, c->cap};
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
    c->pool[c->cap++] = ss_malloc(CALC_CHUNK * c->stride);
  }
  void *x = element(c, c->used++);
  if (c->used > c->made) {
    if (c->ctx.type == &num_mpfr)
      mpfr_custom_init_set(x, MPFR_ZERO_KIND, 0, c->ctx.prec, (char *)x + sizeof(mpfr_t));
    else
      c->ctx.type->init(x, c->ctx.prec);
    c->made++;
  }
  return x;
}

struct num_vec calc_vec(struct calc *c, slong n) {
  struct num_vec *v = SS_PUSH(c->vec, c->n_vecs, c->cap_vecs);
  num_vec_init(v, n, c->ctx);
  return *v;
}

struct num_vec calc_vec_of(struct calc *c, const val *x, slong n) {
  struct num_vec v = calc_vec(c, n);
  for (slong i = 0; i < n; i++) c->ctx.type->set(num_vec_at(&v, i), x[i]);
  return v;
}

struct num_vec calc_vec_d(struct calc *c, const double *x, slong n) {
  struct num_vec v = calc_vec(c, n);
  for (slong i = 0; i < n; i++) c->status |= c->ctx.type->set_d(num_vec_at(&v, i), x[i], c->ctx.prec);
  return v;
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

val calc_pi(struct calc *c) {
  void *z = calc_new(c);
  c->status |= c->ctx.type->pi(z, c->ctx.prec);
  return z;
}

static bool begins(const struct calc *c) {
  return !c->reduce || c->status == SS_OK;
}

static val finished(struct calc *c, void *z, int status) {
  c->status |= status;
  if (c->reduce && status == SS_OK) c->status |= c->reduce(z, c->field);
  return z;
}

static val unary(struct calc *c, num_unary f, val x) {
  void *z = calc_new(c);
  return begins(c) ? finished(c, z, f(z, x, c->ctx.prec)) : z;
}

static val binary(struct calc *c, num_binary f, val x, val y) {
  void *z = calc_new(c);
  return begins(c) ? finished(c, z, f(z, x, y, c->ctx.prec)) : z;
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
val calc_stumpff(struct calc *c, val x) {
  return unary(c, c->ctx.type->stumpff, x);
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
  return calc_dot_from(c, NULL, a, x, false, b, y);
}

/* Arb's sum of products rounds once, and takes half the time of its parts; it borrows the operands. */
static val ball_dot(struct calc *c, val start, val a, val x, bool minus, val b, val y) {
  arb_ptr z = calc_new(c);
  arb_struct left[2] = {*(arb_srcptr)a, *(arb_srcptr)b}, right[2] = {*(arb_srcptr)x, *(arb_srcptr)y};
  if (minus) arf_neg(arb_midref(left + 1), arb_midref(left + 1)); /* of this copy; ARF_NEG spoils a zero */
  arb_dot(z, start, 0, left, 1, right, 1, 2, c->ctx.prec);
  if (!arb_is_finite(z)) c->status |= SS_UNABLE;
  return z;
}

val calc_dot_from(struct calc *c, val start, val a, val x, bool minus, val b, val y) {
  if (c->ctx.type == &num_arb) return ball_dot(c, start, a, x, minus, b, y);
  val first = calc_mul(c, a, x), second = calc_mul(c, b, y);
  val sum = minus ? calc_sub(c, first, second) : calc_add(c, first, second);
  return start ? calc_add(c, start, sum) : sum;
}

void calc_sin_cos(struct calc *c, val *sine, val *cosine, val x) {
  void *s = calc_new(c), *co = calc_new(c);
  c->status |= c->ctx.type->sin_cos(s, co, x, c->ctx.prec);
  *sine = s;
  *cosine = co;
}

void calc_sin_versine(struct calc *c, val *sine, val *versine, val x) {
  val two = calc_d(c, 2), s, co;
  calc_sin_cos(c, &s, &co, calc_mul(c, calc_d(c, 0.5), x));
  *sine = calc_mul(c, two, calc_mul(c, s, co));
  *versine = calc_mul(c, two, calc_mul(c, s, s));
}

val calc_div_ui(struct calc *c, val x, ulong n) {
  void *z = calc_new(c);
  if (c->ctx.type == &num_arb)
    arb_div_ui(z, x, n, c->ctx.prec);
  else if (c->ctx.type == &num_mpfr)
    mpfr_div_ui(z, x, n, MPFR_RNDN);
  else
    c->status |= c->ctx.type->div(z, x, calc_d(c, (double)n), c->ctx.prec);
  return z;
}

val calc_middle(struct calc *c, val x) {
  if (!c->ctx.type->rigorous) return x;
  arb_ptr z = calc_new(c);
  arb_get_mid_arb(z, x);
  return z;
}

static slong exponent_of(const fmpz *e) {
  if (COEFF_IS_MPZ(*e)) return fmpz_sgn(e) < 0 ? CALC_TINY : -CALC_TINY;
  return FLINT_MAX(FLINT_MIN(*e, -CALC_TINY), CALC_TINY);
}

slong calc_exponent(const struct calc *c, val x) {
  if (c->ctx.type == &num_mpfr) {
    mpfr_srcptr y = x;
    return mpfr_regular_p(y) ? FLINT_MAX(mpfr_get_exp(y), CALC_TINY) : mpfr_zero_p(y) ? CALC_TINY : -CALC_TINY;
  }
  if (c->ctx.type == &num_arb) {
    arf_srcptr mid = arb_midref((arb_srcptr)x);
    mag_srcptr radius = arb_radref((arb_srcptr)x);
    if (!arf_is_finite(mid) || mag_is_inf(radius)) return -CALC_TINY;
    slong e = arf_is_zero(mid) ? CALC_TINY : exponent_of(ARF_EXPREF(mid));
    return mag_is_zero(radius) ? e : FLINT_MAX(e, exponent_of(MAG_EXPREF(radius)) + 1);
  }
  int e;
  double size = c->ctx.type->get_d(x);
  frexp(size, &e);
  return size == 0 ? CALC_TINY : isfinite(size) ? e : -CALC_TINY;
}

void calc_store(const struct calc *c, void *z, val x) {
  c->ctx.type->set(z, x);
}

val calc_round(struct calc *c, val x) {
  void *z = calc_new(c);
  if (c->ctx.type == &num_arb)
    arb_set_round(z, x, c->ctx.prec);
  else
    c->ctx.type->set(z, x);
  return z;
}

val calc_within(struct calc *c, val x, val bound) {
  if (!c->ctx.type->rigorous) return x;
  arb_ptr z = calc_new(c);
  arb_set(z, x);
  arb_add_error(z, bound);
  return z;
}

bool calc_lt(const struct calc *c, val x, val y) {
  return c->ctx.type->lt(x, y) == TRUTH_TRUE;
}
