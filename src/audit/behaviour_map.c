/* The return map and linearization: what the propagators alone would say of stability, and what happens where the slope of
   the map is exactly -1. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "behaviour.h"

/* --- Linearization without and with the jumps at the switches --- */

/* Is some eigenvalue of the 4x4 matrix surely outside the unit circle?  Yes when |tr M^k| > 4 for some k. */
static truth has_growth(const struct num_vec *m) {
  enum { DOUBLINGS = 9 };
  struct num_vec power;
  arb_t trace, four;
  truth t = TRUTH_UNKNOWN;
  arb_init(trace);
  arb_init(four);
  arb_set_si(four, N_STATE);
  num_vec_init(&power, m->len, m->ctx);
  num_vec_set(&power, m);
  for (int i = 0; t != TRUTH_TRUE && i < DOUBLINGS; i++) {
    arb_zero(trace);
    for (int k = 0; k < N_STATE; k++) arb_add(trace, trace, num_vec_at(&power, (N_STATE + 1) * k), m->ctx.prec);
    arb_abs(trace, trace);
    if (arb_gt(trace, four)) t = TRUTH_TRUE;
    num_mat_mul(&power, &power, &power, N_STATE, N_STATE, N_STATE);
  }
  num_vec_clear(&power);
  arb_clear(four);
  arb_clear(trace);
  return t;
}

/* Unstable by the product of the phases' propagators? */
static truth unstable_by_propagators(struct values *v) {
  struct num_vec step, product;
  num_vec_init(&step, N_STATE * N_STATE, v->ctx);
  num_vec_init(&product, N_STATE * N_STATE, v->ctx);
  int s = dyn_propagator(&product, PHASE_D, &v->params, num_vec_at(&v->arc.t, PHASE_D));
  for (int ph = PHASE_GAMMA; ph < N_PHASES; ph++) {
    s |= dyn_propagator(&step, (enum phase)ph, &v->params, num_vec_at(&v->arc.t, ph));
    s |= num_mat_mul(&product, &step, &product, N_STATE, N_STATE, N_STATE);
  }
  truth t = s == SS_OK ? has_growth(&product) : TRUTH_UNKNOWN;
  num_vec_clear(&product);
  num_vec_clear(&step);
  return t;
}

/* Unstable by the Jacobian with saltation matrices, which has one eigenvalue that is not 0? */
static truth unstable_by_saltation(struct values *v) {
  struct num_vec j;
  arb_t trace, one;
  arb_init(trace);
  arb_init(one);
  arb_one(one);
  num_vec_init(&j, 4, v->ctx);
  truth t = TRUTH_UNKNOWN;
  if (dyn_return_jacobian_saltation(&j, &v->params, &v->arc) == SS_OK) {
    arb_add(trace, num_vec_at(&j, 0), num_vec_at(&j, 3), v->ctx.prec);
    arb_abs(trace, trace);
    t = arb_gt(trace, one) ? TRUTH_TRUE : arb_lt(trace, one) ? TRUTH_FALSE : TRUTH_UNKNOWN;
  }
  num_vec_clear(&j);
  arb_clear(one);
  arb_clear(trace);
  return t;
}

struct methods {
  long right[2], wrong[2]; /* without jumps, with saltation matrices */
  long comes_back, leaves; /* iterates where the method without jumps is wrong */
  const char *where;
};

