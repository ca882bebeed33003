/* The smoothed laws and the return to a section on which the second mass slides.

   There both laws are flat, so the motion is smooth in the ordinary sense; the section is met exactly by Henon's change
   of the independent variable: from the end of the step that crossed it the equations are integrated back in q. */
#include "bench/smooth.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

const char *const smooth_law_name[N_LAWS] = {"tanh", "stribeck", "wide"};

/* The largest value of tanh x (sliding + rise exp(-(x/width)^2)), which rises to one top and falls: by sections of a
   third. */
static double peak(double sliding, double rise, double width) {
  double low = 0, high = fmin(4 * width, 40), at[2], value[2];
  for (int i = 0; i < 120; i++) {
    for (int k = 0; k < 2; k++) {
      at[k] = low + (high - low) * (1 + k) / 3;
      double part = at[k] / width;
      value[k] = tanh(at[k]) * (sliding + rise * exp(-part * part));
    }
    if (value[0] < value[1])
      low = at[0];
    else
      high = at[1];
  }
  return fmax(value[0], value[1]);
}

static double rise_of(double sliding, double limit, double width) {
  double low = 0, high = 16 * (limit - sliding);
  for (int i = 0; i < 60; i++) {
    double mid = 0.5 * (low + high);
    if (peak(sliding, mid, width) < limit)
      low = mid;
    else
      high = mid;
  }
  return 0.5 * (low + high);
}

void smooth_init(struct smooth *m, enum smooth_law law, double slope, const double params[N_PARAMS],
                 const double static_limit[2]) {
  *m = (struct smooth){.chi = params[P_CHI], .eta = params[P_ETA], .V = params[P_V], .slope = slope};
  m->width = law == LAW_WIDE ? fmax(sqrt(slope), 10) : 10;
  for (int i = 0; i < 2; i++) {
    m->sliding[i] = static_limit[i] - params[P_E1 + i];
    m->rise[i] = law == LAW_TANH ? 0 : rise_of(m->sliding[i], static_limit[i], m->width);
  }
}

double smooth_friction(double *rate, const struct smooth *m, int mass, double p) {
  double by_p = -m->slope / m->V, x = by_p * p, part = x / m->width;
  double t = tanh(x), extra = m->rise[mass] * exp(-part * part);
  *rate = by_p * ((1 - t * t) * (m->sliding[mass] + extra) - t * extra * 2 * part / m->width);
  return t * (m->sliding[mass] + extra);
}

static void field(double f[STEPPER_SIZE], const void *self, const double y[STEPPER_SIZE]) {
  const struct smooth *m = self;
  double rate;
  f[S_W] = (1 - m->chi) * m->V + y[S_P] - m->chi * y[S_Q];
  f[S_R] = y[S_Q] - y[S_P];
  f[S_P] = -y[S_W] - (m->sliding[0] - smooth_friction(&rate, m, 0, y[S_P]));
  f[S_Q] = -m->eta * (m->chi * y[S_R] + m->sliding[1] - smooth_friction(&rate, m, 1, y[S_Q]));
}

static void jacobian(double j[STEPPER_SIZE * STEPPER_SIZE], const void *self, const double y[STEPPER_SIZE]) {
  const struct smooth *m = self;
  double first, second;
  smooth_friction(&first, m, 0, y[S_P]);
  smooth_friction(&second, m, 1, y[S_Q]);
  const double rows[STEPPER_SIZE * STEPPER_SIZE] = {
      0, 0, 1, -m->chi, 0, 0, -1, 1, -1, 0, first, 0, 0, -m->eta * m->chi, 0, m->eta * second};
  memcpy(j, rows, sizeof rows);
}

struct stepper_system smooth_system(const struct smooth *m, double tolerance, double longest) {
  double small = tolerance * fmin(1, 10 / m->slope);
  return (struct stepper_system){field, jacobian, m, tolerance, {tolerance, tolerance, small, small}, longest};
}

/* --- The section. --- */

/* By q: time, w, r, p. */
static int by_q(double q, const double z[], double f[], void *self) {
  double y[STEPPER_SIZE] = {z[1], z[2], z[3], q}, rate[STEPPER_SIZE];
  field(rate, self, y);
  f[0] = 1 / rate[S_Q];
  for (int i = 0; i < 3; i++) f[1 + i] = rate[i] / rate[S_Q];
  return isfinite(f[0]) ? GSL_SUCCESS : GSL_FAILURE;
}

static int go_back(double *t, double y[STEPPER_SIZE], const struct smooth *m, double tolerance) {
  gsl_odeiv2_system system = {by_q, NULL, STEPPER_SIZE, (void *)(size_t)m};
  double q = y[S_Q], z[STEPPER_SIZE] = {*t, y[S_W], y[S_R], y[S_P]};
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  gsl_odeiv2_driver *d =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, (m->level - q) / 8, tolerance, tolerance);
  gsl_odeiv2_driver_set_nmax(d, 1000);
  int failed = q == m->level ? 0 : gsl_odeiv2_driver_apply(d, &q, m->level, z);
  gsl_odeiv2_driver_free(d);
  gsl_set_error_handler(old);
  *t = z[0];
  for (int i = 0; i < 3; i++) y[i] = z[1 + i];
  y[S_Q] = m->level;
  return failed ? SS_UNABLE : SS_OK;
}

int smooth_return(struct smooth_passage *s, double y[STEPPER_SIZE], const struct smooth_way *way) {
  const struct smooth *m = way->m;
  double t = 0, before = 0;
  bool above = false; /* q has been over the level since the start */
  *s = (struct smooth_passage){.creep = NAN, .nearest = INFINITY};
  int status = stepper_start(way->stepper, y);
  while (!status) {
    if (s->steps == way->most_steps) return SS_UNABLE;
    if (t > way->longest) return SS_DOMAIN;
    status = stepper_step(way->stepper, &t, y);
    s->steps++;
    s->nearest = fmin(s->nearest, fmax(fabs(y[S_P]), fabs(y[S_Q])));
    if (before < way->creep_at && t >= way->creep_at) s->creep = fmax(fabs(y[S_P]), fabs(y[S_Q]));
    before = t;
    if (above && y[S_Q] <= m->level) break;
    above = above || y[S_Q] > m->level;
  }
  if (!status) status = go_back(&t, y, m, 1e-12);
  s->time = t;
  return status;
}
