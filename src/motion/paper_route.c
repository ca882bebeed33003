/* Equations (44)-(46) over any rounded number type.

   One pass of matrices gives the residuals of the four equations and, since each propagator's derivative is its system
   matrix times itself, their exact derivatives.  The inverses of N1 - I and N3 are where the method can lose digits:
   both are solved with, as the paper says, and their condition numbers reported. */
#include "paper_route.h"

#include <math.h>

#include "flow.h"

enum { TIMES = 4, MAX_STEPS = 60, SIZE = N_STATE * N_STATE };

/* --- Small matrices that carry their status. --- */

static struct num_vec matrix(struct num_ctx ctx, slong len) {
  struct num_vec m;
  num_vec_init(&m, len, ctx);
  return m;
}

/* The 2x2 block of a 4x4 matrix at the given place, minus the identity if wanted. */
static int block(struct num_vec *out, const struct num_vec *m, int row, int col, bool minus_identity) {
  const struct num_type *type = m->ctx.type;
  struct num_vec one = matrix(m->ctx, 1);
  int status = type->set_d(num_vec_at(&one, 0), 1, m->ctx.prec);
  for (slong i = 0; i < 4; i++) {
    void *x = num_vec_at(out, i);
    type->set(x, num_vec_at(m, (2 * row + i / 2) * N_STATE + 2 * col + i % 2));
    if (minus_identity && i % 3 == 0) status |= type->sub(x, x, num_vec_at(&one, 0), m->ctx.prec);
  }
  num_vec_clear(&one);
  return status;
}

/* a -= b. */
static int subtract(struct num_vec *a, const struct num_vec *b) {
  int status = SS_OK;
  for (slong i = 0; i < a->len; i++)
    status |= a->ctx.type->sub(num_vec_at(a, i), num_vec_at(a, i), num_vec_at(b, i), a->ctx.prec);
  return status;
}

/* --- Once around. --- */

/* X = (N1 - I)^-1 N2 and Y = N3^-1 (N4 - I), and how they change with each time. */
struct around {
  struct num_vec system[TIMES], step[TIMES]; /* A and exp(A t) of each phase */
  struct num_vec n, n1, n3, x, y, dx[TIMES], dy[TIMES];
};

static void around_init(struct around *a, struct num_ctx ctx) {
  for (int i = 0; i < TIMES; i++) {
    a->system[i] = matrix(ctx, SIZE);
    a->step[i] = matrix(ctx, SIZE);
    a->dx[i] = matrix(ctx, 4);
    a->dy[i] = matrix(ctx, 4);
  }
  a->n = matrix(ctx, SIZE);
  a->n1 = matrix(ctx, 4);
  a->n3 = matrix(ctx, 4);
  a->x = matrix(ctx, 4);
  a->y = matrix(ctx, 4);
}

static void around_clear(struct around *a) {
  for (int i = 0; i < TIMES; i++) {
    num_vec_clear(&a->system[i]);
    num_vec_clear(&a->step[i]);
    num_vec_clear(&a->dx[i]);
    num_vec_clear(&a->dy[i]);
  }
  num_vec_clear(&a->n);
  num_vec_clear(&a->n1);
  num_vec_clear(&a->n3);
  num_vec_clear(&a->x);
  num_vec_clear(&a->y);
}

/* The product of all steps, or its derivative by the time of phase `by` (N_PHASES: none). */
static int go_around(struct num_vec *out, const struct around *a, int by) {
  int status = SS_OK;
  num_vec_set(out, &a->step[0]);
  for (int i = 0; i < TIMES; i++) {
    if (i > 0) status |= num_mat_mul(out, &a->step[i], out, N_STATE, N_STATE, N_STATE);
    if (i == by) status |= num_mat_mul(out, &a->system[i], out, N_STATE, N_STATE, N_STATE);
  }
  return status;
}

/* d = lead^-1 (d(rest) - d(lead) x) for x = lead^-1 rest, the two blocks in one row of N. */
static int change(struct num_vec *d, const struct num_vec *dn, const struct num_vec *lead, const struct num_vec *x,
                  int row) {
  struct num_vec dlead = matrix(d->ctx, 4);
  int status = block(&dlead, dn, row, 0, false);
  status |= block(d, dn, row, 1, false);
  status |= num_mat_mul(&dlead, &dlead, x, 2, 2, 2);
  status |= subtract(d, &dlead);
  status |= num_mat_solve(d, lead, d, 2, 2);
  num_vec_clear(&dlead);
  return status;
}

