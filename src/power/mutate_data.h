/* The part of a study of damages that is about what stands beside the formulas, and how both parts draw. */
#ifndef STICKSLIP_POWER_MUTATE_DATA_H
#define STICKSLIP_POWER_MUTATE_DATA_H

#include <stdint.h>

#include "base/crew.h"
#include "damage_study.h"
#include "power.h"

/* So many of n numbers, ascending, in an array to be freed, each subset equally likely; all for wanted 0. */
size_t *draw_some(size_t *n_drawn, size_t n, size_t wanted, uint64_t *state);

/* How many damages will be drawn. */
size_t mutate_data_count(const struct damages *damages, const struct mutation_options *opt);
/* Draws damages of each class, tries them, and adds their rows, those that nothing noticed, and examples of what was
   said of the others. */
bool mutate_data(struct mutation_result *out, const struct material *m, const struct damages *damages,
                 const struct mutation_options *opt, struct crew_tally *tally, struct diag *d);

#endif
