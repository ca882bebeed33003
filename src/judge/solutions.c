/* What the equations of a periodic motion determine: how many solutions with positive times they have, whether the
   events of each are the first ones, whether each is a motion of the system; whether there is one with given times.

   The list is that of motion/branches.h, every root of every switching function, or with "kept: yes" that of the word's
   orbits, whatever their t_c: along a phase in which the constraints hold no switching function vanishes, so that what
   keeps them has first events.  The paper's equations and constraints are tried on every solution in balls, those that
   do not solve the equations are none of the claim's, and that there are no others is seen where each equation of the
   list is one of the claim's, times a number. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "certificate.h"
#include "judge.h"
#include "motion/branches.h"
#include "motion/complete.h"
#include "motion/given.h"
#include "proof/condition.h"
#include "value/coulomb_setup.h"
#include "value/solved.h"
#include "value/title.h"

enum {
  SOLUTION_PREC = 256,
  UNITS_OF_SOLUTIONS = 60000,
  UNITS_OF_GIVEN = 150000,
  MOST_LISTED = 40,
  CLOSING = 3 + N_STATE
};

enum asked_of { ASKED_COUNT, ASKED_FIRST, ASKED_MOTION, ASKED_GIVEN };

/* What is found of one of the list: does it solve the claim's equations, keep the constraints, which does it break? */
struct seen {
  truth solves, keeps;
  bool broken[MAX_CONDITIONS];
};

struct solutions {
  struct judge *j;
  const struct claim *c;
  struct orbit_cache *cache; /* for given times its own: it keeps the addresses of orbits that live no longer */
  struct point at;
  bool kept; /* only solutions that keep the constraints count */
  enum asked_of asked;
  long count;   /* that is claimed */
  double until; /* a bound of t_c; 0: none */
  struct sentence equations;
  struct conditions constraints;
  struct dyn_orbits list; /* the cache's, but for given times */
  struct seen *of;        /* each of the list */
  bool are_theirs;        /* and what solves these solves those of the list */
  bool are_first;         /* where the list is of the word's orbits alone: what keeps the constraints is one */
};

/* --- Reading --- */

/* The scene's parameters, or those of the claim; *given: there are any. */
static bool read_parameters(bool *given, struct solutions *x) {
  const char *at = claim_get(x->c, "at");
  const struct scene *s = x->j->scene;
  bool times = x->asked == ASKED_GIVEN;
  x->at.kind = times ? POINT_GIVEN : POINT_ORBIT;
  *given = at || (!scene_is_box(s) && (times || (s->given[KEY_E1] && s->given[KEY_E2])));
  if (!*given) return true;
  if (!at) {
    for (int i = 0; i < N_PARAMS; i++) fmpq_set(&x->at.q[Q_CHI + i], &s->value[KEY_CHI + i]);
    return true;
  }
  return judge_params(&x->at, x->j, x->c, at);
}

static bool read_asked(struct solutions *x) {
  const char *count = claim_get(x->c, "count"), *until = claim_get(x->c, "until");
  char *end;
  x->kept = claim_says(x->c, "kept", "yes");
  x->count = count ? strtol(count, &end, 10) : 0;
  if (count && (end == count || *end || x->count < 0)) return claim_error(x->j, x->c, "count", "a whole number");
  x->until = until ? strtod(until, &end) : 0;
  if (until && (*end || until[strspn(until, "0123456789.eE+-")] || !(x->until > 0 && x->until < (double)INFINITY)))
    return claim_error(x->j, x->c, "until", "a positive number");
  x->asked = count                                 ? ASKED_COUNT
             : claim_get(x->c, "given")            ? ASKED_GIVEN
             : claim_says(x->c, "every", "motion") ? ASKED_MOTION
                                                   : ASKED_FIRST;
  if (x->asked == ASKED_FIRST && !claim_says(x->c, "every", "first"))
    return claim_error(x->j, x->c, "kind", "a count is needed, or given, or every: first, or every: motion");
  if (x->kept && until)
    return claim_error(x->j, x->c, "until", "no bound of t_c: those that keep the constraints count, whatever it is");
  return x->kept || x->asked == ASKED_GIVEN || until ||
         claim_error(x->j, x->c, "kind", "until, a bound of t_c, is needed");
}

