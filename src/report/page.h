/* The sections of index.html, and what they are made of. */
#ifndef STICKSLIP_REPORT_PAGE_H
#define STICKSLIP_REPORT_PAGE_H

#include "base/text.h"
#include "picture.h"
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
   the first says its column before it.  columns: plain words with bars between them; one that ends in a colon is set to
   the right. */
void page_begin_table(const struct page *p, const char *class, const char *caption, const char *columns);
void page_end_table(const struct page *p);
/* A row: what begins it, its first cell among that, and behind bars the words of the other cells, with texts in
   them. */
#define page_row(page, columns, words, ...)                                                                            \
  page_row_texts(page, columns, words, (const char *const[]){__VA_ARGS__},                                             \
                 sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))
void page_row_texts(const struct page *p, const char *columns, const char *words, const char *const *text, size_t n);
#define PAGE_ROW "<tr><th scope=\"row\">"
/* A number in a cell, a dash where that is below 0. */
const char *page_number(char shown[24], long n);
extern const char page_dash[];

/* --- The page --- */

/* The sections, each from heading to end. */
void page_letter(const struct page *p);
void page_findings(const struct page *p);
/* The parts of the archive, each folded. */
void page_model(const struct page *p);
void page_pictures(const struct page *p);
void page_every_claim(const struct page *p);
void page_power(const struct page *p);
void page_limits(const struct page *p);

/* A picture where its table is there; words: its caption, or NULL for the picture's own. */
void page_picture(const struct page *p, const struct picture *q, const char *words);

/* The files of these names, page.css and so on, which the build makes characters of.  The page is well-formed XML, so
   that sheets and script hold neither "<" nor "&".  The sheet has light, dark and print colours and names each verdict
   by a sign besides its colour; the script filters, sorts and opens what is there without it.  picture_alone: colours
   of a picture that is a document of its own; page_belt: the two masses on the belt, in the page's own colours, and in
   words; page_head: what stands before the title; page_nav: the links at the head; page_system: the paper's system,
   with mathematics between dollar signs; page_claims: the head of their table; page_filter: what the script alone can
   use; page_limits: items of a list. */
extern const char page_css[], page_js[], picture_css[], picture_alone_css[], picture_map_css[], picture_animation_css[],
    page_belt_svg[];
extern const char page_head_html[], page_nav_html[], page_system_html[], page_findings_html[], page_claims_html[],
    page_filter_html[], page_limits_html[], page_limits_model_html[];

#endif
