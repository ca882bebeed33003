/* The tables and pictures of stickslip plot: numbers against tests/oracle/pictures.py, which has its own equations of
   motion and reads the data of the other independent programs; what may come in; the same bytes twice. */
#include "every.h"
#include "mech/walk.h"
#include "paper_model.h"
#include "report/plot.h"
#include "report/report.h"
#include "run/tables.h"
#include "system.h"
#include "test.h"

/* Draws a scene into a folder of the scratch. */
static void plot(const char *scene, const char *to) {
  shell_well("\"$P\" plot %s --out \"$D/%s\" > \"$D/out\" 2> \"$D/err\"", scene, to);
}

/* The pictures that are asked for; that of the plane of e1 and e2 by so many processes. */
static void plot_asked(const char *to, int jobs) {
  plot("paper --along e2=0.5:3", to);
  plot("paper --animate", to);
  const char *words = formatted("paper --over e1=2.6844:2.8844:3 --over e2=0.5:3:%d --jobs %d", 26 / every(4), jobs);
  plot(words, to);
}

/* The paper's pictures, and those that are asked for, which all tests read. */
static void draw(void) {
  scratch_open();
  plot("paper", "paper");
  plot_asked("asked", 1);
}

CASE("pictures", .once = {draw, scratch_close});

TEST_EVERY(numbers_are_those_of_other_programs, 2, 5) {
  static const char *const scenes[] = {"paper", "above-one", "two-admissible", "long-slip", "four"};
  if (_i > 0) plot(scenes[_i], scenes[_i]);
  shell_well("\"$Y\" tests/oracle/pictures.py \"$D/%s\" %s", scenes[_i], scenes[_i]);
}

TEST(pictures_that_are_asked_for) {
  plot_asked("two", 2);
  shell_well("diff -r \"$D/asked\" \"$D/two\"");
  shell_well("\"$Y\" tests/oracle/pictures.py \"$D/asked\" paper asked");
}

TEST(the_same_bytes_twice) {
  plot("paper", "again");
  shell_well("diff -r \"$D/paper\" \"$D/again\"");
  ck_assert_str_eq(scratch_list(scratch_path("again")),
                   "along-e2.svg along-e2.tsv animation.svg animation.tsv differences.svg differences.tsv figure-3.svg "
                   "figure-3.tsv figure-4.svg figure-4.tsv long-run.svg long-run.tsv margins.svg margins.tsv "
                   "return-map.svg return-map.tsv");
}

/* A picture drawn again from nothing but the table's file is the one that was written. */
TEST(pictures_come_from_their_tables_alone) {
  plot("beside-wall", "one");
  shell_well("cp \"$D\"/paper/* \"$D/one\" && cp \"$D\"/asked/* \"$D/one\"");
  for (int i = 0; i < report_pictures(); i++) {
    LOCAL(text, again);
    const char *name = formatted("%s.tsv", report_picture_id(i));
    FREED char *table = file_text(scratch_path(formatted("one/%s", name)));
    FREED char *svg = file_text(scratch_path(formatted("one/%s.svg", report_picture_id(i))));
    struct data_table only = {name, table, NULL};
    const struct audit_result r = {.tables = &only, .n_tables = 1};
    ck_assert(report_picture(&again, &r, i));
    ck_assert_str_eq(text_str(&again), svg);
  }
}

/* A program that knows no custom properties passes over a declaration that asks for one: the same stands before it with
   a colour, everywhere in a picture. */
TEST_EACH(colours_without_custom_properties, 3) {
  static const char *const pictures[] = {"paper/figure-4.svg", "asked/animation.svg", "asked/stability-map.svg"};
  FREED char *svg = file_text(scratch_path(pictures[_i]));
  int asked = 0;
  for (char *at = strstr(svg, ": var("); at; at = strstr(at + 1, ": var("), asked++) {
    char *property = at;
    while (property[-1] != ' ' && property[-1] != '"') property--;
    const char *want = formatted("%.*s: #", (int)(at - property), property);
    char *before = property - 2;
    while (before[-1] != ';' && before[-1] != '{' && before[-1] != '"') before--;
    before += strspn(before, " ");
    ck_assert_msg(strncmp(before, want, strlen(want)) == 0, "%.60s", before);
  }
  ck_assert_int_gt(asked, 10);
}

/* No claim is judged by drawing: what the audit says of the closing gap (judge/closure.c) and what the figures show
   come from separate code. */
