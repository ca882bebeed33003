/* From trees to matrices of shared scalars: names replaced by what they stand for, functions applied, derivatives
   taken, matrices multiplied out.  Nothing is folded, so that an undefined subexpression stays undefined. */
#include <stdlib.h>
#include <string.h>

#include "stickslip/model.h"
#include "stickslip/num.h"

/* MAX_DEPTH bounds the recursion over brackets, calls and definitions together, MAX_SCALARS the memory (the paper
   with all its statements has a few thousand). */
enum {
  MAX_DEPTH = 1000,
  MAX_SCALARS = 500000,
  MAX_INVERSE = 4,
  MAX_ENTRIES = 4096,
  MAX_DEGREE = 32,
  MAX_POLY_STEPS = 100000
};

/* What a definition elaborated to.  A function's value holds its parameter as the symbol `param`. */
struct elab_memo {
  const struct definition *def; /* NULL: it failed, and the next use reports the same mistake again */
  bool done;
  struct matrix value;
  const char *param;
};

/* Where an expression is seen from. */
struct scope {
  const struct source *src;
  const char *section;
  const char *param;        /* the formal parameter of the function being elaborated, or NULL */
  const char *param_symbol; /* the symbol that stands for it */
  const char *unknown;      /* the name that a root's own polynomial is about, or NULL */
  const char *unknown_symbol;
};

void elaboration_init(struct elaboration *el, struct view view, const struct override *overrides, int n_overrides) {
  *el = (struct elaboration){.view = view, .overrides = overrides, .n_overrides = n_overrides};
  expr_pool_init(&el->pool);
}

void elaboration_clear(struct elaboration *el) {
  free(el->roots);
  free(el->memo);
  free(el->calls);
  expr_pool_clear(&el->pool);
}

static bool eval(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                 struct diag *d);

static struct matrix matrix_new(struct elaboration *el, int rows, int cols) {
  size_t n = (size_t)rows * (size_t)cols;
  return (struct matrix){rows, cols, arena_alloc(&el->pool.arena, n * sizeof(struct expr *))};
}

static struct matrix scalar(struct elaboration *el, const struct expr *e) {
  struct matrix m = matrix_new(el, 1, 1);
  m.e[0] = e;
  return m;
}

static const struct expr *at(const struct matrix *m, int i, int j) {
  return m->e[i * m->cols + j];
}
static int entries(const struct matrix *m) {
  return m->rows * m->cols;
}
static bool is_scalar(const struct matrix *m) {
  return m->rows == 1 && m->cols == 1;
}
static bool same_shape(const struct matrix *a, const struct matrix *b) {
  return a->rows == b->rows && a->cols == b->cols;
}

/* The literal 0 as written: it takes whatever shape its neighbours have. */
static bool is_zero_literal(const struct expr *e) {
  while (e->kind == EXPR_PAREN) e = e->args[0];
  return e->kind == EXPR_NUM && strcmp(e->name, "0") == 0;
}

static struct matrix zeros(struct elaboration *el, int rows, int cols) {
  struct matrix m = matrix_new(el, rows, cols);
  for (int i = 0; i < rows * cols; i++) m.e[i] = expr_num(&el->pool, "0");
  return m;
}

static bool fail(const struct scope *sc, const struct expr *e, struct diag *d, const char *what, const struct matrix *a,
                 const struct matrix *b) {
  if (b)
    diag_at(d, sc->src, e->span.begin, "%s: the shapes are %dx%d and %dx%d", what, a->rows, a->cols, b->rows, b->cols);
  else if (a)
    diag_at(d, sc->src, e->span.begin, "%s: the shape is %dx%d", what, a->rows, a->cols);
  else
    diag_at(d, sc->src, e->span.begin, "%s", what);
  return false;
}

static bool is_small(const struct elaboration *el, const struct expr *e, const struct scope *sc, struct diag *d) {
  if (el->pool.n <= MAX_SCALARS) return true;
  diag_at(d, sc->src, e->span.begin, "a formula of more than %d scalars when its definitions are put in", MAX_SCALARS);
  return false;
}

/* --- Names --- */

static const struct override *find_override(const struct elaboration *el, const char *name) {
  for (int i = 0; i < el->n_overrides; i++)
    if (strcmp(el->overrides[i].name, name) == 0) return &el->overrides[i];
  return NULL;
}

