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

/* The files of these names, page.css and so on, which the build makes characters of.  The page is well-formed XML, so
   that sheets and script hold neither "<" nor "&".  The sheet has light, dark and print colours and names each verdict
   by a sign besides its colour; the script filters, sorts and opens what is there without it.  picture_alone: colours
   of a picture that is a document of its own; page_belt: the two masses on the belt, in the page's own colours, and in
   words; page_nav: the links at the head; page_filter: what the script alone can use; page_limits: items of a list. */
extern const char page_css[], page_js[], picture_css[], picture_alone_css[], picture_map_css[], picture_animation_css[],
    page_belt_svg[];
extern const char page_nav_html[], page_filter_html[], page_limits_html[], page_limits_model_html[];

#endif
