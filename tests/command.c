#include "command.h"

#include <check.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "process.h"
#include "scratch.h"

static void redirect(const char *path, int to) {
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || dup2(fd, to) < 0) _exit(126);
  close(fd);
}

rlim_t largest_file;

static void limit_files(void) {
  struct rlimit limit = {largest_file, largest_file};
  if (!largest_file) return;
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  count_nothing();
}

void job_start(struct job *j, const char *stdout_to, const char *file, const char *const *args) {
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

void job_finish(struct job *j) {
  j->status = process_end(j->pid);
  ck_assert_msg(j->status != 127 && j->status != 126, "cannot start %s", program());
  j->out = strncmp(j->out_path, "/dev/", 5) == 0 ? NULL : file_text(j->out_path);
  j->err = file_text(j->err_path);
}

void job_clear(struct job *j) {
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

static void run(struct job *j, const char **args, const char *first, va_list ap) {
  collect(args, first, ap);
  job_start(j, NULL, program(), args);
  job_finish(j);
}

void job_run(struct job *j, const char *first, ...) {
  const char *args[MAX_ARGS + 1];
  va_list ap;
  va_start(ap, first);
  run(j, args, first, ap);
  va_end(ap);
}

void job_run_well(struct job *j, const char *first, ...) {
  const char *args[MAX_ARGS + 1];
  va_list ap;
  va_start(ap, first);
  run(j, args, first, ap);
  va_end(ap);
  ck_assert_msg(j->status == 0 && !*j->err, "%s %s...: status %d, %.1500s", first, args[1] ? args[1] : "", j->status,
                j->err);
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

const char *list_member(const char *from, const char *key) {
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
