/* A periodic orbit in double precision by three methods, each started at the orbit: the paper's equations (44)-(46),
   six equations, the one-dimensional return map.  How many digits each loses, and the condition numbers of what it
   inverts. */
#ifndef STICKSLIP_BENCH_THREE_WAYS_H
#define STICKSLIP_BENCH_THREE_WAYS_H

#include "motion/dynamics.h"

enum { THREE_WAYS_BITS = 256 };

struct three_ways {
  double paper, six, map;                   /* digits lost, as paper_route.h counts them; NAN: the method failed */
  double k_paper, k_n1, k_n3, k_six, k_map; /* row-sum norm; k_map: 1/|1 - tr J| */
};
/* params as doubles and as rationals, which are equal; the orbit at these, known to THREE_WAYS_BITS. */
void three_ways(struct three_ways *w, const double *params, const fmpq *exact, const struct dyn_orbit *o);

#endif
