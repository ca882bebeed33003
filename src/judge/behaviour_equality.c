/* "Otherwise, the periodic solution is unstable", where |tr J| = 1: along a family of orbits the slope of the return
   map passes -1, and there the third order decides what linearization leaves open. */
#include <math.h>
#include <string.h>

#include "behaviour.h"
#include "certificate.h"
#include "judge.h"
#include "proof/linearized.h"

/* At a flip R(r_0 + s) = r_0 + c_1 s + c_2 s^2 + c_3 s^3 + ... with c_1 = -1, and R(R(r_0 + s)) = r_0 + s - 2 (c_2^2 +
   c_3) s^3 + ...: stable when c_2^2 + c_3 > 0, unstable when it is < 0.  It is proved when the slope passes -1 inside
   the bracket and the sum is enclosed over the whole of it. */
static double flip_r(const struct dyn_bifurcation *q) {
  return orbit_r(&q->beside[0].orbit[0]);
}

static bool flip_is_admissible(const struct dyn_bifurcation *q) {
  return q->what == CHANGE_FLIP && q->beside[0].n > 0 && q->beside[0].orbit[0].admissible == TRUTH_TRUE;
}

/* The orbit at the middle of the bracket, an exact rational that p receives; NULL unless it is admissible. */
static const struct dyn_orbit *middle_orbit(struct point *p, const struct dyn_bifurcation *q, const struct family *f,
                                            struct behaviour *b) {
  for (int i = 0; i < N_PARAMS; i++) fmpq_set(&p->q[i], &f->base.q[i]);
  fmpq_add(&p->q[f->vary], &q->low, &q->high);
  fmpq_div_2exp(&p->q[f->vary], &p->q[f->vary], 1);
  const struct dyn_orbits *list = orbit_cache_get(b->j->cache, p->q, FD_PREC + 64);
  double r = flip_r(q);
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].admissible == TRUTH_TRUE && fabs(orbit_r(&list->orbit[i]) - r) < 1e-9 * fabs(r))
      return &list->orbit[i];
  return NULL;
}

static bool read_varied(struct family *f, struct behaviour *b, const char *vary) {
  char name[8] = "", low[32] = "", high[32] = "";
  struct diag d = {0};
  bool ok = sscanf(vary, " %7s from %31s to %31[^; ]", name, low, high) == 3 &&
            scene_constant(f->from, low, strlen(low), "vary", &d) &&
            scene_constant(f->to, high, strlen(high), "vary", &d);
  f->vary = word_find(name, scene_key_name, N_PARAMS);
  ok = ok && f->vary < N_PARAMS && fmpq_sgn(f->from) > 0 && fmpq_sgn(f->to) > 0 && !fmpq_equal(f->from, f->to);
  if (ok && f->vary == P_CHI) ok = fmpq_cmp_si(f->from, 1) < 0 && fmpq_cmp_si(f->to, 1) < 0;
  return ok || claim_error(b->j, b->c, "vary", "a parameter and two values in its domain, as in \"e2 from 3/4 to 1\"");
}

bool family_open(struct family *f, struct behaviour *b, const char *at, const char *vary) {
  point_init(&f->base);
  fmpq_init(f->from);
  fmpq_init(f->to);
  return judge_params(&f->base, b->j, b->c, at) && read_varied(f, b, vary);
}

void family_clear(struct family *f) {
  fmpq_clear(f->to);
  fmpq_clear(f->from);
  point_clear(&f->base);
}

void family_bifurcations(struct dyn_bifurcations *list, const struct family *f) {
  enum { DIGITS = 18, STARTS = 3 };
  const struct dyn_line line = {.params = f->base.q, .vary = f->vary, .from = f->from, .to = f->to};
  dyn_bifurcations_find(list, &line, DIGITS, STARTS);
}

/* What is found along all families: is it as the sentence says by the third order, by iterates at the value, by motions
   under Coulomb's law? */
struct found {
  bool said; /* whether the sentence says that it is stable */
  struct answers third, iterates, motions;
  long without;                    /* families in which none is found, which leave the third open */
  const char *where, *third_there; /* of the first that is otherwise; NULL without one */
};

static void book(struct answers *a, const struct found *t, bool stable, bool unstable) {
  a->of[!stable && !unstable ? TRUTH_UNKNOWN : stable == t->said ? TRUTH_TRUE : TRUTH_FALSE]++;
}

/* Iterates approach or leave like 1/sqrt(n), so many steps are allowed; from 3% of r_0 on either side. */
static void iterate(struct found *t, const struct dyn_bifurcation *q, const struct point *at) {
  enum { STEPS = 100000 };
  for (int side = -1; side <= 1; side += 2) {
    int fate = return_map_fate(at->q, flip_r(q), side * 0.03, STEPS);
    book(&t->iterates, t, fate > 0, fate < 0);
  }
}

