/* Newton's iteration and Krawczyk's operator over the number table.

   The caller's function hands over pointers to its own elements; what is formed here lives in vectors of the iteration
   or of the operator.  In balls a step is the product of the values with a rounded inverse of the derivative, which may
   be any matrix and is the operator's too; in the other types it comes from num_mat_solve's elimination. */
#include "solve.h"

#include <stdlib.h>

enum { SETTLED = 10, SETTLE_GUARD = 4, FIRST_BITS = 192, LEVEL_GUARD = 24, MOST_BOXES = 12, FIRST_BOX = 3, GROWTH = 3 };

static void gather(struct num_vec *z, const void *const *from) {
  for (slong i = 0; i < z->len; i++) z->ctx.type->set(num_vec_at(z, i), from[i]);
}

static void to_middles(struct num_vec *z) {
  for (slong i = 0; i < z->len; i++) arb_get_mid_arb(num_vec_at(z, i), num_vec_at(z, i));
}

static void fill(arb_mat_t z, const void *const *from) {
  for (slong i = 0; i < arb_mat_nrows(z); i++)
    for (slong l = 0; l < arb_mat_ncols(z); l++) arb_set(arb_mat_entry(z, i, l), from[i * arb_mat_ncols(z) + l]);
}

/* y = the inverse of the derivative, rounded, and step = y f.  SS_UNABLE when it cannot be told from a singular one. */
static int precondition(arb_mat_t y, arb_mat_t step, const void *const *f, const void *const *j, slong prec) {
  fill(y, j);
  fill(step, f);
  if (!arb_mat_inv(y, y, prec)) return SS_UNABLE;
  arb_mat_get_mid(y, y);
  arb_mat_mul(step, y, step, prec);
  return SS_OK;
}

/* --- Newton's iteration. --- */

static int ball_step(struct num_vec *step, const void *const *f, const void *const *j) {
  slong n = step->len;
  SIZED(arb_mat, y, n, n);
  SIZED(arb_mat, b, n, 1);
  int status = precondition(y, b, f, j, step->ctx.prec);
  for (slong i = 0; i < n && !status; i++) arb_swap(num_vec_at(step, i), arb_mat_entry(b, i, 0));
  return status;
}

static int plain_step(struct num_vec *step, const void *const *f, const void *const *j) {
  slong n = step->len;
  OWNED(num_vec) a;
  num_vec_init(&a, n * n, step->ctx);
  gather(step, f);
  gather(&a, j);
  return num_mat_solve(step, &a, step, n, 1);
}

int newton_run(struct num_vec *x, const struct solve_system *s, struct num_ctx ctx, int most, newton_judge *judge) {
  const void *f[SOLVE_MOST], *j[SOLVE_MOST * SOLVE_MOST];
  enum newton_next next = NEWTON_ON;
  OWNED(num_vec) step;
  int status = SS_OK;
  if (s->n > SOLVE_MOST || x->len != s->n) abort();
  num_vec_init(&step, s->n, ctx);
  for (int i = 0; next == NEWTON_ON && !status; i++) {
    status = i < most ? s->values(f, j, x, s->self) : SS_UNABLE;
    if (!status) status = ctx.type == &num_arb ? ball_step(&step, f, j) : plain_step(&step, f, j);
    if (status) break;
    next = judge(x, &step, s->self);
    if (next == NEWTON_LOST) status = SS_UNABLE;
    if (next == NEWTON_LOST || next == NEWTON_STAY) break;
    for (slong k = 0; k < s->n; k++)
      status |= ctx.type->sub(num_vec_at(x, k), num_vec_at(x, k), num_vec_at(&step, k), ctx.prec);
    if (ctx.type->rigorous) to_middles(x);
  }
  return status;
}

bool newton_is_small(const struct num_type *type, const void *step, slong bits, const void *scale) {
  NUMBERS(arb, x, y);
  type->get_arb(x, step);
  type->get_arb(y, scale);
  arb_mul_2exp_si(y, y, -bits);
  return arb_is_finite(x) && arf_cmpabs(arb_midref(x), arb_midref(y)) <= 0;
}

