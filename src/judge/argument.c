/* Arguments: does the conclusion follow from the premises?

   First an exact proof is looked for (proof/combination.h).  Then a counterexample: an orbit on which the premises hold
   and the conclusion fails, searched for in double over the pool of orbits and from the most promising of them by
   coordinate steps, with u_r1 and u_r2 as close to what the premises still allow as the grid of the search permits; it
   counts only when enclosures along the whole of each phase prove the premises and refute the conclusion at exact
   parameters. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "judge.h"
#include "proof/combination.h"
#include "proof/condition.h"
#include "value/orbit_pool.h"

enum { PREMISES, CONCLUSION, N_PARTS, STRATA = 5, MAX_TRIED = 12 };

struct argument {
  struct judge *j;
  const struct claim *c;
  struct conditions part[N_PARTS];
  bool admissible;    /* only orbits that break none of the model's conditions */
  bool free_friction; /* u_s1 and u_s2 need not be positive, so u_r1 and u_r2 are free */
  bool uses_friction;
  bool converse; /* the premises must follow from the conclusion too */
  long tried;    /* orbits on which the premises hold, as far as double precision tells */
};

/* A point with the least margin of the conclusion there. */
struct candidate {
  struct pool_item item;
  slong index;
  fmpq u_r[2];
  double margin;
};

/* --- One orbit in double --- */

/* The u_s/V closest to what the premises allow, in favour of the conclusion's failure. */
static void choose_friction(double x[2], const struct argument *a, const struct sampled *p, const struct sampled *q,
                            const double least[2]) {
  for (int i = 0; i < 2; i++) {
    double lo = least[i], hi = INFINITY, slope = 0;
    for (int k = 0; k < a->part[PREMISES].n; k++) {
      if (p[k].slope[i] > 0.01) lo = fmax(lo, -p[k].least / p[k].slope[i]);
      if (p[k].slope[i] < -0.01) hi = fmin(hi, -p[k].least / p[k].slope[i]);
    }
    for (int k = 0; k < a->part[CONCLUSION].n; k++) slope += q[k].slope[i];
    x[i] = slope >= 0 ? lo + 1 / 256. : isfinite(hi) ? hi - 1 / 256. : lo + 16;
  }
}

/* The least margin of the conclusion where the premises hold, else infinity, with u_r as close to what they allow as
   the grid permits. */
static double least_margin(fmpq u_r[2], struct argument *a, const struct point *at, double belt, const double e[2]) {
  enum { GRID = 1024 };
  struct sampled p[MAX_CONDITIONS], q[MAX_CONDITIONS];
  if (conditions_sample(p, &a->part[PREMISES], at, a->j->cache) != SS_OK ||
      conditions_sample(q, &a->part[CONCLUSION], at, a->j->cache) != SS_OK)
    return INFINITY;
  double x[2], least[2], margin = INFINITY;
  for (int i = 0; i < 2; i++) least[i] = a->free_friction ? -e[i] / belt : 0;
  choose_friction(x, a, p, q, least);
  for (int i = 0; i < 2; i++) {
    double k = ceil((x[i] * belt + e[i]) * GRID);
    if (!(fabs(k) < 1e15)) return INFINITY;
    fmpq_set_si(&u_r[i], (slong)k, GRID);
    x[i] = (k / GRID - e[i]) / belt;
  }
  for (int k = 0; k < a->part[PREMISES].n; k++) {
    double m = p[k].least + p[k].slope[0] * x[0] + p[k].slope[1] * x[1];
    if (!(m > (a->part[PREMISES].at[k].equality ? -1e-6 : 1e-9))) return INFINITY;
  }
  for (int k = 0; k < a->part[CONCLUSION].n; k++)
    margin = fmin(margin, q[k].least + q[k].slope[0] * x[0] + q[k].slope[1] * x[1]);
  return margin;
}

