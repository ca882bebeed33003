/* A record in which every text is a trap for the languages that it is written in, filled by the tables of its members
   (report/json_shape.h) so that none is forgotten. */
#ifndef STICKSLIP_TESTS_TRAPS_H
#define STICKSLIP_TESTS_TRAPS_H

#include "record/result.h"
#include "table.h"

/* One record of each kind for each row of a table of one column.  Ids are made distinct, and claims rest on those
   behind them; words and truths go round, and what may be missing is missing now and then.  To be cleared; the table
   stays. */
void traps_record(struct audit_result *r, const struct table *traps);

#endif
