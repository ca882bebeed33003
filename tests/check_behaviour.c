/* Behaviour: the return map's Taylor series, and the claims that are judged by motions.

   Numbers come from tests/oracle (equality.tsv: mpmath, matrix exponentials and differences; longrun.tsv: fixed-step
   Runge-Kutta in floats), from the return map of motion/return_map_double.c, which knows no series, and from the
   simulation of two masses. */
#include "judge/behaviour.h"
#include "paper_model.h"
#include "rational.h"
#include "rng.h"
#include "run/audit.h"
#include "test.h"

/* --- The return map as a series --- */

struct row {
  double par[N_PARAMS], value, r, c[4];
  int vary;
};

static void read_equality(struct row row[2]) {
  OWNED(table) t = table_read("tests/oracle/equality.tsv", 11);
  for (int k = 0; k < 2; k++) {
    FREED_PARAMS fmpq *par = rationals((const char *const *)t.row[k], N_PARAMS);
    for (int i = 0; i < N_PARAMS; i++) row[k].par[i] = fmpq_get_d(par + i);
    row[k].vary = atoi(t.row[k][5]);
    row[k].value = row[k].par[row[k].vary] = atof(t.row[k][6]);
    row[k].r = atof(t.row[k][7]);
    for (int i = 1; i < 4; i++) row[k].c[i] = atof(t.row[k][7 + i]);
  }
}

/* The series at r, the start lying on w = e1, in balls of 200 bits; radius: of r, as a power of 2, or 0. */
static int series(arb_ptr c, slong n, const double par[N_PARAMS], double r, slong radius) {
  struct num_ctx ctx = num_ctx_arb(200);
  OWNED(num_vec) params = vec_of(par, N_PARAMS, ctx);
  OWNED(dyn_arc) arc;
  double t[4], out;
  BALLS(3, z);
  ck_assert_int_eq(dyn_return_map_d(&out, NULL, t, par, r), SS_OK);
  dyn_arc_init(&arc, ctx);
  arb_set_d(z + 2, r);
  if (radius) mag_set_ui_2exp_si(arb_radref(z + 2), 1, radius);
  const void *chi = num_vec_at(&params, P_CHI), *e1 = num_vec_at(&params, P_E1);
  arb_mul(z, chi, z + 2, 200);
  arb_add(z, z, e1, 200);
  arb_add(z + 1, z + 2, e1, 200);
  arb_sub_si(z + 2, chi, 1, 200);
  arb_neg(z + 2, z + 2);
  arb_div(z, z, z + 2, 200);
  arb_div(z + 1, z + 1, z + 2, 200);
  t[0] = 0;
  int s = dyn_arc_run(&arc, &params, z, z + 1, t);
  if (s == SS_OK) s |= dyn_return_jet(c, n, &params, &arc);
  return s;
}

TEST_EACH(series_of_the_return_map_at_equality, 2) {
  struct row row[2];
  BALLS(4, c);
  read_equality(row);
  const struct row *k = &row[_i];
  ck_assert_int_eq(series(c, 4, k->par, k->r, 0), SS_OK);
  ck_assert_double_eq_tol(mid(c), k->r, 1e-12 * fabs(k->r));
  ck_assert_double_eq_tol(mid(c + 1), -1, 1e-12);
  for (int i = 2; i < 4; i++) ck_assert_double_eq_tol(mid(c + i), k->c[i], 1e-9 * (1 + fabs(k->c[i])));
}

