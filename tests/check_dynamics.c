/* The laws of the suite's own model.

   Closed forms are held against matrix exponentials, events against dense sampling and against motions whose roots are
   known, derivatives against differences, orbits against the six equations evaluated with matrix exponentials, their
   conditions against margins found by another route.  Random operands are dyadic, so that every number type sees the
   same ones; a failing trial prints them. */
#include "accuracy.h"
#include "effort.h"
#include "every.h"
#include "explore/family.h"
#include "motion/complete.h"
#include "motion/dynamics.h"
#include "motion/flow.h"
#include "motion/margins.h"
#include "motion/polish.h"
#include "motion/return_map_double.h"
#include "motion/trig_sum.h"
#include "motion/warm.h"
#include "params.h"
#include "plain.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

static void random_params(double p[N_PARAMS], struct rng *r) {
  p[P_CHI] = rng_dyadic(r, 3, 61);
  p[P_ETA] = rng_dyadic(r, 8, 256);
  p[P_V] = rng_dyadic(r, 32, 128);
  p[P_E1] = rng_dyadic(r, 16, 384);
  p[P_E2] = rng_dyadic(r, 16, 384);
}

/* The largest |x_i - y_i| between vectors of any types, rounded up. */
static double distance(const struct num_vec *x, const struct num_vec *y) {
  NUMBERS(arb, a, b);
  NUMBERS(mag, worst, gap);
  for (slong i = 0; i < x->len; i++) {
    x->ctx.type->get_arb(a, num_vec_at(x, i));
    y->ctx.type->get_arb(b, num_vec_at(y, i));
    arb_sub(a, a, b, 4000);
    arb_get_mag(gap, a);
    mag_max(worst, worst, gap);
  }
  return mag_get_d(worst);
}

static double largest(const struct num_vec *x) {
  double m = 0;
  for (slong i = 0; i < x->len; i++) m = fmax(m, fabs(vec_d(x, i)));
  return m;
}

/* --- Propagators and flows. --- */

TEST_EACH(propagators_of_all_types_agree, 40) {
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS], t;
  random_params(pd, &r);
  t = rng_dyadic(&r, -640, 1280);
  struct num_ctx ctx[4] = {num_ctx_arb(320), num_ctx_double(), num_ctx_mpfr(64), num_ctx_mpfr(200)};
  double bound[4] = {0, 1e-11, ldexp(1, 4 - 64), ldexp(1, 4 - 200)};
  for (int ph = 0; ph < N_PHASES; ph++) {
    struct num_vec m[4];
    for (int k = 0; k < 4; k++) {
      OWNED(num_vec) p = vec_of(pd, N_PARAMS, ctx[k]), time = vec_of(&t, 1, ctx[k]);
      num_vec_init(&m[k], 16, ctx[k]);
      ck_assert_int_eq(dyn_propagator(&m[k], (enum phase)ph, &p, num_vec_at(&time, 0)), SS_OK);
      double d = distance(&m[0], &m[k]);
      if (k > 0) ck_assert_msg(d <= bound[k] * largest(&m[0]), "%s t %g phase %d: %g", params_shown(pd), t, ph, d);
    }
    for (int k = 0; k < 4; k++) num_vec_clear(&m[k]);
  }
}

TEST(taylor_keeps_its_promise_for_long_times) {
  /* 2^(4-prec) of the largest entry although the series is squared about twenty times; Arb is the judge. */
  double pd[N_PARAMS] = {0.5, 64, 1, 1, 1}, t = 100000;
  OWNED(num_vec) p = vec_of(pd, N_PARAMS, num_ctx_mpfr(128)), time = vec_of(&t, 1, num_ctx_mpfr(128));
  OWNED(num_vec) pa = vec_of(pd, N_PARAMS, num_ctx_arb(1000)), ta = vec_of(&t, 1, num_ctx_arb(1000));
  OWNED(num_vec) m = vec_new(16, num_ctx_mpfr(128));
  OWNED(num_vec) e = vec_new(16, num_ctx_arb(1000));
  for (int ph = 0; ph < N_PHASES; ph++) {
    ck_assert_int_eq(dyn_propagator(&m, (enum phase)ph, &p, num_vec_at(&time, 0)), SS_OK);
    ck_assert_int_eq(dyn_propagator(&e, (enum phase)ph, &pa, num_vec_at(&ta, 0)), SS_OK);
    ck_assert(distance(&m, &e) <= ldexp(1, 4 - 128) * largest(&e));
  }
}

static void random_state(double z[N_STATE], struct rng *r) {
  for (int i = 0; i < N_STATE; i++) z[i] = rng_dyadic(r, -256, 256);
}

TEST_EACH(flow_is_the_propagator_applied, 40) {
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS], zd[N_STATE], t;
  random_params(pd, &r);
  random_state(zd, &r);
  t = rng_dyadic(&r, -320, 640);
  struct num_ctx ctx[3] = {num_ctx_double(), num_ctx_mpfr(150), num_ctx_arb(150)};
  double bound[3] = {1e-11, ldexp(1, 14 - 150), ldexp(1, 20 - 150)};
  for (int k = 0; k < 3; k++)
    for (int ph = 0; ph < N_PHASES; ph++) {
      OWNED(num_vec) p = vec_of(pd, N_PARAMS, ctx[k]), z = vec_of(zd, N_STATE, ctx[k]), time = vec_of(&t, 1, ctx[k]);
      OWNED(num_vec) m = vec_new(16, ctx[k]);
      OWNED(num_vec) moved = vec_new(N_STATE, ctx[k]);
      ck_assert_int_eq(dyn_propagator(&m, (enum phase)ph, &p, num_vec_at(&time, 0)), SS_OK);
      double size = largest(&m) * largest(&z);
      ck_assert_int_eq(num_mat_mul(&moved, &m, &z, 4, 4, 1), SS_OK);
      ck_assert_int_eq(dyn_flow(&z, (enum phase)ph, &p, &z, num_vec_at(&time, 0)), SS_OK);
      double d = distance(&moved, &z);
      ck_assert_msg(d <= bound[k] * size, "%s t %g phase %d type %d: %g", params_shown(pd), t, ph, k, d / size);
      if (k == 2)
        for (slong i = 0; i < N_STATE; i++) ck_assert(arb_overlaps(num_vec_at(&moved, i), num_vec_at(&z, i)));
    }
}

