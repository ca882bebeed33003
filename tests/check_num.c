/* Tests of the number module beyond the laws of laws_num.c: vectors and matrices against FLINT's integer matrices,
   roots against polynomials made from chosen roots. */
#include "laws_num.h"
#include "num/calc.h"
#include "num/flint_more.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

#include <flint/fmpz_mat.h>
#include <signal.h>

static void put(struct num_vec *v, slong i, double x) {
  if (v->ctx.type->set_d(num_vec_at(v, i), x, v->ctx.prec) != SS_OK) ck_abort_msg("set_d");
}

/* |element i - q| <= eps times max(1, |q|), or the ball holds q with at most that radius. */
static bool is_close(const struct num_vec *v, slong i, const fmpq_t q, double eps) {
  NUMBERS(arb, x, exact, bound, error);
  v->ctx.type->get_arb(x, num_vec_at(v, i));
  arb_set_fmpq(exact, q, 600);
  arb_abs(bound, exact);
  arb_one(error);
  arb_max(bound, bound, error, 600);
  arb_set_d(error, eps);
  arb_mul(bound, bound, error, 600);
  arb_sub(error, x, exact, 600);
  arb_abs(error, error);
  return (!v->ctx.type->rigorous || arb_contains_fmpq(x, q)) && arb_le(error, bound);
}

static bool is_nan(const struct num_vec *v, slong i) {
  return isnan(v->ctx.type->get_d(num_vec_at(v, i)));
}

static bool same(const struct num_vec *v, const struct num_vec *w) {
  NUMBERS(arb, x, y);
  bool yes = v->len == w->len;
  for (slong i = 0; i < v->len && yes; i++) {
    v->ctx.type->get_arb(x, num_vec_at(v, i));
    v->ctx.type->get_arb(y, num_vec_at(w, i));
    yes = arb_equal(x, y);
  }
  return yes;
}

/* --- Vectors and matrices. --- */

static slong outside;

static void take_outside(void) {
  struct num_vec v;
  num_vec_init(&v, 3, num_ctx_double());
  num_vec_at(&v, outside);
}

TEST_EACH(out_of_range_aborts, 2) {
  outside = _i == 0 ? -1 : 3;
  ck_assert_int_eq(child_end(take_outside), -SIGABRT);
}

OWNED_CLEARING(fmpz_mat)

static void from_integers(struct num_vec *v, const fmpz_mat_t a) {
  slong cols = fmpz_mat_ncols(a);
  for (slong i = 0; i < v->len; i++) put(v, i, fmpz_get_d(fmpz_mat_entry(a, i / cols, i % cols)));
}

static void random_integers(fmpz_mat_t a, struct rng *r, slong size) {
  for (slong i = 0; i < fmpz_mat_nrows(a); i++)
    for (slong j = 0; j < fmpz_mat_ncols(a); j++) fmpz_set_si(fmpz_mat_entry(a, i, j), rng_between(r, -size, size));
}

static bool are_integers(const struct num_vec *v, const fmpz_mat_t a, double eps) {
  slong cols = fmpz_mat_ncols(a);
  NUMBERS(fmpq, q);
  bool ok = true;
  for (slong i = 0; i < v->len && ok; i++) {
    fmpq_set_fmpz(q, fmpz_mat_entry(a, i / cols, i % cols));
    ok = is_close(v, i, q, eps);
  }
  return ok;
}