static void compare_methods(struct methods *s, struct behaviour *b, const struct point *p) {
  const struct dyn_orbit *o = &orbit_cache_get(b->j->cache, p->q, FD_PREC + 64)->orbit[p->orbit];
  struct values v;
  if (o->grazing || o->stable == TRUTH_UNKNOWN) return;
  if (values_init(&v, p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), b->j->cache) == SS_OK) {
    truth said[2] = {unstable_by_propagators(&v), unstable_by_saltation(&v)}, is = truth_not(o->stable);
    for (int i = 0; i < 2; i++)
      if (said[i] != TRUTH_UNKNOWN) *(said[i] == is ? &s->right[i] : &s->wrong[i]) += 1;
    if (said[0] != TRUTH_UNKNOWN && said[0] != is) {
      double params[N_PARAMS], r0 = orbit_r(o);
      for (int i = 0; i < N_PARAMS; i++) params[i] = fmpq_get_d(&p->q[i]);
      int fate = return_map_fate(params, r0, 1e-4 * fabs(r0), 400);
      s->comes_back += fate > 0;
      s->leaves += fate < 0;
      struct text t;
      text_init(&t);
      point_print(&t, p);
      if (!s->where) s->where = result_str(b->j->out, "%s", text_str(&t));
      text_clear(&t);
    }
  }
  values_clear(&v);
}

bool behaviour_linearization(struct behaviour *b) {
  enum { WANTED = 24, DRAWS = 96 };
  const char *jumps = claim_get(b->c, "jumps");
  int method = jumps && strcmp(jumps, "saltation") == 0;
  struct methods s = {{0}, {0}, 0, 0, NULL};
  struct sampler sampler;
  struct point p;
  sampler_init(&sampler, b->c->id, POINT_ORBIT, PHASE_D, NULL);
  point_init(&p);
  for (int i = 0; i < DRAWS && s.right[1] + s.wrong[1] < WANTED; i++) {
    sampler_next(&p, &sampler);
    if (point_settle(&p, b->j->cache)) compare_methods(&s, b, &p);
  }
  point_clear(&p);
  const char *note = result_str(
      b->j->out,
      "the product of the phases' propagators (the variational equation without what happens at the switches; its "
      "determinant is 1, so it can never call an orbit stable) has a multiplier outside the unit circle at %ld orbits "
      "where |tr J| > 1 and also at %ld where |tr J| < 1; with saltation matrices at the switches linearization "
      "answers "
      "right at %ld orbits and wrong at %ld",
      s.right[0], s.wrong[0], s.right[1], s.wrong[1]);
  long right = s.right[method], wrong = s.wrong[method];
  struct route_word w[2];
  w[0] = behaviour_say(b, "balls", "model",
                       wrong   ? SAYS_AGREES
                       : right ? SAYS_DIFFERS
                               : SAYS_NOTHING,
                       true, right + wrong, s.where, note);
  enum says fate = s.leaves ? SAYS_DIFFERS : s.comes_back ? SAYS_AGREES : SAYS_NOTHING;
  int n = 1;
  if (wrong)
    w[n++] = behaviour_say(b, "iteration", "model", fate, false, s.comes_back + s.leaves, NULL,
                           result_str(b->j->out,
                                      "from beside the orbits that the propagators call unstable and J stable the "
                                      "return map comes back at %ld and leaves at %ld",
                                      s.comes_back, s.leaves));
  b->f->verdict = verdict_of(w, n, false);
  return true;
}

/* --- tr J = -1 exactly --- */

/* A family of orbits with one parameter, in balls: the fixed point r of the return map and its Taylor coefficients. */
struct family {
  const struct point *base;
  int vary; /* P_... */
  slong prec;
  double times[4];
};

/* c[0..n-1] of the return map at r (a ball) for the value of the varied parameter (a ball). */
static int family_jet(arb_ptr c, slong n, const struct family *f, const arb_t value, const arb_t r) {
  struct num_ctx ctx = num_ctx_arb(f->prec);
  struct num_vec params;
  struct dyn_arc arc;
  arb_ptr z = _arb_vec_init(3); /* z_1, z_2, 1 - chi */
  num_vec_init(&params, N_PARAMS, ctx);
  dyn_arc_init(&arc, ctx);
  for (int i = 0; i < N_PARAMS; i++) ctx.type->set_q(num_vec_at(&params, i), &f->base->q[i], ctx.prec);
  ctx.type->set_arb(num_vec_at(&params, f->vary), value, ctx.prec);
  arb_mul(z, num_vec_at(&params, P_CHI), r, ctx.prec);
  arb_add(z, z, num_vec_at(&params, P_E1), ctx.prec);
  arb_add(z + 1, num_vec_at(&params, P_E1), r, ctx.prec);
  arb_sub_si(z + 2, num_vec_at(&params, P_CHI), 1, ctx.prec);
  arb_neg(z + 2, z + 2);
  arb_div(z, z, z + 2, ctx.prec);
  arb_div(z + 1, z + 1, z + 2, ctx.prec);
  int s = dyn_arc_run(&arc, &params, z, z + 1, f->times);
  if (s == SS_OK) s |= dyn_return_jet(c, n, &params, &arc);
  dyn_arc_clear(&arc);
  num_vec_clear(&params);
  _arb_vec_clear(z, 3);
  return s;
}