static void weigh(struct candidate *c, struct argument *a) {
  struct point at;
  const struct dyn_orbit *o = &c->item.list.orbit[c->index];
  c->margin = INFINITY;
  if (o->grazing || (a->admissible && o->admissible != TRUTH_TRUE)) return;
  point_init(&at);
  pool_point(&at, &c->item, c->index);
  const double e[2] = {num_arb.get_d(o->e1), num_arb.get_d(o->e2)};
  c->margin = least_margin(c->u_r, a, &at, fmpq_get_d(&c->item.q[DRAW_V]), e);
  a->tried += isfinite(c->margin);
  point_clear(&at);
}

static void candidate_init(struct candidate *c, const fmpq q[N_DRAW]) {
  pool_item_init(&c->item, q);
  c->index = 0;
  c->margin = INFINITY;
  for (int i = 0; i < 2; i++) fmpq_init(&c->u_r[i]);
}

static void candidate_clear(struct candidate *c) {
  pool_item_clear(&c->item);
  for (int i = 0; i < 2; i++) fmpq_clear(&c->u_r[i]);
}

/* The worst of the orbits of one draw. */
static void weigh_all(struct candidate *c, struct argument *a) {
  slong best = 0;
  double least = INFINITY;
  fmpq u_r[2];
  for (int i = 0; i < 2; i++) fmpq_init(&u_r[i]);
  for (c->index = 0; c->index < c->item.list.n; c->index++) {
    weigh(c, a);
    if (c->margin >= least) continue;
    least = c->margin;
    best = c->index;
    for (int i = 0; i < 2; i++) fmpq_set(&u_r[i], &c->u_r[i]);
  }
  c->index = best;
  c->margin = least;
  for (int i = 0; i < 2; i++) {
    fmpq_set(&c->u_r[i], &u_r[i]);
    fmpq_clear(&u_r[i]);
  }
}

/* --- Going downhill --- */

static bool in_domain(const fmpq q[N_DRAW]) {
  bool ok = fmpq_cmp_ui(&q[DRAW_CHI], 1) < 0;
  for (int i = 0; i < N_DRAW; i++) ok = ok && fmpq_sgn(&q[i]) > 0;
  return ok;
}

/* Coordinate steps, halved when none helps, until the conclusion fails clearly. */
static void descend(struct candidate *best, struct argument *a) {
  enum { FINEST = 5, MOST = 80 };
  static const ulong unit[N_DRAW] = {32, 4, 4, 8, 8};
  fmpq q[N_DRAW];
  fmpq_t step;
  fmpq_init(step);
  for (int i = 0; i < N_DRAW; i++) fmpq_init(&q[i]);
  int evaluations = 0;
  for (ulong level = 0; level < FINEST && best->margin > -1e-2 && evaluations < MOST; level++) {
    bool helped = true;
    while (helped && best->margin > -1e-2 && evaluations < MOST) {
      helped = false;
      for (int move = 0; move < 2 * N_DRAW && evaluations < MOST; move++) {
        int i = move / 2;
        if (i == DRAW_V) continue; /* a scale only */
        for (int k = 0; k < N_DRAW; k++) fmpq_set(&q[k], &best->item.q[k]);
        fmpq_set_si(step, move % 2 ? 1 : -1, unit[i] << level);
        fmpq_add(&q[i], &q[i], step);
        if (!in_domain(q)) continue;
        struct candidate next;
        candidate_init(&next, q);
        weigh_all(&next, a);
        evaluations++;
        bool better = next.margin < best->margin - 1e-6;
        if (better) {
          struct candidate old = *best;
          *best = next;
          next = old;
          helped = true;
        }
        candidate_clear(&next);
      }
    }
  }
  for (int i = 0; i < N_DRAW; i++) fmpq_clear(&q[i]);
  fmpq_clear(step);
}

/* --- Deciding --- */

