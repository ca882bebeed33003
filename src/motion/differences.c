/* Central differences in double precision of a map that is smooth but for its rounding.

   Two steps h and 2h are extrapolated, which leaves an error in h^4.  How fast the map bends is not known beforehand,
   so a ladder of steps is climbed down: the change from one extrapolated value to the next is about fifteen times the
   truncation error of the finer one and stands for it, and the noise of the map over h for the rounding.  The step with
   the least sum of both wins, and that sum is the stated accuracy.  The noise is measured: the fourth differences of
   values at nine close neighbours hold nothing else.  Rounding is relative: where a step leads to larger values than at
   x, as along a steep map (an event time over 1 - chi), the noise there is larger in proportion. */
#include <math.h>

#include "differences.h"

enum { LEVELS = 40, NEIGHBOURS = 9, ORDER = 4 };

static int shifted(double *out, const struct double_map *map, const double *x, const double *dir, double by) {
  double moved[DIFFERENCES_MOST];
  for (int i = 0; i < map->n_in; i++) moved[i] = x[i] + by * dir[i];
  int s = map->run(out, moved, map->self);
  for (int i = 0; i < map->n_out && !s; i++)
    if (!isfinite(out[i])) s = SS_UNABLE;
  return s;
}

/* The largest component of a - b, or of a. */
static double largest(const double *a, const double *b, int n) {
  double most = 0;
  for (int i = 0; i < n; i++) most = fmax(most, fabs(b ? a[i] - b[i] : a[i]));
  return most;
}

/* The standard deviation of the noisiest component's error, seen from neighbours at the distance near. */
static int measure_noise(double *noise, const struct double_map *map, const double *x, const double *dir, double near) {
  double f[NEIGHBOURS][DIFFERENCES_MOST];
  const double spread = 70; /* the variance of a fourth difference of unit noise: 1 + 16 + 36 + 16 + 1 */
  int s = SS_OK;
  *noise = 0;
  for (int k = 0; k < NEIGHBOURS && !s; k++) s = shifted(f[k], map, x, dir, (k - NEIGHBOURS / 2) * near);
  for (int i = 0; i < map->n_out && !s; i++) {
    double sum = 0;
    for (int order = 0; order < ORDER; order++)
      for (int k = 0; k + order + 1 < NEIGHBOURS; k++) f[k][i] = f[k + 1][i] - f[k][i];
    for (int k = 0; k + ORDER < NEIGHBOURS; k++) sum += f[k][i] * f[k][i];
    *noise = fmax(*noise, sqrt(sum / (spread * (NEIGHBOURS - ORDER))));
  }
  return s;
}

/* Four standard deviations, the most from neighbourhoods of different size: the rounding of a large number is a
   sawtooth, which equal distances can happen to meet on a slope of it; value is that at x. */
static int bound_noise(double *noise, const struct double_map *map, const double *x, const double *dir, double near,
                       const double *value) {
  enum { NEIGHBOURHOODS = 4 };
  const double wider = 3.317; /* no simple fraction */
  int s = SS_OK;
  *noise = fmax(map->jitter, map->floor * fmax(map->scale, largest(value, NULL, map->n_out)));
  for (int k = 0; k < NEIGHBOURHOODS && !s; k++, near *= wider) {
    double sigma;
    s = measure_noise(&sigma, map, x, dir, near);
    *noise = fmax(*noise, 4 * sigma);
  }
  return s;
}

/* The values of one step of the ladder; have counts how many steps in a row have led to it. */
struct rung {
  double plain[DIFFERENCES_MOST], extrapolated[DIFFERENCES_MOST], mean[DIFFERENCES_MOST], change;
  double size; /* the largest component of the values on both sides */
  int have;
};

/* A map whose event has jumped to another root on both sides can be as smooth as the one that is meant; but then its
   mean, extrapolated to x, is not the value at x. */
static bool continues(const struct rung *r, const struct rung *above, const double *value, double noise, double h,
                      int n) {
  double gap[DIFFERENCES_MOST];
  for (int i = 0; i < n; i++) gap[i] = r->mean[i] + (r->mean[i] - above->mean[i]) / 3 - value[i];
  return largest(gap, NULL, n) <= 0.05 * h * largest(r->plain, NULL, n) + 4 * noise;
}

