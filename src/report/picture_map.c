/* A plane of two parameters: which orbits there are at each point, and proved points of the boundaries. */
#include <math.h>
#include <string.h>

#include "page.h"
#include "picture.h"

enum { WHAT, X, X_TO, Y, Y_TO, ORBITS, ADMISSIBLE, STABLE, STATUS };

/* What a row shows: a cell's shade, or a change. */
enum kind { NONE, FORMAL, UNSTABLE, STABLE_ONE, BESIDE, OPEN, N_SHADES, FLIP = N_SHADES, FOLD, CONDITION, N_KINDS };
static const char *const key[N_KINDS][2] = {{"shade s0", "no orbit"},
                                            {"shade s1", "none admissible"},
                                            {"shade s2", "admissible, unstable"},
                                            {"shade s3", "admissible, stable"},
                                            {"shade s4", "stable, and another"},
                                            {"shade s5", "open"},
                                            {"dot m0", "flip"},
                                            {"dot m1", "fold"},
                                            {"dot m2", "condition"}};

static enum kind kind_of(const struct rows *t, size_t i) {
  if (rows_is(t, i, WHAT, "flip")) return FLIP;
  if (rows_is(t, i, WHAT, "fold")) return FOLD;
  if (!rows_is(t, i, WHAT, "cell")) return CONDITION;
  if (!rows_is(t, i, STATUS, "ok")) return OPEN;
  if (rows_is(t, i, ORBITS, "0")) return NONE;
  if (rows_is(t, i, ADMISSIBLE, "0")) return FORMAL;
  if (rows_is(t, i, STABLE, "0")) return UNSTABLE;
  return rows_is(t, i, ADMISSIBLE, "1") ? STABLE_ONE : BESIDE;
}

/* How many rows there are of each kind; the number of cells, which stand first. */
static size_t count_kinds(size_t n[N_KINDS], const struct rows *t) {
  size_t cells = 0;
  memset(n, 0, N_KINDS * sizeof *n);
  for (size_t i = 0; i < t->n; i++) n[kind_of(t, i)]++;
  for (int k = 0; k < N_SHADES; k++) cells += n[k];
  return cells;
}

static void tell_map(struct text *out, const struct rows *t) {
  size_t n[N_KINDS];
  if (t->columns <= STATUS) return;
  size_t cells = count_kinds(n, t), last = cells ? cells - 1 : 0;
  text_printf(out, "The plane of %s from %s to %s and %s from %s to %s. Parts of it, of 1.00:", t->heading[X],
              t->cell[0][X], t->cell[last][X], t->heading[Y], t->cell[0][Y], t->cell[last][Y]);
  for (int k = 0; k < N_SHADES; k++)
    if (n[k]) text_printf(out, " %s %.2f,", key[k][1], (double)n[k] / (double)cells);
  text_printf(out, " with %zu proved points of their boundaries.", t->n - cells);
}

/* The cells of one shade, those that follow one another in a column as one rectangle. */
static void add_shade(struct plot *p, const struct rows *t, enum kind shade, const double half[2]) {
  for (size_t i = 0; i < t->n; i++) {
    if (kind_of(t, i) != shade) continue;
    double x = rows_number(t, i, X), low = rows_number(t, i, Y);
    while (i + 1 < t->n && kind_of(t, i + 1) == shade && rows_is(t, i + 1, X, t->cell[i][X])) i++;
    plot_box(p, key[shade][0], x - half[0], low - half[1], x + half[0], rows_number(t, i, Y) + half[1]);
  }
  plot_end(p);
}

static double middle(const struct rows *t, size_t i, size_t column) {
  double x = rows_number(t, i, column), to = rows_number(t, i, column + 1);
  return isnan(to) ? x : (x + to) / 2;
}

/* Half the distance of two values, the cells being the first rows. */
static double half_step(const struct rows *t, size_t cells, size_t column) {
  size_t i = 0;
  while (i < cells && rows_is(t, i, column, t->cell[0][column])) i++;
  return i < cells ? (rows_number(t, i, column) - rows_number(t, 0, column)) / 2 : 0;
}

static void draw_map(struct plot *p, const struct rows *t) {
  char label[2][PLOT_LABEL];
  const char *there[N_KINDS][2]; /* what there is of the key */
  size_t n[N_KINDS], cells = count_kinds(n, t);
  int entries = 0;
  p->bottom = 14;
  if (t->columns <= STATUS) return;
  for (int k = 0; k < N_KINDS; k++)
    if (n[k]) memcpy(there[entries++], key[k], sizeof *there);
  p->bottom = plot_key(p, (const char *const(*)[2])there, entries);
  text_add(p->out, "<style>\n");
  plot_style(p->out, picture_map_css);
  text_add(p->out, "</style>\n");
  const double half[2] = {half_step(t, cells, X), half_step(t, cells, Y)};
  plot_forget(p);
  for (int k = 0; k < 2; k++) {
    parameter_label(label[k], t->heading[k ? Y : X]);
    for (size_t i = 0; i < cells; i++) plot_hold(&p->low[k], &p->high[k], rows_number(t, i, k ? Y : X));
  }
  plot_panel(p, p->bottom + 22, 290, label[0], label[1]);
  for (int k = FORMAL; k < N_SHADES; k++)
    if (n[k]) add_shade(p, t, (enum kind)k, half);
  for (size_t i = cells; i < t->n; i++) plot_dot_of(p, key[kind_of(t, i)][0], middle(t, i, X), middle(t, i, Y), 1.6);
  plot_free(p);
  p->bottom = plot_lines(p, 4, p->bottom + 14,
                         "Dots: boundaries of admissible orbits, proved. flip: tr J = -1; fold: two orbits merge; "
                         "condition: one of an admissible orbit ceases to hold, or its branch ends. " TABLE_UNITS);
}

const struct picture picture_map = {
    "stability-map", "stability-map.tsv", "Which orbits there are over two parameters", NULL, tell_map, draw_map};
