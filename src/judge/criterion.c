/* The stability criterion against what the return map does, and what the criterion says about the scene.

   The map is one-dimensional (r at the stick phase to r at the end of phase C), so that its fixed point is decided
   without any Jacobian: by the ratio |R(r_0 + d) - r_0|/|d| at a d so small that nothing else counts, and by
   iteration. */
#include <math.h>
#include <string.h>

#include "behaviour.h"
#include "certificate.h"
#include "judge.h"
#include "num/calc.h"
#include "proof/linearized.h"
#include "value/expression.h"
#include "value/solved.h"

enum { NEAR_BELOW, NEAR_ABOVE, N_NEAR };
enum { INSIDE, OUTSIDE, N_SIDES };

/* A second opinion of the sentence; against: how many orbits that are against it this tells something of. */
struct opinion {
  struct answers said;
  long against;
};

/* What is found at orbits; sides are those of the slope. */
struct tried {
  long as_said[N_SIDES], against;   /* the sentence against the slope, at admissible orbits */
  long beyond, unclear;             /* against it at others, of which it does not speak, or perhaps does not */
  long near[N_NEAR][N_SIDES];       /* orbits with a slope within 0.05 of -1, of 1 */
  struct opinion iterates, motions; /* the sentence against iterates, and motions beside admissible orbits */
  double nearest[N_NEAR][N_SIDES];  /* the slopes nearest to -1 and 1 */
  const char *where;
  struct certificate certificate; /* there */
};

/* (R(r_0 + 2^-100) - R(r_0))/2^-100 in MPFR. */
static int slope_by_difference(double *margin, double *slope, const struct point *p, const struct dyn_orbit *o) {
  enum { PREC = 384, STEP = -100 };
  OWNED(calc) c = calc_begin(num_ctx_mpfr(PREC));
  struct num_vec params = calc_vec(&c, N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++) c.status |= num_mpfr.set_q(num_vec_at(&params, i), &p->q[i], PREC);
  val step = calc_two_to(&c, STEP), r = orbit_passed(&c, &params, o, calc_d(&c, 0), o->guess);
  val quotient = calc_div(&c, calc_sub(&c, orbit_passed(&c, &params, o, step, o->guess), r), step);
  *slope = num_mpfr.get_d(quotient);
  *margin = num_mpfr.get_d(calc_sub(&c, calc_abs(&c, quotient), calc_d(&c, 1)));
  return c.status;
}

static void book(struct opinion *n, int fate, bool stable, bool against) {
  n->said.of[fate == 0 ? TRUTH_UNKNOWN : (fate > 0) == stable ? TRUTH_TRUE : TRUTH_FALSE]++;
  n->against += against && fate != 0;
}

static void note_near(struct tried *t, double slope, int side) {
  int near = slope < 0 ? NEAR_BELOW : NEAR_ABOVE;
  double off = fabs(fabs(slope) - 1);
  if (off < 0.05) t->near[near][side]++;
  if (!(t->nearest[near][side] != 0 && fabs(fabs(t->nearest[near][side]) - 1) <= off)) t->nearest[near][side] = slope;
}

static const double BESIDE = 1e-5; /* of r: how far beside the orbit iterates and motions begin */

/* The slope, and what iterates and motions do in so many steps, worked out once for all sentences. */
static void know_slope(struct orbit_slope *k, const struct point *p, const struct dyn_orbit *o) {
  if (!k->have_slope) k->status = slope_by_difference(&k->margin, &k->slope, p, o);
  k->have_slope = true;
}

static int iterates_of(struct orbit_slope *k, const struct point *p, const struct dyn_orbit *o, long steps) {
  if (!k->have_iterates) k->iterates = return_map_fate(p->q, orbit_r(o), BESIDE, steps);
  k->have_iterates = true;
  return k->iterates;
}

static int motion_of(struct orbit_slope *k, const struct point *p, const struct dyn_orbit *o, long steps) {
  if (k->have_motion) return k->motion;
  double distance = motion_distance(p, o, BESIDE, steps);
  k->motion = distance < 0.5 ? 1 : distance > 2 ? -1 : 0;
  k->have_motion = true;
  return k->motion;
}

