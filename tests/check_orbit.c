/* What orbit, jacobian and simulate print, held against tests/oracle: numbers rounded here to the digits asked for, and
   compared as strings. */
#include <mpfr.h>

#include "command.h"
#include "test.h"

/* --- Numbers as text --- */

enum { MAX_DIGITS = 1000 };

/* A decimal, or a quotient of two, rounded to nearest to n digits in the notation that num.h promises. */
static const char *rounded(const char *exact, int n) {
  static char shown[MAX_DIGITS + 40];
  char digits[MAX_DIGITS + 3];
  const char *slash = strchr(exact, '/');
  MPFR_NUMBERS(4 * n + 200, x, den);
  const char *top = formatted("%.*s", slash ? (int)(slash - exact) : (int)strlen(exact), exact);
  ck_assert_msg(mpfr_set_str(x, top, 10, MPFR_RNDN) == 0, "%s", exact);
  if (slash) {
    ck_assert(mpfr_set_str(den, slash + 1, 10, MPFR_RNDN) == 0);
    mpfr_div(x, x, den, MPFR_RNDN);
  }
  mpfr_exp_t e;
  mpfr_get_str(digits, &e, 10, (size_t)n, x, MPFR_RNDN); /* 0.ddd 10^e */
  const char *sign = *digits == '-' ? "-" : "", *d = digits + (*digits == '-');
  long point = (long)e;
  if (point - 1 < -6 || point - 1 >= (n > 21 ? n : 21))
    snprintf(shown, sizeof shown, n == 1 ? "%s%.1s%se%+ld" : "%s%.1s.%se%+ld", sign, d, d + 1, point - 1);
  else if (point <= 0)
    snprintf(shown, sizeof shown, "%s0.%.*s%s", sign, (int)-point, "000000", d);
  else if (point >= n)
    snprintf(shown, sizeof shown, "%s%s%.*s", sign, d, (int)point - n, "000000000000000000000");
  else
    snprintf(shown, sizeof shown, "%s%.*s.%s", sign, (int)point, d, d + point);
  return shown;
}

TEST(the_tests_own_rounding) {
  ck_assert_str_eq(rounded("2.7844", 15), "2.78440000000000");
  ck_assert_str_eq(rounded("-0.0000012345678", 3), "-0.00000123");
  ck_assert_str_eq(rounded("-0.00000012345678", 3), "-1.23e-7");
  ck_assert_str_eq(rounded("28/9", 5), "3.1111");
  ck_assert_str_eq(rounded("9.9996", 4), "10.00");
  ck_assert_str_eq(rounded("143.54", 3), "144");
  ck_assert_str_eq(rounded("143.54", 1), "100");
  ck_assert_str_eq(rounded("1e30", 2), "1.0e+30");
}

/* --- The independent data --- */

static struct table orbits; /* lines "set NAME chi eta V e1 e2 ..." and "orbit NAME INDEX z10 ..." */
enum { F_NAME = 1, F_CHI, F_N_ORBITS = 7, F_Z10 = 3, F_TRACE = 10, F_ADMISSIBLE = 13, F_VIOLATIONS };

/* Writes the scene of a set. */
static const char *scene_of(const char *name) {
  char *const *f = orbits.row[table_row(&orbits, "set", name)] + F_CHI;
  const char *file = formatted("%s.scene", name);
  const char *text =
      formatted("title: %s\nchi = %s\neta = %s\nV = %s\ne1 = %s\ne2 = %s\n", name, f[0], f[1], f[2], f[3], f[4]);
  return scratch_put(file, text);
}

static void open_oracle(void) {
  scratch_open();
  orbits = table_read("tests/oracle/orbits.tsv", ANY_COLUMNS);
}

static void close_oracle(void) {
  table_clear(&orbits);
  scratch_close();
}

/* --- orbit --- */

CASE("orbits", .once = {open_oracle, close_oracle}, .seconds = TIME_LIMIT);

/* The numbers of an orbit, in the order of orbits.tsv. */
static const char *const names[] = {"z10", "z20",    "t_a",   "t_b",      "t_c",
                                    "t_d", "period", "trace", "u_r1_min", "u_r2_min"};

