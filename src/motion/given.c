/* Orbits from any two of e1, e2, t_a, t_b, t_c, t_d.

   With z_1' = V and z_2' = V where they must be, phase C turns (r, q/omega) by omega t_d into (r_0, 0), and an orbit is

     p_c = 0,   r_c = r_0 cos(omega t_d),   q_c/omega = r_0 sin(omega t_d),
     w_c + a (t_a + t_d) - chi (r_0 - r_c) = e1,

   where r_0 = e2/chi - rise(t_b) and the state at t_c are linear in e1 and e2.  At given t_b, t_c the first equation
   is a line of (e1, e2), and the squares of the next two add up to a quadratic along it: two sheets over the plane of
   (t_b, t_c), on which all six quantities are known in double precision.  Cells of a grid in which the given values
   can occur start Newton's iteration on the four equations themselves; what converges, and starts no event too early,
   is refined and enclosed in balls. */
#include "stickslip/given.h"

#include <math.h>
#include <stdlib.h>

#include "motion_impl.h"
#include "num/solve.h"
#include "stickslip/arena.h"

const char *const dyn_quantity_id[N_QUANTITIES] = {"e1", "e2", "t_a", "t_b", "t_c", "t_d"};
const struct dyn_limits dyn_given_limits = {200, 100000};

enum {
  RAISES = 4, /* of the precision */
  FINE = 300, /* cells to a period on a line and in the plane */
  COARSE = 50,
  MAX_DEPTH = 8,       /* of halving a cell */
  SEED_BITS = 18,      /* Newton's steps in double precision become as small as this; then one more is taken */
  STEP_WORK = 32,      /* what such a step costs, in points of the sheets */
  MAX_WORK = 15000000, /* about five seconds at worst */
};

/* A problem: the model, and which of the six quantities are known. */
struct quest {
  struct word_data data;
  double target[2];
  struct return_map_double k; /* of the given e1; its e2 is not used */
  struct dyn_limits lim;
};

static bool is_given(const struct quest *q, enum dyn_quantity x) {
  return q->data.which[0] == x || q->data.which[1] == x;
}

static double target(const struct quest *q, enum dyn_quantity x) {
  return q->target[q->data.which[0] == x ? 0 : 1];
}

/* --- The two sheets over (t_b, t_c), in double precision. --- */

/* What phase Gamma does in the time t. */
struct slide {
  double t, s, c, versine, lag; /* 1 - cos t, t - sin t */
};

static struct slide slide_at(double t) {
  double half = sin(0.5 * t);
  return (struct slide){t, sin(t), cos(t), 2 * half * half, x_minus_sin(t)};
}

/* cos(sqrt(K) t), sin(sqrt(K) t)/sqrt(K) and sqrt(K) sin(sqrt(K) t): velocities v and forces f = (w, chi eta r) become
   c v - s f and c f + n v. */
struct slip {
  double t, c[4], s[4], n[4];
};

static void slip_function(double out[4], const struct return_map_double *k, double slow, double fast) {
  double lead = k->x * k->y * (slow - fast);
  out[0] = k->x * k->x * slow + k->y * k->y * fast;
  out[1] = lead / k->root_eta;
  out[2] = lead * k->root_eta;
  out[3] = k->y * k->y * slow + k->x * k->x * fast;
}

static struct slip slip_at(const struct return_map_double *k, double t) {
  struct slip h = {.t = t};
  double s[2] = {sin(k->om[0] * t), sin(k->om[1] * t)};
  slip_function(h.c, k, cos(k->om[0] * t), cos(k->om[1] * t));
  slip_function(h.s, k, s[0] / k->om[0], s[1] / k->om[1]);
  slip_function(h.n, k, s[0] * k->om[0], s[1] * k->om[1]);
  return h;
}

/* A quantity that is linear in e1 and e2: x[0] e1 + x[1] e2 + x[2]. */
struct linear {
  double x[3];
};

