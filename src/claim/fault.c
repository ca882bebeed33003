/* What a refutation is a fault of: it follows from the claim's kind and, where sides are held against each other, from
   what the sentence says and what its correction changes. */
#include "claim.h"

#include <string.h>

static bool has_inequality(const struct model *m, const char *statement) {
  struct view v = {m, LAYER_PRINTED, NULL, NULL};
  const struct statement_record *r = statement ? view_record(&v, statement) : NULL;
  for (int i = 0; r && i < r->n_stmts; i++)
    for (int k = 0; r->stmts[i]->kind == STMT_RELATION && k + 1 < r->stmts[i]->n_sides; k++)
      if (r->stmts[i]->ops[k] != REL_EQ) return true;
  return false;
}

bool claim_judged_at_points(const struct model *m, const struct claim *c) {
  return claim_tried_at_points(c) || (!m->system && claim_kind(c) == KIND_INEQUALITY);
}

enum fault claim_fault(const struct model *m, const struct claim *c) {
  const struct claim_kind *kind = claim_kind_of(c);
  const char *statement = claim_get(c, "statement");
  if (!kind) return FAULT_FORMULA;
  if (claim_get(c, "limits")) return FAULT_ARGUMENT;                        /* no formula is wrong: there is none */
  if (!m->system && claim_kind(c) == KIND_INEQUALITY) return FAULT_FORMULA; /* of no example's numbers */
  if (kind->fault != FAULT_BY_EDIT) return kind->fault;
  if (!kind->tried_at_points) return statement ? FAULT_NOTATION : FAULT_FORMULA; /* scaling: of one record, or of all */
  if (m->system && has_inequality(m, statement)) return FAULT_ARGUMENT;
  return erratum_renames(m, c) ? FAULT_NOTATION : FAULT_FORMULA;
}
