/* index.html: one file, a letter, findings and an archive.  It is read without a network and without its script,
   which filters, sorts and opens what a link leads to; it is HTML and well-formed XML at once, so that any tool can
   read it. */
#include "page.h"
#include "report.h"

static void add_head(const struct page *p) {
  page_add(p, "%s<title>Audit: %e</title>\n<style>\n%s%s</style>\n</head>\n", page_head_html,
           p->r->title && *p->r->title ? p->r->title : p->r->scene, page_css, picture_css);
}

static void add_opening(const struct page *p) {
  bool letter = !p->r->data; /* to the authors, of whose example the page then speaks */
  text_printf(p->out, "<body>\n<a class=\"skip\" href=\"#s-letter\">To the %s</a>\n<header>\n<h1>Audit of a paper",
              letter ? "letter" : "summary");
  if (p->r->paper) page_add(p, ": <cite>%e</cite>", p->r->paper);
  text_printf(p->out,
              "</h1>\n<nav aria-label=\"Sections\"><ul>\n<li><a href=\"#s-letter\">%s</a></li>\n%s</header>\n<main>\n",
              letter ? "Letter" : "Summary", page_nav_html);
}

/* For who wants to look something up. */
static void add_archive(const struct page *p) {
  page_begin_section(p, "archive", "Archive");
  if (p->r->data)
    page_add(p, "<p>Numerical values refer to %p.", p->r->data);
  else
    page_add(p, "<p>Numerical values refer to %t%.", p->r->title ? p->r->title : p->r->scene);
  text_add(p->out, " Each part opens where it is clicked, or when a link leads into it.</p>\n");
  page_model(p);
  page_pictures(p);
  page_every_claim(p);
  page_power(p);
  page_limits(p);
  text_add(p->out, "</section>\n");
}

static void add_closing(const struct page *p) {
  text_add(p->out, "</main>\n<footer><p>Written by ");
  page_recheck(p);
  text_printf(p->out,
              " from the result that <a href=\"audit.json\">audit.json</a> holds. Beside it: "
              "<a href=\"audit.md\">audit.md</a>, <a href=\"errata.md\">errata.md</a>%s, "
              "<a href=\"audit.csv\">audit.csv</a>, <a href=\"junit.xml\">junit.xml</a>, "
              "<a href=\"claims.dot\">claims.dot</a>.</p></footer>\n<script>\n",
              p->r->data ? "" : " for the authors");
  text_printf(p->out, "%s</script>\n</body>\n</html>\n", page_js);
}

void report_html(struct text *out, const struct audit_result *r) {
  const struct page p = {out, r};
  add_head(&p);
  add_opening(&p);
  page_letter(&p);
  page_findings(&p);
  add_archive(&p);
  add_closing(&p);
}
