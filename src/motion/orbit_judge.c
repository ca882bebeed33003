/* The numbers and the conditions of an orbit, read off one pass in balls from its (t_b, t_c).

   Phase C turns (r, q/omega) about the origin, so that its end, its length t_d and the extremes of the force w during
   it are known in closed form.  What must hold all along phase Gamma or H is proved by map_balls.c. */
#include "orbit_judge.h"

#include "warm.h"

enum { GUARD = 40, PLANNED_FROM = 512, PILOT = 192, SPARE = 8, RAISES = 4 }; /* bits; raises of the precision */

#define ID(name, id, phase) id,
const char *const dyn_condition_id[N_CONDITIONS] = {DYN_CONDITIONS(ID)};
#undef ID

void dyn_orbit_balls(arb_ptr all[ORBIT_BALLS], struct dyn_orbit *o) {
#define MEMBER(name, member, what) o->member,
  arb_ptr these[ORBIT_BALLS] = {DYN_ORBIT_NUMBERS(MEMBER) o->margin};
#undef MEMBER
  for (int i = 0; i < ORBIT_BALLS; i++) all[i] = these[i];
}

arb_srcptr dyn_orbit_output(const struct dyn_orbit *o, enum dyn_output i) {
  const arb_srcptr all[N_DYN_OUT] = {
      [DYN_OUT_Z10] = o->z10,     [DYN_OUT_Z20] = o->z20,    [DYN_OUT_TA] = o->t[0],       [DYN_OUT_TB] = o->t[1],
      [DYN_OUT_TC] = o->t[2],     [DYN_OUT_TD] = o->t[3],    [DYN_OUT_PERIOD] = o->period, [DYN_OUT_TRACE] = o->trace,
      [DYN_OUT_U1] = o->u_r1_min, [DYN_OUT_U2] = o->u_r2_min};
  return all[i];
}

void dyn_orbit_copy(struct dyn_orbit *to, struct dyn_orbit *o) {
  arb_ptr all[ORBIT_BALLS], from[ORBIT_BALLS];
  *to = *o;
  dyn_orbit_balls(all, to);
  dyn_orbit_balls(from, o);
  for (int i = 0; i < ORBIT_BALLS; i++) {
    arb_init(all[i]);
    arb_set(all[i], from[i]);
  }
}

void dyn_orbit_clear(struct dyn_orbit *o) {
  arb_ptr all[ORBIT_BALLS];
  dyn_orbit_balls(all, o);
  for (int i = 0; i < ORBIT_BALLS; i++) arb_clear(all[i]);
}

/* With u = omega (t_d - t), r = r_end cos u and z_2' - V = omega r_end sin u; w' = a - chi (z_2' - V). */
val ball_force_left(struct calc *c, const struct ball_params *m, val ta, val r_end, val u) {
  val sine, versine;
  calc_sin_versine(c, &sine, &versine, u);
  val way = calc_mul(c, m->a, calc_add(c, ta, calc_div(c, u, m->omega)));
  return calc_sub(c, way, calc_mul(c, m->p[P_CHI], calc_mul(c, r_end, versine)));
}

bool ball_force_turns(val u[2], struct calc *c, const struct ball_params *m, val r_end) {
  val fast = calc_mul(c, m->p[P_CHI], calc_mul(c, m->omega, r_end));
  if (calc_lt(c, fast, m->a)) return false;
  val square = calc_mul(c, calc_sub(c, fast, m->a), calc_add(c, fast, m->a));
  if (!calc_lt(c, m->a, fast)) square = calc_abs(c, square); /* the two cannot be told from a double one */
  u[0] = calc_atan2(c, m->a, calc_sqrt(c, square));
  u[1] = calc_sub(c, calc_pi(c), u[0]);
  return true;
}

/* The least and the greatest e1 - w in phase C: at its ends, or at a hill or valley in it. */
struct force_left {
  arb_ptr least, most;
};

