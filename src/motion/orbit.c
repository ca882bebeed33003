/* Every periodic orbit of the word, found in double precision and enclosed in balls.

   A zero of the search is refined by Newton's iteration on (t_b, t_c) at a precision that doubles, and a Krawczyk step
   proves that a box holds exactly one solution; boxes tell whether two zeros are one.  Where the search saw an extremum
   of the defect too close to zero to call, the extremum itself is computed and shows none or two.  Then it is proved
   that each event is the first of its phase, and what an orbit must fulfil besides is decided on balls. */
#include <math.h>
#include <stdlib.h>

#include "motion_impl.h"
#include "stickslip/arena.h"

const char *const dyn_condition_id[N_CONDITIONS] = {
    [COND_TA] = "t_a",    [COND_GAMMA_V1] = "gamma_v1", [COND_H_V1] = "h_v1", [COND_H_V2] = "h_v2",
    [COND_C_V2] = "c_v2", [COND_C_W] = "c_w",           [COND_D_R] = "d_r",   [COND_GAMMA_R] = "gamma_r",
};

enum { RAISES = 4, SPARE = 8 }; /* of the precision; bits beyond what a pilot lost */

/* A solution (t_b, t_c) of the two equations: the enclosures x, and the boxes in which it is the only one.  The calc and
   what it holds, the kept sines and cosines near the solution, are those of the last precision, 0 when there is none. */
struct solution {
  arb_t x[2], box[2];
  bool up, grazing;
  slong prec;
  struct calc c;
  struct ball_params m;
};

static void solution_init(struct solution *s) {
  for (int i = 0; i < 2; i++) {
    arb_init(s->x[i]);
    arb_init(s->box[i]);
  }
  s->prec = 0;
}

static void close_calc(struct solution *s) {
  if (s->prec) calc_clear(&s->c);
  s->prec = 0;
}

static void solution_clear(struct solution *s) {
  for (int i = 0; i < 2; i++) {
    arb_clear(s->x[i]);
    arb_clear(s->box[i]);
  }
  close_calc(s);
}

/* y = inverse of the derivative of (pc, defect) by (t_b, t_c), rounded to midpoints. */
static void invert(val y[4], struct calc *c, const struct ball_pass *s) {
  val ww = calc_neg(c, s->wc), det = calc_sub(c, calc_mul(c, s->pc_tb, s->defect_tc), calc_mul(c, ww, s->defect_tb));
  y[0] = calc_middle(c, calc_div(c, s->defect_tc, det));
  y[1] = calc_middle(c, calc_div(c, s->wc, det));
  y[2] = calc_middle(c, calc_neg(c, calc_div(c, s->defect_tb, det)));
  y[3] = calc_middle(c, calc_div(c, s->pc_tb, det));
}

/* A calc of the precision, with the sines and cosines at the midpoints of x. */
static void open_calc(struct solution *s, const fmpq *params, slong prec) {
  close_calc(s);
  s->prec = prec;
  calc_init(&s->c, num_ctx_arb(prec));
  ball_params_init(&s->m, &s->c, params);
  for (int k = 0; k < 2; k++) arb_set_round(s->x[k], s->x[k], prec);
  ball_params_keep(&s->m, &s->c, calc_middle(&s->c, s->x[0]), calc_middle(&s->c, s->x[1]));
}

/* One level of Newton's iteration from the midpoints of x, until a step shows that half of the bits are settled. */
static int newton_level(struct solution *s, const fmpq *params, slong prec) {
  open_calc(s, params, prec);
  struct calc *c = &s->c;
  bool settled = false;
  val small = calc_two_to(c, -prec / 2 - 4);
  slong mark = calc_mark(c);
  for (int i = 0; i < 40 && !settled && !c->status; i++) {
    struct ball_pass at;
    val y[4];
    for (int k = 0; k < 2; k++) arb_set_round(s->x[k], s->x[k], prec);
    ball_pass_make(&at, c, &s->m, calc_middle(c, s->x[0]), calc_middle(c, s->x[1]), s->up);
    invert(y, c, &at);
    settled = true;
    for (int k = 0; k < 2; k++) {
      val step = calc_middle(c, calc_dot(c, y[2 * k], at.pc, y[2 * k + 1], at.defect));
      val limit = calc_middle(c, calc_mul(c, small, calc_abs(c, s->x[k])));
      if (!calc_lt(c, calc_abs(c, step), limit)) settled = false;
      arb_get_mid_arb(s->x[k], calc_sub(c, s->x[k], step));
    }
    calc_release(c, mark);
  }
  return settled ? c->status : c->status | SS_UNABLE;
}

