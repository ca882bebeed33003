/* Positive combinations as proofs, see combination.h. */
#include "combination.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/calc.h"
#include "num/num_exact.h"
#include "record/result.h"
#include "tape/exact.h"

enum { MAX_NAMES = NUM_EXACT_GENERATORS, MAX_FACTS = 48, N_PROBES = 2 };

/* Something known to be positive, or to be zero. */
struct fact {
  element *x;
  const char *text;
  double probe[N_PROBES];
};

struct proof {
  struct calc c;               /* of the facts' elements */
  const char *name[MAX_NAMES]; /* of the generators */
  slong n_names;
  struct fact positive[MAX_FACTS], zero[MAX_FACTS], goal[MAX_FACTS], factor[MAX_FACTS];
  int n_positive, n_zero, n_goals, n_factors;
  struct text *script; /* or NULL */
};

/* --- Facts --- */

static void add_fact(struct fact *list, int *n, struct calc *c, const element *x, const char *text) {
  struct fact *f = &list[(*n)++];
  *f = (struct fact){.x = calc_new(c), .text = text};
  num_exact.set(f->x, x);
}

static slong generator(struct proof *p, const char *name) {
  for (slong i = 0; i < p->n_names; i++)
    if (strcmp(p->name[i], name) == 0) return i;
  if (p->n_names == MAX_NAMES) return -1;
  p->name[p->n_names] = name;
  return p->n_names++;
}

static bool names_of(struct proof *p, const struct tape *t) {
  for (slong i = 0; i < t->n_inputs; i++)
    if (generator(p, t->inputs[i]) < 0) return false;
  return true;
}

/* The outputs of a tape as facts of a list; false where one is no rational function, or divides by zero. */
static bool facts_of(struct fact *list, int *n, const struct tape *t, const char *const *text, struct proof *p) {
  if (*n + (int)t->n_outputs > MAX_FACTS) return false;
  OWNED(calc) c = calc_begin(num_ctx_exact());
  struct num_vec in = calc_vec(&c, t->n_inputs), out = calc_vec(&c, t->n_outputs);
  for (slong i = 0; i < t->n_inputs; i++)
    fmpz_mpoly_q_gen(num_vec_at(&in, i), generator(p, t->inputs[i]), num_exact_ctx());
  bool ok = tape_eval(&out, NULL, t, &in) == SS_OK;
  for (slong i = 0; ok && i < t->n_outputs; i++) add_fact(list, n, &p->c, num_vec_at(&out, i), text[i]);
  return ok;
}

/* --- Expressions written here --- */

static bool expressions_tape(struct tape *t, struct elaboration *el, const char *const *text, int n,
                             const char *section, struct diag *d) {
  const struct expr *e[8];
  bool ok = true;
  for (int i = 0; ok && i < n; i++) {
    struct matrix m;
    ok = elaborate_text(&m, el, text[i], text[i], section, d) && m.rows * m.cols == 1;
    if (ok) e[i] = m.e[0];
  }
  return ok && elaboration_tape(t, el, e, n, d);
}

/* --- As lines of a receipt --- */

/* As SymPy reads it: x["z_1(t)"]**2/2. */
static void add_polynomial(struct proof *p, const fmpz_mpoly_struct *of) {
  char label[MAX_NAMES][80];
  const char *names[MAX_NAMES];
  for (slong i = 0; i < MAX_NAMES; i++) {
    snprintf(label[i], sizeof label[i], "x[\"%s\"]", i < p->n_names ? p->name[i] : "");
    names[i] = label[i];
  }
  char *printed = fmpz_mpoly_get_str_pretty(of, names, num_exact_ctx());
  text_add_char(p->script, '(');
  for (const char *c = printed; *c; c++)
    if (*c == '^')
      text_add(p->script, "**");
    else
      text_add_char(p->script, *c);
  text_add_char(p->script, ')');
  flint_free(printed);
}

static void add_element(struct proof *p, const element *x) {
  add_polynomial(p, &x->num);
  if (fmpz_mpoly_is_one(&x->den, num_exact_ctx())) return;
  text_add_char(p->script, '/');
  add_polynomial(p, &x->den);
}

static void add_facts(struct proof *p, const char *name, const struct fact *list, int n) {
  text_printf(p->script, "    %s=[\n", name);
  for (int i = 0; i < n; i++) {
    text_printf(p->script, "        (\"%s\", ", list[i].text);
    add_element(p, list[i].x);
    text_add(p->script, "),\n");
  }
  text_add(p->script, "    ],\n");
}