static struct linear velocity(const struct return_map_double *k, const struct slide *b, const double c[2],
                              const double s[2]) {
  double v1 = k->chi * k->V + k->a * b->c;
  return (struct linear){{-c[0] * b->s - s[0] * b->c, -s[1] * k->eta, c[0] * v1 + c[1] * k->V - s[0] * k->a * b->s}};
}

static struct linear force(const struct return_map_double *k, const struct slide *b, const double c[2],
                           const double n[2]) {
  double v1 = k->chi * k->V + k->a * b->c;
  return (struct linear){{c[0] * b->c - n[0] * b->s, c[1] * k->eta, c[0] * k->a * b->s + n[0] * v1 + n[1] * k->V}};
}

struct sheet {
  bool real;
  double reality; /* the quadratic's relative discriminant */
  double x[N_QUANTITIES];
};

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

static void sheets_at(struct sheet out[2], const struct return_map_double *k, const struct slide *b,
                      const struct slip *h) {
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

/* --- The search in double precision. --- */

struct seed {
  double x[N_QUANTITIES];
};
struct scan {
  const struct quest *q;
  struct calc c;
  struct ball_params m;
  struct seed *seeds;
  size_t n, cap;
  bool plane;         /* t_b and t_c are both unknown */
  double cell[2];     /* sizes in t_b and t_c */
  struct slip *watch; /* times at which m1 is looked at */
  size_t n_watch;
  long evaluations;
  long work; /* points of the sheets, and what costs about as much; Newton's steps count STEP_WORK each */
};

/* No event comes clearly before its time, and every quantity is in its domain. */
static bool plausible(struct scan *scan, const double x[N_QUANTITIES]) {
  const struct quest *q = scan->q;
  struct return_map_double k;
  struct pass s;
  double tb = x[QUANTITY_TB], tc = x[QUANTITY_TC], td = x[QUANTITY_TD], turn = fmod(tb, 2 * PI), slack = 1e-6;
  const double p[N_PARAMS] = {q->k.chi, q->k.eta, q->k.V, x[QUANTITY_E1], x[QUANTITY_E2]};
  if (return_map_double_init(&k, p) || !(tb > 0 && tc > 0 && td > 0 && td * k.omc < PI)) return false;
  if ((tb > q->lim.t_max && !is_given(q, QUANTITY_TB)) || (tc > q->lim.t_max && !is_given(q, QUANTITY_TC)))
    return false;
  return_map_double_records(&k);
  if (turn > k.fall + slack || (tb > k.fall + slack && turn < k.rise - slack)) return false;
  const struct dyn_limits lim = {tc + 1, q->lim.max_steps};
  return_map_double_pass(&s, &k, tb, &lim);
  scan->work += s.steps;
  return s.status || s.tc > tc - slack * (1 + tc);
}

static bool same_seed(const double x[N_QUANTITIES], const double y[N_QUANTITIES]) {
  double limits = fabs(x[QUANTITY_E1]) + fabs(x[QUANTITY_E2]);
  for (int i = 0; i < N_QUANTITIES; i++)
    if (!(fabs(x[i] - y[i]) <= 1e-10 * (i < QUANTITY_TA ? limits : fabs(x[i]) + 1))) return false;
  return true;
}

static void add_seed(struct scan *s, const double x[N_QUANTITIES]) {
  for (size_t i = 0; i < s->n; i++)
    if (same_seed(s->seeds[i].x, x)) return;
  if (!plausible(s, x)) return;
  s->seeds = ss_grow(s->seeds, s->n, &s->cap, sizeof *s->seeds);
  for (int i = 0; i < N_QUANTITIES; i++) s->seeds[s->n].x[i] = x[i];
  s->n++;
}

/* Newton's iteration from a point of a sheet. */
struct descent {
  struct word_system w;
  struct scan *s;
  const struct sheet *from;
  bool small, last;
};

static int descent_values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct descent *d = self;
  d->s->work += STEP_WORK;
  return word_values(f, j, x, &d->w);
}

