/* The pages for readers.  The first holds what all jobs share: which method to use, the ratios with what keeps them
   from their goals, what verdicts cost, the machine; each job has a page of its own.  Every number, and every sentence
   that depends on one, is made from the rows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "bench/bench.h"
#include "report/sheet.h"

/* A time with three digits and its unit. */
static const char *time_text(char buffer[24], double ns) {
  static const struct {
    double size;
    const char *name;
  } unit[] = {{1e9, "s"}, {1e6, "ms"}, {1e3, "us"}, {0, "ns"}};
  if (!isfinite(ns)) return "-";
  int k = 0;
  while (ns < unit[k].size) k++;
  double x = unit[k].size > 0 ? ns / unit[k].size : ns;
  snprintf(buffer, 24, "%.*f %s", x < 10 ? 2 : x < 100 ? 1 : 0, x, unit[k].name);
  return buffer;
}

static void add_kind_and_setting(struct text *out, const struct bench_row *r) {
  if (r->method->kind == SET_NONE || isnan(r->setting)) return;
  text_printf(out, "%s ", bench_kind_name[r->method->kind]);
  bench_add_setting(out, r);
}

/* --- Which method. --- */

static void add_choice(struct text *out, const struct bench_row *r) {
  char time[24];
  text_printf(out, " | %s", r ? r->method->id : "none");
  if (r && r->method->kind != SET_NONE) text_add(out, ", ");
  if (r) add_kind_and_setting(out, r);
  text_printf(out, " | %s", time_text(time, r ? r->least_ns : NAN));
}

static void guide(struct text *out, const struct bench_result *r) {
  if (r->n == 0) return;
  text_add(out, "\n## Which method to use\n\nFor an error that is at most so large at every input tried: the fastest "
                "method, and the fastest that returns an\nenclosure. Bare methods, which take for granted what others "
                "find or check\n(rough times, the arc, first events), are left out.\n\n");
  markdown_head(out, "job|error at most:|fastest|time:|fastest enclosure|time:");
  for (int i = 0; i < r->n; i++)
    for (int k = 0; k < n_bench_targets; k++) {
      const struct bench_row *fastest = bench_best(&r->table[i], bench_targets[k], false);
      if (!fastest) continue;
      text_printf(out, "| %s | 1e%d", r->table[i].job->id, bench_targets[k]);
      add_choice(out, fastest);
      add_choice(out, bench_best(&r->table[i], bench_targets[k], true));
      text_add(out, " |\n");
    }
}

/* --- Ratios. --- */

static void add_parts(struct text *out, const struct bench_part *part, int n) {
  for (int i = 0; i < n; i++) text_printf(out, "%s%s %.0f %%", i ? ", " : "", part[i].where, 100 * part[i].share);
}

static void add_profile(struct text *out, const struct bench_profile *p) {
  text_printf(out, "| %s", p->method->id);
  if (p->method->kind != SET_NONE) text_printf(out, ", %s %.0f", bench_kind_name[p->method->kind], p->setting);
  text_printf(out, " | %ld | ", p->samples);
  add_parts(out, p->library, p->n_libraries);
  text_add(out, " | ");
  add_parts(out, p->function, p->n_functions);
  text_add(out, " |\n");
}

static void profiles(struct text *out, const struct bench_result *r) {
  bool any = false;
  for (int i = 0; i < r->n_ratios; i++) {
    const struct bench_profile *p = &r->ratio[i].profile;
    bool seen = !p->method;
    for (int k = 0; k < i && !seen; k++) {
      const struct bench_profile *q = &r->ratio[k].profile;
      seen = q->method == p->method && (q->setting == p->setting || p->method->kind == SET_NONE);
    }
    if (seen) continue;
    if (!any) {
      text_add(out, "\nWhere the time goes in what keeps a ratio from its goal: the libraries and the functions that "
                    "were found at work.\n\n");
      markdown_head(out, "method|samples:|libraries|functions");
    }
    any = true;
    add_profile(out, p);
  }
}

static void ratios(struct text *out, const struct bench_result *r) {
  if (r->n_ratios == 0) return;
  int met = 0, with_goal = 0;
  for (int i = 0; i < r->n_ratios; i++) {
    enum bench_outcome o = bench_outcome(&r->ratio[i]);
    met += o == RATIO_MET;
    with_goal += o == RATIO_MET || o == RATIO_NOT_MET;
  }
  text_printf(out, "\n## Ratios\n\n%d of %d measured goals are met.\n\n```\n", met, with_goal);
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
      text_printf(out, " (goal: at %s %.3g; %s)\n", q->at_most ? "most" : "least", q->goal,
                  bench_outcome_name(bench_outcome(q)));
  }
  text_add(out, "```\n");
  profiles(out, r);
}

