/* Orbits from any two given quantities, their margins, and the paper's own route to them.

   The orbits and their force bounds come from tests/oracle/orbits.tsv (mpmath, matrix exponentials, 60 digits).  Every
   orbit that a search adds to the one that was asked for must close under matrix exponentials and start no event too
   early.  Margins are held against the motion itself, stepped by a second model (plain.h): no sample may lie below a
   margin, and the motion must attain it at the stated time. */
#include "accuracy.h"
#include "explore/family.h"
#include "known_orbits.h"
#include "motion/given.h"
#include "motion/margins.h"
#include "motion/paper_route.h"
#include "params.h"
#include "plain.h"
#include "rational.h"
#include "test.h"

/* --- The independent data. --- */

/* An orbit of the file with its numbers. */
struct sample {
  const char *name, *violations;
  int index;
  const fmpq *params;
  fmpq *z, *x, *trace, *u; /* one behind the other in memory; x by enum dyn_quantity */
};
enum { IN_SAMPLE = 2 + N_QUANTITIES + 1 + 2 };

static struct sample sample_of(struct known_orbit o) {
  const char *text[IN_SAMPLE];
  int n = 0;
  for (int i = 0; i < 2; i++) text[n++] = o.field[KNOWN_Z10 + i];
  for (int i = 0; i < 2; i++) text[n++] = o.set->text[P_E1 + i];
  for (int ph = 0; ph < N_PHASES; ph++) text[n++] = o.field[KNOWN_TA + ph];
  text[n++] = o.field[KNOWN_TRACE];
  for (int i = 0; i < 2; i++) text[n++] = o.field[KNOWN_U1 + i];
  fmpq *q = rationals(text, IN_SAMPLE), *trace = q + 2 + N_QUANTITIES;
  return (struct sample){.name = o.set->name,
                         .violations = o.field[KNOWN_VIOLATIONS],
                         .index = atoi(o.field[KNOWN_INDEX]),
                         .params = o.set->params,
                         .z = q,
                         .x = q + 2,
                         .trace = trace,
                         .u = trace + 1};
}

static void sample_clear(struct sample *s) {
  _fmpq_vec_clear(s->z, IN_SAMPLE);
}

/* |x - q| relative to |q| + scale. */
static double off(const arb_t x, const fmpq *q, double scale) {
  NUMBERS(arb, d);
  arb_set_fmpq(d, q, 400);
  double size = fabs(num_arb.get_d(d)) + scale;
  arb_sub(d, x, d, 400);
  NUMBERS(mag, m);
  arb_get_mag(m, d);
  return mag_get_d(m) / size;
}

/* --- Orbits from two given quantities. --- */

/* Orbits of many kinds whose phases Gamma and H last less than 12. */
static const struct {
  const char *name;
  int index;
} chosen[] = {{"paper", 0},      {"paper", 1},        {"fractions", 0},   {"stable", 0},
              {"beyond-pi", 1},  {"beyond-tstar", 0}, {"four", 3},        {"chi-small", 0},
              {"eta-small2", 0}, {"eta-large", 0},    {"negative-ta", 1}, {"steep", 0}};
static const struct dyn_limits near_limits = {12, 100000};

/* The six equations in balls by matrix exponentials, and first events in double precision. */
static void check_orbit(const struct sample *s, const struct dyn_orbit *o, slong prec, const char *pair) {
  OWNED(num_vec) p = vec_new(N_PARAMS, num_ctx_arb(prec));
  double pd[N_PARAMS], start[N_PHASES][N_STATE], t;
  bool grazing;
  const char *what = formatted("%s %d %s", s->name, s->index, pair);
  for (int i = 0; i < 3; i++) arb_set_fmpq(num_vec_at(&p, i), s->params + i, prec);
  arb_set(num_vec_at(&p, P_E1), o->e1);
  arb_set(num_vec_at(&p, P_E2), o->e2);
  for (int i = 0; i < N_PARAMS; i++) pd[i] = mid(num_vec_at(&p, i));
  ck_assert(pd[P_E1] > 0 && pd[P_E2] > 0);
  check_six_equations(start, o, &p, what);
  for (int ph = 0; ph < N_PHASES; ph++) {
    ck_assert_int_eq(first_event_d(&t, &grazing, (enum phase)ph, pd, start[ph], NULL), SS_OK);
    double want = mid(o->t[ph]);
    ck_assert_msg(fabs(t - want) < 1e-5 * (1 + fabs(want)), "%s: phase %d ends at %.12g, not %.12g", what, ph, t, want);
  }
}

