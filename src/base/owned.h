/* Variables that are cleared where their block ends, however it is left, the last one first.

     OWNED(tape) t = {.n = 0};     struct tape t, which tape_clear clears; what makes it stands here or behind it,
                                   before anything can leave the block
     LOCAL(text, t, u);            struct text t and u, made by text_init
     NUMBERS(arb, x, y);           arb_t x and y, and so for other types of FLINT
     SIZED(arb_mat, a, n, n);      arb_mat_t a, made by arb_mat_init(a, n, n)
     FREED char *s = ...;          memory from malloc, or NULL

   What a block returns is computed before anything is cleared.  The attribute is one of gcc and of every compiler that
   follows it. */
#ifndef STICKSLIP_BASE_OWNED_H
#define STICKSLIP_BASE_OWNED_H

#include <stdlib.h>

#define OWNED_CLEARED(by) __attribute__((cleanup(by), unused)) /* clearing is a use */

#define OWNED(kind) OWNED_CLEARED(kind##_clear) struct kind

#define LOCAL(kind, ...)                                                                                               \
  OWNED(kind) __VA_ARGS__;                                                                                             \
  OWNED_EACH(OWNED_INIT, kind, __VA_ARGS__)
#define OWNED_INIT(kind, x) kind##_init(&(x));

#define NUMBERS(kind, ...)                                                                                             \
  OWNED_CLEARED(kind##_owned_clear) kind##_t __VA_ARGS__;                                                              \
  OWNED_EACH(OWNED_NUMBER, kind, __VA_ARGS__)
#define OWNED_NUMBER(kind, x) kind##_init(x);

#define SIZED(kind, x, ...)                                                                                            \
  OWNED_CLEARED(kind##_owned_clear) kind##_t x;                                                                        \
  kind##_init(x, __VA_ARGS__)

#define FREED OWNED_CLEARED(owned_free)
/* p is where the pointer stands. */
static inline void owned_free(void *p) {
  free(*(void **)p);
}

/* Of a type of FLINT, whose variables are arrays of one element. */
#define OWNED_CLEARING(kind)                                                                                           \
  static inline void kind##_owned_clear(kind##_t *x) {                                                                 \
    kind##_clear(*x);                                                                                                  \
  }

/* f(k, x) for each x of at most eight. */
#define OWNED_EACH(f, k, ...)                      OWNED_PICK(__VA_ARGS__, 8, 7, 6, 5, 4, 3, 2, 1, )(f, k, __VA_ARGS__)
#define OWNED_PICK(a, b, c, d, e, f, g, h, n, ...) OWNED_EACH_##n
#define OWNED_EACH_1(f, k, x)                      f(k, x)
#define OWNED_EACH_2(f, k, x, ...)                 f(k, x) OWNED_EACH_1(f, k, __VA_ARGS__)
#define OWNED_EACH_3(f, k, x, ...)                 f(k, x) OWNED_EACH_2(f, k, __VA_ARGS__)
#define OWNED_EACH_4(f, k, x, ...)                 f(k, x) OWNED_EACH_3(f, k, __VA_ARGS__)
#define OWNED_EACH_5(f, k, x, ...)                 f(k, x) OWNED_EACH_4(f, k, __VA_ARGS__)
#define OWNED_EACH_6(f, k, x, ...)                 f(k, x) OWNED_EACH_5(f, k, __VA_ARGS__)
#define OWNED_EACH_7(f, k, x, ...)                 f(k, x) OWNED_EACH_6(f, k, __VA_ARGS__)
#define OWNED_EACH_8(f, k, x, ...)                 f(k, x) OWNED_EACH_7(f, k, __VA_ARGS__)

#endif
