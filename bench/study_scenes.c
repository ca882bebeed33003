/* What scenes cost: each of the library as a process of its own beside the whole audit of the paper's example, what it
   left out by its own audit.json and that audit did not, and every claim of the paper alone.  The table of costs is
   what the planner reads. */
#define _DEFAULT_SOURCE /* wait4 */
#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "bench/jobs.h"
#include "bench/study.h"
#include "run/audit.h"

/* A scene is run again only while its runs are short: the whole study takes a minute or two. */
enum { REPEATS = 3, ENOUGH_MS = 1000 };

/* --- A scene as a process --- */

struct process {
  double ms; /* the least of some runs */
  double megabytes;
  long left_out;
  struct text what; /* each with "; " before and after it */
};

static const char *program(char path[4096]) {
  const char *named = getenv("STICKSLIP");
  ssize_t n = named ? -1 : readlink("/proc/self/exe", path, 4095);
  if (n > 0) path[n] = '\0';
  return named ? named : n > 0 ? path : NULL;
}

/* One run of verify with one process; false when it has no report. */
static bool run_once(double *ms, struct rusage *used, const char *scene, const char *out) {
  char path[4096];
  const char *exe = program(path);
  double start = bench_now();
  pid_t pid = exe ? fork() : -1;
  if (pid == 0) {
    execl(exe, exe, "verify", scene, "--jobs", "1", "--quiet", "--out", out, (char *)NULL);
    _exit(127);
  }
  int status = 0;
  bool ok = pid > 0 && wait4(pid, &status, 0, used) == pid;
  *ms = 1e3 * (bench_now() - start);
  return ok && WIFEXITED(status) && WEXITSTATUS(status) <= 1;
}

/* whole: NULL, or the process whose omissions do not count. */
static void read_skipped(struct process *p, const char *out, const struct process *whole) {
  enum { MOST = 1 << 26 };
  OWNED(text) path = {0}, what = {0};
  OWNED(source) src = {.name = NULL};
  LOCAL(arena, a);
  struct json_value v;
  struct diag d = {0};
  text_printf(&path, "%s/audit.json", out);
  text_add(&p->what, "; ");
  if (source_read(&src, text_str(&path), MOST, &d)) {
    const struct json_value *list = json_parse(&v, &a, &src, &d) ? json_member(&v, "skipped") : NULL;
    for (const struct json_value *s = list ? list->first : NULL; s; s = s->next) {
      text_reset(&what);
      text_printf(&what, "; %s; ", json_text(s, "what"));
      if (whole && strstr(text_str(&whole->what), text_str(&what))) continue;
      text_add(&p->what, text_str(&what) + 2);
      p->left_out++;
    }
  }
}

/* With the files in it. */
static void remove_folder(const char *folder) {
  DIR *dir = opendir(folder);
  OWNED(text) path = {0};
  for (struct dirent *e; dir && (e = readdir(dir)) != NULL;) {
    text_reset(&path);
    text_printf(&path, "%s/%s", folder, e->d_name);
    unlink(text_str(&path));
  }
  if (dir) closedir(dir);
  rmdir(folder);
}

static bool run_scene(struct process *p, const char *scene, const struct process *whole, int repeats,
                      double enough_ms) {
  const char *tmp = getenv("TMPDIR");
  char folder[4096];
  *p = (struct process){.ms = INFINITY};
  snprintf(folder, sizeof folder, "%s/stickslip-scenes-XXXXXX", tmp && *tmp ? tmp : "/tmp");
  if (!mkdtemp(folder)) return false;
  bool ok = true;
  double ms = 0, all = 0;
  for (int i = 0; ok && i < repeats && all < enough_ms; i++, all += ms) {
    struct rusage used;
    ok = run_once(&ms, &used, scene, folder);
    p->ms = fmin(p->ms, ms);
    p->megabytes = fmax(p->megabytes, (double)used.ru_maxrss / 1024);
  }
  if (ok) read_skipped(p, folder, whole);
  remove_folder(folder);
  return ok;
}

/* What the scene file asks for, in its own words. */
static void add_list(struct text *out, const char *key, const struct scene_list *list) {
  for (size_t i = 0; i < list->n; i++)
    text_printf(out, "%s%s%s", i ? ", " : out->len ? "; " : "", i ? "" : key, list->item[i]);
}

static void describe_asked(struct text *out, const struct scene *s) {
  add_list(out, "claims ", &s->asked.claims);
  add_list(out, "values ", &s->asked.values);
  add_list(out, "routes ", &s->asked.routes);
  if (s->asked.budget) text_printf(out, "%sbudget %llu", out->len ? "; " : "", s->asked.budget);
  if (!out->len) text_add(out, "everything");
}

/* A scene of another system, or with another phase word than the paper's, has no audit, and no row. */
static bool add_scene(struct study_table *t, const char *name, const char *data, const struct process *whole,
                      int repeats) {
  OWNED(scene) s;
  OWNED(text) asked = {0};
  struct process p = {0};
  struct diag d = {0};
  bool ok = scene_load_with(&s, name, data, NULL, SCENE_OF_ANY_SYSTEM, &d);
  bool other = ok && (s.system || !scene_four_phases(&s, &d));
  ok = ok && (other || run_scene(&p, name, whole, repeats, ENOUGH_MS));
  if (ok && !other) {
    describe_asked(&asked, &s);
    const char *what = text_str(&p.what);
    study_cells(t, "%s\t%.300s\t%.3g\t%.2g\t%.3g\t%.2g\t%ld\t%.*s", name, text_str(&asked), p.ms, p.ms / whole->ms,
                p.megabytes, p.megabytes / whole->megabytes, p.left_out, (int)p.what.len - 4, what + 2);
    study_row(t);
  }
  text_clear(&p.what);
  return ok;
}

