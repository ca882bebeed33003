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
  struct generator *g = &f->gen[c];
  g->squared = true;
  fmpz_mpoly_init(g->square, ring());
  fmpz_mpoly_gen(g->square, variable(s), ring());
  fmpz_mpoly_pow_ui(g->square, g->square, 2, ring());
  fmpz_mpoly_neg(g->square, g->square, ring());
  fmpz_mpoly_add_si(g->square, g->square, 1, ring());
  return s;
}

/* x without the whole multiple of pi in it; whether that is an odd one, of which sine and cosine change their signs. */
static bool take_half_turns(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  slong i = 0;
  while (i < f->n && !(f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, expr_pi) == 0)) i++;
  if (i == f->n) return false;
  fmpz_mpoly_t rate;
  fmpz_mpoly_q_struct turns;
  fmpz_t k;
  fmpz_init(k);
  exact_init(&turns, f);
  fmpz_mpoly_init(rate, ring());
  fmpz_mpoly_derivative(rate, &x->num, variable(i), ring());
  if (fmpz_mpoly_divides(rate, rate, &x->den, ring()) && fmpz_mpoly_is_fmpz(rate, ring())) {
    fmpz_mpoly_get_fmpz(k, rate, ring());
    fmpz_mpoly_q_gen(&turns, variable(i), ring());
    fmpz_mpoly_q_mul_fmpz(&turns, &turns, k, ring());
    fmpz_mpoly_q_sub(x, x, &turns, ring());
  }
  bool odd = fmpz_is_odd(k);
  fmpz_mpoly_clear(rate, ring());
  exact_clear(&turns, f);
  fmpz_clear(k);
  return odd;
}

static int own_angle(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f,
                     const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct arg;
  int status = SS_OK;
  bool negative = false;
  exact_init(&arg, f);
  fmpz_mpoly_q_set(&arg, x, ring());
  bool odd = take_half_turns(&arg, f);
  if (fmpz_mpoly_q_is_zero(&arg, ring())) {
    fmpz_mpoly_q_zero(s, ring());
    fmpz_mpoly_q_set_si(c, 1, ring());
  } else {
    negative = exact_take_sign(&arg, &arg);
    status = exact_set_generator(s, make_angle(f, &arg));
    if (status == SS_OK) status = exact_set_generator(c, exact_generator(f, TAPE_cos, NULL, &arg, 1, 0));
  }
  if (negative != odd) fmpz_mpoly_q_neg(s, s, ring());
  if (odd) fmpz_mpoly_q_neg(c, c, ring());
  exact_clear(&arg, f);
  return status;
}

/* The pair of an angle and that of another: the pair of their sum. */
static int add_angle(fmpz_mpoly_q_struct p[2], struct exact_field *f, const fmpz_mpoly_q_struct by[2]) {
  fmpz_mpoly_q_struct t[4];
  int s = SS_OK;
  for (int i = 0; i < 4; i++) exact_init(&t[i], f);
  for (int i = 0; s == SS_OK && i < 4; i++) s = exact_apply(num_exact.mul, &t[i], f, &p[i / 2], &by[i % 2]);
  if (s == SS_OK) s = exact_apply(num_exact.add, &p[0], f, &t[1], &t[2]);
  if (s == SS_OK) s = exact_apply(num_exact.sub, &p[1], f, &t[3], &t[0]);
  for (int i = 0; i < 4; i++) exact_clear(&t[i], f);
  return s;
}

/* The pair of i a + k b. */
static int make_sum(fmpz_mpoly_q_struct p[2], struct exact_field *f, int a, int i, int b, int k) {
  const int of[2] = {a, b}, times[2] = {i, k};
  fmpz_mpoly_q_struct by[2];
  int s = SS_OK;
  for (int j = 0; j < 2; j++) exact_init(&by[j], f);
  fmpz_mpoly_q_zero(&p[0], ring());
  fmpz_mpoly_q_set_si(&p[1], 1, ring());
  for (int j = 0; s == SS_OK && j < 2; j++) {
    if (times[j] == 0) continue;
    s = own_angle(&by[0], &by[1], f, &f->angle[of[j]]);
    if (times[j] < 0) fmpz_mpoly_q_neg(&by[0], &by[0], ring());
    for (int n = 0; s == SS_OK && n < abs(times[j]); n++) s = add_angle(p, f, by);
  }
  for (int j = 0; j < 2; j++) exact_clear(&by[j], f);
  return s;
}

/* The integer i from -MOST_ANGLES to MOST_ANGLES for which x and i a agree at the one monomial of a; false without
   one. */
static bool multiple_at(int *i, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *a) {
  enum { MOST_ANGLES = 8 };
  fmpz_t up, down, c;
  fmpz_init(up);
  fmpz_init(down);
  fmpz_init(c);
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
  fmpz_clear(c);
  fmpz_clear(down);
  fmpz_clear(up);
  return whole;
}