static struct matrix override_value(struct elaboration *el, const struct override *o) {
  struct matrix m = matrix_new(el, o->rows, o->cols);
  struct text t;
  text_init(&t);
  for (int i = 0; i < o->rows; i++)
    for (int j = 0; j < o->cols; j++) {
      text_reset(&t);
      text_printf(&t, "%s[%d,%d]", o->name, i + 1, j + 1);
      m.e[i * o->cols + j] = expr_sym(&el->pool, t.data);
    }
  text_clear(&t);
  return m;
}

static bool add_root(struct elaboration *el, const struct definition *def, const char *symbol, const struct expr *poly,
                     struct diag *d);

/* The symbol that stands for a root: its name, with the section where another section has a root of that name too. */
static const char *root_symbol(struct elaboration *el, const struct definition *def) {
  const struct model *m = el->view.model;
  bool shared = false;
  for (size_t i = 0; i < m->n_defs; i++) {
    const struct definition *o = &m->defs[i];
    shared = shared || (o->stmt->kind == STMT_ROOT && strcmp(o->name, def->name) == 0 &&
                        strcmp(o->section, def->section) != 0 && view_sees(&el->view, o));
  }
  struct text t;
  text_init(&t);
  text_printf(&t, shared ? "%s@%s" : "%s", def->name, def->section);
  const char *symbol = arena_strndup(&el->pool.arena, t.data, t.len);
  text_clear(&t);
  return symbol;
}

/* Both places that name a symbol of their own, a function's parameter and a root's unknown. */
static struct scope scope_inside(struct elaboration *el, const struct definition *def) {
  struct scope sc = {.src = def->src, .section = def->section};
  if (def->stmt->kind == STMT_ROOT) {
    sc.unknown = def->name;
    sc.unknown_symbol = root_symbol(el, def);
  } else if (def->stmt->param) {
    struct text t;
    text_init(&t);
    text_printf(&t, "%s@%s", def->stmt->param, def->name);
    sc.param = def->stmt->param;
    sc.param_symbol = arena_strndup(&el->pool.arena, t.data, t.len);
    text_clear(&t);
  }
  return sc;
}

static bool definition_value(struct matrix *out, struct elaboration *el, const struct definition *def,
                             const struct scope *sc, struct diag *d) {
  const struct expr *body = def->stmt->sides[0];
  if (!eval(out, el, body, sc, d)) return false;
  if (def->stmt->kind != STMT_ROOT) return true;
  if (!is_scalar(out)) return fail(sc, body, d, "a root needs a scalar polynomial", out, NULL);
  if (!add_root(el, def, sc->unknown_symbol, out->e[0], d)) return false;
  *out = scalar(el, expr_sym(&el->pool, sc->unknown_symbol));
  return true;
}

/* The memo entry of a definition, elaborated on first use.  Indices stay valid while the array grows. */
static bool define(size_t *index, struct elaboration *el, const struct definition *def, struct diag *d) {
  for (size_t i = 0; i < el->n_memo; i++)
    if (el->memo[i].def == def) {
      *index = i;
      if (el->memo[i].done) return true;
      diag_at(d, def->src, def->stmt->span.begin, "%s is defined through itself", def->name);
      return false;
    }
  struct scope sc = scope_inside(el, def);
  el->memo = ss_grow(el->memo, el->n_memo, &el->cap_memo, sizeof *el->memo);
  *index = el->n_memo++;
  el->memo[*index] = (struct elab_memo){.def = def, .param = sc.param_symbol};
  struct matrix value;
  bool ok = definition_value(&value, el, def, &sc, d);
  if (ok)
    el->memo[*index].value = value;
  else
    el->memo[*index].def = NULL;
  el->memo[*index].done = ok;
  return ok;
}

static bool undefined(const struct expr *e, const struct scope *sc, struct diag *d) {
  diag_at(d, sc->src, e->span.begin, "undefined symbol %s; define it or declare \"symbol %s\"", e->name, e->name);
  return false;
}

