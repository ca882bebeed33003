/* Where FLINT and Arb live: FLINT 2.9 ships beside Arb 2.23 and Calcium 0.4 (Debian 12); FLINT 3 has merged them.
   Every other file includes this one, or flint_more.h for polynomials and matrices, and never asks for the version. */
#ifndef STICKSLIP_NUM_FLINT_COMPAT_H
#define STICKSLIP_NUM_FLINT_COMPAT_H

/* Both before FLINT: its headers declare what takes a FILE or a number of MPFR only then. */
#include <mpfr.h>
#include <stdio.h>

#include <flint/flint.h>
#include <flint/fmpq.h>
#include <flint/fmpq_vec.h>
#include <flint/fmpz.h>
#include <flint/ulong_extras.h>
#if __FLINT_RELEASE >= 30000
#include <flint/arb.h>
#include <flint/arf.h>
#include <flint/mag.h>
#else
#include <arb.h>
#include <arf.h>
#include <mag.h>
#endif

#include "base/owned.h"

/* Of arb, arf, mag and fmpz zero bytes are an initialised number of value 0, and so are those in a struct of zeros. */
OWNED_CLEARING(arb)
OWNED_CLEARING(arf)
OWNED_CLEARING(mag)
OWNED_CLEARING(fmpq)
OWNED_CLEARING(fmpz)
OWNED_CLEARING(mpfr)

/* MPFR_NUMBERS(128, x, y): mpfr_t x and y of that precision. */
#define MPFR_NUMBERS(prec, ...)                                                                                        \
  OWNED_CLEARED(mpfr_owned_clear) mpfr_t __VA_ARGS__;                                                                  \
  OWNED_EACH(MPFR_NUMBER, prec, __VA_ARGS__)
#define MPFR_NUMBER(prec, x) mpfr_init2(x, prec);

/* arb_ptr x: n balls, fmpq *x: n rationals, which are cleared as the variables of base/owned.h are. */
#define ARB_VECTOR(x, n)                                                                                               \
  OWNED_CLEARED(arb_vector_clear) struct arb_vector x##_owned = {_arb_vec_init(n), n};                                 \
  arb_ptr x = x##_owned.at
struct arb_vector {
  arb_ptr at;
  slong n;
};
static inline void arb_vector_clear(struct arb_vector *x) {
  _arb_vec_clear(x->at, x->n);
}
#define FMPQ_VECTOR(x, n)                                                                                              \
  OWNED_CLEARED(fmpq_vector_clear) struct fmpq_vector x##_owned = {_fmpq_vec_init(n), n};                              \
  fmpq *x = x##_owned.at
struct fmpq_vector {
  fmpq *at;
  slong n;
};
static inline void fmpq_vector_clear(struct fmpq_vector *x) {
  _fmpq_vec_clear(x->at, x->n);
}

#endif
