/* Bifurcations along lines in parameter space.

   Values come from tests/oracle/bifurcations.tsv (mpmath, matrix exponentials, unknowns p and r).  What happens at each
   change is held against the search for orbits at single parameter values, which knows no curves: between two changes
   the number of orbits must be what the changes so far make it, on both sides of each the stability and the conditions
   that it says.  Derivatives carried by balls are held against those written out in motion/map_balls.c and against
   differences. */
#include "explore/bifurcate.h"
#include "explore/family.h"
#include "motion/dual.h"
#include "motion/map_balls.h"
#include "params.h"
#include "rational.h"
#include "test.h"

static int find(struct dyn_bifurcations *list, const struct param_line *l, slong digits) {
  const struct dyn_line line = {.params = l->params, .vary = l->vary, .from = l->from, .to = l->to};
  return dyn_bifurcations_find(list, &line, digits, 65);
}

/* --- Derivatives carried by balls --- */

static val exact(struct calc *c, double x, int direction) {
  NUMBERS(arb, b);
  arb_set_d(b, x);
  return dual_variable(c, b, direction);
}

static void pass_at(struct ball_pass *s, struct calc *c, const double x[N_DIRECTIONS], bool up) {
  struct ball_params m;
  val p[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) p[i] = exact(c, x[i], i);
  ball_params_make(&m, c, p);
  ball_pass_make(s, c, &m, exact(c, x[DIR_TB], DIR_TB), exact(c, x[DIR_TC], DIR_TC), up);
  ck_assert_int_eq(c->status, SS_OK);
}

static void same(val f, int direction, val g, const char *what) {
  ck_assert_msg(arb_overlaps(dual_slope(f, direction), dual_value(g)), "%s: %s is not %s", what,
                arb_get_str(dual_slope(f, direction), 20, 0), arb_get_str(dual_value(g), 20, 0));
  ck_assert(arb_rel_accuracy_bits(dual_slope(f, direction)) > 60);
}

static const double points[][N_DIRECTIONS] = {{0.8, 1, 1, 2.7844, 0.8587, 2.0053, 1.4898},
                                              {0.6, 2.5, 0.7, 1.2, 0.4, 1.1, 6.2},
                                              {0.25, 0.3, 3, 5, 2, 9.25, 2.5},
                                              {0.95, 4, 0.2, 0.5, 1.5, 0.75, 11.5}};

/* motion/map_balls.c writes these derivatives out. */
TEST(slopes_are_those_written_out) {
  for (int i = 0; i < COUNT(points); i++)
    for (int up = 0; up < 2; up++) {
      struct ball_pass s;
      OWNED(calc) c = calc_begin(dual_ctx(128));
      pass_at(&s, &c, points[i], up);
      same(s.pc, DIR_TB, s.pc_tb, "pc by t_b");
      same(s.pc, DIR_TC, calc_neg(&c, s.wc), "pc by t_c");
      same(s.qc, DIR_TB, s.qc_tb, "qc by t_b");
      same(s.r, DIR_TB, s.pb, "r by t_b");
      same(s.defect, DIR_TB, s.defect_tb, "defect by t_b");
      same(s.defect, DIR_TC, s.defect_tc, "defect by t_c");
    }
}

/* Along each parameter: central differences at 2^-40, whose error is about 2^-80 of the third derivative. */
TEST(slopes_along_parameters_are_differences) {
  for (int i = 0; i < COUNT(points); i++)
    for (int d = 0; d < N_PARAMS; d++) {
      struct ball_pass s, side[2];
      double h = ldexp(1, -40), x[N_DIRECTIONS];
      OWNED(calc) c = calc_begin(dual_ctx(256));
      pass_at(&s, &c, points[i], false);
      for (int k = 0; k < 2; k++) {
        struct ball_params m;
        val p[N_PARAMS];
        memcpy(x, points[i], sizeof x);
        for (int j = 0; j < N_PARAMS; j++) p[j] = exact(&c, x[j], -1);
        p[d] = calc_add(&c, p[d], exact(&c, k ? h : -h, -1));
        ball_params_make(&m, &c, p);
        ball_pass_make(&side[k], &c, &m, exact(&c, x[DIR_TB], -1), exact(&c, x[DIR_TC], -1), false);
      }
      const val f[] = {s.defect, s.pc, s.qc, s.defect_tb},
                low[] = {side[0].defect, side[0].pc, side[0].qc, side[0].defect_tb},
                high[] = {side[1].defect, side[1].pc, side[1].qc, side[1].defect_tb};
      for (int k = 0; k < 4; k++) {
        val quotient = calc_div(&c, calc_sub(&c, high[k], low[k]), exact(&c, 2 * h, -1));
        NUMBERS(arb, off);
        arb_sub(off, dual_value(quotient), dual_slope(f[k], d), 256);
        ck_assert_msg(fabs(num_arb.get_d(off)) < 1e-16 * (1 + fabs(num_arb.get_d(dual_slope(f[k], d)))),
                      "point %d, function %d along %d: off by %g", i, k, d, num_arb.get_d(off));
      }
    }
}

