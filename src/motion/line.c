/* The common zeros of p and H along t_c where t_b and one of e1, e2 are given.

   With the other one, e, everything at t_c is linear: p = p_0 + p_1 e, and so q, r and r_0.  So e = -p_0/p_1, and with
   R = r_0 p_1 - r_1 p_0 and the like F = R^2 + Q^2/omega^2 - C^2, C from r at the stick phase, is zero where both
   equations hold.  F and its derivative are known in closed form (p' = -w, q' = -chi eta r, r' = q - p); intervals of
   t_c are excluded, proved to hold one zero (Newton's operator), or halved. */
#include "line.h"
#include "cell.h"
#include "num/pi.h"

#include <stdlib.h>

#include "base/arena.h"

enum { CONSTANT, LINEAR, N_PARTS, FINEST_CELL = 30 };

struct course {
  struct disk_params params;
  struct disk a[N_PARTS][2], b[N_PARTS][2]; /* the modes, as those of a strip */
  struct disk c[N_PARTS];                   /* r at the stick phase */
  bool pull;                                /* the unknown is e2 */
  bool never;                               /* t_b belongs to no orbit */
};

/* The rise is surely not at a record at t_b: no orbit has this e1 and t_b. */
static bool overtaken(const struct disk_params *g, arb_srcptr tb) {
  struct strip p;
  double k = floor(num_arb.get_d(tb) / (2 * PI));
  struct disk angle = disk_less_turns(tb, k);
  if (disk_positive(disk_sub(angle, g->fall))) return true;
  strip_make(&p, g, disk_low(angle), disk_high(angle), 0);
  return k > 0 && !p.later;
}

static bool course_init(struct course *o, const fmpq *params, int unknown, const fmpq *tb) {
  fmpq p[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) p[i] = params[i]; /* borrowed */
  NUMBERS(fmpq, one);
  fmpq_one(one);
  p[unknown] = *one;
  bool fits = disk_params_init(&o->params, p);
  const struct disk_params *g = &o->params;
  NUMBERS(arb, t);
  arb_set_fmpq(t, tb, 128);
  struct disk sine, cosine, time = disk_arb(t), zero = {0, 0}, unit = {1, 0};
  disk_sin_cos(&sine, &cosine, t);
  o->pull = unknown == P_E2;
  o->never = o->pull && overtaken(g, t);
  /* what e1, e2 and neither bring in */
  struct disk v1 = disk_add(disk_sub(g->V, g->a), disk_mul(g->a, cosine)), w = disk_mul(g->a, sine);
  struct disk r = disk_mul(g->a, disk_sub(sine, time)), pull = zero;
  struct disk versine = disk_sub(unit, cosine);
  if (o->pull) {
    v1 = disk_sub(v1, disk_mul(g->e1, sine));
    w = disk_add(w, disk_mul(g->e1, cosine));
    r = disk_sub(r, disk_mul(g->e1, versine));
    disk_modes(o->a[LINEAR], o->b[LINEAR], g, zero, zero, zero, g->eta);
    o->c[LINEAR] = g->span; /* of e2 = 1 */
  } else {
    pull = g->pull;
    r = disk_add(r, g->span);
    disk_modes(o->a[LINEAR], o->b[LINEAR], g, disk_scale(sine, -1), zero, cosine, zero);
    o->c[LINEAR] = disk_scale(versine, -1);
  }
  disk_modes(o->a[CONSTANT], o->b[CONSTANT], g, v1, g->V, w, pull);
  o->c[CONSTANT] = r;
  return fits;
}

/* p, q, r, w of both parts; F and its derivative. */
struct course_at {
  struct disk p[N_PARTS], q[N_PARTS], r[N_PARTS], w[N_PARTS], f, df;
};

/* x_0 y_1 - x_1 y_0 */
static struct disk bracket(const struct disk x[N_PARTS], const struct disk y[N_PARTS]) {
  return disk_cross(x[CONSTANT], y[LINEAR], x[LINEAR], y[CONSTANT]);
}

static void course_look(struct course_at *at, const struct course *o, const struct clock *t, double wide) {
  const struct disk_params *g = &o->params;
  struct disk dp[N_PARTS], dq[N_PARTS], dr[N_PARTS];
  struct clock over = *t;
  for (int i = 0; i < 2; i++) {
    double turn = wide > 0 ? disk_mag(g->om[i]) * wide : 0;
    over.sine[i] = disk_widen(t->sine[i], turn);
    over.cosine[i] = disk_widen(t->cosine[i], turn);
  }
  for (int k = 0; k < N_PARTS; k++) {
    struct disk_motion m = disk_motion_at(g, o->a[k], o->b[k], &over);
    at->p[k] = k == CONSTANT ? disk_sub(m.v[0], g->V) : m.v[0];
    at->q[k] = k == CONSTANT ? disk_sub(m.v[1], g->V) : m.v[1];
    at->w[k] = m.w;
    at->r[k] = m.r;
    dp[k] = disk_scale(at->w[k], -1);
    dq[k] = disk_scale(disk_mul(g->stiff, at->r[k]), -1);
    dr[k] = disk_sub(at->q[k], at->p[k]);
  }
  struct disk r = bracket(at->r, at->p), q = bracket(at->q, at->p), c = bracket(o->c, at->p);
  struct disk dR = disk_add(bracket(dr, at->p), bracket(at->r, dp));
  struct disk dQ = disk_add(bracket(dq, at->p), bracket(at->q, dp)), dC = bracket(o->c, dp);
  at->f = disk_add(disk_cross(r, r, c, c), disk_mul(g->soft, disk_mul(q, q)));
  at->df = disk_scale(disk_add(disk_cross(r, dR, c, dC), disk_mul(g->soft, disk_mul(q, dQ))), 2);
}

