/* Variables that are cleared where their block ends, however it is left, the last one first; a failed check ends the
   test without that.

     LOCAL(text, t, u);                struct text t and u, made by text_init
     OWNED(num_vec) v = vec_of(...);   struct num_vec v, which the call makes, or one behind it
     NUMBERS(arb, x, y);               arb_t x and y, and so for the other types of FLINT
     MPFR_NUMBERS(128, x, y);          mpfr_t x and y of that precision
     FREED char *s = file_text(...);   memory from malloc
     FREED_PARAMS fmpq *p = rationals(...); N_PARAMS of them */
#ifndef STICKSLIP_TESTS_LOCAL_H
#define STICKSLIP_TESTS_LOCAL_H

#include <stdlib.h>

#include "motion/dynamics.h"
#include "num/flint_more.h"

#define LOCAL_CLEARED(by) __attribute__((cleanup(by), unused)) /* clearing is a use */

#define OWNED(kind) LOCAL_CLEARED(kind##_clear) struct kind

#define LOCAL(kind, ...)                                                                                               \
  OWNED(kind) __VA_ARGS__;                                                                                             \
  LOCAL_EACH(LOCAL_INIT, kind, __VA_ARGS__)
#define LOCAL_INIT(kind, x) kind##_init(&(x));

#define NUMBERS(kind, ...)                                                                                             \
  LOCAL_CLEARED(kind##_local_clear) kind##_t __VA_ARGS__;                                                              \
  LOCAL_EACH(LOCAL_NUMBER, kind, __VA_ARGS__)
#define LOCAL_NUMBER(kind, x) kind##_init(x);

#define MPFR_NUMBERS(prec, ...)                                                                                        \
  LOCAL_CLEARED(mpfr_local_clear) mpfr_t __VA_ARGS__;                                                                  \
  LOCAL_EACH(LOCAL_MPFR, prec, __VA_ARGS__)
#define LOCAL_MPFR(prec, x) mpfr_init2(x, prec);

#define FREED        LOCAL_CLEARED(local_free)
#define FREED_PARAMS LOCAL_CLEARED(local_params_clear)

#define LOCAL_CLEARING(kind)                                                                                           \
  static inline void kind##_local_clear(kind##_t *x) {                                                                 \
    kind##_clear(*x);                                                                                                  \
  }
LOCAL_CLEARING(arb)
LOCAL_CLEARING(arf)
LOCAL_CLEARING(mag)
LOCAL_CLEARING(fmpq)
LOCAL_CLEARING(fmpz)
LOCAL_CLEARING(fmpz_poly)
LOCAL_CLEARING(mpfr)

/* p is where the pointer stands. */
static inline void local_free(void *p) {
  free(*(void **)p);
}
static inline void local_params_clear(fmpq **p) {
  _fmpq_vec_clear(*p, N_PARAMS);
}

/* f(k, x) for each x of at most eight. */
#define LOCAL_EACH(f, k, ...)                      LOCAL_PICK(__VA_ARGS__, 8, 7, 6, 5, 4, 3, 2, 1, )(f, k, __VA_ARGS__)
#define LOCAL_PICK(a, b, c, d, e, f, g, h, n, ...) LOCAL_EACH_##n
#define LOCAL_EACH_1(f, k, x)                      f(k, x)
#define LOCAL_EACH_2(f, k, x, ...)                 f(k, x) LOCAL_EACH_1(f, k, __VA_ARGS__)
#define LOCAL_EACH_3(f, k, x, ...)                 f(k, x) LOCAL_EACH_2(f, k, __VA_ARGS__)
#define LOCAL_EACH_4(f, k, x, ...)                 f(k, x) LOCAL_EACH_3(f, k, __VA_ARGS__)
#define LOCAL_EACH_5(f, k, x, ...)                 f(k, x) LOCAL_EACH_4(f, k, __VA_ARGS__)
#define LOCAL_EACH_6(f, k, x, ...)                 f(k, x) LOCAL_EACH_5(f, k, __VA_ARGS__)
#define LOCAL_EACH_7(f, k, x, ...)                 f(k, x) LOCAL_EACH_6(f, k, __VA_ARGS__)
#define LOCAL_EACH_8(f, k, x, ...)                 f(k, x) LOCAL_EACH_7(f, k, __VA_ARGS__)

#endif
