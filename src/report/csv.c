/* audit.csv: a row for each claim, by RFC 4180 but for the ends of lines, which are plain. */
#include "escape.h"
#include "report.h"

static const char columns[] = "id,of,equation,section,title,verdict,recorded,root,severity,fault,condition,correction,"
                              "correction_verdict,effect,depends_on,routes,quote,printed,reproduce\n";

static void add_row(struct text *out, const struct finding *f) {
  struct text rests = {0}, routes = {0};
  for (int i = 0; i < f->n_depends_on; i++) text_printf(&rests, "%s%s", i ? " " : "", f->depends_on[i]);
  for (int i = 0; i < f->n_evidence; i++)
    text_printf(&routes, "%s%s %s", i ? "; " : "", f->evidence[i].route, f->evidence[i].result);
  const char *const field[] = {f->id,
                               claimant_name[f->of],
                               f->equation,
                               f->section,
                               f->title,
                               verdict_name[f->verdict],
                               f->recorded == N_VERDICTS ? NULL : verdict_name[f->recorded],
                               f->root,
                               f->severity < N_SEVERITIES ? severity_name[f->severity] : NULL,
                               f->fault,
                               f->condition,
                               f->correction,
                               f->correction ? verdict_name[f->correction_verdict] : NULL,
                               f->effect,
                               text_str(&rests),
                               text_str(&routes),
                               f->quote,
                               f->printed,
                               f->reproduce};
  for (size_t i = 0; i < sizeof field / sizeof *field; i++) {
    text_add(out, i ? "," : "");
    escape_csv(out, field[i]);
  }
  text_add_char(out, '\n');
  text_clear(&routes);
  text_clear(&rests);
}

void report_csv(struct text *out, const struct audit_result *r) {
  text_add(out, columns);
  for (size_t i = 0; i < r->n_findings; i++) add_row(out, &r->findings[i]);
}
