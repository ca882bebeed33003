/* The paper's two masses as a system. */
#ifndef STICKSLIP_TWO_MASSES_H
#define STICKSLIP_TWO_MASSES_H

#include "mech.h"
#include "motion/certify.h"

/* Springs 1 - chi to the wall and chi between the masses, which are 1 and 1/eta.  sliding: u_s1 and u_s2, NULL for
   none; the static limits are e_1 and e_2 above them.  Without sliding friction x is the paper's z. */
void two_masses(struct mech *m, const fmpq params[N_PARAMS], const fmpq *const sliding[2]);
/* The certified orbits of one question as a file for stickslip-checker, see mech_certificates_json. */
void two_masses_certificates_json(struct text *out, const char *scene, const struct dyn_question *q,
                                  const struct dyn_orbits *list, const struct dyn_certificate *proof);

#endif
