/* Points, what the paper's symbols, the model's matrices and the paper's expressions are worth there, and the two sides
   of sentences, held against a model of the tests' own (plain.h). */
#include "judge/judge.h"
#include "paper_model.h"
#include "plain.h"
#include "rational.h"
#include "route/jacobian.h"
#include "test.h"
#include "value/expression.h"

/* --- Points --- */

static bool same_point(const struct point *a, const struct point *b) {
  bool same = a->kind == b->kind && a->orbit == b->orbit;
  for (int i = 0; i < N_Q; i++) same = same && fmpq_equal(&a->q[i], &b->q[i]);
  return same;
}

static const struct {
  enum point_kind kind;
  enum phase phase;
} sampled[] = {{POINT_PARAMS, PHASE_D}, {POINT_FLOW, PHASE_D}, {POINT_FLOW, PHASE_GAMMA}, {POINT_FLOW, PHASE_H},
               {POINT_FLOW, PHASE_C},   {POINT_ARC, PHASE_D},  {POINT_ORBIT, PHASE_D}};
enum { N_SAMPLED = COUNT(sampled), DRAWN = 100 };

TEST_EACH(an_id_has_its_own_points, N_SAMPLED) {
  LOCAL(point, a, b, c, last);
  const struct point_spec spec = {.kind = sampled[_i].kind, .phase = sampled[_i].phase};
  struct sampler once = sampler_of("eq-27", spec), again = sampler_of("eq-27", spec), other = sampler_of("eq-28", spec);
  for (int i = 0; i < DRAWN; i++) {
    sampler_next(&a, &once);
    sampler_next(&b, &again);
    sampler_next(&c, &other);
    ck_assert_msg(same_point(&a, &b), "draw %d of one id differs", i);
    ck_assert_msg(!same_point(&a, &c), "draw %d is that of another id", i);
    ck_assert_msg(!same_point(&a, &last), "draw %d is the one before", i);
    last.kind = a.kind;
    last.orbit = a.orbit;
    for (int k = 0; k < N_Q; k++) fmpq_set(&last.q[k], &a.q[k]);
  }
}

static int compare(const fmpq_t x, slong p, ulong q) {
  NUMBERS(fmpq, y);
  fmpq_set_si(y, p, q);
  return fmpq_cmp(x, y);
}

TEST_EACH(points_lie_in_the_domain, N_SAMPLED) {
  for (int r = -1; r < n_restrictions; r++) {
    struct sampler s;
    LOCAL(point, p);
    const struct point_spec spec = {sampled[_i].kind, sampled[_i].phase,
                                    .restriction = r < 0 ? NULL : &restrictions[r]};
    sampler_init(&s, "domain", &spec);
    for (int i = 0; i < DRAWN; i++) {
      LOCAL(text, at);
      sampler_next(&p, &s);
      point_print(&at, &p);
      bool inside = compare(&p.q[Q_CHI], 0, 1) > 0 && compare(&p.q[Q_CHI], 1, 1) < 0;
      for (int k = Q_ETA; k <= Q_US2; k++) inside = inside && fmpq_sgn(&p.q[k]) > 0;
      ck_assert_msg(inside && fmpq_sgn(&p.q[Q_T]) > 0, "draw %d: %s", i, text_str(&at));
      /* a formula that is right when V = 1 alone must not look right without that restriction */
      if (r < 0)
        ck_assert_msg(!fmpq_is_one(&p.q[Q_V]), "draw %d: %s", i, text_str(&at));
      else
        is_rational(&p.q[restrictions[r].quantity], restrictions[r].value);
      if (p.kind == POINT_ARC) { /* within the stick region: w < e1, chi r < e2 */
        struct plain q = plain_of(&p);
        real z[4] = {real_of(&p.q[Q_Z1]), real_of(&p.q[Q_Z2]), q.v, q.v};
        ck_assert_msg(plain_switching(&q, PHASE_D, z) < 0 && plain_switching(&q, PHASE_GAMMA, z) < 0, "draw %d: %s", i,
                      text_str(&at));
      }
    }
  }
}

/* --- What the symbols are worth --- */

