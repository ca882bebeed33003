/* The curve of orbits along a line in parameter space, and the functions that vanish at bifurcations.

   The three unknowns are the parameter, t_b and t_c.  A third equation next to the two of motion/map_balls.c singles
   out one point of the curve; its slopes come from duals (motion/dual.h), so that one line states each function.  A
   touch of the belt's speed inside phase H is the value at the time of the extremum: there the value does not depend on
   that time to first order, so the slopes at a fixed time are those of the extremum. */

#include "curve.h"
#include "motion/orbit_judge.h"
#include "num/pi.h"
#include "num/solve.h"

#define CHANGE_ID(name, id, text)   id,
#define CHANGE_TEXT(name, id, text) text,
const char *const dyn_change_id[N_CHANGES] = {DYN_CHANGES(CHANGE_ID)};
const char *const dyn_change_text[N_CHANGES] = {DYN_CHANGES(CHANGE_TEXT)};

void curve_init(struct curve *b, const struct dyn_line *line, bool up, double tb, slong prec) {
  *b = (struct curve){.line = line, .up = up, .crest = (slong)(tb / (2 * PI)), .prec = prec};
  for (int i = 0; i < N_PARAMS; i++)
    if (i != line->vary) arb_set_fmpq(&b->p[i], line->params + i, prec);
}

void curve_clear(struct curve *b) {
  for (int i = 0; i < N_PARAMS; i++) arb_clear(&b->p[i]);
}

int view_open(struct view *v, const struct curve *b, arb_srcptr x) {
  val p[N_PARAMS];
  v->curve = b;
  v->c = calc_begin(dual_ctx(b->prec));
  for (int i = 0; i < N_PARAMS; i++)
    p[i] = i == b->line->vary ? dual_variable(&v->c, x, i) : dual_variable(&v->c, &b->p[i], -1);
  ball_params_make(&v->m, &v->c, p);
  ball_pass_make(&v->s, &v->c, &v->m, dual_variable(&v->c, x + 1, DIR_TB), dual_variable(&v->c, x + 2, DIR_TC), b->up);
  return v->c.status;
}

void view_clear(struct view *v) {
  calc_clear(&v->c);
}

arb_srcptr view_slope(const struct view *v, val f, int i) {
  return dual_slope(f, i == 0 ? v->curve->line->vary : DIR_TB + i - 1);
}

/* --- The functions. --- */

/* (e1 - w)/2 where w is least while m1 sticks; with q < 0 in phase C w only rises there, so that is at its start. */
static val friction_left(struct view *v, int mass) {
  struct calc *c = &v->c;
  const fmpq *u = v->curve->line->u_r[mass];
  if (!u || v->curve->up) return NULL;
  val need = mass == 0 ? calc_sub(c, v->m.p[P_E1], v->s.wc) : calc_mul(c, v->m.p[P_CHI], v->s.rise);
  return calc_sub(c, calc_q(c, u), calc_mul(c, calc_d(c, 0.5), need));
}

/* The greatest w inside phase C, minus e1; with q < 0 there is none, and without a fall before it neither. */
static val hill(struct view *v) {
  struct calc *c = &v->c;
  const struct ball_params *m = &v->m;
  if (!v->curve->up) return NULL;
  struct ball_ending e;
  val r = v->s.r_end, u[2];
  if (!calc_lt(c, m->a, calc_mul(c, m->p[P_CHI], calc_mul(c, m->omega, r)))) return NULL;
  ball_ending_make(&e, c, m, &v->s);
  bool falls = ball_force_turns(u, c, m, r) && calc_lt(c, u[1], e.turn);
  return falls ? calc_neg(c, ball_force_left(c, m, e.ta, r, u[1])) : NULL;
}

/* How far t_b's rise lies over the crest of the period before. */
static val over_crest(struct view *v) {
  struct calc *c = &v->c;
  const struct ball_params *m = &v->m;
  if (v->curve->crest < 1) return NULL;
  val turns = calc_mul(c, calc_d(c, 2 * (double)(v->curve->crest - 1)), calc_pi(c));
  val first = ball_rise(c, m, ball_crest(c, m));
  return calc_sub(c, v->s.rise, calc_add(c, first, calc_mul(c, m->a, turns)));
}

static struct ball_pass slip_until(struct view *v, const arb_t time, bool moving) {
  struct ball_pass s;
  ball_pass_slip(&s, &v->c, &v->m, v->s.tb, dual_variable(&v->c, time, moving ? DIR_TC : -1));
  return s;
}

