/* A field of rational functions modulo relations: its elements, its generators, and the rewriting that keeps elements
   small. What is not rational (sines, roots) becomes a generator of its own, found again by its argument; the table of
   generators belongs to the field, so that several tapes share them.  A younger generator stands earlier in the ring's
   order, so that each relation rewrites its own square. */
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "exact_impl.h"

struct exact_field *exact_field_new(const struct exact_fact *fact, int n_facts) {
  struct exact_field *f = ss_malloc(sizeof *f);
  work_touch(WORK_ALGEBRA);
  *f = (struct exact_field){.limit = EXACT_TERMS, .fact = fact, .n_facts = n_facts};
  return f;
}

void exact_field_limit(struct exact_field *f, slong terms) {
  f->limit = terms;
}

void exact_field_bind(struct exact_field *f, exact_binder bind, void *arg) {
  f->bind = bind;
  f->bind_arg = arg;
}

void exact_field_roots(struct exact_field *f, const fmpz_mpoly_q_struct *root, int n) {
  f->root = root;
  f->n_roots = n;
}

void exact_field_positive(struct exact_field *f, const fmpz_mpoly_q_struct *positive, int n, int n_strict) {
  f->positive = positive;
  f->n_positive = n;
  f->n_strict = n_strict;
}

slong exact_largest(const struct exact_field *f) {
  return f->largest;
}

void exact_init(fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_init(x, ring());
}

void exact_clear(fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_clear(x, ring());
}

void exact_field_free(struct exact_field *f) {
  for (slong i = 0; i < f->n; i++) {
    free(f->gen[i].name);
    for (slong k = 0; k < f->gen[i].n_args; k++) exact_clear(&f->gen[i].args[k]);
    free(f->gen[i].args);
    if (f->gen[i].squared) fmpz_mpoly_clear(f->gen[i].square, ring());
  }
  free(f);
}

/* --- Relations --- */

/* p with the powers of generator i above the first rewritten. */
static void rewrite_one(fmpz_mpoly_struct *p, const struct generator *g, slong var) {
  fmpz_mpoly_univar_t u;
  NUMBERS(polynomial, c, power, x);
  fmpz_mpoly_univar_init(u, ring());
  fmpz_mpoly_to_univar(u, p, var, ring());
  fmpz_mpoly_zero(p, ring());
  fmpz_mpoly_gen(x, var, ring());
  for (slong i = 0; i < fmpz_mpoly_univar_length(u, ring()); i++) {
    slong e = fmpz_mpoly_univar_get_term_exp_si(u, i, ring());
    fmpz_mpoly_univar_get_term_coeff(c, u, i, ring());
    fmpz_mpoly_pow_ui(power, g->square, (ulong)e / 2, ring());
    fmpz_mpoly_mul(c, c, power, ring());
    if (e % 2) fmpz_mpoly_mul(c, c, x, ring());
    fmpz_mpoly_add(p, p, c, ring());
  }
  fmpz_mpoly_univar_clear(u, ring());
}

/* The youngest first: a square holds older generators only. */
bool exact_rewrite(fmpz_mpoly_struct *p, const struct exact_field *f) {
  slong degree[EXACT_GENERATORS];
  bool changed = false;
  if (fmpz_mpoly_is_fmpz(p, ring())) return false;
  fmpz_mpoly_degrees_si(degree, p, ring());
  for (slong i = f->n - 1; i >= 0; i--) {
    if (!f->gen[i].squared || degree[variable(i)] < 2) continue;
    rewrite_one(p, &f->gen[i], variable(i));
    if (fmpz_mpoly_is_fmpz(p, ring())) return true;
    fmpz_mpoly_degrees_si(degree, p, ring());
    changed = true;
  }
  return changed;
}

int exact_reduce(fmpz_mpoly_q_struct *z, const struct exact_field *f) {
  bool num = exact_rewrite(&z->num, f), den = exact_rewrite(&z->den, f);
  if (fmpz_mpoly_is_zero(&z->den, ring())) {
    fmpz_mpoly_one(&z->den, ring());
    return SS_DOMAIN;
  }
  if (num || den) fmpz_mpoly_q_canonicalise(z, ring());
  return num_exact_terms(z) <= f->limit ? SS_OK : SS_UNABLE;
}

static int rewrite(void *z, const void *field) {
  return exact_reduce(z, field);
}

