/* Trees as text that parses back to the same tree.
   A node's text is what stands before, between and after its operands, so writing is one walk with a list of open
   nodes on the heap, shared with the LaTeX writer.  Parentheses that a tree does not hold (scalars have none) are put
   in where an operand binds less tightly than the grammar asks of its place. */
#include <stdlib.h>
#include <string.h>

#include "expr_impl.h"

struct open_node {
  const struct expr *e;
  int next; /* the operand that comes next */
};

void expr_write(struct text *out, const struct expr *e, expr_between *between) {
  FREED struct open_node *open = NULL;
  size_t n = 0, cap = 0;
  *SS_PUSH(open, n, cap) = (struct open_node){e, 0};
  while (n > 0) {
    struct open_node *o = &open[n - 1];
    const struct expr *node = o->e;
    int i = o->next++;
    between(out, node, i, n > 1 ? open[n - 2].e : NULL);
    if (i == node->n_args) {
      n--;
      continue;
    }
    *SS_PUSH(open, n, cap) = (struct open_node){node->args[i], 0};
  }
}

/* What binds less tightly than a name; how tightly its first operand and the others must bind.  What is not here holds
   its operands between signs of its own. */
static const struct binding {
  enum expr_kind kind;
  enum level own, first, other;
} bindings[] = {
    {EXPR_ADD, LEVEL_SUM, LEVEL_SUM, LEVEL_QUOTIENT},       {EXPR_SUB, LEVEL_SUM, LEVEL_SUM, LEVEL_QUOTIENT},
    {EXPR_NEG, LEVEL_SUM, LEVEL_QUOTIENT, LEVEL_SUM},       {EXPR_MUL, LEVEL_PRODUCT, LEVEL_PRODUCT, LEVEL_POWER},
    {EXPR_DIV, LEVEL_QUOTIENT, LEVEL_PRODUCT, LEVEL_POWER}, {EXPR_POW, LEVEL_POWER, LEVEL_POSTFIX, LEVEL_SUM},
    {EXPR_INDEX, LEVEL_POSTFIX, LEVEL_POSTFIX, LEVEL_SUM}};

static struct binding binding(enum expr_kind k) {
  for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++)
    if (bindings[i].kind == k) return bindings[i];
  return (struct binding){k, LEVEL_PRIMARY, LEVEL_SUM, LEVEL_SUM};
}

enum level expr_operand_level(enum expr_kind k, int i) {
  return i == 0 ? binding(k).first : binding(k).other;
}

enum level expr_level(const struct expr *e) {
  return binding(e->kind).own;
}

bool expr_leads_with_power(const struct expr *e) {
  while (e->kind == EXPR_MUL || e->kind == EXPR_DIV) e = e->args[0];
  return e->kind == EXPR_POW;
}

static bool needs_parentheses(const struct expr *e, int i) {
  const struct expr *arg = e->args[i];
  return expr_level(arg) < expr_operand_level(e->kind, i) || (e->kind == EXPR_NEG && expr_leads_with_power(arg)) ||
         (e->kind == EXPR_INDEX && arg->kind == EXPR_NUM);
}

const char *expr_function_name(enum expr_kind k) {
  static const char *const names[EXPR_INDEX + 1] = {
#define NAME(kind, name) [kind] = name,
      EXPR_FUNCTIONS(NAME)
#undef NAME
  };
  return names[k];
}

static void print_indices(struct text *out, const struct expr *e) {
  for (int k = 0; k < e->n_index; k++) {
    text_printf(out, "%c%d", k == 0 ? '[' : ',', e->index[2 * k]);
    if (e->index_range[k]) text_printf(out, ":%d", e->index[2 * k + 1]);
  }
  text_add(out, "]");
}

static void print_primed(struct text *out, const struct expr *e) {
  text_add(out, e->name);
  for (int k = 0; k < e->order; k++) text_add(out, "'");
}

void expr_write_signs(struct text *out, const struct expr_signs *s, const struct expr *e, int i) {
  bool line = e->kind == EXPR_MATRIX ? i % e->cols == 0 : e->kind == EXPR_FIRST_ORDER && i == 1;
  const char *sign = i == 0 ? s->before : i == e->n_args ? s->behind : line ? s->line : s->between;
  if (sign) text_add(out, sign);
}

