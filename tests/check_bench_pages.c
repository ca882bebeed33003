/* What the benchmarks say about their rows: peers measured elsewhere, which method to use, what is not installed, where
   the time goes, both sides of claims.

   Rows are made here, so that what must be chosen is known. */
#include "bench/jobs.h"
#include "motion/dynamics.h"
#include "paper_model.h"
#include "rational.h"
#include "test.h"

/* --- Which method. --- */

static const struct bench_method by_hand = {"by-hand", "", .type = &num_double, .bare = true};
static const struct bench_method quick = {"quick", "", .type = &num_double};
static const struct bench_method broken = {"broken", "", .type = &num_double};
static const struct bench_method exact = {"exact", "", .type = &num_mpfr, .kind = SET_BITS};
static const struct bench_method balls = {"balls", "", .type = &num_arb, .kind = SET_BITS};
static const struct bench_method other = {"other", "", .arithmetic = "gp", .kind = SET_DIGITS};

static struct bench_row rows[] = {{.method = &by_hand, .cases = 4, .worst = -15, .median = -16, .least_ns = 1},
                                  {.method = &quick, .cases = 4, .worst = -13, .median = -16, .least_ns = 10},
                                  {.method = &broken, .cases = 4, .failures = 1, .failure = "gives up", .least_ns = 2},
                                  {.method = &exact, .setting = 64, .cases = 4, .worst = -18, .least_ns = 40},
                                  {.method = &exact, .setting = 128, .cases = 4, .worst = -37, .least_ns = 50},
                                  {.method = &balls, .setting = 64, .cases = 4, .worst = -11, .least_ns = 60},
                                  {.method = &balls, .setting = 128, .cases = 4, .worst = -35, .least_ns = 70},
                                  {.method = &other, .setting = 50, .cases = 4, .worst = -50, .least_ns = 900}};
static const struct bench_method *methods[] = {&by_hand, &quick, &broken, &exact, &balls, &other};
static const struct bench_table table = {.job = &bench_map,
                                         .method = methods,
                                         .n_methods = COUNT(methods),
                                         .row = rows,
                                         .n = COUNT(rows),
                                         .cases = 4,
                                         .floor = 1e-15,
                                         .truth_digits = 90};

static const char *best(double log_error, bool rigorous) {
  static char name[80];
  const struct bench_row *r = bench_best(&table, log_error, rigorous);
  snprintf(name, sizeof name, "%s %g", r ? r->method->id : "none", r ? r->setting : 0);
  return name;
}

TEST(the_fastest_that_is_close_enough_is_advised) {
  ck_assert_str_eq(best(-6, false), "quick 0"); /* not the bare one, not the failed one */
  ck_assert_str_eq(best(-12, false), "quick 0");
  ck_assert_str_eq(best(-14, false), "exact 64");
  ck_assert_str_eq(best(-30, false), "exact 128");
  ck_assert_str_eq(best(-40, false), "other 50");
  ck_assert_str_eq(best(-60, false), "none 0");
  ck_assert_str_eq(best(-6, true), "balls 64");
  ck_assert_str_eq(best(-12, true), "balls 128");
  ck_assert_str_eq(best(-40, true), "none 0");
}

static bool holds(const struct text *t, const char *what) {
  return strstr(text_str(t), what) != NULL;
}

TEST(the_first_page_begins_with_advice) {
  LOCAL(text, page);
  struct bench_table one = table;
  struct bench_result r = {.table = &one, .n = 1};
  bench_markdown(&page, &r, true);
  ck_assert(holds(&page, "## Which method to use"));
  ck_assert(holds(&page, "| map | 1e-6 | quick | 10.0 ns | balls, bits 64 | 60.0 ns |\n"));
  ck_assert(holds(&page, "| map | 1e-30 | exact, bits 128 | 50.0 ns | balls, bits 128 | 70.0 ns |\n"));
  ck_assert(!holds(&page, "1e-100") && holds(&page, "(map.md)") && !holds(&page, "## Ratios"));
  text_reset(&page);
  bench_job_markdown(&page, &table, true);
  ck_assert(holds(&page, "| by-hand |  (bare) |") && holds(&page, "| failed: gives up (1 of 4) |"));
  ck_assert(holds(&page, "| other | digits 50 | 1.0e-50 |"));
}

