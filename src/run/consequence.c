/* What a failed formula does to what is derived from it.  The paper is read twice, corrected throughout and with only
   the failed equation as printed.  Each result of the claim files is put in full in both readings: the same program
   means that it cannot change; else both are evaluated in balls, on the scene's orbits and on orbits at random
   parameters. The claims that reach the corrected text are judged again with the printed one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "judge/judge.h"
#include "num/calc.h"
#include "proof/exact_proof.h"
#include "readings/study.h"
#include "run.h"

enum { RANDOM_ORBITS = 8, DRAWS = 64, MAX_SCENE_ORBITS = 8 };

/* One result in the two readings and in the all-printed one. */
enum { READ_OWN, READ_CORRECTED, READ_PRINTED, N_READ };
struct result {
  const struct claim *c;
  const char *formula;
  struct tape tape[N_READ];
  bool readable[N_READ];
  int rows, cols;
  struct text latex;
  struct derived out;
  long agrees, differs, undecided;
  double worst_log;
};

/* One failure. */
struct failure {
  struct judge *j;
  const struct claim *c;
  struct result *result;
  size_t n;
};

/* --- Reading the results --- */

static void read_result(struct result *r, int reading, struct elaboration *el) {
  struct matrix m;
  struct diag d = {0};
  r->readable[reading] = elaborate_tape(&r->tape[reading], &m, el, r->formula, r->formula, claim_section(r->c), &d);
  if (!r->readable[reading]) return;
  r->rows = m.rows;
  r->cols = m.cols;
}

static void read_results(struct failure *f) {
  const struct model *m = f->j->model;
  const struct view views[N_READ] = {
      {m, LAYER_CORRECTED, claim_own(f->c), NULL}, {m, LAYER_CORRECTED, NULL, NULL}, {m, LAYER_PRINTED, NULL, NULL}};
  for (size_t i = 0; i < f->n; i++) {
    struct result *r = &f->result[i];
    *r = (struct result){.c = &f->j->claims->result[i], .worst_log = -INFINITY};
    r->formula = claim_formula(&f->j->out->arena, m, r->c, "formula");
    expr_latex_of(&r->latex, r->formula);
  }
  for (int k = 0; k < N_READ; k++) {
    OWNED(elaboration) el;
    elaboration_init(&el, views[k], NULL, 0);
    for (size_t i = 0; i < f->n; i++) read_result(&f->result[i], k, &el);
  }
  for (size_t i = 0; i < f->n; i++) {
    struct result *r = &f->result[i];
    if (!r->readable[READ_OWN])
      r->out.change = CHANGE_UNDEFINED;
    else if (tape_same(&r->tape[READ_OWN], &r->tape[READ_CORRECTED]))
      r->out.change = CHANGE_SAME_FORMULA;
    else
      r->out.change = CHANGE_UNDECIDED;
  }
}

/* --- Trying them at points --- */

static struct trial try_result(struct result *r, struct values *v) {
  struct trial t = {.outcome = OUTCOME_REJECTED};
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec own = calc_vec(&c, r->rows * r->cols), corrected = calc_vec(&c, r->rows * r->cols);
  const char *unbound;
  int s = values_eval(&corrected, &unbound, v, &r->tape[READ_CORRECTED]);
  if (s == SS_OK) s = values_eval(&own, &unbound, v, &r->tape[READ_OWN]);
  if (s == SS_OK)
    t = balls_compare(&own, &corrected);
  else if (!(s & SS_DOMAIN))
    t.outcome = OUTCOME_UNDECIDED;
  return t;
}

/* The entry under the whole paper as printed. */
static const char *chain_value(const struct failure *f, const struct result *r, struct values *v, slong entry) {
  if (!r->readable[READ_PRINTED]) return "undefined";
  const char *unbound;
  struct num_vec x = calc_vec(&v->c, r->tape[READ_PRINTED].n_outputs);
  bool ok = x.len > entry && values_eval(&x, &unbound, v, &r->tape[READ_PRINTED]) == SS_OK;
  return ok ? ball_text(f->j, num_vec_at(&x, entry), 10) : "undefined";
}

