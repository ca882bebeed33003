/* Which conditions make a periodic solution realistic: are the paper's constraints all of them, which follow from
   others, and what exactly do they ask of u_r1 and u_r2?

   Balls: over the pool of orbits the paper's constraints hold together exactly where the model's do, and the closed
   forms for the least u_r1 and u_r2 are the infima along the orbits.  Simulation: with u_r just above its bounds the
   motion under the Coulomb law closes after one period of the same phases; with a constraint broken it does not. */
#include <math.h>

#include "certificate.h"
#include "explore/family.h"
#include "proof/exact_constraints.h"
#include "value/coulomb_setup.h"
#include "value/expression.h"
#include "value/orbit_pool.h"

enum { EACH = 8, ALONE = 2, SIMULATED = 3 };

struct constraints {
  struct judge *j;
  const struct claim *c;
  struct view view;
  const char *least[2]; /* the closed forms of the least u_r1 and u_r2 */
  struct conditions paper;
  struct answers lists, forms, motions; /* do both lists, the closed form and the infimum, law and list agree? */
  struct certificate first;             /* where one of the former two does not */
};

/* In the order of COND_TA, ... */
static const char *const condition_words[N_CONDITIONS] = {"t_a > 0",
                                                          "z_1' < V in the slip-stick phase",
                                                          "z_1' < V in the global slip phase",
                                                          "z_2' < V in the global slip phase",
                                                          "z_2' < V in the stick-slip phase",
                                                          "z_1 - chi z_2 < e_1 in the stick-slip phase",
                                                          "chi (z_2 - z_1) < e_2 in the global stick phase",
                                                          "chi (z_2 - z_1) < e_2 in the slip-stick phase"};

/* --- Balls --- */

static void compare_lists(struct constraints *x, const struct point *p, const struct dyn_orbit *o) {
  truth all = conditions_hold(&x->paper, p, x->j->cache), same = truth_same(all, o->admissible);
  x->lists.of[same]++;
  if (same != TRUTH_FALSE || x->first.n) return;
  certify_drawn(&x->first, x->j, p, o, 0);
  certificate_add(&x->first, x->j->out, "left", all == TRUTH_TRUE ? "all constraints hold" : "a constraint fails");
  certificate_add(&x->first, x->j->out, "right", o->admissible == TRUTH_TRUE ? "a motion" : "no motion");
}

/* The closed form for the least u_r1 or u_r2 at an orbit. */
static bool form_at(arb_t z, struct constraints *x, int i, const struct point *p) {
  return expression_number(z, x->view, x->least[i], claim_section(x->c), p, FIRST_PREC, x->j->cache, x->j->d) == SS_OK;
}

static void compare_form(struct constraints *x, int i, const struct dyn_orbit *o, const struct point *p) {
  NUMBERS(arb, v);
  arb_srcptr least = i ? o->u_r2_min : o->u_r1_min;
  truth same = TRUTH_UNKNOWN;
  if (form_at(v, x, i, p)) same = arb_overlaps(v, least) ? TRUTH_TRUE : TRUTH_FALSE;
  x->forms.of[same]++;
  if (same != TRUTH_FALSE || x->first.n) return;
  certify_drawn(&x->first, x->j, p, o, 0);
  certificate_add(&x->first, x->j->out, "mass", i ? "2" : "1");
  certify_ball(&x->first, x->j, "left", v);
  certify_ball(&x->first, x->j, "right", least);
}

static bool lists_differ(const struct constraints *x) {
  return x->lists.of[TRUTH_FALSE] + x->forms.of[TRUTH_FALSE] > 0;
}

/* The one condition that the orbit violates, where the others hold; else N_CONDITIONS. */
static int sole_violation(const struct dyn_orbit *o) {
  int sole = N_CONDITIONS, n = 0;
  for (int a = 0; a < N_CONDITIONS; a++)
    if (o->holds[a] != TRUTH_TRUE) sole = a, n++;
  return n == 1 && o->holds[sole] == TRUTH_FALSE ? sole : N_CONDITIONS;
}