/* Integer entries small enough for every type to be exact: the product must be FLINT's. */
TEST_EACH(products, LAW_CONTEXTS) {
  for (uint64_t seed = 1; seed <= 60; seed++) {
    struct rng r = {seed};
    slong m = rng_between(&r, 1, 4), n = rng_between(&r, 1, 4), p = rng_between(&r, 1, 4);
    SIZED(fmpz_mat, a, m, n);
    SIZED(fmpz_mat, b, n, p);
    SIZED(fmpz_mat, c, m, p);
    OWNED(num_vec) x = vec_new(m * n, law_context(_i)), y = vec_new(n * p, law_context(_i));
    OWNED(num_vec) z = vec_new(m * p, law_context(_i));
    random_integers(a, &r, 100);
    random_integers(b, &r, 100);
    fmpz_mat_mul(c, a, b);
    from_integers(&x, a);
    from_integers(&y, b);
    ck_assert_msg(num_mat_mul(&z, &x, &y, m, n, p) == SS_OK && are_integers(&z, c, 0), "seed %d", (int)seed);
    if (n == p && num_mat_mul(&x, &x, &y, m, n, n) == SS_OK) ck_assert_msg(same(&x, &z), "z = x, seed %d", (int)seed);
    from_integers(&x, a);
    if (m == n && num_mat_mul(&y, &x, &y, n, n, p) == SS_OK) ck_assert_msg(same(&y, &z), "z = y, seed %d", (int)seed);
    if (m == n) {
      OWNED(num_vec) square = vec_new(n * n, x.ctx);
      ck_assert(num_mat_mul(&square, &x, &x, n, n, n) == SS_OK && num_mat_mul(&x, &x, &x, n, n, n) == SS_OK);
      ck_assert_msg(same(&square, &x), "z = x = y, seed %d", (int)seed);
    }
  }
}

/* a x = b with chosen integers x; entries up to 20, so that the error stays below 2^16 units for nearly singular a. */
TEST_EACH(solutions_and_determinants, LAW_CONTEXTS) {
  struct num_ctx ctx = law_context(_i);
  double eps = ldexp(1, 18 - (int)ctx.prec);
  int solved = 0;
  for (uint64_t seed = 1; seed <= 150; seed++) {
    struct rng r = {seed};
    slong n = rng_between(&r, 1, 5), p = rng_between(&r, 1, 3);
    SIZED(fmpz_mat, a, n, n);
    SIZED(fmpz_mat, x, n, p);
    SIZED(fmpz_mat, b, n, p);
    SIZED(fmpz_mat, det, 1, 1);
    OWNED(num_vec) na = vec_new(n * n, ctx), nb = vec_new(n * p, ctx), nx = vec_new(n * p, ctx);
    random_integers(a, &r, 20);
    random_integers(x, &r, 20);
    fmpz_mat_mul(b, a, x);
    fmpz_mat_det(fmpz_mat_entry(det, 0, 0), a);
    from_integers(&na, a);
    from_integers(&nb, b);
    int status = num_mat_solve(&nx, &na, &nb, n, p);
    if (fmpz_is_zero(fmpz_mat_entry(det, 0, 0))) {
      ck_assert_msg(status != SS_OK || !ctx.type->rigorous, "a singular matrix was solved, seed %d", (int)seed);
    } else {
      solved++;
      ck_assert_msg(status == SS_OK && are_integers(&nx, x, eps), "seed %d", (int)seed);
      ck_assert(num_mat_solve(&nb, &na, &nb, n, p) == SS_OK);
      ck_assert_msg(same(&nx, &nb), "x = b, seed %d", (int)seed);
    }
    OWNED(num_vec) d = vec_new(1, ctx);
    status = num_mat_det(num_vec_at(&d, 0), &na, n);
    double scale = pow(20, (double)n); /* the determinant's own error is relative to its terms */
    ck_assert_msg(status == SS_OK && are_integers(&d, det, eps * scale), "determinant, seed %d", (int)seed);
  }
  ck_assert_int_gt(solved, 100);
}

static void fill(struct num_vec *v, const double *x) {
  for (slong i = 0; i < v->len; i++) put(v, i, x[i]);
}

/* An entry that overflows on the way is lost whatever it would come to, and no other entry is. */
TEST(products_that_cannot_be_held) {
  OWNED(num_vec) x = vec_new(4, num_ctx_double()), y = vec_new(2, num_ctx_double()), z = vec_new(2, num_ctx_double());
  const double factors[] = {1e300, -1e300, 1, 2};
  for (slong i = 0; i < 4; i++) put(&x, i, factors[i]);
  for (slong i = 0; i < 2; i++) put(&y, i, 1e300);
  ck_assert_int_eq(num_mat_mul(&z, &x, &y, 2, 2, 1), SS_UNABLE);
  ck_assert(is_nan(&z, 0) && *(double *)num_vec_at(&z, 1) == 3e300);
}

