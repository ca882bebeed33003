/* The audit of the audit: facts about motions held against motions, processes that
   share work, mutants whose fate is known beforehand, repairs held against a run of their own; and damage to the
   oracles, entry by entry. */
#include <errno.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/crew.h"
#include "command.h"
#include "every.h"
#include "judge/judge.h"
#include "paper_model.h"
#include "power/mutants.h"
#include "power/power.h"
#include "process.h"
#include "report/mutation.h"
#include "run/audit.h"
#include "test.h"
#include "value/expression.h"

/* --- What holds on every motion --- */

static void try_facts(long *held, enum point_kind kind, bool finite) {
  LOCAL(point, p);
  struct sampler s = sampler_of("facts", (struct point_spec){.kind = kind, .phase = PHASE_H, .finite = finite});
  struct view view = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
  for (int done = 0, draws = 0; done < 4 && draws < 40; draws++) {
    sampler_next(&p, &s);
    if (!point_settle(&p, the_paper.cache)) continue;
    bool any = false;
    for (int i = 0; i < n_motion_facts; i++) {
      struct diag d = {0};
      BALLS(32, v);
      int n;
      int left = expression_at(v, &n, view, motion_facts[i][0], "", &p, 192, the_paper.cache, &d);
      int right = expression_at(v + 16, &n, view, motion_facts[i][1], "", &p, 192, the_paper.cache, &d);
      ck_assert_msg(!d.set, "%s", d.message);
      if (left == SS_OK && right == SS_OK) {
        arb_sub(v, v, v + 16, 192);
        ck_assert_msg(arb_contains_zero(v) && mag_cmp_2exp_si(arb_radref(v), -40) < 0, "%s is not %s",
                      motion_facts[i][0], motion_facts[i][1]);
        held[i]++;
        any = true;
      }
    }
    done += any;
  }
}

CASE("exact", .once = {paper_open, paper_close});

TEST(facts_hold_on_motions) {
  FREED long *held = calloc((size_t)n_motion_facts, sizeof *held);
  try_facts(held, POINT_ARC, false);
  try_facts(held, POINT_ARC, true);
  try_facts(held, POINT_ORBIT, false);
  for (int i = 0; i < n_motion_facts; i++)
    ck_assert_msg(held[i] >= 4, "%s was tried %ld times", motion_facts[i][0], held[i]);
}

/* --- Processes --- */

struct answer {
  size_t item;
  int twice;
};

static void double_it(void *result, size_t i, void *arg) {
  struct answer a = {i, 2 * *(const int *)arg + (int)i};
  memcpy(result, &a, sizeof a);
}

static void die_at_seven(void *result, size_t i, void *arg) {
  if (i == 7) raise(SIGKILL);
  double_it(result, i, arg);
}

static void leave_at_seven(void *result, size_t i, void *arg) {
  if (i == 7) _exit(0);
  double_it(result, i, arg);
}

static void no_child_is_left(void) {
  ck_assert(waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD);
}

CASE("mutate");

TEST(work_is_shared_in_order) {
  static const int jobs[] = {1, 2, 3, 7, 64};
  struct answer a[20];
  int ten = 10;
  for (size_t k = 0; k < COUNT(jobs); k++)
    for (size_t n = 0; n <= 20; n += 5) {
      memset(a, 0, sizeof a);
      goes_well(crew_results(a, sizeof *a, n, jobs[k], double_it, &ten, NULL, &d));
      for (size_t i = 0; i < n; i++) ck_assert(a[i].item == i && a[i].twice == 20 + (int)i);
      no_child_is_left();
    }
}

TEST(a_process_that_ends_early_is_noticed) {
  static crew_make *const bad[] = {die_at_seven, leave_at_seven};
  struct answer a[20];
  int ten = 10;
  for (int k = 0; k < 2; k++)
    for (int jobs = 1; jobs <= 4; jobs++) {
      fails_with(crew_results(a, sizeof *a, 20, jobs, bad[k], &ten, NULL, &d),
                 "a worker process ended before its time: ");
      no_child_is_left();
    }
}

/* --- Mutants whose fate is known --- */

