/* GSL's evolution with its own control of each component, and CVODE one step at a time. */
#include "bench/stepper.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"

#ifdef STICKSLIP_SUNDIALS
#include "bench/sundials.h"
#endif

enum { N = STEPPER_SIZE };

struct stepper {
  const struct stepper_system *system;
  double t, h, y[N];
  gsl_odeiv2_system gsl;
  gsl_odeiv2_driver *driver; /* NULL: CVODE */
#ifdef STICKSLIP_SUNDIALS
  struct cvode cvode;
  N_Vector absolute;
#endif
};

static int right_side(double t, const double y[], double f[], void *self) {
  const struct stepper_system *q = ((const struct stepper *)self)->system;
  (void)t;
  q->field(f, q->self, y);
  return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *self) {
  const struct stepper_system *q = ((const struct stepper *)self)->system;
  (void)t;
  q->jacobian(dfdy, q->self, y);
  memset(dfdt, 0, N * sizeof *dfdt);
  return GSL_SUCCESS;
}

static bool open_gsl(struct stepper *s, const char *name) {
  const gsl_odeiv2_step_type *type = bench_gsl_step(name);
  double least = INFINITY, scale[N];
  for (int i = 0; i < N; i++) least = fmin(least, s->system->absolute[i]);
  for (int i = 0; i < N; i++) scale[i] = s->system->absolute[i] / least;
  s->gsl = (gsl_odeiv2_system){right_side, jacobian, N, s};
  if (type)
    s->driver = gsl_odeiv2_driver_alloc_scaled_new(&s->gsl, type, 1e-6, least, s->system->relative, 1, 0, scale);
  return s->driver != NULL;
}

#ifdef STICKSLIP_SUNDIALS
static int cvode_side(double t, N_Vector y, N_Vector f, void *self) {
  return right_side(t, N_VGetArrayPointer(y), N_VGetArrayPointer(f), self);
}

static int cvode_jacobian(double t, N_Vector y, N_Vector f, SUNMatrix j, void *self, N_Vector a, N_Vector b,
                          N_Vector c) {
  double rows[N * N], dfdt[N];
  (void)f, (void)a, (void)b, (void)c;
  jacobian(t, N_VGetArrayPointer(y), rows, dfdt, self);
  for (int i = 0; i < N * N; i++) SM_ELEMENT_D(j, i / N, i % N) = rows[i];
  return 0;
}

static bool open_cvode(struct stepper *s) {
  if (!cvode_open(&s->cvode, N, false, cvode_side, cvode_jacobian, s)) return false;
  s->absolute = N_VNew_Serial(N, s->cvode.context);
  if (!s->absolute) return false;
  memcpy(N_VGetArrayPointer(s->absolute), s->system->absolute, sizeof s->system->absolute);
  return CVodeSetMaxStep(s->cvode.memory, s->system->longest) == CV_SUCCESS &&
         CVodeSVtolerances(s->cvode.memory, s->system->relative, s->absolute) == CV_SUCCESS;
}

static void close_cvode(struct stepper *s) {
  if (s->absolute) N_VDestroy(s->absolute);
  cvode_close(&s->cvode);
}

static int step_cvode(struct stepper *s) {
  int status = CVode(s->cvode.memory, 1e9, s->cvode.y, &s->t, CV_ONE_STEP);
  memcpy(s->y, N_VGetArrayPointer(s->cvode.y), sizeof s->y);
  return status < 0 ? SS_UNABLE : SS_OK;
}
#endif

static bool open_named(struct stepper *s, const char *name) {
#ifdef STICKSLIP_SUNDIALS
  if (strcmp(name, "cvode-bdf") == 0) return open_cvode(s);
#endif
  return open_gsl(s, name);
}

struct stepper *stepper_open(const char *name, const struct stepper_system *system) {
  struct stepper *s = ss_malloc(sizeof *s);
  *s = (struct stepper){.system = system};
  if (open_named(s, name)) return s;
  stepper_close(s);
  return NULL;
}

void stepper_close(struct stepper *s) {
  if (s->driver) gsl_odeiv2_driver_free(s->driver);
#ifdef STICKSLIP_SUNDIALS
  close_cvode(s);
#endif
  free(s);
}

int stepper_start(struct stepper *s, const double y[N]) {
  memcpy(s->y, y, sizeof s->y);
  s->t = 0;
  s->h = 1e-6;
  if (s->driver) return gsl_odeiv2_driver_reset(s->driver) ? SS_UNABLE : SS_OK;
#ifdef STICKSLIP_SUNDIALS
  memcpy(N_VGetArrayPointer(s->cvode.y), y, sizeof s->y);
  return CVodeReInit(s->cvode.memory, 0, s->cvode.y) ? SS_UNABLE : SS_OK;
#else
  return SS_UNABLE;
#endif
}

int stepper_step(struct stepper *s, double *t, double y[N]) {
  int status = SS_OK;
  if (s->driver) {
    gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
    if (gsl_odeiv2_evolve_apply(s->driver->e, s->driver->c, s->driver->s, &s->gsl, &s->t, s->t + s->system->longest,
                                &s->h, s->y))
      status = SS_UNABLE;
    gsl_set_error_handler(old);
#ifdef STICKSLIP_SUNDIALS
  } else {
    status = step_cvode(s);
#endif
  }
  *t = s->t;
  memcpy(y, s->y, sizeof s->y);
  for (int i = 0; i < N; i++)
    if (!isfinite(y[i])) status = SS_UNABLE;
  return status;
}