static void flow_d(double out[N_STATE], enum phase ph, const double p[N_PARAMS], const double in[N_STATE], double t) {
  OWNED(num_vec) pv = vec_of(p, N_PARAMS, num_ctx_double()), z = vec_of(in, N_STATE, num_ctx_double());
  ck_assert_int_eq(dyn_flow(&z, ph, &pv, &z, &t), SS_OK);
  for (slong i = 0; i < N_STATE; i++) out[i] = vec_d(&z, i);
}

static double switching_d(enum phase ph, const double p[N_PARAMS], const double in[N_STATE], double *rate) {
  OWNED(num_vec) pv = vec_of(p, N_PARAMS, num_ctx_double()), z = vec_of(in, N_STATE, num_ctx_double());
  double value;
  ck_assert_int_eq(dyn_switching(&value, ph, &pv, &z) | dyn_switching_rate(rate, ph, &pv, &z), SS_OK);
  return value;
}

/* --- First events. --- */

TEST_EACH(first_event_is_a_root_and_the_first, 60) {
  /* Against a dense sampling of the motion; the sampling misses what happens within a step, so it decides by signs. */
  struct rng r = {(uint64_t)_i};
  double p[N_PARAMS], z[N_STATE], at[N_STATE], t, rate;
  bool grazing;
  random_params(p, &r);
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    random_state(z, &r);
    int status = first_event_d(&t, &grazing, (enum phase)ph, p, z, NULL);
    double start = switching_d((enum phase)ph, p, z, &rate), size = 20 * (fabs(start) + fabs(rate) + 1);
    if (start == 0) continue;
    double span = status ? 60 : t;
    for (int i = 1; i < 500; i++) {
      flow_d(at, (enum phase)ph, p, z, span * i / 500);
      double f = switching_d((enum phase)ph, p, at, &rate);
      ck_assert_msg(f * start > 0, "%s phase %d: sign changes before %g (status %d)", params_shown(p), ph, span,
                    status);
    }
    if (status) continue;
    flow_d(at, (enum phase)ph, p, z, t);
    double f = switching_d((enum phase)ph, p, at, &rate);
    ck_assert_msg(fabs(f) < 1e-13 * size * (1 + t), "%s phase %d t %g residual %g", params_shown(p), ph, t, f);
    ck_assert_msg(grazing || rate * start < 0, "%s phase %d t %g: no crossing", params_shown(p), ph, t);
  }
}

/* Phase C with chi eta = 1, z_1' = 0 and r = 0: z_2' = z_2'(0) cos t. */
static int cosine_event(double *t, bool *grazing, double amplitude) {
  const double p[N_PARAMS] = {0.5, 2, 1, 1, 1}, z[N_STATE] = {0.25, 0.25, 0, amplitude};
  return first_event_d(t, grazing, PHASE_C, p, z, NULL);
}

TEST(close_roots_grazing_and_none_are_told_apart) {
  double t;
  bool grazing;
  for (int k = 4; k <= 46; k += 3) { /* the crest of -(1 + eps) cos t exceeds V = 1 by eps */
    double eps = ldexp(1, -k), apart = 2 * asin(sqrt(eps / (2 * (1 + eps))));
    ck_assert_int_eq(cosine_event(&t, &grazing, -1 - eps), SS_OK);
    ck_assert_msg(fabs(t - (acos(-1.0) - apart)) < 4e-16 * ldexp(1, k / 2) + 1e-15, "eps 2^-%d: %.17g", k, t);
    ck_assert(!grazing);
    ck_assert_int_eq(cosine_event(&t, &grazing, -1 + eps), SS_DOMAIN);
  }
  ck_assert_int_eq(cosine_event(&t, &grazing, -1), SS_OK);
  ck_assert(grazing && fabs(t - acos(-1.0)) < 1e-7);
}

TEST(a_root_at_the_start_does_not_count) {
  double t, p[N_PARAMS] = {0.5, 2, 1, 1, 1};
  bool grazing;
  /* Phase C: q = -r sin t from q = 0, both signs of r: the first positive root is pi. */
  for (int sign = -1; sign <= 1; sign += 2) {
    double z[N_STATE] = {0, sign, 1, 1};
    ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_C, p, z, NULL), SS_OK);
    ck_assert(fabs(t - acos(-1.0)) < 1e-15 && !grazing);
  }
  /* Phase Gamma from chi r = e2 with both velocities V: r only grows, since e1, V > 0. */
  double z[N_STATE] = {0, 0, 1, 1};
  z[Z_1] = (p[P_E1] + p[P_E2]) / (1 - p[P_CHI]); /* w = e1, chi r = e2 */
  z[Z_2] = z[Z_1] + p[P_E2] / p[P_CHI];
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_GAMMA, p, z, NULL), SS_DOMAIN);
  /* Phase H from p = 0 with w < 0: p starts upwards and the first root is where it comes down again. */
  double y[N_STATE] = {-1, -1, 1, 1}, at[N_STATE], rate;
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_H, p, y, NULL), SS_OK);
  flow_d(at, PHASE_H, p, y, t);
  ck_assert(t > 0.1 && fabs(switching_d(PHASE_H, p, at, &rate)) < 1e-14 && rate < 0);
  flow_d(at, PHASE_H, p, y, 0.5 * t);
  ck_assert(switching_d(PHASE_H, p, at, &rate) > 0);
}

