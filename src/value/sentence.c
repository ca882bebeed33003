/* Two sides of a sentence, evaluated on a tape at a point and compared.  The paper's side comes from its formulas; the
   other side is the paper's too (an equation) or the model's (an oracle).  In balls a difference is a certificate: the
   two enclosures are disjoint at exact parameters. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "claim/kinds.h"
#include "num/calc.h"
#include "record/result.h"
#include "sentence.h"

/* --- Building --- */

/* The mistake is the formula's, so the diagnostic points at its definition. */
static void wrong_shape(const struct view *v, const char *value, const char *section, const struct matrix *m,
                        const struct oracle *o, struct diag *d) {
  const struct definition *def = view_lookup_value(v, value, section, d);
  if (def)
    diag_at(d, def->src, def->stmt->span.begin, "%s is %dx%d where the model has a %dx%d matrix", value, m->rows,
            m->cols, o->rows, o->cols);
}

bool sentence_from_value(struct sentence *s, struct view v, const char *value, const char *section,
                         const struct override *overrides, int n_overrides, struct diag *d) {
  *s = (struct sentence){.n = 0};
  elaboration_init(&s->el, v, overrides, n_overrides);
  s->oracle = oracle_find(value);
  if (!s->oracle) abort(); /* the callers look first */
  struct matrix m;
  bool ok = elaborate_text(&m, &s->el, value, value, section, d);
  if (ok && (m.rows != s->oracle->rows || m.cols != s->oracle->cols)) {
    wrong_shape(&v, value, section, &m, s->oracle, d);
    ok = false;
  }
  if (ok) {
    s->n = m.rows * m.cols;
    s->cols = m.cols;
    s->ops = ss_malloc((size_t)s->n * sizeof *s->ops);
    for (slong i = 0; i < s->n; i++) s->ops[i] = REL_EQ;
    ok = elaboration_tape(&s->tape, &s->el, m.e, s->n, d);
  }
  return ok;
}

static bool has_equality(const struct stmt *s) {
  bool any = false;
  for (int i = 0; s->kind == STMT_RELATION && i + 1 < s->n_sides; i++) any = any || s->ops[i] == REL_EQ;
  return any;
}

bool record_has_equation(const struct statement_record *r) {
  bool any = false;
  for (int k = 0; k < r->n_stmts; k++) any = any || has_equality(r->stmts[k]);
  return any;
}

/* r > 2, 0 < q_1 < q_2: between symbols of the paper's own and numbers. */
static bool is_of_symbols(const struct model *m, const struct stmt *s) {
  bool all = s->kind == STMT_RELATION;
  for (int i = 0; all && i < s->n_sides; i++) {
    const struct expr *e = expr_bare(s->sides[i]);
    all = e->kind == EXPR_SYM ? model_is_symbol(m, e->name) : !expr_any(e, expr_is_name, NULL);
  }
  return all && stmt_any(s, expr_is_name, NULL);
}

bool statement_is_condition(const struct model *m, const struct statement_record *r, const struct stmt *s) {
  if (s->kind != STMT_RELATION || has_equality(s)) return false;
  bool others = record_has_equation(r);
  for (int k = 0; k < r->n_stmts && !m->system; k++)
    others = others || (is_of_symbols(m, s) && !is_of_symbols(m, r->stmts[k]));
  return others;
}

static bool is_symbol(const struct expr *e, const void *name) {
  return e->kind == EXPR_SYM && strcmp(e->name, name) == 0;
}

/* A name of the statement that stands in the scalar and in none of the others, of which there are n. */
static const char *name_alone(struct expr_pool *p, const struct stmt *st, const struct expr *e,
                              const struct expr **others, int n) {
  enum { DEEP = 8 };
  const char *name = e->kind == EXPR_SYM && strcmp(e->name, expr_pi) != 0 ? e->name : NULL;
  if (name && !stmt_any(st, is_symbol, name)) name = NULL;
  for (int i = 0; name && i < n; i++)
    if (expr_subst(p, others[i], name, expr_int(p, 0)) != others[i]) name = NULL;
  for (int k = 0; k < e->n_args && n < DEEP && !name; k++) {
    bool two = e->n_args == 2;
    if (two) others[n] = e->args[1 - k];
    if (!(two && e->kind == EXPR_MUL && expr_is_zero(others[n]))) name = name_alone(p, st, e->args[k], others, n + two);
  }
  return name;
}

/* An equation in which a symbol stands once, as printed and as elaborated, says what that is, be it "kappa = mu + 1" or
   "kappa - mu = 1". */
