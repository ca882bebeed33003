/* Titles are made from what a claim says, and none states a fact beside it.  The expected titles are written by hand
   from the paper's text: what its equations say and where. */
#include <check.h>
#include <stdlib.h>
#include <string.h>

#include "claim/claim.h"
#include "paper_model.h"
#include "scratch.h"
#include "suites.h"
#include "value/title.h"

static struct model model;
static struct claims claims;

static void open_paper(void) {
  scratch_open();
  paper_model(&model, NULL);
  paper_claims(&claims, NULL);
}

static void close_paper(void) {
  claims_clear(&claims);
  model_clear(&model);
  scratch_close();
}

static void has_title(const struct model *m, const struct claim *c, const char *want) {
  struct text title;
  struct diag d;
  text_init(&title);
  diag_init(&d);
  ck_assert_msg(claim_title(&title, m, c, &d), "%s: %s", c->id, d.message);
  ck_assert_msg(strcmp(text_str(&title), want) == 0, "%s: %s\ninstead of %s", c->id, text_str(&title), want);
  text_clear(&title);
}

/* --- Those on file --- */

static const struct {
  const char *id, *title;
} on_file[] = {
    {"eq-3d", "z'' + K z = 0 in the global slip phase"},
    {"eq-3e", "z_1' < V and z_2' < V in the global slip phase of every admissible orbit"},
    {"eq-3f", "each inequality of z_1' < V and z_2' < V becomes an equality at one end of the global slip phase"},
    {"eq-4", "Z(t) = H(t) Z_0 in the global slip phase"},
    {"eq-1b", "x_1'' + x_1 - chi x_2 = u_1 and x_2'' + chi eta (x_2 - x_1) = eta u_2 in every phase"},
    {"eq-2", "u_1 = eps u_s1 and u_2 = eps u_s2 for eps = +1 and -1"},
    {"eq-2c", "(2) gives the friction of the second mass while it slips, while it sticks and beyond its limit"},
    {"eq-9b", "what (9) states holds in the global stick phase of every realistic orbit"},
    {"eq-11d", "(11) amounts to two functionally independent equations for z'_10 and z'_20"},
    {"eq-16d", "z'_1c = z_1'(t_a + t_b + t_c) = V amounts to one equation for z'_1c"},
    {"eq-24", "Z(t_a + dt_a) = D(t_a + dt_a) (Z_0 + dZ_0) for finite perturbations"},
    {"eq-25", "dZ_a = D(t_a) dZ_0 + D'(t_a) Z_0 dt_a to first order"},
    {"eq-32", "J_b is the Jacobian of the slip-stick phase"},
    {"eq-36b", "the indices of H_ij run from 1 to 3"},
    {"eq-36c", "(x_c, y_c, v_c) = J_c (x_b, u_b)"},
    {"eq-42", "P(lambda) = det(J - lambda I)"},
    {"eq-46", "z_0 = -(N_1 - I)^-1 N_2 z'_0 on periodic solutions"},
    {"eq-47", "H(t) is the propagator of the global slip phase"},
    {"eq-53", "(53) is equivalent to e_1 - 2 u_r1 < z_10 - chi z_20 and e_2 - 2 u_r2 < chi (z_20 - z_10), where z_10 - "
              "chi z_20 = e_1 - V t_a (1 - chi)"},
    {"text-h-rises", "h' > 0 is equivalent to chi (V - z_1') > 0 in the slip-stick phase, where z_2' = V"},
    {"text-57-first-range",
     "z_1' < V throughout the slip-stick phase exactly if t_b <= 2 (pi - arctan(e_1/((1 - chi) V)))"},
    {"text-57-upper-range", "h < e_2 throughout the slip-stick phase exactly if t_b modulo 2 pi <= 2 (pi - "
                            "arctan(e_1/((1 - chi) V))) and the left side ends above its crests"},
    {"text-58-upper-range", "h(t_a) < e_2 for every t_b > 0"},
    {"text-59-second-range", "z_2' < V throughout the stick-slip phase exactly if z_20 < z_10 and omega t_d <= pi"},
    {"text-52-first-range", "z_10 - chi z_20 < e_1 exactly if t_a > 0"},
    {"eq-54", "(54) follows from (53) on the example"},
    {"num-t_a", "t_a = 0.6784 on the example's orbit"},
    {"num-e1", "e_1 = 2.7844, the value of z_10 - chi z_20 + V t_a (1 - chi) at the printed numbers"},
    {"num-u_r2", "u_r2 > 1.6645, the value of (e_2 - chi (z_20 - z_10))/2 on the example's orbit"},
    {"text-45-suffices", "N_3 (-(N_1 - I)^-1 N_2 z'_0) + (N_4 - I) z'_0 = -N_3 M z'_0"},
    {"text-18-rank", "(18) amounts to four functionally independent equations for z_10, z_20, t_a, t_b, t_c and t_d"},
    {"text-54-fulfilled", "(54) follows from (52), (53), (55) and (56)"},
    {"text-56-deduced", "(56) follows from t_a > 0 and (55)"},
    {"text-51-order", "0 < t_a < t_a + t_b < t_a + t_b + t_c < t_a + t_b + t_c + t_d is equivalent to (51)"},
    {"text-first-always", "u_r1 > V t_a (1 - chi)/2 follows from u_r1 > e_1"},
    {"text-hbar-increases", "V - chi z_2' > 0 follows from z_2' < V in the stick-slip phase"},
    {"text-slip-repeats", "z_1' < V and z_2' < V are equivalent to (3) in the global slip phase"},
    {"text-constraints", "(51), (52), (54), (57), z_1' < V and z_2' < V in the global slip phase and (59) are all the "
                         "constraints"},
    {"text-friction-names", "different symbols stand for the sliding friction force and the sticking friction force"},
    {"text-mass-name", "one symbol stands for the first mass"},
    {"text-transpose", "different symbols stand for the derivative with respect to time and the transpose"},
    {"text-trace-bars", "|tr(J) < 1| is well formed"},
    {"text-compatibility-form", "M_21 + M_22 = 0 is well formed"},
    {"text-closed-forms",
     "every motion is given, in each of its phases, by the closed forms of (3), (4), (6), (8) and (10)"},
    {"text-dimension", "the phase space has two to four dimensions, depending on the phase"},
    {"text-stick-to-slip",
     "a transition from stick to slip occurs where the force on a mass exceeds its static friction"},
    {"text-eigenvalues-inside", "admissible periodic solutions are conditionally stable where -1 < tr(J) < 1"},
    {"text-start-at-rest",
     "there is a periodic solution through the slip-stick, global slip and stick-slip phases with t_a = 0 and t_b = 2"},
    {"text-six-determine",
     "(12), (14), (16) and (18) have exactly one solution with positive times and t_c up to 20 on the example"},
    {"text-first-events",
     "every solution of (12), (14), (16) and (18) with positive times and t_c up to 20 takes the first roots of the "
     "switching functions on the example"},
    {"text-several-motions", "(12), (14), (16) and (18) have exactly ten admissible solutions at chi = 99/100, eta = "
                             "1, V = 1, e_1 = 20 and e_2 = "
                             "1/4"},
    {"fig-3", "on the example one period consists of the global stick, slip-stick, global slip and stick-slip phases, "
              "in this order"},
};

