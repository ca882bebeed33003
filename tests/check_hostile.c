/* What must not harm: bad values of every option, bad files, memory and disks that end, readers that go away, and what
   the fuzzers found.  The cases are tables in tests/hostile, where each line says what is wrong; the program is a
   process that may not have more than the memory and the time that a refusal takes. */
#define _DEFAULT_SOURCE /* flock */
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "command.h"
#include "every.h"
#include "process.h"
#include "test.h"

enum { MOST_WORDS = 40, MOST_MEMORY = 200 << 20 };

/* --- The program as a process --- */

/* What is tried: a command line, and how it ended. */
struct trial {
  const char *file;
  char *argv[MOST_WORDS];
  int argc;
  struct job_place place;
  struct job end;
};

/* Beside the program: what is built with it. */
static const char *beside(const char *name) {
  static char path[4200];
  const char *p = program(), *slash = strrchr(p, '/');
  snprintf(path, sizeof path, "%.*s/%s", slash ? (int)(slash - p) : 1, slash ? p : ".", name);
  return path;
}

static void add_word(struct trial *j, const char *word) {
  ck_assert(j->argc + 1 < MOST_WORDS);
  j->argv[j->argc++] = ss_strdup(word);
  j->argv[j->argc] = NULL;
}

static struct trial trial_of(const char *words) {
  struct trial j = {.file = program()};
  FREED char *all = ss_strdup(words);
  for (char *p = strtok(all, " "); p; p = strtok(NULL, " ")) add_word(&j, p);
  return j;
}

static void trial_clear(struct trial *j) {
  for (int i = 0; i < j->argc; i++) free(j->argv[i]);
  job_clear(&j->end);
}

static void begin(struct trial *j) {
  job_clear(&j->end);
  job_start(&j->end, &j->place, j->file, (const char *const *)j->argv);
}

static void run(struct trial *j) {
  begin(j);
  job_finish(&j->end);
}

static const char *shown(const struct trial *j) {
  static char line[600];
  size_t n = 0;
  for (int i = 0; i < j->argc && n + 70 < sizeof line; i++)
    n += (size_t)snprintf(line + n, sizeof line - n, "%.60s ", j->argv[i]);
  return line;
}

/* Run, it ends so and says this on standard error (table.h). */
static void run_ends(struct trial *j, int status, const char *says) {
  run(j);
  ck_assert_msg(j->end.status == status, "%s: %d, %.600s", shown(j), j->end.status, j->end.err);
  check_said(j->end.err, says, NULL, shown(j));
}

/* Rows of a table in tests/hostile. */
static struct table hostile(const char *name, int columns) {
  const char *path = formatted("tests/hostile/%s", name);
  return table_read(path, columns);
}

/* --- Options --- */

static void refuse_words(const char *words, const char *option, const char *value, int status, const char *wrong) {
  OWNED(trial) j = trial_of(words);
  if (option) add_word(&j, option);
  if (value) add_word(&j, value);
  j.place.memory = MOST_MEMORY;
  j.end = job_quick(&j.place, j.file, (const char *const *)j.argv);
  job_refused(&j.end, status, formatted("%s(%s)", shown(&j), wrong));
}

/* Options that take a count read it by one function: each of them has every 5th value, in turn, and each value some of
   them. */
static void try_option(char *const *option, const struct table *values) {
  enum { WORDS, NAME, KIND };
  static int counts;
  const char *words = option[WORDS], *name = option[NAME], *kind = option[KIND];
  bool often = strcmp(name, "--only") == 0 || strcmp(name, "--over") == 0 || strcmp(name, "--set") == 0;
  refuse_words(words, name, NULL, 2, "no value");
  refuse_words(words, name, "", 2, "an empty value");
  const char *twice = formatted("%s %s 1 %s", words, name, name);
  if (!often) refuse_words(twice, "1", NULL, 2, "given twice");
  for (int i = 0; i < values->n; i++) {
    char *const *column = values->row[i];
    if (strcmp(column[0], kind) != 0) continue;
    if (strcmp(kind, "count") == 0 && counts++ % every(5) != 0) continue;
    LOCAL(text, value);
    field_expand(&value, column[2], NULL);
    refuse_words(words, name, text_str(&value), atoi(column[1]), column[3]);
  }
}

