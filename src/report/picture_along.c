/* Orbits along a parameter: their multipliers and periods, and where they are stable and admissible.  In the letter it
   is one orbit along e2; with branches, every one that is found, with the changes listed below. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture.h"

enum { CHANGE, E2, E2_TO, TRACE, PERIOD, STABLE, ADMISSIBLE, BRANCH };
/* Beyond these tr J is cut off where there are branches. */
#define MOST_TRACE 2

static bool is_change(const struct rows *t, size_t i) {
  return !rows_is(t, i, CHANGE, "-");
}

static bool has_branches(const struct rows *t) {
  return t->columns > BRANCH;
}

static bool same_branch(const struct rows *t, size_t i, size_t k) {
  return !has_branches(t) || rows_is(t, i, BRANCH, t->cell[k][BRANCH]);
}

/* Stable and admissible there, or just above the change. */
static bool is_good(const struct rows *t, size_t i) {
  return i < t->n && rows_is(t, i, STABLE, "yes") && rows_is(t, i, ADMISSIBLE, "yes");
}

/* The end of the good rows that begin at row i, and the least |tr J| that was met. */
static size_t end_of_good(const struct rows *t, size_t i, double *least) {
  double most = 0;
  *least = (double)NAN;
  for (; is_good(t, i); i++) plot_hold(least, &most, fabs(rows_number(t, i, TRACE)));
  return i;
}

static void add_edge(struct text *out, const struct rows *t, size_t i, const char *where) {
  if (i < t->n && is_change(t, i)) text_printf(out, "; at the %s end %s", where, t->cell[i][CHANGE]);
}

/* One range, from the upper decimal of the change where it begins to the lower one of that where it ends. */
static size_t add_range(struct text *out, const struct rows *t, size_t i) {
  double least;
  size_t end = end_of_good(t, i, &least);
  bool left = end < t->n && is_change(t, end);
  const char *from = t->cell[i][is_change(t, i) ? E2_TO : E2], *to = t->cell[left ? end : end - 1][E2];
  bool one = strcmp(from, to) == 0;
  if (one)
    text_printf(out, " It is conditionally stable and admissible at $e_2 = %s$", from);
  else
    text_printf(out, " It is conditionally stable and admissible for $%s < e_2 < %s$", from, to);
  add_edge(out, t, i, "lower");
  add_edge(out, t, end, "upper");
  if (!isnan(least) && !one)
    text_printf(out, ". In between $|\\operatorname{tr} J|$ is at least %.4f at the values drawn, %s",
                floor(least * 1e4) / 1e4,
                least > 0.9 ? "so that small changes of the positions die out slowly"
                            : "where small changes of the positions die out fastest");
  text_add_char(out, '.');
  return end;
}

/* "from x to y"; the table begins at half of the scene's e2 and ends at three times it where no change ends it. */
static void add_ends(struct text *out, const struct rows *t) {
  static const char *const far[2][2] = {{"half of the printed $e_2$", "half of its $e_2$"},
                                        {"three times the printed $e_2$", "three times its $e_2$"}};
  for (int end = 0; end < 2; end++) {
    size_t i = end ? t->n - 1 : 0;
    bool change = is_change(t, i);
    text_printf(out, " %s %s%s", end ? "to" : "from", change ? "where " : "",
                change ? t->cell[i][CHANGE] : far[end][t->orbit != NULL]);
  }
}

/* Which of the key's curves an orbit belongs to. */
static int class_of(const struct rows *t, size_t i) {
  return is_good(t, i) ? 0 : rows_is(t, i, ADMISSIBLE, "yes") ? 1 : 2;
}

static void say_along(struct text *out, const struct rows *t) {
  bool any = false, dotted = false;
  if (t->n == 0 || t->columns <= ADMISSIBLE) return;
  text_printf(out, "The picture shows %s for $%s \\le e_2 \\le %s$ with the other data of %s,",
              t->orbit ? t->orbit : "the periodic solution nearest to the printed numbers", t->cell[0][E2],
              t->cell[t->n - 1][E2], t->orbit ? "this scene" : "the example");
  add_ends(out, t);
  for (size_t i = 0; i < t->n; i++) dotted |= !is_change(t, i) && class_of(t, i) == 2;
  text_add(out, dotted ? "; the dotted part solves the equations, but breaks a condition of the motion." : ".");
  for (size_t i = 0; i < t->n; i++)
    if (is_good(t, i)) {
      i = add_range(out, t, i);
      any = true;
    }
  text_add(out,
           any ? " The values drawn and the ends of the range are proved to the digits given; the curve between is "
                 "interpolated."
               : " It is nowhere both conditionally stable and admissible there.");
}

static void tell_along(struct text *out, const struct rows *t) {
  if (t->columns <= ADMISSIBLE) return;
  const char *name = t->heading[E2];
  text_printf(out, "%s against %s, tr J above and the period below.", has_branches(t) ? "Curves" : "Two curves", name);
  for (size_t i = 0; i < t->n; i++)
    if (is_change(t, i))
      text_printf(out, " Near %s = %s %s.", name, t->cell[i][E2], t->cell[i][CHANGE]);
    else if (i == 0 || i + 1 == t->n || !same_branch(t, i - 1, i))
      text_printf(out, " At %s = %s tr J is %s and the period %s.", name, t->cell[i][E2], t->cell[i][TRACE],
                  t->cell[i][PERIOD]);
}

