/* Sweeps.

   Orbits along a line are held against the search in balls at single points, and against bifurcate, which follows
   curves in balls: between two neighbouring points the number of orbits, of stable and of admissible ones must change
   by what it says changes there, and by nothing else.  The program is held to one set of bytes, whoever computed them
   and however often it was interrupted. */
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/decimal.h"
#include "base/part.h"
#include "command.h"
#include "every.h"
#include "explore/bifurcate.h"
#include "explore/family.h"
#include "params.h"
#include "process.h"
#include "rational.h"
#include "rng.h"
#include "test.h"

/* --- Lines. --- */

/* With so many points on it. */
struct line {
  struct param_line of;
  struct dyn_axis axis;
};

static struct line line_of(const char *const params[N_PARAMS], int vary, const char *from, const char *to, slong n) {
  struct line l = {.of = param_line_of(params, vary, from, to)};
  dyn_axis_init(&l.axis, vary, l.of.from, l.of.to, n);
  return l;
}

static void line_clear(struct line *l) {
  dyn_axis_clear(&l->axis);
  param_line_clear(&l->of);
}

static void find(struct dyn_family *f, const struct line *l, slong every, bool late) {
  struct dyn_family_request q = {.params = l->of.params, .axis = &l->axis, .every = every, .late = late};
  ck_assert_int_eq(dyn_family_find(f, &q, 0, l->axis.n), SS_OK);
}

/* --- Values. --- */

TEST(values_are_exact_and_rounded_once) {
  static const char *const ends[][2] = {{"0.80", "0.90"},
                                        {"3", "0.5"},
                                        {"1e-300", "1e300"},
                                        {"0.1234567890123456789012345678901234567890", "9"},
                                        {"9007199254740993", "9007199254740995"}};
  static const slong sizes[] = {2, 3, 7, 20000};
  for (size_t i = 0; i < COUNT(ends); i++)
    for (size_t k = 0; k < COUNT(sizes); k++) {
      NUMBERS(fmpq, x, want, step);
      slong n = sizes[k];
      OWNED(line) l = line_of(example_text, P_E2, ends[i][0], ends[i][1], n);
      fmpq_sub(step, l.of.to, l.of.from);
      fmpq_div(step, step, (fmpq_set_si(x, n - 1, 1), x));
      for (slong j = 0; j<n; j += n> 100 ? 1 + j % 13 : 1) {
        double d;
        fmpq_set_si(want, j, 1);
        fmpq_mul(want, want, step);
        fmpq_add(want, want, l.of.from);
        dyn_axis_q(x, &l.axis, j);
        ck_assert(fmpq_equal(x, want));
        ck_assert_int_eq(num_double.set_q(&d, want, 53), SS_OK);
        ck_assert_msg(dyn_axis_d(&l.axis, j) == d, "%s:%s, %ld of %ld: %.17g is not %.17g", ends[i][0], ends[i][1],
                      (long)j, (long)n, dyn_axis_d(&l.axis, j), d);
      }
      dyn_axis_q(x, &l.axis, n - 1);
      ck_assert(fmpq_equal(x, l.of.to));
    }
}

static void same_decimal(double x) {
  char got[DECIMAL_MAX], want[DECIMAL_MAX];
  for (int digits = 1; digits <= DECIMAL_DIGITS; digits++) {
    int len = decimal_digits(got, x, digits);
    snprintf(want, sizeof want, "%.*g", digits, x);
    ck_assert_msg(strcmp(got, want) == 0 && len == (int)strlen(want), "%a to %d digits: %s, not %s", x, digits, got,
                  want);
  }
  decimal_whole(got, x);
  ck_assert_msg(strtod(got, NULL) == x, "%a: %s", x, got);
  for (int digits = 15; digits < 17; digits++) {
    snprintf(want, sizeof want, "%.*g", digits, x);
    if (strtod(want, NULL) != x) continue;
    ck_assert_str_eq(got, want);
    return;
  }
}

