/* Formulas: the grammar fact by fact, every diagnostic with its place, round trips of random trees, LaTeX, the pool and
   derivatives.  Trees are held against trees that the test builds itself, derivatives against difference quotients of
   the evaluator below, which shares nothing with the library but the nodes it reads. */
#include <float.h>
#include <limits.h>
#include <stdint.h>

#include "expr/expr.h"
#include "operation.h"
#include "rng.h"
#include "test.h"

/* ---- common ground */

static struct arena arena;
static struct expr_pool pool;

static void setup(void) {
  arena = (struct arena){NULL};
  pool = (struct expr_pool){.n = 0};
}

static void teardown(void) {
  expr_pool_clear(&pool);
  arena_clear(&arena);
}

static struct rng rng;
static int below(int n) {
  return (int)(rng_next(&rng) % (uint64_t)n);
}

static const struct expr *parse_expr(const char *text, struct diag *d) {
  OWNED(source) src = source_of("t", text);
  return expr_parse(&arena, &src, (struct span){0, src.len}, d);
}

static const struct stmt *parse_stmt(const char *text, struct diag *d) {
  OWNED(source) src = source_of("t", text);
  return stmt_parse(&arena, &src, (struct span){0, src.len}, d);
}

static const struct expr *tree(const char *text) {
  struct diag d = {0};
  const struct expr *e = parse_expr(text, &d);
  ck_assert_msg(e && !d.set, "%s\n%s", text, d.message);
  return e;
}

static const struct stmt *statement(const char *text) {
  struct diag d = {0};
  const struct stmt *s = parse_stmt(text, &d);
  ck_assert_msg(s && !d.set, "%s\n%s", text, d.message);
  return s;
}

static struct expr *make(enum expr_kind k, int n_args) {
  struct expr *e = arena_alloc(&arena, sizeof *e);
  e->kind = k;
  e->n_args = n_args;
  if (n_args) e->args = arena_alloc(&arena, (size_t)n_args * sizeof *e->args);
  return e;
}

static struct expr *leaf(enum expr_kind k, const char *name) {
  struct expr *e = make(k, 0);
  e->name = arena_strndup(&arena, name, strlen(name));
  return e;
}

static struct expr *one(enum expr_kind k, const struct expr *a) {
  struct expr *e = make(k, 1);
  e->args[0] = a;
  return e;
}

static struct expr *two(enum expr_kind k, const struct expr *a, const struct expr *b) {
  struct expr *e = make(k, 2);
  e->args[0] = a;
  e->args[1] = b;
  return e;
}

static struct expr *power(const struct expr *a, int n) {
  struct expr *e = one(EXPR_POW, a);
  e->exponent = n;
  return e;
}

/* The tree in a notation of the test's own: (+ a (* b c)), every node spelt out. */
static void spell(struct text *out, const struct expr *e) {
  static const char *const names[] = {"num", "sym",     "call",      "neg",         "+",      "-",     "*",
                                      "/",   "^",       "sin",       "cos",         "cot",    "sqrt",  "exp",
                                      "abs", "rounded", "sinc",      "stumpff",     "hypot",  "paren", "inv",
                                      "det", "tr",      "transpose", "first_order", "matrix", "index"};
  if (e->kind == EXPR_NUM || e->kind == EXPR_SYM) {
    text_add(out, e->name);
    return;
  }
  text_printf(out, "(%s", names[e->kind]);
  if (e->kind == EXPR_CALL) text_printf(out, " %s %d", e->name, e->order);
  if (e->kind == EXPR_POW) text_printf(out, " %d", e->exponent);
  if (e->kind == EXPR_MATRIX) text_printf(out, " %dx%d", e->rows, e->cols);
  for (int k = 0; k < e->n_index; k++)
    text_printf(out, e->index_range[k] ? " %d:%d" : " %d", e->index[2 * k], e->index[2 * k + 1]);
  for (int i = 0; i < e->n_args; i++) {
    text_add(out, " ");
    spell(out, e->args[i]);
  }
  text_add(out, ")");
}

/* ---- the grammar */

TABLE(grammar, "tests/cases/grammar.tsv", 2);
enum { G_TEXT, G_TREE }; /* its columns */

