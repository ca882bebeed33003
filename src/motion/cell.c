/* What can be proved of periodic orbits whose (t_b, t_c) lies in a cell.

   Such an orbit is a common zero of p = z_1' - V and H_k = r^2 + q^2/omega^2 - (base - k turn)^2: with q = z_2' - V the
   first two terms are the square of r at the end of phase C, and base - k turn is r at the stick phase when k full
   periods of phase Gamma come before the angle of t_b.  Every enclosure over the cell is a Taylor polynomial of first
   degree about its middle, the second derivatives being bounded.  Two facts keep cells large: H is r_end^2 - r_0^2 and
   has no root in it, so nothing is singular where the radius vanishes; and H_t = -2 r p, so H stands still in time
   where p = 0. */
#include "cell.h"
#include "base/arena.h"
#include "num/pi.h"
#include "strip.h"

void cell_at(struct cell *c, const struct strip *p, const struct clock *t) {
  const struct disk_params *s = p->s;
  struct disk_motion at = disk_motion_at(s, p->a, p->b, t), by_angle = disk_motion_at(s, p->da, p->db, t);
  c->strip = p;
  c->first = c->later = false;
  c->p = disk_sub(at.v[0], s->V);
  c->q = disk_sub(at.v[1], s->V);
  c->w = at.w;
  c->r = at.r;
  c->pf = by_angle.v[0];
  c->qf = by_angle.v[1];
  c->rf = by_angle.r;
}

enum { MOST_TURNS = 4 }; /* with more k than that a cell is left to be divided */

/* Over the box of half widths d and e around the cell's middle: half widths of p, q, r, the largest absolute values,
   and the squared radius G = r^2 + q^2/omega^2 with its derivatives. */
struct range {
  double d, e, p, q, r;
  double most_p, most_q, most_r, most_w, most_pf, most_qf, most_rf;
  struct disk g, gf, gt;
  struct derivative_bounds bent; /* of G: ff, ft and tt */
  double g_width;
};

static double width_of(struct disk x, struct disk xf, double xt, const struct derivative_bounds *b,
                       const struct range *g) {
  double d = g->d, e = g->e;
  return disk_up(x.rad + disk_mag(xf) * d + xt * e + 0.5 * (b->ff * d * d + 2 * b->ft * d * e + b->tt * e * e));
}

static void range_p(struct range *g, const struct cell *c) {
  const struct derivative_bounds *b = &c->strip->p;
  g->p = width_of(c->p, c->pf, disk_mag(c->w), b, g);
  g->most_p = disk_up(fabs(c->p.mid) + g->p);
  g->most_w = disk_up(disk_mag(c->w) + b->ft * g->d + b->tt * g->e); /* w = -p_t */
}

static void range_radius(struct range *g, const struct cell *c) {
  const struct strip *p = c->strip;
  const struct disk_params *s = p->s;
  double d = g->d, e = g->e, soft = disk_mag(s->soft);
  g->q = width_of(c->q, c->qf, disk_mag(s->stiff) * disk_mag(c->r), &p->q, g);
  g->r = width_of(c->r, c->rf, disk_mag(c->q) + disk_mag(c->p), &p->r, g);
  g->most_q = disk_up(fabs(c->q.mid) + g->q);
  g->most_r = disk_up(fabs(c->r.mid) + g->r);
  g->most_pf = disk_up(disk_mag(c->pf) + p->p.ff * d + p->p.ft * e);
  g->most_qf = disk_up(disk_mag(c->qf) + p->q.ff * d + p->q.ft * e);
  g->most_rf = disk_up(disk_mag(c->rf) + p->r.ff * d + p->r.ft * e);

  struct disk q = disk_mul(s->soft, c->q);
  g->g = disk_dot(c->r, c->r, q, c->q);
  g->gf = disk_scale(disk_dot(c->r, c->rf, q, c->qf), 2);
  g->gt = disk_scale(disk_mul(c->r, c->p), -2);
  g->bent.tt = disk_up(2 * ((g->most_q + g->most_p) * g->most_p + g->most_r * g->most_w));
  g->bent.ft = disk_up(2 * (g->most_rf * g->most_p + g->most_r * g->most_pf));
  g->bent.ff = disk_up(
      2 * (g->most_rf * g->most_rf + g->most_r * p->r.ff + soft * (g->most_qf * g->most_qf + g->most_q * p->q.ff)));
  g->g_width = width_of(g->g, g->gf, disk_mag(g->gt), &g->bent, g);
}

