/* Derivatives and substitutions of shared scalars: one walk from the leaves up, with the result for each node kept in a
   table for the length of the call, so the cost is linear in the number of distinct nodes.  Nodes that wait for their
   operands are on the heap: nothing recurses, and a chain of any depth will do. */
#include <stdlib.h>
#include <string.h>

#include "expr_impl.h"
#include "map.h"

/* ---- the walk */

struct rewrite {
  struct expr_pool *pool;
  const char *sym;
  const struct expr *by; /* substitution only */
};

/* The result for a node from those for its operands. */
typedef const struct expr *rewrite_node(const struct rewrite *w, const struct expr *e, const struct expr *const *done);

static const struct expr *rewrite(const struct rewrite *w, const struct expr *root, rewrite_node *node_result) {
  OWNED(expr_map) m = {0};
  FREED const struct expr **todo = NULL;
  size_t n = 0, cap = 0;
  *SS_PUSH(todo, n, cap) = root;
  while (n > 0) {
    const struct expr *e = todo[n - 1], *done[2] = {NULL, NULL};
    bool ready = true;
    if (e->n_args > 2) abort();
    for (int i = 0; i < e->n_args; i++) {
      const struct expr_slot *kept = expr_map_find(&m, e->args[i]);
      if (kept) done[i] = kept->result;
      if (kept) continue;
      ready = false;
      *SS_PUSH(todo, n, cap) = e->args[i];
    }
    if (!ready) continue;
    n--;
    if (!expr_map_find(&m, e)) expr_map_put(&m, e)->result = node_result(w, e, done);
  }
  return expr_map_find(&m, root)->result;
}

/* ---- derivatives; NULL stands for that of a node free of the symbol */

static const struct expr *mul(struct expr_pool *p, const struct expr *a, const struct expr *b) {
  return expr_op2(p, EXPR_MUL, a, b);
}

static const struct expr *negated(struct expr_pool *p, const struct expr *a) {
  return expr_op1(p, EXPR_NEG, a);
}

static const struct expr *diff_sum(struct expr_pool *p, enum expr_kind k, const struct expr *da,
                                   const struct expr *db) {
  if (!db) return da;
  if (!da) return k == EXPR_ADD ? db : negated(p, db);
  return expr_op2(p, k, da, db);
}

static const struct expr *diff_product(struct expr_pool *p, const struct expr *e, const struct expr *da,
                                       const struct expr *db) {
  const struct expr *left = da ? mul(p, da, e->args[1]) : NULL;
  return diff_sum(p, EXPR_ADD, left, db ? mul(p, e->args[0], db) : NULL);
}

/* a'/b, or (a' b - a b')/b^2 */
static const struct expr *diff_quotient(struct expr_pool *p, const struct expr *e, const struct expr *da,
                                        const struct expr *db) {
  const struct expr *a = e->args[0], *b = e->args[1];
  if (!da && !db) return NULL;
  if (!db) return expr_op2(p, EXPR_DIV, da, b);
  const struct expr *above = diff_sum(p, EXPR_SUB, da ? mul(p, da, b) : NULL, mul(p, a, db));
  return expr_op2(p, EXPR_DIV, above, expr_pow(p, b, 2));
}

/* n a^(n-1) a'; but a^0 is 1 wherever a is, also at its zeros, where a^(-1) is not. */
static const struct expr *diff_power(struct expr_pool *p, const struct expr *e, const struct expr *da) {
  int n = e->exponent;
  if (n == 0) return NULL;
  return mul(p, mul(p, expr_int(p, n), expr_pow(p, e->args[0], n - 1)), da);
}

/* The half of sinc^2(x/2), which is (1 - cos x)/x^2. */
static const struct expr *half_square(struct expr_pool *p, const struct expr *x) {
  const struct expr *two = expr_int(p, 2), *half = expr_op2(p, EXPR_DIV, x, two);
  return expr_op2(p, EXPR_DIV, expr_pow(p, expr_op1(p, EXPR_SINC, half), 2), two);
}

