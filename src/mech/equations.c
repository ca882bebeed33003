/* Single shooting over a word: one state, carried through the phases with its derivatives. */
#include "equations.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "base/arena.h"

enum { MOST_HALVINGS = 40 };

/* The obstacle at which a mass is at the entry of the first phase; NULL: at none. */
static const struct mech_stop *stop_at_entry(const struct mech *m, const struct mech_word *w, int i) {
  enum mech_end end;
  const char *before = w->phase[w->n - 1], *now = w->phase[0];
  bool changes = mech_event(&end, before, now) == i, lifts = changes && end == MECH_LIFTS;
  char mode = lifts ? before[i] : now[i];
  bool above = mech_rests(mode) ? mode == 'a' : end == MECH_HITS_ABOVE;
  return mech_rests(mode) || (changes && mech_is_hit(end)) ? &m->mass[i].stop[above] : NULL;
}

/* --- Rows and rates over a box of parameters: what they are at its middle, and what each interval adds ---

   A slope is a secant from the middle.  Derivatives along the straight way from the rates and rows at the middle to
   those of a point of the box have such slopes, and all that lies on that way is in the balls of the box: so that a
   mean value holds. */

/* That of delta_i in a row of a condition. */
static void condition_slope(arb_mat_t slope, const struct mech *m, int i, int mass, char mode, enum mech_end end,
                            slong prec) {
  SIZED(fmpq_mat, row, 1, m->states + 1);
  SIZED(fmpq_mat, moved, 1, m->states + 1);
  mech_condition(row, m, mass, mode, end);
  mech_condition(moved, &m->moved[i], mass, mode, end);
  fmpq_mat_sub(moved, moved, row);
  arb_mat_set_fmpq_mat(slope, moved, prec);
}

/* The inertia of a mass over the box. */
static void inertia_over(arb_t z, const struct mech *m, int mass, slong prec) {
  NUMBERS(fmpq, d);
  NUMBERS(arb, x);
  arb_set_fmpq(z, m->mass[mass].inertia, prec);
  for (int i = 0; i < m->n_intervals; i++) {
    fmpq_sub(d, m->moved[i].mass[mass].inertia, m->mass[mass].inertia);
    arb_set_fmpq(x, d, prec);
    arb_add_error(z, x);
  }
}

/* That of delta_i in the rates: with a force N linear in it, N/m - N_0/m_0 = (N_i/m_i - N_0/m_0) m_i/m delta_i. */
static void rate_slope(arb_mat_t slope, const struct mech *m, int i, const char *phase, slong prec) {
  const struct mech *moved = &m->moved[i];
  SIZED(fmpq_mat, a, m->states + 1, m->states + 1);
  SIZED(fmpq_mat, b, m->states + 1, m->states + 1);
  NUMBERS(arb, part, inertia);
  mech_rate(a, m, phase);
  mech_rate(b, moved, phase);
  fmpq_mat_sub(b, b, a);
  arb_mat_set_fmpq_mat(slope, b, prec);
  for (int mass = 0; mass < m->n; mass++) {
    arb_set_fmpq(part, moved->mass[mass].inertia, prec);
    inertia_over(inertia, m, mass, prec);
    arb_div(part, part, inertia, prec);
    for (int j = 0; j <= m->states; j++)
      arb_mul(arb_mat_entry(slope, m->n + mass, j), arb_mat_entry(slope, m->n + mass, j), part, prec);
  }
}

/* a +- slope */
static void add_error(arb_mat_t a, const arb_mat_t slope) {
  for (slong j = 0; j < arb_mat_nrows(a) * arb_mat_ncols(a); j++) arb_add_error(a->entries + j, slope->entries + j);
}

/* A of phase k: at the middle of the box, what each interval adds to it, and over the box. */
static void make_rates(struct mech_equations *e, int k) {
  const struct mech *m = e->m;
  SIZED(fmpq_mat, exact, e->side, e->side);
  mech_rate(exact, m, e->w->phase[k]);
  arb_mat_init(e->middle[k], e->side, e->side);
  arb_mat_set_fmpq_mat(e->middle[k], exact, e->prec);
  arb_mat_init(e->rate[k], e->side, e->side);
  arb_mat_set(e->rate[k], e->middle[k]);
  e->rate_along[k] = ss_malloc((size_t)m->n_intervals * sizeof *e->rate_along[k]);
  for (int i = 0; i < m->n_intervals; i++) {
    arb_mat_init(e->rate_along[k][i], e->side, e->side);
    rate_slope(e->rate_along[k][i], m, i, e->w->phase[k], e->prec);
    add_error(e->rate[k], e->rate_along[k][i]);
  }
}