/* H for one k: base' = pb, base'' = -w at t_b, which rho bounds. */
struct goal {
  struct disk h, hf;
  struct derivative_bounds bent;
  double width;
};

static struct goal goal_of(const struct range *g, const struct strip *p, double k) {
  const struct disk_params *s = p->s;
  struct goal o = {.bent = g->bent};
  double rho = disk_mag(s->rho), pb = disk_up(disk_mag(p->pb) + rho * g->d);
  struct disk r0 = disk_sub(p->base, disk_mul((struct disk){k, 0}, s->turn));
  double most = disk_up(disk_mag(r0) + pb * g->d);
  o.h = disk_sub(g->g, disk_mul(r0, r0));
  o.hf = disk_sub(g->gf, disk_scale(disk_mul(r0, p->pb), 2));
  o.bent.ff = disk_up(g->bent.ff + 2 * (pb * pb + most * rho));
  o.width = width_of(o.h, o.hf, disk_mag(g->gt), &o.bent, g);
  return o;
}

/* Krawczyk's operator on the box of g: its image is m - shift +- size. */
struct image {
  double shift[2], size[2];
};

static bool krawczyk(struct image *im, const struct cell *c, const struct range *g, const struct goal *o) {
  const struct derivative_bounds *b = &c->strip->p, *h = &o->bent;
  struct disk pt = disk_scale(c->w, -1), f[2] = {c->p, o->h};
  struct disk j[2][2] = {
      {disk_widen(c->pf, b->ff * g->d + b->ft * g->e), disk_widen(pt, b->ft * g->d + b->tt * g->e)},
      {disk_widen(o->hf, h->ff * g->d + h->ft * g->e), disk_widen(g->gt, h->ft * g->d + h->tt * g->e)}};
  double det = c->pf.mid * g->gt.mid - pt.mid * o->hf.mid, half[2] = {g->d, g->e};
  if (!(fabs(det) > 0)) return false;
  struct disk y[2][2] = {{{g->gt.mid / det, 0}, {-pt.mid / det, 0}}, {{-o->hf.mid / det, 0}, {c->pf.mid / det, 0}}};
  for (int i = 0; i < 2; i++) {
    struct disk shift = disk_dot(y[i][0], f[0], y[i][1], f[1]);
    double size = shift.rad;
    for (int l = 0; l < 2; l++) {
      struct disk rest = disk_dot(y[i][0], j[0][l], y[i][1], j[1][l]);
      if (i == l) rest = disk_sub(rest, (struct disk){1, 0});
      size += disk_mag(rest) * half[l];
    }
    im->shift[i] = shift.mid;
    im->size[i] = disk_up(size);
  }
  return true;
}

/* One k, in the cell of half widths g->d, g->e; the operator works on the box twice as large, so that a zero on the
   edge of two cells is seen from both. */
static enum look look_at(struct common *zero, const struct cell *c, const struct range *g, const struct range *twice,
                         double k) {
  struct goal o = goal_of(g, c->strip, k);
  if (fabs(o.h.mid) > o.width) return LOOK_CLEAR;
  struct image im;
  struct goal wide = goal_of(twice, c->strip, k);
  if (!krawczyk(&im, c, twice, &wide)) return LOOK_OPEN;
  const double half[2] = {g->d, g->e}, room[2] = {twice->d, twice->e};
  bool inside = true;
  for (int i = 0; i < 2; i++) {
    if (fabs(im.shift[i]) - im.size[i] > half[i] * (1 + 0x1p-40)) return LOOK_CLEAR;
    inside = inside && disk_up(fabs(im.shift[i]) + im.size[i]) < room[i] * (1 - 0x1p-20);
  }
  if (!inside) return LOOK_OPEN;
  *zero = (struct common){k, {-im.shift[0], -im.shift[1]}, {im.size[0], im.size[1]}, {room[0], room[1]}};
  return LOOK_ZERO;
}

static struct range range_at(double d, double e, const struct cell *c) {
  struct range g = {.d = d, .e = e};
  range_p(&g, c);
  range_radius(&g, c);
  return g;
}

