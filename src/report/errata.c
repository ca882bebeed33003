/* The errata of the paper as a sheet that can be sent to its authors: a page of what changes a result, in order of
   consequence, a page of remarks and slips of notation, and behind them the numbers.  One text for Markdown and LaTeX;
   its sentences are those of the roots, its numbers those of the result record. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "report.h"
#include "sheet.h"

/* --- Pieces --- */

static bool is_tex(const struct sheet *s) {
  return s->dialect == DIALECT_TEX;
}

static void heading(const struct sheet *s, const char *words) {
  text_printf(s->out, is_tex(s) ? "\n\\medskip\\textbf{\\normalsize %s}\\nopagebreak\n\n" : "\n## %s\n\n", words);
}
static void begin_items(const struct sheet *s, bool counted) {
  if (is_tex(s)) text_printf(s->out, "\\begin{%s}\\setlength{\\itemsep}{2pt}\n", counted ? "enumerate" : "itemize");
}
static void end_items(const struct sheet *s, bool counted) {
  if (is_tex(s)) text_printf(s->out, "\\end{%s}\n", counted ? "enumerate" : "itemize");
}
/* Number 0: an item of a list that is not counted. */
static void begin_item(const struct sheet *s, int number) {
  if (is_tex(s))
    text_add(s->out, "\\item ");
  else if (number)
    text_printf(s->out, "%d. ", number);
  else
    text_add(s->out, "- ");
}
static void end_item(const struct sheet *s) {
  text_add(s->out, is_tex(s) ? "\n" : "\n\n");
}
/* A word and a colon, on a line of its own, but for slips, which take little room. */
static void label(const struct sheet *s, enum severity severity, const char *word) {
  if (severity == SEVERITY_NOTATION) {
    sheet_stop(s);
    text_add_char(s->out, ' ');
  } else {
    text_add(s->out, is_tex(s) ? "\\\\\n" : "  \n   ");
  }
  sheet_add(s, is_tex(s) ? "\\emph{%s:} " : "*%s:* ", word);
}
static void strong(const struct sheet *s, const char *words) {
  sheet_add(s, is_tex(s) ? "\\textbf{%t}" : "**%t**", words);
}

/* --- The first two pages --- */

/* Whether the text, or the formula that it is, stands in the other. */
static bool is_part_of(const char *quote, const char *other) {
  size_t n = strlen(quote);
  if (n && quote[n - 1] == '$') n--;
  for (; *other; other++)
    if (strncmp(other, quote, n) == 0) return true;
  return false;
}

/* The text of the paper that the root is about, each piece once; enough of it to find the place. */
static void add_printed(const struct sheet *s, const struct audit_result *r, const struct root_cause *root) {
  enum { ENOUGH = 150 };
  const char *last = "";
  size_t begin = s->out->len;
  for (int i = 0; i < root->n_claims && s->out->len - begin < ENOUGH; i++) {
    const struct finding *f = audit_result_finding(r, root->claims[i]);
    const char *quote = f && f->of == OF_PAPER ? finding_quote(f) : NULL;
    if (!quote || is_part_of(quote, last) || failure_is_number(f)) continue;
    if (!*last)
      label(s, root->severity, "Printed");
    else
      text_add(s->out, is_tex(s) ? " \\dots\\ " : " ... ");
    sheet_text(s, quote);
    last = quote;
  }
}

/* Whether each correction of its claims is proved, or holds at all points. */
static bool mends_all(const struct audit_result *r, const struct root_cause *root) {
  bool all = true;
  for (int i = 0; i < root->n_claims; i++) {
    const struct finding *f = audit_result_finding(r, root->claims[i]);
    all = all && (!f || !f->correction || verdict_passes(f->correction_verdict));
  }
  return all;
}

static const char doubt[] = " (which is not proved)";

