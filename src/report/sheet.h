/* Text with formulas in it, for Markdown, LaTeX and HTML. */
#ifndef STICKSLIP_REPORT_SHEET_H
#define STICKSLIP_REPORT_SHEET_H

#include "record/result.h"

/* A document in one of three dialects. */
enum dialect { DIALECT_MARKDOWN, DIALECT_TEX, DIALECT_HTML };
struct sheet {
  struct text *out;
  enum dialect dialect;
};

/* The words, in which each of these stands for the next text behind them, NULL for none:
     %s as it is, %e escaped, so that it shows as it is,
     %t with mathematics between dollar signs, %p with names like z_10 set as mathematics (sheet_text, sheet_prose),
     %m one formula, %c code, %v a verdict; of HTML alone %a what an id is made of, %n a claim by its id.
   %. ends a sentence that may have an end of its own.  Another %, or a wrong number of texts, is a mistake of the
   program. */
#define sheet_add(sheet, words, ...)                                                                                   \
  sheet_add_texts(sheet, words, (const char *const[]){__VA_ARGS__},                                                    \
                  sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))
#define HTML(out)          (&(struct sheet){out, DIALECT_HTML})
#define html_add(out, ...) sheet_add(HTML(out), __VA_ARGS__)
void sheet_add_texts(const struct sheet *s, const char *words, const char *const *text, size_t n);

/* Text in which $...$ is mathematics; everything else is escaped, so that it shows as it is.  Mathematics that the
   dialect might stumble over (braces that do not match, commands beyond those of formulas) is shown as code. */
void sheet_text(const struct sheet *s, const char *text);
/* The same where names and products outside dollar signs are those of a sentence of the program: z_10, e1, chi and
   V*t_a are typeset.  In HTML sheet_text does so too, and here a dollar sign is one. */
void sheet_prose(const struct sheet *s, const char *text);
void sheet_prose_n(const struct sheet *s, const char *text, size_t len);
/* What the record says with a small letter first, as a sentence: names and $...$ are typeset in every dialect. */
void sheet_sentence(const struct sheet *s, const char *text);
/* Escaped, so that it shows as it is (escape.c). */
void sheet_plain(const struct sheet *s, const char *text, size_t len);
/* A text and a formula in HTML with marks in what has changed, as in formula_mathml; NULL for none. */
void html_text(struct text *out, const char *text, const bool *changed);
/* HTML with mathematics between dollar signs. */
void html_with_math(struct text *out, const char *html);
void html_math(struct text *out, const char *tex, const bool *changed);
/* The right values of the root's printed numbers, as a sentence; nothing where it has none. */
void sheet_values(const struct sheet *s, const struct audit_result *r, const struct root_cause *root);
/* "a, b and c", each as sheet_prose has it. */
void sheet_list(const struct sheet *s, const char *const *list, int n);
/* The head of a table in Markdown: columns with bars between them; one that ends in a colon is set to the right. */
void markdown_head(struct text *out, const char *columns);
/* The same with a column to the right for each of n more names. */
void markdown_head_of(struct text *out, const char *columns, const char *const *name, int n);
/* Ends a sentence that may have an end of its own. */
void sheet_stop(const struct sheet *s);

#endif
