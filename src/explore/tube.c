/* One orbit over a box of parameters.

   Krawczyk's operator around the orbit at the middle of the box.  The residual over the box is bounded by its mean value
   form in the parameters, and the box of unknowns grows until the operator maps it into its interior. */
#include <math.h>
#include <stdlib.h>

#include "curve.h"

void tube_init(struct tube *t) {
  for (int i = 0; i < N_PARAMS; i++) arb_init(&t->p[i]);
  for (int i = 0; i < 2; i++) {
    arb_init(&t->x[i]);
    arb_init(&t->box[i]);
  }
  t->up = false;
}

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

/* The pass at (p, x), p's midpoints when middle; slopes along the parameters that are not exact, if wanted. */
static void look(struct ball_pass *s, struct calc *c, struct ball_params *m, const struct tube *t, arb_srcptr x,
                 bool middle) {
  val p[N_PARAMS];
  arb_t mid;
  arb_init(mid);
  for (int i = 0; i < N_PARAMS; i++) {
    arb_get_mid_arb(mid, &t->p[i]);
    p[i] = dual_variable(c, middle ? mid : &t->p[i], middle || arb_is_exact(&t->p[i]) ? -1 : i);
  }
  arb_clear(mid);
  ball_params_make(m, c, p);
  ball_pass_make(s, c, m, dual_variable(c, x, DIR_TB), dual_variable(c, x + 1, DIR_TC), t->up);
}

/* y: the inverse of the Jacobian, its midpoints; f: the residuals. */
struct linear {
  arb_mat_t y, f;
};

static bool linear_make(struct linear *l, const struct ball_pass *s, slong prec) {
  const val f[2] = {s->pc, s->defect};
  arb_mat_t j;
  arb_mat_init(j, 2, 2);
  for (int i = 0; i < 2; i++) {
    arb_set(arb_mat_entry(l->f, i, 0), dual_value(f[i]));
    for (int k = 0; k < 2; k++) arb_set(arb_mat_entry(j, i, k), dual_slope(f[i], DIR_TB + k));
  }
  bool ok = arb_mat_inv(l->y, j, prec) != 0;
  arb_mat_get_mid(l->y, l->y);
  arb_mat_clear(j);
  return ok;
}

static void linear_init(struct linear *l) {
  arb_mat_init(l->y, 2, 2);
  arb_mat_init(l->f, 2, 1);
}

static void linear_clear(struct linear *l) {
  arb_mat_clear(l->y);
  arb_mat_clear(l->f);
}

int tube_newton(struct tube *t, slong prec) {
  struct calc c;
  struct linear l;
  int status = SS_OK, quiet = 0;
  linear_init(&l);
  calc_init(&c, dual_ctx(prec));
  for (int i = 0; i < 60 && !status && quiet < 2; i++) {
    struct ball_params m;
    struct ball_pass s;
    for (int k = 0; k < 2; k++) arb_get_mid_arb(&t->x[k], &t->x[k]);
    look(&s, &c, &m, t, t->x, true);
    if (c.status || !linear_make(&l, &s, prec)) status = SS_UNABLE;
    arb_mat_mul(l.f, l.y, l.f, prec);
    quiet++;
    for (int k = 0; k < 2 && !status; k++) {
      arb_ptr step = arb_mat_entry(l.f, k, 0);
      arb_get_mid_arb(step, step);
      arb_sub(&t->x[k], &t->x[k], step, prec);
      arb_get_mid_arb(&t->x[k], &t->x[k]);
      slong size = arf_is_zero(arb_midref(step)) ? -ARF_PREC_EXACT : arf_abs_bound_lt_2exp_si(arb_midref(step));
      if (size > arf_abs_bound_lt_2exp_si(arb_midref(&t->x[k])) - prec / 2) quiet = 0;
    }
    calc_release(&c, 0);
  }
  calc_clear(&c);
  linear_clear(&l);
  return quiet == 2 ? status : status | SS_UNABLE;
}

/* shift: -Y (F(p0, mid) + sum of dF/dp (p - p0)), dF/dp over the box of parameters. */
static bool shift_of(arb_mat_t shift, struct linear *l, const struct tube *t, arb_srcptr mid, slong prec) {
  struct calc c;
  struct ball_params m;
  struct ball_pass s, at;
  arb_t off;
  arb_init(off);
  calc_init(&c, dual_ctx(prec));
  look(&s, &c, &m, t, mid, true);
  bool ok = !c.status && linear_make(l, &s, prec);
  look(&at, &c, &m, t, mid, false);
  const val f[2] = {at.pc, at.defect};
  for (int i = 0; i < N_PARAMS && ok && !c.status; i++) {
    arb_zero(off);
    mag_set(arb_radref(off), arb_radref(&t->p[i]));
    for (int k = 0; k < 2; k++) arb_addmul(arb_mat_entry(l->f, k, 0), dual_slope(f[k], i), off, prec);
  }
  arb_mat_mul(shift, l->y, l->f, prec);
  arb_mat_neg(shift, shift);
  ok = ok && !c.status;
  calc_clear(&c);
  arb_clear(off);
  return ok;
}