/* Elimination is exact on these, whatever the type. */
TEST_EACH(singular_matrices, LAW_CONTEXTS) {
  static const double singular[][9] = {{0, 0, 0, 0, 0, 0, 0, 0, 0},
                                       {1, 2, 3, 2, 4, 6, 1, 1, 1},
                                       {1, 0, 2, 3, 0, 4, 5, 0, 6},
                                       {4, 2, 1, 2, 1, 0.5, 1, 0.5, 0.25}};
  OWNED(num_vec) a = vec_new(9, law_context(_i)), b = vec_new(3, law_context(_i));
  OWNED(num_vec) x = vec_new(3, law_context(_i)), d = vec_new(1, law_context(_i));
  for (size_t i = 0; i < COUNT(singular); i++) {
    fill(&a, singular[i]);
    ck_assert_int_eq(num_mat_solve(&x, &a, &b, 3, 1), SS_DOMAIN);
    ck_assert(is_nan(&x, 0) && is_nan(&x, 2));
    put(&d, 0, 5);
    ck_assert_int_eq(num_mat_det(num_vec_at(&d, 0), &a, 3), SS_OK);
    ck_assert(d.ctx.type->is_zero(num_vec_at(&d, 0)) == TRUTH_TRUE);
  }
  /* a zero in the first place needs a swap of rows, which changes the sign */
  fill(&a, (const double[]){0, 2, 0, 4, 0, 0, 0, 0, 8});
  fill(&b, (const double[]){6, 4, 8});
  ck_assert_int_eq(num_mat_solve(&x, &a, &b, 3, 1), SS_OK);
  static const double expected[] = {1, 3, 1};
  for (slong i = 0; i < 3; i++) ck_assert(x.ctx.type->get_d(num_vec_at(&x, i)) == expected[i]);
  ck_assert_int_eq(num_mat_det(num_vec_at(&d, 0), &a, 3), SS_OK);
  ck_assert(d.ctx.type->get_d(num_vec_at(&d, 0)) == -64);
}

TEST(pivots_that_cannot_be_told) {
  struct num_ctx ctx = num_ctx_arb(100);
  OWNED(num_vec) a = vec_new(4, ctx), b = vec_new(2, ctx), d = vec_new(1, ctx);
  fill(&a, (const double[]){0, 1, 0, 1});
  arb_struct *corner = num_vec_at(&a, 0);
  mag_set_d(arb_radref(corner), 1e-9);
  fill(&b, (const double[]){1, 1});
  ck_assert_int_eq(num_mat_solve(&b, &a, &b, 2, 1), SS_UNABLE);
  ck_assert(is_nan(&b, 0) && is_nan(&b, 1));
  ck_assert_int_eq(num_mat_det(num_vec_at(&d, 0), &a, 2), SS_UNABLE);
  /* |1 1; 1 1 +- r| is around zero, but enclosed all the same */
  fill(&a, (const double[]){1, 1, 1, 1});
  mag_set_d(arb_radref((arb_struct *)num_vec_at(&a, 3)), 1e-9);
  ck_assert_int_eq(num_mat_det(num_vec_at(&d, 0), &a, 2), SS_OK);
  ck_assert(arb_contains_zero(num_vec_at(&d, 0)) && d.ctx.type->is_zero(num_vec_at(&d, 0)) == TRUTH_UNKNOWN);
  /* 1/4 below is the pivot, not the larger middle of a ball around zero; the second one is 1 - [-1, 5]/8 then */
  fill(&a, (const double[]){0.5, 1, 0.25, 0.125});
  mag_set_ui_2exp_si(arb_radref((arb_struct *)num_vec_at(&a, 0)), 3, -2);
  ck_assert_int_eq(num_mat_solve(&b, &a, &b, 2, 1), SS_UNABLE); /* b is NaN */
  fill(&b, (const double[]){1, 1});
  ck_assert_int_eq(num_mat_solve(&b, &a, &b, 2, 1), SS_OK);
}

