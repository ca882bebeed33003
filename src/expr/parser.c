/* Expressions by recursive descent, one function for each line of the grammar in expr.h, over one token in hand.
   Recursion happens in parser_sum alone and is bounded there; chains (a+b+c, a*b*c, v[1][1]) are loops that lean to the
   left.  NULL means that the first mistake has been reported. */
#include <stdlib.h>
#include <string.h>

#include "parser.h"

/* --- Nodes --- */

static struct expr *new_node(struct parser *p, enum expr_kind kind, size_t begin, int n_args) {
  if (++p->n_nodes > EXPR_MAX_NODES)
    return mistake_at(p, begin, "a formula of more than %d nodes: define names for its parts", EXPR_MAX_NODES);
  struct expr *e = arena_alloc(p->arena, sizeof *e);
  e->kind = kind;
  e->span = (struct span){begin, p->prev.end};
  e->n_args = n_args;
  if (n_args > 0) e->args = arena_alloc(p->arena, (size_t)n_args * sizeof *e->args);
  return e;
}

static struct expr *node1(struct parser *p, enum expr_kind kind, size_t begin, const struct expr *a) {
  struct expr *e = a ? new_node(p, kind, begin, 1) : NULL;
  if (e) e->args[0] = a;
  return e;
}

static struct expr *node2(struct parser *p, enum expr_kind kind, const struct expr *a, const struct expr *b) {
  struct expr *e = a && b ? new_node(p, kind, a->span.begin, 2) : NULL;
  if (!e) return NULL;
  e->args[0] = a;
  e->args[1] = b;
  return e;
}

void parser_put_pending(struct parser *p, const struct expr *e) {
  *SS_PUSH(p->pending, p->n_pending, p->cap_pending) = e;
}

/* Moves the operands that have been waiting since there were `from` of them. */
void parser_take_pending(struct parser *p, size_t from, const struct expr **to) {
  memcpy(to, p->pending + from, (p->n_pending - from) * sizeof *to);
  p->n_pending = from;
}

/* --- Expressions, innermost first --- */

/* Integers of at most four digits, for indices and exponents; -1 otherwise. */
static int short_integer(const struct parser *p, struct token t) {
  if (t.kind != TOK_NUMBER || t.end - t.begin > 4) return -1;
  int value = 0;
  for (size_t i = t.begin; i < t.end; i++) {
    char c = p->src->text[i];
    if (c < '0' || c > '9') return -1;
    value = 10 * value + (c - '0');
  }
  return value;
}

static const struct expr *parse_paren(struct parser *p) {
  struct token open = p->tok;
  parser_advance(p);
  if (p->tok.kind == ')') return mistake(p, "nothing stands between the parentheses");
  const struct expr *inner = parser_sum(p);
  if (!inner) return NULL;
  if (p->tok.kind == ',' || p->tok.kind == ';')
    return mistake(p, "one expression goes between parentheses; a row is written [a, b], a column [a; b]");
  if (!parser_accept(p, ')')) return mistake_unclosed(p, open, "\")\"");
  return node1(p, EXPR_PAREN, open.begin, inner);
}

/* "first_order" "(" sum ";" name ("," name)* ")" */
static const struct expr *parse_first_order(struct parser *p) {
  static const char *const form = "it is written first_order(expression; x, y), with the small symbols after the \";\"";
  struct token name = p->tok, open;
  size_t from = p->n_pending;
  parser_advance(p);
  open = p->tok;
  if (!parser_accept(p, '('))
    return mistake_at(p, name.begin, "first_order is a built-in form and cannot be a name; %s", form);
  const struct expr *inner = parser_sum(p);
  if (!inner) return NULL;
  parser_put_pending(p, inner);
  if (p->tok.kind != ';') return mistake(p, form);
  do {
    parser_advance(p);
    struct token t = p->tok;
    if (t.kind != TOK_NAME || parser_is_keyword(p, t) || parser_is_built_in(p, t)) return mistake(p, form);
    parser_advance(p);
    struct expr *symbol = new_node(p, EXPR_SYM, t.begin, 0);
    if (!symbol) return NULL;
    symbol->name = parser_copy(p, t);
    parser_put_pending(p, symbol);
  } while (p->tok.kind == ',');
  if (!parser_accept(p, ')')) return mistake_unclosed(p, open, "\")\"");
  struct expr *e = new_node(p, EXPR_FIRST_ORDER, name.begin, (int)(p->n_pending - from));
  if (e) parser_take_pending(p, from, e->args);
  return e;
}

