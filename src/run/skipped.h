/* What a run left out, and why: made from what was really not done. */
#ifndef STICKSLIP_AUDIT_SKIPPED_H
#define STICKSLIP_AUDIT_SKIPPED_H

#include "run.h"

/* touched: the parts of work.h that some piece has used. */
void skipped_describe(struct audit_result *out, const struct claims *claims, const struct claims *controls,
                      const struct scene *s, const struct audit_options *opt, const struct pieces *first,
                      const struct pieces *second, unsigned touched);

#endif
