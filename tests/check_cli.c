/* The program as its users meet it: started as a process, seen through its output, its exit status and its files.

   $STICKSLIP is the program (build/stickslip without it), $PYTHON runs the checker of JSON; both as the Makefile sets
   them.  Numbers come from tests/oracle, rounded here to the digits asked for, and are compared as strings. */
#include <check.h>
#include <fcntl.h>
#include <glob.h>
#include <math.h>
#include <mpfr.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/text.h"
#include "process.h"
#include "scratch.h"
#include "suites.h"

/* --- Processes --- */

enum { MAX_ARGS = 120, TIME_LIMIT = 300 };

struct job {
  pid_t pid;
  const char *out_path, *err_path;
  int status; /* exit status, or minus the signal; -1000 while it runs */
  char *out, *err;
};

/* The whole file with a NUL at its end, to be freed; NULL when it cannot be read. */
static char *slurp(const char *path) {
  FILE *f = fopen(path, "rb");
  if (!f) return NULL;
  struct text t;
  text_init(&t);
  char chunk[65536];
  for (size_t n = fread(chunk, 1, sizeof chunk, f); n > 0; n = fread(chunk, 1, sizeof chunk, f))
    text_add_n(&t, chunk, n);
  text_add(&t, "");
  fclose(f);
  return t.data;
}

static void redirect(const char *path, int to) {
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || dup2(fd, to) < 0) _exit(126);
  close(fd);
}

static rlim_t largest_file; /* bytes that a started program can write to a file, as on a disk that is full; 0: any */

static void limit_files(void) {
  struct rlimit limit = {largest_file, largest_file};
  if (!largest_file) return;
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  count_nothing();
}

/* stdout_to: a device to write to, or NULL for a file that is read back. */
static void start(struct job *j, const char *stdout_to, const char *file, const char *const *args) {
  static int serial;
  char name[32];
  snprintf(name, sizeof name, "job%d.out", ++serial);
  *j = (struct job){.status = -1000, .out_path = stdout_to ? stdout_to : scratch_path(name)};
  snprintf(name, sizeof name, "job%d.err", serial);
  j->err_path = scratch_path(name);
  char *argv[MAX_ARGS + 2] = {(char *)(uintptr_t)file};
  for (int i = 0; args[i]; i++) {
    ck_assert(i < MAX_ARGS);
    argv[i + 1] = (char *)(uintptr_t)args[i];
  }
  fflush(NULL);
  j->pid = fork();
  ck_assert(j->pid >= 0);
  if (j->pid == 0) {
    process_as_from_a_shell();
    redirect(j->out_path, STDOUT_FILENO);
    redirect(j->err_path, STDERR_FILENO);
    limit_files();
    alarm(TIME_LIMIT);
    execv(file, argv);
    _exit(127);
  }
}

static void finish(struct job *j) {
  j->status = process_end(j->pid);
  ck_assert_msg(j->status != 127 && j->status != 126, "cannot start %s", program());
  j->out = strncmp(j->out_path, "/dev/", 5) == 0 ? NULL : slurp(j->out_path);
  j->err = slurp(j->err_path);
  ck_assert(j->err != NULL);
}

static void discard(struct job *j) {
  free(j->out);
  free(j->err);
  *j = (struct job){.status = -1000};
}

static void collect(const char **args, const char *first, va_list ap) {
  int n = 0;
  for (const char *a = first; a; a = va_arg(ap, const char *)) {
    ck_assert(n < MAX_ARGS);
    args[n++] = a;
  }
  args[n] = NULL;
}

/* run(&j, "orbit", "paper", NULL) */
static void run(struct job *j, const char *first, ...) {
  const char *args[MAX_ARGS + 1];
  va_list ap;
  va_start(ap, first);
  collect(args, first, ap);
  va_end(ap);
  start(j, NULL, program(), args);
  finish(j);
}

/* The same, which must go well and say nothing on stderr. */
static void run_well(struct job *j, const char *first, ...) {
  const char *args[MAX_ARGS + 1];
  va_list ap;
  va_start(ap, first);
  collect(args, first, ap);
  va_end(ap);
  start(j, NULL, program(), args);
  finish(j);
  ck_assert_msg(j->status == 0 && !*j->err, "%s %s...: status %d, %.1500s", first, args[1] ? args[1] : "", j->status,
                j->err);
}

/* --- Numbers as text --- */

enum { MAX_DIGITS = 1000 };

/* A decimal, or a quotient of two, rounded to nearest to n digits in the notation that num.h promises. */
static const char *rounded(const char *exact, int n) {
  static char shown[MAX_DIGITS + 40];
  char digits[MAX_DIGITS + 3], top[MAX_DIGITS + 100];
  const char *slash = strchr(exact, '/');
  mpfr_t x, den;
  mpfr_init2(x, 4 * n + 200);
  mpfr_init2(den, 4 * n + 200);
  snprintf(top, sizeof top, "%.*s", slash ? (int)(slash - exact) : (int)strlen(exact), exact);
  ck_assert_msg(mpfr_set_str(x, top, 10, MPFR_RNDN) == 0, "%s", exact);
  if (slash) {
    ck_assert(mpfr_set_str(den, slash + 1, 10, MPFR_RNDN) == 0);
    mpfr_div(x, x, den, MPFR_RNDN);
  }
  mpfr_exp_t e;
  mpfr_get_str(digits, &e, 10, (size_t)n, x, MPFR_RNDN); /* 0.ddd 10^e */
  mpfr_clear(den);
  mpfr_clear(x);
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

START_TEST(the_tests_own_rounding) {
  ck_assert_str_eq(rounded("2.7844", 15), "2.78440000000000");
  ck_assert_str_eq(rounded("-0.0000012345678", 3), "-0.00000123");
  ck_assert_str_eq(rounded("-0.00000012345678", 3), "-1.23e-7");
  ck_assert_str_eq(rounded("28/9", 5), "3.1111");
  ck_assert_str_eq(rounded("9.9996", 4), "10.00");
  ck_assert_str_eq(rounded("143.54", 3), "144");
  ck_assert_str_eq(rounded("143.54", 1), "100");
  ck_assert_str_eq(rounded("1e30", 2), "1.0e+30");
}
END_TEST

/* The value of the first "key": after from, without quotes; lists are cut at their first line. */
static const char *member(const char *from, const char *key) {
  static char value[8][MAX_DIGITS + 100];
  static int next;
  char quoted[64];
  next = (next + 1) % 8;
  snprintf(quoted, sizeof quoted, "\"%s\": ", key);
  const char *p = strstr(from, quoted);
  ck_assert_msg(p != NULL, "no member %s in %.300s", key, from);
  p += strlen(quoted);
  bool string = *p == '"';
  size_t n = string ? strcspn(p + 1, "\"") : strcspn(p, ",\n");
  ck_assert(n < sizeof value[0]);
  snprintf(value[next], sizeof value[0], "%.*s", (int)n, p + string);
  return value[next];
}

/* The strings of the list "key": [...] after from, joined with commas. */
static const char *list_member(const char *from, const char *key) {
  static char joined[400];
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": [", key);
  const char *p = strstr(from, quoted);
  ck_assert_msg(p != NULL, "no list %s", key);
  p += strlen(quoted);
  const char *end = strchr(p, ']');
  joined[0] = '\0';
  for (p = strchr(p, '"'); p && p < end; p = strchr(p, '"')) {
    size_t n = strcspn(++p, "\""), at = strlen(joined);
    snprintf(joined + at, sizeof joined - at, "%s%.*s", at ? "," : "", (int)n, p);
    p += n + 1;
  }
  return joined;
}

/* --- The independent data --- */

enum { N_FIELDS = 15, MAX_ROWS = 1000 };

struct table {
  char *text;
  const char *field[MAX_ROWS][N_FIELDS];
  int n;
};

static void table_read(struct table *t, const char *path) {
  *t = (struct table){.text = slurp(path)};
  ck_assert_msg(t->text != NULL, "cannot read %s; the tests run in the project's folder", path);
  for (char *line = strtok(t->text, "\n"); line; line = strtok(NULL, "\n")) {
    if (*line == '#') continue;
    ck_assert(t->n < MAX_ROWS);
    for (int k = 0; k < N_FIELDS && line; k++) {
      t->field[t->n][k] = line;
      line = strchr(line, '\t');
      if (line) *line++ = '\0';
    }
    t->n++;
  }
}

static struct table orbits; /* lines "set NAME chi eta V e1 e2 ..." and "orbit NAME INDEX z10 ..." */
enum { F_NAME = 1, F_CHI, F_N_ORBITS = 7, F_Z10 = 3, F_TRACE = 10, F_ADMISSIBLE = 13, F_VIOLATIONS };

static int set_row(const char *name) {
  for (int i = 0; i < orbits.n; i++)
    if (strcmp(orbits.field[i][0], "set") == 0 && strcmp(orbits.field[i][F_NAME], name) == 0) return i;
  ck_abort_msg("no set %s", name);
}

/* Writes the scene of a set. */
static const char *scene_of(const char *name) {
  const char *const *f = orbits.field[set_row(name)] + F_CHI;
  char file[80], text[600];
  snprintf(file, sizeof file, "%s.scene", name);
  snprintf(text, sizeof text, "title: %s\nchi = %s\neta = %s\nV = %s\ne1 = %s\ne2 = %s\n", name, f[0], f[1], f[2], f[3],
           f[4]);
  return scratch_put(file, text);
}

static void open_oracle(void) {
  scratch_open();
  table_read(&orbits, "tests/oracle/orbits.tsv");
}

static void close_oracle(void) {
  free(orbits.text);
  scratch_close();
}

/* --- orbit --- */

/* One orbit of the output at `at`, against its row and its set's. */
static void check_orbit(const char *at, const char *const *row, const char *const *set, int digits) {
  static const char *const names[] = {"z10", "z20",    "t_a",   "t_b",      "t_c",
                                      "t_d", "period", "trace", "u_r1_min", "u_r2_min"};
  for (int k = 0; k < 10; k++)
    ck_assert_msg(strcmp(member(at, names[k]), rounded(row[F_Z10 + k], digits)) == 0, "%s, orbit %s: %s is %s, not %s",
                  row[F_NAME], row[2], names[k], member(at, names[k]), rounded(row[F_Z10 + k], digits));
  ck_assert_str_eq(member(at, "e1"), rounded(set[F_CHI + 3], digits));
  ck_assert_str_eq(member(at, "e2"), rounded(set[F_CHI + 4], digits));
  char pair[MAX_DIGITS + 100];
  snprintf(pair, sizeof pair, "0,%s", rounded(row[F_TRACE], digits));
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
  int row = set_row(name), n = atoi(orbits.field[row][F_N_ORBITS]);
  const char *at = json;
  for (int k = 0; k < n; k++) {
    at = strstr(at, "\"z10\"");
    ck_assert_msg(at != NULL, "%s: %d orbits of %d", name, k, n);
    check_orbit(at, orbits.field[row + 1 + k], orbits.field[row], digits);
    at++;
  }
  ck_assert_msg(!strstr(at, "\"z10\""), "%s: more than %d orbits", name, n);
  ck_assert_str_eq(member(json, "scene"), name);
  ck_assert_str_eq(member(json, "layer"), "model");
  ck_assert_str_eq(member(json, "complete"), "true");
  ck_assert_str_eq(member(json, "gap"), "null");
  ck_assert_str_eq(member(json, "t_c_max"), "null");
}

