/* Every periodic orbit of the word, found in double precision and enclosed in balls.

   A zero of the search is refined by Newton's iteration on (t_b, t_c) at a precision that doubles, and a Krawczyk step
   proves that a box holds exactly one solution; boxes tell whether two zeros are one.  Where the search saw an extremum
   of the defect too close to zero to call, the extremum itself is computed and shows none or two.  Then it is proved
   that each event is the first of its phase, and what an orbit must fulfil besides is decided on balls. */
#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "map_balls.h"
#include "num/solve.h"
#include "orbit_judge.h"
#include "search.h"
#include "warm.h"

enum { RAISES = 4 }; /* of the precision of a fold */

/* A solution (t_b, t_c) of the two equations: the enclosures x, and the boxes in which it is the only one.  The calc
   and what it holds, the kept sines and cosines near the solution, are those of the last precision, 0 when there is
   none. */
struct solution {
  arb_t x[2], box[2];
  bool up, grazing;
  slong prec, mark; /* mark: what lies above it in the calc belongs to one pass */
  const fmpq *params;
  long max_steps;
  struct calc c;
  struct ball_params m;
};

/* Where it is looked for. */
static void solution_at(struct solution *s, struct dyn_place at) {
  arb_set_d(s->x[0], at.tb);
  arb_set_d(s->x[1], at.tc);
  s->up = at.up;
  s->grazing = false;
}

static void close_calc(struct solution *s) {
  if (s->prec) calc_clear(&s->c);
  s->prec = 0;
}

static void solution_clear(struct solution *s) {
  for (int i = 0; i < 2; i++) {
    arb_clear(s->x[i]);
    arb_clear(s->box[i]);
  }
  close_calc(s);
}

/* The two equations, the velocity pc and the defect, as functions of (t_b, t_c). */
static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct solution *s = self;
  struct calc *c = &s->c;
  struct ball_pass at;
  calc_release(c, s->mark);
  c->status = SS_OK;
  ball_pass_make(&at, c, &s->m, num_vec_at(x, 0), num_vec_at(x, 1), s->up);
  if (f) f[0] = at.pc, f[1] = at.defect;
  j[0] = at.pc_tb, j[1] = calc_neg(c, at.wc);
  j[2] = at.defect_tb, j[3] = at.defect_tc;
  return c->status;
}

/* A calc of the precision, with the sines and cosines at the midpoints of x. */
static void open_calc(struct solution *s, slong prec) {
  close_calc(s);
  s->prec = prec;
  s->c = calc_begin(num_ctx_arb(prec));
  ball_params_init(&s->m, &s->c, s->params);
  for (int k = 0; k < 2; k++) arb_set_round(s->x[k], s->x[k], prec);
  ball_params_keep(&s->m, &s->c, calc_middle(&s->c, s->x[0]), calc_middle(&s->c, s->x[1]));
  s->mark = calc_mark(&s->c);
}

static enum newton_next settles(const struct num_vec *x, const struct num_vec *step, void *self) {
  (void)self;
  for (int k = 0; k < 2; k++)
    if (!newton_is_small(&num_arb, num_vec_at(step, k), x->ctx.prec / 2 + 4, num_vec_at(x, k))) return NEWTON_ON;
  return NEWTON_LAST;
}

static int newton_level(slong prec, void *self) {
  struct solution *s = self;
  struct solve_system system = {2, values, s};
  open_calc(s, prec);
  for (int k = 0; k < 2; k++) arb_get_mid_arb(s->x[k], s->x[k]);
  struct num_vec x = {s->c.ctx, 2, (char *)s->x};
  return s->c.status | newton_run(&x, &system, s->c.ctx, 40, settles);
}

/* Newton's iteration, and Krawczyk's operator around the midpoints of s->x in the calc of its last level. */
static int solve(void *self, slong prec) {
  struct solution *s = self;
  struct solve_system system = {2, values, s};
  int status = newton_rising(newton_level, s, prec);
  struct num_vec x = {s->c.ctx, 2, (char *)s->x}, box = {s->c.ctx, 2, (char *)s->box};
  return status ? status : krawczyk_enclose(&x, &box, &system);
}

/* --- Folds. --- */

