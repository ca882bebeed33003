/* The Poincare map and the periodic orbit as a careful programmer writes them by hand: C, double, textbook Newton from
   a rough guess, no search for first events, nothing checked.  What the suite's own speed is measured against.

   The map leads from r = z_2 - z_1 at the end of the stick phase (w = z_1 - chi z_2 = e1, both velocities V) to r at
   the next one. */
#ifndef STICKSLIP_BENCH_YARDSTICK_H
#define STICKSLIP_BENCH_YARDSTICK_H

/* What the parameters fix: chi, eta, V, e1, e2 in the order of dynamics.h. */
struct yardstick {
  double chi, V, e1, rb, pull_b;    /* r and chi eta r at the end of the slip-stick phase */
  double a, stiff, omc, om[2];      /* a = (1 - chi) V, the speed of w while both masses stick */
  double above, below, cross, back; /* the slow mode's projector [above, cross; back, below] */
};
/* One pass; sines and cosines of the times, from which derivatives are made, stay. */
struct yardstick_pass {
  double r, tb, tc, td, r_end;
  double pb, wb;                     /* z_1' - V and w at the end of the slip-stick phase */
  double pc, wc, rc, qc;             /* z_1' - V, w, r, z_2' - V at the end of the slip phase */
  double pc_tb, wc_tb, rc_tb, qc_tb; /* their derivatives by t_b at fixed t_c */
};

void yardstick_init(struct yardstick *k, const double *params);
/* Everything at a pair of times. */
void yardstick_at(struct yardstick_pass *s, const struct yardstick *k, double tb, double tc);
/* The map; hint: t_b and t_c roughly.  Returns Newton's steps, or 0 when it does not converge. */
int yardstick_map(struct yardstick_pass *s, const struct yardstick *k, double r, const double hint[2]);
/* The derivative of the positions at the end by those at the start, from a pass made by yardstick_at. */
void yardstick_jacobian(double j[4], const struct yardstick_pass *s, const struct yardstick *k);
/* The periodic orbit near t_b, t_c, by Newton's iteration in both; r is what t_b makes it.  Returns its steps, or 0. */
int yardstick_orbit(struct yardstick_pass *s, const struct yardstick *k, double tb, double tc);
/* The slope of the return map of r, which is the trace of its Jacobian, from a pass made by yardstick_at. */
double yardstick_trace(const struct yardstick_pass *s, const struct yardstick *k);

#endif
