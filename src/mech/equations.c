/* Single shooting over a word: one state, carried through the phases with its derivatives. */
#include "equations.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

/* The obstacle at which a mass is at the entry of the first phase; NULL: at none. */
static const struct mech_stop *stop_at_entry(const struct mech *m, const struct mech_word *w, int i) {
  enum mech_end end;
  const char *before = w->phase[w->n - 1], *now = w->phase[0];
  bool changes = mech_event(&end, before, now) == i, lifts = changes && end == MECH_LIFTS;
  char mode = lifts ? before[i] : now[i];
  bool above = mech_rests(mode) ? mode == 'a' : end == MECH_HITS_ABOVE;
  return mech_rests(mode) || (changes && mech_is_hit(end)) ? &m->mass[i].stop[above] : NULL;
}

void mech_rate_balls(arb_mat_t a, const struct mech *m, const char *phase, slong prec) {
  SIZED(fmpq_mat, exact, m->states + 1, m->states + 1);
  mech_rate(exact, m, phase);
  arb_mat_set_fmpq_mat(a, exact, prec);
}

void mech_condition_balls(arb_mat_t row, const struct mech *m, int mass, char mode, enum mech_end end, slong prec) {
  SIZED(fmpq_mat, exact, 1, m->states + 1);
  mech_condition(exact, m, mass, mode, end);
  arb_mat_set_fmpq_mat(row, exact, prec);
}

/* The coordinate at which a condition is zero, from the others. */
static void pin(struct mech_equations *e, int at, int mass, enum mech_end end, char mode) {
  SIZED(arb_mat, row, 1, e->side);
  SIZED(arb_mat, rest, 1, arb_mat_ncols(e->entry));
  mech_condition_balls(row, e->m, mass, mode, end, e->prec);
  arb_mat_mul(rest, row, e->entry, e->prec); /* the coordinate is still zero in it */
  for (slong l = 0; l < arb_mat_ncols(rest); l++) {
    arb_ptr to = arb_mat_entry(e->entry, at, l);
    arb_div(to, arb_mat_entry(rest, 0, l), arb_mat_entry(row, 0, at), e->prec);
    arb_neg(to, to);
  }
}

/* The entry of the first phase: see orbit.h. */
static void make_entry(struct mech_equations *e, int n_plain) {
  const struct mech *m = e->m;
  const struct mech_word *w = e->w;
  int n = m->n;
  enum mech_end end;
  int changed = mech_event(&end, w->phase[w->n - 1], w->phase[0]);
  for (int l = 0; l < n_plain; l++) arb_one(arb_mat_entry(e->entry, e->free[l], l));
  for (int l = 0; l <= m->states - 2 * n; l++) arb_one(arb_mat_entry(e->entry, 2 * n + l, n_plain + l));
  for (int i = 0; i < n; i++) {
    const struct mech_stop *at = stop_at_entry(m, w, i);
    if (at) pin(e, i, i, at == &m->mass[i].stop[1] ? MECH_HITS_ABOVE : MECH_HITS_BELOW, '.');
    if (w->phase[0][i] == 's' || (i == changed && !at)) pin(e, n + i, i, MECH_REACHES, '-');
  }
  if (end == MECH_BREAKS_SLOWER || end == MECH_BREAKS_FASTER) pin(e, changed, changed, end, 's');
}

int mech_free(int free[MECH_STATES], const struct mech *m, const struct mech_word *w) {
  enum mech_end end;
  int n = m->n, count = 0, changed = mech_event(&end, w->phase[w->n - 1], w->phase[0]);
  for (int i = 0; i < n; i++)
    if (!stop_at_entry(m, w, i) && (i != changed || end == MECH_REACHES)) free[count++] = i;
  for (int i = 0; i < n; i++) {
    bool moves = i != changed || (mech_is_hit(end) && !fmpq_is_zero(stop_at_entry(m, w, i)->restitution));
    if (moves && w->phase[0][i] != 's' && !mech_rests(w->phase[0][i])) free[count++] = n + i;
  }
  if (m->n_loads) free[count++] = 2 * n;
  return count;
}

