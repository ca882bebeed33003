/* Sentences that count: which symbols a set of equations contains, and how many functionally independent equations it
   amounts to. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "certificate.h"
#include "num/calc.h"
#include "proof/generic_rank.h"
#include "value/names.h"

enum { MAX_NAMES = RANK_NAMES };

/* --- What a set of equations contains --- */

struct reach {
  struct judge *j;
  char absent[MAX_NAMES][32];
  int n_absent;
  struct text found, all;   /* those that are there, with their records; every one */
  struct certificate first; /* of the former */
};

static void book_name(struct reach *x, const char *name, const char *record) {
  char word[80];
  snprintf(word, sizeof word, " %s,", name);
  if (!strstr(text_str(&x->all), word)) text_add(&x->all, word);
  for (int a = 0; a < x->n_absent; a++) {
    snprintf(word, sizeof word, "%s in %s", x->absent[a], record);
    if (strcmp(x->absent[a], name) != 0 || strstr(text_str(&x->found), word)) continue;
    text_printf(&x->found, "%s%s", x->found.len ? ", " : "", word);
    if (x->first.n) continue;
    certificate_add(&x->first, x->j->out, "symbol", result_copy(x->j->out, name));
    certificate_add(&x->first, x->j->out, "record", result_copy(x->j->out, record));
  }
}

/* What a tape reads, and of "z_1(t_a)" the time. */
static void book_inputs(struct reach *x, const struct tape *t, const char *record) {
  work_add((unsigned long long)t->n);
  for (slong i = 0; i < t->n_inputs; i++) {
    book_name(x, t->inputs[i], record);
    const char *at = strchr(t->inputs[i], '(');
    for (int n; at && *at; at += n ? n : 1) {
      char name[32];
      for (n = 0; char_is_word(at[n]) || at[n] == '\''; n++) continue;
      snprintf(name, sizeof name, "%.*s", n, at);
      if (model_is_symbol(x->j->model, name)) book_name(x, name, record);
    }
  }
}

/* The ends of the times for which a statement is said. */
static bool book_range(struct reach *x, struct view view, const struct statement_record *r, const struct stmt *s) {
  if (!s->range_hi) return true;
  const struct expr *end[] = {s->range_lo, s->range_hi}, *entry[2];
  OWNED(elaboration) el;
  OWNED(tape) t = {.n = 0};
  elaboration_init(&el, view, NULL, 0);
  bool ok = true;
  for (int i = 0; ok && i < 2; i++) {
    struct matrix m;
    ok = elaborate(&m, &el, end[i], r->src, r->section, x->j->d);
    if (ok) entry[i] = m.e[0];
  }
  ok = ok && elaboration_tape(&t, &el, entry, 2, x->j->d);
  if (ok) book_inputs(x, &t, r->id);
  return ok;
}

/* Symbols of the records that are on the list of absent ones, and all symbols there are. */
static bool symbols_of(struct reach *x, const struct claim *c, struct view view) {
  struct judge *j = x->j;
  char ids[MAX_NAMES][32];
  int n = claim_names_listed(ids, MAX_NAMES, claim_get(c, "statements"));
  x->n_absent = claim_names_listed(x->absent, MAX_NAMES, claim_get(c, "absent"));
  if (n == 0 || x->n_absent == 0) return claim_error(j, c, "kind", "statements and absent are needed");
  for (int a = 0; a < x->n_absent; a++)
    if (!model_is_symbol(j->model, x->absent[a])) return claim_error(j, c, "absent", "names of symbols are needed");
  for (int i = 0; i < n; i++) {
    const struct statement_record *r = claim_record(view, c, "statements", ids[i], j->d);
    if (!r) return false;
    OWNED(sentence) s;
    bool ok = sentence_from_relations(&s, view, r, NULL, 0, j->d);
    if (ok) book_inputs(x, &s.tape, ids[i]);
    for (int k = 0; ok && k < r->n_stmts; k++) ok = book_range(x, view, r, r->stmts[k]);
    if (!ok) return false;
  }
  return true;
}