static void candidate_point(struct point *p, const struct candidate *c) {
  pool_point(p, &c->item, c->index);
  p->known = NULL; /* enclosed as narrowly as asked for */
  for (int i = 0; i < 2; i++) fmpq_set(&p->q[Q_US1 + i], &c->u_r[i]);
}

struct decision {
  truth premises, conclusion, by_exponentials;
  int failed; /* the condition of the conclusion */
  double where;
  arb_t value;
};

/* u_s_i = u_r_i - e_i > 0, or u_r_i > 0. */
static truth friction_allowed(const struct argument *a, const struct point *p, const struct dyn_orbit *o) {
  arb_t u;
  arb_init(u);
  truth ok = TRUTH_TRUE;
  for (int i = 0; a->uses_friction && i < 2; i++) {
    arb_set_fmpq(u, &p->q[Q_US1 + i], FIRST_PREC);
    if (!a->free_friction) arb_sub(u, u, i ? o->e2 : o->e1, FIRST_PREC);
    ok = truth_and(ok, arb_is_positive(u) ? TRUTH_TRUE : arb_is_nonpositive(u) ? TRUTH_FALSE : TRUTH_UNKNOWN);
  }
  arb_clear(u);
  return ok;
}

static void decide(struct decision *d, struct argument *a, const struct point *p, const struct dyn_orbit *o) {
  struct orbit_cache *cache = a->j->cache;
  arb_t unused;
  arb_init(unused);
  d->premises = p->kind == POINT_GIVEN ? friction_allowed(a, p, o) : TRUTH_TRUE;
  for (int k = 0; d->premises == TRUTH_TRUE && k < a->part[PREMISES].n; k++) {
    double where;
    d->premises = condition_holds(&where, unused, &a->part[PREMISES].at[k], p, FIRST_PREC, cache);
  }
  d->conclusion = d->by_exponentials = TRUTH_TRUE;
  for (int k = 0; d->premises == TRUTH_TRUE && k < a->part[CONCLUSION].n; k++) {
    struct condition *c = &a->part[CONCLUSION].at[k];
    double where;
    arb_t value;
    arb_init(value);
    truth holds = condition_holds(&where, value, c, p, FIRST_PREC, cache);
    if (holds == TRUTH_FALSE && d->conclusion != TRUTH_FALSE) {
      d->failed = k;
      d->where = where;
      arb_set(d->value, value);
    }
    d->conclusion = truth_and(d->conclusion, holds);
    if (a->j->effort == EFFORT_REFUTE) { /* the second route decides nothing */
      d->by_exponentials = TRUTH_UNKNOWN;
      arb_clear(value);
      continue;
    }
    truth again = holds == TRUTH_FALSE ? condition_holds_at(c, p, VARIANT_EXPONENTIAL, where, FIRST_PREC, cache)
                                       : condition_holds_at_samples(c, p, FIRST_PREC, cache);
    d->by_exponentials = truth_and(d->by_exponentials, again);
    arb_clear(value);
  }
  arb_clear(unused);
}

/* --- The search --- */

struct tally {
  long decided[2][3]; /* balls, exponential: false, true, unknown */
  const char *certificate, *nearest;
};

static const char *rational_text(struct argument *a, const fmpq *q) {
  struct text t;
  text_init(&t);
  num_print_q(&t, q);
  return result_take(a->j->out, &t);
}

static const char *scene_text(struct argument *a, const struct point *p) {
  struct text t;
  text_init(&t);
  static const struct {
    const char *name;
    int q;
  } line[] = {{"chi", Q_CHI}, {"eta", Q_ETA},  {"V", Q_V},     {"t_b", Q_TB},
              {"t_c", Q_TC},  {"u_r1", Q_US1}, {"u_r2", Q_US2}};
  for (size_t i = 0; i < (a->uses_friction ? 7 : 5); i++) {
    text_printf(&t, "%s%s = ", i ? "; " : "", line[i].name);
    num_print_q(&t, &p->q[line[i].q]);
  }
  return result_take(a->j->out, &t);
}

