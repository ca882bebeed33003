/* Controls that nobody wrote: for each formula that no control on file damages, the formula times 1 + 1e-30, which is
   the least that a trial in balls is said to notice.  They are written as a person would write them, and read by the
   same readers. */
#include "near.h"

#include "claim.h"

#include <stdlib.h>
#include <string.h>

static const char source_name[] = "controls made by the program";

#define NEAR_FACTOR "(1 + " NEAR_DELTA ")"

/* What a claim is about, of the formulas. */
static const char *formula_of(const struct claim *c) {
  const char *statement = claim_get(c, "statement");
  return statement ? statement : claim_get(c, "value");
}

static bool same_formula(const struct claim *a, const struct claim *b) {
  const char *x = formula_of(a), *y = formula_of(b);
  return x && y && strcmp(x, y) == 0 && !claim_get(a, "statement") == !claim_get(b, "statement");
}

/* An equality to which a small change can be made, and by which it is judged: a matrix against the model's, or a
   sentence; an inequality only where it is said to become an equality. */
static bool can_notice(const struct claim *c) {
  return claim_kind(c) == KIND_MATRIX || claim_kind(c) == KIND_IDENTITY || claim_kind(c) == KIND_SHARP;
}

/* Of each control the claim whose own formula it damages, or NULL; to be freed. */
static const struct claim **damaged_claims(const struct claims *claims, const struct claims *controls) {
  const struct claim **of = ss_malloc((controls->n + 1) * sizeof(const struct claim *));
  for (size_t i = 0; i < controls->n; i++) {
    const struct record *r = controls->claim[i].record;
    of[i] = record_get(r, "of") ? NULL : claim_named(claims, record_get(r, "claim"));
  }
  return of;
}

static bool is_damaged(const struct claim *c, const struct claim *const *of, size_t n) {
  for (size_t i = 0; i < n; i++)
    if (of[i] && same_formula(of[i], c)) return true;
  return false;
}

/* --- The damaged text --- */

static bool is_sum(const struct expr *e) {
  return e->kind == EXPR_ADD || e->kind == EXPR_SUB;
}

static void add_times(struct text *out, const struct expr *e) {
  text_add(out, NEAR_FACTOR "*(");
  expr_print(out, e);
  text_add(out, ")");
}

/* A sum, a product with such a factor, a quotient of one or its negative. */
static bool has_sum(const struct expr *e) {
  e = expr_bare(e);
  return is_sum(e) || (e->kind == EXPR_MUL && (has_sum(e->args[0]) || has_sum(e->args[1]))) ||
         ((e->kind == EXPR_DIV || e->kind == EXPR_NEG) && has_sum(e->args[0]));
}

/* A side: where the other one is zero the last of its terms, or of the terms of a factor, so that it is another
   equation. */
static void add_side(struct text *out, const struct expr *e, bool beside_zero) {
  e = expr_bare(e);
  if (!beside_zero) {
    add_times(out, e);
  } else if (is_sum(e) && expr_is_zero(expr_bare(e->args[1]))) {
    add_side(out, e->args[0], true);
  } else if (is_sum(e)) {
    text_add(out, "(");
    expr_print(out, e->args[0]);
    text_add(out, e->kind == EXPR_ADD ? ") + " : ") - ");
    add_times(out, e->args[1]);
  } else if (has_sum(e) && e->kind == EXPR_NEG) {
    text_add(out, "-(");
    add_side(out, e->args[0], true);
    text_add(out, ")");
  } else if (has_sum(e)) {
    bool first = has_sum(e->args[0]);
    text_add(out, "(");
    first ? add_side(out, e->args[0], true) : expr_print(out, e->args[0]);
    text_add(out, e->kind == EXPR_DIV ? ")/(" : ")*(");
    first ? expr_print(out, e->args[1]) : add_side(out, e->args[1], true);
    text_add(out, ")");
  } else {
    text_add(out, "(");
    expr_print(out, e);
    text_add(out, ") + " NEAR_DELTA);
  }
}

/* A matrix of zeros, of which no factor makes another: its first entry is a small number. */
static void add_zero_matrix(struct text *out, const struct expr *e) {
  for (int i = 0; i < e->n_args; i++)
    text_printf(out, "%s%s", i == 0 ? "[" : i % e->cols ? ", " : "; ", i == 0 ? NEAR_DELTA : "0");
  text_add(out, "]");
}

static void add_relation(struct text *out, const struct stmt *s) {
  bool zero = expr_is_zero(s->sides[s->n_sides - 1]);
  int damaged = zero ? s->n_sides - 2 : s->n_sides - 1;
  for (int i = 0; i < s->n_sides; i++) {
    if (i) text_printf(out, " %s ", relop_sign[s->ops[i - 1]]);
    if (i == damaged && expr_is_zero_matrix(expr_bare(s->sides[i])))
      add_zero_matrix(out, expr_bare(s->sides[i]));
    else if (i == damaged)
      add_side(out, s->sides[i], zero);
    else
      expr_print(out, s->sides[i]);
  }
  stmt_print_range(out, s);
}

/* The last statement that can be damaged: an equation where there is one, unless the claim is about what inequalities
   become. */
static int which_statement(const struct statement_record *r, bool sharp) {
  int last = -1;
  for (int k = 0; k < r->n_stmts; k++) {
    const struct stmt *s = r->stmts[k];
    if (s->kind != STMT_RELATION || (s->range_var && !s->range_hi)) continue;
    bool equation = s->ops[s->n_sides - 2] == REL_EQ;
    if (equation != sharp) last = k;
  }
  return last;
}