static void fix_symbol(struct sentence *s, const struct stmt *st, const struct expr *a, const struct expr *b) {
  const struct expr *others[16] = {b};
  if (!s->fixes) s->fixes = name_alone(&s->el.pool, st, a, others, 1);
  others[0] = a;
  if (!s->fixes) s->fixes = name_alone(&s->el.pool, st, b, others, 1);
}

/* All steps of the record's relations, entry by entry. */
static bool collect(const struct expr ***lhs, const struct expr ***rhs, slong *n, struct sentence *s,
                    const struct statement_record *r, struct diag *d) {
  size_t cap_l = 0, cap_r = 0, cap_o = 0, cap_s = 0;
  for (int k = 0; k < r->n_stmts; k++) {
    const struct stmt *st = r->stmts[k];
    if (!s->el.view.model->system && statement_is_condition(s->el.view.model, r, st)) continue;
    for (int i = 0; st->kind == STMT_RELATION && i + 1 < st->n_sides; i++) {
      struct matrix a, b;
      if (!elaborate_sides(&a, &b, &s->el, st, i, r->src, r->section, d)) return false;
      s->cols = a.cols;
      *SS_PUSH(s->step, s->n_steps, cap_s) = (struct sentence_step){*n + a.rows * a.cols, a.cols};
      for (int e = 0; e < a.rows * a.cols; e++) {
        *lhs = ss_grow(*lhs, (size_t)*n, &cap_l, sizeof **lhs);
        *rhs = ss_grow(*rhs, (size_t)*n, &cap_r, sizeof **rhs);
        s->ops = ss_grow(s->ops, (size_t)*n, &cap_o, sizeof *s->ops);
        s->ops[*n] = st->ops[i];
        if (!s->el.view.model->system && st->ops[i] == REL_EQ) fix_symbol(s, st, a.e[e], b.e[e]);
        (*lhs)[*n] = a.e[e];
        (*rhs)[(*n)++] = b.e[e];
      }
    }
  }
  return *n > 0;
}

/* Pairs of which the first must be less than the second. */
struct pairs {
  const struct expr **low, **high;
  slong n;
};

static void add_pair(struct pairs *p, struct sentence *s, const struct matrix *low, const struct matrix *high,
                     bool closed) {
  s->given_closed[p->n] = closed;
  p->low[p->n] = low->e[0];
  p->high[p->n++] = high->e[0];
}

/* The range of a statement, "lo < q < hi", unless it is a phase of the motion. */
static bool add_range(struct pairs *p, struct sentence *s, const struct statement_record *r, const struct stmt *st,
                      struct diag *d) {
  struct matrix lo, q, hi;
  if (!st->range_hi || (s->el.view.model->system && name_of_range(st) < N_PHASES)) return true;
  const struct expr name = {.kind = EXPR_SYM, .name = st->range_var, .span = st->range_lo->span};
  if (!elaborate(&lo, &s->el, st->range_lo, r->src, r->section, d) ||
      !elaborate(&q, &s->el, &name, r->src, r->section, d) ||
      !elaborate(&hi, &s->el, st->range_hi, r->src, r->section, d))
    return false;
  add_pair(p, s, &lo, &q, st->lo_closed);
  add_pair(p, s, &q, &hi, st->hi_closed);
  return true;
}

/* The steps of a statement that is a condition. */
static bool add_condition(struct pairs *p, struct sentence *s, const struct statement_record *r, const struct stmt *st,
                          struct diag *d) {
  if (s->el.view.model->system || !statement_is_condition(s->el.view.model, r, st)) return true;
  for (int i = 0; i + 1 < st->n_sides; i++) {
    struct matrix a, b;
    bool less = st->ops[i] == REL_LT || st->ops[i] == REL_LE;
    if (!elaborate_sides(&a, &b, &s->el, st, i, r->src, r->section, d)) return false;
    add_pair(p, s, less ? &a : &b, less ? &b : &a, st->ops[i] == REL_LE || st->ops[i] == REL_GE);
  }
  return true;
}

