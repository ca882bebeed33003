/* Orbits of systems along a line of a number of their file: where they change, and that branches end where they do.

   Numbers come from motion/ and explore/bifurcate.c, which share no formula with src/mech, and from simulators and
   iterations of the tests' own, which are told of where their numbers stand. */
#include "explore/bifurcate.h"
#include "mech/follow.h"
#include "params.h"
#include "rational.h"
#include "system.h"
#include "test.h"

CASE("follow", .once = {scratch_open, scratch_close});

static const char along_e2[] =
    "title: the paper's masses, with e_2 to vary\ne2 = 2\n" MASS("m1", "1", "1", "1 + 2.7844", "1")
        MASS("m2", "1", "1", "1 + e2", "1") SPRING("wall", "ground, m1", "1 - 0.8") SPRING("middle", "m1, m2", "0.8");

/* From e2 = 19/10 on, where its orbit is stable, to `to`: one change, of that kind. */
static void follow_to(struct mech_follow *f, slong to, enum mech_turn what) {
  static const struct mech_word papers = {N_PHASES, {"ss", "-s", "--", "s-"}};
  struct mech_line l = {scratch_put("line.system", along_e2), "e2", NULL, {{19, 10}}, {{to, 10}}, 12, 128, NULL};
  goes_well(mech_follow(f, &l, &papers, &d));
  ck_assert_int_eq(f->n_changes, 1);
  ck_assert(!f->spent && f->change[0].what == what && f->change[0].side[0].found && f->change[0].side[1].found);
}

static bool brackets_meet(const struct mech_change *c, const struct dyn_bifurcation *b) {
  int first = fmpq_cmp(c->side[0].at, c->side[1].at) > 0;
  return fmpq_cmp(c->side[first].at, &b->high) <= 0 && fmpq_cmp(&b->low, c->side[!first].at) <= 0;
}

static void follow_file(struct mech_follow *f, const char *written, const char *name, const fmpq *from,
                        const fmpq *to) {
  struct mech_line l = {scratch_put("line.system", written), name, NULL, {*from}, {*to}, 12, 128, NULL};
  goes_well(mech_follow(f, &l, NULL, &d));
}

TABLE(lines, "tests/cases/system_lines.tsv", 10);
enum { LINE_SYSTEM, NAME, FROM, TO, BRANCHES, CHANGES, WHAT, PLACE, WITHIN, OTHER_SIDE }; /* its columns */

/* One kind of change at most, from where the orbit is found, or none from end to end. */
TEST_EACH(changes_along_a_line, lines.n) {
  static const char *const kinds[] = {[MECH_FOLD] = "fold", [MECH_NO_FURTHER] = "no further"};
  char *const *row = lines.row[_i];
  OWNED(mech_follow) f;
  RATIONALS(end, 2, rationals((const char *const *)row + FROM, 2));
  follow_file(&f, row[LINE_SYSTEM], row[NAME], end, end + 1);
  ck_assert(!f.spent && f.n_branches == atoi(row[BRANCHES]));
  ck_assert_int_eq(f.n_changes, atoi(row[CHANGES]));
  for (int side = 0; side < 2 && f.n_changes == 0; side++) ck_assert(fmpq_equal(f.branch[0].end[side].at, end + side));
  for (int i = 0; i < f.n_changes; i++) {
    const struct mech_change *c = &f.change[i];
    ck_assert_str_eq(kinds[c->what], row[WHAT]);
    ck_assert(c->side[1].found == is_yes(row[OTHER_SIDE]) && (c->what != MECH_FOLD || c->side[0].stable == TRUTH_TRUE));
    for (int side = 0; side < 2; side++)
      ck_assert_double_eq_tol(fmpq_get_d(c->side[side].at), atof(row[PLACE]), atof(row[WITHIN]));
  }
}

/* Along a line the angle of the loads stays what it is, or the line is refused. */
TEST(orders_stay_along_a_line) {
  fmpq one = {1, 1}, far = {65, 1};
  OWNED(mech_follow) other;
  struct mech_line l = {scratch_put("line.system",
                                    "w = 1\n" MASS("m", "1", "1/5", "1/5", "0") SPRING("k", "ground, m", "1")
                                        LOAD("p", "m", "4/5", "1") LOAD("q", "m", "(4/5)*w", "1/2")),
                        "w",
                        NULL,
                        {one},
                        {far},
                        12,
                        128,
                        NULL};
  fails_with(mech_follow(&other, &l, NULL, &d),
             "q: along the line the loads' frequencies are not always the same multiples of one");
  ck_assert(fmpq_equal_si(other.at, 2));
}

