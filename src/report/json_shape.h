/* Records and their JSON by one table for each kind of record.  The writer and the reader walk the same table, so that
   neither knows a member that the other does not. */
#ifndef STICKSLIP_REPORT_JSON_SHAPE_H
#define STICKSLIP_REPORT_JSON_SHAPE_H

#include <stddef.h>

#include "base/json.h"
#include "record/result.h"

enum member_kind {
  MEMBER_STRING,  /* const char * */
  MEMBER_LONG,    /* long, not negative */
  MEMBER_INT,     /* int, not negative */
  MEMBER_BOOL,    /* bool */
  MEMBER_WORD,    /* an enumeration by its names; their number stands for none of them */
  MEMBER_STRINGS, /* an array of strings and its int */
  MEMBER_RECORDS, /* an array of records and its int or size_t */
  MEMBER_RECORD,  /* a pointer to a record, or NULL */
  MEMBER_PART,    /* an object made of fields of the record itself; nothing when the first of them is a NULL string */
  MEMBER_TOLD     /* told from the rest of the record; read, it must say the same */
};
/* Where there is nothing (NULL, -1, no elements, none of the words): impossible, written as null, or left out. */
enum member_need { MEMBER_NEEDED, MEMBER_NULLABLE, MEMBER_SPARSE };

struct shape;
struct member {
  const char *key;
  enum member_kind kind;
  enum member_need need;
  size_t at;               /* offset of the field */
  size_t n_at;             /* of an array's number of elements */
  size_t cap_at;           /* of a heap array's capacity, its number being a size_t; 0: the arena's, and an int */
  int most;                /* of an array that lies in the record itself: its length; 0: a pointer */
  const char *const *word; /* MEMBER_WORD */
  int n_words;
  const struct shape *of;
  bool (*when)(const void *record); /* NULL, or whether the member is there */
  void (*tell)(struct json *j, const char *key, const void *record);
};
struct shape {
  const struct member *member;
  int n;
  size_t size;                              /* of a record */
  const void *blank;                        /* what a record is before it is read; NULL: zeros */
  const char *(*check)(const void *record); /* NULL, or what is wrong with a record that was read, or NULL */
};

/* A shape of these members of struct type; with what a record is before it is read, and its check. */
#define SHAPE(name, type, ...) SHAPE_WITH(name, type, NULL, NULL, __VA_ARGS__)
#define SHAPE_WITH(name, type, blank, check, ...)                                                                      \
  const struct shape name = {(const struct member[]){__VA_ARGS__},                                                     \
                             (int)(sizeof((const struct member[]){__VA_ARGS__}) / sizeof(struct member)),              \
                             sizeof(struct type), blank, check}

/* Members that bear the names of their fields, of at most seven fields in their order: strings that are needed,
   nullable or sparse, numbers and truths that are needed. */
#define NEEDED(type, ...)   MEMBER_EACH(NEEDED_MEMBER, type, __VA_ARGS__)
#define NULLABLE(type, ...) MEMBER_EACH(NULLABLE_MEMBER, type, __VA_ARGS__)
#define SPARSE(type, ...)   MEMBER_EACH(SPARSE_MEMBER, type, __VA_ARGS__)
#define LONGS(type, ...)    MEMBER_EACH(LONG_MEMBER, type, __VA_ARGS__)
#define INTS(type, ...)     MEMBER_EACH(INT_MEMBER, type, __VA_ARGS__)
#define BOOLS(type, ...)    MEMBER_EACH(BOOL_MEMBER, type, __VA_ARGS__)

#define MEMBER(kind_, need_, k, type, field)                                                                           \
  { .key = k, .kind = kind_, .need = need_, .at = offsetof(struct type, field) }
#define WORD_MEMBER(k, type, name, need_, words, n)                                                                    \
  { .key = k, .kind = MEMBER_WORD, .need = need_, .at = offsetof(struct type, name), .word = words, .n_words = n }
#define TOLD(k, how)                                                                                                   \
  { .key = k, .kind = MEMBER_TOLD, .tell = how }
/* An array of records on the heap. */
#define RECORDS_OF(need_, k, type, field, count, capacity, shape)                                                      \
  {                                                                                                                    \
    .key = k, .kind = MEMBER_RECORDS, .need = need_, .at = offsetof(struct type, field),                               \
    .n_at = offsetof(struct type, count), .cap_at = offsetof(struct type, capacity), .of = shape                       \
  }
#define NEEDED_MEMBER(type, f)                   MEMBER(MEMBER_STRING, MEMBER_NEEDED, #f, type, f)
#define NULLABLE_MEMBER(type, f)                 MEMBER(MEMBER_STRING, MEMBER_NULLABLE, #f, type, f)
#define SPARSE_MEMBER(type, f)                   MEMBER(MEMBER_STRING, MEMBER_SPARSE, #f, type, f)
#define LONG_MEMBER(type, f)                     MEMBER(MEMBER_LONG, MEMBER_NEEDED, #f, type, f)
#define INT_MEMBER(type, f)                      MEMBER(MEMBER_INT, MEMBER_NEEDED, #f, type, f)
#define BOOL_MEMBER(type, f)                     MEMBER(MEMBER_BOOL, MEMBER_NEEDED, #f, type, f)
#define MEMBER_EACH(m, t, ...)                   MEMBER_PICK(__VA_ARGS__, 7, 6, 5, 4, 3, 2, 1, )(m, t, __VA_ARGS__)
#define MEMBER_PICK(a, b, c, d, e, f, g, n, ...) MEMBER_EACH_##n
#define MEMBER_EACH_1(m, t, f)                   m(t, f)
#define MEMBER_EACH_2(m, t, f, ...)              m(t, f), MEMBER_EACH_1(m, t, __VA_ARGS__)
#define MEMBER_EACH_3(m, t, f, ...)              m(t, f), MEMBER_EACH_2(m, t, __VA_ARGS__)
#define MEMBER_EACH_4(m, t, f, ...)              m(t, f), MEMBER_EACH_3(m, t, __VA_ARGS__)
#define MEMBER_EACH_5(m, t, f, ...)              m(t, f), MEMBER_EACH_4(m, t, __VA_ARGS__)
#define MEMBER_EACH_6(m, t, f, ...)              m(t, f), MEMBER_EACH_5(m, t, __VA_ARGS__)
#define MEMBER_EACH_7(m, t, f, ...)              m(t, f), MEMBER_EACH_6(m, t, __VA_ARGS__)

void shape_write(struct json *j, const char *key, const struct shape *shape, const void *record);
/* Fills a record of zeros; strings are those of the value, arrays live in the arena or, where the table says so, on the
   heap.  Members that the table does not name are passed over.  false with d set, at the place, otherwise. */
bool shape_read(void *record, struct arena *a, const struct shape *shape, const struct json_value *v,
                const struct source *s, struct diag *d);

#endif
