/* The pictures: each is a title, what it shows in words and numbers, and an SVG, all from one table of the record. */
#ifndef STICKSLIP_REPORT_PICTURE_H
#define STICKSLIP_REPORT_PICTURE_H

#include "plot.h"

struct picture {
  const char *id, *table, *title; /* the SVG's file is id.svg; text with mathematics as sheet_text has it */
  /* For who sees it: what follows, $...$ being mathematics; NULL for a picture that does not stand in the page. */
  void (*say)(struct text *out, const struct rows *t);
  void (*tell)(struct text *out, const struct rows *t); /* for who does not: what is there; plain text */
  void (*draw)(struct plot *p, const struct rows *t);
};

extern const struct picture picture_history, picture_portrait;                /* picture_motion.c */
extern const struct picture picture_return_map;                               /* picture_return.c */
extern const struct picture picture_margins, picture_long_run, picture_steps; /* picture_curves.c */
extern const struct picture picture_along, picture_bifurcations;              /* picture_along.c */
extern const struct picture picture_map;                                      /* picture_map.c */
extern const struct picture picture_animation;                                /* picture_animation.c */
extern const struct picture picture_planes;                                   /* picture_system.c */

/* Where phases end, by the columns of their names and times, lines with the names between (picture_curves.c). */
void picture_phases(struct plot *p, const struct rows *t, size_t phase, size_t time);

#endif
