/* The study of digits: planted formulas whose loss is known beforehand, condition numbers and true values made
   elsewhere (tests/oracle/stability.py, mpmath), the same bytes for any number of processes, what the command refuses.

   1 - cos t loses digits for small t by itself, since its condition number there is 2; 2 sin(t/2)^2 does not; sin(V t)
   at large V t loses what its condition number V t says, whatever the formula. */
#include "base/random.h"
#include "every.h"
#include "paper_model.h"
#include "report/stability.h"
#include "stability/stability_impl.h"
#include "test.h"

static struct model model;

/* Of the last run of a test, and what was said of a point. */
static struct stability_result r;
static struct text said;

static void open_model(void) {
  scratch_open();
  model = paper_model(&(struct paper_layers){.overlay = "tests/cases/planted.eq", .errata = "tests/cases/mended.eq"});
}

static void close_model(void) {
  text_clear(&said);
  stability_result_clear(&r);
  model_clear(&model);
  scratch_close();
}

/* The study of the named formulas. */
static void run(const char *const *only, int n, bool quick, int jobs, int after) {
  const struct stability_options q = {
      .layer = LAYER_PRINTED, .after = after, .only = only, .n_only = n, .quick = quick, .jobs = jobs};
  stability_result_clear(&r);
  r = (struct stability_result){.n_regions = 0};
  goes_well(audit_stability(&r, &model, &q, &d));
}

#define RUN(quick, jobs, after, ...)                                                                                   \
  run((const char *const[]){__VA_ARGS__}, COUNT(((const char *const[]){__VA_ARGS__})), quick, jobs, after)

/* What is said of one formula at one point says this. */
static void says_at(const char *formula, const char *point, const char *what) {
  const struct stability_options q = {.layer = LAYER_PRINTED, .after = -1, .only = &formula, .n_only = 1, .jobs = 1};
  text_reset(&said);
  goes_well(audit_stability_at(&said, &model, &q, point, &d));
  ck_assert_msg(strstr(text_str(&said), what) != NULL, "%s at %s: %s is not in\n%s", formula, point, what,
                text_str(&said));
}

static void make_set(struct digits_set *s) {
  goes_well(digits_set_make(s, &model, LAYER_PRINTED, &d));
}

static int formula_of(const char *id) {
  for (int i = 0; i < r.n_formulas; i++)
    if (strcmp(r.formula[i].id, id) == 0) return i;
  ck_abort_msg("no formula %s", id);
}

static const struct stability_row *row_of(const char *id, const char *region) {
  for (int k = 0; k < r.n_regions; k++)
    if (strcmp(r.region[k].id, region) == 0) return stability_row_at(&r, formula_of(id), k);
  ck_abort_msg("no region %s", region);
}

static bool faulty(const char *id) {
  bool any = false;
  for (int k = 0; k < r.n_regions; k++) any = any || stability_row_at(&r, formula_of(id), k)->at_fault;
  return any;
}

/* Does it lose digits of its own in some region?  Whether it overflows somewhere is another matter. */
static bool loses(const char *id) {
  bool any = false;
  for (int k = 0; k < r.n_regions; k++) any = any || stability_loses(stability_row_at(&r, formula_of(id), k));
  return any;
}

/* --- Planted formulas --- */

CASE("stability", .each = {open_model, close_model});

TEST(a_cancellation_is_found_and_named) {
  RUN(false, 1, -1, "cancels");
  const struct stability_row *row = row_of("cancels", "times-small");
  ck_assert(row->at_fault);
  ck_assert_double_gt(row->formula_lost, 15);
  ck_assert_double_lt(row->problem, 0.4); /* kappa = t sin t/(1 - cos t) -> 2 */
  ck_assert_int_eq((int)row->cause, CAUSE_CANCELLATION);
  ck_assert_str_eq(row->node, "1 - cos(t)");
  ck_assert_str_eq(row->left, "1");
  ck_assert_str_eq(row->right, "cos(t)");
  ck_assert_msg(row->source && strcmp(row->source, "planted") == 0, "%s", row->source ? row->source : "nowhere");
}

