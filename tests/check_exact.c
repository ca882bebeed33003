/* Proofs by exact algebra: the arithmetic against balls at random points, derivatives by the rules, the model's motions
   as elements against the same motions in balls, that nothing is proved of damaged formulas that balls refute, and
   receipts run by another algebra system. */
#include "element.h"
#include "every.h"
#include "judge/judge.h"
#include "judge/receipt.h"
#include "paper_model.h"
#include "power/mutants.h"
#include "proof/exact_proof.h"
#include "proof/exact_rank.h"
#include "proof/linearized.h"
#include "rng.h"
#include "test.h"

enum { PREC = 400 };

/* --- Elements against balls: values of the generators, by the ring's variables --- */

struct values_of {
  arb_ptr x;
  bool known[EXACT_GENERATORS];
};

static void values_of_open(struct values_of *v) {
  *v = (struct values_of){.x = _arb_vec_init(EXACT_GENERATORS)};
}

static void values_of_clear(struct values_of *v) {
  _arb_vec_clear(v->x, EXACT_GENERATORS);
}

/* g is a generator, perhaps with a sign. */
static void assign(struct values_of *v, const element *g, const arb_t x) {
  int used[EXACT_GENERATORS];
  NUMBERS(fmpz, sign);
  fmpz_mpoly_q_used_vars(used, g, num_exact_ctx());
  if (fmpz_mpoly_length(&g->num, num_exact_ctx()) == 1) {
    fmpz_mpoly_get_term_coeff_fmpz(sign, &g->num, 0, num_exact_ctx());
    for (int i = 0; i < EXACT_GENERATORS; i++) {
      if (!used[i]) continue;
      arb_mul_fmpz(v->x + i, x, sign, PREC);
      v->known[i] = true;
    }
  }
}

static void poly_at(arb_t z, const fmpz_mpoly_struct *p, const struct values_of *v) {
  slong e[EXACT_GENERATORS];
  NUMBERS(arb, term, power);
  NUMBERS(fmpz, c);
  arb_zero(z);
  for (slong i = 0; i < fmpz_mpoly_length(p, num_exact_ctx()); i++) {
    fmpz_mpoly_get_term_coeff_fmpz(c, p, i, num_exact_ctx());
    fmpz_mpoly_get_term_exp_si(e, p, i, num_exact_ctx());
    arb_set_fmpz(term, c);
    for (int k = 0; k < EXACT_GENERATORS; k++) {
      if (e[k] == 0) continue;
      ck_assert_msg(v->known[k], "generator %d has no value", k);
      arb_pow_ui(power, v->x + k, (ulong)e[k], PREC);
      arb_mul(term, term, power, PREC);
    }
    arb_add(z, z, term, PREC);
  }
}

static void element_at(arb_t z, const element *x, const struct values_of *v) {
  NUMBERS(arb, den);
  poly_at(z, &x->num, v);
  poly_at(den, &x->den, v);
  arb_div(z, z, den, PREC);
}

/* --- Laws --- */

enum { ATOMS = 8 };

/* chi, eta, V, t, sin t, cos t, sqrt(chi eta), 2/3 as elements and as balls. */
static void make_atoms(element *atom, arb_ptr ball, struct values_of *v, struct exact_field *f, struct rng *r) {
  static const char *const names[] = {"chi", "eta", "V", "t"};
  for (int i = 0; i < ATOMS; i++) exact_init(&atom[i]);
  for (int i = 0; i < 4; i++) {
    ck_assert_int_eq(exact_symbol(&atom[i], f, names[i]), SS_OK);
    arb_set_si(ball + i, rng_between(r, 1, 60));
    arb_div_si(ball + i, ball + i, rng_between(r, 7, 31), PREC);
    assign(v, &atom[i], ball + i);
  }
  ck_assert_int_eq(exact_sin_cos(&atom[4], &atom[5], f, &atom[3]), SS_OK);
  arb_sin_cos(ball + 4, ball + 5, ball + 3, PREC);
  ck_assert_int_eq(num_exact.mul(&atom[7], &atom[0], &atom[1], 0), SS_OK);
  ck_assert_int_eq(exact_sqrt(&atom[6], f, &atom[7]), SS_OK);
  arb_mul(ball + 6, ball + 0, ball + 1, PREC);
  arb_sqrt(ball + 6, ball + 6, PREC);
  for (int i = 4; i < 7; i++) assign(v, &atom[i], ball + i);
  NUMBERS(fmpq, q);
  fmpq_set_si(q, 2, 3);
  num_exact.set_q(&atom[7], q, 0);
  arb_set_fmpq(ball + 7, q, PREC);
}

