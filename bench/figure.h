/* Figures of curves, drawn by the report's plotter: panels side by side, in each of which every curve has some points
   or none, below one key.  Curves differ in colour, and in marker and dash together, so that the figure is read in grey
   too. */
#ifndef STICKSLIP_BENCH_FIGURE_H
#define STICKSLIP_BENCH_FIGURE_H

#include "report/plot.h"

/* power and exponents: as in struct plot. */
struct figure_panel {
  const char *x, *y; /* labels, in the markup of plot_text */
  bool power[2];
  const double *exponents;
  double low, high; /* of y; where they are equal, what the points have */
};

struct figure {
  const char *id, *title;
  int panels;
  struct figure_panel panel[2];
  double limit; /* a line at this y in the first panel, what rounding the inputs costs; 0: none */
  struct figure_curve {
    const char *name;
    char class[16];
    bool drawn; /* it has a point */
  } * curve;
  size_t n_curves, cap_curves;
  struct figure_point {
    size_t curve;
    int panel;
    double x, y;
  } * point;
  size_t n_points, cap_points;
};

/* The next curve; those without a point are not shown, but count in how the others look. */
void figure_curve(struct figure *f, const char *name);
/* One more point of the last curve; what is not finite is passed over. */
void figure_point(struct figure *f, int panel, double x, double y);
/* The picture as a document; the figure is cleared. */
void figure_svg(struct text *out, struct figure *f);

#endif
