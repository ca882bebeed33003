/* The return map of the word in double precision, with t_b as its argument.

   At the end of the stick phase w = e1 and both velocities are V, so the state is r alone.  Phase Gamma then gives
   w = e1 cos t + a sin t with a = (1 - chi) V, and r rises by g(t) = a (t - sin t) + e1 (1 - cos t): t_b fixes the r
   it started from, and everything after.  Phase H is two oscillations in the coordinates (sqrt(eta) z_1, z_2), in which
   its matrix is symmetric; forces rather than positions carry them, since positions lose 1/(1 - chi).  Phase C turns
   (r, q/omega) about the origin, so it ends at the radius.  Along phase H that radius stands still where z_1' = V:
   its derivative needs no derivative of t_c, and stays finite when the event grazes. */
#include <math.h>

#include "num/pi.h"
#include "return_map_double.h"
#include "trig_sum.h"

int return_map_double_init(struct return_map_double *k, const double params[N_PARAMS]) {
  if (!dyn_in_domain_d(params)) return SS_DOMAIN;
  k->chi = params[P_CHI];
  k->eta = params[P_ETA];
  k->V = params[P_V];
  k->e1 = params[P_E1];
  k->e2 = params[P_E2];
  k->a = (1 - k->chi) * k->V;
  k->rho = hypot(k->a, k->e1);
  k->fall = gamma_crest(k->a, k->e1);
  k->root_eta = sqrt(k->eta);

  /* Matrix [1, -chi sqrt(eta); -chi sqrt(eta), chi eta]: the larger eigenvalue lies `above` above 1, the smaller
     `below` below it, and above * below = chi^2 eta.  Nothing is squared, as slip_set does, so that the search can be
     asked about parameters of any size. */
  double stiff = k->chi * k->eta, couple = k->chi * k->root_eta, above, below;
  double gap = hypot(stiff - 1, 2 * couple);
  if (stiff > 1) {
    above = 0.5 * (gap + (stiff - 1));
    below = couple / above * couple;
  } else {
    below = 0.5 * (gap + (1 - stiff));
    above = couple / below * couple;
  }
  double large = 1 + above;
  k->om[0] = sqrt(stiff * (1 - k->chi) / large);
  k->om[1] = sqrt(large);
  k->omc = sqrt(stiff);
  k->x = sqrt(above / (above + below));
  k->y = sqrt(below / (above + below));
  return SS_OK;
}

void return_map_double_records(struct return_map_double *k) {
  /* The height of one crest over the one before is 2 pi a. */
  double half = atan2(k->e1, k->a), s = sin(half);
  double level = 2 * k->e1 * s * s - k->a * x_minus_sin(2 * half);
  k->rise = return_map_double_time(k, fmax(level, 0));
}

double return_map_double_rise(const struct return_map_double *k, double t) {
  double s = sin(0.5 * t);
  return k->a * x_minus_sin(t) + 2 * k->e1 * s * s;
}

/* Its derivative, which is V - z_1'; exact in relative terms near both ends of the first rise. */
static double rise_rate(const struct return_map_double *k, double t) {
  return 2 * k->rho * sin(0.5 * t) * sin(0.5 * (k->fall - t));
}