/* --- Eliminating by equations --- */

enum { N_SURE = 4 };

/* chi, 1 - chi, eta and V, which are the first facts; borrowed. */
static void take_sure(element sure[N_SURE], const struct proof *p) {
  for (int i = 0; i < N_SURE; i++) sure[i] = *p->positive[i].x;
}

/* Never zero on the domain: a constant times powers of these. */
static bool never_zero(const element *x, const struct proof *p) {
  element sure[N_SURE];
  take_sure(sure, p);
  return exact_product_sign(x, sure, N_SURE) != 0;
}

static val without_sure(element *z, const element *x, const struct proof *p) {
  element sure[N_SURE];
  take_sure(sure, p);
  exact_without_factors(z, x, sure, N_SURE);
  return z;
}

static val of_polynomial(struct calc *c, const fmpz_mpoly_struct *p) {
  element *z = calc_new(c);
  fmpz_mpoly_set(&z->num, p, num_exact_ctx());
  fmpz_mpoly_one(&z->den, num_exact_ctx());
  return z;
}

/* A polynomial of degree at most 1 in a generator g, as start + slope g; false for another. */
static bool split_line(val *start, val *slope, struct calc *c, const fmpz_mpoly_struct *p, slong g) {
  if (fmpz_mpoly_degree_si(p, g, num_exact_ctx()) > 1) return false;
  NUMBERS(polynomial, part);
  NUMBERS(fmpz, zero);
  fmpz_mpoly_derivative(part, p, g, num_exact_ctx());
  *slope = of_polynomial(c, part);
  fmpz_mpoly_evaluate_one_fmpz(part, p, g, zero, num_exact_ctx());
  *start = of_polynomial(c, part);
  return true;
}

/* x with the generator g replaced; false when x is not of degree at most 1 in it above and below. */
static bool substitute(element *x, slong g, const element *by) {
  val start, slope;
  OWNED(calc) c = calc_begin(num_ctx_exact());
  bool ok = split_line(&start, &slope, &c, &x->num, g);
  if (ok) {
    val above = calc_add(&c, start, calc_mul(&c, slope, by));
    ok = split_line(&start, &slope, &c, &x->den, g);
    if (ok) num_exact.set(x, calc_div(&c, above, calc_add(&c, start, calc_mul(&c, slope, by))));
  }
  return ok && c.status == SS_OK;
}

static bool substitute_all(struct proof *p, int next, slong g, const element *by) {
  bool ok = true;
  for (int i = next; ok && i < p->n_zero; i++) ok = substitute(p->zero[i].x, g, by);
  for (int i = 0; ok && i < p->n_positive; i++) ok = substitute(p->positive[i].x, g, by);
  for (int i = 0; ok && i < p->n_goals; i++) ok = substitute(p->goal[i].x, g, by);
  return ok;
}

/* Solves equation i for some generator, those of the motion first, and puts it in everywhere else. */
static bool eliminate(struct proof *p, int i) {
  const element *e = p->zero[i].x;
  val start, slope;
  OWNED(calc) c = calc_begin(num_ctx_exact());
  bool done = fmpz_mpoly_q_is_zero(e, num_exact_ctx()), ok = done;
  for (int motion = 1; !done && motion >= 0; motion--)
    for (slong g = 0; !done && g < p->n_names; g++) {
      bool parameter = word_find(p->name[g], name_param, P_V + 1) <= P_V;
      if (parameter || (strchr(p->name[g], '(') != NULL) != motion) continue;
      if (fmpz_mpoly_degree_si(&e->num, g, num_exact_ctx()) != 1) continue;
      split_line(&start, &slope, &c, &e->num, g);
      if (!never_zero(slope, p)) continue;
      done = true;
      if (p->script) text_printf(p->script, "\n        (%d, \"%s\"),", i, p->name[g]);
      ok = substitute_all(p, i + 1, g, calc_neg(&c, calc_div(&c, start, slope))) && c.status == SS_OK;
    }
  return ok || !done; /* an equation that cannot be solved is not used */
}

/* --- The combination --- */

static const char *const factor_text[] = {"1", "2", "1/2", "chi", "(1 - chi)", "V*(1 - chi)", "2*chi", "1/chi"};
enum { N_FACTORS = sizeof factor_text / sizeof *factor_text };

/* A fact times a factor, which may be scaled by what is positive. */
struct term {
  int fact, factor;
  const struct fact *scale; /* or NULL */
  double probe[N_PROBES];
};

