/* An orbit proved near a guess: the steps of orbit.h, one after the other. */
#include "orbit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "equations.h"
#include "num/pi.h"
#include "num/solve.h"

/* Steps of Newton; bits in double precision; those of the last attempt over those of the first; boxes over boxes of
   parameters get wider by 2^WIDER of their radii. */
enum { MOST_STEPS = 60, DOUBLE_BITS = 64, MOST_TIMES = 8, WIDER = -3 };

const char *const mech_rule_name[MECH_BEYOND + 1] = {"length",    "slower",   "faster",  "break",
                                                     "break_low", "obstacle", "contact", "beyond"};

void mech_fact_print(struct text *out, const struct mech *m, const struct mech_fact *f, const char *phase) {
  text_printf(out, "%d-%s%s", f->phase + 1, phase ? phase : "", phase ? "-" : "");
  if (f->rule != MECH_LENGTH) text_printf(out, "%s-", m->mass[f->mass].name);
  text_add(out, mech_rule_name[f->rule]);
}

/* --- Existence and uniqueness --- */

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct mech_equations *e = self;
  slong n = x->len;
  mech_equations_at(e, num_vec_at(x, 0));
  for (slong i = 0; i < n; i++) {
    if (f) f[i] = arb_mat_entry(e->value, i, 0);
    for (slong l = 0; l < n; l++) j[i * n + l] = arb_mat_entry(e->slope, i, l);
  }
  return e->rough && !arb_mat_is_finite(e->state[e->w->n]) ? SS_DOMAIN : SS_OK;
}

/* x: from a guess to where Newton's steps stop shrinking.  First in double precision, which most guesses do not
   survive; where its numbers are too large, in balls from the guess. */
static int settle(struct num_vec *x, const struct solve_system *system, struct mech_equations *e) {
  slong prec = e->prec;
  OWNED(num_vec) near;
  num_vec_init(&near, x->len, num_ctx_arb(DOUBLE_BITS));
  num_vec_set(&near, x);
  e->rough = true;
  e->prec = DOUBLE_BITS;
  int status = newton_settle(&near, system, MOST_STEPS);
  e->rough = false;
  e->prec = prec;
  if (!status) num_vec_set(x, &near);
  return status == SS_OK || status & SS_DOMAIN ? newton_settle(x, system, MOST_STEPS) : status;
}

/* Over a box, with x near the solution at its middle: what Newton's step there is for all points.  F is there F at the
   middle, and with its derivatives F_i by delta_i over the box, Y F_i before it is multiplied by delta_i. */
static int centre_over(struct krawczyk *k, struct num_vec *x, struct mech_equations *e) {
  struct mech middle = *e->m; /* borrowed */
  struct solve_system system = {x->len, values, NULL};
  const struct solve_system *over = k->system;
  middle.n_intervals = 0;
  OWNED(mech_equations) at_middle;
  mech_equations_init(&at_middle, &middle, e->w, e->turns, e->prec);
  system.self = &at_middle;
  k->system = &system;
  int status = newton_settle(x, &system, MOST_STEPS);
  if (!status) status = krawczyk_centre(k, x);
  k->system = over;
  if (status) return status;
  e->along = true;
  mech_equations_at(e, num_vec_at(x, 0));
  e->along = false;
  NUMBERS(arb, z);
  for (slong l = 0; l < x->len; l++)
    for (int i = 0; i < e->m->n_intervals; i++) {
      arb_dot(z, NULL, 0, arb_mat_entry(k->y, l, 0), 1, arb_mat_entry(e->slope, 0, x->len + i), arb_mat_ncols(e->slope),
              x->len, e->prec);
      arb_add_error(arb_mat_entry(k->step, l, 0), z);
    }
  return SS_OK;
}

