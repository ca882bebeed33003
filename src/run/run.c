/* The run: what is asked for becomes pieces, pieces become parts of the result.  First the claims and the studies,
   which need nothing of each other; then, since they speak of verdicts, the consequences of failures and the controls.
   Parts are put together in the order of the report, so that the result is the same whoever did them. */
#include "run.h"

#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "claim/kinds.h"
#include "judge/judge.h"
#include "readings/study.h"
#include "record/routes.h"
#include "route/studies.h"
#include "scene/fingerprint.h"
#include "tables.h"
#include "value/orbit_pool.h"

const char *const piece_what[] = {"claim", "consequence", "control", "study", "study", "study", "study", "study"};

/* --- What is selected --- */

/* Whether --only and the scene both ask for the claim. */
static bool run_selects(const struct audit_options *opt, const struct scene *s, const struct claim *c) {
  bool asked = s->asked.claims.n == 0 && (s->asked.values.n == 0 || opt->n_only > 0);
  for (size_t i = 0; i < s->asked.claims.n; i++) asked = asked || claim_asked_for(c, s->asked.claims.item[i]);
  return asked && claims_selects(opt->only, opt->n_only, c);
}

bool run_check_selection(const struct model *m, const struct claims *claims, const struct audit_options *opt,
                         const struct scene *s, struct diag *d) {
  if (!claims_check_selection(claims, opt->only, opt->n_only, d) || !scene_check_asked(s, claims, m, d)) return false;
  bool both = false;
  for (size_t k = 0; k < claims->n; k++) both = both || run_selects(opt, s, &claims->claim[k]);
  if (both || opt->n_only == 0 || s->asked.claims.n == 0) return true;
  return diag_set(d, "%s: error: --only names no claim that the scene asks for", s->path);
}

/* --- Pieces --- */

static struct piece *add_piece(struct pieces *p, enum piece_kind kind, const char *name) {
  p->item = ss_grow(p->item, p->n, &p->cap, sizeof *p->item);
  p->item[p->n] = (struct piece){.kind = kind, .name = name};
  return &p->item[p->n++];
}

void pieces_first(struct pieces *p, const struct model *m, const struct claims *claims, const struct scene *s,
                  const struct audit_options *opt) {
  bool readings = false;
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    if (!run_selects(opt, s, c)) continue;
    readings = readings || claim_kind(c) == KIND_NUMBER || claim_kind(c) == KIND_CLOSURE; /* about printed numbers */
    add_piece(p, PIECE_CLAIM, c->id)->claim = c;
  }
  if (run_is_whole(opt, s) && m->system) {
    add_piece(p, PIECE_LONG_RUNS, "long-runs");
    add_piece(p, PIECE_ROUTES, "routes");
    add_piece(p, PIECE_TABLES, "tables");
  }
  if (opt->readings && readings && m->system) add_piece(p, PIECE_READINGS, "readings");
  if (s->asked.values.n) add_piece(p, PIECE_VALUES, "values");
}

bool pieces_controls(struct pieces *p, const struct claims *claims, const struct claims *controls,
                     const struct scene *s, const struct audit_options *opt, struct diag *d) {
  for (size_t i = 0; i < controls->n; i++) {
    const struct claim *control = &controls->claim[i];
    const struct claim *claim = claim_named(claims, record_get(control->record, "claim"));
    if (!claim) return claim_mistake(control, "claim", d, "a control names the claim that it damages");
    if (!run_selects(opt, s, claim)) continue;
    struct piece *q = add_piece(p, PIECE_CONTROL, control->id);
    q->claim = claim;
    q->control = control;
  }
  return true;
}

bool claims_fail_together(const struct claim *a, const struct claim *b) {
  if (claim_get(a, "number") || claim_get(b, "number")) return a == b;
  return strcmp(claim_own(a), claim_own(b)) == 0;
}