static struct force_left force_left(struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                                    const struct ball_ending *e) {
  struct force_left f = {calc_new(c), calc_new(c)};
  val start = calc_sub(c, m->p[P_E1], s->wc), end = calc_mul(c, m->a, e->ta), u[2];
  arb_min(f.least, start, end, c->ctx.prec);
  arb_max(f.most, start, end, c->ctx.prec);
  if (!ball_force_turns(u, c, m, s->r_end)) return f;
  for (int hill = 0; hill < 2; hill++) {
    truth inside = num_arb.lt(u[hill], e->turn);
    if (inside == TRUTH_FALSE) continue;
    val there = ball_force_left(c, m, e->ta, s->r_end, u[hill]);
    arb_ptr bound = hill ? f.least : f.most, both = calc_new(c);
    (hill ? arb_min : arb_max)(both, bound, there, c->ctx.prec);
    if (inside == TRUTH_TRUE)
      arb_set(bound, both);
    else
      arb_union(bound, bound, both, c->ctx.prec);
  }
  return f;
}

void ball_ending_make(struct ball_ending *e, struct calc *c, const struct ball_params *m, const struct ball_pass *s) {
  val reach = calc_mul(c, m->omega, s->rc);
  e->turn = s->up ? calc_atan2(c, s->qc, reach) : calc_atan2(c, calc_neg(c, s->qc), calc_neg(c, reach));
  e->td = calc_div(c, e->turn, m->omega);
  val fall = calc_mul(c, m->p[P_CHI], calc_sub(c, s->r_end, s->rc));
  e->wf = calc_add(c, s->wc, calc_sub(c, calc_mul(c, m->a, e->td), fall));
  e->ta = calc_div(c, calc_sub(c, m->p[P_E1], e->wf), m->a);
}

int dyn_orbit_describe(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, const struct ball_pass *s) {
  struct ball_ending e;
  ball_ending_make(&e, c, m, s);
  val chi = m->p[P_CHI], e1 = m->p[P_E1], half = calc_d(c, 0.5);
  val times[4] = {e.ta, s->tb, s->tc, e.td}, period = m->zero, z[2];
  for (int i = 0; i < 4; i++) {
    arb_set(o->t[i], times[i]);
    o->guess[i] = num_arb.get_d(times[i]);
    period = calc_add(c, period, times[i]);
  }
  ball_positions(z, c, m, e.wf, s->r);
  arb_set(o->z10, z[0]);
  arb_set(o->z20, z[1]);
  arb_set(o->e1, e1);
  arb_set(o->e2, m->p[P_E2]);
  arb_set(o->period, period);
  arb_set(o->trace, calc_div(c, s->r_end_tb, s->pb));
  arb_set(o->margin, calc_sub(c, calc_abs(c, o->trace), m->one));
  arb_ptr least = calc_new(c); /* of w while m1 sticks: phases C and D */
  arb_min(least, calc_sub(c, e1, force_left(c, m, s, &e).most), e1, c->ctx.prec);
  arb_set(o->u_r1_min, calc_mul(c, half, calc_sub(c, e1, least)));
  arb_set(o->u_r2_min, calc_mul(c, half, calc_mul(c, chi, s->rise))); /* chi r only rises while m2 sticks */
  return c->status;
}

truth dyn_orbit_judge(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                      long max_steps) {
  struct ball_ending e;
  ball_ending_make(&e, c, m, s);
  truth positive = num_arb.lt(m->zero, s->qc), negative = num_arb.lt(s->qc, m->zero);
  truth direction = s->up ? positive : negative;
  truth first_b = truth_and(ball_first_rise(c, m, s, &o->holds[COND_GAMMA_V1]), num_arb.lt(m->zero, s->tb));
  truth first_c = ball_slower(c, m, s, 0, max_steps);
  first_c = truth_and(first_c, num_arb.lt(m->zero, s->tc)); /* Newton's iteration can have left the phases */
  o->holds[COND_TA] = num_arb.lt(m->zero, e.ta);
  o->holds[COND_H_V1] = num_arb.lt(s->pb, m->zero);
  o->holds[COND_H_V2] = ball_slower(c, m, s, 1, max_steps);
  if (positive == TRUTH_TRUE) o->holds[COND_H_V2] = TRUTH_FALSE; /* however late */
  o->holds[COND_C_V2] = negative;
  o->holds[COND_C_W] = num_arb.lt(m->zero, force_left(c, m, s, &e).least);
  o->holds[COND_D_R] = num_arb.lt(m->zero, s->rise);
  o->holds[COND_GAMMA_R] = first_b;
  o->stable = num_arb.lt(calc_abs(c, o->trace), m->one);
  o->admissible = TRUTH_TRUE;
  for (int i = 0; i < N_CONDITIONS; i++) o->admissible = truth_and(o->admissible, o->holds[i]);
  o->first[PHASE_D] = TRUTH_TRUE; /* affine */
  o->first[PHASE_GAMMA] = first_b;
  o->first[PHASE_H] = first_c;
  o->first[PHASE_C] = direction; /* q = omega r_end sin(omega (t_d - t)) with 0 < omega t_d < pi */
  return truth_and(truth_and(first_b, first_c), direction);
}

