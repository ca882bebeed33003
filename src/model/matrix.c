/* Matrices of shared scalars: the operations that the notation has for them.  Sums, products, determinants and inverses
   are multiplied out into the scalars of their entries and nothing is folded; a shape that does not fit is the user's
   mistake and is named with its place. */
#include <string.h>

#include "elaborate_impl.h"

enum { MAX_INVERSE = 4, MAX_ENTRIES = 4096 };

bool form_mistake(const struct scope *sc, const struct expr *e, struct diag *d, const char *what,
                  const struct matrix *a, const struct matrix *b) {
  if (b)
    return diag_at(d, sc->src, e->span.begin, "%s: the shapes are %dx%d and %dx%d", what, a->rows, a->cols, b->rows,
                   b->cols);
  if (a) return diag_at(d, sc->src, e->span.begin, "%s: the shape is %dx%d", what, a->rows, a->cols);
  return diag_at(d, sc->src, e->span.begin, "%s", what);
}

/* The same of what has a meaning, but none that is read here. */
static bool form_beyond(const struct scope *sc, const struct expr *e, struct diag *d, const char *what,
                        const struct matrix *a, const struct matrix *b) {
  diag_beyond(d);
  return form_mistake(sc, e, d, what, a, b);
}

struct matrix matrix_new(struct elaboration *el, int rows, int cols) {
  size_t n = (size_t)rows * (size_t)cols;
  return (struct matrix){rows, cols, arena_alloc(&el->pool.arena, n * sizeof(struct expr *))};
}

struct matrix matrix_scalar(struct elaboration *el, const struct expr *e) {
  struct matrix m = matrix_new(el, 1, 1);
  m.e[0] = e;
  return m;
}

static struct matrix matrix_zeros(struct elaboration *el, int rows, int cols) {
  struct matrix m = matrix_new(el, rows, cols);
  for (int i = 0; i < rows * cols; i++) m.e[i] = expr_num(&el->pool, "0");
  return m;
}

/* Gives a literal zero on one side the shape of the other: as written it has none of its own. */
void matrix_shape_zero(struct matrix *a, struct matrix *b, struct elaboration *el, const struct expr *ta,
                       const struct expr *tb) {
  if (expr_is_zero(ta) && !matrix_is_scalar(b))
    *a = matrix_zeros(el, b->rows, b->cols);
  else if (expr_is_zero(tb) && !matrix_is_scalar(a))
    *b = matrix_zeros(el, a->rows, a->cols);
}

bool matrix_sum(struct matrix *m, const struct matrix *second, struct elaboration *el, const struct expr *e,
                const struct scope *sc, struct diag *d) {
  struct matrix a = *m, b = *second;
  matrix_shape_zero(&a, &b, el, e->args[0], e->args[1]);
  if (!matrix_same_shape(&a, &b)) return form_mistake(sc, e, d, "a sum of different shapes", &a, &b);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < matrix_entries(&a); i++) m->e[i] = expr_op2(&el->pool, e->kind, a.e[i], b.e[i]);
  return true;
}

static const struct expr *dot(struct elaboration *el, const struct matrix *a, const struct matrix *b, int i, int j) {
  const struct expr *sum = NULL;
  for (int k = 0; k < a->cols; k++) {
    const struct expr *term = expr_op2(&el->pool, EXPR_MUL, matrix_at(a, i, k), matrix_at(b, k, j));
    sum = sum ? expr_op2(&el->pool, EXPR_ADD, sum, term) : term;
  }
  return sum;
}

bool matrix_product(struct matrix *m, const struct matrix *second, struct elaboration *el, const struct expr *e,
                    const struct scope *sc, struct diag *d) {
  struct matrix a = *m, b = *second;
  if (a.cols == b.rows && !(matrix_is_scalar(&a) && matrix_is_scalar(&b))) {
    if (a.rows > MAX_ENTRIES / b.cols) return form_beyond(sc, e, d, "a matrix of more than 4096 entries", &a, &b);
    *m = matrix_new(el, a.rows, b.cols);
    for (int i = 0; i < a.rows; i++)
      for (int j = 0; j < b.cols; j++) m->e[i * b.cols + j] = dot(el, &a, &b, i, j);
    return true;
  }
  if (!matrix_is_scalar(&a) && !matrix_is_scalar(&b))
    return form_mistake(sc, e, d, "a product of shapes that do not fit", &a, &b);
  const struct matrix *big = matrix_is_scalar(&a) ? &b : &a;
  *m = matrix_new(el, big->rows, big->cols);
  for (int i = 0; i < matrix_entries(big); i++)
    m->e[i] = expr_op2(&el->pool, EXPR_MUL, a.e[matrix_is_scalar(&a) ? 0 : i], b.e[matrix_is_scalar(&b) ? 0 : i]);
  return true;
}

