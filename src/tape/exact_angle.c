/* Sines and cosines in a field.  The sine of an angle is a generator, and its cosine another one whose square is 1 -
   sin^2; the sign of the angle is taken off first, since sin(-u) = -sin(u) and cos(-u) = cos(u), and so is a whole
   multiple of pi.  Where the field was given angles, the sine of a sum of their multiples is made of theirs by the
   addition theorems, so that sin(2 u) is no new unknown beside sin(u). */
#include <stdlib.h>
#include <string.h>

#include "exact_impl.h"
#include "expr/expr.h"

/* The sine of an argument, then the cosine, whose square is 1 - sin^2. */
static slong make_angle(struct exact_field *f, const fmpz_mpoly_q_struct *arg) {
  slong s = exact_generator(f, TAPE_sin, NULL, arg, 1, 0),
        c = s < 0 ? -1 : exact_generator(f, TAPE_cos, NULL, arg, 1, 0);
  if (c < 0 || f->gen[c].squared) return c < 0 ? -1 : s;
  NUMBERS(polynomial, square);
  fmpz_mpoly_gen(square, variable(s), ring());
  fmpz_mpoly_mul(square, square, square, ring());
  fmpz_mpoly_neg(square, square, ring());
  fmpz_mpoly_add_si(square, square, 1, ring());
  exact_set_square(&f->gen[c], square);
  return s;
}

/* x without the whole multiple of pi in it; whether that is an odd one, of which sine and cosine change their signs. */
static bool take_half_turns(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  slong i = 0;
  while (i < f->n && !(f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, expr_pi) == 0)) i++;
  if (i == f->n) return false;
  NUMBERS(polynomial, rate);
  NUMBERS(quotient, turns);
  NUMBERS(fmpz, k);
  fmpz_mpoly_derivative(rate, &x->num, variable(i), ring());
  if (fmpz_mpoly_divides(rate, rate, &x->den, ring()) && fmpz_mpoly_is_fmpz(rate, ring())) {
    fmpz_mpoly_get_fmpz(k, rate, ring());
    fmpz_mpoly_q_gen(turns, variable(i), ring());
    fmpz_mpoly_q_mul_fmpz(turns, turns, k, ring());
    fmpz_mpoly_q_sub(x, x, turns, ring());
  }
  return fmpz_is_odd(k);
}

static int own_angle(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f,
                     const fmpz_mpoly_q_struct *x) {
  NUMBERS(quotient, arg);
  int status = SS_OK;
  bool negative = false;
  fmpz_mpoly_q_set(arg, x, ring());
  bool odd = take_half_turns(arg, f);
  if (fmpz_mpoly_q_is_zero(arg, ring())) {
    fmpz_mpoly_q_zero(s, ring());
    fmpz_mpoly_q_set_si(c, 1, ring());
  } else {
    negative = exact_take_sign(arg, arg);
    status = exact_set_generator(s, make_angle(f, arg));
    if (status == SS_OK) status = exact_set_generator(c, exact_generator(f, TAPE_cos, NULL, arg, 1, 0));
  }
  if (negative != odd) fmpz_mpoly_q_neg(s, s, ring());
  if (odd) fmpz_mpoly_q_neg(c, c, ring());
  return status;
}

/* The pair of an angle and that of another: the pair of their sum. */
static void add_angle(val p[2], struct calc *c, const val by[2]) {
  val sine = calc_dot(c, p[0], by[1], p[1], by[0]);
  p[1] = calc_dot_from(c, NULL, p[1], by[1], true, p[0], by[0]);
  p[0] = sine;
}

/* The pair of i a + k b. */
static void make_sum(val p[2], struct calc *c, struct exact_field *f, int a, int i, int b, int k) {
  const int of[2] = {a, b}, times[2] = {i, k};
  p[0] = calc_d(c, 0);
  p[1] = calc_d(c, 1);
  for (int j = 0; j < 2; j++) {
    if (times[j] == 0) continue;
    fmpz_mpoly_q_struct *sine = calc_new(c), *cosine = calc_new(c);
    c->status |= own_angle(sine, cosine, f, &f->angle[of[j]]);
    const val by[2] = {times[j] < 0 ? calc_neg(c, sine) : sine, cosine};
    for (int n = 0; n < abs(times[j]); n++) add_angle(p, c, by);
  }
}

/* The integer i from -MOST_ANGLES to MOST_ANGLES for which x and i a agree at the one monomial of a; false without
   one. */
static bool multiple_at(int *i, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *a) {
  enum { MOST_ANGLES = 8 };
  NUMBERS(fmpz, up, down, c);
  fmpz_mpoly_get_coeff_fmpz_monomial(up, &x->num, &a->num, ring());
  fmpz_mpoly_get_fmpz(c, &a->den, ring());
  fmpz_mul(up, up, c);
  fmpz_mpoly_get_fmpz(down, &x->den, ring());
  fmpz_mpoly_get_term_coeff_fmpz(c, &a->num, 0, ring());
  fmpz_mul(down, down, c);
  bool whole = fmpz_divisible(up, down);
  if (whole) fmpz_divexact(up, up, down);
  whole = whole && fmpz_cmp_si(up, -MOST_ANGLES) >= 0 && fmpz_cmp_si(up, MOST_ANGLES) <= 0;
  *i = whole ? (int)fmpz_get_si(up) : 0;
  return whole;
}