/* What a claim tries: the sentence, orbits so far, the side on which it puts the orbits it speaks of, or N_SIDES. */
struct trying {
  struct tried t;
  struct sentence sentence;
  struct behaviour *b;
  struct orbit_walk walk;
  int only;
};

/* At the walk's point. */
static void try_orbit(struct trying *y, const struct dyn_orbit *o) {
  enum { MOTIONS = 6 };
  struct tried *t = &y->t;
  struct judge *j = y->b->j;
  const struct point *p = &y->walk.p;
  if (o->grazing) return;
  struct orbit_slope *k = orbit_cache_slope(j->cache, o);
  know_slope(k, p, o);
  double margin = k->margin, slope = k->slope;
  if (k->status != SS_OK || fabs(margin) < 1e-9) return;
  struct trial said = sentence_try_balls(&y->sentence, p, VARIANT_CLOSED, j->cache);
  if (said.outcome != OUTCOME_AGREES && said.outcome != OUTCOME_DIFFERS) return;
  bool stable = said.outcome == OUTCOME_AGREES;
  int side = margin < 0 ? INSIDE : OUTSIDE, premise = stable ? INSIDE : OUTSIDE;
  if (y->only != N_SIDES && y->only != premise) return;
  bool against = stable != (side == INSIDE), slow = fabs(margin) < 0.002; /* the iterates would need too long */
  if (o->admissible != TRUTH_TRUE) {
    *(o->admissible == TRUTH_FALSE ? &t->beyond : &t->unclear) += against;
    return;
  }
  note_near(t, slope, side);
  ++*(against ? &t->against : &t->as_said[side]);
  if (against && !t->where) {
    t->where = result_str(j->out, "slope %.6f at %s", slope, point_text(j, p));
    certify_params(&t->certificate, j, p->q + Q_CHI);
    certify_orbit(&t->certificate, j, o);
    certify_ball(&t->certificate, j, "trace", o->trace);
  }
  if (slow || j->effort == EFFORT_REFUTE) return;
  long steps = 8 + (long)(1.5 / fabs(margin));
  book(&t->iterates, iterates_of(k, p, o, steps), stable, against);
  if (fabs(margin) < 0.015) return;
  if (t->motions.said.of[TRUTH_TRUE] + t->motions.said.of[TRUTH_FALSE] < MOTIONS)
    book(&t->motions, motion_of(k, p, o, steps), stable, against);
}

/* What agrees elsewhere says nothing of orbits that it did not try; bad: how many are against the sentence. */
static struct route_result add_opinion(struct behaviour *b, const char *route, const struct opinion *n, long bad,
                                       const char *note) {
  struct route_result w = answers_route(route, false, &n->said);
  if (w.outcome == ROUTE_AGREES && bad && !n->against) w.outcome = ROUTE_UNDECIDED;
  return behaviour_route(b, w, NULL, note);
}

