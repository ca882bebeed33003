/* What versions of SUNDIALS do differently. */
#ifndef STICKSLIP_BENCH_SUNDIALS_H
#define STICKSLIP_BENCH_SUNDIALS_H

#include <cvode/cvode.h>

/* Failures are in the tables, not on the standard error. */
#if SUNDIALS_VERSION_MAJOR >= 7
#define NO_COMM                   SUN_COMM_NULL
#define be_quiet(memory, context) SUNContext_ClearErrHandlers(context)
#else
#define NO_COMM                   NULL
#define be_quiet(memory, context) CVodeSetErrFile(memory, NULL)
#endif

#endif
