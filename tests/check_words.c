/* Words of phases: their notation, which phase can follow which, and their orbits against the paper's word, an oracle
   that shares nothing with the program (tests/oracle/words.py), and where simulations settle. */
#include "base/json.h"
#include "explore/words.h"
#include "motion/coulomb.h"
#include "paper_model.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "scene/scene.h"
#include "system.h"
#include "test.h"

static struct rng rng = {1};

static struct mech_word word_of(const char *text) {
  struct mech_word w;
  size_t at;
  const char *why;
  ck_assert_msg(phase_word_parse(&w, &at, &why, text, strlen(text)), "%s: %s", text, why);
  return w;
}

static const char *shown(const struct mech_word *w) {
  static char line[256];
  LOCAL(text, t);
  phase_word_print(&t, w);
  snprintf(line, sizeof line, "%s", text_str(&t));
  return line;
}

/* --- Notation --- */

TABLE(printed, "tests/cases/words_printed.tsv", 2);
enum { READ, PRINTED }; /* its columns */

TEST_EACH(a_word_is_read_and_printed, printed.n) {
  char *const *row = printed.row[_i];
  struct mech_word w = word_of(row[READ]);
  ck_assert_str_eq(shown(&w), row[PRINTED]);
}

TABLE(no_words, "tests/cases/words_none.tsv", 3);
enum { TEXT, WRONG, AT }; /* its columns */

TEST_EACH(what_is_no_word, no_words.n) {
  char *const *row = no_words.row[_i];
  struct mech_word w;
  size_t at = 99;
  const char *why = NULL;
  ck_assert_msg(!phase_word_parse(&w, &at, &why, row[TEXT], strlen(row[TEXT])), "%s", row[TEXT]);
  ck_assert_msg(strstr(why, row[WRONG]) && (int)at == atoi(row[AT]), "%s: %s at %zu", row[TEXT], why, at);
}

/* Random bytes, mostly from the letters of words: what is read is a word that reads back, what is not names a place. */
TEST(any_bytes_are_a_word_or_not) {
  static const char letters[] = "DGHCghcXxDGHCghcXx  --\tammaGamma+^()\0\xff\n";
  unsigned words = 0;
  for (int i = 0; i < 200000; i++) {
    char bytes[40];
    size_t len = (size_t)i % sizeof bytes;
    for (size_t k = 0; k < len; k++) {
      uint64_t r = rng_next(&rng);
      bytes[k] = r % 16 == 0 ? (char)(r >> 16) : letters[(r >> 12) % (sizeof letters - 1)];
    }
    char *exact = malloc(len + 1); /* so that a sanitizer sees a byte too many read */
    memcpy(exact, bytes, len);
    exact = realloc(exact, len ? len : 1);
    struct mech_word w, again;
    size_t at = 99;
    const char *why = NULL;
    if (phase_word_parse(&w, &at, &why, exact, len)) {
      words++;
      ck_assert(w.n >= 1 && w.n <= WORD_MOST);
      again = word_of(shown(&w));
      ck_assert(mech_word_turned(&again, &w) == 0);
    } else {
      ck_assert(why != NULL && (at < len || len == 0));
    }
    free(exact);
  }
  ck_assert_uint_gt(words, 1000);
}

TEST(a_word_has_no_beginning) {
  struct mech_word w = word_of("H C D Gamma"), other = word_of("C H D Gamma");
  ck_assert(phase_word_is_papers(&w) && !phase_word_is_papers(&other));
  ck_assert(!mech_word_same(&w, &other) && !phase_word_has_faster(&w));
  phase_word_canonical(&w);
  ck_assert_str_eq(shown(&w), "D-Gamma-H-C");
  mech_word_turn(&w, &w, 3);
  ck_assert_str_eq(shown(&w), "C-D-Gamma-H");
  w = word_of("DGHCDGHC");
  ck_assert(!phase_word_is_papers(&w));
}

/* Every word of n letters is written down: those without a repeated neighbour are counted by the least of their
   turns. */
