/* Random bits by splitmix64, and a seed from an id by the Fowler-Noll-Vo hash: the same on every machine. */
#include "random.h"

/* splitmix64, and FNV-1a to seed it from an id. */
uint64_t random_next(uint64_t *state) {
  uint64_t z = (*state += 0x9E3779B97F4A7C15U);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

double random_unit(uint64_t *state) {
  return (double)(random_next(state) >> 11) * 0x1p-53;
}

uint64_t random_seed(const char *id) {
  uint64_t h = 0xCBF29CE484222325U;
  for (; *id; id++) h = (h ^ (unsigned char)*id) * 0x100000001B3U;
  return h;
}
