/* The complete search where t_b and one of e1, e2 are given: the zeros along t_c. */
#ifndef STICKSLIP_LINE_H
#define STICKSLIP_LINE_H

#include "strip.h"

/* A zero t_c, proved to be the only one within room of at; it lies within near of it, and belongs to the value e of the
   unknown one of e1, e2. */
struct line_zero {
  double at, near, room;
  struct disk e;
};
struct line {
  struct line_zero *zeros;
  size_t n, cap;
  long cells;
  bool spent, stuck;
  double where;
};
/* Every t_c in (0, last] at which some positive value of the unknown satisfies both equations, unless spent or stuck.
   params: the element unknown, P_E1 or P_E2, is not looked at.  false outside what double precision can hold. */
bool line_run(struct line *s, const fmpq *params, int unknown, const fmpq *tb, double last, long budget);
void line_clear(struct line *s);

#endif
