/* Newton's iteration and Krawczyk's operator over the number table.

   The caller's function hands over pointers to its own elements; what is formed here lives in vectors of the iteration or of
   the operator.  The linear algebra is num_mat_solve's elimination, in Krawczyk's operator on midpoints: there the inverse may be
   any matrix, and only what is multiplied with it is enclosed. */
#include "solve.h"

#include <stdlib.h>

enum { FIRST_BITS = 192, LEVEL_GUARD = 24, MOST_BOXES = 12, FIRST_BOX = 3, GROWTH = 3 };

static void gather(struct num_vec *z, const void *const *from) {
  for (slong i = 0; i < z->len; i++) z->ctx.type->set(num_vec_at(z, i), from[i]);
}

static void to_middles(struct num_vec *z) {
  for (slong i = 0; i < z->len; i++) arb_get_mid_arb(num_vec_at(z, i), num_vec_at(z, i));
}

/* --- Newton's iteration. --- */

static int newton_step(struct num_vec *step, struct num_vec *a, const struct solve_system *s, const struct num_vec *x) {
  const void *f[SOLVE_MOST], *j[SOLVE_MOST * SOLVE_MOST];
  int status = s->values(f, j, x, s->self);
  if (status) return status;
  gather(step, f);
  gather(a, j);
  status = num_mat_solve(step, a, step, s->n, 1);
  return status;
}

int newton_run(struct num_vec *x, const struct solve_system *s, struct num_ctx ctx, int most, newton_judge *judge) {
  struct num_vec step, a;
  if (s->n > SOLVE_MOST || x->len != s->n) abort();
  enum newton_next next = NEWTON_ON;
  int status = SS_OK;
  num_vec_init(&step, s->n, ctx);
  num_vec_init(&a, s->n * s->n, ctx);
  for (int i = 0; next == NEWTON_ON && !status; i++) {
    status = i < most ? newton_step(&step, &a, s, x) : SS_UNABLE;
    if (status) break;
    next = judge(x, &step, s->self);
    if (next == NEWTON_LOST) status = SS_UNABLE;
    if (next == NEWTON_LOST || next == NEWTON_STAY) break;
    for (slong k = 0; k < s->n; k++)
      status |= ctx.type->sub(num_vec_at(x, k), num_vec_at(x, k), num_vec_at(&step, k), ctx.prec);
    if (ctx.type->rigorous) to_middles(x);
  }
  num_vec_clear(&a);
  num_vec_clear(&step);
  return status;
}

bool newton_is_small(const struct num_type *type, const void *step, slong bits, const void *scale) {
  bool small;
  arb_t x, y;
  arb_init(x);
  arb_init(y);
  type->get_arb(x, step);
  type->get_arb(y, scale);
  arb_mul_2exp_si(y, y, -bits);
  small = arb_is_finite(x) && arf_cmpabs(arb_midref(x), arb_midref(y)) <= 0;
  arb_clear(y);
  arb_clear(x);
  return small;
}

int newton_rising(int (*level)(slong bits, void *self), void *self, slong prec) {
  slong ladder[FLINT_BITS], n = 0;
  int status = SS_OK;
  for (slong bits = prec; bits > FIRST_BITS; bits = bits / 2 + LEVEL_GUARD) ladder[n++] = bits;
  ladder[n++] = FLINT_MIN(prec, FIRST_BITS);
  while (n > 0 && !status) status = level(ladder[--n], self);
  return status;
}

/* --- Krawczyk's operator. --- */

void krawczyk_init(struct krawczyk *k, const struct solve_system *s, slong prec) {
  struct num_ctx ctx = num_ctx_arb(prec);
  if (s->n > SOLVE_MOST) abort();
  *k = (struct krawczyk){.system = s};
  num_vec_init(&k->mid, s->n, ctx);
  num_vec_init(&k->step, s->n, ctx);
  num_vec_init(&k->y, s->n * s->n, ctx);
  num_vec_init(&k->box, s->n, ctx);
  num_vec_init(&k->image, s->n, ctx);
}

void krawczyk_clear(struct krawczyk *k) {
  num_vec_clear(&k->image);
  num_vec_clear(&k->box);
  num_vec_clear(&k->y);
  num_vec_clear(&k->step);
  num_vec_clear(&k->mid);
}

