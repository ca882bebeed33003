/* The two walks over a table of members: record to JSON, and JSON to record. */
#include "json_shape.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const void *field(const void *record, size_t at) {
  return (const char *)record + at;
}
static void *room(void *record, size_t at) {
  return (char *)record + at;
}

static const char *string_at(const void *record, size_t at) {
  const char *s;
  memcpy(&s, field(record, at), sizeof s);
  return s;
}

/* --- Writing --- */

static size_t count_of(const struct member *m, const void *record) {
  if (m->cap_at) return *(const size_t *)field(record, m->n_at);
  int n = *(const int *)field(record, m->n_at);
  return n > 0 ? (size_t)n : 0;
}

static const void *elements_of(const struct member *m, const void *record) {
  const void *p;
  if (m->most) return field(record, m->at);
  memcpy(&p, field(record, m->at), sizeof p);
  return p;
}

static int word_of(const struct member *m, const void *record) {
  int k;
  memcpy(&k, field(record, m->at), sizeof k);
  return k;
}

/* Whether the record has nothing under the member. */
static bool is_nothing(const struct member *m, const void *record) {
  switch (m->kind) {
  case MEMBER_STRING:
    return !string_at(record, m->at);
  case MEMBER_LONG:
    return *(const long *)field(record, m->at) < 0;
  case MEMBER_INT:
    return *(const int *)field(record, m->at) < 0;
  case MEMBER_WORD:
    return word_of(m, record) == m->n_words;
  case MEMBER_STRINGS:
  case MEMBER_RECORDS:
    return m->need == MEMBER_SPARSE && count_of(m, record) == 0;
  case MEMBER_RECORD:
    return !elements_of(m, record);
  case MEMBER_PART:
    return m->need != MEMBER_NEEDED && !string_at(field(record, m->at), m->of->member[0].at);
  case MEMBER_BOOL:
  case MEMBER_TOLD:
    break;
  }
  return false;
}

static void write_records(struct json *j, const struct member *m, const void *record) {
  const char *first = elements_of(m, record);
  JSON_EACH (j, m->key, i, count_of(m, record)) shape_write(j, NULL, m->of, first + (size_t)i * m->of->size);
}

static void write_member(struct json *j, const struct member *m, const void *record) {
  if (m->when && !m->when(record)) return;
  if (is_nothing(m, record)) {
    if (m->need != MEMBER_SPARSE) json_null(j, m->key);
    return;
  }
  switch (m->kind) {
  case MEMBER_STRING:
    json_string(j, m->key, string_at(record, m->at));
    return;
  case MEMBER_LONG:
    json_long(j, m->key, *(const long *)field(record, m->at));
    return;
  case MEMBER_INT:
    json_long(j, m->key, *(const int *)field(record, m->at));
    return;
  case MEMBER_BOOL:
    json_bool(j, m->key, *(const bool *)field(record, m->at));
    return;
  case MEMBER_WORD:
    json_string(j, m->key, m->word[word_of(m, record)]);
    return;
  case MEMBER_STRINGS:
    json_string_array(j, m->key, elements_of(m, record), (int)count_of(m, record));
    return;
  case MEMBER_RECORDS:
    write_records(j, m, record);
    return;
  case MEMBER_RECORD:
    shape_write(j, m->key, m->of, elements_of(m, record));
    return;
  case MEMBER_PART:
    shape_write(j, m->key, m->of, field(record, m->at));
    return;
  case MEMBER_TOLD:
    m->tell(j, m->key, record);
    return;
  }
}

void shape_write(struct json *j, const char *key, const struct shape *shape, const void *record) {
  json_object(j, key);
  for (int i = 0; i < shape->n; i++) write_member(j, &shape->member[i], record);
  json_end_object(j);
}

/* --- Reading --- */

struct walk {
  struct arena *a;
  const struct source *s;
  struct diag *d;
};

static bool read_record(const struct walk *w, void *record, const struct shape *shape, const struct json_value *v);

static bool wrong(const struct walk *w, const struct member *m, const struct json_value *v, const char *what) {
  return diag_at(w->d, w->s, v->at, "the member %s %s", m->key, what);
}

static bool read_whole(const struct walk *w, long *out, const struct member *m, const struct json_value *v) {
  enum { MOST_INT = 1000000000 };
  static const long most_long = 1000000000000000;
  char *end;
  if (v->kind != JSON_KIND_NUMBER) return wrong(w, m, v, "must be a number");
  errno = 0;
  *out = strtol(v->text, &end, 10);
  if (*end || errno || *out < 0 || *out > (m->kind == MEMBER_INT ? MOST_INT : most_long))
    return wrong(w, m, v,
                 m->kind == MEMBER_INT ? "must be a whole number from 0 to 10^9"
                                       : "must be a whole number from 0 to 10^15");
  return true;
}

static bool read_word(const struct walk *w, void *record, const struct member *m, const struct json_value *v) {
  if (v->kind != JSON_KIND_STRING) return wrong(w, m, v, "must be a word between quotes");
  int k = word_find(v->text, m->word, m->n_words);
  if (k == m->n_words) return wrong(w, m, v, "is none of the words that it can be");
  memcpy(room(record, m->at), &k, sizeof k);
  return true;
}

static bool read_strings(const struct walk *w, const char **out, const struct member *m, const struct json_value *v) {
  for (const struct json_value *e = v->first; e; e = e->next) {
    if (e->kind != JSON_KIND_STRING) return wrong(w, m, e, "must hold strings");
    *out++ = e->text;
  }
  return true;
}

