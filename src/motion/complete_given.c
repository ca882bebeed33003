/* Complete lists where two other quantities than e1, e2 are given.

   With t_b and t_c given all of p, q, r at the end of phase H and r_0 are linear in e1 and e2: p = 0 is a line, on
   which r^2 + q^2/omega^2 = r_0^2 is a quadratic equation.  Its two roots are all there is.  With t_b and one of e1, e2
   the zeros along t_c are enclosed by line.c. */
#include <math.h>

#include "complete.h"
#include "given.h"
#include "line.h"
#include "map_balls.h"
#include "orbit_judge.h"
#include "warm.h"

/* p, q, r, r_0 as x[0] + x[1] e1 + x[2] e2. */
struct plane {
  val x[3];
};
enum { OF_P, OF_Q, OF_R, OF_R0, N_OF };

static void planes_at(struct plane of[N_OF], struct calc *c, const fmpq *model, val tb, val tc) {
  val at[3][N_OF];
  for (int i = 0; i < 3; i++) {
    struct ball_params m;
    struct ball_pass s;
    ball_params_with(&m, c, model, calc_d(c, i == 1), calc_d(c, i == 2));
    ball_pass_make(&s, c, &m, tb, tc, true);
    const val all[N_OF] = {s.pc, s.qc, s.rc, s.r};
    for (int k = 0; k < N_OF; k++) at[i][k] = all[k];
  }
  for (int k = 0; k < N_OF; k++) {
    of[k].x[0] = at[0][k];
    for (int i = 1; i < 3; i++) of[k].x[i] = calc_sub(c, at[i][k], at[0][k]);
  }
}

/* The pairs (e1, e2), at most two, as balls; -1 when their number cannot be told. */
static int solve_planes(val e[2][2], struct calc *c, const struct plane of[N_OF], val stiff) {
  int u = arb_is_positive((arb_srcptr)calc_sub(c, calc_abs(c, of[OF_P].x[2]), calc_abs(c, of[OF_P].x[1]))) ? 1 : 2;
  int v = 3 - u;
  val zero = calc_d(c, 0), a = zero, b = zero, d = zero;
  if (!calc_lt(c, zero, calc_abs(c, of[OF_P].x[v]))) return -1;
  /* the other one: from + by u */
  val from = calc_neg(c, calc_div(c, of[OF_P].x[0], of[OF_P].x[v]));
  val by = calc_neg(c, calc_div(c, of[OF_P].x[u], of[OF_P].x[v]));
  for (int k = OF_Q; k < N_OF; k++) {
    val start = calc_add(c, of[k].x[0], calc_mul(c, of[k].x[v], from));
    val slope = calc_add(c, of[k].x[u], calc_mul(c, of[k].x[v], by));
    val weight = k == OF_Q ? calc_div(c, calc_d(c, 1), stiff) : calc_d(c, k == OF_R0 ? -1 : 1);
    a = calc_add(c, a, calc_mul(c, weight, calc_mul(c, slope, slope)));
    b = calc_add(c, b, calc_mul(c, weight, calc_mul(c, slope, start)));
    d = calc_add(c, d, calc_mul(c, weight, calc_mul(c, start, start)));
  }
  val square = calc_sub(c, calc_mul(c, b, b), calc_mul(c, a, d));
  if (calc_lt(c, square, zero)) return 0;
  if (!calc_lt(c, zero, square) || !calc_lt(c, zero, calc_abs(c, a))) return -1;
  for (int i = 0; i < 2; i++) {
    val root = calc_sqrt(c, square);
    e[i][u - 1] = calc_div(c, calc_sub(c, i == 0 ? root : calc_neg(c, root), b), a);
    e[i][v - 1] = calc_add(c, from, calc_mul(c, by, e[i][u - 1]));
  }
  return c->status ? -1 : 2;
}

static bool is_listed(const struct dyn_orbits *list, const val e[2]) {
  for (slong i = 0; i < list->n; i++)
    if (arb_overlaps(list->orbit[i].e1, (arb_srcptr)e[0]) && arb_overlaps(list->orbit[i].e2, (arb_srcptr)e[1]))
      return true;
  return false;
}

/* Whether the pair belongs to an orbit: e1 and e2 positive, first events, r_0 of the sign of q. */
static truth is_orbit(struct calc *c, const fmpq *model, const val e[2], val tb, val tc) {
  struct ball_params m;
  ball_params_with(&m, c, model, e[0], e[1]);
  truth positive = truth_and(num_arb.lt(m.zero, e[0]), num_arb.lt(m.zero, e[1]));
  if (positive == TRUTH_FALSE) return TRUTH_FALSE;
  struct ball_pass s;
  ball_pass_slip(&s, c, &m, tb, tc);
  truth sign = num_arb.lt(m.zero, s.r);
  if (sign == TRUTH_UNKNOWN) return TRUTH_UNKNOWN;
  ball_pass_turn(&s, c, &m, sign == TRUTH_TRUE);
  OWNED(dyn_orbit) o = {.grazing = false};
  truth first = dyn_orbit_judge(&o, c, &m, &s, dyn_given_limits.max_steps);
  return truth_and(positive, first);
}

