/* The solver of one lane, and the loop over lanes for one instruction set.

   Everything is straight-line code: conditions become masks, the number of Newton's steps is fixed, and what only a
   branch could settle is answered with "cannot tell".  Every other step turns the sines and cosines that are there.
   Conditions are judged in double precision; the outputs are formed in twice that (polish.h), in a loop of its own.

   batch.c includes this file once for each instruction set, with BATCH_RUN, BATCH_START and BATCH_PART the names of the
   functions and BATCH_TARGET their attribute; the compiler vectorises the loops (flags in the Makefile). */
#include "batch_impl.h"

#ifndef STICKSLIP_BATCH_KERNEL_H
#define STICKSLIP_BATCH_KERNEL_H

#include "motion/polish.h"
#include "motion/sincos.h"
#include "num/pi.h"

static const double NOISE = 16 * 0x1p-53; /* of the terms of an equation: a step of this size is rounding */
static const double WORST = 0x1p20;       /* times rounding: how far off t_b or t_c may be in relative terms */
static const double PART_ANGLE = 2.0;     /* of the fast oscillation in a part of phase H */

SINCOS_INLINE struct half_angle lane_half(double x) {
  struct sine_cosine t = sincos_of(0.5 * x);
  return (struct half_angle){t.sine, t.cosine};
}

SINCOS_INLINE struct half_angle lane_nudge(struct half_angle x, double off) {
  return (struct half_angle){x.s + (x.c * off - x.s * (0.5 * off * off)), x.c - (x.s * off + x.c * (0.5 * off * off))};
}

/* The half angles at t_b and t_c moved by the steps, which stay unrounded, as what om t lost does. */
SINCOS_INLINE void lane_place(struct slip_pair *x, const struct half_angle at[3], double step_b, double step_c) {
  const struct slip *k = &x->k;
  x->b = lane_nudge(at[0], 0.5 * step_b);
  for (int i = 0; i < 2; i++)
    x->c[i] = lane_nudge(at[1 + i], 0.5 * (product_rest(k->om[i], x->tc) + k->rest[i] * x->tc + k->om[i] * step_c));
}

SINCOS_INLINE void lane_turn(struct half_angle at[3], const struct slip_pair *x) {
  at[0] = lane_half(x->tb);
  at[1] = lane_half(x->k.om[0] * x->tc);
  at[2] = lane_half(x->k.om[1] * x->tc);
}

SINCOS_INLINE void lane_step(struct slip_pair *x) {
  x->tb += x->step[0];
  x->tc += x->step[1];
}

SINCOS_INLINE void lane_move(struct slip_pair *x) {
  lane_step(x);
  x->b = half_angle_move(x->b, x->step[0]);
  x->c[0] = half_angle_move(x->c[0], x->k.om[0] * x->step[1]);
  x->c[1] = half_angle_move(x->c[1], x->k.om[1] * x->step[1]);
}

/* Another step would be rounding, and rounding leaves digits: t_b is off by units of all_b/steep_b, t_c of
   all_c/steep_c. */
SINCOS_INLINE bool lane_converged(const struct slip_pair *x, double guess_b, double guess_c) {
  const struct slip *k = &x->k;
  double reach = fabs(x->n.pull * k->soft) + fabs(x->n.q) * (k->soft * k->omc), radius = fabs(x->r_end);
  double size = fabs(x->m.a[0]) + fabs(x->m.b[0]) + fabs(x->m.a[1]) + fabs(x->m.b[1]) + fabs(x->g.p);
  double steep_b = fabs(x->defect_tb), all_b = (reach + fabs(x->r) + k->rb + x->g.rise) * radius;
  double steep_c = fabs(x->n.w) * steep_b, all_c = size * steep_b + fabs(x->p_tb) * all_b;
  double step_b = fabs(x->step[0]), step_c = fabs(x->step[1]), far_b = fabs(x->tb - guess_b);
  double far_c = fabs(x->tc - guess_c), q = fabs(x->n.q);
  bool settled = (step_b * steep_b <= NOISE * all_b) & (step_c * steep_c <= NOISE * all_c);
  bool posed = (all_b < WORST * (x->tb * steep_b)) & (all_c < WORST * (x->tc * steep_c)) & (q > SLIP_DOUBT * k->V) &
               (radius > SLIP_DOUBT * reach);
  bool near = (far_b < 0.5 * guess_b) & (far_c < 0.5 * guess_c) & (x->tb < 2 * PI) & (x->tc * k->om[1] < SINCOS_REACH);
  return settled & posed & near;
}

/* A part of phase H: both velocities below the belt's; what counts as above for the second. */
struct below {
  bool first, second;
  double doubt;
};

SINCOS_INLINE struct below lane_below(const struct slip_pair *x, const struct node *from, const struct node *to,
                                      double h, bool at_root) {
  double sixth[2], size[2];
  slip_bounds(sixth, size, &x->k, &x->m);
  struct course a = course_1(&x->k, from), b = course_1(&x->k, to), c = course_2(&x->k, from), d = course_2(&x->k, to);
  if (at_root) b.f = 0;
  return (struct below){course_below(&a, &b, h, sixth[0], SLIP_DOUBT * size[0]),
                        course_below(&c, &d, h, sixth[1], SLIP_DOUBT * size[1]), SLIP_DOUBT * size[1]};
}

