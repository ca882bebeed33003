/* How every function of the library answers, and what holds for all of them.

   Answers.  A function that can fail returns a status, SS_OK or other codes OR-ed; ss_error() is then a sentence about
   the last failure in the calling thread (the fast functions ss_return_map and ss_orbit_warm leave it as it was).  It
   counts orbits from 1, as the commands do, where arguments count from 0.  After a failure a handle or a text that was
   to be made is NULL; other outputs keep the value that they had unless their function says otherwise.  Nothing is
   printed, and no argument, however wrong, ends the program: NULL where a value is needed, an index that is too large,
   an unknown name are SS_ARGUMENT, or NULL, NaN or SS_UNKNOWN from a function that returns what it was asked for.  A
   pointer that points to nothing of its type is the caller's fault.

   Ownership.  Handles (ss_scene *, ss_orbits *, ...) are made by functions whose first argument is the handle's
   address, and given back by the function ..._free of their type, which takes NULL too.  A char ** that is filled is
   given back by ss_text_free.  A const pointer that a function returns is part of the handle it was asked of and lives
   as long.  Handles keep nothing of what they were made from: a scene may be freed while its orbits are in use.

   Threads.  Any number of threads may call the library at a time, each on handles of its own; several may read one
   handle as long as none changes or frees it.  Audits wait for each other (audit.h), and change GSL's error handler,
   which is one for the process, while they run.  A thread that has used the library may call ss_cleanup() at its end.

   Memory.  When it runs out the process ends with status 5 and a message, since GMP, on which everything stands, knows
   no other end.

   Texts are UTF-8.  LC_NUMERIC must be "C", which it is in a program that does not change it. */
#ifndef SS_STATUS_H
#define SS_STATUS_H

#include <stddef.h>

#if defined(__GNUC__)
#define SS_API __attribute__((visibility("default")))
#else
#define SS_API
#endif

/* Of this header; ss_version() is that of the library that runs.  Before 1.0.0 the second number rises with every
   change that a program may notice. */
#define SS_VERSION_MAJOR 0
#define SS_VERSION_MINOR 1
#define SS_VERSION_PATCH 0
#define SS_VERSION       "0.1.0"

#ifdef __cplusplus
extern "C" {
#endif

/* The first two are what mathematics answers, the others are about the call. */
enum ss_status {
  SS_OK = 0,
  SS_DOMAIN = 1,   /* the value does not exist: outside the domain, a division by zero, an event that never comes */
  SS_UNABLE = 2,   /* it could not be told or held: precision or a budget used up, overflow */
  SS_ARGUMENT = 4, /* a wrong argument: NULL, a number of digits out of range, no such index */
  SS_INPUT =
      8, /* a file or a text is wrong, or asks for what cannot be had; the error has its place where it has one */
  SS_STOPPED = 16 /* a function of the caller's said so */
};
/* A few words for a status. */
SS_API const char *ss_status_text(int status);
/* About the last call of this thread that failed: one line, or three with the line of a file and a caret under the
   place, "FILE:LINE:COLUMN: error: ..."; "" when none has.  Valid until the thread's next failure. */
SS_API const char *ss_error(void);

/* Three-valued truth: SS_UNKNOWN is an honest answer, what is told by the others is proved unless a function says
   otherwise. */
enum ss_truth { SS_FALSE = 0, SS_TRUE = 1, SS_UNKNOWN = 2 };

/* "0.1.0" */
SS_API const char *ss_version(void);
/* Gives back a text; NULL is fine. */
SS_API void ss_text_free(char *text);
/* Gives back what the calling thread has kept to be faster later (constants and tables); it may go on all the same. */
SS_API void ss_cleanup(void);

#ifdef __cplusplus
}
#endif

#endif
