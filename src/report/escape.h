/* Text as each format shows it.  What a report quotes was written by others: nothing of it is markup. */
#ifndef STICKSLIP_REPORT_ESCAPE_H
#define STICKSLIP_REPORT_ESCAPE_H

#include "base/text.h"

/* HTML and XML, also between double quotation marks: bytes as they show; what XML cannot hold becomes U+FFFD, blanks of
   any kind a blank. */
void escape_html(struct text *out, const char *s, size_t len);
/* Markdown and LaTeX; control characters become blanks.  TeX is given ASCII: what lies beyond is named by its code
   point. */
void escape_markdown(struct text *out, const char *s, size_t len);
void escape_tex(struct text *out, const char *s, size_t len);
/* What out holds from there on, a page of Markdown that has no links of its own, without HTML: no element, link or
   image is left in it. */
void escape_tags(struct text *out, size_t from);
/* A cell of a table of Markdown whose text may have markup of its own: only a bar would end it. */
void escape_cell(struct text *out, const char *s);
/* A field of CSV, by RFC 4180, quoted unless it is empty; control characters but for ends of lines become blanks, and
   what a spreadsheet would take for a formula has an apostrophe before it. */
void escape_csv(struct text *out, const char *s);
/* A string of Graphviz with its quotation marks. */
void escape_dot(struct text *out, const char *s);

#endif
