/* audit.json from any bytes, and every report from what is read.  Laws: refused with a message or read without one;
   what was read says the same when it is written and read again. */
#include "report/report.h"
#include "fuzz.h"

#include <string.h>

static void write_all_reports(const struct audit_result *r) {
  static void (*const write[])(struct text * out, const struct audit_result *r) = {
      report_markdown,   report_csv,  report_dot,   report_errata,
      report_errata_tex, report_html, report_junit, report_line};
  for (size_t i = 0; i < sizeof write / sizeof *write; i++) {
    LOCAL(text, out);
    write[i](&out, r);
    fuzz_law(out.len > 0, "a report says something");
  }
}

static void read_again(const struct audit_result *r) {
  LOCAL(audit_result, again);
  LOCAL(text, first, second);
  OWNED(source) s;
  struct diag d = {0};
  report_json(&first, r);
  source_from_string(&s, "again", text_str(&first));
  fuzz_law(report_read(&again, &s, &d), "what is written can be read");
  report_json(&second, &again);
  fuzz_law(strcmp(text_str(&first), text_str(&second)) == 0, "and says the same");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  OWNED(source) s = {.len = 0};
  LOCAL(audit_result, r);
  struct diag d = {0};
  if (!fuzz_source(&s, data, size)) return 0;
  bool ok = report_read(&r, &s, &d);
  fuzz_law(ok != d.set, "a report is read, or there is a message");
  if (ok) {
    read_again(&r);
    write_all_reports(&r);
  }
  return 0;
}
