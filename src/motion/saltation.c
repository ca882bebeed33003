/* The return Jacobian by saltation matrices: perturbations are compared at equal times, carried through a phase by the
   matrix exponential and across a switch by S = I + (f+ - f-) n^T / (n.f-), f- and f+ the vector fields before and
   after it and n the gradient of the switching function.  Only at the end, of the period or of the one phase that is
   asked for, are they taken back along the motion from equal times to each motion's own event.  Nothing is
   differentiated at the events, and no closed form of a phase is used. */
#include <stdbool.h>

#include "dynamics.h"
#include "num/calc.h"

/* The switching functions are affine, so their gradient applied to v is a difference. */
static int along_gradient(void *out, enum phase ph, const struct num_vec *params, const struct num_vec *v) {
  struct calc c = calc_begin(params->ctx);
  struct num_vec zero = calc_vec(&c, N_STATE);
  void *at_v = calc_new(&c), *at_zero = calc_new(&c);
  int s = dyn_switching(at_v, ph, params, v) | dyn_switching(at_zero, ph, params, &zero);
  calc_store(&c, out, calc_sub(&c, at_v, at_zero));
  calc_clear(&c);
  return s | c.status;
}

static int vector_field(struct num_vec *f, enum phase ph, const struct num_vec *params, const struct num_vec *z) {
  struct num_vec a;
  num_vec_init(&a, N_STATE * N_STATE, params->ctx);
  int s = dyn_system(&a, ph, params);
  s |= num_mat_mul(f, &a, z, N_STATE, N_STATE, 1);
  num_vec_clear(&a);
  return s;
}

/* How much earlier the perturbed motion ends its phase: lead = (n.column)/(n.before). */
static int delay(void *lead, enum phase ph, const struct num_vec *params, const struct num_vec *column,
                 const struct num_vec *before) {
  struct calc c = calc_begin(params->ctx);
  void *off = calc_new(&c), *rate = calc_new(&c);
  int s = along_gradient(off, ph, params, column) | along_gradient(rate, ph, params, before);
  calc_store(&c, lead, calc_div(&c, off, rate));
  calc_clear(&c);
  return s | c.status;
}

/* column += (to - from) lead; to may be NULL for zero. */
static int cross(struct num_vec *column, const struct num_vec *to, const struct num_vec *from, const void *lead) {
  struct calc c = calc_begin(column->ctx);
  for (slong i = 0; i < N_STATE; i++) {
    val f = num_vec_at(from, i), jump = to ? calc_sub(&c, num_vec_at(to, i), f) : calc_neg(&c, f);
    calc_store(&c, num_vec_at(column, i), calc_add(&c, num_vec_at(column, i), calc_mul(&c, jump, lead)));
  }
  calc_clear(&c);
  return c.status;
}

/* A perturbation carried through the phase, which ends at the state end after t, and across its end.  home: it is then
   taken back along the motion that follows, to the perturbed motion's own event. */
static int carry_phase(struct num_vec *column, enum phase ph, const struct num_vec *params, const struct num_vec *end,
                       const void *t, bool home) {
  struct calc c = calc_begin(params->ctx);
  struct num_vec phi = calc_vec(&c, N_STATE * N_STATE), before = calc_vec(&c, N_STATE), after = calc_vec(&c, N_STATE),
                 lead = calc_vec(&c, 1);
  int s = dyn_propagator(&phi, ph, params, t);
  s |= num_mat_mul(column, &phi, column, N_STATE, N_STATE, 1);
  s |= vector_field(&before, ph, params, end);
  s |= vector_field(&after, (enum phase)((ph + 1) % N_PHASES), params, end);
  s |= delay(num_vec_at(&lead, 0), ph, params, column, &before);
  s |= cross(column, &after, &before, num_vec_at(&lead, 0));
  if (home) s |= cross(column, NULL, &after, num_vec_at(&lead, 0));
  calc_clear(&c);
  return s;
}

/* The perturbation that starts as unit vector e_k, at the end of the period. */
static int carry(struct num_vec *column, slong k, const struct num_vec *params, const struct dyn_arc *arc) {
  int s = SS_OK;
  for (slong i = 0; i < N_STATE; i++) s |= params->ctx.type->set_d(num_vec_at(column, i), i == k, params->ctx.prec);
  for (int ph = PHASE_D; ph < N_PHASES; ph++) {
    struct num_vec end = {params->ctx, N_STATE, num_vec_at(&arc->z, (ph + 1) * N_STATE)};
    s |= carry_phase(column, (enum phase)ph, params, &end, num_vec_at(&arc->t, ph), ph == PHASE_C);
  }
  return s;
}

int dyn_local_jacobian_saltation(struct num_vec *j, enum phase ph, const struct num_vec *params,
                                 const struct num_vec *in, const void *t) {
  struct calc c = calc_begin(params->ctx);
  struct num_vec column = calc_vec(&c, N_STATE), phi = calc_vec(&c, N_STATE * N_STATE), end = calc_vec(&c, N_STATE);
  int s = dyn_propagator(&phi, ph, params, t) | num_mat_mul(&end, &phi, in, N_STATE, N_STATE, 1);
  for (slong k = 0; k < N_STATE; k++) {
    for (slong i = 0; i < N_STATE; i++) s |= params->ctx.type->set_d(num_vec_at(&column, i), i == k, params->ctx.prec);
    s |= carry_phase(&column, ph, params, &end, t, true);
    for (slong i = 0; i < N_STATE; i++) j->ctx.type->set(num_vec_at(j, N_STATE * i + k), num_vec_at(&column, i));
  }
  calc_clear(&c);
  return s;
}

int dyn_return_jacobian_saltation(struct num_vec *j, const struct num_vec *params, const struct dyn_arc *arc) {
  struct num_vec column;
  num_vec_init(&column, N_STATE, params->ctx);
  int s = SS_OK;
  for (slong k = 0; k < 2; k++) {
    s |= carry(&column, k, params, arc);
    for (slong i = 0; i < 2; i++) j->ctx.type->set(num_vec_at(j, 2 * i + k), num_vec_at(&column, i));
  }
  num_vec_clear(&column);
  return s;
}
