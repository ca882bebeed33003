/* What the paper's text is worth as a function of free symbols. */
#ifndef STICKSLIP_TESTS_PAPER_VALUE_H
#define STICKSLIP_TESTS_PAPER_VALUE_H

#include "model/model.h"
#include "tape/exact.h"

/* The value of a text in a field by the corrected formulas, as a function of free symbols: a status. */
int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text);

#endif
