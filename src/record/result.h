/* The result record of an audit: what the writers of reports read, and all they read. */
#ifndef STICKSLIP_RECORD_RESULT_H
#define STICKSLIP_RECORD_RESULT_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/text.h"

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
/* Does the text fail as printed: refuted, be it that it holds under a condition? */
bool verdict_fails(enum verdict v);
/* Does it pass: proved or supported? */
bool verdict_passes(enum verdict v);

/* What one route found.  Strings may be NULL; bits and trials are -1 when they do not apply. */
struct evidence {
  const char *route, *layer;
  const char *result; /* agrees, differs, undecided, states */
  const char *residual;
  long bits, trials;
  const char *worst, *note;
  double machine_residual; /* of routes in double, for run.json only; NaN elsewhere */
};
/* Where it was judged, or differs most; NULL where the note has said so. */
const char *evidence_where(const struct evidence *e);

/* What a failure rests on, for who recomputes it: exact inputs as p/q or decimals, then what they give, by name. */
struct named_value {
  const char *name, *value;
};
struct certificate {
  struct named_value *at;
  int n;
};

/* Whether a claim is a statement of the paper or a check of the suite. */
enum claimant { OF_PAPER, OF_SUITE, N_CLAIMANTS };
extern const char *const claimant_name[N_CLAIMANTS];

/* What a discrepancy is worth: a user of the paper gets something wrong; a remark; one symbol stands for another. */
enum severity { SEVERITY_SUBSTANCE, SEVERITY_REMARK, SEVERITY_NOTATION, N_SEVERITIES };
extern const char *const severity_name[N_SEVERITIES];
/* The severity of that name; N_SEVERITIES when there is none. */
enum severity severity_parse(const char *name);

/* The class of a refutation; FAULT_BY_EDIT: what the correction says of it, before that is known. */
enum fault { FAULT_NOTATION, FAULT_FORMULA, FAULT_NUMBER, FAULT_ARGUMENT, N_FAULTS, FAULT_BY_EDIT };
extern const char *const fault_name[N_FAULTS];

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
  const char *letter;        /* of what the paper does not conclude: a sentence for its authors; NULL elsewhere */
  const char **depends_on;
  int n_depends_on;
  struct evidence *evidence;
  int n_evidence;
  const char *reproduce;
  enum verdict recorded; /* N_VERDICTS: nothing recorded */
  enum claimant of;
  const char *root;       /* of what fails: the id of its cause; NULL elsewhere, */
  enum severity severity; /* and what that is worth; N_SEVERITIES elsewhere */
  struct certificate certificate;
  const char *correction_recorded; /* "unknown", or NULL: it is expected to hold */
};

/* What is wrong in the paper, with the claims that fail for it in this run.  Texts have mathematics, as TeX, between
   dollar signs; by_hand: one way to see it, or NULL. */
struct root_cause {
  const char *id, *title;
  enum severity severity;
  const char *where, *wrong, *correct, *consequence, *by_hand;
  const char **claims;
  int n_claims;
};

struct skipped_work {
  const char *what, *why;
};

/* What a failed formula does to a quantity that the paper derives, everything else corrected. */
enum change { CHANGE_CHANGES, CHANGE_AGREES, CHANGE_SAME_FORMULA, CHANGE_UNDECIDED, CHANGE_UNDEFINED };

/* One derived quantity (formula as the paper's notation is typed, and typeset).  size: the largest relative difference,
   as the power of ten above it; entry, printed, corrected, where: one point at which it changes.  chain: the value
   there with the whole paper as printed; NULL when that is the same formula as with this equation alone as printed. */
struct derived {
  const char *formula, *latex, *title;
  enum change change;
  bool proved;         /* CHANGE_AGREES: by exact algebra too */
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
  const char *solved; /* what the paper's equations give with it, where it enters them: a sentence; or NULL */
  struct id_list falls, survives, open;
  struct derived *derived;
  int n_derived;
};

/* A control: wrong on purpose, and noticed when its check does not pass. */
struct control_result {
  const char *id, *claim;
  enum verdict verdict;
  bool noticed;
  const char *near;     /* the most by which it changes what it damages; NULL where it does not say, */
  const char *distance; /* and by how much it does, relative */
};