static int random_op(element *z, arb_t ball, struct exact_field *f, const element *x, const arb_t bx, const element *y,
                     const arb_t by, slong which) {
  num_binary op = which == 0 ? num_exact.add : which == 1 ? num_exact.sub : which == 2 ? num_exact.mul : num_exact.div;
  (which == 0 ? arb_add : which == 1 ? arb_sub : which == 2 ? arb_mul : arb_div)(ball, bx, by, PREC);
  int s = op(z, x, y, 0);
  return s ? s : exact_reduce(z, f);
}

/* A random element with its value. */
static void random_element(element *z, arb_t ball, struct exact_field *f, const element *atom, arb_srcptr balls,
                           struct rng *r) {
  slong i = rng_between(r, 0, ATOMS - 1);
  num_exact.set(z, &atom[i]);
  arb_set(ball, balls + i);
  ELEMENTS(next);
  NUMBERS(arb, b);
  for (slong k = rng_between(r, 1, 4); k > 0; k--) {
    i = rng_between(r, 0, ATOMS - 1);
    if (random_op(&next, b, f, z, ball, &atom[i], balls + i, rng_between(r, 0, 3)) != SS_OK) continue;
    num_exact.swap(z, &next);
    arb_swap(ball, b);
  }
}

static void calculate(element *z, struct exact_field *f, num_binary op, const element *x, const element *y) {
  ck_assert_int_eq(op(z, x, y, 0), SS_OK);
  ck_assert_int_eq(exact_reduce(z, f), SS_OK);
}

CASE("algebra", .once = {paper_open, paper_close});

/* Commutative, associative, distributive, inverses; and each element has the value that its making has in balls. */
TEST(a_field_and_its_values) {
  struct rng r = {2026};
  for (int trial = 0; trial < 60; trial++) {
    FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
    OWNED(values_of) v;
    element atom[ATOMS], x[3];
    ELEMENTS(a, b);
    BALLS(ATOMS + 4, balls);
    values_of_open(&v);
    make_atoms(atom, balls, &v, f, &r);
    for (int i = 0; i < 3; i++) {
      exact_init(&x[i]);
      random_element(&x[i], balls + ATOMS + i, f, atom, balls, &r);
      element_at(balls + ATOMS + 3, &x[i], &v);
      ck_assert_msg(arb_overlaps(balls + ATOMS + 3, balls + ATOMS + i), "trial %d: the element has another value",
                    trial);
    }
    const num_binary ops[] = {num_exact.add, num_exact.mul};
    for (int k = 0; k < 2; k++) {
      calculate(&a, f, ops[k], &x[0], &x[1]);
      calculate(&b, f, ops[k], &x[1], &x[0]);
      ck_assert(exact_equal(f, &a, &b));
      calculate(&a, f, ops[k], &a, &x[2]);
      calculate(&b, f, ops[k], &x[1], &x[2]);
      calculate(&b, f, ops[k], &x[0], &b);
      ck_assert(exact_equal(f, &a, &b));
    }
    calculate(&a, f, num_exact.add, &x[0], &x[1]);
    calculate(&a, f, num_exact.mul, &a, &x[2]);
    calculate(&b, f, num_exact.mul, &x[0], &x[2]);
    calculate(&x[1], f, num_exact.mul, &x[1], &x[2]);
    calculate(&b, f, num_exact.add, &b, &x[1]);
    ck_assert(exact_equal(f, &a, &b));
    ck_assert(exact_sub(&b, f, &a, &b) && exact_is_zero(&b));
    if (exact_is_zero(&a))
      ck_assert_int_eq(num_exact.div(&b, &x[0], &a, 0), SS_DOMAIN);
    else
      calculate(&b, f, num_exact.div, &a, &a);
    if (!exact_is_zero(&a)) ck_assert(exact_sub(&b, f, &b, &b) && exact_is_zero(&b));
    for (int i = 0; i < 3; i++) exact_clear(&x[i]);
    for (int i = 0; i < ATOMS; i++) exact_clear(&atom[i]);
  }
}

/* --- Formulas --- */

/* The value of a text in a field, as a function of free symbols. */
static int value_in(element *z, struct exact_field *f, const char *text) {
  return paper_value(z, f, &the_paper.model, text);
}

TABLE(equal, "tests/cases/exact_equal.tsv", 4);
enum { LEFT, RIGHT, EQUAL, DERIVED }; /* its columns */

/* Derivatives by the rules; the laws of fields and of sines; what angles with whole multiples of pi and roots of
   quotients are known to be, whatever the signs of these. */
TEST(what_is_equal) {
  for (int i = 0; i < equal.n; i++) {
    char *const *row = equal.row[i];
    FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
    ELEMENTS(x, y);
    ck_assert(value_in(&x, f, row[LEFT]) == SS_OK && value_in(&y, f, row[RIGHT]) == SS_OK);
    if (is_yes(row[DERIVED])) ck_assert_int_eq(exact_derivative(&x, f, &x, "t"), SS_OK);
    ck_assert_msg(exact_equal(f, &x, &y) == is_yes(row[EQUAL]), "%s and %s", row[LEFT], row[RIGHT]);
  }
  FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
  ELEMENTS(x);
  ck_assert(value_in(&x, f, "sqrt(t)*chi") == SS_OK);
  ck_assert_int_eq(exact_derivative(&x, f, &x, "t"), SS_UNABLE);
}

