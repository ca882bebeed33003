/* The result record of a study of damages: the names of fates, and how many damages a row counts. */
#include "mutation.h"

#define FATE_STRING(upper, lower) #lower,
const char *const mutant_fate_name[N_MUTANT_FATES] = {FATES(FATE_STRING)};
#undef FATE_STRING

long mutation_row_total(const struct mutation_row *r) {
  long n = 0;
  for (int i = 0; i < N_MUTANT_FATES; i++) n += r->count[i];
  return n;
}

long mutation_row_noticed(const struct mutation_row *r) {
  return r->count[FATE_NOTICED] + r->count[FATE_UNREADABLE] + r->count[FATE_UNPROVED];
}
