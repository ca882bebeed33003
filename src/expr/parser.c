/* Recursive descent, one function for each line of the grammar in expr.h, over one token in hand.
   Recursion happens in parse_sum alone and is bounded there; chains (a+b+c, a*b*c, v[1][1]) are loops that lean to
   the left.  NULL means that the first mistake has been reported.  Most of the code is about mistakes: each kind has
   its own sentence that ends in what to write instead. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static const struct expr *parse_sum(struct parser *p);

static bool is_relation(int kind) {
  return kind == '=' || kind == '<' || kind == '>' || kind == TOK_LE || kind == TOK_GE;
}

/* ---- tokens */

static void advance(struct parser *p) {
  p->prev = p->tok;
  p->tok = lex_token(p->src, p->tok.end, p->end, p->diag);
}

static bool token_is(const struct parser *p, struct token t, const char *word) {
  return t.kind == TOK_NAME && t.end - t.begin == strlen(word) && !memcmp(p->src->text + t.begin, word, strlen(word));
}

static bool accept(struct parser *p, int kind) {
  if (p->tok.kind != kind) return false;
  advance(p);
  return true;
}

static bool accept_word(struct parser *p, const char *word) {
  if (!token_is(p, p->tok, word)) return false;
  advance(p);
  return true;
}

static const char *copy(struct parser *p, struct token t) {
  return arena_strndup(p->arena, p->src->text + t.begin, t.end - t.begin);
}

/* The kind of the built-in function of that name, or EXPR_SYM. */
static enum expr_kind function_kind(const struct parser *p, struct token t) {
#define TEST(kind, name)                                                                                               \
  if (token_is(p, t, name)) return kind;
  EXPR_FUNCTIONS(TEST)
#undef TEST
  return EXPR_SYM;
}

static bool is_first_order(const struct parser *p, struct token t) {
  return token_is(p, t, "first_order");
}

/* A name that the language keeps for itself where an expression stands. */
static bool is_built_in(const struct parser *p, struct token t) {
  return function_kind(p, t) != EXPR_SYM || is_first_order(p, t);
}

static bool is_keyword(const struct parser *p, struct token t) {
  return token_is(p, t, "root") || token_is(p, t, "trajectory") || token_is(p, t, "for") || token_is(p, t, "in");
}

/* ---- mistakes */

/* A token as a message shows it. */
struct shown {
  char text[64];
};

static struct shown show(const struct parser *p, struct token t) {
  struct shown s;
  const int longest = 40;
  size_t len = t.end - t.begin;
  if (t.kind == TOK_END)
    snprintf(s.text, sizeof s.text, "the end");
  else if (len > (size_t)longest)
    snprintf(s.text, sizeof s.text, "\"%.*s...\"", longest, p->src->text + t.begin);
  else
    snprintf(s.text, sizeof s.text, "\"%.*s\"", (int)len, p->src->text + t.begin);
  return s;
}

/* Line and column of a place, for messages that name a second one. */
static struct shown show_place(const struct parser *p, size_t at) {
  size_t line = 1, column = 1;
  for (size_t i = 0; i < at; i++) {
    unsigned char c = (unsigned char)p->src->text[i];
    column = c == '\n' ? 1 : column + ((c & 0xC0) != 0x80);
    line += c == '\n';
  }
  struct shown s;
  snprintf(s.text, sizeof s.text, "%zu:%zu", line, column);
  return s;
}

/* Reports a mistake; NULL, so that every function can return it as its own failure. */
static void *fail_at(struct parser *p, size_t at, const char *fmt, ...) SS_PRINTF(3, 4);
static void *fail_at(struct parser *p, size_t at, const char *fmt, ...) {
  char what[400];
  va_list ap;
  va_start(ap, fmt);
  vsnprintf(what, sizeof what, fmt, ap);
  va_end(ap);
  diag_at(p->diag, p->src, at, "%s", what);
  return NULL;
}

static void *fail(struct parser *p, const char *what) {
  return fail_at(p, p->tok.begin, "%s", what);
}

static void *fail_prime(struct parser *p, size_t at) {
  return fail_at(p, at,
                 "a prime marks a derivative: it follows the name of a function and is followed by \"(\", "
                 "as in H'(t); a transpose is written transpose(...)");
}

