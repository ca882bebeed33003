/* What an audit is of. */
#ifndef STICKSLIP_SCENE_FINGERPRINT_H
#define STICKSLIP_SCENE_FINGERPRINT_H

#include "model/model.h"
#include "scene/scene.h"

/* What an audit or a study of damages is of, as a number in hexadecimal digits: the same for formulas of the paper and
   its overlay that are read alike, and a scene of the same parameters, printed numbers and word; errata, claims and
   what is asked for have no part in it. */
void audit_fingerprint(struct text *out, const struct model *m, const struct scene *s);

#endif
