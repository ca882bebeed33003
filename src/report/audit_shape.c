/* The members of audit.json, as tables that its writer and its reader share.  What is not here is not in the file, and
   what is not in the file is on no page. */
#include <math.h>
#include <string.h>

#include "audit_shape.h"

#define VERDICT(k, type, name, need_) WORD_MEMBER(k, type, name, need_, verdict_name, N_VERDICTS)
#define STRINGS(k, type, name, count)                                                                                  \
  { .key = k, .kind = MEMBER_STRINGS, .at = offsetof(struct type, name), .n_at = offsetof(struct type, count) }
#define RECORDS(k, type, name, count, shape)                                                                           \
  {                                                                                                                    \
    .key = k, .kind = MEMBER_RECORDS, .at = offsetof(struct type, name), .n_at = offsetof(struct type, count),         \
    .of = shape                                                                                                        \
  }
/* An array of the result itself. */
#define LIST(k, name, need_, shape) RECORDS_OF(need_, k, audit_result, name, n_##name, cap_##name, shape)

/* --- Claims --- */

static const struct evidence no_evidence = {.bits = -1, .trials = -1, .machine_residual = (double)NAN};
static SHAPE_WITH(evidence, evidence, &no_evidence, NULL, NEEDED(evidence, route), NULLABLE(evidence, layer),
                  NEEDED(evidence, result), NULLABLE(evidence, residual),
                  MEMBER(MEMBER_LONG, MEMBER_NULLABLE, "bits", evidence, bits),
                  MEMBER(MEMBER_LONG, MEMBER_NULLABLE, "trials", evidence, trials), NULLABLE(evidence, worst, note));

static SHAPE(certified, named_value, NEEDED(named_value, name, value));

static SHAPE(correction, finding, MEMBER(MEMBER_STRING, MEMBER_NEEDED, "text", finding, correction),
             VERDICT("verdict", finding, correction_verdict, MEMBER_NEEDED));

static const struct finding no_finding = {.severity = N_SEVERITIES, .recorded = N_VERDICTS};
static SHAPE_WITH(finding, finding, &no_finding, NULL, NEEDED(finding, id), NULLABLE(finding, equation, section),
                  NEEDED(finding, title), NULLABLE(finding, quote, printed),
                  WORD_MEMBER("of", finding, of, MEMBER_NEEDED, claimant_name, N_CLAIMANTS), NULLABLE(finding, root),
                  WORD_MEMBER("severity", finding, severity, MEMBER_NULLABLE, severity_name, N_SEVERITIES),
                  VERDICT("verdict", finding, verdict, MEMBER_NEEDED), NULLABLE(finding, condition, fault),
                  {.key = "correction", .kind = MEMBER_PART, .need = MEMBER_NULLABLE, .of = &correction},
                  NULLABLE(finding, effect), STRINGS("depends_on", finding, depends_on, n_depends_on),
                  RECORDS("evidence", finding, evidence, n_evidence, &evidence),
                  {.key = "certificate",
                   .kind = MEMBER_RECORDS,
                   .need = MEMBER_SPARSE,
                   .at = offsetof(struct finding, certificate.at),
                   .n_at = offsetof(struct finding, certificate.n),
                   .of = &certified},
                  NULLABLE(finding, reproduce), VERDICT("recorded", finding, recorded, MEMBER_SPARSE),
                  SPARSE(finding, correction_recorded, quote_part, printed_part, correction_latex, change, size),
                  SPARSE(finding, letter));

/* --- Roots --- */

static SHAPE(root, root_cause, NEEDED(root_cause, id, title),
             WORD_MEMBER("severity", root_cause, severity, MEMBER_NEEDED, severity_name, N_SEVERITIES),
             NEEDED(root_cause, where, wrong, correct, consequence), NULLABLE(root_cause, by_hand),
             STRINGS("claims", root_cause, claims, n_claims));

/* --- Consequences --- */

static const char *const change_name[] = {[CHANGE_CHANGES] = "changes",
                                          [CHANGE_AGREES] = "agrees",
                                          [CHANGE_SAME_FORMULA] = "same formula",
                                          [CHANGE_UNDECIDED] = "undecided",
                                          [CHANGE_UNDEFINED] = "undefined"};
