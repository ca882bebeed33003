/* Sentences about form: thresholds that two inequalities share, ranges of indices, definitions. */
#include "judge.h"
#include "num/calc.h"
#include <stdlib.h>
#include <string.h>

/* --- Thresholds --- */

/* Statement k of the bound record reads NAME > expr; step 0 of statement k of the judged record is lhs < rhs.  The
   bound is the threshold of the step when rhs - lhs is zero at NAME = expr, negative below and positive above. */
struct threshold {
  struct sentence s; /* tape outputs: expr, rhs - lhs */
  slong name;        /* input index of NAME; -1 when the step does not contain it */
};

static bool threshold_build(struct threshold *t, struct judge *j, const struct claim *c, struct view view,
                            const struct statement_record *bound, const struct statement_record *rec, int k) {
  const struct stmt *b = bound->stmts[k], *st = rec->stmts[k];
  t->s = (struct sentence){.n = 1};
  elaboration_init(&t->s.el, view, NULL, 0);
  if (b->kind != STMT_RELATION || b->ops[0] != REL_GT || b->sides[0]->kind != EXPR_SYM)
    return claim_error(j, c, "bound", "its statements read NAME > expression");
  struct matrix e, lo, hi;
  if (!elaborate(&e, &t->s.el, b->sides[1], bound->src, bound->section, j->d) ||
      !elaborate_sides(&lo, &hi, &t->s.el, st, 0, rec->src, rec->section, j->d))
    return false;
  const struct expr *out[] = {e.e[0], expr_op2(&t->s.el.pool, EXPR_SUB, hi.e[0], lo.e[0])};
  if (!elaboration_tape(&t->s.tape, &t->s.el, out, 2, j->d)) return false;
  t->name = -1;
  for (slong i = 0; i < t->s.tape.n_inputs; i++)
    if (strcmp(t->s.tape.inputs[i], b->sides[0]->name) == 0) t->name = i;
  return true;
}

/* TRUE: zero at the bound within 2^(-bits/2), of the right sign one unit below and above. */
static truth threshold_at(long *accepted, const struct threshold *t, struct judge *j, const struct point *p,
                          enum variant variant) {
  struct num_ctx ctx = num_ctx_arb(FIRST_PREC);
  struct values v;
  truth holds = TRUTH_UNKNOWN;
  int s = values_init(&v, p, variant, ctx, j->cache);
  struct calc c = calc_begin(ctx);
  struct num_vec in = calc_vec(&c, t->s.tape.n_inputs), out = calc_vec(&c, 2);
  bool known = true;
  for (slong i = 0; s == SS_OK && i < t->s.tape.n_inputs; i++)
    s |= values_bind(num_vec_at(&in, i), &known, &v, t->s.tape.inputs[i]);
  if (s == SS_OK) s |= tape_eval(&out, NULL, &t->s.tape, &in);
  if (s == SS_OK && t->name < 0) holds = TRUTH_FALSE; /* the step does not depend on NAME at all */
  if (s == SS_OK && t->name >= 0) {
    arb_t bound;
    arb_init(bound);
    arb_set(bound, num_vec_at(&out, 0));
    holds = TRUTH_TRUE;
    for (int side = -1; side <= 1; side++) {
      arb_add_si(num_vec_at(&in, t->name), bound, side, FIRST_PREC);
      s |= tape_eval(&out, NULL, &t->s.tape, &in);
      arb_srcptr m = num_vec_at(&out, 1);
      truth here = TRUTH_UNKNOWN;
      if (side == 0 && !arb_contains_zero(m))
        here = TRUTH_FALSE;
      else if (side == 0)
        here = mag_cmp_2exp_si(arb_radref(m), -FIRST_PREC / 2) < 0 ? TRUTH_TRUE : TRUTH_UNKNOWN;
      else if (side < 0)
        here = arb_is_negative(m) ? TRUTH_TRUE : arb_is_nonnegative(m) ? TRUTH_FALSE : TRUTH_UNKNOWN;
      else
        here = arb_is_positive(m) ? TRUTH_TRUE : arb_is_nonpositive(m) ? TRUTH_FALSE : TRUTH_UNKNOWN;
      holds = truth_and(holds, here);
    }
    arb_clear(bound);
  }
  if (s == SS_OK) ++*accepted;
  calc_clear(&c);
  values_clear(&v);
  return s == SS_OK ? holds : TRUTH_UNKNOWN;
}

