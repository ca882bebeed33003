/* The model's own quantities under the names that the paper gives its formulas. */
#include "oracle.h"
#include "local_maps.h"

#include <string.h>

struct oracle {
  const char *name;
  int rows, cols;
  int (*eval)(struct num_vec *out, struct values *v);
  const char *what; /* with %s where the name of the phase stands; NULL: a second way to a quantity above */
  enum phase phase; /* N_PHASES where it has none */
};

/* --- Local Jacobians --- */

static int ensure_local(struct values *v, enum phase ph) {
  if (v->have_local[ph]) return SS_OK;
  struct num_vec in, local = {v->ctx, 16, num_vec_at(&v->local, 16 * (slong)ph)};
  const void *t = num_vec_at(&v->arc.t, ph);
  num_vec_init(&in, N_STATE, v->ctx);
  for (int i = 0; i < N_STATE; i++) v->ctx.type->set(num_vec_at(&in, i), num_vec_at(&v->arc.z, 4 * (slong)ph + i));
  int s = v->variant == VARIANT_FD ? dyn_local_jacobian_fd(&local, NULL, ph, &v->params, &in, v->ctx.type->get_d(t))
                                   : dyn_local_jacobian(&local, ph, &v->params, &in, t);
  num_vec_clear(&in);
  v->have_local[ph] = s == SS_OK;
  return s;
}

static int local_of(struct num_vec *out, struct values *v, enum phase ph) {
  int s = ensure_local(v, ph);
  struct num_vec local = {v->ctx, 16, num_vec_at(&v->local, 16 * (slong)ph)};
  return s ? s : local_map_corner(out, &local_maps[ph], &local, num_vec_at(&v->params, P_CHI));
}
static int eval_ja(struct num_vec *out, struct values *v) {
  return local_of(out, v, PHASE_D);
}
static int eval_jb(struct num_vec *out, struct values *v) {
  return local_of(out, v, PHASE_GAMMA);
}
static int eval_jc(struct num_vec *out, struct values *v) {
  return local_of(out, v, PHASE_H);
}
static int eval_jf(struct num_vec *out, struct values *v) {
  return local_of(out, v, PHASE_C);
}

/* (41): (x, y) -> (x_f, y_f), the whole map and not the product of the four. */
static int eval_j(struct num_vec *out, struct values *v) {
  if (v->variant == VARIANT_SALTATION) return dyn_return_jacobian_saltation(out, &v->params, &v->arc);
  if (v->variant != VARIANT_FD) return dyn_return_jacobian(out, &v->params, &v->arc);
  double guess[4];
  for (int i = 0; i < 4; i++) guess[i] = v->ctx.type->get_d(num_vec_at(&v->arc.t, i));
  return dyn_return_jacobian_fd(out, NULL, &v->params, num_vec_at(&v->arc.z, Z_1), num_vec_at(&v->arc.z, Z_2), guess);
}

/* --- Matrices of the motion --- */

static int propagator(struct num_vec *out, struct values *v, enum phase ph) {
  return dyn_propagator(out, ph, &v->params, num_vec_at(&v->q, Q_T));
}
static int eval_d(struct num_vec *out, struct values *v) {
  return propagator(out, v, PHASE_D);
}
static int eval_gamma(struct num_vec *out, struct values *v) {
  return propagator(out, v, PHASE_GAMMA);
}
static int eval_h(struct num_vec *out, struct values *v) {
  return propagator(out, v, PHASE_H);
}
static int eval_c(struct num_vec *out, struct values *v) {
  return propagator(out, v, PHASE_C);
}

/* (44): exp(A_C t_d) exp(A_H t_c) exp(A_Gamma t_b) exp(A_D t_a). */
static int eval_n(struct num_vec *out, struct values *v) {
  struct num_vec p;
  num_vec_init(&p, 16, v->ctx);
  int s = values_propagator(out, v, PHASE_D);
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    s |= values_propagator(&p, v, (enum phase)ph);
    s |= num_mat_mul(out, &p, out, 4, 4, 4);
  }
  num_vec_clear(&p);
  return s;
}

/* The stiffness matrix of z'' + K z = 0: minus the lower left block of the first-order system. */
static int stiffness(struct num_vec *out, struct values *v, enum phase ph) {
  struct num_vec a;
  num_vec_init(&a, 16, v->ctx);
  int s = dyn_system(&a, ph, &v->params);
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++)
      s |= v->ctx.type->neg(num_vec_at(out, 2 * i + j), num_vec_at(&a, 4 * (2 + i) + j), v->ctx.prec);
  num_vec_clear(&a);
  return s;
}
static int eval_k(struct num_vec *out, struct values *v) {
  return stiffness(out, v, PHASE_H);
}
static int eval_k1(struct num_vec *out, struct values *v) {
  return stiffness(out, v, PHASE_GAMMA);
}
static int eval_k2(struct num_vec *out, struct values *v) {
  return stiffness(out, v, PHASE_C);
}

/* --- The same matrices from Newton's law for the two blocks and their springs --- */