/* One orbit of the output at `at`, against its row and its set's. */
static void check_orbit(const char *at, char *const *row, char *const *set, int digits) {
  for (int k = 0; k < 10; k++)
    ck_assert_msg(strcmp(member(at, names[k]), rounded(row[F_Z10 + k], digits)) == 0, "%s, orbit %s: %s is %s, not %s",
                  row[F_NAME], row[2], names[k], member(at, names[k]), rounded(row[F_Z10 + k], digits));
  ck_assert_str_eq(member(at, "e1"), rounded(set[F_CHI + 3], digits));
  ck_assert_str_eq(member(at, "e2"), rounded(set[F_CHI + 4], digits));
  const char *pair = formatted("0,%s", rounded(row[F_TRACE], digits));
  ck_assert_str_eq(list_member(at, "eigenvalues"), pair);
  double trace = strtod(row[F_TRACE], NULL);
  ck_assert_str_eq(member(at, "stable"), trace > -1 && trace < 1 ? "true" : "false");
  ck_assert_str_eq(member(at, "admissible"), strcmp(row[F_ADMISSIBLE], "yes") == 0 ? "true" : "false");
  ck_assert_str_eq(list_member(at, "violations"), strcmp(row[F_VIOLATIONS], "-") == 0 ? "" : row[F_VIOLATIONS]);
  ck_assert_str_eq(member(at, "certified"), "true");
  double radius = strtod(member(at, "radius"), NULL);
  ck_assert_msg(radius > 0 && radius < pow(10, 3 - digits), "%s, orbit %s: radius %g", row[F_NAME], row[2], radius);
}

/* Every orbit of a set and no other, in the order of the data, which is that of z10. */
static void check_orbits(const char *json, const char *name, int digits) {
  int row = table_row(&orbits, "set", name), n = atoi(orbits.row[row][F_N_ORBITS]);
  const char *at = json;
  for (int k = 0; k < n; k++) {
    at = strstr(at, "\"z10\"");
    ck_assert_msg(at != NULL, "%s: %d orbits of %d", name, k, n);
    check_orbit(at, orbits.row[row + 1 + k], orbits.row[row], digits);
    at++;
  }
  ck_assert_msg(!strstr(at, "\"z10\""), "%s: more than %d orbits", name, n);
  ck_assert_str_eq(member(json, "scene"), name);
  ck_assert_str_eq(member(json, "layer"), "model");
  ck_assert_str_eq(member(json, "complete"), "true");
  ck_assert_str_eq(member(json, "gap"), "null");
  ck_assert_str_eq(member(json, "t_c_max"), "null");
}

TEST(orbits_of_every_set) {
  int sets = 0;
  for (int i = 0; i < orbits.n; i++) {
    if (strcmp(orbits.row[i][0], "set") != 0) continue;
    sets++;
    OWNED(job) j = job_run_well("orbit", scene_of(orbits.row[i][F_NAME]), "--digits", "50", "--json", NULL);
    check_orbits(j.out, orbits.row[i][F_NAME], 50);
  }
  ck_assert_int_ge(sets, 30);
}

TEST(digits_as_asked) {
  static const char *const digits[] = {"1", "2", "7", "15", "50"};
  for (size_t i = 0; i < COUNT(digits); i++) {
    OWNED(job) j = job_run_well("orbit", "paper", "--json", "--digits", digits[i], NULL);
    check_orbits(j.out, "paper", atoi(digits[i]));
  }
  OWNED(job) j = job_run_well("orbit", "--digits=15", "--json", "paper", NULL);
  OWNED(job) without = job_run_well("orbit", "paper", "--json", NULL);
  ck_assert_str_eq(j.out, without.out);
}

TEST(a_thousand_digits) {
  OWNED(table) t = table_read("tests/oracle/paper_1000.tsv", 2);
  OWNED(job) j = job_run_well("orbit", "paper", "--digits", "1000", "--json", NULL);
  const char *second = strstr(strstr(j.out, "\"z10\"") + 1, "\"z10\"");
  ck_assert(second != NULL && t.n == 6);
  for (int i = 0; i < t.n; i++) ck_assert_str_eq(member(second, t.row[i][0]), rounded(t.row[i][1], 1000));
}

