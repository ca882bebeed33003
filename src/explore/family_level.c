/* Orbits followed from the points around.

   A level is the set of points midway between those that are solved already, so that the distance halves from level to
   level and half of all points are solved last, from the nearest guesses.  A guess is interpolated from up to four
   solved points. All orbits of a level are solved together, in lanes; what the lanes leave open is solved alone.  An
   orbit counts as followed when it is one of the word, of its branch's kind, close to where it was expected and
   distinct from the others. */
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "batch.h"
#include "family_impl.h"

/* --- Prediction. --- */

/* Points around, and the weights of the polynomial through them. */
struct stencil {
  int n;
  slong node[4];
  double weight[4];
};

static struct stencil stencil(const struct strand *s, slong point, slong h) {
  if (point - 3 * h >= s->first && point + 3 * h <= s->last)
    return (struct stencil){
        4, {point - 3 * h, point - h, point + h, point + 3 * h}, {-0.0625, 0.5625, 0.5625, -0.0625}};
  struct stencil a = {.n = 0};
  slong left = point - h, right = point + h < s->last ? point + h : s->last;
  if (left > s->first) a.node[a.n++] = left - 2 * h;
  a.node[a.n++] = left;
  a.node[a.n++] = right;
  if (right < s->last) a.node[a.n++] = right + 2 * h < s->last ? right + 2 * h : s->last;
  for (int i = 0; i < a.n; i++) {
    a.weight[i] = 1;
    for (int j = 0; j < a.n; j++)
      if (j != i) a.weight[i] *= (double)(point - a.node[j]) / (double)(a.node[i] - a.node[j]);
  }
  return a;
}

static double predict(const struct strand *s, slong row, const struct stencil *a, enum dyn_output what) {
  double guess = 0;
  for (int i = 0; i < a->n; i++) guess += a->weight[i] * family_at(s, row, a->node[i])->out[what];
  return guess;
}

/* --- Lanes. --- */

void family_lanes_room(struct family_lanes *a, slong n, const double params[N_PARAMS]) {
  size_t size = (size_t)n * sizeof(double);
  if (n <= a->cap) return;
  for (int i = 0; i < N_PARAMS; i++) a->params[i] = ss_realloc(a->params[i], size);
  for (int i = 0; i < 2; i++) a->guess[i] = ss_realloc(a->guess[i], size);
  for (int i = 0; i < N_DYN_OUT; i++) a->out[i] = ss_realloc(a->out[i], size);
  a->violations = ss_realloc(a->violations, (size_t)n * sizeof *a->violations);
  a->status = ss_realloc(a->status, (size_t)n * sizeof *a->status);
  for (int i = 0; i < N_PARAMS; i++)
    for (slong k = 0; k < n; k++) a->params[i][k] = params[i];
  a->cap = n;
}

void family_lanes_clear(struct family_lanes *a) {
  for (int i = 0; i < N_PARAMS; i++) free(a->params[i]);
  for (int i = 0; i < 2; i++) free(a->guess[i]);
  for (int i = 0; i < N_DYN_OUT; i++) free(a->out[i]);
  free(a->violations);
  free(a->status);
}

void family_lanes_run(struct family_lanes *a, slong n) {
  dyn_orbits_batch(a->out, a->violations, a->status, (const double *const *)a->params, (const double *const *)a->guess,
                   n);
}

/* Lane count * rows + k is of orbit k at the count-th point of the level; their number. */
static slong fill(struct strand *s, slong h) {
  struct family_lanes *a = &s->line->lanes;
  slong n = 0;
  family_lanes_room(a, s->rows * ((s->last - s->first) / (2 * h) + 1), s->line->params);
  double *varied = a->params[s->line->q->axis->vary];
  for (slong point = s->first + h; point < s->last; point += 2 * h) {
    struct stencil from = stencil(s, point, h);
    double x = dyn_axis_d(s->line->q->axis, point);
    for (slong k = 0; k < s->rows; k++, n++) {
      varied[n] = x;
      a->guess[0][n] = predict(s, k, &from, DYN_OUT_TB);
      a->guess[1][n] = predict(s, k, &from, DYN_OUT_TC);
    }
  }
  return n;
}

/* --- What came of it. --- */

/* Whether the orbit is where it was expected, measured by how far it moves between the points on both sides. */
static bool expected(const struct strand *s, slong row, slong point, slong h, const double guess[2]) {
  const struct dyn_member *m = family_at(s, row, point);
  double miss = fabs(m->out[DYN_OUT_TB] - guess[0]) + fabs(m->out[DYN_OUT_TC] - guess[1]);
  slong right = point + h < s->last ? point + h : s->last;
  double moves = family_apart(family_at(s, row, point - h), family_at(s, row, right));
  return miss <= 0.25 * moves + 1e-3 * (m->out[DYN_OUT_TB] + m->out[DYN_OUT_TC]);
}

static bool from_lane(struct dyn_member *m, struct family_line *l, slong lane, const double guess[2], bool up) {
  const struct family_lanes *a = &l->lanes;
  if (a->status[lane] != SS_OK) return family_solve(m, l, guess, up);
  for (int i = 0; i < N_DYN_OUT; i++) m->out[i] = a->out[i][lane];
  m->violations = a->violations[lane];
  m->unsure = 0;
  family_judge(m, l);
  return m->up == up;
}

/* Every orbit at one point, whose first lane is given. */
static bool follow(struct strand *s, slong point, slong h, slong lane) {
  const struct family_lanes *a = &s->line->lanes;
  family_move(s->line, point);
  for (slong k = 0; k < s->rows; k++, lane++) {
    struct dyn_member *m = family_at(s, k, point);
    double guess[2] = {a->guess[0][lane], a->guess[1][lane]};
    const struct dyn_member *begin = family_at(s, k, s->first);
    if (!from_lane(m, s->line, lane, guess, begin->up)) return false;
    if (!family_akin(m, begin) || !expected(s, k, point, h, guess)) return false;
    for (slong i = 0; i < k; i++)
      if (family_same(family_at(s, i, point), m)) return false;
  }
  return true;
}

slong family_level(struct strand *s, slong h) {
  FREED slong *lost = NULL;
  slong lane = 0, n = fill(s, h);
  size_t n_lost = 0, cap = 0;
  family_lanes_run(&s->line->lanes, n);
  for (slong point = s->first + h; point < s->last; point += 2 * h, lane += s->rows) {
    if (follow(s, point, h, lane)) continue;
    *SS_PUSH(lost, n_lost, cap) = point;
  }
  return n_lost ? lost[n_lost / 2] : -1;
}
