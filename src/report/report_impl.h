/* What the writers share. */
#ifndef STICKSLIP_REPORT_IMPL_H
#define STICKSLIP_REPORT_IMPL_H

#include "stickslip/json.h"
#include "stickslip/report.h"

/* Whether LaTeX with amsmath can set the len bytes as a formula; false where that is not understood. */
bool math_is_sane(const char *s, size_t len);

/* A document in one of two dialects. */
struct sheet {
  struct text *out;
  bool tex;
};

/* Text in which $...$ is mathematics; everything else is escaped, so that it shows as it is.  Mathematics that the
   dialect might stumble over (braces that do not match, commands beyond those of formulas) is shown as code. */
void sheet_text(const struct sheet *s, const char *text);
/* One formula, without dollar signs. */
void sheet_math(const struct sheet *s, const char *math);
/* A command or a name as it is typed. */
void sheet_code(const struct sheet *s, const char *code);

/* Whether a claim does not hold as printed. */
bool report_is_failure(const struct finding *f);
/* The section of audit.md about consequences. */
void report_consequences(struct text *out, const struct audit_result *r);
/* The member "readings"; null when there are none. */
void report_readings_member(struct json *j, const char *key, const struct readings *r);

#endif