/* Where the statements are said. */
static bool collect_given(struct sentence *s, const struct statement_record *r, struct diag *d) {
  size_t most = 0;
  for (int k = 0; k < r->n_stmts; k++) most += 2 + (size_t)r->stmts[k]->n_sides;
  FREED const struct expr **both = ss_malloc((2 * most + 1) * sizeof *both);
  struct pairs p = {both, both + most, 0};
  bool ok = true;
  s->given_closed = ss_malloc((most + 1) * sizeof *s->given_closed);
  for (int k = 0; ok && k < r->n_stmts; k++)
    ok = add_range(&p, s, r, r->stmts[k], d) && add_condition(&p, s, r, r->stmts[k], d);
  s->n_given = ok ? p.n : 0;
  memmove(both + s->n_given, p.high, (size_t)s->n_given * sizeof *both);
  return ok && elaboration_tape(&s->given, &s->el, both, 2 * s->n_given, d);
}

bool sentence_from_relations(struct sentence *s, struct view v, const struct statement_record *r,
                             const struct override *overrides, int n_overrides, struct diag *d) {
  *s = (struct sentence){.n = 0};
  elaboration_init(&s->el, v, overrides, n_overrides);
  FREED const struct expr **lhs = NULL, **rhs = NULL;
  bool ok = collect(&lhs, &rhs, &s->n, s, r, d);
  if (ok) {
    FREED const struct expr **both = ss_malloc(2 * (size_t)s->n * sizeof *both);
    memcpy(both, lhs, (size_t)s->n * sizeof *both);
    memcpy(both + s->n, rhs, (size_t)s->n * sizeof *both);
    ok = elaboration_tape(&s->tape, &s->el, both, 2 * s->n, d) && collect_given(s, r, d);
  }
  return ok;
}

/* An overlay's record says another kind of thing than that in whose place it stands. */
static void overlay_differs(const struct statement_record *r, struct diag *d, const char *wrong) {
  diag_beyond(d);
  diag_at(d, r->src, r->record->kind.begin, wrong, r->id);
}

const struct statement_record *claim_record(struct view v, const struct claim *c, const char *attribute, const char *id,
                                            struct diag *d) {
  const struct statement_record *r = view_record(&v, id);
  for (int k = 0; r && k < r->n_stmts; k++)
    if (r->stmts[k]->kind == STMT_RELATION) return r;
  const char *wrong = r ? "record %s has no relation to be judged" : "there is no record %s in the equation files";
  if (r && r->rank == RANK_USER)
    overlay_differs(r, d, wrong);
  else
    claim_mistake(c, attribute, d, wrong, id);
  return NULL;
}

/* Does the paper define what a value such as K or H(t) names? */
static bool defines_value(const struct view *v, const char *value, const char *section) {
  struct diag ambiguous = {0};
  return view_lookup_value(v, value, section, &ambiguous) || ambiguous.set;
}

bool sentence_reads(struct view v, const struct claim *c, struct diag *d) {
  const char *value = claim_get(c, "value"), *section = claim_section(c);
  struct matrix m;
  if (claim_get(c, "statement") || !value || !defines_value(&v, value, section)) {
    OWNED(sentence) s;
    return sentence_from_claim(&s, v, c, NULL, 0, d);
  }
  OWNED(elaboration) el;
  elaboration_init(&el, v, NULL, 0);
  return elaborate_text(&m, &el, value, value, section, d);
}

static bool claim_value_known(const struct claim *c, const char *value, struct diag *d) {
  if (!value) return claim_mistake(c, "", d, "a value or a statement is missing");
  return oracle_find(value) || claim_mistake(c, "value", d, "the model has no quantity named %s", value);
}

/* An overlay's equations in the place of the definition are not what defines the value. */
static bool is_replaced(const struct view *v, const struct claim *c, struct diag *d) {
  const struct model unnoted = model_unnoted(v->model);
  const struct view all = {&unnoted, v->layer, v->own, v->control};
  const struct statement_record *r = view_record(&all, c->id);
  bool defines = !r || r->rank != RANK_USER;
  for (int k = 0; r && k < r->n_stmts; k++) defines = defines || r->stmts[k]->kind != STMT_RELATION;
  if (defines) return false;
  overlay_differs(r, d, "record %s defines nothing, in the place of one that does");
  return true;
}

bool sentence_from_claim(struct sentence *s, struct view v, const struct claim *c, const struct override *overrides,
                         int n_overrides, struct diag *d) {
  const char *statement = claim_get(c, "statement"), *value = claim_get(c, "value");
  const struct statement_record *r = statement ? claim_record(v, c, "statement", statement, d) : NULL;
  if (r) {
    bool ok = sentence_from_relations(s, v, r, overrides, n_overrides, d);
    s->sharp = claim_kind(c) == KIND_SHARP;
    for (slong i = 0; ok && s->sharp && i < s->n; i++) s->ops[i] = REL_EQ;
    return ok;
  }
  if (!statement && claim_value_known(c, value, d) && !is_replaced(&v, c, d))
    return sentence_from_value(s, v, value, claim_section(c), overrides, n_overrides, d);
  *s = (struct sentence){.n = 0};
  elaboration_init(&s->el, v, NULL, 0);
  return false;
}

