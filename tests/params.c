#include "params.h"

#include "rational.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"

const double example[N_PARAMS] = {0.8, 1, 1, 2.7844, 0.8587};
const char *const example_text[N_PARAMS] = {"0.8", "1", "1", "2.7844", "0.8587"};

static double between(struct rng *r, const double ends[2]) {
  return ends[0] * pow(ends[1] / ends[0], rng_unit(r));
}

void params_draw(double p[N_PARAMS], struct rng *r, const struct param_ranges *in) {
  p[P_CHI] = rng_within(r, in->chi[0], in->chi[1]);
  p[P_ETA] = between(r, in->eta);
  p[P_V] = between(r, in->V);
  p[P_E1] = p[P_V] * between(r, in->e1);
  p[P_E2] = p[P_V] * between(r, in->e2);
}

void params_to_edges(double p[N_PARAMS], struct rng *r, bool chi_small) {
  p[P_CHI] = chi_small ? pow(10, -4 * rng_unit(r)) / 2 : 1 - pow(10, -5 * rng_unit(r)) / 2;
  p[P_ETA] = pow(10, 6 * rng_unit(r) - 3);
}

static const double size[] = {1e-310, 1e-160, 1e-8, 1, 1e8, 1e160, 1e308};

double size_draw(struct rng *r) {
  return size[rng_between(r, 0, COUNT(size) - 1)];
}

void params_draw_sizes(double p[N_PARAMS], struct rng *r) {
  for (int i = 0; i < N_PARAMS; i++) p[i] = i == P_CHI ? size[rng_between(r, 0, 2)] : size_draw(r);
}

bool params_outside(double p[N_PARAMS], int k) {
  static const double bad[] = {0, -1, NAN, INFINITY, -INFINITY};
  enum { N_BAD = COUNT(bad) };
  memcpy(p, example, sizeof example);
  if (k < N_PARAMS * N_BAD)
    p[k / N_BAD] = bad[k % N_BAD];
  else
    p[P_CHI] = 1;
  return k <= N_PARAMS * N_BAD;
}

const char *params_shown(const double p[N_PARAMS]) {
  static char text[200];
  snprintf(text, sizeof text, "chi %.17g eta %.17g V %.17g e1 %.17g e2 %.17g", p[0], p[1], p[2], p[3], p[4]);
  return text;
}

struct param_line param_line_of(const char *const params[N_PARAMS], int vary, const char *from, const char *to) {
  fmpq *ends = rationals((const char *const[]){from, to}, 2);
  struct param_line l = {_fmpq_vec_init(N_PARAMS), ends, ends + 1, vary};
  for (int i = 0; i < N_PARAMS; i++)
    if (i != vary) rational_set(l.params + i, params[i]);
  return l;
}

void param_line_clear(struct param_line *l) {
  _fmpq_vec_clear(l->params, N_PARAMS);
  _fmpq_vec_clear(l->from, 2);
}

struct dyn_orbits orbits_of(const fmpq *params, slong prec) {
  struct dyn_orbits list;
  ck_assert_int_eq(dyn_orbits_find(&list, params, prec, NULL), SS_OK);
  return list;
}
