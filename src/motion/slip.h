/* The word in double precision as straight-line code, from half-angle sines and cosines alone.

   Shared by the return map (return_map.c), the orbit from a guess (warm.c), lanes and the search.  Phase Gamma turns
   (w, a); phase H is two oscillations, of which mass 2 follows mode i by the factor sigma[i].  What changes along a
   phase is formed as a change, 2 sin(x/2) (A sin(x/2) + B cos(x/2)) for each mode, and an amplitude that is small
   because 1 - chi is has no difference of large numbers in it: so positions never enter, and short phases keep their
   digits.  A node is the state at one time; two nodes with bounds for all time prove that a velocity stays below the
   belt's between them. */
#ifndef STICKSLIP_SLIP_H
#define STICKSLIP_SLIP_H

#include <math.h>

#include "double_double.h"
#include "dynamics.h"
#include "num/pi.h"

/* The sine and cosine of half of an angle. */
struct half_angle {
  double s, c;
};

static inline struct half_angle half_angle(double x) {
  return (struct half_angle){sin(0.5 * x), cos(0.5 * x)};
}

/* The same of x + d, |d| < 1/4: the series err by less than 2^-58. */
#define HALF_ANGLE_NEAR 0.25
static inline struct half_angle half_angle_move(struct half_angle x, double d) {
  double h = 0.5 * d, hh = h * h;
  double sine = h - h * hh * ((1.0 / 6 - hh * (1.0 / 120)) + hh * hh * (1.0 / 5040 - hh * (1.0 / 362880)));
  double versine = hh * ((0.5 - hh * (1.0 / 24)) + hh * hh * (1.0 / 720 - hh * (1.0 / 40320)));
  return (struct half_angle){x.s + (x.c * sine - x.s * versine), x.c - (x.s * sine + x.c * versine)};
}

static inline double full_sine(struct half_angle x) {
  return 2 * x.s * x.c;
}

static inline double full_versine(struct half_angle x) {
  return 2 * x.s * x.s;
}

/* Without a call, as fmax is one. */
static inline double larger(double x, double y) {
  return x > y ? x : y;
}

/* What the parameters fix. */
struct slip {
  double chi, eta, V, e1, rb, pull_b; /* rb, pull_b: r and chi eta r at the end of phase Gamma */
  double a, ease;                     /* (1 - chi) V; 1 - chi */
  double stiff, soft, omc;            /* chi eta, its inverse and root */
  double om[2], inverse[2];           /* of phase H, and 1/om */
  double rest[2];                     /* what om lacks */
  double own[2];                      /* share of a change of z_1' in each mode */
  double lead, drag;                  /* both masses at V: the slow mode has lead V, the fast one own[1] drag */
  double cross;                       /* share of a force on mass 2, minus it in the fast mode */
  double sigma[2];                    /* of mass 2 in each mode, as a multiple of mass 1 */
};

/* From how far the squares of the frequencies lie apart. */
static inline void slip_set_gap(struct slip *k, const double p[N_PARAMS], double gap) {
  double chi = p[P_CHI], ease = 1 - chi, stiff = chi * p[P_ETA], couple = chi * stiff, lead = stiff - 1;
  double large = 0.5 * (gap + fabs(lead)), small = couple / large;
  double above = lead > 0 ? large : small, below = lead > 0 ? small : large, top = 1 + above, per_gap = 1 / gap;
  double bottom = stiff * ease / top;
  k->chi = chi;
  k->eta = p[P_ETA];
  k->V = p[P_V];
  k->e1 = p[P_E1];
  k->rb = p[P_E2] / chi;
  k->pull_b = p[P_ETA] * p[P_E2];
  k->a = ease * p[P_V];
  k->ease = ease;
  k->stiff = stiff;
  k->soft = 1 / stiff;
  k->omc = sqrt(stiff);
  k->om[0] = sqrt(bottom);
  k->om[1] = sqrt(top);
  k->rest[0] = -0.5 * (product_rest(k->om[0], k->om[0]) + (k->om[0] * k->om[0] - bottom)) / k->om[0];
  k->rest[1] = 0.5 * ((top - k->om[1] * k->om[1]) - product_rest(k->om[1], k->om[1]) + (above - (top - 1))) / k->om[1];
  k->inverse[0] = 1 / k->om[0];
  k->inverse[1] = 1 / k->om[1];
  k->own[0] = above * per_gap;
  k->own[1] = below * per_gap;
  k->cross = chi * per_gap;
  k->lead = (above + chi) * per_gap;
  k->drag = k->a / top;
  k->sigma[0] = below / chi;
  k->sigma[1] = -above / chi;
}

