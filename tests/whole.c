#define _DEFAULT_SOURCE /* realpath, symlink */
#include "whole.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "report/report.h"
#include "says.h"
#include "scratch.h"

void whole_open(void) {
  const char *made = getenv("STICKSLIP_WHOLE");
  FREED char *real = made && *made ? realpath(made, NULL) : NULL;
  if (real)
    ck_assert_msg(symlink(real, scratch_path("whole")) == 0, "%s", real);
  else
    shell_well("sh tests/whole.sh \"$P\" \"$D/whole\"");
  FREED char *status = file_text(scratch_path("whole/status")), *errors = file_text(scratch_path("whole/errors"));
  ck_assert_msg(strcmp(status, "0\n") == 0 || strcmp(status, "1\n") == 0, "verify paper ends with %s%s", status,
                errors);
}

void whole_record(struct audit_result *r) {
  FREED char *json = file_text(scratch_path("whole/paper/audit.json"));
  audit_result_init(r);
  OWNED(source) s = source_of("audit.json", json);
  goes_well(report_read(r, &s, &d));
  for (size_t i = 0; i < r->n_tables; i++) {
    char name[100];
    snprintf(name, sizeof name, "whole/paper/%s", r->tables[i].name);
    FREED char *text = file_text(scratch_path(name));
    r->tables[i].text = arena_strndup(&r->arena, text, strlen(text));
  }
}

struct audit_result the_audit;

void audit_open(void) {
  paper_open();
  whole_open();
  whole_record(&the_audit);
}

void audit_close(void) {
  audit_result_clear(&the_audit);
  paper_close();
}
