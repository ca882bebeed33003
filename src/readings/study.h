/* How printed numbers could have arisen. */
#ifndef STICKSLIP_READINGS_STUDY_H
#define STICKSLIP_READINGS_STUDY_H

#include "claim/judging.h"
#include "model/model.h"
#include "record/result.h"
#include "scene/scene.h"

/* How the printed numbers of the scene could have arisen: which of them were inputs, exactly as printed, which
   equations were solved and which dropped, how numbers were carried from one formula into the next.  The equations are
   the paper's, (12), (14), (16), (18), (44)-(46), with its matrices in the corrected layer, and in the printed one
   where that gives another motion.  Double precision narrows down, balls decide.  Returns NULL, or why there was
   nothing to search. */
const char *audit_readings(struct audit_result *out, const struct model *m, const struct scene *s);

/* Once claims are judged and readings are found: what the first reading, which assumes least, says of each printed
   number that was refuted, as evidence that only states something. */
void readings_explain(struct audit_result *out, const struct claims *claims);

/* What the six equations (12), (14), (16) and (18) give, at the data of an admissible orbit, with the matrices under
   that equation number as printed and all else corrected: a sentence; NULL where no matrix of a phase is another, or no
   such solution was proved. */
const char *readings_as_printed(struct judge *j, const char *own);

#endif