TEST(text_says_what_json_says) {
  OWNED(job) text = job_run_well("orbit", "paper", NULL);
  OWNED(job) json = job_run_well("orbit", "paper", "--json", NULL);
  const char *at = json.out;
  for (int k = 0; k < 2; k++) {
    at = strstr(at, "\"z10\"");
    ck_assert(at != NULL);
    for (int i = 0; i < 10; i++) ck_assert(strstr(text.out, member(at, names[i])) != NULL);
    at++;
  }
  ck_assert(strstr(text.out, "orbit 1: conditionally stable, not admissible") != NULL);
  ck_assert(strstr(text.out, "orbit 2: unstable, admissible with u_r1, u_r2 above their bounds\n") != NULL);
}

/* --- jacobian --- */

static struct table jacobians; /* SET ORBIT MATRIX ROW COLUMN VALUE */

static void open_jacobians(void) {
  open_oracle();
  jacobians = table_read("tests/oracle/jacobian.tsv", 6);
}

static void close_jacobians(void) {
  table_clear(&jacobians);
  close_oracle();
}

/* The k-th entry of J in the output. */
static const char *entry(const char *json, int k) {
  static char value[4][MAX_DIGITS + 100];
  const char *p = strstr(json, "\"J\": [");
  ck_assert(p != NULL);
  p = strchr(p, '[');
  for (int i = 0; i <= k; i++) {
    p = strchr(p, '"') + 1;
    if (i < k) p = strchr(p, '"') + 1;
  }
  snprintf(value[k], sizeof value[k], "%.*s", (int)strcspn(p, "\""), p);
  return value[k];
}

/* Rows r .. r+3 of the data are the 2x2 derivative of one pass. */
static void check_return_map(int r, const char *method, int digits) {
  char *const *f = jacobians.row[r];
  const char *at = formatted("orbit:%d", atoi(f[1]) + 1);
  const char *n = formatted("%d", digits);
  OWNED(job) j =
      job_run_well("jacobian", scene_of(f[0]), "--at", at, "--method", method, "--digits", n, "--json", NULL);
  for (int k = 0; k < 4; k++)
    ck_assert_msg(strcmp(entry(j.out, k), rounded(jacobians.row[r + k][5], digits)) == 0,
                  "%s %s %s, entry %d: %s, not %s", f[0], at, method, k, entry(j.out, k),
                  rounded(jacobians.row[r + k][5], digits));
  ck_assert_str_eq(member(j.out, "trace"),
                   rounded(orbits.row[table_row(&orbits, "set", f[0]) + atoi(at + 6)][F_TRACE], digits));
  ck_assert_str_eq(member(j.out, "det"), "0");
  ck_assert_str_eq(member(j.out, "method"), method);
  ck_assert_str_eq(member(j.out, "layer"), strcmp(method, "analytic") == 0 ? "corrected" : "model");
  ck_assert_str_eq(member(j.out, "at"), at);
}

CASE("jacobian", .once = {open_jacobians, close_jacobians}, .seconds = TIME_LIMIT);

TEST(three_methods_agree_with_differences_made_elsewhere) {
  static const char *const methods[] = {"analytic", "implicit", "fd"};
  static const int digits[] = {30, 38, 15};
  int maps = 0;
  for (int r = 0; r < jacobians.n; r++) {
    if (strcmp(jacobians.row[r][2], "return") != 0) continue;
    for (int m = 0; m < 3; m++) check_return_map(r, methods[m], digits[maps % 3]);
    maps++;
    r += 3;
  }
  ck_assert_int_ge(maps, 4);
}

/* How many significant digits a printed number shows. */
static int digits_shown(const char *number) {
  int n = 0;
  for (const char *p = number; *p && *p != 'e'; p++)
    if (*p >= '0' && *p <= '9' && (n > 0 || *p != '0')) n++;
  return n;
}

