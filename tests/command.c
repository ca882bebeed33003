#include "command.h"

#include <check.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/text.h"
#include "local.h"
#include "scratch.h"
#include "table.h"

static void redirect(const char *path, int to) {
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || dup2(fd, to) < 0) _exit(126);
  close(fd);
}

static void redirect_to_nobody(void) {
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

/* Root keeps to the permissions of files, as others do, once it runs a program. */
static void keep_to_permissions(void) {
  if (geteuid() != 0) return;
  if (prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) != 0 || prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH) != 0) _exit(126);
}

/* In the child. */
static void go_to(const struct job_place *p, const char *out, const char *err) {
  process_as_from_a_shell();
  if (p->group) setpgid(0, 0);
  redirect(err, STDERR_FILENO);
  if (strcmp(out, "closed") == 0)
    close(STDOUT_FILENO);
  else if (strcmp(out, "pipe") == 0)
    redirect_to_nobody();
  else
    redirect(out, STDOUT_FILENO);
  for (int i = 0; i < 3 && p->env[i]; i++) set_in_environment(p->env[i]);
  if (p->permissions) keep_to_permissions();
  if (p->memory && !SANITIZED) setrlimit(RLIMIT_AS, &(struct rlimit){p->memory, p->memory});
  if (p->file) {
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){p->file, p->file});
    count_nothing();
  }
}

void job_start(struct job *j, const struct job_place *place, const char *file, const char *const *args) {
  static const struct job_place here = {.out = NULL};
  static int serial;
  char name[32];
  if (!place) place = &here;
  *j = (struct job){.status = -1000, .short_of_memory = place->memory > 0, .seconds = children_seconds()};
  snprintf(name, sizeof name, "job%d.out", ++serial);
  if (!place->out) j->out_path = scratch_path(name);
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
  if (j->pid > 0 && place->group) setpgid(j->pid, j->pid); /* whichever of the two is the first */
  if (j->pid == 0) {
    go_to(place, place->out ? place->out : j->out_path, j->err_path);
    alarm(TIME_LIMIT);
    execv(file, argv);
    _exit(127);
  }
}

void job_start_words(struct job *j, const struct job_place *place, const char *words) {
  const char *args[MAX_ARGS + 1] = {NULL};
  FREED char *all = ss_strdup(words);
  int n = 0;
  for (char *p = strtok(all, " "); p && n < MAX_ARGS; p = strtok(NULL, " ")) args[n++] = p;
  job_start(j, place, program(), args);
}

/* What it has printed; the file goes. */
static char *printed(size_t *size, const char *path) {
  struct stat st;
  ck_assert(stat(path, &st) == 0);
  *size = (size_t)st.st_size;
  char *text = file_text(path);
  unlink(path);
  return text;
}

void job_finish(struct job *j) {
  j->status = process_end(j->pid);
  j->seconds = children_seconds() - j->seconds;
  ck_assert_msg((j->status != 127 || j->short_of_memory) && j->status != 126, "cannot start %s", program());
  if (j->out_path) j->out = printed(&j->out_size, j->out_path);
  j->err = printed(&j->err_size, j->err_path);
}

void job_clear(struct job *j) {
  free(j->out);
  free(j->err);
  *j = (struct job){.status = -1000};
}

void job_take(struct job *j, struct job next) {
  job_clear(j);
  *j = next;
}

struct job job_quick(const struct job_place *place, const char *file, const char *const *args) {
  struct job j = {.out = NULL};
  for (int i = 0; i < 3 && (i == 0 || j.seconds >= MOST_SECONDS); i++) {
    job_clear(&j);
    job_start(&j, place, file, args);
    job_finish(&j);
  }
  return j;
}

void job_refused(const struct job *j, int status, const char *what) {
  enum { MOST_MESSAGE = 1000 + 40 }; /* behind the name of the program */
  size_t lines = 0, controls = 0;
  for (const char *p = j->err; *p; p++) {
    lines += *p == '\n';
    controls += ((unsigned char)*p < ' ' && *p != '\n') || *p == 0x7F;
  }
  ck_assert_msg(j->status == status, "%s: status %d, not %d: %.1500s", what, j->status, status, j->err);
  ck_assert_msg(j->out_size == 0, "%s: printed %.200s", what, j->out);
  ck_assert_msg(j->err_size > 10 && j->err_size <= MOST_MESSAGE && j->err[j->err_size - 1] == '\n',
                "%s: a message of %zu bytes: %.1500s", what, j->err_size, j->err);
  ck_assert_msg((lines == 1 || (lines == 3 && strstr(j->err, "^\n"))) && controls == 0 &&
                    text_valid_prefix(j->err, j->err_size) == j->err_size,
                "%s: not one message: %.1500s", what, j->err);
  check_caret(j->err, what);
  ck_assert_msg(j->seconds < MOST_SECONDS, "%s: takes %.2f s", what, j->seconds);
}

const char *member(const char *from, const char *key) {
  static char value[8][MOST_VALUE];
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
