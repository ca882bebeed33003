/* Runs every suite, or that of CK_RUN_SUITE, each test in a process of its own so that one that aborts or hangs fails
   alone; Check's summary is the last line.  A test may take two minutes, and all such limits are five times as long:
   they end what hangs, and machines are slow or busy.  Tests of many minutes run only when asked for, by
   CK_INCLUDE_TAGS=exhaustive. */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "num/flint_compat.h"
#include "suite.h"
#include "table.h"

static struct suite_entry *entries; /* by suite, file and line */

static int compare(const struct suite_entry *x, const struct suite_entry *y) {
  int by_suite = strcmp(x->suite, y->suite), by_file = strcmp(x->file, y->file);
  return by_suite ? by_suite : by_file ? by_file : x->line - y->line;
}

void suite_enter(struct suite_entry *e) {
  const char *slash = strrchr(e->file, '/'), *name = strchr(slash ? slash : e->file, '_') + 1;
  snprintf(e->suite, sizeof e->suite, "%.*s", (int)strcspn(name, "."), name);
  struct suite_entry **at = &entries;
  while (*at && compare(*at, e) < 0) at = &(*at)->next;
  e->next = *at;
  *at = e;
}

/* The case that e opens, or goes on with: one of its name among those opened since the first entry of its suite. */
static TCase *case_of(Suite *s, const struct suite_entry *first, struct suite_entry *e) {
  bool name_alone = !e->each.open && !e->once.open && !e->seconds && !e->tags;
  for (const struct suite_entry *other = first; other != e; other = other->next) {
    if (!other->tcase || strcmp(other->name, e->name) != 0) continue;
    if (name_alone) return other->tcase;
    fprintf(stderr, "check: %s:%d: the case %s is that of line %d\n", e->file, e->line, e->name, other->line);
    exit(EXIT_FAILURE);
  }
  e->tcase = tcase_create(e->name);
  if (e->each.open) tcase_add_checked_fixture(e->tcase, e->each.open, e->each.close);
  if (e->once.open) tcase_add_unchecked_fixture(e->tcase, e->once.open, e->once.close);
  if (e->seconds) tcase_set_timeout(e->tcase, e->seconds);
  if (e->tags) tcase_set_tags(e->tcase, e->tags);
  suite_add_tcase(s, e->tcase);
  return e->tcase;
}

static void add_suites(SRunner *r) {
  const struct suite_entry *first = NULL;
  Suite *s = NULL;
  TCase *tcase = NULL;
  for (struct suite_entry *e = entries; e; e = e->next) {
    if (!first || strcmp(first->suite, e->suite) != 0) {
      first = e;
      tcase = NULL;
      s = suite_create(e->suite);
      srunner_add_suite(r, s);
    }
    if (e->table) *e->table = table_read(e->path, e->columns);
    if (e->add && !tcase) e->name = e->suite;
    if (e->name) tcase = case_of(s, first, e);
    if (e->add) e->add(tcase);
  }
}

int main(void) {
  setenv("CK_DEFAULT_TIMEOUT", "120", 0);
  setenv("CK_TIMEOUT_MULTIPLIER", "5", 0);
  bool chosen = getenv("CK_INCLUDE_TAGS") || getenv("CK_EXCLUDE_TAGS"); /* tests by their tags: perhaps none */
  if (!getenv("CK_INCLUDE_TAGS")) setenv("CK_EXCLUDE_TAGS", "exhaustive", 0);
  SRunner *r = srunner_create(NULL);
  add_suites(r);
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
