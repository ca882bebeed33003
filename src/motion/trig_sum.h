/* A motion seen through one switching function, in double precision, and its first root:
   f(t) = start + drift t + sum over i of cs[i] (cos(om[i] t) - 1) + sn[i] sin(om[i] t). */
#ifndef STICKSLIP_TRIG_SUM_H
#define STICKSLIP_TRIG_SUM_H

#include <stdbool.h>

#include "dynamics.h"

struct trig_sum {
  double start, drift, om[2], cs[2], sn[2];
};
/* How such a sum changes with a parameter: its derivative, and bounds of that and of the second derivative. */
struct trig_sum_shift {
  struct trig_sum rate;
  double most, bend;
};
struct trig_sum_root {
  double t, rate; /* the first positive root and f' there */
  double safe;    /* the parameter can move about this far before the first root can jump: no maximum that stays below
                     zero before the root comes up to it, and the one right after the root does not sink to it */
  bool grazing;
  long steps;
};
enum { UNITS_OF_STEP = 10 }; /* of work (work.h): a step of the search for a root */
/* value[0..2] = f, f', f'' at t. */
void trig_sum_at(double value[3], const struct trig_sum *w, double t);
/* The first positive root of w, with the statuses of event_first.  shift may be NULL when safe is not wanted.
   When there is no root, safe and steps are still set. */
int trig_sum_first_root(struct trig_sum_root *root, const struct trig_sum *w, const struct trig_sum_shift *shift,
                        const struct dyn_limits *lim);

#endif