static void *fail_reserved(struct parser *p) {
  return fail_at(p, p->tok.begin, "%s is a reserved word and cannot be a name", show(p, p->tok).text);
}

static void *fail_unclosed(struct parser *p, struct token open, const char *closer) {
  return fail_at(p, p->tok.begin, "expected %s to close the \"%c\" opened at %s, found %s", closer, open.kind,
                 show_place(p, open.begin).text, show(p, p->tok).text);
}

/* Where an operand should begin, something else stands. */
static void *fail_operand(struct parser *p) {
  int before = p->prev.kind;
  if (is_relation(before) && is_relation(p->tok.kind)) return fail(p, "the relations are written = < <= > >=");
  switch (p->tok.kind) {
  case '-': /* the one at the beginning of a sum has been taken: this one follows an operator */
    return fail_at(p, p->tok.begin, "a sign after \"%c\" needs parentheses: write a%c(-b)", before, before);
  case '+':
    return fail(p, "a leading \"+\" is not written: leave it out");
  case '\'':
    return fail_prime(p, p->tok.begin);
  case '*':
    if (before == '*') return fail(p, "a power is written a^2");
    break;
  case '{':
    return fail(p, "braces are used for the signs alone: for eps in {+1, -1}");
  default:
    break;
  }
  if (p->tok.kind == TOK_END && p->prev.kind == TOK_END) return fail(p, "the formula is empty");
  return fail_at(p, p->tok.begin, "expected a number, a name, \"(\" or \"[\", found %s", show(p, p->tok).text);
}

/* After a complete formula something is left. */
static void *fail_trailing(struct parser *p) {
  switch (p->tok.kind) {
  case ')':
  case ']':
  case '}':
    return fail_at(p, p->tok.begin, "\"%c\" closes nothing: no bracket is open", p->tok.kind);
  case '=':
  case '<':
  case '>':
  case TOK_LE:
  case TOK_GE:
    return fail(p, "a relation has no place here: only an expression has");
  case TOK_DEFINE:
    return fail(p, "only a name or name(argument) can stand before \":=\"; a relation is written \"=\"");
  case ',':
    return fail(p, "unexpected \",\": decimals have a point, and rows are written [a, b]");
  case ';':
    return fail(p, "unexpected \";\": rows are separated by it inside [ ] only");
  case ':':
    return fail(p, "unexpected \":\": a range of indices is written inside [ ]; a definition has \":=\"");
  case '{':
    return fail(p, "braces are used for the signs alone: for eps in {+1, -1}");
  default:
    break;
  }
  if (token_is(p, p->tok, "for")) return fail(p, "\"for\" gives the range of a relation; there is no relation here");
  return fail_at(p, p->tok.begin, "unexpected %s", show(p, p->tok).text);
}

/* ---- nodes */

static struct expr *new_node(struct parser *p, enum expr_kind kind, size_t begin, int n_args) {
  if (++p->n_nodes > EXPR_MAX_NODES)
    return fail_at(p, begin, "a formula of more than %d nodes: define names for its parts", EXPR_MAX_NODES);
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

static void put_pending(struct parser *p, const struct expr *e) {
  p->pending = ss_grow(p->pending, p->n_pending, &p->cap_pending, sizeof *p->pending);
  p->pending[p->n_pending++] = e;
}

/* Moves the operands that have been waiting since there were `from` of them. */
static void take_pending(struct parser *p, size_t from, const struct expr **to) {
  memcpy(to, p->pending + from, (p->n_pending - from) * sizeof *to);
  p->n_pending = from;
}

/* ---- expressions, innermost first */

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
  advance(p);
  if (p->tok.kind == ')') return fail(p, "nothing stands between the parentheses");
  const struct expr *inner = parse_sum(p);
  if (!inner) return NULL;
  if (p->tok.kind == ',' || p->tok.kind == ';')
    return fail(p, "one expression goes between parentheses; a row is written [a, b], a column [a; b]");
  if (!accept(p, ')')) return fail_unclosed(p, open, "\")\"");
  return node1(p, EXPR_PAREN, open.begin, inner);
}