START_TEST(orbits_of_every_set) {
  int sets = 0;
  for (int i = 0; i < orbits.n; i++) {
    if (strcmp(orbits.field[i][0], "set") != 0) continue;
    struct job j;
    sets++;
    run_well(&j, "orbit", scene_of(orbits.field[i][F_NAME]), "--digits", "50", "--json", NULL);
    check_orbits(j.out, orbits.field[i][F_NAME], 50);
    discard(&j);
  }
  ck_assert_int_ge(sets, 30);
}
END_TEST

START_TEST(digits_as_asked) {
  static const char *const digits[] = {"1", "2", "7", "15", "50"};
  struct job j, without;
  for (size_t i = 0; i < sizeof digits / sizeof *digits; i++) {
    run_well(&j, "orbit", "paper", "--json", "--digits", digits[i], NULL);
    check_orbits(j.out, "paper", atoi(digits[i]));
    discard(&j);
  }
  run_well(&j, "orbit", "--digits=15", "--json", "paper", NULL);
  run_well(&without, "orbit", "paper", "--json", NULL);
  ck_assert_str_eq(j.out, without.out);
  discard(&without);
  discard(&j);
}
END_TEST

START_TEST(a_thousand_digits) {
  struct table t;
  struct job j;
  table_read(&t, "tests/oracle/paper_1000.tsv");
  run_well(&j, "orbit", "paper", "--digits", "1000", "--json", NULL);
  const char *second = strstr(strstr(j.out, "\"z10\"") + 1, "\"z10\"");
  ck_assert(second != NULL && t.n == 6);
  for (int i = 0; i < t.n; i++) ck_assert_str_eq(member(second, t.field[i][0]), rounded(t.field[i][1], 1000));
  discard(&j);
  free(t.text);
}
END_TEST

START_TEST(text_says_what_json_says) {
  struct job text, json;
  run_well(&text, "orbit", "paper", NULL);
  run_well(&json, "orbit", "paper", "--json", NULL);
  const char *at = json.out;
  for (int k = 0; k < 2; k++) {
    static const char *const names[] = {"z10", "z20",    "t_a",   "t_b",      "t_c",
                                        "t_d", "period", "trace", "u_r1_min", "u_r2_min"};
    at = strstr(at, "\"z10\"");
    ck_assert(at != NULL);
    for (int i = 0; i < 10; i++) ck_assert(strstr(text.out, member(at, names[i])) != NULL);
    at++;
  }
  ck_assert(strstr(text.out, "orbit 1: conditionally stable, not admissible") != NULL);
  ck_assert(strstr(text.out, "orbit 2: unstable, admissible with u_r1, u_r2 above their bounds\n") != NULL);
  discard(&json);
  discard(&text);
}
END_TEST

/* The second orbit of the paper's data needs u_r2 > 1.67050...: see u_r2_min in orbits.tsv. */
START_TEST(friction_given_by_the_scene_counts) {
  static const struct {
    const char *u_r2, *admissible, *violations, *says, *breaks;
  } cases[] = {{"1.6705", "false", "u_r2", "orbit 2: unstable, not admissible", "breaks   u_r2"},
               {"1.6706", "true", "", "orbit 2: unstable, admissible\n", NULL}};
  for (int i = 0; i < 2; i++) {
    char scene[200];
    struct job j;
    snprintf(scene, sizeof scene, "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\nu_r1 = 2.79\nu_r2 = %s\n",
             cases[i].u_r2);
    const char *path = scratch_put("friction.scene", scene);
    run_well(&j, "orbit", path, "--json", NULL);
    const char *second = strstr(strstr(j.out, "\"z10\"") + 1, "\"z10\"");
    ck_assert_str_eq(member(second, "admissible"), cases[i].admissible);
    ck_assert_str_eq(list_member(second, "violations"), cases[i].violations);
    discard(&j);
    run_well(&j, "orbit", path, NULL);
    ck_assert_msg(strstr(j.out, cases[i].says) != NULL, "%.1500s", j.out);
    ck_assert((strstr(j.out, "breaks   u_r") != NULL) == (cases[i].breaks != NULL));
    discard(&j);
  }
}
END_TEST

/* --- jacobian --- */

static struct table jacobians; /* SET ORBIT MATRIX ROW COLUMN VALUE */

static void open_jacobians(void) {
  open_oracle();
  table_read(&jacobians, "tests/oracle/jacobian.tsv");
}

static void close_jacobians(void) {
  free(jacobians.text);
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
  const char *const *f = jacobians.field[r];
  char at[32], n[16];
  snprintf(at, sizeof at, "orbit:%d", atoi(f[1]) + 1);
  snprintf(n, sizeof n, "%d", digits);
  struct job j;
  run_well(&j, "jacobian", scene_of(f[0]), "--at", at, "--method", method, "--digits", n, "--json", NULL);
  for (int k = 0; k < 4; k++)
    ck_assert_msg(strcmp(entry(j.out, k), rounded(jacobians.field[r + k][5], digits)) == 0,
                  "%s %s %s, entry %d: %s, not %s", f[0], at, method, k, entry(j.out, k),
                  rounded(jacobians.field[r + k][5], digits));
  ck_assert_str_eq(member(j.out, "trace"), rounded(orbits.field[set_row(f[0]) + atoi(at + 6)][F_TRACE], digits));
  ck_assert_str_eq(member(j.out, "det"), "0");
  ck_assert_str_eq(member(j.out, "method"), method);
  ck_assert_str_eq(member(j.out, "layer"), strcmp(method, "analytic") == 0 ? "corrected" : "model");
  ck_assert_str_eq(member(j.out, "at"), at);
  discard(&j);
}

START_TEST(three_methods_agree_with_differences_made_elsewhere) {
  static const char *const methods[] = {"analytic", "implicit", "fd"};
  static const int digits[] = {30, 38, 15};
  int maps = 0;
  for (int r = 0; r < jacobians.n; r++) {
    if (strcmp(jacobians.field[r][2], "return") != 0) continue;
    for (int m = 0; m < 3; m++) check_return_map(r, methods[m], digits[maps % 3]);
    maps++;
    r += 3;
  }
  ck_assert_int_ge(maps, 4);
}
END_TEST

/* ktilde_4 as printed is V^-2 of what it should be.  It moves x_f and y_f alike, and tr J sees their difference alone:
   so where V is not 1 every entry is wrong and the trace is right; where V = 1 all are right. */
/* How many significant digits a printed number shows. */
static int digits_shown(const char *number) {
  int n = 0;
  for (const char *p = number; *p && *p != 'e'; p++)
    if (*p >= '0' && *p <= '9' && (n > 0 || *p != '0')) n++;
  return n;
}

/* Each method prints the digits it answers for, and they are right; work in double precision answers for fewer. */
START_TEST(every_method_keeps_its_word) {
  static const char *const methods[] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
  int held = 0, integrated = 0;
  for (int r = 0, nth = 0; r < orbits.n; r++) {
    const char *const *f = orbits.field[r];
    if (strcmp(f[0], "orbit") != 0 || nth++ % 4 != 0) continue;
    char at[32];
    snprintf(at, sizeof at, "orbit:%d", atoi(f[2]) + 1);
    for (int m = 0; m < 6; m++) {
      bool by_ode = m == 5, in_double = m >= 4;
      if (by_ode && strcmp(f[F_ADMISSIBLE], "yes") != 0) continue; /* Coulomb's law does not follow the others */
      struct job j;
      run_well(&j, "jacobian", scene_of(f[F_NAME]), "--at", at, "--method", methods[m], "--digits", "18", "--json",
               NULL);
      const char *trace = member(j.out, "trace");
      int n = digits_shown(trace);
      ck_assert_msg(in_double ? n >= (by_ode ? 2 : 5) : n == 18, "%s %s %s: %s", f[F_NAME], at, methods[m], trace);
      ck_assert_msg(strcmp(trace, rounded(f[F_TRACE], n)) == 0, "%s %s %s: %s, not %s", f[F_NAME], at, methods[m],
                    trace, rounded(f[F_TRACE], n));
      held++;
      integrated += by_ode;
      discard(&j);
    }
  }
  ck_assert_int_ge(held, 60);
  ck_assert_int_ge(integrated, 4);
}
END_TEST