/* A quick study of all formulas has each scalar and each matrix, and of no matrix the entries; a named matrix has
   them. */
TEST(a_quick_study_of_all_takes_matrices_as_a_whole) {
  static const struct {
    bool quick;
    int n_only;
    bool entries;
  } asked[] = {{true, 0, false}, {true, 1, true}, {false, 0, true}};
  static const char *const only[] = {"H"};
  for (size_t i = 0; i < COUNT(asked); i++) {
    const struct stability_options q = {
        .layer = LAYER_PRINTED, .after = -1, .only = only, .n_only = asked[i].n_only, .quick = asked[i].quick};
    OWNED_CLEARED(digits_study_close) struct digits_study st;
    goes_well(digits_study_open(&st, &model, &q, &d));
    bool whole = false, entry = false;
    for (size_t k = 0; k < st.n; k++) {
      whole = whole || strcmp(st.formula[k]->id, "H") == 0;
      entry = entry || strcmp(st.formula[k]->id, "H[1,3]") == 0;
    }
    ck_assert(whole);
    ck_assert_int_eq(entry, asked[i].entries);
  }
}

/* At chi = 1e-10 and eta = 1e10, omega_1 loses 7.4 digits that the problem does not: neither chi -> 0 alone nor chi eta
   -> 1 alone shows it.  omega underflows where both parameters are small. */
TEST(losses_where_regions_meet_are_found) {
  static const char *const only[] = {"omega_1", "omega_2", "c_1", "omega@stability"};
  run(only, 4, false, 1, -1);
  for (int i = 0; i < 3; i++) {
    const struct stability_row *row = row_of(only[i], "chi-to-0-chi-eta-near-1");
    ck_assert_msg(row->at_fault && row->formula_lost > 7, "%s: %g digits", only[i], row->formula_lost);
    if (i < 2) ck_assert_int_eq((int)row->cause, CAUSE_ROOT); /* at a late time the cosine loses more than the root */
  }
  ck_assert_int_gt((int)row_of("omega@stability", "anywhere")->failures, 0);
}

TEST(a_sound_formula_is_not_blamed) {
  RUN(false, 1, -1, "steady", "given");
  ck_assert(!loses("steady"));
  ck_assert_int_gt((int)r.formula[formula_of("steady")].points, 300);
  /* z_20 - z_10 cancels, but its operands are exact: no digit is lost, though the condition number is large. */
  const struct stability_row *row = row_of("given", "z_20-near-z_10");
  ck_assert(row->found && !row->at_fault);
}

TEST(the_problem_is_blamed_for_its_own_loss) {
  RUN(false, 1, -1, "turned");
  const struct stability_row *row = row_of("turned", "times-large");
  ck_assert(!loses("turned"));
  ck_assert(row->found);
}

TABLE(failing, "tests/cases/planted_failures.tsv", 6);
enum { F_FORMULA, F_REGION, F_CAUSE, F_NODE, F_LEAST, F_MOST }; /* its columns */

/* Failures are told apart, and rare ones climbed to: hardly a point drawn is where one is.  The worst of a region is
   the least extreme. */
TEST_EACH(failures_are_named, failing.n) {
  char *const *row = failing.row[_i];
  RUN(false, 2, -1, row[F_FORMULA]);
  const struct stability_row *is = *row[F_REGION] ? row_of(row[F_FORMULA], row[F_REGION])
                                                  : &r.row[r.formula[formula_of(row[F_FORMULA])].worst_failure];
  ck_assert(is->failures > 0 && is->at_fault);
  ck_assert_str_eq(loss_cause_says[is->failure], row[F_CAUSE]);
  ck_assert_str_eq(is->failure_node, row[F_NODE]);
  ck_assert_str_eq(is->failure_source, "planted");
  ck_assert_msg(!*row[F_MOST] || (is->failure_size > atof(row[F_LEAST]) && is->failure_size < atof(row[F_MOST])),
                "1e%g", is->failure_size);
}

