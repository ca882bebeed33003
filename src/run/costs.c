/* The table of costs: tab-separated, a line of names first. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "audit.h"

enum { MAX_COSTS_FILE = 1 << 20 };

static bool read_row(struct costs *c, const struct source *src, size_t at, const char *line, struct diag *d) {
  struct cost row;
  char end;
  if (sscanf(line, "%15[^\t]\t%47[^\t]\t%lf\t%lf%c", row.what, row.name, &row.units, &row.ms, &end) != 4 ||
      !(row.units >= 0 && row.units < 1e18) || !(row.ms >= 0 && row.ms < 1e9))
    return diag_at(d, src, at,
                   "a row reads what, name, units, milliseconds with tabs between; \"make scenes\" writes the table");
  *SS_PUSH(c->row, c->n, c->cap) = row;
  return true;
}

bool costs_load(struct costs *c, const char *path, struct diag *d) {
  OWNED(source) src = {.name = NULL};
  *c = (struct costs){.n = 0};
  if (access(path, F_OK) != 0) return true;
  if (!source_read(&src, path, MAX_COSTS_FILE, d)) return false;
  bool ok = true;
  for (size_t at = 0, n = 0; ok && at < src.len; n++) {
    size_t len = strcspn(src.text + at, "\n");
    char line[160];
    snprintf(line, sizeof line, "%.*s", len < sizeof line ? (int)len : (int)sizeof line - 1, src.text + at);
    if (n > 0 && len > 0) ok = read_row(c, &src, at, line, d);
    at += len + 1;
  }
  if (!ok) costs_clear(c);
  return ok;
}

void costs_clear(struct costs *c) {
  free(c->row);
  *c = (struct costs){.n = 0};
}

const struct cost *cost_of(const struct costs *c, const char *what, const char *name) {
  for (size_t i = 0; c && i < c->n; i++)
    if (strcmp(c->row[i].what, what) == 0 && strcmp(c->row[i].name, name) == 0) return &c->row[i];
  return NULL;
}
