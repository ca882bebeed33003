/* The pass through the word at many digits, from known rough times.

   In w = z_1 - chi z_2 and r = z_2 - z_1 a switching function is a drift and one oscillation (phase Gamma) or two
   (phase H), so that at a time near its root one sine and cosine for each frequency give the function itself and every
   derivative.  The root is then some products away: a first step of fourth order, Newton's iteration with the kept
   sines turned by what it moved, and the motion at the root comes with it.  Phase C ends at an angle that differs from
   a kept one by an arcsine, and its state is a square root.  So a pass takes four sines and cosines at its precision.
   It starts from times that are right to an eighth of its bits; those come from a pass at that precision, and the first
   of all from doubles.

   In balls the same arithmetic is carried out around exact middles.  The last step is an interval Newton step: the
   second derivative of oscillations is bounded by their amplitudes all over, so that proving one root costs a
   division. */
#include "arc.h"
#include "flow.h"
#include "map_balls.h"
#include "turn.h"

enum { GUARD = 32, SPARE = 8, FIRST = 700, LEVELS = 40, MOST_LOST = 1000 };
/* The events. */
enum { AT_B, AT_C, AT_D, N_EVENTS };

/* What a pass is made with; half has half the precision, for corrections. */
struct maker {
  struct calc *c, *half;
  struct ball_params m;
  slong lost; /* bits of the results that cancellation takes, at most about */
};

/* f(t) = base + drift t + sum over i of a[i] cos(om[i] t) - b[i] sin(om[i] t). */
struct wave {
  int n;
  val om[2], a[2], b[2], base, drift;
};

/* om x, om being 1 when it is NULL. */
static val times(struct calc *c, val om, val x) {
  return om ? calc_mul(c, om, x) : x;
}

/* The motion from time d on. */
static struct wave later(struct calc *c, const struct wave *m, val d) {
  struct wave at = *m;
  if (m->drift) at.base = calc_add(c, m->base, calc_mul(c, m->drift, d));
  for (int i = 0; i < m->n; i++) {
    val s, v;
    turn_small(&s, &v, c, times(c, m->om[i], d));
    at.a[i] = calc_sub(c, m->a[i], calc_dot(c, m->b[i], s, m->a[i], v));
    at.b[i] = calc_dot_from(c, m->b[i], m->a[i], s, true, m->b[i], v);
  }
  return at;
}

static val value_of(struct calc *c, const struct wave *m) {
  val f = m->base;
  for (int i = 0; i < m->n; i++) f = calc_add(c, f, m->a[i]);
  return f;
}

static val rate_of(struct calc *c, const struct wave *m) {
  val f = m->n == 1 ? m->b[0] : calc_dot(c, m->om[0], m->b[0], m->om[1], m->b[1]);
  return m->drift ? calc_sub(c, m->drift, f) : calc_neg(c, f);
}

static struct wave shortened(struct calc *c, const struct wave *m) {
  struct wave s = {.n = m->n, .drift = m->drift ? calc_round(c, m->drift) : NULL};
  for (int i = 0; i < m->n; i++) {
    s.om[i] = m->om[i] ? calc_round(c, m->om[i]) : NULL;
    s.a[i] = calc_round(c, m->a[i]);
    s.b[i] = calc_round(c, m->b[i]);
  }
  return s;
}

/* The second and the third derivative. */
static void derivatives(val *bend, val *jerk, struct calc *c, const struct wave *m) {
  if (m->n == 1) {
    *bend = calc_neg(c, m->a[0]);
    *jerk = m->b[0];
    return;
  }
  val square[2], cube[2];
  for (int i = 0; i < 2; i++) {
    square[i] = calc_mul(c, m->om[i], m->om[i]);
    cube[i] = calc_mul(c, square[i], m->om[i]);
  }
  *bend = calc_neg(c, calc_dot(c, square[0], m->a[0], square[1], m->a[1]));
  *jerk = calc_dot(c, cube[0], m->b[0], cube[1], m->b[1]);
}

/* The step to the root to fourth order, u - c2 u^2 + (2 c2^2 - c3) u^3 with u = -f/f' and c_k = f^(k)/(k! f'); the
   error is about 2^(-3 small) of it. */