/* What stands between two texts, the first of which is looked for from there on; empty where it is not found. */
static const char *between(const char *from, const char *begin, const char *end) {
  static char found[4][200];
  static int n;
  char *out = found[n++ % 4];
  const char *at = from ? strstr(from, begin) : NULL, *stop = at ? strstr(at + strlen(begin), end) : NULL;
  snprintf(out, sizeof found[0], "%.*s", stop ? (int)(stop - at - (int)strlen(begin)) : 0,
           at ? at + strlen(begin) : "");
  return out;
}

/* How the k-th curve looks where there are no colours: its marker and its dashes. */
static const char *look(char out[400], const char *svg, int k) {
  const char *begin = formatted("<marker id=\"map-k%d\"", k);
  const char *marker = strstr(svg, begin), *curve = marker ? strstr(marker, "class=\"curve ") : NULL;
  snprintf(out, 400, "%s%s", between(marker, " stroke=\"currentColor\"", "/>"), between(curve, "stroke=", " color"));
  ck_assert_msg(marker && curve && !strstr(marker + 1, begin), "%s", begin);
  return out;
}

/* 52 methods differ in marker and dash together, and the first 24 in colour. */
TEST(figures_tell_methods_apart) {
  enum { MANY = 52, COLOURS = 24 };
  static struct bench_method method[MANY];
  static char id[MANY][16];
  LOCAL(text, svg);
  OWNED(bench_table) t = {.job = &bench_map, .floor = 1e-15};
  for (int k = 0; k < MANY; k++) {
    snprintf(id[k], sizeof id[k], "m%d", k);
    method[k] = (struct bench_method){id[k], "", .type = &num_double};
    bench_add_row(&t, &method[k], &(struct bench_row){.cases = 1, .worst = -12, .least_ns = 10 + k});
  }
  bench_figure(&svg, &t, false);
  for (int k = 0; k < MANY; k++)
    for (int i = 0; i < k; i++) {
      char looks[2][400], begin[2][40];
      ck_assert_str_ne(look(looks[0], text_str(&svg), k), look(looks[1], text_str(&svg), i));
      snprintf(begin[0], sizeof begin[0], "<marker id=\"map-k%d\"", k);
      snprintf(begin[1], sizeof begin[1], "<marker id=\"map-k%d\"", i);
      if (k >= COLOURS) continue;
      ck_assert_str_ne(between(strstr(text_str(&svg), begin[0]), "color=\"", "\""),
                       between(strstr(text_str(&svg), begin[1]), "color=\"", "\""));
    }
}

/* The points of the k-th curve in the panel, the first of them 1; how many numbers there are. */
static int points(double x[4], const char *svg, int panel, int k) {
  const char *id = formatted("(#map-%d)", panel);
  const char *begin = formatted("class=\"curve k%d\"", k);
  const char *at = strstr(svg, id), *d = between(at ? strstr(at, begin) : NULL, "d=\"M", "\"");
  return sscanf(d, "%lf %lf %lf %lf", &x[0], &x[1], &x[2], &x[3]);
}

/* Distances in the picture are those of logarithms, in the second panel of the logarithms of the digits; the key names
   each method once.  By hand: 1 ns and 1e-15; quick: 10 ns and 1e-13; in balls: 60 ns and 1e-11. */
TEST(figures_have_logarithmic_axes) {
  LOCAL(text, svg);
  double at[5][4]; /* of each curve, x and y by turns */
  bench_figure(&svg, &table, false);
  ck_assert_int_eq(points(at[0], text_str(&svg), 1, 0), 2);
  ck_assert_int_eq(points(at[1], text_str(&svg), 1, 1), 2);
  ck_assert_int_eq(points(at[3], text_str(&svg), 1, 3), 4); /* the second is far below the frame */
  ck_assert_double_eq_tol((at[3][0] - at[1][0]) / (at[1][0] - at[0][0]), log10(6), 2e-3);
  ck_assert_double_eq_tol((at[0][1] - at[3][1]) / (at[0][1] - at[1][1]), 2, 1e-2);
  ck_assert(at[1][0] > at[0][0] && at[1][1] < at[0][1]);
  ck_assert_int_eq(points(at[2], text_str(&svg), 2, 2), 4);
  ck_assert_int_eq(points(at[4], text_str(&svg), 2, 4), 2);
  ck_assert_double_eq_tol((at[4][1] - at[2][3]) / (at[2][3] - at[2][1]), log10(50.0 / 37) / log10(37.0 / 18), 2e-3);
  ck_assert(at[4][1] > at[2][3] && at[4][0] > at[2][2]);
  ck_assert(holds(&svg, "limit of rounded inputs</text>") &&
            holds(&svg, "10<tspan dy=\"-4\" font-size=\"9\">\xe2\x88\x92"
                        "50<"));
  const char *key = strstr(text_str(&svg), ">other</text>");
  ck_assert(key && !strstr(key + 1, ">other</text>") && !holds(&svg, ">broken</text>"));
}

