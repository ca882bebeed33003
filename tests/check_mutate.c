#include <check.h>
#include "suites.h"
Suite *mutate_suite(void) { Suite *s = suite_create("mutate"); suite_add_tcase(s, tcase_create("x")); return s; }
