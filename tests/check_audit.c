/* The audit from the inside: the table from evidence to verdict, scenes, points and what the paper's symbols are worth
   there, the model's matrices, and claims under equation files that the tests damage or repair.

   The second opinion is a model of its own in long double (the section "Plain"): the equations of motion (1) as a
   first-order system, its exponential by a Taylor series, events by Newton's method, derivatives by differences. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "judge/judge.h"
#include "paper_model.h"
#include "rational.h"
#include "report/report.h"
#include "route/jacobian.h"
#include "run/audit.h"
#include "scratch.h"
#include "suites.h"
#include "value/expression.h"
#include "value/title.h"
#include "whole.h"

typedef long double real;

/* --- Verdicts --- */

/* What must hold of every verdict, said of the evidence alone. */
static void check_verdict(const struct route_result *w, int n, bool whole) {
  bool all_agree = true, a_decisive_agrees = false, a_certificate = false, another_agrees = false, two_kinds = false;
  char shown[200] = "";
  for (int i = 0; i < n; i++) {
    bool agrees = w[i].trials > 0 && w[i].outcome == ROUTE_AGREES,
         differs = w[i].trials > 0 && w[i].outcome == ROUTE_DIFFERS;
    all_agree = all_agree && agrees;
    a_decisive_agrees = a_decisive_agrees || (w[i].decisive && agrees);
    a_certificate = a_certificate || (w[i].decisive && differs);
    another_agrees = another_agrees || (!w[i].decisive && agrees);
    two_kinds = two_kinds || strcmp(w[i].route, w[0].route) != 0;
    size_t at = strlen(shown);
    snprintf(shown + at, sizeof shown - at, "%s%s says %d after %ld, ", w[i].route, w[i].decisive ? " (decisive)" : "",
             (int)w[i].outcome, w[i].trials);
  }
  enum verdict v = verdict_of(w, n, whole);
  bool success = n > 0 && all_agree && a_decisive_agrees;
  enum verdict want = VERDICT_UNKNOWN;
  if (a_certificate && !another_agrees) want = VERDICT_REFUTED;
  if (success && whole) want = VERDICT_PROVED;
  if (success && !whole && two_kinds) want = VERDICT_SUPPORTED;
  ck_assert_msg(v == want, "%swhole %d: %s, not %s", shown, whole, verdict_name[v], verdict_name[want]);
}

START_TEST(every_row_of_the_verdict_table) {
  static const char *const names[] = {"balls", "fd", "taylor"};
  enum { STATES = 16 }; /* four words, no trials or some, decisive or not */
  check_verdict(NULL, 0, false);
  check_verdict(NULL, 0, true);
  for (int n = 1, combinations = STATES; n <= 3; n++, combinations *= STATES)
    for (int c = 0; c < combinations; c++)
      for (int whole = 0; whole < 2; whole++) {
        struct route_result w[3];
        for (int i = 0, rest = c; i < n; i++, rest /= STATES)
          w[i] = (struct route_result){names[i], (enum route_outcome)(rest % 4), rest / 4 % 2, rest / 8 % 2 ? 7 : 0};
        check_verdict(w, n, whole);
        for (int i = 0; i < n; i++) w[i].route = "balls";
        check_verdict(w, n, whole);
      }
}
END_TEST

START_TEST(routes_that_share_their_reasoning_count_once) {
  static const char *const names[] = {"balls", "oracle", "exponential", "taylor",    "gsl",         "ode",
                                      "fd",    "newton", "saltation",   "iteration", "integration", "motion"};
  enum { N = sizeof names / sizeof *names };
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < N; k++)
      for (int outcome = ROUTE_NOTHING; outcome <= ROUTE_UNDECIDED; outcome++) {
        struct route_result w[] = {{names[i], ROUTE_AGREES, true, 1},
                                   {names[k], (enum route_outcome)outcome, false, 1}};
        int want = outcome == ROUTE_AGREES && i != k ? 2 : 1;
        ck_assert_msg(independent_routes(w, 2) == want, "%s and %s saying %d", names[i], names[k], outcome);
      }
  }
  ck_assert_int_eq(independent_routes(NULL, 0), 0);
  struct route_result same_text[] = {{"balls", ROUTE_AGREES, true, 1}, {"algebra", ROUTE_AGREES, true, 1}};
  ck_assert_int_eq(independent_routes(same_text, 2), 1); /* both read the paper's formulas */
}
END_TEST

START_TEST(selection_by_id) {
  static const struct {
    const char *id, *item;
    bool want;
  } cases[] = {{"eq-27", "eq-27", true},        {"eq-27b", "eq-27", true},      {"eq-27-V1", "eq-27", true},
               {"eq-27b-V1", "eq-27", true},    {"eq-270", "eq-27", false},     {"eq-2", "eq-27", false},
               {"eq-27", "eq-27b", false},      {"eq-27b-V1", "eq-27b", true},  {"eq-27bc", "eq-27", false},
               {"num-t_a", "num-t_a", true},    {"num-t_ab", "num-t_a", false}, {"num-t_a", "num-t_b", false},
               {"num-t_a", "num-t_", false},    {"num-z10", "num-z1", false},   {"text-periodic", "text-period", false},
               {"text-periodic", "text", true}, {"eq-27", "e", false},          {"eq-27", "", false}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    ck_assert_msg(claim_selected(cases[i].id, cases[i].item) == cases[i].want, "\"%s\" selects %s: %s", cases[i].item,
                  cases[i].id, cases[i].want ? "no" : "yes");
}
END_TEST

START_TEST(sizes_as_powers_of_ten) {
  static const struct {
    double log2x;
    const char *want;
  } cases[] = {{-INFINITY, "0"}, {0, "1e0"}, {3, "1e1"}, {3.4, "1e2"}, {-3.4, "1e-1"}, {-10, "1e-3"}, {-127, "1e-38"}};
  struct audit_result r;
  audit_result_init(&r);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    ck_assert_str_eq(order_of_magnitude(&r, cases[i].log2x), cases[i].want);
  audit_result_clear(&r);
}
END_TEST

/* --- Scenes --- */

#define REST "eta = 1\nV = 1\ne1 = 2\ne2 = 1\n"

static bool load_text(struct scene *s, struct diag *d, const char *text) {
  diag_init(d);
  return scene_load(s, scratch_put("case.scene", text), "no-such-folder", d);
}

START_TEST(scenes_are_exact) {
  struct scene s;
  struct diag d;
  ck_assert_msg(load_text(&s, &d,
                          "# a comment\ntitle: exact\nchi = 0.8\neta = (1 + 1/3)^3/(10 - 7.5)\nV = 1e-12\n"
                          "e1 = 12345678901234567890.123456789\ne2 = 3*2^(-3)\nu_r2 = -(-2.5)\n"),
                "%s", d.message);
  is_rational(&s.value[KEY_CHI], "4/5");
  is_rational(&s.value[KEY_ETA], "128/135");
  is_rational(&s.value[KEY_V], "1/1000000000000");
  is_rational(&s.value[KEY_E1], "12345678901234567890123456789/1000000000");
  is_rational(&s.value[KEY_E2], "3/8");
  is_rational(&s.value[KEY_U_R2], "5/2");
  ck_assert(s.given[KEY_E2] && s.given[KEY_U_R2] && !s.given[KEY_U_R1]);
  ck_assert_str_eq(s.title, "exact");
  ck_assert_str_eq(s.name, "case");
  scene_clear(&s);
}
END_TEST

START_TEST(line_ends_marks_and_blanks_do_not_matter) {
  static const char *const texts[] = {("chi = 0.8\r\neta = 1\r\nV = 1\r\ne1 = 2\r\ne2 = 1\r\n"),
                                      ("\xEF\xBB\xBF"
                                       "chi = 0.8\n" REST),
                                      ("chi = 0.8\n" REST "\n\n  # the end"),
                                      ("chi =\n    4\n    /5 # four fifths\n" REST),
                                      ("chi = 0.8\neta = 1\nV = 1\ne1 = 2\ne2 = 1")};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    struct scene s;
    struct diag d;
    ck_assert_msg(load_text(&s, &d, texts[i]), "text %zu: %s", i, d.message);
    is_rational(&s.value[KEY_CHI], "4/5");
    is_rational(&s.value[KEY_E2], "1");
    scene_clear(&s);
  }
}
END_TEST

