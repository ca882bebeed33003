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
  SRunner *r = srunner_create(NULL);
#define SUITE(name) srunner_add_suite(r, name##_suite());
#include "suites.def"
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
