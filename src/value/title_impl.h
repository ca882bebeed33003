/* What the files of title.h share: the words for a claim's records, lists, phases and places. */
#ifndef STICKSLIP_TITLE_IMPL_H
#define STICKSLIP_TITLE_IMPL_H

#include "claim/claim.h"
#include "motion/dynamics.h"
#include "title.h"

struct title {
  const struct model *m;
  const struct claim *c;
  const struct scene *s; /* whose printed numbers are meant; NULL: those that the paper quotes */
  struct diag *d;
};

/* "the global stick phase", "the slip-stick and global slip phases", "every phase"; of phases in the order given. */
void title_phases(struct text *out, const enum phase *phase, int n);
/* The phases of a list of letters with blanks or commas between. */
void title_phases_listed(struct text *out, const char *list);
/* "two" to "twelve"; else digits. */
void title_count(struct text *out, long n);
/* Is the word, of that length, one of them? */
bool title_is_count(const char *word, size_t len);

/* Items as "a", "a and b", "a, b and c", each once; how many there are. */
struct title_list {
  struct text item[32];
  int n;
};
void title_list_clear(struct title_list *l);
/* The next item, to be written; the last one again when there is no more room. */
struct text *title_list_next(struct title_list *l);
int title_list_write(struct text *out, struct title_list *l);
/* A list with commas or semicolons between, as such a list. */
int title_listed(struct text *out, const char *list, char between);

/* Does the paper define the name, of that length? */
bool title_defines(const struct model *m, const char *name, size_t len);
/* The record of that id in the paper's own files, or NULL. */
const struct statement_record *title_record(const struct title *t, const char *id, size_t len);
/* The same as it is judged: corrected, unless the claim is about that equation; not in its stable form. */
const struct statement_record *title_judged(const struct title *t, const char *id, size_t len);
/* The error at the attribute that names the item, or at the claim's head. */
void title_no_record(const struct title *t, const char *attribute, const char *item);
/* All that a record says, as formulas; the first of them. */
void title_formulas(struct text *out, const struct title *t, const struct statement_record *r);
/* Of a paper about another system, with what statement_is_condition tells: "a = b and c = d when x > 0". */
void title_conditional(struct text *out, const struct title *t, const struct statement_record *r);
void title_first_formula(struct text *out, const struct statement_record *r);
/* No other record of the paper states something under the same number. */
bool title_owns_number(const struct title *t, const struct statement_record *r);
/* "(18) and (16)": the note of a record that has no number, where it begins and ends with that of another, and when
   brief "(55) at t = 0", where it begins with one; else NULL. */
const char *title_note(const struct statement_record *r, bool brief);
/* A record by its note where that names others; by its equation number where it has one; else by its formulas. */
void title_name(struct text *out, const struct title *t, const struct statement_record *r);
/* Items as formulas; by number where a formula is no shorter; by number wherever there is one. */
enum title_detail { TITLE_FORMULAS, TITLE_BRIEF, TITLE_NUMBERS };
/* Which items are written: all, or those that are equations alone, or those that are not. */
enum title_items { TITLE_ALL, TITLE_EQUATIONS, TITLE_INEQUALITIES };
/* Items "eq-59#1.2, eq-56 D" of an attribute, each once.  Scanned, over one attribute or two: one is the phase of those
   that are written as formulas, where all have the same, and is left to be said behind them.  false with t->d set when
   there is no such record. */
struct title_parts {
  enum title_detail detail;
  enum phase one;
  bool several; /* phases: each formula says its own */
  enum title_items items;
};
/* Are there such premises? */
bool title_has_premises(const struct title *t, enum title_items items);
bool title_parts_scan(struct title_parts *p, const struct title *t, const char *attribute);
bool title_parts_write(struct text *out, struct title_parts *p, const struct title *t, const char *attribute);
/* Whether the first item's statement speaks of the time t. */
bool title_moves(const struct title *t, const char *attribute);
/* An attribute that is an expression or a relation, as a reader writes it. */
bool title_formula(struct text *out, const struct title *t, const char *attribute);
/* Does the claim's statement say at which times it is meant?  Then in which phase; N_PHASES: it is not one alone. */
bool title_range(enum phase *phase, const struct title *t);
/* " in the global slip phase of every admissible orbit", from points; "" where nothing is to be said. */
void title_place(struct text *out, const struct title *t, const char *points);
/* Of a paper about another system, behind what the record states: " wherever both sides have values". */
void title_domain(struct text *out, const struct title *t, const struct statement_record *r);
/* Does the text speak of several things? */
bool title_is_plural(const char *text);

/* The attribute title, with what stands in braces; it names nothing by hand. */
bool title_given(struct text *out, const struct title *t, const struct field *title);
/* The same of a text of ours. */
bool title_expand(struct text *out, const struct title *t, const char *text);

#endif
