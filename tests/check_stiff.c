/* Studies: their tables; smoothed friction against SciPy; what the stiff scenes, the smoothed laws and the paper's own
   procedure must show, with margins that no rounding crosses.

   Independent data: smooth.tsv (SciPy's Radau method) and procedure.tsv (mpmath) of tests/oracle.  The rates 2/3 and
   1/3 are those of the passage of a fold: a mass breaks loose late by (k rho)^(-1/3), with k the curvature of the law's
   top, which grows as s^2 and s, and rho the rate of the force; the creep u_s s |v| = |f| falls as 1/s. */
#include "bench/bench.h"
#include "bench/printed_digits.h"
#include "bench/smooth.h"
#include "motion/dual.h"
#include "params.h"
#include "rational.h"
#include "report/plot.h"
#include "test.h"

/* --- Tables. --- */

TEST(a_table_is_what_was_put_in) {
  OWNED_CLEARED(study_clear) struct study_page page = {.n = 0};
  LOCAL(text, out);
  struct study_table *t = study_table(&page, "t", "A table", "a\tab\tb", "Three columns.");
  study_cells(t, "%d\t%s", 1, "two");
  study_cells(t, "%.3g", 1.0 / 3);
  study_row(t);
  study_cells(t, "%.3g", NAN);
  study_cells(t, "%.3g", INFINITY);
  study_cells(t, "x");
  study_row(t);
  OWNED(rows) rows;
  rows_parse(&rows, text_str(&t->tsv));
  ck_assert_uint_eq(rows.n, 2);
  ck_assert(rows_is(&rows, 0, rows_column(&rows, "a"), "1") && rows_is(&rows, 0, rows_column(&rows, "ab"), "two"));
  ck_assert(rows_is(&rows, 0, rows_column(&rows, "b"), "0.333") && rows_is(&rows, 1, rows_column(&rows, "a"), "-"));
  ck_assert(rows_is(&rows, 1, rows_column(&rows, "b"), "x") && rows_column(&rows, "c") == 3);
  ck_assert(rows_number(&rows, 0, 2) == 0.333 && isnan(rows_number(&rows, 1, 0)) && isnan(rows_number(&rows, 0, 3)));
  static const struct study study = {.id = "s", .title = "S", .question = "Why?"};
  page.study = &study;
  text_init(&page.found);
  text_init(&page.figure);
  study_markdown(&out, &page, false);
  ck_assert_ptr_nonnull(strstr(text_str(&out), "| a | ab | b |\n| --- | ---: | ---: |\n| 1 | two | 0.333 |\n"));
}

/* --- Smoothed laws. --- */

static const double tried[N_PARAMS] = {2.0 / 3, 2, 1, 2, 0.25}, limits[2] = {2.5, 0.95};

TEST_EACH(laws_have_their_values, N_LAWS) {
  struct smooth m;
  enum smooth_law law = (enum smooth_law)_i;
  for (double s = 10; s < 2e8; s *= 10) {
    smooth_init(&m, law, s, tried, limits);
    for (int mass = 0; mass < 2; mass++) {
      double rate, most = 0, sliding = limits[mass] - tried[P_E1 + mass];
      ck_assert(smooth_friction(&rate, &m, mass, 0) == 0);
      ck_assert(rate < 0);
      ck_assert(fabs(smooth_friction(&rate, &m, mass, -60 / s * m.width) - sliding) < 1e-12);
      for (double x = 0.01; x < 30; x += 0.01) {
        double u = smooth_friction(&rate, &m, mass, -x / s);
        ck_assert(u == -smooth_friction(&rate, &m, mass, x / s));
        most = fmax(most, u);
      }
      double limit = law == LAW_TANH ? sliding : limits[mass], h = 1e-5 / s, p = -1.7 / s;
      ck_assert_msg(most <= limit * (1 + 1e-13) && most > limit * (1 - 1e-5), "law %d, s %g: %.17g", law, s, most);
      double up = smooth_friction(&rate, &m, mass, p + h), down = smooth_friction(&rate, &m, mass, p - h);
      smooth_friction(&rate, &m, mass, p);
      ck_assert(fabs((up - down) / (2 * h) - rate) < 1e-8 * s);
    }
  }
}

/* The numbers behind the first field of a row. */
static int numbers(double *x, char *const *row) {
  int n = 0;
  for (; row[n + 1]; n++) x[n] = atof(row[n + 1]);
  return n;
}

