/* The search for orbits that have two given quantities, in double precision.

   The two sheets (sheet.c) are sampled over a grid of (t_b, t_c), of which one given time leaves a line and two a
   point.  A cell between samples is tried when the given values can occur in it: Newton's iteration on the four
   equations starts from each of its corners.  On a line, cells in which a sheet ends or changes much are halved
   first. */
#include "given_search.h"
#include "num/solve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "num/pi.h"

enum {
  FINE = 300, /* cells to a period on a line and in the plane */
  COARSE = 50,
  MAX_DEPTH = 8,       /* of halving a cell */
  SEED_BITS = 18,      /* Newton's steps in double precision become as small as this; then one more is taken */
  STEP_WORK = 32,      /* what such a step costs, in points of the sheets */
  MAX_WORK = 15000000, /* about five seconds at worst */
};

struct scan {
  const struct given_problem *q;
  struct seeds *out;
  struct calc c;
  struct ball_params m;
  bool plane;     /* t_b and t_c are both unknown */
  double cell[2]; /* sizes in t_b and t_c */
  double last_tc;
  struct slip_matrix *watch; /* times at which m1 is looked at, once it is */
  size_t n_watch;
  long work; /* points of the sheets, and what costs about as much; Newton's steps count STEP_WORK each */
};

bool given_problem_knows(const struct given_problem *q, enum dyn_quantity x) {
  return q->data.which[0] == x || q->data.which[1] == x;
}

static double target(const struct given_problem *q, enum dyn_quantity x) {
  return q->target[q->data.which[0] == x ? 0 : 1];
}

