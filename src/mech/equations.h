/* The equations of a word and what enters them, in balls; for the files of this folder. */
#ifndef STICKSLIP_MECH_EQUATIONS_H
#define STICKSLIP_MECH_EQUATIONS_H

#include "orbit.h"

/* A word's matrices: exact, and in balls. */
struct mech_equations {
  const struct mech *m;
  const struct mech_word *w;
  int side, n_free, free[MECH_STATES]; /* side = states + 1 */
  int hit[MECH_PHASES];                /* the mass that rebounds at the end of a phase, or -1 */
  arb_t rebound[MECH_PHASES];          /* what its velocity is multiplied by */
  slong turns;                         /* of the loads in a period */
  slong prec;
  bool rough; /* the exponentials are GSL's, in double precision: for Newton's first steps, not for a proof */
  arb_mat_t rate[MECH_PHASES], event[MECH_PHASES]; /* A of each phase; the row that is zero at its end */
  /* Over a box of parameters: */
  arb_mat_t middle[MECH_PHASES], *rate_along[MECH_PHASES]; /* A at its middle, and what each interval adds to A */
  arb_mat_t
      entry; /* y = entry (free x and x', with loads their cosines and sines, 1) at the entry of the first phase */
  arb_mat_t *entry_along; /* what each interval adds to entry */
  bool along;             /* the derivatives by delta_i are wanted as well */
  arb_mat_t value, slope; /* of the last evaluation: the defects, and their derivatives by (t, free, delta) */
  arb_mat_t state[MECH_PHASES + 1], change; /* y at the entry of each phase and at the end; dy/d(t, free, delta) */
};
void mech_equations_init(struct mech_equations *e, const struct mech *m, const struct mech_word *w, slong turns,
                         slong prec);
void mech_equations_clear(struct mech_equations *e);
/* The row of a condition (mech.h), over the box where the data are intervals. */
void mech_condition_balls(arb_mat_t row, const struct mech *m, int mass, char mode, enum mech_end end, slong prec);
/* exp(A t) of a phase. */
void mech_flow(arb_mat_t flow, const struct mech_equations *e, int phase, const arb_t t);
/* At unknowns (t, free), points or balls. */
void mech_equations_at(struct mech_equations *e, arb_srcptr x);

/* The Jacobian of an orbit's first return by saltation matrices, from its lengths and its first state. */
void mech_saltation(arb_mat_t j, const struct mech_equations *e, const struct mech_orbit *o);

/* z times an order, which is z itself for 1: a product would be wider. */
static inline void mech_times_order(arb_t z, int order, slong prec) {
  if (order > 1) arb_mul_si(z, z, order, prec);
}
/* A condition g < 0; where it may just be zero it is not told. */
static inline truth mech_holds(const arb_t g) {
  return arb_is_negative(g) ? TRUTH_TRUE : arb_is_positive(g) ? TRUTH_FALSE : TRUTH_UNKNOWN;
}
/* The facts of an orbit whose lengths and states are known. */
void mech_judge(struct mech_orbit *o, struct mech_equations *e);

#endif
