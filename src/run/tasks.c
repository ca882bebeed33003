/* The parent maps the pages, has a crew made, and takes tasks itself from the same queue; what the crew leaves open is
   done by the parent in the end. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "tasks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "audit.h"
#include "base/arena.h"
#include "base/crew.h"

/* A process has ROOM bytes for what its tasks say, of which only those written to take memory; a whole audit of the
   paper says a few million. */
enum { ROOM = 32 << 20, EXIT_INTERNAL = 5, TELL_EVERY = 100 }; /* milliseconds */

struct team {
  const struct tasks *t;
  struct task_result *result; /* in shared pages, */
  unsigned char *room;        /* as is this, unless the parent is alone */
  struct arena arena;         /* of a process of the crew: its part of the room */
};

/* --- One task --- */

static void *pack(struct arena *a, void *list, size_t n, size_t size) {
  void *kept = n ? memcpy(arena_alloc(a, n * size), list, n * size) : NULL;
  free(list);
  return kept;
}

static void pack_result(struct audit_result *r) {
#define PACK(type, list) r->list = pack(&r->arena, r->list, r->n_##list, sizeof *r->list);
  RESULT_LISTS(PACK)
}

void result_append(struct audit_result *out, const struct audit_result *part) {
#define APPEND(type, list)                                                                                             \
  for (size_t i = 0; i < part->n_##list; i++) *SS_PUSH(out->list, out->n_##list, out->cap_##list) = part->list[i];
  RESULT_LISTS(APPEND)
  if (part->readings) out->readings = part->readings;
}

static struct task_result *current; /* of a process with one task */

static void out_of_budget(void) {
  current->units = work_units();
  current->touched = work_touched();
  current->end = TASK_EXHAUSTED;
  _exit(0);
}

/* false, with the task left open, when the arena outgrew the block that it must not; NULL: it may. */
static bool do_task(const struct team *c, size_t i, struct arena *arena, const struct arena_block *block) {
  struct task_result *slot = &c->result[i];
  struct audit_result part = {.arena = *arena};
  struct diag d = {0};
  current = slot;
  work_begin(c->t->budget, out_of_budget);
  double start = c->t->seconds_now ? c->t->seconds_now() : 0;
  bool ok = c->t->run(&part, i, c->t->arg, &d);
  pack_result(&part);
  const char *error = ok ? NULL : result_copy(&part, d.message);
  *arena = part.arena;
  if (block && arena->head != block) return false;
  slot->part = part;
  slot->part.arena.head = NULL;
  slot->error = error;
  slot->touched = work_touched();
  slot->raises = work_raises();
  slot->units = work_units();
  slot->seconds = c->t->seconds_now ? c->t->seconds_now() - start : 0;
  slot->end = ok ? TASK_DONE : TASK_FAILED;
  return true;
}

/* --- In which order --- */

struct expected {
  size_t i;
  double cost;
};

static int longest_first(const void *a, const void *b) {
  const struct expected *x = a, *y = b;
  if (x->cost != y->cost) return x->cost > y->cost ? -1 : 1;
  return x->i < y->i ? -1 : x->i > y->i;
}

static size_t *put_in_order(const struct tasks *t) {
  FREED struct expected *e = ss_malloc(t->n * sizeof *e);
  size_t *order = ss_malloc(t->n * sizeof *order);
  for (size_t i = 0; i < t->n; i++) e[i] = (struct expected){i, t->cost[i]};
  if (t->n) qsort(e, t->n, sizeof *e, longest_first);
  for (size_t i = 0; i < t->n; i++) order[i] = e[i].i;
  return order;
}

/* --- By whom --- */

/* It gives no bytes: all is in the shared pages. */
static bool do_in_crew(struct text *bytes, size_t i, int place, void *arg) {
  struct team *c = arg;
  (void)bytes;
  if (!c->arena.head) arena_resume(&c->arena, c->room + (size_t)place * ROOM);
  return do_task(c, i, &c->arena, c->arena.head);
}

static void tell(const struct team *c) {
  double all = 0, share = 0;
  size_t done = 0;
  if (!c->t->tell) return;
  for (size_t i = 0; i < c->t->n; i++) {
    bool ended = c->result[i].end != TASK_OPEN;
    all += c->t->cost[i];
    share += ended ? c->t->cost[i] : 0;
    done += ended;
  }
  c->t->tell(c->t->teller, done, all > 0 ? share / all : 0);
}

static void give_up(const char *why) {
  crew_abandon();
  fprintf(stderr, "stickslip: error: %s\n", why);
  exit(EXIT_INTERNAL);
}

static enum crew_news wait_for_news(const struct team *c, struct crew *crew) {
  size_t item;
  OWNED(text) none = {0};
  enum crew_news news = crew_take(crew, &item, &none, c->t->tell ? TELL_EVERY : -1);
  tell(c);
  return news;
}

/* The longest are begun first. */
static void give_all(struct crew *crew, const struct tasks *t) {
  FREED size_t *order = put_in_order(t);
  for (size_t k = 0; k < t->n; k++) crew_give(crew, order[k]);
  crew_complete(crew);
}

/* The parent works too; where there is no crew, in order. */
static void do_shared(struct team *c, struct arena *own, int jobs) {
  struct crew *crew = jobs > 1 ? crew_open(do_in_crew, c, jobs - 1, false, NULL) : NULL;
  if (crew) {
    give_all(crew, c->t);
    for (size_t i; crew_next(crew, &i); tell(c)) do_task(c, i, own, NULL);
    while (wait_for_news(c, crew) != CREW_OVER) continue;
    crew_close(crew);
  }
  for (size_t i = 0; i < c->t->n; i++) {
    if (c->result[i].end != TASK_OPEN) continue;
    tell(c);
    do_task(c, i, own, NULL);
    if (!crew && c->result[i].end == TASK_FAILED) return; /* it is the first */
  }
}

/* A process for each task. */
static void do_apart(struct team *c, int jobs) {
  struct crew *crew = crew_open(do_in_crew, c, jobs, true, NULL);
  if (!crew) give_up("no process could be made");
  give_all(crew, c->t);
  for (enum crew_news news = CREW_NOTHING; news != CREW_OVER; news = wait_for_news(c, crew))
    if (news == CREW_EXHAUSTED) ss_out_of_memory();
  crew_close(crew);
  for (size_t i = 0; i < c->t->n; i++)
    if (c->result[i].end == TASK_OPEN) give_up("a process ended before its task was done");
}

static void *map(size_t size) {
  void *p = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return p == MAP_FAILED ? NULL : p;
}

/* A process more for every 30 ms of work expected: what is done sooner than one is made stays here. */
static int worth(const struct tasks *t) {
  double all = 0;
  for (size_t i = 0; i < t->n; i++) all += t->cost[i];
  size_t most = t->n < CREW_MOST ? t->n : CREW_MOST;
  if (t->jobs < (int)most) most = t->jobs > 1 ? (size_t)t->jobs : 1;
  if (!t->budget && all / 30 + 1 < (double)most) most = (size_t)(all / 30) + 1;
  return most > 0 ? (int)most : 1;
}

/* Pages for the results and for what they say; without them the parent is alone. */
static bool share(struct team *c, size_t jobs) {
  c->result = map((c->t->n + 1) * sizeof *c->result);
  c->room = c->result ? map(jobs * ROOM) : NULL;
  if (c->result && !c->room) munmap(c->result, (c->t->n + 1) * sizeof *c->result);
  for (size_t k = 0; c->room && k < jobs; k++) arena_in(c->room + k * ROOM, ROOM);
  return c->room != NULL;
}

struct task_result *tasks_run(struct audit_result *out, const struct tasks *t) {
  int jobs = worth(t);
  size_t size = (t->n + 1) * sizeof(struct task_result);
  struct team c = {.t = t};
  struct task_result *results = ss_malloc(size);
  bool shared = (jobs > 1 || t->budget) && share(&c, (size_t)jobs);
  if (t->budget && !shared) give_up("no memory for the processes that a budget asks for");
  if (shared) result_keep_pages(out, c.room, (size_t)jobs * ROOM);
  if (!shared) c.result = memset(results, 0, size);
  if (t->budget)
    do_apart(&c, jobs);
  else
    do_shared(&c, &out->arena, shared ? jobs : 1);
  if (!shared) return results;
  memcpy(results, c.result, size);
  munmap(c.result, size);
  return results;
}
