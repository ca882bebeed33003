/* One JSON is the only truth: audit.json read back gives the same record, the record the same pages, and `stickslip
   report` the same files as verify; and what is wrong with a file is refused.

   The second opinion is the record itself, which is in memory before audit.json is: what is written from it must be
   what is written from what was read.  That no field is forgotten is counted: the bytes of the structures, as the
   compiler lays them out, against those that the tables of members cover. */
#include "claim/claims.h"
#include "claim/near.h"
#include "every.h"
#include "paper_model.h"
#include "report/audit_shape.h"
#include "report/report.h"
#include "run/audit.h"
#include "test.h"
#include "whole.h"

/* --- Written from memory, written from what was read --- */

static void (*const writers[])(struct text *out, const struct audit_result *r) = {
    report_json, report_markdown, report_csv, report_dot, report_errata, report_errata_tex, report_html, report_junit};

static bool read_text(struct audit_result *r, const char *json, struct diag *d) {
  diag_init(d);
  audit_result_init(r);
  OWNED(source) s = source_of("audit.json", json);
  return report_read(r, &s, d);
}

/* The record survives its JSON. */
static void same_again(const char *what, const struct audit_result *r) {
  LOCAL(text, json);
  OWNED(audit_result) again;
  struct diag d;
  report_json(&json, r);
  ck_assert_msg(read_text(&again, text_str(&json), &d), "%s: %s", what, d.message);
  ck_assert_uint_eq(again.n_tables, r->n_tables);
  for (size_t i = 0; i < r->n_tables; i++) again.tables[i].text = r->tables[i].text; /* as the files have it */
  for (int i = 0; i < COUNT(writers); i++) {
    LOCAL(text, first, second);
    writers[i](&first, r);
    writers[i](&second, &again);
    ck_assert_msg(strcmp(text_str(&first), text_str(&second)) == 0, "%s: report %d is another one", what, i);
  }
}

/* --- Audits --- */

static bool audit(struct audit_result *r, const char *name, const char *const *only, int n_only, int jobs) {
  struct diag d = {0};
  OWNED(scene) s;
  audit_result_init(r);
  struct audit_options opt = paper_options(only, n_only, jobs);
  opt.readings = n_only == 0;
  bool ok = scene_load_with(&s, name, "verify", NULL, SCENE_OF_ANY_SYSTEM, &d);
  if (ok && (s.system || !scene_papers_word(&s, &d))) return false; /* of another system or word nothing is claimed */
  if (s.asked.claims.n) opt.n_only = 0;                             /* the scene selects by itself */
  ok = ok && audit_run(r, &the_paper.model, &the_paper.claims, &the_paper.controls, &s, &opt, &d);
  ck_assert_msg(ok, "%s: %s", name, d.message);
  return true;
}

CASE("report", .each = {paper_open, paper_close});

/* The paper's whole audit, by this process alone: the bytes of the record and of the tables are those of the program,
   which shares the work among several. */
TEST(the_papers_record) {
  OWNED(audit_result) r;
  LOCAL(text, json);
  goes_well(near_controls_add(&the_paper.model, &the_paper.claims, &the_paper.controls, &d));
  audit(&r, "paper", NULL, 0, 1);
  ck_assert(r.readings && r.n_tables > 3 && r.n_consequences > 10);
  ck_assert(r.n_pairs && r.n_long_runs && r.n_independence);
  ck_assert_uint_eq(r.n_precision, 4); /* the scene asks for no values */
  for (size_t i = 0; i < r.n_precision; i++)
    ck_assert(r.precision[i].enough > 0 && r.precision[i].tried >= r.precision[i].enough);
  same_again("paper", &r);
  report_json(&json, &r);
  whole_open();
  FREED char *programs = file_text(scratch_path("whole/paper/audit.json"));
  ck_assert_msg(strcmp(text_str(&json), programs) == 0, "the program has another record");
  for (size_t i = 0; i < r.n_tables; i++) {
    const char *name = formatted("whole/paper/%s", r.tables[i].name);
    FREED char *table = file_text(scratch_path(name));
    ck_assert_msg(strcmp(table, r.tables[i].text) == 0, "the program has another %s", r.tables[i].name);
  }
}