/* Whether o is the orbit of the file. */
static bool is_sample(const struct dyn_orbit *o, const struct sample *s) {
  double reach = fabs(fmpq_get_d(s->z)) + fabs(fmpq_get_d(s->z + 1)), worst = 0;
  const arb_struct *x[N_QUANTITIES] = {o->e1, o->e2, o->t[0], o->t[1], o->t[2], o->t[3]};
  for (int i = 0; i < N_QUANTITIES; i++) worst = fmax(worst, off(x[i], s->x + i, 1));
  worst = fmax(worst, fmax(off(o->z10, s->z, reach), off(o->z20, s->z + 1, reach)));
  return worst < 1e-25;
}

TEST_EACH(every_pair_finds_the_orbit_again, COUNT(chosen)) {
  OWNED(sample) s = sample_of(known_orbit_named(chosen[_i].name, chosen[_i].index));
  for (int i = 0; i < N_QUANTITIES; i++)
    for (int k = i + 1; k < N_QUANTITIES; k++) {
      enum dyn_quantity which[2] = {(enum dyn_quantity)k, (enum dyn_quantity)i};
      const fmpq value[2] = {s.x[k], s.x[i]};
      OWNED(dyn_orbits) list;
      const char *pair = formatted("%s, %s", dyn_quantity_id[i], dyn_quantity_id[k]);
      ck_assert_msg(dyn_orbits_given(&list, s.params, which, value, 120, &near_limits) == SS_OK, "%s %d %s", s.name,
                    s.index, pair);
      int hits = 0;
      for (slong n = 0; n < list.n; n++) {
        const struct dyn_orbit *o = &list.orbit[n];
        check_orbit(&s, o, 200, pair);
        ck_assert(n == 0 || arf_cmp(arb_midref(o[-1].z10), arb_midref(o->z10)) <= 0);
        const arb_struct *x[N_QUANTITIES] = {o->e1, o->e2, o->t[0], o->t[1], o->t[2], o->t[3]};
        ck_assert_msg(arb_contains_fmpq(x[i], s.x + i) && arb_contains_fmpq(x[k], s.x + k), "%s %d %s: not as given",
                      s.name, s.index, pair);
        if (!is_sample(o, &s)) continue;
        hits++;
        ck_assert_msg(off(o->trace, s.trace, 1) < 1e-18 && off(o->u_r1_min, s.u, 1) < 1e-20, "%s %d %s", s.name,
                      s.index, pair);
        ck_assert_int_eq(o->admissible == TRUTH_TRUE, strcmp(s.violations, "-") == 0);
        ck_assert(arb_rel_accuracy_bits(o->z10) >= 120);
      }
      ck_assert_msg(hits == 1, "%s %d %s: found %d times among %ld", s.name, s.index, pair, hits, (long)list.n);
    }
}

TEST(given_times_fix_the_limits_to_any_precision) {
  OWNED(sample) s = sample_of(known_orbit_named("paper", 1));
  const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  const fmpq value[2] = {s.x[QUANTITY_TB], s.x[QUANTITY_TC]};
  OWNED(dyn_orbits) list;
  ck_assert_int_eq(dyn_orbits_given(&list, s.params, which, value, 3400, NULL), SS_OK);
  ck_assert_int_eq(list.n, 1);
  ck_assert(arb_rel_accuracy_bits(list.orbit[0].e1) >= 3400 && arb_rel_accuracy_bits(list.orbit[0].z20) >= 3400);
  check_orbit(&s, &list.orbit[0], 3500, "t_b, t_c");
}

