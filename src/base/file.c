/* Files: read whole after looking at what they are, written beside and renamed. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "arena.h"
#include "text.h"

const char *path_base(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

void path_folder(struct text *out, const char *path) {
  const char *slash = strrchr(path, '/');
  text_reset(out);
  text_add_n(out, slash ? path : ".", slash && slash > path ? (size_t)(slash - path) : 1);
}

/* The code point of a character of well-formed UTF-8. */
static unsigned code_point(const char *s) {
  const unsigned char *c = (const unsigned char *)s;
  return c[0] < 0x80   ? c[0]
         : c[0] < 0xE0 ? (c[0] & 0x1FU) << 6 | (c[1] & 0x3FU)
                       : (c[0] & 0x0FU) << 12 | (c[1] & 0x3FU) << 6 | (c[2] & 0x3FU);
}

bool source_check(const struct source *s, struct diag *d) {
  const char *nul = memchr(s->text, '\0', s->len);
  size_t good = text_plain_prefix(s->text, s->len, true), len = strlen(s->name);
  if (text_plain_prefix(s->name, len, false) < len)
    diag_set(d, "%.300s: error: a control character in this name, or it is not UTF-8 text", s->name);
  else if (nul)
    diag_set(d, "%.300s: error: not a text file (a NUL byte at offset %zu)", s->name, (size_t)(nul - s->text));
  else if (good < s->len && text_valid_prefix(s->text + good, s->len - good) == 0)
    diag_at(d, s, good, "not UTF-8 text (byte 0x%02x)", (unsigned)(unsigned char)s->text[good]);
  else if (good < s->len && s->text[good] == '\r')
    diag_at(d, s, good, "a carriage return inside a line; lines end in LF or CR LF");
  else if (good < s->len)
    diag_at(d, s, good, "a control character (U+%04X), which text does not hold", code_point(s->text + good));
  else
    return true;
  return false;
}

