/* The power of the audit: would a damage have been noticed, and which small edits repair what fails? */
#ifndef STICKSLIP_POWER_POWER_H
#define STICKSLIP_POWER_POWER_H

#include "claim/claim.h"
#include "model/model.h"
#include "quote/quote.h"
#include "record/mutation_result.h"
#include "record/result.h"
#include "scene/scene.h"

struct mutation_options {
  unsigned long long seed;
  long count;              /* formulas drawn, and a quarter as many, rounded up, of each class of data; 0: all */
  int jobs;                /* processes, 1 to 64 */
  const char *const *only; /* files, records or classes of data */
  int n_only;
  const struct paper_text *text; /* of the paper, against which damaged quotations are held; NULL: none is at hand */
  void (*progress)(size_t done, size_t of); /* or NULL */
};

/* Damages the formulas of the paper one token at a time (edit.h), each as an overlay of one statement, and asks the
   claims that read it, those with the fewest definitions first, until a verdict changes: that of the claim, of its
   correction or of a restricted claim.  Both texts are damaged where the errata correct the paper: the one that
   everything reads, and the printed one.  What survives is compared with the original by exact algebra, judged in full,
   and put to the checks that are made of loaded data.  Then it damages what stands beside the formulas (damages.h,
   damage_study.h), by class.  The result is the same for any number of processes.  false with d set when the files are
   at fault or a process ended early. */
bool audit_mutate(struct mutation_result *out, const struct audit_data *data, const struct scene *scene,
                  const struct mutation_options *opt, struct diag *d);

struct repair_options {
  const char *const *only; /* claims; none: all that are refuted and about formulas */
  int n_only;
  int jobs;                                 /* processes, 1 to 64 */
  void (*progress)(size_t done, size_t of); /* claims; or NULL */
};

/* Searches repairs of the refuted claims about formulas (all, or those selected): the claim's printed text with every
   one edit, and where none helps, or the correction on file is not among those that do, with pairs of exchanged names
   within a budget; those with which the claim passes the checks that refuted it, the smallest first. */
bool audit_repairs(struct repair_result *out, const struct model *m, const struct claims *claims,
                   const struct scene *scene, const struct repair_options *opt, struct diag *d);

#endif
