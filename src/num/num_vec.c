/* Contexts, arrays of elements, and dense matrices by elimination.

   One loop over the method table serves every number type.  Results are formed in fresh elements and swapped into the
   output at the end, so an output may be an input and gives the same bits as a separate one.  A pivot must be told
   from zero: exact zeros alone show that a matrix is singular, a column of balls around zero shows nothing. */
#include "base/arena.h"
#include "num.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct num_ctx num_ctx_double(void) {
  return (struct num_ctx){&num_double, 53};
}

struct num_ctx num_ctx_mpfr(slong prec) {
  return (struct num_ctx){&num_mpfr, prec};
}

struct num_ctx num_ctx_arb(slong prec) {
  return (struct num_ctx){&num_arb, prec};
}

void num_vec_init(struct num_vec *v, slong len, struct num_ctx ctx) {
  if (len < 0 || (size_t)len > SIZE_MAX / ctx.type->size) abort();
  size_t bytes = (size_t)len * ctx.type->size;
  *v = (struct num_vec){ctx, len, ss_malloc(bytes)};
  if (ctx.type->zeroed)
    memset(v->data, 0, bytes);
  else
    for (slong i = 0; i < len; i++) ctx.type->init(num_vec_at(v, i), ctx.prec);
}

void num_vec_clear(struct num_vec *v) {
  for (slong i = 0; !v->ctx.type->plain && i < v->len; i++) v->ctx.type->clear(num_vec_at(v, i));
  free(v->data);
  v->data = NULL;
  v->len = 0;
}

void num_vec_set(struct num_vec *z, const struct num_vec *x) {
  if (z->len != x->len || z->ctx.type != x->ctx.type) abort();
  for (slong i = 0; i < z->len; i++) z->ctx.type->set(num_vec_at(z, i), num_vec_at(x, i));
}

bool num_same(const struct num_type *t, const void *x, const void *y) {
  NUMBERS(arb, a, b);
  t->get_arb(a, x);
  t->get_arb(b, y);
  return arb_equal(a, b);
}

static void vec_swap(struct num_vec *x, struct num_vec *y) {
  for (slong i = 0; i < x->len; i++) x->ctx.type->swap(num_vec_at(x, i), num_vec_at(y, i));
}

static void check_shape(const struct num_vec *x, slong rows, slong cols) {
  if (rows < 0 || cols < 0 || x->len != rows * cols) abort();
}

/* In double precision the calls would cost more than the arithmetic.  What is not finite on the way is not finite at
   the end, so that the status is that of the steps. */
static int double_mat_mul(double *z, const double *x, const double *y, slong m, slong n, slong p) {
  int status = SS_OK;
  FREED double *sum = ss_malloc((size_t)(m * p) * sizeof *sum);
  for (slong i = 0; i < m; i++)
    for (slong j = 0; j < p; j++) {
      double s = 0;
      for (slong k = 0; k < n; k++) s += x[i * n + k] * y[k * p + j];
      if (!isfinite(s)) status |= SS_UNABLE;
      sum[i * p + j] = isfinite(s) ? s : (double)NAN;
    }
  memcpy(z, sum, (size_t)(m * p) * sizeof *sum);
  return status;
}

int num_mat_mul(struct num_vec *z, const struct num_vec *x, const struct num_vec *y, slong m, slong n, slong p) {
  const struct num_type *f = z->ctx.type;
  slong prec = z->ctx.prec;
  int status = SS_OK;
  check_shape(z, m, p);
  check_shape(x, m, n);
  check_shape(y, n, p);
  if (f == &num_double) return double_mat_mul((void *)z->data, (void *)x->data, (void *)y->data, m, n, p);
  OWNED(num_vec) sum, term;
  num_vec_init(&sum, m * p, z->ctx);
  num_vec_init(&term, 1, z->ctx);
  void *t = num_vec_at(&term, 0);
  for (slong i = 0; i < m; i++)
    for (slong j = 0; j < p; j++)
      for (slong k = 0; k < n; k++) {
        void *s = num_vec_at(&sum, i * p + j);
        status |= f->mul(t, num_vec_at(x, i * n + k), num_vec_at(y, k * p + j), prec);
        status |= f->add(s, s, t, prec);
      }
  vec_swap(z, &sum);
  return status;
}

static void swap_rows(struct num_vec *a, slong i, slong j, slong cols) {
  for (slong k = 0; k < cols; k++) a->ctx.type->swap(num_vec_at(a, i * cols + k), num_vec_at(a, j * cols + k));
}

/* The row at or below the diagonal with the largest entry of column k that is surely not zero; -1 when there is none,
   with SS_DOMAIN when all of them are zero and SS_UNABLE when that cannot be told. */
