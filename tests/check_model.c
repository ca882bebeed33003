/* Equation files, who sees what of them, and their formulas as scalars.  Elaborated scalars are read as text where the
   shape of the answer is the point, and as numbers, by an evaluator of the test's own, where its value is. */
#include <stdint.h>
#include <sys/stat.h>

#include "model/model.h"
#include "operation.h"
#include "rng.h"
#include "test.h"

/* ---- common ground */

static struct model model;
static struct arena arena;
static struct elaboration el; /* of the last formula */
static int n_files;

static void setup(void) {
  scratch_open();
  model_init(&model);
  arena_init(&arena);
  el = (struct elaboration){.n_memo = 0};
  n_files = 0;
}

static void teardown(void) {
  elaboration_clear(&el);
  arena_clear(&arena);
  model_clear(&model);
  scratch_close();
}

/* As before any file. */
static void forget(void) {
  model_clear(&model);
  model_init(&model);
  n_files = 0;
}

/* What a diagnostic says, without the folder of the file that it is about. */
static const char *shown(const struct diag *d) {
  size_t n = strlen(scratch_path("")) + 1;
  bool inside = strncmp(d->message, formatted("%s/", scratch_path("")), n) == 0;
  return formatted("%s", inside ? d->message + n : d->message);
}

/* Adds a file f1.eq, f2.eq, ... and says "" or what is wrong with it. */
static const char *try_load(const char *text, enum rank rank) {
  struct diag d = {0};
  const char *path = scratch_put(formatted("f%d.eq", ++n_files), text);
  bool ok = model_add_file(&model, path, rank, &d);
  ck_assert(ok != d.set);
  return shown(&d);
}

static void load(const char *text, enum rank rank) {
  ck_assert_str_eq(try_load(text, rank), "");
}

static struct view printed_view(void) {
  return (struct view){&model, LAYER_PRINTED, NULL, NULL};
}

/* What the words say of a view: its layer, own=EQUATION, control=RECORD, in=SECTION.  NULL: those that strtok has
   left. */
static struct view view_named(const char **section, char *words) {
  struct view v = printed_view();
  *section = "";
  for (char *w = strtok(words, " "); w; w = strtok(NULL, " ")) {
    if (strncmp(w, "own=", 4) == 0)
      v.own = w + 4;
    else if (strncmp(w, "control=", 8) == 0)
      v.control = w + 8;
    else if (strncmp(w, "in=", 3) == 0)
      *section = w + 3;
    else
      v.layer = (enum layer)word_find(w, layer_name, N_LAYERS);
    ck_assert_int_lt(v.layer, N_LAYERS);
  }
  return v;
}

/* The value of a formula in el; NULL with d set when it has none. */
static const struct matrix *value_in(struct view v, const char *section, const char *formula, struct diag *d) {
  struct matrix *m = arena_alloc(&arena, sizeof *m);
  elaboration_clear(&el);
  elaboration_init(&el, v, NULL, 0);
  diag_init(d);
  bool ok = elaborate_text(m, &el, "e", formula, section, d);
  ck_assert(ok != d->set);
  return ok ? m : NULL;
}

static const struct matrix *value_of(const char *formula) {
  struct diag d;
  const struct matrix *m = value_in(printed_view(), "", formula, &d);
  ck_assert_msg(m, "%s", d.message);
  return m;
}

static const char *spell(const struct matrix *m) {
  LOCAL(text, t);
  bool brackets = m->rows * m->cols > 1;
  for (int i = 0; i < m->rows; i++)
    for (int j = 0; j < m->cols; j++) {
      text_add(&t, !brackets ? "" : j > 0 ? ", " : i > 0 ? "; " : "[");
      expr_print(&t, m->e[i * m->cols + j]);
    }
  if (brackets) text_add(&t, "]");
  const char *s = formatted("%.2000s", t.data); /* Check breaks off at very long messages */
  return s;
}

/* The value as text, or the diagnostic. */
static const char *says(struct view v, const char *section, const char *formula) {
  struct diag d;
  const struct matrix *m = value_in(v, section, formula, &d);
  return m ? spell(m) : shown(&d);
}