/* The point, and the orbit there by its state and times, as its number is one of a list that nobody else has. */
static const char *place_text(const struct failure *f, const struct point *p, struct values *v) {
  struct text where = {0};
  point_print(&where, p);
  OWNED(calc) c = calc_begin(v->ctx);
  for (int i = 0; i < 2 + N_PHASES; i++) {
    const char *name = i < 2 ? name_state[0][i] : name_time[i - 2];
    bool known;
    void *x = calc_new(&c);
    if (values_bind(x, &known, v, name) == SS_OK) text_printf(&where, ", %s = %s", name, ball_text(f->j, x, 10));
  }
  return result_take(f->j->out, &where);
}

static void book_result(struct failure *f, struct result *r, const struct trial *t, const struct point *p,
                        struct values *v) {
  struct audit_result *out = f->j->out;
  r->agrees += t->outcome == OUTCOME_AGREES;
  r->undecided += t->outcome == OUTCOME_UNDECIDED;
  if (t->outcome != OUTCOME_DIFFERS) return;
  r->worst_log = fmax(r->worst_log, t->log_diff);
  if (r->differs++) return;
  const char *place = entry_place(out, r->rows * r->cols, r->cols, t->entry);
  r->out.entry = *place ? place : NULL;
  r->out.printed = result_copy(out, t->lhs);
  r->out.corrected = result_copy(out, t->rhs);
  r->out.where = place_text(f, p, v);
  if (!tape_same(&r->tape[READ_OWN], &r->tape[READ_PRINTED])) r->out.chain = chain_value(f, r, v, t->entry);
}

/* Every open result at one point; the precision rises for all while one of them is undecided.  false when the point is
   not accepted. */
static bool try_results(struct failure *f, const struct point *p) {
  for (slong prec = FIRST_PREC; prec <= LAST_PREC; prec *= 2) {
    OWNED(values) v;
    FREED struct trial *t = ss_malloc(f->n * sizeof *t);
    bool accepted = values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(prec), f->j->cache) == SS_OK, open = false;
    for (size_t i = 0; accepted && i < f->n; i++) {
      t[i].outcome = OUTCOME_REJECTED;
      if (f->result[i].out.change == CHANGE_UNDECIDED) t[i] = try_result(&f->result[i], &v);
      open = open || t[i].outcome == OUTCOME_UNDECIDED;
    }
    bool last = !open || prec == LAST_PREC;
    for (size_t i = 0; accepted && last && i < f->n; i++) book_result(f, &f->result[i], &t[i], p, &v);
    if (last && accepted) work_precision_raise(LADDER_RESULT, prec == FIRST_PREC && !open);
    if (last || !accepted) return accepted;
  }
  return false;
}

/* The scene's orbit nearest to the printed numbers, its others, and orbits at random parameters, the admissible ones:
   what nobody meets is no effect. */
static void try_everywhere(struct failure *f) {
  struct judge *j = f->j;
  LOCAL(point, p);
  struct sampler s;
  if (nearest_orbit_point(&p, j->scene, j->cache)) {
    const struct dyn_orbits *list = scene_orbits(j->scene, j->cache);
    slong nearest = p.orbit, n = list->n < MAX_SCENE_ORBITS ? list->n : MAX_SCENE_ORBITS;
    fmpq_one(&p.q[Q_LAMBDA]);
    for (slong k = -1; k < n; k++) {
      p.orbit = k < 0 ? nearest : k;
      if (k != nearest && list->orbit[p.orbit].admissible == TRUTH_TRUE) try_results(f, &p);
    }
  }
  sampler_init(&s, f->c->id, &(struct point_spec){.kind = POINT_ORBIT, .admissible = true});
  int done = 0;
  for (int i = 0; i < DRAWS && done < RANDOM_ORBITS; i++) {
    sampler_next(&p, &s);
    if (point_settle(&p, j->cache)) done += try_results(f, &p);
  }
}

/* --- Summing up --- */