TEST(a_long_wait_ends_at_the_first_root) {
  /* Far back from a moment at which both modes of z_1' crest together a little above V; z_1' is the sum of two
     cosines, so nothing but a near coincidence reaches V.  The oracle is a dense sampling of the motion. */
  const double p[N_PARAMS] = {0.5, 1, 1, 1, 1}, wait = 730;
  double crest[N_STATE] = {0, 0, 1 + 1.0 / 1024, 0.25}, z[N_STATE], at[N_STATE], t, rate, sampled = 0;
  bool grazing;
  flow_d(z, PHASE_H, p, crest, -wait);
  ck_assert(switching_d(PHASE_H, p, z, &rate) < 0);
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_H, p, z, NULL), SS_OK);
  for (int i = 1; sampled == 0 && i < 80000; i++) {
    flow_d(at, PHASE_H, p, z, wait * i / 80000);
    if (switching_d(PHASE_H, p, at, &rate) > 0) sampled = wait * i / 80000;
  }
  if (sampled == 0) sampled = wait;
  ck_assert_msg(t <= sampled && t > sampled - 0.1 && t > 100, "found %.17g sampled %.17g", t, sampled);
  struct dyn_limits shorter = {0.5 * t, 100000}, fewer = {1000, 3};
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_H, p, z, &shorter), SS_UNABLE);
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_H, p, z, &fewer), SS_UNABLE);
}

/* The first time from begin on at which the wave, looked at every step, is above zero. */
static double looked_for(const struct trig_sum *w, double begin, double end, double step) {
  double v[3];
  for (double t = begin; t < end; t += step) {
    trig_sum_at(v, w, t);
    if (v[0] > 0) return t;
  }
  return INFINITY;
}

TEST(a_fast_oscillation_of_small_amplitude) {
  /* A slow one that comes within about the fast one's amplitude of zero at its crest, at t = late, and later goes far
     above it.  The oracle looks at every 64th of a fast period; few steps find the same root. */
  static const double fast[] = {300, 3000, 30000}, lift[] = {-0.9, -0.3, 0, 0.5, 0.99, 1.5};
  for (size_t i = 0; i < 3; i++)
    for (size_t k = 0; k < 6; k += i < 2 ? 1 : (size_t)every(3)) {
      double a = 3 / fast[i], late = 2.5, crest = -a * lift[k], height = crest - 1; /* slow: height + cos(t - late) */
      double cs = cos(late), sn = sin(late), step = 2 * acos(-1.0) / fast[i] / 64;
      struct trig_sum w = {height + cs, 0.01 * a, {1, fast[i]}, {cs, a * 0.6}, {sn, a * 0.8}};
      w.start += 0.6 * a; /* so that the fast one is centred */
      struct trig_sum_root root;
      ck_assert(w.start < 0);
      ck_assert_int_eq(trig_sum_first_root(&root, &w, NULL, &dyn_limits_default), SS_OK);
      double seen = looked_for(&w, 0, root.t, step), above = looked_for(&w, root.t, root.t + step, step / 4096);
      ck_assert_msg(seen == INFINITY && above < INFINITY, "fast %g lift %g: %.17g, above zero at %.17g", fast[i],
                    lift[k], root.t, seen);
      ck_assert_msg(root.steps < 1500, "fast %g lift %g: %ld steps", fast[i], lift[k], root.steps);
    }
}

TEST(a_slow_drift_from_far_below) {
  /* Crests rise by a thousandth of the amplitude from one to the next: a million of them stay below zero. */
  struct trig_sum w = {-1e4, 0.002, {1, 0}, {1, 0}, {0, 0}};
  struct dyn_limits lim = {INFINITY, 400};
  struct trig_sum_root root;
  w.start += 1; /* w.start - cs is the middle */
  ck_assert_int_eq(trig_sum_first_root(&root, &w, NULL, &lim), SS_OK);
  double begin = (1e4 - 1 - 1e-6) / 0.002, seen = looked_for(&w, begin, begin + 1e3, 1e-3);
  ck_assert_msg(root.t <= seen && root.t > seen - 2e-3, "%.17g, seen at %.17g", root.t, seen);
}

TEST(angles_that_no_double_knows) {
  /* Nothing is known of the fast oscillation's angle: no answer rather than any. */
  struct trig_sum w = {-1, 0, {1, 1e20}, {-1, 1e-6}, {0, 0}};
  struct trig_sum_root root;
  ck_assert_int_eq(trig_sum_first_root(&root, &w, NULL, &dyn_limits_default), SS_UNABLE);
  ck_assert_int_lt(root.steps, 1000);
}

TEST(stick_phase_ends_at_either_sign) {
  const double p[N_PARAMS] = {0.5, 2, 1, 1, 1};
  double z[N_STATE] = {0, 0, 1, 1}, t;
  bool grazing;
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_D, p, z, NULL), SS_OK);
  ck_assert(t == 2); /* w = t/2 reaches e1 = 1 */
  z[Z_1] = 3;
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_D, p, z, NULL), SS_OK);
  ck_assert(t == -4);
  z[DZ_1] = 0.5; /* w' = 0 */
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_D, p, z, NULL), SS_DOMAIN);
}

/* z_1 = z_2 = 1 + 2^-30 and chi = 1 - 2^-30: w = 2^-30 + 2^-60, of which the second part is lost where chi z_2 is
   rounded. */
TEST(forces_are_not_lost_in_positions) {
  const double tiny = 0x1p-30, p[N_PARAMS] = {1 - tiny, 1, 1, tiny, 1}, z[N_STATE] = {1 + tiny, 1 + tiny, 1, 1};
  double t;
  bool grazing;
  ck_assert_int_eq(first_event_d(&t, &grazing, PHASE_D, p, z, NULL), SS_OK);
  ck_assert_double_eq(t, -tiny);
}

