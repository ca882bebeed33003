/* Variables that are cleared where their block ends, as in base/owned.h, and these besides; a failed check ends the test
   without that.

     MPFR_NUMBERS(128, x, y);          mpfr_t x and y of that precision
     FREED_PARAMS fmpq *p = rationals(...); N_PARAMS of them */
#ifndef STICKSLIP_TESTS_LOCAL_H
#define STICKSLIP_TESTS_LOCAL_H

#include "motion/dynamics.h"
#include "num/flint_more.h"

#define MPFR_NUMBERS(prec, ...)                                                                                        \
  OWNED_CLEARED(mpfr_owned_clear) mpfr_t __VA_ARGS__;                                                                  \
  OWNED_EACH(LOCAL_MPFR, prec, __VA_ARGS__)
#define LOCAL_MPFR(prec, x) mpfr_init2(x, prec);

#define FREED_PARAMS OWNED_CLEARED(local_params_clear)

OWNED_CLEARING(mpfr)

static inline void local_params_clear(fmpq **p) {
  _fmpq_vec_clear(*p, N_PARAMS);
}

#endif