truth friction_enough(const fmpq *u_r, const arb_t excess, const arb_t least, slong prec) {
  if (!u_r) return TRUTH_TRUE;
  NUMBERS(arb, x);
  arb_set_fmpq(x, u_r, prec);
  return truth_and(num_arb.lt(excess, x), num_arb.lt(least, x));
}

truth orbit_friction_enough(const struct dyn_orbit *o, int mass, const fmpq *u_r, slong prec) {
  return friction_enough(u_r, mass ? o->e2 : o->e1, mass ? o->u_r2_min : o->u_r1_min, prec);
}

/* --- What the searches for orbits share. --- */

/* The fewest relative bits of any of its numbers that is not zero; at least 0. */
static slong accuracy(struct dyn_orbit *o) {
  arb_ptr all[ORBIT_BALLS];
  slong least = ARF_PREC_EXACT;
  dyn_orbit_balls(all, o);
  for (int i = 0; i < ORBIT_BALLS; i++)
    if (!arb_is_zero(all[i])) least = FLINT_MIN(least, arb_rel_accuracy_bits(all[i]));
  return FLINT_MAX(least, 0);
}

slong orbit_planned_bits(const struct orbit_source *s, slong prec) {
  if (prec <= PLANNED_FROM) return prec + GUARD;
  OWNED(dyn_orbit) o = {.grazing = false};
  slong left = 0; /* bits of the pilot's worst number */
  if (!s->solve(s->self, PILOT) && !s->describe(&o, s->self, PILOT)) left = accuracy(&o);
  return left > 0 ? prec + FLINT_MAX(GUARD, PILOT - left + SPARE) : prec + GUARD;
}

static bool undecided(const struct dyn_orbit *o) {
  bool any = o->stable == TRUTH_UNKNOWN;
  for (int i = 0; i < N_CONDITIONS; i++) any |= o->holds[i] == TRUTH_UNKNOWN;
  return any;
}

int orbit_finish(struct dyn_orbit *o, truth *valid, long *raises, const struct orbit_source *s, slong work,
                 slong prec) {
  int status = s->describe(o, s->self, work);
  for (int i = 0; i < RAISES && (status || accuracy(o) < prec); i++) {
    work += FLINT_MIN(FLINT_MAX(prec - accuracy(o), 0), work) + GUARD;
    status = s->solve(s->self, work);
    if (!status) status = s->describe(o, s->self, work);
    ++*raises;
  }
  *valid = s->judge(o, s->self, FLINT_MIN(work, 128));
  if (*valid == TRUTH_UNKNOWN || undecided(o)) *valid = s->judge(o, s->self, work);
  o->grazing = *valid == TRUTH_UNKNOWN;
  return status;
}

int orbit_list_add(struct dyn_orbits *list, const struct orbit_source *s, slong work, slong prec) {
  struct dyn_orbit *o = &list->orbit[list->n];
  truth valid;
  *o = (struct dyn_orbit){.grazing = false};
  int status = orbit_finish(o, &valid, &list->raises, s, work, prec);
  if (valid == TRUTH_FALSE)
    dyn_orbit_clear(o);
  else
    list->n++;
  return status;
}