static void print_symbols(struct text *out, const struct expr *e, int i) {
  static const struct expr_signs call = {"(", ", ", .behind = ")"};
  static const struct expr_signs signs[EXPR_INDEX + 1] = {
      [EXPR_NEG] = {.before = "-"},
      [EXPR_ADD] = {.between = " + "},
      [EXPR_SUB] = {.between = " - "},
      [EXPR_MUL] = {.between = "*"},
      [EXPR_DIV] = {.between = "/"},
      [EXPR_PAREN] = {"(", .behind = ")"},
      [EXPR_FIRST_ORDER] = {"first_order(", ", ", "; ", ")"},
      [EXPR_MATRIX] = {"[", ", ", "; ", "]"},
  };
  const char *function = expr_function_name(e->kind);
  bool last = i == e->n_args, named = e->kind == EXPR_NUM || e->kind == EXPR_SYM || e->kind == EXPR_CALL;
  if (i == 0 && named) print_primed(out, e);
  if (i == 0 && function) text_add(out, function);
  expr_write_signs(out, function || e->kind == EXPR_CALL ? &call : &signs[e->kind], e, i);
  if (last && e->kind == EXPR_POW) text_printf(out, e->exponent < 0 ? "^(%d)" : "^%d", e->exponent);
  if (last && e->kind == EXPR_INDEX) print_indices(out, e);
}

static void print_between(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  (void)parent;
  if (i > 0 && needs_parentheses(e, i - 1)) text_add(out, ")");
  print_symbols(out, e, i);
  if (i < e->n_args && needs_parentheses(e, i)) text_add(out, "(");
}

void expr_print(struct text *out, const struct expr *e) {
  expr_write(out, e, print_between);
}

/* --- As prose --- */

/* (a, b): a column, or a row that is transposed. */
static bool is_tuple(const struct expr *e, const struct expr *parent) {
  return e->kind == EXPR_MATRIX && (e->cols == 1 || (e->rows == 1 && parent && parent->kind == EXPR_TRANSPOSE));
}

static bool is_entry(const struct expr *e) {
  return e->kind == EXPR_INDEX && e->args[0]->kind == EXPR_SYM && !strchr(e->args[0]->name, '_') && e->n_index == 2 &&
         !e->index_range[0] && !e->index_range[1] && e->index[0] < 10 && e->index[2] < 10;
}

bool expr_is_understood(const struct expr *e) {
  return e->kind == EXPR_CALL && e->name[0] >= 'a' && e->name[0] <= 'z' && e->args[0]->kind == EXPR_SYM &&
         strcmp(e->args[0]->name, "t") == 0;
}

/* The operand of a^-1 or a^t. */
static bool needs_plain_parentheses(const struct expr *e) {
  bool raised = e->kind == EXPR_INV || (e->kind == EXPR_TRANSPOSE && !is_tuple(e->args[0], e));
  return raised && expr_level(e->args[0]) < LEVEL_POSTFIX;
}

bool expr_begins_with_digit(const struct expr *e) {
  return e->kind == EXPR_NUM || (e->kind == EXPR_POW && e->args[0]->kind == EXPR_NUM);
}

static void plain_symbols(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  bool first = i == 0, last = i == e->n_args;
  if (e->kind == EXPR_MUL)
    text_add(out, i != 1 ? "" : expr_begins_with_digit(e->args[1]) ? " * " : " ");
  else if (e->kind == EXPR_ABS)
    text_add(out, "|");
  else if (e->kind == EXPR_INV)
    text_add(out, last ? "^-1" : "");
  else if (e->kind == EXPR_TRANSPOSE)
    text_add(out, last && !is_tuple(e->args[0], e) ? "^t" : "");
  else if (is_tuple(e, parent))
    text_add(out, first ? "(" : last ? ")" : ", ");
  else if (is_entry(e) && last)
    text_printf(out, "_%d%d", e->index[0], e->index[2]);
  else if (!expr_is_understood(e))
    print_symbols(out, e, i);
  else if (first)
    print_primed(out, e);
}

static void plain_between(struct text *out, const struct expr *e, int i, const struct expr *parent) {
  bool hidden = parent && expr_is_understood(parent);
  if (hidden) return;
  if (i > 0 && (needs_parentheses(e, i - 1) || needs_plain_parentheses(e))) text_add(out, ")");
  plain_symbols(out, e, i, parent);
  if (i < e->n_args && (needs_parentheses(e, i) || needs_plain_parentheses(e))) text_add(out, "(");
}

void expr_plain(struct text *out, const struct expr *e) {
  expr_write(out, e, plain_between);
}

const char *const relop_sign[] = {[REL_EQ] = "=", [REL_LT] = "<", [REL_LE] = "<=", [REL_GT] = ">", [REL_GE] = ">="};

void stmt_plain(struct text *out, const struct stmt *s) {
  if (s->kind == STMT_DEFINE) text_printf(out, s->param ? "%s(%s) = " : "%s = ", s->name, s->param);
  if (s->kind == STMT_ROOT)
    text_printf(out, "%s is the %s positive root of ", s->name, s->largest ? "largest" : "smallest");
  const char *sign = NULL;
  int others = 0;
  for (int i = 0; i < s->n_sides; i++) others += s->sides[i]->kind != EXPR_FIRST_ORDER;
  for (int i = 0; i < s->n_sides; i++) {
    const struct expr *side = s->sides[i];
    if (side->kind == EXPR_FIRST_ORDER && others > 1) continue; /* the others say it */
    if (sign) text_printf(out, " %s ", sign);
    expr_plain(out, side->kind == EXPR_FIRST_ORDER ? side->args[0] : side);
    sign = s->kind == STMT_RELATION && i + 1 < s->n_sides ? relop_sign[s->ops[i]] : NULL;
  }
}

