/* The zeros of the return map's defect in double precision, that is, the candidates for periodic orbits: one for each
   t_b at which r after one return is the r that the return started from. */
#ifndef STICKSLIP_SEARCH_H
#define STICKSLIP_SEARCH_H

#include "return_map_double.h"
#include "warm.h"

struct zero {
  struct dyn_place at;
  double low, high; /* of t_b: the zero lies between them */
  bool fold;        /* too close to an extremum of the defect to be told: none, one or two zeros near tb */
  bool grazing;
};
struct search {
  struct return_map_double k;
  struct dyn_limits lim;
  struct zero *zeros;
  size_t n, cap;
  long evaluations, steps;
  long allowed; /* steps after which the interval at hand is left */
  bool rough;   /* zeros are first guesses */
  bool cut;     /* an interval was left before it was done with */
};
/* late: with t_b beyond the first crest of phase Gamma, too.  rough: the last digits of a zero do not matter. */
int search_run(struct search *s, const double params[N_PARAMS], bool late, bool rough, const struct dyn_limits *lim);
void search_clear(struct search *s);

#endif
