/* Pictures of one panel: the margins of the conditions, the distance from an orbit, the error of finite differences. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture.h"

/* --- Margins --- */

enum { M_PHASE, M_TIME, M_FIRST, M_COLUMNS = 4 };
static const char *const margin_name[M_COLUMNS] = {"V - z1'", "V - z2'", "e1 - w", "e2 - chi r"};

/* The least of a column. */
static double least_margin(const struct rows *t, int column) {
  double low = (double)NAN, high = (double)NAN;
  for (size_t i = 0; i < t->n; i++) plot_hold(&low, &high, rows_number(t, i, M_FIRST + (size_t)column));
  return low;
}

static bool all_hold(const struct rows *t) {
  for (int c = 0; c < M_COLUMNS; c++)
    if (least_margin(t, c) < 0) return false;
  return true;
}

static void say_margins(struct text *out, const struct rows *t) {
  text_add(out,
           "What keeps the order of the phases, along the orbit: a slipping mass must stay slower than the belt, $V - "
           "z'_i > 0$, and the pull on a sticking one below its limit, $e_1 - (z_1 - \\chi z_2) > 0$ and $e_2 - \\chi "
           "(z_2 - z_1) > 0$; in the picture $w = z_1 - \\chi z_2$ and $r = z_2 - z_1$. Each begins or ends at 0 where "
           "its phase does. ");
  if (all_hold(t))
    text_add(out, "None is negative in between, so that the orbit does what the phases say.");
  else
    text_add(out, "One is negative in between: the real motion leaves this order of phases there.");
}

static void tell_margins(struct text *out, const struct rows *t) {
  text_add(out, "Four curves over one period. Least values: ");
  for (int c = 0; c < M_COLUMNS; c++) text_printf(out, "%s%s %.3f", c ? ", " : "", margin_name[c], least_margin(t, c));
  text_add(out, ".");
}

void picture_phases(struct plot *p, const struct rows *t, size_t phase, size_t time) {
  static const char *const sign[] = {"D", "Gamma", "H", "C"}, *const shown[] = {"D", "\xce\x93", "H", "C"};
  for (size_t i = 0; i < t->n;) {
    size_t k = rows_end(t, i, phase);
    double from = rows_number(t, i, time), to = rows_number(t, k, time);
    plot_line(p, "aid", to, p->low[1], to, p->high[1]);
    for (int s = 0; s < 4; s++)
      if (rows_is(t, i, phase, sign[s]) && plot_x(p, to) - plot_x(p, from) > 12)
        plot_text(p, plot_x(p, (from + to) / 2), p->top + 14, "middle", shown[s]);
    i = k + 1;
  }
}

static void draw_margins(struct plot *p, const struct rows *t) {
  static const char *const key[][2] = {{"c0", "*V* \xe2\x88\x92 *z*\xe2\x80\xb2_1"},
                                       {"c1", "*V* \xe2\x88\x92 *z*\xe2\x80\xb2_2"},
                                       {"c2", "*e*_1 \xe2\x88\x92 *w*"},
                                       {"c3", "*e*_2 \xe2\x88\x92 *\xcf\x87r*"}};
  double top = plot_key(p, key, M_COLUMNS);
  plot_hold_columns(p, t, M_TIME, M_FIRST, M_COLUMNS);
  plot_hold(&p->low[1], &p->high[1], 0);
  plot_widen(p, 1, 0.05, 0.12);
  plot_panel(p, top + 18, 240, "time *t*", "margin");
  plot_line(p, "frame", p->low[0], 0, p->high[0], 0);
  for (int c = 0; c < M_COLUMNS; c++) plot_column(p, t, plot_class[c], M_TIME, M_FIRST + (size_t)c);
  picture_phases(p, t, M_PHASE, M_TIME);
  plot_free(p);
}

const struct picture picture_margins = {"margins",   "margins.tsv", "How far the conditions are from failing",
                                        say_margins, tell_margins,  draw_margins};

/* --- Long runs --- */

enum { RUN, PERIOD, LOG };

/* What a run is called: "orbit 2", also where it is formal; "printed start". */
static void run_name(char name[40], const struct rows *t, size_t i) {
  const char *run = t->cell[i][RUN];
  bool formal = strncmp(run, "formal ", 7) == 0;
  if (strcmp(run, "printed") == 0)
    snprintf(name, 40, "printed start");
  else
    snprintf(name, 40, "orbit %.20s%s", strchr(run, ' ') ? strchr(run, ' ') + 1 : run, formal ? " (formal)" : "");
}

