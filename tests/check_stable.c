/* The stable layer: every form of verify/stable.eq is proved, none of them when damaged; double precision loses no more
   with them than the conditioning explains, at thousands of extreme points against balls, where the corrected forms
   lose all digits. */
#include "proof/stable_forms.h"

#include "element.h"
#include "every.h"
#include "paper_model.h"
#include "rational.h"
#include "rng.h"
#include "stability/stability.h"
#include "test.h"

/* --- Formulas at extreme points --- */

enum { MOST_ENTRIES = 16, MOST_INPUTS = 16 };

/* A formula of one layer in double precision, and its truth. */
struct extreme_form {
  struct elaboration el, exact;
  struct tape tape,
      truth; /* truth: of the stable layer, each entry followed by its derivatives by the truth's inputs */
  int n;
};

static void read_value(struct matrix *out, struct elaboration *el, const char *value, const char *section) {
  struct diag d = {0};
  ck_assert_msg(elaborate_text(out, el, value, value, section, &d), "%s: %s", value, d.message);
  ck_assert_int_le(out->rows * out->cols, MOST_ENTRIES);
}

/* called: what the value is called in the stable layer. */
static void extreme_form_init(struct extreme_form *f, const struct model *m, enum layer layer, const char *value,
                              const char *called, const char *section) {
  struct matrix v;
  elaboration_init(&f->el, (struct view){m, layer, NULL, NULL}, NULL, 0);
  read_value(&v, &f->el, value, section);
  f->n = v.rows * v.cols;
  goes_well(elaboration_tape(&f->tape, &f->el, v.e, f->n, &d));
  elaboration_init(&f->exact, (struct view){m, LAYER_STABLE, NULL, NULL}, NULL, 0);
  read_value(&v, &f->exact, called, section);
  ck_assert_int_eq(v.rows * v.cols, f->n);
  OWNED(tape) plain;
  goes_well(elaboration_tape(&plain, &f->exact, v.e, f->n, &d));
  ck_assert_int_le(plain.n_inputs, MOST_INPUTS);
  const struct expr *out[MOST_ENTRIES * (1 + MOST_INPUTS)];
  int n = 0;
  for (int i = 0; i < f->n; i++) {
    out[n++] = v.e[i];
    for (slong k = 0; k < plain.n_inputs; k++) out[n++] = expr_diff(&f->exact.pool, v.e[i], plain.inputs[k]);
  }
  goes_well(elaboration_tape(&f->truth, &f->exact, out, n, &d));
  ck_assert_int_eq(f->truth.n_inputs, plain.n_inputs);
  for (slong k = 0; k < plain.n_inputs; k++) ck_assert_str_eq(f->truth.inputs[k], plain.inputs[k]);
}

static void extreme_form_clear(struct extreme_form *f) {
  tape_clear(&f->tape);
  tape_clear(&f->truth);
  elaboration_clear(&f->el);
  elaboration_clear(&f->exact);
}

/* Exact doubles for the inputs of both tapes, by name. */
struct extreme_point {
  struct rng rng;
  double chi, eta, scale, shift; /* shift: of times, relative */
};

/* A random mantissa in [1, 2) times 2^e, e uniform. */
static double decades(struct rng *r, double low, double high) {
  return ldexp(rng_within(r, 1, 2), (int)floor(rng_within(r, low, high)));
}

/* Parameters, region by region: chi near 0 and 1, eta over 600 decades and where chi eta is near 1.  The other
   quantities follow name by name: times from 2^-1000 to 2^53 and next to multiples of half periods, states with
   differences that nearly vanish.  All are exact doubles. */
static void extreme_point_draw(struct extreme_point *p, uint64_t seed) {
  *p = (struct extreme_point){.rng.state = seed * 0x9e3779b97f4a7c15U};
  struct rng *r = &p->rng;
  switch (rng_between(r, 0, 3)) {
  case 0:
    p->chi = rng_within(r, 0x1p-10, 1 - 0x1p-10);
    break;
  case 1:
    p->chi = decades(r, -60, -1);
    break;
  case 2:
    p->chi = decades(r, -990, -1);
    break;
  default:
    p->chi = 1 - decades(r, -53, -2);
  }
  switch (rng_between(r, 0, 4)) {
  case 0:
    p->eta = decades(r, -4, 4);
    break;
  case 1:
    p->eta = decades(r, -60, 60);
    break;
  case 2:
    p->eta = decades(r, -990, 990);
    break;
  default: /* near chi eta = 1, at distances of every size */
    p->eta = (1 + (rng_next(r) % 2 ? 1 : -1) * decades(r, -54, -1)) / p->chi;
  }
  if (!(p->eta < 0x1p996)) p->eta = 0x1p996;
  p->scale = p->chi < 0x1p-60 || rng_between(r, 0, 3) ? 1 : decades(r, -800, 800);
}

