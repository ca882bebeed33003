/* Proofs as programs for another computer algebra system. */
#ifndef STICKSLIP_PROOF_RECEIPT_H
#define STICKSLIP_PROOF_RECEIPT_H

#include "claim/claims.h"
#include "model/model.h"
#include "scene/scene.h"

/* A proof as a Python script that needs SymPy alone, ends with the text of verify/receipt/model.py and prints "ID:
   proved". false with d set when the claim is not proved by exact algebra, neither as printed nor as corrected. */
bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *model_py, struct diag *d);

#endif