static int both_times(struct dyn_orbits *list, const fmpq *model, const fmpq *tb, const fmpq *tc, slong prec) {
  struct plane of[N_OF];
  val e[2][2];
  OWNED(calc) c = calc_begin(num_ctx_arb(2 * prec + 128));
  val b = calc_q(&c, tb), t = calc_q(&c, tc), stiff = calc_mul(&c, calc_q(&c, model), calc_q(&c, model + 1));
  planes_at(of, &c, model, b, t);
  int n = solve_planes(e, &c, of, stiff), gap = n < 0 ? GAP_DOUBLE : GAP_UNTRIED;
  for (int i = 0; i < n; i++) {
    if (is_listed(list, e[i])) continue;
    truth orbit = is_orbit(&c, model, e[i], b, t);
    if (orbit != TRUTH_FALSE) gap = orbit == TRUTH_TRUE ? GAP_CONFLICT : GAP_GRAZING;
  }
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].grazing) gap = GAP_GRAZING;
  list->gap = gap;
  list->complete = gap == GAP_UNTRIED;
  return SS_OK;
}

static bool is_at(const struct dyn_orbit *o, const struct line_zero *z) {
  struct disk t = disk_arb(o->t[2]);
  return disk_up(fabs(t.mid - z->at) + t.rad) < z->room;
}

static void ball_of(arb_ptr x, struct disk d) {
  arb_set_d(x, d.mid);
  mag_set_d(arb_radref(x), d.rad);
}

/* A zero that no orbit of the list is: not an orbit, or a gap. */
static void settle(struct dyn_orbits *list, const struct line_zero *z, const fmpq *params, int unknown,
                   const fmpq *tb) {
  OWNED(calc) c = calc_begin(num_ctx_arb(128));
  val e[2];
  arb_ptr tc = calc_new(&c), x = calc_new(&c), b = calc_new(&c);
  ball_of(tc, (struct disk){z->at, z->near});
  ball_of(x, z->e);
  arb_set_fmpq(b, tb, 128);
  for (int i = 0; i < 2; i++) e[i] = unknown == P_E1 + i ? x : calc_q(&c, params + P_E1 + i);
  truth orbit = is_orbit(&c, params, e, b, tc);
  if (orbit != TRUTH_FALSE)
    dyn_leave_gap(list, orbit == TRUTH_TRUE ? GAP_CONFLICT : GAP_GRAZING, fmpq_get_d(tb), z->at);
}

static int time_and_limit(struct dyn_orbits *list, const fmpq *params, int unknown, const fmpq *tb) {
  const struct dyn_limits *lim = &dyn_given_limits;
  OWNED(line) line;
  list->gap = GAP_UNTRIED;
  if (!line_run(&line, params, unknown, tb, lim->t_max, DYN_CELLS)) dyn_leave_gap(list, GAP_RANGE, 0, 0);
  if (line.spent) dyn_leave_gap(list, GAP_BUDGET, 0, 0);
  if (line.stuck) dyn_leave_gap(list, GAP_DOUBLE, fmpq_get_d(tb), line.where);
  for (size_t k = 0; k < line.n; k++) {
    bool listed = false;
    for (slong i = 0; i < list->n; i++) listed = listed || is_at(&list->orbit[i], &line.zeros[k]);
    if (!listed && line.zeros[k].at - line.zeros[k].near <= lim->t_max)
      settle(list, &line.zeros[k], params, unknown, tb);
  }
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].grazing) dyn_leave_gap(list, GAP_GRAZING, list->orbit[i].guess[1], list->orbit[i].guess[2]);
  list->cells = line.cells;
  list->t_c_max = lim->t_max;
  list->complete = list->gap == GAP_UNTRIED;
  return SS_OK;
}

int dyn_given_complete(struct dyn_orbits *list, const fmpq *model, const enum dyn_quantity which[2], const fmpq *value,
                       slong prec) {
  fmpq params[N_PARAMS] = {model[0], model[1], model[2]}; /* all borrowed */
  int at[N_QUANTITIES];
  for (int i = 0; i < N_QUANTITIES; i++) {
    at[i] = which[0] == (enum dyn_quantity)i ? 0 : which[1] == (enum dyn_quantity)i ? 1 : -1;
    if (i <= QUANTITY_E2 && at[i] >= 0) params[P_E1 + i] = value[at[i]];
  }
  bool e1 = at[QUANTITY_E1] >= 0, e2 = at[QUANTITY_E2] >= 0;
  list->complete = false;
  if (e1 && e2) return dyn_orbits_complete(list, params, prec, DYN_CELLS);
  const fmpq *tb = at[QUANTITY_TB] >= 0 ? value + at[QUANTITY_TB] : NULL;
  if (tb && at[QUANTITY_TC] >= 0) return both_times(list, model, tb, value + at[QUANTITY_TC], prec);
  if (tb && (e1 || e2)) return time_and_limit(list, params, e1 ? P_E2 : P_E1, tb);
  list->gap = GAP_GIVEN;
  return SS_OK;
}