static void value_of(arb_t x, struct values *v, const char *name) {
  bool known;
  int s = values_bind(x, &known, v, name);
  ck_assert_msg(known && s == SS_OK && arb_is_finite(x), "%s has no value", name);
}

static real number(struct values *v, const char *name) {
  NUMBERS(arb, x);
  value_of(x, v, name);
  return num_arb.get_d(x);
}

/* left - sum of factor[i] * right[i] contains 0 and is narrow. */
static void vanishes(struct values *v, const char *left, int n, const real *factor, const char *const *right) {
  real sum = number(v, left), scale = 1 + fabsl(sum);
  for (int i = 0; i < n; i++) {
    real term = factor[i] * number(v, right[i]);
    sum -= term;
    scale += fabsl(term);
  }
  LOCAL(text, at);
  point_print(&at, v->point);
  ck_assert_msg(fabsl(sum) < 1e-14L * scale, "%s is off by %Lg at %s", left, sum, text_str(&at));
}
#define SAME(v, left, right) vanishes(v, left, 1, (const real[]){1}, (const char *const[]){right})

/* What the paper says holds at the switching times, (12)-(16), (26), (31), (35), (39), and along the equations (1). */
static void check_arc_facts(struct values *v) {
  real chi = number(v, "chi"), eta = number(v, "eta"), ta = number(v, "t_a");
  vanishes(v, "e_1", 2, (const real[]){1, -chi}, (const char *const[]){"z_1a", "z_2a"});
  vanishes(v, "e_2", 2, (const real[]){chi, -chi}, (const char *const[]){"z_2b", "z_1b"});
  vanishes(v, "z_1a", 2, (const real[]){1, ta}, (const char *const[]){"z_10", "V"});
  vanishes(v, "z_2a", 2, (const real[]){1, ta}, (const char *const[]){"z_20", "V"});
  SAME(v, "z'_1c", "V");
  SAME(v, "z'_2b", "V");
  vanishes(v, "x_a", 1, (const real[]){chi}, (const char *const[]){"y_a"});
  SAME(v, "x_b", "y_b");
  vanishes(v, "u_a", 0, NULL, NULL);
  vanishes(v, "v_b", 0, NULL, NULL);
  vanishes(v, "u_c", 0, NULL, NULL);
  vanishes(v, "v_f", 0, NULL, NULL);
  vanishes(v, "u_r1", 2, (const real[]){1, 1}, (const char *const[]){"u_s1", "e_1"});
  vanishes(v, "u_r2", 2, (const real[]){1, 1}, (const char *const[]){"u_s2", "e_2"});
  /* x = z + d, d at rest under both forces: d_1 - chi d_2 = u_s1, chi (d_2 - d_1) = u_s2 */
  vanishes(v, "u_r1", 2, (const real[]){1, -chi}, (const char *const[]){"x_1(t_a)", "x_2(t_a)"});
  vanishes(v, "u_r2", 2, (const real[]){chi, -chi}, (const char *const[]){"x_2(t_a + t_b)", "x_1(t_a + t_b)"});
  vanishes(v, "z_1''(t)", 2,
           v->point->phase == PHASE_GAMMA || v->point->phase == PHASE_H ? (const real[]){-1, chi}
                                                                        : (const real[]){0, 0},
           (const char *const[]){"z_1(t)", "z_2(t)"});
  vanishes(v, "z_2''(t)", 2, v->point->phase >= PHASE_H ? (const real[]){chi * eta, -chi * eta} : (const real[]){0, 0},
           (const char *const[]){"z_1(t)", "z_2(t)"});
}

/* The arc's events and states are those of the second model. */
static void check_arc_against_plain(struct values *v) {
  struct plain p = plain_of(v->point);
  static const char *const times[] = {"t_a", "t_b", "t_c", "t_d"};
  real z[4] = {number(v, "z_10"), number(v, "z_20"), p.v, p.v};
  for (int ph = 0; ph < N_PHASES; ph++) {
    real t = plain_end(z, &p, ph, number(v, times[ph]));
    ck_assert_msg(fabsl(t - number(v, times[ph])) < 1e-11L * (1 + fabsl(t)), "%s", times[ph]);
    for (int i = 0; i < 4; i++) {
      real want = num_arb.get_d((arb_srcptr)num_vec_at(&v->arc.z, 4 * (ph + 1) + i));
      ck_assert_msg(fabsl(z[i] - want) < 1e-11L * (1 + fabsl(want)), "component %d after phase %d", i, ph);
    }
  }
}

