/* Anchors, and what stands between them.

   Between two anchors that hold the same number of orbits each orbit is followed at points of halving distance, the
   guess being interpolated from the points around it, so that half of the points are solved last and from the nearest
   guess, and all points of one level together.  An orbit counts as followed when it is one of the word, close to where it
   was expected and distinct from the others; the first level at which one is not ends the attempt, and the point there is
   searched and becomes an anchor. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "family_impl.h"
#include "stickslip/arena.h"

/* Orbits between two anchors: row k is one orbit, its column i the point first + i. */
struct strand {
  struct family_line *line;
  slong first, last, rows;
  struct dyn_member *m;
};

static struct dyn_member *strand_at(const struct strand *s, slong row, slong point) {
  return &s->m[row * (s->last - s->first + 1) + point - s->first];
}

static struct dyn_family_point *point_at(const struct family_line *l, slong begin, slong i) {
  return &l->f->point[i - begin];
}

/* --- Matching the orbits of two anchors. --- */

static double apart(const struct dyn_member *a, const struct dyn_member *b) {
  return fabs(a->out[DYN_OUT_TB] - b->out[DYN_OUT_TB]) + fabs(a->out[DYN_OUT_TC] - b->out[DYN_OUT_TC]);
}

/* Fills both ends of the strand; each orbit takes the nearest one that is left.  A wrong match is found out between. */
static bool match(struct strand *s, const struct dyn_family_point *a, const struct dyn_family_point *b) {
  const struct dyn_member *from = s->line->f->member + a->first, *to = s->line->f->member + b->first;
  bool *taken = ss_malloc((size_t)s->rows + 1), ok = true;
  memset(taken, 0, (size_t)s->rows + 1);
  for (slong k = 0; k < s->rows && ok; k++) {
    slong best = -1;
    for (slong i = 0; i < s->rows; i++)
      if (!taken[i] && from[k].up == to[i].up && (best < 0 || apart(&from[k], &to[i]) < apart(&from[k], &to[best])))
        best = i;
    ok = best >= 0;
    if (!ok) break;
    taken[best] = true;
    *strand_at(s, k, s->first) = from[k];
    *strand_at(s, k, s->last) = to[best];
  }
  free(taken);
  return ok;
}

/* --- Prediction. --- */

/* Weights of the polynomial through the values at the given points. */
static int weights(double weight[4], slong node[4], const struct strand *s, slong point, slong h) {
  slong left = point - h, right = point + h < s->last ? point + h : s->last;
  int n = 0;
  if (left > s->first) node[n++] = left - 2 * h;
  node[n++] = left;
  node[n++] = right;
  if (right < s->last) node[n++] = right + 2 * h < s->last ? right + 2 * h : s->last;
  for (int i = 0; i < n; i++) {
    weight[i] = 1;
    for (int j = 0; j < n; j++)
      if (j != i) weight[i] *= (double)(point - node[j]) / (double)(node[i] - node[j]);
  }
  return n;
}

static void predict(double guess[2], const struct strand *s, slong row, const double *weight, const slong *node,
                    int n) {
  guess[0] = guess[1] = 0;
  for (int i = 0; i < n; i++) {
    const struct dyn_member *m = strand_at(s, row, node[i]);
    guess[0] += weight[i] * m->out[DYN_OUT_TB];
    guess[1] += weight[i] * m->out[DYN_OUT_TC];
  }
}

/* --- One level. --- */

/* Whether the orbit is where it was expected, measured by how far it moves between the points on both sides. */
static bool expected(const struct strand *s, slong row, slong point, slong h, const double guess[2]) {
  const struct dyn_member *m = strand_at(s, row, point);
  double miss = fabs(m->out[DYN_OUT_TB] - guess[0]) + fabs(m->out[DYN_OUT_TC] - guess[1]);
  slong right = point + h < s->last ? point + h : s->last;
  double moves = apart(strand_at(s, row, point - h), strand_at(s, row, right));
  return miss <= 0.25 * moves + 1e-3 * (m->out[DYN_OUT_TB] + m->out[DYN_OUT_TC]);
}

static bool follow(struct strand *s, slong point, slong h) {
  double weight[4], guess[2];
  slong node[4];
  int n = weights(weight, node, s, point, h);
  family_move(s->line, point);
  for (slong k = 0; k < s->rows; k++) {
    struct dyn_member *m = strand_at(s, k, point);
    predict(guess, s, k, weight, node, n);
    if (!family_solve(m, s->line, guess, strand_at(s, k, s->first)->up) || !expected(s, k, point, h, guess))
      return false;
    for (slong i = 0; i < k; i++)
      if (family_same(strand_at(s, i, point), m)) return false;
  }
  return true;
}