/* It is given up when it leads far away, and one more step is taken once they are small. */
static enum newton_next descent_judge(const struct num_vec *x, const struct num_vec *step, void *self) {
  struct descent *d = self;
  const double *at = (const double *)x->data, *by = (const double *)step->data;
  d->small = word_step_is_small(x, step, &d->w, SEED_BITS);
  for (int k = 0; k < WORD_FREE; k++) {
    int time = d->w.unknown[k] - QUANTITY_TB;
    if (time < 0 || time > 1 || fabs(at[k] - by[k] - d->from->x[QUANTITY_TB + time]) <= 16 * d->s->cell[time]) continue;
    d->small = false;
    return NEWTON_LOST;
  }
  if (d->small && d->last) return NEWTON_LAST;
  d->last = d->last || d->small;
  return NEWTON_ON;
}

static void descend(struct scan *s, const struct sheet *from) {
  double x[N_QUANTITIES], free[WORD_FREE];
  const int *unknown = s->q->data.unknown;
  struct descent d = {.w = {&s->c, &s->m, unknown, calc_mark(&s->c), {NULL}}, .s = s, .from = from};
  for (int i = 0; i < N_QUANTITIES; i++) {
    x[i] = is_given(s->q, (enum dyn_quantity)i) ? target(s->q, (enum dyn_quantity)i) : from->x[i];
    d.w.known[i] = &x[i];
  }
  for (int k = 0; k < WORD_FREE; k++) free[k] = x[unknown[k]];
  struct num_vec v = {num_ctx_double(), WORD_FREE, (char *)free};
  struct solve_system system = {WORD_FREE, descent_values, &d};
  newton_run(&v, &system, v.ctx, 16, descent_judge);
  calc_release(&s->c, d.w.mark);
  for (int k = 0; k < WORD_FREE; k++) x[unknown[k]] = free[k];
  if (d.small) add_seed(s, x);
}

struct range {
  double low, high;
};

static struct range range_of(const struct sheet *const *point, int n, enum dyn_quantity x) {
  struct range r = {INFINITY, -INFINITY};
  for (int i = 0; i < n; i++) {
    r.low = fmin(r.low, point[i]->x[x]);
    r.high = fmax(r.high, point[i]->x[x]);
  }
  return r;
}

/* Whether the range of a quantity over some points, wider by its width times slack on both sides, meets low..high. */
static bool meets(const struct range *r, double slack, double low, double high) {
  double margin = slack * (r->high - r->low) + 1e-9 * (fabs(r->low) + fabs(r->high));
  return r->low - margin <= high && r->high + margin >= low;
}

/* Whether m1 has clearly overtaken the belt at a watched time before t_c: then no first event is near.  Clearly: by half
   of what it has fallen behind so far. */
static bool overtaken(struct scan *s, const struct sheet *p) {
  const double u[3] = {p->x[QUANTITY_E1], p->x[QUANTITY_E2], 1};
  struct slide b = slide_at(p->x[QUANTITY_TB]);
  double behind = 0;
  for (size_t j = 0; j < s->n_watch && s->watch[j].t < p->x[QUANTITY_TC]; j++) {
    struct linear v = velocity(&s->q->k, &b, s->watch[j].c, s->watch[j].s);
    double lead = along(&v, u) - s->q->k.V;
    behind = fmax(behind, -lead);
    if (j % 8 == 0) s->work++;
    if (lead > 0.5 * behind) return true;
  }
  return false;
}

/* Starts from each point, if the given values can occur between the points at all. */
static void try_points(struct scan *s, const struct sheet *const *point, int n, double slack) {
  const struct quest *q = s->q;
  struct range r;
  for (int i = 0; i < 2; i++) {
    r = range_of(point, n, q->data.which[i]);
    if (!meets(&r, slack, q->target[i], q->target[i])) return;
  }
  for (enum dyn_quantity x = QUANTITY_E1; x <= QUANTITY_E2; x++) {
    r = range_of(point, n, x);
    if (!meets(&r, slack, 0, INFINITY)) return;
  }
  r = range_of(point, n, QUANTITY_TD);
  if (!meets(&r, slack, 0, PI / q->k.omc)) return;
  for (int k = 0; k < n; k++)
    if (!overtaken(s, point[k])) descend(s, point[k]);
}