/* --- Peers. --- */

#define HEAD                                                                                                           \
  "# GP: 1.2\njob\tmethod\ttitle\tarithmetic\tkind\tsetting\tbare\tstate\tinputs\tfailures\terror_worst\terror_"       \
  "median\tns_least\tns_median\n"
#define GOOD "map\tpeer\tA peer\tgp\tdigits\t50\tno\tok\t3\t0\t1e-49\t1e-50\t700\t800\n"

CASE("files", .each = {scratch_open, scratch_close});

TEST(peers_stand_among_the_others) {
  OWNED(bench_peers) p;
  OWNED(bench_table) t = {.job = &bench_map, .cases = 4};
  LOCAL(text, out);
  const char *path =
      scratch_put("peers.tsv", HEAD GOOD "map\tgone\tNot here\tgp\t\t\tno\tnot installed\t0\t0\t-\t-\t-\t-\n"
                                         "map\tpeer\tA peer\tgp\tdigits\t18\tno\tfailed: gives up\t3\t1\t-\t-\t-\t-\n"
                                         "orbit\tpeer\tA peer\tgp\t\t\tyes\tok\t3\t0\t1e-9\t1e-9\t7\t8\n");
  goes_well(bench_peers_read(&p, path, &d));
  bench_peers_add(&t, &p);
  ck_assert_str_eq(text_str(&p.versions), "GP: 1.2\n");
  ck_assert_int_eq(t.n, 3);
  ck_assert_int_eq(t.n_methods, 2);
  const struct bench_row *r = bench_find(&t, "peer", 50);
  ck_assert(r && r->front && r->capped && r->cases == 3 && fabs(r->worst + 49) < 1e-9 && r->least_ns == 700);
  ck_assert(bench_best(&t, -40, false) == r && !bench_best(&t, -40, true));
  r = bench_find(&t, "peer", 18);
  ck_assert(r->failure && !r->front && isnan(r->least_ns) && isnan(r->worst));
  bench_tsv(&out, &t);
  ck_assert(holds(&out, "map\tgone\tgp\t\t\tnot installed\t0\t0\t-\t-\t-\t-\t"));
  ck_assert(holds(&out, "map\tpeer\tgp\tdigits\t18\tfailed: gives up (1 of 3)\t"));
  ck_assert(holds(&out, "map\tpeer\tgp\tdigits\t50\tok\t3\t0\t1.0e-49\t1.0e-50\t700\t800\t\t0\tyes\n"));
}

TABLE(peers_refused, "tests/cases/peers_refused.tsv", 2);
enum { TEXT, PLACE }; /* its columns */

/* Each mistake is refused where it stands. */
TEST_EACH(tables_that_cannot_be_are_refused, peers_refused.n) {
  char *const *row = peers_refused.row[_i];
  static const char *const abbreviated[][2] = {{"head", HEAD}, {"good", GOOD}, {NULL, NULL}};
  LOCAL(text, t);
  field_expand(&t, row[TEXT], abbreviated);
  OWNED(bench_peers) p;
  fails_with(bench_peers_read(&p, scratch_put("peers.tsv", text_str(&t)), &d), row[PLACE]);
}

/* --- What is not installed. --- */

CASE("bench_pages");

TEST(what_is_absent_has_one_row) {
  OWNED(bench_table) t;
  struct bench_method absent = {"absent", "", .type = &num_double, .kind = SET_TOLERANCE, .absent = true};
  struct bench_job job = bench_propagator;
  job.methods = &absent;
  job.n_methods = 1;
  ck_assert(bench_run(&t, &job, &(struct bench_env){.model = NULL}, true));
  ck_assert_int_eq(t.n, 1);
  ck_assert_str_eq(t.row[0].failure, "not installed");
  ck_assert(!t.row[0].front && isnan(t.row[0].least_ns) && t.row[0].cases == 0);
}

/* --- Where the time goes. --- */

