/* The files of a report, or of another command, written to one folder together: all or none. */
#ifndef STICKSLIP_REPORT_FOLDER_H
#define STICKSLIP_REPORT_FOLDER_H

#include "report.h"

struct output {
  const char *folder;
  struct text path[MAX_FILE_ITEMS], body[MAX_FILE_ITEMS];
  int n;
};
void output_init(struct output *out, const char *folder);
void output_clear(struct output *out);
/* One more file of that name; what is to stand in it goes into the text. */
struct text *output_add(struct output *out, const char *fmt, ...) SS_PRINTF(2, 3);
/* Takes the last file back. */
void output_drop(struct output *out);
/* The tables of a result, a file for each. */
void output_add_tables(struct output *out, const struct audit_result *r);
/* audit.json of the result, and what is written from it alone; false with d set where it cannot be read back.  score:
   of the study of damages that stands beside the folder, or NULL. */
bool output_add_report(struct output *out, const struct audit_result *r, const struct mutation_score *score,
                       struct diag *d);
/* Everything that shows what audit.json and its tables hold. */
void output_add_views(struct output *out, struct audit_result *r, const struct mutation_score *score);
/* A file that an earlier run wrote and this one does not would be taken for a result of this one: it goes. */
void output_remove_stale(const struct output *out, const char *fmt, ...) SS_PRINTF(2, 3);
/* Two runs at one folder write one after the other, so that it never holds some files of each. */
bool output_write(const struct output *out, struct diag *d);

#endif
