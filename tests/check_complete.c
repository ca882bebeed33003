/* Completeness of lists of orbits.

   The sets and their orbits come from tests/oracle/orbits.tsv (two searches and mpmath, independent of this program).
   What the exclusion rests on is held against the motion by dyn_flow: bounds of derivatives must hold and be nearly
   attained, and no cell that contains an orbit may be excluded.  Fixed points of the return map in double precision, on
   a fine grid, must all be in the list. */
#include "every.h"
#include "known_orbits.h"
#include "motion/cell.h"
#include "motion/complete.h"
#include "motion/given.h"
#include "motion/line.h"
#include "motion/strip.h"
#include "motion/turns.h"
#include "num/pi.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

/* t_b and t_c of the set's i-th orbit. */
static double known_time(const struct known_set *s, int i, int k) {
  return strtod(s->orbit[i][KNOWN_TB + k], NULL);
}

static void check_list(const struct dyn_orbits *list, const struct known_set *s) {
  ck_assert_msg(list->complete, "%s: %s, near t_b %g t_c %g", s->name, dyn_gap_text[list->gap], list->gap_at[0],
                list->gap_at[1]);
  ck_assert_msg(list->n == s->n, "%s: %ld orbits, not %d", s->name, (long)list->n, s->n);
  for (int i = 0; i < s->n; i++)
    for (int k = 0; k < 2; k++) {
      double is = list->orbit[i].guess[1 + k], want = known_time(s, i, k);
      ck_assert_msg(fabs(is - want) < 1e-11 * want, "%s orbit %d: %.17g, %.17g", s->name, i, is, want);
    }
}

/* The list that the search leaves is complete, and whatever is taken out of it comes back. */
TEST_EACH(every_set_is_complete, KNOWN_SETS) {
  const struct known_set *s = known_set(_i);
  for (int keep = -1; keep <= s->n; keep++) {
    OWNED(dyn_orbits) list = {.n = 0};
    if (keep >= 0) list = orbits_of(s->params, 100);
    ck_assert(!list.complete && (keep < 0 || list.gap == GAP_UNTRIED));
    if (keep >= 0 && keep < s->n) {
      OWNED(dyn_orbits) one = {.orbit = malloc(sizeof *one.orbit), .n = 1};
      one.orbit[0] = list.orbit[keep];
      for (slong i = keep; i + 1 < list.n; i++) list.orbit[i] = list.orbit[i + 1];
      list.n--;
    }
    ck_assert_int_eq(dyn_orbits_complete(&list, s->params, 100, DYN_CELLS), SS_OK);
    check_list(&list, s);
    ck_assert_msg(keep < s->n || list.cells < 20000, "%s: %ld cells", s->name, list.cells);
    for (slong i = 0; i < list.n; i++) ck_assert(arb_rel_accuracy_bits(list.orbit[i].t[1]) >= 100);
  }
}

/* Phase H lasts through 22 turns of its slow mode, and far more nearby: all steps of the search but those that the
   later rises need go to the first one.  The times are a solution by tests/oracle/orbits.py at 60 digits. */
TEST(a_late_event_is_found) {
  static const char *const row[N_PARAMS] = {"0.07", "2.19", "4.82", "0.0434", "0.00891"};
  FREED_PARAMS fmpq *p = rationals(row, N_PARAMS);
  OWNED(dyn_orbits) list;
  dyn_orbits_find(&list, p, 60, NULL);
  ck_assert_int_eq(list.n, 1);
  ck_assert_double_eq_tol(list.orbit[0].guess[1], 0.68055835521538336586, 1e-13);
  ck_assert_double_eq_tol(list.orbit[0].guess[2], 367.71375338769858034, 1e-10);
}

/* Phase H repeats itself where its frequencies are exactly 2 : 1, and the sum of their amplitudes, above V, is never
   reached; that there is no orbit is also what tests/oracle/scan.py finds.  The last row misses the first by 1e-15. */
TEST(a_motion_that_repeats_itself) {
  static const struct {
    const char *p[N_PARAMS];
    bool complete;
  } row[] = {{{"9/25", "25/9", "1", "1.3", "0.4"}, true},
             {{"44/125", "25/11", "1", "0.8", "0.3"}, true},
             {{"9/25", "2.777777777777777", "1", "1.3", "0.4"}, false}};
  for (size_t k = 0; k < COUNT(row); k++) {
    OWNED(dyn_orbits) list = {.n = 0};
    FREED_PARAMS fmpq *p = rationals(row[k].p, N_PARAMS);
    ck_assert_int_eq(dyn_orbits_complete(&list, p, 60, DYN_CELLS / 10), SS_OK);
    ck_assert_msg(list.complete == row[k].complete && list.n == 0, "row %zu: %s, %ld orbits", k, dyn_gap_text[list.gap],
                  (long)list.n);
  }
}

