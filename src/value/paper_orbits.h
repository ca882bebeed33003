/* The paper's own route (44)-(46) at a scene. */
#ifndef STICKSLIP_VALUE_PAPER_ORBITS_H
#define STICKSLIP_VALUE_PAPER_ORBITS_H

#include "motion/paper_route.h"
#include "scene/scene.h"

/* One run of Newton's iteration.  The route may be used after SS_OK; distance is an upper bound of the largest
   difference between its six numbers and those of the nearest of the model's orbits. */
enum { PAPER_START_MOVED = 2 }; /* by how much every time of an orbit is moved for a start, in per cent */
struct paper_orbit {
  slong from; /* the orbit whose times were moved, from 0; -1: the printed times */
  double guess[4];
  int status;
  struct paper_route route;
  slong nearest; /* from 0; -1 when there is none */
  arb_t distance;
};
struct paper_orbits {
  struct paper_orbit *item;
  size_t n, cap;
};
/* From the printed times when the scene prints all four, else from the moved times of each orbit that the model finds.
   Where the scene does not give e1 and e2, those of each of its orbits are taken (the middle of their enclosure) and
   there is one run for each.  false with d set when there is nowhere to start; clear it all the same. */
bool audit_paper_orbits(struct paper_orbits *out, const struct scene *s, slong prec, struct diag *d);
void paper_orbits_clear(struct paper_orbits *p);

#endif
