/* The stable layer: every form of verify/stable.eq is proved, none of them when damaged; double precision loses no more
   with them than the conditioning explains, at thousands of extreme points against balls, where the corrected forms
   lose all digits. */
#include "proof/stable_forms.h"

#include "element.h"
#include "every.h"
#include "paper_model.h"
#include "rational.h"
#include "stability/stability_impl.h"
#include "test.h"

/* --- The layer --- */

static struct model model;

static void setup(void) {
  scratch_open();
  model = paper_model(&(struct paper_layers){.stable = "verify/stable.eq"});
}

static void teardown(void) {
  model_clear(&model);
  scratch_close();
}

/* A formula of one layer, ready to be run. */
struct layer_tape {
  struct elaboration el;
  struct tape tape;
};

static void layer_tape_init(struct layer_tape *f, enum layer layer, const char *text, const char *section) {
  struct matrix m;
  elaboration_init(&f->el, (struct view){&model, layer, NULL, NULL}, NULL, 0);
  goes_well(elaborate_tape(&f->tape, &m, &f->el, "test", text, section, &d));
}

static void layer_tape_clear(struct layer_tape *f) {
  tape_clear(&f->tape);
  elaboration_clear(&f->el);
}

/* --- Proofs --- */

CASE("stable", .once = {setup, teardown});

TEST(every_form_is_proved) {
  OWNED(table) needed = table_read("tests/cases/stable_needed.tsv", 1);
  OWNED(stable_proofs) p;
  goes_well(stable_prove(&p, &model, false, &d));
  for (size_t i = 0; i < p.n; i++) {
    ck_assert_msg(!p.item[i].why_not, "%s of %s: %s", p.item[i].name, p.item[i].section, p.item[i].why_not);
    ck_assert_int_ge(p.item[i].entries, 1);
  }
  for (int k = 0; k < needed.n; k++) {
    size_t i = 0;
    while (i < p.n && strcmp(p.item[i].name, needed.row[k][0]) != 0) i++;
    ck_assert_msg(i < p.n, "no proof of %s", needed.row[k][0]);
  }
  goes_well(view_check((struct view){&model, LAYER_STABLE, NULL, NULL}, &d));
}

/* One damage of the file each; what depends on it is not proved, and `proved` still is. */
TABLE(damages, "tests/cases/stable_damages.tsv", 4);
enum { D_WAS, D_NOW, D_REFUTED, D_PROVED }; /* its columns */

CASE("damages", .each = {scratch_open, scratch_close}, .tags = "long");

TEST_EVERY(a_damaged_form_is_not_proved, 11, damages.n) {
  FREED char *text = file_text("verify/stable.eq");
  OWNED(stable_proofs) p;
  const char *at = strstr(text, damages.row[_i][D_WAS]);
  ck_assert_msg(at && !strstr(at + 1, damages.row[_i][D_WAS]), "%s stands there once", damages.row[_i][D_WAS]);
  const char *file = scratch_put("stable.eq", replaced(text, damages.row[_i][D_WAS], damages.row[_i][D_NOW]));
  OWNED(model) damaged = paper_model(&(struct paper_layers){.stable = file});
  bool algebra = _i % 4 == 0; /* of the others points know it first */
  goes_well(stable_prove(&p, &damaged, algebra, &d));
  bool refuted = false, proved = false;
  for (size_t i = 0; i < p.n; i++) {
    refuted = refuted || (strcmp(p.item[i].name, damages.row[_i][D_REFUTED]) == 0 && p.item[i].why_not);
    proved = proved || (strcmp(p.item[i].name, damages.row[_i][D_PROVED]) == 0 && !p.item[i].why_not);
  }
  ck_assert_msg(refuted && proved, "%s: refuted %d, the rest proved %d", damages.row[_i][D_NOW], refuted, proved);
}

CASE("stable");