/* Against printf: any size, few digits (ties of the last place among them), and the neighbours of powers of ten. */
TEST(decimals_are_those_of_printf) {
  static const double special[] = {0, -0.0, 1, 0.5, 2.5, 0.125, 1e15, 1e-5, 1e-4, 9.5, 99.5, 1e22, 1e23, 5e-324, 1e308};
  for (size_t i = 0; i < COUNT(special); i++) {
    same_decimal(special[i]);
    same_decimal(-special[i]);
  }
  for (int e = -8; e < 20; e++) {
    double x = pow(10, e);
    same_decimal(nextafter(x, 0));
    same_decimal(nextafter(x, INFINITY));
  }
  struct rng r = {20240917};
  for (int i = 0; i < 20000 / every(8); i++) {
    double unit = rng_unit(&r);
    same_decimal(ldexp(unit, (int)rng_between(&r, -20, 39)));
    same_decimal(rng_dyadic(&r, 0, 999999)); /* exact ties */
    same_decimal(-(double)rng_between(&r, 0, 99999) / 1000);
  }
}

/* --- Orbits. --- */

/* The orbits of a point against those that the search in balls finds at its exact parameters. */
static void check_point(const struct dyn_family *f, const struct line *l, slong i, double slack) {
  FREED_PARAMS fmpq *params = rationals_of(l->of.params, N_PARAMS);
  dyn_axis_q(&params[l->axis.vary], &l->axis, i);
  OWNED(dyn_orbits) list = orbits_of(params, 128);
  const struct dyn_family_point *p = &f->point[i];
  ck_assert_msg(p->status == FAMILY_OK, "at %.17g: %s", p->x, dyn_family_status_name[p->status]);
  ck_assert_msg(p->n == list.n, "at %.17g: %ld orbits, not %ld", p->x, (long)p->n, (long)list.n);
  for (slong k = 0; k < list.n; k++) {
    const struct dyn_orbit *o = &list.orbit[k];
    const struct dyn_member *m = &f->member[p->first + k];
    for (int j = 0; j < N_DYN_OUT; j++) {
      double want = num_arb.get_d(dyn_orbit_output(o, (enum dyn_output)j));
      ck_assert_msg(fabs(m->out[j] - want) <= slack * (1 + fabs(want)),
                    "at %.17g: output %d of orbit %ld is %.17g, not %.17g", p->x, j, (long)k, m->out[j], want);
    }
    ck_assert_int_eq(m->stable, o->stable);
    ck_assert_int_eq(dyn_member_admissible(m), o->admissible);
    ck_assert_uint_eq(m->unsure, 0);
    for (int j = 0; j < N_CONDITIONS; j++) ck_assert_int_eq(!(m->violations >> j & 1), o->holds[j] == TRUTH_TRUE);
  }
}

/* Each parameter in turn, over ranges in which orbits come and go. */
TEST(orbits_are_those_of_the_search_in_balls) {
  static const struct {
    const char *params[N_PARAMS];
    int vary;
    const char *from, *to;
  } lines[] = {{{"0.8", "1", "1", "2.7844", "0.8587"}, P_E2, "0.5", "3"},
               {{"0.8", "1", "1", "2.7844", "0.8587"}, P_E1, "5", "0.3"},
               {{"0.8", "1", "1", "2.7844", "0.8587"}, P_CHI, "0.2", "0.97"},
               {{"0.6", "2.5", "0.7", "1.2", "0.4"}, P_V, "0.1", "3"},
               {{"0.25", "0.3", "3", "5", "2"}, P_ETA, "0.1", "6"}};
  for (size_t i = 0; i < COUNT(lines); i++) {
    OWNED(dyn_family) f;
    OWNED(line) l = line_of(lines[i].params, lines[i].vary, lines[i].from, lines[i].to, 601);
    find(&f, &l, 5, true);
    for (slong k = 0; k < 601; k += 12 * every(3)) check_point(&f, &l, k, 1e-11);
  }
}

struct census {
  int n, stable, admissible;
};

static struct census census_of(const struct dyn_family *f, slong i) {
  struct census c = {0, 0, 0};
  for (slong k = 0; k < f->point[i].n; k++) {
    const struct dyn_member *m = &f->member[f->point[i].first + k];
    c.n++;
    c.stable += m->stable == TRUTH_TRUE;
    c.admissible += dyn_member_admissible(m) == TRUTH_TRUE;
  }
  return c;
}

static void count_beside(struct census *c, const struct dyn_beside *b, int sign) {
  for (int i = 0; i < b->n; i++) {
    if (b->word[i] == TRUTH_FALSE) continue;
    c->n += sign;
    c->stable += sign * (b->orbit[i].stable == TRUTH_TRUE);
    c->admissible += sign * (b->orbit[i].admissible == TRUTH_TRUE);
  }
}

