/* One pass through the word: all phases at once (map.c) where the times are known and that works, else phase after
   phase.

   A velocity that an event sets to V is set to V: the event equation says so exactly, and balls stay narrower. */
#include "arc.h"
#include "event.h"

void dyn_arc_init(struct dyn_arc *a, struct num_ctx ctx) {
  num_vec_init(&a->t, N_PHASES, ctx);
  num_vec_init(&a->z, (N_PHASES + 1) * N_STATE, ctx);
}

void dyn_arc_clear(struct dyn_arc *a) {
  num_vec_clear(&a->t);
  num_vec_clear(&a->z);
}

struct num_vec dyn_arc_state(const struct dyn_arc *a, slong row) {
  return (struct num_vec){a->z.ctx, N_STATE, num_vec_at(&a->z, row * N_STATE)};
}

/* Phase after phase.  The times come from near, from guess, or, when both are NULL, from searches for first events. */
static int by_phases(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
                     const double guess[N_PHASES]) {
  const struct num_type *type = a->z.ctx.type;
  const void *V = num_vec_at(params, P_V);
  int status = SS_OK;
  struct num_vec in = dyn_arc_state(a, 0);
  type->set(num_vec_at(&in, Z_1), z10);
  type->set(num_vec_at(&in, Z_2), z20);
  type->set(num_vec_at(&in, DZ_1), V);
  type->set(num_vec_at(&in, DZ_2), V);
  for (int ph = PHASE_D; ph < N_PHASES && !status; ph++) {
    struct num_vec from = dyn_arc_state(a, ph), to = dyn_arc_state(a, ph + 1);
    void *t = num_vec_at(&a->t, ph);
    double t0 = near ? type->get_d(num_vec_at(near, ph)) : guess ? guess[ph] : 0;
    if (!near && !guess) status |= event_first(&t0, NULL, (enum phase)ph, params, &from, NULL);
    if (!status) status |= dyn_event(t, (enum phase)ph, params, &from, t0);
    if (status) break;
    status |= dyn_flow(&to, (enum phase)ph, params, &from, t);
    if (ph == PHASE_H) type->set(num_vec_at(&to, DZ_1), V);
    if (ph == PHASE_C) type->set(num_vec_at(&to, DZ_2), V);
  }
  return status;
}

/* The quick way does not know every case; what it cannot do is done phase by phase. */
int arc_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]) {
  if ((near || guess) && map_run(a, params, z10, z20, near, guess) == SS_OK) return SS_OK;
  return by_phases(a, params, z10, z20, near, guess);
}