static val first_step(slong *small, struct calc *c, const struct wave *exact, val f) {
  struct wave m = shortened(c, exact);
  val bend, jerk, fastest = m.om[m.n - 1];
  derivatives(&bend, &jerk, c, &m);
  val scale = calc_div(c, calc_d(c, -1), rate_of(c, &m)), u = calc_mul(c, scale, calc_round(c, f));
  val part = calc_mul(c, scale, u);
  val y = calc_div_ui(c, calc_mul(c, bend, part), 2); /* -c2 u */
  val x = calc_div_ui(c, calc_mul(c, calc_mul(c, jerk, part), u), 6);
  val square = calc_mul(c, y, y), more = calc_add(c, calc_add(c, y, x), calc_add(c, square, square));
  *small = -FLINT_MAX(FLINT_MAX(calc_exponent(c, y), (calc_exponent(c, x) + 1) / 2),
                      calc_exponent(c, u) + (fastest ? calc_exponent(c, fastest) : 1));
  return calc_middle(c, calc_add(c, u, calc_mul(c, u, more)));
}

/* A bound of |f''| at all times. */
static void bend_of(mag_t bend, const struct wave *m) {
  NUMBERS(mag, part, more);
  mag_zero(bend);
  for (int i = 0; i < m->n; i++) {
    arb_get_mag(part, m->a[i]);
    arb_get_mag(more, m->b[i]);
    mag_add(part, part, more);
    mag_one(more);
    if (m->om[i]) arb_get_mag(more, m->om[i]);
    mag_mul(part, part, more);
    mag_addmul(bend, part, more);
  }
}

/* The quotient -f/(rate + bend [-radius, radius]). */
static void quotient(arb_t h, const arb_t f, const arb_t rate, const mag_t bend, const mag_t radius, slong prec) {
  NUMBERS(mag, spread);
  mag_mul(spread, bend, radius);
  arb_set(h, rate);
  arb_add_error_mag(h, spread);
  arb_div(h, f, h, prec);
  arb_neg(h, h);
}

/* The step from an exact point to the only root within a radius of it, by interval Newton.  Twice the step that the
   rate at the point tells is the best radius: where that one is not proved, none is but for rounding. */
static val proved_step(struct calc *c, const struct wave *m, val f, val rate) {
  arb_ptr h = calc_new(c);
  NUMBERS(mag, bend, radius, reach);
  bend_of(bend, m);
  quotient(h, f, rate, bend, radius, c->ctx.prec);
  arb_get_mag(radius, h);
  mag_mul_2exp_si(radius, radius, 1);
  quotient(h, f, rate, bend, radius, c->ctx.prec);
  arb_get_mag(reach, h);
  if (arb_is_finite(h) && mag_cmp(reach, radius) <= 0)
    quotient(h, f, rate, bend, reach, c->ctx.prec);
  else
    c->status |= SS_UNABLE;
  return h;
}

/* x + move, for a part x of the oscillation of a and b that turns by a small angle; in balls with what the square of
   the angle can change. */
static val moved(struct calc *c, val x, val move, val turned, val a, val b) {
  val sum = calc_add(c, x, move);
  if (!c->ctx.type->rigorous) return sum;
  NUMBERS(mag, error, size);
  arb_get_mag(error, a);
  arb_get_mag(size, b);
  mag_add(error, error, size);
  arb_get_mag(size, turned);
  mag_mul(size, size, size);
  mag_mul(error, error, size);
  mag_mul_2exp_si(error, error, -1);
  arb_ptr wide = calc_new(c);
  arb_set(wide, sum);
  arb_add_error_mag(wide, error);
  return wide;
}

/* The motion at its root near 0, from there on; *t = at + the root.  scale: exponent of what cancels in the value. */
static struct wave to_root(val *t, struct maker *k, const struct wave *m, val at, slong scale) {
  struct calc *c = k->c, *half = k->half;
  slong small, prec = c->ctx.prec, most = half->ctx.prec;
  val f = value_of(c, m), d = first_step(&small, half, m, f);
  slong near = FLINT_MAX(calc_exponent(c, calc_add(c, at, d)) - calc_exponent(half, d), -prec);
  slong good = near + FLINT_MIN(3 * small, most);
  struct wave root = *m;
  if (small < 3) half->status |= SS_UNABLE;
  for (;;) { /* good: bits of at + d, of which a step of Newton's makes more */
    if (half->status | c->status) return root;
    root = later(c, m, d);
    f = value_of(c, &root);
    slong gain = FLINT_MIN(small + good - near, most);
    if (good + gain >= prec) break;
    good += gain;
    d = calc_middle(c, calc_sub(c, d, calc_div(half, f, rate_of(half, &root))));
  }
  struct wave end = shortened(half, &root);
  val rate = rate_of(half, &end);
  val h = c->ctx.type->rigorous ? proved_step(half, &end, f, rate) : calc_neg(half, calc_div(half, f, rate));
  for (int i = 0; i < m->n; i++) {
    val turned = times(half, end.om[i], h), back = calc_neg(half, calc_mul(half, turned, end.b[i]));
    val on = calc_mul(half, turned, end.a[i]);
    root.a[i] = moved(c, root.a[i], back, turned, end.a[i], end.b[i]);
    root.b[i] = moved(c, root.b[i], on, turned, end.a[i], end.b[i]);
  }
  *t = calc_add(c, calc_add(c, at, d), h);
  k->lost += FLINT_MAX(scale - calc_exponent(half, rate) - calc_exponent(c, *t), 0);
  return root;
}

