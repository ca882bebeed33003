/* The roots that the paper declares by a polynomial: its coefficients in the unknown, read off the scalars.  Sums,
   products, powers, and quotients by what is free of the unknown stay polynomials; everything else must not contain
   it.  Nothing is folded here either: a coefficient is the scalar that its terms add up to. */
#include <stdlib.h>
#include <string.h>

#include "elaborate_impl.h"

enum { MAX_DEGREE = 32, MAX_POLY_STEPS = 100000 };

struct poly {
  const struct expr *c[MAX_DEGREE + 1]; /* NULL: absent */
  int degree;
};

struct poly_job {
  struct elaboration *el;
  const char *unknown;
  int steps, depth;
  bool too_large;
};

static bool within_limits(struct poly_job *job) {
  job->too_large = job->steps > MAX_POLY_STEPS || job->depth > MAX_DEPTH || job->el->pool.n > MAX_SCALARS;
  return !job->too_large;
}

static bool poly_add(struct poly *p, struct poly_job *job, int k, const struct expr *term, enum expr_kind op) {
  if (k > MAX_DEGREE) return false;
  struct expr_pool *pool = &job->el->pool;
  if (p->c[k])
    p->c[k] = expr_op2(pool, op, p->c[k], term);
  else
    p->c[k] = op == EXPR_SUB ? expr_op1(pool, EXPR_NEG, term) : term;
  if (k > p->degree) p->degree = k;
  return true;
}

static bool poly_mul(struct poly *out, struct poly_job *job, const struct poly *a, const struct poly *b) {
  struct poly r = {.degree = 0};
  for (int i = 0; i <= a->degree; i++)
    for (int j = 0; j <= b->degree; j++)
      if (a->c[i] && b->c[j] &&
          !poly_add(&r, job, i + j, expr_op2(&job->el->pool, EXPR_MUL, a->c[i], b->c[j]), EXPR_ADD))
        return false;
  *out = r;
  return true;
}

static bool to_poly(struct poly *out, struct poly_job *job, const struct expr *e);

static bool poly_power(struct poly *out, struct poly_job *job, const struct poly *a, int n) {
  if (n < 1 || n > MAX_DEGREE) return false;
  *out = *a;
  for (int i = 1; i < n; i++)
    if (!poly_mul(out, job, out, a)) return false;
  return true;
}

/* The operators under which polynomials stay polynomials; everything else must be free of the unknown.  p is the first
   operand as a polynomial and becomes e. */
static bool poly_apply(struct poly *p, struct poly_job *job, const struct expr *e) {
  struct poly a = *p, b = {.degree = 0};
  if (e->n_args >= 2 && !to_poly(&b, job, e->args[1])) return false;
  if (a.degree == 0 && b.degree == 0) {
    p->c[0] = e;
    return true;
  }
  switch (e->kind) {
  case EXPR_ADD:
  case EXPR_SUB:
    for (int k = 0; k <= b.degree; k++)
      if (b.c[k] && !poly_add(p, job, k, b.c[k], e->kind)) return false;
    return true;
  case EXPR_NEG:
    *p = (struct poly){.degree = 0};
    for (int k = 0; k <= a.degree; k++)
      if (a.c[k] && !poly_add(p, job, k, a.c[k], EXPR_SUB)) return false;
    return true;
  case EXPR_MUL:
    return poly_mul(p, job, &a, &b);
  case EXPR_POW:
    return poly_power(p, job, &a, e->exponent);
  case EXPR_DIV:
    if (b.degree > 0) return false;
    for (int k = 0; k <= a.degree; k++)
      if (a.c[k]) p->c[k] = expr_op2(&job->el->pool, EXPR_DIV, a.c[k], e->args[1]);
    return true;
  default:
    return false;
  }
}

/* Walks as eval does: first operands in a loop, second operands in bounded recursion. */
static bool to_poly(struct poly *out, struct poly_job *job, const struct expr *e) {
  FREED const struct expr **left = NULL;
  size_t n = 0, cap = 0;
  for (; e->n_args > 0; e = e->args[0]) *SS_PUSH(left, n, cap) = e;
  bool unknown = e->kind == EXPR_SYM && strcmp(e->name, job->unknown) == 0;
  *out = (struct poly){.degree = unknown};
  out->c[unknown] = unknown ? expr_num(&job->el->pool, "1") : e;
  job->depth++;
  bool ok = within_limits(job);
  for (; ok && n > 0; n--, job->steps++) ok = poly_apply(out, job, left[n - 1]) && within_limits(job);
  job->depth--;
  return ok;
}

bool elaboration_add_root(struct elaboration *el, const struct definition *def, const char *symbol,
                          const struct expr *poly, struct diag *d) {
  struct poly_job job = {.el = el, .unknown = symbol};
  struct poly p;
  if (!to_poly(&p, &job, poly) || p.degree < 1) {
    size_t where = def->stmt->sides[0]->span.begin;
    diag_beyond(d);
    if (job.too_large) return diag_at(d, def->src, where, "the polynomial in %s is too large", def->name);
    return diag_at(d, def->src, where, "not a polynomial in %s of degree 1 to %d", def->name, MAX_DEGREE);
  }
  struct tape_root r = {symbol, arena_alloc(&el->pool.arena, (size_t)(p.degree + 1) * sizeof(struct expr *)),
                        p.degree + 1, def->stmt->largest};
  for (int k = 0; k <= p.degree; k++) r.coeff[k] = p.c[k] ? p.c[k] : expr_num(&el->pool, "0");
  *SS_PUSH(el->roots, el->n_roots, el->cap_roots) = r;
  return true;
}