static const char *certificate_text(struct argument *a, const struct point *p, const struct dyn_orbit *o,
                                    const struct decision *d) {
  const struct condition *c = &a->part[CONCLUSION].at[d->failed];
  const char *when = c->moving ? result_str(a->j->out, " at %.10g of phase %s", d->where, phase_name[c->phase]) : "";
  return result_str(a->j->out,
                    "on orbit %ld of the scene \"%s\" (one line each; e1 = %s, e2 = %s there) %s%s fails%s: "
                    "its margin is %s",
                    (long)p->orbit + 1, scene_text(a, p), ball_text(a->j, o->e1, 8), ball_text(a->j, o->e2, 8),
                    a->part[PREMISES].n ? "every premise holds and " : "", c->text, when, ball_text(a->j, d->value, 6));
}

/* Decides at a candidate; true when it is a counterexample. */
static bool settle(struct tally *t, struct argument *a, const struct candidate *c) {
  struct point p;
  struct decision d = {.where = 0};
  arb_init(d.value);
  point_init(&p);
  candidate_point(&p, c);
  const struct dyn_orbit *o = &c->item.list.orbit[c->index];
  decide(&d, a, &p, o);
  bool counterexample = d.premises == TRUTH_TRUE && d.conclusion == TRUTH_FALSE;
  if (d.premises == TRUTH_TRUE) {
    t->decided[0][d.conclusion]++;
    t->decided[1][d.by_exponentials]++;
  }
  if (counterexample) t->certificate = certificate_text(a, &p, o, &d);
  if (!t->nearest && d.premises == TRUTH_TRUE) t->nearest = scene_text(a, &p);
  point_clear(&p);
  arb_clear(d.value);
  return counterexample;
}

static int stratum(const fmpq *t_b) {
  int s = (int)(fmpq_get_d(t_b) / 2);
  return s < STRATA ? s : STRATA - 1;
}

/* The most promising orbit of the pool in each stretch of t_b, up to the first clear failure, or `most` orbits. */
static void best_of_pool(struct candidate best[STRATA], bool have[STRATA], struct argument *a, long most) {
  const struct orbit_pool *pool = orbit_pool_get(a->j);
  bool clear = false;
  for (size_t i = 0; i < pool->n && !clear && a->tried < most; i++) {
    struct candidate c = {.item = *pool->item[i]}; /* borrowed */
    for (int k = 0; k < 2; k++) fmpq_init(&c.u_r[k]);
    weigh_all(&c, a);
    clear = c.margin < -0.02;
    int s = stratum(&c.item.q[DRAW_TB]);
    if (isfinite(c.margin) && (!have[s] || c.margin < best[s].margin)) {
      if (have[s]) candidate_clear(&best[s]);
      have[s] = true;
      candidate_init(&best[s], c.item.q);
      best[s].index = c.index;
      best[s].margin = c.margin;
      for (int k = 0; k < 2; k++) fmpq_set(&best[s].u_r[k], &c.u_r[k]);
    }
    for (int k = 0; k < 2; k++) fmpq_clear(&c.u_r[k]);
  }
}

/* Where there is a proof already, the search only checks it, on few orbits; with little effort there are few too, and
   nothing goes downhill. */
static void search(struct tally *t, struct argument *a, bool proved) {
  enum { CHECK = 24, CHECK_REPEATED = 6 }; /* what is proved both ways is a repetition */
  bool few = proved || a->j->effort == EFFORT_REFUTE;
  struct candidate best[STRATA];
  bool have[STRATA] = {false}, found = false;
  best_of_pool(best, have, a, !few ? LONG_MAX : a->converse ? CHECK_REPEATED : CHECK);
  for (int s = 0; s < STRATA; s++) { /* those that fail already need no descent */
    if (!found && have[s] && best[s].margin < -1e-3) found = settle(t, a, &best[s]);
  }
  for (int s = 0; s < STRATA; s++) {
    if (found || !have[s]) continue;
    found = settle(t, a, &best[s]);
    if (few || found) continue;
    descend(&best[s], a);
    found = settle(t, a, &best[s]);
  }
  for (int s = 0; s < STRATA; s++)
    if (have[s]) candidate_clear(&best[s]);
}

