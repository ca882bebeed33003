/* Tests register themselves where they stand, so that none can be forgotten.  Those of tests/check_NAME.c, and of
   laws_NAME.c, are the suite NAME, in the order of their lines:

     CASE("files", .each = {scratch_open, scratch_close});
     TEST(a_file_is_read) { ... }
     TEST_EACH(files_that_are_refused, refused.n) { ... refused.row[_i] ... }

   A failure is told as FILE:LINE:F:CASE:TEST:_i: with what it says. */
#ifndef STICKSLIP_TESTS_SUITE_H
#define STICKSLIP_TESTS_SUITE_H

#include <check.h>

#include "base/arena.h"
#include "every.h"

struct table;

/* What surrounds tests: run around each one, in its process, or once around all of them. */
struct fixture {
  void (*open)(void), (*close)(void);
};

struct suite_entry {
  const char *file;
  int line;
  const char *name; /* opens a case, and how it is surrounded, what time its tests have (0: the usual), its tags */
  struct fixture each, once;
  int seconds;
  const char *tags;
  void (*add)(TCase *tcase); /* adds a test */
  struct table *table;       /* is read from a file */
  const char *path;
  int columns;
  char suite[40]; /* what the runner makes of it */
  TCase *tcase;
  struct suite_entry *next;
};
void suite_enter(struct suite_entry *e);

#define SUITE_ENTRY_AT(line_, ...)                                                                                     \
  __attribute__((constructor)) static void enter_##line_(void) {                                                       \
    static struct suite_entry e = {.file = __FILE__, .line = line_, __VA_ARGS__};                                      \
    suite_enter(&e);                                                                                                   \
  }
#define SUITE_ENTRY(line_, ...) SUITE_ENTRY_AT(line_, __VA_ARGS__)

/* Opens the case of the tests behind it: its name and members of struct suite_entry.  With a name alone, one that was
   opened before goes on.  Tests before any are in a case that has the name of the suite and nothing around it. */
#define CASE(...) SUITE_ENTRY(__LINE__, .name = __VA_ARGS__) struct suite_entry

/* A table that is read before any test runs, so that tests can be one for each row. */
#define TABLE(variable, path_, columns_)                                                                               \
  static struct table variable;                                                                                        \
  SUITE_ENTRY(__LINE__, .table = &variable, .path = path_, .columns = columns_) struct suite_entry

/* A test; one for each _i below n; one for every k-th of them, or each where all are asked for (tests/every.h); one
   for each _i from..to - 1. */
#define TEST(test)                 TEST_ADDED(test, tcase_add_test(tcase, test))
#define TEST_EACH(test, n)         TEST_RANGE(test, 0, n)
#define TEST_RANGE(test, from, to) TEST_ADDED(test, tcase_add_loop_test(tcase, test, from, to))
#define TEST_EVERY(test, k, n)                                                                                         \
  TEST_ADDED(test, for (int i = 0; i < (n); i += every(k)) tcase_add_loop_test(tcase, test, i, i + 1))

#define TEST_ADDED(test, add_it)                                                                                       \
  static void test##_steps(int _i);                                                                                    \
  START_TEST(test) {                                                                                                   \
    test##_steps(_i);                                                                                                  \
  }                                                                                                                    \
  END_TEST                                                                                                             \
  static void test##_add(TCase *tcase) {                                                                               \
    add_it;                                                                                                            \
  }                                                                                                                    \
  SUITE_ENTRY(__LINE__, .add = test##_add)                                                                             \
  static void test##_steps(__attribute__((unused)) int _i)

#endif
