/* Line by line: a line in the first column with two words and nothing else is a head; an indented line, or any line of
   record 0, begins a field; lines indented deeper than the field's own go on with it.  Only attributes are joined into
   text here: a formula stays a span, so that its diagnostics point into the file. */
#include "record.h"

#include <stdlib.h>
#include <string.h>

#include "arena.h"

enum { MAX_FIELDS = 100000, LONGEST_ID = 40 };

struct line {
  size_t begin, end; /* without leading blanks, comments' lines excluded, without trailing blanks */
  size_t indent;
};

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
static bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}
static bool is_word(char c) {
  return char_is_word(c) || c == '-' || c == '.' || c == '\'';
}

/* The line at *pos, which moves to the next. */
static struct line line_at(const struct source *s, size_t *pos, size_t end_of_text) {
  size_t begin = *pos, from = begin, to = begin;
  while (to < end_of_text && s->text[to] != '\n') to++;
  *pos = to + 1;
  while (from < to && is_blank(s->text[from])) from++;
  while (to > from && is_blank(s->text[to - 1])) to--;
  return (struct line){from, to, from - begin};
}

/* The next line that is neither blank nor a comment; false at the end. */
static bool next_line(const struct source *s, size_t *pos, struct line *l) {
  while (*pos < s->len) {
    *l = line_at(s, pos, s->len);
    if (l->begin < l->end && s->text[l->begin] != '#') return true;
  }
  return false;
}

static char *copy(const struct source *s, struct span w) {
  return ss_strndup(s->text + w.begin, w.end - w.begin);
}

/* "kind id" and nothing else (a comment may follow). */
static bool head(const struct source *s, const struct line *l, struct span *kind, struct span *id) {
  const char *t = s->text;
  size_t i = l->begin, k = i;
  while (i < l->end && is_word(t[i])) i++;
  *kind = (struct span){k, i};
  k = i;
  while (i < l->end && is_blank(t[i])) i++;
  if (i == k || !is_lower(t[kind->begin])) return false;
  k = i;
  while (i < l->end && is_word(t[i])) i++;
  *id = (struct span){k, i};
  if (i == k) return false;
  while (i < l->end && is_blank(t[i])) i++;
  return i == l->end || t[i] == '#';
}

/* The number in an id such as eq-44b, or NULL. */
static char *number_in(const char *id) {
  static const char *const begins[] = {"eq-", "err-", "stable-"};
  size_t n = 0;
  for (size_t i = 0; n == 0 && i < sizeof begins / sizeof *begins; i++)
    if (strncmp(id, begins[i], strlen(begins[i])) == 0) n = strlen(begins[i]);
  size_t digits = strspn(id + n, "0123456789");
  const char *rest = id + n + digits;
  return n && digits && !rest[strspn(rest, "abcdefghijklmnopqrstuvwxyz")] ? ss_strndup(id + n, digits) : NULL;
}

static struct record *add_record(struct record_file *f, struct span kind, struct span id) {
  struct record *r = SS_PUSH(f->records, f->n_records, f->cap_records);
  *r = (struct record){.kind = kind, .id = id};
  r->kind_name = copy(&f->src, kind);
  r->id_name = copy(&f->src, id);
  r->number = number_in(r->id_name);
  return r;
}

static struct field *add_field(struct record_file *f, struct record *r, const struct line *l) {
  struct field *fd = SS_PUSH(r->fields, r->n_fields, r->cap_fields);
  *fd = (struct field){.value = {l->begin, l->end}};
  const char *t = f->src.text;
  size_t i = l->begin;
  while (i < l->end && (is_lower(t[i]) || (i > l->begin && (t[i] == '_' || t[i] == '-')))) i++;
  if (i > l->begin && i < l->end && t[i] == ':' && !(i + 1 < l->end && t[i + 1] == '=')) {
    fd->attribute = true;
    fd->key = (struct span){l->begin, i};
    i++;
    while (i < l->end && is_blank(t[i])) i++;
    fd->value.begin = i;
  }
  return fd;
}

/* Joins the value's lines with single spaces, leaving comment lines out. */
static char *join(const struct source *s, struct span v) {
  struct text out = {0};
  for (size_t pos = v.begin; pos < v.end;) {
    bool first = pos == v.begin;
    struct line l = line_at(s, &pos, v.end);
    if (l.begin == l.end || (!first && s->text[l.begin] == '#')) continue;
    if (out.len) text_add_char(&out, ' ');
    text_add_n(&out, s->text + l.begin, l.end - l.begin);
  }
  text_add(&out, "");
  return out.data;
}

bool record_file_parse(struct record_file *f, struct source src, struct diag *d) {
  *f = (struct record_file){.src = src};
  struct record *r = add_record(f, (struct span){0, 0}, (struct span){0, 0});
  struct field *open = NULL;
  size_t open_indent = 0, pos = 0, n_fields = 0;
  struct line l;
  while (next_line(&f->src, &pos, &l)) {
    if (open && l.indent > open_indent) {
      open->value.end = l.end;
      continue;
    }
    struct span kind, id;
    if (l.indent == 0 && head(&f->src, &l, &kind, &id)) {
      if (id.end - id.begin > LONGEST_ID)
        return diag_at(d, &f->src, id.begin, "an id has at most %d characters", LONGEST_ID);
      r = add_record(f, kind, id);
      open = NULL;
      continue;
    }
    if (l.indent == 0 && f->n_records > 1)
      return diag_at(d, &f->src, l.begin,
                     "a line in the first column must be a head \"kind id\"; indent the fields of record %s",
                     r->id_name);
    if (++n_fields > MAX_FIELDS) return diag_at(d, &f->src, l.begin, "more than %d fields in one file", MAX_FIELDS);
    open = add_field(f, r, &l);
    open_indent = l.indent;
  }
  for (size_t i = 0; i < f->n_records; i++)
    for (size_t k = 0; k < f->records[i].n_fields; k++) {
      struct field *fd = &f->records[i].fields[k];
      if (!fd->attribute) continue;
      fd->text = join(&f->src, fd->value);
      fd->key_name = copy(&f->src, fd->key);
    }
  return true;
}

void record_file_clear(struct record_file *f) {
  for (size_t i = 0; i < f->n_records; i++) {
    struct record *r = &f->records[i];
    for (size_t k = 0; k < r->n_fields; k++) {
      free(r->fields[k].text);
      free(r->fields[k].key_name);
    }
    free(r->fields);
    free(r->kind_name);
    free(r->id_name);
    free(r->number);
  }
  free(f->records);
  source_clear(&f->src);
  *f = (struct record_file){.n_records = 0};
}

const struct field *record_field(const struct record *r, const char *key) {
  for (size_t k = 0; k < r->n_fields; k++) {
    const struct field *f = &r->fields[k];
    if (f->attribute && strcmp(f->key_name, key) == 0) return f;
  }
  return NULL;
}

const char *record_get(const struct record *r, const char *key) {
  const struct field *f = record_field(r, key);
  return f ? f->text : strcmp(key, "equation") == 0 ? r->number : NULL;
}
