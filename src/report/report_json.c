/* audit.json and run.json from the result record. */
#include <math.h>
#include <stdio.h>

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

static void write_ids(struct json *j, const char *key, const struct id_list *list) {
  json_array(j, key);
  for (int i = 0; i < list->n; i++) json_string(j, NULL, list->id[i]);
  json_end_array(j);
}

static void write_derived(struct json *j, const struct derived *d) {
  json_object(j, NULL);
  json_string(j, "quantity", d->formula);
  json_string(j, "title", d->title);
  json_string(j, "verdict", d->verdict);
  if (d->change == CHANGE_CHANGES) {
    json_string(j, "size", d->size);
    json_string(j, "entry", d->entry);
    json_string(j, "printed", d->printed);
    json_string(j, "corrected", d->corrected);
    json_string(j, "all_printed", d->chain);
    json_string(j, "where", d->where);
  }
  json_end_object(j);
}

static void write_consequence(struct json *j, const struct consequence *q) {
  json_object(j, NULL);
  json_string(j, "failure", q->failure);
  write_ids(j, "falls", &q->falls);
  write_ids(j, "survives", &q->survives);
  write_ids(j, "undecided", &q->open);
  json_array(j, "derived");
  for (int i = 0; i < q->n_derived; i++) write_derived(j, &q->derived[i]);
  json_end_array(j);
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

static void write_pair(struct json *j, const struct route_pair *p) {
  json_object(j, NULL);
  json_string(j, "quantity", p->quantity);
  json_string(j, "first", p->first);
  json_string(j, "second", p->second);
  json_string(j, "shared", p->shared);
  json_long(j, "comparisons", p->comparisons);
  json_string(j, "stated", p->stated);
  json_bool(j, "within", p->within);
  json_string(j, "largest", p->largest);
  json_string(j, "worst", p->worst);
  json_end_object(j);
}

static void write_long_run(struct json *j, const struct long_result *l) {
  json_object(j, NULL);
  json_string(j, "orbit", l->orbit);
  json_string(j, "multiplier", l->multiplier);
  json_long(j, "periods", l->periods);
  json_string(j, "expected", l->expected);
  json_bool(j, "obeys", l->obeys);
  json_bool(j, "displaced", l->displaced);
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
  json_array(&j, "consequences");
  for (size_t i = 0; i < r->n_consequences; i++) write_consequence(&j, &r->consequences[i]);
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
  json_array(&j, "routes");
  for (size_t i = 0; i < r->n_pairs; i++) write_pair(&j, &r->pairs[i]);
  json_end_array(&j);
  json_array(&j, "long_runs");
  for (size_t i = 0; i < r->n_long_runs; i++) write_long_run(&j, &r->long_runs[i]);
  json_end_array(&j);
  report_readings_member(&j, "readings", r->readings);
  json_array(&j, "independence");
  for (int i = 0; i < r->n_independence; i++) json_string(&j, NULL, r->independence[i]);
  json_end_array(&j);
  json_end_object(&j);
}

/* --- run.json --- */

static void write_figure(struct json *j, const char *key, double x) {
  char s[32];
  snprintf(s, sizeof s, "%.4g", x);
  json_string(j, key, isnan(x) ? NULL : s);
}

static void write_residuals(struct json *j, const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++)
    for (int k = 0; k < r->findings[i].n_evidence; k++) {
      const struct evidence *e = &r->findings[i].evidence[k];
      if (isnan(e->machine_residual)) continue;
      json_object(j, NULL);
      json_string(j, "claim", r->findings[i].id);
      json_string(j, "route", e->route);
      write_figure(j, "residual", e->machine_residual);
      json_end_object(j);
    }
}

static void write_pair_figures(struct json *j, const struct route_pair *p) {
  json_object(j, NULL);
  json_string(j, "quantity", p->quantity);
  json_string(j, "first", p->first);
  json_string(j, "second", p->second);
  write_figure(j, "largest", p->machine_largest);
  json_string(j, "worst", p->machine_worst);
  json_end_object(j);
}

static void write_long_figures(struct json *j, const struct long_result *l) {
  static const char *const pair[N_LONG_PAIRS] = {"integration, closed form", "integration, mpfr", "closed form, mpfr"};
  json_object(j, NULL);
  json_string(j, "orbit", l->orbit);
  json_array(j, "pairs");
  for (int i = 0; i < N_LONG_PAIRS; i++) {
    json_object(j, NULL);
    json_string(j, "routes", pair[i]);
    if (l->machine_parting[i])
      json_long(j, "apart_by_1e-6", l->machine_parting[i]);
    else
      json_null(j, "apart_by_1e-6");
    write_figure(j, "most", l->machine_most[i]);
    write_figure(j, "growth", l->machine_growth[i]);
    json_end_object(j);
  }
  json_end_array(j);
  write_figure(j, "growth_of_displacement", l->machine_displaced);
  json_end_object(j);
}

void report_run(struct text *out, const struct audit_result *r, double seconds) {
  struct json j;
  char took[32];
  json_init(&j, out);
  json_object(&j, NULL);
  json_string(&j, "schema", "stickslip-run-1");
  json_string(&j, "scene", r->scene);
  snprintf(took, sizeof took, "%.3f", seconds);
  json_string(&j, "seconds", took);
  json_array(&j, "residuals");
  write_residuals(&j, r);
  json_end_array(&j);
  json_array(&j, "routes");
  for (size_t i = 0; i < r->n_pairs; i++) write_pair_figures(&j, &r->pairs[i]);
  json_end_array(&j);
  json_array(&j, "long_runs");
  for (size_t i = 0; i < r->n_long_runs; i++) write_long_figures(&j, &r->long_runs[i]);
  json_end_array(&j);
  json_end_object(&j);
}
