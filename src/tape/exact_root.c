/* Square roots, absolute values and roots of polynomials in a field.  Each is a generator; the square of a square root
   or of an absolute value is known, and the field rewrites by it.  A root that is among the elements which the field was
   given, as positive ones or as roots in increasing order, is that element. */
#include <stdlib.h>

#include "exact_impl.h"

/* The positive element of which x is the square. */
static const fmpz_mpoly_q_struct *known_square_root(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *found = NULL;
  fmpz_mpoly_q_struct square;
  exact_init(&square, f);
  for (int i = 0; !found && i < f->n_positive; i++)
    if (exact_apply(num_exact.mul, &square, f, &f->positive[i], &f->positive[i]) == SS_OK && exact_equal(f, x, &square))
      found = &f->positive[i];
  exact_clear(&square, f);
  return found;
}

/* sqrt(p/n) = sqrt(p n)/n for n > 0, an integer or a product of elements that are positive. */
static int root_over(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct n, product;
  exact_init(&n, f);
  exact_init(&product, f);
  fmpz_mpoly_set(&n.num, &x->den, ring());
  fmpz_mpoly_set(&product.num, &x->num, ring());
  int s = exact_apply(num_exact.mul, &product, f, &product, &n);
  if (s == SS_OK) s = exact_sqrt(z, f, &product);
  if (s == SS_OK) s = exact_apply(num_exact.div, z, f, z, &n);
  exact_clear(&product, f);
  exact_clear(&n, f);
  return s;
}

/* Is the denominator known to be positive? */
static bool is_positive(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  if (fmpz_mpoly_is_fmpz(&x->den, ring())) return true;
  fmpz_mpoly_q_struct den;
  exact_init(&den, f);
  fmpz_mpoly_set(&den.num, &x->den, ring());
  bool positive = exact_product_sign(&den, f->positive, f->n_positive) > 0;
  exact_clear(&den, f);
  return positive;
}

/* The square of a new generator of sqrt(p/n), which stands for n sqrt(p/n); left out where it is too large. */
static void square_of_root(struct exact_field *f, slong i) {
  struct generator *g = &f->gen[i];
  fmpz_mpoly_q_struct num, den;
  exact_init(&num, f);
  exact_init(&den, f);
  fmpz_mpoly_set(&num.num, &g->args[0].num, ring());
  fmpz_mpoly_set(&den.num, &g->args[0].den, ring());
  g->squared = exact_apply(num_exact.mul, &num, f, &num, &den) == SS_OK;
  if (g->squared) {
    fmpz_mpoly_init(g->square, ring());
    fmpz_mpoly_swap(g->square, &num.num, ring());
  }
  exact_clear(&den, f);
  exact_clear(&num, f);
}

int exact_sqrt(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *known = known_square_root(f, x);
  if (known) {
    fmpz_mpoly_q_set(z, known, ring());
    return SS_OK;
  }
  if (!fmpz_mpoly_is_one(&x->den, ring()) && is_positive(f, x)) return root_over(z, f, x);
  slong before = f->n, i = exact_generator(f, TAPE_sqrt, NULL, x, 1, 0);
  if (f->n > before) square_of_root(f, i);
  int s = exact_set_generator(z, i);
  if (s != SS_OK || fmpz_mpoly_is_one(&f->gen[i].args[0].den, ring())) return s;
  fmpz_mpoly_q_struct den;
  exact_init(&den, f);
  fmpz_mpoly_set(&den.num, &f->gen[i].args[0].den, ring());
  s = exact_apply(num_exact.div, z, f, z, &den);
  exact_clear(&den, f);
  return s;
}

int exact_hypot(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x,
                const fmpz_mpoly_q_struct *y) {
  fmpz_mpoly_q_struct square;
  exact_init(&square, f);
  int s = exact_apply(num_exact.mul, &square, f, y, y);
  if (s == SS_OK) s = exact_apply(num_exact.mul, z, f, x, x);
  if (s == SS_OK) s = exact_apply(num_exact.add, &square, f, &square, z);
  if (s == SS_OK) s = exact_sqrt(z, f, &square);
  exact_clear(&square, f);
  return s;
}