/* --- Values --- */

static bool inside(const struct dyn_bifurcation *b, const fmpq_t x) {
  return fmpq_cmp(&b->low, x) < 0 && fmpq_cmp(x, &b->high) < 0;
}

TABLE(changes, "tests/oracle/bifurcations.tsv", 11);
enum { VARY = N_PARAMS, FROM, TO, KIND, VALUE }; /* its columns, behind the parameters */

TEST_EACH(values_of_the_oracle, changes.n) {
  static const char *const names[] = {"chi", "eta", "V", "e1", "e2"};
  char *const *row = changes.row[_i];
  int hits = 0;
  NUMBERS(fmpq, value);
  OWNED(dyn_bifurcations) list;
  OWNED(param_line) l =
      param_line_of((const char *const *)row, word_find(row[VARY], names, N_PARAMS), row[FROM], row[TO]);
  rational_set(value, row[VALUE]);
  ck_assert_int_eq(find(&list, &l, 15), SS_OK);
  for (slong i = 0; i < list.n; i++)
    if (strcmp(dyn_change_id[list.at[i].what], row[KIND]) == 0 && inside(&list.at[i], value)) {
      hits++;
      ck_assert_msg(list.at[i].crosses && list.at[i].unique, "%s at %s", row[KIND], row[VALUE]);
    }
  ck_assert_msg(hits == 1, "%s at %s: %d brackets", row[KIND], row[VALUE], hits);
}

/* Brackets are nested as digits are asked for, one or two units wide, and hold at 60 digits too; the orbits at their
   ends are told as much about. */
TEST(more_digits_narrower_brackets) {
  const char *const params[] = {"0.8", "1", "1", "2.7844", "0"};
  struct dyn_bifurcations list[3];
  static const slong digits[] = {4, 15, 60};
  NUMBERS(fmpq, width, unit);
  OWNED(param_line) l = param_line_of(params, P_E2, "1.7", "2.6");
  for (int k = 0; k < 3; k++) {
    ck_assert_int_eq(find(&list[k], &l, digits[k]), SS_OK);
    ck_assert_int_eq(list[k].n, list[0].n);
    for (slong i = 0; i < list[k].n; i++) {
      const struct dyn_bifurcation *b = &list[k].at[i];
      fmpq_sub(width, &b->high, &b->low);
      fmpq_set_si(unit, 10, 1);
      fmpq_pow_si(unit, unit, 1 - b->digits);
      ck_assert(b->digits >= digits[k]);
      fmpq_div(width, width, unit);
      ck_assert(fmpq_is_one(width) || fmpq_cmp_ui(width, 2) == 0);
      ck_assert(b->crosses && b->unique);
      for (int end = 0; end < 2; end++)
        for (int n = 0; n < b->beside[end].n; n++)
          ck_assert(b->beside[end].orbit[n].stable != TRUTH_UNKNOWN &&
                    b->beside[end].orbit[n].admissible != TRUTH_UNKNOWN);
      if (k > 0)
        ck_assert(fmpq_cmp(&b->low, &list[k - 1].at[i].low) >= 0 && fmpq_cmp(&b->high, &list[k - 1].at[i].high) <= 0);
    }
  }
  for (int k = 0; k < 3; k++) dyn_bifurcations_clear(&list[k]);
}

/* --- What happens at a change --- */

