/* The motion of a system of masses: the word's equations, a proof that a box holds one solution, and functions along a
   phase.  All motion is exp(A t) y, by Arb's matrix exponential; check.c says what is proved how. */
#include <stdlib.h>
#include <string.h>

#include "checker.h"

struct system sys;
static long work; /* done along the phases of a word */

const fmpq *datum(int mass, int which) {
  return fmpq_mat_entry(sys.mass, mass, which);
}

/* --- Phases and their functions --- */

/* sign q into an entry of a matrix. */
static void put(mat m, slong i, slong j, const fmpq *q, int sign) {
  arb_set_fmpq(arb_mat_entry(m, i, j), q, prec);
  if (sign < 0) arb_neg(arb_mat_entry(m, i, j), arb_mat_entry(m, i, j));
}

bool rests(char letter) {
  return letter == 'a' || letter == 'b';
}

/* The row c with c y the function of an event; r: the limit, if the event has one. */
static mat row_of(enum event e, int i, char letter, num r) {
  int one = sys.side - 1, moves = fmpq_sgn(datum(i, SURFACE));
  int sign = e == FASTER || e == BELOW || (e == REACHES && letter == '+') || (e == LIFTS && letter == 'b') ? -1 : 1;
  mat c = matrix(1, sys.side);
  for (int j = 0; j < sys.side && (e < REACHES || e == LIFTS); j++) put(c, 0, j, fmpq_mat_entry(sys.force, i, j), sign);
  if (e < REACHES) arb_neg(arb_mat_entry(c, 0, one), r);
  if (e == LIFTS && moves != 0) put(c, 0, one, datum(i, SLIDING), -sign * moves);
  if (e == REACHES) put(c, 0, one, datum(i, SURFACE), -sign);
  if (e >= BELOW) put(c, 0, one, datum(i, POSITION + (e == ABOVE)), -sign);
  if (e == REACHES || e >= BELOW) arb_set_si(arb_mat_entry(c, 0, e == REACHES ? sys.n + i : i), sign);
  return c;
}

/* The frequency of an order. */
static num pace_of(int k) {
  return mul(rational(&sys.frequency), integer(sys.order[k]));
}

/* A of a phase: m_i x_i'' = -f_i, s_i - f_i or -s_i - f_i. */
static mat rate_of(const char *phase) {
  int n = sys.n, one = sys.side - 1;
  mat a = matrix(sys.side, sys.side);
  for (int i = 0; i < n; i++) {
    if (rests(phase[i])) continue;
    arb_one(arb_mat_entry(a, i, n + i));
    if (phase[i] == 's') continue;
    num sliding = phase[i] == '.' ? integer(0) : rational(datum(i, SLIDING));
    mat c = row_of(FASTER, i, 's', phase[i] == '-' ? sub(integer(0), sliding) : sliding);
    _arb_vec_scalar_div(arb_mat_entry(a, n + i, 0), c->entries, sys.side, rational(datum(i, INERTIA)), prec);
  }
  if (!sys.loads) return a;
  put(a, 2 * n, one, &sys.frequency, 1);
  for (int k = 0, pair = 2 * n + 1; k < sys.orders; k++, pair += 2) {
    num pace = pace_of(k);
    arb_neg(arb_mat_entry(a, pair, pair + 1), pace);
    arb_set(arb_mat_entry(a, pair + 1, pair), pace);
  }
  return a;
}

num value(enum event e, int mass, const char *phase, mat y, num r) {
  return product(row_of(e, mass, phase[mass], r), y);
}

/* exp(A t) as exp(A mid) exp(A (t - mid)): the squarings inside the first see no radius. */
static mat propagator(mat a, num t) {
  num mid = middle(t);
  return times(exponential(by_ball(a, mid)), exponential(by_ball(a, sub(t, mid))));
}

/* --- A word and its equations --- */

