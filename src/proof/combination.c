/* Positive combinations as proofs, see combination.h. */
#include "combination.h"

#include <flint/fmpq_mpoly.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A rational function num/den. */
struct fraction {
  fmpq_mpoly_t num, den;
};

enum { MAX_NAMES = 64, MAX_FACTS = 48, N_PROBES = 2 };

/* Something known to be positive, or to be zero. */
struct fact {
  struct fraction f;
  const char *text;
  double probe[N_PROBES];
};

struct proof {
  fmpq_mpoly_ctx_t ctx;
  const char *name[MAX_NAMES]; /* of the variables */
  slong n_names;
  struct fact positive[MAX_FACTS], zero[MAX_FACTS], goal[MAX_FACTS], factor[MAX_FACTS];
  int n_positive, n_zero, n_goals, n_factors;
};

/* --- Rational functions --- */

static void fraction_init(struct fraction *f, const struct proof *p) {
  fmpq_mpoly_init(f->num, p->ctx);
  fmpq_mpoly_init(f->den, p->ctx);
  fmpq_mpoly_one(f->den, p->ctx);
}

static void fraction_clear(struct fraction *f, const struct proof *p) {
  fmpq_mpoly_clear(f->num, p->ctx);
  fmpq_mpoly_clear(f->den, p->ctx);
}

static void fraction_set(struct fraction *z, const struct fraction *x, const struct proof *p) {
  fmpq_mpoly_set(z->num, x->num, p->ctx);
  fmpq_mpoly_set(z->den, x->den, p->ctx);
}

static void fraction_mul(struct fraction *z, const struct fraction *x, const struct fraction *y,
                         const struct proof *p) {
  fmpq_mpoly_mul(z->num, x->num, y->num, p->ctx);
  fmpq_mpoly_mul(z->den, x->den, y->den, p->ctx);
}

/* z = x + sign y */
static void fraction_add(struct fraction *z, const struct fraction *x, const struct fraction *y, int sign,
                         const struct proof *p) {
  fmpq_mpoly_t a, b;
  fmpq_mpoly_init(a, p->ctx);
  fmpq_mpoly_init(b, p->ctx);
  fmpq_mpoly_mul(a, x->num, y->den, p->ctx);
  fmpq_mpoly_mul(b, y->num, x->den, p->ctx);
  fmpq_mpoly_mul(z->den, x->den, y->den, p->ctx);
  if (sign > 0)
    fmpq_mpoly_add(z->num, a, b, p->ctx);
  else
    fmpq_mpoly_sub(z->num, a, b, p->ctx);
  fmpq_mpoly_clear(b, p->ctx);
  fmpq_mpoly_clear(a, p->ctx);
}

/* x at var = by; false when x is not of degree at most 1 in it. */
static bool polynomial_at(fmpq_mpoly_t z, const fmpq_mpoly_t x, slong var, const struct fraction *by,
                          const struct proof *p) {
  if (fmpq_mpoly_degree_si(x, var, p->ctx) > 1) return false;
  fmpq_mpoly_t slope;
  fmpq_t zero;
  fmpq_init(zero);
  fmpq_mpoly_init(slope, p->ctx);
  fmpq_mpoly_derivative(slope, x, var, p->ctx);
  fmpq_mpoly_evaluate_one_fmpq(z, x, var, zero, p->ctx);
  fmpq_mpoly_mul(z, z, by->den, p->ctx);
  fmpq_mpoly_mul(slope, slope, by->num, p->ctx);
  fmpq_mpoly_add(z, z, slope, p->ctx);
  fmpq_mpoly_clear(slope, p->ctx);
  fmpq_clear(zero);
  return true;
}

static bool substitute(struct fraction *f, slong var, const struct fraction *by, const struct proof *p) {
  struct fraction z;
  fraction_init(&z, p);
  bool ok = polynomial_at(z.num, f->num, var, by, p) && polynomial_at(z.den, f->den, var, by, p) &&
            !fmpq_mpoly_is_zero(z.den, p->ctx);
  if (ok) fraction_set(f, &z, p);
  fraction_clear(&z, p);
  return ok;
}