static struct bench_ratio profiled(const char *name) {
  struct bench_ratio ratio = {.value = 9, .goal = 1, .at_most = true};
  struct bench_result r = {.ratio = &ratio, .n_ratios = 1, .quick = true};
  snprintf(ratio.name, sizeof ratio.name, "%s", name);
  bench_profiles(&r, &(struct bench_env){.model = NULL});
  return ratio;
}

static double sum(const struct bench_part *part, int n) {
  double s = 0;
  for (int i = 0; i < n; i++) {
    ck_assert(part[i].where[0] && part[i].share > 0 && (i == 0 || part[i].share <= part[i - 1].share));
    s += part[i].share;
  }
  return s;
}

TEST_EACH(a_missed_goal_has_its_profile, 5) {
  static const struct {
    const char *ratio, *method;
    double setting;
  } cases[] = {{"map in double, first roots searched / hand-written map, no search", "closed-double", NAN},
               {"CVODE at its best accuracy / map in double", "closed-double", NAN},
               {"MPFR map at 256 bits / 11 mpfr_sin_cos", "closed-mpfr", 256},
               {"MPFR map at 128 bits / map in balls", "closed-arb", 128},
               {"GSL's hybrids / the suite's orbit and multiplier", "from-guess", NAN}};
  struct bench_ratio r = profiled(cases[_i].ratio);
  if (!r.profile.method) return; /* a system that does not tell the program counter */
  ck_assert_str_eq(r.profile.method->id, cases[_i].method);
  ck_assert(isnan(cases[_i].setting) || r.profile.setting == cases[_i].setting);
  ck_assert(r.profile.samples > 0 && r.profile.n_libraries > 0);
  ck_assert(sum(r.profile.library, r.profile.n_libraries) <= 1 + 1e-9);
  ck_assert(sum(r.profile.function, r.profile.n_functions) <= 1 + 1e-9);
  LOCAL(text, page);
  bench_markdown(&page, &(struct bench_result){.ratio = &r, .n_ratios = 1}, false);
  ck_assert(holds(&page, "0 of 1 measured goals are met") && holds(&page, "| method | samples |"));
  ck_assert(holds(&page, r.profile.library[0].where));
}

TEST(other_ratios_have_none) {
  struct bench_ratio met = {.name = "map in double / x", .value = 0.5, .goal = 1, .at_most = true};
  bench_profiles(&(struct bench_result){.ratio = &met, .n_ratios = 1}, &(struct bench_env){.model = NULL});
  ck_assert_ptr_null(met.profile.method);
  ck_assert_ptr_null(profiled("MPFR map without a precision").profile.method);
  ck_assert_ptr_null(profiled("something else").profile.method);
}

/* --- Both sides of claims. --- */

/* A radius of 10^-20: absolute below 1, relative above it; a ball without an end is close to nothing. */
TEST(closeness_is_relative_above_one) {
  OWNED(num_vec) v = vec_new(2, num_ctx_arb(200));
  arb_ptr small = num_vec_at(&v, 0), large = num_vec_at(&v, 1);
  arb_set_d(small, 0.25);
  arb_set_d(large, 1e9);
  ck_assert(bench_close_enough(&v, 60));
  mag_set_d(arb_radref(small), 1e-20);
  ck_assert(bench_close_enough(&v, 19) && !bench_close_enough(&v, 21));
  mag_set_d(arb_radref(large), 1e-15);
  ck_assert(bench_close_enough(&v, 19) && !bench_close_enough(&v, 25));
  mag_set_d(arb_radref(large), 1e-8);
  ck_assert(bench_close_enough(&v, 16) && !bench_close_enough(&v, 18));
  arb_pos_inf(large);
  ck_assert(!bench_close_enough(&v, 1));
}

TEST(sides_of_claims_come_to_any_digits) {
  OWNED(claims) claims;
  OWNED(model) m = paper_model(NULL);
  paper_claims(&claims, NULL);
  OWNED(scene) scene = scene_at("paper");
  const struct bench_env env = {.model = &m, .claims = &claims, .scene = &scene};
  struct bench_sides *s = bench_sides_new(&env, claim_with_id(&claims, "eq-27")); /* a matrix and the model's */
  ck_assert(s && bench_sides_run(s, 15) && bench_sides_run(s, 700));
  bench_sides_free(s);
  ck_assert_ptr_null(bench_sides_new(&env, claim_with_id(&claims, "num-t_a"))); /* a printed number has one side */
}
