/* The library as a program sees it, by its public headers alone: what its functions answer, held against tests/oracle,
   and that wrong arguments are answered with a status and a sentence. */
#include <check.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"
#include "stickslip.h"
#include "suite.h"

static const char *const data = "verify";

/* --- What the tests share --- */

static ss_paper *paper;
static ss_scene *scene, *other; /* the paper's example; one of another word */

static void open_all(void) {
  scratch_open();
  ck_assert_msg(ss_paper_open(&paper, data) == SS_OK, "%s", ss_error());
  ck_assert_msg(ss_scene_open(&scene, "paper", data) == SS_OK, "%s", ss_error());
  ck_assert_msg(ss_scene_open(&other, "other-word", data) == SS_OK, "%s", ss_error());
}

static void close_all(void) {
  ss_scene_free(other);
  ss_scene_free(scene);
  ss_paper_free(paper);
  scratch_close();
}

/* The decimal, which has as many digits as are wanted. */
static void check_number(const ss_number *x, const char *decimal) {
  char *text;
  size_t digits = 0, point = 0;
  for (const char *p = decimal; *p; p++) {
    digits += *p >= '0' && *p <= '9' && (digits > 0 || *p != '0');
    point += *p == '.';
  }
  ck_assert_uint_le(point, 1);
  ck_assert_msg(ss_number_text(&text, x, digits) == SS_OK, "%s", ss_error());
  ck_assert_str_eq(text, decimal);
  ss_text_free(text);
}