static bool eval_symbol(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  if (sc->param && strcmp(e->name, sc->param) == 0) {
    *out = scalar(el, expr_sym(&el->pool, sc->param_symbol));
    return true;
  }
  if (sc->unknown && strcmp(e->name, sc->unknown) == 0) {
    *out = scalar(el, expr_sym(&el->pool, sc->unknown_symbol));
    return true;
  }
  const struct override *o = find_override(el, e->name);
  if (o) {
    *out = override_value(el, o);
    return true;
  }
  struct diag ambiguous;
  diag_init(&ambiguous);
  const struct definition *def = view_lookup(&el->view, e->name, sc->section, &ambiguous);
  if (ambiguous.set) {
    diag_at(d, sc->src, e->span.begin, "%s", ambiguous.message);
    return false;
  }
  if (!def) {
    if (!model_is_symbol(el->view.model, e->name)) return undefined(e, sc, d);
    *out = scalar(el, expr_sym(&el->pool, e->name));
    return true;
  }
  if (def->stmt->kind == STMT_TRAJECTORY || def->stmt->param) {
    diag_at(d, sc->src, e->span.begin, "%s is a function; write %s(...)", e->name, e->name);
    return false;
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
  for (int i = 0; i < entries(&body); i++) {
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
  if (!is_scalar(&arg)) return fail(sc, tree, d, "the argument of a function is a scalar", &arg, NULL);
  struct diag ambiguous;
  diag_init(&ambiguous);
  const struct definition *def = view_lookup(&el->view, e->name, sc->section, &ambiguous);
  if (ambiguous.set) {
    diag_at(d, sc->src, e->span.begin, "%s", ambiguous.message);
    return false;
  }
  if (!def) return undefined(e, sc, d);
  if (def->stmt->kind == STMT_TRAJECTORY) {
    *out = scalar(el, expr_call(&el->pool, e->name, e->order, arg.e[0]));
    return true;
  }
  if (!def->stmt->param) {
    diag_at(d, sc->src, e->span.begin, "%s is not a function; for a product write %s*(...)", e->name, e->name);
    return false;
  }
  size_t m;
  if (!define(&m, el, def, d)) return false;
  *out = call_value(el, m, e->order, arg.e[0]);
  return is_small(el, e, sc, d);
}

/* --- Matrix algebra: m is the value of the first operand and becomes that of the form --- */

/* Gives a literal zero on one side the shape of the other. */
static void shape_zero(struct matrix *a, struct matrix *b, struct elaboration *el, const struct expr *ta,
                       const struct expr *tb) {
  if (is_zero_literal(ta) && !is_scalar(b))
    *a = zeros(el, b->rows, b->cols);
  else if (is_zero_literal(tb) && !is_scalar(a))
    *b = zeros(el, a->rows, a->cols);
}

static bool apply_sum(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                      struct diag *d) {
  struct matrix a = *m, b;
  if (!eval(&b, el, e->args[1], sc, d)) return false;
  shape_zero(&a, &b, el, e->args[0], e->args[1]);
  if (!same_shape(&a, &b)) return fail(sc, e, d, "a sum of different shapes", &a, &b);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < entries(&a); i++) m->e[i] = expr_op2(&el->pool, e->kind, a.e[i], b.e[i]);
  return true;
}

static const struct expr *dot(struct elaboration *el, const struct matrix *a, const struct matrix *b, int i, int j) {
  const struct expr *sum = NULL;
  for (int k = 0; k < a->cols; k++) {
    const struct expr *term = expr_op2(&el->pool, EXPR_MUL, at(a, i, k), at(b, k, j));
    sum = sum ? expr_op2(&el->pool, EXPR_ADD, sum, term) : term;
  }
  return sum;
}

static bool apply_product(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                          struct diag *d) {
  struct matrix a = *m, b;
  if (!eval(&b, el, e->args[1], sc, d)) return false;
  if (a.cols == b.rows && !(is_scalar(&a) && is_scalar(&b))) {
    if (a.rows > MAX_ENTRIES / b.cols) return fail(sc, e, d, "a matrix of more than 4096 entries", &a, &b);
    *m = matrix_new(el, a.rows, b.cols);
    for (int i = 0; i < a.rows; i++)
      for (int j = 0; j < b.cols; j++) m->e[i * b.cols + j] = dot(el, &a, &b, i, j);
    return true;
  }
  if (!is_scalar(&a) && !is_scalar(&b)) return fail(sc, e, d, "a product of shapes that do not fit", &a, &b);
  const struct matrix *big = is_scalar(&a) ? &b : &a;
  *m = matrix_new(el, big->rows, big->cols);
  for (int i = 0; i < entries(big); i++)
    m->e[i] = expr_op2(&el->pool, EXPR_MUL, a.e[is_scalar(&a) ? 0 : i], b.e[is_scalar(&b) ? 0 : i]);
  return true;
}

static bool apply_quotient(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                           struct diag *d) {
  struct matrix a = *m, b;
  if (!eval(&b, el, e->args[1], sc, d)) return false;
  if (!is_scalar(&b)) return fail(sc, e, d, "the divisor is a matrix; use inv(...)", &b, NULL);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < entries(&a); i++) m->e[i] = expr_op2(&el->pool, EXPR_DIV, a.e[i], b.e[0]);
  return true;
}

