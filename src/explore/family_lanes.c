/* Arrays for many orbits at once, which grow as they are asked for, and the call that solves them (batch.h). */
#include "family_lanes.h"

#include <stdlib.h>

#include "base/arena.h"
#include "batch.h"

void family_lanes_room(struct family_lanes *a, slong n, const double params[N_PARAMS]) {
  size_t size = (size_t)n * sizeof(double);
  if (n <= a->cap) return;
  for (int i = 0; i < N_PARAMS; i++) a->params[i] = ss_realloc(a->params[i], size);
  for (int i = 0; i < 2; i++) a->guess[i] = ss_realloc(a->guess[i], size);
  for (int i = 0; i < N_DYN_OUT; i++) a->out[i] = ss_realloc(a->out[i], size);
  a->violations = ss_realloc(a->violations, (size_t)n * sizeof *a->violations);
  a->status = ss_realloc(a->status, (size_t)n * sizeof *a->status);
  for (int i = 0; i < N_PARAMS; i++)
    for (slong k = 0; k < n; k++) a->params[i][k] = params[i];
  a->cap = n;
}

void family_lanes_clear(struct family_lanes *a) {
  for (int i = 0; i < N_PARAMS; i++) free(a->params[i]);
  for (int i = 0; i < 2; i++) free(a->guess[i]);
  for (int i = 0; i < N_DYN_OUT; i++) free(a->out[i]);
  free(a->violations);
  free(a->status);
}

void family_lanes_solve(struct family_lanes *a, slong n) {
  const double *params[N_PARAMS], *guess[2] = {a->guess[0], a->guess[1]};
  for (int i = 0; i < N_PARAMS; i++) params[i] = a->params[i];
  dyn_orbits_batch(a->out, a->violations, a->status, params, guess, n);
}