/* That what keeps the constraints has first events is so of all of them: of a claim on these solutions alone none of
   the list of the paper's constraints may be missing. */
static bool lists_all(struct solutions *x) {
  const struct claims *all = x->j->claims;
  char id[64];
  for (size_t i = 0; x->kept && i < all->n; i++) {
    if (claim_kind(&all->claim[i]) != KIND_CONSTRAINTS) continue;
    for (const char *p = claim_get(&all->claim[i], "constraints"); (p = claim_next_item(id, sizeof id, p)) != NULL;)
      if (!claim_lists(x->c, "constraints", id))
        return claim_mistake(x->c, "constraints", x->j->d, "with kept all those of %s are needed", all->claim[i].id);
  }
  return true;
}

/* --- The solutions --- */

static void find(struct solutions *x) {
  work_add(UNITS_OF_SOLUTIONS);
  x->list = *orbit_cache_solutions(x->cache, x->at.q + Q_CHI, x->kept ? 0 : x->until, SOLUTION_PREC);
  x->of = ss_malloc(((size_t)x->list.n + 1) * sizeof *x->of);
}

/* With the static friction that the scene gives, too, unless the claim has data of its own. */
static truth keeps(struct solutions *x, slong i) {
  truth u[2] = {TRUTH_TRUE, TRUTH_TRUE}, all;
  if (!claim_get(x->c, "at")) orbit_admissible(u, x->j->scene, &x->list.orbit[i]);
  all = truth_and(u[0], u[1]);
  for (int k = 0; k < x->constraints.n; k++) {
    truth holds = condition_holds(NULL, NULL, &x->constraints.at[k], &x->at, x->cache);
    x->of[i].broken[k] = holds == TRUTH_FALSE;
    all = truth_and(all, holds);
  }
  return all;
}

/* Do the claim's equations, and what else its statement says, hold at the solution at hand? */
static truth solves(struct solutions *x, enum variant variant) {
  enum outcome o = sentence_try_balls(&x->equations, &x->at, variant, x->cache).outcome;
  return o == OUTCOME_AGREES ? TRUTH_TRUE : o == OUTCOME_DIFFERS ? TRUTH_FALSE : TRUTH_UNKNOWN;
}

static long n_solve(const struct solutions *x) {
  long n = 0;
  for (slong i = 0; i < x->list.n; i++) n += x->of[i].solves == TRUTH_TRUE;
  return n;
}

static void try_each(struct solutions *x) {
  for (slong i = 0; i < x->list.n; i++) {
    x->at.known = &x->list.orbit[i];
    x->of[i].solves = solves(x, VARIANT_CLOSED);
    x->of[i].keeps = keeps(x, i);
  }
  x->at.known = NULL;
}

/* What ends the phases D, Gamma and H, and how far a pass over those times is from its start. */
static void closing(val m[CLOSING], struct calc *c, const struct values *v) {
  const struct num_vec a = dyn_arc_state(&v->arc, 1), b = dyn_arc_state(&v->arc, 2), h = dyn_arc_state(&v->arc, 3);
  const struct num_vec start = dyn_arc_state(&v->arc, 0), end = dyn_arc_state(&v->arc, 4);
  val chi = num_vec_at(&v->params, P_CHI);
  val w = calc_sub(c, num_vec_at(&a, Z_1), calc_mul(c, chi, num_vec_at(&a, Z_2)));
  val r = calc_mul(c, chi, calc_sub(c, num_vec_at(&b, Z_2), num_vec_at(&b, Z_1)));
  m[0] = calc_sub(c, w, num_vec_at(&v->params, P_E1));
  m[1] = calc_sub(c, r, num_vec_at(&v->params, P_E2));
  m[2] = calc_sub(c, num_vec_at(&h, DZ_1), num_vec_at(&v->params, P_V));
  for (int i = 0; i < N_STATE; i++) m[3 + i] = calc_sub(c, num_vec_at(&end, i), num_vec_at(&start, i));
}

/* What an equation of the claim is of one of a closed pass: its sides' difference is that one's times the factor. */
struct multiple {
  bool is;
  arb_t factor; /* at the first point */
};