/* --- Verdicts. --- */

static int by_seconds(const void *x, const void *y) {
  const struct bench_work *a = *(const struct bench_work *const *)x, *b = *(const struct bench_work *const *)y;
  return (a->seconds < b->seconds) - (a->seconds > b->seconds);
}

enum { SHOWN = 12 };

/* The claims that take longest in work of that kind, which is where to look first: of each the last row, when it is
   good.  An array to be freed; *failed: rows that are not good. */
static const struct bench_work **longest(size_t *n, size_t *failed, const struct bench_verdicts *v,
                                         enum bench_work_kind kind) {
  const struct bench_work **last = ss_malloc((v->n + 1) * sizeof *last);
  *n = *failed = 0;
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *w = &v->work[i], *next = i + 1 < v->n ? w + 1 : NULL;
    if (w->kind != kind) continue;
    *failed += !w->good;
    bool ends = !next || next->kind != kind || strcmp(next->id, w->id) != 0;
    if (ends && w->good) last[(*n)++] = w;
  }
  qsort(last, *n, sizeof(const struct bench_work *), by_seconds);
  return last;
}

static void longest_claims(struct text *out, const struct bench_verdicts *v) {
  size_t n, failed;
  FREED const struct bench_work **claim = longest(&n, &failed, v, WORK_CLAIM);
  char time[24];
  text_printf(
      out,
      "\nClaims judged one by one (those with a suffix together with their first): %zu. Those that take longest:\n\n",
      n);
  markdown_head(out, "claim|time:");
  for (size_t i = 0; i < n && i < SHOWN; i++)
    text_printf(out, "| %s | %s |\n", claim[i]->id, time_text(time, 1e9 * claim[i]->seconds));
}

/* By digits. */
static void longest_sides(struct text *out, const struct bench_verdicts *v) {
  size_t n, failed;
  FREED const struct bench_work **last = longest(&n, &failed, v, WORK_SIDES);
  char time[24];
  if (n + failed > 0) {
    text_printf(
        out, "\nBoth sides of %zu claims, each alone (times that could not be had: %zu). Those that take longest:\n\n",
        n, failed);
    markdown_head(out, "claim|time to so many digits");
  }
  for (size_t i = 0; i < n && i < SHOWN; i++) {
    const struct bench_work *w = last[i];
    while (w > v->work && w[-1].kind == WORK_SIDES && strcmp(w[-1].id, w->id) == 0) w--;
    text_printf(out, "| %s | ", w->id);
    for (; w <= last[i]; w++)
      text_printf(out, "%s to %ld%s", time_text(time, 1e9 * w->seconds), w->size, w < last[i] ? ", " : " |\n");
  }
}

/* Time per unit of size against the one before: the exponent of growth. */
static double growth(const struct bench_verdicts *v, size_t i) {
  const struct bench_work *w = &v->work[i], *last = i > 0 ? w - 1 : NULL;
  if (!last || last->kind != w->kind || !w->good || !last->good || last->size == w->size) return NAN;
  return log(w->seconds / last->seconds) / log((double)w->size / (double)last->size);
}

static void verdicts(struct text *out, const struct bench_verdicts *v, bool files) {
  if (v->n == 0) return;
  text_add(out,
           "\n## What verdicts cost\n\nOn the paper's scene: orbits, Jacobians and both sides of every claim that "
           "has two, at one of its\npoints, to a number of digits; sweeps over so many points of a line, from half of "
           "e2 to three times it,\nand of a square of such lines whose e1 is up to a quarter less or more;\nmotions "
           "under Coulomb's law over so many periods, in double precision by closed "
           "forms; the first claims judged together.\nEach in one process. Growth is the power of the size with which "
           "the time has grown since the row above.\n");
  if (files) text_add(out, "\n![time against size](verdicts.svg)\n");
  text_add(out, "\n");
  markdown_head(out, "work|size:|time:|growth:");
  for (size_t i = 0; i < v->n; i++) {
    const struct bench_work *w = &v->work[i];
    if (w->kind >= WORK_CLAIM) continue;
    char time[24];
    text_printf(out, "| %s | %ld | %s | ", bench_work_name[w->kind], w->size, time_text(time, 1e9 * w->seconds));
    if (!w->good)
      text_add(out, "failed");
    else if (isfinite(growth(v, i)))
      text_printf(out, "%.2f", growth(v, i));
    text_add(out, " |\n");
  }
  longest_claims(out, v);
  longest_sides(out, v);
}

/* --- A job. --- */

