/* Formulas read from LaTeX: what each says is written beside it in the typed language by hand; what the library prints
   of any tree is read as that tree; records are held against their TeX. */
#include <stdlib.h>
#include <string.h>

#include "expr/latex_read.h"
#include "model/model.h"
#include "scratch.h"
#include "suites.h"

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
  struct source src;
  struct diag d;
  struct text out;
  size_t n;
  diag_init(&d);
  text_init(&out);
  source_from_string(&src, "f", tex);
  struct latex_formula f = {.src = &src, .tex = {0, src.len}};
  const struct stmt **s = latex_statements(&n, &arena, &f, &names, &d);
  ck_assert((s != NULL) != d.set);
  for (size_t i = 0; i < n; i++) {
    text_add(&out, i > 0 ? "; " : "");
    stmt_print(&out, s[i]);
  }
  if (!s) text_add_n(&out, d.message, strcspn(d.message, "\n"));
  const char *copy = arena_strndup(&arena, text_str(&out), out.len);
  text_clear(&out);
  source_clear(&src);
  return copy;
}

static const struct {
  const char *tex, *typed;
} said[] = {
    {"x = \\frac{\\chi}{1 - \\chi}", "x = chi/(1 - chi)"},
    {"x = 2u_{r1} V t_a", "x = 2*u_r1*V*t_a"},
    {"K = \\begin{pmatrix} 1 & -\\chi \\\\ 0 & \\chi \\eta \\end{pmatrix}", "K = [1, -chi; 0, chi*eta]"},
    {"x = \\begin{pmatrix} (1 + a), & b \\end{pmatrix}", "x = [(1 + a), b]"},
    {"x &= y", "x = y"},
    {"\\begin{aligned} x &= y \\\\ &= \\chi, \\\\ \\text{i.e. } a &= b \\end{aligned}", "x = y = chi; a = b"},
    {"x = y i.e. a = b", "x = y; a = b"},
    {"K = H", "K = H(t)"},
    {"H(t - t_a)Z_0 = x", "H(t - t_a)*Z_0 = x"},
    {"V(t - t_a) = x", "V*(t - t_a) = x"},
    {"z'_1 < V, z_1''(t_b) \\le V", "z_1'(t) < V; z_1''(t_b) <= V"},
    {"z'_{1b} = \\bar{h}'(t)", "z'_1b = hbar'(t)"},
    {"\\tilde{k}_1 = \\tilde{\\gamma}_2", "ktilde_1 = gammatilde_2"},
    {"x = H'(t_b)Z_0 dt_a", "x = H'(t_b)*Z_0*dt_a"},
    {"x = (a, b)^t", "x = transpose([a, b])"},
    {"x = (a, b)'K", "x = transpose([a, b])*K"},
    {"x = (N - I)^{-1} K", "x = inv((N - I))*K"},
    {"x = -N^{-1}a", "x = -inv(N)*a"},
    {"M_{12} = M_{21}", "M[1,2] = M[2,1]"},
    {"H_{ij} = H_{ij}(t_b), (i, j = 1)", "H_11 = H(t_b)[1,1]"},
    {"K = N_{1:2,3:4}", "K = N[1:2,3:4]"},
    {"u_i = u_{si}, (i=1,2)", "u_1 = u_s1; u_2 = u_s2"},
    {"u_i = u_{si} \\quad x = y \\quad (i = 1, 2)", "u_1 = u_s1; u_2 = u_s2; x = y"},
    {"u_i = \\varepsilon u_{si} (i=1,2) (\\varepsilon = \\pm 1)",
     "u_1 = eps*u_s1 for eps in {+1, -1}; u_2 = eps*u_s2 for eps in {+1, -1}"},
    {"\\varphi_{k-1} = x, (k = 3)", "phi_2 = x"},
    {"z_i = x, (i = 1, \\dots, 2)", "z_1(t) = x; z_2(t) = x"},
    {"|x - y| < u_{r1}", "-u_r1 < x - y < u_r1"},
    {"x = |y|", "x = abs(y)"},
    {"x = \\sqrt{\\chi \\eta} \\cot(\\omega t) / \\omega", "x = sqrt(chi*eta)*cot(omega*t)/omega"},
    {"x = \\cos t \\sin^2(\\omega t)", "x = cos(t)*sin(omega*t)^2"},
    {"\\det(J - \\lambda I) = \\lambda(\\lambda - \\text{tr}(J))", "det(J - lambda*I) = lambda*(lambda - tr(J))"},
    {"x = \\omega_1^2 a", "x = omega_1^2*a"},
    {"e_1 < x = y < V, \\quad (e_1 = u_{r1} - u_{s1})", "e_1 < x = y < V; e_1 = u_r1 - u_s1"},
    {"x = ... y ... a = b", "x = y; a = b"},
    {"x = y \\quad (\\text{stick motion of } m_1)", "x = y"},
    {"0 < t < t_a ... x = y.", "0 < t < t_a; x = y"},
    {"Z = \\begin{pmatrix} z \\\\ z' \\end{pmatrix}", "Z(t) = [z(t); z'(t)]"},
    {"x = d_{01}", "x = d_01"},
    {"x \\equiv y \\ge a > b", "x = y >= a > b"},
    {"x = 3 \\cdot 4 \\times a", "x = 3*4*a"},
    {"x = t_{prime}", "f:1:5: error: in the TeX: t_prime is neither defined nor a symbol"},
    /* refused */
    {"x = q", "f:1:5: error: in the TeX: q is neither defined nor a symbol"},
    {"x = a / b a", "f:1:11: error: in the TeX: where the denominator of a / ends is doubtful: parentheses are needed"},
    {"x = \\cos \\omega t", "f:1:17: error: in the TeX: where the argument ends is doubtful: parentheses are needed"},
    {"x = (a + b)'",
     "f:1:12: error: in the TeX: what this prime means is not said: behind a row (a, b) it is the transpose"},
    {"x = (a, b)''",
     "f:1:12: error: in the TeX: what this prime means is not said: behind a row (a, b) it is the transpose"},
    {"x = t'", "f:1:5: error: in the TeX: t is no function, and a prime is read as a derivative"},
    {"x = z_i", "f:1:5: error: in the TeX: z_i is neither defined nor a symbol"},
    {"x = y, (i = 1, 2)",
     "f:1:8: error: in the TeX: these are the values of an index that no statement before them has"},
    {"x", "f:1:2: error: in the TeX: an expression alone says nothing: a statement is a relation"},
    {"x = ", "f:1:4: error: in the TeX: something is missing behind this"},
    {"x = y 2", "f:1:7: error: in the TeX: a number comes first in a product"},
    {"x = (a + b", "f:1:5: error: this bracket is not closed"},
    {"x = a)", "f:1:6: error: this closes no bracket"},
    {"x = \\begin{pmatrix} 1 & 0 \\\\ 1 \\end{pmatrix}",
     "f:1:37: error: in the TeX: row 2 has not the 2 entries of row 1"},
    {"x = \\begin{pmatrix} 1", "f:1:12: error: this bracket is not closed"},
    {"x = \\input{secret}", "f:1:5: error: \"\\input\" is not of the LaTeX that is read as a formula"},
    {"\\def\\x{\\x\\x} x = \\x", "f:1:1: error: \"\\def\" is not of the LaTeX that is read as a formula"},
    {"x \\neq y", "f:1:3: error: in the TeX: this does not go on a formula"},
    {"|x < y|", "f:1:4: error: in the TeX: the second bar is expected here"},
    {"x = x^{\\eta}", "f:1:8: error: in the TeX: an exponent is an integer, and ^t the transpose"},
    /* what would be swallowed or could be read in two ways */
    {"u_i = x, (i = 12)", "f:1:1: error: in the TeX: u_i is neither defined nor a symbol"},
    {"u_i = x, (i = 1 2)", "f:1:1: error: in the TeX: u_i is neither defined nor a symbol"},
    {"u_i = x, (i = 1, 2,)", "f:1:1: error: in the TeX: u_i is neither defined nor a symbol"},
    {"M_{ik} = x, (ik = 1, 2)", "f:1:1: error: in the TeX: M_ik is neither defined nor a symbol"},
    {"M_{ik} = x, (i, k = 1)", "M[1,1] = x"},
    {"M_{i-k} = x, (i, k = 1)", "f:1:6: error: in the TeX: a number is expected here"},
    {"z_i = x, (i = 1, \\circ, 2)", "f:1:1: error: in the TeX: z_i is neither defined nor a symbol"},
    {"z_i = x, (i = 2, 4, \\dots, 8)", "f:1:1: error: in the TeX: z_i is neither defined nor a symbol"},
    {"x = y (\\text{tr} K)", "x = y*(tr(K))"},
    {"x = y (\\text{if } a = b)", "x = y; a = b"},
    {"x = y (\\text{unless } a = b)", "f:1:14: error: in the TeX: \"unless \" does not stand here in a formula"},
    {"x = y^2 3", "f:1:9: error: in the TeX: a number comes first in a product"},
    {"x = y^12", "f:1:8: error: in the TeX: a number comes first in a product"},
    {"x = y^{12}", "x = y^12"},
    {"x = 1.2.3", "f:1:8: error: in the TeX: this does not go on a formula"},
    {"K^{\\mathsf{T} + 1} = x", "f:1:4: error: in the TeX: an exponent is an integer, and ^t the transpose"},
    {"K^{\\mathbf{2}} = x", "f:1:4: error: in the TeX: an exponent is an integer, and ^t the transpose"},
    {"K^{\\mathsf{T}} = x", "transpose(K) = x"},
    {"x = [y]_{O(a)^{\\ge 1}}", "f:1:16: error: in the TeX: brackets are read as [f]_{O(x, y)^{\\le 1}} alone"},
    {"x = \\begin{vmatrix} a & b \\\\ x & y \\end{vmatrix}", "f:1:12: error: in the TeX: {vmatrix} is no matrix"},
    {"x = {a + b} y", "f:1:8: error: in the TeX: \"}\" is expected here"},
    {"x = a {-b}", "f:1:8: error: in the TeX: \"-\" does not stand here in a formula"},
    {"x = \\cos t / \\omega", "f:1:12: error: in the TeX: where the argument ends is doubtful: parentheses are needed"},
    {"x = \\sin t \\cdot a", "f:1:12: error: in the TeX: where the argument ends is doubtful: parentheses are needed"},
    {" ", "f:1:1: error: the TeX is empty"},
    {"(\\text{so it is})", "f:1:1: error: the TeX states nothing"},
};