struct named {
  const char *name;
  double value;
};

/* The number that a scalar stands for; a trajectory z is the sine, and its n-th derivative that of the sine. */
static double number(const struct expr *e, const struct named *env) {
  double a = e->n_args > 0 ? number(e->args[0], env) : 0, b = e->n_args > 1 ? number(e->args[1], env) : 0;
  if (e->kind == EXPR_CALL) return sin(a + e->order * acos(0));
  if (e->kind != EXPR_SYM) return (double)operation_value(e, a, b);
  for (; env->name; env++)
    if (strcmp(env->name, e->name) == 0) return env->value;
  ck_abort_msg("no value for %s", e->name);
}

static void near(double x, double expected, const char *what) {
  ck_assert_msg(fabs(x - expected) <= 1e-13 * (1 + fabs(expected)), "%s: %.17g, expected %.17g", what, x, expected);
}

static struct rng rng;

/* ---- sections */

CASE("model", .each = {setup, teardown});

TEST_EACH(names_by_section, 3) {
  static const char *const part[] = {
      "section: a\ndefine d1\n  x := 1\n  y := x\n  only := x + 10\n",
      "section: b\ndefine d2\n  x := 2\n  y := x\n  k := 7\n",
      "define d3\n  k := 8\n  z := only\ndefine d4\n  section: c\n  k := 9\n",
  };
  for (int i = 0; i < 3; i++) load(part[(i + _i) % 3], RANK_PAPER); /* the order of the files tells nothing */
  enum { SECTION, FORMULA, SAYS };
  OWNED(table) c = table_read("tests/cases/model_sections.tsv", 3);
  for (int i = 0; i < c.n; i++)
    ck_assert_str_eq(says(printed_view(), c.row[i][SECTION], c.row[i][FORMULA]), c.row[i][SAYS]);
}

/* ---- overlays */

TEST_EACH(overlays_by_rank, 5) {
  static const char *const part[] = {"define p\n  equation: 5\n  x := 1\n", "define u\n  x := 2\n",
                                     "define e\n  equation: 5\n  x := 3\n", "define s\n  equation: 5\n  x := 6\n",
                                     "define ctl\n  x := 4\ndefine ctl-2\n  x := 5\n"};
  for (int i = 0; i < 5; i++) load(part[(i + _i) % 5], (enum rank)((i + _i) % 5));
  OWNED(table) c = table_read("tests/cases/model_overlays.tsv", 2);
  for (int i = 0; i < c.n; i++) {
    const char *section;
    struct view v = view_named(&section, c.row[i][0]);
    ck_assert_str_eq(says(v, section, "x"), c.row[i][1]);
  }
}

static const char *right_side(struct view v, const char *id) {
  const struct statement_record *r = view_record(&v, id);
  if (!r) return "none";
  LOCAL(text, t);
  for (int i = 0; i < r->n_stmts; i++) expr_print(&t, r->stmts[i]->sides[1]);
  return formatted("%s", text_str(&t));
}

static const char *checked(struct view v) {
  struct diag d = {0};
  ck_assert(view_check(v, &d) != d.set);
  return shown(&d);
}

TABLE(steps, "tests/cases/model_steps.tsv", 3);
enum { STEP, TEXT, SAYS }; /* its columns */

TEST(files_one_after_another) {
  static const char *const ranks[] = {"paper", "user", "errata", "stable", "control"};
  for (int i = 0; i < steps.n; i++) {
    char *const *row = steps.row[i];
    const char *said = "", *section, *step = strtok(row[STEP], " ");
    if (strcmp(step, "new") == 0) {
      forget();
      continue;
    }
    int rank = word_find(step, ranks, COUNT(ranks));
    struct view v = view_named(&section, NULL);
    if (rank < (int)COUNT(ranks)) said = try_load(row[TEXT], (enum rank)rank);
    if (strcmp(step, "right") == 0) said = right_side(v, row[TEXT]);
    if (strcmp(step, "check") == 0) said = *row[SAYS] && strstr(checked(v), row[SAYS]) ? row[SAYS] : checked(v);
    if (strcmp(step, "value") == 0) {
      struct matrix again;
      said = says(v, section, row[TEXT]);
      struct diag d; /* the same elaboration again: the same mistake, not one that the first left behind */
      diag_init(&d);
      if (!elaborate_text(&again, &el, "e", row[TEXT], section, &d)) ck_assert_str_eq(shown(&d), said);
    }
    ck_assert_msg(strcmp(said, row[SAYS]) == 0, "step %d, %s: %s\nsays %s", i + 1, row[TEXT], said, row[SAYS]);
  }
}

