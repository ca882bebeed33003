/* The result record of the study: the names of causes and bins, and the rules by which a row counts as a loss or a
   fault. */
#include <math.h>

#include "stability_result.h"

const char *const loss_cause_says[N_LOSS_CAUSES] = {
#define CAUSE_SAYS(name, says) says,
    LOSS_CAUSES(CAUSE_SAYS)
#undef CAUSE_SAYS
};

const char *const loss_bin_name[N_LOSS_BINS] = {"below 1", "1 to 2",     "2 to 4", "4 to 8",
                                                "8 to 12", "12 or more", "failure"};

int loss_bin(double digits) {
  static const double above[] = {1, 2, 4, 8, 12};
  int n = sizeof above / sizeof *above, i = 0;
  if (isnan(digits)) return N_LOSS_BINS - 1;
  while (i < n && digits >= above[i]) i++;
  return i;
}

bool stability_is_loss(double formula_lost) {
  return formula_lost > log10(STABILITY_ALLOWED);
}

bool stability_loses(const struct stability_row *row) {
  return row->found && stability_is_loss(row->formula_lost);
}

bool stability_pair_fails(const struct stability_pair *p) {
  return p->lost + p->differ > 0;
}

bool stability_at_fault(const struct stability_row *row, bool kernel) {
  return stability_loses(row) || (row->failures > 0 && !kernel);
}

long stability_region_points(const struct stability_result *r, int region) {
  long points = 0;
  for (int i = 0; i < r->n_formulas; i++) points += stability_row_at(r, i, region)->points;
  return points;
}

int stability_empty_region(const struct stability_result *r) {
  for (int k = 0; k < r->n_regions; k++)
    if (stability_region_points(r, k) == 0) return k;
  return -1;
}

void stability_result_clear(struct stability_result *r) {
  arena_clear(&r->arena);
}

const struct stability_row *stability_row_at(const struct stability_result *r, int formula, int region) {
  return &r->row[(long)formula * r->n_regions + region];
}
