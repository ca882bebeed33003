/* "Otherwise, the periodic solution is unstable", where |tr J| = 1: the slope of the return map is followed along a family of
   orbits to -1, and the third order decides what linearization leaves open. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "behaviour.h"

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
  arb_t value, r, slope[2], third; /* the parameter's interval; slopes at its ends, plus 1; c_2^2 + c_3 */
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

/* The orbit at the middle of the interval, an exact rational that p receives; NULL unless it is admissible. */
static const struct dyn_orbit *middle_orbit(struct point *p, const struct equality *q, const struct family *f,
                                            struct behaviour *b) {
  mpfr_t x;
  mpq_t exact;
  mpfr_init2(x, f->prec + 64);
  mpq_init(exact);
  arf_get_mpfr(x, arb_midref(q->value), MPFR_RNDN);
  mpfr_get_q(exact, x);
  for (int i = 0; i < N_PARAMS; i++) fmpq_set(&p->q[i], &f->base->q[i]);
  fmpq_set_mpq(&p->q[f->vary], exact);
  mpq_clear(exact);
  mpfr_clear(x);
  const struct dyn_orbits *list = orbit_cache_get(b->j->cache, p->q, FD_PREC + 64);
  double r = num_arb.get_d(q->r);
  for (slong i = 0; i < list->n; i++)
    if (list->orbit[i].admissible == TRUTH_TRUE && fabs(orbit_r(&list->orbit[i]) - r) < 1e-9 * fabs(r))
      return &list->orbit[i];
  return NULL;
}

/* "e2 from 3/4 to 1" */
static bool read_family(struct family *f, fmpq_t from, fmpq_t to, struct behaviour *b, const char *vary) {
  static const struct {
    const char *name;
    int p;
  } names[] = {{"chi", P_CHI}, {"eta", P_ETA}, {"V", P_V}, {"e1", P_E1}, {"e2", P_E2}};
  char name[8] = "", low[32] = "", high[32] = "";
  struct diag d;
  diag_init(&d);
  bool ok = sscanf(vary, " %7s from %31s to %31[^; ]", name, low, high) == 3 &&
            scene_constant(from, low, strlen(low), "vary", &d) && scene_constant(to, high, strlen(high), "vary", &d);
  f->vary = -1;
  for (size_t i = 0; ok && i < sizeof names / sizeof *names; i++)
    if (strcmp(names[i].name, name) == 0) f->vary = names[i].p;
  ok = ok && f->vary >= 0 && fmpq_sgn(from) > 0 && fmpq_sgn(to) > 0;
  if (ok && f->vary == P_CHI) ok = fmpq_cmp_si(from, 1) < 0 && fmpq_cmp_si(to, 1) < 0;
  return ok || claim_error(b->j, b->c, "vary", "a parameter and two values in its domain, as in \"e2 from 3/4 to 1\"");
}

/* The admissible orbit whose slope is nearest to -1 at the first value; its times are where later ones are looked for. */
static const struct dyn_orbit *family_start(struct family *f, struct behaviour *b) {
  const struct dyn_orbits *list = orbit_cache_get(b->j->cache, f->base->q, FD_PREC + 64);
  const struct dyn_orbit *best = NULL;
  double least = 0.25;
  for (slong i = 0; i < list->n; i++) {
    double off = fabs(num_arb.get_d(list->orbit[i].trace) + 1);
    if (list->orbit[i].admissible != TRUTH_TRUE || off >= least) continue;
    best = &list->orbit[i];
    least = off;
  }
  for (int i = 0; best && i < 4; i++) f->times[i] = i == 0 ? 0 : best->guess[i];
  return best;
}

/* What is found along all families: by the third order, by iterates at the value, by motions under Coulomb's law. */
struct found {
  long stable, unstable, open;
  long back, away, unsure;
  long moved_back, moved_away, moved_unsure;
  const char *where;
};

/* Iterates approach or leave like 1/sqrt(n), so many steps are allowed; from 3% of r_0 on either side. */
static void iterate(struct found *t, const struct equality *q, const struct point *at) {
  enum { STEPS = 100000 };
  double params[N_PARAMS], r0 = num_arb.get_d(q->r);
  for (int i = 0; i < N_PARAMS; i++) params[i] = fmpq_get_d(&at->q[i]);
  for (int side = -1; side <= 1; side += 2) {
    int fate = return_map_fate(params, r0, side * 0.03 * fabs(r0), STEPS);
    *(fate > 0 ? &t->back : fate < 0 ? &t->away : &t->unsure) += 1;
  }
}

/* 200 returns of the motion from x_2 moved by 1% of r_0: nearer than it began, or farther?  The change is small, the error
   of the integration 1e-9. */
static void move(struct found *t, const struct point *at, const struct dyn_orbit *o) {
  struct motion m;
  struct coulomb_plan plan = coulomb_plan_default;
  if (!motion_on_orbit(&m, at, o, OWN_FRICTION)) return;
  double r0 = num_arb.get_d(o->z20) - num_arb.get_d(o->z10);
  double x0 = m.start[Z_2] - m.start[Z_1], offset = 0.01 * fabs(r0);
  m.start[Z_2] += offset;
  plan.returns = 200;
  plan.max_events = 64 * plan.returns;
  struct told told = motion_tell(BY_INTEGRATION, &m, &plan);
  double ratio = fabs(told.result.at.x[1] - told.result.at.x[0] - x0) / offset;
  bool ok = told.status == SS_OK;
  *(ok && ratio < 1 - 1e-4 ? &t->moved_back : ok && ratio > 1 + 1e-4 ? &t->moved_away : &t->moved_unsure) += 1;
  told_clear(&told);
}