static int around_make(struct around *a, const struct num_vec *params, const struct num_vec *t) {
  int status = SS_OK;
  for (int i = 0; i < TIMES; i++) {
    status |= dyn_system(&a->system[i], (enum phase)i, params);
    status |= dyn_propagator(&a->step[i], (enum phase)i, params, num_vec_at(t, i));
  }
  status |= go_around(&a->n, a, N_PHASES);
  status |= block(&a->n1, &a->n, 0, 0, true) | block(&a->n3, &a->n, 1, 0, false);
  status |= block(&a->x, &a->n, 0, 1, false) | block(&a->y, &a->n, 1, 1, true);
  if (!status) status |= num_mat_solve(&a->x, &a->n1, &a->x, 2, 2) | num_mat_solve(&a->y, &a->n3, &a->y, 2, 2);
  struct num_vec dn = matrix(a->n.ctx, SIZE);
  for (int i = 0; i < TIMES && !status; i++) {
    status |= go_around(&dn, a, i);
    status |= change(&a->dx[i], &dn, &a->n1, &a->x, 0);
    status |= change(&a->dy[i], &dn, &a->n3, &a->y, 1);
  }
  num_vec_clear(&dn);
  return status;
}

/* --- The four equations. --- */

struct equations {
  struct num_vec e, j, z; /* residuals, their derivatives by the times, z_0 */
};

static void equations_init(struct equations *q, struct num_ctx ctx) {
  q->e = matrix(ctx, TIMES);
  q->j = matrix(ctx, TIMES * TIMES);
  q->z = matrix(ctx, 2);
}

static void equations_clear(struct equations *q) {
  num_vec_clear(&q->e);
  num_vec_clear(&q->j);
  num_vec_clear(&q->z);
}

/* The row sums of M = X - Y, or of its derivative. */
static void row_sums(val out[2], struct calc *c, const struct num_vec *x, const struct num_vec *y) {
  for (slong i = 0; i < 2; i++) {
    val first = calc_sub(c, num_vec_at(x, 2 * i), num_vec_at(y, 2 * i));
    out[i] = calc_add(c, first, calc_sub(c, num_vec_at(x, 2 * i + 1), num_vec_at(y, 2 * i + 1)));
  }
}

/* -X (V, V), or its derivative. */
static void start_position(val z[2], struct calc *c, const struct num_vec *x, val V) {
  for (slong i = 0; i < 2; i++)
    z[i] = calc_neg(c, calc_mul(c, V, calc_add(c, num_vec_at(x, 2 * i), num_vec_at(x, 2 * i + 1))));
}

/* m z for a 4x4 matrix. */
static void apply(val out[N_STATE], struct calc *c, const struct num_vec *m, const val z[N_STATE]) {
  for (slong i = 0; i < N_STATE; i++) {
    out[i] = calc_d(c, 0);
    for (slong k = 0; k < N_STATE; k++) out[i] = calc_add(c, out[i], calc_mul(c, num_vec_at(m, i * N_STATE + k), z[k]));
  }
}

/* The forces that (12) and (14) are about. */
static val force_1(struct calc *c, val chi, const val z[N_STATE]) {
  return calc_sub(c, z[Z_1], calc_mul(c, chi, z[Z_2]));
}

static val force_2(struct calc *c, val chi, const val z[N_STATE]) {
  return calc_mul(c, chi, calc_sub(c, z[Z_2], z[Z_1]));
}