/* The first two arguments are zero for all V > 0 or all z_1b > 0, where sinc is 1: no divisors. */
TEST(a_hidden_zero_is_no_divisor) {
  static const char *const forms[][3] = {
      {"sqrt(4*V) - 2*sqrt(V)", "(sinc(gap)*sinc(2*gap))*(gap + sqrt(4*V) + 2*sqrt(V))", "sinc(gap)*(sinc(2*gap)*gap)"},
      {"abs(z_1b) - z_1b", "sinc(gap)", "sin(gap)/gap"},
      {"sqrt(4*V) + sqrt(V)", "sinc(gap)", "sin(gap)/gap"},
  };
  for (int i = 0; i < 3; i++) {
    struct text file[2];
    OWNED(stable_proofs) p;
    for (int k = 0; k < 2; k++) {
      text_init(&file[k]);
      text_printf(&file[k], "define test\n  section: stability\n  gap := %s\n  form := %s\n", forms[i][0],
                  forms[i][1 + k]);
    }
    OWNED(model) m = paper_model(&(struct paper_layers){.stable = scratch_put("stable.eq", text_str(&file[1]))});
    goes_well(model_add_file(&m, scratch_put("errata.eq", text_str(&file[0])), RANK_ERRATA, &d));
    goes_well(stable_prove(&p, &m, false, &d));
    ck_assert(p.n == 2 && strcmp(p.item[1].name, "form") == 0);
    ck_assert_msg(!p.item[1].why_not == (i == 2), "%s", forms[i][0]);
    for (int k = 0; k < 2; k++) text_clear(&file[k]);
  }
}

/* False or empty theorems that look like forms: definitions of verify/errata.eq's rank, then of stable.eq's; the name
   must not be proved, for that reason, or where there is none the file must not be read.  abs(V - 2) + V is 2 below V
   = 2, where points are drawn, and no number above. */
TABLE(forgeries, "tests/cases/stable_forgeries.tsv", 4);
enum { F_CORRECTED, F_STABLE, F_NAME, F_SAID }; /* its columns */

CASE("forged", .once = {setup, teardown});

TEST_EACH(no_forgery_is_proved, forgeries.n) {
  struct diag d = {0};
  struct stable_proofs p;
  OWNED(model) m = paper_model(&(struct paper_layers){.stable = scratch_put("stable.eq", forgeries.row[_i][F_STABLE])});
  ck_assert_msg(model_add_file(&m, scratch_put("errata.eq", forgeries.row[_i][F_CORRECTED]), RANK_ERRATA, &d), "%s",
                d.message);
  char *const *row = forgeries.row[_i];
  for (int algebra = 0; algebra < 2; algebra++) {
    bool read = stable_prove(&p, &m, algebra, &d), met = !read;
    ck_assert_msg(read == (*row[F_NAME] != '\0'), "%s: read %d", row[F_STABLE], read);
    if (!read) ck_assert_msg(strstr(d.message, row[F_SAID]), "%s", d.message);
    for (size_t i = 0; i < p.n && read; i++) {
      if (strcmp(p.item[i].name, row[F_NAME]) != 0) continue;
      met = true;
      const char *why = p.item[i].why_not;
      ck_assert_msg(why && strstr(why, row[F_SAID]), "%s%s: %s", why ? why : "proved", algebra ? " by the algebra" : "",
                    row[F_STABLE]);
    }
    ck_assert_msg(met, "%s", row[F_STABLE]);
    stable_proofs_clear(&p);
  }
}

CASE("stable");

/* A part is held as an unknown only when it was proved: with a wrong one nothing after it is. */
TEST(a_wrong_part_proves_nothing) {
  static const char *const file =
      "define part\n  section: validation\n  equals: N_1 - I\n  wrong := N_1 + I\n"
      "define whole\n  section: validation\n  equation: 45\n  M := inv(wrong)*N_2 - inv(N_3)*(N_4 - I)\n";
  OWNED(stable_proofs) p;
  OWNED(model) m = paper_model(&(struct paper_layers){.stable = scratch_put("stable.eq", file)});
  goes_well(stable_prove(&p, &m, false, &d));
  ck_assert_uint_eq(p.n, 2);
  ck_assert(p.item[0].why_not && p.item[1].why_not);
}

