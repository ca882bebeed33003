/* Everything here fails loudly: a test that cannot have its folder has not run. */
#include "scratch.h"

#include <check.h>
#include <dirent.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "local.h"
#include "process.h"

static struct arena arena; /* of the paths and texts handed out */
static char *folder;       /* NULL between tests */

static const char *keep(const struct text *t) {
  return arena_strndup(&arena, text_str(t), t->len);
}

static const char *join(const char *path, const char *name) {
  LOCAL(text, t);
  text_printf(&t, *name ? "%s/%s" : "%s%s", path, name);
  return keep(&t);
}

void scratch_open(void) {
  const char *tmp = getenv("TMPDIR");
  if (folder) scratch_close(); /* the last test failed, and Check left its fixture out */
  const char *pattern = join(tmp && *tmp ? tmp : "/tmp", "stickslip-test-XXXXXX");
  folder = arena_strndup(&arena, pattern, strlen(pattern));
  ck_assert_msg(mkdtemp(folder) && chmod(folder, 0755) == 0, "%s", folder);
}

/* The names in a folder but . and .., sorted; NULL when it is none. */
static const char **names_in(const char *path, size_t *n) {
  DIR *dir = opendir(path);
  const char **names = NULL;
  size_t cap = 0;
  *n = 0;
  if (!dir) return NULL;
  names = ss_grow(names, *n, &cap, sizeof *names);
  for (struct dirent *e = readdir(dir); e; e = readdir(dir)) {
    if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
    *SS_PUSH(names, *n, cap) = arena_strndup(&arena, e->d_name, strlen(e->d_name));
  }
  closedir(dir);
  if (*n) qsort(names, *n, sizeof *names, word_compare);
  return names;
}

static void remove_all(const char *path) {
  struct stat st;
  if (lstat(path, &st) != 0) return;
  if (!S_ISDIR(st.st_mode)) {
    unlink(path);
    return;
  }
  chmod(path, 0700);
  size_t n;
  const char **names = names_in(path, &n);
  for (size_t i = 0; i < n; i++) remove_all(join(path, names[i]));
  free(names);
  rmdir(path);
}

void scratch_close(void) {
  if (!folder) return; /* a fixture inside this one has closed it */
  remove_all(folder);
  folder = NULL;
  arena_clear(&arena);
}

const char *scratch_path(const char *name) {
  return join(folder, name);
}

const char *scratch_put_n(const char *name, const char *bytes, size_t len) {
  const char *path = scratch_path(name);
  FILE *f = fopen(path, "wb");
  ck_assert_msg(f && fwrite(bytes, 1, len, f) == len && fclose(f) == 0, "%s", path);
  return path;
}

struct source source_of(const char *name, const char *text) {
  struct source s;
  source_from_string(&s, name, text);
  return s;
}

const char *scratch_put(const char *name, const char *text) {
  return scratch_put_n(name, text, strlen(text));
}

static const char *vformatted(const char *fmt, va_list ap) {
  LOCAL(text, t);
  text_vprintf(&t, fmt, ap);
  return keep(&t);
}

const char *formatted(const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *text = vformatted(fmt, ap);
  va_end(ap);
  return text;
}

const char *scratch_print(const char *name, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *path = scratch_put(name, vformatted(fmt, ap));
  va_end(ap);
  return path;
}

const char *replaced(const char *text, const char *was, const char *now) {
  const char *at = strstr(text, was);
  ck_assert_msg(at != NULL, "%s is not in %.2000s", was, text);
  return formatted("%.*s%s%s", (int)(at - text), text, now, at + strlen(was));
}

const char *nested(const char *before, const char *middle, const char *after, size_t n) {
  LOCAL(text, t);
  for (size_t i = 0; i < n; i++) text_add(&t, before);
  text_add(&t, middle);
  for (size_t i = 0; i < n; i++) text_add(&t, after);
  return keep(&t);
}

const char *scratch_list(const char *path) {
  LOCAL(text, t);
  size_t n;
  const char **names = names_in(path, &n);
  for (size_t i = 0; i < n; i++) text_printf(&t, "%s%s", i ? " " : "", names[i]);
  free(names);
  return keep(&t);
}

int child_end(void (*f)(void)) {
  fflush(NULL);
  pid_t pid = fork();
  ck_assert(pid >= 0);
  if (pid == 0) {
    struct rlimit none = {0, 0};
    int null = open("/dev/null", O_WRONLY);
    setrlimit(RLIMIT_CORE, &none);
    dup2(null, STDERR_FILENO);
    f();
    _exit(0);
  }
  return process_end(pid);
}

