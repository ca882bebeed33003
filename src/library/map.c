/* Double precision: the names and orders are the program's own. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "explore/batch.h"
#include "explore/family.h"
#include "library.h"
#include "motion/return_map.h"

_Static_assert((int)SS_PARAMS == N_PARAMS && (int)SS_PARAM_E2 == P_E2, "the order of the parameters");
_Static_assert((int)SS_OUTPUTS == N_DYN_OUT && (int)SS_OUT_TRACE == DYN_OUT_TRACE, "the order of the outputs");
_Static_assert((int)SS_COND_GAMMA_R == COND_GAMMA_R && (int)SS_COND_U_R1 == MEMBER_U_R, "the order of the conditions");

const char *ss_condition_name(int condition) {
  return condition >= 0 && condition < SS_CONDITIONS ? orbit_condition_name(condition) : NULL;
}

int ss_return_map(double *r_end, double *slope, double t[4], int *grazing, const double params[SS_PARAMS], double r) {
  struct dyn_return z;
  if (!r_end || !params) return library_argument(__func__, "no parameters, or no place for r");
  int status = dyn_return_map(&z, params, r);
  if (status) return status;
  *r_end = z.r_end;
  if (slope) *slope = z.slope;
  if (t) memcpy(t, z.t, sizeof z.t);
  if (grazing) *grazing = z.grazing;
  return SS_OK;
}

int ss_return_map_plain(double *r_end, double *slope, double t[4], const double params[SS_PARAMS], double r) {
  if (!r_end || !params) return library_argument(__func__, "no parameters, or no place for r");
  return dyn_return_map_d(r_end, slope, t, params, r);
}

int ss_orbit_warm(double out[SS_OUTPUTS], unsigned *violations, unsigned *unsure, const double params[SS_PARAMS],
                  const double guess[2]) {
  if (!out || !params || !guess) return library_argument(__func__, "no parameters, guess or place for the orbit");
  return dyn_orbit_warm(out, violations, unsure, params, guess);
}

int ss_orbit_bare(double out[SS_OUTPUTS], const double params[SS_PARAMS], const double guess[2]) {
  if (!out || !params || !guess) return library_argument(__func__, "no parameters, guess or place for the orbit");
  int status = dyn_orbit_bare(out, params, guess);
  if (!status) out[SS_OUT_U_R1_MIN] = out[SS_OUT_U_R2_MIN] = NAN;
  return status;
}

static bool all_there(const void *const *row, int n) {
  for (int i = 0; row && i < n; i++)
    if (!row[i]) return false;
  return row != NULL;
}

int ss_orbits_batch(double *const out[SS_OUTPUTS], unsigned *violations, int *status,
                    const double *const params[SS_PARAMS], const double *const guess[2], size_t n) {
  if (n == 0) return SS_OK;
  if (!all_there((const void *const *)out, SS_OUTPUTS) || !all_there((const void *const *)params, SS_PARAMS) ||
      !all_there((const void *const *)guess, 2) || !violations || !status || n > WORD_MAX)
    return library_argument(__func__, "an array is NULL, or there are too many points");
  return dyn_orbits_batch(out, violations, status, params, guess, (slong)n);
}

int ss_return_jacobian(double j[4], double *err, const double params[SS_PARAMS], const double start[2],
                       const double guess[4]) {
  if (!j || !params || !start || !isfinite(start[0]) || !isfinite(start[1]))
    return library_argument(__func__, "no parameters, no finite start or no place for the matrix");
  if (!dyn_in_domain_d(params)) return SS_DOMAIN;
  int status = dyn_return_jacobian_from(j, params, start, guess);
  if (status || !err) return status;
  *err = 0;
  for (int i = 0; i < 4; i++) *err = fmax(*err, DBL_EPSILON / 2 * fabs(j[i]));
  return SS_OK;
}