/* A cell of the plane with both sheets at its corners; one given time makes it a stretch, two a point. */
struct cell {
  struct slide b[2];
  struct slip h[2];
  struct sheet at[2][2][2]; /* t_b, t_c, sheet */
  int nb, nc;               /* times along each axis: 2, or 1 when it is given */
};

/* Pointers to the real points of one sheet (0, 1) or of both (2). */
static int real_points(const struct sheet **point, const struct cell *cell, int sheet) {
  int n = 0;
  for (int i = 0; i < cell->nb; i++)
    for (int j = 0; j < cell->nc; j++)
      for (int k = 0; k < 2; k++)
        if ((sheet == 2 || sheet == k) && cell->at[i][j][k].real) point[n++] = &cell->at[i][j][k];
  return n;
}

/* Whether the quadratic has its roots all over the cell, e1 and e2 change by a small part of their size (they can pass
   through infinity), and phase C turns by much the same angle. */
static bool smooth(const struct quest *q, const struct cell *cell) {
  const struct sheet *point[8];
  for (int sheet = 0; sheet < 2; sheet++) {
    int n = real_points(point, cell, sheet);
    if (n < cell->nb * cell->nc) return false;
    struct range e1 = range_of(point, n, QUANTITY_E1), e2 = range_of(point, n, QUANTITY_E2);
    double size = q->k.V + fmax(fabs(e1.low), fabs(e1.high)) + fmax(fabs(e2.low), fabs(e2.high));
    struct range td = range_of(point, n, QUANTITY_TD);
    if (e1.high - e1.low + e2.high - e2.low > 0.3 * size || (td.high - td.low) * q->k.omc > 0.3) return false;
  }
  return true;
}

/* Whether the quadratic can have roots inside a cell that has none at its corners: its discriminant, which is smooth,
   comes close to zero.  What counts as close is halved with the cell. */
static bool almost_real(const struct cell *cell, int depth) {
  double most = -1;
  for (int i = 0; i < cell->nb; i++)
    for (int j = 0; j < cell->nc; j++) most = fmax(most, cell->at[i][j][0].reality);
  return most > -ldexp(1, -depth);
}

static void try_cell(struct scan *s, const struct cell *cell, int depth);

static void split_cell(struct scan *s, const struct cell *cell, int depth) {
  struct slide b[3] = {cell->b[0], cell->b[1]};
  struct slip h[3] = {cell->h[0], cell->h[1]};
  struct sheet at[3][3][2];
  int nb = cell->nb == 1 ? 1 : 3, nc = cell->nc == 1 ? 1 : 3;
  if (nb == 3) {
    b[2] = b[1];
    b[1] = slide_at(0.5 * (b[0].t + b[2].t));
  }
  if (nc == 3) {
    h[2] = h[1];
    h[1] = slip_at(&s->q->k, 0.5 * (h[0].t + h[2].t));
  }
  for (int i = 0; i < nb; i++)
    for (int j = 0; j < nc; j++) sheets_at(at[i][j], &s->q->k, &b[i], &h[j]);
  s->evaluations += nb * nc;
  s->work += nb * nc;
  for (int i = 0; i < (nb + 1) / 2; i++)
    for (int j = 0; j < (nc + 1) / 2; j++) {
      struct cell part = {.nb = cell->nb, .nc = cell->nc};
      for (int k = 0; k < cell->nb; k++) part.b[k] = b[i + k];
      for (int k = 0; k < cell->nc; k++) part.h[k] = h[j + k];
      for (int k = 0; k < cell->nb; k++)
        for (int l = 0; l < cell->nc; l++)
          for (int sheet = 0; sheet < 2; sheet++) part.at[k][l][sheet] = at[i + k][j + l][sheet];
      try_cell(s, &part, depth + 1);
    }
}

