/* Every suite of the project. */
#ifndef STICKSLIP_TESTS_SUITES_H
#define STICKSLIP_TESTS_SUITES_H

#include <check.h>

#define SUITE(name) Suite *name##_suite(void);
#include "suites.def"
#undef SUITE

#endif