/* The frequencies of the phases, roughly. */
static double rate(const struct extreme_point *p, struct rng *r) {
  double omega = sqrt(p->chi) * sqrt(p->eta), s = sqrt(1 - p->chi), root = sqrt(p->chi);
  double high = (hypot(omega + s, root) + hypot(omega - s, root)) / 2;
  switch (rng_between(r, 0, 4)) {
  case 0:
    return high;
  case 1:
    return omega * (s / high);
  case 2:
    return omega;
  case 3:
    return hypot(omega - s, root);
  default:
    return 1;
  }
}

static double draw_time(const struct extreme_point *p, struct rng *r) {
  double t;
  switch (rng_between(r, 0, 3)) {
  case 0:
    return decades(r, -6, 6);
  case 1:
    return decades(r, -1000, 53);
  case 2:
    t = decades(r, -30, 30) / rate(p, r);
    break;
  default:
    t = (double)(1 + rng_next(r) % (1u << rng_between(r, 1, 20))) * acos(0) / rate(p, r);
    if (rng_next(r) % 2) t *= 1 + decades(r, -53, -4);
  }
  return t > 0 && t < 0x1p53 ? t : 1.5;
}

/* One stream for each name, so that the order of the inputs says nothing. */
static struct rng stream(const struct extreme_point *p, const char *name) {
  struct rng r = p->rng;
  for (const char *c = name; *c; c++) r.state = (r.state ^ (unsigned char)*c) * 0x100000001b3U;
  rng_next(&r);
  return r;
}

static double draw_state(const struct extreme_point *p, const char *name) {
  struct rng r = stream(p, name);
  double z = p->scale * (rng_between(&r, 0, 2) ? rng_within(&r, 0.125, 8) : decades(&r, -60, 60));
  return rng_next(&r) % 2 ? z : -z;
}

/* Beside another value, at a distance of any size. */
static double beside(const struct extreme_point *p, const char *name, double other) {
  struct rng r = stream(p, name);
  if (rng_next(&r) % 2 || fabs(other) < 0x1p-950) return draw_state(p, name);
  return other * (1 + (rng_next(&r) % 2 ? 1 : -1) * decades(&r, -52, -2));
}

static double extreme_value(struct extreme_point *p, const char *name) {
  struct rng r = stream(p, name);
  if (strcmp(name, "chi") == 0) return p->chi;
  if (strcmp(name, "eta") == 0) return p->eta;
  if (strcmp(name, "V") == 0) return p->scale * rng_within(&r, 0.5, 2);
  if (name[0] == 't') return draw_time(p, &r) * (1 + p->shift);
  if (strcmp(name, "z_200") == 0) return beside(p, name, draw_state(p, "z_100"));
  if (strcmp(name, "z_1c") == 0) return beside(p, name, p->chi * draw_state(p, "z_2c"));
  if (strcmp(name, "z_1b") == 0) return beside(p, name, p->chi * draw_state(p, "z_2b"));
  if (strncmp(name, "z'", 2) == 0) return beside(p, name, extreme_value(p, "V"));
  return draw_state(p, name);
}

/* Of each entry: the error in units of max(1, condition) 2^-53 of the truth, the condition being the sum of the entry's
   logarithmic derivatives by its inputs, there or at times some units of the last place away; -1 where the truth has no
   normal double, or the truth could not be told; infinity for an error status or a NaN. */
struct extreme_result {
  double loss[MOST_ENTRIES], condition[MOST_ENTRIES], truth[MOST_ENTRIES], value[MOST_ENTRIES];
};

static void bind(struct num_vec *in, const struct tape *t, const struct extreme_point *p) {
  struct extreme_point q = *p;
  for (slong k = 0; k < t->n_inputs; k++)
    in->ctx.type->set_d(num_vec_at(in, k), extreme_value(&q, t->inputs[k]), in->ctx.prec);
}

