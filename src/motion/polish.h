/* The outputs at the orbit near (t_b, t_c), and those of one pass of the return map, by the formulas of slip.h with
   numbers of twice the precision.

   What cancels loses digits there that double precision would have needed: the radius against the rise near a fold, the
   sums of the modes after a long phase H, positions over 1 - chi.  All is evaluated once, at t_b and t_c in double
   precision; Newton's step from there is so short that every quantity follows it to the first order.  Each output is
   rounded once.  Straight-line code, for the scalar solver and for lanes. */
#ifndef STICKSLIP_POLISH_H
#define STICKSLIP_POLISH_H

#include "return_map.h"
#include "slip.h"
#include "warm.h"

#define POLISH_REACH 0x1p-36 /* of t_b and t_c: what is of the second order in such a step is rounding */

/* struct slip, gamma_end, half angles and node in twice the precision; names as there. */
struct fine_slip {
  struct dd chi, V, e1, rb, pull_b, a, ease, soft, omc, om[2], inverse[2], own[2], sigma[2], lead, drag, cross;
};

/* At (t_b, t_c), and after the step there; what has _tb is the derivative by t_b. */
struct fine_state {
  struct dd tb, tc;
  struct dd rise, p, w, dw, versine, sine;       /* at the end of phase Gamma, and of t_b */
  struct dd change_p, change_w, q, pull, behind; /* at the end of phase H */
  struct dd r_end, q_tb, pull_tb, turn_tb;       /* turn_tb: r_end by t_b, times r_end */
  double p_tb, w_tb, behind_tb, q_tbtb, pull_tbtb;
  double step[2];
};

SINCOS_INLINE struct dd dd_sum_of_products(struct dd a, struct dd b, struct dd c, struct dd d) {
  return dd_add(dd_mul(a, b), dd_mul(c, d));
}

/* As slip_set, operation by operation. */
SINCOS_INLINE void fine_set(struct fine_slip *k, const double p[N_PARAMS]) {
  struct dd one = dd_of(1), chi = dd_of(p[P_CHI]), ease = dd_sum(1, -p[P_CHI]);
  struct dd stiff = dd_mul(chi, dd_of(p[P_ETA])), couple = dd_mul(chi, stiff), lead = dd_sub(stiff, one);
  bool up = lead.high > 0;
  struct dd gap = dd_sqrt(dd_add(dd_mul(lead, lead), dd_scale(couple, 4)));
  struct dd large = dd_scale(dd_add(gap, dd_choose(up, lead, dd_neg(lead))), 0.5), small = dd_div(couple, large);
  struct dd above = dd_choose(up, large, small), below = dd_choose(up, small, large), top = dd_add(one, above);
  struct dd per_gap = dd_div(one, gap), per_chi = dd_div(one, chi);
  k->chi = chi;
  k->V = dd_of(p[P_V]);
  k->e1 = dd_of(p[P_E1]);
  k->rb = dd_mul(dd_of(p[P_E2]), per_chi);
  k->pull_b = dd_mul(dd_of(p[P_ETA]), dd_of(p[P_E2]));
  k->ease = ease;
  k->a = dd_mul(ease, k->V);
  k->soft = dd_div(one, stiff);
  k->omc = dd_sqrt(stiff);
  k->om[0] = dd_sqrt(dd_div(dd_mul(stiff, ease), top));
  k->om[1] = dd_sqrt(top);
  for (int i = 0; i < 2; i++) k->inverse[i] = dd_div(one, k->om[i]);
  k->own[0] = dd_mul(above, per_gap);
  k->own[1] = dd_mul(below, per_gap);
  k->cross = dd_mul(chi, per_gap);
  k->lead = dd_mul(dd_add(above, chi), per_gap);
  k->drag = dd_div(k->a, top);
  k->sigma[0] = dd_mul(below, per_chi);
  k->sigma[1] = dd_neg(dd_mul(above, per_chi));
}