static void probe(struct fact *f) {
  static const slong prime[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  FMPQ_VECTOR(value, MAX_NAMES);
  NUMBERS(fmpq, x);
  for (int k = 0; k < N_PROBES; k++) {
    for (slong i = 0; i < MAX_NAMES; i++)
      fmpq_set_si(&value[i], prime[i % 16] + 3 * i + 1, (ulong)(prime[(i + 5 + k) % 16] + 2 * i));
    f->probe[k] = num_exact_at(x, f->x, value) == SS_OK ? fmpq_get_d(x) : NAN;
  }
}

static void probe_all(struct fact *list, int n) {
  for (int i = 0; i < n; i++) probe(&list[i]);
}

static val factor_of(struct calc *c, const struct term *t, const struct proof *p) {
  val factor = p->factor[t->factor].x;
  return t->scale ? calc_mul(c, t->scale->x, factor) : factor;
}

/* goal - sum of terms is identically zero. */
static bool exactly(const struct fact *goal, const struct term *const t[], int n, const struct proof *p) {
  OWNED(calc) c = calc_begin(num_ctx_exact());
  val rest = goal->x;
  for (int i = 0; i < n; i++)
    rest = calc_sub(&c, rest, calc_mul(&c, p->positive[t[i]->fact].x, factor_of(&c, t[i], p)));
  return c.status == SS_OK && fmpz_mpoly_q_is_zero(rest, num_exact_ctx());
}

/* Of numbers that add up to size without their signs. */
static bool is_nothing(double rest, double size) {
  return fabs(rest) <= 1e-9 * size;
}

static bool near(const struct fact *goal, const struct term *const t[], int n) {
  for (int k = 0; k < N_PROBES; k++) {
    double rest = goal->probe[k], size = fabs(rest);
    for (int i = 0; i < n; i++) {
      rest -= t[i]->probe[k];
      size += fabs(t[i]->probe[k]);
    }
    if (!is_nothing(rest, size)) return false;
  }
  return true;
}

static void describe(struct text *out, const struct fact *goal, const struct term *const t[], int n,
                     const struct proof *p) {
  text_add(out, out->len ? "; " : "");
  if (n == 1 && strcmp(goal->text, p->positive[t[0]->fact].text) == 0) {
    text_printf(out, "%s is a premise", goal->text);
    return;
  }
  text_printf(out, "the margin of %s is", goal->text);
  for (int i = 0; i < n; i++) {
    const char *factor = factor_text[t[i]->factor];
    text_add(out, i ? " plus " : " ");
    if (t[i]->scale && !fmpz_mpoly_q_is_one(t[i]->scale->x, num_exact_ctx())) text_add(out, "a positive factor times ");
    if (strcmp(factor, "1") != 0) text_printf(out, "%s times ", factor);
    text_printf(out, "that of %s", p->positive[t[i]->fact].text);
  }
}

static void add_step(const struct fact *goal, const struct term *const t[], int n, struct proof *p) {
  OWNED(calc) c = calc_begin(num_ctx_exact());
  text_printf(p->script, "\n        (%d, [", (int)(goal - p->goal));
  for (int i = 0; i < n; i++) {
    text_printf(p->script, "%s(", i ? ", " : "");
    add_element(p, factor_of(&c, t[i], p));
    text_printf(p->script, ", %d)", t[i]->fact);
  }
  text_add(p->script, "]),");
}

/* Terms of a list, some of them picked. */
struct choice {
  const struct fact *goal;
  struct proof *p;
  const struct term *t;
  int n;
  const struct term *pick[3];
};

/* So many terms that add up to the goal, the next ones from that one on.  rest: what those picked leave of it at the
   first probe, by which most are told. */
static bool choose(struct choice *c, int picked, int wanted, int from, double rest, double size) {
  if (picked == wanted) return near(c->goal, c->pick, wanted) && exactly(c->goal, c->pick, wanted, c->p);
  for (int i = from; i < c->n; i++) {
    double part = c->t[i].probe[0], left = rest - part, whole = size + fabs(part);
    if (picked + 1 == wanted && !is_nothing(left, whole)) continue;
    c->pick[picked] = &c->t[i];
    if (choose(c, picked + 1, wanted, i + 1, left, whole)) return true;
  }
  return false;
}

/* For each fact by what the terms with it are scaled: what is positive and divides the goal over what divides the fact.
   Returns whether any is not 1. */
static bool find_scales(struct fact *scale, const struct fact *goal, struct proof *p) {
  OWNED(calc) c = calc_begin(num_ctx_exact());
  element *bare = calc_new(&c);
  val of_goal = calc_div(&c, goal->x, without_sure(bare, goal->x, p));
  bool any = false;
  for (int i = 0, n = 0; i < p->n_positive; i++) {
    val of_fact = calc_div(&c, p->positive[i].x, without_sure(bare, p->positive[i].x, p));
    val s = calc_div(&c, of_goal, of_fact);
    add_fact(scale, &n, &p->c, s, NULL);
    probe(&scale[i]);
    any = any || !fmpz_mpoly_q_is_one(s, num_exact_ctx());
  }
  return any && c.status == SS_OK;
}

/* One to three terms that add up to the goal. */
static bool combine_scaled(struct text *out, const struct fact *goal, struct proof *p, const struct fact *scale) {
  enum { MAX_TERMS = MAX_FACTS * N_FACTORS };
  FREED struct term *t = ss_malloc(MAX_TERMS * sizeof *t);
  int n = 0;
  for (int i = 0; i < p->n_positive; i++)
    for (int m = 0; m < N_FACTORS; m++) {
      t[n] = (struct term){i, m, scale ? &scale[i] : NULL, {0}};
      for (int k = 0; k < N_PROBES; k++)
        t[n].probe[k] = p->positive[i].probe[k] * p->factor[m].probe[k] * (scale ? scale[i].probe[k] : 1);
      n++;
    }
  struct choice c = {.goal = goal, .p = p, .t = t, .n = n};
  bool found = false;
  for (int wanted = 1; !found && wanted <= 3; wanted++) {
    found = choose(&c, 0, wanted, 0, goal->probe[0], fabs(goal->probe[0]));
    if (found) describe(out, goal, c.pick, wanted, p);
    if (found && p->script) add_step(goal, c.pick, wanted, p);
  }
  return found;
}

static bool combine(struct text *out, const struct fact *goal, struct proof *p) {
  FREED struct fact *scale = ss_malloc(MAX_FACTS * sizeof *scale);
  if (combine_scaled(out, goal, p, NULL)) return true;
  return find_scales(scale, goal, p) && combine_scaled(out, goal, p, scale);
}

/* --- The proof --- */

enum { N_SIGNS = 6, N_DOMAIN = 8 }; /* the last two: sliding friction */
static const char *const domain[N_DOMAIN] = {"chi", "1 - chi", "eta", "V", "e_1", "e_2", "u_s1", "u_s2"};
static const char *const domain_text[N_DOMAIN] = {"chi > 0", "chi < 1", "eta > 0",  "V > 0",
                                                  "e_1 > 0", "e_2 > 0", "u_s1 > 0", "u_s2 > 0"};
static const char *const friction[] = {"u_r1 - u_s1 - e_1", "u_r2 - u_s2 - e_2"};
static const char *const friction_text[] = {"(7)", "(5)"};

/* The tapes that do not come from conditions. */
struct extra {
  struct elaboration el;
  struct tape domain, friction, factors, clock, increase;
  const char *increase_text[3], *clock_text[2];
  int phase;   /* of the conclusion's time t; -1 when nothing moves there, N_PHASES when several do */
  int premise; /* of the premises' time t where the conclusion has none: any moment of that phase, its ends too; -1
                  where the phase may take no time */
  bool monotone;
  bool strict; /* some inequality of the conclusion */
};

static void take_phase(int *phase, int ph) {
  *phase = *phase < 0 || *phase == ph ? ph : N_PHASES;
}

/* h'(t), h(t) - h(start), h(end) - h(t). */
static bool monotone_tape(struct extra *x, struct judge *j, const struct claim *c) {
  const char *which = claim_get(c, "increasing");
  if (!which) return true;
  char name[32], phase[16];
  if (sscanf(which, "%31s %15s", name, phase) != 2) return claim_error(j, c, "increasing", "reads NAME PHASE");
  int ph = word_find(phase, phase_name, N_PHASES);
  if (ph == N_PHASES) return claim_error(j, c, "increasing", "no such phase");
  take_phase(&x->phase, ph);
  x->monotone = x->strict = true;
  x->increase_text[0] = result_str(j->out, "%s'(t)", name);
  x->increase_text[1] = result_str(j->out, "%s(t) - %s(%s)", name, name, name_switching[ph]);
  x->increase_text[2] = result_str(j->out, "%s(%s) - %s(t)", name, name_switching[ph + 1], name);
  return expressions_tape(&x->increase, &x->el, x->increase_text, 3, claim_section(c), j->d);
}

/* Where the time t lies. */
static bool clock_tape(struct extra *x, struct judge *j) {
  if (x->phase < 0 || x->phase == N_PHASES) return true;
  const char *start = name_switching[x->phase];
  x->clock_text[0] = result_str(j->out, strchr(start, ' ') ? "t - (%s)" : "t - %s", start);
  x->clock_text[1] = result_str(j->out, "%s - t", name_switching[x->phase + 1]);
  return expressions_tape(&x->clock, &x->el, x->clock_text, 2, "", j->d);
}

/* Whether a condition speaks of the time t of the proof, or of no time t, and is as strict as what is to follow. */
static bool usable(const struct condition *c, const struct extra *x) {
  bool there = !c->moving || (int)c->phase == (x->phase < 0 ? x->premise : x->phase);
  return there && (c->equality || c->strict || !x->strict);
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
    add_fact(p->positive, &p->n_positive, &p->c, p->goal[k].x, p->goal[k].text);
    probe(&p->positive[p->n_positive - 1]);
  }
  return true;
}

