/* Work shared among processes: item i gives a few bytes, the same whichever process does it. */
#ifndef STICKSLIP_WORKERS_H
#define STICKSLIP_WORKERS_H

#include <stdbool.h>
#include <stddef.h>

#include "stickslip/text.h"

enum { WORKERS_MAX = 64, WORKERS_ITEM_MAX = 2048 };

/* Writes the result of item i. */
typedef void work_fn(void *result, size_t i, void *arg);

/* Does items 0 .. n-1 in `jobs` forked processes; results: n of the given size, at most WORKERS_ITEM_MAX bytes.
   done, when given, is told how many are ready.  false with d set when a process cannot be made or ends before its work
   is done; no process is left behind.  A process whose parent is gone ends at its next result. */
bool workers_run(void *results, size_t size, size_t n, int jobs, work_fn *work, void *arg,
                 void (*done)(size_t n, size_t of), struct diag *d);

#endif
