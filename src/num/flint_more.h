/* FLINT's polynomials, matrices and rational functions, whose headers take the compiler longer than most files that do
   without them. */
#ifndef STICKSLIP_NUM_FLINT_MORE_H
#define STICKSLIP_NUM_FLINT_MORE_H

#include "num/flint_compat.h"

#include <flint/fmpq_mat.h>
#include <flint/fmpz_mpoly_factor.h>
#include <flint/fmpz_poly.h>
#if __FLINT_RELEASE >= 30000
#include <flint/acb_mat.h>
#include <flint/acb_poly.h>
#include <flint/arb_fmpz_poly.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#include <flint/fmpz_mpoly_q.h>
#else
#include <acb_mat.h>
#include <acb_poly.h>
#include <arb_fmpz_poly.h>
#include <arb_mat.h>
#include <arb_poly.h>
#if __has_include(<calcium/fmpz_mpoly_q.h>)
#include <calcium/fmpz_mpoly_q.h>
#else
#include <fmpz_mpoly_q.h>
#endif
#endif

OWNED_CLEARING(acb)
OWNED_CLEARING(acb_mat)
OWNED_CLEARING(arb_mat)
OWNED_CLEARING(arb_poly)
OWNED_CLEARING(fmpq_mat)
OWNED_CLEARING(fmpz_poly)

#endif
