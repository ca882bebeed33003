/* The files that a command writes to one folder.  Of a report audit.json comes first; every other one is written from
   what is read back out of it and from the tables beside it, by verify as by `stickslip report`, which therefore writes
   the same bytes. */
#define _DEFAULT_SOURCE /* flock */
#include "report/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

void output_init(struct output *out, const char *folder) {
  out->folder = folder;
  out->n = 0;
}

void output_clear(struct output *out) {
  for (int i = 0; i < out->n; i++) {
    text_clear(&out->body[i]);
    text_clear(&out->path[i]);
  }
  out->n = 0;
}

struct text *output_add(struct output *out, const char *fmt, ...) {
  va_list ap;
  if (out->n == MAX_FILE_ITEMS) abort();
  int i = out->n++;
  text_init(&out->path[i]);
  text_init(&out->body[i]);
  text_printf(&out->path[i], "%s/", out->folder);
  va_start(ap, fmt);
  text_vprintf(&out->path[i], fmt, ap);
  va_end(ap);
  return &out->body[i];
}

void output_drop(struct output *out) {
  out->n--;
  text_clear(&out->body[out->n]);
  text_clear(&out->path[out->n]);
}

void output_add_tables(struct output *out, const struct audit_result *r) {
  for (size_t i = 0; i < r->n_tables; i++) text_add(output_add(out, "%s", r->tables[i].name), r->tables[i].text);
}

/* Waits until no other run writes to the folder.  To be closed; -1 where the folder cannot be opened or locked. */
static int lock(const char *folder) {
  int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC), got = -1;
  while (fd >= 0 && (got = flock(fd, LOCK_EX)) != 0 && errno == EINTR) {
  }
  if (fd >= 0 && got != 0) close(fd);
  return got == 0 ? fd : -1;
}

void output_remove_stale(const struct output *out, const char *fmt, ...) {
  OWNED(text) path = {0};
  bool written = false;
  va_list ap;
  text_printf(&path, "%s/", out->folder);
  va_start(ap, fmt);
  text_vprintf(&path, fmt, ap);
  va_end(ap);
  for (int i = 0; i < out->n; i++) written = written || strcmp(text_str(&out->path[i]), text_str(&path)) == 0;
  if (!written) unlink(text_str(&path));
}

bool output_write(const struct output *out, struct diag *d) {
  struct file_item item[MAX_FILE_ITEMS];
  for (int i = 0; i < out->n; i++)
    item[i] = (struct file_item){text_str(&out->path[i]), text_str(&out->body[i]), out->body[i].len};
  if (!folder_make(out->folder, d)) return false;
  int locked = lock(out->folder);
  if (locked >= 0) files_remove_left(out->folder, item, out->n);
  bool ok = files_write(item, out->n, d);
  if (locked >= 0) close(locked);
  return ok;
}

/* Pictures that other commands leave beside reports; those that are there are linked to. */
static const struct neighbour pictures_beside[] = {
    {"../bench/map.svg", "error against run time of one Poincare map"},
    {"../bench/jacobian.svg", "of its Jacobian"},
    {"../bench/orbit.svg", "of the periodic orbit"},
    {"../bench/verdicts.svg", "what verdicts cost"},
    {"../atlas/e1-e2/stability-map.svg", "which orbits there are over e_1 and e_2"},
    {"../atlas/chi-e2/stability-map.svg", "over chi and e_2"},
    {"../atlas/V-e2/stability-map.svg", "over V and e_2"},
    {"../stability/map-1.svg", "where formulas lose digits (1)"},
    {"../stability/map-2.svg", "(2)"},
    {"../stability/map-3.svg", "(3)"},
    {"../stability/map-4.svg", "(4)"}};
enum { N_BESIDE = sizeof pictures_beside / sizeof *pictures_beside };

static size_t find_neighbours(struct neighbour found[N_BESIDE], const char *folder) {
  size_t n = 0;
  OWNED(text) path = {0};
  for (size_t i = 0; i < N_BESIDE; i++) {
    text_reset(&path);
    text_printf(&path, "%s/%s", folder, pictures_beside[i].path);
    if (access(text_str(&path), R_OK) == 0) found[n++] = pictures_beside[i];
  }
  return n;
}

void output_add_views(struct output *out, struct audit_result *r, const struct mutation_score *score) {
  static const struct {
    const char *name;
    void (*write)(struct text *out, const struct audit_result *r);
  } view[] = {{"audit.md", report_markdown}, {"audit.csv", report_csv},         {"claims.dot", report_dot},
              {"errata.md", report_errata},  {"errata.tex", report_errata_tex}, {"index.html", report_html},
              {"junit.xml", report_junit}};
  struct neighbour found[N_BESIDE];
  r->mutation = score;
  r->n_neighbours = find_neighbours(found, out->folder);
  r->neighbours = found;
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) view[i].write(output_add(out, "%s", view[i].name), r);
  r->mutation = NULL; /* it ends with this function, as what follows */
  r->n_neighbours = 0;
  r->neighbours = NULL;
}

bool output_add_report(struct output *out, const struct audit_result *r, const struct mutation_score *score,
                       struct diag *d) {
  LOCAL(audit_result, again);
  OWNED(source) s;
  struct text *json = output_add(out, "audit.json");
  report_json(json, r);
  source_from_string(&s, "audit.json", text_str(json));
  bool ok = s.len <= LARGEST_AUDIT;
  if (!ok)
    diag_set(d, "%s: error: audit.json would have more than %d bytes, which no reader takes", r->scene, LARGEST_AUDIT);
  ok = ok && report_read(&again, &s, d);
  for (size_t i = 0; ok && i < again.n_tables; i++) again.tables[i].text = r->tables[i].text; /* in order */
  if (ok) output_add_views(out, &again, score);
  return ok;
}
