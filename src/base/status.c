/* Kleene's three-valued logic: UNKNOWN stays unknown unless the other operand decides. */
#include "status.h"

truth truth_and(truth a, truth b) {
  if (a == TRUTH_FALSE || b == TRUTH_FALSE) return TRUTH_FALSE;
  return (a == TRUTH_TRUE && b == TRUTH_TRUE) ? TRUTH_TRUE : TRUTH_UNKNOWN;
}

truth truth_or(truth a, truth b) {
  return truth_not(truth_and(truth_not(a), truth_not(b)));
}

truth truth_not(truth a) {
  if (a == TRUTH_UNKNOWN) return a;
  return a == TRUTH_TRUE ? TRUTH_FALSE : TRUTH_TRUE;
}

truth truth_same(truth a, truth b) {
  if (a == TRUTH_UNKNOWN || b == TRUTH_UNKNOWN) return TRUTH_UNKNOWN;
  return a == b ? TRUTH_TRUE : TRUTH_FALSE;
}
