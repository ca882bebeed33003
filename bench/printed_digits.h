/* What t_b, t_c, t_d known to a few printed digits tell of t_a, z_10, z_20.

   With A = C H Gamma in blocks A1 A2; A3 A4, N = A D makes the two equations (45) linear in t_a,

     t_a (A1 - I)^-1 u + (A1 - I)^-1 A2 u - A3^-1 (A4 - I) u = 0,   u = (1, 1),

   so each of them alone gives t_a, and (46) z_0; on an orbit they agree.  The third way takes t_b and t_c alone, the
   rest being solved for (given.h). */
#ifndef STICKSLIP_BENCH_PRINTED_DIGITS_H
#define STICKSLIP_BENCH_PRINTED_DIGITS_H

#include "motion/given.h"

enum { PRINTED_BITS = 256, N_WANTED = 3 }; /* wanted: t_a, z_10, z_20 */

/* The three times as printed, and half a unit of their last digit. */
struct printed_times {
  fmpq t[3], half[3];
};
void printed_times_set(struct printed_times *p, const double t[3], int digits);
void printed_times_clear(struct printed_times *p);

/* A, from three times in the arithmetic of the parameters. */
int printed_matrix(struct num_vec *a, const struct num_vec *params, const struct num_vec *t);
/* t_a, z_10, z_20 of an orbit. */
void printed_wanted(arb_ptr out, const struct dyn_orbit *o);
/* The values that equation `row` (0, 1) of (45) and then (46) give, in balls; not finite where they cannot be had.
   params and t are duals (motion/dual.h), t those of the directions 0, 1, 2; slope, unless NULL: derivatives by these,
   value by value. */
void printed_by_row(arb_ptr out, arb_ptr slope, int row, const struct num_vec *params, const struct num_vec *t);

/* Correct digits of the printed values themselves, the fewest at points of the box of numbers that are printed so, and
   a bound that holds in all of it (NAN: none is known). */
struct printed_digits {
  double printed[N_WANTED], worst[N_WANTED], sure[N_WANTED];
};
/* The box is cut into n^3 cells for the bound. */
void printed_row_digits(struct printed_digits *d, int row, const struct num_vec *params, const struct printed_times *p,
                        arb_srcptr truth_of, int n);
/* td picks among two orbits. */
void printed_pair_digits(struct printed_digits *d, const fmpq *model, const struct printed_times *p, double td,
                         arb_srcptr truth_of);

#endif
