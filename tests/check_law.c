/* What damaged formulas showed to be unread: Coulomb's law branch by branch, the blocks and springs behind (1), states
   and perturbations where nothing is V, friction that a realistic orbit has, arguments both ways, ranges that are no
   phase. What is expected is known by hand: the law by its words, the blocks by Newton's law, forces by the orbit's own
   bounds. */
#include <check.h>
#include <stdlib.h>
#include <string.h>

#include "claim/claims.h"
#include "local.h"
#include "paper_model.h"
#include "run/audit.h"
#include "scratch.h"
#include "suite.h"
#include "value/values.h"

/* Judges one claim of the test's own beside formulas of its own; N_VERDICTS with d set when it is at fault. */
static enum verdict judged(const char *formulas, const char *claim, struct diag *d) {
  OWNED(model) m;
  LOCAL(audit_result, r);
  bool ok = paper_model_read(&m, &(struct paper_layers){.overlay = scratch_put("own.eq", formulas)}, d) &&
            judge_text(&r, &m, formatted("claim own\n  section: appendix_b\n  title: of the test\n%s", claim),
                       &the_paper.scene, "own", d);
  enum verdict v = ok ? r.findings[0].verdict : N_VERDICTS;
  ck_assert(!ok || r.n_findings == 1);
  return v;
}

/* Under these formulas the claim comes to that verdict; what: the case. */
static void expect(enum verdict want, const char *what, const char *formulas, const char *claim) {
  struct diag d;
  enum verdict v = judged(formulas, claim, &d);
  ck_assert_msg(v == want, "%s: %s %s", what, v < N_VERDICTS ? verdict_name[v] : "", d.message);
}

/* --- Coulomb's law --- */

#define SLOWER "  eps*(V - x_1'(t)) > 0 for eps in {+1, -1}\n"
#define SLIPS  "relation own-slips\n  section: appendix_b\n  u_1 = eps*u_s1 for eps in {+1, -1}\n" SLOWER
#define STICKS                                                                                                         \
  "relation own-sticks\n  section: appendix_b\n  u_1 = x_1(t) - chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) < u_r1\n"
#define BREAKS                                                                                                         \
  "relation own-breaks\n  section: appendix_b\n  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) > "   \
  "u_r1 for eps in {+1, -1}\n"
#define RELATION(id) "relation own-" id "\n  section: appendix_b\n"