/* The orbit beside its flip loses some forty-six bits in |tr J| - 1: more than the guard holds.  With e1 and e2 as
   data, and with t_b and t_c too, that costs a second attempt below the pilot's threshold and none above it; either
   way the digits are there, and they agree. */
TEST_EACH(the_first_precision_is_planned, 2) {
  static const slong prec[] = {256, 1500};
  static const char *const data[N_PARAMS] = {"0.8", "1", "1", "2.7844", "1.8110582"};
  static const enum dyn_quantity which[2] = {QUANTITY_TB, QUANTITY_TC};
  struct dyn_orbits list[2];
  FREED_PARAMS fmpq *params = rationals(data, N_PARAMS);
  RATIONALS(value, 2, _fmpq_vec_init(2));
  OWNED(dyn_orbits) near = orbits_of(params, 128);
  slong flip = 0;
  for (slong i = 0; i < near.n; i++)
    if (arf_cmpabs(arb_midref(near.orbit[i].margin), arb_midref(near.orbit[flip].margin)) < 0) flip = i;
  for (int k = 0; k < 2; k++) num_q_set_d(value + k, near.orbit[flip].guess[1 + k]);
  for (int k = 0; k < 2; k++) {
    ck_assert_int_eq(_i ? dyn_orbits_given(&list[k], params, which, value, prec[k], NULL)
                        : dyn_orbits_find(&list[k], params, prec[k], NULL),
                     SS_OK);
    ck_assert(_i ? list[k].n > 0 : list[k].n == 2);
    for (slong i = 0; i < list[k].n; i++) ck_assert(arb_rel_accuracy_bits(list[k].orbit[i].margin) >= prec[k]);
  }
  ck_assert_int_eq(list[0].n, list[1].n);
  ck_assert_msg((_i ? list[0].raises >= 1 : list[0].raises == 1) && list[0].bits == 256 + 40, "%ld %ld", list[0].raises,
                (long)list[0].bits);
  ck_assert_msg(list[1].raises == 0 && list[1].bits > 1500 + 40 && list[1].bits < 1500 + 80, "%ld %ld", list[1].raises,
                (long)list[1].bits);
  for (slong i = 0; i < list[0].n; i++) {
    ck_assert(arb_overlaps(list[0].orbit[i].margin, list[1].orbit[i].margin));
    ck_assert(arb_overlaps(list[0].orbit[i].z10, list[1].orbit[i].z10));
  }
  for (int k = 0; k < 2; k++) dyn_orbits_clear(&list[k]);
}

TEST(no_stick_phase_is_solution_ii) {
  /* t_a = 0 is the paper's own special case: an orbit of it is one of the word without D, and t_a > 0 fails exactly. */
  OWNED(sample) s = sample_of(known_orbit_named("negative-ta2", 1));
  const enum dyn_quantity which[2] = {QUANTITY_E1, QUANTITY_TA};
  RATIONALS(value, 2, _fmpq_vec_init(2));
  OWNED(dyn_orbits) list;
  fmpq_set(value, s.x + QUANTITY_E1);
  ck_assert_int_eq(dyn_orbits_given(&list, s.params, which, value, 100, &near_limits), SS_OK);
  ck_assert_int_gt(list.n, 0);
  for (slong n = 0; n < list.n; n++) {
    const struct dyn_orbit *o = &list.orbit[n];
    ck_assert(arb_is_zero(o->t[0]) && o->holds[COND_TA] == TRUTH_FALSE && o->admissible == TRUTH_FALSE);
    check_orbit(&s, o, 200, "e1, t_a");
  }
}