void mech_equations_init(struct mech_equations *e, const struct mech *m, const struct mech_word *w, slong turns,
                         slong prec) {
  *e = (struct mech_equations){.m = m, .w = w, .side = m->states + 1, .turns = turns, .prec = prec};
  e->n_free = mech_free(e->free, m, w);
  slong unknowns = w->n + e->n_free, n_plain = e->n_free - (m->n_loads > 0);
  slong columns = n_plain + m->states - 2 * m->n + 1;
  for (int k = 0; k < w->n; k++) {
    enum mech_end end;
    int mass = mech_event(&end, w->phase[k], w->phase[(k + 1) % w->n]);
    arb_mat_init(e->rate[k], e->side, e->side);
    arb_mat_init(e->event[k], 1, e->side);
    mech_rate_balls(e->rate[k], m, w->phase[k], prec);
    mech_condition_balls(e->event[k], m, mass, w->phase[k][mass], end, prec);
    e->hit[k] = mech_is_hit(end) ? mass : -1;
    arb_init(e->rebound[k]);
    arb_set_fmpq(e->rebound[k], m->mass[mass].stop[end == MECH_HITS_ABOVE].restitution, prec);
    arb_neg(e->rebound[k], e->rebound[k]);
  }
  arb_mat_init(e->entry, e->side, columns);
  make_entry(e, (int)n_plain);
  for (int k = 0; k <= w->n; k++) arb_mat_init(e->state[k], e->side, 1);
  arb_mat_init(e->change, e->side, unknowns);
  arb_mat_init(e->value, unknowns, 1);
  arb_mat_init(e->slope, unknowns, unknowns);
}

void mech_equations_clear(struct mech_equations *e) {
  for (int k = 0; k < e->w->n; k++) {
    arb_mat_clear(e->rate[k]);
    arb_mat_clear(e->event[k]);
    arb_clear(e->rebound[k]);
  }
  for (int k = 0; k <= e->w->n; k++) arb_mat_clear(e->state[k]);
  arb_mat_clear(e->entry);
  arb_mat_clear(e->change);
  arb_mat_clear(e->value);
  arb_mat_clear(e->slope);
}

/* The state at the first entry, and its derivatives: those of the lengths are zero. */
static void start(struct mech_equations *e, arb_srcptr x) {
  slong columns = arb_mat_ncols(e->entry);
  SIZED(arb_mat, q, columns, 1);
  SIZED(arb_mat, dq, columns, e->n_free);
  SIZED(arb_mat, from, e->side, e->n_free);
  for (int l = 0; l < e->n_free; l++) {
    if (e->free[l] == 2 * e->m->n) { /* theta */
      arb_ptr c = arb_mat_entry(q, l, 0), s = arb_mat_entry(q, l + 1, 0);
      arb_sin_cos(s, c, x + e->w->n + l, e->prec);
      arb_neg(arb_mat_entry(dq, l, l), s);
      arb_set(arb_mat_entry(dq, l + 1, l), c);
    } else {
      arb_set(arb_mat_entry(q, l, 0), x + e->w->n + l);
      arb_one(arb_mat_entry(dq, l, l));
    }
  }
  arb_one(arb_mat_entry(q, columns - 1, 0));
  arb_mat_mul(e->state[0], e->entry, q, e->prec);
  arb_mat_mul(from, e->entry, dq, e->prec);
  arb_mat_zero(e->change);
  for (int i = 0; i < e->side; i++)
    for (int l = 0; l < e->n_free; l++) arb_set(arb_mat_entry(e->change, i, e->w->n + l), arb_mat_entry(from, i, l));
}

/* a = exp(a) in double precision, a fiftieth of the work; not finite where a is too large for it.  The constants in the
   last column are scaled to 1 meanwhile: however large, they do not make the exponential large. */
static void rough_exponential(arb_mat_t a) {
  static const double largest = 700; /* exp(largest) is a double */
  size_t n = (size_t)arb_mat_nrows(a), last = n - 1;
  gsl_matrix *x = gsl_matrix_alloc(n, n), *z = gsl_matrix_alloc(n, n);
  double constants = 1;
  for (size_t i = 0; i < n * n; i++) x->data[i] = num_arb.get_d(a->entries + i);
  for (size_t i = 0; i < last; i++) constants = fmax(constants, fabs(gsl_matrix_get(x, i, last)));
  for (size_t i = 0; i < last; i++) gsl_matrix_set(x, i, last, gsl_matrix_get(x, i, last) / constants);
  bool known = fmax(gsl_matrix_max(x), -gsl_matrix_min(x)) < largest &&
               gsl_linalg_exponential_ss(x, z, GSL_PREC_DOUBLE) == GSL_SUCCESS;
  for (size_t i = 0; i < n * n; i++)
    if (known)
      arb_set_d(a->entries + i, z->data[i] * (i % n == last && i / n < last ? constants : 1));
    else
      arb_indeterminate(a->entries + i);
  gsl_matrix_free(z);
  gsl_matrix_free(x);
}