/* At half the time the whole angles are the half angles of the end. */
SINCOS_INLINE struct node lane_middle(const struct slip_pair *x) {
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

SINCOS_INLINE void lane_run(struct lanes *l, int j) {
  struct slip_pair x = {.tb = l->guess[0][j], .tc = l->guess[1][j]};
  double p[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) p[i] = l->params[i][j];
  slip_set(&x.k, p);
  struct half_angle at[3];
  lane_turn(at, &x);
  x.b = at[0];
  x.c[0] = at[1];
  x.c[1] = at[2];
  slip_evaluate(&x, false);
  lane_move(&x);
  slip_evaluate(&x, false);
  lane_step(&x);
  lane_turn(at, &x);
  lane_place(&x, at, 0, 0);
  slip_evaluate(&x, true);
  lane_place(&x, at, x.step[0], x.step[1]);
  lane_step(&x);
  slip_evaluate(&x, true);

  const struct slip *k = &x.k;
  bool ok = lane_converged(&x, l->guess[0][j], l->guess[1][j]);
  ok &= -x.g.p > SLIP_DOUBT * (k->a + k->e1) * x.b.s; /* before the first crest of the rise */
  struct node start = slip_start(k, &x.g), middle = lane_middle(&x);
  struct below early = lane_below(&x, &start, &middle, 0.5 * x.tc, false);
  struct below late = lane_below(&x, &middle, &x.n, 0.5 * x.tc, true);
  bool up = x.n.q > 0, below = early.first & late.first & (up | (early.second & late.second));

  struct slip_close e = slip_close(&x);
  double force = k->e1 + fabs(x.n.w) + fabs(k->e1 - k->a * e.ta);
  double way = k->a * fabs(e.ta), room = fabs(e.least);
  ok &= (way > SLIP_DOUBT * (force + k->a * e.period)) & (room > SLIP_DOUBT * force);

  l->out[DYN_OUT_TB][j] = x.tb;
  l->out[DYN_OUT_TC][j] = x.tc;
  const double no_ta = 1 << COND_TA, no_w = 1 << COND_C_W, no_v2 = 1 << COND_H_V2 | 1 << COND_C_V2;
  const double fine = SS_OK, outside = SS_DOMAIN,
               unable = SS_UNABLE; /* as numbers: SSE2 has no masks for integers of 64 bits */
  double broken = (e.ta < 0 ? no_ta : 0.0) + (e.least < 0 ? no_w : 0.0) + (up ? no_v2 : 0.0);
  bool in = dyn_in_domain_d(p);
  ok &= in;
  l->broken[j] = ok ? broken : 0.0;
  l->status[j] = !in ? outside : (ok & below) ? fine : unable;
  l->parts[j] = (ok & !below) ? (x.tc * k->om[1]) * (1 / PART_ANGLE) + 1 : 0.0;
}

/* The outputs once more, in twice the precision. */
SINCOS_INLINE void lane_polish(struct lanes *l, int j) {
  double p[N_PARAMS], out[N_DYN_OUT], status = l->status[j], parts = l->parts[j];
  for (int i = 0; i < N_PARAMS; i++) p[i] = l->params[i][j];
  bool ok = polish(out, p, l->out[DYN_OUT_TB][j], l->out[DYN_OUT_TC][j]);
  const double fine = SS_OK, unable = SS_UNABLE;
  double failed = status == fine ? unable : status;
  for (int i = 0; i < N_DYN_OUT; i++) l->out[i][j] = out[i];
  l->status[j] = ok ? status : failed;
  l->parts[j] = ok ? parts : 0.0;
}

/* --- A closer look at phase H: in parts, all lanes part by part. --- */

SINCOS_INLINE void march_start(struct march *m, const struct lanes *l, int j) {
  struct slip_pair x = {.tb = l->out[DYN_OUT_TB][j]};
  double p[N_PARAMS], parts = l->parts[j];
  for (int i = 0; i < N_PARAMS; i++) p[i] = l->params[i][j];
  slip_set(&x.k, p);
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

SINCOS_INLINE void march_part(struct march *m, double part, int j) {
  struct slip_pair x;
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
  struct node from = {.p = m->p[j], .q = m->q[j], .w = m->w[j], .pull = m->pull[j]}, to = slip_node(k, &x.m, &x.g, x.c);
  to.p *= inside; /* at the end the root itself */
  struct below both = lane_below(&x, &from, &to, m->h[j], false);
  m->below[j] *= (here & !both.first) ? 0 : 1;
  m->slow[j] *= (here & !both.second) ? 0 : 1;
  m->above[j] += (here & (to.q > both.doubt)) ? 1 : 0;
  m->p[j] = to.p;
  m->q[j] = to.q;
  m->w[j] = to.w;
  m->pull[j] = to.pull;
}

#endif

BATCH_TARGET static void BATCH_RUN(struct lanes *l) {
  for (int j = 0; j < LANES; j++) lane_run(l, j);
  for (int j = 0; j < LANES; j++) lane_polish(l, j);
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