/* In the domain; straight-line code, as is everything here, and therefore not that of flow_spectrum. */
static inline void slip_set(struct slip *k, const double p[N_PARAMS]) {
  double stiff = p[P_CHI] * p[P_ETA], lead = stiff - 1;
  slip_set_gap(k, p, sqrt(lead * lead + 4 * (p[P_CHI] * stiff)));
}

static inline bool slip_init(struct slip *k, const double p[N_PARAMS]) {
  if (!dyn_in_domain_d(p)) return false;
  slip_set(k, p);
  return true;
}

/* Half of om t, whose rounding would grow with t. */
static inline void slip_turn(struct half_angle x[2], const struct slip *k, double t) {
  for (int i = 0; i < 2; i++) {
    double off = 0.5 * (product_rest(k->om[i], t) + k->rest[i] * t);
    struct half_angle at = half_angle(k->om[i] * t);
    x[i] = (struct half_angle){at.s + at.c * off, at.c - at.s * off};
  }
}

/* The end of phase Gamma. */
struct gamma_end {
  double rise, p, w, dw; /* r has risen by; z_1' - V; w and w' */
};

/* x - sin x from the half angle. */
static inline double turned(double x, struct half_angle b) {
  if (x > 0.5) return x - full_sine(b);
  double y = x * x;
  return x * y *
         (1.0 / 6 -
          y * (1.0 / 120 - y * (1.0 / 5040 - y * (1.0 / 362880 - y * (1.0 / 39916800 - y * (1.0 / 6227020800))))));
}

static inline struct gamma_end gamma_at(const struct slip *k, double t, struct half_angle b) {
  double sine = full_sine(b), versine = full_versine(b), swing = 2 * b.s * (k->a * b.s + k->e1 * b.c);
  return (struct gamma_end){k->a * turned(t, b) + k->e1 * versine, -swing, k->e1 * (1 - versine) + k->a * sine,
                            k->a - swing};
}

/* Phase H from that end: z_1' is the sum over modes of a cos - b sin. */
struct slip_modes {
  double a[2], b[2];
};

static inline struct slip_modes slip_modes(const struct slip *k, const struct gamma_end *g) {
  return (struct slip_modes){{k->own[0] * g->p + k->lead * k->V, k->own[1] * (g->p + k->drag)},
                             {(k->own[0] * g->w + k->cross * k->pull_b) * k->inverse[0],
                              (k->own[1] * g->w - k->cross * k->pull_b) * k->inverse[1]}};
}

/* A time in phase H: velocities over the belt's, w, and pull = chi eta r; how far pull has come, and the sum of pull
   there and at the start. */
struct node {
  double p, q, w, pull, pull_change, pull_sum;
};

static inline struct node slip_start(const struct slip *k, const struct gamma_end *g) {
  return (struct node){g->p, 0, g->w, k->pull_b, 0, 2 * k->pull_b};
}

