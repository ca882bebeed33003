/* The return Jacobian by saltation matrices: perturbations are compared at equal times, carried through a phase by the
   matrix exponential and across a switch by S = I + (f+ - f-) n^T / (n.f-), f- and f+ the vector fields before and after
   it and n the gradient of the switching function.  Only at the end of the period are they projected along the motion
   to the section z_2' = V.  Nothing is differentiated at the events, and no closed form of a phase is used. */
#include "stickslip/dynamics.h"

/* The switching functions are affine, so their gradient applied to v is a difference. */
static int along_gradient(void *out, enum phase ph, const struct num_vec *params, const struct num_vec *v) {
  const struct num_type *t = params->ctx.type;
  struct num_vec zero, at_zero;
  num_vec_init(&zero, N_STATE, params->ctx);
  num_vec_init(&at_zero, 1, params->ctx);
  int s = dyn_switching(out, ph, params, v);
  s |= dyn_switching(num_vec_at(&at_zero, 0), ph, params, &zero);
  s |= t->sub(out, out, num_vec_at(&at_zero, 0), params->ctx.prec);
  num_vec_clear(&at_zero);
  num_vec_clear(&zero);
  return s;
}

static int vector_field(struct num_vec *f, enum phase ph, const struct num_vec *params, const struct num_vec *z) {
  struct num_vec a;
  num_vec_init(&a, N_STATE * N_STATE, params->ctx);
  int s = dyn_system(&a, ph, params);
  s |= num_mat_mul(f, &a, z, N_STATE, N_STATE, 1);
  num_vec_clear(&a);
  return s;
}

/* column += jump (n.column)/(n.before), where jump is f+ - f- at a switch and -f- at the section. */
static int cross(struct num_vec *column, enum phase ph, const struct num_vec *params, const struct num_vec *before,
                 const struct num_vec *jump) {
  const struct num_type *t = params->ctx.type;
  slong prec = params->ctx.prec;
  struct num_vec w;
  num_vec_init(&w, 2, params->ctx);
  void *lead = num_vec_at(&w, 0), *x = num_vec_at(&w, 1);
  int s = along_gradient(lead, ph, params, column) | along_gradient(x, ph, params, before);
  s |= t->div(lead, lead, x, prec);
  for (slong i = 0; i < N_STATE; i++) {
    s |= t->mul(x, num_vec_at(jump, i), lead, prec);
    s |= t->add(num_vec_at(column, i), num_vec_at(column, i), x, prec);
  }
  num_vec_clear(&w);
  return s;
}

/* The perturbation that starts as unit vector e_k, at the end of the period. */
static int carry(struct num_vec *column, slong k, const struct num_vec *params, const struct dyn_arc *arc) {
  const struct num_type *t = params->ctx.type;
  slong prec = params->ctx.prec;
  struct num_vec phi, before, jump;
  num_vec_init(&phi, N_STATE * N_STATE, params->ctx);
  num_vec_init(&before, N_STATE, params->ctx);
  num_vec_init(&jump, N_STATE, params->ctx);
  int s = SS_OK;
  for (slong i = 0; i < N_STATE; i++) s |= t->set_d(num_vec_at(column, i), i == k, prec);
  for (int ph = PHASE_D; ph < N_PHASES; ph++) {
    struct num_vec end = {params->ctx, N_STATE, num_vec_at(&arc->z, (ph + 1) * N_STATE)};
    s |= dyn_propagator(&phi, (enum phase)ph, params, num_vec_at(&arc->t, ph));
    s |= num_mat_mul(column, &phi, column, N_STATE, N_STATE, 1);
    s |= vector_field(&before, (enum phase)ph, params, &end);
    if (ph + 1 < N_PHASES) s |= vector_field(&jump, (enum phase)(ph + 1), params, &end);
    for (slong i = 0; i < N_STATE; i++) {
      if (ph + 1 < N_PHASES)
        s |= t->sub(num_vec_at(&jump, i), num_vec_at(&jump, i), num_vec_at(&before, i), prec);
      else
        s |= t->neg(num_vec_at(&jump, i), num_vec_at(&before, i), prec);
    }
    s |= cross(column, (enum phase)ph, params, &before, &jump);
  }
  num_vec_clear(&jump);
  num_vec_clear(&before);
  num_vec_clear(&phi);
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
