/* The orbits of a scene. */
#ifndef STICKSLIP_VALUE_ORBITS_H
#define STICKSLIP_VALUE_ORBITS_H

#include "motion/given.h"
#include "scene/scene.h"

/* The two quantities that are given besides chi, eta, V, by scene_key, borrowed; how many there are. */
int orbits_given_pair(enum dyn_quantity which[2], fmpq value[2], const fmpq *from, const bool *given);
/* The orbits of the scene, by increasing z10, from whichever two quantities it gives; flags as dyn_orbits_find and
   dyn_orbits_given return them. */
int audit_orbits(struct dyn_orbits *list, const struct scene *s, slong prec);
/* Decides whether such a list is complete, and adds what it lacks: complete.h. */
void audit_orbits_complete(struct dyn_orbits *list, const struct scene *s, slong prec);

#endif
