/* Tapes: formulas go in as text, through files as a user writes them, and come out as numbers.  Random formulas
   are held against a walk of the test's own along their trees, by the operations of each number type (equal to
   the bit), which laws_num.c holds against other programs. */
#include <signal.h>
#include <stdint.h>

#include "effort.h"
#include "model/model.h"
#include "operation.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

/* ---- from text to tape */

struct work {
  struct model m;
  struct elaboration el;
  struct tape t;
};

static bool try_work(struct work *w, const char *text, int n, const char *const *names, struct diag *d) {
  diag_init(d);
  model_init(&w->m);
  bool ok = model_add_file(&w->m, scratch_put("formulas.eq", text), RANK_PAPER, d);
  elaboration_init(&w->el, (struct view){&w->m, LAYER_PRINTED, NULL, NULL}, NULL, 0);
  const struct expr **out = ss_malloc((size_t)n * sizeof *out);
  for (int i = 0; ok && i < n; i++) {
    struct matrix v;
    ok = elaborate_text(&v, &w->el, names[i], names[i], "", d);
    if (ok) out[i] = v.e[0];
  }
  w->t = (struct tape){.n = 0};
  ok = ok && elaboration_tape(&w->t, &w->el, out, n, d);
  free(out);
  return ok;
}

static void work_open(struct work *w, const char *text, int n, const char *const *names) {
  goes_well(try_work(w, text, n, names, &d));
}

static void work_clear(struct work *w) {
  tape_clear(&w->t);
  elaboration_clear(&w->el);
  model_clear(&w->m);
}

/* The one output y of "symbol x, symbol y, ..., define: <body>". */
static void work_y(struct work *w, const char *symbols, const char *body) {
  static const char *const names[] = {"y"};
  LOCAL(text, t);
  for (const char *s = symbols; *s; s++) text_printf(&t, "symbol %c\n", *s);
  text_printf(&t, "define d\n%s\n", body);
  work_open(w, t.data, 1, names);
}

/* Inputs and outputs of a tape in one context. */
struct run {
  struct num_vec in, out;
  int *status, all;
};

static struct run run_of(const struct tape *t, struct num_ctx ctx) {
  return (struct run){.in = vec_new(t->n_inputs, ctx),
                      .out = vec_new(t->n_outputs, ctx),
                      .status = ss_malloc((size_t)t->n_outputs * sizeof(int))};
}

static void run_clear(struct run *r) {
  vecs_clear(&r->in, &r->out);
  free(r->status);
}

static void give_d(struct run *r, const struct tape *t, const char *name, double x) {
  for (slong i = 0; i < t->n_inputs; i++)
    if (strcmp(t->inputs[i], name) == 0) r->in.ctx.type->set_d(num_vec_at(&r->in, i), x, r->in.ctx.prec);
}

static void give_q(struct run *r, const struct tape *t, const char *name, long p, ulong q) {
  NUMBERS(fmpq, x);
  fmpq_set_si(x, p, q);
  for (slong i = 0; i < t->n_inputs; i++)
    if (strcmp(t->inputs[i], name) == 0) r->in.ctx.type->set_q(num_vec_at(&r->in, i), x, r->in.ctx.prec);
}

static void run_go(struct run *r, const struct tape *t) {
  r->all = tape_eval(&r->out, r->status, t, &r->in);
}

static void get(arb_t x, const struct run *r, slong i) {
  r->out.ctx.type->get_arb(x, num_vec_at(&r->out, i));
}
static double get_d(const struct run *r, slong i) {
  return r->out.ctx.type->get_d(num_vec_at(&r->out, i));
}

/* ---- what is on the tape */

CASE("tape", .each = {scratch_open, scratch_close});

TABLE(dumps, "tests/cases/tape_dumps.tsv", 3);
enum { FILE_, OUTPUTS, TAPE }; /* its columns */

TEST_EACH(formulas_are_these_tapes, dumps.n) {
  const char *names[8];
  int n = 0;
  OWNED(work) w;
  for (char *p = strtok(dumps.row[_i][OUTPUTS], " "); p; p = strtok(NULL, " ")) names[n++] = p;
  work_open(&w, dumps.row[_i][FILE_], n, names);
  LOCAL(text, out);
  tape_dump(&out, &w.t);
  ck_assert_str_eq(text_str(&out), dumps.row[_i][TAPE]);
}

