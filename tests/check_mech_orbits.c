/* Orbits of systems from files: what is proved of them.

   Numbers come from the certified orbits of the two masses (motion/dynamics.h), which share no formula with src/mech;
   from closed forms; and from tests/oracle/systems.py and den_hartog.py, which recompute orbits in mpmath. */
#include "every.h"
#include "explore/words.h"
#include "mech/moments.h"
#include "mech/orbit.h"
#include "mech/two_masses.h"
#include "params.h"
#include "rational.h"
#include "rng.h"
#include "scene/scene.h"
#include "system.h"
#include "test.h"

/* Twice around from the entry of a phase: the events and states that the orbit encloses. */
static void follow(const struct mech *file, const struct mech_orbit *o, enum mech_route route, int first) {
  struct mech_word w;
  double start[MECH_STATES], period = num_arb.get_d(o->period), t = 0, gap;
  for (int i = 0; i < o->states; i++) start[i] = num_arb.get_d(o->state + first * o->states + i);
  struct mech_plan plan = {.duration = 2.000001 * period, .most = 1000, .phase = o->word.phase[first]};
  OWNED(mech_motion) z = simulated((int)route, file, start, &plan);
  ck_assert_int_eq(z.n_moments, 2 * o->word.n + 1);
  for (int k = 0; k < z.n_moments; k++) {
    int at = (first + k) % o->word.n;
    ck_assert_str_eq(z.moment[k].phase, o->word.phase[at]);
    ck_assert_double_eq_tol(z.moment[k].t, t, 1e-9);
    for (int i = 0; i < o->states; i++)
      ck_assert_double_eq_tol(z.moment[k].z[i], num_arb.get_d(o->state + at * o->states + i), 1e-9);
    t += num_arb.get_d(o->t + at);
  }
  ck_assert(mech_settles(&w, &t, &gap, &z, o->n, o->states) && mech_word_same(&w, &o->word));
  ck_assert_double_eq_tol(t, period, 1e-9);
}

/* x = z + d with K d = u_s: in double, for a guess. */
static void state_of(double x[4], const struct dyn_orbit *o, const struct mech *m, const fmpq *params) {
  double us = fmpq_get_d(m->mass[0].sliding), chi = fmpq_get_d(params + P_CHI), d1 = 2 * us / (1 - chi);
  x[0] = num_arb.get_d(o->z10) + d1;
  x[1] = num_arb.get_d(o->z20) + d1 + us / chi;
  x[2] = x[3] = fmpq_get_d(params + P_V);
}

static bool digits_agree(arb_srcptr a, arb_srcptr b) {
  return arb_overlaps(a, b) && arb_rel_accuracy_bits(a) > 170 && arb_rel_accuracy_bits(b) > 170;
}

/* The orbits of the special code, found again: times and multiplier to 50 digits, every verdict. */
static int found_again(const fmpq *params) {
  OWNED(mech) m;
  NUMBERS(fmpq, much); /* so much friction that no lower limit is reached */
  fmpq_set_si(much, 1000, 1);
  two_masses(&m, params, (const fmpq *const[]){much, much});
  OWNED(dyn_orbits) list = orbits_of(params, 200);
  for (slong i = 0; i < list.n; i++) {
    const struct dyn_orbit *o = &list.orbit[i];
    OWNED(mech_orbit) got;
    struct mech_word w = word_in(&m, "ss -s -- s-"), best = w;
    double x[4], t[4];
    state_of(x, o, &m, params);
    memcpy(t, o->guess, sizeof t);
    mech_word_best(&best, t, x, &m);
    ck_assert_int_eq(mech_orbit_near(&got, &m, &best, t, x, 256), SS_OK);
    mech_orbit_judge(&got, &m, 256);
    int by = mech_word_turned(&w, &got.word);
    ck_assert_int_ge(by, 0);
    for (int k = 0; k < 4; k++) ck_assert(digits_agree(o->t[k], got.t + (k + by) % 4));
    ck_assert_int_eq(got.n_free, 1);
    ck_assert(got.multipliers && arb_is_zero(acb_imagref(got.multiplier)));
    ck_assert(arb_overlaps(o->trace, acb_realref(got.multiplier)));
    /* the special code lets phase D have any length, and m2 any side of the belt in phase C */
    ck_assert_int_eq((int)got.stable, got.own == TRUTH_TRUE ? (int)o->stable : TRUTH_UNKNOWN);
    ck_assert(got.own == TRUTH_TRUE || got.admissible == TRUTH_FALSE);
    ck_assert_msg(got.admissible == o->admissible, "orbit %ld: admissible %d, not %d", (long)i, got.admissible,
                  o->admissible);
  }
  return (int)list.n;
}

