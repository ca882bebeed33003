/* What the parts of index.html share. */
#ifndef STICKSLIP_REPORT_PAGE_H
#define STICKSLIP_REPORT_PAGE_H

#include "impl.h"

/* --- Mathematics --- */

/* The formula as MathML with the TeX as annotation, in as many pieces as a line may be broken into; false, and nothing
   added, where the formula is not understood.  changed: for each byte of the formula, whether the symbol that begins
   there is to be marked; NULL for none. */
bool mathml_add(struct text *out, const char *tex, size_t len, const bool *changed);
/* Marks in each of two formulas the bytes at which symbols begin that the other has not; false, and nothing marked,
   where they have too little in common.  The arrays are as long as the formulas. */
bool math_changes(bool *a_changed, const char *a, bool *b_changed, const char *b);
/* The marks of a formula carried over to a text that says the same between dollar signs, where neighbours on both
   sides tell the symbol. */
void math_changes_in_text(bool *changed, const char *text, const char *a, const bool *a_changed);

/* --- Text --- */

/* Bytes as they show; what XML cannot hold becomes U+FFFD, blanks of any kind a blank. */
void html_plain_n(struct text *out, const char *s, size_t len);
void html_plain(struct text *out, const char *s);
/* Text in which $...$ is mathematics; changed as in mathml_add, or NULL. */
void html_text(struct text *out, const char *s, const bool *changed);
/* The same without mathematics between dollar signs, but with names like z_10 and powers like 1e-9 and s^2 set as such. */
void html_prose_n(struct text *out, const char *s, size_t len);
void html_prose(struct text *out, const char *s);
/* One formula, without dollar signs. */
void html_math(struct text *out, const char *tex, const bool *changed);
void html_code(struct text *out, const char *s);
/* The value of an id: the prefix and the name, characters that an id cannot have by their codes. */
void html_anchor(struct text *out, const char *prefix, const char *name);
/* Ends a sentence that may have an end of its own. */
void html_stop(struct text *out);

/* --- The page --- */

struct page {
  struct text *out;
  const struct audit_result *r;
};

/* "eq-44b" as (44b), other names as code; a link to what is said about the failure, or to the claim's row when it was
   judged and is none. */
void page_claim(const struct page *p, const char *id);
void page_claims(const struct page *p, const struct id_list *list);
/* The same as a link to the row of a claim that was judged. */
void page_row(const struct page *p, const char *id);
/* The verdict as a badge. */
void page_verdict(const struct page *p, enum verdict v);
/* "appendix_a" as words. */
void page_section_name(const struct page *p, const char *section);
/* The finding of that name, or NULL. */
const struct finding *page_finding(const struct page *p, const char *id);

/* What the routes of a finding say, as a list; only those with this result, or all when it is NULL. */
void page_statements(const struct page *p, const struct finding *f, const char *result);

/* A table of class "stack" is read row by row on a narrow screen: each cell but the first says its column before it. */
struct column {
  const char *name; /* plain text without markup */
  bool number;      /* set to the right */
};
/* The head of the table, and the beginning of a cell, which the caller ends. */
void page_heads(const struct page *p, const struct column *columns, size_t n);
void page_cell(const struct page *p, const struct column *column);

/* The sections, each from heading to end. */
void page_summary(const struct page *p);
void page_power(const struct page *p);
void page_failures(const struct page *p);
void page_model(const struct page *p);
void page_pictures(const struct page *p); /* picture.c */
void page_every_claim(const struct page *p);
void page_graph(const struct page *p);
void page_routes(const struct page *p);
void page_limits(const struct page *p);

/* Pictures. */
void page_verdict_bar(const struct page *p, const long count[N_VERDICTS]);
void page_belt(const struct page *p);

/* Style sheet and script. */
extern const char *const page_style;
extern const char *const picture_style; /* of curves; picture.c */
extern const char *const page_script;

#endif
