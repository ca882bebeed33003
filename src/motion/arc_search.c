/* One pass through the word from its start alone.

   The return map in double precision finds the first events, and the pass is made near them.  What that does not bring
   about is searched phase by phase, each first event from the state at many digits in which its phase begins. */
#include "arc.h"

/* The first events, in double precision. */
static int first_times(double t[N_PHASES], const struct num_vec *params, val z10, val z20) {
  OWNED(calc) c = calc_begin(params->ctx);
  double p[N_PARAMS], end, r = c.ctx.type->get_d(calc_sub(&c, z20, z10));
  for (int i = 0; i < N_PARAMS; i++) p[i] = c.ctx.type->get_d(num_vec_at(params, i));
  return c.status ? c.status : dyn_return_map_d(&end, NULL, t, p, r);
}

int dyn_arc_run(struct dyn_arc *a, const struct num_vec *params, const void *z10, const void *z20,
                const double guess[N_PHASES]) {
  double t[N_PHASES];
  if (guess) return arc_run(a, params, z10, z20, NULL, guess);
  bool at_once = params->ctx.type != &num_double && first_times(t, params, z10, z20) == SS_OK;
  if (at_once && map_run(a, params, z10, z20, NULL, t) == SS_OK) return SS_OK;
  return arc_run(a, params, z10, z20, NULL, NULL);
}
