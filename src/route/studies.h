/* Routes held against each other, apart from any claim. */
#ifndef STICKSLIP_STUDIES_H
#define STICKSLIP_STUDIES_H

#include "claim/judging.h"

/* Every pair of routes in the table of routes.h that compute the same quantity, held against each other at fixed random
   points and on orbits, into out->pairs. */
bool study_routes(struct judge *j);
/* Runs over many periods beside the scene's orbit nearest to its printed numbers and beside orbits of other
   multipliers, into out->long_runs. */
void study_long_runs(struct judge *j);

#endif
