/* GSL's integrators as peers: the phases of the word in w, r, z_1', z_2', each integrated up to its event.

   An event is noticed by the sign of the switching function at the ends of a step, or, when it has risen and fallen
   within the step, by its value at the top; no step is longer than a quarter of the shortest period.  Then it is
   located by Newton's iteration, kept in a bracket, on the length of the last step, which is repeated from its
   beginning: by the method itself where it is a one-step method.  A multistep method cannot repeat a step, so there
   rk8pd does. */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "motion/dynamics.h"

struct ode {
  struct bench_motion motion;
  gsl_odeiv2_system system;
  gsl_odeiv2_driver *driver;
  gsl_odeiv2_step *locator; /* the driver's own, or one of rk8pd */
  bool own;
  double hint;
};

static int right_side(double t, const double y[], double f[], void *self) {
  (void)t;
  bench_motion_field(f, &((const struct ode *)self)->motion, y);
  return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *self) {
  (void)t, (void)y;
  bench_motion_jacobian(dfdy, &((const struct ode *)self)->motion);
  memset(dfdt, 0, N_Y * sizeof *dfdt);
  return GSL_SUCCESS;
}

const gsl_odeiv2_step_type *bench_gsl_step(const char *name) {
  const struct {
    const char *name;
    const gsl_odeiv2_step_type *type;
  } types[] = {{"rk8pd", gsl_odeiv2_step_rk8pd}, {"rkck", gsl_odeiv2_step_rkck},
               {"rkf45", gsl_odeiv2_step_rkf45}, {"msadams", gsl_odeiv2_step_msadams},
               {"bsimp", gsl_odeiv2_step_bsimp}, {"msbdf", gsl_odeiv2_step_msbdf}};
  for (size_t i = 0; i < sizeof types / sizeof *types; i++)
    if (strcmp(types[i].name, name) == 0) return types[i].type;
  return NULL;
}

void *bench_ode_open(const struct bench_method *m, double tolerance, const struct bench_env *env) {
  bool multistep = strncmp(m->data, "ms", 2) == 0;
  (void)env;
  struct ode *o = ss_malloc(sizeof *o);
  *o = (struct ode){.own = multistep};
  o->system = (gsl_odeiv2_system){right_side, jacobian, N_Y, o};
  o->driver = gsl_odeiv2_driver_alloc_y_new(&o->system, bench_gsl_step(m->data), 0.01, tolerance, tolerance);
  o->locator = multistep ? gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, N_Y) : o->driver->s;
  return o;
}

void bench_ode_close(void *self) {
  struct ode *o = self;
  if (o->own) gsl_odeiv2_step_free(o->locator);
  gsl_odeiv2_driver_free(o->driver);
  free(o);
}

/* --- Events. --- */

struct point {
  double s, value, rate, y[N_Y];
};

static void look(struct point *p, const struct ode *o) {
  p->value = bench_motion_switch(&p->rate, &o->motion, p->y);
}

/* The point s into the step that begins at from. */
static int point_at(struct point *p, struct ode *o, const struct point *from, double s) {
  double err[N_Y];
  *p = *from;
  p->s = s;
  int failed = s > 0 ? gsl_odeiv2_step_apply(o->locator, 0, s, p->y, err, NULL, NULL, &o->system) : 0;
  look(p, o);
  return failed;
}

/* The root between from, where sign value < 0, and *to, where it is not; into *to.  The iteration ends with a step
   below rounding, which is not worth another look. */
static int locate(struct point *to, struct ode *o, const struct point *from, double sign) {
  double low = from->s, high = to->s;
  int failed = 0;
  for (int i = 0; i < 60 && !failed; i++) {
    double step = -to->value / to->rate, next = to->s + step;
    if (fabs(step) <= 2e-16 * o->motion.longest || high - low <= 2e-16 * o->motion.longest) break;
    if (sign * to->value < 0)
      low = to->s;
    else
      high = to->s;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    failed = point_at(to, o, from, next);
  }
  return failed;
}

/* The top between two points of a step, when the function rises towards zero at the first and falls at the second. */
static int top(struct point *p, struct ode *o, const struct point *from, const struct point *to) {
  struct point a = *from, b = *to;
  int failed = 0;
  for (int i = 0; i < 4 && !failed; i++) {
    failed = point_at(p, o, from, a.s + (b.s - a.s) * a.rate / (a.rate - b.rate));
    if (p->rate * a.rate > 0)
      a = *p;
    else
      b = *p;
  }
  return failed;
}

/* Integrates the phase from y to its event: the time, and y there. */
static int run_phase(double *t_event, void *self, double y[N_Y], long *steps) {
  struct ode *o = self;
  struct point from = {.s = 0}, to;
  double t = 0;
  gsl_odeiv2_driver_reset(o->driver);
  memcpy(from.y, y, sizeof from.y);
  look(&from, o);
  double sign = from.value != 0 ? -copysign(1, from.value) : -copysign(1, from.rate);
  for (long n = 0; n < bench_motion_steps(&o->motion); n++) {
    double begin = t;
    to = from;
    if (gsl_odeiv2_evolve_apply(o->driver->e, o->driver->c, o->driver->s, &o->system, &t,
                                t + bench_motion_stride(&o->motion), &o->hint, to.y))
      return SS_UNABLE;
    ++*steps;
    to.s = t - begin;
    look(&to, o);
    if (!isfinite(to.value)) return SS_UNABLE;
    bool crossed = sign * to.value >= 0;
    if (!crossed && sign * from.rate > 0 && sign * to.rate < 0) {
      struct point high;
      if (top(&high, o, &from, &to)) return SS_UNABLE;
      crossed = sign * high.value >= 0;
      if (crossed) to = high;
    }
    if (crossed) {
      if (locate(&to, o, &from, sign)) return SS_UNABLE;
      *t_event = begin + to.s;
      memcpy(y, to.y, sizeof to.y);
      return SS_OK;
    }
    from = to;
    from.s = 0;
  }
  return SS_UNABLE;
}

int bench_ode_run(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  struct ode *o = self;
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  o->hint = 0.01;
  int status = bench_motion_pass(out, steps, o, c->x, run_phase);
  gsl_set_error_handler(old);
  return status;
}