/* Orbits that are admissible, some that violate each condition alone, which show that the list has it, and others. */
static void by_balls(struct constraints *x) {
  struct orbit_pool pool = orbit_pool_get(x->j);
  LOCAL(point, p);
  long good = 0, bad[N_CONDITIONS + 1] = {0};
  bool refute = x->j->effort == EFFORT_REFUTE;
  for (size_t i = 0; i < pool.n && !(refute && lists_differ(x)); i++)
    for (slong k = 0; k < pool.item[i]->list.n; k++) {
      const struct dyn_orbit *o = &pool.item[i]->list.orbit[k];
      int sole = sole_violation(o);
      long *count = o->admissible == TRUTH_TRUE ? &good : &bad[sole];
      if (o->grazing || *count == (sole < N_CONDITIONS ? ALONE : EACH)) continue;
      ++*count;
      pool_point(&p, pool.item[i], k);
      p.known = NULL;
      compare_lists(x, &p, o);
      if (o->admissible != TRUTH_TRUE) continue;
      for (int mass = 0; mass < 2; mass++) compare_form(x, mass, o, &p);
    }
}

/* --- What follows from what --- */

/* How often each condition is broken, broken alone, and holds where another is broken. */
struct counts {
  long orbits, admissible, broken[N_CONDITIONS], alone[N_CONDITIONS], despite[N_CONDITIONS][N_CONDITIONS];
};

static void count_orbit(struct counts *n, const truth holds[N_CONDITIONS]) {
  int failures = 0;
  for (int a = 0; a < N_CONDITIONS; a++) failures += holds[a] != TRUTH_TRUE;
  n->orbits++;
  n->admissible += failures == 0;
  for (int a = 0; a < N_CONDITIONS; a++) {
    if (holds[a] != TRUTH_FALSE) continue;
    n->broken[a]++;
    n->alone[a] += failures == 1;
    for (int b = 0; b < N_CONDITIONS; b++) n->despite[a][b] += holds[b] != TRUTH_FALSE;
  }
}

static const char *table(struct constraints *x) {
  struct orbit_pool pool = orbit_pool_get(x->j);
  struct counts n = {.orbits = 0};
  for (size_t i = 0; i < pool.n; i++)
    for (slong k = 0; k < pool.item[i]->list.n; k++) count_orbit(&n, pool.item[i]->list.orbit[k].holds);
  struct text t = {0};
  text_printf(&t, "of %ld periodic solutions, %ld of them admissible,", n.orbits, n.admissible);
  for (int a = 0; a < N_CONDITIONS; a++) {
    text_printf(&t, "%s %ld violate %s", a ? ";" : "", n.broken[a], condition_words[a]);
    if (n.broken[a]) text_printf(&t, " (%ld this alone", n.alone[a]);
    const char *sep = ", all together with ";
    for (int b = 0; b < N_CONDITIONS; b++) {
      if (b == a || n.broken[a] == 0 || n.despite[a][b] > 0) continue;
      text_printf(&t, "%s%s", sep, condition_words[b]);
      sep = ", ";
    }
    if (n.broken[a]) text_add_char(&t, ')');
  }
  return result_take(x->j->out, &t);
}

/* --- Simulation --- */

/* Does the motion close after one period of the word D Gamma H C?  UNKNOWN between closed and clearly not. */
static truth closes(const struct pool_item *item, slong index, const double u_r[2]) {
  struct scene s = {.name = NULL};
  struct coulomb_setup sim;
  static const int key[N_DRAW] = {KEY_CHI, KEY_ETA, KEY_V, KEY_TB, KEY_TC};
  for (int i = 0; i < N_DRAW; i++) s.value[key[i]] = item->q[i]; /* borrowed */
  for (int i = 0; i < N_DRAW; i++) s.given[key[i]] = true;
  for (int i = 0; i < 2; i++) {
    fmpq_init(&s.value[KEY_U_R1 + i]);
    fmpq_set_si(&s.value[KEY_U_R1 + i], (slong)ceil(ldexp(u_r[i], 20)), 1 << 20);
    s.given[KEY_U_R1 + i] = true;
  }
  bool ok = coulomb_setup_listed(&sim, &s, index);
  for (int i = 0; i < 2; i++) fmpq_clear(&s.value[KEY_U_R1 + i]);
  if (!ok) return TRUTH_UNKNOWN;
  return coulomb_setup_closes(&sim);
}