/* A witness of the root of a quotient says twice what that is, and no number below zero. */
TEST(witnesses_of_roots_of_quotients) {
  static const char *const rows[][2] = {{"sqrt((4*chi)/V)", "sqrt((4*chi)/(V)) = %31[^,]"},
                                        {"sqrt((chi - 9)/(V - 9))", "sqrt((chi-9)/(V-9)) = %31[^,]"}};
  for (size_t i = 0; i < COUNT(rows); i++) {
    FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
    LOCAL(text, t);
    ELEMENTS(x);
    char whole[32], root[32];
    ck_assert(value_in(&x, f, rows[i][0]) == SS_OK && exact_independent(f) && exact_witness(&t, f, &x));
    const char *at = strstr(text_str(&t), "sqrt(");
    ck_assert_msg(at && sscanf(text_str(&t), "%31s", whole) == 1 && sscanf(at, rows[i][1], root) == 1, "%s",
                  text_str(&t));
    ck_assert_msg(strcmp(whole, root) == 0 && *root != '-', "%s", text_str(&t));
  }
}

TABLE(differences, "tests/cases/exact_differences.tsv", 3);
enum { DIFFERENCE, INDEPENDENT, AT_ONE }; /* its columns */

/* When a difference is one of functions, and at which rational point; and when that cannot be told. */
TEST_EACH(differences_with_a_rational_point, differences.n) {
  char *const *row = differences.row[_i];
  FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
  LOCAL(text, t);
  ELEMENTS(x);
  NUMBERS(fmpq, one);
  fmpq_one(one);
  ck_assert(value_in(&x, f, row[DIFFERENCE]) == SS_OK && !exact_is_zero(&x));
  ck_assert_msg(exact_independent(f) == is_yes(row[INDEPENDENT]), "%s", row[DIFFERENCE]);
  ck_assert_msg(exact_vanishes_at(f, &x, "V", one) == is_yes(row[AT_ONE]), "%s", row[DIFFERENCE]);
  ck_assert_msg(!is_yes(row[INDEPENDENT]) || (exact_witness(&t, f, &x) && strstr(text_str(&t), " at ")), "%s",
                row[DIFFERENCE]);
}

TABLE(no_value, "tests/cases/exact_no_value.tsv", 2);

/* An answer, at once. */
TEST_EACH(what_has_no_value_or_is_too_large, no_value.n) {
  const char *text = no_value.row[_i][0];
  FREED_FIELD struct exact_field *f = exact_field_new(NULL, 0);
  ELEMENTS(x);
  ck_assert_msg(value_in(&x, f, text) == (strcmp(no_value.row[_i][1], "none") == 0 ? SS_DOMAIN : SS_UNABLE), "%s",
                text);
}

/* --- The model's motions as elements and in balls --- */

static const char *const motion_names[] = {"chi",    "eta",     "V",        "e_1",    "e_2",
                                           "u_r1",   "u_r2",    "t_a",      "t_b",    "t_c",
                                           "t_d",    "z_10",    "z_20",     "z'_10",  "z_1a",
                                           "z_2a",   "z'_1a",   "z'_2a",    "z_1b",   "z_2b",
                                           "z'_1b",  "z'_2b",   "z_1c",     "z_2c",   "z'_1c",
                                           "z'_2c",  "x",       "y",        "u",      "v",
                                           "x_a",    "y_a",     "u_a",      "v_a",    "x_b",
                                           "y_b",    "u_b",     "v_b",      "x_c",    "y_c",
                                           "u_c",    "v_c",     "x_f",      "y_f",    "u_f",
                                           "v_f",    "dt_a",    "dt_b",     "dt_c",   "dt_d",
                                           "z_1(t)", "z_2'(t)", "z_1''(t)", "x_2(t)", "z_2(t_a + t_b + t_c + t_d)",
                                           "t"};
enum { N_MOTION_NAMES = COUNT(motion_names) };

static void bind_ball(arb_t z, struct values *v, const char *name) {
  bool known;
  ck_assert_msg(values_bind(z, &known, v, name) == SS_OK && known, "%s", name);
}

static void assign_symbol(struct values_of *g, struct exact_motion *m, const char *name, const arb_t x) {
  ELEMENTS(e);
  if (exact_symbol(&e, m->field, name) == SS_OK) assign(g, &e, x);
}

