/* How far an orbit stays away from every inequality that makes it realistic.

   Each inequality is a quantity whose least value over a phase is wanted.  Candidates are the ends of the phase and
   the roots of the derivative; they are offered one after the other to a running minimum that knows which values are
   exactly zero by definition.  Phase H has no closed form for its extremes: there time is halved until a piece is too
   high to matter, has no root of the acceleration, or has at most one, which an interval Newton iteration encloses. */
#include "margins.h"

#include <math.h>

#include "base/work.h"
#include "num/pi.h"
#include "orbit_judge.h"

enum { UNITS_OF_PIECE = 60 }; /* of work: a piece of phase H looked at */

const char *const dyn_where_name[] = {"start", "end", "inside", "throughout", "open"};

#define ABOUT(name, id, phase) {id, phase},
static const struct {
  const char *id;
  enum phase phase;
} about[N_MARGINS] = {DYN_CONDITIONS(ABOUT) DYN_MORE_MARGINS(ABOUT)};
#undef ABOUT

void dyn_margins_init(struct dyn_margins *m) {
  *m = (struct dyn_margins){.spent = false};
  for (int i = 0; i < N_MARGINS; i++) {
    m->at[i].id = about[i].id;
    m->at[i].phase = about[i].phase;
    m->at[i].holds = TRUTH_UNKNOWN;
  }
}

void dyn_margins_clear(struct dyn_margins *m) {
  for (int i = 0; i < N_MARGINS; i++) {
    arb_clear(m->at[i].margin);
    arb_clear(m->at[i].time);
    arb_clear(m->at[i].rate);
  }
  arb_clear(m->u_r1_min);
  arb_clear(m->u_r2_min);
}

/* --- The running minimum. --- */

/* Takes a candidate into the margin.  inside tells whether its time lies in the phase at all. */
static void offer(struct dyn_margin *m, struct calc *c, val value, val time, enum dyn_where where, truth inside) {
  truth lower = num_arb.lt(value, m->margin);
  bool first = !arb_is_finite(m->margin);
  if (inside == TRUTH_FALSE || (!first && num_arb.lt(m->margin, value) == TRUTH_TRUE)) return;
  if (first || (lower == TRUTH_TRUE && inside == TRUTH_TRUE)) {
    arb_set(m->margin, value);
    arb_set(m->time, time);
    m->where = where;
    m->by_definition = false;
    return;
  }
  arb_ptr least = calc_new(c);
  arb_min(least, m->margin, value, c->ctx.prec);
  if (inside == TRUTH_TRUE)
    arb_set(m->margin, least);
  else
    arb_union(m->margin, m->margin, least, c->ctx.prec);
  arb_union(m->time, m->time, time, c->ctx.prec);
  if (m->where != where) m->where = WHERE_OPEN;
  m->by_definition = false;
}

static void start_at(struct dyn_margin *m, struct calc *c, val value, val time, enum dyn_where where) {
  arb_indeterminate(m->margin);
  offer(m, c, value, time, where, TRUTH_TRUE);
}

/* A margin that is zero by definition at one end of its phase, with its first two derivatives into the phase. */
static void start_at_zero(struct dyn_margin *m, struct calc *c, val time, enum dyn_where where, val first, val second) {
  start_at(m, c, calc_d(c, 0), time, where);
  m->by_definition = true;
  m->order = !arb_contains_zero(first) ? 1 : !arb_contains_zero(second) ? 2 : 0;
  arb_set(m->rate, m->order == 1 ? first : second);
}

static void conclude(struct dyn_margin *m) {
  if (m->by_definition) {
    m->holds = m->order > 0 ? num_ball_positive(m->rate) : TRUTH_UNKNOWN;
  } else {
    m->order = 0;
    arb_zero(m->rate);
    m->holds = num_ball_positive(m->margin);
  }
}

/* --- The orbit in the coordinates of its phases. --- */

struct shape {
  struct calc *c;
  struct ball_params m;
  struct ball_pass s;
  val t[N_PHASES], begin[N_PHASES + 1]; /* durations, and when each phase starts */
  val slack;                            /* w's distance from e1 at the start of the period, a t_a */
  long *pieces;                         /* of phase H that may still be looked at */
};