TEST(impossible_values_are_told) {
  OWNED(sample) s = sample_of(known_orbit_named("paper", 1));
  struct dyn_orbits list;
  RATIONALS(value, 2, rationals((const char *const[]){"2", "4"}, 2));
  RATIONALS(model, 3, rationals_of(s.params, 3));
  enum dyn_quantity twice[2] = {QUANTITY_TB, QUANTITY_TB}, times[2] = {QUANTITY_TB, QUANTITY_TD};
  /* pi/sqrt(chi eta) = 3.51 */
  ck_assert_int_eq(dyn_orbits_given(&list, model, twice, value, 60, NULL), SS_DOMAIN);
  ck_assert(dyn_orbits_given(&list, model, times, value, 60, &near_limits) == SS_OK && list.n == 0);
  dyn_orbits_clear(&list);
  fmpq_zero(value + 1);
  ck_assert_int_eq(dyn_orbits_given(&list, model, times, value, 60, NULL), SS_DOMAIN);
  fmpq_set_si(value + 1, 2, 1);
  fmpq_set_si(model, 1, 1);
  ck_assert_int_eq(dyn_orbits_given(&list, model, times, value, 60, NULL), SS_DOMAIN);
}

/* --- Margins. --- */

/* The orbit of the file among those found at its parameters; the list is to be cleared. */
static const struct dyn_orbit *orbit_of(struct dyn_orbits *list, const struct sample *s) {
  ck_assert_int_eq(dyn_orbits_find(list, s->params, 160, NULL), SS_OK);
  for (slong i = 0; i < list->n; i++)
    if (is_sample(&list->orbit[i], s)) return &list->orbit[i];
  ck_abort_msg("%s %d is not found", s->name, s->index);
}

static struct plain plain_at(const fmpq *params) {
  return (struct plain){real_of(params + P_CHI), real_of(params + P_ETA), real_of(params + P_V), real_of(params + P_E1),
                        real_of(params + P_E2)};
}

/* Right side minus left side of inequality k at the state z; the lower bounds at the given u. */
static real margin_at(int k, const struct plain *p, const double u[2], const real z[N_STATE]) {
  real w = z[Z_1] - p->chi * z[Z_2], pull = p->chi * (z[Z_2] - z[Z_1]);
  switch (k) {
  case COND_GAMMA_V1:
  case COND_H_V1:
    return p->v - z[DZ_1];
  case COND_H_V2:
  case COND_C_V2:
    return p->v - z[DZ_2];
  case COND_C_W:
  case MARGIN_D_W:
    return p->e1 - w;
  case COND_D_R:
  case COND_GAMMA_R:
    return p->e2 - pull;
  case MARGIN_D_W_LOW:
  case MARGIN_C_W_LOW:
    return w - (p->e1 - 2 * u[0]);
  default:
    return pull - (p->e2 - 2 * u[1]);
  }
}

/* One phase from z: nothing lies below a margin, and each margin is attained. */
static void check_phase(const struct sample *s, const struct dyn_margins *m, enum phase ph, const struct plain *p,
                        const double u[2], const real z[N_STATE], double t, double begin) {
  enum { STEPS = 300 };
  double scale = (double)(p->v + p->e1 + p->e2) + fabs(u[0]) + fabs(u[1]);
  real at[N_STATE], phi[N_STATE * N_STATE];
  for (int k = 1; k < N_MARGINS; k++) {
    const struct dyn_margin *x = &m->at[k];
    if (x->phase != ph) continue;
    plain_flow(at, p, (int)ph, z, mid(x->time) - begin);
    double value = mid(x->margin), there = (double)margin_at(k, p, u, at);
    ck_assert_msg(fabs(value - there) < 1e-8 * scale, "%s %d %s: %.12g, but %.12g at the stated time %.6g", s->name,
                  s->index, x->id, value, there, mid(x->time));
  }
  plain_propagator(phi, p, (int)ph, t / STEPS);
  memcpy(at, z, sizeof at);
  for (int step = 0; step <= STEPS; step++) {
    for (int k = 1; k < N_MARGINS; k++) {
      const struct dyn_margin *x = &m->at[k];
      if (x->phase != ph) continue;
      double there = (double)margin_at(k, p, u, at), value = mid(x->margin);
      ck_assert_msg(there > value - 1e-8 * scale, "%s %d %s: %.12g, but %.12g at step %d", s->name, s->index, x->id,
                    value, there, step);
    }
    plain_product(at, phi, at, 4, 4, 1);
  }
}