void mech_flow(arb_mat_t flow, const struct mech_equations *e, int phase, const arb_t t) {
  arb_mat_scalar_mul_arb(flow, e->rate[phase], t, e->prec);
  if (e->rough)
    rough_exponential(flow);
  else
    arb_mat_exp(flow, flow, e->prec);
}

/* Through phase k of length t; the event at its end. */
static void pass(struct mech_equations *e, int k, const arb_t t) {
  SIZED(arb_mat, flow, e->side, e->side);
  SIZED(arb_mat, moved, e->side, arb_mat_ncols(e->change));
  SIZED(arb_mat, rate, e->side, 1);
  mech_flow(flow, e, k, t);
  arb_mat_mul(e->state[k + 1], flow, e->state[k], e->prec);
  arb_mat_mul(moved, flow, e->change, e->prec);
  arb_mat_swap(moved, e->change);
  arb_mat_mul(rate, e->rate[k], e->state[k + 1], e->prec);
  for (int i = 0; i < e->side; i++) arb_set(arb_mat_entry(e->change, i, k), arb_mat_entry(rate, i, 0));
}

/* value and slope of the event at the end of phase k: its row times the state, and times the derivatives so far. */
static void meet(struct mech_equations *e, int k) {
  const arb_struct *row = e->event[k]->rows[0];
  arb_dot(arb_mat_entry(e->value, k, 0), NULL, 0, row, 1, e->state[k + 1]->entries, 1, e->side, e->prec);
  for (slong l = 0; l < arb_mat_ncols(e->change); l++)
    arb_dot(arb_mat_entry(e->slope, k, l), NULL, 0, row, 1, arb_mat_entry(e->change, 0, l), arb_mat_ncols(e->change),
            e->side, e->prec);
}

/* The mass that has reached an obstacle rebounds. */
static void rebound(struct mech_equations *e, int k) {
  int at = e->m->n + e->hit[k];
  if (e->hit[k] < 0) return;
  arb_mul(arb_mat_entry(e->state[k + 1], at, 0), arb_mat_entry(e->state[k + 1], at, 0), e->rebound[k], e->prec);
  for (slong l = 0; l < arb_mat_ncols(e->change); l++)
    arb_mul(arb_mat_entry(e->change, at, l), arb_mat_entry(e->change, at, l), e->rebound[k], e->prec);
}

/* The angle returns: Omega times the period is that many turns. */
static void turn(struct mech_equations *e, int row, arb_srcptr x) {
  arb_ptr value = arb_mat_entry(e->value, row, 0);
  arb_const_pi(value, e->prec);
  arb_mul_si(value, value, -2 * e->turns, e->prec);
  for (slong j = 0; j < arb_mat_ncols(e->change); j++) arb_zero(arb_mat_entry(e->slope, row, j));
  for (int k = 0; k < e->w->n; k++) {
    arb_ptr slope = arb_mat_entry(e->slope, row, k);
    arb_set(slope, arb_mat_entry(e->rate[k], 2 * e->m->n + 1, 2 * e->m->n)); /* Omega */
    arb_addmul(value, slope, x + k, e->prec);
  }
}

void mech_equations_at(struct mech_equations *e, arb_srcptr x) {
  int phases = e->w->n;
  start(e, x);
  for (int k = 0; k < phases; k++) {
    pass(e, k, x + k);
    meet(e, k);
    rebound(e, k);
  }
  for (int l = 0; l < e->n_free; l++) {
    int at = e->free[l], row = phases + l;
    if (at == 2 * e->m->n) {
      turn(e, row, x);
      continue;
    }
    arb_sub(arb_mat_entry(e->value, row, 0), arb_mat_entry(e->state[phases], at, 0), x + row, e->prec);
    for (slong j = 0; j < arb_mat_ncols(e->change); j++)
      arb_set(arb_mat_entry(e->slope, row, j), arb_mat_entry(e->change, at, j));
    arb_sub_ui(arb_mat_entry(e->slope, row, row), arb_mat_entry(e->slope, row, row), 1, e->prec);
  }
}
