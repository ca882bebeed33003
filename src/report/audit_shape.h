/* The shapes of audit.json and of its parts that stand alone. */
#ifndef STICKSLIP_REPORT_AUDIT_SHAPE_H
#define STICKSLIP_REPORT_AUDIT_SHAPE_H

#include "json_shape.h"
#include "record/result.h"

#define AUDIT_SCHEMA "stickslip-audit-2"

extern const struct shape audit_shape;    /* struct audit_result */
extern const struct shape readings_shape; /* struct readings */

#endif