START_TEST(titles_say_what_claims_say) {
  has_title(&model, claim_with_id(&claims, on_file[_i].id), on_file[_i].title);
}
END_TEST

/* Plain text of a length that a table of the report holds, without the notation of the files. */
START_TEST(titles_are_read_as_they_stand) {
  enum { LONGEST = 175 };
  struct text title;
  struct diag d;
  text_init(&title);
  diag_init(&d);
  ck_assert_msg(titles_check(&model, &claims, &d), "%s", d.message);
  for (size_t i = 0; i < claims.n; i++) {
    text_reset(&title);
    ck_assert(claim_title(&title, &model, &claims.claim[i], &d));
    const char *s = text_str(&title);
    ck_assert_msg(title.len > 3 && title.len < LONGEST, "%s: %s", claims.claim[i].id, s);
    ck_assert_msg(!strpbrk(s, "*{}[]\\$;") && !strstr(s, "  ") && !strstr(s, " , ") && !strstr(s, "first_order"),
                  "%s: %s", claims.claim[i].id, s);
  }
  text_clear(&title);
}
END_TEST

/* Where another attribute is damaged, so is the title: the two cannot part. */
static const struct {
  const char *fields, *title;
} damaged[] = {
    {"kind: identity\n  statement: eq-4\n  points: flow H 24\n", "Z(t) = H(t) Z_0 in the global slip phase"},
    {"kind: identity\n  statement: eq-6\n  points: flow H 24\n", "Z(t) = Gamma(t) Z_0 in the global slip phase"},
    {"kind: identity\n  statement: eq-4\n  points: orbits C 4\n",
     "Z(t) = H(t) Z_0 in the stick-slip phase of periodic solutions"},
    {"kind: identity\n  statement: eq-4\n  points: admissible D 4\n",
     "Z(t) = H(t) Z_0 in the global stick phase of every admissible orbit"},
    {"kind: matrix\n  value: J_c\n", "J_c is the Jacobian of the global slip phase"},
    {"kind: matrix\n  value: J_b\n", "J_b is the Jacobian of the slip-stick phase"},
    {"kind: rank\n  statement: eq-18\n  unknowns: t_a, t_b\n  rank: 1\n",
     "(18) amounts to one equation for t_a and t_b"},
    {"kind: argument\n  premises: eq-52, eq-53\n  conclusion: eq-54\n", "(54) follows from (52) and (53)"},
    {"kind: argument\n  premises: eq-54\n  conclusion: eq-52\n  converse: yes\n", "(52) is equivalent to (54)"},
    {"kind: argument\n  premises: eq-59#2\n  conclusion: eq-57#1\n",
     "z_1' < V in the slip-stick phase follows from z_2' < V in the stick-slip phase"},
    {"kind: number\n  number: t_b\n  from: orbit\n  formula: t_b\n  quote: $t_b = 2.5$.\n",
     "t_b = 2.5 on the example's orbit"},
    {"kind: law\n  equation: 2\n  mass: 1\n",
     "(2) gives the friction of the first mass while it slips, while it sticks and beyond its limit"},
    {"kind: defined\n  statements: eq-27\n  over: parameters\n",
     "the quotients, roots and inverses in (27) are defined for all parameters"},
    {"kind: defined\n  statements: eq-45, eq-46\n",
     "the quotients, roots and inverses in (45) and (46) are defined on every admissible periodic solution"},
    {"kind: criterion\n  statement: text-criterion\n  side: outside\n",
     "an eigenvalue of J outside the unit circle, one inequality of -1 < tr(J) < 1 being reversed, makes an "
     "admissible periodic solution unstable"},
    {"kind: behaviour\n  check: dimension\n  range: 3 4\n",
     "the phase space has three to four dimensions, depending on the phase"},
    {"kind: outside\n  statement: eq-56\n  range: 2 12\n  rank: 3\n  word: D H\n  formula: t_a*(1 - chi)\n"
     "  title: of {statement}, {range}, {rank} and {word}, with {formula} and the belt's law\n",
     "of (56), two to twelve, three and the global stick and global slip phases, with t_a (1 - chi) and the belt's "
     "law"},
};

