/* Every solution of the six equations with positive times, later roots included, against a search by a grid that knows
   nothing of this program (tests/oracle/later.py); and what claims of kind solutions make of them. */
#include "known_orbits.h"
#include "motion/branches.h"
#include "motion/complete.h"
#include "paper_model.h"
#include "rational.h"
#include "run/run.h"
#include "test.h"

static const double LAST = 20; /* t_c of the file */

static bool is_at(const struct dyn_orbit *o, const double t[N_PHASES]) {
  bool same = true;
  for (int ph = 0; ph < N_PHASES; ph++) same = same && fabs(o->guess[ph] - t[ph]) < 2e-5;
  return same;
}

/* The same solutions, each enclosed, and a proof that there are no others. */
TEST_EACH(all_that_a_grid_finds, 3) {
  const struct known_set *s = later_set(_i);
  OWNED(dyn_orbits) list;
  ck_assert_int_eq(dyn_branches_find(&list, s->params, LAST, 128, DYN_CELLS), SS_OK);
  ck_assert_msg(list.complete, "%s: %s", s->name, dyn_gap_text[list.gap]);
  ck_assert_int_eq((int)list.n, s->n);
  for (int k = 0; k < s->n; k++) {
    bool found = false;
    double t[N_PHASES];
    for (int ph = 0; ph < N_PHASES; ph++) t[ph] = atof(s->orbit[k][1 + ph]);
    for (slong i = 0; i < list.n; i++) found = found || is_at(&list.orbit[i], t);
    ck_assert_msg(found, "%s: no solution at %g %g %g %g", s->name, t[0], t[1], t[2], t[3]);
  }
  for (slong i = 0; i < list.n; i++)
    for (int ph = 0; ph < N_PHASES; ph++) ck_assert(arb_is_positive(list.orbit[i].t[ph]));
}

/* Those with first events are the orbits of the word with t_a > 0, which another search finds. */
TEST_EACH(first_events_are_the_orbits_of_the_word, 3) {
  const struct known_set *s = later_set(_i);
  OWNED(dyn_orbits) list, word;
  slong first = 0, expected = 0;
  dyn_branches_find(&list, s->params, LAST, 128, DYN_CELLS);
  dyn_orbits_find(&word, s->params, 128, &dyn_limits_default);
  for (slong i = 0; i < word.n; i++) expected += word.orbit[i].guess[0] > 0 && word.orbit[i].guess[2] < LAST;
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    bool all = true, met = false;
    for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) all = all && o->first[ph] == TRUTH_TRUE;
    first += all;
    for (slong k = 0; k < word.n; k++) met = met || is_at(o, word.orbit[k].guess);
    ck_assert_msg(met == all, "%s: solution %ld", s->name, (long)i);
  }
  ck_assert_int_eq((int)first, (int)expected);
}

/* On a slow belt there are tens of thousands: a list of some of them, which says so, and a verdict by these. */
TEST(more_than_a_list_holds) {
  OWNED(dyn_orbits) list;
  NUMBERS(fmpq, slow);
  fmpq_set_si(slow, 1, 10000);
  FREED_PARAMS fmpq *p = rationals_of(later_set(0)->params, N_PARAMS);
  fmpq_swap(slow, p + P_V);
  ck_assert_int_eq(dyn_branches_find(&list, p, 20, 128, DYN_CELLS), SS_OK);
  ck_assert(!list.complete && list.gap == GAP_MANY && list.n == MOST_BRANCHES && list.cells < DYN_CELLS);
  for (slong i = 1; i < list.n; i++) {
    const struct dyn_orbit *a = &list.orbit[i - 1], *b = &list.orbit[i];
    ck_assert(arb_is_positive(a->t[PHASE_D]) &&
              (!arb_overlaps(a->t[PHASE_H], b->t[PHASE_H]) || !arb_overlaps(a->t[PHASE_C], b->t[PHASE_C]) ||
               !arb_overlaps(a->t[PHASE_GAMMA], b->t[PHASE_GAMMA])));
  }
}

/* A smaller bound of t_c leaves out what lies beyond it; too small a budget says that it was. */
TEST(bounds_and_budgets) {
  const struct known_set *s = later_set(0);
  OWNED(dyn_orbits) list, few, none;
  int within = 0;
  for (int k = 0; k < s->n; k++) within += atof(s->orbit[k][1 + PHASE_H]) < 11;
  dyn_branches_find(&list, s->params, 11, 128, DYN_CELLS);
  ck_assert(list.complete);
  ck_assert_int_eq((int)list.n, within);
  dyn_branches_find(&few, s->params, LAST, 128, 500);
  ck_assert(!few.complete);
  ck_assert_int_eq(few.gap, GAP_BUDGET);
  fmpq wrong[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) wrong[i] = s->params[i];
  wrong[P_CHI] = s->params[P_ETA]; /* 1 */
  ck_assert_int_eq(dyn_branches_find(&none, wrong, LAST, 128, DYN_CELLS), SS_DOMAIN);
}

/* --- Claims --- */

#define SIX "claim own\n  section: periodic\n  kind: solutions\n  statement: text-six-equations\n"
#define TWO "  kept: yes\n  at: chi = 71/100, eta = 6/5, V = 19/10, e1 = 59/10, e2 = 158/1000\n"

CASE("claims", .each = {paper_open, paper_close});

/* Beside a claim that lists the constraints, one on the solutions that keep them alone must list them all. */
TEST(solutions_keep_all_that_is_listed) {
  static const char list[] = "claim list\n  section: periodic\n  kind: constraints\n  constraints: eq-51, eq-59#2\n";
  static const char *const listed[] = {"eq-51, eq-57#1", "eq-59#2, eq-51"};
  for (int i = 0; i < 2; i++) {
    OWNED(text) claims = {0};
    OWNED(audit_result) r;
    text_printf(&claims, "%s%s  count: 2\n%s  constraints: %s\n", list, SIX, TWO, listed[i]);
    if (i)
      goes_well(judge_text(&r, &the_paper.model, text_str(&claims), &the_paper.scene, "own", &d));
    else
      fails_with(judge_text(&r, &the_paper.model, text_str(&claims), &the_paper.scene, "own", &d),
                 "with kept all those of list are needed");
  }
}
