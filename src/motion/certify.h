/* The proof of a periodic orbit: that it exists and is the only one in a box, that each of its phases ends at the first
   event, whether each condition of a realistic orbit holds, and on which side of 1 the modulus of its multiplier lies.

   existence   Krawczyk's operator on the four equations of given.h maps a box of the four unknown quantities into its
               own interior: the box holds exactly one solution.  The orbit's own enclosures must lie in it.
   first events
               D: the switching function w - e1 is affine.  Gamma: chi r - e2 starts at -chi (rise until t_b) < 0 and
               has its maxima in closed form; t_b lies beyond the highest one before, on a rising part.  H: z_1' - V
               starts at p_b < 0; a walk whose steps a bound of the second derivative limits stays below zero up to a
               neighbourhood of t_c in which the derivative is positive.  C: z_2' - V is one sine wave, which has no
               root in the phase when 0 < omega t_d < pi and z_2' != V at its start.
   conditions  Two routes must agree: the closed forms and walks by which the orbit was judged, and the margins of
               margins.h.  Where a condition is an equality at an end of its phase that zero is factored out: its first
               derivative there that is not zero has the sign that the condition needs.
   stability   the sign of |tr J| - 1.

   A double root (grazing), two events at one time, a condition or |tr J| on its very bound: enclosures never tell, the
   precision ends, and the orbit is not certified. */
#ifndef STICKSLIP_MOTION_CERTIFY_H
#define STICKSLIP_MOTION_CERTIFY_H

#include "given.h"
#include "margins.h"

/* What the orbits were asked for: chi, eta, V, two known quantities, and the static frictions or NULL.  Borrowed. */
struct dyn_question {
  const fmpq *model, *value;
  const enum dyn_quantity *which;
  const fmpq *u_r[2];
};

/* A bit for each thing that a proof consists of. */
enum {
  OPEN_ROOT = 1,     /* existence and uniqueness; then nothing else is tried */
  OPEN_SAME = 2,     /* the orbit's enclosures do not lie in the box */
  OPEN_DOMAIN = 4,   /* e1, e2, t_b, t_c > 0 or 0 < omega t_d < pi */
  OPEN_STABLE = 8,   /* the sign of |tr J| - 1 */
  OPEN_FIRST = 16,   /* << phase: the first event */
  OPEN_U_R = 256,    /* << 0, 1: u_r1, u_r2 */
  OPEN_HOLDS = 1024, /* << condition */
};

struct dyn_certificate {
  bool certified;
  slong bits;    /* the working precision at which everything was settled, or the last one tried */
  unsigned open; /* what was not settled: OPEN_... */
  bool spent;    /* work rather than precision was short */
  arb_t box[N_QUANTITIES], box_z10, box_z20; /* exactly one solution; known quantities are points or their rounding */
  truth stable, admissible, first[N_PHASES], holds[N_CONDITIONS], u_r[2];
};

/* The precisions tried: DYN_CERTIFY_FIRST bits, doubled while something is undecided, at most DYN_CERTIFY_LAST. */
enum { DYN_CERTIFY_FIRST = 64, DYN_CERTIFY_LAST = 4096 };

void dyn_certificate_clear(struct dyn_certificate *z);

/* Proves what can be proved of an orbit that dyn_orbits_find or dyn_orbits_given gave for the question.  Cost at the
   paper's parameters: less than a millisecond. */
void dyn_certify(struct dyn_certificate *z, const struct dyn_question *q, const struct dyn_orbit *orbit);
/* The largest radius of the enclosures of z10, z20, t_a ... t_d, e1, e2, the period, the trace, u_r1_min and
   u_r2_min. */
void dyn_orbit_radius(mag_t radius, const struct dyn_orbit *orbit);
/* Appends the names of what is open, separated by commas: "t_c not proved to be the first event of H, ...". */
void dyn_certificate_why(struct text *out, const struct dyn_certificate *z);

#endif