/* --- Roots. --- */

static int compare(const void *x, const void *y) {
  const double *a = x, *b = y;
  return (*a > *b) - (*a < *b);
}

/* The product of the (x - r[i]) as integers; each r[i] is a multiple of 1/8 (8x - 8r then). */
static void from_roots(fmpz_poly_t f, const double *r, slong n) {
  NUMBERS(fmpz_poly, factor);
  fmpz_poly_one(f);
  for (slong i = 0; i < n; i++) {
    fmpz_poly_set_coeff_si(factor, 1, 8);
    fmpz_poly_set_coeff_si(factor, 0, -(slong)(8 * r[i]));
    fmpz_poly_mul(f, f, factor);
  }
}

static void set_coefficients(struct num_vec *c, const fmpz_poly_t f) {
  NUMBERS(fmpq, q);
  for (slong i = 0; i < c->len; i++) {
    fmpz_poly_get_coeff_fmpz(fmpq_numref(q), f, i);
    fmpz_one(fmpq_denref(q));
    if (c->ctx.type->set_q(num_vec_at(c, i), q, c->ctx.prec) != SS_OK) ck_abort_msg("set_q");
  }
}

/* Random roots, some repeated, some negative or zero, and a factor x^2 + 1 now and then: every index, from both ends,
   and one too far.  The coefficients are exact in every context used. */
static void check_known_roots(struct num_ctx ctx, uint64_t seed) {
  struct rng r = {seed};
  slong n = rng_between(&r, 0, 6), distinct = 0;
  double roots[6], positive[6];
  NUMBERS(fmpz_poly, f);
  OWNED(num_vec) c, z = vec_new(1, ctx);
  for (slong i = 0; i < n; i++) {
    bool again = i > 0 && rng_between(&r, 0, 3) == 0;
    roots[i] = again ? roots[i - 1] : (double)rng_between(&r, -8, 24) / (double)(1 << rng_between(&r, 0, 3));
    if (roots[i] > 0 && !again) positive[distinct++] = roots[i];
  }
  qsort(positive, (size_t)distinct, sizeof *positive, compare);
  slong kept = 0;
  for (slong i = 0; i < distinct; i++)
    if (kept == 0 || positive[kept - 1] != positive[i]) positive[kept++] = positive[i];
  distinct = kept;
  from_roots(f, roots, n);
  if (rng_between(&r, 0, 2) == 0) {
    NUMBERS(fmpz_poly, g);
    fmpz_poly_set_coeff_si(g, 0, 1);
    fmpz_poly_set_coeff_si(g, 2, 1);
    fmpz_poly_mul(f, f, g);
  }
  num_vec_init(&c, fmpz_poly_length(f) + 1, ctx); /* one zero coefficient too many */
  set_coefficients(&c, f);
  NUMBERS(fmpq, q);
  for (slong k = 1; k <= distinct; k++) {
    NUMBERS(arf, x);
    arf_set_d(x, positive[k - 1]);
    arf_get_fmpq(q, x);
    double eps = ldexp(1, 2 - (int)ctx.prec);
    int status = num_poly_root(num_vec_at(&z, 0), &c, k);
    ck_assert_msg(status == SS_OK && is_close(&z, 0, q, eps), "%s root %d, seed %d", ctx.type->name, (int)k, (int)seed);
    status = num_poly_root(num_vec_at(&z, 0), &c, k - 1 - distinct);
    ck_assert_msg(status == SS_OK && is_close(&z, 0, q, eps), "%s root %d from above, seed %d", ctx.type->name,
                  (int)(distinct + 1 - k), (int)seed);
  }
  int above = num_poly_root(num_vec_at(&z, 0), &c, distinct + 1);
  ck_assert_msg(above == SS_DOMAIN && is_nan(&z, 0), "one root too many, seed %d", (int)seed);
  put(&z, 0, 1);
  int below = num_poly_root(num_vec_at(&z, 0), &c, -distinct - 1);
  ck_assert_msg(below == SS_DOMAIN && is_nan(&z, 0), "one root too many from above, seed %d", (int)seed);
}

