/* Every zero of the return map's defect that double precision can see.

   t_b runs over the intervals in which the rise of phase Gamma is at a record: one in each period, (rise, fall) after
   its start, the first from 0.  Between two samples the defect is smooth when no root of phase H can have jumped
   (pass.safe) and q_c keeps its sign.  A smooth interval is done with when its end values and slopes
   leave room for no zero, or for exactly one; any other is divided, close to the jump or the zero of q_c that its ends
   see, else halved.  So a jump is closed in on from both sides, and what stays undecided when the parts get small is an
   extremum that almost touches zero: it is handed on as a fold.  Where each of two ends excludes a jump by itself, the
   root is followed between them instead of searched for. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "base/work.h"
#include "num/pi.h"
#include "search.h"
#include "trig_sum.h"

enum {
  FIRST_SAMPLES = 96,  /* of the first rise */
  LATER_SAMPLES = 12,  /* of each later one */
  AHEAD = 4,           /* samples at a time, a divisor of both: the last of them is evaluated first */
  GUIDED_DEPTH = 12,   /* divisions where ends see something; then halvings */
  HALVINGS = 56,       /* of a sample's interval, which make it too small to be divided */
  MAX_STEPS = 6000000, /* of all first-root searches together: below a second; half of it for the later rises, what
                          they leave, at least half, for the first */
  FREE_STEPS =
      1 << 20,   /* of a whole search, more than usual parameters ask for: counted as work when they are used up */
  PASS_STEPS = 4 /* what a pass costs besides its search, in the same coin */
};

/* A pass calls 4/5 of the way to a jump safe: a pass 8/9 of the way on, at 10/9 of that, is safe back to there. */
static const double FURTHER = 1.1;

/* Whether each of two passes sees by itself that t_c jumps nowhere between them. */
static bool is_clear(const struct pass *a, const struct pass *b) {
  double w = b->tb - a->tb;
  return !a->status && !b->status && !a->grazing && !b->grazing && a->safe > w && b->safe > w;
}

/* At a t_b between two passes, or with none of them known. */
static void evaluate(struct search *s, struct pass *p, double tb, const struct pass *a, const struct pass *b) {
  const struct pass *near = NULL;
  if (a && b && is_clear(a, b)) near = tb - a->tb < b->tb - tb ? a : b;
  return_map_double_pass(p, &s->k, tb, near, &s->lim);
  s->evaluations++;
  long before = s->steps / FREE_STEPS;
  s->steps += p->steps + PASS_STEPS;
  if (s->steps / FREE_STEPS > before) work_add((unsigned long long)FREE_STEPS * UNITS_OF_STEP);
}

static void add_zero(struct search *s, const struct pass *p, double low, double high, bool fold) {
  *SS_PUSH(s->zeros, s->n, s->cap) = (struct zero){{p->tb, p->tc, p->r_end > 0}, low, high, fold, p->grazing};
}

/* Newton's iteration for the only zero between two samples of different sign, held by its bracket. */
static void polish(struct search *s, const struct pass *from, const struct pass *to) {
  struct pass a = *from, b = *to, m = fabs(a.defect) < fabs(b.defect) ? a : b;
  for (int i = 0; i < 60; i++) {
    double next = m.tb - m.defect / m.slope;
    if (!(next >= a.tb && next <= b.tb)) next = 0.5 * (a.tb + b.tb);
    if (m.defect == 0 || fabs(next - m.tb) <= 2 * DBL_EPSILON * next || !(next > a.tb && next < b.tb)) break;
    const struct pass *low = s->rough ? &a : NULL; /* else the digits of a zero do not hang on what was followed */
    evaluate(s, &m, next, low, &b);
    if (m.status) break;
    if ((m.defect < 0) == (a.defect < 0))
      a = m;
    else
      b = m;
  }
  add_zero(s, &m, from->tb, to->tb, false);
}

enum content { NO_ZERO, ONE_ZERO, UNDECIDED };

/* What a smooth interval holds, from end values and slopes: a cubic strays from its chord by at most 4/27 of the
   width times the sum of the slopes' deviations; here it may stray three times as far. */
static enum content look_between(const struct pass *a, const struct pass *b) {
  double w = b->tb - a->tb, chord = (b->defect - a->defect) / w;
  double bend = fabs(a->slope - chord) + fabs(b->slope - chord);
  if ((a->defect < 0) != (b->defect < 0)) return bend < 0.5 * fabs(chord) ? ONE_ZERO : UNDECIDED;
  return fmin(fabs(a->defect), fabs(b->defect)) > 0.5 * w * bend ? NO_ZERO : UNDECIDED;
}

/* Whether q_c keeps away from zero, where phase C changes its direction, or moves one way only; the same reasoning. */
static bool same_direction(const struct pass *a, const struct pass *b) {
  double w = b->tb - a->tb, chord = (b->qc - a->qc) / w;
  double bend = fabs(a->dqc - chord) + fabs(b->dqc - chord);
  return (a->qc < 0) == (b->qc < 0) && (fmin(fabs(a->qc), fabs(b->qc)) > 0.5 * w * bend || bend < 0.5 * fabs(chord));
}

/* Where an interval that is not smooth is divided: near the zero of q_c that Newton's step sees from the nearer end,
   or, when that is close by, just behind it; in the middle of what lies between jumps seen from both ends, or, when
   that seems to be one jump, before it, as far from the end that sees further as a pass sees back; else halfway. */
