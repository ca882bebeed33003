/* The rank that the derivative of equations has but for exceptions: on an open and dense set of the parameters and
   unknowns.

   The domain is connected: 0 < chi < 1, eta, V, e_1, e_2 > 0, and any values of the unknowns.  Where the entries of the
   derivative are quotients of functions that are analytic on it, so is every minor, and one that is not zero at one
   point is zero on no open set.  So the rank at any point at which there is one is a lower bound. */
#ifndef STICKSLIP_PROOF_GENERIC_RANK_H
#define STICKSLIP_PROOF_GENERIC_RANK_H

#include "exact_rank.h"

struct generic_rank {
  int most;      /* no point has a larger rank: the unknowns, and the equations that do not repeat others */
  bool analytic; /* the entries are such quotients */
  const char *note;
};
struct generic_rank generic_rank_of(struct judge *j, const struct claim *c, struct view view,
                                    const struct rank_system *y);

#endif
