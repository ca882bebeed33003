/* A suite counts its rows before any test runs, so that a table which cannot be read ends the runner. */
#include "table.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "local.h"
#include "scratch.h"

static void give_up(const char *path, const char *why) {
  fprintf(stderr, "check: %s: %s; the tests run in the project's folder\n", path, why);
  exit(EXIT_FAILURE);
}

/* In place: what is written with a backslash becomes the byte that it stands for. */
static void unescape(char *field) {
  static const char names[] = "ntr\\", bytes[] = "\n\t\r\\";
  char *to = field;
  for (const char *from = field; *from; to++) {
    const char *name = *from == '\\' && from[1] ? strchr(names, from[1]) : NULL;
    if (name) {
      *to = bytes[name - names];
      from += 2;
    } else if (*from == '\\' && from[1] == 'x' && from[2] && from[3]) {
      *to = (char)strtol((char[]){from[2], from[3], '\0'}, NULL, 16);
      from += 4;
    } else {
      *to = *from++;
    }
  }
  *to = '\0';
}

struct table table_read(const char *path, int columns) {
  OWNED(source) s;
  struct diag d = {0};
  size_t cap = 0;
  struct table t = {0};
  if (!source_read(&s, path, 16 << 20, &d)) give_up(path, d.message);
  t.text = ss_strdup(s.text);
  for (char *line = t.text, *next; *line; line = next) {
    next = line + strcspn(line, "\n");
    if (*next) *next++ = '\0';
    if (*line == '#') continue;
    t.row = ss_grow(t.row, (size_t)t.n, &cap, sizeof *t.row);
    memset(t.row[t.n], 0, sizeof *t.row);
    int n = split_tabs(t.row[t.n], MOST_COLUMNS, line);
    if (columns != ANY_COLUMNS && n != columns) give_up(path, line);
    for (int k = 0; k < n; k++) unescape(t.row[t.n][k]);
    t.n++;
  }
  if (t.n == 0) give_up(path, "no row");
  return t;
}

void table_clear(struct table *t) {
  free(t->row);
  free(t->text);
  *t = (struct table){.n = 0};
}

/* What stands in braces at p is in the list: behind them. */
static const char *add_named(struct text *out, const char *p, const char *const (*list)[2]) {
  for (; list && **list; list++) {
    size_t n = strlen(**list);
    if (strncmp(p + 1, **list, n) == 0 && p[1 + n] == '}') {
      text_add(out, (*list)[1]);
      return p + n + 2;
    }
  }
  return NULL;
}

void field_expand(struct text *out, const char *v, const char *const (*list)[2]) {
  while (*v) {
    char *end;
    const char *behind = *v == '{' ? add_named(out, v, list) : NULL;
    long n = v[0] == '@' ? strtol(v + 1, &end, 10) : 0;
    if (behind) {
      v = behind;
    } else if (n > 0) {
      size_t len = strcspn(end, "}") - 1;
      for (long i = 0; i < n; i++) text_add_n(out, end + 1, len);
      v = end + 1 + len + 1;
    } else if (v[0] == '@' && v[1] && strchr("DF0", v[1])) {
      if (v[1] == '0')
        text_add_n(out, "", 1);
      else
        text_add(out, scratch_path(v[1] == 'F' ? "file" : ""));
      v += 2;
    } else {
      text_add_char(out, *v++);
    }
  }
}

/* A text begins with a part, ends with it, is it, or holds it. */
static bool stands(const char *said, const char *part) {
  size_t n = strlen(said), m = *part ? strlen(part + 1) : 0;
  switch (*part) {
  case '^':
    return strncmp(said, part + 1, m) == 0;
  case '$':
    return n >= m && strcmp(said + n - m, part + 1) == 0;
  case '=':
    return strcmp(said, part + 1) == 0;
  default:
    return strstr(said, part) != NULL;
  }
}

void check_said(const char *said, const char *parts, const char *const (*list)[2], const char *what) {
  LOCAL(text, all);
  field_expand(&all, parts, list);
  for (char *part = all.data, *next; part; part = next) {
    next = strstr(part, " && ");
    if (next) {
      *next = '\0';
      next += strlen(" && ");
    }
    bool absent = *part == '!', there = stands(said, part + absent);
    ck_assert_msg(there != absent, "%.900s: %s stands %s in\n%.2500s", what, part + absent, there ? "" : "not", said);
  }
}

bool is_yes(const char *field) {
  bool yes = strcmp(field, "yes") == 0;
  ck_assert_msg(yes || strcmp(field, "no") == 0, "neither yes nor no: %s", field);
  return yes;
}

int table_row(const struct table *t, const char *first, const char *second) {
  for (int i = 0; i < t->n; i++)
    if (strcmp(t->row[i][0], first) == 0 && (!second || strcmp(t->row[i][1], second) == 0)) return i;
  ck_abort_msg("no row %s %s", first, second ? second : "");
}

void check_order(const char *text, const char *path) {
  OWNED(table) order = table_read(path, 1);
  for (int i = 0; i < order.n; i++) {
    const char *next = strstr(text, *order.row[i]);
    ck_assert_msg(next != NULL, "%s comes too early or not at all", *order.row[i]);
    text = next + 1;
  }
}
