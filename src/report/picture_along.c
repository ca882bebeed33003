/* The solution along e2: its multiplier and its period, and for which e2 it is stable and admissible. */
#include <math.h>

#include "picture.h"

enum { CHANGE, E2, E2_TO, TRACE, PERIOD, STABLE, ADMISSIBLE };

static bool is_change(const struct rows *t, size_t i) {
  return !rows_is(t, i, CHANGE, "-");
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
  text_printf(out, " It is stable and admissible for $%s < e_2 < %s$", t->cell[i][is_change(t, i) ? E2_TO : E2],
              t->cell[left ? end : end - 1][E2]);
  add_edge(out, t, i, "lower");
  add_edge(out, t, end, "upper");
  if (!isnan(least))
    text_printf(out,
                ". In between $|\\operatorname{tr} J|$ is at least %.4f at the values drawn, so that disturbances %s",
                floor(least * 1e4) / 1e4, least > 0.9 ? "die out slowly" : "die out");
  text_add_char(out, '.');
  return end;
}

static void say_along(struct text *out, const struct rows *t) {
  bool any = false;
  if (t->n == 0 || t->columns <= ADMISSIBLE) return;
  text_printf(out, "The picture shows this solution for $%s \\le e_2 \\le %s$ with the other data of the example.",
              t->cell[0][E2], t->cell[t->n - 1][E2]);
  for (size_t i = 0; i < t->n; i++)
    if (is_good(t, i)) {
      i = add_range(out, t, i);
      any = true;
    }
  text_add(out,
           any ? " The values drawn and the ends of the range are proved to the digits given; the curve between is "
                 "interpolated."
               : " It is nowhere both stable and admissible there.");
}

static void tell_along(struct text *out, const struct rows *t) {
  text_add(out, "Two curves against e2, tr J above and the period below.");
  for (size_t i = 0; i < t->n && t->columns > ADMISSIBLE; i++)
    if (is_change(t, i))
      text_printf(out, " Near e2 = %s %s.", t->cell[i][E2], t->cell[i][CHANGE]);
    else if (i == 0 || i + 1 == t->n)
      text_printf(out, " At e2 = %s tr J is %s and the period %s.", t->cell[i][E2], t->cell[i][TRACE],
                  t->cell[i][PERIOD]);
}

/* The samples, good ones apart. */
static void add_curve(struct plot *p, const struct rows *t, size_t column) {
  for (int good = 0; good < 2; good++) {
    const char *class = good ? "c0" : "c1";
    for (size_t i = 0; i < t->n; i++) {
      bool here = is_good(t, i) == good, before = i > 0 && is_good(t, i - 1) == good;
      if (is_change(t, i)) continue;
      if (here || before || (i + 1 < t->n && is_good(t, i + 1) == good))
        plot_point(p, class, rows_number(t, i, E2), rows_number(t, i, column));
      else
        plot_end(p);
    }
    plot_end(p);
  }
}

static void add_panel(struct plot *p, const struct rows *t, size_t column, double top, const char *label) {
  plot_forget(p);
  for (size_t i = 0; i < t->n; i++) {
    if (is_change(t, i)) continue;
    plot_hold(&p->low[0], &p->high[0], rows_number(t, i, E2));
    plot_hold(&p->low[1], &p->high[1], rows_number(t, i, column));
  }
  plot_widen(p, 1, 0.12, 0.12);
  plot_panel(p, top, 72, "*e*_2", label);
  if (column == TRACE)
    for (int side = -1; side <= 1; side += 2) plot_line(p, "aid", p->low[0], side, p->high[0], side);
  for (size_t i = 0; i < t->n; i++)
    if (is_change(t, i)) plot_line(p, "aid", rows_number(t, i, E2), p->low[1], rows_number(t, i, E2), p->high[1]);
  add_curve(p, t, column);
  plot_free(p);
}

static void draw_along(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "stable and admissible"},
                                       {"c1", "not both"},
                                       {"aid", "\xc2\xb1"
                                               "1; changes"}};
  double top = plot_key(p, key, 3);
  add_panel(p, t, TRACE, top + 18, "tr *J*");
  add_panel(p, t, PERIOD, top + 146, "period");
}

const struct picture picture_along = {"along-e2", "along-e2.tsv", "The periodic solution as e2 varies",
                                      say_along,  tell_along,     draw_along};