/* The defect's slope at t_b = s->tb, t_c being refined to the root of pc first. */
static int slope_at(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc, bool up) {
  val small = calc_two_to(c, -c->ctx.prec / 2);
  for (int i = 0; i < 40 && !c->status; i++) {
    ball_pass_make(s, c, m, tb, tc, up);
    val step = calc_middle(c, calc_div(c, s->pc, s->wc)); /* pc' = -wc */
    tc = calc_middle(c, calc_add(c, tc, step));
    if (!calc_lt(c, calc_mul(c, small, calc_abs(c, tc)), calc_abs(c, step))) {
      ball_pass_make(s, c, m, tb, tc, up);
      return c->status;
    }
  }
  return c->status | SS_UNABLE;
}

/* The extremum of the defect near a zero marked as fold, by the secant method on its slope.  *n of the two solutions
   receive starting values: none or two.  SS_UNABLE when the extremum cannot be told from zero at this precision. */
static int split_fold(struct solution pair[2], int *n, const fmpq *params, const struct zero *zero, slong prec) {
  struct ball_params m;
  struct ball_pass a, b;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  ball_params_init(&m, &c, params);
  val width = calc_d(&c, fmax(zero->high - zero->low, 1e-12 * zero->at.tb)), tc = calc_d(&c, zero->at.tc);
  val tb = calc_d(&c, zero->at.tb), small = calc_mul(&c, width, calc_two_to(&c, -prec / 3)), bend = m.zero;
  int status = slope_at(&a, &c, &m, calc_add(&c, tb, width), tc, zero->at.up);
  status |= slope_at(&b, &c, &m, tb, tc, zero->at.up);
  bool settled = false;
  for (int i = 0; i < 60 && !status && !settled; i++) {
    bend = calc_middle(&c, calc_div(&c, calc_sub(&c, b.defect_tb, a.defect_tb), calc_sub(&c, b.tb, a.tb)));
    val step = calc_middle(&c, calc_neg(&c, calc_div(&c, b.defect_tb, bend)));
    settled = calc_lt(&c, calc_abs(&c, step), small);
    a = b;
    status |= slope_at(&b, &c, &m, calc_middle(&c, calc_add(&c, b.tb, step)), b.tc, zero->at.up);
  }
  *n = 0;
  if (status || !settled) return status | SS_UNABLE; /* the passes of a step that failed hold nothing */
  val square = calc_neg(&c, calc_div(&c, calc_mul(&c, m.two, b.defect), bend));
  val noise = calc_mul(&c, calc_mul(&c, width, width), calc_two_to(&c, -prec / 2));
  if (c.status || !calc_lt(&c, noise, calc_abs(&c, square))) {
    status |= SS_UNABLE;
  } else if (calc_lt(&c, m.zero, square)) {
    val half = calc_sqrt(&c, square), drift = calc_div(&c, b.pc_tb, b.wc); /* d t_c / d t_b */
    for (*n = 0; *n < 2; ++*n) {
      val off = *n == 0 ? calc_neg(&c, half) : half;
      arb_get_mid_arb(pair[*n].x[0], calc_add(&c, b.tb, off));
      arb_get_mid_arb(pair[*n].x[1], calc_add(&c, b.tc, calc_mul(&c, drift, off)));
      pair[*n].up = zero->at.up;
      pair[*n].grazing = zero->grazing;
    }
    status |= c.status;
  }
  return status;
}

/* The solutions that a zero of the search stands for, at most two. */
static int resolve(struct solution pair[2], int *n, const fmpq *params, const struct zero *zero, slong prec) {
  *n = 1;
  if (!zero->fold) {
    solution_at(&pair[0], zero->at);
    pair[0].grazing = zero->grazing;
    double slack = 1e-9 * zero->high + 0.01 * (zero->high - zero->low);
    if (!solve(&pair[0], prec)) {
      double tb = num_arb.get_d(pair[0].x[0]);
      if (tb > zero->low - slack && tb < zero->high + slack) return SS_OK;
    }
  }
  for (int i = 0; i <= RAISES; i++, prec *= 2) {
    slong p = FLINT_MAX(prec, 192);
    if (split_fold(pair, n, params, zero, p)) continue;
    if (*n == 0 || (!solve(&pair[0], p) && !solve(&pair[1], p))) return SS_OK;
  }
  *n = 0;
  return SS_UNABLE;
}

/* --- The orbit of a solution. --- */

/* In the calc of its last precision. */
static int describe(struct dyn_orbit *o, void *self, slong prec) {
  struct solution *s = self;
  struct ball_pass at;
  (void)prec;
  ball_pass_make(&at, &s->c, &s->m, s->x[0], s->x[1], s->up);
  return dyn_orbit_describe(o, &s->c, &s->m, &at);
}

