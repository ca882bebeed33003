/* Where the orbits may be that have two given quantities: the cells of a grid over (t_b, t_c) in which the given values
   can occur, and Newton's iteration on the four equations from there, all in double precision. */
#ifndef STICKSLIP_GIVEN_SEARCH_H
#define STICKSLIP_GIVEN_SEARCH_H

#include "orbit_equations.h"
#include "return_map_double.h"

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

/* --- sheet.c: at given t_b and t_c the equations of given.h leave a quadratic, so that at most two orbits have these
   times, and all six quantities of either are known in closed form. --- */

/* What phase Gamma, which turns (w, w') by t, needs of t. */
struct gamma_turn {
  double t, s, c, versine, lag; /* 1 - cos t, t - sin t */
};

struct gamma_turn gamma_turn_at(double t);

/* cos(sqrt(K) t), sin(sqrt(K) t)/sqrt(K) and sqrt(K) sin(sqrt(K) t): velocities v and forces f = (w, chi eta r) become
   c v - s f and c f + n v. */
struct slip_matrix {
  double t, c[4], s[4], n[4];
};

struct slip_matrix slip_matrix_at(const struct slip *k, double t);

/* A point of a sheet: an orbit but for its conditions. */
struct sheet {
  bool real;      /* the quadratic has roots here, and the quantities are finite */
  double reality; /* the quadratic's relative discriminant */
  double x[N_QUANTITIES];
};

/* Both points over (b->t, h->t); of k neither e1 nor e2 is read. */
void sheets_at(struct sheet out[2], const struct slip *k, const struct gamma_turn *b, const struct slip_matrix *h);
/* z_1' - V at the time of h in phase H, on the motion of the sheet's point that starts phase H at b. */
double sheet_lead(const struct sheet *p, const struct slip *k, const struct gamma_turn *b, const struct slip_matrix *h);

#endif