/* "first_order" "(" sum ";" name ("," name)* ")" */
static const struct expr *parse_first_order(struct parser *p) {
  static const char *const form = "it is written first_order(expression; x, y), with the small symbols after the \";\"";
  struct token name = p->tok, open;
  size_t from = p->n_pending;
  advance(p);
  open = p->tok;
  if (!accept(p, '(')) return fail_at(p, name.begin, "first_order is a built-in form and cannot be a name; %s", form);
  const struct expr *inner = parse_sum(p);
  if (!inner) return NULL;
  put_pending(p, inner);
  if (p->tok.kind != ';') return fail(p, form);
  do {
    advance(p);
    struct token t = p->tok;
    if (t.kind != TOK_NAME || is_keyword(p, t) || is_built_in(p, t)) return fail(p, form);
    advance(p);
    struct expr *symbol = new_node(p, EXPR_SYM, t.begin, 0);
    if (!symbol) return NULL;
    symbol->name = copy(p, t);
    put_pending(p, symbol);
  } while (p->tok.kind == ',');
  if (!accept(p, ')')) return fail_unclosed(p, open, "\")\"");
  struct expr *e = new_node(p, EXPR_FIRST_ORDER, name.begin, (int)(p->n_pending - from));
  if (e) take_pending(p, from, e->args);
  return e;
}

/* "(" sum ")" after the name of a function. */
static const struct expr *parse_argument(struct parser *p, struct token name) {
  struct token open = p->tok;
  advance(p);
  if (p->tok.kind == ')') return fail_at(p, p->tok.begin, "%s needs an argument", show(p, name).text);
  const struct expr *arg = parse_sum(p);
  if (!arg) return NULL;
  if (p->tok.kind == ',' || p->tok.kind == ';')
    return fail_at(p, p->tok.begin, "%s takes one argument; a row is written [a, b]", show(p, name).text);
  if (!accept(p, ')')) return fail_unclosed(p, open, "\")\"");
  return arg;
}

/* "(" sum "," sum ")" */
static const struct expr *parse_two_arguments(struct parser *p, enum expr_kind kind, struct token name) {
  struct token open = p->tok;
  advance(p);
  const struct expr *a = parse_sum(p);
  if (!a) return NULL;
  if (!accept(p, ','))
    return fail_at(p, p->tok.begin, "%s takes two arguments, separated by \",\"", show(p, name).text);
  const struct expr *b = parse_sum(p);
  if (!b) return NULL;
  if (p->tok.kind == ',')
    return fail_at(p, p->tok.begin, "%s takes two arguments, separated by \",\"", show(p, name).text);
  if (!accept(p, ')')) return fail_unclosed(p, open, "\")\"");
  struct expr *e = node2(p, kind, a, b);
  if (e) e->span.begin = name.begin;
  return e;
}

static const struct expr *parse_function(struct parser *p, enum expr_kind kind) {
  struct token name = p->tok;
  advance(p);
  if (p->tok.kind == '\'')
    return fail_at(p, p->tok.begin, "the built-in function %s takes no prime", show(p, name).text);
  if (p->tok.kind == '^') return fail_at(p, p->tok.begin, "a power of a function is written sin(x)^2");
  if (p->tok.kind != '(')
    return fail_at(p, name.begin, "%s is a built-in function and cannot be a name; its argument stands in parentheses",
                   show(p, name).text);
  if (kind == EXPR_HYPOT) return parse_two_arguments(p, kind, name);
  return node1(p, kind, name.begin, parse_argument(p, name));
}

/* name | name "'"* "(" sum ")" */
static const struct expr *parse_name(struct parser *p) {
  struct token name = p->tok;
  if (is_keyword(p, name)) return fail_reserved(p);
  if (is_first_order(p, name)) return parse_first_order(p);
  enum expr_kind function = function_kind(p, name);
  if (function != EXPR_SYM) return parse_function(p, function);
  advance(p);
  size_t first_prime = p->tok.begin;
  int primes = 0;
  while (p->tok.kind == '\'') {
    if (++primes > EXPR_MAX_PRIMES) return fail(p, "too many primes");
    advance(p);
  }
  struct expr *e;
  if (p->tok.kind == '(')
    e = node1(p, EXPR_CALL, name.begin, parse_argument(p, name));
  else if (primes > 0)
    return fail_prime(p, first_prime);
  else
    e = new_node(p, EXPR_SYM, name.begin, 0);
  if (!e) return NULL;
  e->name = copy(p, name);
  e->order = primes;
  return e;
}

