/* Panels with axes, curves and labels as SVG.  Coordinates are sums, products and quotients of the tables' decimals
   alone, and so the same on every machine. */
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "escape.h"
#include "page.h"
#include "sheet.h"

const char *const plot_class[] = {"c0", "c1", "c2", "c3"};

/* --- Tables --- */

static void read_row(struct rows *t, const char *line, size_t len) {
  size_t n = 1;
  for (size_t i = 0; i < len; i++) n += line[i] == '\t';
  if (t->columns == 0) t->columns = n; /* the heading */
  const char **cell = arena_alloc(&t->arena, t->columns * sizeof *cell);
  size_t at = 0;
  for (size_t c = 0; c < t->columns; c++) {
    size_t width = 0;
    while (at + width < len && line[at + width] != '\t') width++;
    cell[c] = arena_strndup(&t->arena, line + at, width);
    at += width + (at + width < len);
  }
  *SS_PUSH(t->cell, t->n, t->cap) = cell;
}

void rows_parse(struct rows *t, const char *text) {
  *t = (struct rows){.n = 0};
  for (size_t len; *text; text += len + (text[len] == '\n')) {
    len = strcspn(text, "\n");
    bool heading = t->columns == 0;
    if (*text != '#') read_row(t, text, len);
    if (!heading || !t->columns) continue;
    t->heading = t->cell[0];
    t->n = 0;
  }
}

bool rows_read(struct rows *t, const struct audit_result *r, const char *name) {
  const struct data_table *found = NULL;
  for (size_t i = 0; i < r->n_tables; i++)
    if (strcmp(r->tables[i].name, name) == 0) found = &r->tables[i];
  rows_parse(t, found ? found->text : "");
  if (found) t->orbit = found->orbit;
  return t->n > 0;
}

void rows_clear(struct rows *t) {
  free(t->cell);
  arena_clear(&t->arena);
}

double rows_number(const struct rows *t, size_t row, size_t column) {
  char *end;
  if (column >= t->columns) return (double)NAN;
  const char *text = t->cell[row][column];
  double x = strtod(text, &end);
  return end == text || *end || !isfinite(x) ? (double)NAN : x;
}

size_t rows_column(const struct rows *t, const char *name) {
  return (size_t)word_find(name, t->heading, (int)t->columns);
}

bool rows_is(const struct rows *t, size_t row, size_t column, const char *text) {
  return column < t->columns && strcmp(t->cell[row][column], text) == 0;
}

size_t rows_end(const struct rows *t, size_t row, size_t column) {
  while (row + 1 < t->n && rows_is(t, row + 1, column, t->cell[row][column])) row++;
  return row;
}

/* --- What holds without a style sheet too --- */

static const char *const dashes[] = {"", " stroke-dasharray=\"6 3\"", " stroke-dasharray=\"2 2.5\"",
                                     " stroke-dasharray=\"9 3 2 3\""};

/* Of many curves: Okabe and Ito's colours, which also differ in lightness, and others between them; and markers around
   their point.  13 of these and 4 dashes: only the 53rd curve looks like the first in grey. */
static const char *const colours[] = {"#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9",
                                      "#e69f00", "#7f7f7f", "#6a3d9a", "#8c510a", "#b2182b", "#1b7837",
                                      "#e377c2", "#17becf", "#bcbd22", "#35478c", "#fb6a4a", "#66c2a4",
                                      "#a6761d", "#807dba", "#4d4d4d", "#c51b7d", "#b3b3b3", "#01665e"};
#define OPEN_AND_FILLED(path) "fill=\"none\" d=\"" path "\"", "fill=\"currentColor\" d=\"" path "\""
static const char *const markers[] = {"d=\"M-3.2 0h6.4M0-3.2v6.4\"",
                                      "d=\"M-2.6-2.6l5.2 5.2M2.6-2.6l-5.2 5.2\"",
                                      "d=\"M-3.2 0h6.4M0-3.2v6.4M-2.3-2.3l4.6 4.6M2.3-2.3l-4.6 4.6\"",
                                      OPEN_AND_FILLED("M-2.7-2.7h5.4v5.4h-5.4z"),
                                      OPEN_AND_FILLED("M-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0z"),
                                      OPEN_AND_FILLED("M0-3.5L3.3 2.3H-3.3z"),
                                      OPEN_AND_FILLED("M0 3.5L3.3-2.3H-3.3z"),
                                      OPEN_AND_FILLED("M0-3.8L3.2 0L0 3.8L-3.2 0z")};
