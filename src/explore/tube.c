/* One orbit over a box of parameters.

   Krawczyk's operator around the orbit at the middle of the box.  The residual over the box is bounded by its mean
   value form in the parameters, and the box of unknowns grows until the operator maps it into its interior. */
#include <math.h>
#include <stdlib.h>

#include "curve.h"
#include "motion/orbit_judge.h"
#include "num/solve.h"

void tube_clear(struct tube *t) {
  for (int i = 0; i < N_PARAMS; i++) arb_clear(&t->p[i]);
  for (int i = 0; i < 2; i++) {
    arb_clear(&t->x[i]);
    arb_clear(&t->box[i]);
  }
}

void tube_set(struct tube *t, const struct tube *s) {
  for (int i = 0; i < N_PARAMS; i++) arb_set(&t->p[i], &s->p[i]);
  for (int i = 0; i < 2; i++) {
    arb_set(&t->x[i], &s->x[i]);
    arb_set(&t->box[i], &s->box[i]);
  }
  t->up = s->up;
}

/* The same at the middle of the parameters, not proved. */
static void tube_init_middle(struct tube *m, const struct tube *t) {
  *m = (struct tube){.up = false};
  tube_set(m, t);
  for (int i = 0; i < N_PARAMS; i++) arb_get_mid_arb(&m->p[i], &t->p[i]);
}

/* The pass at (p, x), p's midpoints when middle; slopes along the parameters that are not exact, if wanted. */
static void look(struct ball_pass *s, struct calc *c, struct ball_params *m, const struct tube *t, arb_srcptr x,
                 bool middle) {
  val p[N_PARAMS];
  NUMBERS(arb, mid);
  for (int i = 0; i < N_PARAMS; i++) {
    arb_get_mid_arb(mid, &t->p[i]);
    p[i] = dual_variable(c, middle ? mid : &t->p[i], middle || arb_is_exact(&t->p[i]) ? -1 : i);
  }
  ball_params_make(m, c, p);
  ball_pass_make(s, c, m, dual_variable(c, x, DIR_TB), dual_variable(c, x + 1, DIR_TC), t->up);
}

/* The two equations as a system in (t_b, t_c), for every point of the tube's parameters or at their middle alone. */
struct equations {
  const struct tube *t;
  struct calc c;
  bool middle;
  int quiet; /* small steps of Newton's iteration on end */
};

/* f += dF/dp (p - p0), dF/dp over the box of parameters: the values there by their mean value form. */
static void spread(const void **f, struct equations *e, arb_srcptr x) {
  struct ball_params m;
  struct ball_pass s;
  NUMBERS(arb, off);
  look(&s, &e->c, &m, e->t, x, false);
  const val all[2] = {s.pc, s.defect};
  for (int k = 0; k < 2; k++) {
    struct dual *sum = calc_new(&e->c);
    arb_set(&sum->v, f[k]);
    for (int i = 0; i < N_PARAMS; i++) {
      mag_set(arb_radref(off), arb_radref(&e->t->p[i]));
      arb_addmul(&sum->v, dual_slope(all[k], i), off, e->c.ctx.prec);
    }
    f[k] = &sum->v;
  }
}

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct equations *e = self;
  struct ball_params m;
  struct ball_pass s;
  calc_release(&e->c, 0);
  e->c.status = SS_OK;
  look(&s, &e->c, &m, e->t, num_vec_at(x, 0), e->middle || f);
  const val both[2] = {s.pc, s.defect};
  for (int i = 0; i < 2; i++) {
    if (f) f[i] = dual_value(both[i]);
    for (int k = 0; k < 2; k++) j[2 * i + k] = dual_slope(both[i], DIR_TB + k);
  }
  if (f && !e->middle && !e->c.status) spread(f, e, num_vec_at(x, 0));
  return e->c.status;
}

