/* The return map of the word in double precision, with t_b as its argument.

   At the end of the stick phase w = e1 and both velocities are V, so the state is r alone.  In phase Gamma r rises by
   a (t - sin t) + e1 (1 - cos t) with a = (1 - chi) V: t_b fixes the r it started from, and everything after, by the
   formulas of slip.h.  Phase C turns (r, q/omega) about the origin, so it ends at the radius.  Along phase H that
   radius stands still where z_1' = V: its derivative needs no derivative of t_c, and stays finite when the event
   grazes. */
#include <math.h>

#include "return_map_double.h"

int return_map_double_init(struct return_map_double *k, const double params[N_PARAMS]) {
  double stiff = params[P_CHI] * params[P_ETA];
  if (!dyn_in_domain_d(params)) return SS_DOMAIN;
  /* Nothing is squared, as slip_set does, so that the search can be asked about parameters of any size. */
  slip_set_gap(&k->slip, params, hypot(stiff - 1, 2 * params[P_CHI] * sqrt(params[P_ETA])));
  k->rho = hypot(k->slip.a, k->slip.e1);
  k->fall = gamma_crest(k->slip.a, k->slip.e1);
  return SS_OK;
}

void return_map_double_records(struct return_map_double *map) {
  /* The height of one crest over the one before is 2 pi a. */
  const struct slip *k = &map->slip;
  double turn = 2 * atan2(k->e1, k->a);
  struct half_angle b = half_angle(turn);
  map->rise = return_map_double_time(map, fmax(k->e1 * full_versine(b) - k->a * turned(turn, b), 0));
}

double return_map_double_rise(const struct return_map_double *k, double t) {
  return gamma_at(&k->slip, t, half_angle(t)).rise;
}

/* Its derivative, which is V - z_1'; exact in relative terms near both ends of the first rise. */
static double rise_rate(const struct return_map_double *k, double t) {
  return 2 * k->rho * sin(0.5 * t) * sin(0.5 * (k->fall - t));
}

double return_map_double_time(const struct return_map_double *k, double g) {
  if (!(g > 0)) return 0;
  double crest = return_map_double_rise(k, k->fall), turn = 2 * PI * k->slip.a, whole = 0;
  if (g > crest) whole = ceil((g - crest) / turn);
  g -= whole * turn;
  double low = 0, high = k->fall, t = fmin(sqrt(2 * g / k->slip.e1), 0.5 * k->fall);
  for (int i = 0; i < 200; i++) {
    struct gamma_end at = gamma_at(&k->slip, t, half_angle(t));
    double miss = at.rise - g, next = t + miss / at.p;
    if (miss < 0)
      low = t;
    else
      high = t;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (fabs(next - t) <= 1e-16 * t || miss == 0) break;
    t = next;
  }
  return 2 * PI * whole + t;
}

double return_map_double_reach(const struct return_map_double *map) {
  /* Twice the energy of the z-system, eta z_1'^2 + z_2'^2 + eta (w^2 + 2 chi w r + chi r^2)/(1 - chi), is kept in phase
     H and starts with |w| <= rho, r = e2/chi, z_2' = V.  At its end chi eta r^2 + z_2'^2 is not more. */
  const struct slip *k = &map->slip;
  double w = map->rho, r = k->rb, speed = k->V + map->rho + k->a;
  double form = w * w + 2 * k->chi * w * r + k->chi * r * r;
  double energy = k->eta * speed * speed + k->V * k->V + k->eta / k->ease * form;
  return (sqrt(energy) + k->V) / k->omc;
}

/* z_1' along a motion of phase H. */
static struct trig_sum modes_wave(const struct slip *k, const double a[2], const double b[2], double start) {
  return (struct trig_sum){start, 0, {k->om[0], k->om[1]}, {a[0], a[1]}, {-b[0], -b[1]}};
}

