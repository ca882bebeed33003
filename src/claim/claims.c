/* Claims are records; what they mean is read where they are judged. */
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
  const struct record *top = &f->records[0];
  if (top->n_fields > 0) {
    diag_at(d, &f->src, top->fields[0].attribute ? top->fields[0].key.begin : top->fields[0].value.begin,
            "outside a record; begin one with \"%s ID\"", kind);
    return false;
  }
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

bool claims_load(struct claims *c, const char *folder, const char *kind, struct diag *d) {
  struct arena a;
  arena_init(&a);
  size_t n;
  char **file = folder_files(&n, folder, ".claim", &a, d);
  bool ok = n > 0;
  for (size_t i = 0; ok && i < n; i++) ok = claims_add_file(c, file[i], kind, d);
  free(file);
  arena_clear(&a);
  return ok;
}

bool claims_load_data(struct claims *c, const char *data, const char *folder, const char *kind, struct diag *d) {
  struct text path;
  text_init(&path);
  text_printf(&path, "%s/%s", data, folder);
  bool ok = claims_load(c, text_str(&path), kind, d);
  text_clear(&path);
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