TEST(a_small_budget_is_said) {
  const struct known_set *s = known_set_named("paper");
  for (long budget = 0; budget < 400; budget += 100) {
    OWNED(dyn_orbits) list = orbits_of(s->params, 60);
    ck_assert_int_eq(dyn_orbits_complete(&list, s->params, 60, budget), SS_OK);
    ck_assert(!list.complete && list.gap == GAP_BUDGET && list.n == 2);
    ck_assert_int_le(list.cells, budget + 200); /* each strip that is left notices for itself */
  }
}

TABLE(hopeless, "tests/cases/complete_hopeless.tsv", N_PARAMS + 1);

TEST_EACH(hopeless_parameters_are_said, hopeless.n) {
  bool outside = is_yes(hopeless.row[_i][N_PARAMS]);
  OWNED(dyn_orbits) list = {.n = 0};
  FREED_PARAMS fmpq *p = rationals((const char *const *)hopeless.row[_i], N_PARAMS);
  ck_assert_int_eq(dyn_orbits_complete(&list, p, 60, 1000000), outside ? SS_DOMAIN : SS_OK);
  ck_assert_msg(!list.complete && list.gap == (outside ? 0 : GAP_RANGE), "%s", dyn_gap_text[list.gap]);
}

/* --- What the exclusion rests on. --- */

TEST_EACH(disks_hold_what_balls_say, 3) {
  struct rng rng = {(uint64_t)_i + 1};
  NUMBERS(arb, y, exact);
  BALLS(2, x);
  for (int trial = 0; trial < 20000; trial++) {
    struct disk d[2], out[4];
    for (int i = 0; i < 2; i++) {
      d[i].mid = ldexp(rng_unit(&rng) - 0.5, (int)(40 * (rng_unit(&rng) - 0.5)));
      d[i].rad = rng_unit(&rng) < 0.3 ? 0 : ldexp(rng_unit(&rng), (int)(60 * (rng_unit(&rng) - 0.8)));
      /* a point of the disk */
      arb_set_d(x + i, d[i].rad * (trial % 3 - 1));
      arb_set_d(y, d[i].mid);
      arb_add(x + i, x + i, y, 400);
    }
    out[0] = disk_add(d[0], d[1]);
    out[1] = disk_sub(d[0], d[1]);
    out[2] = disk_mul(d[0], d[1]);
    out[3] = disk_sqrt(d[0]);
    for (int k = 0; k < 4; k++) {
      if (k == 3 && arb_is_negative(x)) continue;
      if (k == 0) arb_add(exact, x, x + 1, 400);
      if (k == 1) arb_sub(exact, x, x + 1, 400);
      if (k == 2) arb_mul(exact, x, x + 1, 400);
      if (k == 3) arb_sqrt(exact, x, 400);
      arb_set_d(y, out[k].mid);
      arb_sub(exact, exact, y, 400);
      arb_abs(exact, exact);
      arb_set_d(y, out[k].rad);
      ck_assert_msg(arb_le(exact, y), "operation %d: %a +- %a, %a +- %a gives %a +- %a", k, d[0].mid, d[0].rad,
                    d[1].mid, d[1].rad, out[k].mid, out[k].rad);
    }
  }
}

/* p, q, r at (angle, t) and their derivatives of the given order by the angle, by dyn_flow: the motion with velocities
   (v1, v2) and forces w, chi r at its start is linear. */
static void motion(double out[4], const double p[N_PARAMS], double angle, double t, int order) {
  double a = (1 - p[P_CHI]) * p[P_V], u = a * cos(angle) - p[P_E1] * sin(angle),
         w = p[P_E1] * cos(angle) + a * sin(angle);
  double sign = order >= 2 ? -1 : 1, ease = 1 - p[P_CHI];
  double v1 = order == 1 ? -w : sign * u, force = order == 1 ? u : sign * w, r = 0, v2 = 0;
  if (order == 0) {
    v1 += p[P_V] - a;
    v2 = p[P_V];
    r = p[P_E2] / p[P_CHI];
  }
  double z[N_STATE] = {(force + p[P_CHI] * r) / ease, (force + r) / ease, v1, v2};
  struct num_vec pv = {num_ctx_double(), N_PARAMS, (char *)(void *)(double[N_PARAMS]){p[0], p[1], p[2], p[3], p[4]}};
  struct num_vec zv = {num_ctx_double(), N_STATE, (char *)(void *)z};
  ck_assert_int_eq(dyn_flow(&zv, PHASE_H, &pv, &zv, &t), SS_OK);
  out[0] = z[DZ_1] - (order == 0 ? p[P_V] : 0);
  out[1] = z[DZ_2] - (order == 0 ? p[P_V] : 0);
  out[2] = z[Z_2] - z[Z_1];
  out[3] = z[Z_1] - p[P_CHI] * z[Z_2];
}