/* What changes between points i and i + 1, by bifurcate. */
static struct census change_at(const struct dyn_bifurcations *list, const struct line *l, slong i, int *events) {
  struct census c = {0, 0, 0};
  NUMBERS(fmpq, low, high);
  dyn_axis_q(low, &l->axis, i);
  dyn_axis_q(high, &l->axis, i + 1);
  for (slong k = 0; k < list->n; k++) {
    const struct dyn_bifurcation *b = &list->at[k];
    if (fmpq_cmp(&b->low, low) < 0 || fmpq_cmp(&b->high, high) > 0) continue;
    ++*events;
    count_beside(&c, &b->beside[0], -1);
    count_beside(&c, &b->beside[1], 1);
  }
  return c;
}

/* fold 1.112..., flip 1.811..., t_a = 0 at 2.103... and the others: nothing changes but there, and there all of it. */
TEST(changes_are_where_bifurcate_has_them) {
  enum { N = 2503 }; /* no value of the grid lies in a bracket */
  OWNED(dyn_family) f;
  OWNED(dyn_bifurcations) list;
  int events = 0;
  OWNED(line) l = line_of(example_text, P_E2, "0.5", "3", N);
  find(&f, &l, 256, true);
  const struct dyn_line line = {.params = l.of.params, .vary = P_E2, .from = l.of.from, .to = l.of.to};
  ck_assert_int_eq(dyn_bifurcations_find(&list, &line, 15, 257), SS_OK);
  ck_assert_int_eq(list.n, 11);
  for (slong i = 0; i + 1 < N; i++) {
    struct census a = census_of(&f, i), b = census_of(&f, i + 1), c = change_at(&list, &l, i, &events);
    ck_assert_msg(a.n + c.n == b.n && a.stable + c.stable == b.stable && a.admissible + c.admissible == b.admissible,
                  "from %.17g to the next: %d, %d, %d and %d, %d, %d", f.point[i].x, a.n, a.stable, a.admissible, b.n,
                  b.stable, b.admissible);
  }
  ck_assert_int_eq(events, 11);
  ck_assert_int_lt((int)f.searched, N / 10); /* followed, not searched for again and again */
}

/* With two anchors, with many and with nothing but anchors. */
static void check_anchors(int vary, const char *from, const char *to, slong n) {
  OWNED(dyn_family) g;
  OWNED(line) l = line_of(example_text, vary, from, to, n);
  find(&g, &l, 1, true);
  ck_assert_int_eq(g.searched, n);
  for (slong every = 7; every <= 7 * 64; every *= 8) {
    OWNED(dyn_family) f;
    find(&f, &l, every, true);
    for (slong i = 0; i < n; i++) {
      ck_assert_int_eq(f.point[i].n, g.point[i].n);
      for (slong k = 0; k < f.point[i].n; k++) {
        const struct dyn_member *a = &f.member[f.point[i].first + k], *b = &g.member[g.point[i].first + k];
        ck_assert_uint_eq(a->violations, b->violations);
        for (int j = 0; j < N_DYN_OUT; j++) ck_assert(fabs(a->out[j] - b->out[j]) <= 1e-11 * (1 + fabs(b->out[j])));
      }
    }
  }
}

TEST(followed_or_searched_for_is_the_same) {
  check_anchors(P_E2, "0.5", "3", 401);
  /* two branches come close, multipliers on both sides of 1: one ends there and the other begins */
  check_anchors(P_ETA, "0.6640625", "0.6875", 9);
}

/* A static friction that is passed on the line; u_r1_min grows with e2 there. */
TEST(static_friction_counts) {
  OWNED(dyn_family) f;
  NUMBERS(fmpq, u);
  int kept = 0, broken = 0;
  OWNED(line) l = line_of(example_text, P_E2, "0.8", "0.9", 101);
  rational_set(u, "2.15");
  struct dyn_family_request q = {.params = l.of.params, .axis = &l.axis, .every = 50, .u_r = {u, NULL}};
  ck_assert_int_eq(dyn_family_find(&f, &q, 0, 101), SS_OK);
  for (size_t i = 0; i < f.n_members; i++) {
    const struct dyn_member *m = &f.member[i];
    bool over = m->out[DYN_OUT_U1] >= 2.15;
    ck_assert_int_eq(m->violations >> MEMBER_U_R & 1, over);
    if (m->violations & ~(1U << MEMBER_U_R)) continue;
    kept += dyn_member_admissible(&f.member[i]) == TRUTH_TRUE;
    broken += dyn_member_admissible(&f.member[i]) == TRUTH_FALSE;
  }
  ck_assert(kept > 10 && broken > 10 && kept + broken == 101);
}

