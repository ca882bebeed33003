/* Constant expressions over the rationals: numbers, + - * / ^, sqrt of a square, parentheses, and names if the caller
   has any. */
#ifndef STICKSLIP_EXPR_CONSTANT_H
#define STICKSLIP_EXPR_CONSTANT_H

#include "expr.h"
#include "num/num.h"

/* Bits of a value (60000 digits); operations on the way to any number; bits of all results together. */
enum { MAX_VALUE_BITS = 200000, MAX_VALUE_DEPTH = 1000, MAX_VALUE_WORK = 20000000 };

/* A constant expression under evaluation.  symbol gives the value of a name, or reports why it has none; NULL where
   names have no place.  depth and work are shared by expressions that refer to each other. */
struct constant {
  const struct source *src;
  struct diag *d;
  int *depth;
  size_t *work;
  bool (*symbol)(fmpq_t z, void *arg, const struct constant *c, const struct expr *e);
  const char *names; /* what names stand for, "the scene's other parameters" */
  void *arg;
  bool or_interval; /* an interval may stand in its place */
};
/* Is the statement NAME = VALUE, without a range? */
bool constant_is_given(const struct stmt *s);
bool constant_eval(fmpq_t z, const struct constant *c, const struct expr *e);
/* The same of "[low, high]", low < high, or of one value, which is both. */
bool constant_interval(fmpq_t low, fmpq_t high, const struct constant *c, const struct expr *e);
/* Reports at the expression; false. */
bool constant_complain(const struct constant *c, const struct expr *e, const char *what);

#endif
