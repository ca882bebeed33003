/* The search for an orbit that refutes an argument, see argument.c. */
#include <limits.h>
#include <math.h>

#include "argument.h"
#include "value/orbit_pool.h"

enum { STRATA = 5 };

/* An orbit with the least margin of the conclusion there, for friction as argument_least_margin chooses it. */
struct candidate {
  struct pool_item item;
  bool drawn; /* of the pool, which owns it */
  slong index;
  double margin;
};

static void candidate_clear(struct candidate *c) {
  if (!c->drawn) pool_item_clear(&c->item);
}

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

double argument_least_margin(fmpq u_r[2], struct argument *a, const struct point *at, double belt, const double e[2]) {
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

/* The margin at one orbit of the draw, which p becomes, friction included. */
static double margin_at(struct point *p, struct argument *a, const struct pool_item *item, slong index) {
  const struct dyn_orbit *o = &item->list.orbit[index];
  const double e[2] = {num_arb.get_d(o->e1), num_arb.get_d(o->e2)};
  pool_point(p, item, index);
  for (int i = 0; i < 2; i++) fmpq_zero(&p->q[Q_US1 + i]);
  return argument_least_margin(p->q + Q_US1, a, p, fmpq_get_d(&item->q[DRAW_V]), e);
}

/* The worst of the orbits of one draw. */
static void weigh(struct candidate *c, struct argument *a) {
  LOCAL(point, p);
  c->index = 0;
  c->margin = INFINITY;
  for (slong i = 0; i < c->item.list.n; i++) {
    const struct dyn_orbit *o = &c->item.list.orbit[i];
    if (o->grazing || (a->admissible && o->admissible != TRUTH_TRUE)) continue;
    double margin = margin_at(&p, a, &c->item, i);
    a->tried += isfinite(margin);
    if (margin >= c->margin) continue;
    c->margin = margin;
    c->index = i;
  }
}

/* --- Going downhill --- */

/* Coordinate steps, halved when none helps, until the conclusion fails clearly. */
static void descend(struct candidate *best, struct argument *a) {
  enum { FINEST = 5, MOST = 80 };
  static const ulong unit[N_DRAW] = {32, 4, 4, 8, 8};
  FMPQ_VECTOR(q, N_DRAW);
  NUMBERS(fmpq, step);
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
        if (!dyn_in_domain(q, N_DRAW)) continue;
        struct candidate next = {.drawn = false};
        pool_item_init(&next.item, q);
        weigh(&next, a);
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
}

/* --- Deciding --- */

/* u_s_i = u_r_i - e_i > 0, or u_r_i > 0. */
static truth friction_allowed(const struct argument *a, const struct point *p, const struct dyn_orbit *o) {
  NUMBERS(arb, u);
  truth ok = TRUTH_TRUE;
  for (int i = 0; a->uses_friction && i < 2; i++) {
    arb_set_fmpq(u, &p->q[Q_US1 + i], FIRST_PREC);
    if (!a->free_friction) arb_sub(u, u, i ? o->e2 : o->e1, FIRST_PREC);
    ok = truth_and(ok, num_ball_positive(u));
  }
  return ok;
}

void argument_decide(struct argument_decision *d, struct answers decided[2], struct argument *a, const struct point *p,
                     const struct dyn_orbit *o) {
  struct orbit_cache *cache = a->j->cache;
  d->premises = p->kind == POINT_GIVEN ? friction_allowed(a, p, o) : TRUTH_TRUE;
  if (d->premises == TRUTH_TRUE) d->premises = conditions_hold(&a->part[PREMISES], p, cache);
  d->conclusion = d->by_exponentials = TRUTH_TRUE;
  for (int k = 0; d->premises == TRUTH_TRUE && k < a->part[CONCLUSION].n; k++) {
    struct condition *c = &a->part[CONCLUSION].at[k];
    bool failed = d->conclusion == TRUTH_FALSE; /* another one */
    double where;
    truth holds = condition_holds(&where, failed ? NULL : d->value, c, p, cache);
    if (holds == TRUTH_FALSE && !failed) {
      d->failed = k;
      d->where = where;
    }
    d->conclusion = truth_and(d->conclusion, holds);
    if (a->j->effort == EFFORT_REFUTE) { /* the second route decides nothing */
      d->by_exponentials = TRUTH_UNKNOWN;
      continue;
    }
    truth again = condition_holds_at(c, p, holds == TRUTH_FALSE ? where : -1, cache);
    d->by_exponentials = truth_and(d->by_exponentials, again);
  }
  if (!decided || d->premises != TRUTH_TRUE) return;
  decided[0].of[d->conclusion]++;
  decided[1].of[d->by_exponentials]++;
}

/* --- The search --- */

/* The quantities that matter besides the parameters and times of a candidate. */
static unsigned quantities_read(const struct argument *a) {
  return a->uses_friction ? 1U << Q_US1 | 1U << Q_US2 : 0;
}

static const char *scene_text(struct argument *a, const struct point *p) {
  struct text t = {0};
  const struct point_quantity *row;
  for (size_t i = 0; (row = point_certified(&i, p, quantities_read(a))) != NULL; i++) {
    text_printf(&t, "%s%s = ", i ? ", " : "", row->name);
    num_print_q(&t, &p->q[row->q]);
  }
  return result_take(a->j->out, &t);
}

static const char *certificate_text(struct argument *a, const struct point *p, const struct argument_decision *d) {
  const struct condition *c = &a->part[CONCLUSION].at[d->failed];
  const char *when = argument_moment(a, c, ", for instance ", d->where);
  OWNED(text) premises = {0};
  NUMBERS(arb, short_by);
  arb_abs(short_by, d->value);
  for (int i = 0; i < a->part[PREMISES].n; i++)
    text_printf(&premises, "%s%s", list_joint(i, a->part[PREMISES].n, " and "), a->part[PREMISES].at[i].text);
  if (premises.len) text_add(&premises, a->part[PREMISES].n == 1 ? " holds, but " : " hold, but ");
  return result_str(
      a->j->out,
      "for %s there is a solution of the switching and periodicity equations on which %s%s is violated%s, %s%s",
      scene_text(a, p), text_str(&premises), c->text, when, arb_is_zero(short_by) ? "its sides being equal" : "by ",
      arb_is_zero(short_by) ? "" : ball_text(a->j, short_by, 6));
}

void argument_certify(struct certificate *c, struct argument *a, const struct argument_decision *d) {
  const struct condition *failed = &a->part[CONCLUSION].at[d->failed];
  bool several = false; /* phases, of which it has to say which it is */
  for (int k = 0; k < a->part[CONCLUSION].n; k++) {
    const struct condition *other = &a->part[CONCLUSION].at[k];
    several = several || (other->moving && failed->moving && other->phase != failed->phase);
  }
  certificate_add(c, a->j->out, "fails", failed->text);
  if (several) certificate_add(c, a->j->out, "phase", phase_name[failed->phase]);
  if (failed->moving) certificate_add(c, a->j->out, "of the phase", result_str(a->j->out, "%.10g", d->where));
  certificate_add(c, a->j->out, "margin", ball_text(a->j, d->value, 6));
}

/* Decides at a candidate; true when it is a counterexample. */
static bool settle(struct argument_tally *t, struct argument *a, const struct candidate *c) {
  LOCAL(point, p);
  struct argument_decision d = {.where = 0};
  arb_init(d.value);
  margin_at(&p, a, &c->item, c->index);
  p.known = NULL; /* enclosed as narrowly as asked for */
  const struct dyn_orbit *o = &c->item.list.orbit[c->index];
  argument_decide(&d, t->decided, a, &p, o);
  bool counterexample = d.premises == TRUTH_TRUE && d.conclusion == TRUTH_FALSE;
  if (counterexample) {
    t->certificate = certificate_text(a, &p, &d);
    t->certified.n = 0;
    certify_drawn(&t->certified, a->j, &p, o, quantities_read(a));
    argument_certify(&t->certified, a, &d);
  }
  if (!t->nearest && d.premises == TRUTH_TRUE) t->nearest = scene_text(a, &p);
  arb_clear(d.value);
  return counterexample;
}

static int stratum(const fmpq *t_b) {
  int s = (int)(fmpq_get_d(t_b) / 2);
  return s < STRATA ? s : STRATA - 1;
}

/* The most promising orbit of the pool in each stretch of t_b, up to the first clear failure, or `most` orbits. */
static void best_of_pool(struct candidate best[STRATA], bool have[STRATA], struct argument *a, long most) {
  struct orbit_pool pool = orbit_pool_get(a->j);
  bool clear = false;
  for (size_t i = 0; i < pool.n && !clear && a->tried < most; i++) {
    struct candidate c = {.item = *pool.item[i], .drawn = true};
    weigh(&c, a);
    clear = c.margin < -0.02;
    int s = stratum(&c.item.q[DRAW_TB]);
    if (!isfinite(c.margin) || (have[s] && c.margin >= best[s].margin)) continue;
    have[s] = true;
    best[s] = c;
  }
}

void argument_search(struct argument_tally *t, struct argument *a, bool proved) {
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