/* --- Evidence --- */

static struct route_result add_route(struct finding *f, struct argument *a, const char *route, const long decided[3],
                                     bool decisive, const char *note) {
  struct route_result w = {route, outcome_of_counts(decided[TRUTH_TRUE], decided[TRUTH_FALSE], decided[TRUTH_UNKNOWN]),
                           decisive, decided[0] + decided[1] + decided[2]};
  finding_add_route(f, a->j->out, w, "corrected", FIRST_PREC, NULL, note);
  return w;
}

static bool add_proof(struct route_result *w, struct finding *f, struct argument *a, struct view view) {
  struct text t;
  text_init(&t);
  bool proved = certificate_find(&t, a->j, a->c, &a->part[PREMISES], &a->part[CONCLUSION], !a->free_friction, view);
  if (proved) {
    *w = (struct route_result){"algebra", ROUTE_AGREES, true, a->part[CONCLUSION].n};
    finding_add_route(f, a->j->out, *w, "corrected", -1, NULL, result_str(a->j->out, "%s", text_str(&t)));
  }
  text_clear(&t);
  return proved;
}

/* Proof and search in one direction; proof_alone: what is proved is not tried besides. */
static enum verdict judge_direction(struct finding *f, struct argument *a, struct view view, bool proof_alone) {
  struct route_result w[3];
  struct tally t = {.certificate = NULL};
  int n = 0;
  bool proved = add_proof(&w[0], f, a, view);
  n += proved;
  if (a->j->d->set || (proved && proof_alone)) return verdict_of(w, n, true);
  search(&t, a, proved);
  const char *note = t.certificate ? t.certificate
                                   : result_str(a->j->out,
                                                "no counterexample on %ld orbits of the search on which the premises "
                                                "hold; the nearest to one were decided",
                                                a->tried);
  w[n++] = add_route(f, a, "balls", t.decided[0], true, note);
  f->evidence[f->n_evidence - 1].worst = t.nearest;
  w[n++] = add_route(f, a, "exponential", t.decided[1], false, NULL);
  if (!t.decided[0][0] && !t.decided[0][1] && !t.decided[0][2] && proved) n = 1; /* nothing to try it on */
  return verdict_of(w, n, proved);
}

/* The argument turned round: what is an equation among the premises stays one. */
static struct argument converse_of(const struct argument *a) {
  struct argument b = *a;
  const struct conditions *p = &a->part[PREMISES], *q = &a->part[CONCLUSION];
  b.tried = 0;
  b.part[CONCLUSION].n = 0;
  b.part[PREMISES] = *q;
  for (int k = 0; k < p->n; k++) {
    struct conditions *to = &b.part[p->at[k].equality ? PREMISES : CONCLUSION];
    if (to->n < MAX_CONDITIONS) to->at[to->n++] = p->at[k];
  }
  return b;
}

/* Both directions, when the claim says so, are worth what the weaker one is. */
static void judge_everywhere(struct finding *f, struct argument *a, struct view view) {
  static const int weakness[N_VERDICTS] = {[VERDICT_SUPPORTED] = 1, [VERDICT_UNKNOWN] = 2, [VERDICT_REFUTED] = 3};
  bool little = a->j->effort == EFFORT_REFUTE;
  f->verdict = judge_direction(f, a, view, little);
  if (!a->converse || a->j->d->set) return;
  struct argument b = converse_of(a); /* its conditions are borrowed */
  enum verdict again = judge_direction(f, &b, view, true);
  if (weakness[again] > weakness[f->verdict]) f->verdict = again;
}