static const struct claim *one_claim(struct claims *own, const char *fields) {
  struct text t;
  struct diag d;
  text_init(&t);
  diag_init(&d);
  text_printf(&t, "claim own\n  section: stability\n  %s", fields);
  ck_assert_msg(claims_add_file(own, scratch_put("own.claim", text_str(&t)), "claim", &d), "%s", d.message);
  text_clear(&t);
  return &own->claim[0];
}

START_TEST(titles_follow_the_fields) {
  struct claims own = {.n = 0};
  has_title(&model, one_claim(&own, damaged[_i].fields), damaged[_i].title);
  claims_clear(&own);
}
END_TEST

/* --- What a title by hand must not name, and where --- */

static const struct {
  const char *title;
  int column; /* in its line, "  title: " being nine characters */
  const char *says;
} refused[] = {
    {"the time t_a is positive", 19, "names t_a by hand"},
    {"V is the belt's", 10, "names V by hand"},
    {"the matrix Gamma", 21, "names Gamma by hand"},
    {"what (54) asks", 16, "names 54 by hand"},
    {"over 200 returns", 15, "names 200 by hand"},
    {"it is worth two equations", 22, "names two by hand"},
    {"along the slip-stick motion", 20, "names slip-stick by hand"},
    {"the global slip phase", 14, "names global slip by hand"},
    {"the slip phase", 14, "names slip phase by hand"},
    {"a sum = a product", 16, "names = by hand"},
    {"a mass | another", 17, "names | by hand"},
    {"of {rank}", 13, "no attribute rank"},
    {"of {title}", 13, "no attribute title"},
    {"of {kind", 13, "no attribute in braces"},
};