static void mutate_records(struct mutation_result *r, const char *const *record, int n, const struct claims *asked,
                           int jobs) {
  mutation_result_init(r);
  const struct mutation_options opt = {.seed = 1, .jobs = jobs, .only = record, .n_only = n};
  const struct audit_data data = {&the_paper.model, asked, &the_paper.controls, NULL, NULL};
  goes_well(audit_mutate(r, &data, &the_paper.scene, &opt, &d));
}

static void mutate(struct mutation_result *r, const char *record, const struct claims *asked, int jobs) {
  mutate_records(r, &record, 1, asked, jobs);
}

static const struct survivor *survivor_of(const struct mutation_result *r, const char *text) {
  for (size_t i = 0; i < r->n_survivors; i++)
    if (strcmp(r->survivor[i].text, text) == 0) return &r->survivor[i];
  return NULL;
}

/* One run for all the fates below: every mutant of these records. */
static const char *const known_records[] = {
    "eq-27",  "eq-41",         "err-10", "eq-31",  "eq-40d",     "eq-48d", "text-mode-shapes",
    "eq-31b", "text-singular", "eq-56",  "eq-60b", "eq-51",      "eq-2",   "eq-22",
    "eq-9",   "eq-12",         "eq-1c",  "eq-10",  "text-first", "eq-57",  "text-criterion"};
enum { N_KNOWN = COUNT(known_records), N_DEAR = 2 };
static struct mutation_result known;

/* The last ones take longer than all the others, searches of orbits for each mutant. */
static int n_known(void) {
  return every_case() ? N_KNOWN : N_KNOWN - N_DEAR;
}

static bool is_known(const char *record) {
  for (int i = 0; i < n_known(); i++)
    if (strcmp(record, known_records[i]) == 0) return true;
  return false;
}

static void open_known(void) {
  paper_open();
  mutate_records(&known, known_records, n_known(), &the_paper.claims, 2);
}

static void close_known(void) {
  mutation_result_clear(&known);
  paper_close();
}

TABLE(fates, "tests/cases/mutant_fates.tsv", 3);
enum { RECORD, TEXT, EQUIVALENT }; /* its columns */

CASE("mutants", .once = {open_known, close_known}, .seconds = 300, .tags = "long");

TEST_EACH(fates_known_beforehand, fates.n) {
  char *const *row = fates.row[_i];
  const struct survivor *s = *row[TEXT] ? survivor_of(&known, row[TEXT]) : NULL;
  bool noticed = !is_yes(row[EQUIVALENT]);
  if (!is_known(row[RECORD])) return;
  for (size_t i = 0; !*row[TEXT] && i < known.n_survivors; i++)
    if (!known.survivor[i].corrected && strcmp(known.survivor[i].record, row[RECORD]) == 0)
      ck_abort_msg("%s survives", known.survivor[i].text);
  if (!*row[TEXT]) return;
  if (noticed && s) ck_assert_msg(s->corrected, "%s survives", s->text); /* the printed twin of an erratum */
  if (!noticed)
    ck_assert_msg(s && s->fate == FATE_EQUIVALENT, "%s: %s", row[TEXT], s ? mutant_fate_name[s->fate] : "noticed");
}

/* Every text in the table is one that the damages make, so that "noticed" is not the fate of what was never tried. */
TEST(every_known_fate_is_of_a_mutant) {
  OWNED(mutants) m;
  mutants_init(&m, &the_paper.model, known_records, N_KNOWN);
  for (size_t k = 0; k < (size_t)fates.n; k++) {
    bool made = !*fates.row[k][TEXT];
    for (size_t i = 0; !made && i < m.n; i++) made = strcmp(m.mutant[i].edit.text, fates.row[k][TEXT]) == 0;
    ck_assert_msg(made, "%s is no mutant", fates.row[k][TEXT]);
  }
}

