/* The harness of the benchmarks: true errors, failures that stay failures, and the Pareto front.  Times are not tested.

   Truths are of motion/, which other suites hold against tests/oracle, and methods of many makes are held against them.
   The jobs that show how the harness judges are made here, of functions whose values and condition numbers are known:
   x y and x^2. */
#include <time.h>

#include "bench/jobs.h"
#include "paper_model.h"
#include "rational.h"
#include "test.h"

/* Where methods begin is beside the time that they are to find. */
TEST(a_hint_is_beside_its_time) {
  for (double t = 1e-3; t < 1e3; t *= 7) ck_assert(bench_hint(t) != t && fabs(bench_hint(t) - t) < 0.02 * t);
}

/* --- Every method of every job is as close as its arithmetic and its setting promise. --- */

/* log10 of the error that a row may have.  Differences: the least of truncation and rounding decides, so only the best
   of their steps is held to anything (best_of). */
static double allowed(const struct bench_row *r) {
  const struct bench_method *m = r->method;
  if (m->kind == SET_TOLERANCE) return log10(r->setting) + 4.3;
  if (m->kind == SET_BITS && strcmp(m->id, "fd-mpfr") == 0) return 4 - r->setting * log10(2) * 2 / 3;
  if (m->kind == SET_BITS) return 8 - r->setting * log10(2);
  if (m->kind == SET_NONE) return strcmp(m->id, "automatic") == 0 ? -9 : -11.5;
  return 0;
}

/* What a method of differences reaches at its best step. */
static double best_of(const struct bench_table *t, const char *id) {
  double best = 0;
  for (int i = 0; i < t->n; i++)
    if (strcmp(t->row[i].method->id, id) == 0 && !t->row[i].failure) best = fmin(best, t->row[i].worst);
  return best;
}

static void check_rows(const struct bench_table *t) {
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    if (r->method->kind == SET_STEP || r->method->absent) continue;
    ck_assert_msg(!r->failure, "%s, %s, %g: %s", t->job->id, r->method->id, r->setting, r->failure);
    ck_assert_msg(r->worst <= allowed(r), "%s, %s, %g: 10^%.1f", t->job->id, r->method->id, r->setting, r->worst);
    ck_assert(r->median <= r->worst && r->least_ns > 0 && r->median_ns >= r->least_ns && r->steps > 0);
  }
}

/* Each method stands in the table, at each of its settings. */
static void check_listed(const struct bench_table *t) {
  int rows = 0;
  for (int k = 0; k < t->job->n_methods; k++) {
    const struct bench_method *m = &t->job->methods[k];
    const double *s = m->quick ? m->quick : m->settings;
    int n = m->kind == SET_NONE || m->absent ? 1 : m->quick ? m->n_quick : m->n;
    for (int i = 0; i < n && !m->absent; i++)
      ck_assert_msg(bench_find(t, m->id, m->kind == SET_NONE ? NAN : s[i]) != NULL, "%s %s", t->job->id, m->id);
    rows += n;
  }
  ck_assert_int_eq(t->n, rows);
}

TEST_EACH(every_method_keeps_its_promise, 4) {
  OWNED(bench_table) t;
  OWNED(model) m = paper_model(NULL);
  ck_assert_int_lt(_i, n_bench_jobs);
  ck_assert(bench_run(&t, bench_jobs[_i], &(struct bench_env){.model = &m}, true));
  ck_assert_int_eq(t.cases, bench_jobs[_i]->n_quick);
  ck_assert(t.truth_digits >= 60 && t.floor > 0x1p-54 && t.floor < 1e-11);
  check_listed(&t);
  check_rows(&t);
  if (bench_jobs[_i] == &bench_jacobian) { /* powers of the rounding: 1/2, 2/3, 4/5 with the steps that there are */
    ck_assert(best_of(&t, "forward") < -6 && best_of(&t, "forward") > -9);
    ck_assert(best_of(&t, "central") < -8 && best_of(&t, "central") > -12);
    ck_assert(best_of(&t, "richardson") < -9.5 && best_of(&t, "gsl-central") < -8);
    ck_assert(best_of(&t, "fd-mpfr-256") < -45);
  }
}