bool judge_reach(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct reach x = {.j = j};
  bool ok = symbols_of(&x, c, view);
  if (ok) {
    struct route_result w = {"algebra", x.found.len ? ROUTE_DIFFERS : ROUTE_AGREES, true, 1};
    if (x.all.len) x.all.data[x.all.len - 1] = '\0';
    finding_add_route(f, j->out, w, layer_name[LAYER_CORRECTED], -1, NULL,
                      x.found.len ? result_copy(j->out, text_str(&x.found))
                                  : result_str(j->out, "the equations contain%s, and nothing else", text_str(&x.all)));
    f->verdict = verdict_of(&w, 1, true);
    f->certificate = x.first;
  }
  text_clear(&x.found);
  text_clear(&x.all);
  return ok;
}

/* --- How many equations it amounts to --- */

/* The derivative of the residuals at a point: symbolic in balls, central differences in MPFR. */
static int system_matrix(struct num_vec *m, struct rank_system *y, const struct point *p, struct orbit_cache *cache) {
  struct num_ctx ctx = m->ctx;
  const struct num_type *t = ctx.type;
  OWNED(values) v;
  int s = values_init(&v, p, VARIANT_CLOSED, ctx, cache);
  const struct tape residuals = rank_system_residuals(y);
  struct num_vec in = calc_vec(&v.c, y->s.tape.n_inputs), out = calc_vec(&v.c, y->s.tape.n_outputs),
                 back = calc_vec(&v.c, y->rows), w = calc_vec(&v.c, 2);
  const char *unbound;
  if (s == SS_OK) s |= values_bind_inputs(&in, &unbound, &v, &y->s.tape);
  if (s == SS_OK && t->rigorous) {
    s |= tape_eval(&out, NULL, &y->s.tape, &in);
    for (int i = 0; i < y->rows * y->cols; i++) t->set(num_vec_at(m, i), num_vec_at(&out, y->rows + i));
  }
  void *h = num_vec_at(&w, 0), *kept = num_vec_at(&w, 1);
  s |= t->set_d(h, ldexp(1, -(int)ctx.prec / 3), ctx.prec);
  for (int k = 0; s == SS_OK && !t->rigorous && k < y->cols; k++) {
    if (y->input[k] < 0) continue; /* the equations do not contain it: its column is zero */
    void *x = num_vec_at(&in, y->input[k]);
    t->set(kept, x);
    s |= t->add(x, kept, h, ctx.prec) | tape_eval(&out, NULL, &residuals, &in);
    s |= t->sub(x, kept, h, ctx.prec) | tape_eval(&back, NULL, &residuals, &in);
    t->set(x, kept);
    for (int i = 0; i < y->rows; i++) {
      void *d = num_vec_at(m, i * y->cols + k);
      s |= t->sub(d, num_vec_at(&out, i), num_vec_at(&back, i), ctx.prec);
      s |= t->div(d, d, h, ctx.prec);
    }
  }
  return s;
}

static double size_of(const struct num_vec *m, slong i) {
  NUMBERS(arb, x);
  NUMBERS(mag, g);
  m->ctx.type->get_arb(x, num_vec_at(m, i));
  arb_get_mag(g, x);
  return mag_get_d(g);
}

/* Whether an entry counts as zero: in balls when its enclosure holds zero and is tiny, rounded below the error of
   differences. */
static truth entry_zero(const struct num_vec *m, slong i) {
  bool tiny = size_of(m, i) < ldexp(1, -(int)m->ctx.prec / 4);
  if (m->ctx.type->rigorous && !arb_contains_zero(num_vec_at(m, i))) return TRUTH_FALSE;
  if (m->ctx.type->rigorous) return tiny ? TRUTH_TRUE : TRUTH_UNKNOWN;
  return tiny ? TRUTH_TRUE : TRUTH_FALSE;
}

/* Elimination with complete pivoting.  least: the pivots that are certainly not zero, so that a minor of that order is
   not; most: -1 when something left cannot be told from zero, else least. */
