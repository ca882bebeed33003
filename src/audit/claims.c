/* Claims are records; what they mean is read where they are judged. */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "stickslip/audit.h"

/* One more record at the end of a list in which ids are unique. */
static bool append(struct claim **list, size_t *n, size_t *cap, const struct record_file *f, const struct record *r,
                   struct diag *d) {
  for (size_t i = 0; i < *n; i++)
    if (strcmp((*list)[i].id, r->id_name) == 0) {
      diag_at(d, &f->src, r->id.begin, "%s %s is given twice", r->kind_name, r->id_name);
      return false;
    }
  *list = ss_grow(*list, *n, cap, sizeof **list);
  (*list)[(*n)++] = (struct claim){.id = r->id_name, .record = r, .file = f};
  return true;
}

bool claims_add_file(struct claims *c, const char *path, const char *kind, struct diag *d) {
  struct source src;
  if (!source_read(&src, path, MAX_CLAIM_FILE, d)) return false;
  struct record_file *f = ss_malloc(sizeof *f);
  c->files = ss_grow(c->files, c->n_files, &c->cap_files, sizeof *c->files);
  c->files[c->n_files++] = f;
  if (!record_file_parse(f, src, d)) return false;
  for (size_t i = 1; i < f->n_records; i++) {
    const struct record *r = &f->records[i];
    bool result = strcmp(kind, "claim") == 0 && strcmp(r->kind_name, "result") == 0;
    if (strcmp(r->kind_name, kind) != 0 && !result) {
      diag_at(d, &f->src, r->kind.begin, "unknown record kind \"%s\"; this file holds \"%s ID\" records", r->kind_name,
              kind);
      return false;
    }
    if (!(result ? append(&c->result, &c->n_results, &c->cap_results, f, r, d)
                 : append(&c->claim, &c->n, &c->cap, f, r, d)))
      return false;
  }
  return true;
}

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

bool claims_load(struct claims *c, const char *folder, const char *kind, struct diag *d) {
  DIR *dir = opendir(folder);
  if (!dir) {
    diag_set(d, "%s: error: %s", folder, strerror(errno));
    return false;
  }
  char **names = NULL;
  size_t n = 0, cap = 0;
  for (struct dirent *e = readdir(dir); e; e = readdir(dir)) {
    size_t len = strlen(e->d_name);
    if (len < 7 || e->d_name[0] == '.' || strcmp(e->d_name + len - 6, ".claim") != 0) continue;
    names = ss_grow(names, n, &cap, sizeof *names);
    names[n++] = strdup(e->d_name);
  }
  closedir(dir);
  if (n) qsort(names, n, sizeof *names, by_name);
  bool ok = n > 0;
  if (!ok) diag_set(d, "%s: error: no .claim file in this folder", folder);
  for (size_t i = 0; i < n; i++) {
    struct text t;
    text_init(&t);
    text_printf(&t, "%s/%s", folder, names[i]);
    ok = ok && claims_add_file(c, t.data, kind, d);
    text_clear(&t);
    free(names[i]);
  }
  free(names);
  return ok;
}

void claims_clear(struct claims *c) {
  for (size_t i = 0; i < c->n_files; i++) {
    record_file_clear(c->files[i]);
    free(c->files[i]);
  }
  free(c->files);
  free(c->claim);
  free(c->result);
  *c = (struct claims){.n = 0};
}

const char *claim_get(const struct claim *c, const char *key) {
  const char *v = c->control ? record_get(c->control, key) : NULL;
  return v ? v : record_get(c->record, key);
}

const char *claim_own(const struct claim *c) {
  const char *own = claim_get(c, "own"), *equation = claim_get(c, "equation");
  return own ? own : equation ? equation : c->id;
}

bool claim_selected(const char *id, const char *item) {
  size_t n = strlen(item);
  if (n == 0 || strncmp(id, item, n) != 0) return false;
  const char *rest = id + n;
  bool numbered = item[n - 1] >= '0' && item[n - 1] <= '9';
  if (numbered && *rest >= 'a' && *rest <= 'z') rest++;
  return *rest == '\0' || *rest == '-';
}
