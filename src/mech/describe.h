/* A system in words and formulas. */
#ifndef STICKSLIP_MECH_DESCRIBE_H
#define STICKSLIP_MECH_DESCRIBE_H

#include "mech.h"

/* Equations of motion, friction, switching functions, and the natural frequencies of what slips on every surface (the
   eigenvalues of the first-order system where there are dampers), to that many significant digits; as plain text or as
   LaTeX. */
void mech_describe(struct text *out, const struct mech *m, bool latex, slong digits);
/* "masses in order: wheel, load", a line, for output that counts them; nothing where they are called m1, m2, ... */
void mech_names_print(struct text *out, const struct mech *m);

#endif