/* Every scene on file, with claims of several kinds; what a scene asks for itself is asked for besides.  The last two,
   with their consequences, are dear, and in make check for each third and each twentieth scene. */
TEST(the_record_of_every_scene) {
  static const char *const only[] = {"text-time-name", "eq-48c", "eq-3", "eq-40"};
  LOCAL(arena, a);
  struct diag d = {0};
  size_t n;
  char **path = folder_files(&n, "verify/scenes", ".scene", &a, &d);
  ck_assert_msg(path && n > 20, "%s", d.message);
  for (size_t i = 0; i < n; i++) {
    OWNED(audit_result) r;
    int n_only = 2 + (i % (size_t)every(3) == 0) + (i % (size_t)every(20) == 0);
    if (audit(&r, path[i], only, n_only, 2)) same_again(path[i], &r);
  }
  free(path);
}

/* --- No field is forgotten --- */

static void cover(bool *seen, const struct shape *shape, size_t base) {
  for (int i = 0; i < shape->n; i++) {
    const struct member *m = &shape->member[i];
    size_t size = m->kind == MEMBER_LONG                             ? sizeof(long)
                  : m->kind == MEMBER_INT || m->kind == MEMBER_WORD  ? sizeof(int)
                  : m->kind == MEMBER_BOOL                           ? sizeof(bool)
                  : m->kind == MEMBER_TOLD || m->kind == MEMBER_PART ? 0
                  : m->most                                          ? (size_t)m->most * m->of->size
                                                                     : sizeof(void *);
    for (size_t k = 0; k < size; k++) seen[base + m->at + k] = true;
    if (m->kind == MEMBER_PART) cover(seen, m->of, base + m->at);
    bool list = m->kind == MEMBER_STRINGS || m->kind == MEMBER_RECORDS;
    for (size_t k = 0; list && k < (m->cap_at ? sizeof(size_t) : sizeof(int)); k++) seen[base + m->n_at + k] = true;
    for (size_t k = 0; list && m->cap_at && k < sizeof(size_t); k++) seen[base + m->cap_at + k] = true;
  }
}

static size_t uncovered(const struct shape *shape) {
  bool seen[4096] = {false};
  size_t n = 0;
  ck_assert_uint_lt(shape->size, sizeof seen);
  cover(seen, shape, 0);
  for (size_t i = 0; i < shape->size; i++) n += !seen[i];
  return n;
}

/* Of the records under a key: what is not in audit.json and why, with the padding that the ABI of 64-bit machines puts
   in. */
static size_t expected(const char *key) {
  static const struct {
    const char *key;
    size_t bytes;
  } left_out[] = {
      {"evidence", sizeof(double)},                    /* of one machine, for run.json */
      {"claims", 6 * 4},                               /* behind verdicts and counts */
      {"roots", 2 * 4},                                /* behind severity and the count */
      {"derived", 4},                                  /* before verdict */
      {"consequences", 3 * 4 + 4},                     /* behind each count */
      {"controls", 3},                                 /* at the end */
      {"routes", 7 + sizeof(double) + sizeof(char *)}, /* one machine's */
      {"long_runs", 6 + N_LONG_PAIRS * (sizeof(long) + 2 * sizeof(double)) + sizeof(double)}, /* likewise */
      {"tables", sizeof(char *)}, /* the text, which is the file's */
      {"found", 3 * 4},           /* behind counts */
      {"levels", 4},              /* before tried */
      {"outputs", 4},             /* at the end */
  };
  for (size_t i = 0; i < COUNT(left_out); i++)
    if (strcmp(left_out[i].key, key) == 0) return left_out[i].bytes;
  return 0;
}

static void count_shape(const char *key, const struct shape *shape, size_t bytes) {
  ck_assert_msg(uncovered(shape) == bytes, "%s: %zu bytes are not in audit.json, %zu are known", key, uncovered(shape),
                bytes);
  for (int i = 0; i < shape->n; i++) {
    const struct member *m = &shape->member[i];
    bool own = m->kind == MEMBER_RECORDS || (m->kind == MEMBER_RECORD && strcmp(m->key, "readings") != 0);
    if (own) count_shape(m->key, m->of, expected(m->key));
  }
}