/* x with a denominator free of generators that have a square: a + b g times a - b g is. */
static int rationalise(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_t conjugate, odd;
  int s = SS_OK;
  fmpz_mpoly_init(conjugate, ring());
  fmpz_mpoly_init(odd, ring());
  fmpz_mpoly_q_set(z, x, ring());
  for (slong i = f->n - 1; s == SS_OK && i >= 0; i--) {
    if (!f->gen[i].squared || fmpz_mpoly_degree_si(&z->den, variable(i), ring()) < 1) continue;
    fmpz_mpoly_derivative(odd, &z->den, variable(i), ring());
    fmpz_mpoly_gen(conjugate, variable(i), ring());
    fmpz_mpoly_mul(odd, odd, conjugate, ring());
    fmpz_mpoly_sub(conjugate, &z->den, odd, ring());
    fmpz_mpoly_sub(conjugate, conjugate, odd, ring());
    fmpz_mpoly_mul(&z->num, &z->num, conjugate, ring());
    fmpz_mpoly_mul(&z->den, &z->den, conjugate, ring());
    s = exact_reduce(z, f);
    if (s == SS_OK) fmpz_mpoly_q_canonicalise(z, ring());
  }
  fmpz_mpoly_clear(odd, ring());
  fmpz_mpoly_clear(conjugate, ring());
  return s;
}

/* Is x = i a + k b?  Then these are i and k, since a and b are different monomials. */
static bool is_sum(int *i, int *k, struct exact_field *f, const fmpz_mpoly_q_struct *x, int a, int b) {
  if (!fmpz_mpoly_is_fmpz(&x->den, ring()) || !multiple_at(i, x, &f->angle[a]) || !multiple_at(k, x, &f->angle[b]))
    return false;
  fmpz_mpoly_q_struct u, v, n;
  exact_init(&u, f);
  exact_init(&v, f);
  exact_init(&n, f);
  fmpz_mpoly_q_set_si(&n, *i, ring());
  bool ok = exact_apply(num_exact.mul, &u, f, &f->angle[a], &n) == SS_OK;
  fmpz_mpoly_q_set_si(&n, *k, ring());
  ok = ok && exact_apply(num_exact.mul, &v, f, &f->angle[b], &n) == SS_OK;
  ok = ok && exact_apply(num_exact.add, &u, f, &u, &v) == SS_OK && exact_equal(f, x, &u);
  exact_clear(&n, f);
  exact_clear(&v, f);
  exact_clear(&u, f);
  return ok;
}

int exact_sin_cos(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct p[2], plain;
  int i, k;
  bool found = false;
  exact_init(&plain, f);
  for (int j = 0; j < 2; j++) exact_init(&p[j], f);
  if (rationalise(&plain, f, x) != SS_OK) fmpz_mpoly_q_set(&plain, x, ring());
  int status = SS_OK;
  for (int a = 0; !found && a < f->n_angles; a++)
    for (int b = a + 1; !found && b < f->n_angles && b / f->group == a / f->group; b++) {
      found = is_sum(&i, &k, f, &plain, a, b);
      if (found) status = make_sum(p, f, a, i, b, k);
    }
  if (!found) status = own_angle(&p[0], &p[1], f, x);
  fmpz_mpoly_q_swap(s, &p[0], ring());
  fmpz_mpoly_q_swap(c, &p[1], ring());
  for (int j = 0; j < 2; j++) exact_clear(&p[j], f);
  exact_clear(&plain, f);
  return status;
}

int exact_circular(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct s, c;
  exact_init(&s, f);
  exact_init(&c, f);
  int status = exact_sin_cos(&s, &c, f, x);
  if (status == SS_OK && op == TAPE_cot)
    status = exact_apply(num_exact.div, z, f, &c, &s);
  else
    fmpz_mpoly_q_swap(z, op == TAPE_sin ? &s : &c, ring());
  exact_clear(&c, f);
  exact_clear(&s, f);
  return status;
}

/* Can the numerator vanish on a whole domain though it is not zero here, as sqrt(4 V) - 2 sqrt(V) or |z| - z do?  Not
                                                                                                                   when
   the product over all signs of the generators that have squares is no zero.  True also when that grows too large. */
static bool may_vanish(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct p, conjugate;
  exact_init(&p, f);
  exact_init(&conjugate, f);
  fmpz_mpoly_set(&p.num, &x->num, ring());
  int s = SS_OK;
  for (slong i = f->n - 1; s == SS_OK && i >= 0; i--) {
    slong var = variable(i);
    if (!f->gen[i].squared || fmpz_mpoly_degree_si(&p.num, var, ring()) < 1) continue;
    fmpz_mpoly_derivative(&conjugate.num, &p.num, var, ring()); /* of a + b g with a square g^2: b */
    fmpz_mpoly_gen(&conjugate.den, var, ring());
    fmpz_mpoly_mul(&conjugate.num, &conjugate.num, &conjugate.den, ring());
    fmpz_mpoly_scalar_mul_si(&conjugate.num, &conjugate.num, -2, ring());
    fmpz_mpoly_add(&conjugate.num, &conjugate.num, &p.num, ring());
    fmpz_mpoly_one(&conjugate.den, ring());
    s = exact_apply(num_exact.mul, &p, f, &p, &conjugate);
  }
  bool may = s != SS_OK || exact_is_zero(f, &p);
  exact_clear(&conjugate, f);
  exact_clear(&p, f);
  return may;
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
  fmpz_mpoly_q_struct sine;
  exact_init(&sine, f);
  int s = exact_circular(&sine, f, TAPE_sin, x);
  if (s == SS_OK && op == TAPE_stumpff) s = exact_apply(num_exact.sub, &sine, f, x, &sine);
  for (int i = 0; s == SS_OK && i < (op == TAPE_stumpff ? 3 : 1); i++)
    s = exact_apply(num_exact.div, &sine, f, &sine, x);
  fmpz_mpoly_q_swap(z, &sine, ring());
  exact_clear(&sine, f);
  return s;
}
