/* Some of the equations solved for as many quantities: Newton's iteration in double precision to find, Krawczyk's
   operator in balls to prove.  Krawczyk: with Y near the inverse of the Jacobian at x, the image
   x - Y f(x) + (I - Y J(B)) (B - x) of a box B around x holds every zero in B, and lying inside of B proves that there
   is exactly one, for each value of the quantities that are held fixed as balls. */
#include <math.h>

#include "readings.h"

/* The equations and unknowns of two masks as lists; the number of them, or -1 when they are not equally many. */
static int lists(int eq[N_EQ], int x[N_X], unsigned eqs, unsigned unknown) {
  int n = 0, m = 0;
  for (int i = 0; i < N_EQ; i++)
    if (eqs >> i & 1) eq[n++] = i;
  for (int i = 0; i < N_X; i++)
    if (unknown >> i & 1) x[m++] = i;
  return n == m ? n : -1;
}

/* The square part of value and slope. */
static void gather(struct num_vec *f, struct num_vec *j, const struct system *s, const int *eq, const int *x, int n) {
  const struct num_type *t = s->ctx.type;
  for (int i = 0; i < n; i++) {
    t->set(num_vec_at(f, i), num_vec_at(&s->value, eq[i]));
    for (int k = 0; k < n; k++) t->set(num_vec_at(j, i * n + k), num_vec_at(&s->slope, eq[i] * N_X + x[k]));
  }
}

bool readings_newton(double x[N_X], struct system *s, unsigned eqs, unsigned unknown) {
  enum { MAX_STEPS = 12 };
  int eq[N_EQ], at[N_X], n = lists(eq, at, eqs, unknown);
  if (n <= 0) return n == 0;
  double start[N_X];
  for (int i = 0; i < N_X; i++) start[i] = x[i];
  struct num_vec f, j;
  num_vec_init(&f, n, s->ctx);
  num_vec_init(&j, n * n, s->ctx);
  bool near = true, settled = false;
  for (int step = 0; near && !settled && step < MAX_STEPS; step++) {
    for (int i = 0; i < N_X; i++) near = s->ctx.type->set_d(num_vec_at(&s->x, i), x[i], s->ctx.prec) == SS_OK && near;
    near = near && system_eval(s, eqs) == SS_OK;
    gather(&f, &j, s, eq, at, n);
    near = near && num_mat_solve(&f, &j, &f, n, 1) == SS_OK;
    settled = true;
    for (int i = 0; near && i < n; i++) {
      double d = s->ctx.type->get_d(num_vec_at(&f, i));
      x[at[i]] -= d;
      near = fabs(x[at[i]] - start[at[i]]) <= 1 + fabs(start[at[i]]);
      settled = settled && fabs(d) <= 1e-7 * (1 + fabs(x[at[i]])) /* the next step is its square */;
    }
  }
  num_vec_clear(&j);
  num_vec_clear(&f);
  return near && settled;
}

/* --- In balls --- */

struct krawczyk {
  struct system *s;
  unsigned eqs;
  int eq[N_EQ], at[N_X], n;
  struct num_vec mid, step, inverse, f, j, box; /* x, Y f(x), Y; scratch; B */
};

static void krawczyk_init(struct krawczyk *k, struct system *s, unsigned eqs, unsigned unknown) {
  *k = (struct krawczyk){.s = s, .eqs = eqs};
  k->n = lists(k->eq, k->at, eqs, unknown);
  slong n = k->n > 0 ? k->n : 0;
  num_vec_init(&k->mid, n, s->ctx);
  num_vec_init(&k->step, n, s->ctx);
  num_vec_init(&k->f, n, s->ctx);
  num_vec_init(&k->box, n, s->ctx);
  num_vec_init(&k->inverse, n * n, s->ctx);
  num_vec_init(&k->j, n * n, s->ctx);
}

static void krawczyk_clear(struct krawczyk *k) {
  num_vec_clear(&k->j);
  num_vec_clear(&k->inverse);
  num_vec_clear(&k->box);
  num_vec_clear(&k->f);
  num_vec_clear(&k->step);
  num_vec_clear(&k->mid);
}

static bool evaluate_at(struct krawczyk *k, const struct num_vec *unknowns) {
  for (int i = 0; i < k->n; i++) arb_set(num_vec_at(&k->s->x, k->at[i]), num_vec_at(unknowns, i));
  bool ok = system_eval(k->s, k->eqs) == SS_OK;
  if (ok) gather(&k->f, &k->j, k->s, k->eq, k->at, k->n);
  return ok;
}

/* Newton's iteration at exact points, the fixed quantities at their middles. */
static bool settle(struct krawczyk *k, arb_srcptr x) {
  enum { STEPS = 2 }; /* from double precision to more bits than are worked with */
  for (int i = 0; i < N_X; i++) arb_get_mid_arb(num_vec_at(&k->s->x, i), x + i);
  for (int i = 0; i < k->n; i++) arb_get_mid_arb(num_vec_at(&k->mid, i), x + k->at[i]);
  bool ok = true;
  for (int step = 0; ok && step < STEPS; step++) {
    ok = evaluate_at(k, &k->mid) && num_mat_solve(&k->f, &k->j, &k->f, k->n, 1) == SS_OK;
    for (int i = 0; ok && i < k->n; i++) {
      arb_ptr m = num_vec_at(&k->mid, i);
      arb_sub(m, m, num_vec_at(&k->f, i), k->s->ctx.prec);
      arb_get_mid_arb(m, m);
    }
  }
  return ok;
}