/* The samples, curve by curve of the key; where there are branches they pass through the changes. */
static void add_curve(struct plot *p, const struct rows *t, size_t column) {
  for (int k = 2; k >= 0; k--) { /* good ones on top */
    size_t last = t->n;
    for (size_t i = 0; i < t->n; i++) {
      if (is_change(t, i) && !has_branches(t)) continue;
      if (last == t->n || !same_branch(t, last, i) || class_of(t, is_change(t, i) ? last : i) != k) {
        plot_end(p);
      } else {
        if (!p->open) plot_point(p, plot_class[k], rows_number(t, last, E2), rows_number(t, last, column));
        plot_point(p, plot_class[k], rows_number(t, i, E2), rows_number(t, i, column));
      }
      last = i;
    }
    plot_end(p);
  }
}

static void add_panel(struct plot *p, const struct rows *t, size_t column, double top, const char *label) {
  char name[PLOT_LABEL];
  parameter_label(name, t->columns > E2 ? t->heading[E2] : "");
  plot_forget(p);
  for (size_t i = 0; i < t->n; i++) {
    if (is_change(t, i)) continue;
    double y = rows_number(t, i, column);
    plot_hold(&p->low[0], &p->high[0], rows_number(t, i, E2));
    if (has_branches(t) && column == TRACE) y = fmin(fmax(y, -MOST_TRACE), MOST_TRACE);
    plot_hold(&p->low[1], &p->high[1], y);
  }
  plot_widen(p, 1, 0.12, 0.12);
  plot_panel(p, top, has_branches(t) ? 150 : 72, name, label);
  if (column == TRACE)
    for (int side = -1; side <= 1; side += 2) plot_line(p, "aid", p->low[0], side, p->high[0], side);
  for (size_t i = 0; i < t->n; i++)
    if (is_change(t, i)) plot_line(p, "aid", rows_number(t, i, E2), p->low[1], rows_number(t, i, E2), p->high[1]);
  add_curve(p, t, column);
  for (size_t i = 0; i < t->n && has_branches(t); i++)
    if (is_change(t, i)) plot_dot(p, "open", rows_number(t, i, E2), rows_number(t, i, column));
  plot_free(p);
}

static void draw_along(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "stable"},
                                       {"c1", "unstable"},
                                       {"c2", "no motion"},
                                       {"aid", "across: tr *J* = \xc2\xb1"
                                               "1; upright: changes"}};
  double top = plot_key(p, key, 4);
  add_panel(p, t, TRACE, top + 18, "tr *J*");
  add_panel(p, t, PERIOD, top + 146, "period");
}

const struct picture picture_along = {"along-e2", "along-e2.tsv", "The periodic solution as e_2 varies",
                                      say_along,  tell_along,     draw_along};

/* --- Every branch --- */

/* The change next to the right of row i, or the first of all where i is t->n; t->n where there is none. */
static size_t next_change(const struct rows *t, size_t i) {
  size_t next = t->n;
  double after = i < t->n ? rows_number(t, i, E2) : -INFINITY, best = INFINITY;
  for (size_t k = 0; k < t->n; k++) {
    double at = is_change(t, k) ? rows_number(t, k, E2) : (double)NAN;
    if ((at > after || (at == after && k > i)) && at < best) {
      next = k;
      best = at;
    }
  }
  return next;
}

/* Their numbers above the panel; those that follow one another stand on different heights. */
static void add_numbers(struct plot *p, const struct rows *t) {
  size_t n = 0;
  for (size_t i = next_change(t, t->n); i < t->n; i = next_change(t, i)) {
    char shown[24];
    double y = p->top - 4 - 11 * (double)(n % 3);
    snprintf(shown, sizeof shown, "%zu", ++n);
    plot_text(p, plot_x(p, rows_number(t, i, E2)), y, "middle", shown);
  }
}

/* Each with its bracket. */
static void list_changes(struct plot *p, const struct rows *t) {
  double y = p->bottom + 14;
  size_t n = 0;
  for (size_t i = next_change(t, t->n); i < t->n; i = next_change(t, i)) {
    const char **cell = t->cell[i];
    char line[200];
    snprintf(line, sizeof line, "%zu: %s < %s < %s, branch %s:", ++n, cell[E2], t->heading[E2], cell[E2_TO],
             cell[BRANCH]);
    y = plot_lines(p, 4, y, line);
    y = plot_lines(p, 22, y, cell[CHANGE]) + 4;
  }
  const char *says =
      n ? "Each bracket is proved to hold its change. " TABLE_UNITS : "No change is found on the line. " TABLE_UNITS;
  p->bottom = plot_lines(p, 4, y, says);
}

static void draw_bifurcations(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "stable, admissible"},
                                       {"c1", "unstable, admissible"},
                                       {"c2", "not admissible"},
                                       {"dot open", "change"},
                                       {"aid", "tr *J* = \xc2\xb1"
                                               "1"}};
  p->bottom = plot_key(p, key, 5);
  if (!has_branches(t)) return;
  add_panel(p, t, TRACE, p->bottom + (next_change(t, t->n) < t->n ? 44 : 18), "tr *J*");
  add_numbers(p, t);
  add_panel(p, t, PERIOD, p->bottom + 24, "period *T*");
  list_changes(p, t);
}

const struct picture picture_bifurcations = {
    "bifurcations", "bifurcations.tsv", "Periodic orbits along one parameter, with what changes",
    NULL,           tell_along,         draw_bifurcations};