enum { ARC_DRAWS = 12 };

/* Opens values on arc n of the test's own stream; false when it has no such arc. */
static bool open_arc(struct values *v, struct point *p, int n, enum variant variant, struct num_ctx ctx) {
  struct sampler s =
      sampler_of("check_value", (struct point_spec){.kind = POINT_ARC, .phase = (enum phase)(n % N_PHASES)});
  for (int i = 0; i <= n; i++) sampler_next(p, &s);
  return values_init(v, p, variant, ctx, the_paper.cache) == SS_OK;
}

CASE("values", .once = {paper_open, paper_close}, .seconds = 60);

TEST_EACH(arcs_obey_the_papers_conditions, 2) {
  int accepted = 0;
  for (int n = 0; n < ARC_DRAWS; n++) {
    OWNED(values) v;
    LOCAL(point, p);
    if (open_arc(&v, &p, n, _i ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, num_ctx_arb(FIRST_PREC))) {
      accepted++;
      check_arc_facts(&v);
      check_arc_against_plain(&v);
    }
  }
  ck_assert_msg(2 * accepted >= ARC_DRAWS, "only %d arcs of %d", accepted, ARC_DRAWS);
}

TEST(orbits_close) {
  LOCAL(point, p);
  OWNED(values) v;
  ck_assert(nearest_orbit_point(&p, &the_paper.scene, the_paper.cache));
  ck_assert_int_eq(p.orbit, 1); /* tests/oracle/orbits.tsv: of the two it is the second that is near */
  ck_assert(values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), the_paper.cache) == SS_OK);
  check_arc_facts(&v);
  check_arc_against_plain(&v);
  SAME(&v, "z_100", "z_10");
  SAME(&v, "z_200", "z_20");
  static const char *const end = "(t_a + t_b + t_c + t_d)";
  static const char *const component[] = {"z_1", "z_2", "z_1'", "z_2'"}, *const start[] = {"z_10", "z_20", "V", "V"};
  for (int i = 0; i < 4; i++) {
    const char *name = formatted("%s%s", component[i], end);
    SAME(&v, name, start[i]);
  }
}

TEST(flows_solve_their_equations) {
  for (int n = 0; n < 8; n++)
    for (int ph = 0; ph < N_PHASES; ph++) {
      LOCAL(point, p);
      OWNED(values) v;
      struct sampler s = sampler_of("check_value", (struct point_spec){.kind = POINT_FLOW, .phase = (enum phase)ph});
      for (int i = 0; i <= n; i++) sampler_next(&p, &s);
      ck_assert(values_init(&v, &p, n % 2 ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, num_ctx_arb(FIRST_PREC),
                            the_paper.cache) == SS_OK);
      struct plain q = plain_of(&p);
      real z[4] = {number(&v, "z_1(0)"), number(&v, "z_2(0)"), number(&v, "z_1'(0)"), number(&v, "z_2'(0)")}, end[4];
      for (int i = 0; i < 4; i++) ck_assert(fabsl(z[i] - real_of(&p.q[Q_Z1 + i])) < 1e-15L);
      plain_flow(end, &q, ph, z, number(&v, "t"));
      static const char *const names[] = {"z_1(t)", "z_2(t)", "z_1'(t)", "z_2'(t)"};
      for (int i = 0; i < 4; i++)
        ck_assert_msg(fabsl(number(&v, names[i]) - end[i]) < 1e-12L * (1 + fabsl(end[i])), "%s, phase %d, draw %d",
                      names[i], ph, n);
    }
}