static struct matrix without(struct elaboration *el, const struct matrix *m, int row, int col) {
  struct matrix r = matrix_new(el, m->rows - 1, m->cols - 1);
  int k = 0;
  for (int i = 0; i < m->rows; i++)
    for (int j = 0; j < m->cols; j++)
      if (i != row && j != col) r.e[k++] = at(m, i, j);
  return r;
}

static const struct expr *determinant(struct elaboration *el, const struct matrix *m) {
  if (m->rows == 1) return m->e[0];
  const struct expr *sum = NULL;
  for (int j = 0; j < m->cols; j++) {
    struct matrix minor = without(el, m, 0, j);
    const struct expr *term = expr_op2(&el->pool, EXPR_MUL, at(m, 0, j), determinant(el, &minor));
    sum = sum ? expr_op2(&el->pool, j % 2 ? EXPR_SUB : EXPR_ADD, sum, term) : term;
  }
  return sum;
}

static struct matrix inverse(struct elaboration *el, const struct matrix *m) {
  const struct expr *det = determinant(el, m);
  int n = m->rows;
  struct matrix r = matrix_new(el, n, n);
  if (n == 1) {
    r.e[0] = expr_op2(&el->pool, EXPR_DIV, expr_num(&el->pool, "1"), det);
    return r;
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      struct matrix minor = without(el, m, j, i);
      const struct expr *c = determinant(el, &minor);
      if ((i + j) % 2) c = expr_op1(&el->pool, EXPR_NEG, c);
      r.e[i * n + j] = expr_op2(&el->pool, EXPR_DIV, c, det);
    }
  return r;
}

static bool apply_square(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                         struct diag *d) {
  struct matrix a = *m;
  if (a.rows != a.cols) return fail(sc, e, d, "a square matrix is needed", &a, NULL);
  if (e->kind == EXPR_TR) {
    const struct expr *sum = a.e[0];
    for (int i = 1; i < a.rows; i++) sum = expr_op2(&el->pool, EXPR_ADD, sum, at(&a, i, i));
    *m = scalar(el, sum);
    return true;
  }
  if (a.rows > MAX_INVERSE) return fail(sc, e, d, "inv and det reach up to 4x4", &a, NULL);
  *m = e->kind == EXPR_DET ? scalar(el, determinant(el, &a)) : inverse(el, &a);
  return true;
}

static bool apply_transpose(struct matrix *m, struct elaboration *el) {
  struct matrix a = *m;
  *m = matrix_new(el, a.cols, a.rows);
  for (int i = 0; i < a.rows; i++)
    for (int j = 0; j < a.cols; j++) m->e[j * a.rows + i] = at(&a, i, j);
  return true;
}

static bool apply_index(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  struct matrix a = *m;
  int r0 = e->index[0], r1 = e->index[1], c0 = e->index[2], c1 = e->index[3];
  if (e->n_index == 1) {
    if (a.rows != 1 && a.cols != 1) return fail(sc, e, d, "a matrix needs two indices", &a, NULL);
    if (a.rows == 1) {
      c0 = r0, c1 = r1;
      r0 = r1 = 1;
    } else {
      c0 = c1 = 1;
    }
  }
  if (r0 < 1 || c0 < 1 || r1 < r0 || c1 < c0 || r1 > a.rows || c1 > a.cols)
    return fail(sc, e, d, "an index out of range", &a, NULL);
  *m = matrix_new(el, r1 - r0 + 1, c1 - c0 + 1);
  int k = 0;
  for (int i = r0; i <= r1; i++)
    for (int j = c0; j <= c1; j++) m->e[k++] = at(&a, i - 1, j - 1);
  return true;
}

