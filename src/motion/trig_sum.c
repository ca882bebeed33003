/* The first root of a switching function in double precision.

   Seen from inside one phase every switching function is a constant, a drift and at most two oscillations.  Its second
   derivative has a bound that holds for all time, so from any point below zero a parabola tells how long it must stay
   below zero.  Walking along those parabolas reaches the first root quadratically and steps over none.  Close to zero
   the nearest maximum is solved for, which tells two close roots, a touching and a miss apart.  A walk that gets long
   looks at envelopes too: with one oscillation, or both, at its crest all the time, what is left is slow, and where it
   stays below zero so does the wave, however fast the oscillation left out. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/work.h"
#include "num/pi.h"
#include "slip.h"
#include "trig_sum.h"

const struct dyn_limits dyn_limits_default = {1000, 100000};

/* The angles of the oscillations at a time. */
struct angles {
  double sine[2], versine[2];
};

static void look_at(double value[3], struct angles *at, const struct trig_sum *w, double t) {
  double f = w->start + w->drift * t, d = w->drift, dd = 0;
  for (int i = 0; i < 2; i++) {
    double om = w->om[i], s = sin(0.5 * om * t), c = cos(0.5 * om * t);
    double sine = at->sine[i] = 2 * s * c, versine = at->versine[i] = 2 * s * s;
    f += w->sn[i] * sine - w->cs[i] * versine;
    d += om * (w->sn[i] * (1 - versine) - w->cs[i] * sine);
    dd -= om * om * (w->sn[i] * sine + w->cs[i] * (1 - versine));
  }
  value[0] = f;
  value[1] = d;
  value[2] = dd;
}

void trig_sum_at(double value[3], const struct trig_sum *w, double t) {
  struct angles at;
  look_at(value, &at, w, t);
}

/* A wave turned so that it starts below zero, with its amplitudes and bounds. */
struct walk {
  struct trig_sum w;
  double amp[2], mean;
  double bound;     /* of |f''| */
  double speed;     /* of |f'| without drift */
  double fastest;   /* the highest frequency that has an amplitude */
  double top;       /* the highest value without drift */
  double slack;     /* depth that a stretch must have to be jumped over unseen */
  double level[2];  /* the height that a mode must have for f to reach -slack */
  double window[2]; /* and the phase angles around its crest in which it has; infinite when all */
};

static double scale_of(const struct walk *k) {
  return fabs(k->w.start) + fabs(k->mean) + k->amp[0] + k->amp[1];
}

static double tolerance(const struct walk *k, double t) {
  return DBL_EPSILON * (2 * scale_of(k) + t * (fabs(k->w.drift) + k->speed));
}

/* The sign of the wave, of these amplitudes, just after its start: that of its first derivative, from the 0th, that is
   not zero.  *first receives half of a time through which the sign surely lasts. */
static double starting_sign(double *first, const struct trig_sum *w, const double amp[2]) {
  *first = 0;
  if (w->start != 0) return w->start > 0 ? 1 : -1;
  double quad[2] = {1, 1}; /* om^k */
  for (int k = 1; k <= 6; k++) {
    double value = k == 1 ? w->drift : 0, size = fabs(value), next = 0;
    for (int i = 0; i < 2; i++) {
      quad[i] *= w->om[i];
      double coefficient = k % 2 == 1 ? w->sn[i] : w->cs[i];
      double sign = k % 4 == 1 || k % 4 == 0 ? 1 : -1;
      value += sign * coefficient * quad[i];
      size += amp[i] * quad[i];
      next += amp[i] * quad[i] * w->om[i];
    }
    if (fabs(value) > 8 * DBL_EPSILON * size) {
      *first = next > 0 ? 0.5 * (k + 1) * fabs(value) / next : INFINITY;
      return value > 0 ? 1 : -1;
    }
  }
  return 0;
}

/* Its amplitudes are there. */
static void walk_init(struct walk *k, const struct trig_sum *w, double sign) {
  k->w = *w;
  k->w.start *= -sign;
  k->w.drift *= -sign;
  k->bound = k->speed = k->fastest = 0;
  k->mean = k->w.start;
  for (int i = 0; i < 2; i++) {
    k->w.cs[i] *= -sign;
    k->w.sn[i] *= -sign;
    k->bound += k->w.om[i] * k->w.om[i] * k->amp[i];
    k->speed += k->w.om[i] * k->amp[i];
    if (k->amp[i] > 0) k->fastest = fmax(k->fastest, k->w.om[i]);
    k->mean -= k->w.cs[i];
  }
  k->top = k->mean + k->amp[0] + k->amp[1];
  k->slack = 0.25 * fmax(k->top, 0) + 0.02 * (k->amp[0] + k->amp[1]);
  for (int i = 0; i < 2; i++) {
    k->level[i] = -k->slack - k->mean - k->amp[1 - i];
    bool low = k->w.drift == 0 && k->level[i] > -k->amp[i];
    k->window[i] = low ? acos(fmin(k->level[i] / k->amp[i], 1)) : (double)INFINITY;
  }
}

