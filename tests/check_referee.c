/* A referee's scripts: every refuted or conditional statement of the audit is confirmed from its certificate by a
   script of at most 20 lines in tests/referee, written from the paper alone, and by none once it is damaged. */
#include "test.h"
#include "whole.h"

static char audit[300]; /* of the paper, which every case reads */

static void open_audit(void) {
  scratch_open();
  whole_open();
  snprintf(audit, sizeof audit, "%s", scratch_path("whole/paper/audit.json"));
}

static int confirm(const char *file, const char *options) {
  return shell("\"$Y\" tests/referee/confirm.py '%s' %s > \"$D/said\"", file, options);
}

/* An audit with the first occurrence of a text after an anchor replaced. */
static const char *changed(const char *file, const char *anchor, const char *old, const char *new) {
  char *json = file_text(file), *at = strstr(json, anchor);
  ck_assert_msg(at != NULL && (at = strstr(at, old)) != NULL, "no %s behind %s", old, anchor);
  LOCAL(text, t);
  text_add_n(&t, json, (size_t)(at - json));
  text_add(&t, new);
  text_add(&t, at + strlen(old));
  const char *path = scratch_put("changed.json", text_str(&t));
  free(json);
  return path;
}

CASE("referee", .once = {open_audit, scratch_close}, .seconds = 600);

TEST(every_failing_statement_is_confirmed) {
  int status = confirm(audit, "--damage");
  FREED char *said = file_text(scratch_path("said"));
  ck_assert_msg(status == 0, "%s", said);
}

TEST(what_has_no_script_or_is_damaged_fails) {
  const char *file = changed(audit, "\"id\": \"eq-40\"", "eq-40", "eq-999");
  file = changed(file, "\"id\": \"num-t_b\"", "\"value\": \"2.0053327", "\"value\": \"2.0053328");
  file = changed(file, "\"id\": \"text-time-name\"", "$t^*$ = time", "$t'$ = time");
  file = changed(file, "printed times the two lines", "-2.1959", "-2.1958");
  ck_assert_int_eq(confirm(file, ""), 1);
  check_says("said", "eq-999 is conditional and has no script");
  check_says("said", "num-t_b is not confirmed");
  check_says("said", "text-time-name is not confirmed");
  check_says("said", "the root example says -2.1958");
  check_says("said", " statements confirmed, 4 faults");
}
