/* Cases as data: tables of tests/cases, tests/hostile and tests/oracle.  A row is a line, its fields stand between
   tabs; a line that begins with # is a comment.  In a field \n, \t, \r, \\ and \xHH are what they are in C. */
#ifndef STICKSLIP_TESTS_TABLE_H
#define STICKSLIP_TESTS_TABLE_H

enum { MOST_COLUMNS = 80, ANY_COLUMNS = 0 };

#include <stdbool.h>

#include "base/text.h"

struct table {
  int n;
  char *(*row)[MOST_COLUMNS];
  char *text;
};

/* Reads a table in which each row has that many fields, or any number; ends the tests where it cannot. */
struct table table_read(const char *path, int columns); /* to be cleared */
void table_clear(struct table *t);

/* A field with what it abbreviates: @N{TEXT} is TEXT N times, @D the scratch folder, @F a path in it that has no
   extension yet, @0 a NUL; {NAME} is what the list, of pairs of names and texts, has for it (NULL: there is none). */
void field_expand(struct text *out, const char *field, const char *const (*list)[2]);

/* Each part of a field, with " && " between parts, stands in what was said: "^" before what that begins with, "$"
   before what it ends with, "=" before all of it, and "!" before a part that does not stand there.  The list: as above;
   what: the row. */
void check_said(const char *said, const char *parts, const char *const (*list)[2], const char *what);

/* Whether a field says yes; fails the test where it says neither that nor no. */
bool is_yes(const char *field);

/* The first row that begins with this field and, unless NULL, that one; fails the test where there is none. */
int table_row(const struct table *t, const char *first, const char *second);

/* Whether the rows of a table of one column stand in a text in this order; fails the test where they do not. */
void check_order(const char *text, const char *path);

#endif
