/* A curve of orbits followed in double precision, through folds.

   Predictor along the tangent, corrector by Newton's iteration on the two equations and the plane through the
   prediction; the parameter is measured so that the line has length 4, times as they are (the slow and the fast
   frequency being of order 1).  Changes are seen as changes of sign between two spots and narrowed down by Newton's
   iteration, which starts from the secant and, where it leaves the stretch, from ever smaller parts of it. */
#include "num/flint_more.h"
#include <math.h>
#include <string.h>

#include "curve.h"
#include "motion/trig_sum.h"

enum { LINE = 4 };
static const double LONGEST = 0.03, SHORTEST = 1e-9;

static double unit(const struct trace *t, int i) {
  return i == 0 ? LINE / (t->high - t->low) : 1;
}

static double length_of(const struct trace *t, const double x[3]) {
  double sum = 0;
  for (int i = 0; i < 3; i++) sum += x[i] * unit(t, i) * x[i] * unit(t, i);
  return sqrt(sum);
}

/* The way between two points, and the point at a share of it. */
static void way(double off[3], const double from[3], const double to[3]) {
  for (int k = 0; k < 3; k++) off[k] = to[k] - from[k];
}

static void along(double x[3], const double from[3], double share, const double off[3]) {
  for (int k = 0; k < 3; k++) x[k] = from[k] + share * off[k];
}

static double distance(const struct trace *t, const double x[3], const double y[3]) {
  double off[3];
  way(off, y, x);
  return length_of(t, off);
}

/* --- A spot. --- */

static double wave_rate(const struct trig_sum *w, double t) {
  double value[3];
  trig_sum_at(value, w, t);
  return value[1];
}

/* The greatest of the maxima inside (0, end); false when there is none. */
static bool wave_top(double *top, double *time, const struct trig_sum *w, double end) {
  double h = fmin(0.2 / w->om[1], end / 8), before = wave_rate(w, 0), value[3];
  bool any = false;
  if (!(end > 0) || end > 10000 * h) return false;
  for (double t = 0; t < end;) {
    double next = fmin(t + h, end), after = wave_rate(w, next);
    if (before > 0 && after <= 0 && next < end) {
      double low = t, high = next;
      for (int i = 0; i < 60; i++) {
        double mid = 0.5 * (low + high);
        *(wave_rate(w, mid) > 0 ? &low : &high) = mid;
      }
      trig_sum_at(value, w, low);
      if (!any || value[0] > *top) {
        *top = value[0];
        *time = low;
      }
      any = true;
    }
    before = after;
    t = next;
  }
  return any;
}

static void look_for(struct spot *s, struct view *v, enum dyn_change what) {
  if (what == CHANGE_H_V1 || what == CHANGE_H_V2) {
    if (what == CHANGE_H_V2 && v->curve->up) return;
    const struct harmonic f = ball_speed(&v->c, &v->m, &v->s, what == CHANGE_H_V1 ? 0 : 1);
    const struct trig_sum w = harmonic_trig_sum(&v->c, &f);
    s->known[what] = wave_top(&s->change[what], &s->time[what], &w, s->x[2]);
    return;
  }
  int status = v->c.status;
  val f = view_change(v, what, NULL);
  s->known[what] = f && !v->c.status;
  if (s->known[what]) s->change[what] = num_dual.get_d(f);
  v->c.status = status;
}

/* Tangent: the cross product of the equations' gradients, which along one curve keeps its direction. */
static bool spot_make(struct spot *s, const struct trace *t, const double x[3]) {
  OWNED(view) v;
  ARB_VECTOR(at, 3);
  *s = (struct spot){.x = {x[0], x[1], x[2]}};
  for (int i = 0; i < 3; i++) arb_set_d(at + i, x[i]);
  bool ok = view_open(&v, t->curve, at) == SS_OK;
  if (ok) {
    double g[2][3];
    const val rows[2] = {v.s.pc, v.s.defect};
    for (int i = 0; i < 2; i++)
      for (int k = 0; k < 3; k++) g[i][k] = num_arb.get_d(view_slope(&v, rows[i], k)) / unit(t, k);
    for (int k = 0; k < 3; k++)
      s->tangent[k] = (g[0][(k + 1) % 3] * g[1][(k + 2) % 3] - g[0][(k + 2) % 3] * g[1][(k + 1) % 3]) / unit(t, k);
    double length = length_of(t, s->tangent);
    for (int k = 0; k < 3; k++) s->tangent[k] /= length;
    ok = length > 0 && isfinite(length);
    for (int what = 0; what < N_CHANGES && ok; what++) look_for(s, &v, (enum dyn_change)what);
  }
  return ok;
}