void mech_condition_balls(arb_mat_t row, const struct mech *m, int mass, char mode, enum mech_end end, slong prec) {
  SIZED(fmpq_mat, exact, 1, m->states + 1);
  SIZED(arb_mat, slope, 1, m->states + 1);
  mech_condition(exact, m, mass, mode, end);
  arb_mat_set_fmpq_mat(row, exact, prec);
  for (int i = 0; i < m->n_intervals; i++) {
    condition_slope(slope, m, i, mass, mode, end, prec);
    add_error(row, slope);
  }
}

/* What the velocity of a mass that rebounds is multiplied by. */
static void rebound_slope(arb_t slope, const struct mech *m, int i, int mass, bool above, slong prec) {
  NUMBERS(fmpq, d);
  fmpq_sub(d, m->mass[mass].stop[above].restitution, m->moved[i].mass[mass].stop[above].restitution);
  arb_set_fmpq(slope, d, prec);
}

static void rebound_over(arb_t z, const struct mech *m, int mass, bool above, slong prec) {
  NUMBERS(arb, slope);
  arb_set_fmpq(z, m->mass[mass].stop[above].restitution, prec);
  for (int i = 0; i < m->n_intervals; i++) {
    rebound_slope(slope, m, i, mass, above, prec);
    arb_add_error(z, slope);
  }
  arb_neg(z, z);
}

/* --- The entry of the first phase: see orbit.h --- */

/* The coordinate at which a condition is zero, from the others: c y = 0.  i: its slope along delta_i,
   c y' + c' y = 0; or -1. */
static void pin(struct mech_equations *e, int i, int at, int mass, enum mech_end end, char mode) {
  arb_mat_struct *to = i < 0 ? e->entry : e->entry_along[i];
  slong columns = arb_mat_ncols(to);
  NUMBERS(arb, own);
  SIZED(arb_mat, row, 1, e->side);
  SIZED(arb_mat, rest, 1, columns);
  SIZED(arb_mat, more, 1, columns);
  mech_condition_balls(row, e->m, mass, mode, end, e->prec);
  arb_neg(own, arb_mat_entry(row, 0, at));
  arb_mat_mul(rest, row, to, e->prec); /* the coordinate is still zero in it */
  if (i >= 0) {
    condition_slope(row, e->m, i, mass, mode, end, e->prec);
    arb_mat_mul(more, row, e->entry, e->prec);
    arb_mat_add(rest, rest, more, e->prec);
  }
  for (slong l = 0; l < columns; l++) arb_div(arb_mat_entry(to, at, l), arb_mat_entry(rest, 0, l), own, e->prec);
}

static void pin_all(struct mech_equations *e, int i) {
  const struct mech *m = e->m;
  const struct mech_word *w = e->w;
  enum mech_end end;
  int changed = mech_event(&end, w->phase[w->n - 1], w->phase[0]);
  for (int k = 0; k < m->n; k++) {
    const struct mech_stop *at = stop_at_entry(m, w, k);
    if (at) pin(e, i, k, k, at == &m->mass[k].stop[1] ? MECH_HITS_ABOVE : MECH_HITS_BELOW, '.');
    if (w->phase[0][k] == 's' || (k == changed && !at)) pin(e, i, m->n + k, k, MECH_REACHES, '-');
  }
  if (end == MECH_BREAKS_SLOWER || end == MECH_BREAKS_FASTER) pin(e, i, changed, changed, end, 's');
}

static void make_entry(struct mech_equations *e, slong columns) {
  int n = e->m->n, n_plain = e->n_free - (e->m->n_loads > 0);
  arb_mat_init(e->entry, e->side, columns);
  for (int l = 0; l < n_plain; l++) arb_one(arb_mat_entry(e->entry, e->free[l], l));
  for (int l = 0; l <= e->m->states - 2 * n; l++) arb_one(arb_mat_entry(e->entry, 2 * n + l, n_plain + l));
  pin_all(e, -1);
  e->entry_along = ss_malloc((size_t)e->m->n_intervals * sizeof *e->entry_along);
  for (int i = 0; i < e->m->n_intervals; i++) {
    arb_mat_init(e->entry_along[i], e->side, columns);
    pin_all(e, i);
  }
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
    arb_mat_init(e->event[k], 1, e->side);
    make_rates(e, k);
    mech_condition_balls(e->event[k], m, mass, w->phase[k][mass], end, prec);
    e->hit[k] = mech_is_hit(end) ? mass : -1;
    arb_init(e->rebound[k]);
    rebound_over(e->rebound[k], m, mass, end == MECH_HITS_ABOVE, prec);
  }
  make_entry(e, columns);
  for (int k = 0; k <= w->n; k++) arb_mat_init(e->state[k], e->side, 1);
  arb_mat_init(e->change, e->side, unknowns + m->n_intervals);
  arb_mat_init(e->value, unknowns, 1);
  arb_mat_init(e->slope, unknowns, unknowns + m->n_intervals);
}