START_TEST(the_last_printed_digit) {
  static const struct {
    const char *decimal, *value, *unit;
  } cases[] = {{"0.6784", "6784/10000", "1/10000"},
               {"2", "2", "1"},
               {"-2.1958", "-21958/10000", "1/10000"},
               {"1.50", "3/2", "1/100"},
               {"120", "120", "1"},
               {".5", "1/2", "1/10"},
               {"1e5", "100000", "100000"},
               {"2.5e-3", "1/400", "1/10000"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[200];
    struct scene s;
    struct diag d;
    snprintf(text, sizeof text, "chi = 0.8\n" REST "printed: x_1 = %s\n", cases[i].decimal);
    ck_assert_msg(load_text(&s, &d, text), "%s", d.message);
    const struct printed_number *p = scene_printed(&s, "x_1");
    ck_assert(p != NULL && scene_printed(&s, "x_2") == NULL);
    ck_assert_str_eq(p->decimal, cases[i].decimal);
    is_rational(&p->value, cases[i].value);
    is_rational(&p->unit, cases[i].unit);
    scene_clear(&s);
  }
}
END_TEST

START_TEST(a_decimal_is_read_rounded_or_cut_off) {
  static const struct {
    const char *decimal, *x;
    truth fits;
    enum reading how;
  } cases[] = {{"0.6784", "0.67834999", TRUTH_FALSE, 0},
               {"0.6784", "0.67835001", TRUTH_TRUE, READ_ROUNDED},
               {"0.6784", "0.67844999", TRUTH_TRUE, READ_ROUNDED},
               {"0.6784", "0.67845001", TRUTH_TRUE, READ_TRUNCATED},
               {"0.6784", "0.67849999", TRUTH_TRUE, READ_TRUNCATED},
               {"0.6784", "0.67850001", TRUTH_FALSE, 0},
               {"-2.1958", "-2.19574999", TRUTH_FALSE, 0},
               {"-2.1958", "-2.19575001", TRUTH_TRUE, READ_ROUNDED},
               {"-2.1958", "-2.19584999", TRUTH_TRUE, READ_ROUNDED},
               {"-2.1958", "-2.19589999", TRUTH_TRUE, READ_TRUNCATED},
               {"-2.1958", "-2.19590001", TRUTH_FALSE, 0},
               {"0.6784", "0.67835 +/- 1e-9", TRUTH_UNKNOWN, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[200];
    struct scene s;
    struct diag d;
    arb_t x, whole;
    arb_init(x);
    arb_init(whole);
    snprintf(text, sizeof text, "chi = 0.8\n" REST "printed: q = %s\n", cases[i].decimal);
    ck_assert_msg(load_text(&s, &d, text), "%s", d.message);
    ck_assert(arb_set_str(x, cases[i].x, 200) == 0);
    enum reading how = N_READINGS;
    truth fits = printed_fits(x, scene_printed(&s, "q"), &how);
    printed_ball(whole, scene_printed(&s, "q"));
    ck_assert_msg(fits == cases[i].fits, "%s as %s: %d", cases[i].x, cases[i].decimal, (int)fits);
    if (fits == TRUTH_TRUE) ck_assert_int_eq(how, cases[i].how);
    if (fits != TRUTH_UNKNOWN) ck_assert_int_eq(arb_overlaps(whole, x), fits == TRUTH_TRUE);
    scene_clear(&s);
    arb_clear(whole);
    arb_clear(x);
  }
}
END_TEST

/* --- Plain: the model once more, in long double --- */

struct plain {
  real chi, eta, v, e1, e2;
};

/* (1) with z measured from the equilibrium; a mass that sticks keeps its velocity. */
static void plain_system(real a[16], const struct plain *p, int ph) {
  bool slips1 = ph == PHASE_GAMMA || ph == PHASE_H, slips2 = ph == PHASE_H || ph == PHASE_C;
  for (int i = 0; i < 16; i++) a[i] = 0;
  a[2] = a[7] = 1;
  if (slips1) {
    a[8] = -1;
    a[9] = p->chi;
  }
  if (slips2) {
    a[12] = p->chi * p->eta;
    a[13] = -p->chi * p->eta;
  }
}

static void plain_product(real *z, const real *x, const real *y, int m, int n, int p) {
  real w[16];
  for (int i = 0; i < m; i++)
    for (int j = 0; j < p; j++) {
      w[i * p + j] = 0;
      for (int k = 0; k < n; k++) w[i * p + j] += x[i * n + k] * y[k * p + j];
    }
  memcpy(z, w, (size_t)(m * p) * sizeof *z);
}

/* exp(A t): Taylor at t/2^n, squared n times. */
static void plain_propagator(real phi[16], const struct plain *p, int ph, real t) {
  enum { TERMS = 24, HALVINGS = 10 };
  real a[16], term[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  plain_system(a, p, ph);
  for (int i = 0; i < 16; i++) a[i] *= t / (1 << HALVINGS);
  memcpy(phi, term, sizeof term);
  for (int k = 1; k <= TERMS; k++) {
    plain_product(term, term, a, 4, 4, 4);
    for (int i = 0; i < 16; i++) phi[i] += term[i] /= k;
  }
  for (int k = 0; k < HALVINGS; k++) plain_product(phi, phi, phi, 4, 4, 4);
}

static void plain_flow(real out[4], const struct plain *p, int ph, const real z[4], real t) {
  real phi[16];
  plain_propagator(phi, p, ph, t);
  plain_product(out, phi, z, 4, 4, 1);
}

static real plain_switching(const struct plain *p, int ph, const real z[4]) {
  switch (ph) {
  case PHASE_D:
    return z[0] - p->chi * z[1] - p->e1;
  case PHASE_GAMMA:
    return p->chi * (z[1] - z[0]) - p->e2;
  case PHASE_H:
    return z[2] - p->v;
  default:
    return z[3] - p->v;
  }
}

/* z to the end of its phase, near time t, which is returned: Newton with the slope from a central difference. */
static real plain_end(real z[4], const struct plain *p, int ph, real t) {
  for (int k = 0; k < 8; k++) {
    real at[4], before[4], after[4], h = 1e-6L;
    plain_flow(at, p, ph, z, t);
    plain_flow(before, p, ph, z, t - h);
    plain_flow(after, p, ph, z, t + h);
    t -= plain_switching(p, ph, at) * 2 * h / (plain_switching(p, ph, after) - plain_switching(p, ph, before));
  }
  plain_flow(z, p, ph, z, t);
  return t;
}

/* The derivative of the map from z to the end of phases from..to (each near its time in t) along dz: central
   differences at h and h/2, extrapolated. */
static void plain_derivative(real out[4], const struct plain *p, int from, int to, const real z[4], const real dz[4],
                             const real t[4]) {
  real d[2][4];
  for (int k = 0; k < 2; k++) {
    real h = k ? 1e-4L / 2 : 1e-4L, end[2][4];
    for (int side = 0; side < 2; side++) {
      for (int i = 0; i < 4; i++) end[side][i] = z[i] + (side ? h : -h) * dz[i];
      for (int ph = from; ph <= to; ph++) plain_end(end[side], p, ph, t[ph]);
    }
    for (int i = 0; i < 4; i++) d[k][i] = (end[1][i] - end[0][i]) / (2 * h);
  }
  for (int i = 0; i < 4; i++) out[i] = (4 * d[1][i] - d[0][i]) / 3;
}

static real real_of(const fmpq_t q) {
  return (real)fmpz_get_d(fmpq_numref(q)) / (real)fmpz_get_d(fmpq_denref(q));
}

static struct plain plain_of(const struct point *p) {
  return (struct plain){real_of(&p->q[Q_CHI]), real_of(&p->q[Q_ETA]), real_of(&p->q[Q_V]), real_of(&p->q[Q_E1]),
                        real_of(&p->q[Q_E2])};
}

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
enum { N_SAMPLED = sizeof sampled / sizeof *sampled, DRAWN = 100 };

START_TEST(an_id_has_its_own_points) {
  struct sampler once, again, other;
  struct point a, b, c, last;
  point_init(&a);
  point_init(&b);
  point_init(&c);
  point_init(&last);
  sampler_init(&once, "eq-27", &(struct point_spec){.kind = sampled[_i].kind, .phase = sampled[_i].phase});
  sampler_init(&again, "eq-27", &(struct point_spec){.kind = sampled[_i].kind, .phase = sampled[_i].phase});
  sampler_init(&other, "eq-28", &(struct point_spec){.kind = sampled[_i].kind, .phase = sampled[_i].phase});
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
  point_clear(&last);
  point_clear(&c);
  point_clear(&b);
  point_clear(&a);
}
END_TEST

static int compare(const fmpq_t x, slong p, ulong q) {
  fmpq_t y;
  fmpq_init(y);
  fmpq_set_si(y, p, q);
  int c = fmpq_cmp(x, y);
  fmpq_clear(y);
  return c;
}

START_TEST(points_lie_in_the_domain) {
  for (int r = -1; r < n_restrictions; r++) {
    struct sampler s;
    struct point p;
    point_init(&p);
    const struct point_spec spec = {sampled[_i].kind, sampled[_i].phase,
                                    .restriction = r < 0 ? NULL : &restrictions[r]};
    sampler_init(&s, "domain", &spec);
    for (int i = 0; i < DRAWN; i++) {
      struct text at;
      text_init(&at);
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
      text_clear(&at);
    }
    point_clear(&p);
  }
}
END_TEST

/* --- What the symbols are worth --- */

static void value_of(arb_t x, struct values *v, const char *name) {
  bool known;
  int s = values_bind(x, &known, v, name);
  ck_assert_msg(known && s == SS_OK && arb_is_finite(x), "%s has no value", name);
}

static real number(struct values *v, const char *name) {
  arb_t x;
  arb_init(x);
  value_of(x, v, name);
  real r = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  arb_clear(x);
  return r;
}

/* left - sum of factor[i] * right[i] contains 0 and is narrow. */
static void vanishes(struct values *v, const char *left, int n, const real *factor, const char *const *right) {
  real sum = number(v, left), scale = 1 + fabsl(sum);
  for (int i = 0; i < n; i++) {
    real term = factor[i] * number(v, right[i]);
    sum -= term;
    scale += fabsl(term);
  }
  struct text at;
  text_init(&at);
  point_print(&at, v->point);
  ck_assert_msg(fabsl(sum) < 1e-14L * scale, "%s is off by %Lg at %s", left, sum, text_str(&at));
  text_clear(&at);
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
      real want = arf_get_d(arb_midref((arb_srcptr)num_vec_at(&v->arc.z, 4 * (ph + 1) + i)), ARF_RND_NEAR);
      ck_assert_msg(fabsl(z[i] - want) < 1e-11L * (1 + fabsl(want)), "component %d after phase %d", i, ph);
    }
  }
}

enum { ARC_DRAWS = 12 };

/* Opens values on arc n of the test's own stream; false when it has no such arc. */
static bool open_arc(struct values *v, struct point *p, int n, enum variant variant, struct num_ctx ctx) {
  struct sampler s;
  sampler_init(&s, "check_audit", &(struct point_spec){.kind = POINT_ARC, .phase = (enum phase)(n % N_PHASES)});
  for (int i = 0; i <= n; i++) sampler_next(p, &s);
  return values_init(v, p, variant, ctx, the_paper.cache) == SS_OK;
}

START_TEST(arcs_obey_the_papers_conditions) {
  int accepted = 0;
  for (int n = 0; n < ARC_DRAWS; n++) {
    struct values v;
    struct point p;
    point_init(&p);
    if (open_arc(&v, &p, n, _i ? VARIANT_EXPONENTIAL : VARIANT_CLOSED, num_ctx_arb(FIRST_PREC))) {
      accepted++;
      check_arc_facts(&v);
      check_arc_against_plain(&v);
    }
    values_clear(&v);
    point_clear(&p);
  }
  ck_assert_msg(2 * accepted >= ARC_DRAWS, "only %d arcs of %d", accepted, ARC_DRAWS);
}
END_TEST

START_TEST(orbits_close) {
  struct point p;
  struct values v;
  point_init(&p);
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
    char name[100];
    snprintf(name, sizeof name, "%s%s", component[i], end);
    SAME(&v, name, start[i]);
  }
  values_clear(&v);
  point_clear(&p);
}
END_TEST

