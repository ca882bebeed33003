/* stickslip bench: error against run time, job by job, and studies; tables to the standard output, files with --out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "bench/bench.h"
#include "claim/near.h"
#include "cli.h"

static const char verdicts[] = "verdicts"; /* a job of its own kind, the last */
static const char studies[] = "studies";   /* all but those apart; only run when asked for */

static int parse_job(const struct options *o) {
  OWNED(text) names = {0};
  const char *job = option(o, OPT_JOB);
  bool known = !job || strcmp(job, verdicts) == 0 || strcmp(job, studies) == 0;
  for (int i = 0; i < n_bench_jobs; i++) {
    known = known || strcmp(job, bench_jobs[i]->id) == 0;
    text_printf(&names, "%s, ", bench_jobs[i]->id);
  }
  for (int i = 0; i < n_bench_studies; i++) {
    known = known || strcmp(job, bench_studies[i]->id) == 0;
    text_printf(&names, "%s, ", bench_studies[i]->id);
  }
  return known ? EXIT_AS_RECORDED
               : usage("--job takes one of %s%s, %s, not %.200s", text_str(&names), studies, verdicts, job);
}

static bool asked_for(const struct options *o, const char *job) {
  const char *only = option(o, OPT_JOB);
  return !only || strcmp(only, job) == 0;
}

static bool study_asked_for(const struct options *o, const struct study *study) {
  const char *only = option(o, OPT_JOB);
  return only && ((strcmp(only, studies) == 0 && !study->apart) || strcmp(only, study->id) == 0);
}

/* Whether there is anything besides studies. */
static bool has_jobs(const struct bench_result *r) {
  return r->n > 0 || r->verdicts.n > 0;
}

/* A folder with a bench.json is one of ours. */
static bool is_report(const char *folder) {
  OWNED(text) path = {0};
  struct stat st;
  join_path(&path, folder, "bench.json");
  return stat(text_str(&path), &st) == 0;
}

static void remove_stale(const struct output *out) {
  static const char *const suffix[] = {".md", ".tsv", ".svg", "-steps.svg"};
  for (size_t k = 0; k < sizeof suffix / sizeof *suffix; k++) {
    for (int i = 0; i < n_bench_jobs; i++) output_remove_stale(out, "%s%s", bench_jobs[i]->id, suffix[k]);
    output_remove_stale(out, "%s%s", verdicts, suffix[k]);
  }
}

/* ID.md, ID-TABLE.tsv and, where the study has one, ID.svg. */
static void add_study(struct output *out, const struct study_page *page) {
  const char *id = page->study->id;
  for (int i = 0; i < page->n; i++)
    text_add(output_add(out, "%s-%s.tsv", id, page->table[i].id), text_str(&page->table[i].tsv));
  if (page->figure.len > 0) text_add(output_add(out, "%s.svg", id), text_str(&page->figure));
  bench_study_markdown(output_add(out, "%s.md", id), page, true);
}

static bool write_files(const char *folder, const struct bench_result *r, struct diag *d) {
  OWNED(output) out;
  bool ok = folder_make(folder, d), again = is_report(folder);
  output_init(&out, folder);
  for (int i = 0; i < r->n; i++) {
    const struct bench_table *t = &r->table[i];
    bench_tsv(output_add(&out, "%s.tsv", t->job->id), t);
    bench_job_markdown(output_add(&out, "%s.md", t->job->id), t, true);
    bench_figure(output_add(&out, "%s.svg", t->job->id), t, false);
    if (bench_has_steps(t)) bench_figure(output_add(&out, "%s-steps.svg", t->job->id), t, true);
  }
  for (int i = 0; i < r->n_pages; i++) add_study(&out, &r->page[i]);
  if (r->verdicts.n > 0) {
    bench_verdicts_tsv(output_add(&out, "%s.tsv", verdicts), &r->verdicts);
    bench_verdicts_figure(output_add(&out, "%s.svg", verdicts), &r->verdicts);
  }
  if (has_jobs(r)) {
    bench_markdown(output_add(&out, "bench.md"), r, true);
    bench_json(output_add(&out, "bench.json"), r);
  }
  ok = ok && output_write(&out, d);
  if (ok && again && has_jobs(r)) remove_stale(&out);
  return ok;
}

static int no_inputs(const struct bench_job *job) {
  fprintf(stderr, "stickslip: the job %s has not enough inputs with a known truth\n", job->id);
  return EXIT_INTERNAL;
}