bool matrix_quotient(struct matrix *m, const struct matrix *second, struct elaboration *el, const struct expr *e,
                     const struct scope *sc, struct diag *d) {
  struct matrix a = *m, b = *second;
  if (!matrix_is_scalar(&b)) return form_mistake(sc, e, d, "the divisor is a matrix; use inv(...)", &b, NULL);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < matrix_entries(&a); i++) m->e[i] = expr_op2(&el->pool, EXPR_DIV, a.e[i], b.e[0]);
  return true;
}

static struct matrix without(struct elaboration *el, const struct matrix *m, int row, int col) {
  struct matrix r = matrix_new(el, m->rows - 1, m->cols - 1);
  int k = 0;
  for (int i = 0; i < m->rows; i++)
    for (int j = 0; j < m->cols; j++)
      if (i != row && j != col) r.e[k++] = matrix_at(m, i, j);
  return r;
}

static const struct expr *determinant(struct elaboration *el, const struct matrix *m) {
  if (m->rows == 1) return m->e[0];
  const struct expr *sum = NULL;
  for (int j = 0; j < m->cols; j++) {
    struct matrix minor = without(el, m, 0, j);
    const struct expr *term = expr_op2(&el->pool, EXPR_MUL, matrix_at(m, 0, j), determinant(el, &minor));
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

bool matrix_square(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                   struct diag *d) {
  struct matrix a = *m;
  if (a.rows != a.cols) return form_mistake(sc, e, d, "a square matrix is needed", &a, NULL);
  if (e->kind == EXPR_TR) {
    const struct expr *sum = a.e[0];
    for (int i = 1; i < a.rows; i++) sum = expr_op2(&el->pool, EXPR_ADD, sum, matrix_at(&a, i, i));
    *m = matrix_scalar(el, sum);
    return true;
  }
  if (a.rows > MAX_INVERSE) return form_beyond(sc, e, d, "inv and det reach up to 4x4", &a, NULL);
  *m = e->kind == EXPR_DET ? matrix_scalar(el, determinant(el, &a)) : inverse(el, &a);
  return true;
}

void matrix_transpose(struct matrix *m, struct elaboration *el) {
  struct matrix a = *m;
  *m = matrix_new(el, a.cols, a.rows);
  for (int i = 0; i < a.rows; i++)
    for (int j = 0; j < a.cols; j++) m->e[j * a.rows + i] = matrix_at(&a, i, j);
}

bool matrix_index(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                  struct diag *d) {
  struct matrix a = *m;
  int r0 = e->index[0], r1 = e->index[1], c0 = e->index[2], c1 = e->index[3];
  if (e->n_index == 1) {
    if (a.rows != 1 && a.cols != 1) return form_mistake(sc, e, d, "a matrix needs two indices", &a, NULL);
    if (a.rows == 1) {
      c0 = r0, c1 = r1;
      r0 = r1 = 1;
    } else {
      c0 = c1 = 1;
    }
  }
  if (r0 < 1 || c0 < 1 || r1 < r0 || c1 < c0 || r1 > a.rows || c1 > a.cols)
    return form_mistake(sc, e, d, "an index out of range", &a, NULL);
  *m = matrix_new(el, r1 - r0 + 1, c1 - c0 + 1);
  int k = 0;
  for (int i = r0; i <= r1; i++)
    for (int j = c0; j <= c1; j++) m->e[k++] = matrix_at(&a, i - 1, j - 1);
  return true;
}

bool matrix_entrywise(struct matrix *m, struct elaboration *el, const struct expr *e, const struct scope *sc,
                      struct diag *d) {
  struct matrix a = *m;
  bool of_scalars = e->kind != EXPR_NEG && e->kind != EXPR_ROUNDED && !matrix_is_scalar(&a);
  if (of_scalars && (e->kind == EXPR_ABS || a.rows == a.cols)) /* a norm; functions of square matrices */
    return form_beyond(sc, e, d, "powers, roots and functions are read of scalars alone", &a, NULL);
  if (of_scalars) return form_mistake(sc, e, d, "a scalar is needed here", &a, NULL);
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < matrix_entries(&a); i++)
    m->e[i] = e->kind == EXPR_POW ? expr_pow(&el->pool, a.e[i], e->exponent) : expr_op1(&el->pool, e->kind, a.e[i]);
  return true;
}

bool matrix_hypot(struct matrix *m, const struct matrix *second, struct elaboration *el, const struct expr *e,
                  const struct scope *sc, struct diag *d) {
  struct matrix b = *second;
  if (!matrix_is_scalar(m) || !matrix_is_scalar(&b))
    return form_mistake(sc, e, d, "two scalars are needed here", m, &b);
  *m = matrix_scalar(el, expr_op2(&el->pool, EXPR_HYPOT, m->e[0], b.e[0]));
  return true;
}

/* f(0) + the sum of s f_s(0) over the small symbols s. */
void matrix_first_order(struct matrix *m, struct elaboration *el, const char *const *small, int n) {
  struct expr_pool *pool = &el->pool;
  struct matrix a = *m;
  *m = matrix_new(el, a.rows, a.cols);
  for (int i = 0; i < matrix_entries(&a); i++)
    for (int s = -1; s < n && el->pool.n <= MAX_SCALARS; s++) {
      const struct expr *x = s < 0 ? a.e[i] : expr_diff(pool, a.e[i], small[s]);
      for (int k = 0; k < n; k++) x = expr_subst(pool, x, small[k], expr_num(pool, "0"));
      if (s >= 0) x = expr_op2(pool, EXPR_ADD, m->e[i], expr_op2(pool, EXPR_MUL, x, expr_sym(pool, small[s])));
      m->e[i] = x;
    }
}

/* Heights of block rows and widths of block columns; literal zeros fit anything. */
static bool block_shape(int *height, int *width, const struct matrix *block, const struct expr *e,
                        const struct scope *sc, struct diag *d) {
  for (int i = 0; i < e->rows; i++)
    for (int j = 0; j < e->cols; j++) {
      const struct matrix *b = &block[i * e->cols + j];
      const struct expr *tree = e->args[i * e->cols + j];
      if (expr_is_zero(tree)) continue;
      if ((height[i] && height[i] != b->rows) || (width[j] && width[j] != b->cols))
        return form_mistake(sc, tree, d, "a block that does not fit its row or column", b, NULL);
      height[i] = b->rows;
      width[j] = b->cols;
    }
  for (int i = 0; i < e->rows; i++)
    if (!height[i]) height[i] = 1;
  for (int j = 0; j < e->cols; j++)
    if (!width[j]) width[j] = 1;
  return true;
}

bool matrix_of_blocks(struct matrix *out, const struct matrix *block, struct elaboration *el, const struct expr *e,
                      const struct scope *sc, struct diag *d) {
  int *height = arena_alloc(&el->pool.arena, (size_t)e->rows * sizeof *height);
  int *width = arena_alloc(&el->pool.arena, (size_t)e->cols * sizeof *width);
  if (!block_shape(height, width, block, e, sc, d)) return false;
  int rows = 0, cols = 0;
  for (int i = 0; i < e->rows; i++) rows += height[i];
  for (int j = 0; j < e->cols; j++) cols += width[j];
  if ((long)rows * cols > MAX_ENTRIES) return form_beyond(sc, e, d, "a matrix of more than 4096 entries", NULL, NULL);
  *out = matrix_zeros(el, rows, cols);
  int top = 0;
  for (int i = 0; i < e->rows; top += height[i++]) {
    int left = 0;
    for (int j = 0; j < e->cols; left += width[j++]) {
      const struct matrix *b = &block[i * e->cols + j];
      if (expr_is_zero(e->args[i * e->cols + j])) continue;
      for (int k = 0; k < b->rows; k++)
        for (int l = 0; l < b->cols; l++) out->e[(top + k) * cols + left + l] = matrix_at(b, k, l);
    }
  }
  return true;
}
