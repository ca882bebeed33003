/* index.html: one file that shows what the result record holds.  It is read without a network and without its script,
   which filters and sorts; it is HTML and well-formed XML at once, so that any tool can read it. */
#include <string.h>

#include "page.h"

/* --- What the parts share --- */

const struct finding *page_finding(const struct page *p, const char *id) {
  for (size_t i = 0; i < p->r->n_findings; i++)
    if (strcmp(p->r->findings[i].id, id) == 0) return &p->r->findings[i];
  return NULL;
}

static void add_name(struct text *out, const char *id) {
  if (strncmp(id, "eq-", 3) == 0) {
    text_add_char(out, '(');
    html_plain(out, id + 3);
    text_add_char(out, ')');
  } else {
    html_code(out, id);
  }
}

static void add_link(const struct page *p, const char *prefix, const char *id) {
  text_add(p->out, "<a href=\"#");
  html_anchor(p->out, prefix, id);
  text_add(p->out, "\">");
  add_name(p->out, id);
  text_add(p->out, "</a>");
}

void page_row(const struct page *p, const char *id) {
  add_link(p, "c-", id);
}

void page_claim(const struct page *p, const char *id) {
  const struct finding *f = page_finding(p, id);
  if (f)
    add_link(p, report_is_failure(f) ? "f-" : "c-", id);
  else
    add_name(p->out, id);
}

void page_claims(const struct page *p, const struct id_list *list) {
  for (int i = 0; i < list->n; i++) {
    text_add(p->out, i ? ", " : "");
    page_claim(p, list->id[i]);
  }
}

void page_verdict(const struct page *p, enum verdict v) {
  text_printf(p->out, "<span class=\"v %s\">%s</span>", verdict_name[v], verdict_name[v]);
}

void page_section_name(const struct page *p, const char *section) {
  for (; section && *section; section++) {
    char c = *section == '_' ? ' ' : *section;
    html_plain_n(p->out, &c, 1);
  }
}

/* "number: what it says; more", what it says in bold. */
static void add_statement(const struct page *p, const char *note) {
  const char *colon = strstr(note, ": "), *end = colon ? strchr(colon, ';') : NULL;
  if (!end || memchr(note, '$', (size_t)(end - note))) {
    html_text(p->out, note, NULL);
    return;
  }
  html_prose_n(p->out, note, (size_t)(colon + 2 - note));
  text_add(p->out, "<strong>");
  html_prose_n(p->out, colon + 2, (size_t)(end - colon - 2));
  text_add(p->out, "</strong>");
  html_text(p->out, end, NULL);
}

void page_statements(const struct page *p, const struct finding *f, const char *result) {
  const char *last = NULL;
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    if ((result && strcmp(e->result, result) != 0) || !e->note || (last && strcmp(e->note, last) == 0)) continue;
    text_add(p->out, last ? "<li>" : "<ul>\n<li>");
    last = e->note;
    html_text(p->out, e->worst, NULL);
    text_add(p->out, e->worst ? ": " : "");
    add_statement(p, e->note);
    html_stop(p->out);
    text_add(p->out, "</li>\n");
  }
  if (last) text_add(p->out, "</ul>\n");
}

void page_heads(const struct page *p, const struct column *columns, size_t n) {
  text_add(p->out, "<thead><tr>");
  for (size_t i = 0; i < n; i++)
    text_printf(p->out, "<th scope=\"col\"%s>%s</th>", columns[i].number ? " class=\"n\"" : "", columns[i].name);
  text_add(p->out, "</tr></thead>\n");
}

void page_cell(const struct page *p, const struct column *column) {
  text_printf(p->out, "<td%s data-of=\"%s\">", column->number ? " class=\"n\"" : "", column->name);
}

/* --- The page --- */

static void add_head(const struct page *p) {
  text_add(
      p->out,
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\" />\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; img-src data:\" />\n"
      "<meta name=\"color-scheme\" content=\"light dark\" />\n<link rel=\"icon\" href=\"data:,\" />\n<title>Audit: ");
  html_plain(p->out, p->r->title ? p->r->title : p->r->scene);
  text_printf(p->out, "</title>\n<style>\n%s%s</style>\n</head>\n", page_style, picture_style);
}

static void add_opening(const struct page *p) {
  text_add(p->out, "<body>\n<a class=\"skip\" href=\"#s-verdict\">To the verdict</a>\n<header>\n<h1>Audit of a paper");
  if (p->r->paper) {
    text_add(p->out, ": <cite>");
    html_plain(p->out, p->r->paper);
    text_add(p->out, "</cite>");
  }
  text_add(
      p->out,
      "</h1>\n<p>The paper describes two blocks, tied by springs, that a moving belt drags along by dry friction, and "
      "motions of theirs that repeat. Here its statements were judged by computation: its formulas against ways to the "
      "same result that do not use them. The example here: ");
  html_text(p->out, p->r->title, NULL);
  text_add(p->out, p->r->title ? " (scene " : "scene ");
  html_code(p->out, p->r->scene);
  text_add(p->out, p->r->title ? ")." : ".");
  text_add(p->out,
           " New to it: <a href=\"#s-model\">the system in half a page</a>, <a href=\"#s-words\">the words used "
           "here</a>.");
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
  text_add(p->out, "<code>stickslip verify ");
  html_plain(p->out, p->r->scene);
  text_add(p->out, "</code> from the result that <a href=\"audit.json\">audit.json</a> holds. Beside it: "
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
