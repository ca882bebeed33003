/* Pieces of an audit, done in any order by any number of processes, each into a result of its own.

   The processes are forked and write into pages that they share with their parent at the same addresses, so that
   whatever a task has put into its arena is at hand afterwards, pointers and all.  A task may point to constants and to
   what was there before tasks_run, but to nothing else outside its arena.  What a process leaves undone, because it
   ended early, could not be made or had no room, the parent does itself. */
#ifndef STICKSLIP_RUN_TASKS_H
#define STICKSLIP_RUN_TASKS_H

#include "base/text.h"
#include "base/work.h"
#include "record/result.h"

enum task_end { TASK_OPEN, TASK_DONE, TASK_FAILED, TASK_EXHAUSTED };

struct task_result {
  enum task_end end;
  struct audit_result part; /* its lists; strings and lists live as long as the result given to tasks_run */
  const char *error;        /* of one that failed */
  unsigned touched;         /* work.h */
  struct work_raises raises;
  unsigned long long units; /* of work that it took, */
  double seconds;           /* and by the clock */
};

struct tasks {
  size_t n;
  bool (*run)(struct audit_result *part, size_t i, void *arg, struct diag *d); /* false: d says why */
  void *arg;
  const double *cost;        /* what each is expected to take, in milliseconds: the longest come first */
  int jobs;                  /* processes, the parent among them */
  unsigned long long budget; /* of work for each; with one, each task has a process of its own, so that what others have
                                left in memory makes it no cheaper; 0: none */
  double (*seconds_now)(void);                           /* seconds; or NULL */
  void (*tell)(void *teller, size_t done, double share); /* of the cost; or NULL */
  void *teller;
};

/* Results for all, in the order of the tasks, to be freed; memory for what they point to goes to out. */
struct task_result *tasks_run(struct audit_result *out, const struct tasks *t);
/* Adds a part's lists at the end of out's. */
void result_append(struct audit_result *out, const struct audit_result *part);

#endif
