/* Where rows go, and how an interrupted file is taken up.

   Rows begin with the number of their point, which grows by at most one from row to row.  So a file of rows says itself how
   far it came: its last unit may be cut off and is done again, everything before it is kept after its shape was checked. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sweep.h"

enum { ROW_MAX = 4096 };

/* --- Reading what is there. --- */

struct reader {
  const char *path;
  FILE *file;
  char row[ROW_MAX];
  long long offset; /* of the row */
  long line;
  int commas; /* that a row has */
};

/* The next whole line; false at the end, or where a line was cut off. */
static bool next_row(struct reader *r, struct diag *d) {
  r->offset += r->line ? (long long)strlen(r->row) : 0;
  if (!fgets(r->row, sizeof r->row, r->file)) return false;
  r->line++;
  size_t len = strlen(r->row);
  if (len > 0 && r->row[len - 1] == '\n') return true;
  if (len + 1 == sizeof r->row) diag_set(d, "%s:%ld: error: not a row of this sweep", r->path, r->line);
  return false;
}

/* The head, line by line, so that the first difference can be shown. */
static bool same_head(struct reader *r, const char *head, struct diag *d) {
  while (*head) {
    size_t len = strcspn(head, "\n") + 1;
    if (!next_row(r, d)) {
      diag_set(d, "%s: error: ends within its head: it holds nothing to continue; remove it", r->path);
      return false;
    }
    if (strlen(r->row) != len || strncmp(r->row, head, len) != 0) {
      diag_set(d, "%s:%ld: error: belongs to another request: %.*s, where this one has %.*s", r->path, r->line,
               (int)strcspn(r->row, "\n"), r->row, (int)len - 1, head);
      return false;
    }
    r->commas = 0;
    for (const char *c = head; c < head + len; c++) r->commas += *c == ',';
    head += len;
  }
  return true;
}

/* The number of the row's point; -1 when this is no row. */
static long long point_of(const struct reader *r) {
  char *end;
  int commas = 0;
  errno = 0;
  long long point = strtoll(r->row, &end, 10);
  for (const char *c = r->row; *c; c++) commas += *c == ',';
  return r->row[0] >= '0' && r->row[0] <= '9' && !errno && *end == ',' && commas == r->commas ? point : -1;
}

static slong unit_of(const struct sweep *q, long long point) {
  slong n = sweep_line_axis(q)->n;
  return (slong)(point / n) * q->per_line + (slong)(point % n) / q->unit;
}

/* Which units are whole, and where the one behind them begins. */
static bool scan(struct reader *r, slong *done, long long *keep, const struct sweep *q, struct diag *d) {
  long long last = -1;
  *done = 0;
  while (next_row(r, d)) {
    long long point = point_of(r);
    if (point < 0 || point >= q->points || (point != last && point != last + 1)) {
      diag_set(d, "%s:%ld: error: not a row of this sweep", r->path, r->line);
      return false;
    }
    if (last < 0 || unit_of(q, point) != unit_of(q, last)) {
      *done = unit_of(q, point);
      *keep = r->offset;
    }
    last = point;
  }
  if (last < 0) *keep = r->offset; /* nothing behind the head, but perhaps a row that was cut off */
  return !d->set;
}

static bool take_up(struct sink *s, const struct sweep *q, const char *head, struct diag *d) {
  struct reader r = {.path = text_str(&s->part.path)};
  long long keep = 0;
  int copy = dup(s->part.fd);
  r.file = copy >= 0 ? fdopen(copy, "r") : NULL;
  if (!r.file) {
    if (copy >= 0) close(copy);
    diag_set(d, "%s: error: cannot be read: %s", r.path, strerror(errno));
    return false;
  }
  bool ok = same_head(&r, head, d) && scan(&r, &s->done, &keep, q, d);
  fclose(r.file);
  return ok && part_cut(&s->part, keep, d);
}

/* --- The sink. --- */

static bool open_file(struct sink *s, const struct sweep *q, bool resume, const struct text *head, struct diag *d) {
  bool found = false;
  if (resume && !part_open(&s->part, &found, d)) return false;
  if (found) return take_up(s, q, text_str(head), d);
  return part_create(&s->part, d) && part_write(&s->part, head->data, head->len, d);
}

bool sink_open(struct sink *s, const struct sweep *q, const struct options *o, struct diag *d) {
  struct text head;
  *s = (struct sink){.to_file = o->csv_file != NULL};
  part_init(&s->part, o->csv_file ? o->csv_file : "");
  text_init(&head);
  sweep_head(&head, q);
  bool ok = s->to_file ? open_file(s, q, o->resume, &head, d) : sink_write(s, &head, d);
  text_clear(&head);
  return ok;
}

bool sink_write(struct sink *s, const struct text *rows, struct diag *d) {
  if (rows->len == 0) return true;
  if (s->to_file) return part_write(&s->part, rows->data, rows->len, d);
  if (write_all(STDOUT_FILENO, rows->data, rows->len)) return true;
  diag_set(d, "error: standard output cannot be written: %s", strerror(errno));
  return false;
}

bool sink_finish(struct sink *s, const struct sweep *q, struct diag *d) {
  struct text tail;
  text_init(&tail);
  sweep_tail(&tail, q);
  bool ok = sink_write(s, &tail, d) && (!s->to_file || part_finish(&s->part, d));
  text_clear(&tail);
  return ok;
}

void sink_clear(struct sink *s) {
  part_clear(&s->part);
}