/* Takes out those that are none at this point, or of which that cannot be seen. */
static void compare_factor(struct multiple *y, const arb_t difference, const arb_t closing, bool first) {
  enum { BITS = 64 };
  NUMBERS(arb, factor);
  arb_div(factor, difference, closing, SOLUTION_PREC);
  bool known = !arb_contains_zero(factor) && arb_rel_accuracy_bits(factor) >= BITS;
  y->is = y->is && known && (first || arb_overlaps(factor, y->factor));
  if (first) arb_set(y->factor, factor);
}

static bool compare_closing(struct multiple (*of)[CLOSING], struct solutions *x, const struct point *p, bool first) {
  OWNED(values) v;
  int s = values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(SOLUTION_PREC), x->cache);
  struct num_vec lhs = calc_vec(&v.c, x->equations.n), rhs = calc_vec(&v.c, x->equations.n);
  if (s == SS_OK) s = sentence_evaluate(&lhs, &rhs, NULL, &x->equations, &v);
  val m[CLOSING];
  if (s == SS_OK) closing(m, &v.c, &v);
  for (slong i = 0; s == SS_OK && i < x->equations.n; i++)
    for (int k = 0; k < CLOSING; k++)
      compare_factor(&of[i][k], calc_sub(&v.c, num_vec_at(&lhs, i), num_vec_at(&rhs, i)), m[k], first);
  return s == SS_OK;
}

/* Is each equation of a closed pass among the claim's, but for a factor, over any times from any start with the belt's
   velocity?  The factor may depend on the parameters, which are those of the claim. */
static bool closes_alone(struct solutions *x) {
  enum { POINTS = 4 };
  struct multiple(*of)[CLOSING] = ss_malloc(((size_t)x->equations.n + 1) * sizeof *of);
  bool all = true;
  struct sampler sampler;
  LOCAL(point, p);
  for (slong i = 0; i < x->equations.n; i++)
    for (int k = 0; k < CLOSING; k++) {
      of[i][k].is = x->equations.ops[i] == REL_EQ;
      arb_init(of[i][k].factor);
    }
  sampler_init(&sampler, x->c->id, &(struct point_spec){.kind = POINT_PATCHED});
  for (int n = 0; all && n < POINTS; n++) {
    sampler_next(&p, &sampler);
    for (int i = Q_CHI; i <= (x->asked == ASKED_GIVEN ? Q_V : Q_E2); i++) fmpq_set(&p.q[i], &x->at.q[i]);
    for (int i = Q_DZ1; i <= Q_DZ2; i++) fmpq_set(&p.q[i], &p.q[Q_V]);
    all = compare_closing(of, x, &p, n == 0);
  }
  for (int k = 0; k < CLOSING; k++) {
    bool found = false;
    for (slong i = 0; i < x->equations.n; i++) found = found || of[i][k].is;
    all = all && found;
  }
  for (slong i = 0; i < x->equations.n; i++)
    for (int k = 0; k < CLOSING; k++) arb_clear(of[i][k].factor);
  free(of);
  return all;
}

/* Is every solution that counts proved to be on the list? */
static bool lists_every(const struct solutions *x) {
  return x->list.complete && x->are_theirs && x->are_first;
}

/* --- What is claimed, of all solutions or of those that keep the constraints --- */

static truth first_events(const struct dyn_orbit *o) {
  truth all = TRUTH_TRUE;
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) all = truth_and(all, o->first[ph]);
  return all;
}

static struct answers answers_of(const struct solutions *x, bool constrained) {
  struct answers t = {{0}};
  for (slong i = 0; i < x->list.n; i++) {
    const struct dyn_orbit *o = &x->list.orbit[i];
    truth counts = constrained ? truth_and(x->of[i].solves, x->of[i].keeps) : x->of[i].solves;
    if (counts == TRUTH_FALSE) continue;
    truth good = x->asked == ASKED_COUNT ? TRUTH_TRUE : first_events(o);
    if (x->asked == ASKED_MOTION) good = truth_and(good, o->admissible);
    if (counts == TRUTH_UNKNOWN) good = TRUTH_UNKNOWN;
    t.of[good]++;
  }
  return t;
}

