/* From trees to matrices of shared scalars: names replaced by what they stand for, functions applied, derivatives
   taken, matrices multiplied out.  Nothing is folded, so that an undefined subexpression stays undefined.  A definition
   is elaborated when it is first used and kept.  What matrices do with each other is matrix.c; how a root's polynomial
   is read is polynomial.c. */
#include <stdlib.h>
#include <string.h>

#include "elaborate_impl.h"

/* What a definition elaborated to.  A function's value holds its parameter as the symbol `param`. */
struct elab_memo {
  const struct definition *def; /* NULL: it failed, and the next use reports the same mistake again */
  bool done;
  struct matrix value;
  const char *param;
};

void elaboration_init(struct elaboration *el, struct view view, const struct override *overrides, int n_overrides) {
  *el = (struct elaboration){.view = view, .overrides = overrides, .n_overrides = n_overrides};
}

void elaboration_clear(struct elaboration *el) {
  free(el->roots);
  free(el->memo);
  free(el->calls);
  expr_pool_clear(&el->pool);
}

static bool eval(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                 struct diag *d);

static bool is_small(const struct elaboration *el, const struct expr *e, const struct scope *sc, struct diag *d) {
  if (el->pool.n <= MAX_SCALARS) return true;
  diag_beyond(d);
  return diag_at(d, sc->src, e->span.begin, "a formula of more than %d scalars when its definitions are put in",
                 MAX_SCALARS);
}

/* --- Names --- */

static const struct override *find_override(const struct elaboration *el, const char *name) {
  for (int i = 0; i < el->n_overrides; i++)
    if (strcmp(el->overrides[i].name, name) == 0) return &el->overrides[i];
  return NULL;
}

static struct matrix override_value(struct elaboration *el, const struct override *o) {
  struct matrix m = matrix_new(el, o->rows, o->cols);
  OWNED(text) t = {0};
  for (int i = 0; i < o->rows; i++)
    for (int j = 0; j < o->cols; j++) {
      text_reset(&t);
      text_printf(&t, "%s[%d,%d]", o->name, i + 1, j + 1);
      m.e[i * o->cols + j] = expr_sym(&el->pool, t.data);
    }
  return m;
}

/* The symbol that stands for a root: its name, with the section where another section has a root of that name too. */
static const char *root_symbol(struct elaboration *el, const struct definition *def) {
  const struct model *m = el->view.model;
  bool shared = false;
  for (size_t i = 0; i < m->n_defs; i++) {
    const struct definition *o = &m->defs[i];
    shared = shared || (o->stmt->kind == STMT_ROOT && strcmp(o->name, def->name) == 0 &&
                        strcmp(o->section, def->section) != 0 && view_sees(&el->view, o));
  }
  return arena_printf(&el->pool.arena, shared ? "%s@%s" : "%s", def->name, def->section);
}

/* Both places that name a symbol of their own, a function's parameter and a root's unknown. */
static struct scope scope_inside(struct elaboration *el, const struct definition *def) {
  struct scope sc = {.src = def->src, .section = def->section};
  if (def->stmt->kind == STMT_ROOT) {
    sc.unknown = def->name;
    sc.unknown_symbol = root_symbol(el, def);
  } else if (def->stmt->param) {
    sc.param = def->stmt->param;
    sc.param_symbol = arena_printf(&el->pool.arena, "%s@%s", def->stmt->param, def->name);
  }
  return sc;
}

static bool definition_value(struct matrix *out, struct elaboration *el, const struct definition *def,
                             const struct scope *sc, struct diag *d) {
  const struct expr *body = def->stmt->sides[0];
  if (!eval(out, el, body, sc, d)) return false;
  if (def->stmt->kind != STMT_ROOT) return true;
  if (!matrix_is_scalar(out)) return form_mistake(sc, body, d, "a root needs a scalar polynomial", out, NULL);
  if (!elaboration_add_root(el, def, sc->unknown_symbol, out->e[0], d)) return false;
  *out = matrix_scalar(el, expr_sym(&el->pool, sc->unknown_symbol));
  return true;
}

