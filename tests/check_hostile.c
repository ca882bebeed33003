/* What must not harm: bad values of every option, bad files, memory and disks that end, readers that go away, and what
   the fuzzers found.  The cases are tables in tests/hostile, where each line says what is wrong; the program is a
   process that may not have more than the memory and the time that a refusal takes. */
#define _DEFAULT_SOURCE /* flock */
#include <check.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/text.h"
#include "every.h"
#include "process.h"
#include "scratch.h"
#include "suites.h"

#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 }; /* with memory and an allocator of its own, and slow */
#else
enum { SANITIZED = 0 };
#endif
#ifdef STICKSLIP_COUNTED
enum { COUNTED = 1 }; /* make cover: complains besides when it may not write its counts */
#else
enum { COUNTED = 0 };
#endif

enum { MOST_WORDS = 40, MOST_MEMORY = 200 << 20, MOST_MESSAGE = 1000, HANGS = 100, NOBODY = 65534 };

/* --- The program as a process --- */

struct job {
  const char *file;
  char *argv[MOST_WORDS];
  int argc;
  const char *out;          /* where standard output goes: a path; NULL: a file; "closed", "pipe": nobody reads */
  rlim_t memory, file_size; /* 0: any */
  bool nobody;              /* without root's rights */
  const char *env[3];       /* NAME=VALUE */
  /* how it ended */
  int status; /* exit status, or minus the signal */
  double seconds;
  struct text err;
  long out_size; /* bytes on standard output, where that is a file */
};

/* Beside the program: what is built with it. */
static const char *beside(const char *name) {
  static char path[4200];
  const char *p = program(), *slash = strrchr(p, '/');
  snprintf(path, sizeof path, "%.*s/%s", slash ? (int)(slash - p) : 1, slash ? p : ".", name);
  return path;
}

static void add_word(struct job *j, const char *word) {
  ck_assert(j->argc + 1 < MOST_WORDS);
  size_t n = strlen(word) + 1;
  j->argv[j->argc++] = memcpy(ss_malloc(n), word, n);
  j->argv[j->argc] = NULL;
}

static void add_words(struct job *j, const char *words) {
  char *all = ss_strdup(words);
  for (char *p = strtok(all, " "); p; p = strtok(NULL, " ")) add_word(j, p);
  free(all);
}

static void job_init(struct job *j, const char *words) {
  *j = (struct job){.file = program()};
  text_init(&j->err);
  add_word(j, "stickslip");
  add_words(j, words);
}

static void job_clear(struct job *j) {
  for (int i = 0; i < j->argc; i++) free(j->argv[i]);
  text_clear(&j->err);
}

static void lead(const char *path, int to) {
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || dup2(fd, to) < 0) _exit(126);
  close(fd);
}

static void lead_nowhere(void) {
  int ends[2];
  if (pipe(ends) != 0 || dup2(ends[1], STDOUT_FILENO) < 0) _exit(126);
  close(ends[0]);
  close(ends[1]);
}

static void set_in_environment(const char *pair) {
  char name[40];
  size_t n = strcspn(pair, "=");
  snprintf(name, sizeof name, "%.*s", (int)n, pair);
  setenv(name, pair + n + 1, 1);
}

/* In the child; never returns. */
static void become(const struct job *j, const char *out, const char *err) {
  lead(err, STDERR_FILENO);
  if (strcmp(out, "closed") == 0)
    close(STDOUT_FILENO);
  else if (strcmp(out, "pipe") == 0)
    lead_nowhere();
  else
    lead(out, STDOUT_FILENO);
  process_as_from_a_shell();
  for (int i = 0; i < 3 && j->env[i]; i++) set_in_environment(j->env[i]);
  if (j->nobody && geteuid() == 0 && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0)) _exit(126);
  if (j->memory && !SANITIZED) setrlimit(RLIMIT_AS, &(struct rlimit){j->memory, j->memory});
  if (j->file_size) {
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){j->file_size, j->file_size});
    count_nothing();
  }
  alarm(HANGS);
  execv(j->file, j->argv);
  _exit(127);
}

static void slurp(struct text *out, const char *path) {
  FILE *f = fopen(path, "rb");
  ck_assert_msg(f != NULL, "%s", path);
  char chunk[4096];
  for (size_t n = fread(chunk, 1, sizeof chunk, f); n > 0; n = fread(chunk, 1, sizeof chunk, f))
    text_add_n(out, chunk, n);
  fclose(f);
}

static void run(struct job *j) {
  const char *out = j->out ? j->out : scratch_path("job.out"), *err = scratch_path("job.err");
  double before = children_seconds();
  fflush(NULL);
  pid_t pid = fork();
  ck_assert(pid >= 0);
  if (pid == 0) become(j, out, err);
  j->status = process_end(pid);
  j->seconds = children_seconds() - before;
  struct stat st;
  j->out_size = !j->out && stat(out, &st) == 0 ? (long)st.st_size : 0;
  text_reset(&j->err);
  slurp(&j->err, err);
  ck_assert_msg((j->status != 127 || j->memory) && j->status != 126, "cannot start %s", j->file);
}

