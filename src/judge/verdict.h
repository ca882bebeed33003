/* From evidence to verdict. */
#ifndef STICKSLIP_VERDICT_H
#define STICKSLIP_VERDICT_H

#include "base/status.h"
#include "record/finding.h"

/* What a route says that found it to hold, not to hold, or neither. */
enum route_outcome outcome_of_truth(truth holds);
/* What a route says that was tried so often with each outcome. */
enum route_outcome outcome_of_counts(long agrees, long differs, long undecided);
/* How often each answer was given, by truth; how often one was; what a route says that gave them. */
struct answers {
  long of[3];
};
long answers_given(const struct answers *a);
enum route_outcome answers_outcome(const struct answers *a);
/* What a route says that was tried so often with each outcome, or gave these answers. */
struct route_result counted_route(const char *route, bool decisive, long agrees, long differs, long undecided);
struct route_result answers_route(const char *route, bool decisive, const struct answers *said);
/* What exact algebra says of the corrected sentence, as evidence: proved, refuted by it, or why neither. */
struct route_result exact_route(struct finding *f, struct audit_result *out, enum route_outcome outcome,
                                const char *note);
/* The one table from evidence to verdict. */
enum verdict verdict_of(const struct route_result *w, int n, bool whole_domain);
/* Likewise of n routes and a proof, where that decides; w has a place for it. */
enum verdict verdict_with_proof(struct route_result *w, int n, const struct route_result *proof);
/* Of a sentence with that verdict, judged again under a condition. */
enum verdict verdict_under_condition(enum verdict whole, enum verdict under);
/* Unknown in spite of the table, since a case that the sentence includes was not tried, or one that it leaves out
   was. */
void verdict_leave_open(struct finding *f, struct audit_result *out, const char *why);

#endif
