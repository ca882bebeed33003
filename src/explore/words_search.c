/* Where the orbits of a word may be, in double precision.

   From a state at the entry of the first phase the word is followed, whatever else Coulomb's law would do: each phase
   ends at the first positive root of its own switching function (D, which is linear, at any time).  The free
   coordinates run over a grid; where the distance between them and their return has a local minimum, or changes its
   sign when there is one only, Newton's iteration on all unknowns starts.  Seeds start it too. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/work.h"
#include "motion/trig_sum.h"
#include "num/calc.h"
#include "num/solve.h"
#include "words_impl.h"

enum { MOST_NEWTON = 40, MOST_STARTS = 200 };
enum { UNITS_OF_PHASE = 100 }; /* of work: the motion of a phase */
static const int points_along[WORD_FREE_MOST + 1] = {0, 2000, 56, 16};

struct searcher {
  const struct mech_word *w;
  struct calc c;
  struct word_law m;
  slong mark; /* what lies above it in the calc belongs to one evaluation */
  const int *free;
  int n, size;                      /* free coordinates, unknowns */
  double force, speed[2], limit[2]; /* scales; limit: the greatest w of a sticking mass */
  struct dyn_limits lim;
  struct word_finds *out;
};

static bool is_d(const char *phase) {
  return strcmp(phase, "ss") == 0;
}

/* --- The map of the free coordinates. --- */

/* The length of a phase from the state; false when its own event never comes. */
static bool own_length(double *t, struct searcher *s, int phase, const struct motion *motion,
                       const val state[N_STATE]) {
  struct word_event e = word_event_of(s->w, phase);
  if (is_d(s->w->phase[phase])) {
    *t = -num_double.get_d(word_event_value(&s->c, &s->m, &e, state)) / num_double.get_d(s->m.law.gap);
    return true;
  }
  struct trig_sum wave =
      harmonic_trig_sum(&s->c, e.end == MECH_REACHES ? &motion->speed[e.mass] : &motion->force[e.mass]);
  wave.start = num_double.get_d(word_event_value(&s->c, &s->m, &e, state));
  if (fabs(wave.start) < 1e-14 * s->force) wave.start = 0; /* the mass has just broken loose */
  struct trig_sum_root root;
  int status = trig_sum_first_root(&root, &wave, NULL, &s->lim);
  work_add((unsigned long long)root.steps * UNITS_OF_STEP);
  if (status) return false;
  *t = root.t;
  return true;
}

/* x: the free coordinates are known, the lengths become so; gap: the changes of the free coordinates over their
   scales. */
static bool follow(double *x, double *gap, struct searcher *s) {
  struct calc *c = &s->c;
  slong mark = calc_mark(c);
  val state[N_STATE], free[WORD_FREE_MOST];
  bool ok = true;
  c->status = SS_OK;
  s->out->evaluations++;
  for (int i = 0; i < s->n; i++) free[i] = calc_d(c, x[s->w->n + i]);
  word_start(state, c, &s->m, free);
  for (int p = 0; p < s->w->n && ok; p++) {
    struct motion motion;
    word_motion(&motion, c, &s->m, s->w->phase[p], state, false);
    work_add(UNITS_OF_PHASE);
    ok = own_length(&x[p], s, p, &motion, state);
    if (!ok) break;
    motion_at(state, c, &motion, calc_d(c, x[p]));
    word_settle(state, &s->m, s->w->phase[(p + 1) % s->w->n]);
    ok = !c->status;
  }
  for (int i = 0; i < s->n && ok; i++) {
    double scale = s->free[i] < WORD_P1 ? s->force : s->speed[s->free[i] - WORD_P1];
    gap[i] = (num_double.get_d(state[s->free[i]]) - x[s->w->n + i]) / scale;
  }
  calc_release(c, mark);
  return ok;
}

/* --- Newton's iteration. --- */

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct searcher *s = self;
  val at[WORD_UNKNOWNS];
  work_add((unsigned long long)(s->w->n * s->size) * UNITS_OF_PHASE);
  calc_release(&s->c, s->mark);
  s->c.status = SS_OK;
  flow_vals(at, x, 0, x->len);
  word_equations(f, j, &s->c, &s->m, at);
  return s->c.status;
}

/* By the largest change relative to the scales. */
static enum newton_next judge(const struct num_vec *x, const struct num_vec *step, void *self) {
  const struct searcher *s = self;
  double change = 0, total = 0;
  for (int i = 0; i < s->w->n; i++) total += fabs(num_double.get_d(num_vec_at(x, i)));
  for (int i = 0; i < s->size; i++) {
    double scale = i < s->w->n                      ? total + 1e-300
                   : s->free[i - s->w->n] < WORD_P1 ? s->force
                                                    : s->speed[s->free[i - s->w->n] - WORD_P1];
    change = fmax(change, fabs(num_double.get_d(num_vec_at(step, i))) / scale);
  }
  return !(change <= 1e3) ? NEWTON_LOST : change < 1e-11 ? NEWTON_LAST : NEWTON_ON;
}