/* sin and cos of w u, where w and u are generators or 1. */
static void assign_angle(struct values_of *g, struct exact_motion *m, const element *w, const arb_t w_ball,
                         const char *time, const arb_t u) {
  ELEMENTS(angle, sine, cosine);
  NUMBERS(arb, x, s, c);
  arb_mul(x, u, w_ball, PREC);
  arb_sin_cos(s, c, x, PREC);
  if (exact_symbol(&angle, m->field, time) == SS_OK && (!w || num_exact.mul(&angle, &angle, w, 0) == SS_OK) &&
      exact_sin_cos(&sine, &cosine, m->field, &angle) == SS_OK) {
    assign(g, &sine, s);
    assign(g, &cosine, c);
  }
}

/* Every generator that a motion may use, from the motion in balls: those in use, and as many others as there is room
   for. */
static void assign_all(struct values_of *g, struct exact_motion *m, struct values *v, const arb_t tau) {
  static const char *const free_names[] = {"V",     "e_1",  "e_2",  "u_s1", "u_s2", "t_a",   "t_b",  "t_c",
                                           "t_d",   "z_10", "z_20", "z_2a", "z_1b", "z'_1b", "z_1c", "z_2c",
                                           "z'_2c", "x",    "y",    "y_a",  "x_b",  "u_b",   "x_c",  "y_c",
                                           "v_c",   "x_f",  "y_f",  "dt_a", "dt_b", "dt_c",  "dt_d"};
  static const char *const times[] = {"t_a", "t_b", "t_c", "t_d", "tau"};
  NUMBERS(arb, x);
  BALLS(4, w);
  for (size_t i = 0; i < COUNT(free_names); i++) {
    bind_ball(x, v, free_names[i]);
    assign_symbol(g, m, free_names[i], x);
  }
  for (int i = 0; i < 2; i++) {
    bind_ball(x, v, i ? "z_2(t_a + t_b + t_c + t_d)" : "z_1(t_a + t_b + t_c + t_d)");
    assign_symbol(g, m, i ? "z_2f" : "z_1f", x);
    struct num_vec o = {v->ctx, 1, (char *)(w + i)};
    ck_assert_int_eq(oracle_eval(&o, oracle_find(i ? "omega_2" : "omega_1"), v), SS_OK);
    assign_symbol(g, m, i ? "w_2" : "w_1", w + i);
  }
  assign_symbol(g, m, "tau", tau);
  arb_mul(w + 2, num_vec_at(&v->params, P_CHI), num_vec_at(&v->params, P_ETA), PREC);
  arb_sqrt(w + 2, w + 2, PREC);
  arb_one(w + 3);
  ELEMENTS(omega);
  ck_assert_int_eq(num_exact.mul(&omega, num_vec_at(&m->params, P_CHI), num_vec_at(&m->params, P_ETA), 0), SS_OK);
  bool room = exact_sqrt(&omega, m->field, &omega) == SS_OK;
  if (room) assign(g, &omega, w + 2);
  const element *frequency[4] = {num_vec_at(&m->frequency, 0), num_vec_at(&m->frequency, 1), &omega, NULL};
  for (int k = 0; k < 5; k++) { /* frequencies 1; w_1, w_2; omega in the phases Gamma, H, C and at tau */
    int phase = k < 4 ? k : (int)m->spec.phase;
    if (k < 4)
      bind_ball(x, v, times[k]);
    else
      arb_set(x, tau);
    for (int i = 0; i < 4; i++)
      if ((phase == PHASE_GAMMA && i == 3) || (phase == PHASE_H && i < 2) || (phase == PHASE_C && i == 2 && room))
        assign_angle(g, m, frequency[i], w + i, times[k], x);
  }
}

static void compare_motion(struct values *v, const struct exact_attempt *a, enum phase ph, const arb_t tau) {
  struct point_spec spec = {.kind = POINT_ARC, .phase = ph};
  struct tape reads = {.inputs = (char **)(size_t)motion_names, .n_inputs = N_MOTION_NAMES};
  OWNED(exact_motion) m;
  OWNED(values_of) g;
  NUMBERS(arb, x, y);
  values_of_open(&g);
  exact_motion_init(&m, a, &spec, &reads);
  element e[N_MOTION_NAMES];
  int status[N_MOTION_NAMES], compared = 0;
  for (int i = 0; i < N_MOTION_NAMES; i++) {
    exact_init(&e[i]);
    status[i] = exact_motion_bind(&e[i], m.field, motion_names[i], &m);
  }
  assign_all(&g, &m, v, tau);
  for (int i = 0; i < N_MOTION_NAMES; i++) {
    if (status[i] == SS_OK) {
      element_at(x, &e[i], &g);
      bind_ball(y, v, motion_names[i]);
      ck_assert_msg(arb_overlaps(x, y), "%s, phase %s, anchor %d, tangents %d", motion_names[i], phase_name[ph],
                    a->anchor, (int)a->tangents);
      compared++;
    }
    exact_clear(&e[i]);
  }
  ck_assert_int_ge(compared, N_MOTION_NAMES - 10); /* tangents by L from a chain outgrow the budget towards the end */
}

