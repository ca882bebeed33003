/* An expression in the paper's notation, made ready to be evaluated at points. */
#ifndef STICKSLIP_VALUE_EXPRESSION_H
#define STICKSLIP_VALUE_EXPRESSION_H

#include "model/model.h"
#include "tape/tape.h"
#include "values.h"
enum { EXPRESSION_MOST = 16 }; /* entries */

struct expression {
  struct tape tape;
  int n, rows; /* entries, and rows of them */
};
/* false with d set, or when it has too many entries; clear it all the same. */
bool expression_open(struct expression *x, struct view view, const char *expression, const char *section,
                     struct diag *d);
void expression_clear(struct expression *x);
/* The first symbol in it that makes it no number of a periodic solution: friction, a perturbation, the time; NULL:
   there is none. */
const char *expression_undetermined(const struct expression *x);
/* Its entries at a point, enclosed at prec bits. */
int expression_value(arb_ptr out, const struct expression *x, const struct point *p, slong prec,
                     struct orbit_cache *cache);

/* The entries of an expression at a point, enclosed at prec bits; count of them in *n (at most EXPRESSION_MOST). */
int expression_at(arb_ptr out, int *n, struct view v, const char *expression, const char *section,
                  const struct point *p, slong prec, struct orbit_cache *cache, struct diag *d);

/* The same of an expression that is one number; SS_UNABLE where it has more entries, or the solution
   does not determine it. */
int expression_number(arb_t z, struct view v, const char *expression, const char *section, const struct point *p,
                      slong prec, struct orbit_cache *cache, struct diag *d);

/* A formula as a tape by itself, the names of the list held as unknowns.  false where it cannot be read; clear it all
   the same. */
bool formula_tape(struct tape *t, struct view v, const char *formula, const char *section, const struct override *o,
                  int n);

/* The outputs of a tape at a point, in the context of out; *known is false where a symbol has no value at such a
   point. */
int tape_at_point(struct num_vec *out, bool *known, const struct tape *t, const struct point *p,
                  struct orbit_cache *cache);

#endif
