/* The page and the files beside it.

   Second opinions: tests/oracle/page.py knows XML, HTML, MathML, CSV and JUnit and reads TeX by itself; browser.py
   tries the page in Chromium where that is installed; the MathML of single formulas is written here by hand, by the
   definitions of MathML Core and of TeX. */
#include <stdarg.h>
#include <sys/wait.h>

#include "report/escape.h"
#include "report/formula.h"
#include "report/report.h"
#include "report/sheet.h"
#include "test.h"
#include "traps.h"
#include "whole.h"

/* --- Formulas --- */

/* The first row of what a formula becomes, without the TeX behind it. */
static void set(struct text *out, const char *tex) {
  LOCAL(text, t);
  ck_assert_msg(formula_mathml(&t, tex, strlen(tex), NULL), "%s", tex);
  static const char head[] = "<math displaystyle=\"true\"><semantics>";
  const char *end = strstr(t.data, "<annotation encoding=\"application/x-tex\">");
  ck_assert_msg(strncmp(t.data, head, sizeof head - 1) == 0 && end, "%s", t.data);
  text_add_n(out, t.data + sizeof head - 1, (size_t)(end - t.data) - (sizeof head - 1));
}

TABLE(mathml, "tests/cases/mathml.tsv", 2);

TEST_EACH(formulas_are_set, mathml.n) {
  LOCAL(text, t);
  set(&t, mathml.row[_i][0]);
  ck_assert_str_eq(text_str(&t), mathml.row[_i][1]);
}

TEST(what_is_no_formula_is_shown_as_typed) {
  OWNED(table) cases = table_read("tests/cases/no_formulas.tsv", 1);
  for (int i = 0; i < cases.n; i++) {
    LOCAL(text, t);
    ck_assert_msg(!formula_mathml(&t, cases.row[i][0], strlen(cases.row[i][0]), NULL) && t.len == 0, "%s",
                  cases.row[i][0]);
    html_math(&t, cases.row[i][0], NULL);
    ck_assert_msg(strncmp(t.data, "<code class=\"raw\">", 18) == 0, "%s", t.data);
  }
}

/* As many levels as the checker allows, and one more. */
TEST(deep_formulas) {
  for (int depth = 62; depth < 66; depth++) {
    LOCAL(text, t);
    const char *tex = nested("{", "x", "}", (size_t)depth);
    ck_assert_int_eq(formula_mathml(&t, tex, strlen(tex), NULL), depth < 64);
  }
}

/* The TeX of each piece, with bars between. */
static void pieces(struct text *out, const char *tex) {
  LOCAL(text, t);
  formula_mathml(&t, tex, strlen(tex), NULL);
  for (const char *p = t.data; (p = strstr(p, "x-tex\">")) != NULL;) {
    p += 7;
    if (out->len) text_add(out, "|");
    text_add_n(out, p, (size_t)(strstr(p, "</annotation>") - p));
  }
}

TABLE(breaks, "tests/cases/formula_breaks.tsv", 2);
enum { TEX, PIECES }; /* its columns */

TEST_EACH(formulas_break_where_tex_would, breaks.n) {
  char *const *row = breaks.row[_i];
  LOCAL(text, t);
  pieces(&t, row[TEX]);
  ck_assert_str_eq(text_str(&t), row[PIECES]);
}

/* --- What differs --- */

/* The symbols that are marked: each from its mark to the next blank. */
static const char *marked(const char *tex, const bool *marks) {
  static char line[500];
  line[0] = '\0';
  for (size_t i = 0; tex[i]; i++)
    if (marks[i])
      snprintf(line + strlen(line), sizeof line - strlen(line), "%.*s;", (int)strcspn(tex + i, " "), tex + i);
  return line;
}

