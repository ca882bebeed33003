/* What needs attention, worst first: the paper's own text beside the corrected one, what is wrong with it and how large
   it is, a certificate, what depends on it, and how to recheck it. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "escape.h"
#include "finding.h"
#include "formula.h"
#include "html.h"
#include "sections.h"

/* --- Rows of a description --- */

static void begin_row(const struct page *p, const char *word) {
  text_printf(p->out, "<dt>%s</dt>\n<dd>", word);
}
static void end_row(const struct page *p) {
  text_add(p->out, "</dd>\n");
}

static bool *new_marks(const char *s) {
  size_t n = strlen(s) + 1;
  bool *marks = ss_malloc(n * sizeof *marks);
  memset(marks, 0, n * sizeof *marks);
  return marks;
}

/* --- Printed beside corrected --- */

struct texts {
  const char *quote, *printed, *corrected;
  bool *in_quote, *in_printed, *in_corrected; /* NULL where nothing is marked */
};

static void find_changes(struct texts *t) {
  if (!t->printed || !t->corrected) return;
  t->in_printed = new_marks(t->printed);
  t->in_corrected = new_marks(t->corrected);
  formula_changes(t->in_printed, t->printed, t->in_corrected, t->corrected);
  if (!t->quote) return;
  t->in_quote = new_marks(t->quote);
  formula_changes_in_text(t->in_quote, t->quote, t->printed, t->in_printed);
}

static void texts_clear(struct texts *t) {
  free(t->in_quote);
  free(t->in_printed);
  free(t->in_corrected);
}

static void begin_side(const struct page *p, const char *word) {
  text_printf(p->out, "<div><dt>%s</dt>\n<dd class=\"tex\">", word);
}
static void end_side(const struct page *p) {
  text_add(p->out, "</dd></div>\n");
}

static void add_correction(const struct page *p, const struct finding *f, const struct texts *t) {
  begin_side(p, "Should read");
  if (t->corrected)
    html_math(p->out, t->corrected, t->in_corrected);
  else
    html_text(p->out, f->correction, NULL);
  text_add(p->out, "<p class=\"note\">");
  if (f->change) {
    html_text(p->out, f->change, NULL);
    text_add(p->out, "; ");
  }
  text_add(p->out, "checked in the same way: ");
  page_verdict(p, f->correction_verdict);
  text_add(p->out, "</p>");
  end_side(p);
}

static void add_texts(const struct page *p, const struct finding *f) {
  struct texts t = {.quote = finding_quote(f),
                    .printed = finding_printed(f),
                    .corrected = f->correction ? f->correction_latex : NULL};
  if (!t.quote && !t.printed && !f->correction) return;
  find_changes(&t);
  text_add(p->out, "<dl class=\"sides\">\n");
  if (t.quote) {
    begin_side(p, "The paper prints");
    html_text(p->out, t.quote, t.in_quote);
    end_side(p);
  }
  if (f->correction) add_correction(p, f, &t);
  if (t.printed && (f->printed_part || !t.quote)) {
    begin_side(p, "The paper's formula as read");
    html_math(p->out, t.printed, t.in_printed);
    end_side(p);
  }
  text_add(p->out, "</dl>\n");
  texts_clear(&t);
}

/* --- What is wrong, and how it is known --- */

/* Findings of the same sentence under a restriction that saves it. */
static void add_restrictions(const struct page *p, const struct finding *f) {
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *o = &p->r->findings[i];
    if (!finding_restricts(o, f)) continue;
    text_add(p->out, " As printed it holds when ");
    html_text(p->out, o->condition, NULL);
    text_add(p->out, " (");
    page_claim(p, o->id);
    text_printf(p->out, ", %s).", verdict_name[o->verdict]);
  }
}

static void add_fault(const struct page *p, const struct finding *f) {
  begin_row(p, "What is wrong");
  text_add(p->out, failure_words(f));
  if (f->condition) {
    text_add(p->out, f->verdict == VERDICT_CONDITIONAL ? "; proved under the condition: " : "; condition: ");
    html_text(p->out, f->condition, NULL);
  }
  html_stop(p->out);
  add_restrictions(p, f);
  end_row(p);
}