static enum newton_next settles(const struct num_vec *x, const struct num_vec *step, void *self) {
  struct equations *e = self;
  e->quiet++;
  for (int k = 0; k < 2; k++) {
    arf_srcptr by = arb_midref((arb_srcptr)num_vec_at(step, k)), at = arb_midref((arb_srcptr)num_vec_at(x, k));
    if (arf_is_zero(by)) continue;
    if (arf_is_zero(at) || arf_abs_bound_lt_2exp_si(by) > arf_abs_bound_lt_2exp_si(at) - x->ctx.prec / 2) e->quiet = 0;
  }
  return e->quiet == 2 ? NEWTON_LAST : NEWTON_ON;
}

/* Newton's iteration from the midpoints of x at the midpoints of p; then the operator. */
int tube_prove(struct tube *t, slong prec) {
  struct equations e = {.t = t, .middle = true, .c = calc_begin(dual_ctx(prec))};
  struct solve_system system = {2, values, &e};
  struct num_vec x = {num_ctx_arb(prec), 2, (char *)t->x};
  OWNED(krawczyk) k;
  krawczyk_init(&k, &system, prec);
  for (int i = 0; i < 2; i++) arb_get_mid_arb(&t->x[i], &t->x[i]);
  int status = newton_run(&x, &system, x.ctx, 60, settles);
  e.middle = false;
  if (!status) status = krawczyk_centre(&k, &x);
  if (!status) status = krawczyk_follow(&k, -3);
  for (int i = 0; i < 2 && !status; i++) {
    arb_swap(&t->x[i], num_vec_at(&k.image, i));
    arb_swap(&t->box[i], num_vec_at(&k.box, i));
  }
  calc_clear(&e.c);
  return status;
}

bool tube_motion(arb_mat_t dx, const struct ball_pass *s, int param, slong prec) {
  const val f[2] = {s->pc, s->defect};
  SIZED(arb_mat, j, 2, 2);
  for (int i = 0; i < 2; i++) {
    arb_neg(arb_mat_entry(dx, i, 0), dual_slope(f[i], param));
    for (int k = 0; k < 2; k++) arb_set(arb_mat_entry(j, i, k), dual_slope(f[i], DIR_TB + k));
  }
  return arb_mat_solve(dx, j, dx, prec) != 0;
}

double tube_reach(const struct tube *t, int param, slong prec) {
  struct ball_params m;
  struct ball_pass s;
  OWNED(tube) narrow;
  double reach = 0;
  SIZED(arb_mat, dx, 2, 1);
  tube_init_middle(&narrow, t);
  for (int k = 0; k < 2; k++) arb_get_mid_arb(&narrow.x[k], &t->x[k]);
  mag_set_ui_2exp_si(arb_radref(&narrow.p[param]), 1, -prec); /* so that its slopes are carried */
  OWNED(calc) c = calc_begin(dual_ctx(prec));
  look(&s, &c, &m, &narrow, narrow.x, false);
  if (!c.status && tube_motion(dx, &s, param, prec))
    for (int k = 0; k < 2; k++) reach += fabs(num_arb.get_d(arb_mat_entry(dx, k, 0)));
  return reach * mag_get_d(arb_radref(&t->p[param]));
}

/* --- Mean value forms. --- */

enum { SHARP = 5 };

/* The numbers that are worth it: trace, t_a, t_d, z10, z20. */
static void sharp_numbers(val out[SHARP], struct calc *c, const struct ball_params *m, const struct ball_pass *s) {
  struct ball_ending e;
  ball_ending_make(&e, c, m, s);
  ball_positions(out + 3, c, m, e.wf, s->r);
  out[0] = calc_add(c, calc_div(c, s->defect_tb, s->pb), m->one);
  out[1] = e.ta;
  out[2] = e.td;
}