/* At the scene alone: the orbit nearest to the printed numbers.  Where u_r1 or u_r2 enters, the least that the premises
   allow is tried, and nothing is proved of others. */
static void judge_at_scene(struct finding *f, struct argument *a) {
  struct point p;
  struct decision d = {.where = 0};
  struct route_result w[2];
  long decided[2][3] = {{0}};
  point_init(&p);
  arb_init(d.value);
  if (!nearest_orbit_point(&p, a->j->scene, a->j->cache)) {
    finding_skip(f, a->j, "the scene has no orbit, or does not give e1 and e2");
  } else {
    const double e[2] = {0, 0}; /* so that the grid is one of u_s, whatever e_1 and e_2 are */
    least_margin(p.q + Q_US1, a, &p, fmpq_get_d(&p.q[Q_V]), e);
    decide(&d, a, &p, NULL);
    if (d.premises == TRUTH_TRUE) {
      decided[0][d.conclusion]++;
      decided[1][d.by_exponentials]++;
    }
    const struct condition *c = &a->part[CONCLUSION].at[d.failed];
    const char *note =
        a->uses_friction
            ? result_str(a->j->out, "with u_s1 = %s, u_s2 = %s, as small as the premises allow on a grid of 1/1024",
                         rational_text(a, &p.q[Q_US1]), rational_text(a, &p.q[Q_US2]))
            : NULL;
    if (d.premises != TRUTH_TRUE) note = "the premises do not hold there";
    if (d.premises == TRUTH_TRUE && d.conclusion == TRUTH_FALSE)
      note = result_str(a->j->out, "%s fails at %.10g of phase %s: its margin is %s", c->text, d.where,
                        phase_name[c->phase], ball_text(a->j, d.value, 6));
    w[0] = add_route(f, a, "balls", decided[0], true, note);
    f->evidence[f->n_evidence - 1].worst = "the orbit nearest to the printed numbers, enclosed along the whole phase";
    w[1] = add_route(f, a, "exponential", decided[1], false, NULL);
    f->verdict = verdict_of(w, 2, !a->uses_friction);
  }
  arb_clear(d.value);
  point_clear(&p);
}

/* What the friction forces must exceed on the scene's orbit, whatever the argument says. */
static void describe_effect(struct finding *f, struct argument *a) {
  struct point p;
  point_init(&p);
  if (nearest_orbit_point(&p, a->j->scene, a->j->cache)) {
    const struct dyn_orbit *o = &scene_orbits(a->j->scene, a->j->cache)->orbit[p.orbit];
    f->effect =
        result_str(a->j->out,
                   "On the scene's orbit nearest to the printed numbers all inequalities together ask u_r1 > %s and "
                   "u_r2 > %s, beside u_r1 > e_1 = %s and u_r2 > e_2 = %s.",
                   ball_text(a->j, o->u_r1_min, 6), ball_text(a->j, o->u_r2_min, 6), ball_text(a->j, o->e1, 6),
                   ball_text(a->j, o->e2, 6));
  }
  point_clear(&p);
}

/* Whether the conclusion of an argument over all orbits holds on those of the scene. */
static void describe_scene(struct finding *f, struct argument *a) {
  const struct dyn_orbits *list = scene_orbits(a->j->scene, a->j->cache);
  struct point p;
  struct text t;
  point_init(&p);
  text_init(&t);
  for (slong i = 0; i < list->n && nearest_orbit_point(&p, a->j->scene, a->j->cache); i++) {
    struct decision d = {.where = 0};
    arb_init(d.value);
    p.orbit = i;
    decide(&d, a, &p, NULL);
    text_printf(&t, "%sorbit %ld of the scene: %s", i ? "; " : "", (long)i + 1,
                d.conclusion == TRUTH_TRUE    ? "holds"
                : d.conclusion == TRUTH_FALSE ? result_str(a->j->out, "%s fails", a->part[CONCLUSION].at[d.failed].text)
                                              : "undecided");
    arb_clear(d.value);
  }
  if (t.len) f->effect = result_take(a->j->out, &t);
  point_clear(&p);
}