static void try_flag(char *const *column) {
  for (int i = 0; i < 2; i++) {
    const char *word = formatted("%s=%s", column[1], i ? "yes" : "");
    refuse_words(column[0], word, NULL, 2, "a value for a flag");
  }
  refuse_words(column[0], column[1], column[1], 2, "given twice");
}

static void make_bad_places(void) {
  scratch_put("file", "a file\n");
  scratch_put_n("binary", "\x7F\x45\x4C\x46\0\xFF\xFE", 7);
  ck_assert(mkfifo(scratch_path("fifo"), 0600) == 0);
  ck_assert(symlink(scratch_path("loop"), scratch_path("loop")) == 0);
  ck_assert(mkdir(scratch_path("empty"), 0700) == 0);
}

CASE("input", .each = {scratch_open, scratch_close}, .seconds = 300);

TEST(bad_values_of_options) {
  make_bad_places();
  OWNED(table) options = hostile("options.tsv", 3);
  OWNED(table) values = hostile("values.tsv", 4);
  OWNED(table) flags = hostile("flags.tsv", 2);
  for (int i = 0; i < options.n; i++) try_option(options.row[i], &values);
  for (int i = 0; i < flags.n; i++) try_flag(flags.row[i]);
  check_is("file", "a file\n");
  ck_assert_str_eq(scratch_list(scratch_path("")), "binary empty fifo file loop");
  ck_assert_str_eq(scratch_list(scratch_path("empty")), "");
}

/* Each option that the program has must be in the table of its kind. */
TEST(every_option_is_in_the_tables) {
  struct table tables[2] = {hostile("options.tsv", 3), hostile("flags.tsv", 2)};
  OWNED(trial) j = trial_of("help --table");
  run(&j);
  int n = 0;
  for (char *p = j.end.out; (p = strstr(p, "\t--")) != NULL; n++) {
    char *name = p + 1, *value = strchr(name, '\t') + 1;
    p = value;
    value[-1] = '\0';
    const struct table *t = &tables[value[0] == '-'];
    bool found = strcmp(name, "--help") == 0;
    for (int i = 0; i < t->n; i++) found = found || strcmp(t->row[i][1], name) == 0;
    ck_assert_msg(found, "%s is not in tests/hostile/%s.tsv", name, value[0] == '-' ? "flags" : "options");
  }
  ck_assert_int_gt(n, 30);
  for (int i = 0; i < 2; i++) table_clear(&tables[i]);
}

/* --- Files --- */

TABLE(places, "tests/hostile/places.tsv", 4);
enum { PLACE, SUFFIX, WORDS, GOOD }; /* its columns */
TABLE(recipes, "tests/hostile/recipes.tsv", 2);

/* Text of the recipe; false when it is not a matter of text. */
static bool make_text(struct text *out, const char *recipe, char *const *p) {
  const char *good = p[GOOD];
  bool assigns = strcmp(p[PLACE], "scene") == 0 || strcmp(p[PLACE], "system") == 0,
       in_json = strcmp(recipe, "deep") == 0 && strstr(p[SUFFIX], "json");
  const char *const list[][2] = {
      {"good", good}, {"name", assigns ? "chi = " : "define user\n  mine := "}, {NULL, NULL}};
  for (int i = 0; i < recipes.n; i++)
    if (strcmp(in_json ? "deep in json" : recipe, recipes.row[i][0]) == 0) {
      field_expand(out, recipes.row[i][1], list);
      return true;
    }
  if (strcmp(recipe, "binary") == 0) {
    for (int i = 0; i < 65536; i++) text_add_char(out, (char)(i * 167 >> 3));
  } else if (strcmp(recipe, "no-newline") == 0) {
    text_add_n(out, good, strlen(good) - 1);
  } else if (strcmp(recipe, "crlf") == 0) {
    for (const char *c = good; *c; c++) text_printf(out, *c == '\n' ? "\r%c" : "%c", *c);
  } else if (strcmp(recipe, "cr") == 0) {
    for (const char *c = good; *c; c++) text_add_char(out, *c == '\n' ? '\r' : *c);
  } else {
    return false;
  }
  return true;
}