static void is_refused(const char *title, int column, const char *says) {
  struct claims own = {.n = 0};
  struct text fields, out;
  struct diag d;
  char place[40];
  text_init(&fields);
  text_init(&out);
  diag_init(&d);
  text_printf(&fields, "kind: outside\n  title: %s\n", title);
  const struct claim *c = one_claim(&own, text_str(&fields));
  ck_assert_msg(!titles_check(&model, &own, &d) && !claim_title(&out, &model, c, &d), "%s is taken", title);
  snprintf(place, sizeof place, "own.claim:4:%d: error: own: ", column);
  ck_assert_msg(strstr(d.message, place) && strstr(d.message, says), "%s\ninstead of %s...%s", d.message, place, says);
  text_clear(&out);
  text_clear(&fields);
  claims_clear(&own);
}

START_TEST(titles_name_nothing_by_hand) {
  is_refused(refused[_i].title, refused[_i].column, refused[_i].says);
}
END_TEST

START_TEST(words_that_name_nothing) {
  static const char *const titles[] = {"a case of the test", "none", "one mass, then the other",
                                       "the mass's slips and sticks, half-way", "a phase of stick motion"};
  for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
    struct claims own = {.n = 0};
    struct text fields;
    text_init(&fields);
    text_printf(&fields, "kind: outside\n  title: %s\n", titles[i]);
    has_title(&model, one_claim(&own, text_str(&fields)), titles[i]);
    text_clear(&fields);
    claims_clear(&own);
  }
}
END_TEST

/* What a title would be made of is missing, or names what is not there. */
static const struct {
  const char *fields;
  int line, column;
  const char *says;
} lacking[] = {
    {"kind: outside\n", 1, 7, "a kind and a title"},
    {"kind: definition\n", 1, 7, "a kind and a title"},
    {"kind: matrix\n  value: J_z\n", 1, 7, "a kind and a title"},
    {"kind: matrix\n  value: K newton\n", 1, 7, "a kind and a title"},
    {"kind: behaviour\n  check: nothing\n", 1, 7, "a kind and a title"},
    {"kind: rank\n  statement: eq-18\n", 1, 7, "a kind and a title"},
    {"kind: number\n  number: t_a\n  from: orbit\n  formula: t_a\n", 1, 7, "a kind and a title"},
    {"kind: identity\n  statement: eq-99\n", 4, 14, "there is no record eq-99"},
    {"kind: argument\n  conclusion: eq-54\n  premises: eq-52, eq-98\n", 5, 13, "there is no record eq-98"},
    {"kind: argument\n  conclusion: eq-54#3\n", 4, 15, "there is no record eq-54#3"},
    {"kind: argument\n  conclusion: eq-54#1.3\n", 4, 15, "there is no record eq-54#1.3"},
    {"kind: argument\n  conclusion: eq-54#-1\n", 4, 15, "there is no record eq-54#-1"},
};