static enum route_outcome outcome_of(const struct solutions *x, bool constrained) {
  const struct answers t = answers_of(x, constrained);
  bool complete = lists_every(x);
  if (x->asked == ASKED_COUNT) {
    long sure = t.of[TRUTH_TRUE];
    if (sure > x->count) return ROUTE_DIFFERS;
    if (!complete || sure != answers_given(&t)) return ROUTE_UNDECIDED;
    return sure == x->count ? ROUTE_AGREES : ROUTE_DIFFERS;
  }
  enum route_outcome said = answers_outcome(&t);
  return said == ROUTE_DIFFERS || complete ? said : ROUTE_UNDECIDED;
}

/* --- Words --- */

/* "(51), (57) and z_1' < V in the global slip phase". */
static const char *constraints_named(struct solutions *x) {
  struct text t = {0};
  if (!claim_title_records(&t, x->j->model, x->c, "constraints", x->j->d)) text_add(&t, "the constraints");
  return result_take(x->j->out, &t);
}

static void add_times(struct text *t, struct judge *j, const struct dyn_orbit *o) {
  for (int ph = 0; ph < N_PHASES; ph++) text_printf(t, "%s%s", ph ? ", " : "", ball_text(j, o->t[ph], 6));
}

static void add_broken(struct text *t, const struct solutions *x, slong i) {
  const char *sep = " violates ";
  for (int k = 0; k < x->constraints.n; k++) {
    if (!x->of[i].broken[k]) continue;
    text_add(t, sep);
    const struct condition *broken = &x->constraints.at[k];
    text_add(t, broken->text);
    if (broken->moving) text_printf(t, " in the %s phase", phase_words[broken->phase]);
    sep = " and ";
  }
  if (x->constraints.n && x->of[i].keeps == TRUTH_TRUE) text_add(t, " satisfies all");
}

static const char *listed(struct solutions *x) {
  struct text t = {0};
  text_printf(&t,
              "values of (t_a, t_b, t_c, t_d)%s:", x->constraints.n ? " and the constraints that are violated" : "");
  for (slong i = 0; i < x->list.n && i < MOST_LISTED; i++) {
    text_add(&t, i ? "; (" : " (");
    add_times(&t, x->j, &x->list.orbit[i]);
    text_add(&t, ")");
    add_broken(&t, x, i);
  }
  if (x->list.n > MOST_LISTED) text_printf(&t, "; and %ld more", (long)x->list.n - MOST_LISTED);
  return result_take(x->j->out, &t);
}

/* Where one solution is regular and t_c has no bound, the angles of phase H come back near to where they are. */
static const char *const recurrence =
    "; if t_c is not bounded there are infinitely many, since the Jacobian is regular at each of these, the equations "
    "contain t_c only in the angles omega_1 t_c and omega_2 t_c, and by Dirichlet's theorem on simultaneous "
    "approximation both return arbitrarily closely to their values at arbitrarily large t_c";

static const char *summed_up(struct solutions *x) {
  const struct answers held = answers_of(x, true);
  long all = x->list.n, sure = answers_given(&held) - held.of[TRUTH_UNKNOWN];
  const char *unseen = x->are_theirs
                           ? ""
                           : "; the equations of the claim are not shown to contain those of the switches and of the "
                             "return, which these solve together";
  const char *first_alone = x->are_first ? "" : "; that the constraints hold for no others is not shown";
  const char *complete = !x->are_theirs ? "perhaps not all"
                         : x->list.complete
                             ? "and there are proved to be no others"
                             : result_str(x->j->out, "%s: %s", x->list.gap == GAP_MANY ? "not all" : "perhaps not all",
                                          dyn_gap_text[x->list.gap]);
  const char *each = all == 1 ? "" : "each ";
  if (all == 0 && x->are_theirs && x->list.complete)
    return x->kept ? "there is proved to be no periodic solution in which each phase ends at the first possible time"
                   : result_str(x->j->out, "there is proved to be no solution with positive times and t_c up to %s",
                                claim_get(x->c, "until"));
  if (x->kept)
    return result_str(x->j->out,
                      "%ld periodic solution%s, %sproved to exist, %s in which each phase ends at the first possible "
                      "time; the equations hold for %ld of them, the constraints for %ld%s%s",
                      all, plural_s(all), each, complete, n_solve(x), sure, unseen, first_alone);
  long first = 0;
  bool recur = x->asked == ASKED_COUNT && all && x->are_theirs && n_solve(x) == all; /* what is added may contain t_c */
  for (slong i = 0; i < x->list.n; i++) first += first_events(&x->list.orbit[i]) == TRUTH_TRUE;
  return result_str(x->j->out,
                    "%ld solution%s with t_c up to %s, %sproved to be locally unique, %s; the equations hold for %ld "
                    "of them; t_b, t_c and t_d are the first roots for %ld%s%s%s",
                    all, plural_s(all), claim_get(x->c, "until"), each, complete, n_solve(x), first,
                    x->constraints.n ? result_str(x->j->out, ", and the constraints hold for %ld", sure) : "", unseen,
                    recur ? recurrence : "");
}