/* Each method prints the digits it answers for, and they are right; work in double precision answers for fewer. */
TEST(every_method_keeps_its_word) {
  static const char *const methods[] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
  int held = 0, integrated = 0;
  for (int r = 0, nth = 0; r < orbits.n; r++) {
    char *const *f = orbits.row[r];
    if (strcmp(f[0], "orbit") != 0 || nth++ % 4 != 0) continue;
    const char *at = formatted("orbit:%d", atoi(f[2]) + 1);
    for (int m = 0; m < 6; m++) {
      bool by_ode = m == 5, in_double = m >= 4;
      if (by_ode && strcmp(f[F_ADMISSIBLE], "yes") != 0) continue; /* Coulomb's law does not follow the others */
      OWNED(job) j = job_run_well("jacobian", scene_of(f[F_NAME]), "--at", at, "--method", methods[m], "--digits", "18",
                                  "--json", NULL);
      const char *trace = member(j.out, "trace");
      int n = digits_shown(trace);
      ck_assert_msg(in_double ? n >= (by_ode ? 2 : 5) : n == 18, "%s %s %s: %s", f[F_NAME], at, methods[m], trace);
      ck_assert_msg(strcmp(trace, rounded(f[F_TRACE], n)) == 0, "%s %s %s: %s, not %s", f[F_NAME], at, methods[m],
                    trace, rounded(f[F_TRACE], n));
      held++;
      integrated += by_ode;
    }
  }
  ck_assert_int_ge(held, 60);
  ck_assert_int_ge(integrated, 4);
}

/* The same numbers, by other forms. */
TEST(the_stable_layer_gives_what_the_corrected_one_does) {
  static const char *const cases[][2] = {{"paper", "orbit:1"},
                                         {"paper", "orbit:2"},
                                         {"paper", "printed"},
                                         {"stable", "orbit:1"},
                                         {"near-singular", "orbit:1"}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    const char *scene = cases[i][0], *at = cases[i][1];
    OWNED(job) stable =
        job_run_well("jacobian", scene, "--at", at, "--layer", "stable", "--digits", "30", "--json", NULL);
    OWNED(job) corrected = job_run_well("jacobian", scene, "--at", at, "--digits", "30", "--json", NULL);
    for (int k = 0; k < 4; k++) {
      const char *first = formatted("%s", entry(stable.out, k));
      ck_assert_str_eq(first, entry(corrected.out, k));
    }
    ck_assert_str_eq(member(stable.out, "layer"), "stable");
  }
}

/* ktilde_4 as printed is V^-2 of what it should be.  It moves x_f and y_f alike, and tr J sees their difference alone:
   so where V is not 1 every entry is wrong and the trace is right; where V = 1 all are right. */
TEST(layers_differ_in_the_entries_not_in_the_trace) {
  static const char *const scenes[] = {"paper", "stable"}; /* V = 1 and V = 1.8 */
  for (int i = 0; i < 2; i++) {
    OWNED(job) printed =
        job_run_well("jacobian", scene_of(scenes[i]), "--layer", "printed", "--digits", "20", "--json", NULL);
    OWNED(job) corrected = job_run_well("jacobian", scene_of(scenes[i]), "--digits", "20", "--json", NULL);
    for (int k = 0; k < 4; k++) {
      const char *first = formatted("%s", entry(printed.out, k));
      ck_assert_msg((strcmp(first, entry(corrected.out, k)) == 0) == (i == 0), "%s, entry %d: %s", scenes[i], k, first);
    }
    ck_assert_str_eq(member(printed.out, "trace"), member(corrected.out, "trace"));
    ck_assert_str_eq(member(printed.out, "layer"), "printed");
    ck_assert_str_eq(member(corrected.out, "layer"), "corrected");
    ck_assert_str_eq(member(printed.out, "at"), i == 0 ? "orbit:2" : "orbit:1"); /* orbits.tsv: the first admissible */
  }
}

