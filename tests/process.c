#include "process.h"

#include <check.h>
#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/arena.h"

void process_as_from_a_shell(void) {
  static const int number[] = {SIGHUP, SIGINT, SIGTERM, SIGALRM, SIGPIPE, SIGXFSZ};
  for (size_t i = 0; i < COUNT(number); i++) signal(number[i], SIG_DFL);
}

int process_end(pid_t pid) {
  int status = 0;
  pid_t got;
  do got = waitpid(pid, &status, 0);
  while (got < 0 && errno == EINTR);
  ck_assert_int_eq(got, pid);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

double children_seconds(void) {
  struct rusage u;
  getrusage(RUSAGE_CHILDREN, &u);
  return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

bool process_until(bool (*is_so)(pid_t pid), pid_t pid) {
  enum { LIMIT = 90, PAUSE = 5000000 };
  for (time_t begin = time(NULL); !is_so(pid); nanosleep(&(struct timespec){.tv_nsec = PAUSE}, NULL))
    if (time(NULL) - begin > LIMIT) return false;
  return true;
}

/* The start of a file of a process; false when there is no such process. */
static bool show(char *text, size_t size, const char *pid, const char *file) {
  char path[300];
  snprintf(path, sizeof path, "/proc/%s/%s", pid, file);
  FILE *f = fopen(path, "r");
  if (!f) return false;
  size_t n = fread(text, 1, size - 1, f);
  text[n] = '\0';
  fclose(f);
  return n > 0;
}

struct members {
  int n;
  unsigned long ticks;
};

/* proc(5): behind the name in brackets, which may hold anything, are the state, the parent, the group; and, eight
   fields on, the times in user and in system mode. */
static void count_if_member(struct members *m, const char *pid, pid_t group) {
  char text[1024], state;
  int its;
  unsigned long user, system;
  const char *end = show(text, sizeof text, pid, "stat") ? strrchr(text, ')') : NULL;
  if (!end || sscanf(end + 1, " %c %*d %d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &state, &its, &user, &system) != 4)
    return;
  if (its != group || state == 'Z' || state == 'X') return;
  m->n++;
  m->ticks += user + system;
}

static struct members members_of(pid_t group) {
  struct members m = {0, 0};
  DIR *all = opendir("/proc");
  if (!all) abort();
  for (const struct dirent *e = readdir(all); e; e = readdir(all))
    if (strspn(e->d_name, "0123456789") == strlen(e->d_name)) count_if_member(&m, e->d_name, group);
  closedir(all);
  return m;
}

int group_lives(pid_t group) {
  return members_of(group).n;
}

double group_seconds(pid_t group) {
  return (double)members_of(group).ticks / (double)sysconf(_SC_CLK_TCK);
}

bool group_has_ended(pid_t group) {
  return group_lives(group) == 0;
}

/* Until it does so a child has the handlers of the tests, not its own. */
static bool runs_another_program(const char *pid) {
  char path[300], its[4096], ours[4096];
  snprintf(path, sizeof path, "/proc/%s/exe", pid);
  ssize_t n = readlink(path, its, sizeof its), m = readlink("/proc/self/exe", ours, sizeof ours);
  return n > 0 && (n != m || memcmp(its, ours, (size_t)n) != 0);
}

bool process_catches(pid_t pid, int number) {
  char name[20], text[4096];
  snprintf(name, sizeof name, "%d", (int)pid);
  if (!runs_another_program(name)) return false;
  const char *caught = show(text, sizeof text, name, "status") ? strstr(text, "\nSigCgt:") : NULL;
  return caught && (strtoull(caught + strlen("\nSigCgt:"), NULL, 16) >> (number - 1) & 1);
}

bool process_waits_for_a_lock(pid_t pid) {
  char line[300];
  bool waits = false;
  FILE *f = fopen("/proc/locks", "r");
  while (f && fgets(line, sizeof line, f)) {
    int its;
    waits = waits || (sscanf(line, "%*d: -> FLOCK ADVISORY WRITE %d", &its) == 1 && its == pid);
  }
  if (f) fclose(f);
  return waits;
}