/* The truth of entry i to 80 bits and its condition, in one precision; false when that does not tell them. */
static bool told(struct extreme_result *r, arb_t ball, const struct extreme_form *f, const struct num_vec *out,
                 const struct num_vec *in, const int *status, int i) {
  slong at = i * (1 + f->truth.n_inputs);
  NUMBERS(arb, sum, part);
  bool ok = status[at] == SS_OK;
  if (ok) arb_set(ball, num_vec_at(out, at));
  if (ok && arb_is_zero(ball)) return true;
  ok = ok && arb_rel_accuracy_bits(ball) >= 80;
  for (slong k = 0; ok && k < f->truth.n_inputs; k++) {
    ok = status[at + 1 + k] == SS_OK;
    if (!ok) break;
    arb_mul(part, num_vec_at(out, at + 1 + k), num_vec_at(in, k), 64);
    arb_div(part, part, ball, 64);
    arb_abs(part, part);
    arb_add(sum, sum, part, 64);
  }
  if (ok) { /* to a few per cent, or known to be small */
    NUMBERS(mag, most);
    mag_set_d(most, 0.01 * fmax(1, num_arb.get_d(sum)));
    ok = mag_cmp(arb_radref(sum), most) <= 0;
  }
  r->condition[i] = num_arb.get_d(sum);
  return ok;
}

static bool find_truth(struct extreme_result *r, arb_ptr ball, const struct extreme_form *f,
                       const struct extreme_point *p, slong prec) {
  int status[MOST_ENTRIES * (1 + MOST_INPUTS)];
  OWNED(num_vec) in = vec_new(f->truth.n_inputs, num_ctx_arb(prec));
  OWNED(num_vec) out = vec_new(f->truth.n_outputs, num_ctx_arb(prec));
  bind(&in, &f->truth, p);
  tape_eval(&out, status, &f->truth, &in);
  bool all = true;
  for (int i = 0; i < f->n; i++) {
    bool ok = told(r, ball + i, f, &out, &in, status, i);
    if (!ok) arb_indeterminate(ball + i);
    all = all && ok;
  }
  return all;
}

/* The error of a double, in units of what the condition explains; half a dozen of the least doubles are free. */
static double loss_of(double value, int status, const arb_t ball, double condition) {
  if (!arb_is_finite(ball)) return -1;
  NUMBERS(arb, error, unit);
  double size = fabs(num_arb.get_d(ball));
  if (arb_is_zero(ball)) return status == SS_OK && value == 0 ? 0 : -1;
  if (!(size >= 0x1p-1000 && size <= 0x1p1020)) return -1;
  if (condition > 0x1p46) return -1; /* no digit is promised */
  if (status != SS_OK) return INFINITY;
  arb_set_d(error, value);
  arb_sub(error, error, ball, 128);
  arb_abs(error, error);
  arb_set_d(unit, fmax(1, condition));
  arb_mul(unit, unit, ball, 128);
  arb_abs(unit, unit);
  arb_mul_2exp_si(unit, unit, -53);
  arb_div(error, error, unit, 64);
  return arf_get_d(arb_midref(error), ARF_RND_UP);
}

/* Where the slope of an entry is zero, its change within a few units of the last place is not. */
static double condition_nearby(const struct extreme_form *f, const struct extreme_point *p, int i) {
  struct extreme_result r;
  double most = 0;
  BALLS(f->n, ball);
  for (int side = -1; side <= 1; side += 2) {
    struct extreme_point q = *p;
    q.shift = side * 0x1p-50;
    find_truth(&r, ball, f, &q, 2048);
    if (arb_is_finite(ball + i)) most = fmax(most, r.condition[i]);
  }
  return most;
}

static void extreme_measure(struct extreme_result *r, struct extreme_form *f, const struct extreme_point *p) {
  enum { PROMISED = 8, HOPELESS = 1000 };
  BALLS(f->n, ball);
  OWNED(num_vec) in = vec_new(f->tape.n_inputs, num_ctx_double()), out = vec_new(f->n, num_ctx_double());
  int status[MOST_ENTRIES];
  for (slong prec = 192; prec <= 20000 && !find_truth(r, ball, f, p, prec); prec *= 3) continue;
  bind(&in, &f->tape, p);
  tape_eval(&out, status, &f->tape, &in);
  for (int i = 0; i < f->n; i++) {
    r->value[i] = num_double.get_d(num_vec_at(&out, i));
    r->truth[i] = num_arb.get_d(ball + i);
    r->loss[i] = loss_of(r->value[i], status[i], ball + i, r->condition[i]);
    if (r->loss[i] <= PROMISED || r->loss[i] > HOPELESS) continue;
    r->condition[i] = fmax(r->condition[i], condition_nearby(f, p, i));
    r->loss[i] = loss_of(r->value[i], status[i], ball + i, r->condition[i]);
  }
}

