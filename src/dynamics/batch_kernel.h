/* The solver of one lane, and the loop over lanes for one instruction set.

   Everything is straight-line code: conditions become masks, the number of Newton's steps is fixed, and what a branch would
   look into is left open.  Half of the sines and cosines of the steps are moved by the step, those of the outputs are
   made anew.  Included by batch.c once for each instruction set, with BATCH_RUN, BATCH_START and BATCH_PART its
   functions and BATCH_TARGET their attribute; the compiler vectorises the loops (flags in the Makefile). */
#include "batch_impl.h"

#ifndef STICKSLIP_BATCH_KERNEL_H
#define STICKSLIP_BATCH_KERNEL_H

#include "slip.h"
#include "turn.h"

static const double NOISE = 64 * 0x1p-53; /* of the terms of an equation: a step of this size is rounding */
static const double WORST = 0x1p20;       /* times rounding: how far off t_b or t_c may be in relative terms */
static const double PART_ANGLE = 1.25;    /* of the fast oscillation in a part of phase H */
static const double DOUBT = 0x1p-30;      /* relative: what is nearer to zero has no sign */

/* Everything at a pair (t_b, t_c), as in warm.c. */
struct lane {
  struct slip k;
  double tb, tc;
  struct half_angle b, c[2];
  struct gamma_end g;
  struct slip_modes m;
  struct node n;
  double r, r_end, defect;
  double p_tb, radius_tb, defect_tb, defect_tc;
  double step[2];
};

TURN_INLINE struct half_angle lane_half(double x) {
  struct turn t = turn_of(0.5 * x);
  return (struct half_angle){t.sine, t.cosine};
}

TURN_INLINE struct half_angle lane_nudge(struct half_angle x, double off) {
  return (struct half_angle){x.s + (x.c * off - x.s * (0.5 * off * off)), x.c - (x.s * off + x.c * (0.5 * off * off))};
}

/* The half angles at t_b and t_c moved by the steps, which stay unrounded, as what om t lost does. */
TURN_INLINE void lane_place(struct lane *x, const struct half_angle at[3], double step_b, double step_c) {
  const struct slip *k = &x->k;
  x->b = lane_nudge(at[0], 0.5 * step_b);
  for (int i = 0; i < 2; i++)
    x->c[i] = lane_nudge(at[1 + i], 0.5 * (product_rest(k->om[i], x->tc) + k->rest[i] * x->tc + k->om[i] * step_c));
}

TURN_INLINE void lane_turn(struct half_angle at[3], const struct lane *x) {
  at[0] = lane_half(x->tb);
  at[1] = lane_half(x->k.om[0] * x->tc);
  at[2] = lane_half(x->k.om[1] * x->tc);
}

TURN_INLINE void lane_step(struct lane *x) {
  x->tb += x->step[0];
  x->tc += x->step[1];
}

TURN_INLINE void lane_move(struct lane *x) {
  lane_step(x);
  x->b = half_angle_move(x->b, x->step[0]);
  x->c[0] = half_angle_move(x->c[0], x->k.om[0] * x->step[1]);
  x->c[1] = half_angle_move(x->c[1], x->k.om[1] * x->step[1]);
}

/* The equations, their derivatives and Newton's step. */
TURN_INLINE void lane_evaluate(struct lane *x) {
  const struct slip *k = &x->k;
  x->g = gamma_at(k, x->tb, x->b);
  x->m = slip_modes(k, &x->g);
  struct slip_modes rate = slip_modes_rate(k, &x->g);
  x->n = slip_node(k, &x->m, &x->g, x->c);
  double s0 = full_sine(x->c[0]), c0 = 1 - full_versine(x->c[0]), s1 = full_sine(x->c[1]),
         c1 = 1 - full_versine(x->c[1]);
  double speed0 = rate.a[0] * c0 - rate.b[0] * s0, speed1 = rate.a[1] * c1 - rate.b[1] * s1;
  double force0 = k->om[0] * (rate.a[0] * s0 + rate.b[0] * c0), force1 = k->om[1] * (rate.a[1] * s1 + rate.b[1] * c1);
  double q_tb = k->sigma[0] * speed0 + k->sigma[1] * speed1;
  double r_tb = (k->sigma[0] * force0 + k->sigma[1] * force1) * k->soft, r = x->n.pull * k->soft;
  x->r = k->rb - x->g.rise;
  x->r_end = slip_radius(k, &x->n);
  x->defect = slip_gain(k, &x->n, x->r_end) + x->g.rise;
  x->p_tb = speed0 + speed1;
  double per = 1 / x->r_end;
  x->radius_tb = (r * r_tb + x->n.q * q_tb * k->soft) * per;
  x->defect_tb = x->radius_tb - x->g.p;
  x->defect_tc = -r * x->n.p * per;
  double scale = 1 / (x->p_tb * x->defect_tc + x->n.w * x->defect_tb);
  x->step[0] = -(x->defect_tc * x->n.p + x->n.w * x->defect) * scale;
  x->step[1] = -(x->p_tb * x->defect - x->defect_tb * x->n.p) * scale;
}

