/* What does not hold as printed, worst first, on a page or two that can be sent to the paper's authors.  One text for
   Markdown and LaTeX; every number in it is one of the result record. */
#include <string.h>

#include "finding.h"
#include "report.h"
#include "sheet.h"

/* Of a longer correction only what changes is shown. */
enum { LONG_FORMULA = 200 };

/* --- Pieces --- */

static void heading(const struct sheet *s, const char *words) {
  text_printf(s->out, s->tex ? "\n\\medskip\\textbf{\\normalsize %s}\\nopagebreak\n\n" : "\n## %s\n", words);
}

static void begin_items(const struct sheet *s) {
  text_add(s->out, s->tex ? "\\begin{itemize}\\setlength{\\itemsep}{0pt}\n" : "\n");
}
static void end_items(const struct sheet *s) {
  if (s->tex) text_add(s->out, "\\end{itemize}\n");
}
static void begin_item(const struct sheet *s) {
  text_add(s->out, s->tex ? "\\item " : "- ");
}
/* The next line of an item. */
static void line(const struct sheet *s) {
  text_add(s->out, s->tex ? "\\\\\n" : "  \n  ");
}

/* Begins a line of an item with a word and a colon. */
static void label(const struct sheet *s, const char *word) {
  line(s);
  text_printf(s->out, s->tex ? "\\emph{%s:} " : "*%s:* ", word);
}

/* What is quoted may end in a stop of its own. */
static void stop(const struct sheet *s) {
  if (s->out->len && s->out->data[s->out->len - 1] != '.') text_add_char(s->out, '.');
}

/* "eq-44b" as (44b), others as they are. */
static void add_claim(const struct sheet *s, const char *id) {
  if (strncmp(id, "eq-", 3) == 0)
    text_printf(s->out, "(%s)", id + 3);
  else
    sheet_code(s, id);
}

static void add_claims(const struct sheet *s, const struct id_list *list) {
  for (int i = 0; i < list->n; i++) {
    text_add(s->out, i ? ", " : "");
    add_claim(s, list->id[i]);
  }
}

/* "appendix_a" as words. */
static void add_section(const struct sheet *s, const char *section) {
  for (; section && *section; section++) text_add_char(s->out, *section == '_' ? ' ' : *section);
}

/* --- One failure --- */

static void add_place(const struct sheet *s, const struct finding *f) {
  text_add(s->out, s->tex ? "\\textbf{" : "**");
  add_claim(s, f->id);
  if (f->section) text_add(s->out, ", section ");
  add_section(s, f->section);
  text_add(s->out, s->tex ? "}" : "**");
  text_add(s->out, ": ");
  sheet_text(s, f->title);
  stop(s);
}

static void add_correction(const struct sheet *s, const struct finding *f) {
  bool whole = !f->change || !f->correction_latex || strlen(f->correction_latex) < LONG_FORMULA;
  if (whole && f->correction_latex)
    sheet_math(s, f->correction_latex);
  else if (whole)
    sheet_text(s, f->correction);
  if (f->change) {
    text_add(s->out, whole ? " (" : "");
    sheet_text(s, f->change);
    text_add(s->out, whole ? ")" : "");
  }
  text_printf(s->out, "; checked in the same way: %s.", verdict_name[f->correction_verdict]);
}

static void add_texts(const struct sheet *s, const struct finding *f) {
  const char *quote = finding_quote(f);
  if (quote) {
    label(s, "Printed");
    sheet_text(s, quote);
  }
  if (!f->correction) return;
  label(s, "Should read");
  add_correction(s, f);
}

/* In plain words, from the class of the fault and what decided. */
static void add_fault(const struct sheet *s, const struct finding *f) {
  const struct evidence *e = failure_evidence(f);
  label(s, "Wrong");
  text_add(s->out, failure_words(f));
  if (e && e->note) {
    text_add(s->out, ": ");
    sheet_text(s, e->note);
  }
  if (f->condition) {
    text_add(s->out, "; proved under the condition ");
    sheet_text(s, f->condition);
  }
  stop(s);
}