static bool prove(struct text *out, struct proof *p, bool monotone) {
  bool ok = true;
  if (p->script) {
    text_add(p->script, "\nx = {name: Symbol(name) for name in [");
    for (slong i = 0; i < p->n_names; i++) text_printf(p->script, "%s\"%s\"", i ? ", " : "", p->name[i]);
    text_printf(p->script, "]}\nPROOFS.append(dict(\n    x=x,\n    rises=%s,\n", monotone ? "True" : "False");
    add_facts(p, "zero", p->zero, p->n_zero);
    add_facts(p, "positive", p->positive, p->n_positive);
    add_facts(p, "goals", p->goal, p->n_goals);
    text_add(p->script, "    solved=[");
  }
  for (int i = 0; ok && i < p->n_zero; i++) ok = eliminate(p, i);
  if (p->script) text_add(p->script, "\n    ],\n    steps=[");
  probe_all(p->positive, p->n_positive);
  probe_all(p->goal, p->n_goals);
  probe_all(p->factor, p->n_factors);
  if (monotone) ok = ok && use_monotone(out, p);
  for (int i = monotone ? 3 : 0; ok && i < p->n_goals; i++) ok = combine(out, &p->goal[i], p);
  if (p->script) text_add(p->script, "\n    ],\n))\n");
  return ok;
}