/* Over the cell of g, for each k that can be. */
static enum look look_at_each(struct common *zero, const struct cell *c, const struct range *g,
                              const struct turns *can) {
  double count = turns_count(can);
  if (count == 0) return LOOK_CLEAR;
  zero->k = -1;
  if (!(count <= MOST_TURNS)) return LOOK_OPEN;

  struct range twice = range_at(2 * g->d, 2 * g->e, c);
  int zeros = 0, open = 0;
  double left = -1;
  for (int sign = 0; sign < 2; sign++)
    for (double i = can->from[sign]; i <= can->to[sign]; i++) {
      if (sign == 1 && i >= can->from[0] && i <= can->to[0]) continue; /* seen */
      struct common one;
      enum look here = look_at(&one, c, g, &twice, i);
      if (here == LOOK_ZERO && zeros++ == 0) *zero = one;
      if (here == LOOK_OPEN && open++ == 0) left = i;
    }
  if (zeros + open == 0) return LOOK_CLEAR;
  if (zeros == 1 && open == 0) return LOOK_ZERO;
  zero->k = zeros == 0 && open == 1 ? left : -1;
  return LOOK_OPEN;
}

/* dir p is not above zero at t_b, and falls where dir w > 0 */
static bool falls_from_start(const struct cell *c, const struct range *g, double dir) {
  const struct derivative_bounds *b = &c->strip->p;
  return c->first && dir * c->w.mid - disk_up(c->w.rad + b->ft * g->d + b->tt * g->e) > 0;
}

enum look cell_look(struct common *zero, const struct cell *c, const struct turns *k, double dir) {
  struct range g = {.d = c->strip->half, .e = c->early};
  range_p(&g, c);
  bool before = dir * c->p.mid + g.p < 0, behind = c->later && dir * c->p.mid - g.p > 0;
  if (before || behind || falls_from_start(c, &g, dir)) return LOOK_CLEAR;

  range_radius(&g, c);
  /* q is zero at t_b, and falls where r > 0 */
  bool falls = c->first && c->r.mid - g.r > 0;
  bool negative = c->later || c->q.mid - g.q <= 0, positive = c->later || (c->q.mid + g.q >= 0 && !falls);
  struct disk radius = disk_sqrt((struct disk){g.g.mid, g.g_width}); /* over the whole cell */
  struct turns can = turns_of(k, c->strip->s, strip_base(c->strip), radius, negative, positive);
  return look_at_each(zero, c, &g, &can);
}

struct dyn_place common_place(const struct common *z, const struct disk_params *s) {
  struct strip p;
  strip_make(&p, s, z->at[0] - z->near[0], z->at[0] + z->near[0], 0);
  return (struct dyn_place){z->at[0] + 2 * PI * z->k, z->at[1], p.base.mid - z->k * s->turn.mid > 0};
}

struct known known_of(const struct dyn_orbit *o, double k) {
  return (struct known){k, {disk_less_turns(o->t[PHASE_GAMMA], k), disk_less_turns(o->t[PHASE_H], 0)}, false};
}

bool known_is(const struct known *o, const struct common *z) {
  bool same = o->k == z->k;
  for (int l = 0; l < 2; l++)
    same = same && disk_up(fabs(o->at[l].mid - z->at[l]) + o->at[l].rad) + 0x1p-50 * fabs(z->at[l]) < z->room[l];
  return same;
}

static bool common_is_same(const struct common *a, const struct common *b) {
  bool same = a->k == b->k;
  for (int l = 0; l < 2; l++) {
    double apart = fabs(a->at[l] - b->at[l]) + 0x1p-40 * (1 + fabs(b->at[l]));
    same = same && (apart + b->near[l] < a->room[l] || apart + a->near[l] < b->room[l]);
  }
  return same;
}

void commons_add(struct commons *list, struct common z, const struct strip *p, double t) {
  z.at[0] += p->angle;
  z.at[1] += t;
  for (size_t i = 0; i < list->n; i++)
    if (common_is_same(&list->at[i], &z)) return;
  *SS_PUSH(list->at, list->n, list->cap) = z;
}