TEST_EACH(refined_events_agree_and_are_proved, 60) {
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS], zd[N_STATE], t0;
  bool grazing;
  random_params(pd, &r);
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    random_state(zd, &r);
    if (first_event_d(&t0, &grazing, (enum phase)ph, pd, zd, NULL) || grazing) continue;
    struct num_ctx ctx[3] = {num_ctx_arb(400), num_ctx_mpfr(300), num_ctx_double()};
    double bound[3] = {ldexp(1, 30 - 400), ldexp(1, 2 - 300), 1e-10}; /* double: the root may be flat */
    struct num_vec t[3];
    for (int k = 0; k < 3; k++) {
      OWNED(num_vec) p = vec_of(pd, N_PARAMS, ctx[k]), z = vec_of(zd, N_STATE, ctx[k]);
      num_vec_init(&t[k], 1, ctx[k]);
      ck_assert_msg(dyn_event(num_vec_at(&t[k], 0), (enum phase)ph, &p, &z, t0) == SS_OK, "%s phase %d type %d t %g",
                    params_shown(pd), ph, k, t0);
      ck_assert_msg(distance(&t[k], &t[0]) <= bound[k] * (1 + t0), "%s phase %d type %d", params_shown(pd), ph, k);
      if (k == 0) { /* the ball holds the root: the switching function at it holds zero */
        OWNED(num_vec) at = vec_new(N_STATE, ctx[0]), f = vec_new(1, ctx[0]);
        int status = dyn_flow(&at, (enum phase)ph, &p, &z, num_vec_at(&t[0], 0));
        ck_assert_int_eq(status | dyn_switching(num_vec_at(&f, 0), (enum phase)ph, &p, &at), SS_OK);
        ck_assert(arb_contains_zero(num_vec_at(&f, 0)));
      }
    }
    for (int k = 0; k < 3; k++) num_vec_clear(&t[k]);
  }
}

TEST(an_event_of_balls_holds_the_events_of_its_points) {
  /* Phase C from r = 0, z_2' = s: q = s cos t - 1 with z_1' = 0, first zero at acos(1/s) beyond pi for s < -1. */
  const double pd[N_PARAMS] = {0.5, 2, 1, 1, 1};
  for (int k = 1; k < 40; k++) {
    double radius = k * 0.02, zd[N_STATE] = {0.25, 0.25, 0, -2}, t0;
    bool grazing;
    ck_assert_int_eq(first_event_d(&t0, &grazing, PHASE_C, pd, zd, NULL), SS_OK);
    OWNED(num_vec) p = vec_of(pd, N_PARAMS, num_ctx_arb(64)), z = vec_of(zd, N_STATE, num_ctx_arb(64));
    OWNED(num_vec) t = vec_new(1, num_ctx_arb(64));
    mag_set_d(arb_radref((arb_ptr)num_vec_at(&z, DZ_2)), radius);
    if (dyn_event(num_vec_at(&t, 0), PHASE_C, &p, &z, t0) == SS_OK)
      for (int side = -1; side <= 1; side++) {
        NUMBERS(arb, root);
        arb_set_d(root, acos(1 / (-2 + side * radius)));
        mag_set_d(arb_radref(root), 1e-14);
        ck_assert_msg(arb_overlaps(num_vec_at(&t, 0), root), "radius %g side %d", radius, side);
      }
    else
      ck_assert_msg(k > 4, "radius %g is small enough to be proved", radius);
  }
}

TEST(a_double_root_is_not_proved) {
  const double pd[N_PARAMS] = {0.5, 2, 1, 1, 1}, zd[N_STATE] = {0.25, 0.25, 0, -1};
  OWNED(num_vec) p = vec_of(pd, N_PARAMS, num_ctx_arb(128)), z = vec_of(zd, N_STATE, num_ctx_arb(128));
  OWNED(num_vec) t = vec_new(1, num_ctx_arb(128));
  ck_assert_int_eq(dyn_event(num_vec_at(&t, 0), PHASE_C, &p, &z, 3.1415), SS_UNABLE);
}

/* --- Derivatives. --- */

TEST_EACH(local_jacobians_match_differences, 30) {
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS], zd[N_STATE], t0, rate;
  bool grazing;
  struct num_ctx ctx = num_ctx_mpfr(192);
  random_params(pd, &r);
  for (int ph = 0; ph < N_PHASES; ph++) {
    random_state(zd, &r);
    if (first_event_d(&t0, &grazing, (enum phase)ph, pd, zd, NULL) || grazing) continue;
    flow_d(zd, (enum phase)ph, pd, zd, 0);
    double at[N_STATE];
    flow_d(at, (enum phase)ph, pd, zd, t0);
    switching_d((enum phase)ph, pd, at, &rate);
    if (fabs(rate) < 0.01) continue; /* differences need an event that stays where it is */
    OWNED(num_vec) p = vec_of(pd, N_PARAMS, ctx), z = vec_of(zd, N_STATE, ctx), t = vec_new(1, ctx);
    OWNED(num_vec) err = vec_new(1, ctx), j = vec_new(16, ctx);
    OWNED(num_vec) fd = vec_new(16, ctx);
    ck_assert_int_eq(dyn_event(num_vec_at(&t, 0), (enum phase)ph, &p, &z, t0), SS_OK);
    ck_assert_int_eq(dyn_local_jacobian(&j, (enum phase)ph, &p, &z, num_vec_at(&t, 0)), SS_OK);
    ck_assert_int_eq(dyn_local_jacobian_fd(&fd, num_vec_at(&err, 0), (enum phase)ph, &p, &z, t0), SS_OK);
    double gap = distance(&j, &fd), stated = vec_d(&err, 0);
    ck_assert_msg(gap <= 4 * stated && stated < 1e-20 * (1 + pow(largest(&j), 3)), "%s phase %d: off %g, stated %g",
                  params_shown(pd), ph, gap, stated);
  }
}