static void add_root(const struct sheet *s, const struct audit_result *r, const struct root_cause *root, int number) {
  begin_item(s, number);
  strong(s, root->where);
  sheet_add(s, ": %t%.", root->title);
  add_printed(s, r, root);
  label(s, root->severity, severity_correction[root->severity]);
  sheet_values(s, r, root);
  sheet_text(s, root->correct);
  if (!mends_all(r, root)) text_add(s->out, doubt);
  label(s, root->severity, "Reason");
  sheet_text(s, root->wrong);
  if (root->by_hand) sheet_add(s, is_tex(s) ? " \\emph{To see it:} %t" : " *To see it:* %t", root->by_hand);
  if (root->severity != SEVERITY_NOTATION) {
    label(s, root->severity, "Consequence");
    sheet_text(s, root->consequence);
  }
  end_item(s);
}

static void add_roots(const struct sheet *s, const struct audit_result *r, enum severity severity) {
  bool counted = severity == SEVERITY_SUBSTANCE;
  int n = 0;
  for (size_t i = 0; i < r->n_roots; i++) {
    if (r->roots[i].severity != severity) continue;
    if (n++ == 0) {
      heading(s, severity_heading[severity]);
      begin_items(s, counted);
    }
    add_root(s, r, &r->roots[i], counted ? n : 0);
  }
  if (n) end_items(s, counted);
}

static void add_opening(const struct sheet *s, const struct audit_result *r) {
  size_t substance = audit_result_roots(r, SEVERITY_SUBSTANCE), slips = r->n_roots - substance;
  text_add(s->out, is_tex(s) ? "\\section*{Errata}\n" : "# Errata\n\n");
  if (r->paper) sheet_add(s, is_tex(s) ? "\\emph{%t}\n\n" : "*%t*\n\n", r->paper);
  OWNED(text) data = {0};
  audit_data(&data, r);
  sheet_prose(s, text_str(&data));
  text_add(s->out, data.len ? " " : "");
  text_printf(s->out, "%s ", audit_method(r));
  if (r->paper_source) sheet_add(s, "%t ", r->paper_source);
  if (substance == 1) text_add(s->out, "The first point affects results. ");
  if (substance > 1)
    text_printf(
        s->out,
        "The first %zu points affect results, for the data that they name; they are given in order of consequence. ",
        substance);
  if (slips == 1) text_add(s->out, "One point concerns a gap in an argument, an exceptional case or the wording. ");
  if (slips > 1)
    text_printf(s->out,
                "The %zu remarks and slips of notation that follow concern gaps in an argument, exceptional cases or "
                "the wording. ",
                slips);
  long count[N_VERDICTS], total = audit_result_count(count, r, OF_PAPER);
  if (r->n_roots)
    text_add(s->out, "Numerical values and counterexamples are collected at the end.");
  else if (total && !count[VERDICT_REFUTED] && !count[VERDICT_CONDITIONAL])
    text_add(s->out, "No error was found.");
  text_add_char(s->out, '\n');
}

/* --- The numbers behind them --- */

static void add_number(const struct sheet *s, const struct finding *f) {
  sheet_add(s, is_tex(s) ? "%m & %m \\\\\n" : "| %m | %m |\n", f->printed ? f->printed : f->id, f->correction_latex);
}

/* The printed numbers with the right ones; of other data than the example's there are none. */
static bool add_numbers(const struct sheet *s, const struct audit_result *r) {
  bool any = false;
  for (size_t i = 0; !r->data && i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (!finding_fails(f) || !failure_is_number(f)) continue;
    if (!any) {
      heading(s, "The numerical example");
      text_add(s->out, is_tex(s) ? "\\begin{tabular}{@{}ll@{}}\nprinted & nearest periodic solution \\\\ \\hline\n"
                                 : "| printed | nearest periodic solution |\n| --- | --- |\n");
    }
    any = true;
    add_number(s, f);
  }
  if (any) text_add(s->out, is_tex(s) ? "\\end{tabular}\n\n" : "\n");
  return any;
}

