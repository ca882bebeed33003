/* Sines and cosines of angles near one whose sine and cosine are kept: some terms of a series in place of new ones. */
#ifndef STICKSLIP_TURN_H
#define STICKSLIP_TURN_H

#include "num/calc.h"

/* The sine and cosine of a kept angle. */
struct turn {
  val sine, cosine;
};
/* sin x and 1 - cos x; by Taylor's series when |x| <= 1/4. */
void turn_small(val *sine, val *versine, struct calc *c, val x);
/* The sine and cosine of the kept angle plus x. */
void turn_by(val *sine, val *cosine, struct calc *c, const struct turn *from, val x);

#endif
