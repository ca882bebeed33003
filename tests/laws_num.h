/* The laws every number type obeys, as test cases, and the random operands they and other tests run on. */
#ifndef STICKSLIP_TESTS_LAWS_NUM_H
#define STICKSLIP_TESTS_LAWS_NUM_H

#include <check.h>

#include "num/num.h"

TCase *laws_num_tcase(void);

/* The contexts that loop tests run over: each type, the adjustable ones at a low and at a high precision. */
enum { LAW_CONTEXTS = 5 };
struct num_ctx law_context(int i);

/* A small random generator (splitmix64): the same numbers on every machine, restartable from any trial's seed. */
struct rng {
  uint64_t state;
};
uint64_t rng_next(struct rng *r);
slong rng_between(struct rng *r, slong low, slong high); /* both included */
double rng_unit(struct rng *r);                          /* in [0, 1) */

/* An exact dyadic number of at most bits bits: small integers, powers of two, neighbours of 1, neighbours of multiples
   of pi/2, plain numbers, and numbers of binary exponent up to +-reach. */
void rng_edge(arf_t x, struct rng *r, slong bits, slong reach);

#endif