TEST(what_a_model_keeps) {
  load("paper: On friction\nequation e-1\n  equation: 1\n  tex: a = 1\n  1 = 1\n", RANK_PAPER);
  ck_assert_str_eq(model.paper, "On friction");
  const struct statement_record *r = &model.records[0];
  ck_assert_str_eq(r->tex, "a = 1");
  ck_assert_str_eq(r->equation, "1");
  ck_assert_str_eq(r->section, "");
}

TEST(folders_of_files) {
  const char *top = scratch_path("");
  fails_with(model_add_folder(&model, scratch_path("absent"), RANK_PAPER, &d),
             "/absent: error: No such file or directory");
  fails_as(model_add_folder(&model, top, RANK_PAPER, &d), formatted("%s: error: no .eq file in this folder", top));
  static const char order[] = "duhafqbzcm"; /* of writing; they are read from a to z */
  for (const char *p = order; *p; p++) scratch_put(formatted("%c.eq", *p), formatted("symbol %c\n", *p));
  scratch_put(".hidden.eq", "nonsense\n");
  scratch_put("a.eq~", "nonsense\n");
  scratch_put(".eq", "nonsense\n");
  goes_well(model_add_folder(&model, top, RANK_PAPER, &d));
  ck_assert_uint_eq(model.n_symbols, strlen(order));
  for (size_t i = 1; i < model.n_symbols; i++) ck_assert(*model.symbols[i - 1].name < *model.symbols[i].name);
  ck_assert(mkdir(scratch_path("3.eq"), 0755) == 0);
  forget();
  fails_with(model_add_folder(&model, top, RANK_PAPER, &d), "/3.eq: error: a folder, not a regular file");
}

/* ---- mistakes of formulas, each with its place */

static const char common[] = "symbol s\nsymbol t\nrelation m\n  trajectory z(t)\ndefine d\n"
                             "  A := [1, 2; 3, 4]\n  B := [1, 2, 3; 4, 5, 6; 7, 8, 9]\n  v := [5; 6]\n  r := [7, 8]\n"
                             "  F := [B, [B[1:2,1:2]; 0]; 0, A]\n  f(t) := 2*t\n"
                             "  root r0: r0^2 - s, smallest positive\n  root q0: q0 + s, smallest positive\n";

TEST(formulas_refused) {
  enum { FORMULA, AT, WHAT };
  OWNED(table) c = table_read("tests/cases/model_formulas.tsv", 3);
  load(common, RANK_PAPER);
  for (int i = 0; i < c.n; i++) {
    size_t column = strtoul(c.row[i][AT] + 2, NULL, 10);
    ck_assert_str_eq(
        says(printed_view(), "", c.row[i][FORMULA]),
        formatted("e:%s: error: %s\n  %s\n  %*s", c.row[i][AT], c.row[i][WHAT], c.row[i][FORMULA], (int)column, "^"));
  }
}

/* ---- functions */

/* The entries of formulas in a table are what stands beside them, without derivatives and expansions. */
static void are_equal(const char *path, const struct named *env) {
  enum { FORMULA, ENTRY, PLAIN };
  OWNED(table) c = table_read(path, 3);
  for (int i = 0; i < c.n; i++) {
    double plain = number(value_of(c.row[i][PLAIN])->e[0], env);
    near(number(value_of(c.row[i][FORMULA])->e[atoi(c.row[i][ENTRY])], env), plain, c.row[i][FORMULA]);
  }
}