START_TEST(titles_that_cannot_be_made) {
  struct claims own = {.n = 0};
  struct text out;
  struct diag d;
  char place[40];
  text_init(&out);
  diag_init(&d);
  const struct claim *c = one_claim(&own, lacking[_i].fields);
  ck_assert_msg(!claim_title(&out, &model, c, &d), "%s", text_str(&out));
  snprintf(place, sizeof place, "own.claim:%d:%d: error: own: ", lacking[_i].line, lacking[_i].column);
  ck_assert_msg(strstr(d.message, place) && strstr(d.message, lacking[_i].says), "%s\ninstead of %s...%s", d.message,
                place, lacking[_i].says);
  text_clear(&out);
  claims_clear(&own);
}
END_TEST

/* What is said by the attributes is not said again. */
START_TEST(no_title_beside_what_makes_one) {
  struct claims own = {.n = 0};
  struct diag d;
  diag_init(&d);
  one_claim(&own, "kind: identity\n  statement: eq-4\n  title: the masses are faster than the belt\n");
  ck_assert(!titles_check(&model, &own, &d));
  ck_assert_msg(strstr(d.message, "own.claim:5:3: error: own: its attributes make the title"), "%s", d.message);
  claims_clear(&own);
}
END_TEST

/* --- Another paper --- */

START_TEST(titles_of_another_paper) {
  struct model m;
  struct claims own = {.n = 0};
  struct diag d;
  diag_init(&d);
  model_init(&m);
  ck_assert_msg(model_add_folder(&m, "tests/another/paper", RANK_PAPER, &d) &&
                    claims_load(&own, "tests/another/claims", "claim", &d),
                "%s", d.message);
  has_title(&m, claim_with_id(&own, "eq-1"), "D(t) is the propagator of the global stick phase");
  has_title(&m, claim_with_id(&own, "eq-2"), "det(D(t)) = 1 + t in the global stick phase");
  claims_clear(&own);
  /* that paper has a name D, and none J */
  struct text out;
  text_init(&out);
  ck_assert(!claim_title(&out, &m, one_claim(&own, "kind: outside\n  title: the matrix D\n"), &d));
  claims_clear(&own);
  has_title(&m, one_claim(&own, "kind: outside\n  title: the matrix J\n"), "the matrix J");
  claims_clear(&own);
  text_clear(&out);
  model_clear(&m);
}
END_TEST

Suite *title_suite(void) {
  Suite *s = suite_create("title");
  TCase *c = tcase_create("title");
  tcase_add_checked_fixture(c, open_paper, close_paper);
  tcase_add_loop_test(c, titles_say_what_claims_say, 0, sizeof on_file / sizeof *on_file);
  tcase_add_test(c, titles_are_read_as_they_stand);
  tcase_add_loop_test(c, titles_follow_the_fields, 0, sizeof damaged / sizeof *damaged);
  tcase_add_loop_test(c, titles_name_nothing_by_hand, 0, sizeof refused / sizeof *refused);
  tcase_add_test(c, words_that_name_nothing);
  tcase_add_loop_test(c, titles_that_cannot_be_made, 0, sizeof lacking / sizeof *lacking);
  tcase_add_test(c, no_title_beside_what_makes_one);
  tcase_add_test(c, titles_of_another_paper);
  suite_add_tcase(s, c);
  return s;
}