/* The file of the recipe at path. */
static void make_file(const char *recipe, char *const *p, const char *path) {
  LOCAL(text, t);
  if (make_text(&t, recipe, p)) {
    FILE *f = fopen(path, "wb");
    ck_assert(f && fwrite(text_str(&t), 1, t.len, f) == t.len && fclose(f) == 0);
  } else if (strcmp(recipe, "huge") == 0) {
    int fd = open(path, O_WRONLY | O_CREAT, 0600);
    ck_assert(fd >= 0 && ftruncate(fd, 100 << 20) == 0 && close(fd) == 0);
  } else if (strcmp(recipe, "folder") == 0) {
    ck_assert(mkdir(path, 0700) == 0);
  } else if (strcmp(recipe, "device") == 0) {
    ck_assert(symlink("/dev/zero", path) == 0);
  } else if (strcmp(recipe, "fifo") == 0) {
    ck_assert(mkfifo(path, 0600) == 0);
  } else if (strcmp(recipe, "loop") == 0) {
    ck_assert(symlink(path, path) == 0);
  } else if (strcmp(recipe, "unreadable") == 0) {
    int fd = open(path, O_WRONLY | O_CREAT, 0600);
    ck_assert(fd >= 0 && fchmod(fd, 0) == 0 && close(fd) == 0);
  } else {
    ck_assert_msg(strcmp(recipe, "none") == 0, "no recipe %s", recipe);
  }
}

static void try_place(char *const *p, const char *recipe, int status, const char *wrong) {
  const char *folder = formatted("%s-%s", recipe, p[PLACE]);
  ck_assert(mkdir(scratch_path(folder), 0755) == 0);
  const char *path = formatted("%s/%s", scratch_path(folder), p[SUFFIX]);
  make_file(recipe, p, path);
  bool whole = strcmp(p[PLACE], "paper") == 0 || strcmp(p[PLACE], "report") == 0; /* the command takes the folder */
  const char *target = whole ? scratch_path(folder) : path;
  const char *words = formatted(p[WORDS], target, target);
  OWNED(trial) j = trial_of(words);
  if (strcmp(p[PLACE], "certificate") == 0) j.file = beside("stickslip-checker");
  j.place.memory = MOST_MEMORY;
  j.place.permissions = strcmp(recipe, "unreadable") == 0;
  run(&j);
  if (status)
    job_refused(&j.end, status, formatted("%s(%s)", shown(&j), wrong));
  else
    ck_assert_msg(j.end.status == 0 && j.end.err_size == 0, "%s(%s): %d, %.600s", shown(&j), wrong, j.end.status,
                  j.end.err);
}

TEST(bad_files) {
  OWNED(table) files = hostile("files.tsv", 4);
  for (int i = 0; i < files.n; i++) {
    char *const *column = files.row[i];
    const char *named = formatted(" %s ", column[1]);
    for (int k = 0; k < places.n; k++) {
      const char *name = formatted(" %s ", places.row[k][PLACE]);
      if (strcmp(column[1], "all") == 0 || strstr(named, name))
        try_place(places.row[k], column[0], atoi(column[2]), column[3]);
    }
  }
}

/* --- Output that has nowhere to go --- */

TABLE(printing, "tests/cases/printing.tsv", 1);

CASE("output", .each = {scratch_open, scratch_close});