TEST(inputs_in_order_of_first_use) {
  OWNED(work) w;
  static const char *const names[] = {"p", "q"};
  work_open(&w,
            "symbol a\nsymbol b\nsymbol c\nrelation r\n  trajectory z(t)\ndefine d\n"
            "  p := b*a + z''(a + b)\n  q := a - c - z''(a + b) + z(0) - b\n",
            2, names);
  ck_assert_int_eq(w.t.n_inputs, 5);
  static const char *const expected[] = {"b", "a", "z''(a + b)", "c", "z(0)"};
  for (int i = 0; i < 5; i++) ck_assert_str_eq(w.t.inputs[i], expected[i]);
  OWNED(run) r = run_of(&w.t, num_ctx_double());
  for (int i = 0; i < 5; i++) r.in.ctx.type->set_d(num_vec_at(&r.in, i), i + 2, 53);
  run_go(&r, &w.t);
  ck_assert(r.all == SS_OK && get_d(&r, 0) == 2 * 3 + 4 && get_d(&r, 1) == 3 - 5 - 4 + 6 - 2);
}

TEST(constants_are_exact) {
  static const char *const names[] = {"tenth", "tiny", "third", "one", "huge"};
  OWNED(work) w;
  NUMBERS(arb, x, y);
  NUMBERS(fmpq, tenth, tiny);
  fmpq_set_si(tenth, 1, 10);
  fmpz_ui_pow_ui(fmpq_denref(tiny), 10, 400);
  fmpz_one(fmpq_numref(tiny));
  work_open(&w, "define d\n  tenth := 0.1\n  tiny := 1e-400\n  third := 1/3\n  one := 0.1*10\n  huge := 1e400\n", 5,
            names);
  ck_assert(fmpq_equal(&w.t.consts[w.t.code[w.t.outputs[0]].k], tenth));
  ck_assert(fmpq_equal(&w.t.consts[w.t.code[w.t.outputs[1]].k], tiny));

  OWNED(run) r = run_of(&w.t, num_ctx_arb(200)), many = run_of(&w.t, num_ctx_mpfr(100));
  run_go(&r, &w.t);
  ck_assert_int_eq(r.all, SS_OK);
  get(x, &r, 0);
  arb_set_d(y, 0.1); /* the double is not the number: it lies 2^-54/10 of it away */
  ck_assert(arb_contains_fmpq(x, tenth) && !arb_is_exact(x) && !arb_overlaps(x, y));
  get(x, &r, 1);
  ck_assert(arb_contains_fmpq(x, tiny) && arb_is_positive(x) && arb_rel_accuracy_bits(x) > 190);
  get(x, &r, 3);
  ck_assert(arb_contains_si(x, 1) && arb_rel_accuracy_bits(x) > 190);

  run_go(&many, &w.t);
  ck_assert_int_eq(many.all, SS_OK);
  MPFR_NUMBERS(100, t);
  mpfr_set_str(t, "1e-400", 10, MPFR_RNDN);
  ck_assert(mpfr_equal_p(num_vec_at(&many.out, 1), t));
  mpfr_set_str(t, "0.1", 10, MPFR_RNDN);
  ck_assert(mpfr_equal_p(num_vec_at(&many.out, 0), t));
  mpfr_set_str(t, "1e400", 10, MPFR_RNDN);
  ck_assert(mpfr_equal_p(num_vec_at(&many.out, 4), t));

  OWNED(run) plain = run_of(&w.t, num_ctx_double());
  run_go(&plain, &w.t);
  ck_assert(get_d(&plain, 0) == 0.1 && get_d(&plain, 2) == 1.0 / 3);
  ck_assert_int_eq(plain.status[1], SS_UNABLE); /* it would vanish, and 1/1e-400 be undefined */
  ck_assert(plain.status[4] == SS_UNABLE && plain.all == SS_UNABLE);
}