static void shape_init(struct shape *x, struct calc *c, const fmpq *model, const struct dyn_orbit *o) {
  x->c = c;
  ball_params_with(&x->m, c, model, o->e1, o->e2);
  x->begin[0] = x->m.zero;
  for (int i = 0; i < N_PHASES; i++) {
    x->t[i] = o->t[i];
    x->begin[i + 1] = calc_add(c, x->begin[i], x->t[i]);
  }
  ball_pass_make(&x->s, c, &x->m, x->t[PHASE_GAMMA], x->t[PHASE_H], true);
  x->slack = calc_mul(c, x->m.a, x->t[PHASE_D]);
}

/* Whether 0 < t < the length of the phase. */
static truth within(const struct shape *x, enum phase ph, val t) {
  return truth_and(num_arb.lt(x->m.zero, t), num_arb.lt(t, x->t[ph]));
}

/* A candidate at the time t of a phase, if that lies in it. */
static void offer_at(struct dyn_margin *m, const struct shape *x, enum phase ph, val value, val t) {
  offer(m, x->c, value, calc_add(x->c, x->begin[ph], t), WHERE_INSIDE, within(x, ph, t));
}

/* --- Phase D: w rises steadily to e1, r stands still. --- */

static void stick_margins(struct dyn_margins *m, const struct shape *x) {
  struct calc *c = x->c;
  val zero = x->m.zero, fall = calc_mul(c, x->m.p[P_CHI], x->s.rise);
  start_at(&m->at[COND_TA], c, x->t[PHASE_D], zero, WHERE_THROUGHOUT);
  start_at(&m->at[COND_D_R], c, fall, zero, WHERE_THROUGHOUT);
  start_at_zero(&m->at[MARGIN_D_W], c, x->begin[PHASE_GAMMA], WHERE_END, x->m.a, zero);
  offer(&m->at[MARGIN_D_W], c, x->slack, zero, WHERE_START, TRUTH_TRUE);
  start_at(&m->at[MARGIN_D_W_LOW], c, zero, x->begin[PHASE_GAMMA], WHERE_END);
  offer(&m->at[MARGIN_D_W_LOW], c, calc_neg(c, x->slack), zero, WHERE_START, TRUTH_TRUE);
  start_at(&m->at[MARGIN_D_R_LOW], c, calc_neg(c, fall), zero, WHERE_THROUGHOUT);
}

/* --- Phase Gamma: V - z_1' = a (1 - cos t) + e1 sin t, and r has risen by the integral of that. --- */

static void gamma_v1(struct dyn_margin *m, const struct shape *x) {
  struct calc *c = x->c;
  val e1 = x->m.p[P_E1], a = x->m.a;
  start_at_zero(m, c, x->begin[PHASE_GAMMA], WHERE_START, e1, a);
  offer(m, c, calc_neg(c, x->s.pb), x->begin[PHASE_H], WHERE_END, TRUTH_TRUE);
  /* e1 cos t + a sin t = 0: the valleys lie where t = atan2(-e1, a), all as deep as the first one after pi. */
  val valley = calc_add(c, calc_atan2(c, calc_neg(c, e1), a), calc_mul(c, x->m.two, calc_pi(c)));
  val depth = calc_sub(c, a, calc_sqrt(c, calc_dot(c, a, a, e1, e1)));
  offer_at(m, x, PHASE_GAMMA, depth, valley);
}

/* chi r is highest at t_b, where it must be e2, or at a crest before; crests rise from one period of Gamma to the next,
   so that the last one before t_b is the highest, and the one before that is surely in the phase. */