TEST_EACH(nobody_reads, 3) {
  static const char *const out[] = {"/dev/full", "closed", "pipe"};
  static const char *const why[] = {"No space left on device", "Bad file descriptor", NULL}; /* a reader may stop */
  for (int i = 0; i < printing.n; i++) {
    OWNED(trial) j = trial_of(*printing.row[i]);
    j.place.out = out[_i];
    run(&j);
    bool said = why[_i] ? j.end.status == 3 && strstr(j.end.err, "standard output cannot be written") &&
                              strstr(j.end.err, why[_i])
                        : j.end.status == 0 && j.end.err_size == 0;
    ck_assert_msg(said, "%s: %d, %.600s", *printing.row[i], j.end.status, j.end.err);
  }
}

/* Differences that nobody can read are no answer. */
TEST(a_difference_that_cannot_be_said) {
  const char *other =
      scratch_put("other.json", "{\"schema\": \"stickslip-audit-2\", \"summary\": {}, \"checks\": {}, \"claims\": []}");
  OWNED(trial) j = trial_of("diff reports/paper/audit.json");
  add_word(&j, other);
  run_ends(&j, 1, "");
  j.place.out = "/dev/full";
  run_ends(&j, 3, "");
}

/* Commands that write files: into a folder, or one file. */
static const struct {
  const char *words;
  const char *file; /* the first that is written into the folder; NULL: the option names the file itself */
} writing[] = {
    {"verify --only eq-3 --out", "audit.json"},
    {"orbit paper --certificate", NULL},
    {"sweep paper --over e2=1:2:300 --csv", NULL},
    {"stability lambda_2 --quick --jobs 1 --out", "stability.json"},
    {"bench --quick --job propagator --out", "bench.json"},
    {"mutate --count 1 --jobs 1 --only title --out", "mutation.json"},
    {"repair eq-31 --jobs 2 --out", "repairs.json"},
};
enum { N_WRITING = COUNT(writing) };

/* A folder named after the command with an old file in it, and the command that writes over it. */
static const char *old_file(struct trial *j, int i, mode_t mode) {
  const char *folder = formatted("out%d", i);
  const char *file = formatted("out%d/%s", i, writing[i].file ? writing[i].file : "old");
  ck_assert(mkdir(scratch_path(folder), 0755) == 0);
  const char *path = scratch_put(file, "old\n");
  ck_assert(chmod(scratch_path(folder), mode) == 0);
  *j = trial_of(writing[i].words);
  add_word(j, writing[i].file ? scratch_path(folder) : path);
  return path;
}

/* The old file is as it was, and alone but for a FILE.part to go on with. */
static void old_one_stays(const struct trial *j, int i, const char *path) {
  const char *name = strrchr(path, '/') + 1, *list;
  FREED char *now = file_text(path);
  ck_assert_msg(strcmp(now, "old\n") == 0, "%s: not the old file: %.100s", shown(j), now);
  const char *folder = formatted("out%d", i);
  list = scratch_list(scratch_path(folder));
  bool part =
      strcmp(j->argv[0], "sweep") == 0 && strcmp(list, formatted("%s %s.part %s.part.sum", name, name, name)) == 0;
  ck_assert_msg(part || strcmp(list, name) == 0, "%s leaves %s", shown(j), list);
}

TEST_EACH(a_read_only_folder, N_WRITING) {
  OWNED(trial) j;
  const char *path = old_file(&j, _i, 0555);
  j.place.permissions = true;
  run_ends(&j, 3, "Permission denied");
  old_one_stays(&j, _i, path);
}

/* The signal that comes with it must not end the program. */
TEST_EACH(a_full_disk, N_WRITING) {
  OWNED(trial) j;
  const char *path = old_file(&j, _i, 0755);
  j.place.file = 600;
  j.place.out = "/dev/null";
  run_ends(&j, 3, formatted("^%s && : error: cannot be written: File too large", scratch_path(formatted("out%d", _i))));
  old_one_stays(&j, _i, path);
}

