/* Feeds a fuzz target the files named on the command line, and every file in the folders among them; a target that does
   not return, or aborts, has failed.  The last line says how many files there were. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>

#include "fuzz.h"
#include "num/flint_compat.h"

enum { LARGEST = 1 << 20 };

static long feed(const char *path) {
  static uint8_t bytes[LARGEST];
  FILE *f = fopen(path, "rb");
  if (!f) return 0;
  size_t n = fread(bytes, 1, sizeof bytes, f);
  fclose(f);
  uint8_t *exact = malloc(n ? n : 1); /* so that a sanitizer sees its end */
  if (!exact) abort();
  for (size_t i = 0; i < n; i++) exact[i] = bytes[i];
  LLVMFuzzerTestOneInput(exact, n);
  free(exact);
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