TEST_EVERY(bounds_hold_and_are_nearly_attained, 6, KNOWN_SETS) {
  struct rng rng = {(uint64_t)_i + 1};
  const struct known_set *s = known_set(_i);
  const double *p = s->value;
  double most[8] = {0};
  OWNED(disk_params) g;
  struct strip strip;
  ck_assert(disk_params_init(&g, s->params));
  double angle = g.fall.mid * rng_unit(&rng), reach = 1e-3;
  strip_make(&strip, &g, angle, angle, reach);
  /* the third derivative by the angle is minus the first */
  const double bound[8] = {strip.p.fff, strip.p.ff, strip.q.fff, strip.q.ff,
                           strip.r.fff, strip.r.ff, strip.p.ft,  strip.p.tt};
  for (int trial = 0; trial < 4000; trial++) {
    double f[4], ff[4], none[4], x = angle + reach * (2 * rng_unit(&rng) - 1), t = 4000 * rng_unit(&rng) / g.om[0].mid;
    motion(none, p, x, t, 0);
    motion(f, p, x, t, 1);
    motion(ff, p, x, t, 2);
    /* p_t = -w; p_tt = -w' = -(z_1' - chi z_2') */
    double now[8] = {f[0], ff[0], f[1], ff[1], f[2], ff[2], f[3], none[0] + p[P_V] - p[P_CHI] * (none[1] + p[P_V])};
    for (int i = 0; i < 8; i++) most[i] = fmax(most[i], fabs(now[i]));
  }
  for (int i = 0; i < 8; i++) {
    ck_assert_msg(most[i] <= bound[i] * (1 + 1e-9), "%s: bound %d is %g, %g was seen", s->name, i, bound[i], most[i]);
    ck_assert_msg(most[i] > 0.7 * bound[i], "%s: bound %d is %g, no more than %g was seen", s->name, i, bound[i],
                  most[i]);
  }
}

TEST_EVERY(cells_move_as_the_flow_does, 6, KNOWN_SETS) {
  struct rng rng = {(uint64_t)_i + 100};
  const struct known_set *s = known_set(_i);
  const double *p = s->value;
  OWNED(disk_params) g;
  ck_assert(disk_params_init(&g, s->params));
  for (int trial = 0; trial < 200; trial++) {
    struct strip strip;
    struct clock clock, step, both;
    struct cell c;
    double angle = g.fall.mid * rng_unit(&rng), t = floor(2000 * rng_unit(&rng)) / 64, h = 3.0 / 256, now[4], by[4];
    strip_make(&strip, &g, angle, angle, 0);
    clock_set(&clock, &g, t);
    clock_set(&step, &g, h);
    clock_turn(&both, &clock, &step);
    ck_assert(both.t == t + h);
    cell_at(&c, &strip, &both);
    motion(now, p, angle, t + h, 0);
    motion(by, p, angle, t + h, 1);
    const struct disk got[7] = {c.p, c.q, c.r, c.w, c.pf, c.qf, c.rf};
    const double want[7] = {now[0], now[1], now[2], now[3], by[0], by[1], by[2]};
    for (int i = 0; i < 7; i++)
      ck_assert_msg(fabs(got[i].mid - want[i]) < 1e-10 * (1 + fabs(want[i])) + got[i].rad && got[i].rad < 1e-9,
                    "%s: %d is %.17g +- %g, %.17g", s->name, i, got[i].mid, got[i].rad, want[i]);
  }
}