TEST(the_papers_orbits_on_every_scene) {
  LOCAL(arena, a);
  struct diag d = {0};
  size_t n;
  int orbits = 0;
  FREED char **name = scene_names(&n, "verify", &a, &d);
  ck_assert_ptr_nonnull(name);
  for (size_t i = 0; i < n; i += (size_t)every(3)) {
    OWNED(scene) s;
    diag_init(&d);
    if (scene_load_with(&s, name[i], "verify", NULL, SCENE_OF_TWO_MASSES, &d) && scene_has_forces(&s) &&
        !scene_is_box(&s) && strncmp(name[i], "chi-near", 8) != 0 && strcmp(name[i], "many-admissible") != 0)
      orbits += found_again(s.value);
  }
  ck_assert_int_gt(orbits, 25 / every(3));
}

CASE("random orbits", .tags = "long");

TEST_EVERY(the_papers_orbits_at_random_data, 5, 200) {
  struct rng r = {(uint64_t)_i + 500};
  FREED_PARAMS fmpq *params = _fmpq_vec_init(N_PARAMS);
  fmpq_set_si(params + P_CHI, rng_between(&r, 8, 56), 64);
  fmpq_set_si(params + P_ETA, rng_between(&r, 16, 256), 64);
  fmpq_set_si(params + P_V, rng_between(&r, 32, 128), 64);
  fmpq_set_si(params + P_E1, rng_between(&r, 32, 256), 64);
  fmpq_set_si(params + P_E2, rng_between(&r, 8, 128), 64);
  found_again(params);
}

/* What the search of words of two masses finds, from a grid and its own simulations: an orbit after a period doubling,
   whose word is a shorter one, twice, and one that motions come near only in two rounds at once. */
static const struct {
  const char *data[N_PARAMS], *sliding[2], *word;
} in_rounds[] = {
    {{"0.68", "0.6", "0.83", "0.54", "0.46"}, {"10", "10"}, "D Gamma H Gamma D Gamma H Gamma"},
    {{"0.3", "2", "1", "1.26", "0.36"}, {"0.55", "0.81"}, "D Gamma H Gamma"},
};

CASE("mech_orbits");

TEST_EACH(orbits_of_one_round_and_of_two, COUNT(in_rounds)) {
  const fmpq *none[2] = {NULL, NULL};
  FREED_PARAMS fmpq *params = rationals(in_rounds[_i].data, N_PARAMS);
  RATIONALS(sliding, 2, rationals(in_rounds[_i].sliding, 2));
  struct mech_word word;
  OWNED(word_orbits) special;
  OWNED(mech) m;
  OWNED(mech_orbits) list;
  size_t at;
  const char *why;
  ck_assert(phase_word_parse(&word, &at, &why, in_rounds[_i].word, strlen(in_rounds[_i].word)));
  ck_assert_int_eq(word_orbits_find(&special, &word, params, none, NULL, 128), SS_OK);
  two_masses(&m, params, (const fmpq *const[]){sliding, sliding + 1});
  mech_orbits_find(&list, &m, NULL, false, 128, NULL);
  int found = 0;
  for (int i = 0; i < special.found.n; i++)
    for (int k = 0; k < list.n; k++) {
      const struct mech_orbit *o = &list.orbit[k], *same = &special.found.orbit[i];
      if (o->word.n != word.n || !arb_overlaps(o->period, same->period)) continue;
      ck_assert(mech_orbit_is_motion(o) && o->stable == same->stable);
      ck_assert(arb_overlaps(acb_realref(o->multiplier), acb_realref(same->multiplier)));
      found++;
    }
  ck_assert_int_eq(found, 1);
  for (int k = 0; k < list.n; k++) ck_assert_int_ne(list.orbit[k].word.n, 2 * word.n); /* none goes round twice */
}

/* The orbits of the paper's two masses with that friction, w times as fast. */
static void find_orbits_with(struct mech_orbits *list, long friction, long w, bool any) {
  OWNED(text) system = {0};
  text_printf(&system,
              "friction = %ld\nw = %ld\n" MASS("m1", "1/w^2", "friction", "friction + 2.7844", "w")
                  MASS("m2", "1/w^2", "friction", "friction + 0.8587", "w") SPRING("wall", "ground, m1", "0.2")
                      SPRING("middle", "m1, m2", "0.8"),
              friction, w);
  OWNED(mech) file = system_of(text_str(&system));
  mech_orbits_find(list, &file, NULL, any, 128, NULL);
}

static struct mech_orbits plain; /* with little friction and at the paper's speed */

static void find_plain(void) {
  find_orbits_with(&plain, 1, 1, false);
  ck_assert_int_ge(plain.n, 1);
}