TEST_EACH(series_predicts_the_map_nearby, 40) {
  struct rng rng = {(uint64_t)_i};
  struct row row[2];
  BALLS(6, c);
  read_equality(row);
  double par[N_PARAMS];
  memcpy(par, row[_i % 2].par, sizeof par);
  par[P_V] *= 1 + (double)rng_between(&rng, -8, 8) / 64;
  par[P_ETA] *= 1 + (double)rng_between(&rng, -8, 8) / 64;
  double r = row[_i % 2].r * (1 + (double)rng_between(&rng, -8, 8) / 256), t[4];
  if (series(c, 6, par, r, 0) == SS_OK)
    for (int k = -2; k <= 2; k++) {
      double s = k * 5e-4, want, got = 0;
      ck_assert_int_eq(dyn_return_map_d(&want, NULL, t, par, r + s), SS_OK);
      for (int i = 5; i >= 0; i--) got = got * s + mid(c + i);
      ck_assert_msg(fabs(got - want) < 1e-11 * (1 + fabs(want)), "trial %d at s = %g: %.17g, not %.17g", _i, s, got,
                    want);
    }
}

TEST(series_over_a_ball_hold_those_of_its_points) {
  struct row row[2];
  BALLS(8, c);
  read_equality(row);
  ck_assert_int_eq(series(c, 4, row[0].par, row[0].r, -60), SS_OK);
  for (int side = -1; side <= 1; side++) {
    ck_assert_int_eq(series(c + 4, 4, row[0].par, row[0].r, 0), SS_OK);
    for (int i = 0; i < 4; i++) ck_assert(arb_overlaps(c + i, c + 4 + i));
  }
  ck_assert(arb_rel_accuracy_bits(c + 3) >= 42);
}

/* --- Claims --- */

/* Under the paper's and the corrected files. */
static const struct finding *judged(struct audit_result *r, const char *text) {
  goes_well(judge_text(r, &the_paper.model, text, &the_paper.scene, "text", &d));
  ck_assert_int_eq((int)r->n_findings, 1);
  return &r->findings[0];
}

/* What claims about (1) and (2) name, and claims of that law. */
#define STABLE "  at: chi = 2/3, eta = 2, V = 1, e1 = 2, e2 = 1/4\n"
#define MECHANICS                                                                                                      \
  "  depends-on: first, second\n\n"                                                                                    \
  "claim first\n  section: model\n  title: m_1\n  kind: law\n  mass: 1\n  moves: eq-1#2 D\n"                           \
  "  slips: eq-2#1, eq-2#3 H\n  sticks: eq-2b C\n  breaks: eq-2d C\n\n"                                                \
  "claim second\n  section: model\n  title: m_2\n  kind: law\n  mass: 2\n  moves: eq-1#3 D\n"                          \
  "  slips: eq-2#2, eq-2#4 H\n  sticks: eq-2c Gamma\n  breaks: eq-2e Gamma\n"
#define CLAIM(check) "claim text-case\n  kind: behaviour\n  title: a case\n  check: " check "\n"

CASE("claims", .once = {paper_open, paper_close});

/* c_2^2 + c_3 of equality.tsv to six digits. */
TEST_EACH(the_third_order_decides_at_equality, 2) {
  static const char *const families[] = {
      "  at: chi = 2/3, eta = 1/2, V = 1, e1 = 4, e2 = 3/4\n  vary: e2 from 3/4 to 1\n",
      "  at: chi = 79/100, eta = 2, V = 1, e1 = 4, e2 = 1/4\n  vary: chi from 79/100 to 78/100\n"};
  struct row row[2];
  OWNED(audit_result) r;
  read_equality(row);
  const char *text = formatted("%s%s", CLAIM("equality") "  criterion: text-criterion\n", families[_i]);
  const struct finding *f = judged(&r, text);
  double third = row[_i].c[2] * row[_i].c[2] + row[_i].c[3];
  ck_assert_int_eq((int)f->verdict, third > 0 ? VERDICT_CONDITIONAL : VERDICT_SUPPORTED); /* |tr J| is not 1 */
  const char *want = formatted("c_2^2 + c_3 = %.6g", third);
  ck_assert_msg(finding_says(f, want), "%s is not said", want);
  const char *place = formatted(" = %.15g", row[_i].value);
  ck_assert_msg(strstr(f->evidence[0].worst, place) != NULL, "%s, not %s", f->evidence[0].worst, place);
}