/* How long f surely stays below -slack because one of the modes is too low; 0 when neither is. */
static double wait_for_modes(const struct walk *k, const struct angles *at, double t) {
  double longest = 0;
  for (int i = 0; i < 2; i++) {
    if (!(k->window[i] < INFINITY)) continue;
    double s = at->sine[i], c = 1 - at->versine[i], high = k->w.cs[i] * c + k->w.sn[i] * s;
    if (high >= k->level[i]) continue;
    double angle = atan2(k->w.cs[i] * s - k->w.sn[i] * c, high); /* from the last crest */
    if (fabs(angle) <= k->window[i]) continue;
    double wait = ((angle < 0 ? 0 : 2 * PI) - k->window[i] - angle) / k->w.om[i];
    longest = larger(wait * (1 - 1e-12) - 4 * DBL_EPSILON * t, longest);
  }
  return longest;
}

/* A stretch through which an envelope proves that f stays below zero. */
struct excluded {
  double h;     /* its length; 0 when there is none */
  double depth; /* f <= -depth in it; infinite when f has no maximum there */
};

/* How long y + d s + bend s^2/2 stays below zero, y < 0. */
static double parabola(double y, double d, double bend) {
  double disc = sqrt(d * d - 2 * bend * y);
  return d > 0 ? -2 * y / (disc + d) : bend > 0 ? (disc - d) / bend : (double)INFINITY;
}

/* The longest stretch after t through which an envelope keeps below half of its present depth.  The half gives what a
   moving parameter may eat up, and covers the rounding of both ends. */
static struct excluded below_envelopes(const struct walk *k, const struct angles *at, double t) {
  struct excluded best = {.h = 0};
  double base = k->mean + k->w.drift * t, value[2], rate[2];
  for (int i = 0; i < 2; i++) {
    double s = at->sine[i], c = 1 - at->versine[i];
    value[i] = k->w.cs[i] * c + k->w.sn[i] * s;
    rate[i] = k->w.om[i] * (k->w.sn[i] * c - k->w.cs[i] * s);
  }
  for (int kept = 0; kept < 4; kept++) { /* a bit for each oscillation that is followed; 3 would be f itself */
    if (kept == 3) continue;
    double top = base, d = k->w.drift, bend = 0, speed = fabs(d), other = 0;
    for (int i = 0; i < 2; i++) {
      bool followed = kept & 1 << i;
      top += followed ? value[i] : k->amp[i];
      if (followed) d += rate[i];
      if (followed) bend += k->w.om[i] * k->w.om[i] * k->amp[i];
      *(followed ? &speed : &other) += k->w.om[i] * k->amp[i];
    }
    /* an oscillation left out has no angle that the rounding of t could spoil */
    if (!(top < -4 * DBL_EPSILON * (2 * scale_of(k) + t * speed))) continue;
    double h = parabola(0.5 * top, d, bend) * (1 - 1e-9);
    if (!(h > best.h)) continue;
    bool rises = d - bend * h > other, falls = d + bend * h < -other;
    best = (struct excluded){h, rises || falls ? (double)INFINITY : -0.5 * top};
  }
  return best;
}

/* Minus the greatest value between two points of a walk on both sides of a crest, by the cubic through values and
   slopes. */
static double depth_between(const double from[3], const double to[3], double h) {
  double s = from[1] / (from[1] - to[1]), r = 1 - s;
  double cubic = from[0] * r * r * (1 + 2 * s) + to[0] * s * s * (1 + 2 * r) + h * s * r * (from[1] * r - to[1] * s);
  return -cubic;
}

/* Newton's iteration for a root near t, or for a root of the derivative (order 1); both are known to be simple.  v is
   the wave at t, and then at the root. */
static double polish(double v[3], const struct trig_sum *w, double t, int order) {
  for (int i = 0; i < 4; i++) {
    double step = -v[order] / v[order + 1];
    t += step;
    trig_sum_at(v, w, t);
    if (fabs(step) <= DBL_EPSILON * t) break;
  }
  return t;
}

enum { LONG_WALK = 32 };
static const double KNOWN_ANGLE = 0x1p50; /* beyond it rounding of the time leaves less than three bits of an angle */

enum verdict { PASSING, CROSSING, TOUCHING };

