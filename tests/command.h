/* The program as its users meet it: started as a process, seen through its output and its exit status; and what stands
   in JSON that it prints. */
#ifndef STICKSLIP_TESTS_COMMAND_H
#define STICKSLIP_TESTS_COMMAND_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/types.h>

#include "process.h"

/* MOST_SECONDS: of processor time, that a refusal takes. */
enum { MAX_ARGS = 160, TIME_LIMIT = 300, MOST_VALUE = 1100, MOST_SECONDS = SANITIZED ? 10 : 1 };

/* What surrounds a program that is started; all zero: what the tests have themselves. */
struct job_place {
  const char *out;    /* where standard output goes: a path; NULL: it is read back; "closed", "pipe": nobody reads */
  rlim_t memory;      /* bytes that it may have, but under a sanitizer; 0: any */
  rlim_t file;        /* bytes that it can write to a file, as on a disk that is full; 0: any */
  bool permissions;   /* of files hold, for root too */
  bool group;         /* at the head of a group of processes of its own */
  const char *env[3]; /* NAME=VALUE */
};

struct job {
  pid_t pid;
  const char *out_path, *err_path; /* the first is NULL where it is not read back */
  bool short_of_memory;
  double seconds; /* of processor time, where no other child has ended meanwhile */
  int status;     /* exit status, or minus the signal; -1000 while it runs */
  char *out, *err;
  size_t out_size, err_size;
};

/* place: NULL as all zero. */
void job_start(struct job *j, const struct job_place *place, const char *file, const char *const *args);
/* The program, with words between blanks. */
void job_start_words(struct job *j, const struct job_place *place, const char *words);
void job_finish(struct job *j);
void job_clear(struct job *j);
void job_take(struct job *j, struct job next); /* in place of what it was */

/* Started and finished, to be cleared; what takes MOST_SECONDS once, on a machine that does other things, is run up to
   three times. */
struct job job_quick(const struct job_place *place, const char *file, const char *const *args);
/* Fails the test where a job does not end with that status as a refusal does: nothing on standard output and one
   message that fits, with a caret where it names a place, within MOST_SECONDS. */
void job_refused(const struct job *j, int status, const char *what);

/* The value of the first "key": after from, without quotes; lists are cut at their first line. */
const char *member(const char *from, const char *key);

#endif
