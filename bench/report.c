/* The tables as TSV and JSON.  Every number and every word about the outcome is made from the rows. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "base/json.h"
#include "bench/bench.h"

/* An error from its log10, which may lie below the range of a double. */
const char *bench_error(char buffer[24], double log) {
  if (!isfinite(log)) return log < 0 ? "0" : "-";
  double whole = floor(log), lead = pow(10, log - whole);
  if (lead >= 9.95) {
    lead = 1;
    whole++;
  }
  snprintf(buffer, 24, "%.1fe%+03d", lead, (int)whole);
  return buffer;
}

void bench_add_setting(struct text *out, const struct bench_row *r) {
  enum bench_kind kind = r->method->kind;
  if (kind == SET_NONE || isnan(r->setting)) return;
  text_printf(out, kind == SET_BITS || kind == SET_DIGITS ? "%.0f" : "%.3g", r->setting);
}

static const char *arithmetic_of(const struct bench_method *m) {
  return m->type ? m->type->name : m->arithmetic;
}

/* Five digits; NULL for what is not known. */
static const char *number(char buffer[24], double x) {
  if (!isfinite(x)) return NULL;
  snprintf(buffer, 24, "%.5g", x);
  return buffer;
}

/* "ok", or what went wrong and how often. */
void bench_add_state(struct text *out, const struct bench_row *r) {
  bool absent = r->failure && r->cases == 0 && strcmp(r->failure, "not installed") == 0;
  if (!r->failure || absent) {
    text_add(out, absent ? r->failure : "ok");
    return;
  }
  text_printf(out, "failed: %s", r->failure);
  if (r->cases > 0) text_printf(out, " (%d of %d)", r->failures, r->cases);
}

void bench_tsv(struct text *out, const struct bench_table *t) {
  text_add(out, "job\tmethod\tarithmetic\tkind\tsetting\tstate\tinputs\tfailures\terror_worst\terror_median\tns_least\t"
                "ns_median\tsteps\tcalls\tfront\n");
  for (int i = 0; i < t->n; i++) {
    const struct bench_row *r = &t->row[i];
    char worst[24], median[24], least_ns[24], median_ns[24];
    text_printf(out, "%s\t%s\t%s\t%s\t", t->job->id, r->method->id, arithmetic_of(r->method),
                bench_kind_name[r->method->kind]);
    bench_add_setting(out, r);
    text_add(out, "\t");
    bench_add_state(out, r);
    text_printf(out, "\t%d\t%d\t%s\t%s\t%s\t%s\t", r->cases, r->failures, bench_error(worst, r->worst),
                bench_error(median, r->failure ? NAN : r->median), or_dash(number(least_ns, r->least_ns)),
                or_dash(number(median_ns, r->median_ns)));
    if (isfinite(r->steps)) text_printf(out, "%.4g", r->steps);
    text_printf(out, "\t%ld\t%s\n", r->calls, r->front ? "yes" : "no");
  }
}

void bench_verdicts_tsv(struct text *out, const struct bench_verdicts *v) {
  text_add(out, "work\tid\tsize\tseconds\n");
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *w = &v->work[i];
    char buffer[24];
    const char *seconds = number(buffer, w->seconds);
    text_printf(out, "%s\t%s\t%ld\t%s\n", bench_work_name[w->kind], w->id, w->size, seconds ? seconds : "failed");
  }
}

/* --- JSON. --- */

static void json_number(struct json *w, const char *key, double x) {
  char buffer[24];
  json_string(w, key, number(buffer, x));
}

static void json_error(struct json *w, const char *key, const struct bench_row *r, double log) {
  char buffer[24];
  json_string(w, key, r->failure ? NULL : bench_error(buffer, log));
}

static void json_row(struct json *w, const struct bench_row *r) {
  JSON_OBJECT(w, NULL);
  json_string(w, "method", r->method->id);
  json_number(w, "setting", r->method->kind == SET_NONE ? NAN : r->setting);
  JSON_STRING(w, "state", bench_add_state(w->out, r));
  json_long(w, "inputs", r->cases);
  json_long(w, "failures", r->failures);
  json_error(w, "error_worst", r, r->worst);
  json_error(w, "error_median", r, r->median);
  json_number(w, "ns_least", r->least_ns);
  json_number(w, "ns_median", r->median_ns);
  json_number(w, "steps", r->steps);
  json_bool(w, "front", r->front);
}

static void json_methods(struct json *w, const struct bench_table *t) {
  JSON_EACH (w, "methods", i, t->n_methods) {
    const struct bench_method *m = t->method[i];
    JSON_OBJECT(w, NULL);
    json_string(w, "method", m->id);
    json_string(w, "title", m->title);
    json_string(w, "arithmetic", arithmetic_of(m));
    json_string(w, "kind", m->kind == SET_NONE ? NULL : bench_kind_name[m->kind]);
    json_bool(w, "bare", m->bare);
  }
}

/* A row in short. */
static void json_choice(struct json *w, const char *key, const struct bench_row *r) {
  if (!r) {
    json_null(w, key);
    return;
  }
  JSON_OBJECT(w, key);
  json_string(w, "method", r->method->id);
  json_string(w, "kind", r->method->kind == SET_NONE ? NULL : bench_kind_name[r->method->kind]);
  json_number(w, "setting", r->method->kind == SET_NONE ? NAN : r->setting);
  json_error(w, "error_worst", r, r->worst);
  json_number(w, "ns_least", r->least_ns);
}