/* Findings of the same sentence under a restriction that saves it. */
static void add_restrictions(const struct sheet *s, const struct audit_result *r, const struct finding *f) {
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *o = &r->findings[i];
    if (!finding_restricts(o, f)) continue;
    text_add(s->out, " As printed it holds when ");
    sheet_text(s, o->condition);
    text_printf(s->out, " (%s).", verdict_name[o->verdict]);
  }
}

/* A result that changes, with its example; the point of the example is left to the end of the line. */
static void add_change(const struct sheet *s, const struct derived *d) {
  text_add(s->out, " (");
  if (d->entry) text_printf(s->out, "entry %s: ", d->entry);
  sheet_text(s, d->printed);
  text_add(s->out, " instead of ");
  sheet_text(s, d->corrected);
  text_add_char(s->out, ')');
}

/* The results with one kind of change on one line of the item. */
static void add_derived(const struct sheet *s, const struct consequence *q, enum change change, const char *word) {
  const struct derived *last = NULL;
  for (int i = 0; i < q->n_derived; i++) {
    const struct derived *d = &q->derived[i];
    if (d->change != change) continue;
    if (!last) label(s, word);
    if (last && change == CHANGE_AGREES && strcmp(last->verdict, d->verdict) != 0)
      text_printf(s->out, " (%s)", last->verdict);
    if (last) text_add(s->out, ", ");
    sheet_math(s, d->latex);
    if (change == CHANGE_CHANGES) add_change(s, d);
    last = d;
  }
  if (last && change == CHANGE_AGREES) text_printf(s->out, " (%s)", last->verdict);
  if (last && change == CHANGE_CHANGES) {
    text_add(s->out, "; at ");
    sheet_text(s, last->where);
  }
  if (last) stop(s);
}

static void add_consequence(const struct sheet *s, const struct consequence *q) {
  if (!q) return;
  add_derived(s, q, CHANGE_CHANGES, "Changes");
  add_derived(s, q, CHANGE_UNDEFINED, "Has no meaning with it");
  add_derived(s, q, CHANGE_AGREES, "Keeps its value");
  if (!q->falls.n && !q->survives.n) return;
  label(s, "What rests on it");
  if (q->falls.n) {
    add_claims(s, &q->falls);
    text_add(s->out, q->falls.n == 1 ? " fails with it" : " fail with it");
  }
  if (q->survives.n) {
    text_add(s->out, q->falls.n ? "; " : "");
    add_claims(s, &q->survives);
    text_add(s->out, q->survives.n == 1 ? " holds all the same" : " hold all the same");
  }
  text_add_char(s->out, '.');
}

/* A slip that changes no result, in one paragraph. */
static void add_slip(const struct sheet *s, const struct finding *f) {
  const char *quote = finding_quote(f);
  const struct evidence *e = failure_evidence(f);
  begin_item(s);
  add_place(s, f);
  if (quote) {
    label(s, "Printed");
    sheet_text(s, quote);
  }
  if (f->correction) {
    label(s, "Should read");
    add_correction(s, f);
  } else if (e && e->note) {
    label(s, "Wrong");
    sheet_text(s, e->note);
    stop(s);
  }
  text_add(s->out, s->tex ? "\n" : "\n\n");
}

static void add_failure(const struct sheet *s, const struct audit_result *r, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(r, f->id);
  const char *size = failure_size(r, f);
  const struct finding *first = failure_mended_with(r, f);
  begin_item(s);
  add_place(s, f);
  if (first) {
    line(s);
    text_add(s->out, "The same correction as that of ");
    add_claim(s, first->id);
    text_add(s->out, s->tex ? " mends it.\n" : " mends it.\n\n");
    return;
  }
  add_texts(s, f);
  add_fault(s, f);
  add_restrictions(s, r, f);
  if (size) {
    label(s, "Size");
    sheet_text(s, size);
    stop(s);
  }
  add_consequence(s, q);
  text_add(s->out, s->tex ? "\n" : "\n\n");
}

/* --- The printed numbers in a table --- */

