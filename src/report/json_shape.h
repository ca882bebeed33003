/* Records and their JSON by one table for each kind of record.  The writer and the reader walk the same table, so that
   neither knows a member that the other does not. */
#ifndef STICKSLIP_REPORT_JSON_SHAPE_H
#define STICKSLIP_REPORT_JSON_SHAPE_H

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

#define SHAPE(name, type, ...)                                                                                         \
  const struct shape name = {name##_member, (int)(sizeof name##_member / sizeof *name##_member), sizeof(type),         \
                             __VA_ARGS__}

void shape_write(struct json *j, const char *key, const struct shape *shape, const void *record);
/* Fills a record of zeros; strings are those of the value, arrays live in the arena or, where the table says so, on the
   heap.  Members that the table does not name are passed over.  false with d set, at the place, otherwise. */
bool shape_read(void *record, struct arena *a, const struct shape *shape, const struct json_value *v,
                const struct source *s, struct diag *d);

#endif