enum {
  N_DASHES = sizeof dashes / sizeof *dashes,
  N_COLOURS = sizeof colours / sizeof *colours,
  N_MARKERS = sizeof markers / sizeof *markers
};

static bool is_marked(const char *class) {
  return *class == 'k';
}

/* Lines are lines and have their dashes; colours are the style sheet's, but for those of many, which have markers too,
   in a key only in the middle. */
static void begin_curve(struct plot *p, const char *class, bool in_key) {
  int k = *class == 'c' || is_marked(class) ? atoi(class + 1) : 0;
  text_printf(p->out, "<path class=\"curve %s\" " PLOT_STROKE "%s", class,
              strcmp(class, "aid") == 0 ? " stroke-dasharray=\"1 3\"" : dashes[k % N_DASHES]);
  if (!is_marked(class)) return;
  text_printf(p->out, " color=\"%s\" marker-mid=\"url(#%s-%s)\"", colours[k % N_COLOURS], p->id, class);
  if (!in_key)
    text_printf(p->out, " marker-start=\"url(#%s-%s)\" marker-end=\"url(#%s-%s)\"", p->id, class, p->id, class);
}

static void define_marker(struct plot *p, const char *class) {
  int k = atoi(class + 1);
  text_printf(p->out,
              "<marker id=\"%s-%s\" viewBox=\"-5 -5 10 10\" markerUnits=\"userSpaceOnUse\" markerWidth=\"10\" "
              "markerHeight=\"10\"><path color=\"%s\" stroke=\"currentColor\" %s /></marker>\n",
              p->id, class, colours[k % N_COLOURS], markers[k % N_MARKERS]);
}

/* A dot of another motion, or of an orbit that repels, is a ring. */
static const char *fill_of(const char *class) {
  return *class ? PLOT_STROKE : "fill=\"currentColor\" stroke=\"currentColor\"";
}

/* By the last two characters of the class. */
static const char *shade_of(const char *class) {
#define HUE(colour) "fill=\"" colour "\" shape-rendering=\"crispEdges\""
  static const char *const dark[] = {"fill=\"none\"",
                                     "fill=\"currentColor\" fill-opacity=\".15\"",
                                     "fill=\"currentColor\" fill-opacity=\".35\"",
                                     "fill=\"currentColor\" fill-opacity=\".6\"",
                                     "fill=\"currentColor\" fill-opacity=\".8\"",
                                     "fill=\"currentColor\""};
  static const char *const hue[] = {HUE("#fdf5c8"), HUE("#c6e39f"), HUE("#8fd175"), HUE("#5ab280"), HUE("#25938b"),
                                    HUE("#30728a"), HUE("#3a5088"), HUE("#32346a"), HUE("#260a3c"), HUE("#bbbbbb")};
  const char *end = class + strlen(class);
  size_t k = (size_t)(end[-1] - '0');
  return end[-2] == 'd' ? hue[k % (sizeof hue / sizeof *hue)] : dark[k % (sizeof dark / sizeof *dark)];
}

/* --- Text --- */

/* Where the sub- or superscript that begins at c ends; NULL where none does. */
static const char *script_end(const char *c) {
  if (*c != '_' && !(*c == '^' && c[1] == '{')) return NULL;
  return c[1] == '{' ? strchr(c, '}') : c[1] ? c + 1 : NULL;
}

void plot_text(struct plot *p, double x, double y, const char *anchor, const char *text) {
  text_printf(p->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor);
  bool leaning = false;
  const char *back = NULL; /* from where the line is to come back */
  for (const char *c = text; *c; c++) {
    if (*c == '*') {
      text_add(p->out, leaning ? "</tspan>" : "<tspan font-style=\"italic\"");
      if (!leaning) text_printf(p->out, "%s%s>", back ? " dy=" : "", back ? back : "");
      if (!leaning) back = NULL;
      leaning = !leaning;
    } else if (script_end(c)) {
      bool below = *c == '_', braced = c[1] == '{';
      const char *end = script_end(c);
      text_printf(p->out, "<tspan dy=\"%s\" font-size=\"9\">", below ? "3" : "-4");
      escape_html(p->out, c + 1 + braced, (size_t)(end - c - 2 * braced));
      text_add(p->out, "</tspan>");
      back = below ? "\"-3\"" : "\"4\"";
      c = end;
    } else {
      size_t n = strcspn(c, "*_^");
      if (n == 0) n = 1;
      if (back) text_printf(p->out, "<tspan dy=%s>", back);
      escape_html(p->out, c, n);
      if (back) text_add(p->out, "</tspan>");
      back = NULL;
      c += n - 1;
    }
  }
  text_add(p->out, leaning ? "</tspan></text>\n" : "</text>\n");
}