TEST(numbers_too_large) {
  static const char *const number[] = {"1e200000", "1e-99999999999999999999"};
  static const char *const names[] = {"y"};
  for (int i = 0; i < 2; i++) {
    OWNED(work) w;
    fails_with(try_work(&w, formatted("define d\n  y := 1 + %s\n", number[i]), 1, names, &d),
               "formulas.eq:2:12: error: a number too large to hold; write one of fewer digits");
    /* a tree that nobody has elaborated */
    OWNED(expr_pool) pool = {.n = 0};
    OWNED(tape) t;
    const struct expr *e = expr_num(&pool, number[i]);
    fails_with(tape_build(&t, &e, 1, NULL, 0, &d), formatted("%s is too large to hold", number[i]));
  }
}

/* ---- flags */

TEST(flags_of_each_output) {
  static const char *const names[] = {"o1", "o2", "o3", "o4", "o5", "o6", "o7"};
  static const char *const text = "symbol x\nsymbol y\nsymbol s\ndefine d\n"
                                  "  o1 := 1/x\n"                  /* x = 0 */
                                  "  o2 := y + 1\n"                /* fine */
                                  "  o3 := sqrt(-y)\n"             /* y = 4 */
                                  "  o4 := 1/s\n"                  /* s straddles 0 */
                                  "  o5 := 1/x + 1/s\n"            /* both */
                                  "  o6 := (cot(x) + y)*0\n"       /* 0 times what does not exist */
                                  "  o7 := s*s + x^2 + x*(s/y)\n"; /* fine */
  static const int in_arb[] = {SS_DOMAIN, SS_OK, SS_DOMAIN, SS_UNABLE, SS_DOMAIN | SS_UNABLE, SS_DOMAIN, SS_OK};
  static const int in_others[] = {SS_DOMAIN, SS_OK, SS_DOMAIN, SS_OK, SS_DOMAIN, SS_DOMAIN, SS_OK};
  OWNED(work) w;
  work_open(&w, text, 7, names);
  const struct num_ctx ctx[] = {num_ctx_double(), num_ctx_mpfr(80), num_ctx_arb(80)};
  for (int c = 0; c < 3; c++) {
    OWNED(run) r = run_of(&w.t, ctx[c]);
    give_d(&r, &w.t, "y", 4);
    give_d(&r, &w.t, "s", 0.5);
    for (slong i = 0; c == 2 && i < w.t.n_inputs; i++)
      if (strcmp(w.t.inputs[i], "s") == 0) mag_one(arb_radref((arb_ptr)num_vec_at(&r.in, i)));
    run_go(&r, &w.t);
    const int *expected = c == 2 ? in_arb : in_others;
    for (int i = 0; i < 7; i++) {
      ck_assert_msg(r.status[i] == expected[i], "%s in %s: %d, expected %d", names[i], ctx[c].type->name, r.status[i],
                    expected[i]);
      ck_assert_int_eq(isnan(get_d(&r, i)) != 0, expected[i] != SS_OK);
    }
    ck_assert_int_eq(r.all, c == 2 ? SS_DOMAIN | SS_UNABLE : SS_DOMAIN);
    ck_assert(get_d(&r, 1) == 5);
    ck_assert_int_eq(tape_eval(&r.out, NULL, &w.t, &r.in), r.all);
  }
}

/* ---- values rounded once */

static struct rng rng;

/* Of y at x = a, z = b in a context. */
static int value_at(double *y, const char *body, double a, double b, struct num_ctx ctx) {
  OWNED(work) w;
  work_y(&w, "xz", body);
  OWNED(run) r = run_of(&w.t, ctx);
  give_d(&r, &w.t, "x", a);
  give_d(&r, &w.t, "z", b);
  run_go(&r, &w.t);
  *y = get_d(&r, 0);
  return r.all;
}

TABLE(values, "tests/cases/tape_values.tsv", 6);
enum { BODY, TYPE, X, Z, STATUS, VALUE }; /* its columns */