START_TEST(formulas_say_what_is_written_beside_them) {
  ck_assert_str_eq(reads(said[_i].tex), said[_i].typed);
}
END_TEST

/* --- Hostile formulas --- */

static const char *repeated(const char *first, const char *s, int n, const char *last) {
  struct text t;
  text_init(&t);
  text_add(&t, first);
  for (int i = 0; i < n; i++) text_add(&t, s);
  text_add(&t, last);
  const char *copy = arena_strndup(&arena, text_str(&t), t.len);
  text_clear(&t);
  return copy;
}

START_TEST(hostile_formulas_get_one_clear_line) {
  static const struct {
    const char *first, *piece, *says;
  } cases[] = {{"x = ", "(", "more than 5000 tokens"},
               {"x = ", "\\frac{1}{", "more than 5000 tokens"},
               {"x = a", " a", "more than 5000 tokens"},
               {"x = a", "'", "more than 5000 tokens"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *says = reads(repeated(cases[i].first, cases[i].piece, 100000, ""));
    ck_assert_msg(strstr(says, cases[i].says) != NULL, "%s", says);
  }
  ck_assert_ptr_nonnull(strstr(reads(repeated("x = ", "(", 2000, "")), "nested more than 200 levels deep"));
  ck_assert_ptr_nonnull(strstr(reads(repeated("x = ", "\\cos ", 2000, "")), "a function of a function"));
  ck_assert_ptr_nonnull(strstr(reads(repeated("x = ", "\\tilde{", 150, "a")), "is not closed"));
  /* 16 values of i and of k for each of them */
  ck_assert_ptr_nonnull(
      strstr(reads(repeated("", "M_{ik} = 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1, ", 50,
                            "(i, k = 1, \\dots, 9)")),
             "a formula of more than 100000 nodes"));
}
END_TEST

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
  struct text functions, tex, before, after;
  struct source src;
  struct diag d;
  size_t n;
  diag_init(&d);
  text_init(&functions);
  text_init(&tex);
  text_init(&before);
  text_init(&after);
  collect_functions(&functions, e);
  text_add(&tex, "0 = ");
  expr_latex(&tex, e);
  source_from_string(&src, "f", text_str(&tex));
  const struct latex_names all = {any, &functions};
  struct latex_formula f = {.src = &src, .tex = {0, src.len}};
  const struct stmt **s = latex_statements(&n, &arena, &f, &all, &d);
  ck_assert_msg(s && n == 1 && s[0]->n_sides == 2, "%s\n%s", text_str(&tex), d.message);
  print_plainly(&before, e);
  print_plainly(&after, s[0]->sides[1]);
  ck_assert_msg(strcmp(text_str(&before), text_str(&after)) == 0, "%s\nis %s\nread as %s", text_str(&tex),
                text_str(&before), text_str(&after));
  source_clear(&src);
  text_clear(&functions);
  text_clear(&tex);
  text_clear(&before);
  text_clear(&after);
}

