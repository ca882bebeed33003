/* The numbers of an orbit in the order of the contract; the last two are the bounds of static friction. */
#ifndef STICKSLIP_ORBIT_NUMBERS_H
#define STICKSLIP_ORBIT_NUMBERS_H

#include "stickslip/dynamics.h"

enum { ORBIT_NUMBERS = 12, MOST_BOX_DIGITS = 20 };
const char *orbit_number_name(int i);
arb_srcptr orbit_number(const struct dyn_orbit *o, int i);

#endif