bool certificate_find(struct text *out, struct text *script, const struct combination *q) {
  struct judge *j = q->j;
  const struct conditions *premises = q->premises, *conclusion = q->conclusion;
  struct extra x = {.phase = -1, .premise = -1, .strict = conditions_any_strict(conclusion)};
  bool inequalities = true;
  for (int i = 0; i < conclusion->n; i++) {
    inequalities = inequalities && !conclusion->at[i].equality;
    if (conclusion->at[i].moving) take_phase(&x.phase, (int)conclusion->at[i].phase);
  }
  for (int i = 0; i < premises->n; i++)
    if (premises->at[i].moving && q->admissible) take_phase(&x.premise, (int)premises->at[i].phase);
  bool timeless = x.phase < 0; /* the conclusion */
  elaboration_init(&x.el, q->view, NULL, 0);
  bool ok = expressions_tape(&x.domain, &x.el, domain, q->sliding_friction ? N_DOMAIN : N_SIGNS, "", j->d) &&
            expressions_tape(&x.friction, &x.el, friction, 2, "", j->d) &&
            expressions_tape(&x.factors, &x.el, factor_text, N_FACTORS, "", j->d) && monotone_tape(&x, j, q->c) &&
            clock_tape(&x, j) && inequalities && x.phase < N_PHASES && (q->admissible || !timeless || x.phase < 0);
  if (ok) {
    FREED struct proof *p = ss_malloc(sizeof *p);
    *p = (struct proof){.c = calc_begin(num_ctx_exact()), .script = script};
    ok = name_all(p, &x, premises, conclusion);
    ok = ok && collect(p, &x, premises, conclusion) && prove(out, p, x.monotone);
    calc_clear(&p->c);
  }
  struct tape *tapes[] = {&x.domain, &x.friction, &x.factors, &x.clock, &x.increase};
  for (size_t i = 0; i < sizeof tapes / sizeof *tapes; i++) tape_clear(tapes[i]);
  elaboration_clear(&x.el);
  return ok;
}
