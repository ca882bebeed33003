/* Figures 3 and 4 of the paper: the orbit, and the motion from the printed start with the gap that it leaves. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture.h"

/* A gap below this does not show. */
#define CLOSED 0.001

enum { MOTION, PHASE, MARK, FIRST }; /* columns; t, z_1, z_2 or z_1, z'_1, z_2, z'_2 follow */

static bool has_printed(const struct rows *t) {
  for (size_t i = 0; i < t->n; i++)
    if (rows_is(t, i, MOTION, "printed")) return true;
  return false;
}

/* The row of a motion with that mark; n when there is none. */
static size_t marked(const struct rows *t, const char *motion, const char *mark) {
  size_t i = 0;
  while (i < t->n && !(rows_is(t, i, MOTION, motion) && rows_is(t, i, MARK, mark))) i++;
  return i;
}

static double value_at(const struct rows *t, const char *motion, const char *mark, size_t column) {
  size_t row = marked(t, motion, mark);
  return row < t->n ? rows_number(t, row, column) : (double)NAN;
}

/* By how much a column has changed from the start O of the printed motion to its end d. */
static double gap(const struct rows *t, size_t column) {
  return value_at(t, "printed", "d", column) - value_at(t, "printed", "O", column);
}

static void add_curve(struct plot *p, const struct rows *t, const char *motion, const char *class, size_t x, size_t y) {
  for (size_t i = 0; i < t->n; i++)
    if (rows_is(t, i, MOTION, motion)) plot_point(p, class, rows_number(t, i, x), rows_number(t, i, y));
  plot_end(p);
}

static void add_dots(struct plot *p, const struct rows *t, const char *motion, const char *class, size_t x, size_t y) {
  for (size_t i = 0; i < t->n; i++)
    if (rows_is(t, i, MOTION, motion) && !rows_is(t, i, MARK, "-"))
      plot_dot(p, class, rows_number(t, i, x), rows_number(t, i, y));
}

/* The names of the orbit's marks, O_1 a_1 b_1 c_1 d_1 for the first mass; those at one place share a label, which
   stands below or above the curve. */
static void add_names(struct plot *p, const struct rows *t, int mass, size_t x, size_t y, const char *below) {
  static const char *const marks[] = {"O", "a", "b", "c", "d"};
  enum { N = sizeof marks / sizeof *marks };
  bool done[N] = {false};
  for (int i = 0; i < N; i++) {
    double at[2] = {value_at(t, "orbit", marks[i], x), value_at(t, "orbit", marks[i], y)};
    if (done[i] || isnan(at[0]) || isnan(at[1])) continue;
    char label[80];
    int len = snprintf(label, sizeof label, "%s_%d", marks[i], mass);
    for (int k = i + 1; k < N; k++) {
      double to[2] = {value_at(t, "orbit", marks[k], x), value_at(t, "orbit", marks[k], y)};
      if (fabs(plot_x(p, to[0]) - plot_x(p, at[0])) + fabs(plot_y(p, to[1]) - plot_y(p, at[1])) > 4) continue;
      done[k] = true;
      len += snprintf(label + len, sizeof label - (size_t)len, ", %s_%d", marks[k], mass);
    }
    bool under = strchr(below, marks[i][0]) != NULL;
    plot_text(p, plot_x(p, at[0]), plot_y(p, at[1]) + (under ? 18 : -8), "middle", label);
  }
}

static double add_key(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "periodic orbit"}, {"c1", "from the printed start"}};
  return plot_key(p, key, has_printed(t) ? 2 : 1);
}

/* --- Figure 3: time history --- */

static void say_history(struct text *out, const struct rows *t) {
  bool back = false;
  text_add(out, "The positions $z_1$ and $z_2$ over one period, with the figure's names for the switchings.");
  for (size_t i = 0; i < t->n; i++) back |= rows_is(t, i, MOTION, "orbit") && rows_number(t, i, FIRST) < 0;
  if (back) text_add(out, " The first phase has a negative length: no masses move so.");
  if (!has_printed(t)) return;
  double off[2] = {fabs(gap(t, FIRST + 1)), fabs(gap(t, FIRST + 2))};
  bool closed = off[0] + off[1] < CLOSED;
  text_printf(out, " From the printed start the masses %s: at $d_1$ and $d_2$ they are %.3f and %.3f off.%s",
              closed ? "come back" : "do not come back", off[0], off[1],
              closed ? "" : " The bars at the right show it to scale.");
}

static void tell_motion(struct text *out, const struct rows *t, const char *motion, const char *const *names,
                        size_t columns) {
  static const char *const marks[] = {"O", "a", "b", "c", "d"};
  for (int k = 0; k < 5; k++) {
    size_t row = marked(t, motion, marks[k]);
    if (row == t->n) continue;
    text_printf(out, "%s%s (", k ? ", " : "", marks[k]);
    for (size_t c = 0; c < columns; c++)
      text_printf(out, "%s%s = %.3f", c ? ", " : "", names[c], rows_number(t, row, FIRST + c));
    text_add(out, ")");
  }
}

static void tell_both(struct text *out, const struct rows *t, const char *const *names, size_t columns) {
  text_add(out, "The periodic orbit passes ");
  tell_motion(out, t, "orbit", names, columns);
  if (has_printed(t)) {
    text_add(out, ". From the printed start the motion passes ");
    tell_motion(out, t, "printed", names, columns);
  }
  text_add(out, ".");
}

