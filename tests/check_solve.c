/* Newton's iteration and Krawczyk's operator on systems whose solutions are known in closed form, and on those where
   nothing may be proved: a double zero, no zero, and boxes that hold two or are too wide. */
#include "num/solve.h"
#include "rational.h"

#include "test.h"

/* f_i = x_i^2 + x_{i+1}^2 - (p_i + p_{i+1}), indices mod n: for odd n the positive solution is sqrt(p_i) alone.  For n
   = 1, f = x^2 - p.  p_0 = 2 + off. */
struct squares {
  struct num_ctx ctx;
  slong n;
  struct num_vec f, j, t;
  arb_t off;
  int calls, most; /* judge: an end after so many steps, none if 0 */
  enum newton_next end;
};

static struct squares squares_of(slong n, struct num_ctx ctx) {
  struct squares s = {.ctx = ctx, .n = n, .end = NEWTON_LAST};
  s.f = vec_new(n, ctx);
  s.j = vec_new(n * n, ctx);
  s.t = vec_new(2, ctx);
  arb_init(s.off);
  return s;
}

static void squares_clear(struct squares *s) {
  arb_clear(s->off);
  vecs_clear(&s->t, &s->j, &s->f);
}

static int squares_values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct squares *s = self;
  const struct num_type *type = s->ctx.type;
  slong n = s->n, prec = s->ctx.prec;
  void *t = num_vec_at(&s->t, 0), *two = num_vec_at(&s->t, 1);
  int status = type->set_d(two, 2, prec);
  for (slong i = 0; i < n; i++) {
    void *z = num_vec_at(&s->f, i);
    status |= type->set_d(z, 0, prec);
    for (slong k = 0; k < n; k++) {
      status |= type->set_d(num_vec_at(&s->j, i * n + k), 0, prec);
      if (k != i && (n == 1 || k != (i + 1) % n)) continue;
      status |= type->mul(num_vec_at(&s->j, i * n + k), num_vec_at(x, k), two, prec);
      status |= type->mul(t, num_vec_at(x, k), num_vec_at(x, k), prec) | type->add(z, z, t, prec);
      status |= type->set_d(t, (double)(k + 2), prec) | type->sub(z, z, t, prec);
      if (type == &num_arb && k == 0) arb_sub(z, z, s->off, prec);
    }
    if (f) f[i] = z;
  }
  for (slong i = 0; i < n * n; i++) j[i] = num_vec_at(&s->j, i);
  s->calls++;
  return status;
}

static enum newton_next settles(const struct num_vec *x, const struct num_vec *step, void *self) {
  const struct squares *s = self;
  if (s->most && s->calls >= s->most) return s->end;
  for (slong i = 0; i < x->len; i++)
    if (!newton_is_small(x->ctx.type, num_vec_at(step, i), s->ctx.prec / 2 + 4, num_vec_at(x, i))) return NEWTON_ON;
  return NEWTON_LAST;
}

static void start_at(struct num_vec *x, double off) {
  for (slong i = 0; i < x->len; i++) x->ctx.type->set_d(num_vec_at(x, i), sqrt((double)(i + 2)) + off, x->ctx.prec);
}

/* |x - sqrt(p)| <= 2^bits */
static bool is_near_root(const struct num_type *type, const void *x, slong p, slong bits) {
  NUMBERS(arb, root, got);
  arb_sqrt_ui(root, (ulong)p, 4000);
  type->get_arb(got, x);
  arb_sub(got, got, root, 4000);
  return arf_cmpabs_2exp_si(arb_midref(got), bits) <= 0;
}

static const slong sizes[] = {1, 3, 15};

TEST(newton_finds_square_roots) {
  struct num_ctx ctx[] = {num_ctx_double(), num_ctx_mpfr(53), num_ctx_mpfr(700), num_ctx_arb(90), num_ctx_arb(700)};
  for (size_t t = 0; t < COUNT(ctx); t++)
    for (size_t i = 0; i < COUNT(sizes); i++) {
      OWNED(squares) s = squares_of(sizes[i], ctx[t]);
      OWNED(num_vec) x = vec_new(sizes[i], ctx[t]);
      struct solve_system system = {sizes[i], squares_values, &s};
      start_at(&x, 0.05);
      ck_assert_int_eq(newton_run(&x, &system, ctx[t], 40, settles), SS_OK);
      ck_assert_int_lt(s.calls, 16);
      for (slong k = 0; k < sizes[i]; k++)
        ck_assert(is_near_root(ctx[t].type, num_vec_at(&x, k), k + 2, 8 - ctx[t].prec));
      for (slong k = 0; k < sizes[i] && ctx[t].type == &num_arb; k++) ck_assert(arb_is_exact(num_vec_at(&x, k)));
    }
}

