/* What an operation or a number of the notation is worth, by the C library. */
#ifndef STICKSLIP_TESTS_OPERATION_H
#define STICKSLIP_TESTS_OPERATION_H

#include "expr/expr.h"

/* Of the operands a and b; NaN for symbols, functions and what is no scalar, and where it has no value or no
   derivative. */
long double operation_value(const struct expr *e, long double a, long double b);

#endif
