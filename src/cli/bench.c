/* stickslip bench: error against run time, job by job; tables to the standard output, files with --out. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/bench.h"
#include "cli.h"
#include "stickslip/arena.h"

static int parse_job(const struct bench_job **job, const struct options *o) {
  *job = NULL;
  for (int i = 0; i < n_bench_jobs && o->job; i++)
    if (strcmp(o->job, bench_jobs[i]->id) == 0) *job = bench_jobs[i];
  if (!o->job || *job) return EXIT_AS_RECORDED;
  struct text names;
  text_init(&names);
  for (int i = 0; i < n_bench_jobs; i++) text_printf(&names, "%s%s", i == 0 ? "" : ", ", bench_jobs[i]->id);
  text_printf(&names, ", not %.200s", o->job);
  int status = usage("--job takes one of %s", text_str(&names));
  text_clear(&names);
  return status;
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

/* The figures first: the page shows those that there are. */
static bool write_files(const char *folder, const struct bench_result *r, struct diag *d) {
  struct text body;
  text_init(&body);
  bool ok = folder_make(folder, d), drawn = true;
  for (int i = 0; i < r->n && ok; i++) {
    text_reset(&body);
    bench_tsv(&body, &r->table[i]);
    ok = put(folder, r->table[i].job->id, ".tsv", &body, d);
    text_reset(&body);
    bench_gnuplot(&body, &r->table[i]);
    drawn = drawn && ok && bench_draw(folder, &body);
  }
  if (ok && !drawn) fputs("stickslip: no figures: gnuplot is not installed, or failed\n", stderr);
  text_reset(&body);
  bench_markdown(&body, r, drawn);
  ok = ok && put(folder, "README", ".md", &body, d);
  text_reset(&body);
  bench_json(&body, r);
  ok = ok && put(folder, "bench", ".json", &body, d);
  text_clear(&body);
  return ok;
}

static int run_jobs(struct bench_result *r, const struct bench_job *only, const struct bench_env *env) {
  bool terminal = isatty(STDERR_FILENO);
  r->table = ss_malloc((size_t)n_bench_jobs * sizeof *r->table);
  int status = EXIT_AS_RECORDED;
  for (int i = 0; i < n_bench_jobs; i++) {
    if (only && bench_jobs[i] != only) continue;
    if (terminal) fprintf(stderr, "\r\033[K%s", bench_jobs[i]->title);
    if (!bench_run(&r->table[r->n++], bench_jobs[i], env, r->quick)) {
      fprintf(stderr, "stickslip: the job %s has not enough inputs with a known truth\n", bench_jobs[i]->id);
      status = EXIT_INTERNAL;
    }
  }
  if (terminal) fputs("\r\033[K", stderr);
  bench_ratios(r);
  return status;
}

static bool deliver(const struct bench_result *r, const struct options *o, struct diag *d) {
  struct text body;
  if (o->out && !write_files(o->out, r, d)) return false;
  text_init(&body);
  if (o->json)
    bench_json(&body, r);
  else
    bench_markdown(&body, r, false);
  fputs(text_str(&body), stdout);
  text_clear(&body);
  return true;
}

int run_bench(const struct options *o, const char *data) {
  const struct bench_job *only;
  int status = parse_job(&only, o);
  if (status) return status;
  if (o->n_operands) return usage("bench takes no operand, not %.200s", o->operand[0]);
  struct diag d;
  struct model m;
  struct bench_result r = {.quick = o->quick};
  diag_init(&d);
  model_init(&m);
  bool ok = load_model(&m, data, o, &d) && (!o->out || folder_make(o->out, &d));
  if (ok) {
    status = run_jobs(&r, only, &(struct bench_env){&m});
    ok = deliver(&r, o, &d);
  }
  if (!ok) status = bad_input(&d);
  bench_result_clear(&r);
  model_clear(&m);
  return status;
}
