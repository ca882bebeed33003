#include "every.h"

#include <stdlib.h>
#include <string.h>

bool every_case(void) {
  const char *tests = getenv("STICKSLIP_TESTS");
  return tests && strcmp(tests, "all") == 0;
}

int every(int n) {
  return every_case() ? 1 : n;
}
