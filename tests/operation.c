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

const char *const random_numbers[RANDOM_NUMBERS] = {"0", "1", "2", "0.80", "1e-12", "2.50E+3", ".5"};

const struct expr *random_scalar(struct expr_pool *pool, struct rng *r, int depth, bool functions) {
  static const enum expr_kind unary[] = {EXPR_NEG, EXPR_SIN,  EXPR_COS,     EXPR_COT, EXPR_SQRT,
                                         EXPR_ABS, EXPR_SINC, EXPR_STUMPFF, EXPR_EXP, EXPR_ROUNDED};
  static const enum expr_kind binary[] = {EXPR_ADD, EXPR_SUB, EXPR_MUL, EXPR_DIV, EXPR_HYPOT};
  if (depth <= 0) {
    if (rng_between(r, 0, 2)) return expr_sym(pool, rng_between(r, 0, 1) ? "x" : "y");
    return expr_num(pool, random_numbers[rng_between(r, 0, RANDOM_NUMBERS - 1)]);
  }
  const struct expr *a = random_scalar(pool, r, depth - 1 - (int)rng_between(r, 0, 1), functions);
  switch (rng_between(r, functions ? 0 : 1, 7)) {
  case 0:
    return expr_call(pool, "f", (int)rng_between(r, 0, 2), a);
  case 1:
    return expr_op1(pool, unary[rng_between(r, 0, functions ? 9 : 8)], a);
  case 2:
    return expr_op1(pool, EXPR_NEG, a);
  case 3:
    return expr_pow(pool, a, (int)rng_between(r, -4, 4));
  default:
    return expr_op2(pool, binary[rng_between(r, 0, 4)], a,
                    random_scalar(pool, r, depth - 1 - (int)rng_between(r, 0, 1), functions));
  }
}