/* (45) and (46) at small times, where the corrected forms keep no digit, against the truth in balls. */
TEST(small_times_keep_their_digits) {
  static const char *const value[] = {"M", "N_3", "inv(N_1 - I)*N_2*z'_0"};
  static const char *const stable[] = {"M", "N_3",
                                       ("[(chi*share_r + share_w)/(1 - chi) - t_a; (share_r + share_w)/(1 - "
                                        "chi) - t_a]*(-V)")};
  for (size_t k = 0; k < COUNT(value); k++) {
    OWNED(layer_tape) f, t;
    layer_tape_init(&f, LAYER_STABLE, stable[k], "validation");
    layer_tape_init(&t, LAYER_CORRECTED, value[k], "validation");
    slong n = f.tape.n_outputs;
    OWNED(num_vec) in = vec_new(f.tape.n_inputs, num_ctx_double()), out = vec_new(n, num_ctx_double());
    OWNED(num_vec) exact_in = vec_new(t.tape.n_inputs, num_ctx_arb(2000)), exact = vec_new(n, num_ctx_arb(2000));
    for (int at = 0; at < 2; at++) {
      const struct tape *of = at ? &t.tape : &f.tape;
      for (slong i = 0; i < of->n_inputs; i++) {
        const char *name = of->inputs[i];
        double x = name[0] == 't' ? ldexp(1 + 0.25 * (name[2] - 'a'), -40) : strcmp(name, "chi") == 0 ? 0.75 : 1.5;
        if (at)
          arb_set_d(num_vec_at(&exact_in, i), x);
        else
          *(double *)num_vec_at(&in, i) = x;
      }
    }
    ck_assert_int_eq(tape_eval(&out, NULL, &f.tape, &in), SS_OK);
    ck_assert_int_eq(tape_eval(&exact, NULL, &t.tape, &exact_in), SS_OK);
    for (slong i = 0; i < n; i++) {
      double true_value = num_arb.get_d((arb_ptr)num_vec_at(&exact, i));
      double off = fabs(*(double *)num_vec_at(&out, i) - true_value) / fabs(true_value) * 0x1p53;
      ck_assert_msg(off < 60, "%s, entry %ld: %g units", value[k], (long)i, off);
    }
  }
}

/* --- Layers --- */

TEST(the_stable_layer_hides_the_corrected_one) {
  struct diag d = {0};
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
}

/* --- Digits --- */

/* What the entries of a formula, each by itself, lose beyond their conditions at points of every region. */
struct extremes {
  long measured, failed;
  double worst; /* digits */
  struct text where;
};

/* No product of two times, velocities or states is beyond a double, nor one of eta and the squares of times. */
static bool can_be_asked(const struct digits_formula *f, const double *x) {
  for (slong k = 0; k < f->tape.n_inputs; k++) {
    bool parameter = f->input[k] == INPUT_CHI || f->input[k] == INPUT_ETA;
    if (fabs(log2(fabs(x[k]))) > (parameter ? 900 : 500)) return false;
  }
  return true;
}

static void measure_entry(struct extremes *e, struct digits_set *s, struct digits_formula *f, int points) {
  uint64_t state = random_seed(f->text);
  OWNED(digits_bench) w;
  digits_bench_init(&w, f);
  for (int k = 0; k < n_digits_regions; k++) {
    struct digits_place *p = digits_place_new(k, &w, s);
    for (int i = 0; p && i < points * digits_region_width(k); i++) {
      double u[DIGITS_COORDINATES], x[DIGITS_INPUTS];
      for (int j = 0; j < DIGITS_COORDINATES; j++) u[j] = random_unit(&state);
      if (!digits_point(x, p, u) || !can_be_asked(f, x)) continue;
      struct digits_loss l = digits_measure(&w, x, -1);
      bool failed = l.kind == DIGITS_FAILED && digits_log2(num_vec_at(&w.b, f->out[0])) > -1000,
           worse = l.kind == DIGITS_LOST && l.formula > e->worst;
      e->measured += l.kind == DIGITS_LOST;
      e->failed += failed;
      if (worse) e->worst = l.formula;
      if (!failed && !worse) continue;
      text_reset(&e->where);
      digits_print_point(&e->where, f, x);
    }
    digits_place_free(p);
  }
}

