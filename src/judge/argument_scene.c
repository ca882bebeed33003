/* Arguments at one orbit, the scene's nearest to the printed numbers.

   Where u_r1 or u_r2 enters, the least u_s1 and u_s2 that the premises allow on a grid are tried, which can refute.
   For every u_s1 and u_s2 that they allow a condition is proved in one of two ways: its margin only grows with them,
   and is positive along the whole phase already where both are a little smaller than the premises allow; or it follows
   by exact algebra on every admissible orbit, of which this is one. */
#include <math.h>

#include "argument.h"
#include "certificate.h"
#include "proof/exact_argument.h"
#include "value/printed.h"
#include "value/title.h"

/* A little below what the premises ask of u_s1 and u_s2, on a grid; in double. */
static void choose_corner(struct point *corner, struct argument *a) {
  enum { GRID = 1024, BELOW = 4 };
  struct sampled p[MAX_CONDITIONS];
  double belt = fmpq_get_d(&corner->q[Q_V]);
  for (int i = 0; i < 2; i++) fmpq_zero(&corner->q[Q_US1 + i]);
  if (conditions_sample(p, &a->part[PREMISES], corner, a->j->cache) != SS_OK) return;
  for (int k = 0; k < a->part[PREMISES].n; k++)
    for (int i = 0; i < 2; i++) {
      double least = p[k].slope[i] > 0.01 ? floor(-p[k].least / p[k].slope[i] * belt * GRID) - BELOW : 0;
      if (least > 0 && least < 1e9 && least > fmpq_get_d(&corner->q[Q_US1 + i]) * GRID)
        fmpq_set_si(&corner->q[Q_US1 + i], (slong)least, GRID);
    }
}

/* Whether every u_si that the premises allow is greater than the corner's: some premise fails there, whose margin grows
   with u_si and depends on no other friction. */
static bool bounds_below(struct argument *a, const struct point *corner, int i) {
  bool found = fmpq_is_zero(&corner->q[Q_US1 + i]);
  for (int k = 0; k < a->part[PREMISES].n && !found; k++) {
    struct condition *c = &a->part[PREMISES].at[k];
    found = !c->equality && exact_friction_slope(c, i) == 1 && exact_friction_slope(c, 1 - i) == 0 &&
            condition_holds(NULL, NULL, c, corner, a->j->cache) == TRUTH_FALSE;
  }
  return found;
}

static bool holds_beyond(struct argument *a, struct condition *c, const struct point *corner) {
  return exact_friction_slope(c, 0) >= 0 && exact_friction_slope(c, 1) >= 0 &&
         condition_holds(NULL, NULL, c, corner, a->j->cache) == TRUTH_TRUE;
}

/* Every condition of the conclusion, whatever friction the premises allow. */
static bool prove_for_all(struct finding *f, struct argument *a, bool admissible) {
  LOCAL(point, corner);
  nearest_orbit_point(&corner, a->j->scene, a->j->cache);
  choose_corner(&corner, a);
  bool below = bounds_below(a, &corner, 0) && bounds_below(a, &corner, 1), all = true;
  long exact = 0;
  for (int k = 0; k < a->part[CONCLUSION].n && all; k++) {
    struct condition *c = &a->part[CONCLUSION].at[k];
    if (below && holds_beyond(a, c, &corner)) continue;
    all = admissible && exact_argument(c, &a->part[PREMISES]);
    exact++;
  }
  if (all) {
    long enclosed = a->part[CONCLUSION].n - exact;
    const char *which = exact == 0 ? enclosed == 1 ? "the inequality is" : "all inequalities are"
                                   : result_str(a->j->out, "%ld of the %d inequalities %s", enclosed,
                                                a->part[CONCLUSION].n, enclosed == 1 ? "is" : "are");
    const char *proof = result_str(
        a->j->out,
        "the premises imply u_s1 >= %s and u_s2 >= %s; for these values %s proved in interval arithmetic along the "
        "whole phase, with margins that do not decrease with u_s1 or u_s2",
        rational_text(a->j, &corner.q[Q_US1]), rational_text(a->j, &corner.q[Q_US2]), which);
    if (exact)
      proof = result_str(a->j->out,
                         "%s; the rest follows by exact algebra from the premises and Coulomb's law (2) on every "
                         "admissible orbit",
                         proof);
    exact_route(f, a->j->out, ROUTE_AGREES, proof);
  }
  return all;
}