/* Each call answers so, and says why. */
#define FAILS_SO(status, call)                                                                                         \
  ck_assert_msg((call) == (status) && *ss_error(), "%s: not %s", #call, ss_status_text(status));
#define FAIL(status, ...)                                                                                              \
  do {                                                                                                                 \
    OWNED_EACH(FAILS_SO, status, __VA_ARGS__)                                                                          \
  } while (0)

/* Each of these is NULL; is this value. */
#define IS_NULL(unused, pointer) ck_assert_msg(!(pointer), "%s", #pointer);
#define ARE_NULL(...)            OWNED_EACH(IS_NULL, , __VA_ARGS__)
#define IS(value, x)             ck_assert_msg((x) == (value), "%s is not %s", #x, #value);
#define ARE(value, ...)          OWNED_EACH(IS, value, __VA_ARGS__)

/* One that answers so, and in whose sentence these words stand. */
#define FAILS_SAYING(status, words, call)                                                                              \
  do {                                                                                                                 \
    FAIL(status, call);                                                                                                \
    ck_assert_msg(strstr(ss_error(), words) != NULL, "%s", ss_error());                                                \
  } while (0)

/* --- status.h, number.h --- */

CASE("library", .each = {open_all, close_all});

TEST(statuses_have_texts) {
  for (int s = SS_OK; s <= SS_STOPPED; s *= 2, s += s == 0) ck_assert_uint_gt(strlen(ss_status_text(s)), 0);
  ck_assert_str_ne(ss_status_text(SS_DOMAIN), ss_status_text(SS_UNABLE));
  ck_assert_str_eq(ss_status_text(SS_DOMAIN | SS_UNABLE), "the value does not exist; it could not be told or held");
  ck_assert_str_eq(ss_status_text(-1), ss_status_text(1000));
  const char *version = formatted("%d.%d.%d", SS_VERSION_MAJOR, SS_VERSION_MINOR, SS_VERSION_PATCH);
  ck_assert_str_eq(version, SS_VERSION);
  ck_assert_str_eq(version, ss_version());
  ss_text_free(NULL);
}

TEST(a_number_is_there_or_not) {
  char *text;
  const ss_number *x = ss_scene_parameter(scene, "e1");
  mpfr_t z, exact;
  mpfr_inits2(200, z, exact, (mpfr_ptr)NULL);
  check_number(x, "2.7844");
  check_number(x, "2.784");
  ck_assert_uint_eq(ss_number_digits(x), 100000);
  ck_assert_double_eq(ss_number_double(x), 2.7844);
  ck_assert_double_eq(ss_number_radius(x), 0);
  ck_assert_int_eq(ss_number_mpfr(z, x), SS_OK);
  mpfr_set_str(exact, "2.7844", 10, MPFR_RNDN);
  ck_assert_int_eq(mpfr_cmp(z, exact), 0);
  FAIL(SS_ARGUMENT, ss_number_text(&text, x, 0));
  ck_assert_ptr_null(text);
  FAIL(SS_ARGUMENT, ss_number_text(&text, x, 100001), ss_number_text(&text, NULL, 5), ss_number_text(NULL, x, 5),
       ss_number_mpfr(z, NULL));
  ck_assert(isnan(ss_number_double(NULL)));
  ck_assert(isinf(ss_number_radius(NULL)));
  ck_assert_uint_eq(ss_number_digits(NULL), 0);
  mpfr_clears(z, exact, (mpfr_ptr)NULL);
}

static void *fail_elsewhere(void *unused) {
  (void)unused;
  bool quiet = !*ss_error();
  ss_scene *s;
  ss_scene_open(&s, "nowhere", data);
  bool said = strstr(ss_error(), "nowhere") != NULL;
  ss_cleanup();
  return quiet && said ? fail_elsewhere : NULL;
}

TEST(each_thread_has_its_own_error) {
  pthread_t t;
  void *good;
  FAIL(SS_ARGUMENT, ss_word_each(0, NULL, NULL));
  const char *before = formatted("%s", ss_error());
  ck_assert_int_eq(pthread_create(&t, NULL, fail_elsewhere, NULL), 0);
  pthread_join(t, &good);
  ck_assert_ptr_nonnull(good);
  ck_assert_str_eq(ss_error(), before);
}

/* --- scene.h --- */

static int count_names(void *self, const char *name) {
  int *n = self;
  return ++*n < 3 && *name;
}

TEST(scenes_are_opened_read_and_changed) {
  ss_scene *s, *t, *none;
  int n = 0;
  setenv("STICKSLIP_DATA", data, 1);
  ck_assert_str_eq(ss_data_folder(), data);
  FAIL(SS_STOPPED, ss_scene_names(NULL, count_names, &n));
  ck_assert_int_eq(n, 3);
  FAIL(SS_ARGUMENT, ss_scene_names(NULL, NULL, NULL));
  FAIL(SS_INPUT, ss_scene_names("/nowhere", count_names, &n));
  ck_assert_int_eq(ss_scene_open(&s, "paper", NULL), SS_OK);
  ck_assert_str_eq(ss_scene_name(s), "paper");
  ck_assert_str_eq(ss_scene_title(s), "the paper's numerical example");
  check_number(ss_scene_printed(s, "z20"), "-2.1958");
  ARE_NULL(ss_scene_printed(s, "z30"), ss_scene_parameter(s, "t_a"));
  ck_assert_int_eq(ss_scene_set(s, "e2=1/3"), SS_OK);
  check_number(ss_scene_parameter(s, "e2"), "0.333333");
  ck_assert_int_eq(ss_scene_set(s, "e2=1/4"), SS_OK);
  FAILS_SAYING(SS_INPUT, "positive", ss_scene_set(s, "e2=0"));
  check_number(ss_scene_parameter(s, "e2"), "0.25");
  check_number(ss_scene_printed(s, "t_b"), "2.0");
  ck_assert_str_eq(ss_scene_name(s), "paper --set e2=1/4");
  FAIL(SS_INPUT, ss_scene_set(s, "t_a=1/2"));
  ck_assert_int_eq(ss_scene_set(s, "e2=\nt_a=1/2\nprinted=x = 3"), SS_OK);
  check_number(ss_scene_parameter(s, "t_a"), "0.5");
  check_number(ss_scene_printed(s, "x"), "3");
  ck_assert_int_eq(ss_scene_read(&t, "mine", "chi = 1/2\neta = 1\nV = 1\ne1 = [1, 2]\ne2 = 1\n"), SS_OK);
  ck_assert_str_eq(ss_scene_name(t), "mine");
  FAILS_SAYING(SS_INPUT, "the library takes none", ss_scene_open(&none, "chain3", NULL));
  ck_assert_ptr_null(ss_scene_parameter(t, "e1"));
  ss_scene_free(t);
  ss_scene_free(s);
}

TEST(a_wrong_scene_is_told_with_its_place) {
  ss_scene *s;
  FAIL(SS_INPUT, ss_scene_read(&s, "mine", "chi = 1/2\neta = one\nV = 1\ne1 = 1\ne2 = 1\n"));
  ck_assert_ptr_null(s);
  ck_assert_msg(strncmp(ss_error(), "mine.scene:2:7: error: ", 23) == 0, "%s", ss_error());
  FAIL(SS_INPUT, ss_scene_read(&s, "mine", "chi = \xff"), ss_scene_read(&s, "mine", ""));
  FAIL(SS_ARGUMENT, ss_scene_read(&s, NULL, ""), ss_scene_read(&s, "mine", NULL), ss_scene_read(NULL, "mine", ""));
  FAIL(SS_INPUT, ss_scene_open(&s, "nowhere", data));
  s = scene;
  FAIL(SS_ARGUMENT, ss_scene_open(&s, NULL, data));
  ck_assert_ptr_null(s);
  FAIL(SS_ARGUMENT, ss_scene_open(NULL, "paper", data), ss_scene_set(NULL, "e2=1"));
  ARE_NULL(ss_scene_name(NULL), ss_scene_title(NULL), ss_scene_parameter(NULL, "chi"), ss_scene_printed(NULL, "t_a"));
  ss_scene_free(NULL);
}

/* --- orbit.h --- */

/* tests/oracle/orbits.tsv, the second orbit of the set "paper". */
#define Z10 "0.97818814419009857445114294083878464424064270093456"
#define Z20 "-2.1246946344434457727306815792761349889"
#define T_A 0.532280741275724036821558978701536823153989128774234316971725
#define T_B 2.00533270228679336080953182635890157559023897974584130104824
#define T_C 1.48988478276059911674981184551588091311647967397465475181375
#define T_D 2.34730065501095188644119110092849215125335509810305300856438

TEST(the_orbits_of_the_paper) {
  char *text;
  ss_orbits *o;
  ck_assert_msg(ss_orbits_find(&o, scene, 50) == SS_OK, "%s", ss_error());
  ss_scene_free(scene); /* nothing is kept of it */
  scene = NULL;
  ck_assert_uint_eq(ss_orbits_count(o), 2);
  ck_assert_int_eq(ss_orbits_complete(o), 1);
  ck_assert_ptr_null(ss_orbits_gap(o));
  ck_assert(isinf(ss_orbits_reach(o)));
  check_number(ss_orbit_number(o, 1, SS_Z10), Z10);
  check_number(ss_orbit_number(o, 1, SS_E1), "2.7844");
  ck_assert_double_lt(ss_number_radius(ss_orbit_number(o, 1, SS_TRACE)), 1e-50);
  ck_assert_uint_ge(ss_number_digits(ss_orbit_number(o, 1, SS_TRACE)), 50);
  ck_assert_int_eq(ss_orbit_stable(o, 0), SS_TRUE);
  ARE(SS_FALSE, ss_orbit_stable(o, 1), ss_orbit_admissible(o, 0));
  ck_assert_int_eq(ss_orbit_admissible(o, 1), SS_TRUE);
  ck_assert_str_eq(ss_orbit_violation(o, 0, 0), "h_v2");
  ARE_NULL(ss_orbit_violation(o, 0, 1), ss_orbit_violation(o, 1, 0));
  ck_assert_int_eq(ss_orbit_certified(o, 1), 1);
  ck_assert_int_eq(ss_orbit_open(&text, o, 1), SS_OK);
  ck_assert_str_eq(text, "");
  ss_text_free(text);
  ck_assert_int_eq(ss_orbits_certificate(&text, o), SS_OK);
  ck_assert_ptr_nonnull(strstr(text, "\"paper\""));
  ss_text_free(text);
  ss_orbits_free(o);
}

/* Static friction that is given too small breaks a condition of its own. */
TEST(given_friction_counts) {
  ss_orbits *o;
  ck_assert_int_eq(ss_scene_set(scene, "chi=0.8\neta=1\nV=1\ne1=1/100\ne2=1/100\nu_r1=1/90\nu_r2=1/90"), SS_OK);
  ck_assert_msg(ss_orbits_find(&o, scene, 15) == SS_OK, "%s", ss_error());
  size_t broken = 0;
  for (size_t k = 0; k < ss_orbits_count(o); k++)
    for (size_t i = 0; ss_orbit_violation(o, k, i); i++, broken++)
      ck_assert_int_eq(ss_orbit_admissible(o, k), SS_FALSE);
  ck_assert_uint_gt(broken, 0);
  ss_orbits_free(o);
  ck_assert_int_eq(ss_scene_set(scene, "e1=2.7844\ne2=0.8587\nu_r1=3\nu_r2=1.6"), SS_OK);
  ck_assert_int_eq(ss_orbits_find(&o, scene, 15), SS_OK);
  ck_assert_str_eq(ss_orbit_violation(o, 1, 0), "u_r2"); /* it needs 1.67 */
  ck_assert_int_eq(ss_orbit_admissible(o, 1), SS_FALSE);
  ss_orbits_free(o);
}

TEST(the_orbit_near_given_times) {
  ss_orbits *o;
  ck_assert_msg(ss_orbits_near(&o, scene, 2, 1.5, 40) == SS_OK, "%s", ss_error());
  ck_assert_uint_eq(ss_orbits_count(o), 1);
  check_number(ss_orbit_number(o, 0, SS_Z20), Z20);
  ck_assert_int_eq(ss_orbit_certified(o, 0), 1);
  ck_assert_int_eq(ss_orbits_complete(o), 0);
  ck_assert_ptr_nonnull(ss_orbits_gap(o));
  ck_assert(isnan(ss_orbits_reach(o)));
  ss_orbits_free(o);
  FAIL(SS_UNABLE, ss_orbits_near(&o, scene, 50, 50, 15));
  ck_assert_ptr_null(o);
  FAIL(SS_ARGUMENT, ss_orbits_near(&o, scene, NAN, 1, 15), ss_orbits_near(&o, scene, 2, 0, 15),
       ss_orbits_near(&o, scene, 2, 1.5, 0), ss_orbits_near(&o, NULL, 2, 1.5, 15),
       ss_orbits_near(NULL, scene, 2, 1.5, 15));
  ck_assert_int_eq(ss_scene_set(scene, "e2=\nt_a=1/2"), SS_OK);
  FAIL(SS_INPUT, ss_orbits_near(&o, scene, 2, 1.5, 15));
}

TEST(orbits_that_cannot_be_asked_for) {
  char *text;
  ss_orbits *o;
  FAIL(SS_ARGUMENT, ss_orbits_find(&o, scene, 0), ss_orbits_find(&o, scene, 100001), ss_orbits_find(&o, NULL, 15),
       ss_orbits_find(NULL, scene, 15));
  FAIL(SS_INPUT, ss_orbits_find(&o, other, 15));
  ck_assert_int_eq(ss_scene_set(scene, "e2=[1,2]"), SS_OK);
  FAIL(SS_INPUT, ss_orbits_find(&o, scene, 15));
  ck_assert_ptr_null(o);
  ck_assert_int_eq(ss_scene_set(scene, "e2=0.8587"), SS_OK);
  ck_assert_int_eq(ss_orbits_find(&o, scene, 15), SS_OK);
  ARE_NULL(ss_orbit_number(o, 2, SS_Z10), ss_orbit_number(o, 0, SS_ORBIT_NUMBERS), ss_orbit_number(o, 0, -1));
  ARE(SS_UNKNOWN, ss_orbit_stable(o, 2), ss_orbit_admissible(o, 2));
  ck_assert_int_eq(ss_orbit_certified(o, 2), 0);
  ck_assert_ptr_null(ss_orbit_violation(o, 2, 0));
  FAIL(SS_ARGUMENT, ss_orbit_open(&text, o, 2), ss_orbit_open(NULL, o, 0), ss_orbits_certificate(&text, NULL),
       ss_orbits_certificate(NULL, o));
  ss_orbits_free(o);
  ss_orbits_free(NULL);
  ARE(0, ss_orbits_count(NULL), ss_orbits_complete(NULL));
  ck_assert_ptr_null(ss_orbits_gap(NULL));
  ck_assert(isnan(ss_orbits_reach(NULL)));
  ck_assert_int_eq(ss_orbit_stable(NULL, 0), SS_UNKNOWN);
  ck_assert_str_eq(ss_orbit_number_name(SS_U_R2_MIN), "u_r2_min");
  ARE_NULL(ss_orbit_number_name(SS_ORBIT_NUMBERS), ss_orbit_number_name(-1));
}

/* --- map.h --- */

static const double params[SS_PARAMS] = {0.8, 1, 1, 2.7844, 0.8587};
static const double near_it[2] = {2.0053, 1.4899};
/* tests/oracle/jacobian.tsv: the return of the second orbit, and its trace. */
static const double jacobian[4] = {
    -3.606045314213789152073353542730672064828, 3.606045314213789152073353542730672064828,
    -2.582819124826219099069181347646912011471, 2.582819124826219099069181347646912011471};
#define TRACE (-1.023226189387570053004172195083760053357)
#define R     (-3.102882778633544347181824520114919633)

TEST(the_map_has_the_orbit_as_its_fixed_point) {
  double r, slope, t[4];
  int grazing;
  ck_assert_int_eq(ss_return_map(&r, &slope, t, &grazing, params, R), SS_OK);
  ck_assert_double_eq_tol(r, R, 1e-14);
  ck_assert_double_eq_tol(slope, TRACE, 1e-13);
  ck_assert_double_eq_tol(t[0], T_A, 1e-13);
  ck_assert_double_eq_tol(t[1], T_B, 1e-14);
  ck_assert_double_eq_tol(t[2], T_C, 1e-14);
  ck_assert_double_eq_tol(t[3], T_D, 1e-14);
  ck_assert_int_eq(grazing, 0);
  ck_assert_int_eq(ss_return_map_plain(&r, &slope, t, params, R), SS_OK);
  ck_assert_double_eq_tol(r, R, 1e-12);
  ck_assert_double_eq_tol(t[3], T_D, 1e-12);
  ARE(SS_OK, ss_return_map(&r, NULL, NULL, NULL, params, R), ss_return_map_plain(&r, NULL, NULL, params, R));
}

TEST(the_orbit_from_a_guess) {
  double out[SS_OUTPUTS];
  unsigned violations, unsure;
  ck_assert_int_eq(ss_orbit_warm(out, &violations, &unsure, params, near_it), SS_OK);
  ck_assert_uint_eq(violations | unsure, 0);
  ck_assert_double_eq_tol(out[SS_OUT_Z10], 0.978188144190098574451, 1e-15);
  ck_assert_double_eq_tol(out[SS_OUT_T_D], T_D, 1e-15);
  ck_assert_double_eq_tol(out[SS_OUT_TRACE], TRACE, 1e-15);
  ck_assert_double_eq_tol(out[SS_OUT_PERIOD], T_A + T_B + T_C + T_D, 2e-15);
  ARE(SS_OK, ss_orbit_warm(out, NULL, NULL, params, near_it), ss_orbit_bare(out, params, near_it));
  ck_assert_double_eq_tol(out[SS_OUT_TRACE], TRACE, 1e-12);
  ck_assert(isnan(out[SS_OUT_U_R2_MIN]));
}

TEST(many_orbits_at_once) {
  enum { N = 100 };
  static double in[SS_PARAMS][N], from[2][N], to[SS_OUTPUTS][N];
  static unsigned violations[N];
  static int status[N];
  const double *p[SS_PARAMS], *guess[2] = {from[0], from[1]};
  double *out[SS_OUTPUTS];
  for (int i = 0; i < SS_PARAMS; i++) {
    p[i] = in[i];
    for (int j = 0; j < N; j++) in[i][j] = params[i] * (i == SS_PARAM_E2 ? 1 + 1e-6 * j : 1);
  }
  for (int j = 0; j < N; j++)
    for (int i = 0; i < 2; i++) from[i][j] = near_it[i];
  for (int i = 0; i < SS_OUTPUTS; i++) out[i] = to[i];
  ck_assert_int_eq(ss_orbits_batch(out, violations, status, p, guess, N), SS_OK);
  for (int j = 0; j < N; j++) {
    double one[SS_OUTPUTS], at[SS_PARAMS];
    for (int i = 0; i < SS_PARAMS; i++) at[i] = in[i][j];
    ck_assert_int_eq(ss_orbit_warm(one, NULL, NULL, at, near_it), SS_OK);
    for (int i = 0; i < SS_OUTPUTS; i++) ck_assert_double_eq_tol(to[i][j], one[i], 4e-15);
  }
  ck_assert_int_eq(ss_orbits_batch(NULL, NULL, NULL, NULL, NULL, 0), SS_OK);
  FAIL(SS_ARGUMENT, ss_orbits_batch(out, NULL, status, p, guess, N),
       ss_orbits_batch(NULL, violations, status, p, guess, N));
  out[3] = NULL;
  FAIL(SS_ARGUMENT, ss_orbits_batch(out, violations, status, p, guess, N));
}

TEST(the_return_jacobian) {
  static const double start[2] = {0.978188144190098574451, -2.12469463444344577273}, guess[4] = {T_A, T_B, T_C, T_D};
  double j[4], err;
  for (int k = 0; k < 3; k++) {
    ck_assert_int_eq(ss_return_jacobian(j, k == 1 ? NULL : &err, params, start, k == 2 ? guess : NULL), SS_OK);
    ck_assert_double_lt(err, 1e-15);
    for (int i = 0; i < 4; i++) ck_assert_double_eq_tol(j[i], jacobian[i], 40 * err); /* the start is rounded */
  }
}

/* NaN, infinity, and each parameter outside its domain, one at a time. */
TEST(doubles_outside_the_domain) {
  static const double wrong[] = {0, -1, NAN, INFINITY};
  double r, out[SS_OUTPUTS], j[4], guess[2] = {NAN, -1};
  unsigned v;
  for (int i = 0; i < SS_PARAMS; i++)
    for (size_t k = 0; k < COUNT(wrong); k++) {
      double p[SS_PARAMS];
      memcpy(p, params, sizeof p);
      p[i] = wrong[k];
      ck_assert_int_ne(ss_return_map(&r, NULL, NULL, NULL, p, R), SS_OK);
      ck_assert_int_ne(ss_return_map_plain(&r, NULL, NULL, p, R), SS_OK);
      ck_assert_int_ne(ss_orbit_warm(out, NULL, &v, p, near_it), SS_OK);
      ck_assert_int_ne(ss_orbit_bare(out, p, near_it), SS_OK);
      ck_assert_int_ne(ss_return_jacobian(j, NULL, p, near_it, NULL), SS_OK);
    }
  ck_assert_int_eq(ss_return_map(&r, NULL, NULL, NULL, params, 2), SS_DOMAIN);
  ck_assert_int_eq(ss_return_map(&r, NULL, NULL, NULL, params, NAN), SS_UNABLE);
  ck_assert_int_ne(ss_orbit_warm(out, NULL, NULL, params, guess), SS_OK);
  ck_assert_int_ne(ss_orbit_bare(out, params, guess), SS_OK);
  FAIL(SS_ARGUMENT, ss_return_map(NULL, NULL, NULL, NULL, params, R), ss_return_map(&r, NULL, NULL, NULL, NULL, R),
       ss_return_map_plain(NULL, NULL, NULL, params, R), ss_orbit_warm(NULL, NULL, NULL, params, near_it),
       ss_orbit_bare(out, params, NULL), ss_return_jacobian(NULL, NULL, params, near_it, NULL),
       ss_return_jacobian(j, NULL, params, guess, NULL));
  ck_assert_str_eq(ss_condition_name(SS_COND_GAMMA_R), "gamma_r");
  ck_assert_str_eq(ss_condition_name(SS_COND_U_R2), "u_r2");
  ARE_NULL(ss_condition_name(SS_CONDITIONS), ss_condition_name(-1));
}

/* --- formula.h, jacobian.h --- */

static double value_of(int layer, const char *formula, long at, const char *values) {
  ss_formula *f;
  ck_assert_msg(ss_formula_open(&f, paper, layer, formula, "") == SS_OK, "%s", ss_error());
  ck_assert_msg(ss_formula_evaluate(f, scene, at, values, 17) == SS_OK, "%s: %s", formula, ss_error());
  double x = ss_number_double(ss_formula_value(f, 0, 0));
  ss_formula_free(f);
  return x;
}

TEST(formulas_of_the_paper) {
  char *text;
  ss_formula *f;
  ck_assert_int_eq(ss_formula_open(&f, paper, SS_CORRECTED, "[chi, eta; tr(J), det(J)]", NULL), SS_OK);
  ck_assert_ptr_null(ss_formula_value(f, 0, 0));
  ARE(2, ss_formula_rows(f), ss_formula_columns(f));
  ck_assert_int_eq(ss_formula_latex(&text, f), SS_OK);
  ck_assert_ptr_nonnull(strstr(text, "\\chi"));
  ss_text_free(text);
  FAIL(SS_UNABLE, ss_formula_evaluate(f, scene, 1, NULL, 20)); /* no digit of a zero is known */
  ck_assert_double_eq_tol(ss_number_double(ss_formula_value(f, 1, 0)), TRACE, 1e-15);
  ck_assert_double_lt(ss_number_radius(ss_formula_value(f, 1, 1)), 1e-300);
  ARE_NULL(ss_formula_value(f, 2, 0), ss_formula_value(f, 0, -1));
  ss_formula_free(f);
  ck_assert_double_eq_tol(value_of(SS_STABLE, "tr(J)", 1, NULL), TRACE, 1e-15);
  ck_assert_double_eq_tol(value_of(SS_CORRECTED, "tr(J)", 0, NULL), 0.828765731724560, 1e-14); /* orbits.tsv */
  ck_assert_double_eq(value_of(SS_PRINTED, "chi*eta*V", SS_AT_PARAMETERS, "chi=1/2,eta=3"), 1.5);
  ck_assert_double_eq(value_of(SS_PRINTED, "t_a", SS_AT_PRINTED, NULL), 0.6784);
}

/* Neither an orbit nor the parameters say what they are. */
static void free_symbols_need_values(void) {
  static const char *const text[] = {"t", "x", "y", "lambda", "chi*t", "cos(t)", "u_r1", "u_r2", "u_s1", "z_1(t)"};
  for (size_t i = 0; i < COUNT(text); i++)
    for (long at = SS_AT_PARAMETERS; at <= 1; at++) {
      ss_formula *f;
      ck_assert_int_eq(ss_formula_open(&f, paper, SS_CORRECTED, text[i], ""), SS_OK);
      FAIL(SS_INPUT, ss_formula_evaluate(f, scene, at, NULL, 15));
      ss_formula_free(f);
    }
}

TEST(formulas_that_have_no_value) {
  ss_paper *none;
  char *text;
  ss_formula *f;
  FAILS_SAYING(SS_INPUT, "no_such_name", ss_formula_open(&f, paper, SS_PRINTED, "no_such_name + 1", ""));
  ck_assert_ptr_null(f);
  FAIL(SS_INPUT, ss_formula_open(&f, paper, SS_PRINTED, "1/chi/eta", ""),
       ss_formula_open(&f, paper, SS_PRINTED, "", ""),
       ss_formula_open(&f, paper, SS_PRINTED, "[1,2,3,4,5,6,7,8,9,1,2,3,4,5,6,7,8]", ""));
  FAIL(SS_ARGUMENT, ss_formula_open(&f, paper, SS_LAYERS, "1", ""), ss_formula_open(&f, NULL, SS_PRINTED, "1", ""),
       ss_formula_open(&f, paper, SS_PRINTED, NULL, ""), ss_formula_open(NULL, paper, SS_PRINTED, "1", ""));
  ck_assert_int_eq(ss_formula_open(&f, paper, SS_PRINTED, "sqrt(1 - 1/chi)", ""), SS_OK);
  FAIL(SS_DOMAIN, ss_formula_evaluate(f, scene, SS_AT_PARAMETERS, NULL, 15));
  ck_assert_ptr_null(ss_formula_value(f, 0, 0));
  FAIL(SS_INPUT, ss_formula_evaluate(f, scene, SS_AT_PARAMETERS, "chi=2", 15),
       ss_formula_evaluate(f, scene, SS_AT_PARAMETERS, "one", 15));
  FAILS_SAYING(SS_INPUT, "no orbit 3; 2 are found", ss_formula_evaluate(f, scene, 2, NULL, 15));
  FAIL(SS_ARGUMENT, ss_formula_evaluate(f, scene, -3, NULL, 15), ss_formula_evaluate(f, scene, 0, NULL, 0),
       ss_formula_evaluate(f, NULL, 0, NULL, 15), ss_formula_evaluate(NULL, scene, 0, NULL, 15));
  ss_formula_free(f);
  ck_assert_int_eq(ss_formula_open(&f, paper, SS_PRINTED, "t_a", ""), SS_OK);
  FAIL(SS_INPUT, ss_formula_evaluate(f, scene, SS_AT_PARAMETERS, NULL, 15));
  ck_assert_double_eq(value_of(SS_CORRECTED, "t_a + t - t_a", 0, "t=1/2"), 0.5);
  ck_assert_double_eq(value_of(SS_CORRECTED, "H(t)[1,3]", 0, "t=1/2"), value_of(SS_CORRECTED, "H(1/2)[1,3]", 0, NULL));
  free_symbols_need_values();
  ss_scene_set(scene, "printed=");
  FAIL(SS_INPUT, ss_formula_evaluate(f, scene, SS_AT_PRINTED, NULL, 15));
  FAIL(SS_ARGUMENT, ss_formula_latex(NULL, f), ss_formula_latex(&text, NULL));
  ss_formula_free(f);
  ss_formula_free(NULL);
  ck_assert_int_eq(ss_formula_rows(NULL) + ss_formula_columns(NULL), 0);
  ck_assert_ptr_null(ss_formula_value(NULL, 0, 0));
  FAIL(SS_INPUT, ss_paper_open(&none, "/nowhere"));
  ck_assert_ptr_null(none);
  FAIL(SS_ARGUMENT, ss_paper_open(NULL, data));
  ss_paper_free(NULL);
  ck_assert_str_eq(ss_layer_name(SS_STABLE), "stable");
  ck_assert_ptr_null(ss_layer_name(SS_LAYERS));
}

TEST(jacobians_by_every_method) {
  ss_jacobian *j;
  ss_phases *z;
  for (int m = 0; m < SS_METHODS; m++) {
    ck_assert_msg(ss_jacobian_find(&j, paper, scene, m, SS_CORRECTED, 1, 30) == SS_OK, "%s", ss_error());
    for (int i = 0; i < 4; i++) {
      const ss_number *x = ss_jacobian_entry(j, i / 2, i % 2);
      ck_assert_double_eq_tol(ss_number_double(x), jacobian[i], 1e-15 + ss_number_radius(x));
    }
    if (m <= SS_FD) check_number(ss_jacobian_entry(j, 0, 0), "-3.60604531421378915207335354273");
    ck_assert_double_eq_tol(ss_number_double(ss_jacobian_trace(j)), TRACE, 1e-6);
    ck_assert_double_eq_tol(ss_number_double(ss_jacobian_det(j)), 0, 1e-6);
    ARE_NULL(ss_jacobian_entry(j, 2, 0), ss_jacobian_entry(j, 0, -1));
    ss_jacobian_free(j);
  }
  ck_assert_msg(ss_phases_find(&z, paper, scene, 1, 15) == SS_OK, "%s", ss_error());
  int columns = 0;
  while (ss_phases_column(columns)) columns++;
  ck_assert_int_eq(columns, SS_METHODS + 1);
  ARE(2, ss_phases_rows(z, SS_J), ss_phases_columns(z, SS_J));
  for (int c = 1; c < columns; c++) {
    ck_assert_double_eq_tol(ss_number_double(ss_phases_entry(z, SS_J, c, 0, 1)), jacobian[1], 1e-5);
    ck_assert_int_eq(ss_phases_departs(z, SS_J, c, 0, 1), 0);
  }
  ARE_NULL(ss_phases_entry(z, SS_J, columns, 0, 0), ss_phases_entry(z, SS_MATRICES, 0, 0, 0),
           ss_phases_entry(z, SS_J, 0, 2, 0));
  ck_assert_int_eq(ss_phases_rows(z, -1), 0);
  ss_phases_free(z);
}

TEST(jacobians_that_cannot_be_asked_for) {
  ss_jacobian *j;
  ss_phases *z;
  FAIL(SS_ARGUMENT, ss_jacobian_find(&j, paper, scene, SS_METHODS, SS_CORRECTED, 1, 15),
       ss_jacobian_find(&j, paper, scene, SS_ANALYTIC, SS_LAYERS, 1, 15),
       ss_jacobian_find(&j, paper, scene, SS_ANALYTIC, SS_PRINTED, SS_AT_PARAMETERS, 15),
       ss_jacobian_find(&j, paper, scene, SS_ANALYTIC, SS_PRINTED, 1, 0),
       ss_jacobian_find(&j, NULL, scene, SS_ANALYTIC, SS_PRINTED, 1, 15),
       ss_jacobian_find(&j, paper, NULL, SS_ANALYTIC, SS_PRINTED, 1, 15),
       ss_jacobian_find(NULL, paper, scene, SS_ANALYTIC, SS_PRINTED, 1, 15));
  FAILS_SAYING(SS_INPUT, "no orbit 3; 2 are found", ss_jacobian_find(&j, paper, scene, SS_IMPLICIT, SS_PRINTED, 2, 15));
  ck_assert_ptr_null(j);
  FAIL(SS_INPUT, ss_jacobian_find(&j, paper, other, SS_IMPLICIT, SS_PRINTED, 0, 15),
       ss_phases_find(&z, paper, scene, 2, 15));
  FAIL(SS_ARGUMENT, ss_phases_find(&z, paper, NULL, 0, 15), ss_phases_find(NULL, paper, scene, 0, 15));
  ss_jacobian_free(NULL);
  ss_phases_free(NULL);
  ARE_NULL(ss_jacobian_entry(NULL, 0, 0), ss_jacobian_trace(NULL), ss_jacobian_det(NULL),
           ss_phases_entry(NULL, 0, 0, 0, 0));
  ck_assert_int_eq(ss_phases_columns(NULL, 0) + ss_phases_departs(NULL, 0, 0, 0, 0), 0);
  ck_assert_str_eq(ss_method_name(SS_ODE), "ode");
  ck_assert_ptr_null(ss_method_name(-1));
}

/* --- simulate.h --- */

struct heard {
  int events, samples, most;
};
static int hear_event(void *self, const ss_event *e) {
  struct heard *h = self;
  ck_assert(e->mass == 0 || e->mass == 1);
  ck_assert_int_ne(e->from, e->to);
  return ++h->events != h->most;
}
static int hear_sample(void *self, const ss_moment *m) {
  struct heard *h = self;
  h->samples++;
  return m->t >= 0;
}

TEST(a_motion_comes_back_after_a_period) {
  const double period = T_A + T_B + T_C + T_D;
  double p[7], start[4];
  ss_moment end;
  ss_motion *m;
  ck_assert_msg(ss_motion_on_orbit(&m, scene, 1) == SS_OK, "%s", ss_error());
  ck_assert_double_eq_tol(ss_motion_period(m), period, 1e-14);
  ck_assert_int_eq(ss_motion_friction_is_own(m), 1);
  ck_assert_int_eq(ss_motion_parameters(p, m), SS_OK);
  ck_assert_double_eq_tol(p[5] - p[3], 2.7844, 1e-15);
  ck_assert_double_eq(p[2], 1);
  ck_assert_int_eq(ss_motion_start(start, m), SS_OK);
  for (int route = SS_INTEGRATED; route <= SS_CLOSED; route++) {
    struct heard h = {0};
    ck_assert_int_eq(ss_motion_run(&end, m, route, 100, 1, 1, hear_event, hear_sample, &h), SS_OK);
    ck_assert_double_eq_tol(end.t, period, 1e-10);
    for (int i = 0; i < 2; i++) {
      ck_assert_double_eq_tol(end.x[i], start[i], 1e-10);
      ck_assert_int_eq(end.mode[i], SS_STICK);
    }
    ck_assert_int_eq(h.events, 4);
    ck_assert_int_eq(h.samples, 7);
    h = (struct heard){.most = 2};
    FAIL(SS_STOPPED, ss_motion_run(NULL, m, route, 100, 0, 0, hear_event, NULL, &h));
    ck_assert_int_eq(ss_motion_run(NULL, m, route, 1, 0, 0, NULL, NULL, NULL), SS_OK);
    FAILS_SAYING(SS_ARGUMENT, "duration, or returns", ss_motion_run(&end, m, route, INFINITY, 0, 0, NULL, NULL, NULL));
    FAILS_SAYING(SS_ARGUMENT, "duration is", ss_motion_run(&end, m, route, NAN, 1, 0, NULL, NULL, NULL));
    FAILS_SAYING(SS_ARGUMENT, "duration is", ss_motion_run(&end, m, route, -1, 1, 0, NULL, NULL, NULL));
    FAILS_SAYING(SS_ARGUMENT, "returns is", ss_motion_run(&end, m, route, 1, -1, 0, NULL, NULL, NULL));
    FAILS_SAYING(SS_ARGUMENT, "sample is", ss_motion_run(&end, m, route, 1, 0, -1, NULL, NULL, NULL));
    FAILS_SAYING(SS_ARGUMENT, "sample is", ss_motion_run(&end, m, route, 1, 0, NAN, NULL, NULL, NULL));
    ck_assert_int_eq(ss_motion_run(NULL, m, route, 10, 0, 1e-300, NULL, NULL, NULL), SS_OK);
  }
  struct heard all = {0};
  FAIL(SS_UNABLE, ss_motion_run(&end, m, SS_CLOSED, INFINITY, 1, 1e-300, NULL, hear_sample, &all));
  ck_assert_int_eq(all.samples, 10000000);
  FAIL(SS_ARGUMENT, ss_motion_run(&end, m, 2, 1, 0, 0, NULL, NULL, NULL),
       ss_motion_run(&end, NULL, 0, 1, 0, 0, NULL, NULL, NULL));
  ss_motion_free(m);
}

TEST(motions_from_elsewhere) {
  static const double rest[4] = {0, 0, 0, 0}, wild[4] = {0, INFINITY, 0, 0};
  double p[7], start[4];
  ss_motion *m;
  ARE(SS_OK, ss_motion_printed(&m, scene), ss_motion_start(start, m));
  ck_assert_double_eq(start[2], 1);
  ss_motion_free(m);
  ARE(SS_OK, ss_motion_from(&m, scene, rest), ss_motion_start(start, m));
  ck_assert_mem_eq(start, rest, sizeof start);
  FAIL(SS_ARGUMENT, ss_motion_parameters(NULL, m), ss_motion_start(NULL, m));
  ss_motion_free(m);
  FAIL(SS_ARGUMENT, ss_motion_from(&m, scene, wild));
  ck_assert_ptr_null(m);
  FAIL(SS_ARGUMENT, ss_motion_from(&m, scene, NULL), ss_motion_from(NULL, scene, rest));
  FAIL(SS_INPUT, ss_motion_on_orbit(&m, scene, 2));
  FAIL(SS_ARGUMENT, ss_motion_on_orbit(&m, scene, (size_t)-1), ss_motion_on_orbit(&m, NULL, 0),
       ss_motion_on_orbit(NULL, scene, 0), ss_motion_printed(&m, NULL), ss_motion_printed(NULL, scene));
  ck_assert_int_eq(ss_scene_set(scene, "printed="), SS_OK);
  FAIL(SS_INPUT, ss_motion_printed(&m, scene));
  FAIL(SS_ARGUMENT, ss_motion_parameters(p, NULL), ss_motion_start(start, NULL));
  ck_assert(isnan(ss_motion_period(NULL)));
  ck_assert_int_eq(ss_motion_friction_is_own(NULL), 0);
  ss_motion_free(NULL);
}

/* --- sweep.h, words.h, bifurcate.h --- */

struct swept {
  size_t rows, points, stop;
  double trace;
};
static int take_row(void *self, const ss_swept *row) {
  struct swept *w = self;
  w->rows++;
  w->points += row->orbit == 0;
  if (row->admissible == SS_TRUE) w->trace = row->out[SS_OUT_TRACE];
  ck_assert(row->orbits > 0 || isnan(row->out[SS_OUT_Z10]));
  return w->rows != w->stop;
}

TEST(a_sweep_tells_every_point) {
  struct swept w = {0};
  ck_assert_msg(ss_sweep(scene, "e2", "0.5", "0.8587", 3001, 0, take_row, &w) == SS_OK, "%s", ss_error());
  ck_assert_uint_eq(w.points, 3001);
  ck_assert_uint_gt(w.rows, 3001);
  ck_assert_double_eq_tol(w.trace, TRACE, 1e-14); /* of the last point */
  w = (struct swept){.stop = 5};
  FAIL(SS_STOPPED, ss_sweep(scene, "e2", "0.5", "0.8587", 3001, 1, take_row, &w));
  ck_assert_uint_eq(w.rows, 5);
  w = (struct swept){0};
  ck_assert_int_eq(ss_sweep(scene, "e2", "100", "100", 1, 0, take_row, &w), SS_OK);
  ck_assert_uint_eq(w.points, 1);
  FAIL(SS_ARGUMENT, ss_sweep(scene, "u_r1", "1", "2", 3, 0, take_row, &w),
       ss_sweep(scene, "e2", "1", "2", 0, 0, take_row, &w), ss_sweep(scene, "e2", "1", "1", 2, 0, take_row, &w),
       ss_sweep(scene, "e2", "1", "2", 3, 70000, take_row, &w), ss_sweep(scene, "e2", "1", "2", 3, 0, NULL, &w),
       ss_sweep(NULL, "e2", "1", "2", 3, 0, take_row, &w), ss_sweep(scene, NULL, "1", "2", 3, 0, take_row, &w));
  FAIL(SS_INPUT, ss_sweep(scene, "e2", "1", "x", 3, 0, take_row, &w),
       ss_sweep(scene, "chi", "1/2", "1", 3, 0, take_row, &w),
       ss_sweep(scene, "e2", "1e-5000", "1", 3, 0, take_row, &w));
  ck_assert_int_eq(ss_scene_set(scene, "u_r2=2"), SS_OK);
  FAIL(SS_INPUT, ss_sweep(scene, "e2", "1", "3", 3, 0, take_row, &w));
}

TEST(words_and_their_orbits) {
  char *why;
  enum ss_fate fate;
  int n = 0;
  ss_word_orbits *o;
  ck_assert_int_eq(ss_word_fate(&fate, &why, "DGHC"), SS_OK);
  ck_assert_int_eq(fate, SS_OPEN);
  ck_assert_str_eq(why, "");
  ss_text_free(why);
  ck_assert_int_eq(ss_word_fate(&fate, &why, "D-Gamma"), SS_OK);
  ck_assert_int_eq(fate, SS_UNCLOSED);
  ck_assert_uint_gt(strlen(why), 0);
  ss_text_free(why);
  ck_assert_int_eq(ss_word_fate(&fate, NULL, "H"), SS_OK);
  ck_assert_int_eq(fate, SS_FAMILY);
  FAIL(SS_INPUT, ss_word_fate(&fate, &why, "D-Q"));
  FAIL(SS_ARGUMENT, ss_word_fate(&fate, NULL, NULL), ss_word_fate(NULL, NULL, "D"));
  FAIL(SS_STOPPED, ss_word_each(2, count_names, &n));
  FAIL(SS_ARGUMENT, ss_word_each(9, count_names, &n));
  ck_assert_msg(ss_word_orbits_find(&o, other, NULL, 20) == SS_OK, "%s", ss_error());
  ck_assert_uint_eq(ss_word_orbits_count(o), 1);
  ck_assert_uint_eq(ss_word_orbits_phases(o), 4);
  for (size_t i = 0; i < 4; i++) /* tests/oracle/words.tsv, which begins with Gamma */
    if (strcmp(ss_word_orbit_phase(o, 0, i), "D") == 0)
      check_number(ss_word_orbit_time(o, 0, i), "27.676004181106530427");
  check_number(ss_word_orbit_period(o, 0), "39.678352581609762185");
  check_number(ss_word_orbit_state(o, 0, 0, 0), "13.849752178481215614");
  ck_assert_int_eq(ss_word_orbit_free_coordinates(o, 0), 1);
  ck_assert_str_eq(ss_word_orbit_free_coordinate(o, 0, 0), "x2");
  check_number(ss_word_orbit_jacobian(o, 0, 0, 0), "-1.0181816001022901382");
  ck_assert_int_eq(ss_word_orbit_stable(o, 0), SS_FALSE);
  ck_assert_int_eq(ss_word_orbit_admissible(o, 0), SS_TRUE);
  ck_assert_int_eq(ss_word_orbit_certified(o, 0), 1);
  ARE_NULL(ss_word_orbit_phase(o, 0, 4), ss_word_orbit_time(o, 1, 0), ss_word_orbit_state(o, 0, 0, 4),
           ss_word_orbit_jacobian(o, 0, 1, 0), ss_word_orbit_free_coordinate(o, 0, 1));
  ss_word_orbits_free(o);
  FAIL(SS_DOMAIN, ss_word_orbits_find(&o, other, "D-Gamma", 15));
  ck_assert_ptr_null(o);
  FAIL(SS_INPUT, ss_word_orbits_find(&o, other, "H-X", 15), ss_word_orbits_find(&o, other, "no", 15));
  FAIL(SS_ARGUMENT, ss_word_orbits_find(&o, other, NULL, 1001), ss_word_orbits_find(&o, NULL, NULL, 15),
       ss_word_orbits_find(NULL, other, NULL, 15));
  ss_word_orbits_free(NULL);
  ck_assert_uint_eq(ss_word_orbits_count(NULL) + ss_word_orbits_phases(NULL), 0);
  ck_assert_ptr_null(ss_word_orbit_period(NULL, 0));
  ARE(SS_UNKNOWN, ss_word_orbit_stable(NULL, 0), ss_word_orbit_admissible(NULL, 0));
  ck_assert_int_eq(ss_word_orbit_certified(NULL, 0), 0);
}

TEST(where_the_multiplier_passes_minus_one) {
  ss_changes *c;
  ck_assert_msg(ss_changes_find(&c, scene, "e2", "1.79", "1.83", 15) == SS_OK, "%s", ss_error());
  ARE(0, ss_changes_missed(c), ss_changes_cut_short(c));
  size_t flip = 0;
  while (ss_change_kind(c, flip) && strcmp(ss_change_kind(c, flip), "flip") != 0) flip++;
  ck_assert_uint_lt(flip, ss_changes_count(c));
  const double at = 1.811058203021906928; /* tests/oracle/bifurcations.tsv */
  ck_assert_double_lt(ss_number_double(ss_change_low(c, flip)), at);
  ck_assert_double_gt(ss_number_double(ss_change_high(c, flip)), at);
  ck_assert_double_eq_tol(ss_number_double(ss_change_low(c, flip)), at, 2e-14);
  ck_assert_double_eq_tol(ss_number_double(ss_change_trace(c, flip)), -1, 1e-10);
  ck_assert_double_gt(ss_number_double(ss_change_t_b(c, flip)), 0);
  ck_assert_double_gt(ss_number_double(ss_change_t_c(c, flip)), 0);
  ARE(1, ss_change_proved(c, flip), ss_change_unique(c, flip));
  ck_assert_uint_le(ss_change_branch(c, flip), 5);
  for (int side = 0; side < 2; side++) {
    ck_assert_uint_eq(ss_change_orbits(c, flip, side), 1);
    ck_assert_int_eq(ss_change_stable(c, flip, side, 0), side ? SS_TRUE : SS_FALSE);
    ck_assert_int_eq(ss_change_admissible(c, flip, side, 0), SS_TRUE);
    ck_assert_int_eq(ss_change_stable(c, flip, side, 1), SS_UNKNOWN);
  }
  ck_assert_uint_eq(ss_change_orbits(c, flip, 2), 0);
  ARE_NULL(ss_change_kind(c, ss_changes_count(c)), ss_change_low(c, 1000), ss_change_high(c, 1000));
  ss_changes_free(c);
  FAIL(SS_INPUT, ss_changes_find(&c, scene, "e2", "1", "1", 15));
  ck_assert_ptr_null(c);
  FAIL(SS_INPUT, ss_changes_find(&c, scene, "e2", "1", "0", 15));
  FAIL(SS_ARGUMENT, ss_changes_find(&c, scene, "t_a", "1", "2", 15), ss_changes_find(&c, scene, "e2", "1", "2", 0),
       ss_changes_find(&c, NULL, "e2", "1", "2", 15), ss_changes_find(NULL, scene, "e2", "1", "2", 15));
  ss_changes_free(NULL);
  ARE(0, ss_changes_count(NULL) + ss_changes_missed(NULL) + ss_change_branch(NULL, 0),
      ss_changes_cut_short(NULL) + ss_change_proved(NULL, 0) + ss_change_unique(NULL, 0));
  ck_assert_ptr_null(ss_change_t_b(NULL, 0));
  ck_assert_int_eq(ss_change_admissible(NULL, 0, 0, 0), SS_UNKNOWN);
}

/* --- audit.h --- */

static void take_progress(void *self, size_t done, size_t of) {
  *(size_t *)self = done <= of ? of : 0;
}

TEST(an_audit_of_one_claim) {
  char *text;
  size_t pieces = 0;
  ss_audit *a;
  ck_assert_msg(ss_audit_run(&a, paper, scene, "eq-40", 1, take_progress, &pieces) == SS_OK, "%s", ss_error());
  ck_assert_uint_gt(pieces, 0);
  ck_assert_uint_ge(ss_audit_count(a), 1); /* and those of its parts */
  ck_assert_uint_eq(ss_audit_unexpected(a), 0);
  ck_assert_str_eq(ss_finding_text(a, 0, SS_FINDING_ID), "eq-40");
  ck_assert_str_eq(ss_finding_text(a, 0, SS_FINDING_CONDITION), "V = 1");
  ck_assert_str_eq(ss_finding_text(a, 0, SS_FINDING_CORRECTION),
                   "ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100))");
  ARE(SS_CONDITIONAL, ss_finding_verdict(a, 0), ss_finding_recorded(a, 0));
  ck_assert_int_eq(ss_finding_corrected(a, 0), SS_PROVED);
  ck_assert_uint_gt(ss_evidence_count(a, 0), 1);
  bool differs = false;
  for (size_t i = 0; i < ss_evidence_count(a, 0); i++) {
    ck_assert_ptr_nonnull(ss_evidence_text(a, 0, i, SS_EVIDENCE_ROUTE));
    ck_assert_int_ge(ss_evidence_trials(a, 0, i), -1);
    ck_assert_int_ge(ss_evidence_bits(a, 0, i), -1);
    differs |= strcmp(ss_evidence_text(a, 0, i, SS_EVIDENCE_RESULT), "differs") == 0;
  }
  ck_assert(differs);
  ARE_NULL(ss_evidence_text(a, 0, 1000, SS_EVIDENCE_ROUTE), ss_evidence_text(a, 0, 0, SS_EVIDENCE_FIELDS),
           ss_finding_text(a, 0, SS_FINDING_FIELDS), ss_finding_text(a, ss_audit_count(a), SS_FINDING_ID));
  ck_assert_int_eq(ss_audit_json(&text, a), SS_OK);
  ck_assert_ptr_nonnull(strstr(text, "\"eq-40\""));
  ss_text_free(text);
  ck_assert_msg(ss_audit_write(a, scratch_path("report")) == SS_OK, "%s", ss_error());
  ck_assert_ptr_nonnull(strstr(scratch_list(scratch_path("report")), "index.html"));
  FAIL(SS_INPUT, ss_audit_write(a, scratch_put("file", "")));
  FAIL(SS_ARGUMENT, ss_audit_write(a, ""), ss_audit_write(NULL, "report"), ss_audit_json(NULL, a),
       ss_audit_json(&text, NULL));
  ss_audit_free(a);
}

/* Where freed memory is watched (make asan). */
TEST(an_audit_outlives_paper_and_scene) {
  ss_scene *own_scene;
  ss_paper *own_paper;
  ss_audit *a;
  char *text;
  ck_assert_int_eq(ss_scene_open(&own_scene, "paper", data) | ss_paper_open(&own_paper, data), SS_OK);
  ck_assert_int_eq(ss_audit_run(&a, own_paper, own_scene, "eq-27", 1, NULL, NULL), SS_OK);
  ss_scene_free(own_scene);
  ss_paper_free(own_paper);
  ck_assert_int_eq(ss_audit_json(&text, a), SS_OK);
  ck_assert_ptr_nonnull(strstr(text, "\"eq-27\""));
  ss_text_free(text);
  ss_audit_free(a);
}

TEST(audits_that_cannot_be_asked_for) {
  ss_audit *a;
  FAIL(SS_INPUT, ss_audit_run(&a, paper, scene, "no-such-claim", 1, NULL, NULL));
  ck_assert_ptr_null(a);
  FAIL(SS_INPUT, ss_audit_run(&a, paper, other, "eq-40", 1, NULL, NULL));
  FAIL(SS_ARGUMENT, ss_audit_run(&a, paper, scene, "eq-40,,eq-27", 1, NULL, NULL),
       ss_audit_run(&a, paper, scene, "", 1, NULL, NULL), ss_audit_run(&a, paper, scene, "eq-40", 0, NULL, NULL),
       ss_audit_run(&a, NULL, scene, "eq-40", 1, NULL, NULL), ss_audit_run(&a, paper, NULL, "eq-40", 1, NULL, NULL),
       ss_audit_run(NULL, paper, scene, "eq-40", 1, NULL, NULL));
  ss_audit_free(NULL);
  size_t i = 0;
  while (ss_claim_id(paper, i) && strcmp(ss_claim_id(paper, i), "eq-40") != 0) i++;
  ck_assert_uint_lt(i, ss_claims_count(paper));
  ck_assert_str_eq(ss_claim_attribute(paper, i, "record"), "conditional");
  ARE_NULL(ss_claim_attribute(paper, i, "no such attribute"), ss_claim_attribute(paper, i, NULL),
           ss_claim_id(paper, ss_claims_count(paper)), ss_claim_attribute(NULL, 0, "title"));
  ARE(0, ss_claims_count(NULL) + ss_audit_count(NULL) + ss_audit_unexpected(NULL), ss_evidence_count(NULL, 0));
  ck_assert_int_eq(ss_evidence_trials(NULL, 0, 0) + ss_evidence_bits(NULL, 0, 0), -2);
  ARE_NULL(ss_finding_text(NULL, 0, SS_FINDING_ID), ss_evidence_text(NULL, 0, 0, SS_EVIDENCE_ROUTE));
  ARE(SS_VERDICTS, ss_finding_verdict(NULL, 0), ss_finding_recorded(NULL, 0), ss_finding_corrected(NULL, 0));
  ck_assert_str_eq(ss_verdict_name(SS_UNDECIDED), "unknown");
  ck_assert_ptr_null(ss_verdict_name(SS_VERDICTS));
}