/* The same numbers, by other forms. */
START_TEST(the_stable_layer_gives_what_the_corrected_one_does) {
  static const char *const cases[][2] = {{"paper", "orbit:1"},
                                         {"paper", "orbit:2"},
                                         {"paper", "printed"},
                                         {"stable", "orbit:1"},
                                         {"near-singular", "orbit:1"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct job stable, corrected;
    const char *scene = cases[i][0], *at = cases[i][1];
    run_well(&stable, "jacobian", scene, "--at", at, "--layer", "stable", "--digits", "30", "--json", NULL);
    run_well(&corrected, "jacobian", scene, "--at", at, "--digits", "30", "--json", NULL);
    for (int k = 0; k < 4; k++) {
      char first[100];
      snprintf(first, sizeof first, "%s", entry(stable.out, k));
      ck_assert_str_eq(first, entry(corrected.out, k));
    }
    ck_assert_str_eq(member(stable.out, "layer"), "stable");
    discard(&corrected);
    discard(&stable);
  }
}
END_TEST

START_TEST(layers_differ_in_the_entries_not_in_the_trace) {
  static const char *const scenes[] = {"paper", "stable"}; /* V = 1 and V = 1.8 */
  for (int i = 0; i < 2; i++) {
    struct job printed, corrected;
    run_well(&printed, "jacobian", scene_of(scenes[i]), "--layer", "printed", "--digits", "20", "--json", NULL);
    run_well(&corrected, "jacobian", scene_of(scenes[i]), "--digits", "20", "--json", NULL);
    for (int k = 0; k < 4; k++) {
      char first[100];
      snprintf(first, sizeof first, "%s", entry(printed.out, k));
      ck_assert_msg((strcmp(first, entry(corrected.out, k)) == 0) == (i == 0), "%s, entry %d: %s", scenes[i], k, first);
    }
    ck_assert_str_eq(member(printed.out, "trace"), member(corrected.out, "trace"));
    ck_assert_str_eq(member(printed.out, "layer"), "printed");
    ck_assert_str_eq(member(corrected.out, "layer"), "corrected");
    ck_assert_str_eq(member(printed.out, "at"), i == 0 ? "orbit:2" : "orbit:1"); /* orbits.tsv: the first admissible */
    discard(&corrected);
    discard(&printed);
  }
}
END_TEST

/* J_a = (-1, 1)/(1 - chi) stands at the right end of every chain: the columns of J are opposite. */
START_TEST(at_the_printed_numbers) {
  static const char *const methods[] = {"analytic", "implicit", "fd"};
  for (int m = 0; m < 3; m++) {
    struct job j;
    run_well(&j, "jacobian", "paper", "--at", "printed", "--method", methods[m], "--json", NULL);
    for (int k = 0; k < 4; k += 2) {
      const char *left = entry(j.out, k), *right = entry(j.out, k + 1);
      ck_assert_msg(strcmp(left + (*left == '-'), right + (*right == '-')) == 0 && *left != *right, "%s %s", left,
                    right);
    }
    ck_assert_str_eq(member(j.out, "at"), "printed");
    ck_assert_str_eq(member(j.out, "det"), "0");
    discard(&j);
  }
}
END_TEST

/* "accuracy 2.4e-11 (...)": the number stands in the text of every method, and the entries are as near as it says to
   those of jacobian.tsv, the first return of which is the paper's second orbit. */
START_TEST(every_method_states_its_accuracy) {
  static const char *const methods[] = {"analytic", "implicit", "saltation", "fd", "fd-double", "ode"};
  static const double most[] = {1e-15, 1e-15, 1e-15, 1e-15, 1e-9, 1e-7};
  int r = 0;
  while (r < jacobians.n &&
         !(strcmp(jacobians.field[r][0], "paper") == 0 && strcmp(jacobians.field[r][2], "return") == 0))
    r++;
  ck_assert(r + 3 < jacobians.n && strcmp(jacobians.field[r][1], "1") == 0);
  for (int m = 0; m < 6; m++) {
    struct job j;
    run_well(&j, "jacobian", "paper", "--at", "orbit:2", "--method", methods[m], NULL);
    double stated = 0;
    char e[4][40];
    const char *accuracy = strstr(j.out, "\naccuracy "), *first = strchr(j.out, '\n');
    ck_assert(accuracy && sscanf(accuracy, "\naccuracy %lf (%*[a-z])", &stated) == 1);
    ck_assert(sscanf(first, "\n %39s %39s\n %39s %39s", e[0], e[1], e[2], e[3]) == 4);
    ck_assert_msg(stated > 0 && stated < most[m], "%s: %g", methods[m], stated);
    for (int k = 0; k < 4; k++) {
      double last_digit = pow(10, -(double)strlen(strchr(e[k], '.') + 1));
      double off = fabs(strtod(e[k], NULL) - strtod(jacobians.field[r + k][5], NULL));
      ck_assert_msg(off <= stated + 0.51 * last_digit, "%s, entry %d: %s is off by %g", methods[m], k, e[k], off);
    }
    discard(&j);
  }
}
END_TEST

/* --- orbit --method paper --- */

/* Orbits that Newton's iteration on (44)-(46) comes back to from their own times moved by 2 %, to all digits. */
START_TEST(the_papers_equations_have_the_same_orbits) {
  static const struct {
    const char *set;
    int index;
  } cases[] = {{"fractions", 0},  {"stable", 0},      {"two-admissible", 1}, {"four-mixed", 1},
               {"chi-small2", 0}, {"negative-ta", 1}, {"eta-large", 0},      {"spread", 1}};
  static const char *const names[] = {"z10", "z20", "t_a", "t_b", "t_c", "t_d"};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *const *f = orbits.field[set_row(cases[i].set) + 1 + cases[i].index];
    struct job j;
    char from[40], nearest[20];
    run_well(&j, "orbit", scene_of(cases[i].set), "--method", "paper", "--digits", "50", "--json", NULL);
    snprintf(nearest, sizeof nearest, "orbit:%d", cases[i].index + 1);
    snprintf(from, sizeof from, "\"from\": \"%s\"", nearest);
    const char *at = strstr(j.out, from);
    ck_assert(at != NULL);
    for (int k = 0; k < 6; k++) ck_assert_str_eq(member(at, names[k]), rounded(f[F_Z10 + k], 50));
    ck_assert_str_eq(member(at, "converged"), "true");
    ck_assert_str_eq(member(at, "nearest"), nearest);
    ck_assert(strtod(member(at, "distance"), NULL) < 1e-50 && strtod(member(at, "equations"), NULL) > 1);
    ck_assert(strtod(member(at, "digits_lost"), NULL) < 4);
    discard(&j);
  }
}
END_TEST

/* Columns of the table: every method once, a row for each entry, and a star and a sentence where the printed (40)
   departs: at V = 2 in all of J_f and J. */
START_TEST(the_table_of_phases) {
  const char *scene = scratch_put("two.scene", "chi = 0.59\neta = 3.1\nV = 2\ne1 = 3.54\ne2 = 0.0657\n");
  struct job j;
  run_well(&j, "jacobian", scene, "--phases", NULL);
  static const char *const rows[] = {"J_a[1,1]", "J_a[1,2]", "J_b[1,1]", "J_b[2,1]", "J_c[1,1]", "J_c[1,2]", "J_c[2,1]",
                                     "J_c[2,2]", "J_c[3,1]", "J_c[3,2]", "J_f[1,1]", "J_f[1,2]", "J_f[1,3]", "J_f[2,1]",
                                     "J_f[2,2]", "J_f[2,3]", "J[1,1]",   "J[1,2]",   "J[2,1]",   "J[2,2]"};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    char begin[20];
    double x[7];
    snprintf(begin, sizeof begin, "\n%s ", rows[i]);
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
  discard(&j);
}
END_TEST

/* What the model method prints is what orbit prints without a method. */
START_TEST(the_model_is_the_default_method) {
  struct job a, b;
  run_well(&a, "orbit", "paper", "--json", NULL);
  run_well(&b, "orbit", "paper", "--json", "--method", "model", NULL);
  ck_assert_str_eq(a.out, b.out);
  discard(&a);
  discard(&b);
}
END_TEST

/* What a certificate says is the business of check_certify.c. */
START_TEST(orbit_writes_certificates) {
  struct job a, b;
  const char *first = scratch_path("first.json"), *second = scratch_put("second.json", "old");
  run_well(&a, "orbit", "stable", "--json", "--certificate", first, NULL);
  run_well(&b, "orbit", "stable", "--json", NULL);
  ck_assert_str_eq(a.out, b.out);
  discard(&a);
  discard(&b);
  run_well(&a, "orbit", "stable", "--certificate", second, NULL);
  ck_assert(strstr(a.out, "\n  certified at 64 bits; enclosed within ") != NULL);
  discard(&a);
  char *x = slurp(first), *y = slurp(second);
  ck_assert_str_eq(x, y);
  ck_assert(strstr(x, "\"chi\": \"2/3\"") != NULL);
  free(x);
  free(y);
  run(&a, "orbit", scene_of("none"), "--certificate", second, NULL);
  ck_assert_msg(a.status == 3 && strstr(a.err, "no orbit is certified"), "%d %s", a.status, a.err);
  y = slurp(second);
  ck_assert_msg(strstr(y, "\"chi\": \"2/3\"") != NULL, "the old file is gone");
  free(y);
  discard(&a);
}
END_TEST

/* e2 at which t_a = 0 on an orbit, with so many digits: with t_a given the equations are solved for e2. */
static char *e2_at_the_end_of_d(const char *digits) {
  struct job j;
  const char *scene = scratch_put("end.scene", "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\nt_a = 0\n");
  run_well(&j, "orbit", scene, "--digits", digits, NULL);
  const char *at = strstr(j.out, "\n  e2 ");
  ck_assert_ptr_nonnull(at);
  at += 6 + strspn(at + 6, " ");
  struct text e2;
  text_init(&e2);
  text_printf(&e2, "e2=%.*s", (int)strcspn(at, " "), at);
  discard(&j);
  return e2.data;
}

/* 1400 digits from there no ball of 4096 bits knows whether t_a > 0; two other orbits are certified all the same. */
START_TEST(some_orbits_are_certified) {
  struct job j;
  char *e2 = e2_at_the_end_of_d("1400");
  const char *path = scratch_path("some.json");
  run(&j, "orbit", "paper", "--set", e2, "--certificate", path, NULL);
  ck_assert_msg(j.status == 0 && strstr(j.err, "warning: 2 of 3 orbits are certified; the others are not in the "
                                               "certificate"),
                "%d %s", j.status, j.err);
  discard(&j);
  char *json = slurp(path);
  int n = 0;
  for (const char *p = strstr(json, "\"enclosures\""); p; p = strstr(p + 1, "\"enclosures\"")) n++;
  ck_assert_int_eq(n, 2);
  free(json);
  free(e2);
}
END_TEST

/* 5000 digits from there no precision that is tried tells a digit of t_a. */
START_TEST(an_orbit_beyond_the_digits_is_told) {
  struct job j;
  char *e2 = e2_at_the_end_of_d("5000");
  run(&j, "orbit", "paper", "--set", e2, NULL);
  ck_assert_msg(j.status == 3 && strstr(j.err, "an orbit could not be enclosed to 15 digits"), "%d %s", j.status,
                j.err);
  ck_assert_str_eq(j.out, "");
  discard(&j);
  free(e2);
}
END_TEST

/* --- simulate --- */

/* An admissible orbit, simulated from (1)-(2), meets its four events at the oracle's times and returns. */
START_TEST(simulation_follows_admissible_orbits) {
  int followed = 0;
  for (int r = 0; r < orbits.n; r++) {
    const char *const *f = orbits.field[r];
    if (strcmp(f[0], "orbit") != 0 || strcmp(f[F_ADMISSIBLE], "yes") != 0) continue;
    char at[32];
    snprintf(at, sizeof at, "orbit:%d", atoi(f[2]) + 1);
    struct job j;
    run_well(&j, "simulate", scene_of(f[F_NAME]), "--at", at, NULL);
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
    discard(&j);
  }
  ck_assert_int_ge(followed, 15);
}
END_TEST

START_TEST(csv_has_a_row_for_each_sample_and_event) {
  struct job j;
  run_well(&j, "simulate", "paper", "--at", "orbit:2", "--csv", "--samples", "10", "--periods", "3", NULL);
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
  discard(&j);
}
END_TEST