enum { N_CHANGES = sizeof change_name / sizeof *change_name };

static bool does_change(const void *record) {
  return ((const struct derived *)record)->change == CHANGE_CHANGES;
}

#define EXAMPLE(k, name, need_)                                                                                        \
  { .key = k, .kind = MEMBER_STRING, .need = need_, .at = offsetof(struct derived, name), .when = does_change }

static SHAPE(derived, derived, MEMBER(MEMBER_STRING, MEMBER_NEEDED, "quantity", derived, formula),
             NEEDED(derived, latex, title),
             WORD_MEMBER("change", derived, change, MEMBER_NEEDED, change_name, N_CHANGES), NEEDED(derived, verdict),
             EXAMPLE("size", size, MEMBER_NEEDED), EXAMPLE("entry", entry, MEMBER_NULLABLE),
             EXAMPLE("printed", printed, MEMBER_NEEDED), EXAMPLE("corrected", corrected, MEMBER_NEEDED),
             EXAMPLE("all_printed", chain, MEMBER_NULLABLE), EXAMPLE("where", where, MEMBER_NEEDED));

static SHAPE(consequence, consequence, NEEDED(consequence, failure), SPARSE(consequence, solved),
             STRINGS("falls", consequence, falls.id, falls.n),
             STRINGS("survives", consequence, survives.id, survives.n),
             STRINGS("undecided", consequence, open.id, open.n),
             RECORDS("derived", consequence, derived, n_derived, &derived));

/* --- What else there is in lists --- */

static SHAPE(skipped, skipped_work, NEEDED(skipped_work, what, why));

static SHAPE(value, asked_value, NEEDED(asked_value, name, at), NULLABLE(asked_value, value));

static SHAPE(precision, precision_use, NEEDED(precision_use, what), LONGS(precision_use, tried, enough));

static SHAPE(control, control_result, NEEDED(control_result, id), NULLABLE(control_result, claim),
             VERDICT("verdict", control_result, verdict, MEMBER_NEEDED), BOOLS(control_result, noticed),
             SPARSE(control_result, near, distance));

static SHAPE(pair, route_pair, NEEDED(route_pair, quantity, first, second, shared), LONGS(route_pair, comparisons),
             NEEDED(route_pair, stated), BOOLS(route_pair, within), NULLABLE(route_pair, largest, worst));

static SHAPE(long_run, long_result, NEEDED(long_result, orbit, multiplier), LONGS(long_result, periods),
             NEEDED(long_result, expected), BOOLS(long_result, obeys, displaced));

/* The file beside audit.json that holds the table: a plain name, which leads nowhere else. */
static const char *check_table(const void *record) {
  const struct data_table *t = record;
  size_t n = strlen(t->name), plain = strspn(t->name, "abcdefghijklmnopqrstuvwxyz0123456789-");
  bool fine = plain > 0 && n < 64 && strcmp(t->name + plain, ".tsv") == 0;
  return fine ? NULL : "the name of a table is letters, digits and hyphens, and .tsv";
}

static const struct data_table no_table = {.text = ""};
static SHAPE_WITH(table, data_table, &no_table, check_table, NEEDED(data_table, name), SPARSE(data_table, orbit));

/* --- Readings --- */

static SHAPE(slope, reading_slope, NEEDED(reading_slope, of, by, value));

static SHAPE(dropped, reading_dropped, NEEDED(reading_dropped, equation, residual));

static SHAPE(number, reading_number, NEEDED(reading_number, name, printed, value, how));

static SHAPE(shift, reading_shift, NEEDED(reading_shift, of, actual, predicted));

static SHAPE(reading, example_reading, NEEDED(example_reading, layer), NULLABLE(example_reading, confirmed),
             NEEDED(example_reading, carry), STRINGS("inputs", example_reading, inputs, n_inputs),
             STRINGS("solved", example_reading, solved, n_solved), SPARSE(example_reading, start),
             RECORDS("dropped", example_reading, dropped, n_dropped, &dropped), INTS(example_reading, assumptions),
             NEEDED(example_reading, assumed), INTS(example_reading, digits),
             RECORDS("numbers", example_reading, number, n_numbers, &number),
             RECORDS("slopes", example_reading, slope, n_slopes, &slope),
             MEMBER(MEMBER_INT, MEMBER_NULLABLE, "decimals", example_reading, decimals),
             RECORDS("shifts", example_reading, shift, n_shifts, &shift));