static const struct {
  const char *what, *formulas, *mass;
  enum verdict want;
} laws[] = {
    {"the law", SLIPS STICKS BREAKS, "1", VERDICT_PROVED},
    {"the same in other words",
     RELATION("slips") "  eps*u_1 = u_s1 for eps in {+1, -1}\n  eps*x_1'(t) < eps*V for eps in {+1, -1}\n" RELATION(
         "sticks") "  x_1(t) - u_1 = chi*x_2(t)\n"
                   "  x_1(t) < u_r1 + chi*x_2(t)\n  chi*x_2(t) - u_r1 < x_1(t)\n" RELATION(
                       "breaks") "  u_1 = u_s1/eps for eps in "
                                 "{+1, -1}\n  eps*x_1(t) > u_r1 + eps*chi*x_2(t) for eps in {+1, -1}\n",
     "1", VERDICT_PROVED},
    {"friction that drives", RELATION("slips") "  u_1 = -eps*u_s1 for eps in {+1, -1}\n" SLOWER STICKS BREAKS, "1",
     VERDICT_REFUTED},
    {"friction that drives, by the sign of the velocity",
     RELATION(
         "slips") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1'(t) - V) > 0 for eps in {+1, -1}\n" STICKS BREAKS,
     "1", VERDICT_REFUTED},
    {"both signs turned round",
     RELATION("slips") "  u_1 = -eps*u_s1 for eps in {+1, -1}\n  eps*(x_1'(t) - V) > 0 for eps in {+1, -1}\n" STICKS
         RELATION("breaks") "  u_1 = -eps*u_s1 for eps in {+1, -1}\n  -eps*(x_1(t) - chi*x_2(t)) > u_r1 for eps in "
                            "{+1, -1}\n",
     "1", VERDICT_PROVED},
    {"sliding friction at the belt's velocity, too",
     RELATION(
         "slips") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(V - x_1'(t)) >= 0 for eps in {+1, -1}\n" STICKS BREAKS,
     "1", VERDICT_REFUTED},
    {"friction to either side", RELATION("slips") "  u_1 = eps*u_s1 for eps in {+1, -1}\n" STICKS BREAKS, "1",
     VERDICT_REFUTED},
    {"the wrong limit while slipping", RELATION("slips") "  u_1 = eps*u_r1 for eps in {+1, -1}\n" SLOWER STICKS BREAKS,
     "1", VERDICT_REFUTED},
    {"sticks on one side only",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  x_1(t) - chi*x_2(t) < u_r1\n" BREAKS, "1",
     VERDICT_REFUTED},
    {"sticks below the sliding friction",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  -u_s1 < x_1(t) - chi*x_2(t) < u_s1\n" BREAKS, "1",
     VERDICT_REFUTED},
    {"another force while sticking",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) + chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) < u_r1\n" BREAKS, "1",
     VERDICT_REFUTED},
    {"breaks away to the wrong side",
     SLIPS STICKS RELATION(
         "breaks") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  -eps*(x_1(t) - chi*x_2(t)) > u_r1 for eps in "
                   "{+1, -1}\n",
     "1", VERDICT_REFUTED},
    {"may break away where it sticks",
     SLIPS STICKS RELATION("breaks") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) > 0 for eps in "
                                     "{+1, -1}\n",
     "1", VERDICT_REFUTED},
    {"the law of the other mass", SLIPS STICKS BREAKS, "2", VERDICT_REFUTED},
    {"equality at one limit",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) <= u_r1\n" BREAKS, "1",
     VERDICT_PROVED},
    {"two branches at one limit: what the states tried do not show",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) <= u_r1\n" RELATION(
         "breaks") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) >= u_r1 for eps in {+1, -1}\n",
     "1", VERDICT_SUPPORTED},
    {"a limit one part in 10^12 off, nearer than any state tried",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) < u_r1*(1 + 1e-12)\n" BREAKS,
     "1", VERDICT_SUPPORTED},
};

CASE("law", .once = {paper_open, paper_close});

TEST_EACH(branches_of_the_law, COUNT(laws)) {
  char claim[200];
  snprintf(claim, sizeof claim,
           "  kind: law\n  mass: %s\n  slips: own-slips H\n  sticks: own-sticks C\n  breaks: own-breaks C\n",
           laws[_i].mass);
  expect(laws[_i].want, laws[_i].what, laws[_i].formulas, claim);
}

static const struct {
  const char *what, *sticks, *breaks;
  enum verdict want;
} at_limits[] = {
    {"the law leaves both open", "-u_r1 < x_1(t) - chi*x_2(t) < u_r1", ">", VERDICT_REFUTED},
    {"one is left open", "-u_r1 < x_1(t) - chi*x_2(t) <= u_r1", ">", VERDICT_REFUTED},
    {"it sticks at both", "-u_r1 <= x_1(t) - chi*x_2(t) <= u_r1", ">", VERDICT_PROVED},
    {"it breaks away at both", "-u_r1 < x_1(t) - chi*x_2(t) < u_r1", ">=", VERDICT_PROVED},
    {"either at both", "-u_r1 <= x_1(t) - chi*x_2(t) <= u_r1", ">=", VERDICT_REFUTED},
};

TEST_EACH(a_force_at_its_limit, COUNT(at_limits)) {
  char formulas[800];
  snprintf(
      formulas, sizeof formulas,
      SLIPS RELATION("sticks") "  u_1 = x_1(t) - chi*x_2(t)\n  %s\n" RELATION(
          "breaks") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) %s u_r1 for eps in {+1, -1}\n",
      at_limits[_i].sticks, at_limits[_i].breaks);
  expect(at_limits[_i].want, at_limits[_i].what, formulas,
         "  kind: law\n  limits: yes\n  mass: 1\n  slips: own-slips H\n  sticks: own-sticks C\n"
         "  breaks: own-breaks C\n");
}

/* --- What (1) and (2) make of switches and configurations --- */

#define MOVES(first, second)                                                                                           \
  "relation own-moves\n  section: appendix_b\n  trajectory x_1(t), x_2(t)\n  x_1''(t) + x_1(t) - chi*x_2(t) = " first  \
  "\n  x_2''(t) + chi*eta*(x_2(t) - x_1(t)) = " second "\n"
