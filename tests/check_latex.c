/* Formulas read from LaTeX: what each says is written beside it in the typed language by hand; what the library prints
   of any tree is read as that tree; records are held against their TeX. */
#include "expr/latex_read.h"
#include "model/model.h"
#include "test.h"

static struct arena arena;

static void setup(void) {
  scratch_open();
  arena_init(&arena);
}

static void teardown(void) {
  arena_clear(&arena);
  scratch_close();
}

/* --- Names --- */

static bool listed(const char *list, const char *name) {
  size_t n = strlen(name);
  for (const char *s = strstr(list, name); s; s = strstr(s + 1, name))
    if ((s == list || s[-1] == ' ') && (s[n] == ' ' || s[n] == '\0')) return true;
  return false;
}

static enum latex_name known(const void *context, const char *name) {
  (void)context;
  if (listed("H Gamma z_1 z_2 x_1 hbar B_1 Z z", name)) return LATEX_FUNCTION;
  return listed("chi eta omega omega_1 V t t_a t_b dt_a Z_0 dZ_0 z'_0 z_1b z'_1b u_r1 u_s1 u_1 u_2 u_s2 ktilde_1 "
                "gammatilde_2 "
                "M N H_11 K K_1 I lambda eps e_1 d_01 x y a b phi_2 J tau prime",
                name)
             ? LATEX_VALUE
             : LATEX_UNKNOWN;
}

static const struct latex_names names = {known, NULL};

/* --- Reading --- */

/* What the statements of some TeX are, printed and separated by "; ", or the first line of the message. */
static const char *reads(const char *tex) {
  struct diag d = {0};
  LOCAL(text, out);
  size_t n;
  OWNED(source) src = source_of("f", tex);
  struct latex_formula f = {.src = &src, .tex = {0, src.len}};
  const struct stmt **s = latex_statements(&n, &arena, &f, &names, &d);
  ck_assert((s != NULL) != d.set);
  for (size_t i = 0; i < n; i++) {
    text_add(&out, i > 0 ? "; " : "");
    stmt_print(&out, s[i]);
  }
  if (!s) text_add_n(&out, d.message, strcspn(d.message, "\n"));
  return arena_strndup(&arena, text_str(&out), out.len);
}

TABLE(said, "tests/cases/latex_said.tsv", 2);
enum { S_TEX, S_TYPED }; /* its columns */

CASE("latex", .each = {setup, teardown});

TEST_EACH(formulas_say_what_is_written_beside_them, said.n) {
  ck_assert_str_eq(reads(said.row[_i][S_TEX]), said.row[_i][S_TYPED]);
}

/* --- Hostile formulas --- */

TEST(hostile_formulas_get_one_clear_line) {
  static const char *const pieces[] = {"(", "\\frac{1}{", " a", "'"};
  for (size_t i = 0; i < COUNT(pieces); i++) {
    const char *says = reads(formatted("x = %s%s", i < 2 ? "" : "a", nested(pieces[i], "", "", 100000)));
    ck_assert_msg(strstr(says, "more than 5000 tokens") != NULL, "%s", says);
  }
  ck_assert_ptr_nonnull(
      strstr(reads(formatted("x = %s", nested("(", "", "", 2000))), "nested more than 200 levels deep"));
  ck_assert_ptr_nonnull(strstr(reads(formatted("x = %s", nested("\\cos ", "", "", 2000))), "a function of a function"));
  ck_assert_ptr_nonnull(strstr(reads(formatted("x = %s", nested("\\tilde{", "a", "", 150))), "is not closed"));
  /* 16 values of i and of k for each of them */
  ck_assert_ptr_nonnull(
      strstr(reads(nested("M_{ik} = 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1, ",
                          "(i, k = 1, \\dots, 9)", "", 50)),
             "a formula of more than 100000 nodes"));
}

/* --- What is printed is read --- */

static enum latex_name any(const void *context, const char *name) {
  const struct text *functions = context;
  return listed(text_str(functions), name) ? LATEX_FUNCTION : LATEX_VALUE;
}