/* The tangents belonging to (x, y), (x, 0) and (0, y) add up. */
START_TEST(tangents_are_linear) {
  static const char *const names[] = {"x_a", "y_a", "x_b", "y_b", "u_b", "x_c", "y_c", "v_c", "x_f", "y_f"};
  int accepted = 0;
  for (int n = 0; n < ARC_DRAWS; n++) {
    real t[3][10] = {{0}};
    bool ok = true;
    for (int k = 0; k < 3; k++) {
      struct sampler s;
      struct values v;
      struct point p;
      point_init(&p);
      sampler_init(&s, "check_audit", &(struct point_spec){.kind = POINT_ARC});
      for (int i = 0; i <= n; i++) sampler_next(&p, &s);
      if (k == 1) fmpq_zero(&p.q[Q_Y]);
      if (k == 2) fmpq_zero(&p.q[Q_X]);
      ok = values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC), the_paper.cache) == SS_OK;
      for (int i = 0; ok && i < 10; i++) t[k][i] = number(&v, names[i]);
      values_clear(&v);
      point_clear(&p);
    }
    accepted += ok;
    for (int i = 0; ok && i < 10; i++) {
      real scale = 1 + fabsl(t[1][i]) + fabsl(t[2][i]);
      ck_assert_msg(fabsl(t[0][i] - t[1][i] - t[2][i]) < 1e-13L * scale, "%s on arc %d", names[i], n);
    }
  }
  ck_assert(2 * accepted >= ARC_DRAWS);
}
END_TEST