CASE("motions", .once = {paper_open, paper_close});

TEST(motions_have_the_values_of_motions) {
  const int points = every_case() ? 2 : 1;
  int done = 0;
  for (int ph = 0; ph < N_PHASES; ph++) {
    LOCAL(point, p);
    struct sampler s = sampler_of("exact motions", (struct point_spec){.kind = POINT_ARC, .phase = (enum phase)ph});
    for (int draws = 0, accepted = 0; draws < 12 && accepted < points; draws++) {
      OWNED(values) v;
      sampler_next(&p, &s);
      if (values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(PREC), the_paper.cache) == SS_OK) {
        NUMBERS(arb, tau);
        bind_ball(tau, &v, "t");
        for (int k = 0; k < ph; k++) arb_sub(tau, tau, num_vec_at(&v.arc.t, k), PREC);
        static const struct exact_attempt attempts[] = {{true, 4, TANGENTS_FREE, TIME_INSIDE},
                                                        {true, 4, TANGENTS_LOCATED, TIME_INSIDE},
                                                        {true, 2, TANGENTS_SHIFTED, TIME_INSIDE},
                                                        {true, 3, TANGENTS_LOCATED, TIME_INSIDE},
                                                        {true, 0, TANGENTS_FREE, TIME_INSIDE}};
        for (size_t i = 0; i < COUNT(attempts); i++) compare_motion(&v, &attempts[i], (enum phase)ph, tau);
        accepted++;
        done++;
      }
    }
  }
  ck_assert_int_eq(done, points * N_PHASES);
}

/* At patched points a perturbation is zero exactly where that of balls is, and else its own free symbol. */
TEST(perturbations_at_patched_points) {
  const struct point_spec spec = {.kind = POINT_PATCHED};
  const struct tape nothing = {.n = 0};
  for (int tangents = 0; tangents < N_EXACT_TANGENTS; tangents++) {
    const struct exact_attempt a = {.anchor = 0, .tangents = (enum exact_tangents)tangents};
    OWNED(exact_motion) m;
    OWNED(values) v;
    LOCAL(point, p);
    ELEMENTS(e, own);
    NUMBERS(arb, x);
    struct sampler s = sampler_of("patched", (struct point_spec){.kind = POINT_PATCHED});
    sampler_next(&p, &s);
    exact_motion_init(&m, &a, &spec, &nothing);
    ck_assert_int_eq(values_init(&v, &p, VARIANT_CLOSED, num_ctx_arb(PREC), the_paper.cache), SS_OK);
    for (int i = 0; i < N_MOTION_NAMES; i++) {
      if (name_of_tangent(motion_names[i]) < 0) continue;
      bind_ball(x, &v, motion_names[i]);
      ck_assert_int_eq(exact_motion_bind(&e, m.field, motion_names[i], &m), SS_OK);
      ck_assert_int_eq(exact_symbol(&own, m.field, motion_names[i]), SS_OK);
      ck_assert_msg(exact_is_zero(&e) == (bool)arb_is_zero(x), "%s", motion_names[i]);
      ck_assert_msg(exact_is_zero(&e) || exact_equal(m.field, &e, &own), "%s", motion_names[i]);
    }
  }
}

/* --- What is not proved --- */

static struct exact_proof prove(const struct model *m, const struct claim *c, struct view view,
                                struct audit_result *out) {
  struct diag d;
  struct judge j = paper_judge(out, m, &d, EFFORT_FULL);
  return exact_prove(&j, c, view, NULL);
}

CASE("proofs", .once = {paper_open, paper_close});

/* No control that damages a formula is proved; those of exact algebra differ at a rational point. */
TEST(no_control_is_proved) {
  int tried = 0;
  for (size_t i = 0; i < the_paper.controls.n; i++) {
    struct claim c = *paper_claim(record_get(the_paper.controls.claim[i].record, "claim"));
    if (!claim_tried_at_points(&c)) continue;
    c.control = the_paper.controls.claim[i].record;
    OWNED(audit_result) out;
    struct exact_proof p =
        prove(&the_paper.model, &c,
              (struct view){&the_paper.model, LAYER_CORRECTED, NULL, the_paper.controls.claim[i].id}, &out);
    ck_assert_msg(!p.proved, "%s", the_paper.controls.claim[i].id);
    if (strncmp(the_paper.controls.claim[i].id, "ctl-exact-", 10) == 0)
      ck_assert_msg(p.differs && strstr(p.differs, " at "), "%s", the_paper.controls.claim[i].id);
    tried++;
  }
  ck_assert_int_ge(tried, 20);
}

TABLE(asked, "tests/cases/exact_law.tsv", 3);
enum { SAYS, POINTS, FOLLOWS }; /* its columns */

