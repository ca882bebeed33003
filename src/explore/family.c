/* Every orbit at each of many points on a line of parameters.

   An anchor is a point at which all orbits have been searched for.  Between two anchors that hold the same number of
   orbits each orbit is followed, level by level (family_level.c).  The first level at which one is lost ends the
   attempt, and a point there is searched and becomes an anchor. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "family_impl.h"

static struct dyn_family_point *point_at(const struct family_line *l, slong begin, slong i) {
  return &l->f->point[i - begin];
}

static void line_init(struct family_line *l, struct dyn_family *f, const struct dyn_family_request *q) {
  *l = (struct family_line){.q = q, .f = f, .at = -1};
  for (int i = 0; i < N_PARAMS; i++) {
    fmpq_init(&l->exact[i]);
    if (i == q->axis->vary) continue;
    fmpq_set(&l->exact[i], &q->params[i]);
    num_double.set_q(&l->params[i], &q->params[i], 53);
  }
  for (int i = 0; i < 2; i++)
    if (q->u_r[i]) num_double.set_q(&l->u_r[i], q->u_r[i], 53);
}

static void line_clear(struct family_line *l) {
  for (int i = 0; i < N_PARAMS; i++) fmpq_clear(&l->exact[i]);
  family_lanes_clear(&l->lanes);
}

/* --- Matching the orbits of two anchors. --- */

/* Fills both ends of the strand; each orbit takes the nearest one that is left.  A wrong match is found out between. */
static bool match(struct strand *s, const struct dyn_family_point *a, const struct dyn_family_point *b) {
  const struct dyn_member *from = s->line->f->member + a->first, *to = s->line->f->member + b->first;
  FREED bool *taken = ss_malloc((size_t)s->rows + 1);
  memset(taken, 0, (size_t)s->rows + 1);
  for (slong k = 0; k < s->rows; k++) {
    slong best = -1;
    for (slong i = 0; i < s->rows; i++)
      if (!taken[i] && family_akin(&from[k], &to[i]) &&
          (best < 0 || family_apart(&from[k], &to[i]) < family_apart(&from[k], &to[best])))
        best = i;
    if (best < 0) return false;
    taken[best] = true;
    *family_at(s, k, s->first) = from[k];
    *family_at(s, k, s->last) = to[best];
  }
  return true;
}

/* Follows every orbit; the point to be searched, or -1. */
static slong follow_all(struct strand *s) {
  slong h = 1, lost = -1;
  while (2 * h < s->last - s->first) h *= 2;
  for (; h >= 1 && lost < 0; h /= 2) lost = family_level(s, h);
  return lost;
}

/* --- Between two anchors. --- */

static void keep(const struct strand *s, slong begin) {
  FREED struct dyn_member *here = ss_malloc(((size_t)s->rows + 1) * sizeof *here);
  for (slong i = s->first + 1; i < s->last; i++) {
    for (slong k = 0; k < s->rows; k++) here[k] = *family_at(s, k, i);
    struct dyn_family_point *p = point_at(s->line, begin, i);
    *p = (struct dyn_family_point){.x = dyn_axis_d(s->line->q->axis, i), .status = FAMILY_OK};
    family_add(s->line->f, p, here, s->rows);
  }
}

/* Where two anchors that differ are divided: where the line beside changes, or a point from there; else halfway. */
static slong division(const struct family_line *l, slong begin, slong from, slong to) {
  const struct dyn_family *beside = l->q->beside;
  for (slong i = FLINT_MAX(from - begin, 1); beside && i <= to - begin; i++)
    if (beside->point[i].n != beside->point[i - 1].n) return FLINT_MIN(FLINT_MAX(begin + i, from + 1), to - 1);
  return from + (to - from) / 2;
}

/* Everything strictly between two anchors; else the point to be searched, or -1. */
static slong between(struct family_line *l, slong begin, slong from, slong to) {
  const struct dyn_family_point *a = point_at(l, begin, from), *b = point_at(l, begin, to);
  if (to - from < 2) return -1;
  bool clear = a->status <= FAMILY_UNDECIDED && b->status <= FAMILY_UNDECIDED;
  if (!clear || a->n != b->n) return division(l, begin, from, to);
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
  fmpq p[N_PARAMS];
  NUMBERS(fmpq, x);
  dyn_axis_q(x, a, i);
  for (int k = 0; k < N_PARAMS; k++) p[k] = k == a->vary ? *x : q->params[k]; /* borrowed */
  return dyn_in_domain(p, N_PARAMS);
}

/* --- Beside another line. --- */

/* Whether the two anchors hold as many orbits as the line beside, where their number is known from one to the other and
   changes once at most. */
static bool alike(const struct family_line *l, slong begin, slong from, slong to) {
  const struct dyn_family_point *p = l->q->beside->point;
  int changes = 0;
  for (slong i = from; i <= to; i++) {
    if (p[i - begin].status > FAMILY_UNDECIDED) return false;
    if (i > from && p[i - begin].n != p[i - 1 - begin].n) changes++;
  }
  return changes <= 1 && p[from - begin].n == point_at(l, begin, from)->n &&
         p[to - begin].n == point_at(l, begin, to)->n;
}

int dyn_family_find(struct dyn_family *f, const struct dyn_family_request *q, slong begin, slong end) {
  *f = (struct dyn_family){.n_points = end - begin};
  if (!in_domain(q, q->axis, begin) || !in_domain(q, q->axis, end - 1)) return SS_DOMAIN;
  f->point = ss_malloc(((size_t)f->n_points + 1) * sizeof *f->point);
  struct family_line l;
  line_init(&l, f, q);
  search_at(&l, begin, begin);
  slong far = q->beside ? FAMILY_APART * q->every : q->every;
  for (slong from = begin, to; from < end - 1; from = to) {
    to = FLINT_MIN(from + far, end - 1);
    search_at(&l, begin, to);
    slong step = q->beside && alike(&l, begin, from, to) ? far : q->every;
    for (slong near = from, next; near < to; near = next) {
      next = FLINT_MIN(near + step, to);
      if (next < to) search_at(&l, begin, next);
      settle(&l, begin, near, next);
    }
  }
  line_clear(&l);
  return SS_OK;
}

void dyn_family_clear(struct dyn_family *f) {
  free(f->point);
  free(f->member);
  *f = (struct dyn_family){.n_points = 0};
}