/* What else fails with the numbers: how far, and what decided it. */
static void add_effects(const struct sheet *s, const struct audit_result *r) {
  const struct root_cause *root = audit_root_of_numbers(r);
  for (int i = 0; root && i < root->n_claims; i++) {
    const struct finding *f = audit_result_finding(r, root->claims[i]);
    if (!f || failure_is_number(f) || !f->effect) continue;
    const struct evidence *e = failure_evidence(f);
    sheet_sentence(s, f->effect);
    text_add_char(s->out, ' ');
    if (e && e->note) sheet_sentence(s, e->note);
    text_add(s->out, "\n\n");
  }
}

/* Without the numbers that orbits have in lists, which the sheet does not show: states and times tell them. */
static const char *unnumbered(struct text *t, const char *s) {
  static const char number[] = ", orbit ";
  for (const char *at; (at = strstr(s, number)) != NULL; s = at + strspn(at, "0123456789")) {
    text_add_n(t, s, (size_t)(at - s));
    at += sizeof number - 1;
  }
  text_add(t, s);
  return text_str(t);
}

/* A result that changes, with its example. */
static void add_derived(const struct sheet *s, const struct consequence *q) {
  const struct derived *last = NULL;
  for (const struct derived *d = NULL; (d = derived_next(q, d, CHANGE_CHANGES)) != NULL; last = d) {
    text_add(s->out, last ? ", and " : "As printed, ");
    if (d->entry) sheet_add(s, "the entry %s of ", d->entry);
    sheet_add(s, "%m is %p instead of %p", d->latex, d->printed, d->corrected);
  }
  OWNED(text) where = {0};
  if (last) sheet_add(s, " for %p%.", unnumbered(&where, last->where));
}

static bool has_change(const struct consequence *q) {
  return q && (q->solved || derived_next(q, NULL, CHANGE_CHANGES));
}

/* Whether the note is an example that can be computed again: the certificate has an orbit, whose data it names. */
static bool is_example(const struct finding *f, const char *note) {
  OWNED(text) t = {0};
  finding_orbit(&t, f);
  if (t.len == 0) return false;
  text_reset(&t);
  text_printf(&t, "%s = %s", f->certificate.at[0].name, f->certificate.at[0].value);
  return strstr(note, text_str(&t)) != NULL;
}

/* The claim that shows the root: by an effect that was computed or by what decided it, if it is a remark by an example;
   NULL for the numbers, which have a section of their own. */
static const struct finding *shown_by(const struct audit_result *r, const struct root_cause *root) {
  if (root->severity == SEVERITY_NOTATION || root == audit_root_of_numbers(r)) return NULL;
  for (int i = 0; i < root->n_claims; i++) {
    const struct finding *f = audit_result_finding(r, root->claims[i]);
    const struct evidence *e = f ? failure_evidence(f) : NULL;
    bool noted = e && e->note;
    if (root->severity == SEVERITY_SUBSTANCE ? noted || (f && has_change(audit_result_consequence(r, f->id)))
                                             : noted && is_example(f, e->note))
      return f;
  }
  return NULL;
}

static void add_evidence(const struct sheet *s, const struct audit_result *r, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(r, f->id);
  if (has_change(q) && !q->solved) {
    add_derived(s, q);
    return;
  }
  OWNED(text) t = {0}, orbit = {0};
  const char *note = has_change(q) ? q->solved : failure_evidence(f)->note, *effect = has_change(q) ? NULL : f->effect;
  sheet_sentence(s, unnumbered(&t, note));
  if (is_example(f, note)) finding_orbit(&orbit, f);
  if (orbit.len) sheet_add(s, " The solution computed has %p.", text_str(&orbit));
  if (effect) text_add_char(s->out, ' ');
  if (effect) sheet_sentence(s, effect);
}