/* --- With given times --- */

/* "t_a = 0, t_b = 2": two, and nothing else. */
static bool read_given(enum dyn_quantity which[2], fmpq value[2], const char *text) {
  for (int i = 0; i < 2; i++) {
    char name[8], number[24];
    int used;
    if (!text || sscanf(text, " %7[a-z_0-9] = %23[0-9./]%n", name, number, &used) != 2) return false;
    text += used;
    while (*text == ',' || *text == ' ') text++;
    int k = word_find(name, dyn_quantity_id, N_QUANTITIES);
    if (k == N_QUANTITIES || num_parse_decimal(&value[i], number, strlen(number)) != SS_OK) return false;
    which[i] = (enum dyn_quantity)k;
  }
  return !*text && which[0] != which[1];
}

/* Does a solution that was found solve the paper's equations and keep the constraints?  One is enough; that there is
   none is seen only of a list that is complete. */
static struct route_result add_given(struct finding *f, struct solutions *x, enum variant variant) {
  struct answers good = {{0}};
  struct text note = {0};
  for (slong i = 0; i < x->list.n; i++) {
    x->at.known = &x->list.orbit[i];
    good.of[truth_and(solves(x, variant), conditions_hold(&x->constraints, &x->at, x->cache))]++;
  }
  const struct dyn_orbit *o = x->list.n ? &x->list.orbit[0] : NULL;
  if (o) {
    text_printf(&note,
                "%ld solution%s found for chi, eta and V of %s and proved to exist; the equations and the constraints "
                "hold for %ld; %s has (t_a, t_b, t_c, t_d) = (",
                (long)x->list.n, plural_s(x->list.n), scene_data_of(x->j->scene), good.of[TRUTH_TRUE],
                x->list.n == 1 ? "it" : "the first");
    add_times(&note, x->j, o);
    text_printf(&note, ") and e1 = %s, e2 = %s", ball_text(x->j, o->e1, 6), ball_text(x->j, o->e2, 6));
  } else {
    text_add(&note, "none was found");
  }
  if (good.of[TRUTH_TRUE]) {
    good.of[TRUTH_FALSE] = good.of[TRUTH_UNKNOWN] = 0;
  } else {
    bool all = lists_every(x) && x->list.t_c_max == 0;
    text_add(&note, all ? "; there are proved to be no others"
                    : x->are_first
                        ? "; the search is not exhaustive"
                        : "; only those in which each phase ends at the first possible time were looked for");
    if (x->list.n == 0 && all) good.of[TRUTH_FALSE] = 1;
    if (!all) good = (struct answers){.of = {[TRUTH_UNKNOWN] = 1}};
  }
  bool closed = variant == VARIANT_CLOSED;
  struct route_result w = answers_route(closed ? "balls" : "exponential", closed, &good);
  if (x->list.n) w.trials = x->list.n;
  return finding_add_route(f, x->j->out, w, layer_name[LAYER_CORRECTED], FIRST_PREC, NULL,
                           result_take(x->j->out, &note));
}

