/* The tables as TSV, JSON and Markdown.  Every number and every word about the outcome is made from the rows. */
#include <math.h>
#include <stdlib.h>

#include "bench/bench.h"
#include "stickslip/arena.h"
#include "stickslip/json.h"

/* An error from its log10, which may lie below the range of a double. */
static void add_error(struct text *out, double log) {
  if (!isfinite(log)) {
    text_add(out, log < 0 ? "0" : "-");
    return;
  }
  double whole = floor(log), lead = pow(10, log - whole);
  if (lead >= 9.95) {
    lead = 1;
    whole++;
  }
  text_printf(out, "%.1fe%+03d", lead, (int)whole);
}

static void add_setting(struct text *out, const struct bench_row *r) {
  if (r->method->kind == SET_BITS)
    text_printf(out, "%.0f", r->setting);
  else if (r->method->kind != SET_NONE)
    text_printf(out, "%.3g", r->setting);
}

/* Five digits, or a word for what is not known. */
static void add_number(struct text *out, double x, const char *unknown) {
  if (isfinite(x))
    text_printf(out, "%.5g", x);
  else
    text_add(out, unknown);
}

/* "ok", or what went wrong and how often. */
static void add_state(struct text *out, const struct bench_row *r) {
  if (!r->failure) {
    text_add(out, "ok");
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
    text_printf(out, "%s\t%s\t%s\t%s\t", t->job->id, r->method->id, r->method->type->name,
                bench_kind_name[r->method->kind]);
    add_setting(out, r);
    text_add(out, "\t");
    add_state(out, r);
    text_printf(out, "\t%d\t%d\t", r->cases, r->failures);
    add_error(out, r->worst);
    text_add(out, "\t");
    add_error(out, r->failure ? NAN : r->median);
    text_add(out, "\t");
    add_number(out, r->least_ns, "-");
    text_add(out, "\t");
    add_number(out, r->median_ns, "-");
    text_printf(out, "\t%.4g\t%ld\t%s\n", r->steps, r->calls, r->front ? "yes" : "no");
  }
}

void bench_verdicts_tsv(struct text *out, const struct bench_verdicts *v) {
  text_add(out, "work\tid\tsize\tseconds\n");
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *w = &v->work[i];
    text_printf(out, "%s\t%s\t%ld\t", bench_work_name[w->kind], w->id, w->size);
    add_number(out, w->seconds, "failed");
    text_add(out, "\n");
  }
}

/* --- JSON. --- */

static void json_number(struct json *w, const char *key, double x) {
  struct text t;
  text_init(&t);
  add_number(&t, x, "");
  json_string(w, key, isfinite(x) ? text_str(&t) : NULL);
  text_clear(&t);
}

static void json_error(struct json *w, const char *key, const struct bench_row *r, double log) {
  struct text t;
  text_init(&t);
  add_error(&t, log);
  json_string(w, key, r->failure ? NULL : text_str(&t));
  text_clear(&t);
}

static void json_row(struct json *w, const struct bench_row *r) {
  struct text t;
  text_init(&t);
  json_object(w, NULL);
  json_string(w, "method", r->method->id);
  json_string(w, "title", r->method->title);
  json_string(w, "arithmetic", r->method->type->name);
  json_string(w, "kind", r->method->kind == SET_NONE ? NULL : bench_kind_name[r->method->kind]);
  json_number(w, "setting", r->method->kind == SET_NONE ? NAN : r->setting);
  add_state(&t, r);
  json_string(w, "state", text_str(&t));
  json_long(w, "inputs", r->cases);
  json_long(w, "failures", r->failures);
  json_error(w, "error_worst", r, r->worst);
  json_error(w, "error_median", r, r->median);
  json_number(w, "ns_least", r->least_ns);
  json_number(w, "ns_median", r->median_ns);
  json_number(w, "steps", r->steps);
  json_long(w, "calls", r->calls);
  json_bool(w, "front", r->front);
  json_end_object(w);
  text_clear(&t);
}

enum { MOST_COSTS = 64 };

static void json_costs(struct json *w, const struct bench_table *t) {
  struct bench_cost cost[MOST_COSTS];
  int n = bench_costs(cost, MOST_COSTS, t);
  json_array(w, "rigour");
  for (int i = 0; i < n; i++) {
    json_object(w, NULL);
    json_string(w, "plain", cost[i].plain);
    json_string(w, "balls", cost[i].balls);
    json_number(w, "digits", floor(cost[i].digits));
    json_number(w, "ns_plain", cost[i].plain_ns);
    json_number(w, "ns_balls", cost[i].balls_ns);
    json_end_object(w);
  }
  json_end_array(w);
}

static void json_verdicts(struct json *w, const struct bench_verdicts *v) {
  json_array(w, "verdicts");
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *k = &v->work[i];
    json_object(w, NULL);
    json_string(w, "work", bench_work_name[k->kind]);
    json_string(w, "id", k->id[0] ? k->id : NULL);
    json_long(w, "size", k->size);
    json_number(w, "seconds", k->seconds);
    json_end_object(w);
  }
  json_end_array(w);
}