/* A sentence, or a message of the reader of equations, whose caret stands under what it means. */
static void add_note(const struct page *p, const char *note) {
  if (note && strchr(note, '\n')) {
    text_add(p->out, "<pre>");
    for (const char *s = note; *s; s += *s == '\n') {
      size_t n = strcspn(s, "\n");
      escape_html_n(p->out, s, n);
      text_add_char(p->out, '\n');
      s += n;
    }
    text_add(p->out, "</pre>\n");
  } else if (note) {
    html_text(p->out, note, NULL);
    html_stop(p->out);
    text_add_char(p->out, ' ');
  }
}

static void add_certificate(const struct page *p, const struct finding *f) {
  const struct evidence *e = failure_evidence(f);
  if (!e) return;
  begin_row(p, "Certificate");
  add_note(p, e->note);
  if (e->worst && (!e->note || !strstr(e->note, e->worst))) {
    text_add(p->out, e->residual ? "Largest difference at " : "Where: ");
    html_text(p->out, e->worst, NULL);
    html_stop(p->out);
    text_add_char(p->out, ' ');
  }
  text_add(p->out, "Route: ");
  escape_html(p->out, e->route);
  if (e->trials >= 0) text_printf(p->out, ", %ld trial%s", e->trials, e->trials == 1 ? "" : "s");
  if (e->bits >= 0) text_printf(p->out, ", %ld bits", e->bits);
  text_add_char(p->out, '.');
  end_row(p);
}

/* --- What depends on it --- */

static const struct column changed[] = {
    {"result", false}, {"with the printed formula", false}, {"with the corrected one", false}, {"at", false}};

static void add_changed(const struct page *p, const struct consequence *q) {
  bool any = false;
  for (int i = 0; i < q->n_derived; i++) {
    const struct derived *d = &q->derived[i];
    if (d->change != CHANGE_CHANGES) continue;
    if (!any) {
      page_begin_table(p, "stack", "Results that change, each with one example", changed,
                       sizeof changed / sizeof *changed);
    }
    any = true;
    text_add(p->out, "<tr><th scope=\"row\">");
    html_math(p->out, d->latex, NULL);
    if (d->entry) text_add(p->out, ", entry ");
    escape_html(p->out, d->entry);
    text_add(p->out, "<br /><small>");
    escape_html(p->out, d->title);
    text_add(p->out, "</small></th>");
    page_text_cell(p, &changed[1], d->printed);
    page_text_cell(p, &changed[2], d->corrected);
    page_text_cell(p, &changed[3], d->where);
    text_add(p->out, "</tr>\n");
  }
  if (any) page_end_table(p);
}

static void add_derived(const struct page *p, const struct consequence *q, enum change change, const char *words) {
  const char *sep = words;
  for (int i = 0; i < q->n_derived; i++) {
    if (q->derived[i].change != change) continue;
    text_add(p->out, sep);
    html_math(p->out, q->derived[i].latex, NULL);
    sep = ", ";
  }
  if (sep != words) text_add(p->out, ".</p>\n");
}

static void add_ids(const struct page *p, const struct id_list *list, const char *words) {
  if (!list->n) return;
  text_add(p->out, words);
  page_claims(p, list);
  text_add(p->out, ".</p>\n");
}

static void add_consequence(const struct page *p, const struct consequence *q) {
  if (!q) return;
  begin_row(p, "What depends on it");
  size_t before = p->out->len;
  add_changed(p, q);
  add_derived(p, q, CHANGE_UNDEFINED, "<p>Meaningless with the printed formula: ");
  add_derived(p, q, CHANGE_AGREES, "<p>Unchanged at every point tried: ");
  add_derived(p, q, CHANGE_UNDECIDED, "<p>Undecided: ");
  add_ids(p, &q->falls, "<p>Statements that no longer hold with the printed formula: ");
  add_ids(p, &q->survives, "<p>Statements that use it and still hold: ");
  add_ids(p, &q->open, "<p>Undecided statements: ");
  if (p->out->len == before) text_add(p->out, "No result that the paper derives changes.");
  end_row(p);
}

