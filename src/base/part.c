/* Files that grow beside and are renamed when whole.  A lock keeps two runs from writing the same one. */
#include "part.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void part_init(struct part *p, const char *target) {
  *p = (struct part){.fd = -1};
  text_init(&p->target);
  text_init(&p->path);
  text_add(&p->target, target);
  text_printf(&p->path, "%s.part", target);
}

void part_clear(struct part *p) {
  if (p->fd >= 0) close(p->fd);
  text_clear(&p->target);
  text_clear(&p->path);
  p->fd = -1;
}

static bool failed(const struct text *path, struct diag *d) {
  diag_set(d, "%s: error: cannot be written: %s", text_str(path), strerror(errno));
  return false;
}

/* Two runs with one FILE.part would spoil each other's work. */
static bool lock(struct part *p, struct diag *d) {
  struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  if (fcntl(p->fd, F_SETLK, &whole) == 0) return true;
  if (errno != EACCES && errno != EAGAIN) return true; /* a file system without locks */
  diag_set(d, "%s: error: another process is writing this file", text_str(&p->path));
  return false;
}

bool part_create(struct part *p, struct diag *d) {
  if (!file_replaceable(text_str(&p->target))) return failed(&p->target, d);
  p->fd = open(text_str(&p->path), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (p->fd >= 0) return lock(p, d);
  if (errno != EEXIST) return failed(&p->path, d);
  diag_set(d, "%s: error: exists, from a run that was interrupted or still goes on; --resume continues it",
           text_str(&p->path));
  return false;
}

bool part_open(struct part *p, bool *found, struct diag *d) {
  struct stat st;
  *found = false;
  if (!file_replaceable(text_str(&p->target))) return failed(&p->target, d);
  p->fd = open(text_str(&p->path), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (p->fd < 0 && errno == ENOENT) return true;
  if (p->fd < 0) return failed(&p->path, d);
  if (fstat(p->fd, &st) != 0 || !S_ISREG(st.st_mode)) {
    diag_set(d, "%s: error: not a regular file", text_str(&p->path));
    return false;
  }
  *found = true;
  return lock(p, d);
}

bool part_cut(struct part *p, long long offset, struct diag *d) {
  if (ftruncate(p->fd, (off_t)offset) != 0 || lseek(p->fd, (off_t)offset, SEEK_SET) < 0) return failed(&p->path, d);
  return true;
}

bool part_write(struct part *p, const char *data, size_t len, struct diag *d) {
  return write_all(p->fd, data, len) || failed(&p->path, d);
}

bool part_finish(struct part *p, struct diag *d) {
  int fd = p->fd;
  p->fd = -1;
  if (close(fd) != 0) return failed(&p->path, d);
  return rename(text_str(&p->path), text_str(&p->target)) == 0 || failed(&p->target, d);
}
