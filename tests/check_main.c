/* Runs every suite, or that of CK_RUN_SUITE, each test in a process of its own so that one that aborts or hangs fails
   alone; Check's summary is the last line.  A test may take two minutes, and all such limits are five times as long:
   they end what hangs, and machines are slow or busy.  Tests of many minutes run only when asked for, by
   CK_INCLUDE_TAGS=exhaustive. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "num/flint_compat.h"
#include "suites.h"

int main(void) {
  setenv("CK_DEFAULT_TIMEOUT", "120", 0);
  setenv("CK_TIMEOUT_MULTIPLIER", "5", 0);
  bool chosen = getenv("CK_INCLUDE_TAGS") || getenv("CK_EXCLUDE_TAGS"); /* tests by their tags: perhaps none */
  if (!getenv("CK_INCLUDE_TAGS")) setenv("CK_EXCLUDE_TAGS", "exhaustive", 0);
  SRunner *r = srunner_create(base_suite());
  srunner_add_suite(r, tex_suite());
  srunner_add_suite(r, latex_suite());
  srunner_add_suite(r, num_suite());
  srunner_add_suite(r, solve_suite());
  srunner_add_suite(r, expr_suite());
  srunner_add_suite(r, edit_suite());
  srunner_add_suite(r, tape_suite());
  srunner_add_suite(r, model_suite());
  srunner_add_suite(r, dynamics_suite());
  srunner_add_suite(r, map_suite());
  srunner_add_suite(r, given_suite());
  srunner_add_suite(r, complete_suite());
  srunner_add_suite(r, branches_suite());
  srunner_add_suite(r, coulomb_suite());
  srunner_add_suite(r, audit_suite());
  srunner_add_suite(r, plan_suite());
  srunner_add_suite(r, argument_suite());
  srunner_add_suite(r, law_suite());
  srunner_add_suite(r, title_suite());
  srunner_add_suite(r, rules_suite());
  srunner_add_suite(r, another_suite());
  srunner_add_suite(r, readings_suite());
  srunner_add_suite(r, jacobian_suite());
  srunner_add_suite(r, behaviour_suite());
  srunner_add_suite(r, mech_suite());
  srunner_add_suite(r, routes_suite());
  srunner_add_suite(r, errata_suite());
  srunner_add_suite(r, referee_suite());
  srunner_add_suite(r, exact_suite());
  srunner_add_suite(r, stable_suite());
  srunner_add_suite(r, certify_suite());
  srunner_add_suite(r, html_suite());
  srunner_add_suite(r, pictures_suite());
  srunner_add_suite(r, diff_suite());
  srunner_add_suite(r, quotes_suite());
  srunner_add_suite(r, report_suite());
  srunner_add_suite(r, cli_suite());
  srunner_add_suite(r, orbit_suite());
  srunner_add_suite(r, terminal_suite());
  srunner_add_suite(r, mutate_suite());
  srunner_add_suite(r, damage_suite());
  srunner_add_suite(r, bifurcate_suite());
  srunner_add_suite(r, box_suite());
  srunner_add_suite(r, basin_suite());
  srunner_add_suite(r, sincos_suite());
  srunner_add_suite(r, double_double_suite());
  srunner_add_suite(r, batch_suite());
  srunner_add_suite(r, return_map_suite());
  srunner_add_suite(r, warm_suite());
  srunner_add_suite(r, bench_suite());
  srunner_add_suite(r, stiff_suite());
  srunner_add_suite(r, bench_pages_suite());
  srunner_add_suite(r, sweep_suite());
  srunner_add_suite(r, stability_suite());
  srunner_add_suite(r, scene_suite());
  srunner_add_suite(r, words_suite());
  srunner_add_suite(r, hostile_suite());
  srunner_add_suite(r, messages_suite());
  srunner_add_suite(r, library_suite());
  srunner_add_suite(r, python_suite());
  srunner_run_all(r, CK_NORMAL);
  int failed = srunner_ntests_failed(r);
  if (srunner_ntests_run(r) == 0 && !chosen) {
    fprintf(stderr, "check: there is no suite %s\n", getenv("CK_RUN_SUITE"));
    failed = 1;
  }
  fflush(stdout);
  /* in one process a failed test leaves its memory: a list of leaks would hide its name */
  if (failed) _Exit(EXIT_FAILURE);
  srunner_free(r);
  flint_cleanup();
  mpfr_free_cache();
  return EXIT_SUCCESS;
}