static void conclude_result(struct failure *f, struct result *r) {
  struct audit_result *out = f->j->out;
  const struct model *m = f->j->model;
  struct derived *d = &r->out;
  long points = r->agrees + r->differs + r->undecided;
  d->formula = r->formula;
  d->title = result_copy(out, claim_get(r->c, "title"));
  d->latex = r->latex.len ? result_copy(out, text_str(&r->latex)) : NULL;
  if (r->differs) {
    d->change = CHANGE_CHANGES;
    d->verdict = result_str(out, "changes at %ld of %ld point%s", r->differs, points, points == 1 ? "" : "s");
    d->size = order_of_magnitude(out, r->worst_log);
  } else if (d->change == CHANGE_SAME_FORMULA) {
    d->verdict = "unchanged (same formula)";
  } else if (d->change == CHANGE_UNDEFINED) {
    d->verdict = "cannot be read with the printed form";
  } else if (points && r->agrees == points) {
    d->change = CHANGE_AGREES;
    d->proved = exact_unchanged((struct view){m, LAYER_CORRECTED, claim_own(f->c), NULL},
                                (struct view){m, LAYER_CORRECTED, NULL, NULL}, r->formula, claim_section(r->c));
    d->verdict = result_str(out, "%s at %ld point%s", d->proved ? "proved equal, and agrees" : "agrees", points,
                            points == 1 ? "" : "s");
  } else {
    d->verdict = "undecided";
  }
}

/* What judge_again said; two failures may be about one equation. */
struct said {
  const char *own;
  size_t claim;
  enum verdict verdict;
};
struct memory {
  struct said *said;
  size_t n, cap;
};

/* The claim judged with this equation as printed.  Routes that replace the paper's formulas by the model's say nothing
   here: balls that differ are enough. */
static enum verdict judge_again(struct judge *j, const struct claim *c, const char *own) {
  struct finding f = {.id = c->id, .verdict = VERDICT_UNKNOWN};
  struct diag d = {0};
  struct judge again = *j;
  again.d = &d;
  again.effort = EFFORT_DIFFERENCE;
  bool readable = claim_kind_of(c) && judge_subject(&f, &again, c, (struct view){j->model, LAYER_CORRECTED, own, NULL});
  bool differs = f.n_evidence && strcmp(f.evidence[0].route, "balls") == 0 && f.evidence[0].trials > 0 &&
                 strcmp(f.evidence[0].result, "differs") == 0;
  return !readable || differs ? VERDICT_REFUTED : f.verdict;
}

static enum verdict judge_again_once(struct memory *m, struct judge *j, size_t claim, const char *own) {
  for (size_t i = 0; i < m->n; i++)
    if (m->said[i].claim == claim && strcmp(m->said[i].own, own) == 0) return m->said[i].verdict;
  m->said = ss_grow(m->said, m->n, &m->cap, sizeof *m->said);
  m->said[m->n] = (struct said){own, claim, judge_again(j, &j->claims->claim[claim], own)};
  return m->said[m->n++].verdict;
}

/* The verdict of this run, or what it would be. */
static enum verdict judge_as_is(struct judge *j, const struct claim *c) {
  const struct finding *now = audit_result_finding(j->out, c->id);
  return now ? now->verdict : judge_again(j, c, claim_own(c));
}

/* Or nothing that another formula's failure would change: what a formula divides by is its own, and the solutions that
   are counted are those of the model, on which the formulas are tried. */
static bool asserts_nothing(const struct claim *c) {
  enum kind kind = claim_kind(c);
  return kind == KIND_DEFINITION || kind == KIND_REPORT || kind == KIND_DEFINED || kind == KIND_SOLUTIONS;
}

/* Is the claim conditional, and on something else than the one that failed? */
static bool has_own_condition(const struct audit_result *out, const char *id, const char *failed) {
  const struct finding *own = audit_result_finding(out, id), *other = audit_result_finding(out, failed);
  return own && own->condition && !(other && other->condition && strcmp(own->condition, other->condition) == 0);
}

/* What reaches a corrected formula is judged with the printed one; what rests on a notation keeps its own formula, and
   its verdict. */
static void judge_downstream(struct consequence *q, struct memory *m, struct failure *f, size_t at) {
  struct judge *j = f->j;
  const char *own = claim_own(f->c);
  for (size_t i = 0; i < j->claims->n; i++) {
    const struct claim *c = &j->claims->claim[i];
    bool touched = dependences_corrected(j->dependences, i, own);
    if (i == at || asserts_nothing(c) || !(touched || dependences_on(j->dependences, i, at))) continue;
    enum verdict v = touched ? judge_again_once(m, j, i, own) : judge_as_is(j, c);
    bool fails_anyway = !touched || verdict_fails(judge_as_is(j, c));
    bool as_before = fails_anyway && v == VERDICT_CONDITIONAL && has_own_condition(j->out, c->id, f->c->id);
    if (verdict_fails(v) && fails_anyway && !as_before) continue; /* for a reason of its own */
    bool holds = verdict_passes(v) || as_before;
    struct id_list *list = holds ? &q->survives : verdict_fails(v) ? &q->falls : &q->open;
    arena_list_add(&j->out->arena, &list->id, &list->n, result_copy(j->out, c->id));
  }
}