TEST(names_without_a_value_are_told_apart) {
  static const char *const strangers[] = {"z_1(t_a + dt_a)", "foo",       "z_3a", "x_e",
                                          "z_1(2*t_c)",      "z_1'''(t)", "chi2", "foo[1,1]",
                                          "J_a[1,3]",        "J_a[2,1]",  "z_100"};
  struct values v;
  LOCAL(point, p);
  int n = 0;
  while (!open_arc(&v, &p, n, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC))) {
    values_clear(&v);
    ck_assert(++n < ARC_DRAWS);
  }
  NUMBERS(arb, x);
  for (size_t i = 0; i < COUNT(strangers); i++) {
    bool known = true;
    int s = values_bind(x, &known, &v, strangers[i]);
    ck_assert_msg(!known && s != SS_OK, "%s has a value on an arc", strangers[i]);
  }
  values_clear(&v);
}

/* --- The model's matrices --- */

static void oracle_is(struct values *v, const char *name, int rows, int cols, const real *want, real tolerance) {
  const struct oracle *o = oracle_find(name);
  ck_assert_msg(o && o->rows == rows && o->cols == cols, "%s has another shape", name);
  OWNED(num_vec) m = vec_new(rows * cols, v->ctx);
  ck_assert_msg(oracle_eval(&m, o, v) == SS_OK, "%s cannot be had", name);
  real scale = 1;
  for (int i = 0; i < rows * cols; i++) scale = fmaxl(scale, fabsl(want[i]));
  LOCAL(text, at);
  point_print(&at, v->point);
  for (int i = 0; i < rows * cols; i++) {
    real x = v->ctx.type->get_d(num_vec_at(&m, i));
    ck_assert_msg(fabsl(x - want[i]) < tolerance * scale, "%s[%d,%d] is %Lg, not %Lg, at %s", name, i / cols + 1,
                  i % cols + 1, x, want[i], text_str(&at));
  }
}

/* The local Jacobians, from the paper's sentences around (27), (32), (36), (40): which perturbations enter a phase, and
   which components are kept. */
static void check_jacobians(struct values *v, real tolerance) {
  struct plain p = plain_of(v->point);
  real z[5][4], t[4];
  for (int i = 0; i < 20; i++) z[i / 4][i % 4] = v->ctx.type->get_d(num_vec_at(&v->arc.z, i));
  for (int i = 0; i < 4; i++) t[i] = v->ctx.type->get_d(num_vec_at(&v->arc.t, i));
  const struct {
    const char *name;
    int from, to, rows, cols;
    real in[3][4];
    int keep[3];
  } maps[] = {
      {"J_a", PHASE_D, PHASE_D, 1, 2, {{1, 0, 0, 0}, {0, 1, 0, 0}}, {1}},
      {"J_b", PHASE_GAMMA, PHASE_GAMMA, 2, 1, {{p.chi, 1, 0, 0}}, {1, 2}},
      {"J_c", PHASE_H, PHASE_H, 3, 2, {{1, 1, 0, 0}, {0, 0, 1, 0}}, {0, 1, 3}},
      {"J_f", PHASE_C, PHASE_C, 2, 3, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}, {0, 1}},
      {"J", PHASE_D, PHASE_C, 2, 2, {{1, 0, 0, 0}, {0, 1, 0, 0}}, {0, 1}},
  };
  for (size_t m = 0; m < COUNT(maps); m++) {
    real want[6], end[4];
    for (int k = 0; k < maps[m].cols; k++) {
      plain_derivative(end, &p, maps[m].from, maps[m].to, z[maps[m].from], maps[m].in[k], t);
      for (int i = 0; i < maps[m].rows; i++) want[i * maps[m].cols + k] = end[maps[m].keep[i]];
    }
    oracle_is(v, maps[m].name, maps[m].rows, maps[m].cols, want, tolerance);
  }
}

TEST_EACH(jacobians_are_the_differences_of_a_second_model, 2) {
  const struct num_ctx ctx[] = {num_ctx_arb(FIRST_PREC), num_ctx_mpfr(FD_PREC)};
  const enum variant variant[] = {VARIANT_CLOSED, VARIANT_FD};
  LOCAL(point, p);
  ck_assert(nearest_orbit_point(&p, &the_paper.scene, the_paper.cache));
  for (p.orbit = 0; p.orbit < scene_orbits(&the_paper.scene, the_paper.cache)->n; p.orbit++) {
    OWNED(values) v;
    ck_assert(values_init(&v, &p, variant[_i], ctx[_i], the_paper.cache) == SS_OK);
    check_jacobians(&v, 1e-9L);
  }
  int accepted = 0;
  for (int n = 0; n < ARC_DRAWS / 2; n++) {
    OWNED(values) v;
    bool ok = open_arc(&v, &p, n, variant[_i], ctx[_i]);
    accepted += ok;
    if (ok) check_jacobians(&v, 1e-8L);
  }
  ck_assert(accepted >= 3);
}

