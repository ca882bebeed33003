/* What rests on what, what falls with a failure, and the sheets that say so.

   Second opinions: tests/oracle/depends.py reads the files' text by itself; tests/oracle/sheets.py knows the grammars
   of DOT, Markdown and LaTeX; what must change and by how much is worked out here by hand, from where V stands in (10)
   and (40), and from the matrix exponentials of the model. */
#include "claim/claim.h"
#include "params.h"
#include "rational.h"
#include "report/report.h"
#include "report/sheet.h"
#include "run/audit.h"
#include "test.h"
#include "traps.h"
#include "whole.h"

/* --- The audit of the paper, for all tests --- */

static struct model load(const char *overlay, const char *errata) {
  return paper_model(&(struct paper_layers){.overlay = overlay ? scratch_put("user.eq", overlay) : NULL,
                                            .errata = errata ? scratch_put("errata.eq", errata) : NULL,
                                            .controls = true});
}

static const struct derived *derived_of(const char *failure, const char *formula) {
  const struct consequence *q = audit_result_consequence(&the_audit, failure);
  ck_assert_msg(q != NULL, "no consequence of %s", failure);
  for (int i = 0; i < q->n_derived; i++)
    if (strcmp(q->derived[i].formula, formula) == 0) return &q->derived[i];
  ck_abort_msg("%s: no result %s", failure, formula);
}

static const char *joined(const struct id_list *list) {
  static char line[2000];
  line[0] = '\0';
  for (int i = 0; i < list->n; i++)
    snprintf(line + strlen(line), sizeof line - strlen(line), "%s%s", i ? " " : "", list->id[i]);
  return line;
}

/* --- Programs beside the tests --- */

static void write_text(const char *name, void (*writer)(struct text *, const struct audit_result *),
                       const struct audit_result *r) {
  LOCAL(text, t);
  writer(&t, r);
  scratch_put(name, text_str(&t));
}

static void write_sheets(const struct audit_result *r) {
  write_text("audit.json", report_json, r);
  write_text("claims.dot", report_dot, r);
  write_text("errata.md", report_errata, r);
  write_text("errata.tex", report_errata_tex, r);
}

/* --- What rests on what --- */

CASE("paper", .once = {audit_open, audit_close});

TEST(dependences_are_those_of_the_text) {
  write_sheets(&the_audit);
  shell_well("$Y tests/oracle/depends.py verify $D/audit.json");
}

/* A definition that names another claim's value makes the claim rest on it, and the list keeps the order of the
   files. */
TEST(a_new_use_is_a_new_dependence) {
  OWNED(model) m = load("define user\n  section: stability\n  J_a := (1/(1 - chi))*[-1, 1] + 0*tr(K_1)*[1, 1]\n", NULL);
  struct dependences *d = dependences_new(&m, &the_paper.claims);
  size_t ja = 0, k1 = 0, j = 0;
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    if (strcmp(the_paper.claims.claim[i].id, "eq-27") == 0) ja = i;
    if (strcmp(the_paper.claims.claim[i].id, "eq-5") == 0) k1 = i;
    if (strcmp(the_paper.claims.claim[i].id, "eq-41") == 0) j = i;
  }
  ck_assert(dependences_on(d, ja, k1) && dependences_on(d, j, k1) && !dependences_on(d, k1, ja));
  dependences_free(d);
  d = dependences_new(&the_paper.model, &the_paper.claims);
  ck_assert(!dependences_on(d, ja, k1) && !dependences_on(d, j, k1));
  dependences_free(d);
}

/* Two claims about one matrix stand beside each other; a third that uses it rests on both. */
TEST(claims_about_the_same) {
  OWNED(claims) own = {.n = 0};
  const char *path = scratch_put("same.claim", "claim a\n  section: stability\n  value: J_a\n  title: a\n"
                                               "claim b\n  section: stability\n  value: J_a\n  title: b\n"
                                               "claim c\n  section: stability\n  formula: J_b*J_a\n  title: c\n");
  goes_well(claims_add_file(&own, path, "claim", &d));
  struct dependences *on = dependences_new(&the_paper.model, &own);
  for (size_t a = 0; a < 3; a++)
    for (size_t b = 0; b < 3; b++) ck_assert_int_eq(dependences_on(on, a, b), a == 2 && b < 2);
  dependences_free(on);
}

