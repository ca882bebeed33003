/* Scalars are made once: a node is looked up by its contents before it is made, and its operands have been made the
   same way, so comparing operand pointers compares whole subtrees.  Chained buckets that double with the number of
   nodes.
   All scalars are built from operands that exist already, so nothing here recurses, however deep they get. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expr_impl.h"

enum { FIRST_BUCKETS = 64 };

void expr_pool_clear(struct expr_pool *p) {
  arena_clear(&p->arena);
  free(p->bucket);
  *p = (struct expr_pool){.n = 0};
}

static uint64_t mix(uint64_t h, uint64_t x) {
  h = (h ^ x) * UINT64_C(0x9E3779B97F4A7C15);
  return h ^ h >> 32;
}

static uint64_t hash(const struct expr *e) {
  uint64_t h = mix(0, (uint64_t)e->kind);
  h = mix(h, (uint64_t)(unsigned)e->order << 32 | (unsigned)e->exponent);
  for (const char *s = e->name; s && *s; s++) h = mix(h, (unsigned char)*s);
  for (int i = 0; i < e->n_args; i++) h = mix(h, (uint64_t)(uintptr_t)e->args[i]);
  return h;
}

static bool same(const struct expr *a, const struct expr *b) {
  if (a->kind != b->kind || a->order != b->order || a->exponent != b->exponent) return false;
  if (a->name && strcmp(a->name, b->name) != 0) return false;
  for (int i = 0; i < a->n_args; i++)
    if (a->args[i] != b->args[i]) return false;
  return true;
}

static void grow(struct expr_pool *p) {
  size_t n = p->n_buckets ? 2 * p->n_buckets : FIRST_BUCKETS;
  const struct expr **bucket = ss_malloc(n * sizeof *bucket);
  for (size_t i = 0; i < n; i++) bucket[i] = NULL;
  for (size_t i = 0; i < p->n_buckets; i++)
    for (const struct expr *e = p->bucket[i], *next; e; e = next) {
      next = e->next;
      const struct expr **home = &bucket[hash(e) % n];
      ((struct expr *)e)->next = *home; /* const is for the pool's users; the chain is the pool's own */
      *home = e;
    }
  free(p->bucket);
  p->bucket = bucket;
  p->n_buckets = n;
}

/* The pool's node with the contents of *key, whose name and operand array are copied when it is new. */
static const struct expr *intern(struct expr_pool *p, const struct expr *key) {
  if (p->n == p->n_buckets) grow(p);
  const struct expr **home = &p->bucket[hash(key) % p->n_buckets];
  for (const struct expr *e = *home; e; e = e->next)
    if (same(e, key)) return e;
  struct expr *e = arena_alloc(&p->arena, sizeof *e);
  *e = *key;
  if (key->name) e->name = arena_strndup(&p->arena, key->name, strlen(key->name));
  if (key->n_args > 0) {
    e->args = arena_alloc(&p->arena, (size_t)key->n_args * sizeof *e->args);
    for (int i = 0; i < key->n_args; i++) e->args[i] = key->args[i];
  }
  e->next = *home;
  *home = e;
  p->n++;
  return e;
}

const char expr_pi[] = "pi";

const struct expr *expr_num(struct expr_pool *p, const char *decimal) {
  return intern(p, &(struct expr){.kind = EXPR_NUM, .name = decimal});
}

const struct expr *expr_int(struct expr_pool *p, long n) {
  char digits[32];
  snprintf(digits, sizeof digits, "%lu", n < 0 ? 0UL - (unsigned long)n : (unsigned long)n);
  const struct expr *e = expr_num(p, digits);
  return n < 0 ? expr_op1(p, EXPR_NEG, e) : e;
}

const struct expr *expr_sym(struct expr_pool *p, const char *name) {
  return intern(p, &(struct expr){.kind = EXPR_SYM, .name = name});
}

const struct expr *expr_call(struct expr_pool *p, const char *name, int order, const struct expr *arg) {
  return intern(p, &(struct expr){.kind = EXPR_CALL, .name = name, .order = order, .n_args = 1, .args = &arg});
}

const struct expr *expr_op1(struct expr_pool *p, enum expr_kind k, const struct expr *a) {
  bool one = k == EXPR_NEG || (k >= EXPR_SIN && k <= EXPR_STUMPFF);
  if (!one) abort();
  return intern(p, &(struct expr){.kind = k, .n_args = 1, .args = &a});
}

const struct expr *expr_op2(struct expr_pool *p, enum expr_kind k, const struct expr *a, const struct expr *b) {
  if (k != EXPR_ADD && k != EXPR_SUB && k != EXPR_MUL && k != EXPR_DIV && k != EXPR_HYPOT) abort();
  const struct expr *args[] = {a, b};
  return intern(p, &(struct expr){.kind = k, .n_args = 2, .args = args});
}

const struct expr *expr_pow(struct expr_pool *p, const struct expr *a, int exponent) {
  return intern(p, &(struct expr){.kind = EXPR_POW, .exponent = exponent, .n_args = 1, .args = &a});
}

static bool is_one(const struct expr *e) {
  return e->kind == EXPR_NUM && strcmp(e->name, "1") == 0;
}

const struct expr *expr_tidy(struct expr_pool *p, enum expr_kind k, const struct expr *a, const struct expr *b) {
  if (k == EXPR_MUL && (expr_is_zero(a) || is_one(b))) return a;
  if (k == EXPR_MUL && (expr_is_zero(b) || is_one(a))) return b;
  if (k == EXPR_DIV && (is_one(b) || expr_is_zero(a))) return a;
  if (k == EXPR_ADD && expr_is_zero(a)) return b;
  if ((k == EXPR_ADD || k == EXPR_SUB) && expr_is_zero(b)) return a;
  return expr_op2(p, k, a, b);
}

const struct expr *expr_with_args(struct expr_pool *p, const struct expr *e, const struct expr *const *args) {
  const struct expr *copy[2];
  if (e->kind >= EXPR_PAREN) abort();
  for (int i = 0; i < e->n_args; i++) copy[i] = args[i];
  struct expr key = *e;
  key.args = copy;
  return intern(p, &key);
}
