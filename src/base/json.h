/* JSON.  Writing: two-space indent, keys in the order in which they are given, strings escaped.  Reading: RFC 8259 to
   the letter, into a tree, but for strings that hold what text does not (text_plain_prefix). */
#ifndef STICKSLIP_BASE_JSON_H
#define STICKSLIP_BASE_JSON_H

#include "arena.h"
#include "status.h"
#include "text.h"

enum { JSON_DEPTH = 16 };

struct json {
  struct text *out;
  int depth;
  size_t string;            /* where one that is being made begins */
  bool started[JSON_DEPTH]; /* the open container has a member */
};

/* Begins a document: an object with its schema first, where it has one.  OWNED(json) j = json_document(...) ends where
   its block does. */
struct json json_document(struct text *out, const char *schema);
void json_clear(struct json *j);
/* key is NULL inside an array and at the top. */
void json_object(struct json *j, const char *key);
void json_array(struct json *j, const char *key);
void json_end_object(struct json *j);
void json_end_array(struct json *j);
/* An object that ends where its block does. */
#define JSON_OBJECT(j, key)        JSON_OBJECT_AT(j, key, __LINE__)
#define JSON_OBJECT_AT(j, key, at) JSON_OBJECT_IN(j, key, at)
#define JSON_OBJECT_IN(j, key, at) OWNED_CLEARED(json_object_clear) struct json *object_##at = (json_object(j, key), j)
static inline void json_object_clear(struct json **j) {
  json_end_object(*j);
}
/* An array of n elements, each written by the statement behind it, which counts them by i. */
#define JSON_EACH(j, key, i, n)                                                                                        \
  for (int open_##i = (json_array(j, key), 1); open_##i; open_##i = (json_end_array(j), 0))                            \
    for (int i = 0; i < (int)(n); i++)
void json_string(struct json *j, const char *key, const char *value); /* NULL writes null */
/* A string that a call makes in its place: what it adds to j->out, as that is to be read back. */
#define JSON_STRING(j, key, call) (json_begin_string(j, key), (void)(call), json_end_string(j))
void json_begin_string(struct json *j, const char *key);
void json_end_string(struct json *j);
void json_printf(struct json *j, const char *key, const char *fmt, ...) SS_PRINTF(3, 4);
/* A number as a string in that format; null where it is not finite. */
void json_double(struct json *j, const char *key, const char *fmt, double x);
/* An array of strings. */
void json_string_array(struct json *j, const char *key, const char *const *list, int n);
void json_long(struct json *j, const char *key, long value);
void json_bool(struct json *j, const char *key, bool value);
void json_null(struct json *j, const char *key);
/* Writes null where the value is not known.  Returns known: whether the caller is to write it. */
bool json_or_null(struct json *j, const char *key, bool known);

/* --- Reading --- */

enum json_kind {
  JSON_KIND_NULL,
  JSON_KIND_BOOL,
  JSON_KIND_NUMBER,
  JSON_KIND_STRING,
  JSON_KIND_ARRAY,
  JSON_KIND_OBJECT
};

/* Containers nested deeper are an error, and so are objects with more members: what looks members up does so in
   order. */
enum { JSON_READ_DEPTH = 64, JSON_READ_MEMBERS = 1000 };

struct json_value {
  enum json_kind kind;
  bool truth;                     /* of a bool */
  const char *key;                /* of a member of an object; NULL elsewhere */
  const char *text;               /* of a string; of a number as it is written */
  size_t at;                      /* where in the source it begins */
  size_t n;                       /* elements or members */
  const struct json_value *first; /* the first of them */
  const struct json_value *next;  /* the one behind this one in its container */
};

/* The source as one value.  Keys of an object are distinct, strings are text_plain_prefix, with lines; memory is in the
   arena, at most some fifty times the source's length.  false with d set, at the place, otherwise. */
bool json_parse(struct json_value *out, struct arena *a, const struct source *s, struct diag *d);
/* The member of that name; NULL when there is none or v is no object. */
const struct json_value *json_member(const struct json_value *v, const char *key);
/* The string that a member holds; NULL when it holds something else. */
const char *json_text(const struct json_value *v, const char *key);
/* Whether it holds that string; false where that is NULL. */
bool json_says(const struct json_value *v, const char *key, const char *what);
/* Whether two values say the same; the order of members does not matter, numbers are compared as written. */
bool json_same(const struct json_value *a, const struct json_value *b);

#endif
