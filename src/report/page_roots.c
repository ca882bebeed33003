/* What is wrong in the paper, in order of consequence: what of it matters to somebody who uses the paper, then remarks
   and slips of notation as a list. */
#include "escape.h"
#include "finding.h"
#include "html.h"
#include "sections.h"

static void add_labelled(const struct page *p, const char *word, const char *text) {
  text_printf(p->out, " <em>%s:</em> ", word);
  html_text(p->out, text, NULL);
  html_stop(p->out);
}

static void add_title(const struct page *p, const struct root_cause *root) {
  text_add(p->out, "<strong>");
  html_text(p->out, root->where, NULL);
  text_add(p->out, "</strong>: ");
  html_text(p->out, root->title, NULL);
  html_stop(p->out);
}

/* Links to what was computed for each of its claims, by their names. */
static void add_certificates(const struct page *p, const struct root_cause *root) {
  text_add(p->out, " <span class=\"k\">(Evidence: ");
  for (int i = 0; i < root->n_claims; i++) {
    text_add(p->out, i ? ", " : "");
    page_begin_link(p, "f-", root->claims[i]);
    escape_html(p->out, root->claims[i]);
    text_add(p->out, "</a>");
  }
  text_add(p->out, ")</span>");
}

static void add_root(const struct page *p, const struct root_cause *root) {
  bool substance = root->severity == SEVERITY_SUBSTANCE;
  const char *value[MOST_VALUES];
  int n = root_values(value, p->r, root);
  text_add(p->out, "<li");
  html_anchor(p->out, " id=\"r-", root->id);
  text_add(p->out, "\">");
  add_title(p, root);
  text_add_char(p->out, ' ');
  html_text(p->out, root->wrong, NULL);
  html_stop(p->out);
  text_add(p->out, " <em>It should read:</em> ");
  for (int i = 0; i < n; i++) {
    html_math(p->out, value[i], NULL);
    text_add(p->out, i + 1 < n ? ", " : ". ");
  }
  html_text(p->out, root->correct, NULL);
  html_stop(p->out);
  if (root->severity != SEVERITY_NOTATION) add_labelled(p, "Consequence", root->consequence);
  if (substance && root->by_hand) add_labelled(p, "To see it", root->by_hand);
  add_certificates(p, root);
  text_add(p->out, "</li>\n");
}

static void add_roots(const struct page *p, enum severity least, const char *heading, const char *list) {
  bool any = false;
  for (size_t i = 0; i < p->r->n_roots; i++) {
    bool substance = p->r->roots[i].severity == SEVERITY_SUBSTANCE;
    if (substance != (least == SEVERITY_SUBSTANCE)) continue;
    if (!any) text_printf(p->out, "<h3>%s</h3>\n<%s>\n", heading, list);
    any = true;
    add_root(p, &p->r->roots[i]);
  }
  if (any) text_printf(p->out, "</%s>\n", list);
}

void page_roots(const struct page *p) {
  add_roots(p, SEVERITY_SUBSTANCE, "What changes a result, in order of consequence", "ol");
}

void page_slips(const struct page *p) {
  add_roots(p, SEVERITY_REMARK, "Remarks and slips of notation", "ul");
}