/* Y and Y f(x), with the fixed quantities as they are. */
static bool prepare(struct krawczyk *k, arb_srcptr x) {
  if (!evaluate_at(k, &k->mid)) return false;
  struct num_vec unit;
  num_vec_init(&unit, k->n * k->n, k->s->ctx);
  for (int i = 0; i < k->n; i++) arb_one(num_vec_at(&unit, i * k->n + i));
  for (int i = 0; i < k->n * k->n; i++) arb_get_mid_arb(num_vec_at(&k->j, i), num_vec_at(&k->j, i));
  bool ok = num_mat_solve(&k->inverse, &k->j, &unit, k->n, k->n) == SS_OK;
  for (int i = 0; i < k->n * k->n; i++) arb_get_mid_arb(num_vec_at(&k->inverse, i), num_vec_at(&k->inverse, i));
  num_vec_clear(&unit);
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&k->s->x, i), x + i);
  ok = ok && evaluate_at(k, &k->mid);
  return ok && num_mat_mul(&k->step, &k->inverse, &k->f, k->n, k->n, 1) == SS_OK;
}

/* The image of the box. */
static bool image(struct num_vec *out, struct krawczyk *k) {
  slong prec = k->s->ctx.prec;
  if (!evaluate_at(k, &k->box) || num_mat_mul(&k->j, &k->inverse, &k->j, k->n, k->n, k->n) != SS_OK) return false;
  for (int i = 0; i < k->n * k->n; i++) arb_neg(num_vec_at(&k->j, i), num_vec_at(&k->j, i));
  for (int i = 0; i < k->n; i++) {
    arb_ptr d = num_vec_at(&k->j, i * k->n + i);
    arb_add_ui(d, d, 1, prec);
    arb_sub(num_vec_at(&k->f, i), num_vec_at(&k->box, i), num_vec_at(&k->mid, i), prec);
  }
  bool ok = num_mat_mul(out, &k->j, &k->f, k->n, k->n, 1) == SS_OK;
  for (int i = 0; i < k->n; i++) {
    arb_ptr z = num_vec_at(out, i);
    arb_add(z, z, num_vec_at(&k->mid, i), prec);
    arb_sub(z, z, num_vec_at(&k->step, i), prec);
  }
  return ok;
}

/* A box that its image lies inside of, found by making the image of a small one a little larger. */
static bool contract(struct krawczyk *k) {
  enum { TRIES = 14 };
  struct num_vec out;
  num_vec_init(&out, k->n, k->s->ctx);
  num_vec_set(&k->box, &k->mid);
  bool inside = false, ok = true;
  for (int t = 0; ok && !inside && t < TRIES; t++) {
    for (int i = 0; i < k->n; i++) {
      arb_ptr b = num_vec_at(&k->box, i);
      mag_mul_2exp_si(arb_radref(b), arb_radref(b), 1);
      arb_add_error_2exp_si(b, -k->s->ctx.prec / 2);
    }
    ok = image(&out, k);
    inside = ok;
    for (int i = 0; i < k->n; i++)
      inside = inside && arb_contains_interior(num_vec_at(&k->box, i), num_vec_at(&out, i));
    num_vec_set(&k->box, &out);
  }
  if (inside) { /* the image of the image is narrower still */
    for (int i = 0; i < k->n; i++)
      arb_union(num_vec_at(&k->box, i), num_vec_at(&out, i), num_vec_at(&k->mid, i), k->s->ctx.prec);
    inside = image(&out, k);
    num_vec_set(&k->box, &out);
  }
  num_vec_clear(&out);
  return inside;
}

bool readings_enclose(arb_ptr x, struct system *s, unsigned eqs, unsigned unknown) {
  struct krawczyk k;
  krawczyk_init(&k, s, eqs, unknown);
  bool ok = k.n == 0 || (k.n > 0 && settle(&k, x) && prepare(&k, x) && contract(&k));
  for (int i = 0; ok && i < k.n; i++) arb_set(x + k.at[i], num_vec_at(&k.box, i));
  krawczyk_clear(&k);
  return ok;
}

bool readings_slopes(arb_ptr by_known, arb_ptr by_equation, struct system *s, arb_srcptr x, unsigned eqs,
                     unsigned unknown) {
  int eq[N_EQ], at[N_X], n = lists(eq, at, eqs, unknown);
  if (n <= 0) return false;
  struct num_vec f, j, right;
  num_vec_init(&f, n, s->ctx);
  num_vec_init(&j, n * n, s->ctx);
  num_vec_init(&right, n * (N_X + n), s->ctx); /* minus the derivative by every quantity; the unit matrix */
  for (int i = 0; i < N_X; i++) arb_set(num_vec_at(&s->x, i), x + i);
  bool ok = system_eval(s, eqs) == SS_OK;
  gather(&f, &j, s, eq, at, n);
  for (int i = 0; i < n; i++) {
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
  num_vec_clear(&right);
  num_vec_clear(&j);
  num_vec_clear(&f);
  return ok;
}