/* H(t) = [cos wt, sin wt / w] and its derivatives, by hand. */
TEST(derivatives_of_functions) {
  load("symbol w\nsymbol u\nsymbol t\ndefine d\n"
       "  H(t) := [cos(w*t), sin(w*t)/w]\n"
       "  G(u) := H'(2*u)\n"
       "  q(t) := t^3/(1 + t)\n"
       "  deep(t) := q(q(t))\n"
       "relation m\n  trajectory z(t)\ndefine e\n"
       "  along(t) := z(w*t) + z'(t)\n",
       RANK_PAPER);
  static const struct named env[] = {{"w", 1.25}, {"u", 0.7}, {"t", 100}, {NULL, 0}};
  are_equal("tests/cases/model_derivatives.tsv", env);
}

TEST(first_orders) {
  load("symbol a\nsymbol t\nsymbol x\nsymbol y\ndefine d\n  H(t) := [cos(a*t); sin(a*t)]\n  v := [x; y]\n", RANK_PAPER);
  static const struct named env[] = {{"a", 1.25}, {"t", 0.7}, {"x", 0.1}, {"y", 0.2}, {NULL, 0}};
  are_equal("tests/cases/model_first_orders.tsv", env);
}

/* ---- matrices */

/* Of L U, L with ones and U with chosen numbers on the diagonal: their product is the determinant. */
TEST(determinants_and_inverses) {
  static const struct named none[] = {{NULL, 0}};
  rng.state = 11;
  for (int trial = 0; trial < 40; trial++) {
    int n = trial % 4 + 1;
    double l[4][4] = {{0}}, u[4][4] = {{0}}, a[4][4] = {{0}}, trace = 0, det = 1;
    LOCAL(text, t);
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        double x = (double)((long)(rng_next(&rng) % 65) - 32) / 8;
        *(i > j ? &l[i][j] : &u[i][j]) = i == j && fabs(x) < 1 ? 9 : x;
        l[i][i] = 1;
      }
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        for (int k = 0; k < n; k++) a[i][j] += l[i][k] * u[k][j];
        text_printf(&t, "%s%.6f", j ? ", " : i ? "; " : "[", a[i][j]);
      }
    for (int i = 0; i < n; i++) {
      trace += a[i][i];
      det *= u[i][i];
    }
    text_add(&t, "]");
    near(number(value_of(formatted("tr(%s)", t.data))->e[0], none), trace, t.data);
    near(number(value_of(formatted("det(%s)", t.data))->e[0], none), det, t.data);
    const struct matrix *m = value_of(formatted("transpose(%s)", t.data));
    for (int i = 0; i < n * n; i++) near(number(m->e[i], none), a[i % n][i / n], t.data);
    m = value_of(formatted("inv(%s)", t.data));
    ck_assert(m->rows == n && m->cols == n);
    for (int i = 0; i < n * n; i++) {
      double sum = 0;
      for (int k = 0; k < n; k++) sum += a[i / n][k] * number(m->e[k * n + i % n], none);
      near(sum, i / n == i % n, t.data);
    }
  }
}

/* ---- roots */

TEST(polynomials_of_roots) {
  OWNED(table) c = table_read("tests/cases/model_polynomials.tsv", ANY_COLUMNS);
  load("symbol a\nsymbol b\ndefine d\n  K := [1, a; -b/4, 3]\n  I := [1, 0; 0, 1]\n  f(t) := a*t^2\n  g := a + b\n",
       RANK_PAPER);
  const struct named env[] = {{"a", 2}, {"b", 3}, {NULL, 0}};
  for (int i = 0; i < c.n; i++) {
    const char *polynomial = c.row[i][0];
    int n = 0;
    while (c.row[i][1 + n]) n++;
    load(formatted("define c-%d\n  root w: %s, %s positive\n", i, polynomial, i % 2 ? "largest" : "smallest"),
         RANK_CONTROL);
    struct diag d;
    const struct matrix *m = value_in((struct view){&model, LAYER_PRINTED, NULL, formatted("c-%d", i)}, "", "w", &d);
    ck_assert_msg(m, "%s", d.message);
    ck_assert_str_eq(spell(m), "w");
    ck_assert_uint_eq(el.n_roots, 1);
    ck_assert_int_eq(el.roots[0].n_coeff, n);
    ck_assert_int_eq(el.roots[0].largest, i % 2);
    for (int k = 0; k < n; k++)
      near(number(el.roots[0].coeff[k], env), atof(c.row[i][1 + k]), formatted("%s, x^%d", polynomial, k));
  }
}