/* Phase Gamma.  x - sin x from the half angle h: h - sin h and the versine of h do not cancel below pi/2. */
SINCOS_INLINE void fine_gamma(struct fine_state *x, const struct fine_slip *k) {
  struct dd_turn h = dd_turn(dd_scale(x->tb, 0.5));
  x->sine = dd_scale(dd_mul(h.sine, h.cosine), 2);
  x->versine = dd_scale(dd_mul(h.sine, h.sine), 2);
  struct dd turned = dd_scale(dd_add(h.excess, dd_mul(h.sine, h.versine)), 2);
  struct dd swing = dd_scale(dd_mul(h.sine, dd_sum_of_products(k->a, h.sine, k->e1, h.cosine)), 2);
  x->rise = dd_sum_of_products(k->a, turned, k->e1, x->versine);
  x->p = dd_neg(swing);
  x->w = dd_sum_of_products(k->e1, dd_sub(dd_of(1), x->versine), k->a, x->sine);
  x->dw = dd_sub(k->a, swing);
}

/* One oscillation of phase H, added to the state. */
SINCOS_INLINE void fine_mode(struct fine_state *x, const struct fine_slip *k, int i, struct dd a, struct dd b) {
  struct dd om = k->om[i], sigma = k->sigma[i];
  struct dd_turn h = dd_turn(dd_scale(dd_mul(om, x->tc), 0.5));
  struct dd sine = dd_scale(dd_mul(h.sine, h.cosine), 2), versine = dd_scale(dd_mul(h.sine, h.sine), 2);
  struct dd cosine = dd_sub(dd_of(1), versine);
  struct dd speed = dd_sum_of_products(a, versine, b, sine), swing = dd_sum_of_products(a, sine, dd_neg(b), versine);
  struct dd force = dd_mul(om, swing);
  x->change_p = dd_add(x->change_p, speed);
  x->change_w = dd_add(x->change_w, force);
  x->q = dd_sub(x->q, dd_mul(sigma, speed));
  x->pull = dd_add(x->pull, dd_mul(sigma, force));
  x->behind = dd_sub(x->behind, dd_mul(swing, k->inverse[i]));
  struct dd a_tb = dd_neg(dd_mul(k->own[i], x->w)), b_tb = dd_mul(dd_mul(k->own[i], x->dw), k->inverse[i]);
  struct dd speed_tb = dd_sum_of_products(a_tb, cosine, dd_neg(b_tb), sine);
  struct dd force_tb = dd_mul(om, dd_sum_of_products(a_tb, sine, b_tb, cosine));
  x->q_tb = dd_add(x->q_tb, dd_mul(sigma, speed_tb));
  x->pull_tb = dd_add(x->pull_tb, dd_mul(sigma, force_tb));

  double own = k->own[i].high, per = k->inverse[i].high, s = sine.high, c = cosine.high;
  double a_tbtb = -own * x->dw.high, b_tbtb = -own * x->w.high * per;
  x->p_tb += speed_tb.high;
  x->w_tb += force_tb.high;
  x->behind_tb -= (a_tb.high * s - b_tb.high * versine.high) * per;
  x->q_tbtb += sigma.high * (a_tbtb * c - b_tbtb * s);
  x->pull_tbtb += sigma.high * om.high * (a_tbtb * s + b_tbtb * c);
}

/* Everything at (t_b, t_c) but the step. */
SINCOS_INLINE void fine_evaluate(struct fine_state *x, const struct fine_slip *k) {
  fine_gamma(x, k);
  struct dd zero = dd_of(0), push = dd_mul(k->cross, k->pull_b);
  x->change_p = x->change_w = x->q = x->q_tb = x->pull_tb = zero;
  x->pull = k->pull_b;
  x->behind = dd_add(x->rise, dd_mul(k->V, x->tc));
  x->p_tb = x->w_tb = x->q_tbtb = x->pull_tbtb = 0;
  x->behind_tb = -x->p.high;
  fine_mode(x, k, 0, dd_sum_of_products(k->own[0], x->p, k->lead, k->V),
            dd_mul(dd_add(dd_mul(k->own[0], x->w), push), k->inverse[0]));
  fine_mode(x, k, 1, dd_mul(k->own[1], dd_add(x->p, k->drag)),
            dd_mul(dd_sub(dd_mul(k->own[1], x->w), push), k->inverse[1]));
  struct dd r = dd_mul(x->pull, k->soft), radius = dd_sqrt(dd_add(dd_mul(r, r), dd_mul(dd_mul(x->q, x->q), k->soft)));
  x->r_end = dd_choose(x->q.high > 0, radius, dd_neg(radius));
  x->turn_tb = dd_mul(k->soft, dd_sum_of_products(r, x->pull_tb, x->q, x->q_tb));
}

