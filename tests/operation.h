/* What an operation or a number of the notation is worth, by the C library; random formulas. */
#ifndef STICKSLIP_TESTS_OPERATION_H
#define STICKSLIP_TESTS_OPERATION_H

#include "expr/expr.h"
#include "rng.h"

/* Of the operands a and b; NaN for symbols, functions and what is no scalar, and where it has no value or no
   derivative. */
long double operation_value(const struct expr *e, long double a, long double b);

/* The numbers in random formulas, no two of one value. */
enum { RANDOM_NUMBERS = 7 };
extern const char *const random_numbers[RANDOM_NUMBERS];

/* A scalar of x and y; with functions, also of rounded(...) and of a function f and its derivatives. */
const struct expr *random_scalar(struct expr_pool *pool, struct rng *r, int depth, bool functions);

#endif
