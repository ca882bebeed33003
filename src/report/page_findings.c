/* The findings, worst first: of what changes a result the reason, the correction and the consequence, then for each
   statement that fails for it the paper's own text beside the corrected one, a certificate, what depends on it, and how
   to recheck it; remarks and slips of notation as lists, their evidence with the claims. */
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "escape.h"
#include "finding.h"
#include "formula.h"
#include "page.h"

/* --- Rows of a description --- */

static void begin_row(const struct page *p, const char *word) {
  page_add(p, "<dt>%s</dt>\n<dd>", word);
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
  page_add(p, "<div><dt>%s</dt>\n<dd class=\"tex\">", word);
}
static void end_side(const struct page *p) {
  text_add(p->out, "</dd></div>\n");
}

static void add_correction(const struct page *p, const struct finding *f, const struct texts *t) {
  begin_side(p, correction_heading(f));
  if (t->corrected)
    html_math(p->out, t->corrected, t->in_corrected);
  else
    page_add(p, "%t", f->correction);
  page_add(p, "<p class=\"note\">%t%schecked in the same way: %v</p>", f->change, f->change ? "; " : NULL,
           verdict_name[f->correction_verdict]);
  end_side(p);
}

static void add_texts(const struct page *p, const struct finding *f) {
  OWNED(texts) t = {.quote = finding_quote(f),
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
}

/* --- What is wrong, and how it is known --- */

/* Findings of the same sentence under a restriction that saves it. */
static void add_restrictions(const struct page *p, const struct finding *f) {
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *o = &p->r->findings[i];
    if (!finding_restricts(o, f)) continue;
    page_add(p, " As printed it holds when %t (", o->condition);
    page_claim(p, o->id);
    page_add(p, ", %s).", verdict_name[o->verdict]);
  }
}

/* What is wrong in general stands with the cause, where there is one. */
static void add_fault(const struct page *p, const struct finding *f) {
  bool told = f->root && audit_result_root(p->r, f->root);
  const char *condition = f->verdict == VERDICT_CONDITIONAL ? f->condition : NULL;
  if (told && !condition) return;
  begin_row(p, told ? "When it holds" : "What is wrong");
  OWNED(text) words = {0};
  if (!told) text_printf(&words, "%s%s", failure_words(p->r, f), condition ? "; " : "");
  if (condition) text_printf(&words, "proved under the condition: %s", condition);
  sheet_sentence(HTML(p->out), text_str(&words));
  add_restrictions(p, f);
  end_row(p);
}

/* A sentence, or a message of the reader of equations, whose caret stands under what it means. */
static void add_note(const struct page *p, const char *note) {
  if (note && strchr(note, '\n')) {
    text_add(p->out, "<pre>");
    for (const char *s = note; *s; s += *s == '\n') {
      size_t n = strcspn(s, "\n");
      escape_html(p->out, s, n);
      text_add_char(p->out, '\n');
      s += n;
    }
    text_add(p->out, "</pre>\n");
  } else if (note) {
    sheet_sentence(HTML(p->out), note);
    text_add_char(p->out, ' ');
  }
}

static void add_certificate(const struct page *p, const struct finding *f) {
  const struct evidence *e = failure_evidence(f);
  if (!e) return;
  begin_row(p, "Certificate");
  OWNED(text) orbit = {0};
  add_note(p, e->note);
  if (e->note) finding_orbit(&orbit, f);
  if (orbit.len) page_add(p, "The solution computed has %p. ", text_str(&orbit));
  if (evidence_where(e)) page_add(p, "%s%t%. ", e->residual ? "Largest difference at " : "Where: ", e->worst);
  page_add(p, "Route: %e", e->route);
  evidence_extent(p->out, e);
  text_add_char(p->out, '.');
  end_row(p);
}

/* --- What depends on it --- */

static void add_changed(const struct page *p, const struct consequence *q) {
  if (!derived_next(q, NULL, CHANGE_CHANGES)) return;
  static const char changed[] = "result|with the printed formula|with the corrected one|at";
  page_begin_table(p, "stack", "Results that change, each with one example", changed);
  for (const struct derived *d = NULL; (d = derived_next(q, d, CHANGE_CHANGES)) != NULL;)
    page_row(p, changed, PAGE_ROW "%m%s%e<br /><small>%e</small></th>|%t|%t|%t", d->latex, d->entry ? ", entry " : NULL,
             d->entry, d->title, d->printed, d->corrected, d->where);
  page_end_table(p);
}

static void add_ids(const struct page *p, const struct id_list *list, const char *words) {
  for (int i = 0; i < list->n; i++) {
    text_add(p->out, i ? ", " : words);
    page_claim(p, list->id[i]);
  }
  if (list->n) text_add(p->out, ".</p>\n");
}

static void add_consequence(const struct page *p, const struct consequence *q) {
  if (!q) return;
  begin_row(p, "What depends on it");
  size_t before = p->out->len;
  add_changed(p, q);
  derived_list(HTML(p->out), q, CHANGE_UNDEFINED, "<p>Meaningless with the printed formula: ", ".</p>\n");
  derived_list(HTML(p->out), q, CHANGE_AGREES, "<p>Unchanged: ", ".</p>\n");
  derived_list(HTML(p->out), q, CHANGE_UNDECIDED, "<p>Undecided: ", ".</p>\n");
  add_ids(p, &q->falls, "<p>Statements that no longer hold with the printed formula: ");
  add_ids(p, &q->survives, "<p>Statements that use it and keep their verdict: ");
  add_ids(p, &q->open, "<p>Undecided statements: ");
  if (p->out->len == before) text_add(p->out, "No derived result is computed from this statement.");
  end_row(p);
}

