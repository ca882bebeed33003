/* Positive roots of polynomials, found and proved in balls for every number type.

   The coefficients become balls (exact ones for double and mpfr).  A polynomial in x^d is solved in y = x^d, and exact
   coefficients are rid of repeated factors.  Bisection walks from the near end of an interval that holds all positive
   roots: a piece is settled when its Taylor form about the middle shows no root, or a monotone stretch, where the
   signs at the ends tell.  The wanted root is then refined by Newton's method on intervals.  Every decision is made
   for all polynomials in the balls, or not at all: then the precision is raised. */
#include "base/arena.h"
#include "num.h"
#include "num/flint_more.h"

#include <math.h>
#include <stdlib.h>

/* Bits of the first attempt, bits beyond those asked for, the last attempt in units of the precision asked for, and the
   widest gap between coefficients that are made integers over one denominator. */
enum { FIRST_PREC = 64, GUARD = 32, BUDGET = 20, SPREAD_MAX = 100000 };

/* A polynomial about the middle of an interval: p(m + t) for |t| <= r. */
struct taylor {
  arb_poly_t about; /* coefficients in t */
  mag_t rest0;      /* bounds |p(m + t) - p(m)| */
  mag_t rest1;      /* bounds |p'(m + t) - p'(m)| */
};

static void taylor_init(struct taylor *s) {
  *s = (struct taylor){.rest0 = {{0}}};
  arb_poly_init(s->about);
}

static void taylor_clear(struct taylor *s) {
  arb_poly_clear(s->about);
  mag_clear(s->rest0);
  mag_clear(s->rest1);
}

static void taylor_set(struct taylor *s, const arb_poly_t p, const arb_t m, const mag_t r, slong prec) {
  NUMBERS(mag, power, c, slope);
  arb_poly_taylor_shift(s->about, p, m, prec);
  mag_zero(s->rest0);
  mag_zero(s->rest1);
  mag_one(power);
  for (slong i = 1; i < arb_poly_length(s->about); i++) {
    arb_get_mag(c, arb_poly_get_coeff_ptr(s->about, i));
    mag_mul_ui(slope, c, (ulong)i);
    if (i > 1) mag_addmul(s->rest1, slope, power);
    mag_mul(power, power, r);
    mag_addmul(s->rest0, c, power);
  }
}

static bool exceeds(const arb_t x, const mag_t bound) {
  NUMBERS(mag, low);
  arb_get_mag_lower(low, x);
  return mag_cmp(low, bound) > 0;
}

static bool has_no_root(const struct taylor *s) {
  return exceeds(arb_poly_get_coeff_ptr(s->about, 0), s->rest0);
}

/* The slope stays within half of its middle value, and not only away from zero: then a step of Newton's method on the
   interval shrinks it at least threefold. */
static bool is_steep(const struct taylor *s) {
  NUMBERS(mag, twice);
  mag_mul_2exp_si(twice, s->rest1, 1);
  return exceeds(arb_poly_get_coeff_ptr(s->about, 1), twice);
}

/* The sign at an exact point: +1, -1, or 0 when it cannot be told. */
static int sign_at(const arb_poly_t p, const arf_t x, slong prec) {
  NUMBERS(arb, at, v);
  arb_set_arf(at, x);
  arb_poly_evaluate(v, p, at, prec);
  return arb_sgn_nonzero(v);
}

/* A point where the polynomial has a known sign. */
struct post {
  arf_t x;
  int sign;
};

/* The pieces that are still to be looked at lie between consecutive posts; the top is the nearest. */
struct posts {
  struct post *at;
  size_t len, cap;
};

static void push(struct posts *s, const struct post *p) {
  struct post *top = SS_PUSH(s->at, s->len, s->cap);
  *top = (struct post){.sign = p->sign};
  arf_set(top->x, p->x);
}

static void pop(struct post *p, struct posts *s) {
  struct post *top = &s->at[--s->len];
  arf_swap(p->x, top->x);
  arf_clear(top->x);
  p->sign = top->sign;
}

