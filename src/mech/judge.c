/* Whether the conditions of each phase hold along it, see orbit.h.

   A condition is g(s) = c y(s) < 0 with y' = A y.  On a step from a of length h, with Y an enclosure of y there,
       g(a + s) = c y(a) + s c A y(a) + s^2/2 c A^2 Y,       g'(a + s) = c A y(a) + s c A^2 Y,
   and g is negative on the step where the first is, or where g is exactly zero at one end and its first derivative that
   is not zero there has one sign: at the start of a phase g' for the mass that has just rebounded or begun to slip (g''
   where its static limit is its sliding friction, or it rebounds without velocity) and the third derivative for the
   distance of one that has just left the obstacle at which it was at rest; at the end g' for the event.  A step on
   which some condition is open is halved; after 20000 steps of a phase its conditions are left undecided. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/work.h"
#include "equations.h"

enum { FINEST = 40, MOST_STEPS = 20000, FRESH = 32, FACTS_OF_MASS = 4, UNITS_OF_STEP = 4, ROWS = 4 };

/* A condition under way. */
struct watch {
  struct mech_fact *fact;
  truth *result;
  arb_mat_t row[ROWS]; /* c, c A, c A^2, c A^3 */
  int zeros;           /* how many of g, g', g'' are exactly zero at the start */
  bool open;           /* not yet settled to be false or unknown */
};

/* exp(A h), and a ball with exp(A s) for 0 <= s <= h: made for each length h of a step when it is first needed. */
struct flows {
  bool made;
  arb_mat_t whole, tube;
};

struct march {
  struct mech_equations *e;
  int phase, n_watches;
  struct watch watch[FACTS_OF_MASS * MECH_MASSES + 1];
  arb_t at, step, end; /* the time; the length of the step; of the phase */
  arb_mat_t y;         /* the state at the time */
  int level;           /* how often the first step is halved */
  struct flows flows[FINEST + 1];
};

/* From 0 to x, which is exact. */
static void up_to(arb_t z, const arb_t x) {
  arb_mul_2exp_si(z, x, -1);
  arb_get_mag(arb_radref(z), z);
}

/* Those of the present step. */
static const struct flows *flows_now(struct march *m) {
  slong side = m->e->side;
  struct flows *f = &m->flows[m->level];
  if (f->made) return f;
  NUMBERS(arb, span);
  arb_mat_init(f->whole, side, side);
  arb_mat_init(f->tube, side, side);
  mech_flow(f->whole, m->e, m->phase, m->step);
  up_to(span, m->step);
  mech_flow(f->tube, m->e, m->phase, span);
  f->made = true;
  return f;
}

static void value_of(arb_t z, const arb_mat_t row, const arb_mat_t y, slong prec) {
  arb_dot(z, NULL, 0, row->entries, 1, y->entries, 1, arb_mat_ncols(row), prec);
}

/* The bounds of a condition on a step: g, g' at its start and g'' on it; g' on it, (g - g(a))/s and g on it. */
enum { VALUE, RATE, CURVE, SLOPE, QUOTIENT, RANGE, N_BOUNDS };

static void make_bounds(arb_ptr b, const struct march *m, const struct watch *w, const arb_mat_t along) {
  slong prec = m->e->prec;
  NUMBERS(arb, s);
  value_of(b + VALUE, w->row[0], m->y, prec);
  value_of(b + RATE, w->row[1], m->y, prec);
  value_of(b + CURVE, w->row[2], along, prec);
  up_to(s, m->step);
  arb_mul(b + QUOTIENT, b + CURVE, s, prec);
  arb_add(b + SLOPE, b + QUOTIENT, b + RATE, prec);
  arb_mul_2exp_si(b + QUOTIENT, b + QUOTIENT, -1);
  arb_add(b + QUOTIENT, b + QUOTIENT, b + RATE, prec);
  arb_mul(b + RANGE, b + QUOTIENT, s, prec);
  arb_add(b + RANGE, b + RANGE, b + VALUE, prec);
}

