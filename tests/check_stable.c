/* The stable layer: every form of verify/stable.eq is proved, none of them when damaged; double precision loses no more with
   them than the conditioning explains, at thousands of extreme points against balls, where the corrected forms lose all
   digits; and the audit says the same with them. */
#include "stickslip/stable.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"
#include "stable_points.h"
#include "stickslip/audit.h"
#include "stickslip/exact.h"
#include "suites.h"

static void load_model(struct model *m, const char *stable) {
  struct diag d;
  diag_init(&d);
  model_init(m);
  ck_assert_msg(model_add_folder(m, "verify/paper", RANK_PAPER, &d) &&
                    model_add_file(m, "verify/errata.eq", RANK_ERRATA, &d) &&
                    model_add_file(m, stable, RANK_STABLE, &d),
                "%s", d.message);
}

static struct model model;

static void setup(void) {
  scratch_open();
  load_model(&model, "verify/stable.eq");
}

static void teardown(void) {
  model_clear(&model);
  scratch_close();
}

/* --- Proofs --- */

START_TEST(every_form_is_proved) {
  static const char *const needed[] = {"omega",  "omega_1", "omega_2",  "lambda_1",     "lambda_2",      "H_1(t)",
                                       "H_2(t)", "H_3(t)",  "C_1(t)",   "C_2(t)",       "C_3(t)",        "Gamma_1(t)",
                                       "J_c",    "J_f",     "ktilde_4", "gammatilde_1", "text-criterion"};
  struct stable_proofs p;
  struct diag d;
  diag_init(&d);
  ck_assert_msg(stable_prove(&p, &model, &d), "%s", d.message);
  for (size_t i = 0; i < p.n; i++) {
    ck_assert_msg(!p.item[i].why_not, "%s of %s: %s", p.item[i].name, p.item[i].section, p.item[i].why_not);
    ck_assert_int_ge(p.item[i].entries, 1);
  }
  for (size_t k = 0; k < sizeof needed / sizeof *needed; k++) {
    size_t i = 0;
    while (i < p.n && strcmp(p.item[i].name, needed[k]) != 0) i++;
    ck_assert_msg(i < p.n, "no proof of %s", needed[k]);
  }
  stable_proofs_clear(&p);
  ck_assert_msg(view_check((struct view){&model, LAYER_STABLE, NULL, NULL}, &d), "%s", d.message);
}
END_TEST

/* One damage of the file each; what depends on it is not proved, and `proved` still is. */
static const struct {
  const char *was, *now, *refuted, *proved;
} damages[] = {
    {"2*sin(omega*t/2)^2, cos(omega*t)]", "2*sin(omega*t)^2, cos(omega*t)]", "C_1(t)", "C_2(t)"},
    {"t*((omega*t)^2*stumpff(omega*t))", "t*((omega*t)^2*sinc(omega*t))", "C_2(t)", "C_1(t)"},
    {"hypot(omega - slip_s, sqrt(chi))", "hypot(omega - slip_s, chi)", "omega_2", "omega"},
    {"omega*(slip_s/omega_2)", "omega*(slip_s/omega_p)", "omega_1", "omega_2"},
    {"(slip_s - omega))/2 + bend", "(omega - slip_s))/2 + bend", "lambda_1", "omega_1"},
    {"g_2 := chi*(omega/g_1)*omega", "g_2 := chi*(omega/g_1)", "H_1(t)", "lambda_2"},
    {"detune*far_X(t)/omega_2^2", "far_X(t)/omega_2^2", "H_1(t)", "lambda_2"},
    {"late(t) := 1 - early(t)", "late(t) := 1 - early(t)^2", "H_2(t)", "H_3(t)"},
    {"- versed(omega_p*t/2)*lag(omega_m*t/2)", "+ versed(omega_p*t/2)*lag(omega_m*t/2)", "H_2(t)", "H_1(t)"},
    {"rho*(t*near_W(t))/2", "rho*(t*near_W(t))", "H_3(t)", "H_2(t)"},
    {"g_3 := chi*(1 - chi)/(g_2 + chi)", "g_3 := chi*(1 - chi)/(g_2 - chi)", "J_c", "H_1(t)"},
    {"sum_4 := -(1 - chi)*", "sum_4 := (1 - chi)*", "J_c", "J_f"},
    {"2*sin(omega*t_d/2)^2 + ktilde_4", "2*sin(omega*t_d/2)^2 - ktilde_4", "J_f", "J_c"},
    {"(chi*V - z'_1b)", "(chi*V + z'_1b)", "gammatilde_1", "gammatilde_2"},
    {"ktilde_4 := (V/", "ktilde_4 := (2*V/", "ktilde_4", "ktilde_5"},
    {"ktilde_4 := (V/", "ktilde_4 := (2*V/", "J_f", "J_c"},
    {"ktilde_4 := (V/", "ktilde_4 := (2*V/", "text-criterion", "J_c"},
    {"ktilde_3 := omega*", "ktilde_3 := -omega*", "ktilde_3", "ktilde_2"},
    {"/omega)/omega\n  ktilde_7", "/omega)\n  ktilde_7", "ktilde_5", "ktilde_4"},
    {"(chi*V - z'_1b)", "(chi*V + z'_1b)", "text-criterion", "J_c"},
    {"+ t_d*sinc(omega*t_d)*rate)", "- t_d*sinc(omega*t_d)*rate)", "text-criterion", "J_f"},
    {"-1 < trace_J < 1", "-1 < trace_J <= 1", "text-criterion", "J_f"},
};

