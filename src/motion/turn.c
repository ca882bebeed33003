/* Sines and cosines close to angles whose own are kept.

   Near convergence an angle moves by far less than one: turning the pair that is known by the step takes a few terms of
   Taylor's series, where a sine and a cosine from scratch take hundreds of products.  In balls the series is cut where
   the first term left out, which bounds the rest of an alternating series, goes into the radius. */
#include "turn.h"

/* Whether |x| <= 1/4, where the terms fall fast. */
static bool small_angle(const struct calc *c, val x) {
  return calc_exponent(c, x) <= -2;
}

/* first - first y/((n+1)(n+2)) + ..., to the calc's precision; a later term of a ball needs fewer bits. */
static val alternating(struct calc *c, val first, val y, ulong n) {
  slong prec = c->ctx.prec, size = calc_exponent(c, first), fall = calc_exponent(c, y);
  val sum = first, term = first;
  for (bool minus = true;; minus = !minus, n += 2) {
    if (c->ctx.type->rigorous) c->ctx.prec = FLINT_MAX(prec + size + fall + 8, 32);
    term = calc_div_ui(c, calc_mul(c, term, y), (n + 1) * (n + 2));
    c->ctx.prec = prec;
    size = calc_exponent(c, term);
    if (size < -prec) return calc_within(c, sum, term);
    sum = minus ? calc_sub(c, sum, term) : calc_add(c, sum, term);
  }
}

void turn_small(val *sine, val *versine, struct calc *c, val x) {
  if (!small_angle(c, x)) {
    val cosine;
    calc_sin_cos(c, sine, &cosine, x);
    *versine = calc_sub(c, calc_d(c, 1), cosine);
    return;
  }
  val y = calc_mul(c, x, x);
  *sine = alternating(c, x, y, 1);
  *versine = alternating(c, calc_div_ui(c, y, 2), y, 2);
}

void turn_by(val *sine, val *cosine, struct calc *c, const struct turn *from, val x) {
  val s, v;
  turn_small(&s, &v, c, x);
  *sine = calc_dot_from(c, from->sine, from->cosine, s, true, from->sine, v);
  *cosine = calc_sub(c, from->cosine, calc_dot(c, from->sine, s, from->cosine, v));
}
