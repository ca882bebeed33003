/* The program as its users meet it: started as a process, seen through its output and its exit status; and what stands
   in JSON that it prints. */
#ifndef STICKSLIP_TESTS_COMMAND_H
#define STICKSLIP_TESTS_COMMAND_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/types.h>

enum { MAX_ARGS = 160, TIME_LIMIT = 300, MOST_VALUE = 1100 };

/* What surrounds a program that is started; all zero: what the tests have themselves. */
struct job_place {
  const char *out;    /* where standard output goes: a path; NULL: it is read back; "closed", "pipe": nobody reads */
  rlim_t memory;      /* bytes that it may have, but under a sanitizer; 0: any */
  rlim_t file;        /* bytes that it can write to a file, as on a disk that is full; 0: any */
  bool nobody;        /* without root's rights */
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
void job_finish(struct job *j);
void job_clear(struct job *j);
void job_take(struct job *j, struct job next); /* in place of what it was */

/* job_run("orbit", "paper", NULL); job_run_well: which must go well and say nothing on stderr.  To be cleared. */
struct job job_run(const char *first, ...);
struct job job_run_well(const char *first, ...);

/* What the suite's commands of tests/cases/schemas.tsv print obeys its schemas, by one interpreter for all. */
void check_schemas(const char *suite);

/* The value of the first "key": after from, without quotes; lists are cut at their first line. */
const char *member(const char *from, const char *key);
/* The strings of the list "key": [...] after from, joined with commas. */
const char *list_member(const char *from, const char *key);

#endif