static void posts_clear(struct posts *s) {
  while (s->len > 0) arf_clear(s->at[--s->len].x);
  free(s->at);
}

/* A post between a and b, 0 < a < b: near the geometric mean when they are far apart, else near the middle.  As a sign
   that is zero or cannot be told must be avoided, more places are tried than the polynomial has roots.
   false when no sign can be told, or when a and b agree to prec bits. */
static bool split(struct post *out, const arb_poly_t p, const arf_t a, const arf_t b, slong prec) {
  int grid = (int)FLINT_BIT_COUNT((ulong)arb_poly_length(p)) + 1;
  slong half = WORD(1) << (grid - 1);
  NUMBERS(arf, low, width);
  NUMBERS(fmpz, e);
  fmpz_sub(e, ARF_EXPREF(b), ARF_EXPREF(a));
  if (fmpz_cmp_si(e, 3) >= 0) {
    fmpz_add(e, ARF_EXPREF(a), ARF_EXPREF(b));
    fmpz_fdiv_q_2exp(e, e, 1);
    arf_one(low);
    arf_mul_2exp_fmpz(low, low, e);
    arf_set(width, low);
  } else {
    arf_set(low, a);
    arf_sub(width, b, a, ARF_PREC_EXACT, ARF_RND_DOWN);
  }
  fmpz_sub(e, ARF_EXPREF(low), ARF_EXPREF(width));
  out->sign = 0;
  for (slong i = 0; i < 2 * half - 1 && out->sign == 0 && fmpz_cmp_si(e, prec) < 0; i++) {
    slong place = half + (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
    arf_mul_si(out->x, width, place, ARF_PREC_EXACT, ARF_RND_DOWN);
    arf_mul_2exp_si(out->x, out->x, -grid);
    arf_add(out->x, out->x, low, ARF_PREC_EXACT, ARF_RND_DOWN);
    out->sign = sign_at(p, out->x, prec);
  }
  return out->sign != 0;
}

/* Powers of two around all positive roots, low < x < high.  false when an end coefficient may be zero. */
static bool root_bounds(arf_t low, arf_t high, const arb_poly_t p) {
  slong n = arb_poly_length(p);
  NUMBERS(arb_poly, reversed);
  NUMBERS(mag, m);
  arb_poly_fit_length(reversed, n);
  _arb_poly_reverse(reversed->coeffs, p->coeffs, n, n);
  _arb_poly_root_bound_fujiwara(m, p->coeffs, n);
  bool ok = mag_is_finite(m);
  arf_set_mag(high, m);
  _arb_poly_root_bound_fujiwara(m, reversed->coeffs, n);
  ok = ok && mag_is_finite(m);
  arf_set_mag(low, m);
  if (ok) { /* |x| < 2^(exponent) strictly; without roots but zero the bound may be zero itself */
    NUMBERS(fmpz, e);
    fmpz_set(e, ARF_EXPREF(high));
    arf_one(high);
    arf_mul_2exp_fmpz(high, high, e);
    fmpz_neg(e, ARF_EXPREF(low));
    arf_one(low);
    arf_mul_2exp_fmpz(low, low, e);
  }
  return ok;
}

/* Finds the |k|-th root from the near end (k > 0: from below) and sets x to a ball in which every polynomial of the
   balls is steep and changes its sign.  SS_DOMAIN when there are fewer, SS_UNABLE when prec bits cannot tell. */
static int isolate(arb_t x, const arb_poly_t p, slong k, slong prec) {
  OWNED(posts) posts = {NULL, 0, 0};
  struct post near = {.sign = 0}, next = near;
  LOCAL(taylor, s);
  NUMBERS(arb, middle);
  NUMBERS(arf, low, high);
  ulong wanted = k > 0 ? (ulong)k : -(ulong)k;
  int status = SS_UNABLE;
  if (root_bounds(low, high, p)) {
    arf_set(near.x, k > 0 ? low : high);
    near.sign = sign_at(p, near.x, prec);
    arf_set(next.x, k > 0 ? high : low);
    next.sign = sign_at(p, next.x, prec);
    push(&posts, &next);
    if (near.sign != 0 && next.sign != 0) status = SS_DOMAIN;
  }
  while (status == SS_DOMAIN && posts.len > 0) {
    const struct post *far = &posts.at[posts.len - 1];
    const arf_struct *a = k > 0 ? near.x : far->x, *b = k > 0 ? far->x : near.x;
    arb_set_interval_arf(x, a, b, prec + GUARD);
    arb_get_mid_arb(middle, x);
    taylor_set(&s, p, middle, arb_radref(x), prec);
    bool steep = is_steep(&s);
    if (steep && near.sign != far->sign && --wanted == 0)
      status = SS_OK;
    else if (steep || has_no_root(&s))
      pop(&near, &posts);
    else if (split(&next, p, a, b, prec))
      push(&posts, &next);
    else
      status = SS_UNABLE;
  }
  arf_clear(near.x);
  arf_clear(next.x);
  return status;
}

/* y = x cut with Newton's interval m - p(m)/p'(x), where x holds one root of each polynomial of the balls. */
static void newton_step(arb_t y, const arb_t x, const arb_poly_t p, struct taylor *s, slong prec) {
  NUMBERS(arb, m, slope);
  arb_get_mid_arb(m, x);
  taylor_set(s, p, m, arb_radref(x), prec);
  arb_set(slope, arb_poly_get_coeff_ptr(s->about, 1));
  arb_add_error_mag(slope, s->rest1);
  arb_div(y, arb_poly_get_coeff_ptr(s->about, 0), slope, prec);
  arb_sub(y, m, y, prec);
  if (!arb_is_finite(y))
    arb_set(y, x);
  else if (!arb_intersection(y, y, x, prec))
    abort(); /* both hold the root */
}

/* Relative accuracy in bits, not below 0: a ball around 0 has none. */
static slong accuracy(const arb_t x) {
  return FLINT_MAX(0, arb_rel_accuracy_bits(x));
}

/* Shrinks x around its root until it has goal bits or, with prec bits, nothing is gained any more.  The precision of
   a step is twice what is known, and more when that brings nothing. */
static void refine(arb_t x, const arb_poly_t p, slong goal, slong prec) {
  LOCAL(taylor, s);
  NUMBERS(arb, y);
  NUMBERS(mag, half);
  slong wp = FIRST_PREC;
  bool stuck = false;
  while (!stuck && accuracy(x) < goal) {
    wp = FLINT_MIN(prec, FLINT_MAX(wp, 2 * accuracy(x) + FIRST_PREC));
    newton_step(y, x, p, &s, wp);
    mag_mul_2exp_si(half, arb_radref(x), -1);
    bool gained = mag_cmp(arb_radref(y), half) < 0;
    stuck = !gained && wp == prec;
    if (gained)
      arb_swap(x, y);
    else
      wp *= 2;
  }
}

/* Reads the coefficients as balls; false when one is not a number.  Exact zeros at the low end are roots at 0 and are
   dropped, those at the high end too; *exact tells whether all the others are exact. */
static bool read_coefficients(arb_poly_t p, bool *exact, const struct num_vec *coeffs) {
  const struct num_type *f = coeffs->ctx.type;
  slong zeros = 0;
  bool finite = true;
  NUMBERS(arb, c);
  *exact = true;
  for (slong i = 0; i < coeffs->len; i++) {
    f->get_arb(c, num_vec_at(coeffs, i));
    finite = finite && arb_is_finite(c);
    *exact = *exact && arb_is_exact(c);
    if (zeros == i && arb_is_zero(c))
      zeros++;
    else
      arb_poly_set_coeff_arb(p, i - zeros, c);
  }
  _arb_poly_normalise(p);
  return finite;
}

/* Turns p(x) = q(x^d), d as large as can be, into q and returns d.  This halves the time for an even quartic. */
static ulong deflate(arb_poly_t p) {
  slong n = arb_poly_length(p);
  ulong d = (ulong)n - 1;
  for (slong i = 1; i < n; i++)
    if (!arb_is_zero(arb_poly_get_coeff_ptr(p, i))) d = n_gcd(d, (ulong)i);
  for (slong i = 1; i * (slong)d < n; i++) arb_swap(p->coeffs + i, p->coeffs + i * (slong)d);
  _arb_poly_set_length(p, (n - 1) / (slong)d + 1);
  return d;
}

/* Exact coefficients as integers, times a power of two; false when their sizes lie too far apart. */
static bool to_integers(fmpz_poly_t f, const arb_poly_t p) {
  slong n = arb_poly_length(p);
  fmpz *part = _fmpz_vec_init(2 * n), *exponent = part + n;
  NUMBERS(fmpz, least, most);
  for (slong i = 0, seen = 0; i < n; i++) {
    if (arb_is_zero(p->coeffs + i)) continue;
    arf_get_fmpz_2exp(part + i, exponent + i, arb_midref(p->coeffs + i));
    if (seen == 0 || fmpz_cmp(exponent + i, least) < 0) fmpz_set(least, exponent + i);
    if (seen == 0 || fmpz_cmp(exponent + i, most) > 0) fmpz_set(most, exponent + i);
    seen = 1;
  }
  fmpz_sub(most, most, least);
  bool ok = fmpz_cmp_si(most, SPREAD_MAX) <= 0;
  for (slong i = 0; i < n && ok; i++) {
    if (fmpz_is_zero(part + i)) continue;
    fmpz_sub(exponent + i, exponent + i, least);
    fmpz_mul_2exp(part + i, part + i, fmpz_get_ui(exponent + i));
    fmpz_poly_set_coeff_fmpz(f, i, part + i);
  }
  _fmpz_vec_clear(part, 2 * n);
  return ok;
}

/* p without repeated factors: p / gcd(p, p'). */
static void make_square_free(arb_poly_t p) {
  NUMBERS(fmpz_poly, f, g);
  if (to_integers(f, p)) {
    fmpz_poly_derivative(g, f);
    fmpz_poly_gcd(g, f, g);
    if (fmpz_poly_degree(g) > 0) {
      fmpz_poly_div(f, f, g);
      arb_poly_set_fmpz_poly(p, f, ARF_PREC_EXACT);
    }
  }
}

/* Whether the k-th positive root of a quadratic, or that there is none, is known to goal bits from the formula; far
   cheaper than bisection.  Of the two signs before the square root that is taken which cancels nothing. */
static bool quadratic_root(int *status, arb_t x, const arb_poly_t p, slong k, slong goal) {
  arb_srcptr c = p->coeffs;
  slong prec = goal + GUARD;
  NUMBERS(arb, root, other);
  arb_sqr(root, c + 1, prec);
  arb_mul(other, c, c + 2, prec);
  arb_mul_2exp_si(other, other, 2);
  arb_sub(root, root, other, prec);
  if (!arb_is_positive(root)) return false;
  arb_sqrt(root, root, prec);
  (arb_is_negative(c + 1) ? arb_sub : arb_add)(other, c + 1, root, prec);
  arb_mul_2exp_si(other, other, -1);
  arb_neg(other, other);
  arb_div(root, other, c + 2, prec);
  arb_div(other, c, other, prec);
  if (accuracy(root) < goal || accuracy(other) < goal || arb_overlaps(root, other)) return false;
  if (arb_gt(root, other)) arb_swap(root, other);
  int n = arb_is_positive(root) + arb_is_positive(other);
  *status = (k > 0 ? k : -k) > n ? SS_DOMAIN : SS_OK;
  arb_set(x, n == 2 && (k == 1 || k == -2) ? root : other);
  return true;
}

/* The k-th positive root of p as a ball, to prec bits if the coefficients allow. */
static int positive_root(arb_t x, arb_poly_t p, bool exact, slong k, slong prec) {
  slong most = BUDGET * FLINT_MAX(prec, FIRST_PREC), goal = prec + GUARD, wp = FIRST_PREC;
  if (arb_poly_length(p) < 2 || k == 0) return SS_DOMAIN;
  ulong d = deflate(p);
  int status;
  if (exact && arb_poly_length(p) == 3 && quadratic_root(&status, x, p, k, goal)) {
    if (status == SS_OK) arb_root_ui(x, x, d, goal);
    return status;
  }
  if (exact) make_square_free(p);
  status = isolate(x, p, k, wp);
  while (status == SS_UNABLE && wp < most) {
    wp = FLINT_MIN(2 * wp, most);
    status = isolate(x, p, k, wp);
  }
  if (status != SS_OK) return status;
  slong known = -1;
  for (wp = goal + GUARD; accuracy(x) > known && wp <= most; wp *= 2) {
    known = accuracy(x);
    refine(x, p, goal, wp);
  }
  if (exact && accuracy(x) < goal) return SS_UNABLE;
  arb_root_ui(x, x, d, goal);
  return SS_OK;
}

static int isolated_root(void *z, const struct num_vec *coeffs, slong k) {
  const struct num_type *f = coeffs->ctx.type;
  slong prec = coeffs->ctx.prec;
  NUMBERS(arb_poly, p);
  NUMBERS(arb, x);
  bool exact;
  int status = read_coefficients(p, &exact, coeffs) ? positive_root(x, p, exact, k, prec) : SS_UNABLE;
  if (status == SS_OK) {
    if (f->rigorous) arb_set_round(x, x, prec);
    status = f->set_arb(z, x, prec);
  } else {
    f->set_d(z, (double)NAN, prec);
  }
  return status;
}

/* A root is asked for at one set of parameters and many times, and finding it costs more than all the rest: the last
   few are kept, of doubles and of balls that own no memory, up to 128 bits or so. */
enum { KEPT = 8, KEPT_LENGTH = 8 };
struct kept {
  const struct num_type *type;
  slong len, k, prec;
  arb_struct coeff[KEPT_LENGTH], root;
  int status;
};
static _Thread_local struct kept kept[KEPT];
static _Thread_local int next_kept;

/* x as a ball that owns no memory; false, and nothing to be cleared, where it would. */
static bool take_light(arb_t ball, const struct num_type *type, const void *x) {
  type->get_arb(ball, x);
  bool light = !ARF_HAS_PTR(arb_midref(ball)) && !COEFF_IS_MPZ(ARF_EXP(arb_midref(ball))) &&
               !COEFF_IS_MPZ(MAG_EXP(arb_radref(ball)));
  if (!light) arb_clear(ball);
  return light;
}

static bool same_question(const struct kept *a, const struct kept *b) {
  bool same = a->type == b->type && a->len == b->len && a->k == b->k && a->prec == b->prec;
  for (slong i = 0; same && i < a->len; i++) same = arb_equal(&a->coeff[i], &b->coeff[i]);
  return same;
}

int num_poly_root(void *z, const struct num_vec *coeffs, slong k) {
  const struct num_type *type = coeffs->ctx.type;
  struct kept now = {.type = type, .len = coeffs->len, .k = k, .prec = coeffs->ctx.prec};
  bool light = now.len >= 1 && now.len <= KEPT_LENGTH && (type == &num_double || type == &num_arb);
  for (slong i = 0; light && i < now.len; i++) light = take_light(&now.coeff[i], type, num_vec_at(coeffs, i));
  if (!light) return isolated_root(z, coeffs, k);
  for (int i = 0; i < KEPT; i++)
    if (same_question(&kept[i], &now)) {
      type->set_arb(z, &kept[i].root, now.prec);
      return kept[i].status;
    }
  now.status = isolated_root(z, coeffs, k);
  if (!take_light(&now.root, type, z)) return now.status;
  kept[next_kept] = now;
  next_kept = (next_kept + 1) % KEPT;
  return now.status;
}