/* How many jobs and studies. */
static size_t count_asked(const struct options *o) {
  size_t n = asked_for(o, verdicts);
  for (int i = 0; i < n_bench_jobs; i++) n += asked_for(o, bench_jobs[i]->id);
  for (int i = 0; i < n_bench_studies; i++) n += study_asked_for(o, bench_studies[i]);
  return n;
}

static int run_jobs(struct bench_result *r, const struct options *o, const struct bench_env *env) {
  size_t done = 0, of = count_asked(o);
  progress_begin();
  r->table = ss_malloc((size_t)n_bench_jobs * sizeof *r->table);
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < n_bench_jobs; i++) {
    if (!asked_for(o, bench_jobs[i]->id)) continue;
    progress_count(done++, of);
    struct bench_table *t = &r->table[r->n++];
    if (!bench_run(t, bench_jobs[i], env, r->quick)) status = no_inputs(bench_jobs[i]);
    bench_peers_add(t, &r->peers);
  }
  r->page = ss_malloc((size_t)n_bench_studies * sizeof *r->page);
  for (int i = 0; i < n_bench_studies; i++) {
    const struct study *study = bench_studies[i];
    if (!study_asked_for(o, study)) continue;
    progress_count(done++, of);
    if (!study_run(&r->page[r->n_pages++], study, env, r->quick)) {
      fprintf(stderr, "stickslip: the study %s could not be made\n", study->id);
      status = EXIT_INTERNAL;
    }
  }
  if (asked_for(o, verdicts)) {
    progress_count(done, of);
    bench_verdicts(&r->verdicts, env, r->quick);
  }
  progress_end();
  bench_ratios(r);
  bench_profiles(r, env);
  return status;
}

static bool deliver(const struct bench_result *r, const struct options *o, struct diag *d) {
  struct text body = {0};
  const char *folder = option(o, OPT_OUT);
  if (folder && !write_files(folder, r, d)) return false;
  if (option(o, OPT_JSON))
    bench_json(&body, r);
  else if (has_jobs(r))
    bench_markdown(&body, r, false);
  for (int i = 0; i < r->n && !option(o, OPT_JSON); i++) {
    text_add(&body, "\n");
    bench_job_markdown(&body, &r->table[i], false);
  }
  for (int i = 0; i < r->n_pages && !option(o, OPT_JSON); i++) bench_study_markdown(&body, &r->page[i], false);
  print_text(&body);
  if (folder) say_written(o, folder);
  return true;
}

/* JOB-inputs.tsv for whoever wants to try a method of his own, or to recheck an error. */
static int write_inputs(const struct options *o, struct diag *d) {
  OWNED(output) out;
  int status = EXIT_AS_RECORDED;
  output_init(&out, option(o, OPT_INPUTS));
  bool ok = folder_make(out.folder, d);
  for (int i = 0; i < n_bench_jobs && ok; i++) {
    if (!asked_for(o, bench_jobs[i]->id)) continue;
    struct text *body = output_add(&out, "%s-inputs.tsv", bench_jobs[i]->id);
    if (!bench_inputs(body, bench_jobs[i], option(o, OPT_QUICK))) status = no_inputs(bench_jobs[i]);
  }
  ok = ok && output_write(&out, d);
  if (ok) say_written(o, out.folder);
  return ok ? status : EXIT_INPUT;
}

static int measure(const struct options *o, const char *data, struct diag *d) {
  OWNED(inputs) in;
  OWNED(bench_result) r = {.quick = option(o, OPT_QUICK)};
  int status = EXIT_AS_RECORDED;
  const char *peers = option(o, OPT_PEERS), *folder = option(o, OPT_OUT);
  bool ok = inputs_load(&in, data, o, d) &&
            near_controls_add(&in.files.model, &in.files.claims, &in.files.controls, d) &&
            (!peers || bench_peers_read(&r.peers, peers, d)) && (!folder || folder_possible(folder, d));
  if (ok) {
    status =
        run_jobs(&r, o, &(struct bench_env){&in.files.model, &in.files.claims, &in.files.controls, &in.scene, data});
    ok = deliver(&r, o, d);
  }
  return ok ? status : EXIT_INPUT;
}

int run_bench(const struct options *o, const char *data, struct diag *d) {
  int status = parse_job(o);
  if (status) return status;
  bool inputs = option(o, OPT_INPUTS);
  if (inputs && option(o, OPT_JOB) && strcmp(option(o, OPT_JOB), verdicts) == 0)
    return usage("--inputs: the job %s has none", verdicts);
  return inputs ? write_inputs(o, d) : measure(o, data, d);
}
