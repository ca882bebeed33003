/* Every solution of the equations of the word D-Gamma-H-C, whichever roots of the switching functions end its phases.

   An orbit of the word has the first roots t_b, t_c, t_d (dynamics.h).  The equations (12), (14), (16), (18) alone ask
   for roots of the switching functions and not for the first ones: t_b may be a later time at which chi r = e2, t_c a
   later one at which z_1' = V, and t_d any time at which phase C comes to (r_0, 0), so that to each pair (t_b, t_c)
   there belong t_d, t_d + 2 pi/omega, ..., each with a t_a that is shorter by as much as t_d is longer.  What is found
   is

     p(t_b, t_c) = 0 and R(t_b, t_c)^2 = r_0(t_b)^2   (complete.h) with t_b, t_c, t_d, t_a > 0 and t_c <= t_c_max

   t_b is bounded by the energy of phase H.  t_c is not: where one solution is regular there are infinitely many, since
   the two angles om_i t_c of phase H return as close as one likes to where they were (Dirichlet).

   The plane of (t_b modulo 2 pi, t_c) is divided into cells, each of which is excluded or proved to hold one zero by
   the means of cell.h; each zero is enclosed in balls by Krawczyk's operator. */
#ifndef STICKSLIP_MOTION_BRANCHES_H
#define STICKSLIP_MOTION_BRANCHES_H

#include "dynamics.h"

enum { MOST_BRANCHES = 200 }; /* in a list */
/* All of them, or MOST_BRANCHES, by increasing t_c, then t_d, enclosed to prec bits; list->complete where it is proved
   that there is no other with t_c <= t_c_max (which list->t_c_max states), else list->gap tells why not.  Of each,
   first[] says which of its events are first roots, and holds[] which conditions are kept; what u_r1 and u_r2 it needs
   is not looked at.  Cost: at most `budget` cells, of 2 to 5 us each.  SS_DOMAIN outside the domain of dynamics.h;
   SS_UNABLE outside what double precision can hold, with an empty list.  To be cleared by dyn_orbits_clear. */
int dyn_branches_find(struct dyn_orbits *list, const fmpq *params, double t_c_max, slong prec, long budget);

#endif