/* x: from a guess to the image of a proved box; beside: from an orbit next to it. */
static int enclose(struct num_vec *x, struct num_vec *box, struct mech_equations *e, bool beside) {
  struct solve_system system = {x->len, values, e};
  OWNED(krawczyk) k;
  krawczyk_init(&k, &system, e->prec);
  int status;
  if (e->m->n_intervals) {
    status = centre_over(&k, x, e);
    if (!status) status = krawczyk_follow(&k, WIDER);
  } else {
    status = beside ? newton_settle(x, &system, MOST_STEPS) : settle(x, &system, e);
    if (!status) status = krawczyk_centre(&k, x);
    if (!status) status = krawczyk_grow(&k);
  }
  if (!status) num_vec_set(x, &k.image);
  if (!status) num_vec_set(box, &k.box);
  return status;
}

/* --- Multipliers --- */

/* dR/dq - dR/dt (dG/dt)^-1 dG/dq, where G are the events, R the return and q what is free. */
static bool return_jacobian(arb_mat_t out, const struct mech_equations *e) {
  int phases = e->w->n, n = e->n_free;
  SIZED(arb_mat, gt, phases, phases);
  SIZED(arb_mat, gq, phases, n);
  SIZED(arb_mat, rt, n, phases);
  for (int k = 0; k < phases; k++) {
    for (int l = 0; l < phases; l++) arb_set(arb_mat_entry(gt, k, l), arb_mat_entry(e->slope, k, l));
    for (int l = 0; l < n; l++) arb_set(arb_mat_entry(gq, k, l), arb_mat_entry(e->slope, k, phases + l));
    for (int l = 0; l < n; l++) arb_set(arb_mat_entry(rt, l, k), arb_mat_entry(e->slope, phases + l, k));
  }
  bool ok = arb_mat_solve(gq, gt, gq, e->prec);
  if (ok) arb_mat_mul(out, rt, gq, e->prec);
  for (int i = 0; ok && i < n; i++)
    for (int l = 0; l < n; l++) {
      arb_ptr z = arb_mat_entry(out, i, l);
      arb_sub(z, arb_mat_entry(e->slope, phases + i, phases + l), z, e->prec);
      if (i == l) arb_add_ui(z, z, 1, e->prec); /* slope has that of R - q */
    }
  return ok;
}

static int by_modulus(const void *a, const void *b) {
  NUMBERS(arb, x, y);
  acb_abs(x, a, 64);
  acb_abs(y, b, 64);
  int c = arf_cmp(arb_midref(y), arb_midref(x));
  if (c == 0) c = -arf_cmp(arb_midref(acb_imagref((acb_srcptr)a)), arb_midref(acb_imagref((acb_srcptr)b)));
  return c;
}

/* An eigenvalue of a real matrix is real where the conjugate of its ball meets no ball but itself. */
static void make_real(acb_ptr z, slong n) {
  NUMBERS(acb, mirrored);
  for (slong i = 0; i < n; i++) {
    acb_conj(mirrored, z + i);
    bool real = acb_overlaps(mirrored, z + i);
    for (slong l = 0; l < n; l++) real = real && (l == i || !acb_overlaps(mirrored, z + l));
    if (real) arb_zero(acb_imagref(z + i));
  }
}

bool mech_eigenvalues(acb_ptr z, const arb_mat_t a, slong prec) {
  slong n = arb_mat_nrows(a);
  SIZED(acb_mat, c, n, n);
  SIZED(acb_mat, right, n, n);
  acb_mat_set_arb_mat(c, a);
  acb_mat_approx_eig_qr(z, NULL, right, c, NULL, 0, prec);
  acb_ptr near = _acb_vec_init(n);
  _acb_vec_set(near, z, n);
  bool ok = acb_mat_eig_simple(z, NULL, NULL, c, near, right, prec) || acb_mat_eig_multiple(z, c, near, right, prec);
  _acb_vec_clear(near, n);
  if (ok) {
    make_real(z, n);
    qsort(z, (size_t)n, sizeof *z, by_modulus);
  }
  return ok;
}

truth mech_all_inside(acb_srcptr z, int n) {
  truth stable = TRUTH_TRUE;
  NUMBERS(arb, size);
  for (int i = 0; i < n; i++) {
    acb_abs(size, z + i, 128);
    arb_sub_ui(size, size, 1, 128);
    stable = truth_and(stable, mech_holds(size));
  }
  return stable;
}

/* --- An orbit --- */

