/* The motion of a system of masses: the word's equations, a proof that a box holds one solution, and functions along a
   phase.  All motion is exp(A t) y, by Arb's matrix exponential; check.c says what is proved how. */
#include <stdlib.h>
#include <string.h>

#include "checker.h"

struct system sys;

/* --- Phases and their functions --- */

/* sign q into an entry of a matrix. */
static void put(mat m, slong i, slong j, const fmpq *q, int sign) {
  arb_set_fmpq(arb_mat_entry(m, i, j), q, prec);
  if (sign < 0) arb_neg(arb_mat_entry(m, i, j), arb_mat_entry(m, i, j));
}

/* The row c with c y the function of an event, from which the limit r_i is not yet subtracted. */
static mat row_of(enum event e, int i, char letter) {
  int n = sys.n, one = sys.side - 1, sign = e == FASTER || e == BELOW || (e == REACHES && letter == '+') ? -1 : 1;
  mat c = matrix(1, sys.side);
  if (e >= BELOW) put(c, 0, one, &sys.position[e == ABOVE][i], -sign);
  if (e == REACHES) put(c, 0, one, &sys.surface[i], -sign);
  if (e >= REACHES) arb_set_si(arb_mat_entry(c, 0, e == REACHES ? n + i : i), sign);
  for (int j = 0; j < n && e < REACHES; j++) {
    put(c, 0, j, fmpq_mat_entry(sys.stiffness, i, j), sign);
    put(c, 0, n + j, fmpq_mat_entry(sys.damping, i, j), sign);
  }
  for (int j = 2 * n; j < one && e < REACHES; j++) put(c, 0, j, fmpq_mat_entry(sys.load, i, j - 2 * n), -sign);
  return c;
}

/* A of a phase: m_i x_i'' = -f_i, s_i - f_i or -s_i - f_i. */
static mat rate_of(const char *phase) {
  int n = sys.n, one = sys.side - 1;
  mat a = matrix(sys.side, sys.side);
  for (int i = 0; i < n; i++) {
    arb_one(arb_mat_entry(a, i, n + i));
    if (phase[i] == 's') continue;
    mat c = row_of(FASTER, i, 's');
    num m = rational(&sys.inertia[i]);
    if (phase[i] != '.') put(c, 0, one, &sys.sliding[i], phase[i] == '-' ? 1 : -1);
    for (int j = 0; j <= one; j++) arb_div(arb_mat_entry(a, n + i, j), arb_mat_entry(c, 0, j), m, prec);
  }
  if (one > 2 * n) put(a, 2 * n, 2 * n + 1, &sys.frequency, -1);
  if (one > 2 * n) put(a, 2 * n + 1, 2 * n, &sys.frequency, 1);
  return a;
}

num value(enum event e, int mass, const char *phase, mat y, num r) {
  num f = product(row_of(e, mass, phase[mass]), y);
  return e < REACHES ? sub(f, r) : f;
}

/* exp(A t) as exp(A mid) exp(A (t - mid)): the squarings inside the first see no radius. */
static mat propagator(mat a, num t) {
  num mid = middle(t);
  return times(exponential(by_ball(a, mid)), exponential(by_ball(a, sub(t, mid))));
}

mat after(const char *phase, mat y, num t) {
  return times(propagator(rate_of(phase), t), y);
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
  *e = hit ? (to[sys.n] == '<' ? BELOW : ABOVE) : from[*mass] != 's' ? REACHES : to[*mass] == '-' ? SLOWER : FASTER;
  return true;
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
    if (i != changed || e == REACHES) w->place[w->n_free++] = i;
  for (int i = 0; i < sys.n; i++)
    if (w->phase[0][i] != 's' && (i != changed || e >= BELOW)) w->place[w->n_free++] = sys.n + i;
  if (sys.side > 2 * sys.n + 1) w->place[w->n_free++] = 2 * sys.n;
  return true;
}

/* The function of the event of a mass, and its derivatives by the numbers, into row k of f and j. */
static void meet(struct motion *o, int k, enum event e, int mass, char letter, mat y, mat s, arb_srcptr limit) {
  mat c = row_of(e, mass, letter), row = times(c, s);
  slong m = arb_mat_ncols(s) - sys.n;
  if (e < REACHES) arb_sub_ui(arb_mat_entry(row, 0, m + mass), arb_mat_entry(row, 0, m + mass), 1, prec);
  for (slong l = 0; l < m + sys.n; l++) arb_set(arb_mat_entry(o->j, k, l), arb_mat_entry(row, 0, l));
  arb_set(arb_mat_entry(o->f, k, 0), e < REACHES ? sub(product(c, y), limit + mass) : product(c, y));
}

