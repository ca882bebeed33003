/* Error against time as a figure: a script for gnuplot that carries its data.

   Methods differ in colour, marker and dash, so that the figure is read in grey too.  Both axes are logarithms, made here,
   since errors in multiprecision leave the range of gnuplot's numbers.  The dotted line is what rounding the inputs costs:
   in double nothing can be expected below it. */
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

static int points_of(const struct bench_table *t, const struct bench_method *m) {
  int n = 0;
  for (int i = 0; i < t->n; i++) n += t->row[i].method == m && !t->row[i].failure && isfinite(t->row[i].worst);
  return n;
}

static void add_data(struct text *out, const struct bench_table *t) {
  for (int k = 0; k < t->job->n_methods; k++) {
    const struct bench_method *m = &t->job->methods[k];
    if (points_of(t, m) == 0) continue;
    text_printf(out, "$m%d << EOD\n", k);
    for (int i = 0; i < t->n; i++) {
      const struct bench_row *r = &t->row[i];
      if (r->method == m && !r->failure && isfinite(r->worst))
        text_printf(out, "%.4f %.4f\n", log10(r->least_ns) - 9, r->worst);
    }
    text_add(out, "EOD\n");
  }
}

void bench_gnuplot(struct text *out, const struct bench_table *t) {
  text_printf(out,
              "set terminal svg size 900,620 dynamic font 'sans,12' background '#ffffff'\nset output '%s.svg'\n"
              "set title '%s'\nset xlabel 'time of one call, seconds'\nset ylabel 'worst error'\n"
              "set format '10^{%%g}'\nset grid lc '#d0d0d0'\nset key outside right noenhanced\n",
              t->job->id, t->job->title);
  add_data(out, t);
  text_printf(out, "plot %.4f with lines dt 3 lw 2 lc '#404040' title 'inputs rounded to 53 bits'", log10(t->floor));
  for (int k = 0; k < t->job->n_methods; k++) {
    const struct bench_method *m = &t->job->methods[k];
    int n = points_of(t, m);
    if (n == 0) continue;
    text_printf(out, ", \\\n  $m%d with %s lc '%s' pt %d ps 0.8", k, n > 1 ? "linespoints" : "points",
                colours[k % N_COLOURS], k % N_MARKERS + 1);
    if (n > 1) text_printf(out, " dt %d lw 1.2", k % N_DASHES + 1);
    text_printf(out, " title '%s'", m->id);
  }
  text_add(out, "\n");
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