/* --- Pieces of the paper's audit --- */

struct piece_cost {
  char what[16], name[48];
  double units, ms;
};
struct clocked {
  struct piece_cost *item;
  size_t n, cap;
  double last;
  bool known; /* a run before has made the list */
  size_t at;
};

static void take_piece(void *arg, const char *what, const char *name, unsigned long long units) {
  struct clocked *c = arg;
  double now = bench_now(), ms = 1e3 * (now - c->last);
  if (!c->known) {
    struct piece_cost *p = SS_PUSH(c->item, c->n, c->cap);
    *p = (struct piece_cost){.ms = INFINITY};
    snprintf(p->what, sizeof p->what, "%s", what);
    snprintf(p->name, sizeof p->name, "%s", name);
  }
  if (c->at < c->n) {
    struct piece_cost *p = &c->item[c->at++];
    p->ms = fmin(p->ms, ms);
    p->units = (double)units;
  }
  c->last = bench_now();
}

static bool audit_once(double *ms, const struct bench_env *env, const char *const *only, struct clocked *c) {
  LOCAL(audit_result, r);
  struct diag d = {0};
  struct audit_options opt = {.only = only, .n_only = only != NULL, .readings = true};
  if (c) {
    opt.ended = take_piece;
    opt.arg = c;
    c->at = 0;
  }
  double start = bench_now();
  if (c) c->last = start;
  bool ok = audit_run(&r, env->model, env->claims, env->controls, env->scene, &opt, &d);
  *ms = fmin(*ms, 1e3 * (bench_now() - start));
  if (c) c->known = true;
  return ok;
}

static bool add_costs(struct study_page *page, const struct bench_env *env, double *together, int repeats) {
  struct clocked c = {.n = 0};
  bool ok = true;
  *together = INFINITY;
  for (int i = 0; ok && i < repeats; i++) ok = audit_once(together, env, NULL, &c);
  struct study_table *t = study_table(page, "costs", "Pieces of the paper's audit", "what\tname\tunits\tms",
                                      "In the order in which one process does them: the first to need orbits pays for "
                                      "them. Units: src/base/work.h. This table is verify/costs.tsv.");
  for (size_t i = 0; ok && i < c.n; i++) {
    study_cells(t, "%s\t%s\t%.0f\t%.2f", c.item[i].what, c.item[i].name, c.item[i].units, c.item[i].ms);
    study_row(t);
  }
  free(c.item);
  return ok;
}

/* Each claim alone, with its controls and consequences. */
static bool add_alone(struct study_page *page, const struct bench_env *env, double together, int repeats, size_t most) {
  double sum = 0, dearest = 0;
  const char *name = "";
  bool ok = true;
  size_t n = env->claims->n < most ? env->claims->n : most;
  struct study_table *t = study_table(page, "alone", "Every claim alone", "claim\tms",
                                      "As a run of its own in one "
                                      "process, with its controls and its consequences, without reading the files.");
  for (size_t i = 0; ok && i < n; i++) {
    double ms = INFINITY;
    const char *id = env->claims->claim[i].id;
    for (int k = 0; ok && k < repeats; k++) ok = audit_once(&ms, env, &id, NULL);
    study_cells(t, "%s\t%.3g", id, ms);
    study_row(t);
    sum += ms;
    if (ms > dearest) name = id;
    dearest = fmax(dearest, ms);
  }
  text_printf(&page->found,
              "- the paper's audit takes %.0f ms in one process; %zu of %zu claims, each alone, take %.0f ms together, "
              "%.2f times as\n  long; the dearest alone is %s with %.0f ms\n",
              together, n, env->claims->n, sum, sum / together, name, dearest);
  return ok;
}

static bool run(struct study_page *page, const struct bench_env *env) {
  int repeats = page->quick ? 1 : REPEATS;
  struct process whole = {0};
  double together;
  LOCAL(arena, a);
  struct diag d = {0};
  size_t n;
  FREED char **name = scene_names(&n, env->data, &a, &d);
  struct study_table *t =
      study_table(page, "scenes", "Scenes", "scene\tasked\tms\tms_ratio\tmb\tmb_ratio\tleft_out\twhat",
                  "The program from its start to its end with one process, the least of a few "
                  "runs, and its memory; ratios to the whole audit of the paper's example, beside whose omissions "
                  "stands what else is left out.");
  bool ok = n > 0 && run_scene(&whole, "paper", NULL, repeats, INFINITY);
  for (size_t i = 0; i < n; i++)
    if (ok && (!page->quick || i < 2)) ok = add_scene(t, name[i], env->data, &whole, repeats);
  text_clear(&whole.what);
  ok = ok && add_costs(page, env, &together, repeats);
  return ok && add_alone(page, env, together, repeats, page->quick ? 8 : env->claims->n);
}

const struct study study_scenes = {
    .id = "scenes",
    .title = "What scenes cost",
    .question =
        "How much does a scene that asks for less leave out, and how much less time and memory does it take than "
        "the whole\naudit? What does every claim cost alone?",
    .run = run,
    .apart = true,
};
