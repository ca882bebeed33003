/* Every formula of a layer, found by walking its definitions and statements, entry by entry and as matrices. */
#include <stdlib.h>
#include <string.h>

#include "claim/claims.h"
#include "stability_impl.h"
#include "value/names.h"

/* --- Text to scalars --- */

bool digits_tape_of(struct tape *t, struct digits_set *s, const char *text, const char *section) {
  struct diag d = {0};
  struct matrix m;
  *t = (struct tape){.n = 0};
  if (!elaborate_text(&m, &s->el, "formula", text, section, &d) || m.rows * m.cols != 1) return false;
  return elaboration_tape(t, &s->el, m.e, 1, &d);
}

bool digits_formula_of(struct digits_formula *f, struct digits_set *s, const char *id, const char *text,
                       const char *section, struct diag *d) {
  struct matrix m;
  if (!elaborate_text(&m, &s->el, "formula", text, section, d)) return false;
  *f = (struct digits_formula){
      .id = id, .also = "", .record = "", .equation = "", .section = section, .text = text, .n = m.rows * m.cols};
  f->entry = arena_alloc(&s->arena, (size_t)f->n * sizeof *f->entry);
  memcpy(f->entry, m.e, (size_t)f->n * sizeof *f->entry);
  if (!digits_formula_make(f, s, d)) return false;
  if (f->tape.n_inputs <= DIGITS_INPUTS) return true;
  diag_set(d, "%s has more than %d inputs", id, DIGITS_INPUTS);
  digits_formula_clear(f);
  return false;
}

/* --- Taking one in --- */

/* Takes the formula in, unless it computes nothing or is there already. */
static bool add_formula(struct digits_set *s, struct digits_formula f, struct diag *d) {
  if (!digits_formula_make(&f, s, d)) return false;
  bool wanted = digits_formula_computes(&f) && f.tape.n_inputs > 0 && f.tape.n_inputs <= DIGITS_INPUTS;
  for (size_t i = 0; wanted && i < s->n; i++) /* the functions of the program are not there yet */
    if (digits_formula_same(&s->formula[i], &f)) {
      const char *also = s->formula[i].also;
      s->formula[i].also = arena_printf(&s->arena, "%s%s%s", also, *also ? ", " : "", f.id);
      wanted = false;
    }
  if (!wanted) {
    digits_formula_clear(&f);
    return true;
  }
  *SS_PUSH(s->formula, s->n, s->cap) = f;
  return true;
}

const char *digits_entry_id(struct digits_set *s, const char *id, int rows, int cols, int k) {
  if (rows > 1 && cols > 1) return arena_printf(&s->arena, "%s[%d,%d]", id, k / cols + 1, k % cols + 1);
  return rows > 1 || cols > 1 ? arena_printf(&s->arena, "%s[%d]", id, k + 1) : arena_strdup(&s->arena, id);
}

/* Entry by entry, then the matrix. */
static bool add_matrix(struct digits_set *s, struct digits_formula f, const struct matrix *m, struct diag *d) {
  int n = m->rows * m->cols;
  const char *id = f.id;
  f.also = "";
  for (int k = 0; k < n; k++) {
    f.id = digits_entry_id(s, id, m->rows, m->cols, k);
    f.n = 1;
    f.entry = arena_alloc(&s->arena, sizeof *f.entry);
    f.entry[0] = m->e[k];
    if (!add_formula(s, f, d)) return false;
  }
  if (n == 1) return true;
  f.id = id;
  f.n = n;
  f.entry = arena_alloc(&s->arena, (size_t)n * sizeof *f.entry);
  memcpy(f.entry, m->e, (size_t)n * sizeof *f.entry);
  return add_formula(s, f, d);
}

/* --- All of them --- */

static const char *printed(struct digits_set *s, const struct stmt *st) {
  struct text t = {0};
  stmt_print(&t, st);
  return text_take(&s->arena, &t);
}

/* The name, with its section where several sections define it. */
static const char *definition_id(struct digits_set *s, const struct definition *def) {
  const struct model *m = s->el.view.model;
  for (size_t i = 0; i < m->n_defs; i++)
    if (strcmp(m->defs[i].name, def->name) == 0 && strcmp(m->defs[i].section, def->section) != 0 &&
        view_sees(&s->el.view, &m->defs[i]))
      return arena_printf(&s->arena, "%s@%s", def->name, def->section);
  return def->name;
}

/* The name as an expression; a function is taken at an argument of that name. */
static const char *definition_text(struct digits_set *s, const struct definition *def, const char *argument) {
  return def->stmt->param ? arena_printf(&s->arena, "%s(%s)", def->name, argument) : def->name;
}

static const char *argument_of(const struct digits_set *s, const struct definition *def) {
  const char *p = def->stmt->param;
  return p && model_is_symbol(s->el.view.model, p) ? p : "t";
}

/* Is it what its own section sees under its name? */
static bool is_current(const struct digits_set *s, const struct definition *def) {
  return def->stmt->kind != STMT_TRAJECTORY && view_sees(&s->el.view, def) &&
         view_lookup(&s->el.view, def->name, def->section, NULL) == def;
}

static void keep_names(struct digits_set *s, const char *text, const struct matrix *m) {
  for (int k = 0; k < m->rows * m->cols; k++) {
    const struct expr *e = m->e[k];
    if (e->n_args == 0 || (e->kind == EXPR_NEG && e->args[0]->n_args == 0)) continue;
    *SS_PUSH(s->name, s->n_names, s->cap_names) =
        (struct digits_name){e, digits_entry_id(s, text, m->rows, m->cols, k)};
  }
}

