/* What index.html is put together from. */
#ifndef STICKSLIP_REPORT_SECTIONS_H
#define STICKSLIP_REPORT_SECTIONS_H

#include "page.h"

/* The sections, each from heading to end. */
void page_summary(const struct page *p);
/* Parts of the summary. */
void page_roots(const struct page *p);
void page_slips(const struct page *p);
void page_power(const struct page *p);
void page_failures(const struct page *p);
void page_model(const struct page *p);
void page_pictures(const struct page *p);
void page_every_claim(const struct page *p);
void page_graph(const struct page *p);
void page_routes(const struct page *p);
void page_limits(const struct page *p);

extern const char *const page_style;
extern const char *const picture_style; /* of curves */
extern const char *const page_script;

#endif
