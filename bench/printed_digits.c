/* The two equations (45) in duals, so that a bound over the box of roundings follows from the values at the middles of
   cells and the slopes over them. */
#include "bench/printed_digits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "motion/dual.h"
#include "motion/flow.h"

/* (x y; z w)^-1 (a; b). */
static void solve_two(val out[2], struct calc *c, const val m[4], val a, val b) {
  val det = calc_sub(c, calc_mul(c, m[0], m[3]), calc_mul(c, m[1], m[2]));
  out[0] = calc_div(c, calc_sub(c, calc_mul(c, m[3], a), calc_mul(c, m[1], b)), det);
  out[1] = calc_div(c, calc_sub(c, calc_mul(c, m[0], b), calc_mul(c, m[2], a)), det);
}

int printed_matrix(struct num_vec *a, const struct num_vec *params, const struct num_vec *t) {
  OWNED(num_vec) step;
  num_vec_init(&step, N_STATE * N_STATE, params->ctx);
  int status = dyn_flow_matrix(a, PHASE_GAMMA, params, num_vec_at(t, 0));
  for (int k = 1; k < 3; k++) {
    status |= dyn_flow_matrix(&step, (enum phase)(PHASE_GAMMA + k), params, num_vec_at(t, k));
    status |= num_mat_mul(a, &step, a, N_STATE, N_STATE, N_STATE);
  }
  return status;
}

void printed_wanted(arb_ptr out, const struct dyn_orbit *o) {
  arb_set(out, o->t[PHASE_D]);
  arb_set(out + 1, o->z10);
  arb_set(out + 2, o->z20);
}

void printed_by_row(arb_ptr out, arb_ptr slope, int row, const struct num_vec *params, const struct num_vec *t) {
  enum { SIZE = N_STATE * N_STATE };
  struct num_ctx ctx = params->ctx;
  OWNED(num_vec) a;
  num_vec_init(&a, SIZE, ctx);
  OWNED(calc) c = calc_begin(ctx);
  int status = printed_matrix(&a, params, t);
  val m[SIZE], one = calc_d(&c, 1), V = num_vec_at(params, P_V), x[2], y[2], s[2];
  flow_vals(m, &a, 0, SIZE);
  const val lead[4] = {calc_sub(&c, m[0], one), m[1], m[4], calc_sub(&c, m[5], one)},
            low[4] = {m[8], m[9], m[12], m[13]};
  solve_two(s, &c, lead, one, one);                                           /* (A1 - I)^-1 u */
  solve_two(x, &c, lead, calc_add(&c, m[2], m[3]), calc_add(&c, m[6], m[7])); /* (A1 - I)^-1 A2 u */
  solve_two(y, &c, low, calc_add(&c, calc_sub(&c, m[10], one), m[11]),
            calc_add(&c, m[14], calc_sub(&c, m[15], one))); /* A3^-1 (A4 - I) u */
  val got[N_WANTED] = {calc_div(&c, calc_sub(&c, y[row], x[row]), s[row])};
  for (int i = 0; i < 2; i++) {
    val part = calc_mul(&c, got[0], calc_add(&c, one, s[i]));
    got[1 + i] = calc_neg(&c, calc_mul(&c, V, calc_add(&c, x[i], part)));
  }
  for (int i = 0; i < N_WANTED; i++) {
    arb_set(out + i, dual_value(got[i]));
    for (int k = 0; k < 3 && slope; k++) arb_set(slope + 3 * i + k, dual_slope(got[i], k));
  }
  if (status | c.status) _arb_vec_indeterminate(out, N_WANTED);
}

/* From t_b and t_c alone: the orbit whose t_d is nearest. */
static void by_pair(arb_ptr out, const fmpq *model, const fmpq *t, double td) {
  static const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  OWNED(dyn_orbits) list;
  double least = INFINITY;
  _arb_vec_indeterminate(out, N_WANTED);
  dyn_orbits_given(&list, model, which, t, 128, NULL);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    double off = fabs(num_arb.get_d(o->t[PHASE_C]) - td);
    if (off >= least) continue;
    least = off;
    printed_wanted(out, o);
  }
}

/* Correct digits of every point of the ball: at least 0, at most 20. */
static double digits_of(arb_srcptr got, arb_srcptr truth_of) {
  NUMBERS(arb, off);
  NUMBERS(mag, most);
  double digits = 0;
  if (arb_is_finite(got)) {
    arb_sub(off, got, truth_of, PRINTED_BITS);
    arb_div(off, off, truth_of, 64);
    arb_get_mag(most, off);
    digits = fmin(20, fmax(0, -log10(mag_get_d(most))));
  }
  return digits;
}

