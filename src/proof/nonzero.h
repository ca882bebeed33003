/* What formulas divide by, and why it is zero on no periodic motion. */
#ifndef STICKSLIP_PROOF_NONZERO_H
#define STICKSLIP_PROOF_NONZERO_H

#include "exact_motion.h"
#include "value/sentence.h"

/* A quantity that must not be zero (of a square root: must be positive) where its formula has a value: a divisor, the
   determinant of a matrix that is inverted, what a square root is taken of, the sine of the angle of a cotangent. */
struct divisor {
  const char *formula; /* in the notation, "det(N_1 - I)" */
  const char *section;
  bool root;
};
enum { MOST_DIVISORS = 24 };
/* Those of the definitions and relations of a record, and of all definitions that they put in, none twice; at most
   MOST_DIVISORS in all, with texts in the arena or the model's.  false: there are more. */
bool divisors_of(struct divisor *list, int *n, struct arena *a, const struct statement_record *r, struct view view);

/* That V - z_1' is positive at the end of phase Gamma, and V - z_2' at the end of phase H, on every admissible motion:
   were one zero, some velocity would pass the belt's beside it.  In exact algebra; NULL: not shown, else why. */
const char *first_mass_is_slower(void);
const char *second_mass_is_slower(void);

/* Why the quantity is not zero: a product of what is positive for all parameters; of admissible motions also a factor
   of one of those two velocities.  NULL: neither is shown. */
const char *nonzero_because(const struct divisor *q, struct view view, bool admissible);

/* Is the divisor zero on every motion, by exact algebra? */
bool zero_everywhere(const struct divisor *q, struct view view);

/* Is what the quantity itself divides by never zero, so that it has no sign change but through zero? */
bool divisor_is_continuous(const struct divisor *q, struct view view, bool admissible);

/* Whether the quantity is zero on every motion on which z_1'' = 0 at the end of phase H, where z_1' then only touches
   the belt's velocity.  In exact algebra. */
bool zero_at_touch(const struct divisor *q, struct view view);

/* A motion over the whole word whose states at the switching times are free but for their events. */
void exact_motion_free(struct exact_motion *m, bool modes, int anchor, const struct tape *reads);
/* The sign of a product of what is positive for all parameters and a number; 0 where it is not one. */
int motion_sign(const fmpz_mpoly_q_struct *x, struct exact_motion *m);

#endif
