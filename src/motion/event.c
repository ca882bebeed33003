/* Where a phase ends.

   The first event is found in double precision from the wave that the phase shows to its switching function.  A known
   event is refined by Newton's iteration at a precision that doubles; in balls Krawczyk's operator then proves that the
   enclosure holds exactly one root, for every point of the balls of parameters and state. */
#include <math.h>

#include "event.h"
#include "mode_motion.h"
#include "num/solve.h"

enum { MOST_STEPS = 60 }; /* of Newton's iteration */

/* The switching function of a phase other than D as a wave: a force or a speed in that pair of modes, where what sticks
   keeps the velocity that it has. */
static struct trig_sum phase_wave(struct calc *c, enum phase ph, const val p[N_PARAMS], const val z[N_STATE]) {
  const int *slips = phase_slips[ph];
  val chi = p[P_CHI], belt = !slips[0] ? z[DZ_1] : !slips[1] ? z[DZ_2] : p[P_V];
  val w = flow_force(c, 0, chi, z), pull = flow_force(c, 1, chi, z);
  const struct motion_start at = {
      {w, pull}, {calc_sub(c, z[DZ_1], belt), calc_sub(c, z[DZ_2], belt)}, {calc_neg(c, w), calc_neg(c, pull)}};
  struct motion_law law;
  struct motion m;
  motion_law_make(&law, c, chi, p[P_ETA], belt, ph == PHASE_H);
  motion_make(&m, c, &law, slips, &at);
  struct trig_sum wave = harmonic_trig_sum(c, ph == PHASE_GAMMA ? &m.force[1] : &m.speed[ph == PHASE_C]);
  wave.start = c->ctx.type->get_d(flow_switching(c, ph, p, z));
  return wave;
}

static bool is_finite(const struct trig_sum *w) {
  bool finite = isfinite(w->start) && isfinite(w->drift);
  for (int i = 0; i < 2; i++) finite = finite && isfinite(w->om[i]) && isfinite(w->cs[i]) && isfinite(w->sn[i]);
  return finite;
}

static int first_in_calc(struct trig_sum_root *root, struct calc *c, enum phase ph, const val p[N_PARAMS],
                         const val z[N_STATE], const struct dyn_limits *lim) {
  if (ph == PHASE_D) {
    root->t = c->ctx.type->get_d(event_stick(c, p, z));
    return c->status & SS_DOMAIN ? SS_DOMAIN : c->status || !isfinite(root->t) ? SS_UNABLE : SS_OK;
  }
  struct trig_sum wave = phase_wave(c, ph, p, z);
  return c->status || !is_finite(&wave) ? SS_UNABLE
                                        : trig_sum_first_root(root, &wave, NULL, lim ? lim : &dyn_limits_default);
}

int event_first(double *t, bool *grazing, enum phase ph, const struct num_vec *params, const struct num_vec *in,
                const struct dyn_limits *lim) {
  val p[N_PARAMS], z[N_STATE];
  double all[N_PARAMS];
  struct trig_sum_root root = {.t = 0};
  OWNED(calc) c = calc_begin(params->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  flow_vals(z, in, 0, N_STATE);
  for (int i = 0; i < N_PARAMS; i++) all[i] = c.ctx.type->get_d(p[i]);
  int status = dyn_in_domain_d(all) ? first_in_calc(&root, &c, ph, p, z, lim) : SS_DOMAIN;
  *t = root.t;
  if (grazing) *grazing = root.grazing;
  return status;
}

/* The switching function after t from the state in, and its rate. */
static void look_at(val f[2], struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val t) {
  val z[N_STATE];
  struct blocks b = flow_blocks(c, ph, p, t);
  flow_apply(z, c, &b, in);
  f[0] = flow_switching(c, ph, p, z);
  f[1] = flow_switching_rate(c, ph, p, z);
}

val event_newton(struct calc *c, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], val start) {
  const struct num_type *type = c->ctx.type;
  void *t = calc_new(c);
  type->set(t, start);
  val small = calc_two_to(c, -c->ctx.prec / 2 - 6);
  slong mark = calc_mark(c);
  for (int i = 0; i < MOST_STEPS && !c->status; i++) {
    val f[2];
    look_at(f, c, ph, p, in, t);
    val step = calc_div(c, f[0], f[1]);
    c->status |= type->sub(t, t, step, c->ctx.prec);
    bool settled = !calc_lt(c, calc_mul(c, small, calc_abs(c, t)), calc_abs(c, step));
    calc_release(c, mark);
    if (settled) return t;
  }
  c->status |= SS_UNABLE;
  return t;
}