/* On a line, a cell that is not smooth is halved first.  Where a sheet ends in a cell both are looked at as one. */
static void try_cell(struct scan *s, const struct cell *cell, int depth) {
  const struct sheet *point[8];
  int n = real_points(point, cell, 2), corners = cell->nb * cell->nc;
  if (n == 0 && !almost_real(cell, depth)) return;
  if (!s->plane && corners > 1 && depth < MAX_DEPTH && !smooth(s->q, cell)) {
    split_cell(s, cell, depth);
  } else if (n < 2 * corners) {
    if (n > 0) try_points(s, point, n, 1.5);
  } else {
    for (int sheet = 0; sheet < 2; sheet++) try_points(s, point, real_points(point, cell, sheet), 0.5);
  }
}

/* Sample times up to end: closely spaced near zero, then by steps of the given size. */
static size_t make_axis(double **t, double end, double step) {
  size_t n = 0, cap = 0;
  *t = NULL;
  for (double x = fmin(1e-4, end); x < end; x = x < 4 * step ? 1.25 * x : x + step) {
    *t = ss_grow(*t, n, &cap, sizeof **t);
    (*t)[n++] = x;
  }
  *t = ss_grow(*t, n, &cap, sizeof **t);
  (*t)[n++] = end;
  return n;
}

static size_t axis_of(double **t, struct scan *s, enum dyn_quantity x, double end, double period, int parts) {
  double step = period / parts;
  s->cell[x - QUANTITY_TB] = step;
  if (!is_given(s->q, x)) return make_axis(t, end, step);
  *t = ss_malloc(sizeof **t);
  (*t)[0] = target(s->q, x);
  return 1;
}

/* Whether t_b can end phase Gamma near a given e1: chi r is at a record. */
static bool on_record(const struct scan *s, double tb) {
  const struct return_map_double *k = &s->q->k;
  double turn = fmod(tb, 2 * PI), slack = 2 * s->cell[0];
  return !is_given(s->q, QUANTITY_E1) || (turn < k->fall + slack && (tb < k->fall || turn > k->rise - slack));
}

/* The watched times: a twelfth of the shortest period apart. */
static void watch_init(struct scan *s, double end, double period) {
  double *t;
  s->n_watch = make_axis(&t, end, period / 12);
  s->watch = ss_malloc(s->n_watch * sizeof *s->watch);
  for (size_t i = 0; i < s->n_watch; i++) s->watch[i] = slip_at(&s->q->k, t[i]);
  free(t);
}

/* The sampled plane, of which two rows of constant t_b are held at a time. */
struct grid {
  double *tb, *tc;
  size_t nb, nc;
  struct slip *slips;    /* at every t_c */
  struct slide slide[2]; /* at the two t_b */
  struct sheet (*row[2])[2];
};

/* SS_UNABLE when a row alone would be too long. */
static int grid_init(struct grid *g, struct scan *s) {
  const struct quest *q = s->q;
  s->plane = !is_given(q, QUANTITY_TB) && !is_given(q, QUANTITY_TC);
  int parts = s->plane ? COARSE : FINE;
  double last = s->plane ? fmin(q->lim.t_max, DYN_GIVEN_TB) : q->lim.t_max, period = 2 * PI / q->k.om[1];
  if (!(last / (2 * PI) * parts < MAX_WORK && q->lim.t_max / period * parts < MAX_WORK)) return SS_UNABLE;
  g->nb = axis_of(&g->tb, s, QUANTITY_TB, last, 2 * PI, parts);
  g->nc = axis_of(&g->tc, s, QUANTITY_TC, q->lim.t_max, period, parts);
  watch_init(s, fmin(g->tc[g->nc - 1], q->lim.t_max), period);
  g->slips = ss_malloc(g->nc * sizeof *g->slips);
  for (size_t j = 0; j < g->nc; j++) g->slips[j] = slip_at(&q->k, g->tc[j]);
  for (int i = 0; i < 2; i++) g->row[i] = ss_malloc(g->nc * sizeof *g->row[i]);
  return SS_OK;
}