static void add_family(struct found *t, struct behaviour *b, const struct family *f, const struct equality *q) {
  static const char *const names[N_PARAMS] = {"chi", "eta", "V", "e1", "e2"};
  struct point at;
  struct text where;
  point_init(&at);
  text_init(&where);
  const struct dyn_orbit *o = middle_orbit(&at, q, f, b);
  bool decided = q->proved && o, stable = decided && arb_is_positive(q->third);
  bool unstable = decided && arb_is_negative(q->third);
  for (int i = 0; i < N_PARAMS; i++) {
    text_printf(&where, "%s%s = ", i ? ", " : "", names[i]);
    if (i == f->vary)
      text_add(&where, ball_text(b->j, q->value, 15));
    else
      num_print_q(&where, &f->base->q[i]);
  }
  const char *place = result_str(b->j->out, "%s", text_str(&where));
  ++*(stable ? &t->stable : unstable ? &t->unstable : &t->open);
  if (stable && !t->where) t->where = place;
  finding_state(
      b->f, b->j->out, "balls", "model", f->prec, 1, place,
      result_str(b->j->out,
                 "tr J passes -1 inside an interval of width 2^-59 there%s, and over the whole of it c_2^2 + c_3 = "
                 "%s: the orbit with |tr J| = 1 is %s; it is %s",
                 q->proved ? " (proved in balls at its ends)" : " (not proved)", ball_text(b->j, q->third, 6),
                 stable     ? "stable"
                 : unstable ? "unstable"
                            : "not decided",
                 o ? "admissible" : "not known to be admissible"));
  if (o) iterate(t, q, &at);
  if (o) move(t, &at, o);
  text_clear(&where);
  point_clear(&at);
}

static bool try_family(struct found *t, struct behaviour *b, const char *params, const char *vary) {
  struct point base;
  struct family f = {.base = &base, .prec = 256};
  struct equality q = {.proved = false};
  fmpq_t from, to;
  arb_ptr all[] = {q.value, q.r, q.slope[0], q.slope[1], q.third};
  point_init(&base);
  fmpq_init(from);
  fmpq_init(to);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_init(all[i]);
  bool ok = behaviour_params(&base, b, params) && read_family(&f, from, to, b, vary);
  if (ok) {
    fmpq_set(&base.q[f.vary], from);
    const struct dyn_orbit *o = family_start(&f, b);
    if (o) arb_sub(q.r, o->z20, o->z10, f.prec);
    if (o && family_find(&q, &f, from, to) && family_prove(&q, &f))
      add_family(t, b, &f, &q);
    else
      t->open++;
  }
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_clear(all[i]);
  fmpq_clear(to);
  fmpq_clear(from);
  point_clear(&base);
  return ok;
}

/* One orbit that is stable refutes; no number of unstable ones proves. */
static enum says says_of(long stable, long unstable, long open) {
  return stable ? SAYS_DIFFERS : open ? SAYS_UNDECIDED : unstable ? SAYS_AGREES : SAYS_NOTHING;
}

static void conclude(struct behaviour *b, const struct found *t) {
  struct route_word w[3];
  w[0] = behaviour_say(
      b, "balls", "model", says_of(t->stable, t->unstable, t->open), true, t->stable + t->unstable + t->open, t->where,
      result_str(
          b->j->out,
          "at tr J = -1 the return map R(r_0 + s) = r_0 - s + c_2 s^2 + c_3 s^3 + ... has R(R(r_0 + s)) = r_0 + s - "
          "2 (c_2^2 + c_3) s^3 + ..., so that the orbit is stable when c_2^2 + c_3 > 0: %ld stable%s%s, %ld "
          "unstable, %ld open",
          t->stable, t->stable ? ", at (its parameter rounded) " : "", t->stable ? t->where : "", t->unstable,
          t->open));
  w[1] = behaviour_say(b, "iteration", "model", says_of(t->back, t->away, t->unsure), false,
                       t->back + t->away + t->unsure, NULL,
                       result_str(b->j->out,
                                  "the return map in double there, whatever else the motion does, from 3%% of r_0 on "
                                  "either side: %ld come back to "
                                  "half of it, %ld leave to twice as far",
                                  t->back, t->away));
  w[2] =
      behaviour_say(b, "integration", "model", says_of(t->moved_back, t->moved_away, t->moved_unsure), false,
                    t->moved_back + t->moved_away + t->moved_unsure, NULL,
                    result_str(b->j->out,
                               "motions under Coulomb's law from x_2 moved by 1%% of r_0, over 200 returns: %ld come "
                               "nearer, %ld go farther",
                               t->moved_back, t->moved_away));
  b->f->verdict = verdict_of(w, 3, false);
  if (b->f->verdict == VERDICT_REFUTED)
    b->f->effect = "only at |tr J| = 1 exactly, which linearization does not decide: \"Otherwise\" should read "
                   "\"If |tr(J)| > 1\"";
}

/* "at" and "vary" hold one entry for each family, separated by semicolons. */
bool behaviour_equality(struct behaviour *b) {
  const char *params = claim_get(b->c, "at"), *vary = claim_get(b->c, "vary");
  struct found t = {.where = NULL};
  bool ok = params && vary;
  if (!ok) return claim_error(b->j, b->c, "at", "a family needs its parameters (at) and the one that is varied (vary)");
  while (ok && params && vary) {
    ok = try_family(&t, b, params, vary);
    params = strchr(params, ';');
    vary = strchr(vary, ';');
    if (!params != !vary) return claim_error(b->j, b->c, "vary", "as many entries as in \"at\" are needed");
    if (params) params++;
    if (vary) vary++;
  }
  if (ok) conclude(b, &t);
  return ok;
}
