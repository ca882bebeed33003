/* Proofs as programs for another computer algebra system. */
#ifndef STICKSLIP_JUDGE_RECEIPT_H
#define STICKSLIP_JUDGE_RECEIPT_H

#include "claim/claims.h"
#include "model/model.h"
#include "scene/scene.h"

/* Whether the claim is about the printed numbers of the scene's orbit. */
bool receipt_of_orbit(const struct claims *claims, const char *id);
/* A Python script that decides the claim again and ends with the text given.  Of the printed numbers of an orbit it
   needs mpmath alone, ends with verify/receipt/orbit.py, encloses the orbit, or what a period makes of the printed
   start, by intervals, and prints "ID: refuted".  Else it is a proof that needs SymPy alone, ends with
   verify/receipt/model.py and prints "ID: proved"; of a matrix that is proved as corrected alone it says before by how
   much each entry is wrong as printed.  false with d set when the claim is of neither kind or is not proved by exact
   algebra, neither as printed nor as corrected. */
bool audit_receipt(struct text *out, const struct model *m, const struct claims *claims, const struct scene *scene,
                   const char *id, const char *python, struct diag *d);

#endif