static void add_size(const struct page *p, const struct finding *f) {
  const char *size = failure_size(p->r, f);
  if (!size) return;
  begin_row(p, "Size of the effect");
  sheet_sentence(HTML(p->out), size);
  end_row(p);
}

/* --- One finding --- */

static void begin_finding(const struct page *p, const struct finding *f) {
  page_add(p, "<article id=\"f-%a\">\n<h4><a href=\"#c-%a\">%n</a>: %s%t %v</h4>\n", f->id, f->id, f->id,
           failure_heading(f), f->title, verdict_name[f->verdict]);
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
  page_add(p, PAGE_RECHECK, finding_recheck(f));
  text_add(p->out, "</dl>\n");
  end_finding(p);
}

/* Where inconsistent numbers may have come from. */
static void add_readings(const struct page *p) {
  if (!p->r->readings || !p->r->readings->n_conclusions) return;
  text_add(p->out, "<details><summary>How the printed numbers could have arisen</summary>\n<ul>\n");
  for (int i = 0; i < p->r->readings->n_conclusions; i++) page_add(p, "<li>%t</li>\n", p->r->readings->conclusion[i]);
  text_add(p->out, "</ul></details>\n");
}

/* --- What fails for one cause --- */

static bool is_of(const struct page *p, const struct finding *f, const struct root_cause *root) {
  return finding_fails(f) && (f->root ? audit_result_root(p->r, f->root) : NULL) == root;
}

/* The failures of one root, those of printed numbers aside, which stand in the letter; NULL: those of none. */
static void add_failures(const struct page *p, const struct root_cause *root) {
  bool numbers = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    bool number = failure_is_number(f);
    if (!is_of(p, f, root)) continue;
    if (number && !numbers) add_readings(p);
    numbers = numbers || number;
    if (!number) add_failure(p, f);
  }
}

static void add_error(const struct page *p, const struct root_cause *root) {
  page_add(p, "<h3 id=\"r-%a\">%t: %t</h3>\n<p class=\"tex\">", root->id, root->where, root->title);
  root_say(HTML(p->out), p->r, root);
  text_add(p->out, "</p>\n");
  add_failures(p, root);
}

static void add_others(const struct page *p) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_findings; i++)
    any = any || (is_of(p, &p->r->findings[i], NULL) && !failure_is_number(&p->r->findings[i]));
  if (any) text_add(p->out, "<h3>Other statements</h3>\n");
  add_failures(p, NULL);
}

/* Links to the claims, to where links to the failures lead. */
static void add_evidence(const struct page *p, const struct root_cause *root) {
  const char *before = " <span class=\"k\">(Evidence: ";
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (!is_of(p, f, root) || failure_is_number(f)) continue;
    page_add(p, "%s<a id=\"f-%a\" href=\"#c-%a\">%e</a>", before, f->id, f->id, f->id);
    before = "</span>, <span class=\"k\">";
  }
  if (*before == '<') text_add(p->out, ")</span>");
}

static void add_list(const struct page *p, enum severity severity) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_roots; i++) {
    const struct root_cause *root = &p->r->roots[i];
    if (root->severity != severity) continue;
    if (!any) text_printf(p->out, "<h3>%s</h3>\n<ul>\n", severity_heading[severity]);
    any = true;
    page_add(p, "<li id=\"r-%a\"><div class=\"tex\"><strong>%t: %t.</strong> ", root->id, root->where, root->title);
    root_say(HTML(p->out), p->r, root);
    add_evidence(p, root);
    text_add(p->out, "</div></li>\n");
  }
  if (any) text_add(p->out, "</ul>\n");
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

/* With what the routes say, and what was decided of that on which it rests. */
static void add_undecided(const struct page *p) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_findings; i++) {
    const struct finding *f = &p->r->findings[i];
    if (f->verdict != VERDICT_UNKNOWN) continue;
    if (!any) text_add(p->out, "<h3>Undecided</h3>\n");
    any = true;
    begin_finding(p, f);
    if (f->quote) page_add(p, "<p class=\"tex\">%t</p>\n", f->quote);
    if (f->condition) page_add(p, "<p>Condition: %t</p>\n", f->condition);
    page_statements(p, f);
    for (int k = 0; k < f->n_depends_on; k++) {
      const struct finding *on = audit_result_finding(p->r, f->depends_on[k]);
      if (!on || on->verdict == VERDICT_UNKNOWN || on->verdict == VERDICT_SKIPPED) continue;
      text_add(p->out, "<p>It rests on ");
      page_claim(p, on->id);
      page_add(p, ": %t %v</p>\n", on->title, verdict_name[on->verdict]);
    }
    end_finding(p);
  }
}

void page_findings(const struct page *p) {
  OWNED(text) found = {0};
  const struct page in = {&found, p->r};
  add_unexpected(&in);
  for (size_t i = 0; i < p->r->n_roots; i++)
    if (p->r->roots[i].severity == SEVERITY_SUBSTANCE) add_error(&in, &p->r->roots[i]);
  add_others(&in);
  add_list(&in, SEVERITY_REMARK);
  add_list(&in, SEVERITY_NOTATION);
  add_undecided(&in);
  page_begin_section(p, "findings", "Findings");
  page_add(p, "%s%s</section>\n", found.len ? page_findings_html : "<p>There are none.</p>\n", text_str(&found));
}
