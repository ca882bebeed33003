/* The blocks and springs behind the numbers of (1).  A motion in the paper's units fixes chi, eta and the forces u_i
   alone, so the stiffness of all springs and the mass of the second block are free; here they are 1 + e_1 and 3 + e_2,
   numbers that no symbol of the paper has.  Newton's law for the blocks, m_1 X_1'' + (k_1 + k_2) X_1 - k_2 X_2 = F_1
   and m_2 X_2'' + k_2 (X_2 - X_1) = F_2, must become (1) when time is counted in units of 1/omega_3. */
#include "num/calc.h"
#include "values.h"

#include <string.h>

/* Where a mass slips in a phase, slower than the belt, its friction is u_si; where it sticks, the restoring force. */
static val friction(struct calc *c, struct values *v, int mass) {
  if (phase_slips[v->point->phase][mass]) return values_exact(v, mass ? Q_US2 : Q_US1);
  bool known[2];
  void *x1 = calc_new(c), *x2 = calc_new(c);
  val chi = num_vec_at(&v->params, P_CHI);
  c->status |= values_bind(x1, &known[0], v, "x_1(t)") | values_bind(x2, &known[1], v, "x_2(t)");
  return mass ? calc_mul(c, calc_sub(c, x2, x1), chi) : calc_sub(c, x1, calc_mul(c, x2, chi));
}

/* k_1 + k_2: a small number more than a quantity of the point, and so is m_2. */
static val stiffness(struct calc *c, struct values *v) {
  return calc_add(c, calc_d(c, 1), values_exact(v, Q_E1));
}

/* chi is the part of k_2 in the stiffness of all springs. */
static val spring(struct calc *c, struct values *v, int which) {
  val second = calc_mul(c, stiffness(c, v), num_vec_at(&v->params, P_CHI));
  return which ? second : calc_sub(c, stiffness(c, v), second);
}
static val mass_of(struct calc *c, struct values *v, int mass) {
  val second = calc_add(c, calc_d(c, 3), values_exact(v, Q_E2));
  return mass ? second : calc_mul(c, second, num_vec_at(&v->params, P_ETA));
}
static val force(struct calc *c, struct values *v, int mass) {
  return calc_mul(c, friction(c, v, mass), stiffness(c, v));
}

/* The first block alone on both springs turns once in the unit of time. */
static val square_of_omega_3(struct calc *c, struct values *v, int unused) {
  (void)unused;
  return calc_div(c, stiffness(c, v), mass_of(c, v, 0));
}
/* omega_3, or the time before it was scaled. */
static val time_scale(struct calc *c, struct values *v, int old_time) {
  val omega = calc_sqrt(c, square_of_omega_3(c, v, 0));
  return old_time ? calc_div(c, num_vec_at(&v->t, 0), omega) : omega;
}

static const struct row {
  const char *name;
  val (*value)(struct calc *, struct values *, int which);
  int which;
} table[] = {{"u_1", friction, 0},       {"u_2", friction, 1},      {"F_1", force, 0},   {"F_2", force, 1},
             {"k_1", spring, 0},         {"k_2", spring, 1},        {"m_1", mass_of, 0}, {"m_2", mass_of, 1},
             {"omega_3", time_scale, 0}, {"t_prime", time_scale, 1}};

static int evaluate(void *z, struct values *v, const struct row *r) {
  OWNED(calc) c = calc_begin(v->ctx);
  calc_store(&c, z, r->value(&c, v, r->which));
  return c.status;
}

int springs_square_of_omega_3(void *z, struct values *v) {
  return evaluate(z, v, &(struct row){.value = square_of_omega_3});
}

static const struct row *row_of(const char *name) {
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (strcmp(table[i].name, name) == 0) return &table[i];
  return NULL;
}

bool springs_names(const char *name) {
  return row_of(name) != NULL;
}

bool springs_bind(int *status, void *z, struct values *v, const char *name) {
  const struct row *r = v->point->kind == POINT_FLOW ? row_of(name) : NULL;
  if (r) *status = evaluate(z, v, r);
  return r != NULL;
}