START_TEST(a_damaged_form_is_not_proved) {
  struct source src;
  struct diag d;
  struct text t;
  struct stable_proofs p;
  struct model damaged;
  diag_init(&d);
  text_init(&t);
  ck_assert(source_read(&src, "verify/stable.eq", 1 << 20, &d));
  const char *at = strstr(src.text, damages[_i].was);
  ck_assert_msg(at && !strstr(at + 1, damages[_i].was), "%s stands there once", damages[_i].was);
  text_add_n(&t, src.text, (size_t)(at - src.text));
  text_add(&t, damages[_i].now);
  text_add(&t, at + strlen(damages[_i].was));
  load_model(&damaged, scratch_put("stable.eq", text_str(&t)));
  ck_assert_msg(stable_prove(&p, &damaged, &d), "%s", d.message);
  bool refuted = false, proved = false;
  for (size_t i = 0; i < p.n; i++) {
    refuted = refuted || (strcmp(p.item[i].name, damages[_i].refuted) == 0 && p.item[i].why_not);
    proved = proved || (strcmp(p.item[i].name, damages[_i].proved) == 0 && !p.item[i].why_not);
  }
  ck_assert_msg(refuted && proved, "%s: refuted %d, the rest proved %d", damages[_i].now, refuted, proved);
  stable_proofs_clear(&p);
  model_clear(&damaged);
  source_clear(&src);
  text_clear(&t);
}
END_TEST

/* The first two arguments are zero for all V > 0 or all z_1b > 0, where sinc is 1: no divisors. */
START_TEST(a_hidden_zero_is_no_divisor) {
  static const char *const forms[][3] = {
      {"sqrt(4*V) - 2*sqrt(V)", "(sinc(gap)*sinc(2*gap))*(gap + sqrt(4*V) + 2*sqrt(V))", "sinc(gap)*(sinc(2*gap)*gap)"},
      {"abs(z_1b) - z_1b", "sinc(gap)", "sin(gap)/gap"},
      {"sqrt(4*V) + sqrt(V)", "sinc(gap)", "sin(gap)/gap"},
  };
  for (int i = 0; i < 3; i++) {
    struct text file[2];
    struct model m;
    struct diag d;
    struct stable_proofs p;
    diag_init(&d);
    for (int k = 0; k < 2; k++) {
      text_init(&file[k]);
      text_printf(&file[k], "define test\n  section: stability\n  gap := %s\n  form := %s\n", forms[i][0],
                  forms[i][1 + k]);
    }
    load_model(&m, scratch_put("stable.eq", text_str(&file[1])));
    ck_assert_msg(model_add_file(&m, scratch_put("errata.eq", text_str(&file[0])), RANK_ERRATA, &d), "%s", d.message);
    ck_assert_msg(stable_prove(&p, &m, &d), "%s", d.message);
    ck_assert(p.n == 2 && strcmp(p.item[1].name, "form") == 0);
    ck_assert_msg(!p.item[1].why_not == (i == 2), "%s", forms[i][0]);
    stable_proofs_clear(&p);
    model_clear(&m);
    for (int k = 0; k < 2; k++) text_clear(&file[k]);
  }
}
END_TEST

