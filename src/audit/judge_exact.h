/* Proofs by exact algebra of what claims say. */
#ifndef STICKSLIP_AUDIT_JUDGE_EXACT_H
#define STICKSLIP_AUDIT_JUDGE_EXACT_H

#include "audit_impl.h"

struct exact_proof {
  bool proved;                        /* on the claim's whole domain, wherever both sides are defined */
  const char *note;                   /* what was shown equal, and where; when proved */
  const char *why_not;                /* when not */
  const char *differs;                /* a difference and a rational point, where that refutes; else NULL */
  const struct restriction *holds_at; /* under which every difference vanishes, by its factors; or NULL */
  const char *field;
  slong largest;
  bool uses_matrices;
};

/* The sentence of a claim that is tried at points, under a restriction or (NULL) without. */
struct exact_proof exact_prove(struct judge *j, const struct claim *c, struct view view, const struct restriction *r);

#endif
