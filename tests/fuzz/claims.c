/* A file of claims from any bytes.  Laws: refused with a message or taken without one. */
#include "fuzz.h"
#include "run/audit.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct diag d = {0};
  bool ok = audit_check_file(fuzz_file(".claim", data, size), "verify", &d);
  fuzz_law(ok != d.set, "a file is taken, or there is a message");
  return 0;
}