/* Without the paper's equations its methods fail, and the others do not. */
TEST(formulas_that_are_not_there) {
  OWNED(bench_table) t;
  ck_assert(bench_run(&t, &bench_propagator, &(struct bench_env){.model = NULL}, true));
  const struct bench_row *r = bench_find(&t, "paper-modal", NAN);
  ck_assert_str_eq(r->failure, "cannot be set up");
  ck_assert(!r->front && isnan(r->least_ns) && isnan(r->worst));
  ck_assert_ptr_null(bench_find(&t, "closed-double", NAN)->failure);
}

/* --- A method that is off, in each job. --- */

static const struct bench_method *method_of(const struct bench_job *job, const char *id) {
  for (int i = 0; i < job->n_methods; i++)
    if (strcmp(job->methods[i].id, id) == 0) return &job->methods[i];
  ck_abort_msg("no method %s", id);
}

/* Another method of the job, whose outputs are moved by 2^-20 of themselves. */
static const struct bench_method *moved_base;

static void *open_moved(const struct bench_method *m, double setting, const struct bench_env *env) {
  static char nothing;
  (void)m;
  return moved_base->open ? moved_base->open(moved_base, setting, env) : &nothing;
}
static void close_moved(void *self) {
  if (moved_base->close) moved_base->close(self);
}
static int run_moved(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  int status = moved_base->run(self, out, steps, c);
  const struct num_type *type = out->ctx.type;
  OWNED(num_vec) factor = vec_new(1, out->ctx);
  type->set_d(num_vec_at(&factor, 0), 1 + 0x1p-20, out->ctx.prec);
  for (slong i = 0; i < out->len; i++)
    type->mul(num_vec_at(out, i), num_vec_at(out, i), num_vec_at(&factor, 0), out->ctx.prec);
  return status;
}

/* In double the error is shown as large as it is; a ball beside the truth is no result at all. */
TEST_EACH(a_method_that_is_off_is_shown_so, 4) {
  static const char *const base[][2] = {{"closed-double", "closed-arb"},
                                        {"closed-double", "closed-arb"},
                                        {"arc-implicit", "implicit-arb"},
                                        {"return-map", "find-arb"}};
  static const double bits[] = {128};
  struct bench_job job = *bench_jobs[_i];
  for (int k = 0; k < 2; k++) {
    OWNED(bench_table) t;
    moved_base = method_of(bench_jobs[_i], base[_i][k]);
    struct bench_method moved = *moved_base;
    moved.open = open_moved;
    moved.close = close_moved;
    moved.run = run_moved;
    moved.settings = moved.quick = bits;
    moved.n = moved.n_quick = 1;
    job.methods = &moved;
    job.n_methods = 1;
    job.n_quick = 4;
    ck_assert(bench_run(&t, &job, &(struct bench_env){.model = NULL}, true));
    const struct bench_row *r = &t.row[0];
    if (k == 0)
      ck_assert_msg(!r->failure && fabs(r->worst + 20 * log10(2)) < 1e-3, "%s: 10^%.3f", job.id, r->worst);
    else
      ck_assert_msg(r->failure && strcmp(r->failure, "a ball without the true value") == 0, "%s", job.id);
  }
}

/* --- How the harness judges. --- */

/* (x, y) -> (x y, x^2), in two groups. */
static const int two_groups[] = {0, 1};

static void place_pair(double *x, const double *u) {
  x[0] = 1 + u[0];
  x[1] = 2 + u[1];
}