/* --- From tapes --- */

static slong variable(struct proof *p, const char *name) {
  for (slong i = 0; i < p->n_names; i++)
    if (strcmp(p->name[i], name) == 0) return i;
  if (p->n_names == MAX_NAMES) return -1;
  p->name[p->n_names] = name;
  return p->n_names++;
}

static bool names_of(struct proof *p, const struct tape *t) {
  for (slong i = 0; i < t->n_inputs; i++)
    if (variable(p, t->inputs[i]) < 0) return false;
  return true;
}

/* One instruction; false for what is not a rational function. */
static bool step(struct fraction *v, slong i, const struct tape *t, struct proof *p) {
  const struct tape_instr *in = &t->code[i];
  struct fraction *z = &v[i], inverse;
  bool ok = true;
  fraction_init(&inverse, p);
  switch (in->op) {
  case TAPE_CONST:
    fmpq_mpoly_set_fmpq(z->num, &t->consts[in->k], p->ctx);
    break;
  case TAPE_INPUT:
    fmpq_mpoly_gen(z->num, variable(p, t->inputs[in->k]), p->ctx);
    break;
  case TAPE_neg:
    fraction_set(z, &v[in->a], p);
    fmpq_mpoly_neg(z->num, z->num, p->ctx);
    break;
  case TAPE_add:
  case TAPE_sub:
    fraction_add(z, &v[in->a], &v[in->b], in->op == TAPE_add ? 1 : -1, p);
    break;
  case TAPE_mul:
    fraction_mul(z, &v[in->a], &v[in->b], p);
    break;
  case TAPE_div:
    ok = !fmpq_mpoly_is_zero(v[in->b].num, p->ctx);
    fmpq_mpoly_set(inverse.num, v[in->b].den, p->ctx);
    fmpq_mpoly_set(inverse.den, v[in->b].num, p->ctx);
    if (ok) fraction_mul(z, &v[in->a], &inverse, p);
    break;
  default:
    ok = false;
  }
  fraction_clear(&inverse, p);
  return ok;
}

/* The outputs of a tape as facts of a list. */
static bool facts_of(struct fact *list, int *n, const struct tape *t, const char *const *text, struct proof *p) {
  struct fraction *v = ss_malloc((size_t)t->n * sizeof *v);
  bool ok = *n + (int)t->n_outputs <= MAX_FACTS;
  for (slong i = 0; i < t->n; i++) fraction_init(&v[i], p);
  for (slong i = 0; ok && i < t->n; i++) ok = step(v, i, t, p);
  for (slong i = 0; ok && i < t->n_outputs; i++) {
    struct fact *f = &list[(*n)++];
    fraction_init(&f->f, p);
    fraction_set(&f->f, &v[t->outputs[i]], p);
    f->text = text[i];
  }
  for (slong i = 0; i < t->n; i++) fraction_clear(&v[i], p);
  free(v);
  return ok;
}

/* --- Expressions written here --- */

static bool expressions_tape(struct tape *t, struct elaboration *el, const char *const *text, int n,
                             const char *section, struct diag *d) {
  const struct expr *e[8];
  struct arena a;
  arena_init(&a);
  bool ok = true;
  for (int i = 0; ok && i < n; i++) {
    struct source src;
    struct matrix m;
    source_from_string(&src, text[i], text[i]);
    const struct expr *tree = expr_parse(&a, &src, (struct span){0, src.len}, d);
    ok = tree && elaborate(&m, el, tree, &src, section, d) && m.rows * m.cols == 1;
    if (ok) e[i] = m.e[0];
    source_clear(&src);
  }
  ok = ok && elaboration_tape(t, el, e, n, d);
  arena_clear(&a);
  return ok;
}

/* --- Eliminating by equations --- */

static bool is_parameter(const char *name) {
  return strcmp(name, "chi") == 0 || strcmp(name, "eta") == 0 || strcmp(name, "V") == 0;
}

