/* What a claim says, in one line of plain text.

   Titles are made from the other attributes of the claim, so that a claim cannot say one thing and be another: the
   statement as a reader writes it (or "what (5) states" where it is long), and where it is claimed, from "points"; of a
   matrix its name and what the model's quantity is (value/oracle.h); of an argument what follows from what; and so on
   for every kind but outside.

   Where these make none the attribute title is given, a sentence in words.  What stands in braces is the attribute of
   that name, as the titles that are made write it: {statement}, {premises}, {depends-on} (records, by their equation
   numbers), {range} ("two to four"), {formula}, {value}, {side}.  A formula, a name of the paper, a number (in digits,
   or a word from two to twelve) or the name of a phase outside braces is an error: nothing would hold it against the
   claim. */
#ifndef STICKSLIP_TITLE_H
#define STICKSLIP_TITLE_H

#include "claim/claims.h"
#include "model/model.h"
#include "motion/dynamics.h"
#include "scene/scene.h"

/* What the paper calls the phases: "global stick", ... */
extern const char *const phase_words[N_PHASES];
/* Appends the title.  Of a printed number it has the scene's decimal; without a scene (NULL), or in one that prints no
   such number, the decimal that the paper quotes.  false with d set where the title is at fault, or is not given and
   cannot be made. */
bool claim_title(struct text *out, const struct model *m, const struct claim *c, const struct scene *s, struct diag *d);
/* Appends the records that an attribute of the claim lists as its title would say them, by number wherever there is
   one: "(51), (57) and z_1' < V in the global slip phase".  false with d set where there is no such record. */
bool claim_title_records(struct text *out, const struct model *m, const struct claim *c, const char *attribute,
                         struct diag *d);
/* The letter that is an index in a formula, as the i of x_i; 0 where there is none. */
char title_index(const char *formula);
/* Whether every claim has one, by hand only where its attributes make none; false with d set to the first fault. */
bool titles_check(const struct model *m, const struct claims *claims, struct diag *d);

#endif