/* The fixed point near r for one value, to working precision, and the slope there. */
static int family_orbit(arb_t r, arb_t slope, const struct family *f, const arb_t value) {
  arb_ptr c = _arb_vec_init(2);
  int s = SS_OK;
  for (int i = 0; i < 12 && s == SS_OK; i++) {
    arb_get_mid_arb(r, r);
    s |= family_jet(c, 2, f, value, r);
    arb_sub(c, c, r, f->prec);
    arb_sub_si(slope, c + 1, 1, f->prec);
    arb_div(c, c, slope, f->prec);
    arb_sub(r, r, c, f->prec);
    arb_get_mid_arb(r, r);
  }
  arb_set(slope, c + 1);
  _arb_vec_clear(c, 2);
  return s;
}

/* A ball of the given radius around r that holds, for every value in the ball, exactly one fixed point: interval Newton. */
static bool family_enclose(arb_t r, const struct family *f, const arb_t value, slong log_radius) {
  arb_ptr c = _arb_vec_init(4), mid = c + 2, next = c + 3;
  mag_set_ui_2exp_si(arb_radref(r), 1, log_radius);
  arb_get_mid_arb(mid, r);
  bool ok = family_jet(c, 2, f, value, r) == SS_OK;
  arb_sub_si(c + 1, c + 1, 1, f->prec);
  ok = ok && !arb_contains_zero(c + 1) && family_jet(c, 1, f, value, mid) == SS_OK;
  arb_sub(c, c, mid, f->prec);
  arb_div(c, c, c + 1, f->prec);
  arb_sub(next, mid, c, f->prec);
  ok = ok && arb_contains_interior(r, next);
  if (ok) arb_set(r, next);
  _arb_vec_clear(c, 4);
  return ok;
}

struct equality {
  arb_t value, r, slope[2], third; /* the parameter's interval; slopes at its ends; a^2 + b */
  bool proved;                     /* the slope passes -1 inside the interval */
};

/* The value at which the slope is -1, by the secant method from two values. */
static bool family_find(struct equality *q, struct family *f, const fmpq_t from, const fmpq_t to) {
  arb_ptr x = _arb_vec_init(5);
  arb_ptr slope = x + 2, step = x + 4;
  bool ok = true;
  arb_set_fmpq(x, from, f->prec);
  arb_set_fmpq(x + 1, to, f->prec);
  ok = family_orbit(q->r, slope, f, x) == SS_OK;
  for (int i = 0; ok && i < 24; i++) {
    ok = family_orbit(q->r, slope + 1, f, x + 1) == SS_OK;
    arb_sub(step, x + 1, x, f->prec);
    arb_sub(x, slope + 1, slope, f->prec);
    if (!ok || arb_contains_zero(x)) break;
    arb_div(step, step, x, f->prec);
    arb_add_si(x, slope + 1, 1, f->prec);
    arb_mul(step, step, x, f->prec);
    arb_set(x, x + 1);
    arb_set(slope, slope + 1);
    arb_sub(x + 1, x + 1, step, f->prec);
    arb_get_mid_arb(x + 1, x + 1);
    if (arf_cmpabs_2exp_si(arb_midref(step), -120) < 0) break;
  }
  arb_set(q->value, x + 1);
  _arb_vec_clear(x, 5);
  return ok;
}