/* What is cut off a strip has crossed. */
TEST_EVERY(only_what_has_crossed_is_cut_off, 6, KNOWN_SETS) {
  struct rng rng = {(uint64_t)_i + 20};
  const struct known_set *s = known_set(_i);
  const double *p = s->value;
  OWNED(disk_params) g;
  long cut = 0;
  ck_assert(disk_params_init(&g, s->params));
  for (int trial = 0; trial < 3000; trial++) {
    struct strip strip;
    struct clock clock;
    struct cell c;
    double half = 0.3 * rng_unit(&rng), angle = half + (g.fall.mid - 2 * half) * rng_unit(&rng), low, high, at[4];
    double t = 20 * rng_unit(&rng) / g.om[1].mid;
    strip_make(&strip, &g, angle - half, angle + half, half);
    clock_set(&clock, &g, t);
    cell_at(&c, &strip, &clock);
    bool some = cell_waiting(&low, &high, &c, 1);
    for (int i = -4; i <= 4; i++) {
      double x = 0.2499 * i * half;
      if (i == -4 && some && high < strip.half) x = high; /* where it is closest */
      if (i == 4 && some && low > -strip.half) x = low;
      if (some && x > low && x < high) continue;
      motion(at, p, angle + x, t, 0);
      cut++;
      ck_assert_msg(at[0] > -1e-12, "%s: angle %.12g %+.12g, t %.12g: p = %g", s->name, angle, x, t, at[0]);
    }
  }
  ck_assert_msg(cut > 20, "%ld", cut);
}

/* Cells of every size and place around an orbit: none may be called free of zeros, nor a strip around it. */
TEST_EVERY(no_cell_with_an_orbit_is_excluded, 6, KNOWN_SETS) {
  struct rng rng = {(uint64_t)_i + 7};
  const struct known_set *s = known_set(_i);
  OWNED(disk_params) g;
  ck_assert(disk_params_init(&g, s->params));
  long zeros = 0;
  for (int trial = 0; trial < 2000 * s->n; trial++) {
    const double at[2] = {known_time(s, trial % s->n, 0), known_time(s, trial % s->n, 1)};
    double turns = floor(at[0] / (2 * PI)), angle = at[0] - 2 * PI * turns;
    double d = ldexp(1, -1 - (int)(22 * rng_unit(&rng))), e = ldexp(1, -1 - (int)(22 * rng_unit(&rng)));
    double x = angle + 0.999 * d * (2 * rng_unit(&rng) - 1), t = at[1] + 0.999 * e * (2 * rng_unit(&rng) - 1);
    if (t - e < 0) continue;
    struct strip strip;
    struct clock clock;
    struct cell c;
    struct common zero;
    strip_make(&strip, &g, x - d, x + d, 2 * d);
    clock_set(&clock, &g, t);
    cell_at(&c, &strip, &clock);
    c.early = e;
    c.first = false;
    struct turns k = strip_turns(&strip, false);
    ck_assert(!strip_never(&strip) && (k.to[0] >= turns || k.to[1] >= turns));
    enum look seen = cell_look(&zero, &c, &k, 1);
    ck_assert_msg(seen != LOOK_CLEAR, "%s: cell %.17g +- %g, %.17g +- %g", s->name, x, d, t, e);
    ck_assert(!strip_misses(&strip, &k));
    if (seen != LOOK_ZERO) continue;
    zeros++;
    ck_assert(zero.k == turns);
    ck_assert_msg(fabs(x + zero.at[0] - angle) < zero.near[0] + 1e-11 &&
                      fabs(t + zero.at[1] - at[1]) < zero.near[1] + 1e-11,
                  "%s: zero at %.17g, %.17g", s->name, x + zero.at[0], t + zero.at[1]);
  }
  ck_assert(s->n == 0 || zeros > 50);
}

/* --- The list against the return map on a fine grid. --- */

static bool near_listed(const struct dyn_orbits *list, double low, double high) {
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].guess[1] > low - 1e-6 && list->orbit[i].guess[1] < high + 1e-6) return true;
  return false;
}

/* r at the end less the r that leads to t_b; false where t_b is no first root, or t_c is not found. */
static bool defect_at(double *defect, double *tc, const double p[N_PARAMS], double tb) {
  double t[4], a = (1 - p[P_CHI]) * p[P_V], out;
  double r = p[P_E2] / p[P_CHI] - a * (tb - sin(tb)) - p[P_E1] * (1 - cos(tb));
  if (dyn_return_map_d(&out, NULL, t, p, r) != SS_OK || fabs(t[1] - tb) > 1e-9) return false;
  *defect = out - r;
  *tc = t[2];
  return true;
}

/* Whether halving brings a change of sign of the defect down to a zero, rather than to a jump, as what is moved, t_b
   or a parameter, goes from low to high; it is left there. */
