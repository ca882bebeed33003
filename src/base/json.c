/* A writer with a stack of open containers; broken nesting is a broken invariant. */
#include "json.h"

#include <math.h>
#include <stdlib.h>

static void add_escaped(struct text *out, const char *s) {
  text_add_char(out, '"');
  for (; *s; s++) {
    unsigned char c = (unsigned char)*s;
    if (c == '"' || c == '\\')
      text_printf(out, "\\%c", c);
    else if (c == '\n')
      text_add(out, "\\n");
    else if (c == '\t')
      text_add(out, "\\t");
    else if (c < 0x20 || c == 0x7F)
      text_printf(out, "\\u%04x", c);
    else
      text_add_char(out, *s);
  }
  text_add_char(out, '"');
}

static void new_line(struct json *j) {
  text_add_char(j->out, '\n');
  for (int i = 0; i < j->depth; i++) text_add(j->out, "  ");
}

static void begin_member(struct json *j, const char *key) {
  if (j->depth > 0) {
    if (j->started[j->depth - 1]) text_add_char(j->out, ',');
    j->started[j->depth - 1] = true;
    new_line(j);
  }
  if (key) {
    add_escaped(j->out, key);
    text_add(j->out, ": ");
  }
}

static void open_container(struct json *j, const char *key, char bracket) {
  begin_member(j, key);
  if (j->depth == JSON_DEPTH) abort();
  text_add_char(j->out, bracket);
  j->started[j->depth++] = false;
}

static void close_container(struct json *j, char bracket) {
  if (j->depth == 0) abort();
  j->depth--;
  if (j->started[j->depth]) new_line(j);
  text_add_char(j->out, bracket);
  if (j->depth == 0) text_add_char(j->out, '\n');
}

void json_object(struct json *j, const char *key) {
  open_container(j, key, '{');
}
struct json json_document(struct text *out, const char *schema) {
  struct json j = {.out = out};
  json_object(&j, NULL);
  if (schema) json_string(&j, "schema", schema);
  return j;
}
void json_clear(struct json *j) {
  json_end_object(j);
}
void json_array(struct json *j, const char *key) {
  open_container(j, key, '[');
}
void json_end_object(struct json *j) {
  close_container(j, '}');
}
void json_end_array(struct json *j) {
  close_container(j, ']');
}

void json_string(struct json *j, const char *key, const char *value) {
  if (!json_or_null(j, key, value != NULL)) return;
  begin_member(j, key);
  add_escaped(j->out, value);
}

void json_begin_string(struct json *j, const char *key) {
  begin_member(j, key);
  j->string = j->out->len;
}

void json_end_string(struct json *j) {
  FREED char *made = ss_strdup(text_str(j->out) + j->string);
  j->out->len = j->string;
  add_escaped(j->out, made);
}

void json_printf(struct json *j, const char *key, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  JSON_STRING(j, key, text_vprintf(j->out, fmt, ap));
  va_end(ap);
}

void json_double(struct json *j, const char *key, const char *fmt, double x) {
  if (json_or_null(j, key, isfinite(x))) json_printf(j, key, fmt, x);
}

void json_string_array(struct json *j, const char *key, const char *const *list, int n) {
  JSON_EACH (j, key, i, n) json_string(j, NULL, list[i]);
}

void json_long(struct json *j, const char *key, long value) {
  begin_member(j, key);
  text_printf(j->out, "%ld", value);
}

void json_bool(struct json *j, const char *key, bool value) {
  begin_member(j, key);
  text_add(j->out, value ? "true" : "false");
}

void json_null(struct json *j, const char *key) {
  begin_member(j, key);
  text_add(j->out, "null");
}

bool json_or_null(struct json *j, const char *key, bool known) {
  if (!known) json_null(j, key);
  return known;
}