/* From the printed start, for long: both routes meet the same events. */
START_TEST(the_printed_start_runs_on) {
  struct job j;
  run_well(&j, "simulate", "paper", "--at", "printed", "--periods", "120", NULL);
  size_t same = 0, all = 1;
  const char *p = strstr(j.out, "closed forms: the first ");
  ck_assert(p && sscanf(p, "closed forms: the first %zu of %zu", &same, &all) == 2);
  ck_assert(same == all && all > 400);
  ck_assert(strstr(j.out, "after 120 returns") != NULL);
  discard(&j);
}
END_TEST

/* Which orbit is meant where nobody says which: the nearest to the printed numbers, else the first that is admissible;
   of the two at the paper's parameters the second is (orbits.tsv). */
START_TEST(the_usual_orbit_is_named) {
  static const char bare[] = "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\n";
  static const struct {
    const char *printed, *want;
  } cases[] = {{"", "orbit:2"},
               {"printed: z10 = -5.46\nprinted: t_b = 1.4\n", "orbit:1"},
               {"printed: t_a = 0.6784\n", "orbit:2"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[300], head[60];
    struct job j;
    snprintf(text, sizeof text, "%s%s", bare, cases[i].printed);
    const char *scene = scratch_put("usual.scene", text);
    static const char *const commands[] = {"simulate", "jacobian"};
    for (int k = 0; k < 2; k++) {
      run_well(&j, commands[k], scene, NULL);
      snprintf(head, sizeof head, "usual, %s%s", cases[i].want, k ? ", method analytic" : ": u_r1 = ");
      ck_assert_msg(strncmp(j.out, head, strlen(head)) == 0, "%s", j.out);
      discard(&j);
    }
    run_well(&j, "simulate", scene, "--compare", NULL);
    snprintf(head, sizeof head, "usual, %s: ode ", cases[i].want);
    ck_assert_msg(strncmp(j.out, head, strlen(head)) == 0, "%s", j.out);
    discard(&j);
  }
}
END_TEST

/* The distances from MPFR and their growth, against the trace of orbits.tsv; and a table of three lines a period. */
START_TEST(routes_compared_over_many_periods) {
  struct job j;
  const char *const *f = orbits.field[set_row("chi-large") + 2];
  double trace = strtod(f[F_TRACE], NULL), tr = 0, expected = 0, measured = 0;
  long lines = 0, from, to;
  run_well(&j, "simulate", scene_of("chi-large"), "--at", "orbit:2", "--periods", "60", "--compare", NULL);
  for (const char *p = j.out; *p; p = strchr(p, '\n') + 1) lines++;
  ck_assert_int_eq(lines, 2 + 3 * 60 + 3 + 1);
  const char *p = strstr(j.out, "\ntr J = ");
  ck_assert(p && sscanf(p, "\ntr J = %lf: factor %lf a period expected; a displacement of x1 has %lf from %ld to %ld",
                        &tr, &expected, &measured, &from, &to) == 5);
  ck_assert_msg(fabs(tr - trace) < 1e-6 && fabs(expected + trace) < 1e-4 && fabs(measured + trace) < 1e-3, "%s", p);
  p = strstr(j.out, "\nclosed and mpfr: apart by more than 1e-06 at period ");
  ck_assert(p && strstr(p, "; factor "));
  ck_assert_msg(fabs(strtod(strstr(p, "; factor ") + 9, NULL) + trace) < 0.02, "%s", p);
  discard(&j);
}
END_TEST

/* --- scenes that give other quantities than e1 and e2 --- */

/* The orbit is found again from any two of its six quantities, given to 50 digits. */
START_TEST(any_two_of_six) {
  static const char *const names[] = {"e1", "e2", "t_a", "t_b", "t_c", "t_d"};
  static const int pairs[][2] = {{3, 4}, {0, 3}, {1, 4}, {2, 3}, {3, 5}};
  int r = set_row("paper");
  const char *const *set = orbits.field[r], *const *f = orbits.field[r + 2];
  for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
    char text[800];
    int n = snprintf(text, sizeof text, "chi = %s\neta = %s\nV = %s\n", set[F_CHI], set[F_CHI + 1], set[F_CHI + 2]);
    for (int i = 0; i < 2; i++) {
      int q = pairs[k][i];
      n += snprintf(text + n, sizeof text - (size_t)n, "%s = %s\n", names[q],
                    q < 2 ? set[F_CHI + 3 + q] : rounded(f[F_Z10 + q], 50));
    }
    struct job j;
    run_well(&j, "orbit", scratch_put("two.scene", text), "--digits", "30", "--json", NULL);
    char want[80];
    snprintf(want, sizeof want, "\"z10\": \"%s\"", rounded(f[F_Z10], 30));
    ck_assert_msg(strstr(j.out, want) != NULL, "%s and %s: no %s in\n%.1500s", names[pairs[k][0]], names[pairs[k][1]],
                  want, j.out);
    discard(&j);
  }
}
END_TEST

/* t_b and t_c taken as data: the printed numbers are held against the orbit of tests/oracle/times.tsv, t_a = 0.47204,
   t_d = 2.34209, z10 = 1.00674, z20 = -2.06539, which do not print as they stand, to the four decimals that three of
   them have; records are for paper. */
START_TEST(numbers_of_a_scene_without_forces) {
  static const struct {
    const char *id, *verdict, *shows;
  } want[] = {{"num-t_a", "refuted", "0.4720366"}, {"num-t_d", "refuted", "2.34208888"},
              {"num-z10", "refuted", "1.0067381"}, {"num-z20", "refuted", "-2.0653943"},
              {"text-periodic", "refuted", NULL},  {"num-t_b", "skipped", "prints no t_b"}};
  struct job j;
  run_well(&j, "verify", "paper-times", "--only", "num-t_a,num-t_b,num-t_d,num-z10,num-z20,text-periodic", "--out",
           scratch_path("times"), NULL);
  char *json = slurp(scratch_path("times/audit.json"));
  for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
    char id[60], verdict[60];
    snprintf(id, sizeof id, "\"id\": \"%s\"", want[i].id);
    snprintf(verdict, sizeof verdict, "\"verdict\": \"%s\"", want[i].verdict);
    const char *claim = strstr(json, id);
    ck_assert_msg(claim != NULL, "%s", want[i].id);
    const char *next = strstr(claim + 1, "\"id\": \""), *found = strstr(claim, verdict);
    ck_assert_msg(found && (!next || found < next), "%s is not %s", want[i].id, want[i].verdict);
    const char *shown = want[i].shows ? strstr(claim, want[i].shows) : claim;
    ck_assert_msg(shown && (!next || shown < next), "%s shows no %s", want[i].id, want[i].shows);
  }
  free(json);
  discard(&j);
}
END_TEST

/* --- verify --- */

static struct job full; /* verify paper, all of it */
static char *full_json, *full_md;
static const char *full_json_path;

static char *report(const char *folder, const char *file) {
  char name[200];
  snprintf(name, sizeof name, "%s/%s", folder, file);
  return slurp(scratch_path(name));
}

/* Two whole runs at once: the second must give the same bytes. */
static void open_full(void) {
  scratch_open();
  struct job again;
  start(&full, NULL, program(), (const char *const[]){"verify", "paper", "--out", scratch_path("full"), NULL});
  start(&again, NULL, program(), (const char *const[]){"verify", "--out", scratch_path("again"), "--quiet", NULL});
  finish(&full);
  finish(&again);
  ck_assert_msg(full.status == 0 && !*full.err, "verify: status %d, %.1500s%.1500s", full.status, full.out, full.err);
  ck_assert_msg(again.status == 0 && !*again.err, "verify: status %d, %.1500s%.1500s", again.status, again.out,
                again.err);
  full_json_path = scratch_path("full/audit.json");
  full_json = report("full", "audit.json");
  full_md = report("full", "audit.md");
  char *json = report("again", "audit.json"), *md = report("again", "audit.md");
  ck_assert(full_json && full_md && json && md);
  ck_assert_msg(strcmp(full_json, json) == 0 && strcmp(full_md, md) == 0, "two runs gave different reports");
  static const char *const others[] = {"index.html",      "audit.csv",     "junit.xml",      "errata.md",
                                       "errata.tex",      "claims.dot",    "along-e2.tsv",   "figure-3.tsv",
                                       "figure-4.tsv",    "margins.tsv",   "return-map.tsv", "long-run.tsv",
                                       "differences.tsv", "statements.tsv"};
  for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
    char *one = report("full", others[i]), *two = report("again", others[i]);
    ck_assert_msg(one && two && strcmp(one, two) == 0, "two runs gave different %s", others[i]);
    free(two);
    free(one);
  }
  ck_assert_msg(strchr(again.out, '\n') == again.out + strlen(again.out) - 1, "--quiet: %.1500s", again.out);
  free(md);
  free(json);
  discard(&again);
}

static void close_full(void) {
  free(full_md);
  free(full_json);
  discard(&full);
  scratch_close();
}

START_TEST(the_report_on_record_is_the_computed_one) {
  char *json = slurp("reports/paper/audit.json"), *md = slurp("reports/paper/audit.md");
  ck_assert(json && md);
  ck_assert_msg(strcmp(json, full_json) == 0, "reports/paper/audit.json is stale: run make verify");
  ck_assert_msg(strcmp(md, full_md) == 0, "reports/paper/audit.md is stale: run make verify");
  free(md);
  free(json);
  ck_assert_str_eq(scratch_list(scratch_path("full")),
                   "along-e2.tsv audit.csv audit.json audit.md claims.dot differences.tsv errata.md errata.tex "
                   "figure-3.tsv figure-4.tsv "
                   "index.html junit.xml long-run.tsv margins.tsv return-map.tsv run.json statements.tsv");
}
END_TEST

/* The text of a claim's object in a report, to be freed; NULL when it has none. */
static char *claim_object(const char *json, const char *id) {
  char head[100];
  snprintf(head, sizeof head, "    {\n      \"id\": \"%s\",\n      \"equation\"", id);
  const char *p = strstr(json, head), *end = p ? strstr(p, "\n    }") : NULL;
  if (!end) return NULL;
  struct text t;
  text_init(&t);
  text_add_n(&t, p, (size_t)(end - p));
  return t.data;
}

static const char *const verdicts[] = {"proved",  "conditional", "supported", "refuted",
                                       "unknown", "skipped",     "definition"};
enum { N_VERDICT_WORDS = sizeof verdicts / sizeof *verdicts };

