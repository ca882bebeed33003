/* Panels with axes, curves and labels as SVG.  Coordinates are sums, products and quotients of the tables' decimals
   alone, and so the same on every machine. */
#include "plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "escape.h"

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
  t->cell = ss_grow(t->cell, t->n, &t->cap, sizeof *t->cell);
  t->cell[t->n++] = cell;
}

bool rows_read(struct rows *t, const struct audit_result *r, const char *name) {
  const char *text = NULL;
  *t = (struct rows){.n = 0};
  for (size_t i = 0; i < r->n_tables; i++)
    if (strcmp(r->tables[i].name, name) == 0) {
      text = r->tables[i].text;
      t->orbit = r->tables[i].orbit;
    }
  arena_init(&t->arena);
  if (!text) return false;
  for (size_t len; *text; text += len + (text[len] == '\n')) {
    len = strcspn(text, "\n");
    bool heading = t->columns == 0;
    if (*text != '#') read_row(t, text, len);
    if (!heading || !t->columns) continue;
    t->heading = t->cell[0];
    t->n = 0;
  }
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

bool rows_is(const struct rows *t, size_t row, size_t column, const char *text) {
  return column < t->columns && strcmp(t->cell[row][column], text) == 0;
}

size_t rows_end(const struct rows *t, size_t row, size_t column) {
  while (row + 1 < t->n && rows_is(t, row + 1, column, t->cell[row][column])) row++;
  return row;
}

/* --- What holds without a style sheet too --- */

/* Lines are lines and have their dashes; colours are the style sheet's. */
static const char *stroke_of(const char *class) {
  static const char *const dashed[][2] = {{"c1", PLOT_STROKE " stroke-dasharray=\"6 3\""},
                                          {"c2", PLOT_STROKE " stroke-dasharray=\"2 2.5\""},
                                          {"c3", PLOT_STROKE " stroke-dasharray=\"9 3 2 3\""},
                                          {"aid", PLOT_STROKE " stroke-dasharray=\"1 3\""}};
  for (size_t i = 0; i < sizeof dashed / sizeof *dashed; i++)
    if (strcmp(class, dashed[i][0]) == 0) return dashed[i][1];
  return PLOT_STROKE;
}

/* A dot of another motion, or of an orbit that repels, is a ring. */
static const char *fill_of(const char *class) {
  return *class ? PLOT_STROKE : "fill=\"currentColor\" stroke=\"currentColor\"";
}

const char *plot_shade(const char *class) {
  static const char *const fill[] = {"fill=\"none\"",
                                     "fill=\"currentColor\" fill-opacity=\".15\"",
                                     "fill=\"currentColor\" fill-opacity=\".35\"",
                                     "fill=\"currentColor\" fill-opacity=\".6\"",
                                     "fill=\"currentColor\" fill-opacity=\".8\"",
                                     "fill=\"currentColor\""};
  return fill[(size_t)(class[strlen(class) - 1] - '0') % (sizeof fill / sizeof *fill)];
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
  return PLOT_LEFT + (x - p->low[0]) / (p->high[0] - p->low[0]) * (PLOT_WIDTH - PLOT_LEFT - PLOT_RIGHT);
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
  snprintf(label, sizeof label, p->power[axis] ? "10^{%.*f}" : "%.*f", places, at == 0 ? 0 : at);
  if (strncmp(label, "10^{-", 5) == 0) snprintf(label, sizeof label, "10^{\xe2\x88\x92%.*f}", places, -at);
  if (label[0] == '-') snprintf(label, sizeof label, "\xe2\x88\x92%.*f", places, -at);
  double x = plot_x(p, at), y = plot_y(p, at), right = PLOT_WIDTH - PLOT_RIGHT;
  if (axis == 0)
    text_printf(p->out, "<path class=\"tick\" " PLOT_FAINT " d=\"M%.1f %.1fV%.1f\" />\n", x, p->top,
                p->top + p->height);
  else
    text_printf(p->out, "<path class=\"tick\" " PLOT_FAINT " d=\"M%d %.1fH%.1f\" />\n", PLOT_LEFT, y, right);
  if (axis == 0)
    plot_text(p, x, p->top + p->height + 15, "middle", label);
  else
    plot_text(p, PLOT_LEFT - 5, y + 4, "end", label);
}

static void add_ticks(struct plot *p, int axis) {
  int places;
  double range = p->high[axis] - p->low[axis];
  int most = axis == 0 ? 6 : p->height > 150 ? 6 : 4;
  double step = tick_step(range, most, p->power[axis], &places);
  double first = ceil(p->low[axis] / step - 1e-9);
  for (int k = 0; k <= most && (first + k) * step <= p->high[axis] + 1e-9 * range; k++)
    add_tick(p, axis, (first + k) * step, places);
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
  add_ticks(p, 1);
  double width = PLOT_WIDTH - PLOT_LEFT - PLOT_RIGHT;
  text_printf(p->out, "<rect class=\"frame\" " PLOT_STROKE " x=\"%d\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" />\n",
              PLOT_LEFT, top, width, height);
  plot_text(p, PLOT_LEFT + width / 2, top + height + 31, "middle", x_label);
  plot_text(p, 2, top - 7, "start", y_label);
  text_printf(p->out,
              "<clipPath id=\"%s-%d\"><rect x=\"%d\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" /></clipPath>\n"
              "<g clip-path=\"url(#%s-%d)\">\n",
              p->id, p->panels, PLOT_LEFT, top, width, height, p->id, p->panels);
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
  if (!p->open) text_printf(p->out, "<path class=\"curve %s\" %s d=\"M", class, stroke_of(class));
  text_printf(p->out, "%s%.1f %.1f", p->open ? " " : "", near_frame(plot_x(p, x)), near_frame(plot_y(p, y)));
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

/* What a label is about as wide as, in pixels. */
static double width_of(const char *text) {
  double n = 0;
  for (; *text; text++) n += !strchr("*_^{}", *text) && ((unsigned char)*text & 0xC0) != 0x80; /* characters */
  return 6.3 * n;
}

double plot_lines(struct plot *p, double x, double y, const char *words) {
  size_t most = (size_t)((PLOT_WIDTH - x) / 6.3);
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
    if (i > 0 && x + width > PLOT_WIDTH) {
      x = 4;
      y += 16;
    }
    bool dot = strncmp(entry[i][0], "dot", 3) == 0, shade = strncmp(entry[i][0], "shade", 5) == 0;
    if (shade)
      text_printf(p->out,
                  "<rect class=\"%s\" %s stroke=\"currentColor\" x=\"%.1f\" y=\"%.1f\" width=\"22\" height=\"10\" />\n",
                  entry[i][0], plot_shade(entry[i][0]), x, y - 9);
    else if (dot)
      text_printf(p->out, "<circle class=\"%s\" %s cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" />\n", entry[i][0],
                  fill_of(entry[i][0] + 3), x + 11, y - 4);
    else
      text_printf(p->out, "<path class=\"curve %s\" %s d=\"M%.1f %.1fh22\" />\n", entry[i][0], stroke_of(entry[i][0]),
                  x, y - 4);
    plot_text(p, x + 26, y, "start", entry[i][1]);
    x += width + 10;
  }
  return y + 8;
}