/* "(" sum ")" after the name of a function. */
static const struct expr *parse_argument(struct parser *p, struct token name) {
  struct token open = p->tok;
  parser_advance(p);
  if (p->tok.kind == ')') return mistake_at(p, p->tok.begin, "%s needs an argument", parser_show(p, name).text);
  const struct expr *arg = parser_sum(p);
  if (!arg) return NULL;
  if (p->tok.kind == ',' || p->tok.kind == ';')
    return mistake_at(p, p->tok.begin, "%s takes one argument; a row is written [a, b]", parser_show(p, name).text);
  if (!parser_accept(p, ')')) return mistake_unclosed(p, open, "\")\"");
  return arg;
}

/* "(" sum "," sum ")" */
static const struct expr *parse_two_arguments(struct parser *p, enum expr_kind kind, struct token name) {
  struct token open = p->tok;
  parser_advance(p);
  const struct expr *a = parser_sum(p);
  if (!a) return NULL;
  if (!parser_accept(p, ','))
    return mistake_at(p, p->tok.begin, "%s takes two arguments, separated by \",\"", parser_show(p, name).text);
  const struct expr *b = parser_sum(p);
  if (!b) return NULL;
  if (p->tok.kind == ',')
    return mistake_at(p, p->tok.begin, "%s takes two arguments, separated by \",\"", parser_show(p, name).text);
  if (!parser_accept(p, ')')) return mistake_unclosed(p, open, "\")\"");
  struct expr *e = node2(p, kind, a, b);
  if (e) e->span.begin = name.begin;
  return e;
}

static const struct expr *parse_function(struct parser *p, enum expr_kind kind) {
  struct token name = p->tok;
  parser_advance(p);
  if (p->tok.kind == '\'')
    return mistake_at(p, p->tok.begin, "the built-in function %s takes no prime", parser_show(p, name).text);
  if (p->tok.kind == '^') return mistake_at(p, p->tok.begin, "a power of a function is written sin(x)^2");
  if (p->tok.kind != '(')
    return mistake_at(p, name.begin,
                      "%s is a built-in function and cannot be a name; its argument stands in parentheses",
                      parser_show(p, name).text);
  if (kind == EXPR_HYPOT) return parse_two_arguments(p, kind, name);
  return node1(p, kind, name.begin, parse_argument(p, name));
}

/* name | name "'"* "(" sum ")" */
static const struct expr *parse_name(struct parser *p) {
  struct token name = p->tok;
  if (parser_is_keyword(p, name)) return mistake_reserved(p);
  if (parser_token_is(p, name, "first_order")) return parse_first_order(p);
  enum expr_kind function = parser_function_kind(p, name);
  if (function != EXPR_SYM) return parse_function(p, function);
  parser_advance(p);
  size_t first_prime = p->tok.begin;
  int primes = 0;
  while (p->tok.kind == '\'') {
    if (++primes > EXPR_MAX_PRIMES) return mistake(p, "too many primes");
    parser_advance(p);
  }
  struct expr *e;
  if (p->tok.kind == '(')
    e = node1(p, EXPR_CALL, name.begin, parse_argument(p, name));
  else if (primes > 0)
    return mistake_prime(p, first_prime);
  else
    e = new_node(p, EXPR_SYM, name.begin, 0);
  if (!e) return NULL;
  e->name = parser_copy(p, name);
  e->order = primes;
  return e;
}

