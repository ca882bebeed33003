/* Feeds a fuzz target the files named on the command line, and every file in the folders among them, each as it is and
   with some bytes changed, taken out or put in, the same on every run; a target that does not return, or aborts, has
   failed.  The last line says how many files there were. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "fuzz.h"
#include "num/flint_compat.h"

enum { LARGEST = 1 << 20, VARIANTS = 100, MOST_EDITS = 4 };

static void feed_bytes(const uint8_t *bytes, size_t n) {
  uint8_t *exact = malloc(n ? n : 1); /* so that a sanitizer sees its end */
  if (!exact) abort();
  memcpy(exact, bytes, n);
  LLVMFuzzerTestOneInput(exact, n);
  free(exact);
}

/* One edit, by a byte that stands elsewhere in the text, or by any. */
static size_t edit(uint8_t *bytes, size_t n, uint64_t *stream) {
  size_t at = random_next(stream) % (n + 1);
  uint8_t byte = (uint8_t)random_next(stream);
  if (n > 0 && byte % 8) byte = bytes[random_next(stream) % n];
  switch (at < n ? random_next(stream) % 3 : 2) {
  case 0:
    bytes[at] = byte;
    return n;
  case 1:
    memmove(bytes + at, bytes + at + 1, n - at - 1);
    return n - 1;
  default:
    memmove(bytes + at + 1, bytes + at, n - at);
    bytes[at] = byte;
    return n + 1;
  }
}

static long feed(const char *path) {
  static uint8_t bytes[LARGEST], changed[LARGEST + MOST_EDITS];
  FILE *f = fopen(path, "rb");
  if (!f) return 0;
  size_t n = fread(bytes, 1, sizeof bytes, f);
  fclose(f);
  feed_bytes(bytes, n);
  uint64_t stream = random_seed(path);
  for (int i = 0; i < VARIANTS; i++) {
    size_t len = n;
    memcpy(changed, bytes, n);
    for (uint64_t k = random_next(&stream) % MOST_EDITS + 1; k > 0; k--) len = edit(changed, len, &stream);
    feed_bytes(changed, len);
  }
  return 1;
}

static long feed_folder(const char *path) {
  DIR *dir = opendir(path);
  if (!dir) return feed(path);
  long n = 0;
  for (struct dirent *e = readdir(dir); e; e = readdir(dir)) {
    char inside[4096];
    if (e->d_name[0] == '.') continue;
    snprintf(inside, sizeof inside, "%s/%s", path, e->d_name);
    n += feed(inside);
  }
  closedir(dir);
  return n;
}

int main(int argc, char **argv) {
  long n = 0;
  for (int i = 1; i < argc; i++) n += feed_folder(argv[i]);
  flint_cleanup();
  mpfr_free_cache();
  printf("%ld inputs\n", n);
  return n > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