TEST(divisors_and_sums_are_told_apart) {
  RUN(false, 2, -1, "divides", "hides");
  ck_assert_int_eq((int)row_of("divides", "times-small")->cause, CAUSE_SMALL_DIVISOR);
  ck_assert_int_eq((int)row_of("hides", "times-small")->cause, CAUSE_CANCELLATION);
  ck_assert_double_gt(row_of("hides", "times-small")->formula_lost, 15);
}

/* (1/49) 49 is 1 - 2^-53 in double: the sum is off by 2^-53 V whatever t is, and its condition number is 1. */
TEST(losses_beyond_all_digits_are_ordered) {
  RUN(false, 1, -1, "drifts");
  const struct stability_row *row = row_of("drifts", "times-small");
  ck_assert(row->at_fault);
  ck_assert_double_lt(row->formula_lost, 16);
  ck_assert_msg(row->excess > 280, "%g digits", row->excess); /* t = 1e-300 is the worst of the region */
  LOCAL(text, t);
  report_stability_markdown(&t, &r);
  ck_assert_ptr_nonnull(strstr(text_str(&t), "all digits (relative error "));
  ck_assert_ptr_null(strstr(text_str(&t), "| 15.9 | 0.0 | 15.9 |"));
}

static int times_in(const char *body, const char *what) {
  int n = 0;
  for (const char *p = body; (p = strstr(p, what)); p++) n++;
  return n;
}

static int field_called(const char *name, char *const *title, int n) {
  for (int i = 0; i < n; i++)
    if (strcmp(title[i], name) == 0) return i;
  ck_abort_msg("no column %s", name);
}

/* A row of ledger.tsv tells how far off the value is, and in which record the node is written that puts it off. */
TEST(a_line_of_the_table_says_how_much_and_where) {
  enum { FIELDS = 32 };
  LOCAL(text, table);
  char *title[FIELDS], *field[FIELDS], *end;
  int beyond = 0;
  RUN(true, 1, -1, "drifts");
  report_stability_tsv(&table, &r);
  char *body = table.data, *next = strchr(body, '\n');
  *next = '\0';
  int n = split_tabs(title, FIELDS, body);
  for (body = next + 1; *body; body = next + 1) {
    next = strchr(body, '\n');
    *next = '\0';
    ck_assert_int_eq(split_tabs(field, FIELDS, body), n);
    const char *lost = field[field_called("digits lost", title, n)], *problem, *formula, *source;
    problem = field[field_called("by the problem", title, n)];
    formula = field[field_called("by the formula", title, n)];
    source = field[field_called("source", title, n)];
    if (strcmp(formula, "-") == 0) continue;
    ck_assert_str_eq(source, "planted");
    const char *error = strstr(lost, "(relative error ");
    if (!error) continue;
    double off = log10(strtod(error + strlen("(relative error "), &end)) + 53 * log10(2); /* of one digit: to 0.3 */
    ck_assert_double_eq_tol(strtod(formula, NULL), off - strtod(problem, NULL), 0.4);
    beyond += off > 17;
  }
  ck_assert_int_gt(beyond, 0);
}

/* What is at fault is so in the rows, in the JSON and in the table. */
TEST(fault_means_one_thing) {
  LOCAL(text, json, table);
  int faults = 0;
  RUN(true, 2, -1, "planted", "dyn_return_map[1]");
  for (long i = 0; i < r.n_rows; i++) {
    const struct stability_row *row = &r.row[i];
    bool kernel = r.formula[row->formula].kernel;
    bool loses_digits = row->found && row->observed - row->problem > log10(8) + 1e-9; /* the contract of its row */
    ck_assert_int_eq(row->at_fault, loses_digits || (row->failures > 0 && !kernel));
    faults += row->at_fault;
  }
  report_stability_json(&json, &r);
  report_stability_tsv(&table, &r);
  ck_assert_int_gt(faults, 20);
  ck_assert_int_eq(times_in(text_str(&json), "\"at_fault\": true"), faults);
  ck_assert_int_eq(times_in(text_str(&table), "\n"), faults + 1);
}

/* Of one formula at one point. */
TABLE(at_points, "tests/cases/stability_points.tsv", 4);
enum { AT_FORMULA, AT, SAID }; /* its columns; what is said has two of them */

