/* For a reader who has not seen the paper: the system in half a page; and what the audit takes as given. */
#include "finding.h"
#include "glossary.h"
#include "page.h"

static void add_words(const struct page *p) {
  text_add(p->out, "<h4 id=\"s-words\">Words used on this page</h4>\n<p>What the verdicts mean is said <a "
                   "href=\"#s-power\">below</a>.</p>\n<dl>\n");
  for (const struct glossary_entry *g = NULL; (g = glossary_next(g, p->r)) != NULL;)
    page_add(p, "<dt>%s</dt>\n<dd>%t.</dd>\n", g->word, g->meaning);
  text_add(p->out, "</dl>\n");
}

void page_model(const struct page *p) {
  page_begin_fold(p, "model",
                  p->r->model ? "The system in half a page, and the words used here" : "The words used here");
  if (p->r->model) page_add(p, "<figure>\n%s", page_belt_svg);
  if (p->r->model) html_with_math(p->out, page_system_html);
  add_words(p);
  text_add(p->out, "</details>\n");
}

void page_limits(const struct page *p) {
  const struct audit_result *r = p->r;
  page_begin_fold(p, "limits", "What the audit does not show");
  page_add(p, "<ul>\n%s%s", r->model ? page_limits_model_html : "", page_limits_html);
  if (r->paper_source) page_add(p, "<li>What the printed page says: %t</li>\n", r->paper_source);
  if (r->paper_text)
    page_add(p,
             "<li>That your copy of the paper says what is quoted here: <code>stickslip quotes FILE</code> looks "
             "for every quotation in a copy. The digest of the text quoted, as its tokens: %c.</li>\n",
             r->paper_text);
  for (size_t i = 0; i < r->n_skipped; i++)
    page_add(p, "<li>Left out: %t: %e%.</li>\n", r->skipped[i].what, r->skipped[i].why);
  text_add(p->out, "</ul>\n</details>\n");
}