/* The velocity that ends a phase has no displacement there: an exact zero in every number type. */
TEST_EACH(a_pinned_velocity_is_not_displaced, 30) {
  static const struct num_type *const types[] = {&num_double, &num_mpfr, &num_arb};
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS], zd[N_STATE], t0;
  bool grazing;
  random_params(pd, &r);
  for (int ph = PHASE_H; ph < N_PHASES; ph++) {
    random_state(zd, &r);
    if (first_event_d(&t0, &grazing, (enum phase)ph, pd, zd, NULL) || grazing) continue;
    for (int k = 0; k < 3; k++) {
      struct num_ctx ctx = {types[k], 96};
      OWNED(num_vec) p = vec_of(pd, N_PARAMS, ctx), z = vec_of(zd, N_STATE, ctx), t = vec_of(&t0, 1, ctx);
      OWNED(num_vec) j = vec_new(16, ctx);
      ck_assert_int_eq(dyn_local_jacobian(&j, (enum phase)ph, &p, &z, num_vec_at(&t, 0)), SS_OK);
      int row = ph == PHASE_H ? DZ_1 : DZ_2;
      for (int col = 0; col < N_STATE; col++) {
        NUMBERS(arb, x);
        ctx.type->get_arb(x, num_vec_at(&j, N_STATE * row + col));
        ck_assert_msg(arb_is_zero(x), "%s phase %d: %s, column %d", params_shown(pd), ph, ctx.type->name, col);
      }
    }
  }
}

/* The arc of first events in double precision from a start of the word. */
static bool random_arc(struct dyn_arc *arc, double pd[N_PARAMS], struct rng *r) {
  double rise = rng_dyadic(r, 16, 256), r0, start[2];
  random_params(pd, r);
  r0 = pd[P_E2] / pd[P_CHI] - rise;
  start[1] = (pd[P_E1] + r0) / (1 - pd[P_CHI]);
  start[0] = start[1] - r0;
  OWNED(num_vec) p = vec_of(pd, N_PARAMS, num_ctx_double());
  int status = dyn_arc_run(arc, &p, start, start + 1, NULL);
  return status == SS_OK;
}

/* Balls at the same doubles know the Jacobian of the arc; in double precision each entry is that, rounded once. */
TEST_EACH(the_return_jacobian_of_doubles_is_rounded_once, 60) {
  struct rng r = {(uint64_t)_i};
  double pd[N_PARAMS];
  OWNED(dyn_arc) arc, balls;
  struct num_ctx ctx = num_ctx_arb(400);
  dyn_arc_init(&arc, num_ctx_double());
  ck_assert_msg(random_arc(&arc, pd, &r), "%s: no arc", params_shown(pd));
  dyn_arc_init(&balls, ctx);
  for (slong i = 0; i < arc.t.len; i++) arb_set_d(num_vec_at(&balls.t, i), vec_d(&arc.t, i));
  for (slong i = 0; i < arc.z.len; i++) arb_set_d(num_vec_at(&balls.z, i), vec_d(&arc.z, i));
  OWNED(num_vec) p = vec_of(pd, N_PARAMS, num_ctx_double()), pb = vec_of(pd, N_PARAMS, ctx), j = vec_new(4, p.ctx);
  OWNED(num_vec) jb = vec_new(4, ctx);
  ck_assert_int_eq(dyn_return_jacobian(&j, &p, &arc), SS_OK);
  ck_assert_int_eq(dyn_return_jacobian(&jb, &pb, &balls), SS_OK);
  for (slong i = 0; i < 4; i++) {
    NUMBERS(arb, off, most);
    arb_set_d(off, vec_d(&j, i));
    arb_sub(off, off, num_vec_at(&jb, i), 400);
    arb_abs(most, num_vec_at(&jb, i));
    arb_mul_2exp_si(most, most, -53);
    arb_abs(off, off);
    ck_assert_msg(arb_le(off, most), "%s: entry %ld", params_shown(pd), i);
  }
}

/* The Jacobian of one arc, again and again. */
struct jacobian_work {
  struct num_vec params, j;
  struct dyn_arc arc;
};

static void make_jacobians(void *self) {
  struct jacobian_work *w = self;
  for (int i = 0; i < 20; i++) ck_assert_int_eq(dyn_return_jacobian(&w->j, &w->params, &w->arc), SS_OK);
}

static void jacobian_work_init(struct jacobian_work *w, struct num_ctx ctx) {
  const double start[2] = {2.7032, 2.6158};
  OWNED(num_vec) z = vec_of(start, 2, ctx);
  w->params = vec_of(example, N_PARAMS, ctx);
  num_vec_init(&w->j, 4, ctx);
  dyn_arc_init(&w->arc, ctx);
  ck_assert_int_eq(dyn_arc_run(&w->arc, &w->params, num_vec_at(&z, 0), num_vec_at(&z, 1), NULL), SS_OK);
}

static void jacobian_work_clear(struct jacobian_work *w) {
  dyn_arc_clear(&w->arc);
  vecs_clear(&w->j, &w->params);
}

/* What is zero is not sought at ever more bits: a double costs about as much as 64 bits of MPFR. */
TEST(a_return_jacobian_of_doubles_takes_one_pass) {
  OWNED(jacobian_work) doubles, bits;
  jacobian_work_init(&doubles, num_ctx_double());
  jacobian_work_init(&bits, num_ctx_mpfr(64));
  ck_assert(costs_less(&(struct effort){make_jacobians, &doubles}, 4, &(struct effort){make_jacobians, &bits}));
}

/* Outputs and limits that nobody asked for. */
TEST(what_is_not_wanted_may_be_null) {
  static const double start[N_STATE] = {2.7032, 2.6158, 1, 1};
  static const double guess[2] = {2.0053, 1.4899}, along[1][N_STATE] = {{1, 0, 0, 0}};
  double out[16], column[N_STATE], err, t, r;
  OWNED(dyn_orbit) o;
  FREED_PARAMS fmpq *p = rationals(example_text, N_PARAMS);
  ck_assert_int_eq(dyn_orbit_near(&o, NULL, p, (struct dyn_place){guess[0], guess[1], false}, 64, NULL), SS_OK);
  ck_assert_int_eq(dyn_orbit_warm(out, NULL, NULL, example, guess), SS_OK);
  ck_assert_int_eq(dyn_return_map_d(&r, NULL, NULL, example, -3), SS_OK);
  ck_assert_int_eq(first_event_d(&t, NULL, PHASE_D, example, start, NULL), SS_OK);
  ck_assert_int_eq(dyn_return_jacobian_d(out, NULL, example, start, NULL), SS_OK);
  const struct dyn_stretch stretch = {PHASE_D, start, t};
  ck_assert_int_eq(dyn_local_differences_d(out, NULL, example, &stretch, along, 1), SS_OK);
  ck_assert_int_eq(dyn_local_differences_d(column, &err, example, &stretch, along, 1), SS_OK);
  for (int i = 0; i < N_STATE; i++) ck_assert_double_eq(out[i], column[i]);
}