static double division(const struct pass *a, const struct pass *b, bool joined) {
  double mid = 0.5 * (a->tb + b->tb), w = b->tb - a->tb, at = mid;
  if (joined && (a->qc < 0) != (b->qc < 0)) {
    double from_a = -a->qc / a->dqc, from_b = -b->qc / b->dqc, close = 1e-8 * b->tb;
    bool first = fabs(from_a) < fabs(from_b);
    double step = first ? from_a : from_b;
    if (fabs(step) < close) step = first ? close : -close;
    at = (first ? a->tb : b->tb) + step;
  } else if (!joined) {
    double from_a = fmin(a->safe, w), from_b = fmin(b->safe, w), seen = FURTHER * (from_a + from_b);
    at = mid + 0.5 * (from_a - from_b);
    if (seen > 0.8 * w && seen < w) at = from_a > from_b ? a->tb + FURTHER * from_a : b->tb - FURTHER * from_b;
  }
  return at > a->tb && at < b->tb ? at : mid;
}

/* Whether the slope at p leads to no zero within w: a narrow interval with a jump can then hide none on p's side. */
static bool far_from_zero(const struct pass *p, double w) {
  return p->status || fabs(p->defect) > 16 * w * fabs(p->slope);
}

/* A narrow smooth interval that rounding leaves undecided: an extremum, or a zero near one of its ends.  Widths near
   the resolution of t_b occur only beside a jump, where the two ends may even belong to different branches. */
static void add_doubtful(struct search *s, const struct pass *a, const struct pass *b) {
  double w = b->tb - a->tb;
  if (a->slope * b->slope < 0 && w > 1e-12 * b->tb) {
    add_zero(s, fabs(a->defect) < fabs(b->defect) ? a : b, a->tb, b->tb, true);
    return;
  }
  if (!far_from_zero(a, w)) add_zero(s, a, a->tb, b->tb, false);
  if (!far_from_zero(b, w)) add_zero(s, b, a->tb, b->tb, false);
}

static void scan(struct search *s, const struct pass *a, const struct pass *b, double finest, int depth) {
  double w = b->tb - a->tb;
  if (s->steps > s->allowed) {
    s->cut = true;
    return;
  }
  bool alike = (a->status == SS_OK) == (b->status == SS_OK);
  bool joined = alike && a->safe + b->safe > w;
  if (joined && a->status) return;
  bool smooth = joined && same_direction(a, b), narrow = w < 1e-7 * b->tb;
  if (smooth) {
    enum content c = look_between(a, b);
    if (c == ONE_ZERO) polish(s, a, b);
    if (c == UNDECIDED && narrow) add_doubtful(s, a, b);
    if (c != UNDECIDED || narrow) return;
  }
  double mid = 0.5 * (a->tb + b->tb);
  if (alike && depth < GUIDED_DEPTH) mid = division(a, b, joined);
  if ((narrow && far_from_zero(a, w) && far_from_zero(b, w)) || w <= finest || !(mid > a->tb && mid < b->tb)) return;
  struct pass m;
  evaluate(s, &m, mid, a, b);
  scan(s, a, &m, finest, depth + 1);
  scan(s, &m, b, finest, depth + 1);
}

static void scan_interval(struct search *s, double begin, double end, int n, double last, long share) {
  struct pass a, b, ahead;
  s->allowed = s->steps + share;
  evaluate(s, &a, begin, NULL, NULL);
  double stop = fmin(end, last);
  for (int i = 1; i <= n; i++) {
    if (s->steps > s->allowed) { /* scan would look at nothing more */
      s->cut = true;
      return;
    }
    if (i % AHEAD == 1) {
      int next = i + AHEAD - 1;
      double tb = next < n ? begin + (stop - begin) * next / n : stop;
      if (next == n && stop == end) tb -= 4 * DBL_EPSILON * end; /* at the crest m1 is at the belt's speed already */
      evaluate(s, &ahead, tb, NULL, NULL);
    }
    if (i % AHEAD == 0)
      b = ahead;
    else
      evaluate(s, &b, begin + (stop - begin) * i / n, &a, &ahead);
    scan(s, &a, &b, ldexp(b.tb - a.tb, -HALVINGS), 0);
    a = b;
  }
}

int search_run(struct search *s, const double params[N_PARAMS], bool late, bool rough, const struct dyn_limits *lim) {
  *s = (struct search){.lim = *lim, .rough = rough};
  if (return_map_double_init(&s->k, params)) return SS_DOMAIN;
  return_map_double_records(&s->k);
  const struct return_map_double *k = &s->k;
  /* r at the stick phase is at least -reach: no t_b beyond this time leads to an orbit. */
  double last =
      fmin(1.001 * return_map_double_time(k, k->slip.rb + 1.001 * return_map_double_reach(k)) + 1e-6, lim->t_max);
  long later = (long)(last / (2 * PI)) + 1;
  for (long i = 1; late && 2 * PI * (double)i + k->rise < last; i++) {
    double turn = 2 * PI * (double)i;
    scan_interval(s, turn + k->rise, turn + k->fall, LATER_SAMPLES, last, MAX_STEPS / 2 / later);
  }
  scan_interval(s, 0, k->fall, FIRST_SAMPLES, last, s->steps < MAX_STEPS / 2 ? MAX_STEPS - s->steps : MAX_STEPS / 2);
  return SS_OK;
}

void search_clear(struct search *s) {
  free(s->zeros);
}
