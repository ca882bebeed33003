/* Forked processes, each with every jobs-th item, and one pipe each: results come back item by item, so that a process
   that ends early is seen at once, and one whose parent has gone dies of the broken pipe. */
#include "workers.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stickslip/arena.h"

struct message {
  size_t item;
  char result[WORKERS_ITEM_MAX];
};

struct worker {
  pid_t pid;  /* 0: none */
  int fd;     /* -1: its end was seen */
  size_t got; /* bytes of the message under way */
  struct message message;
  size_t done, share;
};

/* Never returns. */
static void be_worker(int fd, int which, size_t size, size_t n, int jobs, work_fn *work, void *arg) {
  struct message m;
  signal(SIGPIPE, SIG_DFL);
  ss_exhausted_quietly();
  for (size_t i = (size_t)which; i < n; i += (size_t)jobs) {
    memset(&m, 0, sizeof m);
    m.item = i;
    work(m.result, i, arg);
    if (!write_all(fd, (const char *)&m, offsetof(struct message, result) + size)) _exit(1);
  }
  _exit(0);
}

static bool start(struct worker *w, int which, size_t size, size_t n, int jobs, work_fn *work, void *arg) {
  int fd[2];
  if (pipe(fd) != 0) return false;
  fflush(NULL);
  pid_t pid = fork();
  if (pid < 0) {
    close(fd[0]);
    close(fd[1]);
    return false;
  }
  if (pid == 0) {
    for (int k = 0; k < which; k++) close(w[k - which].fd);
    close(fd[0]);
    be_worker(fd[1], which, size, n, jobs, work, arg);
  }
  close(fd[1]);
  *w = (struct worker){.pid = pid, .fd = fd[0]};
  w->share = ((size_t)jobs + n - 1 - (size_t)which) / (size_t)jobs;
  return true;
}

/* Takes in what a worker has written; false at the end of its pipe. */
static bool take(struct worker *w, char *results, size_t size) {
  size_t whole = offsetof(struct message, result) + size;
  ssize_t n = read(w->fd, (char *)&w->message + w->got, whole - w->got);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  if (n == 0) return false;
  w->got += (size_t)n;
  if (w->got < whole) return true;
  memcpy(results + w->message.item * size, w->message.result, size);
  w->got = 0;
  w->done++;
  return true;
}

static void collect(struct worker *w, int jobs, char *results, size_t size, size_t n,
                    void (*done)(size_t n, size_t of)) {
  for (int open = jobs; open > 0;) {
    struct pollfd p[WORKERS_MAX];
    size_t ready = 0;
    for (int k = 0; k < jobs; k++) p[k] = (struct pollfd){.fd = w[k].fd, .events = POLLIN};
    if (poll(p, (nfds_t)jobs, -1) < 0 && errno != EINTR) return;
    for (int k = 0; k < jobs; k++) {
      if (w[k].fd >= 0 && (p[k].revents & (POLLIN | POLLHUP | POLLERR)) && !take(&w[k], results, size)) {
        close(w[k].fd);
        w[k].fd = -1;
        open--;
        if (w[k].done < w[k].share) return; /* it ended early: there is no point in waiting for the others */
      }
      ready += w[k].done;
    }
    if (done) done(ready, n);
  }
}

bool workers_run(void *results, size_t size, size_t n, int jobs, work_fn *work, void *arg,
                 void (*done)(size_t n, size_t of), struct diag *d) {
  if (size > WORKERS_ITEM_MAX || jobs < 1 || jobs > WORKERS_MAX) abort();
  struct worker w[WORKERS_MAX];
  bool ok = true, all = true, exhausted = false;
  int made = 0;
  while (ok && made < jobs) {
    ok = start(&w[made], made, size, n, jobs, work, arg);
    if (!ok) diag_set(d, "error: no process could be made: %s", strerror(errno));
    made += ok;
  }
  if (ok) collect(w, jobs, results, size, n, done);
  for (int k = 0; k < made; k++) {
    bool complete = w[k].done == w[k].share, ended = w[k].fd < 0;
    if (!complete || !ok) kill(w[k].pid, SIGKILL);
    if (!ended) close(w[k].fd);
    int how = 0;
    while (waitpid(w[k].pid, &how, 0) < 0 && errno == EINTR) continue;
    exhausted = exhausted || (WIFEXITED(how) && WEXITSTATUS(how) == EXIT_EXHAUSTED);
    if (!complete && ended)
      diag_set(d, "error: a worker process ended after %zu of its %zu items", w[k].done, w[k].share);
    all = all && complete;
  }
  if (exhausted) ss_out_of_memory();
  if (ok && !all) diag_set(d, "error: the worker processes could not be waited for");
  return ok && all;
}
