/* A chain of masses: within one configuration (which mass sticks, and on which side of V the others are) the motion is
   affine, y' = A y with y = (x, x', 1), and exp(A h) carries it exactly; configurations are patched together at the
   first sign change of a switching condition.  The other route lets GSL integrate the same right side.

   Both look for events in steps of their own length, so that an excursion between two looks that one of them misses
   shows as a disagreement. */
#include "chain.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

#include "base/work.h"

enum { SIDE = 2 * CHAIN_MOST + 1 };
enum { UNITS_OF_LOOK = 15 }; /* of work */

struct walk {
  const struct chain *c;
  enum chain_route route;
  enum coulomb_mode mode[CHAIN_MOST];
  int fresh; /* the mass that has just begun to slip from V, or -1: its condition starts at zero */
  double look, z[2 * CHAIN_MOST];
  double stride[SIDE * SIDE]; /* exp(A look) of the present configuration */
  gsl_odeiv2_system system;
  gsl_odeiv2_driver *driver;
};

static double force(const struct chain *c, const double *z, int i) {
  double f = c->spring[i] * (z[i] - (i > 0 ? z[i - 1] : 0));
  return i + 1 < c->n ? f + c->spring[i + 1] * (z[i] - z[i + 1]) : f;
}

static int right_side(double t, const double z[], double dz[], void *self) {
  (void)t;
  const struct walk *w = self;
  int n = w->c->n;
  for (int i = 0; i < n; i++) {
    double u = w->mode[i] == MODE_BELOW ? w->c->us[i] : -w->c->us[i];
    dz[i] = z[n + i];
    dz[n + i] = w->mode[i] == MODE_STICK ? 0 : w->c->mobility[i] * (u - force(w->c, z, i));
  }
  return GSL_SUCCESS;
}

/* exp(A h): A's columns are the right side's differences from its value at zero. */
static void exponential(double *out, const struct walk *w, double h) {
  int n = w->c->n, side = 2 * n + 1;
  double zero[2 * CHAIN_MOST] = {0}, at_zero[2 * CHAIN_MOST], one[2 * CHAIN_MOST], rate[2 * CHAIN_MOST];
  double a[SIDE * SIDE] = {0};
  right_side(0, zero, at_zero, (void *)w);
  for (int k = 0; k < 2 * n; k++) {
    memset(one, 0, sizeof one);
    one[k] = 1;
    right_side(0, one, rate, (void *)w);
    for (int i = 0; i < 2 * n; i++) a[i * side + k] = h * (rate[i] - at_zero[i]);
  }
  for (int i = 0; i < 2 * n; i++) a[i * side + 2 * n] = h * at_zero[i];
  gsl_matrix_view in = gsl_matrix_view_array(a, (size_t)side, (size_t)side);
  gsl_matrix_view to = gsl_matrix_view_array(out, (size_t)side, (size_t)side);
  gsl_linalg_exponential_ss(&in.matrix, &to.matrix, GSL_PREC_DOUBLE);
}

static void apply(double *to, const double *matrix, const double *from, int n) {
  int side = 2 * n + 1;
  for (int i = 0; i < 2 * n; i++) {
    to[i] = matrix[i * side + 2 * n];
    for (int k = 0; k < 2 * n; k++) to[i] += matrix[i * side + k] * from[k];
  }
}

/* The state h after w->z in the present configuration. */
static bool carry(double *to, struct walk *w, double h) {
  if (w->route == CHAIN_PATCHED) {
    double matrix[SIDE * SIDE];
    if (h != w->look) exponential(matrix, w, h);
    apply(to, h == w->look ? w->stride : matrix, w->z, w->c->n);
    return true;
  }
  double t = 0;
  memcpy(to, w->z, sizeof w->z);
  gsl_odeiv2_driver_reset(w->driver);
  return h == 0 || gsl_odeiv2_driver_apply(w->driver, &t, h, to) == GSL_SUCCESS;
}

/* Negative while mass i goes on as it does. */
static double condition(const struct walk *w, const double *z, int i) {
  double lead = z[w->c->n + i] - w->c->V;
  if (w->mode[i] == MODE_STICK) return fabs(force(w->c, z, i)) - w->c->ur[i];
  return w->mode[i] == MODE_BELOW ? lead : -lead;
}

