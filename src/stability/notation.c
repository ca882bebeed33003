/* A node in the paper's notation: subexpressions are printed by the names that the paper gives them, for equal scalars
   of one elaboration are one pointer. */
#include <string.h>

#include "stability_impl.h"

enum { SHOWN_DEPTH = 3 };

/* Of one operation at most: shorter than its name. */
static bool is_short(const struct expr *e) {
  for (int k = 0; k < e->n_args; k++)
    if (e->args[k]->n_args > 0) return false;
  return true;
}

/* The shortest of its names; one of a scalar before that of an entry. */
static const char *name_of(const struct digits_set *s, const struct expr *e) {
  const char *best = NULL;
  size_t least = 0;
  for (size_t i = 0; !is_short(e) && i < s->n_names; i++) {
    if (s->name[i].e != e) continue;
    size_t length = strlen(s->name[i].name) + (strchr(s->name[i].name, '[') ? 100 : 0);
    if (best && length >= least) continue;
    best = s->name[i].name;
    least = length;
  }
  return best;
}

/* Names met below e, each once, at most BELOW of them: f(N_1, V, ...). */
enum { BELOW = 3, FEW = 10, LOOKED_AT = 400 };
struct below {
  const char *name[BELOW + 1];
  int n, looks;
};

static void names_below(struct below *b, struct digits_set *s, const struct expr *e) {
  if (b->looks++ > LOOKED_AT || b->n > BELOW || e->kind == EXPR_NUM) return;
  const char *name = e->kind == EXPR_SYM ? e->name : name_of(s, e);
  for (int k = 0; !name && k < e->n_args; k++) names_below(b, s, e->args[k]);
  for (int i = 0; name && i < b->n; i++)
    if (strcmp(b->name[i], name) == 0) return;
  if (name) b->name[b->n++] = name;
}

static const struct expr *named(struct digits_set *s, const struct expr *e, bool whole, int depth);

/* What stands too deep to be shown, as a function of what it is made of; as it is when that is no longer. */
static const struct expr *summary(struct digits_set *s, const struct expr *e) {
  struct below b = {.n = 0};
  OWNED(text) t = {0};
  names_below(&b, s, e);
  if (b.looks <= FEW) return named(s, e, false, FEW);
  text_add(&t, "f(");
  for (int i = 0; i < b.n && i < BELOW; i++) text_printf(&t, "%s%s", i ? ", " : "", b.name[i]);
  text_add(&t, b.n > BELOW || b.looks > LOOKED_AT ? ", ...)" : ")");
  return expr_sym(&s->el.pool, text_str(&t));
}

/* With names put in; what is deeper than that many levels becomes f(what it is made of). */
static const struct expr *named(struct digits_set *s, const struct expr *e, bool whole, int depth) {
  struct expr_pool *p = &s->el.pool;
  const char *name = whole ? name_of(s, e) : NULL;
  if (name) return expr_sym(p, name);
  if (e->n_args == 0) return e;
  if (depth == 0) return summary(s, e);
  const struct expr *a = named(s, e->args[0], true, depth - 1);
  if (e->kind == EXPR_POW) return expr_pow(p, a, e->exponent);
  if (e->n_args == 1) return expr_op1(p, e->kind, a);
  return expr_tidy(p, e->kind, a, named(s, e->args[1], true, depth - 1));
}

void digits_print_node(struct text *out, struct digits_set *s, const struct digits_formula *f, slong node, bool whole) {
  expr_print(out, named(s, f->node[node], whole, SHOWN_DEPTH));
}
