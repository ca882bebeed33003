/* A parser of one formula: the token in hand and what has been read so far.  cursor.c moves along the tokens, mistake.c
   says what is wrong, parser.c reads expressions and statement.c statements; each uses those before it.

   Every function that returns a pointer or bool reports the first mistake to the parser's diag and then returns NULL or
   false; the callers only pass that on. */
#ifndef STICKSLIP_EXPR_PARSER_H
#define STICKSLIP_EXPR_PARSER_H

#include "expr_impl.h"

struct parser {
  struct arena *arena;
  const struct source *src;
  size_t end;
  struct diag *diag;
  struct token tok, prev; /* the token in hand and the one before it */
  int depth, n_nodes, open_matrices;
  const struct expr **pending; /* operands that wait for the end of their list */
  size_t n_pending, cap_pending;
};

/* --- cursor.c --- */

/* With the first token of a span in hand; the one before it is an end, so that an empty formula shows as such. */
struct parser parser_at(struct arena *a, const struct source *src, struct span where, struct diag *d);

void parser_advance(struct parser *p);
/* Whether a token is the word. */
bool parser_token_is(const struct parser *p, struct token t, const char *word);
/* The token in hand is taken if it is of the kind, or is the word. */
bool parser_accept(struct parser *p, int kind);
bool parser_accept_word(struct parser *p, const char *word);
/* The text of a token, in the parser's arena. */
const char *parser_copy(struct parser *p, struct token t);
/* The kind of the built-in function of that name, or EXPR_SYM. */
enum expr_kind parser_function_kind(const struct parser *p, struct token t);
/* A name that the language keeps for itself where an expression stands. */
bool parser_is_built_in(const struct parser *p, struct token t);
bool parser_is_keyword(const struct parser *p, struct token t);
bool token_is_relation(int kind);

/* --- mistake.c --- */

/* A token as a message shows it. */
struct shown {
  char text[64];
};
struct shown parser_show(const struct parser *p, struct token t);

/* Each reports a mistake and returns NULL, so that every function can return it as its own failure. */
void *mistake_at(struct parser *p, size_t at, const char *fmt, ...) SS_PRINTF(3, 4);
void *mistake(struct parser *p, const char *what); /* at the token in hand */
void *mistake_prime(struct parser *p, size_t at);
void *mistake_reserved(struct parser *p);
void *mistake_unclosed(struct parser *p, struct token open, const char *closer);
/* Where an operand should begin, something else stands. */
void *mistake_operand(struct parser *p);
/* After a complete formula something is left. */
void *mistake_trailing(struct parser *p);

/* --- parser.c --- */

/* An expression, as far as it goes. */
const struct expr *parser_sum(struct parser *p);
/* An operand is kept until its list is complete; then those that have been kept since there were `from` of them are
   moved to `to`. */
void parser_put_pending(struct parser *p, const struct expr *e);
void parser_take_pending(struct parser *p, size_t from, const struct expr **to);

#endif