static bool read_descriptor(int fd, struct source *s, size_t max, struct diag *d) {
  struct stat st;
  if (fstat(fd, &st) != 0) return diag_set(d, "%.300s: error: %s", s->name, strerror(errno));
  if (!S_ISREG(st.st_mode))
    return diag_set(d, "%.300s: error: %s, not a regular file", s->name,
                    S_ISDIR(st.st_mode) ? "a folder" : "a device or pipe");
  OWNED(text) t = {0};
  char chunk[16384];
  ssize_t n;
  while ((n = read(fd, chunk, sizeof chunk)) > 0) {
    text_add_n(&t, chunk, (size_t)n);
    if (t.len > max) break;
  }
  if (n < 0) return diag_set(d, "%.300s: error: %s", s->name, strerror(errno));
  if (t.len > max) return diag_set(d, "%.300s: error: larger than %zu bytes", s->name, max);
  size_t mark = t.len >= 3 && memcmp(t.data, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
  s->len = t.len - mark;
  s->text = ss_malloc(s->len + 1);
  if (s->len) memcpy(s->text, t.data + mark, s->len);
  s->text[s->len] = '\0';
  return true;
}

bool source_read(struct source *s, const char *path, size_t max, struct diag *d) {
  *s = (struct source){ss_strdup(path), NULL, 0};
  int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  bool ok = fd >= 0;
  if (!ok) diag_set(d, "%.300s: error: %s", path, strerror(errno));
  ok = ok && read_descriptor(fd, s, max, d) && source_check(s, d);
  if (fd >= 0) close(fd);
  if (!ok) source_clear(s);
  return ok;
}

void source_from_string(struct source *s, const char *name, const char *text) {
  *s = (struct source){ss_strdup(name), ss_strdup(text), strlen(text)};
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

/* Stands in the name of a temporary file between that of the file and six characters, as in no name of a user's. */
#define BESIDE ".stickslip-"
#define BEFORE "before"

/* What a run that ends half way must not leave: temporary files, or some new files among old ones. */
static struct {
  const char
      *volatile beside[MAX_FILE_ITEMS]; /* temporary files that stand in a folder, in the order of their renames */
  const char *volatile path[MAX_FILE_ITEMS];
  const char *volatile kept[MAX_FILE_ITEMS]; /* second names of what stood there, to come back if a rename fails */
} under_way;
static volatile sig_atomic_t sets_in_place;
const int ending_signals[N_ENDING_SIGNALS] = {SIGINT, SIGTERM, SIGHUP, SIGALRM};

int files_in_place(void) {
  return sets_in_place;
}

/* Folders that folder_make has made, in that order. */
enum { MOST_MADE = 64 };
static struct {
  char *path[MOST_MADE];
  volatile sig_atomic_t n;
} made;

/* The folder knows, to the instruction, whether the first rename has happened. */
void files_settle(void) {
  struct stat st;
  bool forwards = under_way.beside[0] && stat(under_way.beside[0], &st) != 0;
  for (int i = 0; i < MAX_FILE_ITEMS; i++) {
    const char *name = under_way.beside[i];
    if (name && (!forwards || rename(name, under_way.path[i]) != 0)) unlink(name);
    if (under_way.kept[i]) unlink(under_way.kept[i]);
    under_way.beside[i] = under_way.kept[i] = NULL;
  }
  if (forwards) sets_in_place++;
  while (made.n > 0) rmdir(made.path[--made.n]); /* unless something is in it */
}

static void settle_and_end(int number) {
  files_settle();
  raise(number); /* held back until the handler returns, and then what it is by default */
}

static void set_of_ending(sigset_t *set) {
  sigemptyset(set);
  for (int i = 0; i < N_ENDING_SIGNALS; i++) sigaddset(set, ending_signals[i]);
}

/* Where a signal would end the process it settles the files first; who has a handler of his own calls files_settle. */
static void watch_signals(struct sigaction before[N_ENDING_SIGNALS]) {
  struct sigaction a = {.sa_handler = settle_and_end, .sa_flags = (int)SA_RESETHAND};
  set_of_ending(&a.sa_mask);
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (sigaction(ending_signals[i], NULL, &before[i]) == 0 && before[i].sa_handler == SIG_DFL)
      sigaction(ending_signals[i], &a, NULL);
}

static void leave_signals(const struct sigaction before[N_ENDING_SIGNALS]) {
  for (int i = 0; i < N_ENDING_SIGNALS; i++)
    if (before[i].sa_handler == SIG_DFL) sigaction(ending_signals[i], &before[i], NULL);
}

/* From here, and as it was: what a signal must not find half done. */
static void hold_signals(sigset_t *before) {
  sigset_t set;
  set_of_ending(&set);
  sigprocmask(SIG_BLOCK, &set, before);
}

static int make_beside(char *name, int i, const char *path) {
  sigset_t before;
  hold_signals(&before);
  int fd = file_replaceable(path) ? mkstemp(name) : -1;
  int err = errno;
  under_way.path[i] = path;
  under_way.beside[i] = fd >= 0 ? name : NULL;
  sigprocmask(SIG_SETMASK, &before, NULL);
  errno = err;
  return fd;
}

/* Writes an item to the file whose name ends in XXXXXX, which becomes its real name. */
static bool write_beside(char *name, int i, const struct file_item *item, mode_t mode, struct diag *d) {
  int fd = make_beside(name, i, item->path);
  bool ok = fd >= 0 && write_all(fd, item->data, item->len) && fchmod(fd, mode) == 0;
  int err = errno;
  if (fd >= 0 && close(fd) != 0 && ok) {
    ok = false;
    err = errno;
  }
  if (!ok) diag_set(d, "%s: error: cannot be written: %s", item->path, strerror(err));
  return ok;
}

static bool rename_over(const char *name, const char *path, struct diag *d) {
  if (rename(name, path) == 0) return true;
  return diag_set(d, "%s: error: cannot be written: %s", path, strerror(errno));
}

/* Where a folder has no second names there is no way back. */
static void keep(const char *kept, int i, const char *path) {
  unlink(kept);
  under_way.kept[i] = kept;
  if (link(path, kept) != 0 && errno != ENOENT) under_way.kept[i] = NULL;
}

static void bring_back(const char *kept, const char *path) {
  if (kept && rename(kept, path) != 0 && errno == ENOENT) unlink(path);
}

/* The first `renamed` of n files are in place, and stay if they are all; of the others nothing stays. */
static void finish(int renamed, int n) {
  sigset_t before;
  hold_signals(&before);
  for (int i = 0; i < n; i++) {
    if (i >= renamed && under_way.beside[i]) unlink(under_way.beside[i]);
    if (i < renamed && renamed < n) bring_back(under_way.kept[i], under_way.path[i]);
    if (under_way.kept[i]) unlink(under_way.kept[i]);
    under_way.beside[i] = under_way.kept[i] = NULL;
  }
  if (n > 0 && renamed == n) sets_in_place++;
  sigprocmask(SIG_SETMASK, &before, NULL);
}

/* As for any file that a program makes. */
static mode_t usual_mode(void) {
  mode_t mask = umask(S_IRWXG | S_IRWXO);
  umask(mask);
  return (S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH) & ~mask;
}

/* No memory is asked for between the first temporary file and the last rename: to run out of it ends the program. */
bool files_write(const struct file_item *item, int n, struct diag *d) {
  struct text beside[MAX_FILE_ITEMS] = {{.len = 0}}, kept[MAX_FILE_ITEMS] = {{.len = 0}};
  struct sigaction before[N_ENDING_SIGNALS];
  int written = 0, renamed = 0;
  for (int i = 0; i < n; i++) {
    text_printf(&beside[i], "%s" BESIDE "XXXXXX", item[i].path);
    text_printf(&kept[i], "%s" BESIDE BEFORE, item[i].path);
  }
  mode_t mode = usual_mode();
  watch_signals(before);
  while (written < n && write_beside(beside[written].data, written, &item[written], mode, d)) written++;
  for (int i = 0; written == n && i + 1 < n; i++) keep(kept[i].data, i, item[i].path);
  while (written == n && renamed < n && rename_over(beside[renamed].data, item[renamed].path, d)) renamed++;
  finish(renamed, n);
  leave_signals(before);
  for (int i = 0; i < n; i++) {
    text_clear(&beside[i]);
    text_clear(&kept[i]);
  }
  return renamed == n;
}

/* Whether a name in a folder is that of a temporary file of the item. */
static bool is_beside(const char *name, const struct file_item *item) {
  const char *base = path_base(item->path);
  size_t n = strlen(base), k = strlen(BESIDE);
  return strncmp(name, base, n) == 0 && strncmp(name + n, BESIDE, k) == 0 && strlen(name + n + k) == 6;
}

void files_remove_left(const char *folder, const struct file_item *item, int n) {
  DIR *dir = opendir(folder);
  if (!dir) return;
  for (struct dirent *e = readdir(dir); e; e = readdir(dir))
    for (int i = 0; i < n; i++)
      if (is_beside(e->d_name, &item[i])) unlinkat(dirfd(dir), e->d_name, 0);
  closedir(dir);
}

bool file_write(const char *path, const char *data, size_t len, struct diag *d) {
  return files_write(&(struct file_item){path, data, len}, 1, d);
}

bool folder_make(const char *path, struct diag *d) {
  OWNED(text) t = {0};
  bool ok = true;
  for (const char *p = path; ok && *p; p++) {
    text_add_char(&t, *p);
    if (*p == '/' || (p[1] != '/' && p[1] != '\0')) continue;
    bool new = mkdir(t.data, 0777) == 0;
    ok = new || errno == EEXIST;
    if (!new || made.n == MOST_MADE) continue;
    made.path[made.n] = ss_strdup(t.data);
    made.n++; /* once the path stands there, for a signal's handler */
  }
  int err = errno;
  struct stat st;
  if (ok && (stat(path, &st) != 0 || !S_ISDIR(st.st_mode))) {
    ok = false;
    err = ENOTDIR;
  }
  if (!ok) diag_set(d, "%s: error: cannot make the folder: %s", path, strerror(err));
  return ok;
}

/* 0 for a folder, else why it is none. */
static int look_at_folder(const char *path) {
  struct stat st;
  return stat(path, &st) != 0 ? errno : S_ISDIR(st.st_mode) ? 0 : ENOTDIR;
}

/* The first folder that is missing is made and removed. */
bool folder_is_there(const char *path) {
  return look_at_folder(path) == 0;
}

bool folder_possible(const char *path, struct diag *d) {
  OWNED(text) t = {0}, missing = {0};
  text_add(&t, path);
  size_t end = t.len;
  int err = look_at_folder(path);
  while (err == ENOENT && end > 0) {
    while (end > 0 && path[end - 1] == '/') end--;
    text_reset(&missing);
    text_add_n(&missing, path, end);
    while (end > 0 && path[end - 1] != '/') end--;
    t.data[end] = '\0';
    err = look_at_folder(end > 0 ? t.data : ".");
  }
  if (!err && missing.len && (mkdir(missing.data, 0777) != 0 || rmdir(missing.data) != 0)) err = errno;
  if (err == EEXIST) err = 0; /* somebody else has made it */
  if (err) diag_set(d, "%s: error: cannot make the folder: %s", path, strerror(err));
  return !err;
}

bool path_has_suffix(const char *path, const char *suffix) {
  size_t len = strlen(path), own = strlen(suffix);
  return len > own && strcmp(path + len - own, suffix) == 0;
}

char **folder_files(size_t *n, const char *path, const char *suffix, struct arena *a, struct diag *d) {
  DIR *dir = opendir(path);
  if (!dir && errno == ENOMEM) ss_out_of_memory();
  *n = 0;
  if (!dir) {
    diag_set(d, "%s: error: %s", path, strerror(errno));
    return NULL;
  }
  char **paths = NULL;
  size_t cap = 0;
  OWNED(text) t = {0};
  for (struct dirent *e = readdir(dir); e; e = readdir(dir)) {
    if (e->d_name[0] == '.' || !path_has_suffix(e->d_name, suffix)) continue;
    text_reset(&t);
    text_printf(&t, "%s/%s", path, e->d_name);
    *SS_PUSH(paths, *n, cap) = arena_strndup(a, t.data, t.len);
  }
  closedir(dir);
  if (*n) qsort(paths, *n, sizeof *paths, word_compare);
  if (!*n) diag_set(d, "%s: error: no %s file in this folder", path, suffix);
  return paths;
}
