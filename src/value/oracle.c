/* The model's own quantities under the names that the paper gives its formulas. */
#include "oracle.h"
#include "local_maps.h"
#include "num/calc.h"

#include <string.h>

/* --- Local Jacobians --- */

static int ensure_local(struct values *v, enum phase ph) {
  if (v->have_local[ph]) return SS_OK;
  struct num_vec in = dyn_arc_state(&v->arc, ph), local = {v->ctx, 16, num_vec_at(&v->local, 16 * (slong)ph)};
  const void *t = num_vec_at(&v->arc.t, ph);
  int s = v->variant == VARIANT_FD ? dyn_local_jacobian_fd(&local, NULL, ph, &v->params, &in, v->ctx.type->get_d(t))
                                   : dyn_local_jacobian(&local, ph, &v->params, &in, t);
  v->have_local[ph] = s == SS_OK;
  return s;
}

static int eval_local(struct num_vec *out, struct values *v, int ph) {
  int s = ensure_local(v, (enum phase)ph);
  struct num_vec local = {v->ctx, 16, num_vec_at(&v->local, 16 * (slong)ph)};
  return s ? s : local_map_corner(out, &local_maps[ph], &local, num_vec_at(&v->params, P_CHI));
}

/* (41): (x, y) -> (x_f, y_f), the whole map and not the product of the four. */
static int eval_j(struct num_vec *out, struct values *v, int which) {
  (void)which;
  if (v->variant == VARIANT_SYSTEM) {
    num_vec_set(out, &v->return_jacobian);
    return SS_OK;
  }
  if (v->variant == VARIANT_SALTATION) return dyn_return_jacobian_saltation(out, &v->params, &v->arc);
  if (v->variant != VARIANT_FD) return dyn_return_jacobian(out, &v->params, &v->arc);
  double guess[4];
  for (int i = 0; i < 4; i++) guess[i] = v->ctx.type->get_d(num_vec_at(&v->arc.t, i));
  return dyn_return_jacobian_fd(out, NULL, &v->params, num_vec_at(&v->arc.z, Z_1), num_vec_at(&v->arc.z, Z_2), guess);
}

/* --- Matrices of the motion --- */

static int eval_propagator(struct num_vec *out, struct values *v, int ph) {
  return dyn_propagator(out, (enum phase)ph, &v->params, values_exact(v, Q_T));
}

/* (44): exp(A_C t_d) exp(A_H t_c) exp(A_Gamma t_b) exp(A_D t_a). */
static int eval_n(struct num_vec *out, struct values *v, int which) {
  (void)which;
  OWNED(num_vec) p;
  num_vec_init(&p, 16, v->ctx);
  int s = values_propagator(out, v, PHASE_D);
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    s |= values_propagator(&p, v, (enum phase)ph);
    s |= num_mat_mul(out, &p, out, 4, 4, 4);
  }
  return s;
}

/* The stiffness matrix of z'' + K z = 0: minus the lower left block of the first-order system. */
static int eval_stiffness(struct num_vec *out, struct values *v, int ph) {
  OWNED(num_vec) a;
  num_vec_init(&a, 16, v->ctx);
  int s = dyn_system(&a, (enum phase)ph, &v->params);
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      s |= v->ctx.type->neg(num_vec_at(out, 2 * i + j), num_vec_at(&a, 4 * (2 + i) + j), v->ctx.prec);
  return s;
}

/* --- The same matrices from Newton's law for the two blocks and their springs --- */

/* Springs and masses with the scene's chi and eta: k_2 = chi, k_1 = 1 - chi (so k_1 + k_2 = 1), m_1 = eta, m_2 = 1.
   The springs' forces on the blocks are the derivatives of the energy k_1 x_1^2/2 + k_2 (x_2 - x_1)^2/2; accelerations
   in the paper's time are them over the masses, divided by omega_3^2 = (k_1 + k_2)/m_1. */
static int eval_newton(struct num_vec *out, struct values *v, int ph) {
  OWNED(calc) c = calc_begin(v->ctx);
  val zero = calc_d(&c, 0), m1 = num_vec_at(&v->params, P_ETA), m2 = calc_d(&c, 1);
  val k2 = num_vec_at(&v->params, P_CHI), k1 = calc_sub(&c, m2, k2), both = calc_add(&c, k1, k2);
  val square = calc_div(&c, both, m1), entry[4] = {zero, zero, zero, zero};
  if (ph != PHASE_C) { /* m_1 slips */
    entry[0] = calc_div(&c, calc_div(&c, both, m1), square);
    entry[1] = calc_div(&c, calc_div(&c, calc_neg(&c, k2), m1), square);
  }
  if (ph != PHASE_GAMMA) {
    entry[3] = calc_div(&c, calc_div(&c, k2, m2), square);
    entry[2] = calc_neg(&c, entry[3]);
  }
  for (int i = 0; i < 4; i++) calc_store(&c, num_vec_at(out, i), entry[i]);
  return c.status;
}

/* Where both blocks rest under the sliding forces u_s1, u_s2 (per k_1 + k_2): the minimum of the springs' energy less
   the forces' work; K d = (u_s1, eta u_s2) solved with the stiffness of the model. */
static int eval_equilibrium(struct num_vec *out, struct values *v, int mass) {
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec k = calc_vec(&c, 4), d = calc_vec(&c, 2);
  int s = eval_stiffness(&k, v, PHASE_H);
  calc_store(&c, num_vec_at(&d, 0), values_exact(v, Q_US1));
  calc_store(&c, num_vec_at(&d, 1), calc_mul(&c, values_exact(v, Q_US2), num_vec_at(&v->params, P_ETA)));
  s |= c.status | num_mat_solve(&d, &k, &d, 2, 1);
  calc_store(&c, num_vec_at(out, 0), num_vec_at(&d, mass));
  return s;
}