/* f is within tol of zero at *t: what happens there.  *t becomes the root, and v what the wave is there. */
static enum verdict look_closely(double *t, double v[3], const struct walk *k, double tol) {
  bool steep = v[1] * v[1] > 16 * k->bound * tol;
  if (steep && v[1] < 0) return PASSING; /* on its way down, as at the start of a phase */
  if (steep) {
    *t = polish(v, &k->w, *t, 0);
    return CROSSING;
  }
  double lie = v[1] / -v[2]; /* of the crest ahead */
  if (!(fabs(lie) < 1e5 * sqrt(tol / k->bound))) return TOUCHING;
  if (v[2] > 0) return v[1] > 0 ? TOUCHING : PASSING;
  *t = polish(v, &k->w, *t, 1);
  if (!(v[0] > fmax(tol, tolerance(k, *t)))) return TOUCHING;
  *t -= sqrt(2 * v[0] / -v[2]);
  trig_sum_at(v, &k->w, *t);
  *t = polish(v, &k->w, *t, 0);
  return CROSSING;
}

/* The less of safe and of how far the parameter can move before a maximum at t that is `clear` away from zero can reach
   it. */
static double safe_move(double safe, const struct trig_sum_shift *shift, double t, double clear) {
  if (!shift || !(clear > 0)) return 0;
  double v[3], least = clear / shift->most;
  if (least >= safe) return safe;
  trig_sum_at(v, &shift->rate, t);
  double speed = 1.25 * fabs(v[0]), bend = 1.25 * shift->bend;
  return fmin(safe, fmax(2 * clear / (speed + sqrt(speed * speed + 4 * bend * clear)), least));
}

/* A wave without oscillations. */
static int straight_root(struct trig_sum_root *root, const struct trig_sum *w) {
  root->t = -w->start / w->drift;
  root->rate = w->drift;
  return isfinite(root->t) && root->t > 0 ? SS_OK : SS_DOMAIN;
}

int trig_sum_first_root(struct trig_sum_root *root, const struct trig_sum *w, const struct trig_sum_shift *shift,
                        const struct dyn_limits *lim) {
  struct walk k = {.amp = {hypot(w->cs[0], w->sn[0]), hypot(w->cs[1], w->sn[1])}};
  double first, sign = starting_sign(&first, w, k.amp);
  *root = (struct trig_sum_root){.t = 0, .safe = INFINITY};
  if (sign == 0) return SS_DOMAIN;
  walk_init(&k, w, sign);
  if (k.bound == 0) return straight_root(root, w);
  if (k.w.drift <= 0 && k.top < -4 * tolerance(&k, 0)) {
    root->safe = shift ? -k.top / shift->most : 0;
    return SS_DOMAIN;
  }
  double end = k.w.drift < 0 ? fmax(k.top, 0) / -k.w.drift : (double)INFINITY; /* below zero ever after */
  double last = fmin(end, lim->t_max);

  double t = isfinite(first) ? first : 0, v[3], next[3];
  struct angles at;
  long counted = 0;
  look_at(v, &at, &k.w, t);
  for (root->steps = 1; root->steps <= lim->max_steps; root->steps++) {
    double tol = tolerance(&k, t);
    if (root->steps - counted >= WORK_BLOCK) {
      work_add((unsigned long long)(root->steps - counted) * UNITS_OF_STEP);
      counted = root->steps;
    }
    if (t > last) return end < lim->t_max ? SS_DOMAIN : SS_UNABLE;
    if (t * k.fastest > KNOWN_ANGLE) return SS_UNABLE;
    double h = 0;
    if (v[0] >= -tol) {
      double found = t;
      memcpy(next, v, sizeof next);
      enum verdict seen = look_closely(&found, next, &k, tol);
      if (seen != PASSING && found > 0) {
        root->t = found;
        root->rate = -sign * next[1];
        root->grazing = seen == TOUCHING;
        double lie = next[1] / k.bound; /* the crest ahead is not nearer and not lower than this tells */
        root->safe = safe_move(root->safe, shift, found + lie, 0.5 * next[1] * lie);
        return SS_OK;
      }
      if (v[1] * v[1] <= 16 * k.bound * tol) h = sqrt(tol / k.bound); /* out of the reach of rounding */
    }
    double y = v[0] < 0 ? v[0] : 0, disc = sqrt(v[1] * v[1] - 2 * k.bound * y);
    h = larger(v[1] > 0 ? -2 * y / (disc + v[1]) : (disc - v[1]) / k.bound, h);
    double wait = wait_for_modes(&k, &at, t);
    if (wait > h) {
      h = wait;
      if (shift) root->safe = fmin(root->safe, k.slack / shift->most);
    }
    if (root->steps > LONG_WALK) {
      struct excluded out = below_envelopes(&k, &at, t);
      root->steps++; /* it costs as much as the step */
      if (out.h > h) {
        wait = h = fmin(out.h, lim->t_max);
        if (shift) root->safe = fmin(root->safe, out.depth / shift->most);
      }
    }
    h = larger(DBL_EPSILON * t, h);
    look_at(next, &at, &k.w, t + h);
    if (h > wait && v[1] > 0 && next[1] < 0)
      root->safe = safe_move(root->safe, shift, t + h * v[1] / (v[1] - next[1]), depth_between(v, next, h));
    t += h;
    memcpy(v, next, sizeof v);
  }
  return SS_UNABLE;
}
