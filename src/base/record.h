/* The one reader of equation, claim, control and scene files.

     # a comment runs to the end of the line
     title: text up to the end of the line,
       continued by lines indented deeper than the field itself
     chi = 0.8

     define J_a
       equation: 27
       J_a = 1/(1 - chi) * [-1, 1]

   A record is a head line "kind id" (two words in the first column, the second of at most 40 letters, digits and
   -_.'), followed by fields.  A field is an attribute, "word: text" (one lower-case word directly followed by a colon
   that is not part of ":="), or a formula, anything else.  Fields before the first head belong to record 0, which has
   no kind and no id and always exists; elsewhere fields are indented.  A field goes on over the following lines that
   are indented deeper than it; blank lines and comment lines are passed over.  In an attribute # is an ordinary
   character unless it begins a line.  Formulas are kept as spans of the source for expr.h to read. */
#ifndef STICKSLIP_BASE_RECORD_H
#define STICKSLIP_BASE_RECORD_H

#include "text.h"

struct field {
  bool attribute;
  struct span key;   /* attributes only: the word before the colon */
  char *key_name;    /* the same as text */
  struct span value; /* without leading and trailing blanks; may be empty */
  char *text;        /* attributes only: the value with continuation lines joined by single spaces */
};

struct record {
  struct span kind, id; /* empty for record 0 */
  char *kind_name, *id_name;
  char *number; /* 44 of eq-44b, err-44 or stable-44; else NULL */
  struct field *fields;
  size_t n_fields, cap_fields;
};

struct record_file {
  struct source src;
  struct record *records;
  size_t n_records, cap_records;
};

/* Takes src over (also on failure: record_file_clear frees it).  At most 100000 fields.  false with d set on
   failure. */
bool record_file_parse(struct record_file *f, struct source src, struct diag *d);
void record_file_clear(struct record_file *f);

/* The text of the first attribute of that name, or NULL; of "equation", where there is none, the number in the id. */
const char *record_get(const struct record *r, const char *key);
/* The field itself, for diagnostics, or NULL. */
const struct field *record_field(const struct record *r, const char *key);

#endif
