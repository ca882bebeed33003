/* The pass through the word at many digits against three other ways: mpmath with matrix exponentials (tests/oracle),
   the phases one by one by dyn_event and dyn_flow at four times the precision, and exact points inside wide balls.
   What cannot be proved must not be claimed. */
#include "every.h"
#include "motion/arc.h"
#include "motion/dynamics.h"
#include "motion/turn.h"
#include "num/pi.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

enum { N_START = N_PARAMS + 2, VALUES = N_PHASES + (N_PHASES + 1) * N_STATE };

/* An arc with the parameters and positions it starts from. */
struct trip {
  struct num_vec params, start;
  struct dyn_arc arc;
};

static struct trip trip_of(const double x[N_START], struct num_ctx ctx) {
  struct trip p = {.params = vec_of(x, N_PARAMS, ctx), .start = vec_of(x + N_PARAMS, 2, ctx)};
  dyn_arc_init(&p.arc, ctx);
  return p;
}

static void trip_clear(struct trip *p) {
  vecs_clear(&p->params, &p->start);
  dyn_arc_clear(&p->arc);
}

static int trip_quick(struct trip *p, const struct num_vec *near, const double *guess) {
  return map_run(&p->arc, &p->params, num_vec_at(&p->start, 0), num_vec_at(&p->start, 1), near, guess);
}

/* The same phase by phase. */
static int pass_slow(struct trip *p, const double guess[N_PHASES]) {
  const struct num_type *type = p->arc.z.ctx.type;
  const void *V = num_vec_at(&p->params, P_V);
  int status = SS_OK;
  for (int i = 0; i < N_STATE; i++) type->set(num_vec_at(&p->arc.z, i), i < DZ_1 ? num_vec_at(&p->start, i) : V);
  for (int ph = 0; ph < N_PHASES && !status; ph++) {
    struct num_vec from = {p->arc.z.ctx, N_STATE, num_vec_at(&p->arc.z, ph * N_STATE)};
    struct num_vec to = {p->arc.z.ctx, N_STATE, num_vec_at(&p->arc.z, (ph + 1) * N_STATE)};
    status = dyn_event(num_vec_at(&p->arc.t, ph), (enum phase)ph, &p->params, &from, guess[ph]);
    if (!status) status = dyn_flow(&to, (enum phase)ph, &p->params, &from, num_vec_at(&p->arc.t, ph));
    if (ph == PHASE_H) type->set(num_vec_at(&to, DZ_1), V);
    if (ph == PHASE_C) type->set(num_vec_at(&to, DZ_2), V);
  }
  return status;
}

static const void *value_at(const struct trip *p, int i) {
  return i < N_PHASES ? num_vec_at(&p->arc.t, i) : num_vec_at(&p->arc.z, i - N_PHASES);
}

/* What the error of value i is measured by: a time itself, the larger of two positions or velocities. */
static double scale_at(const struct trip *p, int i) {
  const struct num_type *type = p->arc.z.ctx.type;
  double x = fabs(type->get_d(value_at(p, i)));
  return i < N_PHASES ? x : fmax(x, fabs(type->get_d(value_at(p, N_PHASES + ((i - N_PHASES) ^ 1)))));
}

static const char *show(const double x[N_START]) {
  static char text[300];
  snprintf(text, sizeof text, "%s z10 %.17g z20 %.17g", params_shown(x), x[N_PARAMS], x[N_PARAMS + 1]);
  return text;
}

/* The times of the first events in double precision; false where there is no such arc or one so near to a grazing one
   that digits are lost by the dozen. */
static bool first_times(double t[N_PHASES], const double x[N_START]) {
  double end, slope;
  if (dyn_return_map_d(&end, &slope, t, x, x[6] - x[5]) || !(fabs(slope) < 1e6)) return false;
  t[0] = (x[P_E1] - x[5] + x[P_CHI] * x[6]) / ((1 - x[P_CHI]) * x[P_V]);
  return fabs(t[0]) > 1e-3;
}

/* Every kind of parameter: 1 - chi and chi down to 2^-20, the others over factors of a thousand, t_b from tiny to
   long. */
