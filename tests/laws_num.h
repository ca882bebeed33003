/* The laws every number type obeys, as test cases. */
#ifndef STICKSLIP_TESTS_LAWS_NUM_H
#define STICKSLIP_TESTS_LAWS_NUM_H

#include <check.h>

#include "num/num.h"

TCase *laws_num_tcase(void);

/* The contexts that loop tests run over: each type, the adjustable ones at a low and at a high precision. */
enum { LAW_CONTEXTS = 5 };
struct num_ctx law_context(int i);

#endif