START_TEST(what_cannot_be_read_is_said) {
  static const char *const bad[][2] = {
      {"define s\n  section: appendix_a\n  omega_1 := nothing\n", "undefined symbol nothing"},
      {"define s\n  section: appendix_a\n  C_1(t) := [1, 0]\n", NULL},
      {"inequality nowhere\n  section: stability\n  chi < 1\n", "nowhere replaces no record"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    struct model m;
    struct stable_proofs p;
    struct diag d;
    diag_init(&d);
    load_model(&m, scratch_put("stable.eq", bad[i][0]));
    bool ok = stable_prove(&p, &m, &d);
    if (bad[i][1])
      ck_assert_msg(!ok && strstr(d.message, bad[i][1]), "%s", d.message);
    else
      ck_assert(ok && p.n == 1 && strcmp(p.item[0].why_not, "the forms have different shapes") == 0);
    stable_proofs_clear(&p);
    model_clear(&m);
  }
}
END_TEST

/* --- Layers --- */

START_TEST(the_stable_layer_hides_the_corrected_one) {
  struct diag d;
  diag_init(&d);
  for (int own = 0; own < 2; own++)
    for (int layer = 0; layer < N_LAYERS; layer++) {
      struct view v = {&model, (enum layer)layer, own ? "50" : NULL, NULL};
      const struct definition *def = view_lookup(&v, "C_1", "appendix_a", &d), *part;
      ck_assert(def && (def->rank == RANK_STABLE) == (layer == LAYER_STABLE && !own));
      def = view_lookup(&v, "D", "prediction", &d);
      ck_assert(def && (def->rank == RANK_ERRATA) == (layer != LAYER_PRINTED));
      part = view_lookup(&v, "omega_p", "appendix_a", &d);
      ck_assert(!part == (layer != LAYER_STABLE));
    }
  model.stable = true; /* then corrected is read as stable */
  struct view v = {&model, LAYER_CORRECTED, NULL, NULL};
  ck_assert(view_lookup(&v, "C_1", "appendix_a", &d)->rank == RANK_STABLE);
  v.layer = LAYER_PRINTED;
  ck_assert(view_lookup(&v, "C_1", "appendix_a", &d)->rank == RANK_PAPER);
  model.stable = false;
}
END_TEST

/* --- Digits --- */

/* at_fault: the corrected form loses digits beyond its condition, thousands of units of it at the least. */
static const struct {
  const char *value, *corrected, *section;
  int points;
  bool at_fault;
} formulas[] = {
    {"omega", NULL, "appendix_a", 3000, true},
    {"omega_1", NULL, "appendix_a", 3000, true},
    {"omega_2", NULL, "appendix_a", 3000, true},
    {"lambda_1", NULL, "appendix_a", 3000, true},
    {"lambda_2", NULL, "appendix_a", 3000, true},
    {"H(t)", NULL, "appendix_a", 1500, true},
    {"Gamma(t)", NULL, "appendix_a", 3000, true},
    {"C(t)", NULL, "appendix_a", 3000, true},
    {"D(t)", NULL, "prediction", 500, false},
    {"J_a", NULL, "stability", 1000, false},
    {"J_b", NULL, "stability", 3000, false},
    {"J_c", NULL, "stability", 1500, true},
    {"J_f", NULL, "stability", 3000, true},
    {"[ktilde_1, ktilde_2, ktilde_3, ktilde_4, ktilde_5, ktilde_6, ktilde_7]", NULL, "stability", 3000, true},
    {"trace_J", "tr(J)", "stability", 1000, true},
    {"V*t_a*(1 - chi)/2", NULL, "appendix_b", 1000, false},
    {"(e_2 - chi*(z_20 - z_10))/2", NULL, "appendix_b", 1000, false},
    {"[d_01, d_02]", NULL, "model", 1000, false},
};

START_TEST(no_more_is_lost_than_the_condition_explains) {
  enum { PROMISED = 8 };
  struct extreme_form stable, corrected;
  long measured = 0;
  double worst = 0;
  const char *other = formulas[_i].corrected ? formulas[_i].corrected : formulas[_i].value;
  extreme_form_init(&stable, &model, LAYER_STABLE, formulas[_i].value, formulas[_i].value, formulas[_i].section);
  extreme_form_init(&corrected, &model, LAYER_CORRECTED, other, formulas[_i].value, formulas[_i].section);
  for (int seed = 1; seed <= formulas[_i].points; seed++) {
    struct extreme_point p;
    struct extreme_result r;
    extreme_point_draw(&p, (uint64_t)seed);
    extreme_measure(&r, &stable, &p);
    for (int k = 0; k < stable.n; k++) {
      if (r.loss[k] <= PROMISED) {
        measured += r.loss[k] >= 0;
        continue;
      }
      struct text where;
      text_init(&where);
      extreme_print(&where, &stable, &p);
      ck_abort_msg("%s, entry %d at %s: %a, not %a, loses %g times its condition %g", formulas[_i].value, k,
                   text_str(&where), r.value[k], r.truth[k], r.loss[k], r.condition[k]);
    }
    if (worst > 1e6 || seed > 600) continue;
    extreme_measure(&r, &corrected, &p);
    for (int k = 0; k < corrected.n; k++) worst = fmax(worst, r.loss[k]);
  }
  ck_assert_int_gt(measured, stable.n * formulas[_i].points / 2);
  ck_assert_msg((worst > 1000) == formulas[_i].at_fault, "%s as corrected loses %g", other, worst);
  extreme_form_clear(&corrected);
  extreme_form_clear(&stable);
}
END_TEST

/* chi_b = z'_1b/V is too large for a double, gammatilde_1 = (chi V - z'_1b)/(V - z'_1b) is 1. */
START_TEST(a_ratio_that_overflows_is_not_formed) {
  for (int layer = LAYER_CORRECTED; layer < N_LAYERS; layer++) {
    struct extreme_form f;
    struct num_vec in, out;
    extreme_form_init(&f, &model, (enum layer)layer, "gammatilde_1", "gammatilde_1", "stability");
    num_vec_init(&in, f.tape.n_inputs, num_ctx_double());
    num_vec_init(&out, 1, num_ctx_double());
    for (slong k = 0; k < f.tape.n_inputs; k++) {
      const char *name = f.tape.inputs[k];
      double x = strcmp(name, "chi") == 0 ? 0.5 : strcmp(name, "V") == 0 ? 0x1p-1000 : 0x1p100;
      num_double.set_d(num_vec_at(&in, k), x, 53);
    }
    int status = tape_eval(&out, NULL, &f.tape, &in);
    ck_assert_int_eq(status, layer == LAYER_STABLE ? SS_OK : SS_UNABLE);
    if (status == SS_OK) ck_assert(num_double.get_d(num_vec_at(&out, 0)) == 1);
    num_vec_clear(&out);
    num_vec_clear(&in);
    extreme_form_clear(&f);
  }
}
END_TEST

/* The truth is not the form's own: balls of both layers overlap wherever the corrected one can be told. */
START_TEST(both_layers_have_one_truth) {
  const char *value = formulas[_i].value, *section = formulas[_i].section;
  struct extreme_form stable, corrected;
  extreme_form_init(&stable, &model, LAYER_STABLE, value, value, section);
  extreme_form_init(&corrected, &model, LAYER_CORRECTED, formulas[_i].corrected ? formulas[_i].corrected : value, value,
                    section);
  long compared = 0;
  for (int seed = 1; seed <= 40; seed++) {
    struct extreme_point p;
    extreme_point_draw(&p, (uint64_t)seed);
    arb_ptr x = _arb_vec_init(2 * MOST_ENTRIES);
    extreme_balls(x, &stable.tape, &p, 3000);
    extreme_balls(x + MOST_ENTRIES, &corrected.tape, &p, 3000);
    for (int k = 0; k < stable.n; k++) {
      ck_assert_msg(arb_overlaps(x + k, x + MOST_ENTRIES + k), "%s, entry %d, point %d", value, k, seed);
      compared += arb_rel_accuracy_bits(x + k) > 100 && arb_rel_accuracy_bits(x + MOST_ENTRIES + k) > 100;
    }
    _arb_vec_clear(x, 2 * MOST_ENTRIES);
  }
  ck_assert_int_gt(compared, 15 * stable.n / 2);
  extreme_form_clear(&corrected);
  extreme_form_clear(&stable);
}
END_TEST

/* --- The audit --- */

static void judge(struct audit_result *out, bool stable) {
  struct claims claims = {.n = 0}, none = {.n = 0};
  struct scene paper;
  struct diag d;
  diag_init(&d);
  audit_result_init(out);
  model.stable = stable;
  const struct audit_options opt = {NULL, 0, NULL, NULL, false};
  ck_assert_msg(claims_load(&claims, "verify/claims", "claim", &d) && scene_load(&paper, "paper", "verify", &d) &&
                    audit_run(out, &model, &claims, &none, &paper, &opt, &d),
                "%s", d.message);
  scene_clear(&paper);
  claims_clear(&claims);
  model.stable = false;
}

/* Proofs by exact algebra use the corrected forms in both; balls and rounded numbers do not. */
START_TEST(both_layers_give_the_same_verdicts) {
  struct audit_result corrected, stable;
  judge(&corrected, false);
  judge(&stable, true);
  ck_assert_uint_eq(corrected.n_findings, stable.n_findings);
  for (size_t i = 0; i < stable.n_findings; i++) {
    const struct finding *a = &corrected.findings[i], *b = &stable.findings[i];
    ck_assert_str_eq(a->id, b->id);
    ck_assert_msg(a->verdict == b->verdict && a->correction_verdict == b->correction_verdict, "%s: %s, not %s", b->id,
                  verdict_name[b->verdict], verdict_name[a->verdict]);
  }
  audit_result_clear(&stable);
  audit_result_clear(&corrected);
}
END_TEST

/* --- What the exact field knows of the functions --- */

static int value_in(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *text) {
  struct elaboration el;
  struct arena a;
  struct source src;
  struct matrix m;
  struct tape t;
  struct diag d;
  struct exact_vec v;
  diag_init(&d);
  arena_init(&a);
  source_from_string(&src, "test", text);
  elaboration_init(&el, (struct view){&model, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
  const struct expr *e = expr_parse(&a, &src, (struct span){0, src.len}, &d);
  ck_assert_msg(e && elaborate(&m, &el, e, &src, "", &d) && elaboration_tape(&t, &el, m.e, 1, &d), "%s", d.message);
  int s = exact_eval(&v, f, &t);
  if (s == SS_OK) num_exact.set(z, &v.x[0]);
  exact_vec_clear(&v);
  tape_clear(&t);
  elaboration_clear(&el);
  source_clear(&src);
  arena_clear(&a);
  return s;
}

/* With t/4 and V t/4 as angles of which others are made, and V known to be positive. */
static const struct {
  const char *left, *right;
  bool equal;
} identities[] = {
    {"sinc(t)*t", "sin(t)", true},
    {"sinc(0)", "1", true},
    {"stumpff(t - t)", "1/6", true},
    {"stumpff(t)*t^3 + sin(t)", "t", true},
    {"hypot(chi, eta)^2", "chi^2 + eta^2", true},
    {"hypot(chi, eta)", "hypot(eta, chi)", true},
    {"hypot(chi, eta)", "chi + eta", false},
    {"abs(chi - eta)^2", "(chi - eta)^2", true},
    {"abs(chi - eta)", "abs(eta - chi)", true},
    {"abs(chi - eta)", "chi - eta", false},
    {"abs(chi/eta - 1)^2", "(1 - chi/eta)^2", true},
    {"abs(chi - chi)", "0", true},
    {"sqrt(V^2)", "V", true},
    {"sqrt(chi^2)", "chi", false}, /* nothing says that chi is positive here */
    {"hypot(V, 0)", "V", true},
    {"sqrt(chi/4)", "sqrt(chi/9)*3/2", false}, /* not known: roots of different elements */
    {"sqrt(chi/4)^2", "chi/4", true},
    {"1 - cos(t)", "2*sin(t/2)^2", true},
    {"1 - cos(t)", "2*sin(t/4)^2", false},
    {"sin(t)", "2*sin(t/2)*cos(t/2)", true},
    {"sin(-t + V*t/2)", "sin(V*t/2)*cos(t) - cos(V*t/2)*sin(t)", true},
    {"cos(t - V*t/2)", "cos(t)*cos(V*t/2) - sin(t)*sin(V*t/2)", false},
    {"cos(t)*cos(V*t) - sin(t)*sin(V*t)", "cos(t + V*t)", true},
};

START_TEST(the_field_knows_the_functions) {
  fmpz_mpoly_q_struct x, y, known[3];
  struct exact_field *f = exact_field_new(NULL, 0);
  exact_init(&x, f);
  exact_init(&y, f);
  static const char *const elements[] = {"V", "t/4", "V*t/4"};
  for (int i = 0; i < 3; i++) {
    exact_init(&known[i], f);
    ck_assert_int_eq(value_in(&known[i], f, elements[i]), SS_OK);
  }
  exact_field_positive(f, known, 1);
  exact_field_angles(f, known + 1, 2, 2);
  ck_assert_int_eq(value_in(&x, f, identities[_i].left) | value_in(&y, f, identities[_i].right), SS_OK);
  ck_assert_msg(exact_equal(f, &x, &y) == identities[_i].equal, "%s and %s", identities[_i].left, identities[_i].right);
  for (int i = 0; i < 3; i++) exact_clear(&known[i], f);
  exact_clear(&y, f);
  exact_clear(&x, f);
  exact_field_free(f);
}
END_TEST

Suite *stable_suite(void) {
  Suite *s = suite_create("stable");
  TCase *c = tcase_create("stable");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_set_timeout(c, 120);
  tcase_add_test(c, every_form_is_proved);
  tcase_add_loop_test(c, a_damaged_form_is_not_proved, 0, sizeof damages / sizeof *damages);
  tcase_add_test(c, a_hidden_zero_is_no_divisor);
  tcase_add_test(c, what_cannot_be_read_is_said);
  tcase_add_test(c, the_stable_layer_hides_the_corrected_one);
  tcase_add_loop_test(c, no_more_is_lost_than_the_condition_explains, 0, sizeof formulas / sizeof *formulas);
  tcase_add_test(c, a_ratio_that_overflows_is_not_formed);
  tcase_add_loop_test(c, both_layers_have_one_truth, 0, sizeof formulas / sizeof *formulas);
  tcase_add_loop_test(c, the_field_knows_the_functions, 0, sizeof identities / sizeof *identities);
  suite_add_tcase(s, c);
  TCase *audits = tcase_create("audits");
  tcase_set_tags(audits, "long");
  tcase_add_checked_fixture(audits, setup, teardown);
  tcase_set_timeout(audits, 120);
  tcase_add_test(audits, both_layers_give_the_same_verdicts);
  suite_add_tcase(s, audits);
  return s;
}
