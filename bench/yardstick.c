/* The slip-stick phase turns (w, a) about the origin, so its end is a root of r + g(t) = e2/chi with
   g = a (t - sin t) + e1 (1 - cos t); the slip phase is two oscillations; the stick-slip phase turns (r, q/omega), and
   ends where q is back at zero, at the radius.  The last Newton step rotates sines and cosines instead of asking libm
   again. */
#include "bench/yardstick.h"

#include <math.h>

enum { MOST = 40 };

void yardstick_init(struct yardstick *k, const double *params) {
  double chi = params[0], eta = params[1], V = params[2], e1 = params[3], e2 = params[4];
  double stiff = chi * eta, couple = chi * stiff, lead = stiff - 1, gap = sqrt(lead * lead + 4 * couple);
  double above = lead > 0 ? 0.5 * (gap + lead) : couple / (0.5 * (gap - lead)), below = couple / above;
  double large = 1 + above;
  *k = (struct yardstick){.chi = chi,
                          .V = V,
                          .e1 = e1,
                          .rb = e2 / chi,
                          .pull_b = eta * e2,
                          .a = (1 - chi) * V,
                          .stiff = stiff,
                          .omc = sqrt(stiff),
                          .om = {sqrt(stiff * (1 - chi) / large), sqrt(large)},
                          .above = above / gap,
                          .below = below / gap,
                          .cross = chi / gap,
                          .back = stiff / gap};
}

/* Velocity of each mass: the sum over modes of a cos - b sin. */
struct modes {
  double a[2][2], b[2][2];
};

static struct modes modes_from(const struct yardstick *k, double v1, double v2, double f1, double f2) {
  struct modes m;
  m.a[0][0] = k->above * v1 + k->cross * v2;
  m.a[1][0] = k->back * v1 + k->below * v2;
  m.a[0][1] = v1 - m.a[0][0];
  m.a[1][1] = v2 - m.a[1][0];
  double s1 = k->above * f1 + k->cross * f2, s2 = k->back * f1 + k->below * f2;
  m.b[0][0] = s1 / k->om[0];
  m.b[1][0] = s2 / k->om[0];
  m.b[0][1] = (f1 - s1) / k->om[1];
  m.b[1][1] = (f2 - s2) / k->om[1];
  return m;
}

static double speed(const struct modes *m, int mass, const double s[2], const double c[2]) {
  return m->a[mass][0] * c[0] - m->b[mass][0] * s[0] + m->a[mass][1] * c[1] - m->b[mass][1] * s[1];
}

/* Minus the acceleration. */
static double force(const struct yardstick *k, const struct modes *m, int mass, const double s[2], const double c[2]) {
  return k->om[0] * (m->a[mass][0] * s[0] + m->b[mass][0] * c[0]) +
         k->om[1] * (m->a[mass][1] * s[1] + m->b[mass][1] * c[1]);
}

/* A sine and a cosine moved by a small angle: to the fourth order, the error is that of d^5. */
static void rotate(double *s, double *c, double d) {
  double h = 0.5 * d * d, sd = d * (1 - h / 3), cd = h * (1 - h / 6), s0 = *s;
  *s += *c * sd - *s * cd;
  *c -= s0 * sd + *c * cd;
}

static int solve_tb(double *tb, double *sine, double *cosine, const struct yardstick *k, double rise, double guess) {
  double t = guess;
  for (int i = 1; i < MOST; i++) {
    double s = sin(t), c = cos(t);
    double step = -(k->a * (t - s) + k->e1 * (1 - c) - rise) / (k->a * (1 - c) + k->e1 * s);
    t += step;
    if (fabs(step) < 1e-8) {
      rotate(&s, &c, step);
      *tb = t;
      *sine = s;
      *cosine = c;
      return i;
    }
  }
  return 0;
}

/* The end of the slip phase onwards, at the sines and cosines of om t_c. */
static void finish(struct yardstick_pass *p, const struct yardstick *k, const struct modes *m, const double s[2],
                   const double c[2]) {
  p->wc = force(k, m, 0, s, c);
  p->rc = force(k, m, 1, s, c) / k->stiff;
  p->qc = speed(m, 1, s, c) - k->V;
  double turned = p->qc / k->omc, radius = sqrt(p->rc * p->rc + turned * turned);
  p->r_end = p->qc > 0 ? radius : -radius;
  p->td = atan2(fabs(turned), p->qc > 0 ? p->rc : -p->rc) / k->omc;
}