/* One row of a matrix onto the pending operands.  Every row has as many entries as the first: *cols, or 0 before. */
static bool parse_row(struct parser *p, int row, int *cols) {
  int n = 0;
  do {
    if (*cols > 0 && n == *cols)
      return fail_at(p, p->tok.begin, "row %d has more than the %d entries of row 1", row, *cols);
    const struct expr *entry = parse_sum(p);
    if (!entry) return false;
    put_pending(p, entry);
    n++;
  } while (accept(p, ','));
  if (*cols > 0 && n < *cols)
    return fail_at(p, p->tok.begin, "row %d ends after %d of the %d entries of row 1", row, n, *cols);
  *cols = n;
  return true;
}

static const struct expr *parse_matrix(struct parser *p) {
  struct token open = p->tok;
  size_t from = p->n_pending;
  int rows = 0, cols = 0;
  advance(p);
  if (p->tok.kind == ']') return fail(p, "a matrix has at least one entry");
  p->open_matrices++;
  do {
    if (!parse_row(p, ++rows, &cols)) return NULL;
  } while (accept(p, ';'));
  p->open_matrices--;
  if (!accept(p, ']')) return fail_unclosed(p, open, "\"]\"");
  struct expr *e = new_node(p, EXPR_MATRIX, open.begin, (int)(p->n_pending - from));
  if (!e) return NULL;
  take_pending(p, from, e->args);
  e->rows = rows;
  e->cols = cols;
  return e;
}

static const struct expr *parse_primary(struct parser *p) {
  switch (p->tok.kind) {
  case TOK_NUMBER: {
    struct token t = p->tok;
    advance(p);
    struct expr *e = new_node(p, EXPR_NUM, t.begin, 0);
    if (e) e->name = copy(p, t);
    return e;
  }
  case TOK_NAME:
    return parse_name(p);
  case '(':
    return parse_paren(p);
  case '[':
    return parse_matrix(p);
  default:
    return fail_operand(p);
  }
}

static bool parse_index_number(struct parser *p, int *value) {
  *value = short_integer(p, p->tok);
  if (*value < 1)
    return fail_at(p, p->tok.begin,
                   "an index is an integer from 1 to %d or a range such as 1:2; a product with a matrix has \"*\"",
                   EXPR_MAX_INDEX);
  advance(p);
  return true;
}

