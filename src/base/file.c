/* Files: read whole after looking at what they are, written beside and renamed. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "stickslip/arena.h"
#include "stickslip/text.h"

static bool check_text(const struct source *s, struct diag *d) {
  const char *nul = memchr(s->text, '\0', s->len);
  if (nul) {
    diag_set(d, "%s: error: not a text file (a NUL byte at offset %zu)", s->name, (size_t)(nul - s->text));
    return false;
  }
  size_t good = text_valid_prefix(s->text, s->len);
  if (good < s->len) {
    diag_at(d, s, good, "not UTF-8 text (byte 0x%02x)", (unsigned)(unsigned char)s->text[good]);
    return false;
  }
  return true;
}

static bool read_descriptor(int fd, struct source *s, size_t max, struct diag *d) {
  struct stat st;
  if (fstat(fd, &st) != 0) {
    diag_set(d, "%s: error: %s", s->name, strerror(errno));
    return false;
  }
  if (!S_ISREG(st.st_mode)) {
    diag_set(d, "%s: error: %s, not a regular file", s->name, S_ISDIR(st.st_mode) ? "a folder" : "a device or pipe");
    return false;
  }
  struct text t;
  text_init(&t);
  char chunk[16384];
  ssize_t n;
  while ((n = read(fd, chunk, sizeof chunk)) > 0) {
    text_add_n(&t, chunk, (size_t)n);
    if (t.len > max) break;
  }
  if (n < 0)
    diag_set(d, "%s: error: %s", s->name, strerror(errno));
  else if (t.len > max)
    diag_set(d, "%s: error: larger than %zu bytes", s->name, max);
  if (n != 0) {
    text_clear(&t);
    return false;
  }
  size_t mark = t.len >= 3 && memcmp(t.data, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
  s->len = t.len - mark;
  s->text = ss_malloc(s->len + 1);
  if (s->len) memcpy(s->text, t.data + mark, s->len);
  s->text[s->len] = '\0';
  text_clear(&t);
  return true;
}

static char *duplicate(const char *s) {
  size_t n = strlen(s) + 1;
  return memcpy(ss_malloc(n), s, n);
}

bool source_read(struct source *s, const char *path, size_t max, struct diag *d) {
  *s = (struct source){duplicate(path), NULL, 0};
  int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  bool ok = fd >= 0;
  if (!ok) diag_set(d, "%s: error: %s", path, strerror(errno));
  ok = ok && read_descriptor(fd, s, max, d) && check_text(s, d);
  if (fd >= 0) close(fd);
  if (!ok) source_clear(s);
  return ok;
}

void source_from_string(struct source *s, const char *name, const char *text) {
  *s = (struct source){duplicate(name), duplicate(text), strlen(text)};
}

void source_clear(struct source *s) {
  free(s->name);
  free(s->text);
  *s = (struct source){NULL, NULL, 0};
}

bool write_all(int fd, const char *data, size_t len) {
  while (len > 0) {
    ssize_t n = write(fd, data, len);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    len -= (size_t)n;
  }
  return true;
}

/* A rename would put a file in the place of a device or a pipe that others write to. */
bool file_replaceable(const char *path) {
  struct stat st;
  if (stat(path, &st) != 0 || S_ISREG(st.st_mode)) return true;
  errno = S_ISDIR(st.st_mode) ? EISDIR : EINVAL;
  return false;
}

/* Writes the data beside path and leaves the temporary file's name in beside; on failure nothing is left. */
static bool write_beside(struct text *beside, const char *path, const char *data, size_t len, struct diag *d) {
  text_printf(beside, "%s.XXXXXX", path);
  int fd = file_replaceable(path) ? mkstemp(beside->data) : -1;
  bool ok = fd >= 0 && write_all(fd, data, len) && fchmod(fd, S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH) == 0;
  int err = errno;
  if (fd >= 0 && close(fd) != 0 && ok) {
    ok = false;
    err = errno;
  }
  if (ok) return true;
  diag_set(d, "%s: error: cannot be written: %s", path, strerror(err));
  if (fd >= 0) unlink(beside->data);
  return false;
}

static bool rename_over(const struct text *beside, const char *path, struct diag *d) {
  if (rename(beside->data, path) == 0) return true;
  diag_set(d, "%s: error: cannot be written: %s", path, strerror(errno));
  return false;
}

bool files_write(const struct file_item *item, int n, struct diag *d) {
  struct text beside[MAX_FILE_ITEMS];
  int written = 0, renamed = 0;
  for (int i = 0; i < n; i++) text_init(&beside[i]);
  while (written < n && write_beside(&beside[written], item[written].path, item[written].data, item[written].len, d))
    written++;
  while (written == n && renamed < n && rename_over(&beside[renamed], item[renamed].path, d)) renamed++;
  for (int i = renamed; i < written; i++) unlink(beside[i].data);
  for (int i = 0; i < n; i++) text_clear(&beside[i]);
  return renamed == n;
}

bool file_write(const char *path, const char *data, size_t len, struct diag *d) {
  return files_write(&(struct file_item){path, data, len}, 1, d);
}

bool folder_make(const char *path, struct diag *d) {
  struct text t;
  text_init(&t);
  bool ok = true;
  for (const char *p = path; ok && *p; p++) {
    text_add_char(&t, *p);
    if (*p != '/' && (p[1] == '/' || p[1] == '\0') && mkdir(t.data, 0777) != 0 && errno != EEXIST) ok = false;
  }
  int err = errno;
  struct stat st;
  if (ok && (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))) {
    ok = false;
    err = ENOTDIR;
  }
  if (!ok) diag_set(d, "%s: error: cannot make the folder: %s", path, strerror(err));
  text_clear(&t);
  return ok;
}