static const char *data(void) {
  const char *folder = getenv("STICKSLIP_DATA");
  return folder && *folder ? folder : "verify";
}

START_TEST(every_formula_on_file_is_read_as_it_is_printed) {
  struct model m;
  struct diag d;
  diag_init(&d);
  model_init(&m);
  ck_assert_msg(model_load(&m, data(), NULL, NULL, &d), "%s", d.message);
  int n = 0;
  for (size_t i = 0; i < m.n_records; i++)
    for (int k = 0; k < m.records[i].n_stmts; k++) {
      const struct stmt *s = m.records[i].stmts[k];
      for (int side = 0; s->kind != STMT_TRAJECTORY && side < s->n_sides; side++, n++)
        read_what_is_printed(s->sides[side]);
    }
  ck_assert_int_gt(n, 400);
  model_clear(&m);
}
END_TEST

/* --- Records and their TeX --- */

/* What the check of a file says: "" where nothing is wrong. */
static const char *record_says(const char *record) {
  struct model m;
  struct diag d;
  struct text file;
  diag_init(&d);
  text_init(&file);
  text_printf(&file, "symbol chi\nsymbol t\n%s", record);
  model_init(&m);
  ck_assert_msg(model_add_file(&m, scratch_put("p.eq", text_str(&file)), RANK_PAPER, &d), "%s", d.message);
  ck_assert(model_check_tex(&m, RANK_PAPER, &d) != d.set);
  model_clear(&m);
  text_clear(&file);
  return d.set ? arena_strndup(&arena, d.message, strlen(d.message)) : "";
}

