/* Where the orbits may be that have two given quantities: the cells of a grid over (t_b, t_c) in which the given values
   can occur, and Newton's iteration on the four equations from there, all in double precision. */
#ifndef STICKSLIP_GIVEN_SEARCH_H
#define STICKSLIP_GIVEN_SEARCH_H

#include "orbit_equations.h"
#include "sheet.h"

/* A problem: the model, and which of the six quantities are known. */
struct given_problem {
  struct word_data data;
  double target[2];
  struct return_map_double k; /* of the given e1; its e2 is not used */
  struct dyn_limits lim;
};

bool given_problem_knows(const struct given_problem *q, enum dyn_quantity x);

/* A solution of the four equations in double precision, none of whose events comes clearly before its time. */
struct seed {
  double x[N_QUANTITIES];
};
struct seeds {
  struct seed *seed;
  size_t n, cap;
  long evaluations; /* of the sheets */
};
/* All that the grid shows, none twice.  SS_UNABLE when a row alone would be too long, or when the budget of work was
   used up before the end; the seeds are valid as far as they go.  The caller frees seed. */
int given_search(struct seeds *out, const struct given_problem *q);

#endif