TEST_EACH(passages_are_those_of_scipy, 3) {
  static const char *const solvers[] = {"msbdf", "bsimp", "rk8pd"};
  double x[MOST_COLUMNS], y[STEPPER_SIZE], t = 0;
  int passages = 0;
  struct smooth m;
  struct stepper *stepper = NULL;
  struct stepper_system system;
  OWNED(table) rows = table_read("tests/oracle/smooth.tsv", ANY_COLUMNS);
  for (int row = 0; row < rows.n; row++) {
    int n = numbers(x, rows.row[row]);
    if (strcmp(rows.row[row][0], "start") == 0) {
      ck_assert_int_eq(n, 13);
      smooth_init(&m, LAW_STRIBECK, x[7], x, x + 5);
      m.level = x[8];
      memcpy(y, x + 9, sizeof y);
      system = smooth_system(&m, 1e-10, 0.1);
      stepper = stepper_open(solvers[_i], &system);
      ck_assert_ptr_nonnull(stepper);
    } else {
      struct smooth_passage s;
      ck_assert_int_eq(n, 4);
      ck_assert_int_eq(smooth_return(&s, y, &(struct smooth_way){&m, stepper, 1, 100, 100000}), SS_OK);
      t += s.time;
      ck_assert_msg(fabs(t - x[0]) < 1e-6, "%s: %.12g, not %.12g", solvers[_i], t, x[0]);
      for (int i = 0; i < 3; i++) ck_assert(fabs(y[i] - x[1 + i]) < 1e-6);
      passages++;
    }
  }
  stepper_close(stepper);
  ck_assert_int_eq(passages, 3);
}

TEST(a_return_that_does_not_come) {
  struct smooth m;
  struct smooth_passage s;
  double y[STEPPER_SIZE] = {1.1, -1.9, 0, 0};
  smooth_init(&m, LAW_STRIBECK, 100, tried, limits);
  struct stepper_system system = smooth_system(&m, 1e-8, 0.1);
  ck_assert_ptr_null(stepper_open("no such solver", &system));
  struct stepper *stepper = stepper_open("bsimp", &system);
  m.level = -1000;
  ck_assert_int_eq(smooth_return(&s, y, &(struct smooth_way){&m, stepper, 1, 30, 100000}), SS_DOMAIN);
  ck_assert_int_eq(smooth_return(&s, y, &(struct smooth_way){&m, stepper, 1, 30, 10}), SS_UNABLE);
  stepper_close(stepper);
}

/* --- What the studies show. --- */

static const struct study *study_named(const char *id) {
  for (int i = 0; i < n_bench_studies; i++)
    if (strcmp(bench_studies[i]->id, id) == 0) return bench_studies[i];
  ck_abort_msg("no study %s", id);
}

static void make(struct study_page *page, const char *id) {
  ck_assert(study_run(page, study_named(id), &(struct bench_env){.data = "verify"}, true));
}

static const struct study_table *table(const struct study_page *page, const char *id) {
  for (int i = 0; i < page->n; i++)
    if (strcmp(page->table[i].id, id) == 0) return &page->table[i];
  ck_abort_msg("no table %s", id);
}

static int count(const struct study_table *t) {
  OWNED(rows) rows;
  rows_parse(&rows, text_str(&t->tsv));
  return (int)rows.n;
}

static bool is(const struct study_table *t, int row, const char *column, const char *value) {
  OWNED(rows) rows;
  rows_parse(&rows, text_str(&t->tsv));
  return rows_is(&rows, (size_t)row, rows_column(&rows, column), value);
}

static double number(const struct study_table *t, int row, const char *column) {
  OWNED(rows) rows;
  rows_parse(&rows, text_str(&t->tsv));
  return rows_number(&rows, (size_t)row, rows_column(&rows, column));
}

TEST(stiff_scenes) {
  OWNED_CLEARED(study_clear) struct study_page page;
  make(&page, "stiff");
  const struct study_table *orbits = table(&page, "orbits"), *runs = table(&page, "runs"),
                           *sum = table(&page, "totals");
  ck_assert_int_eq(count(orbits), 5);
  for (int i = 0; i < 5; i++) ck_assert_msg(number(orbits, i, "bits") >= 64, "row %d", i);
  int closed = 0, good = 0;
  for (int i = 0; i < count(runs); i++) {
    if (is(runs, i, "method", "closed-double")) {
      closed++;
      ck_assert(is(runs, i, "outcome", "ok") && number(runs, i, "error") < 1e-8);
    }
    /* nobody loses the word at a tight tolerance where nothing is stiff, and the error is small then */
    if (is(runs, i, "eta", "1e-6") && is(runs, i, "tolerance", "1e-08")) {
      ck_assert(is(runs, i, "outcome", "ok") && number(runs, i, "error") < 1e-5);
      good++;
    }
    /* a million turns of the fast mode are more than the steps allowed */
    if (is(runs, i, "eta", "1e+12") && is(runs, i, "tolerance", "1e-08")) ck_assert(is(runs, i, "outcome", "gives up"));
  }
  ck_assert_int_eq(closed, 5);
  ck_assert_int_ge(good, 4);
  double strays = 0;
  for (int i = 0; i < count(sum); i++) strays += number(sum, i, "late");
  ck_assert(strays >= 1); /* long steps at a loose tolerance do pass an event by, and that is seen */
  for (int i = 0; i < count(sum); i++)
    ck_assert(number(sum, i, "runs") ==
              number(sum, i, "word") + number(sum, i, "late") + number(sum, i, "early") + number(sum, i, "gives_up"));
}

