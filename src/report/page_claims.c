/* Every claim in the paper's order: a row each, with text, formula and evidence behind a second row that opens. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "finding.h"
#include "name_list.h"
#include "page.h"

/* --- The paper's order: sections as they are first named, appendices after the rest --- */

static const char *section_of(const struct finding *f) {
  return f->section ? f->section : "";
}

static bool is_appendix(const char *section) {
  return strncmp(section, "appendix", strlen("appendix")) == 0;
}

static void list_sections(struct names *list, const struct audit_result *r) {
  for (int appendix = 0; appendix < 2; appendix++)
    for (size_t i = 0; i < r->n_findings; i++)
      if (is_appendix(section_of(&r->findings[i])) == appendix) names_index(list, section_of(&r->findings[i]));
}

static void list_routes(struct names *list, const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_evidence; k++) names_index(list, r->findings[i].evidence[k].route);
}

/* --- One claim --- */

/* Its routes, each once. */
static void add_routes(const struct page *p, const struct finding *f) {
  const char *sep = "";
  for (int i = 0; i < f->n_evidence; i++) {
    bool again = false;
    for (int k = 0; k < i; k++) again = again || strcmp(f->evidence[k].route, f->evidence[i].route) == 0;
    if (again) continue;
    page_add(p, "%s%e", sep, f->evidence[i].route);
    sep = ", ";
  }
}

static void add_line(const struct page *p, const char *word, const char *s) {
  if (s) page_add(p, "<dt>%s</dt>\n<dd>%t</dd>\n", word, s);
}

static const char evidence[] = "route|equations read|result|trials:|bits:|residual below:|digits agreed:|note; worst";

/* A residual below 1e-37 at 128 bits: 37 of 38 digits. */
static const char *digits_agreed(char shown[60], const struct evidence *e) {
  static const double digits_a_bit = 0.30102999566398120;
  long agreed = e->residual && strncmp(e->residual, "1e-", 3) == 0 ? strtol(e->residual + 3, NULL, 10) : 0;
  snprintf(shown, 60, "%ld of %ld", agreed, (long)((double)e->bits * digits_a_bit));
  return agreed > 0 && e->bits > 0 ? shown : page_dash;
}

static void add_evidence_row(const struct page *p, const struct evidence *e) {
  char trials[24], bits[24], digits[60];
  const char *where = evidence_where(e);
  page_row(p, evidence, PAGE_ROW "%e</th>|%e|%e|%s|%s|%p|%s|%t%s%s%t", e->route, e->layer, e->result,
           page_number(trials, e->trials), page_number(bits, e->bits), e->residual ? e->residual : "\xe2\x80\x93",
           digits_agreed(digits, e), e->note, e->note && where ? "; " : NULL, where ? "at " : NULL, where);
}

static void add_evidence(const struct page *p, const struct finding *f) {
  if (!f->n_evidence) return;
  page_begin_table(p, "evidence stack", "Routes and residuals", evidence);
  for (int i = 0; i < f->n_evidence; i++) add_evidence_row(p, &f->evidence[i]);
  page_end_table(p);
}

static void add_texts(const struct page *p, const struct finding *f) {
  if (f->quote) page_add(p, "<dt>The paper prints</dt>\n<dd class=\"tex\">%t</dd>\n", f->quote);
  if (f->printed) page_add(p, "<dt>As read</dt>\n<dd class=\"tex\">%m</dd>\n", f->printed);
}

static void add_correction(const struct page *p, const struct finding *f) {
  if (f->correction)
    page_add(p, "<dt>%t</dt>\n<dd class=\"tex\">%m%t (%v)</dd>\n", correction_heading(f), f->correction_latex,
             f->correction_latex ? NULL : f->correction, verdict_name[f->correction_verdict]);
}

static void add_dependences(const struct page *p, const struct finding *f) {
  if (!f->n_depends_on) return;
  text_add(p->out, "<dt>Rests on</dt>\n<dd>");
  for (int i = 0; i < f->n_depends_on; i++) {
    text_add(p->out, i ? ", " : "");
    page_claim(p, f->depends_on[i]);
  }
  text_add(p->out, "</dd>\n");
}

static void add_details(const struct page *p, const struct finding *f) {
  page_add(
      p,
      "<details><summary>Text, formula, evidence<span class=\"away\"> of %e</span></summary>\n<dl class=\"rows\">\n"
      "<dt>Section</dt>\n<dd>",
      f->id);
  page_section_name(p, or_dash(f->section));
  text_add(p->out, "</dd>\n");
  add_texts(p, f);
  add_line(p, "Fault", f->fault);
  add_line(p, "Condition", f->condition);
  add_correction(p, f);
  add_line(p, "Effect", f->effect);
  add_dependences(p, f);
  page_add(p, PAGE_RECHECK "</dl>\n", finding_recheck(f));
  add_evidence(p, f);
  if (finding_fails(f))
    page_add(p, "<p><a href=\"#f-%a\">What is wrong with it, and what depends on it</a></p>\n", f->id);
  text_add(p->out, "</details>\n");
}

