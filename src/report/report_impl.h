/* Parts of reports that one writer calls on another for. */
#ifndef STICKSLIP_REPORT_IMPL_H
#define STICKSLIP_REPORT_IMPL_H

#include "stickslip/json.h"
#include "stickslip/report.h"

/* The member "readings"; null when there are none. */
void report_readings_member(struct json *j, const char *key, const struct readings *r);

#endif
