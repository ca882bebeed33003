/* The return map over balls, twice.

   dyn_return_near starts from rough times of the events: return_map.c falls back on it where roundings in double
   precision would show.  dyn_return_first finds the events in balls and proves them to be first ones: the tests hold
   the map in double precision against it. */
#include <math.h>
#include <stdlib.h>

#include "arc.h"
#include "event.h"
#include "map_balls.h"
#include "return_map.h"
#include "return_map_double.h"

int dyn_return_near(struct num_vec *out, const struct num_vec *params, const void *r, const double guess[N_PHASES]) {
  OWNED(dyn_arc) arc;
  struct ball_params m;
  struct ball_pass s;
  val p[N_PARAMS], z[2], end[N_STATE];
  const double near[] = {0, guess[PHASE_GAMMA], guess[PHASE_H], guess[PHASE_C]};
  OWNED(calc) c = calc_begin(params->ctx);
  dyn_arc_init(&arc, params->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  ball_params_make(&m, &c, p);
  ball_positions(z, &c, &m, p[P_E1], r);
  int status = c.status;
  if (!status) status = arc_run(&arc, params, z[0], z[1], NULL, near);
  if (!status) {
    flow_vals(end, &arc.z, N_PHASES * N_STATE, N_STATE);
    bool up = calc_lt(&c, end[Z_1], end[Z_2]);
    if (!up && !calc_lt(&c, end[Z_2], end[Z_1])) return SS_UNABLE;
    ball_pass_make(&s, &c, &m, num_vec_at(&arc.t, PHASE_GAMMA), num_vec_at(&arc.t, PHASE_H), up);
    arb_set(num_vec_at(out, RETURN_TA), event_stick(&c, p, end));
    for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) arb_set(num_vec_at(out, RETURN_TA + ph), num_vec_at(&arc.t, ph));
    arb_set(num_vec_at(out, RETURN_R), s.r_end);
    arb_set(num_vec_at(out, RETURN_SLOPE), calc_div(&c, s.r_end_tb, s.pb));
    status = c.status;
  }
  return status;
}

/* --- First events. --- */

enum { SEARCH = 256 };

/* t_b and t_c of out. */
static truth are_first(const struct num_vec *params, const struct num_vec *out, long max_steps) {
  struct ball_params m;
  struct ball_pass s;
  val p[N_PARAMS], tb = num_vec_at(out, RETURN_TB), tc = num_vec_at(out, RETURN_TC);
  truth before_crest;
  OWNED(calc) c = calc_begin(params->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  ball_params_make(&m, &c, p);
  ball_pass_slip(&s, &c, &m, tb, tc);
  truth positive = truth_and(num_arb.lt(m.zero, tb), num_arb.lt(m.zero, tc));
  truth first = c.status ? TRUTH_UNKNOWN : truth_and(positive, ball_first_rise(&c, &m, &s, &before_crest));
  if (first == TRUTH_TRUE) first = ball_slower(&c, &m, &s, 0, max_steps);
  return first;
}

/* Times near the first events: t_b from the middles of the balls, t_c by the walk in balls from there. */
static int near_first(double t[N_PHASES], const struct num_vec *params, const void *r, long max_steps) {
  struct ball_params m;
  struct ball_pass s;
  struct return_map_double k;
  val p[N_PARAMS];
  double middle[N_PARAMS];
  OWNED(calc) c = calc_begin(params->ctx);
  flow_vals(p, params, 0, N_PARAMS);
  for (int i = 0; i < N_PARAMS; i++) middle[i] = num_arb.get_d(p[i]);
  ball_params_make(&m, &c, p);
  val rise = calc_sub(&c, calc_div(&c, p[P_E2], p[P_CHI]), r);
  int status = return_map_double_init(&k, middle) ? SS_UNABLE : c.status;
  t[PHASE_D] = t[PHASE_H] = 0;
  t[PHASE_GAMMA] = status ? 0 : return_map_double_time(&k, num_arb.get_d(rise));
  if (!(t[PHASE_GAMMA] > 0 && t[PHASE_GAMMA] < INFINITY)) status = SS_UNABLE;
  if (!status) {
    val tb = calc_d(&c, t[PHASE_GAMMA]);
    ball_pass_slip(&s, &c, &m, tb, tb);
    if (!ball_first_root(&t[PHASE_H], &c, &m, &s, max_steps)) status = SS_UNABLE;
    ball_pass_slip(&s, &c, &m, tb, calc_d(&c, t[PHASE_H]));
    double across = num_arb.get_d(calc_mul(&c, m.omega, s.rc)), q = num_arb.get_d(s.qc);
    t[PHASE_C] = atan2(fabs(q), q > 0 ? across : -across) / k.slip.omc;
    status |= c.status;
  }
  return status;
}

/* Velocities and lengths over 2^size, which is exact.  Which events are first is told at SEARCH bits at most. */
static int first_scaled(struct num_vec *out, const struct num_vec *params, const void *r, slong size, long max_steps) {
  static const int of[] = {P_V, P_E1, P_E2};
  double t[N_PHASES];
  OWNED(calc) c = calc_begin(params->ctx);
  struct num_vec p = calc_vec(&c, N_PARAMS), rough;
  arb_ptr from = calc_new(&c);
  num_vec_set(&p, params);
  for (int i = 0; i < 3; i++) arb_mul_2exp_si(num_vec_at(&p, of[i]), num_vec_at(&p, of[i]), -size);
  arb_mul_2exp_si(from, r, -size);
  rough = p;
  rough.ctx.prec = FLINT_MIN(p.ctx.prec, SEARCH);
  int status = near_first(t, &rough, from, max_steps);
  if (!status) status = dyn_return_near(out, &p, from, t);
  if (!status && are_first(&rough, out, max_steps) != TRUTH_TRUE) status = SS_UNABLE;
  if (!status) arb_mul_2exp_si(num_vec_at(out, RETURN_R), num_vec_at(out, RETURN_R), size);
  return status;
}

int dyn_return_first(struct num_vec *out, const struct num_vec *params, const void *r, long max_steps) {
  OWNED(calc) c = calc_begin(params->ctx);
  slong size = calc_exponent(&c, num_vec_at(params, P_V));
  return labs(size) < -CALC_TINY ? first_scaled(out, params, r, size, max_steps) : SS_UNABLE;
}