TEST(points_say_why_they_failed) {
  OWNED(dyn_family) ranged, spent, none;
  OWNED(line) to_one = line_of(example_text, P_CHI, "0.5", "0.9999999999999999999999", 2);
  find(&ranged, &to_one, 1, false);
  ck_assert_int_eq(ranged.point[0].status, FAMILY_OK);
  ck_assert_int_eq(ranged.point[1].status, FAMILY_RANGE);
  OWNED(line) stiff = line_of(example_text, P_ETA, "1", "1e12", 2);
  find(&spent, &stiff, 1, false);
  ck_assert_int_eq(spent.point[1].status, FAMILY_BUDGET);
  OWNED(line) l = line_of(example_text, P_E2, "0.8", "1", 300);
  struct dyn_family_request q = {.params = l.of.params, .axis = &l.axis, .every = 1};
  rational_set(&l.of.params[P_V], "0");
  ck_assert_int_eq(dyn_family_find(&none, &q, 0, 300), SS_DOMAIN);
}

/* --- The program. --- */

#define PLANE "sweep paper --over e1=2.2:3.4:5 --over e2=0.5:3:1500 --search-every 300"

CASE("program", .each = {scratch_open, scratch_close});

/* NAME.part and the sum over it, FNV-1a. */
static void put_part(const char *name, const char *bytes, size_t len) {
  char file[40], sum[60];
  unsigned long long hash = 14695981039346656037ULL;
  for (size_t i = 0; i < len; i++) hash = (hash ^ (unsigned char)bytes[i]) * 1099511628211ULL;
  snprintf(file, sizeof file, "%s.part", name);
  scratch_put_n(file, bytes, len);
  snprintf(file, sizeof file, "%s.part.sum", name);
  snprintf(sum, sizeof sum, "%zu %llx\n", len, hash);
  scratch_put(file, sum);
}

/* Whatever an interrupted run left: nothing but the head, a cut row, a whole unit and more. */
static void resume_at_cuts(const char *plane, const char *second_unit) {
  shell_well("\"$P\" %s --csv \"$D/whole\"", plane);
  FREED char *whole = file_text(scratch_path("whole"));
  size_t len = strlen(whole);
  size_t head = (size_t)(strstr(whole, "\npoint,") - whole), unit = (size_t)(strstr(whole, second_unit) - whole);
  head += strcspn(whole + head + 1, "\n") + 2;
  const size_t cuts[] = {head, head + 1, head + 100, unit, unit + 1, unit + 3, len / 2, len - 1, len};
  for (size_t i = 0; i < COUNT(cuts); i++) {
    put_part("cut", whole, cuts[i]);
    shell_well("\"$P\" %s --csv \"$D/cut\" --resume && cmp \"$D/whole\" \"$D/cut\" && test ! -e \"$D/cut.part\" "
               "&& test ! -e \"$D/cut.part.sum\"",
               plane);
  }
}

TEST(resumed_files_are_those_of_one_run) {
  resume_at_cuts(PLANE, "\n1500,");
  resume_at_cuts("sweep paper --over e1=2.2:3.4:20 --over e2=0.5:3:150", "\n300,"); /* lines beside each other */
  shell_well("\"$P\" " PLANE " --csv \"$D/fresh\" --resume && \"$P\" " PLANE " | cmp - \"$D/fresh\"");
}

/* What another request wrote, what was changed since it was written and what stands elsewhere is not gone on with. */
TABLE(parts, "tests/hostile/parts.tsv", 3);
enum { SCRIPT, REQUEST, SAYS }; /* its columns */

TEST_EACH(parts_are_refused, parts.n) {
  char *const *row = parts.row[_i];
  shell_well("\"$P\" " PLANE " --csv \"$D/whole\"");
  FREED char *whole = file_text(scratch_path("whole"));
  put_part("cut", whole, strlen(whole) / 2);
  shell_well("cp \"$D/cut.part\" \"$D/old\"; %s", row[SCRIPT]);
  shell_ends(3, row[SAYS], "PLANE='" PLANE "'; %s", row[REQUEST]);
  shell_well("test ! -e \"$D/cut\" && cmp -n $(wc -c < \"$D/old\") \"$D/whole\" \"$D/old\"");
}