/* J_a = (-1, 1)/(1 - chi) stands at the right end of every chain: the columns of J are opposite. */
TEST(at_the_printed_numbers) {
  static const char *const methods[] = {"analytic", "implicit", "fd"};
  for (int m = 0; m < 3; m++) {
    OWNED(job) j = job_run_well("jacobian", "paper", "--at", "printed", "--method", methods[m], "--json", NULL);
    for (int k = 0; k < 4; k += 2) {
      const char *left = entry(j.out, k), *right = entry(j.out, k + 1);
      ck_assert_msg(strcmp(left + (*left == '-'), right + (*right == '-')) == 0 && *left != *right, "%s %s", left,
                    right);
    }
    ck_assert_str_eq(member(j.out, "at"), "printed");
    ck_assert_str_eq(member(j.out, "det"), "0");
  }
}

/* "accuracy 2.4e-11 (...)": the number stands in the text of every method, and the entries are as near as it says to
   those of jacobian.tsv, the first return of which is the paper's second orbit. */
TEST(every_method_states_its_accuracy) {
  static const char *const methods[] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
  static const double most[] = {1e-15, 1e-15, 1e-15, 1e-15, 1e-9, 1e-7};
  int r = 0;
  while (r < jacobians.n && !(strcmp(jacobians.row[r][0], "paper") == 0 && strcmp(jacobians.row[r][2], "return") == 0))
    r++;
  ck_assert(r + 3 < jacobians.n && strcmp(jacobians.row[r][1], "1") == 0);
  for (int m = 0; m < 6; m++) {
    OWNED(job) j = job_run_well("jacobian", "paper", "--at", "orbit:2", "--method", methods[m], NULL);
    double stated = 0;
    char e[4][40];
    const char *accuracy = strstr(j.out, "\naccuracy "), *first = strchr(j.out, '\n');
    ck_assert(accuracy && sscanf(accuracy, "\naccuracy %lf (%*[a-z])", &stated) == 1);
    ck_assert(sscanf(first, "\n %39s %39s\n %39s %39s", e[0], e[1], e[2], e[3]) == 4);
    ck_assert_msg(stated > 0 && stated < most[m], "%s: %g", methods[m], stated);
    for (int k = 0; k < 4; k++) {
      double last_digit = pow(10, -(double)strlen(strchr(e[k], '.') + 1));
      double off = fabs(strtod(e[k], NULL) - strtod(jacobians.row[r + k][5], NULL));
      ck_assert_msg(off <= stated + 0.51 * last_digit, "%s, entry %d: %s is off by %g", methods[m], k, e[k], off);
    }
  }
}

/* --- orbit --method paper --- */

CASE("paper route", .once = {open_oracle, close_oracle});

/* Orbits that Newton's iteration on (44)-(46) comes back to from their own times moved by 2 %, to all digits. */
TEST(the_papers_equations_have_the_same_orbits) {
  static const struct {
    const char *set;
    int index;
  } cases[] = {{"fractions", 0},  {"stable", 0},      {"two-admissible", 1}, {"four-mixed", 1},
               {"chi-small2", 0}, {"negative-ta", 1}, {"eta-large", 0},      {"spread", 1}};
  for (size_t i = 0; i < COUNT(cases); i++) {
    char *const *f = orbits.row[table_row(&orbits, "set", cases[i].set) + 1 + cases[i].index];
    OWNED(job) j = job_run_well("orbit", scene_of(cases[i].set), "--method", "paper", "--digits", "50", "--json", NULL);
    const char *nearest = formatted("orbit:%d", cases[i].index + 1);
    const char *from = formatted("\"from\": \"%s\"", nearest);
    const char *at = strstr(j.out, from);
    ck_assert(at != NULL);
    for (int k = 0; k < 6; k++) ck_assert_str_eq(member(at, names[k]), rounded(f[F_Z10 + k], 50));
    ck_assert_str_eq(member(at, "converged"), "true");
    ck_assert_str_eq(member(at, "nearest"), nearest);
    ck_assert(strtod(member(at, "distance"), NULL) < 1e-50 && strtod(member(at, "equations"), NULL) > 1);
    ck_assert(strtod(member(at, "digits_lost"), NULL) < 4);
  }
}

CASE("jacobian");

/* Columns of the table: every method once, a row for each entry, and a star and a sentence where the printed (40)
   departs: at V = 2 in all of J_f and J. */