static void eliminate(int *least, int *most, struct num_vec *m, int rows, int cols) {
  const struct num_type *t = m->ctx.type;
  slong p = m->ctx.prec;
  OWNED(num_vec) w;
  num_vec_init(&w, 2, m->ctx);
  void *factor = num_vec_at(&w, 0), *term = num_vec_at(&w, 1);
  bool used[MAX_NAMES] = {false};
  for (*least = 0;; ++*least) {
    int best = -1;
    for (int i = 0; i < rows * cols; i++)
      if (!used[i / cols] && entry_zero(m, i) == TRUTH_FALSE && (best < 0 || size_of(m, i) > size_of(m, best)))
        best = i;
    if (best < 0) break;
    used[best / cols] = true;
    for (int i = 0; i < rows; i++) {
      if (used[i]) continue;
      t->div(factor, num_vec_at(m, i * cols + best % cols), num_vec_at(m, best), p);
      for (int k = 0; k < cols; k++) {
        t->mul(term, factor, num_vec_at(m, best - best % cols + k), p);
        t->sub(num_vec_at(m, i * cols + k), num_vec_at(m, i * cols + k), term, p);
      }
    }
  }
  *most = *least;
  for (int i = 0; i < rows * cols; i++)
    if (!used[i / cols] && entry_zero(m, i) != TRUTH_TRUE) *most = -1;
}

/* What was seen at the points tried by one route. */
struct count {
  long trials, largest_at; /* at so many the rank is the largest */
  int largest;
  const char *where; /* the first point of the largest */
  struct point *at;  /* there, where it is kept */
};

static void count_at(struct count *n, struct judge *j, struct rank_system *y, const struct point *p,
                     struct num_ctx ctx) {
  OWNED(num_vec) m;
  int least, most;
  num_vec_init(&m, y->rows * y->cols, ctx);
  if (system_matrix(&m, y, p, j->cache) == SS_OK) {
    eliminate(&least, &most, &m, y->rows, y->cols);
    if (n->trials++ == 0 || least > n->largest) {
      n->where = point_text(j, p);
      if (n->at) point_copy(n->at, p);
      n->largest = least;
      n->largest_at = 0;
    }
    n->largest_at += least == n->largest;
  }
}

/* A larger rank than said is a certificate in balls; a smaller one may be that of exceptions, and one that is smaller
   at some of the points may be so on a whole region. */
static struct route_result add_count(struct finding *f, struct judge *j, const char *route, const struct count *n,
                                     int wanted, bool decisive) {
  enum route_outcome o = n->trials == 0 ? ROUTE_NOTHING
                         : n->largest == wanted
                             ? (decisive && n->largest_at < n->trials ? ROUTE_UNDECIDED : ROUTE_AGREES)
                         : n->largest > wanted ? ROUTE_DIFFERS
                         : decisive            ? ROUTE_UNDECIDED
                                               : ROUTE_DIFFERS;
  const char *note =
      result_str(j->out,
                 "at %ld of %ld periodic orbits the Jacobian of the equations with respect to the unknowns has a minor "
                 "of order %d that is not zero, and at none was one of larger order found",
                 n->largest_at, n->trials, n->largest);
  if (n->largest == 0)
    note =
        result_str(j->out,
                   "at none of %ld periodic orbits was an entry of the Jacobian of the equations with respect to the "
                   "unknowns found that is not zero",
                   n->trials);
  return finding_add_route(f, j->out, (struct route_result){route, o, decisive, n->trials}, layer_name[LAYER_CORRECTED],
                           FD_PREC, n->where, note);
}

/* By elimination that holds for all values of the symbols; else by one minor in balls and the number of equations.
   Equations that contradict each other amount to no number of equations.  *special: NULL, or that the points tried,
   which lie on motions, may be exceptions. */
static struct route_result prove_rank(const char **special, struct finding *f, struct judge *j, const struct claim *c,
                                      struct view view, const struct rank_system *y, const struct count *balls,
                                      int wanted) {
  struct exact_rank e = exact_rank_of(j->out, y);
  *special = e.rank < 0 && e.least > wanted ? e.note : NULL;
  if (e.rank >= 0)
    return exact_route(f, j->out, e.rank == wanted && !e.contradict ? ROUTE_AGREES : ROUTE_DIFFERS, e.note);
  struct generic_rank g = generic_rank_of(j, c, view, y);
  bool seen = balls->trials > 0 && balls->largest == wanted;
  return exact_route(f, j->out,
                     g.most < wanted                          ? ROUTE_DIFFERS
                     : seen && g.analytic && g.most == wanted ? ROUTE_AGREES
                                                              : ROUTE_NOTHING,
                     g.note);
}

