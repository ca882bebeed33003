/* What can be told from the form of elements alone: that one is another's multiple by something positive, and that the
   generators of a field obey no relations but those that the field uses, so that elements which differ are different
   functions. */
#include <string.h>

#include "exact_impl.h"

/* A single term in generators that are inputs of the given names: the sign of its coefficient, else 0. */
static int unit_sign(const struct exact_field *f, const fmpz_mpoly_struct *p, const char *const *positive, int n) {
  if (fmpz_mpoly_length(p, ring()) != 1) return 0;
  int used[EXACT_GENERATORS];
  fmpz_mpoly_used_vars(used, p, ring());
  for (slong i = 0; i < f->n; i++) {
    bool known = !used[variable(i)];
    for (int k = 0; !known && k < n; k++)
      known = f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, positive[k]) == 0;
    if (!known) return 0;
  }
  NUMBERS(fmpz, c);
  fmpz_mpoly_get_term_coeff_fmpz(c, p, 0, ring());
  return fmpz_sgn(c);
}

int exact_ratio_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y,
                     const char *const *positive, int n_positive) {
  bool x0 = exact_is_zero(x), y0 = exact_is_zero(y);
  if (x0 || y0) return x0 && y0;
  NUMBERS(quotient, k);
  if (exact_apply(num_exact.div, k, f, x, y) != SS_OK) return 0;
  return unit_sign(f, &k->num, positive, n_positive) * unit_sign(f, &k->den, positive, n_positive);
}

/* Takes a factor out of p as often as it is there. */
static void take_factor(fmpz_mpoly_struct *p, const fmpz_mpoly_struct *factor) {
  NUMBERS(polynomial, quotient);
  if (fmpz_mpoly_is_fmpz(factor, ring()) || fmpz_mpoly_is_zero(p, ring())) return;
  while (fmpz_mpoly_divides(quotient, p, factor, ring())) fmpz_mpoly_swap(p, quotient, ring());
}

static void take_out(fmpz_mpoly_struct *p, const fmpz_mpoly_q_struct *positive, int n) {
  for (int i = 0; i < n; i++)
    if (fmpz_mpoly_is_fmpz(&positive[i].den, ring())) take_factor(p, &positive[i].num);
}

int exact_terms_sign(const fmpz_mpoly_struct *p, const bool positive[EXACT_GENERATORS], bool or_zero) {
  slong e[EXACT_GENERATORS];
  int sign = 0;
  bool same = true, any = or_zero; /* a term that is nowhere zero */
  NUMBERS(fmpz, k);
  for (slong i = 0; same && i < fmpz_mpoly_length(p, ring()); i++) {
    bool never = true;
    fmpz_mpoly_get_term_coeff_fmpz(k, p, i, ring());
    fmpz_mpoly_get_term_exp_si(e, p, i, ring());
    same = i == 0 || sign == fmpz_sgn(k);
    for (int g = 0; g < EXACT_GENERATORS; g++) {
      same = same && (positive[g] || e[g] % 2 == 0);
      never = never && (positive[g] || e[g] == 0);
    }
    sign = fmpz_sgn(k);
    any = any || never;
  }
  return same && any ? sign : 0;
}

void exact_factor(fmpz_mpoly_factor_struct *z, const fmpz_mpoly_struct *p) {
  enum { MOST_TERMS = 64 };
  NUMBERS(polynomial, root);
  if (fmpz_mpoly_length(p, ring()) <= MOST_TERMS && fmpz_mpoly_factor(z, p, ring())) return;
  if (!fmpz_mpoly_sqrt(root, p, ring())) {
    fmpz_mpoly_factor_one(z, ring());
    fmpz_mpoly_factor_append_ui(z, p, 1, ring());
    return;
  }
  exact_factor(z, root);
  fmpz_mul(z->constant, z->constant, z->constant);
  for (slong i = 0; i < z->num; i++) fmpz_mul_ui(&z->exp[i], &z->exp[i], 2);
}

/* The sign of the product of the factors of p whose exponents are odd, where it may be zero, too. */
static int factors_sign(const fmpz_mpoly_struct *p, const bool positive[EXACT_GENERATORS]) {
  fmpz_mpoly_factor_t factors;
  fmpz_mpoly_factor_init(factors, ring());
  exact_factor(factors, p);
  int sign = fmpz_sgn(factors->constant);
  for (slong i = 0; sign && i < factors->num; i++)
    if (fmpz_is_odd(&factors->exp[i])) sign *= exact_terms_sign(&factors->poly[i], positive, true);
  fmpz_mpoly_factor_clear(factors, ring());
  return sign;
}