/* What is asked for in a folder that is not there, fails, and leaves no folder. */
TEST_EACH(a_new_folder_goes_again, N_WRITING + 3) {
  static const char *const others[] = {"plot paper --out", "stability nosuch --quick --jobs 1 --out",
                                       "bench --quick --job propagator --inputs"};
  const char *words = _i < N_WRITING ? writing[_i].words : others[_i - N_WRITING];
  if (_i < N_WRITING && !writing[_i].file) return;
  OWNED(trial) j = trial_of(words);
  add_word(&j, scratch_path("new/a//b"));
  j.place.file = 600;
  j.place.out = "/dev/null";
  run_ends(&j, 3, "");
  ck_assert_msg(access(scratch_path("new"), F_OK) != 0, "%s leaves a folder", shown(&j));
}

static bool can_preload(void) {
  return !SANITIZED && access(beside("faults.so"), R_OK) == 0;
}

static const char *preloaded(void) {
  static char set[4300];
  snprintf(set, sizeof set, "LD_PRELOAD=%s", beside("faults.so"));
  return set;
}

/* One signal among those that end a program. */
struct ending {
  int number;
  const char *set[2]; /* it arrives at the first rename, at the third */
};
static const struct ending endings[] = {{SIGINT, {"SIGNAL_AT_RENAME=2", "SIGNAL_AT_RENAME=2:3"}},
                                        {SIGTERM, {"SIGNAL_AT_RENAME=15", "SIGNAL_AT_RENAME=15:3"}},
                                        {SIGHUP, {"SIGNAL_AT_RENAME=1", "SIGNAL_AT_RENAME=1:3"}}};

/* When every file is written and none is renamed, the old ones stay.  verify says so, with its status; other commands
   are ended by the signal. */
TEST_EACH(a_signal_while_files_are_written, COUNT(endings)) {
  if (!can_preload()) return;
  for (int i = 0; i < 2; i++) { /* a report of several files, a certificate */
    OWNED(trial) j;
    const char *path = old_file(&j, i, 0755);
    bool verify = strcmp(j.argv[0], "verify") == 0;
    j.place.env[0] = preloaded();
    j.place.env[1] = endings[_i].set[0];
    run_ends(&j, verify ? 5 : -endings[_i].number,
             verify ? "=stickslip: error: interrupted; nothing was written for this scene\n" : "=");
    old_one_stays(&j, i, path);
  }
}

/* When some files are renamed, the others follow: a folder never holds a report that is half new. */
TEST_EACH(a_signal_between_two_renames, COUNT(endings)) {
  if (!can_preload()) return;
  OWNED(trial) j;
  shell_well("$P verify --only eq-3 --quiet --out $D/whole");
  old_file(&j, 0, 0755);
  scratch_put("out0/audit.md", "old\n");
  scratch_put("out0/run.json", "old\n");
  j.place.env[0] = preloaded();
  j.place.env[1] = endings[_i].set[1];
  run_ends(&j, 5, "=stickslip: error: interrupted; this scene's report is written, and whole\n");
  shell_well("cmp $D/out0/audit.md $D/whole/audit.md");
  ck_assert(!scratch_says("out0/run.json", "old\n"));
  ck_assert_str_eq(scratch_list(scratch_path("out0")), scratch_list(scratch_path("whole")));
}

/* When one file cannot be renamed, those before it are what they were, or not there. */
TEST(a_rename_that_fails) {
  if (!can_preload()) return;
  OWNED(trial) j;
  const char *path = old_file(&j, 0, 0755);
  j.place.env[0] = preloaded();
  j.place.env[1] = "FAIL_RENAME=3";
  run_ends(&j, 3, ": error: cannot be written: Operation not permitted");
  old_one_stays(&j, 0, path);
}

/* The system has no memory for a wait: said, and not tried for ever. */
TEST(a_wait_that_fails) {
  if (!can_preload()) return;
  OWNED(trial) j;
  const char *path = old_file(&j, 0, 0755);
  add_word(&j, "--only"); /* enough besides to be shared by two */
  add_word(&j, "eq-40");
  add_word(&j, "--jobs");
  add_word(&j, "2");
  j.place.env[0] = preloaded();
  j.place.env[1] = "FAIL_POLL=1";
  run_ends(&j, 5, "=stickslip: out of memory\n");
  old_one_stays(&j, 0, path);
}