TEST(the_table_of_phases) {
  const char *scene = scratch_put("two.scene", "chi = 0.59\neta = 3.1\nV = 2\ne1 = 3.54\ne2 = 0.0657\n");
  OWNED(job) j = job_run_well("jacobian", scene, "--phases", NULL);
  static const char *const rows[] = {"J_a[1,1]", "J_a[1,2]", "J_b[1,1]", "J_b[2,1]", "J_c[1,1]", "J_c[1,2]", "J_c[2,1]",
                                     "J_c[2,2]", "J_c[3,1]", "J_c[3,2]", "J_f[1,1]", "J_f[1,2]", "J_f[1,3]", "J_f[2,1]",
                                     "J_f[2,2]", "J_f[2,3]", "J[1,1]",   "J[1,2]",   "J[2,1]",   "J[2,2]"};
  for (size_t i = 0; i < COUNT(rows); i++) {
    double x[7];
    const char *begin = formatted("\n%s ", rows[i]);
    const char *line = strstr(j.out, begin);
    ck_assert_msg(line != NULL, "no row %s in\n%s", rows[i], j.out);
    bool wrong = i >= 10;
    line += strlen(begin);
    size_t stars = 0, len = strcspn(line, "\n");
    for (size_t k = 0; k < len; k++) stars += line[k] == '*';
    ck_assert_uint_eq(stars, wrong);
    ck_assert_int_eq(sscanf(line, wrong ? "%lf* %lf %lf %lf %lf %lf %lf" : "%lf %lf %lf %lf %lf %lf %lf", &x[0], &x[1],
                            &x[2], &x[3], &x[4], &x[5], &x[6]),
                     7);
    for (int k = 2; k < 7; k++) ck_assert(fabs(x[k] - x[1]) < 1e-6);
    ck_assert((fabs(x[0] - x[1]) > 1e-3) == wrong);
    ck_assert_int_le((int)len, 110);
  }
  ck_assert(strstr(j.out,
                   "\nprinted departs from the other methods at J_f[1,1], J_f[1,2], J_f[1,3], J_f[2,1], J_f[2,2], "
                   "J_f[2,3], J[1,1], J[1,2], J[2,1], J[2,2]\n"));
  ck_assert(strstr(j.out, "\neigenvalues of J 0 and "));
}

/* --- simulate --- */

CASE("simulate", .once = {open_oracle, close_oracle});

/* An admissible orbit, simulated from (1)-(2), meets its four events at the oracle's times and returns. */
TEST(simulation_follows_admissible_orbits) {
  int followed = 0;
  for (int r = 0; r < orbits.n; r++) {
    char *const *f = orbits.row[r];
    if (strcmp(f[0], "orbit") != 0 || strcmp(f[F_ADMISSIBLE], "yes") != 0) continue;
    const char *at = formatted("orbit:%d", atoi(f[2]) + 1);
    OWNED(job) j = job_run_well("simulate", scene_of(f[F_NAME]), "--at", at, NULL);
    ck_assert_msg(strstr(j.out, "\nword (GHCD)^1\n") != NULL, "%s %s:\n%.800s", f[F_NAME], at, j.out);
    ck_assert(strstr(j.out, "the first 4 of 4 events are the same") != NULL);
    const char *line = strchr(strstr(j.out, " t mass change"), '\n') + 1;
    double sum = 0;
    for (int k = 0; k < 4; k++, line = strchr(line, '\n') + 1) {
      sum += strtod(f[F_Z10 + 2 + k], NULL);
      /* printed to seven decimals */
      ck_assert_msg(fabs(strtod(line, NULL) - sum) < 0.5e-7 + 1e-8, "%s %s, event %d: %.40s, not %.12f", f[F_NAME], at,
                    k, line, sum);
    }
    followed++;
  }
  ck_assert_int_ge(followed, 15);
}

