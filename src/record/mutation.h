/* The result records of the audit of the audit: what became of damaged formulas, and which edits repair a refuted
   one. */
#ifndef STICKSLIP_RECORD_MUTATION_H
#define STICKSLIP_RECORD_MUTATION_H

#include <stdbool.h>

#include "base/arena.h"

/* What became of a mutant.  Noticed: a verdict changed, or the damaged text cannot be read or evaluated, or (unproved)
   a claim that an exact proof decides is no longer proved, and none is refuted.  Else it survived: equivalent (proved
   to say the same, by algebra alone); on_motions (proved to say the same on every motion of the word, by what defines
   its phases, so that nothing tried on motions can tell); undecided; or read by no claim that asserts anything. */
#define FATES(X)                                                                                                       \
  X(NOTICED, noticed)                                                                                                  \
  X(UNREADABLE, unreadable)                                                                                            \
  X(UNPROVED, unproved)                                                                                                \
  X(EQUIVALENT, equivalent)                                                                                            \
  X(ON_MOTIONS, on_motions)                                                                                            \
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
  size_t line, column;
  const char *was, *now;       /* the part that was damaged */
  const char *original, *text; /* the statement */
  const char *read_by;         /* claims that read it, joined by ", "; "" for none */
};

struct mutation_result {
  struct arena arena; /* owns every string */
  const char *scene;
  const char *subject; /* as in an audit.json (result.h) */
  unsigned long long seed;
  long population, tried;      /* all mutants, and how many of them were drawn */
  struct mutation_row total;   /* of the text that everything reads: printed, or corrected where the errata do */
  struct mutation_row printed; /* of the printed text that the errata correct; counted nowhere else */
  struct mutation_row *file, *kind;
  size_t n_files, cap_files, n_kinds;
  struct survivor *survivor; /* in the order of the files; those of one statement together */
  size_t n_survivors, cap_survivors;
  bool broken; /* a process ended early, and the rest means nothing */
};

void mutation_result_init(struct mutation_result *r);
void mutation_result_clear(struct mutation_result *r);
long mutation_row_total(const struct mutation_row *r);
long mutation_row_noticed(const struct mutation_row *r); /* unreadable and unproved ones too */

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
void repair_result_init(struct repair_result *r);
void repair_result_clear(struct repair_result *r);

#endif