/* --- Orbits. --- */

/* A list of orbits with the parameters it belongs to. */
struct found {
  fmpq *p;
  double pd[N_PARAMS];
  struct dyn_orbits list;
  int status;
};

static struct found found_of(fmpq *p, slong prec, const struct dyn_limits *lim) {
  struct found f = {.p = p};
  for (int i = 0; i < N_PARAMS; i++) f.pd[i] = fmpq_get_d(p + i);
  f.status = dyn_orbits_find(&f.list, p, prec, lim);
  return f;
}

static void found_clear(struct found *f) {
  dyn_orbits_clear(&f->list);
  _fmpq_vec_clear(f->p, N_PARAMS);
}

static struct num_vec params_arb(const struct found *f, slong prec) {
  struct num_vec p;
  num_vec_init(&p, N_PARAMS, num_ctx_arb(prec));
  for (slong i = 0; i < N_PARAMS; i++) arb_set_fmpq(num_vec_at(&p, i), f->p + i, prec);
  return p;
}

static void solves_them(const struct found *f, const struct dyn_orbit *o, slong prec) {
  OWNED(num_vec) p = params_arb(f, prec);
  check_six_equations(NULL, o, &p, params_shown(f->pd));
}

/* Trace and determinant of the product of local derivatives; differences of the whole map. */
static void check_multiplier(const struct found *f, const struct dyn_orbit *o, slong prec) {
  OWNED(num_vec) p = params_arb(f, prec);
  OWNED(dyn_arc) arc;
  NUMBERS(arb, x);
  OWNED(num_vec) j = vec_new(4, p.ctx);
  dyn_arc_init(&arc, p.ctx);
  ck_assert_int_eq(dyn_arc_run(&arc, &p, o->z10, o->z20, o->guess), SS_OK);
  ck_assert_int_eq(dyn_return_jacobian(&j, &p, &arc), SS_OK);
  arb_add(x, num_vec_at(&j, 0), num_vec_at(&j, 3), prec);
  ck_assert_msg(arb_overlaps(x, o->trace), "%s: trace", params_shown(f->pd));
  ck_assert(num_mat_det(x, &j, 2) == SS_OK && arb_contains_zero(x));
  for (slong i = 0; i < 4; i++) ck_assert(arb_overlaps(num_vec_at(&arc.t, i), o->t[i]));

  double r = num_arb.get_d(o->z20) - num_arb.get_d(o->z10), out, slope, t[4];
  double trace = num_arb.get_d(o->trace);
  if (fabs(trace) > 100) return;
  ck_assert_int_eq(dyn_return_map_d(&out, &slope, t, f->pd, r), SS_OK);
  ck_assert_msg(fabs(out - r) < 1e-9 * (1 + fabs(r)), "%s: not a fixed point", params_shown(f->pd));
  ck_assert_msg(fabs(slope - trace) < 1e-7 * (1 + trace * trace), "%s: slope %g trace %g", params_shown(f->pd), slope,
                trace);
  for (int i = 0; i < 4; i++) ck_assert(fabs(t[i] - o->guess[i]) < 1e-7 * (1 + fabs(t[i])));
}

/* w in phase C stands once for both routes: its samples say whether it exceeds e1, and with its value at the start of
   phase D, along which it only rises or only falls, what u_r1 must be. */
static void sample_phase_c(const struct found *f, const struct dyn_orbit *o) {
  enum { SAMPLES = 500 };
  const struct plain p = {f->pd[P_CHI], f->pd[P_ETA], f->pd[P_V], f->pd[P_E1], f->pd[P_E2]};
  real z[N_STATE] = {num_arb.get_d(o->z10), num_arb.get_d(o->z20), p.v, p.v}, at[N_STATE], worst = -HUGE_VALL;
  real low = fminl(0, plain_switching(&p, PHASE_D, z)), scale = p.v + p.e1 + p.e2;
  for (int ph = 0; ph < PHASE_C; ph++) plain_flow(z, &p, ph, z, o->guess[ph]);
  for (int i = 0; i <= SAMPLES; i++) {
    plain_flow(at, &p, PHASE_C, z, o->guess[PHASE_C] * i / SAMPLES);
    worst = fmaxl(worst, plain_switching(&p, PHASE_D, at));
    low = fminl(low, plain_switching(&p, PHASE_D, at));
  }
  bool fits = o->holds[COND_C_W] == TRUTH_TRUE ? worst < 1e-9L * scale : worst > -1e-3L * scale;
  ck_assert_msg(fits, "%s: w is %d, sampled %Lg", params_shown(f->pd), o->holds[COND_C_W], worst);
  double u = num_arb.get_d(o->u_r1_min);
  ck_assert_msg(fabs((double)(-low / 2) - u) < 1e-3 * (1 + fabs(u)), "%s: u_r1 %g sampled %Lg", params_shown(f->pd), u,
                -low / 2);
}