TEST_EACH(what_is_said_at_a_point, at_points.n) {
  char *const *row = at_points.row[_i];
  for (int k = SAID; k < SAID + 2 && *row[k]; k++) says_at(row[AT_FORMULA], row[AT], row[k]);
}

/* One from adjoints, node by node, the other from derivatives of the whole formula. */
TEST(condition_numbers_agree) {
  static const char *const id[] = {"rolls", "lags", "spans"};
  static const double at[][2] = {{3, 7}, {1, 0x1.921fb54442d18p+60}, {0x1p-40, 0x1p-3}, {0x1.8p+12, 0x1.6p+45}, {1, 5}};
  OWNED(digits_set) s;
  make_set(&s);
  for (int i = 0; i < 3; i++) {
    struct digits_formula *f = digits_find(&s, id[i]);
    OWNED(digits_bench) w;
    goes_well(digits_slopes(f, &s, &d));
    digits_bench_init(&w, f);
    for (size_t k = 0; k < COUNT(at); k++) {
      struct digits_loss loss = digits_measure(&w, at[k], -1);
      ck_assert_int_eq((int)loss.kind, DIGITS_LOST);
      double c = digits_condition(&w, 0, w.f->tape.n_inputs);
      ck_assert_msg(fabs(fmax(0, c) - fmax(0, loss.condition)) < 0.01, "%s at %a, %a: 2^%g and 2^%g", id[i], at[k][0],
                    at[k][1], c, loss.condition);
    }
  }
}

/* Every point drawn is in the matrix once, and the rule's bin is the observed one at nearly all. */
TEST(the_rule_predicts) {
  long all = 0, same = 0, lossy = 0;
  RUN(false, 2, -1, "cancels", "steady", "turned", "divides", "grows");
  for (int a = 0; a < N_LOSS_BINS; a++)
    for (int b = 0; b < N_LOSS_BINS; b++) {
      all += r.confusion[a][b];
      same += a == b ? r.confusion[a][b] : 0;
      lossy += a == b && a > 0 ? r.confusion[a][b] : 0;
    }
  ck_assert_int_gt((int)all, 500);
  ck_assert_int_gt((int)lossy, 100);
  ck_assert_msg((double)same >= 0.97 * (double)all, "%ld of %ld", same, all);
}

TEST(what_is_zero_has_no_relative_error) {
  RUN(true, 1, -1, "none");
  ck_assert(r.formula[0].zero);
  ck_assert(!faulty("none"));
}

/* What rounding hides from the result is no loss of the formula, and the rule knows it. */
TEST(rounded_once_nothing_is_lost) {
  RUN(false, 2, -1, "whole");
  ck_assert(!faulty("whole"));
  for (int k = 0; k < r.n_regions; k++) {
    const struct stability_row *row = stability_row_at(&r, 0, k);
    ck_assert_msg(row->failures == 0 && row->undecided == 0, "%s: %ld", r.region[k].id, row->failures);
    if (row->found)
      ck_assert_msg(row->observed < 0.1 && row->predicted < 0.1, "%s: %g", r.region[k].id, row->predicted);
  }
}

TEST(another_layer_is_held_against_it) {
  RUN(false, 1, LAYER_CORRECTED, "cancels", "hides", "grows");
  const struct stability_row *row = row_of("cancels", "times-small");
  ck_assert_double_gt(row->formula_lost, 15);
  ck_assert_double_lt(row->after, 1);
  for (int k = 0; k < r.n_regions; k++) {
    const struct stability_row *at = stability_row_at(&r, formula_of("cancels"), k);
    if (at->points == 0) continue;
    ck_assert_msg(at->after_most >= 0 && at->after_most < 1, "%s: %g", r.region[k].id, at->after_most);
    ck_assert(at->after_witness && at->after_failures == 0);
  }
  long fall_short = 0, remain = 0; /* where t/V overflows, but for a form that is rounded as a whole */
  for (int k = 0; k < r.n_regions; k++) {
    fall_short += stability_row_at(&r, formula_of("grows"), k)->after_short;
    remain += stability_row_at(&r, formula_of("grows"), k)->after_rounded;
  }
  ck_assert(fall_short > 0 && remain == 0);
  ck_assert(isnan(row_of("hides", "times-small")->after));  /* the same formula there */
  ck_assert(!r.formula[formula_of("cancels")].replacement); /* no record of stable.eq */
}

