/* stickslip verify: load, audit, write, say. */
#include <gsl/gsl_version.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>

#include "bench/bench.h"
#include "claim/claim.h"
#include "claim/near.h"
#include "cli.h"
#include "report/report.h"
#include "value/title.h"

static void show_progress(void *arg, size_t done, size_t total, double share) {
  (void)arg;
  progress_show(done, total, share);
}

/* What is trusted beneath, with the versions that run. */
static void name_software(char *out, size_t size) {
  snprintf(out, size, "stickslip " SS_VERSION ", FLINT %s, MPFR %s, GSL %s, GMP %s, compiler %s", flint_version,
           mpfr_get_version(), gsl_version, gmp_version, __VERSION__);
}

static bool write_reports(const char *folder, const struct audit_result *r, double seconds, struct diag *d) {
  char software[300];
  LOCAL(audit_result, before);
  OWNED(source) old = {.name = NULL};
  OWNED(text) path = {0};
  struct diag unread = {0};
  if (!folder_make(folder, d)) return false;
  text_printf(&path, "%s/audit.json", folder);
  bool replaces = source_read(&old, text_str(&path), LARGEST_AUDIT, &unread) && report_read(&before, &old, &unread);
  name_software(software, sizeof software);
  OWNED(output) out;
  output_init(&out, folder);
  struct mutation_score score;
  bool ok = output_add_report(&out, r, score_beside(&score, folder, r) ? &score : NULL, d);
  report_run(output_add(&out, "run.json"), r, seconds, software);
  output_add_tables(&out, r);
  ok = ok && output_write(&out, d);
  for (size_t i = 0; ok && replaces && i < before.n_tables; i++)
    output_remove_stale(&out, "%s", before.tables[i].name); /* letters, as report_read has seen */
  return ok;
}

static void print_surprises(const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (finding_unexpected(f))
      printf("%s: %s, recorded as %s\n", f->id, verdict_name[f->verdict], verdict_name[f->recorded]);
    if (finding_miscorrected(f))
      printf("%s: the correction is %s: %s\n", f->id, verdict_name[f->correction_verdict], f->correction);
  }
  for (size_t i = 0; i < r->n_pairs; i++)
    if (!r->pairs[i].within)
      printf("routes %s and %s: %s, beyond %s\n", r->pairs[i].first, r->pairs[i].second, r->pairs[i].quantity,
             r->pairs[i].stated);
  for (size_t i = 0; i < r->n_long_runs; i++)
    if (long_result_fails(&r->long_runs[i]))
      printf("long runs beside %s: not as tr J = %s says\n", r->long_runs[i].orbit, r->long_runs[i].multiplier);
  for (size_t i = 0; i < r->n_controls; i++)
    if (!r->controls[i].noticed)
      printf("control %s: %s, must be refuted\n", r->controls[i].id, verdict_name[r->controls[i].verdict]);
  for (size_t i = 0; i < r->n_controls; i++)
    if (control_is_far(&r->controls[i]))
      printf("control %s: it changes what it damages by %s, and says %s\n", r->controls[i].id, r->controls[i].distance,
             r->controls[i].near);
}

/* The last line is the contract's, so that where it is written stands before it. */
static void print_result(const struct audit_result *r, const struct options *o, const char *folder) {
  bool quiet = option(o, OPT_QUIET);
  if (!quiet) verify_tables(r, option(o, OPT_ONLY));
  print_surprises(r);
  if (!quiet) say_written(o, folder);
  verify_line(r);
}

/* What the scenes of one command share. */
struct verify_data {
  struct paper_files files;
  struct costs costs;
  slong digits;
};

/* Whether discrepancies or unknowns remain. */
static bool remains(const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++)
    if (verdict_fails(r->findings[i].verdict) || r->findings[i].verdict == VERDICT_UNKNOWN) return true;
  return false;
}

/* Judges the scene, writes its reports, says what they say. */
static int audit_scene(const struct verify_data *v, const struct scene *s, const struct options *o, const char *folder,
                       const struct audit_options *opt, double start, struct diag *d) {
  LOCAL(audit_result, r);
  bool ok = audit_run(&r, &v->files.model, &v->files.claims, &v->files.controls, s, opt, d);
  if (opt->progress) progress_end();
  ok = ok && write_reports(folder, &r, bench_now() - start, d);
  int status = ok ? EXIT_AS_RECORDED : bad_input(d);
  if (ok) {
    print_result(&r, o, folder);
    if (audit_result_unexpected(&r))
      status = EXIT_DIFFERS;
    else if (option(o, OPT_STRICT) && remains(&r))
      status = EXIT_STRICT;
  }
  return status;
}

/* Where a scene's reports go: the folder of --out, or one in it where there are several. */
static void print_folder(struct text *out, const struct options *o, const char *folder) {
  const char *out_folder = option(o, OPT_OUT);
  if (out_folder && o->operands.n <= 1)
    text_add(out, out_folder);
  else
    text_printf(out, "%s/%s", out_folder ? out_folder : "reports", folder);
}

