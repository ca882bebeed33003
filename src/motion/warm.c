/* Newton's iteration on (t_b, t_c) in double precision, and what can be said of the orbit it ends at.

   The two equations are those of map_balls.h.  Near convergence sines and cosines are turned by the step rather than
   computed again. dyn_orbit_warm forms every output in twice the precision after the last step (polish.h).  The proof
   that t_c is a first root, and that z_2' stays below V, needs no further sine where phase H is short. */
#include "warm.h"

#include "num/pi.h"
#include "polish.h"

enum { MOST_STEPS = 16 };
static const double SETTLED = 0x1p-27; /* relative: the step after one of this size is rounding */
static const double WORST = 0x1p8;     /* times rounding: how far off t_b, t_c or the positions may be, relatively */

static void pair_turn(struct slip_pair *x) {
  x->b = half_angle(x->tb);
  slip_turn(x->c, &x->k, x->tc);
}

static void pair_move(struct slip_pair *x) {
  const double *step = x->step, *om = x->k.om;
  x->tb += step[0];
  x->tc += step[1];
  if (fabs(step[0]) < HALF_ANGLE_NEAR && fabs(om[1] * step[1]) < HALF_ANGLE_NEAR) {
    x->b = half_angle_move(x->b, step[0]);
    for (int i = 0; i < 2; i++) x->c[i] = half_angle_move(x->c[i], om[i] * step[1]);
  } else {
    pair_turn(x);
  }
}

/* Whether rounding in the two equations moves t_b and t_c by little. */
static bool well_posed(const struct slip_pair *x) {
  const struct slip *k = &x->k;
  const struct node *n = &x->n;
  double size = 0, reach = fabs(x->r_end), noise = reach;
  if (x->r_end > 0) /* as in slip_gain */
    noise = k->soft * (fabs(n->pull_change * n->pull_sum) * k->soft + n->q * n->q) / (x->r_end + k->rb);
  for (int i = 0; i < 2; i++) size += fabs(x->m.a[i]) + fabs(x->m.b[i]);
  double off_b = (noise + x->g.rise) * reach / fabs(x->defect_tb);
  double off_c = (size + fabs(x->p_tb) * off_b) / fabs(n->w);
  return off_b < WORST * x->tb && off_c < WORST * x->tc && fabs(n->q) > SLIP_DOUBT * k->omc * reach &&
         fabs(n->q) > SLIP_DOUBT * size;
}

/* Newton's iteration; the times stay within a factor of two of the guess. */
static bool converge(struct slip_pair *x, const double guess[2]) {
  x->tb = guess[0];
  x->tc = guess[1];
  if (!(x->tb > 0 && x->tc > 0 && x->tb < 2 * PI && x->tc * x->k.om[1] < 1 / SLIP_DOUBT)) return false;
  pair_turn(x);
  for (int i = 0; i < MOST_STEPS; i++) {
    slip_evaluate(x, true);
    double step[2] = {x->step[0], x->step[1]};
    if (!(fabs(x->tb + step[0] - guess[0]) < 0.5 * guess[0] && fabs(x->tc + step[1] - guess[1]) < 0.5 * guess[1]))
      return false;
    pair_move(x);
    if (fabs(step[0]) > SETTLED * x->tb || fabs(step[1]) > SETTLED * x->tc) continue;
    slip_evaluate(x, true);
    return x->tb < 2 * PI && well_posed(x);
  }
  return false;
}

/* false where the positions, 1/(1 - chi) of a small difference, are lost. */
static bool put_outputs(double out[N_DYN_OUT], const struct slip_pair *x) {
  const struct slip *k = &x->k;
  double period = slip_behind(k, &x->g, &x->m, x->c, x->tc) / k->V, td = slip_td(k, &x->n, x->r_end);
  double ta = ((period - x->tb) - x->tc) - td;
  double z10 = (k->e1 + k->chi * x->r_end) / k->ease - k->V * ta, z20 = z10 + x->r_end;
  out[DYN_OUT_Z10] = z10;
  out[DYN_OUT_Z20] = z20;
  out[DYN_OUT_TA] = ta;
  out[DYN_OUT_TB] = x->tb;
  out[DYN_OUT_TC] = x->tc;
  out[DYN_OUT_TD] = td;
  out[DYN_OUT_PERIOD] = period;
  out[DYN_OUT_TRACE] = x->turn_tb / (x->r_end * x->g.p);
  return k->e1 + fabs(x->r_end) < WORST * k->ease * larger(fabs(z10), fabs(z20));
}

int dyn_orbit_bare(double out[N_DYN_OUT], const double params[N_PARAMS], const double guess[2]) {
  struct slip_pair x;
  if (!slip_init(&x.k, params)) return SS_DOMAIN;
  return converge(&x, guess) && put_outputs(out, &x) ? SS_OK : SS_UNABLE;
}

/* --- Conditions. --- */

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
  struct slip_pair x;
  const struct slip *k = &x.k;
  struct verdicts v = {0, 0};
  if (violations) *violations = 0;
  if (unsure) *unsure = 0;
  if (!slip_init(&x.k, params)) return SS_DOMAIN;
  if (!(converge(&x, guess) && polish(out, params, x.tb, x.tc))) return SS_UNABLE;
  /* before the first crest of the rise z_1' < V in phase Gamma, and t_b is a first root */
  if (exceeds(-x.g.p, SLIP_DOUBT * (k->a + k->e1) * x.b.s) != TRUTH_TRUE) return SS_UNABLE;
  const struct slip_motion h = {k, x.g, x.m};
  const struct stop end = {x.tc, {x.c[0], x.c[1]}, x.n};
  if (slip_stays_below(&h, 0, &end) != TRUTH_TRUE) return SS_UNABLE;
  truth slow = x.n.q > 0 ? TRUTH_FALSE : slip_stays_below(&h, 1, &end);
  double ta = out[DYN_OUT_TA], force = k->e1 + fabs(x.n.w) + fabs(k->e1 - k->a * ta);
  judge(&v, COND_TA, exceeds(ta, SLIP_DOUBT * (force / k->a + out[DYN_OUT_PERIOD])));
  judge(&v, COND_H_V2, slow);
  judge(&v, COND_C_V2, x.n.q < 0 ? TRUTH_TRUE : TRUTH_FALSE);
  judge(&v, COND_C_W, exceeds(slip_close(&x).least, SLIP_DOUBT * force));
  if (violations) *violations = v.broken;
  if (unsure) *unsure = v.open;
  return SS_OK;
}
