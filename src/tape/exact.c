/* One pass over a tape in a field of rational functions.  What is not rational (sines, roots) becomes a generator of its
   own, found again by its argument; the table of generators belongs to the field, so that several tapes share them. */
#include "stickslip/exact.h"

#include <stdlib.h>
#include <string.h>

/* What a generator stands for: an input by name, or a function of elements. */
struct generator {
  enum tape_op op;
  char *name;                /* TAPE_INPUT */
  fmpz_mpoly_q_struct *args; /* the others */
  slong n_args, k;           /* k: which root */
};

struct exact_field {
  fmpz_mpoly_ctx_t ctx;
  struct generator gen[EXACT_GENERATORS];
  slong n;
  const struct exact_fact *fact;
  int n_facts;
};

struct exact_field *exact_field_new(const struct exact_fact *fact, int n_facts) {
  struct exact_field *f = ss_malloc(sizeof *f);
  f->fact = fact;
  f->n_facts = n_facts;
  fmpz_mpoly_ctx_init(f->ctx, EXACT_GENERATORS, ORD_LEX);
  f->n = 0;
  return f;
}

void exact_init(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  fmpz_mpoly_q_init(x, f->ctx);
}

void exact_clear(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  fmpz_mpoly_q_clear(x, f->ctx);
}

void exact_field_free(struct exact_field *f) {
  for (slong i = 0; i < f->n; i++) {
    free(f->gen[i].name);
    for (slong k = 0; k < f->gen[i].n_args; k++) exact_clear(&f->gen[i].args[k], f);
    free(f->gen[i].args);
  }
  fmpz_mpoly_ctx_clear(f->ctx);
  free(f);
}

static slong terms(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  slong n = fmpz_mpoly_length(&x->num, f->ctx), m = fmpz_mpoly_length(&x->den, f->ctx);
  return n > m ? n : m;
}

bool exact_is_zero(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  return fmpz_mpoly_q_is_zero(x, f->ctx);
}

bool exact_equal(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  return fmpz_mpoly_q_equal(x, y, f->ctx);
}

/* Products are refused before they are made. */
static int fits(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  return terms(f, x) * terms(f, y) <= 16L * EXACT_TERMS ? SS_OK : SS_UNABLE;
}

