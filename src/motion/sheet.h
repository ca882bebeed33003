/* The two sheets over (t_b, t_c), in double precision: at given t_b and t_c the equations of given.h leave a quadratic,
   so that at most two orbits have these times, and all six quantities of either are known in closed form. */
#ifndef STICKSLIP_SHEET_H
#define STICKSLIP_SHEET_H

#include "given.h"
#include "return_map_double.h"

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

struct slip_matrix slip_matrix_at(const struct return_map_double *k, double t);

/* A point of a sheet: an orbit but for its conditions. */
struct sheet {
  bool real;      /* the quadratic has roots here, and the quantities are finite */
  double reality; /* the quadratic's relative discriminant */
  double x[N_QUANTITIES];
};

/* Both points over (b->t, h->t); k is read for chi, eta and V alone. */
void sheets_at(struct sheet out[2], const struct return_map_double *k, const struct gamma_turn *b,
               const struct slip_matrix *h);
/* z_1' - V at the time of h in phase H, on the motion of the sheet's point that starts phase H at b. */
double sheet_lead(const struct sheet *p, const struct return_map_double *k, const struct gamma_turn *b,
                  const struct slip_matrix *h);

#endif