/* Word and period of longrun.tsv. */
TEST(the_long_run_of_the_printed_start) {
  OWNED(table) runs = table_read("tests/oracle/longrun.tsv", 10);
  OWNED(audit_result) r;
  const struct finding *g = judged(&r, CLAIM("long-run") "  friction: 1.25 2\n");
  ck_assert_int_eq((int)g->verdict, VERDICT_DEFINITION);
  ck_assert_int_eq(g->n_evidence, 2);
  for (int k = 0; k < 2; k++) {
    char *const *field = runs.row[k];
    const char *word = field[8];
    const char *period = formatted("the period %.6f", atof(field[9]));
    ck_assert_msg(strstr(g->evidence[k].note, word) != NULL, "%s, not %s", g->evidence[k].note, word);
    ck_assert_msg(strstr(g->evidence[k].note, period) != NULL, "%s, not %s", g->evidence[k].note, period);
    ck_assert(strstr(g->evidence[k].note, "give the same events") != NULL);
    const char *friction = formatted("u_r1 = %.7g, u_r2 = %.7g", atof(field[1]), atof(field[2]));
    ck_assert_str_eq(g->evidence[k].worst, friction);
  }
}

/* Where a velocity perturbation frees a sticking mass the motion departs, and only there: the program's words, and the
   two motions of longrun.tsv, of which the slowed one never comes to stick both masses again. */
TEST(a_slowed_sticking_mass_departs) {
  OWNED(audit_result) r;
  const struct finding *f = judged(&r, CLAIM("perturb") STABLE MECHANICS);
  ck_assert_int_eq((int)f->verdict, VERDICT_PROVED);
  ck_assert(finding_says(f, "5 free a sticking mass at once"));
  ck_assert(finding_says(f, "5 of these depart; of the 91 others 0"));
  struct coulomb_setup m = {.params = {2.0 / 3, 2, 1, 0.5, 0.95279191029 - 0.25, 2.5, 0.95279191029},
                            .start = {4.447209099, 3.58969638, 1, 1}};
  for (int slowed = 0; slowed < 2; slowed++) {
    struct coulomb_plan plan = coulomb_plan_default;
    plan.returns = 20;
    plan.duration = 400;
    if (slowed) m.start[DZ_1] -= 1e-6;
    for (int route = 0; route < N_MOTION_ROUTES; route++) {
      OWNED(trajectory) t = motion_simulate((enum motion_route)route, &m, &plan);
      ck_assert_int_eq((int)t.result.returns, slowed ? 0 : 20);
    }
  }
}

/* How much the product of the phases' propagators stretches a vector per period in the long run, in double by GSL. */
static double growth(const struct dyn_orbit *o, const fmpq params[N_PARAMS]) {
  enum { PERIODS = 4000 };
  struct num_vec step[N_PHASES];
  double log_size = 0;
  OWNED(num_vec) p = vec_new(N_PARAMS, num_ctx_double()), z = vec_new(N_STATE, num_ctx_double());
  for (int i = 0; i < N_PARAMS; i++) p.ctx.type->set_q(num_vec_at(&p, i), &params[i], 53);
  for (int ph = 0; ph < N_PHASES; ph++) {
    double t = mid(o->t[ph]);
    num_vec_init(&step[ph], N_STATE * N_STATE, num_ctx_double());
    ck_assert_int_eq(dyn_propagator(&step[ph], (enum phase)ph, &p, &t), SS_OK);
  }
  for (int i = 0; i < N_STATE; i++) z.ctx.type->set_d(num_vec_at(&z, i), 0.3 + i, 53);
  for (int k = 0; k < PERIODS; k++) {
    double size = 0;
    for (int ph = 0; ph < N_PHASES; ph++) num_mat_mul(&z, &step[ph], &z, N_STATE, N_STATE, 1);
    for (int i = 0; i < N_STATE; i++) size = fmax(size, fabs(z.ctx.type->get_d(num_vec_at(&z, i))));
    for (int i = 0; i < N_STATE; i++) {
      double x = z.ctx.type->get_d(num_vec_at(&z, i)) / size;
      z.ctx.type->set_d(num_vec_at(&z, i), x, 53);
    }
    if (k >= PERIODS / 2) log_size += log(size) / (PERIODS - PERIODS / 2);
  }
  for (int ph = 0; ph < N_PHASES; ph++) num_vec_clear(&step[ph]);
  return exp(log_size);
}

