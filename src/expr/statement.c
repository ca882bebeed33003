/* Statements: definitions, roots, trajectories, and relations with their ranges.  The first word, or a ":=" after a
   name, tells which it is; then one function for each line of the grammar in expr.h reads it, with parser.c for the
   expressions inside. */
#include <stdlib.h>
#include <string.h>

#include "parser.h"

/* A name that the statement introduces, or NULL. */
static const char *parse_new_name(struct parser *p, const char *what) {
  if (p->tok.kind != TOK_NAME)
    return mistake_at(p, p->tok.begin, "expected %s, found %s", what, parser_show(p, p->tok).text);
  if (parser_is_keyword(p, p->tok) || parser_is_built_in(p, p->tok)) return mistake_reserved(p);
  const char *name = parser_copy(p, p->tok);
  parser_advance(p);
  return name;
}

static void take_side(struct parser *p, struct stmt *s, const struct expr *e) {
  s->n_sides = 1;
  s->sides = arena_alloc(p->arena, sizeof *s->sides);
  s->sides[0] = e;
}

/* "root" name ":" sum "," ("smallest" | "largest") "positive" */
static bool parse_root(struct parser *p, struct stmt *s) {
  static const char *const form = "a root is declared as root name: polynomial, smallest positive";
  s->kind = STMT_ROOT;
  parser_advance(p);
  s->name_span = (struct span){p->tok.begin, p->tok.end};
  if (!(s->name = parse_new_name(p, "the name of the root"))) return false;
  if (!parser_accept(p, ':')) return mistake(p, form);
  const struct expr *e = parser_sum(p);
  if (!e) return false;
  if (token_is_relation(p->tok.kind)) return mistake(p, "a root is that of an expression: leave \"= 0\" out");
  if (!parser_accept(p, ',')) return p->tok.kind == TOK_END ? mistake(p, form) : mistake_trailing(p);
  s->largest = parser_token_is(p, p->tok, "largest");
  if (!parser_accept_word(p, "smallest") && !parser_accept_word(p, "largest")) return mistake(p, form);
  if (!parser_accept_word(p, "positive")) return mistake(p, form);
  take_side(p, s, e);
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
    parser_advance(p); /* the word or the comma */
    const char *name = parse_new_name(p, "the name of a trajectory");
    if (!name) return false;
    if (!parser_accept(p, '(')) return mistake(p, form);
    const char *param = parse_new_name(p, "the argument of the trajectory");
    if (!param) return false;
    if (!parser_accept(p, ')')) return mistake(p, form);
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
  if (parser_accept(p, '(')) {
    if (!(s->param = parse_new_name(p, "an argument"))) return false;
    parser_advance(p);
  }
  parser_advance(p);
  const struct expr *e = parser_sum(p);
  if (!e) return false;
  if (token_is_relation(p->tok.kind))
    return mistake(p, "a definition has one side after \":=\"; a relation is a statement of its own");
  take_side(p, s, e);
  return true;
}

/* "{" "+1" "," "-1" "}" */
static bool parse_signs(struct parser *p, struct stmt *s) {
  static const char *const parts[] = {"{", "+", "1", ",", "-", "1", "}"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    size_t len = p->tok.end - p->tok.begin;
    if (len != 1 || p->src->text[p->tok.begin] != parts[i][0]) return mistake(p, "the signs are written {+1, -1}");
    parser_advance(p);
  }
  s->range_signs = true;
  return true;
}

/* "for" name "in" range */
static bool parse_range(struct parser *p, struct stmt *s) {
  static const char *const form = "a range is written (a, b), [a, b], (a, b], [a, b) or {+1, -1}";
  if (!(s->range_var = parse_new_name(p, "the variable of the range"))) return false;
  if (!parser_accept_word(p, "in"))
    return mistake(p, "\"in\" follows the variable, as in: for t in (0, t_a); t > 0 is a statement of its own");
  struct token open = p->tok;
  if (open.kind == '{') return parse_signs(p, s);
  if (open.kind != '(' && open.kind != '[') return mistake(p, form);
  s->lo_closed = open.kind == '[';
  parser_advance(p);
  if (!(s->range_lo = parser_sum(p))) return false;
  if (!parser_accept(p, ',')) return mistake(p, form);
  if (!(s->range_hi = parser_sum(p))) return false;
  s->hi_closed = p->tok.kind == ']';
  if (!parser_accept(p, ')') && !parser_accept(p, ']')) return mistake_unclosed(p, open, "\")\" or \"]\"");
  return true;
}