static int newton(struct solution *s, const fmpq *params, slong prec) {
  slong ladder[FLINT_BITS], n = 0;
  int status = SS_OK;
  for (slong bits = prec; bits > 192; bits = bits / 2 + 24) ladder[n++] = bits;
  ladder[n++] = FLINT_MIN(prec, 192);
  while (n > 0 && !status) status |= newton_level(s, params, ladder[--n]);
  return status;
}

/* Krawczyk's operator around the midpoints of s->x, on boxes that grow until one is mapped into its interior.  The calc is
   that of Newton's last level. */
static int enclose(struct solution *s) {
  struct calc *c = &s->c;
  const struct ball_params *m = &s->m;
  struct ball_pass at;
  val y[4], mid[2], shift[2];
  slong start = calc_mark(c);
  for (int k = 0; k < 2; k++) mid[k] = calc_middle(c, s->x[k]);
  ball_pass_make(&at, c, m, mid[0], mid[1], s->up);
  invert(y, c, &at);
  for (int k = 0; k < 2; k++) {
    shift[k] = calc_dot(c, y[2 * k], at.pc, y[2 * k + 1], at.defect);
    arb_set(s->box[k], mid[k]);
    arb_get_mag(arb_radref(s->box[k]), shift[k]);
    mag_mul_2exp_si(arb_radref(s->box[k]), arb_radref(s->box[k]), 3);
  }
  bool proved = false;
  slong mark = calc_mark(c);
  for (int i = 0; i < 10 && !proved && !c->status; i++) {
    calc_release(c, mark);
    ball_pass_make(&at, c, m, s->box[0], s->box[1], s->up);
    val j[4] = {at.pc_tb, calc_neg(c, at.wc), at.defect_tb, at.defect_tc};
    proved = true;
    for (int k = 0; k < 2; k++) {
      val image = calc_sub(c, mid[k], shift[k]);
      for (int l = 0; l < 2; l++) {
        val rest = calc_neg(c, calc_dot(c, y[2 * k], j[l], y[2 * k + 1], j[2 + l]));
        if (k == l) rest = calc_add(c, rest, m->one);
        image = calc_add(c, image, calc_mul(c, rest, calc_sub(c, s->box[l], mid[l])));
      }
      arb_set(s->x[k], image);
      if (!arb_contains_interior(s->box[k], s->x[k])) proved = false;
    }
    if (!proved)
      for (int k = 0; k < 2; k++) mag_mul_2exp_si(arb_radref(s->box[k]), arb_radref(s->box[k]), 3);
  }
  calc_release(c, start);
  return proved ? SS_OK : SS_UNABLE;
}

static int solve(struct solution *s, const fmpq *params, slong prec) {
  int status = newton(s, params, prec);
  return status ? status : enclose(s);
}

static bool same_solution(const struct solution *s, const struct solution *t) {
  bool same = s->up == t->up;
  for (int k = 0; k < 2 && same; k++)
    same = arb_overlaps(s->x[k], t->x[k]) && (arb_contains(s->box[k], t->x[k]) || arb_contains(t->box[k], s->x[k]));
  return same;
}

/* --- Folds. --- */

/* The defect's slope at t_b = s->tb, t_c being refined to the root of pc first. */
static int slope_at(struct ball_pass *s, struct calc *c, const struct ball_params *m, val tb, val tc, bool up) {
  val small = calc_two_to(c, -c->ctx.prec / 2);
  for (int i = 0; i < 40 && !c->status; i++) {
    ball_pass_make(s, c, m, tb, tc, up);
    val step = calc_middle(c, calc_div(c, s->pc, s->wc)); /* pc' = -wc */
    tc = calc_middle(c, calc_add(c, tc, step));
    if (!calc_lt(c, calc_mul(c, small, calc_abs(c, tc)), calc_abs(c, step))) {
      ball_pass_make(s, c, m, tb, tc, up);
      return c->status;
    }
  }
  return c->status | SS_UNABLE;
}

/* The extremum of the defect near a zero marked as fold, by the secant method on its slope.  *n of the two solutions
   receive starting values: none or two.  SS_UNABLE when the extremum cannot be told from zero at this precision. */
