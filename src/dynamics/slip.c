/* First roots in phase H by nodes.

   A stretch of a radian or two between two nodes is decided at once (slip.h), so a root found somehow is proved the first one
   by a handful of nodes at most; where it is not, nodes are marched from the start, each stretch being decided before the
   next. */
#include "slip.h"

enum { MOST_NODES = 96, MOST_STEPS = 8 };
static const double SETTLED = 0x1p-13; /* of an angle: the error after a step of this size is its fourth power */

void stop_at(struct stop *x, const struct slip_motion *h, double t) {
  x->t = t;
  slip_turn(x->x, h->k, t);
  x->n = slip_node(h->k, &h->m, &h->g, x->x);
}

/* f < 0 between two stops; root: the later one is a root. */
static bool clear_between(const struct slip_motion *h, int mass, const struct stop *from, const struct stop *to,
                          bool root, double sixth, double noise) {
  struct course a = mass == 0 ? course_1(h->k, &from->n) : course_2(h->k, &from->n);
  struct course b = mass == 0 ? course_1(h->k, &to->n) : course_2(h->k, &to->n);
  if (root) b.f = 0;
  return course_below(&a, &b, to->t - from->t, sixth, noise);
}

/* From a stop on, by halving. */
static truth clear_to(const struct slip_motion *h, int mass, const struct stop *first, const struct stop *last) {
  struct stop stack[MOST_NODES], from = *first;
  double sixth[2], size[2];
  int n = 0, used = 0;
  slip_bounds(sixth, size, h->k, &h->m);
  double noise = SLIP_DOUBT * size[mass];
  stack[n++] = *last;
  while (n > 0) {
    struct stop *to = &stack[n - 1];
    if (clear_between(h, mass, &from, to, mass == 0 && n == 1, sixth[mass], noise)) {
      from = *to;
      n--;
      continue;
    }
    if (++used == MOST_NODES) return TRUTH_UNKNOWN;
    stop_at(&stack[n], h, 0.5 * (from.t + to->t));
    if ((mass == 0 ? stack[n].n.p : stack[n].n.q) > noise) return TRUTH_FALSE;
    n++;
  }
  return TRUTH_TRUE;
}

static struct stop beginning(const struct slip_motion *h) {
  return (struct stop){0, {{0, 1}, {0, 1}}, slip_start(h->k, &h->g)};
}

truth slip_stays_below(const struct slip_motion *h, int mass, const struct stop *last) {
  const struct stop first = beginning(h);
  return clear_to(h, mass, &first, last);
}

/* A simple root that rises, from t, by Householder's iteration of the third order. */
static bool root_near(struct stop *x, const struct slip_motion *h, double t) {
  const struct slip *k = h->k;
  stop_at(x, h, t);
  for (int i = 0; i < MOST_STEPS; i++) {
    const struct node *n = &x->n;
    double step = quartic_step(n->p, -n->w, k->chi * n->q - k->a - n->p, n->w - k->chi * n->pull);
    double turn = k->om[1] * fabs(step);
    if (!(x->t + step > 0 && turn < 4)) return false;
    if (turn < HALF_ANGLE_NEAR) {
      x->t += step;
      for (int l = 0; l < 2; l++) x->x[l] = half_angle_move(x->x[l], k->om[l] * step);
      x->n = slip_node(k, &h->m, &h->g, x->x);
    } else {
      stop_at(x, h, x->t + step);
    }
    if (turn <= SETTLED) return x->n.w < 0;
  }
  return false;
}

int slip_first_root(struct stop *x, const struct slip_motion *h, double guess, double t_max) {
  struct stop from = beginning(h), to;
  if (!(h->g.p < 0)) return SS_UNABLE;
  if (root_near(x, h, guess) && x->t <= t_max && clear_to(h, 0, &from, x) == TRUTH_TRUE) return SS_OK;
  double sixth[2], size[2], longest = 2 * h->k->inverse[1], step = longest;
  slip_bounds(sixth, size, h->k, &h->m);
  for (int i = 0; i < MOST_NODES && from.t < t_max; i++) {
    stop_at(&to, h, from.t + step);
    if (to.n.p > 0) {
      bool inside = root_near(x, h, from.t + 0.5 * step) && x->t > from.t && x->t <= to.t;
      if (inside && x->t <= t_max && clear_to(h, 0, &from, x) == TRUTH_TRUE) return SS_OK;
    } else if (clear_between(h, 0, &from, &to, false, sixth[0], SLIP_DOUBT * size[0])) {
      from = to;
      step = longest;
      continue;
    }
    step *= 0.5;
  }
  return SS_UNABLE;
}
