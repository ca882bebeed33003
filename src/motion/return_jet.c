/* The return map of r as a truncated Taylor series: the formulas of map_balls.c over series in balls.

   At the end of the stick phase w = e1 and both velocities are V, so the start of phase Gamma is r_0 + s alone.  Both
   event times are series in s, found by Newton's iteration on series from their enclosed constant terms; a defect's own
   constant term is exactly zero at the event and is set to that. */
#include "map_balls.h"
#include "num/flint_more.h"

/* --- Series as a number type: JET_MOST balls each, of which the last terms of a product are left out. --- */

static int held(arb_srcptr z) {
  return _arb_vec_is_finite(z, JET_MOST) ? SS_OK : SS_UNABLE;
}

static void j_init(void *x, slong prec) {
  (void)prec;
  for (int k = 0; k < JET_MOST; k++) arb_init((arb_ptr)x + k);
}

static void j_clear(void *x) {
  for (int k = 0; k < JET_MOST; k++) arb_clear((arb_ptr)x + k);
}

static void j_set(void *z, const void *x) {
  _arb_vec_set(z, x, JET_MOST);
}

static int j_set_d(void *z, double x, slong prec) {
  (void)prec;
  _arb_vec_zero(z, JET_MOST);
  arb_set_d(z, x);
  return held(z);
}

static int j_neg(void *z, const void *x, slong prec) {
  (void)prec;
  _arb_vec_neg(z, x, JET_MOST);
  return held(z);
}

static int j_add(void *z, const void *x, const void *y, slong prec) {
  _arb_vec_add(z, x, y, JET_MOST, prec);
  return held(z);
}

static int j_sub(void *z, const void *x, const void *y, slong prec) {
  _arb_vec_sub(z, x, y, JET_MOST, prec);
  return held(z);
}

static int j_mul(void *z, const void *x, const void *y, slong prec) {
  _arb_poly_mullow(z, x, JET_MOST, y, JET_MOST, JET_MOST, prec);
  return held(z);
}

static int j_div(void *z, const void *x, const void *y, slong prec) {
  _arb_poly_div_series(z, x, JET_MOST, y, JET_MOST, JET_MOST, prec);
  return held(z);
}

static int j_sqrt(void *z, const void *x, slong prec) {
  _arb_poly_sqrt_series(z, x, JET_MOST, JET_MOST, prec);
  return held(z);
}

static int j_sin_cos(void *s, void *c, const void *x, slong prec) {
  _arb_poly_sin_cos_series(s, c, x, JET_MOST, JET_MOST, prec);
  return held(s) | held(c);
}

static truth j_lt(const void *x, const void *y) {
  return num_arb.lt(x, y);
}

/* What those formulas ask for. */
static const struct num_type num_jet = {.name = "jet",
                                        .size = JET_MOST * sizeof(arb_struct),
                                        .rigorous = true,
                                        .init = j_init,
                                        .clear = j_clear,
                                        .set = j_set,
                                        .set_d = j_set_d,
                                        .neg = j_neg,
                                        .sqrt = j_sqrt,
                                        .add = j_add,
                                        .sub = j_sub,
                                        .mul = j_mul,
                                        .div = j_div,
                                        .sin_cos = j_sin_cos,
                                        .lt = j_lt};

/* x + slope s */
static val jet_of(struct calc *c, arb_srcptr x, slong slope) {
  arb_ptr z = calc_new(c);
  _arb_vec_zero(z, JET_MOST);
  arb_set(z, x);
  arb_set_si(z + 1, slope);
  return z;
}

/* x without its constant term, over y. */
static val step_of(struct calc *c, val x, val y) {
  arb_ptr z = calc_new(c);
  j_set(z, x);
  arb_zero(z);
  return calc_div(c, z, y);
}

int dyn_return_jet(arb_ptr out, slong n, const struct num_vec *params, const struct dyn_arc *arc) {
  struct ball_params m;
  struct ball_pass s;
  val p[N_PARAMS];
  NUMBERS(arb, zero, end);
  OWNED(calc) c = calc_begin((struct num_ctx){&num_jet, params->ctx.prec});
  for (int i = 0; i < N_PARAMS; i++) p[i] = jet_of(&c, num_vec_at(params, i), 0);
  ball_params_make(&m, &c, p);
  val tb = jet_of(&c, num_vec_at(&arc->t, PHASE_GAMMA), 0), tc = jet_of(&c, num_vec_at(&arc->t, PHASE_H), 0);
  val moved = jet_of(&c, zero, 1);
  ball_pass_slip(&s, &c, &m, tb, tc);
  for (slong known = 1; known < n; known *= 2) {
    val later = step_of(&c, calc_add(&c, s.rise, moved), s.pb); /* the rise, of the rate -pb, is r_b - r_0 - s */
    tb = calc_add(&c, tb, later);
    tc = calc_add(&c, tc, step_of(&c, calc_add(&c, s.pc, calc_mul(&c, s.pc_tb, later)), s.wc)); /* pc' = -wc */
    ball_pass_slip(&s, &c, &m, tb, tc);
  }
  arb_sub(end, num_vec_at(&arc->z, N_PHASES * N_STATE + Z_2), num_vec_at(&arc->z, N_PHASES * N_STATE + Z_1),
          params->ctx.prec);
  ball_pass_turn(&s, &c, &m, arb_is_positive(end));
  _arb_vec_set(out, s.r_end, n);
  return arb_contains_zero(end) ? SS_UNABLE : c.status;
}
