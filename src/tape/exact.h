/* Tapes over rational functions with rational coefficients: to prove that two tapes compute the same.

   A field is Q(g1, g2, ...) modulo relations, with a generator for each free symbol, sine, cosine, square root and root
   of a polynomial, known again when its argument (its coefficients) is equal in the field; sin(-u) = -sin(u), cos(-u) =
   cos(u), sin(u + pi/2) = cos(u), cos(u + pi/2) = -sin(u), cot = cos/sin, sinc = sin u/u, stumpff = (u - sin u)/u^3,
   hypot(u, v) = sqrt(u^2 + v^2), |u v| = |u| |v|, exp(p u + q v) = exp(u)^p exp(v)^q for whole p, q.  The relations
   cos^2 = 1 - sin^2, sqrt(u)^2 = u and |u|^2 = u^2 rewrite the generator with the square by generators that are older
   (that of sqrt(p/n) stands for n sqrt(p/n), whose square is the polynomial p n); their leading terms are coprime, so
   they are a Groebner basis, and a numerator is in their ideal exactly when it is rewritten to zero.  Numerators and
   denominators are kept rewritten.
   Symbols may be defined by facts or by a binder.

   Equal elements are equal functions wherever both are defined.  Elements that differ are different functions of their
   generators; that says something about the formulas only when these know of no relation but those used
   (exact_independent).

   A computation that would hold more than the field's limit of terms (EXACT_TERMS unless set) in a numerator or
   denominator, or need more than EXACT_GENERATORS generators, is given up: SS_UNABLE.  Elements are those of
   num_exact. */
#ifndef STICKSLIP_TAPE_EXACT_H
#define STICKSLIP_TAPE_EXACT_H

#include "num/calc.h"
#include "num/num_exact.h"
#include "tape.h"

typedef fmpz_mpoly_q_struct element;

enum { EXACT_GENERATORS = NUM_EXACT_GENERATORS, EXACT_TERMS = 256 };

/* A symbol that is not free: what it equals, as a tape of one output.  Facts may use each other, not in a circle. */
struct exact_fact {
  const char *name;
  struct tape tape;
};

struct exact_field;
/* The facts are borrowed. */
struct exact_field *exact_field_new(const struct exact_fact *fact, int n_facts);
void exact_field_free(struct exact_field *f);
/* EXACT_FIELD f = exact_field_new(...): one that is freed as the variables of base/owned.h are. */
#define EXACT_FIELD OWNED_CLEARED(exact_field_owned_free) struct exact_field *
static inline void exact_field_owned_free(struct exact_field **f) {
  exact_field_free(*f);
}
void exact_field_limit(struct exact_field *f, slong terms);
/* The value of an input is asked of the binder, not of the facts; its status is that of the input. */
typedef int (*exact_binder)(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name, void *arg);
void exact_field_bind(struct exact_field *f, exact_binder bind, void *arg);
/* Positive elements in increasing order, among which roots of even polynomials are found: x is the k-th positive root
   when as many of them are roots as half of the degree.  Borrowed. */
void exact_field_roots(struct exact_field *f, const fmpz_mpoly_q_struct *root, int n);

/* Elements that are nowhere negative where the answer is used, and the first n_strict of them nowhere zero either: the
   root of the square of one is that element.  Borrowed. */
void exact_field_positive(struct exact_field *f, const fmpz_mpoly_q_struct *positive, int n, int n_strict);
/* Sines and cosines of sums are made of those of their terms' parts: of a term r m, with a rational factor r, of those
   of m/parts, where that is at most 8 times in it. */
void exact_field_angles(struct exact_field *f, slong parts);
/* The same with the least common denominator of the factors r in all sines so far; false without any. */
bool exact_field_parts(struct exact_field *f);