static bool closes_in(const double p[N_PARAMS], const double *tb, double *moved, double low, double high,
                      double at_low) {
  double defect = at_low, tc;
  for (int i = 0; i < 40; i++) {
    *moved = 0.5 * (low + high);
    if (!defect_at(&defect, &tc, p, *tb)) return false;
    *((defect > 0) == (at_low > 0) ? &low : &high) = *moved;
  }
  return fabs(defect) < 1e-7;
}

/* Changes of sign of the defect on a grid of n steps that are zeros: all in the list. */
static long fixed_points(const struct dyn_orbits *list, const double p[N_PARAMS], int n) {
  double last = 40, before = 0, old = 0, defect, tc;
  bool valid = false;
  long seen = 0;
  for (int i = 1; i <= n; i++) {
    double tb = last * i / n;
    bool now = defect_at(&defect, &tc, p, tb);
    double near = tb;
    if (now && valid && old * defect <= 0 && closes_in(p, &near, &near, before, tb, old)) {
      seen++;
      ck_assert_msg(near_listed(list, before, tb), "%s: t_b near %.12g, t_c %.12g", params_shown(p), tb, tc);
    }
    valid = now;
    old = defect;
    before = tb;
  }
  return seen;
}

TEST_EVERY(the_return_map_has_no_other_fixed_point, 6, KNOWN_SETS) {
  const struct known_set *s = known_set(_i);
  const double *p = s->value;
  OWNED(dyn_orbits) list = {.n = 0};
  ck_assert_int_eq(dyn_orbits_complete(&list, s->params, 60, DYN_CELLS), SS_OK);
  ck_assert(list.complete);
  long seen = fixed_points(&list, p, 6000);
  ck_assert_msg(seen <= s->n, "%s: %ld", s->name, seen);
}

TEST_EVERY(random_parameters, 2, 2) {
  struct rng rng = {(uint64_t)_i + 1};
  long complete = 0, seen = 0, orbits = 0;
  enum { TRIALS = 100 };
  for (int trial = 0; trial < TRIALS; trial++) {
    double p[N_PARAMS] = {0.03 + 0.94 * rng_unit(&rng), 0.05 * pow(400, rng_unit(&rng)), 0.2 * pow(15, rng_unit(&rng)),
                          0.2 * pow(30, rng_unit(&rng)), 0.05 * pow(100, rng_unit(&rng))};
    for (int i = 0; i < N_PARAMS; i++) p[i] = floor(p[i] * 4096 + 1) / 4096;
    FREED_PARAMS fmpq *q = rationals_d(p, N_PARAMS);
    OWNED(dyn_orbits) empty = {.n = 0}, list;
    dyn_orbits_find(&list, q, 60, NULL);
    slong found = list.n;
    ck_assert_int_eq(dyn_orbits_complete(&list, q, 60, DYN_CELLS / 4), SS_OK);
    ck_assert_int_eq(dyn_orbits_complete(&empty, q, 60, DYN_CELLS / 4), SS_OK);
    if (list.complete) {
      complete++;
      orbits += list.n;
      ck_assert_msg(empty.n == list.n && empty.complete, "%s: %ld, %ld", params_shown(p), (long)list.n, (long)empty.n);
      ck_assert(list.n >= found);
      if (trial % 10 == 0) seen += fixed_points(&list, p, 4000);
    }
  }
  ck_assert_msg(complete > TRIALS - 3 && seen > 5 && orbits > TRIALS, "%ld complete, %ld seen, %ld orbits", complete,
                seen, orbits);
}

/* --- Hard places. --- */

/* Two orbits of the set "fold" meet between e2 = 2.72 and 2.75.  On the way there a list is complete with both orbits
   or with none; it says that a double zero may be there once they are too close; it is never complete with one. */
