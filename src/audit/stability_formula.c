/* Every formula of a layer, found by walking its definitions and statements, as a tape whose nodes are all visible.

   A formula is a scalar (an entry of a matrix too) or a whole matrix, measured by its largest entry.  Subexpressions are
   printed by the names that the paper gives them: equal scalars of one elaboration are one pointer. */
#include <stdlib.h>
#include <string.h>

#include "stability_impl.h"

/* --- Text to scalars --- */

static bool elaborate_text(struct matrix *out, struct digits_set *s, const char *text, const char *section,
                           struct diag *d) {
  struct source src;
  source_from_string(&src, "formula", text);
  const struct expr *e = expr_parse(&s->arena, &src, (struct span){0, src.len}, d);
  bool ok = e && elaborate(out, &s->el, e, &src, section, d);
  source_clear(&src);
  return ok;
}

bool digits_tape_of(struct tape *t, struct digits_set *s, const char *text, const char *section) {
  struct diag d;
  struct matrix m;
  diag_init(&d);
  *t = (struct tape){.n = 0};
  if (!elaborate_text(&m, s, text, section, &d) || m.rows * m.cols != 1) return false;
  return elaboration_tape(t, &s->el, m.e, 1, &d);
}

slong digits_input(const struct tape *t, const char *name) {
  for (slong k = 0; k < t->n_inputs; k++)
    if (strcmp(t->inputs[k], name) == 0) return k;
  return -1;
}

/* --- What an input is --- */

enum input_class digits_class_of(const char *name) {
  static const struct {
    const char *begin;
    bool whole;
    enum input_class class;
  } table[] = {{"chi", true, INPUT_CHI},       {"eta", true, INPUT_ETA},   {"V", true, INPUT_V},
               {"eps", true, INPUT_SIGN},      {"e_", false, INPUT_FORCE}, {"u_r", false, INPUT_FORCE},
               {"u_s", false, INPUT_FORCE},    {"k_", false, INPUT_FORCE}, {"m_", false, INPUT_FORCE},
               {"omega_", false, INPUT_FORCE}, {"t_", false, INPUT_TIME},  {"t", true, INPUT_TIME}};
  for (size_t i = 0; i < sizeof table / sizeof *table; i++)
    if (table[i].whole ? strcmp(name, table[i].begin) == 0 : strncmp(name, table[i].begin, strlen(table[i].begin)) == 0)
      return table[i].class;
  return INPUT_STATE;
}

/* --- One formula --- */

static const struct tape_root *root_of(const struct digits_set *s, const struct expr *e) {
  for (size_t i = 0; e->kind == EXPR_SYM && i < s->el.n_roots; i++)
    if (strcmp(s->el.roots[i].name, e->name) == 0) return &s->el.roots[i];
  return NULL;
}

/* The scalar of each node, from the outputs down: operands stand before their use. */
static void name_nodes(struct digits_formula *f, const struct digits_set *s) {
  const struct tape *t = &f->tape;
  for (slong k = 0; k < f->n; k++) f->node[f->out[k]] = f->entry[k];
  for (slong i = t->n; i-- > 0;) {
    const struct tape_instr *in = &t->code[i];
    const struct expr *e = f->node[i];
    if (in->op == TAPE_ROOT) {
      const struct tape_root *r = root_of(s, e);
      for (slong k = 0; k < in->b; k++) f->node[t->links[in->a + k]] = r->coeff[k];
      continue;
    }
    if (in->op == TAPE_CONST || in->op == TAPE_INPUT) continue;
    f->node[in->a] = e->args[0];
    if (in->b >= 0) f->node[in->b] = e->args[1];
  }
}

static bool make_tape(struct digits_formula *f, struct digits_set *s, struct diag *d) {
  struct tape *t = &f->tape;
  if (!elaboration_tape(t, &s->el, f->entry, f->n, d)) return false;
  f->out = arena_alloc(&s->arena, (size_t)f->n * sizeof *f->out);
  memcpy(f->out, t->outputs, (size_t)f->n * sizeof *f->out);
  f->node = arena_alloc(&s->arena, (size_t)t->n * sizeof *f->node);
  name_nodes(f, s);
  t->outputs = ss_realloc(t->outputs, (size_t)t->n * sizeof *t->outputs);
  t->n_outputs = t->n;
  for (slong i = 0; i < t->n; i++) t->outputs[i] = i;
  f->input = arena_alloc(&s->arena, ((size_t)t->n_inputs + 1) * sizeof *f->input);
  for (slong k = 0; k < t->n_inputs; k++) f->input[k] = digits_class_of(t->inputs[k]);
  return true;
}