CASE("expr", .each = {setup, teardown}, .seconds = 60);

TEST(test_grammar) {
  LOCAL(text, t);
  for (int i = 0; i < grammar.n; i++) {
    if (!*grammar.row[i][G_TREE]) {
      ck_assert_msg(!parse_expr(grammar.row[i][G_TEXT], NULL), "%s", grammar.row[i][G_TEXT]);
      continue;
    }
    text_reset(&t);
    spell(&t, tree(grammar.row[i][G_TEXT]));
    ck_assert_str_eq(text_str(&t), grammar.row[i][G_TREE]);
  }
}

TEST(test_statements) {
  const struct stmt *s = statement("  J_a := a + b # sum");
  ck_assert(s->kind == STMT_DEFINE && !strcmp(s->name, "J_a") && !s->param && s->n_sides == 1);
  ck_assert_uint_eq(s->name_span.begin, 2);
  ck_assert_uint_eq(s->name_span.end, 5);
  ck_assert_uint_eq(s->span.begin, 2);
  ck_assert_uint_eq(s->span.end, 14);
  ck_assert(expr_same(s->sides[0], tree("a+b")));

  s = statement("H(t) := [c1(t), 0; 0, 1]");
  ck_assert(s->kind == STMT_DEFINE && !strcmp(s->name, "H") && !strcmp(s->param, "t"));

  s = statement("H(t) = K");
  ck_assert(s->kind == STMT_RELATION && s->n_sides == 2 && s->ops[0] == REL_EQ && !s->range_var);
  ck_assert(s->sides[0]->kind == EXPR_CALL);

  s = statement("e1 - 2*u < x <= y > 1 >= z = 0 for t in (0, t_a]");
  ck_assert(s->kind == STMT_RELATION && s->n_sides == 6);
  const enum relop ops[] = {REL_LT, REL_LE, REL_GT, REL_GE, REL_EQ};
  for (int i = 0; i < 5; i++) ck_assert_int_eq(s->ops[i], ops[i]);
  ck_assert(expr_same(s->sides[0], tree("e1 - 2*u")) && expr_same(s->sides[5], tree("0")));
  ck_assert(!strcmp(s->range_var, "t") && !s->range_signs && !s->lo_closed && s->hi_closed);
  ck_assert(expr_same(s->range_lo, tree("0")) && expr_same(s->range_hi, tree("t_a")));

  s = statement("a < b for t in [t_a, t_a + t_b)");
  ck_assert(s->lo_closed && !s->hi_closed && expr_same(s->range_hi, tree("t_a+t_b")));
  s = statement("eps*a = b for eps in { + 1, -1 }");
  ck_assert(!strcmp(s->range_var, "eps") && s->range_signs && !s->range_lo);

  s = statement("root omega1: w^4 - b*w^2 + c, smallest positive");
  ck_assert(s->kind == STMT_ROOT && !strcmp(s->name, "omega1") && !s->largest && s->n_sides == 1);
  ck_assert(expr_same(s->sides[0], tree("w^4 - b*w^2 + c")));
  ck_assert(statement("root w: w - 1, largest positive")->largest);

  s = statement("trajectory z_1(t), z_2(s)");
  ck_assert(s->kind == STMT_TRAJECTORY && s->n_names == 2);
  ck_assert(!strcmp(s->names[0], "z_1") && !strcmp(s->params[0], "t"));
  ck_assert(!strcmp(s->names[1], "z_2") && !strcmp(s->params[1], "s"));
}

/* The span of every node is the text that reads as that node. */
static void check_spans(const char *text, const struct expr *e) {
  const char *part = formatted("%.*s", (int)(e->span.end - e->span.begin), text + e->span.begin);
  ck_assert_msg(expr_same(e, tree(part)), "%s in %s", part, text);
  ck_assert_msg(!strchr(" \n", part[0]) && !strchr(" \n", part[strlen(part) - 1]), "\"%s\" in %s", part, text);
  for (int i = 0; i < e->n_args; i++) check_spans(text, e->args[i]);
}