static void add_number(const struct sheet *s, const struct audit_result *r, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(r, f->id);
  const char *cell = s->tex ? " & " : " | ", *sep = "";
  text_add(s->out, s->tex ? "" : "| ");
  sheet_text(s, f->quote ? f->quote : f->id);
  text_add(s->out, cell);
  sheet_math(s, f->correction_latex);
  text_add(s->out, cell);
  const char *size = failure_size(r, f);
  if (size) sheet_text(s, size);
  text_add(s->out, cell);
  for (int i = 0; q && i < q->n_derived; i++) {
    const struct derived *d = &q->derived[i];
    if (d->change != CHANGE_CHANGES) continue;
    text_add(s->out, sep);
    sheet_math(s, d->latex);
    sep = ", ";
  }
  for (int i = 0; q && i < q->falls.n; i++) {
    text_add(s->out, sep);
    add_claim(s, q->falls.id[i]);
    sep = ", ";
  }
  text_add(s->out, s->tex ? " \\\\\n" : " |\n");
}

static void add_numbers(const struct sheet *s, const struct audit_result *r) {
  bool any = false;
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (!finding_fails(f) || !failure_is_number(f)) continue;
    if (!any)
      text_add(s->out,
               s->tex
                   ? "\\begin{tabular}{@{}R{0.2}R{0.13}R{0.28}R{0.31}@{}}\nprinted & nearest solution & "
                     "on the orbit nearest to the printed numbers & goes with it \\\\ \\hline\n"
                   : "\n| printed | nearest solution | on the orbit nearest to the printed numbers | goes with it |\n"
                     "| --- | --- | --- | --- |\n");
    any = true;
    add_number(s, r, f);
  }
  if (any) text_add(s->out, s->tex ? "\\end{tabular}\n\n" : "");
}

/* The table, and where the numbers may have come from. */
static void add_example(const struct sheet *s, const struct audit_result *r) {
  add_numbers(s, r);
  if (!r->readings) return;
  text_add(s->out, s->tex ? "" : "\n");
  for (int i = 0; i < r->readings->n_conclusions; i++) {
    text_add(s->out, i ? " " : "");
    sheet_text(s, r->readings->conclusion[i]);
  }
  text_add(s->out, s->tex ? "\n\n" : "\n");
}

/* --- The page --- */

static void add_grade(const struct sheet *s, const struct audit_result *r, enum grade g) {
  bool any = false, items = false;
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (!finding_fails(f) || failure_grade(r, f) != g) continue;
    if (!any) heading(s, grade_heading[g]);
    if (!any && g == GRADE_NUMBER) add_example(s, r);
    any = true;
    if (failure_is_number(f)) continue;
    if (!items) begin_items(s);
    items = true;
    if (g == GRADE_NOTATION)
      add_slip(s, f);
    else
      add_failure(s, r, f);
  }
  if (items) end_items(s);
}

static size_t failures(const struct audit_result *r) {
  size_t n = 0;
  for (size_t i = 0; i < r->n_findings; i++) n += finding_fails(&r->findings[i]);
  return n;
}

/* The first claim that shares its number with another: how such claims are named. */
static const char *lettered(const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++) {
    const char *id = r->findings[i].id, *end = id + strlen(id);
    if (strncmp(id, "eq-", 3) == 0 && end > id + 3 && end[-1] >= 'a' && end[-1] <= 'z') return id;
  }
  return NULL;
}

static void add_opening(const struct sheet *s, const struct audit_result *r) {
  const char *id = lettered(r);
  text_add(s->out, s->tex ? "\\section*{Errata}\n" : "# Errata\n\n");
  text_add(s->out, "Scene ");
  sheet_code(s, r->scene);
  text_add(s->out, ": ");
  sheet_text(s, r->title ? r->title : "-");
  text_add(s->out, ". ");
  text_printf(s->out, "%zu of %zu statements do not hold as printed, worst first. ", failures(r), r->n_findings);
  text_add(s->out, "Each was judged as printed with all that it uses corrected; what is said to change was evaluated "
                   "with this one formula as printed and everything else corrected. Examples are at exact "
                   "parameters, so that both sides can be evaluated there by anybody: left is the paper's formula "
                   "or the left side of its equation, right what the equations of motion give or the right side. The "
                   "text judged is a machine "
                   "conversion of the printed page: a slip of one symbol can be the conversion's.");
  if (id) {
    text_add(s->out, " A letter after a number tells apart what is said under that number: ");
    add_claim(s, id);
    text_add(s->out, " is ");
    sheet_code(s, id);
    text_add(s->out, " in ");
    sheet_code(s, "audit.md");
    text_add_char(s->out, '.');
  }
  text_add_char(s->out, '\n');
}