static const char *shown(const struct job *j) {
  static char line[600];
  size_t n = 0;
  for (int i = 0; i < j->argc && n + 70 < sizeof line; i++)
    n += (size_t)snprintf(line + n, sizeof line - n, "%.60s ", j->argv[i]);
  return line;
}

/* Refused as the contract says: the status, nothing on stdout, one message that fits. */
static void refused(const struct job *j, int status, const char *wrong) {
  const char *err = text_str(&j->err);
  size_t lines = 0, controls = 0;
  for (const char *p = err; *p; p++) {
    lines += *p == '\n';
    controls += ((unsigned char)*p < ' ' && *p != '\n') || *p == 0x7F;
  }
  ck_assert_msg(j->status == status, "%s(%s): status %d instead of %d, %.600s", shown(j), wrong, j->status, status,
                err);
  if (COUNTED && j->nobody && geteuid() == 0) return;
  ck_assert_msg(j->out_size == 0, "%s(%s): output besides the message", shown(j), wrong);
  ck_assert_msg(j->err.len > 10 && j->err.len <= MOST_MESSAGE + 40 && err[j->err.len - 1] == '\n', "%s(%s): %.1500s",
                shown(j), wrong, err);
  ck_assert_msg(lines == 1 || (lines == 3 && strstr(err, "^\n")), "%s(%s): not one message: %.1500s", shown(j), wrong,
                err);
  ck_assert_msg(controls == 0 && text_valid_prefix(err, j->err.len) == j->err.len, "%s(%s): %.600s", shown(j), wrong,
                err);
  ck_assert_msg(SANITIZED || j->seconds < 1, "%s(%s): takes %.2f s", shown(j), wrong, j->seconds);
}

/* --- Tables --- */

enum { MOST_COLUMNS = 4 };
typedef void row_fn(char *column[MOST_COLUMNS], void *arg);

static void each_row(const char *table, int columns, row_fn *f, void *arg) {
  struct text t;
  char path[100];
  int n = 0;
  text_init(&t);
  snprintf(path, sizeof path, "tests/hostile/%s", table);
  slurp(&t, path);
  for (char *line = t.data, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
    char *column[MOST_COLUMNS];
    *end = '\0';
    if (*line == '#') continue;
    ck_assert_msg(split_tabs(column, MOST_COLUMNS, line) == columns, "%s: %s", table, line);
    f(column, arg);
    n++;
  }
  ck_assert_msg(n > 5, "%s", table);
  text_clear(&t);
}

/* @N{text} repeats, @D is the test's folder, \xHH is a byte. */
static void expand(struct text *out, const char *v) {
  while (*v) {
    char *end;
    if (v[0] == '\\' && v[1] == 'x') {
      text_add_char(out, (char)strtol((char[]){v[2], v[3], '\0'}, NULL, 16));
      v += 4;
    } else if (v[0] == '@' && v[1] == 'D') {
      text_add(out, scratch_path(""));
      v += 2;
    } else if (v[0] == '@') {
      long n = strtol(v + 1, &end, 10);
      size_t len = strcspn(end, "}") - 1;
      for (long i = 0; i < n; i++) text_add_n(out, end + 1, len);
      v = end + 1 + len + 1;
    } else {
      text_add_char(out, *v++);
    }
  }
}

/* --- Options --- */

/* Less than a second of processor time: of what takes longer once, on a machine that does other things, the third time
   says. */
static void run_in_a_second(struct job *j) {
  for (int i = 0; i < 3 && (i == 0 || j->seconds >= 1); i++) run(j);
}

static void refuse_words(const char *words, const char *option, const char *value, int status, const char *wrong) {
  struct job j;
  job_init(&j, words);
  if (option) add_word(&j, option);
  if (value) add_word(&j, value);
  j.memory = MOST_MEMORY;
  run_in_a_second(&j);
  refused(&j, status, wrong);
  job_clear(&j);
}

struct option {
  const char *words, *name, *kind;
};

/* Options that take a count read it by one function: each of them has every 5th value, in turn, and each value some of
   them. */
static int counts;

static void try_value(char *column[MOST_COLUMNS], void *arg) {
  const struct option *o = arg;
  if (strcmp(column[0], o->kind) != 0) return;
  if (strcmp(o->kind, "count") == 0 && counts++ % every(5) != 0) return;
  struct text value;
  text_init(&value);
  expand(&value, column[2]);
  refuse_words(o->words, o->name, text_str(&value), atoi(column[1]), column[3]);
  text_clear(&value);
}