/* --- Steps. --- */

/* The point of the curve in the plane through x across `normal`. */
static bool correct(double x[3], const struct trace *t, const double normal[3]) {
  const double plane[3] = {x[0], x[1], x[2]};
  bool settled = false, ok = true;
  ARB_VECTOR(at, 3);
  SIZED(arb_mat, j, 3, 3);
  SIZED(arb_mat, f, 3, 1);
  for (int i = 0; i < 8 && ok && !settled; i++) {
    OWNED(view) v;
    for (int k = 0; k < 3; k++) arb_set_d(at + k, x[k]);
    ok = view_open(&v, t->curve, at) == SS_OK;
    const val rows[2] = {v.s.pc, v.s.defect};
    double off = 0, step[3], size = 0;
    for (int k = 0; k < 3 && ok; k++) {
      for (int l = 0; l < 2; l++) arb_set(arb_mat_entry(j, l, k), view_slope(&v, rows[l], k));
      arb_set_d(arb_mat_entry(j, 2, k), normal[k] * unit(t, k) * unit(t, k));
      off += (x[k] - plane[k]) * normal[k] * unit(t, k) * unit(t, k);
    }
    for (int l = 0; l < 2 && ok; l++) arb_set(arb_mat_entry(f, l, 0), dual_value(rows[l]));
    arb_set_d(arb_mat_entry(f, 2, 0), off);
    arb_mat_get_mid(j, j);
    arb_mat_get_mid(f, f);
    ok = ok && arb_mat_solve(f, j, f, t->curve->prec) != 0;
    for (int k = 0; k < 3; k++) {
      step[k] = num_arb.get_d(arb_mat_entry(f, k, 0));
      x[k] -= step[k];
    }
    size = length_of(t, step);
    ok = ok && isfinite(size) && size < 1;
    settled = size < 1e-7; /* of the last step, whose square is left */
  }
  return ok && settled;
}

static double dot(const struct trace *t, const double a[3], const double b[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++) sum += a[k] * b[k] * unit(t, k) * unit(t, k);
  return sum;
}

bool trace_start(struct trace *t, const struct curve *b, const double x[3], double low, double high, int sense) {
  *t = (struct trace){.curve = b, .low = low, .high = high, .step = LONGEST / 8};
  if (!spot_make(&t->now, t, x)) return false;
  t->sense = sense * t->now.tangent[0] < 0 ? -1 : 1;
  for (int k = 0; k < 3; k++) t->now.tangent[k] *= t->sense;
  return true;
}

/* The spot at a distance h from now, or on the line's end. */
static bool try_step(struct spot *next, const struct trace *t, double h) {
  double x[3], off[3], ahead[3];
  along(ahead, t->now.x, h, t->now.tangent);
  memcpy(x, ahead, sizeof x);
  if (!correct(x, t, t->now.tangent) || distance(t, x, ahead) > 0.1 * h) return false;
  way(off, t->now.x, x);
  if (x[0] < t->low || x[0] > t->high) {
    double end = x[0] < t->low ? t->low : t->high;
    const double across[3] = {1, 0, 0};
    along(x, t->now.x, (end - t->now.x[0]) / off[0], off);
    x[0] = end;
    if (!correct(x, t, across)) return false;
    x[0] = end;
    way(off, t->now.x, x);
  }
  if (length_of(t, off) > 1.5 * h || !spot_make(next, t, x)) return false;
  for (int k = 0; k < 3; k++) next->tangent[k] *= t->sense;
  return dot(t, next->tangent, t->now.tangent) > 0.98;
}

bool trace_step(struct trace *t) {
  struct spot next;
  while (!try_step(&next, t, t->step)) {
    t->step *= 0.5;
    if (t->step < SHORTEST) return false;
  }
  double turn = dot(t, next.tangent, t->now.tangent);
  t->now = next;
  if (turn > 0.999) t->step = fmin(1.4 * t->step, LONGEST);
  return true;
}

/* --- Crossings. --- */

static bool between(const struct trace *t, const struct spot *a, const struct spot *b, const double x[3]) {
  double whole[3], off[3];
  way(whole, a->x, b->x);
  way(off, a->x, x);
  double length = length_of(t, whole), part = dot(t, off, whole) / length;
  double slack = 1e-9 + 1e-6 * length;
  return part > -slack && part < length + slack && length_of(t, off) < 1.5 * length + slack;
}

