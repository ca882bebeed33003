/* The return map of r as a truncated Taylor series, by arithmetic of series in balls.

   At the end of the stick phase w = e1 and both velocities are V, so the start of phase Gamma is r_0 + s alone.  Each
   event time is a series in s, found by Newton's iteration on series from its enclosed constant term; the defect's own
   constant term is exactly zero at the event and is set to that.  In (w, r) phase Gamma is w'' = -w with
   r' = (1 - chi) V - w', phase H is y'' = -M y with M = [1, -chi^2 eta; -1, chi eta], and phase C ends at the extremum
   of r'' = -chi eta r. */
#include "map_balls.h"
#include "num/flint_more.h"

struct jet {
  slong n, prec;
  struct calc c;
  struct ball_params m;
  arb_poly_t s, tmp; /* the variable; scratch */
};

static void polys_init(arb_poly_struct *p, int n) {
  for (int i = 0; i < n; i++) arb_poly_init(p + i);
}

static void polys_clear(arb_poly_struct *p, int n) {
  for (int i = 0; i < n; i++) arb_poly_clear(p + i);
}

/* out += k p */
static void add_scaled(arb_poly_t out, struct jet *j, val k, const arb_poly_t p) {
  arb_poly_scalar_mul(j->tmp, p, k, j->prec);
  arb_poly_add_series(out, out, j->tmp, j->n, j->prec);
}

/* One step of Newton's iteration for t: value / rate, the constant term of value being zero by definition. */
static void newton_step(arb_poly_t t, struct jet *j, arb_poly_t value, const arb_poly_t rate) {
  arb_poly_set_coeff_si(value, 0, 0);
  arb_poly_div_series(j->tmp, value, rate, j->n, j->prec);
  arb_poly_sub_series(t, t, j->tmp, j->n, j->prec);
}

/* w and w' at the end of phase Gamma. */
static void through_gamma(arb_poly_t w, arb_poly_t dw, struct jet *j, const arb_t tb) {
  arb_poly_struct p[5], *t = p, *sine = p + 1, *cosine = p + 2, *value = p + 3, *rate = p + 4;
  val a = j->m.a, e1 = j->m.p[P_E1];
  polys_init(p, 5);
  arb_poly_set_arb(t, tb);
  for (slong known = 1;; known *= 2) {
    arb_poly_sin_cos_series(sine, cosine, t, j->n, j->prec);
    arb_poly_zero(w);
    arb_poly_zero(dw);
    add_scaled(w, j, e1, cosine);
    add_scaled(w, j, a, sine);
    add_scaled(dw, j, a, cosine);
    add_scaled(dw, j, calc_neg(&j->c, e1), sine);
    if (known >= j->n) break;
    /* r - e2/chi = r_0 + s + a t - (w - e1) - e2/chi, of which only the terms in s count; its rate is a - w' */
    arb_poly_scalar_mul(value, t, a, j->prec);
    arb_poly_sub_series(value, value, w, j->n, j->prec);
    arb_poly_add_series(value, value, j->s, j->n, j->prec);
    arb_poly_set_arb(rate, a);
    arb_poly_sub_series(rate, rate, dw, j->n, j->prec);
    newton_step(t, j, value, rate);
  }
  polys_clear(p, 5);
}

/* --- Phase H. --- */

struct slide {
  const struct spectrum *k;    /* M has the eigenvalues of K */
  val corner[2];               /* f(M) off its diagonal, row by row, over f_1 - f_2 */
  arb_poly_struct y[2], dy[2]; /* w, r and their derivatives at the start */
  arb_poly_struct f[3][2];     /* cos, sin/om, -om sin at the time, for both frequencies */
};

static void slide_at(struct slide *s, struct jet *j, const arb_poly_t t) {
  for (int i = 0; i < 2; i++) {
    arb_poly_scalar_mul(j->tmp, t, s->k->om[i], j->prec);
    arb_poly_sin_cos_series(&s->f[1][i], &s->f[0][i], j->tmp, j->n, j->prec);
    arb_poly_scalar_mul(&s->f[2][i], &s->f[1][i], s->k->om[i], j->prec);
    arb_poly_neg(&s->f[2][i], &s->f[2][i]);
    arb_poly_scalar_div(&s->f[1][i], &s->f[1][i], s->k->om[i], j->prec);
  }
}

/* out += row `row` of f(M) y, f the function with the values f[k] at the two eigenvalues.  As f(K) in flow.h,
   f(M) = [above f_1 + below f_2, chi^2 eta (f_1 - f_2); f_1 - f_2, below f_1 + above f_2]/gap. */
