/* The return Jacobian by saltation matrices: perturbations are compared at equal times, carried through a phase by the
   matrix exponential and across a switch by S = I + (f+ - f-) n^T / (n.f-), f- and f+ the vector fields before and
   after it and n the gradient of the switching function.  Only at the end, of the period or of the one phase that is
   asked for, are they taken back along the motion from equal times to each motion's own event.  Nothing is
   differentiated at the events, and no closed form of a phase is used. */
#include <stdbool.h>

#include "dynamics.h"
#include "num/calc.h"

static int vector_field(struct num_vec *f, enum phase ph, const struct num_vec *params, const struct num_vec *z) {
  OWNED(num_vec) a;
  num_vec_init(&a, N_STATE * N_STATE, params->ctx);
  int s = dyn_system(&a, ph, params);
  s |= num_mat_mul(f, &a, z, N_STATE, N_STATE, 1);
  return s;
}

/* Perturbations, the columns of m, carried through the phase, which ends at the state end after t, and across its end.
   A perturbed motion ends it earlier by lead = (n.column)/(n.f-).  home: they are then taken back along the motion that
   follows, each to the perturbed motion's own event. */
static int carry_phase(struct num_vec *m, enum phase ph, const struct num_vec *params, const struct num_vec *end,
                       const void *t, bool home) {
  slong n = m->len / N_STATE;
  OWNED(calc) c = calc_begin(params->ctx);
  struct num_vec phi = calc_vec(&c, N_STATE * N_STATE), column = calc_vec(&c, N_STATE), before = calc_vec(&c, N_STATE),
                 after = calc_vec(&c, N_STATE);
  void *off = calc_new(&c), *rate = calc_new(&c);
  int s = dyn_propagator(&phi, ph, params, t) | num_mat_mul(m, &phi, m, N_STATE, N_STATE, n);
  s |= vector_field(&before, ph, params, end);
  s |= vector_field(&after, (enum phase)((ph + 1) % N_PHASES), params, end);
  s |= dyn_switching_along(rate, ph, params, &before);
  for (slong k = 0; k < n; k++) {
    for (slong i = 0; i < N_STATE; i++) calc_store(&c, num_vec_at(&column, i), num_vec_at(m, i * n + k));
    s |= dyn_switching_along(off, ph, params, &column);
    val lead = calc_div(&c, off, rate);
    for (slong i = 0; i < N_STATE; i++) {
      val f = num_vec_at(&before, i), g = num_vec_at(&after, i);
      val x = calc_add(&c, num_vec_at(&column, i), calc_mul(&c, calc_sub(&c, g, f), lead));
      if (home) x = calc_add(&c, x, calc_mul(&c, calc_neg(&c, g), lead));
      calc_store(&c, num_vec_at(m, i * n + k), x);
    }
  }
  return s | c.status;
}

/* The first unit vectors as columns. */
static int unit_columns(struct num_vec *m) {
  slong n = m->len / N_STATE;
  int s = SS_OK;
  for (slong i = 0; i < N_STATE * n; i++) s |= m->ctx.type->set_d(num_vec_at(m, i), i / n == i % n, m->ctx.prec);
  return s;
}

int dyn_local_jacobian_saltation(struct num_vec *j, enum phase ph, const struct num_vec *params,
                                 const struct num_vec *in, const void *t) {
  OWNED(calc) c = calc_begin(params->ctx);
  struct num_vec phi = calc_vec(&c, N_STATE * N_STATE), end = calc_vec(&c, N_STATE);
  int s = dyn_propagator(&phi, ph, params, t) | num_mat_mul(&end, &phi, in, N_STATE, N_STATE, 1);
  s |= unit_columns(j) | carry_phase(j, ph, params, &end, t, true);
  return s;
}

int dyn_return_jacobian_saltation(struct num_vec *j, const struct num_vec *params, const struct dyn_arc *arc) {
  OWNED(calc) c = calc_begin(params->ctx);
  struct num_vec m = calc_vec(&c, N_STATE * 2);
  int s = unit_columns(&m);
  for (int ph = PHASE_D; ph < N_PHASES; ph++) {
    const struct num_vec end = dyn_arc_state(arc, ph + 1);
    s |= carry_phase(&m, (enum phase)ph, params, &end, num_vec_at(&arc->t, ph), ph == PHASE_C);
  }
  for (slong i = 0; i < 4; i++) calc_store(&c, num_vec_at(j, i), num_vec_at(&m, i));
  return s;
}
