/* The routes: what they share, that the study of them notices what is wrong, and how the report says it.

   The second opinions: sets worked out by hand, a paper whose formulas are left uncorrected, and results made up. */
#include "every.h"
#include "known_orbits.h"
#include "motion/long_run.h"
#include "paper_model.h"
#include "params.h"
#include "rational.h"
#include "record/routes.h"
#include "report/report.h"
#include "run/audit.h"
#include "test.h"
#include "value/coulomb_setup.h"
#include "value/paper_orbits.h"

/* --- The table. --- */

static const struct route_info *row_of(const char *quantity, const char *name) {
  for (int i = 0; i < N_ROUTE_ROWS; i++)
    if (strcmp(route_quantity_name[route_table[i].quantity], quantity) == 0 && strcmp(route_table[i].name, name) == 0)
      return &route_table[i];
  ck_abort_msg("no route %s to %s", name, quantity);
}

TEST(every_row_is_one_route) {
  for (int i = 0; i < N_ROUTE_ROWS; i++) {
    const struct route_info *r = &route_table[i];
    ck_assert_msg(r->name && r->does && r->means, "row %d", i);
    ck_assert_msg((r->digits > 0) == (r->quantity < N_STUDIED), "%s", r->name);
    ck_assert(i == 0 || r->quantity >= route_table[i - 1].quantity);
    for (int k = 0; k < i; k++)
      ck_assert_msg(route_table[k].quantity != r->quantity || strcmp(route_table[k].name, r->name) != 0, "%s", r->name);
  }
}

TABLE(shared, "tests/cases/routes_share.tsv", 4);
enum { QUANTITY, ROUTE, OTHER_ROUTE, MEANS }; /* its columns */

/* What two routes share, from what is known of how they are programmed. */
TEST_EACH(shared_means, shared.n) {
  char *const *row = shared.row[_i];
  LOCAL(text, t);
  route_means_print(&t, row_of(row[QUANTITY], row[ROUTE])->means & row_of(row[QUANTITY], row[OTHER_ROUTE])->means);
  ck_assert_msg(strcmp(text_str(&t), row[MEANS]) == 0, "%s, %s: %s", row[ROUTE], row[OTHER_ROUTE], text_str(&t));
}

static void ask_for_a_route_that_does_not_exist(void) {
  routes_independent("balls", "guess");
}

TEST(an_unknown_route_is_a_broken_invariant) {
  ck_assert_int_lt(child_end(ask_for_a_route_that_does_not_exist), 0);
}

/* --- The study. --- */

static struct scene scene;

static void open_study(void) {
  scratch_open();
  scene = scene_at("paper");
}

static void close_study(void) {
  scene_clear(&scene);
  scratch_close();
}

