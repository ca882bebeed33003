/* audit.csv: a row for each claim, by RFC 4180 but for the ends of lines, which are plain. */
#include "escape.h"
#include "report.h"

static void add_field(struct text *out, const char *s, bool last) {
  escape_csv(out, s);
  text_add_char(out, last ? '\n' : ',');
}

static void add_dependences(struct text *out, const struct finding *f) {
  struct text list;
  text_init(&list);
  for (int i = 0; i < f->n_depends_on; i++) text_printf(&list, "%s%s", i ? " " : "", f->depends_on[i]);
  add_field(out, text_str(&list), false);
  text_clear(&list);
}

static void add_routes(struct text *out, const struct finding *f) {
  struct text list;
  text_init(&list);
  for (int i = 0; i < f->n_evidence; i++)
    text_printf(&list, "%s%s %s", i ? "; " : "", f->evidence[i].route, f->evidence[i].result);
  add_field(out, text_str(&list), false);
  text_clear(&list);
}

void report_csv(struct text *out, const struct audit_result *r) {
  text_add(out, "id,of,equation,section,title,verdict,recorded,root,severity,fault,condition,correction,correction_"
                "verdict,effect,"
                "depends_on,routes,quote,printed,reproduce\n");
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    add_field(out, f->id, false);
    add_field(out, claimant_name[f->of], false);
    add_field(out, f->equation, false);
    add_field(out, f->section, false);
    add_field(out, f->title, false);
    add_field(out, verdict_name[f->verdict], false);
    add_field(out, f->recorded == N_VERDICTS ? NULL : verdict_name[f->recorded], false);
    add_field(out, f->root, false);
    add_field(out, f->severity < N_SEVERITIES ? severity_name[f->severity] : NULL, false);
    add_field(out, f->fault, false);
    add_field(out, f->condition, false);
    add_field(out, f->correction, false);
    add_field(out, f->correction ? verdict_name[f->correction_verdict] : NULL, false);
    add_field(out, f->effect, false);
    add_dependences(out, f);
    add_routes(out, f);
    add_field(out, f->quote, false);
    add_field(out, f->printed, false);
    add_field(out, f->reproduce, true);
  }
}
