/* Controls made by the program, one for each formula without one on file. */
#ifndef STICKSLIP_NEAR_H
#define STICKSLIP_NEAR_H

#include "claims.h"
#include "model/model.h"

/* What a trial in balls notices, relative to the sides. */
#define NEAR_DELTA "1e-30"

/* Lays the damaged formulas over the model, each seen by its own control alone, and adds those controls, "near-" and
   the claim's id, to the list. */
bool near_controls_add(struct model *m, const struct claims *claims, struct claims *controls, struct diag *d);
/* Whether it is one of these. */
bool near_made(const struct claim *control);
/* Whether each formula that a claim is about is damaged by some control, one of these or one on file; false with d set
   at a claim of which none is. */
bool formulas_have_controls(const struct model *m, const struct claims *claims, const struct claims *controls,
                            struct diag *d);

#endif
