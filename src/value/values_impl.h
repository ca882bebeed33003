/* What is made of a point's values when a symbol first asks for it; the values themselves are in values.h. */
#ifndef STICKSLIP_VALUES_IMPL_H
#define STICKSLIP_VALUES_IMPL_H

#include "oracle.h"

/* One of the model's matrices, made once. */
struct oracle_matrix {
  const struct oracle *of;
  struct num_vec entry;
  int status;
};

/* The time t on an arc, and the state and its rate there: v->t, v->zt and v->azt. */
int values_time(struct values *v);
/* The perturbations of an arc: v->tangent and v->dt. */
int values_tangents(struct values *v);

#endif