/* y at the start of the word, and its derivatives s.  A mass that has just changed its mode or rebounded is where its
   event says: at its surface's velocity, at the obstacle, where its force is at the limit. */
static void begin(struct motion *o, mat y, mat s, const struct word *w, arb_srcptr x) {
  int i = w->mass[w->n - 1];
  enum event e = w->event[w->n - 1];
  arb_one(arb_mat_entry(y, sys.side - 1, 0));
  for (int k = 0; k < sys.n; k++)
    if (w->phase[0][k] == 's' || (k == i && e <= REACHES)) put(y, sys.n + k, 0, &sys.surface[k], 1);
  if (e >= BELOW) put(y, i, 0, &sys.position[e == ABOVE][i], 1);
  for (int l = 0; l < w->n_free; l++) {
    int p = w->place[l];
    arb_set(arb_mat_entry(y, p, 0), x + l);
    arb_one(arb_mat_entry(s, p, l));
    if (p < 2 * sys.n) continue;
    arb_sin_cos(arb_mat_entry(y, p + 1, 0), arb_mat_entry(y, p, 0), x + l, prec);
    arb_neg(arb_mat_entry(s, p, l), arb_mat_entry(y, p + 1, 0));
    arb_set(arb_mat_entry(s, p + 1, l), arb_mat_entry(y, p, 0));
  }
  if (e >= REACHES) return;
  num by = mul(integer(e == SLOWER ? -1 : 1), rational(fmpq_mat_entry(sys.stiffness, i, i)));
  meet(o, 0, e, i, 's', y, s, x + equations(w)); /* x_i is still zero; row 0 is made again later */
  arb_div(arb_mat_entry(y, i, 0), arb_mat_entry(o->f, 0, 0), by, prec);
  for (slong l = 0; l < arb_mat_ncols(s); l++) arb_div(arb_mat_entry(s, i, l), arb_mat_entry(o->j, 0, l), by, prec);
}

static void scale_row(mat y, int row, num by) {
  for (slong l = 0; l < arb_mat_ncols(y); l++) arb_mul(arb_mat_entry(y, row, l), arb_mat_entry(y, row, l), by, prec);
}

void follow(struct motion *o, const struct word *w, arb_srcptr x) {
  int m = equations(w), nf = w->n_free;
  mat y = matrix(sys.side, 1), s = matrix(sys.side, m + sys.n);
  o->work = 0;
  o->f = matrix(m, 1);
  o->j = matrix(m, m + sys.n);
  begin(o, y, s, w, x);
  for (int k = 0; k < w->n; k++) {
    int i = w->mass[k];
    mat a = rate_of(w->phase[k]), e = propagator(a, x + nf + k);
    o->start[k] = y;
    o->end[k] = times(e, y);
    s = times(e, s);
    mat rate = times(a, o->end[k]);
    for (int l = 0; l < sys.side; l++) arb_set(arb_mat_entry(s, l, nf + k), arb_mat_entry(rate, l, 0));
    meet(o, k, w->event[k], i, w->phase[k][i], o->end[k], s, x + m);
    y = part(o->end[k], 0, 0, sys.side, 1);
    if (w->event[k] < BELOW) continue;
    num by = sub(integer(0), rational(&sys.restitution[w->event[k] == ABOVE][i]));
    scale_row(y, sys.n + i, by);
    scale_row(s, sys.n + i, by);
  }
  for (int l = 0; l < nf; l++) {
    bool angle = w->place[l] == 2 * sys.n; /* frequency times period is 2 pi turns */
    num f = angle ? mul(pi(), integer(-2 * w->turns)) : sub(arb_mat_entry(y, w->place[l], 0), x + l);
    for (int k = 0; k < m + sys.n; k++) {
      num d = angle ? integer(0) : sub(arb_mat_entry(s, w->place[l], k), integer(k == l));
      if (angle && k >= nf && k < m) {
        d = rational(&sys.frequency);
        f = add(f, mul(d, x + k));
      }
      arb_set(arb_mat_entry(o->j, w->n + l, k), d);
    }
    arb_set(arb_mat_entry(o->f, w->n + l, 0), f);
  }
}

mat return_matrix(const struct motion *o, const struct word *w) {
  int nf = w->n_free, n = w->n; /* events and return, by lengths and by what is free */
  mat gt = part(o->j, 0, nf, n, n), gq = part(o->j, 0, 0, n, nf), moved = matrix(n, nf);
  mat rt = part(o->j, n, nf, nf, n), rq = part(o->j, n, 0, nf, nf);
  if (!arb_mat_solve(moved, gt, gq, prec)) arb_mat_indeterminate(moved);
  for (int l = 0; l < nf; l++) arb_add_ui(arb_mat_entry(rq, l, l), arb_mat_entry(rq, l, l), 1, prec);
  return minus(rq, times(rt, moved));
}