static void orbit_init(struct mech_orbit *o, const struct mech *m, const struct mech_word *w) {
  *o = (struct mech_orbit){
      .word = *w, .n = m->n, .states = m->states, .own = TRUTH_UNKNOWN, .admissible = TRUTH_UNKNOWN};
  o->n_free = mech_free(o->free, m, w);
  o->t = _arb_vec_init(w->n);
  o->state = _arb_vec_init((slong)w->n * m->states);
  arb_mat_init(o->jacobian, o->n_free, o->n_free);
  o->box = _arb_vec_init(w->n + o->n_free);
  o->multiplier = _acb_vec_init(o->n_free);
}

bool mech_orbit_is_motion(const struct mech_orbit *o) {
  return o->certified && o->admissible == TRUTH_TRUE;
}

void mech_orbit_clear(struct mech_orbit *o) {
  _arb_vec_clear(o->t, o->word.n);
  _arb_vec_clear(o->state, (slong)o->word.n * o->states);
  arb_clear(o->period);
  arb_clear(o->angle);
  arb_mat_clear(o->jacobian);
  _arb_vec_clear(o->box, o->word.n + o->n_free);
  _acb_vec_clear(o->multiplier, o->n_free);
  free(o->fact);
  if (o->over) mech_orbit_clear(o->over);
  free(o->over);
}

/* Everything but the facts, from the enclosed unknowns. */
static void describe(struct mech_orbit *o, struct mech_equations *e, arb_srcptr x) {
  mech_equations_at(e, x);
  for (int k = 0; k < o->word.n; k++) {
    arb_set(o->t + k, x + k);
    arb_add(o->period, o->period, x + k, e->prec);
    for (int i = 0; i < o->states; i++) arb_set(o->state + k * o->states + i, arb_mat_entry(e->state[k], i, 0));
  }
  if (o->states > 2 * o->n) arb_set(o->angle, x + o->word.n + o->n_free - 1);
  o->turns = e->turns;
  bool known = true;
  if (e->m->n_intervals)
    mech_saltation(o->jacobian, e, o); /* wide balls grow less in it */
  else
    known = return_jacobian(o->jacobian, e);
  o->multipliers = known && mech_eigenvalues(o->multiplier, o->jacobian, e->prec);
  o->stable = o->multipliers ? mech_all_inside(o->multiplier, o->n_free) : TRUTH_UNKNOWN;
}

void mech_orbit_conclude(struct mech_orbit *o) {
  bool settled = true;
  o->own = o->admissible = TRUTH_TRUE;
  for (int i = 0; i < o->n_facts; i++) {
    const struct mech_fact *f = &o->fact[i];
    if (f->ends || f->rule == MECH_LENGTH) o->own = truth_and(o->own, f->holds);
    o->admissible = truth_and(o->admissible, f->holds);
    settled = settled && f->holds != TRUTH_UNKNOWN;
  }
  if (o->own != TRUTH_TRUE) o->stable = TRUTH_UNKNOWN; /* its return map is that of other phases */
  o->certified = settled && o->stable != TRUTH_UNKNOWN;
}

int mech_best_turn(const struct mech *m, const struct mech_word *w) {
  int free[MECH_STATES], least = mech_free(free, m, w), by = 0;
  for (int k = 1; k < w->n; k++) {
    struct mech_word turned;
    mech_word_turn(&turned, w, k);
    int n = mech_free(free, m, &turned);
    if (n >= least) continue;
    least = n;
    by = k;
  }
  return by;
}

/* The unknowns of the equations at such lengths and such a state. */
static void set_unknowns(arb_ptr x, const struct mech_equations *e, const double *t, const double *z) {
  int angle = 2 * e->m->n;
  for (int k = 0; k < e->w->n; k++) arb_set_d(x + k, t[k]);
  for (int l = 0; l < e->n_free; l++)
    arb_set_d(x + e->w->n + l, e->free[l] < angle ? z[e->free[l]] : atan2(z[angle + 1], z[angle]));
}