/* Failures about one equation are a piece together, since claims are judged again with its text but once. */
static void pieces_consequences(struct pieces *p, const struct judge *j) {
  const struct audit_result *out = j->out;
  for (size_t i = 0; i < out->n_findings; i++) {
    size_t k = consequence_claim(j, &out->findings[i]);
    if (k == j->claims->n) continue;
    const struct claim *c = &j->claims->claim[k];
    struct piece *q = NULL;
    for (size_t g = 0; g < p->n; g++)
      if (claims_fail_together(p->item[g].claim, c)) q = &p->item[g];
    if (!q) {
      q = add_piece(p, PIECE_CONSEQUENCE, c->id);
      q->claim = c;
      q->at = ss_malloc(out->n_findings * sizeof *q->at);
    }
    q->at[q->n_at++] = i;
  }
}

void pieces_clear(struct pieces *p) {
  for (size_t i = 0; i < p->n; i++) free(p->item[i].at);
  free(p->item);
  *p = (struct pieces){.n = 0};
}

/* What the piece is expected to take, in milliseconds. */
static double piece_cost(const struct piece *p, const struct costs *costs) {
  enum { UNKNOWN_MS = 5 };
  const struct cost *c = cost_of(costs, piece_what[p->kind], p->name);
  return c ? c->ms : UNKNOWN_MS;
}

/* --- Doing them --- */

struct audit_work {
  const struct judge *base; /* its cache is that of this process, its result the whole one */
  const struct audit_options *opt;
  const struct pieces *pieces;
  unsigned touched;          /* by all pieces, */
  struct work_raises raises; /* and of them */
};

static bool do_consequence(struct judge *j, const struct piece *p, const struct audit_result *all) {
  struct audit_result *part = j->out;
  struct finding *copy = ss_malloc(all->n_findings * sizeof *copy);
  memcpy(copy, all->findings, all->n_findings * sizeof *copy);
  part->findings = copy;
  part->n_findings = all->n_findings;
  bool ok = judge_consequences(j, p->at, p->n_at);
  for (size_t i = 0; i < p->n_at; i++) copy[i] = copy[p->at[i]]; /* at[i] >= i */
  part->n_findings = p->n_at;
  return ok;
}

static bool do_control(struct judge *j, const struct piece *p, const struct audit_result *all) {
  struct audit_result *part = j->out;
  part->findings = all->findings;
  part->n_findings = all->n_findings;
  bool ok = judge_control(j, p->control, p->claim);
  part->findings = NULL;
  part->n_findings = 0;
  return ok;
}

/* What a study is about, where it says why there was nothing to do. */
static void note_why(struct audit_result *out, const char *what, const char *why) {
  if (why) audit_leave_out(out, what, why);
}

static bool do_piece(struct audit_result *part, size_t i, void *arg, struct diag *d) {
  struct audit_work *r = arg;
  const struct piece *p = &r->pieces->item[i];
  struct judge j = *r->base;
  bool ok = true;
  j.out = part;
  j.d = d;
  part->scene = r->base->out->scene;
  switch (p->kind) {
  case PIECE_CLAIM:
    ok = judge_claim(&j, p->claim);
    break;
  case PIECE_CONSEQUENCE:
    ok = do_consequence(&j, p, r->base->out);
    break;
  case PIECE_CONTROL:
    ok = do_control(&j, p, r->base->out);
    break;
  case PIECE_LONG_RUNS:
    study_long_runs(&j);
    break;
  case PIECE_ROUTES:
    ok = study_routes(&j);
    break;
  case PIECE_TABLES:
    note_why(part, "pictures of the orbit", study_tables(&j));
    break;
  case PIECE_READINGS:
    note_why(part, "readings of the printed numbers", audit_readings(part, j.model, j.scene));
    break;
  case PIECE_VALUES:
    ok = values_asked(&j);
    break;
  }
  if (r->opt->ended) r->opt->ended(r->opt->arg, piece_what[p->kind], p->name, work_units());
  return ok;
}

/* --- Putting the parts together --- */

/* A claim that ran out of its budget is undecided, and so is what a failure does; a control was not tried. */
static void note_exhausted(const struct audit_work *r, const struct piece *p) {
  struct judge j = *r->base;
  struct audit_result *out = j.out;
  struct diag d = {0};
  j.d = &d;
  const char *why = result_str(out, "the budget of %llu units of work ran out", j.scene->asked.budget);
  struct finding f;
  if (p->kind != PIECE_CLAIM) {
    audit_leave_out(out, result_str(out, "%s %s", piece_what[p->kind], p->name), why);
  } else if (finding_describe(&f, &j, p->claim)) {
    f.recorded = N_VERDICTS; /* the record knows of no budget */
    finding_state(&f, out, "none", layer_name[LAYER_CORRECTED], -1, 0, NULL,
                  result_str(out, "budget of %llu exhausted", j.scene->asked.budget));
    audit_finding(out, &f);
  }
}