/* --- Statements --- */

void stmt_print_step(struct text *out, const struct stmt *s, int k) {
  expr_print(out, s->sides[k]);
  text_printf(out, " %s ", relop_sign[s->ops[k]]);
  expr_print(out, s->sides[k + 1]);
}

void stmt_print_range(struct text *out, const struct stmt *s) {
  if (!s->range_var) return;
  text_printf(out, " for %s in ", s->range_var);
  if (s->range_signs) {
    text_add(out, "{+1, -1}");
    return;
  }
  text_add(out, s->lo_closed ? "[" : "(");
  expr_print(out, s->range_lo);
  text_add(out, ", ");
  expr_print(out, s->range_hi);
  text_add(out, s->hi_closed ? "]" : ")");
}

static void print_relation(struct text *out, const struct stmt *s) {
  for (int i = 0; i < s->n_sides; i++) {
    if (i > 0) text_printf(out, " %s ", relop_sign[s->ops[i - 1]]);
    expr_print(out, s->sides[i]);
  }
  stmt_print_range(out, s);
}

void stmt_print(struct text *out, const struct stmt *s) {
  switch (s->kind) {
  case STMT_DEFINE:
    text_add(out, s->name);
    if (s->param) text_printf(out, "(%s)", s->param);
    text_add(out, " := ");
    expr_print(out, s->sides[0]);
    break;
  case STMT_RELATION:
    print_relation(out, s);
    break;
  case STMT_ROOT:
    text_printf(out, "root %s: ", s->name);
    expr_print(out, s->sides[0]);
    text_add(out, s->largest ? ", largest positive" : ", smallest positive");
    break;
  case STMT_TRAJECTORY:
    for (int i = 0; i < s->n_names; i++)
      text_printf(out, "%s%s(%s)", i == 0 ? "trajectory " : ", ", s->names[i], s->params[i]);
    break;
  }
}

static bool same_text(const char *a, const char *b) {
  return a == b || (a && b && !strcmp(a, b));
}

bool expr_same_node(const struct expr *a, const struct expr *b) {
  return a->kind == b->kind && same_text(a->name, b->name) && a->order == b->order && a->exponent == b->exponent &&
         a->rows == b->rows && a->cols == b->cols && a->n_index == b->n_index &&
         !memcmp(a->index, b->index, sizeof a->index) &&
         !memcmp(a->index_range, b->index_range, sizeof a->index_range) && a->n_args == b->n_args;
}

const struct expr *expr_bare(const struct expr *e) {
  while (e->kind == EXPR_PAREN) e = e->args[0];
  return e;
}

bool expr_is_zero(const struct expr *e) {
  e = expr_bare(e);
  return e->kind == EXPR_NUM && strcmp(e->name, "0") == 0;
}

bool expr_is_zero_matrix(const struct expr *e) {
  bool zero = e->kind == EXPR_MATRIX;
  for (int i = 0; zero && i < e->n_args; i++) zero = expr_is_zero(e->args[i]);
  return zero;
}

bool expr_is_name(const struct expr *e, const void *arg) {
  (void)arg;
  return e->kind == EXPR_CALL || (e->kind == EXPR_SYM && strcmp(e->name, expr_pi) != 0);
}

/* First operands in a loop: sums lean to the left and may be as long as a formula. */
bool expr_any(const struct expr *e, expr_is_fn is, const void *arg) {
  for (;; e = e->args[0]) {
    if (is(e, arg)) return true;
    for (int i = 1; i < e->n_args; i++)
      if (expr_any(e->args[i], is, arg)) return true;
    if (e->n_args == 0) return false;
  }
}

bool stmt_any(const struct stmt *s, expr_is_fn is, const void *arg) {
  bool any = false;
  for (int i = 0; !any && i < s->n_sides; i++) any = expr_any(s->sides[i], is, arg);
  return any;
}

/* Pairs still to be compared are on the heap.  Shared nodes are passed over when both sides share them. */
bool expr_same(const struct expr *a, const struct expr *b) {
  FREED const struct expr **todo = NULL;
  size_t n = 0, cap = 0;
  bool same = true;
  for (;;) {
    if (a != b) {
      if (!(same = expr_same_node(a, b))) break;
      for (int i = 0; i < a->n_args; i++) {
        *SS_PUSH(todo, n, cap) = a->args[i];
        *SS_PUSH(todo, n, cap) = b->args[i];
      }
    }
    if (n == 0) break;
    b = todo[--n];
    a = todo[--n];
  }
  return same;
}