val view_change(struct view *v, enum dyn_change what, const arb_t time) {
  struct calc *c = &v->c;
  switch (what) {
  case CHANGE_FLIP: /* (tr J + 1) z_1' - V at t_b, which has no pole */
    return calc_add(c, v->s.defect_tb, calc_mul(c, v->m.two, v->s.pb));
  case CHANGE_FOLD:
    return v->s.defect_tb;
  case CHANGE_TA: {
    struct ball_ending e;
    ball_ending_make(&e, c, &v->m, &v->s);
    return e.ta;
  }
  case CHANGE_H_V2:
    return v->curve->up ? NULL : slip_until(v, time, false).qc;
  case CHANGE_C_W_START:
    return v->curve->up ? calc_sub(c, v->s.wc, v->m.p[P_E1]) : NULL;
  case CHANGE_C_W_HILL:
    return hill(v);
  case CHANGE_U_R1:
  case CHANGE_U_R2:
    return friction_left(v, what == CHANGE_U_R1 ? 0 : 1);
  case CHANGE_H_V1:
    return slip_until(v, time, false).pc;
  case CHANGE_TC:
    return v->s.wc;
  case CHANGE_C_V2:
    return v->s.qc;
  case CHANGE_TB:
    return v->s.tb;
  case CHANGE_GAMMA_V1:
    return v->s.tc;
  case CHANGE_GAMMA_R:
    return over_crest(v);
  default:
    return NULL;
  }
}

/* --- Touches. --- */

struct touch {
  struct view *v;
  enum dyn_change what;
  slong mark;
};

/* The function whose zero is the time of the extremum. */
static int touch_values(const void **f, const void **j, const struct num_vec *time, void *self) {
  const struct touch *t = self;
  calc_release(&t->v->c, t->mark);
  struct ball_pass s = slip_until(t->v, num_vec_at(time, 0), true);
  val force = t->what == CHANGE_H_V1 ? s.wc : s.rc;
  if (f) f[0] = dual_value(force);
  j[0] = dual_slope(force, DIR_TC);
  return t->v->c.status;
}

int view_touch(arb_t time, struct view *v, enum dyn_change what, bool prove) {
  if (what != CHANGE_H_V1 && what != CHANGE_H_V2) return SS_OK;
  struct touch touch = {v, what, calc_mark(&v->c)};
  struct solve_system system = {1, touch_values, &touch};
  struct num_vec x = {num_ctx_arb(v->c.ctx.prec), 1, (char *)time};
  if (!prove) arb_get_mid_arb(time, time);
  int status = prove ? krawczyk_enclose(&x, NULL, &system) : newton_settle(&x, &system, 60);
  calc_release(&v->c, touch.mark);
  return status;
}

/* --- The three equations. --- */

/* A point that a change singles out. */
struct point {
  const struct curve *curve;
  enum dyn_change what;
  arb_ptr time; /* moves along with a touch */
  struct view v;
  bool open;
};

static void point_close(struct point *p) {
  if (p->open) view_clear(&p->v);
  p->open = false;
}

static int values(const void **f, const void **j, const struct num_vec *x, void *self) {
  struct point *p = self;
  point_close(p);
  int status = view_open(&p->v, p->curve, num_vec_at(x, 0));
  p->open = true;
  if (!status) status = view_touch(p->time, &p->v, p->what, false);
  const val rows[3] = {p->v.s.pc, p->v.s.defect, status ? NULL : view_change(&p->v, p->what, p->time)};
  if (!rows[2]) return status | SS_UNABLE;
  for (int i = 0; i < 3; i++) {
    if (f) f[i] = dual_value(rows[i]);
    for (int k = 0; k < 3; k++) j[3 * i + k] = view_slope(&p->v, rows[i], k);
  }
  return p->v.c.status;
}

int curve_newton(arb_ptr x, arb_t time, const struct curve *b, enum dyn_change what) {
  OWNED_CLEARED(point_close) struct point p = {.curve = b, .what = what, .time = time};
  struct solve_system system = {3, values, &p};
  struct num_vec at = {num_ctx_arb(b->prec), 3, (char *)x};
  for (int k = 0; k < 3; k++) arb_get_mid_arb(x + k, x + k);
  return newton_settle(&at, &system, 60);
}

int curve_prove_zero(arb_ptr x, const struct curve *b, enum dyn_change what) {
  OWNED_CLEARED(point_close) struct point p = {.curve = b, .what = what};
  struct solve_system system = {3, values, &p};
  struct num_vec at = {num_ctx_arb(b->prec), 3, (char *)x};
  return krawczyk_enclose(&at, NULL, &system);
}

int curve_rate(arb_t rate, struct view *v, val f) {
  slong prec = v->c.ctx.prec;
  SIZED(arb_mat, dx, 2, 1);
  bool ok = tube_motion(dx, &v->s, v->curve->line->vary, prec);
  arb_set(rate, view_slope(v, f, 0));
  for (int k = 0; k < 2; k++) arb_addmul(rate, view_slope(v, f, k + 1), arb_mat_entry(dx, k, 0), prec);
  return ok && !v->c.status && arb_is_finite(rate) ? SS_OK : SS_UNABLE;
}
