/* Elements of exact algebra and their fields as variables that clear themselves (local.h):

     FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
     ELEMENTS(x, y); */
#ifndef STICKSLIP_TESTS_ELEMENT_H
#define STICKSLIP_TESTS_ELEMENT_H

#include "local.h"
#include "model/model.h"
#include "tape/exact.h"

#define ELEMENTS(...)                                                                                                  \
  OWNED_CLEARED(exact_clear) fmpz_mpoly_q_struct __VA_ARGS__;                                                          \
  OWNED_EACH(OWNED_INIT, exact, __VA_ARGS__)

/* The value of a text in a field by the corrected formulas, as a function of free symbols: a status. */
int paper_value(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct model *of, const char *text);

#define FREED_FIELD OWNED_CLEARED(local_field_free)
static inline void local_field_free(struct exact_field **f) {
  exact_field_free(*f);
}

#endif
