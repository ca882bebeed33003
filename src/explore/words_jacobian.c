/* The Jacobian of a word's return, and whether its eigenvalues lie inside the unit circle.

   Saltation: a perturbation of a free coordinate is carried at equal times through each phase and across each event by
   delta + (f+ - f-) n.delta/(n.f-), f- and f+ the vector fields before and after, n the gradient of the event's
   function; at the end of the period it is taken back along f+ to its own event.  No derivative of an event's time is
   formed, and nothing of the equations that were solved. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "motion/differences.h"
#include "words_impl.h"

/* Across the end of the phase, from the state at the end of the phase, not yet settled, to that of the next. */
static void cross(val delta[N_STATE], struct calc *c, const struct word_law *m, const struct phase_word *w, int phase,
                  const val before[N_STATE], const val after[N_STATE]) {
  struct word_event e = word_event_of(w, phase);
  int next = (phase + 1) % w->n;
  val f[N_STATE], g[N_STATE];
  word_field(f, c, m, w->mode[phase], before);
  word_field(g, c, m, w->mode[next], after);
  val lead = calc_div(c, word_event_slope(&e, delta), word_event_slope(&e, f));
  for (int i = 0; i < N_STATE; i++) {
    delta[i] = calc_add(c, delta[i], calc_mul(c, calc_sub(c, g[i], f[i]), lead));
    if (next == 0) delta[i] = calc_sub(c, delta[i], calc_mul(c, g[i], lead));
  }
}

static void carry(val delta[N_STATE], struct calc *c, const struct word_law *m, const struct word_orbit *o) {
  for (int p = 0; p < o->word.n; p++) {
    const enum coulomb_mode *mode = o->word.mode[p];
    val start[N_STATE], before[N_STATE], after[N_STATE];
    struct motion motion;
    for (int i = 0; i < N_STATE; i++) {
      start[i] = o->state + N_STATE * p + i;
      after[i] = o->state + N_STATE * ((p + 1) % o->word.n) + i;
    }
    word_motion(&motion, c, m, mode, start, false);
    word_motion_at(before, c, &motion, o->t + p);
    word_settle(delta, m, mode);
    word_motion(&motion, c, m, mode, delta, true);
    word_motion_at(delta, c, &motion, o->t + p);
    cross(delta, c, m, &o->word, p, before, after);
  }
}

static void characteristic(arb_poly_t p, arb_srcptr j, int n, slong prec) {
  arb_mat_t m;
  arb_mat_init(m, n, n);
  for (int i = 0; i < n * n; i++) arb_set(arb_mat_entry(m, i / n, i % n), j + i);
  arb_mat_charpoly(p, m, prec);
  arb_mat_clear(m);
}

/* The coefficients of det(x - J) = x^n + a[n-1] x^(n-1) + ... + a[0]. */
static void coefficients(val a[WORD_FREE_MOST], struct calc *c, arb_srcptr j, int n) {
  arb_poly_t p;
  arb_poly_init(p);
  characteristic(p, j, n, c->ctx.prec);
  for (int i = 0; i < n; i++) {
    arb_ptr x = calc_new(c);
    arb_poly_get_coeff_arb(x, p, i);
    a[i] = x;
  }
  arb_poly_clear(p);
}

static int by_place(const void *x, const void *y) {
  const acb_struct *a = x, *b = y;
  if (arb_overlaps(acb_realref(a), acb_realref(b)))
    return arf_cmp(arb_midref(acb_imagref(a)), arb_midref(acb_imagref(b)));
  return arf_cmp(arb_midref(acb_realref(a)), arb_midref(acb_realref(b)));
}

int word_eigenvalues(acb_ptr z, arb_srcptr j, int n, slong prec) {
  arb_poly_t real;
  acb_poly_t p;
  arb_poly_init(real);
  acb_poly_init(p);
  characteristic(real, j, n, prec);
  acb_poly_set_arb_poly(p, real);
  bool known = acb_poly_find_roots(z, p, NULL, 0, prec) == n && acb_poly_validate_real_roots(z, p, prec);
  for (int i = 0; i < n; i++)
    if (known && arb_contains_zero(acb_imagref(z + i))) arb_zero(acb_imagref(z + i));
  if (known) qsort(z, (size_t)n, sizeof *z, by_place);
  acb_poly_clear(p);
  arb_poly_clear(real);
  return known ? SS_OK : SS_UNABLE;
}

static val sum_of(struct calc *c, const val a[], int n, int sign) {
  val s = calc_d(c, 1);
  for (int i = n - 1; i >= 0; i--) {
    bool minus = sign < 0 && (n - i) % 2;
    s = minus ? calc_sub(c, s, a[i]) : calc_add(c, s, a[i]);
  }
  return s;
}

/* Jury's conditions for all roots inside the unit circle; n is 1, 2 or 3. */
static truth inside_circle(struct calc *c, const val a[WORD_FREE_MOST], int n) {
  val zero = calc_d(c, 0), one = calc_d(c, 1);
  truth t = truth_and(num_arb.lt(zero, sum_of(c, a, n, 1)), num_arb.lt(zero, sum_of(c, a, n, -1)));
  if (n == 1) return t;
  t = truth_and(t, num_arb.lt(calc_abs(c, a[0]), one));
  if (n == 2) return t;
  val square = calc_sub(c, one, calc_mul(c, a[0], a[0])), mixed = calc_sub(c, a[1], calc_mul(c, a[0], a[2]));
  return truth_and(t, num_arb.lt(calc_abs(c, mixed), square));
}