/* Divides x by a factor as often as it goes. */
static void divide_out(fmpq_mpoly_t x, const fmpq_mpoly_t factor, const struct proof *p) {
  fmpq_mpoly_t q;
  fmpq_mpoly_init(q, p->ctx);
  while (!fmpq_mpoly_is_fmpq(x, p->ctx) && fmpq_mpoly_divides(q, x, factor, p->ctx)) fmpq_mpoly_swap(x, q, p->ctx);
  fmpq_mpoly_clear(q, p->ctx);
}

/* Never zero on the domain: a constant times powers of chi, 1 - chi, eta and V. */
static bool never_zero(const fmpq_mpoly_t x, const struct proof *p) {
  fmpq_mpoly_t rest, factor;
  if (fmpq_mpoly_is_zero(x, p->ctx)) return false;
  fmpq_mpoly_init(rest, p->ctx);
  fmpq_mpoly_init(factor, p->ctx);
  fmpq_mpoly_set(rest, x, p->ctx);
  for (slong i = 0; i < p->n_names; i++) {
    if (!is_parameter(p->name[i])) continue;
    fmpq_mpoly_gen(factor, i, p->ctx);
    divide_out(rest, factor, p);
    fmpq_mpoly_sub_si(factor, factor, 1, p->ctx);
    if (strcmp(p->name[i], "chi") == 0) divide_out(rest, factor, p);
  }
  bool yes = fmpq_mpoly_is_fmpq(rest, p->ctx);
  fmpq_mpoly_clear(factor, p->ctx);
  fmpq_mpoly_clear(rest, p->ctx);
  return yes;
}

static bool substitute_all(struct proof *p, int next, slong var, const struct fraction *by) {
  bool ok = true;
  for (int i = next; ok && i < p->n_zero; i++) ok = substitute(&p->zero[i].f, var, by, p);
  for (int i = 0; ok && i < p->n_positive; i++) ok = substitute(&p->positive[i].f, var, by, p);
  for (int i = 0; ok && i < p->n_goals; i++) ok = substitute(&p->goal[i].f, var, by, p);
  return ok;
}

/* Solves equation i for some variable, those of the motion first, and puts it in everywhere else. */
static bool eliminate(struct proof *p, int i) {
  const struct fraction *e = &p->zero[i].f;
  struct fraction by;
  fmpq_t zero;
  fmpq_init(zero);
  fraction_init(&by, p);
  bool done = fmpq_mpoly_is_zero(e->num, p->ctx), ok = done;
  for (int motion = 1; !done && motion >= 0; motion--)
    for (slong v = 0; !done && v < p->n_names; v++) {
      if (is_parameter(p->name[v]) || (strchr(p->name[v], '(') != NULL) != motion) continue;
      if (fmpq_mpoly_degree_si(e->num, v, p->ctx) != 1) continue;
      fmpq_mpoly_derivative(by.den, e->num, v, p->ctx);
      if (!never_zero(by.den, p)) continue;
      fmpq_mpoly_evaluate_one_fmpq(by.num, e->num, v, zero, p->ctx);
      fmpq_mpoly_neg(by.num, by.num, p->ctx);
      done = true;
      ok = substitute_all(p, i + 1, v, &by);
    }
  fraction_clear(&by, p);
  fmpq_clear(zero);
  return ok || !done; /* an equation that cannot be solved is not used */
}

/* --- The combination --- */

static const char *const factor_text[] = {"1", "2", "1/2", "chi", "1 - chi", "V*(1 - chi)", "2*chi", "1/chi"};
enum { N_FACTORS = sizeof factor_text / sizeof *factor_text };

/* A fact times a factor. */
struct term {
  int fact, factor;
  double probe[N_PROBES];
};

