/* Newton's iteration on (t_b, t_c) in double precision, and what can be said of the orbit it ends at.

   The two equations are z_1' = V at the end of phase H, and r at the end of phase C = the r that leads to t_b; both
   stay smooth where an event grazes.  Near convergence sines and cosines are turned by the step rather than computed
   again. dyn_orbit_warm forms every output in twice the precision after the last step (polish.h).  The proof that t_c
   is a first root, and that z_2' stays below V, needs no further sine where phase H is short. */
#include "warm.h"

#include "num/pi.h"
#include "polish.h"

enum { MOST_STEPS = 16 };
static const double SETTLED = 0x1p-27; /* relative: the step after one of this size is rounding */
static const double WORST = 0x1p8;     /* times rounding: how far off t_b, t_c or the positions may be, relatively */

/* Everything at a pair (t_b, t_c). */
struct point {
  double tb, tc;
  struct half_angle b, c[2];
  struct slip_motion h;
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
  if (fabs(step[0]) < HALF_ANGLE_NEAR && fabs(k->om[1] * step[1]) < HALF_ANGLE_NEAR) {
    x->b = half_angle_move(x->b, step[0]);
    for (int i = 0; i < 2; i++) x->c[i] = half_angle_move(x->c[i], k->om[i] * step[1]);
  } else {
    point_turn(x, k);
  }
}

static void point_evaluate(struct point *x, const struct slip *k) {
  x->h.k = k;
  x->h.g = gamma_at(k, x->tb, x->b);
  x->h.m = slip_modes(k, &x->h.g);
  x->n = slip_node(k, &x->h.m, &x->h.g, x->c);
  struct change d = slip_change(k, &x->h.g, x->c);
  double r = x->n.pull * k->soft;
  x->r = k->rb - x->h.g.rise;
  x->r_end = slip_radius(k, &x->n);
  x->defect = slip_gain(k, &x->n, x->r_end) + x->h.g.rise;
  x->p_tb = d.p;
  double per = 1 / x->r_end;
  x->radius_tb = k->soft * (r * d.pull + x->n.q * d.q) * per;
  x->defect_tb = x->radius_tb - x->h.g.p;
  x->defect_tc = -r * x->n.p * per;
}

static void newton_step(double step[2], const struct point *x) {
  double per = 1 / (x->p_tb * x->defect_tc + x->n.w * x->defect_tb);
  step[0] = -(x->defect_tc * x->n.p + x->n.w * x->defect) * per;
  step[1] = -(x->p_tb * x->defect - x->defect_tb * x->n.p) * per;
}

/* Whether rounding in the two equations moves t_b and t_c by little. */
static bool well_posed(const struct point *x, const struct slip *k) {
  const struct node *n = &x->n;
  double size = 0, reach = fabs(x->r_end), noise = reach;
  if (x->r_end > 0) /* as in slip_gain */
    noise = k->soft * (fabs(n->pull_change * n->pull_sum) * k->soft + n->q * n->q) / (x->r_end + k->rb);
  for (int i = 0; i < 2; i++) size += fabs(x->h.m.a[i]) + fabs(x->h.m.b[i]);
  double off_b = (noise + x->h.g.rise) / fabs(x->defect_tb);
  double off_c = (size + fabs(x->p_tb) * off_b) / fabs(n->w);
  return off_b < WORST * x->tb && off_c < WORST * x->tc && fabs(n->q) > SLIP_DOUBT * k->omc * reach &&
         fabs(n->q) > SLIP_DOUBT * size;
}

/* Newton's iteration; the times stay within a factor of two of the guess. */
static bool converge(struct point *x, const struct slip *k, const double guess[2]) {
  x->tb = guess[0];
  x->tc = guess[1];
  if (!(x->tb > 0 && x->tc > 0 && x->tb < 2 * PI && x->tc * k->om[1] < 1 / SLIP_DOUBT)) return false;
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

/* false where the positions, 1/(1 - chi) of a small difference, are lost. */
static bool put_outputs(double out[N_DYN_OUT], const struct point *x, const struct slip *k) {
  double period = slip_behind(k, &x->h.g, &x->h.m, x->c, x->tc) / k->V, td = slip_td(k, &x->n, x->r_end);
  double ta = ((period - x->tb) - x->tc) - td;
  double z10 = (k->e1 + k->chi * x->r_end) / k->ease - k->V * ta, z20 = z10 + x->r_end;
  out[DYN_OUT_Z10] = z10;
  out[DYN_OUT_Z20] = z20;
  out[DYN_OUT_TA] = ta;
  out[DYN_OUT_TB] = x->tb;
  out[DYN_OUT_TC] = x->tc;
  out[DYN_OUT_TD] = td;
  out[DYN_OUT_PERIOD] = period;
  out[DYN_OUT_TRACE] = x->radius_tb / x->h.g.p;
  return k->e1 + fabs(x->r_end) < WORST * k->ease * larger(fabs(z10), fabs(z20));
}

int dyn_orbit_bare(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]) {
  struct slip k;
  struct point x;
  if (!slip_init(&k, params)) return SS_DOMAIN;
  return converge(&x, &k, guess) && put_outputs(out, &x, &k) ? SS_OK : SS_UNABLE;
}

/* --- Conditions. --- */

/* The greatest w in phase C, wf at its end; inside it w' = a - chi q vanishes only where q > 0, and on a hill where q
   falls. */
static double most_force(const struct slip *k, const struct point *x, double wf, double td) {
  double most = fmax(x->n.w, wf), fast = k->chi * k->omc * x->r_end, turn = k->omc * td;
  if (!(fast > k->a)) return most;
  double s = k->a / fast, cosine = -sqrt((1 - s) * (1 + s)), u = atan2(s, cosine);
  if (u >= turn) return most;
  return fmax(most, x->n.w + k->a * (turn - u) / k->omc - k->chi * (x->r_end * cosine - x->n.pull * k->soft));
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
  if (violations) *violations = 0;
  if (unsure) *unsure = 0;
  if (!slip_init(&k, params)) return SS_DOMAIN;
  if (!(converge(&x, &k, guess) && polish(out, params, x.tb, x.tc))) return SS_UNABLE;
  /* before the first crest of the rise z_1' < V in phase Gamma, and t_b is a first root */
  if (exceeds(-x.h.g.p, SLIP_DOUBT * (k.a + k.e1) * x.b.s) != TRUTH_TRUE) return SS_UNABLE;
  const struct stop end = {x.tc, {x.c[0], x.c[1]}, x.n};
  if (slip_stays_below(&x.h, 0, &end) != TRUTH_TRUE) return SS_UNABLE;
  truth slow = x.n.q > 0 ? TRUTH_FALSE : slip_stays_below(&x.h, 1, &end);
  double ta = out[DYN_OUT_TA], wf = k.e1 - k.a * ta, force = k.e1 + fabs(x.n.w) + fabs(wf);
  judge(&v, COND_TA, exceeds(ta, SLIP_DOUBT * (force / k.a + out[DYN_OUT_PERIOD])));
  judge(&v, COND_H_V2, slow);
  judge(&v, COND_C_V2, x.n.q < 0 ? TRUTH_TRUE : TRUTH_FALSE);
  judge(&v, COND_C_W, exceeds(k.e1 - most_force(&k, &x, wf, out[DYN_OUT_TD]), SLIP_DOUBT * force));
  if (violations) *violations = v.broken;
  if (unsure) *unsure = v.open;
  return SS_OK;
}