/* Newton's step to the orbit. */
SINCOS_INLINE void fine_step(struct fine_state *x, const struct fine_slip *k) {
  struct dd r = dd_mul(x->pull, k->soft);
  double p = dd_sub(x->p, x->change_p).high, w = x->w.high + x->change_w.high;
  double defect = dd_add(dd_sub(x->r_end, k->rb), x->rise).high, per = 1 / x->r_end.high;
  double defect_tb = x->turn_tb.high * per - x->p.high, defect_tc = -r.high * p * per;
  slip_newton(x->step, p, w, x->p_tb, defect, defect_tb, defect_tc);
}

/* Follows the step, but for r_end.  At its end z_1' = V, so that neither r_end nor `behind` changes with t_c. */
SINCOS_INLINE void fine_follow(struct fine_state *x, const struct fine_slip *k) {
  double b = x->step[0], c = x->step[1], soft = k->soft.high, stiff = k->omc.high * k->omc.high;
  double q = x->q.high, pull = x->pull.high, q_tb = x->q_tb.high, pull_tb = x->pull_tb.high;
  double by_tb = soft * (pull_tb * pull_tb + pull * x->pull_tbtb) + (q_tb * q_tb + q * x->q_tbtb);
  double by_tc = -pull * x->p_tb;
  x->tb = dd_add(x->tb, dd_of(b));
  x->tc = dd_add(x->tc, dd_of(c));
  x->turn_tb = dd_add(x->turn_tb, dd_of(soft * (by_tb * b + by_tc * c)));
  x->q = dd_add(x->q, dd_of(q_tb * b - pull * c));
  x->pull = dd_add(x->pull, dd_of(pull_tb * b + stiff * q * c));
  x->change_w = dd_add(x->change_w, dd_of((x->w_tb - x->dw.high) * b + (k->a.high - k->chi.high * q) * c));
  x->behind = dd_add(x->behind, dd_of(x->behind_tb * b));
  double p = x->p.high, w = x->w.high, dw = x->dw.high;
  x->versine = dd_add(x->versine, dd_of(x->sine.high * b));
  x->sine = dd_add(x->sine, dd_of((1 - x->versine.high) * b));
  x->rise = dd_add(x->rise, dd_of(-p * b));
  x->p = dd_add(x->p, dd_of(-w * b));
  x->w = dd_add(x->w, dd_of(dw * b));
}

/* The greatest e1 - w in phase C: at an end, or where w' = a - chi q vanishes at the angle u before the end. */
SINCOS_INLINE struct dd fine_most(const struct fine_state *x, const struct fine_slip *k, struct dd turn, struct dd ta) {
  struct dd start = dd_sub(dd_sub(dd_mul(k->e1, x->versine), dd_mul(k->a, x->sine)), x->change_w),
            end = dd_mul(k->a, ta);
  struct dd most = dd_choose(start.high > end.high, start, end);
  struct dd fast = dd_mul(dd_mul(k->chi, k->omc), x->r_end);
  bool inner = fast.high > k->a.high;
  struct dd square = dd_mul(dd_sub(fast, k->a), dd_add(fast, k->a));
  struct dd root = dd_sqrt(dd_choose(inner, square, dd_of(1))), u = dd_angle(k->a, root);
  struct dd bend = dd_mul(k->a, dd_sub(u, dd_div(k->a, dd_add(fast, root))));
  struct dd valley = dd_add(end, dd_div(bend, k->omc));
  bool in_valley = inner & (u.high < turn.high) & (valley.high > most.high);
  return dd_choose(in_valley, valley, most);
}

/* The angle of phase C. */
SINCOS_INLINE struct dd fine_turn(const struct fine_state *x, const struct fine_slip *k) {
  struct dd across = dd_mul(k->omc, dd_mul(x->pull, k->soft));
  bool up = x->q.high > 0;
  return dd_angle(dd_choose(up, x->q, dd_neg(x->q)), dd_choose(up, across, dd_neg(across)));
}