static void add_size(const struct page *p, const struct finding *f) {
  const char *size = failure_size(p->r, f);
  if (!size) return;
  begin_row(p, "Size of the effect");
  html_text(p->out, size, NULL);
  html_stop(p->out);
  end_row(p);
}

static void add_reproduction(const struct page *p, const struct finding *f) {
  begin_row(p, "Recheck");
  html_code(p->out, finding_recheck(f));
  end_row(p);
}

/* --- One finding --- */

static void begin_finding(const struct page *p, const struct finding *f) {
  text_add(p->out, "<article id=\"");
  html_anchor(p->out, "f-", f->id);
  text_add(p->out, "\">\n<h4>");
  page_row(p, f->id);
  text_printf(p->out, ": %s", failure_heading(f));
  html_text(p->out, f->title, NULL);
  text_add_char(p->out, ' ');
  page_verdict(p, f->verdict);
  if (f->section) text_add(p->out, " <small>section ");
  page_section_name(p, f->section);
  text_add(p->out, f->section ? "</small></h4>\n" : "</h4>\n");
}
static void end_finding(const struct page *p) {
  text_add(p->out, "</article>\n");
}

static void add_failure(const struct page *p, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  const struct finding *first = failure_mended_with(p->r, f);
  begin_finding(p, f);
  if (first) {
    text_add(p->out, "<p>The correction of ");
    page_claim(p, first->id);
    text_add(p->out, " corrects this as well.</p>\n");
  } else {
    add_texts(p, f);
  }
  text_add(p->out, "<dl class=\"rows\">\n");
  if (!first) {
    add_fault(p, f);
    add_size(p, f);
    add_certificate(p, f);
    add_consequence(p, q);
  }
  add_reproduction(p, f);
  text_add(p->out, "</dl>\n");
  end_finding(p);
}

/* --- The printed numbers in a table --- */

static const struct column numbers[] = {
    {"claim", false},      {"the paper prints", false},   {"nearest periodic solution", false},
    {"difference", false}, {"what depends on it", false}, {"recheck", false}};

static void add_number(const struct page *p, const struct finding *f) {
  const struct consequence *q = audit_result_consequence(p->r, f->id);
  struct texts t = {.quote = f->quote, .printed = f->printed, .corrected = f->correction_latex};
  const char *size = failure_size(p->r, f), *sep = "";
  find_changes(&t);
  text_add(p->out, "<tr id=\"");
  html_anchor(p->out, "f-", f->id);
  text_add(p->out, "\"><th scope=\"row\">");
  page_row(p, f->id);
  text_add(p->out, "</th>");
  page_cell(p, &numbers[1]);
  html_text(p->out, t.quote, t.in_quote);
  text_add(p->out, "</td>");
  page_cell(p, &numbers[2]);
  html_math(p->out, t.corrected, t.in_corrected);
  text_printf(p->out, " (%s)</td>", verdict_name[f->correction_verdict]);
  page_text_cell(p, &numbers[3], size);
  page_cell(p, &numbers[4]);
  for (int i = 0; q && i < q->n_derived; i++) {
    if (q->derived[i].change != CHANGE_CHANGES) continue;
    text_add(p->out, sep);
    html_math(p->out, q->derived[i].latex, NULL);
    sep = ", ";
  }
  text_add(p->out, q && q->falls.n ? sep : "");
  if (q) page_claims(p, &q->falls);
  text_add(p->out, "</td>");
  page_cell(p, &numbers[5]);
  html_code(p->out, finding_recheck(f));
  text_add(p->out, "</td></tr>\n");
  texts_clear(&t);
}

