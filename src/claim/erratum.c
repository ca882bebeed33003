/* A correction set beside what it replaces: both typeset from the parsed statements, and the places where their trees
   differ, so that a report can say "replace this by that" without anybody having written it. */
#include "claim.h"
#include "model/model.h"
#include "record/result.h"
#include <string.h>

enum { MAX_REPLACEMENTS = 4, MAX_LEVELS = 1000 };

/* Pairs of subexpressions, the printed one and the corrected one, and whether all of them stand in the
   argument of a function. */
struct replacements {
  const struct expr *from[MAX_REPLACEMENTS], *to[MAX_REPLACEMENTS];
  bool in_call[MAX_REPLACEMENTS];
  int n;
  bool too_many;
};

static void add_pair(struct replacements *r, const struct expr *a, const struct expr *b, bool in_call) {
  for (int i = 0; i < r->n; i++)
    if (expr_same(r->from[i], a) && expr_same(r->to[i], b)) {
      r->in_call[i] = r->in_call[i] && in_call;
      return;
    }
  if (r->n == MAX_REPLACEMENTS) {
    r->too_many = true;
    return;
  }
  r->from[r->n] = a;
  r->in_call[r->n] = in_call;
  r->to[r->n++] = b;
}

/* first_order(...) is how the paper's difference of two motions is written here; its list of symbols is not the
   paper's. */
static void compare(struct replacements *r, const struct expr *a, const struct expr *b, bool in_call, int level) {
  if (r->too_many) return;
  if (a->kind == EXPR_FIRST_ORDER && b->kind == EXPR_FIRST_ORDER) {
    compare(r, a->args[0], b->args[0], in_call, level);
    return;
  }
  if (level == MAX_LEVELS)
    r->too_many = true;
  else if (!expr_same_node(a, b))
    add_pair(r, a, b, in_call);
  else
    for (int i = 0; i < a->n_args; i++) compare(r, a->args[i], b->args[i], in_call || a->kind == EXPR_CALL, level + 1);
}

/* false when the statements are not of the same form. */
static bool compare_statements(struct replacements *r, const struct stmt *a, const struct stmt *b) {
  if (a->kind != b->kind || a->n_sides != b->n_sides) return false;
  int n = a->kind == STMT_RELATION ? a->n_sides : a->kind == STMT_TRAJECTORY ? 0 : 1;
  for (int i = 0; i < n; i++) compare(r, a->sides[i], b->sides[i], false, 0);
  return true;
}

static void add_change(struct text *out, const struct replacements *r) {
  for (int i = 0; i < r->n; i++) {
    text_add(out, i ? "; $" : "replace $");
    expr_latex(out, r->from[i]);
    text_add(out, "$ by $");
    expr_latex(out, r->to[i]);
    text_add(out, "$");
  }
}

/* The statement; of a chain without what is not the paper's text. */
static void add_statement(struct text *out, struct arena *a, const struct stmt *s) {
  struct stmt shown = *s;
  text_add(out, out->len ? ", \\quad " : "");
  if (s->kind == STMT_RELATION) {
    shown.sides = arena_alloc(a, (size_t)s->n_sides * sizeof *shown.sides);
    shown.ops = arena_alloc(a, (size_t)s->n_sides * sizeof *shown.ops);
    shown.n_sides = 0;
    for (int i = 0; i < s->n_sides; i++) {
      if (s->sides[i]->kind == EXPR_FIRST_ORDER) continue;
      if (shown.n_sides) shown.ops[shown.n_sides - 1] = s->ops[i - 1];
      shown.sides[shown.n_sides++] = s->sides[i];
    }
  }
  stmt_latex(out, shown.n_sides < 2 ? s : &shown);
}

/* The record's TeX, once. */
static void add_quote(struct text *out, const struct statement_record **last, const struct statement_record *r) {
  if (!r || r == *last || !*r->tex) return;
  if (out->len) text_add_char(out, ' ');
  record_quote(out, r, " ... ");
  *last = r;
}

/* What an erratum is set beside: texts that grow from one erratum of a claim to the next. */
struct beside {
  struct arena *arena;
  struct text corrected, printed, quote;
  struct replacements change;
  const struct statement_record *quoted;
  bool comparable;
};

