/* What was meant by a word that is none of those known.

   A known word is near when so few edits make it of the other: one in words of 3 to 7 characters, two in longer ones,
   by the longer of both; none in shorter ones.  An edit adds, drops or replaces a character, or exchanges two
   neighbours; capital and small letters of ASCII are the same. */
#ifndef STICKSLIP_BASE_SUGGEST_H
#define STICKSLIP_BASE_SUGGEST_H

#include "text.h"

enum { SUGGEST_LONGEST = 64, SUGGEST_MOST = 3 };

/* The nearest so far, and by how many edits.  Words live until they are printed. */
struct suggestion {
  const char *word, *near[SUGGEST_MOST];
  size_t len, edits;
  int n;
};

/* The least number of edits, at most SUGGEST_LONGEST: of longer words nothing is said. */
size_t word_edits(const char *a, size_t n, const char *b, size_t m);

void suggest_begin(struct suggestion *s, const char *word, size_t len);
void suggest_try(struct suggestion *s, const char *known);
/* " (did you mean orbit?)", or up to three words in the order in which they were tried; nothing where none is near. */
void suggest_print(struct text *out, const struct suggestion *s);

#endif