/* --- The kind --- */

static bool argument_read(struct argument *a, struct judge *j, const struct claim *c, struct view view) {
  *a = (struct argument){.j = j, .c = c};
  const char *friction = claim_get(c, "friction"), *over = claim_get(c, "over");
  a->admissible = !over || strcmp(over, "admissible") == 0;
  a->free_friction = friction && strcmp(friction, "free") == 0;
  if (over && !a->admissible && strcmp(over, "orbits") != 0 && strcmp(over, "scene") != 0)
    return claim_error(j, c, "over", "one of admissible, orbits, scene");
  const char *converse = claim_get(c, "converse");
  a->converse = converse && strcmp(converse, "yes") == 0;
  if (converse && !a->converse) return claim_error(j, c, "converse", "yes, or nothing");
  if (friction && !a->free_friction) return claim_error(j, c, "friction", "free, or nothing");
  if (!conditions_read(&a->part[PREMISES], j, c, "premises", view)) return false;
  if (!conditions_read(&a->part[CONCLUSION], j, c, "conclusion", view)) return false;
  if (a->part[CONCLUSION].n == 0) return claim_error(j, c, "kind", "the attribute conclusion is missing");
  for (int part = 0; part < N_PARTS; part++)
    for (int k = 0; k < a->part[part].n; k++)
      a->uses_friction = a->uses_friction || a->part[part].at[k].friction[0] || a->part[part].at[k].friction[1];
  return true;
}

/* The argument with the premises of the attribute repair added. */
static bool judge_repair(struct finding *f, struct argument *a, struct view view) {
  const char *repair = claim_get(a->c, "repair");
  if (!repair) return true;
  struct conditions more = {.n = 0};
  bool ok = conditions_read(&more, a->j, a->c, "repair", view);
  if (ok && a->part[PREMISES].n + more.n > MAX_CONDITIONS)
    ok = claim_error(a->j, a->c, "repair", "too many conditions");
  for (int k = 0; ok && k < more.n; k++) a->part[PREMISES].at[a->part[PREMISES].n++] = more.at[k];
  struct finding again = *f;
  again.evidence = NULL;
  again.n_evidence = 0;
  a->tried = 0;
  if (ok) judge_everywhere(&again, a, view);
  struct text t;
  text_init(&t);
  for (int k = 0; ok && k < more.n; k++) {
    text_add(&t, k ? "; " : "besides the cited premises: ");
    if (more.at[k].equation) text_printf(&t, "(%s) ", more.at[k].equation);
    text_add(&t, more.at[k].text);
  }
  if (ok) {
    f->correction = result_str(a->j->out, "%s", text_str(&t));
    f->correction_verdict = again.verdict;
  }
  for (int i = 0; ok && i < again.n_evidence; i++) *finding_add(f, a->j->out) = again.evidence[i];
  text_clear(&t);
  if (!ok) conditions_clear(&more); /* else they belong to the premises */
  return ok;
}

bool judge_argument(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct argument a;
  const char *over = claim_get(c, "over");
  bool ok = argument_read(&a, j, c, view);
  if (ok && over && strcmp(over, "scene") == 0)
    judge_at_scene(f, &a);
  else if (ok)
    judge_everywhere(f, &a, view);
  ok = ok && !j->d->set;
  if (ok && f->verdict == VERDICT_REFUTED && !view.control && j->effort == EFFORT_FULL) {
    if (a.uses_friction)
      describe_effect(f, &a);
    else
      describe_scene(f, &a);
  }
  if (ok && (f->verdict == VERDICT_REFUTED || j->effort == EFFORT_REFUTE) && !view.control)
    ok = judge_repair(f, &a, view);
  for (int part = 0; part < N_PARTS; part++) conditions_clear(&a.part[part]);
  return ok;
}