static void add_evidences(const struct sheet *s, const struct audit_result *r) {
  bool any = false;
  for (size_t i = 0; i < r->n_roots; i++) {
    const struct finding *f = shown_by(r, &r->roots[i]);
    if (!f) continue;
    if (!any) {
      heading(s, "Effects and counterexamples");
      if (r->model)
        text_add(s->out, "A periodic solution is called admissible if every condition of the motion holds on it for "
                         "suitable static friction, so that the masses can follow it.\n\n");
      begin_items(s, false);
    }
    any = true;
    begin_item(s, 0);
    strong(s, r->roots[i].title);
    text_add(s->out, ": ");
    add_evidence(s, r, f);
    end_item(s);
  }
  if (any) end_items(s, false);
}

/* What does not hold and stands at no root, as long as nobody has written down what is wrong. */
static void add_rootless(const struct sheet *s, const struct audit_result *r) {
  bool any = false;
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (f->of != OF_PAPER || f->root || !finding_fails(f)) continue;
    const struct evidence *e = failure_evidence(f);
    if (!any) {
      heading(s, r->n_roots ? "What else does not hold" : "What does not hold");
      begin_items(s, false);
    }
    any = true;
    begin_item(s, 0);
    strong(s, f->id);
    sheet_add(s, ": %t%p.", failure_heading(f), f->title);
    if (f->correction_latex && f->correction_verdict != VERDICT_REFUTED)
      sheet_add(s, " It should read %m%t.", f->correction_latex, verdict_passes(f->correction_verdict) ? "" : doubt);
    if (e && e->note) text_add_char(s->out, ' ');
    if (e && e->note) sheet_sentence(s, e->note);
    end_item(s);
  }
  if (any) end_items(s, false);
}

static void add_verdicts(const struct sheet *s, const struct audit_result *r) {
  enum { MOST_NAMED = 3 };
  long count[N_VERDICTS];
  audit_result_count(count, r, OF_PAPER);
  verdicts_say(s->out, r);
  const char *before = " (";
  for (size_t i = 0; count[VERDICT_UNKNOWN] <= MOST_NAMED && i < r->n_findings; i++) {
    if (r->findings[i].of != OF_PAPER || r->findings[i].verdict != VERDICT_UNKNOWN) continue;
    sheet_add(s, "%s%p", before, r->findings[i].title);
    before = "; ";
  }
  if (*before == ';') text_add_char(s->out, ')');
}

static void add_closing(const struct sheet *s, const struct audit_result *r) {
  heading(s, "What was compared");
  add_verdicts(s, r);
  text_printf(s->out, ". %sThis sheet was generated by ",
              r->n_roots ? "The corrected formulas were checked in the same way as the printed ones. " : "");
  OWNED(text) command = {0};
  audit_recheck(&command, r);
  sheet_add(s, "%c, whose report contains the evidence.\n", text_str(&command));
}

static void write_sheet(const struct sheet *s, const struct audit_result *r) {
  add_opening(s, r);
  for (int i = 0; i < N_SEVERITIES; i++) add_roots(s, r, (enum severity)i);
  if (add_numbers(s, r)) {
    add_effects(s, r);
    const struct example_reading *e = best_reading(r);
    if (e && e->n_dropped) reading_say(s, e);
    if (e && e->n_dropped) text_add(s->out, "\n\n");
  }
  add_evidences(s, r);
  add_rootless(s, r);
  add_closing(s, r);
}

void report_errata(struct text *out, const struct audit_result *r) {
  const struct sheet s = {out, DIALECT_MARKDOWN};
  size_t begin = out->len;
  write_sheet(&s, r);
  escape_tags(out, begin);
}

void report_errata_tex(struct text *out, const struct audit_result *r) {
  const struct sheet s = {out, DIALECT_TEX};
  text_add(out, "\\documentclass[10pt]{article}\n\\usepackage[a4paper,margin=15mm]{geometry}\n\\usepackage{amsmath,"
                "amssymb,array}\n"
                "\\setlength{\\parindent}{0pt}\n\\pagestyle{empty}\n"
                "\\begin{document}\n\\raggedright\\small\n");
  write_sheet(&s, r);
  text_add(out, "\\end{document}\n");
}