/* The last line of the output says what the summary of audit.json says. */
START_TEST(the_last_line_is_the_summary) {
  const char *end = full.out + strlen(full.out) - 1, *line = end;
  ck_assert(*end == '\n');
  while (line > full.out && line[-1] != '\n') line--;
  const char *summary = strstr(full_json, "\"summary\": {");
  ck_assert(summary != NULL && strncmp(line, "paper: ", 7) == 0);
  const char *checks = strstr(full_json, "\"checks\": {"), *semicolon = strchr(line, ';');
  ck_assert(checks != NULL && semicolon != NULL);
  for (int of = 0; of < 2; of++) {
    char half[300];
    const char *from = of ? semicolon + 1 : line + 6, *end_of = strchr(from, ';');
    snprintf(half, sizeof half, "%.*s", (int)(end_of - from), from);
    int total = 0;
    for (int i = 0; i < N_VERDICT_WORDS; i++) {
      char part[60];
      int n = atoi(member(of ? checks : summary, verdicts[i]));
      total += n;
      snprintf(part, sizeof part, " %d %s", n, verdicts[i]);
      ck_assert_msg((strstr(half, part) != NULL) == (n > 0), "%s: %s", part, half);
    }
    ck_assert_int_eq(total, atoi(member(of ? checks : summary, "total")));
    ck_assert_int_eq(total, atoi(half));
    ck_assert(strstr(half, of ? " checks: " : " statements: "));
  }
  int noticed = -1, controls = -2;
  ck_assert(sscanf(strchr(semicolon + 1, ';'), "; %d of %d controls noticed; as recorded", &noticed, &controls) == 2);
  ck_assert_msg(noticed == controls && noticed > 20, "%s", line);
}
END_TEST

/* audit.md holds every claim of audit.json once, what needs attention before the overview. */
START_TEST(the_markdown_holds_every_claim) {
  int claims = 0;
  for (const char *p = strstr(full_json, "    {\n      \"id\": \""); p; p = strstr(p + 1, "    {\n      \"id\": \"")) {
    char heading[100];
    if (strncmp(strchr(p + 8, '\n') + 1, "      \"equation\"", 16) != 0) continue; /* a control */
    snprintf(heading, sizeof heading, "\n### %s: ", member(p, "id"));
    const char *h = strstr(full_md, heading);
    ck_assert_msg(h && !strstr(h + 1, heading), "%s stands not once in audit.md", heading + 1);
    char verdict[20];
    snprintf(verdict, sizeof verdict, "%s", member(p, "verdict"));
    bool attention =
        strcmp(verdict, "refuted") == 0 || strcmp(verdict, "conditional") == 0 || strcmp(verdict, "unknown") == 0;
    ck_assert_msg((h < strstr(full_md, "\n## Every claim")) == attention, "%s", heading + 1);
    claims++;
  }
  ck_assert_int_eq(claims,
                   atoi(member(full_json, "total")) + atoi(member(strstr(full_json, "\"checks\": {"), "total")));
}
END_TEST

START_TEST(the_recorded_verdicts_are_listed) {
  struct job j;
  int n = 0;
  run_well(&j, "list", NULL);
  for (char *line = strtok(j.out, "\n"); line; line = strtok(NULL, "\n"), n++) {
    char id[64], kind[64], record[64];
    ck_assert_msg(sscanf(line, "%63s %63s %63s", id, kind, record) == 3, "%s", line);
    char *object = claim_object(full_json, id);
    ck_assert_msg(object != NULL, "%s is listed and not reported", id);
    if (strcmp(record, "-") != 0) ck_assert_str_eq(member(object, "verdict"), record);
    free(object);
  }
  ck_assert_int_ge(n, 60);
  discard(&j);
}
END_TEST

/* Judged alone or in company, a claim's result has the same bytes. */
START_TEST(alone_or_together) {
  static const char *const runs[] = {"eq-27", "eq-40", "num-t_a,text-periodic", "eq-53,eq-44b,eq-3", "text-criterion"};
  const char *only = runs[_i];
  struct job j;
  run_well(&j, "verify", "paper", "--only", only, "--out", scratch_path("alone"), "--quiet", NULL);
  char *json = report("alone", "audit.json"), id[64];
  ck_assert(json != NULL);
  for (const char *p = only; *p; p += strspn(p, ",")) {
    size_t n = strcspn(p, ",");
    snprintf(id, sizeof id, "%.*s", (int)n, p);
    char *a = claim_object(json, id), *b = claim_object(full_json, id);
    ck_assert_msg(a && b, "no claim %s", id);
    ck_assert_msg(strcmp(a, b) == 0, "alone:\n%.1500s\ntogether:\n%.1500s", a, b);
    free(b);
    free(a);
    p += n;
  }
  ck_assert(claim_object(json, "eq-36") == NULL);
  ck_assert_str_eq(member(strstr(json, "\"skipped\": ["), "why"), "not selected by --only");
  free(json);
  discard(&j);
}
END_TEST

/* A report's claim can be judged again by the command that stands beside it, and the report stays. */
START_TEST(a_claim_reproduces) {
  char *object = claim_object(full_json, "eq-31");
  ck_assert(object != NULL);
  ck_assert_str_eq(member(object, "reproduce"), "stickslip verify paper --only eq-31");
  ck_assert_str_eq(member(object, "verdict"), "refuted");
  ck_assert_str_eq(member(strstr(object, "\"correction\": {"), "verdict"), "proved");
  char command[2000];
  snprintf(
      command, sizeof command,
      "p=$(realpath %s) && v=$PWD/verify && cd %s && mkdir -p reports/paper && echo whole > reports/paper/audit.json "
      "&& STICKSLIP_DATA=$v $p%s --out again > /dev/null && echo whole | cmp -s - reports/paper/audit.json",
      program(), scratch_path(""), member(object, "reproduce") + strlen("stickslip"));
  ck_assert_int_eq(system(command), 0);
  char *json = slurp(scratch_path("again/audit.json")), *again = json ? claim_object(json, "eq-31") : NULL;
  ck_assert(again && strcmp(again, object) == 0);
  free(again);
  free(json);
  free(object);
}
END_TEST

static const char corrected_k4[] = "define user-40\n  section: stability\n"
                                   "  ktilde_4 := V*sin(omega*t_d)/(omega*(z_200 - z_100))\n";
static const char damaged_ja[] = "define user-27\n  section: stability\n  J_a := (1/(1 - chi))*[1, 1]\n";

/* Exit status 1: a verdict is not the recorded one, for better or worse; it outranks 4. */
START_TEST(verdicts_that_are_not_as_recorded) {
  static const struct {
    const char *overlay, *only, *says;
  } cases[] = {{corrected_k4, "eq-40", "eq-40: proved, recorded as conditional\n"},
               {damaged_ja, "eq-27", "eq-27: refuted, recorded as proved\n"}};
  for (int i = 0; i < 2; i++) {
    struct job j;
    const char *overlay = scratch_put("overlay.eq", cases[i].overlay);
    run(&j, "verify", "paper", "--only", cases[i].only, "--overlay", overlay, "--strict", "--out",
        scratch_path("wrong"), NULL);
    ck_assert_msg(j.status == 1 && strstr(j.out, cases[i].says) && strstr(j.out, "NOT as recorded\n"),
                  "%d: %.1500s%.1500s", j.status, j.out, j.err);
    discard(&j);
  }
}
END_TEST

