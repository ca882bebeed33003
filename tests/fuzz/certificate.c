/* The checker on any bytes, in this process.  It ends by exit(), which jumps back here; what it holds then is lost, as
   it is when it ends, so that leaks do not count.  Law: an exit status of its own. */
#include <setjmp.h>

#include "fuzz.h"

static jmp_buf ended;
static int checker_status;

static _Noreturn void checker_exit(int status) {
  checker_status = status;
  longjmp(ended, 1);
}

int checker_main(int argc, char **argv);
#define main checker_main
#define exit checker_exit
#include "../../verify/checker/check.c"
#include "../../verify/checker/file.c"
#include "../../verify/checker/motion.c"
#undef exit
#undef main

void __lsan_disable(void) __attribute__((weak));

/* The reading and, at the first precision, the proofs; what a proof may cost is bounded by the checker, not here. */
static int check(const char *path) {
  enum { PROVED = 2 };
  read_file(path);
  int n = read_certificate();
  prec = 128;
  for (int i = 0; i < n && i < PROVED; i++) {
    struct motion m;
    struct entry *o = &orbits[i];
    if (!enclose(o->x, &o->boxed, &o->word)) continue;
    follow(&m, &o->word, o->x);
    recheck_at(o, &m);
  }
  return VERIFIED;
}

static void forget(void) {
  flint_free(buffer);
  buffer = NULL;
  n_values = 0;
  memset(values, 0, sizeof values);
  memset(orbits, 0, sizeof orbits);
  memset(&sys, 0, sizeof sys);
  narrowest = 0;
  release(0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (__lsan_disable) __lsan_disable();
  if (!setjmp(ended)) checker_status = check(fuzz_file(".json", data, size));
  fuzz_law(checker_status == VERIFIED || checker_status == REJECTED || checker_status == BAD_FILE,
           "the status is one of its own");
  forget();
  return 0;
}
