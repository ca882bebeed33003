/* The perturbations x_a ... v_f and dt_a ... dt_d of an arc.  Of the first order they are the direction (x, y) carried
   along the word by the local Jacobians; finite ones are the differences between two motions; at patched points they
   are any numbers. */
#include "local_maps.h"
#include "num/calc.h"
#include "values_impl.h"

/* dt of a phase from dZ at its start: the switching function stays zero at the end, so its gradient applied to
   exp(A t) dZ is minus its rate times dt. */
static int event_shift(void *dt, struct values *v, int ph, const struct num_vec *dz) {
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec phi = calc_vec(&c, 16), end = calc_vec(&c, 4);
  const struct num_vec there = dyn_arc_state(&v->arc, ph + 1);
  void *lead = calc_new(&c), *rate = calc_new(&c);
  int s = values_propagator(&phi, v, (enum phase)ph);
  s |= num_mat_mul(&end, &phi, dz, 4, 4, 1);
  s |= dyn_switching_along(lead, (enum phase)ph, &v->params, &end);
  s |= dyn_switching_rate(rate, (enum phase)ph, &v->params, &there);
  calc_store(&c, dt, calc_neg(&c, calc_div(&c, lead, rate)));
  return s | c.status;
}

/* The direction (x, y) carried along the word by the local Jacobians. */
static int carry_tangent(struct values *v) {
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec dz = calc_vec(&c, 4), unused = calc_vec(&c, N_STATE * LOCAL_MOST);
  v->ctx.type->set(num_vec_at(&dz, 0), num_vec_at(&v->q, Q_X));
  v->ctx.type->set(num_vec_at(&dz, 1), num_vec_at(&v->q, Q_Y));
  int s = SS_OK;
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++)
    s = oracle_eval(&unused, oracle_find(local_maps[ph].name), v); /* makes the local Jacobian */
  for (int ph = 0; s == SS_OK && ph < N_PHASES; ph++) {
    s |= event_shift(num_vec_at(&v->dt, ph), v, ph, &dz);
    const struct num_vec j = {v->ctx, 16, num_vec_at(&v->local, 16 * ph)};
    s |= num_mat_mul(&dz, &j, &dz, 4, 4, 1);
    for (int i = 0; i < 4; i++) v->ctx.type->set(num_vec_at(&v->tangent, 4 * (ph + 1) + i), num_vec_at(&dz, i));
  }
  return s;
}

/* Any numbers but x and y, and but for the velocities of masses that stick before and after. */
static int free_tangents(struct values *v) {
  static const bool zero[20] = {[6] = true, [7] = true, [11] = true, [18] = true};
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  for (int i = 0; i < 20; i++) {
    void *z = num_vec_at(&v->tangent, i);
    s |= t->set_d(z, zero[i] ? 0 : 0.8125 + 0.71875 * i, v->ctx.prec);
    if (!zero[i]) s |= t->mul(z, z, num_vec_at(&v->q, i % 2 ? Q_Y : Q_X), v->ctx.prec);
    if (i < 2) t->set(z, num_vec_at(&v->q, Q_X + i));
  }
  for (int i = 0; i < 4; i++) s |= t->set_d(num_vec_at(&v->dt, i), 0.40625 + 0.34375 * i, v->ctx.prec);
  return s;
}

/* The perturbations x_a ... v_f and dt_a ... dt_d: tangents, or differences between the two motions. */
int values_tangents(struct values *v) {
  if (v->have_tangent) return SS_OK;
  const struct num_type *t = v->ctx.type;
  int s = SS_OK;
  if (v->point->kind == POINT_PATCHED)
    s |= free_tangents(v);
  else if (!v->point->finite)
    s |= carry_tangent(v);
  for (int i = 0; v->point->finite && i < 20; i++)
    s |= t->sub(num_vec_at(&v->tangent, i), num_vec_at(&v->perturbed.z, i), num_vec_at(&v->arc.z, i), v->ctx.prec);
  for (int i = 0; v->point->finite && i < 4; i++)
    s |= t->sub(num_vec_at(&v->dt, i), num_vec_at(&v->perturbed.t, i), num_vec_at(&v->arc.t, i), v->ctx.prec);
  v->have_tangent = s == SS_OK;
  return s;
}
