/* The theorem of linearized stability, and its hypotheses one by one.

   A fixed point of a C^1 map attracts where every eigenvalue of its derivative lies inside the unit circle, and repels
   where one lies outside.  For it to speak of an admissible periodic solution at which J has a value,

     - each phase must end where its switching function passes zero at a rate other than zero, so that its time is an
       analytic function of the state: each rate is what J divides by, but for factors that are never zero;
     - no other condition of a phase may be met with equality, so that neighbours have the same phases;
     - J must be the derivative of the return map;
     - its eigenvalues must be 0 and tr J, and the criterion's inequalities say |tr J| < 1; of |tr J| = 1
       the theorem says nothing.

   All of it is done in exact algebra on motions of motion/. */
#ifndef STICKSLIP_PROOF_LINEARIZED_H
#define STICKSLIP_PROOF_LINEARIZED_H

#include "exact_proof.h"

struct linearized {
  bool apart;       /* proved where |tr J| is not 1 */
  bool takes_in[2]; /* and there the inequalities take tr J = -1, or 1, in */
  const char *note; /* the hypotheses and how each was checked, or the first that was not shown */
};
/* Is the criterion proved as it stands? */
bool linearized_proves(const struct linearized *l);
/* For the criterion that the record states. */
struct linearized linearized_stability(struct judge *j, const struct statement_record *criterion, struct view view);

#endif