static const struct {
  const char *record, *says; /* "": they agree */
} records[] = {
    {"define eq-90\n  tex: K = \\frac{\\chi}{2}\n  K := chi/2\n", ""},
    {"define eq-90\n  tex: K = \\frac{\\chi}{3}\n  K := chi/2\n",
     "p.eq:5:12: error: eq-90: the formula is not what its TeX says: 2 here, 3 in the TeX at 4:24"},
    {"define eq-90\n  tex: K = -\\chi\n  K := chi\n", "chi here, -chi in the TeX at 4:12"},
    {"define eq-90\n  tex: K_1 = \\chi\n  K := chi\n", "error: in the TeX: K_1 is neither defined nor a symbol"},
    {"equation eq-90\n  tex: \\chi < t\n  chi <= t\n", "the relation is not that of the TeX: <= here, < in the TeX"},
    {"equation eq-90\n  tex: \\chi = t = 1\n  chi = t\n", "one chain goes on: shorter here, longer in the TeX"},
    {"equation eq-90\n  tex: \\chi = t, t = 1\n  chi = t\n", "error: eq-90: no formula of the record says this"},
    {"equation eq-90\n  tex: \\chi = t\n  chi = t\n  t = 1\n", "error: eq-90: the TeX does not say this"},
    {"equation eq-90\n  tex: \\chi^* = t\n  reads: \\chi^* as \\chi\n  chi = t\n", ""},
    {"equation eq-90\n  tex: \\chi = t\n  reads: \\eta as \\chi\n  chi = t\n",
     "what is read in another way does not stand in the TeX"},
    {"equation eq-90\n  tex: t = t\n  reads: t as \\chi\n  chi = t\n", "stands 2 times in the TeX"},
    {"equation eq-90\n  tex: t = t\n  reads: t\n  chi = t\n", "a reading is \"piece of the TeX as other TeX\""},
    {"define eq-90\n  tex: w^2 = \\chi\n  w := sqrt(chi)\n", ""},
    {"define eq-90\n  tex: w^2 = 2\\chi\n  w := sqrt(chi)\n", "chi here, 2*chi in the TeX"},
    {"define eq-90\n  tex: w^2 - \\chi = 0\n  root w: w^2 - chi, smallest positive\n", ""},
    {"define eq-90\n  tex: w^2 - \\chi = 1\n  root w: w^2 - chi, smallest positive\n", "0 here, 1 in the TeX"},
    {"define eq-90\n  tex: w = 0\n  w := [0; 0]\n", ""},
    {"define eq-90\n  tex: w = 0\n  w := [0; 1]\n", "[0; 1] here, 0 in the TeX"},
    {"define eq-90\n  tex: w = 1\n  w := [0; 0]\n", "[0; 0] here, 1 in the TeX"},
    {"define eq-90\n  tex: G = t \\chi\n  G(t) := t*chi\n", ""},
    {"define eq-90\n  tex: G = 2 t\n  G(chi) := 2*t\n", "chi here, t in the TeX"},
    {"define eq-90\n  tex: G(\\chi) = t \\chi\n  G(t) := t*chi\n", "t here, chi in the TeX"},
    {"inequality eq-90\n  tex: 0 < t < \\chi, t > 0\n  t > 0 for t in (0, chi)\n", ""},
    {"inequality eq-90\n  tex: 0 < t < 2\\chi, t > 0\n  t > 0 for t in (0, chi)\n", "chi here, 2*chi in the TeX"},
    {"inequality eq-90\n  tex: 0 < t < \\chi, t > 0\n  t > 0 for t in (0, chi]\n",
     "the range is not what the TeX says: ( ] here, ( ) in the TeX at 4:8"},
    {"inequality eq-90\n  tex: 0 \\le t < \\chi, t > 0\n  t > 0 for t in [0, chi)\n", ""},
    {"inequality eq-90\n  tex: 0 < t < \\chi, t > 0, t < 1\n  t > 0 for t in (0, chi)\n  t < 1\n",
     "p.eq:6:3: error: eq-90: the range is not what the TeX says: none here, t in the TeX at 4:8"},
    {"inequality eq-90\n  tex: 0 < t < 1, t > 0, 0 < t < \\chi, t < 1\n"
     "  t > 0 for t in (0, 1)\n  t < 1 for t in (0, 1)\n",
     "1 here, chi in the TeX"},
    {"inequality eq-90\n  tex: 0 < t < 1, t > 0, 0 < t < \\chi\n  t > 0 for t in (0, 1)\n",
     "error: eq-90: no formula of the record says this"},
    {"equation eq-90\n  tex: t=t=t=t=t=t=t=t=t=t=t=t=t=t=t=t\n  t=t=t=t=t=t=t=t=t=t=t=t=t=t=t=t=chi\n",
     "one chain goes on: longer here, shorter in the TeX"},
    {"define eq-90\n  tex: K = K_1{}\n  reads: K_1{} as N_{1:1,1:2}\n  K := N[1,1:2]\nsymbol N\n",
     "N[1,1:2] here, N[1:1,1:2] in the TeX"},
    /* digits of a reading and of what is printed are not one number */
    {"equation eq-90\n  tex: t = \\chi 2\n  reads: \\chi as 1\n  t = 1\n", "a number comes first in a product"},
    {"equation eq-90\n  tex: t = 12\n  reads: 2 as \\chi\n  t = 1*chi\n", ""},
    {"inequality eq-90\n  tex: t > 0\n  t > 0 for t in (0, chi)\n", "the range is not what the TeX says: t here, none"},
};

