/* Formulas at extreme points: the truth in balls, the condition of each entry by symbolic derivatives, and what double
   precision makes of a layer's form. */
#ifndef STICKSLIP_TESTS_STABLE_POINTS_H
#define STICKSLIP_TESTS_STABLE_POINTS_H

#include "model/model.h"
#include "rng.h"

enum { MOST_ENTRIES = 16, MOST_INPUTS = 16 };

/* A formula of one layer in double precision, and its truth. */
struct extreme_form {
  struct elaboration el, exact;
  struct tape tape,
      truth; /* truth: of the stable layer, each entry followed by its derivatives by the truth's inputs */
  int n;
};

/* called: what the value is called in the stable layer. */
void extreme_form_init(struct extreme_form *f, const struct model *m, enum layer layer, const char *value,
                       const char *called, const char *section);
void extreme_form_clear(struct extreme_form *f);

/* Exact doubles for the inputs of both tapes, by name. */
struct extreme_point {
  struct rng rng;
  double chi, eta, scale, shift; /* shift: of times, relative */
};
/* Parameters of a region; the other quantities follow name by name. */
void extreme_point_draw(struct extreme_point *p, uint64_t seed);

/* Of each entry: the error in units of max(1, condition) 2^-53 of the truth, the condition being the sum of the entry's
   logarithmic derivatives by its inputs, there or at times some units of the last place away; -1 where the truth has no
   normal double, or the truth could not be told; infinity for an error status or a NaN. */
struct extreme_result {
  double loss[MOST_ENTRIES], condition[MOST_ENTRIES], truth[MOST_ENTRIES], value[MOST_ENTRIES];
};
void extreme_measure(struct extreme_result *r, struct extreme_form *f, const struct extreme_point *p);

/* The inputs at that point as NAME=hexadecimal, ... */
void extreme_print(struct text *out, const struct extreme_form *f, const struct extreme_point *p);

#endif