static void grid_clear(struct grid *g) {
  free(g->tb);
  free(g->tc);
  free(g->slips);
  for (int i = 0; i < 2; i++) free(g->row[i]);
}

/* The cell that ends at row i and column j. */
static struct cell grid_cell(const struct grid *g, size_t i, size_t j) {
  struct cell cell = {.nb = g->nb > 1 ? 2 : 1, .nc = g->nc > 1 ? 2 : 1};
  for (int k = 0; k < cell.nb; k++) {
    size_t row = (i + (size_t)(cell.nb - 1 - k)) % 2;
    cell.b[k] = g->slide[row];
    for (int l = 0; l < cell.nc; l++) {
      size_t col = j - (size_t)(cell.nc - 1 - l);
      cell.h[l] = g->slips[col];
      for (int sheet = 0; sheet < 2; sheet++) cell.at[k][l][sheet] = g->row[row][col][sheet];
    }
  }
  return cell;
}

/* SS_UNABLE when the budget of work is used up before the end. */
static int scan_plane(struct scan *s) {
  struct grid g;
  if (grid_init(&g, s)) return SS_UNABLE;
  size_t rows = 0; /* that are held and adjacent */
  int status = SS_OK;
  for (size_t i = 0; i < g.nb && !status; i++) {
    rows = on_record(s, g.tb[i]) ? rows + 1 : 0;
    if (rows == 0) continue;
    g.slide[i % 2] = slide_at(g.tb[i]);
    for (size_t j = 0; j < g.nc; j++) sheets_at(g.row[i % 2][j], &s->q->k, &g.slide[i % 2], &g.slips[j]);
    s->evaluations += (long)g.nc;
    s->work += (long)g.nc;
    if (rows < 2 && g.nb > 1) continue;
    for (size_t j = g.nc > 1; j < g.nc && !status; j++) {
      if (s->work > MAX_WORK) status = SS_UNABLE;
      struct cell cell = grid_cell(&g, i, j);
      try_cell(s, &cell, 0);
    }
  }
  grid_clear(&g);
  return status;
}

/* --- Refinement and proof. --- */

static int solve(struct word_root *s, const struct seed *seed, const struct quest *q, slong prec) {
  struct num_vec x;
  num_vec_init(&x, N_QUANTITIES, num_ctx_mpfr(prec));
  int status = SS_OK;
  for (slong i = 0; i < N_QUANTITIES; i++) status |= num_mpfr.set_d(num_vec_at(&x, i), seed->x[i], prec);
  if (!status) status = word_refine(&x, &q->data);
  if (!status) status = word_enclose(s, &x, &q->data);
  num_vec_clear(&x);
  return status;
}

static bool same_solution(const struct word_root *s, const struct word_root *t) {
  bool same = true;
  for (int k = 0; k < N_QUANTITIES && same; k++)
    same = arb_overlaps(s->x[k], t->x[k]) && (arb_contains(s->box[k], t->x[k]) || arb_contains(t->box[k], s->x[k]));
  return same;
}

/* The orbit's parameters, e1 and e2 as they came out. */
static void orbit_params(struct ball_params *m, struct calc *c, const struct word_root *s, const struct quest *q) {
  val p[N_PARAMS] = {calc_q(c, q->data.model), calc_q(c, q->data.model + 1), calc_q(c, q->data.model + 2),
                     s->x[QUANTITY_E1], s->x[QUANTITY_E2]};
  ball_params_make(m, c, p);
}

/* The sign of r at the stick phase, which phase C has too. */
static bool goes_up(struct calc *c, const struct ball_params *m, const struct word_root *s) {
  struct word w;
  val x[N_QUANTITIES];
  for (int i = 0; i < N_QUANTITIES; i++) x[i] = s->x[i];
  word_make(&w, c, m, x);
  return num_arb.get_d(w.end) > 0;
}