/* The memo entry of a definition, elaborated on first use.  Indices stay valid while the array grows. */
static bool define(size_t *index, struct elaboration *el, const struct definition *def, struct diag *d) {
  for (size_t i = 0; i < el->n_memo; i++)
    if (el->memo[i].def == def) {
      *index = i;
      if (el->memo[i].done) return true;
      return diag_at(d, def->src, def->stmt->span.begin, "%s is defined through itself", def->name);
    }
  struct scope sc = scope_inside(el, def);
  *index = el->n_memo;
  *SS_PUSH(el->memo, el->n_memo, el->cap_memo) = (struct elab_memo){.def = def, .param = sc.param_symbol};
  struct matrix value;
  bool ok = definition_value(&value, el, def, &sc, d);
  if (ok)
    el->memo[*index].value = value;
  else
    el->memo[*index].def = NULL;
  el->memo[*index].done = ok;
  return ok;
}

/* What a name stands for, and whether it takes an argument, is for the file to say, not for the paper. */
static void blame_file(struct diag *d) {
  if (d && !d->set) d->undeclared = true;
}

static bool undefined(const struct expr *e, const struct scope *sc, struct diag *d) {
  blame_file(d);
  if (e->kind == EXPR_CALL)
    return diag_at(d, sc->src, e->span.begin, "undefined function %s; define it, %s(x) := ...", e->name, e->name);
  return diag_at(d, sc->src, e->span.begin, "undefined symbol %s; define it or declare \"symbol %s\"", e->name,
                 e->name);
}

/* The definition that the scope sees, or NULL; false when there are several. */
static bool look_up(const struct definition **def, const struct elaboration *el, const struct expr *e,
                    const struct scope *sc, struct diag *d) {
  struct diag ambiguous = {0};
  *def = view_lookup(&el->view, e->name, sc->section, &ambiguous);
  if (!ambiguous.set) return true;
  blame_file(d);
  return diag_at(d, sc->src, e->span.begin, "%s", ambiguous.message);
}

static bool eval_symbol(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  if (sc->param && strcmp(e->name, sc->param) == 0) {
    *out = matrix_scalar(el, expr_sym(&el->pool, sc->param_symbol));
    return true;
  }
  if (sc->unknown && strcmp(e->name, sc->unknown) == 0) {
    *out = matrix_scalar(el, expr_sym(&el->pool, sc->unknown_symbol));
    return true;
  }
  const struct override *o = find_override(el, e->name);
  if (o) {
    *out = override_value(el, o);
    return true;
  }
  const struct definition *def;
  if (!look_up(&def, el, e, sc, d)) return false;
  if (!def) {
    if (!model_is_symbol(el->view.model, e->name) && strcmp(e->name, expr_pi) != 0) return undefined(e, sc, d);
    *out = matrix_scalar(el, expr_sym(&el->pool, e->name));
    return true;
  }
  if (def->stmt->kind == STMT_TRAJECTORY || def->stmt->param) {
    blame_file(d);
    return diag_at(d, sc->src, e->span.begin, "%s is a function; write %s(...)", e->name, e->name);
  }
  size_t i;
  if (!define(&i, el, def, d)) return false;
  *out = el->memo[i].value;
  return true;
}

/* A function, or a derivative of it, at an argument: entries of one matrix are asked for one by one.  The last few are
   kept. */
enum { KEPT_CALLS = 64 };

struct elab_call {
  size_t of; /* in memo */
  int order;
  const struct expr *arg;
  struct matrix value;
};

