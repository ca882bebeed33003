/* What verify says at its end: what fails and why it matters, the verdicts by section, and the one line of the
   contract. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "report/report.h"

static enum paint paint_of(enum verdict v) {
  switch (v) {
  case VERDICT_PROVED:
  case VERDICT_SUPPORTED:
    return PAINT_GOOD;
  case VERDICT_REFUTED:
  case VERDICT_CONDITIONAL:
    return PAINT_BAD;
  case VERDICT_UNKNOWN:
    return PAINT_DOUBT;
  default:
    return PAINT_NONE;
  }
}

static bool needs_attention(const struct finding *f) {
  return verdict_fails(f->verdict) || f->verdict == VERDICT_UNKNOWN;
}

/* A title that begins in that column, broken at blanks where the terminal ends; no width, no break. */
static void add_wrapped(struct text *out, const char *s, int column, int width) {
  int at = column;
  while (*s) {
    int word = (int)strcspn(s, " ");
    if (width > column + 20 && at > column && at + 1 + word > width) {
      text_printf(out, "\n%*s", column, "");
      at = column;
    } else if (at > column) {
      text_add_char(out, ' ');
      at++;
    }
    text_add_n(out, s, (size_t)word);
    at += word;
    s += word;
    while (*s == ' ') s++;
  }
}

static void add_failures(struct text *out, const struct audit_result *r, bool colours) {
  size_t widest = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    size_t n = strlen(r->findings[i].id);
    if (needs_attention(&r->findings[i]) && n > widest) widest = n;
  }
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (!needs_attention(f)) continue;
    paint(out, colours, paint_of(f->verdict), verdict_name[f->verdict], -11);
    text_printf(out, " %-*s ", (int)widest, f->id);
    add_wrapped(out, f->title, (int)widest + 13, terminal_width());
    text_add_char(out, '\n');
  }
}

/* --- Verdicts by section --- */

static const char *section_of(const struct finding *f) {
  return f->section ? f->section : "-";
}

static bool begins_section(const struct audit_result *r, size_t i) {
  for (size_t k = 0; k < i; k++)
    if (strcmp(section_of(&r->findings[k]), section_of(&r->findings[i])) == 0) return false;
  return true;
}

static int column(enum verdict v) {
  int n = (int)strlen(verdict_name[v]);
  return n + 2;
}

/* A row of counts, those of a section or, with NULL, of all; a count of nothing is a dot. */
static void add_row(struct text *out, const struct audit_result *r, const char *section, const long shown[N_VERDICTS],
                    bool colours) {
  long count[N_VERDICTS] = {0}, all = 0;
  char cell[24];
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    bool mine = !section || strcmp(section_of(f), section) == 0;
    count[f->verdict] += mine;
    all += mine;
  }
  paint(out, colours, section ? PAINT_NONE : PAINT_HEAD, section ? section : "all", -12);
  for (int v = 0; v < N_VERDICTS; v++) {
    if (!shown[v]) continue;
    snprintf(cell, sizeof cell, "%ld", count[v]);
    paint(out, colours, count[v] ? paint_of((enum verdict)v) : PAINT_NONE, count[v] ? cell : ".",
          column((enum verdict)v));
  }
  text_printf(out, "%7ld\n", all);
}

static void add_sections(struct text *out, const struct audit_result *r, bool colours) {
  long shown[N_VERDICTS] = {0};
  for (size_t i = 0; i < r->n_findings; i++) shown[r->findings[i].verdict]++;
  paint(out, colours, PAINT_HEAD, "section", -12);
  for (int v = 0; v < N_VERDICTS; v++)
    if (shown[v]) paint(out, colours, PAINT_HEAD, verdict_name[v], column((enum verdict)v));
  paint(out, colours, PAINT_HEAD, "all", 7);
  text_add_char(out, '\n');
  for (size_t i = 0; i < r->n_findings; i++)
    if (begins_section(r, i)) add_row(out, r, section_of(&r->findings[i]), shown, colours);
  add_row(out, r, NULL, shown, colours);
}

void verify_tables(const struct audit_result *r) {
  struct text out;
  bool colours = terminal_has_colours();
  text_init(&out);
  add_failures(&out, r, colours);
  text_add(&out, out.len ? "\n" : "");
  if (r->n_findings) add_sections(&out, r, colours);
  text_add_char(&out, '\n');
  fputs(text_str(&out), stdout);
  text_clear(&out);
}

void verify_line(const struct audit_result *r) {
  struct text out, line;
  text_init(&out);
  text_init(&line);
  report_line(&line, r);
  paint(&out, terminal_has_colours(), audit_result_unexpected(r) ? PAINT_BAD : PAINT_HEAD, text_str(&line), 0);
  puts(text_str(&out));
  text_clear(&line);
  text_clear(&out);
}