TEST(all_words_are_counted_and_listed) {
  static const char letter[] = "DGHCghcXx";
  for (int n = 1; n <= 5; n++) {
    long canonical = 0, possible = 0, listed = 0, total = 1;
    for (int i = 0; i < n; i++) total *= 9;
    for (long k = 0; k < total; k++) {
      char text[8] = {0};
      int place[5];
      bool repeats = false, least = true, barred = false;
      long rest = k;
      for (int i = n - 1; i >= 0; i--, rest /= 9) place[i] = (int)(rest % 9);
      for (int i = 0; i < n; i++) {
        text[i] = letter[place[i]];
        repeats |= n > 1 && place[i] == place[(i + 1) % n];
      }
      for (int by = 1; by < n && least; by++)
        for (int i = 0; i < n; i++) {
          int order = place[(i + by) % n] - place[i];
          if (order < 0) least = false;
          if (order) break;
        }
      if (repeats || !least) continue;
      canonical++;
      struct mech_word w = word_of(text), turned = w;
      phase_word_canonical(&turned);
      ck_assert_int_eq(mech_word_turned(&turned, &w), 0);
      for (int i = 0; i < n && n > 1; i++) barred |= phase_word_barrier(w.phase[i], w.phase[(i + 1) % n]) != NULL;
      possible += !barred;
    }
    for (struct mech_word w = {.n = 0}; phase_word_next(&w, n);) listed++;
    ck_assert_int_eq(phase_word_count(n), canonical);
    ck_assert_int_eq(listed, possible);
  }
}

/* --- Transitions --- */

static void random_start(double start[N_STATE], const double p[N_COULOMB], double reach) {
  double f1 = rng_within(&rng, -reach, reach), f2 = rng_within(&rng, -reach, reach);
  start[Z_1] = (f1 + f2) / (1 - p[COULOMB_CHI]);
  start[Z_2] = start[Z_1] + f2 / p[COULOMB_CHI];
  for (int i = 0; i < 2; i++) start[DZ_1 + i] = p[COULOMB_V] * rng_within(&rng, -2, 4);
}

static void phase_of(char *phase, const enum coulomb_mode mode[2]) {
  for (int i = 0; i < 2; i++) phase[i] = coulomb_mode_letter[mode[i]];
}

/* Its place among the nine. */
static int kind_of(const char *phase) {
  const char *letters = "s-+";
  return 3 * (int)strcspn(letters, (char[]){phase[0], '\0'}) + (int)strcspn(letters, (char[]){phase[1], '\0'});
}

/* GSL's integration of the equations knows no list of transitions: none that is barred may occur in it, and the others
   all do. */
TEST(simulations_know_the_barriers) {
  enum { RUNS = 1500, KINDS = 9 };
  long seen[KINDS][KINDS] = {{0}};
  for (int k = 0; k < RUNS; k++) {
    double p[N_COULOMB], start[N_STATE];
    p[COULOMB_CHI] = rng_within(&rng, 0.05, 0.95);
    p[COULOMB_ETA] = rng_within(&rng, 0.1, 4);
    p[COULOMB_V] = rng_within(&rng, 0.05, 2);
    for (int i = 0; i < 2; i++) {
      p[COULOMB_US1 + i] = rng_within(&rng, 0, 0.5);
      p[COULOMB_UR1 + i] = p[COULOMB_US1 + i] + rng_within(&rng, 0.01, 1);
    }
    random_start(start, p, 4);
    OWNED(coulomb_log) log = {.n = 0};
    struct coulomb_result r;
    struct coulomb_plan plan = coulomb_plan_default;
    struct coulomb_sink sink = coulomb_log_sink(&log);
    plan.duration = 20;
    plan.tolerance = 1e-9;
    coulomb_simulate_ode(&r, p, start, &plan, &sink);
    for (size_t i = 1; i < log.n; i++) {
      char from[3] = "", to[3] = "";
      phase_of(from, log.event[i - 1].at.mode);
      phase_of(to, log.event[i].at.mode);
      if (log.event[i].at.t - log.event[i - 1].at.t < 1e-6 || log.event[i].simultaneous || log.event[i].grazing)
        continue;
      const char *why = phase_word_barrier(from, to);
      ck_assert_msg(!why, "run %d: %s to %s: %s", k, phase_word_name(from), phase_word_name(to), why);
      seen[kind_of(from)][kind_of(to)]++;
    }
  }
  for (struct mech_word a = {.n = 0}; phase_word_next(&a, 1);)
    for (struct mech_word b = {.n = 0}; phase_word_next(&b, 1);) {
      if (phase_word_barrier(a.phase[0], b.phase[0])) continue;
      long n = seen[kind_of(a.phase[0])][kind_of(b.phase[0])];
      ck_assert_msg(n > 0, "%s to %s never seen", phase_word_name(a.phase[0]), phase_word_name(b.phase[0]));
    }
}

