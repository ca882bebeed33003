/* One pass over a tape in a field of rational functions modulo relations.  What is not rational (sines, roots) becomes a
   generator of its own, found again by its argument; the table of generators belongs to the field, so that several tapes
   share them.  A younger generator stands earlier in the ring's order, so that each relation rewrites its own square. */
#include "stickslip/exact.h"

#include <stdlib.h>
#include <string.h>

#include "stickslip/work.h"

/* What a generator stands for: an input by name, or a function of elements. */
struct generator {
  enum tape_op op;
  char *name;                /* TAPE_INPUT */
  fmpz_mpoly_q_struct *args; /* the others */
  slong n_args, k;           /* k: which root */
  bool squared;              /* its square is that polynomial */
  fmpz_mpoly_t square;
};

struct exact_field {
  struct generator gen[EXACT_GENERATORS];
  slong n, limit, largest;
  const struct exact_fact *fact;
  int n_facts;
  exact_binder bind;
  void *bind_arg;
  const fmpz_mpoly_q_struct *root, *positive, *angle;
  int n_roots, n_positive, n_angles, group;
};

static const fmpz_mpoly_ctx_struct *ring(void) {
  return num_exact_ctx();
}

/* The ring's variable of generator i. */
static slong variable(slong i) {
  return EXACT_GENERATORS - 1 - i;
}

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

void exact_field_positive(struct exact_field *f, const fmpz_mpoly_q_struct *positive, int n) {
  f->positive = positive;
  f->n_positive = n;
}

void exact_field_angles(struct exact_field *f, const fmpz_mpoly_q_struct *angle, int n, int group) {
  f->angle = angle;
  f->n_angles = n;
  f->group = group;
}

slong exact_largest(const struct exact_field *f) {
  return f->largest;
}

void exact_init(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  (void)f;
  fmpz_mpoly_q_init(x, ring());
}

void exact_clear(fmpz_mpoly_q_struct *x, const struct exact_field *f) {
  (void)f;
  fmpz_mpoly_q_clear(x, ring());
}

void exact_field_free(struct exact_field *f) {
  for (slong i = 0; i < f->n; i++) {
    free(f->gen[i].name);
    for (slong k = 0; k < f->gen[i].n_args; k++) exact_clear(&f->gen[i].args[k], f);
    free(f->gen[i].args);
    if (f->gen[i].squared) fmpz_mpoly_clear(f->gen[i].square, ring());
  }
  free(f);
}

/* --- Relations --- */

/* p with the powers of generator i above the first rewritten. */
static void rewrite_one(fmpz_mpoly_struct *p, const struct generator *g, slong var) {
  fmpz_mpoly_univar_t u;
  fmpz_mpoly_t c, power, x;
  fmpz_mpoly_univar_init(u, ring());
  fmpz_mpoly_init(c, ring());
  fmpz_mpoly_init(power, ring());
  fmpz_mpoly_init(x, ring());
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
  fmpz_mpoly_clear(x, ring());
  fmpz_mpoly_clear(power, ring());
  fmpz_mpoly_clear(c, ring());
  fmpz_mpoly_univar_clear(u, ring());
}

/* The youngest first: a square holds older generators only. */
static bool rewrite(fmpz_mpoly_struct *p, const struct exact_field *f) {
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
  bool num = rewrite(&z->num, f), den = rewrite(&z->den, f);
  if (fmpz_mpoly_is_zero(&z->den, ring())) {
    fmpz_mpoly_one(&z->den, ring());
    return SS_DOMAIN;
  }
  if (num || den) fmpz_mpoly_q_canonicalise(z, ring());
  return num_exact_terms(z) <= f->limit ? SS_OK : SS_UNABLE;
}

bool exact_is_zero(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  (void)f;
  return fmpz_mpoly_q_is_zero(x, ring());
}

/* Products are refused before they are made. */
static bool fits(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y, bool sum) {
  slong most = f->limit * f->limit / 16;
  return num_exact_work(x, y, sum) <= (most < NUM_EXACT_PRODUCT ? most : NUM_EXACT_PRODUCT);
}

static int apply(num_binary op, fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
                 const fmpz_mpoly_q_struct *y) {
  if (!fits(f, x, y, op == num_exact.add || op == num_exact.sub)) return SS_UNABLE;
  int s = op(z, x, y, 0);
  return s ? s : exact_reduce(z, f);
}

