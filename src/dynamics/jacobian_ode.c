/* The return Jacobian from the integration of the original equations: central differences of the motion's return to the
   global stick phase, at two steps, extrapolated.  It shares nothing with the model in (w, r): neither phases nor events
   nor closed forms.  The price is accuracy: the integrator's error over the step. */
#include <math.h>
#include <string.h>

#include "stickslip/coulomb.h"

/* Where the masses come to stick both for the first time after the start; the phases must be the paper's. */
static int first_return(double x[2], const double params[N_COULOMB], const double start[N_STATE]) {
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result r;
  struct coulomb_log log;
  struct text word;
  coulomb_log_init(&log);
  text_init(&word);
  struct coulomb_sink sink = coulomb_log_sink(&log);
  plan.returns = 1;
  plan.max_events = 64; /* the word has four */
  int s = coulomb_simulate_ode(&r, params, start, &plan, &sink);
  coulomb_log_word(&word, &log);
  if (s == SS_OK && strcmp(text_str(&word), "GHCD") != 0) s = SS_DOMAIN;
  for (int i = 0; i < 2; i++) x[i] = r.at.x[i];
  text_clear(&word);
  coulomb_log_clear(&log);
  return s;
}

static int central(double j[4], const double params[N_COULOMB], const double start[N_STATE], double h) {
  int s = SS_OK;
  for (int col = 0; col < 2; col++) {
    double moved[N_STATE], above[2], below[2];
    memcpy(moved, start, sizeof moved);
    moved[col] = start[col] + h;
    double up = moved[col];
    s |= first_return(above, params, moved);
    moved[col] = start[col] - h;
    double width = up - moved[col];
    s |= first_return(below, params, moved);
    for (int row = 0; row < 2; row++) j[2 * row + col] = (above[row] - below[row]) / width;
  }
  return s;
}

int coulomb_return_jacobian(double j[4], double *err, const double params[N_COULOMB], const double start[N_STATE]) {
  enum { HALVINGS = 12 };
  const double noise = 1e-12; /* of one return, relative to the state, at the tightest tolerance */
  double scale = fabs(start[0]) + fabs(start[1]) + params[COULOMB_V], h = scale / 4096;
  double coarse[4], fine[4];
  int s = SS_DOMAIN;
  for (int i = 0; s == SS_DOMAIN && i < HALVINGS; i++, h /= 2) {
    s = central(coarse, params, start, 2 * h);
    if (s == SS_OK) s = central(fine, params, start, h);
    if (s == SS_OK) break;
  }
  *err = 0;
  for (int i = 0; i < 4 && s == SS_OK; i++) {
    double change = (fine[i] - coarse[i]) / 3;
    j[i] = fine[i] + change;
    /* the extrapolation removes h^2; what is left is smaller than the change it made, by h^2 again */
    *err = fmax(*err, fabs(change) / 16 + 4 * noise * scale / h);
  }
  return s;
}