/* margin: the least in double, which is finite where the premises hold and the sides have values. */
static const char *describe(struct argument *a, const struct argument_decision *d, const struct point *p,
                            double margin) {
  const struct condition *c = &a->part[CONCLUSION].at[d->failed];
  const char *unbound = argument_unbound(a);
  if (unbound) return unbound;
  if (d->premises == TRUTH_FALSE) return "the premises do not hold there";
  if (d->premises == TRUTH_UNKNOWN) return "it is not decided whether the premises hold there";
  const char *friction = NULL;
  if (a->uses_friction)
    friction = result_str(a->j->out, "for u_s1 = %s and u_s2 = %s, for which the premises hold",
                          rational_text(a->j, &p->q[Q_US1]), rational_text(a->j, &p->q[Q_US2]));
  if (d->conclusion == TRUTH_UNKNOWN && !friction)
    return isfinite(margin)
               ? "not decided: enclosures do not tell its sides apart everywhere, which may be equal or nearly so"
               : "not decided: a side has no value there, or not everywhere";
  if (d->conclusion != TRUTH_FALSE) return friction;
  NUMBERS(arb, apart);
  arb_abs(apart, d->value);
  const char *why = c->equality          ? result_str(a->j->out, "its sides differ by %s", ball_text(a->j, apart, 6))
                    : arb_is_zero(apart) ? "its sides are equal"
                                         : result_str(a->j->out, "its margin is %s", ball_text(a->j, d->value, 6));
  return result_str(a->j->out, "%s fails%s: %s%s%s", c->text, argument_moment(a, c, ", ", d->where), why,
                    friction ? ", " : "", friction ? friction : "");
}

/* Some condition of the conclusion is said for a phase that takes no time there, and says nothing. */
static bool says_nothing(const struct argument *a) {
  const struct dyn_orbit *o = scene_orbit(a->j->scene, a->j->cache);
  bool nothing = false;
  for (int k = 0; k < a->part[CONCLUSION].n; k++) {
    const struct condition *c = &a->part[CONCLUSION].at[k];
    nothing = nothing || (c->moving && arb_is_nonpositive(o->t[c->phase]));
  }
  return nothing;
}

/* The scene's data, its orbit, the friction tried, and what fails there. */
static void certify(struct finding *f, struct argument *a, const struct argument_decision *d, const struct point *p) {
  certify_scene(&f->certificate, a->j);
  certify_orbit(&f->certificate, a->j, scene_orbit(a->j->scene, a->j->cache));
  for (int i = 0; i < 2 && a->uses_friction; i++)
    certify_exact(&f->certificate, a->j, name_of_point[i], &p->q[Q_US1 + i]);
  argument_certify(&f->certificate, a, d);
}

static void judge_point(struct finding *f, struct argument *a, struct point *p) {
  struct argument_decision d = {.where = 0};
  struct route_result w[2];
  struct answers decided[2] = {{{0}}, {{0}}};
  const double e[2] = {0, 0}; /* so that the grid is one of u_s, whatever e_1 and e_2 are */
  arb_init(d.value);
  double margin = argument_least_margin(p->q + Q_US1, a, p, fmpq_get_d(&p->q[Q_V]), e);
  argument_decide(&d, decided, a, p, NULL);
  const char *where = result_str(a->j->out, "%s, along the whole phase", usual_orbit_text(a->j, "periodic solution"));
  argument_add_routes(w, f, a, decided, where, describe(a, &d, p, margin));
  bool nothing = says_nothing(a), all = !a->uses_friction && !nothing;
  if (a->uses_friction && !a->free_friction && d.premises == TRUTH_TRUE && d.conclusion == TRUTH_TRUE &&
      a->j->effort == EFFORT_FULL && !nothing)
    all = prove_for_all(f, a, scene_orbit(a->j->scene, a->j->cache)->admissible == TRUTH_TRUE);
  f->verdict = verdict_of(w, 2, all);
  if (f->verdict == VERDICT_REFUTED) certify(f, a, &d, p);
  if (!all && f->verdict == VERDICT_SUPPORTED)
    verdict_leave_open(f, a->j->out,
                       nothing ? "the phase for which it is said takes no time"
                               : "tried with one u_s1 and one u_s2 alone, of all that the premises allow");
  arb_clear(d.value);
}

void argument_at_scene(struct finding *f, struct argument *a) {
  LOCAL(point, p);
  if (nearest_orbit_point(&p, a->j->scene, a->j->cache))
    judge_point(f, a, &p);
  else
    finding_skip(f, a->j, "the scene has no orbit, or does not give e1 and e2");
}