static bool judge_given(struct finding *f, struct solutions *x) {
  enum dyn_quantity which[2];
  FMPQ_VECTOR(value, 2);
  bool ok = read_given(which, value, claim_get(x->c, "given")) ||
            claim_error(x->j, x->c, "given", "reads NAME = VALUE, NAME = VALUE");
  if (ok) {
    struct route_result w[2];
    x->cache = orbit_cache_new();
    work_add(UNITS_OF_GIVEN);
    dyn_orbits_given(&x->list, x->at.q + Q_CHI, which, value, FIRST_PREC, NULL);
    dyn_given_complete(&x->list, x->at.q + Q_CHI, which, value, FIRST_PREC);
    x->are_theirs = closes_alone(x);
    w[0] = add_given(f, x, VARIANT_CLOSED);
    w[1] = add_given(f, x, VARIANT_EXPONENTIAL);
    f->verdict = verdict_of(w, 2, true); /* one enclosed solution proves that there is one */
    dyn_orbits_clear(&x->list);
    orbit_cache_free(x->cache);
  }
  return ok;
}

/* --- Under Coulomb's law --- */

/* Of the solutions with first roots, or those that keep the constraints too, one on which every condition of the model
   holds and one on which it does not: does the integrated motion close after one period?  *fails: one of
   the latter was tried. */
static struct route_result integrate(struct finding *f, struct solutions *x, bool constrained, bool *fails) {
  struct answers closed = {{0}};
  bool tried[2] = {false};
  long left = 0;
  const char *note;
  for (slong i = 0; i < x->list.n; i++) {
    const struct dyn_orbit *o = &x->list.orbit[i];
    struct coulomb_setup sim;
    bool wanted = first_events(o) == TRUTH_TRUE && x->of[i].solves == TRUTH_TRUE &&
                  (!constrained || x->of[i].keeps == TRUTH_TRUE);
    if (!wanted) continue;
    if (o->admissible == TRUTH_UNKNOWN || tried[o->admissible == TRUTH_TRUE]) {
      left++;
      continue;
    }
    tried[o->admissible == TRUTH_TRUE] = true;
    truth closes = TRUTH_UNKNOWN;
    if (coulomb_setup_on_orbit(&sim, x->at.q + Q_CHI, o, OWN_FRICTION) == SS_OK) closes = coulomb_setup_closes(&sim);
    closed.of[closes]++;
  }
  *fails = tried[0];
  if (tried[0] || tried[1])
    note =
        result_str(x->j->out,
                   "among the motions under Coulomb's law from the initial states of such "
                   "solutions%s, the number of periodic ones is %ld and that of the others %ld",
                   constrained ? " that satisfy the constraints" : "", closed.of[TRUTH_TRUE], closed.of[TRUTH_FALSE]);
  else
    note = result_str(
        x->j->out,
        "no motion was followed, since for no such solution%s is it proved that the times are the first roots%s",
        constrained ? " that satisfies the constraints" : "", left > 0 ? " and whether it is admissible" : "");
  if (left > 0 && (tried[0] || tried[1])) note = result_str(x->j->out, "%s; not followed: %ld", note, left);
  return finding_add_route(f, x->j->out, answers_route("integration", false, &closed), "model", -1, NULL, note);
}

/* --- The kind --- */

/* That there is none, by a complete list, is as much as a trial. */
static struct route_result add_balls(struct finding *f, struct solutions *x, bool constrained, const char *note) {
  bool none = x->asked == ASKED_COUNT && x->list.n == 0 && x->list.complete && x->are_theirs;
  return finding_add_route(f, x->j->out,
                           (struct route_result){"balls", outcome_of(x, constrained), true, none ? 1 : x->list.n},
                           layer_name[LAYER_CORRECTED], SOLUTION_PREC, NULL, note);
}