/* The generator of a free symbol; the square root of an element; sine and cosine of one. */
int exact_symbol(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name);
int exact_sqrt(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x);
int exact_sin_cos(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f, const fmpz_mpoly_q_struct *x);
/* x times the generators of square roots that it contains; false when there is none, or the product grows too large. */
bool exact_times_roots(fmpz_mpoly_q_struct *x, const struct exact_field *f);
/* Rewrites by the relations what was computed by num_exact.  SS_DOMAIN when the denominator is zero, SS_UNABLE beyond
   the limit. */
int exact_reduce(fmpz_mpoly_q_struct *z, const struct exact_field *f);
/* Formulas in the field (num/calc.h): each result is rewritten so, and no operation is begun once one has failed. */
struct calc exact_calc(const struct exact_field *f);
/* The derivative by a free symbol, of which the arguments of sines and cosines may be functions and roots may not. */
int exact_derivative(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name);

/* The outputs of a tape as elements of a field, in a vector of the calc.  SS_OK, SS_DOMAIN (a division by zero) or
   SS_UNABLE; then the values mean nothing. */
int exact_eval(struct num_vec *out, struct calc *c, struct exact_field *f, const struct tape *t);
/* The same with the status of each output (its value means nothing unless SS_OK); returns their union.  Only the wanted
   outputs (NULL: all) are computed, the others are SS_UNABLE. */
int exact_eval_each(struct num_vec *out, int *status, struct calc *c, struct exact_field *f, const struct tape *t,
                    const bool *wanted);
/* Are the outputs of two tapes, as many, the same elements?  false where that is not known. */
bool exact_tapes_equal(struct exact_field *f, const struct tape *a, const struct tape *b);
/* The largest number of terms that any register has had. */
slong exact_largest(const struct exact_field *f);
/* An element by the names of its free symbols and the functions that other generators stand for. */
void exact_print(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x);
/* The generators in use, by name and joined by ", ": chi, omega_1, sin(...). */
void exact_print_generators(struct text *out, const struct exact_field *f);

/* The sign of k when x = k y with k a nonzero rational times powers of the named symbols, which must be positive
   wherever the answer is used (none: x = y up to a rational factor); 0 when there is none, or it cannot be told.  Two
   zeros give 1. */
int exact_ratio_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y,
                     const char *const *positive, int n_positive);
/* The sign of a polynomial all of whose terms have it, over generators that are positive and squares of others, and one
   of them over the former alone, unless it may be zero, too; else 0. */
int exact_terms_sign(const fmpz_mpoly_struct *p, const bool positive[EXACT_GENERATORS], bool or_zero);
/* The sign of x, wherever it has a value, by what the field knows of its generators and by its positive elements; x may
   be zero as well, unless strict.  0: not known. */
int exact_sign(const struct exact_field *f, const fmpz_mpoly_q_struct *x, bool strict);
/* The sign of a product of powers of some of these elements, which must be positive polynomials, with a polynomial in
   numerator and denominator that has one by its terms; 0 when x is not known to be such a product. */
int exact_product_sign(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *positive, int n);
/* z = x divided by every power of such elements, and by every positive rational number, that divides it: of the sign
   of x. */
void exact_without_factors(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *positive,
                           int n);
bool exact_is_zero(const fmpz_mpoly_q_struct *x);
bool exact_equal(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y);
/* z = x - y; false when it grows too large. */
bool exact_sub(fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
               const fmpz_mpoly_q_struct *y);
void exact_init(fmpz_mpoly_q_struct *x);
void exact_clear(fmpz_mpoly_q_struct *x);

/* Rational values of the generators, which obey the relations, at which x is defined and not zero, as "chi = 1/2, ...",
   and x there.  false when none was found among a few hundred. */
bool exact_witness(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x);
/* Whether the generators obey no relations but those used, so that elements that differ are different functions of the
   free symbols: no roots, at most one square root, and that not of a square, and angles whose arguments are distinct
   monomials (then linearly independent, and so their sines algebraically).  false: it cannot be told. */
bool exact_independent(const struct exact_field *f);
/* Is x zero where the free symbol has the value (which must be of the form p/q)? */
bool exact_vanishes_at(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name, const fmpq_t value);

#endif
