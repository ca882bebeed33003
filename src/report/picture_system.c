/* The orbits of a system file in the phase plane of each mass. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

enum { WHAT, PHASE, MARK, TIME, FIRST }; /* x_1, x'_1, x_2, x'_2, ... follow */
enum { PANEL = 240, NAMED = 12 };        /* orbits in the key */

static size_t masses(const struct rows *t) {
  return t->columns > FIRST ? (t->columns - FIRST) / 2 : 0;
}

/* The number of the orbit that a row is of; 0 for none. */
static int orbit_of(const struct rows *t, size_t row) {
  const char *what = t->cell[row][WHAT];
  return strncmp(what, "orbit ", 6) == 0 ? atoi(what + 6) : 0;
}

static int orbits(const struct rows *t) {
  int n = 0;
  for (size_t i = 0; i < t->n; i++) n = orbit_of(t, i) > n ? orbit_of(t, i) : n;
  return n;
}

/* Does an orbit begin in the row? */
static bool begins(const struct rows *t, size_t row) {
  return orbit_of(t, row) && (row == 0 || orbit_of(t, row - 1) != orbit_of(t, row));
}

static void tell_planes(struct text *out, const struct rows *t) {
  for (size_t i = 0; i < t->n; i++) {
    if (!rows_is(t, i, MARK, "o")) continue;
    if (begins(t, i)) text_printf(out, "%sO%s: ", i ? " " : "", t->cell[i][WHAT] + 1);
    text_printf(out, "phase %s from t = %.3f (", t->cell[i][PHASE], rows_number(t, i, TIME));
    for (size_t c = FIRST; c < t->columns; c++)
      text_printf(out, "%sx%zu%s = %.3f", c > FIRST ? ", " : "", (c - FIRST) / 2 + 1, (c - FIRST) % 2 ? "'" : "",
                  rows_number(t, i, c));
    text_add(out, "). ");
  }
}

/* Surfaces and obstacles, where there are any. */
static void add_limits(struct plot *p, const struct rows *t, size_t x) {
  for (size_t i = 0; i < t->n; i++) {
    double at[2] = {rows_number(t, i, x), rows_number(t, i, x + 1)};
    if (orbit_of(t, i)) continue;
    if (!isnan(at[0])) plot_line(p, "gap", at[0], p->low[1], at[0], p->high[1]);
    if (!isnan(at[1])) plot_line(p, "aid", p->low[0], at[1], p->high[0], at[1]);
  }
}

static void draw_plane(struct plot *p, const struct rows *t, size_t mass, double top) {
  size_t x = FIRST + 2 * mass;
  char labels[2][40];
  snprintf(labels[0], sizeof labels[0], "*x*_{%zu}", mass + 1);
  snprintf(labels[1], sizeof labels[1], "*x*\xe2\x80\xb2_{%zu}", mass + 1);
  plot_hold_columns(p, t, x, x + 1, 1);
  for (int axis = 0; axis < 2; axis++) plot_widen(p, axis, 0.09, 0.09);
  plot_panel(p, top, PANEL - 60, labels[0], labels[1]);
  add_limits(p, t, x);
  for (int k = 1; k <= orbits(t); k++) {
    for (size_t i = 0; i < t->n; i++)
      if (orbit_of(t, i) == k)
        plot_point(p, plot_class[(k - 1) % PLOT_CLASSES], rows_number(t, i, x), rows_number(t, i, x + 1));
    plot_end(p);
  }
  for (size_t i = 0; i < t->n; i++)
    if (rows_is(t, i, MARK, "o")) plot_dot(p, "", rows_number(t, i, x), rows_number(t, i, x + 1));
  plot_free(p);
}

static void draw_planes(struct plot *p, const struct rows *t) {
  const char *key[2 + NAMED][2] = {{"aid", "surface"}, {"gap", "obstacle"}};
  int n = 0;
  for (size_t i = 0; i < t->n && n < NAMED; i++) {
    if (!begins(t, i)) continue;
    key[2 + n][0] = plot_class[n % PLOT_CLASSES];
    key[2 + n++][1] = t->cell[i][WHAT];
  }
  double top = p->bottom = plot_key(p, key, 2 + n);
  for (size_t mass = 0; mass < masses(t); mass++) draw_plane(p, t, mass, top + 18 + (double)mass * PANEL);
}

const struct picture picture_planes = {"phase-planes", "phase-planes.tsv", "Phase planes of a system's orbits",
                                       NULL,           tell_planes,        draw_planes};