/* --- How inconsistent printed numbers could have arisen: readings of the example --- */

/* A printed number under a reading; how: input, rounded or truncated. */
struct reading_number {
  const char *name, *printed, *value, *how;
};
struct reading_slope {
  const char *of, *by, *value;
};
/* An equation that a reading does not solve: left minus right side there. */
struct reading_dropped {
  const char *equation, *residual;
};
/* How far a result is from that of the whole procedure, and how far the residuals of what is dropped move the latter to
   first order. */
struct reading_shift {
  const char *of, *actual, *predicted;
};
struct example_reading {
  const char *layer, *carry;
  const char *confirmed; /* model: the suite's own equations give the same; NULL when not asked */
  int assumptions, digits;
  const char *assumed; /* what the assumptions are */
  const char **inputs, **solved;
  int n_inputs, n_solved;
  const char *start; /* which initial positions it has, where two equations of the paper differ there; or NULL */
  struct reading_dropped *dropped;
  int n_dropped;
  struct reading_number *number;
  int n_numbers;
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
  struct example_reading *found;
  int n_found;
  struct readings_procedure procedure;
};

/* Two routes to one quantity, held against each other wherever both apply. */
struct route_pair {
  const char *quantity, *first, *second;
  const char *shared;  /* what both rest on */
  long comparisons;    /* of whole quantities: a matrix, or the times and states of a pass */
  const char *stated;  /* the accuracy that the pair is held to, relative to max(1, scale), or its routes' estimates */
  bool within;         /* there were comparisons, and all of them kept to it */
  const char *largest; /* order of magnitude of the largest disagreement, or "no answer"; NULL for a route in double */
  const char *worst;   /* where; NULL with it */
  double machine_largest; /* for run.json */
  const char *machine_worst;
};

/* A run over many periods beside an orbit, of both routes in double precision and of MPFR, against what the multiplier
   says: where |tr J| > 1 the routes leave MPFR at that rate, where |tr J| < 1 they stay with it; and a displacement of
   one route grows or shrinks at that rate. */
enum { N_LONG_PAIRS = 3 }; /* integration and closed forms, integration and MPFR, closed forms and MPFR */
struct long_result {
  const char *orbit, *multiplier;
  long periods;
  const char *expected;                /* when 2^-52 has become 1e-6: "never", "about 970 periods" */
  bool obeys, displaced;               /* rates within a tenth of log|tr J| */
  long machine_parting[N_LONG_PAIRS];  /* for run.json: the first period at which they are apart by 1e-6, or 0; */
  double machine_most[N_LONG_PAIRS];   /* the largest distance; */
  double machine_growth[N_LONG_PAIRS]; /* its measured growth a period, NaN without one; */
  double machine_displaced;            /* that of a displacement */
};

/* What every reader of an audit.json takes, and no writer exceeds: the bytes of the file, the elements of any list in
   it, and of the bytes those of values that a scene asks for, which alone can be many. */
enum { LARGEST_AUDIT = 8 << 20, MOST_AUDIT_ELEMENTS = 10000, LARGEST_VALUES = 4 << 20 };

/* A value that the scene asks for; NULL where it is not defined or its digits stayed open. */
struct asked_value {
  const char *name, *at, *value;
};

/* What was tried in balls, how often, and how often the first precision was enough. */
struct precision_use {
  const char *what;
  long tried, enough;
};

/* What a piece of the work took, for run.json: it depends on the machine, and on what the same process did before. */
struct piece_spent {
  const char *what, *name; /* as in the table of costs */
  unsigned long long units;
  double machine_ms;
};

/* What the numbers of the paper's two masses are in: for the heading of a table, and below a picture. */
#define TABLE_UNITS "Times are dimensionless; positions, velocities and friction are lengths in one unit."

/* A table that a picture is drawn from, as the file of that name beside audit.json holds it. */
struct data_table {
  const char *name, *text;
  const char *orbit; /* of along-e2.tsv, where the data are not the example's: which orbit it follows; else NULL */
};

/* What stands beside a report's folder, and is no part of audit.json: index.html alone shows it, and so is a function
   of audit.json, of the tables beside it, and of these. */

/* A file of another command that the page links to: its path from the report, and what it is. */
struct neighbour {
  const char *path, *says;
};

