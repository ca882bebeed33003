/* How many of the cases there are are tried: some in make check, all in make long. */
#ifndef STICKSLIP_TESTS_EVERY_H
#define STICKSLIP_TESTS_EVERY_H

#include <stdbool.h>

/* Whether all are asked for: make long sets STICKSLIP_TESTS=all. */
bool every_case(void);

/* The stride through cases of which every n-th will do in make check; 1 where all are asked for. */
int every(int n);

/* Adds every k-th of n cases of a loop test. */
#define add_every(tcase, test, k, n)                                                                                   \
  for (int case_ = 0; case_ < (n); case_ += every(k)) tcase_add_loop_test(tcase, test, case_, case_ + 1)

#endif
