/* The model's quantities under the paper's names. */
#ifndef STICKSLIP_ORACLE_H
#define STICKSLIP_ORACLE_H

#include "values.h"

struct oracle {
  const char *name;
  int rows, cols;
  int (*eval)(struct num_vec *out, struct values *v, int which);
  int which;        /* of the quantities that eval makes: a phase, a number */
  const char *what; /* in words, with %s where the name of the phase stands; NULL: a second way to another quantity */
  enum phase phase; /* N_PHASES where it has none */
};
/* The oracle of a name such as J_a, H(t), N, K_1; NULL when the model has no such quantity. */
const struct oracle *oracle_find(const char *name);
int oracle_eval(struct num_vec *out, const struct oracle *o, struct values *v);
/* The matrix of that name held as unknowns, in the shape that the model's has; false when the model has none. */
bool oracle_override(struct override *out, const char *name);
#endif