void count_nothing(void) {
  setenv("GCOV_PREFIX", "/dev/null", 1);
}

const char *program(void) {
  const char *p = getenv("STICKSLIP");
  return p && *p ? p : "build/stickslip";
}

const char *python(void) {
  const char *p = getenv("PYTHON");
  return p && *p ? p : "/usr/bin/python3";
}

int split_tabs(char **field, int most, char *line) {
  int n = 0;
  line[strcspn(line, "\n")] = '\0';
  for (char *p = line; p && n < most; n++) {
    field[n] = p;
    p = strchr(p, '\t');
    if (p) *p++ = '\0';
  }
  return n;
}

/* All that is left to read. */
static char *rest_of(FILE *f) {
  struct text t = {0};
  char part[65536];
  for (size_t n = fread(part, 1, sizeof part, f); n > 0; n = fread(part, 1, sizeof part, f)) text_add_n(&t, part, n);
  text_add(&t, "");
  return t.data;
}

char *file_text(const char *path) {
  FILE *f = fopen(path, "rb");
  ck_assert_msg(f != NULL, "%s cannot be read", path);
  char *text = rest_of(f);
  fclose(f);
  return text;
}

bool scratch_has(const char *name) {
  return access(scratch_path(name), F_OK) == 0;
}

bool scratch_says(const char *name, const char *what) {
  FREED char *text = file_text(scratch_path(name));
  return strstr(text, what) != NULL;
}

void check_says(const char *name, const char *what) {
  FREED char *text = file_text(scratch_path(name));
  ck_assert_msg(strstr(text, what) != NULL, "no \"%s\" in %.2000s", what, text);
}

void check_is(const char *name, const char *want) {
  FREED char *text = file_text(scratch_path(name));
  ck_assert_str_eq(text, want);
}

/* The line with its arguments, until the next; what it may name is set. */
static const char *shell_line(const char *fmt, va_list ap) {
  static char line[20000];
  ck_assert_int_lt(vsnprintf(line, sizeof line, fmt, ap), (int)sizeof line);
  setenv("P", program(), 1);
  setenv("Y", python(), 1);
  setenv("D", folder ? folder : "/none", 1);
  fflush(NULL);
  return line;
}

static int ended(int s) {
  return WIFEXITED(s) ? WEXITSTATUS(s) : -1;
}

/* Fails the test where a line does not end with that status and print that text, on standard output or on either. */
static char *run_line(int want, const char *says, const char *line, bool both) {
  LOCAL(text, t);
  text_printf(&t, "%s%s", both ? "exec 2>&1\n" : "", line);
  FILE *f = popen(text_str(&t), "r");
  ck_assert(f != NULL);
  char *out = rest_of(f);
  int status = ended(pclose(f));
  /* Check breaks off at very long messages */
  ck_assert_msg(status == want && strstr(out, says), "status %d, not %d with \"%.300s\": %.800s\n%.2500s", status, want,
                says, line, out);
  return out;
}

int shell(const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *line = shell_line(fmt, ap);
  va_end(ap);
  return ended(system(line));
}

bool there_is(const char *command) {
  return shell("command -v %s > /dev/null", command) == 0;
}

void shell_ends(int status, const char *says, const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *line = shell_line(fmt, ap);
  va_end(ap);
  free(run_line(status, says, line, true));
}

char *shell_said(const char *fmt, ...) {
  va_list ap;
  va_start(ap, fmt);
  const char *line = shell_line(fmt, ap);
  va_end(ap);
  return run_line(0, "", line, false);
}

/* The column of "NAME:LINE:COLUMN: error: ", which begins the message; 0 where it begins otherwise. */
static long column_of(const char *message) {
  for (const char *p = strchr(message, ':'); p && p < message + strcspn(message, "\n"); p = strchr(p + 1, ':')) {
    long line, column;
    int used = 0;
    if (sscanf(p, ":%ld:%ld: error: %n", &line, &column, &used) == 2 && used) return column;
  }
  return 0;
}

void check_caret(const char *message, const char *what) {
  enum { WIDE = 50 }; /* a long line is clipped around the caret */
  long column = column_of(message), blanks = 0;
  const char *caret = strrchr(message, '^');
  ck_assert_msg((column > 0) == (caret != NULL), "%s: %s", what, message);
  if (!caret || column > WIDE) return;
  for (; caret[-1] == ' '; caret--) blanks++;
  ck_assert_msg(caret[-1] == '\n' && blanks == column + 1, "%s: no caret under column %ld: %s", what, column, message);
}
