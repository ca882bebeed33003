/* The blocks and springs behind the numbers of (1).  A motion in the paper's units fixes chi, eta and the forces u_i
   alone, so the stiffness of all springs and the mass of the second block are free; here they are 1 + e_1 and 3 + e_2,
   numbers that no symbol of the paper has.  Newton's law for the blocks, m_1 X_1'' + (k_1 + k_2) X_1 - k_2 X_2 = F_1
   and m_2 X_2'' + k_2 (X_2 - X_1) = F_2, must become (1) when time is counted in units of 1/omega_3. */
#include "values.h"

#include <string.h>

/* Where a mass slips in a phase, slower than the belt, its friction is u_si; where it sticks, the restoring force. */
static int friction(void *z, struct values *v, int mass) {
  static const bool slips[2][N_PHASES] = {{[PHASE_GAMMA] = true, [PHASE_H] = true},
                                          {[PHASE_H] = true, [PHASE_C] = true}};
  const struct num_type *t = v->ctx.type;
  slong p = v->ctx.prec;
  if (slips[mass][v->point->phase]) {
    t->set(z, num_vec_at(&v->q, mass ? Q_US2 : Q_US1));
    return SS_OK;
  }
  struct num_vec x;
  bool known[2];
  num_vec_init(&x, 2, v->ctx);
  void *x1 = num_vec_at(&x, 0), *x2 = num_vec_at(&x, 1);
  const void *chi = num_vec_at(&v->params, P_CHI);
  int s = values_bind(x1, &known[0], v, "x_1(t)") | values_bind(x2, &known[1], v, "x_2(t)");
  if (mass) {
    s |= t->sub(z, x2, x1, p);
    s |= t->mul(z, z, chi, p);
  } else {
    s |= t->mul(x2, x2, chi, p);
    s |= t->sub(z, x1, x2, p);
  }
  num_vec_clear(&x);
  return s;
}

/* k_1 + k_2 or m_2: a small number more than a quantity of the point. */
static int free_choice(void *z, struct values *v, int quantity, double more) {
  int s = v->ctx.type->set_d(z, more, v->ctx.prec);
  return s | v->ctx.type->add(z, z, num_vec_at(&v->q, quantity), v->ctx.prec);
}
static int stiffness(void *z, struct values *v) {
  return free_choice(z, v, Q_E1, 1);
}
static int second_mass(void *z, struct values *v) {
  return free_choice(z, v, Q_E2, 3);
}

/* chi is the part of k_2 in the stiffness of all springs. */
static int second_spring(void *z, struct values *v) {
  int s = stiffness(z, v);
  return s | v->ctx.type->mul(z, z, num_vec_at(&v->params, P_CHI), v->ctx.prec);
}
static int first_spring(void *z, struct values *v) {
  struct num_vec all;
  num_vec_init(&all, 1, v->ctx);
  int s = stiffness(num_vec_at(&all, 0), v) | second_spring(z, v);
  s |= v->ctx.type->sub(z, num_vec_at(&all, 0), z, v->ctx.prec);
  num_vec_clear(&all);
  return s;
}
static int first_mass(void *z, struct values *v) {
  int s = second_mass(z, v);
  return s | v->ctx.type->mul(z, z, num_vec_at(&v->params, P_ETA), v->ctx.prec);
}

/* The first block alone on both springs turns once in the unit of time. */
int springs_square_of_omega_3(void *z, struct values *v) {
  struct num_vec m;
  num_vec_init(&m, 1, v->ctx);
  int s = stiffness(z, v) | first_mass(num_vec_at(&m, 0), v);
  s |= v->ctx.type->div(z, z, num_vec_at(&m, 0), v->ctx.prec);
  num_vec_clear(&m);
  return s;
}
static int time_scale(void *z, struct values *v) {
  return springs_square_of_omega_3(z, v) | v->ctx.type->sqrt(z, z, v->ctx.prec);
}
static int old_time(void *z, struct values *v) {
  struct num_vec w;
  num_vec_init(&w, 1, v->ctx);
  int s = time_scale(num_vec_at(&w, 0), v);
  s |= v->ctx.type->div(z, num_vec_at(&v->t, 0), num_vec_at(&w, 0), v->ctx.prec);
  num_vec_clear(&w);
  return s;
}

static int force(void *z, struct values *v, int mass) {
  struct num_vec k;
  num_vec_init(&k, 1, v->ctx);
  int s = friction(z, v, mass) | stiffness(num_vec_at(&k, 0), v);
  s |= v->ctx.type->mul(z, z, num_vec_at(&k, 0), v->ctx.prec);
  num_vec_clear(&k);
  return s;
}
static int first_force(void *z, struct values *v) {
  return force(z, v, 0);
}
static int second_force(void *z, struct values *v) {
  return force(z, v, 1);
}
static int first_friction(void *z, struct values *v) {
  return friction(z, v, 0);
}
static int second_friction(void *z, struct values *v) {
  return friction(z, v, 1);
}

bool springs_bind(int *status, void *z, struct values *v, const char *name) {
  static const struct {
    const char *name;
    int (*value)(void *, struct values *);
  } table[] = {{"u_1", first_friction}, {"u_2", second_friction}, {"F_1", first_force}, {"F_2", second_force},
               {"k_1", first_spring},   {"k_2", second_spring},   {"m_1", first_mass},  {"m_2", second_mass},
               {"omega_3", time_scale}, {"t_prime", old_time}};
  for (size_t i = 0; v->point->kind == POINT_FLOW && i < sizeof table / sizeof *table; i++)
    if (strcmp(table[i].name, name) == 0) {
      *status = table[i].value(z, v);
      return true;
    }
  return false;
}
