/* Square roots, absolute values and roots of polynomials in a field.  Each is a generator; the square of a square root
   or of an absolute value is known, and the field rewrites by it.  A root that is among the elements which the field
   was given, as positive ones or as roots in increasing order, is that element. */

#include "exact_impl.h"

/* The element that is nowhere negative and of which x is the square. */
static const fmpz_mpoly_q_struct *known_square_root(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  NUMBERS(quotient, square);
  for (int i = 0; i < f->n_positive; i++)
    if (exact_apply(num_exact.mul, square, f, &f->positive[i], &f->positive[i]) == SS_OK && exact_equal(f, x, square))
      return &f->positive[i];
  return NULL;
}

/* sqrt(p/n) = sqrt(p n)/|n|, wherever the left side has a value; n has that sign, or is zero. */
static int root_over(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, int sign) {
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *root = calc_new(&c);
  val n = exact_polynomial(&c, &x->den), product = calc_mul(&c, exact_polynomial(&c, &x->num), n);
  if (c.status == SS_OK) c.status = exact_sqrt(root, f, product);
  return exact_finish(z, &c, calc_div(&c, root, sign < 0 ? calc_neg(&c, n) : n));
}

/* The square of a new generator of sqrt(p/n), which stands for n sqrt(p/n); left out where it is too large. */
static void square_of_root(struct exact_field *f, slong i) {
  const fmpz_mpoly_q_struct *x = &f->gen[i].args[0];
  OWNED(calc) c = exact_calc(f);
  const fmpz_mpoly_q_struct *square = calc_mul(&c, exact_polynomial(&c, &x->num), exact_polynomial(&c, &x->den));
  if (c.status == SS_OK) exact_set_square(&f->gen[i], &square->num);
}

/* |p|: p or -p where p is nowhere negative or nowhere positive, else a generator. */
static val size_of(struct calc *c, struct exact_field *f, const fmpz_mpoly_struct *p) {
  int sign = exact_polynomial_sign(f, p, false);
  val x = exact_polynomial(c, p);
  if (sign) return sign < 0 ? calc_neg(c, x) : x;
  fmpz_mpoly_q_struct *size = calc_new(c);
  exact_take_sign(size, x);
  slong i = exact_generator(f, TAPE_abs, NULL, size, 1, 0);
  const fmpz_mpoly_q_struct *square = calc_mul(c, size, size);
  if (i >= 0 && !f->gen[i].squared && c->status == SS_OK) exact_set_square(&f->gen[i], &square->num);
  c->status |= exact_set_generator(size, i);
  return size;
}

/* The root of x as a generator. */
static int own_root(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  slong before = f->n, i = exact_generator(f, TAPE_sqrt, NULL, x, 1, 0);
  if (f->n > before) square_of_root(f, i);
  if (i < 0) return SS_UNABLE;
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *root = calc_new(&c);
  const fmpz_mpoly_struct *den = &f->gen[i].args[0].den;
  fmpz_mpoly_q_gen(root, variable(i), ring());
  return exact_finish(z, &c, fmpz_mpoly_is_one(den, ring()) ? root : calc_div(&c, root, exact_polynomial(&c, den)));
}

/* z sqrt(p) */
static val times_root(val z, struct calc *c, struct exact_field *f, const fmpz_mpoly_struct *p) {
  fmpz_mpoly_q_struct *root = calc_new(c);
  fmpz_mpoly_q_one(root, ring());
  if (!fmpz_mpoly_is_fmpz(p, ring()) || !fmpz_mpoly_sqrt(&root->num, p, ring()))
    c->status |= own_root(root, f, exact_polynomial(c, p));
  return calc_mul(c, z, root);
}

/* sqrt(p^m), m = 1 or 2, by the factors of p.  sqrt(s^2 q) = |s| sqrt(q) if q is nowhere negative or s is nowhere zero;
   else there may be points, s = 0 and q < 0, at which the left side has a value and the right one none.  sqrt(a q) =
   sqrt(a) sqrt(q) if a is a positive number or a symbol that is positive everywhere.  So each root that is made here
   has a value wherever that of p^m has one. */