/* Another step would be rounding, and rounding leaves digits. */
TURN_INLINE bool lane_converged(const struct lane *x, double guess_b, double guess_c) {
  const struct slip *k = &x->k;
  double reach = fabs(x->n.pull * k->soft) + fabs(x->n.q) / k->omc;
  double size = fabs(x->m.a[0]) + fabs(x->m.b[0]) + fabs(x->m.a[1]) + fabs(x->m.b[1]);
  double off_b = (reach + fabs(x->r) + k->rb + x->g.rise) / fabs(x->defect_tb);
  double off_c = (size + fabs(x->g.p) + fabs(x->p_tb) * off_b) / fabs(x->n.w);
  double step_b = fabs(x->step[0]), step_c = fabs(x->step[1]), far_b = fabs(x->tb - guess_b);
  double far_c = fabs(x->tc - guess_c), q = fabs(x->n.q), radius = fabs(x->r_end);
  bool settled = (step_b <= NOISE * off_b) & (step_c <= NOISE * off_c);
  bool posed = (off_b < WORST * x->tb) & (off_c < WORST * x->tc) & (q > DOUBT * k->V) & (radius > DOUBT * reach);
  bool near = (far_b < 0.5 * guess_b) & (far_c < 0.5 * guess_c) & (x->tb < 2 * PI) & (x->tc * k->om[1] < TURN_REACH);
  return settled & posed & near;
}

/* Half of phase H: both velocities below the belt's. */
struct below {
  bool first, second;
};

TURN_INLINE struct below lane_below(const struct lane *x, const struct node *from, const struct node *to, double h,
                                    bool at_root) {
  double sixth[2], size[2];
  slip_bounds(sixth, size, &x->k, &x->m);
  struct course a = course_1(&x->k, from), b = course_1(&x->k, to), c = course_2(&x->k, from), d = course_2(&x->k, to);
  if (at_root) b.f = 0;
  return (struct below){course_below(&a, &b, h, sixth[0], DOUBT * size[0]),
                        course_below(&c, &d, h, sixth[1], DOUBT * size[1])};
}

/* At half the time the whole angles are the half angles of the end. */
TURN_INLINE struct node lane_middle(const struct lane *x) {
  const struct slip *k = &x->k;
  const struct slip_modes *m = &x->m;
  double v0 = 1 - x->c[0].c, v1 = 1 - x->c[1].c;
  double change0 = m->a[0] * v0 + m->b[0] * x->c[0].s, change1 = m->a[1] * v1 + m->b[1] * x->c[1].s;
  double force0 = k->om[0] * (m->a[0] * x->c[0].s + m->b[0] * x->c[0].c);
  double force1 = k->om[1] * (m->a[1] * x->c[1].s + m->b[1] * x->c[1].c);
  return (struct node){.p = x->g.p - (change0 + change1),
                       .q = -(k->sigma[0] * change0 + k->sigma[1] * change1),
                       .w = force0 + force1,
                       .pull = k->sigma[0] * force0 + k->sigma[1] * force1};
}

/* The ends of the word. */
struct close {
  double td, ta, period;
  double least, most; /* of e1 - w in phase C */
};

/* t_a from two sums, whichever has the smaller terms: what w is short of e1, and the belt's way that m1 is behind.  Inside
   phase C w' = a - chi q vanishes only where q > 0: in a valley at the angle u before the end, and on a hill at pi - u. */