TEST(what_differs_is_marked) {
  enum { FIRST, SECOND, IN_FIRST, IN_SECOND };
  OWNED(table) cases = table_read("tests/cases/marks.tsv", 4);
  for (int i = 0; i < cases.n; i++) {
    bool a[100], b[100];
    formula_changes(a, cases.row[i][FIRST], b, cases.row[i][SECOND]);
    ck_assert_str_eq(marked(cases.row[i][FIRST], a), cases.row[i][IN_FIRST]);
    ck_assert_str_eq(marked(cases.row[i][SECOND], b), cases.row[i][IN_SECOND]);
  }
}

/* V in the matrix alone: its neighbours tell it from the other. */
TEST(marks_are_carried_to_the_quotation) {
  static const char text[] = "with V $V = 1, D = \\begin{pmatrix} I & V tI \\\\ 0 & I \\end{pmatrix}$ and $V t$";
  static const char a[] = "D = \\begin{pmatrix} I & V \\, t \\, I \\\\ 0 & I \\end{pmatrix}";
  static const char b[] = "D = \\begin{pmatrix} I & t \\, I \\\\ 0 & I \\end{pmatrix}";
  bool in_a[sizeof a], in_b[sizeof b], in_text[sizeof text];
  ck_assert(formula_changes(in_a, a, in_b, b));
  formula_changes_in_text(in_text, text, a, in_a);
  for (size_t i = 0; i + 1 < sizeof text; i++) ck_assert_int_eq(in_text[i], text + i == strstr(text, "V tI"));
  LOCAL(text, t);
  html_text(&t, text, in_text);
  ck_assert(strstr(t.data, "<mrow class=\"chg\"><mi>V</mi></mrow><mi>t</mi>"));
}

/* Two places that look alike: neither is marked. */
TEST(no_mark_where_the_place_is_not_clear) {
  static const char text[] = "$J_b y_b$ and $J_b y_b$", a[] = "J_b y_b", b[] = "J_b y_a";
  bool in_a[sizeof a], in_b[sizeof b], in_text[sizeof text];
  ck_assert(formula_changes(in_a, a, in_b, b));
  formula_changes_in_text(in_text, text, a, in_a);
  for (size_t i = 0; i + 1 < sizeof text; i++) ck_assert(!in_text[i]);
}

/* --- Pages --- */

static char *written(void (*writer)(struct text *, const struct audit_result *), const struct audit_result *r) {
  struct text t = {0};
  writer(&t, r);
  return t.data;
}

static void put(const char *name, void (*writer)(struct text *, const struct audit_result *),
                const struct audit_result *r) {
  FREED char *once = written(writer, r), *twice = written(writer, r);
  ck_assert_msg(strcmp(once, twice) == 0, "%s differs", name);
  scratch_put(name, once);
}

static void put_all(const struct audit_result *r) {
  put("audit.json", report_json, r);
  put("index.html", report_html, r);
  put("audit.csv", report_csv, r);
  put("junit.xml", report_junit, r);
  for (size_t i = 0; i < r->n_tables; i++) scratch_put(r->tables[i].name, r->tables[i].text);
}

CASE("page", .each = {scratch_open, scratch_close});

/* The paper's own report: every formula in it is set. */
TEST(the_papers_page) {
  OWNED(audit_result) r;
  whole_open();
  whole_record(&r);
  put_all(&r);
  shell_well("$Y tests/oracle/page.py $D 0");
  if (there_is("chromium")) shell_well("$Y tests/oracle/browser.py $D build/npm");
}

/* The words where no backslash stands before them. */
static const char *unescaped(const char *page, const char *words) {
  const char *s = strstr(page, words);
  while (s && s > page && s[-1] == '\\') s = strstr(s + 1, words);
  return s;
}

TEST(nothing_quoted_breaks_a_page) {
  OWNED(table) traps = table_read("tests/cases/traps_page.tsv", 1);
  OWNED(audit_result) r;
  traps_record(&r, &traps);
  put_all(&r);
  shell_well("$Y tests/oracle/page.py $D");
  static const char *const html[] = {"<script>", "<img ", "<b>", "<!", "<?", "</", "](", "<javascript:"};
  char *pages[] = {written(report_markdown, &r), written(report_errata, &r)};
  for (size_t i = 0; i < COUNT(html); i++)
    for (size_t k = 0; k < 2; k++)
      ck_assert_msg(!unescaped(pages[k], html[i]), "%s: %.300s", html[i], unescaped(pages[k], html[i]));
  for (size_t k = 0; k < 2; k++) free(pages[k]);
}

