/* How many full periods of phase Gamma, k, can come before a strip's t_b, and which strips hold no orbit at any time of
   phase H.

   r at the stick phase is r_0 = base - k turn, and it must be r_end.  In phase H twice the energy,
   2E = eta z_1'^2 + z_2'^2 + eta (w^2 + 2 chi w r + chi r^2)/(1 - chi), is kept, and is the sum of the squared
   amplitudes of its modes.  At its end z_1' = V, z_2' = V + q, the last term is least at w = -chi r, and r_end^2 = r^2
   + q^2/omega^2, so that 2E >= (1 + eta) V^2 + 2 V q + omega^2 r_end^2.  Where q >= 0 (r_end >= 0) this bounds omega
   r_end by sqrt(2E - (1 + eta) V^2); else |q| <= omega |r_end| bounds omega |r_end| by V + sqrt(2E - eta V^2).

   The phases of the two modes are t_b's own plus om t.  If no pair of phases at all meets the equations, then no time
   does. */
#include "turns.h"

static void clip(struct turns *k, int sign, double from, double to, double lowest, double highest) {
  /* The bounds are quotients that carry a few roundings more than they say.  NaN leaves the range as it is. */
  from = ceil(from - 1e-9 * (1 + fabs(from)));
  to = floor(to + 1e-9 * (1 + fabs(to)));
  k->from[sign] = from >= lowest ? from : lowest;
  k->to[sign] = to <= highest ? to : highest;
}

/* omega |r_end| by the energy of the strip: where q <= 0, and where q >= 0. */
static void most_radius(double *down, double *up, const struct strip *p) {
  const struct disk_params *s = p->s;
  double energy = p->most[0] * p->most[0] + p->most[1] * p->most[1], v = disk_low(s->V), omega = disk_low(s->omega),
         eta = disk_low(s->eta);
  double rest = disk_up(energy) - eta * v * v * (1 - 0x1p-40), less = rest - v * v * (1 - 0x1p-40);
  *down = disk_up(sqrt(disk_up(rest < 0 ? 0 : rest)) + disk_high(s->V)) / omega;
  *up = disk_up(sqrt(disk_up(less < 0 ? 0 : less))) / omega;
}

struct disk strip_base(const struct strip *p) {
  return disk_widen(p->base, disk_up((disk_mag(p->pb) + 0.5 * disk_mag(p->s->rho) * p->half) * p->half));
}

struct turns strip_turns(const struct strip *p, bool later) {
  struct turns k;
  double down, up, turn = p->s->turn.mid, last = later || p->later ? INFINITY : 0;
  most_radius(&down, &up, p);
  struct disk base = strip_base(p);
  double low = disk_low(base), high = disk_high(base);
  clip(&k, 0, (later ? low - down : low) / turn, (high + down) / turn, 0, last);
  clip(&k, 1, (later ? low - down : low - up) / turn, (later ? high + down : high) / turn, 0, last);
  return k;
}

struct turns turns_of(const struct turns *within, const struct disk_params *s, struct disk base, struct disk radius,
                      bool negative, bool positive) {
  struct turns k = {{1, 1}, {0, 0}};
  double low = disk_low(base), high = disk_high(base), turn = s->turn.mid;
  double inner = fmax(disk_low(radius), 0), outer = disk_high(radius);
  if (negative) clip(&k, 0, (low + inner) / turn, (high + outer) / turn, within->from[0], within->to[0]);
  if (positive) clip(&k, 1, (low - outer) / turn, (high - inner) / turn, within->from[1], within->to[1]);
  return k;
}

double turns_count(const struct turns *k) {
  double n = 0;
  for (int sign = 0; sign < 2; sign++)
    if (!(k->from[sign] > k->to[sign])) n += k->to[sign] - k->from[sign] + 1;
  return n;
}

/* --- Free phases. --- */

/* The modes' amplitudes on a strip; z_1' = V asks that the shares of the two in it, at the angles from their crests,
   add up to V: the cosine of one, the free one, tells that of the other. */
struct torus {
  const struct disk_params *s;
  const struct turns *k;
  struct disk most[2], share[2], base;
  int free;
  long left; /* pieces */
};

/* Whether no k fits the sines that belong to a piece of cosines.  Both angles turned round leave q and r^2 as they are,
   so that one sign of the first sine serves for both. */
static bool misses(const struct torus *o, const struct disk cosine[2], const struct disk sine[2]) {
  const struct disk_params *s = o->s;
  struct disk v[2], f[2];
  for (int i = 0; i < 2; i++) {
    v[i] = disk_mul(o->most[i], cosine[i]);
    f[i] = disk_mul(o->most[i], sine[i]);
  }
  struct disk q = disk_sub(disk_dot(s->y[0], v[0], s->y[1], v[1]), s->V);
  for (int sign = -1; sign <= 1; sign += 2) {
    struct disk r = disk_dot(s->force2[0], f[0], s->force2[1], disk_scale(f[1], sign));
    struct disk radius = disk_sqrt(disk_dot(r, r, disk_mul(s->soft, q), q));
    struct turns k = turns_of(o->k, s, o->base, radius, !disk_positive(q), !disk_negative(q));
    if (turns_count(&k) != 0) return false;
  }
  return true;
}

static struct disk clipped(struct disk x) {
  double low = disk_low(x), high = disk_high(x);
  return low >= -1 && high <= 1 ? x : disk_between(fmin(fmax(low, -1), 1), fmax(fmin(high, 1), -1));
}

static struct disk sine_of(struct disk cosine) {
  struct disk one = {1, 0};
  return disk_sqrt(disk_mul(disk_sub(one, cosine), disk_add(one, cosine)));
}

static bool piece_misses(struct torus *o, double low, double high, int depth) {
  if (o->left-- <= 0) return false;
  int i = o->free, j = 1 - i;
  struct disk cosine[2], sine[2];
  cosine[i] = disk_between(low, high);
  double least = disk_low(o->share[j]);
  if (!(least > 0)) return false;
  struct disk rest = disk_sub(o->s->V, disk_mul(o->share[i], cosine[i]));
  struct disk inverse = disk_widen(disk_between(1 / disk_high(o->share[j]), 1 / least), 0x1p-40 / least);
  cosine[j] = disk_mul(rest, inverse);
  if (disk_low(cosine[j]) > 1 || disk_high(cosine[j]) < -1) return true;
  for (int l = 0; l < 2; l++) {
    cosine[l] = clipped(cosine[l]);
    sine[l] = sine_of(cosine[l]);
  }
  if (misses(o, cosine, sine)) return true;
  double mid = 0.5 * (low + high);
  return depth > 0 && piece_misses(o, low, mid, depth - 1) && piece_misses(o, mid, high, depth - 1);
}

bool strip_misses(const struct strip *p, const struct turns *k) {
  const struct disk_params *s = p->s;
  enum { DEPTH = 12, PIECES = 400 };
  struct torus o = {.s = s, .k = k, .left = PIECES};
  double move = disk_up(disk_mag(s->rho) * p->half);
  for (int i = 0; i < 2; i++) {
    double enter = disk_mag(s->x[i]) * move;
    struct disk a = disk_widen(p->a[i], enter), b = disk_widen(p->b[i], enter * disk_mag(s->inverse[i]));
    o.most[i] = disk_sqrt(disk_dot(a, a, b, b));
    o.share[i] = disk_mul(s->back[i], o.most[i]);
  }
  o.base = strip_base(p);
  o.free = o.share[0].mid < o.share[1].mid ? 0 : 1;
  return piece_misses(&o, -1, 1, DEPTH);
}