static struct matrix call_value(struct elaboration *el, size_t of, int order, const struct expr *arg) {
  for (size_t i = 0; i < el->n_calls; i++) {
    const struct elab_call *c = &el->calls[i];
    if (c->of == of && c->order == order && c->arg == arg) return c->value;
  }
  struct matrix body = el->memo[of].value, value = matrix_new(el, body.rows, body.cols);
  const char *param = el->memo[of].param;
  for (int i = 0; i < matrix_entries(&body); i++) {
    const struct expr *x = body.e[i];
    for (int k = 0; k < order && el->pool.n <= MAX_SCALARS; k++) x = expr_diff(&el->pool, x, param);
    value.e[i] = expr_subst(&el->pool, x, param, arg);
  }
  if (!el->calls) el->calls = ss_malloc(KEPT_CALLS * sizeof *el->calls);
  el->calls[el->next_call] = (struct elab_call){of, order, arg, value};
  el->next_call = (el->next_call + 1) % KEPT_CALLS;
  if (el->n_calls < KEPT_CALLS) el->n_calls++;
  return value;
}

static bool eval_call(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                      struct diag *d) {
  const struct expr *tree = e->args[0];
  struct matrix arg;
  if (!eval(&arg, el, tree, sc, d)) return false;
  if (!matrix_is_scalar(&arg)) return form_mistake(sc, tree, d, "the argument of a function is a scalar", &arg, NULL);
  const struct definition *def;
  if (!look_up(&def, el, e, sc, d)) return false;
  if (!def && !model_is_symbol(el->view.model, e->name)) return undefined(e, sc, d);
  if (def && def->stmt->kind == STMT_TRAJECTORY) {
    *out = matrix_scalar(el, expr_call(&el->pool, e->name, e->order, arg.e[0]));
    return true;
  }
  if (!def || !def->stmt->param) {
    blame_file(d);
    return diag_at(d, sc->src, e->span.begin, "%s is not a function; for a product write %s*(...)", e->name, e->name);
  }
  size_t m;
  if (!define(&m, el, def, d)) return false;
  *out = call_value(el, m, e->order, arg.e[0]);
  return is_small(el, e, sc, d);
}

/* --- Forms that look at their operands' trees --- */

const char *elaboration_root_of(struct elaboration *el, const char *name) {
  for (size_t r = 0; r < el->n_roots; r++)
    for (int k = 0; k < el->roots[r].n_coeff; k++) {
      const struct expr *c = el->roots[r].coeff[k];
      if (strcmp(el->roots[r].name, name) == 0 || expr_subst(&el->pool, c, name, expr_num(&el->pool, "0")) != c)
        return el->roots[r].name;
    }
  return NULL;
}

/* The symbol must be free: a definition has a value of its own, and a root depends on symbols that no derivative here
   sees. */
static const char *small_symbol(struct elaboration *el, const struct expr *e, const struct scope *sc, struct diag *d) {
  struct matrix m;
  if (!eval(&m, el, e, sc, d)) return NULL;
  if (matrix_is_scalar(&m) && m.e[0]->kind == EXPR_SYM && strcmp(m.e[0]->name, expr_pi) != 0) {
    const char *name = m.e[0]->name;
    if (!elaboration_root_of(el, name)) return name;
  }
  form_mistake(sc, e, d, "first_order needs free symbols, of which no root is a function", NULL, NULL);
  return NULL;
}

/* first_order(f; x, y, ...): every symbol once. */
static bool apply_first_order(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                              struct diag *d) {
  int n = e->n_args - 1;
  const char **small = arena_alloc(&el->pool.arena, (size_t)n * sizeof *small);
  for (int s = 0; s < n; s++)
    if (!(small[s] = small_symbol(el, e->args[s + 1], sc, d))) return false;
  for (int s = 0; s < n; s++)
    for (int k = 0; k < s; k++)
      if (strcmp(small[k], small[s]) == 0)
        return form_mistake(sc, e->args[s + 1], d, "the symbol is named twice", NULL, NULL);
  matrix_first_order(m, el, small, n);
  return true;
}

static bool eval_matrix(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  int n = e->rows * e->cols;
  struct matrix *block = arena_alloc(&el->pool.arena, (size_t)n * sizeof *block);
  for (int i = 0; i < n; i++)
    if (!eval(&block[i], el, e->args[i], sc, d)) return false;
  return matrix_of_blocks(out, block, el, e, sc, d);
}