static bool event_of(int *mass, enum event *e, const char *from, const char *to) {
  bool hit = to[sys.n] != '\0';
  *mass = hit ? atoi(to + sys.n + 1) - 1 : -1;
  for (int i = 0; i < sys.n; i++) {
    if (from[i] == to[i] || (hit && i == *mass)) continue;
    if (*mass >= 0) return false;
    *mass = i;
  }
  if (*mass < 0) return false;
  char mode = to[*mass];
  *e = hit                  ? (to[sys.n] == '<' ? BELOW : ABOVE)
       : rests(mode)        ? (mode == 'b' ? BELOW : ABOVE)
       : rests(from[*mass]) ? LIFTS
       : from[*mass] != 's' ? REACHES
       : mode == '-'        ? SLOWER
                            : FASTER;
  int moves = fmpq_sgn(datum(*mass, SURFACE));
  char slipping = !sys.rubbed[*mass] ? '.' : moves > 0 ? '-' : '+'; /* from rest; its friction is that of the rest */
  return !rests(from[*mass]) || (*e == LIFTS && mode == slipping);
}

int equations(const struct word *w) {
  return w->n + w->n_free;
}

bool word_finish(struct word *w) {
  for (int k = 0; k < w->n; k++)
    if (!event_of(&w->mass[k], &w->event[k], w->phase[k], w->phase[(k + 1) % w->n])) return false;
  int changed = w->mass[w->n - 1];
  enum event e = w->event[w->n - 1];
  w->n_free = 0;
  for (int i = 0; i < sys.n; i++)
    if (!rests(w->phase[0][i]) && (i != changed || e == REACHES)) w->place[w->n_free++] = i;
  for (int i = 0; i < sys.n; i++) {
    bool moves = i != changed || (e >= BELOW && !fmpq_is_zero(datum(i, RESTITUTION + (e == ABOVE))));
    if (moves && w->phase[0][i] != 's' && !rests(w->phase[0][i])) w->place[w->n_free++] = sys.n + i;
  }
  if (sys.loads) w->place[w->n_free++] = 2 * sys.n;
  return true;
}

/* The function of the event of a mass, with its derivatives, from y with its own; limit: those of all masses. */
static mat meet(enum event e, int mass, char letter, mat y, arb_srcptr limit) {
  mat row = times(row_of(e, mass, letter, limit + mass), y);
  arb_ptr by_limit = arb_mat_entry(row, 0, arb_mat_ncols(y) - sys.n + mass);
  if (e < REACHES) arb_sub_ui(by_limit, by_limit, 1, prec);
  return row;
}

/* y at the start of the word, with its derivatives.  A mass that has just changed its mode or rebounded is where its
   event says: at its surface's velocity, at the obstacle, where its force is at the limit. */
static mat begin(const struct word *w, arb_srcptr x) {
  int i = w->mass[w->n - 1];
  enum event e = w->event[w->n - 1];
  mat y = matrix(sys.side, 1 + equations(w) + sys.n);
  arb_one(arb_mat_entry(y, sys.side - 1, 0));
  for (int k = 0; k < sys.n; k++) {
    char mode = k == i && e == LIFTS ? w->phase[w->n - 1][k] : w->phase[0][k];
    if (rests(mode)) put(y, k, 0, datum(k, POSITION + (mode == 'a')), 1);
    if (mode == 's' || (k == i && e <= REACHES)) put(y, sys.n + k, 0, datum(k, SURFACE), 1);
  }
  if (e >= BELOW) put(y, i, 0, datum(i, POSITION + (e == ABOVE)), 1);
  for (int l = 0; l < w->n_free; l++) {
    int p = w->place[l];
    arb_set(arb_mat_entry(y, p, 0), x + l);
    arb_one(arb_mat_entry(y, p, 1 + l));
    if (p < 2 * sys.n) continue;
    for (int k = 0, pair = p + 1; k < sys.orders; k++, pair += 2) {
      num order = integer(sys.order[k]);
      arb_sin_cos(arb_mat_entry(y, pair + 1, 0), arb_mat_entry(y, pair, 0), mul(order, x + l), prec);
      arb_neg(arb_mat_entry(y, pair, 1 + l), mul(order, arb_mat_entry(y, pair + 1, 0)));
      arb_set(arb_mat_entry(y, pair + 1, 1 + l), mul(order, arb_mat_entry(y, pair, 0)));
    }
  }
  if (e >= REACHES) return y;
  mat row = meet(e, i, 's', y, x + equations(w)); /* x_i is still zero */
  num by = mul(integer(e == SLOWER ? -1 : 1), rational(fmpq_mat_entry(sys.force, i, i)));
  _arb_vec_scalar_div(arb_mat_entry(y, i, 0), row->entries, arb_mat_ncols(y), by, prec);
  return y;
}

