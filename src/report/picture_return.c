/* The return map: the whole of it, and close to the orbit with the steps that lead away from the printed start or to
   it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture.h"

enum { CURVE, PIECE, R, NEXT, SLOPE };

static bool fixed_point(const struct rows *t, size_t i) {
  return rows_is(t, i, CURVE, "orbit") || rows_is(t, i, CURVE, "formal");
}

/* First and last r of the iterates; false where there are none. */
static bool ends_of_iterates(const struct rows *t, double *first, double *last) {
  *first = *last = (double)NAN;
  for (size_t i = 0; i < t->n; i++) {
    if (!rows_is(t, i, CURVE, "iterate")) continue;
    if (isnan(*first)) *first = rows_number(t, i, R);
    if (!isnan(rows_number(t, i, NEXT))) *last = rows_number(t, i, NEXT);
  }
  return !isnan(*first);
}

/* Beside $r = ...$: to four decimals, or as the table has it where they are zero. */
static void add_r(struct text *out, const struct rows *t, size_t i) {
  double r = rows_number(t, i, R);
  if (fabs(r) < 1e-3)
    text_add(out, t->cell[i][R]);
  else
    text_printf(out, "%.4f", r);
}

static void say_return_map(struct text *out, const struct rows *t) {
  text_add(out, "At the end of the global stick phase one number, $r = z_2 - z_1$, fixes all that follows; one period "
                "later it is $r'$. Periodic orbits are where the map meets the line $r' = r$, and the slope there is "
                "$\\operatorname{tr} J$: ");
  const char *sep = "";
  for (size_t i = 0; i < t->n; i++) {
    if (!fixed_point(t, i)) continue;
    double slope = rows_number(t, i, SLOPE);
    text_printf(out, "%sorbit %s at $r = ", sep, t->cell[i][PIECE]);
    add_r(out, t, i);
    text_printf(out, "$ with slope $%.4f$%s%s", slope,
                fabs(slope) < 1 ? ", which draws its neighbours in" : ", which drives its neighbours away",
                rows_is(t, i, CURVE, "formal") ? " (but a condition of the motion fails on it)" : "");
    sep = "; ";
  }
  double first, last;
  if (ends_of_iterates(t, &first, &last))
    text_printf(out, ". Below, enlarged: the iterates from $r = %.4f$ to $r = %.4f$.", first, last);
  else
    text_add(out, ".");
}

static void tell_return_map(struct text *out, const struct rows *t) {
  text_add(out, "The map r to r', a falling or rising curve in pieces, and the line r' = r. Fixed points: ");
  const char *sep = "";
  for (size_t i = 0; i < t->n; i++)
    if (fixed_point(t, i)) {
      text_printf(out, "%sr = ", sep);
      add_r(out, t, i);
      text_printf(out, " with slope %.4f", rows_number(t, i, SLOPE));
      sep = ", ";
    }
  double first, last;
  if (ends_of_iterates(t, &first, &last)) text_printf(out, ". Iterates run from r = %.4f to r = %.4f", first, last);
  text_add(out, ".");
}

static void add_map(struct plot *p, const struct rows *t, const char *curve) {
  const char *piece = "";
  for (size_t i = 0; i < t->n; i++) {
    if (!rows_is(t, i, CURVE, curve)) continue;
    if (strcmp(piece, t->cell[i][PIECE]) != 0) plot_end(p);
    piece = t->cell[i][PIECE];
    plot_point(p, "c0", rows_number(t, i, R), rows_number(t, i, NEXT));
  }
  plot_end(p);
}

static void add_cobweb(struct plot *p, const struct rows *t) {
  for (size_t i = 0; i < t->n; i++) {
    if (!rows_is(t, i, CURVE, "iterate")) continue;
    double r = rows_number(t, i, R), next = rows_number(t, i, NEXT);
    if (rows_is(t, i, PIECE, "0")) plot_point(p, "web", r, r);
    plot_point(p, "web", r, next);
    plot_point(p, "web", next, next);
  }
  plot_end(p);
}

static void add_fixed_points(struct plot *p, const struct rows *t) {
  for (size_t i = 0; i < t->n; i++) {
    double r = rows_number(t, i, R), slope = rows_number(t, i, SLOPE);
    if (!fixed_point(t, i) || !(r > p->low[0] && r < p->high[0])) continue;
    plot_dot(p, fabs(slope) < 1 ? "" : "open", r, r);
    char label[60];
    snprintf(label, sizeof label, "%s: slope %s%.3f", t->cell[i][PIECE], slope < 0 ? "\xe2\x88\x92" : "", fabs(slope));
    bool right = plot_x(p, r) > PLOT_WIDTH / 2;
    plot_text(p, plot_x(p, r) + (right ? -9 : 9),
              plot_y(p, r) + (slope < 0 ? 4
                              : right   ? -6
                                        : 12),
              right ? "end" : "start", label);
  }
}

static void add_panel(struct plot *p, const struct rows *t, const char *curve, double top, bool steps) {
  plot_forget(p);
  for (size_t i = 0; i < t->n; i++)
    if (rows_is(t, i, CURVE, curve)) plot_hold(&p->low[0], &p->high[0], rows_number(t, i, R));
  p->low[1] = p->low[0];
  p->high[1] = p->high[0];
  plot_panel(p, top, 200, "*r*", "*r*\xe2\x80\xb2");
  plot_line(p, "aid", p->low[0], p->low[0], p->high[0], p->high[0]);
  if (steps) add_cobweb(p, t);
  add_map(p, t, curve);
  add_fixed_points(p, t);
  plot_free(p);
}

static void draw_return_map(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "map"},
                                       {"aid", "*r*\xe2\x80\xb2 = *r*"},
                                       {"dot", "|slope| < 1"},
                                       {"dot open", "|slope| > 1"},
                                       {"web", "steps from the start"}};
  double top = plot_key(p, key, 5);
  add_panel(p, t, "map", top + 18, false);
  add_panel(p, t, "near", top + 276, true);
}

const struct picture picture_return_map = {"return-map",   "return-map.tsv", "The return map",
                                           say_return_map, tell_return_map,  draw_return_map};
