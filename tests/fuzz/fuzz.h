/* Fuzz targets: each file of this folder but file.c and replay.c is one, the entry point of libFuzzer for one reader.

   `make fuzz` runs them under libFuzzer for a while; replay.c feeds them the files of corpus/TARGET instead, without
   it, which the tests do.  A target aborts when a law of the reader does not hold; memory errors and leaks are the
   sanitizers'. */
#ifndef STICKSLIP_TESTS_FUZZ_H
#define STICKSLIP_TESTS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* The bytes as the only file of that suffix that this process has; its path, valid until the next call. */
const char *fuzz_file(const char *suffix, const uint8_t *data, size_t size);
/* The bytes as a source; false, and nothing to clear, when no file with them would be text. */
bool fuzz_source(struct source *s, const uint8_t *data, size_t size);
/* Ends the process when a law is broken. */
void fuzz_law(bool holds, const char *law);

#endif