/* As it was written, by its sum, and yet no part of the sweep. */
TEST(wrong_rows_are_refused) {
  shell_well("\"$P\" " PLANE " --csv \"$D/whole\"");
  FREED char *whole = file_text(scratch_path("whole"));
  size_t len = strlen(whole), head = (size_t)(strstr(whole, "\npoint,") - whole);
  strstr(whole, "\n100,")[1] = '3'; /* the points 99, 300 and 101 follow each other */
  put_part("cut", whole, len / 2);
  shell_ends(3, "error: not a row of this sweep", "\"$P\" " PLANE " --csv \"$D/cut\" --resume");
  put_part("cut", "# stickslip", 11);
  shell_ends(3, "ends within its head", "\"$P\" " PLANE " --csv \"$D/cut\" --resume");
  head += strcspn(whole + head + 1, "\n") + 2;
  FREED char *row_end = memset(ss_malloc(len + 100000), '1', len + 100000);
  memcpy(row_end, whole, head);
  put_part("cut", row_end, len + 100000);
  shell_ends(3, "error: not a row of this sweep", "\"$P\" " PLANE " --csv \"$D/cut\" --resume");
}

#define DIGITS "\"$P\" sweep \"$D/digits.scene\" --over e2=0.8:0.9:100 --csv \"$D/digits\""

TEST(long_heads_are_resumed) {
  enum { MANY = 5000 };
  static const char before[] = "title: a number of many digits\nchi = 0.8\neta = 1\nV = 1\ne2 = 0.8587\ne1 = 2.7844";
  char scene[sizeof before + MANY + 1];
  int len = snprintf(scene, sizeof scene, "%s%0*d\n", before, MANY, 1);
  scratch_put_n("digits.scene", scene, (size_t)len);
  shell_well(DIGITS " && mv \"$D/digits\" \"$D/whole\"");
  FREED char *whole = file_text(scratch_path("whole"));
  put_part("digits", whole, strlen(whole));
  shell_well(DIGITS " --resume && cmp \"$D/digits\" \"$D/whole\"");
}

/* Two at a time on one file. */
TEST(one_run_writes_a_file) {
  OWNED(part) a;
  part_init(&a, scratch_path("file"));
  goes_well(part_create(&a, &d));
  shell_ends(3, "file.part: error: another process is writing this file",
             "\"$P\" sweep paper --over e2=1:2:3 --csv \"$D/file\" --resume");
}

/* A run that takes long. */
#define LONG "sweep paper --over e1=2:4:20 --over e2=0.5:3:150 --search-every 1"

static off_t enough;

static bool has_written_enough(pid_t pid) {
  struct stat st;
  (void)pid;
  return stat(scratch_path("long.part"), &st) == 0 && st.st_size >= enough;
}

/* It, once it has written so many bytes; resume: what another left. */
static void start_long(struct job *j, bool resume, off_t size) {
  job_start_words(j, NULL, formatted(LONG " --csv %s%s", scratch_path("long"), resume ? " --resume" : ""));
  enough = size;
  ck_assert(process_until(has_written_enough, j->pid));
}

/* What it wrote before it ended is there, and the file not. */
static void ends_with(struct job *j, const char *says) {
  job_finish(j);
  ck_assert_msg(j->status == 5 && strstr(j->err, says) && strstr(j->err, "long.part holds "), "%d: %s", j->status,
                j->err);
  ck_assert(!scratch_has("long"));
  job_clear(j);
}

static void interrupt(struct job *j, int number) {
  kill(j->pid, number);
  ends_with(j, "");
}

/* The bytes that a run leaves which is interrupted. */
static off_t left_by(int number) {
  struct stat st;
  struct job j;
  start_long(&j, false, 60000);
  interrupt(&j, number);
  ck_assert_int_eq(stat(scratch_path("long.part"), &st), 0);
  return st.st_size;
}

/* The lock outlives that the file was read. */
TEST(one_run_continues_a_file) {
  struct job j;
  start_long(&j, true, left_by(SIGINT) + 60000);
  shell_ends(3, "long.part: error: another process is writing this file", "\"$P\" " LONG " --csv \"$D/long\" --resume");
  interrupt(&j, SIGTERM);
}

