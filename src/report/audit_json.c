/* audit.json and run.json from the result record. */
#include <math.h>

#include "audit_shape.h"
#include "report.h"

void report_json(struct text *out, const struct audit_result *r) {
  struct json j = {.out = out};
  shape_write(&j, NULL, &audit_shape, r);
}

/* --- run.json --- */

static void write_residuals(struct json *j, const struct audit_result *r) {
  JSON_EACH (j, "residuals", i, r->n_findings)
    for (int k = 0; k < r->findings[i].n_evidence; k++) {
      const struct evidence *e = &r->findings[i].evidence[k];
      if (isnan(e->machine_residual)) continue;
      JSON_OBJECT(j, NULL);
      json_string(j, "claim", r->findings[i].id);
      json_string(j, "route", e->route);
      json_double(j, "residual", "%.4g", e->machine_residual);
    }
}

static void write_pair_figures(struct json *j, const struct route_pair *p) {
  JSON_OBJECT(j, NULL);
  json_string(j, "quantity", p->quantity);
  json_string(j, "first", p->first);
  json_string(j, "second", p->second);
  json_double(j, "largest", "%.4g", p->machine_largest);
  json_string(j, "worst", p->machine_worst);
}

static void write_long_figures(struct json *j, const struct long_result *l) {
  static const char *const pair[N_LONG_PAIRS] = {"integration, closed form", "integration, mpfr", "closed form, mpfr"};
  JSON_OBJECT(j, NULL);
  json_string(j, "orbit", l->orbit);
  JSON_EACH (j, "pairs", i, N_LONG_PAIRS) {
    JSON_OBJECT(j, NULL);
    json_string(j, "routes", pair[i]);
    if (json_or_null(j, "apart_by_1e-6", l->machine_parting[i] != 0))
      json_long(j, "apart_by_1e-6", l->machine_parting[i]);
    json_double(j, "most", "%.4g", l->machine_most[i]);
    json_double(j, "growth", "%.4g", l->machine_growth[i]);
  }
  json_double(j, "growth_of_displacement", "%.4g", l->machine_displaced);
}

/* What each piece took, in the order of the report. */
static void write_spent(struct json *j, const struct audit_result *r) {
  unsigned long long units = 0;
  JSON_EACH (j, "pieces", i, r->n_spent) {
    const struct piece_spent *p = &r->spent[i];
    json_object(j, NULL);
    json_string(j, "what", p->what);
    json_string(j, "name", p->name);
    json_long(j, "units", (long)p->units);
    json_printf(j, "ms", "%.2f", p->machine_ms);
    json_end_object(j);
    units += p->units;
  }
  json_long(j, "units", (long)units);
}

void report_run(struct text *out, const struct audit_result *r, double seconds, const char *software) {
  OWNED(json) j = json_document(out, "stickslip-run-1");
  json_string(&j, "scene", r->scene);
  json_printf(&j, "seconds", "%.3f", seconds);
  json_string(&j, "software", software);
  json_long(&j, "jobs", r->jobs);
  write_spent(&j, r);
  write_residuals(&j, r);
  JSON_EACH (&j, "routes", i, r->n_pairs) write_pair_figures(&j, &r->pairs[i]);
  JSON_EACH (&j, "long_runs", i, r->n_long_runs) write_long_figures(&j, &r->long_runs[i]);
}