static int climb(struct rung *r, const struct rung *above, const struct double_map *map, const double *x,
                 const double *dir, double h) {
  double up[DIFFERENCES_MOST], down[DIFFERENCES_MOST];
  *r = (struct rung){.have = 0};
  int s = shifted(up, map, x, dir, h);
  if (!s) s = shifted(down, map, x, dir, -h);
  if (s) return s;
  r->have = above->have + 1;
  r->size = fmax(largest(up, NULL, map->n_out), largest(down, NULL, map->n_out));
  for (int i = 0; i < map->n_out; i++) {
    r->plain[i] = (up[i] - down[i]) / (2 * h); /* what rounding does to x + h dir is noise of the map, too */
    r->mean[i] = (up[i] + down[i]) / 2;
    r->extrapolated[i] = r->plain[i] + (r->plain[i] - above->plain[i]) / 3;
  }
  r->change = largest(r->extrapolated, above->extrapolated, map->n_out);
  return s;
}

/* The step that has won, and what it stands for. */
struct chosen {
  double h, err, truncation, noise; /* truncation: of the plain difference */
};

/* Far from x a map can be straight with another slope, for many steps of the ladder: of a phase whose fast mode is
   small against the state, say.  What is the derivative at x holds for all finer steps too, down to those that rounding
   blurs. */
static bool finer_steps_agree(const double *out, const struct chosen *c, const struct double_map *map, const double *x,
                              const double *dir) {
  const double finer = 1.0 / 8, blurred = 1.0 / 4;
  double most = largest(out, NULL, map->n_out);
  for (double h = c->h * finer; 3 * c->noise / h <= blurred * most; h *= finer) {
    double up[DIFFERENCES_MOST], down[DIFFERENCES_MOST], off = 0;
    if (shifted(up, map, x, dir, h) || shifted(down, map, x, dir, -h)) return false;
    for (int i = 0; i < map->n_out; i++) off = fmax(off, fabs((up[i] - down[i]) / (2 * h) - out[i]));
    if (off > c->err + c->truncation + 3 * c->noise / h) return false;
  }
  return true;
}

int differences_along(double *out, double *err, const struct double_map *map, const double *x, const double *dir) {
  const double odd = 1.2345678; /* a power of two would leave the last digits as they are, and their rounding unseen */
  double unit = ldexp(odd, ilogb(map->scale)), noise = 0, value[DIFFERENCES_MOST] = {0};
  int s = shifted(value, map, x, dir, 0), last = SS_UNABLE;
  if (!s) s = bound_noise(&noise, map, x, dir, ldexp(unit, -34), value);
  struct rung above = {.have = 0}, here;
  double size = fmax(map->scale, largest(value, NULL, map->n_out));
  struct chosen best = {.err = INFINITY};
  for (int k = 3; k < LEVELS && !s; k++, above = here) {
    double h = ldexp(unit, -k), rounding = 3 * noise / h; /* (4/h + 1/2h)/3 meet; twice, as noise is an estimate */
    if (rounding >= best.err) break;
    int status = climb(&here, &above, map, x, dir, h);
    if (status) last = status;
    if (here.have < 4) continue; /* three plain steps make a change, four a second one to hold it against */
    double grown = fmax(here.size / size, 1);
    if (!continues(&here, &above, value, noise * grown, h, map->n_out)) continue;
    double total = fmax(here.change, above.change / 16) + rounding * grown;
    if (total >= best.err) continue;
    for (int i = 0; i < map->n_out; i++) out[i] = here.extrapolated[i];
    best = (struct chosen){h, total, largest(here.plain, here.extrapolated, map->n_out), noise * grown};
  }
  *err = best.err;
  if (s) return s;
  if (!isfinite(best.err)) return last;
  return finer_steps_agree(out, &best, map, x, dir) ? SS_OK : SS_UNABLE;
}

int differences_along_all(double *out, double *err, const struct double_map *map, const double *x,
                          const double (*dir)[N_STATE], int n_dir) {
  int s = SS_OK;
  for (int k = 0; k < n_dir && !s; k++) {
    double worst;
    s = differences_along(out + map->n_out * k, &worst, map, x, dir[k]);
    if (err) err[k] = worst;
  }
  return s;
}

int differences_jacobian(double j[4], double *err, const struct double_map *map, const double *x) {
  static const double axis[2][N_STATE] = {{1, 0}, {0, 1}};
  double column[4], worst[2];
  int s = differences_along_all(column, worst, map, x, axis, 2);
  for (int i = 0; i < 4 && !s; i++) j[i] = column[2 * (i % 2) + i / 2];
  if (!s && err) *err = fmax(worst[0], worst[1]);
  return s;
}