/* Refuted as it stands: does it hold of the solutions that keep the constraints? */
static void judge_constrained(struct finding *f, struct solutions *x) {
  struct route_result w[2];
  int n = 0;
  const char *named = constraints_named(x);
  const struct answers t = answers_of(x, true);
  w[n++] = add_balls(
      f, x, true,
      result_str(
          x->j->out, "%s hold for %ld of these solutions%s", named, answers_given(&t) - t.of[TRUTH_UNKNOWN],
          x->asked == ASKED_COUNT ? ""
          : x->asked == ASKED_FIRST
              ? result_str(x->j->out, "; t_b, t_c and t_d are the first roots for %ld of those", t.of[TRUTH_TRUE])
              : result_str(x->j->out, "; every condition of the model holds for %ld of those", t.of[TRUTH_TRUE])));
  bool fails;
  if (x->asked == ASKED_MOTION) w[n++] = integrate(f, x, true, &fails);
  f->verdict = verdict_under_condition(f->verdict, verdict_of(w, n, true));
  if (f->verdict != VERDICT_CONDITIONAL) return;
  f->condition = named;
  f->fault = fault_name[FAULT_ARGUMENT];
}

/* The first solution of which what is claimed is not so; where they are counted, that breaks a constraint or, of those
   that keep them, is one too many; the parameters where there is none. */
static void certify(struct finding *f, struct solutions *x) {
  const struct answers counted = answers_of(x, true);
  bool too_many = x->asked == ASKED_COUNT && x->kept && counted.of[TRUTH_TRUE] > x->count;
  for (slong i = 0; i < x->list.n; i++) {
    const struct dyn_orbit *o = &x->list.orbit[i];
    truth is = x->asked == ASKED_COUNT ? x->of[i].keeps : x->asked == ASKED_FIRST ? first_events(o) : o->admissible;
    if (is != (too_many ? TRUTH_TRUE : TRUTH_FALSE) || x->of[i].solves == TRUTH_FALSE) continue;
    certify_params(&f->certificate, x->j, x->at.q + Q_CHI);
    certify_orbit(&f->certificate, x->j, o);
    return;
  }
  certify_params(&f->certificate, x->j, x->at.q + Q_CHI);
}

static void conclude(struct finding *f, struct solutions *x) {
  struct route_result w[2];
  int n = 0;
  try_each(x);
  x->are_theirs = closes_alone(x);
  w[n++] = add_balls(f, x, x->kept, summed_up(x));
  if (x->asked == ASKED_MOTION && x->j->effort == EFFORT_FULL) {
    bool fails;
    w[n++] = integrate(f, x, x->kept, &fails);
    if (w[0].outcome == ROUTE_DIFFERS && !fails) n--; /* of those that are none by balls none was integrated */
  }
  if (x->asked == ASKED_COUNT && x->list.n)
    finding_state(f, x->j->out, "balls", "model", SOLUTION_PREC, x->list.n, NULL, listed(x));
  f->verdict = verdict_of(w, n, true);
  if (f->verdict == VERDICT_REFUTED) certify(f, x);
  if (f->verdict == VERDICT_REFUTED && !x->kept && x->constraints.n) judge_constrained(f, x);
}

/* At stiff parameters there can be thousands, which are not tried one by one. */
static void leave_many(struct finding *f, struct solutions *x) {
  finding_state(
      f, x->j->out, "balls", "model", SOLUTION_PREC, x->list.n, NULL,
      result_str(x->j->out, "there are %ld solutions, and at most %d are tried", (long)x->list.n, MOST_BRANCHES));
}

bool judge_solutions(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct solutions x = {.j = j, .c = c, .cache = j->cache};
  bool given = false;
  point_init(&x.at);
  bool ok = read_asked(&x) && read_parameters(&given, &x);
  ok = ok && lists_all(&x) && conditions_read(&x.constraints, j, c, "constraints", view);
  x.are_first = ok && ((!x.kept && x.asked != ASKED_GIVEN) || conditions_make_first(&x.constraints));
  bool built = ok;
  ok = ok && sentence_from_claim(&x.equations, view, c, NULL, 0, j->d);
  if (ok && !given) {
    finding_skip(f, j, "the scene does not give e1 and e2");
  } else if (ok && constraints_leave_open(f, j, &x.constraints)) {
    /* nothing is tried */
  } else if (ok && x.asked == ASKED_GIVEN) {
    ok = judge_given(f, &x);
  } else if (ok) {
    find(&x);
    if (x.list.n > MOST_BRANCHES)
      leave_many(f, &x);
    else
      conclude(f, &x);
    free(x.of);
  }
  if (built) sentence_clear(&x.equations);
  conditions_clear(&x.constraints);
  point_clear(&x.at);
  return ok;
}