/* What a claim that asserts nothing states about the paper's data; once where two layers state the same. */
static void add_statement(const struct sheet *s, const struct finding *f) {
  const char *last = "";
  begin_item(s);
  add_place(s, f);
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    if (strcmp(e->result, "states") != 0 || !e->note || strcmp(e->note, last) == 0) continue;
    last = e->note;
    label(s, "Computed");
    if (e->worst) {
      sheet_text(s, e->worst);
      text_add(s->out, ": ");
    }
    sheet_text(s, e->note);
    stop(s);
  }
  text_add(s->out, s->tex ? "\n" : "\n\n");
}

static void add_statements(const struct sheet *s, const struct audit_result *r) {
  bool any = false;
  for (size_t i = 0; i < r->n_findings; i++) {
    if (!finding_states(&r->findings[i])) continue;
    if (!any) {
      heading(s, "What the paper does not say");
      begin_items(s);
    }
    any = true;
    add_statement(s, &r->findings[i]);
  }
  if (any) end_items(s);
}

static void add_closing(const struct sheet *s, const struct audit_result *r) {
  long count[N_VERDICTS], total = audit_result_count(count, r, OF_PAPER);
  heading(s, "What was checked and holds");
  text_printf(s->out,
              "%sOf %ld statements %ld are proved, %ld supported (at every point tried, by at least two routes that do "
              "not share their reasoning) and %ld assert nothing",
              s->tex ? "" : "\n", total, count[VERDICT_PROVED], count[VERDICT_SUPPORTED], count[VERDICT_DEFINITION]);
  if (count[VERDICT_UNKNOWN])
    text_printf(s->out, "; %ld %s undecided", count[VERDICT_UNKNOWN], count[VERDICT_UNKNOWN] == 1 ? "is" : "are");
  if (count[VERDICT_SKIPPED]) text_printf(s->out, "; %ld were not possible here", count[VERDICT_SKIPPED]);
  text_add(s->out, ". ");
  text_printf(s->out, "Of %zu statements made wrong on purpose %zu were noticed. ", r->n_controls, controls_noticed(r));
  for (size_t i = 0; i < r->n_skipped; i++) {
    text_add(s->out, i ? "; left out: " : "Left out: ");
    sheet_text(s, r->skipped[i].what);
    text_add(s->out, ", ");
    sheet_text(s, r->skipped[i].why);
    if (i + 1 == r->n_skipped) text_add(s->out, ". ");
  }
  text_add(s->out, "This page is written by ");
  struct text command;
  text_init(&command);
  text_printf(&command, "stickslip verify %s", r->scene);
  sheet_code(s, text_str(&command));
  text_add(s->out, "; with ");
  sheet_code(s, "--only ID");
  text_add(s->out, " a single statement is judged again, and ");
  sheet_code(s, "audit.md");
  text_add(s->out, " beside this page holds all the evidence.\n");
  text_clear(&command);
}

static void write_sheet(const struct sheet *s, const struct audit_result *r) {
  add_opening(s, r);
  for (int g = 0; g < N_GRADES; g++) add_grade(s, r, (enum grade)g);
  add_statements(s, r);
  add_closing(s, r);
}

void report_errata(struct text *out, const struct audit_result *r) {
  struct sheet s = {out, false};
  write_sheet(&s, r);
}

void report_errata_tex(struct text *out, const struct audit_result *r) {
  struct sheet s = {out, true};
  text_add(out,
           "\\documentclass[10pt]{article}\n\\usepackage[a4paper,margin=18mm]{geometry}\n\\usepackage{amsmath,array}\n"
           "\\newcolumntype{R}[1]{>{\\raggedright\\arraybackslash}p{#1\\textwidth}}\n"
           "\\setlength{\\parindent}{0pt}\n\\pagestyle{empty}\n"
           "\\makeatletter\\@beginparpenalty=10000\\makeatother\n\\begin{document}\n\\raggedright\\small\n");
  write_sheet(&s, r);
  text_add(out, "\\end{document}\n");
}