/* A margin that is zero by definition: its derivative into the phase against the motion just inside. */
static void check_edge(const struct sample *s, const struct dyn_margin *x, const struct plain *p, const double u[2],
                       const real z[N_STATE], double t, int k) {
  real at[N_STATE], h = 1e-6 * fabs(t);
  if (!x->by_definition) return;
  ck_assert(arb_is_zero(x->margin) && x->order == 1 && (x->where == WHERE_START || x->where == WHERE_END));
  plain_flow(at, p, (int)x->phase, z, x->where == WHERE_START ? h : t - h);
  double rate = (double)(margin_at(k, p, u, at) / h), want = mid(x->rate);
  ck_assert_msg(fabs(rate - want) < 1e-3 * (1 + fabs(want)) * (1 + fabs(t)), "%s %d %s: %g, stated %g", s->name,
                s->index, x->id, rate, want);
}

static bool violated(const struct sample *s, const char *id) {
  size_t len = strlen(id);
  for (const char *p = s->violations; p; p = strchr(p, ',') ? strchr(p, ',') + 1 : NULL)
    if (strncmp(p, id, len) == 0 && (p[len] == ',' || p[len] == '\0')) return true;
  return false;
}

TEST_EACH(margins_are_those_of_the_motion, KNOWN_ORBITS) {
  OWNED(sample) s = sample_of(known_orbit(_i));
  OWNED(dyn_orbits) list;
  LOCAL(dyn_margins, m);
  const struct dyn_orbit *o = orbit_of(&list, &s);
  const double u[2] = {0.75, 1.5};
  const struct plain p = plain_at(s.params);
  real z[N_STATE] = {mid(o->z10), mid(o->z20), p.v, p.v};
  RATIONALS(force, 2, rationals((const char *const[]){"0.75", "1.5"}, 2));
  ck_assert_int_eq(dyn_margins_find(&m, s.params, o, force, force + 1, 160), SS_OK);
  double begin = 0;
  ck_assert(arb_equal(m.at[COND_TA].margin, o->t[0]));
  for (int ph = 0; ph < N_PHASES; ph++) {
    check_phase(&s, &m, (enum phase)ph, &p, u, z, o->guess[ph], begin);
    for (int k = 1; k < N_MARGINS; k++)
      if (m.at[k].phase == (enum phase)ph) check_edge(&s, &m.at[k], &p, u, z, o->guess[ph], k);
    plain_flow(z, &p, ph, z, o->guess[ph]);
    begin += o->guess[ph];
  }
  for (int k = 0; k < N_CONDITIONS; k++) {
    ck_assert_str_eq(m.at[k].id, dyn_condition_id[k]);
    ck_assert_msg(m.at[k].holds == (violated(&s, m.at[k].id) ? TRUTH_FALSE : TRUTH_TRUE) &&
                      m.at[k].holds == o->holds[k],
                  "%s %d %s: %d", s.name, s.index, m.at[k].id, m.at[k].holds);
    ck_assert(m.at[k].where != WHERE_OPEN && arb_rel_accuracy_bits(m.at[k].margin) > 100);
  }
  ck_assert_int_eq(m.at[MARGIN_D_W].holds, o->holds[COND_TA]);
}

