/* The return map of r as a truncated Taylor series, by arithmetic of series in balls.

   At the end of the stick phase w = e1 and both velocities are V, so the start of phase Gamma is r_0 + s alone.  Each
   event time is a series in s, found by Newton's iteration on series from its enclosed constant term; the defect's own
   constant term is exactly zero at the event and is set to that.  In (w, r) phase Gamma is w'' = -w with
   r' = (1 - chi) V - w', phase H is y'' = -M y with M = [1, -chi^2 eta; -1, chi eta], and phase C ends at the extremum
   of r'' = -chi eta r. */
#include "flow.h"
#include "num/flint_more.h"

struct jet {
  slong n, prec;
  arb_t chi, eta, V, e1, e2, a, stiff; /* a = (1 - chi) V, stiff = chi eta */
  arb_poly_t s, tmp;                   /* the variable; scratch */
};

static void jet_init(struct jet *j, slong n, const struct num_vec *params) {
  arb_ptr to[] = {j->chi, j->eta, j->V, j->e1, j->e2};
  j->n = n;
  j->prec = params->ctx.prec;
  for (int i = 0; i < N_PARAMS; i++) {
    arb_init(to[i]);
    params->ctx.type->get_arb(to[i], num_vec_at(params, i));
  }
  arb_init(j->a);
  arb_init(j->stiff);
  arb_mul(j->a, j->chi, j->V, j->prec);
  arb_sub(j->a, j->V, j->a, j->prec);
  arb_mul(j->stiff, j->chi, j->eta, j->prec);
  arb_poly_init(j->tmp);
  arb_poly_init(j->s);
  arb_poly_set_coeff_si(j->s, 1, 1);
}

static void jet_clear(struct jet *j) {
  arb_ptr all[] = {j->chi, j->eta, j->V, j->e1, j->e2, j->a, j->stiff};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  arb_poly_clear(j->tmp);
  arb_poly_clear(j->s);
}

/* out += k p */
static void add_scaled(arb_poly_t out, struct jet *j, const arb_t k, const arb_poly_t p) {
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
  arb_poly_t t, sine, cosine, value, rate;
  arb_t minus;
  arb_init(minus);
  arb_poly_init(t);
  arb_poly_init(sine);
  arb_poly_init(cosine);
  arb_poly_init(value);
  arb_poly_init(rate);
  arb_poly_set_arb(t, tb);
  for (slong known = 1;; known *= 2) {
    arb_poly_sin_cos_series(sine, cosine, t, j->n, j->prec);
    arb_poly_zero(w);
    arb_poly_zero(dw);
    add_scaled(w, j, j->e1, cosine);
    add_scaled(w, j, j->a, sine);
    add_scaled(dw, j, j->a, cosine);
    arb_neg(minus, j->e1);
    add_scaled(dw, j, minus, sine);
    if (known >= j->n) break;
    /* r - e2/chi = r_0 + s + a t - (w - e1) - e2/chi, of which only the terms in s count; its rate is a - w' */
    arb_poly_scalar_mul(value, t, j->a, j->prec);
    arb_poly_sub_series(value, value, w, j->n, j->prec);
    arb_poly_add_series(value, value, j->s, j->n, j->prec);
    arb_poly_set_arb(rate, j->a);
    arb_poly_sub_series(rate, rate, dw, j->n, j->prec);
    newton_step(t, j, value, rate);
  }
  arb_poly_clear(rate);
  arb_poly_clear(value);
  arb_poly_clear(cosine);
  arb_poly_clear(sine);
  arb_poly_clear(t);
  arb_clear(minus);
}

/* --- Phase H. --- */

struct slide {
  struct calc c;
  struct spectrum k;      /* M has the eigenvalues of K */
  val corner[2];          /* f(M) off its diagonal, row by row, over f_1 - f_2 */
  arb_poly_t y[2], dy[2]; /* w, r and their derivatives at the start */
  arb_poly_t f[3][2];     /* cos, sin/om, -om sin at the time, for both frequencies */
};

static void slide_init(struct slide *s, const struct jet *j) {
  const val p[N_PARAMS] = {j->chi, j->eta, j->V, j->e1, j->e2};
  s->c = calc_begin(num_ctx_arb(j->prec));
  s->k = flow_spectrum(&s->c, p);
  s->corner[0] = calc_mul(&s->c, p[P_CHI], s->k.back);
  s->corner[1] = calc_div(&s->c, calc_d(&s->c, 1), s->k.gap);
  for (int i = 0; i < 2; i++) {
    arb_poly_init(s->y[i]);
    arb_poly_init(s->dy[i]);
    for (int k = 0; k < 3; k++) arb_poly_init(s->f[k][i]);
  }
}

static void slide_clear(struct slide *s) {
  calc_clear(&s->c);
  for (int i = 0; i < 2; i++) {
    arb_poly_clear(s->y[i]);
    arb_poly_clear(s->dy[i]);
    for (int k = 0; k < 3; k++) arb_poly_clear(s->f[k][i]);
  }
}