static slong orbits_at(struct dyn_orbits *list, const struct param_line *l, const fmpq_t x) {
  FREED_PARAMS fmpq *p = rationals_of(l->params, N_PARAMS);
  fmpq_set(p + l->vary, x);
  ck_assert_int_eq(dyn_orbits_find(list, p, 64, NULL), SS_OK);
  return list->n;
}

/* The orbit of the list with these times, or NULL. */
static const struct dyn_orbit *same_orbit(const struct dyn_orbits *list, const struct dyn_orbit *o) {
  for (slong i = 0; i < list->n; i++)
    if (arb_overlaps(list->orbit[i].t[PHASE_GAMMA], o->t[PHASE_GAMMA]) &&
        arb_overlaps(list->orbit[i].t[PHASE_H], o->t[PHASE_H]))
      return &list->orbit[i];
  return NULL;
}

/* One side of a change: what it lists as orbits of the word is what the search finds there, with the same fate. */
static int side_count(const struct dyn_beside *s, const struct dyn_orbits *found, const char *what) {
  int n = 0;
  for (int i = 0; i < s->n; i++) {
    const struct dyn_orbit *o = same_orbit(found, &s->orbit[i]);
    ck_assert_msg((o != NULL) == (s->word[i] == TRUTH_TRUE), "%s: an orbit %s", what, o ? "left out" : "too many");
    if (!o) continue;
    n++;
    ck_assert_msg(o->stable == s->orbit[i].stable, "%s: stability", what);
    for (int k = 0; k < N_CONDITIONS; k++)
      ck_assert_msg(o->holds[k] == s->orbit[i].holds[k], "%s: condition %s", what, dyn_condition_id[k]);
  }
  return n;
}

/* What a change must do: to the number of orbits, and to what of each. */
static void check_change(const struct dyn_bifurcation *b, const struct param_line *l, slong *gain) {
  struct dyn_orbits at[2];
  const fmpq *end[2] = {&b->low, &b->high};
  int n[2];
  const char *id = dyn_change_id[b->what];
  for (int i = 0; i < 2; i++) {
    orbits_at(&at[i], l, end[i]);
    n[i] = side_count(&b->beside[i], &at[i], id);
  }
  *gain = n[1] - n[0];
  bool turns = b->what == CHANGE_FOLD, ends = b->what >= CHANGE_H_V1;
  ck_assert_msg(labs(*gain) == (turns ? 2 : ends ? 1 : 0), "%s: %d and %d orbits", id, n[0], n[1]);
  ck_assert_msg(at[1].n - at[0].n == *gain, "%s: the search finds %ld and %ld", id, (long)at[0].n, (long)at[1].n);
  const struct dyn_orbit *o[2] = {&b->beside[0].orbit[0], &b->beside[1].orbit[0]};
  if (b->what == CHANGE_FLIP) {
    double t[2] = {num_arb.get_d(o[0]->trace) + 1, num_arb.get_d(o[1]->trace) + 1};
    ck_assert(t[0] * t[1] < 0 && fabs(t[0]) < 0.5 && o[0]->stable != o[1]->stable);
    ck_assert((t[1] > t[0]) == (b->sense > 0));
  }
  if (b->what == CHANGE_TA) ck_assert_int_ne(o[0]->holds[COND_TA], o[1]->holds[COND_TA]);
  if (b->what == CHANGE_C_W_START || b->what == CHANGE_C_W_HILL)
    ck_assert_int_ne(o[0]->holds[COND_C_W], o[1]->holds[COND_C_W]);
  if (b->what == CHANGE_H_V2) ck_assert_int_ne(o[0]->holds[COND_H_V2], o[1]->holds[COND_H_V2]);
  if (turns) {
    const struct dyn_orbit *pair = b->beside[b->sense > 0].orbit;
    ck_assert_int_ne(num_arb.get_d(pair[0].trace) > 1, num_arb.get_d(pair[1].trace) > 1);
  }
  for (int i = 0; i < 2; i++) dyn_orbits_clear(&at[i]);
}