TEST(near_a_fold) {
  FREED_PARAMS fmpq *p = rationals_of(known_set_named("fold")->params, N_PARAMS);
  NUMBERS(fmpq, two, none);
  int resolved = 0, doubtful = 0;
  double gap = 1;
  fmpq_set_si(two, 272, 100);
  fmpq_set_si(none, 275, 100);
  for (int step = 0; step < 64; step++) {
    OWNED(dyn_orbits) list, empty = {.n = 0};
    fmpq_add(p + P_E2, two, none);
    fmpq_div_2exp(p + P_E2, p + P_E2, 1);
    list = orbits_of(p, 60);
    slong n = list.n;
    ck_assert(n == 0 || n == 2);
    dyn_orbits_complete(&list, p, 60, DYN_CELLS);
    dyn_orbits_complete(&empty, p, 60, DYN_CELLS);
    ck_assert_int_eq(list.n, n);
    if (empty.complete) ck_assert_int_eq(empty.n, n);
    if (!list.complete) ck_assert_int_eq(list.gap, GAP_DOUBLE);
    if (n == 2) {
      const struct dyn_orbit *a = &list.orbit[0], *b = &list.orbit[1];
      ck_assert(!arb_overlaps(a->t[1], b->t[1]) && a->stable != b->stable && a->stable != TRUTH_UNKNOWN);
      gap = fabs(a->guess[1] - b->guess[1]);
      /* that there is no third one is proved however close they are, as long as disks can tell them apart */
      if (gap > 1e-6) ck_assert(list.complete);
    }
    if (step < 12) ck_assert(list.complete);
    resolved += list.complete;
    doubtful += !list.complete;
    ck_assert_int_le(list.cells, 200000);
    fmpq_set(n == 2 ? two : none, p + P_E2);
  }
  ck_assert_msg(resolved > 25 && doubtful > 5 && gap < 1e-8, "%d, %d, %g", resolved, doubtful, gap);
}

/* t_b at the crest of the rise: p starts phase H at zero and rises, and its first root is where it falls through
   zero. */
static double crest_defect(const double p[N_PARAMS]) {
  double a = (1 - p[P_CHI]) * p[P_V], fall = PI + 2 * atan2(a, p[P_E1]), at[4], low = 0, high = 0;
  double r0 = p[P_E2] / p[P_CHI] - a * (fall - sin(fall)) - p[P_E1] * (1 - cos(fall));
  do {
    low = high;
    high += 0.02;
    motion(at, p, fall, high, 0);
  } while (at[0] > 0);
  for (int i = 0; i < 50; i++) {
    double mid = 0.5 * (low + high);
    motion(at, p, fall, mid, 0);
    *(at[0] > 0 ? &low : &high) = mid;
  }
  return (at[1] > 0 ? 1 : -1) * hypot(at[2], at[1] / sqrt(p[P_CHI] * p[P_ETA])) - r0;
}

TEST(at_the_crest) {
  int met = 0;
  for (int i = 0; i < 10; i += every(2)) {
    double p[N_PARAMS], low = 0, high = 0, before = 0;
    memcpy(p, known_set(i)->value, sizeof p);
    for (p[P_E2] = 0.05; p[P_E2] < 8 && low == 0; p[P_E2] += 0.1) {
      double now = crest_defect(p);
      if (before * now < 0 && fabs(before - now) < 1) {
        low = p[P_E2] - 0.1;
        high = p[P_E2];
      }
      before = now;
    }
    if (low == 0) continue;
    p[P_E2] = low;
    double sign = crest_defect(p);
    for (int k = 0; k < 52; k++) {
      p[P_E2] = 0.5 * (low + high);
      *(crest_defect(p) * sign > 0 ? &low : &high) = p[P_E2];
    }
    if (fabs(crest_defect(p)) > 1e-9) continue;
    met++;
    FREED_PARAMS fmpq *q = rationals_of(known_set(i)->params, N_PARAMS);
    for (int near = -1; near <= 1; near++) { /* the very place, and beside it */
      num_q_set_d(q + P_E2, p[P_E2] * (1 + 1e-3 * near));
      for (int found = 0; found < 2; found++) { /* by the pilot, or by the complete search itself */
        OWNED(dyn_orbits) list = {0};
        if (found) dyn_orbits_find(&list, q, 60, NULL);
        dyn_orbits_complete(&list, q, 60, DYN_CELLS);
        ck_assert_msg(list.complete == (near != 0) && (near || list.gap == GAP_GRAZING), "%s, e2 %.15g, %d: %d, %s",
                      known_set(i)->name, p[P_E2], found, list.complete, dyn_gap_text[list.gap]);
      }
    }
  }
  ck_assert_msg(met > 2 / every(2), "%d", met);
}

