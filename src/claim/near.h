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
/* Whether some control damages what the claim is about; true of a claim that is about no formula. */
bool formula_has_control(const struct claim *c, const struct claims *claims, const struct claims *controls);

#endif