void printed_times_set(struct printed_times *p, const double t[3], int digits) {
  for (int k = 0; k < 3; k++) {
    char s[64];
    int exponent;
    snprintf(s, sizeof s, "%.*e", digits - 1, t[k]);
    exponent = atoi(strchr(s, 'e') + 1) - (digits - 1);
    fmpq_init(&p->t[k]);
    fmpq_init(&p->half[k]);
    num_parse_decimal(&p->t[k], s, strlen(s));
    fmpq_set_si(&p->half[k], 1, 2);
    fmpz *side = exponent < 0 ? fmpq_denref(&p->half[k]) : fmpq_numref(&p->half[k]);
    NUMBERS(fmpz, power);
    fmpz_ui_pow_ui(power, 10, (ulong)abs(exponent));
    fmpz_mul(side, side, power);
    fmpq_canonicalise(&p->half[k]);
  }
}

void printed_times_clear(struct printed_times *p) {
  for (int k = 0; k < 3; k++) {
    fmpq_clear(&p->t[k]);
    fmpq_clear(&p->half[k]);
  }
}

/* t + half * (at/n - 1), exactly on the grid; wide: with everything up to half/n on both sides. */
static void place(struct num_vec *t, const struct printed_times *p, const int at[3], int n, bool wide) {
  NUMBERS(fmpq, x);
  NUMBERS(arf, radius);
  for (int k = 0; k < 3; k++) {
    struct dual *z = num_vec_at(t, k);
    fmpq_set_si(x, at[k] - n, (ulong)n);
    fmpq_mul(x, x, &p->half[k]);
    fmpq_add(x, x, &p->t[k]);
    arb_set_fmpq(&z->v, x, t->ctx.prec);
    arb_one(&z->d[k]);
    arf_set_fmpq(radius, &p->half[k], 64, ARF_RND_UP);
    arf_div_ui(radius, radius, (ulong)n, 64, ARF_RND_UP);
    if (wide) arb_add_error_arf(&z->v, radius);
  }
}

/* The values over the cell around a point: those at the point and slopes over the cell times what it extends. */
static void over_cell(arb_ptr out, int row, const struct num_vec *params, const struct printed_times *p,
                      const int at[3], int n) {
  OWNED(num_vec) t;
  ARB_VECTOR(slope, N_WANTED * 3);
  ARB_VECTOR(middle, 3);
  ARB_VECTOR(wide, N_WANTED);
  slong prec = params->ctx.prec;
  num_vec_init(&t, 3, params->ctx);
  place(&t, p, at, n, false);
  for (int k = 0; k < 3; k++) arb_set(middle + k, dual_value(num_vec_at(&t, k)));
  printed_by_row(out, NULL, row, params, &t);
  place(&t, p, at, n, true);
  printed_by_row(wide, slope, row, params, &t);
  for (int k = 0; k < 3; k++) {
    arb_sub(middle + k, dual_value(num_vec_at(&t, k)), middle + k, prec);
    for (int i = 0; i < N_WANTED; i++) arb_addmul(out + i, slope + 3 * i + k, middle + k, prec);
  }
}

static void least_digits(double least[N_WANTED], arb_srcptr got, arb_srcptr truth_of) {
  for (int i = 0; i < N_WANTED; i++) least[i] = fmin(least[i], digits_of(got + i, truth_of + i));
}

void printed_row_digits(struct printed_digits *d, int row, const struct num_vec *params, const struct printed_times *p,
                        arb_srcptr truth_of, int n) {
  OWNED(num_vec) t;
  ARB_VECTOR(got, N_WANTED);
  num_vec_init(&t, 3, params->ctx);
  for (int i = 0; i < N_WANTED; i++) d->printed[i] = d->worst[i] = d->sure[i] = INFINITY;
  place(&t, p, (int[]){1, 1, 1}, 1, false);
  printed_by_row(got, NULL, row, params, &t);
  least_digits(d->printed, got, truth_of);
  for (int k = 0; k < 27; k++) {
    place(&t, p, (int[]){k % 3, k / 3 % 3, k / 9}, 1, false);
    printed_by_row(got, NULL, row, params, &t);
    least_digits(d->worst, got, truth_of);
  }
  for (int k = 0; k < n * n * n; k++) {
    over_cell(got, row, params, p, (int[]){2 * (k % n) + 1, 2 * (k / n % n) + 1, 2 * (k / n / n) + 1}, n);
    least_digits(d->sure, got, truth_of);
  }
}

void printed_pair_digits(struct printed_digits *d, const fmpq *model, const struct printed_times *p, double td,
                         arb_srcptr truth_of) {
  ARB_VECTOR(got, N_WANTED);
  FMPQ_VECTOR(t, 2);
  for (int i = 0; i < N_WANTED; i++) {
    d->printed[i] = d->worst[i] = INFINITY;
    d->sure[i] = NAN;
  }
  by_pair(got, model, p->t, td);
  least_digits(d->printed, got, truth_of);
  for (int k = 0; k < 9; k++) {
    for (int i = 0; i < 2; i++) {
      int side = i ? k / 3 : k % 3;
      fmpq_set(t + i, &p->t[i]);
      if (side == 0) fmpq_sub(t + i, t + i, &p->half[i]);
      if (side == 2) fmpq_add(t + i, t + i, &p->half[i]);
    }
    by_pair(got, model, t, td);
    least_digits(d->worst, got, truth_of);
  }
}