static inline struct node slip_node(const struct slip *k, const struct slip_modes *m, const struct gamma_end *g,
                                    const struct half_angle x[2]) {
  double speed[2], force[2], sum[2];
  for (int i = 0; i < 2; i++) {
    double sine = full_sine(x[i]), versine = full_versine(x[i]), swing = m->a[i] * sine;
    speed[i] = m->a[i] * versine + m->b[i] * sine; /* changes */
    force[i] = k->om[i] * (swing - m->b[i] * versine);
    sum[i] = k->sigma[i] * k->om[i] * (swing + 2 * m->b[i] * (x[i].c * x[i].c));
  }
  double w = force[0] + force[1], pull = k->sigma[0] * force[0] + k->sigma[1] * force[1];
  return (struct node){g->p - (speed[0] + speed[1]),
                       -(k->sigma[0] * speed[0] + k->sigma[1] * speed[1]),
                       g->w + w,
                       k->pull_b + pull,
                       pull,
                       sum[0] + sum[1]};
}

/* Of the motion whose z_1' - V and w start with that speed and force, z_2' and chi eta r with none. */
static inline struct slip_modes slip_modes_change(const struct slip *k, double speed, double force) {
  struct slip_modes m;
  for (int i = 0; i < 2; i++) {
    m.a[i] = k->own[i] * speed;
    m.b[i] = k->own[i] * force * k->inverse[i];
  }
  return m;
}

/* Derivatives by t_b at a fixed time. */
struct change {
  double p, q, pull;
};

static inline struct change slip_change(const struct slip *k, const struct gamma_end *g, const struct half_angle x[2]) {
  struct slip_modes m = slip_modes_change(k, -g->w, g->dw); /* r at the end of phase Gamma is fixed */
  double speed[2], force[2];
  for (int i = 0; i < 2; i++) {
    double sine = full_sine(x[i]), cosine = 1 - full_versine(x[i]);
    speed[i] = m.a[i] * cosine - m.b[i] * sine;
    force[i] = k->om[i] * (m.a[i] * sine + m.b[i] * cosine);
  }
  return (struct change){speed[0] + speed[1], k->sigma[0] * speed[0] + k->sigma[1] * speed[1],
                         k->sigma[0] * force[0] + k->sigma[1] * force[1]};
}

/* --- First roots. ---

   Between two times x < y the polynomial of degree 5 with f, f', f'' of both ends errs by at most
   sixth/720 (s - x)^3 (y - s)^3, sixth a bound of the sixth derivative for all time.  As a polynomial of degree 6 in
   Bernstein's form the error is one coefficient, and no value exceeds the largest coefficient. */

/* One velocity at both ends: its value, derivative and second derivative. */
struct course {
  double f, d, dd;
};

static inline struct course course_1(const struct slip *k, const struct node *n) {
  return (struct course){n->p, -n->w, k->chi * n->q - k->a - n->p};
}

static inline struct course course_2(const struct slip *k, const struct node *n) {
  return (struct course){n->q, -n->pull, k->stiff * (n->p - n->q)};
}

/* f < 0 inside (x, y), y - x = h, by more than the noise but near an end that is a root itself. */
static inline bool course_below(const struct course *x, const struct course *y, double h, double sixth, double noise) {
  double d0 = h * x->d, d1 = h * y->d, dd0 = h * h * x->dd, dd1 = h * h * y->dd, h6 = h * h * h * h * h * h;
  double c1 = x->f + d0 * (1.0 / 6), c2 = x->f + d0 * (1.0 / 3) + dd0 * (1.0 / 30);
  double c5 = y->f - d1 * (1.0 / 6), c4 = y->f - d1 * (1.0 / 3) + dd1 * (1.0 / 30);
  double c3 = 0.5 * (x->f + y->f + 0.4 * (d0 - d1) + 0.05 * (dd0 + dd1)) + sixth * h6 * (1.0 / 14400);
  return (x->f <= 0) & (y->f <= 0) & (c1 < -noise) & (c2 < -noise) & (c3 < -noise) & (c4 < -noise) & (c5 < -noise);
}

