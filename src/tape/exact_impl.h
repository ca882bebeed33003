/* What the files about exact fields share: the field with its generators, and the operations that rewrite what they
   make.

   exact_field.c stands below all others; exact_angle.c and exact_root.c make generators of functions; exact.c runs a
   tape over them; exact_derivative.c, exact_sign.c and exact_print.c ask elements something.  Status flags are those of
   exact.h. */
#ifndef STICKSLIP_EXACT_IMPL_H
#define STICKSLIP_EXACT_IMPL_H

#include "exact.h"

/* What a generator stands for: an input by name, or a function of elements. */
struct generator {
  enum tape_op op;
  char *name;                /* TAPE_INPUT */
  fmpz_mpoly_q_struct *args; /* the others */
  slong n_args, k;           /* k: which root */
  bool squared;              /* its square is that polynomial */
  fmpz_mpoly_t square;
};

struct exact_field {
  struct generator gen[EXACT_GENERATORS];
  slong n, limit, largest;
  const struct exact_fact *fact;
  int n_facts;
  exact_binder bind;
  void *bind_arg;
  const fmpz_mpoly_q_struct *root, *positive;
  int n_roots, n_positive, n_strict;
  slong parts; /* of the terms of angles; 0: angles are not taken apart */
};

static inline const fmpz_mpoly_ctx_struct *ring(void) {
  return num_exact_ctx();
}

/* The ring's variable of generator i. */
static inline slong variable(slong i) {
  return EXACT_GENERATORS - 1 - i;
}

/* --- exact_field.c --- */

/* A sum, product or quotient of num_exact, rewritten; refused where it would be large. */
int exact_apply(num_binary op, fmpz_mpoly_q_struct *z, const struct exact_field *f, const fmpz_mpoly_q_struct *x,
                const fmpz_mpoly_q_struct *y);
/* A polynomial rewritten by the relations; whether that changed it. */
bool exact_rewrite(fmpz_mpoly_struct *p, const struct exact_field *f);
/* The index of the generator of those contents, which is made when it is new; -1 when there is no room. */
slong exact_generator(struct exact_field *f, enum tape_op op, const char *name, const fmpz_mpoly_q_struct *args,
                      slong n, slong k);
/* The element that is generator i; SS_UNABLE for -1. */
int exact_set_generator(fmpz_mpoly_q_struct *z, slong i);
/* A polynomial as an element. */
val exact_polynomial(struct calc *c, const fmpz_mpoly_struct *p);
/* Term i of the numerator of x, over its denominator. */
void exact_term(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x, slong i);
/* z = x, unless something in the calc, which is cleared, has failed; its status. */
int exact_finish(fmpz_mpoly_q_struct *z, struct calc *c, val x);
/* Its square is that polynomial. */
void exact_set_square(struct generator *g, const fmpz_mpoly_struct *square);
/* x without its sign, which is that of the leading coefficient of its numerator; whether that is negative. */
bool exact_take_sign(fmpz_mpoly_q_struct *z, const fmpz_mpoly_q_struct *x);

/* --- exact_angle.c --- */

/* TAPE_sin, TAPE_cos or TAPE_cot of x. */
int exact_circular(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x);
/* TAPE_sinc, sin x/x, or TAPE_stumpff, (x - sin x)/x^3. */
int exact_over_angle(fmpz_mpoly_q_struct *z, struct exact_field *f, enum tape_op op, const fmpz_mpoly_q_struct *x);

/* --- exact_sign.c --- */

/* Its irreducible factors; they are not looked for where it, or the root of which it is the square, has many terms. */
void exact_factor(fmpz_mpoly_factor_struct *z, const fmpz_mpoly_struct *p);
/* The sign of a polynomial, which may be zero, too, unless strict; 0: not known. */
int exact_polynomial_sign(const struct exact_field *f, const fmpz_mpoly_struct *p, bool strict);

/* --- exact_exp.c --- */

int exact_exp(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x);

/* --- exact_root.c --- */

int exact_hypot(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x,
                const fmpz_mpoly_q_struct *y);
int exact_abs(fmpz_mpoly_q_struct *z, struct exact_field *f, const fmpz_mpoly_q_struct *x);
/* The root that a TAPE_ROOT says, of the polynomial whose coefficients are the registers that it links. */
int exact_root(fmpz_mpoly_q_struct *z, struct exact_field *f, const struct tape *t, const struct tape_instr *in,
               const fmpz_mpoly_q_struct *reg);

#endif
