/* Balls that carry their derivatives: a number type on which the formulas of map_balls.c give slopes without a line of
   their own.  A dual is a value and its first derivatives along fixed directions: the parameters, then t_b and t_c.
   Enclosures: over every point of the operands' balls value and derivatives are enclosed.  It has the operations that
   those formulas need. */
#ifndef STICKSLIP_DUAL_H
#define STICKSLIP_DUAL_H

#include "dynamics.h"
#include "num/calc.h"

enum { DIR_TB = N_PARAMS, DIR_TC, N_DIRECTIONS };

struct dual {
  arb_struct v, d[N_DIRECTIONS];
};
extern const struct num_type num_dual;

struct num_ctx dual_ctx(slong prec);
/* x as the variable of a direction; a constant when that is negative. */
val dual_variable(struct calc *c, const arb_t x, int direction);
static inline arb_srcptr dual_value(val x) {
  return &((const struct dual *)x)->v;
}
static inline arb_srcptr dual_slope(val x, int direction) {
  return &((const struct dual *)x)->d[direction];
}

#endif