static truth judge(struct dyn_orbit *o, void *self, slong prec) {
  const struct solution *s = self;
  struct ball_params m;
  struct ball_pass at;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  ball_params_init(&m, &c, s->params);
  ball_pass_make(&at, &c, &m, s->x[0], s->x[1], s->up);
  return dyn_orbit_judge(o, &c, &m, &at, s->max_steps);
}

static struct orbit_source source_of(struct solution *s) {
  return (struct orbit_source){s, solve, describe, judge};
}

int dyn_orbit_near(struct dyn_orbit *o, truth *first, const fmpq *params, struct dyn_place at, slong prec,
                   const struct dyn_limits *lim) {
  OWNED(solution) s = {.params = params, .max_steps = lim ? lim->max_steps : dyn_limits_default.max_steps};
  *o = (struct dyn_orbit){.grazing = false};
  truth proved = TRUTH_UNKNOWN;
  long raises = 0;
  const struct orbit_source source = source_of(&s);
  solution_at(&s, at);
  slong work = orbit_planned_bits(&source, prec);
  solution_at(&s, at);
  int status = solve(&s, work);
  if (!status) status = orbit_finish(o, &proved, &raises, &source, work, prec);
  if (first) *first = proved;
  return status;
}

/* --- The list. --- */

struct solutions {
  struct solution *s;
  size_t n, cap;
};

/* Takes sol over, unless it is there already. */
static void add_solution(struct solutions *list, struct solution *sol) {
  for (size_t i = 0; i < list->n; i++) {
    const struct solution *s = &list->s[i];
    if (s->up != sol->up || !krawczyk_same(s->x, s->box, sol->x, sol->box, 2)) continue;
    solution_clear(sol);
    return;
  }
  *SS_PUSH(list->s, list->n, list->cap) = *sol;
}

int dyn_orbits_by_z10(const void *x, const void *y) {
  const struct dyn_orbit *a = x, *b = y;
  return arf_cmp(arb_midref(a->z10), arb_midref(b->z10));
}

/* Whether chi is so near to 1 that the double beside it lies at another distance from 1. */
static bool chi_is_lost(const fmpq *params) {
  NUMBERS(fmpq, gap);
  fmpq_one(gap);
  fmpq_sub(gap, gap, params + P_CHI);
  return 2 * fmpq_get_d(gap) < 1 - fmpq_get_d(params + P_CHI);
}

int dyn_orbits_find(struct dyn_orbits *list, const fmpq *params, slong prec, const struct dyn_limits *lim) {
  OWNED(search) search = {.zeros = NULL};
  struct solutions found = {NULL, 0, 0};
  double p[N_PARAMS];
  *list = (struct dyn_orbits){.n = 0};
  if (!lim) lim = &dyn_limits_default;
  if (!dyn_in_domain(params, N_PARAMS)) return SS_DOMAIN;
  for (int i = 0; i < N_PARAMS; i++) p[i] = fmpq_get_d(params + i);
  /* in the domain, but not in that of double precision */
  if (chi_is_lost(params) || search_run(&search, p, true, false, lim)) return SS_UNABLE;
  list->evaluations = search.evaluations;

  int status = search.cut ? SS_UNABLE : SS_OK;
  for (size_t i = 0; i < search.n; i++) {
    const struct solution none = {.params = params, .max_steps = lim->max_steps};
    struct solution pair[2] = {none, none};
    int n = 0;
    const struct zero *z = &search.zeros[i];
    const struct orbit_source pilot = source_of(&pair[0]);
    solution_at(&pair[0], z->at);
    slong work = orbit_planned_bits(&pilot, prec);
    status |= resolve(pair, &n, params, z, work);
    for (int k = 0; k < n; k++) add_solution(&found, &pair[k]);
    list->bits = FLINT_MAX(list->bits, n > 0 ? work : 0);
    for (int k = n; k < 2; k++) solution_clear(&pair[k]);
  }
  list->orbit = ss_malloc((found.n + 1) * sizeof *list->orbit);
  for (size_t i = 0; i < found.n; i++) {
    const struct orbit_source source = source_of(&found.s[i]);
    slong before = list->n;
    status |= orbit_list_add(list, &source, found.s[i].prec, prec);
    if (list->n > before) list->orbit[before].grazing |= found.s[i].grazing;
    solution_clear(&found.s[i]);
  }
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, dyn_orbits_by_z10);
  free(found.s);
  return status;
}

void dyn_orbits_clear(struct dyn_orbits *list) {
  for (slong i = 0; i < list->n; i++) dyn_orbit_clear(&list->orbit[i]);
  free(list->orbit);
  *list = (struct dyn_orbits){.n = 0};
}