START_TEST(strict_means_no_discrepancies) {
  static const struct {
    const char *only;
    int status, strict;
  } cases[] = {{"eq-40", 0, 4}, {"eq-27", 0, 0}, {"num-t_a", 0, 4}, {"eq-1", 0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct job j;
    run(&j, "verify", "paper", "--only", cases[i].only, "--out", scratch_path("strict"), NULL);
    ck_assert_int_eq(j.status, cases[i].status);
    discard(&j);
    run(&j, "verify", "paper", "--only", cases[i].only, "--out", scratch_path("strict"), "--strict", NULL);
    ck_assert_int_eq(j.status, cases[i].strict);
    discard(&j);
  }
}
END_TEST

/* Several scenes get a folder each; a bad one does not stop the others, and its status wins. */
START_TEST(several_scenes) {
  struct job j;
  const char *mine = scratch_put("mine.scene", "chi = 1/2\neta = 2\nV = 3/2\ne1 = 3\ne2 = 1/4\n");
  run(&j, "verify", "paper", "no-such-scene", mine, "--only", "eq-27,num-t_a", "--out", scratch_path("many"), NULL);
  ck_assert_msg(j.status == 3 && strstr(j.err, "no-such-scene.scene: error: "), "%d: %.1500s", j.status, j.err);
  ck_assert_str_eq(scratch_list(scratch_path("many")), "mine paper");
  char *json = report("many/mine", "audit.json");
  ck_assert(json != NULL);
  char *number = claim_object(json, "num-t_a");
  ck_assert(number != NULL);
  ck_assert_str_eq(member(json, "scene"), "mine");
  ck_assert_str_eq(member(number, "verdict"), "skipped"); /* the scene prints no t_a */
  ck_assert_str_eq(member(number, "condition"), "the scene prints no t_a");
  free(number);
  free(json);
  discard(&j);
}
END_TEST

/* What cannot be written leaves the old report and nothing beside it. */
START_TEST(output_that_cannot_be_written) {
  struct job j;
  const char *file = scratch_put("file", "not a folder");
  char inside[400];
  snprintf(inside, sizeof inside, "%s/sub", file);
  const char *const nowhere[] = {inside, "/proc/stickslip", file};
  for (size_t i = 0; i < sizeof nowhere / sizeof *nowhere; i++) {
    run(&j, "verify", "--only", "eq-3", "--out", nowhere[i], NULL);
    ck_assert_msg(j.status == 3 && strstr(j.err, nowhere[i]) && !*j.out, "%s: %d, %.1500s", nowhere[i], j.status,
                  j.err);
    discard(&j);
  }
  ck_assert(mkdir(scratch_path("taken"), 0700) == 0 && mkdir(scratch_path("taken/audit.json"), 0700) == 0);
  scratch_put("taken/audit.json/in-the-way", "");
  scratch_put("taken/audit.md", "old");
  run(&j, "verify", "--only", "eq-3", "--out", scratch_path("taken"), NULL);
  ck_assert_msg(j.status == 3 && strstr(j.err, "audit.json: error: cannot be written"), "%d, %.1500s", j.status, j.err);
  ck_assert_str_eq(scratch_list(scratch_path("taken")), "audit.json audit.md");
  char *md = report("taken", "audit.md");
  ck_assert_str_eq(md, "old");
  free(md);
  discard(&j);
}
END_TEST

START_TEST(a_report_that_does_not_fit_leaves_the_old_one) {
  struct job j;
  ck_assert(mkdir(scratch_path("small"), 0700) == 0);
  scratch_put("small/audit.json", "old json");
  largest_file = 1024;
  run(&j, "verify", "--only", "eq-3", "--out", scratch_path("small"), NULL);
  largest_file = 0;
  ck_assert_msg(j.status == 3 && strstr(j.err, "audit.json: error: cannot be written"), "%d, %.1500s", j.status, j.err);
  char *json = report("small", "audit.json");
  ck_assert_str_eq(json, "old json");
  ck_assert_str_eq(scratch_list(scratch_path("small")), "audit.json");
  free(json);
  discard(&j);
}
END_TEST

START_TEST(bad_input_leaves_the_old_report) {
  struct job j;
  ck_assert(mkdir(scratch_path("old"), 0700) == 0);
  scratch_put("old/audit.json", "old json");
  scratch_put("old/audit.md", "old md");
  run(&j, "verify", scratch_put("bad.scene", "chi = 1\neta = 1\nV = 1\ne1 = 1\ne2 = 1\n"), "--out", scratch_path("old"),
      NULL);
  ck_assert_int_eq(j.status, 3);
  char *json = report("old", "audit.json"), *md = report("old", "audit.md");
  ck_assert_str_eq(json, "old json");
  ck_assert_str_eq(md, "old md");
  ck_assert_str_eq(scratch_list(scratch_path("old")), "audit.json audit.md");
  free(md);
  free(json);
  discard(&j);
}
END_TEST

/* Saves what a command prints, and answers the path. */
static const char *output_of(const char *name, const char *const *args) {
  struct job j;
  start(&j, NULL, program(), args);
  finish(&j);
  ck_assert_msg(j.status == 0, "%.1500s", j.err);
  const char *path = scratch_put(name, j.out);
  discard(&j);
  return path;
}

/* A scene with an interval: verify takes it, claims about one set of parameters are skipped with the reason,
   and nothing on record is contradicted. */
START_TEST(a_box_of_parameters) {
  const char *box = scratch_put("box.scene", "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = [1.812, 2.1]\n");
  struct job j;
  run_well(&j, "verify", box, "--only", "eq-27,num-t_a,text-periodic,text-start-at-rest", "--out", scratch_path("box"),
           NULL);
  ck_assert(strstr(j.out, "nothing recorded") || strstr(j.out, "as recorded"));
  ck_assert(!strstr(j.out, "NOT as recorded") && strstr(j.out, "2 skipped") && strstr(j.out, "1 skipped"));
  discard(&j);
  char *json = slurp(scratch_path("box/audit.json"));
  ck_assert(strstr(json, "the scene gives intervals, and this is about one set of parameters"));
  free(json);
}
END_TEST

/* Real output against the schemas; and output with a wrong count, since the checker must be able to fail. */
START_TEST(json_obeys_its_schemas) {
  enum { N = 17 };
  const char *box = scratch_put("box.scene", "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = [1.7, 1.9]\n");
  /* the sets "none" and "fractions" of orbits.tsv */
  const char *none = scratch_put("none.scene", "chi = 0.58\neta = 7.8\nV = 2.3\ne1 = 4.02\ne2 = 0.287\n");
  const char *stiff =
      scratch_put("stiff.scene", "chi = 5/7\neta = 8/3\nV = 2/3\ne1 = 28/9\ne2 = 3/14\nu_r1 = 28/5\nu_r2 = 3/10\n");
  char *damaged = slurp(full_json_path), *total = strstr(damaged, "\"total\": ");
  total[9] = total[9] == '9' ? '8' : '9';
  const char *phases_path =
      output_of("phases.json", (const char *const[]){"jacobian", stiff, "--phases", "--json", NULL});
  char *renamed = slurp(phases_path), *method = strstr(renamed, "\"saltation\"");
  method[1] = 'S';
  struct job skipping;
  run_well(&skipping, "verify", none, "--only", "num-t_a,text-periodic,eq-27", "--out", scratch_path("skipping"), NULL);
  discard(&skipping);
  const struct {
    const char *schema, *file;
    int want;
  } checks[N] = {
      {"schema/audit.schema.json", full_json_path, 0},
      {"schema/audit.schema.json", scratch_path("skipping/audit.json"), 0},
      {"schema/audit.schema.json", scratch_put("damaged.json", damaged), 1},
      {"schema/orbit.schema.json", output_of("none.json", (const char *const[]){"orbit", none, "--json", NULL}), 0},
      {"schema/orbit.schema.json", output_of("orbit.json", (const char *const[]){"orbit", stiff, "--json", NULL}), 0},
      {"schema/orbit.schema.json",
       output_of("basin.json", (const char *const[]){"orbit", "stable", "--basin", "--json", NULL}), 0},
      {"schema/orbit.schema.json", output_of("box.json", (const char *const[]){"orbit", box, "--json", NULL}), 0},
      {"schema/bifurcate.schema.json",
       output_of("line.json", (const char *const[]){"bifurcate", stiff, "--along", "V=0.2:3", "--json", NULL}), 0},
      {"schema/readings.schema.json",
       output_of("readings.json", (const char *const[]){"readings", "paper", "--json", NULL}), 0},
      {"schema/orbit-paper.schema.json",
       output_of("route.json", (const char *const[]){"orbit", stiff, "--method", "paper", "--json", NULL}), 0},
      {"schema/jacobian.schema.json",
       output_of("printed.json", (const char *const[]){"jacobian", "paper", "--at", "printed", "--json", NULL}), 0},
      {"schema/jacobian.schema.json",
       output_of("fd.json", (const char *const[]){"jacobian", "paper", "--method", "fd", "--json", NULL}), 0},
      {"schema/jacobian.schema.json",
       output_of("double.json", (const char *const[]){"jacobian", "paper", "--method", "fd-double", "--json", NULL}),
       0},
      /* the first orbit of the paper's data breaks a condition, so that Coulomb's law leaves it */
      {"schema/phases.schema.json",
       output_of("left.json", (const char *const[]){"jacobian", "paper", "--phases", "--json", NULL}), 0},
      {"schema/phases.schema.json", phases_path, 0},
      {"schema/phases.schema.json", scratch_put("renamed.json", renamed), 1},
      {"schema/phases.schema.json",
       output_of("at.json", (const char *const[]){"jacobian", "paper", "--phases", "--at", "printed", "--json", NULL}),
       0},
  };
  free(renamed);
  free(damaged);
  /* those that obey by one interpreter, the damaged ones alone */
  const char *words[2 * N + 2] = {"tests/oracle/validate.py"};
  int n = 1;
  for (int i = 0; i < N; i++) {
    if (checks[i].want == 0) {
      words[n++] = checks[i].schema;
      words[n++] = checks[i].file;
      continue;
    }
    struct job j;
    start(&j, NULL, python(), (const char *const[]){words[0], checks[i].schema, checks[i].file, NULL});
    finish(&j);
    ck_assert_msg(j.status == checks[i].want, "%s: status %d, %.1500s", checks[i].file, j.status, j.err);
    discard(&j);
  }
  struct job all;
  start(&all, NULL, python(), words);
  finish(&all);
  ck_assert_msg(all.status == 0, "status %d, %.1500s%.1500s", all.status, all.out, all.err);
  discard(&all);
}
END_TEST

/* --- Usage and bad input --- */

START_TEST(the_projects_own_files_are_good) {
  static const char *const patterns[] = {"verify/paper/*.eq", "verify/errata.eq", "verify/claims/*.claim",
                                         "verify/scenes/*.scene"};
  glob_t g;
  for (int i = 0; i < 4; i++) ck_assert(glob(patterns[i], i ? GLOB_APPEND : 0, NULL, &g) == 0);
  const char *args[MAX_ARGS + 1] = {"check"};
  ck_assert(g.gl_pathc + 2 < MAX_ARGS);
  struct text want;
  text_init(&want);
  for (size_t i = 0; i < g.gl_pathc; i++) {
    args[i + 1] = g.gl_pathv[i];
    text_printf(&want, "%s: ok\n", g.gl_pathv[i]);
  }
  struct job j;
  start(&j, NULL, program(), args);
  finish(&j);
  ck_assert_msg(j.status == 0 && !*j.err, "%d: %.1500s", j.status, j.err);
  ck_assert_str_eq(j.out, text_str(&want));
  text_clear(&want);
  globfree(&g);
  discard(&j);
}
END_TEST

/* What of a scene on file is not proved, and why. */
static const struct {
  const char *scene, *lacks, *why;
} unproved[] = {
    {"solution-II", "complete", "no complete search for this pair of given quantities"},
    {"paper-e1-t_a", "complete", "no complete search for this pair of given quantities"},
    {"paper-e1-t_c", "complete", "no complete search for this pair of given quantities"},
    {"paper-e2-t_a", "complete", "no complete search for this pair of given quantities"},
    {"paper-t_a-t_b", "complete", "no complete search for this pair of given quantities"},
    {"paper-t_c-t_d", "complete", "no complete search for this pair of given quantities"},
};

/* An exception must be one, and "complete" for the reason that the program gives. */
static void is_proved_or_excepted(const char *path, const char *out, const char *lacks, bool proved) {
  const char *name = strrchr(path, '/') + 1, *why = NULL;
  for (size_t i = 0; i < sizeof unproved / sizeof *unproved; i++)
    if (strncmp(name, unproved[i].scene, strlen(unproved[i].scene)) == 0 &&
        strcmp(name + strlen(unproved[i].scene), ".scene") == 0 && strcmp(unproved[i].lacks, lacks) == 0)
      why = unproved[i].why;
  ck_assert_msg(proved == !why, "%s, %s: %.300s", path, lacks, out);
  if (why && strcmp(lacks, "complete") == 0) ck_assert_msg(strstr(out, why) != NULL, "%s: %.300s", path, out);
}

/* Every scene on file has a list proved complete and orbits that are certified, to 30 digits, but for those above, and
   for lists of other words than the paper's, whose search is not exhaustive and says so. */
START_TEST(scenes_on_file_are_proved) {
  glob_t g;
  ck_assert(glob("verify/scenes/*.scene", 0, NULL, &g) == 0 && g.gl_pathc >= 25);
  long proved = 0;
  for (size_t i = 0; i < g.gl_pathc; i++) {
    struct job j;
    run_well(&j, "orbit", g.gl_pathv[i], "--digits", "30", "--json", NULL);
    bool other = strstr(j.out, "\"fate\": \"open\"") != NULL, system = strstr(j.out, "\"system\": ") != NULL;
    if (system)
      ck_assert_msg(strstr(j.out, "there may be others") != NULL, "%s: %.300s", g.gl_pathv[i], j.out);
    else if (other)
      ck_assert_msg(strstr(j.out, "no proof of completeness") != NULL, "%s: %.300s", g.gl_pathv[i], j.out);
    else
      is_proved_or_excepted(g.gl_pathv[i], j.out, "complete", strstr(j.out, "\"complete\": true") != NULL);
    is_proved_or_excepted(g.gl_pathv[i], j.out, "certified", strstr(j.out, "\"certified\": false") == NULL);
    for (const char *p = strstr(j.out, "\"certified\": true"); p; p = strstr(p + 1, "\"certified\": true")) proved++;
    discard(&j);
  }
  ck_assert_int_ge(proved, 35);
  globfree(&g);
}
END_TEST

START_TEST(one_bad_file_among_good_ones) {
  struct job j;
  const char *bad = scratch_put("bad.scene", "chi = 0\n");
  run(&j, "check", "verify/scenes/paper.scene", bad, "verify/errata.eq", NULL);
  ck_assert_int_eq(j.status, 3);
  ck_assert_str_eq(j.out, "verify/scenes/paper.scene: ok\nverify/errata.eq: ok\n");
  ck_assert(strncmp(j.err, bad, strlen(bad)) == 0);
  discard(&j);
}
END_TEST

START_TEST(a_full_disk_is_noticed) {
  static const char *const commands[][6] = {{"orbit", "paper"},
                                            {"orbit", "paper", "--json"},
                                            {"jacobian", "paper"},
                                            {"list"},
                                            {"check", "verify/errata.eq"},
                                            {"--help"},
                                            {"--version"},
                                            {"orbit", "--help"}};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
    struct job j;
    start(&j, "/dev/full", program(), commands[i]);
    finish(&j);
    ck_assert_msg(j.status == 3 && strstr(j.err, "standard output cannot be written"), "%s: status %d, %.1500s",
                  commands[i][0], j.status, j.err);
    discard(&j);
  }
}
END_TEST