/* What (2) asks in each phase, by hand: on which motions a sentence follows from it, and on which it does not. */
TEST_EACH(what_follows_from_the_law, asked.n) {
  char *const *row = asked.row[_i];
  OWNED(claims) c = {.n = 0};
  OWNED(audit_result) out;
  const char *path = scratch_print("law.eq", "inequality by-hand\n  section: stability\n  %s\n", row[SAYS]);
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = path, .errata = ""});
  path = scratch_print(
      "law-claim", "claim law\n  kind: identity\n  statement: by-hand\n  points: %s\n  record: proved\n", row[POINTS]);
  goes_well(claims_add_file(&c, path, "claim", &d));
  struct exact_proof p = prove(&m, &c.claim[0], (struct view){&m, LAYER_CORRECTED, NULL, NULL}, &out);
  ck_assert_msg(p.proved == is_yes(row[FOLLOWS]), "%s: %s: %s", row[SAYS], row[POINTS], p.why_not);
}

/* --- Ranks --- */

TABLE(ranks, "tests/cases/exact_ranks.tsv", 3);
enum { EQUATIONS, UNKNOWNS, RANK }; /* its columns */

/* The same systems, by hand: what the exact route must say of them; -1: nothing. */
TEST_EACH(ranks_by_hand, ranks.n) {
  char *const *row = ranks.row[_i];
  OWNED(claims) c = {.n = 0};
  struct diag d;
  OWNED(audit_result) out;
  struct rank_system y;
  const char *path = scratch_print("rank.eq", "equation rank-by-hand\n  section: stability\n%s", row[EQUATIONS]);
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = path, .errata = ""});
  scratch_print("rank.claim",
                "claim rank\n  kind: rank\n  statement: rank-by-hand\n  unknowns: %s\n  rank: 1\n  record: proved\n",
                row[UNKNOWNS]);
  struct judge j = paper_judge(&out, &m, &d, EFFORT_FULL);
  j.claims = &c;
  ck_assert_msg(claims_load(&c, scratch_path(""), ".", "claim", &d), "%s", d.message);
  ck_assert_msg(rank_system_build(&y, &j, &c.claim[0], (struct view){&m, LAYER_CORRECTED, NULL, NULL}), "%s",
                d.message);
  struct exact_rank r = exact_rank_of(&out, &y);
  ck_assert_msg(r.rank == atoi(row[RANK]) && r.note, "row %d: %d, %s", _i, r.rank, r.note);
  sentence_clear(&y.s);
}

/* --- The theorem of linearized stability --- */

TABLE(hypotheses, "tests/cases/exact_hypotheses.tsv", 2);
enum { OVERLAY, MISSING }; /* its columns */

/* One hypothesis is taken away by each overlay, and said to be missing; a criterion in other words is as good. */
TEST_EACH(the_theorem_needs_each_hypothesis, hypotheses.n) {
  char *const *row = hypotheses.row[_i];
  struct diag d;
  OWNED(audit_result) out;
  const char *body = strchr(row[OVERLAY], '\n') + 1;
  bool own = strncmp(row[OVERLAY], "inequality", 10) == 0;
  const char *path =
      scratch_print("own.eq", "%.*s  section: stability\n%s", (int)(body - row[OVERLAY]), row[OVERLAY], body);
  OWNED(model) m = paper_model(&(struct paper_layers){.overlay = path});
  const struct view v = {&m, LAYER_CORRECTED, NULL, NULL};
  struct judge j = paper_judge(&out, &m, &d, EFFORT_FULL);
  struct linearized l = linearized_stability(&j, view_record(&v, own ? "own" : "text-criterion"), v);
  ck_assert_msg(linearized_proves(&l) == !*row[MISSING], "row %d: %s", _i, l.note);
  if (*row[MISSING]) ck_assert_msg(strstr(l.note, row[MISSING]), "row %d: %s", _i, l.note);
}

/* Every so many one-token damages, each tried with the claims under the same equation; the sum of what is returned. */
static int damaged(size_t stride, int (*tried)(const struct model *m, const struct claim *c, size_t mutant)) {
  OWNED(overlay) o;
  OWNED(mutants) all;
  int sum = 0;
  overlay_init(&o, &the_paper.model);
  mutants_init(&all, &the_paper.model, NULL, 0);
  for (size_t i = 0; i < all.n; i += stride) {
    const struct target *t = &all.target[all.mutant[i].target];
    const char *equation = the_paper.model.records[t->record].equation;
    if (the_paper.model.records[t->record].rank == RANK_CONTROL || !*equation) continue;
    overlay_set(&o, t, all.mutant[i].edit.stmt);
    for (size_t k = 0; k < the_paper.claims.n; k++) {
      const char *own = claim_get(&the_paper.claims.claim[k], "equation");
      if (own && strcmp(own, equation) == 0) sum += tried(&o.model, &the_paper.claims.claim[k], i);
    }
    overlay_set(&o, t, NULL);
  }
  return sum;
}