/* A strip that the free phases leave out has no zero at any time: its motion, looked at for long, keeps away. */
TEST_EVERY(free_phases_leave_out_no_zero, 6, KNOWN_SETS) {
  struct rng rng = {(uint64_t)_i + 3};
  const struct known_set *s = known_set(_i);
  const double *p = s->value;
  double a, omega;
  OWNED(disk_params) g;
  long left_out = 0, crossings = 0;
  a = (1 - p[P_CHI]) * p[P_V];
  omega = sqrt(p[P_CHI] * p[P_ETA]);
  ck_assert(disk_params_init(&g, s->params));
  for (int trial = 0; trial < 30; trial++) {
    struct strip strip;
    double half = 1e-4, angle = half + (g.fall.mid - 2 * half) * rng_unit(&rng), old[4], now[4];
    strip_make(&strip, &g, angle - half, angle + half, half);
    struct turns k = strip_turns(&strip, false);
    if (!strip_never(&strip) && !strip_misses(&strip, &k)) continue;
    left_out++;
    double r0 = p[P_E2] / p[P_CHI] - a * (angle - sin(angle)) - p[P_E1] * (1 - cos(angle));
    motion(old, p, angle, 0, 0);
    for (int i = 1; i < 600; i++) {
      motion(now, p, angle, 0.05 * i / g.om[1].mid, 0);
      if (old[0] * now[0] < 0) {
        double x = old[0] / (old[0] - now[0]), q = old[1] + x * (now[1] - old[1]), r = old[2] + x * (now[2] - old[2]);
        double end = (q > 0 ? 1 : -1) * hypot(r, q / omega), turns = (r0 - end) / g.turn.mid;
        bool fits = fabs(turns - round(turns)) * g.turn.mid < 1e-4 && turns > -0.5 && (strip.later || turns < 0.5);
        ck_assert_msg(!strip_never(&strip) && !fits, "%s: t_b %.12g, t %.8g", s->name, angle, 0.05 * i / g.om[1].mid);
        crossings++;
      }
      memcpy(old, now, sizeof old);
    }
  }
  ck_assert(strcmp(s->name, "paper") != 0 || (left_out > 5 && crossings > 20));
}

/* --- t_b and t_c given. --- */

TEST_EACH(times_given, 2) {
  static const enum dyn_quantity which[2] = {QUANTITY_TC, QUANTITY_TB};
  struct rng rng = {(uint64_t)_i + 1};
  long none = 0, some = 0;
  RATIONALS(model, 3, _fmpq_vec_init(3));
  RATIONALS(value, 2, _fmpq_vec_init(2));
  for (int trial = 0; trial < 100; trial++) {
    OWNED(dyn_orbits) list;
    fmpq_set_si(model, 1 + (slong)(62 * rng_unit(&rng)), 64);
    fmpq_set_si(model + 1, 2 + (slong)(100 * rng_unit(&rng)), 16);
    fmpq_set_si(model + 2, 1 + (slong)(8 * rng_unit(&rng)), 4);
    for (int i = 0; i < 2; i++) fmpq_set_si(value + i, 1 + (slong)(400 * rng_unit(&rng)), 64);
    for (int i = 0; i < 3; i++) fmpq_canonicalise(model + i);
    for (int i = 0; i < 2; i++) fmpq_canonicalise(value + i);
    dyn_orbits_given(&list, model, which, value, 80, NULL);
    ck_assert_int_eq(dyn_given_complete(&list, model, which, value, 80), SS_OK);
    ck_assert_msg(list.complete && list.t_c_max == 0, "trial %d: %s", trial, dyn_gap_text[list.gap]);
    *(list.n > 0 ? &some : &none) += 1;
    slong n = list.n; /* a list that lacks them is not complete */
    struct dyn_orbits empty = {.n = 0};
    dyn_given_complete(&empty, model, which, value, 80);
    ck_assert(empty.complete == (n == 0) && (n == 0 || empty.gap == GAP_CONFLICT));
  }
  ck_assert(some > 3 && none > 3);
}

/* --- t_b and e1 or e2 given. --- */