static void measure(struct extremes *e, enum layer layer, const char *text, const char *section) {
  const int points = 70 / every(7);
  OWNED(digits_set) s;
  struct digits_formula f;
  *e = (struct extremes){.measured = 0};
  goes_well(digits_set_make(&s, &model, layer, &d));
  goes_well(digits_formula_of(&f, &s, text, text, section, &d));
  for (slong i = 0; i < f.n; i++) {
    struct digits_formula entry = f;
    entry.n = 1;
    entry.entry += i;
    goes_well(digits_formula_make(&entry, &s, &d));
    if (entry.tape.n_inputs > 0) measure_entry(e, &s, &entry, points);
    digits_formula_clear(&entry);
  }
  digits_formula_clear(&f);
  ck_assert_msg(e->measured > 8 * points, "%s: %ld", text, e->measured);
}

TABLE(formulas, "tests/cases/stable_formulas.tsv", 4);
enum { STABLE, CORRECTED, SECTION, AT_FAULT }; /* its columns */

/* at_fault: the corrected form loses digits by the thousand units, or has no value. */
TEST_EACH(no_more_is_lost_than_the_condition_explains, formulas.n) {
  char *const *row = formulas.row[_i];
  const char *other = *row[CORRECTED] ? row[CORRECTED] : row[STABLE];
  struct extremes stable, corrected;
  measure(&stable, LAYER_STABLE, row[STABLE], row[SECTION]);
  ck_assert_msg(!stability_is_loss(stable.worst) && stable.failed == 0, "%s loses %g digits or fails %ld times, at %s",
                row[STABLE], stable.worst, stable.failed, text_str(&stable.where));
  measure(&corrected, LAYER_CORRECTED, other, row[SECTION]);
  ck_assert_msg((corrected.worst > 3 || corrected.failed > 0) == is_yes(row[AT_FAULT]),
                "%s as corrected loses %g digits and fails %ld times", other, corrected.worst, corrected.failed);
  text_clear(&stable.where);
  text_clear(&corrected.where);
}

/* chi_b = z'_1b/V is too large for a double, gammatilde_1 = (chi V - z'_1b)/(V - z'_1b) is 1. */
TEST(a_ratio_that_overflows_is_not_formed) {
  for (int layer = LAYER_CORRECTED; layer < N_LAYERS; layer++) {
    OWNED(layer_tape) f;
    layer_tape_init(&f, (enum layer)layer, "gammatilde_1", "stability");
    OWNED(num_vec) in = vec_new(f.tape.n_inputs, num_ctx_double()), out = vec_new(1, num_ctx_double());
    for (slong k = 0; k < f.tape.n_inputs; k++) {
      const char *name = f.tape.inputs[k];
      double x = strcmp(name, "chi") == 0 ? 0.5 : strcmp(name, "V") == 0 ? 0x1p-1000 : 0x1p100;
      num_double.set_d(num_vec_at(&in, k), x, 53);
    }
    int status = tape_eval(&out, NULL, &f.tape, &in);
    ck_assert_int_eq(status, layer == LAYER_STABLE ? SS_OK : SS_UNABLE);
    if (status == SS_OK) ck_assert(num_double.get_d(num_vec_at(&out, 0)) == 1);
  }
}

/* --- A value wherever the corrected form has one --- */

/* Of every step-th pair: names the forms that fail; the points they have seen, and how many of these told nothing.
   Returns how many pairs there are. */