void mech_equations_clear(struct mech_equations *e) {
  for (int k = 0; k < e->w->n; k++) {
    arb_mat_clear(e->rate[k]);
    arb_mat_clear(e->middle[k]);
    for (int i = 0; i < e->m->n_intervals; i++) arb_mat_clear(e->rate_along[k][i]);
    free(e->rate_along[k]);
    arb_mat_clear(e->event[k]);
    arb_clear(e->rebound[k]);
  }
  for (int k = 0; k <= e->w->n; k++) arb_mat_clear(e->state[k]);
  arb_mat_clear(e->entry);
  for (int i = 0; i < e->m->n_intervals; i++) arb_mat_clear(e->entry_along[i]);
  free(e->entry_along);
  arb_mat_clear(e->change);
  arb_mat_clear(e->value);
  arb_mat_clear(e->slope);
}

/* The derivative by delta_i of an element of the state. */
static arb_ptr along(const struct mech_equations *e, int i, int j) {
  return arb_mat_entry(e->change, j, e->w->n + e->n_free + i);
}

/* The cosine and sine of an order, and their derivatives by theta, the unknown number l. */
static void turned(arb_mat_t q, arb_mat_t dq, int l, int number, const struct mech_equations *e, const arb_t theta) {
  int order = e->m->order[number], at = l + 2 * number;
  arb_ptr c = arb_mat_entry(q, at, 0), s = arb_mat_entry(q, at + 1, 0);
  NUMBERS(arb, angle);
  arb_set(angle, theta);
  mech_times_order(angle, order, e->prec);
  arb_sin_cos(s, c, angle, e->prec);
  arb_neg(arb_mat_entry(dq, at, l), s);
  arb_set(arb_mat_entry(dq, at + 1, l), c);
  for (int i = at; i < at + 2; i++) mech_times_order(arb_mat_entry(dq, i, l), order, e->prec);
}