static void collect_functions(struct text *out, const struct expr *e) {
  if (e->kind == EXPR_CALL) text_printf(out, "%s ", e->name);
  for (int i = 0; i < e->n_args; i++) collect_functions(out, e->args[i]);
}

/* One pair of parentheses is as good as none, and the inverse of a number is its power -1. */
static void print_plainly(struct text *out, const struct expr *e) {
  while (e->kind == EXPR_PAREN) e = e->args[0];
  bool inverse = e->kind == EXPR_INV || (e->kind == EXPR_POW && e->exponent == -1);
  text_printf(out, "<%d %s %d %d %d", inverse ? -1 : (int)e->kind, e->name ? e->name : "", e->order,
              inverse ? 0 : e->exponent, e->rows);
  for (int i = 0; i < 4; i++) text_printf(out, " %d", e->index[i]);
  for (int i = 0; i < e->n_args; i++) print_plainly(out, e->args[i]);
  text_add(out, ">");
}

static void read_what_is_printed(const struct expr *e) {
  LOCAL(text, functions, tex, before, after);
  struct diag d = {0};
  size_t n;
  collect_functions(&functions, e);
  text_add(&tex, "0 = ");
  expr_latex(&tex, e);
  OWNED(source) src = source_of("f", text_str(&tex));
  const struct latex_names all = {any, &functions};
  struct latex_formula f = {.src = &src, .tex = {0, src.len}};
  const struct stmt **s = latex_statements(&n, &arena, &f, &all, &d);
  ck_assert_msg(s && n == 1 && s[0]->n_sides == 2, "%s\n%s", text_str(&tex), d.message);
  print_plainly(&before, e);
  print_plainly(&after, s[0]->sides[1]);
  ck_assert_msg(strcmp(text_str(&before), text_str(&after)) == 0, "%s\nis %s\nread as %s", text_str(&tex),
                text_str(&before), text_str(&after));
}

TEST(every_formula_on_file_is_read_as_it_is_printed) {
  LOCAL(model, m);
  goes_well(model_load(&m, "verify", NULL, NULL, &d));
  int n = 0;
  for (size_t i = 0; i < m.n_records; i++)
    for (int k = 0; k < m.records[i].n_stmts; k++) {
      const struct stmt *s = m.records[i].stmts[k];
      for (int side = 0; s->kind != STMT_TRAJECTORY && side < s->n_sides; side++, n++)
        read_what_is_printed(s->sides[side]);
    }
  ck_assert_int_gt(n, 400);
}

/* --- Records and their TeX --- */

/* What the check of a file says: "" where nothing is wrong. */
static const char *record_says(const char *record) {
  LOCAL(model, m);
  struct diag d = {0};
  ck_assert_msg(model_add_file(&m, scratch_print("p.eq", "symbol chi\nsymbol t\n%s", record), RANK_PAPER, &d), "%s",
                d.message);
  ck_assert(model_check_tex(&m, RANK_PAPER, &d) != d.set);
  return d.set ? arena_strndup(&arena, d.message, strlen(d.message)) : "";
}

TABLE(records, "tests/cases/latex_records.tsv", 2);
enum { R_RECORD, R_SAYS }; /* its columns */

TEST_EACH(records_are_held_against_their_tex, records.n) {
  const char *says = record_says(records.row[_i][R_RECORD]);
  ck_assert_msg(*records.row[_i][R_SAYS] ? strstr(says, records.row[_i][R_SAYS]) != NULL : !*says, "%s", says);
}

/* Each reading is looked for in the whole formula. */
TEST(readings_are_bounded) {
  const char *reads = nested("  reads: t as t\n", "", "", 21);
  const char *says = record_says(formatted("equation eq-90\n  tex: chi = t\n%s  chi = t\n", reads));
  ck_assert_msg(strstr(says, "p.eq:25:10: error: more than 20 readings of a formula") != NULL, "%s", says);
}