CASE("html");

/* Bytes that are no characters: the page has none of them. */
TEST(broken_bytes_are_replaced) {
  static const char *const bytes[] = {"\xff",         "\xc3",         "\xc3(",    "\xe2\x82",
                                      "\xf0\x9d\x92", "\xed\xa0\x80", "\xc0\xaf", "\x80"};
  for (size_t i = 0; i < COUNT(bytes); i++) {
    LOCAL(text, t);
    escape_html(&t, bytes[i], strlen(bytes[i]));
    ck_assert(strstr(t.data, "\xef\xbf\xbd") && text_valid_prefix(t.data, t.len) == t.len);
  }
}

CASE("page");

TEST(a_long_text_and_a_long_formula) {
  enum { LENGTH = 100000 };
  static char text[LENGTH + 1], formula[LENGTH + 3];
  memset(text, 'a', LENGTH);
  for (int i = 0; i < LENGTH; i++) formula[i + 1] = i % 2 ? '+' : 'x';
  formula[0] = formula[LENGTH + 1] = '$';
  char *rows[][MOST_COLUMNS] = {{text}, {formula}};
  OWNED(audit_result) r;
  traps_record(&r, &(struct table){.n = 2, .row = rows});
  r.findings[1].printed = r.findings[1].printed_part = text; /* too long to be compared */
  put_all(&r);
}

TEST(a_record_of_nothing) {
  struct audit_result r = {.scene = "s"};
  put_all(&r);
  shell_well("$Y tests/oracle/page.py $D");
}

/* --- A small record whose page can be told in advance --- */

static struct finding small_finding(const char *id, enum verdict v, enum verdict recorded) {
  return (struct finding){
      .id = id, .section = "model", .title = id, .verdict = v, .reproduce = "again", .recorded = recorded};
}

TEST(what_stands_where) {
  struct finding f[] = {
      small_finding("eq-1", VERDICT_PROVED, VERDICT_PROVED), small_finding("eq-2", VERDICT_CONDITIONAL, N_VERDICTS),
      small_finding("eq-3", VERDICT_UNKNOWN, VERDICT_PROVED), small_finding("text-4", VERDICT_REFUTED, VERDICT_REFUTED),
      small_finding("text-5", VERDICT_SKIPPED, N_VERDICTS)};
  f[1].condition = "V = 1";
  f[3].fault = "number";
  f[0].section = "appendix_a";
  const char *on[] = {"eq-1", "text-5"};
  f[2].depends_on = on, f[2].n_depends_on = 2;
  struct audit_result r = {.scene = "s", .findings = f, .n_findings = 5};
  FREED char *page = written(report_html, &r);
  check_order(page, "tests/cases/order_page.tsv");
  ck_assert(!strstr(page, "id=\"f-eq-1\"") && !strstr(page, "id=\"f-text-5\""));
}

/* The score is shown as it was counted, digits beside the precision, and none where there is no study or no
   residual. */