/* A reader who has read enough, as behind "| head", is no error. */
START_TEST(a_reader_may_stop) {
  static const char *const commands[] = {"list", "simulate paper --csv --periods 2000", "help orbit",
                                         "sweep paper --over e2=0.5:3:2000 --over e1=2:3:500"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
    int status;
    char *out = shell_output(&status, "bash -c '{ %s %s; echo $? >&2; } 2>%s | true; cat %s'", program(), commands[i],
                             scratch_path("said"), scratch_path("said"));
    ck_assert_msg(strcmp(out, "0\n") == 0, "%s: %s", commands[i], out);
    free(out);
  }
}
END_TEST

/* A copy of the program beside which there is none of the folders. */
START_TEST(no_data_folder_is_noticed) {
  struct job j;
  struct text command;
  if (access(STICKSLIP_DATADIR, F_OK) == 0) return; /* installed */
  text_init(&command);
  text_printf(&command, "mkdir -p %s/a/b && cp %s %s/a/b/copy", scratch_path(""), program(), scratch_path(""));
  ck_assert_int_eq(system(text_str(&command)), 0);
  text_clear(&command);
  const char *const words[] = {"list", NULL};
  unsetenv("STICKSLIP_DATA");
  start(&j, NULL, scratch_path("a/b/copy"), words);
  finish(&j);
  ck_assert_msg(j.status == 3 && strstr(j.err, "the data folder verify/ was not found; set STICKSLIP_DATA to it"),
                "%d, %.1500s", j.status, j.err);
  discard(&j);
}
END_TEST

START_TEST(a_missing_data_folder_is_noticed) {
  struct job j;
  setenv("STICKSLIP_DATA", scratch_path("no-data"), 1);
  run(&j, "list", NULL);
  unsetenv("STICKSLIP_DATA");
  ck_assert_msg(j.status == 3 && strstr(j.err, scratch_path("no-data")), "%d, %.1500s", j.status, j.err);
  discard(&j);
}
END_TEST

/* --- explain --- */

/* The n-th number of the line that begins with the label. */
static double shown_number(const char *out, const char *label, int n) {
  const char *p = strstr(out, label);
  ck_assert_msg(p != NULL, "no line \"%s\" in\n%.1500s", label, out);
  p += strlen(label);
  char *end;
  double x = 0;
  for (int i = 0; i < n; i++, p = end) {
    x = strtod(p, &end);
    ck_assert_msg(end > p, "%s: %d numbers, not %d", label, i, n);
  }
  return x;
}

/* (10) prints D with V t where t is meant: at V = 2, t = 3 the entry [1,3] is 6 against 3. */
START_TEST(explain_shows_both_sides) {
  static const char *const types[] = {"double", "mpfr  ", "arb   "};
  struct job j;
  run_well(&j, "explain", "eq-10", "--at", "V=2,t=3", NULL);
  ck_assert(strncmp(j.out, "eq-10, the claim: ", 18) == 0 && strstr(j.out, "conditional") &&
            strstr(j.out, "V = 2, t = 3"));
  for (int i = 0; i < 3; i++) {
    char left[20], right[20];
    snprintf(left, sizeof left, "%s left ", types[i]);
    snprintf(right, sizeof right, "%s right", types[i]);
    ck_assert(shown_number(j.out, left, 1) == 1 && shown_number(j.out, right, 1) == 1);
    double d = shown_number(j.out, right, 3) - 3; /* GSL's exponential rounds */
    ck_assert(shown_number(j.out, left, 3) == 6 && d > -1e-13 && d < 1e-13);
    const char *row = strstr(j.out, left);
    for (int k = 0; k < 4; k++, row = strchr(row, '\n') + 1) /* D is 4 x 4 */
      ck_assert(*row == (k ? ' ' : *left) && shown_number(row, k ? "" : left, k + 1) == 1);
    ck_assert(strncmp(row, right, strlen(right)) == 0);
  }
  ck_assert(strstr(j.out, "double left  1.0000000000000000  0  6.0000000000000000*  0\n"));
  ck_assert(strstr(j.out, "\nas read     D(t) := [I, V*t*I; 0, I]\n") &&
            strstr(j.out, "\n*           the two sides differ here\n"));
  discard(&j);
  run_well(&j, "explain", "eq-3", "--at", "chi=1/2,eta=3", "--tape", NULL); /* K from (3) */
  static const double k[] = {1, -0.5, -1.5, 1.5};
  for (int i = 0; i < 4; i++)
    ck_assert(shown_number(j.out, "double left ", i + 1) == k[i] && shown_number(j.out, "double right", i + 1) == k[i]);
  ck_assert(strstr(j.out, "%0 = ") != NULL);
  discard(&j);
}
END_TEST

/* What the page shows by an id can be explained, be it a claim, one that a restriction makes, a root or a control; and
   there are as many claims in the list as in the report. */
START_TEST(what_the_page_shows_can_be_explained) {
  char *page = slurp("reports/paper/index.html"), *audit = slurp("reports/paper/audit.json");
  struct job j;
  int roots = 0, controls = 0, claims = 0, lines = 0;
  ck_assert(page && audit);
  for (char *p = page; (p = strstr(p, " id=\"r-")) != NULL; roots++) {
    char id[40];
    ck_assert(sscanf(p, " id=\"r-%39[^\"]", id) == 1);
    p++;
    run_well(&j, "explain", id, NULL);
    ck_assert_msg(strncmp(j.out, id, strlen(id)) == 0 && strstr(j.out, "\nwrong       ") &&
                      strstr(j.out, "\nclaims      "),
                  "%s", j.out);
    discard(&j);
  }
  ck_assert_int_gt(roots, 15);
  const char *end = strstr(audit, "\n  \"consequences\"");
  for (const char *p = strstr(audit, "\n  \"claims\": ["); p && (p = strstr(p + 1, "\n      \"id\": ")) && p < end;)
    claims++;
  for (const char *p = strstr(audit, "\n  \"controls\": ["); p && (p = strstr(p + 1, "\n      \"id\": ")) != NULL;) {
    char id[60];
    if (controls++ % 24) continue;
    ck_assert(sscanf(p, "\n      \"id\": \"%59[^\"]", id) == 1);
    run_well(&j, "explain", id, NULL);
    ck_assert_msg(strstr(j.out, ", a control, ") && strstr(j.out, "\nclaim       "), "%s: %s", id, j.out);
    discard(&j);
  }
  ck_assert_int_gt(controls, 100);
  run_well(&j, "list", NULL);
  for (const char *p = j.out; *p; p = strchr(p, '\n') + 1) lines++;
  ck_assert_int_eq(lines, claims);
  discard(&j);
  run_well(&j, "explain", "eq-10d", NULL);
  ck_assert(strstr(j.out, "eq-10d, the claim: Z(t) = D(t) Z_0 in the global stick phase, when V = 1\n") == j.out &&
            strstr(j.out, "\nverdict     proved (on record: proved)\ncondition   V = 1\n"));
  discard(&j);
  free(audit);
  free(page);
}
END_TEST

/* A number alone is that of an equation: its claims, or the only one. */
START_TEST(an_equation_is_explained) {
  struct job j, other;
  run_well(&j, "explain", "40", NULL);
  ck_assert(strncmp(j.out, "(40): ", 6) == 0);
  static const char *const ids[] = {"eq-40", "eq-40b", "eq-40c", "eq-40d"};
  for (int i = 0; i < 4; i++) {
    char row[24];
    snprintf(row, sizeof row, "\n%-18s ", ids[i]);
    ck_assert_msg(strstr(j.out, row) != NULL, "%s", j.out);
  }
  run_well(&other, "explain", "(40)", NULL);
  ck_assert_str_eq(j.out, other.out);
  discard(&other);
  discard(&j);
  run_well(&j, "explain", "(13)", NULL);
  run_well(&other, "explain", "eq-13", NULL);
  ck_assert(strncmp(j.out, "eq-13, the claim: ", 18) == 0);
  ck_assert_str_eq(j.out, other.out);
  discard(&other);
  discard(&j);
}
END_TEST

/* --- Help --- */

/* Is the option or word in the text, not as the beginning of a longer one? */
static bool mentions(const char *text, const char *word) {
  size_t n = strlen(word);
  for (const char *p = strstr(text, word); p; p = strstr(p + 1, word))
    if ((p == text || strchr(" \n[(|\"", p[-1])) && strchr(" \n=],.)|;:", p[n])) return true;
  return false;
}

/* The rows of help --table, their four fields. */
enum { MOST_ROWS = 400, ROW_FIELDS = 4 };
struct rows {
  struct job j;
  char *field[MOST_ROWS][ROW_FIELDS];
  int n;
};

static void rows_read(struct rows *r) {
  run_well(&r->j, "help", "--table", NULL);
  r->n = 0;
  char *end = NULL;
  for (char *line = strtok_r(r->j.out, "\n", &end); line; line = strtok_r(NULL, "\n", &end), r->n++) {
    ck_assert_int_lt(r->n, MOST_ROWS);
    char *at = NULL, **field = r->field[r->n];
    int k = 0;
    for (char *f = strtok_r(line, "\t", &at); f && k < ROW_FIELDS; f = strtok_r(NULL, "\t", &at)) field[k++] = f;
    ck_assert_msg(k == ROW_FIELDS && (at == NULL || !*at), "row %d of help --table", r->n + 1);
  }
}

static void lines_fit(const char *what, const char *text, int most) {
  int n = 0;
  for (const char *p = text; *p; p += strcspn(p, "\n") + 1, n++)
    ck_assert_msg(strcspn(p, "\n") <= 80, "%s: %.200s", what, p);
  ck_assert_msg(n <= most, "%s has %d lines", what, n);
}

