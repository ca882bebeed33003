/* Arguments on exact motions, see exact_argument.h. */
#include "exact_argument.h"

#include "num/calc.h"

enum { N_SURE = 6, MAX_FACTS = EXACT_CONDITIONS + N_SURE + MAX_CONDITIONS };

bool exact_margin(fmpz_mpoly_q_struct *z, struct exact_motion *m, const struct tape *t) {
  struct num_vec v;
  bool ok = exact_eval(&v, &m->c, m->field, t) == SS_OK;
  if (ok) num_exact.set(z, num_vec_at(&v, 0));
  return ok;
}

int exact_premises(struct num_vec *facts, int n, struct exact_motion *m, const struct conditions *premises) {
  for (int k = 0; k < premises->n; k++) {
    const struct condition *c = &premises->at[k];
    bool there = !c->moving || (m->attempt.time == TIME_INSIDE && c->phase == m->spec.phase);
    if (there && c->strict) n += exact_margin(num_vec_at(facts, n), m, &c->s.tape);
  }
  return n;
}

/* What is positive at the motion's time: (2), the lengths of the phases, the friction of sliding, and the premises. */
static int collect(struct num_vec *facts, struct exact_motion *m, const struct conditions *premises) {
  static const char *const sure[] = {"t_a", "t_b", "t_c", "t_d", "u_s1", "u_s2"};
  int n = exact_law_margins(facts, NULL, m);
  for (int i = 0; i < N_SURE; i++) n += exact_symbol(num_vec_at(facts, n), m->field, sure[i]) == SS_OK;
  return exact_premises(facts, n, m, premises);
}

/* The margin, or its rate, at that time of the phase. */
static bool follows_at(const struct condition *goal, const struct conditions *premises, int anchor,
                       enum exact_time time, bool rate) {
  OWNED(exact_motion) m;
  exact_orbit_init(&m, goal->phase, anchor, time, false);
  struct num_vec facts = calc_vec(&m.c, MAX_FACTS);
  element *margin = calc_new(&m.c);
  bool ok = exact_margin(margin, &m, &goal->s.tape);
  if (ok && rate) ok = exact_derivative(margin, m.field, margin, "tau") == SS_OK;
  if (ok && goal->equality)
    ok = exact_is_zero(margin);
  else if (ok)
    ok = exact_follows(&m, margin, &facts, collect(&facts, &m, premises));
  return ok;
}

bool exact_argument(const struct condition *goal, const struct conditions *premises) {
  bool ok = false;
  for (int anchor = 4; !ok && anchor >= 0; anchor--) {
    ok = follows_at(goal, premises, anchor, TIME_INSIDE, false);
    if (!ok && goal->moving && !goal->equality)
      ok = follows_at(goal, premises, anchor, TIME_START, false) &&
           follows_at(goal, premises, anchor, TIME_INSIDE, true);
  }
  return ok;
}

bool exact_vanishes(const struct condition *c, enum exact_time time) {
  static const struct conditions none = {.n = 0};
  struct condition zero = *c; /* borrowed */
  bool is = false;
  zero.equality = true;
  for (int anchor = 4; !is && anchor >= ANCHOR_BACK; anchor--) is = follows_at(&zero, &none, anchor, time, false);
  return is;
}

int exact_friction_slope(const struct condition *cond, int i) {
  OWNED(exact_motion) m;
  exact_orbit_init(&m, cond->phase, 4, TIME_INSIDE, false);
  struct num_vec none = calc_vec(&m.c, 1);
  element *margin = calc_new(&m.c);
  int slope = -1;
  if (exact_margin(margin, &m, &cond->s.tape) &&
      exact_derivative(margin, m.field, margin, i ? "u_s2" : "u_s1") == SS_OK)
    slope = exact_is_zero(margin) ? 0 : exact_follows(&m, margin, &none, 0) ? 1 : -1;
  return slope;
}