/* Between two values 2^-60 apart the slope passes -1; there R(r_0 + s) = r_0 + c_1 s + c_2 s^2 + c_3 s^3 + ... and, at
   c_1 = -1, R(R(r_0 + s)) = r_0 + s - 2 (c_2^2 + c_3) s^3 + ...: stable when c_2^2 + c_3 > 0, unstable when it is < 0. */
static bool family_prove(struct equality *q, const struct family *f) {
  arb_ptr c = _arb_vec_init(6);
  arb_ptr end = c + 4, at = c + 5;
  bool ok = true;
  for (int i = 0; ok && i < 2; i++) {
    arb_set_si(end, i ? 1 : -1);
    arb_mul_2exp_si(end, end, -60);
    arb_add(end, end, q->value, f->prec);
    arb_set(at, q->r);
    ok = family_orbit(at, q->slope[i], f, end) == SS_OK && family_enclose(at, f, end, -100) &&
         family_jet(c, 2, f, end, at) == SS_OK;
    arb_add_si(q->slope[i], c + 1, 1, f->prec);
  }
  bool passes = ok && ((arb_is_positive(q->slope[0]) && arb_is_negative(q->slope[1])) ||
                       (arb_is_negative(q->slope[0]) && arb_is_positive(q->slope[1])));
  mag_set_ui_2exp_si(arb_radref(q->value), 1, -60);
  ok = ok && family_enclose(q->r, f, q->value, -40) && family_jet(c, 4, f, q->value, q->r) == SS_OK;
  arb_mul(q->third, c + 2, c + 2, f->prec);
  arb_add(q->third, q->third, c + 3, f->prec);
  q->proved = ok && passes;
  _arb_vec_clear(c, 6);
  return ok;
}

/* "e2 from 3/4 to 1" */
static bool read_family(struct family *f, fmpq_t from, fmpq_t to, struct behaviour *b) {
  static const struct {
    const char *name;
    int p;
  } names[] = {{"chi", P_CHI}, {"eta", P_ETA}, {"V", P_V}, {"e1", P_E1}, {"e2", P_E2}};
  const char *vary = claim_get(b->c, "vary");
  char name[8] = "", low[32] = "", high[32] = "";
  bool ok = vary && sscanf(vary, "%7s from %31s to %31s", name, low, high) == 3 && fmpq_set_str(from, low, 10) == 0 &&
            fmpq_set_str(to, high, 10) == 0;
  f->vary = -1;
  for (size_t i = 0; ok && i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i].name, name) == 0) f->vary = names[i].p;
  return (ok && f->vary >= 0) ||
         claim_error(b->j, b->c, "vary", "a parameter and two values, as in \"e2 from 3/4 to 1\"");
}

/* The orbit nearest to slope -1 at the first value: admissible, and its times to start from. */
static const struct dyn_orbit *family_start(struct family *f, struct behaviour *b) {
  const struct dyn_orbits *list = orbit_cache_get(b->j->cache, f->base->q, FD_PREC + 64);
  const struct dyn_orbit *best = NULL;
  double least = 0.25;
  for (slong i = 0; i < list->n; i++) {
    double off = fabs(arf_get_d(arb_midref(list->orbit[i].trace), ARF_RND_NEAR) + 1);
    if (list->orbit[i].admissible != TRUTH_TRUE || off >= least) continue;
    best = &list->orbit[i];
    least = off;
  }
  for (int i = 0; best && i < 4; i++) f->times[i] = i == 0 ? 0 : best->guess[i];
  return best;
}

