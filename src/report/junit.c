/* junit.xml, for what shows the results of tests: a case for each claim, which fails when the verdict differs from the
   one on record; cases for the controls, which fail when not noticed, and for routes that must agree. */
#include "finding.h"
#include "report.h"
#include "sheet.h"

static void begin_case(struct text *out, const char *suite, const char *group, const char *name, const char *title) {
  html_add(out, "    <testcase classname=\"stickslip.%e.%e\" name=\"%e%s%e\">", suite, group, name, title ? ": " : NULL,
           title);
}
static void end_case(struct text *out) {
  text_add(out, "</testcase>\n");
}

static void begin_suite(struct text *out, const char *name, size_t tests, size_t failures, size_t skipped) {
  text_printf(out, "  <testsuite name=\"%s\" tests=\"%zu\" failures=\"%zu\" errors=\"0\" skipped=\"%zu\">\n", name,
              tests, failures, skipped);
}
static void end_suite(struct text *out) {
  text_add(out, "  </testsuite>\n");
}

static bool is_skipped(const struct finding *f) {
  return f->verdict == VERDICT_SKIPPED && !finding_unexpected(f);
}

/* What a skipped claim says about itself. */
static const char *reason(const struct finding *f) {
  const char *why = f->n_evidence && f->evidence[0].note ? f->evidence[0].note : f->effect;
  return why ? why : "not possible in this scene";
}

static void add_claims(struct text *out, const struct audit_result *r) {
  size_t failed = 0, skipped = 0;
  for (size_t i = 0; i < r->n_findings; i++) {
    failed += finding_unexpected(&r->findings[i]);
    skipped += is_skipped(&r->findings[i]);
  }
  begin_suite(out, "claims", r->n_findings, failed, skipped);
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    begin_case(out, r->scene, f->section ? f->section : "claims", f->id, f->title);
    if (finding_unexpected(f))
      html_add(out, "<failure message=\"%s, recorded as %s\">%e</failure>", verdict_name[f->verdict],
               verdict_name[f->recorded], f->reproduce);
    else if (is_skipped(f))
      html_add(out, "<skipped message=\"%e\" />", reason(f));
    end_case(out);
  }
  end_suite(out);
}

static void add_controls(struct text *out, const struct audit_result *r) {
  begin_suite(out, "controls", r->n_controls, r->n_controls - controls_noticed(r), 0);
  for (size_t i = 0; i < r->n_controls; i++) {
    const struct control_result *c = &r->controls[i];
    begin_case(out, r->scene, "controls", c->id, NULL);
    if (!c->noticed) text_printf(out, "<failure message=\"%s, must be refuted\" />", verdict_name[c->verdict]);
    end_case(out);
  }
  end_suite(out);
}

static void add_routes(struct text *out, const struct audit_result *r) {
  size_t failed = 0;
  for (size_t i = 0; i < r->n_pairs; i++) failed += !r->pairs[i].within;
  for (size_t i = 0; i < r->n_long_runs; i++) failed += long_result_fails(&r->long_runs[i]);
  begin_suite(out, "routes", r->n_pairs + r->n_long_runs, failed, 0);
  for (size_t i = 0; i < r->n_pairs; i++) {
    const struct route_pair *p = &r->pairs[i];
    OWNED(text) name = {0};
    text_printf(&name, "%s, %s", p->first, p->second);
    begin_case(out, r->scene, "routes", p->quantity, text_str(&name));
    if (!p->within) html_add(out, "<failure message=\"beyond %e\" />", p->stated);
    end_case(out);
  }
  for (size_t i = 0; i < r->n_long_runs; i++) {
    const struct long_result *l = &r->long_runs[i];
    begin_case(out, r->scene, "long runs", l->orbit, NULL);
    if (long_result_fails(l)) text_add(out, "<failure message=\"not as the multiplier says\" />");
    end_case(out);
  }
  end_suite(out);
}

void report_junit(struct text *out, const struct audit_result *r) {
  html_add(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"%e\">\n", r->scene);
  add_claims(out, r);
  add_controls(out, r);
  add_routes(out, r);
  text_add(out, "</testsuites>\n");
}