/* |p/q| = |p q|/q^2: the generator stands for the absolute value of a polynomial. */
int exact_abs(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  if (exact_is_zero(f, x)) {
    fmpz_mpoly_q_zero(z, ring());
    return SS_OK;
  }
  fmpz_mpoly_q_struct den, arg;
  exact_init(&den, f);
  exact_init(&arg, f);
  fmpz_mpoly_set(&den.num, &x->den, ring());
  fmpz_mpoly_set(&arg.num, &x->num, ring());
  int s = exact_apply(num_exact.mul, &arg, f, &arg, &den);
  if (s == SS_OK) s = exact_apply(num_exact.mul, &den, f, &den, &den);
  if (s == SS_OK) exact_take_sign(&arg, &arg);
  if (s == SS_OK && exact_product_sign(&arg, f->positive, f->n_positive) > 0) {
    s = exact_apply(num_exact.div, z, f, &arg, &den);
    exact_clear(&arg, f);
    exact_clear(&den, f);
    return s;
  }
  slong i = s == SS_OK ? exact_generator(f, TAPE_abs, NULL, &arg, 1, 0) : -1;
  if (i >= 0 && !f->gen[i].squared) {
    f->gen[i].squared = true;
    fmpz_mpoly_init(f->gen[i].square, ring());
    fmpz_mpoly_mul(f->gen[i].square, &arg.num, &arg.num, ring());
    exact_rewrite(f->gen[i].square, f);
  }
  if (s == SS_OK) s = exact_set_generator(z, i);
  if (s == SS_OK) s = exact_apply(num_exact.div, z, f, z, &den);
  exact_clear(&arg, f);
  exact_clear(&den, f);
  return s;
}

/* Is the polynomial zero at x?  false also when that grows too large. */
static bool is_root(const struct exact_field *f, const fmpz_mpoly_q_struct *c, slong n, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct y;
  exact_init(&y, f);
  int s = SS_OK;
  for (slong i = n - 1; s == SS_OK && i >= 0; i--) {
    s = exact_apply(num_exact.mul, &y, f, &y, x);
    if (s == SS_OK) s = exact_apply(num_exact.add, &y, f, &y, &c[i]);
  }
  bool zero = s == SS_OK && exact_is_zero(f, &y);
  exact_clear(&y, f);
  return zero;
}

/* The known elements that are roots of an even polynomial are all its positive roots when there are as many as half of
   its degree; which: 1 the smallest, -1 the largest. */
static const fmpz_mpoly_q_struct *known_root(const struct exact_field *f, const fmpz_mpoly_q_struct *c, slong n,
                                             slong which) {
  const fmpz_mpoly_q_struct *found = NULL;
  slong count = 0;
  if (n % 2 == 0 || f->n_roots == 0) return NULL;
  for (slong i = 1; i < n; i += 2)
    if (!exact_is_zero(f, &c[i])) return NULL;
  for (int i = 0; i < f->n_roots; i++) {
    if (!is_root(f, c, n, &f->root[i])) continue;
    if (count++ == 0 || which < 0) found = &f->root[i];
  }
  return 2 * count == n - 1 ? found : NULL;
}

/* Which root of which polynomial, up to a factor of the polynomial. */
int exact_root(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct tape *t, const struct tape_instr *in,
               const fmpz_mpoly_q_struct *reg) {
  fmpz_mpoly_q_struct *c = ss_malloc((size_t)in->b * sizeof *c);
  const fmpz_mpoly_q_struct *lead = &reg[t->links[in->a + in->b - 1]];
  int s = SS_OK;
  for (slong i = 0; i < in->b; i++) exact_init(&c[i], f);
  for (slong i = 0; s == SS_OK && i < in->b; i++)
    s = exact_apply(num_exact.div, &c[i], f, &reg[t->links[in->a + i]], lead);
  const fmpz_mpoly_q_struct *known = s == SS_OK ? known_root(f, c, in->b, in->k) : NULL;
  if (known)
    fmpz_mpoly_q_set(z, known, ring());
  else if (s == SS_OK)
    s = exact_set_generator(z, exact_generator(f, TAPE_ROOT, NULL, c, in->b, in->k));
  for (slong i = 0; i < in->b; i++) exact_clear(&c[i], f);
  free(c);
  return s;
}
