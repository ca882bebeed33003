/* Reports: pure functions of the result record. */
#ifndef STICKSLIP_REPORT_H
#define STICKSLIP_REPORT_H

#include "stickslip/result.h"
#include "stickslip/text.h"

/* The contract's audit.json: no time stamps, timings or machine-dependent residuals. */
void report_json(struct text *out, const struct audit_result *r);
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
/* A row for each claim; a test case for each claim, control and comparison of routes. */
void report_csv(struct text *out, const struct audit_result *r);
void report_junit(struct text *out, const struct audit_result *r);
/* The facts of one run on one machine: seconds, residuals of routes in double. */
void report_run(struct text *out, const struct audit_result *r, double seconds);
/* One line: "paper: 40 claims: 20 supported, ..., as recorded". */
void report_line(struct text *out, const struct audit_result *r);

#endif