TEST(every_field_is_in_the_tables) {
  if (sizeof(long) != 8 || sizeof(void *) != 8) return;
  /* arena, what the run took and its jobs (run.json), neighbours and their number, mutation, pages; padding behind jobs
     and n_independence */
  count_shape("the whole", &audit_shape,
              sizeof(struct arena) + sizeof(void *) + 2 * sizeof(size_t) + sizeof(int) + sizeof(void *) +
                  sizeof(size_t) + 2 * sizeof(void *) + 2 * 4);
  count_shape("readings", &readings_shape, 7 * 4); /* behind counts */
}

/* --- The command --- */

/* verify to $D/here, then report on its audit.json and tables in $D/there; the same neighbours beside both.  Of "paper"
   the whole audit is taken. */
static void same_files(const char *environment, const char *words) {
  shell_well("mkdir $D/there && cp -R reports/* $D && rm -r $D/paper");
  if (strcmp(words, "paper") == 0) {
    whole_open();
    shell_well("cp -R $D/whole/paper $D/here && cp $D/whole/said $D/said.here");
  } else {
    int status = shell("%s $P verify %s --quiet --out $D/here > $D/said.here", environment, words);
    ck_assert_msg(status == 0 || status == 1, "%s: %d", words, status);
  }
  shell_well("cd $D && cp here/audit.json there && { cp here/*.tsv there 2>/dev/null; true; } && p=$(cd \"$OLDPWD\" && "
             "realpath $P) && STICKSLIP_DATA=/nonexistent \"$p\" report there > said.there");
  int status = shell("cd $D && rm here/run.json && diff -r here there && tail -n 1 said.here > last && tail -n 1 "
                     "said.there | cmp - last");
  ck_assert_msg(status == 0, "%s: other files", words);
}

CASE("command", .each = {scratch_open, scratch_close});

TEST_EACH(the_same_files_from_the_json_alone, 6) {
  static const struct {
    const char *environment, *words;
  } of[] = {{"", "paper"},
            {"", "stable --only eq-27,eq-40,text-otherwise-unstable"},
            {"", "paper --set 'e2=[0.858, 0.859]' --only eq-3,text-periodic"},
            {"", "matrices --only eq-10"},
            {"", "none --only num-t_a"},
            {"STICKSLIP_DATA=tests/another", ""}};
  same_files(of[_i].environment, of[_i].words);
}

/* Without its neighbours the page alone says less; nothing else does. */
TEST(neighbours_are_shown_by_the_page_alone) {
  same_files("", "paper --only eq-48c");
  shell_well(
      "cd $D && grep -q '/mutation/mutation.md' there/index.html && grep -q '/bench/map.svg' there/index.html && "
      "printf '{' > mutation/mutation.json");
  shell_ends(0, "mutation.json:1:2: error: ", "$P report $D/there 2>&1 >/dev/null | grep '^stickslip: warning: '");
  shell_well("cd $D && rm -r mutation bench && realpath there > where");
  shell_well("$P report $D/there");
  shell_well("cd $D && ! grep -q '/mutation/\\|/bench/' there/index.html && "
             "[ \"$(diff -rq here there)\" = \"Files here/index.html and there/index.html differ\" ]");
}

/* --- What is no report --- */

/* Read, and then written whatever it says; or refused with a place. */
static bool survives(const char *json) {
  OWNED(audit_result) r;
  struct diag d;
  bool ok = read_text(&r, json, &d);
  ck_assert_msg(ok != d.set, "%.2000s", d.message);
  if (!ok) ck_assert_msg(strncmp(d.message, "audit.json:", 11) == 0, "%s", d.message);
  for (int i = 0; ok && i < COUNT(writers); i++) {
    LOCAL(text, out);
    writers[i](&out, &r);
  }
  return ok;
}

CASE("report");