/* What the filters read: numbers, so that no name needs to be quoted for a script. */
static void add_keys(const struct page *p, const struct finding *f, struct names *sections, struct names *routes,
                     long rank) {
  text_printf(p->out, "\" data-v=\"%d\" data-s=\"%zu\" data-w=\"%ld\" data-r=\" ", (int)f->verdict,
              names_index(sections, section_of(f)), rank);
  for (int i = 0; i < f->n_evidence; i++) text_printf(p->out, "%zu ", names_index(routes, f->evidence[i].route));
}

/* Failures by their severity, then what is undecided, then the rest. */
static long rank_of(const struct finding *f) {
  if (finding_fails(f)) return (long)f->severity;
  return N_SEVERITIES + 1 + (f->verdict == VERDICT_UNKNOWN ? 0 : f->verdict == VERDICT_SKIPPED ? 1 : 2);
}

static void add_claim(const struct page *p, const struct finding *f, struct names *sections, struct names *routes) {
  page_add(p, "<tbody class=\"claim\" id=\"c-%a", f->id);
  add_keys(p, f, sections, routes, rank_of(f));
  page_add(p, "\">\n<tr><th scope=\"row\">%c</th><td>%t</td><td>%v", f->id, f->title, verdict_name[f->verdict]);
  if (finding_unexpected(f)) text_printf(p->out, " <strong>recorded as %s</strong>", verdict_name[f->recorded]);
  text_add(p->out, "</td><td class=\"opt\">");
  page_section_name(p, f->section);
  text_add(p->out, "</td><td class=\"opt\">");
  add_routes(p, f);
  text_add(p->out, "</td></tr>\n<tr><td colspan=\"5\">");
  add_details(p, f);
  text_add(p->out, "</td></tr>\n</tbody>\n");
}

/* --- Filters: of use with the script only, which shows them --- */

static void begin_select(const struct page *p, const char *id, const char *label) {
  text_printf(p->out, "<label for=\"%s\">%s <select id=\"%s\"><option value=\"\">all</option>", id, label, id);
}
static void end_select(const struct page *p) {
  text_add(p->out, "</select></label>\n");
}

static void add_names(const struct page *p, const char *id, const char *label, const struct names *list) {
  begin_select(p, id, label);
  for (size_t i = 0; i < list->n; i++) {
    text_printf(p->out, "<option value=\"%zu\">", i);
    page_section_name(p, *list->name[i] ? list->name[i] : "-");
    text_add(p->out, "</option>");
  }
  end_select(p);
}

static void add_filters(const struct page *p, const struct names *sections, const struct names *routes) {
  long count[N_VERDICTS], checks[N_VERDICTS];
  audit_result_count(count, p->r, OF_PAPER);
  audit_result_count(checks, p->r, OF_SUITE);
  text_add(p->out, "<form id=\"filter\" hidden=\"hidden\">\n");
  begin_select(p, "by-v", "verdict");
  for (int i = 0; i < N_VERDICTS; i++)
    if (count[i] + checks[i])
      text_printf(p->out, "<option value=\"%d\">%s (%ld)</option>", i, verdict_name[i], count[i] + checks[i]);
  end_select(p);
  add_names(p, "by-s", "section", sections);
  add_names(p, "by-r", "route", routes);
  page_add(p, "%s</form>\n", page_filter_html);
}

void page_every_claim(const struct page *p) {
  struct names sections = {.n = 0}, routes = {.n = 0};
  list_sections(&sections, p->r);
  list_routes(&routes, p->r);
  page_begin_fold(p, "claims", "Every claim");
  text_add(
      p->out,
      "<p>By section of the paper, equations before sentences. Behind each row stand the paper's own text, the "
      "formula as the program read it, typeset again so that a slip in transcribing would show, and the routes with "
      "their residuals: the largest difference of the two sides relative to their size, as the power of ten above "
      "it.</p>\n");
  add_filters(p, &sections, &routes);
  text_add(p->out, page_claims_html);
  for (size_t s = 0; s < sections.n; s++)
    for (size_t i = 0; i < p->r->n_findings; i++)
      if (strcmp(section_of(&p->r->findings[i]), sections.name[s]) == 0)
        add_claim(p, &p->r->findings[i], &sections, &routes);
  text_add(p->out, "</table>\n</details>\n");
  free(routes.name);
  free(sections.name);
}
