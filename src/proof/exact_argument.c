/* Arguments on exact motions, see exact_argument.h. */
#include "exact_argument.h"

#include "exact_law.h"
#include "num/calc.h"

typedef fmpz_mpoly_q_struct element;

enum { MAX_FACTS = EXACT_CONDITIONS + 2 + MAX_CONDITIONS };

/* An orbit in the phase of the condition; every state that a condition may name is there. */
static void motion_begin(struct exact_motion *m, const struct condition *c, int anchor, enum exact_time time) {
  const struct tape none = {.n = 0};
  const struct point_spec spec = {.kind = POINT_ORBIT, .phase = c->phase, .admissible = true};
  const struct exact_attempt attempt = {.anchor = anchor, .time = time};
  exact_motion_init(m, &attempt, &spec, false, NULL, &none);
  m->first_state = 0;
}

static bool margin_of(element *z, struct exact_motion *m, const struct condition *c) {
  struct exact_vec v;
  bool ok = exact_eval(&v, m->field, &c->s.tape) == SS_OK;
  if (ok) num_exact.set(z, &v.x[0]);
  exact_vec_clear(&v);
  return ok;
}

/* What is positive at the motion's time: (2), the friction of sliding, and the premises that speak of that time or of
   none. */
static int collect(struct num_vec *facts, struct exact_motion *m, const struct condition *goal,
                   const struct conditions *premises) {
  static const char *const sliding[2] = {"u_s1", "u_s2"};
  int n = exact_law_margins(facts, m);
  for (int i = 0; i < 2; i++) n += exact_symbol(num_vec_at(facts, n), m->field, sliding[i]) == SS_OK;
  for (int k = 0; k < premises->n; k++) {
    const struct condition *c = &premises->at[k];
    bool there = !c->moving || (m->attempt.time == TIME_INSIDE && c->phase == goal->phase);
    if (there && !c->equality) n += margin_of(num_vec_at(facts, n), m, c);
  }
  return n;
}

/* The margin, or its rate, at that time of the phase. */
static bool follows_at(const struct condition *goal, const struct conditions *premises, int anchor,
                       enum exact_time time, bool rate) {
  struct exact_motion m;
  motion_begin(&m, goal, anchor, time);
  struct calc c = exact_calc(m.field);
  struct num_vec facts = calc_vec(&c, MAX_FACTS);
  element *margin = calc_new(&c);
  bool ok = margin_of(margin, &m, goal);
  if (ok && rate) ok = exact_derivative(margin, m.field, margin, "tau") == SS_OK;
  if (ok && goal->equality)
    ok = exact_is_zero(m.field, margin);
  else if (ok)
    ok = exact_follows(&m, margin, &facts, collect(&facts, &m, goal, premises));
  calc_clear(&c);
  exact_motion_clear(&m);
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

int exact_friction_slope(const struct condition *cond, int i) {
  struct exact_motion m;
  motion_begin(&m, cond, 4, TIME_INSIDE);
  struct calc c = exact_calc(m.field);
  struct num_vec none = calc_vec(&c, 1);
  element *margin = calc_new(&c);
  int slope = -1;
  if (margin_of(margin, &m, cond) && exact_derivative(margin, m.field, margin, i ? "u_s2" : "u_s1") == SS_OK)
    slope = exact_is_zero(m.field, margin) ? 0 : exact_follows(&m, margin, &none, 0) ? 1 : -1;
  calc_clear(&c);
  exact_motion_clear(&m);
  return slope;
}
