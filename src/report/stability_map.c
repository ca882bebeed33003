/* Maps of lost digits, as tables and as scripts for gnuplot. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "stability.h"

/* Failures stand at one digit above all. */
static double shown(double lost) {
  return isinf(lost) ? STABILITY_DIGITS + 1 : lost;
}

static void add_cells(struct text *out, const struct stability_map *m, const char *blank) {
  for (int i = 0; i < STABILITY_MAP; i++) {
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
    text_add(out, blank);
  }
}

void report_stability_map_tsv(struct text *out, const struct stability_result *r, int map) {
  const struct stability_map *m = &r->map[map];
  text_printf(
      out,
      "# %s, digits lost by the formula (%.1f: no value) over log10 |%s| and log10 |%s|; %s\n%s\t%s\tlost\tafter\n",
      r->formula[m->formula].id, STABILITY_DIGITS + 1, m->x, m->y, m->at, m->x, m->y);
  add_cells(out, m, "");
}

/* What an axis shows: of chi, chi/(1 - chi). */
static const char *axis(char buffer[64], const char *input) {
  bool chi = strcmp(input, "chi") == 0;
  snprintf(buffer, 64, chi ? "log10 %s/(1 - chi)" : "log10 |%s|", input);
  return buffer;
}

void report_stability_gnuplot(struct text *out, const struct stability_result *r, int map, const char *name) {
  const struct stability_map *m = &r->map[map];
  char x[64], y[64];
  text_add(out, "$cells << EOD\n");
  add_cells(out, m, "\n");
  text_printf(out,
              "EOD\nset terminal svg size %d,420 font 'sans,11'\nset output '%s.svg'\n"
              "set palette defined (0 '#fdf5c8', 4 '#8fd175', 8 '#25938b', 12 '#3a5088', 17 '#260a3c')\n"
              "set object rectangle from graph 0,0 to graph 1,1 behind fillcolor '#bbbbbb' fillstyle pattern 4\n"
              "set cbrange [0:%.1f]\nset cblabel 'digits lost by the formula'\nset cbtics 0,2\n"
              "set xrange [-16.4:16.4]\nset yrange [-16.4:16.4]\nset xtics 4\nset ytics 4\nset tics out nomirror\nset "
              "xlabel \"%s\" noenhanced\n"
              "set ylabel \"%s\" noenhanced\n",
              r->after ? 1040 : 560, name, STABILITY_DIGITS + 1, axis(x, m->x), axis(y, m->y));
  if (r->after) text_add(out, "set multiplot layout 1,2\n");
  text_printf(out, "set title \"%s, %s\" noenhanced\nplot $cells using 1:2:3 with image notitle\n",
              r->formula[m->formula].id, r->layer);
  if (r->after)
    text_printf(out, "set title \"%s, %s\" noenhanced\nplot $cells using 1:2:4 with image notitle\nunset multiplot\n",
                r->formula[m->formula].id, r->after);
  text_add(out, "unset output\n");
}