/* theorem: of the sentence, unless points have refuted it already.  What is outside does not have |tr J| = 1. */
static void conclude(struct behaviour *b, const struct tried *t, int only, const struct linearized *theorem) {
  bool proved = only == OUTSIDE ? theorem->apart : linearized_proves(theorem);
  struct route_result w[4];
  int n = 0;
  long good = t->as_said[INSIDE] + t->as_said[OUTSIDE], bad = t->against;
  struct text note = {0};
  text_printf(&note,
              "the slope of the one-dimensional return map at admissible orbits, by a difference quotient over 2^-100 "
              "in 384 bits, agrees "
              "with the criterion at %ld orbits with |slope| < 1 and %ld with |slope| > 1, and disagrees at %ld; "
              "within 0.05 of -1 or of 1 there are",
              t->as_said[INSIDE], t->as_said[OUTSIDE], bad);
  for (int near = 0; near < N_NEAR; near++)
    for (int side = 0; side < N_SIDES; side++) {
      text_printf(&note, "%s %ld %s %s", near + side ? "," : "", t->near[near][side],
                  side == INSIDE ? "inside" : "outside", near == NEAR_BELOW ? "-1" : "1");
      if (t->near[near][side]) text_printf(&note, " (nearest %.1e from it)", fabs(fabs(t->nearest[near][side]) - 1));
    }
  if (t->beyond)
    text_printf(&note, "; it disagrees at %ld that are not admissible, of which the claim says nothing", t->beyond);
  if (t->unclear) text_printf(&note, "; it disagrees at %ld of which that is not decided", t->unclear);
  w[n++] = behaviour_route(b, counted_route("fd", true, good, bad, t->beyond + t->unclear), t->where,
                           result_take(b->j->out, &note));
  if (b->j->effort != EFFORT_REFUTE) {
    const long *iterates = t->iterates.said.of, *motions = t->motions.said.of;
    w[n++] = add_opinion(b, "iteration", &t->iterates, bad,
                         result_str(b->j->out,
                                    "iterates of the return map from near the orbit return or depart as the "
                                    "criterion says at %ld orbit%s, otherwise at %ld, undecided at %ld",
                                    iterates[TRUTH_TRUE], plural_s(iterates[TRUTH_TRUE]), iterates[TRUTH_FALSE],
                                    iterates[TRUTH_UNKNOWN]));
    w[n++] = add_opinion(b, "integration", &t->motions, bad,
                         result_str(b->j->out,
                                    "motions under Coulomb's law from positions near admissible orbits agree with the "
                                    "criterion at %ld orbit%s and disagree at %ld",
                                    motions[TRUTH_TRUE], plural_s(motions[TRUTH_TRUE]), motions[TRUTH_FALSE]));
  }
  if (proved)
    w[n++] = exact_route(b->f, b->j->out, ROUTE_AGREES, theorem->note);
  else if (theorem->note && !theorem->takes_in[0])
    finding_state(b->f, b->j->out, "exact", layer_name[LAYER_CORRECTED], -1, -1, NULL, theorem->note);
  b->f->verdict = verdict_of(w, n, proved);
  if (b->f->verdict == VERDICT_REFUTED) b->f->certificate = t->certificate;
}

static bool read_side(int *only, struct judge *j, const struct claim *c) {
  const char *side = claim_get(c, "side");
  *only = !side ? N_SIDES : strcmp(side, "inside") == 0 ? INSIDE : OUTSIDE;
  return !side || *only == INSIDE || strcmp(side, "outside") == 0 ||
         claim_error(j, c, "side", "\"inside\" or \"outside\" the unit circle");
}

/* Every orbit at the parameter sets of the attribute "at", separated by semicolons. */
static bool try_given(struct trying *y) {
  struct point *p = &y->walk.p;
  for (const char *at = claim_get(y->b->c, "at"); at; at = strchr(at, ';')) {
    if (*at == ';') at++;
    if (!judge_params(p, y->b->j, y->b->c, at)) return false;
    const struct dyn_orbits *list = orbit_cache_get(y->b->j->cache, p->q, FD_PREC + 64);
    for (p->orbit = 0; p->orbit < list->n; p->orbit++)
      if (orbit_is_new(&y->walk.met, &list->orbit[p->orbit])) try_orbit(y, &list->orbit[p->orbit]);
  }
  return true;
}

/* And orbits that are drawn, every other one among those that the masses can follow. */
static bool try_orbits(struct trying *y) {
  enum { DRAWS = 128, FEW = 24 };
  bool refute = y->b->j->effort == EFFORT_REFUTE;
  const struct dyn_orbit *o;
  orbit_walk_begin(&y->walk, y->b, false, refute ? FEW : DRAWS);
  y->walk.in_turn = true;
  bool ok = try_given(y);
  while (ok && !(refute && y->t.where) && (o = orbit_walk_next(&y->walk)) != NULL) try_orbit(y, o);
  orbit_walk_clear(&y->walk);
  return ok;
}

