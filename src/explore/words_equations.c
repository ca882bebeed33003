/* The equations of a word over any number type: each phase's closed form, one event for each, and the return.

   Each unknown has a column: a difference of motions that is carried along with the motion itself, so that defects and
   derivatives come out of one pass. */
#include "words_impl.h"

struct word_event word_event_of(const struct mech_word *w, int phase) {
  struct word_event e;
  e.mass = mech_event(&e.end, w->phase[phase], w->phase[(phase + 1) % w->n]);
  return e;
}

void word_law_make(struct word_law *m, struct calc *c, const struct word_orbits *of, const fmpq *params,
                   const fmpq *const u_r[2]) {
  m->w = &of->word;
  m->n_free = mech_free(m->free, &of->m, &of->word);
  val chi = calc_q(c, params + P_CHI), eta = calc_q(c, params + P_ETA);
  motion_law_make(&m->law, c, chi, eta, calc_q(c, params + P_V), true);
  m->difference = m->law;
  m->difference.V = m->difference.gap = m->law.zero;
  for (int i = 0; i < 2; i++) {
    m->e[i] = calc_q(c, params + P_E1 + i);
    m->over[i] = NULL;
    if (!u_r[i]) continue;
    NUMBERS(fmpq, twice);
    fmpq_sub(twice, u_r[i], params + P_E1 + i);
    fmpq_mul_2exp(twice, twice, 1);
    m->over[i] = calc_q(c, twice);
  }
}

/* u_i - f_i of a slipping mass, before the factor eta. */
static val pull_on(struct calc *c, const struct word_law *m, char mode, int mass, val w, bool difference) {
  return calc_neg(c, mode == '+' && !difference ? calc_add(c, w, m->over[mass]) : w);
}

void word_motion(struct motion *out, struct calc *c, const struct word_law *m, const char *phase,
                 const val state[N_STATE], bool difference) {
  const int slips[2] = {phase[0] != 's', phase[1] != 's'};
  struct motion_start at;
  for (int i = 0; i < 2; i++) {
    at.force[i] = state[WORD_W1 + i];
    at.slip[i] = state[WORD_P1 + i];
    at.pull[i] = pull_on(c, m, phase[i], i, at.force[i], difference);
  }
  motion_make(out, c, difference ? &m->difference : &m->law, slips, &at);
}

/* The vector field. */
static void vector_field(val out[N_STATE], struct calc *c, const struct word_law *m, const char *phase,
                         const val state[N_STATE]) {
  out[WORD_W1] = calc_add(c, m->law.gap, flow_force(c, 0, m->law.chi, state + WORD_P1));
  out[WORD_W2] = flow_force(c, 1, m->law.chi, state + WORD_P1);
  for (int i = 0; i < 2; i++) {
    val pull = phase[i] == 's' ? m->law.zero : pull_on(c, m, phase[i], i, state[WORD_W1 + i], false);
    out[WORD_P1 + i] = i == 0 ? pull : calc_mul(c, m->law.eta, pull);
  }
}

val word_event_value(struct calc *c, const struct word_law *m, const struct word_event *e, const val state[N_STATE]) {
  if (e->end == MECH_REACHES) return state[WORD_P1 + e->mass];
  val w = state[WORD_W1 + e->mass], limit = m->e[e->mass];
  if (e->end == MECH_BREAKS_SLOWER) return calc_sub(c, w, limit);
  return calc_add(c, w, calc_add(c, limit, m->over[e->mass]));
}

/* How that changes with the state. */
static val event_slope(const struct word_event *e, const val change[N_STATE]) {
  return change[(e->end == MECH_REACHES ? WORD_P1 : WORD_W1) + e->mass];
}

void word_settle(val state[N_STATE], const struct word_law *m, const char *phase) {
  for (int i = 0; i < 2; i++)
    if (phase[i] == 's') state[WORD_P1 + i] = m->law.zero;
}

void word_start(val state[N_STATE], struct calc *c, const struct word_law *m, const val *free) {
  struct word_event e = word_event_of(m->w, m->w->n - 1);
  for (int i = 0; i < N_STATE; i++) state[i] = m->law.zero;
  if (e.end != MECH_REACHES) {
    val limit = m->e[e.mass];
    state[WORD_W1 + e.mass] = e.end == MECH_BREAKS_SLOWER ? limit : calc_neg(c, calc_add(c, limit, m->over[e.mass]));
  }
  for (int i = 0; i < m->n_free; i++) state[m->free[i]] = free[i];
}

void word_equations(val *f, val *j, struct calc *c, const struct word_law *m, const val *x) {
  const struct mech_word *w = m->w;
  const int *free = m->free;
  val state[N_STATE], column[WORD_UNKNOWNS][N_STATE];
  int n = m->n_free, size = w->n + n;
  word_start(state, c, m, x + w->n);
  for (int k = 0; k < n; k++)
    for (int i = 0; i < N_STATE; i++) column[w->n + k][i] = i == free[k] ? calc_d(c, 1) : m->law.zero;
  for (int p = 0; p < w->n; p++) {
    struct word_event e = word_event_of(w, p);
    const char *now = w->phase[p], *next = w->phase[(p + 1) % w->n];
    struct motion motion;
    word_motion(&motion, c, m, now, state, false);
    motion_at(state, c, &motion, x[p]);
    f[p] = word_event_value(c, m, &e, state);
    for (int k = 0; k < size; k++) {
      bool moves = k <= p || k >= w->n;
      if (moves && k == p) {
        vector_field(column[k], c, m, now, state);
      } else if (moves) {
        word_motion(&motion, c, m, now, column[k], true);
        motion_at(column[k], c, &motion, x[p]);
      }
      j[p * size + k] = moves ? event_slope(&e, column[k]) : m->law.zero;
      if (moves) word_settle(column[k], m, next);
    }
    word_settle(state, m, next);
  }
  for (int i = 0; i < n; i++) {
    f[w->n + i] = calc_sub(c, state[free[i]], x[w->n + i]);
    for (int k = 0; k < size; k++) {
      val slope = column[k][free[i]];
      j[(w->n + i) * size + k] = k == w->n + i ? calc_sub(c, slope, calc_d(c, 1)) : slope;
    }
  }
}
