/* Orbits over a box of parameters: what holds for every point of it.

   Each orbit at the middle of the box is continued over the whole of it.  The box is cut into pieces, on each of which
   Krawczyk's operator proves one solution (t_b, t_c) of the return map's equations for each point; where two pieces
   meet it is checked that they hold the same one.  Enclosures are the union over the pieces. */
#ifndef STICKSLIP_EXPLORE_BOX_H
#define STICKSLIP_EXPLORE_BOX_H

#include "family.h"
#include "motion/dynamics.h"
#include "motion/margins.h"

enum { DYN_BOX_PIECES = 1024 }; /* at most, for each orbit */
enum { DYN_BOX_HALVINGS = 6 };  /* by which the enclosures over a box get narrow */

struct dyn_box_orbit {
  struct dyn_orbit
      orbit;   /* proved: every number an enclosure over the box, every truth one for all of its points; else the
                             orbit at the middle, with nothing said about stability and conditions */
  bool proved; /* for each point of the box one such orbit, and they form one surface */
  truth word;  /* t_b and t_c are first roots all over the box */
  bool stability_changes;     /* proved: stable at some points of the box, unstable at others */
  bool changes[N_CONDITIONS]; /* proved: the condition holds at some points and is broken at others */
  slong pieces;
};
struct dyn_box {
  struct dyn_box_orbit *at; /* by increasing z10 at the middle */
  slong n;
};

/* low, high: the ends of each parameter, equal where it is exact.  halvings: how often the box is halved at least; what
   is proved needs none, and each makes the enclosures narrower.  Orbits that exist in a part of the box that leaves
   out its middle are not found.  SS_DOMAIN outside the domain of dynamics.h; SS_UNABLE when the search at the middle
   ran into its limits. */
int dyn_box_find(struct dyn_box *box, const fmpq *low, const fmpq *high, int halvings);
void dyn_box_clear(struct dyn_box *box);

#endif
