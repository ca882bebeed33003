/* How findings, controls and what was left out come into the result record. */
#ifndef STICKSLIP_RECORD_FINDING_H
#define STICKSLIP_RECORD_FINDING_H

#include "result.h"

/* An empty row of evidence at the end of the finding's. */
struct evidence *finding_add(struct finding *f, struct audit_result *out);

/* What one route says of a claim, as the table reads it. */
enum route_outcome { ROUTE_NOTHING, ROUTE_AGREES, ROUTE_DIFFERS, ROUTE_UNDECIDED };
struct route_result {
  const char *route;
  enum route_outcome outcome;
  bool decisive; /* its difference is a certificate */
  long trials;
};
/* The word as evidence, and the word.  bits is -1, where and note are NULL, when they do not apply. */
struct route_result finding_add_route(struct finding *f, struct audit_result *out, struct route_result w,
                                      const char *layer, long bits, const char *where, const char *note);
/* The finding without evidence, for its claim to be judged once more; and that evidence at the end of the finding's. */
struct finding finding_again(const struct finding *f);
void finding_take_evidence(struct finding *f, struct audit_result *out, const struct finding *again);
/* Whether it rests on a text that cannot be read. */
bool finding_is_diagnostic(const struct finding *f);
/* Evidence that only states something. */
void finding_state(struct finding *f, struct audit_result *out, const char *route, const char *layer, long bits,
                   long trials, const char *where, const char *note);

/* Another value at the end of a certificate; name and value live as long as the result. */
void certificate_add(struct certificate *c, struct audit_result *out, const char *name, const char *value);

/* "1e-37", the next power of ten above 2^log2x; "0" for -inf. */
const char *order_of_magnitude(struct audit_result *r, double log2x);

/* A finding at the end of the record's. */
void audit_finding(struct audit_result *out, const struct finding *f);
/* What became of a control; it is noticed when it is refuted. */
void audit_control(struct audit_result *out, const char *id, const char *claim, enum verdict verdict);
/* Other work left out, with the reason. */
void audit_leave_out(struct audit_result *out, const char *what, const char *why);

#endif