/* The consequences have completed the findings that they are about. */
static void take_consequence(struct audit_result *out, const struct piece *p, const struct task_result *t) {
  struct audit_result part = t->part;
  for (size_t i = 0; i < part.n_findings; i++) out->findings[p->at[i]] = part.findings[i];
  part.n_findings = 0;
  result_append(out, &part);
}

static void take(const struct audit_work *r, const struct pieces *pieces, const struct task_result *t,
                 enum piece_kind from, enum piece_kind to) {
  for (size_t i = 0; i < pieces->n; i++) {
    const struct piece *p = &pieces->item[i];
    if (p->kind < from || p->kind > to) continue;
    if (t[i].end == TASK_EXHAUSTED)
      note_exhausted(r, p);
    else if (p->kind == PIECE_CONSEQUENCE)
      take_consequence(r->base->out, p, &t[i]);
    else
      result_append(r->base->out, &t[i].part);
  }
}

/* The total is that of the claims, studies and controls, which is known from the start: consequences, which are not,
   are counted as a part of the controls. */
struct teller {
  const struct audit_options *opt;
  size_t total, before, items, tasks; /* so many tasks stand for so many items */
  double from, weight;                /* of the whole cost: done before, and that of these tasks */
};

static void tell_share(void *arg, size_t done, double share) {
  const struct teller *t = arg;
  t->opt->progress(t->opt->arg, t->before + done * t->items / t->tasks, t->total, t->from + t->weight * share);
}

static double expected(const struct pieces *p, const struct costs *costs) {
  double ms = 0;
  for (size_t i = 0; i < p->n; i++) ms += piece_cost(&p->item[i], costs);
  return ms;
}

/* NULL with d set when one fails. */
static struct task_result *do_pieces(struct audit_work *r, const struct pieces *pieces, struct teller *teller,
                                     struct diag *d) {
  struct audit_result *out = r->base->out;
  FREED double *cost = ss_malloc(pieces->n * sizeof *cost);
  for (size_t i = 0; i < pieces->n; i++) cost[i] = piece_cost(&pieces->item[i], r->opt->costs);
  r->pieces = pieces;
  const struct tasks tasks = {.n = pieces->n,
                              .run = do_piece,
                              .arg = r,
                              .cost = cost,
                              .jobs = r->opt->jobs,
                              .budget = r->base->scene->asked.budget,
                              .seconds_now = r->opt->seconds_now,
                              .tell = r->opt->progress ? tell_share : NULL,
                              .teller = teller};
  struct task_result *t = tasks_run(out, &tasks);
  for (size_t i = 0; i < pieces->n; i++) {
    const struct piece *p = &pieces->item[i];
    r->touched |= t[i].touched;
    for (int k = 0; k < N_WORK_LADDERS; k++) {
      r->raises.tried[k] += t[i].raises.tried[k];
      r->raises.enough[k] += t[i].raises.enough[k];
    }
    *SS_PUSH(out->spent, out->n_spent, out->cap_spent) =
        (struct piece_spent){piece_what[p->kind], result_copy(out, p->name), t[i].units, 1e3 * t[i].seconds};
  }
  for (size_t i = 0; i < pieces->n; i++) {
    if (t[i].end != TASK_FAILED) continue;
    diag_again(d, t[i].error);
    free(t);
    return NULL;
  }
  return t;
}

/* Each process would draw the pool of orbits again; but with a budget no claim lives on what another has done. */
static void share_pool(const struct audit_work *r, const struct pieces *p) {
  struct judge j = *r->base;
  bool wanted = false;
  for (size_t i = 0; i < p->n && j.model->system; i++) {
    const struct claim_kind *kind = p->item[i].claim ? claim_kind_of(p->item[i].claim) : NULL;
    wanted = wanted || (kind && kind->parts & NEEDS_POOL);
  }
  if (wanted && r->opt->jobs > 1 && !j.scene->asked.budget) orbit_pool_get(&j);
}