/* The polynomial of one may hold the other. */
TEST(roots_of_two_sections) {
  load("section: a\ndefine a\n  root w: w^2 - g, smallest positive\n", RANK_PAPER);
  load("section: b\ndefine b\n  g := 3*w\n  root w: w - 5, largest positive\n  root v: v - 1, largest positive\n",
       RANK_PAPER);
  ck_assert_str_eq(says(printed_view(), "a", "w*g"), "w@a*(3*w@b)");
  ck_assert_uint_eq(el.n_roots, 2);
  for (int i = 0; i < 2; i++) {
    bool a = strcmp(el.roots[i].name, "w@a") == 0;
    const struct named env[] = {{"w@b", 5}, {NULL, 0}};
    ck_assert_int_eq(el.roots[i].n_coeff, a ? 3 : 2);
    near(number(el.roots[i].coeff[0], env), a ? -15 : -5, el.roots[i].name);
  }
}

/* ---- values from outside */

TEST(overridden_matrices) {
  load("symbol s\nsymbol t\ndefine d\n  A := [s, 2; 3, 4]\n  P := A*[1; s]\n  f(A) := A + 1\n  one := 1/s\n",
       RANK_PAPER);
  static const struct override o[] = {{"A", 2, 2}, {"one", 1, 1}};
  static const char *const c[][2] = {
      {"A", "[A[1,1], A[1,2]; A[2,1], A[2,2]]"},
      {"P", "[A[1,1]*1 + A[1,2]*s; A[2,1]*1 + A[2,2]*s]"},
      {"tr(A)", "A[1,1] + A[2,2]"},
      {"one", "one[1,1]"},
      {"f(s)", "s + 1"}, /* a parameter hides it */
  };
  for (size_t i = 0; i < COUNT(c); i++) {
    struct matrix m;
    elaboration_clear(&el);
    elaboration_init(&el, printed_view(), o, 2);
    goes_well(elaborate_text(&m, &el, "e", c[i][0], "", &d));
    ck_assert_str_eq(spell(&m), c[i][1]);
  }
}

/* ---- both sides, and everything at once */

TEST(sides_in_one_shape) {
  load("symbol s\nequation e\n  [s; 1] = 0\n  0 = [s, 1] = [1, 2]\n  s = [1; 2]\n  s = 0\n", RANK_PAPER);
  static const struct {
    int stmt, step;
    const char *lhs, *rhs;
  } c[] = {{0, 0, "[s; 1]", "[0; 0]"}, {1, 0, "[0, 0]", "[s, 1]"}, {1, 1, "[s, 1]", "[1, 2]"}, {3, 0, "s", "0"}};
  elaboration_init(&el, printed_view(), NULL, 0);
  const struct statement_record *r = &model.records[0];
  struct matrix a, b;
  struct diag d = {0};
  for (size_t i = 0; i < COUNT(c); i++) {
    ck_assert(elaborate_sides(&a, &b, &el, r->stmts[c[i].stmt], c[i].step, r->src, "", &d));
    ck_assert_str_eq(spell(&a), c[i].lhs);
    ck_assert_str_eq(spell(&b), c[i].rhs);
  }
  ck_assert(!elaborate_sides(&a, &b, &el, r->stmts[2], 0, r->src, "", &d));
  ck_assert_str_eq(shown(&d), "f1.eq:5:3: error: the two sides have the shapes 1x1 and 2x1\n    s = [1; 2]\n    ^");
}

/* ---- limits: each is a diagnostic, none is a crash */

