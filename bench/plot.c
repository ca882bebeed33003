/* Error against time as a figure: a script for gnuplot that carries its data.

   Two panels: what double precision can reach, and what lies beyond, where the axis is the logarithm of the digits,
   since all doubles would be one line there.  Methods differ in colour, and in marker and dash together, so that the
   figure is read in grey too.  Both axes are logarithms, made here, since errors in multiprecision leave the range of
   gnuplot's numbers.  The dotted line is what rounding the inputs costs: in double nothing can be expected below it.  A
   second figure shows differences in double over their steps; another what verdicts cost. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"

/* Okabe and Ito's colours, which also differ in lightness, and others between them. */
static const char *const colours[] = {"#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9",
                                      "#e69f00", "#7f7f7f", "#6a3d9a", "#8c510a", "#b2182b", "#1b7837",
                                      "#e377c2", "#17becf", "#bcbd22", "#35478c", "#fb6a4a", "#66c2a4",
                                      "#a6761d", "#807dba", "#4d4d4d", "#c51b7d", "#b3b3b3", "#01665e"};
enum { N_COLOURS = sizeof colours / sizeof *colours, N_MARKERS = 15, N_DASHES = 4 };
static const char terminal[] = "set terminal svg size 1150,620 dynamic font 'sans,12' background '#ffffff'\n";
static const double beyond = -16.5; /* log10 of an error that no double has */

const char *bench_colour(int k) {
  return colours[k % N_COLOURS];
}

static bool plotted(const struct bench_row *r) {
  return !r->failure && isfinite(r->worst);
}

enum part { ALL, IN_DOUBLE, BEYOND };

static bool in_part(const struct bench_row *r, enum part part) {
  return plotted(r) && (part == ALL || (part == BEYOND) == (r->worst < beyond));
}

static int points_of(const struct bench_table *t, const struct bench_method *m, enum part part) {
  int n = 0;
  for (int i = 0; i < t->n; i++) n += t->row[i].method == m && in_part(&t->row[i], part);
  return n;
}

/* Differences in double, of which the second figure is. */
static bool in_double(const struct bench_method *m) {
  return m->kind == SET_STEP && m->type == &num_double;
}

/* A block for each method: log10 of time, error, setting and digits. */
static void add_data(struct text *out, const struct bench_table *t) {
  for (int k = 0; k < t->n_methods; k++) {
    const struct bench_method *m = t->method[k];
    if (points_of(t, m, ALL) == 0) continue;
    text_printf(out, "$m%d << EOD\n", k);
    for (int i = 0; i < t->n; i++) {
      const struct bench_row *r = &t->row[i];
      if (r->method != m || !plotted(r)) continue;
      text_printf(out, "%.4f %.4f %.4f ", log10(r->least_ns) - 9, r->worst,
                  m->kind == SET_NONE ? 0 : log10(r->setting));
      if (r->worst < beyond)
        text_printf(out, "%.4f\n", -log10(-r->worst));
      else
        text_add(out, "NaN\n");
    }
    text_add(out, "EOD\n");
  }
}

/* How a method is drawn, in every panel alike; the k-th of those that are drawn at all. */
static void add_look(struct text *out, int k, bool line) {
  text_printf(out, " with %s lc '%s' pt %d ps %s", line ? "linespoints" : "points", colours[k % N_COLOURS],
              k % N_MARKERS + 1, k < N_MARKERS ? "0.8" : "1.2");
  if (line) text_printf(out, " dt %d lw 1.2", k % N_DASHES + 1);
}

/* What has a point in the part, or has steps; columns: what against what.  first: a curve before them.  key: the others
   are named too, so that one key serves all panels. */
static void add_curves(struct text *out, const struct bench_table *t, const char *columns, enum part part,
                       const char *first, bool key) {
  const char *comma = *first ? ", \\\n  " : "";
  text_printf(out, "plot %s", first);
  for (int k = 0, look = -1; k < t->n_methods; k++) {
    const struct bench_method *m = t->method[k];
    if (points_of(t, m, ALL) == 0) continue;
    look++;
    int n = points_of(t, m, part);
    if (part == ALL ? !in_double(m) : n == 0 && !key) continue;
    text_printf(out, n > 0 ? "%s$m%d using %s" : "%skeyentry", comma, k, columns);
    add_look(out, look, points_of(t, m, ALL) > 1);
    text_printf(out, key ? " title '%s'" : " notitle", m->id);
    comma = ", \\\n  ";
  }
  text_add(out, "\n");
}

bool bench_has_steps(const struct bench_table *t) {
  bool any = false;
  for (int i = 0; i < t->n; i++) any = any || (in_double(t->row[i].method) && plotted(&t->row[i]));
  return any;
}

/* The most digits that any row has; 0 when none is beyond double. */
static double most_digits(const struct bench_table *t) {
  double most = 0;
  for (int i = 0; i < t->n; i++)
    if (in_part(&t->row[i], BEYOND)) most = fmax(most, -t->row[i].worst);
  return most;
}

/* 10^-20 to 10^-2000 where the axis is the logarithm of the digits. */
static void add_digit_tics(struct text *out) {
  static const int digits[] = {20, 30, 50, 100, 200, 300, 500, 1000, 2000};
  text_add(out, "set ytics (");
  for (size_t i = 0; i < sizeof digits / sizeof *digits; i++)
    text_printf(out, "%s'10^{-%d}' %.5f", i ? ", " : "", digits[i], -log10(digits[i]));
  text_add(out, ")\n");
}