/* Where a mass comes to touch the belt's velocity only, the branch ends; its multipliers are far inside the unit
   circle.  The second mass does so at c = 0.40493485986875144: z_2' = V and z_2'' = 0 at an event, with Newton's
   iteration in mpmath. */
TEST(an_end_at_a_grazing_event_is_no_flip) {
  static const char two[] =
      "title: two masses\nc = 1/10\n" MASS("m1", "1", "1/2", "2", "1") MASS("m2", "1", "1/2", "3/2", "1")
          SPRING("k1", "ground, m1", "1") SPRING("k2", "m1, m2", "1/2") DAMPER("d", "m1, m2", "c");
  fmpq from = {1, 4}, to = {1, 2};
  OWNED(mech_follow) f;
  bool met = false;
  follow_file(&f, two, "c", &from, &to);
  for (int i = 0; i < f.n_changes; i++) {
    const struct mech_change *c = &f.change[i];
    ck_assert(c->what == MECH_NO_FURTHER || c->what == MECH_CONDITION);
    met = met || (fabs(fmpq_get_d(c->side[0].at) - 0.40493485986875144) < 1e-12 && !c->side[1].found);
  }
  ck_assert(met);
}

/* The unstable orbit that goes twice round -s -- -s ss ends on it where that has the multiplier -1, and not before: at
   e2 = 1.168 a simulator of its own, by Taylor series in double, has P(P(x_2)) = x_2 at 25.661133 and P(x_2) = x_2 at
   25.488702, P the map from one loosening of m1 to the next.  The flip is a line of its own branch. */
TEST(a_doubled_orbit_ends_at_the_flip) {
  static const char *const rounds[] = {"-s -- -s ss", "-s -- -s ss -s -- -s ss"};
  double at[2];
  for (int i = 0; i < 2; i++) {
    struct mech_line l = {scratch_put("line.system", along_e2), "e2", NULL, {{13, 10}}, {{11, 10}}, 12, 128, NULL};
    OWNED(mech_follow) f;
    OWNED(mech) file = system_of(along_e2);
    struct mech_word w = word_in(&file, rounds[i]);
    goes_well(mech_follow(&f, &l, &w, &d));
    ck_assert_int_eq(f.n_changes, 1);
    ck_assert_int_eq(f.change[0].what, MECH_FLIP);
    ck_assert(f.change[0].side[0].found && f.change[0].side[1].found == (i == 0));
    at[i] = fmpq_get_d(f.change[0].side[0].at);
  }
  ck_assert_double_lt(at[1], 1.168);
  ck_assert_double_eq_tol(at[0], at[1], 1e-9);
}

/* The brackets that motion/ and explore/bifurcate.c prove for the paper's two masses with formulas of their own. */
TEST(changes_along_the_papers_line) {
  struct mech_follow f[2];
  OWNED(dyn_bifurcations) list;
  OWNED(param_line) l = param_line_of(example_text, P_E2, "0.7", "2.4");
  const struct dyn_line line = {.params = l.params, .vary = P_E2, .from = l.from, .to = l.to};
  follow_to(&f[0], 7, MECH_FLIP);
  follow_to(&f[1], 24, MECH_CONDITION);
  ck_assert(f[0].change[0].side[0].stable == TRUTH_TRUE && f[0].change[0].side[1].stable == TRUTH_FALSE);
  ck_assert(f[1].change[0].n_facts == 1 && f[1].change[0].fact[0].rule == MECH_LENGTH);
  ck_assert(f[1].change[0].side[1].own == TRUTH_FALSE);
  ck_assert_int_eq(dyn_bifurcations_find(&list, &line, 12, 65), SS_OK);
  bool met[2] = {false, false};
  for (slong i = 0; i < list.n; i++) {
    met[0] = met[0] || (list.at[i].what == CHANGE_FLIP && brackets_meet(&f[0].change[0], &list.at[i]));
    met[1] = met[1] || (list.at[i].what == CHANGE_TA && brackets_meet(&f[1].change[0], &list.at[i]));
  }
  ck_assert(met[0] && met[1]);
  for (int i = 0; i < 2; i++) mech_follow_clear(&f[i]);
}
