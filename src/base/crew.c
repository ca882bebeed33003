/* One pipe brings items to all processes: a read takes one whole item, and the end of the pipe, which comes when the
   parent closes it or is gone, is the end of the work.  Each process has a pipe back, so that its end is seen at once;
   it dies of the broken one when its parent has gone.  The parent never waits to write. */
#include "crew.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "arena.h"

enum { AT_A_TIME = 1 << 16 };

struct heading {
  size_t item, len; /* and as many bytes come after it */
};

struct member {
  int fd; /* what it says; -1: its end was seen */
  struct heading heading;
  size_t got; /* of the message under way, heading and all */
  struct text bytes;
};

struct crew {
  crew_work *work;
  void *arg;
  bool one_each, complete;
  int queue[2];    /* where the parent takes out and puts in; -1: closed */
  size_t *waiting; /* items that did not go into the pipe yet: from `first` to n_waiting */
  size_t first, n_waiting, cap_waiting, given, started;
  int n;
  struct member member[CREW_MOST];
};

static volatile pid_t alive[CREW_MOST]; /* 0: none */

void crew_abandon(void) {
  for (int k = 0; k < CREW_MOST; k++)
    if (alive[k] > 0) kill(alive[k], SIGKILL);
  for (int k = 0; k < CREW_MOST; k++) {
    while (alive[k] > 0 && waitpid(alive[k], NULL, 0) < 0 && errno == EINTR) continue;
    alive[k] = 0;
  }
}

/* --- A process --- */

static void end_quietly(int number) {
  (void)number;
  _exit(EXIT_FAILURE);
}