static void slide_at(struct slide *s, struct jet *j, const arb_poly_t t) {
  for (int i = 0; i < 2; i++) {
    arb_poly_scalar_mul(j->tmp, t, s->k.om[i], j->prec);
    arb_poly_sin_cos_series(s->f[1][i], s->f[0][i], j->tmp, j->n, j->prec);
    arb_poly_scalar_mul(s->f[2][i], s->f[1][i], s->k.om[i], j->prec);
    arb_poly_neg(s->f[2][i], s->f[2][i]);
    arb_poly_scalar_div(s->f[1][i], s->f[1][i], s->k.om[i], j->prec);
  }
}

/* out += row `row` of f(M) y, f the function with the values f[k] at the two eigenvalues.  As f(K) in flow.h,
   f(M) = [above f_1 + below f_2, chi^2 eta (f_1 - f_2); f_1 - f_2, below f_1 + above f_2]/gap. */
static void add_function(arb_poly_t out, struct jet *j, const struct slide *s, int k, const arb_poly_t y[2], int row) {
  arb_poly_t part;
  arb_poly_init(part);
  for (int i = 0; i < 2; i++) {
    arb_poly_mullow(part, y[row], s->f[k][i], j->n, j->prec);
    add_scaled(out, j, i == row ? s->k.above : s->k.below, part);
  }
  arb_poly_sub_series(part, s->f[k][0], s->f[k][1], j->n, j->prec);
  arb_poly_mullow(part, part, y[1 - row], j->n, j->prec);
  add_scaled(out, j, s->corner[row], part);
  arb_poly_clear(part);
}

/* Row `row` of y, or of y'. */
static void slide_row(arb_poly_t out, struct jet *j, struct slide *s, bool derivative, int row) {
  arb_poly_zero(out);
  add_function(out, j, s, derivative ? 2 : 0, (const arb_poly_t *)s->y, row);
  add_function(out, j, s, derivative ? 0 : 1, (const arb_poly_t *)s->dy, row);
}

/* r and r' at the end of phase H, where z_1' = (w' + chi r')/(1 - chi) = V. */
static void through_h(arb_poly_t r, arb_poly_t dr, struct jet *j, const arb_poly_t w, const arb_poly_t dw,
                      const arb_t tc) {
  struct slide s;
  arb_poly_t t, value, rate;
  arb_t span;
  arb_init(span);
  arb_poly_init(t);
  arb_poly_init(value);
  arb_poly_init(rate);
  slide_init(&s, j);
  arb_poly_set(s.y[0], w);
  arb_poly_set(s.dy[0], dw);
  arb_div(span, j->e2, j->chi, j->prec);
  arb_poly_set_arb(s.y[1], span); /* r at the end of phase Gamma */
  arb_poly_set_arb(s.dy[1], j->a);
  arb_poly_sub_series(s.dy[1], s.dy[1], dw, j->n, j->prec); /* r' = (1 - chi) V - w' */
  arb_sub_si(span, j->chi, 1, j->prec);
  arb_poly_set_arb(t, tc);
  for (slong known = 1; known < j->n; known *= 2) {
    slide_at(&s, j, t);
    slide_row(value, j, &s, true, 0);
    slide_row(dr, j, &s, true, 1);
    add_scaled(value, j, j->chi, dr);
    slide_row(rate, j, &s, false, 0);
    arb_poly_scalar_mul(rate, rate, span, j->prec); /* (1 - chi) z_1'' = -(1 - chi) w */
    newton_step(t, j, value, rate);
  }
  slide_at(&s, j, t);
  slide_row(r, j, &s, false, 1);
  slide_row(dr, j, &s, true, 1);
  slide_clear(&s);
  arb_poly_clear(rate);
  arb_poly_clear(value);
  arb_poly_clear(t);
  arb_clear(span);
}

int dyn_return_jet(arb_ptr c, slong n, const struct num_vec *params, const struct dyn_arc *arc) {
  struct jet j;
  arb_poly_t w, dw, r, dr;
  arb_t end;
  jet_init(&j, n, params);
  arb_init(end);
  arb_poly_init(w);
  arb_poly_init(dw);
  arb_poly_init(r);
  arb_poly_init(dr);
  through_gamma(w, dw, &j, num_vec_at(&arc->t, PHASE_GAMMA));
  through_h(r, dr, &j, w, dw, num_vec_at(&arc->t, PHASE_H));
  /* phase C: the extremum of r has the size sqrt(r^2 + r'^2/(chi eta)) and the sign of the arc's end */
  arb_poly_mullow(r, r, r, n, j.prec);
  arb_poly_mullow(dr, dr, dr, n, j.prec);
  arb_poly_scalar_div(dr, dr, j.stiff, j.prec);
  arb_poly_add_series(r, r, dr, n, j.prec);
  arb_poly_sqrt_series(r, r, n, j.prec);
  arb_sub(end, num_vec_at(&arc->z, N_PHASES * N_STATE + Z_2), num_vec_at(&arc->z, N_PHASES * N_STATE + Z_1), j.prec);
  int status = arb_contains_zero(end) ? SS_UNABLE : SS_OK;
  if (arb_is_negative(end)) arb_poly_neg(r, r);
  for (slong i = 0; i < n; i++) {
    arb_poly_get_coeff_arb(c + i, r, i);
    if (!arb_is_finite(c + i)) status |= SS_UNABLE;
  }
  arb_poly_clear(dr);
  arb_poly_clear(r);
  arb_poly_clear(dw);
  arb_poly_clear(w);
  arb_clear(end);
  jet_clear(&j);
  return status;
}