START_TEST(help_fits_a_screen) {
  static const char *const asked[] = {"-h", "help", "--help"};
  struct job j, other;
  struct rows r;
  run_well(&j, "--help", NULL);
  lines_fit("--help", j.out, 24);
  ck_assert(mentions(j.out, "COMMAND --help") && mentions(j.out, "0 as recorded"));
  for (int i = 0; i < 3; i++) {
    run_well(&other, asked[i], NULL);
    ck_assert_str_eq(other.out, j.out);
    discard(&other);
  }
  rows_read(&r);
  int commands = 0;
  for (int i = 0; i < r.n; i++) {
    char line[100];
    if (strcmp(r.field[i][1], "usage") != 0) continue;
    snprintf(line, sizeof line, "\n  %-10s %.80s\n", r.field[i][0], r.field[i][3]);
    ck_assert_msg(strstr(j.out, line) != NULL, "no line for %s", r.field[i][0]);
    commands++;
  }
  ck_assert_int_ge(commands, 18);
  discard(&r.j);
  discard(&j);
}
END_TEST

/* Less all that is blank; lines of a page are broken at blanks. */
static char *squeezed(const char *s) {
  char *out = strdup(s), *to = out;
  for (const char *p = out; *p; p++)
    if (*p != ' ' && *p != '\n') *to++ = *p;
  *to = '\0';
  return out;
}

/* How many options the page describes. */
static int options_of(const char *page) {
  const char *p = strstr(page, "\noptions:\n"), *end = strstr(page, "\nexamples:\n");
  int n = 0;
  ck_assert(p && end);
  while ((p = strstr(p + 1, "\n  --")) != NULL && p < end) n++;
  return n;
}

/* The page of the command holds its rows, and no more options than these. */
static void check_page(const struct rows *r, const char *command) {
  struct job page, same;
  char *flat;
  int n_options = 0, n_examples = 0;
  run_well(&page, command, "--help", NULL);
  run_well(&same, "help", command, NULL);
  ck_assert_str_eq(page.out, same.out);
  discard(&same);
  run_well(&same, command, "-h", NULL);
  ck_assert_str_eq(page.out, same.out);
  lines_fit(command, page.out, 100);
  flat = squeezed(page.out);
  for (int i = 0; i < r->n; i++) {
    char *const *field = r->field[i], *text = squeezed(field[3]), head[120];
    bool option = strncmp(field[1], "--", 2) == 0;
    bool own = strcmp(field[0], command) == 0 && strcmp(field[1], "usage") != 0;
    snprintf(head, sizeof head, "\n  %s%s%s\n", field[1], *field[2] == '-' ? "" : " ",
             *field[2] == '-' ? "" : field[2]);
    if (own) ck_assert_msg(strstr(flat, text) && (!option || strstr(page.out, head)), "%s: %s", command, field[3]);
    n_options += own && option;
    n_examples += own && strcmp(field[1], "example") == 0;
    free(text);
  }
  ck_assert_int_eq(n_options, options_of(page.out));
  ck_assert_int_eq(n_examples, 2);
  free(flat);
  discard(&same);
  discard(&page);
}

START_TEST(each_command_has_its_page) {
  struct rows r;
  rows_read(&r);
  for (int i = 0; i < r.n; i++)
    if (strcmp(r.field[i][1], "usage") == 0) check_page(&r, r.field[i][0]);
  discard(&r.j);
}
END_TEST

/* With an option that nobody has behind them nothing is done, and nothing else is wrong with them. */
START_TEST(examples_of_the_help_are_commands) {
  struct rows r;
  int n = 0;
  rows_read(&r);
  for (int i = 0; i < r.n; i++) {
    const char *args[MAX_ARGS + 1];
    int argc = 0;
    struct job j;
    if (strcmp(r.field[i][1], "example") != 0) continue;
    char *end = NULL, *word = strtok_r(r.field[i][3], " ", &end);
    ck_assert_str_eq(word, "stickslip");
    while ((word = strtok_r(NULL, " ", &end)) != NULL) args[argc++] = word;
    ck_assert_str_eq(args[0], r.field[i][0]);
    args[argc++] = "--no-such-option";
    args[argc] = NULL;
    start(&j, NULL, program(), args);
    finish(&j);
    ck_assert_msg(j.status == 2 && strstr(j.err, "unknown option --no-such-option"), "%s: %s", args[0], j.err);
    discard(&j);
    n++;
  }
  ck_assert_int_ge(n, 36);
  discard(&r.j);
}
END_TEST

/* The jobs that --job takes are those that the help names. */
START_TEST(help_names_every_job) {
  struct job help, refused;
  run_well(&help, "help", "bench", NULL);
  run(&refused, "bench", "--job", "nobody", NULL);
  char *p = strstr(refused.err, "--job takes one of "), *end = NULL;
  ck_assert_msg(refused.status == 2 && p, "%s", refused.err);
  p += strlen("--job takes one of ");
  *strstr(p, ", not nobody") = '\0';
  char *says = strstr(help.out, "JOB is ");
  says[strcspn(says, ".") + 1] = '\0'; /* what follows describes them */
  int n = 0;
  for (char *job = strtok_r(p, ", ", &end); job; job = strtok_r(NULL, ", ", &end), n++) {
    if (strcmp(job, "or") == 0) continue;
    ck_assert_msg(mentions(says, job), "the help says nothing of %s", job);
  }
  ck_assert_int_ge(n, 10);
  discard(&refused);
  discard(&help);
}
END_TEST

START_TEST(help_and_version) {
  struct job j;
  run_well(&j, "orbit", "--help", NULL);
  /* the ids that the data of orbits.tsv finds broken */
  static const char *const violations[] = {"t_a", "gamma_v1", "h_v2", "c_v2", "c_w", "u_r1", "u_r2"};
  for (size_t i = 0; i < sizeof violations / sizeof *violations; i++)
    ck_assert_msg(mentions(strstr(j.out, "violations"), violations[i]), "the help says nothing of %s", violations[i]);
  discard(&j);
  run_well(&j, "--version", NULL);
  ck_assert(strncmp(j.out, "stickslip ", 10) == 0 && strchr(j.out, '\n') == j.out + strlen(j.out) - 1);
  discard(&j);
}
END_TEST

Suite *cli_suite(void) {
  Suite *s = suite_create("cli");
  TCase *c = tcase_create("orbit");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, open_oracle, close_oracle);
  tcase_add_test(c, the_tests_own_rounding);
  tcase_add_test(c, orbits_of_every_set);
  tcase_add_test(c, orbit_writes_certificates);
  tcase_add_test(c, some_orbits_are_certified);
  tcase_add_test(c, an_orbit_beyond_the_digits_is_told);
  tcase_add_test(c, digits_as_asked);
  tcase_add_test(c, a_thousand_digits);
  tcase_add_test(c, text_says_what_json_says);
  tcase_add_test(c, friction_given_by_the_scene_counts);
  suite_add_tcase(s, c);
  c = tcase_create("jacobian");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, open_jacobians, close_jacobians);
  tcase_add_test(c, three_methods_agree_with_differences_made_elsewhere);
  tcase_add_test(c, every_method_keeps_its_word);
  tcase_add_test(c, layers_differ_in_the_entries_not_in_the_trace);
  tcase_add_test(c, the_stable_layer_gives_what_the_corrected_one_does);
  tcase_add_test(c, at_the_printed_numbers);
  tcase_add_test(c, every_method_states_its_accuracy);
  tcase_add_test(c, the_table_of_phases);
  suite_add_tcase(s, c);
  c = tcase_create("paper route");
  tcase_add_unchecked_fixture(c, open_oracle, close_oracle);
  tcase_add_test(c, the_papers_equations_have_the_same_orbits);
  tcase_add_test(c, the_model_is_the_default_method);
  suite_add_tcase(s, c);
  c = tcase_create("simulate");
  tcase_set_timeout(c, 120);
  tcase_add_unchecked_fixture(c, open_oracle, close_oracle);
  tcase_add_test(c, simulation_follows_admissible_orbits);
  tcase_add_test(c, csv_has_a_row_for_each_sample_and_event);
  tcase_add_test(c, the_printed_start_runs_on);
  tcase_add_test(c, the_usual_orbit_is_named);
  tcase_add_test(c, routes_compared_over_many_periods);
  tcase_add_test(c, any_two_of_six);
  tcase_add_test(c, numbers_of_a_scene_without_forces);
  suite_add_tcase(s, c);
  c = tcase_create("verify");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, open_full, close_full);
  tcase_add_test(c, the_report_on_record_is_the_computed_one);
  tcase_add_test(c, the_last_line_is_the_summary);
  tcase_add_test(c, the_markdown_holds_every_claim);
  tcase_add_test(c, the_recorded_verdicts_are_listed);
  tcase_add_loop_test(c, alone_or_together, 0, 5);
  tcase_add_test(c, a_claim_reproduces);
  tcase_add_test(c, verdicts_that_are_not_as_recorded);
  tcase_add_test(c, strict_means_no_discrepancies);
  tcase_add_test(c, several_scenes);
  tcase_add_test(c, output_that_cannot_be_written);
  tcase_add_test(c, a_report_that_does_not_fit_leaves_the_old_one);
  tcase_add_test(c, bad_input_leaves_the_old_report);
  tcase_add_test(c, json_obeys_its_schemas);
  tcase_add_test(c, a_box_of_parameters);
  suite_add_tcase(s, c);
  c = tcase_create("refusal");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, scratch_open, scratch_close);
  tcase_add_test(c, the_projects_own_files_are_good);
  tcase_add_test(c, scenes_on_file_are_proved);
  tcase_add_test(c, one_bad_file_among_good_ones);
  tcase_add_test(c, a_full_disk_is_noticed);
  tcase_add_test(c, a_reader_may_stop);
  tcase_add_test(c, no_data_folder_is_noticed);
  tcase_add_test(c, a_missing_data_folder_is_noticed);
  suite_add_tcase(s, c);
  c = tcase_create("explain");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, scratch_open, scratch_close);
  tcase_add_test(c, explain_shows_both_sides);
  tcase_add_test(c, what_the_page_shows_can_be_explained);
  tcase_add_test(c, an_equation_is_explained);
  suite_add_tcase(s, c);
  c = tcase_create("help");
  tcase_set_timeout(c, TIME_LIMIT);
  tcase_add_unchecked_fixture(c, scratch_open, scratch_close);
  tcase_add_test(c, help_fits_a_screen);
  tcase_add_test(c, each_command_has_its_page);
  tcase_add_test(c, examples_of_the_help_are_commands);
  tcase_add_test(c, help_names_every_job);
  tcase_add_test(c, help_and_version);
  suite_add_tcase(s, c);
  return s;
}
