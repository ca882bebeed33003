/* What the files that prove the stable layer share: the field (stable_field.c), two forms on tapes (stable_form.c), the
   same forms at points (stable_points.c); stable_forms.c goes through all forms with them. */
#ifndef STICKSLIP_STABLE_IMPL_H
#define STICKSLIP_STABLE_IMPL_H

#include "stable_forms.h"
#include "tape/exact.h"
#include "value/names.h"

/* --- The field: stable_field.c --- */

enum { N_POSITIVE = 6, STABLE_TERMS = 4096 };

/* A definition that has no counterpart in the corrected layer and yet a value there, by its record's attribute
   "equals". As an unknown it stands for that value. */
struct part {
  const char *name, *section, *equals;
  int rows, cols;
};

struct part_value {
  const struct part *part;
  struct num_vec value;
};

enum { MOST_PARTS = 32 };

/* The parameters by the frequencies, and the angles of the phases. */
struct stable_field {
  struct exact_field *field;
  struct calc c;                 /* of its elements and of the values of its tapes */
  element *frequency, *positive; /* two, N_POSITIVE */
  val chi, eta, g_1;
  struct part_value *part; /* values of parts that are held as unknowns */
  int n_parts;
  int status;
};

/* Sines and cosines are made of those of so many parts of their angles. */
void stable_field_make(struct stable_field *s, slong parts);
void stable_field_clear(struct stable_field *s);

/* --- Forms: stable_form.c --- */

/* The entries of what is replaced in one layer, as a tape. */
struct reading {
  struct elaboration el;
  const struct expr **e;
  slong n;
  size_t cap;
  struct text shapes; /* of the matrices that these are entries of */
  struct tape tape;
};

enum { N_HELD = 14, N_DIRECT = 8 };
extern const struct override stable_held[N_HELD];

/* All that may be an unknown: the parts proved so far, then those.  An attempt takes the first n. */
struct unknowns {
  struct override name[MOST_PARTS + N_HELD];
  struct part part[MOST_PARTS];
  int n, n_parts;
  bool algebra_alone;
  const struct model_use *asked; /* what the stable forms in question are made of; NULL: all forms are */
  int usable; /* of those that may be held, this many are known to be the same in both layers, or are not asked for */
};

void reading_init(struct reading *r, const struct model *m, enum layer layer, const struct unknowns *u);
void reading_clear(struct reading *r);
/* The entries of an expression added to the reading. */
bool reading_value(struct reading *r, const char *value, const char *section, struct diag *d);
/* Both sides of every relation of a record added to the reading. */
bool reading_record(struct reading *r, const struct statement_record *of, struct diag *d);
bool readings_same_shapes(const struct reading r[2]);
/* Sets p->why_not to the reason for which the two readings, whose tapes are made, are not shown equal, or to NULL. */
bool readings_compare(struct stable_proof *p, struct reading r[2], const struct model *m, const struct unknowns *u,
                      struct diag *d);

/* --- Points: stable_points.c --- */

/* Why points refuse the equality of two readings of one shape, or NULL; only_values: disagreement is not asked about,
   only whether the stable form has a value wherever the corrected one has. */
const char *readings_refused(const struct reading r[2], bool only_values);

#endif