TEST(a_crest_before_the_event_is_seen) {
  /* With t_b just after the second start of Gamma's motion, r stands below the crest before: not an orbit, but the
     margin must be that of the crest, where r has risen by a (t - sin t) + e1 (1 - cos t), z_1' being V again. */
  OWNED(sample) s = sample_of(known_orbit_named("paper", 1));
  OWNED(dyn_orbits) list;
  LOCAL(dyn_margins, m);
  double chi = fmpq_get_d(s.params + P_CHI), e1 = fmpq_get_d(s.params + P_E1), pi = acos(-1.0), tb = 2 * pi + 0.25;
  double a = (1 - chi) * fmpq_get_d(s.params + P_V), crest = pi + 2 * atan2(a, e1);
  double fall = chi * (a * (tb - sin(tb) - crest + sin(crest)) + e1 * (cos(crest) - cos(tb)));
  orbit_of(&list, &s);
  struct dyn_orbit *o = &list.orbit[1];
  arb_set_d(o->t[PHASE_GAMMA], tb);
  ck_assert_int_eq(dyn_margins_find(&m, s.params, o, NULL, NULL, 160), SS_OK);
  const struct dyn_margin *x = &m.at[COND_GAMMA_R];
  ck_assert_msg(fall < -1 && fabs(mid(x->margin) - fall) < 1e-13 * -fall, "%.17g, not %.17g", mid(x->margin), fall);
  ck_assert(fabs(mid(x->time) - mid(o->t[0]) - crest) < 1e-13 && x->where == WHERE_INSIDE && !x->by_definition);
  ck_assert_int_eq(x->holds, TRUTH_FALSE);
}

TEST_EACH(force_bounds_are_sharp, KNOWN_ORBITS) {
  OWNED(sample) s = sample_of(known_orbit(_i));
  static const int low[2][2] = {{MARGIN_D_W_LOW, MARGIN_C_W_LOW}, {MARGIN_D_R_LOW, MARGIN_GAMMA_R_LOW}};
  OWNED(dyn_orbits) list;
  LOCAL(dyn_margins, m);
  RATIONALS(force, 2, _fmpq_vec_init(2));
  NUMBERS(fmpq, nudge);
  const struct dyn_orbit *o = orbit_of(&list, &s);
  ck_assert_int_eq(dyn_margins_find(&m, s.params, o, NULL, NULL, 160), SS_OK);
  ck_assert_msg(off(m.u_r1_min, s.u, 1e-10) < 1e-30 && off(m.u_r2_min, s.u + 1, 1e-10) < 1e-30, "%s %d", s.name,
                s.index);
  ck_assert(arb_overlaps(m.u_r1_min, o->u_r1_min) && arb_overlaps(m.u_r2_min, o->u_r2_min));
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2; k++) ck_assert(m.at[low[i][k]].holds == TRUTH_UNKNOWN);
  for (int side = -1; side <= 1; side += 2) {
    fmpq_set_si(nudge, side, 1);
    fmpq_div_2exp(nudge, nudge, 100);
    for (int i = 0; i < 2; i++) fmpq_add(force + i, s.u + i, nudge);
    ck_assert_int_eq(dyn_margins_find(&m, s.params, o, force, force + 1, 160), SS_OK);
    for (int i = 0; i < 2; i++) {
      truth both = truth_and(m.at[low[i][0]].holds, m.at[low[i][1]].holds);
      ck_assert_msg(both == (side > 0 ? TRUTH_TRUE : TRUTH_FALSE), "%s %d u_r%d side %d", s.name, s.index, i + 1, side);
    }
  }
}

/* --- The paper's route. --- */

