/* audit.csv: a row for each claim, by RFC 4180 but for the ends of lines, which are plain. */
#include "escape.h"
#include "report.h"

/* The columns: the name of each, and what a finding has there. */
#define COLUMNS(X)                                                                                                     \
  X(id, f->id)                                                                                                         \
  X(of, claimant_name[f->of])                                                                                          \
  X(equation, f->equation)                                                                                             \
  X(section, f->section)                                                                                               \
  X(title, f->title)                                                                                                   \
  X(verdict, verdict_name[f->verdict])                                                                                 \
  X(recorded, f->recorded == N_VERDICTS ? NULL : verdict_name[f->recorded])                                            \
  X(root, f->root)                                                                                                     \
  X(severity, f->severity < N_SEVERITIES ? severity_name[f->severity] : NULL)                                          \
  X(fault, f->fault)                                                                                                   \
  X(condition, f->condition)                                                                                           \
  X(correction, f->correction)                                                                                         \
  X(correction_verdict, f->correction ? verdict_name[f->correction_verdict] : NULL)                                    \
  X(effect, f->effect)                                                                                                 \
  X(depends_on, text_str(&rests))                                                                                      \
  X(routes, text_str(&routes))                                                                                         \
  X(quote, f->quote)                                                                                                   \
  X(printed, f->printed)                                                                                               \
  X(reproduce, f->reproduce)

static void add_row(struct text *out, const struct finding *f) {
  OWNED(text) rests = {0}, routes = {0};
  for (int i = 0; i < f->n_depends_on; i++) text_printf(&rests, "%s%s", i ? " " : "", f->depends_on[i]);
  for (int i = 0; i < f->n_evidence; i++)
    text_printf(&routes, "%s%s %s", i ? "; " : "", f->evidence[i].route, f->evidence[i].result);
#define VALUE(name, value) value,
  const char *const field[] = {COLUMNS(VALUE)};
#undef VALUE
  for (size_t i = 0; i < sizeof field / sizeof *field; i++) {
    text_add(out, i ? "," : "");
    escape_csv(out, field[i]);
  }
  text_add_char(out, '\n');
}

void report_csv(struct text *out, const struct audit_result *r) {
#define NAME(name, value) "," #name
  static const char names[] = COLUMNS(NAME) "\n";
#undef NAME
  text_add(out, names + 1);
  for (size_t i = 0; i < r->n_findings; i++) add_row(out, &r->findings[i]);
}
