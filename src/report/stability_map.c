/* Maps of lost digits, as tables and as pictures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot.h"
#include "stability.h"

/* Failures stand at one digit above all. */
static double shown(double lost) {
  return isinf(lost) ? STABILITY_DIGITS + 1 : lost;
}

static void add_cells(struct text *out, const struct stability_map *m) {
  for (int i = 0; i < STABILITY_MAP; i++)
    for (int k = 0; k < STABILITY_MAP; k++) {
      text_printf(out, "%.1f\t%.1f\t", m->x_at[k], m->y_at[i]);
      for (int a = 0; a < 2; a++) {
        double v = a ? m->after[i][k] : m->lost[i][k];
        if (isnan(v))
          text_add(out, "NaN");
        else
          text_printf(out, "%.1f", shown(v));
        text_add(out, a ? "\n" : "\t");
      }
    }
}

void report_stability_map_tsv(struct text *out, const struct stability_result *r, int map) {
  const struct stability_map *m = &r->map[map];
  text_printf(
      out,
      "# %s, digits lost by the formula (%.1f: no value) over log10 |%s| and log10 |%s|; %s\n%s\t%s\tlost\tafter\n",
      r->formula[m->formula].id, STABILITY_DIGITS + 1, m->x, m->y, m->at, m->x, m->y);
  add_cells(out, m);
}

/* What an axis shows: of chi, chi/(1 - chi). */
static void axis(char label[2 * PLOT_LABEL], const char *input) {
  char name[PLOT_LABEL];
  parameter_label(name, input);
  snprintf(label, 2 * PLOT_LABEL, strcmp(input, "chi") == 0 ? "%s/(1 \xe2\x88\x92 %s)" : "|%s|", name, name);
}

static const char *const key[][2] = {{"shade d0", "0-2"},      {"shade d1", "2-4"},   {"shade d2", "4-6"},
                                     {"shade d3", "6-8"},      {"shade d4", "8-10"},  {"shade d5", "10-12"},
                                     {"shade d6", "12-14"},    {"shade d7", "14-16"}, {"shade d8", "no value"},
                                     {"shade d9", "not known"}};
enum { FAILED = 8, UNKNOWN, N_SHADES, WIDTH = 410 };

/* Of the digits as the table has them. */
static int shade_of(double lost) {
  return isnan(lost) ? UNKNOWN : isinf(lost) ? FAILED : (int)lround(10 * lost) / 20;
}

/* The cells of each shade, those beside each other as one. */
static void draw_cells(struct plot *p, const struct stability_map *m, const double lost[STABILITY_MAP][STABILITY_MAP]) {
  double half = (m->x_at[1] - m->x_at[0]) / 2;
  for (int shade = 0; shade < N_SHADES; shade++) {
    for (int i = 0; i < STABILITY_MAP; i++)
      for (int k = 0; k < STABILITY_MAP; k++) {
        if (shade_of(lost[i][k]) != shade) continue;
        int first = k;
        while (k + 1 < STABILITY_MAP && shade_of(lost[i][k + 1]) == shade) k++;
        plot_box(p, key[shade][0], m->x_at[first] - half, m->y_at[i] - half, m->x_at[k] + half, m->y_at[i] + half);
      }
    plot_end(p);
  }
}

void report_stability_picture(struct text *out, const struct stability_result *r, int map, const char *id) {
  const struct stability_map *m = &r->map[map];
  const char *const layers[] = {r->layer, r->after};
  OWNED(text) drawn = {0}, caption = {0};
  char x[2 * PLOT_LABEL], y[2 * PLOT_LABEL];
  int panels = r->after ? 2 : 1;
  struct plot p = plot_begin(&drawn, id, WIDTH * panels);
  axis(x, m->x);
  axis(y, m->y);
  p.power[0] = p.power[1] = true;
  double top = plot_key(&p, key, N_SHADES) + 22;
  for (int i = 0; i < panels; i++) {
    p.left = WIDTH * i + PLOT_LEFT;
    p.right = WIDTH * (i + 1) - PLOT_RIGHT;
    for (int k = 0; k < 2; k++) {
      p.low[k] = -16.4;
      p.high[k] = 16.4;
    }
    plot_panel(&p, top, 350, x, y);
    draw_cells(&p, m, i ? m->after : m->lost);
    plot_free(&p);
    text_reset(&caption);
    text_printf(&caption, "digits lost by %s, %s", r->formula[m->formula].id, layers[i]);
    plot_text(&p, p.right, top - 7, "end", text_str(&caption));
  }
  plot_svg(out, &p, "Digits lost over two inputs", "The numbers are in the table beside it.", true);
}
