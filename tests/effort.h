/* What work costs, measured against other work in the same run: no machine is too slow for a test that asks so. */
#ifndef STICKSLIP_TESTS_EFFORT_H
#define STICKSLIP_TESTS_EFFORT_H

#include <stdbool.h>

struct effort {
  void (*work)(void *arg);
  void *arg;
};

/* Whether one costs less than factor times the other: the least processor time of this thread among runs of the two in
   turn, three of each at least and, while that does not hold, many more, so that what else the machine does has no
   say. */
bool costs_less(const struct effort *one, double factor, const struct effort *other);

#endif
