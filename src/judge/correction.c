/* Corrections that stand in a claim's own file, judged by the judge of the claim that rests on the corrected text: a
   reading of the criterion by what the return map does, the heading of a law by the law. */
#include "judge.h"

/* What cannot be read in the other claim's place is a wrong correction, and no error of that claim. */
bool judge_repaired(struct finding *f, struct judge *j, const struct claim *c, const char *repaired) {
  const struct claim *by = claim_named(j->claims, claim_get(c, "repaired-as"));
  enum kind kind = by ? claim_kind(by) : N_KINDS;
  if (kind != KIND_CRITERION && kind != KIND_LAW)
    return claim_error(j, c, "repaired-as", "the correction is judged by a claim of kind criterion or law");
  struct finding again = {.id = f->id, .verdict = VERDICT_UNKNOWN};
  struct judge other = *j;
  struct diag d = {0};
  other.d = &d;
  other.instead = repaired;
  kind_fn judge = kind == KIND_LAW ? judge_law : judge_criterion;
  bool read = judge(&again, &other, by, (struct view){j->model, LAYER_CORRECTED, NULL, NULL});
  j->pool = other.pool;
  if (!read) {
    again.verdict = VERDICT_REFUTED;
    finding_state(f, j->out, "diagnostic", layer_name[LAYER_CORRECTED], -1, 1, NULL,
                  result_str(j->out, "the correction: %s", d.message));
  }
  finding_take_evidence(f, j->out, &again);
  f->correction_verdict = again.verdict;
  return true;
}