/* 200 returns of the motion from x_2 moved by 1% of r_0: nearer than it began, or farther?  The change is small, the
   error of the integration 1e-9. */
static void move(struct found *t, const struct point *at, const struct dyn_orbit *o) {
  double ratio = motion_distance(at, o, 0.01, 200);
  book(&t->motions, t, ratio < 1 - 1e-4, 1 + 1e-4 < ratio);
}

/* The first orbit at tr J = -1 that is otherwise than said: the middle of its bracket, the orbit there, and
   c_2^2 + c_3. */
static void certify(struct behaviour *b, const struct point *at, int vary, const struct dyn_orbit *o,
                    const struct dyn_bifurcation *q) {
  struct certificate *c = &b->f->certificate;
  certify_member(c, b->j, at->q, vary, &at->q[vary], q->prec);
  certify_orbit(c, b->j, o);
  certificate_add(c, b->j->out, "trace", "-1");
  certificate_add(c, b->j->out, "c_2^2 + c_3", ball_text(b->j, q->third, 6));
}

static void add_flip(struct found *t, struct behaviour *b, const struct family *f, const struct dyn_bifurcation *q) {
  LOCAL(point, at);
  struct text where = {0};
  NUMBERS(arb, value);
  const struct dyn_orbit *o = middle_orbit(&at, q, f, b);
  bool decided = q->crosses && q->word == TRUTH_TRUE && o, stable = decided && arb_is_positive(q->third);
  bool unstable = decided && arb_is_negative(q->third);
  for (int i = 0; i < N_PARAMS; i++) {
    text_printf(&where, "%s%s = ", i ? ", " : "", scene_key_name[i]);
    if (i == f->vary) {
      arb_set_fmpq(value, &at.q[i], q->prec);
      text_add(&where, ball_text(b->j, value, 15));
    } else {
      num_print_q(&where, &f->base.q[i]);
    }
  }
  const char *place = result_take(b->j->out, &where);
  book(&t->third, t, stable, unstable);
  bool against = t->said ? unstable : stable;
  if (against && !t->where) {
    t->where = place;
    t->third_there = ball_text(b->j, q->third, 6);
  }
  finding_state(b->f, b->j->out, "balls", "model", q->prec, 1, place,
                result_str(b->j->out,
                           "tr J passes through -1 there, in an interval whose ends agree to %ld digits%s, and on the "
                           "whole of it c_2^2 + c_3 = %s: the orbit with |tr J| = 1 is %s; it is %s",
                           (long)q->digits, q->crosses ? " (proved in interval arithmetic)" : " (not proved)",
                           ball_text(b->j, q->third, 6),
                           stable     ? "stable"
                           : unstable ? "unstable"
                                      : "not decided",
                           o ? "admissible" : "not known to be admissible"));
  if (against && b->f->certificate.n == 0) certify(b, &at, f->vary, o, q);
  if (o) iterate(t, q, &at);
  if (o) move(t, &at, o);
}

/* Every admissible orbit of the family at which the slope is -1. */
static void find_flips(struct found *t, struct behaviour *b, const struct family *f) {
  OWNED(dyn_bifurcations) list;
  long n = 0;
  family_bifurcations(&list, f);
  for (slong i = 0; i < list.n; i++) {
    if (!flip_is_admissible(&list.at[i])) continue;
    add_flip(t, b, f, &list.at[i]);
    n++;
  }
  if (n == 0) t->third.of[TRUTH_UNKNOWN]++;
  t->without += n == 0;
}

static bool try_family(struct found *t, struct behaviour *b, const char *params, const char *vary) {
  OWNED(family) f;
  bool ok = family_open(&f, b, params, vary);
  if (ok) find_flips(t, b, &f);
  return ok;
}

/* One orbit on the boundary that is otherwise refutes; no number of others proves.  Where J has a value and |tr(J)| is
   not 1 the theorem of linearized stability decides. */
