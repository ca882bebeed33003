/* stickslip bench: error against run time, job by job, and studies; tables to the standard output, files with --out. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/arena.h"
#include "bench/bench.h"
#include "cli.h"

static const char verdicts[] = "verdicts"; /* a job of its own kind, the last */
static const char studies[] = "studies";   /* all but those apart; only run when asked for */

static int parse_job(const struct options *o) {
  struct text names;
  const char *job = option(o, OPT_JOB);
  bool known = !job || strcmp(job, verdicts) == 0 || strcmp(job, studies) == 0;
  text_init(&names);
  for (int i = 0; i < n_bench_jobs; i++) {
    known = known || strcmp(job, bench_jobs[i]->id) == 0;
    text_printf(&names, "%s, ", bench_jobs[i]->id);
  }
  for (int i = 0; i < n_bench_studies; i++) {
    known = known || strcmp(job, bench_studies[i]->id) == 0;
    text_printf(&names, "%s, ", bench_studies[i]->id);
  }
  if (!known) text_printf(&names, "%s, %s, not %.200s", studies, verdicts, job);
  int status = known ? EXIT_AS_RECORDED : usage("--job takes one of %s", text_str(&names));
  text_clear(&names);
  return status;
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

/* Adds "name" + suffix with its text to the files of a folder. */
struct files {
  const char *folder;
  struct text written; /* names, each between two bars */
  struct diag *d;
  bool ok;
};

static void put(struct files *f, const char *name, const char *suffix, const struct text *body) {
  struct text file, path;
  text_init(&file);
  text_init(&path);
  text_printf(&file, "%s%s", name, suffix);
  join_path(&path, f->folder, text_str(&file));
  f->ok = f->ok && file_write(text_str(&path), text_str(body), body->len, f->d);
  text_printf(&f->written, "|%s|", text_str(&file));
  text_clear(&path);
  text_clear(&file);
}

/* A file that an earlier run wrote and this one does not would be taken for a result of this one. */
static void remove_if_stale(const struct files *f, const char *name, const char *suffix) {
  struct text mark, path;
  text_init(&mark);
  text_init(&path);
  text_printf(&mark, "|%s%s|", name, suffix);
  if (!strstr(text_str(&f->written), text_str(&mark))) {
    join_path(&path, f->folder, name);
    text_add(&path, suffix);
    remove(text_str(&path));
  }
  text_clear(&path);
  text_clear(&mark);
}

/* A folder with a bench.json is one of ours. */
static bool is_report(const char *folder) {
  struct text path;
  struct stat st;
  text_init(&path);
  join_path(&path, folder, "bench.json");
  bool there = stat(text_str(&path), &st) == 0;
  text_clear(&path);
  return there;
}

static void remove_stale(const struct files *f) {
  static const char *const suffix[] = {".md", ".tsv", ".svg", "-steps.svg"};
  for (size_t k = 0; k < sizeof suffix / sizeof *suffix; k++) {
    for (int i = 0; i < n_bench_jobs; i++) remove_if_stale(f, bench_jobs[i]->id, suffix[k]);
    remove_if_stale(f, verdicts, suffix[k]);
  }
}

/* Notes a figure that gnuplot has written, and takes out what makes it large.  One that cannot be read stays as it
   is. */
static void take_figure(struct files *f, const char *name, const char *suffix) {
  struct text path, body;
  struct source svg;
  struct diag d;
  enum { MOST = 1 << 24 };
  diag_init(&d);
  text_init(&path);
  text_init(&body);
  join_path(&path, f->folder, name);
  text_add(&path, suffix);
  if (source_read(&svg, text_str(&path), MOST, &d)) {
    bench_squeeze(&body, svg.text);
    put(f, name, suffix, &body);
    source_clear(&svg);
  } else {
    text_printf(&f->written, "|%s%s|", name, suffix);
  }
  text_clear(&body);
  text_clear(&path);
}

static void no_figures(void) {
  fputs("stickslip: no figures: gnuplot is not installed, or failed\n", stderr);
}

/* false when gnuplot is not there or fails: then there are no figures at all. */
static bool draw_all(struct files *f, const struct bench_result *r) {
  struct text body;
  bool drawn = f->ok;
  text_init(&body);
  for (int i = 0; i < r->n && drawn; i++) {
    text_reset(&body);
    bench_gnuplot(&body, &r->table[i]);
    drawn = bench_draw(f->folder, &body);
    if (drawn) take_figure(f, r->table[i].job->id, ".svg");
    if (drawn && bench_has_steps(&r->table[i])) take_figure(f, r->table[i].job->id, "-steps.svg");
  }
  text_reset(&body);
  if (r->verdicts.n > 0 && drawn) {
    bench_verdicts_gnuplot(&body, &r->verdicts);
    drawn = bench_draw(f->folder, &body);
    if (drawn) take_figure(f, verdicts, ".svg");
  }
  if (!drawn) text_reset(&f->written);
  if (!drawn) no_figures();
  text_clear(&body);
  return drawn;
}

/* ID.md, ID-TABLE.tsv and, with gnuplot, ID.svg. */
static void write_study(struct files *f, const struct study_page *page) {
  struct text body, name;
  text_init(&body);
  text_init(&name);
  for (int i = 0; i < page->n; i++) {
    text_reset(&name);
    text_printf(&name, "%s-%s", page->study->id, page->table[i].id);
    put(f, text_str(&name), ".tsv", &page->table[i].tsv);
  }
  bool figure = f->ok && page->plot.len > 0 && bench_draw(f->folder, &page->plot);
  if (page->plot.len > 0 && !figure) no_figures();
  bench_study_markdown(&body, page, figure);
  put(f, page->study->id, ".md", &body);
  text_clear(&name);
  text_clear(&body);
}

/* The figures first: the pages show those that there are. */
static bool write_files(const char *folder, const struct bench_result *r, struct diag *d) {
  struct text body;
  struct files f = {.folder = folder, .d = d, .ok = folder_make(folder, d)};
  bool again = is_report(folder);
  text_init(&body);
  text_init(&f.written);
  bool drawn = draw_all(&f, r);
  for (int i = 0; i < r->n; i++) {
    const char *id = r->table[i].job->id;
    text_reset(&body);
    bench_tsv(&body, &r->table[i]);
    put(&f, id, ".tsv", &body);
    text_reset(&body);
    bench_job_markdown(&body, &r->table[i], drawn);
    put(&f, id, ".md", &body);
  }
  for (int i = 0; i < r->n_pages; i++) write_study(&f, &r->page[i]);
  text_reset(&body);
  bench_verdicts_tsv(&body, &r->verdicts);
  if (r->verdicts.n > 0) put(&f, verdicts, ".tsv", &body);
  text_reset(&body);
  bench_markdown(&body, r, true, drawn);
  if (has_jobs(r)) put(&f, "bench", ".md", &body);
  text_reset(&body);
  bench_json(&body, r);
  if (has_jobs(r)) put(&f, "bench", ".json", &body);
  if (f.ok && again && has_jobs(r)) remove_stale(&f);
  text_clear(&f.written);
  text_clear(&body);
  return f.ok;
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
  struct text body;
  const char *folder = option(o, OPT_OUT);
  if (folder && !write_files(folder, r, d)) return false;
  text_init(&body);
  if (option(o, OPT_JSON))
    bench_json(&body, r);
  else if (has_jobs(r))
    bench_markdown(&body, r, false, false);
  for (int i = 0; i < r->n && !option(o, OPT_JSON); i++) {
    text_add(&body, "\n");
    bench_job_markdown(&body, &r->table[i], false);
  }
  for (int i = 0; i < r->n_pages && !option(o, OPT_JSON); i++) bench_study_markdown(&body, &r->page[i], false);
  fputs(text_str(&body), stdout);
  if (folder) say_written(o, folder);
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
         claims_load_data(&in->claims, data, "claims", "claim", d) &&
         claims_load_data(&in->controls, data, "controls", "control", d);
}

static void inputs_clear(struct inputs *in) {
  claims_clear(&in->controls);
  claims_clear(&in->claims);
  model_clear(&in->model);
  scene_clear(&in->scene);
}

/* JOB-inputs.tsv for whoever wants to try a method of his own, or to recheck an error. */
static int write_inputs(const struct options *o, struct diag *d) {
  const char *folder = option(o, OPT_INPUTS);
  struct files f = {.folder = folder, .d = d, .ok = folder_make(folder, d)};
  struct text body;
  int status = EXIT_AS_RECORDED;
  text_init(&f.written);
  text_init(&body);
  for (int i = 0; i < n_bench_jobs && f.ok; i++) {
    if (!asked_for(o, bench_jobs[i]->id)) continue;
    text_reset(&body);
    if (!bench_inputs(&body, bench_jobs[i], option(o, OPT_QUICK))) status = no_inputs(bench_jobs[i]);
    put(&f, bench_jobs[i]->id, "-inputs.tsv", &body);
  }
  text_clear(&body);
  text_clear(&f.written);
  if (f.ok) say_written(o, folder);
  return f.ok ? status : bad_input(d);
}

static int measure(const struct options *o, const char *data, struct diag *d) {
  struct inputs in;
  struct bench_result r = {.quick = option(o, OPT_QUICK)};
  int status = EXIT_AS_RECORDED;
  const char *peers = option(o, OPT_PEERS), *folder = option(o, OPT_OUT);
  bool ok = inputs_load(&in, data, o, d) && (!peers || bench_peers_read(&r.peers, peers, d)) &&
            (!folder || folder_possible(folder, d));
  if (ok) {
    status = run_jobs(&r, o, &(struct bench_env){&in.model, &in.claims, &in.controls, &in.scene, data});
    ok = deliver(&r, o, d);
  }
  bench_result_clear(&r);
  inputs_clear(&in);
  return ok ? status : bad_input(d);
}

int run_bench(const struct options *o, const char *data) {
  int status = parse_job(o);
  struct diag d;
  diag_init(&d);
  if (status) return status;
  if (o->operands.n) return usage("bench takes no operand, not %.200s", o->operands.word[0]);
  bool inputs = option(o, OPT_INPUTS);
  if (inputs && option(o, OPT_JOB) && strcmp(option(o, OPT_JOB), verdicts) == 0)
    return usage("--inputs: the job %s has none", verdicts);
  if (inputs && (option(o, OPT_OUT) || option(o, OPT_JSON) || option(o, OPT_PEERS)))
    return usage("--inputs goes with --job and --quick alone%s", "");
  return inputs ? write_inputs(o, &d) : measure(o, data, &d);
}
