/* Studies: questions about integrators and formulas whose answer is a few tables, not one error against one time.

   A study fills tables cell by cell; the page, the TSV files and the JSON are made from these alone.  What is said in
   words is either about the question (which does not depend on the outcome) or a line the study makes from its
   numbers. */
#ifndef STICKSLIP_BENCH_STUDY_H
#define STICKSLIP_BENCH_STUDY_H

#include "base/json.h"
#include "base/text.h"

enum { STUDY_TABLES = 5 };

struct study_table {
  const char *id, *title, *note; /* note: what the columns are */
  struct text tsv;               /* a line of names, then the rows */
  bool open;                     /* a row has been begun */
};

struct bench_env;
struct study;
struct study_page {
  const struct study *study;
  struct study_table table[STUDY_TABLES];
  int n;
  struct text found;  /* lines made from the tables */
  struct text figure; /* an SVG document; empty: there is none */
  bool quick;
};
struct study {
  const char *id, *title, *question;
  /* false when the study could not be made. */
  bool (*run)(struct study_page *page, const struct bench_env *env);
  bool apart; /* not among those that are made together */
};

extern const struct study *const bench_studies[];
extern const int n_bench_studies;

bool study_run(struct study_page *page, const struct study *study, const struct bench_env *env, bool quick);
void study_clear(struct study_page *page);

/* A table of the page; columns: names separated by tabs. */
struct study_table *study_table(struct study_page *page, const char *id, const char *title, const char *columns,
                                const char *note);
/* The next cells of the row, with tabs between them; a number that is not finite is "-".  study_row ends it. */
void study_cells(struct study_table *t, const char *fmt, ...) SS_PRINTF(2, 3);
void study_row(struct study_table *t);

void study_markdown(struct text *out, const struct study_page *page, bool files);
void study_json(struct json *j, const struct study_page *page);

#endif