/* A value of a motion, z_1(t), is an input like any other: the formula does not say how it comes from t. */
static const struct expr *without_calls(struct digits_set *s, const struct expr *e) {
  struct expr_pool *p = &s->el.pool;
  if (e->kind == EXPR_CALL) {
    struct text name;
    text_init(&name);
    expr_print(&name, e);
    const struct expr *sym = expr_sym(p, text_str(&name));
    text_clear(&name);
    return sym;
  }
  if (e->n_args == 0) return e;
  const struct expr *a = without_calls(s, e->args[0]);
  if (e->kind == EXPR_POW) return expr_pow(p, a, e->exponent);
  return e->n_args == 1 ? expr_op1(p, e->kind, a) : expr_op2(p, e->kind, a, without_calls(s, e->args[1]));
}

static bool has_calls(const struct tape *t) {
  bool yes = false;
  for (slong k = 0; k < t->n_inputs; k++) yes = yes || strchr(t->inputs[k], '(');
  return yes;
}

/* Does it round anything at all? */
static bool computes(const struct tape *t) {
  for (slong i = 0; i < t->n; i++) {
    enum tape_op op = t->code[i].op;
    if (op != TAPE_CONST && op != TAPE_INPUT && op != TAPE_neg && op != TAPE_abs) return true;
  }
  return false;
}

static void formula_clear(struct digits_formula *f) {
  tape_clear(&f->tape);
  if (f->have_slopes) tape_clear(&f->slopes);
}

/* The same formula but for the names of inputs, which must be of one kind. */
static bool same_formula(const struct digits_formula *a, const struct digits_formula *b) {
  if (a->n != b->n || a->tape.n_inputs != b->tape.n_inputs) return false;
  for (slong k = 0; k < a->tape.n_inputs; k++)
    if (a->input[k] != b->input[k]) return false;
  for (slong k = 0; k < a->n; k++)
    if (a->out[k] != b->out[k]) return false;
  struct tape other = b->tape;
  other.inputs = a->tape.inputs;
  return tape_same(&a->tape, &other);
}

static const char *joined(struct arena *a, const char *first, const char *second) {
  struct text t;
  text_init(&t);
  text_printf(&t, "%s%s%s", first, *first ? ", " : "", second);
  const char *r = arena_strndup(a, text_str(&t), t.len);
  text_clear(&t);
  return r;
}

/* Takes the formula in, unless it computes nothing or is there already. */
static bool add_formula(struct digits_set *s, struct digits_formula f, struct diag *d) {
  if (!make_tape(&f, s, d)) return false;
  if (has_calls(&f.tape)) {
    for (slong k = 0; k < f.n; k++) f.entry[k] = without_calls(s, f.entry[k]);
    tape_clear(&f.tape);
    if (!make_tape(&f, s, d)) return false;
  }
  bool wanted = computes(&f.tape) && f.tape.n_inputs > 0 && f.tape.n_inputs <= DIGITS_INPUTS;
  for (size_t i = 0; wanted && i < s->n; i++) /* the functions of the program are not there yet */
    if (same_formula(&s->formula[i], &f)) {
      s->formula[i].also = joined(&s->arena, s->formula[i].also, f.id);
      wanted = false;
    }
  if (!wanted) {
    tape_clear(&f.tape);
    return true;
  }
  s->formula = ss_grow(s->formula, s->n, &s->cap, sizeof *s->formula);
  s->formula[s->n++] = f;
  return true;
}

static const char *entry_id(struct digits_set *s, const char *id, const struct matrix *m, int k) {
  struct text t;
  text_init(&t);
  text_add(&t, id);
  if (m->rows > 1 && m->cols > 1) text_printf(&t, "[%d,%d]", k / m->cols + 1, k % m->cols + 1);
  if ((m->rows > 1) != (m->cols > 1)) text_printf(&t, "[%d]", k + 1);
  const char *r = arena_strndup(&s->arena, text_str(&t), t.len);
  text_clear(&t);
  return r;
}

