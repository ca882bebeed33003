/* Records that claims cite: an argument's "eq-52#1.2, eq-59#2, eq-56 D", the formula of a number. */
#include "claim.h"

#include <stdio.h>
#include <string.h>

const char *claim_next_cited(struct cited *out, const char *list) {
  char item[64];
  const char *rest = claim_next_item(item, sizeof item, list);
  if (!rest) return NULL;
  *out = (struct cited){.statement = 0};
  sscanf(item, " %47s %15s", out->id, out->phase);
  char *mark = strchr(out->id, '#');
  if (mark) {
    out->misnumbered = sscanf(mark, "#%d.%d", &out->statement, &out->step) < 1 || out->statement < 1;
    *mark = '\0';
  }
  return rest;
}

bool cited_overlap(const struct cited *a, const struct cited *b) {
  if (strcmp(a->id, b->id) != 0) return false;
  if (a->statement && b->statement && a->statement != b->statement) return false;
  if (a->step && b->step && a->step != b->step) return false;
  return !*a->phase || !*b->phase || strcmp(a->phase, b->phase) == 0;
}

static bool cited_in(const struct cited *a, const char *list) {
  struct cited b;
  while ((list = claim_next_cited(&b, list)) != NULL)
    if (cited_overlap(a, &b)) return true;
  return false;
}

bool cited_share(const char *a, const char *b) {
  struct cited one;
  while ((a = claim_next_cited(&one, a)) != NULL)
    if (cited_in(&one, b)) return true;
  return false;
}

/* The statement that a formula cites, "eq-53#2", or NULL. */
static const struct stmt *cited_statement(const struct model *m, const char *text) {
  const struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  char id[48];
  int n, end;
  if (!text || sscanf(text, "%47[^# ]#%d%n", id, &n, &end) != 2 || text[end]) return NULL;
  const struct statement_record *r = view_record(&v, id);
  const struct stmt *s = r && n > 0 && n <= r->n_stmts ? r->stmts[n - 1] : NULL;
  return s && s->kind == STMT_RELATION ? s : NULL;
}

static bool is_name(const struct expr *e) {
  e = expr_bare(e);
  return e->kind == EXPR_SYM || e->kind == EXPR_CALL;
}

/* The side that says of a symbol beside it what that is, or what bounds it: the right one where that can be; -1:
   none. */
static int telling_side(const struct stmt *s) {
  int last = s->n_sides - 1;
  return is_name(s->sides[0]) || is_name(s->sides[last - 1]) ? last : last == 1 && is_name(s->sides[1]) ? 0 : -1;
}

const char *claim_formula(struct arena *a, const struct model *m, const struct claim *c, const char *key) {
  const char *text = claim_get(c, key);
  const struct stmt *s = cited_statement(m, text);
  int side = s ? telling_side(s) : -1;
  if (side < 0) return text;
  OWNED(text) told = {0};
  expr_print(&told, s->sides[side]);
  return arena_strdup(a, text_str(&told));
}

char claim_formula_relation(const struct model *m, const struct claim *c, const char *key) {
  const struct stmt *s = cited_statement(m, claim_get(c, key));
  if (!s) return '\0';
  int side = telling_side(s);
  enum relop op = s->ops[s->n_sides - 2];
  bool less = op == REL_LT || op == REL_LE;
  return side < 0 ? '?' : op == REL_EQ ? '=' : less == (side > 0) ? '<' : '>';
}

/* A conclusion that is drawn from premises alone: not at one scene, and not a repetition of them in other words. */
bool claim_deduces(const struct claim *c) {
  return claim_kind(c) == KIND_ARGUMENT && !claim_get(c, "converse") && !claim_get(c, "converse-of") &&
         !claim_says(c, "over", "scene");
}
