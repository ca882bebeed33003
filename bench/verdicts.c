/* Job 6: what verdicts cost.  A claim is judged at the precision that decides it, so its verdict does not depend on
   digits asked for; orbits, Jacobians and the two sides of each claim do, and are asked for more and more of them.
   Claims are judged alone, one by one, and the first n of them together: how the audit grows; beside it how sweeps
   and simulations grow.  Each is done once, or until a tenth of a second is used up; the least time counts. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "explore/family.h"
#include "route/jacobian.h"
#include "run/audit.h"
#include "value/coulomb_setup.h"

const char *const bench_work_name[] = {"orbits",  "jacobian", "all sides", "sweep", "plane",
                                       "periods", "claims",   "claim",     "sides"};

static bool do_orbits(const struct bench_env *env, long digits) {
  OWNED(dyn_orbits) list;
  int status = dyn_orbits_find(&list, env->scene->value, (slong)ceil((double)digits * 3.33), NULL);
  return status == SS_OK && list.n > 0;
}

static bool do_jacobian(const struct bench_env *env, long digits) {
  struct jacobian_request q = {.method = METHOD_ANALYTIC, .layer = LAYER_CORRECTED, .digits = digits};
  struct diag d = {0};
  ARB_VECTOR(x, 6);
  return audit_jacobian(x, x + 4, x + 5, env->model, env->scene, &q, &d);
}

/* A line of so many points, for each of so many values of e1 about that of the scene. */
static bool do_sweep(const struct bench_env *env, long lines, long points) {
  OWNED(dyn_axis) axis;
  FMPQ_VECTOR(params, N_PARAMS);
  const fmpq *e2 = env->scene->value + P_E2;
  NUMBERS(fmpq, from, to);
  for (int i = 0; i < N_PARAMS; i++) fmpq_set(params + i, env->scene->value + i);
  fmpq_div_2exp(from, e2, 1);
  fmpq_mul_si(to, e2, 3);
  dyn_axis_init(&axis, P_E2, from, to, points);
  struct dyn_family_request q = {.params = params, .axis = &axis, .every = dyn_axis_usual_every(points)};
  struct dyn_family f = {.n_points = 0}, before;
  int status = SS_OK;
  for (long line = 0; line < lines; line++) {
    fmpq_set_si(params + P_E1, 3 * lines + 2 * line + 1, (ulong)(4 * lines));
    fmpq_mul(params + P_E1, params + P_E1, env->scene->value + P_E1);
    for (slong begin = 0, end; begin < points && status == SS_OK; begin = end) {
      end = FLINT_MIN(begin + dyn_axis_stretch(q.every), points);
      before = f;
      q.beside = end - begin == points && line % dyn_lines_abreast(lines) ? &before : NULL;
      status = dyn_family_find(&f, &q, begin, end);
      dyn_family_clear(&before);
    }
  }
  dyn_family_clear(&f);
  return status == SS_OK;
}

/* By closed forms in double, from the first orbit. */
static bool do_periods(const struct bench_env *env, long periods) {
  struct coulomb_setup sim;
  struct coulomb_result end;
  struct coulomb_plan plan = coulomb_plan_default;
  if (!coulomb_setup_listed(&sim, env->scene, 0)) return false;
  plan.duration = (double)periods * sim.period;
  plan.max_events = plan.max_steps = LONG_MAX;
  return coulomb_simulate_d(&end, sim.params, sim.start, &plan, NULL) == SS_OK;
}

/* n claims from number `from` on, and those that their ids select besides; how many were judged. */
static long do_claims(const struct bench_env *env, size_t from, size_t n) {
  LOCAL(audit_result, r);
  struct diag d = {0};
  FREED const char **id = ss_malloc(n * sizeof *id);
  for (size_t i = 0; i < n; i++) id[i] = env->claims->claim[from + i].id;
  struct audit_options opt = {.only = id, .n_only = (int)n};
  bool ok = audit_run(&r, env->model, env->claims, env->controls, env->scene, &opt, &d);
  return ok ? (long)r.n_findings : 0;
}

static bool do_work(struct bench_work *w, const struct bench_env *env, size_t from, size_t n) {
  switch (w->kind) {
  case WORK_ORBITS:
    return do_orbits(env, w->size);
  case WORK_JACOBIAN:
    return do_jacobian(env, w->size);
  case WORK_SWEEP:
    return do_sweep(env, 1, w->size);
  case WORK_PLANE:
    return do_sweep(env, lround(sqrt((double)w->size)), lround(sqrt((double)w->size)));
  case WORK_PERIODS:
    return do_periods(env, w->size);
  default:
    w->size = do_claims(env, from, n);
    return w->size > 0;
  }
}