TEST_EACH(known_roots, 5) {
  const struct num_ctx contexts[] = {num_ctx_double(), num_ctx_mpfr(64), num_ctx_mpfr(300), num_ctx_arb(64),
                                     num_ctx_arb(300)};
  for (uint64_t seed = 1; seed <= 200; seed++) check_known_roots(contexts[_i], seed);
}

TABLE(asked_roots, "tests/cases/polynomial_roots.tsv", 6);
enum { OF_TYPE, COEFFICIENTS, RADII, WHICH, ENDS, ROOT }; /* its columns */

/* Coefficients from the constant one up, some with a radius 2^e. */
static void read_polynomial(struct num_vec *c, char *const *row) {
  const char *x = row[COEFFICIENTS], *radius = row[RADII];
  char *end;
  for (slong i = 0; i < c->len; i++, x = end) c->ctx.type->set_d(num_vec_at(c, i), strtod(x, &end), c->ctx.prec);
  for (slong i = 0; *radius; i++, radius += strcspn(radius, " ") + 1) {
    if (*radius != '.') mag_set_ui_2exp_si(arb_radref((arb_struct *)num_vec_at(c, i)), 1, strtol(radius, NULL, 10));
    if (!strchr(radius, ' ')) break;
  }
}

/* The root as a number of the type holds it: rounded once, or in a ball that is narrow. */
static void check_root(const struct num_vec *z, const char *root) {
  NUMBERS(arb, exact, x);
  OWNED(num_vec) rounded = vec_new(1, z->ctx);
  ck_assert_int_eq(arb_set_str(exact, root, 400), 0);
  z->ctx.type->get_arb(x, num_vec_at(z, 0));
  z->ctx.type->set_arb(num_vec_at(&rounded, 0), exact, z->ctx.prec);
  ck_assert_msg(z->ctx.type->rigorous ? arb_overlaps(x, exact) && arb_rel_accuracy_bits(x) >= z->ctx.prec - 3
                                      : same(z, &rounded),
                "%s", root);
}

TEST_EACH(roots_as_asked_for, LAW_CONTEXTS) {
  static const char *const statuses[] = {[SS_OK] = "ok", [SS_DOMAIN] = "domain", [SS_UNABLE] = "unable"};
  struct num_ctx ctx = law_context(_i);
  for (int i = 0; i < asked_roots.n; i++) {
    char *const *row = asked_roots.row[i];
    if (*row[OF_TYPE] && strcmp(row[OF_TYPE], ctx.type->name) != 0) continue;
    slong n = 1;
    for (const char *p = row[COEFFICIENTS]; *p; p++) n += *p == ' ';
    OWNED(num_vec) c = vec_new(n, ctx), z = vec_new(1, ctx);
    read_polynomial(&c, row);
    char *which = row[WHICH];
    do {
      int status = num_poly_root(num_vec_at(&z, 0), &c, strtol(which, &which, 10));
      ck_assert_msg(strcmp(statuses[status], row[ENDS]) == 0, "%s: %s", row[COEFFICIENTS], statuses[status]);
      ck_assert((status != SS_OK) == is_nan(&z, 0));
      if (status == SS_OK) check_root(&z, row[ROOT]);
    } while (*which);
  }
}

/* Sine and cosine in MPFR are correctly rounded, so that MPFR's own functions are the oracle, bit for bit: at ordinary
   arguments, near zeros of either, at tiny and at large ones, for every precision on the way. */
