/* A small random generator (splitmix64): the same numbers on every machine, restartable from any trial's seed. */
#ifndef STICKSLIP_TESTS_RNG_H
#define STICKSLIP_TESTS_RNG_H

#include <stdint.h>

#include "num/num.h"

struct rng {
  uint64_t state;
};
uint64_t rng_next(struct rng *r);
slong rng_between(struct rng *r, slong low, slong high); /* both included */
double rng_unit(struct rng *r);                          /* in [0, 1) */
double rng_within(struct rng *r, double low, double high);
double rng_dyadic(struct rng *r, slong low, slong high); /* a multiple of 1/64 in [low, high]/64 */

/* In [1/2, 1), of at most bits bits. */
void rng_mantissa(arf_t x, struct rng *r, slong bits);

/* An exact dyadic number of at most bits bits: small integers, powers of two, neighbours of 1, neighbours of multiples
   of pi/2, plain numbers, and numbers of binary exponent up to +-reach. */
void rng_edge(arf_t x, struct rng *r, slong bits, slong reach);

#endif
