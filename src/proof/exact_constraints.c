/* Lists of constraints by exact algebra, see exact_constraints.h. */
#include "exact_constraints.h"

#include "exact_argument.h"
#include "num/calc.h"

enum { MAX_FACTS = MAX_CONDITIONS + EXACT_CONDITIONS };

/* The i-th margin.  Where it follows at the time t alone it is positive at the start of the phase, too, when it falls
   along the phase. */
static bool margin_follows(struct exact_motion *m, const struct num_vec *law, const struct exact_bound *bound, int i,
                           const struct num_vec *facts, int n) {
  if (exact_follows(m, num_vec_at(law, i), facts, n)) return true;
  int now = 0;
  while (now < i && !(bound[now].force && bound[now].mass == bound[i].mass && !bound[now].start)) now++;
  if (!bound[i].start || now == i || !exact_follows(m, num_vec_at(law, now), facts, n)) return false;
  OWNED(calc) c = exact_calc(m->field);
  element *rate = calc_new(&c);
  c.status |= exact_derivative(rate, m->field, num_vec_at(law, now), "tau");
  val falls = calc_neg(&c, rate);
  return c.status == SS_OK && exact_follows(m, falls, facts, n);
}

/* All that (2) asks in the phase, from the list. */
static bool law_follows(const struct conditions *list, enum phase ph, int anchor) {
  OWNED(exact_motion) m;
  struct exact_bound bound[EXACT_CONDITIONS];
  exact_orbit_init(&m, ph, anchor, TIME_INSIDE, false);
  struct num_vec law = calc_vec(&m.c, EXACT_CONDITIONS), facts = calc_vec(&m.c, MAX_FACTS);
  int n_law = exact_law_margins(&law, bound, &m), n = exact_premises(&facts, 0, &m, list);
  bool ok = n_law > 0;
  for (int i = 0; ok && i < n_law; i++) ok = margin_follows(&m, &law, bound, i, &facts, n);
  return ok;
}

/* t_a > 0, without which there is no stick phase; the other times are those of events, and positive. */
static bool stick_phase_follows(const struct conditions *list) {
  OWNED(exact_motion) m;
  exact_orbit_init(&m, PHASE_D, 4, TIME_START, false);
  struct num_vec facts = calc_vec(&m.c, MAX_FACTS);
  element *time = calc_new(&m.c);
  int n = exact_premises(&facts, 0, &m, list);
  return exact_symbol(time, m.field, "t_a") == SS_OK && exact_follows(&m, time, &facts, n);
}

bool exact_constraints(const struct conditions *list) {
  const struct conditions none = {.n = 0};
  bool ok = stick_phase_follows(list);
  for (int k = 0; ok && k < list->n; k++) ok = exact_argument(&list->at[k], &none);
  for (int ph = 0; ok && ph < N_PHASES; ph++)
    ok = law_follows(list, (enum phase)ph, 4) || law_follows(list, (enum phase)ph, 0);
  return ok;
}

static int find(const struct exact_bound *bound, int n, int mass, bool start, bool lower) {
  for (int i = 0; i < n; i++)
    if (bound[i].force && bound[i].mass == mass && bound[i].start == start && bound[i].lower == lower) return i;
  return -1;
}

/* u_ri + f_i does not decrease along the phase. */
static bool limit_rises(enum phase ph, int mass) {
  OWNED(exact_motion) m;
  struct exact_bound bound[EXACT_CONDITIONS];
  exact_orbit_init(&m, ph, 4, TIME_INSIDE, false);
  struct num_vec law = calc_vec(&m.c, EXACT_CONDITIONS);
  element *rate = calc_new(&m.c);
  int n = exact_law_margins(&law, bound, &m), i = find(bound, n, mass, false, false);
  if (i >= 0) m.c.status |= exact_derivative(rate, m.field, num_vec_at(&law, i), "tau");
  val rises = calc_neg(&m.c, rate); /* as u_ri - f_i falls */
  return i >= 0 && m.c.status == SS_OK && (exact_is_zero(rises) || exact_follows(&m, rises, &law, n));
}

/* u_ri + f_i = 2 (u_ri - least) where the phase begins. */
static bool starts_at(const struct tape *least, enum phase ph, int mass) {
  OWNED(exact_motion) m;
  struct exact_bound bound[EXACT_CONDITIONS];
  exact_orbit_init(&m, ph, 4, TIME_INSIDE, true);
  struct num_vec law = calc_vec(&m.c, EXACT_CONDITIONS);
  element *value = calc_new(&m.c), *limit = calc_new(&m.c);
  int n = exact_law_margins(&law, bound, &m), i = find(bound, n, mass, true, true);
  bool ok = i >= 0 && exact_margin(value, &m, least);
  if (ok) m.c.status |= exact_motion_bind(limit, m.field, mass ? "u_r2" : "u_r1", &m);
  val twice = calc_mul(&m.c, calc_d(&m.c, 2), calc_sub(&m.c, limit, value));
  return ok && m.c.status == SS_OK && exact_equal(m.field, num_vec_at(&law, i), twice);
}

bool exact_least_friction(const struct tape *least, int mass) {
  static const enum phase sticks[2][2] = {{PHASE_C, PHASE_D}, {PHASE_D, PHASE_GAMMA}}; /* one after the other */
  return starts_at(least, sticks[mass][0], mass) && limit_rises(sticks[mass][0], mass) &&
         limit_rises(sticks[mass][1], mass);
}
