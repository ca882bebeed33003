/* Which statements can be damaged, and by which names.  A statement's names are exchanged for others that mean
   something in its section; shapes come from elaborating every definition once. */
#include "mutants.h"

#include "material.h"

#include <stdlib.h>
#include <string.h>

/* Every name once, with what it stands for. */
struct lexicon {
  struct edit_word *word;
  size_t n, cap;
};

static struct view everything(const struct model *m) {
  return (struct view){m, LAYER_CORRECTED, NULL, NULL};
}

/* --- Words --- */

static bool has_name(const struct expr *e, const void *name) {
  return (e->kind == EXPR_SYM || e->kind == EXPR_CALL) && strcmp(e->name, name) == 0;
}

bool stands_in_statement(const struct stmt *s, const char *name) {
  return stmt_any(s, has_name, name);
}

static bool stands_in_section(const struct model *m, const char *section, const char *name) {
  for (size_t i = 0; i < m->n_records; i++) {
    const struct statement_record *r = &m->records[i];
    for (int k = 0; r->rank == RANK_PAPER && strcmp(r->section, section) == 0 && k < r->n_stmts; k++)
      if (stands_in_statement(r->stmts[k], name)) return true;
  }
  return false;
}

static void add_word(struct lexicon *l, struct edit_word w) {
  for (size_t i = 0; i < l->n; i++)
    if (strcmp(l->word[i].name, w.name) == 0) return;
  *SS_PUSH(l->word, l->n, l->cap) = w;
}

/* The shape of what a name means in a section; a function's at an argument of no importance. */
static void measure(struct edit_word *w, struct elaboration *el, const struct definition *def) {
  const struct expr one = {.kind = EXPR_NUM, .name = "1"}, *args[] = {&one};
  struct expr use = {.kind = w->function ? EXPR_CALL : EXPR_SYM, .name = w->name, .n_args = w->function, .args = args};
  struct matrix m;
  struct diag d = {0};
  bool ok = elaborate(&m, el, &use, def->src, def->section, &d);
  w->rows = ok ? m.rows : 0;
  w->cols = ok ? m.cols : 0;
}

/* Symbols first. */
struct lexicon *lexicon_new(const struct model *m, const char *section) {
  struct lexicon *l = ss_malloc(sizeof *l);
  *l = (struct lexicon){.n = 0};
  struct view v = everything(m);
  OWNED(elaboration) el;
  elaboration_init(&el, v, NULL, 0);
  for (size_t i = 0; i < m->n_symbols; i++)
    add_word(l, (struct edit_word){.name = m->symbols[i].name,
                                   .rows = 1,
                                   .cols = 1,
                                   .plain = !strpbrk(m->symbols[i].name, "_'") &&
                                            stands_in_section(m, section, m->symbols[i].name)});
  for (size_t i = 0; i < m->n_defs; i++) {
    struct diag d = {0};
    const struct definition *def = view_lookup(&v, m->defs[i].name, section, &d);
    if (!def) continue;
    struct edit_word w = {.name = def->name, .function = def->stmt->kind == STMT_TRAJECTORY || def->stmt->param};
    measure(&w, &el, def);
    if (w.rows) add_word(l, w);
  }
  return l;
}

void lexicon_free(struct lexicon *l) {
  free(l->word);
  free(l);
}

static const char *const added_factors[] = {"V", "chi", "2"};

void lexicon_edits(struct edits *out, struct arena *a, struct lexicon *l, const struct stmt *s) {
  for (size_t i = 0; i < l->n; i++) l->word[i].here = stands_in_statement(s, l->word[i].name);
  struct edit_vocabulary v = {l->word, l->n, added_factors, sizeof added_factors / sizeof *added_factors};
  stmt_edits(out, a, s, &v);
}

/* --- Targets --- */

struct target target_of(const struct model *m, size_t record, int stmt) {
  const struct statement_record *r = &m->records[record];
  struct view v = everything(m);
  struct target t = {record, stmt, -1, false};
  for (size_t i = 0; i < m->n_defs; i++)
    if (m->defs[i].stmt == r->stmts[stmt]) t.def = (long)i;
  struct diag d = {0};
  if (r->rank == RANK_ERRATA) return t;
  t.corrected = t.def >= 0 ? view_lookup(&v, m->defs[t.def].name, r->section, &d) != &m->defs[t.def]
                           : view_record(&v, r->id) != r;
  return t;
}