TEST(test_spans) {
  static const char *const text = "-a*b + [1, x ; H'(t_c)[1:2,3], (p)] - sin( u )^(-2) / v'_1 + [a] [1]";
  const struct expr *e = tree(text);
  check_spans(text, e);
  ck_assert_uint_eq(e->span.begin, 0);
  ck_assert_uint_eq(e->span.end, strlen(text));
  /* only the span is read, to the byte */
  OWNED(source) src = source_of("t", "x = (a + b)*c \xE2\x88\x92");
  e = expr_parse(&arena, &src, (struct span){4, 11}, NULL);
  ck_assert(e && e->kind == EXPR_PAREN && e->span.begin == 4 && e->span.end == 11);
  fails_with(expr_parse(&arena, &src, (struct span){12, 16}, &d), "t:1:15: error: byte 0xE2");
}

/* ---- diagnostics: the first line must begin with t:PLACE: error: and hold PART */

TABLE(mistakes, "tests/cases/mistakes.tsv", 4);
enum { M_STMT, M_TEXT, M_PLACE, M_PART }; /* its columns */

static void check_mistake(const char *text, bool stmt, const char *place, const char *part) {
  struct diag d = {0};
  bool parsed = stmt ? parse_stmt(text, &d) != NULL : parse_expr(text, &d) != NULL;
  ck_assert_msg(!parsed && d.set, "accepted: %s", text);
  const char *begin = formatted("t:%s: error: ", place);
  ck_assert_msg(!strncmp(d.message, begin, strlen(begin)), "%s\nis not at %s:\n%s", text, place, d.message);
  ck_assert_msg(strstr(d.message, part), "%s\nlacks: %s\n%s", text, part, d.message);
}

TEST(test_mistakes) {
  for (int i = 0; i < mistakes.n; i++)
    check_mistake(mistakes.row[i][M_TEXT], *mistakes.row[i][M_STMT] == 'y', mistakes.row[i][M_PLACE],
                  mistakes.row[i][M_PART]);
}

TEST(test_limits) {
  /* 200 levels of nesting, whatever nests */
  static const char *const nests[][2] = {{"(", ")"},   {"[", "]"},  {"sin(", ")"},
                                         {"f'(", ")"}, {"(-", ")"}, {"1+(", ")"}};
  for (size_t i = 0; i < COUNT(nests); i++) {
    tree(nested(nests[i][0], "x", nests[i][1], 200));
    fails_with(parse_expr(nested(nests[i][0], "x", nests[i][1], 201), &d), "nested more than 200 levels");
  }
  check_mistake(nested("(", "x", ")", 201), false, "1:202", "nested more than 200 levels");
  check_mistake(nested("(", "", "", 300000), false, "1:202", "nested more than 200 levels");
  /* a sum of n terms has 2 n - 1 nodes */
  tree(nested("a+", "a", "", 49999));
  check_mistake(nested("a+", "a+a", "", 49999), false, "1:1", "more than 100000 nodes");
  /* long chains of everything that is a loop; they must come back as they went in */
  static const char *const chains[][2] = {{"a*", "a"}, {"a+", "a"}, {"a-", "a"}};
  LOCAL(text, t);
  for (size_t i = 0; i < COUNT(chains); i++) {
    const struct expr *e = tree(nested(chains[i][0], chains[i][1], "", 40000));
    text_reset(&t);
    expr_print(&t, e);
    ck_assert(expr_same(e, tree(text_str(&t))));
    text_reset(&t);
    expr_latex(&t, e);
  }
  const struct expr *e = tree(nested("", "A", "[1]", 40000));
  text_reset(&t);
  expr_print(&t, e);
  ck_assert(expr_same(e, tree(text_str(&t))));
  /* nothing to fear from long tokens */
  tree(nested("a", "", "", 1000000));
  tree(nested("7", "", "", 1000000));
  check_mistake(nested("'", "a", "", 1000000), false, "1:1", "a prime marks");
  check_mistake(nested("", "f", "'", 1000000), false, "1:101", "too many primes");
  check_mistake(nested("", "1 ", "a", 1000000), false, "1:3", "aaa...\"");
  check_mistake(nested("\n", "(", "", 100000), false, "100001:2", "found the end");
}

/* ---- round trips */

static const char *const random_names[] = {"a", "x", "t_c", "z'_1b", "omega1", "K"};

static struct expr *random_sum(int depth);