/* One condition on the step: TRUTH_TRUE: it holds on it; FALSE: it is broken at one of its ends; UNKNOWN: neither is
   shown. after: the state at the end of the step, or NULL where the phase may end before. */
static truth on_step(const struct march *m, const struct watch *w, const arb_mat_t along, const arb_mat_struct *after,
                     bool last) {
  ARB_VECTOR(b, N_BOUNDS);
  make_bounds(b, m, w, along);
  int zeros = arb_is_zero(m->at) ? w->zeros : 0;
  bool meets = zeros == 0 && last && w->fact->ends && arb_is_positive(b + SLOPE);
  truth out;
  if (zeros == 3) value_of(b + CURVE, w->row[3], along, m->e->prec);
  if (zeros >= 2)
    out = mech_holds(b + CURVE);
  else if (meets || arb_is_negative(b + (zeros ? QUOTIENT : RANGE)))
    out = TRUTH_TRUE;
  else
    out = arb_is_positive(b + (zeros ? RATE : VALUE)) ? TRUTH_FALSE : TRUTH_UNKNOWN;
  if (out == TRUTH_UNKNOWN && after) {
    value_of(b + VALUE, w->row[0], after, m->e->prec);
    if (arb_is_positive(b + VALUE)) out = TRUTH_FALSE;
  }
  return out;
}

/* All conditions on the step ahead; true: they are settled on it, and the step is made. */
static bool make_step(struct march *m) {
  const struct flows *f = flows_now(m);
  NUMBERS(arb, next);
  bool all = true, finest = m->level == FINEST;
  SIZED(arb_mat, along, m->e->side, 1);
  SIZED(arb_mat, after, m->e->side, 1);
  arb_mat_mul(along, f->tube, m->y, m->e->prec);
  arb_mat_mul(after, f->whole, m->y, m->e->prec);
  arb_add(next, m->at, m->step, m->e->prec);
  bool last = arb_ge(next, m->end), before = arb_lt(next, m->end);
  for (int i = 0; i < m->n_watches; i++) {
    struct watch *w = &m->watch[i];
    if (!w->open) continue;
    truth t = on_step(m, w, along, before ? after : NULL, last);
    w->open = t == TRUTH_TRUE || (t == TRUTH_UNKNOWN && !finest);
    if (!w->open) *w->result = t;
    all = all && t != TRUTH_UNKNOWN;
  }
  if (all || finest) {
    arb_swap(m->at, next);
    arb_mat_swap(m->y, after);
  }
  return all || finest;
}

static bool any_open(const struct march *m) {
  for (int i = 0; i < m->n_watches; i++)
    if (m->watch[i].open) return true;
  return false;
}

/* The state from that at the phase's entry: its ball has grown with every step. */
static void refresh(struct march *m) {
  SIZED(arb_mat, flow, m->e->side, m->e->side);
  mech_flow(flow, m->e, m->phase, m->at);
  arb_mat_mul(m->y, flow, m->e->state[m->phase], m->e->prec);
}

/* Along the whole phase.  Steps are a power of two of the first, and shorter where something is open. */
static void march(struct march *m) {
  long steps = 0;
  while (any_open(m) && !arb_ge(m->at, m->end) && steps++ < MOST_STEPS) {
    work_add(UNITS_OF_STEP);
    if (steps % FRESH == 0) refresh(m);
    int change = !make_step(m) ? 1 : m->level > 0 ? -1 : 0;
    m->level += change;
    arb_mul_2exp_si(m->step, m->step, -change);
  }
  for (int i = 0; i < m->n_watches; i++)
    if (m->watch[i].open && arb_ge(m->at, m->end)) *m->watch[i].result = TRUTH_TRUE;
}

/* --- Which conditions --- */