/* What a run that was killed between two renames left goes with the next run; a file of the user's does not. */
TEST(a_killed_run_leaves_nothing_for_long) {
  if (!can_preload()) return;
  OWNED(trial) j;
  old_file(&j, 0, 0755);
  scratch_put("out0/audit.json.backup", "mine\n");
  j.place.env[0] = preloaded();
  j.place.env[1] = "SIGNAL_AT_RENAME=9:3";
  run_ends(&j, -SIGKILL, "");
  ck_assert_ptr_nonnull(strstr(scratch_list(scratch_path("out0")), ".stickslip-"));
  j.place.env[0] = NULL;
  run_ends(&j, 0, "");
  ck_assert_ptr_null(strstr(scratch_list(scratch_path("out0")), ".stickslip-"));
  ck_assert(scratch_says("out0/audit.json.backup", "mine\n"));
}

/* A run at a folder to which another one is writing waits for it. */
TEST(two_runs_at_one_folder) {
  OWNED(trial) j;
  const char *path = old_file(&j, 0, 0755);
  int other = open(scratch_path("out0"), O_RDONLY | O_CLOEXEC);
  ck_assert(other >= 0 && flock(other, LOCK_EX) == 0);
  begin(&j);
  ck_assert(process_until(process_waits_for_a_lock, j.end.pid));
  old_one_stays(&j, 0, path);
  close(other);
  job_finish(&j.end);
  ck_assert_int_eq(j.end.status, 0);
  FREED char *now = file_text(path);
  ck_assert_uint_gt(strlen(now), 1000);
}

/* --- What the programs are built with --- */

/* Tables that nothing can write to once the program runs, addresses drawn by each run, a watched stack, and bounds of
   copies that are checked, by readelf. */
TEST_EACH(a_hardened_build, 3) {
  static const char *const file[] = {"stickslip", "libstickslip.so.0", "stickslip-checker"};
  static const char *const wanted[] = {"GNU_RELRO", "BIND_NOW", "Elf file type is DYN", "__stack_chk_fail",
#ifdef _FORTIFY_SOURCE /* not without optimisation, nor beside a sanitizer */
                                       "_chk@"
#endif
  };
  FREED char *out = shell_said("LC_ALL=C readelf -Wlds --dyn-syms %s", beside(file[_i]));
  for (size_t i = 0; i < COUNT(wanted); i++)
    ck_assert_msg(strstr(out, wanted[i]) != NULL, "%s: no %s", file[_i], wanted[i]);
}

/* --- Memory that ends --- */

/* A stack that cannot be had is said; one that can is taken. */
TEST(a_small_stack) {
  if (SANITIZED) return;
  FREED char *out = shell_said("(ulimit -c 0; ulimit -s 64; exec $P verify --only eq-3 --out $D/r) 2>&1; test $? = 5");
  ck_assert_msg(strncmp(out, "stickslip: error: the stack is too small", 40) == 0 && strchr(out, '\n')[1] == '\0', "%s",
                out);
  shell_well("ulimit -c 0; ulimit -S -s 64; exec $P verify --only eq-3 --out $D/r");
}

TABLE(allocating, "tests/cases/allocating.tsv", 1);

/* Asked for without any failure: how many allocations there are, and the report. */
static long count_allocations(struct trial *j) {
  static char count[400];
  snprintf(count, sizeof count, "FAIL_ALLOC_COUNT=%s", scratch_path("count"));
  j->place.env[0] = preloaded();
  j->place.env[1] = count;
  run_ends(j, 0, "");
  FREED char *text = file_text(scratch_path("count"));
  long n = atol(text);
  ck_assert_int_gt(n, 20);
  return n;
}