static int truth_pair(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                      const double *near) {
  (void)given, (void)hint, (void)near;
  const void *x = num_vec_at(in, 0), *y = num_vec_at(in, 1);
  return num_arb.mul(num_vec_at(out, 0), x, y, out->ctx.prec) | num_arb.mul(num_vec_at(out, 1), x, x, out->ctx.prec);
}

/* What a method does: the steps that it says it took, the factor of its second output, which is the smaller one and has
   a scale of its own, how many outputs it writes, what it says, and for which x; how long it takes, in ms. */
static const struct acting {
  const char *id;
  int steps;
  double factor;
  int outputs, status;
  double beyond;
  long ms;
} actings[] = {
    {"right", 1, 1, 2, SS_OK, 0, 0},        {"off", 3, 1 + 0x1p-20, 2, SS_OK, 0, 0}, {"stuck", 0, 1, 2, SS_OK, 0, 0},
    {"half", 1, 1, 1, SS_OK, 0, 0},         {"nothing", 1, 1, 0, SS_OK, 0, 0},       {"wrong", 1, 1.6, 2, SS_OK, 0, 0},
    {"refuse", 1, 1, 2, SS_DOMAIN, 1.5, 0}, {"give-up", 1, 1, 2, SS_UNABLE, 0, 0},   {"slow", 1, 1, 2, SS_OK, 0, 60}};

static void *open_acting(const struct bench_method *m, double setting, const struct bench_env *env) {
  (void)setting, (void)env;
  for (size_t i = 0; i < COUNT(actings); i++)
    if (strcmp(actings[i].id, m->id) == 0) return (void *)(uintptr_t)&actings[i];
  return NULL;
}

static int run_acting(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  const struct acting *a = self;
  double *o = (double *)(void *)out->data;
  if (a->ms) nanosleep(&(struct timespec){0, a->ms * 1000000}, NULL);
  *steps = a->steps;
  if (a->outputs > 0) o[0] = c->x[0] * c->x[1];
  if (a->outputs > 1) o[1] = c->x[0] * c->x[0] * a->factor;
  return c->x[0] > a->beyond ? a->status : SS_OK;
}
/* Balls: right, and beside the truth by 2^-40 of it. */
static int run_ball(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  (void)self;
  *steps = 1;
  return truth_pair(out, NULL, NULL, &c->in, NULL);
}
static int run_ball_beside(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  int status = run_ball(self, out, steps, c);
  arb_ptr x = num_vec_at(out, 1);
  NUMBERS(arb, shift);
  arb_mul_2exp_si(shift, x, -40);
  arb_add(x, x, shift, 128);
  return status;
}
static int run_ball_wide(void *self, struct num_vec *out, long *steps, const struct bench_case *c) {
  int status = run_ball(self, out, steps, c);
  mag_set_d(arb_radref((arb_ptr)num_vec_at(out, 1)), 0x1p-30);
  return status;
}

#define ACTING(id)                                                                                                     \
  { id, "", .type = &num_double, .open = open_acting, .run = run_acting }
static const struct bench_method judged[] = {
    ACTING("right"),
    ACTING("off"),
    ACTING("stuck"),
    ACTING("half"),
    ACTING("nothing"),
    ACTING("wrong"),
    ACTING("refuse"),
    ACTING("give-up"),
    ACTING("slow"),
    {"ball", "", .type = &num_arb, .bits = 128, .run = run_ball},
    {"ball-beside", "", .type = &num_arb, .bits = 128, .run = run_ball_beside},
    {"ball-wide", "", .type = &num_arb, .bits = 128, .run = run_ball_wide},
    ACTING("unopened"),
};
static const struct bench_job pair_job = {.id = "pair",
                                          .title = "x y and x^2",
                                          .inputs = "x, y",
                                          .outputs = "both",
                                          .n_in = 2,
                                          .n_out = 2,
                                          .n_cases = 12,
                                          .n_quick = 12,
                                          .worst_condition = 100,
                                          .group = two_groups,
                                          .place = place_pair,
                                          .truth = truth_pair,
                                          .methods = judged,
                                          .n_methods = COUNT(judged)};

