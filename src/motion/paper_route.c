/* Equations (44)-(46) over any rounded number type.

   One pass of matrices gives the residuals of the four equations and, since each propagator's derivative is its system
   matrix times itself, their exact derivatives.  The inverses of N1 - I and N3 are where the method can lose digits:
   both are solved with, as the paper says, and their condition numbers reported. */
#include "paper_route.h"

#include <math.h>

#include "flow.h"

enum { TIMES = 4, MAX_STEPS = 60, SIZE = N_STATE * N_STATE };

/* The 2x2 block of a 4x4 matrix at the given place, minus the identity if wanted. */
static void block(struct num_vec *out, struct calc *c, const struct num_vec *m, int row, int col, bool minus_identity) {
  for (slong i = 0; i < 4; i++) {
    val x = num_vec_at(m, (2 * row + i / 2) * N_STATE + 2 * col + i % 2);
    calc_store(c, num_vec_at(out, i), minus_identity && i % 3 == 0 ? calc_sub(c, x, calc_d(c, 1)) : x);
  }
}

/* --- Once around. --- */

/* X = (N1 - I)^-1 N2 and Y = N3^-1 (N4 - I), and how they change with each time. */
struct around {
  struct num_vec system[TIMES], step[TIMES]; /* A and exp(A t) of each phase */
  struct num_vec n, n1, n3, x, y, dx[TIMES], dy[TIMES];
};

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

/* lead^-1 (d(rest) - d(lead) x) for x = lead^-1 rest, the two blocks in one row of N. */
static struct num_vec change(struct calc *c, const struct num_vec *dn, const struct num_vec *lead,
                             const struct num_vec *x, int row) {
  struct num_vec d = calc_vec(c, 4), dlead = calc_vec(c, 4);
  block(&dlead, c, dn, row, 0, false);
  block(&d, c, dn, row, 1, false);
  c->status |= num_mat_mul(&dlead, &dlead, x, 2, 2, 2);
  for (slong i = 0; i < 4; i++) calc_store(c, num_vec_at(&d, i), calc_sub(c, num_vec_at(&d, i), num_vec_at(&dlead, i)));
  c->status |= num_mat_solve(&d, lead, &d, 2, 2);
  return d;
}

/* In vectors of the calc, whose status says whether all of them are made. */
static struct around around_make(struct calc *c, const struct num_vec *params, const struct num_vec *t) {
  struct around a = {
      .n = calc_vec(c, SIZE), .n1 = calc_vec(c, 4), .n3 = calc_vec(c, 4), .x = calc_vec(c, 4), .y = calc_vec(c, 4)};
  struct num_vec dn = calc_vec(c, SIZE);
  for (int i = 0; i < TIMES; i++) {
    a.system[i] = calc_vec(c, SIZE);
    a.step[i] = calc_vec(c, SIZE);
    c->status |= dyn_system(&a.system[i], (enum phase)i, params);
    c->status |= dyn_propagator(&a.step[i], (enum phase)i, params, num_vec_at(t, i));
  }
  c->status |= go_around(&a.n, &a, N_PHASES);
  block(&a.n1, c, &a.n, 0, 0, true);
  block(&a.n3, c, &a.n, 1, 0, false);
  block(&a.x, c, &a.n, 0, 1, false);
  block(&a.y, c, &a.n, 1, 1, true);
  if (!c->status) c->status |= num_mat_solve(&a.x, &a.n1, &a.x, 2, 2) | num_mat_solve(&a.y, &a.n3, &a.y, 2, 2);
  for (int i = 0; i < TIMES && !c->status; i++) {
    c->status |= go_around(&dn, &a, i);
    a.dx[i] = change(c, &dn, &a.n1, &a.x, 0);
    a.dy[i] = change(c, &dn, &a.n3, &a.y, 1);
  }
  return a;
}

/* --- The four equations. --- */

/* Residuals, their derivatives by the times, and z_0, in vectors of a calc. */
struct equations {
  struct num_vec e, j, z;
};

static struct equations equations_new(struct calc *c) {
  return (struct equations){calc_vec(c, TIMES), calc_vec(c, TIMES * TIMES), calc_vec(c, 2)};
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

static int equations_make(struct equations *q, const struct num_vec *params, const struct num_vec *t) {
  val p[N_PARAMS], z0[N_STATE], za[N_STATE], zb[N_STATE], sums[2];
  OWNED(calc) c = calc_begin(q->e.ctx);
  const struct around a = around_make(&c, params, t);
  flow_vals(p, params, 0, N_PARAMS);
  if (!c.status) {
    z0[DZ_1] = z0[DZ_2] = p[P_V];
    start_position(z0, &c, &a.x, p[P_V]);
    apply(za, &c, &a.step[PHASE_D], z0);
    apply(zb, &c, &a.step[PHASE_GAMMA], za);
    row_sums(sums, &c, &a.x, &a.y);
    val e[TIMES] = {sums[0], sums[1], flow_switching(&c, PHASE_D, p, za), flow_switching(&c, PHASE_GAMMA, p, zb)};
    for (slong i = 0; i < TIMES; i++) calc_store(&c, num_vec_at(&q->e, i), e[i]);
    for (slong i = 0; i < 2; i++) calc_store(&c, num_vec_at(&q->z, i), z0[i]);
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
      val d[TIMES] = {sums[0], sums[1], flow_force(&c, 0, p[P_CHI], da), flow_force(&c, 1, p[P_CHI], db)};
      for (slong k = 0; k < TIMES; k++) calc_store(&c, num_vec_at(&q->j, k * TIMES + i), d[k]);
    }
  }
  return c.status;
}