/* The end of a phase as an equation in t. */
struct ending {
  struct calc *c;
  enum phase phase;
  const val *p, *in;
  struct num_vec t; /* where it has come to */
  slong mark;       /* what lies above it in the calc belongs to one evaluation */
};

static int level(slong bits, void *self) {
  const struct ending *e = self;
  OWNED(calc) c = calc_begin(num_ctx_mpfr(bits));
  calc_store(&c, num_vec_at(&e->t, 0), event_newton(&c, e->phase, e->p, e->in, num_vec_at(&e->t, 0)));
  return c.status;
}

/* The root near t0 for exact mpfr data, with guard bits over the precision of *t. */
static int event_mpfr(void *t, slong prec, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], double t0) {
  struct ending e = {.phase = ph, .p = p, .in = in};
  num_vec_init(&e.t, 1, num_ctx_mpfr(prec + 32));
  int status = num_mpfr.set_d(num_vec_at(&e.t, 0), t0, prec + 32);
  if (!status) status = newton_rising(level, &e, prec + 32);
  num_mpfr.set(t, num_vec_at(&e.t, 0));
  num_vec_clear(&e.t);
  return status;
}

static int values(const void **f, const void **j, const struct num_vec *t, void *self) {
  const struct ending *e = self;
  val at[2];
  calc_release(e->c, e->mark);
  e->c->status = SS_OK;
  look_at(at, e->c, e->phase, e->p, e->in, num_vec_at(t, 0));
  if (f) f[0] = at[0];
  j[0] = at[1];
  return e->c->status;
}

/* In balls: from the root of their middles, for every point of the parameters and of the state. */
static int event_arb(arb_t t, slong prec, enum phase ph, const val p[N_PARAMS], const val in[N_STATE], double t0) {
  val middle_p[N_PARAMS], middle_in[N_STATE];
  OWNED(calc) c = calc_begin(num_ctx_arb(prec + 32));
  struct ending e = {&c, ph, middle_p, middle_in, calc_vec(&c, 1), 0};
  const struct solve_system system = {1, values, &e};
  for (int i = 0; i < N_PARAMS; i++) middle_p[i] = calc_middle(&c, p[i]);
  for (int i = 0; i < N_STATE; i++) middle_in[i] = calc_middle(&c, in[i]);
  e.mark = calc_mark(&c);
  int status = num_arb.set_d(num_vec_at(&e.t, 0), t0, prec);
  if (!status) status = newton_settle(&e.t, &system, MOST_STEPS);
  e.p = p;
  e.in = in;
  if (!status) status = krawczyk_enclose(&e.t, NULL, &system);
  if (!status) arb_set_round(t, num_vec_at(&e.t, 0), prec);
  return status;
}

val event_stick(struct calc *c, const val p[N_PARAMS], const val in[N_STATE]) {
  return calc_neg(c, calc_div(c, flow_switching(c, PHASE_D, p, in), flow_switching_rate(c, PHASE_D, p, in)));
}

int dyn_event(void *t, enum phase ph, const struct num_vec *params, const struct num_vec *in, double t0) {
  val p[N_PARAMS], z[N_STATE];
  const struct num_type *type = params->ctx.type;
  flow_vals(p, params, 0, N_PARAMS);
  flow_vals(z, in, 0, N_STATE);
  if (ph != PHASE_D && type == &num_mpfr) return event_mpfr(t, params->ctx.prec, ph, p, z, t0);
  if (ph != PHASE_D && type != &num_double) return event_arb(t, params->ctx.prec, ph, p, z, t0);
  OWNED(calc) c = calc_begin(params->ctx);
  type->set(t, ph == PHASE_D ? event_stick(&c, p, z) : event_newton(&c, ph, p, z, &t0));
  return c.status;
}
