/* First roots in phase H by nodes.

   A stretch of two radians or so of the fast mode between two nodes is decided at once (slip.h).  Nodes are marched from the
   start, each turned from the one before, until one lies above zero; there Householder's iteration goes to the root, all
   of its derivatives being linear in the state.  A stretch that stays open is halved. */
#include "slip.h"

enum { MOST_NODES = 96, MOST_STEPS = 8 };
static const double SETTLED = 0x1p-13; /* of an angle: the error after a step of this size is its fourth power */
static const double STRIDE = 2.2;      /* between nodes, of the angle of the fast mode; ... */
static const struct half_angle STRIDE_TURN = {0.8912073600614353, 0.4535961214255774}; /* ... sine and cosine of 1.1 */

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

/* The same by halving. */
static truth clear_to(const struct slip_motion *h, int mass, const struct stop *first, const struct stop *last,
                      bool root) {
  struct stop stack[MOST_NODES], from = *first;
  double sixth[2], size[2];
  int n = 0, used = 0;
  slip_bounds(sixth, size, h->k, &h->m);
  double noise = SLIP_DOUBT * size[mass];
  stack[n++] = *last;
  while (n > 0) {
    struct stop *to = &stack[n - 1];
    if (clear_between(h, mass, &from, to, root && n == 1, sixth[mass], noise)) {
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
  return clear_to(h, mass, &first, last, mass == 0);
}

static double step_from(const struct slip *k, const struct node *n) {
  return quartic_step(n->p, -n->w, k->chi * n->q - k->a - n->p, n->w - k->chi * n->pull);
}

/* A simple root that rises, from t. */
static bool root_near(struct stop *x, const struct slip_motion *h, double t) {
  const struct slip *k = h->k;
  stop_at(x, h, t);
  for (int i = 0; i < MOST_STEPS; i++) {
    double step = step_from(k, &x->n), turn = k->om[1] * fabs(step);
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

/* The first root after from, where a later stop lies above zero, if it is found and proved. */
static bool root_before(struct stop *x, const struct slip_motion *h, const struct stop *from, const struct stop *to) {
  double near = to->t + step_from(h->k, &to->n);
  if (!(near > from->t && near < to->t)) near = from->t + (to->t - from->t) * from->n.p / (from->n.p - to->n.p);
  return root_near(x, h, near) && x->t > from->t && x->t <= to->t && clear_to(h, 0, from, x, true) == TRUTH_TRUE;
}

/* The first root in a stretch that may hold several: the part that is looked at first is halved until it is plain. */
static int root_within(struct stop *x, const struct slip_motion *h, struct stop from, const struct stop *last) {
  struct stop to = *last;
  for (int i = 0; i < MOST_NODES; i++) {
    if (to.n.p > 0) {
      if (root_before(x, h, &from, &to)) return SS_OK;
    } else if (clear_to(h, 0, &from, &to, false) == TRUTH_TRUE) {
      if (to.t >= last->t) return SS_UNABLE;
      double step = to.t - from.t;
      from = to;
      stop_at(&to, h, from.t + 2 * step < last->t ? from.t + 2 * step : last->t);
      continue;
    }
    stop_at(&to, h, 0.5 * (from.t + to.t));
  }
  return SS_UNABLE;
}

static struct half_angle turn_on(struct half_angle x, struct half_angle by) {
  return (struct half_angle){x.s * by.c + x.c * by.s, x.c * by.c - x.s * by.s};
}

int slip_first_root(struct stop *x, const struct slip_motion *h, double t_max) {
  const struct slip *k = h->k;
  struct stop from = beginning(h), to;
  double stride = STRIDE * k->inverse[1], sixth[2], size[2];
  struct half_angle slow = half_angle(k->om[0] * stride);
  if (!(h->g.p < 0)) return SS_UNABLE;
  slip_bounds(sixth, size, k, &h->m);
  for (int i = 1; i < MOST_NODES && from.t < t_max; i++) {
    to.t = i * stride;
    to.x[0] = turn_on(from.x[0], slow);
    to.x[1] = turn_on(from.x[1], STRIDE_TURN);
    to.n = slip_node(k, &h->m, &h->g, to.x);
    bool plain = clear_between(h, 0, &from, &to, false, sixth[0], SLIP_DOUBT * size[0]);
    if (!plain && (to.n.p > 0 || clear_to(h, 0, &from, &to, false) != TRUTH_TRUE)) {
      int status = root_within(x, h, from, &to);
      return status || x->t > t_max ? SS_UNABLE : SS_OK;
    }
    from = to;
  }
  return SS_UNABLE;
}
