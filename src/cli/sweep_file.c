/* Where rows go, and how an interrupted file is taken up.

   Rows begin with the number of their point, which grows by at most one from row to row.  So a file of rows says itself
   how far it came: its last unit may be cut off and is done again, everything before it is kept after its shape was
   checked. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"
#include "sweep.h"

enum { ROW_MAX = 4096 };

/* --- Reading what is there. --- */

enum { BLOCK = 1 << 16 };

/* From the descriptor itself: to close another one of this file would drop the lock on it. */
struct reader {
  const char *path;
  int fd;
  char block[BLOCK];
  size_t at, end; /* of what the block still holds */
  size_t most;    /* bytes of a line */
  struct text row;
  long long offset; /* of the row */
  long line;
  int commas; /* that a row has */
};

static bool refill(struct reader *r, struct diag *d) {
  ssize_t got = read(r->fd, r->block, BLOCK);
  if (got < 0) diag_set(d, "%s: error: cannot be read: %s", r->path, strerror(errno));
  r->at = 0;
  r->end = got > 0 ? (size_t)got : 0;
  return got > 0;
}

/* The next whole line; false at the end, or where a line was cut off. */
static bool next_row(struct reader *r, struct diag *d) {
  r->offset += (long long)r->row.len;
  text_reset(&r->row);
  r->line++;
  while (r->at < r->end || refill(r, d)) {
    const char *from = r->block + r->at, *stop = memchr(from, '\n', r->end - r->at);
    size_t len = stop ? (size_t)(stop - from) + 1 : r->end - r->at;
    text_add_n(&r->row, from, len);
    r->at += len;
    if (r->row.len > r->most) return diag_set(d, "%s:%ld: error: not a row of this sweep", r->path, r->line);
    if (stop) return true;
  }
  return false;
}

/* The head, line by line, so that the first difference can be shown. */
static bool same_head(struct reader *r, const char *head, struct diag *d) {
  while (*head) {
    size_t len = strcspn(head, "\n") + 1;
    if (!next_row(r, d))
      return diag_set(d, "%s: error: ends within its head: it holds nothing to continue; remove it", r->path);
    const char *row = text_str(&r->row);
    if (r->row.len != len || memcmp(row, head, len) != 0)
      return diag_set(d, "%s:%ld: error: belongs to another request: %.*s, where this one has %.*s", r->path, r->line,
                      (int)strcspn(row, "\n"), row, (int)len - 1, head);
    r->commas = 0;
    for (const char *c = head; c < head + len; c++) r->commas += *c == ',';
    head += len;
  }
  return true;
}

/* The number of the row's point; -1 when this is no row. */
static long long point_of(const struct reader *r) {
  const char *row = text_str(&r->row);
  char *end;
  int commas = 0;
  errno = 0;
  long long point = strtoll(row, &end, 10);
  for (const char *c = row; *c; c++) commas += *c == ',';
  bool whole = strlen(row) == r->row.len && commas == r->commas;
  return row[0] >= '0' && row[0] <= '9' && !errno && *end == ',' && whole ? point : -1;
}

static slong unit_of(const struct sweep *q, long long point) {
  slong n = sweep_line_axis(q)->n;
  return (slong)(point / n) / q->abreast * q->per_line + (slong)(point % n) / q->unit;
}

/* Which units are whole, and where the one behind them begins. */
static bool scan(struct reader *r, slong *done, long long *keep, const struct sweep *q, struct diag *d) {
  long long last = -1;
  *done = 0;
  while (next_row(r, d)) {
    long long point = point_of(r);
    if (point < 0 || point >= q->points || (point != last && point != last + 1))
      return diag_set(d, "%s:%ld: error: not a row of this sweep", r->path, r->line);
    if (last < 0 || unit_of(q, point) != unit_of(q, last)) {
      *done = unit_of(q, point);
      *keep = r->offset;
    }
    last = point;
  }
  if (last < 0) *keep = r->offset; /* nothing behind the head, but perhaps a row that was cut off */
  return !d->set;
}

static bool take_up(struct sink *s, const struct sweep *q, const struct text *head, struct diag *d) {
  FREED struct reader *r = ss_malloc(sizeof *r);
  long long keep = 0;
  *r = (struct reader){.path = text_str(&s->part.path), .fd = s->part.fd, .most = head->len + ROW_MAX};
  bool ok = same_head(r, text_str(head), d) && scan(r, &s->done, &keep, q, d) && part_cut(&s->part, keep, d);
  text_clear(&r->row);
  return ok;
}

/* --- The sink. --- */

static bool open_file(struct sink *s, const struct sweep *q, bool resume, const struct text *head, struct diag *d) {
  bool found = false;
  if (resume && !part_open(&s->part, &found, d)) return false;
  if (found) return take_up(s, q, head, d);
  return part_create(&s->part, d) && part_write(&s->part, head->data, head->len, d);
}

bool sink_open(struct sink *s, const struct sweep *q, const struct options *o, struct diag *d) {
  const char *file = option(o, OPT_CSV);
  OWNED(text) head = {0};
  *s = (struct sink){.to_file = file != NULL};
  part_init(&s->part, file ? file : "");
  sweep_head(&head, q);
  return s->to_file ? open_file(s, q, option(o, OPT_RESUME), &head, d) : sink_write(s, &head, d);
}

bool sink_write(struct sink *s, const struct text *rows, struct diag *d) {
  if (rows->len == 0) return true;
  if (s->to_file) return part_write(&s->part, rows->data, rows->len, d);
  if (write_all(STDOUT_FILENO, rows->data, rows->len)) return true;
  if (errno != EPIPE) diag_set(d, "error: standard output cannot be written: %s", strerror(errno));
  return false;
}

int sink_failed(const struct diag *d) {
  return d->set ? bad_input(d) : EXIT_AS_RECORDED;
}

bool sink_finish(struct sink *s, const struct sweep *q, struct diag *d) {
  OWNED(text) tail = {0};
  sweep_tail(&tail, q);
  return sink_write(s, &tail, d) && (!s->to_file || part_finish(&s->part, d));
}

void sink_clear(struct sink *s) {
  part_clear(&s->part);
}
