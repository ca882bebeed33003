/* Pictures from tables: what they are made of.  A picture is an SVG with one panel or more below each other; colours
   and dashes come from a style sheet, by the class of a curve, so that it can be read in dark mode and in grey. */
#ifndef STICKSLIP_REPORT_PLOT_H
#define STICKSLIP_REPORT_PLOT_H

#include "base/arena.h"
#include "base/text.h"
#include "record/result.h"

/* --- Tables --- */

/* The rows of a table as text; cells point into the arena. */
struct rows {
  struct arena arena;
  const char **heading;
  const char ***cell; /* [row][column] */
  size_t n, cap, columns;
  const char *orbit; /* struct data_table; the record's */
};
/* From TSV: a line of names, then the rows; lines that begin with # are passed over. */
void rows_parse(struct rows *t, const char *text);
/* false where the record has no such table. */
bool rows_read(struct rows *t, const struct audit_result *r, const char *name);
void rows_clear(struct rows *t);
/* The column of this name, or t->columns. */
size_t rows_column(const struct rows *t, const char *name);
/* NaN where the cell holds no number. */
double rows_number(const struct rows *t, size_t row, size_t column);
bool rows_is(const struct rows *t, size_t row, size_t column, const char *text);
/* The last of the rows from this one on that have the same in the column. */
size_t rows_end(const struct rows *t, size_t row, size_t column);

/* --- Panels --- */

/* Attributes of a line, so that it is one where no style sheet is read. */
#define PLOT_STROKE "fill=\"none\" stroke=\"currentColor\""
#define PLOT_FAINT  PLOT_STROKE " stroke-width=\".3\""
enum { PLOT_WIDTH = 360, PLOT_LEFT = 46, PLOT_RIGHT = 14, PLOT_CLASSES = 4 };
/* Of curves that are told apart.  Those of many, "k0", "k1", ..., differ in marker and dash together, 52 of them, and
   the first 24 in colour as well; they are drawn below a key that names them. */
extern const char *const plot_class[PLOT_CLASSES];

struct plot {
  struct text *out;
  const char *id;          /* of the picture; those inside begin with it */
  double width;            /* of the picture, in pixels */
  double left, right;      /* of the panel */
  int panels;              /* begun so far */
  double top, height;      /* of the panel */
  double bottom;           /* of the picture so far */
  double low[2], high[2];  /* what it shows: x, y */
  bool power[2];           /* the axis shows 10^x */
  const double *exponents; /* y shows 10^-n at -log10 n, with ticks at these, which 0 ends; NULL: it does not */
  bool open;               /* a curve has begun */
};
/* A picture that is written to `out`, of this width, with panels of the picture's width. */
struct plot plot_begin(struct text *out, const char *id, double width);
/* The whole SVG of what was drawn, with a title and words for who does not see it, plain text; alone: a document of its
   own. */
void plot_svg(struct text *out, const struct plot *p, const char *title, const char *told, bool alone);
/* A style sheet of a picture, each declaration that asks for a custom property after the same with its light colour:
   programs that know no custom properties drew the whole picture black.  Aborts on a property that neither
   picture_alone.css nor picture.css sets. */
void plot_style(struct text *out, const char *css);

/* Widens [low, high] to hold x; NaN is passed over. */
void plot_hold(double *low, double *high, double x);
/* What the axes show is to be found anew; and an axis widened to hold a column of a table. */
void plot_forget(struct plot *p);
void plot_hold_column(struct plot *p, int axis, const struct rows *t, size_t column);
/* Both: the columns x and, from y on, n columns. */
void plot_hold_columns(struct plot *p, const struct rows *t, size_t x, size_t y, size_t n);
/* A panel at `top`: frame, ticks and labels; axis labels in the markup of plot_text.  Then what is drawn is cut off at
   its frame until plot_free. */
void plot_panel(struct plot *p, double top, double height, const char *x_label, const char *y_label);
/* From here on nothing is cut off. */
void plot_free(struct plot *p);
/* One more point of a curve of this class; NaN breaks it.  plot_end ends it. */
void plot_point(struct plot *p, const char *class, double x, double y);
void plot_end(struct plot *p);
/* One column of a table against another. */
void plot_column(struct plot *p, const struct rows *t, const char *class, size_t x, size_t y);
/* A straight line, in numbers of the axes. */
void plot_line(struct plot *p, const char *class, double x0, double y0, double x1, double y1);
void plot_dot(struct plot *p, const char *class, double x, double y);
/* The same with all of its classes and its radius. */
void plot_dot_of(struct plot *p, const char *classes, double x, double y, double radius);
/* A filled part, in numbers of the axes; until plot_end one more of the same.  Classes "shade s0" to "shade s5" are
   darker and darker, "shade d0" to "shade d8" run from light to dark in colours of their own, "shade d9" is grey. */
void plot_box(struct plot *p, const char *class, double x0, double y0, double x1, double y1);
/* Where a number lies, in pixels. */
double plot_x(const struct plot *p, double x);
double plot_y(const struct plot *p, double y);
/* Room beyond what is held, in parts of its range. */
void plot_widen(struct plot *p, int axis, double below, double above);
/* Text at pixels: _1 and _{..} are subscripts, ^{..} a superscript, *z* leans.  anchor: start, middle, end. */
void plot_text(struct plot *p, double x, double y, const char *anchor, const char *text);
/* Words in lines of the picture's width from there down; where the next line would be. */
double plot_lines(struct plot *p, double x, double y, const char *words);
/* The name of a parameter, as scenes have it, in the same markup. */
enum { PLOT_LABEL = 80 };
void parameter_label(char label[PLOT_LABEL], const char *name);
/* A key of n curves, dots (class "dot ...") or filled parts ("shade ..."), in lines from the top of the picture; class
   and text of each.  Its height. */
double plot_key(struct plot *p, const char *const (*entry)[2], int n);

#endif