TEST(the_run_adds_up_and_has_every_kind_of_damage) {
  ck_assert_int_eq(known.tried, known.population);
  long all = mutation_row_total(&known.formulas) + mutation_row_total(&known.errata);
  for (int k = 0; k < N_DAMAGE_CLASSES; k++) all += mutation_row_total(&known.data[k]);
  ck_assert_int_eq(all, known.tried);
  long of_kinds = 0;
  for (size_t i = 0; i < known.n_kinds; i++) {
    ck_assert_msg(mutation_row_noticed(&known.kind[i]) > 0, "%s", known.kind[i].name);
    of_kinds += mutation_row_total(&known.kind[i]);
  }
  ck_assert_int_eq(of_kinds, mutation_row_total(&known.formulas));
  ck_assert_int_gt(mutation_row_total(&known.errata), 0);
  ck_assert_int_eq(mutation_row_noticed(&known.errata), mutation_row_total(&known.errata));
  ck_assert_int_eq(known.formulas.count[FATE_UNDECIDED] + known.formulas.count[FATE_UNREAD],
                   known.printed.count[FATE_UNDECIDED]);
}

TEST(the_run_obeys_its_schema) {
  LOCAL(text, t);
  report_mutation_json(&t, &known);
  scratch_put("m.json", text_str(&t));
  shell_well("$Y tests/oracle/validate.py schema/mutation.schema.json $D/m.json");
  shell_well("sed 's/\"noticed\": [1-9]/&1/' $D/m.json > $D/bad.json; "
             "! $Y tests/oracle/validate.py schema/mutation.schema.json $D/bad.json > /dev/null");
}

/* Damage to printed text that is refuted anyway, as that of (10) is, shows in its restricted claim alone; it counts
   like any other, and has a row that says how many of the formulas' are such. */
TEST(printed_text_that_is_corrected_counts) {
  static const char *const record = "eq-10";
  OWNED(mutants) m;
  long printed = 0, survive = 0;
  mutants_init(&m, &the_paper.model, &record, 1);
  for (size_t i = 0; i < m.n; i++) printed += m.target[m.mutant[i].target].corrected;
  for (size_t i = 0; i < known.n_survivors; i++) {
    const struct survivor *s = &known.survivor[i];
    if (strcmp(s->record, record) != 0) continue;
    ck_assert(s->corrected == !strncmp(s->text, "D(", 2));
    survive += s->corrected;
  }
  ck_assert_int_gt(printed, 20);
  ck_assert_int_gt(printed - survive, 5);
  ck_assert_int_gt(known.printed.count[FATE_NOTICED], 5);
  ck_assert_int_ge(mutation_row_total(&known.printed), printed);
  ck_assert_int_ge(mutation_row_total(&known.formulas), mutation_row_total(&known.printed));
}

/* --- That what is noticed is the damage --- */

struct verdicts {
  enum verdict own, correction;
};

static struct verdicts verdicts_of(const struct claim *c, const struct model *m, enum effort effort,
                                   const bool *touched) {
  OWNED(audit_result) out;
  struct diag d;
  struct finding f;
  struct judge j = paper_judge(&out, m, &d, effort);
  j.touched = touched;
  ck_assert_msg(judge_verdict(&f, &j, c), "%s: %s", c->id, d.message);
  return (struct verdicts){f.verdict, f.correction ? f.correction_verdict : N_VERDICTS};
}

CASE("damage", .once = {paper_open, paper_close}, .seconds = 300);

/* Every statement replaced by a copy of itself, all at once: no claim with little effort says anything else, none that
   is asked early is refuted that is not refuted in full. */
TEST(a_copy_of_the_text_is_not_noticed) {
  OWNED(overlay) o;
  LOCAL(arena, a);
  overlay_init(&o, &the_paper.model);
  for (size_t i = 0; i < the_paper.model.n_records; i++)
    for (int k = 0; k < the_paper.model.records[i].n_stmts; k++) {
      LOCAL(text, t);
      struct diag d = {0};
      struct target target = target_of(&the_paper.model, i, k);
      struct source *src = arena_alloc(&a, sizeof *src);
      stmt_print(&t, the_paper.model.records[i].stmts[k]);
      *src = source_of("copy", arena_strndup(&a, t.data, t.len));
      const struct stmt *copy = stmt_parse(&a, src, (struct span){0, src->len}, &d);
      ck_assert_msg(copy != NULL, "%s", d.message);
      overlay_set(&o, &target, copy);
      source_clear(src);
    }
  for (size_t i = 0; i < the_paper.claims.n; i += (size_t)every(3)) {
    const struct claim *c = &the_paper.claims.claim[i];
    if (claim_asked(c) == ASKED_NEVER) continue;
    struct verdicts was = verdicts_of(c, &the_paper.model, EFFORT_REFUTE, NULL);
    struct verdicts is = verdicts_of(c, &o.model, EFFORT_REFUTE, NULL);
    ck_assert_msg(was.own == is.own && was.correction == is.correction, "%s", c->id);
  }
}