static int equations_make(struct equations *q, const struct num_vec *params, const struct num_vec *t) {
  const struct num_ctx ctx = q->e.ctx;
  struct around a;
  val p[N_PARAMS], z0[N_STATE], za[N_STATE], zb[N_STATE], sums[2];
  around_init(&a, ctx);
  struct calc c = calc_begin(ctx);
  flow_vals(p, params, 0, N_PARAMS);
  int status = around_make(&a, params, t);
  if (!status) {
    z0[DZ_1] = z0[DZ_2] = p[P_V];
    start_position(z0, &c, &a.x, p[P_V]);
    apply(za, &c, &a.step[PHASE_D], z0);
    apply(zb, &c, &a.step[PHASE_GAMMA], za);
    row_sums(sums, &c, &a.x, &a.y);
    val e[TIMES] = {sums[0], sums[1], calc_sub(&c, force_1(&c, p[P_CHI], za), p[P_E1]),
                    calc_sub(&c, force_2(&c, p[P_CHI], zb), p[P_E2])};
    for (slong i = 0; i < TIMES; i++) ctx.type->set(num_vec_at(&q->e, i), e[i]);
    for (slong i = 0; i < 2; i++) ctx.type->set(num_vec_at(&q->z, i), z0[i]);
    for (slong i = 0; i < TIMES; i++) {
      val zero = calc_d(&c, 0), d0[N_STATE] = {NULL, NULL, zero, zero}, da[N_STATE], db[N_STATE], own[N_STATE];
      start_position(d0, &c, &a.dx[i], p[P_V]);
      apply(da, &c, &a.step[PHASE_D], d0);
      apply(own, &c, &a.system[PHASE_D], za);
      for (int k = 0; k < N_STATE && i == PHASE_D; k++) da[k] = calc_add(&c, da[k], own[k]);
      apply(db, &c, &a.step[PHASE_GAMMA], da);
      apply(own, &c, &a.system[PHASE_GAMMA], zb);
      for (int k = 0; k < N_STATE && i == PHASE_GAMMA; k++) db[k] = calc_add(&c, db[k], own[k]);
      row_sums(sums, &c, &a.dx[i], &a.dy[i]);
      val d[TIMES] = {sums[0], sums[1], force_1(&c, p[P_CHI], da), force_2(&c, p[P_CHI], db)};
      for (slong k = 0; k < TIMES; k++) ctx.type->set(num_vec_at(&q->j, k * TIMES + i), d[k]);
    }
    status |= c.status;
  }
  calc_clear(&c);
  around_clear(&a);
  return status;
}

/* --- Newton's iteration and what it costs. --- */

static double entry(const struct num_vec *v, slong i) {
  return v->ctx.type->get_d(num_vec_at(v, i));
}

static double largest(const struct num_vec *v, slong n) {
  double most = 0;
  for (slong i = 0; i < n; i++) most = fmax(most, fabs(entry(v, i)));
  return most;
}

int paper_route_newton(struct num_vec *x, int *steps, const struct num_vec *params) {
  const struct num_type *type = x->ctx.type;
  struct equations q;
  struct num_vec t = {x->ctx, TIMES, x->data};
  int status = SS_OK, left = 3; /* once half of the bits are right, two more steps reach the level of rounding */
  double small = ldexp(1, (int)-FLINT_MIN(x->ctx.prec / 2, 1000));
  equations_init(&q, x->ctx);
  for (*steps = 0; left > 0 && !status; ++*steps) {
    status = *steps < MAX_STEPS ? equations_make(&q, params, &t) : SS_UNABLE;
    if (status) break;
    status |= num_mat_solve(&q.e, &q.j, &q.e, TIMES, 1);
    for (slong i = 0; i < TIMES; i++)
      status |= type->sub(num_vec_at(&t, i), num_vec_at(&t, i), num_vec_at(&q.e, i), x->ctx.prec);
    if (left < 3 || largest(&q.e, TIMES) <= small * largest(&t, TIMES)) left--;
    if (!(largest(&t, TIMES) < 1000)) status |= SS_UNABLE;
  }
  if (!status) status = equations_make(&q, params, &t);
  for (slong i = 0; i < 2; i++) type->set(num_vec_at(x, ROUTE_Z + i), num_vec_at(&q.z, i));
  equations_clear(&q);
  return status;
}

static double row_norm(const struct num_vec *m, slong n) {
  double most = 0;
  for (slong i = 0; i < n; i++) {
    double sum = 0;
    for (slong k = 0; k < n; k++) sum += fabs(entry(m, i * n + k));
    most = fmax(most, sum);
  }
  return most;
}

