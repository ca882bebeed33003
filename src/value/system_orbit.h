/* Periodic orbits of the paper's word by the engine for any system (mech/orbit.h), which knows masses, springs, a belt
   and friction, and none of the formulas of src/motion. */
#ifndef STICKSLIP_SYSTEM_ORBIT_H
#define STICKSLIP_SYSTEM_ORBIT_H

#include "mech/orbit.h"
#include "motion/dynamics.h"

/* At exact parameters the orbit near `near`, in balls of prec bits: the four times, the states (z_1, z_2, z_1', z_2')
   at the beginnings of the phases and at the end, and J, row by row; t, z or j may be NULL.  SS_UNABLE when none is
   proved there. */
int system_orbit(arb_ptr t, arb_ptr z, arb_ptr j, const fmpq params[N_PARAMS], const struct dyn_orbit *near,
                 slong prec);

#endif
