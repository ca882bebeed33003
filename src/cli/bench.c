/* stickslip bench: error against run time, job by job, and studies; tables to the standard output, files with --out. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/bench.h"
#include "cli.h"
#include "stickslip/arena.h"

static const char verdicts[] = "verdicts"; /* a job of its own kind, the last */
static const char studies[] = "studies";   /* all of them; only run when asked for */

static int parse_job(const struct options *o) {
  struct text names;
  bool known = !o->job || strcmp(o->job, verdicts) == 0 || strcmp(o->job, studies) == 0;
  text_init(&names);
  for (int i = 0; i < n_bench_jobs; i++) {
    known = known || strcmp(o->job, bench_jobs[i]->id) == 0;
    text_printf(&names, "%s, ", bench_jobs[i]->id);
  }
  for (int i = 0; i < n_bench_studies; i++) {
    known = known || strcmp(o->job, bench_studies[i]->id) == 0;
    text_printf(&names, "%s, ", bench_studies[i]->id);
  }
  if (!known) text_printf(&names, "%s, %s, not %.200s", studies, verdicts, o->job);
  int status = known ? EXIT_AS_RECORDED : usage("--job takes one of %s", text_str(&names));
  text_clear(&names);
  return status;
}

static bool asked_for(const struct options *o, const char *job) {
  return !o->job || strcmp(o->job, job) == 0;
}

static bool study_asked_for(const struct options *o, const struct study *study) {
  return o->job && (strcmp(o->job, studies) == 0 || strcmp(o->job, study->id) == 0);
}

/* Whether there is anything besides studies. */
static bool has_jobs(const struct bench_result *r) {
  return r->n > 0 || r->verdicts.n > 0;
}

static bool put(const char *folder, const char *name, const char *suffix, const struct text *body, struct diag *d) {
  struct text file, path;
  text_init(&file);
  text_init(&path);
  text_printf(&file, "%s%s", name, suffix);
  join_path(&path, folder, text_str(&file));
  bool ok = file_write(text_str(&path), text_str(body), body->len, d);
  text_clear(&path);
  text_clear(&file);
  return ok;
}

/* ID.md, ID-TABLE.tsv and, with gnuplot, ID.svg.  *drawn: whether every figure could be made. */
static bool write_study(bool *drawn, const char *folder, const struct study_page *page, struct diag *d) {
  struct text body, name;
  text_init(&body);
  text_init(&name);
  bool ok = true;
  for (int i = 0; i < page->n && ok; i++) {
    text_reset(&name);
    text_printf(&name, "%s-%s", page->study->id, page->table[i].id);
    ok = put(folder, text_str(&name), ".tsv", &page->table[i].tsv, d);
  }
  bool figure = ok && page->plot.len > 0 && bench_draw(folder, &page->plot);
  *drawn = *drawn && (figure || page->plot.len == 0);
  bench_study_markdown(&body, page, figure);
  ok = ok && put(folder, page->study->id, ".md", &body, d);
  text_clear(&name);
  text_clear(&body);
  return ok;
}

/* The figures first: the page shows those that there are. */
static bool write_files(const char *folder, const struct bench_result *r, struct diag *d) {
  struct text body;
  text_init(&body);
  bool ok = folder_make(folder, d), drawn = true;
  for (int i = 0; i < r->n && ok; i++) {
    text_reset(&body);
    bench_tsv(&body, &r->table[i]);
    ok = put(folder, r->table[i].job->id, ".tsv", &body, d);
    ok = ok && put(folder, r->table[i].job->id, "-inputs.tsv", &r->table[i].inputs, d);
    text_reset(&body);
    bench_gnuplot(&body, &r->table[i]);
    drawn = drawn && ok && bench_draw(folder, &body);
  }
  for (int i = 0; i < r->n_pages && ok; i++) ok = write_study(&drawn, folder, &r->page[i], d);
  text_reset(&body);
  bench_verdicts_tsv(&body, &r->verdicts);
  ok = ok && (r->verdicts.n == 0 || put(folder, verdicts, ".tsv", &body, d));
  if (ok && !drawn) fputs("stickslip: no figures: gnuplot is not installed, or failed\n", stderr);
  text_reset(&body);
  bench_markdown(&body, r, drawn);
  ok = ok && (!has_jobs(r) || put(folder, "bench", ".md", &body, d));
  text_reset(&body);
  bench_json(&body, r);
  ok = ok && (!has_jobs(r) || put(folder, "bench", ".json", &body, d));
  text_clear(&body);
  return ok;
}