/* Does the return map come back at the value, slowly, from both sides of the fixed point, and from how far? */
static enum says slow_return(const struct equality *q, const struct family *f, long *trials) {
  enum { STEPS = 20000 };
  double params[N_PARAMS], r0 = arf_get_d(arb_midref(q->r), ARF_RND_NEAR);
  enum says says = SAYS_NOTHING;
  for (int i = 0; i < N_PARAMS; i++) params[i] = fmpq_get_d(&f->base->q[i]);
  params[f->vary] = arf_get_d(arb_midref(q->value), ARF_RND_NEAR);
  for (int side = -1; side <= 1; side += 2) {
    double start = side * 0.05 * fabs(r0), r = r0 + start, t[4];
    bool ok = true;
    for (int i = 0; ok && i < STEPS; i++) {
      ok = dyn_return_map_d(&r, NULL, t, params, r, &dyn_limits_default) == SS_OK;
      if (fabs(r - r0) < 0.5 * fabs(start) && i % 2) break;
      ok = ok && fabs(r - r0) < 2 * fabs(start);
    }
    ++*trials;
    enum says one = !ok ? SAYS_AGREES : fabs(r - r0) < 0.5 * fabs(start) ? SAYS_DIFFERS : SAYS_UNDECIDED;
    says = says == SAYS_NOTHING || says == one ? one : SAYS_UNDECIDED;
  }
  return says;
}

static void equality_words(struct behaviour *b, struct family *f, struct equality *q) {
  struct route_word w[2];
  long trials = 0;
  bool stable = q->proved && arb_is_positive(q->third), unstable = q->proved && arb_is_negative(q->third);
  static const char *const names[] = {"chi", "eta", "V", "e1", "e2"};
  struct text at;
  text_init(&at);
  for (int i = 0; i < N_PARAMS; i++) {
    text_printf(&at, "%s%s = ", i ? ", " : "", names[i]);
    if (i == f->vary)
      text_add(&at, ball_text(b->j, q->value, 15));
    else
      num_print_q(&at, &f->base->q[i]);
  }
  const char *note = result_str(
      b->j->out,
      "tr J passes -1 in an interval of width 2^-59 there (proved in balls at its ends); over the whole of it "
      "the return map R(r_0 + s) = r_0 - s + c_2 s^2 + c_3 s^3 + ... has c_2^2 + c_3 = %s, so that "
      "R(R(r_0 + s)) = r_0 + s - 2 (c_2^2 + c_3) s^3 + ...: the orbit with |tr J| = 1 is %s",
      ball_text(b->j, q->third, 6),
      stable     ? "stable"
      : unstable ? "unstable"
                 : "not decided by the third order");
  w[0] = behaviour_say(b, "balls", "model",
                       stable     ? SAYS_DIFFERS
                       : unstable ? SAYS_AGREES
                                  : SAYS_UNDECIDED,
                       true, q->proved, result_str(b->j->out, "%s", text_str(&at)), note);
  enum says slow = slow_return(q, f, &trials);
  w[1] = behaviour_say(b, "iteration", "model", slow, false, trials, NULL,
                       "the return map in double at that parameter, from 5% of r_0 on either side");
  b->f->verdict = verdict_of(w, 2, false);
  if (b->f->verdict == VERDICT_REFUTED)
    b->f->effect = "only at |tr J| = 1 exactly, which linearization does not decide; \"otherwise\" should read "
                   "\"if |tr(J)| > 1\"";
  text_clear(&at);
}

bool behaviour_equality(struct behaviour *b) {
  struct point base;
  struct family f = {.base = &base, .prec = 256};
  struct equality q;
  fmpq_t from, to;
  arb_ptr all[] = {q.value, q.r, q.slope[0], q.slope[1], q.third};
  point_init(&base);
  fmpq_init(from);
  fmpq_init(to);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_init(all[i]);
  q.proved = false;
  bool ok = behaviour_params(&base, b) && read_family(&f, from, to, b);
  if (ok) {
    fmpq_set(&base.q[f.vary], from);
    const struct dyn_orbit *o = family_start(&f, b);
    if (o) arb_sub(q.r, o->z20, o->z10, f.prec);
    if (o && family_find(&q, &f, from, to) && family_prove(&q, &f))
      equality_words(b, &f, &q);
    else
      b->f->condition = "no orbit with tr J = -1 was enclosed between the two values";
  }
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  fmpq_clear(to);
  fmpq_clear(from);
  point_clear(&base);
  return ok;
}
