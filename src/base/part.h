/* A file written piece by piece, over a long time: it grows as FILE.part and is renamed to FILE when it is whole.

   What a run that ended early leaves behind is FILE.part, which another run can take up again, and FILE.part.sum, which
   holds the length and a sum of the pieces that were written whole, so that what was changed since is not gone on with.
   While it is open no other process of this project can open it to write. */
#ifndef STICKSLIP_BASE_PART_H
#define STICKSLIP_BASE_PART_H

#include <stdint.h>

#include "text.h"

struct part {
  int fd; /* -1: not open; as long as it is, closing any other descriptor of the file drops the lock */
  int sum_fd;
  struct text target, path, sum_path;
  long long len; /* of what was written, and its sum */
  uint64_t hash;
};
void part_init(struct part *p, const char *target);
/* Closes the file and leaves FILE.part as it is. */
void part_clear(struct part *p);

/* All return false with d set on failure. */

/* A new one; it is an error that FILE.part exists, or that something else than a regular file stands at FILE. */
bool part_create(struct part *p, struct diag *d);
/* The one that is there, without what stands behind the last whole piece; *found is false when there is none, which is
   no failure.  Links, and what is not as it was written, are. */
bool part_open(struct part *p, bool *found, struct diag *d);
/* Drops everything from the offset on; the next piece goes there. */
bool part_cut(struct part *p, long long offset, struct diag *d);
bool part_write(struct part *p, const char *data, size_t len, struct diag *d);
bool part_finish(struct part *p, struct diag *d);

#endif