/* The largest error of the solution. */
static double route_error(const struct paper_route *r, const struct sample *s) {
  const fmpq *want[N_ROUTE] = {
      s->x + QUANTITY_TA, s->x + QUANTITY_TB, s->x + QUANTITY_TC, s->x + QUANTITY_TD, s->z, s->z + 1};
  double worst = 0;
  NUMBERS(arb, x);
  for (slong i = 0; i < N_ROUTE; i++) {
    num_mpfr.get_arb(x, num_vec_at(&r->x, i));
    worst = fmax(worst, off(x, want[i], 1));
  }
  return worst;
}

/* Row-sum condition number of a 2x2 matrix. */
static double condition(real a, real b, real c, real d) {
  real norm = fmaxl(fabsl(a) + fabsl(b), fabsl(c) + fabsl(d)),
       inverse = fmaxl(fabsl(d) + fabsl(b), fabsl(c) + fabsl(a));
  return (double)(norm * inverse / fabsl(a * d - b * c));
}

TEST_EACH(the_papers_route_leads_to_the_same_orbits, COUNT(chosen)) {
  OWNED(sample) s = sample_of(known_orbit_named(chosen[_i].name, chosen[_i].index));
  OWNED(paper_route) r;
  double guess[4];
  real n[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, phi[16];
  for (int i = 0; i < 4; i++) guess[i] = fmpq_get_d(s.x + QUANTITY_TA + i) * (1 + 1e-6 * (i - 1.5));
  paper_route_init(&r, 240);
  ck_assert_int_eq(paper_route_run(&r, s.params, guess), SS_OK);
  ck_assert_msg(route_error(&r, &s) < 1e-50, "%s %d: off by %g", s.name, s.index, route_error(&r, &s));
  ck_assert_msg(r.status_d == SS_OK && r.digits_lost < 6, "%s %d: %g digits lost", s.name, s.index, r.digits_lost);
  for (int i = 0; i < N_ROUTE; i++) {
    double x = vec_d(&r.x, i);
    ck_assert_msg(fabs(r.x_d[i] - x) < 1e-9 * (1 + fabs(x)), "%s %d: %.17g, %.17g", s.name, s.index, r.x_d[i], x);
  }
  ck_assert_msg(r.steps_d <= 9 && r.steps <= 12, "%s %d: %d and %d steps", s.name, s.index, r.steps_d, r.steps);
  const struct plain p = plain_at(s.params);
  for (int ph = 0; ph < N_PHASES; ph++) { /* N, once around */
    plain_propagator(phi, &p, ph, vec_d(&r.x, ph));
    plain_product(n, phi, n, 4, 4, 4);
  }
  double n1 = condition(n[0] - 1, n[1], n[4], n[5] - 1), n3 = condition(n[8], n[9], n[12], n[13]);
  ck_assert_msg(fabs(n1 / r.condition.n1 - 1) < 1e-6 && fabs(n3 / r.condition.n3 - 1) < 1e-6, "%s %d: %g, %g", s.name,
                s.index, n1, n3);
  ck_assert(r.condition.jacobian >= 1 && r.condition.jacobian < 1e8);
}

TEST(the_papers_printed_times_lead_to_its_orbit) {
  OWNED(sample) s = sample_of(known_orbit_named("paper", 1));
  const double printed[4] = {0.6784, 2, 1.5, 2.34}, nonsense[4] = {-400, 300, 500, 0.1};
  OWNED(paper_route) r;
  paper_route_init(&r, 240);
  ck_assert_int_eq(paper_route_run(&r, s.params, printed), SS_OK);
  ck_assert_msg(route_error(&r, &s) < 1e-50, "off by %g", route_error(&r, &s));
  ck_assert_int_ne(paper_route_run(&r, s.params, nonsense), SS_OK);
  ck_assert(isnan(r.digits_lost) && isnan(r.condition.n1));
  fmpq bad[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) bad[i] = s.params[i];
  bad[P_CHI] = s.params[P_ETA]; /* 1 */
  ck_assert_int_eq(paper_route_run(&r, bad, printed), SS_DOMAIN);
}