TABLE(fates, "tests/cases/words_fates.tsv", 3);
enum { WORD, WHY, FATE }; /* its columns */

TEST_EACH(what_is_known_against_a_word, fates.n) {
  char *const *row = fates.row[_i];
  LOCAL(text, why);
  struct mech_word w = word_of(row[WORD]);
  ck_assert_msg(phase_word_fate(&why, &w) == (enum word_fate)word_find(row[FATE], word_fate_name, WORD_FAMILY + 1),
                "%s: %s", row[WORD], text_str(&why));
  ck_assert_msg(strstr(text_str(&why), row[WHY]) != NULL, "%s: %s", row[WORD], text_str(&why));
}

/* --- Orbits --- */

static truth holds(const struct mech_orbit *o, int phase, int mass, enum mech_rule rule) {
  for (int i = 0; i < o->n_facts; i++) {
    const struct mech_fact *c = &o->fact[i];
    if (c->phase == phase && c->mass == mass && c->rule == rule) return c->holds;
  }
  ck_abort_msg("no condition %s of m%d in phase %d", mech_rule_name[rule], mass + 1, phase + 1);
}

/* Each condition is that of the paper's word by its name. */
static void same_conditions(const struct mech_orbit *b, const struct dyn_orbit *a) {
  enum { GAMMA, H, C, D };
  ck_assert_int_eq(holds(b, D, 0, MECH_LENGTH), a->holds[COND_TA]);
  ck_assert_int_eq(holds(b, GAMMA, 0, MECH_SLOWER), a->holds[COND_GAMMA_V1]);
  ck_assert_int_eq(holds(b, GAMMA, 1, MECH_BELOW), a->holds[COND_GAMMA_R]);
  ck_assert_int_eq(holds(b, H, 0, MECH_SLOWER), a->holds[COND_H_V1]);
  ck_assert_int_eq(holds(b, H, 1, MECH_SLOWER), a->holds[COND_H_V2]);
  ck_assert_int_eq(holds(b, C, 1, MECH_SLOWER), a->holds[COND_C_V2]);
  ck_assert_int_eq(holds(b, C, 0, MECH_BELOW), a->holds[COND_C_W]);
  if (a->holds[COND_TA] == TRUTH_TRUE) ck_assert_int_eq(holds(b, D, 1, MECH_BELOW), a->holds[COND_D_R]);
}

TABLE(papers, "tests/cases/words_sets.tsv", 5);

/* The orbits of the paper's word by the general way are those of the search made for it: every number, every
   verdict. */
TEST(the_papers_word_is_one_of_them) {
  const fmpq *none[2] = {NULL, NULL};
  struct mech_word word = word_of("DGHC");
  long orbits = 0;
  NUMBERS(arb, least);
  for (int k = 0; k < papers.n; k++) {
    OWNED(word_orbits) list;
    FREED_PARAMS fmpq *params = rationals((const char *const *)papers.row[k], N_PARAMS);
    OWNED(dyn_orbits) own = orbits_of(params, 128);
    ck_assert_int_eq(word_orbits_find(&list, &word, params, none, NULL, 128), SS_OK);
    ck_assert_int_eq(list.found.n, own.n);
    ck_assert_int_eq(list.found.failed, 0);
    for (slong i = 0; i < own.n; i++) {
      const struct dyn_orbit *a = &own.orbit[i];
      const struct mech_orbit *b = NULL;
      for (int m = 0; m < list.found.n && !b; m++)
        if (arb_overlaps(list.found.orbit[m].period, a->period)) b = &list.found.orbit[m];
      ck_assert_msg(b != NULL, "set %d, orbit %ld", k, (long)i);
      ck_assert_str_eq(shown(&list.word), "Gamma-H-C-D");
      for (int p = 0; p < 4; p++) ck_assert(arb_overlaps(b->t + p, a->t[(p + 1) % 4]));
      ck_assert(b->n_free == 1 && arb_overlaps(arb_mat_entry(b->jacobian, 0, 0), a->trace) &&
                arb_rel_accuracy_bits(arb_mat_entry(b->jacobian, 0, 0)) > 100);
      ck_assert(b->certified && b->stable == a->stable && b->admissible == a->admissible);
      for (int m = 0; m < 2 && a->admissible == TRUTH_TRUE; m++) {
        ck_assert(word_orbit_friction(least, b, &list.m, m, 128));
        ck_assert(arb_overlaps(least, m ? a->u_r2_min : a->u_r1_min));
      }
      same_conditions(b, a);
      orbits++;
    }
  }
  ck_assert_int_ge(orbits, 20);
}