TEST(newton_ends_as_it_is_told) {
  double x = 1.5;
  OWNED(squares) s = squares_of(1, num_ctx_double());
  struct solve_system system = {1, squares_values, &s};
  struct num_vec v = {num_ctx_double(), 1, (char *)&x};
  s.most = 1;
  s.end = NEWTON_LAST; /* 3/2 - (9/4 - 2)/3 */
  ck_assert_int_eq(newton_run(&v, &system, v.ctx, 9, settles), SS_OK);
  ck_assert_double_eq_tol(x, 17.0 / 12, 1e-15);
  ck_assert_int_eq(s.calls, 1);
  x = 1.5;
  s.calls = 0;
  s.end = NEWTON_STAY;
  ck_assert_int_eq(newton_run(&v, &system, v.ctx, 9, settles), SS_OK);
  ck_assert_double_eq(x, 1.5);
  s.calls = 0;
  s.end = NEWTON_LOST;
  ck_assert_int_eq(newton_run(&v, &system, v.ctx, 9, settles), SS_UNABLE);
  s.calls = s.most = 0;
  ck_assert_int_eq(newton_run(&v, &system, v.ctx, 2, settles), SS_UNABLE); /* too few */
  ck_assert_int_eq(s.calls, 2);
  x = 0; /* the derivative is zero there */
  ck_assert_int_eq(newton_run(&v, &system, v.ctx, 9, settles), SS_DOMAIN);
}

TEST(what_small_means) {
  double step = 0x1p-20, scale = -1024, more = nextafter(step, 1);
  ck_assert(newton_is_small(&num_double, &step, 30, &scale));
  ck_assert(!newton_is_small(&num_double, &more, 30, &scale));
  ck_assert(!newton_is_small(&num_double, &step, 31, &scale));
  step = NAN;
  ck_assert(!newton_is_small(&num_double, &step, 1, &scale));
}

struct levels {
  slong bits[64];
  int n, fails_at;
};

static int note_level(slong bits, void *self) {
  struct levels *l = self;
  l->bits[l->n++] = bits;
  return l->n == l->fails_at ? SS_UNABLE : SS_OK;
}

TEST(precision_rises) {
  for (slong prec = 2; prec < 100000; prec += prec / 7 + 1) {
    struct levels l = {{0}, 0, 0};
    ck_assert_int_eq(newton_rising(note_level, &l, prec), SS_OK);
    ck_assert_int_eq(l.bits[l.n - 1], prec);
    ck_assert_int_le(l.bits[0], 192);
    for (int i = 1; i < l.n; i++) {
      ck_assert_int_lt(l.bits[i - 1], l.bits[i]);
      ck_assert_int_ge(2 * l.bits[i - 1], l.bits[i] + 16); /* a square of the error before suffices */
    }
  }
  struct levels l = {{0}, 0, 2};
  ck_assert_int_eq(newton_rising(note_level, &l, 5000), SS_UNABLE);
  ck_assert_int_eq(l.n, 2);
}

/* --- Krawczyk's operator. --- */

static bool encloses_root(const arb_t x, slong p) {
  NUMBERS(arb, root);
  arb_sqrt_ui(root, (ulong)p, 4000);
  return arb_contains(x, root);
}

TEST(square_roots_are_enclosed) {
  static const slong precs[] = {53, 128, 1000};
  for (size_t t = 0; t < COUNT(precs); t++)
    for (size_t i = 0; i < COUNT(sizes); i++) {
      OWNED(krawczyk) k;
      OWNED(squares) s = squares_of(sizes[i], num_ctx_arb(precs[t]));
      OWNED(num_vec) x = vec_new(sizes[i], s.ctx);
      struct solve_system system = {sizes[i], squares_values, &s};
      krawczyk_init(&k, &system, precs[t]);
      start_at(&x, 0.05);
      ck_assert_int_eq(newton_run(&x, &system, s.ctx, 40, settles), SS_OK);
      for (int how = 0; how < 3; how++) { /* both from Newton's last iterate, and one from farther away */
        arb_ptr first = num_vec_at(&x, 0);
        if (how == 2) arb_set_d(first, num_arb.get_d(first) + ldexp(1, -(int)(precs[t] / 2)));
        ck_assert_int_eq(krawczyk_centre(&k, &x), SS_OK);
        ck_assert_int_eq(how ? krawczyk_follow(&k, -3) : krawczyk_grow(&k), SS_OK);
        ck_assert(k.inside);
        for (slong l = 0; l < sizes[i]; l++) {
          arb_srcptr image = num_vec_at(&k.image, l);
          ck_assert(encloses_root(image, l + 2));
          ck_assert(arb_contains_interior(num_vec_at(&k.box, l), image));
          if (how < 2) ck_assert_int_gt(arb_rel_accuracy_bits(image), precs[t] - 16);
        }
      }
    }
}

/* The operator of x^2 - p around mid on mid +- radius. */
static bool applied(struct krawczyk *k, double mid, double radius) {
  OWNED(num_vec) x = vec_new(1, num_ctx_arb(90));
  arb_set_d(num_vec_at(&x, 0), mid);
  ck_assert_int_eq(krawczyk_centre(k, &x), SS_OK);
  arb_set_d(num_vec_at(&k->box, 0), mid);
  mag_set_d(arb_radref((arb_ptr)num_vec_at(&k->box, 0)), radius);
  ck_assert_int_eq(krawczyk_apply(k), SS_OK);
  return k->inside;
}

