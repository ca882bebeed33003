/* Certificates: the numbers of a failure under the paper's names, inputs first. */
#include "certificate.h"

#include "value/values.h"

void certify_exact(struct certificate *c, struct judge *j, const char *name, const fmpq *x) {
  certificate_add(c, j->out, name, rational_text(j, x));
}

void certify_ball(struct certificate *c, struct judge *j, const char *name, const arb_t x) {
  certificate_add(c, j->out, name, ball_text(j, x, CERTIFIED_DIGITS));
}

void certify_params(struct certificate *c, struct judge *j, const fmpq *params) {
  for (int k = 0; k < N_PARAMS; k++) certify_exact(c, j, name_param[k], params + k);
}

void certify_member(struct certificate *c, struct judge *j, const fmpq *params, int vary, const fmpq *value,
                    slong prec) {
  arb_t x;
  arb_init(x);
  arb_set_fmpq(x, value, prec);
  for (int k = 0; k < N_PARAMS; k++)
    if (k == vary)
      certify_ball(c, j, name_param[k], x);
    else
      certify_exact(c, j, name_param[k], params + k);
  arb_clear(x);
}

void certify_scene(struct certificate *c, struct judge *j) {
  for (int k = KEY_CHI; k <= KEY_E2; k++)
    if (j->scene->given[k]) certify_exact(c, j, name_param[k], &j->scene->value[k]);
}

void certify_orbit(struct certificate *c, struct judge *j, const struct dyn_orbit *o) {
  certify_ball(c, j, name_state[0][Z_1], o->z10);
  certify_ball(c, j, name_state[0][Z_2], o->z20);
  for (int k = 0; k < N_PHASES; k++) certify_ball(c, j, name_time[k], o->t[k]);
}

/* The start and the four times of the point's pass. */
static void certify_pass(struct certificate *c, struct judge *j, const struct point *p) {
  struct values v;
  if (values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), j->cache) == SS_OK) {
    for (int i = 0; i < 2; i++) certify_ball(c, j, name_state[0][i], num_vec_at(&v.arc.z, i));
    for (int k = 0; k < N_PHASES; k++) certify_ball(c, j, name_time[k], num_vec_at(&v.arc.t, k));
  }
  values_clear(&v);
}

/* The paper's own symbols. */
static void certify_own(struct certificate *c, struct judge *j, const struct point *p) {
  fmpq_t x;
  fmpq_init(x);
  for (size_t i = 0; p->paper && i < p->paper->n_symbols; i++) {
    if (!p->paper->symbols[i].has_domain) continue;
    point_own_value(x, p, &p->paper->symbols[i]);
    certify_exact(c, j, p->paper->symbols[i].name, x);
  }
  fmpq_clear(x);
}

void certify_point(struct certificate *c, struct judge *j, const struct point *p) {
  static const struct {
    const char *name;
    int q;
    unsigned kinds; /* bit for each point_kind */
  } of[] = {{"chi", Q_CHI, 15},  {"eta", Q_ETA, 15},  {"V", Q_V, 15},   {"e_1", Q_E1, 12},  {"e_2", Q_E2, 12},
            {"t", Q_T, 3},       {"z_1", Q_Z1, 2},    {"z_2", Q_Z2, 2}, {"z_1'", Q_DZ1, 2}, {"z_2'", Q_DZ2, 2},
            {"u_s1", Q_US1, 12}, {"u_s2", Q_US2, 12}, {"x", Q_X, 12},   {"y", Q_Y, 12}};
  certify_own(c, j, p);
  for (size_t i = 0; point_of_model(p) && i < sizeof of / sizeof *of; i++)
    if (of[i].kinds >> p->kind & 1U) certify_exact(c, j, of[i].name, &p->q[of[i].q]);
  if (p->kind == POINT_ARC || p->kind == POINT_ORBIT) certify_pass(c, j, p);
}
