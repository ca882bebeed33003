/* Curves of orbits, for bifurcate.c and what else follows an orbit through parameters.

   tube    one orbit over a box of parameters: existence and uniqueness by Krawczyk's operator
   curve   the two equations along a line in parameter space, and the functions whose zeros are bifurcations
   trace   a curve followed in double precision */
#ifndef STICKSLIP_CURVE_H
#define STICKSLIP_CURVE_H

#include "bifurcate.h"
#include "motion/dual.h"
#include "motion/map_balls.h"
#include "num/flint_more.h"

/* --- tube.c --- */

/* For each point of the balls p exactly one solution (t_b, t_c) in the box; all of them lie in x.  Zeros are a tube. */
struct tube {
  arb_struct p[N_PARAMS], x[2], box[2];
  bool up;
};
void tube_clear(struct tube *t);
void tube_set(struct tube *t, const struct tube *s);
/* The proof around x, from which Newton's iteration starts. */
int tube_prove(struct tube *t, slong prec);
/* d(t_b, t_c)/d param over a pass in duals; false where the Jacobian cannot be inverted. */
bool tube_motion(arb_mat_t dx, const struct ball_pass *s, int param, slong prec);
/* About how far t_b and t_c move over the ball of one parameter. */
double tube_reach(const struct tube *t, int param, slong prec);
/* What is known about the orbits of the tube, over all of its parameters; word as dyn_orbit_judge returns it. */
int tube_orbit(struct dyn_orbit *o, truth *word, const struct tube *t, slong prec);

/* Of a tube at whose orbit z_1'' = 0 at t_c: whether z_1' < V up to t_c. */
truth tube_touches(const struct tube *t, slong prec);

/* The same numbers, some of them narrower, by mean value forms over the parameters. */
void tube_sharpen(struct dyn_orbit *o, const struct tube *t, slong prec);

/* --- curve.c --- */

struct curve {
  const struct dyn_line *line;
  arb_struct p[N_PARAMS]; /* that which varies is not used */
  bool up;
  slong crest; /* t_b lies in this period of phase Gamma, from 0 */
  slong prec;  /* of everything about it */
};
void curve_init(struct curve *b, const struct dyn_line *line, bool up, double tb, slong prec);
void curve_clear(struct curve *b);

/* Everything at x = (parameter, t_b, t_c), with slopes. */
struct view {
  struct calc c;
  struct ball_params m;
  struct ball_pass s;
  const struct curve *curve;
};
int view_open(struct view *v, const struct curve *b, arb_srcptr x);
void view_clear(struct view *v);
/* The function of a change, a dual; time: that of the touch, for h_v1 and h_v2.  NULL when it is not defined there. */
val view_change(struct view *v, enum dyn_change what, const arb_t time);
/* The slope of a dual along the curve's parameter (0), t_b (1), t_c (2). */
arb_srcptr view_slope(const struct view *v, val f, int i);
/* A time at which z_1'' (h_v1) or z_2'' (h_v2) vanishes, near time: Newton's iteration to the midpoint; or, proved for
   all of the view's balls, an enclosure. */
int view_touch(arb_t time, struct view *v, enum dyn_change what, bool prove);
/* Krawczyk's operator for the two equations and the change as the third: x is the only zero in a ball around its
   midpoint, and is enclosed. */
int curve_prove_zero(arb_ptr x, const struct curve *b, enum dyn_change what);
/* Newton's iteration for the same from the midpoints of x; time is followed. */
int curve_newton(arb_ptr x, arb_t time, const struct curve *b, enum dyn_change what);
/* d f / d parameter along the curve, df/dp + (df/dt_b, df/dt_c) . d(t_b, t_c)/dp, over the ball x; SS_UNABLE where it
   may turn. */
int curve_rate(arb_t rate, struct view *v, val f);

/* --- trace.c --- */

struct spot {
  double x[3], tangent[3]; /* parameter over the length of the line; tangent of length 1 */
  double change[N_CHANGES], time[N_CHANGES];
  bool known[N_CHANGES];
};
struct crossing {
  enum dyn_change what;
  double x[3], time, along;
};
struct trace {
  const struct curve *curve;
  double low, high; /* of the parameter */
  struct spot now;
  double step, sense; /* sense: the direction along the cross product of the gradients */
};
/* From x, a solution: false when nothing can be evaluated there. */
bool trace_start(struct trace *t, const struct curve *b, const double x[3], double low, double high, int sense);
/* The next spot; false when the curve is lost. */
bool trace_step(struct trace *t);
/* The *n crossings between two spots, in order, up to the one that ends the branch, if any does.  *missed counts those
   that could not be found; false when one that ends the branch could not. */
bool trace_crossings(struct crossing out[N_CHANGES], int *n, slong *missed, const struct trace *t, const struct spot *a,
                     const struct spot *b);
/* Whether the solution x lies on the curve between two neighbouring spots. */
bool trace_passes(const struct trace *t, const struct spot *a, const struct spot *b, const double x[3]);
#endif
