/* The members of audit.json, as tables that its writer and its reader share.  What is not here is not in the file, and
   what is not in the file is on no page. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "audit_shape.h"

#define STRING(type, name, need_)                                                                                      \
  { .key = #name, .kind = MEMBER_STRING, .need = need_, .at = offsetof(type, name) }
#define STRING_AS(k, type, name, need_)                                                                                \
  { .key = k, .kind = MEMBER_STRING, .need = need_, .at = offsetof(type, name) }
#define WHOLE(kind_, k, type, name, need_)                                                                             \
  { .key = k, .kind = kind_, .need = need_, .at = offsetof(type, name) }
#define BOOLEAN(type, name)                                                                                            \
  { .key = #name, .kind = MEMBER_BOOL, .at = offsetof(type, name) }
#define WORD(k, type, name, need_, words, n)                                                                           \
  { .key = k, .kind = MEMBER_WORD, .need = need_, .at = offsetof(type, name), .word = words, .n_words = n }
#define VERDICT(k, type, name, need_) WORD(k, type, name, need_, verdict_name, N_VERDICTS)
#define STRINGS(k, type, name, count)                                                                                  \
  { .key = k, .kind = MEMBER_STRINGS, .at = offsetof(type, name), .n_at = offsetof(type, count) }
#define RECORDS(k, type, name, count, shape)                                                                           \
  { .key = k, .kind = MEMBER_RECORDS, .at = offsetof(type, name), .n_at = offsetof(type, count), .of = shape }
/* An array of the result itself. */
#define LIST(k, name, need_, shape)                                                                                    \
  {                                                                                                                    \
    .key = k, .kind = MEMBER_RECORDS, .need = need_, .at = offsetof(struct audit_result, name),                        \
    .n_at = offsetof(struct audit_result, n_##name), .cap_at = offsetof(struct audit_result, cap_##name), .of = shape  \
  }
#define TOLD(k, how)                                                                                                   \
  { .key = k, .kind = MEMBER_TOLD, .tell = how }

/* --- Claims --- */

static const struct member evidence_member[] = {
    STRING(struct evidence, route, MEMBER_NEEDED),
    STRING(struct evidence, layer, MEMBER_NULLABLE),
    STRING(struct evidence, result, MEMBER_NEEDED),
    STRING(struct evidence, residual, MEMBER_NULLABLE),
    WHOLE(MEMBER_LONG, "bits", struct evidence, bits, MEMBER_NULLABLE),
    WHOLE(MEMBER_LONG, "trials", struct evidence, trials, MEMBER_NULLABLE),
    STRING(struct evidence, worst, MEMBER_NULLABLE),
    STRING(struct evidence, note, MEMBER_NULLABLE),
};
static const struct evidence no_evidence = {.bits = -1, .trials = -1, .machine_residual = (double)NAN};
static SHAPE(evidence, struct evidence, .blank = &no_evidence);

static const struct member certified_member[] = {
    STRING(struct named_value, name, MEMBER_NEEDED),
    STRING(struct named_value, value, MEMBER_NEEDED),
};
static SHAPE(certified, struct named_value, .blank = NULL);

static const struct member correction_member[] = {
    STRING_AS("text", struct finding, correction, MEMBER_NEEDED),
    VERDICT("verdict", struct finding, correction_verdict, MEMBER_NEEDED),
};
static SHAPE(correction, struct finding, .blank = NULL);

static const struct member finding_member[] = {
    STRING(struct finding, id, MEMBER_NEEDED),
    STRING(struct finding, equation, MEMBER_NULLABLE),
    STRING(struct finding, section, MEMBER_NULLABLE),
    STRING(struct finding, title, MEMBER_NEEDED),
    STRING(struct finding, quote, MEMBER_NULLABLE),
    STRING(struct finding, printed, MEMBER_NULLABLE),
    WORD("of", struct finding, of, MEMBER_NEEDED, claimant_name, N_CLAIMANTS),
    STRING(struct finding, root, MEMBER_NULLABLE),
    WORD("severity", struct finding, severity, MEMBER_NULLABLE, severity_name, N_SEVERITIES),
    VERDICT("verdict", struct finding, verdict, MEMBER_NEEDED),
    STRING(struct finding, condition, MEMBER_NULLABLE),
    STRING(struct finding, fault, MEMBER_NULLABLE),
    {.key = "correction", .kind = MEMBER_PART, .need = MEMBER_NULLABLE, .of = &correction},
    STRING(struct finding, effect, MEMBER_NULLABLE),
    STRINGS("depends_on", struct finding, depends_on, n_depends_on),
    RECORDS("evidence", struct finding, evidence, n_evidence, &evidence),
    {.key = "certificate",
     .kind = MEMBER_RECORDS,
     .need = MEMBER_SPARSE,
     .at = offsetof(struct finding, certificate.at),
     .n_at = offsetof(struct finding, certificate.n),
     .of = &certified},
    STRING(struct finding, reproduce, MEMBER_NULLABLE),
    VERDICT("recorded", struct finding, recorded, MEMBER_SPARSE),
    STRING(struct finding, correction_recorded, MEMBER_SPARSE),
    STRING(struct finding, quote_part, MEMBER_SPARSE),
    STRING(struct finding, printed_part, MEMBER_SPARSE),
    STRING(struct finding, correction_latex, MEMBER_SPARSE),
    STRING(struct finding, change, MEMBER_SPARSE),
    STRING(struct finding, size, MEMBER_SPARSE),
};
static const struct finding no_finding = {.severity = N_SEVERITIES, .recorded = N_VERDICTS};
static SHAPE(finding, struct finding, .blank = &no_finding);

/* --- Roots --- */

static const struct member root_member[] = {
    STRING(struct root_cause, id, MEMBER_NEEDED),
    STRING(struct root_cause, title, MEMBER_NEEDED),
    WORD("severity", struct root_cause, severity, MEMBER_NEEDED, severity_name, N_SEVERITIES),
    STRING(struct root_cause, where, MEMBER_NEEDED),
    STRING(struct root_cause, wrong, MEMBER_NEEDED),
    STRING(struct root_cause, correct, MEMBER_NEEDED),
    STRING(struct root_cause, consequence, MEMBER_NEEDED),
    STRING(struct root_cause, by_hand, MEMBER_NULLABLE),
    STRINGS("claims", struct root_cause, claims, n_claims),
};
static SHAPE(root, struct root_cause, .blank = NULL);

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

static const struct member derived_member[] = {
    STRING_AS("quantity", struct derived, formula, MEMBER_NEEDED),
    STRING(struct derived, latex, MEMBER_NEEDED),
    STRING(struct derived, title, MEMBER_NEEDED),
    WORD("change", struct derived, change, MEMBER_NEEDED, change_name, N_CHANGES),
    STRING(struct derived, verdict, MEMBER_NEEDED),
    EXAMPLE("size", size, MEMBER_NEEDED),
    EXAMPLE("entry", entry, MEMBER_NULLABLE),
    EXAMPLE("printed", printed, MEMBER_NEEDED),
    EXAMPLE("corrected", corrected, MEMBER_NEEDED),
    EXAMPLE("all_printed", chain, MEMBER_NULLABLE),
    EXAMPLE("where", where, MEMBER_NEEDED),
};
static SHAPE(derived, struct derived, .blank = NULL);

static const struct member consequence_member[] = {
    STRING(struct consequence, failure, MEMBER_NEEDED),
    STRING(struct consequence, solved, MEMBER_SPARSE),
    STRINGS("falls", struct consequence, falls.id, falls.n),
    STRINGS("survives", struct consequence, survives.id, survives.n),
    STRINGS("undecided", struct consequence, open.id, open.n),
    RECORDS("derived", struct consequence, derived, n_derived, &derived),
};
static SHAPE(consequence, struct consequence, .blank = NULL);

/* --- What else there is in lists --- */

static const struct member skipped_member[] = {
    STRING(struct skipped_work, what, MEMBER_NEEDED),
    STRING(struct skipped_work, why, MEMBER_NEEDED),
};
static SHAPE(skipped, struct skipped_work, .blank = NULL);

static const struct member value_member[] = {
    STRING(struct asked_value, name, MEMBER_NEEDED),
    STRING(struct asked_value, at, MEMBER_NEEDED),
    STRING(struct asked_value, value, MEMBER_NULLABLE),
};
static SHAPE(value, struct asked_value, .blank = NULL);

static const struct member precision_shape_member[] = {
    STRING(struct precision_use, what, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "tried", struct precision_use, tried, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "enough", struct precision_use, enough, MEMBER_NEEDED),
};
SHAPE(precision_shape, struct precision_use, .blank = NULL);

static const struct member control_member[] = {
    STRING(struct control_result, id, MEMBER_NEEDED),
    STRING(struct control_result, claim, MEMBER_NULLABLE),
    VERDICT("verdict", struct control_result, verdict, MEMBER_NEEDED),
    BOOLEAN(struct control_result, noticed),
    STRING(struct control_result, near, MEMBER_SPARSE),
    STRING(struct control_result, distance, MEMBER_SPARSE),
};
static SHAPE(control, struct control_result, .blank = NULL);

static const struct member pair_member[] = {
    STRING(struct route_pair, quantity, MEMBER_NEEDED),
    STRING(struct route_pair, first, MEMBER_NEEDED),
    STRING(struct route_pair, second, MEMBER_NEEDED),
    STRING(struct route_pair, shared, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "comparisons", struct route_pair, comparisons, MEMBER_NEEDED),
    STRING(struct route_pair, stated, MEMBER_NEEDED),
    BOOLEAN(struct route_pair, within),
    STRING(struct route_pair, largest, MEMBER_NULLABLE),
    STRING(struct route_pair, worst, MEMBER_NULLABLE),
};
static SHAPE(pair, struct route_pair, .blank = NULL);

static const struct member long_run_member[] = {
    STRING(struct long_result, orbit, MEMBER_NEEDED),
    STRING(struct long_result, multiplier, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "periods", struct long_result, periods, MEMBER_NEEDED),
    STRING(struct long_result, expected, MEMBER_NEEDED),
    BOOLEAN(struct long_result, obeys),
    BOOLEAN(struct long_result, displaced),
};
static SHAPE(long_run, struct long_result, .blank = NULL);

/* The file beside audit.json that holds the table: a plain name, which leads nowhere else. */
static const char *check_table(const void *record) {
  const struct data_table *t = record;
  size_t n = strlen(t->name), plain = strspn(t->name, "abcdefghijklmnopqrstuvwxyz0123456789-");
  bool fine = plain > 0 && n < 64 && strcmp(t->name + plain, ".tsv") == 0;
  return fine ? NULL : "the name of a table is letters, digits and hyphens, and .tsv";
}

static const struct member table_member[] = {STRING(struct data_table, name, MEMBER_NEEDED),
                                             STRING(struct data_table, orbit, MEMBER_SPARSE)};
static const struct data_table no_table = {.text = ""};
static SHAPE(table, struct data_table, .blank = &no_table, .check = check_table);

/* --- Readings --- */

static const struct member slope_member[] = {
    STRING(struct reading_slope, of, MEMBER_NEEDED),
    STRING(struct reading_slope, by, MEMBER_NEEDED),
    STRING(struct reading_slope, value, MEMBER_NEEDED),
};
static SHAPE(slope, struct reading_slope, .blank = NULL);

static const struct member dropped_member[] = {
    STRING(struct reading_dropped, equation, MEMBER_NEEDED),
    STRING(struct reading_dropped, residual, MEMBER_NEEDED),
    RECORDS("answer", struct reading_dropped, answer, n_answer, &slope),
};
static SHAPE(dropped, struct reading_dropped, .blank = NULL);

static const struct member number_member[] = {
    STRING(struct reading_number, name, MEMBER_NEEDED),
    STRING(struct reading_number, printed, MEMBER_NEEDED),
    STRING(struct reading_number, value, MEMBER_NEEDED),
    STRING(struct reading_number, how, MEMBER_NEEDED),
};
static SHAPE(number, struct reading_number, .blank = NULL);

static const struct member shift_member[] = {
    STRING(struct reading_shift, of, MEMBER_NEEDED),
    STRING(struct reading_shift, actual, MEMBER_NEEDED),
    STRING(struct reading_shift, predicted, MEMBER_NEEDED),
};
static SHAPE(shift, struct reading_shift, .blank = NULL);

static const struct member reading_member[] = {
    STRING(struct example_reading, layer, MEMBER_NEEDED),
    STRING(struct example_reading, confirmed, MEMBER_NULLABLE),
    STRING(struct example_reading, form, MEMBER_NEEDED),
    STRING(struct example_reading, carry, MEMBER_NEEDED),
    STRINGS("inputs", struct example_reading, inputs, n_inputs),
    STRINGS("solved", struct example_reading, solved, n_solved),
    RECORDS("dropped", struct example_reading, dropped, n_dropped, &dropped),
    WHOLE(MEMBER_INT, "assumptions", struct example_reading, assumptions, MEMBER_NEEDED),
    STRING(struct example_reading, assumed, MEMBER_NEEDED),
    WHOLE(MEMBER_INT, "digits", struct example_reading, digits, MEMBER_NEEDED),
    WHOLE(MEMBER_INT, "given", struct example_reading, n_given, MEMBER_NEEDED),
    RECORDS("numbers", struct example_reading, number, n_numbers, &number),
    RECORDS("slopes", struct example_reading, slope, n_slopes, &slope),
    WHOLE(MEMBER_INT, "decimals", struct example_reading, decimals, MEMBER_NULLABLE),
    RECORDS("shifts", struct example_reading, shift, n_shifts, &shift),
};
static SHAPE(reading, struct example_reading, .blank = NULL);

static const struct member level_member[] = {
    WHOLE(MEMBER_INT, "dropped", struct readings_level, dropped, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "tried", struct readings_level, tried, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "undetermined", struct readings_level, undetermined, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "reproduce", struct readings_level, reproduce, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "unrounded", struct readings_level, unrounded, MEMBER_NEEDED),
    WHOLE(MEMBER_LONG, "open", struct readings_level, open, MEMBER_NEEDED),
};
static SHAPE(level, struct readings_level, .blank = NULL);

static void tell_solved(struct json *j, const char *key, const void *record) {
  json_bool(j, key, ((const struct readings_pair *)record)->missed != NULL);
}

static const struct member inputs_member[] = {
    STRING(struct readings_pair, inputs, MEMBER_NEEDED),
    TOLD("solved", tell_solved),
    WHOLE(MEMBER_INT, "given", struct readings_pair, n_given, MEMBER_NEEDED),
    WHOLE(MEMBER_INT, "numbers", struct readings_pair, n_numbers, MEMBER_NEEDED),
    STRING(struct readings_pair, missed, MEMBER_NULLABLE),
};
static SHAPE(inputs, struct readings_pair, .blank = NULL);

static const struct member output_member[] = {
    STRING(struct procedure_output, name, MEMBER_NEEDED),
    STRING(struct procedure_output, printed, MEMBER_NEEDED),
    STRING(struct procedure_output, value, MEMBER_NEEDED),
    STRING(struct procedure_output, low, MEMBER_NULLABLE),
    STRING(struct procedure_output, high, MEMBER_NULLABLE),
    STRING(struct procedure_output, within, MEMBER_NEEDED),
    WHOLE(MEMBER_INT, "decimals", struct procedure_output, decimals, MEMBER_NULLABLE),
};
static SHAPE(output, struct procedure_output, .blank = NULL);

static const char *check_procedure(const void *record) {
  const struct readings_procedure *p = record;
  return p->n_outputs && !p->inputs ? "a procedure with outputs has inputs" : NULL;
}

static const struct member procedure_member[] = {
    STRING(struct readings_procedure, inputs, MEMBER_NULLABLE),
    RECORDS("outputs", struct readings_procedure, output, n_outputs, &output),
    RECORDS("slopes", struct readings_procedure, slope, n_slopes, &slope),
};
static SHAPE(procedure, struct readings_procedure, .check = check_procedure);

enum { N_LEVELS = sizeof((struct readings *)NULL)->level / sizeof(struct readings_level) };

static const struct member readings_shape_member[] = {
    STRINGS("conclusion", struct readings, conclusion, n_conclusions),
    STRINGS("space", struct readings, space, n_space),
    {.key = "levels",
     .kind = MEMBER_RECORDS,
     .at = offsetof(struct readings, level),
     .n_at = offsetof(struct readings, n_levels),
     .most = N_LEVELS,
     .of = &level},
    RECORDS("found", struct readings, found, n_found, &reading),
    RECORDS("near", struct readings, near, n_near, &reading),
    RECORDS("pairs", struct readings, pair, n_pairs, &inputs),
    {.key = "procedure", .kind = MEMBER_PART, .at = offsetof(struct readings, procedure), .of = &procedure},
};
SHAPE(readings_shape, struct readings, .blank = NULL);

/* --- The whole --- */

static void tell_schema(struct json *j, const char *key, const void *record) {
  (void)record;
  json_string(j, key, AUDIT_SCHEMA);
}

static void tell_count(struct json *j, const char *key, const struct audit_result *r, enum claimant of) {
  long count[N_VERDICTS], total = audit_result_count(count, r, of);
  json_object(j, key);
  for (int i = 0; i < N_VERDICTS; i++) json_long(j, verdict_name[i], count[i]);
  json_long(j, "total", total);
  json_end_object(j);
}

static void tell_summary(struct json *j, const char *key, const void *record) {
  tell_count(j, key, record, OF_PAPER);
}

static void tell_checks(struct json *j, const char *key, const void *record) {
  tell_count(j, key, record, OF_SUITE);
}

static const struct member audit_shape_member[] = {
    TOLD("schema", tell_schema),
    STRING(struct audit_result, scene, MEMBER_NEEDED),
    STRING(struct audit_result, title, MEMBER_NULLABLE),
    STRING(struct audit_result, data, MEMBER_SPARSE),
    STRING(struct audit_result, paper, MEMBER_SPARSE),
    STRING(struct audit_result, model, MEMBER_SPARSE),
    STRING(struct audit_result, paper_text, MEMBER_SPARSE),
    STRING(struct audit_result, paper_source, MEMBER_SPARSE),
    STRING(struct audit_result, subject, MEMBER_SPARSE),
    TOLD("summary", tell_summary),
    TOLD("checks", tell_checks),
    LIST("roots", roots, MEMBER_NEEDED, &root),
    LIST("claims", findings, MEMBER_NEEDED, &finding),
    LIST("consequences", consequences, MEMBER_NEEDED, &consequence),
    LIST("skipped", skipped, MEMBER_NEEDED, &skipped),
    LIST("values", values, MEMBER_SPARSE, &value),
    LIST("precision", precision, MEMBER_SPARSE, &precision_shape),
    LIST("controls", controls, MEMBER_NEEDED, &control),
    LIST("routes", pairs, MEMBER_NEEDED, &pair),
    LIST("long_runs", long_runs, MEMBER_NEEDED, &long_run),
    {.key = "readings",
     .kind = MEMBER_RECORD,
     .need = MEMBER_NULLABLE,
     .at = offsetof(struct audit_result, readings),
     .of = &readings_shape},
    STRINGS("independence", struct audit_result, independence, n_independence),
    LIST("tables", tables, MEMBER_NEEDED, &table),
};
SHAPE(audit_shape, struct audit_result, .blank = NULL);