/* What comes after the claims is expected to take what is known of controls, and a fifth of the rest for
   consequences. */
static bool run_pieces(struct audit_work *r, const struct pieces *first, const struct pieces *second, struct diag *d) {
  double all = expected(first, r->opt->costs), controls = expected(second, r->opt->costs);
  double share = all > 0 ? all / (1.2 * all + controls) : 1;
  share_pool(r, first);
  struct teller teller = {r->opt, first->n + second->n, 0, first->n, first->n, 0, share};
  FREED struct task_result *t = do_pieces(r, first, &teller, d), *u = NULL;
  if (t) {
    OWNED(pieces) both = {.n = 0};
    take(r, first, t, PIECE_CLAIM, PIECE_CLAIM);
    pieces_consequences(&both, r->base);
    for (size_t i = 0; i < second->n; i++)
      *add_piece(&both, PIECE_CONTROL, NULL) = second->item[i]; /* controls have no findings of their own to free */
    teller = (struct teller){r->opt, teller.total, first->n, second->n, both.n, share, 1 - share};
    u = do_pieces(r, &both, &teller, d);
    if (u) take(r, &both, u, PIECE_CONSEQUENCE, PIECE_CONTROL);
  }
  bool ok = u != NULL;
  if (ok) take(r, first, t, PIECE_LONG_RUNS, PIECE_VALUES);
  if (ok) readings_explain(r->base->out, r->base->claims);
  return ok;
}

static void add_raises(struct audit_result *out, const struct work_raises *r) {
  for (int k = 0; k < N_WORK_LADDERS; k++) {
    if (!r->tried[k]) continue;
    *SS_PUSH(out->precision, out->n_precision, out->cap_precision) =
        (struct precision_use){work_ladder_name[k], r->tried[k], r->enough[k]};
  }
}

/* What the claims see of a box of parameters: no parameters and no printed numbers, so that each says that it is about
   one set of them, or does with random points. */
static struct scene without_data(const struct scene *s) {
  struct scene bare = *s;
  for (int k = 0; k < N_KEYS; k++) bare.given[k] = false;
  bare.n_printed = 0;
  return bare;
}

static void name_subject(struct audit_result *out, const struct model *m, const struct scene *scene) {
  struct text subject = {0};
  audit_fingerprint(&subject, m, scene);
  out->subject = result_take(out, &subject);
  out->paper = result_copy(out, m->paper);
  out->model = result_copy(out, m->system);
  if (!m->system) out->data = NULL; /* which are of nothing that the paper speaks of */
  out->paper_text = result_copy(out, m->paper_text);
  if (m->paper_source) out->paper_source = result_str(out, "The text that was read is %s.", m->paper_source);
}

bool audit_run(struct audit_result *out, const struct model *m, const struct claims *claims,
               const struct claims *controls, const struct scene *scene, const struct audit_options *opt,
               struct diag *d) {
  if (!run_check_selection(m, claims, opt, scene, d)) return false;
  record_scene(out, scene);
  name_subject(out, m, scene);
  struct scene bare = without_data(scene);
  if (scene_is_box(scene)) scene = &bare;
  struct dependences *rests = dependences_new(m, claims);
  struct judge base = {.model = m,
                       .claims = claims,
                       .dependences = rests,
                       .scene = scene,
                       .cache = orbit_cache_new(),
                       .out = out,
                       .d = d};
  struct audit_work r = {.base = &base, .opt = opt};
  struct pieces first = {.n = 0}, second = {.n = 0};
  out->jobs = opt->jobs > 1 ? opt->jobs : 1;
  routes_describe(out);
  pieces_first(&first, m, claims, scene, opt);
  bool ok = pieces_controls(&second, claims, controls, scene, opt, d) && run_pieces(&r, &first, &second, d);
  ok = ok && roots_attach(out, m, claims, opt->statements, opt->roots, d);
  if (ok && opt->statements && run_is_whole(opt, scene)) table_of_statements(out, opt->statements);
  if (ok) add_raises(out, &r.raises);
  if (ok) skipped_describe(&base, controls, opt, &first, &second, r.touched);
  pieces_clear(&second);
  pieces_clear(&first);
  orbit_cache_free(base.cache);
  dependences_free(rests);
  return ok;
}
