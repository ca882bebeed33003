/* The result records of the audit of the audit: what became of damaged formulas, and which edits repair a refuted
   one. */
#ifndef STICKSLIP_MUTATION_RESULT_H
#define STICKSLIP_MUTATION_RESULT_H

#include <stdbool.h>

#include "base/arena.h"
#include "record/result.h"

/* What became of a damage.  Noticed: a verdict changed, or the damaged text cannot be read or evaluated, or (unproved)
   a claim that an exact proof decides is no longer proved, and none is refuted, or (refused) no verdict changed but the
   checks that are made when the data are loaded say what is wrong.  Else it survived: equivalent (proved to say the
   same, by algebra alone, or by a rule that it names); on_motions (proved to say the same on every motion of the word,
   by what defines its phases, so that nothing tried on motions can tell); needs_text (only the paper's text, which was
   not there, can tell); undecided; or read by no claim that asserts anything. */
#define FATES(X)                                                                                                       \
  X(NOTICED, noticed)                                                                                                  \
  X(UNREADABLE, unreadable)                                                                                            \
  X(UNPROVED, unproved)                                                                                                \
  X(REFUSED, refused)                                                                                                  \
  X(EQUIVALENT, equivalent)                                                                                            \
  X(ON_MOTIONS, on_motions)                                                                                            \
  X(NEEDS_TEXT, needs_text)                                                                                            \
  X(UNDECIDED, undecided)                                                                                              \
  X(UNREAD, unread)

enum mutant_fate {
#define FATE_ENUM(upper, lower) FATE_##upper,
  FATES(FATE_ENUM)
#undef FATE_ENUM
      N_MUTANT_FATES
};
extern const char *const mutant_fate_name[N_MUTANT_FATES];

/* Counts under one heading: a file, a kind of damage. */
struct mutation_row {
  const char *name;
  long count[N_MUTANT_FATES];
};

struct survivor {
  enum mutant_fate fate;
  bool corrected; /* of printed text that the errata correct */
  const char *file, *record, *equation, *kind;
  long line, column;
  const char *was, *now;       /* the part that was damaged */
  const char *original, *text; /* the statement */
  const char *read_by;         /* claims that read it, joined by ", "; "" for none */
};

/* What stands beside the formulas: X(name, words, whether they count in the score). */
#define DAMAGE_CLASSES(X)                                                                                              \
  X(TEX, "TeX", true)                                                                                                  \
  X(QUOTATION, "quotation", true)                                                                                      \
  X(PRINTED, "printed number", true)                                                                                   \
  X(PREMISE, "premise", true)                                                                                          \
  X(CONCLUSION, "conclusion", true)                                                                                    \
  X(POINTS, "points", true)                                                                                            \
  X(ROUTES, "routes", true)                                                                                            \
  X(TOLERANCE, "tolerance", true)                                                                                      \
  X(DOMAIN, "domain", true)                                                                                            \
  X(CORRECTION, "correction", true)                                                                                    \
  X(RESTRICTION, "restriction", true)                                                                                  \
  X(CONTROL, "control", true)                                                                                          \
  X(TITLE, "title", true)                                                                                              \
  X(ERRATUM, "TeX of errata.eq", false)

enum damage_class {
#define CLASS_ENUM(name, words, counts) DAMAGE_##name,
  DAMAGE_CLASSES(CLASS_ENUM)
#undef CLASS_ENUM
      N_DAMAGE_CLASSES
};
/* counts: it is of the score in the score; else it has its row alone. */
struct damage_class_info {
  const char *words;
  bool counts;
};
extern const struct damage_class_info damage_classes[N_DAMAGE_CLASSES];

/* A damage of the data that the page shows: none noticed it, or an example of those that are. */
struct damaged {
  enum damage_class class;
  enum mutant_fate fate;
  const char *file, *record, *attribute; /* attribute: "" for a whole record */
  long line;
  const char *was, *now; /* lines of the file, without what they share with each other beyond words */
  const char *says;      /* what was said, the rule by which it says the same, or "" */
};

struct mutation_result {
  struct arena arena; /* owns every string */
  const char *scene;
  const char *subject; /* as in an audit.json (result.h) */
  const char *text;    /* the digest of the paper's text that quotations were held against; NULL: none was at hand */
  unsigned long long seed;
  long population, tried;           /* all damages, and how many of them were drawn */
  struct mutation_row formulas;     /* of the paper's formulas: the printed text, and what everything reads */
  struct mutation_row printed;      /* of these, of printed text that the errata correct */
  struct mutation_row errata;       /* formulas of errata.eq, which are not the paper's: in no other row */
  struct mutation_row *file, *kind; /* the paper's formulas by file and by kind */
  size_t n_files, cap_files, n_kinds;
  struct mutation_row data[N_DAMAGE_CLASSES];
  struct survivor *survivor; /* in the order of the files; those of one statement together */
  size_t n_survivors, cap_survivors;
  struct damaged *damaged; /* by class */
  size_t n_damaged, cap_damaged;
  bool broken; /* a process ended early, and the rest means nothing */
};

void mutation_result_init(struct mutation_result *r);
void mutation_result_clear(struct mutation_result *r);
long mutation_row_total(const struct mutation_row *r);
long mutation_row_noticed(const struct mutation_row *r); /* unreadable, unproved and refused ones too */
/* Those that change a meaning and could be noticed: all but the equivalent ones, those that say the same on every
   motion, and those that need the text. */
long mutation_row_counted(const struct mutation_row *r);
/* The one score: of the paper's formulas and of all classes of data that count. */
void mutation_score_of(struct mutation_score *s, const struct mutation_result *r);

/* One repair of a refuted claim: its printed text with one or two edits. */
struct repair {
  int edits;
  long distance;       /* characters put in, left out or exchanged in the printed statements */
  const char *kinds;   /* of the edits, joined by ", " */
  const char *change;  /* "was -> now", joined by "; " */
  const char *text;    /* the edited statements */
  const char *verdict; /* of the claim with it */
  const char *erratum; /* how it compares with the errata: "same text", "same values", or NULL */
};

struct repairs {
  const char *claim, *equation, *title;
  const char *printed;   /* the statements searched */
  const char *erratum;   /* the correction on file, or NULL */
  const char *why_none;  /* why there was no search, or NULL */
  long singles, pairs;   /* edits and pairs of edits tried */
  bool pairs_complete;   /* all pairs of the edits searched for pairs were within the budget */
  struct repair *repair; /* the smallest first */
  size_t n, cap;
};

struct repair_result {
  struct arena arena;
  const char *scene;
  struct repairs *claim;
  size_t n, cap;
  bool broken; /* as above */
};
void repair_result_clear(struct repair_result *r);

#endif
