/* The Python module and its notebook: tests/python holds them against tests/oracle and the headers.  Left out where
   there is no Python, and under AddressSanitizer, which a Python that is not built with it cannot load. */
#include "test.h"

/* NULL, or why the module cannot be tried here. */
static const char *left_out(void) {
#ifdef __SANITIZE_ADDRESS__
  return "the library is built with AddressSanitizer, and Python is not";
#else
  return shell("\"$Y\" -c '' 2> /dev/null") == 0 ? NULL : "there is no Python";
#endif
}

CASE("module", .each = {scratch_open, scratch_close}, .seconds = 300);

TEST_EACH(the_module, 5) {
  static const char *const classes[] = {"Declared", "Numbers", "Wrong", "Memory", "Notebook"};
  const char *why = left_out();
  if (why) {
    printf("python: %s: left out, %s\n", classes[_i], why);
    return;
  }
  FREED char *said = shell_said("PYTHONPATH=python PYTHONDONTWRITEBYTECODE=1 "
                                "STICKSLIP_LIBRARY=\"$(realpath \"$(dirname \"$P\")\")/libstickslip.so.0\" "
                                "\"$Y\" tests/python/module.py -v %s 2>&1",
                                classes[_i]);
  for (char *line = strtok(said, "\n"); line; line = strtok(NULL, "\n"))
    if (strstr(line, " skipped ")) printf("python: %s\n", line);
}