TEST(sines_are_rounded_as_mpfr_does) {
  static const slong precs[] = {2, 53, 64, 128, 160, 256, 500, 1100};
  struct rng r = {30};
  for (int n = 0; n < 2400; n++) {
    slong prec = precs[n % 8];
    NUMBERS(arb, ball);
    OWNED(num_vec) v = vec_new(3, num_ctx_mpfr(prec));
    MPFR_NUMBERS(prec, x, s, c);
    if (n % 3 == 0) { /* a multiple of pi/2, rounded */
      arb_const_pi(ball, prec + 40);
      arb_mul_ui(ball, ball, (ulong)rng_between(&r, 1, 1000), prec + 40);
      arb_mul_2exp_si(ball, ball, -1);
    } else {
      rng_edge(arb_midref(ball), &r, prec, n % 3 == 1 ? 8 : 512);
    }
    arf_get_mpfr(x, arb_midref(ball), MPFR_RNDN);
    num_mpfr.set(num_vec_at(&v, 0), x);
    ck_assert_int_eq(num_mpfr.sin_cos(num_vec_at(&v, 1), num_vec_at(&v, 2), num_vec_at(&v, 0), prec), SS_OK);
    mpfr_sin_cos(s, c, x, MPFR_RNDN);
    bool same = mpfr_equal_p(s, (mpfr_srcptr)num_vec_at(&v, 1)) && mpfr_equal_p(c, (mpfr_srcptr)num_vec_at(&v, 2));
    ck_assert_msg(same, "case %d at %ld bits: sines %g %g, cosines %g %g", n, (long)prec, mpfr_get_d(s, MPFR_RNDN),
                  num_mpfr.get_d(num_vec_at(&v, 1)), mpfr_get_d(c, MPFR_RNDN), num_mpfr.get_d(num_vec_at(&v, 2)));
  }
}

/* (x - a)(x - b) of different a and b, at two precisions, in an order that brings each back before and after others
   have pushed it out: a root that is kept is the one that a first question gets, and no other polynomial's. */
TEST(a_root_asked_again_is_the_same) {
  enum { N = 7, ROUNDS = 5 };
  BALLS(2 * N, first);
  for (int n = 0; n < ROUNDS * 2 * N; n++) {
    int i = n < 2 * N ? n / 2 : (n * n + 3 * n) % N, p = n % 2;
    OWNED(num_vec) c = vec_new(4, num_ctx_arb(p ? 128 : 96));
    put(&c, 0, (i + 1) * 3.25);
    put(&c, 1, -(i + 1) - 3.25);
    put(&c, 2, 1);
    if (i % 3) arb_add_error_2exp_si(num_vec_at(&c, 0), -90);
    struct num_vec coeffs = {c.ctx, 3, c.data};
    bool aliased = n % 5 == 4; /* the output is a coefficient */
    void *z = num_vec_at(&c, aliased ? 0 : 3);
    ck_assert_int_eq(num_poly_root(z, &coeffs, i < 3 ? 1 : -1), SS_OK);
    arb_ptr x = z;
    if (n < 2 * N) arb_set(first + 2 * i + p, x);
    ck_assert_msg(arb_equal(x, first + 2 * i + p), "question %d", n);
    ck_assert_msg(arb_contains_si(x, i + 1) && arb_rel_accuracy_bits(x) > (i % 3 || !p ? 70 : 120), "question %d", n);
  }
}

/* Coefficients that are balls: the answer must hold the root of every polynomial in them, here of random ones made from
   roots near 1 and 3, and widen with the coefficients. */
TEST(roots_of_balls) {
  struct num_ctx ctx = num_ctx_arb(128);
  OWNED(num_vec) c = vec_new(3, ctx), z = vec_new(1, ctx);
  fill(&c, (const double[]){3, -4, 1});
  for (slong i = 0; i < 3; i++) mag_set_ui_2exp_si(arb_radref((arb_struct *)num_vec_at(&c, i)), 1, -10);
  for (slong k = 1; k <= 2; k++) {
    ck_assert_int_eq(num_poly_root(num_vec_at(&z, 0), &c, k), SS_OK);
    arb_struct *x = num_vec_at(&z, 0);
    struct rng r = {(uint64_t)k};
    for (int i = 0; i < 200; i++) {
      double e[3];
      for (int j = 0; j < 3; j++) e[j] = (double)rng_between(&r, -1, 1) / 1024;
      double a = 1 + e[2], b = -4 + e[1], s = sqrt(b * b - 4 * a * (3 + e[0]));
      NUMBERS(arb, root);
      arb_set_d(root, (-b + (k == 1 ? -s : s)) / (2 * a));
      mag_set_d(arb_radref(root), 1e-14); /* the double formula's own error */
      ck_assert_msg(arb_overlaps(x, root), "polynomial %d", i);
    }
    ck_assert(mag_cmp_2exp_si(arb_radref(x), -4) < 0 && arb_contains_si(x, 2 * k - 1));
  }
}