/* Springs and masses with the scene's chi and eta: k_2 = chi, k_1 = 1 - chi (so k_1 + k_2 = 1), m_1 = eta, m_2 = 1.
   The springs' forces on the blocks are the derivatives of the energy k_1 x_1^2/2 + k_2 (x_2 - x_1)^2/2; accelerations
   in the paper's time are them over the masses, divided by omega_3^2 = (k_1 + k_2)/m_1. */
static int newton(struct num_vec *out, struct values *v, bool slips1, bool slips2) {
  const struct num_type *t = v->ctx.type;
  slong p = v->ctx.prec;
  const void *chi = num_vec_at(&v->params, P_CHI), *eta = num_vec_at(&v->params, P_ETA);
  struct num_vec w;
  num_vec_init(&w, 6, v->ctx); /* k1, k2, m1, m2, omega_3^2, scratch */
  void *k1 = num_vec_at(&w, 0), *k2 = num_vec_at(&w, 1), *m1 = num_vec_at(&w, 2), *m2 = num_vec_at(&w, 3);
  void *o2 = num_vec_at(&w, 4), *x = num_vec_at(&w, 5);
  int s = t->set_d(x, 1, p);
  s |= t->sub(k1, x, chi, p);
  t->set(k2, chi);
  t->set(m1, eta);
  t->set(m2, x);
  s |= t->add(o2, k1, k2, p);
  s |= t->div(o2, o2, m1, p);
  for (int i = 0; i < 4; i++) s |= t->set_d(num_vec_at(out, i), 0, p);
  if (slips1) {
    s |= t->add(x, k1, k2, p);
    s |= t->div(x, x, m1, p);
    s |= t->div(num_vec_at(out, 0), x, o2, p);
    s |= t->neg(x, k2, p);
    s |= t->div(x, x, m1, p);
    s |= t->div(num_vec_at(out, 1), x, o2, p);
  }
  if (slips2) {
    s |= t->div(x, k2, m2, p);
    s |= t->div(num_vec_at(out, 3), x, o2, p);
    s |= t->neg(num_vec_at(out, 2), num_vec_at(out, 3), p);
  }
  num_vec_clear(&w);
  return s;
}
static int eval_k_newton(struct num_vec *out, struct values *v) {
  return newton(out, v, true, true);
}
static int eval_k1_newton(struct num_vec *out, struct values *v) {
  return newton(out, v, true, false);
}
static int eval_k2_newton(struct num_vec *out, struct values *v) {
  return newton(out, v, false, true);
}

/* Where both blocks rest under the sliding forces u_s1, u_s2 (per k_1 + k_2): the minimum of the springs' energy less
   the forces' work; K d = (u_s1, eta u_s2) solved with the stiffness of the model. */
static int equilibrium(struct num_vec *out, struct values *v) {
  struct num_vec k, f;
  num_vec_init(&k, 4, v->ctx);
  num_vec_init(&f, 2, v->ctx);
  int s = stiffness(&k, v, PHASE_H);
  v->ctx.type->set(num_vec_at(&f, 0), num_vec_at(&v->q, Q_US1));
  s |= v->ctx.type->mul(num_vec_at(&f, 1), num_vec_at(&v->q, Q_US2), num_vec_at(&v->params, P_ETA), v->ctx.prec);
  s |= num_mat_solve(out, &k, &f, 2, 1);
  num_vec_clear(&f);
  num_vec_clear(&k);
  return s;
}
static int one_of(struct num_vec *out, struct values *v, int (*pair)(struct num_vec *, struct values *), int i) {
  struct num_vec both;
  num_vec_init(&both, 2, v->ctx);
  int s = pair(&both, v);
  v->ctx.type->set(num_vec_at(out, 0), num_vec_at(&both, i));
  num_vec_clear(&both);
  return s;
}
static int eval_d01(struct num_vec *out, struct values *v) {
  return one_of(out, v, equilibrium, 0);
}
static int eval_d02(struct num_vec *out, struct values *v) {
  return one_of(out, v, equilibrium, 1);
}

/* The frequencies: mu^2 - (trace) mu + det = 0 for the model's stiffness, omega = sqrt(mu). */
static int frequencies(struct num_vec *out, struct values *v) {
  const struct num_type *t = v->ctx.type;
  slong p = v->ctx.prec;
  struct num_vec k, c;
  num_vec_init(&k, 4, v->ctx);
  num_vec_init(&c, 3, v->ctx);
  int s = stiffness(&k, v, PHASE_H);
  s |= num_mat_det(num_vec_at(&c, 0), &k, 2);
  s |= t->add(num_vec_at(&c, 1), num_vec_at(&k, 0), num_vec_at(&k, 3), p);
  s |= t->neg(num_vec_at(&c, 1), num_vec_at(&c, 1), p);
  s |= t->set_d(num_vec_at(&c, 2), 1, p);
  for (int i = 0; i < 2; i++) {
    s |= num_poly_root(num_vec_at(out, i), &c, i + 1);
    s |= t->sqrt(num_vec_at(out, i), num_vec_at(out, i), p);
  }
  num_vec_clear(&c);
  num_vec_clear(&k);
  return s;
}
static int eval_omega1(struct num_vec *out, struct values *v) {
  return one_of(out, v, frequencies, 0);
}
static int eval_omega2(struct num_vec *out, struct values *v) {
  return one_of(out, v, frequencies, 1);
}

