/* The routes: what they share, that the study of them notices what is wrong, and how the report says it.

   The second opinions: sets worked out by hand, a paper whose formulas are left uncorrected, and results made up. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "audit/routes.h"
#include "scratch.h"
#include "stickslip/report.h"
#include "suites.h"

/* --- The table. --- */

static const struct route_info *row_of(const char *quantity, const char *name) {
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    if (strcmp(route_quantity_name[route_table[i].quantity], quantity) == 0 && strcmp(route_table[i].name, name) == 0)
      return &route_table[i];
  ck_abort_msg("no route %s to %s", name, quantity);
}

START_TEST(every_row_is_one_route) {
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    const struct route_info *r = &route_table[i];
    ck_assert_msg(r->name && r->does && r->means, "row %d", i);
    ck_assert_msg((r->digits > 0) == (r->quantity < N_STUDIED), "%s", r->name);
    ck_assert(i == 0 || r->quantity >= route_table[i - 1].quantity);
    for (int k = 0; k < i; k++)
      ck_assert_msg(route_table[k].quantity != r->quantity || strcmp(route_table[k].name, r->name) != 0, "%s", r->name);
  }
}
END_TEST

/* What two routes share, from what is known of how they are programmed. */
START_TEST(shared_means) {
  static const struct {
    const char *quantity, *a, *b;
    unsigned want;
  } cases[] = {{"propagator D, Gamma, H, C", "taylor", "gsl", MEANS_SYSTEM},
               {"propagator D, Gamma, H, C", "closed form", "gsl", 0},
               {"propagator D, Gamma, H, C", "paper", "closed form", 0},
               {"times and states of the events", "closed form", "exponential", MEANS_EVENTS},
               {"times and states of the events", "closed form", "integration", 0},
               {"times and states of the events", "simulation", "integration", MEANS_COULOMB},
               {"return Jacobian", "implicit", "saltation", MEANS_ENDS | MEANS_EVENTS},
               {"return Jacobian", "implicit", "integration", 0},
               {"return Jacobian", "fd", "integration", MEANS_DIFFERENCES}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    unsigned both = row_of(cases[i].quantity, cases[i].a)->means & row_of(cases[i].quantity, cases[i].b)->means;
    ck_assert_msg(both == cases[i].want, "%s, %s: %x", cases[i].a, cases[i].b, both);
  }
  struct text t;
  text_init(&t);
  route_means_print(&t, 0);
  ck_assert_str_eq(text_str(&t), "nothing");
  text_reset(&t);
  route_means_print(&t, MEANS_COULOMB | MEANS_DIFFERENCES);
  ck_assert_str_eq(text_str(&t), "central differences, Coulomb's law in x");
  text_clear(&t);
}
END_TEST

static void ask_for_a_route_that_does_not_exist(void) {
  routes_independent("balls", "guess");
}

START_TEST(an_unknown_route_is_a_broken_invariant) {
  ck_assert_int_lt(child_end(ask_for_a_route_that_does_not_exist), 0);
}
END_TEST

/* --- The study. --- */

static struct scene scene;

static void open_study(void) {
  struct diag d;
  scratch_open();
  diag_init(&d);
  ck_assert_msg(scene_load(&scene, "paper", "verify", &d), "%s", d.message);
}

static void close_study(void) {
  scene_clear(&scene);
  scratch_close();
}

/* An audit of no claim: the study alone, under the errata (or none) and a text of our own (or none). */
static void study(struct audit_result *r, const char *folder, const char *errata, const char *over) {
  struct model m;
  struct claims none = {.n = 0};
  struct diag d;
  const struct audit_options opt = {NULL, 0, NULL, NULL};
  diag_init(&d);
  model_init(&m);
  audit_result_init(r);
  bool ok = model_add_folder(&m, folder, RANK_PAPER, &d) && (!errata || model_add_file(&m, errata, RANK_ERRATA, &d)) &&
            (!over || model_add_file(&m, scratch_put("over.eq", over), RANK_ERRATA, &d)) &&
            audit_run(r, &m, &none, &none, &scene, &opt, &d);
  ck_assert_msg(ok, "%s", d.message);
  model_clear(&m);
}

static bool concerns(const struct route_pair *p, const char *route) {
  return strcmp(p->first, route) == 0 || strcmp(p->second, route) == 0;
}

/* Exactly the pairs of the paper's formulas for the given quantities disagree. */
static void check_pairs(const struct audit_result *r, const char *const *wrong, int n_wrong) {
  long bad = 0;
  for (size_t i = 0; i < r->n_pairs; i++) {
    const struct route_pair *p = &r->pairs[i];
    bool want = true;
    for (int k = 0; k < n_wrong; k++) want = want && !(concerns(p, "paper") && strcmp(p->quantity, wrong[k]) == 0);
    ck_assert_msg(p->within == want, "%s: %s, %s: %s", p->quantity, p->first, p->second, p->within ? "in" : "out");
    bad += !p->within;
  }
  ck_assert_int_eq(audit_result_unexpected(r), bad);
}

