/* Text with formulas in it, for Markdown and for LaTeX. */
#ifndef STICKSLIP_REPORT_SHEET_H
#define STICKSLIP_REPORT_SHEET_H

#include "record/result.h"

/* A document in one of two dialects. */
struct sheet {
  struct text *out;
  bool tex;
};

/* Text in which $...$ is mathematics; everything else is escaped, so that it shows as it is.  Mathematics that the
   dialect might stumble over (braces that do not match, commands beyond those of formulas) is shown as code. */
void sheet_text(const struct sheet *s, const char *text);
/* The same where names and products outside dollar signs are those of a sentence of the program: z_10, e1, chi and
   V*t_a are typeset. */
void sheet_prose(const struct sheet *s, const char *text);
/* One formula, without dollar signs. */
void sheet_math(const struct sheet *s, const char *math);
/* The right values of the root's printed numbers, as a sentence; nothing where it has none. */
void sheet_values(const struct sheet *s, const struct audit_result *r, const struct root_cause *root);
/* A command or a name as it is typed. */
void sheet_code(const struct sheet *s, const char *code);

#endif