static void gamma_r(struct dyn_margin *m, const struct shape *x) {
  struct calc *c = x->c;
  val chi = x->m.p[P_CHI];
  val first = calc_neg(c, calc_mul(c, chi, x->s.pb)), second = calc_neg(c, calc_mul(c, chi, x->s.wb));
  start_at_zero(m, c, x->begin[PHASE_H], WHERE_END, first, second);
  val crest = ball_crest(c, &x->m), turn = calc_mul(c, x->m.two, calc_pi(c));
  double whole = floor((num_arb.get_d(x->t[PHASE_GAMMA]) - num_arb.get_d(crest)) / (2 * PI)) - 1;
  if (whole > 0) crest = calc_add(c, crest, calc_mul(c, calc_d(c, whole), turn));
  truth in = within(x, PHASE_GAMMA, crest);
  for (int i = 0; i < 4 && in != TRUTH_FALSE; i++, in = within(x, PHASE_GAMMA, crest)) {
    val left = calc_mul(c, chi, calc_sub(c, x->s.rise, ball_rise(c, &x->m, crest)));
    offer_at(m, x, PHASE_GAMMA, left, crest);
    crest = calc_add(c, crest, turn);
  }
}

static void gamma_margins(struct dyn_margins *m, const struct shape *x) {
  struct calc *c = x->c;
  gamma_v1(&m->at[COND_GAMMA_V1], x);
  gamma_r(&m->at[COND_GAMMA_R], x);
  /* The rise a (t - sin t) + e1 (1 - cos t) is never negative. */
  start_at(&m->at[MARGIN_GAMMA_R_LOW], c, calc_neg(c, calc_mul(c, x->m.p[P_CHI], x->s.rise)), x->begin[PHASE_GAMMA],
           WHERE_START);
}

/* --- Phase H. --- */

/* V - velocity, its derivative and its second derivative. */
struct lag {
  val margin, rate, bend;
};

/* Of the first modes alone: of the slow one, or of both. */
static struct lag modes_at(const struct shape *x, int mass, val t, int n_modes) {
  struct calc *c = x->c;
  struct lag f = {x->m.p[P_V], x->m.zero, x->m.zero};
  for (int k = 0; k < n_modes; k++) {
    val a = x->s.modes.a[mass][k], b = x->s.modes.b[mass][k], om = x->m.spectrum.om[k], s, co;
    calc_sin_cos(c, &s, &co, calc_mul(c, om, t));
    val speed = calc_sub(c, calc_mul(c, a, co), calc_mul(c, b, s));
    f.margin = calc_sub(c, f.margin, speed);
    f.rate = calc_add(c, f.rate, calc_mul(c, om, calc_dot(c, a, s, b, co)));
    f.bend = calc_add(c, f.bend, calc_mul(c, calc_mul(c, om, om), speed));
  }
  return f;
}

/* A step towards the only root of the rate that a piece of time can hold, whose second derivative has one sign:
   mid - rate(mid)/bend(piece).  *piece becomes its intersection with that; false when it is empty. */
static bool newton_piece(arb_t piece, const struct shape *x, int mass) {
  struct calc *c = x->c;
  slong mark = calc_mark(c);
  arb_ptr mid = calc_new(c);
  arb_get_mid_arb(mid, piece);
  struct lag at = modes_at(x, mass, mid, 2), all = modes_at(x, mass, piece, 2);
  val root = calc_sub(c, mid, calc_div(c, at.rate, all.bend));
  bool any = !c->status && arb_intersection(piece, piece, root, c->ctx.prec);
  calc_release(c, mark);
  return any;
}

/* Newton's steps as long as each halves the piece.  *steps counts them. */
static bool narrow_root(arb_t piece, int *steps, const struct shape *x, int mass) {
  bool any = true, halved = true;
  NUMBERS(mag, before);
  for (*steps = 0; any && halved; ++*steps) {
    mag_mul_2exp_si(before, arb_radref(piece), -1);
    any = newton_piece(piece, x, mass);
    halved = mag_cmp(arb_radref(piece), before) < 0;
  }
  return any;
}

/* Whether the margin stays above its least value so far through the piece because the slow mode alone does, by more
   than the amplitude of the fast one: pieces far longer than an oscillation of the fast mode can be left out. */
