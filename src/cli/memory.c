/* One end for exhausted memory, whoever asked for it: a message and the status of the contract. */
#include <gmp.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>

#include "cli.h"

static void *resized(void *p, size_t old, size_t size) {
  (void)old;
  return ss_realloc(p, size);
}

static void released(void *p, size_t size) {
  (void)size;
  free(p);
}

static void *zeros(size_t n, size_t size) {
  void *p = calloc(n ? n : 1, size ? size : 1);
  if (!p) ss_out_of_memory();
  return p;
}

/* GSL's own handler for what else nobody expected. */
static void on_gsl_error(const char *reason, const char *file, int line, int number) {
  dyn_gsl_quiet(reason, file, line, number);
  fprintf(stderr, "gsl: %s:%d: %s\n", file, line, reason);
  abort();
}

void own_memory(void) {
  mp_set_memory_functions(ss_malloc, resized, released);
  __flint_set_memory_functions(ss_malloc, zeros, ss_realloc, free);
  gsl_set_error_handler(on_gsl_error);
}