/* Programs are the same when their formulas are, term by term. */
TEST(the_same_program) {
  static const char *const formulas[] = {"chi + eta", "chi - eta",  "chi + V",    "2*chi",   "3*chi",     "chi^2",
                                         "chi^3",     "[chi, eta]", "[eta, chi]", "omega_1", "omega_1*2", "chi"};
  enum { N = COUNT(formulas) };
  struct tape t[N][2];
  for (int i = 0; i < 2 * N; i++) {
    OWNED(elaboration) el;
    struct matrix m;
    elaboration_init(&el, (struct view){&the_paper.model, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
    goes_well(elaborate_tape(&t[i / 2][i % 2], &m, &el, "formula", formulas[i / 2], "appendix_a", &d));
  }
  for (int i = 0; i < N; i++)
    for (int k = 0; k < N; k++)
      ck_assert_msg(tape_same(&t[i][0], &t[k][1]) == (i == k), "%s, %s", formulas[i], formulas[k]);
  for (int i = 0; i < 2 * N; i++) tape_clear(&t[i / 2][i % 2]);
}

TEST(what_is_named_by_hand_must_exist) {
  OWNED(claims) own = {.n = 0};
  LOCAL(audit_result, r);
  const struct audit_options opt = {.n_only = 0};
  const struct claims none = {.n = 0};
  const char *path = scratch_put("own.claim", "claim eq-1\n  kind: definition\n  title: a\n  depends-on: eq-9, eq-2\n"
                                              "claim eq-2\n  kind: definition\n  title: b\n");
  goes_well(claims_add_file(&own, path, "claim", &d));
  fails_with(audit_run(&r, &the_paper.model, &own, &none, &the_paper.scene, &opt, &d),
             "own.claim:4:15: error: eq-1: depends-on names something that is not a claim");
}

/* --- What falls --- */

TABLE(failures, "tests/cases/errata_falls.tsv", 3);
enum { FAILURE, FALLS, SURVIVES }; /* its columns */

/* (10): D enters (12), (20), (23)-(25), N and all that is made of N or patched together, but how many equations these
   are worth does not change with the factor V, which is not zero, and (45) suffices whatever N is; (40): the entries of
   J_f enter (40), (41), but not what is said of J's trace (x_f and y_f move alike) and determinant (J_b J_a has rank
   1). */
TEST_EACH(what_falls_with_a_formula, failures.n) {
  char *const *row = failures.row[_i];
  const struct consequence *q = audit_result_consequence(&the_audit, row[FAILURE]);
  ck_assert_msg(q != NULL, "%s", row[FAILURE]);
  ck_assert_str_eq(joined(&q->falls), row[FALLS]);
  ck_assert_str_eq(joined(&q->survives), row[SURVIVES]);
  ck_assert_int_eq(q->open.n, 0);
}

/* Results whose formulas do not contain the failed one cannot change, and are the only ones of which that is said. */
TEST(what_provably_does_not_change) {
  static const struct {
    const char *failure, *reached;
  } cases[] = {
      {"eq-10", " N M M*[1; 1] -inv(N_1 - I)*N_2*z'_0 "}, {"eq-40", " J_f J tr(J) det(J) P(lambda) "}, {"eq-31", "  "}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    const struct consequence *q = audit_result_consequence(&the_audit, cases[i].failure);
    ck_assert_int_eq(q->n_derived, (int)the_paper.claims.n_results);
    for (int k = 0; k < q->n_derived; k++) {
      const char *padded = formatted(" %s ", q->derived[k].formula);
      bool reached = strstr(cases[i].reached, padded) != NULL;
      ck_assert_msg((q->derived[k].change == CHANGE_SAME_FORMULA) == !reached, "%s: %s: %s", cases[i].failure,
                    q->derived[k].formula, q->derived[k].verdict);
    }
  }
}

static double number_after(const char *where, const char *name) {
  const char *p = strstr(where, name);
  ck_assert_msg(p != NULL, "%s in %s", name, where);
  double a = 0, b = 1;
  ck_assert_int_ge(sscanf(p + strlen(name), " = %lf/%lf", &a, &b), 1);
  return a / b;
}

/* (40) prints V in the denominator of k_4 where it belongs in the numerator: k_4 is off by V^2, so that J_f[1,1] = 1 +
   k_4 is 1 + k_4/V^2; k_4 = V sin(omega t_d)/(omega (z_20 - z_10)). */
TEST(size_of_the_error_in_40) {
  const struct derived *d = derived_of("eq-40", "J_f");
  ck_assert_int_eq(d->change, CHANGE_CHANGES);
  ck_assert_str_eq(d->entry, "[1,1]");
  double v = number_after(d->where, "V"), ratio = (strtod(d->corrected, NULL) - 1) / (strtod(d->printed, NULL) - 1);
  ck_assert(v != 1);
  ck_assert_msg(fabs(ratio - v * v) < 1e-8 * v * v, "%g, V^2 = %g", ratio, v * v);
  double omega = sqrt(number_after(d->where, "chi") * number_after(d->where, "eta"));
  double apart = number_after(d->where, "z_20") - number_after(d->where, "z_10");
  double k_4 = v * sin(omega * number_after(d->where, "t_d")) / (omega * apart);
  ck_assert_double_eq_tol(strtod(d->corrected, NULL), 1 + k_4, 1e-8); /* by the orbit that is told */
  ck_assert_int_eq(derived_of("eq-40", "tr(J)")->change, CHANGE_AGREES);
  ck_assert_int_eq(derived_of("eq-40", "det(J)")->change, CHANGE_AGREES);
  ck_assert_int_eq(derived_of("eq-40", "P(lambda)")->change, CHANGE_AGREES);
  ck_assert_str_eq(derived_of("eq-40", "tr(J)")->verdict,
                   "proved equal, and agrees at 9 points"); /* the admissible orbit and eight others */
  ck_assert(derived_of("eq-40", "J")->chain == NULL);       /* no other failure reaches J */
}

/* Who solves the equations with V t in (10) meets V t_a in the place of t_a wherever D stands, and it stands nowhere
   else: the same solution, but for t_a, which is that of the orbit divided by V. */
TEST(what_the_equations_give_with_10) {
  const char *says = audit_result_consequence(&the_audit, "eq-10")->solved, *instead = " instead of ";
  ck_assert(says != NULL);
  double v = number_after(says, "V"), given = number_after(says, "give t_a"),
         orbit = strtod(strstr(says, instead) + strlen(instead), NULL);
  ck_assert(v != 1 && orbit > 0);
  ck_assert_msg(fabs(given * v - orbit) < 1e-9, "%s", says);
  ck_assert_msg(strstr(says, "and the same values of z_10, z_20, t_b, t_c and t_d, to 3"), "%s", says);
  ck_assert(audit_result_consequence(&the_audit, "eq-40")->solved == NULL);
  ck_assert(audit_result_consequence(&the_audit, "eq-29")->solved == NULL);
}

/* (10) prints V t for t: N = C H Gamma D changes by (V - 1) t_a times its first two columns.  Here with the model's
   matrix exponentials, in double precision, on the orbit of the example. */
TEST(size_of_the_error_in_10) {
  const struct derived *d = derived_of("eq-10", "N");
  ck_assert_int_eq(d->change, CHANGE_CHANGES);
  static const char *const names[] = {"chi", "eta", "V", "e1", "e2"};
  int row, col;
  ck_assert_int_eq(sscanf(d->entry, "[%d,%d]", &row, &col), 2);
  ck_assert_int_ge(col, 3);
  struct num_ctx ctx = num_ctx_double();
  OWNED(num_vec) n = vec_new(16, ctx), p = vec_new(16, ctx);
  double at_orbit[N_PARAMS];
  for (int i = 0; i < N_PARAMS; i++) at_orbit[i] = number_after(d->where, names[i]);
  OWNED(num_vec) params = vec_of(at_orbit, N_PARAMS, ctx);
  FREED_PARAMS fmpq *exact = rationals_d(at_orbit, N_PARAMS);
  OWNED(dyn_orbits) list = orbits_of(exact, 64);
  slong orbit = (slong)strtol(strstr(d->where, "orbit ") + 6, NULL, 10) - 1;
  double t_a = 0;
  for (int ph = 0; ph < N_PHASES; ph++) {
    double t = num_arb.get_d(list.orbit[orbit].t[ph]);
    if (ph == 0) t_a = t;
    ck_assert_int_eq(dyn_propagator(ph ? &p : &n, (enum phase)ph, &params, &t), SS_OK);
    if (ph) ck_assert_int_eq(num_mat_mul(&n, &p, &n, 4, 4, 4), SS_OK);
  }
  double at = ctx.type->get_d(num_vec_at(&n, 4 * (row - 1) + col - 1));
  double off = (number_after(d->where, "V") - 1) * t_a * ctx.type->get_d(num_vec_at(&n, 4 * (row - 1) + col - 3));
  double corrected = strtod(d->corrected, NULL), printed = strtod(d->printed, NULL), scale = fmax(1, fabs(at));
  ck_assert_msg(fabs(corrected - at) < 1e-7 * scale, "%g, not %g", corrected, at);
  ck_assert_msg(fabs(printed - corrected - off) < 1e-7 * scale, "%g, not %g", printed - corrected, off);
  ck_assert(fabs(off) > 1e-3);
}

/* A claim is judged alike alone and together, its effect and consequences included. */
TEST(alone_or_together) {
  static const char *const ids[] = {"eq-10", "eq-40", "eq-32b"};
  for (size_t i = 0; i < COUNT(ids); i++) {
    OWNED(audit_result) r = judge_only(&the_paper.model, ids[i]);
    const struct finding *a = finding_with_id(&r, ids[i]), *b = finding_with_id(&the_audit, ids[i]);
    ck_assert_str_eq(a->effect, b->effect);
    ck_assert_int_eq(a->n_depends_on, b->n_depends_on);
    const struct consequence *q = audit_result_consequence(&r, ids[i]);
    const char *alone = formatted("%s", joined(&q->falls));
    ck_assert_str_eq(alone, joined(&audit_result_consequence(&the_audit, ids[i])->falls));
    for (int k = 0; k < q->n_derived; k++) {
      const struct derived *other = derived_of(ids[i], q->derived[k].formula);
      ck_assert_str_eq(q->derived[k].verdict, other->verdict);
      if (other->printed) ck_assert_str_eq(q->derived[k].printed, other->printed);
    }
  }
}

/* --- Corrections set beside the printed text --- */

static struct audit_result judge_one(const char *overlay, const char *errata, const char *id) {
  OWNED(model) m = load(overlay, errata);
  return judge_only(&m, id);
}

TABLE(corrections, "tests/cases/corrections.tsv", 3);
enum { CORRECTED, CORRECTION, CHANGE }; /* its columns */

TEST_EACH(what_is_corrected, corrections.n) {
  char *const *row = corrections.row[_i];
  const struct finding *f = finding_with_id(&the_audit, row[CORRECTED]);
  ck_assert_int_eq(f->correction_verdict, VERDICT_PROVED);
  if (*row[CORRECTION]) ck_assert_str_eq(f->correction, row[CORRECTION]);
  if (*row[CHANGE]) ck_assert_str_eq(f->change, row[CHANGE]);
}

TEST(what_to_replace_by_what) {
  ck_assert(finding_with_id(&the_audit, "eq-32b")->change == NULL); /* one equation for two */
  OWNED(audit_result) r =
      judge_one("define user\n  section: stability\n  equation: 27\n  J_a := (1/(1 - chi))*[1, 1]\n",
                "define err\n  section: stability\n  equation: 27\n  J_a := (1/(1 - chi))*[-1, 1]\n", "eq-27");
  const struct finding *f = finding_with_id(&r, "eq-27");
  ck_assert_str_eq(f->change, "replace $1$ by $-1$");
  ck_assert_int_eq(f->correction_verdict, VERDICT_PROVED);
  ck_assert(strstr(f->correction_latex, "J_{a} = ") == f->correction_latex && strstr(f->printed_part, "J_{a} = "));
  const struct consequence *q = audit_result_consequence(&r, "eq-27");
  ck_assert(q && strstr(joined(&q->falls), "text-criterion"));
  ck_assert(!strstr(joined(&q->falls), "eq-41")); /* without the correction of (40) it fails in any case */
}

/* Wrong, and nothing says how to mend it: no consequence can be told. */
TEST(without_a_correction_nothing_is_said) {
  OWNED(audit_result) r =
      judge_one("define user\n  section: stability\n  J_a := (1/(1 - chi))*[1, 1]\n", NULL, "eq-27");
  ck_assert_int_eq(finding_with_id(&r, "eq-27")->verdict, VERDICT_REFUTED);
  ck_assert(finding_with_id(&r, "eq-27")->correction == NULL && audit_result_consequence(&r, "eq-27") == NULL);
  write_sheets(&r);
  shell_well("$Y tests/oracle/sheets.py $D");
}

/* --- The sheets --- */

/* In order of consequence; slips of notation behind, and the numbers at the end.  No name of a claim is told. */
TEST(worst_first) {
  LOCAL(text, t);
  report_errata(&t, &the_audit);
  static const char *const never[] = {"eq-",   "text-",  "num-",   "(10c)", "relative to their size",
                                      " +/- ", "(GHCD)", "reading"};
  for (size_t i = 0; i < COUNT(never); i++)
    ck_assert_msg(strstr(t.data, never[i]) == NULL, "%s: %.200s", never[i], strstr(t.data, never[i]));
  check_order(t.data, "tests/cases/order_errata.tsv");
}

/* With what is installed: the checker of the tests, Graphviz, LaTeX. */
static void check_sheets(const struct audit_result *r) {
  write_sheets(r);
  shell_well("$Y tests/oracle/sheets.py $D");
  if (there_is("dot")) shell_well("dot -Tsvg -o /dev/null $D/claims.dot");
  if (there_is("pdflatex")) shell_well("cd $D && pdflatex -halt-on-error -interaction=batchmode errata.tex");
}

/* Each way of showing a text, in each dialect. */
TEST(words_with_texts_in_them) {
  static const char *const shown[] = {
      [DIALECT_MARKDOWN] = "1\\_2 of x\\_2: $a_1$ and $z_{10}$, `a_b`; a&b refuted.",
      [DIALECT_TEX] = "1\\_2 of x\\_2: $a_1$ and $z_{10}$, \\texttt{a\\_b}; a&b refuted.",
      [DIALECT_HTML] =
          ("1_2 of <var>x<sub>2</sub></var>: MATH and <var>z<sub>10</sub></var>, <code>a_b</code>; a&b <span class=\"v "
           "refuted\">refuted</span>.")};
  for (int i = 0; i < 3; i++) {
    LOCAL(text, out);
    const struct sheet s = {&out, (enum dialect)i};
    const bool html = i == DIALECT_HTML;
    sheet_add(&s, "%e of %t: %m%s and %p, %c; %s %v%.", "1_2", "x_2", html ? NULL : "a_1", html ? "MATH" : NULL, "z_10",
              "a_b", "a&b", "refuted");
    ck_assert_str_eq(text_str(&out), shown[i]);
    text_reset(&out);
    sheet_add(&s, "%s%.", "It ends.");
    ck_assert_str_eq(text_str(&out), "It ends.");
  }
}

TEST(heads_of_tables) {
  LOCAL(text, out);
  markdown_head(&out, "a|b c:||d:|");
  ck_assert_str_eq(text_str(&out), "| a | b c | | d | |\n| --- | ---: | --- | ---: | --- |\n");
}

TEST(lists_in_sentences) {
  static const char *const list[] = {"t_b = 2", "t_c", "V"}, *const said[] = {"", "$t_{b}$ = 2",
                                                                              "$t_{b}$ = 2 and $t_{c}$",
                                                                              "$t_{b}$ = 2, $t_{c}$ and $V$"};
  for (int n = 0; n <= 3; n++) {
    LOCAL(text, out);
    sheet_list(&(struct sheet){&out, DIALECT_TEX}, list, n);
    ck_assert_str_eq(text_str(&out), said[n]);
  }
}

/* A page for what changes a result, two for the remarks and slips, the numbers and examples behind. */
TEST(the_sheet_has_its_pages) {
  write_sheets(&the_audit);
  if (!there_is("pdflatex")) {
    fprintf(stderr, "check_errata: pdflatex is not installed: the pages of errata.tex are not counted\n");
    return;
  }
  shell_ends(0, "Output written on errata.pdf (4 pages", "cd $D && pdflatex -halt-on-error errata.tex");
}

TEST(sheets_follow_their_grammars) {
  check_sheets(&the_audit);
}

CASE("writers", .each = {scratch_open, scratch_close});

/* Each trap in a number's place, in a formula's or a sign's, and in what they do. */
TEST_EACH(nothing_quoted_breaks_a_sheet, 2) {
  static const char *const faults[] = {"number", "formula", "number", "notation"};
  OWNED(table) traps = table_read("tests/cases/traps_errata.tsv", 1);
  OWNED(audit_result) r;
  traps_record(&r, &traps);
  for (size_t i = 0; i < r.n_findings; i++) {
    r.findings[i].of = OF_PAPER;
    r.findings[i].verdict = VERDICT_REFUTED;
    r.findings[i].fault = faults[(i + (size_t)_i) % 4];
  }
  check_sheets(&r);
}

/* Claims that rest on each other keep both arrows, and the closure is that of the lists (sheets.py). */
TEST(circles_in_the_graph) {
  static const char *ids[] = {"eq-1", "eq-2", "eq-3", "eq-4"};
  static struct finding f[4];
  for (int i = 0; i < 4; i++)
    f[i] = (struct finding){
        .id = ids[i], .title = "t", .verdict = VERDICT_PROVED, .reproduce = "r", .recorded = N_VERDICTS};
  const char *one[] = {"eq-2", "eq-3"}, *two[] = {"eq-3"}, *three[] = {"eq-2"}, *four[] = {"eq-1", "eq-2", "eq-3"};
  f[0].depends_on = one, f[0].n_depends_on = 2;
  f[1].depends_on = two, f[1].n_depends_on = 1;
  f[2].depends_on = three, f[2].n_depends_on = 1;
  f[3].depends_on = four, f[3].n_depends_on = 3;
  struct audit_result r = {.scene = "s", .title = "t", .findings = f, .n_findings = 4};
  write_sheets(&r);
  shell_well("$Y tests/oracle/sheets.py $D");
  LOCAL(text, t);
  report_dot(&t, &r);
  ck_assert(strstr(t.data, "\"eq-1\" -> \"eq-4\"") && !strstr(t.data, "\"eq-2\" -> \"eq-4\""));
  ck_assert(strstr(t.data, "\"eq-2\" -> \"eq-1\"") && strstr(t.data, "\"eq-3\" -> \"eq-1\""));
}

/* --- Results as data --- */

CASE("paper");

/* A result that the paper at hand cannot be asked for is left out; one that the printed form spoils is said to be. */
TEST(results_that_cannot_be_read) {
  LOCAL(audit_result, r);
  OWNED(claims) own;
  const struct claims none = {.n = 0};
  const char *only = "eq-27";
  const struct audit_options opt = {.only = &only, .n_only = 1};
  OWNED(model) m = load("define user\n  section: stability\n  equation: 27\n  J_a := (1/(1 - chi))*[1, 1, 1]\n",
                        "define err\n  section: stability\n  equation: 27\n  J_a := (1/(1 - chi))*[-1, 1]\n");
  paper_claims(&own, NULL);
  goes_well(claims_add_file(&own, scratch_put("more.claim", "result none\n  title: none\n  formula: no_such_name\n"),
                            "claim", &d));
  goes_well(audit_run(&r, &m, &own, &none, &the_paper.scene, &opt, &d));
  ck_assert_int_eq(finding_with_id(&r, "eq-27")->verdict, VERDICT_REFUTED);
  const struct consequence *q = audit_result_consequence(&r, "eq-27");
  ck_assert_ptr_nonnull(q);
  ck_assert_int_eq(q->n_derived, (int)own.n_results - 1);
  bool undefined = false;
  for (int i = 0; i < q->n_derived; i++)
    undefined |= strcmp(q->derived[i].formula, "tr(J)") == 0 && q->derived[i].change == CHANGE_UNDEFINED;
  ck_assert(undefined);
}