/* Where n elements go, zeroed; the record knows them at once, so that clearing it frees them. */
static void *make_elements(const struct walk *w, void *record, const struct member *m, size_t n, size_t size) {
  if (m->most) return room(record, m->at);
  void *first = !n ? NULL : m->cap_at ? memset(ss_malloc(n * size), 0, n * size) : arena_alloc(w->a, n * size);
  memcpy(room(record, m->at), &first, sizeof first);
  return first;
}

static bool read_array(const struct walk *w, void *record, const struct member *m, const struct json_value *v) {
  size_t most = m->most ? (size_t)m->most : MOST_AUDIT_ELEMENTS;
  if (v->kind != JSON_KIND_ARRAY) return wrong(w, m, v, "must be an array");
  if (v->n > most) return wrong(w, m, v, "has too many elements");
  bool strings = m->kind == MEMBER_STRINGS;
  char *to = make_elements(w, record, m, v->n, strings ? sizeof(char *) : m->of->size);
  if (m->cap_at)
    *(size_t *)room(record, m->n_at) = *(size_t *)room(record, m->cap_at) = v->n;
  else
    *(int *)room(record, m->n_at) = (int)v->n;
  if (strings) return read_strings(w, (const char **)to, m, v);
  for (const struct json_value *e = v->first; e; e = e->next, to += m->of->size)
    if (!read_record(w, to, m->of, e)) return false;
  return true;
}

static bool read_pointed(const struct walk *w, void *record, const struct member *m, const struct json_value *v) {
  void *to = arena_alloc(w->a, m->of->size);
  memcpy(room(record, m->at), &to, sizeof to);
  return read_record(w, to, m->of, v);
}

/* Nothing, as the table writes it. */
static void set_nothing(void *record, const struct member *m) {
  if (m->kind == MEMBER_LONG) *(long *)room(record, m->at) = -1;
  if (m->kind == MEMBER_INT) *(int *)room(record, m->at) = -1;
  if (m->kind == MEMBER_WORD) memcpy(room(record, m->at), &m->n_words, sizeof m->n_words);
}

static bool read_member(const struct walk *w, void *record, const struct member *m, const struct json_value *v) {
  long n;
  if (v->kind == JSON_KIND_NULL && m->need == MEMBER_NULLABLE) {
    set_nothing(record, m);
    return true;
  }
  switch (m->kind) {
  case MEMBER_STRING:
    if (v->kind != JSON_KIND_STRING) return wrong(w, m, v, "must be a string");
    memcpy(room(record, m->at), &v->text, sizeof v->text);
    return true;
  case MEMBER_LONG:
    if (!read_whole(w, &n, m, v)) return false;
    *(long *)room(record, m->at) = n;
    return true;
  case MEMBER_INT:
    if (!read_whole(w, &n, m, v)) return false;
    *(int *)room(record, m->at) = (int)n;
    return true;
  case MEMBER_BOOL:
    if (v->kind != JSON_KIND_BOOL) return wrong(w, m, v, "must be true or false");
    *(bool *)room(record, m->at) = v->truth;
    return true;
  case MEMBER_WORD:
    return read_word(w, record, m, v);
  case MEMBER_STRINGS:
  case MEMBER_RECORDS:
    return read_array(w, record, m, v);
  case MEMBER_RECORD:
    return read_pointed(w, record, m, v);
  case MEMBER_PART:
    return read_record(w, room(record, m->at), m->of, v);
  case MEMBER_TOLD:
    break; /* when the rest is known */
  }
  return true;
}

/* Whether the member says what is told from the record. */
static bool agrees(const struct walk *w, const void *record, const struct member *m, const struct json_value *v) {
  OWNED(text) told = {0};
  OWNED(source) s;
  struct json j = {.out = &told};
  struct json_value again;
  m->tell(&j, NULL, record);
  source_from_string(&s, m->key, text_str(&told));
  bool same = json_parse(&again, w->a, &s, NULL) && json_same(&again, v);
  return same || wrong(w, m, v, "does not say what the rest of the file does");
}

/* Members that depend on others, when all are known. */
static bool finish(const struct walk *w, const void *record, const struct member *m, const struct json_value *v,
                   const struct json_value *object) {
  bool there = !m->when || m->when(record);
  if (!v && there && m->need != MEMBER_SPARSE) return wrong(w, m, object, "is missing here");
  if (v && !there) return wrong(w, m, v, "does not belong here");
  return !v || m->kind != MEMBER_TOLD || agrees(w, record, m, v);
}

static bool read_record(const struct walk *w, void *record, const struct shape *shape, const struct json_value *v) {
  if (v->kind != JSON_KIND_OBJECT) return diag_at(w->d, w->s, v->at, "an object is needed here");
  if (shape->blank) memcpy(record, shape->blank, shape->size);
  for (int i = 0; i < shape->n; i++) {
    const struct json_value *m = json_member(v, shape->member[i].key);
    if (m && !read_member(w, record, &shape->member[i], m)) return false;
  }
  for (int i = 0; i < shape->n; i++)
    if (!finish(w, record, &shape->member[i], json_member(v, shape->member[i].key), v)) return false;
  const char *why = shape->check ? shape->check(record) : NULL;
  if (why) diag_at(w->d, w->s, v->at, "%s", why);
  return !why;
}

bool shape_read(void *record, struct arena *a, const struct shape *shape, const struct json_value *v,
                const struct source *s, struct diag *d) {
  const struct walk w = {a, s, d};
  return read_record(&w, record, shape, v);
}