#define LAW          SLIPS STICKS BREAKS MOVES("u_1", "eta*u_2")
#define STATES(last) "  states: eq-54 D, eq-5b Gamma, eq-3d H, " last " C\n"

static const struct {
  const char *what, *formulas, *check;
  enum verdict want;
} mechanics[] = {
    {"slip to stick", LAW, "switches\n  transition: slip to stick", VERDICT_PROVED},
    {"slip to stick where the sticking mass moves on",
     SLIPS RELATION("sticks") "  u_1 = x_1(t) + chi*x_2(t)\n  -u_r1 < x_1(t) - chi*x_2(t) < u_r1\n" BREAKS MOVES(
         "u_1", "eta*u_2"),
     "switches\n  transition: slip to stick", VERDICT_SUPPORTED},
    {"stick to slip", LAW, "switches\n  transition: stick to slip", VERDICT_PROVED},
    {"stick to slip at the sliding friction", LAW, "switches\n  transition: stick to slip\n  limit: u_s",
     VERDICT_REFUTED},
    {"stick to slip where a mass that sticks is accelerated", SLIPS STICKS BREAKS MOVES("u_1", "u_2"),
     "switches\n  transition: stick to slip", VERDICT_SUPPORTED},
    {"stick to slip with a friction that drives on",
     SLIPS STICKS RELATION(
         "breaks") "  u_1 = -eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) > u_r1 for eps "
                   "in {+1, -1}\n" MOVES("u_1", "eta*u_2"),
     "switches\n  transition: stick to slip", VERDICT_SUPPORTED},
    {"sticks or slips", LAW, "modes", VERDICT_PROVED},
    {"a gap between sticking and breaking away",
     SLIPS STICKS RELATION("breaks") "  u_1 = eps*u_s1 for eps in {+1, -1}\n  eps*(x_1(t) - chi*x_2(t)) > u_r1*1.125 "
                                     "for eps in {+1, -1}\n" MOVES("u_1", "eta*u_2"),
     "modes", VERDICT_SUPPORTED},
    {"jumps", LAW, "jumps", VERDICT_PROVED},
    {"sliding friction as large as static",
     RELATION("slips") "  u_1 = eps*u_r1 for eps in {+1, -1}\n" SLOWER STICKS BREAKS MOVES("u_1", "eta*u_2"), "jumps",
     VERDICT_REFUTED},
    {"linear", LAW, "linear", VERDICT_PROVED},
    {"linear with a damper", SLIPS STICKS BREAKS MOVES("u_1 - 2*x_1'(t)", "eta*u_2"), "linear", VERDICT_PROVED},
    {"a cubic spring", SLIPS STICKS BREAKS MOVES("u_1 - x_1(t)^3/1000", "eta*u_2"), "linear", VERDICT_REFUTED},
    {"an acceleration without a value", SLIPS STICKS BREAKS MOVES("u_1 + sin(x_1(t))", "eta*u_2"), "linear",
     VERDICT_UNKNOWN},
    {"closed forms", LAW, "closed-forms", VERDICT_CONDITIONAL},
    {"an equilibrium that cannot be read", LAW "define own-d\n  section: prediction\n  d_02 := chi[1,2]\n",
     "closed-forms", VERDICT_REFUTED},
    {"closed forms of another system", SLIPS STICKS BREAKS MOVES("u_1", "u_2"), "closed-forms", VERDICT_REFUTED},
    {"a patched solution", LAW, "fixed-points\n" STATES("eq-7b"), VERDICT_PROVED},
    {"without the limits of a mass that sticks", LAW, "fixed-points\n" STATES("eq-7b#2"), VERDICT_SUPPORTED},
    {"without the velocity of a mass that slips", LAW, "fixed-points\n" STATES("eq-7b#3"), VERDICT_SUPPORTED},
};