static bool newton(double *x, struct searcher *s) {
  struct solve_system system = {s->size, values, s};
  struct num_vec at = {s->c.ctx, s->size, (char *)x};
  int status = newton_run(&at, &system, s->c.ctx, MOST_NEWTON, judge);
  calc_release(&s->c, s->mark);
  for (int p = 0; p < s->w->n && !status; p++)
    if (!is_d(s->w->phase[p]) && !(x[p] > 1e-9)) return false;
  return !status;
}

/* The same orbit, begun at the phase by. */
static bool repeats(const double *x, const double *y, int n, int by) {
  double total = 0, off = 0;
  for (int p = 0; p < n; p++) {
    total += fabs(x[p]);
    off = fmax(off, fabs(x[p] - y[(p + by) % n]));
  }
  return off < 1e-7 * total;
}

static void keep(struct searcher *s, const double *x) {
  val free[WORD_FREE_MOST], state[N_STATE];
  int n = s->w->n;
  for (int by = 1; by < n; by++)
    if (mech_word_goes_through(s->w, s->w, by) && repeats(x, x, n, by)) return; /* a shorter word's */
  for (size_t i = 0; i < s->out->n; i++)
    for (int by = 0; by < n; by++)
      if (mech_word_goes_through(s->w, s->w, by) && repeats(x, s->out->found[i].t, n, by)) return;
  struct word_found *found = SS_PUSH(s->out->found, s->out->n, s->out->cap);
  for (int i = 0; i < s->n; i++) free[i] = calc_d(&s->c, x[n + i]);
  word_start(state, &s->c, &s->m, free);
  memcpy(found->t, x, sizeof found->t);
  for (int i = 0; i < N_STATE; i++) found->state[i] = num_double.get_d(state[i]);
  calc_release(&s->c, s->mark);
}

static void try_from(struct searcher *s, const double *start) {
  double x[WORD_UNKNOWNS];
  memcpy(x, start, sizeof x);
  s->out->candidates++;
  if (newton(x, s)) keep(s, x);
}

/* --- The grid. --- */

struct node {
  double x[WORD_UNKNOWNS], gap[WORD_FREE_MOST], size;
  bool ok;
};

/* The coordinate at the share u of its range, denser towards the belt's speed and towards the limit. */
static double place(const struct searcher *s, int which, double u) {
  int mass = which < WORD_P1 ? which : which - WORD_P1;
  char mode = s->w->phase[0][mass];
  if (which >= WORD_P1) return (mode == '+' ? 1 : -1) * s->speed[mass] * u * u;
  if (mode == 's') return s->limit[mass] - 2 * s->force * u * u;
  double v = 2 * u - 1;
  return s->force * v * (0.2 + 0.8 * fabs(v));
}

static void fill(struct node *grid, struct searcher *s, int along, int total) {
  for (int k = 0; k < total; k++) {
    for (int i = 0, rest = k; i < s->n; i++, rest /= along)
      grid[k].x[s->w->n + i] = place(s, s->free[i], (rest % along + 0.5) / along);
    grid[k].ok = follow(grid[k].x, grid[k].gap, s);
    grid[k].size = 0;
    for (int i = 0; i < s->n && grid[k].ok; i++) grid[k].size = hypot(grid[k].size, grid[k].gap[i]);
  }
}

/* No neighbour along an axis is nearer to its return. */
static bool is_least(const struct node *grid, int k, int n, int along, int total) {
  for (int i = 0, stride = 1; i < n; i++, stride *= along)
    for (int side = -1; side <= 1; side += 2) {
      int place_along = k / stride % along + side, other = k + side * stride;
      if (place_along < 0 || place_along >= along || other < 0 || other >= total) continue;
      if (grid[other].ok && grid[other].size < grid[k].size) return false;
    }
  return true;
}

static int by_size(const void *x, const void *y) {
  const struct node *a = *(const struct node *const *)x, *b = *(const struct node *const *)y;
  return (a->size > b->size) - (a->size < b->size);
}

/* One free coordinate: the crossing between two neighbours by bisection, in y; a jump looks like one, and Newton's
   iteration tells. */
static void bisect(struct node *y, struct searcher *s, const struct node *a, const struct node *b) {
  enum { HALVINGS = 48 };
  int free = s->w->n;
  struct node low = *a, high = *b;
  *y = low;
  for (int i = 0; i < HALVINGS; i++) {
    struct node mid = low;
    mid.x[free] = 0.5 * (low.x[free] + high.x[free]);
    if (!follow(mid.x, mid.gap, s)) return;
    if ((mid.gap[0] < 0) == (low.gap[0] < 0))
      low = mid;
    else
      high = mid;
  }
  *y = fabs(low.gap[0]) < fabs(high.gap[0]) ? low : high;
}

/* A pair of crossings hidden beside a node that is nearer to its return than its neighbours: the least distance by
   golden sections, until a crossing shows up on the way. */
