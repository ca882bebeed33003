/* The paper's own way to a periodic orbit, equations (44)-(46), as a method among others.

   N = C(t_d) H(t_c) Gamma(t_b) D(t_a) carries (z, z') once around, with blocks N1 N2; N3 N4 and D read as
   (I, t I; 0, I).  From (N1 - I) z_0 + N2 z'_0 = 0 and N3 z_0 + (N4 - I) z'_0 = 0 with z'_0 = (V, V):

     M = (N1 - I)^-1 N2 - N3^-1 (N4 - I),   M11 + M12 = 0,   M21 + M22 = 0,   z_0 = -(N1 - I)^-1 N2 z'_0,

   and z_1a - chi z_2a = e1, chi (z_2b - z_1b) = e2: four equations for t_a, t_b, t_c, t_d at given e1, e2, solved by
   Newton's iteration with the exact derivative.  The four matrices are matrix exponentials (dyn_propagator); nothing
   of the paper's closed forms is used.  Whether the events are first ones is not asked: that is dyn_orbits_find's. */
#ifndef STICKSLIP_MOTION_PAPER_ROUTE_H
#define STICKSLIP_MOTION_PAPER_ROUTE_H

#include "dynamics.h"

/* t_a, t_b, t_c, t_d, z_10, z_20. */
enum { ROUTE_Z = 4, N_ROUTE = 6 };

/* How the equations stand at a point: condition numbers. */
struct paper_condition {
  double jacobian; /* of the four equations by the four times, in the paper's units */
  double n1, n3;   /* N1 - I and N3, which the method inverts */
};

/* |A| |A^-1| in the row-sum norm of an n by n matrix; a status of num_mat_solve, and NaN. */
int paper_condition_number(double *k, const struct num_vec *a, slong n);
/* log10 of the largest error of x_d in units of 2^-53, at least 0: errors of times are relative to the sum of the |t|,
   of positions to |z_10| + |z_20|.  x is the truth in mpfr; NaN when x_d is not finite. */
double paper_digits_lost(const double x_d[N_ROUTE], const struct num_vec *x);

/* From the four times in x, in double or mpfr: the solution in x, and the number of steps.  SS_UNABLE when it does not
   converge within 60 steps or leaves |t| < 1000, SS_DOMAIN when a matrix is exactly singular. */
int paper_route_newton(struct num_vec *x, int *steps, const struct num_vec *params);

struct paper_route {
  int status_d;                     /* of the iteration in double precision */
  double x_d[N_ROUTE];              /* its result */
  int steps_d, steps;               /* from the guess, in double precision and in mpfr */
  struct num_vec x;                 /* the solution in mpfr */
  struct paper_condition condition; /* there */
  double digits_lost;               /* in double precision; NaN when either iteration failed */
};
void paper_route_init(struct paper_route *r, slong prec);
void paper_route_clear(struct paper_route *r);
/* Both precisions from the same guess.  Returns the status of mpfr; SS_DOMAIN outside the domain of dynamics.h. */
int paper_route_run(struct paper_route *r, const fmpq *params, const double guess[4]);

#endif