/* What little effort proves the full one proves, be it under a condition that it looks for besides; and the other way
   round: a lost proof is another verdict. */
TEST(little_effort_proves_what_the_full_one_proves) {
  long proved = 0;
  for (size_t i = 0; i < the_paper.claims.n; i += (size_t)every(2)) {
    const struct claim *c = &the_paper.claims.claim[i];
    if (claim_asked(c) != ASKED_LATE || claim_kind(c) == KIND_SCALING) continue;
    struct verdicts little = verdicts_of(c, &the_paper.model, EFFORT_REFUTE, NULL);
    struct verdicts full = verdicts_of(c, &the_paper.model, EFFORT_FULL, NULL);
    const char *over = claim_get(c, "over");
    bool conditional = full.own == VERDICT_CONDITIONAL && claim_get(c, "defined");
    if (!claim_kind_of(c)->of_scene && (!over || strcmp(over, "scene") != 0))
      ck_assert_msg((little.own == VERDICT_PROVED) == (full.own == VERDICT_PROVED || conditional), "%s", c->id);
    ck_assert_msg(little.own != VERDICT_REFUTED || full.own == VERDICT_REFUTED, "%s", c->id);
    ck_assert_msg(little.correction == N_VERDICTS || full.correction == N_VERDICTS ||
                      little.correction == full.correction,
                  "%s", c->id);
    proved += little.own == VERDICT_PROVED;
  }
  ck_assert_int_gt(proved, 15 / every(2));
}

/* Damage that only a late claim notices, judged in full: the claim's verdict is another one. */
TABLE(late, "tests/cases/mutants_late.tsv", 3);
enum { LATE_RECORD, LATE_TEXT, LATE_CLAIM }; /* its columns */

TEST_EACH(what_little_effort_notices_the_full_one_notices, late.n) {
  char *const *row = late.row[_i];
  const struct claim *c = paper_claim(row[LATE_CLAIM]);
  OWNED(overlay) o;
  OWNED(mutants) m;
  long seen = 0;
  overlay_init(&o, &the_paper.model);
  mutants_init(&m, &the_paper.model, (const char *const *)&row[LATE_RECORD], 1);
  struct verdicts was = verdicts_of(c, &the_paper.model, EFFORT_FULL, NULL);
  for (size_t i = 0; i < m.n; i++) {
    if (strcmp(m.mutant[i].edit.text, row[LATE_TEXT]) != 0) continue;
    const struct target *t = &m.target[m.mutant[i].target];
    overlay_set(&o, t, m.mutant[i].edit.stmt);
    ck_assert_msg(verdicts_of(c, &o.model, EFFORT_FULL, NULL).own != was.own, "%s", row[LATE_TEXT]);
    overlay_set(&o, t, NULL);
    seen++;
  }
  ck_assert_int_gt(seen, 0);
}

/* Of the paper's damages, as claims notice them that draw orbits, which each process does for itself; without (57), the
   first, whose damages take longer than all the others. */
TEST(any_number_of_processes_finds_the_same) {
  enum { N = 4 };
  struct claim few[N];
  const char *record[N];
  struct claims asked = the_paper.claims;
  struct text said[2];
  for (int i = 0; i < N; i++) {
    few[i] = *paper_claim(late.row[i + 1][LATE_CLAIM]);
    record[i] = late.row[i + 1][LATE_RECORD];
  }
  asked.claim = few;
  asked.n = N;
  for (int i = 0; i < 2; i++) {
    OWNED(mutation_result) r;
    mutate_records(&r, record, N, &asked, i ? 5 : 1);
    ck_assert_int_gt(mutation_row_noticed(&r.formulas), 20);
    text_init(&said[i]);
    report_mutation_json(&said[i], &r);
  }
  ck_assert_msg(strcmp(text_str(&said[0]), text_str(&said[1])) == 0, "five processes find something else than one");
  for (int i = 0; i < 2; i++) text_clear(&said[i]);
}

