/* Variables that are cleared where their block ends, as in base/owned.h, and these besides; a failed check ends the
   test without that.

     FREED_PARAMS fmpq *p = rationals(...); N_PARAMS of them
     BALLS(n, x, y);                   arb_ptr x and y: n of them each
     RATIONALS(q, n, rationals(...));  fmpq *q: n of them */
#ifndef STICKSLIP_TESTS_LOCAL_H
#define STICKSLIP_TESTS_LOCAL_H

#include "motion/dynamics.h"
#include "num/flint_more.h"

#define FREED_PARAMS OWNED_CLEARED(local_params_clear)

#define BALLS(n, ...)     OWNED_EACH(LOCAL_BALLS, n, __VA_ARGS__)
#define LOCAL_BALLS(n, x) ARB_VECTOR(x, n);
#define RATIONALS(x, n, ...)                                                                                           \
  OWNED_CLEARED(local_rationals_clear) struct local_rationals x##_owned = {__VA_ARGS__, n};                            \
  fmpq *const x = x##_owned.first

struct local_rationals {
  fmpq *first;
  slong n;
};

static inline void local_params_clear(fmpq **p) {
  _fmpq_vec_clear(*p, N_PARAMS);
}
static inline void local_rationals_clear(struct local_rationals *v) {
  _fmpq_vec_clear(v->first, v->n);
}

#endif
