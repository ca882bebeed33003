/* Orbits of the equations of given.h at given t_b and t_c.

   The state at t_c and r_0 are linear in e1 and e2.  p_c = 0 is a line of (e1, e2), and along it the squares of the
   equations for r_c and q_c/omega add up to a quadratic, whose two roots are the two sheets. */
#include "given_search.h"

#include <math.h>

#include "num/pi.h"

struct gamma_turn gamma_turn_at(double t) {
  struct half_angle b = half_angle(t);
  return (struct gamma_turn){t, sin(t), cos(t), full_versine(b), turned(t, b)};
}

static void slip_matrix_function(double out[4], const struct slip *k, double slow, double fast) {
  const double *own = k->own;
  double lead = k->cross * (slow - fast);
  out[0] = own[0] * slow + own[1] * fast;
  out[1] = lead;
  out[2] = lead * k->eta;
  out[3] = own[1] * slow + own[0] * fast;
}

struct slip_matrix slip_matrix_at(const struct slip *k, double t) {
  struct slip_matrix h = {.t = t};
  double s[2] = {sin(k->om[0] * t), sin(k->om[1] * t)};
  slip_matrix_function(h.c, k, cos(k->om[0] * t), cos(k->om[1] * t));
  slip_matrix_function(h.s, k, s[0] / k->om[0], s[1] / k->om[1]);
  slip_matrix_function(h.n, k, s[0] * k->om[0], s[1] * k->om[1]);
  return h;
}

/* A quantity that is linear in e1 and e2: x[0] e1 + x[1] e2 + x[2]. */
struct linear {
  double x[3];
};

static struct linear velocity(const struct slip *k, const struct gamma_turn *b, const double c[2], const double s[2]) {
  double v1 = k->chi * k->V + k->a * b->c;
  return (struct linear){{-c[0] * b->s - s[0] * b->c, -s[1] * k->eta, c[0] * v1 + c[1] * k->V - s[0] * k->a * b->s}};
}

static struct linear force(const struct slip *k, const struct gamma_turn *b, const double c[2], const double n[2]) {
  double v1 = k->chi * k->V + k->a * b->c;
  return (struct linear){{c[0] * b->c - n[0] * b->s, c[1] * k->eta, c[0] * k->a * b->s + n[0] * v1 + n[1] * k->V}};
}

static double along(const struct linear *f, const double u[3]) {
  return f->x[0] * u[0] + f->x[1] * u[1] + f->x[2] * u[2];
}

/* The roots of a s^2 + 2 b s + c, the one with the root's plus sign first, so that each moves continuously; infinite
   or NaN when there are none.  Returns the discriminant relative to its terms, in [-1, 1]. */
static double quadratic_roots(double s[2], double a, double b, double c) {
  double square = b * b - a * c, root = sqrt(square);
  s[0] = b > 0 ? c / (-b - root) : (root - b) / a;
  s[1] = b > 0 ? (-b - root) / a : c / (root - b);
  return square / (b * b + fabs(a * c));
}

void sheets_at(struct sheet out[2], const struct slip *k, const struct gamma_turn *b, const struct slip_matrix *h) {
  struct linear p = velocity(k, b, h->c, h->s), q = velocity(k, b, h->c + 2, h->s + 2);
  struct linear w = force(k, b, h->c, h->n), pull = force(k, b, h->c + 2, h->n + 2);
  struct linear r0 = {{-b->versine, 1 / k->chi, -k->a * b->lag}}, y = q;
  p.x[2] -= k->V;
  y.x[2] -= k->V;
  for (int i = 0; i < 3; i++) {
    pull.x[i] /= k->omc * k->omc;
    y.x[i] /= k->omc;
  }
  double norm = hypot(p.x[0], p.x[1]), gone = -p.x[2] / (norm * norm);
  double base[3] = {gone * p.x[0], gone * p.x[1], 1}, way[3] = {-p.x[1] / norm, p.x[0] / norm, 0};
  double rw = along(&pull, way), yw = along(&y, way), ew = along(&r0, way);
  double rb = along(&pull, base), yb = along(&y, base), eb = along(&r0, base), s[2];
  double reality =
      quadratic_roots(s, rw * rw + yw * yw - ew * ew, rw * rb + yw * yb - ew * eb, rb * rb + yb * yb - eb * eb);
  for (int i = 0; i < 2; i++) {
    double u[3] = {base[0] + s[i] * way[0], base[1] + s[i] * way[1], 1};
    double r = along(&pull, u), end = along(&r0, u), sign = end > 0 ? 1 : -1;
    double turn = atan2(sign * along(&y, u), sign * r);
    if (turn < -0.5 * PI) turn += 2 * PI; /* the angle is wanted in (0, pi) and must not jump at its ends */
    double td = turn / k->omc, ta = (u[0] - along(&w, u) + k->chi * (end - r)) / k->a - td;
    bool real = isfinite(u[0]) && isfinite(u[1]) && isfinite(ta);
    out[i] = (struct sheet){real, reality, {u[0], u[1], ta, b->t, h->t, td}};
  }
}

double sheet_lead(const struct sheet *p, const struct slip *k, const struct gamma_turn *b,
                  const struct slip_matrix *h) {
  const double u[3] = {p->x[QUANTITY_E1], p->x[QUANTITY_E2], 1};
  struct linear v = velocity(k, b, h->c, h->s);
  return along(&v, u) - k->V;
}
