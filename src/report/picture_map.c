/* A plane of two parameters: which orbits there are at each point, and proved points of the boundaries. */
#include <math.h>
#include <string.h>

#include "picture.h"
#include "sections.h"

enum { WHAT, X, X_TO, Y, Y_TO, ORBITS, ADMISSIBLE, STABLE, STATUS };

/* What a cell shows. */
enum shade { SHADE_NONE, SHADE_FORMAL, SHADE_UNSTABLE, SHADE_STABLE, SHADE_BESIDE, SHADE_OPEN, N_SHADES };
static const char *const key[N_SHADES + 3][2] = {{"shade s0", "no orbit"},
                                                 {"shade s1", "none admissible"},
                                                 {"shade s2", "admissible, unstable"},
                                                 {"shade s3", "admissible, stable"},
                                                 {"shade s4", "stable, and another"},
                                                 {"shade s5", "open"},
                                                 {"dot m0", "flip"},
                                                 {"dot m1", "fold"},
                                                 {"dot m2", "condition"}};

static bool is_cell(const struct rows *t, size_t i) {
  return rows_is(t, i, WHAT, "cell");
}

static enum shade shade_of(const struct rows *t, size_t i) {
  if (!rows_is(t, i, STATUS, "ok")) return SHADE_OPEN;
  if (rows_is(t, i, ORBITS, "0")) return SHADE_NONE;
  if (rows_is(t, i, ADMISSIBLE, "0")) return SHADE_FORMAL;
  if (rows_is(t, i, STABLE, "0")) return SHADE_UNSTABLE;
  return rows_is(t, i, ADMISSIBLE, "1") ? SHADE_STABLE : SHADE_BESIDE;
}

static void tell_map(struct text *out, const struct rows *t) {
  size_t n[N_SHADES] = {0}, marks = 0, cells = 0;
  if (t->columns <= STATUS) return;
  for (size_t i = 0; i < t->n; i++)
    if (is_cell(t, i)) {
      n[shade_of(t, i)]++;
      cells++;
    } else {
      marks++;
    }
  text_printf(out, "The plane of %s from %s to %s and %s from %s to %s. Parts of it, of 1.00:", t->heading[X],
              t->cell[0][X], t->cell[cells ? cells - 1 : 0][X], t->heading[Y], t->cell[0][Y],
              t->cell[cells ? cells - 1 : 0][Y]);
  for (int k = 0; k < N_SHADES; k++)
    if (n[k]) text_printf(out, " %s %.2f,", key[k][1], (double)n[k] / (double)cells);
  text_printf(out, " with %zu proved points of their boundaries.", marks);
}

/* The cells of one shade, those that follow one another in a column as one rectangle. */
static void add_shade(struct plot *p, const struct rows *t, enum shade shade, const double half[2]) {
  bool any = false;
  for (size_t i = 0; i < t->n; i++) {
    if (!is_cell(t, i) || shade_of(t, i) != shade) continue;
    size_t k = i;
    while (k + 1 < t->n && is_cell(t, k + 1) && shade_of(t, k + 1) == shade && rows_is(t, k + 1, X, t->cell[i][X])) k++;
    double x[2] = {rows_number(t, i, X) - half[0], rows_number(t, i, X) + half[0]};
    double y[2] = {rows_number(t, i, Y) - half[1], rows_number(t, k, Y) + half[1]};
    if (!any) text_printf(p->out, "<path class=\"%s\" %s d=\"", key[shade][0], plot_shade(key[shade][0]));
    text_printf(p->out, "M%.1f %.1fH%.1fV%.1fH%.1fz", plot_x(p, x[0]), plot_y(p, y[0]), plot_x(p, x[1]),
                plot_y(p, y[1]), plot_x(p, x[0]));
    any = true;
    i = k;
  }
  if (any) text_add(p->out, "\" />\n");
}

static double middle(const struct rows *t, size_t i, size_t column) {
  double x = rows_number(t, i, column), to = rows_number(t, i, column + 1);
  return isnan(to) ? x : (x + to) / 2;
}

static int mark_of(const struct rows *t, size_t i) {
  return N_SHADES + (rows_is(t, i, WHAT, "flip") ? 0 : rows_is(t, i, WHAT, "fold") ? 1 : 2);
}

static void add_mark(struct plot *p, const struct rows *t, size_t i) {
  plot_dot_of(p, key[mark_of(t, i)][0], middle(t, i, X), middle(t, i, Y), 1.6);
}

/* Half the distance of two values. */
static double half_step(const struct rows *t, size_t column) {
  double first = rows_number(t, 0, column);
  for (size_t i = 1; i < t->n && is_cell(t, i); i++)
    if (rows_number(t, i, column) != first) return (rows_number(t, i, column) - first) / 2;
  return 0;
}

/* What there is of the key. */
static double add_key(struct plot *p, const struct rows *t) {
  const char *there[N_SHADES + 3][2];
  bool any[N_SHADES + 3] = {false};
  int n = 0;
  for (size_t i = 0; i < t->n; i++) any[is_cell(t, i) ? (int)shade_of(t, i) : mark_of(t, i)] = true;
  for (int k = 0; k < N_SHADES + 3; k++)
    if (any[k]) memcpy(there[n++], key[k], sizeof *there);
  return plot_key(p, (const char *const(*)[2])there, n);
}

static void draw_map(struct plot *p, const struct rows *t) {
  char label[2][PLOT_LABEL];
  p->bottom = 14;
  if (t->columns <= STATUS) return;
  p->bottom = add_key(p, t);
  text_printf(p->out, "<style>\n%s</style>\n", picture_map_css);
  const double half[2] = {half_step(t, X), half_step(t, Y)};
  plot_forget(p);
  for (int k = 0; k < 2; k++) {
    parameter_label(label[k], t->heading[k ? Y : X]);
    for (size_t i = 0; i < t->n; i++)
      if (is_cell(t, i)) plot_hold(&p->low[k], &p->high[k], rows_number(t, i, k ? Y : X));
  }
  plot_panel(p, p->bottom + 22, 290, label[0], label[1]);
  for (int shade = SHADE_FORMAL; shade < N_SHADES; shade++) add_shade(p, t, (enum shade)shade, half);
  for (size_t i = 0; i < t->n; i++)
    if (!is_cell(t, i)) add_mark(p, t, i);
  plot_free(p);
  p->bottom = plot_lines(p, 4, p->bottom + 14,
                         "Dots: boundaries of admissible orbits, proved. flip: tr J = -1; fold: two orbits merge; "
                         "condition: one of an admissible orbit ceases to hold, or its branch ends. Everything is "
                         "dimensionless.");
}

const struct picture picture_map = {
    "stability-map", "stability-map.tsv", "Which orbits there are over two parameters", NULL, tell_map, draw_map};