/* As the paper's list says: with u_r a little above its bounds; and where the list holds, with each a little below its
   bound, if that still exceeds e. */
static void simulate(struct constraints *x, const struct pool_item *item, slong index, const struct point *p,
                     truth listed) {
  const struct dyn_orbit *o = &item->list.orbit[index];
  const double e[2] = {num_arb.get_d(o->e1), num_arb.get_d(o->e2)};
  double least[2], above[2];
  NUMBERS(arb, form);
  for (int i = 0; i < 2; i++) {
    least[i] = form_at(form, x, i, p) ? num_arb.get_d(form) : 0;
    above[i] = fmax(least[i], e[i]) * 1.03125;
  }
  x->motions.of[truth_same(closes(item, index, above), listed)]++;
  for (int i = 0; listed == TRUTH_TRUE && i < 2; i++) {
    double u_r[2] = {above[0], above[1]};
    u_r[i] = least[i] * 0.96875;
    if (u_r[i] > e[i] * 1.01) x->motions.of[truth_not(closes(item, index, u_r))]++;
  }
}

/* A constraint clearly fails, as far as double precision tells: to pass over orbits of which enough have been tried. */
static bool clearly_fails(struct constraints *x, const struct point *p) {
  struct sampled s[MAX_CONDITIONS];
  bool fails = conditions_sample(s, &x->paper, p, x->j->cache) != SS_OK;
  for (int i = 0; !fails && i < x->paper.n; i++) fails = s[i].least < -1e-3;
  return fails;
}

/* Only the verdict is asked for, and it is refuted whatever further orbits say. */
static bool enough(const struct constraints *x) {
  return x->j->effort == EFFORT_VERDICT && lists_differ(x) && x->motions.of[TRUTH_FALSE] + x->motions.of[TRUTH_UNKNOWN];
}

static void by_simulation(struct constraints *x) {
  struct orbit_pool pool = orbit_pool_get(x->j);
  LOCAL(point, p);
  long count[3] = {0}; /* orbits on which the list fails, holds */
  for (size_t i = 0; i < pool.n && !enough(x) && (count[0] < SIMULATED || count[1] < SIMULATED); i++)
    for (slong k = 0; k < pool.item[i]->list.n; k++) {
      const struct dyn_orbit *o = &pool.item[i]->list.orbit[k];
      if (o->grazing || num_arb.get_d(o->t[0]) < 0.01) continue; /* the simulation starts in the stick phase */
      pool_point(&p, pool.item[i], k);
      if (count[0] >= SIMULATED && clearly_fails(x, &p)) continue;
      p.known = NULL;
      truth listed = conditions_hold(&x->paper, &p, x->j->cache);
      if (listed == TRUTH_UNKNOWN || count[listed]++ >= SIMULATED) continue;
      simulate(x, pool.item[i], k, &p, listed);
    }
}

/* --- The kind --- */

/* The closed form of the attribute, for exact algebra. */
static bool least_is_exact(struct constraints *x, int i) {
  OWNED(expression) e;
  return expression_open(&e, x->view, x->least[i], claim_section(x->c), x->j->d) && e.n == 1 &&
         exact_least_friction(&e.tape, i);
}

static bool prove(struct finding *f, struct constraints *x) {
  if (!exact_constraints(&x->paper) || !least_is_exact(x, 0) || !least_is_exact(x, 1)) return false;
  exact_route(
      f, x->j->out, ROUTE_AGREES,
      "each of the paper's constraints follows, on motions computed from the first-order systems, from t_a > 0 "
      "and what Coulomb's law (2) asks along the four phases, and each of these from the paper's constraints; "
      "u_ri + f_i, f_i being the force on mass i, is twice u_ri less its closed form where the mass begins to "
      "stick, and does not decrease while it sticks; with u_ri equal to its closed form the condition holds inside "
      "the phase alone, and for m_1 the inequality in (16) excludes that");
  return true;
}