/* The witness in the ledger gives the digits in the ledger. */
TEST(witnesses_reproduce) {
  int tried = 0;
  RUN(true, 1, -1, "cancels", "hides", "gammatilde_2", "ktilde_7", "H[1,2]");
  for (long i = 0; i < r.n_rows; i++) {
    const struct stability_row *row = &r.row[i];
    if (!row->found) continue;
    const char *expected = formatted("of %.1f digits lost the problem loses %.1f, the formula %.1f", row->observed,
                                     row->problem, row->formula_lost);
    says_at(r.formula[row->formula].id, row->witness, expected);
    tried++;
  }
  ck_assert_int_gt(tried, 40);
  ck_assert_int_gt((int)r.conditions, 40);
  ck_assert_int_eq((int)r.condition_differs, 0);
}

/* --- At points on file: against numbers made elsewhere, and where a search has found the worst --- */

/* A formula measured at a point, NAME=VALUE, ... */
struct measured {
  struct digits_formula *f;
  struct digits_bench w;
  struct digits_loss loss;
};

static void measure(struct measured *m, struct digits_set *s, const char *id, char *point) {
  double x[DIGITS_INPUTS] = {0};
  m->f = digits_find(s, id);
  ck_assert_msg(m->f != NULL, "no formula %s", id);
  for (char *p = strtok(point, ","); p; p = strtok(NULL, ",")) {
    char *equals = strchr(p, '=');
    *equals = '\0';
    slong k = tape_input(&m->f->tape, p);
    if (k >= 0) x[k] = strtod(equals + 1, NULL);
  }
  digits_bench_init(&m->w, m->f);
  m->loss = digits_measure(&m->w, x, -1);
}

/* log2 of the condition number by derivatives of the whole formula. */
static double condition_of(struct measured *m, struct digits_set *s) {
  goes_well(digits_slopes(m->f, s, &d));
  return digits_condition(&m->w, 0, m->f->tape.n_inputs);
}

/* field: formula, point, truth, condition number. */
static void check_case(struct measured *m, struct digits_set *s, char **field) {
  NUMBERS(arb, expected);
  ck_assert_int_eq((int)m->loss.kind, DIGITS_LOST);
  arb_srcptr is = num_vec_at(&m->w.b, m->f->out[0]);
  ck_assert_int_eq(arb_set_str(expected, field[2], 200), 0);
  arb_sub(expected, expected, is, 200);
  ck_assert_msg(digits_log2(expected) < digits_log2(is) - 60, "%s is not %s", field[0], field[2]);
  double kappa = strtod(field[3], NULL), c = exp2(condition_of(m, s)), adjoint = exp2(m->loss.condition);
  ck_assert_msg(fabs(c - kappa) < 1e-4 * kappa, "%s: condition number %.9g, not %.9g", field[0], c, kappa);
  ck_assert_msg(fabs(adjoint - kappa) < 1e-2 * fmax(1, kappa), "%s: adjoint %.9g", field[0], adjoint);
}

static void check_worst(struct measured *m, struct digits_set *s, char **field) {
  const struct digits_loss *l = &m->loss;
  ck_assert_msg(l->kind == DIGITS_LOST && stability_is_loss(l->formula), "%s loses nothing there", field[0]);
  double c = condition_of(m, s);
  ck_assert_msg(fabs(fmax(c, 0) - fmax(l->condition, 0)) < 0.01, "%s: condition 2^%g, adjoint 2^%g", field[0], c,
                l->condition);
  ck_assert_msg(isnan(l->predicted) || l->predicted * log10(2) > l->observed - 1, "%s: predicted %g of %g", field[0],
                l->predicted * log10(2), l->observed);
}

