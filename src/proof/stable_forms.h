/* The stable layer (model.h): forms of verify/stable.eq, each proved equal to the corrected form it replaces.

   A proof is one in exact algebra, entry by entry: both forms are elements of one field (exact.h) over the free
   symbols, with chi and eta by the frequencies of the global slip phase,

     omega^2 = omega_1^2 + omega_2^2 - 1,   chi omega^2 = (1 - omega_1^2)(omega_2^2 - 1),   eta chi = omega^2,

   where 0 < omega_1 < 1 < omega_2 exist for all 0 < chi < 1 and eta > 0.  Positive elements whose squares occur under
   roots are known: omega, sqrt(chi), sqrt(eta), sqrt(1 - chi), omega_2 + omega_1 and omega_2 - omega_1; each is the
   root only of what is shown to be its square.  Sines and cosines are made of those of half the angles of the phases.
   Equal elements are equal values wherever both forms have one; at a few points (near 1, and over orders of magnitude
   and signs) it is tried that the stable form has one where the corrected form has, and that entries meet at all.
   `stability --after stable` tries it at the extreme points of its regions, in balls (stability/agree.c).

   What is held as an unknown in a proof is known by its name alone: only names of one meaning in all sections.  A
   function is held at t, and refused where it depends on t besides its argument.  Shapes are compared, not only
   entries. */
#ifndef STICKSLIP_PROOF_STABLE_FORMS_H
#define STICKSLIP_PROOF_STABLE_FORMS_H

#include "model/model.h"

/* What a form replaces: "H_1(t)" of a section, or a record's id. */
struct stable_proof {
  const char *name, *section;
  const struct statement_record *record; /* of stable.eq */
  const struct stmt *stmt;               /* the definition; NULL: the whole record */
  const char *equals;                    /* what a part is in the corrected layer; NULL: what has its own name there */
  int entries;
  const char *why_not; /* NULL: proved */
  bool held;           /* with quantities as unknowns that are proved apart */
  slong largest;       /* terms of the largest polynomial */
};

struct stable_proofs {
  struct arena arena;
  struct stable_proof *item;
  size_t n, cap;
};

/* One proof for each definition and record of the stable layer that has a corrected counterpart, in the order of the
   file; the other definitions are parts of these.  false with d set when a formula cannot be read; clear it all the
   same.  algebra_alone: without the points in balls that refuse most of what differs before the algebra is asked. */
bool stable_prove(struct stable_proofs *out, const struct model *m, bool algebra_alone, struct diag *d);
/* The forms of an equation number, or of a record that has none, one to a line with what came of its proof; nothing
   where the layer has none. */
void stable_explain(struct text *out, const struct model *m, const char *equation, const char *record);
void stable_proofs_clear(struct stable_proofs *p);

#endif