TURN_INLINE struct close lane_close(const struct lane *x) {
  const struct slip *k = &x->k;
  bool up = x->n.q > 0;
  double r = x->n.pull * k->soft, turn = turn_angle(fabs(x->n.q), (up ? k->omc : -k->omc) * r), td = turn / k->omc;
  double both = x->r_end + r, left = x->r_end * r > 0 ? x->n.q * x->n.q * k->soft / both : x->r_end - r;
  double sine = full_sine(x->b), versine = full_versine(x->b), change = x->n.w - x->g.w;
  double short_c = (k->e1 * versine - k->a * sine) - change, slack = short_c + k->chi * left;
  double behind = slip_behind(k, &x->g, &x->m, x->c, x->tc) / k->V, others = x->tb + x->tc;
  double size = k->e1 * versine + k->a * fabs(sine) + fabs(x->n.w) + fabs(x->g.w) + k->chi * (fabs(r) + fabs(x->r_end));
  bool by_force = size < k->a * others;
  double ta = by_force ? slack / k->a - td : (behind - others) - td;
  double period = by_force ? others + slack / k->a : behind;

  double fast = k->chi * k->omc * x->r_end, end = k->a * ta, way = k->a / k->omc;
  double s = fast > k->a ? k->a / fast : 1, c = sqrt((1 - s) * (1 + s)), u = turn_angle(s, c), pull = k->chi * x->r_end;
  double valley = end + (way * u - pull * (s * s / (1 + c))), hill = end + (way * (PI - u) - pull * (1 + c));
  double least = short_c < end ? short_c : end, most = short_c < end ? end : short_c;
  bool in_valley = (fast > k->a) & (u < turn) & (valley > most),
       on_hill = (fast > k->a) & (PI - u < turn) & (hill < least);
  return (struct close){td, ta, period, on_hill ? hill : least, in_valley ? valley : most};
}

TURN_INLINE bool in_domain(const double p[N_PARAMS]) {
  bool in = p[P_CHI] < 1;
  for (int i = 0; i < N_PARAMS; i++) in &= (p[i] > 0) & (p[i] < INFINITY);
  return in;
}

TURN_INLINE void lane_run(struct lanes *l, int j) {
  struct lane x;
  double p[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) p[i] = l->params[i][j];
  slip_set(&x.k, p);
  x.tb = l->guess[0][j];
  x.tc = l->guess[1][j];
  struct half_angle at[3];
  lane_turn(at, &x);
  lane_place(&x, at, 0, 0);
  lane_evaluate(&x);
  lane_move(&x);
  lane_evaluate(&x);
  lane_step(&x);
  lane_turn(at, &x);
  lane_place(&x, at, 0, 0);
  lane_evaluate(&x);
  lane_place(&x, at, x.step[0], x.step[1]);
  lane_step(&x);
  lane_evaluate(&x);

  const struct slip *k = &x.k;
  bool ok = lane_converged(&x, l->guess[0][j], l->guess[1][j]);
  ok &= -x.g.p > DOUBT * (k->a + k->e1) * x.b.s; /* before the first crest of the rise */
  struct node start = slip_start(k, &x.g), middle = lane_middle(&x);
  struct below early = lane_below(&x, &start, &middle, 0.5 * x.tc, false);
  struct below late = lane_below(&x, &middle, &x.n, 0.5 * x.tc, true);
  bool up = x.n.q > 0, below = early.first & late.first & (up | (early.second & late.second));

  struct close e = lane_close(&x);
  double force = k->e1 + fabs(x.n.w) + fabs(k->e1 - k->a * e.ta);
  double doubt_a = DOUBT * (force / k->a + e.period), doubt_w = DOUBT * force;
  ok &= (fabs(e.ta) > doubt_a) & (fabs(e.least) > doubt_w);

  l->out[DYN_OUT_Z10][j] = (k->e1 + k->chi * x.r) / k->ease - k->V * e.ta;
  l->out[DYN_OUT_Z20][j] = (k->e1 + x.r) / k->ease - k->V * e.ta;
  l->out[DYN_OUT_TA][j] = e.ta;
  l->out[DYN_OUT_TB][j] = x.tb;
  l->out[DYN_OUT_TC][j] = x.tc;
  l->out[DYN_OUT_TD][j] = e.td;
  l->out[DYN_OUT_PERIOD][j] = e.period;
  l->out[DYN_OUT_TRACE][j] = x.radius_tb / x.g.p;
  l->out[DYN_OUT_U1][j] = e.most > 0 ? 0.5 * e.most : 0;
  l->out[DYN_OUT_U2][j] = 0.5 * k->chi * x.g.rise;
  double broken = (e.ta < 0 ? 1 << COND_TA : 0) + (e.least < 0 ? 1 << COND_C_W : 0);
  broken += up ? 1 << COND_H_V2 | 1 << COND_C_V2 : 0;
  bool in = in_domain(p);
  ok &= in;
  l->broken[j] = ok ? broken : 0;
  l->status[j] = !in ? SS_DOMAIN : ok & below ? SS_OK : SS_UNABLE;
  l->parts[j] = ok & !below ? (x.tc * k->om[1]) * (1 / PART_ANGLE) + 1 : 0;
}