/* What becomes of the derived results, after what the judge said of the claim itself. */
static void describe_derived(struct finding *f, const struct consequence *q, struct audit_result *out) {
  const struct {
    enum change change;
    const char *words;
  } rows[] = {{CHANGE_CHANGES, q->solved ? "With the times of the true solution put in, these change: "
                                         : "Derived results that change: "},
              {CHANGE_AGREES, "Derived results that are unchanged at every point tried: "},
              {CHANGE_UNDEFINED, "Derived results that become meaningless: "},
              {CHANGE_UNDECIDED, "Derived results left undecided: "}};
  bool proved = true;
  for (int i = 0; i < q->n_derived; i++)
    proved = proved && (q->derived[i].change != CHANGE_AGREES || q->derived[i].proved);
  struct text t = {0};
  f->size = f->effect;
  if (f->effect) text_add(&t, f->effect);
  for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
    const char *words =
        rows[k].change == CHANGE_AGREES && proved ? "Derived results proved to be unchanged: " : rows[k].words;
    const char *sep = words;
    for (int i = 0; i < q->n_derived; i++) {
      const struct derived *d = &q->derived[i];
      if (d->change != rows[k].change) continue;
      if (t.len && sep == words) text_add(&t, t.data[t.len - 1] == '.' ? " " : ". ");
      text_printf(&t, "%s%s", sep, d->title);
      if (d->chain) text_printf(&t, " (%s with the whole paper as printed)", d->chain);
      sep = ", ";
    }
    if (*sep == ',') text_add_char(&t, '.');
  }
  if (t.len) f->effect = result_take(out, &t);
}

static void consequence_of(struct judge *j, struct memory *m, struct finding *finding, size_t at) {
  const struct claim *c = &j->claims->claim[at];
  struct audit_result *out = j->out;
  struct failure f = {.j = j, .c = c, .n = j->claims->n_results};
  f.result = ss_malloc(f.n * sizeof *f.result);
  read_results(&f);
  bool any = false;
  for (size_t i = 0; i < f.n; i++) any = any || f.result[i].out.change == CHANGE_UNDECIDED;
  if (any) try_everywhere(&f);
  struct consequence q = {.failure = finding->id, .derived = arena_alloc(&out->arena, f.n * sizeof *q.derived)};
  for (size_t i = 0; i < f.n; i++) {
    struct result *r = &f.result[i];
    conclude_result(&f, r);
    if (r->readable[READ_CORRECTED]) q.derived[q.n_derived++] = r->out;
    for (int k = 0; k < N_READ; k++) tape_clear(&r->tape[k]);
    text_clear(&r->latex);
  }
  free(f.result);
  judge_downstream(&q, m, &f, at);
  q.solved = j->model->system ? readings_as_printed(j, claim_own(c)) : NULL;
  if (q.solved) finding->effect = q.solved;
  describe_derived(finding, &q, out);
  *SS_PUSH(out->consequences, out->n_consequences, out->cap_consequences) = q;
}

size_t consequence_claim(const struct judge *j, const struct finding *f) {
  size_t k = verdict_fails(f->verdict) && f->correction && verdict_passes(f->correction_verdict) ? 0 : j->claims->n;
  while (k < j->claims->n && strcmp(j->claims->claim[k].id, f->id) != 0) k++;
  return k < j->claims->n && claim_get(&j->claims->claim[k], "number") ? j->claims->n : k;
}

bool judge_consequences(struct judge *j, const size_t *at, size_t n) {
  struct memory m = {.n = 0};
  for (size_t i = 0; i < n; i++) {
    struct finding *f = &j->out->findings[at[i]];
    consequence_of(j, &m, f, consequence_claim(j, f));
  }
  free(m.said);
  return !j->d->set;
}