/* asin x for small x: its terms fall faster than x^2, so that the last one bounds the rest. */
static val small_arcsine(struct calc *c, val x) {
  val y = calc_mul(c, x, x), term = x, sum = x;
  if (calc_exponent(c, x) > -2) c->status |= SS_UNABLE;
  for (ulong n = 1; calc_exponent(c, term) >= -c->ctx.prec && !c->status; n += 2) {
    term = calc_div_ui(c, calc_mul(c, calc_mul(c, term, y), calc_d(c, (double)(n * n))), (n + 1) * (n + 2));
    sum = calc_add(c, sum, term);
  }
  return calc_within(c, sum, term);
}

/* --- The phases. --- */

/* A pass: everything after the stick phase begins. */
struct course {
  val t[N_PHASES], z[N_PHASES + 1][N_STATE];
};

static void set_state(val z[N_STATE], val z1, val z2, val dz1, val dz2) {
  z[Z_1] = z1;
  z[Z_2] = z2;
  z[DZ_1] = dz1;
  z[DZ_2] = dz2;
}

static slong largest(struct calc *c, const val *x, int n) {
  slong e = CALC_TINY;
  for (int i = 0; i < n; i++) e = FLINT_MAX(e, calc_exponent(c, x[i]));
  return e;
}

static void pass_d(struct course *o, struct maker *k, val z10, val z20) {
  struct calc *c = k->c;
  const struct ball_params *m = &k->m;
  val V = m->p[P_V], w = flow_force(c, 0, m->p[P_CHI], (const val[]){z10, z20});
  o->t[PHASE_D] = calc_div(c, calc_sub(c, m->p[P_E1], w), m->a);
  val way = calc_mul(c, V, o->t[PHASE_D]);
  set_state(o->z[0], z10, z20, V, V);
  set_state(o->z[1], calc_add(c, z10, way), calc_add(c, z20, way), V, V);
}

/* w = e1 cos t + a sin t, and chi r has risen by a t + e1 - w.  Leaves w and w' at the end. */
static void pass_gamma(val w[2], struct course *o, struct maker *k, val near) {
  struct calc *c = k->c;
  const struct ball_params *m = &k->m;
  val e1 = m->p[P_E1], V = m->p[P_V], sine, cosine, rb = calc_div(c, m->p[P_E2], m->p[P_CHI]);
  val r = calc_sub(c, o->z[0][Z_2], o->z[0][Z_1]), slide = calc_mul(c, m->a, near);
  calc_sin_cos(c, &sine, &cosine, near);
  val base = calc_add(c, slide, calc_sub(c, e1, calc_sub(c, rb, r)));
  struct wave f = {1,
                   {NULL, NULL},
                   {calc_neg(c, calc_dot(c, e1, cosine, m->a, sine)), NULL},
                   {calc_dot_from(c, NULL, m->a, cosine, true, e1, sine), NULL},
                   base,
                   m->a};
  f = to_root(&o->t[PHASE_GAMMA], k, &f, near, largest(c, (val[]){e1, rb, r, slide}, 4));
  if (c->status | k->half->status) return;
  w[0] = calc_neg(c, f.a[0]);
  w[1] = f.b[0];
  val z2 = calc_add(c, o->z[1][Z_2], calc_mul(c, V, o->t[PHASE_GAMMA]));
  set_state(o->z[2], calc_sub(c, z2, rb), z2, calc_add(c, V, calc_sub(c, w[1], m->a)), V);
}

