/* The population of damaged data: what a tired transcriber would make of TeX, quotations, numbers and the lines of
   claims and controls. */
#ifndef STICKSLIP_POWER_DAMAGES_H
#define STICKSLIP_POWER_DAMAGES_H

#include "material.h"
#include "record/mutation_result.h"

/* Some bytes of a file are others. */
struct damage {
  enum damage_class class;
  size_t file; /* of the material */
  size_t begin, end;
  const char *now;       /* in the place of these bytes */
  const char *record;    /* its id; "" before the first */
  const char *attribute; /* "" where a whole record or a typed line is damaged */
  const char *rule;      /* why it says the same, or NULL */
  const char *excuse;    /* why it says the same where nothing notices it, or NULL */
};

struct damages {
  struct arena arena;
  struct damage *damage;
  size_t n, cap;
};

/* Every damage, class after class, in the order of the files:

     TeX            an index changed, a sign or a relation turned, a letter for a similar one, a factor, a prime or an
                    accent dropped, a bar moved or dropped, the first two rows exchanged, a digit changed
     quotation      a digit changed, a word dropped, a sign or a relation turned, a bar moved
     printed number a digit changed, two digits exchanged
     premise        one dropped, the next record for one, the conclusion among them
     conclusion     one dropped, the next record for one, another step, the converse not asked for
     points         one of a list dropped, their number cut to one, another set or phase
     routes         one dropped, another in its place
     tolerance      finite or first order, <, > and =, printed or computed, how many equations, friction
     domain         parameters, the orbits meant, phases, the scene of the record
     correction     a digit, a sign or a relation in the text; of an argument a premise
     restriction    the same; another name; none
     control        deleted, of a neighbouring claim, without its damage, or with another
     title          a number, a name, a phase or a direction for another

   Two items of a list exchanged say the same; such a damage names the rule.  Other parameters to try, a route that is
   as independent, or a control that is wrong by another digit or sign say the same where nothing notices them.  Only
   those of the named files, records or classes ("4-stability", "eq-40", "title") when n_only > 0. */
void damages_init(struct damages *out, const struct material *m, const char *const *only, int n_only);
void damages_clear(struct damages *d);
/* Is some of them in the file or record, or of the class, of that name? */
bool damages_any(const struct damages *d, const struct material *m, const char *item);

/* The file's text with the damage in it. */
void damage_text(struct text *out, const struct material *m, const struct damage *d);

#endif