/* What became of the damages in the study (reports/mutation) beside the report.  counted: those that change a meaning,
   formulas of them in the paper's formulas; left out of it are those that mean the same, that make no difference on any
   motion, that need the paper's text, and those of errata.eq, which is not the paper's. */
struct mutation_score {
  long counted, noticed, formulas, equivalent, on_motions, needs_text, errata;
};

/* Its lists: roots in order of consequence; pairs and long_runs none unless the whole audit ran; tables none for a
   scene without an orbit, and for a part of the audit. */
#define RESULT_LISTS(X)                                                                                                \
  X(finding, findings)                                                                                                 \
  X(root_cause, roots)                                                                                                 \
  X(consequence, consequences)                                                                                         \
  X(skipped_work, skipped)                                                                                             \
  X(control_result, controls)                                                                                          \
  X(route_pair, pairs)                                                                                                 \
  X(long_result, long_runs)                                                                                            \
  X(asked_value, values)                                                                                               \
  X(precision_use, precision)                                                                                          \
  X(piece_spent, spent)                                                                                                \
  X(data_table, tables)

struct audit_result {
  struct arena arena; /* owns every string */
  const char *scene, *title;
  const char *data;         /* "chi = 2/3, ..., e2 = 1/4" where they are not those of an example in print; else NULL */
  const char *paper;        /* the title of the paper; NULL where its files say none */
  const char *model;        /* "two masses on a belt" where its files say that it is about these; else NULL */
  const char *paper_text;   /* the digest of the text that is quoted (quote/quote.h); NULL likewise */
  const char *paper_source; /* what text was read, in a sentence; NULL likewise */
  const char
      *subject; /* what was read: it tells one paper, overlay and scene from others (audit_fingerprint); or NULL */
#define RESULT_LIST(type, name)                                                                                        \
  struct type *name;                                                                                                   \
  size_t n_##name, cap_##name;
  RESULT_LISTS(RESULT_LIST)
#undef RESULT_LIST
  int jobs;                           /* processes that were allowed */
  const struct neighbour *neighbours; /* set by who writes the report, of what is there */
  size_t n_neighbours;
  const char *const *independence; /* what each route does and rests on */
  int n_independence;
  struct readings *readings;             /* NULL when not searched for */
  const struct mutation_score *mutation; /* NULL when there is no whole study; no part of audit.json */
  struct result_pages *pages;            /* shared with other processes, which strings may live in */
};

void audit_result_init(struct audit_result *r);
void audit_result_clear(struct audit_result *r);
/* The pages (of mmap) are unmapped when the result is cleared. */
void result_keep_pages(struct audit_result *r, void *pages, size_t size);
/* A formatted string in the result's arena. */
const char *result_str(struct audit_result *r, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
/* A copy of a string there; of NULL, NULL. */
const char *result_copy(struct audit_result *r, const char *s);
/* What a text holds, kept likewise; the text is cleared. */
const char *result_take(struct audit_result *r, struct text *t);
/* The finding of that id, the root of that id, or NULL. */
const struct finding *audit_result_finding(const struct audit_result *r, const char *id);
const struct root_cause *audit_result_root(const struct audit_result *r, const char *id);
/* How many roots have this severity. */
size_t audit_result_roots(const struct audit_result *r, enum severity severity);
/* The consequence of a failure, or NULL. */
const struct consequence *audit_result_consequence(const struct audit_result *r, const char *failure);
/* How many of the findings that are the paper's, or the suite's, have each verdict; their sum. */
long audit_result_count(long count[N_VERDICTS], const struct audit_result *r, enum claimant of);
/* Whether the verdict is another than the one recorded beside the claim. */
bool finding_unexpected(const struct finding *f);
/* A run that does not do what the multiplier says. */
bool long_result_fails(const struct long_result *l);
/* A correction that is refuted itself; or, where the verdict is on record, is neither proved nor supported. */
bool finding_miscorrected(const struct finding *f);
/* A control that is farther from what it damages than it says. */
bool control_is_far(const struct control_result *c);
/* Findings whose verdict differs from what is recorded, corrections that are wrong, controls that went unnoticed or are
   far, and routes that disagree. */
long audit_result_unexpected(const struct audit_result *r);

#endif