/* --- The oracle's table --- */

static struct table oracle;

/* Its row for an orbit. */
static char *const *row_named(const char *name) {
  if (!oracle.n) oracle = table_read("tests/oracle/words.tsv", 12);
  return oracle.row[table_row(&oracle, name, NULL)];
}

/* |x - text| < 10^-exponent. */
static bool near(arb_srcptr x, const char *text, int exponent) {
  NUMBERS(arb, d, bound);
  ck_assert_int_eq(arb_set_str(d, text, 200), 0);
  arb_sub(d, d, x, 200);
  arb_abs(d, d);
  arb_set_ui(bound, 10);
  arb_pow_ui(bound, bound, (ulong)exponent, 200);
  arb_inv(bound, bound, 200);
  return arb_lt(d, bound);
}

static void compare_with_oracle(const char *name) {
  const fmpq *u_r[2] = {NULL, NULL};
  char *const *field = row_named(name);
  FREED_PARAMS fmpq *params = rationals((const char *const *)field + 2, N_PARAMS);
  RATIONALS(limit, 2, rationals((const char *const *)field + 7, 2));
  for (int i = 0; i < 2; i++)
    if (!fmpq_is_zero(limit + i)) u_r[i] = limit + i;
  struct mech_word w = word_of(field[1]);
  OWNED(word_orbits) list;
  ck_assert_int_eq(word_orbits_find(&list, &w, params, u_r, NULL, 160), SS_OK);
  const struct mech_orbit *o = NULL;
  char *t[WORD_MOST];
  int n = 0;
  for (char *p = strtok(field[9], " "); p; p = strtok(NULL, " ")) t[n++] = p;
  ck_assert_int_eq(n, w.n);
  for (int i = 0; i < list.found.n && !o; i++)
    if (near(list.found.orbit[i].t, t[0], 3)) o = &list.found.orbit[i];
  ck_assert_msg(o != NULL, "%s: not found", name);
  ck_assert_int_eq(mech_word_turned(&list.word, &w), 0);
  for (int p = 0; p < n; p++) ck_assert_msg(near(o->t + p, t[p], 28), "%s: time %d", name, p + 1);
  int m = 0;
  for (char *p = strtok(field[11], " "); p; p = strtok(NULL, " "), m++)
    ck_assert_msg(near(o->state + m, p, 28), "%s: state %d", name, m + 1);
  ck_assert_int_eq(m, N_STATE);
  ck_assert(o->multipliers);
  acb_srcptr z = o->multiplier;
  m = 0;
  for (char *p = strtok(field[10], " "); p; p = strtok(NULL, " "), m++) {
    char *comma = strchr(p, ',');
    *comma = '\0';
    int k = 0;
    while (k < o->n_free && !(near(acb_realref(z + k), p, 17) && near(acb_imagref(z + k), comma + 1, 17))) k++;
    ck_assert_msg(k < o->n_free, "%s: %s,%s", name, p, comma + 1);
  }
  ck_assert_int_eq(m, o->n_free);
  ck_assert(o->certified && o->admissible == TRUTH_TRUE);
}

TEST(the_oracles_orbits) {
  compare_with_oracle("other-word");
  compare_with_oracle("overrun");
  compare_with_oracle("two-phases");
}

/* --- Where simulations settle --- */