/* K(X) = m - (m^2 - 2)/(2 m) + [-r, r] r/m, exactly, for X = m +- r. */
TEST(boxes_by_hand) {
  OWNED(krawczyk) k;
  OWNED(squares) s = squares_of(1, num_ctx_arb(90));
  struct solve_system system = {1, squares_values, &s};
  krawczyk_init(&k, &system, 90);
  for (double r = 0.125; r < 16; r *= 2) { /* m = 3/2: inside where 1/12 + 2 r^2/3 < r */
    ck_assert_int_eq(applied(&k, 1.5, r), r < 1.4);
    ck_assert_double_eq_tol(mag_get_d(arb_radref((arb_srcptr)num_vec_at(&k.image, 0))), r * r / 1.5, 1e-7 * r * r);
    if (r > 0.09) ck_assert(encloses_root(num_vec_at(&k.image, 0), 2)); /* the zero is in X, so it is in K(X) */
  }
  ck_assert(!applied(&k, 1.5, 0.0625)); /* holds no zero, and the image has none of the box left but an edge */
  ck_assert(!applied(&k, 2, 0.25));     /* no zero in 2 +- 1/4: the image lies apart */
  ck_assert(!arb_overlaps(num_vec_at(&k.image, 0), num_vec_at(&k.box, 0)));
  ck_assert(!applied(&k, 0.25, 2)); /* two zeros */
}

TEST(a_box_away_from_its_centre_proves_nothing) {
  OWNED(krawczyk) k;
  OWNED(squares) s = squares_of(1, num_ctx_arb(90));
  struct solve_system system = {1, squares_values, &s};
  krawczyk_init(&k, &system, 90);
  applied(&k, 1.5, 0.25);
  arb_set_d(num_vec_at(&k.box, 0), 1.375); /* 1.375 +- 0.0625 holds sqrt 2, but not 1.5 */
  mag_set_d(arb_radref((arb_ptr)num_vec_at(&k.box, 0)), 0.0625);
  ck_assert_int_eq(krawczyk_apply(&k), SS_OK);
  ck_assert(arb_contains_interior(num_vec_at(&k.box, 0), num_vec_at(&k.image, 0)));
  ck_assert(!k.inside);
}

/* Nothing is proved where the parameter makes the zero double (p = 0), or leaves none (p = -1): wherever one starts. */
TEST(double_zeros_and_none_are_not_proved) {
  for (int p = 0; p >= -1; p--)
    for (int shift = 0; shift <= 80; shift++) {
      OWNED(krawczyk) k;
      OWNED(squares) s = squares_of(1, num_ctx_arb(90));
      struct solve_system system = {1, squares_values, &s};
      arb_set_si(s.off, p - 2);
      OWNED(num_vec) x = vec_new(1, s.ctx);
      krawczyk_init(&k, &system, 90);
      arb_ptr at = num_vec_at(&x, 0);
      arb_set_d(at, ldexp(1, -shift));
      ck_assert_int_eq(krawczyk_centre(&k, &x), SS_OK);
      ck_assert_int_eq(krawczyk_grow(&k), SS_UNABLE);
      ck_assert_int_eq(krawczyk_follow(&k, -3), SS_UNABLE);
      arb_zero(at);
      ck_assert_int_eq(krawczyk_centre(&k, &x), SS_UNABLE); /* the derivative at 0 is 0 */
    }
}

/* p_0 in 2 +- 0.1: one zero for each value, all of them in the image. */
TEST(parameters_that_are_balls) {
  OWNED(krawczyk) k;
  OWNED(squares) s = squares_of(3, num_ctx_arb(90));
  struct solve_system system = {3, squares_values, &s};
  mag_set_d(arb_radref(s.off), 0.1);
  OWNED(num_vec) x = vec_new(3, s.ctx);
  krawczyk_init(&k, &system, 90);
  start_at(&x, 0);
  ck_assert_int_eq(krawczyk_centre(&k, &x), SS_OK);
  ck_assert_int_eq(krawczyk_follow(&k, -3), SS_OK);
  for (int end = -1; end <= 1; end++) {
    NUMBERS(arb, root);
    arb_set_d(root, 2 + 0.0999 * end);
    arb_sqrt(root, root, 200);
    ck_assert(arb_contains(num_vec_at(&k.image, 0), root));
  }
  ck_assert_double_lt(mag_get_d(arb_radref((arb_srcptr)num_vec_at(&k.image, 0))), 0.1);
  mag_set_d(arb_radref(s.off), 3); /* 0 is among the parameters */
  ck_assert_int_eq(krawczyk_centre(&k, &x), SS_OK);
  ck_assert_int_eq(krawczyk_follow(&k, -3), SS_UNABLE);
}