/* Names of values: of functions at every time that the paper names. */
static bool name_definition(struct digits_set *s, const struct definition *def, struct diag *d) {
  for (int i = 0; i < (def->stmt->param ? 1 + N_PHASES : 1); i++) {
    const char *argument = i ? name_time[i - 1] : argument_of(s, def);
    if (i && !model_is_symbol(s->el.view.model, argument)) continue;
    struct matrix m;
    const char *text = definition_text(s, def, argument);
    if (!elaborate_text(&m, &s->el, "formula", text, def->section, d)) return false;
    keep_names(s, text, &m);
  }
  return true;
}

/* Another name for something that has one: phi_3(t) := H(t), H_11 := H(t_c)[1,1]. */
static bool is_alias(const struct definition *def) {
  const struct expr *e = expr_bare(def->stmt->sides[0]);
  return def->stmt->kind == STMT_DEFINE && (e->kind == EXPR_SYM || e->kind == EXPR_CALL || e->kind == EXPR_INDEX);
}

/* Scalars first, then matrices, then other names for them: what is there twice is known by the first. */
enum definition_turn { TURN_SCALARS, TURN_MATRICES, TURN_ALIASES, N_TURNS };

static bool add_definition(struct digits_set *s, const struct definition *def, enum definition_turn turn,
                           struct diag *d) {
  struct matrix m;
  if (is_alias(def) != (turn == TURN_ALIASES)) return true;
  if (!elaborate_text(&m, &s->el, "formula", definition_text(s, def, argument_of(s, def)), def->section, d))
    return false;
  if (turn != TURN_ALIASES && (m.rows * m.cols > 1) != (turn == TURN_MATRICES)) return true;
  struct digits_formula f = {.id = definition_id(s, def),
                             .record = def->record->id_name,
                             .equation = def->equation,
                             .section = def->section,
                             .text = printed(s, def->stmt)};
  return add_matrix(s, f, &m, d);
}

static bool add_sides(struct digits_set *s, const struct statement_record *r, struct diag *d) {
  int n = 0;
  for (int i = 0; i < r->n_stmts; i++) {
    const struct stmt *st = r->stmts[i];
    for (int k = 0; st->kind == STMT_RELATION && k < st->n_sides; k++) {
      struct matrix m;
      n++;
      if (!elaborate(&m, &s->el, st->sides[k], r->src, r->section, d)) return false;
      struct digits_formula f = {.id = arena_printf(&s->arena, "%s.%d", r->id, n),
                                 .record = r->id,
                                 .equation = r->equation,
                                 .section = r->section,
                                 .text = printed(s, st)};
      if (!add_matrix(s, f, &m, d)) return false;
    }
  }
  return true;
}

bool digits_set_make(struct digits_set *s, const struct model *m, enum layer layer, struct diag *d) {
  *s = (struct digits_set){.n = 0};
  elaboration_init(&s->el, (struct view){.model = m, .layer = layer}, NULL, 0);
  bool ok = true;
  for (int functions = 0; functions < 2; functions++) /* a name without an argument is the shorter one */
    for (size_t i = 0; ok && i < m->n_defs; i++)
      if (is_current(s, &m->defs[i]) && !m->defs[i].stmt->param == !functions) ok = name_definition(s, &m->defs[i], d);
  for (int turn = 0; turn < N_TURNS; turn++)
    for (size_t i = 0; ok && i < m->n_defs; i++)
      if (is_current(s, &m->defs[i])) ok = add_definition(s, &m->defs[i], (enum definition_turn)turn, d);
  for (size_t i = 0; ok && i < m->n_records; i++)
    if (view_record(&s->el.view, m->records[i].id) == &m->records[i]) ok = add_sides(s, &m->records[i], d);
  for (size_t i = 0; ok && i < m->n_defs; i++)
    if (is_current(s, &m->defs[i])) digits_note_definition(s, &m->defs[i]);
  for (size_t i = 0; ok && i < m->n_records; i++)
    if (view_record(&s->el.view, m->records[i].id) == &m->records[i]) digits_note_record(s, &m->records[i]);
  digits_enrol_kernels(s);
  return ok;
}

void digits_set_clear(struct digits_set *s) {
  for (size_t i = 0; i < s->n; i++) digits_formula_clear(&s->formula[i]);
  free(s->formula);
  free(s->name);
  free(s->place);
  elaboration_clear(&s->el);
  arena_clear(&s->arena);
}

/* --- Finding them again --- */

bool digits_is_entry(const struct digits_formula *f) {
  return strchr(f->id, '[') != NULL;
}

static bool listed(const char *list, const char *name) {
  size_t len = strlen(name);
  for (const char *p = list; (p = strstr(p, name)); p++)
    if ((p == list || p[-1] == ' ') && (p[len] == '\0' || p[len] == ',')) return true;
  return false;
}

bool digits_selected(const struct digits_formula *f, const char *operand) {
  size_t len = strlen(operand);
  if (len == 0) return false;
  bool whole = strcmp(f->id, operand) == 0 || listed(f->also, operand);
  bool entry = strncmp(f->id, operand, len) == 0 && f->id[len] == '[';
  return whole || entry || claim_selected(f->record, operand);
}

struct digits_formula *digits_find(const struct digits_set *s, const char *id) {
  for (size_t i = 0; i < s->n; i++)
    if (strcmp(s->formula[i].id, id) == 0 || listed(s->formula[i].also, id)) return &s->formula[i];
  return NULL;
}

struct digits_formula *digits_other(const struct digits_set *s, const struct digits_formula *f) {
  struct digits_formula *g = f->kernel ? NULL : digits_find(s, f->id);
  return g && g->n == f->n && !tape_same(&g->tape, &f->tape) ? g : NULL;
}