TEST(jacobians_are_those_of_simulations) {
  static const double most[] = {
      [MECH_SALTATION] = 1e-20, [MECH_BESIDE_PATCHED] = 1e-7, [MECH_BESIDE_INTEGRATED] = 1e-4};
  static const char *const words[] = {"Gamma H", "H C", "Gamma H Gamma gamma", "Gamma H x H", "H C c C"};
  static const char *const text[N_PARAMS] = {"4/5", "1", "1", "1/2", "2/5"};
  RATIONALS(limit, 2, rationals((const char *const[]){"0.52", "0.42"}, 2));
  const fmpq *u_r[2] = {limit, limit + 1};
  int compared = 0;
  FREED_PARAMS fmpq *params = rationals(text, N_PARAMS);
  for (size_t k = 0; k < COUNT(words); k++) {
    struct mech_word w = word_of(words[k]);
    OWNED(word_orbits) list;
    ck_assert_int_eq(word_orbits_find(&list, &w, params, u_r, NULL, 64), SS_OK);
    word_orbits_with_friction(&list, 128);
    for (int i = 0; i < list.found.n; i++) {
      const struct mech_orbit *o = &list.found.orbit[i];
      if (o->admissible != TRUTH_TRUE) continue;
      check_routes_to_jacobian(&list.m, o, most, words[k]);
      compared++;
    }
  }
  ck_assert_int_ge(compared, 5);
}

/* Phases of some 40 oscillations, and one in which both masses stick for a time of 49,000: their conditions are decided
   all the same. */
TEST_EACH(long_phases_are_decided, 2) {
  static const char *const words[] = {"H C", "D Gamma H Gamma"};
  static const char *const text[][N_PARAMS] = {{"19/20", "23/25", "19/100", "34/25", "4/25"},
                                               {"9999/10000", "1", "1", "6961/2500", "8587/10000"}};
  const fmpq *none[2] = {NULL, NULL};
  struct mech_word w = word_of(words[_i]);
  OWNED(word_orbits) list;
  slong longer = 0;
  FREED_PARAMS fmpq *params = rationals(text[_i], N_PARAMS);
  ck_assert_int_eq(word_orbits_find(&list, &w, params, none, NULL, 82), SS_OK);
  for (int i = 0; i < list.found.n; i++) {
    ck_assert(list.found.orbit[i].certified);
    longer += arf_cmpabs_ui(arb_midref(list.found.orbit[i].period), _i ? 49000 : 240) > 0;
  }
  ck_assert_int_gt(longer, 0);
}

/* The period in events of the end of a motion, at most most; 0 when it has none. */
static int settled(const struct coulomb_log *log, int most) {
  for (int n = 2; n <= most && (size_t)(8 * n) < log->n; n++) {
    bool repeats = true;
    for (size_t i = log->n - 7 * (size_t)n; i < log->n && repeats; i++) {
      const struct coulomb_event *a = &log->event[i], *b = &log->event[i - (size_t)n];
      repeats = a->at.mode[0] == b->at.mode[0] && a->at.mode[1] == b->at.mode[1] && !a->simultaneous;
      for (int k = 0; k < 2; k++)
        repeats = repeats && fabs(a->at.x[k] - b->at.x[k]) < 1e-6 && fabs(a->at.v[k] - b->at.v[k]) < 1e-6;
    }
    if (repeats) return n;
  }
  return 0;
}

/* GSL's integration from random starts: the word that it settles on has, among the orbits found without seeds, one with
   the same lengths of its phases; that one is admissible and not unstable. */
