/* Admissibility along the whole of a periodic orbit: every inequality of every phase with its margin.

   The margin is the infimum over the phase of the right side minus the left side, so that an inequality holds when its
   margin is positive.  Some inequalities become equalities at an end of their phase: where a switching condition ends
   the phase (w -> e1 at t_a), or where a velocity is continuous at a start (z_1' = V when m1 begins to slip).  Such a
   margin is an exact zero when nothing else in the phase comes as low; the inequality then holds just inside when the
   first derivative into the phase that is not zero is positive, and that derivative is given.

     id           phase   inequality                  paper        zero by definition at
     t_a          D       t_a > 0                     (51)
     gamma_v1     Gamma   z_1' < V                    (57)         start
     h_v1         H       z_1' < V                                 end
     h_v2         H       z_2' < V                                 start
     c_v2         C       z_2' < V                    (59)         end
     c_w          C       z_1 - chi z_2 < e1          (59)
     d_r          D       chi (z_2 - z_1) < e2        (54)
     gamma_r      Gamma   chi (z_2 - z_1) < e2        (57)         end
     d_w          D       z_1 - chi z_2 < e1          (54)         end
     d_w_low      D       e1 - 2 u_r1 < z_1 - chi z_2 (54)
     c_w_low      C       e1 - 2 u_r1 < z_1 - chi z_2 (59)
     d_r_low      D       e2 - 2 u_r2 < chi (z_2 - z_1)  (54)
     gamma_r_low  Gamma   e2 - 2 u_r2 < chi (z_2 - z_1)  (57)

   Where t_a < 0 the stick phase is the stretch from t_a to 0.  The extremes are the roots of derivatives: closed forms
   in D, Gamma and C; in phase H every stretch of time is excluded by enclosures or narrowed down to one root of the
   acceleration, so that none is missed. */
#ifndef STICKSLIP_MOTION_MARGINS_H
#define STICKSLIP_MOTION_MARGINS_H

#include "dynamics.h"

/* Those behind the first N_CONDITIONS, which are those of DYN_CONDITIONS. */
#define DYN_MORE_MARGINS(M)                                                                                            \
  M(D_W, "d_w", PHASE_D)                                                                                               \
  M(D_W_LOW, "d_w_low", PHASE_D)                                                                                       \
  M(C_W_LOW, "c_w_low", PHASE_C)                                                                                       \
  M(D_R_LOW, "d_r_low", PHASE_D)                                                                                       \
  M(GAMMA_R_LOW, "gamma_r_low", PHASE_GAMMA)
#define MARGIN(name, id, phase) MARGIN_##name,
enum { MARGIN_BEFORE = N_CONDITIONS - 1, DYN_MORE_MARGINS(MARGIN) N_MARGINS };
#undef MARGIN

/* Where in its phase a margin is attained; WHERE_OPEN when enclosures cannot tell. */
enum dyn_where { WHERE_START, WHERE_END, WHERE_INSIDE, WHERE_THROUGHOUT, WHERE_OPEN };
extern const char *const dyn_where_name[]; /* "start", "end", "inside", "throughout", "open" */

struct dyn_margin {
  const char *id;
  enum phase phase;
  arb_t margin;
  arb_t time; /* where it is attained, from the start of the period */
  enum dyn_where where;
  bool by_definition; /* exactly zero, at the end of the phase where it must be */
  int order;          /* then: order and value of the first derivative into the phase that is not zero (order 0: not */
  arb_t rate;         /* told); t running away from the end at which the margin is zero */
  truth holds;
};

struct dyn_margins {
  struct dyn_margin at[N_MARGINS];
  bool spent;               /* phase H could not be looked through: no precision helps */
  arb_t u_r1_min, u_r2_min; /* (e1 - least w)/2 over D and C, (e2 - least chi r)/2 over D and Gamma, ends included */
};

void dyn_margins_init(struct dyn_margins *m);
void dyn_margins_clear(struct dyn_margins *m);

/* model: chi, eta, V.  u_r1, u_r2: the static friction forces, or NULL.  Without them a lower bound has the margin that
   u_r = 0 would give, to which 2 u_r is to be added, and holds is TRUTH_UNKNOWN.  prec: working precision; the
   enclosures are as narrow as those of the orbit allow.  SS_UNABLE when the orbit's enclosures are too wide to work
   with, or phase H has so many oscillations that DYN_MARGIN_PIECES of it, half a second, are not enough. */
enum { DYN_MARGIN_PIECES = 1 << 16 };
int dyn_margins_find(struct dyn_margins *m, const fmpq *model, const struct dyn_orbit *orbit, const fmpq *u_r1,
                     const fmpq *u_r2, slong prec);

#endif
