/* CVODE with its context and its solvers, and what versions of SUNDIALS do differently. */
#ifndef STICKSLIP_BENCH_SUNDIALS_H
#define STICKSLIP_BENCH_SUNDIALS_H

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdbool.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

/* Failures are in the tables, not on the standard error. */
#if SUNDIALS_VERSION_MAJOR >= 7
#define NO_COMM                   SUN_COMM_NULL
#define be_quiet(memory, context) SUNContext_ClearErrHandlers(context)
#else
#define NO_COMM                   NULL
#define be_quiet(memory, context) CVodeSetErrFile(memory, NULL)
#endif

struct cvode {
  SUNContext context;
  void *memory;
  N_Vector y;
  SUNMatrix matrix; /* of BDF */
  SUNLinearSolver linear;
  SUNNonlinearSolver nonlinear; /* of Adams */
};

/* n equations by Adams formulas, or by BDF with a dense Jacobian; the functions get self.  c is zero bytes before, and
   is to be closed whatever comes of it. */
static inline bool cvode_open(struct cvode *c, int n, bool adams, CVRhsFn field, CVLsJacFn jacobian, void *self) {
  if (SUNContext_Create(NO_COMM, &c->context)) return false;
  c->y = N_VNew_Serial(n, c->context);
  c->memory = CVodeCreate(adams ? CV_ADAMS : CV_BDF, c->context);
  if (!c->y || !c->memory) return false;
  be_quiet(c->memory, c->context);
  N_VConst(1, c->y);
  if (CVodeInit(c->memory, field, 0, c->y) || CVodeSetUserData(c->memory, self)) return false;
  if (adams) {
    c->nonlinear = SUNNonlinSol_FixedPoint(c->y, 0, c->context);
    return c->nonlinear && CVodeSetNonlinearSolver(c->memory, c->nonlinear) == CV_SUCCESS;
  }
  c->matrix = SUNDenseMatrix(n, n, c->context);
  c->linear = c->matrix ? SUNLinSol_Dense(c->y, c->matrix, c->context) : NULL;
  return c->linear && CVodeSetLinearSolver(c->memory, c->linear, c->matrix) == CV_SUCCESS &&
         CVodeSetJacFn(c->memory, jacobian) == CV_SUCCESS;
}

static inline void cvode_close(struct cvode *c) {
  if (c->memory) CVodeFree(&c->memory);
  if (c->nonlinear) SUNNonlinSolFree(c->nonlinear);
  if (c->linear) SUNLinSolFree(c->linear);
  if (c->matrix) SUNMatDestroy(c->matrix);
  if (c->y) N_VDestroy(c->y);
  if (c->context) SUNContext_Free(&c->context);
}

#endif
