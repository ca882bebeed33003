/* A file for readers that take a path: made once, removed at the end, rewritten in between. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"

static char path[64];

static void remove_file(void) {
  unlink(path);
}

const char *fuzz_file(const char *suffix, const uint8_t *data, size_t size) {
  if (!*path) {
    snprintf(path, sizeof path, "/tmp/stickslip-fuzz-%ld%s", (long)getpid(), suffix);
    atexit(remove_file);
  }
  int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0 || !write_all(fd, (const char *)data, size)) abort();
  close(fd);
  return path;
}

bool fuzz_source(struct source *s, const uint8_t *data, size_t size) {
  const char *bytes = (const char *)data;
  if (memchr(bytes, '\0', size) || text_valid_prefix(bytes, size) < size) return false;
  struct text t = {0};
  text_add_n(&t, bytes, size);
  source_from_string(s, "input", text_str(&t));
  text_clear(&t);
  return true;
}

void fuzz_law(bool holds, const char *law) {
  if (holds) return;
  fprintf(stderr, "broken law: %s\n", law);
  abort();
}
