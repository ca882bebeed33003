/* Newton's iteration on (t_b, t_c) in double precision, and what can be said of the orbit it ends at.

   The two equations are z_1' = V at the end of phase H, and r at the end of phase C = the r that leads to t_b; both stay
   smooth where an event grazes.  Near convergence sines and cosines are moved by the step rather than asked for again, and
   every output is formed after the last step.  The proof that t_c is a first root, and that z_2' stays below V, costs no
   sine more where phase H is short. */
#include "stickslip/warm.h"

#include "slip.h"

enum { MOST_STEPS = 16, MOST_NODES = 64 };
static const double SETTLED = 0x1p-27; /* relative: the step after one of this size is rounding */
static const double NEAR = 0x1p-7;     /* of an angle: its sine is moved */
static const double WORST = 0x1p20;    /* times rounding: how far off t_b or t_c may be in relative terms */
static const double DOUBT = 0x1p-30;   /* relative: what is nearer to zero has no sign */

/* Everything at a pair (t_b, t_c). */
struct point {
  double tb, tc;
  struct half_angle b, c[2];
  struct gamma_end g;
  struct slip_modes m;
  struct node n;
  double r, r_end, defect;
  double p_tb, radius_tb, defect_tb, defect_tc; /* by t_b and t_c; radius: r_end at fixed t_c */
};

static void point_turn(struct point *x, const struct slip *k) {
  x->b = half_angle(x->tb);
  slip_turn(x->c, k, x->tc);
}

static void point_move(struct point *x, const struct slip *k, const double step[2]) {
  x->tb += step[0];
  x->tc += step[1];
  if (fabs(step[0]) < NEAR && fabs(k->om[1] * step[1]) < NEAR) {
    x->b = half_angle_move(x->b, step[0]);
    for (int i = 0; i < 2; i++) x->c[i] = half_angle_move(x->c[i], k->om[i] * step[1]);
  } else {
    point_turn(x, k);
  }
}

static void point_evaluate(struct point *x, const struct slip *k) {
  x->g = gamma_at(k, x->tb, x->b);
  x->m = slip_modes(k, &x->g);
  struct slip_modes rate = slip_modes_rate(k, &x->g);
  x->n = slip_node(k, &x->m, &x->g, x->c);
  double speed[2], force[2];
  for (int i = 0; i < 2; i++) {
    double sine = full_sine(x->c[i]), cosine = 1 - full_versine(x->c[i]);
    speed[i] = rate.a[i] * cosine - rate.b[i] * sine;
    force[i] = k->om[i] * (rate.a[i] * sine + rate.b[i] * cosine);
  }
  double q_tb = k->sigma[0] * speed[0] + k->sigma[1] * speed[1];
  double r_tb = (k->sigma[0] * force[0] + k->sigma[1] * force[1]) * k->soft, r = x->n.pull * k->soft;
  x->r = k->rb - x->g.rise;
  x->r_end = slip_radius(k, &x->n);
  x->defect = slip_gain(k, &x->n, x->r_end) + x->g.rise;
  x->p_tb = speed[0] + speed[1];
  double per = 1 / x->r_end;
  x->radius_tb = (r * r_tb + x->n.q * q_tb * k->soft) * per;
  x->defect_tb = x->radius_tb - x->g.p;
  x->defect_tc = -r * x->n.p * per;
}

static void newton_step(double step[2], const struct point *x) {
  double per = 1 / (x->p_tb * x->defect_tc + x->n.w * x->defect_tb);
  step[0] = -(x->defect_tc * x->n.p + x->n.w * x->defect) * per;
  step[1] = -(x->p_tb * x->defect - x->defect_tb * x->n.p) * per;
}

/* Rounding moves t_b and t_c by no more than a part that leaves digits. */
static bool well_posed(const struct point *x, const struct slip *k) {
  double reach = fabs(x->n.pull * k->soft) + fabs(x->n.q) / k->omc, size = 0;
  for (int i = 0; i < 2; i++) size += fabs(x->m.a[i]) + fabs(x->m.b[i]);
  double off_b = (reach + fabs(x->r) + k->rb + x->g.rise) / fabs(x->defect_tb);
  double off_c = (size + fabs(x->g.p) + fabs(x->p_tb) * off_b) / fabs(x->n.w);
  return off_b < WORST * x->tb && off_c < WORST * x->tc && fabs(x->n.q) > DOUBT * k->V &&
         fabs(x->r_end) > DOUBT * reach;
}

/* Newton's iteration; the times stay within a factor of two of the guess. */
static bool converge(struct point *x, const struct slip *k, const double guess[2]) {
  x->tb = guess[0];
  x->tc = guess[1];
  if (!(x->tb > 0 && x->tc > 0 && x->tb < 2 * PI && x->tc * k->om[1] < 1 / DOUBT)) return false;
  point_turn(x, k);
  for (int i = 0; i < MOST_STEPS; i++) {
    double step[2];
    point_evaluate(x, k);
    newton_step(step, x);
    if (!(fabs(x->tb + step[0] - guess[0]) < 0.5 * guess[0] && fabs(x->tc + step[1] - guess[1]) < 0.5 * guess[1]))
      return false;
    point_move(x, k, step);
    if (fabs(step[0]) > SETTLED * x->tb || fabs(step[1]) > SETTLED * x->tc) continue;
    point_evaluate(x, k);
    return x->tb < 2 * PI && well_posed(x, k);
  }
  return false;
}