static void json_guide(struct json *w, const struct bench_table *t) {
  JSON_EACH (w, "guide", i, n_bench_targets) {
    char error[16];
    snprintf(error, sizeof error, "1e%d", bench_targets[i]);
    JSON_OBJECT(w, NULL);
    json_string(w, "error", error);
    json_choice(w, "fastest", bench_best(t, bench_targets[i], false));
    json_choice(w, "enclosed", bench_best(t, bench_targets[i], true));
  }
}

static void json_costs(struct json *w, const struct bench_table *t) {
  struct bench_cost cost[BENCH_COSTS];
  int n = bench_costs(cost, BENCH_COSTS, t);
  JSON_EACH (w, "rigour", i, n) {
    JSON_OBJECT(w, NULL);
    json_string(w, "plain", cost[i].plain);
    json_string(w, "balls", cost[i].balls);
    json_number(w, "digits", floor(cost[i].digits));
    json_number(w, "ns_plain", cost[i].plain_ns);
    json_number(w, "ns_balls", cost[i].balls_ns);
  }
}

static void json_verdicts(struct json *w, const struct bench_verdicts *v) {
  JSON_EACH (w, "verdicts", i, v->n) {
    const struct bench_work *k = &v->work[i];
    if (k->kind >= WORK_CLAIM) continue;
    JSON_OBJECT(w, NULL);
    json_string(w, "work", bench_work_name[k->kind]);
    json_long(w, "size", k->size);
    json_number(w, "seconds", k->seconds);
  }
}

/* A claim's sides by digits. */
static void json_sides(struct json *w, const struct bench_verdicts *v, const char *id) {
  char digits[24];
  JSON_OBJECT(w, "sides");
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *k = &v->work[i];
    if (k->kind != WORK_SIDES || strcmp(k->id, id) != 0) continue;
    snprintf(digits, sizeof digits, "%ld", k->size);
    json_number(w, digits, k->seconds);
  }
}

static void json_claims(struct json *w, const struct bench_verdicts *v) {
  JSON_EACH (w, "claims", i, v->n) {
    const struct bench_work *k = &v->work[i];
    if (k->kind != WORK_CLAIM) continue;
    JSON_OBJECT(w, NULL);
    json_string(w, "id", k->id);
    json_number(w, "judged", k->seconds);
    json_sides(w, v, k->id);
  }
}

static void json_table(struct json *w, const struct bench_table *t) {
  JSON_OBJECT(w, NULL);
  json_string(w, "job", t->job->id);
  json_string(w, "title", t->job->title);
  json_string(w, "given", t->job->inputs);
  json_string(w, "wanted", t->job->outputs);
  json_long(w, "inputs", t->cases);
  json_number(w, "floor", t->floor);
  json_number(w, "truth_digits", floor(t->truth_digits));
  json_guide(w, t);
  json_methods(w, t);
  JSON_EACH (w, "rows", i, t->n) json_row(w, &t->row[i]);
  json_costs(w, t);
}

const char *bench_outcome_name(enum bench_outcome o) {
  static const char *const name[] = {"met", "not met", "stated", "not measured"};
  return name[o];
}

static void json_parts(struct json *w, const char *key, const struct bench_part *part, int n) {
  JSON_EACH (w, key, i, n) {
    JSON_OBJECT(w, NULL);
    json_string(w, "where", part[i].where);
    json_number(w, "share", part[i].share);
  }
}

static void json_profile(struct json *w, const struct bench_profile *p) {
  if (!p->method) {
    json_null(w, "profile");
    return;
  }
  JSON_OBJECT(w, "profile");
  json_string(w, "method", p->method->id);
  json_number(w, "setting", p->setting);
  json_long(w, "samples", p->samples);
  json_parts(w, "libraries", p->library, p->n_libraries);
  json_parts(w, "functions", p->function, p->n_functions);
}

static void json_ratio(struct json *w, const struct bench_ratio *q) {
  JSON_OBJECT(w, NULL);
  json_string(w, "name", q->name);
  json_number(w, "value", q->value);
  json_number(w, "goal", q->goal);
  json_string(w, "direction", isnan(q->goal) ? NULL : q->at_most ? "at most" : "at least");
  json_string(w, "state", bench_outcome_name(bench_outcome(q)));
  json_profile(w, &q->profile);
}

void bench_json(struct text *out, const struct bench_result *r) {
  OWNED(text) machine = {0};
  bench_machine(&machine, r);
  OWNED(json) w = json_document(out, "stickslip-bench-2");
  json_bool(&w, "quick", r->quick);
  JSON_EACH (&w, "jobs", i, r->n) json_table(&w, &r->table[i]);
  JSON_EACH (&w, "ratios", i, r->n_ratios) json_ratio(&w, &r->ratio[i]);
  json_verdicts(&w, &r->verdicts);
  JSON_EACH (&w, "studies", i, r->n_pages) study_json(&w, &r->page[i]);
  json_claims(&w, &r->verdicts);
  json_string(&w, "machine", text_str(&machine));
}