static struct expr *random_leaf(void) {
  return below(3) ? leaf(EXPR_SYM, random_names[below(6)]) : leaf(EXPR_NUM, random_numbers[below(RANDOM_NUMBERS)]);
}

static struct expr *random_matrix(int depth) {
  int rows = 1 + below(3), cols = 1 + below(3);
  struct expr *e = make(EXPR_MATRIX, rows * cols);
  e->rows = rows;
  e->cols = cols;
  for (int i = 0; i < e->n_args; i++) e->args[i] = random_sum(depth);
  return e;
}

static struct expr *random_primary(int depth) {
  static const enum expr_kind functions[] = {EXPR_SIN,     EXPR_COS,     EXPR_COT, EXPR_SQRT,      EXPR_ABS,
                                             EXPR_INV,     EXPR_DET,     EXPR_TR,  EXPR_TRANSPOSE, EXPR_SINC,
                                             EXPR_STUMPFF, EXPR_ROUNDED, EXPR_EXP};
  if (depth <= 0) return random_leaf();
  switch (below(6)) {
  case 0:
    return one(EXPR_PAREN, random_sum(depth - 1));
  case 1:
    if (below(8) == 0) {
      struct expr *e = make(EXPR_HYPOT, 2);
      e->args[0] = random_sum(depth - 1);
      e->args[1] = random_sum(depth - 1);
      return e;
    }
    return one(functions[below(13)], random_sum(depth - 1));
  case 2:
    return random_matrix(depth - 1);
  case 3: {
    struct expr *e = one(EXPR_CALL, random_sum(depth - 1));
    e->name = random_names[below(6)];
    e->order = below(3);
    return e;
  }
  default:
    return random_leaf();
  }
}

static struct expr *random_power(int depth) {
  struct expr *e = random_primary(depth);
  while (e->kind != EXPR_NUM && below(6) == 0) {
    e = one(EXPR_INDEX, e);
    e->n_index = 1 + below(2);
    for (int k = 0; k < e->n_index; k++) {
      e->index[2 * k] = e->index[2 * k + 1] = 1 + below(below(2) ? 4 : 9999);
      e->index_range[k] = below(2);
      if (e->index_range[k]) e->index[2 * k + 1] += below(10000 - e->index[2 * k]);
    }
  }
  return below(5) ? e : power(e, below(20) - 10);
}

static bool begins_with_power(const struct expr *e) {
  return e->kind == EXPR_POW || ((e->kind == EXPR_MUL || e->kind == EXPR_DIV) && begins_with_power(e->args[0]));
}

static struct expr *random_product(int depth) {
  struct expr *e = random_power(depth);
  while (below(3) == 0) e = two(EXPR_MUL, e, random_power(depth));
  return below(5) ? e : two(EXPR_DIV, e, random_power(depth));
}

/* A tree that the grammar can produce, made by walking the grammar's own rules. */
static struct expr *random_sum(int depth) {
  struct expr *e = random_product(depth);
  if (below(4) == 0 && !begins_with_power(e)) e = one(EXPR_NEG, e);
  while (below(3) == 0) e = two(below(2) ? EXPR_ADD : EXPR_SUB, e, random_product(depth));
  return e;
}

/* Blanks and comments wherever two tokens meet; only two characters of one token must not be parted. */
static void spread(struct text *out, const char *s) {
  static const char *const blanks[] = {"", " ", "\n", "\t", " # a + (b\n", "\r\n"};
  for (; *s; s++) {
    text_add_char(out, *s);
    if (strchr("*/(),;[]:", *s) && *s) text_add(out, blanks[below(6)]);
  }
}

TEST(test_round_trip_trees) {
  LOCAL(text, t, wide);
  for (uint64_t seed = 0; seed < 1500; seed++) {
    rng.state = seed;
    const struct expr *e = random_sum(4);
    text_reset(&t);
    expr_print(&t, e);
    struct diag d = {0};
    const struct expr *back = parse_expr(text_str(&t), &d);
    ck_assert_msg(back && expr_same(e, back), "seed %lu: %s\n%s", (unsigned long)seed, text_str(&t), d.message);
    text_reset(&wide);
    spread(&wide, text_str(&t));
    back = parse_expr(text_str(&wide), &d);
    ck_assert_msg(back && expr_same(e, back), "seed %lu: %s\n%s", (unsigned long)seed, text_str(&wide), d.message);
    arena_clear(&arena);
  }
}

