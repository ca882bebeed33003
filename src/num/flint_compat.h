/* Where FLINT, Arb and Calcium live: FLINT 2.9 ships beside Arb 2.23 and Calcium 0.4 (Debian 12);
   FLINT 3 has merged them.  Every other file includes this one and never asks for the version. */
#ifndef STICKSLIP_NUM_FLINT_COMPAT_H
#define STICKSLIP_NUM_FLINT_COMPAT_H

#include <flint/flint.h>
#include <flint/fmpq.h>
#include <flint/fmpz.h>
#include <flint/fmpz_mpoly_factor.h>
#include <mpfr.h>
#include <stdio.h> /* before FLINT: its headers declare their FILE functions only then */
#if __FLINT_RELEASE >= 30000
#include <flint/acb_poly.h>
#include <flint/arb.h>
#include <flint/arb_fmpz_poly.h>
#include <flint/arb_mat.h>
#include <flint/arb_poly.h>
#include <flint/arf.h>
#include <flint/fmpz_mpoly_q.h>
#include <flint/mag.h>
#else
#include <acb_poly.h>
#include <arb.h>
#include <arb_fmpz_poly.h>
#include <arb_mat.h>
#include <arb_poly.h>
#include <arf.h>
#include <mag.h>
#if __has_include(<calcium/fmpz_mpoly_q.h>)
#include <calcium/fmpz_mpoly_q.h>
#else
#include <fmpz_mpoly_q.h>

#include "num.h"
#endif
#endif

#endif
