
#include "local_maps.h"
#include "num/calc.h"

/* What the paper keeps of a phase's derivative.  A local Jacobian of the paper is a corner of the 4x4 derivative of an
   event-located map: which perturbations go in, and which components come out, from the paper's own sentences around
   (27), (32), (36) and (40). */

const struct local_map local_maps[N_PHASES] = {
    /* (27): (x, y) -> y_a */
    {"J_a", PHASE_D, 1, 2, {{ENTERS, 0, 0, 0}, {0, ENTERS, 0, 0}}, {Z_2}},
    /* (32): y_a, with x_a = chi y_a from the switching condition, -> (y_b, u_b) */
    {"J_b", PHASE_GAMMA, 2, 1, {{ENTERS_BY_CHI, ENTERS, 0, 0}}, {Z_2, DZ_1}},
    /* (36): (x_b, u_b), with y_b = x_b from the switching condition, -> (x_c, y_c, v_c) */
    {"J_c", PHASE_H, 3, 2, {{ENTERS, ENTERS, 0, 0}, {0, 0, ENTERS, 0}}, {Z_1, Z_2, DZ_2}},
    /* (40): (x_c, y_c, v_c), with u_c = 0, -> (x_f, y_f) */
    {"J_f", PHASE_C, 2, 3, {{ENTERS, 0, 0, 0}, {0, ENTERS, 0, 0}, {0, 0, 0, ENTERS}}, {Z_1, Z_2}},
};

int local_map_corner(struct num_vec *out, const struct local_map *m, const struct num_vec *local, const void *chi) {
  OWNED(calc) c = calc_begin(out->ctx);
  for (int r = 0; r < m->rows; r++)
    for (int k = 0; k < m->cols; k++) {
      val sum = calc_d(&c, 0);
      for (int i = 0; i < N_STATE; i++) {
        if (m->in[k][i] == STAYS_OUT) continue;
        val slope = num_vec_at(local, N_STATE * m->keep[r] + i);
        sum = calc_add(&c, sum, m->in[k][i] == ENTERS_BY_CHI ? calc_mul(&c, slope, chi) : slope);
      }
      calc_store(&c, num_vec_at(out, r * m->cols + k), sum);
    }
  return c.status;
}

void local_map_directions(double dir[LOCAL_MOST][N_STATE], const struct local_map *m, double chi) {
  for (int k = 0; k < m->cols; k++)
    for (int i = 0; i < N_STATE; i++) dir[k][i] = m->in[k][i] == STAYS_OUT ? 0 : m->in[k][i] == ENTERS_BY_CHI ? chi : 1;
}