static void threshold_route(struct route_result *w, struct finding *f, struct judge *j, const struct claim *c,
                            const struct threshold *t, int n, enum variant variant, const char *route) {
  enum { ORBITS = 12, DRAWS = 100 };
  struct sampler s;
  struct point p;
  long accepted = 0, yes = 0, no = 0;
  const char *where = NULL;
  sampler_init(&s, c->id, POINT_ORBIT, PHASE_D, NULL);
  point_init(&p);
  for (int i = 0; i < DRAWS && accepted < ORBITS; i++) {
    sampler_next(&p, &s);
    if (!point_settle(&p, j->cache)) continue;
    long before = accepted, tried = 0;
    truth all = TRUTH_TRUE;
    for (int k = 0; k < n; k++) all = truth_and(all, threshold_at(&tried, &t[k], j, &p, variant));
    accepted = before + (tried == n);
    if (tried != n) continue;
    yes += all == TRUTH_TRUE;
    no += all == TRUTH_FALSE;
    if (all == TRUTH_FALSE && !where) {
      struct text at;
      text_init(&at);
      point_print(&at, &p);
      where = result_take(j->out, &at);
    }
  }
  point_clear(&p);
  enum route_outcome outcome = !accepted         ? ROUTE_NOTHING
                               : no              ? ROUTE_DIFFERS
                               : yes == accepted ? ROUTE_AGREES
                                                 : ROUTE_UNDECIDED;
  *w = (struct route_result){route, outcome, variant == VARIANT_CLOSED, accepted};
  finding_add_route(f, j->out, *w, "own text printed, the rest corrected", FIRST_PREC, where,
                    "zero at the bound, false one below it, true one above");
}

bool judge_threshold(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  enum { MAX = 8 };
  const char *id = claim_get(c, "statement"), *bound_id = claim_get(c, "bound");
  const struct statement_record *rec = id ? view_record(&view, id) : NULL;
  const struct statement_record *bound = bound_id ? view_record(&view, bound_id) : NULL;
  if (!rec) return claim_error(j, c, "statement", "there is no such record in the equation files");
  if (!bound || bound->n_stmts > rec->n_stmts || bound->n_stmts > MAX)
    return claim_error(j, c, "bound", "there is no such record with at most as many statements");
  struct threshold t[MAX];
  memset(t, 0, sizeof t);
  struct route_result w[2];
  bool ok = true;
  int n = 0;
  for (; ok && n < bound->n_stmts; n++) ok = threshold_build(&t[n], j, c, view, bound, rec, n);
  if (ok) {
    threshold_route(&w[0], f, j, c, t, n, VARIANT_CLOSED, "balls");
    threshold_route(&w[1], f, j, c, t, n, VARIANT_EXPONENTIAL, "exponential");
    f->verdict = verdict_of(w, 2, false);
  }
  for (int k = 0; k < n; k++) sentence_clear(&t[k].s);
  return ok;
}

/* --- Index ranges --- */

enum { MOST_INDEX = 9 };

/* A range of the indices of a letter, as a text claims it. */
struct index_range {
  const char *letter;
  int low, high;
  int size;                  /* rows of the model's matrix of that letter */
  bool used[MOST_INDEX + 1]; /* as an index of some entry */
  struct text outside;       /* entries that have an index out of the range */
};

/* Books the names LETTER_ij in the tree. */
static void book_entries(struct index_range *r, const struct expr *e) {
  size_t n = strlen(r->letter);
  if (e->kind == EXPR_SYM && strncmp(e->name, r->letter, n) == 0 && e->name[n] == '_') {
    const char *index = e->name + n + 1;
    bool outside = false, digits = strspn(index, "0123456789") == strlen(index) && *index;
    for (const char *p = index; digits && *p; p++) {
      r->used[*p - '0'] = true;
      outside = outside || *p - '0' < r->low || *p - '0' > r->high;
    }
    if (outside && !strstr(text_str(&r->outside), e->name))
      text_printf(&r->outside, "%s%s", r->outside.len ? ", " : "", e->name);
  }
  for (int i = 0; i < e->n_args; i++) book_entries(r, e->args[i]);
}

