/* SUNDIALS' CVODE as a peer: its Adams and BDF formulas, and its own rootfinding on its interpolant, as a user would
   take them.  Where SUNDIALS is not installed nothing of it is compiled. */
#include "bench/jobs.h"

#ifdef STICKSLIP_SUNDIALS
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_version.h>

#include "base/arena.h"
#include "bench/sundials.h"

const char *bench_cvode_version(void) {
  static char version[32];
  return SUNDIALSGetVersion(version, sizeof version) == 0 ? version : "unknown";
}

struct peer {
  struct bench_motion motion;
  struct cvode c;
};

static int right_side(double t, N_Vector y, N_Vector f, void *self) {
  (void)t;
  bench_motion_field(N_VGetArrayPointer(f), &((const struct peer *)self)->motion, N_VGetArrayPointer(y));
  return 0;
}

static int root(double t, N_Vector y, double *value, void *self) {
  double rate;
  (void)t;
  *value = bench_motion_switch(&rate, &((const struct peer *)self)->motion, N_VGetArrayPointer(y));
  return 0;
}

static int jacobian(double t, N_Vector y, N_Vector f, SUNMatrix j, void *self, N_Vector a, N_Vector b, N_Vector c) {
  double rows[N_Y * N_Y];
  (void)t, (void)y, (void)f, (void)a, (void)b, (void)c;
  bench_motion_jacobian(rows, &((const struct peer *)self)->motion);
  for (int i = 0; i < N_Y * N_Y; i++) SM_ELEMENT_D(j, i / N_Y, i % N_Y) = rows[i];
  return 0;
}

void *bench_cvode_open(const struct bench_method *m, double tolerance, const struct bench_env *env) {
  struct peer *p = ss_malloc(sizeof *p);
  (void)env;
  *p = (struct peer){.c = {.memory = NULL}};
  if (cvode_open(&p->c, N_Y, strcmp(m->data, "adams") == 0, right_side, jacobian, p) &&
      CVodeRootInit(p->c.memory, 1, root) == CV_SUCCESS &&
      CVodeSStolerances(p->c.memory, tolerance, tolerance) == CV_SUCCESS)
    return p;
  bench_cvode_close(p);
  return NULL;
}

void bench_cvode_close(void *self) {
  cvode_close(&((struct peer *)self)->c);
  free(self);
}

static int run_phase(double *t, void *self, double y[N_Y], long *steps) {
  struct bench_motion *m = &((struct peer *)self)->motion;
  struct cvode *c = &((struct peer *)self)->c;
  double rate, value = bench_motion_switch(&rate, m, y);
  int direction = value < 0 || (value == 0 && rate < 0) ? 1 : -1;
  long taken = 0;
  memcpy(N_VGetArrayPointer(c->y), y, N_Y * sizeof *y);
  if (CVodeReInit(c->memory, 0, c->y) || CVodeSetRootDirection(c->memory, &direction) ||
      CVodeSetMaxStep(c->memory, bench_motion_stride(m)) || CVodeSetMaxNumSteps(c->memory, bench_motion_steps(m)))
    return SS_UNABLE;
  int end = CVode(c->memory, bench_motion_horizon(m), c->y, t, CV_NORMAL);
  CVodeGetNumSteps(c->memory, &taken);
  *steps += taken;
  memcpy(y, N_VGetArrayPointer(c->y), N_Y * sizeof *y);
  return end == CV_ROOT_RETURN ? SS_OK : SS_UNABLE;
}

int bench_cvode_run(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  return bench_motion_pass(out, steps, self, c->x, run_phase);
}
#endif