/* --- One solution in a box --- */

/* The columns of the unknowns. */
static mat unknown_columns(mat j, const struct word *w) {
  mat out = matrix(equations(w), equations(w));
  for (slong k = 0, l = 0; k < arb_mat_ncols(j); k++)
    for (slong i = 0; !w->known[k] && i <= equations(w); i++) {
      if (i == equations(w))
        l++;
      else
        arb_set(arb_mat_entry(out, i, l), arb_mat_entry(j, i, k));
    }
  return out;
}

/* Krawczyk's operator on the box x: mid - Y f(mid) + (1 - Y J(x)) (x - mid), Y the rounded inverse of J(mid).  Every
   solution in the box lies in the image; an image inside the box proves that there is exactly one. */
static bool krawczyk(arb_ptr image, arb_srcptr x, const struct word *w) {
  int m = equations(w), l = 0;
  struct motion at_mid, all;
  mat off = matrix(m, 1), one = matrix(m, m);
  arb_mat_one(one);
  for (int k = 0; k < m + sys.n; k++) {
    arb_set(image + k, w->known[k] ? x + k : middle(x + k));
    if (!w->known[k]) arb_sub(arb_mat_entry(off, l++, 0), x + k, image + k, prec);
  }
  follow(&at_mid, w, image);
  follow(&all, w, x);
  mat y = middles(unknown_columns(at_mid.j, w));
  bool inside = arb_mat_inv(y, y, prec);
  y = middles(y);
  off = minus(times(minus(one, times(y, unknown_columns(all.j, w))), off), times(y, at_mid.f));
  for (int k = m + sys.n - 1; k >= 0; k--) {
    if (w->known[k]) continue;
    arb_add(image + k, image + k, arb_mat_entry(off, --l, 0), prec);
    inside = inside && arb_is_finite(image + k) && arb_contains_interior(x + k, image + k);
  }
  return inside;
}

bool enclose(arb_ptr x, bool *proved, const struct word *w) {
  int all = equations(w) + sys.n;
  bool halved = true;
  arb_ptr image = _arb_vec_init(all);
  for (int i = 0; i < 64 && halved; i++) {
    struct mark mark = here();
    for (int k = 0; k < all; k++)
      if (w->known[k]) arb_set_fmpq(x + k, &w->number[k], prec);
    *proved = krawczyk(image, x, w) || *proved;
    halved = false;
    for (int k = 0; *proved && k < all; k++) {
      if (w->known[k] || !arb_is_finite(image + k)) continue;
      halved = halved || mag_cmp(arb_radref(scaled(image + k, 1)), arb_radref(x + k)) < 0;
      if (arb_intersection(image + k, image + k, x + k, prec)) arb_set(x + k, image + k);
    }
    release(mark);
  }
  _arb_vec_clear(image, all);
  return *proved;
}

/* --- A function along a phase --- */
enum { MAX_LEVEL = 80, MAX_WORK = 1 << 28 };

struct walk {
  mat rate, row[3];              /* c, c A, c A^2 */
  arb_mat_t step[MAX_LEVEL + 1]; /* exp(A length/2^level), where it has been needed */
  bool made[MAX_LEVEL + 1];
  num limit, length, bound[2]; /* of |f''|, |f'''| */
  int zeros;
  long *work;
};

/* A bound of |c y^(k)| on a phase; for k = 1 no mass sticks.  See check.c. */
static num bend_bound(const char *phase, mat c, mat y, mat rate, int k, num length) {
  int n = sys.n, one = sys.side - 1;
  mat stiff = matrix(n, n), by = matrix(n, 1), arm = matrix(n, 1);
  num energy = integer(0), weight = energy, push = energy, own = energy, pace = integer(1);
  for (int i = 0; i < k; i++) y = times(rate, y);
  for (int i = 0; i < n; i++) {
    num m = rational(&sys.inertia[i]);
    if (phase[i] == 's') arb_one(arb_mat_entry(stiff, i, i));
    if (phase[i] == 's') continue;
    for (int j = 0; j < n; j++) {
      if (phase[j] == 's') continue;
      put(stiff, i, j, fmpq_mat_entry(sys.stiffness, i, j), 1);
      energy = add(energy, mul(arb_mat_entry(stiff, i, j), mul(arb_mat_entry(y, i, 0), arb_mat_entry(y, j, 0))));
    }
    arb_set(arb_mat_entry(by, i, 0), arb_mat_entry(c, 0, i));
    energy = add(energy, mul(m, square(arb_mat_entry(y, n + i, 0))));
    weight = add(weight, div_by(square(arb_mat_entry(c, 0, n + i)), m));
    for (int j = 2 * n; j < one; j++)
      push = add(push, div_by(square(rational(fmpq_mat_entry(sys.load, i, j - 2 * n))), m));
  }
  if (!arb_mat_spd_solve(arm, stiff, by, prec)) arb_mat_indeterminate(arm); /* it is proved positive definite */
  for (int i = 0; i < n; i++) weight = add(weight, mul(arb_mat_entry(by, i, 0), arb_mat_entry(arm, i, 0)));
  for (int i = 0; i < k && one > 2 * n; i++) pace = mul(pace, rational(&sys.frequency));
  for (int j = 2 * n; j < one; j++) own = add(own, square(arb_mat_entry(c, 0, j)));
  num speed = add(root(energy), mul(mul(pace, length), root(push)));
  return add(mul(root(weight), speed), mul(pace, root(own)));
}

