/* Text for a page that is HTML and well-formed XML at once. */
#ifndef STICKSLIP_REPORT_HTML_H
#define STICKSLIP_REPORT_HTML_H

#include "base/text.h"

/* Text in which $...$ is mathematics; changed as in formula_mathml, or NULL. */
void html_text(struct text *out, const char *s, const bool *changed);
/* The same without mathematics between dollar signs, but with names like z_10 and powers like 1e-9 and s^2 set as
   such. */
void html_prose_n(struct text *out, const char *s, size_t len);
void html_prose(struct text *out, const char *s);
/* One formula, without dollar signs. */
void html_math(struct text *out, const char *tex, const bool *changed);
void html_code(struct text *out, const char *s);
/* A name in the value of an id: characters that an id cannot have by their codes. */
void html_anchor(struct text *out, const char *name);
/* Ends a sentence that may have an end of its own. */
void html_stop(struct text *out);

#endif