static struct disk quotient(struct disk x, struct disk y) {
  double least = (fabs(y.mid) - y.rad) * (1 - 0x1p-50);
  return disk_mul(x, disk_widen(disk_between(1 / disk_high(y), 1 / disk_low(y)), 0x1p-40 / least));
}

/* e = -p_0/p_1 is not positive on the cell, but perhaps at t_c = 0 itself. */
static bool not_positive(const struct course *o, const struct course_at *over, bool first) {
  if (disk_positive(disk_mul(over->p[CONSTANT], over->p[LINEAR]))) return true;
  if (!first || !o->pull || !disk_negative(over->p[CONSTANT])) return false;
  /* the unknown's part starts at rest with w = 0, w' = 0: while w'' = chi^2 eta r - w > 0, p_1 = - int w falls */
  struct disk lift = disk_mul(o->params.chi, disk_mul(o->params.stiff, over->r[LINEAR]));
  return disk_positive(disk_sub(lift, over->w[LINEAR]));
}

/* Newton's operator on the cell twice as long. */
static enum look line_look(struct line_zero *z, const struct course *o, const struct clock *t, double half,
                           bool first) {
  struct course_at middle, over;
  course_look(&over, o, t, half);
  if (not_positive(o, &over, first)) return LOOK_CLEAR;
  course_look(&middle, o, t, 0);
  if (fabs(middle.f.mid) > disk_up(middle.f.rad + disk_mag(over.df) * half)) return LOOK_CLEAR;
  course_look(&over, o, t, 2 * half);
  if (!disk_nonzero(over.df) || !disk_nonzero(over.p[LINEAR])) return LOOK_OPEN;
  struct disk step = quotient(middle.f, over.df);
  if (fabs(step.mid) - step.rad > half * (1 + 0x1p-40)) return LOOK_CLEAR;
  if (!(disk_mag(step) < 2 * half * (1 - 0x1p-20))) return LOOK_OPEN;
  *z = (struct line_zero){.at = t->t - step.mid, .near = disk_up(step.rad + 0x1p-50 * t->t), .room = 2 * half};
  return LOOK_ZERO;
}

/* Newton's steps make the enclosure small; the unknown there. */
static void line_refine(struct line_zero *z, const struct course *o) {
  struct course_at middle, over;
  struct clock t;
  for (int i = 0; i < 8; i++) {
    clock_set(&t, &o->params, z->at);
    course_look(&middle, o, &t, 0);
    course_look(&over, o, &t, z->near);
    if (!disk_nonzero(over.df)) break;
    struct disk step = quotient(middle.f, over.df);
    double near = disk_up(step.rad + 0x1p-50 * z->at);
    if (!(near < z->near)) break;
    z->room -= fabs(step.mid); /* of the new middle */
    z->at -= step.mid;
    z->near = near;
  }
  clock_set(&t, &o->params, z->at);
  course_look(&over, o, &t, z->near);
  z->e = disk_scale(quotient(over.p[CONSTANT], over.p[LINEAR]), -1);
}

static void line_add(struct line *s, struct line_zero *z, const struct course *o) {
  line_refine(z, o);
  for (size_t i = 0; i < s->n; i++) {
    double apart = fabs(s->zeros[i].at - z->at) * (1 + 0x1p-40);
    if (apart + z->near < s->zeros[i].room || apart + s->zeros[i].near < z->room) return;
  }
  *SS_PUSH(s->zeros, s->n, s->cap) = *z;
}

bool line_run(struct line *s, const fmpq *params, int unknown, const fmpq *tb, double last, long budget) {
  struct course o;
  struct clock middle;
  int power;
  *s = (struct line){.n = 0};
  bool fits = course_init(&o, params, unknown, tb);
  frexp(o.params.om[1].mid, &power);
  double usual = ldexp(1, -power - 1), finest = ldexp(usual, -FINEST_CELL), h = usual, t = 0;
  while (fits && !o.never && t < last) {
    struct line_zero z;
    if (s->cells++ >= budget) {
      s->spent = true;
      break;
    }
    clock_set(&middle, &o.params, t + 0.5 * h);
    enum look seen = line_look(&z, &o, &middle, 0.5 * h, t == 0);
    if (seen == LOOK_OPEN && h > finest) {
      h *= 0.5;
      continue;
    }
    if (seen == LOOK_OPEN && !s->stuck) s->where = t;
    if (seen == LOOK_OPEN) s->stuck = true;
    if (seen == LOOK_ZERO) line_add(s, &z, &o);
    t += h;
    if (h < usual && fmod(t, 2 * h) == 0) h *= 2;
  }
  disk_params_clear(&o.params);
  return fits;
}

void line_clear(struct line *s) {
  free(s->zeros);
}
