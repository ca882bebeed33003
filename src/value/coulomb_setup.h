/* The scene under Coulomb's law. */
#ifndef STICKSLIP_COULOMB_SETUP_H
#define STICKSLIP_COULOMB_SETUP_H
#include "motion/coulomb.h"
#include "scene/scene.h"

struct coulomb_setup {
  double params[N_COULOMB], start[N_STATE];
  double period;     /* of the orbit; at printed numbers of the first orbit; 0 when there is none */
  double trace;      /* tr J of the orbit; NaN at printed numbers */
  bool broken;       /* the orbit is not admissible */
  bool own_friction; /* some u_r is ours, 5/4 max(e_i, u_ri_min of the orbits in question), not the scene's */
};
/* orbit counts from 0, as in struct jacobian_request.  false with d set when there is no such orbit, or no printed
   start. */
bool audit_coulomb_setup(struct coulomb_setup *sim, const struct scene *s, slong orbit, bool printed, struct diag *d);
/* From a start of one's own, "x1,x2,v1,v2" as constant expressions; friction as at printed numbers. */
bool audit_coulomb_setup_from(struct coulomb_setup *sim, const struct scene *s, const char *start, struct diag *d);
/* n such numbers; takes: what is said where there are more or fewer. */
bool coulomb_start_read(double *z, int n, const char *start, const char *takes, struct diag *d);

/* The motion integrated up to its first return, or for so many of the orbit's periods: where it ends, and the letters
   of its phases.  Status flags. */
int coulomb_setup_return(struct text *word, struct coulomb_result *end, const struct coulomb_setup *sim,
                         double periods);
/* Does the motion close after one period of the word D-Gamma-H-C?  UNKNOWN between closed and clearly not.  A start in
   the stick phase is needed. */
truth coulomb_setup_closes(const struct coulomb_setup *sim);

/* audit_coulomb_setup on an orbit, by its number in the list of audit_orbits as it is, by which claims count; nothing
   is said where it fails. */
bool coulomb_setup_listed(struct coulomb_setup *sim, const struct scene *s, slong orbit);
/* The same by its number in a list of the scene's orbits that is at hand, of 128 bits or more. */
bool coulomb_setup_among(struct coulomb_setup *sim, const struct scene *s, const struct dyn_orbits *list, slong orbit);
/* Coulomb's law beside an orbit, under the friction u_ri = factor max(e_i, u_ri_min).  OWN_FRICTION is the factor that
   audit_coulomb_setup takes where a scene gives no friction. */
#define OWN_FRICTION 1.25
int coulomb_setup_on_orbit(struct coulomb_setup *sim, const fmpq params[N_PARAMS], const struct dyn_orbit *o,
                           double factor);

#endif