TEST(power_and_digits) {
  struct mutation_score score = {.counted = 1000,
                                 .noticed = 850,
                                 .formulas = 600,
                                 .equivalent = 90,
                                 .on_motions = 40,
                                 .needs_text = 20,
                                 .errata = 70};
  struct evidence e[] = {{.route = "balls", .layer = "l", .result = "agrees", .bits = 128, .residual = "1e-37"},
                         {.route = "fd", .layer = "l", .result = "agrees", .bits = 256, .residual = "1e-51"},
                         {.route = "ode", .layer = "l", .result = "agrees", .bits = -1, .residual = "1e-8"},
                         {.route = "gsl", .layer = "l", .result = "differs", .bits = 128, .residual = "1e0"}};
  struct finding f = small_finding("a", VERDICT_SUPPORTED, VERDICT_SUPPORTED);
  f.evidence = e;
  f.n_evidence = 4;
  struct audit_result r = {.scene = "s", .findings = &f, .n_findings = 1};
  FREED char *without = written(report_html, &r);
  r.mutation = &score;
  FREED char *with = written(report_html, &r);
  ck_assert(!strstr(without, "one symbol of a formula") && strstr(with, "1000 alterations that change a meaning") &&
            strstr(with, "<strong>850 were noticed"));
  ck_assert(strstr(with, "Not counted are 90 that") && strstr(with, "; 40 that") && strstr(with, "; 20 that only") &&
            strstr(with, "and 70 of the corrections"));
  ck_assert(strstr(with, ">37 of 38<") && strstr(with, ">51 of 77<") && !strstr(with, ">8 of ") &&
            !strstr(with, ">0 of "));
}

/* A route that only states or is undecided is no second one; definitions are not counted. */
TEST(claims_by_one_route) {
  struct evidence e[] = {{.route = "balls", .layer = "l", .result = "agrees", .bits = -1},
                         {.route = "exact", .layer = "l", .result = "states", .bits = -1},
                         {.route = "fd", .layer = "l", .result = "undecided", .bits = -1},
                         {.route = "balls", .layer = "l", .result = "differs", .bits = -1},
                         {.route = "exact", .layer = "l", .result = "proved", .bits = -1}};
  struct finding f[] = {
      small_finding("one", VERDICT_SUPPORTED, N_VERDICTS), small_finding("two", VERDICT_PROVED, N_VERDICTS),
      small_finding("three", VERDICT_PROVED, N_VERDICTS), small_finding("four", VERDICT_DEFINITION, N_VERDICTS)};
  f[0].evidence = f[3].evidence = e, f[0].n_evidence = f[3].n_evidence = 3;
  f[1].evidence = e + 3, f[1].n_evidence = 2;
  f[2].evidence = e + 4, f[2].n_evidence = 1;
  struct control_result c[] = {{"ctl", "two", VERDICT_REFUTED, true, NULL, NULL},
                               {"ctl-2", "two", VERDICT_REFUTED, true, NULL, NULL}};
  struct audit_result r = {.scene = "s", .findings = f, .n_findings = 4, .controls = c, .n_controls = 2};
  FREED char *page = written(report_html, &r);
  ck_assert(strstr(page, "1 of the 3 claims judged have a control of their own."));
  ck_assert(strstr(page, "or more decided 1 of the 3 claims judged, and one alone 2: balls (<a href=\"#c-one\">"));
  ck_assert(strstr(page, "; exact (<a href=\"#c-three\"><code>three</code></a>).</li>"));
}

/* The letter says from the record what was read, what is wrong beside what is right, which reading gives every number,
   each error with what it changes, which equations hold, where the solution is stable; then come the findings. */