static size_t agree_everywhere(struct text *fails, long *points, long *undecided, const struct model *m, int step) {
  OWNED(stable_proofs) proofs;
  OWNED(digits_pairs) pairs;
  goes_well(stable_prove(&proofs, m, false, &d));
  goes_well(digits_pairs_make(&pairs, m, &proofs, &d));
  *points = *undecided = 0;
  for (size_t i = 0; i < pairs.n; i += (size_t)step) {
    struct digits_agreement a;
    const struct digits_formula *f = pairs.pair[i].corrected;
    digits_agree(&a, &pairs, i, 1);
    *points += a.points;
    *undecided += a.undecided;
    ck_assert_msg(a.points > 0, "%s has a value at no point", f->id);
    if (a.lost + a.differ == 0) continue;
    text_printf(fails, "%s: %ld without a value, %ld with another, of %ld; %s at ", f->id, a.lost, a.differ, a.points,
                digits_region[a.region].id);
    digits_print_point(fails, f, a.x);
    text_add_char(fails, '\n');
  }
  return pairs.n;
}

TEST(a_value_wherever_the_corrected_form_has_one) {
  LOCAL(text, fails);
  long points, undecided;
  ck_assert_uint_gt(agree_everywhere(&fails, &points, &undecided, &model, every(3)), 60);
  ck_assert_msg(fails.len == 0, "%s", text_str(&fails));
  ck_assert_int_gt(points, 2000 / every(3));
  ck_assert_msg(20 * undecided < points, "%ld of %ld", undecided, points); /* what is zero everywhere, as (43) */
}

/* Forms that say the same near 1, where a proof looks for a value, and not everywhere. */
static const struct {
  const char *form, *says;
} elsewhere[] = {
    {"sqrt(eta*chi)*(sqrt(eta - 1/10000000000)/sqrt(eta - 1/10000000000))", " without a value, 0 with another, of "},
    {"sqrt(eta*chi) + abs(eta - 1/10000000000) - eta + 1/10000000000", ": 0 without a value, "},
};

TEST_EACH(a_form_that_fails_at_extreme_points_is_named, COUNT(elsewhere)) {
  LOCAL(text, file, fails);
  long points, undecided;
  text_printf(&file, "define partial\n  section: appendix_a\n  equation: 51\n  omega := %s\n", elsewhere[_i].form);
  OWNED(model) m = paper_model(&(struct paper_layers){.stable = scratch_put("stable.eq", text_str(&file))});
  ck_assert_uint_gt(agree_everywhere(&fails, &points, &undecided, &m, 1), 1);
  ck_assert_msg(strstr(text_str(&fails), "C_1: ") && strstr(text_str(&fails), elsewhere[_i].says) &&
                    strstr(text_str(&fails), "eta-to-0 at chi=0x"),
                "%s", text_str(&fails));
}

/* --- What the exact field knows of the functions --- */

static int value_in(fmpz_mpoly_q_struct *z, struct exact_field *f, const char *text) {
  return paper_value(z, f, &model, text);
}

/* With t/4 and V t/4 as angles of which others are made, and V known to be positive. */
TABLE(identities, "tests/cases/field_identities.tsv", 3);
enum { I_LEFT, I_RIGHT, I_EQUAL }; /* its columns */

CASE("stable");

TEST_EACH(the_field_knows_the_functions, identities.n) {
  fmpz_mpoly_q_struct known[3];
  FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
  ELEMENTS(x, y);
  static const char *const elements[] = {"V", "t/4", "V*t/4"};
  for (int i = 0; i < 3; i++) {
    exact_init(&known[i]);
    ck_assert_int_eq(value_in(&known[i], f, elements[i]), SS_OK);
  }
  exact_field_positive(f, known, 1, 1);
  exact_field_angles(f, 4);
  ck_assert_int_eq(value_in(&x, f, identities.row[_i][I_LEFT]) | value_in(&y, f, identities.row[_i][I_RIGHT]), SS_OK);
  ck_assert_msg(exact_equal(f, &x, &y) == (*identities.row[_i][I_EQUAL] == 'y'), "%s and %s",
                identities.row[_i][I_LEFT], identities.row[_i][I_RIGHT]);
  for (int i = 0; i < 3; i++) exact_clear(&known[i]);
}