static int ranks_agree(const struct model *m, const struct claim *c, size_t mutant) {
  OWNED(audit_result) out;
  struct finding f;
  struct diag d;
  struct judge j = paper_judge(&out, m, &d, EFFORT_FULL);
  const char *balls = NULL, *exact = NULL;
  if (claim_kind(c) != KIND_RANK || !judge_verdict(&f, &j, c)) return 0;
  for (int e = 0; e < f.n_evidence; e++) {
    if (strcmp(f.evidence[e].route, "balls") == 0) balls = f.evidence[e].result;
    if (strcmp(f.evidence[e].route, "exact") == 0) exact = f.evidence[e].result;
  }
  ck_assert_msg(!exact || strcmp(exact, "differs") != 0 || strcmp(balls, "agrees") != 0, "%s with mutant %zu: %s",
                c->id, mutant, f.evidence[f.n_evidence - 1].note);
  return exact && strcmp(exact, "proved") == 0;
}

/* The exact rank is never another than that of balls at points, whatever damage was done. */
TEST(ranks_of_damaged_equations) {
  ck_assert_int_ge(damaged((size_t)every(7), ranks_agree), 10);
}

static bool refuted_by_balls(const struct model *m, const struct claim *c) {
  OWNED(audit_result) out;
  struct finding f;
  struct diag d;
  struct judge j = paper_judge(&out, m, &d, EFFORT_REFUTE);
  return judge_verdict(&f, &j, c) && f.verdict == VERDICT_REFUTED && f.n_evidence > 0 &&
         strcmp(f.evidence[0].route, "balls") == 0;
}

static int not_proved(const struct model *m, const struct claim *c, size_t mutant) {
  if (!claim_tried_at_points(c) || !refuted_by_balls(m, c)) return 0;
  OWNED(audit_result) out;
  ck_assert_msg(!prove(m, c, claim_view(m, c), &out).proved, "%s with mutant %zu", c->id, mutant);
  return 1;
}

TEST(what_balls_refute_is_not_proved) {
  enum { STRIDE = 83 };
  ck_assert_int_ge(damaged((size_t)(STRIDE * every(3)), not_proved), 20);
}

/* tr J, det J and P do not feel the misprint in (40), J itself does. */
TEST(what_the_trace_does_not_feel) {
  const struct view misprint = {&the_paper.model, LAYER_CORRECTED, "40", NULL};
  const struct view corrected = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  static const char *const kept[] = {"tr(J)", "det(J)", "P(lambda)", "J_a", "J_c*J_b"};
  for (size_t i = 0; i < COUNT(kept); i++)
    ck_assert_msg(exact_unchanged(misprint, corrected, kept[i], "stability"), "%s", kept[i]);
  ck_assert(!exact_unchanged(misprint, corrected, "J", "stability"));
}

/* --- Receipts --- */

static bool has_sympy(void) {
  return shell("\"$Y\" -c 'import sympy' 2>/dev/null") == 0;
}

static void receipt_with(struct text *out, const struct model *m, const char *id) {
  FREED char *file = file_text(formatted("verify/%s", receipt_file(&the_paper.claims, id)));
  goes_well(audit_receipt(out, m, &the_paper.claims, &the_paper.scene, id, file, &d));
}

/* Writes the receipt and adds its path to the line; the first such text before its parts is replaced. */
static void add_receipt(struct text *line, const char *name, const struct model *m, const char *id, const char *was,
                        const char *now) {
  LOCAL(text, t);
  receipt_with(&t, m, id);
  ck_assert_msg(strstr(t.data, was) < strstr(t.data, "# ---"), "%s has no %s", id, was);
  text_printf(line, " '%s'", scratch_put(name, replaced(t.data, was, now)));
}

/* Whether the script ended so, by what receipts.py prints of all. */
static bool ended(const char *all, int status, const char *name) {
  return strstr(all, formatted("%d %s\n", status, scratch_path(name))) != NULL;
}

static bool ends_in(const char *out, const char *last) {
  const char *end = strstr(out, last);
  return end && strcmp(end, last) == 0;
}

TABLE(receipts, "tests/cases/receipts.tsv", 5);
enum { ID, HOLDS, WAS, NOW, RECORDS }; /* its columns */

