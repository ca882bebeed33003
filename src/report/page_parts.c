/* Links to claims, verdicts, what routes say, heads of tables. */
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "html.h"
#include "page.h"

static void add_name(struct text *out, const char *id) {
  if (strncmp(id, "eq-", 3) == 0) {
    text_add_char(out, '(');
    escape_html(out, id + 3);
    text_add_char(out, ')');
  } else {
    html_code(out, id);
  }
}

void page_begin_link(const struct page *p, const char *prefix, const char *id) {
  text_add(p->out, "<a href=\"#");
  html_anchor(p->out, prefix, id);
  text_add(p->out, "\">");
}

static void add_link(const struct page *p, const char *prefix, const char *id) {
  page_begin_link(p, prefix, id);
  add_name(p->out, id);
  text_add(p->out, "</a>");
}

void page_row(const struct page *p, const char *id) {
  add_link(p, "c-", id);
}

void page_claim(const struct page *p, const char *id) {
  const struct finding *f = audit_result_finding(p->r, id);
  if (f)
    add_link(p, finding_fails(f) ? "f-" : "c-", id);
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
    escape_html_n(p->out, &c, 1);
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

void page_statements(const struct page *p, const struct finding *f) {
  const char *last = NULL;
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    if (!e->note || (last && strcmp(e->note, last) == 0)) continue;
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

void page_begin_section(const struct page *p, const char *name, const char *heading) {
  text_printf(p->out, "<section id=\"s-%s\" aria-labelledby=\"h-%s\">\n<h2 id=\"h-%s\">%s</h2>\n", name, name, name,
              heading);
}

void page_begin_fold(const struct page *p, const char *name, const char *heading) {
  text_printf(p->out, "<details class=\"fold\" id=\"s-%s\">\n<summary><h3>%s</h3></summary>\n", name, heading);
}

void page_begin_table(const struct page *p, const char *class, const char *caption, const struct column *columns,
                      size_t n) {
  text_printf(p->out, "<div class=\"wide\"><table class=\"%s\">\n<caption>%s</caption>\n<thead><tr>", class, caption);
  for (size_t i = 0; i < n; i++)
    text_printf(p->out, "<th scope=\"col\"%s>%s</th>", columns[i].number ? " class=\"n\"" : "", columns[i].name);
  text_add(p->out, "</tr></thead>\n<tbody>\n");
}

void page_end_table(const struct page *p) {
  text_add(p->out, "</tbody></table></div>\n");
}

void page_cell(const struct page *p, const struct column *column) {
  text_printf(p->out, "<td%s data-of=\"%s\">", column->number ? " class=\"n\"" : "", column->name);
}

void page_text_cell(const struct page *p, const struct column *column, const char *text) {
  page_cell(p, column);
  html_text(p->out, text, NULL);
  text_add(p->out, "</td>");
}

void page_recheck(const struct page *p) {
  struct text command;
  text_init(&command);
  audit_recheck(&command, p->r);
  html_code(p->out, text_str(&command));
  text_clear(&command);
}