static void conclude(struct behaviour *b, const struct found *t, const struct linearized *theorem) {
  struct route_result w[3];
  const long *third = t->third.of, *iterates = t->iterates.of, *motions = t->motions.of;
  long found = answers_given(&t->third) - t->without, against = third[TRUTH_FALSE];
  truth returns = t->said ? TRUTH_TRUE : TRUTH_FALSE, departs = t->said ? TRUTH_FALSE : TRUTH_TRUE;
  w[0] = behaviour_route(
      b, answers_route("balls", true, &t->third), t->where,
      result_str(b->j->out,
                 "for tr J = -1 the return map of r = z_2 - z_1, R(r_0 + s) = r_0 - s + c_2 s^2 + c_3 s^3 + ..., "
                 "satisfies R(R(r_0 + s)) = r_0 + s - 2 (c_2^2 + c_3) s^3 + ..., so that the solution is %s 0. Of the "
                 "%ld solutions found with tr J = -1, %ld satisf%s this%s%s%s%s",
                 t->said ? "unstable if c_2^2 + c_3 <" : "conditionally stable if c_2^2 + c_3 >", found, against,
                 against == 1 ? "ies" : "y",
                 against == 1 ? ", namely that for "
                 : against    ? ", for example that for "
                              : "",
                 against ? t->where : "", against ? ", where c_2^2 + c_3 = " : "", against ? t->third_there : ""));
  w[1] = behaviour_route(
      b, answers_route("iteration", false, &t->iterates), NULL,
      result_str(b->j->out,
                 "iterations of the return map in double precision there, from a distance of 3%% of r_0 on either "
                 "side: %ld return to half that distance, %ld depart to twice that distance",
                 iterates[returns], iterates[departs]));
  w[2] = behaviour_route(b, answers_route("integration", false, &t->motions), NULL,
                         result_str(b->j->out,
                                    "motions under Coulomb's law with x_2 displaced by 1%% of r_0, over 200 returns: "
                                    "the number of those that approach the solution is %ld, of those that depart %ld",
                                    motions[returns], motions[departs]));
  b->f->verdict = verdict_of(w, 3, false);
  if (b->f->verdict != VERDICT_REFUTED) return;
  if (theorem->apart) {
    struct route_result proof = exact_route(b->f, b->j->out, ROUTE_AGREES, theorem->note);
    b->f->condition = "J has a value and |tr(J)| is not 1";
    b->f->verdict = verdict_under_condition(b->f->verdict, verdict_of(&proof, 1, true));
  }
  b->f->effect = "only the case |tr J| = 1, which linearization does not decide, is affected";
}

/* "at" and "vary" hold one entry for each family, separated by semicolons. */
static bool try_families(struct found *t, struct behaviour *b) {
  const char *params = claim_get(b->c, "at"), *vary = claim_get(b->c, "vary");
  bool ok = params && vary;
  if (!ok) return claim_error(b->j, b->c, "at", "a family needs its parameters (at) and the one that is varied (vary)");
  while (ok && params && vary) {
    ok = try_family(t, b, params, vary);
    params = strchr(params, ';');
    vary = strchr(vary, ';');
    if (!params != !vary) return claim_error(b->j, b->c, "vary", "as many entries as in \"at\" are needed");
    if (params) params++;
    if (vary) vary++;
  }
  return ok;
}

bool equality_of_criterion(struct behaviour *b, const struct linearized *theorem) {
  struct behaviour beside = *b;
  struct found t = {.said = true};
  const char *criterion = claim_get(b->c, "statement");
  beside.c = NULL;
  for (size_t i = 0; i < b->j->claims->n && !beside.c; i++) {
    const struct claim *c = &b->j->claims->claim[i];
    bool rests = claim_says(c, "check", "equality") && claim_says(c, "criterion", criterion);
    if (rests) beside.c = c;
  }
  if (!beside.c) return true;
  bool ok = try_families(&t, &beside);
  if (ok) conclude(&beside, &t, theorem);
  return ok;
}

/* What the criterion leaves out is said to be unstable. */
bool behaviour_equality(struct behaviour *b) {
  struct found t = {.said = false};
  const char *id = claim_get(b->c, "criterion");
  const struct statement_record *criterion = id ? claim_record(b->view, b->c, "criterion", id, b->j->d) : NULL;
  if (!criterion) return claim_error(b->j, b->c, "criterion", "the record of the criterion belongs here");
  struct linearized theorem = linearized_stability(b->j, criterion, b->view);
  if (!theorem.apart) { /* its limit may not be |tr J| = 1 */
    verdict_leave_open(b->f, b->j->out, theorem.note);
    return true;
  }
  if (theorem.takes_in[0]) { /* nothing is said of -1; where something is of 1, that is open */
    struct route_result w =
        theorem.takes_in[1] ? exact_route(b->f, b->j->out, ROUTE_AGREES, theorem.note)
                            : exact_route(b->f, b->j->out, ROUTE_UNDECIDED,
                                          "whether a solution with tr J = 1, as at a fold, is unstable is not decided "
                                          "by the linearization");
    b->f->verdict = verdict_of(&w, 1, true);
    return true;
  }
  if (b->j->effort != EFFORT_FULL || !route_is_asked(b->j->scene, "exact")) theorem.apart = false;
  bool ok = try_families(&t, b);
  if (ok) conclude(b, &t, &theorem);
  return ok;
}