static enum relop relop_of(int kind) {
  return kind == '<' ? REL_LT : kind == TOK_LE ? REL_LE : kind == '>' ? REL_GT : kind == TOK_GE ? REL_GE : REL_EQ;
}

/* What is wrong with a statement that begins with this expression and goes on with the token in hand. */
static void *mistake_no_relation(struct parser *p, const struct expr *e) {
  if (p->tok.kind == TOK_DEFINE && e->kind == EXPR_CALL && e->order > 0)
    return mistake(p, "a derivative is not defined: define the function itself, H(t) := ...");
  if (p->tok.kind == TOK_DEFINE && e->kind == EXPR_CALL)
    return mistake(p, "the argument of a definition is a name: H(t) := ...");
  if (p->tok.kind == TOK_END)
    return mistake(p, "a statement is a definition, name := ..., or a relation, ... = ...; this is only an expression");
  return mistake_trailing(p);
}

/* sum (relop sum)+ [ "for" name "in" range ] */
static bool parse_relation(struct parser *p, struct stmt *s) {
  s->kind = STMT_RELATION;
  enum relop *ops = NULL;
  size_t n_ops = 0, cap_ops = 0;
  const struct expr *side = parser_sum(p);
  if (side && !token_is_relation(p->tok.kind)) return mistake_no_relation(p, side);
  while (side) {
    parser_put_pending(p, side);
    if (!token_is_relation(p->tok.kind)) break;
    *SS_PUSH(ops, n_ops, cap_ops) = relop_of(p->tok.kind);
    parser_advance(p);
    side = parser_sum(p);
  }
  if (side) {
    s->n_sides = (int)p->n_pending;
    s->sides = arena_alloc(p->arena, p->n_pending * sizeof *s->sides);
    parser_take_pending(p, 0, s->sides);
    s->ops = arena_alloc(p->arena, n_ops * sizeof *ops);
    memcpy(s->ops, ops, n_ops * sizeof *ops);
  }
  free(ops);
  return side && (!parser_accept_word(p, "for") || parse_range(p, s));
}

static bool parse_statement(struct parser *p, struct stmt *s) {
  size_t begin = p->tok.begin;
  bool ok = parser_token_is(p, p->tok, "root")         ? parse_root(p, s)
            : parser_token_is(p, p->tok, "trajectory") ? parse_trajectory(p, s)
            : is_definition(p)                         ? parse_definition(p, s)
                                                       : parse_relation(p, s);
  s->span = (struct span){begin, p->prev.end};
  return ok && (p->tok.kind == TOK_END || mistake_trailing(p));
}

const struct stmt *stmt_parse(struct arena *a, const struct source *src, struct span where, struct diag *d) {
  struct parser p = parser_at(a, src, where, d);
  struct stmt *s = arena_alloc(a, sizeof *s);
  bool ok = parse_statement(&p, s);
  free(p.pending);
  return ok ? s : NULL;
}

struct stmt *stmt_between(struct arena *a, const struct stmt *s) {
  if (s->kind != STMT_RELATION || s->n_sides != 2 || s->ops[0] == REL_EQ) return NULL;
  bool less = s->ops[0] == REL_LT || s->ops[0] == REL_LE, closed = s->ops[0] == REL_LE || s->ops[0] == REL_GE;
  const struct expr *modulus = s->sides[!less], *bound = s->sides[less];
  if (modulus->kind != EXPR_ABS) return NULL;
  struct stmt *between = arena_alloc(a, sizeof *between);
  struct expr *minus = arena_alloc(a, sizeof *minus);
  *between = *s;
  between->n_sides = 3;
  between->sides = arena_alloc(a, 3 * sizeof *between->sides);
  between->ops = arena_alloc(a, 2 * sizeof *between->ops);
  *minus = (struct expr){.kind = EXPR_NEG, .n_args = 1, .args = &between->sides[2], .span = bound->span};
  between->sides[0] = minus;
  between->sides[1] = modulus->args[0];
  between->sides[2] = bound;
  between->ops[0] = between->ops[1] = closed ? REL_LE : REL_LT;
  return between;
}