static bool slow_is_above(const struct dyn_margin *m, const struct shape *x, int mass, val piece, val mid, val shift) {
  struct calc *c = x->c;
  struct lag at = modes_at(x, mass, mid, 1), all = modes_at(x, mass, piece, 1);
  val rate = calc_add(c, at.rate, calc_mul(c, all.bend, shift));
  val a = x->s.modes.a[mass][1], b = x->s.modes.b[mass][1];
  val least = calc_sub(c, calc_add(c, at.margin, calc_mul(c, rate, shift)), calc_sqrt(c, calc_dot(c, a, a, b, b)));
  return !c->status && num_arb.lt(m->margin, least) == TRUTH_TRUE;
}

/* Offers the valleys of the margin between low and high, in time since the start of phase H.  Pieces that lie too high
   or have no root of the rate are left out at a low precision; a root is enclosed at the full one. */
static void hunt(struct dyn_margin *m, const struct shape *x, int mass, double low, double high, slong prec) {
  struct calc *c = x->c;
  if (*x->pieces <= 0) return;
  if (--*x->pieces % WORK_BLOCK == 0) work_add((unsigned long long)WORK_BLOCK * UNITS_OF_PIECE);
  slong mark = calc_mark(c), coarse = c->ctx.prec;
  double half = 0.5 * (high - low);
  arb_ptr piece = calc_new(c);
  val mid = calc_d(c, low + half);
  arb_set(piece, mid);
  mag_set_d(arb_radref(piece), half * (1 + 1e-9));
  struct lag at = modes_at(x, mass, mid, 2), all = modes_at(x, mass, piece, 2);
  val shift = calc_sub(c, piece, mid), rate = calc_add(c, at.rate, calc_mul(c, all.bend, shift));
  val margin = calc_add(c, at.margin, calc_mul(c, rate, shift));
  bool idle = c->status || num_arb.lt(m->margin, margin) == TRUTH_TRUE || !arb_contains_zero(rate);
  idle = idle || slow_is_above(m, x, mass, piece, mid, shift);
  bool tiny = half < 1e-12 * (1 + high), done = tiny;
  if (!idle && !tiny && !arb_contains_zero(all.bend)) {
    int steps;
    c->ctx.prec = prec;
    idle = !narrow_root(piece, &steps, x, mass);
    done = steps > 1;
    c->ctx.prec = coarse;
  }
  if (!idle && done) {
    c->ctx.prec = prec;
    offer_at(m, x, PHASE_H, modes_at(x, mass, piece, 2).margin, piece);
    c->ctx.prec = coarse;
  } else if (!idle) {
    hunt(m, x, mass, low, low + half, prec);
    hunt(m, x, mass, low + half, high, prec);
  }
  calc_release(c, mark);
}

static void slip_margins(struct dyn_margins *m, const struct shape *x) {
  struct calc *c = x->c;
  struct dyn_margin *v1 = &m->at[COND_H_V1], *v2 = &m->at[COND_H_V2];
  val wc = x->s.wc, zero = x->m.zero;
  start_at_zero(v1, c, x->begin[PHASE_C], WHERE_END, calc_neg(c, wc),
                calc_sub(c, x->m.a, calc_mul(c, x->m.p[P_CHI], x->s.qc)));
  offer(v1, c, calc_neg(c, x->s.pb), x->begin[PHASE_H], WHERE_START, TRUTH_TRUE);
  start_at_zero(v2, c, x->begin[PHASE_H], WHERE_START, calc_mul(c, x->m.p[P_ETA], x->m.p[P_E2]), zero);
  offer(v2, c, calc_neg(c, x->s.qc), x->begin[PHASE_C], WHERE_END, TRUTH_TRUE);
  double end = num_arb.get_d(x->t[PHASE_H]) * (1 + 1e-12);
  slong prec = c->ctx.prec;
  c->ctx.prec = FLINT_MIN(prec, 64); /* to find the valleys; they are computed at the full precision */
  hunt(v1, x, 0, 0, end, prec);
  hunt(v2, x, 1, 0, end, prec);
  c->ctx.prec = prec;
}

/* --- Phase C. --- */

