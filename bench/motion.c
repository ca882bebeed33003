/* The phases of the word for integrators that know nothing of closed forms.  Starting in w and r, the pass begins with
   exact data; at an event its own condition is put into the state, as the suite does. */
#include <math.h>
#include <string.h>

#include "bench/jobs.h"

/* Keeps the limits, which must have been set. */
static void bench_motion_init(struct bench_motion *m, const double *params) {
  double stiff = params[P_CHI] * params[P_ETA], longest = 1.5 / sqrt(1 + stiff);
  *m = (struct bench_motion){.chi = params[P_CHI],
                             .V = params[P_V],
                             .e2 = params[P_E2],
                             .stiff = stiff,
                             .longest = longest,
                             .phase = PHASE_GAMMA,
                             .limits = m->limits};
}

double bench_motion_stride(const struct bench_motion *m) {
  return m->limits.unbound ? 1e9 : m->longest;
}

double bench_motion_horizon(const struct bench_motion *m) {
  return m->limits.unbound ? 1e9 : 1000;
}

long bench_motion_steps(const struct bench_motion *m) {
  return m->limits.steps > 0 ? m->limits.steps : 200000;
}

void bench_motion_field(double f[N_Y], const struct bench_motion *m, const double y[N_Y]) {
  f[Y_W] = y[Y_V1] - m->chi * y[Y_V2];
  f[Y_R] = y[Y_V2] - y[Y_V1];
  f[Y_V1] = m->phase == PHASE_GAMMA || m->phase == PHASE_H ? -y[Y_W] : 0;
  f[Y_V2] = m->phase == PHASE_H || m->phase == PHASE_C ? -m->stiff * y[Y_R] : 0;
}

void bench_motion_jacobian(double j[N_Y * N_Y], const struct bench_motion *m) {
  double pull1 = m->phase == PHASE_C ? 0 : -1, pull2 = m->phase == PHASE_GAMMA ? 0 : -m->stiff;
  const double rows[N_Y * N_Y] = {0, 0, 1, -m->chi, 0, 0, -1, 1, pull1, 0, 0, 0, 0, pull2, 0, 0};
  memcpy(j, rows, sizeof rows);
}

double bench_motion_switch(double *rate, const struct bench_motion *m, const double y[N_Y]) {
  switch (m->phase) {
  case PHASE_GAMMA:
    *rate = y[Y_V2] - y[Y_V1];
    return y[Y_R] - m->e2 / m->chi;
  case PHASE_H:
    *rate = -y[Y_W];
    return y[Y_V1] - m->V;
  default:
    *rate = -m->stiff * y[Y_R];
    return y[Y_V2] - m->V;
  }
}

int bench_motion_pass(struct num_vec *to, long *steps, void *self, const double *x, bench_phase_run run) {
  struct bench_motion *m = self;
  double *out = (double *)(void *)to->data;
  double y[N_Y] = {x[P_E1], x[N_PARAMS], x[P_V], x[P_V]};
  bench_motion_init(m, x);
  *steps = 0;
  int status = run(&out[0], self, y, steps);
  y[Y_R] = m->e2 / m->chi;
  m->phase = PHASE_H;
  if (!status) status = run(&out[1], self, y, steps);
  y[Y_V1] = m->V;
  m->phase = PHASE_C;
  if (!status) status = run(&out[2], self, y, steps);
  out[MAP_R] = y[Y_R];
  return status;
}