int word_jacobian(struct word_orbit *o, struct calc *c, const struct word_law *m) {
  slong mark = calc_mark(c);
  int n = o->n_free;
  c->status = SS_OK;
  for (int k = 0; k < n; k++) {
    val delta[N_STATE];
    for (int i = 0; i < N_STATE; i++) delta[i] = i == (int)o->free[k] ? calc_d(c, 1) : m->law.zero;
    carry(delta, c, m, o);
    for (int i = 0; i < n; i++) arb_set(o->jacobian + i * n + k, delta[o->free[i]]);
  }
  val a[WORD_FREE_MOST];
  coefficients(a, c, o->jacobian, n);
  arb_neg(o->trace, a[n - 1]);
  arb_set(o->det, a[0]);
  if (n % 2) arb_neg(o->det, o->det);
  o->stable = inside_circle(c, a, n);
  int status = c->status;
  calc_release(c, mark);
  return status;
}

/* --- Differences of simulations. --- */

struct replay {
  const struct word_orbit *o;
  double params[N_COULOMB], state[N_STATE]; /* w1, w2, p1, p2 at the entry */
  bool ode;
  int event;
  bool follows;
};

static bool watch(void *self, const struct coulomb_event *e) {
  struct replay *r = self;
  const enum coulomb_mode *mode = r->o->word.mode[(r->event + 1) % r->o->word.n];
  r->follows = r->follows && e->at.mode[0] == mode[0] && e->at.mode[1] == mode[1];
  r->event++;
  return r->follows;
}

/* From the free coordinates to those at the return. */
static int replay_run(double *out, const double *x, const void *self) {
  struct replay r = *(const struct replay *)self;
  const double *p = r.params;
  double s[N_STATE], start[N_STATE];
  for (int i = 0; i < N_STATE; i++) s[i] = r.state[i];
  for (int i = 0; i < r.o->n_free; i++) s[r.o->free[i]] = x[i];
  double f1 = s[WORD_W1] + p[COULOMB_US1], f2 = s[WORD_W2] + p[COULOMB_US2];
  start[Z_1] = (f1 + f2) / (1 - p[COULOMB_CHI]);
  start[Z_2] = start[Z_1] + f2 / p[COULOMB_CHI];
  /* at V the law itself finds the first phase: it starts at a limit, a capture or a passage */
  for (int i = 0; i < 2; i++) start[DZ_1 + i] = p[COULOMB_V] + s[WORD_P1 + i];
  struct coulomb_plan plan = coulomb_plan_default;
  struct coulomb_result result;
  struct coulomb_sink sink = {&r, watch, NULL};
  plan.duration = INFINITY;
  plan.returns = LONG_MAX;
  plan.max_events = r.o->word.n;
  int status = r.ode ? coulomb_simulate_ode(&result, p, start, &plan, &sink)
                     : coulomb_simulate_d(&result, p, start, &plan, &sink);
  if ((status & SS_DOMAIN) || !r.follows || r.event != r.o->word.n) return SS_DOMAIN;
  double end[N_STATE] = {result.at.x[0] - p[COULOMB_CHI] * result.at.x[1] - p[COULOMB_US1],
                         p[COULOMB_CHI] * (result.at.x[1] - result.at.x[0]) - p[COULOMB_US2],
                         result.at.v[0] - p[COULOMB_V], result.at.v[1] - p[COULOMB_V]};
  for (int i = 0; i < r.o->n_free; i++) out[i] = end[r.o->free[i]];
  return SS_OK;
}

int word_jacobian_differences(double *j, double *err, const struct word_orbit *o, const fmpq *params,
                              const fmpq *const u_r[2], bool ode) {
  struct replay r = {.o = o, .ode = ode, .follows = true};
  double x[WORD_FREE_MOST], scale = 0;
  for (int i = 0; i < 3; i++) r.params[COULOMB_CHI + i] = fmpq_get_d(params + P_CHI + i);
  for (int i = 0; i < 2; i++) {
    double e = fmpq_get_d(params + P_E1 + i), least = num_arb.get_d(o->u_r_min[i]);
    r.params[COULOMB_UR1 + i] = u_r[i] ? fmpq_get_d(u_r[i]) : 1.25 * fmax(e, least);
    r.params[COULOMB_US1 + i] = r.params[COULOMB_UR1 + i] - e;
  }
  for (int i = 0; i < N_STATE; i++) {
    r.state[i] = num_arb.get_d(o->state + i);
    scale = fmax(scale, fabs(r.state[i]));
  }
  for (int i = 0; i < o->n_free; i++) x[i] = r.state[o->free[i]];
  struct double_map map = {replay_run, &r, o->n_free, o->n_free, scale, ode ? 1e-12 : 1e-14, 0};
  int status = SS_OK;
  *err = 0;
  for (int k = 0; k < o->n_free && !status; k++) {
    double column[N_STATE], dir[N_STATE] = {0}, off[N_STATE];
    dir[k] = 1;
    status = differences_along(column, off, &map, x, dir);
    for (int i = 0; i < o->n_free; i++) j[i * o->n_free + k] = column[i];
    *err = fmax(*err, off[0]);
  }
  return status;
}