/* Pairs of five routes to a propagator, two to its derivative, four to the events, five to the Jacobian. */
START_TEST(all_pairs_agree_on_enough_points) {
  struct audit_result r;
  study(&r, "verify/paper", "verify/errata.eq", NULL);
  ck_assert_uint_eq(r.n_pairs, 10 + 1 + 6 + 10);
  check_pairs(&r, NULL, 0);
  for (size_t i = 0; i < r.n_pairs; i++) {
    const struct route_pair *p = &r.pairs[i];
    bool machine = concerns(p, "gsl") || concerns(p, "integration") || concerns(p, "simulation");
    ck_assert_msg(p->comparisons >= 10 + 1, "%s, %s: %ld", p->first, p->second, p->comparisons);
    ck_assert_msg((p->largest == NULL) == machine && (p->worst == NULL) == machine, "%s, %s", p->first, p->second);
    ck_assert(p->machine_largest < 1e-5 && p->machine_worst);
  }
  ck_assert_uint_eq(r.n_skipped, 0);
  audit_result_clear(&r);
}
END_TEST

/* Uncorrected, (10) is wrong in D(t) and several of (26)-(40) in J; each spoils its own quantities and no other. */
START_TEST(an_uncorrected_formula_disagrees_with_every_route) {
  static const char *const wrong[] = {"return Jacobian", "propagator D, Gamma, H, C", "derivative of a propagator"};
  struct audit_result r;
  study(&r, "verify/paper", NULL, NULL);
  check_pairs(&r, wrong, 3);
  audit_result_clear(&r);
  study(&r, "verify/paper", NULL, "define D\n  section: prediction\n  D(t) := [I, t*I; 0, I]\n");
  check_pairs(&r, wrong, 1);
  audit_result_clear(&r);
}
END_TEST

START_TEST(a_paper_that_cannot_be_read_is_left_out) {
  struct audit_result r;
  scratch_put("one.eq", "symbol chi\n");
  study(&r, scratch_path(""), NULL, NULL);
  for (size_t i = 0; i < r.n_pairs; i++) ck_assert(!concerns(&r.pairs[i], "paper"));
  ck_assert_uint_eq(r.n_pairs, 6 + 6 + 6);
  check_pairs(&r, NULL, 0);
  ck_assert_uint_eq(r.n_skipped, 1);
  ck_assert(strstr(r.skipped[0].what, "paper's formulas") != NULL);
  audit_result_clear(&r);
}
END_TEST

/* --- The report. --- */

START_TEST(a_disagreement_comes_first) {
  struct route_pair pairs[] = {
      {"return Jacobian", "fd", "implicit", "the flow", 3, "1e-40", true, "1e-48", "chi = 1/2", 1e-48, "chi = 1/2"},
      {"return Jacobian", "fd", "integration", "nothing", 4, "1e-5", false, NULL, NULL, 0.25, "chi = 1/3"}};
  struct audit_result r;
  struct text md, json, run, line;
  audit_result_init(&r);
  r.scene = r.title = "made up";
  r.pairs = ss_malloc(sizeof pairs);
  memcpy(r.pairs, pairs, sizeof pairs);
  r.n_pairs = r.cap_pairs = 2;
  ck_assert_int_eq(audit_result_unexpected(&r), 1);
  text_init(&md);
  text_init(&json);
  text_init(&run);
  text_init(&line);
  report_markdown(&md, &r);
  report_json(&json, &r);
  report_run(&run, &r, 1);
  report_line(&line, &r);
  const char *first = strstr(text_str(&md), "\n## ");
  const char *row = "| fd, integration | nothing | 4 | 1e-5 | **beyond**: - | - |\n";
  ck_assert(first && strncmp(first, "\n## Routes that disagree\n", 25) == 0);
  const char *again = strstr(first, row);
  ck_assert_msg(again && strstr(again + 1, row) && again < strstr(first, "| fd, implicit |"), "%s", text_str(&md));
  ck_assert(strstr(text_str(&md), "| fd, implicit | the flow | 3 | 1e-40 | 1e-48 | chi = 1/2 |\n") != NULL);
  ck_assert(strstr(text_str(&json), "\"within\": false") && !strstr(text_str(&json), "0.25"));
  ck_assert(strstr(text_str(&run), "\"largest\": \"0.25\"") && strstr(text_str(&run), "\"worst\": \"chi = 1/3\""));
  ck_assert(strstr(text_str(&line), "1 NOT as recorded") != NULL);
  text_clear(&line);
  text_clear(&run);
  text_clear(&json);
  text_clear(&md);
  audit_result_clear(&r);
}
END_TEST

Suite *routes_suite(void) {
  Suite *s = suite_create("routes");
  TCase *c = tcase_create("table");
  tcase_add_test(c, every_row_is_one_route);
  tcase_add_test(c, shared_means);
  tcase_add_test(c, an_unknown_route_is_a_broken_invariant);
  suite_add_tcase(s, c);
  c = tcase_create("study");
  tcase_add_unchecked_fixture(c, open_study, close_study);
  tcase_add_test(c, all_pairs_agree_on_enough_points);
  tcase_add_test(c, an_uncorrected_formula_disagrees_with_every_route);
  tcase_add_test(c, a_paper_that_cannot_be_read_is_left_out);
  suite_add_tcase(s, c);
  c = tcase_create("report");
  tcase_add_test(c, a_disagreement_comes_first);
  suite_add_tcase(s, c);
  return s;
}