TEST(the_letter) {
  struct named_value value[] = {{"printed", "5"}, {"value", "7.25"}};
  struct finding f[] = {
      small_finding("num-t_a", VERDICT_REFUTED, N_VERDICTS),  small_finding("num-t_b", VERDICT_REFUTED, N_VERDICTS),
      small_finding("eq-7", VERDICT_PROVED, N_VERDICTS),      small_finding("eq-8", VERDICT_PROVED, N_VERDICTS),
      small_finding("eq-9", VERDICT_CONDITIONAL, N_VERDICTS), small_finding("eq-10", VERDICT_PROVED, N_VERDICTS),
      small_finding("eq-9b", VERDICT_PROVED, N_VERDICTS),     small_finding("eq-31", VERDICT_REFUTED, N_VERDICTS),
      small_finding("first", VERDICT_DEFINITION, N_VERDICTS), small_finding("second", VERDICT_DEFINITION, N_VERDICTS)};
  static const char *const equation[] = {NULL, NULL, "7", "8", "9", "10", "9", "31", NULL, NULL};
  for (size_t i = 0; i < COUNT(f); i++) f[i].equation = equation[i];
  for (int i = 0; i < 2; i++) {
    f[i].fault = "number";
    f[i].correction = f[i].correction_latex = i ? "t = 8" : "t = 7";
    f[i].printed = i ? "t = 6" : "t = 5";
    f[i].root = "r-numbers";
  }
  f[0].certificate = (struct certificate){value, 2};
  f[1].certificate = (struct certificate){&(struct named_value){"printed", "6"}, 1};
  f[4].root = "r-formula", f[7].root = "r-slip";
  f[8].letter = "the fate is tr J = 3", f[9].letter = "the end is NEAR";
  const char *numbers[] = {"num-t_a", "num-t_b"}, *formula[] = {"eq-9"}, *slip[] = {"eq-31"};
  struct root_cause root[] = {
      {"r-numbers", "THE NUMBERS", SEVERITY_SUBSTANCE, "W1", "WRONG 1 of $a. b$. NOT THIS.", "RIGHT 1.", "SO 1.", NULL,
       numbers, 2},
      {"r-formula", "THE FORMULA", SEVERITY_SUBSTANCE, "PLACE", "WRONG 2. NOR THIS.", "RIGHT 2.", "SO 2.", NULL,
       formula, 1},
      {"r-slip", "THE SLIP", SEVERITY_NOTATION, "(8)", "WRONG 3.", "RIGHT 3.", "SO 3.", NULL, slip, 1}};
  struct reading_number number[] = {{"t_a", "5", "5.125", "rounded"}, {"e1", "2", "2", "input"}};
  struct reading_dropped dropped = {.equation = "THE EQUATION", .residual = "0.5"};
  const char *inputs[] = {"e1 = 2"};
  struct example_reading reading = {
      .inputs = inputs, .n_inputs = 1, .dropped = &dropped, .n_dropped = 1, .number = number, .n_numbers = 2};
  struct procedure_output output = {.name = "t_a", .within = "no"};
  struct readings readings = {
      .found = &reading, .n_found = 1, .procedure = {.inputs = "e1", .output = &output, .n_outputs = 1}};
  struct data_table along = {"along-e2.tsv",
                             "# x\nchange\te2\te2_to\ttrace\tperiod\tstable\tadmissible\n"
                             "-\t1\t-\t-1.5\t6\tno\tyes\nIT FLIPS\t1.25\t1.26\t-\t-\tyes\tyes\n"
                             "-\t2\t-\t-0.5\t6\tyes\tyes\nIT ENDS\t2.75\t2.76\t-\t-\tyes\tno\n"
                             "-\t3\t-\t-0.25\t6\tyes\tno\nIT IS GONE\t3.5\t3.6\t-\t-\t-\t-\n",
                             NULL};
  struct audit_result r = {.scene = "s",
                           .paper_text = "sha256 0",
                           .paper_source = "The text that was read is a machine conversion.",
                           .findings = f,
                           .n_findings = COUNT(f),
                           .roots = root,
                           .n_roots = 3,
                           .readings = &readings,
                           .tables = &along,
                           .n_tables = 1};
  FREED char *page = written(report_html, &r);
  check_order(page, "tests/cases/order_letter.tsv");
  ck_assert(!strstr(page, "SO 3") && !strstr(strstr(page, "r-slip\">"), "<article"));
}

/* A scene whose data are no example's in print: the data stand at the top of each text, nothing is addressed to the
   authors, and the picture names its orbit. */
