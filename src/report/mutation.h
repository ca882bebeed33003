/* mutation.json, mutation.md, repairs.json and repairs.md from their result records: pure functions, the same bytes
   twice. */
#ifndef STICKSLIP_REPORT_MUTATION_H
#define STICKSLIP_REPORT_MUTATION_H

#include "json_shape.h"
#include "record/mutation_result.h"

#define MUTATION_SCHEMA "stickslip-mutation-2"

extern const struct shape mutation_score_shape; /* struct mutation_score, in mutation.json */

void report_mutation_json(struct text *out, const struct mutation_result *r);
void report_mutation_markdown(struct text *out, const struct mutation_result *r);
/* For a terminal: the counts, and every survivor on two lines. */
void report_mutation_text(struct text *out, const struct mutation_result *r);

void report_repairs_json(struct text *out, const struct repair_result *r);
void report_repairs_markdown(struct text *out, const struct repair_result *r);
void report_repairs_text(struct text *out, const struct repair_result *r);

#endif