struct calc exact_calc(const struct exact_field *f) {
  struct calc c = calc_begin(num_ctx_exact());
  c.reduce = rewrite;
  c.field = f;
  return c;
}

val exact_polynomial(struct calc *c, const fmpz_mpoly_struct *p) {
  fmpz_mpoly_q_struct *z = calc_new(c);
  fmpz_mpoly_set(&z->num, p, ring());
  return z;
}

void exact_term(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong i) {
  fmpz_mpoly_get_term(&z->num, &x->num, i, ring());
  fmpz_mpoly_set(&z->den, &x->den, ring());
  fmpz_mpoly_q_canonicalise(z, ring());
}

int exact_finish(fmpz_mpoly_q_struct *z, struct calc *c, val x) {
  int s = c->status;
  if (s == SS_OK) calc_store(c, z, x);
  calc_clear(c);
  return s;
}

bool exact_is_zero(const fmpz_mpoly_q_struct *x) {
  return fmpz_mpoly_q_is_zero(x, ring());
}

/* Products are refused before they are made. */
static bool fits(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y, bool sum) {
  slong most = f->limit * f->limit / 16;
  return num_exact_work(x, y, sum) <= (most < NUM_EXACT_PRODUCT ? most : NUM_EXACT_PRODUCT);
}

int exact_apply(num_binary op, fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
                const fmpz_mpoly_q_struct *y) {
  if (!fits(f, x, y, op == num_exact.add || op == num_exact.sub)) return SS_UNABLE;
  int s = op(z, x, y, 0);
  return s ? s : exact_reduce(z, f);
}

bool exact_sub(fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
               const fmpz_mpoly_q_struct *y) {
  return exact_apply(num_exact.sub, z, f, x, y) == SS_OK;
}

bool exact_equal(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  if (fmpz_mpoly_q_equal(x, y, ring())) return true;
  NUMBERS(quotient, d);
  return exact_sub(d, f, x, y) && exact_is_zero(d);
}

/* x without its sign, which is that of the leading coefficient of its numerator; whether that is negative. */
bool exact_take_sign(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x) {
  NUMBERS(fmpz, lead);
  fmpz_mpoly_get_term_coeff_fmpz(lead, &x->num, 0, ring());
  bool negative = fmpz_sgn(lead) < 0;
  if (negative)
    fmpz_mpoly_q_neg(z, x, ring());
  else
    fmpz_mpoly_q_set(z, x, ring());
  return negative;
}

/* --- Generators --- */

static bool same_generator(const struct exact_field *f, const struct generator *g, enum tape_op op, const char *name,
                           const fmpz_mpoly_q_struct *args, slong n, slong k) {
  if (g->op != op || g->k != k || g->n_args != n) return false;
  if (name) return strcmp(g->name, name) == 0;
  for (slong i = 0; i < n; i++)
    if (!exact_equal(f, &g->args[i], &args[i])) return false;
  return true;
}

/* The index of the generator of those contents, which is made when it is new; -1 when there is no room. */
slong exact_generator(struct exact_field *f, enum tape_op op, const char *name, const fmpz_mpoly_q_struct *args,
                      slong n, slong k) {
  slong i = 0;
  while (i < f->n && !same_generator(f, &f->gen[i], op, name, args, n, k)) i++;
  if (i == EXACT_GENERATORS) return -1;
  if (i < f->n) return i;
  struct generator *g = &f->gen[f->n++];
  *g = (struct generator){.op = op, .n_args = n, .k = k};
  if (name) g->name = ss_strdup(name);
  if (n) g->args = ss_malloc((size_t)n * sizeof *g->args);
  for (slong a = 0; a < n; a++) {
    exact_init(&g->args[a]);
    fmpz_mpoly_q_set(&g->args[a], &args[a], ring());
  }
  return i;
}

void exact_set_square(struct generator *g, const fmpz_mpoly_struct *square) {
  g->squared = true;
  fmpz_mpoly_init(g->square, ring());
  fmpz_mpoly_set(g->square, square, ring());
}

int exact_set_generator(fmpz_mpoly_q_struct *z, slong i) {
  if (i < 0) return SS_UNABLE;
  fmpz_mpoly_q_gen(z, variable(i), ring());
  return SS_OK;
}

int exact_symbol(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name) {
  return exact_set_generator(z, exact_generator(f, TAPE_INPUT, name, NULL, 0, 0));
}