static double probe_of(const fmpq_mpoly_t x, int k, const struct proof *p) {
  static const slong prime[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  fmpq *at[MAX_NAMES];
  fmpq value[MAX_NAMES];
  fmpq_t r;
  fmpq_init(r);
  for (slong i = 0; i < p->n_names; i++) {
    fmpq_init(&value[i]);
    fmpq_set_si(&value[i], prime[i % 16] + 3 * i + 1, (ulong)(prime[(i + 5 + k) % 16] + 2 * i));
    at[i] = &value[i];
  }
  fmpq_mpoly_evaluate_all_fmpq(r, x, at, p->ctx);
  double d = fmpq_get_d(r);
  for (slong i = 0; i < p->n_names; i++) fmpq_clear(&value[i]);
  fmpq_clear(r);
  return d;
}

static void probe(struct fact *f, const struct proof *p) {
  for (int k = 0; k < N_PROBES; k++) f->probe[k] = probe_of(f->f.num, k, p) / probe_of(f->f.den, k, p);
}

/* goal - sum of terms is identically zero. */
static bool exactly(const struct fact *goal, const struct term *const t[], int n, const struct proof *p) {
  struct fraction rest, one;
  fraction_init(&rest, p);
  fraction_init(&one, p);
  fraction_set(&rest, &goal->f, p);
  for (int i = 0; i < n; i++) {
    fraction_mul(&one, &p->positive[t[i]->fact].f, &p->factor[t[i]->factor].f, p);
    struct fraction sum;
    fraction_init(&sum, p);
    fraction_add(&sum, &rest, &one, -1, p);
    fraction_set(&rest, &sum, p);
    fraction_clear(&sum, p);
  }
  bool yes = fmpq_mpoly_is_zero(rest.num, p->ctx);
  fraction_clear(&one, p);
  fraction_clear(&rest, p);
  return yes;
}

static bool near(const struct fact *goal, const struct term *const t[], int n) {
  for (int k = 0; k < N_PROBES; k++) {
    double rest = goal->probe[k], size = fabs(rest);
    for (int i = 0; i < n; i++) {
      rest -= t[i]->probe[k];
      size += fabs(t[i]->probe[k]);
    }
    if (!(fabs(rest) <= 1e-9 * size)) return false;
  }
  return true;
}

static void describe(struct text *out, const struct fact *goal, const struct term *const t[], int n,
                     const struct proof *p) {
  text_printf(out, "%s%s: its margin is", out->len ? ". " : "", goal->text);
  for (int i = 0; i < n; i++)
    text_printf(out, "%s (%s) * margin of [%s]", i ? " +" : "", factor_text[t[i]->factor],
                p->positive[t[i]->fact].text);
}

/* One to three terms that add up to the goal. */
static bool combine(struct text *out, const struct fact *goal, struct proof *p) {
  enum { MAX_TERMS = MAX_FACTS * N_FACTORS };
  struct term *t = ss_malloc(MAX_TERMS * sizeof *t);
  int n = 0;
  for (int i = 0; i < p->n_positive; i++)
    for (int m = 0; m < N_FACTORS; m++) {
      t[n] = (struct term){i, m, {0}};
      for (int k = 0; k < N_PROBES; k++) t[n].probe[k] = p->positive[i].probe[k] * p->factor[m].probe[k];
      n++;
    }
  bool found = false;
  for (int a = 0; !found && a < n; a++) {
    const struct term *pick[3] = {&t[a], NULL, NULL};
    found = near(goal, pick, 1) && exactly(goal, pick, 1, p);
    if (found) describe(out, goal, pick, 1, p);
  }
  for (int a = 0; !found && a < n; a++)
    for (int b = a + 1; !found && b < n; b++) {
      const struct term *pick[3] = {&t[a], &t[b], NULL};
      found = near(goal, pick, 2) && exactly(goal, pick, 2, p);
      if (found) describe(out, goal, pick, 2, p);
    }
  for (int a = 0; !found && a < n; a++)
    for (int b = a + 1; !found && b < n; b++)
      for (int c = b + 1; !found && c < n; c++) {
        const struct term *pick[3] = {&t[a], &t[b], &t[c]};
        found = near(goal, pick, 3) && exactly(goal, pick, 3, p);
        if (found) describe(out, goal, pick, 3, p);
      }
  free(t);
  return found;
}

/* --- The proof --- */

enum { N_SIGNS = 6, N_DOMAIN = 8 }; /* the last two: sliding friction */
static const char *const domain[N_DOMAIN] = {"chi", "1 - chi", "eta", "V", "e_1", "e_2", "u_s1", "u_s2"};
static const char *const domain_text[N_DOMAIN] = {"chi > 0", "chi < 1", "eta > 0",  "V > 0",
                                                  "e_1 > 0", "e_2 > 0", "u_s1 > 0", "u_s2 > 0"};
static const char *const friction[] = {"u_r1 - u_s1 - e_1", "u_r2 - u_s2 - e_2"};
static const char *const friction_text[] = {"(7)", "(5)"};
static const char *const switching[N_PHASES + 1] = {"0", "t_a", "t_a + t_b", "t_a + t_b + t_c",
                                                    "t_a + t_b + t_c + t_d"};

/* The tapes that do not come from conditions. */
struct extra {
  struct elaboration el;
  struct tape domain, friction, factors, clock, increase;
  const char *increase_text[3], *clock_text[2];
  int phase;   /* of the conclusion's time t; -1 when nothing moves there, N_PHASES when several do */
  int premise; /* of the premises' time t where the conclusion has none: any moment of that phase, its ends too */
  bool monotone;
};

static void take_phase(int *phase, int ph) {
  *phase = *phase < 0 || *phase == ph ? ph : N_PHASES;
}

/* h'(t), h(t) - h(start), h(end) - h(t). */
static bool monotone_tape(struct extra *x, struct judge *j, const struct claim *c) {
  const char *which = claim_get(c, "increasing"), *section = claim_get(c, "section");
  if (!which) return true;
  char name[32], phase[16];
  int ph = 0;
  if (sscanf(which, "%31s %15s", name, phase) != 2) return claim_error(j, c, "increasing", "reads NAME PHASE");
  while (ph < N_PHASES && strcmp(phase_name[ph], phase) != 0) ph++;
  if (ph == N_PHASES) return claim_error(j, c, "increasing", "no such phase");
  take_phase(&x->phase, ph);
  x->monotone = true;
  x->increase_text[0] = result_str(j->out, "%s'(t)", name);
  x->increase_text[1] = result_str(j->out, "%s(t) - %s(%s)", name, name, switching[ph]);
  x->increase_text[2] = result_str(j->out, "%s(%s) - %s(t)", name, switching[ph + 1], name);
  return expressions_tape(&x->increase, &x->el, x->increase_text, 3, section ? section : "", j->d);
}

/* Where the time t lies. */
static bool clock_tape(struct extra *x, struct judge *j) {
  if (x->phase < 0 || x->phase == N_PHASES) return true;
  x->clock_text[0] = result_str(j->out, "t - (%s)", switching[x->phase]);
  x->clock_text[1] = result_str(j->out, "%s - t", switching[x->phase + 1]);
  return expressions_tape(&x->clock, &x->el, x->clock_text, 2, "", j->d);
}

/* Whether a condition speaks of the time t of the proof, or of no time t. */
static bool usable(const struct condition *c, const struct extra *x) {
  return !c->moving || (int)c->phase == (x->phase < 0 ? x->premise : x->phase);
}

static bool name_all(struct proof *p, const struct extra *x, const struct conditions *premises,
                     const struct conditions *conclusion) {
  bool ok = names_of(p, &x->domain) && names_of(p, &x->friction) && names_of(p, &x->factors) &&
            names_of(p, &x->clock) && names_of(p, &x->increase);
  for (int i = 0; ok && i < premises->n; i++) ok = names_of(p, &premises->at[i].s.tape);
  for (int i = 0; ok && i < conclusion->n; i++) ok = names_of(p, &conclusion->at[i].s.tape);
  return ok;
}

static bool collect(struct proof *p, const struct extra *x, const struct conditions *premises,
                    const struct conditions *conclusion) {
  bool ok = facts_of(p->positive, &p->n_positive, &x->domain, domain_text, p) &&
            facts_of(p->positive, &p->n_positive, &x->clock, x->clock_text, p) &&
            facts_of(p->zero, &p->n_zero, &x->friction, friction_text, p) &&
            facts_of(p->factor, &p->n_factors, &x->factors, factor_text, p) &&
            facts_of(p->goal, &p->n_goals, &x->increase, x->increase_text, p);
  for (int i = 0; ok && i < premises->n; i++) {
    const struct condition *c = &premises->at[i];
    if (!usable(c, x)) continue;
    ok = c->equality ? facts_of(p->zero, &p->n_zero, &c->s.tape, &c->text, p)
                     : facts_of(p->positive, &p->n_positive, &c->s.tape, &c->text, p);
  }
  for (int i = 0; ok && i < conclusion->n; i++)
    ok = facts_of(p->goal, &p->n_goals, &conclusion->at[i].s.tape, &conclusion->at[i].text, p);
  return ok;
}

/* The mean value theorem: the rate first, then two more positive facts. */
static bool use_monotone(struct text *out, struct proof *p) {
  if (!combine(out, &p->goal[0], p) || p->n_positive + 2 > MAX_FACTS) return false;
  for (int k = 1; k <= 2; k++) {
    struct fact *f = &p->positive[p->n_positive++];
    fraction_init(&f->f, p);
    fraction_set(&f->f, &p->goal[k].f, p);
    f->text = p->goal[k].text;
    probe(f, p);
  }
  return true;
}

static bool prove(struct text *out, struct proof *p, bool monotone) {
  bool ok = true;
  for (int i = 0; ok && i < p->n_zero; i++) ok = eliminate(p, i);
  for (int i = 0; i < p->n_positive; i++) probe(&p->positive[i], p);
  for (int i = 0; i < p->n_goals; i++) probe(&p->goal[i], p);
  for (int i = 0; i < p->n_factors; i++) probe(&p->factor[i], p);
  if (monotone) ok = ok && use_monotone(out, p);
  for (int i = monotone ? 3 : 0; ok && i < p->n_goals; i++) ok = combine(out, &p->goal[i], p);
  return ok;
}

static void proof_clear(struct proof *p) {
  for (int i = 0; i < p->n_positive; i++) fraction_clear(&p->positive[i].f, p);
  for (int i = 0; i < p->n_zero; i++) fraction_clear(&p->zero[i].f, p);
  for (int i = 0; i < p->n_goals; i++) fraction_clear(&p->goal[i].f, p);
  for (int i = 0; i < p->n_factors; i++) fraction_clear(&p->factor[i].f, p);
  fmpq_mpoly_ctx_clear(p->ctx);
}

bool certificate_find(struct text *out, struct judge *j, const struct claim *c, const struct conditions *premises,
                      const struct conditions *conclusion, bool sliding_friction, struct view view) {
  struct extra x = {.phase = -1, .premise = -1};
  bool inequalities = true;
  for (int i = 0; i < conclusion->n; i++) {
    inequalities = inequalities && !conclusion->at[i].equality;
    if (conclusion->at[i].moving) take_phase(&x.phase, (int)conclusion->at[i].phase);
  }
  for (int i = 0; i < premises->n; i++)
    if (premises->at[i].moving) take_phase(&x.premise, (int)premises->at[i].phase);
  elaboration_init(&x.el, view, NULL, 0);
  bool ok = expressions_tape(&x.domain, &x.el, domain, sliding_friction ? N_DOMAIN : N_SIGNS, "", j->d) &&
            expressions_tape(&x.friction, &x.el, friction, 2, "", j->d) &&
            expressions_tape(&x.factors, &x.el, factor_text, N_FACTORS, "", j->d) && monotone_tape(&x, j, c) &&
            clock_tape(&x, j);
  if (ok && inequalities && x.phase < N_PHASES) {
    struct proof *p = ss_malloc(sizeof *p);
    *p = (struct proof){.n_names = 0};
    ok = name_all(p, &x, premises, conclusion);
    fmpq_mpoly_ctx_init(p->ctx, p->n_names, ORD_LEX);
    ok = ok && collect(p, &x, premises, conclusion) && prove(out, p, x.monotone);
    proof_clear(p);
    free(p);
  } else {
    ok = false;
  }
  tape_clear(&x.domain);
  tape_clear(&x.friction);
  tape_clear(&x.factors);
  tape_clear(&x.clock);
  tape_clear(&x.increase);
  elaboration_clear(&x.el);
  return ok;
}