/* The numbers of the orbit of a solution. */
static int describe(struct dyn_orbit *o, const struct word_root *s, const struct quest *q, slong prec) {
  struct calc c;
  struct ball_params m;
  calc_init(&c, num_ctx_arb(prec));
  orbit_params(&m, &c, s, q);
  int status = dyn_orbit_describe(o, &c, &m, s->x[QUANTITY_TB], s->x[QUANTITY_TC], goes_up(&c, &m, s));
  for (int i = 0; i < N_PHASES; i++) arb_set(o->t[i], s->x[QUANTITY_TA + i]);
  calc_clear(&c);
  return status;
}

/* Its conditions.  Returns whether e1 and e2 are positive and the events proved to be the first ones. */
static truth judge(struct dyn_orbit *o, const struct word_root *s, const struct quest *q, slong prec) {
  struct calc c;
  struct ball_params m;
  calc_init(&c, num_ctx_arb(prec));
  orbit_params(&m, &c, s, q);
  arb_ptr pi = calc_new(&c);
  arb_const_pi(pi, prec);
  val td = s->x[QUANTITY_TD];
  truth valid = dyn_orbit_judge(o, &c, &m, s->x[QUANTITY_TB], s->x[QUANTITY_TC], goes_up(&c, &m, s), q->lim.max_steps);
  valid = truth_and(valid, truth_and(num_arb.lt(m.zero, m.p[P_E1]), num_arb.lt(m.zero, m.p[P_E2])));
  valid = truth_and(valid, truth_and(num_arb.lt(m.zero, td), num_arb.lt(calc_mul(&c, m.omega, td), pi)));
  o->holds[COND_TA] = num_arb.lt(m.zero, s->x[QUANTITY_TA]);
  o->admissible = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS; i++) o->admissible = truth_and(o->admissible, o->holds[i]);
  calc_clear(&c);
  return valid;
}

static bool undecided(const struct dyn_orbit *o) {
  return o->stable == TRUTH_UNKNOWN || o->admissible == TRUTH_UNKNOWN;
}

/* The working precision near a seed, from a pilot where it is worth its time. */
static slong plan(const struct seed *seed, const struct quest *q, slong prec) {
  struct word_root pilot;
  struct dyn_orbit o;
  if (prec <= DYN_PLANNED_FROM) return prec + DYN_GUARD;
  word_root_init(&pilot);
  dyn_orbit_init(&o);
  slong left = 0;
  if (!solve(&pilot, seed, q, DYN_PILOT) && !describe(&o, &pilot, q, DYN_PILOT)) left = dyn_orbit_accuracy(&o);
  dyn_orbit_clear(&o);
  word_root_clear(&pilot);
  return dyn_planned_bits(prec, left);
}

/* The orbit of a solution to prec bits, the working precision being raised from `work`, *raises times, as long as that
   helps. */
static int finish(struct dyn_orbit *o, truth *valid, long *raises, struct word_root *s, const struct seed *seed,
                  const struct quest *q, slong work, slong prec) {
  int status = describe(o, s, q, work);
  for (int i = 0; i < RAISES && (status || dyn_orbit_accuracy(o) < prec); i++) {
    work += FLINT_MIN(FLINT_MAX(prec - dyn_orbit_accuracy(o), 0), work) + DYN_GUARD;
    status = solve(s, seed, q, work);
    if (!status) status = describe(o, s, q, work);
    ++*raises;
  }
  *valid = judge(o, s, q, FLINT_MIN(work, 128));
  if (*valid == TRUTH_UNKNOWN || undecided(o)) *valid = judge(o, s, q, work);
  o->grazing = *valid == TRUTH_UNKNOWN;
  return status;
}

/* --- The list. --- */

/* The solution of a seed: the precision is raised where it cannot be told from another one yet. */
static int settle(struct word_root *s, const struct seed *seed, const struct quest *q, slong work) {
  int status = SS_UNABLE;
  for (int i = 0; i <= RAISES && status; i++) status = solve(s, seed, q, work << i);
  return status;
}