/* Statement by statement against the record that it replaces; or, definition by definition, by name. */
static void set_beside(struct beside *b, const struct model *m, const struct statement_record *erratum,
                       bool by_statement) {
  struct view printed = {m, LAYER_PRINTED, NULL, NULL};
  const struct statement_record *old = by_statement ? view_record(&printed, erratum->id) : NULL;
  for (int k = 0; old && k < old->n_stmts; k++) add_statement(&b->printed, b->arena, old->stmts[k]);
  add_quote(&b->quote, &b->quoted, old);
  if (by_statement && (!old || old->n_stmts != erratum->n_stmts)) b->comparable = false;
  for (int k = 0; k < erratum->n_stmts; k++) {
    const struct stmt *now = erratum->stmts[k], *before = NULL;
    struct diag d = {0};
    add_statement(&b->corrected, b->arena, now);
    if (by_statement) {
      before = b->comparable ? old->stmts[k] : NULL;
    } else if (now->name) {
      const struct definition *def = view_lookup(&printed, now->name, erratum->section, &d);
      before = def ? def->stmt : NULL;
      if (before) add_statement(&b->printed, b->arena, before);
      if (def) add_quote(&b->quote, &b->quoted, model_statements(m, def->record));
    }
    b->comparable = before && compare_statements(&b->change, before, now) && b->comparable;
  }
}

static const char *keep(struct audit_result *out, struct text *t) {
  const char *s = t->len ? result_copy(out, text_str(t)) : NULL;
  text_clear(t);
  return s;
}

/* By statement; where no erratum is, by definition. */
static void set_all_beside(struct beside *b, const struct model *m, const struct claim *c) {
  bool by_statement = erratum_replaces(m, c);
  for (size_t i = 0; i < m->n_records; i++)
    if (erratum_is_about(&m->records[i], c, by_statement)) set_beside(b, m, &m->records[i], by_statement);
}

/* Whether every statement of the erratum is one of the printed ones, of which there are more: it keeps some readings of
   an index and drops the others. */
static bool only_drops(const struct model *m, const struct claim *c) {
  struct view printed = {m, LAYER_PRINTED, NULL, NULL};
  long kept = 0;
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (!erratum_is_about(r, c, true)) continue;
    const struct statement_record *old = view_record(&printed, r->id);
    if (!old || old->n_stmts <= r->n_stmts) return false;
    for (int k = 0; k < r->n_stmts; k++) {
      bool among = false;
      for (int q = 0; q < old->n_stmts && !among; q++) {
        struct replacements none = {.n = 0};
        among = compare_statements(&none, old->stmts[q], r->stmts[k]) && none.n == 0 && !none.too_many;
      }
      if (!among) return false;
      kept++;
    }
  }
  return kept > 0;
}

bool erratum_renames(const struct model *m, const struct claim *c) {
  LOCAL(arena, a);
  struct beside b = {.arena = &a, .comparable = true};
  set_all_beside(&b, m, c);
  bool names = b.comparable && !b.change.too_many && b.change.n > 0;
  for (int i = 0; i < b.change.n; i++)
    names = names && b.change.from[i]->kind == EXPR_SYM && (b.change.to[i]->kind == EXPR_SYM || b.change.in_call[i]);
  text_clear(&b.quote);
  text_clear(&b.printed);
  text_clear(&b.corrected);
  return names || only_drops(m, c);
}

void erratum_typeset(struct finding *f, struct judge *j, const struct claim *c) {
  struct beside b = {.arena = &j->out->arena, .comparable = true};
  set_all_beside(&b, j->model, c);
  struct text change = {0};
  if (b.comparable && !b.change.too_many) add_change(&change, &b.change);
  f->change = keep(j->out, &change);
  f->correction_latex = keep(j->out, &b.corrected);
  f->printed_part = keep(j->out, &b.printed);
  f->quote_part = keep(j->out, &b.quote);
}

bool erratum_is_about(const struct statement_record *r, const struct claim *c, bool by_statement) {
  return r->rank == RANK_ERRATA && (by_statement ? claim_says(c, "statement", r->id) : claim_numbers(c, r));
}

bool erratum_replaces(const struct model *m, const struct claim *c) {
  for (size_t i = 0; i < m->n_records; i++)
    if (erratum_is_about(&m->records[i], c, true)) return true;
  return false;
}

bool erratum_text(struct text *out, const struct model *m, const struct claim *c) {
  const char *sep = "";
  bool found = false, by_statement = erratum_replaces(m, c);
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    if (!erratum_is_about(r, c, by_statement)) continue;
    for (int k = 0; k < r->n_stmts; k++) {
      text_add(out, sep);
      stmt_print(out, r->stmts[k]);
      sep = "; ";
    }
    found = true;
  }
  return found;
}