/* Another system, with the size of the least step so far. */
struct settling {
  const struct solve_system *of;
  mag_t least;
};

static int values_of(const void **f, const void **j, const struct num_vec *x, void *self) {
  const struct settling *s = self;
  return s->of->values(f, j, x, s->of->self);
}

/* size = 2^shift of the largest element. */
static void size_of(mag_t size, const struct num_vec *x, slong shift) {
  NUMBERS(mag, part);
  mag_zero(size);
  for (slong k = 0; k < x->len; k++) {
    arb_get_mag(part, num_vec_at(x, k));
    mag_max(size, size, part);
  }
  mag_mul_2exp_si(size, size, shift);
}

/* Beside one long unknown, such as the length of a phase, the largest element of a step tells nothing of the others:
   is each element short for its own unknown, or for 2^-SETTLED of the largest? */
static bool each_is_short(const struct num_vec *x, const struct num_vec *step) {
  NUMBERS(mag, part, unit, least);
  bool good = true;
  size_of(least, x, -SETTLED);
  for (slong k = 0; k < x->len; k++) {
    arb_get_mag(part, num_vec_at(step, k));
    arb_get_mag(unit, num_vec_at(x, k));
    mag_max(unit, unit, least);
    mag_mul_2exp_si(unit, unit, -SETTLED);
    good = good && mag_cmp(part, unit) <= 0;
  }
  return good;
}

static enum newton_next still_shrinks(const struct num_vec *x, const struct num_vec *step, void *self) {
  struct settling *s = self;
  NUMBERS(mag, size, far, last);
  size_of(size, step, 0);
  size_of(far, x, -SETTLED);
  size_of(last, x, -x->ctx.prec / 2 - SETTLE_GUARD);
  bool less = mag_cmp(size, s->least) < 0 || (mag_cmp(size, far) <= 0 && !each_is_short(x, step));
  enum newton_next next = !less ? NEWTON_STAY : mag_cmp(size, last) < 0 ? NEWTON_LAST : NEWTON_ON;
  mag_min(s->least, s->least, size);
  return next;
}

int newton_settle(struct num_vec *x, const struct solve_system *s, int most) {
  struct settling self = {.of = s};
  struct solve_system same = {s->n, values_of, &self};
  NUMBERS(mag, far);
  mag_init(self.least);
  mag_inf(self.least);
  int status = newton_run(x, &same, x->ctx, most, still_shrinks);
  size_of(far, x, -SETTLED);
  if (mag_cmp(self.least, far) > 0) status |= SS_UNABLE;
  mag_clear(self.least);
  return status;
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
  k->system = s;
  k->inside = false;
  num_vec_init(&k->mid, s->n, ctx);
  num_vec_init(&k->box, s->n, ctx);
  num_vec_init(&k->image, s->n, ctx);
  arb_mat_init(k->y, s->n, s->n);
  arb_mat_init(k->step, s->n, 1);
  arb_mat_init(k->rest, s->n, s->n);
  arb_mat_init(k->off, s->n, 1);
}

void krawczyk_clear(struct krawczyk *k) {
  arb_mat_clear(k->off);
  arb_mat_clear(k->rest);
  arb_mat_clear(k->step);
  arb_mat_clear(k->y);
  num_vec_clear(&k->image);
  num_vec_clear(&k->box);
  num_vec_clear(&k->mid);
}

int krawczyk_centre(struct krawczyk *k, const struct num_vec *x) {
  const void *f[SOLVE_MOST], *j[SOLVE_MOST * SOLVE_MOST];
  slong prec = k->mid.ctx.prec;
  num_vec_set(&k->mid, x);
  to_middles(&k->mid);
  int status = k->system->values(f, j, &k->mid, k->system->self);
  if (status) return status;
  return precondition(k->y, k->step, f, j, prec);
}