TEST_EACH(a_formula_at_a_point, values.n) {
  char *const *row = values.row[_i];
  const struct num_ctx ctx[] = {num_ctx_double(), num_ctx_mpfr(80), num_ctx_arb(80)};
  static const char *const status[] = {"ok", "domain", "unable"};
  int type = 0;
  double y, want = strtod(row[VALUE], NULL);
  while (strcmp(row[TYPE], ctx[type].type->name) != 0) ck_assert_int_lt(++type, 3);
  int s = value_at(&y, formatted("  %s", row[BODY]), strtod(row[X], NULL), strtod(row[Z], NULL), ctx[type]);
  ck_assert_str_eq(status[s], row[STATUS]);
  ck_assert_msg(isnan(want) ? isnan(y) : y == want, "%s: %a", row[BODY], y);
}

/* Sines of products that no double holds, against MPFR at 300 bits, rounded to nearest there. */
TEST(rounded_to_nearest_or_next_to_it) {
  rng.state = 20;
  MPFR_NUMBERS(300, s);
  for (int i = 0; i < 200; i++) {
    double a = 1 + (double)(rng_next(&rng) >> 12) * 0x1p-40, b = 1 + (double)(rng_next(&rng) >> 12) * 0x1p-20, y;
    ck_assert_int_eq(value_at(&y, "  y := rounded(sin(x*z))", a, b, num_ctx_double()), SS_OK);
    mpfr_set_d(s, a, MPFR_RNDN);
    mpfr_mul_d(s, s, b, MPFR_RNDN);
    mpfr_sin(s, s, MPFR_RNDN);
    double best = mpfr_get_d(s, MPFR_RNDN);
    ck_assert_msg(y == best || y == nextafter(best, 2) || y == nextafter(best, -2), "%a, not %a", y, best);
    mpfr_sub_d(s, s, y, MPFR_RNDN);
    ck_assert(fabs(mpfr_get_d(s, MPFR_RNDN)) <= 0.51 * ldexp(1, ilogb(best) - 52));
  }
}

/* ---- roots */

/* The eigenfrequencies: det(K - I w^2) = 0 is a quadratic in w^2 with the roots (1 + p -+ s)/2, p = chi eta and
   s = sqrt((1 + p)^2 - 4 p (1 - chi)), whose product is p (1 - chi). */
TEST_EACH(roots_of_the_characteristic_equation, 3) {
  static const char *const names[] = {"off_1", "off_2"};
  static const double near[] = {1e-14, 1e-33, 1e-30};
  const struct num_ctx ctx[] = {num_ctx_double(), num_ctx_mpfr(120), num_ctx_arb(120)};
  NUMBERS(arb, x);
  OWNED(work) w;
  work_open(&w,
            "symbol chi\nsymbol eta\ndefine d\n"
            "  K := [1, -chi; -chi*eta, chi*eta]\n  I := [1, 0; 0, 1]\n"
            "  root omega_1: det(K - I*omega_1^2), smallest positive\n"
            "  root omega_2: det(K - I*omega_2^2), largest positive\n"
            "  p := chi*eta\n  s := sqrt((1 + p)^2 - 4*p*(1 - chi))\n"
            "  off_1 := omega_1/sqrt(2*p*(1 - chi)/(1 + p + s)) - 1\n  off_2 := omega_2/sqrt((1 + p + s)/2) - 1\n",
            2, names);
  for (long chi = 1; chi < 10; chi += 2)
    for (long eta = 1; eta <= 9; eta += 4) {
      OWNED(run) r = run_of(&w.t, ctx[_i]);
      give_q(&r, &w.t, "chi", chi, 10);
      give_q(&r, &w.t, "eta", eta, 1);
      run_go(&r, &w.t);
      ck_assert_int_eq(r.all, SS_OK);
      for (int i = 0; i < 2; i++) {
        get(x, &r, i);
        double off = fabs(get_d(&r, i)) + mag_get_d(arb_radref(x));
        ck_assert_msg(off < near[_i] && (_i < 2 || arb_contains_zero(x)), "omega_%d at chi = 0.%ld, eta = %ld: %g",
                      i + 1, chi, eta, off);
      }
    }
}