/* Entry by entry, then the matrix. */
static bool add_matrix(struct digits_set *s, struct digits_formula f, const struct matrix *m, struct diag *d) {
  int n = m->rows * m->cols;
  const char *id = f.id;
  f.also = "";
  for (int k = 0; k < n; k++) {
    f.id = entry_id(s, id, m, k);
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
  struct text t;
  text_init(&t);
  stmt_print(&t, st);
  const char *r = arena_strndup(&s->arena, text_str(&t), t.len);
  text_clear(&t);
  return r;
}

static const char *formatted(struct digits_set *s, const char *fmt, const char *a, const char *b) {
  struct text t;
  text_init(&t);
  text_printf(&t, fmt, a, b); /* NOLINT: the formats are in this file */
  const char *r = arena_strndup(&s->arena, text_str(&t), t.len);
  text_clear(&t);
  return r;
}

/* The name, with its section where several sections define it. */
static const char *definition_id(struct digits_set *s, const struct definition *def) {
  const struct model *m = s->el.view.model;
  for (size_t i = 0; i < m->n_defs; i++)
    if (strcmp(m->defs[i].name, def->name) == 0 && strcmp(m->defs[i].section, def->section) != 0 &&
        view_sees(&s->el.view, &m->defs[i]))
      return formatted(s, "%s@%s", def->name, def->section);
  return def->name;
}

/* The name as an expression; a function is taken at an argument of that name. */
static const char *definition_text(struct digits_set *s, const struct definition *def, const char *argument) {
  return def->stmt->param ? formatted(s, "%s(%s)", def->name, argument) : def->name;
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
    s->name = ss_grow(s->name, s->n_names, &s->cap_names, sizeof *s->name);
    s->name[s->n_names++] = (struct digits_name){e, entry_id(s, text, m, k)};
  }
}

/* Names of values: of functions at every time that the paper names. */
static bool name_definition(struct digits_set *s, const struct definition *def, struct diag *d) {
  static const char *const times[] = {"", "t_a", "t_b", "t_c", "t_d"};
  for (size_t i = 0; i < (def->stmt->param ? sizeof times / sizeof *times : 1); i++) {
    const char *argument = i ? times[i] : argument_of(s, def);
    if (i && !model_is_symbol(s->el.view.model, argument)) continue;
    struct matrix m;
    const char *text = definition_text(s, def, argument);
    if (!elaborate_text(&m, s, text, def->section, d)) return false;
    keep_names(s, text, &m);
  }
  return true;
}

/* Another name for something that has one: phi_3(t) := H(t), H_11 := H(t_c)[1,1]. */
static bool is_alias(const struct definition *def) {
  const struct expr *e = def->stmt->sides[0];
  while (e->kind == EXPR_PAREN) e = e->args[0];
  return def->stmt->kind == STMT_DEFINE && (e->kind == EXPR_SYM || e->kind == EXPR_CALL || e->kind == EXPR_INDEX);
}

/* Scalars first, then matrices, then other names for them: what is there twice is known by the first. */
enum definition_turn { TURN_SCALARS, TURN_MATRICES, TURN_ALIASES, N_TURNS };