static int split_fold(struct solution pair[2], int *n, const fmpq *params, const struct zero *zero, slong prec) {
  struct calc c;
  struct ball_params m;
  struct ball_pass a, b;
  calc_init(&c, num_ctx_arb(prec));
  ball_params_init(&m, &c, params);
  val width = calc_d(&c, fmax(zero->high - zero->low, 1e-12 * zero->tb)), tc = calc_d(&c, zero->tc);
  val tb = calc_d(&c, zero->tb), small = calc_mul(&c, width, calc_two_to(&c, -prec / 3)), bend = m.zero;
  int status = slope_at(&a, &c, &m, calc_add(&c, tb, width), tc, zero->up);
  status |= slope_at(&b, &c, &m, tb, tc, zero->up);
  bool settled = false;
  for (int i = 0; i < 60 && !status && !settled; i++) {
    bend = calc_middle(&c, calc_div(&c, calc_sub(&c, b.defect_tb, a.defect_tb), calc_sub(&c, b.tb, a.tb)));
    val step = calc_middle(&c, calc_neg(&c, calc_div(&c, b.defect_tb, bend)));
    settled = calc_lt(&c, calc_abs(&c, step), small);
    a = b;
    status |= slope_at(&b, &c, &m, calc_middle(&c, calc_add(&c, b.tb, step)), b.tc, zero->up);
  }
  *n = 0;
  if (status || !settled) { /* the passes of a step that failed hold nothing */
    calc_clear(&c);
    return status | SS_UNABLE;
  }
  val square = calc_neg(&c, calc_div(&c, calc_mul(&c, m.two, b.defect), bend));
  val noise = calc_mul(&c, calc_mul(&c, width, width), calc_two_to(&c, -prec / 2));
  if (c.status || !calc_lt(&c, noise, calc_abs(&c, square))) {
    status |= SS_UNABLE;
  } else if (calc_lt(&c, m.zero, square)) {
    val half = calc_sqrt(&c, square), drift = calc_div(&c, b.pc_tb, b.wc); /* d t_c / d t_b */
    for (*n = 0; *n < 2; ++*n) {
      val off = *n == 0 ? calc_neg(&c, half) : half;
      arb_get_mid_arb(pair[*n].x[0], calc_add(&c, b.tb, off));
      arb_get_mid_arb(pair[*n].x[1], calc_add(&c, b.tc, calc_mul(&c, drift, off)));
      pair[*n].up = zero->up;
      pair[*n].grazing = zero->grazing;
    }
    status |= c.status;
  }
  calc_clear(&c);
  return status;
}

/* The solutions that a zero of the search stands for, at most two. */
static int resolve(struct solution pair[2], int *n, const fmpq *params, const struct zero *zero, slong prec) {
  *n = 1;
  if (!zero->fold) {
    arb_set_d(pair[0].x[0], zero->tb);
    arb_set_d(pair[0].x[1], zero->tc);
    pair[0].up = zero->up;
    pair[0].grazing = zero->grazing;
    double slack = 1e-9 * zero->high + 0.01 * (zero->high - zero->low);
    if (!solve(&pair[0], params, prec)) {
      double tb = arf_get_d(arb_midref(pair[0].x[0]), ARF_RND_NEAR);
      if (tb > zero->low - slack && tb < zero->high + slack) return SS_OK;
    }
  }
  for (int i = 0; i <= RAISES; i++, prec *= 2) {
    slong p = FLINT_MAX(prec, 192);
    if (split_fold(pair, n, params, zero, p)) continue;
    if (*n == 0 || (!solve(&pair[0], params, p) && !solve(&pair[1], params, p))) return SS_OK;
  }
  *n = 0;
  return SS_UNABLE;
}

/* --- What is known about an orbit once (t_b, t_c) is. --- */

/* The values of w at the ends of phase C and where w' = a - chi q vanishes in it; q = omega R sin u with
   u = omega (t_d - t) from turn down to 0.  The least and the greatest. */
