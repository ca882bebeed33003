/* Writing JSON: two-space indent, keys in the order in which they are given, strings escaped. */
#ifndef STICKSLIP_JSON_H
#define STICKSLIP_JSON_H

#include "stickslip/text.h"

enum { JSON_DEPTH = 16 };

struct json {
  struct text *out;
  int depth;
  bool started[JSON_DEPTH]; /* the open container has a member */
};

void json_init(struct json *j, struct text *out);
/* key is NULL inside an array and at the top. */
void json_object(struct json *j, const char *key);
void json_array(struct json *j, const char *key);
void json_end_object(struct json *j);
void json_end_array(struct json *j);
void json_string(struct json *j, const char *key, const char *value); /* NULL writes null */
void json_long(struct json *j, const char *key, long value);
void json_bool(struct json *j, const char *key, bool value);
void json_null(struct json *j, const char *key);

#endif
