/* Random bits that are the same on every machine. */
#ifndef STICKSLIP_RANDOM_H
#define STICKSLIP_RANDOM_H

#include <stdint.h>

/* A stream of random bits, seeded from an id. */
uint64_t random_next(uint64_t *state);
uint64_t random_seed(const char *id);
/* The next number of [0, 1). */
double random_unit(uint64_t *state);

#endif