/* --- Newton's iteration and what it costs. --- */

static double entry(const struct num_vec *v, slong i) {
  return v->ctx.type->get_d(num_vec_at(v, i));
}

static double largest(const struct num_vec *v) {
  double most = 0;
  for (slong i = 0; i < v->len; i++) most = fmax(most, fabs(entry(v, i)));
  return most;
}

int paper_route_newton(struct num_vec *x, int *steps, const struct num_vec *params) {
  const struct num_type *type = x->ctx.type;
  OWNED(calc) c = calc_begin(x->ctx);
  struct equations q = equations_new(&c);
  struct num_vec t = {x->ctx, TIMES, x->data};
  int status = SS_OK, left = 3; /* once half of the bits are right, two more steps reach the level of rounding */
  double small = ldexp(1, (int)-FLINT_MIN(x->ctx.prec / 2, 1000));
  for (*steps = 0; left > 0 && !status; ++*steps) {
    status = *steps < MAX_STEPS ? equations_make(&q, params, &t) : SS_UNABLE;
    if (status) break;
    status |= num_mat_solve(&q.e, &q.j, &q.e, TIMES, 1);
    for (slong i = 0; i < TIMES; i++)
      status |= type->sub(num_vec_at(&t, i), num_vec_at(&t, i), num_vec_at(&q.e, i), x->ctx.prec);
    if (left < 3 || largest(&q.e) <= small * largest(&t)) left--;
    if (!(largest(&t) < 1000)) status |= SS_UNABLE;
  }
  if (!status) status = equations_make(&q, params, &t);
  for (slong i = 0; i < 2; i++) type->set(num_vec_at(x, ROUTE_Z + i), num_vec_at(&q.z, i));
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

int paper_condition_number(double *k, const struct num_vec *a, slong n) {
  OWNED(calc) c = calc_begin(a->ctx);
  struct num_vec inverse = calc_vec(&c, n * n);
  for (slong i = 0; i < n; i++) calc_store(&c, num_vec_at(&inverse, i * (n + 1)), calc_d(&c, 1));
  int status = num_mat_solve(&inverse, a, &inverse, n, n);
  *k = row_norm(a, n) * row_norm(&inverse, n);
  return status;
}

static int paper_route_condition(struct paper_condition *k, const struct num_vec *params, const struct num_vec *x) {
  struct num_vec t = {x->ctx, TIMES, x->data};
  OWNED(calc) c = calc_begin(x->ctx);
  struct equations q = equations_new(&c);
  const struct around a = around_make(&c, params, &t);
  c.status |= equations_make(&q, params, &t);
  if (!c.status) c.status |= paper_condition_number(&k->jacobian, &q.j, TIMES);
  if (!c.status) c.status |= paper_condition_number(&k->n1, &a.n1, 2) | paper_condition_number(&k->n3, &a.n3, 2);
  return c.status;
}

/* --- Both precisions. --- */

void paper_route_init(struct paper_route *r, slong prec) {
  *r = (struct paper_route){.steps = 0};
  num_vec_init(&r->x, N_ROUTE, num_ctx_mpfr(prec));
}

void paper_route_clear(struct paper_route *r) {
  num_vec_clear(&r->x);
}

static int run(struct num_vec *x, int *steps, const struct num_vec *params, const double guess[4]) {
  int status = SS_OK;
  for (slong i = 0; i < TIMES; i++) status |= x->ctx.type->set_d(num_vec_at(x, i), guess[i], x->ctx.prec);
  return status ? status : paper_route_newton(x, steps, params);
}

/* The parameters in a vector of the calc. */
static struct num_vec params_in(struct calc *c, const fmpq *params) {
  struct num_vec p = calc_vec(c, N_PARAMS);
  for (slong i = 0; i < N_PARAMS; i++) calc_store(c, num_vec_at(&p, i), calc_q(c, params + i));
  return p;
}

/* The errors are differences of nearby numbers, taken in mpfr. */
double paper_digits_lost(const double x_d[N_ROUTE], const struct num_vec *x) {
  double worst = 0, period = 0;
  for (slong i = 0; i < TIMES; i++) period += fabs(x_d[i]);
  double reach = fabs(x_d[ROUTE_Z]) + fabs(x_d[ROUTE_Z + 1]);
  MPFR_NUMBERS(64, off);
  for (slong i = 0; i < N_ROUTE; i++) {
    mpfr_sub_d(off, num_vec_at(x, i), x_d[i], MPFR_RNDN);
    worst = fmax(worst, fabs(mpfr_get_d(off, MPFR_RNDN)) / (i < TIMES ? period : reach));
  }
  return isfinite(period + reach) ? fmax(0, log10(ldexp(worst, 53))) : (double)NAN;
}

int paper_route_run(struct paper_route *r, const fmpq *params, const double guess[4]) {
  if (!dyn_in_domain(params, N_PARAMS)) return SS_DOMAIN;
  struct num_vec x_d = {num_ctx_double(), N_ROUTE, (char *)r->x_d};
  OWNED(calc) c = calc_begin(r->x.ctx), d = calc_begin(x_d.ctx);
  const struct num_vec p = params_in(&c, params), p_d = params_in(&d, params);
  r->condition = (struct paper_condition){NAN, NAN, NAN};
  r->status_d = d.status ? d.status : run(&x_d, &r->steps_d, &p_d, guess);
  int status = c.status ? c.status : run(&r->x, &r->steps, &p, guess);
  if (!status) status = paper_route_condition(&r->condition, &p, &r->x);
  r->digits_lost = status || r->status_d ? (double)NAN : paper_digits_lost(r->x_d, &r->x);
  return status;
}