TEST(roots_that_do_not_exist) {
  static const char *const names[] = {"r", "s", "x1"};
  OWNED(work) w;
  work_open(
      &w,
      "symbol x\ndefine d\n  root r: r^2 + x, smallest positive\n  root s: s^2 - (1/(x + 4))*s - 1, largest positive\n"
      "  x1 := x + r - r\n",
      3, names);
  OWNED(run) r = run_of(&w.t, num_ctx_arb(80));
  give_d(&r, &w.t, "x", 4);
  run_go(&r, &w.t);
  ck_assert(r.status[0] == SS_DOMAIN && r.status[1] == SS_OK && r.status[2] == SS_DOMAIN);
  ck_assert(fabs(get_d(&r, 1) - (0.125 + sqrt(0.015625 + 4)) / 2) < 1e-15);
  give_d(&r, &w.t, "x", -4);
  run_go(&r, &w.t);
  ck_assert(r.status[0] == SS_OK && r.status[1] == SS_DOMAIN && r.status[2] == SS_OK);
  ck_assert(get_d(&r, 0) == 2 && get_d(&r, 2) == -4);
}

/* ---- random formulas */

static const char *const input[] = {"x", "y"};
static double value[2];

/* The distinct subformulas of formulas, each behind its operands. */
struct subformulas {
  const struct expr *e[500];
  int n;
};

static int place(const struct subformulas *s, const struct expr *e) {
  for (int i = 0; i < s->n; i++)
    if (s->e[i] == e) return i;
  return -1;
}

static void list(struct subformulas *s, const struct expr *e) {
  if (place(s, e) >= 0) return;
  for (int i = 0; i < e->n_args; i++) list(s, e->args[i]);
  ck_assert_int_lt(s->n, COUNT(s->e));
  s->e[s->n++] = e;
}

/* One node of a formula by the number type itself, whose values are held against others in laws_num.c. */
static int node_value(void *z, const struct expr *e, const void *a, const void *b, struct num_ctx ctx) {
  const struct num_type *f = ctx.type;
  const num_unary unary[EXPR_PAREN] = {[EXPR_NEG] = f->neg, [EXPR_SIN] = f->sin,   [EXPR_COS] = f->cos,
                                       [EXPR_COT] = f->cot, [EXPR_SQRT] = f->sqrt, [EXPR_EXP] = f->exp,
                                       [EXPR_ABS] = f->abs, [EXPR_SINC] = f->sinc, [EXPR_STUMPFF] = f->stumpff};
  const num_binary binary[EXPR_PAREN] = {
      [EXPR_ADD] = f->add, [EXPR_SUB] = f->sub, [EXPR_MUL] = f->mul, [EXPR_DIV] = f->div, [EXPR_HYPOT] = f->hypot};
  if (e->kind == EXPR_SYM) return f->set_d(z, value[*e->name - 'x'], ctx.prec);
  if (e->kind == EXPR_POW) return f->pow_si(z, a, e->exponent, ctx.prec);
  if (e->n_args > 0) return e->n_args == 1 ? unary[e->kind](z, a, ctx.prec) : binary[e->kind](z, a, b, ctx.prec);
  RATIONALS(q, 1, rationals(&e->name, 1));
  return f->set_q(z, q, ctx.prec);
}

/* Every subformula's value and its flags: those of its operands, else its own. */
static void walk(struct num_vec *v, int *flag, const struct subformulas *s) {
  for (int i = 0; i < s->n; i++) {
    const void *operand[2] = {NULL, NULL};
    flag[i] = SS_OK;
    for (int k = 0; k < s->e[i]->n_args; k++) {
      int at = place(s, s->e[i]->args[k]);
      operand[k] = num_vec_at(v, at);
      flag[i] |= flag[at];
    }
    if (flag[i] == SS_OK) flag[i] = node_value(num_vec_at(v, i), s->e[i], operand[0], operand[1], v->ctx);
  }
}

/* Evaluated alone, an output has the bits that it has among others. */
static void check_alone(const struct work *w, const char *name, const struct run *together, slong i) {
  struct matrix m;
  OWNED(elaboration) el;
  OWNED(tape) t;
  elaboration_init(&el, w->el.view, NULL, 0);
  goes_well(elaborate_text(&m, &el, name, name, "", &d));
  goes_well(elaboration_tape(&t, &el, m.e, 1, &d));
  OWNED(run) r = run_of(&t, together->out.ctx);
  for (int k = 0; k < 2; k++) give_d(&r, &t, input[k], value[k]);
  run_go(&r, &t);
  NUMBERS(arb, x, y);
  get(x, &r, 0);
  get(y, together, i);
  ck_assert(r.status[0] == together->status[i] && r.all == r.status[0]);
  ck_assert(r.all != SS_OK || arb_equal(x, y));
}

