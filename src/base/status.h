/* How a function answers.
   Status flags are OR-ed along a computation and looked at once, at its end.  They are the first of the codes of
   the library's enum ss_status.  SS_DOMAIN means the value does not
   exist (division by an exact zero, the root of a negative number); SS_UNABLE means it could not be told or held
   (a ball that straddles zero, overflow, a budget used up).  After either, outputs are valid objects of no meaning. */
#ifndef STICKSLIP_BASE_STATUS_H
#define STICKSLIP_BASE_STATUS_H

#include "stickslip/status.h"

/* Three-valued truth; UNKNOWN is an honest answer. */
typedef enum { TRUTH_FALSE = 0, TRUTH_TRUE = 1, TRUTH_UNKNOWN = 2 } truth;

truth truth_and(truth a, truth b);
truth truth_or(truth a, truth b);
truth truth_not(truth a);
/* Whether both are known and the same. */
truth truth_same(truth a, truth b);

#endif
