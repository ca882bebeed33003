/* The study of digits as JSON. */
#include <math.h>

#include "json_shape.h"
#include "stability.h"
#include "stability_words.h"

static void write_digits(struct json *j, const char *key, double x) {
  char buffer[32];
  json_string(j, key, stability_tenths(buffer, x));
}

static void write_cause(struct json *j, const struct stability_row *row) {
  json_string(j, "cause", loss_cause_says[row->cause]);
  json_string(j, "node", row->node);
  json_string(j, "source", row->source);
  json_string(j, "left", row->left);
  json_string(j, "right", row->right);
  write_digits(j, "node_grows", row->node_grows);
}

static void write_row(struct json *j, const struct stability_result *r, const struct stability_row *row) {
  char relative[32];
  JSON_OBJECT(j, NULL);
  json_string(j, "formula", r->formula[row->formula].id);
  json_string(j, "region", r->region[row->region].id);
  json_long(j, "points", row->points);
  json_long(j, "outside", row->outside);
  json_long(j, "undecided", row->undecided);
  json_long(j, "failures", row->failures);
  json_bool(j, "at_fault", row->at_fault);
  if (row->found) {
    write_digits(j, "log10_error", row->error);
    write_digits(j, "observed", row->observed);
    json_string(j, "relative_error", stability_relative_error(relative, row));
    json_bool(j, "sign_lost", row->sign_lost);
    write_digits(j, "problem", row->problem);
    write_digits(j, "formula_lost", row->formula_lost);
    write_digits(j, "excess", row->excess);
    write_digits(j, "predicted", r->formula[row->formula].kernel ? (double)NAN : row->predicted);
    write_cause(j, row);
    json_string(j, "witness", row->witness);
    write_digits(j, "after", row->after);
    write_digits(j, "gained", stability_gained(row));
    write_digits(j, "after_most", row->after_most);
    json_long(j, "after_failures", row->after_failures);
    json_long(j, "after_short", row->after_short);
    json_long(j, "after_rounded", row->after_rounded);
    json_string(j, "after_witness", row->after_witness);
    JSON_STRING(j, "command", stability_add_command(j->out, r, row, row->witness));
  }
  if (row->failure_witness) {
    json_string(j, "failure", loss_cause_says[row->failure]);
    json_string(j, "failure_node", row->failure_node);
    json_string(j, "failure_source", row->failure_source);
    write_digits(j, "failure_size", row->failure_size);
    json_string(j, "failure_witness", row->failure_witness);
    JSON_STRING(j, "failure_command", stability_add_command(j->out, r, row, row->failure_witness));
  }
}

static void tell_equation(struct json *j, const char *key, const void *record) {
  const struct stability_formula *f = record;
  json_string(j, key, *f->equation ? f->equation : NULL);
}

static SHAPE(formula, stability_formula, NULLABLE(stability_formula, id, also, record), TOLD("equation", tell_equation),
             NULLABLE(stability_formula, text), LONGS(stability_formula, points),
             NULLABLE(stability_formula, replacement), BOOLS(stability_formula, proved, kernel, zero));

static SHAPE(pair, stability_pair, NULLABLE(stability_pair, formula),
             LONGS(stability_pair, points, undecided, lost, differ), NULLABLE(stability_pair, region, witness));

static void write_confusion(struct json *j, const struct stability_result *r) {
  JSON_EACH (j, "confusion", a, N_LOSS_BINS) {
    JSON_OBJECT(j, NULL);
    json_string(j, "predicted", loss_bin_name[a]);
    JSON_EACH (j, "observed", b, N_LOSS_BINS) json_long(j, NULL, r->confusion[a][b]);
  }
}

void report_stability_json(struct text *out, const struct stability_result *r) {
  OWNED(json) j = json_document(out, "stickslip-stability-1");
  json_string(&j, "layer", r->layer);
  json_string(&j, "after", r->after);
  json_bool(&j, "quick", r->quick);
  json_string_array(&j, "bins", loss_bin_name, N_LOSS_BINS);
  write_confusion(&j, r);
  json_long(&j, "conditions", r->conditions);
  json_long(&j, "conditions_disputed", r->condition_differs);
  JSON_EACH (&j, "regions", i, r->n_regions) {
    JSON_OBJECT(&j, NULL);
    json_string(&j, "id", r->region[i].id);
    json_string(&j, "says", r->region[i].says);
    json_long(&j, "points", stability_region_points(r, i));
  }
  JSON_EACH (&j, "formulas", i, r->n_formulas) shape_write(&j, NULL, &formula, &r->formula[i]);
  JSON_EACH (&j, "pairs", i, r->n_pairs) shape_write(&j, NULL, &pair, &r->pair[i]);
  JSON_EACH (&j, "ledger", i, r->n_rows)
    if (r->row[i].at_fault) write_row(&j, r, &r->row[i]);
}
