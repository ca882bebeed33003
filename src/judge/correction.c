/* Corrections that stand in a claim's own file (those of errata.eq: judge.c, claim/erratum.c): read in the place of a
   record's statements, and judged by the judge of the claim that rests on the corrected text, a reading of the
   criterion by what the return map does, the heading of a law by the law. */
#include "judge.h"

const struct statement_record *reread_open(struct reread *r, const struct statement_record *in, const char *text,
                                           const char *name, struct diag *d) {
  source_from_string(&r->src, name, text);
  const struct stmt *s = stmt_parse(&r->arena, &r->src, (struct span){0, r->src.len}, d);
  if (s && s->kind != STMT_RELATION) diag_at(d, &r->src, s->span.begin, "an equation or an inequality is needed");
  if (!s || s->kind != STMT_RELATION) return NULL;
  r->stmt = s;
  r->record = *in;
  r->record.stmts = &r->stmt;
  r->record.n_stmts = 1;
  r->record.src = &r->src;
  return &r->record;
}

void reread_clear(struct reread *r) {
  arena_clear(&r->arena);
  source_clear(&r->src);
}

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
  if (!read) {
    again.verdict = VERDICT_REFUTED;
    finding_state(f, j->out, "diagnostic", layer_name[LAYER_CORRECTED], -1, 1, NULL,
                  result_str(j->out, "the correction: %s", d.message));
  }
  finding_take_evidence(f, j->out, &again);
  f->correction_verdict = again.verdict;
  return true;
}
