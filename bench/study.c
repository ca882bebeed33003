/* Tables of studies, and what is written from them.  A table is kept as the TSV that it ends as. */
#include "bench/study.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "report/plot.h"
#include "report/sheet.h"

bool study_run(struct study_page *page, const struct study *study, const struct bench_env *env, bool quick) {
  *page = (struct study_page){.study = study, .quick = quick};
  return study->run(page, env);
}

void study_clear(struct study_page *page) {
  for (int i = 0; i < page->n; i++) text_clear(&page->table[i].tsv);
  text_clear(&page->found);
  text_clear(&page->figure);
}

struct study_table *study_table(struct study_page *page, const char *id, const char *title, const char *columns,
                                const char *note) {
  if (page->n == STUDY_TABLES) abort();
  struct study_table *t = &page->table[page->n++];
  *t = (struct study_table){.id = id, .title = title, .note = note};
  text_printf(&t->tsv, "%s\n", columns);
  return t;
}

void study_cells(struct study_table *t, const char *fmt, ...) {
  static const char *const not_finite[] = {"nan", "inf", "-nan", "-inf"};
  OWNED(text) all = {0};
  va_list list;
  va_start(list, fmt);
  text_vprintf(&all, fmt, list);
  va_end(list);
  for (char *cell = all.data, *tab; cell; cell = tab ? tab + 1 : NULL) {
    tab = strchr(cell, '\t');
    if (tab) *tab = '\0';
    text_printf(&t->tsv, "%s%s", t->open ? "\t" : "", word_find(cell, not_finite, 4) < 4 ? "-" : cell);
    t->open = true;
  }
}

void study_row(struct study_table *t) {
  text_add_char(&t->tsv, '\n');
  t->open = false;
}

static void markdown_table(struct text *out, const struct study_table *table) {
  OWNED(rows) t;
  rows_parse(&t, text_str(&table->tsv));
  text_printf(out, "\n### %s\n\n%s\n\n", table->title, table->note);
  markdown_head_of(out, t.heading[0], t.heading + 1, (int)t.columns - 1);
  for (size_t i = 0; i < t.n; i++) {
    text_add(out, "|");
    for (size_t c = 0; c < t.columns; c++) text_printf(out, " %s |", t.cell[i][c]);
    text_add(out, "\n");
  }
}

void study_markdown(struct text *out, const struct study_page *page, bool files) {
  text_printf(out, "\n## %s\n\n%s\n", page->study->title, page->study->question);
  if (page->quick) text_add(out, "\nA quick run: few settings, and its times are rough.\n");
  if (files && page->figure.len > 0) text_printf(out, "\n![%s](%s.svg)\n", page->study->title, page->study->id);
  if (page->found.len > 0) text_printf(out, "\n%s", text_str(&page->found));
  for (int i = 0; i < page->n; i++) markdown_table(out, &page->table[i]);
}

void study_json(struct json *j, const struct study_page *page) {
  JSON_OBJECT(j, NULL);
  json_string(j, "study", page->study->id);
  json_string(j, "title", page->study->title);
  JSON_EACH (j, "tables", i, page->n) {
    const struct study_table *t = &page->table[i];
    OWNED(rows) rows;
    rows_parse(&rows, text_str(&t->tsv));
    JSON_OBJECT(j, NULL);
    json_string(j, "id", t->id);
    json_string(j, "title", t->title);
    json_array(j, "rows");
    json_string_array(j, NULL, rows.heading, (int)rows.columns);
    for (size_t n = 0; n < rows.n; n++) json_string_array(j, NULL, rows.cell[n], (int)rows.columns);
    json_end_array(j);
  }
}
