/* Sines and cosines in a field.  The sine of an angle is a generator, and its cosine another one whose square is 1 -
   sin^2; the sign of the angle is taken off first, since sin(-u) = -sin(u) and cos(-u) = cos(u), and so is a whole
   multiple of pi/2.  Where the field knows of which parts angles are made, the sine of a sum is made of theirs by the
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

/* How many quarter turns, pi/2 each, are in x, modulo 4; x without them. */
static int take_quarter_turns(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  slong i = 0;
  while (i < f->n && !(f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, expr_pi) == 0)) i++;
  if (i == f->n) return 0;
  NUMBERS(polynomial, rate);
  NUMBERS(quotient, turns);
  NUMBERS(fmpz, k);
  fmpz_mpoly_derivative(rate, &x->num, variable(i), ring());
  fmpz_mpoly_scalar_mul_si(rate, rate, 2, ring());
  if (fmpz_mpoly_divides(rate, rate, &x->den, ring()) && fmpz_mpoly_is_fmpz(rate, ring())) {
    fmpz_mpoly_get_fmpz(k, rate, ring());
    fmpz_mpoly_q_gen(turns, variable(i), ring());
    fmpz_mpoly_q_mul_fmpz(turns, turns, k, ring());
    fmpz_mpoly_q_div_si(turns, turns, 2, ring());
    fmpz_mpoly_q_sub(x, x, turns, ring());
  }
  return (int)fmpz_fdiv_ui(k, 4);
}

static int own_angle(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f,
                     const fmpz_mpoly_q_struct *x) {
  NUMBERS(quotient, arg);
  int status = SS_OK;
  fmpz_mpoly_q_set(arg, x, ring());
  int quarters = take_quarter_turns(arg, f);
  if (fmpz_mpoly_q_is_zero(arg, ring())) {
    fmpz_mpoly_q_zero(s, ring());
    fmpz_mpoly_q_set_si(c, 1, ring());
  } else {
    bool negative = exact_take_sign(arg, arg);
    status = exact_set_generator(s, make_angle(f, arg));
    if (status == SS_OK) status = exact_set_generator(c, exact_generator(f, TAPE_cos, NULL, arg, 1, 0));
    if (negative) fmpz_mpoly_q_neg(s, s, ring());
  }
  for (; quarters > 0; quarters--) { /* sin(u + pi/2) = cos(u), cos(u + pi/2) = -sin(u) */
    fmpz_mpoly_q_swap(s, c, ring());
    fmpz_mpoly_q_neg(c, c, ring());
  }
  return status;
}

/* The pair of an angle and that of another: the pair of their sum. */
static void add_angle(val p[2], struct calc *c, const val by[2]) {
  val sine = calc_dot(c, p[0], by[1], p[1], by[0]);
  p[1] = calc_dot_from(c, NULL, p[1], by[1], true, p[0], by[0]);
  p[0] = sine;
}

enum { MOST_MULTIPLES = 8 };

/* Term i of x, over its rational factor. */
static void split_term(fmpq_t factor, fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong i) {
  exact_term(z, x, i);
  fmpz_mpoly_get_term_coeff_fmpz(fmpq_numref(factor), &z->num, 0, ring());
  _fmpz_vec_content(fmpq_denref(factor), z->den.coeffs, z->den.length);
  fmpz_mpoly_q_div_fmpq(z, z, factor, ring());
}

void exact_field_angles(struct exact_field *f, slong parts) {
  f->parts = parts;
}

bool exact_field_parts(struct exact_field *f) {
  NUMBERS(quotient, term);
  NUMBERS(fmpq, factor);
  NUMBERS(fmpz, parts);
  for (slong k = 0; k < f->n; k++)
    for (slong i = 0; f->gen[k].op == TAPE_sin && i < fmpz_mpoly_length(&f->gen[k].args[0].num, ring()); i++) {
      split_term(factor, term, f->gen[k].args, i);
      fmpz_set_si(parts, f->parts ? f->parts : 1);
      fmpz_lcm(parts, parts, fmpq_denref(factor));
      if (fmpz_cmp_si(parts, MOST_MULTIPLES) <= 0) f->parts = fmpz_get_si(parts);
    }
  return f->parts > 0;
}

/* The pair of x from those of the parts of its terms, of which these must be multiples. */
static bool sum_of_parts(val p[2], struct calc *c, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  NUMBERS(quotient, part);
  NUMBERS(fmpq, times);
  p[0] = calc_d(c, 0);
  p[1] = calc_d(c, 1);
  for (slong i = 0; i < fmpz_mpoly_length(&x->num, ring()); i++) {
    split_term(times, part, x, i);
    fmpq_mul_si(times, times, f->parts);
    fmpz_mpoly_q_div_si(part, part, f->parts, ring());
    if (!fmpz_is_one(fmpq_denref(times)) || fmpz_cmpabs(fmpq_numref(times), (const fmpz[]){MOST_MULTIPLES}) > 0)
      return false;
    fmpz_mpoly_q_struct *sine = calc_new(c), *cosine = calc_new(c);
    c->status |= own_angle(sine, cosine, f, part);
    const val by[2] = {fmpq_sgn(times) < 0 ? calc_neg(c, sine) : sine, cosine};
    for (slong n = labs(fmpz_get_si(fmpq_numref(times))); n > 0; n--) add_angle(p, c, by);
  }
  return true;
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

int exact_sin_cos(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  struct calc w = exact_calc(f);
  fmpz_mpoly_q_struct *plain = calc_new(&w), *own[2] = {calc_new(&w), calc_new(&w)};
  val p[2];
  if (rationalise(plain, f, x) != SS_OK) fmpz_mpoly_q_set(plain, x, ring());
  if (!f->parts || !sum_of_parts(p, &w, f, plain) || w.status != SS_OK) {
    w.status = own_angle(own[0], own[1], f, x);
    p[0] = own[0];
    p[1] = own[1];
  }
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