static void random_start(double x[N_START], struct rng *r) {
  static const struct param_ranges wide = {{0, 1}, {0.03125, 32}, {0.03125, 32}, {0.125, 16}, {0.0625, 8}};
  double small = exp2(rng_within(r, -20, -1));
  params_draw(x, r, &wide);
  x[P_CHI] = rng_between(r, 0, 1) ? small : 1 - small;
  if (x[P_CHI] < 0.1) x[P_ETA] /= x[P_CHI];
  x[5] = rng_within(r, -4, 4) * x[P_V];
  x[6] = x[5] + x[P_E2] / x[P_CHI] - x[P_V] * exp2(rng_within(r, -24, 4));
}

/* log2 of how far v lies from the exact, at most, its radius included. */
static double error_of(const struct num_type *type, const void *v, arb_srcptr exact) {
  NUMBERS(arb, x);
  NUMBERS(mag, most);
  type->get_arb(x, v);
  arb_sub(x, x, exact, 20000);
  arb_get_mag(most, x);
  return mag_is_zero(most) ? -INFINITY : mag_get_d_log2_approx(most);
}

static const slong precisions[] = {53, 64, 100, 128, 192, 256, 333, 512, 700, 1024, 2048, 4096};

static void against_phases(const double x[N_START], const double t[N_PHASES], slong prec, int *quick) {
  struct trip p[2];
  OWNED(trip) exact = trip_of(x, num_ctx_arb(4 * prec + 300));
  p[0] = trip_of(x, num_ctx_arb(prec));
  p[1] = trip_of(x, num_ctx_mpfr(prec));
  bool known = pass_slow(&exact, t) == SS_OK;
  for (int k = 0; k < 2 && known; k++) {
    if (trip_quick(&p[k], NULL, t)) continue;
    ++*quick;
    for (int i = 0; i < VALUES; i++) {
      arb_srcptr true_value = value_at(&exact, i);
      ck_assert_msg(k == 1 || arb_overlaps(value_at(&p[k], i), true_value), "%s value %d is not enclosed", show(x), i);
      double e = error_of(p[k].arc.z.ctx.type, value_at(&p[k], i), true_value), most = log2(scale_at(&exact, i)) + 2;
      ck_assert_msg(e <= most - (double)prec, "%s %s value %d at %ld bits: error 2^%.1f of 2^%.1f", show(x),
                    k ? "mpfr" : "balls", i, (long)prec, e, most - 2);
    }
  }
  for (int k = 0; k < 2; k++) trip_clear(&p[k]);
}

TEST_EACH(arcs_are_those_of_the_phases, COUNT(precisions)) {
  struct rng r = {(uint64_t)_i + 7};
  double x[N_START], t[N_PHASES];
  const int enough = precisions[_i] > 1024 ? 40 / every(4) : 40;
  int tried = 0, quick = 0;
  while (tried < enough) {
    random_start(x, &r);
    if (!first_times(t, x)) continue;
    tried++;
    against_phases(x, t, precisions[_i], &quick);
  }
  ck_assert_msg(quick >= 2 * enough - enough / 10, "%d of %d at %ld bits", quick, 2 * enough, (long)precisions[_i]);
}

/* Each line: parameters, start, four times, two positions, of which digits are rounded at the 60th. */
TEST(arcs_of_mpmath) {
  OWNED(table) arcs = table_read("tests/oracle/arcs.tsv", N_START + N_PHASES + 2);
  ck_assert_int_eq(arcs.n, 8);
  for (int row = 0; row < arcs.n; row++) {
    double x[N_START];
    for (int i = 0; i < N_START; i++) x[i] = strtod(arcs.row[row][i], NULL);
    struct trip p[2];
    double t[N_PHASES], end;
    ck_assert_int_eq(dyn_return_map_d(&end, NULL, t, x, x[N_PARAMS + 1] - x[N_PARAMS]), SS_OK);
    p[0] = trip_of(x, num_ctx_arb(160));
    p[1] = trip_of(x, num_ctx_mpfr(160));
    for (int k = 0; k < 2; k++)
      ck_assert_msg(trip_quick(&p[k], NULL, t) == SS_OK, "%s %s", show(x), k ? "mpfr" : "balls");
    NUMBERS(arb, value);
    for (int i = 0; i < N_PHASES + 2; i++) {
      ball_of_decimal(value, arcs.row[row][N_START + i], 196); /* more than half a unit in the 60th place */
      int v = i < N_PHASES ? i : VALUES - 2 * N_PHASES + i;
      ck_assert_msg(arb_overlaps(value_at(&p[0], v), value), "%s value %d", show(x), v);
      for (int k = 0; k < 2; k++) {
        double e = error_of(p[k].arc.z.ctx.type, value_at(&p[k], v), value), size = log2(scale_at(&p[k], v));
        ck_assert_msg(e < size - 158, "%s %s value %d: error 2^%.1f of 2^%.1f", show(x), k ? "mpfr" : "balls", v, e,
                      size);
      }
    }
    for (int k = 0; k < 2; k++) trip_clear(&p[k]);
  }
}