TEST_EACH(mechanics_of_the_law, COUNT(mechanics)) {
  char claim[800];
  snprintf(claim, sizeof claim,
           "  kind: behaviour\n  check: %s\n  depends-on: first, second\n\n"
           "claim first\n  section: model\n  title: m_1\n  kind: law\n  mass: 1\n  moves: own-moves#2 D\n"
           "  slips: own-slips H\n  sticks: own-sticks C\n  breaks: own-breaks C\n\n"
           "claim second\n  section: model\n  title: m_2\n  kind: law\n  mass: 2\n  moves: own-moves#3 D\n"
           "  slips: eq-2#2, eq-2#4 H\n  sticks: eq-2d Gamma\n  breaks: eq-2e Gamma\n",
           mechanics[_i].check);
  expect(mechanics[_i].want, mechanics[_i].what, mechanics[_i].formulas, claim);
}

/* --- Points --- */

static struct num_ctx balls(void) {
  return num_ctx_arb(FIRST_PREC);
}

static void bind(arb_t z, struct values *v, const char *name) {
  bool known;
  ck_assert_msg(values_bind(z, &known, v, name) == SS_OK && known, "%s", name);
}

/* m omega_3^2 x'' + k x + k_between (x - x_other) = F */
static void newton(struct values *v, const char *const name[6]) {
  arb_ptr w = _arb_vec_init(9);
  for (int i = 0; i < 6; i++) bind(w + i, v, name[i]);
  bind(w + 6, v, "omega_3");
  bind(w + 7, v, "k_2");
  arb_mul(w, w, w + 6, FIRST_PREC);
  arb_mul(w, w, w + 6, FIRST_PREC);
  arb_mul(w, w, w + 1, FIRST_PREC);
  arb_sub(w, w, w + 5, FIRST_PREC);
  if (name[4][0] == 'k') arb_addmul(w, w + 4, w + 2, FIRST_PREC);
  arb_sub(w + 8, w + 2, w + 3, FIRST_PREC);
  arb_addmul(w, w + 7, w + 8, FIRST_PREC);
  ck_assert_msg(arb_contains_zero(w) && mag_cmp_2exp_si(arb_radref(w), -80) < 0, "%s", name[0]);
  for (int i = 0; i < 2; i++) ck_assert(arb_is_positive(w + 6 + i));
  _arb_vec_clear(w, 9);
}

/* Newton's law for the blocks, in the time before scaling, along motions of every phase. */
TEST_EACH(blocks_obey_newton, N_PHASES) {
  static const char *const name[2][6] = {{"m_1", "x_1''(t)", "x_1(t)", "x_2(t)", "k_1", "F_1"},
                                         {"m_2", "x_2''(t)", "x_2(t)", "x_1(t)", "V", "F_2"}};
  struct sampler s;
  LOCAL(point, p);
  sampler_init(&s, "blocks", &(struct point_spec){.kind = POINT_FLOW, .phase = (enum phase)_i});
  for (int n = 0; n < 4; n++) {
    OWNED(values) v;
    sampler_next(&p, &s);
    ck_assert(values_init(&v, &p, n % 2 ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, balls(), the_paper.cache) == SS_OK);
    for (int mass = 0; mass < 2; mass++) newton(&v, name[mass]);
  }
}

/* Closed forms and exponentials carry a patched state alike; nothing on the way is V, and no two perturbations agree
   but those that are zero. */
TEST(patched_states_are_general) {
  static const char *const tangent[] = {"x",   "y",   "u",   "v",   "x_a", "y_a", "u_a", "v_a", "x_b", "y_b",
                                        "u_b", "v_b", "x_c", "y_c", "u_c", "v_c", "x_f", "y_f", "u_f", "v_f"};
  struct sampler s;
  LOCAL(point, p);
  sampler_init(&s, "patched", &(struct point_spec){.kind = POINT_PATCHED, .phase = PHASE_C});
  for (int n = 0; n < 6; n++) {
    struct values v[2];
    NUMBERS(arb, belt);
    arb_t x[COUNT(tangent)];
    sampler_next(&p, &s);
    for (int k = 0; k < 2; k++)
      ck_assert(values_init(&v[k], &p, k ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, balls(), the_paper.cache) == SS_OK);
    arb_set_fmpq(belt, &p.q[Q_V], FIRST_PREC);
    for (int i = 0; i < 4 * (N_PHASES + 1); i++) {
      ck_assert(arb_overlaps(num_vec_at(&v[0].arc.z, i), num_vec_at(&v[1].arc.z, i)));
      ck_assert(i % 4 < 2 || fmpq_equal(&p.q[Q_DZ1], &p.q[Q_V]) || fmpq_equal(&p.q[Q_DZ2], &p.q[Q_V]) ||
                !arb_overlaps(num_vec_at(&v[0].arc.z, i), belt));
    }
    for (int i = 0; i < COUNT(tangent); i++) {
      arb_init(x[i]);
      bind(x[i], &v[0], tangent[i]);
      bool zero = i == 6 || i == 7 || i == 11 || i == 18; /* (25), (30), (38) */
      ck_assert_msg((arb_is_zero(x[i]) != 0) == zero || fmpq_is_zero(&p.q[Q_X]) || fmpq_is_zero(&p.q[Q_Y]), "%s",
                    tangent[i]);
      for (int k = 0; k < i; k++) ck_assert(zero || arb_is_zero(x[i]) || !arb_equal(x[i], x[k]));
    }
    for (int i = 0; i < COUNT(tangent); i++) arb_clear(x[i]);
    for (int k = 0; k < 2; k++) values_clear(&v[k]);
  }
}