static struct mech_fact *add_fact(struct mech_orbit *o, int phase, int mass, enum mech_rule rule) {
  struct mech_fact *f = &o->fact[o->n_facts++];
  *f =
      (struct mech_fact){.phase = phase, .mass = mass, .rule = rule, .holds = TRUTH_UNKNOWN, .reversed = TRUTH_UNKNOWN};
  return f;
}

/* The condition that ends the phase, the other way round. */
static void add_reversed(struct march *m, const struct watch *of) {
  struct watch *watch = &m->watch[m->n_watches++];
  *watch = (struct watch){.fact = of->fact, .result = &of->fact->reversed, .zeros = of->zeros, .open = true};
  for (int i = 0; i < ROWS; i++) {
    arb_mat_init(watch->row[i], 1, m->e->side);
    arb_mat_neg(watch->row[i], of->row[i]);
  }
}

/* Is the static limit the sliding friction, all over a box? */
static bool limit_is_sliding(const struct mech *m, int mass) {
  for (int i = 0; i < m->n_intervals; i++) {
    const struct mech_mass *moved = &m->moved[i].mass[mass];
    if (!fmpq_equal(moved->limit, moved->sliding)) return false;
  }
  return fmpq_equal(m->mass[mass].limit, m->mass[mass].sliding);
}

/* How many of g, g', g'' are zero at the start of a phase by the event of that mass at its start, for the condition
   of `end`. */
static int zeros_at_start(const struct mech *m, int i, char before, enum mech_end at_start, enum mech_end end) {
  const struct mech_mass *mass = &m->mass[i];
  if (at_start == MECH_LIFTS) return end == (before == 'a' ? MECH_HITS_ABOVE : MECH_HITS_BELOW) ? 3 : 0;
  if (mech_is_hit(at_start)) {
    if (end != at_start) return 0;
    return fmpq_is_zero(mass->stop[end == MECH_HITS_ABOVE].restitution) ? 2 : 1;
  }
  if (end != MECH_REACHES) return 0;
  return at_start != MECH_REACHES && limit_is_sliding(m, i) ? 2 : 1;
}

static void add_watch(struct march *m, struct mech_orbit *o, int mass, enum mech_rule rule, enum mech_end end) {
  const struct mech *of = m->e->m;
  const struct mech_word *w = m->e->w;
  const char *now = w->phase[m->phase], *before = w->phase[(m->phase + w->n - 1) % w->n];
  enum mech_end at_end, at_start;
  struct watch *watch = &m->watch[m->n_watches++];
  struct mech_fact *fact = add_fact(o, m->phase, mass, rule);
  *watch = (struct watch){.fact = fact, .result = &fact->holds, .open = true};
  fact->ends = mech_event(&at_end, now, w->phase[(m->phase + 1) % w->n]) == mass && at_end == end;
  bool changes = mech_event(&at_start, before, now) == mass;
  watch->zeros = changes ? zeros_at_start(of, mass, before[mass], at_start, end) : 0;
  for (int i = 0; i < ROWS; i++) {
    arb_mat_init(watch->row[i], 1, m->e->side);
    if (i == 0)
      mech_condition_balls(watch->row[i], of, mass, now[mass], end, m->e->prec);
    else
      arb_mat_mul(watch->row[i], watch->row[i - 1], m->e->rate[m->phase], m->e->prec);
  }
  if (fact->ends) add_reversed(m, watch);
}

static void add_watches(struct march *m, struct mech_orbit *o) {
  const char *phase = m->e->w->phase[m->phase];
  for (int i = 0; i < o->n; i++) {
    if (phase[i] == 's') {
      add_watch(m, o, i, MECH_BELOW, MECH_BREAKS_SLOWER);
      add_watch(m, o, i, MECH_ABOVE, MECH_BREAKS_FASTER);
    } else if (mech_rests(phase[i])) {
      add_watch(m, o, i, MECH_PRESSED, MECH_LIFTS);
      continue;
    } else if (phase[i] != '.') {
      add_watch(m, o, i, phase[i] == '-' ? MECH_SLOWER : MECH_FASTER, MECH_REACHES);
    }
    for (int s = 0; s < 2; s++)
      if (m->e->m->mass[i].stop[s].given) add_watch(m, o, i, MECH_CLEAR, s ? MECH_HITS_ABOVE : MECH_HITS_BELOW);
  }
}

