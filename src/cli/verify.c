/* stickslip verify: load, audit, write, say. */
#include <time.h>
#include <unistd.h>

#include "cli.h"
#include "stickslip/report.h"

static void show_progress(void *arg, size_t done, size_t total, const char *id) {
  (void)arg;
  fprintf(stderr, "\r\033[K[%zu/%zu] %s", done + 1, total, id);
}

static bool write_reports(const char *folder, const struct audit_result *r, double seconds, struct diag *d) {
  static const struct {
    const char *name;
    void (*write)(struct text *out, const struct audit_result *r);
  } files[] = {{"audit.json", report_json}, {"audit.md", report_markdown}, {"audit.csv", report_csv},
               {"claims.dot", report_dot},  {"errata.md", report_errata},  {"errata.tex", report_errata_tex},
               {"index.html", report_html}, {"junit.xml", report_junit},   {"run.json", NULL}};
  enum { N = sizeof files / sizeof *files };
  struct text path[N], body[N];
  struct file_item item[N];
  for (int i = 0; i < N; i++) {
    text_init(&path[i]);
    text_init(&body[i]);
    if (files[i].write)
      files[i].write(&body[i], r);
    else
      report_run(&body[i], r, seconds);
  }
  for (int i = 0; i < N; i++) {
    join_path(&path[i], folder, files[i].name);
    item[i] = (struct file_item){text_str(&path[i]), text_str(&body[i]), body[i].len};
  }
  bool ok = folder_make(folder, d) && files_write(item, N, d);
  for (int i = 0; i < N; i++) {
    text_clear(&body[i]);
    text_clear(&path[i]);
  }
  return ok;
}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void print_surprises(const struct audit_result *r) {
  for (size_t i = 0; i < r->n_findings; i++) {
    const struct finding *f = &r->findings[i];
    if (f->recorded != N_VERDICTS && f->recorded != f->verdict)
      printf("%s: %s, recorded as %s\n", f->id, verdict_name[f->verdict], verdict_name[f->recorded]);
  }
  for (size_t i = 0; i < r->n_pairs; i++)
    if (!r->pairs[i].within)
      printf("routes %s and %s: %s, beyond %s\n", r->pairs[i].first, r->pairs[i].second, r->pairs[i].quantity,
             r->pairs[i].stated);
  for (size_t i = 0; i < r->n_long_runs; i++)
    if (!r->long_runs[i].obeys || !r->long_runs[i].displaced)
      printf("long runs beside %s: not as tr J = %s says\n", r->long_runs[i].orbit, r->long_runs[i].multiplier);
  for (size_t i = 0; i < r->n_controls; i++)
    if (!r->controls[i].noticed)
      printf("control %s: %s, must be refuted\n", r->controls[i].id, verdict_name[r->controls[i].verdict]);
}

static void print_result(const struct audit_result *r, bool quiet) {
  struct text line;
  text_init(&line);
  report_line(&line, r);
  if (!quiet)
    for (size_t i = 0; i < r->n_findings; i++)
      if (verdict_fails(r->findings[i].verdict) || r->findings[i].verdict == VERDICT_UNKNOWN)
        printf("%-11s %-16s %s\n", verdict_name[r->findings[i].verdict], r->findings[i].id, r->findings[i].title);
  print_surprises(r);
  puts(text_str(&line));
  text_clear(&line);
}

static int verify_scene(const struct model *m, const struct claims *claims, const struct claims *controls,
                        const char *spec, const char *data, const struct options *o, bool many, struct diag *d) {
  struct scene s;
  struct audit_result r;
  struct text folder;
  audit_result_init(&r);
  text_init(&folder);
  double start = now();
  bool terminal = isatty(STDERR_FILENO) && !o->quiet;
  struct audit_options opt = {o->only, o->n_only, terminal ? show_progress : NULL, NULL, true};
  int status = EXIT_AS_RECORDED;
  bool ok = scene_load_box(&s, spec, data, d);
  ok = ok && audit_run(&r, m, claims, controls, &s, &opt, d);
  if (terminal) fputs("\r\033[K", stderr);
  if (ok && o->out && many)
    text_printf(&folder, "%s/%s", o->out, s.name);
  else if (ok && o->out)
    text_add(&folder, o->out);
  else if (ok)
    text_printf(&folder, "reports/%s", s.name);
  ok = ok && write_reports(text_str(&folder), &r, now() - start, d);
  if (!ok) status = bad_input(d);
  if (ok) {
    print_result(&r, o->quiet);
    long count[N_VERDICTS];
    audit_result_count(&r, count);
    if (audit_result_unexpected(&r))
      status = EXIT_DIFFERS;
    else if (o->strict && (count[VERDICT_REFUTED] || count[VERDICT_CONDITIONAL] || count[VERDICT_UNKNOWN]))
      status = EXIT_STRICT;
  }
  scene_clear(&s);
  text_clear(&folder);
  audit_result_clear(&r);
  return status;
}

/* A worse status wins: bad input, then a difference from the record, then what --strict says. */
static int worse(int a, int b) {
  static const int order[] = {EXIT_INPUT, EXIT_DIFFERS, EXIT_STRICT, EXIT_AS_RECORDED};
  for (size_t i = 0; i < sizeof order / sizeof *order; i++)
    if (a == order[i] || b == order[i]) return order[i];
  return a;
}

int run_verify(const struct options *o, const char *data) {
  slong digits;
  int status = parse_digits(&digits, o);
  if (status) return status;
  struct diag d;
  struct model m;
  struct claims claims = {.n = 0}, controls = {.n = 0};
  diag_init(&d);
  model_init(&m);
  bool ok = load_model(&m, data, o, &d) && load_claims(&claims, data, "claims", "claim", &d) &&
            load_claims(&controls, data, "controls", "control", &d);
  if (!ok) status = bad_input(&d);
  static const char *const standard[] = {"paper"};
  const char *const *scene = o->n_operands ? o->operand : standard;
  int n = o->n_operands ? o->n_operands : 1;
  for (int i = 0; ok && i < n; i++) {
    diag_init(&d);
    status = worse(status, verify_scene(&m, &claims, &controls, scene[i], data, o, n > 1, &d));
  }
  claims_clear(&controls);
  claims_clear(&claims);
  model_clear(&m);
  return status;
}