/* expr_same must tell trees apart: one changed node is seen, whichever it is. */
TEST(test_same) {
  OWNED(table) different = table_read("tests/cases/different.tsv", 1);
  for (int i = 0; i < different.n; i++)
    for (int j = 0; j < different.n; j++) {
      const char *a = *different.row[i], *b = *different.row[j];
      ck_assert_msg(expr_same(tree(a), tree(b)) == (i == j), "%s %s", a, b);
    }
  ck_assert(expr_same(tree(" a + b "), tree("a+b")));
}

/* The tree without its parentheses, in the pool. */
static const struct expr *stripped(const struct expr *e) {
  switch (e->kind) {
  case EXPR_PAREN:
    return stripped(e->args[0]);
  case EXPR_NUM:
    return expr_num(&pool, e->name);
  case EXPR_SYM:
    return expr_sym(&pool, e->name);
  case EXPR_CALL:
    return expr_call(&pool, e->name, e->order, stripped(e->args[0]));
  case EXPR_POW:
    return expr_pow(&pool, stripped(e->args[0]), e->exponent);
  default:
    if (e->n_args == 1) return expr_op1(&pool, e->kind, stripped(e->args[0]));
    return expr_op2(&pool, e->kind, stripped(e->args[0]), stripped(e->args[1]));
  }
}

TEST(test_round_trip_scalars) {
  LOCAL(text, t);
  for (uint64_t seed = 0; seed < 8000; seed++) {
    rng.state = seed;
    const struct expr *e = random_scalar(&pool, &rng, 1 + below(5), true);
    text_reset(&t);
    expr_print(&t, e);
    struct diag d = {0};
    const struct expr *back = parse_expr(text_str(&t), &d);
    ck_assert_msg(back && stripped(back) == e, "seed %lu: %s\n%s", (unsigned long)seed, text_str(&t), d.message);
  }
}

TABLE(printed, "tests/cases/scalars.tsv", 1);

/* The places where a scalar needs parentheses, and those where it must not get them. */
TEST_EACH(test_print_scalars, printed.n) {
  LOCAL(text, t);
  expr_print(&t, stripped(tree(*printed.row[_i])));
  ck_assert_str_eq(text_str(&t), *printed.row[_i]);
}

TEST(test_print_negative_number) {
  LOCAL(text, t);
  expr_print(&t, expr_int(&pool, -7));
  ck_assert_str_eq(text_str(&t), "-7");
}

TABLE(as_printed, "tests/cases/statements.tsv", 1);

TEST_EACH(test_round_trip_statements, as_printed.n) {
  char *const *row = as_printed.row[_i];
  LOCAL(text, t);
  stmt_print(&t, statement(*row));
  ck_assert_str_eq(text_str(&t), *row);
}

/* ---- LaTeX, by the conventions of mathematical typesetting and expr.h */

TEST(test_latex) {
  enum { KIND, TYPED, TEX };
  LOCAL(text, t);
  OWNED(table) cases = table_read("tests/cases/latex.tsv", 3);
  for (int i = 0; i < cases.n; i++) {
    const char *kind = cases.row[i][KIND], *typed = cases.row[i][TYPED];
    text_reset(&t);
    if (strcmp(kind, "name") == 0)
      name_latex(&t, typed);
    else if (strcmp(kind, "formula") == 0)
      expr_latex(&t, tree(typed));
    else if (strcmp(kind, "scalar") == 0)
      expr_latex(&t, stripped(tree(typed)));
    else if (strcmp(kind, "words") == 0)
      stmt_plain(&t, statement(typed));
    else
      stmt_latex(&t, statement(typed));
    ck_assert_str_eq(text_str(&t), cases.row[i][TEX]);
  }
}

/* ---- the pool */

