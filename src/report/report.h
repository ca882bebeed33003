/* Reports: pure functions of the result record, which evaluate nothing and know neither formulas nor numbers but as
   text. In src/report a writer for each file that a run leaves (audit_json.c, audit_markdown.c, last_line.c, errata.c,
   csv.c, junit.c, dot.c; page.c with its sections, page_*.c, its style sheets and script, *.css and *.js, for
   index.html; picture*.c for the SVG files) stands on what they share: questions to the record (finding.h), formulas
   (formula.h), text as each format shows it (escape.h, sheet.h), and JSON by one table for writer and reader
   (audit_shape.h). */
#ifndef STICKSLIP_REPORT_REPORT_H
#define STICKSLIP_REPORT_REPORT_H

#include "base/text.h"
#include "record/result.h"

/* The contract's audit.json: no time stamps, timings or machine-dependent residuals. */
void report_json(struct text *out, const struct audit_result *r);
/* audit.json back into a record (initialised; clear it all the same): all that the other writers of this header but
   report_run read, who wrote the file notwithstanding.  Tables have their names and are empty: their text stands in the
   files of those names.  What was measured on a machine (machine_*) is in run.json alone and stays unknown.  Values are
   checked: types, ranges, words, what one part of the file tells of another, at most 1500 names.  Members that this
   version does not know are passed over.  false with d set, at the place, when it is no such file. */
bool report_read(struct audit_result *out, const struct source *s, struct diag *d);
/* What audit.json holds, for people: what needs attention first. */
void report_markdown(struct text *out, const struct audit_result *r);
/* The readings alone: a document of its own, and the section of audit.md. */
void report_readings_json(struct text *out, const struct audit_result *r);
void report_readings_markdown(struct text *out, const struct readings *r);
/* The claims as a graph for Graphviz: an arrow from what a claim rests on to the claim. */
void report_dot(struct text *out, const struct audit_result *r);
/* What does not hold as printed, worst first, for the paper's authors; Markdown, and LaTeX that needs amsmath. */
void report_errata(struct text *out, const struct audit_result *r);
void report_errata_tex(struct text *out, const struct audit_result *r);
/* The page index.html: one file, HTML and well-formed XML, that shows all of the record; formulas as MathML. */
void report_html(struct text *out, const struct audit_result *r);
/* The pictures drawn from the record's tables: how many there are, the name of one (a file's, without .svg), and the
   SVG as a document of its own; false, and nothing added, where its table is missing. */
int report_pictures(void);
const char *report_picture_id(int i);
bool report_picture(struct text *out, const struct audit_result *r, int i);
/* A row for each claim; a test case for each claim, control and comparison of routes. */
void report_csv(struct text *out, const struct audit_result *r);
void report_junit(struct text *out, const struct audit_result *r);
/* The facts of one run on one machine: seconds, versions of the software beneath, residuals of routes in double. */
void report_run(struct text *out, const struct audit_result *r, double seconds, const char *software);
/* The last line of verify: "paper: 152 statements: 113 proved, ...; as recorded". */
void report_line(struct text *out, const struct audit_result *r);

#endif