static SHAPE(level, readings_level, INTS(readings_level, dropped),
             LONGS(readings_level, tried, undetermined, reproduce, unrounded, open));

static SHAPE(inputs, readings_pair, NEEDED(readings_pair, inputs),
             MEMBER(MEMBER_INT, MEMBER_NEEDED, "given", readings_pair, n_given),
             MEMBER(MEMBER_INT, MEMBER_NEEDED, "numbers", readings_pair, n_numbers), NULLABLE(readings_pair, missed));

static SHAPE(output, procedure_output, NEEDED(procedure_output, name, printed, value),
             NULLABLE(procedure_output, low, high), NEEDED(procedure_output, within),
             MEMBER(MEMBER_INT, MEMBER_NULLABLE, "decimals", procedure_output, decimals));

static const char *check_procedure(const void *record) {
  const struct readings_procedure *p = record;
  return p->n_outputs && !p->inputs ? "a procedure with outputs has inputs" : NULL;
}

static SHAPE_WITH(procedure, readings_procedure, NULL, check_procedure, NULLABLE(readings_procedure, inputs),
                  RECORDS("outputs", readings_procedure, output, n_outputs, &output),
                  RECORDS("slopes", readings_procedure, slope, n_slopes, &slope));

enum { N_LEVELS = sizeof((struct readings *)NULL)->level / sizeof(struct readings_level) };

SHAPE(readings_shape, readings, STRINGS("conclusion", readings, conclusion, n_conclusions),
      STRINGS("space", readings, space, n_space),
      {.key = "levels",
       .kind = MEMBER_RECORDS,
       .at = offsetof(struct readings, level),
       .n_at = offsetof(struct readings, n_levels),
       .most = N_LEVELS,
       .of = &level},
      RECORDS("found", readings, found, n_found, &reading), RECORDS("pairs", readings, pair, n_pairs, &inputs),
      {.key = "procedure", .kind = MEMBER_PART, .at = offsetof(struct readings, procedure), .of = &procedure});

/* --- The whole --- */

static void tell_schema(struct json *j, const char *key, const void *record) {
  (void)record;
  json_string(j, key, AUDIT_SCHEMA);
}

static void tell_count(struct json *j, const char *key, const struct audit_result *r, enum claimant of) {
  long count[N_VERDICTS], total = audit_result_count(count, r, of);
  JSON_OBJECT(j, key);
  for (int i = 0; i < N_VERDICTS; i++) json_long(j, verdict_name[i], count[i]);
  json_long(j, "total", total);
}

static void tell_summary(struct json *j, const char *key, const void *record) {
  tell_count(j, key, record, OF_PAPER);
}

static void tell_checks(struct json *j, const char *key, const void *record) {
  tell_count(j, key, record, OF_SUITE);
}

SHAPE(audit_shape, audit_result, TOLD("schema", tell_schema), NEEDED(audit_result, scene),
      NULLABLE(audit_result, title), SPARSE(audit_result, data, paper, model, paper_text, paper_source, subject),
      TOLD("summary", tell_summary), TOLD("checks", tell_checks), LIST("roots", roots, MEMBER_NEEDED, &root),
      LIST("claims", findings, MEMBER_NEEDED, &finding),
      LIST("consequences", consequences, MEMBER_NEEDED, &consequence),
      LIST("skipped", skipped, MEMBER_NEEDED, &skipped), LIST("values", values, MEMBER_SPARSE, &value),
      LIST("precision", precision, MEMBER_SPARSE, &precision), LIST("controls", controls, MEMBER_NEEDED, &control),
      LIST("routes", pairs, MEMBER_NEEDED, &pair), LIST("long_runs", long_runs, MEMBER_NEEDED, &long_run),
      {.key = "readings",
       .kind = MEMBER_RECORD,
       .need = MEMBER_NULLABLE,
       .at = offsetof(struct audit_result, readings),
       .of = &readings_shape},
      STRINGS("independence", audit_result, independence, n_independence),
      LIST("tables", tables, MEMBER_NEEDED, &table));