static struct bench_table pair;

static void run_pair(void) {
  ck_assert(bench_run(&pair, &pair_job, &(struct bench_env){.model = NULL}, true));
}
static void clear_pair(void) {
  bench_table_clear(&pair);
}

CASE("judging", .once = {run_pair, clear_pair});

TABLE(failing, "tests/cases/bench_failures.tsv", 3);
enum { METHOD, FAILURE, FAILURES }; /* its columns */

TEST_EACH(failures_say_why_and_have_no_time, failing.n) {
  char *const *row = failing.row[_i];
  const int failures = atoi(row[FAILURES]);
  const struct bench_row *r = bench_find(&pair, row[METHOD], NAN);
  ck_assert_ptr_nonnull(r->failure);
  ck_assert_str_eq(r->failure, row[FAILURE]);
  if (failures >= 0)
    ck_assert_int_eq(r->failures, failures);
  else
    ck_assert(r->failures > 0 && r->failures < 12);
  ck_assert(!r->front && isnan(r->least_ns) && isnan(r->median_ns) && isnan(r->worst));
  LOCAL(text, figure, tsv);
  bench_figure(&figure, &pair, false);
  bench_tsv(&tsv, &pair);
  const char *title = formatted(">%s</text>", row[METHOD]);
  const char *state = formatted("\t%s\t%s\t\t\tfailed: %s", row[METHOD], r->method->type->name, r->failure);
  ck_assert_msg(!strstr(text_str(&figure), title), "a failed method in the figure");
  ck_assert_ptr_nonnull(strstr(text_str(&figure), ">right</text>"));
  ck_assert_msg(strstr(text_str(&tsv), state) != NULL, "%s", text_str(&tsv));
}

TEST(errors_are_true_ones) {
  const struct bench_row *r = bench_find(&pair, "off", NAN);
  ck_assert_ptr_null(r->failure);
  ck_assert_double_eq_tol(r->worst, -20 * log10(2), 1e-4);
  ck_assert_double_eq_tol(r->median, -20 * log10(2), 1e-4);
  ck_assert(r->steps == 3);
  r = bench_find(&pair, "right", NAN);
  ck_assert(r->worst < -53 * log10(2) + 0.01 && r->worst > -60 * log10(2));
  r = bench_find(&pair, "ball", NAN);
  ck_assert(!r->failure && r->worst < -120 * log10(2));
  r = bench_find(&pair, "ball-wide", NAN); /* the radius counts: 2^-30 of x^2, which lies between 1 and 4 */
  ck_assert(!r->failure && r->worst <= -30 * log10(2) + 1e-6 && r->worst >= -32 * log10(2));
}

/* Both outputs change by twice the relative change of the inputs. */
TEST(the_floor_is_the_condition) {
  ck_assert_double_eq_tol(pair.floor, 0x1p-52, 1e-3 * 0x1p-52);
  ck_assert(pair.truth_digits > 90);
  ck_assert_int_eq(pair.cases, 12);
}

TEST(a_slow_method_is_capped) {
  const struct bench_row *r = bench_find(&pair, "slow", NAN);
  ck_assert_ptr_null(r->failure);
  ck_assert(r->capped && r->cases >= 1 && r->cases < 12);
  ck_assert(!bench_find(&pair, "right", NAN)->capped);
}

/* Of the methods with the error of `right` none is as slow as `slow`, which is therefore not on the front. */
TEST(the_front_is_no_worse_than_any) {
  ck_assert(bench_find(&pair, "ball", NAN)->front);
  ck_assert(!bench_find(&pair, "slow", NAN)->front);
  for (int i = 0; i < pair.n; i++)
    for (int k = 0; k < pair.n; k++) {
      const struct bench_row *a = &pair.row[i], *b = &pair.row[k];
      bool beaten = !b->failure && b->worst < a->worst && b->least_ns < a->least_ns;
      ck_assert(!(a->front && (a->failure || beaten)));
    }
}

