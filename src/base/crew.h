/* Forked processes that share numbered items of work.

   Items go into one queue; each process takes the next of them when it is free, and what it makes of one comes back
   through a pipe of its own as bytes, which must not depend on who makes them.  A crew's memory is that of its parent
   when it was opened, and what a process writes is lost but for those bytes and for pages that are shared.

   A process ends when its parent is gone, at its next item at the latest, and by the signals that end a run, where its
   parent does not ignore them.  What goes wrong in it, it does not say: that is its parent's to say. */
#ifndef STICKSLIP_BASE_CREW_H
#define STICKSLIP_BASE_CREW_H

#include <stdbool.h>
#include <stddef.h>

#include "text.h"

enum { CREW_MOST = 64 };

/* Appends what the item gives; place: which of the processes this is, from 0 on, no other at the same time.  false ends
   the process and leaves the item undone. */
typedef bool crew_work(struct text *bytes, size_t item, int place, void *arg);

/* So many processes, 1 to CREW_MOST, or fewer where no more can be made; NULL with d set where none can.  one_each: a
   process does one item, and another takes its place while there are more.  One crew at a time; while it lasts, memory
   that is exhausted ends its processes (ss_out_of_memory). */
struct crew *crew_open(crew_work *work, void *arg, int jobs, bool one_each, struct diag *d);
/* Ends what still works. */
void crew_close(struct crew *c);
/* Kills the processes there are; for a signal's handler that ends the program. */
void crew_abandon(void);

/* At the end of the queue, which takes any number. */
void crew_give(struct crew *c, size_t item);
/* Nothing more will be given: processes that find nothing left end. */
void crew_complete(struct crew *c);
/* After crew_complete: takes the next item out of the queue, for the parent to do; false when there is none. */
bool crew_next(struct crew *c, size_t *item);

enum crew_news {
  CREW_NOTHING,   /* within the wait, or before a signal's handler returned */
  CREW_ITEM,      /* an item is done: bytes holds what it gave */
  CREW_LOST,      /* a process ended before its time, perhaps with an item that is not done */
  CREW_EXHAUSTED, /* the same, for want of memory */
  CREW_OVER       /* every process has ended */
};
/* The next news within so many milliseconds; -1: however long it takes. */
enum crew_news crew_take(struct crew *c, size_t *item, struct text *bytes, int wait);

/* Who is told how far a command is whose work is done in several calls: so many of all its items are done. */
struct crew_tally {
  void (*tell)(size_t done, size_t of); /* or NULL */
  size_t done, of;
};

/* Results of one size, n of them, made by `jobs` processes: make writes result i.  The tally, or NULL, counts them.
   false with d set when no process can be made, or one ends before its work is done; no process is left behind. */
typedef void crew_make(void *result, size_t i, void *arg);
bool crew_results(void *results, size_t size, size_t n, int jobs, crew_make *make, void *arg, struct crew_tally *tally,
                  struct diag *d);

#endif