double return_map_double_time(const struct return_map_double *k, double g) {
  if (!(g > 0)) return 0;
  double crest = return_map_double_rise(k, k->fall), turn = 2 * PI * k->a, whole = 0;
  if (g > crest) whole = ceil((g - crest) / turn);
  g -= whole * turn;
  double low = 0, high = k->fall, t = fmin(sqrt(2 * g / k->e1), 0.5 * k->fall);
  for (int i = 0; i < 200; i++) {
    double s = sin(0.5 * t), c = cos(0.5 * t), turned = t > 0.5 ? t - 2 * s * c : x_minus_sin(t);
    double miss = k->a * turned + 2 * k->e1 * s * s - g, next = t - miss / (2 * s * (k->e1 * c + k->a * s));
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

double return_map_double_reach(const struct return_map_double *k) {
  /* Twice the energy of the z-system, eta z_1'^2 + z_2'^2 + eta (w^2 + 2 chi w r + chi r^2)/(1 - chi), is kept in phase
     H and starts with |w| <= rho, r = e2/chi, z_2' = V.  At its end chi eta r^2 + z_2'^2 is not more. */
  double w = k->rho, r = k->e2 / k->chi, speed = k->V + k->rho + k->a;
  double energy =
      k->eta * speed * speed + k->V * k->V + k->eta / (1 - k->chi) * (w * w + 2 * k->chi * w * r + k->chi * r * r);
  return (sqrt(energy) + k->V) / k->omc;
}

/* The two oscillations at one time: a motion with velocities v and forces f = (w, chi eta r) at the start. */
struct modes {
  double a[2], b[2]; /* amplitudes: velocity = a cos - b sin along each mode */
};

static struct modes modes_from(const struct return_map_double *k, double v1, double v2, double w, double pull) {
  double v = k->root_eta * v1, f = k->root_eta * w;
  return (struct modes){{k->x * v + k->y * v2, k->y * v - k->x * v2},
                        {(k->x * f + k->y * pull) / k->om[0], (k->y * f - k->x * pull) / k->om[1]}};
}

/* z_1' along the motion. */
static struct trig_sum modes_wave(const struct return_map_double *k, const struct modes *m, double start) {
  double x = k->x / k->root_eta, y = k->y / k->root_eta;
  return (struct trig_sum){start, 0, {k->om[0], k->om[1]}, {x * m->a[0], y * m->a[1]}, {-x * m->b[0], -y * m->b[1]}};
}

/* w, r and z_2' - (z_2' at the start) at the time whose half angles have the sines s and cosines c. */
static void modes_end(double out[3], const struct return_map_double *k, const struct modes *m, const double s[2],
                      const double c[2]) {
  double change[2], force[2];
  for (int i = 0; i < 2; i++) {
    double sine = 2 * s[i] * c[i], versine = 2 * s[i] * s[i];
    change[i] = -m->a[i] * versine - m->b[i] * sine;
    force[i] = k->om[i] * (m->a[i] * sine + m->b[i] * (1 - versine));
  }
  out[0] = (k->x * force[0] + k->y * force[1]) / k->root_eta;
  out[1] = (k->y * force[0] - k->x * force[1]) / (k->omc * k->omc);
  out[2] = k->y * change[0] - k->x * change[1];
}

/* The sum of the amplitudes. */
static double highest(const struct trig_sum *w) {
  return hypot(w->cs[0], w->sn[0]) + hypot(w->cs[1], w->sn[1]);
}

void return_map_double_pass(struct pass *s, const struct return_map_double *k, double tb,
                            const struct dyn_limits *lim) {
  double phase = tb > k->fall ? fmod(tb, 2 * PI) : tb;
  double pb = -rise_rate(k, phase), wb = k->e1 * cos(tb) + k->a * sin(tb);
  struct modes now = modes_from(k, k->V + pb, k->V, wb, k->eta * k->e2);
  struct modes var = modes_from(k, -wb, 0, k->a + pb, 0);     /* d/dt_b, r_b = e2/chi being fixed */
  struct modes bent = modes_from(k, -(k->a + pb), 0, -wb, 0); /* second derivatives */
  struct trig_sum wave = modes_wave(k, &now, pb), bend = modes_wave(k, &bent, 0);
  struct trig_sum_shift shift = {.rate = modes_wave(k, &var, -wb), .bend = highest(&bend)};
  shift.most = highest(&shift.rate);

  *s = (struct pass){.tb = tb, .pb = pb};
  s->r = k->e2 / k->chi - return_map_double_rise(k, tb);
  struct trig_sum_root root;
  s->status = trig_sum_first_root(&root, &wave, &shift, lim);
  s->steps = root.steps;
  s->safe = root.safe;
  s->grazing = root.grazing;
  s->tc = root.t;
  if (s->status) return;

  double half_s[2], half_c[2], end[3], d[3];
  for (int i = 0; i < 2; i++) {
    half_s[i] = sin(0.5 * k->om[i] * s->tc);
    half_c[i] = cos(0.5 * k->om[i] * s->tc);
  }
  modes_end(end, k, &now, half_s, half_c);
  modes_end(d, k, &var, half_s, half_c);
  double pull = k->omc * k->omc, shift_c[3];
  trig_sum_at(shift_c, &shift.rate, s->tc);
  s->wc = end[0];
  s->rc = end[1];
  s->qc = end[2];
  s->dqc = d[2] - pull * s->rc * (-shift_c[0] / root.rate);
  bool up = s->qc > 0 || (s->qc == 0 && s->rc < 0);
  s->r_end = (up ? 1 : -1) * hypot(s->rc, s->qc / k->omc);
  s->defect = s->r_end - s->r;
  s->slope = (s->rc * d[1] + s->qc * d[2] / pull) / s->r_end - pb;
}

void return_map_double_times(double *ta, double *td, const struct return_map_double *k, const struct pass *s) {
  double turn = atan2(fabs(s->qc), (s->r_end > 0 ? 1 : -1) * k->omc * s->rc);
  *td = turn / k->omc;
  *ta = (k->e1 - s->wc + k->chi * (s->r_end - s->rc)) / k->a - *td;
}