TEST(test_pool) {
  char buffer[32] = "x";
  const struct expr *x = expr_sym(&pool, buffer);
  strcpy(buffer, "y");
  const struct expr *y = expr_sym(&pool, buffer);
  ck_assert_str_eq(x->name, "x");
  ck_assert(x != y && x == expr_sym(&pool, "x"));
  ck_assert(expr_num(&pool, "x") != x);
  ck_assert(expr_int(&pool, 12) == expr_num(&pool, "12"));
  ck_assert(expr_int(&pool, -12) == expr_op1(&pool, EXPR_NEG, expr_num(&pool, "12")));
  static const char *const apart[] = {"0.8", "0.80",   "x + y", "y + x", "x - y", "sin(x)", "cos(x)",
                                      "x^2", "x^(-2)", "f'(x)", "f(x)",  "g(x)",  "f(y)"};
  for (int i = 0; i < COUNT(apart) * COUNT(apart); i++) {
    const char *one = apart[i / COUNT(apart)], *other = apart[i % COUNT(apart)];
    ck_assert_msg((stripped(tree(one)) == stripped(tree(other))) == (one == other), "%s and %s", one, other);
  }

  /* LONG_MIN has no positive of its own */
  LOCAL(text, t);
  expr_print(&t, expr_int(&pool, LONG_MIN));
  snprintf(buffer, sizeof buffer, "%ld", LONG_MIN);
  ck_assert_str_eq(text_str(&t), buffer);

  /* growth keeps every node findable, and nodes that share a bucket apart */
  const size_t before = pool.n;
  const struct expr *made[5000][3];
  for (int round = 0; round < 2; round++)
    for (int i = 0; i < 5000; i++) {
      const char *name = formatted("v%d", i);
      const struct expr *e[] = {expr_sym(&pool, name), expr_call(&pool, "h", i, x), expr_pow(&pool, y, 10 + i)};
      for (int k = 0; k < 3; k++) {
        if (round == 0) made[i][k] = e[k];
        ck_assert_ptr_eq(e[k], made[i][k]);
      }
    }
  ck_assert_uint_eq(pool.n, before + 15000);
}

TABLE(substitutions, "tests/cases/substitutions.tsv", 2);
enum { TEXT, RESULT }; /* its columns */

TEST(test_subst) {
  const struct expr *x = expr_sym(&pool, "x"), *y = expr_sym(&pool, "y");
  const struct expr *by = expr_op2(&pool, EXPR_ADD, x, y);
  for (int i = 0; i < substitutions.n; i++) {
    char *const *row = substitutions.row[i];
    const struct expr *e = stripped(tree(row[TEXT]));
    ck_assert_msg(expr_subst(&pool, e, "x", by) == stripped(tree(row[RESULT])), "%s", row[TEXT]);
  }
  /* free of the symbol: the same pointer */
  const struct expr *e = stripped(tree("a*sin(b)"));
  ck_assert_ptr_eq(expr_subst(&pool, e, "x", by), e);
}

/* ---- derivatives */

/* The function f is f(u) = sin(2 u), so f^(n)(u) = 2^n sin(2 u + n pi/2). */
struct point {
  long double x, y;
};

static long double node_value(const struct expr *e, long double a, long double b, struct point p) {
  if (e->kind == EXPR_SYM) return !strcmp(e->name, "x") ? p.x : p.y;
  if (e->kind == EXPR_CALL) return ldexpl(sinl(2 * a + e->order * acosl(0)), e->order);
  return operation_value(e, a, b);
}

/* NaN as soon as any part exceeds `largest`: 1/(1/0) is not 0 here, and beside 1e48 a difference sees nothing. */
static long double value(const struct expr *e, struct point p, long double largest) {
  long double a = e->n_args > 0 ? value(e->args[0], p, largest) : 0;
  long double b = e->n_args > 1 ? value(e->args[1], p, largest) : 0;
  long double v = node_value(e, a, b, p);
  if (e->kind == EXPR_STUMPFF && a == 0 && largest < LDBL_MAX)
    return NAN; /* its derivative's form has no value there */
  return fabsl(v) <= largest && !isnan(a) && !isnan(b) ? v : NAN;
}

/* Central difference of fourth order. */
static long double quotient(const struct expr *e, struct point p, long double h) {
  long double v[5];
  for (int k = -2; k <= 2; k++) v[k + 2] = value(e, (struct point){p.x + k * h, p.y}, 1e6L);
  return (8 * (v[3] - v[1]) - (v[4] - v[0])) / (12 * h);
}

