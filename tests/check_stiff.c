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

/* A table of a page, read once more; to be cleared. */
static struct rows rows_of(const struct study_page *page, const char *id) {
  struct rows rows;
  int i = 0;
  while (i < page->n && strcmp(page->table[i].id, id) != 0) i++;
  ck_assert_msg(i < page->n, "no table %s", id);
  rows_parse(&rows, text_str(&page->table[i].tsv));
  return rows;
}

static bool is(const struct rows *rows, size_t row, const char *column, const char *value) {
  return rows_is(rows, row, rows_column(rows, column), value);
}

static double number(const struct rows *rows, size_t row, const char *column) {
  return rows_number(rows, row, rows_column(rows, column));
}

/* Whether a row is one of those that "COLUMN=VALUE; COLUMN=VALUE" tells; ROW: those from that one on. */
static bool is_told(const struct rows *rows, size_t row, const char *where) {
  char column[80], value[80];
  for (const char *p = where; *p; p += strcspn(p, ";"), p += strspn(p, "; ")) {
    ck_assert_int_eq(sscanf(p, "%79[^=]=%79[^;]", column, value), 2);
    if (strcmp(column, "from") == 0 ? row < strtoul(value, NULL, 10) : !is(rows, row, column, value)) return false;
  }
  return true;
}

TABLE(facts, "tests/cases/study_facts.tsv", 7);
enum { STUDY, OF, WHERE, COLUMN, SAYS, BELOW, ROWS }; /* its columns */

static void check_facts(const struct study_page *page) {
  for (int i = 0; i < facts.n; i++) {
    char *const *fact = facts.row[i];
    if (strcmp(fact[STUDY], page->study->id) != 0) continue;
    OWNED(rows) rows = rows_of(page, fact[OF]);
    int met = 0;
    for (size_t k = 0; k < rows.n; k++) {
      if (!is_told(&rows, k, fact[WHERE])) continue;
      double x = number(&rows, k, fact[COLUMN]);
      bool holds =
          *fact[BELOW] ? x >= atof(fact[SAYS]) && x < atof(fact[BELOW]) : is(&rows, k, fact[COLUMN], fact[SAYS]);
      ck_assert_msg(holds, "%s, row %zu, %s: %g", fact[OF], k, fact[COLUMN], x);
      met++;
    }
    bool enough = strchr(fact[ROWS], '+') ? met >= atoi(fact[ROWS]) : met == atoi(fact[ROWS]);
    ck_assert_msg(enough, "%s where %s: %d rows", fact[OF], fact[WHERE], met);
  }
}

TEST(stiff_scenes) {
  OWNED_CLEARED(study_clear) struct study_page page;
  make(&page, "stiff");
  check_facts(&page);
  OWNED(rows) sum = rows_of(&page, "totals");
  double strays = 0;
  for (size_t i = 0; i < sum.n; i++) {
    strays += number(&sum, i, "late");
    ck_assert(number(&sum, i, "runs") == number(&sum, i, "word") + number(&sum, i, "late") + number(&sum, i, "early") +
                                             number(&sum, i, "gives_up"));
  }
  ck_assert(strays >= 1); /* long steps at a loose tolerance do pass an event by, and that is seen */
}

TEST(smoothed_laws) {
  OWNED_CLEARED(study_clear) struct study_page page;
  make(&page, "smooth");
  const char *figure = text_str(&page.figure);
  ck_assert(strstr(figure, ">paper, stribeck</text>") && !strstr(figure, ">paper, tanh</text>"));
  check_facts(&page);
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
  make(&page, "procedure");
  check_facts(&page);
  OWNED(rows) printed = rows_of(&page, "printed"), line = rows_of(&page, "singular");
  for (size_t i = 0; i < printed.n; i++)
    for (int k = 0; k < 3; k++) {
      double worst = number(&printed, i, formatted("%s_worst", wanted[k])), at = number(&printed, i, wanted[k]);
      double sure = number(&printed, i, formatted("%s_sure", wanted[k]));
      ck_assert_msg(worst <= at && !(sure > worst), "row %zu, %s", i, wanted[k]);
      if (is(&printed, i, "scene", "paper") && is(&printed, i, "printed", "8") && isfinite(sure))
        ck_assert(sure > worst - 0.3); /* the bound is not far from what happens */
    }
  for (size_t i = 1; i < 4; i++) { /* ten times as near, ten times the condition number */
    double grows = number(&line, i, "cond_N1-I") / number(&line, i - 1, "cond_N1-I");
    ck_assert(grows > 9 && grows < 11);
  }
}

TEST_EACH(without_scenes_there_is_no_study, 4) {
  OWNED_CLEARED(study_clear) struct study_page page;
  const struct bench_env env = {.data = _i / 2 ? "tests" : NULL};
  ck_assert(!study_run(&page, study_named(_i % 2 ? "smooth" : "procedure"), &env, true));
}