/* a - b g of p = a + b g, g with a square. */
static void conjugate_of(fmpz_mpoly_t z, const fmpz_mpoly_struct *p, slong var) {
  NUMBERS(polynomial, g);
  fmpz_mpoly_gen(g, var, ring());
  fmpz_mpoly_derivative(z, p, var, ring());
  fmpz_mpoly_mul(z, z, g, ring());
  fmpz_mpoly_scalar_mul_si(z, z, -2, ring());
  fmpz_mpoly_add(z, z, p, ring());
}

/* x with a denominator free of generators that have a square: a + b g times a - b g is. */
static int rationalise(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  NUMBERS(polynomial, conjugate);
  int s = SS_OK;
  fmpz_mpoly_q_set(z, x, ring());
  for (slong i = f->n - 1; s == SS_OK && i >= 0; i--) {
    if (!f->gen[i].squared || fmpz_mpoly_degree_si(&z->den, variable(i), ring()) < 1) continue;
    conjugate_of(conjugate, &z->den, variable(i));
    fmpz_mpoly_mul(&z->num, &z->num, conjugate, ring());
    fmpz_mpoly_mul(&z->den, &z->den, conjugate, ring());
    s = exact_reduce(z, f);
    if (s == SS_OK) fmpz_mpoly_q_canonicalise(z, ring());
  }
  return s;
}

/* Is x = i a + k b?  Then these are i and k, since a and b are different monomials. */
static bool is_sum(int *i, int *k, struct exact_field *f, const fmpz_mpoly_q_struct *x, int a, int b) {
  if (!fmpz_mpoly_is_fmpz(&x->den, ring()) || !multiple_at(i, x, &f->angle[a]) || !multiple_at(k, x, &f->angle[b]))
    return false;
  OWNED(calc) c = exact_calc(f);
  val sum = calc_dot(&c, &f->angle[a], calc_d(&c, *i), &f->angle[b], calc_d(&c, *k));
  return c.status == SS_OK && exact_equal(f, x, sum);
}

int exact_sin_cos(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  struct calc w = exact_calc(f);
  fmpz_mpoly_q_struct *plain = calc_new(&w), *own[2] = {calc_new(&w), calc_new(&w)};
  val p[2] = {own[0], own[1]};
  int i, k;
  bool found = false;
  if (rationalise(plain, f, x) != SS_OK) fmpz_mpoly_q_set(plain, x, ring());
  for (int a = 0; !found && a < f->n_angles; a++)
    for (int b = a + 1; !found && b < f->n_angles && b / f->group == a / f->group; b++) {
      found = is_sum(&i, &k, f, plain, a, b);
      if (found) make_sum(p, &w, f, a, i, b, k);
    }
  if (!found) w.status = own_angle(own[0], own[1], f, x);
  if (w.status == SS_OK) calc_store(&w, s, p[0]);
  return exact_finish(c, &w, p[1]);
}

int exact_circular(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  struct calc w = exact_calc(f);
  fmpz_mpoly_q_struct *s = calc_new(&w), *c = calc_new(&w);
  w.status = exact_sin_cos(s, c, f, x);
  return exact_finish(z, &w, op == TAPE_cot ? calc_div(&w, c, s) : op == TAPE_sin ? s : c);
}

/* Can the numerator vanish on a whole domain though it is not zero here, as sqrt(4 V) - 2 sqrt(V) or |z| - z do?  Not
   when the product over all signs of the generators that have squares is no zero.  True also when that grows too
   large. */
static bool may_vanish(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  OWNED(calc) c = exact_calc(f);
  const fmpz_mpoly_q_struct *p = exact_polynomial(&c, &x->num);
  for (slong i = f->n - 1; c.status == SS_OK && i >= 0; i--) {
    if (!f->gen[i].squared || fmpz_mpoly_degree_si(&p->num, variable(i), ring()) < 1) continue;
    fmpz_mpoly_q_struct *conjugate = calc_new(&c);
    conjugate_of(&conjugate->num, &p->num, variable(i));
    p = calc_mul(&c, p, conjugate);
  }
  return c.status != SS_OK || exact_is_zero(p);
}

/* sin u/u, or (u - sin u)/u^3: they have values where u is zero, so that u is a divisor only if that is no whole
   domain. */
int exact_over_angle(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  if (fmpz_mpoly_q_is_zero(x, ring())) {
    fmpz_mpoly_q_set_si(z, 1, ring());
    if (op == TAPE_stumpff) fmpz_mpoly_set_si(&z->den, 6, ring());
    return SS_OK;
  }
  if (may_vanish(f, x)) return SS_UNABLE;
  struct calc c = exact_calc(f);
  fmpz_mpoly_q_struct *sine = calc_new(&c);
  c.status = exact_circular(sine, f, TAPE_sin, x);
  val y = op == TAPE_stumpff ? calc_sub(&c, x, sine) : sine;
  for (int i = 0; i < (op == TAPE_stumpff ? 3 : 1); i++) y = calc_div(&c, y, x);
  return exact_finish(z, &c, y);
}
