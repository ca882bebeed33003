/* Computing what is asked and nothing else: the same bytes by any number of processes, alone and together; budgets,
   routes and values that scenes ask for; the plan; ends from outside. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <signal.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/work.h"
#include "claim/claim.h"
#include "command.h"
#include "every.h"
#include "paper_model.h"
#include "process.h"
#include "record/finding.h"
#include "record/routes.h"
#include "report/report.h"
#include "run/plan.h"
#include "run/tasks.h"
#include "stability/precision.h"
#include "test.h"
#include "value/expression.h"
#include "whole.h"

static struct costs costs;

static void load(void) {
  paper_open();
  goes_well(costs_load(&costs, "verify/costs.tsv", &d));
}

static void unload(void) {
  costs_clear(&costs);
  paper_close();
}

/* An audit as asked; jobs processes, the costs known or not. */
static struct audit_result audit(const struct scene *s, const char *const *only, int n_only, int jobs) {
  struct audit_options opt = paper_options(only, n_only, jobs);
  struct audit_result r;
  opt.costs = jobs == 1 ? NULL : &costs;
  audit_result_init(&r);
  goes_well(audit_run(&r, &the_paper.model, &the_paper.claims, &the_paper.controls, s, &opt, &d));
  return r;
}

/* The paper's whole audit, which others are held against; read once, and kept to the end. */
static struct audit_result whole;

/* The pieces that the work was done in are in run.json. */
static void read_spent(struct audit_result *r) {
  char *text = file_text(scratch_path("whole/paper/run.json")), *end = strstr(text, "\n  ],");
  for (const char *p = strstr(text, "\"what\": "); p && p < end; p = strstr(p + 1, "\"what\": "))
    *SS_PUSH(r->spent, r->n_spent, r->cap_spent) =
        (struct piece_spent){result_str(r, "%s", member(p, "what")), result_str(r, "%s", member(p, "name")), 0, 0};
  free(text);
}

static void load_and_read(void) {
  load();
  if (whole.n_findings > 0) return;
  scratch_open();
  whole_open();
  whole_record(&whole);
  read_spent(&whole);
  scratch_close();
}

static char *json_of(const struct audit_result *r) {
  struct text t = {0};
  report_json(&t, r);
  report_markdown(&t, r);
  return t.data;
}

static void same_report(const struct audit_result *a, const struct audit_result *b, const char *what) {
  FREED char *x = json_of(a), *y = json_of(b);
  ck_assert_msg(strcmp(x, y) == 0, "%s", what);
}

/* A scene that asks for these; the lists are borrowed. */
static struct scene asking(const char **claim, size_t n_claims, const char **route, size_t n_routes,
                           unsigned long long budget) {
  struct scene s = the_paper.scene;
  s.asked.claims = (struct scene_list){.item = (char **)(uintptr_t)claim, .n = n_claims};
  s.asked.routes = (struct scene_list){.item = (char **)(uintptr_t)route, .n = n_routes};
  s.asked.budget = budget;
  return s;
}

/* NULL when it is not skipped. */
static const char *why_skipped(const struct audit_result *r, const char *what) {
  for (size_t i = 0; i < r->n_skipped; i++)
    if (strstr(r->skipped[i].what, what)) return r->skipped[i].why;
  return NULL;
}

CASE("plan", .each = {scratch_open, scratch_close}, .once = {load, unload});

/* What an audit leaves out for want of forces or of orbits: the reason is the scene's own. */
TEST(what_is_left_out_has_its_reason) {
  static const struct {
    const char *data, *why[2];
  } row[] = {
      {"chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = [1.812, 2.1]",
       {"the scene gives intervals", "the scene gives intervals"}},
      {"chi = 0.8\neta = 1\nV = 1\nt_b = 3.5\nt_c = 1",
       {"the scene does not give e1 and e2", "the scene does not give e1 and e2"}},
      {"chi = 0.58\neta = 7.8\nV = 2.3\ne1 = 4.02\ne2 = 0.287", {"no orbit was found", NULL}},
  };
  static const char *const what[] = {"long runs beside the scene's own orbit", "the routes on the scene's own orbits"};
  const struct claims none = {.n = 0};
  for (size_t i = 0; i < COUNT(row); i++) {
    OWNED(scene) s;
    LOCAL(audit_result, r);
    goes_well(
        scene_load_with(&s, scratch_print("own.scene", "%s\n", row[i].data), "verify", NULL, SCENE_OF_TWO_MASSES, &d));
    goes_well(audit_run(&r, &the_paper.model, &none, &none, &s, &(struct audit_options){.jobs = 1}, &d));
    for (int k = 0; k < 2; k++) {
      const char *why = why_skipped(&r, what[k]);
      ck_assert_msg(row[i].why[k] ? why && strcmp(why, row[i].why[k]) == 0 : !why, "%s: %s: %s", row[i].data, what[k],
                    why ? why : "done");
    }
  }
}