/* The state at the first entry, and its derivatives: those of the lengths are zero. */
static void start(struct mech_equations *e, arb_srcptr x) {
  slong columns = arb_mat_ncols(e->entry);
  SIZED(arb_mat, q, columns, 1);
  SIZED(arb_mat, dq, columns, e->n_free);
  SIZED(arb_mat, from, e->side, e->n_free);
  for (int l = 0; l < e->n_free; l++) {
    if (e->free[l] == 2 * e->m->n) { /* theta: the last one */
      for (int k = 0; k < e->m->n_orders; k++) turned(q, dq, l, k, e, x + e->w->n + l);
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
  for (int i = 0; e->along && i < e->m->n_intervals; i++) {
    SIZED(arb_mat, column, e->side, 1);
    arb_mat_mul(column, e->entry_along[i], q, e->prec);
    for (int j = 0; j < e->side; j++) arb_set(along(e, i, j), arb_mat_entry(column, j, 0));
  }
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

/* a = exp(a) of a matrix of wide balls.  What arb_mat_exp adds for their radii grows as the exponential of its norm, so
   that it is taken of a part, and squared. */
static void wide_exponential(arb_mat_t a, slong prec) {
  NUMBERS(mag, norm);
  arb_mat_bound_inf_norm(norm, a);
  slong halvings = 2 + (mag_is_special(norm) ? 0 : fmpz_get_si(MAG_EXPREF(norm)));
  if (halvings < 0 || halvings > MOST_HALVINGS) halvings = 0;
  arb_mat_scalar_mul_2exp_si(a, a, -halvings);
  arb_mat_exp(a, a, prec);
  for (slong i = 0; i < halvings; i++) arb_mat_sqr(a, a, prec);
}

/* The derivative of exp(A t) by delta_i, over the box: above the diagonal of exp([A A_i; 0 A] t).  false: it is
   zero. */
static bool flow_slope(arb_mat_t d, const struct mech_equations *e, int k, int i, const arb_t t) {
  int side = e->side;
  const arb_mat_struct *slope = e->rate_along[k][i];
  SIZED(arb_mat, both, 2 * side, 2 * side);
  if (arb_mat_is_zero(slope)) return false;
  for (int j = 0; j < side; j++)
    for (int l = 0; l < side; l++) {
      arb_set(arb_mat_entry(both, j, l), arb_mat_entry(e->rate[k], j, l));
      arb_set(arb_mat_entry(both, side + j, side + l), arb_mat_entry(e->rate[k], j, l));
      arb_set(arb_mat_entry(both, j, side + l), arb_mat_entry(slope, j, l));
    }
  arb_mat_scalar_mul_arb(both, both, t, e->prec);
  wide_exponential(both, e->prec);
  for (int j = 0; j < side; j++)
    for (int l = 0; l < side; l++) arb_set(arb_mat_entry(d, j, l), arb_mat_entry(both, j, side + l));
  return true;
}

/* Over a box of parameters, and of t: exp(A t) at the middle of both, times exp(A (t - middle)), and what the intervals
   change of it. */
static void flow_over(arb_mat_t flow, const struct mech_equations *e, int k, const arb_t t) {
  NUMBERS(arb, part);
  SIZED(arb_mat, d, e->side, e->side);
  arb_get_mid_arb(part, t);
  arb_mat_scalar_mul_arb(flow, e->middle[k], part, e->prec);
  arb_mat_exp(flow, flow, e->prec);
  arb_sub(part, t, part, e->prec);
  arb_mat_scalar_mul_arb(d, e->middle[k], part, e->prec);
  wide_exponential(d, e->prec);
  arb_mat_mul(flow, flow, d, e->prec);
  for (int i = 0; i < e->m->n_intervals; i++)
    if (flow_slope(d, e, k, i, t)) add_error(flow, d);
}

void mech_flow(arb_mat_t flow, const struct mech_equations *e, int phase, const arb_t t) {
  if (e->m->n_intervals) {
    flow_over(flow, e, phase, t);
    return;
  }
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
  for (int i = 0; e->along && i < e->m->n_intervals; i++) {
    if (!flow_slope(flow, e, k, i, t)) continue;
    for (int j = 0; j < e->side; j++)
      arb_dot(along(e, i, j), along(e, i, j), 0, arb_mat_entry(flow, j, 0), 1, e->state[k]->entries, 1, e->side,
              e->prec);
  }
}

/* value and slope of the event at the end of phase k: its row times the state, and times the derivatives so far. */
static void meet(struct mech_equations *e, int k) {
  const arb_struct *row = arb_mat_entry(e->event[k], 0, 0);
  arb_dot(arb_mat_entry(e->value, k, 0), NULL, 0, row, 1, e->state[k + 1]->entries, 1, e->side, e->prec);
  for (slong l = 0; l < arb_mat_ncols(e->change); l++)
    arb_dot(arb_mat_entry(e->slope, k, l), NULL, 0, row, 1, arb_mat_entry(e->change, 0, l), arb_mat_ncols(e->change),
            e->side, e->prec);
  for (int i = 0; e->along && i < e->m->n_intervals; i++) {
    enum mech_end end;
    int mass = mech_event(&end, e->w->phase[k], e->w->phase[(k + 1) % e->w->n]);
    arb_ptr to = arb_mat_entry(e->slope, k, e->w->n + e->n_free + i);
    SIZED(arb_mat, moved, 1, e->side);
    condition_slope(moved, e->m, i, mass, e->w->phase[k][mass], end, e->prec);
    arb_dot(to, to, 0, moved->entries, 1, e->state[k + 1]->entries, 1, e->side, e->prec);
  }
}

/* The mass that has reached an obstacle rebounds. */
static void rebound(struct mech_equations *e, int k) {
  int at = e->m->n + e->hit[k];
  enum mech_end end;
  NUMBERS(arb, before, slope);
  if (e->hit[k] < 0) return;
  arb_set(before, arb_mat_entry(e->state[k + 1], at, 0));
  arb_mul(arb_mat_entry(e->state[k + 1], at, 0), before, e->rebound[k], e->prec);
  for (slong l = 0; l < arb_mat_ncols(e->change); l++)
    arb_mul(arb_mat_entry(e->change, at, l), arb_mat_entry(e->change, at, l), e->rebound[k], e->prec);
  mech_event(&end, e->w->phase[k], e->w->phase[(k + 1) % e->w->n]);
  for (int i = 0; e->along && i < e->m->n_intervals; i++) {
    rebound_slope(slope, e->m, i, e->hit[k], end == MECH_HITS_ABOVE, e->prec);
    arb_addmul(along(e, i, at), slope, before, e->prec);
  }
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
  for (int i = 0; e->along && i < e->m->n_intervals; i++)
    for (int k = 0; k < e->w->n; k++)
      arb_addmul(arb_mat_entry(e->slope, row, e->w->n + e->n_free + i),
                 arb_mat_entry(e->rate_along[k][i], 2 * e->m->n + 1, 2 * e->m->n), x + k, e->prec);
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