/* A function of the program. */
static void check_mended(struct measured *m, struct digits_set *s, char **field) {
  (void)s;
  const struct digits_loss *l = &m->loss;
  ck_assert_msg(l->kind == DIGITS_LOST || l->kind == DIGITS_FAILED, "%s is not measured at %s", field[0], field[1]);
  if (l->kind == DIGITS_LOST)
    ck_assert_msg(!stability_is_loss(l->formula), "%s: error 2^%.1f, condition 2^%.1f", field[0], l->error,
                  l->condition);
}

static const struct {
  const char *path;
  int columns, least;
  void (*check)(struct measured *m, struct digits_set *s, char **field);
} on_file[] = {{"tests/oracle/stability.tsv", 4, 40, check_case},
               {"tests/stability.wc", 2, 80, check_worst},
               {"tests/kernels.wc", 2, 50, check_mended}};

TEST_EACH(points_on_file, COUNT(on_file)) {
  OWNED(digits_set) s;
  make_set(&s);
  OWNED(table) points = table_read(on_file[_i].path, on_file[_i].columns);
  ck_assert_int_ge(points.n, on_file[_i].least);
  for (int i = 0; i < points.n; i++) {
    struct measured m;
    measure(&m, &s, points.row[i][0], points.row[i][1]);
    on_file[_i].check(&m, &s, points.row[i]);
    digits_bench_clear(&m.w);
  }
}

/* What is studied has room for 32 inputs; each of these is a symbol of its own. */
TEST(more_inputs_than_there_is_room_for) {
  for (int n = DIGITS_INPUTS; n <= DIGITS_INPUTS + 1; n++) {
    LOCAL(model, many);
    OWNED(digits_set) s;
    struct digits_formula f;
    LOCAL(text, file, sum);
    for (int i = 0; i < n; i++) {
      text_printf(&file, "symbol q_%d\n", i);
      text_printf(&sum, "%sq_%d", i ? " + " : "", i);
    }
    goes_well(model_add_file(&many, scratch_put("many.eq", text_str(&file)), RANK_PAPER, &d));
    goes_well(digits_set_make(&s, &many, LAYER_CORRECTED, &d));
    if (n > DIGITS_INPUTS) {
      fails_as(digits_formula_of(&f, &s, "sum", text_str(&sum), "", &d), "sum has more than 32 inputs");
      continue;
    }
    goes_well(digits_formula_of(&f, &s, "sum", text_str(&sum), "", &d));
    digits_formula_clear(&f);
  }
}

/* --- What is studied, and where --- */

TEST(every_entry_is_enrolled) {
  static const char *const ids[] = {
      "H[4,2]",   "Gamma[1,2]",       "C[2,4]",   "D[1,3]",   "J[2,2]",     "J_a[1]",   "J_b[2]",
      "J_c[3,2]", "J_f[2,3]",         "N[4,4]",   "M[1,1]",   "eq-46.2[2]", "eq-53.2",  "eq-53.4",
      "omega_1",  "omega_2",          "lambda_1", "psi_2[2]", "ktilde_1",   "ktilde_7", "gammatilde_2",
      "eq-43.1",  "text-criterion.2", "H_31",     "P",        "N",          "h"};
  OWNED(digits_set) s;
  make_set(&s);
  for (size_t i = 0; i < COUNT(ids); i++) ck_assert_msg(digits_find(&s, ids[i]) != NULL, "%s is not studied", ids[i]);
}

