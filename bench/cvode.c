/* SUNDIALS' CVODE as a peer: its Adams and BDF formulas, and its own rootfinding on its interpolant, as a user would
   take them.  Where SUNDIALS is not installed nothing of it is compiled. */
#include "bench/jobs.h"

#ifdef STICKSLIP_SUNDIALS
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "base/arena.h"
#include "bench/sundials.h"

const char *bench_cvode_version(void) {
  static char version[32];
  return SUNDIALSGetVersion(version, sizeof version) == 0 ? version : "unknown";
}

struct cvode {
  struct bench_motion motion;
  SUNContext context;
  void *memory;
  N_Vector y;
  SUNMatrix matrix; /* of BDF */
  SUNLinearSolver linear;
  SUNNonlinearSolver nonlinear; /* of Adams */
};

static int right_side(double t, N_Vector y, N_Vector f, void *self) {
  (void)t;
  bench_motion_field(N_VGetArrayPointer(f), &((const struct cvode *)self)->motion, N_VGetArrayPointer(y));
  return 0;
}

static int root(double t, N_Vector y, double *value, void *self) {
  double rate;
  (void)t;
  *value = bench_motion_switch(&rate, &((const struct cvode *)self)->motion, N_VGetArrayPointer(y));
  return 0;
}

static int jacobian(double t, N_Vector y, N_Vector f, SUNMatrix j, void *self, N_Vector a, N_Vector b, N_Vector c) {
  double rows[N_Y * N_Y];
  (void)t, (void)y, (void)f, (void)a, (void)b, (void)c;
  bench_motion_jacobian(rows, &((const struct cvode *)self)->motion);
  for (int i = 0; i < N_Y * N_Y; i++) SM_ELEMENT_D(j, i / N_Y, i % N_Y) = rows[i];
  return 0;
}

/* The solver of the implicit equations that goes with the formulas. */
static bool attach(struct cvode *c, bool adams) {
  if (adams) {
    c->nonlinear = SUNNonlinSol_FixedPoint(c->y, 0, c->context);
    return c->nonlinear && CVodeSetNonlinearSolver(c->memory, c->nonlinear) == CV_SUCCESS;
  }
  c->matrix = SUNDenseMatrix(N_Y, N_Y, c->context);
  c->linear = c->matrix ? SUNLinSol_Dense(c->y, c->matrix, c->context) : NULL;
  return c->linear && CVodeSetLinearSolver(c->memory, c->linear, c->matrix) == CV_SUCCESS &&
         CVodeSetJacFn(c->memory, jacobian) == CV_SUCCESS;
}

void *bench_cvode_open(const struct bench_method *m, double tolerance, const struct bench_env *env) {
  bool adams = strcmp(m->data, "adams") == 0;
  struct cvode *c = ss_malloc(sizeof *c);
  (void)env;
  *c = (struct cvode){.memory = NULL};
  if (SUNContext_Create(NO_COMM, &c->context) == 0) {
    c->y = N_VNew_Serial(N_Y, c->context);
    c->memory = CVodeCreate(adams ? CV_ADAMS : CV_BDF, c->context);
  }
  if (c->y) N_VConst(1, c->y);
  if (c->memory) be_quiet(c->memory, c->context);
  if (c->y && c->memory && CVodeInit(c->memory, right_side, 0, c->y) == CV_SUCCESS && attach(c, adams) &&
      CVodeSetUserData(c->memory, c) == CV_SUCCESS && CVodeRootInit(c->memory, 1, root) == CV_SUCCESS &&
      CVodeSStolerances(c->memory, tolerance, tolerance) == CV_SUCCESS)
    return c;
  bench_cvode_close(c);
  return NULL;
}

void bench_cvode_close(void *self) {
  struct cvode *c = self;
  if (c->memory) CVodeFree(&c->memory);
  if (c->nonlinear) SUNNonlinSolFree(c->nonlinear);
  if (c->linear) SUNLinSolFree(c->linear);
  if (c->matrix) SUNMatDestroy(c->matrix);
  if (c->y) N_VDestroy(c->y);
  if (c->context) SUNContext_Free(&c->context);
  free(c);
}

void bench_cvode_limits(void *self, const struct bench_limits *limits) {
  ((struct cvode *)self)->motion.limits = *limits;
}

static int run_phase(double *t, void *self, double y[N_Y], long *steps) {
  struct cvode *c = self;
  double rate, value = bench_motion_switch(&rate, &c->motion, y);
  int direction = value < 0 || (value == 0 && rate < 0) ? 1 : -1;
  long taken = 0;
  memcpy(N_VGetArrayPointer(c->y), y, N_Y * sizeof *y);
  if (CVodeReInit(c->memory, 0, c->y) || CVodeSetRootDirection(c->memory, &direction) ||
      CVodeSetMaxStep(c->memory, bench_motion_stride(&c->motion)) ||
      CVodeSetMaxNumSteps(c->memory, bench_motion_steps(&c->motion)))
    return SS_UNABLE;
  int end = CVode(c->memory, bench_motion_horizon(&c->motion), c->y, t, CV_NORMAL);
  CVodeGetNumSteps(c->memory, &taken);
  *steps += taken;
  memcpy(y, N_VGetArrayPointer(c->y), N_Y * sizeof *y);
  return end == CV_ROOT_RETURN ? SS_OK : SS_UNABLE;
}

int bench_cvode_map(double t[3], double *r_end, long *steps, void *self, const double *params, double r) {
  struct cvode *c = self;
  return bench_motion_pass(t, r_end, steps, &c->motion, params, r, run_phase, c);
}
#else
const char *bench_cvode_version(void) {
  return "not installed";
}

void *bench_cvode_open(const struct bench_method *m, double tolerance, const struct bench_env *env) {
  (void)m, (void)tolerance, (void)env;
  return NULL;
}

void bench_cvode_close(void *self) {
  (void)self;
}

int bench_cvode_map(double t[3], double *r_end, long *steps, void *self, const double *params, double r) {
  (void)t, (void)r_end, (void)steps, (void)self, (void)params, (void)r;
  return SS_UNABLE;
}
#endif