TEST(csv_has_a_row_for_each_sample_and_event) {
  OWNED(job) j =
      job_run_well("simulate", "paper", "--at", "orbit:2", "--csv", "--samples", "10", "--periods", "3", NULL);
  ck_assert(strncmp(j.out, "t,x1,x2,v1,v2,mode1,mode2,u1,u2\n", 32) == 0);
  int rows = 0;
  double last = -1;
  for (const char *p = strchr(j.out, '\n') + 1; *p; p = strchr(p, '\n') + 1, rows++) {
    int commas = 0;
    for (const char *q = p; *q != '\n'; q++) commas += *q == ',';
    ck_assert_int_eq(commas, 8);
    ck_assert(strtod(p, NULL) >= last);
    last = strtod(p, NULL);
  }
  ck_assert_int_ge(rows, 3 * (10 + 4));
  ck_assert_int_le(rows, 3 * (10 + 4) + 2);
}

/* From the printed start, for long: both routes meet the same events. */
TEST(the_printed_start_runs_on) {
  OWNED(job) j = job_run_well("simulate", "paper", "--at", "printed", "--periods", "120", NULL);
  size_t same = 0, all = 1;
  const char *p = strstr(j.out, "closed forms: the first ");
  ck_assert(p && sscanf(p, "closed forms: the first %zu of %zu", &same, &all) == 2);
  ck_assert(same == all && all > 400);
  ck_assert(strstr(j.out, "after 120 returns") != NULL);
}

/* The distances from MPFR and their growth, against the trace of orbits.tsv; and a table of three lines a period. */
TEST(routes_compared_over_many_periods) {
  char *const *f = orbits.row[table_row(&orbits, "set", "chi-large") + 2];
  double trace = strtod(f[F_TRACE], NULL), tr = 0, expected = 0, measured = 0;
  long lines = 0, from, to;
  OWNED(job) j =
      job_run_well("simulate", scene_of("chi-large"), "--at", "orbit:2", "--periods", "60", "--compare", NULL);
  for (const char *p = j.out; *p; p = strchr(p, '\n') + 1) lines++;
  ck_assert_int_eq(lines, 2 + 3 * 60 + 3 + 1);
  const char *p = strstr(j.out, "\ntr J = ");
  ck_assert(p && sscanf(p, "\ntr J = %lf: factor %lf a period expected; a displacement of x1 has %lf from %ld to %ld",
                        &tr, &expected, &measured, &from, &to) == 5);
  ck_assert_msg(fabs(tr - trace) < 1e-6 && fabs(expected + trace) < 1e-4 && fabs(measured + trace) < 1e-3, "%s", p);
  p = strstr(j.out, "\nclosed and mpfr: apart by more than 1e-06 at period ");
  ck_assert(p && strstr(p, "; factor "));
  ck_assert_msg(fabs(strtod(strstr(p, "; factor ") + 9, NULL) + trace) < 0.02, "%s", p);
}

/* --- scenes that give other quantities than e1 and e2 --- */

/* The orbit is found again from any two of its six quantities, given to 50 digits. */
TEST(any_two_of_six) {
  static const char *const given[] = {"e1", "e2", "t_a", "t_b", "t_c", "t_d"};
  static const int pairs[][2] = {{3, 4}, {0, 3}, {1, 4}, {2, 3}, {3, 5}};
  int r = table_row(&orbits, "set", "paper");
  char *const *set = orbits.row[r], *const *f = orbits.row[r + 2];
  for (size_t k = 0; k < COUNT(pairs); k++) {
    char text[800];
    int n = snprintf(text, sizeof text, "chi = %s\neta = %s\nV = %s\n", set[F_CHI], set[F_CHI + 1], set[F_CHI + 2]);
    for (int i = 0; i < 2; i++) {
      int q = pairs[k][i];
      n += snprintf(text + n, sizeof text - (size_t)n, "%s = %s\n", given[q],
                    q < 2 ? set[F_CHI + 3 + q] : rounded(f[F_Z10 + q], 50));
    }
    OWNED(job) j = job_run_well("orbit", scratch_put("two.scene", text), "--digits", "30", "--json", NULL);
    const char *want = formatted("\"z10\": \"%s\"", rounded(f[F_Z10], 30));
    ck_assert_msg(strstr(j.out, want) != NULL, "%s and %s: no %s in\n%.1500s", given[pairs[k][0]], given[pairs[k][1]],
                  want, j.out);
  }
}