enum { ARB = 2, N_TYPES, PREC = 100, N_OUT = 4 };

struct counts {
  int ok, domain, unable;
};

/* Two formulas, and both again with the first in the place of x. */
static void check_formula(struct counts *counts, uint64_t seed) {
  static const char *const names[N_OUT] = {"o0", "o1", "o2", "o3"};
  const struct expr *e[N_OUT];
  struct subformulas s = {.n = 0};
  OWNED(expr_pool) pool = {.n = 0};
  LOCAL(text, file);
  rng.state = seed;
  for (int k = 0; k < 2; k++) value[k] = (double)rng_between(&rng, -32, 32) / 8;
  text_add(&file, "symbol x\nsymbol y\ndefine d\n");
  for (int i = 0; i < N_OUT; i++) {
    e[i] = i < 2 ? random_scalar(&pool, &rng, 4, false) : expr_subst(&pool, e[i - 2], "x", e[0]);
    list(&s, e[i]);
    text_printf(&file, "  %s := ", names[i]);
    expr_print(&file, e[i]);
    text_add(&file, "\n");
  }
  OWNED(work) w;
  work_open(&w, file.data, N_OUT, names);
  ck_assert_msg(w.t.n == s.n, "seed %lu: %ld instructions for %d subformulas", (ulong)seed, (long)w.t.n, s.n);

  const struct num_ctx ctx[] = {num_ctx_double(), num_ctx_mpfr(PREC), num_ctx_arb(PREC)};
  NUMBERS(arb, x, want);
  for (int c = 0; c < N_TYPES; c++) {
    OWNED(num_vec) v = vec_new(s.n, ctx[c]);
    FREED int *flag = ss_malloc((size_t)s.n * sizeof *flag);
    OWNED(run) r = run_of(&w.t, ctx[c]);
    for (int k = 0; k < 2; k++) give_d(&r, &w.t, input[k], value[k]);
    run_go(&r, &w.t);
    walk(&v, flag, &s);
    for (int i = 0; i < N_OUT; i++) {
      int at = place(&s, e[i]);
      get(x, &r, i);
      ctx[c].type->get_arb(want, num_vec_at(&v, at));
      bool same = r.status[i] == flag[at] && (flag[at] || arb_equal(x, want));
      ck_assert_msg(same, "%s, seed %lu: %s at x = %g, y = %g\n%s", ctx[c].type->name, (ulong)seed, names[i], value[0],
                    value[1], file.data);
      if (c != ARB) continue;
      counts->ok += r.status[i] == SS_OK;
      counts->domain += r.status[i] == SS_DOMAIN;
      counts->unable += (r.status[i] & SS_UNABLE) != 0;
    }
    check_alone(&w, names[seed % N_OUT], &r, (slong)(seed % N_OUT));
  }
}

TEST(random_formulas) {
  struct counts c = {0, 0, 0};
  for (uint64_t seed = 1; seed <= 300; seed++) check_formula(&c, seed);
  /* the formulas are worth their time: most have a value, and some do not */
  ck_assert_msg(c.ok > 1000 && c.domain > 50 && c.unable < 100, "%d values, %d undefined, %d untold", c.ok, c.domain,
                c.unable);
}

/* ---- broken tapes */

static struct tape broken;

static void run_check(void) {
  tape_check(&broken);
}

static int checked(struct tape_instr *in, struct tape_instr wrong) {
  struct tape_instr right = *in;
  *in = wrong;
  int end = child_end(run_check);
  *in = right;
  return end;
}