/* Balls around a start, down to points: what is answered encloses the arcs of points inside, of corners too. */
TEST_EACH(wide_balls_hold_the_arcs_of_their_points, 4) {
  struct rng r = {(uint64_t)_i + 100};
  int proved = 0, refused = 0;
  for (int n = 0; n < 60; n++) {
    double x[N_START], t[N_PHASES], radius = exp2(rng_within(&r, -30, -2));
    random_start(x, &r);
    x[P_CHI] = 0.1 + 0.8 * x[P_CHI];
    x[6] = x[5] + x[P_E2] / x[P_CHI] - x[P_V] * exp2(rng_within(&r, -3, 3));
    if (!first_times(t, x)) continue;
    OWNED(trip) wide = trip_of(x, num_ctx_arb(128));
    for (int i = 0; i < N_START; i++) {
      arb_ptr v = i < N_PARAMS ? num_vec_at(&wide.params, i) : num_vec_at(&wide.start, i - N_PARAMS);
      mag_set_d(arb_radref(v), radius * fabs(x[i]));
    }
    bool ok = trip_quick(&wide, NULL, t) == SS_OK;
    proved += ok;
    refused += !ok;
    for (int k = 0; k < 6 && ok; k++) {
      double y[N_START];
      for (int i = 0; i < N_START; i++) {
        double side = k < 3 ? (double)rng_between(&r, -1, 1) : rng_within(&r, -1, 1);
        y[i] = x[i] * (1 + 0.999 * side * radius);
      }
      OWNED(trip) point = trip_of(y, num_ctx_arb(256));
      double near[N_PHASES];
      for (int i = 0; i < N_PHASES; i++) near[i] = num_arb.get_d(value_at(&wide, i));
      int status = pass_slow(&point, near);
      ck_assert_msg(status == SS_OK || radius > 1e-3, "%s radius %g: no arc inside", show(y), radius);
      for (int i = 0; i < VALUES && status == SS_OK; i++)
        ck_assert_msg(arb_contains(value_at(&wide, i), value_at(&point, i)), "%s radius %g value %d", show(y), radius,
                      i);
    }
  }
  ck_assert_msg(proved > 20 && refused > 2, "%d proved, %d refused", proved, refused);
}

/* In phase Gamma chi r rises by a (t - sin t) + e1 (1 - cos t), with a crest at pi + 2 atan(a/e1) and the next rise
   above it far later.  A start whose rise is the crest's has a double root, a little less two near it, a little more
   none. */
TEST(a_double_root_and_none_are_not_proved) {
  double x[N_START] = {0.5, 1, 0.5, 4, 1, 0, 0}, a = 0.25, crest = PI + 2 * atan2(a, 4);
  double rise = a * (crest - sin(crest)) + 4 * (1 - cos(crest)), guess[N_PHASES] = {0, crest, 1, 1};
  static const double off[] = {0, 1e-12, -1e-12, 0x1p-40, 0.5};
  for (int k = 0; k < 5; k++)
    for (int side = -1; side <= 1; side++) {
      x[6] = x[5] + 2 - (rise + off[k]);
      guess[PHASE_GAMMA] = crest + 1e-7 * side;
      OWNED(trip) p = trip_of(x, num_ctx_arb(128));
      if (k < 4) mag_set_d(arb_radref((arb_ptr)num_vec_at(&p.start, 1)), 1e-6);
      ck_assert_msg(trip_quick(&p, NULL, guess) == SS_UNABLE, "off %g side %d", off[k], side);
      ck_assert_int_eq(dyn_arc_run(&p.arc, &p.params, num_vec_at(&p.start, 0), num_vec_at(&p.start, 1), guess),
                       SS_UNABLE);
    }
}