TEST(matrices_of_the_motion_are_those_of_a_second_model) {
  LOCAL(point, p);
  struct sampler s = sampler_of("matrices", (struct point_spec){.kind = POINT_PARAMS});
  for (int n = 0; n < 8; n++) {
    static const char *const propagators[] = {"D(t)", "Gamma(t)", "H(t)", "C(t)"};
    static const char *const stiff[] = {NULL, "K_1", "K", "K_2"};
    static const char *const newton[] = {NULL, "K_1 newton", "K newton", "K_2 newton"};
    OWNED(values) v;
    sampler_next(&p, &s);
    ck_assert(values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), the_paper.cache) == SS_OK);
    struct plain q = plain_of(&p);
    for (int ph = 0; ph < N_PHASES; ph++) {
      real phi[16], a[16];
      plain_propagator(phi, &q, ph, real_of(&p.q[Q_T]));
      oracle_is(&v, propagators[ph], 4, 4, phi, 1e-13L);
      if (!stiff[ph]) continue;
      plain_system(a, &q, ph);
      oracle_is(&v, stiff[ph], 2, 2, (const real[]){-a[8], -a[9], -a[12], -a[13]}, 1e-15L);
      oracle_is(&v, newton[ph], 2, 2, (const real[]){-a[8], -a[9], -a[12], -a[13]}, 1e-15L);
    }
    /* (3); and the roots of mu^2 - (1 + chi eta) mu + chi eta (1 - chi) = 0 */
    real u1 = real_of(&p.q[Q_US1]), u2 = real_of(&p.q[Q_US2]), ce = q.chi * q.eta;
    real half = (1 + ce) / 2, spread = sqrtl(half * half - ce * (1 - q.chi));
    oracle_is(&v, "d_01", 1, 1, (const real[]){(u1 + u2) / (1 - q.chi)}, 1e-15L);
    oracle_is(&v, "d_02", 1, 1, (const real[]){(u1 * q.chi + u2) / ((1 - q.chi) * q.chi)}, 1e-15L);
    oracle_is(&v, "omega_1", 1, 1, (const real[]){sqrtl(ce * (1 - q.chi) / (half + spread))}, 1e-15L);
    oracle_is(&v, "omega_2", 1, 1, (const real[]){sqrtl(half + spread)}, 1e-15L);
  }
}

TEST(n_carries_the_state_through_one_period) {
  LOCAL(point, p);
  OWNED(values) v;
  ck_assert(nearest_orbit_point(&p, &the_paper.scene, the_paper.cache));
  ck_assert(values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), the_paper.cache) == SS_OK);
  struct plain q = plain_of(&p);
  real n[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, phi[16];
  static const char *const times[] = {"t_a", "t_b", "t_c", "t_d"};
  for (int ph = 0; ph < N_PHASES; ph++) {
    plain_propagator(phi, &q, ph, number(&v, times[ph]));
    plain_product(n, phi, n, 4, 4, 4);
  }
  oracle_is(&v, "N", 4, 4, n, 1e-13L);
  ck_assert(oracle_find("Q") == NULL && oracle_find("") == NULL && oracle_find("J_") == NULL);
}

/* --- The paper's expressions at points --- */

