/* The matrix exponential of each phase's first-order system.

   It uses the matrix and nothing else, which makes it a check on every closed form.  In double precision GSL computes
   it, in balls Arb; in MPFR the Taylor series is summed for A t / 2^s and squared s times.  A squaring can multiply the
   error by twice the norm of what it squares: the norms met on the way tell how many guard bits were needed, and the
   computation is repeated with them if there were fewer. */
#include "num/flint_more.h"
#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

#include "flow.h"

int dyn_system(struct num_vec *a, enum phase ph, const struct num_vec *params) {
  val p[N_PARAMS];
  OWNED(calc) c = calc_begin(a->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  val zero = calc_d(&c, 0), one = calc_d(&c, 1), stiff = calc_mul(&c, p[P_CHI], p[P_ETA]);
  const int *slips = phase_slips[ph];
  val rows[N_STATE][N_STATE] = {
      {zero, zero, one, zero},
      {zero, zero, zero, one},
      {slips[0] ? calc_neg(&c, one) : zero, slips[0] ? p[P_CHI] : zero, zero, zero},
      {slips[1] ? stiff : zero, slips[1] ? calc_neg(&c, stiff) : zero, zero, zero},
  };
  for (slong i = 0; i < N_STATE * N_STATE; i++) a->ctx.type->set(num_vec_at(a, i), rows[i / N_STATE][i % N_STATE]);
  return c.status;
}

static int exponential_gsl(struct num_vec *p, const struct num_vec *at) {
  gsl_matrix_view x = gsl_matrix_view_array((double *)(void *)at->data, N_STATE, N_STATE);
  gsl_matrix_view z = gsl_matrix_view_array((double *)(void *)p->data, N_STATE, N_STATE);
  gsl_error_handler_t *old = gsl_set_error_handler(dyn_gsl_quiet);
  int failed = gsl_linalg_exponential_ss(&x.matrix, &z.matrix, GSL_PREC_DOUBLE);
  gsl_set_error_handler(old);
  for (slong i = 0; i < N_STATE * N_STATE; i++)
    if (!isfinite(((double *)(void *)p->data)[i])) failed = 1;
  return failed ? SS_UNABLE : SS_OK;
}

static int exponential_arb(struct num_vec *p, const struct num_vec *at) {
  int status = SS_OK;
  SIZED(arb_mat, x, N_STATE, N_STATE);
  SIZED(arb_mat, z, N_STATE, N_STATE);
  for (slong i = 0; i < N_STATE * N_STATE; i++) arb_set(arb_mat_entry(x, i / N_STATE, i % N_STATE), num_vec_at(at, i));
  arb_mat_exp(z, x, at->ctx.prec);
  for (slong i = 0; i < N_STATE * N_STATE; i++) {
    arb_ptr entry = num_vec_at(p, i);
    arb_set_round(entry, arb_mat_entry(z, i / N_STATE, i % N_STATE), p->ctx.prec);
    if (!arb_is_finite(entry)) status = SS_UNABLE;
  }
  return status;
}

/* An exponent e with every entry below 2^e in absolute value. */
static slong magnitude(const struct num_vec *m) {
  slong e = -WORD_MAX;
  for (slong i = 0; i < m->len; i++) {
    mpfr_srcptr x = num_vec_at(m, i);
    if (mpfr_regular_p(x) && mpfr_get_exp(x) > e) e = mpfr_get_exp(x);
  }
  return e;
}

/* Adds 1 + x + x^2/2! + ... until a term is lost in rounding; the entries of x are below 2^-3. */
static int taylor(struct num_vec *sum, const struct num_vec *x) {
  OWNED(num_vec) term;
  int status = SS_OK;
  num_vec_init(&term, x->len, x->ctx);
  for (slong i = 0; i < N_STATE; i++) mpfr_set_ui(num_vec_at(&term, i * (N_STATE + 1)), 1, MPFR_RNDN);
  num_vec_set(sum, &term);
  for (unsigned long k = 1; magnitude(&term) > -x->ctx.prec - 2; k++) {
    status |= num_mat_mul(&term, &term, x, N_STATE, N_STATE, N_STATE);
    for (slong i = 0; i < x->len; i++) {
      mpfr_ptr t = num_vec_at(&term, i), s = num_vec_at(sum, i);
      mpfr_div_ui(t, t, k, MPFR_RNDN);
      mpfr_add(s, s, t, MPFR_RNDN);
    }
  }
  return status;
}

/* exp(x) at the precision of z; *growth: bits by which the squarings may have multiplied the error. */
static int scale_and_square(struct num_vec *z, const struct num_vec *x, slong *growth) {
  OWNED(num_vec) y;
  int status = SS_OK;
  slong top = magnitude(x), halvings = top > -5 ? top + 5 : 0; /* four entries a row: the norm is below 2^-3 */
  num_vec_init(&y, x->len, z->ctx);
  num_vec_set(&y, x);
  for (slong i = 0; i < y.len; i++) mpfr_mul_2si(num_vec_at(&y, i), num_vec_at(&y, i), -halvings, MPFR_RNDN);
  status |= taylor(z, &y);
  *growth = 0;
  for (slong i = 0; i < halvings && !status; i++) {
    *growth += 3 + FLINT_MAX(magnitude(z), 0);
    status |= num_mat_mul(z, z, z, N_STATE, N_STATE, N_STATE);
  }
  *growth -= FLINT_MAX(magnitude(z), 0);
  return status;
}

static int exponential_mpfr(struct num_vec *p, const struct num_vec *params, enum phase ph, mpfr_srcptr t) {
  slong guard = 64, growth = 0, most = p->ctx.prec + 1000000;
  int status;
  do {
    OWNED(num_vec) x, z;
    struct num_ctx ctx = num_ctx_mpfr(p->ctx.prec + guard);
    num_vec_init(&x, N_STATE * N_STATE, ctx);
    num_vec_init(&z, N_STATE * N_STATE, ctx);
    status = dyn_system(&x, ph, params);
    for (slong i = 0; i < x.len; i++) status |= ctx.type->mul(num_vec_at(&x, i), num_vec_at(&x, i), t, ctx.prec);
    if (magnitude(&x) > 4096)
      status |= SS_UNABLE;
    else
      status |= scale_and_square(&z, &x, &growth);
    for (slong i = 0; i < x.len; i++) mpfr_set(num_vec_at(p, i), num_vec_at(&z, i), MPFR_RNDN);
    if (status || guard >= growth + 16) return status;
    guard = growth + 32;
  } while (guard < most);
  return SS_UNABLE;
}

int dyn_propagator(struct num_vec *p, enum phase ph, const struct num_vec *params, const void *t) {
  const struct num_type *type = p->ctx.type;
  if (type == &num_mpfr) return exponential_mpfr(p, params, ph, t);
  OWNED(num_vec) at;
  num_vec_init(&at, N_STATE * N_STATE, p->ctx);
  int status = dyn_system(&at, ph, params);
  for (slong i = 0; i < at.len; i++) status |= type->mul(num_vec_at(&at, i), num_vec_at(&at, i), t, p->ctx.prec);
  if (!status) status = type == &num_double ? exponential_gsl(p, &at) : exponential_arb(p, &at);
  return status;
}