/* Below the crest by e, with a ball of 2 e: its middle has a root, and some of its points have none. */
TEST(a_ball_that_reaches_beyond_the_crest_is_not_proved) {
  double x[N_START] = {0.5, 1, 0.5, 4, 1, 0, 0}, a = 0.25, crest = PI + 2 * atan2(a, 4), t[N_PHASES];
  double rise = a * (crest - sin(crest)) + 4 * (1 - cos(crest));
  for (int k = 2; k < 30; k += 3)
    for (int wide = 0; wide < 2; wide++) {
      double below = ldexp(1, -k);
      x[6] = x[5] + 2 - (rise - below);
      ck_assert(first_times(t, x));
      OWNED(trip) p = trip_of(x, num_ctx_arb(192));
      mag_set_d(arb_radref((arb_ptr)num_vec_at(&p.start, 1)), wide ? 2 * below : below / 1024);
      ck_assert_msg((trip_quick(&p, NULL, t) == SS_OK) == !wide, "2^-%d", k);
    }
}

/* Only r is wide, so that hardly anything but the motion's own bend makes an enclosure wider than the range: its ends
   are arcs of the ends of r.  At the first start w is 0 at the middle's t_b, where w' has an extremum. */
TEST(a_wide_r_is_enclosed_to_its_ends) {
  struct rng r = {77};
  double t[N_PHASES], at = PI - atan2(2, 0.25), rise = 0.25 * (at - sin(at)) + 2 * (1 - cos(at));
  double x[N_START] = {0.75, 1, 1, 2, 1.5, 0, 2 - rise};
  for (int n = 0; n < 60; n++) {
    double radius = n == 0 ? 1e-2 : exp2(rng_within(&r, -14, -5));
    if (n > 0) {
      random_start(x, &r);
      x[P_CHI] = 0.1 + 0.8 * x[P_CHI];
      x[6] = x[5] + x[P_E2] / x[P_CHI] - x[P_V] * exp2(rng_within(&r, -2, 2));
    }
    struct trip end;
    OWNED(trip) wide = trip_of(x, num_ctx_arb(128));
    mag_set_d(arb_radref((arb_ptr)num_vec_at(&wide.start, 1)), radius);
    bool ok = first_times(t, x) && trip_quick(&wide, NULL, t) == SS_OK;
    ck_assert(ok || n > 0);
    for (int k = -4; k <= 4 && ok; k++) {
      double y[N_START];
      memcpy(y, x, sizeof y);
      y[6] += 0.25 * k * radius;
      end = trip_of(y, num_ctx_arb(256));
      ck_assert_int_eq(pass_slow(&end, t), SS_OK);
      for (int i = 0; i < VALUES; i++)
        ck_assert_msg(arb_overlaps(value_at(&wide, i), value_at(&end, i)), "%s radius %g value %d", show(y), radius, i);
      trip_clear(&end);
    }
  }
}

/* Events near the guess, first or not: in phase C each half turn has one, with r of the other sign. */
TEST(events_are_those_near_the_guess) {
  const double x[N_START] = {0.75, 1.25, 1.0, 2.5, 1.5, 0.25, -1.0};
  double t[N_PHASES];
  ck_assert(first_times(t, x));
  for (int turns = 0; turns < 4; turns++)
    for (int k = 0; k < 2; k++) {
      double guess[N_PHASES] = {t[0], t[1] * 1.002, t[2] * 0.999, t[3] + turns * PI / sqrt(0.9375) + 0.01};
      OWNED(trip) quick = trip_of(x, k ? num_ctx_mpfr(300) : num_ctx_arb(300));
      OWNED(trip) slow = trip_of(x, num_ctx_arb(400));
      ck_assert_int_eq(trip_quick(&quick, NULL, guess), SS_OK);
      ck_assert_int_eq(pass_slow(&slow, guess), SS_OK);
      for (int i = 0; i < VALUES; i++)
        ck_assert(error_of(quick.arc.z.ctx.type, value_at(&quick, i), value_at(&slow, i)) < -290);
    }
}