/* The velocity of m1 by modes; that of m2 has (below, -above)/couple times their parts.  Leaves r and q at the end. */
static void pass_h(val *r, val *q, struct course *o, struct maker *k, const val wb[2], val near) {
  struct calc *c = k->c;
  const struct ball_params *m = &k->m;
  const struct spectrum *s = &m->spectrum;
  val V = m->p[P_V], v1 = o->z[2][DZ_1], pull = calc_mul(c, m->p[P_ETA], m->p[P_E2]);
  val v[2] = {calc_dot(c, s->above, v1, s->couple, V), calc_dot_from(c, NULL, s->below, v1, true, s->couple, V)};
  val force[2] = {calc_dot(c, s->above, wb[0], s->couple, pull),
                  calc_dot_from(c, NULL, s->below, wb[0], true, s->couple, pull)};
  struct wave p = {.n = 2, .base = calc_neg(c, V), .drift = NULL};
  for (int i = 0; i < 2; i++) {
    val sine, cosine, b = calc_div(c, force[i], s->om[i]);
    calc_sin_cos(c, &sine, &cosine, calc_mul(c, s->om[i], near));
    p.om[i] = s->om[i];
    p.a[i] = calc_dot_from(c, NULL, v[i], cosine, true, b, sine);
    p.b[i] = calc_dot(c, v[i], sine, b, cosine);
  }
  slong scale = largest(c, (val[]){V, p.a[0], p.b[0], p.a[1], p.b[1]}, 5);
  p = to_root(&o->t[PHASE_H], k, &p, near, scale);
  if (c->status | k->half->status) return;
  val pull0 = calc_mul(c, s->om[0], p.b[0]), pull1 = calc_mul(c, s->om[1], p.b[1]), w = calc_add(c, pull0, pull1);
  val v2 = calc_dot_from(c, NULL, s->below, p.a[0], true, s->above, p.a[1]);
  val f2 = calc_dot_from(c, NULL, s->below, pull0, true, s->above, pull1);
  val each = calc_div(c, m->one, s->couple);
  v2 = calc_mul(c, v2, each);
  *q = calc_sub(c, v2, V);
  *r = calc_div(c, calc_mul(c, f2, each), m->stiff);
  k->lost += FLINT_MAX(-calc_exponent(c, s->couple), 0);
  val ease = calc_sub(c, m->one, m->p[P_CHI]);
  val z1 = calc_div(c, calc_add(c, w, calc_mul(c, m->p[P_CHI], *r)), ease);
  k->lost += FLINT_MAX(-calc_exponent(c, ease), 0);
  set_state(o->z[3], z1, calc_add(c, z1, *r), V, v2);
}

/* q = omega (y cos - r sin)(omega t) with y = q_c/omega, so that r comes to +-hypot(r, y) at the end, and the sine of
   the angle from there back to a kept one is known. */
static void pass_c(struct course *o, struct maker *k, val r, val q, val near) {
  struct calc *c = k->c;
  const struct ball_params *m = &k->m;
  val V = m->p[P_V], sine, cosine, y = calc_div(c, q, m->omega);
  calc_sin_cos(c, &sine, &cosine, calc_mul(c, m->omega, near));
  val end = calc_sqrt(c, calc_dot(c, r, r, y, y)), ahead = calc_dot(c, r, cosine, y, sine);
  if (calc_lt(c, ahead, m->zero))
    end = calc_neg(c, end);
  else if (!calc_lt(c, m->zero, ahead))
    c->status |= SS_UNABLE;
  if (c->status) return;
  val back = calc_div(c, calc_dot_from(c, NULL, y, cosine, true, r, sine), end);
  val t = calc_add(c, near, calc_div(c, small_arcsine(c, back), m->omega));
  o->t[PHASE_C] = t;
  k->lost += FLINT_MAX(
      calc_exponent(c, V) - largest(c, (val[]){r, y}, 2) - 2 * calc_exponent(c, m->omega) - calc_exponent(c, t), 0);
  k->lost += FLINT_MAX(-calc_exponent(c, m->omega) - calc_exponent(c, t), 0);
  val z1 = calc_add(c, o->z[3][Z_1], calc_mul(c, V, t));
  set_state(o->z[4], z1, calc_add(c, z1, end), V, V);
}

/* --- Precisions. --- */

/* Parameters, start and event times; exact but for balls at the last precision. */
struct given {
  const struct num_vec *params;
  val z10, z20;
  struct num_vec near;
};

static val rounded(struct calc *c, val x, bool exact) {
  if (c->ctx.type->rigorous && !exact) return x;
  void *z = calc_new(c);
  c->ctx.type->set(z, x);
  if (c->ctx.type->rigorous) {
    arb_set_round(z, z, c->ctx.prec);
    arb_get_mid_arb(z, z);
  }
  return z;
}