/* --- A closer look at phase H: in parts, all lanes part by part. --- */

TURN_INLINE void march_start(struct march *m, const struct lanes *l, int j) {
  struct lane x;
  double p[N_PARAMS], parts = l->parts[j];
  for (int i = 0; i < N_PARAMS; i++) p[i] = l->params[i][j];
  slip_set(&x.k, p);
  x.tb = l->out[DYN_OUT_TB][j];
  x.b = lane_half(x.tb);
  x.g = gamma_at(&x.k, x.tb, x.b);
  x.m = slip_modes(&x.k, &x.g);
  struct node n = slip_start(&x.k, &x.g);
  /* a whole number, nearest to what is asked for */
  m->parts[j] = (parts + 0x1.8p52) - 0x1.8p52;
  m->h[j] = l->out[DYN_OUT_TC][j] / m->parts[j];
  m->chi[j] = x.k.chi;
  m->a[j] = x.k.a;
  m->stiff[j] = x.k.stiff;
  m->start_p[j] = x.g.p;
  m->start_w[j] = x.g.w;
  m->pull_b[j] = x.k.pull_b;
  m->p[j] = n.p;
  m->q[j] = n.q;
  m->w[j] = n.w;
  m->pull[j] = n.pull;
  for (int i = 0; i < 2; i++) {
    struct half_angle by = lane_half(x.k.om[i] * m->h[j]);
    m->om[i][j] = x.k.om[i];
    m->sigma[i][j] = x.k.sigma[i];
    m->amount[i][j] = x.m.a[i];
    m->other[i][j] = x.m.b[i];
    m->by_s[i][j] = by.s;
    m->by_c[i][j] = by.c;
    m->at_s[i][j] = 0;
    m->at_c[i][j] = 1;
  }
  m->below[j] = 1;
  m->slow[j] = 1;
  m->above[j] = 0;
}

TURN_INLINE void march_part(struct march *m, double part, int j) {
  struct lane x;
  struct slip *k = &x.k;
  k->chi = m->chi[j];
  k->a = m->a[j];
  k->stiff = m->stiff[j];
  k->pull_b = m->pull_b[j];
  x.g.p = m->start_p[j];
  x.g.w = m->start_w[j];
  for (int i = 0; i < 2; i++) {
    double s = m->at_s[i][j], c = m->at_c[i][j], by_s = m->by_s[i][j], by_c = m->by_c[i][j];
    m->at_s[i][j] = x.c[i].s = s * by_c + c * by_s;
    m->at_c[i][j] = x.c[i].c = c * by_c - s * by_s;
    k->om[i] = m->om[i][j];
    k->sigma[i] = m->sigma[i][j];
    x.m.a[i] = m->amount[i][j];
    x.m.b[i] = m->other[i][j];
  }
  bool here = part < m->parts[j];
  double inside = part + 1 < m->parts[j] ? 1 : 0;
  double sixth[2], size[2];
  struct node from = {.p = m->p[j], .q = m->q[j], .w = m->w[j], .pull = m->pull[j]}, to = slip_node(k, &x.m, &x.g, x.c);
  slip_bounds(sixth, size, k, &x.m);
  to.p *= inside; /* at the end the root itself */
  struct course a = course_1(k, &from), b = course_1(k, &to), c = course_2(k, &from), d = course_2(k, &to);
  bool first = course_below(&a, &b, m->h[j], sixth[0], DOUBT * size[0]);
  bool second = course_below(&c, &d, m->h[j], sixth[1], DOUBT * size[1]);
  m->below[j] *= here & !first ? 0 : 1;
  m->slow[j] *= here & !second ? 0 : 1;
  m->above[j] += here & (to.q > DOUBT * size[1]) ? 1 : 0;
  m->p[j] = to.p;
  m->q[j] = to.q;
  m->w[j] = to.w;
  m->pull[j] = to.pull;
}

#endif

BATCH_TARGET static void BATCH_RUN(struct lanes *l) {
  for (int j = 0; j < LANES; j++) lane_run(l, j);
}

BATCH_TARGET static void BATCH_START(struct march *restrict m, const struct lanes *restrict l) {
  for (int j = 0; j < LANES; j++) march_start(m, l, j);
}

BATCH_TARGET static void BATCH_PART(struct march *m, double part) {
  for (int j = 0; j < LANES; j++) march_part(m, part, j);
}
#undef BATCH_TARGET
#undef BATCH_RUN
#undef BATCH_START
#undef BATCH_PART