static bool apply_entrywise(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                            struct diag *d) {
  struct matrix a = *m;
  if (e->kind != EXPR_NEG && e->kind != EXPR_ROUNDED && !is_scalar(&a))
    return fail(sc, e, d, "a scalar is needed here", &a, NULL);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < entries(&a); i++)
    m->e[i] = e->kind == EXPR_POW ? expr_pow(&el->pool, a.e[i], e->exponent) : expr_op1(&el->pool, e->kind, a.e[i]);
  return true;
}

static bool apply_hypot(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  struct matrix b;
  if (!eval(&b, el, e->args[1], sc, d)) return false;
  if (!is_scalar(m) || !is_scalar(&b)) return fail(sc, e, d, "two scalars are needed here", m, &b);
  *m = scalar(el, expr_op2(&el->pool, EXPR_HYPOT, m->e[0], b.e[0]));
  return true;
}

/* The symbol must be free: a definition has a value of its own, and a root depends on symbols that no derivative here
   sees. */
static const char *small_symbol(struct elaboration *el, const struct expr *e, const struct scope *sc, struct diag *d) {
  struct matrix m;
  if (!eval(&m, el, e, sc, d)) return NULL;
  if (is_scalar(&m) && m.e[0]->kind == EXPR_SYM) {
    const char *name = m.e[0]->name;
    bool inside = false;
    for (size_t r = 0; r < el->n_roots; r++)
      for (int k = 0; k < el->roots[r].n_coeff; k++) {
        const struct expr *c = el->roots[r].coeff[k];
        inside = inside || strcmp(el->roots[r].name, name) == 0 ||
                 expr_subst(&el->pool, c, name, expr_num(&el->pool, "0")) != c;
      }
    if (!inside) return name;
  }
  fail(sc, e, d, "first_order needs free symbols, of which no root is a function", NULL, NULL);
  return NULL;
}

/* f(0) + the sum of s f_s(0) over the small symbols s. */
static bool apply_first_order(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                              struct diag *d) {
  int n = e->n_args - 1;
  struct expr_pool *pool = &el->pool;
  struct matrix a = *m;
  const char **small = arena_alloc(&pool->arena, (size_t)n * sizeof *small);
  for (int s = 0; s < n; s++)
    if (!(small[s] = small_symbol(el, e->args[s + 1], sc, d))) return false;
  for (int s = 0; s < n; s++)
    for (int k = 0; k < s; k++)
      if (strcmp(small[k], small[s]) == 0) return fail(sc, e->args[s + 1], d, "the symbol is named twice", NULL, NULL);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < entries(&a); i++)
    for (int s = -1; s < n && el->pool.n <= MAX_SCALARS; s++) {
      const struct expr *x = s < 0 ? a.e[i] : expr_diff(pool, a.e[i], small[s]);
      for (int k = 0; k < n; k++) x = expr_subst(pool, x, small[k], expr_num(pool, "0"));
      if (s >= 0) x = expr_op2(pool, EXPR_ADD, m->e[i], expr_op2(pool, EXPR_MUL, x, expr_sym(pool, small[s])));
      m->e[i] = x;
    }
  return true;
}

/* Heights of block rows and widths of block columns; literal zeros fit anything. */
static bool block_shape(int *height, int *width, const struct matrix *block, const struct expr *e,
                        const struct scope *sc, struct diag *d) {
  for (int i = 0; i < e->rows; i++)
    for (int j = 0; j < e->cols; j++) {
      const struct matrix *b = &block[i * e->cols + j];
      const struct expr *tree = e->args[i * e->cols + j];
      if (is_zero_literal(tree)) continue;
      if ((height[i] && height[i] != b->rows) || (width[j] && width[j] != b->cols))
        return fail(sc, tree, d, "a block that does not fit its row or column", b, NULL);
      height[i] = b->rows;
      width[j] = b->cols;
    }
  for (int i = 0; i < e->rows; i++)
    if (!height[i]) height[i] = 1;
  for (int j = 0; j < e->cols; j++)
    if (!width[j]) width[j] = 1;
  return true;
}