static int solve_tc(struct yardstick_pass *p, const struct yardstick *k, const struct modes *m, double guess) {
  double t = guess;
  for (int i = 1; i < MOST; i++) {
    double s[2] = {sin(k->om[0] * t), sin(k->om[1] * t)}, c[2] = {cos(k->om[0] * t), cos(k->om[1] * t)};
    double step = (speed(m, 0, s, c) - k->V) / force(k, m, 0, s, c);
    t += step;
    if (fabs(step) < 1e-8) {
      for (int j = 0; j < 2; j++) rotate(&s[j], &c[j], k->om[j] * step);
      p->tc = t;
      finish(p, k, m, s, c);
      return i;
    }
  }
  return 0;
}

int yardstick_map(struct yardstick_pass *p, const struct yardstick *k, double r, const double hint[2]) {
  double s = 0, c = 1;
  int first = solve_tb(&p->tb, &s, &c, k, k->rb - r, hint[0]);
  p->r = r;
  p->wb = k->e1 * c + k->a * s;
  p->pb = -(k->a * (1 - c) + k->e1 * s);
  struct modes m = modes_from(k, k->V + p->pb, k->V, p->wb, k->pull_b);
  int second = solve_tc(p, k, &m, hint[1]);
  return first && second ? first + second : 0;
}

void yardstick_at(struct yardstick_pass *p, const struct yardstick *k, double tb, double tc) {
  double sb = sin(tb), cb = cos(tb);
  double s[2] = {sin(k->om[0] * tc), sin(k->om[1] * tc)}, c[2] = {cos(k->om[0] * tc), cos(k->om[1] * tc)};
  p->tb = tb;
  p->tc = tc;
  p->r = k->rb - (k->a * (tb - sb) + k->e1 * (1 - cb));
  p->wb = k->e1 * cb + k->a * sb;
  p->pb = -(k->a * (1 - cb) + k->e1 * sb);
  struct modes m = modes_from(k, k->V + p->pb, k->V, p->wb, k->pull_b);
  struct modes d = modes_from(k, -p->wb, 0, k->a + p->pb, 0); /* by t_b, r_b being fixed */
  finish(p, k, &m, s, c);
  p->pc = speed(&m, 0, s, c) - k->V;
  p->pc_tb = speed(&d, 0, s, c);
  p->qc_tb = speed(&d, 1, s, c);
  p->wc_tb = force(k, &d, 0, s, c);
  p->rc_tb = force(k, &d, 1, s, c) / k->stiff;
}

/* Along the root of p = z_1' - V in t_c, by t_b: r, q and the angle of phase C. */
struct slopes {
  double r_end, z1_end;
};

static struct slopes along(const struct yardstick_pass *p, const struct yardstick *k) {
  double dtc = p->pc_tb / p->wc; /* p' = -w */
  double dw = p->wc_tb + (k->a - k->chi * p->qc) * dtc, dr = p->rc_tb + p->qc * dtc;
  double dq = p->qc_tb - k->stiff * p->rc * dtc, turned = p->qc / k->omc, dturned = dq / k->omc;
  double dtd = (p->rc * dturned - turned * dr) / (p->r_end * p->r_end) / k->omc;
  return (struct slopes){(p->rc * dr + turned * dturned) / p->r_end, (dw + k->chi * dr) / (1 - k->chi) + k->V * dtd};
}

void yardstick_jacobian(double j[4], const struct yardstick_pass *p, const struct yardstick *k) {
  struct slopes s = along(p, k); /* by t_b; r at the stick phase falls by -pb */
  double z1 = s.z1_end / p->pb, z2 = z1 + s.r_end / p->pb;
  j[0] = -z1;
  j[1] = z1;
  j[2] = -z2;
  j[3] = z2;
}

double yardstick_trace(const struct yardstick_pass *p, const struct yardstick *k) {
  return along(p, k).r_end / p->pb;
}

int yardstick_orbit(struct yardstick_pass *p, const struct yardstick *k, double tb, double tc) {
  for (int i = 1; i < MOST; i++) {
    yardstick_at(p, k, tb, tc);
    double turned_tb = p->qc_tb / k->stiff; /* q d q / omega^2 */
    double defect = p->r_end - p->r, defect_tb = (p->rc * p->rc_tb + p->qc * turned_tb) / p->r_end - p->pb;
    double defect_tc = -p->rc * p->pc / p->r_end, det = p->pc_tb * defect_tc + p->wc * defect_tb;
    double step_b = -(defect_tc * p->pc + p->wc * defect) / det;
    double step_c = -(p->pc_tb * defect - defect_tb * p->pc) / det;
    tb += step_b;
    tc += step_c;
    if (!(fabs(step_b) + fabs(step_c) < 1e-8)) continue;
    yardstick_at(p, k, tb, tc);
    return i;
  }
  return 0;
}