void mech_word_best(struct mech_word *w, double *t, double *z, const struct mech *m) {
  double lengths[MECH_PHASES];
  int by = mech_best_turn(m, w);
  if (by == 0) return;
  OWNED(mech_equations) e;
  mech_equations_init(&e, m, w, 0, 64);
  ARB_VECTOR(x, w->n + e.n_free);
  set_unknowns(x, &e, t, z);
  mech_equations_at(&e, x);
  for (int i = 0; i < m->states; i++) z[i] = num_arb.get_d(arb_mat_entry(e.state[by], i, 0));
  memcpy(lengths, t, (size_t)w->n * sizeof *t);
  for (int k = 0; k < w->n; k++) t[k] = lengths[(k + by) % w->n];
  mech_word_turn(w, w, by);
}

/* How often the loads turn in about the sum of the lengths. */
static slong turns_in(const struct mech *m, const double *t, int n) {
  double sum = 0;
  for (int k = 0; k < n; k++) sum += t[k];
  return m->n_loads ? lround(fmin(fabs(sum * fmpq_get_d(m->frequency)) / (2 * PI), 1e9)) : 0;
}

/* Beside an orbit no step is made in double precision: where two orbits nearly merge its rounding alone leads from one
   to the other. */
static int orbit_from(struct mech_orbit *o, const struct mech *m, const struct mech_word *w, const double *t,
                      const double *z, bool beside, slong prec) {
  if (!mech_word_is_of(w, m)) return SS_DOMAIN;
  OWNED(mech_equations) e;
  mech_equations_init(&e, m, w, turns_in(m, t, w->n), prec);
  int status = w->n + e.n_free <= SOLVE_MOST && (e.turns > 0 || !m->n_loads) ? SS_OK : SS_UNABLE;
  OWNED(num_vec) x, box;
  num_vec_init(&x, w->n + e.n_free, num_ctx_arb(prec));
  num_vec_init(&box, w->n + e.n_free, num_ctx_arb(prec));
  set_unknowns(num_vec_at(&x, 0), &e, t, z);
  for (slong i = 0; i < x.len; i++)
    if (!arb_is_finite(num_vec_at(&x, i))) status = SS_UNABLE;
  if (!status) status = enclose(&x, &box, &e, beside);
  if (!status) {
    orbit_init(o, m, w);
    describe(o, &e, num_vec_at(&x, 0));
    _arb_vec_set(o->box, num_vec_at(&box, 0), x.len);
  }
  return status;
}

int mech_orbit_near(struct mech_orbit *o, const struct mech *m, const struct mech_word *w, const double *t,
                    const double *z, slong prec) {
  return orbit_from(o, m, w, t, z, false, prec);
}

void mech_orbit_judge(struct mech_orbit *o, const struct mech *m, slong prec) {
  OWNED(mech_equations) e;
  ARB_VECTOR(x, o->word.n + o->n_free);
  mech_equations_init(&e, m, &o->word, o->turns, prec);
  _arb_vec_set(x, o->t, o->word.n);
  for (int l = 0; l < o->n_free; l++)
    arb_set(x + o->word.n + l, o->free[l] < 2 * o->n ? o->state + o->free[l] : o->angle);
  mech_equations_at(&e, x);
  mech_judge(o, &e);
  mech_orbit_conclude(o);
}

int mech_orbit_beside(struct mech_orbit *o, const struct mech *m, const struct mech_orbit *near, slong prec) {
  double t[MECH_PHASES], z[MECH_STATES];
  for (int k = 0; k < near->word.n; k++) t[k] = num_arb.get_d(near->t + k);
  for (int i = 0; i < near->states; i++) z[i] = num_arb.get_d(near->state + i);
  return orbit_from(o, m, &near->word, t, z, true, prec);
}

void mech_orbit_decide(struct mech_orbit *o, const struct mech *m, slong prec) {
  mech_orbit_judge(o, m, prec);
  for (int times = 2; !o->certified && o->own != TRUTH_FALSE && times <= MOST_TIMES; times *= 2) {
    struct mech_orbit finer;
    if (mech_orbit_beside(&finer, m, o, times * prec) != SS_OK) return;
    mech_orbit_judge(&finer, m, times * prec);
    mech_orbit_clear(o);
    *o = finer;
  }
}