static bool eval_matrix(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                        struct diag *d) {
  int n = e->rows * e->cols;
  struct matrix *block = arena_alloc(&el->pool.arena, (size_t)n * sizeof *block);
  int *height = arena_alloc(&el->pool.arena, (size_t)e->rows * sizeof *height);
  int *width = arena_alloc(&el->pool.arena, (size_t)e->cols * sizeof *width);
  for (int i = 0; i < n; i++)
    if (!eval(&block[i], el, e->args[i], sc, d)) return false;
  if (!block_shape(height, width, block, e, sc, d)) return false;
  int rows = 0, cols = 0;
  for (int i = 0; i < e->rows; i++) rows += height[i];
  for (int j = 0; j < e->cols; j++) cols += width[j];
  if ((long)rows * cols > MAX_ENTRIES) return fail(sc, e, d, "a matrix of more than 4096 entries", NULL, NULL);
  *out = zeros(el, rows, cols);
  int top = 0;
  for (int i = 0; i < e->rows; top += height[i++]) {
    int left = 0;
    for (int j = 0; j < e->cols; left += width[j++]) {
      const struct matrix *b = &block[i * e->cols + j];
      if (is_zero_literal(e->args[i * e->cols + j])) continue;
      for (int k = 0; k < b->rows; k++)
        for (int l = 0; l < b->cols; l++) out->e[(top + k) * cols + left + l] = at(b, k, l);
    }
  }
  return true;
}

/* --- The walk --- */

/* Forms whose value begins with that of their first operand. */
static bool has_first(const struct expr *e) {
  return e->kind != EXPR_NUM && e->kind != EXPR_SYM && e->kind != EXPR_CALL && e->kind != EXPR_MATRIX;
}

static bool eval_primary(struct matrix *out, struct elaboration *el, const struct expr *e, const struct scope *sc,
                         struct diag *d) {
  switch (e->kind) {
  case EXPR_NUM:
    if (num_check_decimal(e->name, strlen(e->name)))
      return fail(sc, e, d, "a number too large to hold; write one of fewer digits", NULL, NULL);
    *out = scalar(el, expr_num(&el->pool, e->name));
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
  switch (e->kind) {
  case EXPR_PAREN:
    return true;
  case EXPR_ADD:
  case EXPR_SUB:
    return apply_sum(m, el, e, sc, d);
  case EXPR_MUL:
    return apply_product(m, el, e, sc, d);
  case EXPR_DIV:
    return apply_quotient(m, el, e, sc, d);
  case EXPR_NEG:
  case EXPR_POW:
  case EXPR_SIN:
  case EXPR_COS:
  case EXPR_COT:
  case EXPR_SQRT:
  case EXPR_ABS:
  case EXPR_ROUNDED:
  case EXPR_SINC:
  case EXPR_STUMPFF:
    return apply_entrywise(m, el, e, sc, d);
  case EXPR_HYPOT:
    return apply_hypot(m, el, e, sc, d);
  case EXPR_INV:
  case EXPR_DET:
  case EXPR_TR:
    return apply_square(m, el, e, sc, d);
  case EXPR_TRANSPOSE:
    return apply_transpose(m, el);
  case EXPR_INDEX:
    return apply_index(m, el, e, sc, d);
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
    diag_at(d, sc->src, e->span.begin, "definitions and brackets nested more than %d levels deep", MAX_DEPTH);
    return false;
  }
  const struct expr **left = NULL;
  size_t n = 0, cap = 0;
  for (; has_first(e); e = e->args[0]) {
    left = ss_grow(left, n, &cap, sizeof *left);
    left[n++] = e;
  }
  el->depth++;
  bool ok = eval_primary(out, el, e, sc, d);
  for (; ok && n > 0; n--) ok = apply(out, el, left[n - 1], sc, d) && is_small(el, left[n - 1], sc, d);
  el->depth--;
  free(left);
  return ok;
}

/* --- Roots: the coefficients of a polynomial in one symbol --- */

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
  const struct expr **left = NULL;
  size_t n = 0, cap = 0;
  for (; e->n_args > 0; e = e->args[0]) {
    left = ss_grow(left, n, &cap, sizeof *left);
    left[n++] = e;
  }
  bool unknown = e->kind == EXPR_SYM && strcmp(e->name, job->unknown) == 0;
  *out = (struct poly){.degree = unknown};
  out->c[unknown] = unknown ? expr_num(&job->el->pool, "1") : e;
  job->depth++;
  bool ok = within_limits(job);
  for (; ok && n > 0; n--, job->steps++) ok = poly_apply(out, job, left[n - 1]) && within_limits(job);
  job->depth--;
  free(left);
  return ok;
}

