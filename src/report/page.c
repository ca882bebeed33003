/* index.html: one file that shows what the result record holds.  It is read without a network and without its script,
   which filters and sorts; it is HTML and well-formed XML at once, so that any tool can read it. */
#include "page.h"
#include "escape.h"
#include "html.h"
#include "report.h"
#include "sections.h"

static void add_head(const struct page *p) {
  text_add(
      p->out,
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; img-src data:\" />\n"
      "<meta name=\"color-scheme\" content=\"light dark\" />\n<link rel=\"icon\" href=\"data:,\" />\n<title>Audit: ");
  escape_html(p->out, p->r->title ? p->r->title : p->r->scene);
  text_printf(p->out, "</title>\n<style>\n%s%s</style>\n</head>\n", page_style, picture_style);
}

static void add_opening(const struct page *p) {
  text_add(p->out, "<body>\n<a class=\"skip\" href=\"#s-verdict\">To the verdict</a>\n<header>\n<h1>Audit of a paper");
  if (p->r->paper) {
    text_add(p->out, ": <cite>");
    escape_html(p->out, p->r->paper);
    text_add(p->out, "</cite>");
  }
  text_add(p->out,
           "</h1>\n<p>The paper studies periodic motions, with phases of stick and slip, of two masses that are "
           "connected by "
           "springs and driven by a belt through dry friction. Its statements are compared here with the equations of "
           "motion (1) and Coulomb's law (2): by exact algebra, by computations with rigorous error bounds, and by "
           "numerical integration. Numerical values refer to ");
  html_text(p->out, p->r->title ? p->r->title : p->r->scene, NULL);
  html_stop(p->out);
  text_add(
      p->out,
      " The <a href=\"#s-model\">system</a> and the <a href=\"#s-words\">words used here</a> are explained below.");
  text_add(p->out, "</p>\n<nav aria-label=\"Sections\"><ul>\n"
                   "<li><a href=\"#s-verdict\">Verdict</a></li>\n"
                   "<li><a href=\"#s-model\">The system in half a page</a></li>\n"
                   "<li><a href=\"#s-failures\">What needs attention</a></li>\n"
                   "<li><a href=\"#s-pictures\">Pictures</a></li>\n"
                   "<li><a href=\"#s-claims\">Every claim</a></li>\n"
                   "<li><a href=\"#s-graph\">What rests on what</a></li>\n"
                   "<li><a href=\"#s-routes\">Routes</a></li>\n"
                   "<li><a href=\"#s-limits\">What this does not show</a></li>\n</ul>\n"
                   "<button type=\"button\" id=\"theme\" hidden=\"hidden\">Dark or light</button></nav>\n</header>\n"
                   "<main>\n");
}

static void add_closing(const struct page *p) {
  text_add(p->out, "</main>\n<footer><p>Written by ");
  page_recheck(p);
  text_add(p->out, " from the result that <a href=\"audit.json\">audit.json</a> holds. Beside it: "
                   "<a href=\"audit.md\">audit.md</a>, <a href=\"errata.md\">errata.md</a> for the authors, "
                   "<a href=\"audit.csv\">audit.csv</a>, <a href=\"junit.xml\">junit.xml</a>, "
                   "<a href=\"claims.dot\">claims.dot</a>.</p></footer>\n<script>\n");
  text_printf(p->out, "%s</script>\n</body>\n</html>\n", page_script);
}

void report_html(struct text *out, const struct audit_result *r) {
  const struct page p = {out, r};
  add_head(&p);
  add_opening(&p);
  page_summary(&p);
  page_model(&p);
  page_failures(&p);
  page_pictures(&p);
  page_every_claim(&p);
  page_graph(&p);
  page_routes(&p);
  page_limits(&p);
  add_closing(&p);
}