bool judge_criterion(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct behaviour b = {f, j, c, view, NULL};
  struct trying y = {.b = &b};
  if (!read_side(&y.only, j, c)) return false;
  const struct statement_record *r = claim_record(view, c, "statement", claim_get(c, "statement"), j->d);
  OWNED(reread) in = {.stmt = NULL};
  if (r && j->instead) {
    r = reread_open(&in, r, j->instead, c->id, j->d);
    in.record.rank = RANK_USER; /* no stable form stands for it */
  }
  if (!r) return false;
  bool ok = sentence_from_relations(&y.sentence, view, r, NULL, 0, j->d) && try_orbits(&y), weak = false;
  for (slong i = 0; ok && i < y.sentence.n; i++)
    weak = weak || y.sentence.ops[i] == REL_LE || y.sentence.ops[i] == REL_GE;
  sentence_clear(&y.sentence);
  struct linearized theorem = {.apart = false};
  if (ok && !y.t.where && route_is_asked(j->scene, "exact")) theorem = linearized_stability(j, r, view);
  if (ok) conclude(&b, &y.t, y.only, &theorem);
  if (ok && theorem.takes_in[0] && y.only != OUTSIDE && f->verdict == VERDICT_SUPPORTED && j->effort == EFFORT_FULL)
    ok = equality_of_criterion(&b, &theorem);
  if (weak && y.only != OUTSIDE && f->verdict == VERDICT_SUPPORTED)
    verdict_leave_open(f, j->out, "not decided where the criterion's <= or >= is an equality");
  return ok && !j->d->set;
}

/* A sentence that says it. */
static const char *state_orbit(struct finding *f, struct judge *j, const struct dyn_orbits *list, slong i,
                               const char *which) {
  static const char *const said[] = {"unstable", "conditionally stable", "undecided"};
  const struct dyn_orbit *o = &list->orbit[i];
  truth is = orbit_admissible(NULL, j->scene, o);
  const char *stable = said[o->stable], *trace = ball_text(j, o->trace, 8);
  const char *admissible = is == TRUTH_TRUE    ? "admissible"
                           : is == TRUTH_FALSE ? "not admissible"
                                               : "not known to be admissible";
  finding_state(f, j->out, "balls", "model", FD_PREC, 1,
                result_str(j->out, "%s, with t_a = %s, t_b = %s, t_c = %s, t_d = %s", which, ball_text(j, o->t[0], 6),
                           ball_text(j, o->t[1], 6), ball_text(j, o->t[2], 6), ball_text(j, o->t[3], 6)),
                result_str(j->out, "tr J = %s, %s by the criterion; %s", trace, stable, admissible));
  return result_str(j->out, "%s is %s; with tr J = %s it is %s by the criterion", which, admissible, trace, stable);
}

/* What the criterion says about the scene, first of the orbit that the paper must mean; the paper draws no conclusion,
   so nothing is judged. */
bool judge_report(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  (void)c;
  const struct dyn_orbits *list = scene_orbits(j->scene, j->cache);
  LOCAL(point, p);
  slong nearest = j->scene->n_printed && nearest_orbit_point(&p, j->scene, j->cache) ? p.orbit : -1;
  const char *which = nearest >= 0 ? usual_orbit_text(j, "periodic solution") : NULL;
  if (which) f->letter = state_orbit(f, j, list, nearest, which);
  for (slong i = 0; i < list->n; i++)
    if (i != nearest) state_orbit(f, j, list, i, which ? "another periodic solution" : "a periodic solution");
  for (int layer = 0; printed_point(&p, j->scene) && layer <= LAYER_CORRECTED; layer++) {
    struct view v = {view.model, (enum layer)layer, NULL, view.control};
    NUMBERS(arb, tr);
    if (expression_number(tr, v, "tr(J)", "stability", &p, FIRST_PREC, j->cache, j->d) == SS_OK) {
      finding_state(f, j->out, "balls", layer_name[layer], FIRST_PREC, 1, NULL,
                    result_str(j->out, "with the printed numbers put in, the %s formulas give tr(J) = %s",
                               layer == LAYER_PRINTED ? "printed" : "corrected", ball_text(j, tr, 8)));
    }
  }
  f->verdict = VERDICT_DEFINITION;
  return !j->d->set;
}