static int run_jobs(struct bench_result *r, const struct options *o, const struct bench_env *env) {
  bool terminal = isatty(STDERR_FILENO);
  r->table = ss_malloc((size_t)n_bench_jobs * sizeof *r->table);
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < n_bench_jobs; i++) {
    if (!asked_for(o, bench_jobs[i]->id)) continue;
    if (terminal) fprintf(stderr, "\r\033[K%s", bench_jobs[i]->title);
    if (!bench_run(&r->table[r->n++], bench_jobs[i], env, r->quick)) {
      fprintf(stderr, "stickslip: the job %s has not enough inputs with a known truth\n", bench_jobs[i]->id);
      status = EXIT_INTERNAL;
    }
  }
  r->page = ss_malloc((size_t)n_bench_studies * sizeof *r->page);
  for (int i = 0; i < n_bench_studies; i++) {
    const struct study *study = bench_studies[i];
    if (!study_asked_for(o, study)) continue;
    if (terminal) fprintf(stderr, "\r\033[K%s", study->title);
    if (!study_run(&r->page[r->n_pages++], study, env, r->quick)) {
      fprintf(stderr, "stickslip: the study %s could not be made\n", study->id);
      status = EXIT_INTERNAL;
    }
  }
  if (terminal) fputs("\r\033[K", stderr);
  if (asked_for(o, verdicts)) bench_verdicts(&r->verdicts, env, r->quick);
  bench_ratios(r);
  return status;
}

static bool deliver(const struct bench_result *r, const struct options *o, struct diag *d) {
  struct text body;
  if (o->out && !write_files(o->out, r, d)) return false;
  text_init(&body);
  if (o->json)
    bench_json(&body, r);
  else if (has_jobs(r))
    bench_markdown(&body, r, false);
  for (int i = 0; i < r->n_pages && !o->json; i++) bench_study_markdown(&body, &r->page[i], false);
  fputs(text_str(&body), stdout);
  text_clear(&body);
  return true;
}

/* What the methods and the verdicts read. */
struct inputs {
  struct model model;
  struct claims claims, controls;
  struct scene scene;
};

static bool inputs_load(struct inputs *in, const char *data, const struct options *o, struct diag *d) {
  *in = (struct inputs){.claims = {.n = 0}};
  model_init(&in->model);
  return scene_load(&in->scene, "paper", data, d) && load_model(&in->model, data, o, d) &&
         load_claims(&in->claims, data, "claims", "claim", d) &&
         load_claims(&in->controls, data, "controls", "control", d);
}

static void inputs_clear(struct inputs *in) {
  claims_clear(&in->controls);
  claims_clear(&in->claims);
  model_clear(&in->model);
  scene_clear(&in->scene);
}

int run_bench(const struct options *o, const char *data) {
  int status = parse_job(o);
  if (status) return status;
  if (o->n_operands) return usage("bench takes no operand, not %.200s", o->operand[0]);
  struct diag d;
  struct inputs in;
  struct bench_result r = {.quick = o->quick};
  diag_init(&d);
  bool ok = inputs_load(&in, data, o, &d) && (!o->out || folder_make(o->out, &d));
  if (ok) {
    status = run_jobs(&r, o, &(struct bench_env){&in.model, &in.claims, &in.controls, &in.scene, data});
    ok = deliver(&r, o, &d);
  }
  if (!ok) status = bad_input(&d);
  bench_result_clear(&r);
  inputs_clear(&in);
  return status;
}
