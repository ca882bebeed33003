/* Do two models say the same?  Decided by exact algebra where it reaches: both sides are elaborated in both models and
   compared as rational functions in one field. */
#include <stdlib.h>
#include <string.h>

#include "claim/claim.h"
#include "power/facts.h"
#include "proof/condition.h"
#include "record/result.h"
#include "tape/exact.h"
#include "value/sentence.h"

static bool is_first_order(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_FIRST_ORDER;
}

/* Does the statement take first orders in small symbols?  A matrix held as unknown would hide them. */
static bool linearizes(const struct stmt *s) {
  return stmt_any(s, is_first_order, NULL);
}

static bool record_linearizes(struct view v, const char *id) {
  const struct statement_record *r = id ? view_record(&v, id) : NULL;
  for (int k = 0; r && k < r->n_stmts; k++)
    if (linearizes(r->stmts[k])) return true;
  return false;
}

/* --- Comparing --- */

static enum relop mirrored(enum relop op) {
  static const enum relop other[] = {
      [REL_EQ] = REL_EQ, [REL_LT] = REL_GT, [REL_LE] = REL_GE, [REL_GT] = REL_LT, [REL_GE] = REL_LE};
  return other[op];
}

/* Entries i of a and k of b, of sentences without an oracle: their differences of sides, up to what is positive. */
static bool same_relation(struct exact_field *f, const struct sentence *sa, const struct num_vec *a, slong i,
                          const struct sentence *sb, const struct num_vec *b, slong k) {
  OWNED(calc) c = exact_calc(f);
  void *x = calc_new(&c), *y = calc_new(&c);
  int sign = 0;
  if (exact_sub(x, f, num_vec_at(a, i), num_vec_at(a, sa->n + i)) &&
      exact_sub(y, f, num_vec_at(b, k), num_vec_at(b, sb->n + k)))
    sign = exact_ratio_sign(f, x, y, name_param, N_PARAMS); /* which the domain of the claims keeps positive */
  bool both_zero = exact_is_zero(x) && exact_is_zero(y);
  enum relop op_a = sa->ops[i], op_b = sb->ops[k];
  if (sign == 0 || (both_zero && op_a != op_b)) return false;
  return op_a == REL_EQ ? op_b == REL_EQ : op_b == (sign > 0 ? op_a : mirrored(op_a));
}

/* Is every relation of a one of b? */
static bool has_relations(struct exact_field *f, const struct sentence *sa, const struct num_vec *a,
                          const struct sentence *sb, const struct num_vec *b) {
  for (slong i = 0; i < sa->n; i++) {
    bool found = i < sb->n && same_relation(f, sa, a, i, sb, b, i);
    for (slong k = 0; !found && k < sb->n; k++) found = same_relation(f, sa, a, i, sb, b, k);
    if (!found) return false;
  }
  return true;
}

/* Whether both say the same (with a sign known, if given): of values, and of sentences with an oracle, that the left
   sides are equal; else that the sets of relations are. */
static bool same_sentences(const struct sentence *a, const struct sentence *b, bool values, const struct facts *facts,
                           const struct claim *c, const struct exact_fact *sign) {
  values = values || a->oracle;
  if (a->oracle != b->oracle || (values && (a->n != b->n || a->cols != b->cols))) return false;
  struct exact_fact fact[MOST_FACTS + 1];
  int n = facts_collect(fact, facts, c);
  if (sign) fact[n++] = *sign;
  EXACT_FIELD f = exact_field_new(fact, n);
  if (values) return exact_tapes_equal(f, &a->tape, &b->tape);
  OWNED(calc) w = exact_calc(f);
  struct num_vec x, y;
  int s = exact_eval(&x, &w, f, &a->tape);
  s |= exact_eval(&y, &w, f, &b->tape);
  return s == SS_OK && has_relations(f, a, &x, b, &y) && has_relations(f, b, &y, a, &x);
}

static bool same_in_views(const struct claim *c, struct view a, struct view b, const struct facts *f,
                          const struct override *o, int n) {
  OWNED(sentence) x, y;
  struct diag d = {0};
  bool ok = sentence_from_claim(&x, a, c, o, n, &d);
  ok = sentence_from_claim(&y, b, c, o, n, &d) && ok;
  return ok && same_sentences(&x, &y, false, f, c, NULL);
}