void sentence_clear(struct sentence *s) {
  tape_clear(&s->given);
  tape_clear(&s->tape);
  elaboration_clear(&s->el);
  free(s->given_closed);
  free(s->ops);
  free(s->step);
}

/* --- Evaluating --- */

/* A name that has no value at the point, where that is asked; NULL: all have. */
static void lacks(struct trial *t, const char *unbound) {
  if (!unbound || !t) return;
  t->outcome = OUTCOME_UNBOUND;
  snprintf(t->unbound, sizeof t->unbound, "%s", unbound);
}

/* Whether the point lies in the sentence's ranges for certain; else it is none of the sentence's points. */
static int check_ranges(struct trial *t, const struct sentence *s, struct values *v) {
  struct num_vec out = calc_vec(&v->c, s->given.n_outputs);
  const char *unbound;
  int status = values_eval(&out, &unbound, v, &s->given);
  lacks(t, unbound);
  for (slong i = 0; status == SS_OK && i < s->n_given; i++)
    if (inequality_holds(v->ctx.type, s->given_closed[i] ? REL_LE : REL_LT, num_vec_at(&out, i),
                         num_vec_at(&out, s->n_given + i)) != TRUTH_TRUE)
      status = SS_DOMAIN;
  return status;
}

int sentence_evaluate(struct num_vec *lhs, struct num_vec *rhs, struct trial *t, struct sentence *s, struct values *v) {
  struct num_vec in = calc_vec(&v->c, s->tape.n_inputs), out = calc_vec(&v->c, s->tape.n_outputs);
  const char *unbound;
  int status = values_bind_inputs(&in, &unbound, v, &s->tape);
  lacks(t, unbound);
  if (status == SS_OK && s->n_given) status = check_ranges(t, s, v);
  if (status == SS_OK) status |= tape_eval(&out, NULL, &s->tape, &in);
  for (slong i = 0; i < s->n; i++) v->ctx.type->set(num_vec_at(lhs, i), num_vec_at(&out, i));
  if (status == SS_OK && s->oracle) status |= oracle_eval(rhs, s->oracle, v);
  for (slong i = 0; !s->oracle && i < s->n; i++) v->ctx.type->set(num_vec_at(rhs, i), num_vec_at(&out, s->n + i));
  return status;
}

static int evaluate_at(struct num_vec *lhs, struct num_vec *rhs, struct trial *t, struct sentence *s,
                       const struct point *p, enum variant variant, struct orbit_cache *cache) {
  OWNED(values) v;
  int status = values_init(&v, p, variant, lhs->ctx, cache);
  if (status == SS_OK) status = sentence_evaluate(lhs, rhs, t, s, &v);
  return status;
}

double log2_upper(const arb_t x) {
  NUMBERS(mag, m);
  arb_get_mag(m, x);
  return mag_is_zero(m) ? -INFINITY : mag_get_d_log2_approx(m);
}

/* What cannot be told from zero in twenty digits is zero in ten. */
static void describe(char *out, size_t size, const struct num_vec *v, slong i, slong digits) {
  NUMBERS(arb, x);
  OWNED(text) t = {0};
  v->ctx.type->get_arb(x, num_vec_at(v, i));
  if (arb_contains_zero(x) && log2_upper(x) < -64)
    text_add(&t, "0");
  else if (num_print(&t, x, digits) != SS_OK)
    num_print_ball(&t, x, digits);
  snprintf(out, size, "%s", text_str(&t));
}

/* The largest entry of either side of an equality, at least 1, as log2. */
static double log2_scale(const struct sentence *s, const struct num_vec *lhs, const struct num_vec *rhs) {
  NUMBERS(arb, x);
  double best = 0;
  for (slong i = 0; i < s->n; i++) {
    if (s->ops[i] != REL_EQ) continue;
    lhs->ctx.type->get_arb(x, num_vec_at(lhs, i));
    best = fmax(best, log2_upper(x));
    rhs->ctx.type->get_arb(x, num_vec_at(rhs, i));
    best = fmax(best, log2_upper(x));
  }
  return best;
}