/* Compared only where two step sizes agree, which says nothing about the derivative under test. */
TEST(test_diff_random) {
  long compared = 0;
  for (uint64_t seed = 0; seed < 6000; seed++) {
    rng.state = seed;
    const struct expr *e = random_scalar(&pool, &rng, 1 + below(4), true);
    const struct expr *d = expr_diff(&pool, e, "x");
    const struct point p = {(1 + below(1000)) / 400.0L, (1 + below(1000)) / 400.0L};
    long double coarse = quotient(e, p, 1e-3L), fine = quotient(e, p, 5e-4L);
    long double scale = 1 + fabsl(fine);
    if (!(fabsl(coarse - fine) < 1e-8L * scale)) continue;
    compared++;
    long double got = value(d, p, LDBL_MAX);
    if (fabsl(got - fine) <= 1e-7L * scale) continue;
    struct text t = {0};
    expr_print(&t, e);
    text_add(&t, "  ->  ");
    expr_print(&t, d);
    ck_abort_msg("seed %lu, x = %Lg, y = %Lg: %Lg, not %Lg\n%s", (unsigned long)seed, p.x, p.y, got, fine,
                 text_str(&t));
  }
  ck_assert_int_gt(compared, 3000);
}

/* Tables of derivatives: text -> the known derivative, compared in value at several points. */
TEST(test_diff_table) {
  OWNED(table) table = table_read("tests/cases/derivatives.tsv", 2);
  for (int i = 0; i < table.n; i++) {
    const struct expr *d = expr_diff(&pool, stripped(tree(table.row[i][0])), "x"),
                      *known = stripped(tree(table.row[i][1]));
    for (int k = 1; k <= 5; k++) {
      const struct point p = {0.37L * k, 2.1L - 0.2L * k};
      long double want = value(known, p, LDBL_MAX), got = value(d, p, LDBL_MAX);
      ck_assert_msg(fabsl(got - want) < 1e-14L * (1 + fabsl(want)), "%s at %Lg: %Lg, not %Lg", table.row[i][0], p.x,
                    got, want);
    }
  }
}

TABLE(no_zeros, "tests/cases/no_zeros.tsv", 2);
enum { OF, IS }; /* its columns */

/* What is free of the symbol contributes nothing, not even a zero. */
TEST_EACH(test_diff_no_zeros, no_zeros.n) {
  char *const *row = no_zeros.row[_i];
  ck_assert_msg(expr_diff(&pool, stripped(tree(row[OF])), "x") == stripped(tree(row[IS])), "%s", row[OF]);
}

/* A DAG of n nodes that is a tree of 2^n, and a chain of depth n: linear cost, no recursion. */
TEST(test_deep) {
  const struct expr *wide = expr_sym(&pool, "x"), *deep = wide;
  for (int i = 0; i < 1000; i++) wide = expr_op2(&pool, i % 2 ? EXPR_MUL : EXPR_ADD, wide, wide);
  size_t before = pool.n;
  expr_diff(&pool, wide, "x");
  ck_assert_uint_lt(pool.n - before, 8 * 1000);
  before = pool.n;
  const struct expr *y = expr_sym(&pool, "y"), *swapped = expr_subst(&pool, wide, "x", y);
  ck_assert_uint_le(pool.n - before, 1001);
  ck_assert_ptr_eq(expr_subst(&pool, swapped, "y", expr_sym(&pool, "x")), wide);

  const int depth = 100000;
  for (int i = 0; i < depth; i++) deep = expr_op1(&pool, i % 2 ? EXPR_SIN : EXPR_COS, deep);
  before = pool.n;
  expr_diff(&pool, deep, "x");
  ck_assert_uint_lt(pool.n - before, 5 * (size_t)depth);
  OWNED(expr_pool) other = {.n = 0};
  const struct expr *twin = expr_sym(&other, "x");
  for (int i = 0; i < depth; i++) twin = expr_op1(&other, i % 2 ? EXPR_SIN : EXPR_COS, twin);
  ck_assert(expr_same(deep, twin) && !expr_same(deep, expr_op1(&other, EXPR_SIN, twin)));
  LOCAL(text, t);
  expr_print(&t, deep);
  ck_assert_uint_eq(t.len, (size_t)depth * strlen("sin()") + 1);
}