TEST(other_data_are_no_letter) {
  struct data_table along = {
      "along-e2.tsv", "change\te2\te2_to\ttrace\tperiod\tstable\tadmissible\n-\t1\t-\t-1.5\t6\tno\tyes\n", "ORBIT 7"};
  struct audit_result r = {.scene = "s", .title = "", .data = "chi = 2/3, e2 = 1/4", .tables = &along, .n_tables = 1};
  char *page = written(report_html, &r), *md = written(report_markdown, &r), *sheet = written(report_errata, &r);
  ck_assert(strstr(page, "<title>Audit: s</title>") && strstr(page, "The picture shows ORBIT 7 for"));
  ck_assert(strstr(page, "with the other data of this scene,") && strstr(page, "scene, <var>\xcf\x87</var> = 2/3,"));
  ck_assert(!strstr(page, "uthors") && !strstr(page, "Letter") && !strstr(page, "data of the example"));
  ck_assert(strstr(
      md, "# Audit: s\n\nThe data, and any printed numbers, are those of this scene, chi = 2/3, e2 = 1/4, and not "));
  ck_assert(strstr(sheet, "# Errata\n\nThe data, and any printed numbers, are those of this scene, $\\chi$ = 2/3, "));
  free(page), free(md), free(sheet);
  r.data = along.orbit = NULL;
  page = written(report_html, &r);
  ck_assert(strstr(page, ">To the authors</h2>") &&
            strstr(page, "The picture shows the periodic solution nearest to the printed "));
  ck_assert(strstr(page, "with the other data of the example,") && !strstr(page, "this scene"));
  free(page);
}

TEST(junit_fails_where_the_record_differs) {
  struct finding f[] = {
      small_finding("a", VERDICT_PROVED, VERDICT_PROVED),   small_finding("b", VERDICT_REFUTED, VERDICT_REFUTED),
      small_finding("c", VERDICT_SKIPPED, VERDICT_SKIPPED), small_finding("d", VERDICT_PROVED, VERDICT_REFUTED),
      small_finding("e", VERDICT_SKIPPED, VERDICT_PROVED),  small_finding("f", VERDICT_UNKNOWN, N_VERDICTS)};
  struct control_result c[] = {{"ctl", "a", VERDICT_PROVED, false, NULL, NULL},
                               {"ctl-2", "a", VERDICT_REFUTED, true, NULL, NULL}};
  struct audit_result r = {.scene = "s", .findings = f, .n_findings = 6, .controls = c, .n_controls = 2};
  FREED char *xml = written(report_junit, &r);
  FREED char *want = file_text("tests/cases/junit.xml");
  ck_assert_str_eq(xml, want);
}

CASE("html");

/* Signs are set and what is quoted is left to be copied; what ends a sentence stays on the line of its formula. */
TEST(sentences_are_set) {
  enum { TEXT, HTML };
  OWNED(table) cases = table_read("tests/cases/sentences.tsv", 2);
  for (int i = 0; i < cases.n; i++) {
    LOCAL(text, t, seen);
    html_text(&t, cases.row[i][TEXT], NULL);
    for (const char *p = text_str(&t); *p; p++) { /* a formula of one letter, as that letter in capitals */
      const char *end = strncmp(p, "<math", 5) == 0 ? strstr(p, "</math>") : NULL,
                 *letter = end ? strstr(p, "<mi>") : NULL;
      text_add_char(&seen, letter ? (char)(letter[4] - 'a' + 'A') : *p);
      if (end) p = end + strlen("</math>") - 1;
    }
    ck_assert_str_eq(text_str(&seen), cases.row[i][HTML]);
  }
}

CASE("page");

TEST(csv_quotes) {
  struct finding f = small_finding("a", VERDICT_PROVED, N_VERDICTS);
  f.title = "say \"so\", twice\nand\x01";
  struct audit_result r = {.scene = "s", .findings = &f, .n_findings = 1};
  FREED char *csv = written(report_csv, &r);
  ck_assert_str_eq(
      strchr(csv, '\n') + 1,
      "\"a\",\"paper\",,\"model\",\"say \"\"so\"\", twice\nand \",\"proved\",,,\"substance\",,,,,,,,,,\"again\"\n");
}

/* A spreadsheet computes nothing, and numbers stay numbers. */
TEST(csv_is_no_formula) {
  OWNED(table) cells = table_read("tests/cases/csv.tsv", 2);
  for (int i = 0; i < cells.n; i++) {
    LOCAL(text, t);
    escape_csv(&t, cells.row[i][0]);
    ck_assert_str_eq(text_str(&t), cells.row[i][1]);
  }
}