/* Points of every region are in the domain, and those of a named neighbourhood are near what it is named after. */
TEST(regions_are_where_they_say) {
  OWNED(digits_set) s;
  uint64_t state = random_seed("regions");
  make_set(&s);
  struct digits_formula *f = digits_find(&s, "J[1,1]");
  slong chi = tape_input(&f->tape, "chi"), eta = tape_input(&f->tape, "eta"), z1 = tape_input(&f->tape, "z_100"),
        z2 = tape_input(&f->tape, "z_200");
  OWNED(digits_bench) w;
  int near_one = 0, near_pole = 0;
  digits_bench_init(&w, f);
  for (int k = 0; k < n_digits_regions; k++) {
    struct digits_place *p = digits_place_new(k, &w, &s);
    const char *id = digits_region[k].id;
    for (int i = 0; p && i < 40; i++) {
      double u[DIGITS_COORDINATES], x[DIGITS_INPUTS];
      for (int j = 0; j < DIGITS_COORDINATES; j++) u[j] = random_unit(&state);
      if (!digits_point(x, p, u)) continue;
      ck_assert_msg(x[chi] > 0 && x[chi] < 1 && x[eta] > 0, "%s: chi = %a", id, x[chi]);
      if (strcmp(id, "chi-to-1") == 0) ck_assert_double_ge(x[chi], 0.5);
      if (strcmp(id, "chi-to-0") == 0) ck_assert_double_le(x[chi], 0.1001);
      if (strcmp(id, "eta-to-infinity") == 0) ck_assert_double_ge(x[eta], 1);
      near_one += strcmp(id, "chi-eta-near-1") == 0 && fabs(x[chi] * x[eta] - 1) < 1e-6;
      near_pole += strcmp(id, "pole-z_20") == 0 && fabs(x[z2] - x[z1]) < 1e-6 * fabs(x[z1]);
    }
    digits_place_free(p);
  }
  ck_assert_int_gt(near_one, 10);
  ck_assert_int_gt(near_pole, 5);
}

/* A few formulas between them have points in every region; the planted ones have not. */
TEST(every_region_is_reached) {
  static const char *const some[] = {"P", "M[1,1]", "S_f[4]", "eq-53.2", "d_02", "Gamma[1,2]", "J[1,1]"};
  run(some, 7, true, 2, -1);
  int empty = stability_empty_region(&r);
  ck_assert_msg(empty < 0, "no point in %s", r.region[empty < 0 ? 0 : empty].id);
  RUN(true, 1, -1, "steady");
  ck_assert_str_eq(r.region[stability_empty_region(&r)].id, "chi-to-0"); /* the first that is not about times */
  ck_assert_int_gt((int)stability_region_points(&r, 0), 0);
}

TABLE(ends, "tests/cases/region_ends.tsv", 5);
enum { REGION, FORMULA, INPUT, BEGIN, END }; /* its columns */

/* The coordinates 0 and 1 - 2^-53 are the ends that the region's words promise. */
TEST(regions_reach_their_ends) {
  OWNED(digits_set) s;
  make_set(&s);
  for (int i = 0; i < ends.n; i++) {
    char *const *row = ends.row[i];
    struct digits_formula *f = digits_find(&s, row[FORMULA]);
    OWNED(digits_bench) w;
    int region = 0;
    while (strcmp(digits_region[region].id, row[REGION]) != 0) region++;
    digits_bench_init(&w, f);
    struct digits_place *p = digits_place_new(region, &w, &s);
    ck_assert_msg(p != NULL, "%s is not for %s", row[REGION], row[FORMULA]);
    for (int last = 0; last < 2; last++) {
      double u[DIGITS_COORDINATES], x[DIGITS_INPUTS], is = last ? atof(row[END]) : atof(row[BEGIN]);
      for (int k = 0; k < DIGITS_COORDINATES; k++) u[k] = last ? 1 - 0x1p-53 : 0;
      ck_assert(digits_point(x, p, u));
      double got = x[tape_input(&f->tape, row[INPUT])];
      ck_assert_msg(fabs(got / is - 1) < 1e-9, "%s: %s = %g, not %g", row[REGION], row[INPUT], got, is);
    }
    digits_place_free(p);
  }
}

/* --- The program's own functions --- */

/* Every result of every function, over all regions: within the bound, or a status.  In make check one result of the
   return map, all of which come from one pass. */