static num value_on(const struct walk *w, mat y) {
  return w->limit ? sub(product(w->row[0], y), w->limit) : product(w->row[0], y);
}

/* Is f < 0 on the piece of the walk that starts at y?  The first piece may start at zeros: f(t) <= f(0) + t rise, where
   two are f(t) <= t^2/2 rise. */
static int below(struct walk *w, mat y, int level, bool first) {
  struct mark mark = here();
  int zeros = first ? w->zeros : 0;
  num length = scaled(w->length, -level), f = value_on(w, y), rate = product(w->row[zeros == 2 ? 2 : 1], y);
  num rise =
      add(rate, zeros == 2 ? mul(w->bound[1], div_by(length, integer(3))) : mul(w->bound[0], scaled(length, -1)));
  bool negative = zeros ? arb_is_negative(rise) : arb_is_negative(f) && arb_is_negative(add(f, mul(length, rise)));
  int answer = negative ? YES : arb_is_positive(zeros ? rate : f) ? NO : OPEN;
  *w->work += sys.side * sys.side;
  if (answer == OPEN && level < MAX_LEVEL && *w->work < MAX_WORK) {
    if (!w->made[level + 1]) {
      arb_mat_init(w->step[level + 1], sys.side, sys.side);
      arb_mat_set(w->step[level + 1], exponential(by_ball(w->rate, scaled(length, -1))));
      w->made[level + 1] = true;
    }
    mat next = times(w->step[level + 1], y);
    answer = arb_is_positive(value_on(w, next)) ? NO : below(w, y, level + 1, first);
    if (answer == YES) answer = below(w, next, level + 1, false);
  }
  release(mark);
  return answer;
}

/* Over the phase but for the end where f(T - u) <= -u (f'(T) - B u/2) < 0, 0 < u < 2 f'(T)/B: half of that, or less. */
static int walk_phase(struct walk *w, const struct along *a, mat start, mat end, num whole) {
  arb_ptr length = fresh();
  num slack = integer(0), d = product(w->row[1], end);
  if (a->zero_end) {
    if (!arb_is_positive(d)) return arb_is_negative(d) ? NO : OPEN;
    slack = div_by(mul(d, whole), add(mul(w->bound[0], whole), d));
  }
  arb_zero(length);
  arb_get_ubound_arf(arb_midref(length), sub(whole, slack), prec);
  if (!arb_is_finite(length) || !arb_is_finite(w->bound[0]) || !arb_is_finite(w->bound[1])) return OPEN;
  if (a->zero_end && !arb_lt(mul(w->bound[0], sub(whole, length)), scaled(d, 1))) return OPEN;
  w->length = length;
  return arb_is_positive(length) ? below(w, start, 0, true) : YES;
}

int stays_below(const struct along *a, struct motion *o, const struct word *w, arb_srcptr x) {
  struct mark mark = here();
  const char *phase = w->phase[a->k];
  num whole = x + w->n_free + a->k;
  struct walk walk = {.rate = rate_of(phase), .zeros = a->zeros, .work = &o->work};
  walk.row[0] = row_of(a->event, a->mass, phase[a->mass]);
  for (int i = 1; i < 3; i++) walk.row[i] = times(walk.row[i - 1], walk.rate);
  if (a->event < REACHES) walk.limit = x + equations(w) + a->mass;
  for (int i = 0; i < 2; i++) {
    walk.bound[i] = bend_bound(phase, walk.row[0], o->start[a->k], walk.rate, 2 + i, whole);
    if (i > 0 || !strchr(phase, 's'))
      walk.bound[i] = least_of(walk.bound[i], bend_bound(phase, walk.row[1], o->start[a->k], walk.rate, 1 + i, whole));
  }
  int answer = walk_phase(&walk, a, o->start[a->k], o->end[a->k], whole);
  for (int i = 0; i <= MAX_LEVEL; i++)
    if (walk.made[i]) arb_mat_clear(walk.step[i]);
  release(mark);
  return answer;
}