/* Every u_ri exceeds e_i and what the orbit asks by a quarter or a 1024th, and by no more than the grid; both occur. */
TEST(realistic_friction_is_above_what_is_asked) {
  struct sampler s;
  LOCAL(point, p);
  long seen = 0, few = 0;
  sampler_init(&s, "realistic", &(struct point_spec){.kind = POINT_ORBIT, .admissible = true, .realistic = true});
  for (int draws = 0; draws < 40 && seen < 6; draws++) {
    sampler_next(&p, &s);
    if (!point_settle(&p, the_paper.cache)) continue;
    const struct dyn_orbit *o = &point_orbits(&p, the_paper.cache, FIRST_PREC)->orbit[p.orbit];
    ck_assert(o->admissible == TRUTH_TRUE);
    for (int i = 0; i < 2; i++) {
      double e = fmpq_get_d(&p.q[Q_E1 + i]), u_r = fmpq_get_d(&p.q[Q_US1 + i]) + e;
      double least = num_arb.get_d(i ? o->u_r2_min : o->u_r1_min);
      if (least < e) least = e;
      double above = u_r > 1.1 * least ? 1.25 : 1025.0 / 1024;
      ck_assert(u_r >= above * least - 1e-12 && u_r <= above * least + 1.0 / 1024 + 1e-12);
      few += above < 1.25;
    }
    seen++;
  }
  ck_assert_int_eq(seen, 6);
  ck_assert(few > 0 && few < 12);
}

/* --- Arguments both ways, ranges, counts --- */

