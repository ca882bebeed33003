/* What the files of this module share and nobody else needs: tokens, the built-in functions, the levels of the grammar,
   and the walk that writes a tree without recursion. */
#ifndef STICKSLIP_EXPR_IMPL_H
#define STICKSLIP_EXPR_IMPL_H

#include "expr.h"

enum { EXPR_MAX_DEPTH = 200, EXPR_MAX_NODES = 100000, EXPR_MAX_INDEX = 9999, EXPR_MAX_PRIMES = 99 };

/* A token of one character has that character as its kind. */
enum { TOK_END = 256, TOK_BAD, TOK_NUMBER, TOK_NAME, TOK_DEFINE, TOK_LE, TOK_GE };

struct token {
  int kind;
  size_t begin, end; /* TOK_END: both where the text before it ends */
};

/* The token that follows `from` in a span that ends at `end`.  TOK_BAD with d set (d may be NULL: a mere look ahead)
   where there is none. */
struct token lex_token(const struct source *src, size_t from, size_t end, struct diag *d);

#define EXPR_FUNCTIONS(F)                                                                                              \
  F(EXPR_SIN, "sin")                                                                                                   \
  F(EXPR_COS, "cos")                                                                                                   \
  F(EXPR_COT, "cot")                                                                                                   \
  F(EXPR_SINC, "sinc")                                                                                                 \
  F(EXPR_STUMPFF, "stumpff")                                                                                           \
  F(EXPR_HYPOT, "hypot")                                                                                               \
  F(EXPR_ROUNDED, "rounded")                                                                                           \
  F(EXPR_EXP, "exp")                                                                                                   \
  F(EXPR_SQRT, "sqrt")                                                                                                 \
  F(EXPR_ABS, "abs")                                                                                                   \
  F(EXPR_INV, "inv")                                                                                                   \
  F(EXPR_DET, "det")                                                                                                   \
  F(EXPR_TR, "tr")                                                                                                     \
  F(EXPR_TRANSPOSE, "transpose")

/* How tightly a form binds; an operand must bind at least as tightly as its place asks. */
enum level { LEVEL_SUM, LEVEL_QUOTIENT, LEVEL_PRODUCT, LEVEL_POWER, LEVEL_POSTFIX, LEVEL_PRIMARY };

/* How tightly e binds as it is printed; what the grammar asks of operand i of a form. */
enum level expr_level(const struct expr *e);
enum level expr_operand_level(enum expr_kind k, int i);
/* The first factor of a product or quotient is a power that nothing encloses: a "-" before it would be doubtful. */
bool expr_leads_with_power(const struct expr *e);
/* 3, 3^2: as a factor it cannot stand behind a blank alone. */
bool expr_begins_with_digit(const struct expr *e);

/* A motion at the time t, which the paper leaves out: z_1(t), not Z(t) nor h(t_a). */
bool expr_is_understood(const struct expr *e);

/* The name of one of EXPR_FUNCTIONS; NULL for another kind. */
const char *expr_function_name(enum expr_kind k);

/* The signs that a form writes before its operands, between two of them and behind them; line: between the rows of a
   matrix, and where the symbols of first_order begin.  NULL: none. */
struct expr_signs {
  const char *before, *between, *line, *behind;
};
/* Those before operand i, or after the last one. */
void expr_write_signs(struct text *out, const struct expr_signs *s, const struct expr *e, int i);

/* Writes what stands before operand i of e, or after the last one when i == n_args; parent may be NULL. */
typedef void expr_between(struct text *out, const struct expr *e, int i, const struct expr *parent);

/* Calls `between` in the order of the text.  The pending nodes are on the heap, so depth is no danger. */
void expr_write(struct text *out, const struct expr *e, expr_between *between);

/* A pool's node that equals e but for its operands, which are the given scalars of the pool. */
const struct expr *expr_with_args(struct expr_pool *p, const struct expr *e, const struct expr *const *args);

#endif
