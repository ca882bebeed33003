#include "accuracy.h"

#include <check.h>
#include <math.h>
#include <string.h>

#include "local.h"
#include "motion/event.h"
#include "params.h"
#include "rational.h"

enum { MOVE = 60 };

/* |x - y| / |y| */
static double apart(arb_srcptr x, arb_srcptr y) {
  if (arb_equal(x, y)) return 0;
  NUMBERS(arb, d);
  arb_sub(d, x, y, ACCURACY_BITS);
  arb_div(d, d, y, ACCURACY_BITS);
  return fabs(num_arb.get_d(d));
}

bool accuracy_of(double *error, double *condition, const struct method *m, const double *in, const double *got,
                 void *arg) {
  OWNED(num_vec) at = vec_new(m->n_out, num_ctx_arb(ACCURACY_BITS));
  OWNED(num_vec) moved = vec_new(m->n_out, num_ctx_arb(ACCURACY_BITS));
  bool good = m->truth(&at, in, -1, arg);
  for (int i = 0; i < m->n_out && condition; i++) condition[i] = 0;
  for (int k = 0; k < m->n_in && good && condition; k++) {
    good = m->truth(&moved, in, k, arg);
    for (int i = 0; i < m->n_out && good; i++)
      condition[i] += ldexp(apart(num_vec_at(&moved, i), num_vec_at(&at, i)), MOVE);
  }
  for (int i = 0; i < m->n_out && good; i++) {
    NUMBERS(arb, y);
    arb_set_d(y, got[i]);
    error[i] = ldexp(apart(y, num_vec_at(&at, i)), 53);
  }
  return good;
}

/* The parameters in exact numbers, one of them moved. */
static fmpq *moved_params(const double p[N_PARAMS], int moved) {
  fmpq *q = rationals_d(p, N_PARAMS);
  NUMBERS(fmpq, more);
  if (moved >= 0) {
    fmpq_div_2exp(more, q + moved, MOVE);
    fmpq_add(q + moved, q + moved, more);
  }
  return q;
}

/* Near which times, and what is proved of the orbit of the parameters themselves. */
struct orbit_truth {
  double tb, tc;
  bool up;     /* z_20 > z_10 */
  bool found;  /* then: */
  truth first; /* the events are first ones */
  truth holds[N_CONDITIONS];
};

/* From the parameters the numbers of enum dyn_output. */
static bool orbit_at(struct num_vec *out, const double *in, int moved, void *arg) {
  struct orbit_truth *t = arg;
  OWNED(dyn_orbit) o;
  truth first = TRUTH_UNKNOWN;
  FREED_PARAMS fmpq *params = moved_params(in, moved);
  bool found =
      dyn_orbit_near(&o, &first, params, (struct dyn_place){t->tb, t->tc, t->up}, ACCURACY_BITS, NULL) == SS_OK;
  for (int i = 0; i < N_DYN_OUT && found; i++)
    num_arb.set(num_vec_at(out, i), dyn_orbit_output(&o, (enum dyn_output)i));
  if (moved < 0) {
    t->found = found;
    t->first = first;
    if (found) memcpy(t->holds, o.holds, sizeof t->holds);
  }
  return found;
}

static const struct method orbit_method = {N_PARAMS, N_DYN_OUT, orbit_at};

void check_six_equations(double (*start)[N_STATE], const struct dyn_orbit *o, const struct num_vec *params,
                         const char *what) {
  slong prec = params->ctx.prec;
  OWNED(num_vec) z = vec_new(N_STATE, params->ctx), m = vec_new(N_STATE * N_STATE, params->ctx);
  OWNED(num_vec) value = vec_new(1, params->ctx);
  arb_ptr v = num_vec_at(&value, 0);
  arb_srcptr belt = num_vec_at(params, P_V);
  arb_set(num_vec_at(&z, Z_1), o->z10);
  arb_set(num_vec_at(&z, Z_2), o->z20);
  for (int i = 0; i < 2; i++) arb_set(num_vec_at(&z, DZ_1 + i), belt);
  for (int ph = 0; ph < N_PHASES; ph++) {
    for (int i = 0; start && i < N_STATE; i++) start[ph][i] = num_arb.get_d(num_vec_at(&z, i));
    ck_assert_int_eq(dyn_propagator(&m, (enum phase)ph, params, o->t[ph]), SS_OK);
    ck_assert_int_eq(num_mat_mul(&z, &m, &z, N_STATE, N_STATE, 1), SS_OK);
    ck_assert_int_eq(dyn_switching(v, (enum phase)ph, params, &z), SS_OK);
    ck_assert_msg(arb_contains_zero(v), "%s: phase %d does not end", what, ph);
    ck_assert_msg(mag_cmp_2exp_si(arb_radref(v), -prec / 3) < 0, "%s: the enclosure of phase %d is wide", what, ph);
  }
  ck_assert(arb_overlaps(num_vec_at(&z, Z_1), o->z10) && arb_overlaps(num_vec_at(&z, Z_2), o->z20));
  for (int i = 0; i < 2; i++) ck_assert(arb_overlaps(num_vec_at(&z, DZ_1 + i), belt));
}

void check_conditions(const truth holds[N_CONDITIONS], unsigned violations, unsigned unsure) {
  ck_assert_uint_eq(violations & unsure, 0);
  for (int i = 0; i < N_CONDITIONS; i++)
    ck_assert_msg((unsure >> i & 1) || holds[i] == (violations >> i & 1 ? TRUTH_FALSE : TRUTH_TRUE), "%s",
                  dyn_condition_id[i]);
}

bool check_orbit_found(double condition[N_DYN_OUT], const double p[N_PARAMS], const double out[N_DYN_OUT],
                       unsigned violations, unsigned unsure) {
  double error[N_DYN_OUT];
  struct orbit_truth t = {.tb = out[DYN_OUT_TB], .tc = out[DYN_OUT_TC], .up = out[DYN_OUT_Z20] > out[DYN_OUT_Z10]};
  bool steep = accuracy_of(error, condition, &orbit_method, p, out, &t);
  ck_assert_msg(t.found && t.first == TRUTH_TRUE, "%s: no orbit at t_b %.17g t_c %.17g", params_shown(p), t.tb, t.tc);
  check_conditions(t.holds, violations, unsure);
  for (int i = 0; i < N_DYN_OUT && steep; i++)
    ck_assert_msg(error[i] <= fmin(8 * (1 + condition[i]), 2), "%s: output %d errs by %g, condition %g",
                  params_shown(p), i, error[i], condition[i]);
  return steep;
}

int first_event_d(double *t, bool *grazing, enum phase ph, const double params[N_PARAMS], const double in[N_STATE],
                  const struct dyn_limits *lim) {
  OWNED(calc) c = calc_begin(num_ctx_mpfr(128));
  const struct num_vec p = calc_vec_d(&c, params, N_PARAMS), z = calc_vec_d(&c, in, N_STATE);
  return event_first(t, grazing, ph, &p, &z, lim);
}