int krawczyk_centre(struct krawczyk *k, const struct num_vec *x) {
  const void *f[SOLVE_MOST], *j[SOLVE_MOST * SOLVE_MOST];
  slong n = k->system->n;
  struct num_vec a;
  num_vec_set(&k->mid, x);
  to_middles(&k->mid);
  int status = k->system->values(f, j, &k->mid, k->system->self);
  if (status) return status;
  num_vec_init(&a, n * n, k->y.ctx);
  gather(&a, j);
  to_middles(&a);
  for (slong i = 0; i < n * n; i++) arb_set_si(num_vec_at(&k->y, i), i / n == i % n);
  status = num_mat_solve(&k->y, &a, &k->y, n, n);
  to_middles(&k->y);
  gather(&k->step, f);
  if (!status) status = num_mat_mul(&k->step, &k->y, &k->step, n, n, 1);
  num_vec_clear(&a);
  return status;
}

/* image_i = mid_i - step_i + sum over l of (I - Y J)_il (box_l - mid_l). */
static void image_row(struct krawczyk *k, slong i, const void *const *j) {
  slong n = k->system->n, prec = k->image.ctx.prec;
  arb_struct column[SOLVE_MOST]; /* borrowed */
  arb_ptr z = num_vec_at(&k->image, i);
  arb_t rest, off;
  arb_init(rest);
  arb_init(off);
  arb_sub(z, num_vec_at(&k->mid, i), num_vec_at(&k->step, i), prec);
  for (slong l = 0; l < n; l++) {
    for (slong m = 0; m < n; m++) column[m] = *(arb_srcptr)j[m * n + l];
    arb_dot(rest, NULL, 1, num_vec_at(&k->y, i * n), 1, column, 1, n, prec);
    if (i == l) arb_add_si(rest, rest, 1, prec);
    arb_sub(off, num_vec_at(&k->box, l), num_vec_at(&k->mid, l), prec);
    arb_addmul(z, rest, off, prec);
  }
  arb_clear(off);
  arb_clear(rest);
}

int krawczyk_apply(struct krawczyk *k) {
  const void *j[SOLVE_MOST * SOLVE_MOST];
  int status = k->system->values(NULL, j, &k->box, k->system->self);
  k->inside = !status;
  for (slong i = 0; i < k->system->n && !status; i++) {
    image_row(k, i, j);
    k->inside = k->inside && arb_is_finite(num_vec_at(&k->image, i)) &&
                arb_contains_interior(num_vec_at(&k->box, i), num_vec_at(&k->image, i));
  }
  return status;
}

/* Adds 2^shift of the size of x, and what rounding can do to mid, to the radius; a step can be exactly zero. */
static void widen(arb_t box, const arb_t mid, mag_srcptr x, slong shift, slong prec) {
  mag_t more;
  mag_init(more);
  mag_mul_2exp_si(more, x, shift);
  mag_add(arb_radref(box), arb_radref(box), more);
  arb_get_mag(more, mid);
  mag_mul_2exp_si(more, more, 8 - prec);
  mag_add(arb_radref(box), arb_radref(box), more);
  mag_add_ui_2exp_si(arb_radref(box), arb_radref(box), 1, -4 * prec);
  mag_clear(more);
}

int krawczyk_grow(struct krawczyk *k) {
  slong n = k->system->n, prec = k->box.ctx.prec;
  int status = SS_OK;
  mag_t size;
  mag_init(size);
  num_vec_set(&k->box, &k->mid);
  for (slong i = 0; i < n; i++) {
    arb_get_mag(size, num_vec_at(&k->step, i));
    widen(num_vec_at(&k->box, i), num_vec_at(&k->mid, i), size, FIRST_BOX, prec);
  }
  mag_clear(size);
  k->inside = false;
  for (int t = 0; t < MOST_BOXES && !k->inside && !status; t++) {
    for (slong i = 0; i < n && t > 0; i++) {
      arb_ptr box = num_vec_at(&k->box, i);
      mag_mul_2exp_si(arb_radref(box), arb_radref(box), GROWTH);
    }
    status = krawczyk_apply(k);
  }
  return k->inside ? status : status | SS_UNABLE;
}

int krawczyk_follow(struct krawczyk *k, slong wider) {
  slong n = k->system->n, prec = k->box.ctx.prec;
  int status = SS_OK;
  for (slong i = 0; i < n; i++)
    arb_sub(num_vec_at(&k->image, i), num_vec_at(&k->mid, i), num_vec_at(&k->step, i), prec);
  k->inside = false;
  for (int t = 0; t < MOST_BOXES && !k->inside && !status; t++) {
    num_vec_set(&k->box, &k->image);
    for (slong i = 0; i < n; i++) {
      arb_ptr box = num_vec_at(&k->box, i);
      widen(box, num_vec_at(&k->mid, i), arb_radref(box), wider, prec);
    }
    status = krawczyk_apply(k);
  }
  return k->inside ? status : status | SS_UNABLE;
}
