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
    struct text out;
    text_init(&out);
    write[i](&out, r);
    fuzz_law(out.len > 0, "a report says something");
    text_clear(&out);
  }
}

static void read_again(const struct audit_result *r) {
  struct audit_result again;
  struct text first, second;
  struct source s;
  struct diag d;
  diag_init(&d);
  text_init(&first);
  text_init(&second);
  audit_result_init(&again);
  report_json(&first, r);
  source_from_string(&s, "again", text_str(&first));
  fuzz_law(report_read(&again, &s, &d), "what is written can be read");
  report_json(&second, &again);
  fuzz_law(strcmp(text_str(&first), text_str(&second)) == 0, "and says the same");
  source_clear(&s);
  audit_result_clear(&again);
  text_clear(&second);
  text_clear(&first);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct source s;
  struct audit_result r;
  struct diag d;
  if (!fuzz_source(&s, data, size)) return 0;
  diag_init(&d);
  audit_result_init(&r);
  bool ok = report_read(&r, &s, &d);
  fuzz_law(ok != d.set, "a report is read, or there is a message");
  if (ok) {
    read_again(&r);
    write_all_reports(&r);
  }
  audit_result_clear(&r);
  source_clear(&s);
  return 0;
}
