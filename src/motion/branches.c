/* Later roots: the search of branches.h. */
#include "branches.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/work.h"
#include "cell.h"
#include "complete.h"
#include "num/pi.h"
#include "orbit_judge.h"
#include "warm.h"

enum { DEEPEST = 44, UNITS_OF_LATER_CELL = 12, FREE_LATER_CELLS = 1 << 13, STRIPS_OF_TURN = 16 };

struct search {
  struct disk_params params;
  struct commons zeros;
  long cells, budget;
  double dir; /* as in cell_look, for the strips at hand */
  bool spent, stuck;
  double where[2];
};

/* A rectangle of (t_b modulo 2 pi, t_c). */
struct patch {
  double from[2], to[2];
};

static void search_patch(struct search *s, struct patch a, int depth);

static void halve(struct search *s, const struct patch *a, int side, int depth) {
  double middle = 0.5 * (a->from[side] + a->to[side]);
  struct patch low = *a, high = *a;
  low.to[side] = high.from[side] = middle;
  search_patch(s, low, depth + 1);
  search_patch(s, high, depth + 1);
}

static void search_patch(struct search *s, struct patch a, int depth) {
  struct strip p;
  struct clock middle;
  struct cell c;
  struct common zero;
  s->spent = s->spent || s->cells >= s->budget;
  if (s->spent || s->zeros.n > MOST_BRANCHES) return;
  s->cells++;
  if (s->cells % FREE_LATER_CELLS == 0) work_add((unsigned long long)FREE_LATER_CELLS * UNITS_OF_LATER_CELL);
  strip_make(&p, &s->params, a.from[0], a.to[0], a.to[0] - a.from[0]);
  struct turns k = strip_turns(&p, true);
  if (turns_count(&k) == 0) return;
  clock_set(&middle, &s->params, 0.5 * (a.from[1] + a.to[1]));
  cell_at(&c, &p, &middle);
  c.early = disk_up(fmax(a.to[1] - middle.t, middle.t - a.from[1]));
  c.first = a.from[1] == 0;
  c.later = true;
  enum look seen = cell_look(&zero, &c, &k, s->dir);
  if (seen == LOOK_ZERO) commons_add(&s->zeros, zero, &p, middle.t);
  if (seen != LOOK_OPEN) return;
  if (depth < DEEPEST) {
    halve(s, &a, cell_wide_in_angle(&c) ? 0 : 1, depth);
  } else if (!s->stuck) {
    s->stuck = true;
    s->where[0] = p.angle + 2 * PI * fmax(zero.k, 0);
    s->where[1] = middle.t;
  }
}

/* Strips of the angle from low to high, stretches of t_c as long; longer where the budget ends before the last. */
static void search_band(struct search *s, double low, double high, double t_c_max) {
  double wide = 2 * PI / STRIPS_OF_TURN;
  int strips = (int)ceil((high - low) / wide);
  long stretches = (long)fmin(ceil(t_c_max / wide), (double)s->budget + 1);
  for (int i = 0; i < strips; i++)
    for (long k = 0; k < stretches && !s->spent; k++)
      search_patch(s,
                   (struct patch){{low + (high - low) * i / strips, t_c_max * (double)k / (double)stretches},
                                  {i + 1 < strips ? low + (high - low) * (i + 1) / strips : high,
                                   k + 1 < stretches ? t_c_max * (double)(k + 1) / (double)stretches : t_c_max}},
                   0);
}

/* p starts below zero up to the crest of the rise, and above it from there to the end of the turn. */
static bool search_run(struct search *s, const fmpq *params, double t_c_max, long budget) {
  *s = (struct search){.budget = budget, .dir = 1};
  if (!disk_params_init(&s->params, params)) return false;
  search_band(s, 0, disk_high(s->params.fall), t_c_max);
  s->dir = -1;
  search_band(s, disk_low(s->params.fall), 2 * PI * (1 + 0x1p-50), t_c_max);
  return true;
}

/* --- From zeros to solutions. --- */

/* Phase C ends a whole turn later: m2 is again where it was, the belt's way in t_a is shorter. */
static void turn_once(struct dyn_orbit *o, const fmpq *params, slong prec) {
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  val omega = calc_sqrt(&c, calc_mul(&c, calc_q(&c, params + P_CHI), calc_q(&c, params + P_ETA)));
  val whole = calc_div(&c, calc_mul(&c, calc_d(&c, 2), calc_pi(&c)), omega);
  val way = calc_mul(&c, calc_q(&c, params + P_V), whole);
  arb_add(o->t[PHASE_C], o->t[PHASE_C], whole, prec);
  arb_sub(o->t[PHASE_D], o->t[PHASE_D], whole, prec);
  arb_add(o->z10, o->z10, way, prec);
  arb_add(o->z20, o->z20, way, prec);
  for (int ph = 0; ph < N_PHASES; ph++) o->guess[ph] = num_arb.get_d(o->t[ph]);
}