static void say_long_run(struct text *out, const struct rows *t) {
  text_add(
      out,
      "The distance $|r - r^*|$ from a periodic orbit after every period. A start 1/1000 beside an orbit leaves it "
      "or comes to it by the factor $|\\operatorname{tr} J|$ a period: a straight line here.");
  bool formal = false;
  for (size_t i = 0; i < t->n; i++) {
    size_t end = rows_end(t, i, RUN);
    char name[40];
    run_name(name, t, i);
    double from = rows_number(t, i, LOG), to = rows_number(t, end, LOG);
    text_printf(out, " %s%s: from %.2g", name[0] == 'p' ? "The " : "Beside ", name, pow(10, from));
    if (end > i)
      text_printf(out, " to %.2g in %s period%s.", pow(10, to), t->cell[end][PERIOD], plural_s((long)(end - i)));
    else
      text_add(out, ", without a return.");
    formal = formal || strstr(name, "(formal)");
    i = end;
  }
  if (formal)
    text_add(
        out,
        " Formal: it solves the equations, but a condition of the motion fails on it, so that no masses follow it.");
}

static void tell_long_run(struct text *out, const struct rows *t) {
  text_add(out, "Distance from an orbit on a logarithmic axis against the number of periods.");
  for (size_t i = 0; i < t->n; i++) {
    size_t end = rows_end(t, i, RUN);
    char name[40];
    run_name(name, t, i);
    text_printf(out, " %s: from 10 to the power %.2f to 10 to the power %.2f in %s periods.", name,
                rows_number(t, i, LOG), rows_number(t, end, LOG), t->cell[end][PERIOD]);
    i = end;
  }
}

static void draw_long_run(struct plot *p, const struct rows *t) {
  enum { MOST = 12 };
  char name[MOST][40];
  const char *key[MOST][2];
  int n = 0;
  for (size_t i = 0; i < t->n && n < MOST; i = rows_end(t, i, RUN) + 1, n++) {
    run_name(name[n], t, i);
    key[n][0] = plot_class[n % PLOT_CLASSES];
    key[n][1] = name[n];
  }
  double top = plot_key(p, (const char *const(*)[2])key, n);
  plot_hold_columns(p, t, PERIOD, LOG, 1);
  plot_widen(p, 1, 0.05, 0.05);
  p->power[1] = true;
  plot_panel(p, top + 18, 230, "periods", "|*r* \xe2\x88\x92 *r*^{*}|");
  n = 0;
  for (size_t i = 0; i < t->n; n++) {
    size_t end = rows_end(t, i, RUN);
    for (; i <= end; i++)
      plot_point(p, plot_class[n % PLOT_CLASSES], rows_number(t, i, PERIOD), rows_number(t, i, LOG));
    plot_end(p);
  }
  plot_free(p);
}

const struct picture picture_long_run = {"long-run",   "long-run.tsv", "Towards an orbit, or away",
                                         say_long_run, tell_long_run,  draw_long_run};

/* --- Error of finite differences --- */

enum { STEP, BITS_53, N_BITS = 3 };
static const char *const bits_name[N_BITS] = {"53 bits (double)", "113 bits", "256 bits"};

/* The row of the least error; n where there is none. */
static size_t least_error(const struct rows *t, size_t column) {
  size_t best = t->n;
  for (size_t i = 0; i < t->n; i++) {
    double x = rows_number(t, i, column);
    if (!isnan(x) && (best == t->n || x < rows_number(t, best, column))) best = i;
  }
  return best;
}

static void say_steps(struct text *out, const struct rows *t) {
  text_add(out,
           "The error of $\\operatorname{tr} J$ by central differences against their step $h$. It falls as $h^2$ until "
           "rounding, divided by $h$, takes over: the V.");
  size_t best = least_error(t, BITS_53);
  if (best < t->n)
    text_printf(
        out,
        " With the 53 bits of double precision no step gives less than $10^{%.1f}$ (at $h = 10^{%.1f}$); more "
        "bits, by MPFR, go on. So a Jacobian by differences in double cannot judge a formula to full precision.",
        rows_number(t, best, BITS_53), rows_number(t, best, STEP));
}

static void tell_steps(struct text *out, const struct rows *t) {
  text_add(out, "Three curves on logarithmic axes. Least errors:");
  for (int k = 0; k < N_BITS; k++) {
    size_t best = least_error(t, BITS_53 + (size_t)k);
    if (best < t->n)
      text_printf(out, " %s, 10 to the power %.1f at a step of 10 to the power %.1f%s", bits_name[k],
                  rows_number(t, best, BITS_53 + (size_t)k), rows_number(t, best, STEP), k + 1 < N_BITS ? ";" : ".");
  }
}

static void draw_steps(struct plot *p, const struct rows *t) {
  const char *key[N_BITS][2];
  for (int k = 0; k < N_BITS; k++) {
    key[k][0] = plot_class[k];
    key[k][1] = bits_name[k];
  }
  double top = plot_key(p, (const char *const(*)[2])key, N_BITS);
  plot_hold_columns(p, t, STEP, BITS_53, N_BITS);
  plot_widen(p, 1, 0.05, 0.05);
  p->power[0] = p->power[1] = true;
  plot_panel(p, top + 18, 230, "step *h*", "error of tr *J*");
  for (size_t k = 0; k < N_BITS; k++) plot_column(p, t, plot_class[k], STEP, BITS_53 + k);
  plot_free(p);
}

const struct picture picture_steps = {"differences", "differences.tsv", "Finite differences: error against step",
                                      say_steps,     tell_steps,        draw_steps};