/* The sum of the amplitudes. */
static double highest(const double a[2], const double b[2]) {
  return hypot(a[0], b[0]) + hypot(a[1], b[1]);
}

/* The first root by a walk, which tells how safe it is. */
static void walk_to_tc(struct pass *s, double *rate, const struct slip_motion *h, const struct dyn_limits *lim) {
  const struct slip *k = h->k;
  const struct slip_modes by_tb = slip_modes_change(k, -h->g.w, h->g.dw);
  const struct slip_modes bent = slip_modes_change(k, -h->g.dw, -h->g.w);
  struct trig_sum wave = modes_wave(k, h->m.a, h->m.b, h->g.p);
  struct trig_sum_shift shift = {modes_wave(k, by_tb.a, by_tb.b, -h->g.w), highest(by_tb.a, by_tb.b),
                                 highest(bent.a, bent.b)};
  struct trig_sum_root root;
  s->status = trig_sum_first_root(&root, &wave, &shift, lim);
  s->steps = root.steps;
  s->safe = root.safe;
  s->grazing = root.grazing;
  s->tc = root.t;
  *rate = root.rate;
}

/* From that of a pass near by: the root on the rise on which it is expected, the rate there being half of the root's at
   least. */
static bool follow_tc(struct pass *s, struct stop *at, const struct slip_motion *h, const struct pass *near) {
  double moved = s->tb - near->tb, expected = near->tc + near->dtc * moved, bound = 0;
  s->safe = near->safe - fabs(moved);
  if (!slip_root_near(at, h, expected)) return false;
  for (int i = 0; i < 2; i++) bound += h->k->om[i] * h->k->om[i] * (fabs(h->m.a[i]) + fabs(h->m.b[i]));
  s->tc = at->t;
  return bound * fabs(s->tc - expected) <= -0.5 * at->n.w;
}

void return_map_double_pass(struct pass *s, const struct return_map_double *map, double tb, const struct pass *near,
                            const struct dyn_limits *lim) {
  const struct slip *k = &map->slip;
  double phase = tb > map->fall ? fmod(tb, 2 * PI) : tb, pb = -rise_rate(map, phase);
  double rise = return_map_double_rise(map, tb);
  *s = (struct pass){.tb = tb, .pb = pb, .r = k->rb - rise};
  struct slip_motion h = {.k = k, .g = {rise, pb, k->e1 * cos(tb) + k->a * sin(tb), k->a + pb}};
  h.m = slip_modes(k, &h.g);
  struct stop at;
  double rate;
  if (near && follow_tc(s, &at, &h, near) && s->tc <= lim->t_max) {
    rate = -at.n.w;
  } else {
    walk_to_tc(s, &rate, &h, lim);
    if (s->status) return;
    slip_turn(at.x, k, s->tc);
    at.n = slip_node(k, &h.m, &h.g, at.x);
  }
  const struct node n = at.n;
  const struct change d = slip_change(k, &h.g, at.x);
  s->wc = n.w;
  s->rc = n.pull * k->soft;
  s->qc = n.q;
  s->dtc = -d.p / rate;
  s->dqc = d.q - n.pull * s->dtc;
  bool up = s->qc > 0 || (s->qc == 0 && s->rc < 0);
  s->r_end = (up ? 1 : -1) * hypot(s->rc, s->qc / k->omc);
  s->defect = slip_gain(k, &n, s->r_end) + rise;
  s->slope = k->soft * (s->rc * d.pull + s->qc * d.q) / s->r_end - pb;
}

void return_map_double_times(double *ta, double *td, const struct return_map_double *map, const struct pass *s) {
  const struct slip *k = &map->slip;
  double turn = atan2(fabs(s->qc), (s->r_end > 0 ? 1 : -1) * k->omc * s->rc);
  *td = turn / k->omc;
  *ta = (k->e1 - s->wc + k->chi * (s->r_end - s->rc)) / k->a - *td;
}