static const struct {
  const char *what, *formulas, *claim;
  enum verdict want;
} sentences[] = {
    {"a weaker conclusion follows", "inequality own-weak\n  section: appendix_b\n  e_2 - 3*u_r2 < h(t_a) < e_2\n",
     "  kind: argument\n  premises: eq-52#2, text-h-start\n  conclusion: own-weak\n", VERDICT_PROVED},
    {"but does not give its premises back",
     "inequality own-weak\n  section: appendix_b\n  e_2 - 3*u_r2 < h(t_a) < e_2\n",
     "  kind: argument\n  premises: eq-52#2, text-h-start\n  conclusion: own-weak\n  converse: yes\n", VERDICT_REFUTED},
    {"the same in other units", "inequality own-same\n  section: appendix_b\n  2*t_a > 0\n",
     "  kind: argument\n  premises: eq-51#1\n  conclusion: own-same\n  converse: yes\n", VERDICT_PROVED},
    {"equations among the premises serve both ways", "",
     "  kind: argument\n  premises: eq-58, text-h-start\n  conclusion: eq-52#2\n  converse: yes\n", VERDICT_PROVED},
    {"a stronger conclusion follows backwards alone", "inequality own-strong\n  section: appendix_b\n  t_a > 1\n",
     "  kind: argument\n  premises: eq-51#1\n  conclusion: own-strong\n  converse: yes\n", VERDICT_REFUTED},
    {"a moment of a phase", "", "  kind: argument\n  premises: text-c-start C, eq-7b#3 C\n  conclusion: eq-16b\n",
     VERDICT_PROVED},
    {"but not of two", "", "  kind: argument\n  premises: text-c-start C, eq-7b#3 Gamma\n  conclusion: eq-16b\n",
     VERDICT_UNKNOWN},
    {"a range that is a phase",
     "inequality own-range\n  section: appendix_b\n  z_1'(t) < V for t in (t_a, t_a + t_b)\n",
     "  kind: argument\n  premises: eq-5b#1 Gamma\n  conclusion: own-range\n", VERDICT_PROVED},
    {"one that begins too early",
     "inequality own-range\n  section: appendix_b\n  z_1'(t) < V for t in (0, t_a + t_b)\n",
     "  kind: argument\n  premises: eq-5b#1 Gamma\n  conclusion: own-range\n", VERDICT_REFUTED},
    {"one that ends too late",
     "inequality own-range\n  section: appendix_b\n  z_1'(t) < V for t in (t_a, t_a + t_b + t_c)\n",
     "  kind: argument\n  premises: eq-5b#1 Gamma\n  conclusion: own-range\n", VERDICT_REFUTED},
    {"an unknown that is there", "", "  kind: rank\n  statement: eq-12b\n  unknowns: z_1a\n  rank: 1\n",
     VERDICT_PROVED},
    {"a product of positive factors",
     "inequality own-sign\n  section: periodic\n  z_10 - chi*z_20 < z_1(t) - chi*z_2(t)\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_PROVED},
    {"the time to the end of the phase",
     "inequality own-sign\n  section: periodic\n  (1 - chi)^3*(t_a - t)*V/(eta*chi^2) > 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_PROVED},
    {"both at once",
     "inequality own-sign\n  section: periodic\n  0 < z_1(t) - chi*z_2(t) - z_10 + chi*z_20 < e_1 - z_10 + chi*z_20\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_PROVED},
    {"the other way round", "inequality own-sign\n  section: periodic\n  z_10 - chi*z_20 > z_1(t) - chi*z_2(t)\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_REFUTED},
    {"a negative factor", "inequality own-sign\n  section: periodic\n  (1 - chi)*(t - t_a) < 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_PROVED},
    {"two negative ones", "inequality own-sign\n  section: periodic\n  (chi - 1)*(t - t_a) < 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_REFUTED},
    {"a sum of positive terms is no product",
     "inequality own-sign\n  section: periodic\n  z_1(t) - chi*z_2(t) < e_1 + t\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_SUPPORTED},
    {"a time that is not counted from the phase's start", "inequality own-sign\n  section: periodic\n  t > 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs Gamma 4\n  routes: exponential\n", VERDICT_SUPPORTED},
    {"nor to its end", "inequality own-sign\n  section: periodic\n  (t_a + t_b - t)*V > 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs Gamma 4\n  routes: exponential\n", VERDICT_PROVED},
    {"a square is zero somewhere", "inequality own-sign\n  section: periodic\n  (V - 1 - 1e-9*eta)^2*chi > 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_SUPPORTED},
    {"a factor one part in 10^90 off", "inequality own-sign\n  section: periodic\n  (t_a - t + 1e-90)*V > 0\n",
     "  kind: identity\n  statement: own-sign\n  points: arcs D 4\n  routes: exponential\n", VERDICT_SUPPORTED},
    {"one that is not there has a derivative of zero", "",
     "  kind: rank\n  statement: eq-12b\n  unknowns: t_b\n  rank: 1\n", VERDICT_REFUTED},
    {"an equation that says nothing", "equation own-empty\n  section: appendix_b\n  x_b = x_b\n",
     "  kind: rank\n  statement: own-empty\n  unknowns: x_b, y_b\n  rank: 1\n", VERDICT_REFUTED},
    {"true where both velocities are V, not of every state",
     "equation own-swap\n  section: appendix_b\n  [z'_2a; z'_1a] = [z'_10; z'_20]\n",
     "  kind: identity\n  statement: own-swap\n  points: arcs 4, patched 4\n  routes: exponential\n", VERDICT_REFUTED},
    {"the same without such states", "equation own-swap\n  section: appendix_b\n  [z'_2a; z'_1a] = [z'_10; z'_20]\n",
     "  kind: identity\n  statement: own-swap\n  points: arcs 4\n  routes: exponential\n", VERDICT_PROVED},
};

TEST_EACH(sentences_known_by_hand, COUNT(sentences)) {
  expect(sentences[_i].want, sentences[_i].what, sentences[_i].formulas, sentences[_i].claim);
}