/* (cos x - sinc x)/x = x (stumpff x - sinc^2(x/2)/2), which is 0 at 0. */
static const struct expr *diff_sinc(struct expr_pool *p, const struct expr *x) {
  return mul(p, x, expr_op2(p, EXPR_SUB, expr_op1(p, EXPR_STUMPFF, x), half_square(p, x)));
}

/* (sinc^2(x/2)/2 - 3 stumpff x)/x: without a value at 0. */
static const struct expr *diff_stumpff(struct expr_pool *p, const struct expr *e) {
  const struct expr *thrice = mul(p, expr_int(p, 3), e);
  return expr_op2(p, EXPR_DIV, expr_op2(p, EXPR_SUB, half_square(p, e->args[0]), thrice), e->args[0]);
}

/* (a/h) a' + (b/h) b', none at the origin. */
static const struct expr *diff_hypot(struct expr_pool *p, const struct expr *e, const struct expr *da,
                                     const struct expr *db) {
  const struct expr *left = da ? mul(p, expr_op2(p, EXPR_DIV, e->args[0], e), da) : NULL;
  return diff_sum(p, EXPR_ADD, left, db ? mul(p, expr_op2(p, EXPR_DIV, e->args[1], e), db) : NULL);
}

/* A form of one operand whose derivative is da, not NULL. */
static const struct expr *diff_unary(struct expr_pool *p, const struct expr *e, const struct expr *da) {
  const struct expr *a = e->args[0];
  switch (e->kind) {
  case EXPR_NEG:
    return negated(p, da);
  case EXPR_POW:
    return diff_power(p, e, da);
  case EXPR_CALL:
    return mul(p, expr_call(p, e->name, e->order + 1, a), da);
  case EXPR_SIN:
    return mul(p, expr_op1(p, EXPR_COS, a), da);
  case EXPR_COS:
    return negated(p, mul(p, expr_op1(p, EXPR_SIN, a), da));
  case EXPR_COT:
    return negated(p, expr_op2(p, EXPR_DIV, da, expr_pow(p, expr_op1(p, EXPR_SIN, a), 2)));
  case EXPR_SQRT:
    return expr_op2(p, EXPR_DIV, da, mul(p, expr_int(p, 2), e));
  case EXPR_EXP:
    return mul(p, e, da);
  case EXPR_ABS: /* none at 0 */
    return mul(p, expr_op2(p, EXPR_DIV, a, e), da);
  case EXPR_ROUNDED:
    return da;
  case EXPR_SINC:
    return mul(p, diff_sinc(p, a), da);
  case EXPR_STUMPFF:
    return mul(p, diff_stumpff(p, e), da);
  default:
    abort();
  }
}

static const struct expr *diff_node(const struct rewrite *w, const struct expr *e, const struct expr *const *d) {
  struct expr_pool *p = w->pool;
  switch (e->kind) {
  case EXPR_NUM:
    return NULL;
  case EXPR_SYM:
    return strcmp(e->name, w->sym) == 0 ? expr_int(p, 1) : NULL;
  case EXPR_ADD:
  case EXPR_SUB:
    return diff_sum(p, e->kind, d[0], d[1]);
  case EXPR_MUL:
    return diff_product(p, e, d[0], d[1]);
  case EXPR_DIV:
    return diff_quotient(p, e, d[0], d[1]);
  case EXPR_HYPOT:
    return diff_hypot(p, e, d[0], d[1]);
  default:
    return d[0] ? diff_unary(p, e, d[0]) : NULL;
  }
}

const struct expr *expr_diff(struct expr_pool *p, const struct expr *e, const char *sym) {
  const struct expr *d = rewrite(&(struct rewrite){p, sym, NULL}, e, diff_node);
  return d ? d : expr_int(p, 0);
}

/* ---- substitution */

static const struct expr *subst_node(const struct rewrite *w, const struct expr *e, const struct expr *const *done) {
  if (e->kind == EXPR_SYM && strcmp(e->name, w->sym) == 0) return w->by;
  return expr_with_args(w->pool, e, done);
}

const struct expr *expr_subst(struct expr_pool *p, const struct expr *e, const char *sym, const struct expr *by) {
  return rewrite(&(struct rewrite){p, sym, by}, e, subst_node);
}
