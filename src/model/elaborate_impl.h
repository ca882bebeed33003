/* What the files of an elaboration share: where a formula is seen from, the limits of its size, and the matrices that
   it is made of.  elaborate.c walks over trees and calls matrix.c and polynomial.c, which know of no names. */
#ifndef STICKSLIP_ELABORATE_IMPL_H
#define STICKSLIP_ELABORATE_IMPL_H

#include "model.h"
#include "num/num.h"

/* MAX_DEPTH bounds the recursion over brackets, calls and definitions together, MAX_SCALARS the memory (the paper
   with all its statements has a few thousand). */
enum { MAX_DEPTH = 1000, MAX_SCALARS = 500000 };

/* Where an expression is seen from. */
struct scope {
  const struct source *src;
  const char *section;
  const char *param;        /* the formal parameter of the function being elaborated, or NULL */
  const char *param_symbol; /* the symbol that stands for it */
  const char *unknown;      /* the name that a root's own polynomial is about, or NULL */
  const char *unknown_symbol;
};

/* --- matrix.c --- */

/* Reports what is wrong with the shape of a, or of a and b (each may be NULL), at the place of e; false. */
bool form_mistake(const struct scope *sc, const struct expr *e, struct diag *d, const char *what,
                  const struct matrix *a, const struct matrix *b);

struct matrix matrix_new(struct elaboration *el, int rows, int cols);
struct matrix matrix_scalar(struct elaboration *el, const struct expr *e);

static inline const struct expr *matrix_at(const struct matrix *m, int i, int j) {
  return m->e[i * m->cols + j];
}
static inline int matrix_entries(const struct matrix *m) {
  return m->rows * m->cols;
}
static inline bool matrix_is_scalar(const struct matrix *m) {
  return m->rows == 1 && m->cols == 1;
}
static inline bool matrix_same_shape(const struct matrix *a, const struct matrix *b) {
  return a->rows == b->rows && a->cols == b->cols;
}

/* Gives a literal zero on one side the shape of the other; ta and tb are the trees of a and b. */
void matrix_shape_zero(struct matrix *a, struct matrix *b, struct elaboration *el, const struct expr *ta,
                       const struct expr *tb);

/* m is the value of the first operand of the form e, b that of the second, and m becomes the value of e; false,
   reported, where the shapes do not fit. */
bool matrix_sum(struct matrix *m, const struct matrix *b, struct elaboration *el, const struct expr *e,
                const struct scope *sc, struct diag *d);
bool matrix_product(struct matrix *m, const struct matrix *b, struct elaboration *el, const struct expr *e,
                    const struct scope *sc, struct diag *d);
bool matrix_quotient(struct matrix *m, const struct matrix *b, struct elaboration *el, const struct expr *e,
                     const struct scope *sc, struct diag *d);
bool matrix_hypot(struct matrix *m, const struct matrix *b, struct elaboration *el, const struct expr *e,
                  const struct scope *sc, struct diag *d);
/* Traces, determinants and inverses. */
bool matrix_square(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                   struct diag *d);
/* Entries and blocks. */
bool matrix_index(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                  struct diag *d);
/* Signs and roundings of every entry; powers and functions of a scalar. */
bool matrix_entrywise(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                      struct diag *d);
void matrix_transpose(struct matrix *m, struct elaboration *el);
/* Terms of the first order in n small symbols. */
void matrix_first_order(struct matrix *m, struct elaboration *el, const char *const *small, int n);
/* The matrix literal e put together from the values of its entries, which may be matrices. */
bool matrix_of_blocks(struct matrix *out, const struct matrix *block, struct elaboration *el, const struct expr *e,
                      const struct scope *sc, struct diag *d);

/* --- polynomial.c --- */

/* Adds the root that the definition declares, of the polynomial in the symbol, to the elaboration's roots. */
bool elaboration_add_root(struct elaboration *el, const struct definition *def, const char *symbol,
                          const struct expr *poly, struct diag *d);

#endif
