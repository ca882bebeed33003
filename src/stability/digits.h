/* Where formulas lose digits. */
#ifndef STICKSLIP_STABILITY_DIGITS_H
#define STICKSLIP_STABILITY_DIGITS_H

#include "model/model.h"
#include "record/stability_result.h"

struct stability_options {
  enum layer layer;        /* whose formulas are studied */
  int after;               /* a layer whose formula of the same name is held against each at the worst points; -1 */
  const char *const *only; /* ids of formulas, matrices or records; none: all */
  int n_only;
  bool quick;
  int jobs;                                 /* processes, 1 to 64 */
  void (*progress)(size_t done, size_t of); /* or NULL */
};

/* Where the paper's formulas lose digits in double precision, by how many, and why.  Everything is the same for any
   number of processes; the last bits of the C library's sines and cosines decide about some of the search's steps.
   false with d set when the files are at fault, nothing is selected or a process ended early. */
bool audit_stability(struct stability_result *out, const struct model *m, const struct stability_options *opt,
                     struct diag *d);
/* The selected formulas at one point, "chi=0x1.8p-1,t=2": value, true value, error, conditioning by each input,
   cause. */
bool audit_stability_at(struct text *out, const struct model *m, const struct stability_options *opt, const char *at,
                        struct diag *d);

#endif