/* Conditions and force bounds by the other route, whose margins check_given.c holds against samples of the motion. */
static void check_conditions_by_margins(const struct found *f, const struct dyn_orbit *o) {
  LOCAL(dyn_margins, m);
  ck_assert_int_eq(dyn_margins_find(&m, f->p, o, NULL, NULL, 80), SS_OK);
  for (int i = 0; i < N_CONDITIONS; i++)
    ck_assert_msg(o->holds[i] != TRUTH_UNKNOWN && o->holds[i] == m.at[i].holds, "%s t_b %g: %s is %d",
                  params_shown(f->pd), o->guess[1], dyn_condition_id[i], o->holds[i]);
  ck_assert(arb_overlaps(m.u_r1_min, o->u_r1_min) && arb_rel_accuracy_bits(o->u_r1_min) > 20);
  ck_assert(arb_overlaps(m.u_r2_min, o->u_r2_min) && arb_rel_accuracy_bits(o->u_r2_min) > 20);
  sample_phase_c(f, o);
}

CASE("orbit", .seconds = 60);

/* The proof that a list is complete, which check_complete.c holds against scans of the return map, finds as many from
   nothing. */
static void check_count(const struct found *f) {
  OWNED(dyn_orbits) all = {.n = 0};
  ck_assert_int_eq(dyn_orbits_complete(&all, f->p, 60, DYN_CELLS), SS_OK);
  ck_assert_msg(all.complete && all.n == f->list.n, "%s: %ld of %ld found", params_shown(f->pd), (long)f->list.n,
                (long)all.n);
}

TEST_EACH(random_orbits_obey_everything, 12) {
  struct rng r = {(uint64_t)_i};
  double p[N_PARAMS];
  random_params(p, &r);
  OWNED(found) f = found_of(rationals_d(p, N_PARAMS), 80, NULL);
  ck_assert_msg(f.status == SS_OK, "%s: status %d", params_shown(p), f.status);
  for (slong i = 0; i < f.list.n; i++) {
    const struct dyn_orbit *o = &f.list.orbit[i];
    solves_them(&f, o, 200);
    check_multiplier(&f, o, 200);
    check_conditions_by_margins(&f, o);
    bool ordered = i == 0 || arf_cmp(arb_midref(o[-1].z10), arb_midref(o->z10)) < 0;
    ck_assert(ordered);
  }
  check_count(&f);
}

TEST(jumps_are_not_orbits) {
  /* The defect changes its sign at grazing events in several periods of these. */
  static const char *const jumpy[3][N_PARAMS] = {{"866/1000", "517/1000", "1", "1104/1000", "1524/1000"},
                                                 {"700/1000", "1656/10000", "1", "1148/10000", "9181/1000"},
                                                 {"435/1000", "3512/1000", "1", "857/1000", "3688/1000"}};
  for (int i = 0; i < 3; i++) {
    OWNED(found) f = found_of(rationals(jumpy[i], N_PARAMS), 60, NULL);
    ck_assert_msg(f.status == SS_OK, "%s: status %d", params_shown(f.pd), f.status);
    check_count(&f);
  }
}

TEST(an_orbit_is_followed_to_the_jump_where_it_ends) {
  /* Between these values of e2 an orbit ends because an earlier maximum of z_1' reaches V.  Down to the resolution of
     t_b the search must decide on which side it is, and leave nothing undecided. */
  static const char *const near_jump[N_PARAMS] = {"823453/1000000", "1499339/1000000", "1", "907841/1000000",
                                                  "33973/100000"};
  NUMBERS(fmpq, with, without);
  OWNED(found) f = found_of(rationals(near_jump, N_PARAMS), 60, NULL);
  ck_assert_int_eq(f.list.n, 4);
  fmpq_set(with, f.p + P_E2);
  fmpq_set_si(without, 33972, 100000);
  for (int i = 0; i < 30; i++) {
    fmpq_add(f.p + P_E2, with, without);
    fmpq_div_2exp(f.p + P_E2, f.p + P_E2, 1);
    dyn_orbits_clear(&f.list);
    ck_assert_int_eq(dyn_orbits_find(&f.list, f.p, 60, NULL), SS_OK);
    ck_assert_msg(f.list.n == 3 || f.list.n == 4, "step %d: %ld orbits", i, (long)f.list.n);
    fmpq_set(f.list.n == 4 ? with : without, f.p + P_E2);
  }
}

TEST_EACH(derivatives_of_the_return_map_are_differences, 40) {
  struct rng r = {(uint64_t)_i};
  double p[N_PARAMS], h = 1e-6;
  struct return_map_double k;
  struct pass s[3];
  random_params(p, &r);
  ck_assert_int_eq(return_map_double_init(&k, p), SS_OK);
  double tb = k.fall * (double)rng_between(&r, 10, 90) / 100;
  for (int i = 0; i < 3; i++) return_map_double_pass(&s[i], &k, tb + (i - 1) * h, NULL, &dyn_limits_default);
  ck_assert(!s[0].status && !s[2].status && s[1].safe >= 10 * h && fabs(s[1].wc) >= 0.1 && fabs(s[1].qc) >= 0.01);
  double slope = (s[2].defect - s[0].defect) / (2 * h), dqc = (s[2].qc - s[0].qc) / (2 * h);
  ck_assert_msg(fabs(slope - s[1].slope) < 1e-5 * (1 + fabs(slope)), "%s t_b %g: %g, %g", params_shown(p), tb, slope,
                s[1].slope);
  struct pass walked, followed;
  double far = tb + fmin(0.25 * s[1].safe, 0.01);
  return_map_double_pass(&walked, &k, far, NULL, &dyn_limits_default);
  return_map_double_pass(&followed, &k, far, &s[1], &dyn_limits_default);
  ck_assert_msg(followed.steps == 0 && fabs(followed.tc - walked.tc) < 1e-12 * (1 + walked.tc),
                "%s t_b %g: %.17g, %.17g", params_shown(p), far, followed.tc, walked.tc);
  ck_assert_msg(fabs(dqc - s[1].dqc) < 1e-4 * (1 + fabs(dqc)), "%s t_b %g: %g, %g", params_shown(p), tb, dqc, s[1].dqc);
}

