#include "operation.h"

#include <math.h>
#include <stdlib.h>

long double operation_value(const struct expr *e, long double a, long double b) {
  switch (e->kind) {
  case EXPR_NUM:
    return strtold(e->name, NULL);
  case EXPR_NEG:
    return -a;
  case EXPR_ADD:
    return a + b;
  case EXPR_SUB:
    return a - b;
  case EXPR_MUL:
    return a * b;
  case EXPR_DIV:
    return a / b;
  case EXPR_POW:
    return powl(a, e->exponent);
  case EXPR_SIN:
    return sinl(a);
  case EXPR_COS:
    return cosl(a);
  case EXPR_COT:
    return cosl(a) / sinl(a);
  case EXPR_SQRT:
    return a > 0 ? sqrtl(a) : NAN; /* not differentiable at 0 */
  case EXPR_EXP:
    return expl(a);
  case EXPR_ABS:
    return a == 0 ? NAN : fabsl(a);
  case EXPR_ROUNDED:
    return a;
  case EXPR_SINC:
    return a == 0 ? 1 : sinl(a) / a;
  case EXPR_STUMPFF:
    return fabsl(a) < 1e-3L ? (1 - a * a / 20) / 6 : (a - sinl(a)) / (a * a * a);
  case EXPR_HYPOT:
    return a == 0 && b == 0 ? NAN : hypotl(a, b);
  default:
    return NAN;
  }
}