START_TEST(flows_solve_their_equations) {
  for (int n = 0; n < 8; n++)
    for (int ph = 0; ph < N_PHASES; ph++) {
      struct sampler s;
      struct point p;
      struct values v;
      point_init(&p);
      sampler_init(&s, "check_audit", &(struct point_spec){.kind = POINT_FLOW, .phase = (enum phase)ph});
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
      values_clear(&v);
      point_clear(&p);
    }
}
END_TEST

START_TEST(names_without_a_value_are_told_apart) {
  static const char *const strangers[] = {"z_1(t_a + dt_a)", "foo",       "z_3a", "x_e",
                                          "z_1(t_c)",        "z_1'''(t)", "chi2", "foo[1,1]",
                                          "J_a[1,3]",        "J_a[2,1]",  "z_100"};
  struct values v;
  struct point p;
  point_init(&p);
  int n = 0;
  while (!open_arc(&v, &p, n, VARIANT_CLOSED, num_ctx_arb(FIRST_PREC))) {
    values_clear(&v);
    ck_assert(++n < ARC_DRAWS);
  }
  arb_t x;
  arb_init(x);
  for (size_t i = 0; i < sizeof strangers / sizeof *strangers; i++) {
    bool known = true;
    int s = values_bind(x, &known, &v, strangers[i]);
    ck_assert_msg(!known && s != SS_OK, "%s has a value on an arc", strangers[i]);
  }
  arb_clear(x);
  values_clear(&v);
  point_clear(&p);
}
END_TEST

/* --- The model's matrices --- */

static void oracle_is(struct values *v, const char *name, int rows, int cols, const real *want, real tolerance) {
  const struct oracle *o = oracle_find(name);
  ck_assert_msg(o && o->rows == rows && o->cols == cols, "%s has another shape", name);
  struct num_vec m;
  num_vec_init(&m, rows * cols, v->ctx);
  ck_assert_msg(oracle_eval(&m, o, v) == SS_OK, "%s cannot be had", name);
  real scale = 1;
  for (int i = 0; i < rows * cols; i++) scale = fmaxl(scale, fabsl(want[i]));
  struct text at;
  text_init(&at);
  point_print(&at, v->point);
  for (int i = 0; i < rows * cols; i++) {
    real x = v->ctx.type->get_d(num_vec_at(&m, i));
    ck_assert_msg(fabsl(x - want[i]) < tolerance * scale, "%s[%d,%d] is %Lg, not %Lg, at %s", name, i / cols + 1,
                  i % cols + 1, x, want[i], text_str(&at));
  }
  text_clear(&at);
  num_vec_clear(&m);
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
  for (size_t m = 0; m < sizeof maps / sizeof *maps; m++) {
    real want[6], end[4];
    for (int k = 0; k < maps[m].cols; k++) {
      plain_derivative(end, &p, maps[m].from, maps[m].to, z[maps[m].from], maps[m].in[k], t);
      for (int i = 0; i < maps[m].rows; i++) want[i * maps[m].cols + k] = end[maps[m].keep[i]];
    }
    oracle_is(v, maps[m].name, maps[m].rows, maps[m].cols, want, tolerance);
  }
}

START_TEST(jacobians_are_the_differences_of_a_second_model) {
  const struct num_ctx ctx[] = {num_ctx_arb(FIRST_PREC), num_ctx_mpfr(FD_PREC)};
  const enum variant variant[] = {VARIANT_CLOSED, VARIANT_FD};
  struct point p;
  struct values v;
  point_init(&p);
  ck_assert(nearest_orbit_point(&p, &the_paper.scene, the_paper.cache));
  for (p.orbit = 0; p.orbit < scene_orbits(&the_paper.scene, the_paper.cache)->n; p.orbit++) {
    ck_assert(values_init(&v, &p, variant[_i], ctx[_i], the_paper.cache) == SS_OK);
    check_jacobians(&v, 1e-9L);
    values_clear(&v);
  }
  int accepted = 0;
  for (int n = 0; n < ARC_DRAWS / 2; n++) {
    bool ok = open_arc(&v, &p, n, variant[_i], ctx[_i]);
    accepted += ok;
    if (ok) check_jacobians(&v, 1e-8L);
    values_clear(&v);
  }
  ck_assert(accepted >= 3);
  point_clear(&p);
}
END_TEST

START_TEST(matrices_of_the_motion_are_those_of_a_second_model) {
  struct sampler s;
  struct point p;
  point_init(&p);
  sampler_init(&s, "matrices", &(struct point_spec){.kind = POINT_PARAMS});
  for (int n = 0; n < 8; n++) {
    static const char *const propagators[] = {"D(t)", "Gamma(t)", "H(t)", "C(t)"};
    static const char *const stiff[] = {NULL, "K_1", "K", "K_2"};
    static const char *const newton[] = {NULL, "K_1 newton", "K newton", "K_2 newton"};
    struct values v;
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
    values_clear(&v);
  }
  point_clear(&p);
}
END_TEST

START_TEST(n_carries_the_state_through_one_period) {
  struct point p;
  struct values v;
  point_init(&p);
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
  values_clear(&v);
  point_clear(&p);
}
END_TEST

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
  struct diag d;
  diag_init(&d);
  arb_ptr x = _arb_vec_init(6);
  ck_assert_msg(audit_jacobian(x, x + 4, x + 5, &the_paper.model, s, q, &d), "%s", d.message);
  for (int i = 0; i < 4; i++) j[i] = arf_get_d(arb_midref(x + i), ARF_RND_NEAR);
  ck_assert(arb_is_zero(x + 5));
  ck_assert(fabsl(arf_get_d(arb_midref(x + 4), ARF_RND_NEAR) - j[0] - j[3]) < 1e-13L * (1 + fabsl(j[0])));
  _arb_vec_clear(x, 6);
}