bool exact_sub(fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
               const fmpz_mpoly_q_struct *y) {
  if (fits(f, x, y) != SS_OK) return false;
  fmpz_mpoly_q_sub(z, x, y, f->ctx);
  return true;
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

/* z becomes the generator of those contents, which is made when it is new. */
static int generator(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const char *name,
                     const fmpz_mpoly_q_struct *args, slong n, slong k) {
  slong i = 0;
  while (i < f->n && !same_generator(f, &f->gen[i], op, name, args, n, k)) i++;
  if (i == EXACT_GENERATORS) return SS_UNABLE;
  if (i == f->n) {
    struct generator *g = &f->gen[f->n++];
    *g = (struct generator){.op = op, .n_args = n, .k = k};
    if (name) g->name = strcpy(ss_malloc(strlen(name) + 1), name);
    if (n) g->args = ss_malloc((size_t)n * sizeof *g->args);
    for (slong a = 0; a < n; a++) {
      exact_init(&g->args[a], f);
      fmpz_mpoly_q_set(&g->args[a], &args[a], f->ctx);
    }
  }
  fmpz_mpoly_q_gen(z, i, f->ctx);
  return SS_OK;
}

static int input(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name) {
  for (int k = 0; k < f->n_facts; k++) {
    if (strcmp(f->fact[k].name, name) != 0) continue;
    struct exact_vec v;
    int s = exact_eval(&v, f, &f->fact[k].tape);
    if (s == SS_OK) fmpz_mpoly_q_set(z, &v.x[0], f->ctx);
    exact_vec_clear(&v);
    return s;
  }
  return generator(z, f, TAPE_INPUT, name, NULL, 0, 0);
}

/* sin or cos of x, by the sign of the leading coefficient of its numerator. */
static int circular(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  if (fmpz_mpoly_q_is_zero(x, f->ctx)) {
    fmpz_mpoly_q_set_si(z, op == TAPE_cos, f->ctx);
    return SS_OK;
  }
  fmpz_mpoly_q_struct arg;
  exact_init(&arg, f);
  fmpz_mpoly_q_set(&arg, x, f->ctx);
  fmpz_t lead;
  fmpz_init(lead);
  fmpz_mpoly_get_term_coeff_fmpz(lead, &x->num, 0, f->ctx);
  bool negative = fmpz_sgn(lead) < 0;
  if (negative) fmpz_mpoly_q_neg(&arg, &arg, f->ctx);
  int s = generator(z, f, op, NULL, &arg, 1, 0);
  if (negative && op == TAPE_sin) fmpz_mpoly_q_neg(z, z, f->ctx);
  fmpz_clear(lead);
  exact_clear(&arg, f);
  return s;
}

static int divide(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x,
                  const fmpz_mpoly_q_struct *y) {
  if (fmpz_mpoly_q_is_zero(y, f->ctx)) return SS_DOMAIN;
  int s = fits(f, x, y);
  if (s == SS_OK) fmpz_mpoly_q_div(z, x, y, f->ctx);
  return s;
}

static int cotangent(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct s;
  exact_init(&s, f);
  int status = circular(z, f, TAPE_cos, x);
  status |= circular(&s, f, TAPE_sin, x);
  if (status == SS_OK) status = divide(z, f, z, &s);
  exact_clear(&s, f);
  return status;
}

static int power(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, slong n) {
  enum { MAX_POWER = 16 };
  if (n < -MAX_POWER || n > MAX_POWER) return SS_UNABLE;
  if (n < 0 && fmpz_mpoly_q_is_zero(x, f->ctx)) return SS_DOMAIN;
  fmpz_mpoly_q_struct r;
  exact_init(&r, f);
  fmpz_mpoly_q_one(&r, f->ctx);
  int s = SS_OK;
  for (slong i = 0; s == SS_OK && i < labs(n); i++) {
    s = fits(f, &r, x);
    if (s == SS_OK) fmpz_mpoly_q_mul(&r, &r, x, f->ctx);
  }
  if (s == SS_OK && n < 0) fmpz_mpoly_q_inv(&r, &r, f->ctx);
  fmpz_mpoly_q_swap(z, &r, f->ctx);
  exact_clear(&r, f);
  return s;
}

/* Which root of which polynomial, up to a factor of the polynomial. */
static int root(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct tape *t, const struct tape_instr *in,
                const fmpz_mpoly_q_struct *reg) {
  fmpz_mpoly_q_struct *c = ss_malloc((size_t)in->b * sizeof *c);
  const fmpz_mpoly_q_struct *lead = &reg[t->links[in->a + in->b - 1]];
  int s = SS_OK;
  for (slong i = 0; i < in->b; i++) exact_init(&c[i], f);
  for (slong i = 0; s == SS_OK && i < in->b; i++) s = divide(&c[i], f, &reg[t->links[in->a + i]], lead);
  if (s == SS_OK) s = generator(z, f, TAPE_ROOT, NULL, c, in->b, in->k);
  for (slong i = 0; i < in->b; i++) exact_clear(&c[i], f);
  free(c);
  return s;
}

/* --- The pass --- */

static int run(const struct tape *t, slong i, fmpz_mpoly_q_struct *reg, struct exact_field *f) {
  const struct tape_instr *in = &t->code[i];
  fmpz_mpoly_q_struct *z = &reg[i];
  const fmpz_mpoly_q_struct *a = in->a >= 0 ? &reg[in->a] : NULL, *b = in->b >= 0 ? &reg[in->b] : NULL;
  int s = SS_OK;
  switch (in->op) {
  case TAPE_CONST:
    fmpz_mpoly_q_set_fmpq(z, &t->consts[in->k], f->ctx);
    return SS_OK;
  case TAPE_INPUT:
    return input(z, f, t->inputs[in->k]);
  case TAPE_ROOT:
    return root(z, f, t, in, reg);
  case TAPE_POW:
    return power(z, f, a, in->k);
  case TAPE_neg:
    fmpz_mpoly_q_neg(z, a, f->ctx);
    return SS_OK;
  case TAPE_sin:
  case TAPE_cos:
    return circular(z, f, in->op, a);
  case TAPE_cot:
    return cotangent(z, f, a);
  case TAPE_sqrt:
    return generator(z, f, TAPE_sqrt, NULL, a, 1, 0);
  case TAPE_div:
    return divide(z, f, a, b);
  case TAPE_add:
  case TAPE_sub:
  case TAPE_mul:
    s = fits(f, a, b);
    if (s == SS_OK)
      (in->op == TAPE_add   ? fmpz_mpoly_q_add
       : in->op == TAPE_sub ? fmpz_mpoly_q_sub
                            : fmpz_mpoly_q_mul)(z, a, b, f->ctx);
    return s;
  default:
    return SS_UNABLE;
  }
}

int exact_eval(struct exact_vec *out, struct exact_field *f, const struct tape *t) {
  fmpz_mpoly_q_struct *reg = ss_malloc((size_t)(t->n + 1) * sizeof *reg);
  int s = SS_OK;
  slong done = 0;
  for (; s == SS_OK && done < t->n; done++) {
    exact_init(&reg[done], f);
    s = run(t, done, reg, f);
    if (s == SS_OK && terms(f, &reg[done]) > EXACT_TERMS) s = SS_UNABLE;
  }
  *out = (struct exact_vec){f, t->n_outputs, ss_malloc((size_t)(t->n_outputs + 1) * sizeof *out->x)};
  for (slong i = 0; i < out->len; i++) {
    exact_init(&out->x[i], f);
    if (s == SS_OK) fmpz_mpoly_q_set(&out->x[i], &reg[t->outputs[i]], f->ctx);
  }
  while (done > 0) exact_clear(&reg[--done], f);
  free(reg);
  return s;
}

void exact_vec_clear(struct exact_vec *v) {
  for (slong i = 0; i < v->len; i++) exact_clear(&v->x[i], v->field);
  free(v->x);
}

/* --- Units --- */

/* A single term in generators that are inputs of the given names: the sign of its coefficient, else 0. */
static int unit_sign(const struct exact_field *f, const fmpz_mpoly_struct *p, const char *const *positive, int n) {
  if (fmpz_mpoly_length(p, f->ctx) != 1) return 0;
  int used[EXACT_GENERATORS];
  fmpz_mpoly_used_vars(used, p, f->ctx);
  for (slong i = 0; i < f->n; i++) {
    bool known = !used[i];
    for (int k = 0; !known && k < n; k++)
      known = f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, positive[k]) == 0;
    if (!known) return 0;
  }
  fmpz_t c;
  fmpz_init(c);
  fmpz_mpoly_get_term_coeff_fmpz(c, p, 0, f->ctx);
  int s = fmpz_sgn(c);
  fmpz_clear(c);
  return s;
}

int exact_ratio_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y,
                     const char *const *positive, int n_positive) {
  bool x0 = fmpz_mpoly_q_is_zero(x, f->ctx), y0 = fmpz_mpoly_q_is_zero(y, f->ctx);
  if (x0 || y0) return x0 && y0;
  fmpz_mpoly_q_struct k;
  exact_init(&k, f);
  int s = 0;
  if (divide(&k, f, x, y) == SS_OK)
    s = unit_sign(f, &k.num, positive, n_positive) * unit_sign(f, &k.den, positive, n_positive);
  exact_clear(&k, f);
  return s;
}