/* No event comes clearly before its time, and every quantity is in its domain. */
static bool plausible(struct scan *scan, const double x[N_QUANTITIES]) {
  const struct given_problem *q = scan->q;
  struct return_map_double k;
  struct pass s;
  double tb = x[QUANTITY_TB], tc = x[QUANTITY_TC], td = x[QUANTITY_TD], turn = fmod(tb, 2 * PI), slack = 1e-6;
  const double p[N_PARAMS] = {q->k.slip.chi, q->k.slip.eta, q->k.slip.V, x[QUANTITY_E1], x[QUANTITY_E2]};
  if (return_map_double_init(&k, p) || !(tb > 0 && tc > 0 && td > 0 && td * k.slip.omc < PI)) return false;
  if ((tb > q->lim.t_max && !given_problem_knows(q, QUANTITY_TB)) ||
      (tc > q->lim.t_max && !given_problem_knows(q, QUANTITY_TC)))
    return false;
  return_map_double_records(&k);
  if (turn > k.fall + slack || (tb > k.fall + slack && turn < k.rise - slack)) return false;
  const struct dyn_limits lim = {tc + 1, q->lim.max_steps};
  return_map_double_pass(&s, &k, tb, NULL, &lim);
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
  struct seeds *list = s->out;
  for (size_t i = 0; i < list->n; i++)
    if (same_seed(list->seed[i].x, x)) return;
  if (!plausible(s, x)) return;
  list->seed = ss_grow(list->seed, list->n, &list->cap, sizeof *list->seed);
  for (int i = 0; i < N_QUANTITIES; i++) list->seed[list->n].x[i] = x[i];
  list->n++;
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
  const double *at = num_vec_at(x, 0), *by = num_vec_at(step, 0);
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
    x[i] = given_problem_knows(s->q, (enum dyn_quantity)i) ? target(s->q, (enum dyn_quantity)i) : from->x[i];
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
static bool meets(const struct sheet *const *point, int n, enum dyn_quantity x, double slack, double low, double high) {
  struct range r = range_of(point, n, x);
  double margin = slack * (r.high - r.low) + 1e-9 * (fabs(r.low) + fabs(r.high));
  return r.low - margin <= high && r.high + margin >= low;
}

/* Sample times up to end: closely spaced near zero, then by steps of the given size. */
static size_t make_axis(double **t, double end, double step) {
  size_t n = 0, cap = 0;
  *t = NULL;
  for (double x = fmin(1e-4, end); x < end; x = x < 4 * step ? 1.25 * x : x + step) *SS_PUSH(*t, n, cap) = x;
  *SS_PUSH(*t, n, cap) = end;
  return n;
}

/* The watched times: a twelfth of the shortest period apart. */
static void watch_init(struct scan *s) {
  FREED double *t;
  s->n_watch = make_axis(&t, s->last_tc, 2 * PI / s->q->k.slip.om[1] / 12);
  s->watch = ss_malloc(s->n_watch * sizeof *s->watch);
  for (size_t i = 0; i < s->n_watch; i++) s->watch[i] = slip_matrix_at(&s->q->k.slip, t[i]);
}

/* Whether m1 has clearly overtaken the belt at a watched time before t_c: then no first event is near.  Clearly: by
   half of what it has fallen behind so far. */
static bool overtaken(struct scan *s, const struct sheet *p) {
  struct gamma_turn b = gamma_turn_at(p->x[QUANTITY_TB]);
  double behind = 0;
  if (!s->watch) watch_init(s);
  for (size_t j = 0; j < s->n_watch && s->watch[j].t < p->x[QUANTITY_TC]; j++) {
    double lead = sheet_lead(p, &s->q->k.slip, &b, &s->watch[j]);
    behind = fmax(behind, -lead);
    if (j % 8 == 0) s->work++;
    if (lead > 0.5 * behind) return true;
  }
  return false;
}

/* Starts from each point, if the given values can occur between the points at all. */
static void try_points(struct scan *s, const struct sheet *const *point, int n, double slack) {
  const struct given_problem *q = s->q;
  for (int i = 0; i < 2; i++)
    if (!meets(point, n, q->data.which[i], slack, q->target[i], q->target[i])) return;
  for (enum dyn_quantity x = QUANTITY_E1; x <= QUANTITY_E2; x++)
    if (!meets(point, n, x, slack, 0, INFINITY)) return;
  if (!meets(point, n, QUANTITY_TD, slack, 0, PI / q->k.slip.omc)) return;
  for (int k = 0; k < n; k++)
    if (!overtaken(s, point[k])) descend(s, point[k]);
}

/* A cell of the plane with both sheets at its corners; one given time makes it a stretch, two a point. */
struct cell {
  struct gamma_turn b[2];
  struct slip_matrix h[2];
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
static bool smooth(const struct given_problem *q, const struct cell *cell) {
  const struct sheet *point[8];
  for (int sheet = 0; sheet < 2; sheet++) {
    int n = real_points(point, cell, sheet);
    if (n < cell->nb * cell->nc) return false;
    struct range e1 = range_of(point, n, QUANTITY_E1), e2 = range_of(point, n, QUANTITY_E2);
    double size = q->k.slip.V + fmax(fabs(e1.low), fabs(e1.high)) + fmax(fabs(e2.low), fabs(e2.high));
    struct range td = range_of(point, n, QUANTITY_TD);
    if (e1.high - e1.low + e2.high - e2.low > 0.3 * size || (td.high - td.low) * q->k.slip.omc > 0.3) return false;
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

/* A stretch of a line, by its middle. */
static void split_cell(struct scan *s, const struct cell *cell, int depth) {
  struct gamma_turn b[3] = {cell->b[0], cell->b[0], cell->b[cell->nb - 1]};
  struct slip_matrix h[3] = {cell->h[0], cell->h[0], cell->h[cell->nc - 1]};
  struct sheet at[3][2];
  if (cell->nb == 2)
    b[1] = gamma_turn_at(0.5 * (b[0].t + b[2].t));
  else
    h[1] = slip_matrix_at(&s->q->k.slip, 0.5 * (h[0].t + h[2].t));
  for (int i = 0; i < 3; i++) sheets_at(at[i], &s->q->k.slip, &b[i], &h[i]);
  s->out->evaluations += 3;
  s->work += 3;
  for (int i = 0; i < 2; i++) {
    struct cell part = {.b = {b[i], b[i + 1]}, .h = {h[i], h[i + 1]}, .nb = cell->nb, .nc = cell->nc};
    for (int k = 0; k < 2; k++) memcpy(part.at[cell->nb == 2 ? k : 0][cell->nb == 2 ? 0 : k], at[i + k], sizeof at[0]);
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

static size_t axis_of(double **t, struct scan *s, enum dyn_quantity x, double end, double period, int parts) {
  double step = period / parts;
  s->cell[x - QUANTITY_TB] = step;
  if (!given_problem_knows(s->q, x)) return make_axis(t, end, step);
  *t = ss_malloc(sizeof **t);
  (*t)[0] = target(s->q, x);
  return 1;
}

/* Whether t_b can end phase Gamma near a given e1: chi r is at a record. */
static bool on_record(const struct scan *s, double tb) {
  const struct return_map_double *k = &s->q->k;
  double turn = fmod(tb, 2 * PI), slack = 2 * s->cell[0];
  return !given_problem_knows(s->q, QUANTITY_E1) ||
         (turn < k->fall + slack && (tb < k->fall || turn > k->rise - slack));
}

/* The sampled plane, of which two rows of constant t_b are held at a time. */
struct grid {
  double *tb, *tc;
  size_t nb, nc;
  struct slip_matrix *slips;  /* at every t_c */
  struct gamma_turn slide[2]; /* at the two t_b */
  struct sheet (*row[2])[2];
};

/* SS_UNABLE when a row alone would be too long. */
static int grid_init(struct grid *g, struct scan *s) {
  const struct given_problem *q = s->q;
  s->plane = !given_problem_knows(q, QUANTITY_TB) && !given_problem_knows(q, QUANTITY_TC);
  int parts = s->plane ? COARSE : FINE;
  double last = s->plane ? fmin(q->lim.t_max, DYN_GIVEN_TB) : q->lim.t_max, period = 2 * PI / q->k.slip.om[1];
  if (!(last / (2 * PI) * parts < MAX_WORK && q->lim.t_max / period * parts < MAX_WORK)) return SS_UNABLE;
  g->nb = axis_of(&g->tb, s, QUANTITY_TB, last, 2 * PI, parts);
  g->nc = axis_of(&g->tc, s, QUANTITY_TC, q->lim.t_max, period, parts);
  s->last_tc = fmin(g->tc[g->nc - 1], q->lim.t_max);
  g->slips = ss_malloc(g->nc * sizeof *g->slips);
  for (size_t j = 0; j < g->nc; j++) g->slips[j] = slip_matrix_at(&q->k.slip, g->tc[j]);
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
  OWNED(grid) g = {.tb = NULL};
  if (grid_init(&g, s)) return SS_UNABLE;
  size_t rows = 0; /* that are held and adjacent */
  int status = SS_OK;
  for (size_t i = 0; i < g.nb && !status; i++) {
    rows = on_record(s, g.tb[i]) ? rows + 1 : 0;
    if (rows == 0) continue;
    g.slide[i % 2] = gamma_turn_at(g.tb[i]);
    for (size_t j = 0; j < g.nc; j++) sheets_at(g.row[i % 2][j], &s->q->k.slip, &g.slide[i % 2], &g.slips[j]);
    s->out->evaluations += (long)g.nc;
    s->work += (long)g.nc;
    if (rows < 2 && g.nb > 1) continue;
    for (size_t j = g.nc > 1; j < g.nc && !status; j++) {
      if (s->work > MAX_WORK) status = SS_UNABLE;
      struct cell cell = grid_cell(&g, i, j);
      try_cell(s, &cell, 0);
    }
  }
  return status;
}

int given_search(struct seeds *out, const struct given_problem *q) {
  struct scan s = {.q = q, .out = out};
  *out = (struct seeds){.n = 0};
  s.c = calc_begin(num_ctx_double());
  word_params(&s.m, &s.c, q->data.model);
  int status = scan_plane(&s);
  calc_clear(&s.c);
  free(s.watch);
  return status;
}
