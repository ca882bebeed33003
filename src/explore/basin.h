/* Conditional stability made quantitative: how far r = z_2 - z_1 at the stick phase may be from that of a stable orbit.

   Only r acts: whatever the perturbation, the next stick phase is fixed by r alone.  Over the interval [low, high]
   around the orbit's r it is proved, in balls and by pieces, that t_b, t_c and t_d are the first events of their
   phases, that every condition of dyn_condition_id holds on the way (so that the next stick phase has t_a > 0), that
   the return map has a slope below 1 in modulus and that it takes the interval into itself.  Every start in the stick
   phase with r in it then tends to the orbit, in the order D-Gamma-H-C throughout, if u_r1 and u_r2, where they are not
   given, are large enough for every such motion: above more than the orbit's own bounds. */
#ifndef STICKSLIP_EXPLORE_BASIN_H
#define STICKSLIP_EXPLORE_BASIN_H

#include "motion/dynamics.h"

enum dyn_failure {
  FAILS_UNKNOWN,  /* no point at most twice as far was proved to fail */
  FAILS_SLOPE,    /* the slope there is at least 1 in modulus */
  FAILS_IMAGE,    /* the map leads farther away from the orbit's r */
  FAILS_CONDITION /* one of the conditions is broken on the way: the order of the phases changes */
};

struct dyn_basin {
  bool proved;
  fmpq low, high; /* decimals, about as far from r on both sides */
  double slope;   /* an upper bound of the slope's modulus over the interval */
  enum dyn_failure why;
  int condition; /* of FAILS_CONDITION: COND_..., or N_CONDITIONS + 0 or 1 for u_r1, u_r2 */
  fmpq fails_at; /* at most twice as far from the orbit's r */
};

void dyn_basin_init(struct dyn_basin *b);
void dyn_basin_clear(struct dyn_basin *b);
/* orbit: one that dyn_orbits_find gave for params; u_r: static friction forces, which must then be enough on the way,
   or NULL each.  proved is false for an orbit that is not stable or not admissible, and where not even an interval of
   1e-9 of |r| + e2/chi could be proved. */
void dyn_basin_find(struct dyn_basin *b, const fmpq *params, const fmpq *const u_r[2], const struct dyn_orbit *orbit);

#endif