TEST(what_simulations_settle_on_is_found) {
  static const char *const sets[][N_PARAMS + 2] = {
      {"4/5", "1", "1", "1/2", "2/5", "13/25", "21/50"},       {"2/3", "2", "1", "2", "1/4", "3", "1"},
      {"1/2", "1", "1/2", "1", "1/2", "6/5", "3/5"},           {"3/5", "3", "1", "1/2", "1/3", "1", "1/2"},
      {"71/100", "6/5", "19/10", "59/10", "79/500", "7", "3"}, {"9/10", "1/2", "1/5", "1/2", "1/2", "3/5", "11/20"}};
  int found = 0, kinds = 0;
  for (size_t k = 0; k < COUNT(sets); k++) {
    FREED_PARAMS fmpq *params = rationals(sets[k], N_PARAMS);
    RATIONALS(limit, 2, rationals(sets[k] + N_PARAMS, 2));
    const fmpq *u_r[2] = {limit, limit + 1};
    double p[N_COULOMB];
    for (int i = 0; i < 2; i++) {
      p[COULOMB_UR1 + i] = fmpq_get_d(limit + i);
      p[COULOMB_US1 + i] = p[COULOMB_UR1 + i] - fmpq_get_d(params + P_E1 + i);
    }
    for (int i = 0; i < 3; i++) p[COULOMB_CHI + i] = fmpq_get_d(params + i);
    rng.state = 7;
    for (int run = 0; run < 6; run++) {
      double start[N_STATE];
      OWNED(coulomb_log) log = {.n = 0};
      struct coulomb_result r;
      struct coulomb_plan plan = coulomb_plan_default;
      struct coulomb_sink sink = coulomb_log_sink(&log);
      random_start(start, p, 3);
      plan.duration = 4000;
      plan.max_events = 500;
      plan.tolerance = 1e-11;
      coulomb_simulate_ode(&r, p, start, &plan, &sink);
      int n = settled(&log, 6);
      if (n > 0) {
        struct mech_word w = {.n = n};
        double t[WORD_MOST];
        const struct coulomb_event *e = log.event + log.n - 1 - n;
        for (int i = 0; i < n; i++) {
          phase_of(w.phase[i], e[i].at.mode);
          t[i] = e[i + 1].at.t - e[i].at.t;
        }
        OWNED(word_orbits) list;
        ck_assert_int_eq(word_orbits_find(&list, &w, params, u_r, NULL, 64), SS_OK);
        bool same = false;
        for (int i = 0; i < list.found.n && !same; i++) {
          const struct mech_orbit *o = &list.found.orbit[i];
          for (int by = 0; by < n && !same; by++) {
            same = strcmp(list.word.phase[0], w.phase[by]) == 0;
            for (int q = 0; q < n && same; q++) same = fabs(num_arb.get_d(o->t + q) - t[(q + by) % n]) < 1e-4;
          }
          if (same) ck_assert(o->admissible == TRUTH_TRUE && o->stable == TRUTH_TRUE && o->certified);
        }
        ck_assert_msg(same, "set %zu: %s, where a simulation settled, has no such orbit", k, shown(&w));
        found++;
        kinds += w.n != 4 || !phase_word_is_papers(&w);
      }
    }
  }
  ck_assert_msg(found >= 12 && kinds >= 6, "%d settled, %d of other words", found, kinds);
}

/* --- Scenes and the command line --- */

#define EXAMPLE "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\n"

CASE("commands", .each = {scratch_open, scratch_close});

TABLE(scenes, "tests/cases/words_scenes.tsv", 2);
enum { SCENE, SAYS }; /* its columns */

TEST_EACH(scenes_whose_word_is_refused, scenes.n) {
  OWNED(scene) s;
  fails_with(
      scene_load_with(&s, scratch_put("bad.scene", scenes.row[_i][SCENE]), "verify", NULL, SCENE_OF_TWO_MASSES, &d),
      scenes.row[_i][SAYS]);
}

TEST(a_scene_names_a_word) {
  OWNED(scene) s, turned = scene_at(scratch_put("turned.scene", EXAMPLE "word: H C D Gamma\n"));
  ck_assert(!scene_other_word(&turned));
  fails_with(scene_load_with(&s, scratch_put("other.scene", EXAMPLE "word: H C\n"), "verify", NULL, SCENE_EXACT, &d),
             "names the word H-C; only orbit, jacobian and words");
  ck_assert(scene_other_word(&s));
}

/* The survey lists every word it says. */
TEST(the_survey_is_whole) {
  FREED char *first = shell_said("$P words overrun --longest 3 --json");
  LOCAL(arena, a);
  struct json_value v;
  OWNED(source) src = source_of("words.json", first);
  goes_well(json_parse(&v, &a, &src, &d));
  long words = 0, canonical = 0;
  for (int n = 1; n <= 3; n++) {
    for (struct mech_word w = {.n = 0}; phase_word_next(&w, n);) words++;
    canonical += phase_word_count(n);
  }
  ck_assert_int_eq((long)json_member(&v, "words")->n, words);
  ck_assert_int_eq(atol(json_member(&v, "canonical")->text), canonical);
  ck_assert_int_eq(atol(json_member(json_member(&v, "summary"), "possible")->text), words);
  int once = 0;
  for (const struct json_value *w = json_member(&v, "words")->first; w; w = w->next)
    once += strcmp(json_text(w, "word"), "Gamma-H-X") == 0;
  ck_assert_int_eq(once, 1);
}