/* The sign of p at every point at which these elements are positive, or (or_zero) not negative, and all generators of p
   have values.  Of those of a field (NULL: of none) is known: an exponential is positive, and so are the root and the
   absolute value of what is positive; other roots and absolute values are not negative, but for the root of a quotient,
   whose generator has the sign of its denominator; neither are 1 - x and 1 + x for a sine or cosine x.  That a root in
   the field has a value says nothing of what stands under it: p need not contain that root. */
static int sign_of(const struct exact_field *f, const fmpz_mpoly_struct *p, const fmpz_mpoly_q_struct *positive, int n,
                   bool or_zero) {
  slong e[EXACT_GENERATORS];
  bool sure[EXACT_GENERATORS] = {false};
  NUMBERS(polynomial, rest, other);
  fmpz_mpoly_set(rest, p, ring());
  take_out(rest, positive, n);
  for (int i = 0; i < n; i++) {
    if (!fmpz_mpoly_is_gen(&positive[i].num, -1, ring()) || !fmpz_mpoly_is_one(&positive[i].den, ring())) continue;
    fmpz_mpoly_get_term_exp_si(e, &positive[i].num, 0, ring());
    for (int g = 0; g < EXACT_GENERATORS; g++) sure[g] = sure[g] || e[g];
  }
  for (slong i = 0; f && i < f->n; i++) { /* a square holds older generators only, which are known by then */
    const struct generator *g = &f->gen[i];
    bool root = g->op == TAPE_abs || (g->op == TAPE_sqrt && fmpz_mpoly_is_one(&g->args[0].den, ring()));
    if (g->op == TAPE_exp || (root && or_zero)) sure[variable(i)] = true;
    if (root && g->squared && !or_zero) {
      fmpz_mpoly_set(other, g->square, ring());
      take_out(other, positive, n);
      if (exact_terms_sign(other, sure, false) > 0) sure[variable(i)] = true;
    }
    for (int k = -1; or_zero && (g->op == TAPE_sin || g->op == TAPE_cos) && k <= 1; k += 2) {
      fmpz_mpoly_gen(other, variable(i), ring());
      fmpz_mpoly_scalar_mul_si(other, other, k, ring());
      fmpz_mpoly_add_si(other, other, 1, ring());
      take_factor(rest, other);
    }
  }
  int sign = exact_terms_sign(rest, sure, or_zero);
  return sign || !or_zero ? sign : factors_sign(rest, sure);
}

int exact_product_sign(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *positive, int n) {
  return sign_of(NULL, &x->num, positive, n, false) * sign_of(NULL, &x->den, positive, n, false);
}

int exact_polynomial_sign(const struct exact_field *f, const fmpz_mpoly_struct *p, bool strict) {
  return sign_of(f, p, f->positive, strict ? f->n_strict : f->n_positive, !strict);
}

int exact_sign(const struct exact_field *f, const fmpz_mpoly_q_struct *x, bool strict) {
  return exact_polynomial_sign(f, &x->num, strict) * exact_polynomial_sign(f, &x->den, false);
}

void exact_without_factors(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *positive,
                           int n) {
  NUMBERS(fmpz, content);
  fmpz_mpoly_q_set(z, x, ring());
  fmpz_mpoly_struct *part[2] = {&z->num, &z->den};
  for (int i = 0; i < 2 && !exact_is_zero(z); i++) {
    take_out(part[i], positive, n);
    _fmpz_vec_content(content, part[i]->coeffs, part[i]->length);
    fmpz_mpoly_scalar_divexact_fmpz(part[i], part[i], content, ring());
  }
  fmpz_mpoly_q_canonicalise(z, ring());
}

/* --- Independence --- */

/* A rational number times a product of powers of free symbols and square roots. */
static bool is_monomial(const fmpz_mpoly_q_struct *x) {
  return fmpz_mpoly_length(&x->num, ring()) == 1 && fmpz_mpoly_is_one(&x->den, ring());
}

static bool same_monomial(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  slong a[EXACT_GENERATORS], b[EXACT_GENERATORS];
  fmpz_mpoly_get_term_exp_si(a, &x->num, 0, ring());
  fmpz_mpoly_get_term_exp_si(b, &y->num, 0, ring());
  return memcmp(a, b, sizeof a) == 0;
}

bool exact_independent(const struct exact_field *f) {
  int roots = 0;
  for (slong i = 0; i < f->n; i++) {
    const struct generator *g = &f->gen[i];
    if (g->op == TAPE_ROOT || g->op == TAPE_abs || g->op == TAPE_exp) return false;
    if (g->op == TAPE_sqrt && (roots++ || !g->squared || fmpz_mpoly_is_square(g->square, ring()))) return false;
    if (g->op != TAPE_sin) continue;
    if (!is_monomial(&g->args[0])) return false;
    for (slong k = 0; k < i; k++)
      if (f->gen[k].op == TAPE_sin && same_monomial(&g->args[0], &f->gen[k].args[0])) return false;
  }
  return true;
}