/* The force of a mass that passes through at the end of the phase lies beyond its limit. */
static void judge_passing(struct mech_orbit *o, const struct mech_equations *e, int phase) {
  const char *now = e->w->phase[phase], *next = e->w->phase[(phase + 1) % e->w->n];
  enum mech_end end;
  int mass = mech_event(&end, now, next);
  if (end != MECH_REACHES || next[mass] == 's') return;
  NUMBERS(arb, g);
  SIZED(arb_mat, c, 1, e->side);
  mech_condition_balls(c, e->m, mass, 's', next[mass] == '-' ? MECH_BREAKS_SLOWER : MECH_BREAKS_FASTER, e->prec);
  value_of(g, c, e->state[phase + 1], e->prec);
  add_fact(o, phase, mass, MECH_BEYOND)->holds = truth_not(mech_holds(g));
}

/* A power of two below an eighth of the phase and below 1/2 over the norm of A without its column of constants, which
   says how far the state goes and not how fast it changes its way; the whole phase where every mass sticks. */
static void first_step(struct march *m) {
  slong states = m->e->side - 1;
  NUMBERS(mag, norm);
  NUMBERS(arf, least);
  arb_mat_t linear;
  arb_mat_window_init(linear, m->e->rate[m->phase], 0, 0, states, states);
  arb_mat_bound_inf_norm(norm, linear);
  arb_mat_window_clear(linear);
  arb_get_lbound_arf(least, m->end, 64);
  bool linear_in_time = !m->e->m->n_loads && strspn(m->e->w->phase[m->phase], "s") == (size_t)m->e->m->n;
  slong bits = fmpz_get_si(ARF_EXPREF(least)) - (linear_in_time ? 0 : 4);
  if (!linear_in_time && !mag_is_zero(norm)) bits = FLINT_MIN(bits, -1 - fmpz_get_si(MAG_EXPREF(norm)));
  arb_one(m->step);
  arb_mul_2exp_si(m->step, m->step, bits);
}

static void judge_phase(struct mech_orbit *o, struct mech_equations *e, int phase) {
  FREED struct march *m = ss_malloc(sizeof *m);
  *m = (struct march){.e = e, .phase = phase};
  arb_mat_init(m->y, e->side, 1);
  arb_mat_set(m->y, e->state[phase]);
  arb_set(m->end, o->t + phase);
  add_watches(m, o);
  if (o->fact[phase].holds == TRUTH_TRUE) {
    first_step(m);
    march(m);
  }
  for (int i = 0; i < m->n_watches; i++)
    for (int k = 0; k < ROWS; k++) arb_mat_clear(m->watch[i].row[k]);
  arb_mat_clear(m->y);
  for (int i = 0; i <= FINEST; i++) {
    if (!m->flows[i].made) continue;
    arb_mat_clear(m->flows[i].whole);
    arb_mat_clear(m->flows[i].tube);
  }
  arb_clear(m->end);
  arb_clear(m->step);
  arb_clear(m->at);
  judge_passing(o, e, phase);
}

void mech_judge(struct mech_orbit *o, struct mech_equations *e) {
  int phases = o->word.n;
  free(o->fact);
  o->n_facts = 0;
  o->fact = ss_malloc((size_t)phases * (2 + FACTS_OF_MASS * (size_t)o->n) * sizeof *o->fact);
  for (int k = 0; k < phases; k++) add_fact(o, k, 0, MECH_LENGTH)->holds = num_ball_positive(o->t + k);
  for (int k = 0; k < phases; k++) judge_phase(o, e, k);
}