/* The first root of mass i's condition, which changes sign within (0, h]: regula falsi of Illinois. */
static bool locate(double *s, struct walk *w, int i, double h, double at_end) {
  double a = 0, b = h, fa = condition(w, w->z, i), fb = at_end, z[2 * CHAIN_MOST];
  if (i == w->fresh || fa > 0) { /* it leaves zero: begin where it is well below */
    for (a = h / 2; a > 1e-9 * h; a /= 2) {
      if (!carry(z, w, a)) return false;
      fa = condition(w, z, i);
      if (fa < 0) break;
    }
  }
  for (int k = 0; k < 200 && b - a > 1e-15; k++) {
    double mid = a + (b - a) * fa / (fa - fb);
    if (!(mid > a && mid < b)) mid = 0.5 * (a + b);
    if (!carry(z, w, mid)) return false;
    double f = condition(w, z, i);
    if (f < 0) {
      a = mid;
      fa = f;
      fb /= 2;
    } else {
      b = mid;
      fb = f;
      fa /= 2;
    }
    if (f == 0) break;
  }
  *s = b;
  return true;
}

/* The law for the mass that has the event, which is at V or at its limit. */
static void change(struct walk *w, int i) {
  double f = force(w->c, w->z, i);
  bool loose = w->mode[i] == MODE_STICK, holds = fabs(f) < w->c->ur[i];
  w->z[w->c->n + i] = w->c->V;
  w->mode[i] = !loose && holds ? MODE_STICK : f > 0 ? MODE_BELOW : MODE_ABOVE;
  w->fresh = w->mode[i] == MODE_STICK ? -1 : i;
}

static void begin(struct walk *w) {
  if (w->route == CHAIN_PATCHED) exponential(w->stride, w, w->look);
}

/* One look ahead: to the first event in it, or to its end. */
static int advance(double *gone, struct walk *w, struct chain_motion *m, double t, double h) {
  double z[2 * CHAIN_MOST], first = h;
  int mass = -1;
  if (!carry(z, w, h)) return SS_UNABLE;
  for (int i = 0; i < w->c->n; i++) {
    double s, at_end = condition(w, z, i);
    if (at_end < 0) continue;
    if (!locate(&s, w, i, h, at_end)) return SS_UNABLE;
    if (s < first || mass < 0) {
      first = s;
      mass = i;
    }
  }
  if (mass >= 0 && !carry(z, w, first)) return SS_UNABLE;
  memcpy(w->z, z, sizeof w->z);
  w->fresh = -1;
  *gone = first;
  if (mass < 0) return SS_OK;
  if (m->n_events == CHAIN_EVENTS) return SS_UNABLE;
  change(w, mass);
  begin(w);
  m->event[m->n_events++] = (struct chain_event){t + first, mass, w->mode[mass]};
  return SS_OK;
}

static bool in_domain(const struct chain *c, const double *start, double duration) {
  bool ok = c->n >= 1 && c->n <= CHAIN_MOST && c->V > 0 && isfinite(c->V) && duration >= 0 && duration <= 1e6;
  for (int i = 0; ok && i < c->n; i++)
    ok = c->spring[i] > 0 && c->mobility[i] > 0 && c->us[i] >= 0 && c->us[i] < c->ur[i] && isfinite(c->spring[i]) &&
         isfinite(c->mobility[i]) && isfinite(c->ur[i]) && isfinite(start[i]) && isfinite(start[c->n + i]);
  return ok;
}

int chain_simulate(struct chain_motion *m, enum chain_route route, const struct chain *c, const double *start,
                   double duration) {
  *m = (struct chain_motion){.n_events = 0};
  if (!in_domain(c, start, duration)) return SS_DOMAIN;
  struct walk w = {.c = c, .route = route, .fresh = -1};
  double stiffest = 0;
  for (int i = 0; i < c->n; i++) {
    double lead = start[c->n + i] - c->V, f = force(c, start, i);
    stiffest = fmax(stiffest, 2 * c->mobility[i] * (c->spring[i] + (i + 1 < c->n ? c->spring[i + 1] : 0)));
    w.mode[i] = lead < 0 || (lead == 0 && f >= c->ur[i])    ? MODE_BELOW
                : lead > 0 || (lead == 0 && f <= -c->ur[i]) ? MODE_ABOVE
                                                            : MODE_STICK;
  }
  memcpy(w.z, start, 2 * (size_t)c->n * sizeof *start);
  w.look = (route == CHAIN_PATCHED ? 1.0 / 16 : 1.0 / 23) / sqrt(stiffest);
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  w.system = (gsl_odeiv2_system){right_side, NULL, 2 * (size_t)c->n, &w};
  w.driver = gsl_odeiv2_driver_alloc_y_new(&w.system, gsl_odeiv2_step_rk8pd, w.look, 1e-13, 1e-13);
  begin(&w);
  int s = SS_OK;
  for (double t = 0, gone; s == SS_OK && duration - t > 1e-12; t += gone) {
    work_add(UNITS_OF_LOOK);
    s = advance(&gone, &w, m, t, fmin(w.look, duration - t));
  }
  memcpy(m->z, w.z, sizeof m->z);
  gsl_odeiv2_driver_free(w.driver);
  gsl_set_error_handler(old);
  return s;
}