/* Twice, by one signal and by the other. */
TEST(signals_leave_a_file_to_resume) {
  struct job j;
  start_long(&j, true, left_by(SIGINT) + 60000);
  interrupt(&j, SIGTERM);
  shell_well("\"$P\" " LONG " --csv \"$D/long\" --resume");
  shell_well("\"$P\" " LONG " | cmp - \"$D/long\"");
}

/* One of its processes; 0: none is there. */
static pid_t child_of(pid_t pid) {
  int child = 0;
  const char *path = formatted("/proc/%d/task/%d/children", (int)pid, (int)pid);
  FILE *f = fopen(path, "r");
  if (f && fscanf(f, "%d", &child) != 1) child = 0;
  if (f) fclose(f);
  return child;
}

/* What it had cannot be told from what the others have: the run ends, and another goes on. */
TEST(a_process_that_is_killed_is_noticed) {
  struct job j;
  start_long(&j, false, 60000);
  pid_t child = child_of(j.pid);
  ck_assert_int_gt(child, 0);
  kill(child, SIGKILL);
  ends_with(&j, "a worker process ended before its time");
  start_long(&j, true, 120000);
  interrupt(&j, SIGINT);
}

static bool has_shown_enough(pid_t pid) {
  struct stat st;
  (void)pid;
  return stat(scratch_path("rows"), &st) == 0 && st.st_size >= enough;
}

TEST(a_signal_ends_what_goes_to_no_file) {
  OWNED(job) j;
  job_start_words(&j, &(struct job_place){.out = scratch_path("rows")},
                  "sweep paper --over e1=2:4:60 --over e2=0.5:3:1000");
  enough = 100000;
  ck_assert(process_until(has_shown_enough, j.pid));
  kill(j.pid, SIGINT);
  job_finish(&j);
  ck_assert_msg(j.status == 5 && strstr(j.err, "stickslip: interrupted\n"), "%d: %s", j.status, j.err);
}

static int unread; /* the end to read of a pipe */
static int room;   /* bytes that go into it */

/* In the midst of a write: what it writes at a time does not go in, and no page is empty. */
static bool is_stuck(pid_t pid) {
  int bytes = 0;
  return process_catches(pid, SIGTERM) && ioctl(unread, FIONREAD, &bytes) == 0 && bytes > room - sysconf(_SC_PAGESIZE);
}
static bool has_heard(pid_t pid) {
  return !process_catches(pid, SIGTERM);
}

/* The first signal ends it between two writes, and nobody reads what is written. */
TEST(a_second_signal_ends_at_once) {
  int ends[2];
  char byte = 0;
  ck_assert(pipe(ends) == 0);
  unread = ends[0];
  fcntl(ends[1], F_SETFL, O_NONBLOCK);
  for (room = 0; write(ends[1], &byte, 1) == 1;) room++;
  for (int i = 0; i < room; i++) ck_assert(read(unread, &byte, 1) == 1);
  fcntl(ends[1], F_SETFL, 0);
  fflush(NULL);
  pid_t pid = fork();
  ck_assert(pid >= 0);
  if (pid == 0) {
    process_as_from_a_shell();
    dup2(ends[1], STDOUT_FILENO);
    execl(program(), program(), "sweep", "paper", "--over", "e2=1:2:1000000", (char *)NULL);
    _exit(127);
  }
  ck_assert(process_until(is_stuck, pid));
  kill(pid, SIGTERM);
  ck_assert(process_until(has_heard, pid));
  kill(pid, SIGTERM);
  ck_assert_int_eq(process_end(pid), -SIGTERM);
  close(ends[0]);
  close(ends[1]);
}

/* --- Processes. --- */

TEST(ranks_give_the_same_bytes) {
  const char *mpi = getenv("STICKSLIP_MPI");
  if (!mpi || !*mpi || system("mpirun --version > /dev/null 2>&1") != 0) return;
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  shell_well("\"$P\" " PLANE " > \"$D/alone\"");
  for (int n = 1; n <= 3; n++) {
    int s = shell("mpirun -n %d \"%s\" " PLANE " --csv \"$D/ranks\" 2> \"$D/err\" && cmp \"$D/alone\" \"$D/ranks\"", n,
                  mpi);
    ck_assert_msg(s == 0, "%d ranks: status %d", n, s);
  }
  shell_ends(2, "N is a whole number", "mpirun -n 2 \"%s\" sweep paper --over e2=1:2:0", mpi);
}