/* Roots that are hard to separate, 2^e and 2^e (1 + 2^-gap) for pairs (e, gap), and roots that are far apart. */
TEST(close_and_distant_roots) {
  const slong cases[][2] = {{0, 40}, {0, 150}, {-500, 100}, {500, 190}, {-5000, 60}};
  struct num_ctx ctx = num_ctx_arb(200);
  OWNED(num_vec) c = vec_new(3, ctx), cubic = vec_new(4, ctx), z = vec_new(1, ctx);
  for (size_t i = 0; i < COUNT(cases); i++) {
    NUMBERS(arb, a, b, t);
    arb_set_ui(a, 1);
    arb_mul_2exp_si(b, a, -cases[i][1]);
    arb_add(b, b, a, ARF_PREC_EXACT);
    arb_mul_2exp_si(a, a, cases[i][0]);
    arb_mul_2exp_si(b, b, cases[i][0]);
    arb_mul(num_vec_at(&c, 0), a, b, ARF_PREC_EXACT);
    arb_add(t, a, b, ARF_PREC_EXACT);
    arb_neg(num_vec_at(&c, 1), t);
    arb_set_ui(num_vec_at(&c, 2), 1);
    ck_assert_int_eq(num_poly_root(num_vec_at(&z, 0), &c, 1), SS_OK);
    ck_assert(arb_contains(num_vec_at(&z, 0), a) && !arb_contains(num_vec_at(&z, 0), b));
    ck_assert_int_eq(num_poly_root(num_vec_at(&z, 0), &c, 2), SS_OK);
    ck_assert(arb_contains(num_vec_at(&z, 0), b) && !arb_contains(num_vec_at(&z, 0), a));
    ck_assert(arb_rel_accuracy_bits(num_vec_at(&z, 0)) >= 196);
  }
  /* (x - 1) (x^2 + (1 - B) x + 1), B = 2^e: the roots are 1, 1/B and B, the latter two up to 2/B of their size */
  NUMBERS(arb, big);
  arb_one(big);
  arb_mul_2exp_si(big, big, 100000);
  fill(&cubic, (const double[]){-1, 0, 0, 1});
  arb_set(num_vec_at(&cubic, 1), big);
  arb_neg(num_vec_at(&cubic, 2), big);
  for (slong k = 1; k <= 3; k++) {
    arb_struct *x = num_vec_at(&z, 0);
    NUMBERS(mag, distance);
    ck_assert_int_eq(num_poly_root(x, &cubic, k), SS_OK);
    arb_mul_2exp_si(x, x, (2 - k) * 100000);
    arb_sub_ui(x, x, 1, 200);
    arb_get_mag(distance, x);
    ck_assert(mag_cmp_2exp_si(distance, -190) < 0);
  }
}

/* --- Formulas as nested calls (num/calc.h), held against FLINT's rationals. --- */

/* The calc's element as element 0 of a vector. */
static bool comes_to(const struct calc *c, val x, const fmpq_t q) {
  const struct num_vec v = {c->ctx, 1, (char *)(uintptr_t)x};
  return is_close(&v, 0, q, ldexp(1, 16 - (int)c->ctx.prec));
}

static void random_rational(fmpq_t q, struct rng *r) {
  fmpq_set_si(q, rng_between(r, -100, 100), (ulong)rng_between(r, 1, 100));
}