/* Follows every orbit; the first point where that fails, the middle one of its level, or -1. */
static slong follow_all(struct strand *s) {
  slong h = 1, n = s->last - s->first;
  while (2 * h < n) h *= 2;
  for (; h >= 1; h /= 2) {
    slong *lost = NULL;
    size_t n_lost = 0, cap = 0;
    for (slong i = s->first + h; i < s->last; i += 2 * h) {
      if (follow(s, i, h)) continue;
      lost = ss_grow(lost, n_lost, &cap, sizeof *lost);
      lost[n_lost++] = i;
    }
    slong middle = n_lost ? lost[n_lost / 2] : -1;
    free(lost);
    if (middle >= 0) return middle;
  }
  return -1;
}

/* --- Between two anchors. --- */

static void keep(const struct strand *s, slong begin) {
  struct dyn_member *here = ss_malloc(((size_t)s->rows + 1) * sizeof *here);
  for (slong i = s->first + 1; i < s->last; i++) {
    for (slong k = 0; k < s->rows; k++) here[k] = *strand_at(s, k, i);
    struct dyn_family_point *p = point_at(s->line, begin, i);
    *p = (struct dyn_family_point){.x = dyn_axis_d(s->line->q->axis, i), .status = FAMILY_OK};
    family_add(s->line->f, p, here, s->rows);
  }
  free(here);
}

/* Everything strictly between two anchors; else the point to be searched, or -1. */
static slong between(struct family_line *l, slong begin, slong from, slong to) {
  const struct dyn_family_point *a = point_at(l, begin, from), *b = point_at(l, begin, to);
  if (to - from < 2) return -1;
  bool clear = a->status <= FAMILY_UNDECIDED && b->status <= FAMILY_UNDECIDED;
  if (!clear || a->n != b->n) return from + (to - from) / 2;
  struct strand s = {.line = l, .first = from, .last = to, .rows = a->n};
  s.m = ss_malloc(((size_t)(a->n * (to - from + 1)) + 1) * sizeof *s.m);
  slong split = match(&s, a, b) ? follow_all(&s) : from + (to - from) / 2;
  if (split < 0) keep(&s, begin);
  free(s.m);
  return split;
}

static void search_at(struct family_line *l, slong begin, slong i) {
  family_move(l, i);
  family_search(l, point_at(l, begin, i));
}

/* The points from one anchor to the next: anchors still to be reached lie on a stack, the nearest on top. */
static void settle(struct family_line *l, slong begin, slong from, slong to) {
  slong *ahead = ss_malloc((size_t)(to - from + 1) * sizeof *ahead), n = 0;
  ahead[n++] = to;
  while (n > 0) {
    slong split = between(l, begin, from, ahead[n - 1]);
    if (split < 0) {
      from = ahead[--n];
      continue;
    }
    search_at(l, begin, split);
    ahead[n++] = split;
  }
  free(ahead);
}

static bool in_domain(const struct dyn_family_request *q, const struct dyn_axis *a, slong i) {
  fmpq_t x;
  bool ok = true;
  fmpq_init(x);
  for (int k = 0; k < N_PARAMS; k++) {
    if (k == a->vary)
      dyn_axis_q(x, a, i);
    else
      fmpq_set(x, &q->params[k]);
    ok = ok && fmpq_sgn(x) > 0 && (k != P_CHI || fmpq_cmp_si(x, 1) < 0);
  }
  fmpq_clear(x);
  return ok;
}

int dyn_family_find(struct dyn_family *f, const struct dyn_family_request *q, slong begin, slong end) {
  *f = (struct dyn_family){.n_points = end - begin};
  if (!in_domain(q, q->axis, begin) || !in_domain(q, q->axis, end - 1)) return SS_DOMAIN;
  f->point = ss_malloc(((size_t)f->n_points + 1) * sizeof *f->point);
  struct family_line l;
  family_line_init(&l, f, q);
  search_at(&l, begin, begin);
  for (slong from = begin, to; from < end - 1; from = to) {
    to = from + q->every < end - 1 ? from + q->every : end - 1;
    search_at(&l, begin, to);
    settle(&l, begin, from, to);
  }
  family_line_clear(&l);
  return SS_OK;
}

void dyn_family_clear(struct dyn_family *f) {
  free(f->point);
  free(f->member);
  *f = (struct dyn_family){.n_points = 0};
}