/* image = mid + shift + (I - Y J(p, box)) (box - mid). */
static bool image_of(arb_mat_t image, const struct linear *l, const arb_mat_t shift, const struct tube *t,
                     arb_srcptr mid, slong prec) {
  struct calc c;
  struct ball_params m;
  struct ball_pass s;
  arb_mat_t j, off;
  arb_mat_init(j, 2, 2);
  arb_mat_init(off, 2, 1);
  calc_init(&c, dual_ctx(prec));
  look(&s, &c, &m, t, t->box, false);
  const val f[2] = {s.pc, s.defect};
  for (int i = 0; i < 2; i++) {
    for (int k = 0; k < 2; k++) arb_set(arb_mat_entry(j, i, k), dual_slope(f[i], DIR_TB + k));
    arb_sub(arb_mat_entry(off, i, 0), &t->box[i], mid + i, prec);
  }
  bool ok = !c.status;
  arb_mat_mul(j, l->y, j, prec);
  arb_mat_neg(j, j);
  for (int i = 0; i < 2; i++) arb_add_si(arb_mat_entry(j, i, i), arb_mat_entry(j, i, i), 1, prec);
  arb_mat_mul(image, j, off, prec);
  arb_mat_add(image, image, shift, prec);
  for (int i = 0; i < 2; i++) arb_add(arb_mat_entry(image, i, 0), arb_mat_entry(image, i, 0), mid + i, prec);
  calc_clear(&c);
  arb_mat_clear(off);
  arb_mat_clear(j);
  return ok;
}

/* Makes the box the image, a tenth larger in each direction. */
static void inflate(struct tube *t, const arb_mat_t image, slong prec) {
  for (int k = 0; k < 2; k++) {
    arb_srcptr y = arb_mat_entry(image, k, 0);
    mag_t more;
    mag_init(more);
    mag_mul_2exp_si(more, arb_radref(y), -3);
    arb_set(&t->box[k], y);
    arb_add_error_mag(&t->box[k], more);
    arb_get_mag(more, y);
    mag_mul_2exp_si(more, more, -prec + 6);
    arb_add_error_mag(&t->box[k], more);
    mag_clear(more);
  }
}

int tube_prove(struct tube *t, slong prec) {
  struct linear l;
  arb_mat_t shift, image;
  int status = tube_newton(t, prec);
  if (status) return status;
  arb_ptr mid = _arb_vec_init(2);
  linear_init(&l);
  arb_mat_init(shift, 2, 1);
  arb_mat_init(image, 2, 1);
  _arb_vec_set(mid, t->x, 2);
  bool ok = shift_of(shift, &l, t, mid, prec), proved = false;
  for (int k = 0; k < 2; k++) arb_add(arb_mat_entry(image, k, 0), arb_mat_entry(shift, k, 0), mid + k, prec);
  for (int i = 0; i < 12 && ok && !proved; i++) {
    inflate(t, image, prec);
    ok = image_of(image, &l, shift, t, mid, prec);
    proved = ok;
    for (int k = 0; k < 2 && proved; k++) proved = arb_contains_interior(&t->box[k], arb_mat_entry(image, k, 0));
  }
  for (int k = 0; k < 2 && proved; k++) arb_set(&t->x[k], arb_mat_entry(image, k, 0));
  arb_mat_clear(image);
  arb_mat_clear(shift);
  linear_clear(&l);
  _arb_vec_clear(mid, 2);
  return proved ? SS_OK : SS_UNABLE;
}

double tube_reach(const struct tube *t, int param, slong prec) {
  struct calc c;
  struct linear l;
  struct ball_params m;
  struct ball_pass s;
  struct tube narrow;
  double reach = 0;
  linear_init(&l);
  tube_init(&narrow);
  tube_set(&narrow, t);
  for (int i = 0; i < N_PARAMS; i++) arb_get_mid_arb(&narrow.p[i], &t->p[i]);
  for (int k = 0; k < 2; k++) arb_get_mid_arb(&narrow.x[k], &t->x[k]);
  mag_set_ui_2exp_si(arb_radref(&narrow.p[param]), 1, -prec); /* so that its slopes are carried */
  calc_init(&c, dual_ctx(prec));
  look(&s, &c, &m, &narrow, narrow.x, false);
  const val f[2] = {s.pc, s.defect};
  if (!c.status && linear_make(&l, &s, prec)) {
    for (int k = 0; k < 2; k++) arb_set(arb_mat_entry(l.f, k, 0), dual_slope(f[k], param));
    arb_mat_mul(l.f, l.y, l.f, prec);
    for (int k = 0; k < 2; k++) reach += fabs(num_arb.get_d(arb_mat_entry(l.f, k, 0)));
  }
  calc_clear(&c);
  tube_clear(&narrow);
  linear_clear(&l);
  return reach * mag_get_d(arb_radref(&t->p[param]));
}