bool claim_says_corrected(const struct claim *c, const struct model *a, const struct model *b, const struct facts *f) {
  return same_in_views(c, claim_view(a, c), (struct view){b, LAYER_CORRECTED, NULL, NULL}, f, NULL, 0);
}

/* --- What can be told apart --- */

static bool same_end(const struct expr *x, const struct expr *y, const struct statement_record *r,
                     const struct model *m) {
  struct num_vec v;
  struct matrix a, b;
  struct diag d = {0};
  if (!x || !y || expr_same(x, y)) return !x == !y;
  OWNED(elaboration) el;
  OWNED(tape) tape = {.n = 0};
  EXACT_FIELD f = exact_field_new(NULL, 0);
  OWNED(calc) c = exact_calc(f);
  elaboration_init(&el, (struct view){m, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  return elaborate(&a, &el, x, r->src, r->section, &d) && elaborate(&b, &el, y, r->src, r->section, &d) &&
         a.rows * a.cols == 1 && b.rows * b.cols == 1 &&
         elaboration_tape(&tape, &el, (const struct expr *const[]){a.e[0], b.e[0]}, 2, &d) &&
         exact_eval(&v, &c, f, &tape) == SS_OK && exact_equal(f, num_vec_at(&v, 0), num_vec_at(&v, 1));
}

/* Whether the damaged statement speaks of the same times as before. */
static bool same_range(const struct target *t, const struct model *a, const struct model *b) {
  const struct statement_record *r = &a->records[t->record];
  const struct stmt *x = r->stmts[t->stmt], *y = b->records[t->record].stmts[t->stmt];
  return same_end(x->range_lo, y->range_lo, r, a) && same_end(x->range_hi, y->range_hi, r, a) &&
         x->lo_closed == y->lo_closed && x->hi_closed == y->hi_closed;
}

static bool same_condition(const struct condition *x, const struct condition *y) {
  EXACT_FIELD f = exact_field_new(NULL, 0);
  return x->equality == y->equality && x->strict == y->strict && x->phase == y->phase &&
         exact_tapes_equal(f, &x->s.tape, &y->s.tape);
}

/* Whether an argument has the same premises and conclusions: it may name a part of the damaged record that is sound. */
static bool argument_same_in(const struct claim *c, const struct model *a, const struct model *b) {
  static const char *const part[] = {"premises", "conclusion", "repair"};
  FREED struct conditions *list = ss_malloc(2 * sizeof *list);
  LOCAL(audit_result, out);
  bool same = true;
  for (int i = 0; same && i < 3; i++) {
    for (int k = 0; k < 2; k++) {
      struct diag d = {0};
      struct judge j = {.out = &out, .d = &d};
      same = conditions_read(&list[k], &j, c, part[i], claim_view(k ? b : a, c)) && same;
    }
    same = same && list[0].n == list[1].n;
    for (int k = 0; same && k < list[0].n; k++) same = same_condition(&list[0].at[k], &list[1].at[k]);
    for (int k = 0; k < 2; k++) conditions_clear(&list[k]);
  }
  return same;
}

bool claim_same_in(const struct claim *c, const struct target *t, const struct model *a, const struct model *b,
                   const struct facts *f) {
  struct view whole_a = {a, LAYER_CORRECTED, NULL, NULL}, whole_b = {b, LAYER_CORRECTED, NULL, NULL};
  struct override o[MOST_UNKNOWNS];
  const char *id = claim_get(c, "statement");
  bool written_out = claim_get(c, "value") || record_linearizes(whole_a, id) || record_linearizes(whole_b, id);
  int most = written_out ? 0 : facts_unknowns(o, f, t);
  if (claim_kind(c) == KIND_ARGUMENT) return argument_same_in(c, a, b);
  if (!same_range(t, a, b)) return false;
  for (int n = 0; claim_tried_at_points(c) && n <= most; n += most ? most : 1)
    if (same_in_views(c, claim_view(a, c), claim_view(b, c), f, o, n) && same_in_views(c, whole_a, whole_b, f, o, n))
      return true;
  return false;
}

/* The sentence "the definition's value", or the statement's relations. */
static bool target_sentence(struct sentence *s, const struct target *t, const struct model *m, const struct override *o,
                            int n) {
  const struct statement_record *r = &m->records[t->record];
  const struct stmt *st = r->stmts[t->stmt];
  struct diag d = {0};
  struct view v = {m, LAYER_CORRECTED, t->corrected ? r->equation : NULL, NULL};
  const struct stmt *stmts[] = {st};
  struct statement_record alone = *r;
  alone.stmts = stmts;
  alone.n_stmts = 1;
  if (t->def < 0) return sentence_from_relations(s, v, &alone, o, n, &d);
  const struct expr arg = {.kind = EXPR_SYM, .name = st->param}, *args[] = {&arg};
  struct expr use = {
      .kind = st->param ? EXPR_CALL : EXPR_SYM, .name = st->name, .n_args = st->param != NULL, .args = args};
  struct matrix x;
  *s = (struct sentence){.n = 0};
  elaboration_init(&s->el, v, o, n);
  if (st->param && !model_is_symbol(m, st->param)) return false;
  if (!elaborate(&x, &s->el, &use, r->src, r->section, &d)) return false;
  s->n = x.rows * x.cols;
  s->cols = x.cols;
  return elaboration_tape(&s->tape, &s->el, x.e, s->n, &d);
}

/* Whether statement t says the same in both models, the damaged statement being `damaged`. */
static bool statement_same_in(const struct target *t, const struct target *damaged, const struct model *a,
                              const struct model *b, const struct facts *f) {
  struct override o[MOST_UNKNOWNS];
  bool written_out =
      linearizes(a->records[t->record].stmts[t->stmt]) || linearizes(b->records[t->record].stmts[t->stmt]);
  int most = written_out ? 0 : facts_unknowns(o, f, damaged);
  bool ok = false;
  if (t == damaged && !same_range(t, a, b)) return false;
  for (int n = 0; !ok && n <= most; n += most ? most : 1) {
    OWNED(sentence) x, y;
    ok = target_sentence(&x, t, a, o, n);
    ok = target_sentence(&y, t, b, o, n) && ok;
    const struct stmt *st = a->records[t->record].stmts[t->stmt];
    struct exact_fact sign[] = {{st->range_var, f->sign[0]}, {st->range_var, f->sign[1]}};
    if (!st->range_signs) ok = ok && same_sentences(&x, &y, t->def >= 0, f, NULL, NULL);
    for (int i = 0; ok && st->range_signs && i < 2; i++) ok = same_sentences(&x, &y, t->def >= 0, f, NULL, &sign[i]);
  }
  return ok;
}

/* --- How far a difference spreads --- */

static bool names_it(const char *text, const char *name) {
  static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_'";
  size_t n = strlen(name);
  for (const char *p = text ? strstr(text, name) : NULL; p; p = strstr(p + 1, name))
    if ((p == text || !strchr(letters, p[-1])) && (!p[n] || !strchr(letters, p[n]))) return true;
  return false;
}

/* Does a claim name the definition itself, not through a statement? */
static bool claim_names(const struct claims *claims, const char *name) {
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    enum kind kind = claim_kind(c);
    bool by_chain = kind == KIND_CRITERION || kind == KIND_REPORT; /* tr(J) */
    if (names_it(claim_get(c, "value"), name) || names_it(claim_get(c, "formula"), name) ||
        (by_chain && strcmp(name, "J") == 0))
      return true;
  }
  return false;
}

struct spread {
  const struct target *damaged;
  const struct model *a, *b;
  const struct facts *f;
  const struct claims *claims;
  bool *seen; /* definitions already on the way */
};

static bool contained(struct spread *s, const struct target *t) {
  if (statement_same_in(t, s->damaged, s->a, s->b, s->f)) return true;
  if (s->damaged->corrected) return false; /* what uses it reads the errata in its place */
  if (t->def < 0 || claim_names(s->claims, s->a->defs[t->def].name)) return false;
  if (s->seen[t->def]) return true;
  s->seen[t->def] = true;
  for (size_t i = 0; i < s->a->n_records; i++) {
    const struct statement_record *r = &s->a->records[i];
    for (int k = 0; r->rank < RANK_STABLE && k < r->n_stmts; k++) {
      struct target user = target_of(s->a, i, k);
      if ((long)user.def == t->def || !stands_in_statement(r->stmts[k], s->a->defs[t->def].name)) continue;
      if (!contained(s, &user)) return false;
    }
  }
  return true;
}

bool target_same_in(const struct target *t, const struct model *a, const struct model *b, const struct claims *claims,
                    const struct facts *f) {
  FREED bool *seen = ss_malloc(a->n_defs + 1);
  memset(seen, 0, a->n_defs);
  return contained(&(struct spread){t, a, b, f, claims, seen}, t);
}