void parameter_label(char label[PLOT_LABEL], const char *name) {
  static const char *const greek[][2] = {{"chi", "*\xcf\x87*"}, {"eta", "*\xce\xb7*"}};
  size_t one = strcspn(name, "0123456789");
  snprintf(label, PLOT_LABEL, name[one] ? "*%.*s*_{%s}" : "*%.*s*%s", (int)(one < 20 ? one : 20), name, name + one);
  for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
    if (strcmp(name, greek[i][0]) == 0) snprintf(label, PLOT_LABEL, "%s", greek[i][1]);
}

/* --- Axes --- */

void plot_hold(double *low, double *high, double x) {
  if (isnan(x)) return;
  if (!(x >= *low)) *low = x;
  if (!(x <= *high)) *high = x;
}

void plot_forget(struct plot *p) {
  for (int axis = 0; axis < 2; axis++) p->low[axis] = p->high[axis] = (double)NAN;
}

void plot_hold_column(struct plot *p, int axis, const struct rows *t, size_t column) {
  for (size_t i = 0; i < t->n; i++) plot_hold(&p->low[axis], &p->high[axis], rows_number(t, i, column));
}

void plot_hold_columns(struct plot *p, const struct rows *t, size_t x, size_t y, size_t n) {
  plot_forget(p);
  plot_hold_column(p, 0, t, x);
  for (size_t k = 0; k < n; k++) plot_hold_column(p, 1, t, y + k);
}

void plot_widen(struct plot *p, int axis, double below, double above) {
  double range = p->high[axis] - p->low[axis];
  p->low[axis] -= below * range;
  p->high[axis] += above * range;
}

double plot_x(const struct plot *p, double x) {
  return p->left + (x - p->low[0]) / (p->high[0] - p->low[0]) * (p->right - p->left);
}

double plot_y(const struct plot *p, double y) {
  return p->top + p->height - (y - p->low[1]) / (p->high[1] - p->low[1]) * p->height;
}

/* The distance of ticks, 1, 2 or 5 times a power of ten, of which at most `most` fit; *places: decimals it needs. */
static double tick_step(double range, int most, bool whole, int *places) {
  static const double factor[] = {2, 2.5, 2};
  double step = 1;
  int k = 0;
  *places = 0;
  while (!whole && step * most > range) {
    step /= 10;
    ++*places;
  }
  while (step * most < range) step *= factor[k++ % 3];
  if (*places > 0 && k / 3 > 0) *places -= k / 3 < *places ? k / 3 : *places;
  return step;
}

static void add_tick(struct plot *p, int axis, double at, int places) {
  char label[64];
  double number = axis == 1 && p->exponents ? -pow(10, -at) : at;
  snprintf(label, sizeof label, p->power[axis] ? "10^{%s%.*f}" : "%s%.*f", number < 0 ? "\xe2\x88\x92" : "", places,
           fabs(number));
  double x = plot_x(p, at), y = plot_y(p, at);
  if (axis == 0)
    text_printf(p->out, "<path class=\"tick\" " PLOT_FAINT " d=\"M%.1f %.1fV%.1f\" />\n", x, p->top,
                p->top + p->height);
  else
    text_printf(p->out, "<path class=\"tick\" " PLOT_FAINT " d=\"M%g %.1fH%.1f\" />\n", p->left, y, p->right);
  if (axis == 0)
    plot_text(p, x, p->top + p->height + 15, "middle", label);
  else
    plot_text(p, p->left - 5, y + 4, "end", label);
}

static void add_ticks(struct plot *p, int axis) {
  int places;
  double range = p->high[axis] - p->low[axis];
  int most = axis == 0 ? (int)(p->right - p->left) / 50 : p->height > 150 ? 6 : 4;
  double step = tick_step(range, most, p->power[axis], &places);
  double first = ceil(p->low[axis] / step - 1e-9);
  for (int k = 0; k <= most && (first + k) * step <= p->high[axis] + 1e-9 * range; k++)
    add_tick(p, axis, (first + k) * step, places);
}