/* q takes both signs in phase C where it lasts half a turn of m2 or longer. */
static void say_late(struct dyn_orbit *o) {
  o->first[PHASE_C] = o->holds[COND_C_V2] = o->admissible = TRUTH_FALSE;
}

/* Every t_d > 0 that leaves t_a > 0. */
static void add_turns(struct dyn_orbits *list, struct dyn_orbit *o, const fmpq *params, slong prec) {
  OWNED(dyn_orbit) at;
  dyn_orbit_copy(&at, o);
  if (!arb_is_positive(at.t[PHASE_C])) {
    turn_once(&at, params, prec);
    say_late(&at);
  }
  while (arb_is_positive(at.t[PHASE_D]) && list->n < MOST_BRANCHES) {
    list->orbit = ss_realloc(list->orbit, (size_t)(list->n + 1) * sizeof *list->orbit);
    dyn_orbit_copy(&list->orbit[list->n++], &at);
    turn_once(&at, params, prec);
    say_late(&at);
    at.holds[COND_TA] = TRUTH_TRUE;
  }
  if (arb_is_positive(at.t[PHASE_D])) dyn_leave_gap(list, GAP_MANY, 0, 0);
  if (!arb_is_negative(at.t[PHASE_D])) dyn_leave_gap(list, GAP_DOUBLE, at.guess[PHASE_GAMMA], at.guess[PHASE_H]);
}

/* The solutions of one zero. */
static void settle(struct dyn_orbits *list, const struct search *s, const struct common *z, const fmpq *params,
                   slong prec) {
  OWNED(dyn_orbit) o;
  truth first;
  struct dyn_place at = common_place(z, &s->params);
  int status = dyn_orbit_near(&o, &first, params, at, prec, NULL);
  struct known found = known_of(&o, z->k);
  truth later = TRUTH_UNKNOWN; /* than 0 and no later than asked for */
  if (status == SS_OK && known_is(&found, z)) {
    bool before = arb_is_nonpositive(o.t[PHASE_GAMMA]) || arb_is_nonpositive(o.t[PHASE_H]);
    bool after = arb_is_positive(o.t[PHASE_GAMMA]) && arb_is_positive(o.t[PHASE_H]);
    NUMBERS(arb, left);
    arb_set_d(left, list->t_c_max);
    arb_sub(left, left, o.t[PHASE_H], prec);
    later = before || arb_is_negative(left) ? TRUTH_FALSE : after && arb_is_positive(left) ? TRUTH_TRUE : TRUTH_UNKNOWN;
  }
  if (later == TRUTH_UNKNOWN || arb_contains_zero(o.t[PHASE_C]))
    dyn_leave_gap(list, GAP_DOUBLE, at.tb, at.tc);
  else if (later == TRUTH_TRUE)
    add_turns(list, &o, params, prec);
}

static int by_times(const void *x, const void *y) {
  const struct dyn_orbit *a = x, *b = y;
  int c = arf_cmp(arb_midref(a->t[PHASE_H]), arb_midref(b->t[PHASE_H]));
  return c ? c : arf_cmp(arb_midref(a->t[PHASE_C]), arb_midref(b->t[PHASE_C]));
}

int dyn_branches_find(struct dyn_orbits *list, const fmpq *params, double t_c_max, slong prec, long budget) {
  struct search s;
  *list = (struct dyn_orbits){.gap = GAP_UNTRIED, .t_c_max = t_c_max};
  if (!dyn_in_domain(params, N_PARAMS)) return SS_DOMAIN;
  bool fits = search_run(&s, params, t_c_max, budget);
  list->cells = s.cells;
  if (!fits) dyn_leave_gap(list, GAP_RANGE, 0, 0);
  if (s.zeros.n > MOST_BRANCHES) dyn_leave_gap(list, GAP_MANY, 0, 0);
  if (s.spent) dyn_leave_gap(list, GAP_BUDGET, 0, 0);
  if (s.stuck) dyn_leave_gap(list, GAP_DOUBLE, s.where[0], s.where[1]);
  for (size_t i = 0; i < s.zeros.n && list->n < MOST_BRANCHES; i++) settle(list, &s, &s.zeros.at[i], params, prec);
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].grazing) dyn_leave_gap(list, GAP_GRAZING, list->orbit[i].guess[1], list->orbit[i].guess[2]);
  list->complete = list->gap == GAP_UNTRIED;
  if (list->n > 1) qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, by_times);
  free(s.zeros.at);
  disk_params_clear(&s.params);
  return fits ? SS_OK : SS_UNABLE;
}