/* The inputs at that point as NAME=hexadecimal, ... */
static void extreme_print(struct text *out, const struct extreme_form *f, const struct extreme_point *p) {
  struct extreme_point q = *p;
  for (slong k = 0; k < f->truth.n_inputs; k++)
    text_printf(out, "%s%s=%a", k ? ", " : "", f->truth.inputs[k], extreme_value(&q, f->truth.inputs[k]));
}

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
    OWNED(extreme_form) f;
    extreme_form_init(&f, &model, LAYER_STABLE, stable[k], stable[k], "validation");
    OWNED(elaboration) el;
    OWNED(tape) t;
    struct matrix m;
    elaboration_init(&el, (struct view){&model, LAYER_CORRECTED, NULL, NULL}, NULL, 0);
    goes_well(elaborate_tape(&t, &m, &el, "test", value[k], "validation", &d));
    OWNED(num_vec) in = vec_new(f.tape.n_inputs, num_ctx_double()), out = vec_new(f.n, num_ctx_double());
    OWNED(num_vec) exact_in = vec_new(t.n_inputs, num_ctx_arb(2000)), exact = vec_new(f.n, num_ctx_arb(2000));
    for (int at = 0; at < 2; at++) {
      const struct tape *of = at ? &t : &f.tape;
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
    ck_assert_int_eq(tape_eval(&exact, NULL, &t, &exact_in), SS_OK);
    for (slong i = 0; i < f.n; i++) {
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

/* at_fault: the corrected form loses digits beyond its condition, thousands of units of it at the least. */
TABLE(formulas, "tests/cases/stable_formulas.tsv", 5);
enum { STABLE, CORRECTED, SECTION, POINTS, AT_FAULT }; /* its columns */

TEST_EACH(no_more_is_lost_than_the_condition_explains, formulas.n) {
  char *const *row = formulas.row[_i];
  enum { PROMISED = 8 };
  const int points = atoi(row[POINTS]);
  const bool at_fault = is_yes(row[AT_FAULT]);
  OWNED(extreme_form) stable, corrected;
  long measured = 0;
  double worst = 0;
  const char *other = *row[CORRECTED] ? row[CORRECTED] : row[STABLE];
  extreme_form_init(&stable, &model, LAYER_STABLE, row[STABLE], row[STABLE], row[SECTION]);
  extreme_form_init(&corrected, &model, LAYER_CORRECTED, other, row[STABLE], row[SECTION]);
  for (int seed = 1; seed <= points; seed += every(7)) {
    struct extreme_point p;
    struct extreme_result r;
    extreme_point_draw(&p, (uint64_t)seed);
    extreme_measure(&r, &stable, &p);
    for (int k = 0; k < stable.n; k++) {
      if (r.loss[k] <= PROMISED) {
        measured += r.loss[k] >= 0;
        continue;
      }
      struct text where = {0};
      extreme_print(&where, &stable, &p);
      ck_abort_msg("%s, entry %d at %s: %a, not %a, loses %g times its condition %g", row[STABLE], k, text_str(&where),
                   r.value[k], r.truth[k], r.loss[k], r.condition[k]);
    }
  }
  for (int seed = 1; seed <= 600 && worst <= 1e6; seed += at_fault ? 1 : every(7)) {
    struct extreme_point p;
    struct extreme_result r;
    extreme_point_draw(&p, (uint64_t)seed);
    extreme_measure(&r, &corrected, &p);
    for (int k = 0; k < corrected.n; k++) worst = fmax(worst, r.loss[k]);
  }
  ck_assert_int_gt(measured, stable.n * points / every(7) / 2);
  ck_assert_msg((worst > 1000) == at_fault, "%s as corrected loses %g", other, worst);
}

/* chi_b = z'_1b/V is too large for a double, gammatilde_1 = (chi V - z'_1b)/(V - z'_1b) is 1. */
TEST(a_ratio_that_overflows_is_not_formed) {
  for (int layer = LAYER_CORRECTED; layer < N_LAYERS; layer++) {
    OWNED(extreme_form) f;
    extreme_form_init(&f, &model, (enum layer)layer, "gammatilde_1", "gammatilde_1", "stability");
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
  exact_field_positive(f, known, 1);
  exact_field_angles(f, known + 1, 2, 2);
  ck_assert_int_eq(value_in(&x, f, identities.row[_i][I_LEFT]) | value_in(&y, f, identities.row[_i][I_RIGHT]), SS_OK);
  ck_assert_msg(exact_equal(f, &x, &y) == (*identities.row[_i][I_EQUAL] == 'y'), "%s and %s",
                identities.row[_i][I_LEFT], identities.row[_i][I_RIGHT]);
  for (int i = 0; i < 3; i++) exact_clear(&known[i]);
}