static bool add_definition(struct digits_set *s, const struct definition *def, enum definition_turn turn,
                           struct diag *d) {
  struct matrix m;
  if (is_alias(def) != (turn == TURN_ALIASES)) return true;
  if (!elaborate_text(&m, s, definition_text(s, def, argument_of(s, def)), def->section, d)) return false;
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
      char number[16];
      snprintf(number, sizeof number, "%d", ++n);
      if (!elaborate(&m, &s->el, st->sides[k], r->src, r->section, d)) return false;
      struct digits_formula f = {.id = formatted(s, "%s.%s", r->id, number),
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
  arena_init(&s->arena);
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
  digits_enrol_kernels(s);
  return ok;
}

void digits_set_clear(struct digits_set *s) {
  for (size_t i = 0; i < s->n; i++) formula_clear(&s->formula[i]);
  free(s->formula);
  free(s->name);
  elaboration_clear(&s->el);
  arena_clear(&s->arena);
}

/* --- Finding them again --- */

static bool listed(const char *list, const char *name) {
  size_t len = strlen(name);
  for (const char *p = list; (p = strstr(p, name)); p++)
    if ((p == list || p[-1] == ' ') && (p[len] == '\0' || p[len] == ',')) return true;
  return false;
}

bool digits_selected(const struct digits_formula *f, const char *operand) {
  size_t len = strlen(operand);
  bool whole = strcmp(f->id, operand) == 0 || listed(f->also, operand);
  bool entry = strncmp(f->id, operand, len) == 0 && f->id[len] == '[';
  return whole || entry || claim_selected(f->record, operand);
}

const struct digits_formula *digits_find(const struct digits_set *s, const char *id) {
  for (size_t i = 0; i < s->n; i++)
    if (strcmp(s->formula[i].id, id) == 0 || listed(s->formula[i].also, id)) return &s->formula[i];
  return NULL;
}

/* --- Derivatives --- */

static bool is_zero(const struct expr *e) {
  return e->kind == EXPR_NUM && strcmp(e->name, "0") == 0;
}

/* a + b, where zeros leave no trace. */
static const struct expr *plus(struct expr_pool *p, const struct expr *a, const struct expr *b) {
  return is_zero(a) ? b : is_zero(b) ? a : expr_op2(p, EXPR_ADD, a, b);
}

static const struct expr *times(struct expr_pool *p, const struct expr *a, const struct expr *b) {
  return is_zero(a) ? a : is_zero(b) ? b : expr_op2(p, EXPR_MUL, a, b);
}

static const struct expr *slope(struct digits_set *s, const struct expr *e, const char *sym);

/* A root w of sum c_k w^k: w' = -(sum c_k' w^k)/(sum k c_k w^(k-1)). */
static const struct expr *root_slope(struct digits_set *s, const struct tape_root *r, const char *sym) {
  struct expr_pool *p = &s->el.pool;
  const struct expr *w = expr_sym(p, r->name), *above = expr_int(p, 0), *below = expr_int(p, 0);
  for (int k = 0; k < r->n_coeff; k++) {
    above = plus(p, above, times(p, slope(s, r->coeff[k], sym), expr_pow(p, w, k)));
    if (k == 0) continue;
    below = plus(p, below, times(p, expr_op2(p, EXPR_MUL, expr_int(p, k), r->coeff[k]), expr_pow(p, w, k - 1)));
  }
  return is_zero(above) ? above : expr_op1(p, EXPR_NEG, expr_op2(p, EXPR_DIV, above, below));
}

/* The total derivative: roots depend on the inputs too. */
static const struct expr *slope(struct digits_set *s, const struct expr *e, const char *sym) {
  struct expr_pool *p = &s->el.pool;
  const struct expr *sum = expr_diff(p, e, sym);
  for (size_t i = 0; i < s->el.n_roots; i++) {
    const struct expr *by = expr_diff(p, e, s->el.roots[i].name);
    if (!is_zero(by)) sum = plus(p, sum, times(p, by, root_slope(s, &s->el.roots[i], sym)));
  }
  return sum;
}

bool digits_slopes(struct digits_formula *f, struct digits_set *s, struct diag *d) {
  if (f->have_slopes) return true;
  slong n = f->tape.n_inputs;
  const struct expr **e = ss_malloc((size_t)(f->n * n) * sizeof *e);
  for (slong i = 0; i < f->n; i++)
    for (slong k = 0; k < n; k++) e[i * n + k] = slope(s, f->entry[i], f->tape.inputs[k]);
  f->have_slopes = elaboration_tape(&f->slopes, &s->el, e, f->n * n, d);
  free(e);
  return f->have_slopes;
}

/* --- In the paper's notation --- */

enum { SHOWN_DEPTH = 3 };

static bool is_one(const struct expr *e) {
  return e->kind == EXPR_NUM && strcmp(e->name, "1") == 0;
}

/* Without the zeros and ones that matrix products bring along; for reading only. */
static const struct expr *tidy(struct expr_pool *p, enum expr_kind k, const struct expr *a, const struct expr *b) {
  if (k == EXPR_MUL && (is_zero(a) || is_one(b))) return a;
  if (k == EXPR_MUL && (is_zero(b) || is_one(a))) return b;
  if (k == EXPR_DIV && (is_one(b) || is_zero(a))) return a;
  if (k == EXPR_ADD && is_zero(a)) return b;
  if ((k == EXPR_ADD || k == EXPR_SUB) && is_zero(b)) return a;
  return expr_op2(p, k, a, b);
}

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
  struct text t;
  names_below(&b, s, e);
  if (b.looks <= FEW) return named(s, e, false, FEW);
  text_init(&t);
  text_add(&t, "f(");
  for (int i = 0; i < b.n && i < BELOW; i++) text_printf(&t, "%s%s", i ? ", " : "", b.name[i]);
  text_add(&t, b.n > BELOW || b.looks > LOOKED_AT ? ", ...)" : ")");
  const struct expr *sym = expr_sym(&s->el.pool, text_str(&t));
  text_clear(&t);
  return sym;
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
  return tidy(p, e->kind, a, named(s, e->args[1], true, depth - 1));
}

void digits_print_node(struct text *out, struct digits_set *s, const struct digits_formula *f, slong node, bool whole) {
  expr_print(out, named(s, f->node[node], whole, SHOWN_DEPTH));
}

void digits_print_point(struct text *out, const struct digits_formula *f, const double *x) {
  for (slong k = 0; k < f->tape.n_inputs; k++) text_printf(out, "%s%s=%a", k ? "," : "", f->tape.inputs[k], x[k]);
}