static void add_exponents(struct plot *p) {
  for (const double *n = p->exponents; *n > 0; n++) {
    double at = -log10(*n);
    if (at >= p->low[1] && at <= p->high[1]) add_tick(p, 1, at, 0);
  }
}

/* A range that ticks can be told apart on: around one number, or 0, where there is none. */
static void settle(struct plot *p, int axis) {
  double low = p->low[axis], high = p->high[axis];
  if (high - low > 1e-12 * (fabs(low) + fabs(high)) && high - low > 1e-100 && high - low < 1e100) return;
  double middle = fabs(low) < 1e100 ? low : 0;
  p->low[axis] = middle - 1 - fabs(middle);
  p->high[axis] = middle + 1 + fabs(middle);
}

void plot_panel(struct plot *p, double top, double height, const char *x_label, const char *y_label) {
  p->top = top;
  p->height = height;
  p->panels++;
  p->bottom = top + height + 36;
  for (int i = 0; i < 2; i++) settle(p, i);
  add_ticks(p, 0);
  if (p->exponents)
    add_exponents(p);
  else
    add_ticks(p, 1);
  double width = p->right - p->left;
  text_printf(p->out, "<rect class=\"frame\" " PLOT_STROKE " x=\"%g\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" />\n",
              p->left, top, width, height);
  plot_text(p, p->left + width / 2, top + height + 31, "middle", x_label);
  plot_text(p, p->left - PLOT_LEFT + 2, top - 7, "start", y_label);
  text_printf(p->out,
              "<clipPath id=\"%s-%d\"><rect x=\"%g\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" /></clipPath>\n"
              "<g clip-path=\"url(#%s-%d)\">\n",
              p->id, p->panels, p->left, top, width, height, p->id, p->panels);
}

void plot_free(struct plot *p) {
  text_add(p->out, "</g>\n");
}

/* --- What is drawn --- */

/* Far outside the frame a number says nothing, and could not be written. */
static double near_frame(double x) {
  return fmin(fmax(x, -2000), 3000);
}

void plot_point(struct plot *p, const char *class, double x, double y) {
  if (isnan(x) || isnan(y)) {
    plot_end(p);
    return;
  }
  if (!p->open) begin_curve(p, class, false);
  text_printf(p->out, "%s%.1f %.1f", p->open ? " " : " d=\"M", near_frame(plot_x(p, x)), near_frame(plot_y(p, y)));
  p->open = true;
}

void plot_end(struct plot *p) {
  if (p->open) text_add(p->out, "\" />\n");
  p->open = false;
}

void plot_column(struct plot *p, const struct rows *t, const char *class, size_t x, size_t y) {
  for (size_t i = 0; i < t->n; i++) plot_point(p, class, rows_number(t, i, x), rows_number(t, i, y));
  plot_end(p);
}

void plot_line(struct plot *p, const char *class, double x0, double y0, double x1, double y1) {
  plot_point(p, class, x0, y0);
  plot_point(p, class, x1, y1);
  plot_end(p);
}

void plot_dot_of(struct plot *p, const char *classes, double x, double y, double radius) {
  if (isnan(x) || isnan(y)) return;
  text_printf(p->out, "<circle class=\"%s\" %s cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" />\n", classes, fill_of(classes + 4),
              near_frame(plot_x(p, x)), near_frame(plot_y(p, y)), radius);
}

void plot_dot(struct plot *p, const char *class, double x, double y) {
  char classes[40];
  snprintf(classes, sizeof classes, "dot %s", class);
  plot_dot_of(p, classes, x, y, 3.5);
}

void plot_box(struct plot *p, const char *class, double x0, double y0, double x1, double y1) {
  if (!p->open) text_printf(p->out, "<path class=\"%s\" %s d=\"", class, shade_of(class));
  text_printf(p->out, "M%.1f %.1fH%.1fV%.1fH%.1fz", plot_x(p, x0), plot_y(p, y0), plot_x(p, x1), plot_y(p, y1),
              plot_x(p, x0));
  p->open = true;
}

/* What a label is about as wide as, in pixels. */
static double width_of(const char *text) {
  double n = 0;
  for (; *text; text++) n += !strchr("*_^{}", *text) && ((unsigned char)*text & 0xC0) != 0x80; /* characters */
  return 6.3 * n;
}

