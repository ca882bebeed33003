/* An audit as pieces: what is selected, which pieces that makes, what some of them do, and what is left out.  The
   planner prints them, the run does them. */
#ifndef STICKSLIP_RUN_RUN_H
#define STICKSLIP_RUN_RUN_H

#include "audit.h"
#include "claim/judging.h"
#include "tasks.h"

/* In the order in which the report has them. */
enum piece_kind {
  PIECE_CLAIM,
  PIECE_CONSEQUENCE,
  PIECE_CONTROL,
  PIECE_LONG_RUNS,
  PIECE_ROUTES,
  PIECE_TABLES,
  PIECE_READINGS,
  PIECE_VALUES
};
extern const char *const piece_what[]; /* in the table of costs: claim, consequence, control, study */

struct piece {
  enum piece_kind kind;
  const char *name;
  const struct claim *claim, *control;
  size_t *at, n_at; /* consequences: the findings */
};

struct pieces {
  struct piece *item;
  size_t n, cap;
};

bool run_check_selection(const struct model *m, const struct claims *claims, const struct audit_options *opt,
                         const struct scene *s, struct diag *d);
/* What can be done before any claim is judged: claims and, for a paper about the model's system, studies, readings. */
void pieces_first(struct pieces *p, const struct model *m, const struct claims *claims, const struct scene *s,
                  const struct audit_options *opt);
/* The controls beside the selected claims; false with d set when one names no claim. */
bool pieces_controls(struct pieces *p, const struct claims *claims, const struct claims *controls,
                     const struct scene *s, const struct audit_options *opt, struct diag *d);
void pieces_clear(struct pieces *p);
/* The values that the scene asks for, into the result (values_asked.c); false with j->d set, at the scene's line, where
   they are more than an audit.json may hold. */
bool values_asked(struct judge *j);
/* The claim that a finding is about when its failure has consequences: it fails and has a correction that holds; the
   number of claims when not (consequence.c). */
size_t consequence_claim(const struct judge *j, const struct finding *f);
/* Whether the claims fail together: the same text is read as printed, once for both. */
bool claims_fail_together(const struct claim *a, const struct claim *b);
/* What refuted claims do to what is derived from them: of the n findings of the result at these places, which share
   what they read as printed (claim_own); completes their effects. */
bool judge_consequences(struct judge *j, const size_t *at, size_t n);
/* What the run left out, and why, made from what was really not done (skipped.c); touched: the parts of work.h that
   some piece has used. */
void skipped_describe(const struct judge *j, const struct claims *controls, const struct audit_options *opt,
                      const struct pieces *first, const struct pieces *second, unsigned touched);
/* Whether nothing narrows the audit (skipped.c). */
bool run_is_whole(const struct audit_options *opt, const struct scene *s);

#endif