static void json_table(struct json *w, const struct bench_table *t) {
  json_object(w, NULL);
  json_string(w, "job", t->job->id);
  json_string(w, "title", t->job->title);
  json_string(w, "given", t->job->inputs);
  json_string(w, "wanted", t->job->outputs);
  json_long(w, "inputs", t->cases);
  json_number(w, "floor", t->floor);
  json_number(w, "truth_digits", floor(t->truth_digits));
  json_array(w, "rows");
  for (int i = 0; i < t->n; i++) json_row(w, &t->row[i]);
  json_end_array(w);
  json_costs(w, t);
  json_end_object(w);
}

static const char *verdict(const struct bench_ratio *r) {
  if (isnan(r->value)) return "not measured";
  if (isnan(r->goal)) return "stated";
  return (r->at_most ? r->value <= r->goal : r->value >= r->goal) ? "met" : "not met";
}

void bench_json(struct text *out, const struct bench_result *r) {
  struct json w;
  struct text machine;
  text_init(&machine);
  bench_machine(&machine);
  json_init(&w, out);
  json_object(&w, NULL);
  json_string(&w, "schema", "stickslip-bench-1");
  json_bool(&w, "quick", r->quick);
  json_array(&w, "jobs");
  for (int i = 0; i < r->n; i++) json_table(&w, &r->table[i]);
  json_end_array(&w);
  json_array(&w, "ratios");
  for (int i = 0; i < r->n_ratios; i++) {
    const struct bench_ratio *q = &r->ratio[i];
    json_object(&w, NULL);
    json_string(&w, "name", q->name);
    json_number(&w, "value", q->value);
    json_number(&w, "goal", q->goal);
    json_string(&w, "direction", isnan(q->goal) ? NULL : q->at_most ? "at most" : "at least");
    json_string(&w, "state", verdict(q));
    json_end_object(&w);
  }
  json_end_array(&w);
  json_verdicts(&w, &r->verdicts);
  json_array(&w, "studies");
  for (int i = 0; i < r->n_pages; i++) study_json(&w, &r->page[i]);
  json_end_array(&w);
  json_string(&w, "machine", text_str(&machine));
  json_end_object(&w);
  text_clear(&machine);
}

/* --- Markdown. --- */

static void markdown_machine(struct text *out) {
  text_add(out, "\n## Machine\n\n```\n");
  bench_machine(out);
  text_add(out, "```\n");
}

/* A time with three digits and its unit. */
static void add_time(struct text *out, double ns) {
  static const struct {
    double size;
    const char *name;
  } unit[] = {{1e9, "s"}, {1e6, "ms"}, {1e3, "us"}, {0, "ns"}};
  if (!isfinite(ns)) {
    text_add(out, "-");
    return;
  }
  int k = 0;
  while (ns < unit[k].size) k++;
  double x = unit[k].size > 0 ? ns / unit[k].size : ns;
  text_printf(out, "%.*f %s", x < 10 ? 2 : x < 100 ? 1 : 0, x, unit[k].name);
}

static void markdown_row(struct text *out, const struct bench_row *r, bool whole) {
  text_printf(out, "| %s | ", r->method->id);
  if (r->method->kind != SET_NONE) text_printf(out, "%s ", bench_kind_name[r->method->kind]);
  add_setting(out, r);
  text_add(out, " | ");
  add_error(out, r->worst);
  text_add(out, " | ");
  add_error(out, r->failure ? NAN : r->median);
  text_add(out, " | ");
  add_time(out, r->least_ns);
  text_add(out, " | ");
  add_time(out, r->median_ns);
  if (whole) {
    text_printf(out, " | %.3g | ", r->steps);
    add_state(out, r);
    if (r->capped) text_printf(out, "; %d inputs only", r->cases);
  }
  text_add(out, " |\n");
}

/* The front from the fastest to the most accurate. */
static void markdown_front(struct text *out, const struct bench_table *t) {
  text_add(out, "\nThe front: nothing here is both faster and closer.\n\n"
                "| method | setting | worst error | median error | least time | median time |\n"
                "| --- | --- | ---: | ---: | ---: | ---: |\n");
  double last = -1;
  for (;;) {
    const struct bench_row *next = NULL;
    for (int i = 0; i < t->n; i++) {
      const struct bench_row *r = &t->row[i];
      if (r->front && r->least_ns > last && (!next || r->least_ns < next->least_ns)) next = r;
    }
    if (!next) break;
    markdown_row(out, next, false);
    last = next->least_ns;
  }
}

static void markdown_methods(struct text *out, const struct bench_job *job) {
  text_add(out, "\n| method | what it is |\n| --- | --- |\n");
  for (int i = 0; i < job->n_methods; i++) text_printf(out, "| %s | %s |\n", job->methods[i].id, job->methods[i].title);
}