static void try_option(char *column[MOST_COLUMNS], void *arg) {
  struct option o = {column[0], column[1], column[2]};
  bool often = strcmp(o.name, "--only") == 0 || strcmp(o.name, "--over") == 0 || strcmp(o.name, "--set") == 0;
  char twice[300];
  (void)arg;
  refuse_words(o.words, o.name, NULL, 2, "no value");
  refuse_words(o.words, o.name, "", 2, "an empty value");
  snprintf(twice, sizeof twice, "%s %s 1 %s", o.words, o.name, o.name);
  if (!often) refuse_words(twice, "1", NULL, 2, "given twice");
  each_row("values.tsv", 4, try_value, &o);
}

static void try_flag(char *column[MOST_COLUMNS], void *arg) {
  char word[100];
  (void)arg;
  for (int i = 0; i < 2; i++) {
    snprintf(word, sizeof word, "%s=%s", column[1], i ? "yes" : "");
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

START_TEST(bad_values_of_options) {
  make_bad_places();
  each_row("options.tsv", 3, try_option, NULL);
  each_row("flags.tsv", 2, try_flag, NULL);
  struct text file;
  text_init(&file);
  slurp(&file, scratch_path("file"));
  ck_assert_str_eq(text_str(&file), "a file\n");
  ck_assert_str_eq(scratch_list(scratch_path("")), "binary empty fifo file job.err job.out loop");
  ck_assert_str_eq(scratch_list(scratch_path("empty")), "");
  text_clear(&file);
}
END_TEST

/* Whether a table names an option; each option that the program has must be in that of its kind. */
struct search {
  const char *name;
  bool found;
};

static void look_at(char *column[MOST_COLUMNS], void *arg) {
  struct search *s = arg;
  s->found = s->found || strcmp(column[1], s->name) == 0;
}

START_TEST(every_option_is_in_the_tables) {
  struct job j;
  struct text table;
  job_init(&j, "help --table");
  text_init(&table);
  run(&j);
  slurp(&table, scratch_path("job.out"));
  int n = 0;
  for (char *p = table.data; (p = strstr(p, "\t--")) != NULL; n++) {
    char *name = p + 1, *value = strchr(name, '\t') + 1;
    p = value;
    value[-1] = '\0';
    bool flag = value[0] == '-';
    struct search s = {name, strcmp(name, "--help") == 0};
    each_row(flag ? "flags.tsv" : "options.tsv", flag ? 2 : 3, look_at, &s);
    ck_assert_msg(s.found, "%s is not in tests/hostile/%s.tsv", name, flag ? "flags" : "options");
  }
  ck_assert_int_gt(n, 30);
  text_clear(&table);
  job_clear(&j);
}
END_TEST

/* --- Files --- */

static const struct place {
  const char *name, *suffix, *good;
  const char *words; /* %s: the file, or the folder that it is in */
} places[] = {
    {"eq", "x.eq", "define user\n  mine := 1\n", "check %s"},
    {"claim", "x.claim", "claim eq-1\n  kind: definition\n  title: none\n", "check %s"},
    {"scene", "x.scene", "chi = 0.8\neta = 1\nV = 1\ne1 = 2.7844\ne2 = 0.8587\n", "check %s"},
    {"system", "x.system",
     "chi = 4/5\nmass m1\n  inertia: 1\n  sliding: 1\n  static: 2\n  surface: 1\n"
     "spring k\n  between: ground, m1\n  stiffness: chi\n",
     "system %s"},
    {"text", "x.txt", "A text.\n", "quotes %s"},
    {"overlay", "x.eq", "define user\n  mine := 1\n", "stability H --at t=1,chi=0.5,eta=1 --overlay %s"},
    {"paper", "x.eq", "define user\n  mine := 1\n", "stability H --at t=1 --paper %s"},
    {"diff", "x.json",
     "{\"schema\": \"stickslip-audit-2\", \"summary\": {\"total\": 1}, \"checks\": {}, \"claims\": [{\"id\": \"eq-1\", "
     "\"verdict\": "
     "\"proved\"}]}\n",
     "diff %s %s"},
    {"report", "audit.json",
     "{\"schema\": \"stickslip-audit-2\", \"scene\": \"s\", \"title\": null, \"summary\": {\"proved\": 0, "
     "\"conditional\": 0, \"supported\": 0, \"refuted\": 0, \"unknown\": 0, \"skipped\": 0, \"definition\": 0, "
     "\"total\": 0}, \"checks\": {\"proved\": 0, "
     "\"conditional\": 0, \"supported\": 0, \"refuted\": 0, \"unknown\": 0, \"skipped\": 0, \"definition\": 0, "
     "\"total\": 0}, \"roots\": [], \"claims\": [], \"consequences\": [], \"skipped\": [], \"controls\": [], "
     "\"routes\": [], "
     "\"long_runs\": [], \"readings\": null, \"independence\": [], \"tables\": []}\n",
     "report %s"},
    {"certificate", "x.json", "{}\n", "%s"},
    {"peers", "x.tsv", "job\n", "bench --job propagator --quick --peers %s"},
};
enum { N_PLACES = sizeof places / sizeof *places };

static void repeat(struct text *out, long n, const char *s) {
  for (long i = 0; i < n; i++) text_add(out, s);
}

/* Text of the recipe; false when it is not a matter of text. */
static bool make_text(struct text *out, const char *recipe, const struct place *p) {
  bool assigns = strcmp(p->name, "scene") == 0 || strcmp(p->name, "system") == 0,
       json = strstr(p->suffix, "json") != NULL;
  const char *name = assigns ? "chi = " : "define user\n  mine := ";
  struct {
    const char *recipe, *text;
  } fixed[] = {{"circle", "define user\n  one := 1 + two\n  two := 2 + one\n"},
               {"itself", "define user\n  one := 1 + one\n"},
               {"stranger", "define user\n  one := stranger\n"},
               {"power", "chi = (((9^9999)^9999)^9999)^9999\n"},
               {"exponent", "chi = 1e999999999\n"},
               {"empty", ""}};
  for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++)
    if (strcmp(recipe, fixed[i].recipe) == 0) {
      text_add(out, fixed[i].text);
      return true;
    }
  if (strcmp(recipe, "binary") == 0) {
    for (int i = 0; i < 65536; i++) text_add_char(out, (char)(i * 167 >> 3));
  } else if (strcmp(recipe, "nul") == 0) {
    text_add(out, p->good);
    text_add_n(out, "\0", 1);
    text_add(out, p->good);
  } else if (strcmp(recipe, "latin") == 0) {
    text_printf(out, "# \xE9\n%s", p->good);
  } else if (strcmp(recipe, "many") == 0) {
    repeat(out, 200000, "  x\n");
  } else if (strcmp(recipe, "long-line") == 0) {
    repeat(out, 1000000, "a");
  } else if (strcmp(recipe, "deep") == 0) {
    if (!json) text_add(out, name);
    repeat(out, 100000, json ? "[" : "(");
  } else if (strcmp(recipe, "digits") == 0) {
    text_add(out, name);
    repeat(out, 1000000, "7");
  } else if (strcmp(recipe, "no-newline") == 0) {
    text_add_n(out, p->good, strlen(p->good) - 1);
  } else if (strcmp(recipe, "crlf") == 0) {
    for (const char *c = p->good; *c; c++) text_printf(out, *c == '\n' ? "\r%c" : "%c", *c);
  } else if (strcmp(recipe, "cr") == 0) {
    for (const char *c = p->good; *c; c++) text_add_char(out, *c == '\n' ? '\r' : *c);
  } else if (strcmp(recipe, "escape") == 0) {
    text_printf(out, "# \x1B[2J\n%s", p->good);
  } else if (strcmp(recipe, "c1") == 0) {
    text_printf(out,
                "# \xC2\x9B"
                "2J\n%s",
                p->good);
  } else if (strcmp(recipe, "bidi") == 0) {
    text_printf(out, "# \xE2\x80\xAE\n%s", p->good);
  } else if (strcmp(recipe, "bom") == 0) {
    text_printf(out, "\xEF\xBB\xBF%s", p->good);
  } else {
    return false;
  }
  return true;
}

/* The file of the recipe at path. */
static void make_file(const char *recipe, const struct place *p, const char *path) {
  struct text t;
  text_init(&t);
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
  text_clear(&t);
}

static void try_place(const struct place *p, const char *recipe, int status, const char *wrong) {
  char folder[40], words[1000];
  struct job j;
  snprintf(folder, sizeof folder, "%s-%s", recipe, p->name);
  ck_assert(mkdir(scratch_path(folder), 0755) == 0);
  struct text path;
  text_init(&path);
  text_printf(&path, "%s/%s", scratch_path(folder), p->suffix);
  make_file(recipe, p, text_str(&path));
  bool whole = strcmp(p->name, "paper") == 0 || strcmp(p->name, "report") == 0; /* the command takes the folder */
  const char *target = whole ? scratch_path(folder) : text_str(&path);
  snprintf(words, sizeof words, p->words, target, target);
  job_init(&j, words);
  if (strcmp(p->name, "certificate") == 0) j.file = beside("stickslip-checker");
  j.memory = MOST_MEMORY;
  j.nobody = strcmp(recipe, "unreadable") == 0;
  run(&j);
  if (status)
    refused(&j, status, wrong);
  else
    ck_assert_msg(j.status == 0 && j.err.len == 0, "%s(%s): %d, %.600s", shown(&j), wrong, j.status, text_str(&j.err));
  text_clear(&path);
  job_clear(&j);
}

static void try_file(char *column[MOST_COLUMNS], void *arg) {
  (void)arg;
  bool all = strcmp(column[1], "all") == 0;
  char named[200];
  snprintf(named, sizeof named, " %s ", column[1]);
  for (int i = 0; i < N_PLACES; i++) {
    char name[20];
    snprintf(name, sizeof name, " %s ", places[i].name);
    if (all || strstr(named, name)) try_place(&places[i], column[0], atoi(column[2]), column[3]);
  }
}

START_TEST(bad_files) {
  each_row("files.tsv", 4, try_file, NULL);
}
END_TEST

/* --- Output that has nowhere to go --- */

static const char *const printing[] = {"list",
                                       "orbit paper",
                                       "orbit paper --json",
                                       "orbit paper --method paper",
                                       "orbit stable --basin",
                                       "jacobian paper",
                                       "jacobian paper --phases",
                                       "simulate paper",
                                       "simulate paper --csv --periods 2000",
                                       "explain eq-27",
                                       "explain eq-27 --receipt",
                                       "check verify/errata.eq",
                                       "diff reports/paper/audit.json schema/../reports/paper/audit.json",
                                       "bifurcate paper --along e2=0.85:0.86",
                                       "sweep paper --over e2=1:2:3",
                                       "sweep paper --over e2=1:2:3 --json",
                                       "stability lambda_2 --at chi=0.5,eta=1",
                                       "--help",
                                       "--version"};

START_TEST(nobody_reads) {
  static const char *const out[] = {"/dev/full", "closed", "pipe"};
  static const char *const why[] = {"No space left on device", "Bad file descriptor", NULL}; /* a reader may stop */
  for (size_t i = 0; i < sizeof printing / sizeof *printing; i++) {
    struct job j;
    job_init(&j, printing[i]);
    j.out = out[_i];
    run(&j);
    bool said = why[_i] ? j.status == 3 && strstr(text_str(&j.err), "standard output cannot be written") &&
                              strstr(text_str(&j.err), why[_i])
                        : j.status == 0 && j.err.len == 0;
    ck_assert_msg(said, "%s: %d, %.600s", printing[i], j.status, text_str(&j.err));
    job_clear(&j);
  }
}
END_TEST

/* Differences that nobody can read are no answer. */
START_TEST(a_difference_that_cannot_be_said) {
  struct job j;
  const char *other =
      scratch_put("other.json", "{\"schema\": \"stickslip-audit-2\", \"summary\": {}, \"checks\": {}, \"claims\": []}");
  job_init(&j, "diff reports/paper/audit.json");
  add_word(&j, other);
  run(&j);
  ck_assert_int_eq(j.status, 1);
  j.out = "/dev/full";
  run(&j);
  ck_assert_int_eq(j.status, 3);
  job_clear(&j);
}
END_TEST

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
enum { N_WRITING = sizeof writing / sizeof *writing };

/* A folder named after the command with an old file in it, and the command that writes over it. */
static const char *old_file(struct job *j, int i, mode_t mode) {
  char folder[20], file[60];
  snprintf(folder, sizeof folder, "out%d", i);
  snprintf(file, sizeof file, "out%d/%s", i, writing[i].file ? writing[i].file : "old");
  ck_assert(mkdir(scratch_path(folder), 0755) == 0);
  const char *path = scratch_put(file, "old\n");
  ck_assert(chmod(scratch_path(folder), mode) == 0);
  job_init(j, writing[i].words);
  add_word(j, writing[i].file ? scratch_path(folder) : path);
  return path;
}

/* The old file is as it was, and alone but for a FILE.part to go on with. */
static void old_one_stays(const struct job *j, int i, const char *path) {
  char folder[20];
  const char *name = strrchr(path, '/') + 1, *list;
  struct text t;
  text_init(&t);
  slurp(&t, path);
  ck_assert_msg(strcmp(text_str(&t), "old\n") == 0, "%s: not the old file: %.100s", shown(j), text_str(&t));
  snprintf(folder, sizeof folder, "out%d", i);
  list = scratch_list(scratch_path(folder));
  text_reset(&t);
  text_printf(&t, "%s %s.part %s.part.sum", name, name, name);
  bool part = strcmp(j->argv[1], "sweep") == 0 && strcmp(list, text_str(&t)) == 0;
  ck_assert_msg(part || strcmp(list, name) == 0, "%s leaves %s", shown(j), list);
  text_clear(&t);
}

START_TEST(a_read_only_folder) {
  struct job j;
  const char *path = old_file(&j, _i, 0555);
  j.nobody = true;
  run(&j);
  ck_assert_msg(j.status == 3 && strstr(text_str(&j.err), "Permission denied"), "%s: %d, %.600s", shown(&j), j.status,
                text_str(&j.err));
  old_one_stays(&j, _i, path);
  job_clear(&j);
}
END_TEST

/* The signal that comes with it must not end the program. */
START_TEST(a_full_disk) {
  struct job j;
  const char *path = old_file(&j, _i, 0755);
  j.file_size = 600;
  j.out = "/dev/null";
  run(&j);
  ck_assert_msg(j.status == 3 && strstr(text_str(&j.err), "File too large"), "%s: %d, %.600s", shown(&j), j.status,
                text_str(&j.err));
  old_one_stays(&j, _i, path);
  job_clear(&j);
}
END_TEST

/* What is asked for in a folder that is not there, fails, and leaves no folder. */
START_TEST(a_new_folder_goes_again) {
  static const char *const others[] = {"plot paper --out", "stability nosuch --quick --jobs 1 --out",
                                       "bench --quick --job propagator --inputs"};
  const char *words = _i < N_WRITING ? writing[_i].words : others[_i - N_WRITING];
  if (_i < N_WRITING && !writing[_i].file) return;
  struct job j;
  job_init(&j, words);
  add_word(&j, scratch_path("new/a//b"));
  j.file_size = 600;
  j.out = "/dev/null";
  run(&j);
  ck_assert_msg(j.status == 3, "%s: %d, %.600s", shown(&j), j.status, text_str(&j.err));
  ck_assert_msg(access(scratch_path("new"), F_OK) != 0, "%s leaves a folder", shown(&j));
  job_clear(&j);
}
END_TEST

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
enum { N_ENDINGS = sizeof endings / sizeof *endings };

/* When every file is written and none is renamed, the old ones stay.  verify says so, with its status; other commands
   are ended by the signal. */
START_TEST(a_signal_while_files_are_written) {
  if (!can_preload()) return;
  for (int i = 0; i < 2; i++) { /* a report of several files, a certificate */
    struct job j;
    const char *path = old_file(&j, i, 0755);
    bool verify = strcmp(j.argv[1], "verify") == 0;
    j.env[0] = preloaded();
    j.env[1] = endings[_i].set[0];
    run(&j);
    ck_assert_msg(j.status == (verify ? 5 : -endings[_i].number), "%s: %d, %.600s", shown(&j), j.status,
                  text_str(&j.err));
    ck_assert_str_eq(text_str(&j.err),
                     verify ? "stickslip: error: interrupted; nothing was written for this scene\n" : "");
    old_one_stays(&j, i, path);
    job_clear(&j);
  }
}
END_TEST

/* The report as it should be. */
static void whole_report(struct text *out, const char *words) {
  struct job j;
  job_init(&j, words);
  add_word(&j, scratch_path("whole"));
  run(&j);
  ck_assert_int_eq(j.status, 0);
  slurp(out, scratch_path("whole/audit.md"));
  job_clear(&j);
}

/* When some files are renamed, the others follow: a folder never holds a report that is half new. */
START_TEST(a_signal_between_two_renames) {
  if (!can_preload()) return;
  struct job j;
  struct text whole, now;
  text_init(&whole);
  text_init(&now);
  whole_report(&whole, "verify --only eq-3 --quiet --out");
  old_file(&j, 0, 0755);
  scratch_put("out0/audit.md", "old\n");
  scratch_put("out0/run.json", "old\n");
  j.env[0] = preloaded();
  j.env[1] = endings[_i].set[1];
  run(&j);
  ck_assert_int_eq(j.status, 5);
  ck_assert_str_eq(text_str(&j.err), "stickslip: error: interrupted; this scene's report is written, and whole\n");
  slurp(&now, scratch_path("out0/audit.md"));
  ck_assert_str_eq(text_str(&now), text_str(&whole));
  text_reset(&now);
  slurp(&now, scratch_path("out0/run.json"));
  ck_assert_str_ne(text_str(&now), "old\n");
  text_reset(&now);
  text_add(&now, scratch_list(scratch_path("whole")));
  ck_assert_str_eq(scratch_list(scratch_path("out0")), text_str(&now));
  text_clear(&now);
  text_clear(&whole);
  job_clear(&j);
}
END_TEST

/* What a run that was killed between two renames left goes with the next run; a file of the user's does not. */
START_TEST(a_killed_run_leaves_nothing_for_long) {
  if (!can_preload()) return;
  struct job j;
  old_file(&j, 0, 0755);
  scratch_put("out0/audit.json.backup", "mine\n");
  j.env[0] = preloaded();
  j.env[1] = "SIGNAL_AT_RENAME=9:3";
  run(&j);
  ck_assert_int_eq(j.status, -SIGKILL);
  ck_assert_ptr_nonnull(strstr(scratch_list(scratch_path("out0")), ".stickslip-"));
  j.env[0] = NULL;
  run(&j);
  ck_assert_int_eq(j.status, 0);
  ck_assert_ptr_null(strstr(scratch_list(scratch_path("out0")), ".stickslip-"));
  ck_assert(scratch_says("out0/audit.json.backup", "mine\n"));
  job_clear(&j);
}
END_TEST

/* A run at a folder to which another one is writing waits for it. */
START_TEST(two_runs_at_one_folder) {
  struct job j;
  struct text now;
  const char *path = old_file(&j, 0, 0755);
  int other = open(scratch_path("out0"), O_RDONLY | O_CLOEXEC);
  ck_assert(other >= 0 && flock(other, LOCK_EX) == 0);
  fflush(NULL);
  pid_t pid = fork();
  ck_assert(pid >= 0);
  if (pid == 0) become(&j, "/dev/null", "/dev/null");
  ck_assert(process_until(process_waits_for_a_lock, pid));
  old_one_stays(&j, 0, path);
  close(other);
  ck_assert_int_eq(process_end(pid), 0);
  text_init(&now);
  slurp(&now, path);
  ck_assert_uint_gt(now.len, 1000);
  text_clear(&now);
  job_clear(&j);
}
END_TEST

/* --- What the programs are built with --- */

/* Tables that nothing can write to once the program runs, addresses drawn by each run, a watched stack, and bounds of
   copies that are checked, by readelf. */
START_TEST(a_hardened_build) {
  static const char *const file[] = {"stickslip", "libstickslip.so.0", "stickslip-checker"};
  static const char *const wanted[] = {"GNU_RELRO", "BIND_NOW", "Elf file type is DYN", "__stack_chk_fail",
#ifdef _FORTIFY_SOURCE /* not without optimisation, nor beside a sanitizer */
                                       "_chk@"
#endif
  };
  int status;
  char *out = shell_output(&status, "LC_ALL=C readelf -Wlds --dyn-syms %s", beside(file[_i]));
  ck_assert_int_eq(status, 0);
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
    ck_assert_msg(strstr(out, wanted[i]) != NULL, "%s: no %s", file[_i], wanted[i]);
  free(out);
}
END_TEST

/* --- Memory that ends --- */

/* A stack that cannot be had is said; one that can is taken. */
START_TEST(a_small_stack) {
  int status;
  if (SANITIZED) return;
  char *out = shell_output(&status, "ulimit -c 0; ulimit -s 64; exec %s verify --only eq-3 --out %s 2>&1", program(),
                           scratch_path("r"));
  ck_assert_msg(status == 5 && strncmp(out, "stickslip: error: the stack is too small", 40) == 0 &&
                    strchr(out, '\n')[1] == '\0',
                "%d: %s", status, out);
  free(out);
  out = shell_output(&status, "ulimit -c 0; ulimit -S -s 64; exec %s verify --only eq-3 --out %s 2>&1", program(),
                     scratch_path("r"));
  ck_assert_msg(status == 0, "%d: %s", status, out);
  free(out);
}
END_TEST

static const char *const allocating[] = {
    "list",
    "check verify/errata.eq verify/claims/1-model.claim verify/scenes/paper.scene",
    "diff reports/paper/audit.json reports/paper/audit.json",
    "orbit paper",
    "orbit stable --basin --json",
    "jacobian paper --method saltation",
    "jacobian paper --at orbit:2 --method ode",
    "simulate paper --samples 3",
    "explain eq-27",
    "bifurcate paper --along e2=0.85:0.86",
    "sweep paper --over e2=0.85:0.86:50 --jobs 1",
    "verify --only eq-3 --quiet --out",
};
enum { N_ALLOCATING = sizeof allocating / sizeof *allocating };

/* Asked for without any failure: how many allocations there are, and the report. */
static long count_allocations(struct job *j) {
  static char count[400];
  struct text t;
  snprintf(count, sizeof count, "FAIL_ALLOC_COUNT=%s", scratch_path("count"));
  j->env[0] = preloaded();
  j->env[1] = count;
  run(j);
  ck_assert_msg(j->status == 0, "%s: %d, %.600s", shown(j), j->status, text_str(&j->err));
  text_init(&t);
  slurp(&t, scratch_path("count"));
  long n = atol(text_str(&t));
  text_clear(&t);
  ck_assert_int_gt(n, 20);
  return n;
}

/* Ends with the message and the status, or does as it would have done; the report is the old one or the new. */
static void fails_well(struct job *j, const char *which, const char *report, const struct text *whole) {
  char set[60];
  snprintf(set, sizeof set, "FAIL_ALLOC=%s", which);
  j->env[1] = set;
  if (report) scratch_put("out/audit.json", "old\n");
  run(j);
  bool said = strcmp(text_str(&j->err), "stickslip: out of memory\n") == 0;
  ck_assert_msg(j->status == 0 || (j->status == 5 && said), "%s, allocation %s: status %d, %.600s", shown(j), which,
                j->status, text_str(&j->err));
  if (!report) return;
  struct text t;
  text_init(&t);
  slurp(&t, report);
  const char *now = text_str(&t);
  ck_assert_msg(strcmp(now, text_str(whole)) == 0 || (j->status == 5 && strcmp(now, "old\n") == 0),
                "allocation %s damages the report", which);
  ck_assert_msg(!strstr(scratch_list(scratch_path("out")), "json."), "allocation %s leaves a file", which);
  text_clear(&t);
}

/* The n-th fails, and from the n-th on all fail; n grows by so much per cent and so much. */
static void every_allocation(const char *words, long percent, long most) {
  struct job j;
  struct text whole;
  const char *report = NULL;
  text_init(&whole);
  job_init(&j, words);
  if (strstr(words, "--out")) {
    ck_assert(mkdir(scratch_path("out"), 0755) == 0);
    add_word(&j, scratch_path("out"));
    report = scratch_path("out/audit.json");
  }
  long all = count_allocations(&j);
  if (report) slurp(&whole, report);
  if (most && most < all) all = most;
  for (long n = 1; n <= all; n += 1 + n * percent / 100)
    for (int on = 0; on < 2; on++) {
      char which[30];
      snprintf(which, sizeof which, "%ld%s", n, on ? "+" : "");
      fails_well(&j, which, report, &whole);
    }
  text_clear(&whole);
  job_clear(&j);
}

START_TEST(some_allocations_fail) {
  if (can_preload()) every_allocation(allocating[_i], 120, 0);
}
END_TEST

START_TEST(all_allocations_fail) {
  enum { MOST = 3000 };
  if (can_preload()) every_allocation(allocating[_i], 0, MOST);
}
END_TEST

/* Under a limit, memory ends where it is asked for in earnest: mostly inside FLINT and GMP. */
START_TEST(little_memory) {
  if (SANITIZED) return;
  static const char *const words[] = {"orbit paper --digits 30000", "readings paper", "orbit four --digits 3000"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    struct job j;
    job_init(&j, words[i]);
    bool ended = false;
    const rlim_t least = 28, started = 32; /* with less the loader has no room for the libraries */
    for (rlim_t mb = least; mb <= 128 && !ended; mb += 2) {
      j.memory = mb << 20;
      run(&j);
      ended = j.status == 0;
      bool too_large = mb < started && j.status == 127; /* a build of make cover */
      ck_assert_msg(ended || too_large || (j.status == 5 && strstr(text_str(&j.err), "out of memory")),
                    "%s in %ld MB: %d, %.600s", words[i], (long)mb, j.status, text_str(&j.err));
    }
    job_clear(&j);
  }
}
END_TEST

/* --- What the fuzzers have tried --- */

static const char *const targets[] = {"reader", "latex",  "model",   "claims",      "scene", "system",
                                      "json",   "report", "options", "certificate", "quotes"};
enum { N_TARGETS = sizeof targets / sizeof *targets };

START_TEST(the_corpus_of_a_fuzzer) {
  struct job j;
  char name[40], corpus[60];
  struct text out;
  snprintf(name, sizeof name, "replay-%s", targets[_i]);
  snprintf(corpus, sizeof corpus, "tests/fuzz/corpus/%s", targets[_i]);
  job_init(&j, corpus);
  j.file = beside(name);
  text_init(&out);
  run(&j);
  slurp(&out, scratch_path("job.out"));
  const char *last = strstr(text_str(&out), " inputs\n");
  ck_assert_msg(j.status == 0 && last, "%s: %d, %.1500s", name, j.status, text_str(&j.err));
  text_clear(&out);
  job_clear(&j);
}
END_TEST

Suite *hostile_suite(void) {
  Suite *s = suite_create("hostile");
  TCase *tc = tcase_create("input");
  tcase_set_timeout(tc, 300);
  tcase_add_checked_fixture(tc, scratch_open, scratch_close);
  tcase_add_test(tc, bad_values_of_options);
  tcase_add_test(tc, every_option_is_in_the_tables);
  tcase_add_test(tc, bad_files);
  tcase_add_loop_test(tc, the_corpus_of_a_fuzzer, 0, N_TARGETS);
  suite_add_tcase(s, tc);

  tc = tcase_create("output");
  tcase_add_checked_fixture(tc, scratch_open, scratch_close);
  tcase_add_loop_test(tc, nobody_reads, 0, 3);
  tcase_add_test(tc, a_difference_that_cannot_be_said);
  tcase_add_loop_test(tc, a_read_only_folder, 0, N_WRITING);
  tcase_add_loop_test(tc, a_full_disk, 0, N_WRITING);
  tcase_add_test(tc, a_killed_run_leaves_nothing_for_long);
  tcase_add_test(tc, two_runs_at_one_folder);
  tcase_add_loop_test(tc, a_hardened_build, 0, 3);
  tcase_add_loop_test(tc, a_new_folder_goes_again, 0, N_WRITING + 3);
  tcase_add_test(tc, a_small_stack);
  tcase_add_loop_test(tc, a_signal_while_files_are_written, 0, N_ENDINGS);
  tcase_add_loop_test(tc, a_signal_between_two_renames, 0, N_ENDINGS);
  suite_add_tcase(s, tc);

  tc = tcase_create("memory");
  tcase_set_timeout(tc, 300);
  tcase_add_checked_fixture(tc, scratch_open, scratch_close);
  tcase_add_loop_test(tc, some_allocations_fail, 0, N_ALLOCATING);
  tcase_add_test(tc, little_memory);
  suite_add_tcase(s, tc);

  tc = tcase_create("memory, exhaustively");
  tcase_set_tags(tc, "long exhaustive");
  tcase_set_timeout(tc, 3600);
  tcase_add_checked_fixture(tc, scratch_open, scratch_close);
  tcase_add_loop_test(tc, all_allocations_fail, 0, N_ALLOCATING);
  suite_add_tcase(s, tc);
  return s;
}