TEST(receipts_hold_and_damaged_ones_do_not) {
  if (!has_sympy()) return;
  LOCAL(text, line);
  text_printf(&line, "%s tests/oracle/receipts.py", python());
  for (int i = 0; i < receipts.n; i++) {
    char *const *row = receipts.row[i];
    const char *over = *row[RECORDS] ? scratch_put("overlay.eq", row[RECORDS]) : NULL;
    OWNED(model) m = paper_model(&(struct paper_layers){.overlay = over, .controls = true});
    add_receipt(&line, formatted("receipt-%d.py", i), &m, row[ID], "", "");
    if (*row[WAS]) add_receipt(&line, formatted("damaged-%d.py", i), &m, row[ID], row[WAS], row[NOW]);
  }
  FREED char *all = shell_said("%s", text_str(&line));
  for (int i = 0; i < receipts.n; i++) {
    char *const *row = receipts.row[i];
    ck_assert_msg(ended(all, 0, formatted("receipt-%d.py", i)), "%s", row[ID]);
    FREED char *out = file_text(scratch_path(formatted("receipt-%d.py.out", i)));
    ck_assert_msg(ends_in(out, row[HOLDS]), "%s", out);
    bool refused = !*row[WAS] || ended(all, 1, formatted("damaged-%d.py", i)); /* not unreadable, which is 2 */
    ck_assert_msg(refused, "damaged %s", row[ID]);
  }
}

/* The script with each text replaced by the one after it, run: what it says last, and whether it ends well. */
static bool orbit_receipt_ends(const char *id, const char *const changes[4], const char *last) {
  LOCAL(text, t);
  receipt_with(&t, &the_paper.model, id);
  const char *script = text_str(&t);
  for (int i = 0; i < 4 && changes[i]; i += 2) script = replaced(script, changes[i], changes[i + 1]);
  const char *path = scratch_put("orbit.py", script);
  bool well = shell("\"$Y\" '%s' > '%s.out'", path, path) == 0;
  FREED char *out = file_text(scratch_path("orbit.py.out"));
  ck_assert_msg(ends_in(out, last), "%s: %s", id, out);
  return well;
}

/* The right numbers, by paper_1000.tsv in tests/oracle, are not refuted.  u_r2 is left to make long. */
TEST(receipts_of_printed_numbers) {
  static const char *const none[4] = {NULL};
  static const char *const ta[4] = {"424/625", "5323/10000"}, *const ur2[4] = {"3329/2000", "16705/10000"};
  static const char *const start[4] = {"8921/10000", "9782/10000", "-10979/5000", "-21247/10000"};
  static const struct {
    const char *id, *refuted, *not_so, *const *right;
  } rows[] = {{"num-t_a", "num-t_a: refuted\n", "num-t_a: not shown to be wrong\n", ta},
              {"num-u_r2", "num-u_r2: refuted\n", "num-u_r2: not shown to be wrong\n", ur2},
              {"text-periodic", "text-periodic: refuted\n", "text-periodic: not shown to be wrong\n", start}};
  for (size_t i = 0; i < COUNT(rows); i++) {
    if (i == 1 && !every_case()) continue;
    ck_assert(orbit_receipt_ends(rows[i].id, none, rows[i].refuted));
    ck_assert(!orbit_receipt_ends(rows[i].id, rows[i].right, rows[i].not_so));
  }
}

/* Those of the other kinds are told of in docs/house.md. */
static bool has_receipts(enum kind kind) {
  static const enum kind without[] = {KIND_LAW,      KIND_BEHAVIOUR, KIND_CONSTRAINTS, KIND_REACH,
                                      KIND_NOTATION, KIND_SOLUTIONS, KIND_RANGE,       KIND_NUMBER};
  for (int i = 0; i < COUNT(without); i++)
    if (kind == without[i]) return false;
  return true;
}

/* The next claim from the i-th on that is proved and has a receipt; NULL behind the last. */
static const struct claim *next_with_receipt(size_t *i) {
  while (*i < the_paper.claims.n) {
    const struct claim *c = &the_paper.claims.claim[(*i)++];
    if (claim_says(c, "record", "proved") && has_receipts(claim_kind(c))) return c;
  }
  return NULL;
}

/* In a time that a reader will wait, and saying what was checked and what not, and last that it is proved; in make
   check some are run. */
TEST(every_proof_has_a_receipt) {
  if (!has_sympy()) return;
  LOCAL(text, line, not_run);
  const struct claim *c;
  int n = 0, stride = every(4);
  text_printf(&line, "%s tests/oracle/receipts.py", python());
  for (size_t i = 0; (c = next_with_receipt(&i)) != NULL; n++)
    add_receipt(n % stride ? &not_run : &line, formatted("every-%s.py", c->id), &the_paper.model, c->id, "", "");
  ck_assert_int_ge(n, 150);
  FREED char *all = shell_said("%s", text_str(&line));
  n = 0;
  for (size_t i = 0; (c = next_with_receipt(&i)) != NULL; n++) {
    if (n % stride) continue;
    ck_assert_msg(ended(all, 0, formatted("every-%s.py", c->id)), "%s", c->id);
    FREED char *out = file_text(scratch_path(formatted("every-%s.py.out", c->id)));
    const char *last = formatted("%s: proved\n", c->id);
    ck_assert_msg(strstr(out, "\nChecked ") && strstr(out, "\nNot checked here: ") && ends_in(out, last), "%s", out);
  }
}