TEST(the_gap_is_that_of_the_claim) {
  static const char *const want[] = {"0.14009", "0.10977"}; /* arcs.tsv: end minus printed start, rounded */
  LOCAL(audit_result, r);
  OWNED(rows) t;
  OWNED(scene) s = scene_at("paper");
  ck_assert_ptr_null(audit_tables(&r, &s));
  ck_assert(rows_read(&t, &r, "figure-4.tsv"));
  size_t from = t.n, to = t.n;
  for (size_t i = 0; i < t.n; i++)
    if (rows_is(&t, i, 0, "printed") && rows_is(&t, i, 2, "O"))
      from = i;
    else if (rows_is(&t, i, 0, "printed") && rows_is(&t, i, 2, "d"))
      to = i;
  ck_assert(from < t.n && to < t.n);
  for (size_t k = 0; k < 2; k++) {
    const char *got = formatted("%.5f", rows_number(&t, to, 3 + 2 * k) - rows_number(&t, from, 3 + 2 * k));
    ck_assert_str_eq(got, want[k]);
  }
}

TABLE(bodies, "tests/cases/hostile_tables.tsv", 1);

/* Whatever stands in a table, a picture ends, and is well-formed. */
TEST(hostile_tables) {
  static const char *const tables[] = {"figure-3.tsv",     "figure-4.tsv",      "margins.tsv",  "return-map.tsv",
                                       "long-run.tsv",     "differences.tsv",   "along-e2.tsv", "phase-planes.tsv",
                                       "bifurcations.tsv", "stability-map.tsv", "animation.tsv"};
  LOCAL(text, all);
  text_add(&all, "<all>");
  for (int b = 0; b < bodies.n; b++)
    for (int k = 0; k < report_pictures(); k++) {
      struct data_table data[COUNT(tables)];
      for (int i = 0; i < COUNT(tables); i++) data[i] = (struct data_table){tables[i], *bodies.row[b], NULL};
      const struct audit_result r = {.tables = data, .n_tables = COUNT(tables)};
      LOCAL(text, one);
      report_picture(&one, &r, k);
      const char *svg = strstr(text_str(&one), "<svg");
      text_add(&all, svg ? svg : "");
    }
  text_add(&all, "</all>");
  shell_well("\"$Y\" -c 'import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])' %s",
             scratch_put_n("all.xml", all.data, all.len));
}

/* Each row of the table is a state of the motion that GSL integrates from the first one, but for rounding to six
   decimals; where a mass rebounds its velocity is that of either side. */
TEST_EACH(phase_planes_are_motions, 3) {
  static const char *const files[] = {"chain3", "beside-wall", "driven"};
  LOCAL(audit_result, r);
  OWNED(rows) t;
  OWNED(mech) m = system_on_file(files[_i]);
  OWNED(mech_orbits) list;
  mech_orbits_find(&list, &m, NULL, false, 128, NULL);
  const struct mech_orbit *o = &list.orbit[0];
  table_of_system(&r, &m, &list);
  ck_assert(rows_read(&t, &r, "phase-planes.tsv"));
  double start[MECH_STATES], last = 0;
  size_t n = (size_t)m.n, rows = 0, entries = 0;
  for (int i = 0; i < m.states; i++) start[i] = num_arb.get_d(o->state + i);
  for (size_t i = 0; i < t.n && rows_is(&t, i, 0, "orbit 1"); i++, rows++) {
    OWNED(mech_motion) z;
    struct mech_plan plan = {.duration = rows_number(&t, i, 3), .most = 1000, .phase = o->word.phase[0]};
    bool jumps = (i + 1 < t.n && rows_is(&t, i + 1, 2, "o")) || rows_is(&t, i, 2, "o");
    entries += rows_is(&t, i, 2, "o");
    last = plan.duration;
    ck_assert_int_eq(mech_simulate(&z, MECH_INTEGRATED, &m, start, &plan), SS_OK);
    for (size_t k = 0; k < 2 * n; k++)
      if (k < n || !jumps)
        ck_assert_msg(fabs(rows_number(&t, i, 4 + k % n * 2 + k / n) - z.z[k]) < 1e-5, "%s: row %zu, t = %g: %g",
                      files[_i], i, last, z.z[k]);
  }
  ck_assert(rows > 200 && (int)entries == o->word.n);
  ck_assert_double_eq_tol(last, num_arb.get_d(o->period), 1e-6);
  for (size_t i = 0; i < n; i++)
    ck_assert_double_eq(rows_number(&t, t.n - 3, 5 + 2 * i), fmpq_get_d(m.mass[i].surface));
  if (_i == 1) ck_assert_double_eq(rows_number(&t, t.n - 2, 6), 3.2);
}

TABLE(numbers, "tests/cases/table_numbers.tsv", 4);
enum { MIDDLE, EXPONENT, DECIMALS, WRITTEN }; /* its columns */

TEST_EACH(numbers_in_tables, numbers.n) {
  char *const *row = numbers.row[_i];
  LOCAL(text, t);
  NUMBERS(arb, x);
  arb_set_str(x, row[MIDDLE], 128);
  arb_add_error_2exp_si(x, atoi(row[EXPONENT]));
  table_number(&t, x, atoi(row[DECIMALS]));
  ck_assert_msg(strcmp(text_str(&t), row[WRITTEN]) == 0, "%s: %s", row[MIDDLE], text_str(&t));
}