static void force_range(val *least, val *most, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                        val turn, val wf) {
  arb_ptr low = calc_new(c), high = calc_new(c);
  arb_min(low, s->wc, wf, c->ctx.prec);
  arb_max(high, s->wc, wf, c->ctx.prec);
  *least = low;
  *most = high;
  val chi = m->p[P_CHI], fast = calc_mul(c, chi, calc_mul(c, m->omega, s->r_end)); /* of the sign of q */
  if (!arb_is_positive(s->r_end) || num_arb.lt(fast, m->a) == TRUTH_TRUE) return;
  val x = calc_div(c, m->a, fast), y = calc_sqrt(c, calc_abs(c, calc_sub(c, m->one, calc_mul(c, x, x))));
  for (int branch = 0; branch < 2;
       branch++) { /* the valley, then the hill, of which only what lies below turn counts */
    val u = calc_atan2(c, x, branch == 0 ? y : calc_neg(c, y)), sine, cosine;
    truth inside = num_arb.lt(u, turn);
    if (inside == TRUTH_FALSE) continue;
    calc_sin_cos(c, &sine, &cosine, u);
    val r = calc_mul(c, s->r_end, cosine), slide = calc_mul(c, m->a, calc_div(c, calc_sub(c, turn, u), m->omega));
    val w = calc_add(c, s->wc, calc_sub(c, slide, calc_mul(c, chi, calc_sub(c, r, s->rc))));
    arb_ptr bound = branch == 0 ? low : high;
    arb_ptr both = calc_new(c);
    if (branch == 0)
      arb_min(both, bound, w, c->ctx.prec);
    else
      arb_max(both, bound, w, c->ctx.prec);
    if (inside == TRUTH_TRUE)
      arb_set(bound, both);
    else
      arb_union(bound, bound, both, c->ctx.prec);
  }
}

void ball_ending_make(struct ball_ending *e, struct calc *c, const struct ball_params *m, const struct ball_pass *s,
                      bool up) {
  val reach = calc_mul(c, m->omega, s->rc);
  e->turn = up ? calc_atan2(c, s->qc, reach) : calc_atan2(c, calc_neg(c, s->qc), calc_neg(c, reach));
  e->td = calc_div(c, e->turn, m->omega);
  val fall = calc_mul(c, m->p[P_CHI], calc_sub(c, s->r_end, s->rc));
  e->wf = calc_add(c, s->wc, calc_sub(c, calc_mul(c, m->a, e->td), fall));
  e->ta = calc_div(c, calc_sub(c, m->p[P_E1], e->wf), m->a);
}

/* Every number of the orbit. */
int dyn_orbit_describe(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, val tb, val tc, bool up) {
  struct ball_pass s;
  ball_pass_make(&s, c, m, tb, tc, up);
  struct ball_ending e;
  val lowest, highest;
  ball_ending_make(&e, c, m, &s, up);
  force_range(&lowest, &highest, c, m, &s, e.turn, e.wf);
  val chi = m->p[P_CHI], e1 = m->p[P_E1], ease = calc_sub(c, m->one, chi), half = calc_d(c, 0.5);
  val times[4] = {e.ta, tb, tc, e.td}, period = m->zero;
  for (int i = 0; i < 4; i++) {
    arb_set(o->t[i], times[i]);
    o->guess[i] = num_arb.get_d(times[i]);
    period = calc_add(c, period, times[i]);
  }
  arb_set(o->z10, calc_div(c, calc_add(c, e.wf, calc_mul(c, chi, s.r)), ease));
  arb_set(o->z20, calc_div(c, calc_add(c, e.wf, s.r), ease));
  arb_set(o->e1, e1);
  arb_set(o->e2, m->p[P_E2]);
  arb_set(o->period, period);
  arb_set(o->trace, calc_add(c, calc_div(c, s.defect_tb, s.pb), m->one));
  arb_set(o->margin, calc_sub(c, calc_abs(c, o->trace), m->one));
  arb_ptr least = calc_new(c); /* of w while m1 sticks: phases C and D */
  arb_min(least, lowest, e1, c->ctx.prec);
  arb_set(o->u_r1_min, calc_mul(c, half, calc_sub(c, e1, least)));
  arb_set(o->u_r2_min, calc_mul(c, half, calc_mul(c, chi, s.rise))); /* chi r only rises while m2 sticks */
  return c->status;
}

