/* The closed form of a motion within one pair of modes (coulomb.h): each restoring force f_1 = x_1 - chi x_2,
   f_2 = chi (x_2 - x_1) and each p_i = x_i' - V is a constant, a drift and at most two oscillations.  The law looks at
   these four alone.  Elements are those of the calc; a difference of two motions is a motion with V = 0. */
#ifndef STICKSLIP_MODE_MOTION_H
#define STICKSLIP_MODE_MOTION_H

#include "flow.h"
#include "trig_sum.h"

/* f(t) = start + drift t + sum over k < n of cs_k (cos(om_k t) - 1) + sn_k sin(om_k t), as struct trig_sum. */
struct harmonic {
  int n;
  val start, drift, om[2], cs[2], sn[2];
};
/* An oscillation at a moment: the sine and the versine, 1 minus the cosine. */
struct angle {
  val sine, versine;
};
/* Those of a curve at t; all four curves of a motion share them. */
void harmonic_angles(struct angle angle[2], struct calc *c, const struct harmonic *f, val t);
/* The curve and its derivatives. */
val harmonic_value(struct calc *c, const struct harmonic *f, const struct angle angle[2], val t);
val harmonic_rate(struct calc *c, const struct harmonic *f, const struct angle angle[2]);
val harmonic_bend(struct calc *c, const struct harmonic *f, const struct angle angle[2]);
/* Its negative where side is negative. */
struct harmonic harmonic_sided(struct calc *c, const struct harmonic *f, int side);
struct trig_sum harmonic_trig_sum(const struct calc *c, const struct harmonic *f);
/* Newton's iteration for a root (order 0) or for an extremum (order 1), until half of the bits are settled before the
   last step. */
val harmonic_newton(struct calc *c, const struct harmonic *f, val start, int order);

/* What the parameters fix: gap = (1 - chi) V, omega^2 = chi eta. */
struct motion_law {
  val chi, eta, V, gap, omega, zero;
  struct spectrum spectrum;
};
/* slip: with the spectrum, without which both masses cannot slip at once. */
void motion_law_make(struct motion_law *law, struct calc *c, val chi, val eta, val V, bool slip);

struct motion {
  struct harmonic force[2], speed[2]; /* f_i, up to any constant, and p_i */
};
/* Where it begins: forces, p_i, and u_i - f_i with the friction u_i of a slipping mass. */
struct motion_start {
  val force[2], slip[2], pull[2];
};
/* slips: which of the masses do. */
void motion_make(struct motion *m, struct calc *c, const struct motion_law *law, const int slips[2],
                 const struct motion_start *at);
/* f_1, f_2, p_1, p_2 at a time. */
void motion_at(val out[N_STATE], struct calc *c, const struct motion *m, val t);

#endif
