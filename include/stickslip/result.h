/* The result record of an audit: what the writers of reports read, and all they read. */
#ifndef STICKSLIP_RESULT_H
#define STICKSLIP_RESULT_H

#include <stdbool.h>

#include "stickslip/arena.h"

/* The verdicts, in the order of the summary. */
#define VERDICTS(X)                                                                                                    \
  X(PROVED, proved)                                                                                                    \
  X(CONDITIONAL, conditional)                                                                                          \
  X(SUPPORTED, supported)                                                                                              \
  X(REFUTED, refuted)                                                                                                  \
  X(UNKNOWN, unknown)                                                                                                  \
  X(SKIPPED, skipped)                                                                                                  \
  X(DEFINITION, definition)

enum verdict {
#define VERDICT_ENUM(upper, lower) VERDICT_##upper,
  VERDICTS(VERDICT_ENUM)
#undef VERDICT_ENUM
      N_VERDICTS
};
extern const char *const verdict_name[N_VERDICTS];
/* The verdict of that name; N_VERDICTS when there is none. */
enum verdict verdict_parse(const char *name);

/* What one route found.  Strings may be NULL; bits and trials are -1 when they do not apply. */
struct evidence {
  const char *route, *layer;
  const char *result; /* agrees, differs, undecided, states */
  const char *residual;
  long bits, trials;
  const char *worst, *note;
  double machine_residual; /* of routes in double, for run.json only; NaN elsewhere */
};

/* quote: the paper's own text; printed: its formula as parsed, typeset (LaTeX), or the printed number.  Of a corrected
   claim: quote_part, the TeX of the paper's records that the correction touches; printed_part, the statements it
   replaces as parsed, and correction_latex, what replaces them, typeset; change, where the two differ, as text with
   mathematics between dollar signs. */
struct finding {
  const char *id, *equation, *section, *title, *quote, *printed;
  enum verdict verdict;
  const char *condition, *fault;
  const char *correction; /* NULL without one */
  enum verdict correction_verdict;
  const char *correction_latex, *quote_part, *printed_part, *change;
  const char *effect, *size; /* size: the part of effect that speaks of the claim itself */
  const char **depends_on;
  int n_depends_on;
  struct evidence *evidence;
  int n_evidence;
  const char *reproduce;
  enum verdict recorded; /* N_VERDICTS: nothing recorded */
};

struct skipped_work {
  const char *what, *why;
};

/* What a failed formula does to a quantity that the paper derives, everything else corrected. */
enum change { CHANGE_CHANGES, CHANGE_AGREES, CHANGE_SAME_FORMULA, CHANGE_UNDECIDED, CHANGE_UNDEFINED };

/* One derived quantity (formula as the paper's notation is typed, and typeset).  size: the largest relative difference,
   as the power of ten above it; entry, printed, corrected, where: one point at which it changes.  chain: the value there
   with the whole paper as printed; NULL when that is the same formula as with this equation alone as printed. */
struct derived {
  const char *formula, *latex, *title;
  enum change change;
  const char *verdict; /* in words, with the number of points */
  const char *size, *entry, *printed, *corrected, *where, *chain;
};

/* Claims that fail when the failed formula is read as printed, claims that rest on it and hold all the same (because
   their own formulas are the same, or tried again), and claims about which that could not be told. */
struct id_list {
  const char **id;
  int n;
};
struct consequence {
  const char *failure;
  struct id_list falls, survives, open;
  struct derived *derived;
  int n_derived;
};

/* A control: wrong on purpose, and noticed when its check does not pass. */
struct control_result {
  const char *id, *claim;
  enum verdict verdict;
  bool noticed;
};

struct audit_result {
  struct arena arena; /* owns every string */
  const char *scene, *title;
  struct finding *findings;
  size_t n_findings, cap_findings;
  struct consequence *consequences;
  size_t n_consequences, cap_consequences;
  struct skipped_work *skipped;
  size_t n_skipped, cap_skipped;
  struct control_result *controls;
  size_t n_controls, cap_controls;
  const char *const *independence;
  int n_independence;
};

void audit_result_init(struct audit_result *r);
void audit_result_clear(struct audit_result *r);
/* A formatted string in the result's arena. */
const char *result_str(struct audit_result *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* The consequence of a failure, or NULL. */
const struct consequence *audit_result_consequence(const struct audit_result *r, const char *failure);
/* How many findings have each verdict; the sum is n_findings (checked). */
void audit_result_count(const struct audit_result *r, long count[N_VERDICTS]);
/* Findings whose verdict differs from what is recorded, and controls that went unnoticed. */
long audit_result_unexpected(const struct audit_result *r);

#endif
