/* The last line of verify. */
#include "finding.h"
#include "report.h"

static void add_line_counts(struct text *out, const struct audit_result *r, enum claimant of) {
  long count[N_VERDICTS], total = audit_result_count(count, r, of);
  text_printf(out, " %ld %s%s", total, of == OF_PAPER ? "statement" : "check", plural_s(total));
  const char *sep = ": ";
  for (int i = 0; i < N_VERDICTS; i++)
    if (count[i]) {
      text_printf(out, "%s%ld %s", sep, count[i], verdict_name[i]);
      sep = ", ";
    }
}

void report_line(struct text *out, const struct audit_result *r) {
  text_printf(out, "%s:", r->scene);
  bool checks = false, statements = false;
  for (size_t i = 0; i < r->n_findings; i++) *(r->findings[i].of == OF_SUITE ? &checks : &statements) = true;
  if (statements || !checks) add_line_counts(out, r, OF_PAPER);
  text_add(out, statements && checks ? ";" : "");
  if (checks) add_line_counts(out, r, OF_SUITE);
  if (r->n_values) text_printf(out, "; %zu values", r->n_values);
  if (r->n_controls) text_printf(out, "; %zu of %zu controls noticed", controls_noticed(r), r->n_controls);
  text_add(out, "; ");
  long bad = audit_result_unexpected(r);
  if (bad)
    text_printf(out, "%ld NOT as recorded", bad);
  else
    text_add(out, "as recorded");
}