/* --- The walk --- */

/* Forms whose value begins with that of their first operand. */
static bool has_first(const struct expr *e) {
  return e->kind != EXPR_NUM && e->kind != EXPR_SYM && e->kind != EXPR_CALL && e->kind != EXPR_MATRIX;
}

/* Forms of two operands. */
static bool has_second(const struct expr *e) {
  return e->kind == EXPR_ADD || e->kind == EXPR_SUB || e->kind == EXPR_MUL || e->kind == EXPR_DIV ||
         e->kind == EXPR_HYPOT;
}

static bool eval_primary(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                         struct diag *d) {
  switch (e->kind) {
  case EXPR_NUM:
    if (num_parse_decimal(NULL, e->name, strlen(e->name)))
      return form_mistake(sc, e, d, "a number too large to hold; write one of fewer digits", NULL, NULL);
    *out = matrix_scalar(el, expr_num(&el->pool, e->name));
    return true;
  case EXPR_SYM:
    return eval_symbol(out, el, e, sc, d);
  case EXPR_CALL:
    return eval_call(out, el, e, sc, d);
  case EXPR_MATRIX:
    return eval_matrix(out, el, e, sc, d);
  default:
    abort();
  }
}

static bool apply(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                  struct diag *d) {
  struct matrix b;
  if (has_second(e) && !eval(&b, el, e->args[1], sc, d)) return false;
  switch (e->kind) {
  case EXPR_PAREN:
    return true;
  case EXPR_ADD:
  case EXPR_SUB:
    return matrix_sum(m, &b, el, e, sc, d);
  case EXPR_MUL:
    return matrix_product(m, &b, el, e, sc, d);
  case EXPR_DIV:
    return matrix_quotient(m, &b, el, e, sc, d);
  case EXPR_NEG:
  case EXPR_POW:
  case EXPR_SIN:
  case EXPR_COS:
  case EXPR_COT:
  case EXPR_SQRT:
  case EXPR_EXP:
  case EXPR_ABS:
  case EXPR_ROUNDED:
  case EXPR_SINC:
  case EXPR_STUMPFF:
    return matrix_entrywise(m, el, e, sc, d);
  case EXPR_HYPOT:
    return matrix_hypot(m, &b, el, e, sc, d);
  case EXPR_INV:
  case EXPR_DET:
  case EXPR_TR:
    return matrix_square(m, el, e, sc, d);
  case EXPR_TRANSPOSE:
    matrix_transpose(m, el);
    return true;
  case EXPR_INDEX:
    return matrix_index(m, el, e, sc, d);
  case EXPR_FIRST_ORDER:
    return apply_first_order(m, el, e, sc, d);
  default:
    abort();
  }
}

/* First operands are a loop, since sums, products and entries lean to the left and may be as long as a formula; second
   operands, entries, arguments and definitions are recursion, which is bounded. */
static bool eval(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                 struct diag *d) {
  if (el->depth >= MAX_DEPTH) {
    diag_beyond(d);
    return diag_at(d, sc->src, e->span.begin, "definitions and brackets nested more than %d levels deep", MAX_DEPTH);
  }
  FREED const struct expr **left = NULL;
  size_t n = 0, cap = 0;
  for (; has_first(e); e = e->args[0]) *SS_PUSH(left, n, cap) = e;
  el->depth++;
  bool ok = eval_primary(out, el, e, sc, d);
  for (; ok && n > 0; n--) ok = apply(out, el, left[n - 1], sc, d) && is_small(el, left[n - 1], sc, d);
  el->depth--;
  return ok;
}

/* --- Entry points --- */

bool elaborate(struct matrix *out, struct elaboration *el, const struct expr *e, const struct source *src,
               const char *section, struct diag *d) {
  struct scope sc = {.src = src, .section = section};
  return eval(out, el, e, &sc, d);
}

