/* The audit from the inside: the table from evidence to verdict, and claims under equation files that the tests damage
   or repair; what a certificate says is recomputed by a model of the tests' own (plain.h). */
#include "judge/judge.h"
#include "plain.h"
#include "report/report.h"
#include "run/audit.h"
#include "test.h"
#include "value/title.h"
#include "whole.h"

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

TEST(every_row_of_the_verdict_table) {
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

TEST(routes_that_share_their_reasoning_count_once) {
  static const char *const names[] = {"balls", "oracle", "exponential", "taylor",    "gsl",         "ode",
                                      "fd",    "newton", "saltation",   "iteration", "integration", "motion"};
  for (int i = 0; i < COUNT(names); i++) {
    for (int k = 0; k < COUNT(names); k++)
      for (int outcome = ROUTE_NOTHING; outcome <= ROUTE_UNDECIDED; outcome++) {
        struct route_result w[] = {{names[i], ROUTE_AGREES, true, 1},
                                   {names[k], (enum route_outcome)outcome, false, 1}};
        bool two = outcome == ROUTE_AGREES && i != k;
        ck_assert_msg((verdict_of(w, 2, false) == VERDICT_SUPPORTED) == two, "%s and %s saying %d", names[i], names[k],
                      outcome);
      }
  }
  struct route_result same_text[] = {{"balls", ROUTE_AGREES, true, 1}, {"algebra", ROUTE_AGREES, true, 1}};
  ck_assert_int_eq(verdict_of(same_text, 2, false), VERDICT_UNKNOWN); /* both read the paper's formulas */
}

TABLE(selected, "tests/cases/selected.tsv", 3);
enum { ID, ITEM, IS_SELECTED }; /* its columns */

TEST_EACH(selection_by_id, selected.n) {
  char *const *row = selected.row[_i];
  ck_assert_msg(claim_selected(row[ID], row[ITEM]) == is_yes(row[IS_SELECTED]), "\"%s\" and %s", row[ITEM], row[ID]);
}

TEST(sizes_as_powers_of_ten) {
  static const struct {
    double log2x;
    const char *want;
  } cases[] = {{-INFINITY, "0"}, {0, "1e0"}, {3, "1e1"}, {3.4, "1e2"}, {-3.4, "1e-1"}, {-10, "1e-3"}, {-127, "1e-38"}};
  LOCAL(audit_result, r);
  for (size_t i = 0; i < COUNT(cases); i++) ck_assert_str_eq(order_of_magnitude(&r, cases[i].log2x), cases[i].want);
}

/* --- Claims --- */

/* Judges the claims that `only` selects, over the overlay. */
static struct audit_result judge(const char *overlay, bool with_controls, const char *only) {
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = overlay ? scratch_put("overlay.eq", overlay) : NULL,
                                                      .controls = with_controls});
  struct audit_result r;
  audit_result_init(&r);
  const struct audit_options opt = {.only = &only, .n_only = 1};
  goes_well(audit_run(&r, &m, &the_paper.claims, &the_paper.controls, &the_paper.scene, &opt, &d));
  return r;
}

TABLE(damages, "tests/cases/audit_damages.tsv", 2);
TABLE(repairs, "tests/cases/audit_repairs.tsv", 2);
enum { CLAIM, OVERLAY }; /* their columns */

CASE("claim", .once = {audit_open, audit_close}, .seconds = 60);

/* As written the claim is proved; one wrong glyph refutes it, and the certificate names a point; two of
   them are right where eta = 1 or V = 1. */
TEST_EACH(a_damaged_formula_is_refuted, damages.n) {
  const struct finding *f = finding_with_id(&the_audit, damages.row[_i][CLAIM]);
  ck_assert_msg(f->verdict == VERDICT_PROVED, "%s: %s", f->id, verdict_name[f->verdict]);
  ck_assert_int_ge(f->n_evidence, 3);
  for (int i = 0; i + 1 < f->n_evidence; i++)
    ck_assert(strcmp(f->evidence[i].result, "agrees") == 0 && f->evidence[i].trials > 0);
  ck_assert(strcmp(f->evidence[f->n_evidence - 1].route, "exact") == 0);
  ck_assert(strcmp(f->evidence[f->n_evidence - 1].result, "proved") == 0);
  OWNED(audit_result) r = judge(damages.row[_i][OVERLAY], true, damages.row[_i][CLAIM]);
  f = finding_with_id(&r, damages.row[_i][CLAIM]);
  ck_assert_msg(verdict_fails(f->verdict), "damaged %s: %s", f->id, verdict_name[f->verdict]);
  ck_assert(f->fault != NULL && strcmp(f->evidence[0].result, "differs") == 0 && f->evidence[0].trials > 0);
  ck_assert(f->evidence[0].note && strstr(f->evidence[0].note, "at chi = "));
  ck_assert(audit_result_unexpected(&r) > 0);
}

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