static val root_of(struct calc *c, struct exact_field *f, const fmpz_mpoly_struct *p, ulong m) {
  NUMBERS(polynomial, rest, q);
  fmpz_mpoly_factor_t factors;
  fmpz_mpoly_factor_init(factors, ring());
  val z = calc_d(c, 1);
  fmpz_mpoly_set(q, p, ring());
  for (slong i = 0; m == 1 && i < f->n; i++) { /* 1 - sin^2 is the square of the cosine */
    if (f->gen[i].op != TAPE_cos || !fmpz_mpoly_divides(rest, q, f->gen[i].square, ring())) continue;
    if (exact_polynomial_sign(f, rest, false) <= 0) continue;
    fmpz_mpoly_swap(q, rest, ring());
    fmpz_mpoly_gen(rest, variable(i), ring());
    z = calc_mul(c, z, size_of(c, f, rest));
  }
  exact_factor(factors, q);
  fmpz_pow_ui(factors->constant, factors->constant, m);
  fmpz_mpoly_set_si(rest, fmpz_sgn(factors->constant), ring());
  for (slong i = 0; i < factors->num; i++) {
    fmpz_mul_ui(&factors->exp[i], &factors->exp[i], m);
    if (fmpz_is_odd(&factors->exp[i])) fmpz_mpoly_mul(rest, rest, &factors->poly[i], ring());
  }
  bool everywhere = exact_polynomial_sign(f, rest, false) > 0;
  for (slong i = 0; i < factors->num; i++) {
    const fmpz_mpoly_struct *g = &factors->poly[i];
    int sign = exact_polynomial_sign(f, g, true);
    for (slong n = fmpz_get_si(&factors->exp[i]); n >= 2; n -= 2) {
      if (everywhere || sign)
        z = calc_mul(c, z, size_of(c, f, g));
      else
        for (int k = 0; k < 2; k++) fmpz_mpoly_mul(rest, rest, g, ring());
    }
    if (fmpz_is_odd(&factors->exp[i]) && sign > 0 && fmpz_mpoly_is_gen(g, -1, ring())) {
      fmpz_mpoly_divides(rest, rest, g, ring());
      z = times_root(z, c, f, g);
    }
  }
  fmpz_abs(factors->constant, factors->constant);
  fmpz_mpoly_set_fmpz(q, factors->constant, ring());
  fmpz_mpoly_factor_clear(factors, ring());
  return times_root(times_root(z, c, f, q), c, f, rest);
}

int exact_sqrt(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *known = known_square_root(f, x);
  if (known) {
    fmpz_mpoly_q_set(z, known, ring());
    return SS_OK;
  }
  int sign = exact_polynomial_sign(f, &x->den, false);
  if (!fmpz_mpoly_is_one(&x->den, ring())) return sign ? root_over(z, f, x, sign) : own_root(z, f, x);
  struct calc c = exact_calc(f);
  return exact_finish(z, &c, root_of(&c, f, &x->num, 1));
}

bool exact_times_roots(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  int used[2][EXACT_GENERATORS];
  bool any = false;
  NUMBERS(quotient, root);
  fmpz_mpoly_used_vars(used[0], &x->num, ring());
  fmpz_mpoly_used_vars(used[1], &x->den, ring());
  for (slong i = 0; i < f->n; i++) {
    if (f->gen[i].op != TAPE_sqrt || !(used[0][variable(i)] || used[1][variable(i)])) continue;
    any = exact_set_generator(root, i) == SS_OK && exact_apply(num_exact.mul, x, f, x, root) == SS_OK;
    if (!any) break;
  }
  return any;
}

int exact_hypot(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x,
                const fmpz_mpoly_q_struct *y) {
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *root = calc_new(&c);
  val square = calc_dot(&c, y, y, x, x);
  if (c.status == SS_OK) c.status = exact_sqrt(root, f, square);
  return exact_finish(z, &c, root);
}

int exact_abs(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  struct calc c = exact_calc(f);
  val den = root_of(&c, f, &x->den, 2), num = root_of(&c, f, &x->num, 2);
  return exact_finish(z, &c, calc_div(&c, num, den));
}

/* Is the polynomial zero at x?  false also when that grows too large. */
static bool is_root(const struct exact_field *f, const fmpz_mpoly_q_struct *coeff, slong n,
                    const fmpz_mpoly_q_struct *x) {
  OWNED(calc) c = exact_calc(f);
  val y = calc_d(&c, 0);
  for (slong i = n - 1; i >= 0; i--) y = calc_add(&c, calc_mul(&c, y, x), &coeff[i]);
  return c.status == SS_OK && exact_is_zero(y);
}

/* The known elements that are roots of an even polynomial are all its positive roots when there are as many as half of
   its degree; which: 1 the smallest, -1 the largest. */
static const fmpz_mpoly_q_struct *known_root(const struct exact_field *f, const fmpz_mpoly_q_struct *c, slong n,
                                             slong which) {
  const fmpz_mpoly_q_struct *found = NULL;
  slong count = 0;
  if (n % 2 == 0 || f->n_roots == 0) return NULL;
  for (slong i = 1; i < n; i += 2)
    if (!exact_is_zero(&c[i])) return NULL;
  for (int i = 0; i < f->n_roots; i++) {
    if (!is_root(f, c, n, &f->root[i])) continue;
    if (count++ == 0 || which < 0) found = &f->root[i];
  }
  return 2 * count == n - 1 ? found : NULL;
}

/* Which root of which polynomial, up to a factor of the polynomial. */
int exact_root(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct tape *t, const struct tape_instr *in,
               const fmpz_mpoly_q_struct *reg) {
  struct calc c = exact_calc(f);
  struct num_vec over = calc_vec(&c, in->b);
  fmpz_mpoly_q_struct *coeff = num_vec_at(&over, 0), *root = calc_new(&c);
  const fmpz_mpoly_q_struct *lead = &reg[t->links[in->a + in->b - 1]];
  for (slong i = 0; i < in->b; i++) calc_store(&c, &coeff[i], calc_div(&c, &reg[t->links[in->a + i]], lead));
  const fmpz_mpoly_q_struct *known = c.status == SS_OK ? known_root(f, coeff, in->b, in->k) : NULL;
  if (!known && c.status == SS_OK)
    c.status = exact_set_generator(root, exact_generator(f, TAPE_ROOT, NULL, coeff, in->b, in->k));
  return exact_finish(z, &c, known ? known : root);
}
