/* Error against time as a figure: a script for gnuplot that carries its data.

   Two panels: what double precision can reach, and all.  Methods differ in colour, marker and dash, so that the figure is
   read in grey too.  Both axes are logarithms, made here, since errors in multiprecision leave the range of gnuplot's
   numbers.  The dotted line is what rounding the inputs costs: in double nothing can be expected below it.  A second figure
   shows differences in double over their steps. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"

/* Okabe and Ito's colours, which also differ in lightness. */
static const char *const colours[] = {"#000000", "#0072b2", "#d55e00", "#009e73",
                                      "#cc79a7", "#56b4e9", "#e69f00", "#7f7f7f"};
enum { N_COLOURS = sizeof colours / sizeof *colours, N_MARKERS = 13, N_DASHES = 5 };

const char *bench_colour(int k) {
  return colours[k % N_COLOURS];
}

static bool plotted(const struct bench_row *r) {
  return !r->failure && isfinite(r->worst);
}

static int points_of(const struct bench_table *t, const struct bench_method *m) {
  int n = 0;
  for (int i = 0; i < t->n; i++) n += t->row[i].method == m && plotted(&t->row[i]);
  return n;
}

/* Differences in double, of which the second figure is. */
static bool in_double(const struct bench_method *m) {
  return m->kind == SET_STEP && m->type == &num_double;
}

/* A block for each method: log10 of time, error and setting. */
static void add_data(struct text *out, const struct bench_table *t) {
  for (int k = 0; k < t->job->n_methods; k++) {
    const struct bench_method *m = &t->job->methods[k];
    if (points_of(t, m) == 0) continue;
    text_printf(out, "$m%d << EOD\n", k);
    for (int i = 0; i < t->n; i++) {
      const struct bench_row *r = &t->row[i];
      if (r->method != m || !plotted(r)) continue;
      text_printf(out, "%.4f %.4f %.4f\n", log10(r->least_ns) - 9, r->worst,
                  m->kind == SET_NONE ? 0 : log10(r->setting));
    }
    text_add(out, "EOD\n");
  }
}

/* Every method with a point, or those with steps; columns: what against what. */
static void add_curves(struct text *out, const struct bench_table *t, const char *columns, bool steps) {
  text_printf(out, "plot %.4f with lines dt 3 lw 2 lc '#404040' title 'rounded inputs'", log10(t->floor));
  for (int k = 0; k < t->job->n_methods; k++) {
    const struct bench_method *m = &t->job->methods[k];
    int n = points_of(t, m);
    if (n == 0 || (steps && !in_double(m))) continue;
    text_printf(out, ", \\\n  $m%d using %s with %s lc '%s' pt %d ps 0.8", k, columns, n > 1 ? "linespoints" : "points",
                bench_colour(k), k % N_MARKERS + 1);
    if (n > 1) text_printf(out, " dt %d lw 1.2", k % N_DASHES + 1);
    text_printf(out, " title '%s'", m->id);
  }
  text_add(out, "\n");
}

bool bench_has_steps(const struct bench_table *t) {
  bool any = false;
  for (int i = 0; i < t->n; i++) any = any || (in_double(t->row[i].method) && plotted(&t->row[i]));
  return any;
}

void bench_gnuplot(struct text *out, const struct bench_table *t) {
  static const char terminal[] = "set terminal svg size 1150,620 dynamic font 'sans,12' background '#ffffff'\n";
  add_data(out, t);
  text_printf(out,
              "%sset output '%s.svg'\nset multiplot title '%s'\nset xlabel 'time of one call, seconds'\n"
              "set format '10^{%%g}'\nset xtics 1\nset grid lc '#d0d0d0'\nset bmargin at screen 0.1\n"
              "set tmargin at screen 0.92\nset lmargin at screen 0.09\nset rmargin at screen 0.41\n"
              "set ylabel 'worst error'\nset yrange [-18:0]\nunset key\n",
              terminal, t->job->id, t->job->title);
  add_curves(out, t, "1:2", false);
  text_add(out, "set lmargin at screen 0.48\nset rmargin at screen 0.8\nunset ylabel\nset yrange [*:0]\n"
                "set key at screen 0.99,0.9 right noenhanced\n");
  add_curves(out, t, "1:2", false);
  text_add(out, "unset multiplot\n");
  if (!bench_has_steps(t)) return;
  text_printf(out,
              "reset\n%sset output '%s-steps.svg'\nset title '%s'\nset xlabel 'step'\nset ylabel 'worst error'\n"
              "set format '10^{%%g}'\nset xrange [-13:0]\nset yrange [-18:0]\nset xtics 1\nset grid lc '#d0d0d0'\n"
              "set key outside right noenhanced\n",
              terminal, t->job->id, t->job->title);
  add_curves(out, t, "3:2", true);
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