/* The orbit at which the rank is the largest of those tried, and that rank beside what is said. */
static void certify(struct finding *f, struct judge *j, struct rank_system *y, const struct count *balls, int wanted) {
  certify_point(&f->certificate, j, balls->at, &y->s);
  certificate_add(&f->certificate, j->out, "left", result_str(j->out, "%d", wanted));
  certificate_add(&f->certificate, j->out, "right", result_str(j->out, "%d", balls->largest));
}

/* "z_1a depends on t_a": of the states in which phases meet one that the equations contain and is no unknown, or a
   root, of which the derivative by an unknown is then not zero as that of another symbol; NULL without one. */
static const char *hidden_unknown(struct judge *j, struct rank_system *y) {
  for (int k = 0; k < y->cols; k++) {
    const char *root = elaboration_root_of(&y->s.el, y->unknown[k]);
    if (root)
      return result_str(j->out, "the root %s depends on %s, and its derivative is not known", root, y->unknown[k]);
  }
  for (slong i = 0; i < y->s.tape.n_inputs; i++) {
    const char *name = y->s.tape.inputs[i];
    int state = name_of_arc(name), from = -1;
    bool unknown = state < 0 || state >= 100;
    for (int k = 0; k < y->cols; k++) unknown = unknown || strcmp(y->unknown[k], name) == 0;
    for (int k = 0; !unknown && from < 0 && k < y->cols; k++) {
      int of = name_of_arc(y->unknown[k]);
      if (of >= 0 && (of >= 100 ? of - 100 : of / N_STATE) < state / N_STATE) from = k;
    }
    if (from >= 0)
      return result_str(j->out, "%s depends on %s, and the equations do not say how", name, y->unknown[from]);
  }
  return NULL;
}

bool judge_rank(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  enum { ORBITS = 8, DRAWS = 100, DIFFERENCES = 4 };
  const char *said = claim_get(c, "rank");
  struct rank_system y;
  bool ok = rank_system_build(&y, j, c, view);
  if (ok && !said) ok = claim_error(j, c, "kind", "the attribute rank is missing");
  if (ok && (!*said || said[strspn(said, "0123456789")])) ok = claim_error(j, c, "rank", "a whole number");
  const char *hidden = ok ? hidden_unknown(j, &y) : NULL;
  if (hidden) {
    verdict_leave_open(f, j->out, hidden);
  } else if (ok) {
    struct sampler s;
    LOCAL(point, p, best);
    struct count balls = {.at = &best}, differences = {0};
    bool refute = j->effort == EFFORT_REFUTE;
    int wanted = (int)strtol(said, NULL, 10);
    sampler_init(&s, c->id, &(struct point_spec){.kind = POINT_ORBIT});
    for (int i = 0; i < DRAWS && balls.trials < ORBITS; i++) {
      sampler_next(&p, &s);
      if (refute && balls.trials && balls.largest >= wanted) break;
      if (!point_settle(&p, j->cache)) continue;
      count_at(&balls, j, &y, &p, num_ctx_arb(FD_PREC));
      if (!refute && differences.trials < DIFFERENCES) count_at(&differences, j, &y, &p, num_ctx_mpfr(FD_PREC));
    }
    struct route_result w[3];
    int n = 0;
    w[n++] = add_count(f, j, "balls", &balls, wanted, true);
    if (!refute) w[n++] = add_count(f, j, "fd", &differences, wanted, false);
    const char *special;
    struct route_result proof = prove_rank(&special, f, j, c, view, &y, &balls, wanted);
    f->verdict = verdict_with_proof(w, n, &proof);
    if (special && f->verdict == VERDICT_SUPPORTED) verdict_leave_open(f, j->out, special);
    if (f->verdict == VERDICT_REFUTED && balls.trials && balls.largest != wanted) certify(f, j, &y, &balls, wanted);
  }
  sentence_clear(&y.s);
  return ok;
}
