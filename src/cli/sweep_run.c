/* Units are handed out in order, to a crew and to other ranks, and written in order whoever is done first.  So many
   may be ahead of the one that is waited for that nobody stands idle, and no more, nor more rows than HELD bytes, so
   that memory stays bounded. */
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/arena.h"
#include "sweep.h"

enum { AHEAD = 1024, HELD = 1 << 26, WAIT = 20 };

static volatile sig_atomic_t stopped;

bool sweep_stopped(void) {
  return stopped != 0;
}

static void on_signal(int number) {
  (void)number;
  stopped = 1;
}

void sweep_listen(bool on) {
  /* a second signal ends a run that waits for whoever reads its output */
  struct sigaction a = {.sa_handler = on ? on_signal : SIG_DFL, .sa_flags = SA_RESTART | (int)SA_RESETHAND};
  static const int ends[] = {SIGINT, SIGTERM};
  struct sigaction now;
  sigemptyset(&a.sa_mask);
  for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) /* what the caller had ignored stays so */
    if (sigaction(ends[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) sigaction(ends[i], &a, NULL);
}

/* Rows that wait for those before them: of unit u at u % AHEAD. */
struct waiting {
  bool there;
  struct text rows;
};
struct sweep_course {
  const struct sweep *q;
  struct sink *sink;
  struct crew *crew;
  int room;     /* units that the crew may have at a time */
  int busy;     /* that it has */
  slong *again; /* units that are to be handed out once more */
  size_t n_again, cap_again;
  slong next, written; /* units handed out, and units in the sink */
  struct waiting ring[AHEAD];
  size_t held; /* bytes in the ring */
  struct diag d;
  slong begun_at; /* units that were there before */
#ifdef STICKSLIP_MPI
  struct helpers *helpers;
#endif
};

/* --- Handing out, taking in. --- */

/* The next unit to be handed out; -1 when none is, for now. */
static slong next_unit(const struct sweep_course *r) {
  if (r->n_again > 0) return r->again[r->n_again - 1];
  if (r->held > HELD) return -1; /* the unit that is waited for is under way */
  return r->next < r->q->units && r->next < r->written + AHEAD ? r->next : -1;
}

static void advance(struct sweep_course *r) {
  if (r->n_again > 0)
    r->n_again--;
  else
    r->next++;
}

static void give(struct sweep_course *r) {
  for (slong unit; r->busy < r->room && (unit = next_unit(r)) >= 0; r->busy++) {
    crew_give(r->crew, (size_t)unit);
    advance(r);
  }
#ifdef STICKSLIP_MPI
  for (slong unit; (unit = next_unit(r)) >= 0 && helpers_give(r->helpers, unit);) advance(r);
#endif
}

static void put(struct sweep_course *r, slong unit, struct text *rows) {
  struct waiting *w = &r->ring[unit % AHEAD];
  if (unit < r->written || w->there) return; /* a rank that was taken for lost */
  w->there = true;
  r->held += rows->len;
  struct text old = w->rows;
  w->rows = *rows;
  *rows = old;
}

#ifdef STICKSLIP_MPI
static void take_from_ranks(struct sweep_course *r, struct text *rows) {
  slong unit;
  bool lost;
  while (helpers_take(r->helpers, &unit, &lost, rows)) {
    if (!lost) {
      put(r, unit, rows);
      continue;
    }
    *SS_PUSH(r->again, r->n_again, r->cap_again) = unit;
  }
}
#endif

/* What is done; false when a process ended before its time. */
static bool take(struct sweep_course *r, struct text *rows) {
  enum crew_news news;
  size_t unit;
  int wait = WAIT;
#ifdef STICKSLIP_MPI
  take_from_ranks(r, rows);
  if (helpers_waiting(r->helpers)) wait = 1;
#endif
  while ((news = crew_take(r->crew, &unit, rows, wait)) == CREW_ITEM) {
    r->busy--;
    put(r, (slong)unit, rows);
    wait = 0;
  }
  if (news == CREW_EXHAUSTED) ss_out_of_memory();
  return news == CREW_NOTHING;
}

static bool write_ready(struct sweep_course *r) {
  for (struct waiting *w; (w = &r->ring[r->written % AHEAD])->there; r->written++) {
    if (!sink_write(r->sink, &w->rows, &r->d)) return false;
    w->there = false;
    r->held -= w->rows.len;
    text_clear(&w->rows);
  }
  return true;
}

static int say_interrupted(const struct sweep_course *r, bool lost) {
  if (lost) fputs("stickslip: error: a worker process ended before its time\n", stderr);
  if (r->sink->to_file)
    fprintf(stderr, "stickslip: interrupted; %s holds %ld of %ld units of work: --resume continues it\n",
            text_str(&r->sink->part.path), (long)r->written, (long)r->q->units);
  else
    fputs("stickslip: interrupted\n", stderr);
  return EXIT_INTERNAL;
}

static int loop(struct sweep_course *r) {
  OWNED(text) rows = {0};
  bool ok = true, lost = false;
  while (ok && r->written < r->q->units && !stopped && !lost) {
    give(r);
    lost = !take(r, &rows);
    ok = write_ready(r);
    double done = (double)(r->written - r->begun_at), all = (double)(r->q->units - r->begun_at);
    progress_show((size_t)r->written, (size_t)r->q->units, done / all);
  }
  progress_end();
  if (ok && r->written < r->q->units) return say_interrupted(r, lost && !stopped);
  ok = ok && sink_finish(r->sink, r->q, &r->d);
  return ok ? EXIT_AS_RECORDED : sink_failed(&r->d);
}

static bool do_unit(struct text *rows, size_t unit, int place, void *arg) {
  (void)place;
  sweep_rows(rows, arg, (slong)unit);
  return true;
}

struct crew *sweep_crew(const struct sweep *q, int jobs, struct diag *d) {
  return crew_open(do_unit, (void *)(uintptr_t)q, jobs, false, d);
}

int sweep_carry_out(const struct sweep *q, struct sink *s, int jobs) {
  struct sweep_course *r = ss_malloc(sizeof *r);
  *r = (struct sweep_course){
      .q = q, .sink = s, .room = jobs + 1, .next = s->done, .written = s->done, .begun_at = s->done};
  progress_begin();
  r->crew = sweep_crew(q, jobs, &r->d);
#ifdef STICKSLIP_MPI
  r->helpers = helpers_open(q);
#endif
  int status = r->crew ? loop(r) : bad_input(&r->d);
  if (r->crew) crew_close(r->crew);
#ifdef STICKSLIP_MPI
  helpers_close(r->helpers);
#endif
  for (int i = 0; i < AHEAD; i++) text_clear(&r->ring[i].rows);
  free(r->again);
  free(r);
  return status;
}
