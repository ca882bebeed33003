/* What verify says at its end: what fails, worst first, and what shows it, the verdicts by section, and the one line of
   the contract. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "report/finding.h"
#include "report/name_list.h"
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

/* The rest of a line, from that column on, broken where the terminal ends; no width beside the column, no break. */
static void add_rest(struct text *out, const char *s, size_t column) {
  size_t width = (size_t)terminal_width();
  text_fit(out, s, strlen(s), column, width > column + 20 ? width : SIZE_MAX, column);
  text_add_char(out, '\n');
}

/* In the order of the roots, which is that of consequence, then what has none, what is unknown last. */
static size_t rank_of(const struct audit_result *r, const struct finding *f) {
  const struct root_cause *root = f->root ? audit_result_root(r, f->root) : NULL;
  return root ? (size_t)(root - r->roots) : r->n_roots + (f->verdict == VERDICT_UNKNOWN);
}

static void add_labelled(struct text *out, int column, const char *label, const char *s) {
  enum { LABEL = 12 };
  text_printf(out, "%*s%-*s", column, "", LABEL, label);
  add_rest(out, s, (size_t)column + LABEL);
}

/* Why nothing decides it. */
static const char *open_words(const struct finding *f) {
  const char *why = "nothing decides it";
  for (int i = 0; i < f->n_evidence; i++)
    if (strcmp(f->evidence[i].result, "states") == 0 && f->evidence[i].note) why = f->evidence[i].note;
  return why;
}

/* What shows the failure, and what mends it. */
static void add_proof(struct text *out, const struct audit_result *r, const struct finding *f, int column) {
  OWNED(text) t = {0};
  const bool fails = finding_fails(f);
  add_labelled(out, column, fails ? "wrong" : "open", fails ? failure_words(r, f) : open_words(f));
  if (f->verdict == VERDICT_CONDITIONAL) add_labelled(out, column, "holds when", f->condition);
  for (int i = 0; i < f->certificate.n; i++)
    text_printf(&t, "%s%s = %s", i ? ", " : "", f->certificate.at[i].name, f->certificate.at[i].value);
  if (t.len) add_labelled(out, column, "certificate", text_str(&t));
  text_reset(&t);
  if (f->correction) text_printf(&t, "%s (%s)", f->correction, verdict_name[f->correction_verdict]);
  if (t.len) add_labelled(out, column, "correction", text_str(&t));
}

static void add_failure(struct text *out, const struct audit_result *r, const struct finding *f, size_t widest,
                        bool colours, bool proofs) {
  size_t column = widest + 13;
  paint(out, colours, paint_of(f->verdict), verdict_name[f->verdict], -11);
  text_printf(out, " %-*s ", (int)widest, f->id);
  add_rest(out, f->title, column);
  if (proofs) add_proof(out, r, f, (int)column);
}

static void add_failures(struct text *out, const struct audit_result *r, bool colours, bool proofs) {
  size_t widest = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    size_t n = strlen(r->findings[i].id);
    if (needs_attention(&r->findings[i]) && n > widest) widest = n;
  }
  for (size_t rank = 0; rank <= r->n_roots + 1; rank++)
    for (size_t i = 0; i < r->n_findings; i++)
      if (needs_attention(&r->findings[i]) && rank_of(r, &r->findings[i]) == rank)
        add_failure(out, r, &r->findings[i], widest, colours, proofs);
}

/* --- Verdicts by section --- */

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
    bool mine = !section || strcmp(or_dash(f->section), section) == 0;
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
  struct names sections = {.n = 0};
  for (size_t i = 0; i < r->n_findings; i++) {
    shown[r->findings[i].verdict]++;
    names_index(&sections, or_dash(r->findings[i].section));
  }
  paint(out, colours, PAINT_HEAD, "section", -12);
  for (int v = 0; v < N_VERDICTS; v++)
    if (shown[v]) paint(out, colours, PAINT_HEAD, verdict_name[v], column((enum verdict)v));
  paint(out, colours, PAINT_HEAD, "all", 7);
  text_add_char(out, '\n');
  for (size_t i = 0; i < sections.n; i++) add_row(out, r, sections.name[i], shown, colours);
  add_row(out, r, NULL, shown, colours);
  free(sections.name);
}

void verify_tables(const struct audit_result *r, bool proofs) {
  struct text out = {0};
  bool colours = terminal_has_colours();
  add_failures(&out, r, colours, proofs);
  text_add(&out, out.len ? "\n" : "");
  if (r->n_findings) add_sections(&out, r, colours);
  text_add_char(&out, '\n');
  print_text(&out);
}

void verify_line(const struct audit_result *r) {
  OWNED(text) out = {0}, line = {0};
  report_line(&line, r);
  paint(&out, terminal_has_colours(), audit_result_unexpected(r) ? PAINT_BAD : PAINT_HEAD, text_str(&line), 0);
  puts(text_str(&out));
}