/* Offers e1 - w where w' vanishes, to the upper bound on w, and its negative to the lower one. */
static void c_w_valleys(struct dyn_margins *m, const struct shape *x) {
  struct calc *c = x->c;
  val u[2];
  if (!ball_force_turns(u, c, &x->m, x->s.r)) return;
  for (int i = 0; i < 2; i++) {
    val t = calc_sub(c, x->t[PHASE_C], calc_div(c, u[i], x->m.omega));
    val margin = ball_force_left(c, &x->m, x->t[PHASE_D], x->s.r, u[i]);
    offer_at(&m->at[COND_C_W], x, PHASE_C, margin, t);
    offer_at(&m->at[MARGIN_C_W_LOW], x, PHASE_C, calc_neg(c, margin), t);
  }
}

static void c_v2(struct dyn_margin *m, const struct shape *x) {
  struct calc *c = x->c;
  val r = x->s.r, zero = x->m.zero;
  start_at_zero(m, c, x->begin[N_PHASES], WHERE_END, calc_neg(c, calc_mul(c, x->m.stiff, r)), zero);
  offer(m, c, calc_neg(c, x->s.qc), x->begin[PHASE_C], WHERE_START, TRUTH_TRUE);
  val quarter = calc_mul(c, calc_d(c, 0.5), calc_pi(c));
  val t = calc_sub(c, x->t[PHASE_C], calc_div(c, quarter, x->m.omega));
  offer_at(m, x, PHASE_C, calc_neg(c, calc_mul(c, x->m.omega, r)), t);
}

static void c_margins(struct dyn_margins *m, const struct shape *x) {
  struct calc *c = x->c;
  c_v2(&m->at[COND_C_V2], x);
  val turn = calc_mul(c, x->m.omega, x->t[PHASE_C]), last = x->slack;
  val first = ball_force_left(c, &x->m, x->t[PHASE_D], x->s.r, turn);
  start_at(&m->at[COND_C_W], c, first, x->begin[PHASE_C], WHERE_START);
  offer(&m->at[COND_C_W], c, last, x->begin[N_PHASES], WHERE_END, TRUTH_TRUE);
  start_at(&m->at[MARGIN_C_W_LOW], c, calc_neg(c, first), x->begin[PHASE_C], WHERE_START);
  offer(&m->at[MARGIN_C_W_LOW], c, calc_neg(c, last), x->begin[N_PHASES], WHERE_END, TRUTH_TRUE);
  c_w_valleys(m, x);
}

/* --- All of them. --- */

/* The lower bounds so far hold the least value of the force minus e. */
static void lower_bounds(arb_t u_min, struct dyn_margin *one, struct dyn_margin *other, const fmpq *u, struct calc *c) {
  arb_min(u_min, one->margin, other->margin, c->ctx.prec);
  arb_mul_2exp_si(u_min, u_min, -1);
  arb_neg(u_min, u_min);
  struct dyn_margin *both[2] = {one, other};
  for (int i = 0; i < 2; i++) {
    if (u) {
      val force = calc_q(c, u);
      arb_set(both[i]->margin, calc_add(c, both[i]->margin, calc_add(c, force, force)));
    }
    conclude(both[i]);
    if (!u) both[i]->holds = TRUTH_UNKNOWN;
  }
}

int dyn_margins_find(struct dyn_margins *m, const fmpq *model, const struct dyn_orbit *orbit, const fmpq *u_r1,
                     const fmpq *u_r2, slong prec) {
  long pieces = DYN_MARGIN_PIECES;
  struct shape x = {.pieces = &pieces};
  OWNED(calc) c = calc_begin(num_ctx_arb(prec));
  shape_init(&x, &c, model, orbit);
  if (!c.status) {
    stick_margins(m, &x);
    gamma_margins(m, &x);
    slip_margins(m, &x);
    c_margins(m, &x);
    for (int i = 0; i < MARGIN_D_W_LOW; i++) conclude(&m->at[i]);
    lower_bounds(m->u_r1_min, &m->at[MARGIN_D_W_LOW], &m->at[MARGIN_C_W_LOW], u_r1, &c);
    lower_bounds(m->u_r2_min, &m->at[MARGIN_D_R_LOW], &m->at[MARGIN_GAMMA_R_LOW], u_r2, &c);
  }
  m->spent = pieces <= 0;
  return m->spent ? c.status | SS_UNABLE : c.status;
}