TEST_EACH(formulas_of_rationals, LAW_CONTEXTS) {
  NUMBERS(fmpq, first, second, sum);
  RATIONALS(q, 5, _fmpq_vec_init(5));
  for (uint64_t seed = 1; seed <= 50; seed++) {
    struct rng r = {seed};
    val x[5];
    OWNED(calc) c = calc_begin(law_context(_i));
    for (int i = 0; i < 5; i++) {
      random_rational(q + i, &r);
      if (i == 3 && seed % 5 == 0) fmpq_zero(q + i);
      x[i] = calc_q(&c, q + i);
    }
    fmpq_mul(first, q + 1, q + 2);
    fmpq_mul(second, q + 3, q + 4);
    fmpq_add(sum, first, second);
    ck_assert_msg(comes_to(&c, calc_dot(&c, x[1], x[2], x[3], x[4]), sum), "dot, seed %d", (int)seed);
    fmpq_sub(sum, first, second);
    ck_assert(comes_to(&c, calc_dot_from(&c, NULL, x[1], x[2], true, x[3], x[4]), sum));
    fmpq_add(sum, sum, q);
    ck_assert(comes_to(&c, calc_dot_from(&c, x[0], x[1], x[2], true, x[3], x[4]), sum));
    ck_assert(comes_to(&c, calc_sub(&c, calc_add(&c, x[0], calc_mul(&c, x[1], x[2])), calc_mul(&c, x[3], x[4])), sum));
    fmpq_set_si(second, 7, 1);
    fmpq_div(sum, sum, second);
    ck_assert(comes_to(
        &c, calc_div_ui(&c, calc_neg(&c, calc_dot_from(&c, calc_neg(&c, x[0]), x[3], x[4], true, x[1], x[2])), 7),
        sum));
    ck_assert_int_eq(c.status, SS_OK);
    calc_div(&c, x[0], calc_sub(&c, x[1], x[1]));
    int status = c.status;
    ck_assert_int_ne(status, SS_OK);
    calc_add(&c, x[0], x[1]); /* what works does not take it back */
    ck_assert_int_eq(c.status, status);
  }
}

/* Elements made before a mark outlive every release to it, however many come after. */
TEST_EACH(released_elements_are_used_again, LAW_CONTEXTS) {
  NUMBERS(fmpq, q);
  for (int round = 0; round < 3; round++) { /* the pool of a cleared calc can be the next one's */
    OWNED(calc) c = calc_begin(law_context(_i));
    val kept[40];
    for (int i = 0; i < 40; i++) kept[i] = calc_d(&c, i);
    slong mark = calc_mark(&c);
    val first = calc_d(&c, 0);
    for (int loop = 0; loop < 5; loop++) {
      calc_release(&c, mark);
      val sum = calc_d(&c, -loop);
      ck_assert_ptr_eq(sum, first);
      for (int i = 1; i <= 300; i++) sum = calc_add(&c, sum, calc_d(&c, i));
      fmpq_set_si(q, 300 * 301 / 2 - loop, 1);
      ck_assert(comes_to(&c, sum, q));
    }
    for (int i = 0; i < 40; i++) {
      fmpq_set_si(q, i, 1);
      ck_assert(comes_to(&c, kept[i], q));
    }
    ck_assert_int_eq(c.status, SS_OK);
  }
}

TEST_EACH(exponents_bound_their_numbers, LAW_CONTEXTS) {
  struct num_ctx ctx = law_context(_i);
  OWNED(calc) c = calc_begin(ctx);
  for (int k = -60; k <= 60; k++) {
    for (int part = 0; part < 3; part++) {
      double x = ldexp(part == 0 ? 1 : part == 1 ? 1.25 : 2 - 0x1p-40, k);
      slong e = calc_exponent(&c, calc_d(&c, k % 2 ? -x : x));
      ck_assert_msg(x < ldexp(1, (int)e + 1) && ldexp(1, (int)e - 2) <= x, "%g has %d", x, (int)e);
    }
  }
  ck_assert_int_eq(calc_exponent(&c, calc_d(&c, 0)), CALC_TINY);
  if (ctx.type->rigorous) { /* of the largest point */
    val wide = calc_within(&c, calc_d(&c, 1), calc_d(&c, 1000));
    ck_assert_int_ge(calc_exponent(&c, wide), 9);
    ck_assert(arb_is_exact(calc_middle(&c, wide)) && arb_is_one(calc_middle(&c, wide)));
    ck_assert(!calc_lt(&c, calc_d(&c, 0), wide) && calc_lt(&c, wide, calc_d(&c, 1002)));
  }
}
