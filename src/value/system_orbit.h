/* Periodic orbits of the paper's word by the engine for any system (mech/orbit.h), which knows masses, springs, a belt
   and friction, and none of the formulas of src/motion. */
#ifndef STICKSLIP_SYSTEM_ORBIT_H
#define STICKSLIP_SYSTEM_ORBIT_H

#include "mech/orbit.h"
#include "motion/dynamics.h"

struct system_orbit {
  arb_struct t[N_PHASES], z[(N_PHASES + 1) * N_STATE], j[4];
  int status; /* SS_UNABLE when none is proved */
};
/* At exact parameters the orbit near `near`, in balls of prec bits: the four times, the states (z_1, z_2, z_1', z_2')
   at the beginnings of the phases and at the end, and J, row by row. */
void system_orbit_init(struct system_orbit *s, const fmpq params[N_PARAMS], const struct dyn_orbit *near, slong prec);
void system_orbit_clear(struct system_orbit *s);

#endif
