/* What index.html is put together from. */
#ifndef STICKSLIP_REPORT_SECTIONS_H
#define STICKSLIP_REPORT_SECTIONS_H

#include "page.h"
#include "picture.h"

/* The sections, each from heading to end. */
void page_letter(const struct page *p);
void page_findings(const struct page *p);
/* The parts of the archive, each folded. */
void page_model(const struct page *p);
void page_pictures(const struct page *p);
void page_every_claim(const struct page *p);
void page_power(const struct page *p);
void page_limits(const struct page *p);

/* A picture where its table is there; words: its caption, or NULL for the picture's own. */
void page_picture(const struct page *p, const struct picture *q, const char *words);

extern const char *const page_style;
extern const char *const picture_style; /* of curves */
extern const char *const page_script;

#endif