static struct bench_work *new_work(struct bench_verdicts *v, enum bench_work_kind kind, const char *id, long size) {
  struct bench_work *w = SS_PUSH(v->work, v->n, v->cap);
  *w = (struct bench_work){.kind = kind, .size = size, .seconds = INFINITY, .good = true};
  snprintf(w->id, sizeof w->id, "%s", id);
  return w;
}

static void measure(struct bench_verdicts *v, const struct bench_env *env, enum bench_work_kind kind, const char *id,
                    long size, size_t from) {
  struct bench_work *w = new_work(v, kind, id, size);
  double begin = bench_now(), spent = 0;
  do {
    double start = bench_now();
    w->good = do_work(w, env, from, (size_t)size) && w->good;
    double now = bench_now();
    w->seconds = fmin(w->seconds, now - start);
    spent = now - begin;
  } while (w->good && spent < 0.1 && !v->quick);
  if (!w->good) w->seconds = NAN;
}

/* --- The two sides of each claim. --- */

static const long digits_of_sides[] = {15, 100, 1000, 10000};
enum { LEVELS = COUNT(digits_of_sides), QUICK_LEVELS = 2 };
static const double most_seconds = 1; /* a claim that takes longer is not asked for more digits */

static void measure_sides(struct bench_verdicts *v, const struct bench_env *env, size_t claims, int levels) {
  double total[LEVELS] = {0};
  for (size_t i = 0; i < claims; i++) {
    struct bench_sides *b = bench_sides_new(env, &env->claims->claim[i]);
    double seconds = 0;
    for (int k = 0; b && k < levels && seconds < most_seconds; k++) {
      struct bench_work *w = new_work(v, WORK_SIDES, env->claims->claim[i].id, digits_of_sides[k]);
      double start = bench_now();
      w->good = bench_sides_run(b, w->size);
      seconds = bench_now() - start;
      w->seconds = w->good ? seconds : NAN;
      if (w->good) total[k] += seconds;
    }
    if (b) bench_sides_free(b);
  }
  for (int k = 0; k < levels; k++) new_work(v, WORK_ALL_SIDES, "", digits_of_sides[k])->seconds = total[k];
}

void bench_verdicts(struct bench_verdicts *v, const struct bench_env *env, bool quick) {
  static const long digits[] = {15, 50, 100, 300, 1000, 3000, 10000, 30000, 100000},
                    points[] = {1000, 10000, 100000, 1000000, 10000000}, plane[] = {32 * 32, 100 * 100, 316 * 316},
                    periods[] = {100, 1000, 10000, 100000};
  static const struct {
    enum bench_work_kind kind;
    const long *size;
    int n, quick;
  } growing[] = {{WORK_ORBITS, digits, COUNT(digits), 3},
                 {WORK_JACOBIAN, digits, COUNT(digits), 3},
                 {WORK_SWEEP, points, COUNT(points), 2},
                 {WORK_PLANE, plane, COUNT(plane), 1},
                 {WORK_PERIODS, periods, COUNT(periods), 2}};
  enum { QUICK_CLAIMS = 4 };
  size_t n = env->claims->n, alone = quick && n > QUICK_CLAIMS ? QUICK_CLAIMS : n;
  *v = (struct bench_verdicts){.quick = quick};
  for (int k = 0; k < COUNT(growing); k++)
    for (int i = 0; i < (quick ? growing[k].quick : growing[k].n); i++)
      measure(v, env, growing[k].kind, "", growing[k].size[i], 0);
  measure_sides(v, env, alone, quick ? QUICK_LEVELS : LEVELS);
  for (size_t i = 0; i < alone; i++) measure(v, env, WORK_CLAIM, env->claims->claim[i].id, 1, i);
  for (size_t k = 1; k <= alone; k = k < alone && 2 * k > alone ? alone : 2 * k) {
    measure(v, env, WORK_CLAIMS, "", (long)k, 0);
    if (v->n > 1 && v->work[v->n - 2].kind == WORK_CLAIMS && v->work[v->n - 2].size == v->work[v->n - 1].size) v->n--;
  }
}

void bench_verdicts_clear(struct bench_verdicts *v) {
  free(v->work);
  *v = (struct bench_verdicts){.n = 0};
}