bool elaborate_text(struct matrix *out, struct elaboration *el, const char *called, const char *text,
                    const char *section, struct diag *d) {
  LOCAL(arena, a);
  OWNED(source) src;
  source_from_string(&src, called, text);
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, d);
  return e && elaborate(out, el, e, &src, section, d);
}

bool elaborate_sides(struct matrix *lhs, struct matrix *rhs, struct elaboration *el, const struct stmt *s, int k,
                     const struct source *src, const char *section, struct diag *d) {
  if (!elaborate(lhs, el, s->sides[k], src, section, d) || !elaborate(rhs, el, s->sides[k + 1], src, section, d))
    return false;
  matrix_shape_zero(lhs, rhs, el, s->sides[k], s->sides[k + 1]);
  if (matrix_same_shape(lhs, rhs)) return true;
  return diag_at(d, src, s->sides[k]->span.begin, "the two sides have the shapes %dx%d and %dx%d", lhs->rows, lhs->cols,
                 rhs->rows, rhs->cols);
}

/* The ends of the range that a statement is about. */
static bool check_range(struct elaboration *el, const struct stmt *s, const struct source *src, const char *section,
                        struct diag *d) {
  const struct expr *ends[] = {s->range_lo, s->range_hi};
  struct scope sc = {.src = src};
  for (int i = 0; i < 2; i++) {
    struct matrix m;
    if (!ends[i]) continue;
    if (!elaborate(&m, el, ends[i], src, section, d)) return false;
    if (!matrix_is_scalar(&m)) return form_mistake(&sc, ends[i], d, "the end of a range is a scalar", &m, NULL);
  }
  return true;
}

bool relation_check(struct elaboration *el, const struct stmt *s, const struct source *src, const char *section,
                    struct diag *d) {
  bool ok = true;
  const struct expr *matrix = NULL; /* that is said to be less or greater */
  for (int k = 0; ok && k + 1 < s->n_sides; k++) {
    struct matrix a, b;
    ok = elaborate_sides(&a, &b, el, s, k, src, section, d);
    if (ok && s->ops[k] != REL_EQ && a.rows * a.cols != 1) matrix = s->sides[k];
  }
  ok = ok && check_range(el, s, src, section, d);
  return ok && (!matrix || diag_at(d, src, matrix->span.begin, "an inequality needs scalars"));
}

size_t elaboration_n_used(const struct elaboration *el) {
  return el->n_memo;
}

const struct definition *elaboration_used(const struct elaboration *el, size_t i) {
  return el->memo[i].def;
}

bool elaboration_tape(struct tape *t, const struct elaboration *el, const struct expr *const *outputs, slong n,
                      struct diag *d) {
  return tape_build(t, outputs, n, el->roots, el->n_roots, d);
}

bool elaborate_tape(struct tape *t, struct matrix *out, struct elaboration *el, const char *called, const char *text,
                    const char *section, struct diag *d) {
  *t = (struct tape){.n = 0};
  return elaborate_text(out, el, called, text, section, d) && elaboration_tape(t, el, out->e, out->rows * out->cols, d);
}

bool view_check(struct view v, struct diag *d) {
  OWNED(elaboration) el;
  elaboration_init(&el, v, NULL, 0);
  bool ok = true;
  for (size_t i = 0; ok && i < v.model->n_defs; i++) {
    const struct definition *def = &v.model->defs[i];
    size_t at;
    if (def->stmt->kind != STMT_TRAJECTORY && view_sees(&v, def)) ok = define(&at, &el, def, d);
  }
  for (size_t i = 0; ok && i < v.model->n_records; i++) {
    const struct statement_record *r = &v.model->records[i];
    if (view_record(&v, r->id) != r) continue;
    for (int k = 0; ok && k < r->n_stmts; k++)
      if (r->stmts[k]->kind == STMT_RELATION) ok = relation_check(&el, r->stmts[k], r->src, r->section, d);
  }
  return ok;
}
