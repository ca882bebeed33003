/* The parent maps the pages, forks, and takes tasks itself from the same shared counter; nobody waits for an answer, so that
   nothing can fill up or block.  It kills what is left when it is told to go
   (audit_abandon), and when its memory is exhausted. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "tasks.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "stickslip/work.h"

#include "stickslip/audit.h"

/* A process has ROOM bytes for what its tasks say, of which only those written to take memory; a whole audit of the paper
   says a few million. */
enum { MOST_PROCESSES = 64, ROOM = 32 << 20, EXIT_INTERNAL = 5, TELL_EVERY = 100000000 };

/* In shared pages. */
struct board {
  atomic_size_t next; /* place in the order */
  struct task_result result[];
};

struct crew {
  const struct tasks *t;
  struct board *board;
  size_t board_size;
  const size_t *order;
  unsigned char *room; /* NULL: the parent is alone */
  pid_t parent;
  bool exhausted; /* the memory of some process */
};

static volatile pid_t alive[MOST_PROCESSES]; /* 0: none */

void audit_abandon(void) {
  for (int k = 0; k < MOST_PROCESSES; k++)
    if (alive[k] > 0) kill(alive[k], SIGKILL);
  for (int k = 0; k < MOST_PROCESSES; k++)
    if (alive[k] > 0) waitpid(alive[k], NULL, 0);
}

/* --- One task --- */

static void *pack(struct arena *a, void *list, size_t n, size_t size) {
  void *kept = n ? memcpy(arena_alloc(a, n * size), list, n * size) : NULL;
  free(list);
  return kept;
}

#define PACK(r, list) (r)->list = pack(&(r)->arena, (r)->list, (r)->n_##list, sizeof *(r)->list)

static void pack_result(struct audit_result *r) {
  PACK(r, findings);
  PACK(r, consequences);
  PACK(r, skipped);
  PACK(r, controls);
  PACK(r, pairs);
  PACK(r, long_runs);
  PACK(r, values);
  PACK(r, tables);
}

