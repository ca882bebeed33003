/* What refuted claims do to what is derived from them. */
#ifndef STICKSLIP_CONSEQUENCE_H
#define STICKSLIP_CONSEQUENCE_H

#include "claim/judging.h"
#include "record/result.h"

/* The claim that a finding is about when its failure has consequences: it fails and has a correction; the number of
   claims when not. */
size_t consequence_claim(const struct judge *j, const struct finding *f);
/* What refuted claims do to what is derived from them: of the n findings of the result at these places, which share
   what they read as printed (claim_own); completes their effects. */
bool judge_consequences(struct judge *j, const size_t *at, size_t n);

#endif