/* An audit of no claim: the study alone. */
static struct audit_result study(const struct scene *s, const struct paper_layers *with) {
  struct claims none = {.n = 0};
  const struct audit_options opt = {.n_only = 0};
  struct audit_result r;
  audit_result_init(&r);
  OWNED(model) m = paper_model(with);
  goes_well(audit_run(&r, &m, &none, &none, s, &opt, &d));
  return r;
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

CASE("study", .once = {open_study, close_study});

/* Pairs of five routes to a propagator, two to its derivative, five to the events, six to the Jacobian. */
TEST(all_pairs_agree_on_enough_points) {
  OWNED(audit_result) r = study(&scene, NULL);
  ck_assert_uint_eq(r.n_pairs, 10 + 1 + 10 + 15);
  check_pairs(&r, NULL, 0);
  for (size_t i = 0; i < r.n_pairs; i++) {
    const struct route_pair *p = &r.pairs[i];
    bool machine = concerns(p, "gsl") || concerns(p, "integration") || concerns(p, "simulation") ||
                   concerns(p, "system"); /* from a start in double */
    ck_assert_msg(p->comparisons >= 10 + 1, "%s, %s: %ld", p->first, p->second, p->comparisons);
    ck_assert_msg((p->largest == NULL) == machine && (p->worst == NULL) == machine, "%s, %s", p->first, p->second);
    ck_assert(p->machine_largest < 1e-5 && p->machine_worst);
  }
  for (size_t i = 0; i < r.n_skipped; i++) /* of the studies nothing is left out */
    ck_assert_msg(strstr(r.skipped[i].what, "stud") == NULL && strstr(r.skipped[i].what, "the routes on") == NULL &&
                      strstr(r.skipped[i].what, "long runs") == NULL,
                  "%s", r.skipped[i].what);
  ck_assert_uint_eq(r.n_controls, 2);
  for (size_t i = 0; i < r.n_controls; i++)
    ck_assert(r.controls[i].noticed && r.controls[i].verdict == VERDICT_REFUTED);
  ck_assert_uint_eq(r.n_long_runs, 4);
  for (size_t i = 0; i < r.n_long_runs; i++) {
    const struct long_result *l = &r.long_runs[i];
    bool unstable = fabs(strtod(l->multiplier, NULL)) > 1;
    ck_assert_msg(l->obeys && l->displaced && (strcmp(l->expected, "never") != 0) == unstable, "%s", l->orbit);
  }
}

/* Its orbits have e1 and e2 that are known as balls alone: the routes that want them exactly are not asked there. */
TEST(a_scene_without_forces) {
  OWNED(scene) s = scene_at("paper-times");
  OWNED(audit_result) r = study(&s, NULL);
  ck_assert_uint_eq(r.n_pairs, 10 + 1 + 10 + 15);
  check_pairs(&r, NULL, 0);
  bool said = false;
  for (size_t i = 0; i < r.n_skipped; i++) said = said || strstr(r.skipped[i].why, "e1 and e2");
  ck_assert(said);
}

/* Uncorrected, (10) is wrong in D(t) and several of (26)-(40) in J; each spoils its own quantities and no other. */
TEST(an_uncorrected_formula_disagrees_with_every_route) {
  static const char *const wrong[] = {"return Jacobian", "propagator D, Gamma, H, C", "derivative of a propagator"};
  OWNED(audit_result) r = study(&scene, &(struct paper_layers){.errata = ""});
  check_pairs(&r, wrong, 3);
  const char *own = scratch_put("own.eq", "define D\n  section: prediction\n  D(t) := [I, t*I; 0, I]\n");
  OWNED(audit_result) mended = study(&scene, &(struct paper_layers){.errata = own});
  check_pairs(&mended, wrong, 1);
}

/* The set beyond-pi has an orbit whose phase H is so short that the ODE map is smooth only very near to it: differences
   must find a step that suits. */
TEST(differences_near_a_jump) {
  OWNED(scene) s = scene_at(scratch_put("short.scene", "chi = 0.71\neta = 7.7\nV = 0.28\ne1 = 1.07\ne2 = 0.852\n"));
  OWNED(audit_result) r = study(&s, NULL);
  check_pairs(&r, NULL, 0);
  for (size_t i = 0; i < r.n_pairs; i++)
    if (concerns(&r.pairs[i], "integration") && strcmp(r.pairs[i].quantity, "return Jacobian") == 0)
      ck_assert_msg(r.pairs[i].machine_largest < 1e-5, "%g %ld", r.pairs[i].machine_largest, r.pairs[i].comparisons);
}

/* The return Jacobian's enclosures lose digits as V goes to 0; a route in balls gets the bits that its digits need.
   Below 1e-16 the moments of one period's events are one double, and the integration tells its phases all the same.
   That what is wrong is found there too is asked of the first belt, in make long of all; the last, for which all takes
   three times as long, is for make long. */
static const char *const slow_belts[] = {"1e-12", "1e-20", "1e-300"};

TEST_EACH(slow_belts_raise_no_false_alarm, every_case() ? 3 : 2) {
  static const char *const wrong[] = {"return Jacobian", "propagator D, Gamma, H, C", "derivative of a propagator"};
  const char *path =
      scratch_print("slow.scene", "chi = 0.8\neta = 1\nV = %s\ne1 = 2.7844\ne2 = 0.8587\n", slow_belts[_i]);
  OWNED(scene) s = scene_at(path);
  OWNED(audit_result) r = study(&s, NULL);
  check_pairs(&r, NULL, 0);
  if (_i % every(3) != 0) return;
  OWNED(audit_result) printed = study(&s, &(struct paper_layers){.errata = ""});
  check_pairs(&printed, wrong, 3);
}

/* A formula without a value is no agreement. */
TEST(a_route_without_an_answer_disagrees) {
  static const char *const wrong[] = {"propagator D, Gamma, H, C", "derivative of a propagator", "return Jacobian"};
  const char *own = scratch_put("own.eq", "define D\n  section: prediction\n  D(t) := [I, (t/(chi - chi))*I; 0, I]\n");
  OWNED(audit_result) r = study(&scene, &(struct paper_layers){.errata = own});
  check_pairs(&r, wrong, 3);
  ck_assert(r.pairs[0].largest && strcmp(r.pairs[0].largest, "no answer") == 0 &&
            strncmp(r.pairs[0].worst, "D, ", 3) == 0);
}

TEST(a_paper_that_cannot_be_read_is_left_out) {
  scratch_put("one.eq", "model: two masses on a belt\nsymbol chi\n");
  OWNED(audit_result) r = study(&scene, &(struct paper_layers){.paper = scratch_path(""), .errata = ""});
  for (size_t i = 0; i < r.n_pairs; i++) ck_assert(!concerns(&r.pairs[i], "paper"));
  ck_assert_uint_eq(r.n_pairs, 6 + 10 + 10);
  check_pairs(&r, NULL, 0);
  bool said = false;
  for (size_t i = 0; i < r.n_skipped; i++) said = said || strstr(r.skipped[i].what, "paper's formulas") != NULL;
  ck_assert(said);
}

/* --- The paper's route. --- */

static void check_close(mpfr_srcptr x, const char *decimal, double within) {
  MPFR_NUMBERS(300, y);
  ck_assert_int_eq(mpfr_set_str(y, decimal, 10, MPFR_RNDN), 0);
  mpfr_sub(y, y, x, MPFR_RNDN);
  ck_assert_msg(fabs(mpfr_get_d(y, MPFR_RNDN)) < within, "off %s by %g", decimal, mpfr_get_d(y, MPFR_RNDN));
}

CASE("paper route", .once = {scratch_open, scratch_close});

TEST(the_papers_route_from_any_two_quantities) {
  static const int column[N_ROUTE] = {KNOWN_TA, KNOWN_TB, KNOWN_TC, KNOWN_TD, KNOWN_Z10, KNOWN_Z20};
  char *const *orbit = known_orbit_named("paper", 1).field;
  OWNED(paper_orbits) list;
  const char *path =
      scratch_print("times.scene", "chi = 0.8\neta = 1\nV = 1\nt_b = %s\nt_c = %s\n", orbit[KNOWN_TB], orbit[KNOWN_TC]);
  OWNED(scene) s = scene_at(path);
  goes_well(audit_paper_orbits(&list, &s, 280, &d));
  bool found = false;
  for (size_t i = 0; i < list.n; i++) {
    const struct paper_orbit *p = &list.item[i];
    ck_assert(p->from == (slong)i && p->status == SS_OK);
    if (fabs(mpfr_get_d(num_vec_at(&p->route.x, 0), MPFR_RNDN) - 0.53228) > 1e-3) continue;
    for (int k = 0; k < N_ROUTE; k++) check_close(num_vec_at(&p->route.x, k), orbit[column[k]], 1e-55);
    ck_assert(p->nearest == p->from && arf_cmpabs_2exp_si(arb_midref(p->distance), -200) < 0);
    found = true;
  }
  ck_assert(found);
}

/* The set long-slip: from 2 % beside its first orbit the iteration leads nowhere, beside its fourth it comes back. */
TEST(the_papers_route_may_not_converge) {
  OWNED(paper_orbits) list;
  const char *path = scratch_put("long.scene", "chi = 0.87\neta = 0.32\nV = 0.45\ne1 = 0.242\ne2 = 0.279\n");
  OWNED(scene) s = scene_at(path);
  goes_well(audit_paper_orbits(&list, &s, 128, &d));
  ck_assert_uint_eq(list.n, 4);
  for (size_t i = 0; i < list.n; i++) ck_assert((list.item[i].status == SS_OK) == (list.item[i].nearest >= 0));
  ck_assert(list.item[0].status != SS_OK && list.item[3].nearest == 3);
}

/* --- Long runs. --- */

/* Admissible orbits of orbits.tsv. */
static const struct {
  const char *set;
  int index;
} beside[] = {{"two-admissible", 0}, {"paper", 1}, {"chi-large", 1}, {"long-slip2", 1}};
enum { STABLE, PAPER, FLIPPING, SHEDDING, N_BESIDE };

/* A number of its row. */
static double known_of(int which, int column) {
  return atof(known_orbit_named(beside[which].set, beside[which].index).field[column]);
}

static void setup_beside(struct coulomb_setup *sim, int which) {
  const fmpq *params = known_set_named(beside[which].set)->params;
  OWNED(dyn_orbits) list = orbits_of(params, 128);
  ck_assert_int_gt(list.n, beside[which].index);
  ck_assert_int_eq(coulomb_setup_on_orbit(sim, params, &list.orbit[beside[which].index], OWN_FRICTION), SS_OK);
}

static const struct long_pair pairs[N_LONG_PAIRS] = {
    {LONG_ODE, LONG_CLOSED}, {LONG_ODE, LONG_MPFR}, {LONG_CLOSED, LONG_MPFR}};

CASE("routes");

/* A displacement is multiplied by the trace, whatever the orbit. */
TEST_EACH(a_displacement_grows_by_the_multiplier, N_BESIDE) {
  struct coulomb_setup sim;
  struct long_growth g;
  setup_beside(&sim, _i);
  const double trace = known_of(_i, KNOWN_TRACE);
  ck_assert(fabs(sim.trace - trace) < 1e-6 && fabs(sim.period - known_of(_i, KNOWN_PERIOD)) < 1e-5);
  ck_assert(long_run_displaced(&g, sim.params, sim.start, sim.trace, 300 * sim.period));
  ck_assert_msg(fabs(g.log - log(fabs(trace))) < 1e-3, "%g", exp(g.log));
}

/* Rounding alone: from MPFR, which has 160 bits, the routes depart at the rate of the trace. */
TEST_RANGE(routes_leave_an_unstable_orbit_at_its_rate, PAPER, N_BESIDE) {
  struct coulomb_setup sim;
  OWNED(long_run) run;
  struct long_growth g;
  long periods = _i == PAPER ? 900 : 40;
  setup_beside(&sim, _i);
  ck_assert_int_eq(long_run_make(&run, sim.params, sim.start, periods, 4 * (double)periods * sim.period, 160), SS_OK);
  for (int k = 1; k < N_LONG_PAIRS; k++) {
    ck_assert(long_run_growth(&g, &run, pairs[k]));
    double want = log(fabs(known_of(_i, KNOWN_TRACE)));
    ck_assert_msg(fabs(g.log - want) < 0.02 * want, "%g", exp(g.log));
    long near = long_run_parting(&run, pairs[k], 1e-9), far = long_run_parting(&run, pairs[k], 1e-6);
    ck_assert_int_gt(near, 0);
    ck_assert_msg(fabs((double)(far - near) * want - log(1000)) < 2 * want + 0.2, "from %ld to %ld", near, far);
    ck_assert(long_run_most(&run, pairs[k]) > 1e-6 && long_run_parting(&run, pairs[k], 1e9) == 0);
  }
}

/* An orbit of the paper's forces at chi, the one that breaks no condition. */
static void setup_near_one(struct coulomb_setup *sim, const char *chi) {
  const char *const text[N_PARAMS] = {chi, "1", "1", "2.7844", "0.8587"};
  FREED_PARAMS fmpq *params = rationals(text, N_PARAMS);
  OWNED(dyn_orbits) list = orbits_of(params, 128);
  int status = SS_UNABLE;
  for (slong k = 0; k < list.n && status; k++)
    if (list.orbit[k].admissible == TRUTH_TRUE)
      status = coulomb_setup_on_orbit(sim, params, &list.orbit[k], OWN_FRICTION);
  ck_assert_int_eq(status, SS_OK);
}

/* Where positions are large, a run that has left its orbit is not taken for one beside it: within reach the rate is
   that of the trace, which the stretch beyond misses by a third. */
TEST(a_growth_ends_where_the_orbit_is_left) {
  struct coulomb_setup sim;
  OWNED(long_run) run;
  struct long_growth g;
  setup_near_one(&sim, "999/1000");
  double want = log(fabs(sim.trace));
  ck_assert(long_run_has_room(sim.params, sim.start));
  ck_assert_int_eq(long_run_make(&run, sim.params, sim.start, 326, 1e4, 160), SS_OK);
  run.reach = long_run_reach(sim.params, sim.start);
  for (int k = 1; k < N_LONG_PAIRS; k++) {
    ck_assert(long_run_growth(&g, &run, pairs[k]));
    ck_assert_msg(fabs(g.log - want) < 0.05 * want, "%g", exp(g.log));
  }
}

/* Differences of the integration keep their word where it can be kept, and say beforehand where it cannot. */
TEST(the_integration_near_chi_1) {
  struct coulomb_setup sim;
  double j[4], err;
  setup_near_one(&sim, "4/5");
  ck_assert(coulomb_return_jacobian_floor(sim.params, sim.start) < 1e-8);
  ck_assert(coulomb_event_floor(sim.params, sim.start) < 1e-9);
  setup_near_one(&sim, "999/1000");
  ck_assert(coulomb_return_jacobian_floor(sim.params, sim.start) < 1e-3);
  ck_assert_int_eq(coulomb_return_jacobian(j, &err, sim.params, sim.start), SS_OK);
  ck_assert_msg(fabs(j[0] + j[3] - sim.trace) <= 2 * err && err < 1e-2 * fabs(j[0]), "off by %g, stated %g",
                fabs(j[0] + j[3] - sim.trace), err);
  setup_near_one(&sim, "99999/100000");
  ck_assert(coulomb_return_jacobian_floor(sim.params, sim.start) > 1e-2);
  ck_assert(coulomb_event_floor(sim.params, sim.start) > 1e-3);
}

TEST(routes_stay_on_a_stable_orbit) {
  struct coulomb_setup sim;
  OWNED(long_run) run;
  struct long_growth g;
  setup_beside(&sim, STABLE);
  ck_assert_int_eq(long_run_make(&run, sim.params, sim.start, 50, 1e4, 128), SS_OK);
  for (int k = 0; k < N_LONG_PAIRS; k++) {
    ck_assert_int_eq(long_run_length(&run, pairs[k]), 50);
    ck_assert(long_run_most(&run, pairs[k]) < 1e-9 && long_run_parting(&run, pairs[k], 1e-9) == 0);
    ck_assert(!long_run_growth(&g, &run, pairs[k]));
  }
  for (int k = 0; k < N_LONG_ROUTES; k++) {
    ck_assert_int_eq(run.end[k], COULOMB_DONE);
    for (long i = 0; i < 50; i++) {
      ck_assert_uint_eq(run.at[k][i].events, 4 * (size_t)(i + 1));
      ck_assert(fabs(run.at[k][i].t - (double)(i + 1) * known_of(STABLE, KNOWN_PERIOD)) < 1e-6);
    }
  }
}

TEST(a_run_outside_the_domain) {
  struct coulomb_setup sim;
  OWNED(long_run) run;
  struct long_growth g;
  setup_beside(&sim, STABLE);
  sim.params[COULOMB_CHI] = 1;
  ck_assert(long_run_make(&run, sim.params, sim.start, 3, 100, 128) & SS_DOMAIN);
  ck_assert(long_run_length(&run, pairs[0]) == 0 && long_run_parting(&run, pairs[0], 0) == 0);
  ck_assert(!long_run_growth(&g, &run, pairs[0]) && long_run_most(&run, pairs[0]) == 0);
  ck_assert(!long_run_displaced(&g, sim.params, sim.start, 2, 100));
}

/* --- The report. --- */

TEST(a_disagreement_comes_first) {
  struct route_pair made_up[] = {
      {"return Jacobian", "fd", "implicit", "the flow", 3, "1e-40", true, "1e-48", "chi = 1/2", 1e-48, "chi = 1/2"},
      {"return Jacobian", "fd", "integration", "nothing", 4, "1e-5", false, NULL, NULL, 0.25, "chi = 1/3"}};
  LOCAL(audit_result, r);
  LOCAL(text, md, json, run, line);
  r.scene = r.title = r.model = "made up";
  r.pairs = ss_malloc(sizeof made_up);
  memcpy(r.pairs, made_up, sizeof made_up);
  r.n_pairs = r.cap_pairs = 2;
  struct long_result runs[] = {
      {.orbit = "kept", .multiplier = "-0.5", .expected = "never", .obeys = true, .displaced = true},
      {.orbit = "lost", .multiplier = "2", .expected = "about 35 periods", .displaced = true}};
  r.long_runs = ss_malloc(sizeof runs);
  memcpy(r.long_runs, runs, sizeof runs);
  r.n_long_runs = r.cap_long_runs = 2;
  ck_assert_int_eq(audit_result_unexpected(&r), 2);
  report_markdown(&md, &r);
  report_json(&json, &r);
  report_run(&run, &r, 1, "software");
  report_line(&line, &r);
  const char *first = strstr(text_str(&md), "\n## ");
  const char *row = "| fd, integration | nothing | 4 | 1e-5 | **beyond**: - | - |\n";
  ck_assert(first && strncmp(first, "\n## Routes that disagree\n", 25) == 0);
  const char *again = strstr(first, row);
  ck_assert_msg(again && strstr(again + 1, row) && again < strstr(first, "| fd, implicit |"), "%s", text_str(&md));
  ck_assert(strstr(text_str(&md), "| fd, implicit | the flow | 3 | 1e-40 | 1e-48 | chi = 1/2 |\n") != NULL);
  ck_assert(strstr(text_str(&json), "\"within\": false") && !strstr(text_str(&json), "0.25"));
  ck_assert(strstr(text_str(&run), "\"largest\": \"0.25\"") && strstr(text_str(&run), "\"worst\": \"chi = 1/3\""));
  ck_assert(strstr(text_str(&line), "2 NOT as recorded") != NULL);
  const char *lost = strstr(first, "\n## Long runs that the multiplier does not explain\n");
  ck_assert(lost && strstr(lost, "| lost | 2 | 0 | about 35 periods | **NO** | yes |\n") < strstr(lost, "| kept |"));
  ck_assert(strstr(text_str(&json), "\"obeys\": false") && !strstr(text_str(&json), "growth"));
}
