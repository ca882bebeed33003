/* Exact proofs that inequalities follow from others.

   Equations among the premises eliminate one unknown each; then the margin of the conclusion must be a sum of at most
   three premises (the domain chi, 1 - chi, eta, V, e_1, e_2, u_s1, u_s2 > 0 among them), each times a factor that is
   positive on the domain.  The sum is looked for in rounded numbers and accepted only as an identity of rational
   functions in the symbols, values of the motion such as z_1(t) being symbols too.  "increasing: h Gamma" in the claim
   adds the mean value theorem: where h'(t) is such a sum, h(t) lies strictly between its values at the ends of the
   phase. */
#ifndef STICKSLIP_PROOF_COMBINATION_H
#define STICKSLIP_PROOF_COMBINATION_H

#include "claim/judging.h"
#include "condition.h"

/* What is to follow from what. */
struct combination {
  struct judge *j;
  const struct claim *c;
  const struct conditions *premises, *conclusion;
  bool admissible;       /* every phase of an admissible orbit takes some time; of others a premise along a phase may
                            say nothing */
  bool sliding_friction; /* u_s1 and u_s2 are positive */
  struct view view;
};

/* Appends the proof of every condition of the conclusion, to out in words and to script (or NULL) as what
   verify/receipt/argument.py proves again; false when one has none (j->d set when the claim is at fault). */
bool certificate_find(struct text *out, struct text *script, const struct combination *q);

#endif