/* Bounds of z_1' and z_2', and of their sixth derivatives. */
static inline void slip_bounds(double sixth[2], double size[2], const struct slip *k, const struct slip_modes *m) {
  double each[2], bent[2];
  for (int i = 0; i < 2; i++) {
    double square = k->om[i] * k->om[i];
    each[i] = fabs(m->a[i]) + fabs(m->b[i]);
    bent[i] = each[i] * (square * square * square);
  }
  size[0] = each[0] + each[1];
  size[1] = fabs(k->sigma[0]) * each[0] + fabs(k->sigma[1]) * each[1];
  sixth[0] = bent[0] + bent[1];
  sixth[1] = fabs(k->sigma[0]) * bent[0] + fabs(k->sigma[1]) * bent[1];
}

/* A step to a simple root of f, from its derivatives: what is left is of the fourth order. */
static inline double quartic_step(double f, double f1, double f2, double f3) {
  double slope = f1 * f1, bend = f * f2;
  return -f * (6 * slope - 3 * bend) / (f1 * (6 * slope - 6 * bend) + f * f * f3);
}

/* --- slip.c --- */

/* Phase H from one end of phase Gamma. */
struct slip_motion {
  const struct slip *k;
  struct gamma_end g;
  struct slip_modes m;
};
/* A time in it, the half angles there and the node. */
struct stop {
  double t;
  struct half_angle x[2];
  struct node n;
};

/* What is nearer to zero than this part of its size has no sign. */
#define SLIP_DOUBT 0x1p-30

/* Whether z'_mass < V between the start and the stop, which for mass 0 is a root; a time surely above V says no. */
truth slip_stays_below(const struct slip_motion *h, int mass, const struct stop *last);
/* The first root of z_1' - V, proved to be that, and simple.  SS_UNABLE: not so plain, or after 142, as omega_2 > 1. */
int slip_first_root(struct stop *x, const struct slip_motion *h);

/* A simple root near t at which z_1' - V rises; whether another comes before it is not asked. */
bool slip_root_near(struct stop *x, const struct slip_motion *h, double t);

/* --- Phase C turns (r, q/omega) to the radius r_end. --- */

static inline double slip_radius(const struct slip *k, const struct node *n) {
  double r = n->pull * k->soft, radius = sqrt(r * r + n->q * n->q * k->soft);
  bool up = n->q > 0 || (n->q == 0 && r < 0);
  return up ? radius : -radius;
}

/* r_end - r_b, small where phase H brings r to +r_b or -r_b with m2 at the belt's speed. */
static inline double slip_gain(const struct slip *k, const struct node *n, double r_end) {
  if (!(r_end > 0)) return r_end - k->rb;
  double per = k->soft / (r_end + k->rb); /* so that nothing of any size overflows */
  return n->pull_change * (n->pull_sum * k->soft * per) + n->q * (n->q * per);
}

static inline double slip_td(const struct slip *k, const struct node *n, double r_end) {
  double r = n->pull * k->soft;
  return atan2(fabs(n->q), (r_end > 0 ? k->omc : -k->omc) * r) / k->omc;
}

/* How far m1 falls behind the belt: z_1 is where it was when t_a + t_b + t_c + t_d of the belt's way has made up for
   it. */
static inline double slip_behind(const struct slip *k, const struct gamma_end *g, const struct slip_modes *m,
                                 const struct half_angle x[2], double tc) {
  double way[2];
  for (int i = 0; i < 2; i++) way[i] = (m->a[i] * full_sine(x[i]) - m->b[i] * full_versine(x[i])) * k->inverse[i];
  return g->rise + ((k->V * tc - way[0]) - way[1]);
}

/* --- Newton's iteration for an orbit, in (t_b, t_c). --- */