bool exact_sub(fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
               const fmpz_mpoly_q_struct *y) {
  return apply(num_exact.sub, z, f, x, y) == SS_OK;
}

bool exact_equal(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y) {
  if (fmpz_mpoly_q_equal(x, y, ring())) return true;
  fmpz_mpoly_q_struct d;
  exact_init(&d, f);
  bool same = exact_sub(&d, f, x, y) && exact_is_zero(f, &d);
  exact_clear(&d, f);
  return same;
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
static slong generator(struct exact_field *f, enum tape_op op, const char *name, const fmpz_mpoly_q_struct *args,
                       slong n, slong k) {
  slong i = 0;
  while (i < f->n && !same_generator(f, &f->gen[i], op, name, args, n, k)) i++;
  if (i == EXACT_GENERATORS) return -1;
  if (i < f->n) return i;
  struct generator *g = &f->gen[f->n++];
  *g = (struct generator){.op = op, .n_args = n, .k = k};
  if (name) g->name = strcpy(ss_malloc(strlen(name) + 1), name);
  if (n) g->args = ss_malloc((size_t)n * sizeof *g->args);
  for (slong a = 0; a < n; a++) {
    exact_init(&g->args[a], f);
    fmpz_mpoly_q_set(&g->args[a], &args[a], ring());
  }
  return i;
}

static int set_generator(fmpz_mpoly_q_struct *z, slong i) {
  if (i < 0) return SS_UNABLE;
  fmpz_mpoly_q_gen(z, variable(i), ring());
  return SS_OK;
}

int exact_symbol(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name) {
  return set_generator(z, generator(f, TAPE_INPUT, name, NULL, 0, 0));
}

static int input(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *name) {
  if (f->bind) return f->bind(z, f, name, f->bind_arg);
  for (int k = 0; k < f->n_facts; k++) {
    if (strcmp(f->fact[k].name, name) != 0) continue;
    struct exact_vec v;
    int s = exact_eval(&v, f, &f->fact[k].tape);
    if (s == SS_OK) fmpz_mpoly_q_set(z, &v.x[0], ring());
    exact_vec_clear(&v);
    return s;
  }
  return exact_symbol(z, f, name);
}

/* The sine of an argument, then the cosine, whose square is 1 - sin^2. */
static slong make_angle(struct exact_field *f, const fmpz_mpoly_q_struct *arg) {
  slong s = generator(f, TAPE_sin, NULL, arg, 1, 0), c = s < 0 ? -1 : generator(f, TAPE_cos, NULL, arg, 1, 0);
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

/* x without its sign, which is that of the leading coefficient of its numerator; whether that is negative. */
static bool take_sign(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x) {
  fmpz_t lead;
  fmpz_init(lead);
  fmpz_mpoly_get_term_coeff_fmpz(lead, &x->num, 0, ring());
  bool negative = fmpz_sgn(lead) < 0;
  if (negative)
    fmpz_mpoly_q_neg(z, x, ring());
  else
    fmpz_mpoly_q_set(z, x, ring());
  fmpz_clear(lead);
  return negative;
}

static int own_angle(fmpz_mpoly_q_struct *s, fmpz_mpoly_q_struct *c, struct exact_field *f,
                     const fmpz_mpoly_q_struct *x) {
  if (fmpz_mpoly_q_is_zero(x, ring())) {
    fmpz_mpoly_q_zero(s, ring());
    fmpz_mpoly_q_set_si(c, 1, ring());
    return SS_OK;
  }
  fmpz_mpoly_q_struct arg;
  exact_init(&arg, f);
  bool negative = take_sign(&arg, x);
  slong i = make_angle(f, &arg);
  int status = set_generator(s, i);
  if (status == SS_OK) status = set_generator(c, generator(f, TAPE_cos, NULL, &arg, 1, 0));
  if (negative) fmpz_mpoly_q_neg(s, s, ring());
  exact_clear(&arg, f);
  return status;
}

/* The pair of an angle and that of another: the pair of their sum. */
static int add_angle(fmpz_mpoly_q_struct p[2], struct exact_field *f, const fmpz_mpoly_q_struct by[2]) {
  fmpz_mpoly_q_struct t[4];
  int s = SS_OK;
  for (int i = 0; i < 4; i++) exact_init(&t[i], f);
  for (int i = 0; s == SS_OK && i < 4; i++) s = apply(num_exact.mul, &t[i], f, &p[i / 2], &by[i % 2]);
  if (s == SS_OK) s = apply(num_exact.add, &p[0], f, &t[1], &t[2]);
  if (s == SS_OK) s = apply(num_exact.sub, &p[1], f, &t[3], &t[0]);
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

/* The integer i from -MOST_ANGLES to MOST_ANGLES for which x and i a agree at the one monomial of a; false without one. */
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
  bool ok = apply(num_exact.mul, &u, f, &f->angle[a], &n) == SS_OK;
  fmpz_mpoly_q_set_si(&n, *k, ring());
  ok = ok && apply(num_exact.mul, &v, f, &f->angle[b], &n) == SS_OK;
  ok = ok && apply(num_exact.add, &u, f, &u, &v) == SS_OK && exact_equal(f, x, &u);
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

static int circular(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct s, c;
  exact_init(&s, f);
  exact_init(&c, f);
  int status = exact_sin_cos(&s, &c, f, x);
  if (status == SS_OK && op == TAPE_cot)
    status = apply(num_exact.div, z, f, &c, &s);
  else
    fmpz_mpoly_q_swap(z, op == TAPE_sin ? &s : &c, ring());
  exact_clear(&c, f);
  exact_clear(&s, f);
  return status;
}

/* The positive element of which x is the square. */
static const fmpz_mpoly_q_struct *known_square_root(const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *found = NULL;
  fmpz_mpoly_q_struct square;
  exact_init(&square, f);
  for (int i = 0; !found && i < f->n_positive; i++)
    if (apply(num_exact.mul, &square, f, &f->positive[i], &f->positive[i]) == SS_OK && exact_equal(f, x, &square))
      found = &f->positive[i];
  exact_clear(&square, f);
  return found;
}

/* sqrt(p/n) = sqrt(p n)/n for an integer n > 0. */
static int root_over_integer(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct n, product;
  exact_init(&n, f);
  exact_init(&product, f);
  fmpz_mpoly_set(&n.num, &x->den, ring());
  fmpz_mpoly_set(&product.num, &x->num, ring());
  int s = apply(num_exact.mul, &product, f, &product, &n);
  if (s == SS_OK) s = exact_sqrt(z, f, &product);
  if (s == SS_OK) s = apply(num_exact.div, z, f, z, &n);
  exact_clear(&product, f);
  exact_clear(&n, f);
  return s;
}

int exact_sqrt(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  const fmpz_mpoly_q_struct *known = known_square_root(f, x);
  if (known) {
    fmpz_mpoly_q_set(z, known, ring());
    return SS_OK;
  }
  if (fmpz_mpoly_is_fmpz(&x->den, ring()) && !fmpz_mpoly_is_one(&x->den, ring())) return root_over_integer(z, f, x);
  slong i = generator(f, TAPE_sqrt, NULL, x, 1, 0);
  if (i >= 0 && !f->gen[i].squared && fmpz_mpoly_is_one(&x->den, ring())) {
    f->gen[i].squared = true;
    fmpz_mpoly_init(f->gen[i].square, ring());
    fmpz_mpoly_set(f->gen[i].square, &x->num, ring());
  }
  return set_generator(z, i);
}

static int hypotenuse(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x,
                      const fmpz_mpoly_q_struct *y) {
  fmpz_mpoly_q_struct square;
  exact_init(&square, f);
  int s = apply(num_exact.mul, &square, f, y, y);
  if (s == SS_OK) s = apply(num_exact.mul, z, f, x, x);
  if (s == SS_OK) s = apply(num_exact.add, &square, f, &square, z);
  if (s == SS_OK) s = exact_sqrt(z, f, &square);
  exact_clear(&square, f);
  return s;
}

/* |p/q| = |p q|/q^2: the generator stands for the absolute value of a polynomial. */
static int absolute(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  if (exact_is_zero(f, x)) {
    fmpz_mpoly_q_zero(z, ring());
    return SS_OK;
  }
  fmpz_mpoly_q_struct den, arg;
  exact_init(&den, f);
  exact_init(&arg, f);
  fmpz_mpoly_set(&den.num, &x->den, ring());
  fmpz_mpoly_set(&arg.num, &x->num, ring());
  int s = apply(num_exact.mul, &arg, f, &arg, &den);
  if (s == SS_OK) s = apply(num_exact.mul, &den, f, &den, &den);
  if (s == SS_OK) take_sign(&arg, &arg);
  slong i = s == SS_OK ? generator(f, TAPE_abs, NULL, &arg, 1, 0) : -1;
  if (i >= 0 && !f->gen[i].squared) {
    f->gen[i].squared = true;
    fmpz_mpoly_init(f->gen[i].square, ring());
    fmpz_mpoly_mul(f->gen[i].square, &arg.num, &arg.num, ring());
    rewrite(f->gen[i].square, f);
  }
  if (s == SS_OK) s = set_generator(z, i);
  if (s == SS_OK) s = apply(num_exact.div, z, f, z, &den);
  exact_clear(&arg, f);
  exact_clear(&den, f);
  return s;
}

/* Can the numerator vanish on a whole domain though it is not zero here, as sqrt(4 V) - 2 sqrt(V) or |z| - z do?  Not when
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
    s = apply(num_exact.mul, &p, f, &p, &conjugate);
  }
  bool may = s != SS_OK || exact_is_zero(f, &p);
  exact_clear(&conjugate, f);
  exact_clear(&p, f);
  return may;
}

/* sin u/u, or (u - sin u)/u^3: they have values where u is zero, so that u is a divisor only if that is no whole domain. */
static int over_angle(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x) {
  if (fmpz_mpoly_q_is_zero(x, ring())) {
    fmpz_mpoly_q_set_si(z, 1, ring());
    if (op == TAPE_stumpff) fmpz_mpoly_set_si(&z->den, 6, ring());
    return SS_OK;
  }
  if (may_vanish(f, x)) return SS_UNABLE;
  fmpz_mpoly_q_struct sine;
  exact_init(&sine, f);
  int s = circular(&sine, f, TAPE_sin, x);
  if (s == SS_OK && op == TAPE_stumpff) s = apply(num_exact.sub, &sine, f, x, &sine);
  for (int i = 0; s == SS_OK && i < (op == TAPE_stumpff ? 3 : 1); i++) s = apply(num_exact.div, &sine, f, &sine, x);
  fmpz_mpoly_q_swap(z, &sine, ring());
  exact_clear(&sine, f);
  return s;
}

static int power(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, slong n) {
  enum { MAX_POWER = 16 };
  if (n < -MAX_POWER || n > MAX_POWER) return SS_UNABLE;
  fmpz_mpoly_q_struct r;
  exact_init(&r, f);
  fmpz_mpoly_q_set_si(&r, 1, ring());
  int s = SS_OK;
  for (slong i = 0; s == SS_OK && i < labs(n); i++) s = apply(n < 0 ? num_exact.div : num_exact.mul, &r, f, &r, x);
  fmpz_mpoly_q_swap(z, &r, ring());
  exact_clear(&r, f);
  return s;
}

/* --- Roots --- */

/* Is the polynomial zero at x?  false also when that grows too large. */
static bool is_root(const struct exact_field *f, const fmpz_mpoly_q_struct *c, slong n, const fmpz_mpoly_q_struct *x) {
  fmpz_mpoly_q_struct y;
  exact_init(&y, f);
  int s = SS_OK;
  for (slong i = n - 1; s == SS_OK && i >= 0; i--) {
    s = apply(num_exact.mul, &y, f, &y, x);
    if (s == SS_OK) s = apply(num_exact.add, &y, f, &y, &c[i]);
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
static int root(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct tape *t, const struct tape_instr *in,
                const fmpz_mpoly_q_struct *reg) {
  fmpz_mpoly_q_struct *c = ss_malloc((size_t)in->b * sizeof *c);
  const fmpz_mpoly_q_struct *lead = &reg[t->links[in->a + in->b - 1]];
  int s = SS_OK;
  for (slong i = 0; i < in->b; i++) exact_init(&c[i], f);
  for (slong i = 0; s == SS_OK && i < in->b; i++) s = apply(num_exact.div, &c[i], f, &reg[t->links[in->a + i]], lead);
  const fmpz_mpoly_q_struct *known = s == SS_OK ? known_root(f, c, in->b, in->k) : NULL;
  if (known)
    fmpz_mpoly_q_set(z, known, ring());
  else if (s == SS_OK)
    s = set_generator(z, generator(f, TAPE_ROOT, NULL, c, in->b, in->k));
  for (slong i = 0; i < in->b; i++) exact_clear(&c[i], f);
  free(c);
  return s;
}

/* --- The pass --- */

static int run(const struct tape *t, slong i, fmpz_mpoly_q_struct *reg, struct exact_field *f) {
  const struct tape_instr *in = &t->code[i];
  fmpz_mpoly_q_struct *z = &reg[i];
  const fmpz_mpoly_q_struct *a = in->a >= 0 ? &reg[in->a] : NULL, *b = in->b >= 0 ? &reg[in->b] : NULL;
  switch (in->op) {
  case TAPE_CONST:
    fmpz_mpoly_q_set_fmpq(z, &t->consts[in->k], ring());
    return SS_OK;
  case TAPE_INPUT:
    return input(z, f, t->inputs[in->k]);
  case TAPE_ROOT:
    return root(z, f, t, in, reg);
  case TAPE_POW:
    return power(z, f, a, in->k);
  case TAPE_ROUNDED:
    fmpz_mpoly_q_set(z, a, ring());
    return SS_OK;
  case TAPE_neg:
    return num_exact.neg(z, a, 0);
  case TAPE_sin:
  case TAPE_cos:
  case TAPE_cot:
    return circular(z, f, in->op, a);
  case TAPE_sqrt:
    return exact_sqrt(z, f, a);
  case TAPE_abs:
    return absolute(z, f, a);
  case TAPE_sinc:
  case TAPE_stumpff:
    return over_angle(z, f, in->op, a);
  case TAPE_hypot:
    return hypotenuse(z, f, a, b);
  case TAPE_add:
    return apply(num_exact.add, z, f, a, b);
  case TAPE_sub:
    return apply(num_exact.sub, z, f, a, b);
  case TAPE_mul:
    return apply(num_exact.mul, z, f, a, b);
  case TAPE_div:
    return apply(num_exact.div, z, f, a, b);
  default:
    return SS_UNABLE;
  }
}

/* The status of what an instruction reads. */
static int operands(const struct tape *t, const struct tape_instr *in, const int *status) {
  int s = SS_OK;
  if (in->op == TAPE_CONST || in->op == TAPE_INPUT) return s;
  if (in->op == TAPE_ROOT) {
    for (slong i = 0; i < in->b; i++) s |= status[t->links[in->a + i]];
    return s;
  }
  if (in->a >= 0) s |= status[in->a];
  if (in->b >= 0) s |= status[in->b];
  return s;
}

/* What the wanted outputs reach. */
static bool *reached(const struct tape *t, const bool *wanted) {
  bool *needed = ss_malloc((size_t)(t->n + 1) * sizeof *needed);
  for (slong i = 0; i < t->n; i++) needed[i] = false;
  for (slong i = 0; i < t->n_outputs; i++)
    if (!wanted || wanted[i]) needed[t->outputs[i]] = true;
  for (slong i = t->n; i-- > 0;) {
    const struct tape_instr *in = &t->code[i];
    if (!needed[i] || in->op == TAPE_CONST || in->op == TAPE_INPUT) continue;
    for (slong k = 0; in->op == TAPE_ROOT && k < in->b; k++) needed[t->links[in->a + k]] = true;
    if (in->op == TAPE_ROOT) continue;
    if (in->a >= 0) needed[in->a] = true;
    if (in->b >= 0) needed[in->b] = true;
  }
  return needed;
}

int exact_eval_each(struct exact_vec *out, int *status, struct exact_field *f, const struct tape *t,
                    const bool *wanted) {
  fmpz_mpoly_q_struct *reg = ss_malloc((size_t)(t->n + 1) * sizeof *reg);
  int *s = ss_malloc((size_t)(t->n + 1) * sizeof *s), all = SS_OK;
  bool *needed = reached(t, wanted);
  for (slong i = 0; i < t->n; i++) {
    exact_init(&reg[i], f);
    s[i] = SS_UNABLE;
    if (!needed[i]) continue;
    s[i] = operands(t, &t->code[i], s);
    if (s[i] == SS_OK) s[i] = run(t, i, reg, f);
    slong terms = num_exact_terms(&reg[i]);
    if (s[i] == SS_OK && terms > f->limit) s[i] = SS_UNABLE;
    if (terms > f->largest) f->largest = terms;
  }
  *out = (struct exact_vec){f, t->n_outputs, ss_malloc((size_t)(t->n_outputs + 1) * sizeof *out->x)};
  for (slong i = 0; i < out->len; i++) {
    exact_init(&out->x[i], f);
    status[i] = s[t->outputs[i]];
    all |= status[i];
    if (status[i] == SS_OK) fmpz_mpoly_q_set(&out->x[i], &reg[t->outputs[i]], ring());
  }
  for (slong i = 0; i < t->n; i++) exact_clear(&reg[i], f);
  free(needed);
  free(s);
  free(reg);
  return all;
}

int exact_eval(struct exact_vec *out, struct exact_field *f, const struct tape *t) {
  int *status = ss_malloc((size_t)(t->n_outputs + 1) * sizeof *status);
  int s = exact_eval_each(out, status, f, t, NULL);
  free(status);
  return s;
}

void exact_vec_clear(struct exact_vec *v) {
  for (slong i = 0; i < v->len; i++) exact_clear(&v->x[i], v->field);
  free(v->x);
}

/* --- Derivatives --- */

/* d(num/den)/dx_var = (num' den - num den')/den^2. */
static void partial(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong var) {
  fmpz_mpoly_t a, b;
  fmpz_mpoly_init(a, ring());
  fmpz_mpoly_init(b, ring());
  fmpz_mpoly_derivative(a, &x->num, var, ring());
  fmpz_mpoly_mul(a, a, &x->den, ring());
  fmpz_mpoly_derivative(b, &x->den, var, ring());
  fmpz_mpoly_mul(b, b, &x->num, ring());
  fmpz_mpoly_sub(&z->num, a, b, ring());
  fmpz_mpoly_mul(&z->den, &x->den, &x->den, ring());
  fmpz_mpoly_q_canonicalise(z, ring());
  fmpz_mpoly_clear(b, ring());
  fmpz_mpoly_clear(a, ring());
}

/* How generator i changes with the symbol: cos u u' and -sin u u'. */
static int generator_rate(fmpz_mpoly_q_struct *z, struct exact_field *f, slong i, const char *name) {
  const struct generator *g = &f->gen[i];
  fmpz_mpoly_q_zero(z, ring());
  if (g->op == TAPE_INPUT) {
    if (strcmp(g->name, name) == 0) fmpz_mpoly_q_set_si(z, 1, ring());
    return SS_OK;
  }
  int s = SS_OK;
  for (slong k = 0; s == SS_OK && k < g->n_args; k++) {
    s = exact_derivative(z, f, &g->args[k], name);
    if (s == SS_OK && !exact_is_zero(f, z) && g->op != TAPE_sin && g->op != TAPE_cos) s = SS_UNABLE;
  }
  if (s != SS_OK || exact_is_zero(f, z)) return s;
  fmpz_mpoly_q_struct sine, cosine;
  exact_init(&sine, f);
  exact_init(&cosine, f);
  s = exact_sin_cos(&sine, &cosine, f, &g->args[0]);
  if (s == SS_OK) s = apply(num_exact.mul, z, f, z, g->op == TAPE_sin ? &cosine : &sine);
  if (g->op == TAPE_cos) fmpz_mpoly_q_neg(z, z, ring());
  exact_clear(&cosine, f);
  exact_clear(&sine, f);
  return s;
}

int exact_derivative(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name) {
  fmpz_mpoly_q_struct sum, rate, slope;
  int used[EXACT_GENERATORS], s = SS_OK;
  exact_init(&sum, f);
  exact_init(&rate, f);
  exact_init(&slope, f);
  fmpz_mpoly_q_used_vars(used, x, ring());
  for (slong i = 0; s == SS_OK && i < f->n; i++) {
    if (!used[variable(i)]) continue;
    s = generator_rate(&rate, f, i, name);
    if (s != SS_OK || exact_is_zero(f, &rate)) continue;
    partial(&slope, x, variable(i));
    s = exact_reduce(&slope, f);
    if (s == SS_OK) s = apply(num_exact.mul, &slope, f, &slope, &rate);
    if (s == SS_OK) s = apply(num_exact.add, &sum, f, &sum, &slope);
  }
  fmpz_mpoly_q_swap(z, &sum, ring());
  exact_clear(&slope, f);
  exact_clear(&rate, f);
  exact_clear(&sum, f);
  return s;
}

/* --- Units --- */

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
  fmpz_t c;
  fmpz_init(c);
  fmpz_mpoly_get_term_coeff_fmpz(c, p, 0, ring());
  int s = fmpz_sgn(c);
  fmpz_clear(c);
  return s;
}

int exact_ratio_sign(struct exact_field *f, const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *y,
                     const char *const *positive, int n_positive) {
  bool x0 = exact_is_zero(f, x), y0 = exact_is_zero(f, y);
  if (x0 || y0) return x0 && y0;
  fmpz_mpoly_q_struct k;
  exact_init(&k, f);
  int s = 0;
  if (apply(num_exact.div, &k, f, x, y) == SS_OK)
    s = unit_sign(f, &k.num, positive, n_positive) * unit_sign(f, &k.den, positive, n_positive);
  exact_clear(&k, f);
  return s;
}

/* What is left of p when these factors are taken out is a constant: its sign, else 0. */
static int sign_by_factors(const fmpz_mpoly_struct *p, const fmpz_mpoly_q_struct *positive, int n) {
  fmpz_mpoly_t rest, quotient;
  fmpz_t c;
  fmpz_mpoly_init(rest, ring());
  fmpz_mpoly_init(quotient, ring());
  fmpz_init(c);
  fmpz_mpoly_set(rest, p, ring());
  for (int i = 0; i < n && !fmpz_mpoly_is_zero(rest, ring()); i++) {
    if (fmpz_mpoly_is_fmpz(&positive[i].num, ring()) || !fmpz_mpoly_is_one(&positive[i].den, ring())) continue;
    while (fmpz_mpoly_divides(quotient, rest, &positive[i].num, ring())) fmpz_mpoly_swap(rest, quotient, ring());
  }
  int sign = 0;
  if (fmpz_mpoly_is_fmpz(rest, ring())) {
    fmpz_mpoly_get_fmpz(c, rest, ring());
    sign = fmpz_sgn(c);
  }
  fmpz_clear(c);
  fmpz_mpoly_clear(quotient, ring());
  fmpz_mpoly_clear(rest, ring());
  return sign;
}

int exact_product_sign(const fmpz_mpoly_q_struct *x, const fmpz_mpoly_q_struct *positive, int n) {
  return sign_by_factors(&x->num, positive, n) * sign_by_factors(&x->den, positive, n);
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
    if (g->op == TAPE_ROOT || g->op == TAPE_abs) return false;
    if (g->op == TAPE_sqrt && (roots++ || !g->squared || fmpz_mpoly_is_square(g->square, ring()))) return false;
    if (g->op != TAPE_sin) continue;
    if (!is_monomial(&g->args[0])) return false;
    for (slong k = 0; k < i; k++)
      if (f->gen[k].op == TAPE_sin && same_monomial(&g->args[0], &f->gen[k].args[0])) return false;
  }
  return true;
}

/* --- Points --- */

void exact_print(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  char label[EXACT_GENERATORS][8];
  const char *names[EXACT_GENERATORS];
  for (slong k = 0; k < EXACT_GENERATORS; k++) {
    slong i = variable(k);
    snprintf(label[k], sizeof label[k], "g%ld", (long)i);
    names[k] = i < f->n && f->gen[i].op == TAPE_INPUT ? f->gen[i].name : label[k];
  }
  char *num = fmpz_mpoly_get_str_pretty(&x->num, names, ring());
  char *den = fmpz_mpoly_get_str_pretty(&x->den, names, ring());
  text_printf(out, strcmp(den, "1") == 0 ? "%s" : "(%s)/(%s)", num, den);
  flint_free(den);
  flint_free(num);
}

static void print_generator(struct text *out, const struct exact_field *f, slong i) {
  const struct generator *g = &f->gen[i];
  if (g->op == TAPE_INPUT) {
    text_add(out, g->name);
    return;
  }
  text_add(out, g->op == TAPE_sin    ? "sin("
                : g->op == TAPE_cos  ? "cos("
                : g->op == TAPE_sqrt ? "sqrt("
                : g->op == TAPE_abs  ? "abs("
                                     : "root(");
  for (slong k = 0; k < g->n_args; k++) {
    if (k) text_add(out, "; ");
    exact_print(out, f, &g->args[k]);
  }
  text_add(out, ")");
}

void exact_print_generators(struct text *out, const struct exact_field *f) {
  for (slong i = 0; i < f->n; i++) {
    if (i) text_add(out, ", ");
    print_generator(out, f, i);
  }
}

static void value_of(fmpq_t z, const fmpz_mpoly_struct *p, const fmpq *value) {
  slong e[EXACT_GENERATORS];
  fmpq_t term, power;
  fmpz_t c;
  fmpq_init(term);
  fmpq_init(power);
  fmpz_init(c);
  fmpq_zero(z);
  for (slong i = 0; i < fmpz_mpoly_length(p, ring()); i++) {
    fmpz_mpoly_get_term_coeff_fmpz(c, p, i, ring());
    fmpz_mpoly_get_term_exp_si(e, p, i, ring());
    fmpq_set_fmpz(term, c);
    for (slong k = 0; k < EXACT_GENERATORS; k++) {
      if (e[k] == 0) continue;
      fmpq_pow_si(power, &value[k], e[k]);
      fmpq_mul(term, term, power);
    }
    fmpq_add(z, z, term);
  }
  fmpz_clear(c);
  fmpq_clear(power);
  fmpq_clear(term);
}

static bool square_root(fmpq_t z, const fmpq_t x) {
  if (!fmpz_is_square(fmpq_numref(x)) || !fmpz_is_square(fmpq_denref(x))) return false;
  fmpz_sqrt(fmpq_numref(z), fmpq_numref(x));
  fmpz_sqrt(fmpq_denref(z), fmpq_denref(x));
  return true;
}

/* Small rationals, distinct for the generators; sines by half-angle tangents.  false when a root is irrational there. */
static bool draw_values(fmpq *value, const struct exact_field *f, ulong *state) {
  fmpq_t square;
  fmpq_init(square);
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
      value_of(square, g->square, value);
      ok = square_root(z, square);
    }
  }
  fmpq_clear(square);
  return ok;
}

static void print_witness(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
                          const fmpq *value, const fmpq_t there) {
  int used[EXACT_GENERATORS];
  fmpz_mpoly_q_used_vars(used, x, ring());
  num_print_q(out, there);
  const char *sep = " at ";
  for (slong i = 0; i < f->n; i++) {
    if (!used[variable(i)]) continue;
    text_add(out, sep);
    print_generator(out, f, i);
    text_add(out, " = ");
    num_print_q(out, &value[variable(i)]);
    sep = ", ";
  }
}

bool exact_witness(struct text *out, const struct exact_field *f, const fmpz_mpoly_q_struct *x) {
  enum { TRIALS = 2000 };
  fmpq value[EXACT_GENERATORS];
  fmpq_t num, den;
  fmpq_init(num);
  fmpq_init(den);
  for (slong i = 0; i < EXACT_GENERATORS; i++) fmpq_init(&value[i]);
  ulong state = 1;
  bool found = false;
  for (int k = 0; !found && k < TRIALS; k++) {
    if (!draw_values(value, f, &state)) continue;
    value_of(num, &x->num, value);
    value_of(den, &x->den, value);
    found = !fmpq_is_zero(num) && !fmpq_is_zero(den);
  }
  if (found) fmpq_div(num, num, den);
  if (found) print_witness(out, f, x, value, num);
  for (slong i = 0; i < EXACT_GENERATORS; i++) fmpq_clear(&value[i]);
  fmpq_clear(den);
  fmpq_clear(num);
  return found;
}

/* q g - p divides the numerator. */
bool exact_vanishes_at(const struct exact_field *f, const fmpz_mpoly_q_struct *x, const char *name,
                       const fmpq_t value) {
  slong i = 0;
  while (i < f->n && !(f->gen[i].op == TAPE_INPUT && strcmp(f->gen[i].name, name) == 0)) i++;
  if (i == f->n) return exact_is_zero(f, x);
  fmpz_mpoly_t factor, q;
  fmpz_mpoly_init(factor, ring());
  fmpz_mpoly_init(q, ring());
  fmpz_mpoly_gen(factor, variable(i), ring());
  fmpz_mpoly_scalar_mul_fmpz(factor, factor, fmpq_denref(value), ring());
  fmpz_mpoly_sub_fmpz(factor, factor, fmpq_numref(value), ring());
  bool divides = fmpz_mpoly_divides(q, &x->num, factor, ring()) != 0;
  fmpz_mpoly_clear(q, ring());
  fmpz_mpoly_clear(factor, ring());
  return divides;
}