TEST(scaling_changes_nothing_but_lengths) {
  /* (z, V, e1, e2) scale together; the times and the multiplier stay. */
  for (int k = -10; k <= 10; k += 20) {
    double p[N_PARAMS] = {0.75, 1.5, 1, 2.5, 1.25}, q[N_PARAMS];
    for (int i = 0; i < N_PARAMS; i++) q[i] = i < P_V ? p[i] : ldexp(p[i], k);
    OWNED(found) f = found_of(rationals_d(p, N_PARAMS), 100, NULL);
    OWNED(found) g = found_of(rationals_d(q, N_PARAMS), 100, NULL);
    ck_assert(f.list.n > 0);
    ck_assert_int_eq(f.list.n, g.list.n);
    for (slong i = 0; i < f.list.n; i++) {
      struct dyn_orbit *a = &f.list.orbit[i], *b = &g.list.orbit[i];
      arb_mul_2exp_si(a->z10, a->z10, k);
      ck_assert(arb_overlaps(a->z10, b->z10) && arb_overlaps(a->trace, b->trace) && arb_overlaps(a->t[2], b->t[2]));
      ck_assert(a->admissible == b->admissible && a->stable == b->stable);
    }
  }
}

TEST_EACH(extreme_parameters, 8) {
  static const char *const chi[2] = {"1/1000", "999/1000"}, *const eta[2] = {"1/10000", "10000"},
                           *const V[2] = {"1/1000", "1000"};
  const char *const text[N_PARAMS] = {chi[_i & 1], eta[_i >> 1 & 1], V[_i >> 2 & 1], "1", "1"};
  const struct dyn_limits lim = {60, 100000};
  OWNED(found) f = found_of(rationals(text, N_PARAMS), 400, &lim);
  ck_assert_msg(!(f.status & SS_DOMAIN), "%s: status %d", params_shown(f.pd), f.status); /* the budget may be used up */
  static const slong least[] = {0, 0, 1, 0, 2, 2, 1, 0};
  ck_assert_int_ge(f.list.n, least[_i]);
  for (slong i = 0; i < f.list.n; i++) {
    solves_them(&f, &f.list.orbit[i], 440);
    check_conditions_by_margins(&f, &f.list.orbit[i]);
  }
}

TEST(outside_the_domain) {
  static const char *const bad[3][N_PARAMS] = {
      {"1", "1", "1", "1", "1"}, {"1/2", "0", "1", "1", "1"}, {"1/2", "1", "1", "-1", "1"}};
  for (int i = 0; i < 3; i++) {
    OWNED(found) f = found_of(rationals(bad[i], N_PARAMS), 60, NULL);
    ck_assert(f.status == SS_DOMAIN && f.list.n == 0);
  }
  const double p[N_PARAMS] = {0.5, 1, 1, 1, 1};
  double out, t[4];
  ck_assert_int_eq(dyn_return_map_d(&out, NULL, t, p, 2), SS_DOMAIN); /* r = e2/chi: chi r only rises */
}

/* |high + low - x| as a part of |x|, rounded up to a double. */
static double off_by(double high, double low, arb_srcptr x) {
  NUMBERS(arb, d, sum);
  arb_set_d(sum, high);
  arb_set_d(d, low);
  arb_add(sum, sum, d, 400);
  arb_sub(d, sum, x, 400);
  arb_div(d, d, x, 400);
  return fabs(num_arb.get_d(d)) + mag_get_d(arb_radref(d));
}

/* x^2 - (1 + chi eta) x + chi eta (1 - chi) at x = om^2, K's characteristic polynomial. */
static val characteristic(struct calc *c, const val p[N_PARAMS], val om) {
  val x = calc_mul(c, om, om), stiff = calc_mul(c, p[P_CHI], p[P_ETA]), one = calc_d(c, 1);
  val rest = calc_mul(c, stiff, calc_sub(c, one, p[P_CHI]));
  return calc_add(c, calc_mul(c, x, calc_sub(c, x, calc_add(c, one, stiff))), rest);
}

CASE("dynamics");

/* The frequencies of phase H stand in three places (flow.h says why), and the shares of the modes with them. */
TEST_EACH(the_statements_of_the_frequencies_agree, 80) {
  struct rng r = {(uint64_t)_i + 1};
  double p[N_PARAMS];
  random_params(p, &r);
  if (_i % 4 == 1) p[P_CHI] = 0x1p-30;
  if (_i % 4 == 2) p[P_CHI] = 1 - 0x1p-30;
  if (_i % 4 == 3) p[P_ETA] = 1 / p[P_CHI]; /* chi eta near 1 */
  val at[N_PARAMS];
  struct return_map_double k;
  struct slip plain;
  struct fine_slip fine;
  OWNED(calc) c = calc_begin(num_ctx_arb(400));
  for (int i = 0; i < N_PARAMS; i++) at[i] = calc_d(&c, p[i]);
  struct spectrum s = flow_spectrum(&c, at);
  ck_assert_int_eq(return_map_double_init(&k, p), SS_OK);
  ck_assert(slip_init(&plain, p));
  fine_set(&fine, p);
  const val share[2] = {s.above, s.below};
  for (int i = 0; i < 2; i++) {
    ck_assert_msg(arb_contains_zero(characteristic(&c, at, s.om[i])), "%s om[%d]", params_shown(p), i);
    ck_assert(off_by(k.slip.om[i], 0, s.om[i]) < 0x1p-50);
    ck_assert(off_by(plain.om[i], 0, s.om[i]) < 0x1p-50);
    ck_assert_msg(off_by(plain.om[i], plain.rest[i], s.om[i]) < 0x1p-52, "%s om[%d]", params_shown(p), i);
    ck_assert(off_by(fine.om[i].high, fine.om[i].low, s.om[i]) < 0x1p-98);
    ck_assert(off_by(k.slip.own[i], 0, share[i]) < 0x1p-49);
    ck_assert(off_by(plain.own[i], 0, share[i]) < 0x1p-49);
    ck_assert(off_by(fine.own[i].high, fine.own[i].low, share[i]) < 0x1p-98);
  }
  ck_assert(calc_lt(&c, s.om[0], s.om[1]));
}
