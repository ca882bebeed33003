/* What the laws of number types are tried on. */
#ifndef STICKSLIP_TESTS_LAWS_NUM_H
#define STICKSLIP_TESTS_LAWS_NUM_H

#include "num/num.h"

/* The contexts that loop tests run over: each type, the adjustable ones at a low and at a high precision. */
enum { LAW_CONTEXTS = 5 };
struct num_ctx law_context(int i);

#endif
