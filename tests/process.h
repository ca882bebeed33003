/* Processes that a test has started, as Linux shows them in /proc: a test waits for what they do, never for some time,
   so that neither a slow machine nor a fast one changes what it says.  A zombie has ended, whether or not anybody asks
   for its status. */
#ifndef STICKSLIP_TESTS_PROCESS_H
#define STICKSLIP_TESTS_PROCESS_H

#include <stdbool.h>
#include <sys/types.h>

#ifdef __SANITIZE_ADDRESS__
enum { SANITIZED = 1 }; /* with memory and an allocator of its own, which reserves terabytes, and slow */
#else
enum { SANITIZED = 0 };
#endif

/* In a child: no signal is ignored, whatever the tests were started by; under nohup a hangup is, and a program leaves
   that so. */
void process_as_from_a_shell(void);

/* Waits for a child: its exit status, or minus the signal that ended it. */
int process_end(pid_t pid);

/* The processor time in seconds of the children that have been waited for. */
double children_seconds(void);

/* Asks again and again until it is so, or for a minute and a half; whether it is so. */
bool process_until(bool (*is_so)(pid_t pid), pid_t pid);

/* How many of a group live, and the processor time in seconds that these have used. */
int group_lives(pid_t group);
double group_seconds(pid_t group);
bool group_has_ended(pid_t group);

/* Whether it waits for a lock that another process holds. */
bool process_waits_for_a_lock(pid_t pid);

/* Whether a handler of its own is in place for a signal; false of a process that has ended. */
bool process_catches(pid_t pid, int number);

#endif