/* (27), (32), (36), (40), (41) typed in once more; ktilde_4 times V^power_of_v, which is -1 as printed. */
static void chain_by_hand(real j[4], const struct plain *p, const real start[2], const real t[4], int power_of_v) {
  real za[4], zb[4], zc[4], h[16], z0[4] = {start[0], start[1], p->v, p->v};
  plain_flow(za, p, PHASE_D, z0, t[0]);
  plain_flow(zb, p, PHASE_GAMMA, za, t[1]);
  plain_flow(zc, p, PHASE_H, zb, t[2]);
  plain_propagator(h, p, PHASE_H, t[2]);
  real chi_b = zb[2] / p->v;
  real ja[2] = {-1 / (1 - p->chi), 1 / (1 - p->chi)};
  real jb[2] = {(p->chi - chi_b) / (1 - chi_b), (p->chi * zb[1] - zb[0]) * (p->chi - 1) / (p->v * (1 - chi_b))};
  real k1 = p->v / (zc[0] - p->chi * zc[1]), k2 = k1 * zc[3] / p->v, k3 = k1 * p->chi * p->eta * (zc[0] - zc[1]) / p->v;
  real h3 = h[8] + h[9];
  real jc[6] = {h[0] + h[1] + k1 * h3, h[2] + k1 * h[0],        h[4] + h[5] + k2 * h3,
                h[6] + k2 * h[0],      h[12] + h[13] + k3 * h3, h[4] + k3 * h[0]};
  real w = sqrtl(p->chi * p->eta), k4 = powl(p->v, power_of_v) * sinl(w * t[3]) / (w * (start[1] - start[0]));
  real k5 = k4 / w / tanl(w * t[3]), k6 = cosl(w * t[3]) - k4, k7 = sinl(w * t[3]) / w + k5;
  real jf[6] = {1 + k4, -k4, k5, 1 - k6, k6, k7}, jcb[3], column[2];
  plain_product(jcb, jc, jb, 3, 2, 1);
  plain_product(column, jf, jcb, 2, 3, 1);
  plain_product(j, column, ja, 2, 1, 2);
}

static void jacobian_of(real j[4], struct scene *s, const struct jacobian_request *q) {
  BALLS(6, x);
  goes_well(audit_jacobian(x, x + 4, x + 5, &the_paper.model, s, q, &d));
  for (int i = 0; i < 4; i++) j[i] = num_arb.get_d(x + i);
  ck_assert(arb_is_zero(x + 5));
  ck_assert(fabsl(num_arb.get_d(x + 4) - j[0] - j[3]) < 1e-13L * (1 + fabsl(j[0])));
}

TEST(the_chain_at_printed_numbers) {
  const char *path = scratch_put(
      "printed.scene", "chi = 0.7\neta = 1.25\nV = 1.5\ne1 = 2.5\ne2 = 0.75\nprinted: z10 = 0.9\nprinted: z20 = -2.2\n"
                       "printed: t_a = 0.7\nprinted: t_b = 2\nprinted: t_c = 1.5\nprinted: t_d = 2.3\n");
  OWNED(scene) s = scene_at(path);
  const struct plain p = {0.7L, 1.25L, 1.5L, 2.5L, 0.75L};
  const real start[2] = {0.9L, -2.2L}, t[4] = {0.7L, 2, 1.5L, 2.3L};
  for (int layer = 0; layer < N_LAYERS; layer++) {
    real want[4], got[4];
    struct jacobian_request q = {METHOD_ANALYTIC, (enum layer)layer, true, 0, 15};
    chain_by_hand(want, &p, start, t, layer == LAYER_PRINTED ? -1 : 1);
    jacobian_of(got, &s, &q);
    for (int i = 0; i < 4; i++)
      ck_assert_msg(fabsl(got[i] - want[i]) < 1e-12L * (1 + fabsl(want[i])), "%s, entry %d: %Lg, not %Lg",
                    layer_name[layer], i, got[i], want[i]);
  }
}

/* The other methods take the printed state and find the events themselves. */
TEST_EACH(the_map_at_printed_numbers, 2) {
  const enum jacobian_method method[] = {METHOD_IMPLICIT, METHOD_FD};
  const struct plain p = {0.8L, 1, 1, 2.7844L, 0.8587L};
  const real z[4] = {0.8921L, -2.1958L, 1, 1}, near[4] = {0.6784L, 2, 1.5L, 2.34L};
  real got[4], want[4], end[4];
  for (int k = 0; k < 2; k++) {
    plain_derivative(end, &p, PHASE_D, PHASE_C, z, (const real[]){k == 0, k == 1, 0, 0}, near);
    for (int i = 0; i < 2; i++) want[2 * i + k] = end[i];
  }
  jacobian_of(got, &the_paper.scene, &(struct jacobian_request){method[_i], LAYER_CORRECTED, true, 0, 15});
  for (int i = 0; i < 4; i++)
    ck_assert_msg(fabsl(got[i] - want[i]) < 1e-9L, "entry %d: %Lg, not %Lg", i, got[i], want[i]);
}