#define APPEND(out, part, list)                                                                                        \
  for (size_t i = 0; i < (part)->n_##list; i++) {                                                                      \
    (out)->list = ss_grow((out)->list, (out)->n_##list, &(out)->cap_##list, sizeof *(out)->list);                      \
    (out)->list[(out)->n_##list++] = (part)->list[i];                                                                  \
  }

void result_append(struct audit_result *out, const struct audit_result *part) {
  APPEND(out, part, findings)
  APPEND(out, part, consequences)
  APPEND(out, part, skipped)
  APPEND(out, part, controls)
  APPEND(out, part, pairs)
  APPEND(out, part, long_runs)
  APPEND(out, part, values)
  APPEND(out, part, tables)
  if (part->readings) out->readings = part->readings;
}

static struct task_result *current; /* of a process with one task */

static void out_of_budget(void) {
  current->units = work_units();
  current->touched = work_touched();
  current->end = TASK_EXHAUSTED;
  _exit(0);
}

/* Leaves the task open when its arena outgrew the room. */
static void do_task(struct crew *c, size_t i, struct arena *arena) {
  struct task_result *slot = &c->board->result[i];
  struct audit_result part = {.arena = *arena};
  struct arena_block *room = c->room && arena->head ? arena->head : NULL;
  struct diag d;
  diag_init(&d);
  current = slot;
  work_begin(c->t->budget, out_of_budget);
  double start = c->t->seconds_now ? c->t->seconds_now() : 0;
  bool ok = c->t->run(&part, i, c->t->arg, &d);
  pack_result(&part);
  const char *error = ok ? NULL : result_str(&part, "%s", d.message);
  *arena = part.arena;
  if (room && getpid() != c->parent && arena->head != room) return;
  slot->part = part;
  slot->part.arena.head = NULL;
  slot->error = error;
  slot->touched = work_touched();
  slot->raises = work_raises();
  slot->units = work_units();
  slot->seconds = c->t->seconds_now ? c->t->seconds_now() - start : 0;
  slot->end = ok ? TASK_DONE : TASK_FAILED;
}

/* --- Processes --- */

static void end_quietly(int number) {
  (void)number;
  _exit(EXIT_FAILURE);
}

/* Signals end it, but for those that the parent ignores; what goes wrong here goes wrong again in the parent, or is all right
   there, and it is the parent that says so. */
static void leave_it_to_the_parent(void) {
  struct sigaction now;
  sigset_t all;
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (sigaction(ending_signals[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) signal(ending_signals[i], SIG_DFL);
  signal(SIGABRT, end_quietly);
  ss_exhausted_quietly();
  sigfillset(&all);
  sigprocmask(SIG_UNBLOCK, &all, NULL);
}

/* Never returns.  One task, or as many as there are. */
static void be_worker(struct crew *c, int which, size_t only) {
  struct arena arena;
  leave_it_to_the_parent();
  arena_resume(&arena, c->room + (size_t)which * ROOM);
  const struct arena_block *room = arena.head;
  if (only < c->t->n) {
    do_task(c, only, &arena);
    _exit(0);
  }
  for (size_t k = atomic_fetch_add(&c->board->next, 1); k < c->t->n; k = atomic_fetch_add(&c->board->next, 1)) {
    if (getppid() != c->parent) _exit(1);
    do_task(c, c->order[k], &arena);
    if (arena.head != room) _exit(1);
  }
  _exit(0);
}

/* Signals wait until the process is known to whoever would have to end it. */
static bool start(struct crew *c, int which, size_t only) {
  sigset_t all, before;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, &before);
  pid_t pid = fork();
  if (pid == 0) be_worker(c, which, only);
  if (pid > 0) alive[which] = pid;
  sigprocmask(SIG_SETMASK, &before, NULL);
  return pid > 0;
}

static void tell(const struct crew *c) {
  double all = 0, share = 0;
  size_t done = 0;
  if (!c->t->tell) return;
  for (size_t i = 0; i < c->t->n; i++) {
    bool ended = c->board->result[i].end != TASK_OPEN;
    all += c->t->cost[i];
    share += ended ? c->t->cost[i] : 0;
    done += ended;
  }
  c->t->tell(c->t->teller, done, all > 0 ? share / all : 0);
}

/* The number of a process that has ended, -1 when there is none left. */
static int wait_for_one(struct crew *c) {
  for (bool any = true; any;) {
    any = false;
    for (int k = 0; k < MOST_PROCESSES; k++) {
      if (alive[k] <= 0) continue;
      any = true;
      int how = 0;
      pid_t ended = waitpid(alive[k], &how, WNOHANG);
      if (ended > 0 && WIFEXITED(how) && WEXITSTATUS(how) == EXIT_EXHAUSTED) c->exhausted = true;
      if (ended == alive[k] || (ended < 0 && errno == ECHILD)) {
        alive[k] = 0;
        return k;
      }
    }
    tell(c);
    struct timespec pause = {0, c->t->tell ? TELL_EVERY : TELL_EVERY / 100};
    if (any) nanosleep(&pause, NULL);
  }
  return -1;
}

/* The parent works too. */
static void do_shared(struct crew *c, struct arena *own, int jobs) {
  for (int k = 1; k < jobs; k++)
    if (!start(c, k, c->t->n)) break;
  for (size_t k = atomic_fetch_add(&c->board->next, 1); k < c->t->n; k = atomic_fetch_add(&c->board->next, 1)) {
    tell(c);
    do_task(c, c->order[k], own);
    if (!c->room && c->board->result[c->order[k]].end == TASK_FAILED) return; /* alone, in order: it is the first */
  }
  while (wait_for_one(c) >= 0) continue;
  for (size_t i = 0; i < c->t->n; i++)
    if (c->board->result[i].end == TASK_OPEN) do_task(c, i, own);
}

static void give_up(const char *why) {
  audit_abandon();
  fprintf(stderr, "stickslip: error: %s\n", why);
  exit(EXIT_INTERNAL);
}

/* A process for each task. */
static void do_apart(struct crew *c, int jobs) {
  size_t k = 0;
  for (int which = 0; which < jobs && k < c->t->n; which++, k++)
    if (!start(c, which, c->order[k])) give_up("no process could be made");
  for (int which = wait_for_one(c); which >= 0; which = wait_for_one(c))
    if (k < c->t->n && !start(c, which, c->order[k++])) give_up("no process could be made");
  if (c->exhausted) ss_out_of_memory();
  for (size_t i = 0; i < c->t->n; i++)
    if (c->board->result[i].end == TASK_OPEN) give_up("a process ended before its task was done");
}

static void *map(size_t size) {
  void *p = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return p == MAP_FAILED ? NULL : p;
}

struct expected {
  size_t i;
  double cost;
};

static int longest_first(const void *a, const void *b) {
  const struct expected *x = a, *y = b;
  if (x->cost != y->cost) return x->cost > y->cost ? -1 : 1;
  return x->i < y->i ? -1 : x->i > y->i;
}

/* A process more for every 30 ms of work expected: what is done sooner than one is made stays here. */
static int worth(const struct tasks *t) {
  double all = 0;
  for (size_t i = 0; i < t->n; i++) all += t->cost[i];
  size_t most = t->n < MOST_PROCESSES ? t->n : MOST_PROCESSES;
  if (t->jobs < (int)most) most = t->jobs > 1 ? (size_t)t->jobs : 1;
  if (!t->budget && all / 30 + 1 < (double)most) most = (size_t)(all / 30) + 1;
  return most > 0 ? (int)most : 1;
}

static const size_t *put_in_order(const struct tasks *t, bool alone) {
  struct expected *e = ss_malloc(t->n * sizeof *e);
  size_t *order = ss_malloc(t->n * sizeof *order);
  for (size_t i = 0; i < t->n; i++) e[i] = (struct expected){i, t->cost[i]};
  if (t->n && !alone) qsort(e, t->n, sizeof *e, longest_first);
  for (size_t i = 0; i < t->n; i++) order[i] = e[i].i;
  free(e);
  return order;
}

struct task_result *tasks_run(struct audit_result *out, const struct tasks *t) {
  int jobs = worth(t);
  bool alone = jobs == 1 && !t->budget;
  struct crew c = {.t = t, .board_size = sizeof(struct board) + t->n * sizeof(struct task_result), .parent = getpid()};
  c.board = alone ? NULL : map(c.board_size);
  if (c.board) c.room = map((size_t)jobs * ROOM);
  if (t->budget && !c.room) give_up("no memory for the processes that a budget asks for");
  if (c.board && !c.room) {
    munmap(c.board, c.board_size);
    c.board = NULL;
  }
  bool shared = c.board != NULL;
  if (!shared) {
    c.board = ss_malloc(c.board_size);
    memset(c.board, 0, c.board_size);
    jobs = 1;
  }
  for (int k = 0; shared && k < jobs; k++) arena_in(c.room + (size_t)k * ROOM, ROOM);
  if (shared) result_keep_pages(out, c.room, (size_t)jobs * ROOM);
  c.order = put_in_order(t, !shared);
  ss_exhausted_calls(audit_abandon);
  fflush(NULL);
  if (t->budget)
    do_apart(&c, jobs);
  else
    do_shared(&c, &out->arena, jobs);
  struct task_result *results = ss_malloc(t->n * sizeof *results);
  if (t->n) memcpy(results, c.board->result, t->n * sizeof *results);
  free((void *)(uintptr_t)c.order);
  if (shared)
    munmap(c.board, c.board_size);
  else
    free(c.board);
  return results;
}