static int verify_scene(const struct verify_data *v, const char *spec, const char *data, const struct options *o,
                        int jobs, struct diag *d) {
  OWNED(scene) s;
  OWNED(text) folder = {0};
  double start = bench_now();
  interrupt_next();
  bool terminal = progress_wanted() && !option(o, OPT_QUIET);
  progress_begin();
  struct audit_options opt = {.only = o->given[OPT_ONLY].word,
                              .n_only = o->given[OPT_ONLY].n,
                              .progress = terminal ? show_progress : NULL,
                              .readings = true,
                              .jobs = jobs,
                              .costs = &v->costs,
                              .statements = &v->files.statements,
                              .roots = &v->files.roots,
                              .seconds_now = bench_now};
  int status;
  if (!load_scene(&s, spec, data, o, SCENE_OF_TWO_MASSES, d) || !scene_four_phases(&s, d)) {
    status = bad_input(d);
  } else if (option(o, OPT_PLAN)) {
    status = show_plan(&v->files.model, &v->files.claims, &v->files.controls, &s, &opt, option(o, OPT_JSON), d);
  } else {
    if (option(o, OPT_DIGITS)) s.asked.digits = v->digits; /* of the values that the scene asks for */
    print_folder(&folder, o, s.folder);
    status = audit_scene(v, &s, o, text_str(&folder), &opt, start, d);
  }
  return status;
}

/* Of two scenes whose reports would stand in one folder, only the last would leave any. */
static int check_folders(const struct options *o) {
  const struct scene_overrides set = {o->given[OPT_SET].word, o->given[OPT_SET].n, "--set"};
  int status = EXIT_AS_RECORDED;
  for (int i = 1; i < o->operands.n && !option(o, OPT_PLAN) && !status; i++) {
    FREED char *mine = scene_folder(o->operands.word[i], &set);
    for (int k = 0; k < i && !status; k++) {
      FREED char *other = scene_folder(o->operands.word[k], &set);
      if (strcmp(mine, other) == 0) {
        OWNED(text) t = {0};
        text_printf(&t, "%.200s and %.200s would both write to ", o->operands.word[k], o->operands.word[i]);
        print_folder(&t, o, mine);
        status = usage("%.800s; verify them one at a time, each with an --out of its own", text_str(&t));
      }
    }
  }
  return status;
}

/* A worse status wins: bad input, then a difference from the record, then what --strict says. */
static int worse(int a, int b) {
  static const int order[] = {EXIT_INPUT, EXIT_DIFFERS, EXIT_STRICT, EXIT_AS_RECORDED};
  for (size_t i = 0; i < sizeof order / sizeof *order; i++)
    if (a == order[i] || b == order[i]) return order[i];
  return a;
}

/* No verdict rests on what the work may cost: without the table it is only not estimated. */
static void load_costs(struct costs *c, const char *data) {
  OWNED(text) path = {0};
  struct diag d = {0};
  join_path(&path, data, "costs.tsv");
  if (!costs_load(c, text_str(&path), &d)) fprintf(stderr, "stickslip: warning: no cost is estimated: %s\n", d.message);
}

static bool load_all(struct verify_data *v, const struct options *o, const char *data, struct diag *d) {
  return load_files(&v->files, data, o, d) &&
         data_check(&(struct audit_data){&v->files.model, &v->files.claims, &v->files.controls, &v->files.statements,
                                         &v->files.roots},
                    d) &&
         titles_check(&v->files.model, &v->files.claims, d) &&
         near_controls_add(&v->files.model, &v->files.claims, &v->files.controls, d) &&
         formulas_have_controls(&v->files.model, &v->files.claims, &v->files.controls, d);
}

int run_verify(const struct options *o, const char *data, struct diag *d) {
  const char *out = option(o, OPT_OUT);
  bool plan = option(o, OPT_PLAN);
  int jobs;
  double seconds;
  struct verify_data v = {.digits = 0};
  int status = parse_digits(&v.digits, o, MAX_DIGITS);
  if (!status) status = parse_jobs(&jobs, o);
  if (!status) status = parse_decimal(&seconds, o, OPT_TIMEOUT, MOST_SECONDS);
  if (status) return status;
  if (option(o, OPT_JSON) && !plan) return usage("verify takes --json with --plan alone; audit.json is always written");
  status = check_folders(o);
  if (status) return status;
  paper_files_init(&v.files);
  if (!interrupt_begin(seconds)) return usage("--timeout %.200s: the clock cannot be set", option(o, OPT_TIMEOUT));
  bool ok = (!out || plan || folder_possible(out, d)) && load_all(&v, o, data, d);
  if (ok) load_costs(&v.costs, data);
  static const char *const standard[] = {"paper"};
  const char *const *scene = o->operands.n ? o->operands.word : standard;
  int n = o->operands.n ? o->operands.n : 1;
  for (int i = 0; ok && i < n; i++) {
    struct diag own = {0};
    status = worse(status, verify_scene(&v, scene[i], data, o, jobs, &own));
  }
  costs_clear(&v.costs);
  paper_files_clear(&v.files);
  interrupt_end();
  return status;
}