/* number = its value at the middle of the parameters + the sum of its slopes along the orbits times p - p0. */
static bool mean_values(arb_ptr number, const struct tube *t, const struct tube *middle, slong prec) {
  struct ball_params m;
  struct ball_pass s;
  val at[SHARP], all[SHARP];
  NUMBERS(arb, slope, off);
  SIZED(arb_mat, dx, 2, 1);
  OWNED(calc) c = calc_begin(dual_ctx(prec));
  look(&s, &c, &m, middle, middle->x, false);
  sharp_numbers(at, &c, &m, &s);
  look(&s, &c, &m, t, t->x, false);
  sharp_numbers(all, &c, &m, &s);
  bool ok = !c.status;
  for (int n = 0; n < SHARP && ok; n++) arb_set(number + n, dual_value(at[n]));
  for (int i = 0; i < N_PARAMS && ok; i++) {
    if (arb_is_exact(&t->p[i])) continue;
    ok = tube_motion(dx, &s, i, prec);
    arb_sub(off, &t->p[i], &middle->p[i], prec);
    for (int n = 0; n < SHARP && ok; n++) {
      arb_set(slope, dual_slope(all[n], i));
      for (int k = 0; k < 2; k++) arb_addmul(slope, dual_slope(all[n], DIR_TB + k), arb_mat_entry(dx, k, 0), prec);
      arb_addmul(number + n, slope, off, prec);
    }
  }
  return ok;
}

void tube_sharpen(struct dyn_orbit *o, const struct tube *t, slong prec) {
  OWNED(tube) middle;
  arb_ptr number = _arb_vec_init(SHARP), of[SHARP] = {o->trace, o->t[PHASE_D], o->t[PHASE_C], o->z10, o->z20};
  tube_init_middle(&middle, t);
  bool ok = tube_prove(&middle, prec) == SS_OK && arb_contains(&t->box[0], &middle.x[0]) &&
            arb_contains(&t->box[1], &middle.x[1]) && mean_values(number, t, &middle, prec);
  for (int n = 0; n < SHARP && ok; n++)
    if (!arb_intersection(of[n], of[n], number + n, prec)) abort(); /* two enclosures of the same */
  if (ok) {
    arb_zero(o->period);
    for (int i = 0; i < N_PHASES; i++) arb_add(o->period, o->period, o->t[i], prec);
    num_arb.abs(o->margin, o->trace, prec);
    arb_sub_si(o->margin, o->margin, 1, prec);
    o->stable = arb_is_negative(o->margin) ? TRUTH_TRUE : arb_is_positive(o->margin) ? TRUTH_FALSE : TRUTH_UNKNOWN;
    o->holds[COND_TA] = num_ball_positive(o->t[PHASE_D]);
    if (!t->up) o->holds[COND_C_W] = o->holds[COND_TA]; /* w rises in phase C, up to e1 - a t_a */
  }
  _arb_vec_clear(number, SHARP);
}

/* All of them at once. */
static void params_of(struct ball_params *m, struct calc *c, const struct tube *t) {
  val p[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) p[i] = &t->p[i];
  ball_params_make(m, c, p);
}

int tube_orbit(struct dyn_orbit *o, truth *word, const struct tube *t, slong prec) {
  struct ball_params m;
  struct ball_pass s;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  params_of(&m, &c, t);
  ball_pass_make(&s, &c, &m, &t->x[0], &t->x[1], t->up);
  int status = dyn_orbit_describe(o, &c, &m, &s);
  *word = status ? TRUTH_UNKNOWN : dyn_orbit_judge(o, &c, &m, &s, dyn_limits_default.max_steps);
  o->grazing = *word == TRUTH_UNKNOWN;
  return status;
}

truth tube_touches(const struct tube *t, slong prec) {
  struct ball_params m;
  struct ball_pass s;
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  params_of(&m, &c, t);
  ball_pass_slip(&s, &c, &m, &t->x[0], &t->x[1]);
  return c.status ? TRUTH_UNKNOWN : ball_touches(&c, &m, &s, dyn_limits_default.max_steps);
}