/* --- What perturbations consist of --- */

static int components(struct num_vec *out, struct values *v, const char *const name[N_STATE]) {
  int s = SS_OK;
  bool known;
  for (int i = 0; i < N_STATE; i++) s |= values_bind(num_vec_at(out, i), &known, v, name[i]);
  return s;
}
/* The states in which phases meet. */
static int eval_sa(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"z_1a", "z_2a", "z'_1a", "z'_2a"};
  return components(out, v, name);
}
static int eval_sb(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"z_1b", "z_2b", "z'_1b", "z'_2b"};
  return components(out, v, name);
}
static int eval_sc(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"z_1c", "z_2c", "z'_1c", "z'_2c"};
  return components(out, v, name);
}
static int eval_dz0(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"x", "y", "u", "v"};
  return components(out, v, name);
}
static int eval_dza(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"x_a", "y_a", "u_a", "v_a"};
  return components(out, v, name);
}
static int eval_dzb(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"x_b", "y_b", "u_b", "v_b"};
  return components(out, v, name);
}
static int eval_dzc(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"x_c", "y_c", "u_c", "v_c"};
  return components(out, v, name);
}
static int eval_dzf(struct num_vec *out, struct values *v) {
  static const char *const name[] = {"x_f", "y_f", "u_f", "v_f"};
  return components(out, v, name);
}

static const struct oracle oracles[] = {
    {"dZ_0", 4, 1, eval_dz0, "the perturbation of the state at the start of the period", N_PHASES},
    {"dZ_a", 4, 1, eval_dza, "the perturbation of the state at the end of %s", PHASE_D},
    {"dZ_b", 4, 1, eval_dzb, "the perturbation of the state at the end of %s", PHASE_GAMMA},
    {"dZ_c", 4, 1, eval_dzc, "the perturbation of the state at the end of %s", PHASE_H},
    {"dZ_f", 4, 1, eval_dzf, "the perturbation of the state at the end of %s", PHASE_C},
    {"S_a", 4, 1, eval_sa, "the state at the end of %s", PHASE_D},
    {"S_b", 4, 1, eval_sb, "the state at the end of %s", PHASE_GAMMA},
    {"S_c", 4, 1, eval_sc, "the state at the end of %s", PHASE_H},
    {"J_a", 1, 2, eval_ja, "the Jacobian of %s", PHASE_D},
    {"J_b", 2, 1, eval_jb, "the Jacobian of %s", PHASE_GAMMA},
    {"J_c", 3, 2, eval_jc, "the Jacobian of %s", PHASE_H},
    {"J_f", 2, 3, eval_jf, "the Jacobian of %s", PHASE_C},
    {"J", 2, 2, eval_j, "the Jacobian of the return map", N_PHASES},
    {"N", 4, 4, eval_n, "the propagator of one period", N_PHASES},
    {"D(t)", 4, 4, eval_d, "the propagator of %s", PHASE_D},
    {"Gamma(t)", 4, 4, eval_gamma, "the propagator of %s", PHASE_GAMMA},
    {"H(t)", 4, 4, eval_h, "the propagator of %s", PHASE_H},
    {"C(t)", 4, 4, eval_c, "the propagator of %s", PHASE_C},
    {"K", 2, 2, eval_k, "the stiffness matrix of %s", PHASE_H},
    {"K_1", 2, 2, eval_k1, "the stiffness matrix of %s", PHASE_GAMMA},
    {"K_2", 2, 2, eval_k2, "the stiffness matrix of %s", PHASE_C},
    {"d_01", 1, 1, eval_d01, "the position of the first mass at rest under the sliding forces", N_PHASES},
    {"d_02", 1, 1, eval_d02, "the position of the second mass at rest under the sliding forces", N_PHASES},
    {"omega_1", 1, 1, eval_omega1, "the lower frequency of %s", PHASE_H},
    {"omega_2", 1, 1, eval_omega2, "the upper frequency of %s", PHASE_H},
    {"K newton", 2, 2, eval_k_newton, NULL, N_PHASES},
    {"K_1 newton", 2, 2, eval_k1_newton, NULL, N_PHASES},
    {"K_2 newton", 2, 2, eval_k2_newton, NULL, N_PHASES},
};

const struct oracle *oracle_find(const char *name) {
  for (size_t i = 0; i < sizeof oracles / sizeof *oracles; i++)
    if (strcmp(oracles[i].name, name) == 0) return &oracles[i];
  return NULL;
}

int oracle_rows(const struct oracle *o) {
  return o->rows;
}
int oracle_cols(const struct oracle *o) {
  return o->cols;
}
int oracle_eval(struct num_vec *out, const struct oracle *o, struct values *v) {
  return o->eval(out, v);
}
const char *oracle_what(enum phase *phase, const struct oracle *o) {
  *phase = o->phase;
  return o->what;
}