/* One row of a matrix onto the pending operands.  Every row has as many entries as the first: *cols, or 0 before. */
static bool parse_row(struct parser *p, int row, int *cols) {
  int n = 0;
  do {
    if (*cols > 0 && n == *cols)
      return mistake_at(p, p->tok.begin, "row %d has more than the %d entries of row 1", row, *cols);
    const struct expr *entry = parser_sum(p);
    if (!entry) return false;
    parser_put_pending(p, entry);
    n++;
  } while (parser_accept(p, ','));
  if (*cols > 0 && n < *cols)
    return mistake_at(p, p->tok.begin, "row %d ends after %d of the %d entries of row 1", row, n, *cols);
  *cols = n;
  return true;
}

static const struct expr *parse_matrix(struct parser *p) {
  struct token open = p->tok;
  size_t from = p->n_pending;
  int rows = 0, cols = 0;
  parser_advance(p);
  if (p->tok.kind == ']') return mistake(p, "a matrix has at least one entry");
  p->open_matrices++;
  do {
    if (!parse_row(p, ++rows, &cols)) return NULL;
  } while (parser_accept(p, ';'));
  p->open_matrices--;
  if (!parser_accept(p, ']')) return mistake_unclosed(p, open, "\"]\"");
  struct expr *e = new_node(p, EXPR_MATRIX, open.begin, (int)(p->n_pending - from));
  if (!e) return NULL;
  parser_take_pending(p, from, e->args);
  e->rows = rows;
  e->cols = cols;
  return e;
}

static const struct expr *parse_primary(struct parser *p) {
  switch (p->tok.kind) {
  case TOK_NUMBER: {
    struct token t = p->tok;
    parser_advance(p);
    struct expr *e = new_node(p, EXPR_NUM, t.begin, 0);
    if (e) e->name = parser_copy(p, t);
    return e;
  }
  case TOK_NAME:
    return parse_name(p);
  case '(':
    return parse_paren(p);
  case '[':
    return parse_matrix(p);
  default:
    return mistake_operand(p);
  }
}

static bool parse_index_number(struct parser *p, int *value) {
  *value = short_integer(p, p->tok);
  if (*value < 1)
    return mistake_at(p, p->tok.begin,
                      "an index is an integer from 1 to %d or a range such as 1:2; a product with a matrix has \"*\"",
                      EXPR_MAX_INDEX);
  parser_advance(p);
  return true;
}

/* "[" index ["," index] "]" */
static const struct expr *parse_index(struct parser *p, const struct expr *base) {
  struct token open = p->tok;
  int index[4] = {0}, n = 0;
  bool range[2] = {false, false};
  do {
    parser_advance(p);
    if (n == 2) return mistake(p, "an entry has at most two indices");
    if (!parse_index_number(p, &index[2 * n])) return NULL;
    index[2 * n + 1] = index[2 * n];
    if (parser_accept(p, ':')) {
      range[n] = true;
      size_t at = p->tok.begin;
      if (!parse_index_number(p, &index[2 * n + 1])) return NULL;
      if (index[2 * n + 1] < index[2 * n]) return mistake_at(p, at, "a range of indices goes upwards");
    }
    n++;
  } while (p->tok.kind == ',');
  if (!parser_accept(p, ']')) return mistake_unclosed(p, open, "\"]\"");
  struct expr *e = node1(p, EXPR_INDEX, base->span.begin, base);
  if (!e) return NULL;
  memcpy(e->index, index, sizeof index);
  memcpy(e->index_range, range, sizeof range);
  e->n_index = n;
  return e;
}

static const struct expr *parse_postfix(struct parser *p) {
  const struct expr *e = parse_primary(p);
  while (e && p->tok.kind == '[' && e->kind != EXPR_NUM) e = parse_index(p, e);
  return e;
}

static bool mistake_exponent(struct parser *p) {
  size_t len = p->tok.end - p->tok.begin;
  bool digits = p->tok.kind == TOK_NUMBER && len > 4 && strspn(p->src->text + p->tok.begin, "0123456789") >= len;
  return mistake(p, digits ? "an exponent has at most 4 digits"
                           : "an exponent is an integer, such as a^2 or a^(-2); a root is sqrt(a), e^x is exp(x)");
}