/* The orbits of every set: t_b cut to a fraction leaves the rest where it is, nearly. */
TEST_EVERY(a_time_and_a_limit_given, 6, KNOWN_SETS) {
  const struct known_set *s = known_set(_i);
  for (int i = 0; i < s->n; i++)
    for (int e = 0; e < 2; e++) {
      const enum dyn_quantity which[2] = {QUANTITY_TB, e == 0 ? QUANTITY_E1 : QUANTITY_E2};
      struct dyn_orbits list;
      bool met = false;
      const double tb = known_time(s, i, 0), tc = known_time(s, i, 1);
      if (tb > 60) continue;
      RATIONALS(value, 2, _fmpq_vec_init(2));
      fmpq_set_si(value, (slong)(tb * 1e12), 1000000000000);
      fmpq_canonicalise(value);
      fmpq_set(value + 1, s->params + P_E1 + e);
      dyn_orbits_given(&list, s->params, which, value, 60, NULL);
      ck_assert_int_eq(dyn_given_complete(&list, s->params, which, value, 60), SS_OK);
      ck_assert_msg(list.complete && list.t_c_max == 200, "%s orbit %d, e%d: %s near %g", s->name, i, e + 1,
                    dyn_gap_text[list.gap], list.gap_at[1]);
      for (slong k = 0; k < list.n; k++) met = met || fabs(list.orbit[k].guess[2] - tc) < 1e-5 * tc;
      ck_assert_msg(met, "%s orbit %d, e%d", s->name, i, e + 1);
      /* each is where a zero is enclosed */
      OWNED(line) line;
      ck_assert(line_run(&line, s->params, P_E2 - e, value, 100, DYN_CELLS) && !line.spent && !line.stuck);
      for (slong k = 0; k < list.n; k++) {
        const struct dyn_orbit *o = &list.orbit[k];
        double other = num_arb.get_d(e == 0 ? o->e2 : o->e1);
        bool enclosed = o->guess[2] > 99;
        for (size_t z = 0; z < line.n; z++)
          enclosed = enclosed || (fabs(line.zeros[z].at - o->guess[2]) < line.zeros[z].near + 1e-13 * o->guess[2] &&
                                  fabs(line.zeros[z].e.mid - other) < line.zeros[z].e.rad + 1e-13 * other);
        ck_assert_msg(enclosed, "%s, e%d: t_c %.17g", s->name, e + 1, o->guess[2]);
      }
      /* a list that lacks one is not complete */
      struct dyn_orbits empty = {.n = 0};
      dyn_given_complete(&empty, s->params, which, value, 60);
      ck_assert(!empty.complete && empty.gap == GAP_CONFLICT);
      dyn_orbits_clear(&list);
    }
}

/* Orbits along e2 at random e1, t_b, seen as changes of sign in double precision: all in the list. */
TEST_EVERY(a_limit_scanned, 2, 2) {
  static const enum dyn_quantity which[2] = {QUANTITY_E1, QUANTITY_TB};
  struct rng rng = {(uint64_t)_i + 11};
  long seen = 0, complete = 0;
  enum { TRIALS = 24, STEPS = 1500 };
  for (int trial = 0; trial < TRIALS; trial++) {
    double p[N_PARAMS] = {0.05 + 0.9 * rng_unit(&rng), 0.1 + 3 * rng_unit(&rng), 0.3 + rng_unit(&rng),
                          0.2 + 4 * rng_unit(&rng), 0};
    double tb = 0.05 + 3 * rng_unit(&rng), old = 0, defect = 0, tc = 0;
    bool valid = false;
    OWNED(dyn_orbits) list;
    tb = floor(tb * 4096) / 4096;
    for (int i = 0; i < N_PARAMS; i++) p[i] = floor(p[i] * 4096) / 4096;
    FREED_PARAMS fmpq *q = rationals_d(p, N_PARAMS);
    RATIONALS(value, 2, rationals_d((const double[]){p[P_E1], tb}, 2));
    dyn_orbits_given(&list, q, which, value, 60, NULL);
    dyn_given_complete(&list, q, which, value, 60);
    complete += list.complete;
    for (int i = 1; i < STEPS && list.complete; i++, old = defect) {
      double low = 6.0 * (i - 1) / STEPS, high = 6.0 * i / STEPS;
      p[P_E2] = high;
      bool now = defect_at(&defect, &tc, p, tb);
      bool change = now && valid && old * defect <= 0;
      valid = now;
      if (!change || !closes_in(p, &tb, &p[P_E2], low, high, old) || tc > 199) continue;
      bool listed = false;
      for (slong k = 0; k < list.n; k++) listed = listed || fabs(num_arb.get_d(list.orbit[k].e2) - p[P_E2]) < 1e-6;
      ck_assert_msg(listed, "%s: t_b %.17g, t_c %.17g", params_shown(p), tb, tc);
      seen++;
    }
  }
  ck_assert_msg(seen > TRIALS / 4 && complete > TRIALS * 9 / 10, "%ld seen, %ld complete", seen, complete);
}

TEST(other_pairs_are_said) {
  static const enum dyn_quantity which[2] = {QUANTITY_TA, QUANTITY_TD};
  RATIONALS(model, 3, rationals((const char *const[]){"1/2", "1/2", "1/2"}, 3));
  RATIONALS(value, 2, rationals((const char *const[]){"1", "1"}, 2));
  struct dyn_orbits list = {.n = 0};
  ck_assert_int_eq(dyn_given_complete(&list, model, which, value, 80), SS_OK);
  ck_assert(!list.complete && list.gap == GAP_GIVEN);
}