/* --- The same bytes --- */

/* The whole audit by one process, by two and by seven: check_report.c and check_cli.c. */
TEST(jobs_change_no_byte) {
  const char *group[] = {"text-56-deduced",  "eq-3",    "eq-13",       "eq-31",         "eq-32b",       "eq-36b",
                         "num-t_a",          "num-t_b", "num-z10",     "text-periodic", "text-letters", "fig-3",
                         "text-free-index",  "eq-57",   "kind number", "eq-10",         "eq-40",        "text-scaling",
                         "section stability"};
  enum { ALL = COUNT(group), CHEAP = 14 };
  const struct scene s = asking(group, every_case() ? ALL : CHEAP, NULL, 0, 0);
  OWNED(audit_result) one = audit(&s, NULL, 0, 1);
  ck_assert_uint_gt(one.n_findings, 12);
  ck_assert_uint_gt(one.n_consequences, 3);
  OWNED(audit_result) r = audit(&s, NULL, 0, 7);
  same_report(&r, &one, "seven processes have another report");
}

/* What the report says of these findings, and nothing else. */
static char *findings_alone(const struct audit_result *r, const struct audit_result *like) {
  struct audit_result part = {.scene = r->scene, .title = r->title};
  for (size_t i = 0; i < like->n_findings; i++)
    *SS_PUSH(part.findings, part.n_findings, part.cap_findings) = *finding_with_id(r, like->findings[i].id);
  struct text t = {0};
  report_json(&t, &part);
  free(part.findings);
  return t.data;
}

/* Every step-th claim, and of_each: the first of each kind; with the controls, which are then judged too, or without.
   The study of readings, which takes a quarter of a second, is needed by printed numbers alone. */
static void check_alone(int step, bool of_each, const struct claims *with, bool readings) {
  bool met[N_KINDS] = {false};
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    LOCAL(audit_result, alone);
    const enum kind kind = claim_kind(&the_paper.claims.claim[i]);
    const bool first = of_each && !met[kind];
    met[kind] = true;
    if (i % (size_t)step != 0 && !first) continue;
    struct audit_options opt = paper_options(&the_paper.claims.claim[i].id, 1, 1);
    opt.readings = readings || kind == KIND_NUMBER; /* its note is of them */
    goes_well(audit_run(&alone, &the_paper.model, &the_paper.claims, with, &the_paper.scene, &opt, &d));
    FREED char *a = findings_alone(&alone, &alone), *b = findings_alone(&whole, &alone);
    ck_assert_msg(strcmp(a, b) == 0, "%s", the_paper.claims.claim[i].id);
  }
}

CASE("whole", .each = {scratch_open, scratch_close}, .once = {load_and_read, unload});

TEST(some_claims_are_the_same_alone) {
  check_alone(every_case() ? 23 : 61, false, &the_paper.controls, true);
}

CASE("long", .once = {load_and_read, unload}, .seconds = 600, .tags = "long");

TEST(every_claim_is_the_same_alone) {
  const struct claims none = {.n = 0};
  check_alone(every(200), true, &none, false);
}

CASE("plan");

/* The first mistake in the order of the report, whoever meets it. */
TEST(mistakes_are_told_alike) {
  static const char text[] = "claim a\n  kind: matrix\n  title: a case\n  equation: 3\n  section: prediction\n  value: "
                             "d_02\n  points: params 2\n  routes: taylor\n"
                             "claim b\n  kind: wrong\n  title: y\nclaim c\n  title: z\n  kind: worse\n";
  char message[2][1000];
  OWNED(claims) own = {.n = 0};
  struct diag d = {0};
  ck_assert(claims_add_file(&own, scratch_put("own.claim", text), "claim", &d));
  const struct claims none = {.n = 0};
  for (int k = 0; k < 2; k++) {
    LOCAL(audit_result, r);
    OWNED(costs) dear = {.n = 0};
    FILE *f = fopen(scratch_path("dear.tsv"), "w");
    fputs("what\tname\tunits\tms\nclaim\ta\t1\t10\nclaim\tb\t1\t500\nclaim\tc\t1\t1000\n", f);
    fclose(f);
    ck_assert(costs_load(&dear, scratch_path("dear.tsv"), &d));
    const struct audit_options opt = {.jobs = k ? 3 : 1, .costs = &dear};
    diag_init(&d);
    ck_assert(!audit_run(&r, &the_paper.model, &own, &none, &the_paper.scene, &opt, &d));
    strcpy(message[k], d.message);
  }
  ck_assert_msg(strstr(message[0], "own.claim:10:") != NULL, "%s", message[0]);
  ck_assert_str_eq(message[0], message[1]);
}

