/* The general engine: how long an orbit of a system file takes, and how that grows with masses and phases. */
#include <math.h>

#include "bench/bench.h"
#include "bench/jobs.h"
#include "bench/study.h"
#include "mech/orbit.h"

enum { PREC = 128 };

/* An orbit and a start of Newton's iteration beside it. */
struct known {
  struct mech m;
  struct mech_orbit found, again;
  double t[MECH_PHASES], z[MECH_STATES];
  double solve, judge; /* milliseconds */
};

static void solve(void *self) {
  struct known *k = self;
  if (mech_orbit_near(&k->again, &k->m, &k->found.word, k->t, k->z, PREC) == SS_OK) mech_orbit_clear(&k->again);
}

static void judge(void *self) {
  struct known *k = self;
  mech_orbit_judge(&k->again, &k->m, PREC);
}

/* From the orbit's numbers to three digits. */
static void time_orbit(struct known *k) {
  const struct mech_orbit *o = &k->found;
  const double off = 1e-3;
  for (int i = 0; i < o->word.n; i++) k->t[i] = arf_get_d(arb_midref(o->t + i), ARF_RND_NEAR) * (1 + off);
  for (int i = 0; i < k->m.states; i++) k->z[i] = arf_get_d(arb_midref(o->state + i), ARF_RND_NEAR) * (1 - off);
  k->solve = 1e-6 * bench_time(solve, k);
  k->judge = NAN;
  if (mech_orbit_near(&k->again, &k->m, &o->word, k->t, k->z, PREC) != SS_OK) return;
  k->judge = 1e-6 * bench_time(judge, k);
  mech_orbit_clear(&k->again);
}

static void add_row(struct study_table *t, const struct known *k) {
  study_cells(t, "%d\t%d\t%d\t%.3g\t%.3g", k->m.n, k->found.word.n, k->found.word.n + k->found.n_free, k->solve,
              k->judge);
  study_row(t);
}

/* The first certified motion that a search finds, timed; false: none. */
static bool find(struct known *k, const struct mech_word *w) {
  OWNED(mech_orbits) list;
  bool there = false;
  mech_orbits_find(&list, &k->m, w, true, PREC, NULL);
  for (int i = 0; i < list.n && !there; i++) {
    there = mech_orbit_is_motion(&list.orbit[i]);
    k->found = list.orbit[i];
    if (there) time_orbit(k);
  }
  return there;
}

/* --- Systems on file --- */

static bool load(struct known *k, const char *name, const char *word, const struct bench_env *env) {
  OWNED(text) path = {0};
  struct diag d = {0};
  struct mech_word w;
  size_t at;
  const char *why;
  text_printf(&path, "%s/systems/%s.system", env->data, name);
  return mech_load(&k->m, text_str(&path), &d) && mech_word_parse(&w, &at, &why, word, &k->m) && find(k, &w);
}

static const struct {
  const char *name, *word;
  double goal; /* milliseconds, of both; 0: none */
} on_file[] = {{"two-masses", "ss -s -- s-", 30},
               {"beside-wall", "-- -->2 s-", 0},
               {"driven", "-- +- -- -s", 0},
               {"chain3", "s-- --- --s --- -s- ss-", 50},
               {"chain4", "s--- s--s ---s --ss ---s ---- s--- ss--", 0},
               {"chain5", "----s ----- --s-- ----- ----+ s---+ s---s", 0}};

static bool run_files(struct study_page *page, const struct bench_env *env) {
  struct study_table *t =
      study_table(page, "files", "Systems on file", "system\tmasses\tphases\tunknowns\tsolve_ms\tjudge_ms",
                  "At 128 bits, from numbers that are off by a thousandth.");
  for (int i = 0; i < COUNT(on_file); i++) {
    struct known k = {.solve = 0};
    bool ok = load(&k, on_file[i].name, on_file[i].word, env);
    if (ok) {
      study_cells(t, "%s", on_file[i].name);
      add_row(t, &k);
    }
    if (ok && on_file[i].goal > 0)
      text_printf(&page->found, "- %s, solved and judged: %.3g ms (goal: at most %g; %s)\n", on_file[i].name,
                  k.solve + k.judge, on_file[i].goal, k.solve + k.judge <= on_file[i].goal ? "met" : "not met");
    mech_clear(&k.m);
    if (!ok) return false;
  }
  return true;
}

/* --- Growth --- */

/* n masses in a row with springs of 1 and dampers of 1/4, of which the last one is on a belt. */
static bool make_row(struct mech *m, int n) {
  const char *why, *name;
  mech_init(m);
  for (int i = 0; i < n; i++) {
    struct mech_mass *mass = mech_add_mass(m, "m");
    fmpq_one(mass->inertia);
    for (int damper = 0; damper < 2; damper++) {
      struct mech_link *link = mech_add_link(m, !damper, damper ? "d" : "k");
      link->end[0] = i - 1;
      link->end[1] = i;
      fmpq_set_si(link->size, 1, damper ? 4 : 1);
    }
    if (i < n - 1) continue;
    mass->rubbed = true;
    fmpq_one(mass->surface);
    fmpq_one(mass->sliding);
    fmpq_set_si(mass->limit, 3, 1);
  }
  return mech_finish(m, &why, &name);
}

static bool run_growth(struct study_page *page) {
  static const int size[] = {2, 5, 10, 20};
  struct study_table *t =
      study_table(page, "growth", "A row of masses, the last on a belt", "masses\tphases\tunknowns\tsolve_ms\tjudge_ms",
                  "Springs of 1, dampers of 1/4; the last mass sticks once in a period, which grows with n.");
  double ms[2] = {0}; /* of the last two, of which one has twice the masses */
  int n = page->quick ? 3 : COUNT(size);
  for (int i = 0; i < n; i++) {
    struct known k = {.solve = 0};
    bool ok = make_row(&k.m, size[i]) && find(&k, NULL);
    if (ok) add_row(t, &k);
    ms[0] = ms[1];
    ms[1] = k.solve + k.judge;
    mech_clear(&k.m);
    if (!ok) return false;
  }
  text_printf(&page->found, "- from %d to %d masses the time grows like n^%.1f\n", size[n - 2], size[n - 1],
              log2(ms[1] / ms[0]));
  return true;
}

static bool run(struct study_page *page, const struct bench_env *env) {
  return run_files(page, env) && run_growth(page);
}

const struct study study_systems = {
    .id = "systems",
    .title = "Systems of masses from files",
    .question =
        "How long does the general engine take for a certified orbit: its enclosure with multipliers (solve), and "
        "first\nevents and every condition (judge)? How does that grow with the masses?",
    .run = run,
    .apart = true,
};