static int collect(struct dyn_orbits *list, const struct scan *scan, slong prec) {
  struct word_root *found = ss_malloc((scan->n + 1) * sizeof *found);
  size_t n = 0;
  int status = SS_OK;
  list->orbit = ss_malloc((scan->n + 1) * sizeof *list->orbit);
  for (size_t i = 0; i < scan->n; i++) {
    word_root_init(&found[n]);
    slong work = plan(&scan->seeds[i], scan->q, prec);
    int failed = settle(&found[n], &scan->seeds[i], scan->q, work);
    bool known = false;
    for (size_t k = 0; k < n && !failed; k++) known = known || same_solution(&found[k], &found[n]);
    status |= failed;
    if (failed || known) {
      word_root_clear(&found[n]);
      continue;
    }
    struct dyn_orbit *o = &list->orbit[list->n];
    truth valid;
    dyn_orbit_init(o);
    status |= finish(o, &valid, &list->raises, &found[n], &scan->seeds[i], scan->q, work, prec);
    list->bits = FLINT_MAX(list->bits, work);
    n++;
    if (valid == TRUTH_FALSE)
      dyn_orbit_clear(o);
    else
      list->n++;
  }
  for (size_t k = 0; k < n; k++) word_root_clear(&found[k]);
  free(found);
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, dyn_orbits_by_z10);
  return status;
}

static int quest_init(struct quest *q, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                      const struct dyn_limits *lim) {
  *q = (struct quest){.data = {model, value, which, {0}}, .lim = lim ? *lim : dyn_given_limits};
  if (which[0] == which[1]) return SS_DOMAIN;
  double p[N_PARAMS] = {fmpq_get_d(model), fmpq_get_d(model + 1), fmpq_get_d(model + 2), 1, 1};
  for (int i = 0; i < 3; i++)
    if (fmpq_sgn(model + i) <= 0) return SS_DOMAIN;
  if (fmpz_cmp(fmpq_numref(model), fmpq_denref(model)) >= 0) return SS_DOMAIN;
  for (int i = 0; i < 2; i++) {
    if (which[i] != QUANTITY_TA && fmpq_sgn(value + i) <= 0) return SS_DOMAIN;
    q->target[i] = fmpq_get_d(value + i);
    if (which[i] == QUANTITY_E1) p[P_E1] = q->target[i];
  }
  int n = 0;
  for (int i = 0; i < N_QUANTITIES; i++)
    if (!is_given(q, (enum dyn_quantity)i)) q->data.unknown[n++] = i;
  if (return_map_double_init(&q->k, p)) return SS_UNABLE; /* in the domain, but not in that of double precision */
  return_map_double_records(&q->k);
  return SS_OK;
}

/* e1 and e2 are given: the search of dynamics.h. */
static int find_by_limits(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2],
                          const fmpq *value, slong prec, const struct dyn_limits *lim) {
  fmpq params[N_PARAMS];
  int first = which[0] == QUANTITY_E1 ? 0 : 1;
  for (int i = 0; i < 3; i++) params[i] = model[i]; /* borrowed */
  params[P_E1] = value[first];
  params[P_E2] = value[1 - first];
  return dyn_orbits_find(list, params, prec, lim);
}

int dyn_orbits_given(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                     slong prec, const struct dyn_limits *lim) {
  struct quest q;
  *list = (struct dyn_orbits){.n = 0};
  int status = quest_init(&q, model, which, value, lim);
  if (status) return status;
  if (is_given(&q, QUANTITY_E1) && is_given(&q, QUANTITY_E2))
    return find_by_limits(list, model, which, value, prec, lim);
  struct scan scan = {.q = &q};
  calc_init(&scan.c, num_ctx_double());
  word_params(&scan.m, &scan.c, model);
  status = scan_plane(&scan);
  status |= collect(list, &scan, prec);
  list->evaluations = scan.evaluations;
  calc_clear(&scan.c);
  free(scan.seeds);
  free(scan.watch);
  return status;
}