double plot_lines(struct plot *p, double x, double y, const char *words) {
  size_t most = (size_t)((p->width - x) / 6.3);
  for (; *words; y += 15) {
    size_t n = strlen(words);
    if (n > most)
      for (n = most; n > 1 && words[n] != ' ';) n--;
    char line[PLOT_WIDTH]; /* of fewer characters than pixels */
    snprintf(line, sizeof line, "%.*s", (int)n, words);
    plot_text(p, x, y, "start", line);
    words += n + (words[n] == ' ');
  }
  return y;
}

double plot_key(struct plot *p, const char *const (*entry)[2], int n) {
  double x = 4, y = 14;
  for (int i = 0; i < n; i++) {
    double width = 32 + width_of(entry[i][1]);
    if (i > 0 && x + width > p->width) {
      x = 4;
      y += 16;
    }
    bool dot = strncmp(entry[i][0], "dot", 3) == 0, shade = strncmp(entry[i][0], "shade", 5) == 0;
    bool marked = is_marked(entry[i][0]);
    if (shade)
      text_printf(p->out,
                  "<rect class=\"%s\" %s stroke=\"currentColor\" x=\"%.1f\" y=\"%.1f\" width=\"22\" height=\"10\" />\n",
                  entry[i][0], shade_of(entry[i][0]), x, y - 9);
    else if (dot)
      text_printf(p->out, "<circle class=\"%s\" %s cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" />\n", entry[i][0],
                  fill_of(entry[i][0] + 3), x + 11, y - 4);
    else {
      if (marked) define_marker(p, entry[i][0]);
      begin_curve(p, entry[i][0], true);
      text_printf(p->out, marked ? " d=\"M%.1f %.1fh11h11\" />\n" : " d=\"M%.1f %.1fh22\" />\n", x, y - 4);
    }
    plot_text(p, x + 26, y, "start", entry[i][1]);
    x += width + (marked ? 20 : 10);
  }
  return y + 8;
}

/* --- The document --- */

struct plot plot_begin(struct text *out, const char *id, double width) {
  return (struct plot){.out = out, .id = id, .width = width, .left = PLOT_LEFT, .right = width - PLOT_RIGHT};
}

/* What a custom property is set to first, which is its colour on white. */
static const char *light_colour(size_t *len, const char *name, size_t name_len) {
  const char *const sheet[] = {picture_alone_css, picture_css};
  for (int i = 0; i < 2; i++)
    for (const char *at = strstr(sheet[i], "--"); at; at = strstr(at + 1, "--"))
      if (strncmp(at, name, name_len) == 0 && at[name_len] == ':') {
        at += name_len + 2;
        *len = strcspn(at, ";");
        return at;
      }
  abort();
}

void plot_style(struct text *out, const char *css) {
  static const char use[] = "var(";
  for (const char *at; (at = strstr(css, use));) {
    const char *from = at, *name = at + strlen(use);
    size_t len, name_len = strcspn(name, ")");
    while (from > css && !strchr("{;", from[-1])) from--;
    from += strspn(from, " \n");
    const char *colour = light_colour(&len, name, name_len);
    text_add_n(out, css, (size_t)(at - css));
    text_add_n(out, colour, len);
    text_add(out, "; ");
    css = name + name_len + 1;
    text_add_n(out, from, (size_t)(css - from));
  }
  text_add(out, css);
}

void plot_svg(struct text *out, const struct plot *p, const char *title, const char *told, bool alone) {
  if (alone)
    text_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"");
  else
    text_printf(out, "<svg width=\"%g\" height=\"%.0f\"", p->width, p->bottom);
  text_printf(out, " font-size=\"12\" class=\"plot\" viewBox=\"0 0 %g %.0f\" role=\"img\" ", p->width, p->bottom);
  html_add(out, "aria-labelledby=\"t-%s d-%s\">\n<title id=\"t-%s\">%e</title>\n<desc id=\"d-%s\">%e</desc>\n", p->id,
           p->id, p->id, title, p->id, told);
  if (alone) {
    text_add(out, "<style>\n");
    text_add(out, picture_alone_css);
    plot_style(out, picture_css);
    text_printf(out, "</style>\n<rect width=\"%g\" height=\"%.0f\" style=\"", p->width, p->bottom);
    plot_style(out, "fill: var(--bg)");
    text_add(out, "\" />\n");
  }
  text_add(out, text_str(p->out));
  text_add(out, "</svg>\n");
}