static void tell_history(struct text *out, const struct rows *t) {
  static const char *const names[] = {"t", "z1", "z2"};
  tell_both(out, t, names, 3);
}

/* The gap as a bar right of the end, with its size. */
static void add_gap_beside(struct plot *p, const struct rows *t, size_t mass) {
  double end = value_at(t, "printed", "d", FIRST), from = value_at(t, "printed", "O", FIRST + mass);
  double to = value_at(t, "printed", "d", FIRST + mass);
  if (isnan(end) || isnan(from) || isnan(to)) return;
  double x = plot_x(p, end) + 7, y[2] = {plot_y(p, from), plot_y(p, to)};
  text_printf(p->out, "<path class=\"gap\" " PLOT_STROKE " d=\"M%.1f %.1fV%.1f\" />\n", x, y[0], y[1]);
  char label[40];
  snprintf(label, sizeof label, "%.3f", fabs(to - from));
  plot_text(p, x + 5, (y[0] + y[1]) / 2 + 4, "start", label);
}

static void draw_history(struct plot *p, const struct rows *t) {
  double top = add_key(p, t);
  plot_hold_columns(p, t, FIRST, FIRST + 1, 2);
  plot_widen(p, 0, 0.06, has_printed(t) ? 0.2 : 0.09);
  plot_widen(p, 1, 0.08, 0.08);
  plot_panel(p, top + 18, 250, "time *t*", "*z*_1 and *z*_2");
  for (size_t mass = 1; mass <= 2; mass++) {
    add_curve(p, t, "orbit", "c0", FIRST, FIRST + mass);
    add_curve(p, t, "printed", "c1", FIRST, FIRST + mass);
    double end = value_at(t, "printed", "d", FIRST), from = value_at(t, "printed", "O", FIRST + mass);
    plot_line(p, "aid", value_at(t, "printed", "O", FIRST), from, end, from);
    add_gap_beside(p, t, mass);
    add_dots(p, t, "printed", "c1", FIRST, FIRST + mass);
    add_dots(p, t, "orbit", "", FIRST, FIRST + mass);
  }
  plot_free(p);
  add_names(p, t, 1, FIRST, FIRST + 1, "bc");
  add_names(p, t, 2, FIRST, FIRST + 2, "Oacd");
}

const struct picture picture_history = {"figure-3",  "figure-3.tsv", "Time history of the masses (figure 3)",
                                        say_history, tell_history,   draw_history};

/* --- Figure 4: phase plots --- */

static void say_portrait(struct text *out, const struct rows *t) {
  text_add(out,
           "Velocity against position for each mass. On the upper edge a mass has the belt's velocity $V$: it sticks "
           "there, and below it slips.");
  if (!has_printed(t)) return;
  text_printf(out,
              " A periodic motion closes its loop, and the orbit does. From the printed start the loops are open by "
              "%.3f in $z_1$ and %.3f in $z_2$: the bars above, to scale, from $O_i$ to $d_i$.",
              fabs(gap(t, FIRST)), fabs(gap(t, FIRST + 2)));
}

static void tell_portrait(struct text *out, const struct rows *t) {
  static const char *const names[] = {"z1", "z1'", "z2", "z2'"};
  tell_both(out, t, names, 4);
}

/* From O to d of the printed motion, above the curve. */
static void add_gap(struct plot *p, const struct rows *t, size_t x, size_t y) {
  double from = value_at(t, "printed", "O", x), to = value_at(t, "printed", "d", x);
  if (isnan(from) || isnan(to)) return;
  double level = plot_y(p, value_at(t, "printed", "O", y)) - 11;
  text_printf(p->out, "<path class=\"gap\" " PLOT_STROKE " d=\"M%.1f %.1fv8m0 -4H%.1fm0 -4v8\" />\n", plot_x(p, from),
              level - 4, plot_x(p, to));
  char label[40];
  snprintf(label, sizeof label, "gap %.3f", fabs(to - from));
  plot_text(p, plot_x(p, (from + to) / 2), level - 8, "middle", label);
}

static void draw_portrait(struct plot *p, const struct rows *t) {
  static const char *const labels[2][2] = {{"*z*_1", "*z*\xe2\x80\xb2_1"}, {"*z*_2", "*z*\xe2\x80\xb2_2"}};
  double top = add_key(p, t);
  for (int mass = 0; mass < 2; mass++, top += 240) {
    size_t x = FIRST + 2 * (size_t)mass, y = x + 1;
    plot_hold_columns(p, t, x, y, 1);
    plot_widen(p, 0, 0.09, 0.09);
    plot_widen(p, 1, 0.15, 0.22);
    plot_panel(p, top + 18, 180, labels[mass][0], labels[mass][1]);
    add_curve(p, t, "orbit", "c0", x, y);
    add_curve(p, t, "printed", "c1", x, y);
    add_dots(p, t, "printed", "c1", x, y);
    add_dots(p, t, "orbit", "", x, y);
    add_gap(p, t, x, y);
    add_names(p, t, mass + 1, x, y, "Oabcd");
    plot_free(p);
  }
}

const struct picture picture_portrait = {"figure-4",   "figure-4.tsv", "Phase plots of the system (figure 4)",
                                         say_portrait, tell_portrait,  draw_portrait};