/* Of p = 0 and defect = 0; the derivative of p by t_c is -w. */
SINCOS_INLINE void slip_newton(double step[2], double p, double w, double p_tb, double defect, double defect_tb,
                               double defect_tc) {
  double scale = 1 / (p_tb * defect_tc + w * defect_tb);
  step[0] = -(defect_tc * p + w * defect) * scale;
  step[1] = -(p_tb * defect - defect_tb * p) * scale;
}

/* Everything at a pair (t_b, t_c), and the step from there. */
struct slip_pair {
  struct slip k;
  double tb, tc;
  struct half_angle b, c[2];
  struct gamma_end g;
  struct slip_modes m;
  struct node n;
  double r, r_end;
  double p_tb, turn_tb, defect_tb; /* by t_b; the last two times r_end, turn_tb that of r_end */
  double step[2];
};

/* From k, the times and the half angles.  The defect and its derivatives are multiplied by r_end, which saves
   divisions.  exact: with the defect formed from changes. */
SINCOS_INLINE void slip_evaluate(struct slip_pair *x, bool exact) {
  const struct slip *k = &x->k;
  x->g = gamma_at(k, x->tb, x->b);
  x->m = slip_modes(k, &x->g);
  x->n = slip_node(k, &x->m, &x->g, x->c);
  struct change d = slip_change(k, &x->g, x->c);
  double r = x->n.pull * k->soft;
  x->r = k->rb - x->g.rise;
  x->r_end = slip_radius(k, &x->n);
  double defect = x->r_end * (exact ? slip_gain(k, &x->n, x->r_end) + x->g.rise : x->r_end - x->r);
  x->p_tb = d.p;
  x->turn_tb = k->soft * (r * d.pull + x->n.q * d.q);
  x->defect_tb = x->turn_tb - x->r_end * x->g.p;
  slip_newton(x->step, x->n.p, x->n.w, x->p_tb, defect, x->defect_tb, -r * x->n.p);
}

/* The ends of the word. */
struct slip_close {
  double ta, period;
  double least; /* e1 - w in phase C */
};

/* t_a from two sums, whichever has the smaller terms: what w is short of e1, and the belt's way that m1 is behind.
   Inside phase C w' = a - chi q vanishes only where q > 0: in a valley at the angle u before the end, and on a hill at
   pi - u. */
SINCOS_INLINE struct slip_close slip_close(const struct slip_pair *x) {
  const struct slip *k = &x->k;
  bool up = x->n.q > 0;
  double r = x->n.pull * k->soft, turn = sincos_angle(fabs(x->n.q), (up ? k->omc : -k->omc) * r), td = turn / k->omc;
  double both = x->r_end + r, left = x->r_end * r > 0 ? x->n.q * x->n.q * k->soft / both : x->r_end - r;
  double sine = full_sine(x->b), versine = full_versine(x->b), change = x->n.w - x->g.w;
  double short_c = (k->e1 * versine - k->a * sine) - change, slack = short_c + k->chi * left;
  double behind = slip_behind(k, &x->g, &x->m, x->c, x->tc), others = x->tb + x->tc;
  double size = k->e1 * versine + k->a * fabs(sine) + fabs(x->n.w) + fabs(x->g.w) + k->chi * (fabs(r) + fabs(x->r_end));
  bool by_force = size < k->a * others;
  double time = (by_force ? slack : behind) / (by_force ? k->a : k->V);
  double ta = (by_force ? time : time - others) - td, period = by_force ? others + time : time;

  double fast = k->chi * k->omc * x->r_end, end = k->a * ta, slow = k->soft * k->omc;
  bool inner = fast > k->a;
  double square = inner ? (fast - k->a) * (fast + k->a) : 1, root = sqrt(square), u = sincos_angle(k->a, root);
  double hill = end + slow * (k->a * (PI - u) - (fast + root)), least = short_c < end ? short_c : end;
  bool on_hill = inner & (PI - u < turn) & (hill < least);
  return (struct slip_close){ta, period, on_hill ? hill : least};
}

#endif