/* Degrees are looked at in what a damage reaches alone: that finds as much as everywhere. */
TEST(what_is_touched_is_enough_for_scaling) {
  static const char *const record[] = {"eq-36d", "err-40", "eq-32", "eq-1c", "eq-44"};
  const struct claim *c = paper_claim("text-scaling");
  OWNED(mutants) m;
  OWNED(overlay) o;
  FREED bool *touched = malloc(the_paper.model.n_records * sizeof *touched);
  long refuted = 0, tried = 0;
  mutants_init(&m, &the_paper.model, record, 5);
  overlay_init(&o, &the_paper.model);
  for (size_t i = 0; i < m.n; i += 23, tried++) {
    const struct target *t = &m.target[m.mutant[i].target];
    overlay_set(&o, t, m.mutant[i].edit.stmt);
    target_reaches(touched, &the_paper.model, t);
    enum verdict part = verdicts_of(c, &o.model, EFFORT_REFUTE, touched).own;
    enum verdict all = verdicts_of(c, &o.model, EFFORT_REFUTE, NULL).own;
    ck_assert_msg((part == VERDICT_REFUTED) == (all == VERDICT_REFUTED), "%s", m.mutant[i].edit.text);
    refuted += all == VERDICT_REFUTED;
    overlay_set(&o, t, NULL);
  }
  ck_assert(tried > 15 && refuted > 3 && refuted < tried);
}

/* The criterion with its halves exchanged says the same, and with another bound it does not. */
TEST(halves_that_change_places_are_the_same) {
  static const char *const record = "text-criterion";
  OWNED(overlay) o;
  OWNED(mutants) m;
  struct facts *f = facts_new(&the_paper.model);
  int met = 0;
  overlay_init(&o, &the_paper.model);
  mutants_init(&m, &the_paper.model, &record, 1);
  for (size_t i = 0; i < m.n; i++) {
    const struct target *t = &m.target[m.mutant[i].target];
    bool exchanged = strcmp(m.mutant[i].edit.text, "-1 < -tr(J) < 1") == 0;
    if (!exchanged && strcmp(m.mutant[i].edit.text, "-1 < tr(J) < 2") != 0) continue;
    overlay_set(&o, t, m.mutant[i].edit.stmt);
    ck_assert(target_same_in(t, &the_paper.model, &o.model, &the_paper.claims, f) == exchanged);
    overlay_set(&o, t, NULL);
    met++;
  }
  ck_assert_int_eq(met, 2);
  facts_free(f);
}

/* A claim about corrected text is compared as corrected too: damage to an erratum does not show in its own printed
   text. */
TEST(a_correction_that_differs_is_not_called_the_same) {
  const struct claim *c = paper_claim("eq-30");
  OWNED(overlay) o;
  LOCAL(arena, a);
  struct diag d = {0};
  struct facts *f = facts_new(&the_paper.model);
  size_t at = 0;
  overlay_init(&o, &the_paper.model);
  OWNED(source) src = source_of("damaged", "dZ_b = Gamma(t_b)*dZ_a + Gamma'(t_a)*Z_a*dt_b");
  while (the_paper.model.records[at].rank != RANK_ERRATA || strcmp(the_paper.model.records[at].id, "eq-30") != 0) at++;
  struct target t = target_of(&the_paper.model, at, 0);
  ck_assert(claim_same_in(c, &t, &the_paper.model, &o.model, f) &&
            target_same_in(&t, &the_paper.model, &o.model, &the_paper.claims, f));
  overlay_set(&o, &t, stmt_parse(&a, &src, (struct span){0, src.len}, &d));
  ck_assert(!claim_same_in(c, &t, &the_paper.model, &o.model, f) &&
            !target_same_in(&t, &the_paper.model, &o.model, &the_paper.claims, f));
  overlay_set(&o, &t, NULL);
  ck_assert(claim_same_in(c, &t, &the_paper.model, &o.model, f));
  facts_free(f);
}