/* Two sides of one sentence, compared. */
struct comparison {
  bool apart; /* some entry is certainly wrong */
  bool open;  /* some inequality is neither proved nor disproved */
};

/* The equality with the largest difference relative to the scale; of those certainly wrong, if there are any. */
static void compare_equalities(struct trial *t, struct comparison *c, const struct sentence *s,
                               const struct num_vec *lhs, const struct num_vec *rhs) {
  NUMBERS(arb, a, b, diff);
  double scale = log2_scale(s, lhs, rhs);
  for (slong i = 0; i < s->n; i++) {
    if (s->ops[i] != REL_EQ) continue;
    lhs->ctx.type->get_arb(a, num_vec_at(lhs, i));
    rhs->ctx.type->get_arb(b, num_vec_at(rhs, i));
    bool disjoint = !arb_overlaps(a, b);
    arb_sub(diff, a, b, 2 * LAST_PREC);
    double d = log2_upper(diff) - scale;
    if (disjoint == c->apart ? d > t->log_diff : disjoint) {
      t->log_diff = d;
      t->entry = i;
    }
    c->apart = c->apart || disjoint;
  }
}

truth inequality_holds(const struct num_type *type, enum relop op, const void *x, const void *y) {
  if (op == REL_EQ) return TRUTH_UNKNOWN;
  truth less = op == REL_LT || op == REL_GE ? type->lt(x, y) : type->lt(y, x);
  return op == REL_LT || op == REL_GT ? less : truth_not(less);
}

static bool entries_overlap(const struct num_vec *lhs, const struct num_vec *rhs, slong i) {
  NUMBERS(arb, x, y);
  lhs->ctx.type->get_arb(x, num_vec_at(lhs, i));
  rhs->ctx.type->get_arb(y, num_vec_at(rhs, i));
  return arb_overlaps(x, y);
}

static void compare(struct trial *t, struct comparison *c, const struct sentence *s, const struct num_vec *lhs,
                    const struct num_vec *rhs) {
  *c = (struct comparison){false, false};
  t->log_diff = -INFINITY;
  t->entry = 0;
  compare_equalities(t, c, s, lhs, rhs);
  for (slong i = 0; i < s->n; i++) {
    if (s->ops[i] == REL_EQ) continue;
    truth holds = inequality_holds(lhs->ctx.type, s->ops[i], num_vec_at(lhs, i), num_vec_at(rhs, i));
    if (holds == TRUTH_UNKNOWN) c->open = true;
    if (holds != TRUTH_FALSE) continue;
    c->apart = true;
    t->entry = i;
  }
  for (slong digits = 10; digits <= 40; digits *= 2) { /* as many as show a difference */
    describe(t->lhs, sizeof t->lhs, lhs, t->entry, digits);
    describe(t->rhs, sizeof t->rhs, rhs, t->entry, digits);
    if (!c->apart || entries_overlap(lhs, rhs, t->entry) || strcmp(t->lhs, t->rhs) != 0) break;
  }
}

/* What balls at this precision say. */
static void decide(struct trial *t, const struct comparison *c, slong prec) {
  if (c->apart)
    t->outcome = OUTCOME_DIFFERS;
  else if (!c->open && t->log_diff < -0.5 * (double)prec)
    t->outcome = OUTCOME_AGREES;
}

struct trial balls_compare(const struct num_vec *lhs, const struct num_vec *rhs) {
  struct trial t = {.outcome = OUTCOME_UNDECIDED, .bits = (long)lhs->ctx.prec};
  struct comparison c;
  struct sentence s = {.n = lhs->len, .ops = ss_malloc((size_t)lhs->len * sizeof *s.ops)};
  for (slong i = 0; i < s.n; i++) s.ops[i] = REL_EQ;
  compare(&t, &c, &s, lhs, rhs);
  decide(&t, &c, lhs->ctx.prec);
  free(s.ops);
  return t;
}

static struct trial try_once(struct sentence *s, struct comparison *c, const struct point *p, enum variant variant,
                             struct num_ctx ctx, struct orbit_cache *cache) {
  struct trial t = {.outcome = OUTCOME_REJECTED, .bits = (long)ctx.prec};
  OWNED(calc) sides = calc_begin(ctx);
  struct num_vec lhs = calc_vec(&sides, s->n), rhs = calc_vec(&sides, s->n);
  *c = (struct comparison){false, false};
  t.status = evaluate_at(&lhs, &rhs, &t, s, p, variant, cache);
  if (t.status == SS_OK) {
    t.outcome = OUTCOME_UNDECIDED;
    compare(&t, c, s, &lhs, &rhs);
  }
  return t;
}

