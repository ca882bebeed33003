/* The token in hand, and the words that the language keeps for itself.  A parser never goes back: to look ahead it asks
   the lexer for the token after a place. */
#include <string.h>

#include "parser.h"

/* With the first token in hand; the one before it is an end, so that an empty formula shows as such. */
struct parser parser_at(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct token start = {TOK_END, where.begin, where.begin};
  struct parser p = {.arena = a, .src = src, .end = where.end, .diag = d, .tok = start};
  parser_advance(&p);
  return p;
}

void parser_advance(struct parser *p) {
  p->prev = p->tok;
  p->tok = lex_token(p->src, p->tok.end, p->end, p->diag);
}

bool parser_token_is(const struct parser *p, struct token t, const char *word) {
  return t.kind == TOK_NAME && t.end - t.begin == strlen(word) && !memcmp(p->src->text + t.begin, word, strlen(word));
}

bool parser_accept(struct parser *p, int kind) {
  if (p->tok.kind != kind) return false;
  parser_advance(p);
  return true;
}

bool parser_accept_word(struct parser *p, const char *word) {
  if (!parser_token_is(p, p->tok, word)) return false;
  parser_advance(p);
  return true;
}

const char *parser_copy(struct parser *p, struct token t) {
  return arena_strndup(p->arena, p->src->text + t.begin, t.end - t.begin);
}

/* The kind of the built-in function of that name, or EXPR_SYM. */
enum expr_kind parser_function_kind(const struct parser *p, struct token t) {
#define TEST(kind, name)                                                                                               \
  if (parser_token_is(p, t, name)) return kind;
  EXPR_FUNCTIONS(TEST)
#undef TEST
  return EXPR_SYM;
}

/* A name that the language keeps for itself where an expression stands. */
bool parser_is_built_in(const struct parser *p, struct token t) {
  return parser_function_kind(p, t) != EXPR_SYM || parser_token_is(p, t, "first_order");
}

bool parser_is_keyword(const struct parser *p, struct token t) {
  return parser_token_is(p, t, "root") || parser_token_is(p, t, "trajectory") || parser_token_is(p, t, "for") ||
         parser_token_is(p, t, "in");
}

bool token_is_relation(int kind) {
  return kind == '=' || kind == '<' || kind == '>' || kind == TOK_LE || kind == TOK_GE;
}