void follow(struct motion *o, const struct word *w, arb_srcptr x) {
  mat y = begin(w, x);
  slong m = equations(w), columns = arb_mat_ncols(y);
  work = 0;
  o->zero = matrix(m, columns);
  for (int k = 0; k < w->n; k++) {
    int i = w->mass[k];
    mat a = rate_of(w->phase[k]);
    o->start[k] = y;
    o->end[k] = times(propagator(a, x + w->n_free + k), y);
    mat rate = times(a, part(o->end[k], 0, 0, sys.side, 1));
    for (int l = 0; l < sys.side; l++)
      arb_set(arb_mat_entry(o->end[k], l, 1 + w->n_free + k), arb_mat_entry(rate, l, 0));
    mat row = meet(w->event[k], i, w->phase[k][i], o->end[k], x + m);
    _arb_vec_set(arb_mat_entry(o->zero, k, 0), row->entries, columns);
    y = part(o->end[k], 0, 0, sys.side, columns);
    if (w->event[k] < BELOW) continue;
    num by = rational(datum(i, RESTITUTION + (w->event[k] == ABOVE)));
    arb_ptr velocity = arb_mat_entry(y, sys.n + i, 0);
    _arb_vec_scalar_mul(velocity, velocity, columns, by, prec);
    _arb_vec_neg(velocity, velocity, columns);
  }
  for (int l = 0; l < w->n_free; l++) {
    arb_ptr row = arb_mat_entry(o->zero, w->n + l, 0);
    _arb_vec_set(row, arb_mat_entry(y, w->place[l], 0), columns);
    arb_sub(row, row, x + l, prec);
    arb_sub_ui(row + 1 + l, row + 1 + l, 1, prec);
    if (w->place[l] == 2 * sys.n) arb_sub(row, row, mul(pi(), integer(2 * w->turns)), prec);
  }
}

mat return_matrix(const struct motion *o, const struct word *w) {
  int nf = w->n_free, n = w->n; /* events and return, by lengths and by what is free */
  mat gt = part(o->zero, 0, 1 + nf, n, n), gq = part(o->zero, 0, 1, n, nf), moved = matrix(n, nf);
  mat rt = part(o->zero, n, 1 + nf, nf, n), rq = part(o->zero, n, 1, nf, nf);
  if (!arb_mat_solve(moved, gt, gq, prec)) arb_mat_indeterminate(moved);
  for (int l = 0; l < nf; l++) arb_add_ui(arb_mat_entry(rq, l, l), arb_mat_entry(rq, l, l), 1, prec);
  return minus(rq, times(rt, moved));
}

/* --- One solution in a box --- */

/* The derivatives of the m equations by the unknowns. */
static mat jacobian(mat zero, const int *unknown, int m) {
  mat j = matrix(m, m);
  for (int i = 0; i < m; i++)
    for (int l = 0; l < m; l++) arb_set(arb_mat_entry(j, i, l), arb_mat_entry(zero, i, 1 + unknown[l]));
  return j;
}

/* Krawczyk's operator on the box x: mid - Y f(mid) + (1 - Y J(x)) (x - mid), Y the rounded inverse of J(mid).  Every
   solution in the box lies in the image; an image inside the box proves that there is exactly one.  image: x but for
   the unknowns. */
static bool krawczyk(arb_ptr image, arb_srcptr x, const struct word *w, const int *unknown) {
  int m = equations(w);
  struct motion at_mid, all;
  mat off = matrix(m, 1), one = matrix(m, m), y = matrix(m, m);
  arb_mat_one(one);
  for (int l = 0; l < m; l++) {
    int k = unknown[l];
    arb_get_mid_arb(image + k, x + k);
    arb_sub(arb_mat_entry(off, l, 0), x + k, image + k, prec);
  }
  follow(&at_mid, w, image);
  follow(&all, w, x);
  bool inside = arb_mat_approx_inv(y, jacobian(at_mid.zero, unknown, m), prec);
  mat steps = times(y, part(at_mid.zero, 0, 0, m, 1));
  off = minus(times(minus(one, times(y, jacobian(all.zero, unknown, m))), off), steps);
  for (int l = 0; l < m; l++) {
    int k = unknown[l];
    arb_add(image + k, image + k, arb_mat_entry(off, l, 0), prec);
    inside = inside && arb_is_finite(image + k) && arb_contains_interior(x + k, image + k);
  }
  return inside;
}