static void add_numbers(const struct page *p) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!finding_fails(f) || !failure_is_number(f)) continue;
    if (!any) {
      page_begin_table(p, "numbers stack", "Printed numbers, and those of the periodic solution nearest to them",
                       numbers, sizeof numbers / sizeof *numbers);
    }
    any = true;
    add_number(p, f);
  }
  if (any) page_end_table(p);
}

/* Where inconsistent numbers may have come from. */
static void add_readings(const struct page *p) {
  if (!p->r->readings || !p->r->readings->n_conclusions) return;
  text_add(p->out, "<details><summary>How the printed numbers could have arisen</summary>\n<ul>\n");
  for (int i = 0; i < p->r->readings->n_conclusions; i++) {
    text_add(p->out, "<li>");
    html_text(p->out, p->r->readings->conclusion[i], NULL);
    text_add(p->out, "</li>\n");
  }
  text_add(p->out, "</ul></details>\n");
}

static const struct root_cause *root_of(const struct page *p, const struct finding *f) {
  return f->root ? audit_result_root(p->r, f->root) : NULL;
}

/* The failures of one root; NULL: those of none. */
static void add_root(const struct page *p, const struct root_cause *root) {
  bool any = false, tabled = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!finding_fails(f) || root_of(p, f) != root) continue;
    if (!any) {
      text_add(p->out, root ? "<h3>" : "<h3>Other statements</h3>\n");
      if (root) {
        html_text(p->out, root->where, NULL);
        text_add(p->out, ": ");
        html_text(p->out, root->title, NULL);
        text_add(p->out, "</h3>\n");
      }
    }
    any = true;
    if (failure_is_number(f) && !tabled) {
      add_numbers(p);
      add_readings(p);
    }
    tabled = tabled || failure_is_number(f);
    if (!failure_is_number(f)) add_failure(p, f);
  }
}

/* --- What is not wrong and needs attention all the same --- */

static void add_unexpected(const struct page *p) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!finding_unexpected(f)) continue;
    text_add(p->out, any ? "<li>" : "<h3>Not as recorded</h3>\n<ul>\n<li>");
    any = true;
    page_claim(p, f->id);
    text_printf(p->out, ": %s, recorded as %s</li>\n", verdict_name[f->verdict], verdict_name[f->recorded]);
  }
  if (any) text_add(p->out, "</ul>\n");
}

static bool is_undecided(const struct finding *f) {
  return f->verdict == VERDICT_UNKNOWN;
}

/* Findings with what their routes say. */
static void add_statements(const struct page *p, const char *heading, bool (*wanted)(const struct finding *),
                           const char *result) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!wanted(f)) continue;
    if (!any) text_printf(p->out, "<h3>%s</h3>\n", heading);
    any = true;
    begin_finding(p, f);
    if (f->quote) {
      text_add(p->out, "<p class=\"tex\">");
      html_text(p->out, f->quote, NULL);
      text_add(p->out, "</p>\n");
    }
    if (f->condition) {
      text_add(p->out, "<p>Condition: ");
      html_text(p->out, f->condition, NULL);
      text_add(p->out, "</p>\n");
    }
    page_statements(p, f, result);
    end_finding(p);
  }
}

void page_failures(const struct page *p) {
  page_begin_section(p, "failures", "What needs attention");
  text_add(
      p->out,
      "<p>The statements that do not hold are listed in order of consequence. Each was judged as printed, with the "
      "corrected form of everything else that it uses, so that one error is counted once. The examples have exact "
      "parameters, at which anybody can evaluate both sides. For a formula, the left side is what the paper prints "
      "and the right side what the equations of motion give; for an equation, they are its own two sides. Differences "
      "between the printed and the corrected text are <mark>marked</mark>. Route, trials, bits and other words are <a "
      "href=\"#s-words\">explained above</a>.</p>\n");
  add_unexpected(p);
  for (size_t i = 0; i < p->r->n_roots; i++) add_root(p, &p->r->roots[i]);
  add_root(p, NULL);
  add_statements(p, "Undecided", is_undecided, NULL);
  add_statements(p, "What the paper does not say", finding_states, "states");
  text_add(p->out, "</section>\n");
}