/* At how many of the orbits that the claim draws the propagators stretch. */
static long stretched(const char *id) {
  enum { WANTED = 24, DRAWS = 96 };
  struct orbit_cache *cache = orbit_cache_new();
  struct orbit_set seen = {.n = 0};
  LOCAL(point, p);
  long count = 0;
  struct sampler s = sampler_of(id, (struct point_spec){.kind = POINT_ORBIT});
  for (int i = 0; i < DRAWS && seen.n < WANTED; i++) {
    sampler_next(&p, &s);
    if (!point_settle(&p, cache)) continue;
    const struct dyn_orbit *o = &orbit_cache_get(cache, p.q, FD_PREC + 64)->orbit[p.orbit];
    if (!o->grazing && orbit_is_new(&seen, o)) count += growth(o, p.q) > 1.005;
  }
  orbit_cache_free(cache);
  return count;
}

TEST(linearization_is_wrong_without_the_jumps_only) {
  OWNED(audit_result) r, other, wrong;
  const struct finding *f = judged(&r, CLAIM("linearization") STABLE MECHANICS);
  ck_assert_int_eq((int)f->verdict, VERDICT_PROVED);
  ck_assert(finding_says(f, "certified in balls") && finding_says(f, "determinant 1"));
  ck_assert(finding_says(f, "and wrong at 0"));
  ck_assert_int_eq(f->evidence[1].trials, stretched("text-case"));
  f = judged(&other, "claim text-other\n  kind: behaviour\n  title: a case\n  check: linearization\n" STABLE MECHANICS);
  ck_assert_int_eq(f->evidence[1].trials, stretched("text-other"));
  f = judged(&wrong, CLAIM("linearization") "  jumps: saltation\n" STABLE MECHANICS);
  ck_assert_int_eq((int)f->verdict, VERDICT_REFUTED);
}

TEST(the_criterion_needs_its_threshold) {
  static const char claim[] = "claim text-case\n  section: stability\n  kind: criterion\n  title: a case\n"
                              "  statement: text-criterion\n";
  static const char *const rows[][2] = {
      {"", ""}, {"  side: inside\n", "and 0 with |slope| > 1"}, {"  side: outside\n", "at 0 orbits with |slope| < 1"}};
  for (int i = 0; i < 3; i++) {
    OWNED(audit_result) r;
    const struct finding *f = judged(&r, formatted("%s%s", claim, rows[i][0]));
    ck_assert_int_eq((int)f->verdict, VERDICT_PROVED);
    ck_assert_msg(!*rows[i][1] || finding_says(f, rows[i][1]), "%s", rows[i][1]);
  }
}

/* The scene to reproduce the perturbed motions with is the claim's. */
TEST(the_scene_is_the_claims) {
  OWNED(scene) stable = scene_at("stable");
  LOCAL(point, p);
  LOCAL(text, at);
  for (const char *s = claim_get(paper_claim("text-conditionally-stable"), "at"); *s; s++)
    if (*s != ' ') text_add_char(&at, *s);
  for (int q = Q_CHI; q <= Q_E2; q++) fmpq_zero(&p.q[q]);
  goes_well(point_set(&p, text_str(&at), &d));
  for (int k = 0; k < N_SCENE_PARAMS; k++) ck_assert(fmpq_equal(&p.q[Q_CHI + k], &stable.value[k]));
}