static const struct {
  const char *params[N_PARAMS];
  int vary;
  const char *from, *to;
} lines[] = {{{"0.8", "1", "1", "2.7844", "0"}, P_E2, "0.5", "3"},
             {{"0", "2", "1", "4", "0.25"}, P_CHI, "0.7", "0.9"},
             {{"0.8", "1", "0", "2.7844", "0.8587"}, P_V, "1.5", "3.5"},
             {{"0.8", "0", "1", "2.7844", "0.8587"}, P_ETA, "5", "0.5"},
             {{"0.5", "4", "1", "0", "1"}, P_E1, "1.5", "6"},
             {{"0.1857", "0.1006", "1.6272", "0", "16.2816"}, P_E1, "0.1", "3"}}; /* w meets e1 in phase C */

/* At six digits the ends of a bracket are far enough apart for the search; between two changes it must find what is
   left. */
TEST_EACH(each_change_does_what_it_says, COUNT(lines)) {
  OWNED(dyn_bifurcations) list;
  struct dyn_orbits at;
  NUMBERS(fmpq, x);
  OWNED(param_line) l = param_line_of(lines[_i].params, lines[_i].vary, lines[_i].from, lines[_i].to);
  ck_assert_int_eq(find(&list, &l, 6), SS_OK);
  ck_assert_int_eq(list.missed, 0);
  ck_assert_int_gt(list.n, 3);
  slong n = orbits_at(&at, &l, fmpq_cmp(l.from, l.to) < 0 ? l.from : l.to);
  dyn_orbits_clear(&at);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_bifurcation *b = &list.at[i];
    slong gain;
    ck_assert_msg(b->crosses && b->unique, "line %d: %s at %g", _i, dyn_change_id[b->what], fmpq_get_d(&b->low));
    const double *span = list.branch[b->branch].span, at_low = fmpq_get_d(&b->low), at_high = fmpq_get_d(&b->high);
    ck_assert_msg(span[0] <= at_high && at_low <= span[1], "line %d: a branch short of its %s", _i,
                  dyn_change_id[b->what]);
    if (i + 1 < list.n && fmpq_cmp(&list.at[i + 1].low, &b->high) <= 0)
      continue; /* two within 1e-5: counted together */
    if (i > 0 && fmpq_cmp(&b->low, &list.at[i - 1].high) <= 0) {
      n = orbits_at(&at, &l, &b->high);
      dyn_orbits_clear(&at);
      continue;
    }
    check_change(b, &l, &gain);
    ck_assert_msg(orbits_at(&at, &l, &b->low) == n, "line %d: %ld orbits below %s at %g, not %ld", _i, (long)at.n,
                  dyn_change_id[b->what], fmpq_get_d(&b->low), (long)n);
    dyn_orbits_clear(&at);
    n += gain;
  }
  ck_assert_int_eq(orbits_at(&at, &l, fmpq_cmp(l.from, l.to) < 0 ? l.to : l.from), n);
  dyn_orbits_clear(&at);
}

/* Where z_1'' = 0 at t_c, which the three equations single out; numbers by mpmath's findroot on the five equations of
   tests/referee/claims.py (eq_36d).  z_1' < V up to there, but not up to a time at which V has been passed. */
TEST(touch_of_the_oracle) {
  const char *const params[] = {"0.5", "4", "1", "2.5", "0"};
  static const double times[] = {2.020230011293395, 2.546157337644011, 1.515139986608597, 0.848453690491598};
  OWNED(dyn_bifurcations) list;
  NUMBERS(fmpq, value);
  rational_set(value, "1.109697612188447494143523204199");
  OWNED(param_line) l = param_line_of(params, P_E2, "1.1", "1.12");
  ck_assert_int_eq(find(&list, &l, 25), SS_OK);
  int hits = 0;
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.at[i].touch;
    if (list.at[i].what != CHANGE_TC) continue;
    hits++;
    ck_assert(list.at[i].crosses && inside(&list.at[i], value));
    ck_assert_int_eq(o->admissible, TRUTH_TRUE);
    for (int ph = 0; ph < N_PHASES; ph++) {
      ck_assert_int_eq(o->first[ph], TRUTH_TRUE);
      ck_assert_double_eq_tol(num_arb.get_d(o->t[ph]), times[ph], 1e-14);
    }
  }
  ck_assert_int_eq(hits, 1);
  for (int late = 0; late < 2; late++) { /* the example: its t_c is 1.4898... */
    struct ball_params m;
    struct ball_pass s;
    OWNED(calc) c = calc_begin(num_ctx_arb(96));
    FREED_PARAMS fmpq *at = rationals(example_text, N_PARAMS);
    ball_params_init(&m, &c, at);
    ball_pass_slip(&s, &c, &m, calc_d(&c, 2.00532), calc_d(&c, late ? 2.5 : 1.48));
    ck_assert_int_eq(ball_touches(&c, &m, &s, 10000), late ? TRUTH_UNKNOWN : TRUTH_TRUE);
  }
}