static void markdown_costs(struct text *out, const struct bench_table *t) {
  struct bench_cost cost[MOST_COSTS];
  int n = bench_costs(cost, MOST_COSTS, t);
  if (n == 0) return;
  text_add(out, "\nThe price of proof: balls against MPFR at equal true error, the time of balls read between their "
                "settings.\n\n| MPFR | balls | digits | MPFR's time | balls' time | ratio |\n"
                "| --- | --- | ---: | ---: | ---: | ---: |\n");
  for (int i = 0; i < n; i++) {
    text_printf(out, "| %s | %s | %.0f | ", cost[i].plain, cost[i].balls, floor(cost[i].digits));
    add_time(out, cost[i].plain_ns);
    text_add(out, " | ");
    add_time(out, cost[i].balls_ns);
    text_printf(out, " | %.2f |\n", cost[i].balls_ns / cost[i].plain_ns);
  }
}

static int by_seconds(const void *x, const void *y) {
  const struct bench_work *a = *(const struct bench_work *const *)x, *b = *(const struct bench_work *const *)y;
  return (a->seconds < b->seconds) - (a->seconds > b->seconds);
}

/* The claims that take longest, which is where to look first. */
static void markdown_claims(struct text *out, const struct bench_verdicts *v) {
  enum { SHOWN = 12 };
  const struct bench_work **claim = ss_malloc((v->n + 1) * sizeof *claim);
  size_t n = 0;
  for (size_t i = 0; i < v->n; i++)
    if (v->work[i].kind == WORK_CLAIM && v->work[i].good) claim[n++] = &v->work[i];
  qsort(claim, n, sizeof(const struct bench_work *), by_seconds);
  text_printf(
      out,
      "\nClaims judged one by one (those with a suffix together with their first): %zu. Those that take longest:\n\n"
      "| claim | time |\n| --- | ---: |\n",
      n);
  for (size_t i = 0; i < n && i < SHOWN; i++) {
    text_printf(out, "| %s | ", claim[i]->id);
    add_time(out, 1e9 * claim[i]->seconds);
    text_add(out, " |\n");
  }
  free(claim);
}

static void markdown_verdicts(struct text *out, const struct bench_verdicts *v) {
  if (v->n == 0) return;
  text_add(out,
           "\n## What verdicts cost\n\nOn the paper's scene. Orbits and Jacobians to a number of digits; the first "
           "claims together.\n\n| work | digits or claims | time |\n| --- | ---: | ---: |\n");
  for (size_t i = 0; i < v->n; i++) {
    if (v->work[i].kind == WORK_CLAIM) continue;
    text_printf(out, "| %s | %ld | ", bench_work_name[v->work[i].kind], v->work[i].size);
    add_time(out, 1e9 * v->work[i].seconds);
    text_add(out, v->work[i].good ? " |\n" : " failed |\n");
  }
  markdown_claims(out, v);
}

static void markdown_table(struct text *out, const struct bench_table *t, bool figures) {
  text_printf(out, "\n## %s\n\nGiven: %s. Wanted: %s.\n", t->job->title, t->job->inputs, t->job->outputs);
  text_printf(out, "%d inputs; the truth has %.0f digits or more; rounding each input to 53 bits can cost %.1e.\n",
              t->cases, floor(t->truth_digits), t->floor);
  if (figures) text_printf(out, "\n![error against time](%s.svg)\n", t->job->id);
  if (figures && bench_has_steps(t)) text_printf(out, "\n![error against step](%s-steps.svg)\n", t->job->id);
  markdown_front(out, t);
  markdown_costs(out, t);
  markdown_methods(out, t->job);
  text_add(out, "\nAll that was run:\n\n"
                "| method | setting | worst error | median error | least time | median time | steps | outcome |\n"
                "| --- | --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
  for (int i = 0; i < t->n; i++) markdown_row(out, &t->row[i], true);
}

static void markdown_ratios(struct text *out, const struct bench_result *r) {
  if (r->n_ratios == 0) return;
  text_add(out, "\n## Ratios\n\n```\n");
  for (int i = 0; i < r->n_ratios; i++) {
    const struct bench_ratio *q = &r->ratio[i];
    text_printf(out, "%s: ", q->name);
    if (isnan(q->value))
      text_add(out, "not measured");
    else
      text_printf(out, "%.3g", q->value);
    if (isnan(q->goal))
      text_add(out, " (no goal)\n");
    else
      text_printf(out, " (goal: at %s %.3g; %s)\n", q->at_most ? "most" : "least", q->goal, verdict(q));
  }
  text_add(out, "```\n");
}

void bench_markdown(struct text *out, const struct bench_result *r, bool figures) {
  text_add(
      out,
      "# Error against run time\n\nErrors are true ones, against enclosures, the worst and the median over the "
      "inputs, in units of the output's\nsize; for balls the radius counts as error. Times are of one call, the "
      "least and the median of batches that go\nthrough all inputs. What failed has no time and is on no front.\n");
  if (r->quick) text_add(out, "\nA quick run: few inputs, few batches; its times are rough.\n");
  for (int i = 0; i < r->n; i++) markdown_table(out, &r->table[i], figures);
  markdown_verdicts(out, &r->verdicts);
  markdown_ratios(out, r);
  markdown_machine(out);
}

void bench_study_markdown(struct text *out, const struct study_page *page, bool figure) {
  text_printf(out, "# Stability: %s\n", page->study->title);
  study_markdown(out, page, figure);
  markdown_machine(out);
}