/* Fewer claims notice less: those that are asked read (26), and nothing reads J_a. */
TEST(a_missing_check_shows) {
  struct claim few[] = {*paper_claim("eq-26b")};
  struct claims asked = the_paper.claims;
  asked.claim = few;
  asked.n = 1;
  OWNED(mutation_result) r, read;
  mutate(&r, "eq-27", &asked, 1);
  ck_assert_int_eq(r.formulas.count[FATE_UNREAD] + r.formulas.count[FATE_REFUSED], mutation_row_total(&r.formulas));
  for (size_t i = 0; i < r.n_survivors; i++) ck_assert_str_eq(r.survivor[i].read_by, "");
  mutate(&read, "eq-26b", &asked, 1);
  ck_assert_int_gt(mutation_row_noticed(&read.formulas), 10);
  ck_assert_int_eq(read.formulas.count[FATE_UNDECIDED] + read.formulas.count[FATE_UNREAD], 0);
}

/* Counted are formulas and the classes that count, without what means the same or needs the text; errata apart. */
TEST(the_score_has_one_denominator) {
  LOCAL(mutation_result, r);
  struct mutation_score s;
  r.formulas.count[FATE_NOTICED] = 100;
  r.formulas.count[FATE_REFUSED] = 10;
  r.formulas.count[FATE_UNDECIDED] = 3;
  r.formulas.count[FATE_EQUIVALENT] = 7;
  r.formulas.count[FATE_ON_MOTIONS] = 5;
  r.printed.count[FATE_NOTICED] = 50;
  r.errata.count[FATE_NOTICED] = 1000;
  r.data[DAMAGE_TITLE].count[FATE_REFUSED] = 20;
  r.data[DAMAGE_TITLE].count[FATE_UNDECIDED] = 2;
  r.data[DAMAGE_QUOTATION].count[FATE_NEEDS_TEXT] = 11;
  r.data[DAMAGE_POINTS].count[FATE_EQUIVALENT] = 4;
  r.data[DAMAGE_ERRATUM].count[FATE_UNDECIDED] = 13;
  mutation_score_of(&s, &r);
  ck_assert_int_eq(s.counted, 135);
  ck_assert_int_eq(s.noticed, 130);
  ck_assert_int_eq(s.formulas, 113);
  ck_assert_int_eq(s.equivalent, 11);
  ck_assert_int_eq(s.on_motions, 5);
  ck_assert_int_eq(s.needs_text, 11);
  ck_assert_int_eq(s.errata, 1013);
}

/* --- Damage to the oracles: each entry of each matrix that a claim holds against the model --- */

/* The claim's value with 10^-20 added to one entry, as a statement in its place. */
static void offset_value(struct overlay *o, struct arena *a, const struct claim *c, int rows, int cols, int entry) {
  const char *value = claim_get(c, "value"), *section = claim_get(c, "section");
  struct view v = claim_view(&the_paper.model, c);
  struct diag d = {0};
  LOCAL(text, t, name);
  text_add_n(&name, value, strcspn(value, "("));
  const struct definition *def = view_lookup(&v, name.data, section, &d);
  ck_assert_msg(def != NULL, "%s", value);
  text_printf(&t, "%s := (", value);
  expr_print(&t, def->stmt->sides[0]);
  text_add(&t, ") + [");
  for (int i = 0; i < rows * cols; i++)
    text_printf(&t, "%s%s", i == 0 ? "" : i % cols ? ", " : "; ", i == entry ? "1e-20" : "0");
  text_add(&t, "]");
  struct source *src = arena_alloc(a, sizeof *src);
  source_from_string(src, "offset", t.data);
  struct stmt *s = (struct stmt *)(uintptr_t)stmt_parse(a, src, (struct span){0, src->len}, &d);
  ck_assert_msg(s != NULL, "%s", d.message);
  for (size_t i = 0; i < the_paper.model.n_records; i++)
    for (int k = 0; k < the_paper.model.records[i].n_stmts; k++)
      if (the_paper.model.records[i].stmts[k] == def->stmt) {
        struct target target = target_of(&the_paper.model, i, k);
        overlay_set(o, &target, s);
      }
  source_clear(src);
}

