/* Links to claims, verdicts, what routes say, heads of tables. */
#include <stdio.h>
#include <string.h>

#include "escape.h"
#include "finding.h"
#include "page.h"

void page_claim(const struct page *p, const char *id) {
  const struct finding *f = audit_result_finding(p->r, id);
  if (f)
    page_add(p, "<a href=\"#%s%a\">%n</a>", finding_fails(f) ? "f-" : "c-", id, id);
  else
    page_add(p, "%n", id);
}

void page_section_name(const struct page *p, const char *section) {
  for (; section && *section; section++) {
    char c = *section == '_' ? ' ' : *section;
    escape_html(p->out, &c, 1);
  }
}

/* "number: what it says; more", what it says in bold. */
static void add_statement(const struct page *p, const char *note) {
  const char *colon = strstr(note, ": "), *end = colon ? strchr(colon, ';') : NULL;
  if (!end || memchr(note, '$', (size_t)(end - note))) {
    html_text(p->out, note, NULL);
    return;
  }
  sheet_prose_n(HTML(p->out), note, (size_t)(colon + 2 - note));
  text_add(p->out, "<strong>");
  sheet_prose_n(HTML(p->out), colon + 2, (size_t)(end - colon - 2));
  text_add(p->out, "</strong>");
  html_text(p->out, end, NULL);
}

void page_statements(const struct page *p, const struct finding *f) {
  const char *last = NULL;
  for (int i = 0; i < f->n_evidence; i++) {
    const struct evidence *e = &f->evidence[i];
    if (!e->note || (last && strcmp(e->note, last) == 0)) continue;
    page_add(p, "%s<li>%t%s", last ? "" : "<ul>\n", e->worst, e->worst ? ": " : NULL);
    last = e->note;
    add_statement(p, e->note);
    sheet_stop(HTML(p->out));
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

void page_begin_table(const struct page *p, const char *class, const char *caption, const char *columns) {
  text_printf(p->out, "<div class=\"wide\"><table class=\"%s\">\n<caption>%s</caption>\n<thead><tr>", class, caption);
  for (const char *c = columns, *end; *c; c = end + (*end == '|')) {
    end = c + strcspn(c, "|");
    bool right = end[-1] == ':';
    text_printf(p->out, "<th scope=\"col\"%s>%.*s</th>", right ? " class=\"n\"" : "", (int)(end - c) - right, c);
  }
  text_add(p->out, "</tr></thead>\n<tbody>\n");
}

void page_end_table(const struct page *p) {
  text_add(p->out, "</tbody></table></div>\n");
}

void page_row_texts(const struct page *p, const char *columns, const char *words, const char *const *text, size_t n) {
  OWNED(text) row = {0};
  size_t of = strcspn(columns, "|"), len = strcspn(words, "|");
  text_add_n(&row, words, len);
  while (words += len, columns += of, *words) {
    of = strcspn(++columns, "|");
    len = strcspn(++words, "|");
    bool right = columns[of - 1] == ':';
    text_printf(&row, "<td%s data-of=\"%.*s\">%.*s</td>", right ? " class=\"n\"" : "", (int)of - right, columns,
                (int)len, words);
  }
  text_add(&row, "</tr>\n");
  sheet_add_texts(HTML(p->out), text_str(&row), text, n);
}

const char page_dash[] = "&#8211;";

const char *page_number(char shown[24], long n) {
  snprintf(shown, 24, "%ld", n);
  return n < 0 ? page_dash : shown;
}

void page_recheck(const struct page *p) {
  OWNED(text) command = {0};
  audit_recheck(&command, p->r);
  page_add(p, "%c", text_str(&command));
}