TEST(smoothed_laws) {
  OWNED_CLEARED(study_clear) struct study_page page;
  make(&page, "smooth");
  const struct study_table *rates = table(&page, "rates");
  int seen = 0;
  const char *figure = text_str(&page.figure);
  ck_assert(strstr(figure, ">paper, stribeck</text>") && !strstr(figure, ">paper, tanh</text>"));
  for (int i = 0; i < count(rates); i++) {
    if (is(rates, i, "law", "tanh")) ck_assert(is(rates, i, "state_error", "-")); /* no stick phase is left */
    if (!is(rates, i, "s", "1e4") || is(rates, i, "law", "tanh")) continue;
    bool narrow = is(rates, i, "law", "stribeck");
    double rate = number(rates, i, "state_rate"), creep = number(rates, i, "creep_rate");
    ck_assert_msg(narrow ? rate > 0.55 && rate < 0.75 : rate > 0.2 && rate < 0.42, "row %d: %g", i, rate);
    ck_assert_msg(creep > 0.9 && creep < 1.1, "row %d: %g", i, creep);
    seen++;
  }
  ck_assert_int_eq(seen, 4);
}

TEST(printed_times_as_mpmath_has_them) {
  struct num_ctx ctx = dual_ctx(PRINTED_BITS);
  BALLS(N_WANTED, out);
  NUMBERS(arb, value);
  OWNED(num_vec) params = vec_new(N_PARAMS, ctx), t = vec_new(3, ctx);
  for (int i = 0; i < N_PARAMS; i++) {
    arb_set_str(value, example_text[i], PRINTED_BITS);
    num_dual.set_arb(num_vec_at(&params, i), value, PRINTED_BITS);
  }
  OWNED(table) rows = table_read("tests/oracle/procedure.tsv", 8);
  ck_assert_int_eq(rows.n, 8);
  for (int seen = 0; seen < rows.n; seen++) {
    char *const *field = rows.row[seen];
    for (int k = 0; k < 3; k++) {
      arb_set_str(value, field[2 + k], PRINTED_BITS);
      num_dual.set_arb(num_vec_at(&t, k), value, PRINTED_BITS);
    }
    printed_by_row(out, NULL, atoi(field[1]), &params, &t);
    for (int k = 0; k < N_WANTED; k++) {
      arb_set_str(value, field[5 + k], PRINTED_BITS);
      arb_sub(value, value, out + k, PRINTED_BITS);
      ck_assert_msg(fabs(num_arb.get_d(value)) < 1e-26, "row %d, number %d", seen, k);
      ck_assert(arb_rel_accuracy_bits(out + k) > 150);
    }
  }
}

/* A bound over the whole box promises no more than its points keep; more printed digits give more; the numbers of
   mpmath give the digits in the table. */
TEST(the_papers_procedure) {
  static const char *const wanted[] = {"t_a", "z10", "z20"};
  OWNED_CLEARED(study_clear) struct study_page page;
  char column[40];
  make(&page, "procedure");
  const struct study_table *printed = table(&page, "printed"), *line = table(&page, "singular");
  for (int i = 0; i < count(printed); i++)
    for (int k = 0; k < 3; k++) {
      snprintf(column, sizeof column, "%s_worst", wanted[k]);
      double worst = number(printed, i, column), at = number(printed, i, wanted[k]);
      snprintf(column, sizeof column, "%s_sure", wanted[k]);
      double sure = number(printed, i, column);
      ck_assert_msg(worst <= at && !(sure > worst), "row %d, %s", i, wanted[k]);
      if (is(printed, i, "scene", "paper") && is(printed, i, "printed", "8") && isfinite(sure))
        ck_assert(sure > worst - 0.3); /* the bound is not far from what happens */
    }
  /* |t_a - 0.5322807...|/0.5322807 of procedure.tsv at four digits: 10^-1.13 and 10^-1.04 */
  for (int i = 0; i < count(printed); i++)
    if (is(printed, i, "scene", "paper") && is(printed, i, "orbit", "2") && is(printed, i, "printed", "4"))
      ck_assert(!is(printed, i, "way", "(45), first") || fabs(number(printed, i, "t_a") - 1.13) < 0.06);
  ck_assert_int_eq(count(line), 4);
  for (int i = 1; i < 4; i++) { /* ten times as near, ten times the condition number; the others do not notice */
    double grows = number(line, i, "cond_N1-I") / number(line, i - 1, "cond_N1-I");
    ck_assert(grows > 9 && grows < 11);
    ck_assert(number(line, i, "cond_six") < 200 && number(line, i, "cond_map") < 1);
    ck_assert(number(line, i, "six") < 2 && number(line, i, "map") < 2);
  }
  ck_assert(number(line, 3, "paper") > 3);
}

TEST_EACH(without_scenes_there_is_no_study, 4) {
  OWNED_CLEARED(study_clear) struct study_page page;
  const struct bench_env env = {.data = _i / 2 ? "tests" : NULL};
  ck_assert(!study_run(&page, study_named(_i % 2 ? "smooth" : "procedure"), &env, true));
}
