/* The program as its users meet it: started as a process, seen through its output and its exit status; and what stands
   in JSON that it prints. */
#ifndef STICKSLIP_TESTS_COMMAND_H
#define STICKSLIP_TESTS_COMMAND_H

#include <sys/resource.h>
#include <sys/types.h>

enum { MAX_ARGS = 120, TIME_LIMIT = 300, MOST_VALUE = 1100 };

struct job {
  pid_t pid;
  const char *out_path, *err_path;
  int status; /* exit status, or minus the signal; -1000 while it runs */
  char *out, *err;
};

extern rlim_t largest_file; /* bytes that a started program can write to a file, as on a disk that is full; 0: any */

/* stdout_to: a device to write to, or NULL for a file that is read back. */
void job_start(struct job *j, const char *stdout_to, const char *file, const char *const *args);
void job_finish(struct job *j);
void job_clear(struct job *j);

/* job_run(&j, "orbit", "paper", NULL); job_run_well: which must go well and say nothing on stderr. */
void job_run(struct job *j, const char *first, ...);
void job_run_well(struct job *j, const char *first, ...);

/* The value of the first "key": after from, without quotes; lists are cut at their first line. */
const char *member(const char *from, const char *key);
/* The strings of the list "key": [...] after from, joined with commas. */
const char *list_member(const char *from, const char *key);

#endif