CASE("oracles", .once = {paper_open, paper_close});

TEST(every_entry_is_held_against_the_model) {
  long tried = 0;
  for (size_t i = 0; i < the_paper.claims.n; i++) {
    const struct claim *c = &the_paper.claims.claim[i];
    const char *value = claim_get(c, "value");
    if (strcmp(claim_get(c, "kind"), "matrix") != 0 || strncmp(value, "omega_", 6) == 0) continue; /* roots */
    const struct oracle *q = oracle_find(value);
    for (int e = 0; e < q->rows * q->cols; e++, tried++) {
      OWNED(overlay) o;
      LOCAL(arena, a);
      OWNED(audit_result) out;
      struct finding f;
      struct diag d;
      overlay_init(&o, &the_paper.model);
      offset_value(&o, &a, c, q->rows, q->cols, e);
      struct judge j = paper_judge(&out, &o.model, &d, EFFORT_REFUTE);
      ck_assert_msg(judge_verdict(&f, &j, c), "%s", d.message);
      ck_assert_msg(f.verdict == VERDICT_REFUTED, "%s: entry %d may be off by 1e-20", c->id, e + 1);
    }
  }
  ck_assert_int_gt(tried, 100);
}

/* A formula held against another quantity of the model is refuted, on every pair of the same shape. */
TEST(oracles_are_not_interchangeable) {
  static const char *const names[] = {"D(t)", "Gamma(t)", "H(t)", "C(t)", "K", "K_1", "K_2"};
  enum { N = COUNT(names) };
  for (int i = 0; i < N; i++)
    for (int k = 0; k < N; k++) {
      struct sampler sampler;
      LOCAL(point, p);
      const struct oracle *other = oracle_find(names[k]);
      if (other->rows != oracle_find(names[i])->rows) continue;
      OWNED(sentence) s;
      struct view v = {&the_paper.model, LAYER_CORRECTED, NULL, NULL};
      goes_well(sentence_from_value(&s, v, names[i], "prediction", NULL, 0, &d));
      s.oracle = other;
      sampler_init(&sampler, "oracles", &(struct point_spec){.kind = POINT_PARAMS, .phase = PHASE_H});
      sampler_next(&p, &sampler);
      struct trial t = sentence_try_balls(&s, &p, VARIANT_CLOSED, the_paper.cache);
      ck_assert_msg((t.outcome == OUTCOME_DIFFERS) == (i != k), "%s against %s", names[i], names[k]);
    }
}

/* --- Repairs --- */

static struct repair_result all_repairs;

/* In make check without (30), whose pairs of names take longer than all the rest; there are two claims that have
   nothing to search, and one that is not refuted. */
static void open_repairs(void) {
  static const char *const some[] = {"eq-10",  "eq-10c", "eq-27", "eq-29",  "eq-31",  "eq-32b",
                                     "eq-32c", "eq-32d", "eq-40", "eq-36b", "num-t_a"};
  enum { N = COUNT(some) };
  struct claim few[N];
  paper_open();
  struct claims asked = the_paper.claims;
  for (int i = 0; i < N; i++) few[i] = *paper_claim(some[i]);
  if (!every_case()) asked.claim = few, asked.n = N;
  const struct repair_options opt = {.jobs = 2};
  goes_well(audit_repairs(&all_repairs, &the_paper.model, &asked, &the_paper.scene, &opt, &d));
  ck_assert_uint_ge(all_repairs.n, N - 1);
  for (size_t i = 0; i < all_repairs.n; i++) ck_assert_str_ne(all_repairs.claim[i].claim, "eq-27");
}

static void close_repairs(void) {
  repair_result_clear(&all_repairs);
  paper_close();
}

CASE("repairs", .once = {open_repairs, close_repairs}, .seconds = 300, .tags = "long");

