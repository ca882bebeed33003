/* What an audit would do, and what it may cost, without doing any of it. */
#ifndef STICKSLIP_RUN_PLAN_H
#define STICKSLIP_RUN_PLAN_H

#include "audit.h"
#include "claim/claims.h"

/* A list in a plan's arena. */
struct plan_list {
  const char **item;
  int n;
};

/* One claim.  routes: those by which it is tried, the decisive one first; none where the kind has its own.  parts: what
   it may need of work.h's parts, but for precisions: phases, orbits, simulations, proofs.  matrices: those of the
   model's matrices that its formulas reach under the paper's names.  Precision rises from first_bits only while a
   verdict is undecided; 0: nothing is tried in balls. */
struct planned_claim {
  const char *id, *kind, *points;
  struct plan_list routes, parts, matrices, controls;
  long first_bits, last_bits;
  double units, ms; /* by the table of costs, its controls among them; -1: not in it */
  bool left_out;    /* it is about one set of parameters, and the scene gives intervals: nothing of it is done */
};

/* Work that claims share, or that is done once: searches, studies, and the consequences of what fails on record. */
struct planned_work {
  const char *what;
  long claims; /* how many need it; 0: it is no claim's */
  double units, ms;
};

struct audit_plan {
  struct arena arena;
  const char *scene;
  struct planned_claim *claim;
  int n_claims;
  struct planned_work *shared;
  int n_shared;
  double units,
      ms; /* together, what the table knows; the consequences of failures that no record expects come on top */
};

/* false with d set as audit_run.  Clear it all the same. */
bool audit_plan(struct audit_plan *p, const struct model *m, const struct claims *claims, const struct claims *controls,
                const struct scene *scene, const struct audit_options *opt, struct diag *d);
void audit_plan_clear(struct audit_plan *p);

#endif