/* The conditions.  Returns whether t_b and t_c are proved to be first roots, and the direction of phase C. */
truth dyn_orbit_judge(struct dyn_orbit *o, struct calc *c, const struct ball_params *m, val tb, val tc, bool up,
                      long max_steps) {
  struct ball_pass s;
  ball_pass_make(&s, c, m, tb, tc, up);
  struct ball_ending e;
  val least, most;
  ball_ending_make(&e, c, m, &s, up);
  force_range(&least, &most, c, m, &s, e.turn, e.wf);
  truth direction = up ? num_arb.lt(m->zero, s.qc) : num_arb.lt(s.qc, m->zero);
  truth first_b = truth_and(ball_first_rise(c, m, &s, &o->holds[COND_GAMMA_V1]), num_arb.lt(m->zero, tb));
  truth first_c = ball_slower(c, m, &s.modes, 0, s.pb, tc, true, max_steps);
  first_c = truth_and(first_c, num_arb.lt(m->zero, tc)); /* Newton's iteration can have left the phases */
  o->holds[COND_TA] = num_arb.lt(m->zero, e.ta);
  o->holds[COND_H_V1] = num_arb.lt(s.pb, m->zero);
  o->holds[COND_H_V2] = ball_slower(c, m, &s.modes, 1, m->zero, tc, false, max_steps);
  if (num_arb.lt(m->zero, s.qc) == TRUTH_TRUE) o->holds[COND_H_V2] = TRUTH_FALSE; /* however late */
  o->holds[COND_C_V2] = num_arb.lt(s.qc, m->zero);
  o->holds[COND_C_W] = num_arb.lt(most, m->p[P_E1]);
  o->holds[COND_D_R] = num_arb.lt(m->zero, s.rise);
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

static bool undecided(const struct dyn_orbit *o) {
  bool any = o->stable == TRUTH_UNKNOWN;
  for (int i = 0; i < N_CONDITIONS; i++) any |= o->holds[i] == TRUTH_UNKNOWN;
  return any;
}

slong dyn_orbit_accuracy(const struct dyn_orbit *o) {
  const arb_struct *all[] = {o->z10, o->z20,    o->t[0],  o->t[1],   o->t[2],     o->t[3],    o->e1,
                             o->e2,  o->period, o->trace, o->margin, o->u_r1_min, o->u_r2_min};
  slong least = ARF_PREC_EXACT;
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (!arb_is_zero(all[i])) least = FLINT_MIN(least, arb_rel_accuracy_bits(all[i]));
  return FLINT_MAX(least, 0);
}

void dyn_orbit_init(struct dyn_orbit *o) {
  arb_ptr all[] = {o->z10, o->z20, o->e1, o->e2, o->period, o->trace, o->margin, o->u_r1_min, o->u_r2_min};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_init(all[i]);
  for (int i = 0; i < 4; i++) arb_init(o->t[i]);
}

void dyn_orbit_clear(struct dyn_orbit *o) {
  arb_ptr all[] = {o->z10, o->z20, o->e1, o->e2, o->period, o->trace, o->margin, o->u_r1_min, o->u_r2_min};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  for (int i = 0; i < 4; i++) arb_clear(o->t[i]);
}

static truth judge(struct dyn_orbit *o, const fmpq *params, const struct solution *sol, slong prec, long max_steps) {
  struct calc c;
  struct ball_params m;
  calc_init(&c, num_ctx_arb(prec));
  ball_params_init(&m, &c, params);
  truth first = dyn_orbit_judge(o, &c, &m, sol->x[0], sol->x[1], sol->up, max_steps);
  calc_clear(&c);
  return first;
}

slong dyn_planned_bits(slong prec, slong left) {
  return left > 0 ? prec + FLINT_MAX(DYN_GUARD, DYN_PILOT - left + SPARE) : prec + DYN_GUARD;
}

/* The working precision near (t_b, t_c), from a pilot where it is worth its time. */
static slong plan(const fmpq *params, double tb, double tc, bool up, slong prec) {
  struct solution pilot;
  struct dyn_orbit o;
  if (prec <= DYN_PLANNED_FROM) return prec + DYN_GUARD;
  solution_init(&pilot);
  dyn_orbit_init(&o);
  arb_set_d(pilot.x[0], tb);
  arb_set_d(pilot.x[1], tc);
  pilot.up = up;
  slong left = 0;
  if (!solve(&pilot, params, DYN_PILOT) && !dyn_orbit_describe(&o, &pilot.c, &pilot.m, pilot.x[0], pilot.x[1], up))
    left = dyn_orbit_accuracy(&o);
  dyn_orbit_clear(&o);
  solution_clear(&pilot);
  return dyn_planned_bits(prec, left);
}

/* The orbit of a solution to prec bits, the working precision being raised, *raises times, as long as that helps.
   *first as judge returns it. */
static int finish(struct dyn_orbit *o, truth *first, long *raises, const fmpq *params, struct solution *sol, slong prec,
                  const struct dyn_limits *lim) {
  slong work = sol->prec;
  int status = dyn_orbit_describe(o, &sol->c, &sol->m, sol->x[0], sol->x[1], sol->up);
  *raises = 0;
  for (int i = 0; i < RAISES && (status || dyn_orbit_accuracy(o) < prec); i++) {
    work += FLINT_MIN(FLINT_MAX(prec - dyn_orbit_accuracy(o), 0), work) + DYN_GUARD;
    status = solve(sol, params, work);
    if (!status) status = dyn_orbit_describe(o, &sol->c, &sol->m, sol->x[0], sol->x[1], sol->up);
    ++*raises;
  }
  *first = judge(o, params, sol, FLINT_MIN(work, 128), lim->max_steps);
  if (*first == TRUTH_UNKNOWN || undecided(o)) *first = judge(o, params, sol, work, lim->max_steps);
  o->grazing = sol->grazing || *first == TRUTH_UNKNOWN;
  return status;
}

int dyn_orbit_near(struct dyn_orbit *o, truth *first, const fmpq *params, double tb, double tc, bool up, slong prec,
                   const struct dyn_limits *lim) {
  struct solution s;
  if (!lim) lim = &dyn_limits_default;
  solution_init(&s);
  dyn_orbit_init(o);
  arb_set_d(s.x[0], tb);
  arb_set_d(s.x[1], tc);
  s.up = up;
  s.grazing = false;
  *first = TRUTH_UNKNOWN;
  long raises;
  int status = solve(&s, params, plan(params, tb, tc, up, prec));
  if (!status) status = finish(o, first, &raises, params, &s, prec, lim);
  solution_clear(&s);
  return status;
}

/* --- The list. --- */

struct solutions {
  struct solution *s;
  size_t n, cap;
};

/* Takes sol over, unless it is there already. */
static void add_solution(struct solutions *list, struct solution *sol) {
  for (size_t i = 0; i < list->n; i++)
    if (same_solution(&list->s[i], sol)) {
      solution_clear(sol);
      return;
    }
  list->s = ss_grow(list->s, list->n, &list->cap, sizeof *list->s);
  list->s[list->n++] = *sol;
}

int dyn_orbits_by_z10(const void *x, const void *y) {
  const struct dyn_orbit *a = x, *b = y;
  return arf_cmp(arb_midref(a->z10), arb_midref(b->z10));
}

int dyn_orbits_find(struct dyn_orbits *list, const fmpq *params, slong prec, const struct dyn_limits *lim) {
  struct search search;
  struct solutions found = {NULL, 0, 0};
  double p[N_PARAMS];
  *list = (struct dyn_orbits){.n = 0};
  if (!lim) lim = &dyn_limits_default;
  for (int i = 0; i < N_PARAMS; i++) {
    if (fmpq_sgn(params + i) <= 0) return SS_DOMAIN;
    p[i] = fmpq_get_d(params + i);
  }
  if (fmpz_cmp(fmpq_numref(params + P_CHI), fmpq_denref(params + P_CHI)) >= 0) return SS_DOMAIN;
  if (search_run(&search, p, lim)) return SS_UNABLE; /* in the domain, but not in that of double precision */
  list->evaluations = search.evaluations;

  int status = search.cut ? SS_UNABLE : SS_OK;
  for (size_t i = 0; i < search.n; i++) {
    struct solution pair[2];
    int n = 0;
    for (int k = 0; k < 2; k++) solution_init(&pair[k]);
    const struct zero *z = &search.zeros[i];
    slong work = z->fold ? prec + DYN_GUARD : plan(params, z->tb, z->tc, z->up, prec);
    status |= resolve(pair, &n, params, z, work);
    for (int k = 0; k < n; k++) add_solution(&found, &pair[k]);
    list->bits = FLINT_MAX(list->bits, n > 0 ? work : 0);
    for (int k = n; k < 2; k++) solution_clear(&pair[k]);
  }
  list->orbit = ss_malloc((found.n + 1) * sizeof *list->orbit);
  for (size_t i = 0; i < found.n; i++) {
    struct dyn_orbit *o = &list->orbit[list->n];
    truth first;
    dyn_orbit_init(o);
    long raises;
    status |= finish(o, &first, &raises, params, &found.s[i], prec, lim);
    list->raises += raises;
    if (first == TRUTH_FALSE)
      dyn_orbit_clear(o);
    else
      list->n++;
    solution_clear(&found.s[i]);
  }
  qsort(list->orbit, (size_t)list->n, sizeof *list->orbit, dyn_orbits_by_z10);
  free(found.s);
  search_clear(&search);
  return status;
}

void dyn_orbits_clear(struct dyn_orbits *list) {
  for (slong i = 0; i < list->n; i++) dyn_orbit_clear(&list->orbit[i]);
  free(list->orbit);
  *list = (struct dyn_orbits){.n = 0};
}