TEST(functions_of_the_program_keep_their_digits) {
  const char *const only[] = {"dyn_flow",           "dyn_flow_matrix",
                              "dyn_local_jacobian", "dyn_switching",
                              "dyn_switching_rate", every_case() ? "dyn_return_map" : "dyn_return_map[4]",
                              "dyn_orbit_warm"};
  long points = 0, failures = 0;
  run(only, 7, true, 2, -1);
  ck_assert_int_gt(r.n_formulas, 170);
  for (long i = 0; i < r.n_rows; i++) {
    const struct stability_row *row = &r.row[i];
    const struct stability_formula *f = &r.formula[row->formula];
    ck_assert(f->kernel);
    ck_assert_msg(!row->at_fault, "%s loses %.1f digits, the problem %.1f, at %s", f->id, row->observed, row->problem,
                  row->witness);
    points += row->points;
    failures += row->failures;
  }
  ck_assert_int_gt((int)points, 8000);
  ck_assert_msg(4 * failures < points, "%ld of %ld points have no value", failures, points);
}

/* --- The same bytes --- */

static void all_reports(struct text *out, int jobs) {
  static const char *const only[] = {"planted", "eq-40d", "eq-32"};
  run(only, 3, true, jobs, LAYER_CORRECTED);
  report_stability_json(out, &r);
  report_stability_markdown(out, &r);
  report_stability_tsv(out, &r);
  report_stability_text(out, &r);
  stability_result_clear(&r);
}

TEST(any_number_of_processes_gives_the_same_bytes) {
  LOCAL(text, a, b);
  all_reports(&a, 1);
  all_reports(&b, 3);
  ck_assert_int_gt((int)a.len, 10000);
  ck_assert_str_eq(text_str(&a), text_str(&b));
}

/* --- The picture --- */

/* Where the first part of a class begins, and its width, in cells from the lower left corner of the frame. */
static void part_of(double at[3], const char *svg, const char *class) {
  double x, y, width, height, to;
  const char *frame = strstr(svg, "class=\"frame\""), *part = frame ? strstr(frame, class) : NULL;
  ck_assert_msg(part != NULL, "%s", class);
  ck_assert_int_eq(
      sscanf(strstr(frame, " x="), " x=\"%lf\" y=\"%lf\" width=\"%lf\" height=\"%lf\"", &x, &y, &width, &height), 4);
  ck_assert_int_eq(sscanf(strstr(part, " d="), " d=\"M%lf %lfH%lf", &at[0], &at[1], &to), 3);
  at[2] = (to - at[0]) * STABILITY_MAP / width;
  at[0] = (at[0] - x) * STABILITY_MAP / width;
  at[1] = (y + height - at[1]) * STABILITY_MAP / height;
}

TEST(a_map_is_a_picture) {
  static struct stability_map map = {.x = "chi", .y = "t_a"};
  struct stability_formula formula = {.id = "eq-1"};
  struct stability_result of_map = {.layer = "printed", .formula = &formula, .map = &map, .n_maps = 1};
  OWNED(text) svg = {0};
  for (int i = 0; i < STABILITY_MAP; i++) map.x_at[i] = map.y_at[i] = 0.8 * (i - STABILITY_MAP / 2);
  map.lost[0][0] = INFINITY;
  for (int k = 5; k < 8; k++) map.lost[20][k] = 9.96; /* 10.0 in the table */
  map.lost[40][40] = NAN;
  report_stability_picture(&svg, &of_map, 0, "map-1");
  static const struct {
    const char *class;
    double at[3];
  } parts[] = {{"\"shade d0\"", {1, 0, 40}},
               {"\"shade d5\"", {5, 20, 3}},
               {"\"shade d8\"", {0, 0, 1}},
               {"\"shade d9\"", {40, 40, 1}}};
  for (size_t i = 0; i < COUNT(parts); i++) {
    double at[3];
    part_of(at, text_str(&svg), parts[i].class);
    for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(at[k], parts[i].at[k], 0.02);
  }
  const char *frame = strstr(text_str(&svg), "class=\"frame\"");
  ck_assert(!strstr(frame, "shade d4") && !strstr(frame + 1, "class=\"frame\"")); /* one panel */
  ck_assert(strstr(text_str(&svg), "digits lost by eq-1, printed</text>"));
  shell_well("\"$Y\" -c 'import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])' %s",
             scratch_put_n("map.xml", svg.data, svg.len));
}