/* A pass at the precision, from given->near; the times go there if it is not the last, else all to the arc.  *lost: as
   in struct maker. */
static int level(struct dyn_arc *a, slong *lost, struct given *g, slong prec, bool last) {
  const struct num_type *type = g->params->ctx.type;
  OWNED(calc) c = calc_begin((struct num_ctx){type, prec}), half;
  struct maker k = {&c, &half, .lost = 0};
  struct course o;
  val p[N_PARAMS], near[N_EVENTS], w[2] = {NULL, NULL}, r = NULL, q = NULL;
  slong start = prec <= FIRST ? 44 : prec / 8; /* bits of the times */
  half = calc_begin((struct num_ctx){type, FLINT_MAX((prec + SPARE - start) / 2, 32)});
  for (int i = 0; i < N_PARAMS; i++) p[i] = rounded(&c, num_vec_at(g->params, i), !last);
  for (int i = 0; i < N_EVENTS; i++) near[i] = rounded(&c, num_vec_at(&g->near, i), true);
  ball_params_make(&k.m, &c, p);
  pass_d(&o, &k, rounded(&c, g->z10, !last), rounded(&c, g->z20, !last));
  if (!c.status) pass_gamma(w, &o, &k, near[AT_B]);
  if (!(c.status | half.status)) pass_h(&r, &q, &o, &k, w, near[AT_C]);
  if (!(c.status | half.status)) pass_c(&o, &k, r, q, near[AT_D]);
  int status = c.status | half.status;
  for (int i = 0; i < N_EVENTS && !status; i++) type->set(num_vec_at(&g->near, i), o.t[PHASE_GAMMA + i]);
  for (slong i = 0; i < N_PHASES && !status && last; i++) type->set(num_vec_at(&a->t, i), o.t[i]);
  for (slong i = 0; i < a->z.len && !status && last; i++)
    type->set(num_vec_at(&a->z, i), o.z[i / N_STATE][i % N_STATE]);
  *lost = k.lost;
  return status;
}

/* The levels up to the precision, each with eight times the bits of the one before. */
static int climb(struct dyn_arc *a, slong *lost, struct given *g, slong prec, bool direct) {
  slong ladder[LEVELS], n = 0;
  int status = SS_OK;
  ladder[n++] = prec;
  for (slong bits = prec; bits > FIRST && !direct; ladder[n++] = bits) bits = bits / 8 + SPARE;
  while (n-- > 0 && !status) status = level(a, lost, g, ladder[n], n == 0);
  return status;
}

static bool exact_start(const struct given *g) {
  if (!g->params->ctx.type->rigorous) return true;
  bool exact = arb_is_exact(g->z10) && arb_is_exact(g->z20);
  for (slong i = 0; i < N_PARAMS; i++) exact = exact && arb_is_exact((arb_srcptr)num_vec_at(g->params, i));
  return exact;
}

int map_run(struct dyn_arc *a, const struct num_vec *params, val z10, val z20, const struct num_vec *near,
            const double guess[N_PHASES]) {
  const struct num_type *type = params->ctx.type;
  slong prec = params->ctx.prec, lost = 0, work = prec + GUARD;
  struct given g = {.params = params, .z10 = z10, .z20 = z20};
  int status = SS_OK;
  if (type != &num_mpfr && type != &num_arb) return SS_UNABLE;
  num_vec_init(&g.near, N_EVENTS, (struct num_ctx){type, work});
  for (slong i = 0; i < N_EVENTS && !status; i++) {
    void *x = num_vec_at(&g.near, i);
    if (near)
      type->set(x, num_vec_at(near, PHASE_GAMMA + i));
    else
      status |= type->set_d(x, guess[PHASE_GAMMA + i], work);
  }
  if (!status) status = climb(a, &lost, &g, work, near != NULL);
  if (!status && lost > GUARD - SPARE && exact_start(&g))
    status = lost > 2 * prec + MOST_LOST ? SS_UNABLE : climb(a, &lost, &g, prec + lost + SPARE, true);
  num_vec_clear(&g.near);
  if (status) return SS_UNABLE;
  for (slong i = 0; i < a->t.len && type == &num_arb; i++)
    arb_set_round(num_vec_at(&a->t, i), num_vec_at(&a->t, i), prec);
  for (slong i = 0; i < a->z.len && type == &num_arb; i++)
    arb_set_round(num_vec_at(&a->z, i), num_vec_at(&a->z, i), prec);
  return SS_OK;
}