static bool add_record(struct text *out, const struct model *m, const struct claim *c, const char *id) {
  struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  const struct statement_record *r = view_record(&v, claim_get(c, "statement"));
  int k = r ? which_statement(r, claim_kind(c) == KIND_SHARP) : -1;
  if (k < 0) return false;
  text_printf(out, "%s %s\n  replaces: %s\n", r->record->kind_name, id, r->id);
  for (int i = 0; i < r->n_stmts; i++) {
    if (r->stmts[i]->kind == STMT_TRAJECTORY) continue;
    text_add(out, "  ");
    if (i == k)
      add_relation(out, r->stmts[i]);
    else
      stmt_print(out, r->stmts[i]);
    text_add(out, "\n");
  }
  return true;
}

static bool add_definition(struct text *out, const struct model *m, const struct claim *c, const char *id) {
  struct view v = {m, LAYER_CORRECTED, NULL, NULL};
  struct diag d = {0};
  const struct definition *def = view_lookup_value(&v, claim_get(c, "value"), claim_section(c), &d);
  const struct stmt *s = def ? def->stmt : NULL;
  if (!s || (s->kind != STMT_DEFINE && s->kind != STMT_ROOT)) return false;
  text_printf(out, "define %s\n", id);
  if (*def->section) text_printf(out, "  section: %s\n", def->section);
  if (s->kind == STMT_ROOT) {
    text_printf(out, "  root %s: (", s->name);
    expr_print(out, s->sides[0]);
    text_printf(out, ") + " NEAR_DELTA ", %s positive\n", s->largest ? "largest" : "smallest");
    return true;
  }
  text_printf(out, "  %s%s%s%s := ", s->name, s->param ? "(" : "", s->param ? s->param : "", s->param ? ")" : "");
  add_times(out, s->sides[0]);
  text_add(out, "\n");
  return true;
}

/* --- All of them --- */

/* Whether the claim is asked of its formula: the first of those that can notice, where none is damaged on file. */
static bool is_asked(const struct claims *claims, size_t i, const struct claim *const *damaged, size_t n) {
  const struct claim *c = &claims->claim[i];
  if (!formula_of(c) || !can_notice(c) || is_damaged(c, damaged, n)) return false;
  for (size_t k = 0; k < i; k++)
    if (same_formula(&claims->claim[k], c) && can_notice(&claims->claim[k])) return false;
  return true;
}

/* Of an identity that is a chain of inequalities alone there may be a claim that it is sharp. */
static const struct claim *sharper(const struct claims *claims, const struct claim *c) {
  for (size_t k = 0; k < claims->n; k++)
    if (claim_kind(&claims->claim[k]) == KIND_SHARP && same_formula(&claims->claim[k], c)) return &claims->claim[k];
  return c;
}

static bool add_damage(struct text *out, const struct model *m, const struct claim *c, const char *id) {
  return claim_get(c, "statement") ? add_record(out, m, c, id) : add_definition(out, m, c, id);
}

bool near_controls_add(struct model *m, const struct claims *claims, struct claims *controls, struct diag *d) {
  OWNED(text) formulas = {0}, records = {0};
  FREED const struct claim **damaged = damaged_claims(claims, controls);
  for (size_t i = 0; i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    if (!is_asked(claims, i, damaged, controls->n)) continue;
    char id[CLAIM_NAME + 8];
    snprintf(id, sizeof id, "near-%s", c->id);
    bool made = add_damage(&formulas, m, c, id);
    if (!made && sharper(claims, c) != c) {
      c = sharper(claims, c);
      made = add_damage(&formulas, m, c, id);
    }
    if (made) text_printf(&records, "control %s\n  claim: %s\n  near: " NEAR_DELTA "\n", id, c->id);
  }
  return !records.len || (model_add_text(m, source_name, text_str(&formulas), RANK_CONTROL, d) &&
                          claims_add_text(controls, source_name, text_str(&records), "control", d));
}

bool near_made(const struct claim *control) {
  return strcmp(control->file->src.name, source_name) == 0;
}

/* A control's record stands in the place of the formula. */
static bool is_replaced(const struct model *m, const char *statement, const char *value) {
  size_t n = statement ? 0 : strcspn(value, "(");
  for (size_t i = 0; statement && i < m->n_records; i++)
    if (m->records[i].rank == RANK_CONTROL && strcmp(m->records[i].id, statement) == 0) return true;
  for (size_t i = 0; !statement && i < m->n_defs; i++)
    if (m->defs[i].rank == RANK_CONTROL && word_is(value, n, m->defs[i].name)) return true;
  return false;
}

bool formulas_have_controls(const struct model *m, const struct claims *claims, const struct claims *controls,
                            struct diag *d) {
  FREED const struct claim **damaged = damaged_claims(claims, controls);
  bool ok = true;
  for (size_t i = 0; ok && i < claims->n; i++) {
    const struct claim *c = &claims->claim[i];
    const char *statement = claim_get(c, "statement"), *value = claim_get(c, "value");
    ok = !formula_of(c) || is_damaged(c, damaged, controls->n) || is_replaced(m, statement, value) ||
         claim_is_altered(m, c) ||
         claim_mistake(
             c, statement ? "statement" : "value", d,
             "no control damages this formula, and none can be made for a claim of kind %s: write one in controls",
             claim_get(c, "kind"));
  }
  return ok;
}
