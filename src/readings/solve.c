/* Some of the equations solved for as many quantities (num/solve.h): Newton's iteration in double precision to find,
   Krawczyk's operator in balls to prove, for each value of the quantities that are held fixed as balls. */
#include <math.h>

#include "num/calc.h"
#include "num/solve.h"
#include "readings_impl.h"

/* The equations and unknowns of two masks as lists; the number of them, or -1 when they are not equally many. */
static int lists(int eq[N_EQ], int x[N_X], unsigned eqs, unsigned unknown) {
  int n = 0, m = 0;
  for (int i = 0; i < N_EQ; i++)
    if (eqs >> i & 1) eq[n++] = i;
  for (int i = 0; i < N_X; i++)
    if (unknown >> i & 1) x[m++] = i;
  return n == m ? n : -1;
}

struct block_solver {
  struct system *s;
  unsigned eqs;
  int eq[N_EQ], at[N_X], n;
  const double *start; /* of the iteration in double precision */
  int steps;
};

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct block_solver *b = self;
  struct system *s = b->s;
  for (int i = 0; i < b->n; i++) s->ctx.type->set(num_vec_at(&s->x, b->at[i]), num_vec_at(x, i));
  int status = system_eval(s, b->eqs);
  for (int i = 0; i < b->n; i++) {
    if (f) f[i] = num_vec_at(&s->value, b->eq[i]);
    for (int k = 0; k < b->n; k++) j[i * b->n + k] = num_vec_at(&s->slope, b->eq[i] * N_X + b->at[k]);
  }
  return status;
}

/* Near the start, and until the next step would be the square of 1e-7. */
static enum newton_next stays_near(const struct num_vec *x, const struct num_vec *step, void *self) {
  const struct block_solver *b = self;
  const double *at = num_vec_at(x, 0), *by = num_vec_at(step, 0);
  bool settled = true;
  for (int i = 0; i < b->n; i++) {
    double start = b->start[b->at[i]], next = at[i] - by[i];
    if (!(fabs(next - start) <= 1 + fabs(start))) return NEWTON_LOST;
    settled = settled && fabs(by[i]) <= 1e-7 * (1 + fabs(next));
  }
  return settled ? NEWTON_LAST : NEWTON_ON;
}

bool readings_newton(double x[N_X], struct system *s, unsigned eqs, unsigned unknown) {
  enum { MAX_STEPS = 12 };
  struct block_solver b = {.s = s, .eqs = eqs};
  struct solve_system system = {b.n = lists(b.eq, b.at, eqs, unknown), values, &b};
  if (b.n <= 0) return b.n == 0;
  double free[N_X], start[N_X];
  struct num_vec at = {s->ctx, b.n, (char *)free};
  b.start = start;
  for (int i = 0; i < N_X; i++) {
    start[i] = x[i];
    if (s->ctx.type->set_d(num_vec_at(&s->x, i), x[i], s->ctx.prec) != SS_OK) return false;
  }
  for (int i = 0; i < b.n; i++) free[i] = x[b.at[i]];
  int status = newton_run(&at, &system, s->ctx, MAX_STEPS, stays_near);
  for (int i = 0; i < b.n && !status; i++) x[b.at[i]] = free[i];
  return !status;
}

/* --- In balls --- */

/* Two steps lead from double precision to more bits than are worked with. */
static enum newton_next second(const struct num_vec *x, const struct num_vec *step, void *self) {
  struct block_solver *b = self;
  (void)x;
  (void)step;
  return ++b->steps < 2 ? NEWTON_ON : NEWTON_LAST;
}

/* A box that is proved, and then the image of its image, which is narrower still. */
static int prove(struct krawczyk *k, const struct num_vec *mid) {
  int status = krawczyk_centre(k, mid);
  if (!status) status = krawczyk_follow(k, 0);
  if (status) return status;
  for (slong i = 0; i < mid->len; i++)
    arb_union(num_vec_at(&k->box, i), num_vec_at(&k->image, i), num_vec_at(&k->mid, i), mid->ctx.prec);
  return krawczyk_apply(k);
}

bool readings_enclose(arb_ptr x, struct system *s, unsigned eqs, unsigned unknown) {
  struct block_solver b = {.s = s, .eqs = eqs};
  struct solve_system system = {b.n = lists(b.eq, b.at, eqs, unknown), values, &b};
  if (b.n <= 0) return b.n == 0;
  OWNED(num_vec) mid;
  num_vec_init(&mid, b.n, s->ctx);
  OWNED(krawczyk) k;
  krawczyk_init(&k, &system, s->ctx.prec);
  for (int i = 0; i < N_X; i++) arb_get_mid_arb(num_vec_at(&s->x, i), x + i);
  for (int i = 0; i < b.n; i++) arb_get_mid_arb(num_vec_at(&mid, i), x + b.at[i]);
  int status = newton_run(&mid, &system, s->ctx, 2, second);
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&s->x, i), x + i);
  if (!status) status = prove(&k, &mid);
  for (int i = 0; i < b.n && !status; i++) arb_set(x + b.at[i], num_vec_at(&k.image, i));
  return !status;
}

bool readings_slopes(arb_ptr by_known, arb_ptr by_equation, struct system *s, arb_srcptr x, unsigned eqs,
                     unsigned unknown) {
  int eq[N_EQ], at[N_X], n = lists(eq, at, eqs, unknown);
  if (n <= 0) return false;
  OWNED(calc) w = calc_begin(s->ctx);
  struct num_vec j = calc_vec(&w, n * n);
  struct num_vec right = calc_vec(&w, n * (N_X + n)); /* minus the derivative by every quantity; the unit matrix */
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&s->x, i), x + i);
  bool ok = system_eval(s, eqs) == SS_OK;
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < n; k++) arb_set(num_vec_at(&j, i * n + k), num_vec_at(&s->slope, eq[i] * N_X + at[k]));
    for (int c = 0; c < N_X; c++)
      arb_neg(num_vec_at(&right, i * (N_X + n) + c), num_vec_at(&s->slope, eq[i] * N_X + c));
    arb_one(num_vec_at(&right, i * (N_X + n) + N_X + i));
  }
  ok = ok && num_mat_solve(&right, &j, &right, n, N_X + n) == SS_OK;
  for (int i = 0; ok && i < n; i++) {
    for (int c = 0; by_known && c < N_X; c++)
      if (!(unknown >> c & 1)) arb_set(by_known + at[i] * N_X + c, num_vec_at(&right, i * (N_X + n) + c));
    for (int c = 0; by_equation && c < n; c++)
      arb_set(by_equation + at[i] * N_EQ + eq[c], num_vec_at(&right, i * (N_X + n) + N_X + c));
  }
  return ok;
}