/* y_n := 1 - (1 - ( ... (1 - y_(n-1)))) with 150 brackets */
static const char *nested_definitions(int n) {
  LOCAL(text, t);
  text_add(&t, "symbol s\ndefine d\n  y0 := s\n");
  for (int i = 1; i <= n; i++) {
    text_printf(&t, "  y%d := %s\n", i, nested("1 - (", formatted("y%d", i - 1), ")", 150));
  }
  return formatted("%s", t.data);
}

TEST(nesting_is_bounded) {
  static const struct named env[] = {{"s", 0.25}, {NULL, 0}};
  load(nested_definitions(20), RANK_PAPER);
  near(number(value_of("y6")->e[0], env), 0.25, "900 brackets, an even number"); /* 1 - (1 - s) = s */
  static const char *const wrong[] = {"y7", "y20"};
  for (int i = 0; i < 2; i++)
    ck_assert_ptr_nonnull(strstr(says(printed_view(), "", wrong[i]),
                                 "error: definitions and brackets nested more than 1000 levels deep"));
}

TEST(sizes_are_bounded) {
  LOCAL(text, t);
  text_add(&t, "symbol s\ndefine d\n  column := [1");
  for (int i = 1; i < 65; i++) text_printf(&t, "; %d", i);
  text_add(&t, "]\n  square := column[1:64]*transpose(column[1:64])\n  s0 := s\n");
  for (int i = 1; i <= 20; i++) text_printf(&t, "  s%d := s%d*s%d\n", i, i - 1, i - 1);
  text_add(&t, "  root w: w - s20, smallest positive\n");
  load(t.data, RANK_PAPER);
  /* 64 by 64 is the largest */
  ck_assert_int_eq(value_of("square")->rows, 64);
  ck_assert_str_eq(says(printed_view(), "", "column*transpose(column)"),
                   "e:1:1: error: a matrix of more than 4096 entries: the shapes are 65x1 and 1x65\n"
                   "  column*transpose(column)\n  ^");
  ck_assert_str_eq(says(printed_view(), "", "[square, square[1:64,1]]"),
                   "e:1:1: error: a matrix of more than 4096 entries\n  [square, square[1:64,1]]\n  ^");
  /* s20 is 2^20 factors, but 20 shared products */
  ck_assert_int_eq(value_of("s20")->rows, 1);
  ck_assert(el.pool.n <= 21);
  ck_assert_ptr_nonnull(strstr(says(printed_view(), "", "w"), "error: the polynomial in w is too large"));
  /* 64^3 products and nearly as many sums */
  ck_assert_str_eq(says(printed_view(), "", "s + tr(square*square)"),
                   "e:1:8: error: a formula of more than 500000 scalars when its definitions are put in\n"
                   "  s + tr(square*square)\n         ^");
}

/* ---- the paper */

TEST(paper_files) {
  goes_well(model_add_folder(&model, "verify/paper", RANK_PAPER, &d));
  goes_well(model_add_file(&model, "verify/errata.eq", RANK_ERRATA, &d));
  for (int layer = 0; layer < N_LAYERS; layer++)
    goes_well(view_check((struct view){&model, (enum layer)layer, NULL, NULL}, &d));
  /* the equations carry the paper's numbers, and what quotes its text without one is a sentence */
  enum { LAST = 61 };
  bool numbered[LAST + 1] = {false};
  for (size_t i = 0; i < model.n_records; i++) {
    const struct statement_record *r = &model.records[i];
    ck_assert_msg(!*r->tex || *r->equation || strncmp(r->id, "text-", 5) == 0, "%s: quoted, but no number", r->id);
    ck_assert_msg(*r->section || !*r->equation, "%s: no section", r->id);
    unsigned long n = strtoul(r->equation, NULL, 10);
    ck_assert_msg(n <= LAST, "%s: the paper has no equation %s", r->id, r->equation);
    if (r->rank == RANK_PAPER) numbered[n] = true;
  }
  for (int i = 1; i <= LAST; i++) ck_assert_msg(numbered[i], "equation (%d) is missing", i);
}
