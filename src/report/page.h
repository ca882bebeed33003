/* What the sections of index.html are made of. */
#ifndef STICKSLIP_REPORT_PAGE_H
#define STICKSLIP_REPORT_PAGE_H

#include "base/text.h"
#include "record/result.h"
#include "sheet.h"

struct page {
  struct text *out;
  const struct audit_result *r;
};

/* Words with texts in them, as sheet_add has them. */
#define page_add(page, ...) html_add((page)->out, __VA_ARGS__)

/* "eq-44b" as (44b), other names as code; a link to what is said about the failure (f-), or to the claim's row (c-)
   when it was judged and is none. */
void page_claim(const struct page *p, const char *id);
/* "appendix_a" as words. */
void page_section_name(const struct page *p, const char *section);

/* What the routes of a finding say, as a list. */
void page_statements(const struct page *p, const struct finding *f);

/* The command that repeats the audit. */
void page_recheck(const struct page *p);

/* Begins a section with its heading; the ids are s-NAME and h-NAME. */
void page_begin_section(const struct page *p, const char *name, const char *heading);
/* Begins a part of the archive, closed until it is opened or a link leads into it; the caller ends it (details). */
void page_begin_fold(const struct page *p, const char *name, const char *heading);

/* The row of a description that says how a claim is judged again. */
#define PAGE_RECHECK "<dt>Recheck</dt>\n<dd>%c</dd>\n"

/* A table that may be wider than the page.  With class "stack" it is read row by row on a narrow screen: each cell but
   the first says its column before it. */
struct column {
  const char *name; /* plain text without markup */
  bool number;      /* set to the right */
};
void page_begin_table(const struct page *p, const char *class, const char *caption, const struct column *columns,
                      size_t n);
void page_end_table(const struct page *p);
/* The beginning of a cell, which the caller ends; a whole one, words with one text in them. */
void page_begin_cell(const struct page *p, const struct column *column);
void page_cell(const struct page *p, const struct column *column, const char *words, const char *text);
/* A cell with a number, a dash where that is below 0. */
void page_number(const struct page *p, const struct column *column, long n);
extern const char page_dash[];

#endif
