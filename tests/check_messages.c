/* Every message is there to be read once.  Most are asked for here: of command lines and files, with short answers of
   commands too (tests/hostile/messages.tsv), and of claims that judging finds to be wrong (claims.tsv).
   tools/untested.py holds all messages of the program against what the tests reach. */
#include "judge/receipt.h"
#include "paper_model.h"
#include "run/plan.h"
#include "test.h"

/* --- Command lines and files --- */

static const char *const abbreviated[][2] = {{"report", "{\"schema\": \"stickslip-audit-2\", "}, {NULL, NULL}};

/* A refusal says why on standard error, in lines, and nothing on standard output. */
static void check_answer(int status, const char *out, const char *err, char *const *column) {
  const char *what = *column[0] ? column[0] : column[3];
  size_t len = strlen(err);
  ck_assert_msg(status == atoi(column[1]), "%s: ended with %d: %s", what, status, err);
  ck_assert_msg(len < 1000, "%s: %zu bytes: %s", what, len, err);
  if (status == 0) {
    check_said(formatted("%s%s", out, err), column[2], abbreviated, what);
    return;
  }
  check_said(err, column[2], abbreviated, what);
  ck_assert_msg(len > 0 && err[len - 1] == '\n' && (status == 5 || !*out), "%s: %s%s", what, err, out);
  check_caret(err, what);
}

static void try_command(char *const *column) {
  static const char *const name[] = {"audit.json", "file.claim",  "file.eq", "file.json",
                                     "file.scene", "file.system", "file.tsv"};
  LOCAL(text, file, command);
  field_expand(&file, column[4], abbreviated);
  for (size_t i = 0; i < COUNT(name); i++) scratch_put_n(name[i], text_str(&file), file.len);
  field_expand(&command, column[3], abbreviated);
  int status = shell("\"$P\" %s > \"$D/out\" 2> \"$D/err\"", text_str(&command));
  FREED char *out = file_text(scratch_path("out")), *err = file_text(scratch_path("err"));
  check_answer(status, out, err, column);
  ck_assert_str_eq(scratch_list(scratch_path("")),
                   "audit.json err file.claim file.eq file.json file.scene file.system file.tsv out");
}

CASE("words", .each = {scratch_open, scratch_close});

TEST(commands_answer_as_said) {
  OWNED(table) commands = table_read("tests/hostile/messages.tsv", 5);
  ck_assert_int_ge(commands.n, 500);
  for (int i = 0; i < commands.n; i++) try_command(commands.row[i]);
}

/* --- Claims --- */

static void add_lines(struct text *out, const char *lines) {
  for (const char *p = lines; *p; p++) {
    bool record = strncmp(p, "||", 2) == 0;
    text_add(out, record ? "\n" : *p == '|' ? "\n  " : (char[]){*p, '\0'});
    p += record;
  }
  text_add(out, "\n");
}

/* The paper's equations, with more records if there are any. */
static const struct model *model_with(struct model *own, const char *records) {
  LOCAL(text, text);
  if (!*records) return &the_paper.model;
  add_lines(&text, records);
  *own = paper_model(NULL);
  goes_well(model_add_file(own, scratch_put("own.eq", text_str(&text)), RANK_ERRATA, &d));
  return own;
}

static void refuse_claim(char *const *column) {
  OWNED(audit_result) r;
  struct model more;
  LOCAL(text, text);
  struct diag d;
  const char *what = *column[0] ? column[0] : column[2];
  const struct model *model = model_with(&more, column[3]);
  text_add(&text, *column[2] == '|' ? "claim own" : "claim own\n  title: of the test\n  ");
  add_lines(&text, column[2]);
  ck_assert_msg(!judge_text(&r, model, text_str(&text), &the_paper.scene, "own", &d), "%s: was judged", what);
  bool placed = strstr(d.message, "own.claim:") || strstr(d.message, "own.eq:") || strstr(column[1], ": error: ");
  ck_assert_msg(placed && strstr(d.message, column[1]) && strstr(d.message, "\n  "), "%s: says\n%s", what, d.message);
  if (model == &more) model_clear(&more);
}

CASE("claims", .each = {paper_open, paper_close});

TEST(claims_are_refused_as_said) {
  OWNED(table) claims = table_read("tests/hostile/claims.tsv", 4);
  for (int i = 0; i < claims.n; i++) refuse_claim(claims.row[i]);
}

TEST(a_control_of_no_claim) {
  OWNED(claims) own = {.n = 0};
  struct claims none = {.n = 0};
  LOCAL(audit_result, r);
  const char *path = scratch_put("own.claim", "control own\n  claim: nobody\n  title: of the test\n");
  goes_well(claims_add_file(&own, path, "control", &d));
  fails_with(audit_run(&r, &the_paper.model, &none, &own, &the_paper.scene, &(struct audit_options){.jobs = 1}, &d),
             "own.claim:2:10: error: own: a control names the claim that it damages");
}

/* (22) is worth two equations. */
TEST_EACH(a_receipt_of_another_rank, 2) {
  OWNED(claims) own = {.n = 0};
  LOCAL(text, out);
  const char *path = scratch_print("own.claim",
                                   "claim own\n  title: of the test\n  section: stability\n  kind: rank\n"
                                   "  statement: eq-22\n  unknowns: u, v\n  rank: %d\n",
                                   _i + 1);
  goes_well(claims_add_file(&own, path, "claim", &d));
  if (_i)
    goes_well(audit_receipt(&out, &the_paper.model, &own, &the_paper.scene, "own", "", &d));
  else
    fails_as(audit_receipt(&out, &the_paper.model, &own, &the_paper.scene, "own", "", &d),
             "error: own is not proved by exact algebra: the rank differs");
}

TEST(a_value_of_two_sections) {
  const char *set = "values=twice";
  const struct claims none = {.n = 0};
  LOCAL(audit_result, r);
  OWNED(scene) s;
  OWNED(model) own = paper_model(NULL);
  const char *path = scratch_put(
      "own.eq", "define first\n  section: one\n  twice := chi\ndefine second\n  section: two\n  twice := 2*chi\n");
  goes_well(model_add_file(&own, path, RANK_PAPER, &d));
  goes_well(scene_load_with(&s, "paper", "verify", &(struct scene_overrides){&set, 1, "--set"}, false, &d));
  goes_well(audit_run(&r, &own, &none, &none, &s, &(struct audit_options){.jobs = 1}, &d));
  const char *why = NULL;
  for (size_t i = 0; i < r.n_skipped; i++)
    if (strcmp(r.skipped[i].what, "the value of twice") == 0) why = r.skipped[i].why;
  ck_assert_msg(why && strcmp(why, "sections one and two define it differently") == 0, "%s", why ? why : "has a value");
}
