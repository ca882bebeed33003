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

/* quote: the paper's own text; printed: its formula as parsed, typeset (LaTeX), or the printed number. */
struct finding {
  const char *id, *equation, *section, *title, *quote, *printed;
  enum verdict verdict;
  const char *condition, *fault;
  const char *correction; /* NULL without one */
  enum verdict correction_verdict;
  const char *effect;
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

/* A control: wrong on purpose, and noticed when its check does not pass. */
struct control_result {
  const char *id, *claim;
  enum verdict verdict;
  bool noticed;
};

/* --- How inconsistent printed numbers could have arisen: readings of the example --- */

/* A printed number under a reading; how: input, rounded, truncated or off. */
struct reading_number {
  const char *name, *printed, *value, *how;
};
struct reading_slope {
  const char *of, *by, *value;
};
/* An equation that a reading does not solve: left minus right side there, and how the outputs of the whole procedure
   answer to such a residual, per unit. */
struct reading_dropped {
  const char *equation, *residual;
  struct reading_slope *answer;
  int n_answer;
};
/* How far a result is from that of the whole procedure, and how far the residuals of what is dropped move the latter to
   first order. */
struct reading_shift {
  const char *of, *actual, *predicted;
};
struct example_reading {
  const char *layer, *form, *carry;
  const char *confirmed; /* model: the suite's own equations give the same; NULL when not asked */
  int assumptions, digits;
  const char *assumed; /* what the assumptions are */
  const char **inputs, **solved;
  int n_inputs, n_solved;
  struct reading_dropped *dropped;
  int n_dropped;
  struct reading_number *number;
  int n_numbers, n_given;      /* how many of them it gives */
  struct reading_slope *slope; /* outputs by inputs */
  int n_slopes;
  int decimals; /* of its inputs, that the printed digits of its results need; -1: not known */
  struct reading_shift *shift;
  int n_shifts;
};
struct readings_level {
  int dropped;
  long tried, undetermined;
  long reproduce, unrounded; /* give every printed number; of them those that carry full precision */
  long open;
};
/* An output of the whole procedure: its value, the values that the printed digits of the inputs leave room for, and how
   many decimals of the inputs its own printed digits need; -1: not known. */
struct procedure_output {
  const char *name, *printed, *value, *low, *high;
  const char *within; /* yes, no, or open: whether some of those values prints as printed */
  int decimals;
};
struct readings_procedure {
  const char *inputs;
  struct procedure_output *output; /* NULL when no solution was found */
  int n_outputs;
  struct reading_slope *slope;
  int n_slopes;
};
/* Two inputs as printed, nothing dropped. */
struct readings_pair {
  const char *inputs, *missed; /* missed: NULL when no solution was found near the printed numbers */
  int n_given, n_numbers;
};
struct readings {
  const char **space; /* what is searched, in sentences */
  int n_space;
  const char **conclusion;
  int n_conclusions;
  struct readings_level level[8];
  int n_levels;
  struct readings_pair *pair;
  int n_pairs;
  struct example_reading *found, *near;
  int n_found, n_near;
  struct readings_procedure procedure;
};

struct audit_result {
  struct arena arena; /* owns every string */
  const char *scene, *title;
  struct finding *findings;
  size_t n_findings, cap_findings;
  struct skipped_work *skipped;
  size_t n_skipped, cap_skipped;
  struct control_result *controls;
  size_t n_controls, cap_controls;
  const char *const *independence;
  int n_independence;
  struct readings *readings; /* NULL when not searched for */
};

void audit_result_init(struct audit_result *r);
void audit_result_clear(struct audit_result *r);
/* A formatted string in the result's arena. */
const char *result_str(struct audit_result *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* How many findings have each verdict; the sum is n_findings (checked). */
void audit_result_count(const struct audit_result *r, long count[N_VERDICTS]);
/* Findings whose verdict differs from what is recorded, and controls that went unnoticed. */
long audit_result_unexpected(const struct audit_result *r);

#endif
