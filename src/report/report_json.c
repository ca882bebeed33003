/* audit.json and run.json from the result record. */
#include <math.h>

#include "report_impl.h"

static void write_count(struct json *j, const char *key, long value) {
  if (value < 0)
    json_null(j, key);
  else
    json_long(j, key, value);
}

static void write_evidence(struct json *j, const struct evidence *e) {
  json_object(j, NULL);
  json_string(j, "route", e->route);
  json_string(j, "layer", e->layer);
  json_string(j, "result", e->result);
  json_string(j, "residual", e->residual);
  write_count(j, "bits", e->bits);
  write_count(j, "trials", e->trials);
  json_string(j, "worst", e->worst);
  json_string(j, "note", e->note);
  json_end_object(j);
}

static void write_claim(struct json *j, const struct finding *f) {
  json_object(j, NULL);
  json_string(j, "id", f->id);
  json_string(j, "equation", f->equation);
  json_string(j, "section", f->section);
  json_string(j, "title", f->title);
  json_string(j, "quote", f->quote);
  json_string(j, "printed", f->printed);
  json_string(j, "verdict", verdict_name[f->verdict]);
  json_string(j, "condition", f->condition);
  json_string(j, "fault", f->fault);
  if (f->correction) {
    json_object(j, "correction");
    json_string(j, "text", f->correction);
    json_string(j, "verdict", verdict_name[f->correction_verdict]);
    json_end_object(j);
  } else {
    json_null(j, "correction");
  }
  json_string(j, "effect", f->effect);
  json_array(j, "depends_on");
  for (int i = 0; i < f->n_depends_on; i++) json_string(j, NULL, f->depends_on[i]);
  json_end_array(j);
  json_array(j, "evidence");
  for (int i = 0; i < f->n_evidence; i++) write_evidence(j, &f->evidence[i]);
  json_end_array(j);
  json_string(j, "reproduce", f->reproduce);
  json_end_object(j);
}

static void write_summary(struct json *j, const struct audit_result *r) {
  long count[N_VERDICTS];
  audit_result_count(r, count);
  json_object(j, "summary");
  for (int i = 0; i < N_VERDICTS; i++) json_long(j, verdict_name[i], count[i]);
  json_long(j, "total", (long)r->n_findings);
  json_end_object(j);
}

void report_json(struct text *out, const struct audit_result *r) {
  struct json j;
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "schema", "stickslip-audit-1");
  json_string(&j, "scene", r->scene);
  write_summary(&j, r);
  json_array(&j, "claims");
  for (size_t i = 0; i < r->n_findings; i++) write_claim(&j, &r->findings[i]);
  json_end_array(&j);
  json_array(&j, "skipped");
  for (size_t i = 0; i < r->n_skipped; i++) {
    json_object(&j, NULL);
    json_string(&j, "what", r->skipped[i].what);
    json_string(&j, "why", r->skipped[i].why);
    json_end_object(&j);
  }
  json_end_array(&j);
  json_array(&j, "controls");
  for (size_t i = 0; i < r->n_controls; i++) {
    json_object(&j, NULL);
    json_string(&j, "id", r->controls[i].id);
    json_string(&j, "claim", r->controls[i].claim);
    json_string(&j, "verdict", verdict_name[r->controls[i].verdict]);
    json_bool(&j, "noticed", r->controls[i].noticed);
    json_end_object(&j);
  }
  json_end_array(&j);
  report_readings_member(&j, "readings", r->readings);
  json_array(&j, "independence");
  for (int i = 0; i < r->n_independence; i++) json_string(&j, NULL, r->independence[i]);
  json_end_array(&j);
  json_end_object(&j);
}

void report_run(struct text *out, const struct audit_result *r, double seconds) {
  struct json j;
  struct text t;
  text_init(&t);
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "schema", "stickslip-run-1");
  json_string(&j, "scene", r->scene);
  text_printf(&t, "%.3f", seconds);
  json_string(&j, "seconds", text_str(&t));
  json_array(&j, "residuals");
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_evidence; k++) {
      const struct evidence *e = &r->findings[i].evidence[k];
      if (isnan(e->machine_residual)) continue;
      text_reset(&t);
      text_printf(&t, "%.3g", e->machine_residual);
      json_object(&j, NULL);
      json_string(&j, "claim", r->findings[i].id);
      json_string(&j, "route", e->route);
      json_string(&j, "residual", text_str(&t));
      json_end_object(&j);
    }
  json_end_array(&j);
  json_end_object(&j);
  text_clear(&t);
}
