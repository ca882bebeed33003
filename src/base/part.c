/* Files that grow beside and are renamed when whole.  A lock keeps two runs from writing the same one, a sum over all
   that was written tells what happened to them in the meantime. */
#include "part.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void part_init(struct part *p, const char *target) {
  *p = (struct part){.fd = -1, .sum_fd = -1};
  text_add(&p->target, target);
  text_printf(&p->path, "%s.part", target);
  text_printf(&p->sum_path, "%s.part.sum", target);
}

void part_clear(struct part *p) {
  if (p->fd >= 0) close(p->fd);
  if (p->sum_fd >= 0) close(p->sum_fd);
  text_clear(&p->target);
  text_clear(&p->path);
  text_clear(&p->sum_path);
  p->fd = p->sum_fd = -1;
}

static bool failed(const struct text *path, struct diag *d) {
  return diag_set(d, "%s: error: cannot be written: %s", text_str(path), strerror(errno));
}

/* Two runs with one FILE.part would spoil each other's work. */
static bool lock(struct part *p, struct diag *d) {
  struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  if (fcntl(p->fd, F_SETLK, &whole) == 0) return true;
  if (errno != EACCES && errno != EAGAIN) return true; /* a file system without locks */
  return diag_set(d, "%s: error: another process is writing this file", text_str(&p->path));
}

/* --- The sum: "length hash", FNV-1a in 64 bits --- */

static const uint64_t hash_of_nothing = 0xcbf29ce484222325U;

static void hash_on(uint64_t *hash, const char *data, size_t len) {
  for (size_t i = 0; i < len; i++) *hash = (*hash ^ (unsigned char)data[i]) * 0x100000001b3U;
}

/* The sum over so many bytes of the file; false where it has not as many. */
static bool sum_up(struct part *p, long long len) {
  char block[1 << 14];
  p->len = 0;
  p->hash = hash_of_nothing;
  while (p->len < len) {
    size_t most = len - p->len < (long long)sizeof block ? (size_t)(len - p->len) : sizeof block;
    ssize_t got = pread(p->fd, block, most, (off_t)p->len);
    if (got <= 0) return false;
    hash_on(&p->hash, block, (size_t)got);
    p->len += got;
  }
  return true;
}

static bool sum_write(struct part *p, struct diag *d) {
  char line[60];
  int n = snprintf(line, sizeof line, "%020lld %016" PRIx64 "\n", p->len, p->hash);
  return pwrite(p->sum_fd, line, (size_t)n, 0) == n || failed(&p->sum_path, d);
}

/* Whether the file holds what was written to it; what stands behind that, from a piece cut short, is dropped. */
static bool sum_holds(struct part *p) {
  char line[60] = "";
  long long len;
  uint64_t hash;
  return pread(p->sum_fd, line, sizeof line - 1, 0) > 0 && sscanf(line, "%lld %" SCNx64, &len, &hash) == 2 &&
         len >= 0 && sum_up(p, len) && p->hash == hash && ftruncate(p->fd, (off_t)len) == 0;
}

static bool sum_open(struct part *p, int more, struct diag *d) {
  p->sum_fd = open(text_str(&p->sum_path), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | more, 0644);
  if (p->sum_fd < 0) return failed(&p->sum_path, d);
  struct stat st;
  if (fstat(p->sum_fd, &st) == 0 && S_ISREG(st.st_mode) && st.st_nlink == 1) return true;
  return diag_set(d, "%s: error: not a regular file of one name", text_str(&p->sum_path));
}

/* --- The file --- */

bool part_create(struct part *p, struct diag *d) {
  if (!file_replaceable(text_str(&p->target))) return failed(&p->target, d);
  p->fd = open(text_str(&p->path), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  p->hash = hash_of_nothing;
  if (p->fd >= 0) return lock(p, d) && sum_open(p, O_CREAT | O_TRUNC, d);
  if (errno != EEXIST) return failed(&p->path, d);
  return diag_set(d, "%s: error: exists, from a run that was interrupted or still goes on; --resume continues it",
                  text_str(&p->path));
}

bool part_open(struct part *p, bool *found, struct diag *d) {
  struct stat st;
  *found = false;
  if (!file_replaceable(text_str(&p->target))) return failed(&p->target, d);
  p->fd = open(text_str(&p->path), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (p->fd < 0 && errno == ENOENT) return true;
  if (p->fd < 0) return failed(&p->path, d);
  if (fstat(p->fd, &st) != 0 || !S_ISREG(st.st_mode) || st.st_nlink > 1)
    return diag_set(d, "%s: error: not a regular file%s", text_str(&p->path),
                    S_ISREG(st.st_mode) ? " of one name" : "");
  *found = true;
  if (!lock(p, d)) return false;
  if (access(text_str(&p->sum_path), F_OK) == 0 && !sum_open(p, 0, d)) return false;
  if (p->sum_fd >= 0 && sum_holds(p)) return true;
  return diag_set(d, "%s: error: not as it was written, by %s; remove it and begin again", text_str(&p->path),
                  text_str(&p->sum_path));
}

bool part_cut(struct part *p, long long offset, struct diag *d) {
  if (ftruncate(p->fd, (off_t)offset) != 0 || lseek(p->fd, (off_t)offset, SEEK_SET) < 0 || !sum_up(p, offset))
    return failed(&p->path, d);
  return sum_write(p, d);
}

bool part_write(struct part *p, const char *data, size_t len, struct diag *d) {
  if (!write_all(p->fd, data, len)) return failed(&p->path, d);
  hash_on(&p->hash, data, len);
  p->len += (long long)len;
  return sum_write(p, d);
}

bool part_finish(struct part *p, struct diag *d) {
  int fd = p->fd;
  p->fd = -1;
  if (close(fd) != 0) return failed(&p->path, d);
  if (rename(text_str(&p->path), text_str(&p->target)) != 0) return failed(&p->target, d);
  unlink(text_str(&p->sum_path));
  return true;
}