SINCOS_INLINE void fine_outputs(double out[N_DYN_OUT], const struct fine_state *x, const struct fine_slip *k) {
  struct dd turn = fine_turn(x, k);
  struct dd td = dd_div(turn, k->omc), period = dd_div(x->behind, k->V);
  struct dd ta = dd_sub(dd_sub(period, dd_add(x->tb, x->tc)), td), way = dd_mul(k->V, ta);
  struct dd most = fine_most(x, k, turn, ta);
  out[DYN_OUT_Z10] = dd_sub(dd_div(dd_add(k->e1, dd_mul(k->chi, x->r_end)), k->ease), way).high;
  out[DYN_OUT_Z20] = dd_sub(dd_div(dd_add(k->e1, x->r_end), k->ease), way).high;
  out[DYN_OUT_TA] = ta.high;
  out[DYN_OUT_TB] = x->tb.high;
  out[DYN_OUT_TC] = x->tc.high;
  out[DYN_OUT_TD] = td.high;
  out[DYN_OUT_PERIOD] = period.high;
  out[DYN_OUT_TRACE] = dd_div(x->turn_tb, dd_mul(x->r_end, x->p)).high;
  out[DYN_OUT_U1] = most.high > 0 ? 0.5 * most.high : 0;
  out[DYN_OUT_U2] = 0.5 * dd_mul(k->chi, x->rise).high;
}

/* From t_b and t_c in double precision.  False where they are too far off, or a number is none. */
SINCOS_INLINE bool polish(double out[N_DYN_OUT], const double params[N_PARAMS], double tb, double tc) {
  struct fine_slip k;
  struct fine_state x = {.tb = dd_of(tb), .tc = dd_of(tc)};
  fine_set(&k, params);
  fine_evaluate(&x, &k);
  fine_step(&x, &k);
  bool ok = (fabs(x.step[0]) < POLISH_REACH * tb) & (fabs(x.step[1]) < POLISH_REACH * tc);
  fine_follow(&x, &k);
  x.r_end = dd_sub(k.rb, x.rise);
  fine_outputs(out, &x, &k);
  double none = 0; /* unless an output is infinite or NaN */
  for (int i = 0; i < N_DYN_OUT; i++) none += 0 * out[i];
  return ok & (none == 0);
}

/* The step to the pass from r: the rise of phase Gamma is r_b - r. */
SINCOS_INLINE void fine_step_from(struct fine_state *x, const struct fine_slip *k, double r) {
  double above = dd_sub(x->rise, dd_sub(k->rb, dd_of(r))).high, p = dd_sub(x->p, x->change_p).high;
  x->step[0] = above / x->p.high;
  x->step[1] = (p + x->p_tb * x->step[0]) / (x->w.high + x->change_w.high);
}

/* The return map from r, its events near t_b and t_c in double precision.  False as for polish. */
SINCOS_INLINE bool polish_map(struct dd out[N_RETURN], const double params[N_PARAMS], double r, double tb, double tc) {
  struct fine_slip k;
  struct fine_state x = {.tb = dd_of(tb), .tc = dd_of(tc)};
  fine_set(&k, params);
  fine_evaluate(&x, &k);
  fine_step_from(&x, &k, r);
  bool ok = (fabs(x.step[0]) < POLISH_REACH * tb) & (fabs(x.step[1]) < POLISH_REACH * tc);
  double r_end_tb = x.turn_tb.high / x.r_end.high;
  fine_follow(&x, &k);
  x.r_end = dd_add(x.r_end, dd_of(r_end_tb * x.step[0]));
  struct dd td = dd_div(fine_turn(&x, &k), k.omc), gain = dd_sub(x.r_end, dd_of(r));
  struct dd spent = dd_add(dd_add(x.tb, x.tc), td);
  out[RETURN_TA] = dd_sub(dd_add(dd_div(dd_mul(k.chi, gain), k.a), dd_div(x.behind, k.V)), spent);
  out[RETURN_TB] = x.tb;
  out[RETURN_TC] = x.tc;
  out[RETURN_TD] = td;
  out[RETURN_R] = x.r_end;
  out[RETURN_SLOPE] = dd_div(x.turn_tb, dd_mul(x.r_end, x.p));
  double none = 0;
  for (int i = 0; i < N_RETURN; i++) none += 0 * out[i].high;
  return ok & (none == 0);
}

#endif