static bool range_ends(int *lo, int *hi, const char *text) {
  return text && sscanf(text, "%d %d", lo, hi) == 2;
}

/* What is wrong with the range, or NULL: entries outside it, indices that the matrix has not; and, of a correction,
   ends that no entry has. */
static const char *range_fault(struct index_range *r, struct judge *j, const struct statement_record *rec,
                               bool smallest) {
  const char *fault = NULL;
  text_init(&r->outside);
  for (int k = 0; k < rec->n_stmts; k++)
    for (int i = 0; i < (rec->stmts[k]->kind == STMT_RELATION ? rec->stmts[k]->n_sides : 1); i++)
      book_entries(r, rec->stmts[k]->sides[i]);
  if (r->outside.len)
    fault = result_str(j->out, "%s used with an index outside %d..%d: %s", r->letter, r->low, r->high,
                       text_str(&r->outside));
  else if (r->low < 1 || r->high > r->size)
    fault = result_str(j->out, "%s has no index %d: it is a matrix of %d rows and columns", r->letter,
                       r->low < 1 ? r->low : r->size + 1, r->size);
  else if (smallest && (r->low > r->high || !r->used[r->low] || !r->used[r->high]))
    fault = result_str(j->out, "no entry of %s is used with the index %d", r->letter,
                       r->low > r->high || r->used[r->low] ? r->high : r->low);
  text_clear(&r->outside);
  return fault;
}

/* The model's matrix, a function of the time or not. */
static int rows_of(const char *letter) {
  char name[32];
  snprintf(name, sizeof name, "%.20s(t)", letter);
  const struct oracle *o = oracle_find(name);
  if (!o) o = oracle_find(letter);
  int rows = o ? oracle_rows(o) : 0;
  return rows < MOST_INDEX ? rows : MOST_INDEX;
}

bool judge_index_range(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  const char *id = claim_get(c, "statement"), *repaired = claim_get(c, "repaired-range");
  const struct statement_record *rec = id ? view_record(&view, id) : NULL;
  struct index_range r = {.letter = claim_get(c, "letter")};
  if (!rec || !r.letter) return claim_error(j, c, "statement", "a record and a letter are needed");
  if (!range_ends(&r.low, &r.high, claim_get(c, "range"))) return claim_error(j, c, "range", "a range reads LOW HIGH");
  r.size = rows_of(r.letter);
  if (!r.size) return claim_error(j, c, "letter", "the model has no matrix of that name");
  const char *fault = range_fault(&r, j, rec, false);
  struct route_result w = {"diagnostic", fault ? ROUTE_DIFFERS : ROUTE_AGREES, true, 1};
  finding_add_route(f, j->out, w, "printed", -1, NULL,
                    fault ? fault : result_str(j->out, "every index of %s lies in %d..%d", r.letter, r.low, r.high));
  f->verdict = fault ? VERDICT_REFUTED : VERDICT_PROVED;
  struct index_range again = {.letter = r.letter, .size = r.size};
  if (fault && repaired) {
    if (!range_ends(&again.low, &again.high, repaired))
      return claim_error(j, c, "repaired-range", "a range reads LOW HIGH");
    fault = range_fault(&again, j, rec, true);
    f->correction = result_str(j->out, "indices %d..%d", again.low, again.high);
    f->correction_verdict = fault ? VERDICT_REFUTED : VERDICT_PROVED;
    finding_state(f, j->out, "diagnostic", layer_name[LAYER_CORRECTED], -1, 1, NULL,
                  fault ? fault
                        : result_str(j->out,
                                     "the smallest range that holds every index used, and the model's %s has all "
                                     "its entries",
                                     r.letter));
  }
  return true;
}

bool judge_definition(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)j;
  (void)c;
  (void)view;
  f->verdict = VERDICT_DEFINITION;
  return true;
}
