/* JSON from any bytes.  Laws: refused with a message or read without one; a value is the same as itself. */
#include "base/json.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  OWNED(source) src = {.len = 0};
  LOCAL(arena, a);
  struct json_value v;
  struct diag d = {0};
  if (!fuzz_source(&src, data, size)) return 0;
  bool ok = json_parse(&v, &a, &src, &d);
  fuzz_law(ok != d.set, "a value is read, or there is a message");
  if (ok) fuzz_law(json_same(&v, &v), "a value is the same as itself");
  return 0;
}
