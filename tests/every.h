/* How many of the cases there are are tried: some in make check, all in make long. */
#ifndef STICKSLIP_TESTS_EVERY_H
#define STICKSLIP_TESTS_EVERY_H

#include <stdbool.h>

/* Whether all are asked for: make long sets STICKSLIP_TESTS=all. */
bool every_case(void);

/* The stride through cases of which every n-th will do in make check; 1 where all are asked for. */
int every(int n);

#endif