/* --- Tasks --- */

static pid_t here;
static atomic_int *by_children; /* tasks done; in pages shared with them */
enum { BAD_NONE, BAD_DIES, BAD_GREEDY };

/* The parent would be done with everything before a process is there. */
static bool a_child_has_worked(pid_t pid) {
  (void)pid;
  return atomic_load(by_children) > 0;
}

static bool count_task(struct audit_result *part, size_t i, void *arg, struct diag *d) {
  const int *bad = arg;
  (void)d;
  if (getpid() != here && *bad == BAD_DIES && i % 3 == 0) raise(SIGKILL);
  if (getpid() != here && *bad == BAD_GREEDY && i == 1) arena_alloc(&part->arena, 48 << 20);
  audit_leave_out(part, result_str(part, "task %zu", i), getpid() == here ? "parent" : "child");
  if (getpid() != here) atomic_fetch_add(by_children, 1);
  return getpid() != here || process_until(a_child_has_worked, here);
}

/* Whatever becomes of the processes, every task is done, and its strings are at hand. */
TEST(tasks_survive_their_processes) {
  enum { N = 24 };
  double cost[N];
  for (int i = 0; i < N; i++) cost[i] = 30;
  here = getpid();
  by_children = mmap(NULL, sizeof *by_children, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ck_assert(by_children != MAP_FAILED);
  for (int bad = BAD_NONE; bad <= BAD_GREEDY; bad++) {
    LOCAL(audit_result, r);
    atomic_store(by_children, 0);
    const struct tasks t = {.n = N, .run = count_task, .arg = &bad, .cost = cost, .jobs = 4};
    FREED struct task_result *done = tasks_run(&r, &t);
    int children = 0;
    for (int i = 0; i < N; i++) {
      const char *want = formatted("task %d", i);
      ck_assert_int_eq(done[i].end, TASK_DONE);
      ck_assert_uint_eq(done[i].part.n_skipped, 1);
      ck_assert_str_eq(done[i].part.skipped[0].what, want);
      children += strcmp(done[i].part.skipped[0].why, "child") == 0;
    }
    ck_assert_int_gt(children, 0);
    ck_assert_int_lt(waitpid(-1, NULL, WNOHANG), 0); /* no process is left */
  }
  munmap(by_children, sizeof *by_children);
}

/* The parent's memory ends when a process is at work that would not end by itself. */
static bool exhausted_task(struct audit_result *part, size_t i, void *arg, struct diag *d) {
  (void)part, (void)i, (void)arg, (void)d;
  if (getpid() != here) {
    atomic_fetch_add(by_children, 1);
    for (alarm(300);;) pause();
  }
  if (process_until(a_child_has_worked, here)) ss_out_of_memory();
  return true;
}

static void run_exhausted(void) {
  const double cost[] = {100, 100, 100};
  struct audit_result r;
  setpgid(0, 0);
  here = getpid();
  audit_result_init(&r);
  tasks_run(&r, &(struct tasks){.n = 3, .run = exhausted_task, .cost = cost, .jobs = 3});
}

TEST(no_process_outlives_the_memory) {
  by_children = mmap(NULL, sizeof *by_children, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ck_assert(by_children != MAP_FAILED);
  fflush(NULL);
  pid_t pid = fork();
  ck_assert_int_ge(pid, 0);
  if (pid == 0) {
    if (freopen(scratch_path("said"), "w", stderr)) run_exhausted();
    _exit(0);
  }
  const int status = process_end(pid);
  check_says("said", "out of memory");
  FREED char *text = file_text(scratch_path("said"));
  ck_assert_msg(status == EXIT_EXHAUSTED, "%d: %.3000s", status, text);
  ck_assert_int_gt(atomic_load(by_children), 0);
  ck_assert(process_until(group_has_ended, pid));
  munmap(by_children, sizeof *by_children);
}

/* --- What is asked --- */

TEST(selections_meet) {
  const char *group[] = {"section stability"}, *only[] = {"eq-35b", "eq-13"};
  OWNED(scene) s = asking(group, 1, NULL, 0, 0);
  OWNED(audit_result) one = audit(&s, only, 2, 1);
  ck_assert_uint_eq(one.n_findings, 1);
  ck_assert_str_eq(one.findings[0].id, "eq-35b");
  const struct audit_options opt = {.only = only + 1, .n_only = 1}, all = {.n_only = 0};
  LOCAL(audit_result, r, nowhere);
  fails_with(audit_run(&r, &the_paper.model, &the_paper.claims, &the_paper.controls, &s, &opt, &d),
             "--only names no claim");
  const char *ask = "ask=section nowhere";
  goes_well(scene_load_with(&s, "paper", "verify", &(struct scene_overrides){&ask, 1, "--set"}, false, &d));
  fails_with(audit_run(&nowhere, &the_paper.model, &the_paper.claims, &the_paper.controls, &s, &all, &d),
             "--set:1:5: error: no claim is called, and no group holds, section nowhere; ");
}

static bool is_kind(const char *id, const char *kind) {
  for (size_t i = 0; i < the_paper.claims.n; i++)
    if (strcmp(the_paper.claims.claim[i].id, id) == 0)
      return strcmp(claim_get(&the_paper.claims.claim[i], "kind"), kind) == 0;
  return false;
}

/* Every step-th claim. */
static const char **some_claims(int *n, int step) {
  const char **id = ss_malloc(the_paper.claims.n * sizeof *id);
  *n = 0;
  for (size_t i = 0; i < the_paper.claims.n; i += (size_t)step) id[(*n)++] = the_paper.claims.claim[i].id;
  return id;
}

CASE("whole");

/* Every claim of the paper, whatever the budget: its verdict is that without one, or unknown as the budget ran out.
   Kinds that search, simulate or work through all formulas come to no verdict for one unit. */
TEST(no_budget_makes_a_verdict) {
  static const unsigned long long budgets[] = {1, 500, 100000};
  static const char *const costly[] = {"scaling", "reach", "argument", "criterion", "number", "rank"};
  ck_assert_uint_gt(whole.n_findings, 200);
  size_t left = whole.n_findings;
  const size_t n_budgets = every_case() ? 3 : 2; /* the last takes as long as all before */
  int n;
  FREED const char **ids = some_claims(&n, 1); /* without studies */
  for (size_t b = 0; b < n_budgets; b++) {
    size_t ended = 0;
    const struct scene s = asking(NULL, 0, NULL, 0, budgets[b]);
    OWNED(audit_result) r = audit(&s, ids, n, 1);
    ck_assert_uint_le(r.n_findings, whole.n_findings); /* restrictions come with the claim that they restrict */
    ck_assert_uint_ge(r.n_findings, the_paper.claims.n);
    for (size_t i = 0; i < r.n_findings; i++) {
      const struct finding *f = &r.findings[i], *full = finding_with_id(&whole, f->id);
      bool out = f->verdict == VERDICT_UNKNOWN && f->n_evidence == 1 && strstr(f->evidence[0].note, "exhausted");
      ck_assert_msg(out || f->verdict == full->verdict, "%s with %llu units: %s, not %s", f->id, budgets[b],
                    verdict_name[f->verdict], verdict_name[full->verdict]);
      ended += out;
      for (size_t k = 0; b == 0 && k < COUNT(costly); k++)
        ck_assert_msg(out || !is_kind(f->id, costly[k]), "%s costs nothing", f->id);
    }
    ck_assert_uint_lt(ended, left); /* fewer with more units */
    ck_assert_uint_gt(ended, 0);
    left = ended;
  }
}

CASE("plan");

/* A claim that runs out is unknown and says so; one that does not is what it is without a budget. */
TEST(budgets_count_work) {
  const char *ids[] = {"eq-27", "eq-3c", "eq-34"};
  const struct scene none = asking(ids, 3, NULL, 0, 0), tight = asking(ids, 3, NULL, 0, 20000),
                     ample = asking(ids, 3, NULL, 0, 1ULL << 40);
  OWNED(audit_result) free_of = audit(&none, NULL, 0, 1), enough = audit(&ample, NULL, 0, 2);
  OWNED(audit_result) r = audit(&tight, NULL, 0, 1), again = audit(&tight, NULL, 0, 3);
  const struct finding *f = finding_with_id(&r, "eq-34");
  ck_assert_int_eq(f->verdict, VERDICT_UNKNOWN);
  ck_assert_int_eq(f->n_evidence, 1);
  ck_assert_ptr_nonnull(strstr(f->evidence[0].note, "budget of 20000 exhausted"));
  ck_assert_int_eq(f->recorded, N_VERDICTS);
  ck_assert_int_eq(finding_with_id(&r, "eq-3c")->verdict, VERDICT_PROVED);
  same_report(&r, &again, "three processes have another report");
  same_report(&enough, &free_of, "an ample budget has another report than none");
}

/* One route is no support, and what is not asked for leaves no evidence. */
TEST(routes_are_those_asked_for) {
  static const struct {
    const char *route[2];
    enum verdict verdict;
    bool complete;
  } rows[] = {{{"balls", NULL}, VERDICT_UNKNOWN, false},
              {{"fd", NULL}, VERDICT_UNKNOWN, false},
              {{"balls", "fd"}, VERDICT_SUPPORTED, false},
              {{"balls", "exact"}, VERDICT_PROVED, false},
              {{"exact", NULL}, VERDICT_PROVED, false}};
  const char *ids[] = {"eq-27"};
  for (size_t i = 0; i < COUNT(rows); i++) {
    const char *routes[2] = {rows[i].route[0], rows[i].route[1]};
    const struct scene s = asking(ids, 1, routes, routes[1] ? 2 : 1, 0);
    OWNED(audit_result) r = audit(&s, NULL, 0, 1);
    const struct finding *f = finding_with_id(&r, "eq-27");
    ck_assert_msg(f->verdict == rows[i].verdict, "%s %s: %s", routes[0], routes[1] ? routes[1] : "",
                  verdict_name[f->verdict]);
    bool told = false;
    for (int k = 0; k < f->n_evidence; k++) {
      const struct evidence *e = &f->evidence[k];
      bool asked = strcmp(e->route, routes[0]) == 0 || (routes[1] && strcmp(e->route, routes[1]) == 0);
      bool missing = strcmp(e->route, "none") == 0 && strstr(e->note, "does not ask for");
      ck_assert_msg(asked || missing, "%s", e->route);
      told = told || missing;
    }
    ck_assert(told || f->verdict != VERDICT_UNKNOWN);
    for (size_t k = 0; k < r.n_controls; k++)
      ck_assert_msg(r.controls[k].noticed, "%s: %s", routes[0], verdict_name[r.controls[k].verdict]);
    ck_assert_int_eq(audit_result_unexpected(&r), 0);
  }
}

/* chi = 4/5 is exact; t_a rounds to the paper's corrected 0.5323 on one of the orbits. */
TEST(values_are_enclosed) {
  const char *set[] = {"values=chi, K, t_a, H(t)", "digits=30"};
  OWNED(scene) s;
  goes_well(scene_load_with(&s, "paper", "verify", &(struct scene_overrides){set, 2, "--set"}, false, &d));
  OWNED(audit_result) r = audit(&s, NULL, 0, 2);
  ck_assert_uint_eq(r.n_findings, 0);
  ck_assert_uint_eq(r.n_values, 1 + 4 + 2);
  ck_assert_str_eq(r.values[0].value, "0.800000000000000000000000000000");
  ck_assert_str_eq(r.values[0].at, "the parameters");
  ck_assert_str_eq(r.values[2].name, "K[1,2]");
  ck_assert_str_eq(r.values[5].at, "orbit 1");
  bool found = false;
  for (int k = 5; k < 7; k++) {
    ck_assert_uint_ge(strlen(r.values[k].value), 31);
    found = found || strncmp(r.values[k].value, "0.53228", 7) == 0;
  }
  ck_assert_msg(found, "%s %s", r.values[5].value, r.values[6].value);
  ck_assert(why_skipped(&r, "the value of H(t)"));
  FREED char *json = json_of(&r);
  ck_assert_ptr_nonnull(strstr(json, "\"values\": ["));
}

/* --- The first precision --- */

/* 1 - chi at chi = 1 - 3^-k has the condition number 3^k - 1: it loses 1.6 bits for each k. */
TEST(the_condition_plans_the_precision) {
  static const struct {
    ulong k;
    slong planned;
  } rows[] = {{1, 128}, {30, 192}, {50, 256}, {150, 384}};
  const struct view v = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  enum { BITS = 100, NONE = 777 };
  struct orbit_cache *cache = orbit_cache_new();
  OWNED(expression) e, zero;
  LOCAL(point, p);
  NUMBERS(arb, x);
  p.kind = POINT_PARAMS;
  goes_well(expression_open(&e, v, "1 - chi", "", &d));
  goes_well(expression_open(&zero, v, "chi - chi", "", &d));
  for (size_t i = 0; i < COUNT(rows); i++) {
    fmpz_ui_pow_ui(fmpq_denref(&p.q[Q_CHI]), 3, rows[i].k);
    fmpz_sub_ui(fmpq_numref(&p.q[Q_CHI]), fmpq_denref(&p.q[Q_CHI]), 1);
    slong prec = precision_planned(&e.tape, &p, BITS, NONE, cache);
    ck_assert_msg(prec == rows[i].planned, "k = %lu: %ld bits", rows[i].k, (long)prec);
    ck_assert_int_eq(expression_value(x, &e, &p, prec, cache), SS_OK);
    ck_assert_int_ge(arb_rel_accuracy_bits(x), BITS);
    if (i == 0) continue;
    ck_assert_int_eq(expression_value(x, &e, &p, rows[i - 1].planned, cache), SS_OK);
    ck_assert_int_lt(arb_rel_accuracy_bits(x), rows[i].planned - (slong)(1.58 * (double)rows[i].k));
  }
  ck_assert_int_eq(precision_planned(&zero.tape, &p, BITS, NONE, cache), NONE);
  orbit_cache_free(cache);
}

TEST(precisions_are_rounded_up_a_little) {
  static const slong rows[][2] = {{1, 64}, {64, 64}, {65, 128}, {1024, 1024}, {1025, 1152}, {3400, 3584}};
  for (size_t i = 0; i < COUNT(rows); i++) ck_assert_int_eq(precision_round(rows[i][0]), rows[i][1]);
}

/* Beside the flip, where trace + 1 is small, and by few digits and many: the planned precision is enough, and the many
   begin with the few. */
TEST(planned_values_need_no_more) {
  struct audit_result r[2];
  for (int k = 0; k < 2; k++) {
    const char *set[] = {"values=trace, trace_J, z10, N, J", k ? "digits=400" : "digits=25"};
    OWNED(scene) s;
    goes_well(scene_load_with(&s, "near-flip", "verify", &(struct scene_overrides){set, 2, "--set"}, false, &d));
    r[k] = audit(&s, NULL, 0, 1);
    ck_assert_uint_eq(r[k].n_precision, 1);
    ck_assert_str_eq(r[k].precision[0].what, work_ladder_name[LADDER_VALUE]);
    ck_assert_int_ge(r[k].precision[0].tried, 10); /* five at each of two orbits */
    ck_assert_int_eq(r[k].precision[0].enough, r[k].precision[0].tried);
  }
  ck_assert_uint_eq(r[0].n_values, r[1].n_values);
  for (size_t i = 0; i < r[0].n_values; i++) {
    const char *few = r[0].values[i].value, *many = r[1].values[i].value;
    ck_assert((few == NULL) == (many == NULL));
    ck_assert_msg(!few || strncmp(few, many, 22) == 0, "%s: %s, %s", r[0].values[i].name, few, many);
  }
  for (int k = 0; k < 2; k++) audit_result_clear(&r[k]);
}

/* The trace is that of tests/oracle/orbits.tsv, set paper, whose determinant is 0; omega^2 = chi eta = 4/5 in each
   section that defines it. */
TEST(values_have_their_documented_names) {
  const char *set[] = {"values=trace_J, trace, z10, omega, det_J, det_J_a", "digits=10"};
  static const char *const expected[][2] = {
      {"trace_J", "-1.023226189"}, {"trace", "-1.023226189"}, {"z10", "0.9781881442"}, {"omega", "0.8944271910"}};
  OWNED(scene) s;
  LOCAL(text, line);
  goes_well(scene_load_with(&s, "paper", "verify", &(struct scene_overrides){set, 2, "--set"}, false, &d));
  OWNED(audit_result) r = audit(&s, NULL, 0, 1);
  for (size_t i = 0; i < COUNT(expected); i++) {
    bool found = false;
    for (size_t k = 0; k < r.n_values; k++)
      found =
          found || (strcmp(r.values[k].name, expected[i][0]) == 0 && strcmp(r.values[k].value, expected[i][1]) == 0);
    ck_assert_msg(found, "%s", expected[i][0]);
  }
  for (size_t k = 0; k < r.n_values; k++)
    ck_assert(strcmp(r.values[k].name, "det_J") != 0 || r.values[k].value == NULL);
  ck_assert(why_skipped(&r, "the value of det_J_a"));
  ck_assert_uint_eq(r.n_spent, 1);
  ck_assert_str_eq(r.spent[0].name, "values");
  ck_assert_uint_gt(r.spent[0].units, 0);
  report_line(&line, &r);
  const char *end = ": 0 statements; 9 values; as recorded";
  ck_assert_uint_gt(line.len, strlen(end));
  ck_assert_str_eq(text_str(&line) + line.len - strlen(end), end);
}

/* --- What is left out --- */

/* No claim asks for a route that rests only on what another of its routes, or the balls that decide, rests on. */
TEST(no_route_is_idle) {
  size_t pairs = 0;
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    char route[8][32];
    int n = 0;
    if (!claim_tried_at_points(&the_paper.claims.claim[i])) continue;
    strcpy(route[n++], "balls");
    for (const char *q = claim_routes_asked(&the_paper.claims.claim[i]); q && *q; n++) {
      q += strspn(q, ", ");
      size_t len = strcspn(q, ", ");
      ck_assert_int_lt(n, 8);
      snprintf(route[n], sizeof route[n], "%.*s", (int)len, q);
      q += len;
    }
    for (int a = 0; a < n; a++)
      for (int b = 0; b < a; b++, pairs++)
        ck_assert_msg(strcmp(route[a], "exact") == 0 || routes_independent(route[a], route[b]), "%s: %s, %s",
                      the_paper.claims.claim[i].id, route[a], route[b]);
  }
  ck_assert_uint_gt(pairs, 100);
}

static unsigned touched_by_claim;

static void note_touched(void *arg, const char *what, const char *name, unsigned long long units) {
  (void)arg, (void)name, (void)units;
  if (strcmp(what, "claim") == 0) touched_by_claim |= work_touched();
}

static bool planned(const struct plan_list *l, const char *name) {
  for (int i = 0; i < l->n; i++)
    if (strcmp(l->item[i], name) == 0) return true;
  return false;
}

/* A claim touches nothing that its plan does not name, and the ledger denies nothing that was touched. */
TEST(plans_name_what_is_then_done) {
  for (size_t i = 0; i < the_paper.claims.n; i += (size_t)every(29)) {
    OWNED(audit_plan) p;
    LOCAL(audit_result, r);
    struct audit_options opt = {
        .only = &the_paper.claims.claim[i].id, .n_only = 1, .ended = note_touched, .costs = &costs};
    const struct claims none = {.n = 0};
    touched_by_claim = 0;
    goes_well(audit_run(&r, &the_paper.model, &the_paper.claims, &none, &the_paper.scene, &opt, &d));
    goes_well(audit_plan(&p, &the_paper.model, &the_paper.claims, &none, &the_paper.scene, &opt, &d));
    for (int part = 0; part < WORK_BITS_128; part++) {
      bool in_plan = false;
      for (int k = 0; k < p.n_claims; k++) in_plan = in_plan || planned(&p.claim[k].parts, work_part_name[part]);
      if (!(touched_by_claim >> part & 1U)) continue;
      ck_assert_msg(in_plan, "%s needs %s", opt.only[0], work_part_name[part]);
      if (part > WORK_PHASE_C)
        ck_assert_msg(!why_skipped(&r, work_part_name[part]), "%s: %s", opt.only[0], work_part_name[part]);
    }
  }
}

static bool spent(const struct audit_result *r, const char *what, const char *name) {
  for (size_t i = 0; i < r->n_spent; i++)
    if (strcmp(r->spent[i].what, what) == 0 && strcmp(r->spent[i].name, name) == 0) return true;
  return false;
}

/* An audit beside its plan: claims and controls that are left out, studies, consequences. */
static void check_plan(const struct audit_result *r, const struct scene *s, const char *const *only, int n_only) {
  OWNED(audit_plan) p;
  const struct audit_options opt = {.only = only, .n_only = n_only, .readings = true, .costs = &costs};
  size_t consequences = 0, judged = 0;
  goes_well(audit_plan(&p, &the_paper.model, &the_paper.claims, &the_paper.controls, s, &opt, &d));
  for (int i = 0; i < p.n_claims; i++) {
    const struct planned_claim *c = &p.claim[i];
    const struct finding *f = finding_with_id(r, c->id);
    if (scene_is_box(s)) ck_assert_msg(c->left_out == (f->verdict == VERDICT_SKIPPED), "%s", c->id);
    ck_assert(!c->left_out || (c->ms == 0 && c->parts.n == 0 && c->routes.n == 0 && c->controls.n == 0));
    for (int k = 0; k < c->controls.n; k++) {
      ck_assert_msg(spent(r, "control", c->controls.item[k]), "%s is planned", c->controls.item[k]);
      judged++;
    }
    if (scene_is_box(s)) ck_assert(!planned(&c->parts, work_part_name[WORK_SCENE_ORBITS]));
  }
  for (size_t i = 0; i < r->n_controls; i++) judged -= claim_named(&the_paper.controls, r->controls[i].id) != NULL;
  ck_assert_msg(judged == 0 || !scene_is_box(s), "%zu controls are planned and not judged", judged);
  for (int i = 0; i < p.n_shared; i++) {
    static const char head[] = "consequences of ";
    if (strncmp(p.shared[i].what, head, strlen(head)) != 0) continue;
    ck_assert_msg(spent(r, "consequence", p.shared[i].what + strlen(head)), "%s", p.shared[i].what);
    ck_assert(p.shared[i].ms >= 0);
    consequences++;
  }
  for (size_t i = 0; i < r->n_spent; i++) consequences -= strcmp(r->spent[i].what, "consequence") == 0;
  ck_assert_msg(consequences == 0, "%zu", consequences);
}

CASE("whole");

TEST(plans_are_of_what_runs) {
  const char *set = "e2=[0.858, 0.859]", *one[] = {"eq-32c", "num-t_a", "text-periodic", "text-several-motions"};
  OWNED(scene) box;
  goes_well(scene_load_with(&box, "paper", "verify", &(struct scene_overrides){&set, 1, "--set"}, true, &d));
  OWNED(audit_result) some = audit(&the_paper.scene, one, COUNT(one), 2);
  check_plan(&some, &the_paper.scene, one, COUNT(one));
  check_plan(&whole, &the_paper.scene, NULL, 0);
  int n_some;
  FREED const char **some_ids = some_claims(&n_some, every(13));
  OWNED(audit_result) of_box = audit(&box, some_ids, n_some, 2);
  check_plan(&of_box, &box, some_ids, n_some);
  OWNED(audit_result) one_of_box = audit(&box, one, COUNT(one), 2);
  check_plan(&one_of_box, &box, one, COUNT(one));
}

CASE("plan");

TEST(one_claim_needs_little) {
  const char *id = "eq-27";
  OWNED(audit_result) r = audit(&the_paper.scene, &id, 1, 1);
  static const char *const left[] = {"other claims",  "controls",           "routes, the long runs",
                                     "readings",      "scene's periodic",   "drawn all over",
                                     "Coulomb's law", "routes taylor, gsl", "1024 bits"};
  for (size_t i = 0; i < COUNT(left); i++) ck_assert_msg(why_skipped(&r, left[i]), "%s", left[i]);
  ck_assert(!why_skipped(&r, "phase") && !why_skipped(&r, "exact algebra"));
  /* of the formulas, those that it reaches */
  struct model_use use = {ss_malloc(the_paper.model.n_defs), ss_malloc(the_paper.model.n_records)};
  struct model noting = the_paper.model;
  memset(use.def, 0, the_paper.model.n_defs);
  memset(use.record, 0, the_paper.model.n_records);
  noting.use = &use;
  struct dependences *d = dependences_new(&noting, &the_paper.claims);
  size_t after = 0, all = 0, at = 0;
  while (strcmp(the_paper.claims.claim[at].id, "eq-27") != 0) at++;
  dependences_on(d, at, 0);
  for (size_t i = 0; i < the_paper.model.n_defs; i++) after += use.def[i];
  for (size_t a = 0; a < the_paper.claims.n; a++) dependences_on(d, a, 0);
  for (size_t i = 0; i < the_paper.model.n_defs; i++) all += use.def[i];
  ck_assert_msg(all > after + 50, "%zu of %zu", after, all);
  dependences_free(d);
  free(use.def);
  free(use.record);
}

TEST(tables_of_costs_are_read_or_refused) {
  static const char *const bad[] = {"what\tname\tunits\tms\nclaim\ta\t1\n", "x\nclaim\ta\tb\tc\n",
                                    "x\nclaim\ta\t-1\t1\n", "x\nclaim\ta\tnan\t1\n", "x\nclaim\ta\t1\t1\tmore\n"};
  struct costs c;
  for (size_t i = 0; i < COUNT(bad); i++) fails_with(costs_load(&c, scratch_put("bad.tsv", bad[i]), &d), "bad.tsv:2:");
  goes_well(costs_load(&c, scratch_path("absent.tsv"), &d));
  ck_assert(c.n == 0 && !cost_of(&c, "claim", "a"));
  const struct cost *row = cost_of(&costs, "claim", "eq-27");
  ck_assert(row && row->units > 100 && row->ms > 0);
}

/* --- The program --- */

/* The old report's bytes. */
static void old_report(const char *folder) {
  mkdir(scratch_path(folder), 0777);
  scratch_put(formatted("%s/audit.json", folder), "the old report\n");
}

static void check_old_report(const char *folder) {
  ck_assert_str_eq(scratch_list(scratch_path(folder)), "audit.json");
  check_is(formatted("%s/audit.json", folder), "the old report\n");
}

/* In the midst of the audit: the handlers are in place, that of the clock last, and it has worked for a while. */
static bool works(pid_t pid) {
  return process_catches(pid, SIGALRM) && group_seconds(pid) >= 0.05;
}
static bool works_with_others(pid_t pid) {
  return works(pid) && group_lives(pid) > 1;
}

TEST(signals_end_it) {
  static const int number[] = {SIGINT, SIGTERM};
  old_report("out");
  for (int i = 0; i < 4; i++) {
    OWNED(job) j;
    job_start_words(&j, &(struct job_place){.group = true},
                    formatted("verify paper --jobs %d --out %s", i < 2 ? 1 : 3, scratch_path("out")));
    ck_assert(process_until(i < 2 ? works : works_with_others, j.pid));
    kill(j.pid, number[i % 2]);
    job_finish(&j);
    ck_assert_msg(j.status == 5 && strstr(j.err, "interrupted"), "%d: %s", j.status, j.err);
    check_old_report("out");
    ck_assert(process_until(group_has_ended, j.pid));
  }
}