static void add_function(arb_poly_t out, struct jet *j, const struct slide *s, int k, const arb_poly_struct y[2],
                         int row) {
  NUMBERS(arb_poly, part);
  for (int i = 0; i < 2; i++) {
    arb_poly_mullow(part, y + row, &s->f[k][i], j->n, j->prec);
    add_scaled(out, j, i == row ? s->k->above : s->k->below, part);
  }
  arb_poly_sub_series(part, &s->f[k][0], &s->f[k][1], j->n, j->prec);
  arb_poly_mullow(part, part, y + 1 - row, j->n, j->prec);
  add_scaled(out, j, s->corner[row], part);
}

/* Row `row` of y, or of y'. */
static void slide_row(arb_poly_t out, struct jet *j, struct slide *s, bool derivative, int row) {
  arb_poly_zero(out);
  add_function(out, j, s, derivative ? 2 : 0, s->y, row);
  add_function(out, j, s, derivative ? 0 : 1, s->dy, row);
}

/* r and r' at the end of phase H, where z_1' = (w' + chi r')/(1 - chi) = V. */
static void through_h(arb_poly_t r, arb_poly_t dr, struct jet *j, const arb_poly_t w, const arb_poly_t dw,
                      const arb_t tc) {
  struct calc *c = &j->c;
  val chi = j->m.p[P_CHI], rb = calc_div(c, j->m.p[P_E2], chi), span = calc_sub(c, chi, j->m.one);
  const struct spectrum *k = &j->m.spectrum;
  struct slide s = {.k = k, .corner = {calc_mul(c, chi, k->back), calc_div(c, j->m.one, k->gap)}};
  arb_poly_struct p[3], *t = p, *value = p + 1, *rate = p + 2;
  polys_init(p, 3);
  polys_init(s.y, 2);
  polys_init(s.dy, 2);
  for (int i = 0; i < 3; i++) polys_init(s.f[i], 2);
  arb_poly_set(&s.y[0], w);
  arb_poly_set(&s.dy[0], dw);
  arb_poly_set_arb(&s.y[1], rb); /* r at the end of phase Gamma */
  arb_poly_set_arb(&s.dy[1], j->m.a);
  arb_poly_sub_series(&s.dy[1], &s.dy[1], dw, j->n, j->prec); /* r' = (1 - chi) V - w' */
  arb_poly_set_arb(t, tc);
  for (slong known = 1; known < j->n; known *= 2) {
    slide_at(&s, j, t);
    slide_row(value, j, &s, true, 0);
    slide_row(dr, j, &s, true, 1);
    add_scaled(value, j, chi, dr);
    slide_row(rate, j, &s, false, 0);
    arb_poly_scalar_mul(rate, rate, span, j->prec); /* (1 - chi) z_1'' = -(1 - chi) w */
    newton_step(t, j, value, rate);
  }
  slide_at(&s, j, t);
  slide_row(r, j, &s, false, 1);
  slide_row(dr, j, &s, true, 1);
  for (int i = 0; i < 3; i++) polys_clear(s.f[i], 2);
  polys_clear(s.dy, 2);
  polys_clear(s.y, 2);
  polys_clear(p, 3);
}

int dyn_return_jet(arb_ptr c, slong n, const struct num_vec *params, const struct dyn_arc *arc) {
  struct jet j = {.n = n, .prec = params->ctx.prec, .c = calc_begin(params->ctx)};
  arb_poly_struct of[4], *w = of, *dw = of + 1, *r = of + 2, *dr = of + 3;
  val p[N_PARAMS];
  flow_vals(p, params, 0, N_PARAMS);
  ball_params_make(&j.m, &j.c, p);
  arb_poly_init(j.s);
  arb_poly_init(j.tmp);
  arb_poly_set_coeff_si(j.s, 1, 1);
  polys_init(of, 4);
  through_gamma(w, dw, &j, num_vec_at(&arc->t, PHASE_GAMMA));
  through_h(r, dr, &j, w, dw, num_vec_at(&arc->t, PHASE_H));
  /* phase C: the extremum of r has the size sqrt(r^2 + r'^2/(chi eta)) and the sign of the arc's end */
  arb_poly_mullow(r, r, r, n, j.prec);
  arb_poly_mullow(dr, dr, dr, n, j.prec);
  arb_poly_scalar_div(dr, dr, j.m.stiff, j.prec);
  arb_poly_add_series(r, r, dr, n, j.prec);
  arb_poly_sqrt_series(r, r, n, j.prec);
  val end =
      calc_sub(&j.c, num_vec_at(&arc->z, N_PHASES * N_STATE + Z_2), num_vec_at(&arc->z, N_PHASES * N_STATE + Z_1));
  int status = arb_contains_zero(end) ? SS_UNABLE : SS_OK;
  if (arb_is_negative(end)) arb_poly_neg(r, r);
  for (slong i = 0; i < n; i++) {
    arb_poly_get_coeff_arb(c + i, r, i);
    if (!arb_is_finite(c + i)) status |= SS_UNABLE;
  }
  polys_clear(of, 4);
  arb_poly_clear(j.tmp);
  arb_poly_clear(j.s);
  calc_clear(&j.c);
  return status;
}