bool cell_waiting(double *low, double *high, const struct cell *c, double dir) {
  const struct strip *p = c->strip;
  /* dir p >= level + slope x at the distance x from the strip's midpoint */
  double noise = c->p.rad + (c->pf.rad + 0x1p-48 * fabs(c->pf.mid)) * p->half;
  double level = dir * c->p.mid - disk_up(noise + 0.5 * p->p.ff * p->half * p->half), slope = dir * c->pf.mid,
         slack = 1e-9 * p->half + 0x1p-50 * p->angle;
  bool left = level - slope * p->half > 0, right = level + slope * p->half > 0;
  *low = -p->half;
  *high = p->half;
  if (left && right) return false;
  if (left) *low = fmax(-p->half, -level / slope - slack);
  if (right) *high = fmin(p->half, -level / slope + slack);
  return true;
}

bool cell_wide_in_angle(const struct cell *c) {
  const struct strip *p = c->strip;
  double along = hypot(c->pf.mid, c->rf.mid) + p->p.ff * p->half, across = fabs(c->w.mid) + p->p.tt * c->early;
  return p->half * along > c->early * across;
}

/* r and q twice differentiated by the angle: minus the motion of what turns with t_b. */
static void cell_bends(struct disk *rff, struct disk *qff, const struct strip *p, const struct clock *t) {
  const struct disk_params *s = p->s;
  struct disk a[2], b[2];
  for (int i = 0; i < 2; i++) {
    a[i] = disk_mul(s->x[i], p->u);
    b[i] = disk_mul(s->inverse[i], disk_mul(s->x[i], p->w));
  }
  struct disk_motion turning = disk_motion_at(s, a, b, t);
  *qff = disk_scale(turning.v[1], -1);
  *rff = disk_scale(turning.r, -1);
}

/* Between two zeros in the box the curve p = 0 is a graph t(angle), since w is not zero, and does not leave a box twice
   as tall: its slope p_f/w is bounded in that one.  Along it H has the derivative H_f, for H_t = -2 r p = 0, and the
   second derivative

     H_ff - 2 r p_f^2/w = 2 (r_f^2 + r r_ff + (q_f^2 + q q_ff)/omega^2 - pb^2 + r_0 w_b - r p_f^2/w).

   Where that is not zero, H has at most two zeros. */
bool cell_folds_once(const struct cell *cell, const struct clock *t, double k, const double half[2]) {
  struct strip wide = *cell->strip;
  struct cell taller = *cell;
  const struct cell *c = &taller;
  const struct strip *p = taller.strip = &wide;
  const struct disk_params *s = p->s;
  strip_reach(&wide, half[0]);
  double d = half[0], e = 2 * half[1], rho = disk_mag(s->rho);
  struct range g = range_at(d, e, c);
  struct disk w = disk_widen(c->w, p->p.ft * d + p->p.tt * e), rff, qff;
  double least = (fabs(w.mid) - w.rad) * (1 - 0x1p-20);
  if (!(least > 0) || !(disk_up(half[1] + 2 * d * g.most_pf / least) * (1 + 0x1p-20) < e)) return false;
  cell_bends(&rff, &qff, p, t);
  rff = disk_widen(rff, p->r.fff * d + p->r.fft * e);
  qff = disk_widen(qff, p->q.fff * d + p->q.fft * e);
  struct disk r = {c->r.mid, g.r}, q = disk_mul(s->soft, (struct disk){c->q.mid, g.q});
  struct disk rf = disk_widen(c->rf, p->r.ff * d + p->r.ft * e), qf = disk_widen(c->qf, p->q.ff * d + p->q.ft * e);
  struct disk pf = disk_widen(c->pf, p->p.ff * d + p->p.ft * e), pb = disk_widen(p->pb, rho * d);
  struct disk r0 = disk_sub(p->base, disk_mul((struct disk){k, 0}, s->turn)), wb = disk_widen(p->w, rho * d);
  r0 = disk_widen(r0, disk_mag(pb) * d);
  double sign = w.mid > 0 ? 1 : -1; /* times |w|, which is positive */
  struct disk size = disk_scale(w, sign);
  struct disk sum = disk_dot(rf, rf, r, rff);
  sum = disk_add(sum, disk_add(disk_mul(disk_mul(s->soft, qf), qf), disk_mul(q, qff)));
  sum = disk_add(sum, disk_cross(r0, wb, pb, pb));
  return disk_nonzero(disk_sub(disk_mul(size, sum), disk_scale(disk_mul(r, disk_mul(pf, pf)), sign)));
}
