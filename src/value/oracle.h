/* The model's quantities under the paper's names. */
#ifndef STICKSLIP_ORACLE_H
#define STICKSLIP_ORACLE_H

#include "values.h"

struct oracle;
/* The oracle of a name such as J_a, H(t), N, K_1; NULL when the model has no such quantity. */
const struct oracle *oracle_find(const char *name);
int oracle_rows(const struct oracle *o);
int oracle_cols(const struct oracle *o);
int oracle_eval(struct num_vec *out, const struct oracle *o, struct values *v);
/* The matrix of that name held as unknowns, in the shape that the model's has; false when the model has none. */
bool oracle_override(struct override *out, const char *name);
/* What the quantity is, in words: "the Jacobian of %s", with the phase that is meant; *phase is N_PHASES where the words
   have no %s.  NULL: the name is that of a second way to another quantity. */
const char *oracle_what(enum phase *phase, const struct oracle *o);

#endif