static bool add_root(struct elaboration *el, const struct definition *def, const char *symbol, const struct expr *poly,
                     struct diag *d) {
  struct poly_job job = {.el = el, .unknown = symbol};
  struct poly p;
  if (!to_poly(&p, &job, poly) || p.degree < 1) {
    size_t where = def->stmt->sides[0]->span.begin;
    if (job.too_large)
      diag_at(d, def->src, where, "the polynomial in %s is too large", def->name);
    else
      diag_at(d, def->src, where, "not a polynomial in %s of degree 1 to %d", def->name, MAX_DEGREE);
    return false;
  }
  struct tape_root r = {symbol, arena_alloc(&el->pool.arena, (size_t)(p.degree + 1) * sizeof(struct expr *)),
                        p.degree + 1, def->stmt->largest};
  for (int k = 0; k <= p.degree; k++) r.coeff[k] = p.c[k] ? p.c[k] : expr_num(&el->pool, "0");
  el->roots = ss_grow(el->roots, el->n_roots, &el->cap_roots, sizeof *el->roots);
  el->roots[el->n_roots++] = r;
  return true;
}

/* --- Entry points --- */

bool elaborate(struct matrix *out, struct elaboration *el, const struct expr *e, const struct source *src,
               const char *section, struct diag *d) {
  struct scope sc = {.src = src, .section = section};
  return eval(out, el, e, &sc, d);
}

bool elaborate_name(struct matrix *out, struct elaboration *el, const char *name, const char *section, struct diag *d) {
  const struct definition *def = view_lookup(&el->view, name, section, d);
  if (!def) {
    diag_set(d, "undefined symbol %s", name);
    return false;
  }
  size_t i;
  if (def->stmt->kind == STMT_TRAJECTORY || def->stmt->param) {
    diag_set(d, "%s is a function and needs an argument", name);
    return false;
  }
  if (!define(&i, el, def, d)) return false;
  *out = el->memo[i].value;
  return true;
}

bool elaborate_sides(struct matrix *lhs, struct matrix *rhs, struct elaboration *el, const struct stmt *s, int k,
                     const struct source *src, const char *section, struct diag *d) {
  if (!elaborate(lhs, el, s->sides[k], src, section, d) || !elaborate(rhs, el, s->sides[k + 1], src, section, d))
    return false;
  shape_zero(lhs, rhs, el, s->sides[k], s->sides[k + 1]);
  if (same_shape(lhs, rhs)) return true;
  diag_at(d, src, s->sides[k]->span.begin, "the two sides have the shapes %dx%d and %dx%d", lhs->rows, lhs->cols,
          rhs->rows, rhs->cols);
  return false;
}

/* The ends of the range that a statement is about. */
static bool check_range(struct elaboration *el, const struct stmt *s, const struct statement_record *r,
                        struct diag *d) {
  const struct expr *ends[] = {s->range_lo, s->range_hi};
  struct scope sc = {.src = r->src};
  for (int i = 0; i < 2; i++) {
    struct matrix m;
    if (!ends[i]) continue;
    if (!elaborate(&m, el, ends[i], r->src, r->section, d)) return false;
    if (!is_scalar(&m)) return fail(&sc, ends[i], d, "the end of a range is a scalar", &m, NULL);
  }
  return true;
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

bool view_check(struct view v, struct diag *d) {
  struct elaboration el;
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
    for (int k = 0; ok && k < r->n_stmts; k++) {
      if (r->stmts[k]->kind != STMT_RELATION) continue;
      for (int e = 0; ok && e + 1 < r->stmts[k]->n_sides; e++) {
        struct matrix a, b;
        ok = elaborate_sides(&a, &b, &el, r->stmts[k], e, r->src, r->section, d);
      }
      ok = ok && check_range(&el, r->stmts[k], r, d);
    }
  }
  elaboration_clear(&el);
  return ok;
}