static slong find_pivot(const struct num_vec *a, slong k, slong n, int *status) {
  const struct num_type *f = a->ctx.type;
  slong best = -1;
  double best_size = -1;
  bool all_zero = true;
  for (slong i = k; i < n; i++) {
    const void *x = num_vec_at(a, i * n + k);
    truth zero = f->is_zero(x);
    all_zero = all_zero && zero == TRUTH_TRUE;
    if (zero == TRUTH_FALSE && fabs(f->get_d(x)) > best_size) {
      best = i;
      best_size = fabs(f->get_d(x));
    }
  }
  if (best < 0) *status |= all_zero ? SS_DOMAIN : SS_UNABLE;
  return best;
}

/* Subtracts from row i of c the multiple u of row k, from column `from` on.  t is scratch. */
static int subtract_row(struct num_vec *c, slong i, slong k, const void *u, slong from, slong cols, void *t) {
  const struct num_type *f = c->ctx.type;
  slong prec = c->ctx.prec;
  int status = SS_OK;
  for (slong j = from; j < cols; j++) {
    void *z = num_vec_at(c, i * cols + j);
    status |= f->mul(t, u, num_vec_at(c, k * cols + j), prec);
    status |= f->sub(z, z, t, prec);
  }
  return status;
}

/* Brings column k below the diagonal of a to zero, in b alike (NULL: no right-hand sides). */
static int eliminate(struct num_vec *a, struct num_vec *b, slong k, slong n, slong p, struct num_vec *scratch) {
  const struct num_type *f = a->ctx.type;
  void *u = num_vec_at(scratch, 0), *t = num_vec_at(scratch, 1);
  int status = SS_OK;
  for (slong i = k + 1; i < n; i++) {
    status |= f->div(u, num_vec_at(a, i * n + k), num_vec_at(a, k * n + k), a->ctx.prec);
    status |= subtract_row(a, i, k, u, k + 1, n, t);
    if (b != NULL) status |= subtract_row(b, i, k, u, 0, p, t);
  }
  return status;
}

/* x = u^-1 x for the upper triangle u. */
static int back_substitute(struct num_vec *x, const struct num_vec *u, slong n, slong p, void *t) {
  const struct num_type *f = x->ctx.type;
  slong prec = x->ctx.prec;
  int status = SS_OK;
  for (slong j = 0; j < p; j++)
    for (slong i = n - 1; i >= 0; i--) {
      void *z = num_vec_at(x, i * p + j);
      for (slong k = i + 1; k < n; k++) {
        status |= f->mul(t, num_vec_at(u, i * n + k), num_vec_at(x, k * p + j), prec);
        status |= f->sub(z, z, t, prec);
      }
      status |= f->div(z, z, num_vec_at(u, i * n + i), prec);
    }
  return status;
}

int num_mat_solve(struct num_vec *x, const struct num_vec *a, const struct num_vec *b, slong n, slong p) {
  OWNED(num_vec) u, y, scratch;
  int status = SS_OK;
  check_shape(x, n, p);
  check_shape(a, n, n);
  check_shape(b, n, p);
  num_vec_init(&u, n * n, x->ctx);
  num_vec_init(&y, n * p, x->ctx);
  num_vec_init(&scratch, 2, x->ctx);
  num_vec_set(&u, a);
  num_vec_set(&y, b);
  for (slong k = 0; k < n; k++) {
    slong pivot = find_pivot(&u, k, n, &status);
    if (pivot < 0) break;
    swap_rows(&u, k, pivot, n);
    swap_rows(&y, k, pivot, p);
    status |= eliminate(&u, &y, k, n, p, &scratch);
  }
  if (status == SS_OK) status = back_substitute(&y, &u, n, p, num_vec_at(&scratch, 1));
  for (slong i = 0; status != SS_OK && i < y.len; i++) y.ctx.type->set_d(num_vec_at(&y, i), (double)NAN, y.ctx.prec);
  vec_swap(x, &y);
  return status;
}

/* The last pivot divides nothing, so it may hold zero: the determinant of a singular matrix is enclosed whenever the
   columns before the last have pivots. */
int num_mat_det(void *z, const struct num_vec *a, slong n) {
  const struct num_type *f = a->ctx.type;
  slong prec = a->ctx.prec;
  OWNED(num_vec) u, scratch, det;
  int status = SS_OK;
  check_shape(a, n, n);
  num_vec_init(&u, n * n, a->ctx);
  num_vec_init(&scratch, 2, a->ctx);
  num_vec_init(&det, 1, a->ctx);
  void *d = num_vec_at(&det, 0);
  num_vec_set(&u, a);
  status |= f->set_d(d, 1, prec);
  for (slong k = 0; k < n && status == SS_OK; k++) {
    slong pivot = k < n - 1 ? find_pivot(&u, k, n, &status) : k;
    if (pivot < 0) break;
    if (pivot != k) {
      swap_rows(&u, k, pivot, n);
      status |= f->neg(d, d, prec);
    }
    status |= f->mul(d, d, num_vec_at(&u, k * n + k), prec);
    status |= eliminate(&u, NULL, k, n, 0, &scratch);
  }
  if (status == SS_DOMAIN) status = f->set_d(d, 0, prec);
  if (status != SS_OK) f->set_d(d, (double)NAN, prec);
  f->swap(z, d);
  return status;
}