static int condition_number(double *k, const struct num_vec *m, slong n) {
  struct num_vec inverse = matrix(m->ctx, n * n);
  int status = SS_OK;
  for (slong i = 0; i < n; i++) status |= m->ctx.type->set_d(num_vec_at(&inverse, i * (n + 1)), 1, m->ctx.prec);
  status |= num_mat_solve(&inverse, m, &inverse, n, n);
  *k = row_norm(m, n) * row_norm(&inverse, n);
  num_vec_clear(&inverse);
  return status;
}

static int paper_route_condition(struct paper_condition *k, const struct num_vec *params, const struct num_vec *x) {
  struct equations q;
  struct around a;
  struct num_vec t = {x->ctx, TIMES, x->data};
  equations_init(&q, x->ctx);
  around_init(&a, x->ctx);
  *k = (struct paper_condition){NAN, NAN, NAN};
  int status = equations_make(&q, params, &t) | around_make(&a, params, &t);
  if (!status) status |= condition_number(&k->jacobian, &q.j, TIMES);
  if (!status) status |= condition_number(&k->n1, &a.n1, 2) | condition_number(&k->n3, &a.n3, 2);
  equations_clear(&q);
  around_clear(&a);
  return status;
}

/* --- Both precisions. --- */

void paper_route_init(struct paper_route *r, slong prec) {
  *r = (struct paper_route){.x = matrix(num_ctx_mpfr(prec), N_ROUTE)};
}

void paper_route_clear(struct paper_route *r) {
  num_vec_clear(&r->x);
}

static int run(struct num_vec *x, int *steps, const fmpq *params, const double guess[4]) {
  struct num_vec p = matrix(x->ctx, N_PARAMS);
  int status = SS_OK;
  for (slong i = 0; i < N_PARAMS; i++) status |= x->ctx.type->set_q(num_vec_at(&p, i), params + i, x->ctx.prec);
  for (slong i = 0; i < TIMES; i++) status |= x->ctx.type->set_d(num_vec_at(x, i), guess[i], x->ctx.prec);
  if (!status) status = paper_route_newton(x, steps, &p);
  num_vec_clear(&p);
  return status;
}

/* The errors are differences of nearby numbers, taken in mpfr. */
static double digits_lost(const double x_d[N_ROUTE], const struct num_vec *x) {
  double worst = 0, period = 0;
  for (slong i = 0; i < TIMES; i++) period += fabs(x_d[i]);
  double reach = fabs(x_d[ROUTE_Z]) + fabs(x_d[ROUTE_Z + 1]);
  mpfr_t off;
  mpfr_init2(off, 64);
  for (slong i = 0; i < N_ROUTE; i++) {
    mpfr_sub_d(off, num_vec_at(x, i), x_d[i], MPFR_RNDN);
    worst = fmax(worst, fabs(mpfr_get_d(off, MPFR_RNDN)) / (i < TIMES ? period : reach));
  }
  mpfr_clear(off);
  return fmax(0, log10(ldexp(worst, 53)));
}

int paper_route_run(struct paper_route *r, const fmpq *params, const double guess[4]) {
  for (int i = 0; i < N_PARAMS; i++)
    if (fmpq_sgn(params + i) <= 0) return SS_DOMAIN;
  if (fmpz_cmp(fmpq_numref(params + P_CHI), fmpq_denref(params + P_CHI)) >= 0) return SS_DOMAIN;
  struct num_vec x_d = {num_ctx_double(), N_ROUTE, (char *)r->x_d}, p = matrix(r->x.ctx, N_PARAMS);
  r->condition = (struct paper_condition){NAN, NAN, NAN};
  r->status_d = run(&x_d, &r->steps_d, params, guess);
  int status = run(&r->x, &r->steps, params, guess);
  for (slong i = 0; i < N_PARAMS; i++) status |= num_mpfr.set_q(num_vec_at(&p, i), params + i, r->x.ctx.prec);
  if (!status) status |= paper_route_condition(&r->condition, &p, &r->x);
  r->digits_lost = status || r->status_d ? (double)NAN : digits_lost(r->x_d, &r->x);
  num_vec_clear(&p);
  return status;
}
