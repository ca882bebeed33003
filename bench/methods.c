/* What the methods of the jobs share. */
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "bench/jobs.h"

const double bench_precisions[] = {64, 128, 256, 512, 1024, 2048, 4096};

void bench_place_params(double *x, const double *u) {
  x[P_CHI] = 0.25 + 0.65 * u[0];
  x[P_ETA] = exp(2.2 * u[1] - 1.1);
  x[P_V] = exp(1.4 * u[2] - 0.7);
  x[P_E1] = x[P_V] * (0.5 + 3.5 * u[3]);
  x[P_E2] = x[P_V] * (0.05 + 1.5 * u[4]);
}

double bench_hint(double t) {
  return t + fmin(fabs(t), 1) / 64;
}

struct num_vec bench_params_of(const struct num_vec *in) {
  return (struct num_vec){in->ctx, N_PARAMS, in->data};
}

fmpq *bench_exact(const double *params) {
  fmpq *q = _fmpq_vec_init(N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++) num_q_set_d(&q[i], params[i]);
  return q;
}

struct num_ctx bench_context(const struct bench_method *m, double setting) {
  return (struct num_ctx){m->type, m->kind == SET_BITS ? (slong)setting : m->bits ? m->bits : 53};
}

void *bench_arc_open(const struct bench_method *m, double setting, const struct bench_env *env) {
  struct num_ctx ctx = bench_context(m, setting);
  struct bench_arc *a = ss_malloc(sizeof *a);
  (void)env;
  a->setting = setting;
  dyn_arc_init(&a->arc, ctx);
  num_vec_init(&a->start, 2, ctx);
  num_vec_init(&a->end, 2, ctx);
  return a;
}

void bench_arc_close(void *self) {
  struct bench_arc *a = self;
  dyn_arc_clear(&a->arc);
  num_vec_clear(&a->start);
  num_vec_clear(&a->end);
  free(a);
}
