/* A formula of the report in LaTeX: whether it can be shown, the same as MathML, and where two of them differ. */
#ifndef STICKSLIP_REPORT_FORMULA_H
#define STICKSLIP_REPORT_FORMULA_H

#include "base/tex.h"
#include "base/text.h"

/* Whether LaTeX with amsmath can set the len bytes as a formula; false where that is not understood. */
bool formula_is_sane(const char *s, size_t len);
/* The formula as MathML with the TeX as annotation, in as many pieces as a line may be broken into; false, and nothing
   added, where the formula is not understood.  changed: for each byte of the formula, whether the symbol that begins
   there is to be marked; NULL for none. */
bool formula_mathml(struct text *out, const char *tex, size_t len, const bool *changed);
/* The end of the first piece of [s, end): behind a comma, before a wide space, and, when it has become long, before an
   operator that follows something. */
const char *formula_piece_end(const char *s, const char *end);
/* Whether TeX would break a line before the token: an operator or a relation. */
bool formula_breaks_before(const struct tex_token *t);
/* Marks in each of two formulas the bytes at which symbols begin that the other has not; false, and nothing marked,
   where they have too little in common.  The arrays are as long as the formulas. */
bool formula_changes(bool *a_changed, const char *a, bool *b_changed, const char *b);
/* The marks of a formula carried over to a text that says the same between dollar signs, where neighbours on both
   sides tell the symbol. */
void formula_changes_in_text(bool *changed, const char *text, const char *a, const bool *a_changed);

#endif