START_TEST(the_chain_at_printed_numbers) {
  struct scene s;
  struct diag d;
  ck_assert_msg(
      load_text(&s, &d,
                "chi = 0.7\neta = 1.25\nV = 1.5\ne1 = 2.5\ne2 = 0.75\nprinted: z10 = 0.9\nprinted: z20 = -2.2\n"
                "printed: t_a = 0.7\nprinted: t_b = 2\nprinted: t_c = 1.5\nprinted: t_d = 2.3\n"),
      "%s", d.message);
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
  scene_clear(&s);
}
END_TEST

/* The other methods take the printed state and find the events themselves. */
START_TEST(the_map_at_printed_numbers) {
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
END_TEST

START_TEST(expressions_at_a_point) {
  struct point p;
  struct diag d;
  point_init(&p);
  diag_init(&d);
  ck_assert(printed_point(&p, &the_paper.scene));
  arb_ptr x = _arb_vec_init(16);
  int n;
  struct view v = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  fmpq_t third;
  fmpq_init(third);
  fmpq_set_si(third, 1, 3);
  ck_assert(expression_at(x, &n, v, "1/3", "stability", &p, 200, the_paper.cache, &d) == SS_OK && n == 1);
  ck_assert(arb_contains_fmpq(x, third) && arb_rel_accuracy_bits(x) > 190);
  fmpq_clear(third);
  ck_assert(expression_at(x, &n, v, "z_10 - chi*z_20 + V*t_a*(1 - chi)", "validation", &p, 128, the_paper.cache, &d) ==
            SS_OK);
  ck_assert(fabs(arf_get_d(arb_midref(x), ARF_RND_NEAR) - 2.78442) < 1e-15); /* 0.8921 + 0.8*2.1958 + 0.2*0.6784 */
  ck_assert(expression_at(x, &n, v, "H(t_c)[1:2,3:4]", "appendix_a", &p, 128, the_paper.cache, &d) == SS_OK && n == 4);
  real h[16];
  plain_propagator(h, &(struct plain){0.8L, 1, 1, 0, 0}, PHASE_H, 1.5L);
  for (int i = 0; i < 4; i++)
    ck_assert(fabsl(arf_get_d(arb_midref(x + i), ARF_RND_NEAR) - h[4 * (i / 2) + 2 + i % 2]) < 1e-14L);
  ck_assert(expression_at(x, &n, v, "1/(V - 1)", "stability", &p, 128, the_paper.cache, &d) != SS_OK);
  ck_assert(expression_at(x, &n, v, "t_prime", "stability", &p, 128, the_paper.cache, &d) != SS_OK && !d.set);
  ck_assert(expression_at(x, &n, v, "no_such_name", "stability", &p, 128, the_paper.cache, &d) != SS_OK && d.set);
  diag_init(&d);
  ck_assert(expression_at(x, &n, v, "1/2/3", "stability", &p, 128, the_paper.cache, &d) != SS_OK && d.set);
  _arb_vec_clear(x, 16);

  point_clear(&p);
}
END_TEST

/* --- Sentences at a point --- */

static const struct {
  const char *sentence;
  enum outcome balls;
  long bits; /* at which balls decide; 0: does not matter */
  enum outcome rounded;
} sentences[] = {
    {"t/3 + t/3 = 2*t/3", OUTCOME_AGREES, 128, OUTCOME_AGREES},
    {"t = t + 1e-20", OUTCOME_DIFFERS, 128, OUTCOME_DIFFERS},
    /* 2^-232 and 2^-133: below what 128 bits resolve; and against 2^-200 and its square root */
    {"t = t + 1e-70", OUTCOME_AGREES, 128, OUTCOME_AGREES},
    {"t = t + 1e-40", OUTCOME_AGREES, 128, OUTCOME_UNDECIDED},
    /* cancellation leaves 1e30 2^-128 of uncertainty: too little to tell, and no agreement either */
    {"(1e30 + t/3) - 1e30 = t/3", OUTCOME_AGREES, 256, OUTCOME_UNDECIDED},
    {"(1e30 + t/3) - 1e30 = t/3 + 1e-12", OUTCOME_DIFFERS, 256, OUTCOME_DIFFERS},
    {"(1e400 + t/3) - 1e400 = t/3", OUTCOME_UNDECIDED, 1024, OUTCOME_DIFFERS},
    {"[t, 1; 2, 3] = [t, 1; 2, 4]", OUTCOME_DIFFERS, 128, OUTCOME_DIFFERS},
    {"1/(t - t) = 1", OUTCOME_REJECTED, 0, OUTCOME_REJECTED},
    {"1/(t/3 - t/3) = 1", OUTCOME_REJECTED, 0, OUTCOME_REJECTED},
    {"sqrt(-t) = 1", OUTCOME_REJECTED, 0, OUTCOME_REJECTED},
    {"z_1a = 1", OUTCOME_UNBOUND, 0, OUTCOME_UNBOUND},
};

START_TEST(two_sides_at_a_point) {
  struct sampler s;
  struct point p;
  struct model m;
  struct diag d;
  struct sentence sides;
  char text[200];
  point_init(&p);
  diag_init(&d);
  sampler_init(&s, "sentences", &(struct point_spec){.kind = POINT_PARAMS});
  sampler_next(&p, &s);
  snprintf(text, sizeof text, "equation user\n  section: stability\n  %s\n", sentences[_i].sentence);
  paper_model(&m, &(struct paper_layers){.overlay = scratch_put("overlay.eq", text)});
  struct view v = {&m, LAYER_PRINTED, NULL, NULL};
  ck_assert_msg(sentence_from_relations(&sides, v, view_record(&v, "user"), NULL, 0, &d), "%s", d.message);
  struct trial t = sentence_try_balls(&sides, &p, VARIANT_CLOSED, the_paper.cache);
  ck_assert_msg(t.outcome == sentences[_i].balls, "%s: %d at %ld bits", sentences[_i].sentence, (int)t.outcome, t.bits);
  if (sentences[_i].bits) ck_assert_int_eq(t.bits, sentences[_i].bits);
  if (t.outcome == OUTCOME_UNBOUND) ck_assert_str_eq(t.unbound, "z_1a");
  t = sentence_try_rounded(&sides, &p, VARIANT_CLOSED, num_ctx_mpfr(FD_PREC), -200, the_paper.cache);
  ck_assert_msg(t.outcome == sentences[_i].rounded, "%s rounded: %d", sentences[_i].sentence, (int)t.outcome);
  sentence_clear(&sides);
  model_clear(&m);
  point_clear(&p);
}
END_TEST

/* --- Claims --- */

/* Judges the claims that `only` selects, over the overlay. */
static void judge(struct audit_result *r, const char *overlay, bool with_controls, const char *only) {
  struct model m;
  struct diag d;
  diag_init(&d);
  audit_result_init(r);
  paper_model(&m, &(struct paper_layers){.overlay = overlay ? scratch_put("overlay.eq", overlay) : NULL,
                                         .controls = with_controls});
  const struct audit_options opt = {.only = &only, .n_only = 1};
  ck_assert_msg(audit_run(r, &m, &the_paper.claims, &the_paper.controls, &the_paper.scene, &opt, &d), "%s", d.message);
  model_clear(&m);
}

static const struct {
  const char *claim, *overlay;
} damages[] = {
    {"eq-3", "define user\n  section: prediction\n  K := [1, -chi; -chi*eta, chi*eta^2]\n"},
    {"eq-3b", "define user\n  section: prediction\n  d_01 := (u_s1 - u_s2)/(1 - chi)\n"},
    {"eq-27", "define user\n  section: stability\n  J_a := (1/(1 - chi))*[-1, 2]\n"},
    {"eq-32", "define user\n  section: stability\n  gammatilde_1 := (chi - chi_b)/(1 + chi_b)\n"},
    {"eq-36", "define user\n  section: stability\n  ktilde_2 := ktilde_1*z'_2c\n"},
    {"eq-35", "equation eq-35\n  section: stability\n  equation: 35\n  x_1'(t_a + dt_a + t_b + dt_b + t_c + dt_c) + "
              "z_2(t_a + dt_a + t_b + dt_b + t_c + dt_c) = V + z_2c\n"},
    {"eq-39", "equation eq-39\n  section: stability\n  equation: 39\n  x_2'(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d "
              "+ dt_d) + "
              "x_1(t_a + dt_a + t_b + dt_b + t_c + dt_c + t_d + dt_d) = V + x_1(t_a + t_b + t_c + t_d)\n"},
    {"eq-41", "define user\n  section: stability\n  J := J_f*J_c*J_b*J_a + J_b*J_a\n"},
    {"eq-43b", "equation eq-43b\n  section: stability\n  det(J_b*J_a) = 1\n"},
    {"eq-44", "define user\n  section: validation\n  N := D(t_a)*C(t_d)*H(t_c)*Gamma(t_b)\n"},
    {"eq-47", "define user\n  section: appendix_a\n  B_2(t) := [s_1(t), 0; 0, s_2(t)]\n"},
    {"eq-49", "define user\n  section: appendix_a\n  Sigma := [1, -chi; 0, 1]\n"},
    {"eq-50", "define user\n  section: appendix_a\n  omega := sqrt(eta)\n"},
};

static const struct {
  const char *claim, *overlay;
} repairs[] = {
    {"eq-10", "define user\n  section: prediction\n  D(t) := [I, t*I; 0, I]\n"},
    {"eq-31", "equation eq-31\n  section: stability\n  equation: 31\n  chi*(x_2(t_a + dt_a + t_b + dt_b) - "
              "x_1(t_a + dt_a + t_b + dt_b)) = u_r2\n"},
    {"eq-32b", "equation eq-32c\n  section: stability\n  equation: 32\n  chi_b = z'_1b/V\n"},
    {"eq-32c", "equation eq-32d\n  section: stability\n  equation: 32\n  [y_b; u_b] = J_b*y_a\n"},
    {"eq-40", "define user\n  section: stability\n  ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100))\n"},
};

enum { N_DAMAGES = sizeof damages / sizeof *damages, N_REPAIRS = sizeof repairs / sizeof *repairs };

static struct audit_result undamaged; /* the whole audit, as things stand */

static void open_claims(void) {
  paper_open();
  whole_open();
  whole_record(&undamaged);
}

static void close_claims(void) {
  audit_result_clear(&undamaged);
  paper_close();
}

/* As written the claim is proved; one wrong glyph refutes it, and the certificate names a point; two of
   them are right where eta = 1 or V = 1. */
START_TEST(a_damaged_formula_is_refuted) {
  const struct finding *f = finding_with_id(&undamaged, damages[_i].claim);
  ck_assert_msg(f->verdict == VERDICT_PROVED, "%s: %s", f->id, verdict_name[f->verdict]);
  ck_assert_int_ge(f->n_evidence, 3);
  for (int i = 0; i + 1 < f->n_evidence; i++)
    ck_assert(strcmp(f->evidence[i].result, "agrees") == 0 && f->evidence[i].trials > 0);
  ck_assert(strcmp(f->evidence[f->n_evidence - 1].route, "exact") == 0);
  ck_assert(strcmp(f->evidence[f->n_evidence - 1].result, "proved") == 0);
  struct audit_result r;
  judge(&r, damages[_i].overlay, true, damages[_i].claim);
  f = finding_with_id(&r, damages[_i].claim);
  ck_assert_msg(verdict_fails(f->verdict), "damaged %s: %s", f->id, verdict_name[f->verdict]);
  ck_assert(f->fault != NULL && strcmp(f->evidence[0].result, "differs") == 0 && f->evidence[0].trials > 0);
  ck_assert(f->evidence[0].note && strstr(f->evidence[0].note, "at chi = "));
  ck_assert(audit_result_unexpected(&r) > 0);
  audit_result_clear(&r);
}
END_TEST

/* --- Certificates --- */

/* A number of the certificate. */
static real certified(const struct finding *f, const char *name) {
  const char *value = NULL;
  for (int i = 0; i < f->certificate.n; i++)
    if (strcmp(f->certificate.at[i].name, name) == 0) value = f->certificate.at[i].value;
  ck_assert_msg(value != NULL, "the certificate of %s has no %s", f->id, name);
  char *end;
  real x = strtold(value, &end);
  return *end == '/' ? x / strtold(end + 1, NULL) : x;
}

static void certified_numbers(real *x, const struct finding *f, const char *const *names, int n) {
  for (int i = 0; i < n; i++) x[i] = certified(f, names[i]);
}

/* The state at the start of a pass and those at the ends of the first n phases, over the certified times. */
static void certified_states(real z[][4], const struct finding *f, const struct plain *p, int n) {
  for (int k = 0; k < n; k++) plain_flow(z[k + 1], p, k, z[k], certified(f, name_time[k]));
}

/* Z(t) = Gamma(t) Z_a in the slip-stick phase of a pass. */
static void sides_13(real *left, real *right, const struct finding *f, const struct plain *p) {
  real z[2][4] = {{certified(f, "z_10"), certified(f, "z_20"), p->v, p->v}}, t = certified(f, "t");
  certified_states(z, f, p, 1);
  plain_flow(left, p, PHASE_GAMMA, z[1], t - certified(f, "t_a"));
  plain_flow(right, p, PHASE_GAMMA, z[1], t);
}

/* Z_a = D(t_a) Z_0, Z_b = H(t_b) Z_a, Z_c = H(t_c) Z_b over any times. */
static void sides_states(real *left, real *right, const struct finding *f, const struct plain *p) {
  real z[4][4];
  certified_numbers(z[0], f, name_state[0], 4);
  certified_states(z, f, p, 3);
  for (int k = 0; k < 3; k++) {
    memcpy(left + 4 * k, z[k + 1], sizeof z[0]);
    plain_flow(right + 4 * k, p, k == 0 ? PHASE_D : PHASE_H, z[k], certified(f, name_time[k]));
  }
}

/* dZ_a = (y_a, y_a, 0, 0), where the perturbations are any numbers. */
static void sides_25(real *left, real *right, const struct finding *f, const struct plain *p) {
  (void)p;
  certified_numbers(right, f, name_tangent[1], 4);
  for (int i = 0; i < 4; i++) left[i] = i < 2 ? right[1] : 0;
}

/* z_i = x_i - d_02 in a phase of the certificate, where x_i = z_i + d_0i. */
static void sides_3(real *left, real *right, const struct finding *f, const struct plain *p) {
  static const char *const start[] = {"z_1", "z_2", "z_1'", "z_2'"};
  real z[4], u1 = certified(f, "u_s1"), u2 = certified(f, "u_s2"), at[4];
  const real d_01 = (u1 + u2) / (1 - p->chi), d_02 = (p->chi * u1 + u2) / ((1 - p->chi) * p->chi);
  int ph = N_PHASES;
  for (int i = 0; i < f->certificate.n; i++)
    if (strcmp(f->certificate.at[i].name, "phase") == 0)
      ph = word_find(f->certificate.at[i].value, phase_name, N_PHASES);
  ck_assert_int_lt(ph, N_PHASES);
  certified_numbers(z, f, start, 4);
  plain_flow(at, p, ph, z, certified(f, "t"));
  for (int i = 0; i < 2; i++) {
    left[i] = at[i];
    right[i] = at[i] + (i ? d_02 : d_01) - d_02;
  }
}

/* P(lambda) = lambda (lambda + tr J); P(lambda) = det(J - lambda I). */
static void sides_charpoly(real *left, real *right, const struct finding *f, const struct plain *p) {
  struct plain all = *p;
  real z[4] = {certified(f, "z_10"), certified(f, "z_20"), p->v, p->v}, t[4], j[2][4], lambda = certified(f, "lambda");
  all.e1 = certified(f, "e_1");
  all.e2 = certified(f, "e_2");
  certified_numbers(t, f, name_time, 4);
  for (int i = 0; i < 2; i++)
    plain_derivative(j[i], &all, PHASE_D, PHASE_C, z, (const real[4]){i == 0, i == 1, 0, 0}, t);
  left[0] = (j[0][0] - lambda) * (j[1][1] - lambda) - j[0][1] * j[1][0];
  right[0] = lambda * (lambda + j[0][0] + j[1][1]);
}

static const struct {
  const char *claim, *overlay;
  void (*sides)(real *left, real *right, const struct finding *f, const struct plain *p);
} rechecks[] = {
    {"eq-13", "equation eq-13\n  section: periodic\n  equation: 13\n  Z(t) = Gamma(t)*Z_a\n", sides_13},
    {"text-states",
     "equation text-states\n  section: stability\n  Z_a = D(t_a)*Z_0\n  Z_b = H(t_b)*Z_a\n  Z_c = H(t_c)*Z_b\n",
     sides_states},
    {"eq-25c", "define user\n  section: stability\n  dZ_a := [y_a; y_a; 0; 0]\n", sides_25},
    {"text-shift", "equation text-shift\n  section: prediction\n  z_1(t) = x_1(t) - d_02\n  z_2(t) = x_2(t) - d_02\n",
     sides_3},
    {"text-charpoly", "equation text-charpoly\n  section: stability\n  P(lambda) = lambda*(lambda + tr(J))\n",
     sides_charpoly},
};

/* The certificate alone, without the program's point, says where a damaged formula fails, and how. */
START_TEST(a_refutation_is_recomputed_from_its_certificate) {
  enum { MOST = 12 };
  struct audit_result r;
  real left[MOST] = {0}, right[MOST] = {0};
  judge(&r, rechecks[_i].overlay, false, rechecks[_i].claim);
  const struct finding *f = finding_with_id(&r, rechecks[_i].claim);
  ck_assert_msg(f->verdict == VERDICT_REFUTED, "damaged %s: %s", f->id, verdict_name[f->verdict]);
  const struct plain p = {.chi = certified(f, "chi"), .eta = certified(f, "eta"), .v = certified(f, "V")};
  rechecks[_i].sides(left, right, f, &p);
  int entry = strcmp(f->certificate.at[f->certificate.n - 3].name, "entry") == 0 ? (int)certified(f, "entry") - 1 : 0;
  ck_assert(entry >= 0 && entry < MOST);
  const real got[2] = {left[entry], right[entry]}, want[2] = {certified(f, "left"), certified(f, "right")};
  for (int i = 0; i < 2; i++)
    ck_assert_msg(fabsl(got[i] - want[i]) < 1e-7L * fmaxl(1, fabsl(want[i])), "%s: %s is %.12Lf, certified %.12Lf",
                  f->id, i ? "the right side" : "the left side", got[i], want[i]);
  ck_assert_msg(fabsl(got[0] - got[1]) > 1e-3L, "%s: the sides are equal", f->id);
  audit_result_clear(&r);
}
END_TEST

/* As printed the claim fails; written right by a user it is proved. */
START_TEST(a_repaired_formula_is_supported) {
  const struct finding *f = finding_with_id(&undamaged, repairs[_i].claim);
  ck_assert_msg(verdict_fails(f->verdict), "%s: %s", f->id, verdict_name[f->verdict]);
  ck_assert(f->correction && f->correction_verdict == VERDICT_PROVED);
  struct audit_result r;
  judge(&r, repairs[_i].overlay, true, repairs[_i].claim);
  f = finding_with_id(&r, repairs[_i].claim);
  ck_assert_msg(f->verdict == VERDICT_PROVED, "repaired %s: %s", f->id, verdict_name[f->verdict]);
  audit_result_clear(&r);
}
END_TEST

/* (10) and ktilde_4 are right where V = 1, as the paper's example has it. */
START_TEST(what_holds_when_v_is_one_is_said) {
  static const char *const ids[] = {"eq-10", "eq-40"};
  for (int i = 0; i < 2; i++) {
    int restricted = 0;
    ck_assert(finding_with_id(&undamaged, ids[i])->verdict == VERDICT_CONDITIONAL);
    ck_assert_str_eq(finding_with_id(&undamaged, ids[i])->condition, "V = 1");
    for (size_t k = 0; k < undamaged.n_findings; k++) {
      const struct finding *f = &undamaged.findings[k];
      if (!f->condition || strcmp(f->condition, "V = 1") != 0) continue;
      if (f->verdict == VERDICT_CONDITIONAL) continue; /* of the claims themselves */
      ck_assert(f->verdict == VERDICT_PROVED && strcmp(f->id, ids[i]) != 0);
      ck_assert(f->n_depends_on == 1);
      restricted += strcmp(f->depends_on[0], ids[i]) == 0;
    }
    ck_assert_int_eq(restricted, 1);
  }
}
END_TEST

/* The words for the model's conditions are the paper's own inequalities, each in its phase and in the model's order. */
START_TEST(conditions_are_called_as_the_paper_has_them) {
  static const struct {
    const char *record;
    int statement, phase;
    bool upper; /* of a < b < c the latter part */
  } conditions[N_CONDITIONS] = {{"eq-51", 0, N_PHASES, false},       {"eq-57", 0, PHASE_GAMMA, false},
                                {"text-h-phase", 0, PHASE_H, false}, {"text-h-phase", 1, PHASE_H, false},
                                {"eq-59", 1, PHASE_C, false},        {"eq-59", 0, PHASE_C, true},
                                {"eq-54", 1, PHASE_D, true},         {"eq-5b", 2, PHASE_GAMMA, true}};
  const struct finding *f = finding_with_id(&undamaged, "text-constraints");
  const char *said = NULL;
  for (int i = 0; i < f->n_evidence; i++)
    if (f->evidence[i].note && strstr(f->evidence[i].note, " violate ")) said = f->evidence[i].note;
  for (int k = 0; k < N_CONDITIONS; k++) {
    const struct statement_record *r = record_with_id(&the_paper.model, conditions[k].record);
    ck_assert_int_lt(conditions[k].statement, r->n_stmts);
    struct text plain = {0}, want = {0};
    stmt_plain(&plain, r->stmts[conditions[k].statement]);
    text_printf(&want, " violate %s",
                conditions[k].upper ? strstr(text_str(&plain), " < ") + strlen(" < ") : text_str(&plain));
    if (conditions[k].phase < N_PHASES) text_printf(&want, " in the %s phase", phase_words[conditions[k].phase]);
    said = said ? strstr(said, " violate ") : NULL;
    ck_assert_msg(said && strncmp(said, text_str(&want), want.len) == 0 && strchr(",;", said[want.len]),
                  "expected%s, not%.60s", text_str(&want), said ? said : " the end");
    said += want.len;
    text_clear(&want);
    text_clear(&plain);
  }
}
END_TEST

START_TEST(what_cannot_be_read_is_a_fault_of_notation) {
  static const struct {
    const char *overlay, *outcome;
  } cases[] = {{"define user\n  section: stability\n  equation: 27\n  J_a := [1, 2; 3, 4]\n", "2x2"},
               {"define user\n  section: stability\n  equation: 27\n  J_a := [-1, 1]*[1, 2]\n", "1x2 and 1x2"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct audit_result r;
    judge(&r, cases[i].overlay, true, "eq-27");
    const struct finding *f = finding_with_id(&r, "eq-27");
    ck_assert(f->verdict == VERDICT_REFUTED && strcmp(f->fault, "notation") == 0);
    ck_assert_str_eq(f->evidence[0].route, "diagnostic");
    ck_assert_msg(strstr(f->evidence[0].note, cases[i].outcome) != NULL, "%s", f->evidence[0].note);
    audit_result_clear(&r);
  }
}
END_TEST

/* A control is its claim with something made wrong; without the wrong it is not noticed, and that is reported.  No
   proof is looked for where only a refutation is awaited. */
START_TEST(an_undamaged_control_is_a_failure) {
  for (int damaged = 0; damaged < 2; damaged++) {
    struct audit_result r;
    struct text line;
    text_init(&line);
    judge(&r, NULL, damaged, "eq-3c");
    report_line(&line, &r);
    ck_assert(r.n_controls == 1 && strcmp(r.controls[0].claim, "eq-3c") == 0);
    ck_assert(r.controls[0].verdict == (damaged ? VERDICT_REFUTED : VERDICT_SUPPORTED));
    ck_assert(r.controls[0].noticed == damaged && audit_result_unexpected(&r) == !damaged);
    ck_assert_str_eq(text_str(&line), damaged
                                          ? "paper: 1 statement: 1 proved; 1 of 1 controls noticed; as recorded"
                                          : "paper: 1 statement: 1 proved; 0 of 1 controls noticed; 1 NOT as recorded");
    text_clear(&line);
    audit_result_clear(&r);
  }
}
END_TEST

Suite *audit_suite(void) {
  Suite *s = suite_create("audit");
  TCase *c = tcase_create("verdict");
  tcase_add_test(c, every_row_of_the_verdict_table);
  tcase_add_test(c, routes_that_share_their_reasoning_count_once);
  tcase_add_test(c, selection_by_id);
  tcase_add_test(c, sizes_as_powers_of_ten);
  suite_add_tcase(s, c);
  c = tcase_create("scene");
  tcase_add_unchecked_fixture(c, scratch_open, scratch_close);
  tcase_add_test(c, scenes_are_exact);
  tcase_add_test(c, line_ends_marks_and_blanks_do_not_matter);
  tcase_add_test(c, the_last_printed_digit);
  tcase_add_test(c, a_decimal_is_read_rounded_or_cut_off);
  suite_add_tcase(s, c);
  c = tcase_create("point");
  tcase_add_loop_test(c, an_id_has_its_own_points, 0, N_SAMPLED);
  tcase_add_loop_test(c, points_lie_in_the_domain, 0, N_SAMPLED);
  suite_add_tcase(s, c);
  c = tcase_create("value");
  tcase_set_timeout(c, 60);
  tcase_add_unchecked_fixture(c, paper_open, paper_close);
  tcase_add_loop_test(c, arcs_obey_the_papers_conditions, 0, 2);
  tcase_add_test(c, orbits_close);
  tcase_add_test(c, tangents_are_linear);
  tcase_add_test(c, flows_solve_their_equations);
  tcase_add_test(c, names_without_a_value_are_told_apart);
  tcase_add_loop_test(c, jacobians_are_the_differences_of_a_second_model, 0, 2);
  tcase_add_test(c, matrices_of_the_motion_are_those_of_a_second_model);
  tcase_add_test(c, n_carries_the_state_through_one_period);
  tcase_add_test(c, the_chain_at_printed_numbers);
  tcase_add_loop_test(c, the_map_at_printed_numbers, 0, 2);
  tcase_add_test(c, expressions_at_a_point);
  tcase_add_loop_test(c, two_sides_at_a_point, 0, (int)(sizeof sentences / sizeof *sentences));
  suite_add_tcase(s, c);
  c = tcase_create("claim");
  tcase_set_timeout(c, 60);
  tcase_add_unchecked_fixture(c, open_claims, close_claims);
  tcase_add_loop_test(c, a_damaged_formula_is_refuted, 0, N_DAMAGES);
  tcase_add_loop_test(c, a_refutation_is_recomputed_from_its_certificate, 0, (int)(sizeof rechecks / sizeof *rechecks));
  tcase_add_loop_test(c, a_repaired_formula_is_supported, 0, N_REPAIRS);
  tcase_add_test(c, what_holds_when_v_is_one_is_said);
  tcase_add_test(c, conditions_are_called_as_the_paper_has_them);
  tcase_add_test(c, what_cannot_be_read_is_a_fault_of_notation);
  tcase_add_test(c, an_undamaged_control_is_a_failure);
  suite_add_tcase(s, c);
  return s;
}