TEST(cut_off_anywhere) {
  whole_open();
  FREED char *json = file_text(scratch_path("whole/paper/audit.json"));
  const size_t len = strlen(json), step = 997 * (size_t)every(10);
  ck_assert_uint_gt(len, 300000);
  json[len - 1] = '\0'; /* the newline behind the value may be missing */
  for (size_t at = (len - 2) / step * step;; at -= step) {
    json[at] = '\0';
    OWNED(audit_result) cut;
    struct diag d;
    ck_assert(!read_text(&cut, json, &d) && d.set);
    if (at == 0) break;
  }
}

struct places {
  size_t *at, n, cap;
};

static void list_places(struct places *p, const struct json_value *v) {
  *SS_PUSH(p->at, p->n, p->cap) = v->at;
  for (const struct json_value *m = v->first; m; m = m->next) list_places(p, m);
}

/* Where the value ends that begins there: the reader says so when the rest is something that follows. */
static size_t end_of_value(const char *text) {
  size_t depth = 0, i = 0;
  bool quoted = false;
  for (; text[i]; i++) {
    char c = text[i];
    if (quoted) {
      if (c == '\\') i++;
      if (c == '"') quoted = false;
      if (c != '"' || depth) continue;
      return i + 1;
    }
    if (strchr(",]}", c) && depth == 0) return i;
    if (c == '"') quoted = true;
    depth += c == '[' || c == '{';
    if (c == ']' || c == '}')
      if (--depth == 0) return i + 1;
  }
  return i;
}

TABLE(other, "tests/cases/json_values.tsv", 1);

/* Every value of a small report in turn is put out of its place by values of all types; in make check each by a
   part of them. */
TEST_EACH(types_exchanged_and_huge_numbers, 4) {
  LOCAL(text, json);
  LOCAL(arena, a);
  struct json_value root;
  struct places p = {.n = 0};
  FREED char *own = file_text("tests/fuzz/corpus/report/audit");
  text_add(&json, own);
  ck_assert(survives(json.data));
  OWNED(source) s = source_of("audit.json", json.data);
  goes_well(json_parse(&root, &a, &s, &d));
  list_places(&p, &root);
  ck_assert_uint_gt(p.n, 300);
  long refused = 0;
  for (size_t i = (size_t)(_i % every(3)); i < p.n; i += (size_t)every(3))
    for (size_t k = (size_t)_i; k < (size_t)other.n; k += 4) {
      LOCAL(text, t);
      text_add_n(&t, json.data, p.at[i]);
      text_add(&t, *other.row[k]);
      text_add(&t, json.data + p.at[i] + end_of_value(json.data + p.at[i]));
      refused += !survives(text_str(&t));
    }
  ck_assert_int_gt(refused, (long)p.n / every(3));
  free(p.at);
}

TABLE(said, "tests/cases/report_said.tsv", 3);
enum { FROM, TO, SAYS }; /* its columns */

/* Messages name the place. */
TEST_EACH(what_is_said, said.n) {
  char *const *row = said.row[_i];
  FREED char *own = file_text("tests/fuzz/corpus/report/audit");
  OWNED(audit_result) r;
  struct diag d;
  ck_assert(!read_text(&r, replaced(own, row[FROM], row[TO]), &d));
  ck_assert_msg(strstr(d.message, row[SAYS]) && strncmp(d.message, "audit.json:", 11) == 0, "%s: %s", row[TO],
                d.message);
}

/* More names than a graph can be drawn of. */
TEST(too_many_names) {
  OWNED(audit_result) again;
  LOCAL(text, json);
  enum { N = 2000 };
  static char name[N][16];
  static const char *on[N];
  for (int i = 0; i < N; i++) {
    snprintf(name[i], sizeof name[i], "t%d", i);
    on[i] = name[i];
  }
  struct finding f = {.id = "eq-1", .title = "t", .depends_on = on, .n_depends_on = N, .recorded = N_VERDICTS};
  struct audit_result r = {.scene = "s", .findings = &f, .n_findings = 1};
  report_json(&json, &r);
  fails_with(read_text(&again, text_str(&json), &d), "more than");
}