int krawczyk_apply(struct krawczyk *k) {
  const void *j[SOLVE_MOST * SOLVE_MOST];
  slong n = k->system->n, prec = k->image.ctx.prec;
  int status = k->system->values(NULL, j, &k->box, k->system->self);
  k->inside = !status;
  k->too_wide = false;
  if (status) return status;
  fill(k->rest, j);
  arb_mat_mul(k->rest, k->y, k->rest, prec);
  arb_mat_neg(k->rest, k->rest);
  for (slong i = 0; i < n; i++) {
    k->inside = k->inside && arb_contains(num_vec_at(&k->box, i), num_vec_at(&k->mid, i));
    arb_add_si(arb_mat_entry(k->rest, i, i), arb_mat_entry(k->rest, i, i), 1, prec);
    arb_sub(arb_mat_entry(k->off, i, 0), num_vec_at(&k->box, i), num_vec_at(&k->mid, i), prec);
  }
  arb_mat_mul(k->off, k->rest, k->off, prec);
  for (slong i = 0; i < n; i++) {
    arb_ptr z = num_vec_at(&k->image, i), box = num_vec_at(&k->box, i);
    arb_sub(z, arb_mat_entry(k->off, i, 0), arb_mat_entry(k->step, i, 0), prec);
    arb_add(z, z, num_vec_at(&k->mid, i), prec);
    k->inside = k->inside && arb_is_finite(z) && arb_contains_interior(box, z);
    k->too_wide = k->too_wide || mag_cmp(arb_radref(arb_mat_entry(k->off, i, 0)), arb_radref(box)) >= 0;
  }
  return SS_OK;
}

/* Adds 2^shift of the size of x, and what rounding can do to mid, to the radius; a step can be exactly zero. */
static void widen(arb_t box, const arb_t mid, mag_srcptr x, slong shift, slong prec) {
  NUMBERS(mag, more, least);
  mag_mul_2exp_si(more, x, shift);
  arb_get_mag(least, mid);
  mag_mul_2exp_si(least, least, 8 - prec);
  mag_add_ui_2exp_si(least, least, 1, -4 * prec);
  mag_add(arb_radref(box), arb_radref(box), more);
  mag_add(arb_radref(box), arb_radref(box), least);
}

int krawczyk_grow(struct krawczyk *k) {
  slong n = k->system->n, prec = k->box.ctx.prec;
  int status = SS_OK;
  NUMBERS(mag, size);
  num_vec_set(&k->box, &k->mid);
  for (slong i = 0; i < n; i++) {
    arb_get_mag(size, arb_mat_entry(k->step, i, 0));
    widen(num_vec_at(&k->box, i), num_vec_at(&k->mid, i), size, FIRST_BOX, prec);
  }
  k->inside = false;
  k->too_wide = false;
  for (int t = 0; t < MOST_BOXES && !k->inside && !k->too_wide && !status; t++) {
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
    arb_sub(num_vec_at(&k->image, i), num_vec_at(&k->mid, i), arb_mat_entry(k->step, i, 0), prec);
  k->inside = false;
  for (int t = 0; t < MOST_BOXES && !k->inside && !status; t++) {
    num_vec_set(&k->box, &k->image);
    for (slong i = 0; i < n; i++) {
      arb_ptr box = num_vec_at(&k->box, i);
      widen(box, num_vec_at(&k->mid, i), arb_radref(box), wider, prec);
      if (!arb_contains(box, num_vec_at(&k->mid, i))) arb_union(box, box, num_vec_at(&k->mid, i), prec);
    }
    status = krawczyk_apply(k);
  }
  return k->inside ? status : status | SS_UNABLE;
}

int krawczyk_enclose(struct num_vec *x, struct num_vec *box, const struct solve_system *s) {
  OWNED(krawczyk) k;
  krawczyk_init(&k, s, x->ctx.prec);
  int status = krawczyk_centre(&k, x);
  if (!status) status = krawczyk_grow(&k);
  if (!status) num_vec_set(x, &k.image);
  if (!status && box) num_vec_set(box, &k.box);
  return status;
}

bool krawczyk_same(const arb_t *x, const arb_t *x_box, const arb_t *y, const arb_t *y_box, int n) {
  bool same = true;
  for (int k = 0; k < n && same; k++)
    same = arb_overlaps(x[k], y[k]) && (arb_contains(x_box[k], y[k]) || arb_contains(y_box[k], x[k]));
  return same;
}
