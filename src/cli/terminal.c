/* What a terminal is given besides plain text: colours, where it has them and nobody asked for none (no-color.org). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"

/* ANSI's: bold alone for what needs no colour. */
static const char *const code[] = {
    [PAINT_NONE] = NULL, [PAINT_GOOD] = "32", [PAINT_BAD] = "1;31", [PAINT_DOUBT] = "33", [PAINT_HEAD] = "1"};

bool terminal_has_colours(void) {
  const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
  if (no_color && *no_color) return false;
  return isatty(STDOUT_FILENO) && term && *term && strcmp(term, "dumb") != 0;
}

int terminal_width(void) {
  struct winsize size;
  return isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

/* --- Progress --- */

static struct timespec began, shown;

static double since(const struct timespec *then) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)(now.tv_sec - then->tv_sec) + 1e-9 * (double)(now.tv_nsec - then->tv_nsec);
}

bool progress_wanted(void) {
  return isatty(STDERR_FILENO);
}

void progress_begin(void) {
  clock_gettime(CLOCK_MONOTONIC, &began);
  shown = (struct timespec){0, 0};
}

void progress_show(size_t done, size_t of, double share) {
  const double often = 0.1, least = 0.02, settled = 0.2; /* seconds, a part of the work, seconds */
  double taken = since(&began);
  if (!progress_wanted() || since(&shown) < often) return;
  clock_gettime(CLOCK_MONOTONIC, &shown);
  fprintf(stderr, "\r\033[K[%zu/%zu]", done, of);
  if (share < least || taken < settled) return;
  long rest = (long)ceil(taken * (1 - share) / share);
  if (rest < 60)
    fprintf(stderr, " about %ld s left", rest);
  else
    fprintf(stderr, " about %ld:%02ld:%02ld left", rest / 3600, rest / 60 % 60, rest % 60);
}

void progress_count(size_t done, size_t of) {
  progress_show(done, of, of ? (double)done / (double)of : 0);
}

void progress_end(void) {
  if (progress_wanted()) fputs("\r\033[K", stderr);
}

/* --- Lines --- */

/* Where a line that is too long goes on: under its last column, which stands behind two blanks, or two blanks further
   in. */
static size_t hanging(const char *line, size_t len, size_t width) {
  size_t lead = strspn(line, " "), at = lead + 2;
  for (size_t i = lead; i + 2 < len && i + 2 <= width * 2 / 3; i++)
    if (line[i] == ' ' && line[i + 1] == ' ' && line[i + 2] != ' ') at = i + 2;
  return at;
}

void text_fit(struct text *out, const char *line, size_t len, size_t used, size_t width, size_t indent) {
  while (used + len > width) {
    size_t cut = width - used, least = used ? 1 : indent + 1;
    while (cut > least && line[cut] != ' ') cut--;
    if (cut <= least) /* no blank so far: the next one */
      for (cut = width - used; cut < len && line[cut] != ' ';) cut++;
    if (cut >= len) break;
    size_t end = cut;
    while (end > 0 && line[end - 1] == ' ') end--;
    text_add_n(out, line, end);
    text_printf(out, "\n%*s", (int)indent, "");
    while (cut < len && line[cut] == ' ') cut++;
    line += cut;
    len -= cut;
    used = indent;
  }
  text_add_n(out, line, len);
}

/* Lines broken where the terminal ends; as they are where there is none. */
static void fit_terminal(struct text *out, const char *s) {
  enum { NARROWEST = 40 };
  int width = terminal_width();
  if (width < NARROWEST) text_add(out, s);
  for (size_t len; width >= NARROWEST && *s; s += len + (s[len] == '\n')) {
    len = strcspn(s, "\n");
    text_fit(out, s, len, 0, (size_t)width, hanging(s, len, (size_t)width));
    if (s[len]) text_add_char(out, '\n');
  }
}

void print_text(struct text *t) {
  fputs(text_str(t), stdout);
  text_clear(t);
}

void terminal_print(struct text *t) {
  struct text out = {0};
  fit_terminal(&out, text_str(t));
  print_text(&out);
  text_clear(t);
}

void print_found(const struct options *o, struct text *found) {
  (option(o, OPT_JSON) ? print_text : terminal_print)(found);
}

void terminal_print_marked(const char *s) {
  static const enum paint painted[] = {[EXPLAIN_PLAIN] = PAINT_NONE,
                                       [EXPLAIN_GOOD] = PAINT_GOOD,
                                       [EXPLAIN_BAD] = PAINT_BAD,
                                       [EXPLAIN_DOUBT] = PAINT_DOUBT};
  static const char marks[] = {EXPLAIN_PLAIN, EXPLAIN_GOOD, EXPLAIN_BAD, EXPLAIN_DOUBT, '\0'};
  struct text out = {0};
  OWNED(text) fitted = {0}, word = {0};
  bool colours = terminal_has_colours();
  fit_terminal(&fitted, s);
  for (const char *p = text_str(&fitted); *p;) {
    size_t plain = strcspn(p, marks);
    text_add_n(&out, p, plain);
    p += plain;
    if (!*p) break;
    size_t len = strcspn(p + 1, (const char[]){EXPLAIN_END, '\0'});
    text_reset(&word);
    text_add_n(&word, p + 1, len);
    paint(&out, colours, painted[(int)*p], text_str(&word), 0);
    p += 1 + len + (p[1 + len] == EXPLAIN_END);
  }
  print_text(&out);
}

void paint(struct text *out, bool colours, enum paint p, const char *word, int width) {
  int n = (int)strlen(word), right = width > n ? width - n : 0, left = -width > n ? -width - n : 0;
  text_printf(out, "%*s", right, "");
  if (colours && code[p])
    text_printf(out, "\033[%sm%s\033[0m", code[p], word);
  else
    text_add(out, word);
  text_printf(out, "%*s", left, "");
}