/* Whether a record of the errata is the correction of some claim for which it was found. */
TEST(every_erratum_is_found) {
  long found = 0;
  for (size_t i = 0; i < all_repairs.n; i++) {
    const struct repairs *c = &all_repairs.claim[i];
    ck_assert_msg(c->why_none == NULL || (c->n == 0 && c->singles == 0), "%s", c->claim);
    if (!c->erratum || c->why_none) continue;
    bool has = false;
    for (size_t k = 0; k < c->n; k++) has = has || c->repair[k].erratum;
    ck_assert_msg(has, "%s: %s is not found", c->claim, c->erratum);
    found++;
  }
  long errata = 0;
  for (size_t i = 0; i < the_paper.model.n_records; i++) errata += the_paper.model.records[i].rank == RANK_ERRATA;
  ck_assert_int_ge(found, errata); /* two claims may share one */
}

/* The repaired text written into a file of its own and judged by a whole run: the verdict is the one that was
   promised. */
TEST(every_repair_passes_a_run_of_its_own) {
  long tried = 0;
  for (size_t i = 0; i < all_repairs.n; i++)
    for (size_t k = 0; k < all_repairs.claim[i].n; k++, tried++) {
      const struct repairs *c = &all_repairs.claim[i];
      const struct claim *claim = paper_claim(c->claim);
      const char *statement = strstr(c->repair[k].text, ":=") ? NULL : claim_get(claim, "statement");
      LOCAL(text, t);
      text_printf(&t, "%s %s\n  section: %s\n  equation: %s\n", statement ? "equation" : "define",
                  statement ? statement : "repaired", claim_get(claim, "section"), claim_get(claim, "equation"));
      for (const char *p = c->repair[k].text; p && *p;) {
        const char *end = p;
        int open = 0;
        while (*end && !(*end == ';' && open == 0))
          open += (*end == '[' || *end == '(') - (*end == ']' || *end == ')'), end++;
        text_printf(&t, "  %.*s\n", (int)(end - p), p);
        p = *end ? end + 2 : end;
      }
      OWNED(model) m;
      LOCAL(audit_result, r);
      struct claims none = {.n = 0};
      struct diag d;
      const struct audit_options opt = {.only = &c->claim, .n_only = 1};
      ck_assert_msg(paper_model_read(&m, &(struct paper_layers){.overlay = scratch_put("repaired.eq", t.data)}, &d) &&
                        audit_run(&r, &m, &the_paper.claims, &none, &the_paper.scene, &opt, &d),
                    "%s\n%s", d.message, t.data);
      const char *verdict = verdict_name[finding_with_id(&r, c->claim)->verdict];
      ck_assert_msg(strcmp(verdict, c->repair[k].verdict) == 0, "%s: %s\n%s", c->claim, verdict, t.data);
    }
  ck_assert_int_ge(tried, 7);
}

TEST(the_smallest_repair_comes_first) {
  for (size_t i = 0; i < all_repairs.n; i++)
    for (size_t k = 1; k < all_repairs.claim[i].n; k++) {
      const struct repair *a = &all_repairs.claim[i].repair[k - 1], *b = &all_repairs.claim[i].repair[k];
      ck_assert(a->edits < b->edits || (a->edits == b->edits && a->distance <= b->distance));
    }
}

/* --- The commands --- */

CASE("commands", .once = {scratch_open, scratch_close}, .seconds = 300, .tags = "long");

/* With its three processes, each of which has long begun. */
static bool works(pid_t pid) {
  return group_lives(pid) == 4 && group_seconds(pid) >= 0.5;
}

/* Ended in the midst of its work, by Ctrl-C for all or by a signal for the parent alone: no file, no process is
   left. */
TEST_EACH(an_interrupted_run_leaves_nothing, 2) {
  OWNED(job) j;
  job_start_words(&j, &(struct job_place){.group = true},
                  formatted("mutate --only quotation --count all --jobs 3 --out %s", scratch_path("interrupted")));
  ck_assert(process_until(works, j.pid));
  ck_assert(kill(_i ? j.pid : -j.pid, _i ? SIGKILL : SIGINT) == 0);
  job_finish(&j);
  ck_assert_int_lt(j.status, 0);
  ck_assert(process_until(group_has_ended, j.pid));
  ck_assert(!scratch_has("interrupted"));
}