static void clear_plain(void) {
  mech_orbits_clear(&plain);
}

CASE("other units", .once = {find_plain, clear_plain});

/* More friction, static and sliding alike, only moves the place where masses swing that are never faster than the
   surface. */
TEST(more_friction_moves_the_place) {
  OWNED(mech_orbits) list;
  int shared = 0;
  find_orbits_with(&list, 1000000, 1, true);
  for (int k = 0; k < list.n; k++) {
    const struct mech_orbit *o = &list.orbit[k];
    for (int l = 0; l < plain.n; l++)
      shared += mech_orbit_is_motion(o) && mech_word_same(&o->word, &plain.orbit[l].word) &&
                arb_overlaps(o->period, plain.orbit[l].period);
  }
  ck_assert_int_ge(shared, 1);
}

/* So stiff and fast that entries of A t pass 700, beyond which exp has no double: the motions are the same, in a
   fraction of the time. */
TEST(a_fast_system_has_the_same_orbits) {
  enum { FASTER = 300 };
  OWNED(mech_orbits) list;
  NUMBERS(arb, period);
  find_orbits_with(&list, 1, FASTER, false);
  ck_assert_int_eq(list.n, plain.n);
  ck_assert_int_le(list.failed, plain.failed + 2);
  for (int k = 0; k < list.n; k++) {
    arb_mul_ui(period, list.orbit[k].period, FASTER, 128);
    ck_assert(arb_overlaps(period, plain.orbit[k].period));
  }
}

CASE("mech_orbits");

/* By a program that has nothing in common with src/mech. */
static const char *const scenes_of_systems[] = {"chain3",    "den-hartog", "driven", "beside-wall",
                                                "soft-wall", "two-loads",  "chain4", "chain5"};
enum { QUICK_SCENES = 6 };

/* The last, whose orbits take half a minute to find, is for make long; so is to compute those of chain4 again. */
static int scenes_tried(void) {
  return COUNT(scenes_of_systems) - !every_case();
}

TEST_EACH(orbits_recomputed, every_case() ? COUNT(scenes_of_systems) : QUICK_SCENES) {
  shell_well("\"$Y\" tests/oracle/systems.py \"$P\" %s", scenes_of_systems[_i]);
}

TEST_EACH(orbits_are_followed_and_differentiated, scenes_tried()) {
  static const double most[] = {
      [MECH_SALTATION] = 1e-20, [MECH_BESIDE_PATCHED] = 1e-3, [MECH_BESIDE_INTEGRATED] = 1e-3};
  OWNED(mech_orbits) list;
  OWNED(mech) file = system_on_file(scenes_of_systems[_i]);
  mech_orbits_find(&list, &file, NULL, true, 128, NULL);
  int motions = 0;
  for (int k = 0; k < list.n; k++) {
    const struct mech_orbit *o = &list.orbit[k];
    if (!mech_orbit_is_motion(o)) continue;
    motions++;
    check_routes_to_jacobian(&file, o, most, scenes_of_systems[_i]);
    for (int from = 0; from < N_MECH_ROUTES * o->word.n; from++)
      follow(&file, o, (enum mech_route)(from % N_MECH_ROUTES), from / N_MECH_ROUTES);
  }
  ck_assert_int_ge(motions, 1);
}

/* An integrated motion that starts beside the orbit settles on its word. */
static void settle_beside(const struct mech *file, const struct mech_orbit *o) {
  struct mech_word w;
  double z[MECH_STATES], period, gap;
  for (int i = 0; i < file->states; i++) z[i] = num_arb.get_d(o->state + i) * (i < file->n ? 0.999 : 1);
  struct mech_plan plan = PLAN(2000, 2000);
  OWNED(mech_motion) x = simulated(MECH_INTEGRATED, file, z, &plan);
  ck_assert(mech_settles(&w, &period, &gap, &x, file->n, file->states) && mech_word_same(&w, &o->word));
}

TEST_EVERY(words_of_settled_motions, 2, QUICK_SCENES) {
  OWNED(mech_orbits) list;
  OWNED(mech_settling) settling;
  OWNED(mech) file = system_on_file(scenes_of_systems[_i]);
  mech_settle(&settling, &file, NULL);
  mech_orbits_find(&list, &file, NULL, false, 128, NULL);
  ck_assert_int_ge(settling.settled, 6);
  for (int i = 0; i < settling.n; i++) {
    int stable = 0;
    for (int k = 0; k < list.n; k++) {
      const struct mech_orbit *o = &list.orbit[k];
      if (!mech_word_same(&o->word, &settling.on[i].word) || !mech_orbit_is_motion(o)) continue;
      if (o->stable != TRUTH_TRUE) continue;
      stable++;
      settle_beside(&file, o);
    }
    ck_assert_int_eq(stable, 1);
  }
}