TEST(broken_tapes_abort) {
  OWNED(work) w;
  work_y(&w, "x", "  root r: r^2 - x, smallest positive\n  y := sin(x)/x + 2*r");
  broken = w.t;
  ck_assert_int_eq(child_end(run_check), 0);
  for (slong i = 0; i < broken.n; i++) {
    struct tape_instr *in = &broken.code[i], bad = *in;
    bool binary = in->op == TAPE_div || in->op == TAPE_mul || in->op == TAPE_add;
    bool operand = binary || in->op == TAPE_sin || in->op == TAPE_ROOT;
    bool index = in->op == TAPE_CONST || in->op == TAPE_INPUT;
    if (operand) {
      bad.a = in->op == TAPE_ROOT ? broken.n_links : i;
      ck_assert_int_eq(checked(in, bad), -SIGABRT);
      bad.a = -1;
      ck_assert_int_eq(checked(in, bad), -SIGABRT);
      bad = *in;
    }
    if (binary || in->op == TAPE_ROOT) {
      bad.b = binary ? i : 1;
      ck_assert_int_eq(checked(in, bad), -SIGABRT);
      bad = *in;
    }
    if (index) {
      bad.k = in->op == TAPE_CONST ? broken.n_consts : broken.n_inputs;
      ck_assert_int_eq(checked(in, bad), -SIGABRT);
      bad.k = -1;
      ck_assert_int_eq(checked(in, bad), -SIGABRT);
    }
  }
  slong keep = broken.links[1];
  broken.links[1] = broken.n;
  ck_assert_int_eq(child_end(run_check), -SIGABRT);
  broken.links[1] = keep;
  broken.outputs[0] = broken.n;
  ck_assert_int_eq(child_end(run_check), -SIGABRT);
  broken.outputs[0] = broken.n - 1;
  ck_assert_int_eq(child_end(run_check), 0);
}

/* ---- long formulas: the parser takes 100000 nodes, and whatever it takes must go through */

static double evaluate(const struct tape *t, double x) {
  OWNED(run) r = run_of(t, num_ctx_double());
  give_d(&r, t, "x", x);
  run_go(&r, t);
  ck_assert_int_eq(r.all, SS_OK);
  return get_d(&r, 0);
}

/* Of the given length, in one of five ways to be long. */
static void long_formula(struct text *t, int way, int n) {
  text_init(t);
  switch (way) {
  case 0: /* 1 + ... + 49999 = 49999 * 25000 */
    text_add(t, "  y := x");
    for (int i = 1; i < n; i++) text_printf(t, " + %d", i);
    break;
  case 1: /* an odd number of factors */
    text_add(t, "  y := x");
    text_add(t, nested("*x", "", "", (size_t)n));
    break;
  case 2: /* an entry of an entry of ... */
    text_add(t, "  y := x");
    text_add(t, nested("[1]", "", "", (size_t)n));
    break;
  case 3: /* sqrt(40000 x) */
    text_add(t, "  root y: y^2");
    text_add(t, nested(" - x", "", "", (size_t)n));
    text_add(t, ", smallest positive");
    break;
  default: /* definition after definition, each a call of the one before */
    text_add(t, "  f0(t) := t\n");
    for (int i = 1; i < n; i++) text_printf(t, "  f%d(t) := (f%d(t))\n", i, i - 1);
    text_printf(t, "  y := f%d(x)", n - 1);
    break;
  }
}

struct long_formula {
  struct text text;
  double x, y;
};

static void value_of_formula(void *arg) {
  struct long_formula *f = arg;
  OWNED(work) w;
  work_y(&w, "xt", f->text.data);
  f->y = evaluate(&w.t, f->x);
}

/* Of four times the length, it costs about four times as much; sixteen times, if anything grew with the square. */
TEST_EACH(long_formulas, 5) {
  static const int length[] = {50000, 49998, 99000, 40000, 990};
  static const double expected[] = {1249975000.5, -1, 0.25, 300, 0.5};
  static const double x[] = {0.5, -1, 0.25, 2.25, 0.5};
  struct long_formula whole = {.x = x[_i]}, quarter = {.x = x[_i]};
  long_formula(&whole.text, _i, length[_i]);
  long_formula(&quarter.text, _i, length[_i] / 4);
  ck_assert_msg(costs_less(&(struct effort){value_of_formula, &whole}, 9, &(struct effort){value_of_formula, &quarter}),
                "not linear in the length");
  ck_assert_msg(fabs(whole.y - expected[_i]) <= 1e-15 * fabs(expected[_i]), "%.17g, expected %.17g", whole.y,
                expected[_i]);
  text_clear(&whole.text);
  text_clear(&quarter.text);
}