/* The frequencies: mu^2 - (trace) mu + det = 0 for the model's stiffness, omega = sqrt(mu). */
static int eval_frequency(struct num_vec *out, struct values *v, int i) {
  OWNED(calc) c = calc_begin(v->ctx);
  struct num_vec k = calc_vec(&c, 4), of_mu = calc_vec(&c, 3);
  void *mu = calc_new(&c);
  int s = eval_stiffness(&k, v, PHASE_H) | num_mat_det(num_vec_at(&of_mu, 0), &k, 2);
  val trace = calc_add(&c, num_vec_at(&k, 0), num_vec_at(&k, 3));
  calc_store(&c, num_vec_at(&of_mu, 1), calc_neg(&c, trace));
  calc_store(&c, num_vec_at(&of_mu, 2), calc_d(&c, 1));
  s |= num_poly_root(mu, &of_mu, i);
  calc_store(&c, num_vec_at(out, 0), calc_sqrt(&c, mu));
  return s | c.status;
}

/* --- What perturbations consist of --- */

static int components(struct num_vec *out, struct values *v, const char *const name[N_STATE]) {
  int s = SS_OK;
  bool known;
  for (int i = 0; i < N_STATE; i++) s |= values_bind(num_vec_at(out, i), &known, v, name[i]);
  return s;
}
/* The states in which phases meet. */
static int eval_state(struct num_vec *out, struct values *v, int k) {
  return components(out, v, name_state[k]);
}
static int eval_tangent(struct num_vec *out, struct values *v, int k) {
  return components(out, v, name_tangent[k]);
}

static const struct oracle oracles[] = {
    {"dZ_0", 4, 1, eval_tangent, 0, "the perturbation of the state at the start of the period", N_PHASES},
    {"dZ_a", 4, 1, eval_tangent, 1, "the perturbation of the state at the end of %s", PHASE_D},
    {"dZ_b", 4, 1, eval_tangent, 2, "the perturbation of the state at the end of %s", PHASE_GAMMA},
    {"dZ_c", 4, 1, eval_tangent, 3, "the perturbation of the state at the end of %s", PHASE_H},
    {"dZ_f", 4, 1, eval_tangent, 4, "the perturbation of the state at the end of %s", PHASE_C},
    {"S_a", 4, 1, eval_state, 1, "the state at the end of %s", PHASE_D},
    {"S_b", 4, 1, eval_state, 2, "the state at the end of %s", PHASE_GAMMA},
    {"S_c", 4, 1, eval_state, 3, "the state at the end of %s", PHASE_H},
    {"J_a", 1, 2, eval_local, PHASE_D, "the Jacobian of %s", PHASE_D},
    {"J_b", 2, 1, eval_local, PHASE_GAMMA, "the Jacobian of %s", PHASE_GAMMA},
    {"J_c", 3, 2, eval_local, PHASE_H, "the Jacobian of %s", PHASE_H},
    {"J_f", 2, 3, eval_local, PHASE_C, "the Jacobian of %s", PHASE_C},
    {"J", 2, 2, eval_j, 0, "the Jacobian of the return map", N_PHASES},
    {"N", 4, 4, eval_n, 0, "the propagator of one period", N_PHASES},
    {"D(t)", 4, 4, eval_propagator, PHASE_D, "the propagator of %s", PHASE_D},
    {"Gamma(t)", 4, 4, eval_propagator, PHASE_GAMMA, "the propagator of %s", PHASE_GAMMA},
    {"H(t)", 4, 4, eval_propagator, PHASE_H, "the propagator of %s", PHASE_H},
    {"C(t)", 4, 4, eval_propagator, PHASE_C, "the propagator of %s", PHASE_C},
    {"K", 2, 2, eval_stiffness, PHASE_H, "the stiffness matrix of %s", PHASE_H},
    {"K_1", 2, 2, eval_stiffness, PHASE_GAMMA, "the stiffness matrix of %s", PHASE_GAMMA},
    {"K_2", 2, 2, eval_stiffness, PHASE_C, "the stiffness matrix of %s", PHASE_C},
    {"d_01", 1, 1, eval_equilibrium, 0, "the position of the first mass at rest under the sliding forces", N_PHASES},
    {"d_02", 1, 1, eval_equilibrium, 1, "the position of the second mass at rest under the sliding forces", N_PHASES},
    {"omega_1", 1, 1, eval_frequency, 1, "the lower frequency of %s", PHASE_H},
    {"omega_2", 1, 1, eval_frequency, 2, "the upper frequency of %s", PHASE_H},
    {"K newton", 2, 2, eval_newton, PHASE_H, NULL, N_PHASES},
    {"K_1 newton", 2, 2, eval_newton, PHASE_GAMMA, NULL, N_PHASES},
    {"K_2 newton", 2, 2, eval_newton, PHASE_C, NULL, N_PHASES},
};

const struct oracle *oracle_find(const char *name) {
  for (size_t i = 0; i < sizeof oracles / sizeof *oracles; i++)
    if (strcmp(oracles[i].name, name) == 0) return &oracles[i];
  return NULL;
}

int oracle_eval(struct num_vec *out, const struct oracle *o, struct values *v) {
  return o->eval(out, v, o->which);
}

bool oracle_override(struct override *out, const char *name) {
  const struct oracle *o = oracle_find(name);
  if (o) *out = (struct override){name, o->rows, o->cols};
  return o != NULL;
}