/* From the secant between the two spots, at which the function has different signs. */
static bool narrow(struct crossing *out, const struct trace *t, const struct spot *a, const struct spot *b,
                   enum dyn_change what) {
  double part = a->change[what] / (a->change[what] - b->change[what]);
  ARB_VECTOR(x, 4);
  for (int k = 0; k < 3; k++) arb_set_d(x + k, a->x[k] + part * (b->x[k] - a->x[k]));
  arb_set_d(x + 3, (a->change[what] > 0 ? a : b)->time[what]); /* of a touch: there it is the maximum that counts */
  bool ok = curve_newton(x, x + 3, t->curve, what) == SS_OK;
  out->what = what;
  for (int k = 0; k < 3; k++) out->x[k] = num_arb.get_d(x + k);
  out->time = num_arb.get_d(x + 3);
  return ok && between(t, a, b, out->x);
}

/* Halves the stretch until Newton's iteration stays in it. */
static bool find(struct crossing *out, const struct trace *t, struct spot a, struct spot b, enum dyn_change what) {
  for (int i = 0; i < 40; i++) {
    if (narrow(out, t, &a, &b, what)) return true;
    struct spot mid;
    double x[3], off[3];
    way(off, a.x, b.x);
    for (int k = 0; k < 3; k++) x[k] = 0.5 * (a.x[k] + b.x[k]);
    if (!correct(x, t, off) || !spot_make(&mid, t, x) || !mid.known[what]) return false;
    *((mid.change[what] < 0) == (a.change[what] < 0) ? &a : &b) = mid;
  }
  return false;
}

static bool crosses(const struct spot *a, const struct spot *b, int what) {
  return a->known[what] && b->known[what] && (a->change[what] < 0) != (b->change[what] < 0);
}

/* The spot just before the end of a branch, beyond which the other functions have no meaning.  With phase H several
   vanish of second order: nearer to it, rounding of t_b would decide their signs, and those that it does decide do not
   count. */
static bool stop_before(struct spot *before, const struct trace *t, const struct spot *a, const struct crossing *end) {
  double x[3], off[3], part = end->what == CHANGE_GAMMA_V1 ? 0.99 : 0.9999;
  way(off, a->x, end->x);
  along(x, a->x, part, off);
  if (!correct(x, t, off) || !spot_make(before, t, x)) return false;
  for (int i = CHANGE_FLIP; i <= CHANGE_FOLD && end->what == CHANGE_GAMMA_V1; i++)
    before->known[i] = before->known[i] && fabs(before->change[i]) > 1e-12;
  return true;
}

/* The crossings of the functions that end a branch, or of the others, put in order. */
static int collect(struct crossing *out, slong *missed, const struct trace *t, const struct spot *a,
                   const struct spot *b, bool ends) {
  int n = 0;
  for (int what = ends ? CHANGE_H_V1 : 0; what < (ends ? N_CHANGES : CHANGE_H_V1); what++) {
    struct crossing c = {.what = (enum dyn_change)what};
    if (!crosses(a, b, what)) continue;
    if (!find(&c, t, *a, *b, c.what)) {
      ++*missed;
      continue;
    }
    double off[3], whole[3];
    way(off, a->x, c.x);
    way(whole, a->x, b->x);
    c.along = dot(t, off, whole);
    int at = n++;
    for (; at > 0 && out[at - 1].along > c.along; at--) out[at] = out[at - 1];
    out[at] = c;
  }
  return n;
}

bool trace_crossings(struct crossing out[N_CHANGES], int *n, slong *missed, const struct trace *t, const struct spot *a,
                     const struct spot *b) {
  struct crossing ends[N_CHANGES];
  struct spot before;
  slong lost = 0;
  int n_ends = collect(ends, &lost, t, a, b, true), at = 0;
  for (int i = 0; i < n_ends; i++) /* a double t_c or a vanishing phase H makes others of what comes with it */
    if (ends[i].what == CHANGE_TC || ends[i].what == CHANGE_GAMMA_V1) {
      at = i;
      break;
    }
  *n = 0;
  if (n_ends == 0 && lost > 0) return false;
  if (n_ends > 0 && stop_before(&before, t, a, &ends[at])) b = &before;
  *n = collect(out, missed, t, a, b, false);
  if (n_ends > 0) out[(*n)++] = ends[at];
  return true;
}

bool trace_passes(const struct trace *t, const struct spot *a, const struct spot *b, const double x[3]) {
  double chord[3], off[3], near[3];
  way(chord, a->x, b->x);
  way(off, a->x, x);
  double part = dot(t, off, chord) / dot(t, chord, chord);
  if (!(part > -1e-6 && part < 1 + 1e-6)) return false;
  along(near, a->x, part, chord);
  if (distance(t, near, x) > 0.2 * length_of(t, chord)) return false;
  return correct(near, t, chord) && distance(t, near, x) < 1e-8 * (1 + fabs(x[1]) + fabs(x[2]));
}