/* By names alone, whatever their sections: too many rather than too few. */
void target_reaches(bool *record, const struct model *m, const struct target *t) {
  FREED const char **name = ss_malloc((m->n_defs + 1) * sizeof *name);
  size_t n = 0;
  memset(record, 0, m->n_records * sizeof *record);
  record[t->record] = true;
  if (t->def >= 0) name[n++] = m->defs[t->def].name;
  for (size_t done = 0; done < n; done++)
    for (size_t i = 0; i < m->n_records; i++)
      for (int k = 0; k < m->records[i].n_stmts; k++) {
        const struct stmt *s = m->records[i].stmts[k];
        if (!stands_in_statement(s, name[done])) continue;
        record[i] = true;
        bool known = s->kind == STMT_RELATION;
        for (size_t q = 0; !known && q < n; q++) known = strcmp(name[q], s->name) == 0;
        if (!known) name[n++] = s->name;
      }
}

/* By its file, or its id. */
static bool is_named(const struct statement_record *r, const char *item) {
  return file_is_named(path_base(r->src->name), item) || strcmp(r->record->id_name, item) == 0;
}

static bool wanted(const struct statement_record *r, const char *const *only, int n_only) {
  for (int i = 0; i < n_only; i++)
    if (is_named(r, only[i])) return true;
  return n_only == 0;
}

bool mutants_any(const struct mutants *m, const struct model *model, const char *item) {
  for (size_t i = 0; i < m->n_targets; i++)
    if (is_named(&model->records[m->target[i].record], item)) return true;
  return false;
}

static void add_mutants(struct mutants *m, const struct model *model, struct lexicon *l, size_t record, int stmt) {
  OWNED(edits) e = {.n = 0};
  lexicon_edits(&e, &m->arena, l, model->records[record].stmts[stmt]);
  if (e.n) *SS_PUSH(m->target, m->n_targets, m->cap_targets) = target_of(model, record, stmt);
  for (size_t i = 0; i < e.n; i++) *SS_PUSH(m->mutant, m->n, m->cap) = (struct mutant){m->n_targets - 1, e.edit[i]};
}

void mutants_init(struct mutants *m, const struct model *model, const char *const *only, int n_only) {
  *m = (struct mutants){.n = 0};
  struct lexicon *l = NULL;
  const char *section = NULL;
  for (size_t i = 0; i < model->n_records; i++) {
    const struct statement_record *r = &model->records[i];
    if ((r->rank != RANK_PAPER && r->rank != RANK_ERRATA) || !wanted(r, only, n_only)) continue;
    if (!section || strcmp(section, r->section) != 0) {
      if (l) lexicon_free(l);
      l = lexicon_new(model, section = r->section);
    }
    for (int k = 0; k < r->n_stmts; k++) add_mutants(m, model, l, i, k);
  }
  if (l) lexicon_free(l);
}

void mutants_clear(struct mutants *m) {
  free(m->target);
  free(m->mutant);
  arena_clear(&m->arena);
}

/* --- The overlay --- */

void overlay_init(struct overlay *o, const struct model *under) {
  *o = (struct overlay){*under, under};
  struct model *m = &o->model;
  m->use = NULL;
  arena_init(&m->arena);
  m->defs = ss_malloc((under->n_defs + 1) * sizeof *m->defs);
  memcpy(m->defs, under->defs, under->n_defs * sizeof *m->defs);
  m->records = ss_malloc((under->n_records + 1) * sizeof *m->records);
  for (size_t i = 0; i < under->n_records; i++) {
    struct statement_record *r = &m->records[i];
    *r = under->records[i];
    r->stmts = arena_alloc(&m->arena, (size_t)r->n_stmts * sizeof *r->stmts + 1);
    for (int k = 0; k < r->n_stmts; k++) r->stmts[k] = under->records[i].stmts[k];
  }
}

void overlay_clear(struct overlay *o) {
  free(o->model.defs);
  free(o->model.records);
  arena_clear(&o->model.arena);
}

void overlay_set(struct overlay *o, const struct target *t, const struct stmt *s) {
  if (!s) s = o->under->records[t->record].stmts[t->stmt];
  o->model.records[t->record].stmts[t->stmt] = s;
  if (t->def >= 0) o->model.defs[t->def].stmt = s;
}

void overlay_leave_out(struct overlay *o, const struct target *t, bool out) {
  const struct statement_record *under = &o->under->records[t->record];
  struct statement_record *r = &o->model.records[t->record];
  r->n_stmts = 0;
  for (int k = 0; k < under->n_stmts; k++)
    if (!out || k != t->stmt) r->stmts[r->n_stmts++] = under->stmts[k];
}
