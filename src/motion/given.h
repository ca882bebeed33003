/* Periodic orbits of the word D-Gamma-H-C when chi, eta, V and any two of e1, e2, t_a, t_b, t_c, t_d are given.

   With z_1' = V and z_2' = V where they must be, phase C turns (r, q/omega) by omega t_d into (r_0, 0), and an orbit is

     p_c = 0,   r_c = r_0 cos(omega t_d),   q_c/omega = r_0 sin(omega t_d),
     w_c + a (t_a + t_d) - chi (r_0 - r_c) = e1,

   where r_0 = e2/chi - rise(t_b) and the state at t_c are linear in e1 and e2.  At given t_b, t_c the first and the
   last and the sum of squares of the others leave a quadratic: a pair (t_b, t_c) belongs to at most two orbits, in
   closed form.  So every pair of given quantities comes down to

     given                       unknown of the search        how
     e1, e2                      t_b                          dyn_orbits_find, with its own reach
     t_b, t_c                    none                         a quadratic
     t_b and e1, e2, t_a or t_d  t_c                          a fine scan of both solutions of the quadratic
     t_c and e1, e2, t_a or t_d  t_b                          the same
     e1 or e2 and t_a or t_d;    t_b and t_c                  a grid over the plane, in both solutions
     t_a and t_d

   and Newton's iteration in the four unknowns of the original equations from every cell in which the given values can
   occur.  t_b, t_c, t_d must be the first positive roots of their own switching functions, e1 and e2 positive; t_a has
   any sign. */
#ifndef STICKSLIP_MOTION_GIVEN_H
#define STICKSLIP_MOTION_GIVEN_H

#include "dynamics.h"

enum dyn_quantity { QUANTITY_E1, QUANTITY_E2, QUANTITY_TA, QUANTITY_TB, QUANTITY_TC, QUANTITY_TD, N_QUANTITIES };
extern const char *const dyn_quantity_id[N_QUANTITIES]; /* "e1", "e2", "t_a", "t_b", "t_c", "t_d" */

/* Default limits of these searches: t_max = 200. */
extern const struct dyn_limits dyn_given_limits;

/* Every orbit that the search finds, by increasing z10, as dyn_orbits_find gives them: each proved (Krawczyk's operator
   on the four unknowns) to be the only one in its enclosure, to prec relative bits, the given values being exact.
   model: chi, eta, V.  which and value: the two given quantities, in any order.  The working precision is planned, and
   list->bits and list->raises count, as there.

   Reach: t_b and t_c up to lim->t_max, but t_b only up to DYN_GIVEN_TB where both are unknown (an orbit beyond has
   overrun the belt in phase Gamma and is not admissible); t_d has no limit of its own, it is below pi/sqrt(chi eta).
   e1 and e2 are not bounded.  The searches are dense, not rigorous: a scan in one unknown has 300 cells to the shortest
   period and halves those in which the two solutions of the quadratic end or change much; the plane has 50 by 50, and
   an orbit can be missed where much happens within one of them.  complete is false: complete.h decides it.

   SS_DOMAIN outside the domain of dynamics.h, for a time t_b, t_c, t_d or a limit e that is not positive, or for the
   same quantity twice.  SS_UNABLE, with a list that is valid as far as it goes, when a solution in double precision
   could not be told from a double one or enclosed even at 16 times the precision, or when the scan used up its budget
   of work (about five seconds at worst; chi eta or t_max is large), the smaller t_b having been searched.

   Cost at t_max = 200 and chi eta near 1, on one core: t_b, t_c 0.3 ms, the other scans in one unknown 2 to 30 ms, the
   plane 0.1 to 0.2 s with e1 given, which leaves out most t_b, else 0.3 to 0.8 s. */
enum { DYN_GIVEN_TB = 64 };
int dyn_orbits_given(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                     slong prec, const struct dyn_limits *lim);

#endif