/* digits | "(" "-" digits ")", after "^" */
static bool parse_exponent(struct parser *p, int *value) {
  struct token open = p->tok;
  if (open.kind == '-') return mistake(p, "a negative exponent needs parentheses: write a^(-2)");
  bool negative = parser_accept(p, '(');
  if (negative && p->tok.kind == TOK_NUMBER)
    return mistake(p, "a positive exponent is an integer and written without parentheses: a^2; a root is sqrt(a)");
  if (negative && !parser_accept(p, '-')) return mistake_exponent(p);
  *value = short_integer(p, p->tok);
  if (*value < 0) return mistake_exponent(p);
  parser_advance(p);
  if (!negative) return true;
  *value = -*value;
  return parser_accept(p, ')') || mistake_unclosed(p, open, "\")\"");
}

/* After a factor nothing may follow that could be another one. */
static bool ends_factor(struct parser *p) {
  struct token next;
  switch (p->tok.kind) {
  case '\'':
    return mistake_prime(p, p->tok.begin);
  case '^':
    return mistake(p, "a^b^c is ambiguous: write (a^b)^c");
  case '[':
    return mistake(p, "a product is written with \"*\"; the entry of a power is (A^2)[1,1]");
  case TOK_NAME:
    if (parser_token_is(p, p->tok, "for")) return true;
    if (parser_is_keyword(p, p->tok)) return mistake_reserved(p);
    next = lex_token(p->src, p->tok.end, p->end, NULL);
    if (parser_token_is(p, next, "positive"))
      return mistake(p, "a \",\" goes before \"smallest positive\", \"largest positive\"");
    break;
  case TOK_NUMBER:
  case '(':
    break;
  default:
    return true;
  }
  return mistake_at(p, p->tok.begin, "a product is written with \"*\"%s: it is missing before %s",
                    p->open_matrices > 0 ? " and entries are separated by \",\"" : "", parser_show(p, p->tok).text);
}

static const struct expr *parse_power(struct parser *p) {
  const struct expr *base = parse_postfix(p);
  if (!base || p->tok.kind != '^') return base && ends_factor(p) ? base : NULL;
  parser_advance(p);
  int exponent = 0;
  if (!parse_exponent(p, &exponent)) return NULL;
  struct expr *e = node1(p, EXPR_POW, base->span.begin, base);
  if (!e || !ends_factor(p)) return NULL;
  e->exponent = exponent;
  return e;
}

static const struct expr *parse_product(struct parser *p) {
  const struct expr *e = parse_power(p);
  while (e && parser_accept(p, '*')) e = node2(p, EXPR_MUL, e, parse_power(p));
  if (!e || !parser_accept(p, '/')) return e;
  e = node2(p, EXPR_DIV, e, parse_power(p));
  if (e && p->tok.kind == '*') return mistake(p, "a/b*c is ambiguous: write (a/b)*c or a/(b*c)");
  if (e && p->tok.kind == '/') return mistake(p, "a/b/c is ambiguous: write (a/b)/c or a/(b/c)");
  return e;
}

const struct expr *parser_sum(struct parser *p) {
  if (++p->depth > EXPR_MAX_DEPTH + 1)
    return mistake_at(p, p->tok.begin, "nested more than %d levels deep: define names for parts of it", EXPR_MAX_DEPTH);
  struct token minus = p->tok;
  bool negative = parser_accept(p, '-');
  const struct expr *e = parse_product(p);
  if (negative && e) {
    if (expr_leads_with_power(e)) return mistake_at(p, minus.begin, "-a^b is ambiguous: write -(a^b) or (-a)^b");
    e = node1(p, EXPR_NEG, minus.begin, e);
  }
  while (e && (p->tok.kind == '+' || p->tok.kind == '-')) {
    enum expr_kind kind = p->tok.kind == '+' ? EXPR_ADD : EXPR_SUB;
    parser_advance(p);
    e = node2(p, kind, e, parse_product(p));
  }
  p->depth--;
  return e;
}

const struct expr *expr_parse(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct parser p = parser_at(a, src, where, d);
  const struct expr *e = parser_sum(&p);
  if (e && p.tok.kind != TOK_END) e = mistake_trailing(&p);
  free(p.pending);
  return e;
}
