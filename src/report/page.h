/* What the sections of index.html are made of. */
#ifndef STICKSLIP_REPORT_PAGE_H
#define STICKSLIP_REPORT_PAGE_H

#include "base/text.h"
#include "record/result.h"

struct page {
  struct text *out;
  const struct audit_result *r;
};

/* "eq-44b" as (44b), other names as code; a link to what is said about the failure (f-), or to the claim's row (c-)
   when it was judged and is none. */
void page_claim(const struct page *p, const char *id);
void page_claims(const struct page *p, const struct id_list *list);
/* The same as a link to the row of a claim that was judged. */
void page_row(const struct page *p, const char *id);
/* The verdict as a badge. */
void page_verdict(const struct page *p, enum verdict v);
/* "appendix_a" as words. */
void page_section_name(const struct page *p, const char *section);

/* What the routes of a finding say, as a list. */
void page_statements(const struct page *p, const struct finding *f);

/* The command that repeats the audit. */
void page_recheck(const struct page *p);

/* Begins a link to where the id stands under that prefix: "c-" the row of a claim, "f-" what is said of a failure. */
void page_begin_link(const struct page *p, const char *prefix, const char *id);
/* Begins a section with its heading; the ids are s-NAME and h-NAME. */
void page_begin_section(const struct page *p, const char *name, const char *heading);
/* Begins a part of the archive, closed until it is opened or a link leads into it; the caller ends it (details). */
void page_begin_fold(const struct page *p, const char *name, const char *heading);

/* A table that may be wider than the page.  With class "stack" it is read row by row on a narrow screen: each cell but
   the first says its column before it. */
struct column {
  const char *name; /* plain text without markup */
  bool number;      /* set to the right */
};
void page_begin_table(const struct page *p, const char *class, const char *caption, const struct column *columns,
                      size_t n);
void page_end_table(const struct page *p);
/* The beginning of a cell, which the caller ends. */
void page_cell(const struct page *p, const struct column *column);
/* A cell of text with mathematics between dollar signs. */
void page_text_cell(const struct page *p, const struct column *column, const char *text);

/* The two masses on the belt. */
void page_belt(const struct page *p);

#endif
