/* GSL without its messages; exhausted memory ends the program as it does everywhere else. */
#include <gsl/gsl_errno.h>

#include "base/arena.h"
#include "dynamics.h"

void dyn_gsl_quiet(const char *reason, const char *file, int line, int number) {
  (void)reason;
  (void)file;
  (void)line;
  if (number == GSL_ENOMEM) ss_out_of_memory();
}