int sentence_values(struct num_vec *lhs, struct num_vec *rhs, struct sentence *s, const struct point *p,
                    struct orbit_cache *cache) {
  return evaluate_at(lhs, rhs, NULL, s, p, VARIANT_CLOSED, cache);
}

struct trial sentence_try_balls(struct sentence *s, const struct point *p, enum variant variant,
                                struct orbit_cache *cache) {
  struct trial t = {.outcome = OUTCOME_REJECTED};
  for (slong prec = FIRST_PREC; prec <= LAST_PREC; prec *= 2) {
    struct comparison c;
    t = try_once(s, &c, p, variant, num_ctx_arb(prec), cache);
    if (t.outcome == OUTCOME_UNBOUND || (t.outcome == OUTCOME_REJECTED && (t.status & SS_DOMAIN))) return t;
    if (t.outcome != OUTCOME_UNDECIDED) continue;
    decide(&t, &c, prec);
    if (t.outcome != OUTCOME_UNDECIDED) break;
  }
  work_precision_raise(LADDER_SIDES, t.bits == FIRST_PREC);
  return t;
}

struct trial sentence_try_ends(struct sentence *s, const struct point *p, enum variant variant,
                               struct orbit_cache *cache) {
  struct trial t = {.outcome = OUTCOME_REJECTED, .bits = FIRST_PREC};
  OWNED(calc) c = calc_begin(num_ctx_arb(FIRST_PREC));
  struct num_vec lhs[2], rhs[2];
  LOCAL(point, at);
  point_copy(&at, p);
  for (int end = 0; end < 2; end++) {
    lhs[end] = calc_vec(&c, s->n);
    rhs[end] = calc_vec(&c, s->n);
    fmpq_set_si(&at.q[Q_S], end, 1);
    t.status |= evaluate_at(&lhs[end], &rhs[end], &t, s, &at, variant, cache);
  }
  for (slong i = 0; i < s->n; i++) {
    if (arb_overlaps(num_vec_at(&lhs[0], i), num_vec_at(&rhs[0], i))) continue;
    arb_set(num_vec_at(&lhs[0], i), num_vec_at(&lhs[1], i));
    arb_set(num_vec_at(&rhs[0], i), num_vec_at(&rhs[1], i));
  }
  if (t.status == SS_OK) t = balls_compare(&lhs[0], &rhs[0]);
  return t;
}

struct trial sentence_try_rounded(struct sentence *s, const struct point *p, enum variant variant, struct num_ctx ctx,
                                  double log_tol, struct orbit_cache *cache) {
  struct comparison c;
  struct trial t = try_once(s, &c, p, variant, ctx, cache);
  if (t.outcome != OUTCOME_UNDECIDED) return t;
  bool inequality_fails = c.apart && s->ops[t.entry] != REL_EQ;
  if (inequality_fails || t.log_diff >= 0.5 * log_tol)
    t.outcome = OUTCOME_DIFFERS;
  else if (!c.open && t.log_diff <= log_tol)
    t.outcome = OUTCOME_AGREES;
  return t;
}

const char *entry_place(struct audit_result *out, slong n, int cols, slong entry) {
  if (n == 1) return "";
  if (cols <= 1) return result_str(out, "%ld", (long)entry + 1);
  return result_str(out, "[%ld,%ld]", (long)(entry / cols) + 1, (long)(entry % cols) + 1);
}

const char *sentence_place(struct audit_result *out, const struct sentence *s, slong entry) {
  size_t k = 0;
  while (k < s->n_steps && entry >= s->step[k].end) k++;
  bool known = s->n_steps > 1 && s->n_steps <= N_ORDINALS;
  slong begin = known && k ? s->step[k - 1].end : 0, equalities = 0;
  for (slong i = 0; i < s->n; i++) equalities += s->ops[i] == REL_EQ;
  const char *place = known ? entry_place(out, s->step[k].end - begin, s->step[k].cols, entry - begin)
                            : entry_place(out, s->n, s->cols, entry);
  if (!known) return *place ? result_str(out, "in entry %s ", place) : "";
  return result_str(out, "in %s%s%sthe %s %s ", *place ? "entry " : "", place, *place ? " of " : "", ordinal_word[k],
                    s->sharp || !equalities ? "inequality"
                    : equalities == s->n    ? "equation"
                                            : "relation");
}