/* Amplitude and phase of Den Hartog's oscillator, of tests/oracle/den_hartog.py: at an upper extreme, where the mass
   begins to move down. */
TEST_EACH(den_hartogs_motions, 10) {
  OWNED(mech_orbits) list;
  struct mech_word w = {2, {"-", "+"}};
  NUMBERS(arb, angle);
  BALLS(2, part);
  OWNED(table) motions = table_read("tests/oracle/den_hartog.tsv", 4);
  const char *beta = motions.row[_i][0], *force = motions.row[_i][1], *x0 = motions.row[_i][2],
             *phi = motions.row[_i][3];
  const char *text = formatted(MASS("m", "1", "%s", "%s", "0") SPRING("k", "ground, m", "1") LOAD("p", "m", "%s", "1"),
                               force, force, beta);
  OWNED(mech) file = system_of(text);
  mech_orbits_find(&list, &file, &w, true, 160, NULL);
  ck_assert_int_eq(list.n, 1);
  const struct mech_orbit *o = &list.orbit[0];
  arb_srcptr state = o->state + (o->word.phase[0][0] == '-' ? 0 : o->states);
  ck_assert(o->certified && o->admissible == TRUTH_TRUE && o->turns == 1 && o->states == 4);
  ck_assert_msg(decimal_within(x0, state, 103) && arb_rel_accuracy_bits(state) > 103, "%s", x0); /* 1e-31 */
  arb_set_str(angle, phi, 160);
  arb_sin_cos(part + 1, part, angle, 160);
  for (int i = 0; i < 2; i++) {
    arb_sub(part + i, part + i, state + 2 + i, 160);
    arb_add_error_2exp_si(part + i, -103);
    ck_assert(arb_contains_zero(part + i) && arb_rel_accuracy_bits(state + 2 + i) > 103);
  }
}

/* One mass: the time of each phase in closed form.  With k = m = 1, s = 1 and r = 2 it sticks for 2 (r - s)/(k V) = 2/V
   and slips for 2 pi - 2 atan((r - s)/V) = 2 pi - 2 atan(1/V); on the slow belt it sticks for as long as 32000
   steps. */
static const char *const belts[] = {"1", "1/1000"};

TEST_EACH(one_mass_in_closed_form, COUNT(belts)) {
  OWNED(mech_orbits) list;
  NUMBERS(fmpq, one_over);
  const char *text = formatted("V = %s\n" MASS("m", "1", "1", "2", "V") SPRING("k", "ground, m", "1"), belts[_i]);
  OWNED(mech) file = system_of(text);
  mech_orbits_find(&list, &file, NULL, false, 128, NULL);
  ck_assert_int_eq(list.n, 1);
  const struct mech_orbit *o = &list.orbit[0];
  NUMBERS(arb, want, angle);
  fmpq_inv(one_over, file.mass[0].surface);
  ck_assert(o->certified && o->admissible == TRUTH_TRUE && o->n_free == 0);
  int slips = o->word.phase[0][0] == '-' ? 0 : 1;
  arb_set_fmpq(angle, one_over, 128);
  arb_atan(angle, angle, 128);
  arb_const_pi(want, 128);
  arb_sub(want, want, angle, 128);
  arb_mul_2exp_si(want, want, 1);
  ck_assert(arb_overlaps(want, o->t + slips));
  arb_set_fmpq(want, one_over, 128);
  arb_mul_2exp_si(want, want, 1);
  ck_assert(arb_overlaps(want, o->t + !slips) && arb_rel_accuracy_bits(o->t) > 100);
}

/* Static friction equal to sliding friction: the mass leaves the belt with a double zero, and the phase is settled all
   the same.  With one mass the slip then takes a whole turn, 2 pi, and the mass sticks for no time: an orbit is found
   with two masses, the second of which has r = s. */
TEST(static_equal_to_sliding) {
  OWNED(mech_orbits) list;
  bool equal = false;
  OWNED(mech) file = system_of(MASS("m1", "1", "1", "3", "1") MASS("m2", "1", "1", "1", "1")
                                   SPRING("a", "ground, m1", "1/5") SPRING("b", "m1, m2", "4/5"));
  mech_orbits_find(&list, &file, NULL, true, 128, NULL);
  for (int i = 0; i < list.n; i++)
    for (int k = 0; k < list.orbit[i].word.n; k++) {
      const struct mech_orbit *o = &list.orbit[i];
      equal |= o->certified && o->word.phase[k][1] == 's' && o->word.phase[(k + 1) % o->word.n][1] != 's';
    }
  ck_assert(equal);
}
