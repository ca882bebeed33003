/* The scene under Coulomb's law. */
#ifndef STICKSLIP_COULOMB_SETUP_H
#define STICKSLIP_COULOMB_SETUP_H

#include "stickslip/audit.h"

/* audit_coulomb_setup on an orbit, by its number in the list of audit_orbits as it is, by which claims count. */
bool coulomb_setup_listed(struct coulomb_setup *sim, const struct scene *s, slong orbit, struct diag *d);
/* Coulomb's law beside an orbit, under the friction u_ri = factor max(e_i, u_ri_min).  OWN_FRICTION is the factor that
   audit_coulomb_setup takes where a scene gives no friction. */
#define OWN_FRICTION 1.25
int coulomb_setup_on_orbit(struct coulomb_setup *sim, const fmpq params[N_PARAMS], const struct dyn_orbit *o,
                           double factor);

#endif