static void describe(struct finding *f, struct constraints *x) {
  struct route_result w[2];
  const long *said = x->lists.of, *forms = x->forms.of, *motions = x->motions.of;
  const char *note =
      result_str(x->j->out,
                 "on %ld orbits the paper's list of constraints and the model's agree (both hold, or both fail), on "
                 "%ld they disagree, and on %ld it is undecided; the closed forms of the least u_r1 and u_r2 are equal "
                 "to the infima in %ld cases, differ from them in %ld, and in %ld it is undecided",
                 said[TRUTH_TRUE], said[TRUTH_FALSE], said[TRUTH_UNKNOWN], forms[TRUTH_TRUE], forms[TRUTH_FALSE],
                 forms[TRUTH_UNKNOWN]);
  enum route_outcome balls = outcome_of_counts(said[TRUTH_TRUE], said[TRUTH_FALSE] + forms[TRUTH_FALSE],
                                               said[TRUTH_UNKNOWN] + forms[TRUTH_UNKNOWN]);
  w[0] = finding_add_route(f, x->j->out, (struct route_result){"balls", balls, true, answers_given(&x->lists)},
                           layer_name[LAYER_CORRECTED], FIRST_PREC, NULL, note);
  note = result_str(x->j->out,
                    "motions over one period under Coulomb's law, with u_r 1/32 above or below the bounds: %ld end as "
                    "the constraints predict, %ld otherwise, %ld undecided",
                    motions[TRUTH_TRUE], motions[TRUTH_FALSE], motions[TRUTH_UNKNOWN]);
  w[1] = finding_add_route(f, x->j->out, answers_route("integration", false, &x->motions), layer_name[LAYER_CORRECTED],
                           -1, NULL, note);
  finding_state(f, x->j->out, "balls", "model", 64, 1, NULL, table(x));
  bool alone = x->j->effort == EFFORT_REFUTE || balls == ROUTE_DIFFERS; /* motions are of other orbits, or bounds */
  f->verdict =
      verdict_of(w, alone ? 1 : 2, (x->j->effort == EFFORT_FULL || x->j->effort == EFFORT_REFUTE) && prove(f, x));
  if (f->verdict == VERDICT_REFUTED) f->certificate = x->first;
}

bool constraints_leave_open(struct finding *f, struct judge *j, const struct conditions *list) {
  bool any = conditions_use_friction(list);
  if (any) verdict_leave_open(f, j->out, "a constraint is about u_r1 or u_r2, which the solution does not fix");
  return any;
}

bool judge_constraints(struct finding *f, struct judge *j, const struct claim *c, struct view view) {
  struct arena *a = &j->out->arena;
  struct constraints x = {
      .j = j,
      .c = c,
      .view = view,
      .least = {claim_formula(a, j->model, c, "least-first"), claim_formula(a, j->model, c, "least-second")}};
  bool ok = conditions_read(&x.paper, j, c, "constraints", view);
  if (ok && (x.paper.n == 0 || !x.least[0] || !x.least[1]))
    ok = claim_error(j, c, "kind", "constraints, least-first and least-second are needed");
  static const char *const least[2] = {"least-first", "least-second"};
  const char *untold = NULL;
  for (int i = 0; i < 2; i++)
    if (claim_formula_relation(j->model, c, least[i]) == '?') untold = claim_get(c, least[i]);
  if (ok && untold) {
    verdict_leave_open(f, j->out, result_str(j->out, "%s has no symbol alone on a side", untold));
  } else if (ok && !constraints_leave_open(f, j, &x.paper)) {
    by_balls(&x);
    if (j->effort != EFFORT_REFUTE) by_simulation(&x);
    describe(f, &x);
    if (conditions_admit_equality(&x.paper) && f->verdict != VERDICT_REFUTED)
      verdict_leave_open(f, j->out, "not decided where a constraint holds with equality, as <= and >= admit");
  }
  conditions_clear(&x.paper);
  return ok && !j->d->set;
}