/* --- Mean value forms. --- */

enum { SHARP = 5 };

/* The numbers that are worth it: trace, t_a, t_d, z10, z20. */
static void sharp_numbers(val out[SHARP], struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                          bool up) {
  struct ball_ending e;
  val chi = m->p[P_CHI], ease = calc_sub(c, m->one, chi);
  ball_ending_make(&e, c, m, s, up);
  out[0] = calc_add(c, calc_div(c, s->defect_tb, s->pb), m->one);
  out[1] = e.ta;
  out[2] = e.td;
  out[3] = calc_div(c, calc_add(c, e.wf, calc_mul(c, chi, s->r)), ease);
  out[4] = calc_div(c, calc_add(c, e.wf, s->r), ease);
}

/* d(t_b, t_c)/dp over the tube; false where the Jacobian cannot be inverted. */
static bool motion_of(arb_mat_t dx, const struct ball_pass *s, int param, slong prec) {
  const val f[2] = {s->pc, s->defect};
  arb_mat_t j;
  arb_mat_init(j, 2, 2);
  for (int i = 0; i < 2; i++) {
    arb_neg(arb_mat_entry(dx, i, 0), dual_slope(f[i], param));
    for (int k = 0; k < 2; k++) arb_set(arb_mat_entry(j, i, k), dual_slope(f[i], DIR_TB + k));
  }
  bool ok = arb_mat_solve(dx, j, dx, prec) != 0;
  arb_mat_clear(j);
  return ok;
}

/* number = its value at the middle of the parameters + the sum of its slopes along the orbits times p - p0. */
static bool mean_values(arb_ptr number, const struct tube *t, const struct tube *middle, slong prec) {
  struct calc c;
  struct ball_params m;
  struct ball_pass s;
  val at[SHARP], all[SHARP];
  arb_mat_t dx;
  arb_t slope, off;
  arb_mat_init(dx, 2, 1);
  arb_init(slope);
  arb_init(off);
  calc_init(&c, dual_ctx(prec));
  look(&s, &c, &m, middle, middle->x, false);
  sharp_numbers(at, &c, &m, &s, t->up);
  look(&s, &c, &m, t, t->x, false);
  sharp_numbers(all, &c, &m, &s, t->up);
  bool ok = !c.status;
  for (int n = 0; n < SHARP && ok; n++) arb_set(number + n, dual_value(at[n]));
  for (int i = 0; i < N_PARAMS && ok; i++) {
    if (arb_is_exact(&t->p[i])) continue;
    ok = motion_of(dx, &s, i, prec);
    arb_sub(off, &t->p[i], &middle->p[i], prec);
    for (int n = 0; n < SHARP && ok; n++) {
      arb_set(slope, dual_slope(all[n], i));
      for (int k = 0; k < 2; k++) arb_addmul(slope, dual_slope(all[n], DIR_TB + k), arb_mat_entry(dx, k, 0), prec);
      arb_addmul(number + n, slope, off, prec);
    }
  }
  calc_clear(&c);
  arb_clear(off);
  arb_clear(slope);
  arb_mat_clear(dx);
  return ok;
}

void tube_sharpen(struct dyn_orbit *o, const struct tube *t, slong prec) {
  struct tube middle;
  arb_ptr number = _arb_vec_init(SHARP), of[SHARP] = {o->trace, o->t[PHASE_D], o->t[PHASE_C], o->z10, o->z20};
  tube_init(&middle);
  tube_set(&middle, t);
  for (int i = 0; i < N_PARAMS; i++) arb_get_mid_arb(&middle.p[i], &t->p[i]);
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
    o->holds[COND_TA] = arb_is_positive(o->t[PHASE_D])      ? TRUTH_TRUE
                        : arb_is_nonpositive(o->t[PHASE_D]) ? TRUTH_FALSE
                                                            : TRUTH_UNKNOWN;
    if (!t->up) o->holds[COND_C_W] = o->holds[COND_TA]; /* w rises in phase C, up to e1 - a t_a */
  }
  tube_clear(&middle);
  _arb_vec_clear(number, SHARP);
}

int tube_orbit(struct dyn_orbit *o, truth *word, const struct tube *t, slong prec, long max_steps) {
  struct calc c;
  struct ball_params m;
  val p[N_PARAMS];
  calc_init(&c, num_ctx_arb(prec));
  for (int i = 0; i < N_PARAMS; i++) p[i] = &t->p[i];
  ball_params_make(&m, &c, p);
  int status = dyn_orbit_describe(o, &c, &m, &t->x[0], &t->x[1], t->up);
  *word = status ? TRUTH_UNKNOWN : dyn_orbit_judge(o, &c, &m, &t->x[0], &t->x[1], t->up, max_steps);
  o->grazing = *word == TRUTH_UNKNOWN;
  calc_clear(&c);
  return status;
}
