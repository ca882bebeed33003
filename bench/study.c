/* Tables of studies, and what is written from them.  A table is kept as the TSV that it ends as. */
#include "bench/study.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"

bool study_run(struct study_page *page, const struct study *study, const struct bench_env *env, bool quick) {
  *page = (struct study_page){.study = study, .quick = quick};
  text_init(&page->found);
  text_init(&page->plot);
  return study->run(page, env);
}

void study_clear(struct study_page *page) {
  for (int i = 0; i < page->n; i++) text_clear(&page->table[i].tsv);
  text_clear(&page->found);
  text_clear(&page->plot);
}

struct study_table *study_table(struct study_page *page, const char *id, const char *title, const char *columns,
                                const char *note) {
  if (page->n == STUDY_TABLES) abort();
  struct study_table *t = &page->table[page->n++];
  *t = (struct study_table){.id = id, .title = title, .note = note};
  text_init(&t->tsv);
  text_printf(&t->tsv, "%s\n", columns);
  return t;
}

void study_text(struct study_table *t, const char *fmt, ...) {
  char cell[400];
  va_list list;
  va_start(list, fmt);
  vsnprintf(cell, sizeof cell, fmt, list);
  va_end(list);
  if (t->open) text_add_char(&t->tsv, '\t');
  text_add(&t->tsv, cell);
  t->open = true;
}

void study_number(struct study_table *t, double x, int digits) {
  if (isfinite(x))
    study_text(t, "%.*g", digits, x);
  else
    study_text(t, "-");
}

void study_row(struct study_table *t) {
  text_add_char(&t->tsv, '\n');
  t->open = false;
}

/* The line with the given number, its length in *len; NULL behind the last. */
static const char *line_of(size_t *len, const struct study_table *t, int n) {
  const char *p = text_str(&t->tsv);
  while (n-- > 0 && p) {
    p = strchr(p, '\n');
    if (p) p++;
  }
  if (!p || !*p) return NULL;
  *len = strcspn(p, "\n");
  return p;
}

int study_rows(const struct study_table *t) {
  size_t len;
  int n = 0;
  while (line_of(&len, t, n + 1)) n++;
  return n;
}

/* Where the k-th cell of a line begins, and its length; NULL when the line is shorter. */
static const char *cell_of(size_t *len, const char *line, size_t length, int k) {
  const char *end = line + length;
  for (; k > 0 && line; k--) {
    line = memchr(line, '\t', (size_t)(end - line));
    if (line) line++;
  }
  if (!line) return NULL;
  const char *stop = memchr(line, '\t', (size_t)(end - line));
  *len = (size_t)((stop ? stop : end) - line);
  return line;
}

const char *study_cell(struct text *out, const struct study_table *t, int row, const char *column) {
  size_t head_len = 0, len = 0, line_len = 0;
  const char *head = line_of(&head_len, t, 0), *line = line_of(&line_len, t, row + 1), *name;
  text_reset(out);
  for (int k = 0; line && (name = cell_of(&len, head, head_len, k)) != NULL; k++) {
    if (strlen(column) != len || memcmp(name, column, len) != 0) continue;
    const char *cell = cell_of(&len, line, line_len, k);
    if (cell) text_add_n(out, cell, len);
    break;
  }
  return text_str(out);
}

static void markdown_line(struct text *out, const char *line, size_t len) {
  text_add(out, "| ");
  for (size_t i = 0; i < len; i++)
    if (line[i] == '\t')
      text_add(out, " | ");
    else
      text_add_char(out, line[i]);
  text_add(out, " |\n");
}

static void markdown_table(struct text *out, const struct study_table *t) {
  size_t len;
  text_printf(out, "\n### %s\n\n%s\n\n", t->title, t->note);
  for (int n = 0;; n++) {
    const char *line = line_of(&len, t, n);
    if (!line) break;
    markdown_line(out, line, len);
    if (n > 0) continue;
    text_add(out, "|");
    for (size_t i = 0, columns = 1; i <= len; i++) {
      if (i < len && line[i] != '\t') continue;
      text_add(out, columns++ == 1 ? " --- |" : " ---: |");
    }
    text_add_char(out, '\n');
  }
}

void study_markdown(struct text *out, const struct study_page *page, bool figure) {
  text_printf(out, "\n## %s\n\n%s\n", page->study->title, page->study->question);
  if (page->quick) text_add(out, "\nA quick run: few settings, and its times are rough.\n");
  if (figure) text_printf(out, "\n![%s](%s.svg)\n", page->study->title, page->study->id);
  if (page->found.len > 0) text_printf(out, "\n%s", text_str(&page->found));
  for (int i = 0; i < page->n; i++) markdown_table(out, &page->table[i]);
}

static void json_line(struct json *j, const char *line, size_t length) {
  struct text cell = {0};
  const char *at;
  size_t len;
  json_array(j, NULL);
  for (int k = 0; (at = cell_of(&len, line, length, k)) != NULL; k++) {
    text_reset(&cell);
    text_add_n(&cell, at, len);
    json_string(j, NULL, text_str(&cell));
  }
  json_end_array(j);
  text_clear(&cell);
}

void study_json(struct json *j, const struct study_page *page) {
  size_t len;
  json_object(j, NULL);
  json_string(j, "study", page->study->id);
  json_string(j, "title", page->study->title);
  json_array(j, "tables");
  for (int i = 0; i < page->n; i++) {
    const struct study_table *t = &page->table[i];
    json_object(j, NULL);
    json_string(j, "id", t->id);
    json_string(j, "title", t->title);
    json_array(j, "rows");
    for (int n = 0;; n++) {
      const char *line = line_of(&len, t, n);
      if (!line) break;
      json_line(j, line, len);
    }
    json_end_array(j);
    json_end_object(j);
  }
  json_end_array(j);
  json_end_object(j);
}