static void add_row(struct text *out, const struct bench_row *r, bool whole) {
  char worst[24], median[24], least_time[24], median_time[24];
  text_printf(out, "| %s | ", r->method->id);
  add_kind_and_setting(out, r);
  text_printf(out, " | %s | %s | %s | %s", bench_error(worst, r->worst),
              bench_error(median, r->failure ? NAN : r->median), time_text(least_time, r->least_ns),
              time_text(median_time, r->median_ns));
  if (whole) {
    text_add(out, " | ");
    if (isfinite(r->steps)) text_printf(out, "%.3g", r->steps);
    text_add(out, " | ");
    bench_add_state(out, r);
    if (r->capped) text_printf(out, "; on %d of the inputs", r->cases);
  }
  text_add(out, " |\n");
}

/* The front from the fastest to the most accurate. */
static void front(struct text *out, const struct bench_table *t) {
  text_add(out, "\nThe front: nothing here is both faster and closer.\n\n");
  markdown_head(out, "method|setting|worst error:|median error:|least time:|median time:");
  double last = -1;
  for (;;) {
    const struct bench_row *next = NULL;
    for (int i = 0; i < t->n; i++) {
      const struct bench_row *r = &t->row[i];
      if (r->front && r->least_ns > last && (!next || r->least_ns < next->least_ns)) next = r;
    }
    if (!next) break;
    add_row(out, next, false);
    last = next->least_ns;
  }
}

static void methods(struct text *out, const struct bench_table *t) {
  text_add(out, "\n");
  markdown_head(out, "method|what it is");
  for (int i = 0; i < t->n_methods; i++)
    text_printf(out, "| %s | %s%s |\n", t->method[i]->id, t->method[i]->title, t->method[i]->bare ? " (bare)" : "");
}

static void costs(struct text *out, const struct bench_table *t) {
  struct bench_cost cost[BENCH_COSTS];
  int n = bench_costs(cost, BENCH_COSTS, t);
  if (n == 0) return;
  text_add(out, "\nThe price of proof: balls against MPFR at equal true error, the time of balls read between their "
                "settings.\n\n");
  markdown_head(out, "MPFR|balls|digits:|MPFR's time:|balls' time:|ratio:");
  for (int i = 0; i < n; i++) {
    char plain[24], balls[24];
    text_printf(out, "| %s | %s | %.0f | %s | %s | %.2f |\n", cost[i].plain, cost[i].balls, floor(cost[i].digits),
                time_text(plain, cost[i].plain_ns), time_text(balls, cost[i].balls_ns),
                cost[i].balls_ns / cost[i].plain_ns);
  }
}

void bench_job_markdown(struct text *out, const struct bench_table *t, bool files) {
  text_printf(out, "# %s\n\nGiven: %s. Wanted: %s.\n", t->job->title, t->job->inputs, t->job->outputs);
  text_printf(out, "%d inputs; the truth has %.0f digits or more; rounding each input to 53 bits can cost %.1e.\n",
              t->cases, floor(t->truth_digits), t->floor);
  if (files) text_printf(out, "\n![error against time](%s.svg)\n", t->job->id);
  if (files && bench_has_steps(t)) text_printf(out, "\n![error against step](%s-steps.svg)\n", t->job->id);
  front(out, t);
  costs(out, t);
  methods(out, t);
  text_add(out, "\nAll that was run:\n\n");
  markdown_head(out, "method|setting|worst error:|median error:|least time:|median time:|steps:|outcome");
  for (int i = 0; i < t->n; i++) add_row(out, &t->row[i], true);
}

static void machine(struct text *out, const struct bench_result *r) {
  text_add(out, "\n## Machine\n\n```\n");
  bench_machine(out, r);
  text_add(out, "```\n");
}

/* --- The page that holds all together. --- */

void bench_markdown(struct text *out, const struct bench_result *r, bool files) {
  text_add(
      out,
      "# Error against run time\n\nErrors are true ones, against enclosures, the worst and the median over the "
      "inputs, in units of the output's\nsize; for balls the radius counts as error. Times are of one call, the "
      "least and the median of batches that go\nthrough all inputs. What failed has no time and is on no front.\n");
  if (r->quick) text_add(out, "\nA quick run: few inputs, few batches; its times are rough.\n");
  guide(out, r);
  for (int i = 0; i < r->n && files; i++)
    text_printf(out, "%s- [%s](%s.md)\n", i ? "" : "\n", r->table[i].job->title, r->table[i].job->id);
  ratios(out, r);
  verdicts(out, &r->verdicts, files);
  machine(out, r);
}

void bench_study_markdown(struct text *out, const struct study_page *page, bool files) {
  text_printf(out, "# %s%s\n", page->study->apart ? "" : "Stability: ", page->study->title);
  study_markdown(out, page, files);
  machine(out, NULL);
}