/* "[" index ["," index] "]" */
static const struct expr *parse_index(struct parser *p, const struct expr *base) {
  struct token open = p->tok;
  int index[4] = {0}, n = 0;
  bool range[2] = {false, false};
  do {
    advance(p);
    if (n == 2) return fail(p, "an entry has at most two indices");
    if (!parse_index_number(p, &index[2 * n])) return NULL;
    index[2 * n + 1] = index[2 * n];
    if (accept(p, ':')) {
      range[n] = true;
      size_t at = p->tok.begin;
      if (!parse_index_number(p, &index[2 * n + 1])) return NULL;
      if (index[2 * n + 1] < index[2 * n]) return fail_at(p, at, "a range of indices goes upwards");
    }
    n++;
  } while (p->tok.kind == ',');
  if (!accept(p, ']')) return fail_unclosed(p, open, "\"]\"");
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

/* digits | "(" "-" digits ")", after "^" */
static bool parse_exponent(struct parser *p, int *value) {
  struct token open = p->tok;
  if (open.kind == '-') return fail(p, "a negative exponent needs parentheses: write a^(-2)");
  bool negative = accept(p, '(');
  if (negative && p->tok.kind == TOK_NUMBER) return fail(p, "a positive exponent is written without parentheses: a^2");
  if (negative && !accept(p, '-')) return fail(p, "an exponent is an integer such as a^2 or a^(-2)");
  *value = short_integer(p, p->tok);
  if (*value < 0)
    return fail(p, "an exponent is an integer of at most 4 digits, such as a^2 or a^(-2); a root is sqrt(a)");
  advance(p);
  if (!negative) return true;
  *value = -*value;
  return accept(p, ')') || fail_unclosed(p, open, "\")\"");
}

/* After a factor nothing may follow that could be another one. */
static bool ends_factor(struct parser *p) {
  struct token next;
  switch (p->tok.kind) {
  case '\'':
    return fail_prime(p, p->tok.begin);
  case '^':
    return fail(p, "a^b^c is ambiguous: write (a^b)^c");
  case '[':
    return fail(p, "a product is written with \"*\"; the entry of a power is (A^2)[1,1]");
  case TOK_NAME:
    if (token_is(p, p->tok, "for")) return true;
    if (is_keyword(p, p->tok)) return fail_reserved(p);
    next = lex_token(p->src, p->tok.end, p->end, NULL);
    if (token_is(p, next, "positive"))
      return fail(p, "a \",\" goes before \"smallest positive\", \"largest positive\"");
    break;
  case TOK_NUMBER:
  case '(':
    break;
  default:
    return true;
  }
  return fail_at(p, p->tok.begin, "a product is written with \"*\"%s: it is missing before %s",
                 p->open_matrices > 0 ? " and entries are separated by \",\"" : "", show(p, p->tok).text);
}

static const struct expr *parse_power(struct parser *p) {
  const struct expr *base = parse_postfix(p);
  if (!base || p->tok.kind != '^') return base && ends_factor(p) ? base : NULL;
  advance(p);
  int exponent;
  if (!parse_exponent(p, &exponent)) return NULL;
  struct expr *e = node1(p, EXPR_POW, base->span.begin, base);
  if (!e || !ends_factor(p)) return NULL;
  e->exponent = exponent;
  return e;
}

static const struct expr *parse_product(struct parser *p) {
  const struct expr *e = parse_power(p);
  while (e && accept(p, '*')) e = node2(p, EXPR_MUL, e, parse_power(p));
  if (!e || !accept(p, '/')) return e;
  e = node2(p, EXPR_DIV, e, parse_power(p));
  if (e && p->tok.kind == '*') return fail(p, "a/b*c is ambiguous: write (a/b)*c or a/(b*c)");
  if (e && p->tok.kind == '/') return fail(p, "a/b/c is ambiguous: write (a/b)/c or a/(b/c)");
  return e;
}

static const struct expr *parse_sum(struct parser *p) {
  if (++p->depth > EXPR_MAX_DEPTH + 1)
    return fail_at(p, p->tok.begin, "nested more than %d levels deep: define names for parts of it", EXPR_MAX_DEPTH);
  struct token minus = p->tok;
  bool negative = accept(p, '-');
  const struct expr *e = parse_product(p);
  if (negative && e) {
    if (expr_leads_with_power(e)) return fail_at(p, minus.begin, "-a^b is ambiguous: write -(a^b) or (-a)^b");
    e = node1(p, EXPR_NEG, minus.begin, e);
  }
  while (e && (p->tok.kind == '+' || p->tok.kind == '-')) {
    enum expr_kind kind = p->tok.kind == '+' ? EXPR_ADD : EXPR_SUB;
    advance(p);
    e = node2(p, kind, e, parse_product(p));
  }
  p->depth--;
  return e;
}

/* ---- statements */

/* A name that the statement introduces, or NULL. */
static const char *parse_new_name(struct parser *p, const char *what) {
  if (p->tok.kind != TOK_NAME) return fail_at(p, p->tok.begin, "expected %s, found %s", what, show(p, p->tok).text);
  if (is_keyword(p, p->tok) || is_built_in(p, p->tok)) return fail_reserved(p);
  const char *name = copy(p, p->tok);
  advance(p);
  return name;
}

static const struct expr **one_side(struct parser *p, const struct expr *e) {
  const struct expr **sides = arena_alloc(p->arena, sizeof *sides);
  sides[0] = e;
  return sides;
}

/* "root" name ":" sum "," ("smallest" | "largest") "positive" */
static bool parse_root(struct parser *p, struct stmt *s) {
  static const char *const form = "a root is declared as root name: polynomial, smallest positive";
  s->kind = STMT_ROOT;
  advance(p);
  s->name_span = (struct span){p->tok.begin, p->tok.end};
  if (!(s->name = parse_new_name(p, "the name of the root"))) return false;
  if (!accept(p, ':')) return fail(p, form);
  const struct expr *e = parse_sum(p);
  if (!e) return false;
  if (is_relation(p->tok.kind)) return fail(p, "a root is that of an expression: leave \"= 0\" out");
  if (!accept(p, ',')) return p->tok.kind == TOK_END ? fail(p, form) : fail_trailing(p);
  s->largest = token_is(p, p->tok, "largest");
  if (!accept_word(p, "smallest") && !accept_word(p, "largest")) return fail(p, form);
  if (!accept_word(p, "positive")) return fail(p, form);
  s->n_sides = 1;
  s->sides = one_side(p, e);
  return true;
}

/* "trajectory" name "(" name ")" ("," name "(" name ")")* */
static bool parse_trajectory(struct parser *p, struct stmt *s) {
  static const char *const form = "a trajectory is declared as trajectory z_1(t), z_2(t)";
  s->kind = STMT_TRAJECTORY;
  size_t room = 0; /* one for each comma to come, and one */
  for (struct token t = p->tok; t.kind != TOK_END && t.kind != TOK_BAD; room += t.kind == ',')
    t = lex_token(p->src, t.end, p->end, NULL);
  s->names = arena_alloc(p->arena, (room + 1) * sizeof *s->names);
  s->params = arena_alloc(p->arena, (room + 1) * sizeof *s->params);
  do {
    advance(p); /* the word or the comma */
    const char *name = parse_new_name(p, "the name of a trajectory");
    if (!name) return false;
    if (!accept(p, '(')) return fail(p, form);
    const char *param = parse_new_name(p, "the argument of the trajectory");
    if (!param) return false;
    if (!accept(p, ')')) return fail(p, form);
    s->names[s->n_names] = name;
    s->params[s->n_names++] = param;
  } while (p->tok.kind == ',');
  return true;
}

/* name ":=" or name "(" name ")" ":=" */
static bool is_definition(const struct parser *p) {
  static const int forms[2][4] = {{TOK_DEFINE, 0, 0, 0}, {'(', TOK_NAME, ')', TOK_DEFINE}};
  if (p->tok.kind != TOK_NAME) return false;
  for (int form = 0; form < 2; form++) {
    struct token t = p->tok;
    for (int i = 0; i < 4; i++) {
      t = lex_token(p->src, t.end, p->end, NULL);
      if (t.kind != forms[form][i]) break;
      if (t.kind == TOK_DEFINE) return true;
    }
  }
  return false;
}

static bool parse_definition(struct parser *p, struct stmt *s) {
  s->kind = STMT_DEFINE;
  s->name_span = (struct span){p->tok.begin, p->tok.end};
  if (!(s->name = parse_new_name(p, "a name"))) return false;
  if (accept(p, '(')) {
    if (!(s->param = parse_new_name(p, "an argument"))) return false;
    advance(p);
  }
  advance(p);
  const struct expr *e = parse_sum(p);
  if (!e) return false;
  if (is_relation(p->tok.kind))
    return fail(p, "a definition has one side after \":=\"; a relation is a statement of its own");
  s->n_sides = 1;
  s->sides = one_side(p, e);
  return true;
}

/* "{" "+1" "," "-1" "}" */
static bool parse_signs(struct parser *p, struct stmt *s) {
  static const char *const parts[] = {"{", "+", "1", ",", "-", "1", "}"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    size_t len = p->tok.end - p->tok.begin;
    if (len != 1 || p->src->text[p->tok.begin] != parts[i][0]) return fail(p, "the signs are written {+1, -1}");
    advance(p);
  }
  s->range_signs = true;
  return true;
}

/* "for" name "in" range */
static bool parse_range(struct parser *p, struct stmt *s) {
  static const char *const form = "a range is written (a, b), [a, b], (a, b], [a, b) or {+1, -1}";
  if (!(s->range_var = parse_new_name(p, "the variable of the range"))) return false;
  if (!accept_word(p, "in")) return fail(p, "\"in\" follows the variable, as in: for t in (0, t_a)");
  struct token open = p->tok;
  if (open.kind == '{') return parse_signs(p, s);
  if (open.kind != '(' && open.kind != '[') return fail(p, form);
  s->lo_closed = open.kind == '[';
  advance(p);
  if (!(s->range_lo = parse_sum(p))) return false;
  if (!accept(p, ',')) return fail(p, form);
  if (!(s->range_hi = parse_sum(p))) return false;
  s->hi_closed = p->tok.kind == ']';
  if (!accept(p, ')') && !accept(p, ']')) return fail_unclosed(p, open, "\")\" or \"]\"");
  return true;
}

static enum relop relop_of(int token_kind) {
  switch (token_kind) {
  case '<':
    return REL_LT;
  case TOK_LE:
    return REL_LE;
  case '>':
    return REL_GT;
  case TOK_GE:
    return REL_GE;
  default:
    return REL_EQ;
  }
}

/* What is wrong with a statement that begins with this expression and goes on with the token in hand. */
static void *fail_no_relation(struct parser *p, const struct expr *e) {
  if (p->tok.kind == TOK_DEFINE && e->kind == EXPR_CALL && e->order > 0)
    return fail(p, "a derivative is not defined: define the function itself, H(t) := ...");
  if (p->tok.kind == TOK_DEFINE && e->kind == EXPR_CALL)
    return fail(p, "the argument of a definition is a name: H(t) := ...");
  if (p->tok.kind == TOK_END)
    return fail(p, "a statement is a definition, name := ..., or a relation, ... = ...; this is only an expression");
  return fail_trailing(p);
}

/* sum (relop sum)+ [ "for" name "in" range ] */
static bool parse_relation(struct parser *p, struct stmt *s) {
  s->kind = STMT_RELATION;
  enum relop *ops = NULL;
  size_t n_ops = 0, cap_ops = 0;
  const struct expr *side = parse_sum(p);
  if (side && !is_relation(p->tok.kind)) return fail_no_relation(p, side);
  while (side) {
    put_pending(p, side);
    if (!is_relation(p->tok.kind)) break;
    ops = ss_grow(ops, n_ops, &cap_ops, sizeof *ops);
    ops[n_ops++] = relop_of(p->tok.kind);
    advance(p);
    side = parse_sum(p);
  }
  if (side) {
    s->n_sides = (int)p->n_pending;
    s->sides = arena_alloc(p->arena, p->n_pending * sizeof *s->sides);
    take_pending(p, 0, s->sides);
    s->ops = arena_alloc(p->arena, n_ops * sizeof *ops);
    memcpy(s->ops, ops, n_ops * sizeof *ops);
  }
  free(ops);
  return side && (!accept_word(p, "for") || parse_range(p, s));
}

static bool parse_statement(struct parser *p, struct stmt *s) {
  size_t begin = p->tok.begin;
  bool ok = token_is(p, p->tok, "root")         ? parse_root(p, s)
            : token_is(p, p->tok, "trajectory") ? parse_trajectory(p, s)
            : is_definition(p)                  ? parse_definition(p, s)
                                                : parse_relation(p, s);
  s->span = (struct span){begin, p->prev.end};
  return ok && (p->tok.kind == TOK_END || fail_trailing(p));
}

/* ---- entry points */

/* With the first token in hand; the one before it is an end, so that an empty formula shows as such. */
static struct parser parser_at(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct token start = {TOK_END, where.begin, where.begin};
  struct parser p = {.arena = a, .src = src, .end = where.end, .diag = d, .tok = start};
  advance(&p);
  return p;
}

const struct stmt *stmt_parse(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct parser p = parser_at(a, src, where, d);
  struct stmt *s = arena_alloc(a, sizeof *s);
  bool ok = parse_statement(&p, s);
  free(p.pending);
  return ok ? s : NULL;
}

const struct expr *expr_parse(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct parser p = parser_at(a, src, where, d);
  const struct expr *e = parse_sum(&p);
  if (e && p.tok.kind != TOK_END) e = fail_trailing(&p);
  free(p.pending);
  return e;
}
