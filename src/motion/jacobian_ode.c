/* Derivatives from the integration of the original equations: differences of the motion's return to the global stick
   phase, and of one phase alone up to the event that ends it.  They share nothing with the model in (w, r): neither
   phases nor closed forms.  The price is accuracy: the integrator's error over the step. */
#include <math.h>
#include <string.h>

#include "coulomb.h"
#include "differences.h"

/* Error of one integration that is assumed at least, relative to the state, at the tightest tolerance. */
static const double integration_error = 1e-13;

/* Where the masses come to stick both for the first time after the start; the phases must be the paper's. */
static int first_return(double *x, const double *start, const void *params) {
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r;
  OWNED(coulomb_log) log = {.n = 0};
  OWNED(text) word = {0};
  struct coulomb_sink sink = coulomb_log_sink(&log);
  plan.returns = 1;
  plan.max_events = 64; /* the word has four */
  int s = coulomb_simulate_ode(&r, params, start, &plan, &sink);
  coulomb_log_word(&word, &log);
  if (s == SS_OK && strcmp(text_str(&word), "GHCD") != 0) s = SS_DOMAIN;
  for (int i = 0; i < 2; i++) x[i] = r.at.x[i];
  return s;
}

/* One phase, and what it is simulated with. */
struct stretch {
  const double *params;
  const struct dyn_stretch *of;
};

static bool end_at_event(void *self, const struct coulomb_event *e) {
  *(struct coulomb_event *)self = *e;
  return false;
}

/* The state at the event that ends the phase; any other first event is a motion of another kind. */
static int phase_end(double *z, const double *start, const void *self) {
  static const int mass[N_PHASES] = {0, 1, 0, 1};
  static const enum coulomb_mode from[N_PHASES] = {MODE_STICK, MODE_STICK, MODE_BELOW, MODE_BELOW};
  static const char next[] = "GHCD";
  const struct stretch *s = self;
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r;
  struct coulomb_event e = {.mass = -1};
  plan.duration = 2 * s->of->t;
  int status = coulomb_simulate_ode(&r, s->params, start, &plan, &(struct coulomb_sink){&e, end_at_event, NULL});
  if (status == SS_OK && (e.mass != mass[s->of->phase] || e.from != from[s->of->phase] || e.simultaneous ||
                          coulomb_letter(e.at.mode) != next[s->of->phase]))
    status = SS_DOMAIN;
  for (int i = 0; i < 2 && !status; i++) {
    z[Z_1 + i] = e.at.x[i];
    z[DZ_1 + i] = e.at.v[i];
  }
  return status;
}

static struct double_map map_from(int (*run)(double *, const double *, const void *), const void *self,
                                  const double *params, const double *start, int n_out) {
  return (struct double_map){run, self, N_STATE, n_out, coulomb_scale(params, start), integration_error, 0};
}

int coulomb_return_jacobian(double j[4], double *err, const double params[N_COULOMB], const double start[N_STATE]) {
  const struct double_map map = map_from(first_return, params, params, start, 2);
  return differences_jacobian(j, err, &map, start);
}

double coulomb_return_jacobian_floor(const double params[N_COULOMB], const double start[N_STATE]) {
  const double rungs = 16; /* the ladder of steps takes four, each half of the one before */
  double f[2];
  coulomb_forces(f, params, start);
  double room[2] = {params[COULOMB_UR1] - fabs(f[0]), (params[COULOMB_UR2] - fabs(f[1])) / params[COULOMB_CHI]};
  return 3 * rungs * integration_error * coulomb_scale(params, start) / fmin(room[0], room[1]);
}

int coulomb_local_differences(double *out, double *err, const double params[N_COULOMB], const struct dyn_stretch *of,
                              const double (*dir)[N_STATE], int n_dir) {
  if (!(of->t > 0)) return SS_DOMAIN;
  const struct stretch stretch = {params, of};
  const struct double_map map = map_from(phase_end, &stretch, params, of->start, N_STATE);
  return differences_along_all(out, err, &map, of->start, dir, n_dir);
}
