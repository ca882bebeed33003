/* Whether a list of orbits holds every orbit of the word D-Gamma-H-C.

   An orbit at given chi, eta, V, e1, e2 is a pair (t_b, t_c) with

     p(t_b, t_c) = 0              z_1' = V after the time t_c of phase H that t_b leads to
     R(t_b, t_c) = |r_0(t_b)|     R^2 = r^2 + q^2/omega^2 there, which phase C keeps; r_0 = e2/chi - rise(t_b)
     r_0 of the sign of q         (q = 0: of the sign of -r), the direction in which phase C ends

   whose t_b and t_c are first roots.  t_a follows from w at the end, t_d from the angle that phase C turns.  The list
   is complete when it is proved that there is no other such pair, as follows.

   1  t_b is a first root only where the rise g(t) = a (t - sin t) + e1 (1 - cos t), a = (1 - chi) V, is at a record:
      t_b = 2 pi k + s with 0 < s <= t*, t* the first crest, and for k > 0 also g(s) >= g(t*) - 2 pi a.  The motion in
      phase H depends on s alone, and r_0 = e2/chi - g(s) - 2 pi a k; so one sweep over s serves every k.
   2  The energy of phase H bounds |r_0|, which bounds k, and t_b with it, for each s.
   3  Below t* p starts below zero (p < 0 just after t_b even where s = 0).  (0, t*] is cut into strips of s, which
      advance through phase H cell by cell, ever more finely.  Cells are excluded (mean-value forms of second order of p
      and of H_k = R^2 - r_0^2), or proved to hold exactly one zero (Krawczyk's operator on a box twice as large).
   4  The part of a strip on which p is proved positive at some time has its first root behind it, and is done with.
      That bounds t_c where p does become positive.
   5  Where it does not: a strip is done with for all time when the amplitudes of z_1's two oscillations together do not
      reach V, when no pair of phases of the two modes, taken as free, satisfies the equations, or after a whole period
      where their frequencies are exactly in a simple ratio.  Near the s at which the sum of the amplitudes passes V, p
      returns to zero arbitrarily late, but only with both modes near their crests, where R is known.
   6  At s = t* p starts at zero and rises; its first root is where it falls through zero again.  That one line is swept
      in the same way.
   7  Every zero that was proved is an orbit of the list, or is refined in balls and proved not to be one (an event
      comes before, or the direction of phase C is the other one), or is a new orbit and is added to the list.

   The sweep works in disks (motion/disk.h), each zero is settled in Arb's balls. */
#ifndef STICKSLIP_MOTION_COMPLETE_H
#define STICKSLIP_MOTION_COMPLETE_H

#include "given.h"

/* Why a list that is not complete is not.  BUDGET is one of cells; DOUBLE: tr J = 1 or close to it; CONFLICT: never, or
   a fault of the program; MANY: branches.h. */
#define DYN_GAPS(G)                                                                                                    \
  G(UNTRIED, "not looked into")                                                                                        \
  G(BUDGET, "the budget ran out before t_c was bounded everywhere")                                                    \
  G(DOUBLE, "a double zero, or two zeros too close to be told apart")                                                  \
  G(GRAZING, "it is undecided whether an event is the first of its phase")                                             \
  G(CONFLICT, "an orbit of the list was not met again")                                                                \
  G(RANGE, "the parameters are outside what double precision can hold")                                                \
  G(GIVEN, "no complete search for this pair of given quantities")                                                     \
  G(MANY, "there are more than are listed")
#define GAP(name, text) GAP_##name,
enum dyn_gap { DYN_GAPS(GAP) N_GAPS };
#undef GAP
extern const char *const dyn_gap_text[N_GAPS];
/* Notes it near (t_b, t_c), unless another one is noted already. */
void dyn_leave_gap(struct dyn_orbits *list, enum dyn_gap why, double tb, double tc);

/* The default budget: below two seconds. */
enum { DYN_CELLS = 4000000 };

/* Decides list->complete for a list of orbits at the parameters, as dyn_orbits_find gives it, whatever its length;
   orbits that were missed are added, enclosed to prec bits.  list->gap tells why it is not complete, and gap_at the
   (t_b, t_c) near which that is (GAP_DOUBLE, GAP_GRAZING).  Cost: below 1 ms at usual parameters; at most budget cells
   (0.2 to 0.4 us each).  SS_DOMAIN outside the domain of dynamics.h. */
int dyn_orbits_complete(struct dyn_orbits *list, const fmpq *params, slong prec, long budget);

/* The same for a list that dyn_orbits_given returned, with its arguments; orbits are not added, but a missing one is
   GAP_CONFLICT.

     e1, e2         as above
     t_b, t_c       a quadratic equation tells everything
     t_b, e1 or e2  every t_c up to that of dyn_given_limits, which list->t_c_max states; e1 and e2 are not bounded
     any other      GAP_GIVEN */
int dyn_given_complete(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                       slong prec);

#endif