bool enclose(arb_ptr x, bool *proved, const struct word *w) {
  int m = equations(w), unknown[NUMBERS], l = 0;
  arb_ptr image = _arb_vec_init(m + sys.n);
  for (int k = 0; k < m + sys.n; k++) {
    if (!w->known[k]) unknown[l++] = k;
    if (w->known[k]) arb_set_fmpq(x + k, w->known[k], prec);
    arb_set(image + k, x + k);
  }
  bool halved = true;
  for (int i = 0; i < 64 && halved; i++) {
    slong before = pool_size;
    *proved = krawczyk(image, x, w, unknown) || *proved;
    halved = false;
    for (l = 0; *proved && l < m; l++) {
      int k = unknown[l];
      if (!arb_is_finite(image + k)) continue;
      halved = halved || mag_cmp(arb_radref(scaled(image + k, 1)), arb_radref(x + k)) < 0;
      if (arb_intersection(image + k, image + k, x + k, prec)) arb_set(x + k, image + k);
    }
    release(before);
  }
  _arb_vec_clear(image, m + sys.n);
  return *proved;
}

/* --- A function along a phase --- */
enum { MAX_LEVEL = 160, MAX_WORK = 1 << 28 };

/* The function f = c y along half a phase, from either end. */
struct walk {
  mat rate, row[4]; /* c, c A, c A^2, c A^3 */
  num length;
  const num *bound;                   /* of |f''|, the third and the fourth derivative */
  arb_mat_struct step[MAX_LEVEL + 1]; /* exp(A length/2^level), where it has been needed */
};

/* A bound of |c y^(k)| on a phase that starts at y; for k = 1 no mass sticks.  See check.c. */
static num bend_bound(const char *phase, mat c, mat y, mat rate, int k, num length) {
  int n = sys.n;
  mat form = matrix(2 * n, 2 * n), b = matrix(2 * n, 1), by = matrix(2 * n, 1), arm = matrix(2 * n, 1);
  num push = integer(0), own = push;
  for (int i = 0; i < k; i++) y = times(rate, y);
  arb_mat_one(form);
  for (int i = 0; i < n; i++) {
    if (phase[i] == 's' || rests(phase[i])) continue;
    for (int j = 0; j < n; j++)
      if (phase[j] != 's' && !rests(phase[j])) put(form, i, j, fmpq_mat_entry(sys.force, i, j), 1);
    put(form, n + i, n + i, datum(i, INERTIA), 1);
    for (int j = i; j < 2 * n; j += n) {
      arb_set(arb_mat_entry(b, j, 0), arb_mat_entry(y, j, 0));
      arb_set(arb_mat_entry(by, j, 0), arb_mat_entry(c, 0, j));
    }
  }
  for (int l = 0, pair = 2 * n + 1; l < sys.orders; l++, pair += 2) {
    num pace = integer(1), size = integer(0), in_c = size;
    for (int i = 0; i < k; i++) pace = mul(pace, pace_of(l));
    for (int j = pair; j < pair + 2; j++) {
      in_c = add(in_c, square(arb_mat_entry(c, 0, j)));
      for (int i = 0; i < n; i++)
        if (phase[i] != 's' && !rests(phase[i]))
          size = add(size, div_by(square(rational(fmpq_mat_entry(sys.force, i, j))), rational(datum(i, INERTIA))));
    }
    push = add(push, mul(pace, root(size)));
    own = add(own, mul(pace, root(in_c)));
  }
  if (!arb_mat_spd_solve(arm, form, by, prec)) arb_mat_indeterminate(arm); /* it is proved positive definite */
  num energy = product(transposed(b), times(form, b)), weight = product(transposed(by), arm);
  return add(mul(root(weight), add(root(energy), mul(length, push))), own);
}

/* Is f < 0 on the piece of the walk that starts at y? zeros: how many of f, f', f'' are zero there by the equations;
   then f(t) <= t rise, t^2/2 rise or t^3/6 rise. */
