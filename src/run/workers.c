/* Forked processes that take items from a shared counter, and one pipe each: results come back item by item, so that a process
   that ends early is seen at once, and one whose parent has gone dies of the broken pipe. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "workers.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stickslip/arena.h"

struct message {
  size_t item;
  char result[WORKERS_ITEM_MAX];
};

struct worker {
  pid_t pid;  /* 0: none, or its end was waited for */
  int fd;     /* -1: its end was seen */
  size_t got; /* bytes of the message under way */
  struct message message;
  size_t done;
  int how; /* it ended */
};

struct crew {
  size_t size, n; /* of a result, of items */
  work_fn *work;
  void *arg;
  atomic_size_t *next; /* item, in a shared page */
  struct worker worker[WORKERS_MAX];
  int n_workers;
};

/* Never returns. */
static void be_worker(const struct crew *c, int fd) {
  struct message m;
  signal(SIGPIPE, SIG_DFL);
  ss_exhausted_quietly();
  for (size_t i = atomic_fetch_add(c->next, 1); i < c->n; i = atomic_fetch_add(c->next, 1)) {
    memset(&m, 0, sizeof m);
    m.item = i;
    c->work(m.result, i, c->arg);
    if (!write_all(fd, (const char *)&m, offsetof(struct message, result) + c->size)) _exit(EXIT_FAILURE);
  }
  _exit(EXIT_SUCCESS);
}

static bool start(struct crew *c) {
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
    for (int k = 0; k < c->n_workers; k++) close(c->worker[k].fd);
    close(fd[0]);
    be_worker(c, fd[1]);
  }
  close(fd[1]);
  c->worker[c->n_workers++] = (struct worker){.pid = pid, .fd = fd[0]};
  return true;
}

static bool has_ended_well(const struct worker *w) {
  return WIFEXITED(w->how) && WEXITSTATUS(w->how) == EXIT_SUCCESS;
}

static void wait_for(struct worker *w) {
  while (waitpid(w->pid, &w->how, 0) < 0 && errno == EINTR) continue;
  w->pid = 0;
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

static size_t items_done(const struct crew *c) {
  size_t n = 0;
  for (int k = 0; k < c->n_workers; k++) n += c->worker[k].done;
  return n;
}

/* Until every worker has ended, or one of them not well: there is no point in waiting for the others then. */
static void collect(struct crew *c, char *results, void (*done)(size_t n, size_t of)) {
  for (int open = c->n_workers; open > 0;) {
    struct pollfd p[WORKERS_MAX];
    for (int k = 0; k < c->n_workers; k++) p[k] = (struct pollfd){.fd = c->worker[k].fd, .events = POLLIN};
    if (poll(p, (nfds_t)c->n_workers, -1) < 0 && errno != EINTR) return;
    for (int k = 0; k < c->n_workers; k++) {
      struct worker *w = &c->worker[k];
      if (w->fd < 0 || !(p[k].revents & (POLLIN | POLLHUP | POLLERR)) || take(w, results, c->size)) continue;
      close(w->fd);
      w->fd = -1;
      wait_for(w);
      open--;
      if (!has_ended_well(w)) return;
    }
    if (done) done(items_done(c), c->n);
  }
}

/* Ends what still works. */
static void dismiss(struct crew *c) {
  bool exhausted = false;
  for (int k = 0; k < c->n_workers; k++) {
    struct worker *w = &c->worker[k];
    if (w->pid) kill(w->pid, SIGKILL);
    if (w->pid) wait_for(w);
    if (w->fd >= 0) close(w->fd);
    exhausted = exhausted || (WIFEXITED(w->how) && WEXITSTATUS(w->how) == EXIT_EXHAUSTED);
  }
  if (exhausted) ss_out_of_memory();
}

bool workers_run(void *results, size_t size, size_t n, int jobs, work_fn *work, void *arg,
                 void (*done)(size_t n, size_t of), struct diag *d) {
  if (size > WORKERS_ITEM_MAX || jobs < 1 || jobs > WORKERS_MAX) abort();
  struct crew c = {.size = size, .n = n, .work = work, .arg = arg};
  c.next = mmap(NULL, sizeof *c.next, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  bool ok = c.next != MAP_FAILED;
  if (ok) atomic_init(c.next, 0);
  while (ok && c.n_workers < jobs) ok = start(&c);
  if (!ok) diag_set(d, "error: no process could be made: %s", strerror(errno));
  if (ok) collect(&c, results, done);
  dismiss(&c);
  if (c.next != MAP_FAILED) munmap(c.next, sizeof *c.next);
  size_t all = items_done(&c);
  if (ok && all < n) diag_set(d, "error: a worker process ended before its time: %zu of %zu items are done", all, n);
  return ok && all == n;
}