/* The third order at a flip, against tests/oracle/equality.tsv: c_2^2 + c_3 = 0.206... there is positive. */
TEST(third_order_of_the_oracle) {
  OWNED(table) flips = table_read("tests/oracle/equality.tsv", 11);
  ck_assert_int_eq(flips.n, 2);
  for (int row = 0; row < flips.n; row++) {
    char *const *field = flips.row[row];
    OWNED(dyn_bifurcations) list;
    double value = strtod(field[6], NULL), c2 = strtod(field[9], NULL), c3 = strtod(field[10], NULL);
    const char *from = formatted("%.6f", value - 0.01);
    const char *to = formatted("%.6f", value + 0.01);
    OWNED(param_line) l = param_line_of((const char *const *)field, atoi(field[5]), from, to);
    ck_assert_int_eq(find(&list, &l, 12), SS_OK);
    int hits = 0;
    for (slong i = 0; i < list.n; i++) {
      if (list.at[i].what != CHANGE_FLIP || fabs(fmpq_get_d(&list.at[i].low) - value) > 1e-9) continue;
      hits++;
      ck_assert_double_eq_tol(num_arb.get_d(list.at[i].third), c2 * c2 + c3, 1e-6 * fabs(c2 * c2 + c3));
    }
    ck_assert_msg(hits == 1, "%s: %d flips", field[6], hits);
  }
}

/* Given static friction: at low and high the bound on it, as the search has it, lies on different sides of what is
   given. */
TEST(friction_that_is_just_enough) {
  const char *const params[] = {"0.8", "1", "1", "2.7844", "0"};
  OWNED(dyn_bifurcations) list;
  RATIONALS(u, 2, rationals((const char *const[]){"2.2", "1.7"}, 2));
  int hits[2] = {0, 0};
  OWNED(param_line) l = param_line_of(params, P_E2, "0.7", "1.2");
  const struct dyn_line line = {l.params, l.vary, l.from, l.to, {&u[0], &u[1]}};
  ck_assert_int_eq(dyn_bifurcations_find(&list, &line, 10, 33), SS_OK);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_bifurcation *b = &list.at[i];
    int of = b->what == CHANGE_U_R2 ? 1 : 0;
    if (b->what != CHANGE_U_R1 && b->what != CHANGE_U_R2) continue;
    hits[of]++;
    ck_assert(b->crosses && b->unique && b->beside[0].n == 1 && b->beside[1].n == 1);
    int above[2];
    for (int k = 0; k < 2; k++) {
      OWNED(dyn_orbits) at;
      orbits_at(&at, &l, k ? &b->high : &b->low);
      const struct dyn_orbit *o = same_orbit(&at, &b->beside[k].orbit[0]);
      ck_assert(o != NULL);
      above[k] = num_arb.get_d(of ? o->u_r2_min : o->u_r1_min) > fmpq_get_d(&u[of]);
    }
    ck_assert_int_ne(above[0], above[1]);
    ck_assert_int_eq(b->sense, above[0] ? 1 : -1);
  }
  ck_assert_msg(hits[0] > 0 && hits[1] > 0, "%d and %d", hits[0], hits[1]);
}

/* --- Limits --- */

TEST(ends_outside_the_domain) {
  static const struct {
    int vary;
    const char *from, *to;
  } bad[] = {{P_CHI, "0.5", "1"}, {P_E2, "0", "1"}, {P_E2, "1", "1"}, {P_E1, "1e-400", "1"}, {P_V, "1", "1e400"}};
  for (size_t i = 0; i < COUNT(bad); i++) {
    OWNED(dyn_bifurcations) list;
    OWNED(param_line) l = param_line_of(example_text, bad[i].vary, bad[i].from, bad[i].to);
    ck_assert_msg(find(&list, &l, 6) & (SS_DOMAIN | SS_UNABLE), "case %zu", i);
    ck_assert_int_eq(list.n, 0);
  }
}