/* Ends with the message and the status, or does as it would have done; the report is the old one or the new. */
static void fails_well(struct trial *j, const char *which, const char *report, const char *whole) {
  const char *set = formatted("FAIL_ALLOC=%s", which);
  j->place.env[1] = set;
  if (report) scratch_put("out/audit.json", "old\n");
  run(j);
  bool said = strcmp(j->end.err, "stickslip: out of memory\n") == 0;
  ck_assert_msg(j->end.status == 0 || (j->end.status == 5 && said), "%s, allocation %s: status %d, %.600s", shown(j),
                which, j->end.status, j->end.err);
  if (!report) return;
  FREED char *now = file_text(report);
  ck_assert_msg(strcmp(now, whole) == 0 || (j->end.status == 5 && strcmp(now, "old\n") == 0),
                "allocation %s damages the report", which);
  ck_assert_msg(!strstr(scratch_list(scratch_path("out")), "json."), "allocation %s leaves a file", which);
}

/* The n-th fails, and from the n-th on all fail; n grows by so much per cent and so much. */
static void every_allocation(const char *words, long percent, long most) {
  FREED char *whole = NULL;
  const char *report = NULL;
  OWNED(trial) j = trial_of(words);
  if (strstr(words, "--out")) {
    ck_assert(mkdir(scratch_path("out"), 0755) == 0);
    add_word(&j, scratch_path("out"));
    report = scratch_path("out/audit.json");
  }
  long all = count_allocations(&j);
  if (report) whole = file_text(report);
  if (most && most < all) all = most;
  for (long n = 1; n <= all; n += 1 + n * percent / 100)
    for (int on = 0; on < 2; on++) {
      const char *which = formatted("%ld%s", n, on ? "+" : "");
      fails_well(&j, which, report, whole);
    }
}

CASE("memory", .each = {scratch_open, scratch_close}, .seconds = 300);

TEST_EACH(some_allocations_fail, allocating.n) {
  if (can_preload()) every_allocation(*allocating.row[_i], 200, 0);
}

CASE("memory, exhaustively", .each = {scratch_open, scratch_close}, .seconds = 3600, .tags = "long exhaustive");

TEST_EACH(all_allocations_fail, allocating.n) {
  enum { MOST = 3000 };
  if (can_preload()) every_allocation(*allocating.row[_i], 0, MOST);
}

CASE("memory");

/* Under a limit, memory ends where it is asked for in earnest: mostly inside FLINT and GMP. */
TEST(little_memory) {
  if (SANITIZED) return;
  static const char *const words[] = {"orbit paper --digits 30000", "readings paper", "orbit four --digits 3000"};
  for (size_t i = 0; i < COUNT(words); i++) {
    OWNED(trial) j = trial_of(words[i]);
    bool ended = false;
    const rlim_t least = 28, started = 32; /* with less the loader has no room for the libraries */
    for (rlim_t mb = least; mb <= 128 && !ended; mb += 2) {
      j.place.memory = mb << 20;
      run(&j);
      ended = j.end.status == 0;
      bool too_large = mb < started && j.end.status == 127; /* a build of make cover */
      ck_assert_msg(ended || too_large || (j.end.status == 5 && strstr(j.end.err, "out of memory")),
                    "%s in %ld MB: %d, %.600s", words[i], (long)mb, j.end.status, j.end.err);
    }
  }
}

/* --- What the fuzzers have tried --- */

static const char *const targets[] = {"reader", "latex",  "model",   "claims",      "scene", "system",
                                      "json",   "report", "options", "certificate", "quotes"};

CASE("input");

TEST_EACH(the_corpus_of_a_fuzzer, COUNT(targets)) {
  const char *name = formatted("replay-%s", targets[_i]);
  const char *corpus = formatted("tests/fuzz/corpus/%s", targets[_i]);
  OWNED(trial) j = trial_of(corpus);
  j.file = beside(name);
  run(&j);
  const char *last = strstr(j.end.out, " inputs\n");
  ck_assert_msg(j.end.status == 0 && last, "%s: %d, %.1500s", name, j.end.status, j.end.err);
}