/* Guesses that are none: an answer, whatever it is, and no hang. */
TEST(wild_guesses_end) {
  const double x[N_START] = {0.75, 1.25, 1.0, 2.5, 1.5, 0.25, -1.0};
  static const double wild[] = {0, -0.0, 1e-300, -1, 1e15, 1e300, INFINITY, NAN};
  double t[N_PHASES];
  ck_assert(first_times(t, x));
  for (size_t k = 0; k < COUNT(wild); k++)
    for (int at = 1; at < 2 * N_PHASES; at++) {
      double guess[N_PHASES];
      memcpy(guess, t, sizeof t);
      guess[at % N_PHASES] = wild[k];
      OWNED(trip) p = trip_of(x, at < N_PHASES ? num_ctx_mpfr(200) : num_ctx_arb(200));
      int status = trip_quick(&p, NULL, guess);
      ck_assert(status == SS_OK || status == SS_UNABLE);
    }
}

/* From times of a third of the bits, as differences take them. */
TEST(near_times_of_a_few_bits) {
  const double x[N_START] = {0.8, 1.0, 1.0, 2.7844, 0.8587, 0.8921, -2.1958};
  double t[N_PHASES];
  ck_assert(first_times(t, x));
  OWNED(trip) p = trip_of(x, num_ctx_mpfr(600));
  OWNED(trip) exact = trip_of(x, num_ctx_arb(900));
  ck_assert_int_eq(pass_slow(&exact, t), SS_OK);
  OWNED(num_vec) near = vec_new(N_PHASES, num_ctx_mpfr(600));
  for (slong bits = 8; bits <= 600; bits += 74) {
    for (int i = 0; i < N_PHASES; i++) {
      mpfr_ptr v = num_vec_at(&near, i);
      num_mpfr.set_arb(v, value_at(&exact, i), 600);
      mpfr_prec_round(v, bits, MPFR_RNDN);
      mpfr_prec_round(v, 600, MPFR_RNDN);
    }
    ck_assert_int_eq(trip_quick(&p, &near, NULL), SS_OK);
    for (int i = 0; i < VALUES; i++)
      ck_assert_msg(error_of(&num_mpfr, value_at(&p, i), value_at(&exact, i)) < -594, "%ld bits", (long)bits);
  }
}

/* sin x and 1 - cos x by the series, and a kept angle turned, against Arb's own at four times the bits. */
TEST(turns_enclose_sines) {
  struct rng r = {9};
  for (int n = 0; n < 400; n++) {
    slong prec = precisions[n % COUNT(precisions)];
    OWNED(calc) c = calc_begin(num_ctx_arb(prec));
    double angle = rng_within(&r, -50, 50), move = exp2(rng_within(&r, -80, 1)) * (rng_between(&r, 0, 1) ? 1 : -1);
    if (n % 40 == 0) move = 0;
    arb_ptr x = calc_new(&c);
    arb_set_d(x, move);
    if (n % 3 == 0) mag_set_d(arb_radref(x), fabs(move) / 8);
    struct turn kept;
    val s, v, sine, cosine;
    calc_sin_cos(&c, &kept.sine, &kept.cosine, calc_d(&c, angle));
    turn_small(&s, &v, &c, x);
    turn_by(&sine, &cosine, &c, &kept, x);
    NUMBERS(arb, y);
    BALLS(4, exact);
    arb_set_d(y, move);
    arb_sin_cos(exact, exact + 1, y, 4 * prec);
    arb_sub_ui(exact + 1, exact + 1, 1, 4 * prec);
    arb_neg(exact + 1, exact + 1);
    arb_set_d(y, angle);
    NUMBERS(arf, m);
    arf_set_d(m, move);
    arb_add_arf(y, y, m, ARF_PREC_EXACT);
    arb_sin_cos(exact + 2, exact + 3, y, 4 * prec);
    const val got[4] = {s, v, sine, cosine};
    for (int k = 0; k < 4; k++) {
      ck_assert_msg(arb_overlaps(got[k], exact + k), "%ld bits, %.17g + %.17g, %d", (long)prec, angle, move, k);
      ck_assert_msg(n % 3 == 0 || mag_cmp_2exp_si(arb_radref((arb_srcptr)got[k]), 10 - prec) < 0,
                    "%ld bits, %.17g + %.17g, %d", (long)prec, angle, move, k);
    }
  }
}
