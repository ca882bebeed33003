/* What the searches for orbits share: the working precision that an orbit needs, and the order of a list. */
#ifndef STICKSLIP_ORBIT_H
#define STICKSLIP_ORBIT_H

#include "dynamics.h"

/* The first working precision for prec bits of every number of an orbit.  How many bits the worst of them loses is the
   orbit's own (its condition) and hardly depends on the precision, so that a pilot tells, of which `left` bits are
   left; 0: none was run, since up to DYN_PLANNED_FROM bits a failed attempt costs less than one, or it told nothing. */
enum { DYN_GUARD = 40, DYN_PLANNED_FROM = 512, DYN_PILOT = 192 };
slong dyn_planned_bits(slong prec, slong left);

/* For qsort: struct dyn_orbit by increasing z10. */
int dyn_orbits_by_z10(const void *x, const void *y);

#endif
