/* The ledger of lost digits from its result record: pure functions, the same bytes twice. */
#ifndef STICKSLIP_REPORT_STABILITY_H
#define STICKSLIP_REPORT_STABILITY_H

#include "base/text.h"
#include "record/stability_result.h"

void report_stability_json(struct text *out, const struct stability_result *r);
/* The worst first; it shows the pictures of the maps, map-1.svg and so on. */
void report_stability_markdown(struct text *out, const struct stability_result *r);
/* A row for each formula and region.  "by the formula" is its excess: it counts on where all digits are lost. */
void report_stability_tsv(struct text *out, const struct stability_result *r);
/* For a terminal: the worst formulas, counts, the confusion matrix. */
void report_stability_text(struct text *out, const struct stability_result *r);

/* A map as a table "x y lost after", and as a picture, an SVG document. */
void report_stability_map_tsv(struct text *out, const struct stability_result *r, int map);
void report_stability_picture(struct text *out, const struct stability_result *r, int map, const char *id);

#endif
