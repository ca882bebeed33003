/* Constant expressions over the rationals: what was written is what is used, and rounding waits for the number types.

   A user can write down more than a machine can hold: sizes, depth and the sum of all results are bounded. */
#include "constant.h"

#include <stdlib.h>
#include <string.h>

bool constant_is_given(const struct stmt *s) {
  return s->kind == STMT_RELATION && s->n_sides == 2 && s->ops[0] == REL_EQ && s->sides[0]->kind == EXPR_SYM &&
         !s->range_var;
}

bool constant_complain(const struct constant *c, const struct expr *e, const char *what) {
  return diag_at(c->d, c->src, e->span.begin, "%s", what);
}

static bool constant_binary(fmpq_t z, const struct constant *c, const struct expr *e) {
  static void (*const apply[])(fmpq_t, const fmpq_t, const fmpq_t) = {
      [EXPR_ADD] = fmpq_add, [EXPR_SUB] = fmpq_sub, [EXPR_MUL] = fmpq_mul, [EXPR_DIV] = fmpq_div};
  NUMBERS(fmpq, b);
  bool ok = constant_eval(z, c, e->args[0]) && constant_eval(b, c, e->args[1]);
  if (ok && e->kind == EXPR_DIV && fmpq_is_zero(b))
    ok = constant_complain(c, e->args[1], "division by zero: this divisor is exactly 0");
  if (ok) apply[e->kind](z, z, b);
  return ok;
}

static size_t bits_of(const fmpq_t z) {
  return fmpz_bits(fmpq_numref(z)) + fmpz_bits(fmpq_denref(z));
}

static const char too_many_bits[] = "a value of more than 200000 bits (60000 digits); write a shorter one";

static bool constant_power(fmpq_t z, const struct constant *c, const struct expr *e) {
  if (!constant_eval(z, c, e->args[0])) return false;
  if (fmpq_is_zero(z) && e->exponent < 0)
    return constant_complain(c, e, "division by zero: a negative power of exactly 0");
  if (bits_of(z) * (size_t)abs(e->exponent) > MAX_VALUE_BITS) return constant_complain(c, e, too_many_bits);
  fmpq_pow_si(z, z, e->exponent);
  return true;
}

/* Roots of squares are rational; others are no exact value. */
static bool constant_root(fmpq_t z, const struct constant *c, const struct expr *e) {
  if (!constant_eval(z, c, e->args[0])) return false;
  if (fmpq_sgn(z) < 0)
    return constant_complain(c, e, "the root of a negative number; give a number that is not negative");
  if (!fmpz_is_square(fmpq_numref(z)) || !fmpz_is_square(fmpq_denref(z)))
    return constant_complain(
        c, e,
        c->or_interval
            ? "this root is irrational, and values are exact: give a decimal, or an interval [low, high] around it"
            : "this root is irrational, and values are exact: give a decimal");
  fmpz_sqrt(fmpq_numref(z), fmpq_numref(z));
  fmpz_sqrt(fmpq_denref(z), fmpq_denref(z));
  return true;
}

static bool eval_node(fmpq_t z, const struct constant *c, const struct expr *e) {
  switch (e->kind) {
  case EXPR_NUM:
    return num_parse_decimal(z, e->name, strlen(e->name)) == SS_OK ||
           constant_complain(c, e, "a number too large to hold; write one of fewer digits");
  case EXPR_SYM:
    if (c->symbol) return c->symbol(z, c->arg, c, e);
    break;
  case EXPR_PAREN:
    return constant_eval(z, c, e->args[0]);
  case EXPR_NEG:
    if (!constant_eval(z, c, e->args[0])) return false;
    fmpq_neg(z, z);
    return true;
  case EXPR_ADD:
  case EXPR_SUB:
  case EXPR_MUL:
  case EXPR_DIV:
    return constant_binary(z, c, e);
  case EXPR_POW:
    return constant_power(z, c, e);
  case EXPR_SQRT:
    return constant_root(z, c, e);
  default:
    break;
  }
  return diag_at(c->d, c->src, e->span.begin, "a constant expression has numbers, + - * / ^, sqrt%s%s only",
                 c->symbol ? ", parentheses and " : " and parentheses", c->symbol ? c->names : "");
}

bool constant_eval(fmpq_t z, const struct constant *c, const struct expr *e) {
  if (*c->depth >= MAX_VALUE_DEPTH)
    return constant_complain(c, e, "more than 1000 operations one inside the other or in a row; write fewer");
  ++*c->depth;
  bool ok = eval_node(z, c, e);
  --*c->depth;
  if (!ok) return false;
  size_t bits = bits_of(z);
  if (bits > MAX_VALUE_BITS) return constant_complain(c, e, too_many_bits);
  *c->work += bits;
  return *c->work <= MAX_VALUE_WORK ||
         constant_complain(c, e, "the values take more than 20000000 bits of work; write shorter ones");
}

bool constant_interval(fmpq_t low, fmpq_t high, const struct constant *c, const struct expr *e) {
  if (e->kind != EXPR_MATRIX) {
    bool ok = constant_eval(low, c, e);
    fmpq_set(high, low);
    return ok;
  }
  if (e->rows != 1 || e->cols != 2) return constant_complain(c, e, "an interval reads [low, high]");
  if (!constant_eval(low, c, e->args[0]) || !constant_eval(high, c, e->args[1])) return false;
  int order = fmpq_cmp(low, high);
  if (order > 0)
    return constant_complain(c, e, "the ends of the interval are in the wrong order; the lower one is first");
  return order < 0 || constant_complain(c, e, "the interval has no width; one number is enough");
}
