/* The two equations of a periodic orbit in the unknowns (t_b, t_c), over balls (a calc of num_arb) or over types that
   behave as balls do (dual.h): z_1' = V at the end of phase H, and r at the end of phase C = the r that leads to t_b.
   And proofs about the motion between: which roots are first, which velocity stays below the belt's. */
#ifndef STICKSLIP_MAP_BALLS_H
#define STICKSLIP_MAP_BALLS_H

#include "mode_motion.h"
#include "turn.h"

struct ball_params {
  val p[N_PARAMS];
  val a, zero, one, two, stiff, omega; /* a = (1 - chi) V, stiff = chi eta, omega its root */
  struct spectrum spectrum;
  bool kept; /* passes near (near_tb, near_tc), which are exact, turn the sines and cosines there */
  val near_tb, near_tc;
  struct turn turn_b, turn_c[2];
};
/* Velocities and forces f = (w, chi eta r). */
struct moving {
  val v[2], f[2];
};
/* Phase Gamma up to t_b, whose sine and cosine these are: z_1' - V and w at its end, how far r has risen, r at the
   stick phase; where phase H begins, and how that moves with t_b, r_b = e2/chi being fixed. */
struct ball_slide {
  val sine, cosine, pb, wb, rise, r;
  struct moving at, by_tb;
};
/* A motion of phase H: velocity of mass m = sum over i of a[m][i] cos(om[i] t) - b[m][i] sin(om[i] t). */
struct ball_modes {
  val a[2][2], b[2][2];
};
/* Everything about a pair (t_b, t_c); names as in struct pass. */
struct ball_pass {
  val tb, tc, pb, wb, rise, r;
  val wc, rc, pc, qc, r_end, defect;
  val pc_tb, qc_tb, pull_tb; /* derivatives by t_b; pull = chi eta r_c.  That of pc by t_c is -wc */
  val r_end_tb;              /* which, over pb, is the slope of the map of r where pc = 0 */
  val defect_tb, defect_tc;
  struct ball_modes modes;
  bool up; /* phase C ends at a maximum of r: q > 0 in it */
};
void ball_params_init(struct ball_params *m, struct calc *c, const fmpq *params);
/* The same from elements, which must outlive m. */
void ball_params_make(struct ball_params *m, struct calc *c, const val p[N_PARAMS]);
/* From chi, eta, V and such elements. */
void ball_params_with(struct ball_params *m, struct calc *c, const fmpq *model, val e1, val e2);
/* Keeps the sines and cosines at (tb, tc) for passes with the same calc.  Without this each pass makes its own. */
void ball_params_keep(struct ball_params *m, struct calc *c, val tb, val tc);
void ball_slide_make(struct ball_slide *g, struct calc *c, const struct ball_params *m, val tb);
void ball_pass_make(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc, bool up);
/* The part of it up to phase H at the time tc, whether or not phase C can follow: r_end and the defect are not set. */
void ball_pass_slip(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc);
/* The rest of it. */
void ball_pass_turn(struct ball_pass *s, struct calc *c, const struct ball_params *m, bool up);
/* z_1 and z_2 from w and r. */
void ball_positions(val z[2], struct calc *c, const struct ball_params *m, val w, val r);
/* How far r rises in time t of phase Gamma, and when it is at its first crest. */
val ball_rise(struct calc *c, const struct ball_params *m, val t);
val ball_crest(struct calc *c, const struct ball_params *m);
/* Whether t_b > 0 is the first root of phase Gamma, and whether it comes before the first crest of the rise. */
truth ball_first_rise(struct calc *c, const struct ball_params *m, const struct ball_pass *s, truth *before_crest);
/* z_mass' - V along phase H of the pass. */
struct harmonic ball_speed(struct calc *c, const struct ball_params *m, const struct ball_pass *s, int mass);
/* Whether the mass (0, 1) is slower than the belt all along phase H of the pass, and m2 at its end too: t_c is the
   first root of m1's velocity.  At most max_steps. */
truth ball_slower(struct calc *c, const struct ball_params *m, const struct ball_pass *s, int mass, long max_steps);
/* Where z_1' = V and z_1'' = 0 at t_c: whether z_1' < V for 0 < t < t_c.  It is so near t_c, as far back as z_1''' < 0;
   TRUE or UNKNOWN. */
truth ball_touches(struct calc *c, const struct ball_params *m, const struct ball_pass *s, long max_steps);
/* A time near the first root of z_1' - V in phase H, found by the same steps; false where there is none. */
bool ball_first_root(double *t, struct calc *c, const struct ball_params *m, const struct ball_pass *s, long max_steps);

#endif
