/* Square roots, absolute values and roots of polynomials in a field.  Each is a generator; the square of a square root
   or of an absolute value is known, and the field rewrites by it.  A root that is among the elements which the field
   was given, as positive ones or as roots in increasing order, is that element. */

#include "exact_impl.h"

/* The positive element of which x is the square. */
static const fmpz_mpoly_q_struct *known_square_root(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  NUMBERS(quotient, square);
  for (int i = 0; i < f->n_positive; i++)
    if (exact_apply(num_exact.mul, square, f, &f->positive[i], &f->positive[i]) == SS_OK && exact_equal(f, x, square))
      return &f->positive[i];
  return NULL;
}

/* sqrt(p/n) = sqrt(p n)/n for n > 0, an integer or a product of elements that are positive. */
static int root_over(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *root = calc_new(&c);
  val n = exact_polynomial(&c, &x->den), product = calc_mul(&c, exact_polynomial(&c, &x->num), n);
  if (c.status == SS_OK) c.status = exact_sqrt(root, f, product);
  return exact_finish(z, &c, calc_div(&c, root, n));
}

/* The square of a new generator of sqrt(p/n), which stands for n sqrt(p/n); left out where it is too large. */
static void square_of_root(struct exact_field *f, slong i) {
  const fmpz_mpoly_q_struct *x = &f->gen[i].args[0];
  OWNED(calc) c = exact_calc(f);
  const fmpz_mpoly_q_struct *square = calc_mul(&c, exact_polynomial(&c, &x->num), exact_polynomial(&c, &x->den));
  if (c.status == SS_OK) exact_set_square(&f->gen[i], &square->num);
}

/* sqrt(p^2) = |p|. */
static bool root_of_square(int *status, fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  NUMBERS(polynomial, p);
  if (!fmpz_mpoly_is_one(&x->den, ring()) || !fmpz_mpoly_sqrt(p, &x->num, ring())) return false;
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *size = calc_new(&c);
  *status = exact_abs(size, f, exact_polynomial(&c, p));
  *status = exact_finish(z, &c, size) | *status;
  return true;
}

int exact_sqrt(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *known = known_square_root(f, x);
  if (known) {
    fmpz_mpoly_q_set(z, known, ring());
    return SS_OK;
  }
  if (!fmpz_mpoly_is_one(&x->den, ring()) && exact_polynomial_sign(&x->den, f->positive, f->n_positive) > 0)
    return root_over(z, f, x);
  int status;
  if (root_of_square(&status, z, f, x)) return status;
  slong before = f->n, i = exact_generator(f, TAPE_sqrt, NULL, x, 1, 0);
  if (f->n > before) square_of_root(f, i);
  if (i < 0) return SS_UNABLE;
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *root = calc_new(&c);
  const fmpz_mpoly_struct *den = &f->gen[i].args[0].den;
  fmpz_mpoly_q_gen(root, variable(i), ring());
  return exact_finish(z, &c, fmpz_mpoly_is_one(den, ring()) ? root : calc_div(&c, root, exact_polynomial(&c, den)));
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

/* |p/q| = |p q|/q^2: the generator stands for the absolute value of a polynomial. */
int exact_abs(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  if (exact_is_zero(x)) {
    fmpz_mpoly_q_zero(z, ring());
    return SS_OK;
  }
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *size = calc_new(&c);
  val den = exact_polynomial(&c, &x->den), product = calc_mul(&c, exact_polynomial(&c, &x->num), den);
  val square = calc_mul(&c, den, den);
  if (c.status == SS_OK) exact_take_sign(size, product);
  if (c.status == SS_OK && exact_polynomial_sign(&size->num, f->positive, f->n_positive) <= 0) {
    slong i = exact_generator(f, TAPE_abs, NULL, size, 1, 0);
    if (i >= 0 && !f->gen[i].squared) {
      exact_set_square(&f->gen[i], &size->num);
      fmpz_mpoly_mul(f->gen[i].square, f->gen[i].square, f->gen[i].square, ring());
      exact_rewrite(f->gen[i].square, f);
    }
    c.status = exact_set_generator(size, i);
  }
  return exact_finish(z, &c, calc_div(&c, size, square));
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