START_TEST(records_are_held_against_their_tex) {
  const char *says = record_says(records[_i].record);
  ck_assert_msg(*records[_i].says ? strstr(says, records[_i].says) != NULL : !*says, "%s", says);
}
END_TEST

/* Each reading is looked for in the whole formula. */
START_TEST(readings_are_bounded) {
  static const char head[] = "equation eq-90\n  tex: chi = t\n", reads[] = "  reads: t as t\n";
  const char *says = record_says(repeated(head, reads, 21, "  chi = t\n"));
  ck_assert_msg(strstr(says, "p.eq:25:10: error: more than 20 readings of a formula") != NULL, "%s", says);
}
END_TEST

Suite *latex_suite(void) {
  Suite *s = suite_create("latex");
  TCase *read = tcase_create("reading");
  tcase_add_checked_fixture(read, setup, teardown);
  tcase_add_loop_test(read, formulas_say_what_is_written_beside_them, 0, sizeof said / sizeof *said);
  tcase_add_test(read, hostile_formulas_get_one_clear_line);
  tcase_add_test(read, every_formula_on_file_is_read_as_it_is_printed);
  suite_add_tcase(s, read);
  TCase *held = tcase_create("records");
  tcase_add_checked_fixture(held, setup, teardown);
  tcase_add_loop_test(held, records_are_held_against_their_tex, 0, sizeof records / sizeof *records);
  tcase_add_test(held, readings_are_bounded);
  suite_add_tcase(s, held);
  return s;
}
