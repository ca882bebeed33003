/* Threads that take units from one queue and put rows into another. */
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "stickslip/arena.h"
#include "sweep.h"

struct item {
  slong unit;
  struct text rows;
};
struct pool {
  const struct sweep *q;
  pthread_mutex_t lock;
  pthread_cond_t given, done;
  slong to_do[POOL_ROOM];
  struct item ready[POOL_ROOM];
  int n_to_do, n_ready, jobs;
  bool over;
  pthread_t thread[MAX_JOBS];
};

/* Units are taken in the order in which they were given: rows are wanted in order. */
static slong next_unit(struct pool *p) {
  slong unit = p->to_do[0];
  memmove(p->to_do, p->to_do + 1, (size_t)--p->n_to_do * sizeof *p->to_do);
  return unit;
}

static void *work(void *arg) {
  struct pool *p = arg;
  pthread_mutex_lock(&p->lock);
  for (;;) {
    while (p->n_to_do == 0 && !p->over) pthread_cond_wait(&p->given, &p->lock);
    if (p->over) break;
    struct item item = {.unit = next_unit(p)};
    pthread_mutex_unlock(&p->lock);
    text_init(&item.rows);
    bool whole = sweep_rows(&item.rows, p->q, item.unit);
    pthread_mutex_lock(&p->lock);
    if (whole) {
      p->ready[p->n_ready++] = item;
      pthread_cond_signal(&p->done);
    } else {
      text_clear(&item.rows);
    }
  }
  pthread_mutex_unlock(&p->lock);
  flint_cleanup();
  mpfr_free_cache();
  return NULL;
}

/* Signals are for the first thread, whose waits they end. */
static int make_threads(struct pool *p, int jobs) {
  sigset_t all, before;
  int error = 0;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  while (p->jobs < jobs && !error) {
    error = pthread_create(&p->thread[p->jobs], NULL, work, p);
    p->jobs += !error;
  }
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  return p->jobs > 0 ? 0 : error;
}

struct pool *pool_open(const struct sweep *q, int jobs, struct diag *d) {
  struct pool *p = ss_malloc(sizeof *p);
  *p = (struct pool){.q = q};
  pthread_mutex_init(&p->lock, NULL);
  pthread_cond_init(&p->given, NULL);
  pthread_cond_init(&p->done, NULL);
  int error = make_threads(p, jobs);
  if (!error) return p;
  diag_set(d, "error: no thread could be made: %s", strerror(error));
  pool_close(p);
  return NULL;
}

void pool_close(struct pool *p) {
  pthread_mutex_lock(&p->lock);
  p->over = true;
  pthread_cond_broadcast(&p->given);
  pthread_mutex_unlock(&p->lock);
  for (int i = 0; i < p->jobs; i++) pthread_join(p->thread[i], NULL);
  for (int i = 0; i < p->n_ready; i++) text_clear(&p->ready[i].rows);
  pthread_cond_destroy(&p->given);
  pthread_cond_destroy(&p->done);
  pthread_mutex_destroy(&p->lock);
  free(p);
}

void pool_give(struct pool *p, slong unit) {
  pthread_mutex_lock(&p->lock);
  p->to_do[p->n_to_do++] = unit;
  pthread_cond_signal(&p->given);
  pthread_mutex_unlock(&p->lock);
}

static void later(struct timespec *t, int milliseconds) {
  clock_gettime(CLOCK_REALTIME, t);
  t->tv_nsec += milliseconds * 1000000L;
  t->tv_sec += t->tv_nsec / 1000000000L;
  t->tv_nsec %= 1000000000L;
}

bool pool_take(struct pool *p, slong *unit, struct text *rows, int wait) {
  struct timespec until;
  later(&until, wait);
  pthread_mutex_lock(&p->lock);
  while (p->n_ready == 0 && wait > 0)
    if (pthread_cond_timedwait(&p->done, &p->lock, &until) == ETIMEDOUT) break;
  bool any = p->n_ready > 0;
  if (any) {
    struct item *item = &p->ready[--p->n_ready];
    *unit = item->unit;
    text_reset(rows);
    struct text old = *rows;
    *rows = item->rows;
    text_clear(&old);
  }
  pthread_mutex_unlock(&p->lock);
  return any;
}