void bench_gnuplot(struct text *out, const struct bench_table *t) {
  char floor_line[120];
  snprintf(floor_line, sizeof floor_line, "%.4f with lines dt 3 lw 2 lc '#404040' title 'limit of rounded inputs'",
           log10(t->floor));
  add_data(out, t);
  text_printf(
      out,
      "%sset output '%s.svg'\nset multiplot title '%s'\nset xlabel 'least time of one call, seconds'\n"
      "set format '10^{%%g}'\nset xtics 1\nset ytics 4\nset grid ytics lc '#d0d0d0'\nset bmargin at screen 0.1\n"
      "set tmargin at screen 0.92\nset lmargin at screen 0.08\nset rmargin at screen 0.41\n"
      "set ylabel 'worst error' offset 1\nset yrange [-18:0]\nset key at screen 0.99,0.93 right noenhanced\n",
      terminal, t->job->id, t->job->title);
  add_curves(out, t, "1:2", IN_DOUBLE, floor_line, true);
  if (most_digits(t) > 0) {
    text_printf(out,
                "set lmargin at screen 0.49\nset rmargin at screen 0.80\nunset ylabel\nset yrange [%.3f:-1.2]\n"
                "unset key\n",
                -log10(most_digits(t)) - 0.05);
    add_digit_tics(out);
    add_curves(out, t, "1:4", BEYOND, "", false);
  }
  text_add(out, "unset multiplot\n");
  if (!bench_has_steps(t)) return;
  text_printf(out,
              "reset\n%sset output '%s-steps.svg'\nset title '%s'\nset xlabel 'step'\nset ylabel 'worst error'\n"
              "set format '10^{%%g}'\nset xrange [-13:0]\nset yrange [-18:0]\nset xtics 2\nset ytics 4\n"
              "set grid ytics lc '#d0d0d0'\nset key outside right noenhanced\n",
              terminal, t->job->id, t->job->title);
  add_curves(out, t, "3:2", ALL, floor_line, true);
}

/* --- What verdicts cost. --- */

static void add_work(struct text *out, const struct bench_verdicts *v, enum bench_work_kind kind) {
  text_printf(out, "$w%d << EOD\n", kind);
  for (size_t i = 0; i < v->n; i++)
    if (v->work[i].kind == kind && v->work[i].good) text_printf(out, "%ld %.5g\n", v->work[i].size, v->work[i].seconds);
  text_add(out, "EOD\n");
}

void bench_verdicts_gnuplot(struct text *out, const struct bench_verdicts *v) {
  for (int kind = 0; kind < WORK_CLAIM; kind++) add_work(out, v, (enum bench_work_kind)kind);
  text_printf(
      out,
      "%sset output 'verdicts.svg'\nset multiplot layout 1,2 title 'What verdicts cost'\nset logscale xy\n"
      "set format y '10^{%%T}'\nset grid ytics lc '#d0d0d0'\nset key top left noenhanced\nunset mxtics\nunset mytics\n"
      "set ylabel 'least time, seconds'\nset xlabel 'digits'\nplot ",
      terminal);
  for (int kind = 0, n = 0; kind < WORK_CLAIM; kind++)
    if (kind != WORK_CLAIMS) {
      text_printf(out, "%s$w%d using 1:2 with linespoints lc '%s' pt %d ps 0.8 dt %d lw 1.2 title '%s'", n ? ", " : "",
                  kind, bench_colour(kind + 1), kind + 4, kind % N_DASHES + 1, bench_work_name[kind]);
      n++;
    }
  text_printf(out,
              "\nset xlabel 'claims judged together'\nunset ylabel\n"
              "plot $w%d using 1:2 with linespoints lc '%s' pt 4 ps 0.8 lw 1.2 title '%s'\nunset multiplot\n",
              WORK_CLAIMS, colours[0], bench_work_name[WORK_CLAIMS]);
}

void bench_squeeze(struct text *out, const char *svg) {
  static const char open[] = "<g ", close[] = "</g>\n";
  const char *group = NULL; /* the line before, when it opens a group */
  for (const char *line = svg; *line;) {
    size_t len = strcspn(line, "\n");
    const char *next = line + len + (line[len] == '\n');
    bool closes = group && strncmp(line, close, sizeof close - 1) == 0;
    if (group && !closes) text_add_n(out, group, (size_t)(line - group));
    group = !closes && strncmp(line, open, sizeof open - 1) == 0 && strchr(line, '>') == line + len - 1 ? line : NULL;
    if (!group && !closes) text_add_n(out, line, (size_t)(next - line));
    line = next;
  }
  if (group) text_add(out, group);
}

/* In the child: gnuplot in the folder, reading its script from the pipe. */
static void become_gnuplot(const char *folder, const int ends[2]) {
  signal(SIGPIPE, SIG_DFL);
  close(ends[1]);
  if (dup2(ends[0], STDIN_FILENO) < 0 || chdir(folder) != 0) _exit(127);
  close(ends[0]);
  execlp("gnuplot", "gnuplot", "-", (char *)NULL);
  _exit(127);
}

bool bench_draw(const char *folder, const struct text *script) {
  int ends[2], status = -1;
  if (pipe(ends) != 0) return false;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) become_gnuplot(folder, ends);
  close(ends[0]);
  void (*before)(int) = signal(SIGPIPE, SIG_IGN); /* a gnuplot that is not there reads nothing */
  bool sent = child > 0 && write_all(ends[1], text_str(script), script->len);
  close(ends[1]);
  signal(SIGPIPE, before);
  return child > 0 && waitpid(child, &status, 0) == child && sent && status == 0;
}