static void find_pair(struct searcher *s, const struct node *a, const struct node *b, const struct node *c) {
  enum { SECTIONS = 40 };
  const double golden = 0.38196601125010515;
  int free = s->w->n;
  struct node low = *a, mid = *b, high = *c, y;
  for (int i = 0; i < SECTIONS; i++) {
    bool left = fabs(mid.x[free] - low.x[free]) > fabs(high.x[free] - mid.x[free]);
    struct node next = mid;
    next.x[free] += golden * ((left ? low.x[free] : high.x[free]) - mid.x[free]);
    if (!follow(next.x, next.gap, s)) return;
    if ((next.gap[0] < 0) != (mid.gap[0] < 0)) {
      bisect(&y, s, &mid, &next);
      try_from(s, y.x);
      bisect(&y, s, &next, left ? &low : &high);
      try_from(s, y.x);
      return;
    }
    bool nearer = fabs(next.gap[0]) < fabs(mid.gap[0]);
    if (nearer) {
      *(left ? &high : &low) = mid;
      mid = next;
    } else {
      *(left ? &low : &high) = next;
    }
  }
  try_from(s, mid.x);
}

static void search_line(struct searcher *s, const struct node *grid, int total) {
  struct node y;
  for (int k = 0; k + 1 < total; k++) {
    if (!grid[k].ok || !grid[k + 1].ok) continue;
    bool crosses = (grid[k].gap[0] < 0) != (grid[k + 1].gap[0] < 0);
    if (crosses) {
      bisect(&y, s, &grid[k], &grid[k + 1]);
      try_from(s, y.x);
    } else if (k > 0 && grid[k - 1].ok && is_least(grid, k, 1, total, total) &&
               (grid[k].gap[0] < 0) == (grid[k - 1].gap[0] < 0)) {
      find_pair(s, &grid[k - 1], &grid[k], &grid[k + 1]);
    }
  }
}

static void search_grid(struct searcher *s) {
  int along = points_along[s->n], total = 1;
  for (int i = 0; i < s->n; i++) total *= along;
  FREED struct node *grid = ss_malloc((size_t)total * sizeof *grid);
  FREED const struct node **start = ss_malloc((size_t)total * sizeof *start);
  size_t n = 0;
  fill(grid, s, along, total);
  if (s->n == 1) search_line(s, grid, total);
  for (int k = 0; k < total && s->n > 1; k++)
    if (grid[k].ok && is_least(grid, k, s->n, along, total)) start[n++] = &grid[k];
  qsort(start, n, sizeof *start, by_size);
  for (size_t i = 0; i < n && i < MOST_STARTS; i++) try_from(s, start[i]->x);
}

/* --- Seeds. --- */

/* The seed's orbit from the phase that the word begins with. */
static void from_seed(struct searcher *s, const struct word_seed *seed, int by) {
  double x[WORD_UNKNOWNS];
  int n = s->w->n;
  for (int p = 0; p < n; p++) x[p] = seed->t[(p + by) % n];
  for (int i = 0; i < s->n; i++) x[n + i] = seed->state[by][s->free[i]];
  try_from(s, x);
}

static void search_seeds(struct searcher *s, const struct word_seeds *seeds) {
  for (size_t i = 0; i < seeds->n; i++) {
    int by = mech_word_turned(s->w, &seeds->seed[i].word);
    if (by >= 0) from_seed(s, &seeds->seed[i], by);
  }
}

/* --- Together. --- */

static void scales(struct searcher *s, const fmpq *params, const fmpq *const u_r[2]) {
  double p[N_PARAMS], reach = 0;
  for (int i = 0; i < N_PARAMS; i++) p[i] = fmpq_get_d(params + i);
  double om[2] = {num_double.get_d(s->m.law.spectrum.om[0]), num_double.get_d(s->m.law.spectrum.om[1])};
  for (int i = 0; i < 2; i++) {
    s->limit[i] = p[P_E1 + i];
    reach += 2 * p[P_E1 + i] + (u_r[i] ? fmpq_get_d(u_r[i]) : 0);
  }
  s->force = 2 * reach + 4 * p[P_V] * (1 + num_double.get_d(s->m.law.omega));
  s->speed[0] = 4 * p[P_V] + s->force;
  s->speed[1] = 4 * p[P_V] + s->force * p[P_ETA] / num_double.get_d(s->m.law.omega);
  s->lim = (struct dyn_limits){200 / om[0], 2000};
}

void word_search(struct word_finds *out, const struct word_orbits *of, const fmpq *params, const fmpq *const u_r[2],
                 const struct word_seeds *seeds) {
  struct searcher s = {.w = &of->word, .c = calc_begin(num_ctx_double()), .out = out};
  *out = (struct word_finds){.n = 0};
  word_law_make(&s.m, &s.c, of, params, u_r);
  s.mark = calc_mark(&s.c);
  s.free = s.m.free;
  s.n = s.m.n_free;
  s.size = s.w->n + s.n;
  if (!s.c.status) {
    scales(&s, params, u_r);
    if (seeds) search_seeds(&s, seeds);
    search_grid(&s);
  }
  calc_clear(&s.c);
}