static int below(struct walk *w, mat y, int level, int zeros) {
  slong before = pool_size;
  int order = zeros > 1 ? zeros : 1;
  num length = scaled(w->length, -level), f = product(w->row[0], y), rate = product(w->row[order], y);
  num rise = add(rate, mul(w->bound[order - 1], scaled(length, -1)));
  bool negative = zeros ? arb_is_negative(rise) : arb_is_negative(f) && arb_is_negative(add(f, mul(length, rise)));
  int answer = negative ? YES : arb_is_positive(zeros ? rate : f) ? NO : OPEN;
  work += sys.side * sys.side;
  if (answer == OPEN && level < MAX_LEVEL && work < MAX_WORK) {
    arb_mat_struct *step = &w->step[level + 1];
    if (!step->entries) {
      arb_mat_init(step, sys.side, sys.side);
      arb_mat_set(step, exponential(by_ball(w->rate, scaled(length, -1))));
    }
    mat next = times(step, y);
    answer = arb_is_positive(product(w->row[0], next)) ? NO : below(w, y, level + 1, zeros);
    if (answer == YES) answer = below(w, next, level + 1, 0);
  }
  release(before);
  return answer;
}

static int half_below(mat c, mat y, mat rate, int zeros, num length, const num *bound) {
  mat slope = times(c, rate), second = times(slope, rate), third = times(second, rate);
  struct walk walk = {.rate = rate, .row = {c, slope, second, third}, .length = length, .bound = bound};
  int answer = below(&walk, y, 0, zeros);
  for (int i = 0; i <= MAX_LEVEL; i++) arb_mat_clear(&walk.step[i]);
  return answer;
}

bool ends(const struct word *w, int k, int mass, enum event e) {
  return w->mass[k] == mass && w->event[k] == e;
}

/* How many of f, f', f'' are zero at the start of the phase: one after a rebound from the same obstacle and, of the
   velocity, after the mass has changed its mode; two where it broke loose and its static limit is the sliding
   friction, or rebounds without velocity; three of the position after it was at rest there. */
static int zeros_at_start(const struct word *w, int k, int mass, enum event e) {
  int last = (k + w->n - 1) % w->n;
  const fmpq *limit = w->known[equations(w) + mass];
  char before = w->phase[last][mass];
  if (w->mass[last] != mass) return 0;
  if (w->event[last] == LIFTS) return e == (before == 'a' ? ABOVE : BELOW) ? 3 : 0;
  if (w->event[last] >= BELOW)
    return e != w->event[last] ? 0 : fmpq_is_zero(datum(mass, RESTITUTION + (e == ABOVE))) ? 2 : 1;
  if (e != REACHES) return 0;
  return w->event[last] < REACHES && limit && fmpq_equal(limit, datum(mass, SLIDING)) ? 2 : 1;
}

int stays_below(const struct motion *o, const struct word *w, arb_srcptr x, int k, int mass, enum event e, int sign) {
  slong before = pool_size;
  const char *phase = w->phase[k];
  bool turned = arb_is_negative(x + w->n_free + k);
  num whole = modulus(x + w->n_free + k), bound[3];
  mat rate = rate_of(phase), back = by_ball(rate, integer(-1)), side[2];
  int zeros[2];
  side[turned] = part(o->start[k], 0, 0, sys.side, 1);
  side[!turned] = part(o->end[k], 0, 0, sys.side, 1);
  zeros[turned] = zeros_at_start(w, k, mass, e);
  zeros[!turned] = ends(w, k, mass, e);
  mat c = by_ball(row_of(e, mass, phase[mass], x + equations(w) + mass), integer(sign)), slope = times(c, rate);
  bool finite = true;
  for (int i = 0; i < FLINT_MAX(FLINT_MAX(zeros[0], zeros[1]), 2); i++) {
    bound[i] = bend_bound(phase, c, side[0], rate, 2 + i, whole);
    if (i > 0 || !strchr(phase, 's'))
      bound[i] = least_of(bound[i], bend_bound(phase, slope, side[0], rate, 1 + i, whole));
    finite = finite && arb_is_finite(bound[i]);
  }
  arb_ptr half = fresh();
  arb_get_ubound_arf(arb_midref(half), scaled(whole, -1), prec);
  int answer = OPEN;
  if (arb_is_finite(half) && finite) {
    answer = half_below(c, side[0], rate, zeros[0], half, bound);
    if (answer == YES) answer = half_below(c, side[1], back, zeros[1], half, bound);
  }
  release(before);
  return answer;
}