/* A job without enough inputs is refused, and says so. */
static int truth_never(struct num_vec *out, struct num_vec *given, double *hint, const struct num_vec *in,
                       const double *near) {
  (void)out, (void)given, (void)hint, (void)in, (void)near;
  return SS_DOMAIN;
}

TEST(no_truth_no_job) {
  struct bench_job job = pair_job;
  struct bench_table t;
  job.truth = truth_never;
  ck_assert(!bench_run(&t, &job, &(struct bench_env){.model = NULL}, true));
  ck_assert_int_eq(t.n, 0);
  bench_table_clear(&t);
  job = pair_job;
  job.worst_condition = 1.5; /* it is 2 everywhere */
  ck_assert(!bench_run(&t, &job, &(struct bench_env){.model = NULL}, true));
  bench_table_clear(&t);
}

TEST(tables_are_well_formed) {
  LOCAL(text, tsv);
  bench_tsv(&tsv, &pair);
  int columns = 0, lines = 0, tabs = 0;
  for (const char *p = text_str(&tsv); *p; p++) {
    tabs += *p == '\t';
    if (*p != '\n') continue;
    if (lines++ == 0) columns = tabs;
    ck_assert_int_eq(tabs, columns);
    tabs = 0;
  }
  ck_assert_int_eq(columns, 14);
  ck_assert_int_eq(lines, pair.n + 1);
}

/* The time of balls is read on a straight line between two of their settings, at MPFR's error; a setting rougher than
   that error is not enough, and where all are too rough nothing is said. */
TEST(the_price_of_proof_is_read_at_equal_error) {
  const struct bench_method *plain = method_of(&bench_map, "closed-mpfr"), *balls = method_of(&bench_map, "closed-arb");
  struct bench_row rows[] = {{.method = plain, .setting = 64, .worst = -18, .least_ns = 100},
                             {.method = plain, .setting = 128, .worst = -38, .least_ns = 150},
                             {.method = plain, .setting = 256, .worst = -76, .least_ns = 200},
                             {.method = balls, .setting = 64, .worst = -19, .least_ns = 300},
                             {.method = balls, .setting = 128, .worst = -29, .least_ns = 400, .failure = "gives up"},
                             {.method = balls, .setting = 256, .worst = -59, .least_ns = 500}};
  struct bench_table t = {.job = &bench_map, .row = rows, .n = COUNT(rows)};
  struct bench_cost cost[4];
  ck_assert_int_eq(bench_costs(cost, 4, &t), 2);
  ck_assert_double_eq_tol(cost[0].balls_ns, 300, 1e-9);
  ck_assert_double_eq_tol(cost[1].balls_ns, 300 + 200 * 19.0 / 40, 1e-9);
  ck_assert_double_eq_tol(cost[1].digits, 38, 1e-9);
  ck_assert_double_eq_tol(cost[1].plain_ns, 150, 1e-9);
  ck_assert_int_eq(bench_costs(cost, 1, &t), 1);
}

/* Differences have a second figure, over their steps. */
TEST(steps_have_a_figure_of_their_own) {
  LOCAL(text, figure);
  OWNED(bench_table) t;
  ck_assert(!bench_has_steps(&pair));
  struct bench_job job = bench_jacobian;
  struct bench_method central = *method_of(&job, "central");
  job.methods = &central;
  job.n_methods = 1;
  ck_assert(bench_run(&t, &job, &(struct bench_env){.model = NULL}, true));
  bench_figure(&figure, &t, true);
  ck_assert(bench_has_steps(&t) && strstr(text_str(&figure), ">step</text>"));
  ck_assert_ptr_nonnull(strstr(text_str(&figure), ">central</text>"));
}