TEST(expressions_at_a_point) {
  LOCAL(point, p);
  struct diag d = {0};
  ck_assert(printed_point(&p, &the_paper.scene));
  BALLS(16, x);
  int n;
  struct view v = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  NUMBERS(fmpq, third);
  fmpq_set_si(third, 1, 3);
  ck_assert(expression_at(x, &n, v, "1/3", "stability", &p, 200, the_paper.cache, &d) == SS_OK && n == 1);
  ck_assert(arb_contains_fmpq(x, third) && arb_rel_accuracy_bits(x) > 190);
  ck_assert(expression_at(x, &n, v, "z_10 - chi*z_20 + V*t_a*(1 - chi)", "validation", &p, 128, the_paper.cache, &d) ==
            SS_OK);
  ck_assert(fabs(num_arb.get_d(x) - 2.78442) < 1e-15); /* 0.8921 + 0.8*2.1958 + 0.2*0.6784 */
  ck_assert(expression_at(x, &n, v, "H(t_c)[1:2,3:4]", "appendix_a", &p, 128, the_paper.cache, &d) == SS_OK && n == 4);
  real h[16];
  plain_propagator(h, &(struct plain){0.8L, 1, 1, 0, 0}, PHASE_H, 1.5L);
  for (int i = 0; i < 4; i++) ck_assert(fabsl(num_arb.get_d(x + i) - h[4 * (i / 2) + 2 + i % 2]) < 1e-14L);
  ck_assert(expression_at(x, &n, v, "1/(V - 1)", "stability", &p, 128, the_paper.cache, &d) != SS_OK);
  ck_assert(expression_at(x, &n, v, "t_prime", "stability", &p, 128, the_paper.cache, &d) != SS_OK && !d.set);
  ck_assert(expression_at(x, &n, v, "no_such_name", "stability", &p, 128, the_paper.cache, &d) != SS_OK && d.set);
  diag_init(&d);
  ck_assert(expression_at(x, &n, v, "1/2/3", "stability", &p, 128, the_paper.cache, &d) != SS_OK && d.set);
}

/* --- Sentences at a point --- */

static enum outcome outcome_of(const char *name) {
  static const char *const names[] = {"agrees", "differs", "undecided", "rejected", "unbound"};
  return (enum outcome)word_find(name, names, COUNT(names));
}

TABLE(sentences, "tests/cases/two_sides.tsv", 4);
enum { SENTENCE, BALLS, BITS, ROUNDED }; /* its columns */

TEST_EACH(two_sides_at_a_point, sentences.n) {
  char *const *row = sentences.row[_i];
  LOCAL(point, p);
  OWNED(sentence) sides;
  struct sampler s = sampler_of("sentences", (struct point_spec){.kind = POINT_PARAMS});
  sampler_next(&p, &s);
  const char *path = scratch_print("overlay.eq", "equation user\n  section: stability\n  %s\n", row[SENTENCE]);
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = path});
  struct view v = {&m, LAYER_PRINTED, NULL, NULL};
  goes_well(sentence_from_relations(&sides, v, view_record(&v, "user"), NULL, 0, &d));
  struct trial t = sentence_try_balls(&sides, &p, VARIANT_CLOSED, the_paper.cache);
  ck_assert_msg(t.outcome == outcome_of(row[BALLS]), "%s: %d at %ld bits", row[SENTENCE], (int)t.outcome, t.bits);
  if (atoi(row[BITS])) ck_assert_int_eq(t.bits, atoi(row[BITS]));
  if (t.outcome == OUTCOME_UNBOUND) ck_assert_str_eq(t.unbound, "z_1a");
  t = sentence_try_rounded(&sides, &p, VARIANT_CLOSED, num_ctx_mpfr(FD_PREC), -200, the_paper.cache);
  ck_assert_msg(t.outcome == outcome_of(row[ROUNDED]), "%s rounded: %d", row[SENTENCE], (int)t.outcome);
}
