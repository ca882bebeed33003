/* Proofs as programs for another computer algebra system. */
#ifndef STICKSLIP_JUDGE_RECEIPT_H
#define STICKSLIP_JUDGE_RECEIPT_H

#include "claim/claims.h"
#include "model/model.h"
#include "scene/scene.h"

/* The file of the data folder that ends the claim's receipt. */
const char *receipt_file(const struct claims *claims, const char *id);
/* A Python script that decides the claim again and ends with that file, whose text is `python`.  It prints the claim,
   the paper's text, what was read, what it checked and what it leaves open, and last as follows.  At the scene's orbit
   (verify/receipt/orbit.py) it encloses the orbit, or what a period makes of the printed start, by intervals: of
   printed numbers it needs mpmath alone and prints "ID: refuted", or "ID: conditional" of one that is right by its own
   decimals; of inequalities, arguments and the sequence of phases it needs SymPy, of which mpmath is a part, and prints
   "ID: proved".  Else it is a proof that needs SymPy alone and prints "ID: proved": of an argument by positive
   combinations of its premises (argument.py), else of equations, ranks, divisors and the criterion of stability
   (model.py); of a matrix that is proved as corrected alone it says before by how much each entry is wrong as printed.
   false with d set when the claim is of none of these kinds, or, at the orbit, has another verdict or speaks of what
   orbit.py does not know, else is not proved by exact algebra, neither as printed nor as corrected. */
bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *python, struct diag *d);

#endif
