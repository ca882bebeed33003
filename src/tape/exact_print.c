/* Elements in print and at points: written with the names of their symbols; with rational values of the generators at
   which they are not zero; and whether they are zero where one symbol has a given value. */
#include <string.h>

#include "exact_impl.h"

static void print_polynomial(struct text *out, const struct exact_field *f, const fmpz_mpoly_struct *p);

/* "sin(sqrt(eta*chi)*tau)"; as a factor of an element, n sqrt(p/n) is that and not sqrt(p/n). */
static void print_generator(struct text *out, const struct exact_field *f, slong i, bool factor) {
  const struct generator *g = &f->gen[i];
  if (g->op == TAPE_INPUT) {
    text_add(out, g->name);
    return;
  }
  if (factor && g->op == TAPE_sqrt && !fmpz_mpoly_is_one(&g->args[0].den, ring())) {
    text_add(out, "(");
    print_polynomial(out, f, &g->args[0].den);
    text_add(out, ")*");
  }
  text_add(out, g->op == TAPE_sin    ? "sin("
                : g->op == TAPE_cos  ? "cos("
                : g->op == TAPE_sqrt ? "sqrt("
                : g->op == TAPE_abs  ? "abs("
                : g->op == TAPE_exp  ? "exp("
                                     : "root(");
  for (slong k = 0; k < g->n_args; k++) {
    if (k) text_add(out, "; ");
    exact_print(out, f, &g->args[k]);
  }
  text_add(out, ")");
}

/* Generators are made of older ones, so that this comes to an end. */
static void print_polynomial(struct text *out, const struct exact_field *f, const fmpz_mpoly_struct *p) {
  int used[EXACT_GENERATORS];
  struct text label[EXACT_GENERATORS] = {{.len = 0}};
  const char *names[EXACT_GENERATORS];
  fmpz_mpoly_used_vars(used, p, ring());
  for (slong k = 0; k < EXACT_GENERATORS; k++) {
    if (used[k]) print_generator(&label[k], f, variable(k), true);
    names[k] = text_str(&label[k]);
  }
  char *printed = fmpz_mpoly_get_str_pretty(p, names, ring());
  text_add(out, printed);
  flint_free(printed);
  for (slong k = 0; k < EXACT_GENERATORS; k++) text_clear(&label[k]);
}

void exact_print(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  bool whole = fmpz_mpoly_is_one(&x->den, ring()) != 0;
  text_add(out, whole ? "" : "(");
  print_polynomial(out, f, &x->num);
  if (whole) return;
  text_add(out, ")/(");
  print_polynomial(out, f, &x->den);
  text_add(out, ")");
}

void exact_print_generators(struct text *out, const struct exact_field *f) {
  for (slong i = 0; i < f->n; i++) {
    if (i) text_add(out, ", ");
    print_generator(out, f, i, false);
  }
}

static bool square_root(fmpq_t z, const fmpq_t x) {
  if (!fmpz_is_square(fmpq_numref(x)) || !fmpz_is_square(fmpq_denref(x))) return false;
  fmpz_sqrt(fmpq_numref(z), fmpq_numref(x));
  fmpz_sqrt(fmpq_denref(z), fmpq_denref(x));
  return true;
}

/* n where the generator stands for n sqrt(p/n), else 1; false where it is zero. */
static bool scale_of(fmpq_t z, const struct generator *g, const fmpq *value) {
  fmpq_one(z);
  if (g->op == TAPE_sqrt) num_exact_polynomial_at(z, &g->args[0].den, value);
  return !fmpq_is_zero(z);
}

/* Small rationals, distinct for the generators; sines by half-angle tangents.  false when a root is irrational
   there. */
static bool draw_values(fmpq *value, const struct exact_field *f, ulong *state) {
  NUMBERS(fmpq, square, scale);
  bool ok = true;
  for (slong i = 0; ok && i < f->n; i++) {
    const struct generator *g = &f->gen[i];
    fmpq *z = &value[variable(i)];
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    slong a = 1 + (slong)(*state >> 40) % 11, b = 1 + (slong)(*state >> 50) % 7;
    if (g->op == TAPE_sin)
      fmpq_set_si(z, 2 * a * b, (ulong)(a * a + b * b));
    else if (!g->squared)
      fmpq_set_si(z, a, (ulong)b);
    else {
      num_exact_polynomial_at(square, g->square, value);
      ok = square_root(z, square) && scale_of(scale, g, value);
      if (fmpq_sgn(scale) < 0) fmpq_neg(z, z);
    }
  }
  return ok;
}

static void print_witness(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
                          const fmpq *value, const fmpq_t there) {
  int used[EXACT_GENERATORS];
  NUMBERS(fmpq, z);
  fmpz_mpoly_q_used_vars(used, x, ring());
  num_print_q(out, there);
  const char *sep = " at ";
  for (slong i = 0; i < f->n; i++) {
    if (!used[variable(i)]) continue;
    text_add(out, sep);
    print_generator(out, f, i, false);
    text_add(out, " = ");
    if (scale_of(z, &f->gen[i], value)) fmpq_div(z, &value[variable(i)], z);
    num_print_q(out, z);
    sep = ", ";
  }
}

bool exact_witness(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  enum { TRIALS = 2000 };
  FMPQ_VECTOR(value, EXACT_GENERATORS);
  NUMBERS(fmpq, there);
  ulong state = 1;
  bool found = false;
  for (int k = 0; !found && k < TRIALS; k++) {
    if (!draw_values(value, f, &state)) continue;
    found = num_exact_at(there, x, value) == SS_OK && !fmpq_is_zero(there);
  }
  if (found) print_witness(out, f, x, value, there);
  return found;
}

/* q g - p divides the numerator. */
bool exact_vanishes_at(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name,
                       const fmpq_t value) {
  slong i = 0;
  while (i < f->n && !(f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, name) == 0)) i++;
  if (i == f->n) return exact_is_zero(x);
  NUMBERS(polynomial, factor, q);
  fmpz_mpoly_gen(factor, variable(i), ring());
  fmpz_mpoly_scalar_mul_fmpz(factor, factor, fmpq_denref(value), ring());
  fmpz_mpoly_sub_fmpz(factor, factor, fmpq_numref(value), ring());
  return fmpz_mpoly_divides(q, &x->num, factor, ring()) != 0;
}
