/* First roots in phase H by nodes.

   A stretch of a radian or two of the fast mode between two nodes is decided at once (slip.h).  Nodes are marched from
   the start, each turned from the one before, until one lies above zero; there Householder's iteration goes to the
   root, all of its derivatives being linear in the state.  A stretch that stays open is halved. */
#include "slip.h"

enum { MOST_NODES = 96, MOST_STEPS = 8 };
static const double SETTLED = 0x1p-13; /* of an angle: the error after a step of this size is its fourth power */
static const double STRIDE = 1.5;      /* between nodes, of the angle of the fast mode; ... */
static const struct half_angle STRIDE_TURN = {0.6816387600233341, 0.7316888688738209}; /* ... sine and cosine of 0.75 */

static void stop_at(struct stop *x, const struct slip_motion *h, double t) {
  x->t = t;
  slip_turn(x->x, h->k, t);
  x->n = slip_node(h->k, &h->m, &h->g, x->x);
}

static inline struct course course_of(const struct slip_motion *h, int mass, const struct node *n) {
  return mass == 0 ? course_1(h->k, n) : course_2(h->k, n);
}

/* Whether the velocity stays below V between two stops, by halving; root: the later one is a root. */
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
    struct course a = course_of(h, mass, &from.n), b = course_of(h, mass, &to->n);
    if (root && n == 1) b.f = 0;
    if (course_below(&a, &b, to->t - from.t, sixth[mass], noise)) {
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

truth slip_stays_below(const struct slip_motion *h, int mass, const struct stop *last) {
  const struct stop first = {0, {{0, 1}, {0, 1}}, slip_start(h->k, &h->g)};
  return clear_to(h, mass, &first, last, mass == 0);
}

static double step_from(const struct slip *k, const struct node *n) {
  return quartic_step(n->p, -n->w, k->chi * n->q - k->a - n->p, n->w - k->chi * n->pull);
}

/* The state a short time later, by Taylor's polynomial of degree 3: p, q, w and pull are each other's derivatives. */
static struct node node_after(const struct slip *k, const struct node *n, double d) {
  double d2 = 0.5 * d, d3 = d * (1.0 / 3);
  double w1 = k->a + n->p - k->chi * n->q, pull1 = k->stiff * (n->q - n->p);
  double w2 = k->chi * n->pull - n->w, pull2 = k->stiff * (n->w - n->pull);
  double w3 = k->chi * pull1 - w1, pull3 = k->stiff * (w1 - pull1);
  double w = d * (w1 + d2 * (w2 + d3 * w3)), pull = d * (pull1 + d2 * (pull2 + d3 * pull3));
  return (struct node){n->p - d * (n->w + d2 * (w1 + d3 * w2)),
                       n->q - d * (n->pull + d2 * (pull1 + d3 * pull2)),
                       n->w + w,
                       n->pull + pull,
                       n->pull_change + pull,
                       n->pull_sum + pull};
}

/* A simple root that rises, from a stop and a first step on. */
static inline bool root_from(struct stop *x, const struct slip_motion *h, double step) {
  const struct slip *k = h->k;
  for (int i = 0; i < MOST_STEPS; i++) {
    double turn = k->om[1] * fabs(step);
    if (!(x->t + step > 0 && turn < 4)) return false;
    x->t += step;
    if (turn <= SETTLED && i > 0) { /* the first step may be a secant's, which is short beside a node near zero */
      for (int l = 0; l < 2; l++) x->x[l] = half_angle_move(x->x[l], k->om[l] * step);
      x->n = node_after(k, &x->n, step);
      return x->n.w < 0;
    }
    if (turn < HALF_ANGLE_NEAR)
      for (int l = 0; l < 2; l++) x->x[l] = half_angle_move(x->x[l], k->om[l] * step);
    else
      slip_turn(x->x, k, x->t);
    x->n = slip_node(k, &h->m, &h->g, x->x);
    step = step_from(k, &x->n);
  }
  return false;
}

bool slip_root_near(struct stop *x, const struct slip_motion *h, double t) {
  stop_at(x, h, t);
  return root_from(x, h, step_from(h->k, &x->n));
}

/* The first step from a stop above zero towards a root in the stretch before it, whose other end is at f. */
static inline double step_back(const struct slip *k, const struct node *n, double f, double length) {
  double step = step_from(k, n);
  return step < 0 && step > -length ? step : -length * n->p / (n->p - f);
}

/* The first root after from, where a later stop lies above zero, if it is found and proved. */
static bool root_before(struct stop *x, const struct slip_motion *h, const struct stop *from, const struct stop *to) {
  *x = *to;
  return root_from(x, h, step_back(h->k, &to->n, from->n.p, to->t - from->t)) && x->t > from->t && x->t <= to->t &&
         clear_to(h, 0, from, x, true) == TRUTH_TRUE;
}

/* The first root in a stretch that may hold several: the part that is looked at first is halved until it is plain. */
static int root_within(struct stop *x, const struct slip_motion *h, const struct stop *first, const struct stop *last) {
  struct stop from = *first, to = *last;
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

static struct stop stop_with(const struct slip_motion *h, double t, struct half_angle slow, struct half_angle fast) {
  struct stop x = {.t = t, .x = {slow, fast}};
  x.n = slip_node(h->k, &h->m, &h->g, x.x);
  return x;
}

int slip_first_root(struct stop *x, const struct slip_motion *h) {
  const struct slip *k = h->k;
  double stride = STRIDE * k->inverse[1], sixth[2], size[2];
  struct half_angle slow = {0, 1}, fast = {0, 1}, turn = half_angle(k->om[0] * stride);
  struct node start = slip_start(k, &h->g);
  struct course f = course_1(k, &start);
  if (!(h->g.p < 0)) return SS_UNABLE;
  slip_bounds(sixth, size, k, &h->m);
  double noise = SLIP_DOUBT * size[0], t = 0;
  for (int i = 1; i < MOST_NODES; i++) {
    struct half_angle next[2] = {turn_on(slow, turn), turn_on(fast, STRIDE_TURN)};
    struct node n = slip_node(k, &h->m, &h->g, next);
    struct course g = course_1(k, &n);
    bool clear = n.p <= 0 && course_below(&f, &g, stride, sixth[0], noise);
    if (n.p > 0) { /* plainly the first root, as it is mostly */
      *x = (struct stop){i * stride, {next[0], next[1]}, n};
      if (root_from(x, h, step_back(k, &n, f.f, stride)) && x->t > t && x->t <= i * stride) {
        struct course root = course_1(k, &x->n);
        root.f = 0;
        if (course_below(&f, &root, x->t - t, sixth[0], noise)) return SS_OK;
      }
    }
    if (!clear) {
      struct stop from = stop_with(h, t, slow, fast), to = stop_with(h, i * stride, next[0], next[1]);
      clear = n.p <= 0 && clear_to(h, 0, &from, &to, false) == TRUTH_TRUE;
      if (!clear) return root_within(x, h, &from, &to);
    }
    slow = next[0];
    fast = next[1];
    f = g;
    t = i * stride;
  }
  return SS_UNABLE;
}