/* Z_a = D(t_a) Z_0, Z_b = H(t_b) Z_a, Z_c = H(t_c) Z_b on an orbit. */
static void sides_states(real *left, real *right, const struct finding *f, const struct plain *p) {
  real z[4][4];
  certified_numbers(z[0], f, name_state[0], 2);
  z[0][2] = z[0][3] = p->v;
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
TEST_EACH(a_refutation_is_recomputed_from_its_certificate, COUNT(rechecks)) {
  enum { MOST = 12 };
  real left[MOST] = {0}, right[MOST] = {0};
  OWNED(audit_result) r = judge(rechecks[_i].overlay, false, rechecks[_i].claim);
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
}

/* As printed the claim fails; written right by a user it is proved. */
TEST_EACH(a_repaired_formula_is_supported, repairs.n) {
  const struct finding *f = finding_with_id(&the_audit, repairs.row[_i][CLAIM]);
  ck_assert_msg(verdict_fails(f->verdict), "%s: %s", f->id, verdict_name[f->verdict]);
  ck_assert(f->correction && f->correction_verdict == VERDICT_PROVED);
  OWNED(audit_result) r = judge(repairs.row[_i][OVERLAY], true, repairs.row[_i][CLAIM]);
  f = finding_with_id(&r, repairs.row[_i][CLAIM]);
  ck_assert_msg(f->verdict == VERDICT_PROVED, "repaired %s: %s", f->id, verdict_name[f->verdict]);
}

/* (10) and ktilde_4 are right where V = 1, as the paper's example has it. */
TEST(what_holds_when_v_is_one_is_said) {
  static const char *const ids[] = {"eq-10", "eq-40"};
  for (int i = 0; i < 2; i++) {
    int restricted = 0;
    ck_assert(finding_with_id(&the_audit, ids[i])->verdict == VERDICT_CONDITIONAL);
    ck_assert_str_eq(finding_with_id(&the_audit, ids[i])->condition, "V = 1");
    for (size_t k = 0; k < the_audit.n_findings; k++) {
      const struct finding *f = &the_audit.findings[k];
      if (!f->condition || strcmp(f->condition, "V = 1") != 0) continue;
      if (f->verdict == VERDICT_CONDITIONAL) continue; /* of the claims themselves */
      ck_assert(f->verdict == VERDICT_PROVED && strcmp(f->id, ids[i]) != 0);
      ck_assert(f->n_depends_on == 1);
      restricted += strcmp(f->depends_on[0], ids[i]) == 0;
    }
    ck_assert_int_eq(restricted, 1);
  }
}

/* The words for the model's conditions are the paper's own inequalities, each in its phase and in the model's order. */
TEST(conditions_are_called_as_the_paper_has_them) {
  static const struct {
    const char *record;
    int statement, phase;
    bool upper; /* of a < b < c the latter part */
  } conditions[N_CONDITIONS] = {{"eq-51", 0, N_PHASES, false},       {"eq-57", 0, PHASE_GAMMA, false},
                                {"text-h-phase", 0, PHASE_H, false}, {"text-h-phase", 1, PHASE_H, false},
                                {"eq-59", 1, PHASE_C, false},        {"eq-59", 0, PHASE_C, true},
                                {"eq-54", 1, PHASE_D, true},         {"eq-5b", 2, PHASE_GAMMA, true}};
  const struct finding *f = finding_with_id(&the_audit, "text-constraints");
  const char *said = NULL;
  for (int i = 0; i < f->n_evidence; i++)
    if (f->evidence[i].note && strstr(f->evidence[i].note, " violate ")) said = f->evidence[i].note;
  for (int k = 0; k < N_CONDITIONS; k++) {
    const struct statement_record *r = record_with_id(&the_paper.model, conditions[k].record);
    ck_assert_int_lt(conditions[k].statement, r->n_stmts);
    OWNED(text) plain = {0}, want = {0};
    stmt_plain(&plain, r->stmts[conditions[k].statement]);
    text_printf(&want, " violate %s",
                conditions[k].upper ? strstr(text_str(&plain), " < ") + strlen(" < ") : text_str(&plain));
    if (conditions[k].phase < N_PHASES) text_printf(&want, " in the %s phase", phase_words[conditions[k].phase]);
    said = said ? strstr(said, " violate ") : NULL;
    ck_assert_msg(said && strncmp(said, text_str(&want), want.len) == 0 && strchr(" ;", said[want.len]),
                  "expected%s, not%.60s", text_str(&want), said ? said : " the end");
    said += want.len;
  }
}

TEST(what_cannot_be_read_is_a_fault_of_notation) {
  static const struct {
    const char *overlay, *outcome;
  } cases[] = {{"define user\n  section: stability\n  equation: 27\n  J_a := [1, 2; 3, 4]\n", "2x2"},
               {"define user\n  section: stability\n  equation: 27\n  J_a := [-1, 1]*[1, 2]\n", "1x2 and 1x2"}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    OWNED(audit_result) r = judge(cases[i].overlay, true, "eq-27");
    const struct finding *f = finding_with_id(&r, "eq-27");
    ck_assert(f->verdict == VERDICT_REFUTED && strcmp(f->fault, "notation") == 0);
    ck_assert_str_eq(f->evidence[0].route, "diagnostic");
    ck_assert_msg(strstr(f->evidence[0].note, cases[i].outcome) != NULL, "%s", f->evidence[0].note);
  }
}

/* A control is its claim with something made wrong; without the wrong it is not noticed, and that is reported.  No
   proof is looked for where only a refutation is awaited. */
TEST(an_undamaged_control_is_a_failure) {
  for (int damaged = 0; damaged < 2; damaged++) {
    LOCAL(text, line);
    OWNED(audit_result) r = judge(NULL, damaged, "eq-3c");
    report_line(&line, &r);
    ck_assert(r.n_controls == 1 && strcmp(r.controls[0].claim, "eq-3c") == 0);
    ck_assert(r.controls[0].verdict == (damaged ? VERDICT_REFUTED : VERDICT_SUPPORTED));
    ck_assert(r.controls[0].noticed == damaged && audit_result_unexpected(&r) == !damaged);
    ck_assert_str_eq(text_str(&line), damaged
                                          ? "paper: 1 statement: 1 proved; 1 of 1 controls noticed; as recorded"
                                          : "paper: 1 statement: 1 proved; 0 of 1 controls noticed; 1 NOT as recorded");
  }
}
