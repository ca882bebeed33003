/* What the writers of the study of digits share. */
#ifndef STICKSLIP_STABILITY_WORDS_H
#define STICKSLIP_STABILITY_WORDS_H

#include "base/text.h"
#include "record/stability_result.h"

/* Digits to a tenth; NULL where there are none. */
const char *stability_tenths(char buffer[32], double x);
/* The same, "-" where there are none. */
const char *stability_digits(char buffer[32], double x);

/* Of a row whose digits are all lost the relative error, to one digit; NULL elsewhere. */
const char *stability_relative_error(char buffer[32], const struct stability_row *row);
/* What is lost: digits; "sign"; "all digits (relative error 3e7)". */
const char *stability_lost(char buffer[80], const struct stability_row *row);
/* Digits that the other layer's form keeps where the formula loses them; NaN without one. */
double stability_gained(const struct stability_row *row);

/* The order of pointers to rows in the ledger, for qsort: losses of the formula's own, the largest first, those of more
   than all digits by how much more; equal ones as they come. */
int stability_by_loss(const void *a, const void *b);
/* One row a formula: its worst, in that order.  An array to be freed. */
const struct stability_row **stability_ledger(int *n, const struct stability_result *r);

/* The command that shows the point. */
void stability_add_command(struct text *out, const struct stability_result *r, const struct stability_row *row,
                           const char *witness);
/* "cancellation between a and b", in code style when asked for. */
void stability_add_cause(struct text *out, const struct stability_row *row, const char *quote);
/* Predicted against observed loss, as a table of Markdown. */
void stability_add_confusion(struct text *out, const struct stability_result *r);
/* How many formulas lose digits, and how well the rule predicts it, in a sentence without its full stop. */
void stability_add_summary(struct text *out, const struct stability_result *r);

#endif
