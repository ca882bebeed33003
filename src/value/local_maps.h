/* What the paper keeps of a phase's derivative. */
#ifndef STICKSLIP_LOCAL_MAPS_H
#define STICKSLIP_LOCAL_MAPS_H

#include "motion/dynamics.h"

enum entering { STAYS_OUT, ENTERS, ENTERS_BY_CHI };
enum { LOCAL_MOST = 3 };
struct local_map {
  const char *name; /* J_a */
  enum phase phase;
  int rows, cols;
  enum entering in[LOCAL_MOST][N_STATE]; /* the perturbation at the start that a column stands for */
  int keep[LOCAL_MOST];                  /* the component at the end that a row stands for */
};
extern const struct local_map local_maps[N_PHASES];
/* The paper's matrix (rows x cols) from the 4x4 derivative. */
int local_map_corner(struct num_vec *out, const struct local_map *m, const struct num_vec *local, const void *chi);
/* The columns' perturbations as directions. */
void local_map_directions(double dir[LOCAL_MOST][N_STATE], const struct local_map *m, double chi);

#endif
