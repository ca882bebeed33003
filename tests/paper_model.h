/* The equation files of the paper and their corrections, as verify reads them. */
#ifndef STICKSLIP_TESTS_PAPER_MODEL_H
#define STICKSLIP_TESTS_PAPER_MODEL_H

#include "stickslip/model.h"

/* overlay: a text over them as a user would give it, or NULL; with the records of the controls.  To be cleared. */
void paper_model(struct model *m, const char *overlay, bool with_controls);

#endif
