/* Preloaded into the program under test, lets things go wrong (glibc only; not part of the program).  Of the
   allocations that it asks for from main on, the FAIL_ALLOC-th alone fails, or with a "+" behind the number that and
   every later one; FAIL_ALLOC_COUNT names a file that gets the number of allocations of a run.  SIGNAL_AT_RENAME=SIGNAL
   or SIGNAL:K is the number of a signal that arrives right before the first rename, or the K-th, which with
   FAIL_RENAME=K fails.  With FAIL_POLL no wait for several things succeeds. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long count;
static long failing; /* 0: none */
static bool later, in_main;

static bool fails(void) {
  if (!in_main) return false;
  long n = atomic_fetch_add(&count, 1) + 1;
  if (!failing || n < failing || (n > failing && !later)) return false;
  errno = ENOMEM;
  return true;
}

void *malloc(size_t size) {
  return fails() ? NULL : __libc_malloc(size);
}
void *calloc(size_t n, size_t size) {
  return fails() ? NULL : __libc_calloc(n, size);
}
void *realloc(void *p, size_t size) {
  return fails() ? NULL : __libc_realloc(p, size);
}
void *aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}
void *memalign(size_t alignment, size_t size);
void *memalign(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void **p, size_t alignment, size_t size) {
  void *got = fails() ? NULL : __libc_memalign(alignment, size);
  if (got) *p = got;
  return got ? 0 : ENOMEM;
}

int rename(const char *from, const char *to) {
  int (*real)(const char *, const char *) = (int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename");
  static int renames;
  const char *number = getenv("SIGNAL_AT_RENAME"), *which = number ? strchr(number, ':') : NULL;
  const char *fails_at = getenv("FAIL_RENAME");
  renames++;
  if (number && renames == (which ? atoi(which + 1) : 1)) raise(atoi(number));
  if (fails_at && renames == atoi(fails_at)) {
    errno = EPERM;
    return -1;
  }
  return real(from, to);
}

/* What poll is where copies are checked. */
int __poll_chk(struct pollfd *p, nfds_t n, int wait, size_t size);
int __poll_chk(struct pollfd *p, nfds_t n, int wait, size_t size) {
  int (*real)(struct pollfd *, nfds_t, int, size_t) =
      (int (*)(struct pollfd *, nfds_t, int, size_t))dlsym(RTLD_NEXT, "__poll_chk");
  if (!getenv("FAIL_POLL")) return real(p, n, wait, size);
  errno = ENOMEM;
  return -1;
}

static void report(void) {
  const char *path = getenv("FAIL_ALLOC_COUNT");
  char text[32];
  in_main = false;
  int len = snprintf(text, sizeof text, "%ld\n", atomic_load(&count));
  int fd = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  if (fd >= 0 && write(fd, text, (size_t)len) != len) _exit(126);
  if (fd >= 0) close(fd);
}

static int (*real_main)(int, char **, char **);

static int counted_main(int argc, char **argv, char **env) {
  const char *which = getenv("FAIL_ALLOC");
  atexit(report);
  if (which) {
    failing = atol(which);
    later = strchr(which, '+') != NULL;
  }
  unsetenv("LD_PRELOAD"); /* the program's children are not counted */
  in_main = true;
  return real_main(argc, argv, env);
}

/* Where the C library starts a program. */
int __libc_start_main(int (*f)(int, char **, char **), int argc, char **argv, int (*init)(int, char **, char **),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end);
int __libc_start_main(int (*f)(int, char **, char **), int argc, char **argv, int (*init)(int, char **, char **),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end) {
  __typeof__(&__libc_start_main) start = (__typeof__(&__libc_start_main))dlsym(RTLD_NEXT, "__libc_start_main");
  real_main = f;
  return start(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}