/* What goes wrong here is the parent's to say, who may do better. */
static void leave_it_to_the_parent(void) {
  struct sigaction now;
  sigset_t all;
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (sigaction(ending_signals[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) signal(ending_signals[i], SIG_DFL);
  signal(SIGABRT, end_quietly);
  signal(SIGPIPE, SIG_DFL);
  ss_exhausted_quietly();
  sigfillset(&all);
  sigprocmask(SIG_UNBLOCK, &all, NULL);
}

static void close_end(int *fd) {
  if (*fd >= 0) close(*fd);
  *fd = -1;
}

static bool read_item(const struct crew *c, size_t *item) {
  ssize_t n;
  while ((n = read(c->queue[0], item, sizeof *item)) < 0 && errno == EINTR) continue;
  return n == (ssize_t)sizeof *item;
}

static _Noreturn void be_member(struct crew *c, int place, int back) {
  struct heading h = {0, 0};
  struct text message = {0};
  leave_it_to_the_parent();
  close_end(&c->queue[1]);
  for (int k = 0; k < c->n; k++) close_end(&c->member[k].fd);
  while (read_item(c, &h.item)) {
    text_reset(&message);
    text_add_n(&message, (const char *)&h, sizeof h);
    if (!c->work(&message, h.item, place, c->arg)) _exit(EXIT_FAILURE);
    h.len = message.len - sizeof h;
    memcpy(message.data, &h, sizeof h);
    if (!write_all(back, message.data, message.len)) _exit(EXIT_FAILURE);
    if (c->one_each) break;
  }
  _exit(EXIT_SUCCESS);
}

/* Signals wait until the process is known to whoever would have to end it. */
static bool start(struct crew *c, int place) {
  int back[2];
  sigset_t all, before;
  if (pipe(back) != 0) return false;
  fflush(NULL);
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, &before);
  pid_t pid = fork();
  if (pid == 0) {
    close(back[0]);
    be_member(c, place, back[1]);
  }
  if (pid > 0) alive[place] = pid;
  sigprocmask(SIG_SETMASK, &before, NULL);
  close(back[1]);
  if (pid < 0) close(back[0]);
  if (pid < 0) return false;
  c->member[place].fd = back[0];
  c->started++;
  return true;
}

/* --- The queue --- */

/* As much as goes into the pipe. */
static void hand_out(struct crew *c) {
  while (c->first < c->n_waiting && write(c->queue[1], &c->waiting[c->first], sizeof *c->waiting) > 0) c->first++;
  if (c->first < c->n_waiting) return;
  c->first = c->n_waiting = 0;
  if (c->complete) close_end(&c->queue[1]);
}

void crew_give(struct crew *c, size_t item) {
  *SS_PUSH(c->waiting, c->n_waiting, c->cap_waiting) = item;
  c->given++;
  hand_out(c);
}

void crew_complete(struct crew *c) {
  c->complete = true;
  hand_out(c);
}

/* While items wait for the pipe it is as good as full; after that it is closed, so that a read does not wait. */
bool crew_next(struct crew *c, size_t *item) {
  hand_out(c);
  if (c->first == c->n_waiting) return read_item(c, item);
  *item = c->waiting[c->first++];
  return true;
}

/* --- What comes back --- */

static bool is_whole(const struct member *m) {
  return m->got >= sizeof m->heading && m->got == sizeof m->heading + m->heading.len;
}

/* Takes in what has come; false at its end. */
static bool receive(struct member *m) {
  char bytes[AT_A_TIME];
  bool heading = m->got < sizeof m->heading;
  size_t want = sizeof m->heading + (heading ? 0 : m->heading.len) - m->got;
  ssize_t n = read(m->fd, heading ? (char *)&m->heading + m->got : bytes, want < AT_A_TIME ? want : AT_A_TIME);
  if (n < 0) return errno == EINTR;
  if (n == 0) return false;
  if (!heading) text_add_n(&m->bytes, bytes, (size_t)n);
  m->got += (size_t)n;
  return true;
}

static void deliver(struct member *m, size_t *item, struct text *bytes) {
  struct text old = *bytes;
  *item = m->heading.item;
  *bytes = m->bytes;
  m->bytes = old;
  text_reset(&m->bytes);
  m->got = 0;
}

/* Whoever has done his one item is followed by another while there are more; if none can be made, less is done. */
static enum crew_news part_with(struct crew *c, int place) {
  struct member *m = &c->member[place];
  int how = 0;
  close_end(&m->fd);
  while (waitpid(alive[place], &how, 0) < 0 && errno == EINTR) continue;
  alive[place] = 0;
  if (WIFEXITED(how) && WEXITSTATUS(how) == EXIT_EXHAUSTED) return CREW_EXHAUSTED;
  if (!WIFEXITED(how) || WEXITSTATUS(how) != EXIT_SUCCESS || m->got > 0) return CREW_LOST;
  if (c->one_each && c->started < c->given) start(c, place);
  return CREW_NOTHING;
}

enum crew_news crew_take(struct crew *c, size_t *item, struct text *bytes, int wait) {
  struct pollfd p[CREW_MOST + 1];
  for (;;) {
    bool any = false;
    hand_out(c);
    for (int k = 0; k < c->n; k++) {
      p[k] = (struct pollfd){.fd = c->member[k].fd, .events = POLLIN};
      any = any || p[k].fd >= 0;
    }
    p[c->n] = (struct pollfd){.fd = c->first < c->n_waiting ? c->queue[1] : -1, .events = POLLOUT};
    if (!any) return CREW_OVER;
    int ready = poll(p, (nfds_t)c->n + 1, wait);
    if (ready < 0 && errno != EINTR && errno != EAGAIN) ss_out_of_memory();
    if (ready <= 0) return CREW_NOTHING;
    for (int k = 0; k < c->n; k++) {
      struct member *m = &c->member[k];
      if (!p[k].revents) continue;
      enum crew_news news = receive(m) ? CREW_NOTHING : part_with(c, k);
      if (news != CREW_NOTHING) return news;
      if (!is_whole(m)) continue;
      deliver(m, item, bytes);
      return CREW_ITEM;
    }
  }
}

/* --- The crew --- */

struct crew *crew_open(crew_work *work, void *arg, int jobs, bool one_each, struct diag *d) {
  struct crew *c = ss_malloc(sizeof *c);
  if (jobs < 1 || jobs > CREW_MOST) abort();
  *c = (struct crew){.work = work, .arg = arg, .one_each = one_each, .queue = {-1, -1}};
  for (int k = 0; k < CREW_MOST; k++) c->member[k].fd = -1;
  ss_exhausted_calls(crew_abandon);
  if (pipe(c->queue) == 0 && fcntl(c->queue[1], F_SETFL, O_NONBLOCK) == 0)
    while (c->n < jobs && start(c, c->n)) c->n++;
  if (c->n > 0) return c;
  diag_set(d, "error: no process could be made: %s", strerror(errno));
  crew_close(c);
  return NULL;
}

void crew_close(struct crew *c) {
  crew_abandon();
  for (int k = 0; k < c->n; k++) {
    close_end(&c->member[k].fd);
    text_clear(&c->member[k].bytes);
  }
  for (int i = 0; i < 2; i++) close_end(&c->queue[i]);
  free(c->waiting);
  free(c);
}

/* --- Results of one size --- */

struct making {
  crew_make *make;
  void *arg, *result;
  size_t size;
};

static bool make_one(struct text *bytes, size_t item, int place, void *arg) {
  const struct making *m = arg;
  (void)place;
  memset(m->result, 0, m->size);
  m->make(m->result, item, m->arg);
  text_add_n(bytes, m->result, m->size);
  return true;
}

bool crew_results(void *results, size_t size, size_t n, int jobs, crew_make *make, void *arg, struct crew_tally *tally,
                  struct diag *d) {
  struct making m = {make, arg, ss_malloc(size), size};
  struct crew *c = crew_open(make_one, &m, jobs, false, d);
  enum crew_news news = c ? CREW_NOTHING : CREW_LOST;
  OWNED(text) bytes = {0};
  size_t ready = 0, item;
  for (size_t i = 0; c && i < n; i++) crew_give(c, i);
  if (c) crew_complete(c);
  while (news <= CREW_ITEM) {
    news = crew_take(c, &item, &bytes, -1);
    if (news != CREW_ITEM) continue;
    memcpy((char *)results + item * size, bytes.data, size);
    ready++;
    if (tally) tally->done++;
    if (tally && tally->tell) tally->tell(tally->done, tally->of);
  }
  if (c) crew_close(c);
  free(m.result);
  if (news == CREW_EXHAUSTED) ss_out_of_memory();
  diag_set(ready < n ? d : NULL, "error: a worker process ended before its time: %zu of %zu items are done", ready, n);
  return news == CREW_OVER && ready == n;
}