static void put_outputs(double out[N_DYN_OUT], const struct point *x, const struct slip *k) {
  double period = slip_behind(k, &x->g, &x->m, x->c, x->tc) / k->V, td = slip_td(k, &x->n, x->r_end);
  double ta = ((period - x->tb) - x->tc) - td;
  out[DYN_OUT_Z10] = (k->e1 + k->chi * x->r_end) / k->ease - k->V * ta;
  out[DYN_OUT_Z20] = (k->e1 + x->r_end) / k->ease - k->V * ta;
  out[DYN_OUT_TA] = ta;
  out[DYN_OUT_TB] = x->tb;
  out[DYN_OUT_TC] = x->tc;
  out[DYN_OUT_TD] = td;
  out[DYN_OUT_PERIOD] = period;
  out[DYN_OUT_TRACE] = x->radius_tb / x->g.p;
}

int dyn_orbit_bare(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]) {
  struct slip k;
  struct point x;
  if (!slip_init(&k, params)) return SS_DOMAIN;
  if (!converge(&x, &k, guess)) return SS_UNABLE;
  put_outputs(out, &x, &k);
  return SS_OK;
}

/* --- Conditions. --- */

/* A time in phase H and the node there. */
struct stop {
  double t;
  struct node n;
};

/* Whether z'_mass < V between the first and the last stop, by halving: a stop surely above V says no. */
static truth stays_below(const struct slip *k, const struct point *x, int mass, const struct stop *first,
                         const struct stop *last) {
  struct stop stack[MOST_NODES], from = *first;
  double sixth[2], size[2];
  int n = 0, used = 0;
  slip_bounds(sixth, size, k, &x->m);
  stack[n++] = *last;
  while (n > 0) {
    const struct stop *to = &stack[n - 1];
    struct course a = mass == 0 ? course_1(k, &from.n) : course_2(k, &from.n);
    struct course b = mass == 0 ? course_1(k, &to->n) : course_2(k, &to->n);
    if (to == stack && mass == 0) b.f = 0; /* the root itself */
    if (course_below(&a, &b, to->t - from.t, sixth[mass], DOUBT * size[mass])) {
      from = *to;
      n--;
      continue;
    }
    if (++used == MOST_NODES) return TRUTH_UNKNOWN;
    struct half_angle turn[2];
    double t = 0.5 * (from.t + to->t);
    slip_turn(turn, k, t);
    stack[n] = (struct stop){t, slip_node(k, &x->m, &x->g, turn)};
    double f = mass == 0 ? stack[n].n.p : stack[n].n.q;
    if (f > DOUBT * size[mass]) return TRUTH_FALSE;
    n++;
  }
  return TRUTH_TRUE;
}

/* The least and the greatest w in phase C, wf at its end; inside it w' = a - chi q vanishes only where q > 0. */
static void force_range(double range[2], const struct slip *k, const struct point *x, double wf, double td) {
  range[0] = fmin(x->n.w, wf);
  range[1] = fmax(x->n.w, wf);
  double fast = k->chi * k->omc * x->r_end, turn = k->omc * td;
  if (!(fast > k->a)) return;
  double s = k->a / fast, c = sqrt((1 - s) * (1 + s));
  for (int i = 0; i < 2; i++) { /* the valley, then the hill */
    double cosine = i == 0 ? c : -c, u = atan2(s, cosine);
    if (u >= turn) continue;
    double w = x->n.w + k->a * (turn - u) / k->omc - k->chi * (x->r_end * cosine - x->n.pull * k->soft);
    range[0] = fmin(range[0], w);
    range[1] = fmax(range[1], w);
  }
}

struct verdicts {
  unsigned broken, open;
};

static void judge(struct verdicts *v, int condition, truth holds) {
  if (holds == TRUTH_FALSE) v->broken |= 1u << condition;
  if (holds == TRUTH_UNKNOWN) v->open |= 1u << condition;
}

static truth exceeds(double x, double doubt) {
  return x > doubt ? TRUTH_TRUE : x < -doubt ? TRUTH_FALSE : TRUTH_UNKNOWN;
}

int dyn_orbit_warm(double out[N_DYN_OUT], unsigned *violations, unsigned *unsure, const double params[N_PARAMS],
                   const double guess[2]) {
  struct slip k;
  struct point x;
  struct verdicts v = {0, 0};
  double range[2];
  *violations = *unsure = 0;
  if (!slip_init(&k, params)) return SS_DOMAIN;
  if (!converge(&x, &k, guess)) return SS_UNABLE;
  put_outputs(out, &x, &k);
  /* before the first crest of the rise z_1' < V in phase Gamma, and t_b is a first root */
  if (exceeds(-x.g.p, DOUBT * (k.a + k.e1) * x.b.s) != TRUTH_TRUE) return SS_UNABLE;
  const struct stop begin = {0, slip_start(&k, &x.g)}, end = {x.tc, x.n};
  if (stays_below(&k, &x, 0, &begin, &end) != TRUTH_TRUE) return SS_UNABLE;
  truth slow = x.n.q > 0 ? TRUTH_FALSE : stays_below(&k, &x, 1, &begin, &end);
  double ta = out[DYN_OUT_TA], wf = k.e1 - k.a * ta, force = k.e1 + fabs(x.n.w) + fabs(wf);
  force_range(range, &k, &x, wf, out[DYN_OUT_TD]);
  judge(&v, COND_TA, exceeds(ta, DOUBT * (force / k.a + out[DYN_OUT_PERIOD])));
  judge(&v, COND_H_V2, slow);
  judge(&v, COND_C_V2, x.n.q < 0 ? TRUTH_TRUE : TRUTH_FALSE);
  judge(&v, COND_C_W, exceeds(k.e1 - range[1], DOUBT * force));
  out[DYN_OUT_U1] = 0.5 * (k.e1 - fmin(range[0], k.e1));
  out[DYN_OUT_U2] = 0.5 * k.chi * x.g.rise;
  *violations = v.broken;
  *unsure = v.open;
  return SS_OK;
}
